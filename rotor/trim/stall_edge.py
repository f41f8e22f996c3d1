"""How far a trim is from the edge of stall: where the flow of the first section separates, or of the last one no longer
does."""

from collections.abc import Callable, Generator
from dataclasses import dataclass

from scipy.optimize import brentq

from rotor.design.design import Design
from rotor.design.quantities import CONDITION
from rotor.design.twist import LinearTwist, SumTwist
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_STEPS = 8
"""Steps to either side on which an edge is looked for; stall that comes and goes within one is missed."""
_FINENESS = 1e-2
"""How near the edge is found, in steps."""
_MU_STEP = 0.02
"""Step of the advance ratio."""
_MASS_STEP = 0.04
"""Step of the mass, as a part of it."""
_TWIST_STEP = 1.0
"""Step of a linear twist on top [°/R]."""

_Put = Callable[[Design, float], Design]
"""A function that gives a design with one quantity larger by a number."""
_Place = tuple[float, Solution]
"""A change of the quantity, and the trim with it."""


@dataclass(frozen=True)
class AttachedRange:
    """The nearest advance ratios [-] between which no flow is separated; None: an end that was not found."""

    low: float | None = None
    high: float | None = None


@dataclass(frozen=True)
class StallEdges:
    """The edges of stall about a trim."""

    separated: bool
    """Whether some flow is separated at the trim itself."""
    mu: AttachedRange
    mass_kg: float | None
    """By how much the mass differs at the nearest edge [kg]; None where there is none, as for `twist_deg`."""
    twist_deg: float | None
    """By how much twist differs there [°/R], linear on top."""


def stall_edges(solution: Solution) -> Generator[None, None, StallEdges]:
    """The nearest edges of stall by advance ratio, by mass and by twist alone.

    An edge is where `Solution.least_margin` is zero: there separated flow begins or ends. It is looked for within 8
    steps of 0.02, 4 % of the mass and 1 °/R, as far as there are trims. Yields before each step.
    """
    design = solution.design
    mu = yield from _attached_range(solution)
    mass_step = _MASS_STEP * design.condition.mass
    mass = yield from _nearest(_Way(solution, _of_condition("mass_kg"), mass_step))
    twist = yield from _nearest(_Way(solution, _twisted, _TWIST_STEP))
    return StallEdges(
        separated=_separated(solution),
        mu=mu,
        mass_kg=None if mass is None else mass.change,
        twist_deg=None if twist is None else twist.change,
    )


def _of_condition(name: str) -> _Put:
    """The change of a quantity of the flight."""
    row = CONDITION[name]
    return lambda design, change: row.put(design, row.of(design) + change)


def _twisted(design: Design, change: float) -> Design:
    """A design with a linear twist [°/R] on top of its own."""
    return design.with_twist(SumTwist(design.twist, LinearTwist.of(change)))


def _separated(solution: Solution) -> bool:
    """Whether some flow is separated."""
    return solution.least_margin < 0.0


@dataclass(frozen=True, eq=False)
class _Way:
    """A trim, the quantity that changes from it, and the step in which it does."""

    solution: Solution
    put: _Put
    step: float

    def trim(self, change: float, near: Solution) -> Solution | None:
        """The trim after a change; None where there is none."""
        return _trim(self.put, self.solution.design, change, near)


@dataclass(frozen=True, eq=False)
class _Edge:
    """The place where separated flow begins or ends."""

    change: float
    side: float
    """1 where a larger quantity lies beyond the edge, −1 where a smaller one does."""
    beyond: _Place
    """The first trim found beyond it."""


def _attached_range(solution: Solution) -> Generator[None, None, AttachedRange]:
    """The attached speeds about a trim or, where its flow is separated, those beyond the nearest edge."""
    way = _Way(solution, _of_condition("mu"), _MU_STEP)
    here = solution.design.condition.advance_ratio
    ends = dict[float, float]()
    if _separated(solution):
        near = yield from _nearest(way)
        if near is None:
            return AttachedRange()
        ends[-near.side] = here + near.change
        # Further on, separated flow may begin again.
        far = yield from _edge_on_side(way, near.side, near.beyond)
        if far is not None:
            ends[near.side] = here + far.change
    else:
        for side in (-1.0, 1.0):
            edge = yield from _edge_on_side(way, side, (0.0, solution))
            if edge is not None:
                ends[side] = here + edge.change
    return AttachedRange(ends.get(-1.0), ends.get(1.0))


def _edge_on_side(way: _Way, side: float, begin: _Place) -> Generator[None, None, _Edge | None]:
    """The first edge from a place on, to one side; None where there is none."""
    before = begin
    for _ in range(_STEPS):
        yield
        change = before[0] + side * way.step
        there = way.trim(change, before[1])
        if there is None:
            return None
        if _separated(there) != _separated(before[1]):
            return _edge(way, side, before, (change, there))
        before = change, there
    return None


def _nearest(way: _Way) -> Generator[None, None, _Edge | None]:
    """The nearest edge to either side; None where there is none."""
    separated = _separated(way.solution)
    ends = {1.0: (0.0, way.solution), -1.0: (0.0, way.solution)}
    for k in range(1, _STEPS + 1):
        for side, before in list(ends.items()):
            change = side * k * way.step
            yield
            there = way.trim(change, before[1])
            if there is None:
                del ends[side]
            elif _separated(there) == separated:
                ends[side] = change, there
            else:
                return _edge(way, side, before, (change, there))
    return None


def _edge(way: _Way, side: float, inner: _Place, outer: _Place) -> _Edge | None:
    """The edge between two trims; None where none trims between them."""
    change = _root(way.solution.design, way.put, inner, outer, _FINENESS * way.step)
    return None if change is None else _Edge(change, side, outer)


def _trim(put: _Put, design: Design, change: float, near: Solution) -> Solution | None:
    """The trim of a changed design from a nearby one; None where there is none."""
    try:
        there = solve(put(design, change), near)
    except ValueError:  # Beyond the bounds of the quantity.
        return None
    return there if there.converged else None


def _root(
    design: Design,
    put: _Put,
    inner: _Place,
    outer: _Place,
    fineness: float,
) -> float | None:
    """The change at the edge between two trims, within `fineness`; None where none trims between them."""
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
