"""The frame about the scene: top bar, buttons of the views, bars of words, and the lecture."""

from collections.abc import Sequence
from dataclasses import dataclass

from rotor.support.chart import DrawnChart

Button = tuple[str, str]
"""What a press says to the page, and the title."""


@dataclass(frozen=True)
class PinnedRow:
    """What is said of A; `along`: it flies in the present condition."""

    title: str
    power: str
    along: bool


@dataclass(frozen=True)
class BarPart:
    """The bar at the top; `rotors`: name and title of each."""

    rotors: Sequence[tuple[str, str]]
    rotor: str
    mode: str
    drawer: str
    undo: bool
    redo: bool
    pinned: PinnedRow | None


@dataclass(frozen=True)
class ViewsPart:
    all: Sequence[Button]
    now: str
    missing: str
    """Why there is no scene and what to do; empty where it is drawn."""


@dataclass(frozen=True)
class NoticePart:
    """The bar over the scene while it shows something else than the sliders."""

    text: str
    actions: Sequence[Button]


@dataclass(frozen=True)
class StepControl:
    """`words`: one a position; none while they are computed."""

    label: str
    kind: str
    words: Sequence[str]


@dataclass(frozen=True)
class StepPart:
    """What a step of the lecture says before the guess."""

    name: str
    title: str
    watch: str
    question: str
    options: Sequence[str]
    todo: str
    control: StepControl
    last: bool


@dataclass(frozen=True)
class StepAnswer:
    """What it says after the guess, `right` being the place of the right option, `open` of others within its band.

    `dots`: x, y and colour of each, by position of the control.
    """

    right: int
    open: Sequence[int]
    answer: str
    chart: DrawnChart
    dots: Sequence[Sequence[tuple[float, float, str]]]


@dataclass(frozen=True)
class LecturePart:
    """Where the lecture stands: at which step, from 0, and at which position (`stop`) of its control.

    `figures`: caption of each, its value, and its band in words. `a`, `b`: names of what is compared on the page, empty
    where nothing is. `note`: that the page shows another design than the step does.
    """

    at: int
    guess: int | None
    answer: StepAnswer | None
    stop: int
    figures: Sequence[tuple[str, str, str]]
    a: str
    b: str
    note: str
    busy: bool
    problem: str
