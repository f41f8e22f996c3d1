"""The twist of least power or vibration: a global search from many starts, with every local minimum and the flatness of
the best.

The thesis uses fmincon with GlobalSearch (§2.7). Here descents on the exact gradient begin at a seeded low-discrepancy
set of starting points (Halton). One whose next step leads to a minimum known already ends there. Minima are grouped,
and the band gives the flatness of the best.
`optimise` runs the search for one design in one call, `best_linear_twist` says how far a best twist can move.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import scipy

from rotor.design.design import Design, require_design
from rotor.design.quantity import number
from rotor.optimisation.concepts import Concept, find_concept, nearest
from rotor.optimisation.descent import BAND, TOLERANCE, LocalModel, descend, measure_band
from rotor.optimisation.doubt import BestTwistDoubt, best_twist_doubt, saving_doubt
from rotor.optimisation.evaluator import FEASIBLE, Evaluation, Evaluator, SearchStopped, TrimHistory
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import (
    Objective,
    ObjectiveValue,
    Quantity,
    at_condition,
    check_index,
    over_conditions,
)
from rotor.optimisation.results import (
    BestTwist,
    Minimum,
    Optimum,
    ParameterBand,
    Progress,
    SearchStatus,
    TwistRange,
)
from rotor.support.arrays import Array
from rotor.support.blas_threads import one_blas_thread
from rotor.trim.doubt import Doubt, other_models

STARTS = 6
"""Default number of starting points; the first is the law nearest to the design's own twist."""
_TRIMMED_STARTS = 12
"""Starts trimmed before the first descent, which their gradients serve: of power, which far gradients tell of. Our
choice."""
_SAME_PLACE = 0.05
"""Ends whose parameters agree within this fraction of their ranges are one minimum."""
_SAME_MINIMUM_RISE = 1e-4
"""Relative rise above a minimum within which a descent is taken to end in it."""
_MODEL_STARTS = 12
"""Points from which the model is searched for further minima."""
_HALF_WAY_RISE = 1e-6
"""Relative rise allowed half-way between two ends of one minimum."""
MASSES = (0.8, 1.2)
"""Masses of the flights beside the design's, over its own."""
DRAG_AREAS = (0.0, 1.25)
"""Drag areas of the flights beside, over the design's: 0 to 4.1 m² for the UH-60A."""


@dataclass(frozen=True)
class Search:
    """A search as a value: it pickles, so it can run in another process."""

    design: Design
    """The blade to improve; its own twist is the baseline."""
    concept: Concept
    objective: Objective | None = None
    """None: total power at the design's own condition."""
    limits: Limits = field(default_factory=Limits)
    starts: int = STARTS
    seed: int = 0
    guesses: tuple[tuple[float, ...], ...] = ()
    """Parameters to start from before all others."""
    band: bool = True

    def __post_init__(self) -> None:
        if not 1 <= self.starts <= 1000:
            raise ValueError(
                f"{self.starts} starts are outside 1…1000: 6 are enough for most concepts"
            )
        if self.seed < 0:
            raise ValueError(f"seed {self.seed} is negative: give 0 or more")
        limits = self.limits.about(self.design.twist, self.design.rotor.blade.root_cutout)
        object.__setattr__(self, "limits", limits)
        self.limits.bounds_of(self.concept)
        check_index(self.design, self.objective or at_condition(self.design), self.limits)


@one_blas_thread()
def run_search(
    search: Search,
    watch: Callable[[Progress], None] | None = None,
    stop: Callable[[], bool] | None = None,
    trimmed: TrimHistory | None = None,
    begun: Callable[[float | None], None] | None = None,
) -> Optimum:
    """Run a search. `watch` is called after every evaluation; `stop` before each one, True ends the search.

    trimmed: blades of earlier searches with the same objective and limits, for the model; those of this one are added.
    begun: called with the power of the design [W], None where it does not trim.
    Always returns: stopped early with the best so far; where no start trims within the limits, with a message.
    """
    count = max(search.starts, len(search.guesses))
    objective = search.objective or at_condition(search.design)
    evaluate = Evaluator(
        search.design,
        search.concept,
        objective,
        search.limits,
        count,
        watch,
        stop,
        trimmed or TrimHistory(),
    )
    run = _Run(search, evaluate)
    try:
        run.baseline = evaluate.baseline()
        if begun is not None:
            begun(run.baseline.power)
        if (
            objective.quantity == "total"
            and run.baseline.power is not None
            and run.baseline.power <= 0.0
        ):
            return run.result(
                refusal=(
                    "The air drives the rotor at this rate of descent, so total power is below zero and a saving has "
                    "no meaning: descend more slowly, or use the objective induced."
                )
            )
        evaluate.phase = "search"
        starts = _starts(search, evaluate)
        if objective.quantity != "vibration" and not len(evaluate.largest):
            evaluate(starts[0])  # By itself, so that who watches sees the blade move at once.
            evaluate.trim_ahead(starts[:_TRIMMED_STARTS])
        for k, x in enumerate(starts):
            evaluate.start = k
            run.descend_from(k, x)
        if any(parameter.unit == "R" for parameter in search.concept.parameters):
            run.try_predicted_minima()
        if run.best is not None and search.band:
            evaluate.phase = "band"
            run.band = measure_band(evaluate, run.best)
            run.ask_how_sure(objective)
    except SearchStopped:
        return run.result(stopped=True)
    return run.result()


class _Run:
    """State of a running search."""

    def __init__(self, search: Search, evaluate: Evaluator) -> None:
        self.search, self.evaluate = search, evaluate
        self.baseline = ObjectiveValue(None, ())
        self.groups: list[tuple[Evaluation, list[int]]] = []
        """Local minima: the best end of each, and the starts that ended there."""
        self.lost = 0
        self.band: tuple[ParameterBand, ...] = ()
        self.doubt: Doubt | None = None
        self.twist_doubt = BestTwistDoubt()

    @property
    def best(self) -> Evaluation | None:
        """The best end of a descent."""
        return min((end for end, _ in self.groups), key=lambda end: end.cost, default=None)

    def descend_from(self, start: int, x: Array) -> None:
        """Descend from one start, as long as it does not lead to a minimum known.

        A start that does not trim is moved towards the best point first.
        """
        first = self.evaluate(x)
        for _ in range(3):
            if first.power is not None:
                break
            x = 0.5 * (x + self._fallback())
            first = self.evaluate(x)
        if first.power is None:
            self.lost += 1
            return
        arrived: list[int] = []

        def known(x: Array) -> bool:
            """Whether a descent goes on to a minimum known; noted, once it does."""
            arrived[:] = [k for k, (lead, _) in enumerate(self.groups) if self._leads_to(lead, x)][
                :1
            ]
            return bool(arrived)

        descent = descend(self.evaluate, first, known)
        if arrived:
            self.groups[arrived[0]][1].append(start)
        elif descent.end is not None and descent.converged:
            self._gather(start, descent.end)

    def try_predicted_minima(self) -> None:
        """Descend where the model foresees less than the best: laws with movable breaks have many minima."""
        places = scipy.stats.qmc.Halton(len(self.evaluate.span), seed=self.search.seed).random(
            _MODEL_STARTS
        )
        for _ in range(_MODEL_STARTS):
            if self.best is None:
                return
            model = LocalModel(self.evaluate, self.best.blade, self.evaluate.trimmed.all)
            x = min((model.least(place) for place in places), key=model.cost)
            if model.cost(x) >= self.best.cost * (
                1.0 - TOLERANCE[self.evaluate.objective.quantity]
            ):
                return
            first = self.evaluate(x)
            end = (
                descend(self.evaluate, first, lambda _: False).end
                if first.power is not None
                else None
            )
            if end is None or end.cost >= self.best.cost:
                return
            self.groups.append((end, []))

    def ask_how_sure(self, objective: Objective) -> None:
        """Compute the uncertainty of the saving and of the best twist."""
        assert self.best is not None
        search, values, starts = (
            self.search,
            self.evaluate.values(self.best.x),
            self.evaluate.starts_for,
        )
        best = search.concept.apply(search.design, values)
        self.doubt = saving_doubt(objective, best, search.design, starts)
        self.twist_doubt = best_twist_doubt(
            search.design, search.concept, objective, search.limits, values, starts
        )

    def _leads_to(self, lead: Evaluation, x: Array) -> bool:
        """Whether a point is so near a minimum that a descent from there ends in it."""
        if np.abs(lead.x - x).max() < _SAME_PLACE:
            return True
        model = LocalModel(self.evaluate, lead.blade, self.evaluate.trimmed.all)
        return model.cost(x) <= lead.cost * (1.0 + _SAME_MINIMUM_RISE)

    def _gather(self, start: int, end: Evaluation) -> None:
        """Add an end to its minimum, or begin a new one."""
        for k, (lead, members) in enumerate(self.groups):
            if self._same(lead, end):
                self.groups[k] = (min(lead, end, key=lambda point: point.cost), [*members, start])
                return
        self.groups.append((end, [start]))

    def _same(self, a: Evaluation, b: Evaluation) -> bool:
        """Whether two ends are one minimum: near each other, or without a rise half-way."""
        higher = max(a.cost, b.cost)
        if abs(a.cost - b.cost) > BAND * higher:
            return False
        if np.abs(a.x - b.x).max() < _SAME_PLACE:
            return True
        half = self.evaluate(0.5 * (a.x + b.x))
        return half.feasible and half.cost <= higher * (1.0 + _HALF_WAY_RISE)

    def _fallback(self) -> Array:
        known = self.evaluate.best
        return known.x if known is not None else np.full(len(self.evaluate.span), 0.5)

    def result(self, *, stopped: bool = False, refusal: str = "") -> Optimum:
        """What has been found so far. refusal: why the search is not made."""
        search, evaluate = self.search, self.evaluate
        groups = sorted(self.groups, key=lambda group: group[0].cost)
        minima = tuple(_minimum(evaluate, lead, members) for lead, members in groups)
        best = minima[0] if minima else None
        seen = evaluate.best
        if seen is not None and (best is None or seen.cost < groups[0][0].cost * (1.0 - 1e-7)):
            best = _minimum(evaluate, seen, ())
        if refusal:
            status, message = SearchStatus.NOT_CONVERGED, refusal
        elif stopped:
            status = SearchStatus.STOPPED
            message = f"Stopped after {evaluate.count} evaluations; the best design so far is kept."
            if self.groups and evaluate.phase == "band":
                message = "Stopped while computing the band; the search itself was complete."
        elif best is None:
            status = SearchStatus.NOT_CONVERGED
            trimmed = any(record.power is not None for record in evaluate.records)
            message = (
                "No design found meets the limits: relax them."
                if trimmed
                else "No starting point has a trim: reduce the mass, the altitude or the speed."
            )
        elif not minima:
            status = SearchStatus.NOT_CONVERGED
            message = "No descent converged to a minimum; the best point found is returned."
        else:
            status = SearchStatus.CONVERGED
            agree = len(minima[0].starts)
            which = (
                "only local minimum found"
                if len(minima) == 1
                else f"best of {len(minima)} local minima"
            )
            message = f"{agree} of {evaluate.starts} starting points converged to the {which}."
            if not agree:
                message = f"The {which} was found from the gradients at the others: no starting point led to it."
            if self.lost:
                message += f" {self.lost} had no trim."
        return Optimum(
            status=status,
            message=message,
            concept=search.concept.name,
            design=search.design
            if best is None
            else search.concept.apply(search.design, best.parameters),
            best=best,
            minima=minima,
            band=self.band,
            doubt=self.doubt,
            doubt_band=self.twist_doubt.bands,
            doubt_cost=self.twist_doubt.cost,
            baseline_power=self.baseline.power,
            baseline_index=self.baseline.index,
            evaluations=evaluate.count,
            starts=evaluate.starts,
            seed=search.seed,
            elapsed=evaluate.elapsed,
        )


def _starts(search: Search, evaluate: Evaluator) -> Sequence[Array]:
    """Starting points: guesses, the law nearest to the design's own, then Halton points of the seed."""
    points = [evaluate.scaled(guess) for guess in search.guesses]
    if len(points) < search.starts:
        points.append(evaluate.scaled(nearest(search.concept, search.design.twist)))
    left = search.starts - len(points)
    if left > 0:
        points.extend(scipy.stats.qmc.Halton(len(evaluate.span), seed=search.seed).random(left))
    return points


def _minimum(evaluate: Evaluator, record: Evaluation, starts: Sequence[int]) -> Minimum:
    values = evaluate.values(record.x)
    names = (parameter.name for parameter in evaluate.concept.parameters)
    at = zip(names, record.x, strict=True)
    active = [
        f"{name} {'low' if x < 0.5 else 'high'}" for name, x in at if x < 1e-4 or x > 1.0 - 1e-4
    ]
    limits = evaluate.limits
    tight = record.margins < 10.0 * FEASIBLE
    rates = 2 * len(evaluate.concept.rate_rows) if limits.rate is not None else 0
    changes, conditions = (
        len(record.margins) - rates - len(evaluate.largest),
        len(evaluate.objective.conditions),
    )
    if tight[:rates].any():
        active.append("rate")
    if tight[rates : rates + changes].any():
        active.append("change")
    trimmed = tight[rates + changes :]
    if limits.stalled is not None and trimmed[:conditions].any():
        active.append("area past the static angle")
    if limits.index is not None and trimmed[-conditions:].any():
        active.append("vibration index")
    measured, twist = record.blade.measured, evaluate.concept.twist(values).spec()
    assert measured.power is not None
    return Minimum(values, measured.power, twist, tuple(starts), tuple(active), measured.index)


def optimise(
    design: Design,
    concept: str = "two-segment",
    *,
    conditions: Sequence[tuple[float | Design, float]] | None = None,
    division: float | Sequence[float] | None = None,
    quantity: Quantity = "total",
    limits: Limits | None = None,
    starts: int = STARTS,
    seed: int = 0,
) -> Optimum:
    """Find the twist of least power or vibration, at the design's flight condition or over several.

    Parameters:
        design: the design whose twist is replaced; its own twist is the baseline of `saving_percent`.
        concept: `linear`, `quadratic`, `two-segment`, `three-segment`, `free-form` or another name in `CONCEPTS`.
        conditions: pairs of advance ratio and weight, `[(0.0, 1), (0.3, 2)]`, whose weighted mean is made small; in
            place of an advance ratio a design, as in `(design.at(speed_kt=140, mass_kg=9000), 2)`, whose flight
            condition counts.
        division: r/R where the segments meet, for the concepts that hold it fixed.
        quantity: what to minimise: power, `total` or `induced`, or `vibration`: the index of the loads on the hub at
            N_b per revolution, for a design with `bending` and from advance ratio 0.2 on.
        limits: `rotor.Limits` on twist rates, on the change of twist, on the area past the static stall angle and on
            the vibration index; by default the concept's own bounds.
        starts: number of descents.
        seed: of their starting points.

    Returns:
        The optimum. A search always returns; its `status` and `message` say how it ended.

    Raises:
        TypeError: an argument is of another type.
        ValueError: an argument cannot be used; one sentence names the value and the remedy.

    Example:
        >>> design = rotor.make_design(inflow="uniform", mu=0.2)
        >>> optimum = rotor.optimise(design, "linear", starts=1)
        >>> optimum.best.power <= optimum.baseline_power  # [W]
        True
    """
    for name, value in (("starts", starts), ("seed", seed)):
        if not isinstance(value, int):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
            raise TypeError(f"{name} is {value!r}: give a whole number")
    design = require_design(design)
    if limits is not None and not isinstance(limits, Limits):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"limits is {limits!r}: give rotor.Limits(rate_deg=(-20, 0))")
    divisions = (division,) if isinstance(division, int | float) else division
    if divisions is not None:
        divisions = [number("division", item, "0.5") for item in divisions]
    search = Search(
        design=design,
        concept=find_concept(concept, divisions),
        objective=at_condition(design, quantity)
        if conditions is None
        else over_conditions(design, conditions, quantity),
        limits=limits or Limits(),
        starts=starts,
        seed=seed,
    )
    return run_search(search)


def best_linear_twist(design: Design) -> BestTwist:
    """The linear twist of least total power, and how far it can move.

    By what power allows, by what is uncertain, and with mass, drag area or wake. Mass and drag area are known, but not
    the same in every flight and on every airframe: they move the best twist further than what is uncertain. In hover
    the wake does: annuli and a lifting line want different twists.

    Raises:
        ValueError: the trim has no total power, or no linear twist trims; in one sentence.

    Example:
        >>> best = best_linear_twist(rotor.make_design(mu=0.35))
        >>> {each.cause: each.width for each in best.ranges}["drag area"] > 0.08  # [rad/R]
        True
    """
    concept = find_concept("linear")
    result = run_search(Search(design, concept, starts=1))
    if result.best is None:
        raise ValueError(result.message)
    bands = ("flat", result.band), ("doubt", result.doubt_band)
    ranges = [TwistRange(cause, (band[0].low, band[0].high)) for cause, band in bands if band]

    guesses = (result.best.parameters,)

    def rate(other: Design) -> float:
        search = Search(other, concept, guesses=guesses, starts=1, band=False)
        best = run_search(search).best
        return math.nan if best is None else best.parameters[0]

    for cause, ends, designs in nearby_flights(design):
        ranges.append(TwistRange(cause, (rate(designs[0]), rate(designs[1])), ends))
    if design.hovering:
        ranges += [
            TwistRange("wake", (result.best.parameters[0], rate(line)))
            for line in other_models(design).values()
        ]
    known = tuple(each for each in ranges if math.isfinite(each.width))
    return BestTwist(result.best.parameters[0], known, result.doubt_cost)


def nearby_flights(design: Design) -> list[tuple[str, tuple[float, float], tuple[Design, Design]]]:
    """The cause, its ends [kg] or [m²] and the designs there: lighter and heavier, sleek and with more drag.

    Empty on a test stand, where neither counts.
    """
    condition, fuselage = design.condition, design.fuselage
    if condition.stand is not None:
        return []
    low, high = (share * condition.mass for share in MASSES)
    masses = replace(condition, mass=low), replace(condition, mass=high)
    flights = [
        (
            "mass",
            (low, high),
            (replace(design, condition=masses[0]), replace(design, condition=masses[1])),
        )
    ]
    if fuselage.drag_area and not design.hovering:
        low, high = (share * fuselage.drag_area for share in DRAG_AREAS)
        bodies = replace(fuselage, drag_area=low), replace(fuselage, drag_area=high)
        flights.append(
            (
                "drag area",
                (low, high),
                (replace(design, fuselage=bodies[0]), replace(design, fuselage=bodies[1])),
            )
        )
    return flights
