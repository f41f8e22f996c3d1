"""Twist at n/rev: the amplitude that an actuator has, and what it changes in power and vibration.

An elastic trim is given the twist of the blade at rest, the moment of the plies; it finds amplitude and phase itself,
with inertia, tension and air (`rotor.aero.elastic`). Use an inflow model that responds to the load distribution
(lifting line).

No measured power of a rotor with active twist was to be had; published savings are computed, or of model rotors.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from rotor.actuator.kind import InstalledActuator
from rotor.aero.bending import can_bend
from rotor.design.design import Design
from rotor.trim.doubt import doubt
from rotor.trim.hub_loads import band_inflows, hub_index
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.solution import Solution
from rotor.trim.solve import analyse


def tip_amplitude(installed: InstalledActuator) -> float:
    """Amplitude at the tip of the blade at rest [rad]: half the twist of the whole voltage range.

    Zero for actuators that cannot follow the azimuth (heat, rotor speed).
    """
    if not installed.actuator.follows_azimuth:
        return 0.0
    return abs(0.5 * float(installed.rest_shapes[:, -1].sum()))


def harmonic_share(installed: InstalledActuator, volts: Sequence[float]) -> float:
    """Share of half the voltage range, 0…1, that steady voltages leave for n/rev drive; 1 without steady voltages."""
    if not installed.actuator.follows_azimuth:
        return 0.0
    low, high = installed.actuator.drive_range
    room = [2.0 * min(high - v, v - low) / (high - low) for v in volts] if any(volts) else [1.0]
    return max(min(room), 0.0)


def bending(design: Design) -> Design:
    """The design with blades that bend where they can, since vibration needs it, and without pitch at n/rev."""
    return replace(
        design, pitch_per_rev=(), models=replace(design.models, bending=can_bend(design.rotor))
    )


@dataclass(frozen=True)
class EffectInFlight:
    """How an actuator changes power and vibration in one flight condition, compared with another blade.

    By inflow model that trims: the design's own first, then those of `hub_loads.band_inflows`.
    """

    power: tuple[float, ...]
    """[W]"""
    index: tuple[float, ...]
    """Change of the vibration index [%], of blades that bend; empty where there are no hub loads."""


def effect(design: Design, reference: Design) -> EffectInFlight:
    """Change of power and of vibration from `reference` to `design`, both in its flight and with its models; vibration
    is that of blades that bend.

    `design`: with the actuator's mass and stiffness on board (`with_actuator_mass`). RuntimeError where it does not
    trim with its own inflow model.
    """
    power, index = list[float](), list[float]()
    shaken = why_no_hub_loads(bending(design)) is None
    for inflow in dict.fromkeys((design.models.inflow, *band_inflows())):
        pair = [
            replace(one, models=replace(design.models, inflow=inflow))
            for one in (design, reference)
        ]
        trims = [analyse(one) for one in pair]
        if inflow == design.models.inflow:
            for trim in trims:
                trim.solution.require()
        if all(trim.solution.converged for trim in trims):
            here, there = (
                trim.solution.power.total + pitching_power(trim.solution) for trim in trims
            )
            power.append(here - there)
        bent = trims if design.models.bending else [analyse(bending(one)) for one in pair if shaken]
        if shaken and all(trim.solution.converged for trim in bent):
            here, there = (hub_index(trim.adjoint) for trim in bent)
            index.append(100.0 * (here / there - 1.0))
    return EffectInFlight(tuple(power), tuple(index))


def powers(designs: Sequence[Design]) -> tuple[tuple[float, float], ...]:
    """Power of each design, and the band of its change from the one before, 0 for the first [W].

    Raises RuntimeError where one does not trim.
    """
    known = {design: analyse(design) for design in dict.fromkeys(designs)}
    trims = [known[design] for design in designs]
    total = [trim.solution.require().power.total for trim in trims]
    bands = (doubt(here, before).change_band or 0.0 for before, here in pairwise(trims))
    return tuple(zip(total, (0.0, *bands), strict=True))


def pitching_power(solution: Solution) -> float:
    """Power that pitch links and plies put into an elastic blade [W]."""
    return solution.elastic.control_power if solution.elastic is not None else 0.0
