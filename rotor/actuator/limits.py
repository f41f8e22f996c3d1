"""Limits of a real blade: each a value, a bound and a sentence; the flight loads that strain its fibres.

Flap bending and fibre strain are those of the elastic blade in trimmed flight, quasi-steady:

    (EI w'')'' − (F_c w')' = dL/dρ − m[(ρ − e)β̈ + Ω²ρβ],   w = w'' = 0 at the flap hinge,   free tip

with lift and flapping of the trimmed solution. Centrifugal force carries most of the load; a blade without it would
bend several times as much. Range: below the second flap mode (2.8/rev), no coupling with twist. Hermite finite elements
with tension stiffness.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotor.actuator.kind import InstalledActuator, Limit
from rotor.dynamics.structure import BendingStructure, structure_data, uh60a_structure
from rotor.dynamics.torsion import added_pull
from rotor.support.arrays import Array
from rotor.trim.solution import Solution

ELEMENTS = 60
BENDING = np.array(
    [
        [12.0, 6.0, -12.0, 6.0],
        [6.0, 4.0, -6.0, 2.0],
        [-12.0, -6.0, 12.0, -6.0],
        [6.0, 2.0, -6.0, 4.0],
    ]
)
TENSION = np.array(
    [
        [36.0, 3.0, -36.0, 3.0],
        [3.0, 4.0, -3.0, -1.0],
        [-36.0, -3.0, 36.0, -3.0],
        [3.0, -1.0, -3.0, 4.0],
    ]
)
"""Stiffness of an element of unit length, of (w, w') at both ends; tension times 30."""


def unbalanced_load(solution: Solution, structure: BendingStructure) -> tuple[Array, Array]:
    """Radii [m], (elements,), and load per length that rigid flapping does not balance [N/m], (elements, azimuths)."""
    design, disk, controls = solution.design, solution.disk, solution.controls
    rotor = design.rotor
    r = rotor.radius * disk.r
    lift = design.thrust_unit / rotor.blades / rotor.radius * disk.dct
    first = controls.flap_1c * np.cos(disk.psi) + controls.flap_1s * np.sin(disk.psi)
    motion = (
        r[:, None] * (controls.coning + first)
        - (r - rotor.blade.flap_hinge * rotor.radius)[:, None] * first
    )
    return r, lift - structure.at(r, structure.mass_per_length)[
        :, None
    ] * rotor.angular_speed**2 * motion


def elastic_flap_moment(solution: Solution, structure: BendingStructure, r: Array) -> Array:
    """EI w'' at r [m] over azimuth [N m], (stations, azimuths)."""
    rotor = solution.design.rotor
    nodes = np.linspace(
        max(rotor.blade.flap_hinge * rotor.radius, structure.clamp), structure.radius, ELEMENTS + 1
    )
    radii, load = unbalanced_load(solution, structure)
    at_nodes = interpolate_rows(nodes, radii, load.T, left=0.0).T
    return bending_moments(structure, rotor.angular_speed, nodes, at_nodes, r)


def bending_moments(
    structure: BendingStructure, angular_speed: float, nodes: Array, load: Array, r: Array
) -> Array:
    """EI w'' at r [m] under loads per length at even nodes from the hinge, (nodes, cases), (stations, cases) [N m].

    From the curvature in the middle of each element, where cubic elements are best.
    """
    turn = _deflect(structure, angular_speed, nodes, load)[1::2]
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    curvature = np.diff(turn, axis=0) / (nodes[1] - nodes[0])
    return interpolate_rows(
        r, middles, (structure.at(middles, structure.flap_stiffness)[:, None] * curvature).T
    ).T


def _deflect(structure: BendingStructure, angular_speed: float, nodes: Array, load: Array) -> Array:
    """(w, w') at even nodes, (2 nodes, cases)."""
    n = len(nodes)
    stiffness, force = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, load.shape[1]))
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    bending = structure.at(middles, structure.flap_stiffness)
    pull = structure.centrifugal_force(middles, angular_speed)
    h = nodes[1] - nodes[0]
    unit = np.array([1.0, h, 1.0, h])
    scale = np.outer(unit, unit)
    for k in range(n - 1):
        place = slice(2 * k, 2 * k + 4)
        stiffness[place, place] += scale * (
            bending[k] / h**3 * BENDING + pull[k] / (30.0 * h) * TENSION
        )
        mean = 0.5 * (load[k] + load[k + 1])
        force[place] += np.outer([h / 2.0, h**2 / 12.0, h / 2.0, -(h**2) / 12.0], mean)
    out = np.zeros_like(force)
    out[1:] = np.linalg.solve(stiffness[1:, 1:], force[1:])
    return out


def interpolate_rows(x: Array, known: Array, rows: Array, left: float | None = None) -> Array:
    """np.interp for every row, (cases, known) → (cases, x); `left`: the value below the first point."""
    columns: list[Array] = [np.interp(x, known, row, left=left) for row in rows]
    return np.stack(columns)


HALF_THICKNESS = 0.0475
"""Half the thickness of the SC1095, in chords: how far a skin is from the middle."""


_STATIONS = 25
"""Along the plies."""


@dataclass(frozen=True, eq=False)
class FibreStrain:
    """Largest tensile strain along the fibres over the span of the plies [-], (stations,)."""

    r: Array
    """r/R, (stations,)."""
    centrifugal: Array
    flap: Array
    twist: Array

    @property
    def total(self) -> Array:
        return self.centrifugal + self.flap + self.twist


def fibre_strain(
    installed: InstalledActuator, nu: float, solutions: Sequence[Solution] = ()
) -> FibreStrain:
    """ε_f = ½ε_x(1 − ν) + ½γ at 45°, from F_c/EA, M_flap h/EI and the twist's own shear.

    At another angle ε_f = ε_x(c² − ν s²) + γ s c, `nu` that of the sheet. The flap part is the largest of the
    solutions, and zero without any. The shear of a full voltage swing is taken from the twist rate, γ = 2A θ'/s of a
    closed cell, a bound for sheets that follow the skin.
    """
    rotor_structure = uh60a_structure(float(installed.beam.r[-1]))
    r = np.linspace(*installed.placement.span, _STATIONS)
    metres = r * rotor_structure.radius
    speed = installed.beam.angular_speed
    pull = rotor_structure.centrifugal_force(metres, speed) + added_pull(
        installed.added, metres, speed
    )
    s, c = np.sin(installed.placement.angle), np.cos(installed.placement.angle)
    along = c**2 - nu * s**2
    bending = np.zeros_like(r)
    for solution in solutions:
        moment = np.abs(elastic_flap_moment(solution, rotor_structure, metres)).max(axis=1)
        arm = HALF_THICKNESS * rotor_structure.chord
        strain = moment * arm / rotor_structure.at(metres, rotor_structure.flap_stiffness)
        bending = np.maximum(bending, strain)
    # 2A/s of a closed contour is its mean thickness, at most the greatest: on the safe side.
    shear = abs(installed.twist_rate) * 2.0 * HALF_THICKNESS * rotor_structure.chord
    pulled = along * pull / rotor_structure.axial_stiffness
    return FibreStrain(
        r=r, centrifugal=pulled, flap=along * bending, twist=np.full_like(r, abs(s * c) * shear)
    )


def limits(
    installed: InstalledActuator, swings: tuple[float, ...], solutions: Sequence[Solution] = ()
) -> tuple[Limit, ...]:
    """All constraints of thesis §5.2 that can be quantified.

    `swings`: required twist of each segment over its range, may exceed 1. `solutions`: the legs for flap bending.
    """
    own = installed.actuator.limits(installed, swings, solutions)
    ends = installed.actuator.temperature_range
    carried = () if ends is None else (_temperature(installed, ends[1]), _mass(installed))
    return *own, *carried, *_torsion(installed)


def why_immovable(installed: InstalledActuator) -> str:
    """Why an actuator cannot move its blade, in a few words: `far too weak`; empty where it can.

    Its principle cannot work on such a rotor, or its whole twist prints as 0.00°, or what it needs inside the blade has
    no room at all (`Limit.far_above`). Other limits, exceeded or not, leave it a twist.
    """
    if installed.actuator.forbidden:
        return installed.actuator.forbidden
    if installed.too_weak:
        return "far too weak"
    whole = (1.0,) * len(installed.shapes)
    own = installed.actuator.limits(installed, whole, ())
    if any(limit.name == "space" and limit.far_above for limit in own):
        return "no space in the blade"
    return ""


def _temperature(installed: InstalledActuator, top: float) -> Limit:
    data = structure_data()["limits"]
    if top <= 85.0:  # Manufacturer's storage limit; the operating limit is lower.
        top = min(top, float(data["running_temperature_c"]))
    on_heater = (
        installed.placement.chord[0] < float(data["de_ice_end_c"]) and installed.actuator.on_skin
    )
    hottest = float(data["de_ice_temperature_c"] if on_heater else data["hot_day_c"])
    heater = "over the de-ice heater mat" if on_heater else "off the heater mat, on a hot day"
    remedy = (
        ""
        if hottest <= top
        else f"; start at {data['de_ice_end_c']:g} c or use a high-temperature type"
    )
    sentence = f"The skin {heater} reaches about {hottest:.0f} °C; the actuator works up to {top:.0f} °C{remedy}."
    return Limit("temperature", hottest <= top, hottest, top, "°C", sentence)


def _mass(installed: InstalledActuator) -> Limit:
    bound = float(structure_data()["limits"]["added_mass_share"])
    reference = float(structure_data()["blade"]["reference_mass_kg"])
    masses = installed.masses
    share = masses.blade / reference
    sentence = (
        f"Each blade gains {masses.blade:.1f} kg ({masses.actuator:.1f} actuator, {masses.wiring:.1f} leads, "
        f"{masses.balance:.1f} nose weight): {100.0 * share:.0f} % of {reference:.0f} kg."
    )
    return Limit("mass", share <= bound, 100.0 * share, 100.0 * bound, "% of blade", sentence)


def _torsion(installed: InstalledActuator) -> list[Limit]:
    data = structure_data()["limits"]
    margin, least = float(data["torsion_margin_per_rev"]), float(data["torsion_least_per_rev"])
    frequency = installed.frequency
    near = min((3.0, 4.0), key=lambda harmonic: abs(frequency - harmonic))
    gap = abs(frequency - near)
    first = f"First torsion at {frequency:.2f}/rev"
    by_gap, by_load = (
        f"{first} is {gap:.2f} from {near:.0f}/rev.",
        f"{first}; below {least:g}/rev control loads grow.",
    )
    return [
        Limit("torsion-resonance", gap >= margin, gap, margin, "per rev", by_gap),
        Limit("torsion-least", frequency >= least, frequency, least, "per rev", by_load),
    ]
