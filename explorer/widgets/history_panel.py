"""Undo, redo, and the kept designs; a click goes to one."""

import math
import threading
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from explorer.colours import THIS
from explorer.hosting import browser
from explorer.model.actuator_inputs import ActuatorInputs, HandSettings
from explorer.model.inputs import Inputs
from explorer.model.session_state import Compared, SessionState
from explorer.model.undo import History, KeptDesign
from explorer.model.units import SI, Units
from explorer.sharing import share
from explorer.sharing.share import StoredHistory
from explorer.text.design_words import flight_name, title_words
from explorer.text.glossary import hint
from explorer.widgets.context import TabContext
from explorer.widgets.layout import by_hand
from rotor import Solution, solve
from rotor.support.markup import Markup, tag

FIELD = "Take design"
"""Label of the text field that clicks are written to: `take 1`, `drop 1`."""
MOST_KEPT = 8
_SPARK = 46.0, 18.0


Step = tuple[Inputs, ActuatorInputs | None, Compared | None]
"""What sliders, Actuate and A have; None, of a page that opens or was loaded again: actuator and A stay as they are."""


def kept_rows(kept: Sequence[KeptDesign], units: Units = SI) -> Markup:
    """The kept designs: outline of the twist, name and power."""
    if not kept:
        return tag("div.rx-dim.rx-small", "No bookmarks yet. Press Keep to add this design.")
    rows: list[Markup] = []
    for k, item in enumerate(kept):
        take, drop = (
            {"data_write": FIELD, "data_value": f"{verb} {k}"} for verb in ("take", "drop")
        )
        flight = tag("div.rx-dim.rx-small", flight_name(item.inputs, units))
        name = tag("div", title_words(item.solution.design)), flight
        rows.append(
            tag(
                "tr",
                tag("td.rx-take", _spark(item.solution), **take),
                tag("td.rx-take.rx-kept", name, **take),
                tag("td.rx-take.rx-num", units.watts(item.power), **take),
                tag("td.rx-num", tag("a.rx-take.rx-dim", "✕", title="Delete", **drop)),
            )
        )
    return tag("table.rx-kept-table", rows, data_explorer="kept")


def _spark(solution: Solution) -> Markup:
    """The twist along the blade, ±12° high."""
    width, height = _SPARK
    r = np.linspace(solution.design.rotor.blade.root_cutout, 1.0, 24)
    angle = np.clip(np.degrees(solution.design.twist(r)) / 12.0, -1.0, 1.0)
    points = " ".join(
        f"{width * x:.1f},{0.5 * height * (1.0 - y):.1f}" for x, y in zip(r, angle, strict=True)
    )
    zero = tag("path", d=f"M0,{0.5 * height} h{width}", stroke="currentColor", opacity=0.25)
    twist = tag("polyline", points=points, fill="none", stroke=THIS, stroke_width=1.6)
    return tag("svg", zero, twist, width=width, height=height)


def _apart(steps: Sequence[Inputs], present: Inputs) -> tuple[Inputs, ...]:
    """Steps on the way to the present, without those whose inputs the next one has: actuator and A are not stored."""
    following = (*steps, present)[1:]
    return tuple(one for one, after in zip(steps, following, strict=True) if one != after)


class HistoryPanel:
    """The history of a session. Buttons act at once, on any thread; steps are taken on the session's worker."""

    def __init__(
        self,
        context: TabContext,
        hand: Callable[[], HandSettings],
        set_actuator: Callable[[ActuatorInputs], None],
        start: Inputs,
        stored: str | None,
    ) -> None:
        """`hand`: what is set in Actuate; `set_actuator` sets it in any mode. `stored`: the history as the page kept it
        over a reload; None where it has none."""
        self._context, self._hand, gui = context, hand, context.gui
        self._set_actuator = set_actuator
        self._lock = threading.RLock()
        before = share.read_history(stored, start)
        past, future = (
            [Step((one, None, None)) for one in steps]
            for steps in (before.past, reversed(before.future))
        )
        self._history = History[Step]((start, None, None), past, future)
        self._stored = stored
        self._kept: list[KeptDesign] = []
        self._waiting = list(before.bookmarks)
        """Kept designs of before a reload, to be solved once the page rests."""
        self._drawn: object = None
        with gui.add_folder("History"):
            keep = gui.add_button("Keep this design", color="gray", hint=hint("keep"))
            self._rows = gui.add_html("")
            gui.add_html(tag("div.rx-bridge"))  # The style sheet hides the row after it.
            self._field = gui.add_text(FIELD, "", hint=hint("take"))
        for name, act in (("undo", self.undo), ("redo", self.redo)):
            context.keyboard.bind(name, act)
            context.bridge.on(name, lambda _, act=act: act())
        context.keyboard.bind("keep", self.keep)
        keep.on_click(lambda _: self.keep())
        by_hand(self._field, self._clicked)

    def read(self, pause: float) -> Inputs:
        """The inputs of a round that begins, taken as a step; `pause`: the longest [s] in moving them."""
        with self._lock:  # Until an undo has moved the widgets, their values are no new step.
            self._note(pause)
            return self._history.present[0]

    def grab(self, held: bool) -> None:
        """A blade, a curve or a slider is taken by the hand, or let go: what moves in between is one step."""
        with self._lock:
            if held:
                self._history.hold()
            else:
                self._note()
                self._history.release()

    def undo(self) -> None:
        with self._lock:
            self._note()
            self._move(self._history.undo())

    def redo(self) -> None:
        with self._lock:
            self._note()
            self._move(self._history.redo())

    def note_pinned(self) -> None:
        """A became another design: that is a step of its own."""
        with self._lock:
            self._note(math.inf)

    def _note(self, pause: float = 0.0) -> None:
        """What was moved since the last update is a step too."""
        present, actuator, compared = self._history.present
        now = (self._context.inputs(), self._actuator(), self._context.pinboard.compared)
        self._history.present = (present, actuator or now[1], compared or now[2])
        self._history.note(now, pause)

    def _actuator(self) -> ActuatorInputs:
        """As a hand set it: drives that follow the flight are no steps."""
        hand = self._hand()
        return hand.actuator if hand.flown is None else hand.by_hand

    def keep(self) -> None:
        """Set the present design aside; the oldest goes when there are too many."""
        state = self._context.state()
        if state is None:
            return
        with self._lock:
            others = [item for item in self._kept if item.inputs != state.inputs]
            self._kept = [*others, KeptDesign(state.inputs, state.solution.light())][-MOST_KEPT:]
        self._context.wake()

    def store(self) -> None:
        """Give the page the history to keep, now that it rests; a reload or a restart of the server restores it."""
        with self._lock:
            history, bookmarks = (
                self._history,
                (*self._waiting, *(item.inputs for item in self._kept)),
            )
            present = history.present[0]
            past = _apart([inputs for inputs, *_ in history.past], present)
            future = tuple(reversed(_apart([inputs for inputs, *_ in history.future], present)))
            kept = StoredHistory(past, present, future, bookmarks)
        text = kept.text()  # A hundred designs: nobody need wait for them.
        if text != self._stored:
            self._stored = text
            browser.store_text(self._context.client, share.STEPS_KEPT, text)

    def solve_waiting(self) -> Iterator[None]:
        """Solve the designs that were kept before a reload, yielding before each."""
        while self._waiting:
            yield
            inputs = self._waiting[-1]
            solution = solve(inputs.design())
            with self._lock:
                self._waiting.pop()
                if solution.converged and all(item.inputs != inputs for item in self._kept):
                    self._kept = [KeptDesign(inputs, solution.light()), *self._kept][-MOST_KEPT:]
            self.show(self._context.state())

    @property
    def kept(self) -> tuple[KeptDesign, ...]:
        """Oldest first."""
        with self._lock:
            return tuple(self._kept)

    def show(self, state: SessionState | None) -> None:
        del state  # What is kept does not depend on it.
        with self._lock:
            kept, units = tuple(self._kept), self._context.units
            if self._drawn == (drawn := (kept, units)):
                return
            self._drawn = drawn
        self._rows.content = tag("div.rx", kept_rows(kept, units))

    @property
    def steps(self) -> tuple[bool, bool]:
        """Whether there is a step to undo, and one to redo."""
        with self._lock:
            return bool(self._history.past), bool(self._history.future)

    def _move(self, step: Step | None) -> None:
        """Move the widgets, under the lock; the mode stays."""
        inputs, actuator, compared = step or (None, None, None)
        if actuator is not None and actuator != self._actuator():
            self._set_actuator(actuator)
        if compared is not None and compared != self._context.pinboard.compared:
            self._context.pinboard.put_back(compared)
            self._context.wake()
        if inputs is None or inputs == self._context.inputs():
            self._context.wake()
        else:
            self._context.set_inputs(inputs)

    def _clicked(self, text: str) -> None:
        self._field.value = ""  # So that the same click counts as a change again.
        verb, _, digits = text.strip().partition(" ")
        if verb not in ("take", "drop") or not digits.isdigit():
            return
        which = int(digits)
        with self._lock:
            kept = self._kept[which].inputs if which < len(self._kept) else None
            if kept is not None and verb == "drop":
                del self._kept[which]
            self._move((kept, None, None) if kept is not None and verb == "take" else None)
