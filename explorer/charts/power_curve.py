"""Power against advance ratio, swept after the frame and abandoned when newer input waits."""

import math
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from explorer.charts.plots import SWEEP, PowerCurve
from explorer.text.readout import ideal_induced
from explorer.workers.scheduler import SCHEDULER
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.trim.low_speed import passes_over
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.trim.validity import LOW_SPEED

PATIENCE = 0.6
"""A curve older than this [s] is swept coarsely even while a slider moves, so that it follows a long drag."""
HASTE = 0.15
"""[s] that such a sweep may delay a drag; if it takes longer, the machine is busy and frames come first."""
_KEPT = 200
"""Curves remembered per session."""


class PowerCurves:
    """The curves of one session, total and ideal power; a curve belongs to a design at any speed."""

    def __init__(self, haste: float = HASTE) -> None:
        self._haste = haste
        self._curves: dict[Design, Array] = {}
        """(2, points): total and ideal [kW]."""
        self._coarse: set[Design] = set()
        """Curves swept coarsely, to be swept again once there is time."""
        self._last: tuple[Design | None, float] = (None, -math.inf)

    @property
    def recent(self) -> bool:
        """Whether the last sweep is so fresh that the next can wait until a drag ends."""
        return time.monotonic() - self._last[1] < PATIENCE

    def known(self, design: Design, reference: Design) -> PowerCurve:
        """The curves of a design and of its reference; until the design is swept, the curve before it."""
        blank = np.full((2, len(SWEEP)), math.nan)
        last = self._last[0]
        alike = last is not None and last.aircraft == design.aircraft
        before = self._curves.get(last, blank) if last is not None and alike else blank
        family = _family(design)
        total, ideal = self._curves.get(family, before)
        return PowerCurve(total, self._curves.get(_family(reference), blank)[0], ideal, family in self._curves)

    def sweep(
        self,
        design: Design,
        reference: Design,
        superseded: Callable[[], bool],
        known: Callable[[], None] = lambda: None,
    ) -> bool:
        """Sweep the curves of a design and its reference; False when abandoned half way.

        `known`: called after each of the two.
        """
        patient = self.recent
        for family in (_family(design), _family(reference)):
            if family not in self._curves or family in self._coarse:
                values, coarse = self._swept(family, superseded, patient)
                if values is None:
                    return False
                self._keep(family, values, coarse)
            if family == _family(design):
                self._last = (family, time.monotonic())
            known()
        return True

    def _swept(self, family: Design, superseded: Callable[[], bool], patient: bool) -> tuple[Array | None, bool]:
        """Total and ideal power over `SWEEP`, and whether coarse; None when abandoned for newer input."""
        coarse, begun = False, time.monotonic()
        values = np.full((2, len(SWEEP)), math.nan)
        start: Solution | None = None
        lost = 0
        for k, mu in enumerate(SWEEP):
            if superseded():
                if patient or SCHEDULER.waiting or time.monotonic() - begun > self._haste:
                    return None, False
                coarse = True
            if lost == (1 if coarse else 2):
                break  # Faster flight does not trim either, and each failed trim takes long.
            if (coarse and k % 3 and k != 1) or (0.0 < mu < LOW_SPEED and not passes_over(family)):
                continue
            try:
                design = family.at(mu=mu)
            except ValueError:  # A free rotor in hover.
                continue
            point = solve(design, start)
            lost = 0 if point.converged else lost + 1
            if point.converged:
                start, values[:, k] = point, _powers(point)
        first = 0 if passes_over(family) else 1
        return np.stack([_bridged(row, first) for row in values]) if coarse else values, coarse

    def _keep(self, family: Design, values: Array, coarse: bool) -> None:
        if len(self._curves) >= _KEPT:
            del self._curves[next(iter(self._curves))]
        self._curves[family] = values
        self._coarse = (self._coarse | {family}) if coarse else (self._coarse - {family})


def _family(design: Design) -> Design:
    """The same design for every advance ratio; a test may not know hover, so there it is another one."""
    any_speed = 0.0 if design.condition.stand is None else 0.2
    return replace(design, condition=replace(design.condition, advance_ratio=any_speed))


def _powers(point: Solution) -> tuple[float, float]:
    """Total power, and total power with the least induced power at this lift [kW], which is NaN at low speed."""
    total, slow = point.power.total / 1e3, 0.0 < point.design.condition.advance_ratio < LOW_SPEED
    ideal = None if slow else ideal_induced(point)
    return total, math.nan if ideal is None else total - (point.power.induced - ideal) / 1e3


def _bridged(values: Array, first: int) -> Array:
    """Fill the points left out of a coarse sweep by a smooth line, from `first` on."""
    k = np.arange(len(values))
    have = np.isfinite(values) & (k >= first)
    if have.sum() < 2:
        return values
    line = PchipInterpolator(k[have], values[have], extrapolate=False)
    return np.where(k >= first, line(k), values)
