"""Best twist for each flight condition, the best fixed blade for all of them, and what moving is worth beyond it.

Conditions are worked off in chunks of neighbours, each in a process of its own: within a chunk a search starts from the
optimum of the condition before, and a richer concept from the optima of the simpler ones it holds. The chunks do not
depend on how many processes there are, so neither does the answer.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from rotor.design.design import Design
from rotor.optimisation.concepts import Concept, nearest
from rotor.optimisation.objective import Leg, Objective, Quantity
from rotor.optimisation.processes import WorkerLost, Workers
from rotor.optimisation.search import Ended, Limits, Optimum, Search, run_search

CHUNK = 4
"""Neighbouring conditions worked off together."""


@dataclass(frozen=True)
class Plan:
    """What to schedule. A value: it pickles."""

    design: Design
    """The blade as it is; its own twist is the baseline."""
    concepts: tuple[Concept, ...]
    """Simple ones first: the richer start from their optima."""
    legs: tuple[Leg, ...]
    """In the order of the table, neighbours next to each other."""
    quantity: Quantity = "total"
    limits: Limits = field(default_factory=Limits)
    starts: int = 4
    """Starts of the first condition of a chunk; the others begin from their neighbour."""
    seed: int = 0

    def __post_init__(self) -> None:
        if not self.legs or not self.concepts:
            raise ValueError("a schedule needs a flight condition and a concept: give at least one of each")

    def design_at(self, leg: int | None) -> Design:
        """The design as it is at a leg; None: at its own condition."""
        return self.design if leg is None else replace(self.design, condition=self.legs[leg].condition)


@dataclass(frozen=True)
class Cell:
    """One answer: a concept at one condition, or fixed over all (leg None)."""

    leg: int | None
    concept: str
    optimum: Optimum


@dataclass(frozen=True)
class Worth:
    """What a concept gains by moving, over the mission."""

    concept: str
    baseline: float
    """Mean power of the blade as it is [W]."""
    fixed: float
    """Mean power of the best fixed blade [W]."""
    moving: float
    """Mean power with the best twist in every condition [W]."""

    @property
    def gain(self) -> float:
        """[W] that moving saves beyond the best fixed blade."""
        return self.fixed - self.moving

    @property
    def share(self) -> float:
        """The same as a part of the best fixed blade's power."""
        return self.gain / self.fixed


@dataclass(frozen=True)
class Schedule:
    """What is known of a plan: complete, or as far as it came."""

    plan: Plan
    cells: tuple[Cell, ...]
    message: str = ""
    """What went wrong with the run itself, in one sentence."""

    def at(self, leg: int | None, concept: str) -> Optimum | None:
        """The optimum of a concept at a leg; None: the fixed blade."""
        return next((cell.optimum for cell in self.cells if (cell.leg, cell.concept) == (leg, concept)), None)

    @property
    def complete(self) -> bool:
        """Whether every cell is there."""
        return len(self.cells) == len(self.plan.concepts) * (len(self.plan.legs) + 1)

    @property
    def converged(self) -> bool:
        """Whether every cell is there and was found."""
        return self.complete and all(cell.optimum.status is Ended.CONVERGED for cell in self.cells)

    def worth(self, concept: str) -> Worth | None:
        """What moving is worth; None while a cell of the concept is missing or without an optimum."""
        fixed = self.at(None, concept)
        if fixed is None or fixed.best is None or fixed.baseline_power is None:
            return None
        moving = 0.0
        for k, share in enumerate(Objective(self.plan.quantity, self.plan.legs).shares):
            found = self.at(k, concept)
            if found is None or found.best is None:
                return None
            moving += share * found.best.power
        return Worth(concept, fixed.baseline_power, fixed.best.power, moving)


def run_plan(
    plan: Plan,
    found: Sequence[Cell] = (),
    keep: Callable[[Cell], None] | None = None,
    stop: Callable[[], bool] | None = None,
    processes: int = 1,
) -> Schedule:
    """Work a plan off. `found`: cells of an earlier run, kept as they are; `keep` hears of every new one at once.

    `stop` is asked several times a second; True ends the run with what there is.
    """
    cells = {(cell.leg, cell.concept): cell for cell in found}

    def take(cell: Cell) -> None:
        if (cell.leg, cell.concept) not in cells:
            cells[cell.leg, cell.concept] = cell
            if keep is not None:
                keep(cell)

    legs = range(len(plan.legs))
    chunks = [tuple(legs[k : k + CHUNK]) for k in range(0, len(plan.legs), CHUNK)]
    message = ""
    with Workers(processes, take, stop) as workers:
        try:
            stopped = workers.run([(_work_chunk, (plan, chunk, dict(cells))) for chunk in chunks])
            if not stopped:
                workers.run([(_work_fixed, (plan, concept, dict(cells))) for concept in plan.concepts])
        except WorkerLost as lost:
            message = str(lost)
    order = {concept.name: k for k, concept in enumerate(plan.concepts)}
    last = len(plan.legs)
    in_order = sorted(cells.values(), key=lambda one: (last if one.leg is None else one.leg, order[one.concept]))
    return Schedule(plan, tuple(in_order), message)


_Known = dict[tuple[int | None, str], Cell]


def _work_chunk(plan: Plan, legs: tuple[int, ...], known: _Known, stop: Callable[[], bool] | None) -> Iterator[Cell]:
    """All concepts at neighbouring conditions, one after the other."""
    for leg in legs:
        for concept in plan.concepts:
            if (leg, concept.name) in known:
                continue
            neighbour = known.get((leg - 1, concept.name)) if leg - 1 in legs else None
            guesses = _guesses(plan, leg, concept, known, neighbour)
            search = Search(
                design=plan.design_at(leg),
                concept=concept,
                objective=Objective(plan.quantity, (plan.legs[leg],)),
                limits=plan.limits,
                # The neighbour's valley need not be the deepest here: other starts look elsewhere.
                starts=max(plan.starts, len(guesses) + 1),
                seed=plan.seed,
                guesses=guesses,
                band=False,
            )
            optimum = run_search(search, stop=stop)
            if optimum.status is Ended.STOPPED:
                return
            cell = Cell(leg, concept.name, optimum)
            known[leg, concept.name] = cell
            yield cell


def _work_fixed(plan: Plan, concept: Concept, known: _Known, stop: Callable[[], bool] | None) -> Iterator[Cell]:
    """The best fixed blade of one concept, from the mean of its best moving ones."""
    if (None, concept.name) in known:
        return
    objective = Objective(plan.quantity, plan.legs)
    bests = [(share, known.get((leg, concept.name))) for leg, share in enumerate(objective.shares)]
    found = [(share, cell.optimum.best) for share, cell in bests if cell is not None and cell.optimum.best is not None]
    total = sum(share for share, _ in found)
    n = len(concept.parameters)
    middle = tuple(sum(share * best.parameters[k] for share, best in found) / total for k in range(n)) if found else ()
    search = Search(
        design=plan.design,
        concept=concept,
        objective=objective,
        limits=plan.limits,
        starts=1,
        seed=plan.seed,
        guesses=(middle,) if middle else (),
        band=False,
    )
    optimum = run_search(search, stop=stop)
    if optimum.status is not Ended.STOPPED:
        yield Cell(None, concept.name, optimum)


def _guesses(
    plan: Plan, leg: int, concept: Concept, known: _Known, neighbour: Cell | None
) -> tuple[tuple[float, ...], ...]:
    """The neighbour's optimum, and the best of the simpler concepts at this condition."""
    guesses: list[tuple[float, ...]] = []
    if neighbour is not None and neighbour.optimum.best is not None:
        guesses.append(neighbour.optimum.best.parameters)
    here = [known.get((leg, other.name)) for other in plan.concepts if other.name != concept.name]
    simpler = [(cell.optimum.best.power, cell.optimum.design) for cell in here if cell and cell.optimum.best]
    if simpler:
        _, design = min(simpler, key=lambda one: one[0])
        guesses.append(nearest(concept, design.twist))
    return tuple(guesses)
