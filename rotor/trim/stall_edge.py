"""How far a trim is from the edge of stall: where the first section stalls, or the last one no longer does."""

from collections.abc import Callable, Generator, Mapping

from scipy.optimize import brentq

from rotor.design.design import Design
from rotor.design.quantities import CONDITION
from rotor.design.twist import LinearTwist, SumTwist
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_STEPS = 8
"""Steps to either side on which the edge is looked for; stall that comes and goes within one is missed."""
_FINENESS = 1e-2
"""How near the edge is found, in steps."""


_Put = Callable[[Design, float], Design]
"""A design of which something is larger by a number."""


def _of_condition(name: str) -> _Put:
    row = CONDITION[name]
    return lambda design, change: row.put(design, row.of(design) + change)


def _twisted(design: Design, change: float) -> Design:
    return design.with_twist(SumTwist(design.twist, LinearTwist.of(change)))


_WAYS: Mapping[str, tuple[_Put, float]] = {
    "mu": (_of_condition("mu"), 0.02),
    "mass_kg": (_of_condition("mass_kg"), 0.04),
    "twist": (_twisted, 1.0),
}
"""What is changed, and the step: of the mass as a part of it, of a linear twist on top [°/R]."""


def stall_edges(solution: Solution) -> Generator[None, None, dict[str, float | None]]:
    """By how much advance ratio [-], mass [kg] and twist [°/R, linear, on top] differ at the nearest edge of stall.

    The edge is where `Solution.least_margin` is zero: there a stalled area begins or ends. None where there is none
    within 8 steps of 0.02, 4 % of the mass and 1 °/R, or no trim on the way there. Yields before each step.
    """
    found = dict[str, float | None]()
    for name, (put, step) in _WAYS.items():
        size = step * solution.design.condition.mass if name == "mass_kg" else step
        found[name] = yield from _nearest(solution, put, size)
    return found


def _nearest(solution: Solution, put: _Put, step: float) -> Generator[None, None, float | None]:
    stalls = solution.least_margin < 0.0
    ends = {1.0: (0.0, solution), -1.0: (0.0, solution)}
    for k in range(1, _STEPS + 1):
        for side, (before, near) in list(ends.items()):
            change = side * k * step
            yield
            there = _trim(put, solution.design, change, near)
            if there is None:
                del ends[side]
            elif (there.least_margin < 0.0) == stalls:
                ends[side] = change, there
            else:
                return _root(
                    solution.design, put, (before, near), (change, there), _FINENESS * step
                )
    return None


def _trim(put: _Put, design: Design, change: float, near: Solution) -> Solution | None:
    try:
        there = solve(put(design, change), near)
    except ValueError:  # Beyond the bounds of the quantity.
        return None
    return there if there.converged else None


def _root(
    design: Design,
    put: _Put,
    inner: tuple[float, Solution],
    outer: tuple[float, Solution],
    fineness: float,
) -> float | None:
    """Between two trims of which one has a stalled area, within `fineness`; None where none trims between them."""
    known = dict((inner, outer))

    def margin(change: float) -> float:
        near = known[min(known, key=lambda place: abs(place - change))]
        if change not in known:
            there = _trim(put, design, change, near)
            if there is None:
                raise ArithmeticError
            known[change] = there
        return known[change].least_margin

    try:
        return float(brentq(margin, inner[0], outer[0], xtol=fineness))
    except ArithmeticError:
        return None
