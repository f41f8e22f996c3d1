"""The frame about the scene: top bar, buttons of the views, bars of words, and the lecture."""

from collections.abc import Sequence
from dataclasses import dataclass

from rotor.chart import DrawnChart

Button = tuple[str, str]
"""What a press says to the page, and the title."""


@dataclass(frozen=True)
class PinnedRow:
    """What is said of A."""

    title: str
    power: str
    along: bool
    """Whether it flies in the present condition."""


@dataclass(frozen=True)
class BarPart:
    """The bar at the top."""

    rotors: Sequence[tuple[str, str]]
    """Name and title of each."""
    rotor: str
    mode: str
    drawer: str
    """Empty: none is open."""
    undo: bool
    redo: bool
    pinned: PinnedRow | None
    held: bool
    """Whether a presenter moves the page."""


@dataclass(frozen=True)
class ViewsPart:
    all: Sequence[Button]
    now: str


@dataclass(frozen=True)
class NoticePart:
    """The bar over the scene while it shows something else than the sliders."""

    text: str
    actions: Sequence[Button]


@dataclass(frozen=True)
class StepControl:
    label: str
    kind: str
    words: Sequence[str]
    """One a position; empty while they are computed."""


@dataclass(frozen=True)
class StepPart:
    """What a step of the lecture says before the guess."""

    name: str
    title: str
    watch: str
    a: str
    b: str
    question: str
    options: Sequence[str]
    todo: str
    control: StepControl
    last: bool


@dataclass(frozen=True)
class StepAnswer:
    """What it says after the guess."""

    right: int
    """Place of the right option."""
    answer: str
    chart: DrawnChart
    dots: Sequence[Sequence[tuple[float, float, str]]]
    """x, y and colour of each, by position of the control."""


@dataclass(frozen=True)
class LecturePart:
    """Where the lecture stands."""

    at: int
    """Step, from 0."""
    guess: int | None
    answer: StepAnswer | None
    stop: int
    """Position of the control."""
    figures: Sequence[tuple[str, str]]
    """Caption and value of each."""
    busy: bool
    problem: str
    held: bool
    finish: str
    """Title of the button behind the last step."""
