"""What the table of a study says: the best point, the robust best, what matters."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotor.study.results import Floats, Ints, Results

_MANY = 20
"""Values of an axis from which it is looked at in tenths."""
_FEW = 10
"""Values of a sampled axis that a part of its range must hold in the mean: with less, chance looks like an effect."""


@dataclass(frozen=True)
class Robust:
    """A design, and how it does over everything that nobody can choose."""

    design: dict[str, Any]
    """Values of the axes that can be chosen."""
    worst: float
    mean: float
    cases: int


@dataclass(frozen=True)
class RobustBest:
    """The designs that do best over all uncertain cases."""

    least_worst: Robust
    least_mean: Robust
    designs: int
    """Compared: those that have an answer in every case."""
    dropped: int
    """Left out, because a case failed or is still missing."""


def best_row(results: Results, least: str) -> int | None:
    """The row with the least value of a column; None where no row has one."""
    values = np.where(results.good, results.columns[least], math.nan)
    return int(np.nanargmin(values)) if np.isfinite(values).any() else None


def robust_best(results: Results, least: str, uncertain: tuple[str, ...]) -> RobustBest | None:
    """The design of the least worst case and that of the least mean; None where no design has all its cases.

    Designs are told apart by the axes that are not uncertain. Each must have answers in as many cases as the study
    has combinations of the uncertain axes, as far as the finished rows show them.
    """
    chosen = tuple(name for name in results.axes if name not in uncertain)
    design, case = results.codes(chosen), results.codes(uncertain)
    cases, designs = int(case.max()) + 1, int(design.max()) + 1
    values = np.where(results.good, results.columns[least], math.nan)
    known = np.isfinite(values)
    count = np.bincount(design[known], minlength=designs)
    whole = count == cases
    if not whole.any():
        return None
    worst = np.full(designs, -math.inf)
    np.maximum.at(worst, design[known], values[known])
    mean = np.bincount(design[known], weights=values[known], minlength=designs) / np.maximum(count, 1)

    def robust(of: Floats) -> Robust:
        at = int(np.argmin(np.where(whole, of, math.inf)))
        row = int(np.argmax(design == at))
        return Robust({name: results.columns[name][row] for name in chosen}, float(worst[at]), float(mean[at]), cases)

    return RobustBest(robust(worst), robust(mean), int(whole.sum()), int((~whole).sum()))


@dataclass(frozen=True)
class Effect:
    """What one axis does by itself, all others averaged over."""

    axis: str
    share: float
    """Part of the column's variance that goes with this axis alone (0…1); the first-order index of Sobol' sense."""
    least_at: Any
    least: float
    """Mean of the column at the value, or in the part of the range, where that is least."""
    most_at: Any
    most: float


def effects(results: Results, column: str) -> tuple[Effect, ...]:
    """The main effect of every axis on a column, the strongest first; ranges in tenths, or in fewer parts."""
    values = results.columns[column]
    known = results.good & np.isfinite(values)
    if known.sum() < 2 or float(np.var(values[known])) == 0.0:
        return ()
    found = [
        _effect(axis, *_levels(results.columns[axis][known], axis in results.sampled), values[known])
        for axis in results.axes
    ]
    return tuple(sorted(found, key=lambda one: -one.share))


def _effect(axis: str, levels: list[Any], code: Ints, values: Floats) -> Effect:
    count = np.bincount(code, minlength=len(levels))
    means = np.bincount(code, weights=values, minlength=len(levels)) / np.maximum(count, 1)
    share = float((count * (means - values.mean()) ** 2).sum() / count.sum() / np.var(values))
    low = int(np.argmin(np.where(count > 0, means, math.inf)))
    high = int(np.argmax(np.where(count > 0, means, -math.inf)))
    return Effect(axis, share, levels[low], float(means[low]), levels[high], float(means[high]))


def _levels(at: NDArray[Any], sampled: bool) -> tuple[list[Any], Ints]:
    """The values of an axis, or the middles of parts of its range where it has many; and which one each row has."""
    levels, code = np.unique(at if at.dtype == np.float64 else at.astype(str), return_inverse=True)
    if at.dtype == np.float64 and (sampled or len(levels) > _MANY):
        parts = min(10, max(2, len(levels) // _FEW)) if sampled else 10
        low, part = float(levels[0]), float(levels[-1] - levels[0]) / parts or 1.0
        middles = [low + (k + 0.5) * part for k in range(parts)]
        return middles, np.clip(np.floor((at - low) / part), 0, parts - 1).astype(np.int64)
    return levels.tolist(), code.astype(np.int64)
