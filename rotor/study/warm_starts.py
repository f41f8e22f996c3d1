"""First guesses for the trims and searches of a chunk, from the points computed before.

Every trim unknown and the induced velocity vary smoothly with speed, mass and twist. The guess is a local linear model
of nearby trims. A cold trim with the dynamic wake takes 7.9 iterations on average, one started from the previous trim
6.6, one started from the linear model 3.8 (10⁵ points over four sampled ranges, docs/scale.md).
"""

from collections.abc import Mapping

import numpy as np

from rotor.aero.trim_state import STATE_NAMES, TrimState
from rotor.arrays import Array
from rotor.study.quantities import Value
from rotor.trim.forward import guess_of
from rotor.trim.newton import Guess
from rotor.trim.solution import Solution

_KEPT = 64
"""Trims kept."""
_NEAR = 10
"""Of them those that the linear model is made of."""
_FIRM = 1e-4
"""Directions in which the trims nearby spread by less than this part of the whole say nothing."""
_FAR = 3.0
"""Sum of the weights' sizes beyond which the model is not trusted, and the nearest trim serves."""


class WarmStarts:
    """Trims and optima of the points before, of one chunk."""

    def __init__(self, ranges: Mapping[str, tuple[float, float]]) -> None:
        """`ranges`: low and high of each numeric axis; distances are parts of these."""
        self._ranges = {name: (low, (high - low) or 1.0) for name, (low, high) in ranges.items()}
        self._key: tuple[object, ...] = ()
        self._places: list[Array] = []
        self._trims: list[Array] = []
        self._shape = (0, 0)
        self.concept = ""
        """The concept of the last optimum, and its parameters."""
        self.optimum: tuple[float, ...] = ()

    def guess(self, values: Mapping[str, Value], *, hovering: bool) -> Guess | None:
        """Where the trim of a point may begin; None where nothing is known of such points."""
        if self._kind(values, hovering) != self._key or not self._trims:
            return None
        steps = np.array(self._places) - self._place(values)
        order: list[int] = np.argsort((steps**2).sum(axis=1), kind="stable")[:_NEAR].tolist()
        vector = self._trims[order[0]].copy()
        for weight, other in zip(_weights(steps[order]), order[1:], strict=True):
            vector += weight * (self._trims[other] - self._trims[order[0]])
        n = len(STATE_NAMES)
        return Guess(TrimState.from_array(vector[:n]), vector[n:].reshape(self._shape))

    def keep(self, values: Mapping[str, Value], solution: Solution) -> None:
        """Remember a trim; one that did not converge teaches nothing."""
        if not solution.converged:
            return
        key = self._kind(values, solution.design.hovering)
        left = guess_of(solution)
        assert left.induced is not None
        if key != self._key or left.induced.shape != self._shape:
            self._key, self._shape = key, left.induced.shape
            self._places, self._trims = [], []
        self._places.append(self._place(values))
        self._trims.append(np.concatenate([left.state.array(), left.induced.ravel()]))
        del self._places[:-_KEPT], self._trims[:-_KEPT]

    def _kind(self, values: Mapping[str, Value], hovering: bool) -> tuple[object, ...]:
        """What trims must share to learn from one another."""
        return (hovering, *(value for name, value in values.items() if name not in self._ranges))

    def _place(self, values: Mapping[str, Value]) -> Array:
        return np.array([(float(values[name]) - low) / span for name, (low, span) in self._ranges.items()])


def _weights(steps: Array) -> Array:
    """Weights of all but the nearest trim, whose differences from it follow the way to the point, (trims − 1,).

    `steps`: from the point to each trim, the nearest first, (trims, axes). The weighted differences of place come as
    near the way from the nearest trim to the point as their spread allows, near trims before far ones.
    """
    way, others = -steps[0], steps[1:] - steps[0]
    trust = 1.0 / ((steps[1:] ** 2).sum(axis=1) + 1e-12)
    normal: Array = (others.T * trust) @ others
    size = float(np.trace(normal))
    if size == 0.0:
        return np.zeros(len(others))
    slope = np.asarray(np.linalg.solve(normal + _FIRM * size * np.eye(len(way)), way), dtype=np.float64)
    weights = trust * (others @ slope)
    return weights if float(np.abs(weights).sum()) < _FAR else np.zeros(len(others))
