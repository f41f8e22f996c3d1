"""From one start to one local minimum, and how flat the minimum is.

The objective, power or vibration index, is a smooth function of the pitch of every blade element, power close to
quadratic, and each trim gives its exact gradient. So each trim is of use for all blades, whatever their concept. The
second derivatives by pitch are the least squares of the changes of gradient between the trims known. With value and
gradient at one trim they make a model, in which a law bends as it does where a break passes an element. A descent goes
to the least of the model within a region of trust, evaluates there, and begins again with the better model (Conn,
Gould, Toint 2000).

The band of a parameter is how far it can go with the objective ≤ (1 + BAND) of the least, the others re-optimised:
the ends of the model, evaluated, and corrected with the model at that evaluation.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import scipy

from rotor.optimisation.evaluator import Evaluation, Evaluator, TrimmedBlade
from rotor.optimisation.objective import ObjectiveValue, Quantity, evaluate_objectives
from rotor.optimisation.results import ParameterBand
from rotor.support.arrays import Array
from rotor.trim.newton import SolverOptions

BAND = 1e-3
"""Relative rise of the objective that defines the band of each parameter."""
_FULL_WEIGHT_RAD = 0.02
"""Distance [rad], about 10°/R of a straight blade, within which trims have full weight for the second derivatives."""
_SAME_BLADE_RAD = 1e-6
"""Distance [rad] within which two blades are the same."""
_PRIOR_WEIGHT = 1e-3
"""Weight of the mean curvature in directions without trims, beside 1 of a trim."""
_FIRST_CURVATURE = 200.0
"""Curvature [1/rad²] over the objective, while there is one trim only: some per cent over half the range of a rate."""
_LEAST_CURVATURE = 2e-3
"""Least curvature over the largest; flatter directions are left to the descent."""


def second_derivatives(steps: Array, changes: Array, weights: Array, elsewhere: float) -> Array:
    """The symmetric H with H·step = change by least squares, `elsewhere` times 1 where no step leads, (n, n).

    steps, changes: (trims, n). Least squares of H s − y and of H − c 1 gives H A + A H = B, solved along the axes of A.
    """
    length = np.asarray(np.linalg.norm(steps, axis=1))
    scale = (np.sqrt(weights) / length)[:, None]
    s, y = scale * steps, scale * changes
    curvature = (
        max(float(np.vdot(s, y) / np.vdot(s, s)), 0.0) if len(steps) and elsewhere else elsewhere
    )
    size, axes = np.linalg.eigh(s.T @ s + _PRIOR_WEIGHT * np.eye(steps.shape[1]))
    right = y.T @ s + s.T @ y + 2.0 * _PRIOR_WEIGHT * curvature * np.eye(len(size))
    return axes @ (axes.T @ right @ axes / (size[:, None] + size)) @ axes.T


@dataclass(frozen=True, eq=False)
class QuadraticMeasure:
    """A measure of the blade near one trim, as a function of the twist at the elements."""

    pitch: Array
    value: float
    slope: Array
    """[1/rad], (elements,)"""
    second: Array
    """[1/rad²], (elements, elements)"""

    def at(self, pitch: Array) -> tuple[float, Array]:
        """Value, and slope by the twist at the elements."""
        step = pitch - self.pitch
        bent = self.second @ step
        return self.value + float((self.slope + 0.5 * bent) @ step), self.slope + bent


def _known(measured: ObjectiveValue) -> tuple[float, Array]:
    """The objective and its slope by pitch [1/rad] of a blade that trims."""
    assert measured.value is not None
    assert measured.by_pitch is not None
    return measured.value, measured.by_pitch


_Measure = Callable[[Array], tuple[Any, Array]]
"""Value or values at x, and slopes by x."""
_MODEL_ITERATIONS = 40
_MODEL_TOLERANCE = 1e-6
"""Tolerance of the least of the model, in units of 2 BAND of the objective."""


class LocalModel:
    """The objective and what limits hold as quadratics around one trim, limits and bounds as they are."""

    def __init__(
        self, evaluate: Evaluator, centre: TrimmedBlade, others: Sequence[TrimmedBlade]
    ) -> None:
        """others: trims that the second derivatives are made of; those of other rotors are left out."""
        self.evaluate = evaluate
        measured = centre.measured
        value, by_pitch = _known(measured)
        # Lift follows the square of the radius.
        metric = evaluate.r * math.sqrt(1.0 / len(evaluate.r))
        pairs = [
            (other.measured, step, length)
            for other in others
            if other.rotor == centre.rotor and _known(other.measured)[0] < 1.5 * value
            for step in [(other.pitch - centre.pitch) * metric]
            if (length := float(np.linalg.norm(step))) > _SAME_BLADE_RAD
        ]
        steps = np.array([step for _, step, _ in pairs]).reshape(-1, len(metric))
        weights = (
            1.0
            / (1.0 + (np.array([length for _, _, length in pairs]) / _FULL_WEIGHT_RAD) ** 2) ** 2
        )

        def fit(slope: Array, slopes: Sequence[Array], elsewhere: float) -> Array:
            changes = np.array([(other - slope) / metric for other in slopes]).reshape(steps.shape)
            return second_derivatives(steps, changes, weights, elsewhere)

        first = _FIRST_CURVATURE * value
        size, axes = np.linalg.eigh(
            fit(by_pitch, [_known(other)[1] for other, _, _ in pairs], first)
        )
        size = np.maximum(size, _LEAST_CURVATURE * max(size[-1], first))
        self.objective = QuadraticMeasure(
            centre.pitch, value, by_pitch, metric[:, None] * (axes * size) @ axes.T * metric
        )
        self.limited: list[QuadraticMeasure] = []
        if measured.limited_by_pitch is not None:
            for k, slope in enumerate(measured.limited_by_pitch):
                slopes = [
                    other.limited_by_pitch[k]
                    for other, _, _ in pairs
                    if other.limited_by_pitch is not None
                ]
                second = metric[:, None] * fit(slope, slopes, 0.0) * metric
                self.limited.append(
                    QuadraticMeasure(centre.pitch, measured.limited[k], slope, second)
                )

    def cost(self, x: Array) -> float:
        """The objective at x [W or %]."""
        return self._cost(x)[0]

    def _cost(self, x: Array) -> tuple[float, Array]:
        """The cost, and its slope by x."""
        cost, slope = self.objective.at(self.evaluate.pitch(x))
        return cost, self.evaluate.pitch_slopes(x) @ slope

    def stretch(self, x: Array) -> Array:
        """Columns are steps of x that raise the objective by BAND from a minimum, (parameters, parameters)."""
        by = self.evaluate.pitch_slopes(x)
        size, axes = np.linalg.eigh(by @ self.objective.second @ by.T)
        # Where no parameter acts, as a break point between equal rates.
        flat = 1e-9 * BAND * self.objective.value
        size = np.maximum(size, max(_LEAST_CURVATURE * size[-1], flat))
        return axes * np.sqrt(2.0 * BAND * self.objective.value / size)

    def margins(self, x: Array) -> tuple[Array, Array]:
        """Margins of all limits, positive inside, and slopes by x."""
        margins, slopes = self.evaluate.cheap_margins(x)
        pitch, by = self.evaluate.pitch(x), self.evaluate.pitch_slopes(x)
        for limit, largest in zip(self.limited, self.evaluate.largest, strict=True):
            value, slope = limit.at(pitch)
            margins = np.append(margins, largest - value)
            slopes = np.vstack([slopes, -by @ slope])
        return margins, slopes

    def least(self, x: Array, reach: float = 1.0) -> Array:
        """The minimum of the model within the limits and within `reach` of x, in parts of the ranges."""
        unit = 2.0 * BAND * self.objective.value

        def value(x: Array) -> tuple[float, Array]:
            cost, slope = self._cost(x)
            return cost / unit, slope / unit

        return self._descend(x, reach, self.stretch(x), x, value, ())

    def farthest(self, x: Array, k: int, side: float, edge: float) -> Array:
        """Where parameter k is largest (side 1) or smallest (−1) with the objective at most `edge`, begun beside x."""
        stretch, scale = self.stretch(x), BAND * self.objective.value
        along = side * stretch[k]
        size = float(np.linalg.norm(along))
        direction = side * np.eye(len(x))[k] / size

        def room(x: Array) -> tuple[Array, Array]:
            cost, slope = self._cost(x)
            return np.array([(edge - cost) / scale]), -slope[None] / scale

        start = np.clip(x + stretch @ along / size, 0.0, 1.0)
        return self._descend(
            x, 1.0, stretch, start, lambda x: (-float(direction @ x), -direction), (room,)
        )

    def _descend(
        self,
        centre: Array,
        reach: float,
        stretch: Array,
        start: Array,
        value: _Measure,
        more: Sequence[_Measure],
    ) -> Array:
        """SLSQP in coordinates in which the objective is round, within `reach` of a centre."""
        low, high = np.maximum(centre - reach, 0.0), np.minimum(centre + reach, 1.0)
        length = np.linalg.norm(stretch, axis=1)
        walls = np.vstack([np.diag(1.0 / length), np.diag(-1.0 / length)])

        def box(x: Array) -> tuple[Array, Array]:
            return np.concatenate([(x - low) / length, (high - x) / length]), walls

        def inequality(measure: _Measure) -> dict[str, Any]:
            def margins(y: Array) -> Array:
                return measure(centre + stretch @ y)[0]

            def slopes(y: Array) -> Array:
                return measure(centre + stretch @ y)[1] @ stretch

            return {"type": "ineq", "fun": margins, "jac": slopes}

        def both(y: Array) -> tuple[float, Array]:
            cost, slope = value(centre + stretch @ y)
            return cost, slope @ stretch

        limits = [self.margins] if len(self.margins(centre)[0]) else []
        end = slsqp(
            both,
            np.linalg.solve(stretch, np.clip(start, low, high) - centre),
            constraints=[inequality(limit) for limit in (box, *limits, *more)],
            options={"maxiter": _MODEL_ITERATIONS, "ftol": _MODEL_TOLERANCE},
        )
        return np.asarray(np.clip(centre + stretch @ end.x, low, high), dtype=np.float64)


def slsqp(cost: Callable[[Array], tuple[float, Array]], start: Any, **named: Any) -> Any:
    """scipy's minimum of a cost that comes with its gradient, which its stubs do not know."""
    minimize = cast(Callable[..., Any], scipy.optimize.minimize)
    return minimize(cost, start, jac=True, method="SLSQP", **named)


TOLERANCE: dict[Quantity, float] = {"total": 1e-7, "induced": 1e-7, "vibration": 1e-5}
"""Fall of the objective foreseen, as a part of it, at which a descent ends: the index is bent more than power is."""
_ITERATIONS = 60
_FIRST_REACH = 0.4
"""How far from its trim the model is trusted at first, in parts of the ranges."""
_LEAST_REACH = 1e-4
"""Step at which a descent ends where the objective does not fall as foreseen."""


@dataclass(frozen=True, eq=False)
class Descent:
    """The end of one descent."""

    end: Evaluation | None
    """The best feasible point evaluated; None when there was none, or when the descent leads to a minimum known."""
    converged: bool


def descend(evaluate: Evaluator, first: Evaluation, known: Callable[[Array], bool]) -> Descent:
    """Descend from a point that trims, as long as the model's minimum is not one that is `known`."""
    centre, reach = first, _FIRST_REACH
    for _ in range(_ITERATIONS):
        model = LocalModel(evaluate, centre.blade, evaluate.trimmed.all)
        x = model.least(centre.x, reach)
        foreseen = centre.cost - model.cost(x)
        if centre.feasible and foreseen <= TOLERANCE[evaluate.objective.quantity] * centre.cost:
            return Descent(centre, converged=True)
        if known(x):
            return Descent(None, converged=True)
        length = float(np.abs(x - centre.x).max())
        if length < _LEAST_REACH:
            break
        trial = evaluate(x)
        share = (centre.cost - trial.cost) / foreseen if trial.feasible and centre.feasible else 0.0
        if trial.rank >= centre.rank or share < 0.1:
            reach = 0.3 * length
        elif share > 0.5:
            reach = max(reach, 2.0 * length)
        centre = min(centre, trial, key=lambda point: point.rank)
    return Descent(
        centre if centre.feasible else None, converged=centre.feasible and reach < _LEAST_REACH
    )


_TOGETHER, _RECENT = 8, 60
"""Rounds of `descend_together`, and how many of the last trims its models are made of."""


def descend_together(
    searches: Sequence[Evaluator], starts: Sequence[Array], tolerance: float
) -> list[Evaluation]:
    """Where each search, of one objective and one history, is least near its start; each round is trimmed at once.

    A descent ends where the model foresees no fall by `tolerance`, a part of the objective, or nothing trims.
    """
    at, reach = dict(enumerate(starts)), [_FIRST_REACH] * len(searches)
    ends: dict[int, Evaluation] = {}
    for _ in range(_TOGETHER):
        designs = [
            searches[k].concept.apply(searches[k].design, searches[k].values(x))
            for k, x in at.items()
        ]
        begin = [searches[k].starts_for(design) for k, design in zip(at, designs, strict=True)]
        moves, options = len(starts[0]) > 0, SolverOptions(remedy=False)
        every = evaluate_objectives(
            searches[0].objective, designs, begin, gradient=moves, options=options
        )
        for k, design, found in zip(at, designs, every, strict=True):
            searches[k].trimmed.add(design.rotor, design.twist(searches[k].r), found)
        further: dict[int, Array] = {}
        for k, x in at.items():
            trial = searches[k](x)
            before, ends[k] = (
                ends.get(k),
                min(ends.get(k, trial), trial, key=lambda point: point.rank),
            )
            centre = ends[k]
            if centre is before:
                reach[k] *= 0.3
            if centre.power is None or not len(x):
                continue
            model = LocalModel(searches[k], centre.blade, searches[k].trimmed.all[-_RECENT:])
            step = model.least(centre.x, reach[k])
            if centre.cost - model.cost(step) > tolerance * centre.cost:
                further[k] = step
        if not further:
            break
        at = further
    return [ends[k] for k in range(len(searches))]


_BAND_TOLERANCE = 0.02
"""Correction of a side of the band that is not evaluated again, over its distance from the best."""
_BAND_EVALUATIONS = 3
"""Evaluations of a side at most."""


def measure_band(evaluate: Evaluator, best: Evaluation) -> tuple[ParameterBand, ...]:
    """The band of every parameter, SI."""
    edge = best.cost * (1.0 + BAND)
    bands: list[ParameterBand] = []
    for k, parameter in enumerate(evaluate.concept.parameters):
        low, high = (_side(evaluate, best, edge, k, side) for side in (-1.0, 1.0))
        low, high = (float(evaluate.low[k] + evaluate.span[k] * end) for end in (low, high))
        bands.append(ParameterBand(parameter.name, low, high))
    return tuple(bands)


def _side(evaluate: Evaluator, best: Evaluation, edge: float, k: int, side: float) -> float:
    """How far parameter k goes within the band on one side, scaled."""
    centre = best
    x = LocalModel(evaluate, best.blade, evaluate.trimmed.all).farthest(best.x, k, side, edge)
    for _ in range(_BAND_EVALUATIONS):
        record = evaluate(x)
        if record.power is None:
            break
        centre, before = record, x
        x = LocalModel(evaluate, centre.blade, evaluate.trimmed.all).farthest(
            centre.x, k, side, edge
        )
        if abs(x[k] - before[k]) <= _BAND_TOLERANCE * abs(before[k] - best.x[k]) + 1e-6:
            break
    inside = [record.x for record in evaluate.records if record.feasible and record.cost <= edge]
    return side * max(side * float(point[k]) for point in (*inside, x))
