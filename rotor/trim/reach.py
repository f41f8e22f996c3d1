"""How far a rotor trims: what is too much stall, and the mass and speed up to which there is less of it."""

from dataclasses import replace

from scipy.optimize import brentq

from rotor.aero.display import stalled_parts
from rotor.aero.problem import Problem
from rotor.design.quantities import CONDITION
from rotor.trim.analysis import Analysis
from rotor.trim.forward import FOLLOWING_PASSES, easier_condition, trim_on_course
from rotor.trim.low_speed import trim_problem
from rotor.trim.newton import SolverOptions, TrimResult, newton
from rotor.trim.solution import Solution
from rotor.trim.validity import MOST_STALLED

_TOLERANCE = 0.02
"""How near the largest mass and speed are found, as a part of the way to them."""
_UNTRIMMED_SHARE = 2.0 * MOST_STALLED
"""Stalled part of the lift's moment that stands for no trim there."""
SHARE_ERROR = 0.1
"""Difference of the stalled share of the lift's moment between the azimuths of a trim and those that are shown: less
than half of this (tested)."""
_LEAST_POWER_SPEED = 0.15
"""Advance ratio from which the largest speed is looked for: the least power is near it."""


def too_stalled(found: Analysis) -> bool:
    """Whether stalled sections carry more than `MOST_STALLED` of the lift's moment, in every preset.

    A section stalls where its own lift curve does. The curve of the document's polynomials does so within the range to
    which they were fitted, and all angles beyond that range are beyond stall. Fields over the whole disk are made only
    where the share on the azimuths of the trim is within `SHARE_ERROR` of the limit.
    """
    if found.linear.stalled_moment <= MOST_STALLED - SHARE_ERROR:
        return False
    return found.solution.stalled_moment > MOST_STALLED


def largest(solution: Solution, options: SolverOptions) -> tuple[float | None, float | None]:
    """Mass and advance ratio to which the trim can be followed with no more stall; None where not."""
    condition = solution.design.condition
    if condition.stand is not None:
        return None, None
    easy = easier_condition(solution.design, 0.0)
    slow = min(easy.advance_ratio, _LEAST_POWER_SPEED)
    wanted = {"mass_kg": (easy.mass, condition.mass), "mu": (slow, condition.advance_ratio)}
    mass, mu = (_reach(solution, name, *ends, options) for name, ends in wanted.items())
    return mass, mu


def _stalled(result: TrimResult) -> float:
    """Stalled part of the lift's moment of a trim; of none, too much."""
    return (
        stalled_parts(result.problem, result.linear.elements)[1]
        if result.converged
        else _UNTRIMMED_SHARE
    )


def _reach(
    solution: Solution, name: str, easy: float, wanted: float, options: SolverOptions
) -> float | None:
    """How far from an easy value of a quantity towards the one wanted it trims; None where not even there."""
    freedoms, few = solution.freedoms, replace(options, max_passes=FOLLOWING_PASSES)

    def problem_at(value: float) -> Problem:
        return trim_problem(CONDITION[name].put(solution.design, value), freedoms)

    if easy >= wanted:
        return None
    result = trim_on_course(problem_at(easy), None, options)
    if _stalled(result) > MOST_STALLED:
        return None
    trims = {easy: result}

    def too_much(value: float) -> float:
        """Stalled part of the lift's moment over what counts; too much where wanted and where none trims."""
        near = trims[max(trims)]
        if value == easy:
            return _stalled(near) - MOST_STALLED
        if value == wanted or options.asked_to_stop:
            return _UNTRIMMED_SHARE - MOST_STALLED
        ahead = newton(problem_at(value), replace(near.guess, box=None), few)
        share = _stalled(ahead)
        if share <= MOST_STALLED:
            trims[value] = ahead
        return share - MOST_STALLED

    brentq(too_much, easy, wanted, xtol=_TOLERANCE * abs(wanted - easy), rtol=_TOLERANCE)
    return max(trims)
