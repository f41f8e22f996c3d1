"""What a study shows: best point, robust best design, main effects, and the Pareto front of hover and cruise."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotor.arrays import Array
from rotor.study.results import Ints, Results

_MANY = 20
"""Number of values from which an axis is divided into ten parts."""
_FEW = 10
"""Least mean number of values per part of a sampled axis: with fewer, noise looks like an effect."""


@dataclass(frozen=True)
class RobustDesign:
    """A design and its results over all uncertain cases."""

    design: dict[str, Any]
    """Values of the axes that are not uncertain."""
    worst: float
    mean: float
    cases: int


@dataclass(frozen=True)
class RobustBest:
    """The best designs over all uncertain cases."""

    least_worst: RobustDesign
    least_mean: RobustDesign
    designs: int
    """Number of designs compared: those with a result in every case."""
    dropped: int
    """Number of designs left out: a case failed or is missing."""


def best_row(results: Results, least: str) -> int | None:
    """The row with the least value of a column; None where no row has one."""
    values = np.where(results.good, results.columns[least], math.nan)
    return int(np.nanargmin(values)) if np.isfinite(values).any() else None


def robust_best(results: Results, least: str, uncertain: tuple[str, ...]) -> RobustBest | None:
    """The design of the least worst case and that of the least mean; None where no design has all its cases.

    Designs differ in the axes that are not uncertain. Each must have results in as many cases as the finished rows have
    combinations of the uncertain axes.
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

    def robust(of: Array) -> RobustDesign:
        at = int(np.argmin(np.where(whole, of, math.inf)))
        row = int(np.argmax(design == at))
        return RobustDesign(
            {name: results.columns[name][row] for name in chosen}, float(worst[at]), float(mean[at]), cases
        )

    return RobustBest(robust(worst), robust(mean), int(whole.sum()), int((~whole).sum()))


@dataclass(frozen=True)
class Effect:
    """Main effect of one axis, averaged over all others."""

    axis: str
    share: float
    """Fraction of the variance due to this axis alone (0…1), the first-order Sobol' index."""
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


def _effect(axis: str, levels: list[Any], code: Ints, values: Array) -> Effect:
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


_MOST = 100
"""Speeds of an axis; more than these are sampled, and no two points share one."""


@dataclass(frozen=True, eq=False)
class HoverCruisePairs:
    """Blades with their power in hover and in cruise; arrays are (blades,)."""

    hover: Array
    """[W]"""
    cruise: Array
    """[W]"""
    row: Ints
    """The row of the results that has the cruise."""

    @property
    def best(self) -> NDArray[np.bool_]:
        """Pareto front: blades that no other one beats in both powers."""
        order = np.lexsort((self.hover, self.cruise))
        before = np.minimum.accumulate(np.concatenate([[math.inf], self.hover[order][:-1]]))
        best = np.zeros(len(self.hover), dtype=bool)
        best[order] = self.hover[order] < before
        return best


def cruise_speeds(results: Results) -> tuple[float, ...]:
    """Advance ratios that may have pairs: those on an axis that also has hover, or all where hover is a column."""
    speeds: list[float] = np.unique(results.columns["mu"][results.good]).tolist()
    if _has_hover(results):
        return tuple(speeds)
    return tuple(speeds[1:]) if "mu" in results.axes and speeds and speeds[0] == 0.0 and len(speeds) <= _MOST else ()


def hover_cruise_pairs(results: Results, cruise: float) -> HoverCruisePairs:
    """Pairs at a cruise speed: rows that agree in every axis but speed, or rows with their own hover power."""
    power, mu = results.columns["power_total_w"], results.columns["mu"]
    here = np.flatnonzero(results.good & (mu == cruise))
    if _has_hover(results):
        hover = results.columns["hover_power_w"][here]
        known = np.isfinite(hover)
        return HoverCruisePairs(hover[known], power[here][known], here[known])
    code = results.codes(tuple(name for name in results.axes if name != "mu"))
    hovering = np.full(int(code.max(initial=0)) + 1, math.nan)
    still = results.good & (mu == 0.0)
    hovering[code[still]] = power[still]
    hover = hovering[code[here]]
    known = np.isfinite(hover)
    return HoverCruisePairs(hover[known], power[here][known], here[known])


def _has_hover(results: Results) -> bool:
    column = results.columns.get("hover_power_w")
    return column is not None and bool(np.isfinite(column).any())
