"""The bar at the top: rotor, mode, undo, redo, and the design that is pinned as A with its menu."""

from collections.abc import Callable

from explorer.interface import SessionState, TabContext
from explorer.overlay.bridge import Bridge
from explorer.pinned import Order, Pinboard, Pinned
from explorer.state import Inputs, menu_titles
from explorer.tabs.layout import Layout
from explorer.text.units import SI, UNITS
from rotor.design.design import Design
from rotor.trim.solution import Solution


class TopBar:
    """One session's."""

    def __init__(self, bridge: Bridge, layout: Layout, wake: Callable[[], None]) -> None:
        self._bridge, self._layout, self._wake = bridge, layout, wake
        self._board, self._units = Pinboard(), SI
        self._held, self._along = False, True
        self._inputs = Inputs()
        self._steps = (False, False)
        bridge.on("pin", lambda _: self._pin_or_release())
        bridge.on("swap", lambda _: self._ask("swap"))
        bridge.on("back", lambda _: self._ask("back"))
        bridge.on("along", self._set_along)

    @property
    def pinned(self) -> Pinned | None:
        """A."""
        return self._board.pinned

    @property
    def answer(self) -> Solution | None:
        """A's, as last solved."""
        return self._board.answer

    def solve(self, present: Design, hurried: bool = False) -> Solution | None:
        """A's answer beside the present design; None when nothing is pinned. `hurried`: newer input waits."""
        return self._board.solve(present, self._along, hurried)

    def settle(self, inputs: Inputs, solution: Solution | None, context: TabContext) -> bool:
        """Do what was asked, with what is on the sliders and its answer; whether that moves the sliders."""
        able = solution if solution is not None and solution.converged else None
        outcome = self._board.settle(inputs, able, self._along)
        if outcome is None:
            return False
        if outcome.sentence:
            context.notify("A and B", outcome.sentence)
        if outcome.inputs is not None:
            context.set_inputs(outcome.inputs)
        return outcome.inputs is not None

    def bind(self, context: TabContext) -> None:
        """Its commands; undo and redo have theirs."""
        context.bind_command("pin", self._pin_or_release)
        context.bind_command("swap", lambda: self._ask("swap"))
        context.bind_command("back", lambda: self._ask("back"))

    def hold(self, held: bool) -> None:
        """Take the buttons from the user, or give them back."""
        self._held = held
        self.refresh()

    def pin_inputs(self, inputs: Inputs | None) -> None:
        """Pin these inputs as A, whatever is on the sliders; None removes the pin."""
        self._board.put(inputs)
        self._wake()

    def show_design(self, inputs: Inputs, steps: tuple[bool, bool]) -> None:
        """What is on the sliders, and whether there is a step to undo and one to redo."""
        self._inputs, self._steps = inputs, steps
        self.refresh()

    def show(self, state: SessionState) -> None:
        """Follow a converged state."""
        self._units = UNITS[state.view.units]
        self.refresh()

    def show_failure(self) -> None:
        """A holds all the same."""
        self.refresh()

    def stop(self) -> None:
        """Nothing runs on."""

    def refresh(self) -> None:
        """Send what the bar shows."""
        undo, redo = self._steps
        self._bridge.set(
            bar={
                "rotors": list(menu_titles(self._inputs.own_rotor).items()),
                "rotor": self._inputs.rotor,
                "mode": self._layout.mode,
                "drawer": self._layout.drawer,
                "undo": undo,
                "redo": redo,
                "pinned": self._pinned(),
                "held": self._held,
            }
        )

    def _pinned(self) -> dict[str, object] | None:
        pinned, answer = self._board.pinned, self._board.answer
        if pinned is None:
            return None
        power = (
            "no trim at this condition"
            if answer is None or not answer.converged
            else self._units.watts(answer.power.total)
        )
        where = "" if self._along else f" at {pinned.flight}"
        return {"title": pinned.title, "power": power + where, "along": self._along}

    def _pin_or_release(self) -> None:
        self._ask("pin" if self.pinned is None else "unpin")

    def _set_along(self, along: bool) -> None:
        self._along = bool(along)
        self._wake()

    def _ask(self, order: Order) -> None:
        if not self._held:
            self._board.ask(order)
            self._wake()
