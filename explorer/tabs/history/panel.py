"""Undo, redo, the strip of steps and the kept designs of one session."""

import threading

import viser

from explorer.interface import SessionState, TabContext
from explorer.state import Inputs
from explorer.tabs.history import strip as view
from explorer.tabs.history.strip import FIELD, MOST_KEPT
from explorer.text.glossary import hint
from explorer.text.units import UNITS
from explorer.undo import History, KeptDesign
from rotor.trim.solution import Solution


class HistoryPanel:
    """One session's. Buttons act at once, on any thread; steps are taken on the session's worker."""

    def __init__(self, gui: viser.GuiApi, context: TabContext, start: Inputs) -> None:
        self._context = context
        self._lock = threading.RLock()
        self._history = History(start)
        self._powers: dict[Inputs, float] = {}
        self._kept: list[KeptDesign] = []
        self._drawn: object = None
        with gui.add_folder("History"):
            self._strip = gui.add_html("")
            keep = gui.add_button("Keep this design", color="gray", hint=hint("keep"))
            self._rows = gui.add_html("")
            gui.add_html('<div class="rx-bridge"></div>')  # The style sheet hides the row after it.
            self._field = gui.add_text(FIELD, "", hint=hint("take"))
        for name, act in (("undo", self.undo), ("redo", self.redo), ("keep", self.keep)):
            context.bind_command(name, act)
        keep.on_click(lambda _: self.keep())
        self._field.on_update(lambda event: self._asked() if event.client is not None else None)

    def read(self, pause: float) -> Inputs:
        """The inputs of a round that begins, taken as a step; `pause`: the longest [s] in moving them."""
        with self._lock:  # Between undoing a step and moving the widgets, they are no new step.
            inputs = self._context.inputs()
            self._history.note(inputs, pause)
        return inputs

    def grab(self, held: bool) -> None:
        """A blade or a curve is taken by the hand, or let go: what moves in between is one step."""
        with self._lock:
            if held:
                self._history.hold()
            else:
                self._history.note(self._context.inputs(), 0.0)
                self._history.release()

    def solved(self, inputs: Inputs, power: float) -> None:
        """They have an answer: total power [W]."""
        self._powers[inputs] = power

    def undo(self) -> None:
        with self._lock:
            self._take(self._history.undo())

    def redo(self) -> None:
        with self._lock:
            self._take(self._history.redo())

    def keep(self) -> None:
        """Set the present design aside; the oldest goes when there are too many."""
        state = self._context.state()
        if state is None:
            return
        with self._lock:
            others = [item for item in self._kept if item.inputs != state.inputs]
            self._kept = [*others, KeptDesign(state.inputs, state.solution)][-MOST_KEPT:]
        self._context.wake()

    @property
    def kept(self) -> tuple[KeptDesign, ...]:
        """Oldest first."""
        with self._lock:
            return tuple(self._kept)

    def show(self, state: SessionState) -> None:
        self._draw(state.solution)

    def show_failure(self) -> None:
        self._draw(None)

    def stop(self) -> None:
        """Nothing runs on."""

    @property
    def steps(self) -> tuple[bool, bool]:
        """Whether there is a step to undo, and one to redo."""
        with self._lock:
            return bool(self._history.past), bool(self._history.future)

    def _draw(self, solution: Solution | None) -> None:
        with self._lock:
            steps, present, kept = self._history.steps, len(self._history.past), tuple(self._kept)
            self._powers = {step: self._powers[step] for step in steps if step in self._powers}
            units = UNITS[self._context.view().units]
            if self._drawn == (steps, present, kept, solution, units):
                return
            self._drawn = (steps, present, kept, solution, units)
            strip = view.strip(self._history, self._powers, units) + view.caption(self._history)
        self._strip.content = f'<div class="rx">{strip}</div>'
        self._rows.content = f'<div class="rx">{view.kept_rows(kept, solution, units)}</div>'

    def _take(self, inputs: Inputs | None) -> None:
        """Move the widgets, under the lock."""
        if inputs is None:
            self._context.wake()
        else:
            self._context.set_inputs(inputs)

    def _asked(self) -> None:
        asked = view.asked(self._field.value)
        self._field.value = ""  # The same click again is a change again.
        if asked is None:
            return
        verb, which = asked
        with self._lock:
            if verb == "step":
                taken = self._history.go(which)
            elif which >= len(self._kept):
                taken = None
            elif verb == "drop":
                taken = None
                del self._kept[which]
            else:
                taken = self._kept[which].inputs
            self._take(taken)
