"""An actuator installed on a blade: moment, twist along the span by segment, added mass, torsion frequency."""

from dataclasses import replace

import numpy as np

from rotor.actuator.kind import Actuator, InstalledActuator, MassBreakdown
from rotor.actuator.kind import Drive as Drive
from rotor.actuator.section import HostBlade, Placement, section_spec, skin
from rotor.design.blade import Rotor
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.dynamics.structure import BendingStructure, structure_data, uh60a_structure, uh60a_torsion
from rotor.dynamics.torsion import (
    AddedStructure,
    TorsionBeam,
    stiffer_blade,
    torsion_beam,
    torsion_frequency,
    twist_under_moment,
)
from rotor.optimisation.limits import ChangeLimit
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache


def addition(
    masses: MassBreakdown, placement: Placement, structure: BendingStructure, stiffness: float
) -> AddedStructure:
    """Mass, inertia about the balance axis, and `stiffness` (GJ [N m²]), added over the active span."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    low, high = (structure.radius * end for end in placement.span)
    front, rear = placement.chord
    plies, weight = (masses.actuator + masses.wiring) / (high - low), masses.balance / (high - low)
    arm = 0.5 * (front + rear) - axis
    spread = plies * (arm**2 + (rear - front) ** 2 / 12.0) + weight * (axis - nose) ** 2
    return AddedStructure((low, high), plies + weight, spread * structure.chord**2, stiffness)


@bytes_cache
@read_only
def install(actuator: Actuator, placement: Placement, host: HostBlade, rotor: Rotor) -> InstalledActuator:
    """Install an actuator on the blade of a rotor. ValueError for a blade that cannot be built."""
    structure = uh60a_structure(rotor.radius)
    spec = section_spec(structure, host)
    if "span" not in actuator.settings:
        placement = replace(placement, divisions=())
    lines = (skin(spec, side, *placement.chord) for side in ("upper", "lower"))
    covered = sum(float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in lines)  # Arc length under the plies [m].
    lengths = np.array([(high - low) * structure.radius for low, high in placement.segments])
    areas = covered * lengths
    masses = actuator.masses(placement, rotor.blades, float(areas.sum()), float(lengths.sum()))
    stiffness, moment = actuator.section(spec, placement)
    added = addition(masses, placement, structure, stiffness - spec.stiffness)
    beam, still = (
        torsion_beam(structure, speed, scale=host.stiffness, addition=added) for speed in (rotor.angular_speed, 0.0)
    )
    units, rest_units = (
        np.stack([_segment_shape(body, structure, span, 1.0) for span in placement.segments]) for body in (beam, still)
    )
    moments = actuator.moments(moment, units[:, -1], lengths, placement)
    moment = float(moments.max())
    return InstalledActuator(
        actuator=actuator,
        placement=placement,
        host=host,
        section_stiffness=stiffness,
        moment=moment,
        twist_rate=moment / stiffness,
        segment_areas=tuple(float(area) for area in areas),
        masses=masses,
        added=added,
        beam=beam,
        r=beam.r / structure.radius,
        shapes=actuator.shapes(moments, units, beam),
        rest_shapes=actuator.shapes(moments, rest_units, still),
        blade=stiffer_blade(uh60a_torsion(rotor.radius), host.stiffness, added),
        frequency=torsion_frequency(beam),
    )


def _segment_shape(beam: TorsionBeam, structure: BendingStructure, span: tuple[float, float], moment: float) -> Array:
    low, high = (structure.radius * end for end in span)
    edges = np.clip(beam.r, low, high)
    share = np.diff(edges) / np.diff(beam.r)  # Part of each element that is active.
    return twist_under_moment(beam, share * moment)


def with_actuator_mass(design: Design, installed: InstalledActuator) -> Design:
    """The design with the actuator's mass in the aircraft and on the blades, and an elastic blade's new stiffness."""
    masses = installed.masses
    return installed.on(heavier(design, masses.blade, installed.added.span, masses.aircraft))


def heavier(design: Design, mass: float, span: tuple[float, float], aircraft: float) -> Design:
    """The design with a mass [kg] spread evenly over a span [m] of each blade, `aircraft` [kg] in total."""
    blade, rotor = design.rotor.blade, design.rotor
    hinge = blade.flap_hinge * rotor.radius
    inner, outer = (end - hinge for end in span)
    line = mass / (outer - inner)
    loaded = replace(
        blade,
        mass=blade.mass + mass,
        flap_static_moment=blade.flap_static_moment + line * (outer**2 - inner**2) / 2.0,
        flap_inertia=blade.flap_inertia + line * (outer**3 - inner**3) / 3.0,
    )
    condition = replace(design.condition, mass=design.condition.mass + aircraft)
    return replace(design, rotor=replace(rotor, blade=loaded), condition=condition)


def change_limit(installed: InstalledActuator, reference: TwistLaw, *, root: float = 0.1304) -> ChangeLimit:
    """The actuator's range as a limit on the change of twist in a search; root: r/R where the blade begins.

    Each segment's twist is spread over the whole segment, cut-out and tip included, like the laws of the concepts;
    `best_actuated` uses the true shape along the active span.
    """
    ends = np.cumsum(installed.segment_twists)
    stations = (root, *installed.placement.divisions, 1.0)
    return ChangeLimit(reference, stations, (0.0, *ends.tolist()))
