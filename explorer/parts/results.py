"""Power, the charts below the scene, what a step of each slider changes, and the inset of the blade."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from rotor.support.chart import DrawnChart

Kind = Literal["", "good", "bad"]
"""The colour of a change."""


@dataclass(frozen=True)
class LineStatus:
    """The end of the line: whether the answer can be trusted."""

    kind: Literal["converged", "care", "problem"]
    words: str
    title: str


@dataclass(frozen=True)
class PowerShare:
    """A part of the power; `share`: of all parts that need power."""

    part: str
    name: str
    value: str
    share: float
    title: str


@dataclass(frozen=True)
class PowerPart:
    """The power card: its parts and why it changed.

    `ideal`: least induced power at this lift, as a share of all parts.
    """

    parts: Sequence[PowerShare] = ()
    ideal: float | None = None
    ideal_title: str = ""
    why: str = ""


@dataclass(frozen=True)
class LineControl:
    """A number of the line, which moves a slider of the page; `words`: with its unit.

    `name`: of this number, no two of a line are alike; `slider`: of what it moves. `value`, `low`, `high`, `step` are
    those of the slider, in the unit shown. The line has `factor` times them, with so many `digits`; `signed`: with a
    plus sign.
    """

    name: str
    slider: str
    label: str
    words: str
    unit: str
    value: float
    low: float
    high: float
    step: float
    digits: int
    factor: float = 1.0
    signed: bool = False


@dataclass(frozen=True)
class LineOption:
    """A value that a word of the line can take: its title, and the press of the page that chooses it."""

    title: str
    press: str
    value: str | int
    chosen: bool = False


@dataclass(frozen=True)
class LineMenu:
    """The values that a word of the line can take. `name`: of the word, as of a `LineControl`."""

    name: str
    label: str
    options: Sequence[LineOption]


@dataclass(frozen=True)
class LinePiece:
    """Some words of the line. `part`: what they are, empty for what the hand has set; `stale`: of another design.

    `control`, `menu`: what opens below them.
    """

    text: str
    part: str = ""
    kind: Kind = ""
    stale: bool = False
    title: str = ""
    control: LineControl | None = None
    menu: LineMenu | None = None


@dataclass(frozen=True)
class LinePart:
    """The sentence on top. `problem`: why there is no trim; the other parts then show the last one."""

    pieces: Sequence[LinePiece]
    status: LineStatus
    problem: str = ""


@dataclass(frozen=True)
class SliderSaving:
    """What a step up of a slider changes, its `size` 0…1, and which way saves power.

    `stale`: it belongs to the design before this one.
    """

    way: Literal["up", "down", ""]
    value: str
    unit: str
    size: float
    sentence: str
    stale: bool


@dataclass(frozen=True)
class MarkedSpeeds:
    """Advance ratios on the chart of power: now, and of the last trim or where the engines give no more."""

    mu: float
    fastest: float


@dataclass(frozen=True)
class StripChart:
    name: str
    kind: Kind
    stale: bool
    chart: DrawnChart
    speeds: MarkedSpeeds | None = None


@dataclass(frozen=True)
class InsetSection:
    """A section of the inset: points [forward, up] about the quarter chord, in reference chords, and angles [°]."""

    r: float
    outline: Sequence[Sequence[float]]
    theta: float
    overlay: float | None


@dataclass(frozen=True)
class InsetBlade:
    """The blade of the inset from the side of its tip, and its overlay; angles are true twist [°].

    They are drawn `times` as large about the twist at 0.75 R, the `datum`. `theta` and `overlay` are at the stations
    `r`.
    """

    times: float
    r: Sequence[float]
    datum: float
    overlay_datum: float
    theta: Sequence[float]
    overlay: Sequence[float] | None
    cuts: Sequence[InsetSection]


@dataclass(frozen=True)
class InsetPart(InsetBlade):
    name: str
    name_hint: str
    overlay_name: str
    overlay_hint: str


@dataclass(frozen=True)
class LeastPower:
    """The twist [°] and the least power of the station in the hand, and whether it is held there.

    Power is in the unit of the page.
    """

    theta: float
    power: float
    held: bool


@dataclass(frozen=True)
class HandPart:
    """Power beside the blade, while a station of it is held; numbers are in the unit of the page.

    `optimised`: power of the optimiser's design.
    """

    power: str
    change: str
    now: float
    before: float
    digits: int
    place: str
    best: LeastPower | None
    optimised: float | None
