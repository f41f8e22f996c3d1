"""An actuator that stops in flight: its twist frozen where it was, on all blades.

The frozen twist is one more design at each speed, trimmed like any other.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from rotor.actuator.flight import fly
from rotor.actuator.installation import with_actuator_mass
from rotor.actuator.verdict import Verdict, try_actuator
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.optimisation.mission import FlightLeg
from rotor.trim.control_stops import rigged_collective
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


@dataclass(frozen=True)
class TrimNumbers:
    """The numbers of one trim."""

    twist: float
    """Twist of the tip relative to the root, built in as well [rad]."""
    power: float | None
    """Power of all rotors [W]; None where it does not trim."""
    stalled_area: float
    """Part of the disk πR² (0…1)."""
    collective: float
    """[rad], as the following; pitch at 0.75 R."""
    cyclic: float
    """Amplitude of the cyclic pitch."""
    controls_left: float | None
    """The least part of a control's range that is left to its stop, 0.5 in the middle and negative beyond; None where
    the rotor file does not say."""
    message: str


@dataclass(frozen=True)
class FailurePoint:
    """One speed with the actuator working, and with it stopped."""

    mu: float
    """Advance ratio."""
    speed: float
    """[m/s]"""
    working: TrimNumbers
    stopped: TrimNumbers
    power_left: float | None
    """Power left of the engines, stopped [W]; None where their power is not known, or nothing trims."""

    @property
    def cost(self) -> float | None:
        """Power that the failure costs [W]."""
        here, there = self.stopped.power, self.working.power
        return None if here is None or there is None else here - there


@dataclass(frozen=True)
class Failure:
    """An actuator that stopped at one speed, flown at several speeds."""

    actuator: str
    stops_at: float
    """Advance ratio at which it stops."""
    points: tuple[FailurePoint, ...]


SPEEDS = (0.0, 0.1, 0.2, 0.3, 0.35)
"""Advance ratios at which a frozen twist is flown."""


def failure(
    actuator: str | Verdict,
    design: Design | None = None,
    *,
    stops_at: float = 0.0,
    mu: Iterable[float] = SPEEDS,
) -> Failure:
    """Stop an actuator at one speed and fly on: power, stall, controls and engines' power.

    The twist of the working actuator at each speed is the best within its range (`fly`), held drive not counted.

    Parameters:
        actuator: name of an actuator, for example `MFC_P1`, as a retrofit; or a verdict on one.
        design: what carries it; not used with a verdict.
        stops_at: advance ratio at which it stops.
        mu: advance ratios at which the frozen twist is flown.

    Returns:
        A point for each advance ratio, in order: the trims of the actuator working and stopped.

    Raises:
        ValueError: the blade cannot carry the actuator, or a speed cannot be used.
        RuntimeError: no working actuator trims.
    """
    if isinstance(actuator, str):
        if design is None:
            raise ValueError(
                "an actuator needs a blade: give a design, for example rotor.make_design()"
            )
        actuator = try_actuator(actuator, design)
    flight = fly(actuator, [FlightLeg(f"µ {speed:g}", speed) for speed in (stops_at, *mu)])
    heavy = [with_actuator_mass(driven, actuator.installed) for driven in flight.designs]
    return Failure(
        actuator.installed.actuator.id, stops_at, stopped_designs(heavy[1:], heavy[0], flight.jig)
    )


def stopped_designs(
    working: Sequence[Design], stopped: Design, jig: TwistLaw | None = None
) -> tuple[FailurePoint, ...]:
    """Each design as it is, and with the twist and the active twist of the one at which the actuator stops.

    jig: the twist at which the stops of the controls hold, for pitch is given at the root; by default each the one that
    it was built with.
    """
    points: list[FailurePoint] = []
    for design in working:
        stuck = replace(design, twist=stopped.twist, active_twist=stopped.active_twist)
        here = solve(design)
        there = here if stuck == design else solve(stuck, here)
        engines = design.aircraft.installed_power
        left = None if engines is None or not there.converged else engines - there.power.total
        mu = design.condition.advance_ratio
        points.append(
            FailurePoint(mu, design.airspeed, numbers_of(here, jig), numbers_of(there, jig), left)
        )
    return tuple(points)


def numbers_of(trim: Solution, jig: TwistLaw | None) -> TrimNumbers:
    """A trim in numbers; jig: as for `stopped_designs`."""
    design, controls = trim.design, trim.controls
    stops = design.aircraft.controls
    root, tip = design.twist([design.rotor.blade.root_cutout, 1.0])
    left = None
    if stops is not None:
        collective = rigged_collective(design, controls, jig)
        left = stops.left(collective, controls.cyclic_1c, controls.cyclic_1s)
    power = trim.power.total if trim.converged else None
    cyclic = math.hypot(controls.cyclic_1c, controls.cyclic_1s)
    return TrimNumbers(
        float(tip - root), power, trim.stalled_area, controls.collective, cyclic, left, trim.message
    )
