"""The solver as the page uses it: warmed at the start, with a cached baseline, and in tasks of the worker processes.

Tasks are values that can be pickled. Nothing here imports viser.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rotor import Design, Optimum, Solution, doubt, hub_loads, make_design, solve
from rotor.design.quantities import PRESETS
from rotor.optimisation import (
    Concept,
    Objective,
    Schedule,
    SchedulePlan,
    Search,
    at_condition,
    evaluate_objective,
    evaluate_objectives,
    run_plan,
    run_search,
)
from rotor.optimisation.doubt import saving_doubt
from rotor.study.point import WarmStarts
from rotor.support.bytes_cache import CACHE_BYTES, limit_caches
from rotor.trim import analyse, power_gradient
from rotor.trim.doubt import Doubt

_NICE = 5
"""Lower priority than the server, so that frames come before searches where processors are short."""


def warm() -> None:
    """Compile and load everything that a solution and its gradient would wait for, the default's first."""
    for preset in PRESETS:
        for advance_ratio in (0.2, 0.0):
            power_gradient(solve(make_design(preset=preset, mu=advance_ratio)))


def prepare_worker(cache_bytes: int = CACHE_BYTES) -> None:
    """In a new process: a lower priority, and what every solution, and blades that bend, would wait for."""
    limit_caches(cache_bytes)
    if hasattr(os, "nice"):
        os.nice(_NICE)
    warm()
    for inflow in ("lifting-line", "uniform"):
        trim = analyse(make_design(mu=0.2, bending=True, inflow=inflow))
        hub_loads(trim, band=False)
        doubt(trim)


Solve = Callable[[Design, Solution | None], Solution]


@dataclass
class BaselineCache:
    """The last baseline solution of a session, reused while its design stays the same."""

    design: Design | None = None
    solution: Solution | None = None
    by: Solve = solve

    def solve(self, design: Design) -> Solution:
        if self.solution is None or design != self.design:
            self.solution = self.by(design, self.solution if self.solution and self.solution.converged else None)
            self.design = design
        return self.solution


@dataclass(frozen=True)
class ReferenceSaving:
    """What the best twist saves over the reference design; None where that does not trim."""

    doubt: Doubt | None


@dataclass(frozen=True)
class StartPower:
    """Power of the design a search starts from [W]."""

    power: float | None


@dataclass(frozen=True)
class SearchTask:
    """A search for the twist of least power."""

    search: Search
    reference: Design
    """The second reference of the saving."""
    reference_title: str = ""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> Optimum:
        """Reports `StartPower`, every `Progress`, and where the reference is another design, `ReferenceSaving`."""
        search = self.search
        objective = search.objective or at_condition(search.design)
        begin = evaluate_objective(objective, search.design, gradient=False)
        tell(StartPower(begin.power))
        optimum = run_search(search, tell, stop)
        if self.reference != search.design and optimum.best is not None:
            tell(ReferenceSaving(saving_doubt(objective, optimum.design, self.reference)))
        return optimum


@dataclass(frozen=True)
class MapTask:
    """Power over two parameters of a concept, the others held: on a coarse grid, then on finer ones."""

    design: Design
    concept: Concept
    objective: Objective
    axes: tuple[int, int]
    """Which parameters run along x and y."""
    values: tuple[float, ...]
    """All parameters; those of the axes are replaced."""
    steps: tuple[int, ...] = (8, 16, 32)
    """Intervals along each axis, each a multiple of the one before."""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> bool:
        """Reports a `MapLevel` for each grid; True when all were done."""
        known: dict[tuple[int, int], float | None] = {}
        near = [WarmStarts({"x": (0.0, 1.0), "y": (0.0, 1.0)}) for _ in self.objective.conditions]
        finest = self.steps[-1]
        for steps in self.steps:
            stride = finest // steps
            for row in range(0, finest + 1, stride):
                if stop():
                    return False
                cells = [(row, column) for column in range(0, finest + 1, stride) if (row, column) not in known]
                places = [{"x": column / finest, "y": row / finest} for row, column in cells]
                legs = list(zip(near, self.objective.conditions, strict=True))
                starts = [
                    [warm.guess(place, hovering=leg.flight.advance_ratio == 0.0) for warm, leg in legs]
                    for place in places
                ]
                points = evaluate_objectives(
                    self.objective, [self.at(**place) for place in places], starts, gradient=False
                )
                for cell, place, point in zip(cells, places, points, strict=True):
                    known[cell] = point.power
                    for warm, trim in zip(near, point.solutions, strict=False):
                        warm.keep(place, trim)
            every = range(0, finest + 1, stride)
            tell(MapLevel(tuple(tuple(known[row, column] for column in every) for row in every)))
        return True

    def at(self, x: float, y: float) -> Design:
        """The design at a point of the map, 0…1 along each axis."""
        values = list(self.values)
        for axis, part in zip(self.axes, (x, y), strict=True):
            parameter = self.concept.parameters[axis]
            values[axis] = parameter.low + part * (parameter.high - parameter.low)
        return self.concept.apply(self.design, values)


@dataclass(frozen=True)
class MapLevel:
    """Powers [W] on a square grid, rows along y from low to high; None where a design does not trim."""

    powers: tuple[tuple[float | None, ...], ...]


@dataclass(frozen=True)
class ScheduleTask:
    """The best twist for each leg of a mission, and the best fixed blade."""

    plan: SchedulePlan

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> Schedule:
        """Reports every `ScheduleOptimum`, then `FixedBlade`."""
        plan = self.plan
        schedule = run_plan(plan, tell, stop)
        if schedule.complete:
            fixed = schedule.cells[-1].optimum.design
            powers = (
                evaluate_objective(Objective(plan.quantity, (leg,)), fixed, gradient=False).power
                for leg in plan.conditions
            )
            tell(FixedBlade(tuple(powers), schedule.gain_doubt(plan.concepts[0].name)))
        return schedule


@dataclass(frozen=True)
class FixedBlade:
    """The best fixed blade, for comparison with one that moves."""

    powers: tuple[float | None, ...] = ()
    """On each leg [W]; None where it does not trim."""
    gain: Doubt | None = None
    """How sure it is what moving saves beyond it."""
