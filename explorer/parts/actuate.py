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
class PowerMark:
    """A power on the scale: its name, its value in words and in the unit of the scale.

    `value` is empty and `at` None while it is computed; `stale`: it is that of the inputs before. `band`: of its change
    from the blade that changes count from, 0: not known. `flown`: this is what flies now.
    """

    name: str
    value: str
    at: float | None
    band: float = 0.0
    stale: bool = False
    flown: bool = False


@dataclass(frozen=True)
class PowerScale:
    """The powers of this flight on one axis, the smallest first; those that are computed stand last.

    `ends`: of the axis. `sentence`: all of it, to be read aloud.
    """

    unit: str
    ends: tuple[float, float]
    marks: tuple[PowerMark, ...]
    sentence: str


@dataclass(frozen=True)
class AssessedPart:
    """The actuator as set, in one row: whether it can be built, what it moves, weighs, and earns over the mission.

    `tip`, `reach`: twist at the tip in flight, `end`: the end of the reach that `tip` counts from. `earns`: change of
    power over the `mission`, `sure`: how sure it is. `vibration`: of this flight. `over`: limits that are exceeded,
    `required`: those that only the best twist would exceed; `feasible`: what a press changes so that it can be built.
    `baselines`: name and title of each blade that changes may count from; `against`: the name of the one that they do.
    `pays`: words, and every second one a number with which it would pay, the other as it is: `range` of twist [°],
    `kilograms`.
    """

    buildable: str
    tip: str
    end: str
    reach: str
    mass: str
    earns: str
    sure: str
    mission: str
    vibration: str
    problem: str
    over: tuple[str, ...]
    required: tuple[str, ...]
    feasible: str
    against: str
    baselines: tuple[tuple[str, str], ...]
    scale: PowerScale | None
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
