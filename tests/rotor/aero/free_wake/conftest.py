"""Problems that the tests of the free wake share."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotor.aero.free_wake.settle import Settled, settle
from rotor.aero.free_wake.system import WakeState
from rotor.aero.problem import Problem, build_problem
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.hover import hover


def hovering(loading: float, twist_deg: float, blades: int = 4) -> Design:
    """The UH-60A with linear twist, another number of blades of the same total chord, and C_T/σ."""
    design = make_design(hover=True, twist=f"linear:{twist_deg}")
    rotor, chord = design.rotor, 4.0 / blades
    blade = replace(rotor.blade, chords=tuple(c * chord for c in rotor.blade.chords))
    rotor = replace(rotor, blades=blades, blade=blade, reference_chord=chord * rotor.reference_chord)
    design = replace(design, rotor=rotor)
    design = replace(design, models=replace(design.models, hover_inflow="free-wake", download=False))
    return design.at(mass_kg=loading * rotor.solidity * design.condition.mass / design.weight_coefficient)


def rigid(problem: Problem) -> Problem:
    """The same with blades that are rigid in torsion."""
    return replace(problem, torsion=None, given_torsion=np.zeros(0))


def annuli_of(problem: Problem) -> tuple[Array, float]:
    """Circulation and collective of hover by annuli, from which `hover_wake` starts."""
    e = hover(problem).linear.elements
    lift = problem.disk.half_solidity * np.hypot(e.u_t, e.u_p)[:, 0] * e.cl[:, 0]
    return math.pi / problem.disk.blades * lift, e.state.collective


def settled(problem: Problem, start: WakeState | None = None) -> Settled:
    """The wake from a cold start, as `hover_wake` makes it, or from an earlier one."""
    return settle(problem, *annuli_of(problem), start)


@pytest.fixture(scope="session")
def medium() -> tuple[Problem, Settled]:
    problem = build_problem(hovering(0.08, -12.0))
    found = settled(problem)
    assert found.converged
    return problem, found
