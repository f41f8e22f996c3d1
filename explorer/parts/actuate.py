"""What Actuate shows: dial and front of n/rev twist, the flight, the balance of power, what would pay."""

from dataclasses import dataclass
from typing import Literal

from rotor.support.chart import DrawnChart

Kind = Literal["ready", "computing", "problem"]
Sign = Literal["", "gain", "loss"]


@dataclass(frozen=True)
class ModelChanges:
    """Changes of power, in the unit of the dial, and of the index [%]: with the inflow model of the design first."""

    power: tuple[float, ...]
    index: tuple[float, ...]


@dataclass(frozen=True)
class DialPart:
    """The dial of twist at n/rev, with amplitudes and phases [°].

    `now`: n, amplitude and phase. `reach`: its radius. `whole`: amplitude of half the voltage range, of which steady
    voltage leaves the share `room`. `words`: why nothing is foreseen. `front`: changes of power and index [%], cosine
    and sine parts of each harmonic.
    """

    harmonics: tuple[int, ...]
    now: tuple[tuple[int, float, float], ...]
    reach: float
    whole: float
    room: float
    rings: tuple[tuple[float, str], ...]
    words: str
    computing: bool
    settled: ModelChanges | None
    problem: str
    against: str
    where: str
    unit: str
    per_watt: float
    front: tuple[tuple[float, float, tuple[float, ...]], ...]
    exaggerated: str
    shake: float


@dataclass(frozen=True)
class DialNumbers:
    """Harmonics of the hub loads and the power, their slopes and curvatures by cosine and sine parts [°].

    `power` [W] and `index` [%] are those without twist at n/rev.
    """

    base: list[float]
    slopes: list[list[float]]
    second: list[list[list[float]]]
    gains: list[float]
    power: float
    index: float


@dataclass(frozen=True)
class DialMatrix(DialNumbers):
    """The numbers with the inflow model of the design, and with the others."""

    inflows: tuple[DialNumbers, ...]


@dataclass(frozen=True)
class FlightPart:
    """Tip twist from hover to fast flight, and where the design flies: `at`, counted in legs from 0.

    `legs`: name and condition of each. `hours`: of each in the mission; `assumed`: whether nobody set them. `state`: of
    the actuator; `states`: all, with what they are called. `words`: how it flies there. `tip`: the twist of that state.
    """

    legs: tuple[tuple[str, str], ...]
    hours: tuple[float, ...]
    assumed: bool
    at: float
    kind: Kind
    words: str
    state: str
    states: tuple[tuple[str, str], ...]
    tip: str
    chart: DrawnChart


@dataclass(frozen=True)
class PowerBar:
    name: str
    value: float
    """In the unit of the part."""
    text: str
    kind: Sign
    total: bool
    band: float = 0.0
    """Either side of `value`, 0: not known."""
    title: str = ""
    """With the band, and whether the sign is known."""


@dataclass(frozen=True)
class EarnsPart:
    """The balance of power that the actuator needs: in this flight (`here`), or over the mission."""

    kind: Kind
    unit: str
    here: bool = False
    where: str = ""
    bars: tuple[PowerBar, ...] = ()
    fuel: str = ""
    fuel_kind: Sign = ""
    fuel_note: str = ""


@dataclass(frozen=True)
class AssessedPart:
    """The actuator as set, in words: what it moves and costs, and gives over the mission.

    `tip`, `reach`: twist at the tip in flight. `masses`: name and kilograms of each part. `flight`: what it gives by
    schedule over the mission, or why it cannot work; `flights`: the mission, and what it would give. `vibration`: of
    this flight. `over`: limits that are exceeded, `required`: those that only the best twist would exceed; `feasible`:
    what a press changes so that it can be built. `baselines`: name and title of each blade that changes may count from;
    `against`: the name of the one that they do. `sentence`: all of it. `pays`: words, and every second one a number
    with which it would pay, the other as it is: `range` of twist [°], `kilograms`.
    """

    tip: str
    reach: str
    mass: str
    masses: tuple[tuple[str, str], ...]
    flight: str
    flights: str
    vibration: str
    problem: str
    over: tuple[str, ...]
    required: tuple[str, ...]
    feasible: str
    against: str
    baselines: tuple[tuple[str, str], ...]
    sentence: str
    pays: tuple[str, ...]
    range: float
    kilograms: float


@dataclass(frozen=True)
class SupposePart:
    """The break-even line with a supposed actuator at a twist [°] and a mass [kg]."""

    words: str
    kind: Sign = ""
    note: str = ""
    chart: DrawnChart | None = None
    at: tuple[float, float] | None = None
