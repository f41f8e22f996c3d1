"""Power, the charts below the scene, what a step of each slider changes, and the inset of the blade."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from rotor.chart import DrawnChart

Kind = Literal["", "good", "bad"]
"""The colour of a change."""


@dataclass(frozen=True)
class Status:
    """The chip of the power card."""

    kind: Literal["converged", "care", "problem"]
    words: str
    title: str
    measured: str = ""
    """How well this rotor is validated here; empty where there is no trim."""


@dataclass(frozen=True)
class Share:
    """A part of the power."""

    part: str
    name: str
    value: str
    share: float
    """Of all parts that need power."""
    title: str


@dataclass(frozen=True)
class Since:
    """The change since the grab, or from the reference."""

    value: str
    words: str
    kind: Kind


@dataclass(frozen=True)
class Sureness:
    """How sure the power and its change are."""

    within: str = ""
    """Band of the power, in its unit."""
    change_within: str = ""
    """Band of the change [%]."""
    sure: str = ""
    """Whether the sign of the change is known."""
    doubt: str = ""
    """All of it, as a sentence."""


@dataclass(frozen=True, kw_only=True)
class PowerPart(Sureness):
    """The power card."""

    status: Status
    total: str = "–"
    unit: str = "kW"
    change: str = "–"
    kind: Kind = ""
    against: str = "as built"
    parts: Sequence[Share] = ()
    ideal: float | None = None
    """Least induced power at this lift, as a share of all parts."""
    ideal_title: str = ""
    since: Since | None = None
    rest: str = ""
    """In its place, while nothing has changed."""
    why: str = ""
    problem: str = ""
    """Why there is no trim; the numbers are those of the last one."""


@dataclass(frozen=True)
class Worth:
    """What a step up of a slider changes."""

    way: Literal["up", "down", ""]
    """Which way saves power."""
    value: str
    unit: str
    size: float
    """Of the change, 0…1."""
    sentence: str
    stale: bool
    """Whether it belongs to the design before this one."""


@dataclass(frozen=True)
class Speeds:
    """Advance ratios on the chart of power."""

    mu: float
    fastest: float
    """Of the last trim, or where the engines give no more."""


@dataclass(frozen=True)
class StripChart:
    """A chart below the scene."""

    name: str
    kind: Kind
    faded: bool
    chart: DrawnChart
    speeds: Speeds | None = None


@dataclass(frozen=True)
class Cut:
    """A section of the inset."""

    r: float
    outline: Sequence[Sequence[float]]
    """Points [forward, up] about the quarter chord, in reference chords."""
    theta: float
    """[°]"""
    ghost: float | None


@dataclass(frozen=True)
class InsetBlade:
    """The blade of the inset from the side of its tip, and its ghost; angles are true twist [°]."""

    times: float
    """The exaggeration to draw the angles with."""
    r: Sequence[float]
    """Stations along the edges."""
    datum: float
    """Twist at 0.75 R, about which it is exaggerated."""
    ghost_datum: float
    theta: Sequence[float]
    """At the stations."""
    ghost: Sequence[float] | None
    cuts: Sequence[Cut]


@dataclass(frozen=True)
class InsetPart(InsetBlade):
    """The inset with the names of its two blades."""

    name: str
    name_hint: str
    ghost_name: str
    ghost_hint: str


@dataclass(frozen=True)
class Best:
    """The twist of least power of the station that is held."""

    theta: float
    """[°]"""
    power: float
    """In the unit of the page."""
    held: bool
    """Whether the station is held there."""


@dataclass(frozen=True)
class HandPart:
    """Power beside the blade, while a station of it is held."""

    power: str
    change: str
    kind: Kind
    now: float
    """Power in the unit of the page."""
    before: float
    digits: int
    place: str
    best: Best | None
    rival: float | None
    """Power of the optimiser's design."""
