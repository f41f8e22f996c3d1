"""The bar at the top: rotor, mode, undo, redo, and the design that is pinned as A with its menu."""

from explorer.model.inputs import Inputs, menu_titles
from explorer.model.pinned import Order
from explorer.model.session_state import SessionState
from explorer.tabs.context import Tab, TabContext
from explorer.text.design_words import flight_name, pinned_name
from rotor.design.design import Design
from rotor.trim.solution import Solution


class TopBar(Tab):
    def __init__(self, context: TabContext) -> None:
        self._context, self._board = context, context.pinboard
        self._along = True
        """Whether A flies in the present condition."""
        self._inputs = Inputs()
        self._steps = (False, False)
        bridge, bind = context.bridge, context.keyboard.bind
        bridge.on("pin", lambda _: self._pin_or_release())
        bridge.on("swap", lambda _: self._ask("swap"))
        bridge.on("back", lambda _: self._ask("back"))
        bridge.on("along", self._set_along)
        bind("pin", self._pin_or_release)
        bind("swap", lambda: self._ask("swap"))
        bind("back", lambda: self._ask("back"))
        context.layout.watchers.append(self.refresh)

    def solve(self, present: Design, hurried: bool = False) -> Solution | None:
        """A's answer beside the present design; None when nothing is pinned. `hurried`: newer input waits."""
        return self._board.solve(present, self._along, hurried)

    def pin_or_swap(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what was asked, with what is on the sliders and its answer; whether that moves the sliders."""
        able = solution if solution is not None and solution.converged else None
        outcome = self._board.act(inputs, able, self._along)
        if outcome is None:
            return False
        if outcome.sentence:
            self._context.notify("A and B", outcome.sentence)
        if outcome.inputs is not None:
            self._context.set_inputs(outcome.inputs)
        return outcome.inputs is not None

    def show_design(self, inputs: Inputs, steps: tuple[bool, bool]) -> None:
        """What is on the sliders, and whether there is a step to undo and one to redo."""
        self._inputs, self._steps = inputs, steps
        self.refresh()

    def show(self, state: SessionState) -> None:
        self.refresh()

    def show_failure(self) -> None:
        self.refresh()

    def refresh(self) -> None:
        undo, redo = self._steps
        layout = self._context.layout
        self._context.bridge.set(
            bar={
                "rotors": list(menu_titles(self._inputs.own_rotor).items()),
                "rotor": self._inputs.rotor,
                "mode": layout.mode,
                "drawer": layout.drawer,
                "undo": undo,
                "redo": redo,
                "pinned": self._pinned(),
                "held": self._context.held,
            }
        )

    def _pinned(self) -> dict[str, object] | None:
        pinned, answer = self._board.pinned, self._board.answer
        if pinned is None:
            return None
        power = (
            "no trim at this condition"
            if answer is None or not answer.converged
            else self._context.units.watts(answer.power.total)
        )
        where = "" if self._along else f" at {flight_name(pinned.inputs)}"
        return {"title": pinned_name(pinned), "power": power + where, "along": self._along}

    def _pin_or_release(self) -> None:
        self._ask("pin" if self._board.pinned is None else "unpin")

    def _set_along(self, along: bool) -> None:
        self._along = bool(along)
        self._context.wake()

    def _ask(self, order: Order) -> None:
        if not self._context.held:
            self._board.ask(order)
            self._context.wake()
