"""Flap bending and fibre strain of the elastic blade in trimmed flight, quasi-steady.

    (EI w'')'' − (F_c w')' = dL/dρ − m[(ρ − e)β̈ + Ω²ρβ],   w = w'' = 0 at the flap hinge,   free tip

with lift and flapping of the trimmed solution. Centrifugal force carries most of the load; a blade without it would
bend several times as much. Range: below the second flap mode (2.8/rev), no coupling with twist. Hermite finite elements
with tension stiffness.
"""

from dataclasses import dataclass

import numpy as np

from rotor.actuator.catalogue import PiezoPly
from rotor.actuator.installation import InstalledActuator
from rotor.arrays import Array
from rotor.dynamics.structure import BladeStructure, uh60a_structure
from rotor.dynamics.torsion_beam import added_pull
from rotor.trim.solution import Solution

ELEMENTS = 60


def unbalanced_load(solution: Solution, structure: BladeStructure) -> tuple[Array, Array]:
    """Radii [m] and load per length that the rigid flapping blade leaves [N/m], (elements,), (elements, azimuths)."""
    design, disk, controls = solution.design, solution.disk, solution.controls
    rotor = design.rotor
    r = rotor.radius * disk.r
    lift = design.thrust_unit / rotor.blades / rotor.radius * disk.dct
    first = controls.flap_1c * np.cos(disk.psi) + controls.flap_1s * np.sin(disk.psi)
    motion = r[:, None] * (controls.coning + first) - (r - rotor.blade.flap_hinge * rotor.radius)[:, None] * first
    return r, lift - structure.at(r, structure.mass_per_length)[:, None] * rotor.angular_speed**2 * motion


def elastic_flap_moment(solution: Solution, structure: BladeStructure, r: Array) -> Array:
    """EI w'' at r [m] over azimuth [N m], (stations, azimuths)."""
    rotor = solution.design.rotor
    hinge = max(rotor.blade.flap_hinge * rotor.radius, structure.clamp)
    nodes = np.linspace(hinge, structure.radius, ELEMENTS + 1)
    radii, load = unbalanced_load(solution, structure)
    at_nodes = interpolate_columns(nodes, radii, load, left=0.0)
    deflection = _deflect(structure, rotor.angular_speed, nodes, at_nodes)
    return _moment(structure, nodes, deflection, r)


def bend(structure: BladeStructure, angular_speed: float, load: Array, r: Array, hinge: float) -> Array:
    """EI w'' at r [m] under a steady load per length given at ELEMENTS + 1 even nodes from the hinge [N m]."""
    nodes = np.linspace(hinge, structure.radius, ELEMENTS + 1)
    return _moment(structure, nodes, _deflect(structure, angular_speed, nodes, load[:, None]), r)[:, 0]


def _deflect(structure: BladeStructure, angular_speed: float, nodes: Array, load: Array) -> Array:
    """(w, w') at the nodes, (2 nodes, cases)."""
    n = len(nodes)
    stiffness, force = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, load.shape[1]))
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    bending = structure.at(middles, structure.flap_stiffness)
    pull = structure.centrifugal_force(middles, angular_speed)
    for k in range(n - 1):
        h = nodes[k + 1] - nodes[k]
        place = slice(2 * k, 2 * k + 4)
        stiffness[place, place] += bending[k] / h**3 * _bending(h) + pull[k] / (30.0 * h) * _tension(h)
        mean = 0.5 * (load[k] + load[k + 1])
        force[place] += np.outer([h / 2.0, h**2 / 12.0, h / 2.0, -(h**2) / 12.0], mean)
    out = np.zeros_like(force)
    out[1:] = np.linalg.solve(stiffness[1:, 1:], force[1:])
    return out


def _moment(structure: BladeStructure, nodes: Array, deflection: Array, r: Array) -> Array:
    """From the curvature in the middle of each element, where cubic elements are best."""
    h = nodes[1] - nodes[0]
    turn = deflection[1::2]
    curvature = (turn[1:] - turn[:-1]) / h
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    moment = structure.at(middles, structure.flap_stiffness)[:, None] * curvature
    return interpolate_columns(r, middles, moment)


def interpolate_columns(x: Array, known: Array, values: Array, left: float | None = None) -> Array:
    """np.interp for every column, (known, cases) → (x, cases); `left`: the value below the first."""
    out = np.empty((len(x), values.shape[1]))
    for k in range(values.shape[1]):
        out[:, k] = np.interp(x, known, values[:, k], left=left)
    return out


def _bending(h: float) -> Array:
    return np.array(
        [
            [12.0, 6.0 * h, -12.0, 6.0 * h],
            [6.0 * h, 4.0 * h**2, -6.0 * h, 2.0 * h**2],
            [-12.0, -6.0 * h, 12.0, -6.0 * h],
            [6.0 * h, 2.0 * h**2, -6.0 * h, 4.0 * h**2],
        ]
    )


def _tension(h: float) -> Array:
    return np.array(
        [
            [36.0, 3.0 * h, -36.0, 3.0 * h],
            [3.0 * h, 4.0 * h**2, -3.0 * h, -(h**2)],
            [-36.0, -3.0 * h, 36.0, -3.0 * h],
            [3.0 * h, -(h**2), -3.0 * h, 4.0 * h**2],
        ]
    )


HALF_THICKNESS = 0.0475
"""Of the SC1095, in chords: how far a skin is from the middle."""


@dataclass(frozen=True, eq=False)
class FibreStrain:
    """Largest tension along the fibres where the plies are [-], (stations,)."""

    r: Array
    """r/R, (stations,)."""
    centrifugal: Array
    flap: Array
    twist: Array

    @property
    def total(self) -> Array:
        return self.centrifugal + self.flap + self.twist


def fibre_strain(installed: InstalledActuator, solution: Solution | None = None, stations: int = 25) -> FibreStrain:
    """ε_f = ½ε_x(1 − ν) + ½γ at 45°, from F_c/EA, M_flap h/EI and the twist's own shear.

    At another angle ε_f = ε_x(c² − ν s²) + γ s c. Without a solution the flap part is zero. The shear of a full
    voltage swing is taken from the twist rate, γ = 2A θ'/s of a closed cell, a bound for sheets that follow the skin.
    """
    rotor_structure = uh60a_structure(float(installed.beam.r[-1]))
    r = np.linspace(*installed.placement.span, stations)
    metres = r * rotor_structure.radius
    speed = installed.beam.angular_speed
    pull = rotor_structure.centrifugal_force(metres, speed) + added_pull(installed.added, metres, speed)
    s, c = np.sin(installed.placement.angle), np.cos(installed.placement.angle)
    nu = installed.actuator.material.nu12 if isinstance(installed.actuator, PiezoPly) else 0.3
    along = c**2 - nu * s**2
    bending = np.zeros_like(r)
    if solution is not None:
        moment = np.abs(elastic_flap_moment(solution, rotor_structure, metres)).max(axis=1)
        arm = HALF_THICKNESS * rotor_structure.chord
        bending = moment * arm / rotor_structure.at(metres, rotor_structure.flap_stiffness)
    # 2A/s of a closed contour is its mean thickness, at most the greatest: on the safe side.
    shear = abs(installed.twist_rate) * 2.0 * HALF_THICKNESS * rotor_structure.chord
    return FibreStrain(
        r=r,
        centrifugal=along * pull / rotor_structure.axial_stiffness,
        flap=along * bending,
        twist=np.full_like(r, abs(s * c) * shear),
    )
