"""Optimum twist at each flight condition, the best fixed blade, and the gain of in-flight twist change.

Conditions are processed in chunks of neighbours, each in its own process. Within a chunk a search starts from the
optimum of the previous condition, and a concept with more parameters from the optima of the simpler ones. The chunks
do not depend on the number of processes, so the result does not either.
"""

from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass, field, replace

from rotor.design.design import Design
from rotor.optimisation.concepts import Concept, nearest
from rotor.optimisation.doubt import difference_doubt, saving_doubt
from rotor.optimisation.evaluator import TrimHistory
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import Objective, Quantity, WeightedCondition, check_index
from rotor.optimisation.results import Optimum, SearchStatus
from rotor.optimisation.search import Search, run_search
from rotor.support.processes import Processes, WorkerLost, run_tasks
from rotor.trim.doubt import Doubt
from rotor.trim.solve import solve

CHUNK = 4
"""Neighbouring conditions computed together, and concepts of the fixed blade."""


@dataclass(frozen=True)
class SchedulePlan:
    """A schedule to compute, as a value: it pickles."""

    design: Design
    """The starting design; its twist is the baseline."""
    concepts: tuple[Concept, ...]
    """Simplest first: the others start from their optima."""
    conditions: tuple[WeightedCondition, ...]
    """In the order of the table, neighbours next to each other."""
    quantity: Quantity = "total"
    limits: Limits = field(default_factory=Limits)
    starts: int = 4
    """Starts of the first condition of a chunk; the others begin from their neighbour."""
    seed: int = 0

    def __post_init__(self) -> None:
        if not self.conditions or not self.concepts:
            raise ValueError(
                "a schedule needs a flight condition and a concept: give at least one of each"
            )
        if self.quantity == "vibration":
            raise ValueError(
                "a schedule compares powers: use objective total or induced, with a limit on the index"
            )
        check_index(self.design, Objective(self.quantity, self.conditions), self.limits)

    def design_at(self, condition: int | None) -> Design:
        """The starting design at a condition; None: at its own condition."""
        return (
            self.design
            if condition is None
            else replace(self.design, condition=self.conditions[condition].flight)
        )


@dataclass(frozen=True)
class ScheduleOptimum:
    """The optimum of a concept at one condition, or fixed for all (condition None)."""

    condition: int | None
    concept: str
    optimum: Optimum


@dataclass(frozen=True)
class InFlightGain:
    """Gain of in-flight twist change of a concept over the mission."""

    concept: str
    baseline: float
    """Mean power of the starting design [W]."""
    fixed: float
    """Mean power of the best fixed blade [W]."""
    moving: float
    """Mean power with the best twist in every condition [W]."""

    @property
    def gain(self) -> float:
        """Additional saving of variable twist relative to the best fixed blade [W]."""
        return self.fixed - self.moving

    @property
    def share(self) -> float:
        """The gain relative to the best fixed blade's power."""
        return self.gain / self.fixed


@dataclass(frozen=True)
class Schedule:
    """Results of a plan, complete or partial."""

    plan: SchedulePlan
    cells: tuple[ScheduleOptimum, ...]
    message: str = ""
    """Error of the run itself, in one sentence."""

    def at(self, condition: int | None, concept: str) -> Optimum | None:
        """The optimum of a concept at a condition; None: the fixed blade."""
        return next(
            (
                one.optimum
                for one in self.cells
                if (one.condition, one.concept) == (condition, concept)
            ),
            None,
        )

    @property
    def complete(self) -> bool:
        """Whether every optimum has been computed."""
        return len(self.cells) == len(self.plan.concepts) * (len(self.plan.conditions) + 1)

    @property
    def converged(self) -> bool:
        """Whether every optimum has been computed and converged."""
        return self.complete and all(
            cell.optimum.status is SearchStatus.CONVERGED for cell in self.cells
        )

    def gain_doubt(self, concept: str) -> Doubt | None:
        """How sure the gain of in-flight twist is: every condition is solved with both blades; None without a gain."""
        fixed, shares = (
            self.at(None, concept),
            Objective(self.plan.quantity, self.plan.conditions).shares,
        )
        if self.in_flight_gain(concept) is None or fixed is None:
            return None
        moving = [self.at(k, concept) for k in range(len(shares))]
        designs = [cell.design for cell in moving if cell is not None]
        flights = [condition.flight for condition in self.plan.conditions]
        here = [
            solve(replace(design, condition=flight))
            for design, flight in zip(designs, flights, strict=True)
        ]
        there = [solve(replace(fixed.design, condition=flight)) for flight in flights]
        return difference_doubt(shares, here, there, induced=self.plan.quantity == "induced")

    def in_flight_gain(self, concept: str) -> InFlightGain | None:
        """Gain of in-flight twist; None while an optimum of the concept is missing."""
        fixed = self.at(None, concept)
        if fixed is None or fixed.best is None or fixed.baseline_power is None:
            return None
        moving = 0.0
        for k, share in enumerate(Objective(self.plan.quantity, self.plan.conditions).shares):
            optimum = self.at(k, concept)
            if optimum is None or optimum.best is None:
                return None
            moving += share * optimum.best.power
        return InFlightGain(concept, fixed.baseline_power, fixed.best.power, moving)


def run_plan(
    plan: SchedulePlan,
    keep: Callable[[ScheduleOptimum], None] | None = None,
    stop: Callable[[], bool] | None = None,
    processes: int = 1,
) -> Schedule:
    """Compute a plan; `keep` is called with every cell.

    `stop` is called several times a second; True ends the run with the results so far.
    """
    cells: _Known = {}

    def add(cell: ScheduleOptimum) -> None:
        cells[cell.condition, cell.concept] = cell
        if keep is not None:
            keep(cell)

    conditions = range(len(plan.conditions))
    chunks = [tuple(conditions[k : k + CHUNK]) for k in range(0, len(plan.conditions), CHUNK)]
    message = ""
    with Processes(processes) if processes > 1 else nullcontext() as pool:
        try:
            stopped = run_tasks(pool, [(_work_chunk, (plan, chunk)) for chunk in chunks], add, stop)
            if not stopped:
                concepts = [
                    plan.concepts[k : k + CHUNK] for k in range(0, len(plan.concepts), CHUNK)
                ]
                run_tasks(
                    pool, [(_work_fixed, (plan, some, dict(cells))) for some in concepts], add, stop
                )
        except WorkerLost as lost:
            message = str(lost)
    order = (
        (condition, concept.name) for condition in (*conditions, None) for concept in plan.concepts
    )
    return Schedule(plan, tuple(cells[place] for place in order if place in cells), message)


_Known = dict[tuple[int | None, str], ScheduleOptimum]


def _work_chunk(
    plan: SchedulePlan, conditions: tuple[int, ...], stop: Callable[[], bool] | None
) -> Iterator[ScheduleOptimum]:
    """All concepts at neighbouring conditions, one after the other."""
    known: _Known = {}
    for condition in conditions:

        def guesses(concept: Concept, condition: int = condition) -> list[tuple[float, ...]]:
            return _guesses(plan, condition, concept, known)

        yield from _searches(plan, condition, plan.concepts, known, guesses, stop)


def _work_fixed(
    plan: SchedulePlan,
    concepts: tuple[Concept, ...],
    known: _Known,
    stop: Callable[[], bool] | None,
) -> Iterator[ScheduleOptimum]:
    """The best fixed blades of some concepts, each started from the mean of its optima."""

    def mean(concept: Concept) -> list[tuple[float, ...]]:
        shares = Objective(plan.quantity, plan.conditions).shares
        bests = [
            (share, known.get((condition, concept.name))) for condition, share in enumerate(shares)
        ]
        optima = [(share, cell.optimum.best) for share, cell in bests if cell and cell.optimum.best]
        total, count = sum(share for share, _ in optima), len(concept.parameters)
        middle = (
            sum(share * best.parameters[k] for share, best in optima) / (total or 1.0)
            for k in range(count)
        )
        return [tuple(middle)] if optima else []

    yield from _searches(plan, None, concepts, known, mean, stop)


def _searches(
    plan: SchedulePlan,
    condition: int | None,
    concepts: tuple[Concept, ...],
    known: _Known,
    guesses_of: Callable[[Concept], list[tuple[float, ...]]],
    stop: Callable[[], bool] | None,
) -> Iterator[ScheduleOptimum]:
    """The cells of a condition, or of the fixed blade, added to those known: one model of power serves all."""
    trimmed = TrimHistory()
    objective = Objective(
        plan.quantity, plan.conditions if condition is None else (plan.conditions[condition],)
    )
    for concept in concepts:
        guesses = guesses_of(concept)
        # The neighbour's minimum need not be the best at a condition, so other starting points are added.
        starts = 1 if condition is None else max(plan.starts, len(guesses) + 1)
        design = plan.design_at(condition)
        search = Search(
            design, concept, objective, plan.limits, starts, plan.seed, tuple(guesses), band=False
        )
        optimum = run_search(search, stop=stop, trimmed=trimmed)
        if optimum.status is SearchStatus.STOPPED:
            return
        if optimum.best is not None:
            optimum = replace(optimum, doubt=saving_doubt(objective, optimum.design, design))
        known[condition, concept.name] = cell = ScheduleOptimum(condition, concept.name, optimum)
        yield cell


def _guesses(
    plan: SchedulePlan, condition: int, concept: Concept, known: _Known
) -> list[tuple[float, ...]]:
    """The neighbour's optimum, and the best of the simpler concepts at this condition."""
    guesses: list[tuple[float, ...]] = []
    neighbour = known.get((condition - 1, concept.name))
    if neighbour is not None and neighbour.optimum.best is not None:
        guesses.append(neighbour.optimum.best.parameters)
    before = plan.concepts[: plan.concepts.index(concept)]
    here = [known.get((condition, other.name)) for other in before]
    simpler = [
        (cell.optimum.best.power, cell.optimum.design)
        for cell in here
        if cell and cell.optimum.best
    ]
    if simpler:
        _, design = min(simpler, key=lambda pair: pair[0])
        guesses.append(nearest(concept, design.twist))
    return guesses
