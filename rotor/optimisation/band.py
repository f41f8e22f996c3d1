"""How flat the optimum is: the reach of each parameter within BAND of the least power, the others re-optimised.

For each parameter and side this is a small problem of its own, the farthest value with P ≤ (1 + BAND) P*, limits and
bounds kept, solved by SLSQP from the tip of the ellipsoid that the metric predicts. What the search has already seen
inside the band widens it.
"""

import numpy as np

from rotor.arrays import Array
from rotor.optimisation.descent import Asked
from rotor.optimisation.evaluator import Evaluator
from rotor.optimisation.metric import BAND, Metric
from rotor.optimisation.record import Record
from rotor.optimisation.results import Band
from rotor.optimisation.slsqp import Inequality, slsqp, walls

_TOLERANCE = 1e-3
"""Of the reach, at which a side is done."""
_INSIDE = 2e-5
"""Power above the edge of the band that still counts as on it: two per cent of the band."""
_ITERATIONS = 7


def measure_band(evaluate: Evaluator, metric: Metric, best: Record) -> tuple[Band, ...]:
    """The band of every parameter, SI."""
    edge = best.watts * (1.0 + BAND)
    found: list[Band] = []
    for k, parameter in enumerate(evaluate.concept.parameters):
        ends: list[float] = []
        for side in (-1.0, 1.0):
            _go(evaluate, metric, best, edge, side * metric.stretch[k])
            inside = [one for one in evaluate.records if one.feasible and one.watts <= edge * (1.0 + _INSIDE)]
            ends.append(side * max(side * float(one.x[k]) for one in inside))
        low, high = (float(evaluate.low[k] + evaluate.span[k] * end) for end in ends)
        found.append(Band(parameter.name, low, high))
    return tuple(found)


def _go(evaluate: Evaluator, metric: Metric, best: Record, edge: float, row: Array) -> None:
    """Go as far as the band allows along one row of the metric; the evaluations on the way are what counts."""
    asked = Asked(evaluate, metric, best)
    along = row / np.linalg.norm(row)
    centre = metric.y(best.x)
    scale = BAND * best.watts

    def room(y: Array) -> Array:
        record = asked.at(y)
        if record.power is None:  # Outside by the square of the distance, as a round bowl would have it.
            return np.array([1.0 - float(((y - centre) ** 2).sum())])
        return np.array([(edge - record.power) / scale])

    def room_slope(y: Array) -> Array:
        record = asked.at(y)
        if record.power is None:
            return -2.0 * (y - centre)[None]
        return -(metric.stretch.T @ record.slope)[None] / scale

    inequalities = [Inequality(room, room_slope), walls(metric)]
    if best.margins.size:
        inequalities.append(Inequality(asked.margins, asked.margin_slopes))
    slsqp(
        lambda y: -float(along @ y),
        lambda _: -along,
        centre + along,
        inequalities,
        iterations=_ITERATIONS,
        tolerance=_TOLERANCE,
    )
