"""How sure the saving of a search is, and where its best twist may lie: what uncertain inputs do to both.

An uncertain input adds δ(x) to the power P(x) of twist parameters x, to first order (`rotor.trim.doubt`). The least of
P + δ lies beside that of P by s = −H⁻¹ ∇δ with H = ∇²P, both by central differences: of the exact gradient of P, and of
δ. Another inflow model has its own P and H; its least, by one step of Newton's method, is a shift as well, to its own
side only. Inputs are independent, so the shifts of a parameter are summed as squares. A twist that is off by s needs
½ sᵀ H s more power.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rotor.design.design import Design
from rotor.design.uncertain import uncertain_inputs
from rotor.optimisation.concept import Concept
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import (
    Objective,
    ObjectiveValue,
    evaluate_objective,
    evaluate_objectives,
)
from rotor.optimisation.results import ParameterBand
from rotor.support.arrays import Array
from rotor.trim.analysis import Analysis, analysed
from rotor.trim.doubt import Doubt, mean_changes, mean_doubt, with_other_inflow
from rotor.trim.solution import Solution

_STEP = 0.03
"""Step of a parameter, as a part of its range: 0.9° of a rate."""
MOST_INPUTS = 2
"""Inputs named beside the band of a parameter."""


Starts = Callable[[Design], Sequence[Solution]]
"""From a design to trims near its own, by condition, or none."""


def _cold(design: Design) -> Sequence[Solution]:
    del design
    return ()


def saving_doubt(
    objective: Objective, best: Design, baseline: Design, starts: Starts = _cold
) -> Doubt | None:
    """The uncertainty of a mean power and of its difference from that of the baseline.

    None where one does not trim.
    """
    here, there = (
        evaluate_objective(objective, one, starts(one), gradient=False).trims
        for one in (best, baseline)
    )
    return difference_doubt(objective.shares, here, there, induced=objective.quantity == "induced")


def difference_doubt(
    shares: Sequence[float],
    here: Sequence[Solution | Analysis],
    there: Sequence[Solution | Analysis],
    *,
    induced: bool = False,
) -> Doubt | None:
    """The uncertainty of a mean power over conditions, or of induced power alone, and of its difference from other
    trims; None where one is missing."""
    ours, theirs = ([analysed(trim) for trim in trims] for trims in (here, there))
    if min(len(here), len(there)) < len(shares) or not all(
        trim.solution.converged for trim in (*ours, *theirs)
    ):
        return None
    return mean_doubt(shares, ours, theirs, induced=induced)


@dataclass(frozen=True)
class BestTwistDoubt:
    """Range of the best twist under uncertain inputs and other models."""

    bands: tuple[ParameterBand, ...] = ()
    """The range of each parameter within its bounds, SI."""
    cost: float | None = None
    """Power that the best twist found is expected to need above the least [W]."""


def best_twist_doubt(
    design: Design,
    concept: Concept,
    objective: Objective,
    limits: Limits,
    best: tuple[float, ...],
    starts: Starts = _cold,
) -> BestTwistDoubt:
    """The range of the best twist under the uncertain inputs, and with another inflow model.

    Empty where the objective is not total power, a neighbour does not trim, or the best lies on a bound.
    """
    low, high = (np.array(ends) for ends in zip(*limits.bounds_of(concept), strict=True))
    x, steps = np.array(best), _STEP * (high - low)
    if objective.quantity != "total" or np.any(x - steps < low) or np.any(x + steps > high):
        return BestTwistDoubt()

    places = [tuple((x + sign * step).tolist()) for step in np.diag(steps) for sign in (1.0, -1.0)]
    designs = [concept.apply(design, place) for place in places]
    found = evaluate_objectives(objective, designs, [starts(each) for each in designs])
    powers = _gradients(concept, places, steps, found)
    if powers is None:
        return BestTwistDoubt()
    hessian = _slopes(powers, steps)
    hessian = 0.5 * (hessian + hessian.T)
    changes = [mean_changes(objective.shares, each.trims) for each in found]
    names = list(changes[0])
    by_input = np.array([[each[name].sum() for name in names] for each in changes])
    shifts = _solved(hessian, -_slopes(by_input, steps))
    words = {row.name: row.words for row in uncertain_inputs(design)}
    others = [with_other_inflow(each) for each in designs]
    flies = not all(solution.design.hovering for solution in found[0].solutions)
    there = None
    if flies:
        there = _gradients(
            concept, places, steps, evaluate_objectives(objective, others, [()] * len(others))
        )
    below = above = np.square(shifts).sum(axis=1)
    if there is not None:
        aside = _solved(_slopes(there, steps), -there.mean(axis=0))
        below, above = (
            below + np.square(np.minimum(aside, 0.0)),
            above + np.square(np.maximum(aside, 0.0)),
        )
        shifts = np.column_stack((shifts, aside))
        names.append(f"inflow {others[0].models.inflow}")
        words[names[-1]] = names[-1]
    bands = tuple(
        ParameterBand(
            parameter.name,
            float(max(centre - math.sqrt(down), least)),
            float(min(centre + math.sqrt(up), most)),
            tuple(
                (words[names[k]], float(shift[k])) for k in np.argsort(-np.abs(shift))[:MOST_INPUTS]
            ),
        )
        for parameter, centre, shift, down, up, least, most in zip(
            concept.parameters, x, shifts, below, above, low, high, strict=True
        )
    )
    return BestTwistDoubt(bands, 0.5 * float(np.sum(shifts * (hessian @ shifts))))


def _slopes(values: Array, steps: Array) -> Array:
    """Slopes by each parameter of values at pairs of places, a step up and a step down, (parameters, …)."""
    return (values[::2] - values[1::2]) / (2.0 * steps[:, None])


def _gradients(
    concept: Concept,
    places: Sequence[tuple[float, ...]],
    steps: Array,
    found: Sequence[ObjectiveValue],
) -> Array | None:
    """∇P at every place, (places, parameters); None unless P has a minimum nearby."""
    rows = [
        concept.slopes(place, each.trims[0].linear.problem.disk.r) @ each.by_pitch
        for place, each in zip(places, found, strict=True)
        if each.by_pitch is not None
    ]
    if len(rows) < len(places):
        return None
    hessian = _slopes(np.array(rows), steps)
    return np.array(rows) if np.linalg.eigvalsh(hessian + hessian.T).min() > 0.0 else None


def _solved(matrix: Array, right: Array) -> Array:
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
