"""An aircraft as far as its rotor needs it, and its flight condition.

An aircraft is a main rotor, a tail rotor, drag area and mass: the contents of a rotor file. A flight condition is
altitude, temperature, weight, advance ratio, and the drag of the airframe; or a test stand, on which the rotor is fixed
to its mount. There shaft tilt, thrust or collective, and flapping are given in place of weight and drag, and tip Mach
number and air density are those of the test.
"""

import cmath
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Literal

from rotor.design.blade import Rotor
from rotor.design.quantities import (
    CONDITION,
    LOAD_KEYS,
    NUMBERS,
    QUANTITIES,
    STAND,
    UNUSUAL,
    Flapping,
)
from rotor.design.twist import TwistLaw
from rotor.support.units import GRAVITY, KNOT

SEA_LEVEL_TEMPERATURE = 288.15
"""[K] (ISO 2533)."""
SEA_LEVEL_DENSITY = 1.225
"""[kg/m³] (ISO 2533)."""
LAPSE_RATE = 0.0065
"""Troposphere temperature lapse [K/m] (ISO 2533)."""
GAS_CONSTANT = 287.05287
"""Specific gas constant of dry air [J/(kg K)] (ISO 2533)."""
RATIO_OF_SPECIFIC_HEATS = 1.4


_BY_FIELD = {row.field: row for row in STAND.values()}
"""Quantities by field."""


@dataclass(frozen=True)
class Stand:
    """The inputs of a test; exactly one of thrust, ct_over_sigma and collective is given."""

    shaft_tilt: float | None = None
    """α [rad], positive forward; left out it is 0. A free rotor finds its tilt: there it is where the search
    starts."""
    thrust: float | None = None
    """Along the shaft [N]."""
    ct_over_sigma: float | None = None
    """Thrust over ρA(ΩR)²σ."""
    collective: float | None = None
    """Pitch at 0.75 R [rad]."""
    cyclic_1c: float = 0.0
    """Given cyclic [rad], used where the flapping is free."""
    cyclic_1s: float = 0.0
    """Likewise."""
    flapping: Flapping = "trimmed"
    """`trimmed`: cyclic keeps first-harmonic flapping at its given value; `free`: the blades flap as they like;
    `hub-moments`: they do, and cyclic gives the hub the moments below."""
    hub_roll: float = 0.0
    """Moment of the rotor on its hub [N m], towards the retreating side."""
    hub_pitch: float = 0.0
    """Moment of the rotor on its hub [N m], nose up."""
    tip_mach: float | None = None
    """ΩR over the speed of sound; left out, that of the standard atmosphere."""
    density: float | None = None
    """Air density [kg/m³]; left out, that of the standard atmosphere."""

    def __post_init__(self) -> None:
        given = [name for name in LOAD_KEYS if getattr(self, STAND[name].field) is not None]
        if len(given) != 1:
            named = " and ".join(given) or "none of them"
            raise ValueError(
                f"a test stand is given {named}: give one of thrust_n, ct_over_sigma and collective_deg"
            )
        for name, row in _BY_FIELD.items():
            value = getattr(self, name)
            if row.kind == "choice":
                row.check_choice(value)
            elif value is not None:
                row.check(row.shown(value))
        if self.flapping != "free" and (self.cyclic_1c or self.cyclic_1s):
            trims = "flapping" if self.flapping == "trimmed" else "hub moments"
            raise ValueError(
                f"cyclic is given, but needed to trim the {trims}: leave it out, or set flapping to free"
            )
        if self.flapping != "hub-moments" and (self.hub_roll or self.hub_pitch):
            raise ValueError(
                "hub moments are given, but the rotor is not trimmed to them: set flapping to hub-moments"
            )

    def __str__(self) -> str:
        given = self.record().items()
        return ", ".join(
            f"{key} {value}" if isinstance(value, str) else f"{key} {value:.5g}"
            for key, value in given
        )

    @property
    def tilt(self) -> float:
        """Shaft tilt [rad], positive forward; 0 if it is not given."""
        return self.shaft_tilt or 0.0

    def record(self) -> dict[str, Any]:
        """The given inputs as a design file stores them, with angles in degrees; `read_stand` reads them back."""
        values = ((_BY_FIELD[field.name], getattr(self, field.name)) for field in fields(self))
        return {
            row.name: row.shown(value)
            for row, value in values
            if value is not None and value != row.default
        }


def read_stand(record: Mapping[str, Any], trim: str) -> Stand:
    """The stand of a record with the keys of `Stand.record`, for one of `STAND_TRIMS`.

    Flapping that is not given is trimmed in a wind tunnel, and free otherwise. Raises ValueError with one sentence.
    """
    values: dict[str, Any] = {}
    for key, value in record.items():
        if key not in STAND:
            raise ValueError(f"test stand key {key!r} is not known: use {', '.join(STAND)}")
        row = STAND[key]
        if row.numeric and (isinstance(value, bool) or not isinstance(value, int | float)):
            raise ValueError(f"test stand key {key!r} is {value!r}: give a number")
        values[row.field] = row.si(value)
    values.setdefault("flapping", "trimmed" if trim == "wind-tunnel" else "free")
    return Stand(**values)


SLOWEST_FLIGHT = 1e-9
"""Advance ratio below which a condition is hover: what divides by µ would lose its digits there."""


@dataclass(frozen=True)
class FlightCondition:
    """Steady flight, level unless it climbs, or a test of the rotor alone; hover when the advance ratio is zero."""

    advance_ratio: float
    """µ = V/(ΩR) with the horizontal speed V; 0 for less than `SLOWEST_FLIGHT`."""
    mass: float
    """[kg]"""
    altitude: float = 0.0
    """Pressure altitude in the standard atmosphere [m]."""
    isa_offset: float = 0.0
    """Temperature less that of the standard atmosphere at the same pressure [°C]: air is T/(T + offset) as dense."""
    flap_1c: float = 0.0
    """Given longitudinal flapping β1c [rad], negative when the disk tilts back; used where cyclic trims flapping."""
    flap_1s: float = 0.0
    """Given lateral flapping β1s [rad]."""
    stand: Stand | None = None
    """The inputs of a test of the rotor alone, which has neither weight nor drag to balance; None in flight."""
    climb_speed: float = 0.0
    """V_c, rate of climb [m/s], negative in descent; on a test stand that of vertical wind, down. Air density is that
    of the altitude: the climb of an instant."""

    rotor_speed_percent: float = 100.0
    """Ω over that of the rotor file [%]; the tail rotor is geared to it."""

    load_factor: float = 1.0
    """n, lift over weight, of a steady turn: lift n W cos γ across the flight path, D + W sin γ along it. Not of the
    turn: rates of roll, pitch and yaw of the shaft, and blades that weigh n times as much."""

    def __post_init__(self) -> None:
        tested = self.stand is not None
        for row in CONDITION.values():
            if not (tested and row.in_flight):
                row.check(getattr(self, row.field), tested)
        if self.advance_ratio < SLOWEST_FLIGHT:
            object.__setattr__(self, "advance_ratio", 0.0)
        if (
            self.stand is not None
            and self.stand.tip_mach is not None
            and self.rotor_speed_percent != 100.0
        ):
            raise ValueError(
                f"rotor speed {self.rotor_speed_percent:g} % and tip_mach {self.stand.tip_mach:g} both say how fast "
                "the rotor turns: give one of them"
            )
        _check("flap_1c", self.flap_1c, -0.3, 0.3, " rad")
        _check("flap_1s", self.flap_1s, -0.3, 0.3, " rad")

    @property
    def numbers(self) -> dict[str, float]:
        """The quantities of the condition by name, each in the unit of its name."""
        return {name: getattr(self, row.field) for name, row in CONDITION.items()}

    @property
    def unusual(self) -> dict[str, float]:
        """The quantities that differ from ordinary level flight, by name and in the unit of the name."""
        rows = {name: row for name, row in UNUSUAL.items() if name in CONDITION}
        return {
            name: value
            for name, row in rows.items()
            if (value := getattr(self, row.field)) != row.default
        }

    @property
    def weight(self) -> float:
        """W = m g [N]."""
        return self.mass * GRAVITY

    @property
    def load(self) -> float:
        """Lift that the rotor carries, n W [N]."""
        return self.load_factor * self.weight

    @cached_property
    def density(self) -> float:
        """Air density [kg/m³], p/(R T) unless a test gives it."""
        if self.stand is not None and self.stand.density is not None:
            return self.stand.density
        exponent = GRAVITY / (GAS_CONSTANT * LAPSE_RATE) - 1.0
        standard = self._standard_ratio
        return SEA_LEVEL_DENSITY * standard**exponent * (standard / self._temperature_ratio)

    @property
    def sound_speed(self) -> float:
        """Speed of sound √(γRT) [m/s]."""
        return math.sqrt(
            RATIO_OF_SPECIFIC_HEATS * GAS_CONSTANT * SEA_LEVEL_TEMPERATURE * self._temperature_ratio
        )

    @property
    def viscosity(self) -> float:
        """Dynamic viscosity [Pa s], Sutherland's law with the constants of ISO 2533."""
        temperature = SEA_LEVEL_TEMPERATURE * self._temperature_ratio
        return 1.458e-6 * temperature**1.5 / (temperature + 110.4)

    @property
    def _standard_ratio(self) -> float:
        """Temperature of the standard atmosphere over that at sea level."""
        return 1.0 - LAPSE_RATE * self.altitude / SEA_LEVEL_TEMPERATURE

    @property
    def _temperature_ratio(self) -> float:
        return self._standard_ratio + self.isa_offset / SEA_LEVEL_TEMPERATURE


@dataclass(frozen=True)
class Fuselage:
    """The airframe as a drag area: D = ½ρV² f_drag A_eq, eq. (3.19), with f_drag A_eq as one number."""

    drag_area: float
    """Equivalent flat-plate area f [m²]."""
    hover_download: float = 0.0
    """Force of the rotor's wake on the airframe in hover, as a part of the weight."""
    drag_area_band: tuple[float, float] | None = None
    """Lowest and highest drag area that the sources allow [m²]; None where they name one."""

    def drag(self, density: float, speed: float) -> float:
        """Drag [N] at an air density [kg/m³] and an airspeed [m/s], eq. (3.19)."""
        return 0.5 * density * speed**2 * self.drag_area


def reported_names(unusual: Iterable[Mapping[str, float]]) -> tuple[str, ...]:
    """Names of the numbers that a table of conditions or designs with these unusual ones shows."""
    names = {name for one in unusual for name in one}
    return tuple(name for name, row in NUMBERS.items() if row.reported or name in names)


def in_words(unusual: Mapping[str, float]) -> tuple[str, ...]:
    """Unusual numbers in words: `climb 5 m/s`."""
    return tuple(NUMBERS[name].in_words(value) for name, value in unusual.items())


def changed_condition(
    condition: FlightCondition, tip_speed: float, asked: Mapping[str, Any], **fields: Any
) -> FlightCondition:
    """The condition with the quantities asked for, by name; None leaves one as it is. `tip_speed` is ΩR [m/s] as built.

    `fields`: of the condition, where nothing else is asked for.

    Raises TypeError or ValueError with one sentence when more than one sets the speed, or a value is not a number.
    """
    given = {name: value for name, value in asked.items() if value is not None}
    hover = given.pop("hover", False)
    if hover not in (True, False):
        raise TypeError(f"hover is {hover!r}: write hover=True or leave it out")
    speeds = {name: given[name] for name in ("mu", "speed_kt") if name in given} | (
        {"hover": True} if hover else {}
    )
    if len(speeds) > 1:
        chosen = " and ".join(f"{name}={value!r}" for name, value in speeds.items())
        raise ValueError(f"{chosen} each set the speed: give only one of mu, speed_kt and hover")
    changed = {row.field: row.read(given[name]) for name, row in CONDITION.items() if name in given}
    if hover:
        changed["advance_ratio"] = 0.0
    elif "speed_kt" in given:
        share = changed.get("rotor_speed_percent", condition.rotor_speed_percent) / 100.0
        changed["advance_ratio"] = (
            QUANTITIES["speed_kt"].read(given["speed_kt"]) * KNOT / (tip_speed * share)
        )
    return replace(condition, **(fields | changed))


def _check(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not (math.isfinite(value) and low <= value <= high):
        raise ValueError(
            f"{name} {value:g}{unit} is outside {low:g}…{high:g}{unit}: choose a value inside"
        )


FIXED_SHARE = 0.05
"""Tail-rotor power over main-rotor power in the document, at every flight condition (thesis §3.2, p. 25)."""


@dataclass(frozen=True)
class TailRotor:
    """A tail rotor in edgewise flow."""

    radius: float
    """[m]"""
    angular_speed: float
    """[rad/s]"""
    chord: float
    """[m]"""
    blades: int
    arm: float
    """Distance from the main-rotor shaft [m]."""
    cant: float
    """Tilt of the thrust out of the horizontal [rad]; only the horizontal part balances torque."""
    tip_loss: float
    """Effective radius factor B."""
    drag_polar: tuple[float, float, float]
    """c_d = δ0 + δ1 α + δ2 α² with α [rad]."""
    lift_slope: float
    """[1/rad]"""


Hub = Literal["articulated", "teetering", "teetering-with-coning-hinges", "gimballed", "hingeless"]
HUBS: tuple[Hub, ...] = (
    "articulated",
    "teetering",
    "teetering-with-coning-hinges",
    "gimballed",
    "hingeless",
)
"""`gimballed`: three or more blades on one joint at the shaft; the hub tilts as a whole and fixes the coning.
`hingeless`: the elastic root of a blade is an equivalent hinge with a spring."""


@dataclass(frozen=True)
class DocumentRotor:
    """The rotor as the source document states it, where that differs from the aircraft's rotor."""

    rotor: Rotor
    twist: TwistLaw


@dataclass(frozen=True)
class RotorFiles:
    """The text of the files of a user's rotor, so that a saved design is complete."""

    main: str
    """Name of the rotor file."""
    texts: tuple[tuple[str, str], ...]
    """(name, text) of the rotor file and of every file it names."""


@dataclass(frozen=True)
class ControlRange:
    """Blade pitch [rad] at the two stops of each control, with the other controls at mid-travel."""

    collective: tuple[float, float]
    """Pitch at 0.75 R."""
    lateral: tuple[float, float]
    """cos (ψ + phase) part of pitch."""
    longitudinal: tuple[float, float]
    """sin (ψ + phase) part of pitch."""
    phase: float = 0.0
    """[rad]"""

    def places(self, collective: float, cyclic_1c: float, cyclic_1s: float) -> dict[str, float]:
        """Position of each control between its stops (0 and 1) for the pitch θ0 + θ1c cos ψ + θ1s sin ψ [rad]."""
        turned = (cyclic_1c + 1j * cyclic_1s) * cmath.exp(1j * self.phase)
        pitch = {
            "collective": (collective, self.collective),
            "lateral": (turned.real, self.lateral),
            "longitudinal": (turned.imag, self.longitudinal),
        }
        return {name: (value - low) / (high - low) for name, (value, (low, high)) in pitch.items()}

    def left(self, collective: float, cyclic_1c: float, cyclic_1s: float) -> float:
        """Smallest distance to a stop for a pitch [rad], as a part of the range: 0.5 at mid-travel, negative beyond."""
        return min(
            min(place, 1.0 - place)
            for place in self.places(collective, cyclic_1c, cyclic_1s).values()
        )


@dataclass(frozen=True, repr=False)
class Aircraft:
    """An aircraft as far as its main rotor needs it: rotor, drag area, mass, tail rotor and engines.

    It holds no arrays, so it can be compared, hashed and sent to other processes.
    """

    name: str
    """Display name, for example UH-60A."""
    rotor: Rotor
    """The rotor as built, with its built-in twist."""
    fuselage: Fuselage
    mass: float
    """Reference mass [kg]."""
    tail_rotor: TailRotor | None = None
    """None: no tail rotor, or an unknown one; five per cent of main-rotor power is used instead."""
    hub: Hub = "articulated"
    stated: DocumentRotor | None = None
    key: str = ""
    """Name of a shipped aircraft, as for `--rotor`; empty for a user's own."""
    files: RotorFiles | None = None
    """Files of a user's own aircraft; None for a shipped one."""
    remarks: tuple[str, ...] = ()
    """Assumptions made when the files were read, in sentences."""
    installed_power: float | None = None
    """What the engines give at sea level on a standard day [W]; None where the file does not say."""
    controls: ControlRange | None = None
    """None where the file does not say."""
    doubt: tuple[tuple[str, float], ...] = ()
    """Sizes of uncertain inputs that the file states, by the names of `assets/doubt.toml`."""
    isolated: bool = False
    """Whether the file is of a rotor alone, without an airframe, to be tested on a stand."""

    def __repr__(self) -> str:
        return f"Aircraft({self.name}, {self.mass:.0f} kg, drag area {self.fuselage.drag_area:.3g} m², {self.rotor})"

    def record(self) -> Any:
        """The record of a design file: the name of a shipped rotor, or the lines of every file of a user's rotor."""
        if self.files is None:
            return self.key
        return {
            "main": self.files.main,
            "files": {name: text.splitlines() for name, text in self.files.texts},
        }

    def rotor_for(self, preset: str) -> Rotor:
        """The rotor of a preset: for `thesis` the document's rotor if there is one, else the rotor as built."""
        return self.stated.rotor if preset == "thesis" and self.stated else self.rotor

    def twist_for(self, preset: str) -> TwistLaw:
        """The baseline twist of a preset: for `thesis` the document's if there is one, else the built-in twist."""
        return self.stated.twist if preset == "thesis" and self.stated else self.rotor.builtin_twist

    def twist_title(self, preset: str) -> str:
        """The name of the baseline twist for the user."""
        if preset == "thesis" and self.stated:
            return self.stated.twist.spec().replace("linear:-", "linear −") + "°"
        return f"{self.name} as built"
