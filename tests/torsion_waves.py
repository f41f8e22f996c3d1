"""The torsion of a rotating blade at n per revolution, without the product: finite elements in vacuum, and waves read
off a solution."""

import numpy as np

from rotor.dynamics.torsion import TorsionBeam
from rotor.support.arrays import Array
from rotor.trim.solution import Solution


def dynamic_stiffness(beam: TorsionBeam, per_rev: int) -> Array:
    """K − (n² − 1)Ω²M of the free nodes: the propeller moment is Ω²M. The control spring holds the root."""
    nodes, length = len(beam.r), np.diff(beam.r)
    stiffness, mass = np.zeros((nodes, nodes)), np.zeros((nodes, nodes))
    for k in range(nodes - 1):
        ends = np.ix_((k, k + 1), (k, k + 1))
        stiffness[ends] += beam.stiffness[k] / length[k] * np.array([[1.0, -1.0], [-1.0, 1.0]])
        mass[ends] += beam.inertia[k] * length[k] / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
    if np.isfinite(beam.control_stiffness):
        stiffness[0, 0] += beam.control_stiffness
    return stiffness + (1.0 - per_rev**2) * beam.angular_speed**2 * mass


def driven_by_its_root(beam: TorsionBeam, per_rev: int) -> float:
    """Tip pitch per root pitch."""
    load = np.zeros(len(beam.r))
    load[0] = beam.control_stiffness
    return float(np.linalg.solve(dynamic_stiffness(beam, per_rev), load)[-1])


def driven_by_plies(beam: TorsionBeam, moment: Array, per_rev: int) -> float:
    """Tip twist [rad] of the blade clamped at its root under a moment per element [N m]."""
    load = np.zeros(len(beam.r))
    load[1:] += moment
    load[:-1] -= moment
    return float(np.linalg.solve(dynamic_stiffness(beam, per_rev)[1:, 1:], load[1:])[-1])


def tip_wave(solution: Solution, per_rev: int) -> complex:
    """Twist of the tip at a harmonic, elastic and active [rad]: most nose-up at ψ = its angle over n."""
    design, psi = solution.design, solution.disk.psi
    tip = solution.elastic.tip if solution.elastic is not None else np.zeros_like(psi)
    if design.active_twist is not None:
        tip = tip + design.active_twist(np.ones(1), psi)[0]
    return complex(2.0 * np.mean(tip * np.exp(1j * per_rev * psi)))
