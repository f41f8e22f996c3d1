"""What Actuate shows: dial and front of n/rev twist, the flight, the balance of power, what would pay, labels."""

from dataclasses import dataclass
from typing import Literal

from rotor.chart import DrawnChart

Kind = Literal["ready", "computing", "problem"]
Sign = Literal["", "gain", "loss"]


@dataclass(frozen=True)
class Settled:
    """What a trim gave, with the inflow model of the design first."""

    power: tuple[float, ...]
    """Changes, in the unit of the dial."""
    index: tuple[float, ...]
    """[%]"""


@dataclass(frozen=True)
class DialPart:
    """The dial of twist at n/rev."""

    harmonics: tuple[int, ...]
    now: tuple[tuple[int, float, float], ...]
    """n, amplitude and phase [°]."""
    reach: float
    """Its radius [°]."""
    whole: float
    """Amplitude of half the voltage range [°]."""
    room: float
    """Share of it that steady voltage leaves."""
    rings: tuple[tuple[float, str], ...]
    """Radius [°] and its words."""
    words: str
    """Why nothing is foreseen; empty where something is, or will be."""
    computing: bool
    settled: Settled | None
    problem: str
    against: str
    where: str
    unit: str
    per_watt: float
    front: tuple[tuple[float, float, tuple[float, ...]], ...]
    """Changes of power and index [%], cosine and sine parts of each harmonic [°]."""
    exaggerated: str
    shake: float
    held: bool


@dataclass(frozen=True)
class DialNumbers:
    """Harmonics of the hub loads and the power, their slopes and curvatures by cosine and sine parts [°]."""

    base: list[float]
    slopes: list[list[float]]
    second: list[list[list[float]]]
    gains: list[float]
    power: float
    """Of the blade compared with [W]."""
    index: float
    """Of the blade compared with [%]."""


@dataclass(frozen=True)
class DialMatrix(DialNumbers):
    """The numbers with the inflow model of the design."""

    inflows: tuple[DialNumbers, ...]
    """With the others."""


@dataclass(frozen=True)
class FlightPart:
    """Tip twist from hover to fast flight, and where the design flies."""

    legs: tuple[tuple[str, str], ...]
    """Name and condition."""
    at: float
    """Place on the bar, from 0 at the first leg."""
    kind: Kind
    words: str
    flown: bool
    frozen: float | None
    """Twist of an actuator that has stopped [°]."""
    tip: str
    chart: DrawnChart


@dataclass(frozen=True)
class Bar:
    """Power that one cause needs."""

    name: str
    value: float
    text: str
    kind: Sign
    total: bool


@dataclass(frozen=True)
class EarnsPart:
    """The balance of power that the actuator needs."""

    kind: Kind
    unit: str
    problem: str
    mission: str
    where: str = ""
    bars: tuple[Bar, ...] = ()
    against: str = "best fixed blade"
    fuel: str = ""
    fuel_kind: Sign = ""
    fuel_note: str = ""
    mass: str = ""
    mass_note: str = ""


@dataclass(frozen=True)
class SupposePart:
    """The break-even line with a supposed actuator."""

    words: str
    kind: Sign = ""
    note: str = ""
    chart: DrawnChart | None = None
    at: tuple[float, float] | None = None
    """[°, kg]"""


@dataclass(frozen=True)
class LiftedLabel:
    """Words beside the lifted blade."""

    text: str
    node: str
    at: list[float]
    """In the axes of the node [m]."""
    kind: str
