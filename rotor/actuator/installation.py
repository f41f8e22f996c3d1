"""An actuator installed on a blade: moment, twist along the span by segment, added mass, torsion frequency, drive.

Strain along the fibres of a piezoelectric ply is d·E with E = V/gap. Interdigitated electrodes lay the field along the
fibres (d33, gap = electrode pitch), continuous electrodes through the thickness (d31, gap = thickness). Figures 5.4–5.7
of the thesis.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly, TorqueTube
from rotor.actuator.section import HostBlade, Placement, active_section, section_spec, skin
from rotor.design.blade import BladeStructure, Rotor
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.dynamics.structure import BendingStructure, structure_data, uh60a_structure, uh60a_torsion
from rotor.dynamics.thin_wall import induced_twist_rate, torsional_stiffness
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


@dataclass(frozen=True)
class MassBreakdown:
    """Added mass [kg]."""

    actuator: float
    """Per blade."""
    wiring: float
    """Per blade."""
    balance: float
    """Per blade."""
    electronics: float
    """Per aircraft."""
    blades: int

    @property
    def blade(self) -> float:
        """Total added to one blade."""
        return self.actuator + self.wiring + self.balance

    @property
    def aircraft(self) -> float:
        return self.blades * self.blade + self.electronics


def balance_mass(mass: float, centre: float) -> float:
    """Nose weight [kg] for a mass with its centre at x/c: Δm = m (x − 0.25)/(0.25 − 0.02), none when it is forward."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    return max(0.0, mass * (centre - axis) / (axis - nose))


def mass_breakdown(
    actuator: Actuator, placement: Placement, blades: int, skin_area: float, length: float
) -> MassBreakdown:
    """Mass breakdown; `skin_area` [m²]: area of one layer on one blade, both skins; `length` [m]: of all segments."""
    limits = structure_data()["limits"]
    wiring, electronics = float(limits["wiring_share"]), float(limits["electronics_share"])
    if isinstance(actuator, ExtensionTwist):
        return MassBreakdown(0.0, 0.0, 0.0, 0.0, blades)
    if isinstance(actuator, PiezoPly):
        plies = actuator.material.density * actuator.thickness * placement.plies * skin_area
        nose = balance_mass((1.0 + wiring) * plies, 0.5 * sum(placement.chord))
        return MassBreakdown(plies, wiring * plies, nose, electronics * plies * blades, blades)
    packages = placement.plies * actuator.mass * len(placement.segments)
    plies = packages + placement.plies * actuator.link_mass * length
    return MassBreakdown(plies, wiring * packages, 0.0, electronics * packages * blades, blades)


def addition(
    masses: MassBreakdown, placement: Placement, structure: BendingStructure, stiffness: float
) -> AddedStructure:
    """Mass per length, its inertia about the balance axis, and stiffness added over the active span."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    low, high = (structure.radius * end for end in placement.span)
    front, rear = placement.chord
    plies, weight = (masses.actuator + masses.wiring) / (high - low), masses.balance / (high - low)
    arm = 0.5 * (front + rear) - axis
    spread = plies * (arm**2 + (rear - front) ** 2 / 12.0) + weight * (axis - nose) ** 2
    return AddedStructure((low, high), plies + weight, spread * structure.chord**2, stiffness)


@dataclass(frozen=True, eq=False)
class InstalledActuator:
    """One actuator on one blade. Angles are peak to peak over the whole voltage range, nominal, rotating."""

    actuator: Actuator
    placement: Placement
    host: HostBlade
    section_stiffness: float
    """GJ of the active section [N m²]."""
    moment: float
    """M_a [N m], of tubes the largest of the segments; 0 for a passive laminate."""
    twist_rate: float
    """θ'_a of the section, not rotating [rad/m]."""
    segment_areas: tuple[float, ...]
    """Areas of one layer on one blade, both skins, by segment [m²]."""
    masses: MassBreakdown
    added: AddedStructure
    beam: TorsionBeam
    r: Array
    """Nodes, r/R, (nodes,)."""
    shapes: Array
    """Twist of each segment alone [rad], zero at the pitch bearing, (segments, nodes)."""
    rest_shapes: Array
    """Twist of each segment on the blade at rest: what is added to an elastic blade, whose trim finds the rest."""
    blade: BladeStructure
    """The blade in torsion with the actuator's stiffness, inertia and mass."""
    frequency: float
    """First torsion [per rev]."""

    @property
    def skin_area(self) -> float:
        """Area of one layer on one blade, both skins [m²]."""
        return math.fsum(self.segment_areas)

    @property
    def attainable(self) -> float:
        """Twist from root to tip, the sum of all segments [rad]."""
        return float(self.segment_twists.sum())

    @property
    def segment_twists(self) -> Array:
        """Twist of each segment, root to tip [rad]."""
        return np.abs(self.shapes[:, -1])

    def shapes_in(self, design: Design) -> Array:
        """What each segment adds to the design's twist law [rad], (segments, nodes)."""
        return self.rest_shapes if design.elastic else self.shapes

    def on(self, design: Design) -> Design:
        """The design with the stiffness and inertia of this blade, where it is elastic."""
        if not design.elastic:
            return design
        rotor = design.rotor
        return replace(design, rotor=replace(rotor, blade=replace(rotor.blade, structure=self.blade)))

    def change(self, swings: ArrayLike, r: ArrayLike) -> Array:
        """Twist at r/R for each segment's swing (−1…1 of its whole range) [rad], zero at the pitch bearing."""
        total: Array = np.asarray(swings, dtype=float) @ self.shapes
        return np.interp(np.asarray(r, dtype=float), self.r, total)

    def tip(self, swings: ArrayLike) -> float:
        """Twist in flight: what the actuator adds at the tip of the rotating blade [rad], nose up positive.

        With tension and propeller moment, which take 7 % of what the blade at rest gains (`rest_shapes`), without the
        air: that takes another 1 to 5 % in trims of the UH-60A's blade, and 10 % of one half as stiff.
        """
        return float(np.asarray(swings, dtype=float) @ self.shapes[:, -1])

    def limit(self, r: ArrayLike) -> Array:
        """Largest change of twist relative to the root at r/R, either way [rad]: the bound an optimiser needs."""
        total: Array = np.abs(self.shapes).sum(axis=0)
        return np.interp(np.asarray(r, dtype=float), self.r, total)


@bytes_cache
@read_only
def install(actuator: Actuator, placement: Placement, host: HostBlade, rotor: Rotor) -> InstalledActuator:
    """Install an actuator on the blade of a rotor. ValueError for a blade that cannot be built."""
    structure = uh60a_structure(rotor.radius)
    spec = section_spec(structure, host)
    lines = (skin(spec, side, *placement.chord) for side in ("upper", "lower"))
    covered = sum(float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in lines)  # Arc length under the plies [m].
    lengths = np.array([(high - low) * structure.radius for low, high in placement.segments])
    areas = covered * lengths
    masses = mass_breakdown(actuator, placement, rotor.blades, float(areas.sum()), float(lengths.sum()))
    stiffness, moment = spec.stiffness, 0.0  # A tube stands beside the blade: its own stiffness is in its torque.
    if isinstance(actuator, PiezoPly):
        section = active_section(spec, actuator, placement)
        stiffness = torsional_stiffness(section)
        moment = stiffness * induced_twist_rate(section)
    added = addition(masses, placement, structure, stiffness - spec.stiffness)
    beam, still = (
        torsion_beam(structure, speed, scale=host.stiffness, addition=added) for speed in (rotor.angular_speed, 0.0)
    )
    moments = np.full(len(lengths), moment)
    if isinstance(actuator, ExtensionTwist):
        shapes = rest_shapes = _along_the_blade(actuator, beam)
    else:
        units, rest_units = (
            np.stack([_segment_shape(body, structure, span, 1.0) for span in placement.segments])
            for body in (beam, still)
        )
        if isinstance(actuator, TorqueTube):
            pairs = zip(units[:, -1], lengths, strict=True)
            moments = np.array(
                [actuator.working_torque(float(unit), float(length), placement.plies) for unit, length in pairs]
            )
            moment = float(moments.max())
        shapes, rest_shapes = moments[:, None] * units, moments[:, None] * rest_units
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
        shapes=shapes,
        rest_shapes=rest_shapes,
        blade=stiffer_blade(uh60a_torsion(rotor.radius), host.stiffness, added),
        frequency=torsion_frequency(beam),
    )


def _segment_shape(beam: TorsionBeam, structure: BendingStructure, span: tuple[float, float], moment: float) -> Array:
    low, high = (structure.radius * end for end in span)
    edges = np.clip(beam.r, low, high)
    share = np.diff(edges) / np.diff(beam.r)  # Part of each element that is active.
    return twist_under_moment(beam, share * moment)


def _along_the_blade(actuator: ExtensionTwist, beam: TorsionBeam) -> Array:
    """Twist of a uniform laminate: rate ∝ F_c ∝ 1 − r²."""
    x = beam.r / beam.r[-1]
    shape = x - x**3 / 3.0
    shape = shape - shape[0]
    return (actuator.attainable * shape / shape[-1])[None, :]


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
    """The actuator's range as a limit on the change of twist in a search.

    Each segment's twist is spread over the whole segment, cut-out and tip included, like the laws of the concepts;
    `best_actuated` uses the true shape along the active span.
    """
    ends = np.cumsum(installed.segment_twists)
    stations = (root, *installed.placement.divisions, 1.0)
    return ChangeLimit(reference, stations, (0.0, *ends.tolist()))


def segment_voltages(
    installed: InstalledActuator, swings: tuple[tuple[float, ...], ...]
) -> tuple[tuple[float, float], ...]:
    """Voltages of each segment at both conditions [V].

    A retrofit counts from zero volts. A new blade's jig twist is set so that the two voltages of a segment lie around
    zero as far as the negative range allows; without voltage the blade then flies between its two twists.
    """
    actuator = installed.actuator
    if not isinstance(actuator, PiezoPly):
        return ()
    low = actuator.voltage_range[0]
    voltages: list[tuple[float, float]] = []
    for first, second in zip(*swings, strict=True):
        a, b = first * actuator.voltage_swing, second * actuator.voltage_swing
        if installed.host.kind == "new":
            offset = max(low, -0.5 * abs(b - a)) - min(a, b)
            a, b = a + offset, b + offset
        elif min(a, b) < low - 1e-6 or max(a, b) > actuator.voltage_range[1] + 1e-6:
            a, b = -a, -b  # Fibres laid in the other direction.
        voltages.append((a, b))
    return tuple(voltages)


def electric_field(ply: PiezoPly, voltage: ArrayLike) -> Array:
    """E = V/gap [V/m]."""
    return np.asarray(voltage, dtype=float) / ply.electrode_gap


def free_strain(ply: PiezoPly, voltage: ArrayLike) -> Array:
    """Free strain along and across the fibres [-], (2, …), linear between the ends of the range, zero at 0 V.

    Measured swing over the voltage swing, not the coefficient d: the two differ by the material's non-linearity.
    """
    per_volt = np.array(ply.swing) / ply.voltage_swing
    return np.multiply.outer(per_volt, np.asarray(voltage, dtype=float))


@dataclass(frozen=True)
class Drive:
    """Drive power of the actuators of all blades."""

    capacitance: float
    """Capacitance of one blade's actuators [F]; 0 for a tube."""
    hold_power: float
    """[W], all blades: only leakage for a ply."""
    slew_power: float
    """Mean [W] while changing the twist of all blades by the swing, amplifier losses included."""
    slew_time: float
    """[s]"""


def capacitance(installed: InstalledActuator) -> float:
    """C = c_A A n of one blade [F]."""
    actuator = installed.actuator
    per_area = actuator.capacitance_per_area if isinstance(actuator, PiezoPly) else 0.0
    return per_area * installed.skin_area * installed.placement.plies


def drive(installed: InstalledActuator, swings: tuple[float, ...]) -> Drive:
    """Holding, and slewing by each segment's share of the whole range: ½C ΔV² over the time, per segment."""
    data = structure_data()["electrical"]
    blades = installed.masses.blades
    actuator = installed.actuator
    if isinstance(actuator, TorqueTube):
        tubes = blades * installed.placement.plies * len(installed.placement.segments)
        return Drive(0.0, tubes * actuator.hold_power, tubes * actuator.move_power, actuator.move_time)
    if not isinstance(actuator, PiezoPly):
        return Drive(0.0, 0.0, 0.0, 0.0)
    per_area = actuator.capacitance_per_area * installed.placement.plies
    energy = sum(
        0.5 * per_area * area * (swing * actuator.voltage_swing) ** 2
        for area, swing in zip(installed.segment_areas, swings, strict=True)
    )
    time = float(data["slew_s"])
    slew = blades * energy / time / float(data["amplifier_efficiency"])
    return Drive(capacitance(installed), 0.0, slew, time)


def harmonic_loss(installed: InstalledActuator, per_rev: float, amplitude: float, angular_speed: float) -> float:
    """Heat in the plies of one blade driven at a harmonic, π f C V_a² tan δ [W]; amplitude: V_a over half the range."""
    actuator = installed.actuator
    if not isinstance(actuator, PiezoPly):
        return 0.0
    frequency = per_rev * angular_speed / (2.0 * math.pi)
    voltage = 0.5 * amplitude * actuator.voltage_swing
    loss_tangent = float(structure_data()["electrical"]["loss_tangent"])
    return math.pi * frequency * capacitance(installed) * voltage**2 * loss_tangent
