"""An actuator over a flight: the tip twist of least power that it reaches on each leg, and the power it takes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotor.actuator.catalogue import engines_of
from rotor.actuator.installation import with_actuator_mass
from rotor.actuator.optimum import best_swings
from rotor.actuator.verdict import Verdict
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.support.arrays import Array
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


@dataclass(frozen=True)
class FlightLeg:
    """One steady part of a flight."""

    name: str
    advance_ratio: float
    climb_speed: float = 0.0
    """[m/s], negative in descent."""

    def of(self, design: Design) -> Design:
        """The design in the flight condition of this leg."""
        condition = replace(design.condition, advance_ratio=self.advance_ratio, climb_speed=self.climb_speed)
        return replace(design, condition=condition)


def standard_flight(design: Design) -> tuple[FlightLeg, ...]:
    """Hover, a climb of 5 m/s (about 1000 ft/min) near the speed of least power, cruise and fast flight.

    Level in place of the climb where the models of the design know no axial flow.
    """
    climb = FlightLeg("climb", 0.15, 5.0) if design.models.disk_axial_flow else FlightLeg("slow", 0.15)
    return (FlightLeg("hover", 0.0), climb, FlightLeg("cruise", 0.25), FlightLeg("fast", 0.33))


@dataclass(frozen=True, eq=False)
class ActuatorFlight:
    """An actuator over the legs of a flight. It holds no solutions and can be pickled.

    Twists are what the actuator adds at the tip in flight (`InstalledActuator.tip`), less that with no voltage (a tube
    at rest) [rad]. Powers are of all rotors [W]. Arrays are (legs,).
    """

    legs: tuple[FlightLeg, ...]
    jig: TwistLaw
    """Twist of the blade with no voltage (a tube at rest)."""
    reached: Array
    """Twist of least power on each leg within the actuator's range."""
    reach: tuple[float, float]
    """Both ends of the range."""
    swings: tuple[tuple[float, ...], ...]
    """By leg and segment, as a share of the whole range."""
    voltages: tuple[tuple[float, ...], ...]
    """By leg and segment [V]; each empty for actuators without voltage."""
    power_fixed: Array
    """Best fixed blade of the verdict, without the actuator."""
    power_built: Array
    """Twist as built, without the actuator."""
    power_with: Array
    """Driven, with the actuator's stiffness, mass and drive."""
    reference_power: Array
    """Power of the blade that the verdict counts from: one of the first two."""
    fuel_saving: Array | None
    """[kg/s]; None where the engines have no source."""
    designs: tuple[Design, ...]
    """The driven blade on each leg, without the actuator's mass."""

    @property
    def net_saving(self) -> Array:
        """Saving less the cost of stiffness, mass and drive [W]."""
        return self.reference_power - self.power_with


def fly(verdict: Verdict, legs: Sequence[FlightLeg] | None = None) -> ActuatorFlight:
    """Fly the actuator of a verdict over these legs: its jig twist and range stay, its drive follows the flight.

    legs: None for those of `standard_flight`.

    Everything is trimmed, each leg from the one before; legs that are flown alike are trimmed once and have one answer.
    ValueError without a leg, RuntimeError with one sentence that names the leg where nothing trims.
    """
    legs = standard_flight(verdict.baseline.pair.design) if legs is None else legs
    if not legs:
        raise ValueError("a flight needs a leg: give at least one FlightLeg")
    installed, base, pair = verdict.installed, verdict.baseline, verdict.baseline.pair
    undriven, per_unit, drives = _drives(verdict)
    window = np.sort(undriven[:, None] + np.outer(per_unit, drives), axis=1)
    keeps = installed.host.kind == "retrofit"
    jig = pair.design.twist if keeps else base.concept.twist(verdict.optimum.values)
    shapes = installed.shapes[:, -1]
    flights = [leg.of(pair.design) for leg in legs]
    distinct: dict[Design, _Flown] = {}
    last: _Flown | None = None
    for leg, design in zip(legs, flights, strict=True):
        if design not in distinct:
            try:
                distinct[design] = last = _fly_leg(verdict, design, jig, window, last)
            except RuntimeError as error:
                raise RuntimeError(f"{leg.name}: {error}") from None
    flown = [distinct[design] for design in flights]
    swings = [one.swings for one in flown]
    power_of = {
        "fixed": np.array([one.fixed.power.total for one in flown]),
        "built": np.array([one.built.power.total for one in flown]),
        "with": np.array([one.heavy.power.total for one in flown]) + verdict.drive.hold_power,
    }
    counted = power_of["built" if verdict.against == "same-blade" else "fixed"]
    ends = np.sort((window - undriven[:, None]) * shapes[:, None], axis=1).sum(axis=0)
    volts = (np.array(swings) - undriven) / per_unit
    engines = engines_of(pair.design.aircraft)
    saved = None
    if engines is not None:
        pairs = zip(counted, power_of["with"], strict=True)
        saved = np.array([engines.flow(before) - engines.flow(after) for before, after in pairs])
    return ActuatorFlight(
        legs=tuple(legs),
        jig=jig,
        reached=(np.array(swings) - undriven) @ shapes,
        reach=(float(ends[0]), float(ends[1])),
        swings=tuple(swings),
        voltages=tuple(tuple(voltages) if verdict.voltages else () for voltages in volts.tolist()),
        power_fixed=power_of["fixed"],
        power_built=power_of["built"],
        power_with=power_of["with"],
        reference_power=counted,
        fuel_saving=saved,
        designs=tuple(one.driven for one in flown),
    )


class _Flown(NamedTuple):
    """A leg: trims with the fixed and the built-in twist and with the actuator's mass, and the swings reached."""

    fixed: Solution
    built: Solution
    heavy: Solution
    swings: tuple[float, ...]
    driven: Design


def _fly_leg(verdict: Verdict, design: Design, jig: TwistLaw, window: Array, last: _Flown | None) -> _Flown:
    """One leg, from the trims of the last one; `window`: range of the swings, (segments, 2)."""
    installed = verdict.installed
    fixed = solve(replace(design, twist=verdict.baseline.fixed_twist), last and last.fixed).require()
    built = solve(design, last and last.built).require()
    reached = best_swings(replace(design, twist=jig), installed, window, built)
    driven = reached.solutions[0].design
    heavy = solve(with_actuator_mass(driven, installed), last and last.heavy).require()
    return _Flown(fixed, built, heavy, reached.swings[0], driven)


def _drives(verdict: Verdict) -> tuple[Array, Array, tuple[float, float]]:
    """How the segments follow their drives, swing = undriven + per_unit × drive: both, (segments,), and its two ends.

    A drive is a voltage [V]; without voltage a share of the stroke. Offset and direction of the fibres are those that
    the verdict's voltages have.
    """
    actuator, voltages = verdict.installed.actuator, verdict.voltages
    first, second = np.array(verdict.optimum.swings)
    if not voltages:
        return np.zeros_like(first), np.copysign(1.0, first + second), (0.0, 1.0)
    a, b = np.array(voltages).T
    per_volt = np.full_like(first, 1.0 / actuator.drive_swing)
    if verdict.installed.host.kind == "new":
        return first - a * per_volt, per_volt, actuator.drive_range
    turned = first * a + second * b < 0.0  # Fibres laid in the other direction.
    return np.zeros_like(first), per_volt * np.where(turned, -1.0, 1.0), actuator.drive_range
