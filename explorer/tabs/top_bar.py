"""The row above the tabs, always at hand: undo, redo, pin; and while a design is pinned, what A is and its buttons."""

from collections.abc import Callable
from typing import Any

import viser

from explorer.interface import SessionState, TabContext
from explorer.pinned import Order, Pinboard, Pinned
from explorer.state import Inputs
from explorer.text import comparison as ab_readout
from explorer.text.glossary import hint
from explorer.text.units import SI, UNITS
from rotor.design.design import Design
from rotor.trim.solution import Solution

_PIN: dict[str, Order] = {"Pin as A": "pin"}
_PINNED: dict[str, Order] = {"Swap A and B": "swap", "Back to A": "back", "Unpin": "unpin"}


class TopBar:
    """One session's."""

    def __init__(
        self,
        gui: viser.GuiApi,
        wake: Callable[[], None],
        undo: Callable[[], None],
        redo: Callable[[], None],
    ) -> None:
        self._board, self._wake, self._units = Pinboard(), wake, SI
        self._held = False
        self._steps = {"Undo": undo, "Redo": redo}
        self._first = gui.add_button_group("", (*self._steps, *_PIN), hint=hint("pin"))
        self._line = gui.add_html("", visible=False)
        self._second = gui.add_button_group(
            "",
            tuple(_PINNED),
            visible=False,
            hint=hint("pinned"),
        )
        self._along = gui.add_checkbox(
            "A flies along",
            True,
            visible=False,
            hint=hint("along"),
        )
        self._first.on_click(self._clicked)
        self._second.on_click(self._clicked)
        self._along.on_update(lambda _: wake())

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
        return self._board.solve(present, self._along.value, hurried)

    def settle(self, inputs: Inputs, solution: Solution | None, context: TabContext) -> bool:
        """Do what was asked, with what is on the sliders and its answer; whether that moves the sliders."""
        able = solution if solution is not None and solution.converged else None
        outcome = self._board.settle(inputs, able, self._along.value)
        if outcome is None:
            return False
        if outcome.sentence:
            context.notify("A and B", outcome.sentence)
        if outcome.inputs is not None:
            context.set_inputs(outcome.inputs)
        return outcome.inputs is not None

    def bind(self, context: TabContext) -> None:
        """Its commands; undo and redo have theirs."""
        context.bind_command("pin", lambda: self._ask("pin" if self.pinned is None else "unpin"))
        context.bind_command("swap", lambda: self._ask("swap"))
        context.bind_command("back", lambda: self._ask("back"))

    def hold(self, held: bool) -> None:
        """Take the buttons from the user, or give them back."""
        self._held = held
        self._first.visible = not held
        self.refresh()

    def pin_inputs(self, inputs: Inputs | None) -> None:
        """Let these inputs be A, whatever is on the sliders; None: nothing."""
        self._board.put(inputs)
        self._wake()

    def show(self, state: SessionState) -> None:
        """Follow a converged answer."""
        self._units = UNITS[state.view.units]
        self.refresh()

    def show_failure(self) -> None:
        """A holds all the same."""
        self.refresh()

    def stop(self) -> None:
        """Nothing runs on."""

    def refresh(self) -> None:
        """What A is, and its power now."""
        pinned = self._board.pinned
        if pinned is not None:
            where = "" if self._along.value else pinned.flight
            self._line.content = ab_readout.pinned_line(pinned.title, self._board.answer, where, self._units)
        self._line.visible = pinned is not None
        for widget in (self._second, self._along):
            widget.visible = pinned is not None and not self._held

    def _clicked(self, event: viser.GuiEvent[Any]) -> None:
        name = event.target.value
        if name in self._steps:
            self._steps[name]()
            return
        self._ask((_PIN | _PINNED)[name])

    def _ask(self, order: Order) -> None:
        self._board.ask(order)
        self._wake()
