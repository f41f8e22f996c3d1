"""Newton's method for many designs in step, with the factors of a solution nearby, see `rotor.engine.newton`.

Designs with one structure, grid and section lie beside each other along the blade: the section takes them as one blade
with so many times the elements, and all else is one product for all of them. Each makes the steps that it makes alone,
to rounding. One that needs derivatives of its own leaves.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from rotor.engine.linearise import Point, System
from rotor.engine.newton import (
    LAST_STEP_RATIO,
    MOST_SLOW_STEPS,
    Factors,
    NewtonLimits,
    Solved,
    steps_left,
)
from rotor.engine.terms import Structure, summed
from rotor.support.arrays import Array, Booleans, Integers


@dataclass(frozen=True, eq=False)
class _PointBatch:
    """The `Point`s of several designs in shared arrays: designs along the first axis, in fields along the second."""

    systems: Sequence[System]
    x: Array
    z: Array
    by_roots: Sequence[Array]
    phi: Array
    channels: Array
    forces: Array
    slopes: Array
    flow: Array
    q: Array
    residual: Array
    size: Array

    def point(self, k: int) -> Point:
        """The point of one design."""
        channels, forces, slopes, flow = (
            np.ascontiguousarray(each[:, k])
            for each in (self.channels, self.forces, self.slopes, self.flow)
        )
        at, system = (self.x[k], self.z[k], self.by_roots[k], self.phi[k]), self.systems[k]
        return Point(
            system, system.grid, *at, channels, forces, slopes, flow, self.q[k], self.residual[k]
        )


def can_share_steps(system: System, other: System) -> bool:
    """Whether two designs can lie beside each other; the section's data are for the caller to compare."""
    same = system.structure is other.structure and system.grid.waves is other.grid.waves
    same = (
        same
        and system.grid.varying.keys() == other.grid.varying.keys()
        and system.section is other.section
    )
    nodes = [None if each.nodes is None else each.nodes.matrix for each in (system, other)]
    return same and nodes[0] is nodes[1] and np.array_equal(system.shapes.phi, other.shapes.phi)


def _sums(place: Integers, values: Array, size: int) -> Array:
    """Sums of the values with the same place, for each design: (designs, values) → (designs, size)."""
    places = place + size * np.arange(len(values))[:, None]
    return summed(places.ravel(), values.ravel(), size * len(values)).reshape(-1, size)


class _SideBySide:
    """Designs beside each other."""

    def __init__(self, systems: Sequence[System], data: Callable[[int], Any]) -> None:
        self.systems, self._data_of, self._data = systems, data, dict[int, Any]()

    def __call__(self, which: Integers, x: Array, *, full: bool) -> _PointBatch:
        """The equations of some of the designs; with slopes and flow where asked for."""
        systems: list[System] = [self.systems[k] for k in which.tolist()]
        one, count, nodes = systems[0], len(systems), systems[0].nodes
        s, waves, psi = one.structure, one.grid.waves, one.shapes.psi
        n, m = one.grid.steady.shape[1], waves.azimuths
        made = [system.make(row) for system, row in zip(systems, x[:, : s.given], strict=True)]
        z: Array = np.concatenate(
            [x[:, : s.given], np.array([derived for derived, _, _ in made])], axis=1
        )
        phi: Array = np.repeat(one.shapes.phi[None], count, axis=0)
        for channel, name in made[0][2]:
            row = s.first_row[channel] + s.shapes[channel][name]
            phi[:, row] = np.array([live[channel, name] for _, _, live in made])
        channels: Array = np.empty((s.channels, count, n, m))
        channels[:] = np.stack([system.grid.steady for system in systems], axis=1)[..., None]
        place, i, j, factor = s.column_arrays
        g = _sums(place, factor * z[:, i] * z[:, j], int(s.first_row[-1]) * s.waves)
        around: Array = (g.reshape(-1, s.waves) @ waves.at).reshape(count, -1, m)
        for channel, (first, end) in enumerate(pairwise(s.first_row.tolist())):
            if end > first:
                channels[channel] += np.matmul(
                    phi[:, first:end].swapaxes(1, 2), around[:, first:end]
                )
        for channel in one.grid.varying:
            channels[channel] += np.array([system.grid.varying[channel] for system in systems])
        if nodes is not None:
            channels[nodes.channel] += np.array([nodes.field(y) for y in x[:, s.given :]]).reshape(
                count, n, m
            )
        forces, slopes, flow = self._section(channels, full)
        along: Array = np.zeros((count, len(psi), m))
        for force, (first, end) in enumerate(pairwise(s.first_weight.tolist())):
            along[:, first:end] = np.matmul(psi[first:end], forces[force])
        means = (along.reshape(-1, m) @ waves.mean).reshape(count, -1)[:, s.measure_places]
        q = np.concatenate([np.ones((count, 1)), means], axis=1)
        residual = _residual(s, z, q)
        if nodes is not None:
            residual = np.concatenate(
                [residual, x[:, s.given :] - forces[nodes.force].reshape(count, -1)], axis=1
            )
        size: Array = (np.abs(residual) / one.tolerance).max(axis=1)
        size = np.where(np.isfinite(size), size, math.inf)
        by_roots = [slope for _, slope, _ in made]
        return _PointBatch(
            systems, x, z, by_roots, phi, channels, forces, slopes, flow, q, residual, size
        )

    def _section(self, channels: Array, full: bool) -> list[Array]:
        """Forces, slopes and flow, (rows, designs, elements, azimuths); without elements where not asked for."""
        rows, count, n, m = channels.shape
        if count not in self._data:
            self._data[count] = self._data_of(count)
        fields = self.systems[0].section(
            channels.reshape(rows, count * n, m), self._data[count], full, full
        )
        return [field.reshape(len(field), count, -1, m) for field in fields]


def _residual(s: Structure, z: Array, q: Array) -> Array:
    """R without nodes, (designs, equations)."""
    t = s.residual
    values = t.factor * z[:, t.number] * z[:, t.first] * z[:, t.second] * q[:, t.measure]
    return _sums(t.row, values, t.rows)


class _Unfinished:
    """The designs that go on, and the corrections of the factors by the steps of each, as in `newton`."""

    def __init__(self, x: Array, points: _PointBatch, factors: Factors) -> None:
        self.which: Integers = np.arange(len(x))
        self.x, self.residual, self.size = x, points.residual, points.size
        self.slow: Array = np.zeros(len(x))
        """Steps one after another that hardly reduced the residual."""
        self.expected: Array = np.full(len(x), math.inf)
        """Residual over its tolerance after the next step."""
        self._factors, self._updates = factors, list[tuple[Array, Array]]()
        self._before: Array = np.zeros((0, 0))
        self.taken: Array = np.zeros((0, 0))

    def keep(self, those: Booleans) -> None:
        """Keep only these designs."""
        for name in ("which", "x", "residual", "size", "slow", "expected", "_before", "taken"):
            values: Array = getattr(self, name)
            if len(values):
                setattr(self, name, values[those])
        self._updates = [(change[those], along[those]) for change, along in self._updates]

    def step(self, limits: Array) -> Array:
        """The next step of each, in `taken`; returns its length over the largest allowed, at least 1."""
        step = self._factors.solve(self.residual.T).T
        for change, along in self._updates:
            step += change * _along(along, step)
        if len(self._before):
            shown, along = step - self._before, self._factors.weight * self.taken
            length = _along(along, shown)
            change = np.divide(
                self.taken - shown, length, out=np.zeros_like(shown), where=length != 0.0
            )
            self._updates.append((change, along))
            step = step + change * _along(along, step)
        self._before = step
        over: Array = np.maximum(1.0, (np.abs(step) / limits).max(axis=1))
        self.taken = -step / over[:, None]
        return over


def _along(along: Array, step: Array) -> Array:
    """Their product for each design, (designs, 1)."""
    return np.asarray(np.einsum("di,di->d", along, step)[:, None], dtype=np.float64)


def solve_together(
    systems: Sequence[System],
    x: Array,
    factors: Factors,
    limits: NewtonLimits,
    data: Callable[[int], Any],
) -> list[Solved | None]:
    """What `newton.solve` makes of designs that `can_share_steps` accepts; None where it would need other derivatives
    than these.

    x: a start for each, (designs, …). data: the section's data for so many designs beside each other.
    """
    beside, one, passes = _SideBySide(systems, data), systems[0], 1
    points = beside(np.arange(len(systems)), x, full=False)
    out = [
        Solved(points.point(k), 1, factors) if size <= 1.0 else None
        for k, size in enumerate(points.size.tolist())
    ]
    going, still = _Unfinished(x, points, factors), points.size > 1.0
    while still.any() and passes < limits.most_passes:
        going.keep(still)
        over = going.step(one.limits)
        moved, before, last = going.x.copy(), going.size, going.expected <= LAST_STEP_RATIO
        moved[:, one.free] += going.taken
        going.residual, going.size, passes = (
            np.empty_like(going.residual),
            np.empty_like(before),
            passes + 1,
        )
        for some in (np.flatnonzero(~last), np.flatnonzero(last)):
            if not len(some):
                continue
            points = beside(going.which[some], moved[some], full=bool(last[some[0]]))
            going.residual[some], going.size[some] = points.residual, points.size
            for k, place in enumerate(some.tolist()):
                if points.size[k] <= 1.0:
                    keeps = points.size[k] <= limits.kept_ratio * before[place]
                    out[int(going.which[place])] = Solved(
                        points.point(k), passes, factors if keeps else None
                    )
        ratio = going.size / before
        going.x, going.expected = moved, going.size * np.minimum(ratio, 1.0)
        going.slow = np.where(ratio > 1.0 - 0.1 / over, going.slow + 1.0, 0.0)
        left = [
            steps_left(size, last, 1.0)
            for size, last in zip(going.size.tolist(), before.tolist(), strict=True)
        ]
        still = (going.size > 1.0) & (ratio < 1.0) & (np.array(left) <= limits.most_kept_steps)
        still &= going.slow < MOST_SLOW_STEPS
    return out
