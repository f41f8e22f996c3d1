"""The solver as the page uses it: warmed at the start, with a cached baseline, and in tasks of the worker processes.

Tasks are values that can be pickled. Nothing here imports viser.
"""

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
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
    run_plan,
    run_search,
)
from rotor.optimisation.descent import descend_together
from rotor.optimisation.doubt import saving_doubt
from rotor.optimisation.evaluator import Evaluator, TrimHistory
from rotor.optimisation.limits import Limits
from rotor.support.bytes_cache import CACHE_BYTES, limit_caches
from rotor.trim import DEFAULT_OPTIONS, SolverOptions, analyse, power_gradient
from rotor.trim.doubt import Doubt
from rotor.trim.newton import FEW_DIGITS

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


def tries(moving: bool) -> tuple[SolverOptions, ...]:
    """How a design is solved: what moves is refused only by a trim that was solved to the end."""
    return (FEW_DIGITS, DEFAULT_OPTIONS) if moving else (DEFAULT_OPTIONS,)


Solve = Callable[[Design, Solution | None, SolverOptions], Solution]


@dataclass
class BaselineCache:
    """The last baseline solution of a session, reused while its design stays the same."""

    design: Design | None = None
    solution: Solution | None = None
    by: Solve = solve
    rough: bool = False
    """Whether it was solved for a moving slider."""

    def solve(self, design: Design, moving: bool = False) -> Solution:
        """`moving`: to the digits shown; else to the end."""
        if self.solution is None or design != self.design or (self.rough and not moving):
            start = self.solution if self.solution and self.solution.converged else None
            for options in tries(moving):
                self.solution, self.design, self.rough = (
                    self.by(design, start, options),
                    design,
                    options is FEW_DIGITS,
                )
                if self.solution.converged:
                    break
            assert self.solution is not None
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
        optimum = run_search(search, tell, stop, begun=lambda power: tell(StartPower(power)))
        if self.reference != search.design and optimum.best is not None:
            tell(ReferenceSaving(saving_doubt(objective, optimum.design, self.reference)))
        return optimum


_UNSEEN = 5e-5
"""Fall of power, as a part of it, that a map does not show: half a digit of its least."""


Lowest = tuple[float | None, tuple[float, ...]]
"""Least power [W], None where nothing trims, and all parameters there."""


@dataclass(frozen=True)
class MapTask:
    """Power over two parameters of a concept, least over its others: on a coarse grid, then on finer ones."""

    design: Design
    concept: Concept
    objective: Objective
    axes: tuple[int, int]
    """Which parameters run along x and y."""
    values: tuple[float, ...]
    """All parameters: at the first point, the others start from these."""
    steps: tuple[int, ...] = (8, 16)
    """Intervals along each axis, each a multiple of the one before."""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> bool:
        """Reports the part done, 0…1, and a `MapLevel` after each row; True when all were done.

        After a grid's last row the least is refined between its points; before, it is the least so far.
        """
        known: dict[tuple[int, int], Lowest] = {}
        history, finest = TrimHistory(), self.steps[-1]
        several = len(self.values) > len(self.axes)
        # Where a grid holds every parameter its trims have no slopes, which the search for the least needs.
        sloped = history if several else TrimHistory()
        least: Lowest = None, self.values
        for steps in self.steps:
            every = range(0, finest + 1, finest // steps)
            for row in every:
                cells = [(row, column) for column in every if (row, column) not in known]
                if stop():
                    return False
                # From the nearest point that is known, whose least is near, and from across the range: there are
                # valleys side by side.
                near = [
                    min(known, key=lambda at, c=cell: math.dist(at, c), default=None)
                    for cell in cells
                ]
                places = [(column / finest, row / finest) for row, column in cells]
                nearby = [self.values if at is None else known[at][1] for at in near]
                begun = [
                    self.place(*place, values) for place, values in zip(places, nearby, strict=True)
                ]
                found = self._least(begun, history, self.axes)
                across = (
                    self._least(map(self._across, begun), history, self.axes) if several else found
                )
                known.update(zip(cells, map(_lower, found, across), strict=True))
                tell(len(known) / (finest + 1) ** 2)
                least = reduce(_lower, known.values(), least)
                if row == finest and least[0] is not None:
                    least = self._least([least[1]], sloped, (), 0.02 * _UNSEEN)[0]
                tell(self._level(known, every, row, least))
        return True

    def _level(
        self, known: Mapping[tuple[int, int], Lowest], every: range, last: int, least: Lowest
    ) -> "MapLevel":
        """The grid of every so many rows and columns, computed to the `last` row."""
        not_known: Lowest = None, self.values
        grid = [[known.get((row, column), not_known) for column in every] for row in every]
        return MapLevel(
            powers=tuple(tuple(power for power, _ in cells) for cells in grid),
            values=tuple(tuple(values for _, values in cells) for cells in grid),
            least=least,
            rows=every.index(last) + 1,
        )

    def _least(
        self,
        starts: Iterable[tuple[float, ...]],
        history: TrimHistory,
        held: Sequence[int],
        unseen: float = _UNSEEN,
    ) -> list[Lowest]:
        """Least power near each start, with these parameters as given, to a fall by `unseen`, a part of it."""
        if not (begun := list(starts)):
            return []
        free = [k for k in range(len(self.values)) if k not in held]
        searches: list[Evaluator] = []
        for values in begun:
            fixed = {self.concept.parameters[k].name: values[k] for k in held}
            concept = replace(self.concept, fixed=(*self.concept.fixed, *fixed.items()))
            searches.append(
                Evaluator(self.design, concept, self.objective, Limits(), 0, None, None, history)
            )
        scaled = [
            one.scaled([values[k] for k in free])
            for one, values in zip(searches, begun, strict=True)
        ]
        ends = descend_together(searches, scaled, unseen)
        found: list[Lowest] = []
        for one, end, values in zip(searches, ends, begun, strict=True):
            all_values = list(values)
            for k, value in zip(free, one.values(end.x), strict=True):
                all_values[k] = value
            found.append((end.power, tuple(all_values)))
        return found

    def _across(self, values: Sequence[float]) -> tuple[float, ...]:
        """Each parameter but those of the axes as far from the other end of its range."""
        every = enumerate(zip(self.concept.parameters, values, strict=True))
        return tuple(
            value if k in self.axes else one.low + one.high - value for k, (one, value) in every
        )

    def place(self, x: float, y: float, values: Sequence[float]) -> tuple[float, ...]:
        """The parameters at a point of the map, 0…1 along each axis, with the others of `values`."""
        placed = list(values)
        for axis, part in zip(self.axes, (x, y), strict=True):
            parameter = self.concept.parameters[axis]
            placed[axis] = parameter.low + part * (parameter.high - parameter.low)
        return tuple(placed)


def _lower(one: Lowest, other: Lowest) -> Lowest:
    return min(one, other, key=lambda found: math.inf if found[0] is None else found[0])


@dataclass(frozen=True)
class MapLevel:
    """A square grid, rows along y from low to high."""

    powers: tuple[tuple[float | None, ...], ...]
    """[W]; None where a design does not trim, or is not computed yet."""
    values: tuple[tuple[tuple[float, ...], ...], ...]
    """All parameters of each point."""
    least: Lowest
    """Of a whole grid refined between its points; before, the least so far."""
    rows: int
    """How many rows are computed, from the lowest."""

    @property
    def whole(self) -> bool:
        """Whether all rows are computed."""
        return self.rows == len(self.powers)


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
            legs = [Objective(plan.quantity, (leg,)) for leg in plan.conditions]
            doubts = (saving_doubt(leg, fixed, plan.design_at(k)) for k, leg in enumerate(legs))
            tell(FixedBlade(tuple(doubts), schedule.gain_doubt(plan.concepts[0].name)))
        return schedule


@dataclass(frozen=True)
class FixedBlade:
    """The best fixed blade, for comparison with one that moves."""

    doubts: tuple[Doubt | None, ...] = ()
    """On each leg its power and what it saves; None where it does not trim."""
    gain: Doubt | None = None
    """How sure it is what moving saves beyond it."""
