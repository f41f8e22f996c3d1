"""Undo, redo, the strip of steps and the kept designs of one session."""

import threading
from collections.abc import Callable

import viser

from explorer.hosting import browser
from explorer.interface import SessionState, TabContext
from explorer.sharing import stored_history
from explorer.sharing.stored_history import StoredHistory
from explorer.state import Inputs
from explorer.tabs.history import strip as view
from explorer.tabs.history.strip import FIELD, MOST_KEPT
from explorer.text.glossary import hint
from explorer.text.units import UNITS
from explorer.undo import History, KeptDesign
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


class HistoryPanel:
    """One session's. Buttons act at once, on any thread; steps are taken on the session's worker."""

    def __init__(self, client: viser.ClientHandle, context: TabContext, start: Inputs, stored: str | None) -> None:
        """`stored`: the history as the page kept it over a reload; None where it has none."""
        self._client, self._context = client, context
        gui = client.gui
        self._lock = threading.RLock()
        before = stored_history.read_history(stored, start)
        self._history = History(start, list(before.past), list(reversed(before.future)))
        self._stored = stored
        self._powers: dict[Inputs, float] = {}
        self._kept: list[KeptDesign] = []
        self._waiting = list(before.bookmarks)
        """Kept designs of before a reload, to be solved once the page rests."""
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
        """A blade, a curve or a slider is taken by the hand, or let go: what moves in between is one step."""
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

    def store(self) -> None:
        """Give the page the history to keep, now that it rests; a reload or a restart of the server restores it."""
        with self._lock:
            history, bookmarks = self._history, (*self._waiting, *(item.inputs for item in self._kept))
            future = tuple(reversed(history.future))
            kept = StoredHistory(tuple(history.past), history.present, future, bookmarks)
        text = kept.text()  # A hundred designs: nobody need wait for them.
        if text != self._stored:
            self._stored = text
            browser.keep(self._client, stored_history.NAME, text)

    def rest(self, stop: Callable[[], bool]) -> None:
        """Solve the designs that were kept before a reload, until `stop`."""
        while self._waiting and not stop():
            inputs = self._waiting[-1]
            solution = solve(inputs.design())
            with self._lock:
                self._waiting.pop()
                if solution.converged and all(item.inputs != inputs for item in self._kept):
                    self._kept = [KeptDesign(inputs, solution), *self._kept][-MOST_KEPT:]
            if (state := self._context.state()) is not None:
                self.show(state)

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
