"""How sure the saving of a search is, and where its best twist may lie: what uncertain inputs do to both.

An uncertain input adds δ(x) to the power P(x) of twist parameters x, to first order (`rotor.trim.doubt`). The least of
P + δ lies beside that of P by −H⁻¹ ∇δ with H = ∇²P, both by central differences: of the exact gradient of P, and of δ.
Inputs are independent, so the shifts of a parameter are summed as squares.
"""

from collections.abc import Callable, Sequence

import numpy as np

from rotor.design.design import Design
from rotor.design.uncertain import uncertain_inputs
from rotor.optimisation.concept import Concept
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import Objective, evaluate_objective, evaluate_objectives
from rotor.optimisation.results import ParameterBand
from rotor.support.arrays import Array
from rotor.trim.analysis import Analysis, analysed
from rotor.trim.doubt import Doubt, DoubtRow
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


def saving_doubt(objective: Objective, best: Design, baseline: Design, starts: Starts = _cold) -> Doubt | None:
    """The uncertainty of a mean power and of its difference from that of the baseline.

    None where one does not trim, or the objective is not total power.
    """
    if objective.quantity != "total":
        return None
    here, there = (
        evaluate_objective(objective, design, starts(design), gradient=False).trims for design in (best, baseline)
    )
    return mean_doubt(objective.shares, here, there)


def mean_doubt(
    shares: Sequence[float], here: Sequence[Solution | Analysis], there: Sequence[Solution | Analysis]
) -> Doubt | None:
    """The uncertainty of a mean power over conditions, and of its difference from other trims; None where one is
    missing."""
    ours, theirs = ([analysed(trim).solution for trim in trims] for trims in (here, there))
    if len(here) < len(shares) or len(there) < len(shares) or not all(trim.converged for trim in (*ours, *theirs)):
        return None
    power, other = (
        sum(share * trim.power.total for share, trim in zip(shares, trims, strict=True)) for trims in (ours, theirs)
    )
    changes, others = _changes(shares, here), _changes(shares, there)
    rows = [
        DoubtRow(row.name, row.words, row.size, row.source, changes[row.name], changes[row.name] - others[row.name])
        for row in uncertain_inputs(ours[0].design)
        if row.name in changes and row.name in others
    ]
    rows.sort(key=lambda row: -abs(row.change or 0.0))
    return Doubt(power, tuple(rows), other, theirs[0].design.twist.spec())


def _changes(shares: Sequence[float], trims: Sequence[Solution | Analysis]) -> dict[str, float]:
    """What every uncertain input does to the mean power [W]."""
    changes = dict[str, float]()
    for share, trim in zip(shares, trims, strict=True):
        for name, change in analysed(trim).power_changes.items():
            changes[name] = changes.get(name, 0.0) + share * change
    return changes


def best_twist_doubt(
    design: Design,
    concept: Concept,
    objective: Objective,
    limits: Limits,
    best: tuple[float, ...],
    starts: Starts = _cold,
) -> tuple[ParameterBand, ...]:
    """The range of each parameter of the best twist that follows from the uncertain inputs, within its bounds, SI.

    Empty where the objective is not total power, a neighbour does not trim, or the best lies on a bound.
    """
    low, high = (np.array(ends) for ends in zip(*limits.bounds_of(concept), strict=True))
    x, steps = np.array(best), _STEP * (high - low)
    if objective.quantity != "total" or np.any(x - steps < low) or np.any(x + steps > high):
        return ()

    places = [tuple((x + sign * step).tolist()) for step in np.diag(steps) for sign in (1.0, -1.0)]
    designs = [concept.apply(design, place) for place in places]
    found = evaluate_objectives(objective, designs, [starts(each) for each in designs])
    gradients, changes = list[Array](), list[dict[str, float]]()
    for place, measured in zip(places, found, strict=True):
        if measured.by_pitch is None:
            return ()
        gradients.append(concept.slopes(place, measured.solutions[0].disk.r) @ measured.by_pitch)
        changes.append(_changes(objective.shares, measured.trims))
    width = 2.0 * steps[:, None]
    hessian = (np.array(gradients[::2]) - np.array(gradients[1::2])) / width
    names = list(changes[0])
    by_input = np.array([[each[name] for name in names] for each in changes])
    slopes = (by_input[::2] - by_input[1::2]) / width
    values, axes = np.linalg.eigh(0.5 * (hessian + hessian.T))
    if values.min() <= 0.0:
        return ()
    shifts = -(axes @ ((axes.T @ slopes) / values[:, None]))
    words = {row.name: row.words for row in uncertain_inputs(design)}
    return tuple(
        ParameterBand(
            parameter.name,
            float(max(centre - half, least)),
            float(min(centre + half, most)),
            tuple((words[names[k]], float(shift[k])) for k in np.argsort(-np.abs(shift))[:MOST_INPUTS]),
        )
        for parameter, centre, shift, half, least, most in zip(
            concept.parameters, x, shifts, np.sqrt(np.square(shifts).sum(axis=1)), low, high, strict=True
        )
    )
