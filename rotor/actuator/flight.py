"""An actuator over a flight: the tip twist of least power that it reaches on each leg."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.optimum import TwistOptimum, best_swings
from rotor.actuator.verdict import Verdict
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.optimisation.mission import FlightLeg
from rotor.support.arrays import Array
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


@dataclass(frozen=True, eq=False)
class ActuatorFlight:
    """An actuator over the legs of a flight. It holds no solutions and can be pickled.

    Twists are what the actuator adds at the tip in flight (`InstalledActuator.tip`), less that with no voltage (a tube
    at rest) [rad].
    """

    legs: tuple[FlightLeg, ...]
    jig: TwistLaw
    """Twist of the blade with no voltage (a tube at rest)."""
    reached: Array
    """Twist of least power on each leg within the actuator's range, (legs,)."""
    reach: tuple[float, float]
    """Both ends of the range."""
    swings: tuple[tuple[float, ...], ...]
    """By leg and segment, as a share of the whole range."""
    voltages: tuple[tuple[float, ...], ...]
    """By leg and segment [V]; each empty for actuators without voltage."""
    designs: tuple[Design, ...]
    """The driven blade on each leg, without the actuator's mass."""


def fly(verdict: Verdict, legs: Sequence[FlightLeg] | None = None) -> ActuatorFlight:
    """Fly the actuator of a verdict over these legs: its jig twist and range stay, its drive follows the flight.

    legs: None for those of the verdict's mission.

    Everything is trimmed, each leg from the one before; legs that are flown alike are trimmed once and have one answer.
    ValueError without a leg, RuntimeError with one sentence that names the leg where nothing trims.
    """
    installed, base, mission = verdict.installed, verdict.baseline, verdict.baseline.mission
    legs = mission.legs if legs is None else legs
    if not legs:
        raise ValueError("a flight needs a leg: give at least one FlightLeg")
    undriven, per_unit, drives = _drives(verdict)
    window = np.sort(undriven[:, None] + np.outer(per_unit, drives), axis=1)
    keeps = installed.host.kind == "retrofit"
    jig = mission.design.twist if keeps else base.concept.twist(verdict.optimum.values)
    shapes = installed.shapes[:, -1]
    flights = [leg.of(mission.design) for leg in legs]
    found: dict[Design, TwistOptimum] = {}
    near: Solution | None = None
    for leg, design in zip(legs, flights, strict=True):
        if design not in found:
            try:
                near = solve(design, near).require()
                found[design] = best_swings(replace(design, twist=jig), installed, window, near)
            except RuntimeError as error:
                raise RuntimeError(f"{leg.name}: {error}") from None
    flown = [found[design] for design in flights]
    swings = [one.swings[0] for one in flown]
    ends = np.sort((window - undriven[:, None]) * shapes[:, None], axis=1).sum(axis=0)
    volts = (np.array(swings) - undriven) / per_unit
    return ActuatorFlight(
        legs=tuple(legs),
        jig=jig,
        reached=(np.array(swings) - undriven) @ shapes,
        reach=(float(ends[0]), float(ends[1])),
        swings=tuple(swings),
        voltages=tuple(tuple(voltages) if verdict.voltages else () for voltages in volts.tolist()),
        designs=tuple(one.solutions[0].design for one in flown),
    )


def _drives(verdict: Verdict) -> tuple[Array, Array, tuple[float, float]]:
    """How the segments follow their drives, swing = undriven + per_unit × drive: both, (segments,), and its two ends.

    A drive is a voltage [V]; without voltage a share of the stroke. Offset and direction of the fibres are those that
    the verdict's voltages have.
    """
    actuator, voltages = verdict.installed.actuator, verdict.voltages
    swings = np.array(verdict.optimum.swings)
    first = swings[0]
    if not voltages:
        return np.zeros_like(first), np.copysign(1.0, swings.sum(axis=0)), (0.0, 1.0)
    volts = np.array(voltages).T
    per_volt = np.full_like(first, 1.0 / actuator.drive_swing)
    if verdict.installed.host.kind == "new":
        return first - volts[0] * per_volt, per_volt, actuator.drive_range
    turned = np.sum(swings * volts, axis=0) < 0.0  # Fibres laid in the other direction.
    return np.zeros_like(first), per_volt * np.where(turned, -1.0, 1.0), actuator.drive_range
