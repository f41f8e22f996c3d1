"""From one start to one local minimum: sequential quadratic programming on the exact gradient."""

from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array
from rotor.optimisation.evaluator import Evaluator
from rotor.optimisation.metric import Metric
from rotor.optimisation.record import Record
from rotor.optimisation.slsqp import Inequality, slsqp, walls

TOLERANCE = 2e-4
"""Change of the objective at which a descent ends, in units of the metric: 4e-7 of the power."""
_ITERATIONS = 60


@dataclass(frozen=True, eq=False)
class Descent:
    """Where a descent ended."""

    end: Record | None
    """The best feasible point on the way; None when there was none."""
    settled: bool
    """Whether it ended by itself, at what looks like a minimum."""


def descend(evaluate: Evaluator, metric: Metric, first: Record) -> Descent:
    """Descend from a point that trims."""
    asked = Asked(evaluate, metric, first)
    seen_before = len(evaluate.records)
    inequalities = [walls(metric)]
    if first.margins.size:
        inequalities.append(Inequality(asked.margins, asked.margin_slopes))
    settled = slsqp(
        asked.value, asked.slope, metric.y(first.x), inequalities, iterations=_ITERATIONS, tolerance=TOLERANCE
    )
    seen = [record for record in (first, *evaluate.records[seen_before:]) if record.feasible]
    return Descent(min(seen, key=lambda record: record.watts, default=None), settled)


class Asked:
    """What SLSQP asks, from one evaluation a point."""

    def __init__(self, evaluate: Evaluator, metric: Metric, first: Record) -> None:
        self.evaluate, self.metric = evaluate, metric
        self.trimmed = [first]
        self._key, self._record = metric.y(first.x).tobytes(), first

    def at(self, y: Array) -> Record:
        """The record of a point."""
        key = y.tobytes()
        if key != self._key:
            self._key, self._record = key, self.evaluate(self.metric.x(y))
            if self._record.power is not None:
                self.trimmed.append(self._record)
        return self._record

    def value(self, y: Array) -> float:
        """Power in units of the metric. Where nothing trims: a cone that leads back to the nearest point that did."""
        record = self.at(y)
        if record.power is not None:
            return record.power / self.metric.unit
        worst = max(one.watts for one in self.trimmed)
        return 1.01 * worst / self.metric.unit + float(np.linalg.norm(self._away(record)))

    def slope(self, y: Array) -> Array:
        """Its gradient."""
        record = self.at(y)
        if record.power is not None:
            return self.metric.stretch.T @ record.slope / self.metric.unit
        away = self._away(record)
        return away / max(float(np.linalg.norm(away)), 1e-12)

    def margins(self, y: Array) -> Array:
        """What is left of the limits; where nothing trims, what was left at the nearest point that did."""
        return self._trimmed_at(y).margins

    def margin_slopes(self, y: Array) -> Array:
        """Their gradients."""
        return self._trimmed_at(y).margin_slopes @ self.metric.stretch

    def _trimmed_at(self, y: Array) -> Record:
        record = self.at(y)
        return record if record.power is not None else self._near(record)

    def _away(self, record: Record) -> Array:
        return self.metric.y(record.x) - self.metric.y(self._near(record).x)

    def _near(self, record: Record) -> Record:
        return min(self.trimmed, key=lambda one: float(((one.x - record.x) ** 2).sum()))
