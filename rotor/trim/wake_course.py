"""Where the wake of a lifting line lies: along the trim of the same rotor with linear inflow and its blade as built.

That trim knows the tilt, the flapping and the mean inflow, and nothing of the twist that is being designed. So one wake
serves all twists of a condition, and the gradient by twist is exact. Laid along the trim found with it, power moves by
less than 0.05 % (tested). A free rotor finds its tilt, which linear inflow misses by up to 2°: its wake is laid again
along the trim found, once.
"""

from dataclasses import replace
from functools import lru_cache

from rotor.aero.inflow.lifting_line import LiftingLineInflow
from rotor.aero.lifting_line.geometry import WakeCourse
from rotor.aero.problem import Problem, in_disk_axes
from rotor.design.design import Design
from rotor.trim.forward import linear_problem, trim
from rotor.trim.newton import TrimResult

SLOWEST = 1e-4
"""Advance ratio at which flight has become hover: power is that of hover to 1e-5 (tested)."""


def with_course(problem: Problem) -> Problem:
    """The problem with the course of its wake; itself where the inflow has none, and in hover."""
    design = problem.design
    if design.hovering or not problem.inflow.fine_tip:
        return problem
    return _laid(problem, design)


def with_slow_course(problem: Problem) -> Problem:
    """The problem of a hovering rotor with the course that its wake has in the slowest flight."""
    return _laid(problem, problem.design.at(mu=SLOWEST)) if problem.inflow.fine_tip else problem


def _laid(problem: Problem, design: Design) -> Problem:
    """The problem with the course of a design's wake; itself where there is none."""
    models = replace(design.models, elastic_twist=False, bending=False, tip_loss=True, hub_loss=True)
    course = _course(
        replace(design, twist=design.rotor.builtin_twist, active_twist=None, pitch_per_rev=(), models=models)
    )
    return problem if course is None else replace(problem, course=course)


def course_of(problem: Problem) -> WakeCourse | None:
    """The course that the inflow's wake lies on; None for other inflow models, and in hover."""
    lies = isinstance(problem.inflow, LiftingLineInflow) and not problem.design.hovering
    return problem.course if lies else None


def laid_again(problem: Problem, found: TrimResult) -> Problem | None:
    """The problem of a free rotor with its wake along a trim; None where it stays."""
    free = problem.design.models.trim == "free-rotor" and problem.inflow.fine_tip and not problem.design.hovering
    return replace(problem, course=along(found, problem.course)) if free and found.converged else None


@lru_cache(maxsize=64)
def _course(design: Design) -> WakeCourse | None:
    """Along the trim of a design with linear inflow; None where it has none."""
    problem = linear_problem(design)
    found = trim(problem)
    return along(found, problem.course) if found.converged else None


def along(found: TrimResult, course: WakeCourse) -> WakeCourse:
    """The course along a trim.

    The thesis' trim leaves µ sin α out of U_P, and its α is that of the disk, not of the shaft, from which the blades
    flap. Its wake still lies below the disk that carries weight and drag: with µ_z = 0 it would stay among the blades.
    """
    problem, state, flow = found.problem, found.state, found.linear.elements.flow
    design, tilt = problem.design, state.shaft_tilt
    if not design.models.disk_axial_flow:
        tilt -= state.flap_1c
    mu_x, mu_z = in_disk_axes(design.condition.advance_ratio, problem.climb, tilt)
    return replace(
        course, mu_x=mu_x, mu_z=mu_z, lambda0=flow.lambda0, coning=state.coning, flap_1c=state.flap_1c,
        flap_1s=state.flap_1s,
    )  # fmt: skip
