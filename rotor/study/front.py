"""Hover power against cruise power: which blades no other one beats in both."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor.study.results import Floats, Ints, Results

_MOST = 100
"""Speeds of an axis; more than these are sampled, and no two points share one."""


@dataclass(frozen=True, eq=False)
class Pairs:
    """Blades with their power in hover and in cruise; arrays are (blades,)."""

    hover: Floats
    """[W]"""
    cruise: Floats
    """[W]"""
    row: Ints
    """The row of the results that has the cruise."""

    @property
    def best(self) -> NDArray[np.bool_]:
        """The blades that none beats in one power without losing in the other."""
        order = np.lexsort((self.hover, self.cruise))
        before = np.minimum.accumulate(np.concatenate([[math.inf], self.hover[order][:-1]]))
        best = np.zeros(len(self.hover), dtype=bool)
        best[order] = self.hover[order] < before
        return best


def cruise_speeds(results: Results) -> tuple[float, ...]:
    """Advance ratios for which there may be pairs: those beside hover on the axis, or all where hover is a column."""
    speeds: list[float] = np.unique(results.columns["mu"][results.good]).tolist()
    if _has_hover(results):
        return tuple(speeds)
    return tuple(speeds[1:]) if "mu" in results.axes and speeds and speeds[0] == 0.0 and len(speeds) <= _MOST else ()


def pairs_at(results: Results, cruise: float) -> Pairs:
    """All pairs of a cruise speed: rows that agree in every axis but speed, or rows that know their hover power."""
    power, mu = results.columns["power_total_w"], results.columns["mu"]
    here = np.flatnonzero(results.good & (mu == cruise))
    if _has_hover(results):
        hover = results.columns["hover_power_w"][here]
        known = np.isfinite(hover)
        return Pairs(hover[known], power[here][known], here[known])
    code = results.codes(tuple(name for name in results.axes if name != "mu"))
    hovering = np.full(int(code.max(initial=0)) + 1, math.nan)
    still = results.good & (mu == 0.0)
    hovering[code[still]] = power[still]
    hover = hovering[code[here]]
    known = np.isfinite(hover)
    return Pairs(hover[known], power[here][known], here[known])


def _has_hover(results: Results) -> bool:
    column = results.columns.get("hover_power_w")
    return column is not None and bool(np.isfinite(column).any())
