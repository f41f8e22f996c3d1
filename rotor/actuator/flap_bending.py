"""Flap bending of the elastic blade in trimmed flight, quasi-steady: what a rigid flapping blade leaves unbalanced.

    (EI w'')'' − (F_c w')' = dL/dρ − m[(ρ − e)β̈ + Ω²ρβ],   w = w'' = 0 at the flap hinge,   free tip

with lift and flapping of the trimmed solution. Centrifugal force carries most of the load, as it does on the real
blade: a rigid blade would bend several times as much. Range: elastic motion without inertia of its own (below the
second flap mode, 2.8/rev), no coupling with twist. Hermite finite elements, tension stiffness included.
"""

import numpy as np

from rotor.arrays import Array
from rotor.dynamics.structure import BladeStructure
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
