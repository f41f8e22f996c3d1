"""The equations at a point, their exact Jacobian, and the Jacobian transposed.

    channels   c = Φᵀ G W,  G = Σ factor z_i z_j                    K
    section    f(c), D = ∂f/∂c at every point                       `System.section`
    measures   Q = mean Ψ f Wᵀ Δr                                   P
    residual   R(z, Q)
    nodes      c += A y in one channel, y − f in one force: an unknown at every point of the grid

    J = ∂R/∂Q (Pᵀ D K) ∂G/∂z ∂z/∂x + ∂R/∂z ∂z/∂x,  and Jᵀ v by the same operators transposed.
    By the nodes:  ∂R/∂y = ∂R/∂Q Pᵀ D A,   ∂(y − f)/∂x = −D K ∂G/∂z ∂z/∂x,   ∂(y − f)/∂y = 1 − D A.

A product of two waves is a sum of two, so Pᵀ D K takes only the Fourier coefficients of Σ Ψ D Φ: one product along the
blade for each pair of shapes, one around the azimuth, and two numbers for each entry.
"""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

from rotor.engine.memory import LagFactors
from rotor.engine.terms import NO_TERMS, Shape, Structure, Terms, summed
from rotor.engine.waves import WaveGrid
from rotor.support.arrays import Array, Integers
from rotor.support.compiled import compiled

_compile = compiled(error_model="numpy")

# Sums in any order make vector code.
_sums = compiled(error_model="numpy", fastmath={"contract", "reassoc", "nsz"})

Live = Mapping[tuple[int, Shape], Array]
"""Shapes that follow the states, by channel and name."""


@_sums
def _rows_times(matrix: Any, v: Any, out: Any) -> None:
    for i in range(len(out)):
        total = 0.0
        for j in range(len(v)):
            total += matrix[i, j] * v[j]
        out[i] = total


@_compile
def _times_rows(v: Any, matrix: Any, out: Any) -> None:
    for i in range(len(v)):
        for j in range(len(out)):
            out[j] += v[i] * matrix[i, j]


@dataclass(frozen=True, eq=False)
class Nodes:
    """y, a force at every point of the grid, which gives a channel A y: what no product of shapes and waves holds."""

    channel: int
    force: int
    matrix: NDArray[np.float32]
    """A, (points, points); points in the order (element, azimuth). Products with it are summed in double precision."""
    tolerance: float
    """Tolerance of y − f."""
    limit: float
    """Largest step of y, in its unit."""
    expected: float
    """A y that a solution without a guess of y begins with."""

    def field(self, y: Array) -> Array:
        """A y, (points,)."""
        out = np.empty(len(self.matrix))
        _rows_times(self.matrix, y, out)
        return out

    def transposed(self, v: Array) -> Array:
        """Aᵀ v, (points,)."""
        out = np.zeros(len(self.matrix))
        _times_rows(v, self.matrix, out)
        return out


class Shapes:
    """Functions along the blade, by channel and by force, for one structure and blade."""

    def __init__(self, structure: Structure, values: Mapping[Shape, Array], widths: Array) -> None:
        """values: by name, (elements,); those that are missing are live. widths: Δr, (elements,)."""
        none = np.zeros(len(widths))

        def stack(all_names: Sequence[Mapping[Shape, int]]) -> Array:
            return np.array(
                [values.get(name, none) for names in all_names for name in names]
            ).reshape(-1, len(widths))

        self.phi = stack(structure.shapes)
        """(shapes of all channels, elements)"""
        self.psi = stack(structure.weights) * widths
        """Ψ Δr, (weights of all forces, elements)"""


@dataclass(frozen=True, eq=False)
class Grid:
    """The blade elements on one number of azimuths."""

    waves: WaveGrid
    steady: Array
    """What the design adds to every channel at all azimuths, (channels, elements)."""
    varying: Mapping[int, Array]
    """What it adds to a channel beside, (elements, azimuths)."""
    data: Any
    """For the section."""


@dataclass(frozen=True, eq=False)
class System:
    """A structure with the numbers of one design."""

    structure: Structure
    shapes: Shapes
    grid: Grid
    """All azimuths."""
    thin: Grid
    """The grid on few azimuths, or `grid` itself."""
    section: Callable[[Array, Any, bool, bool], tuple[Array, Array, Array]]
    """Channels and the data of the grid → forces, partial derivatives and flow; the last two where asked for."""
    make: Callable[[Array], tuple[Array, Array, Live]]
    """x → derived atoms, their slopes by the roots (derived, roots), live shapes."""
    numbers: Array
    tolerance: Array
    """Tolerance of each equation, (equations,)."""
    limits: Array
    """Largest step of each state solved for, (equations,)."""
    nodes: Nodes | None = None
    """Nodes, whose equations and unknowns come after all others."""
    memory: Callable[[Array, Any], LagFactors] | None = None
    """Channels and the data of the grid → how forces follow channels at other azimuths; None where they do not."""

    @cached_property
    def free(self) -> Integers:
        """Places in x of what is solved for, (equations,)."""
        given, nodes = self.structure.given, self.nodes
        count = 0 if nodes is None else len(nodes.matrix)
        return np.concatenate([self.structure.free, np.arange(given, given + count)])


@dataclass(frozen=True, eq=False)
class Point:
    """The equations at x = (1, numbers, states, y of the nodes), with what their derivatives need."""

    system: System
    grid: Grid
    x: Array
    z: Array
    by_roots: Array
    phi: Array
    """The shapes, with the live ones."""
    channels: Array
    """(channels, elements, azimuths)"""
    forces: Array
    slopes: Array
    """Rows of `Structure.pairs`; no elements where they were not asked for."""
    flow: Array
    q: Array
    residual: Array

    @cached_property
    def memory(self) -> LagFactors | None:
        """How forces follow channels at other azimuths."""
        memory = self.system.memory
        return None if memory is None else memory(self.channels, self.grid.data)

    @cached_property
    def remembered(self) -> Array:
        """`Memory.by_inputs`, made once."""
        assert self.memory is not None
        return self.memory.by_inputs(self.grid.waves)

    @cached_property
    def coefficient_slopes(self) -> csr_matrix:
        """∂ of the wave coefficients that columns have, (states and derived atoms, coefficients)."""
        structure, z = self.system.structure, self.z
        _, i, j, factor = structure.column_arrays
        order, pattern = structure.by_atom
        # Making a sparse matrix checks its indices, which takes longer than the product.
        slopes = copy(pattern)
        slopes.data = np.concatenate([factor * z[j], factor * z[i]])[order]
        return slopes

    @cached_property
    def residual_slopes(self) -> tuple[Array, Array]:
        """∂R by the measures, and by states and derived atoms at the same measures, (equations, …)."""
        return self.system.structure.residual.slopes(
            self.z, self.q, self.system.structure.first_state
        )

    @property
    def forgetful(self) -> "Point":
        """The point without the lags of its section, for derivatives that need not be exact."""
        return replace(self, system=replace(self.system, memory=None))

    @cached_property
    def size(self) -> float:
        """Largest residual over its tolerance [-]."""
        size = float((np.abs(self.residual) / self.system.tolerance).max())
        return size if np.isfinite(size) else np.inf


def evaluate(
    system: System, grid: Grid, x: Array, *, slopes: bool = False, flow: bool = False
) -> Point:
    """R(x); with the partial derivatives of the section, and the flow at the sections, where asked for."""
    structure, shapes = system.structure, system.shapes
    states, y = x[: structure.given], x[structure.given :]
    derived, by_roots, live = system.make(states)
    z = np.concatenate([states, derived])
    phi = shapes.phi
    if live:
        phi = phi.copy()
        for (channel, name), values in live.items():
            phi[structure.first_row[channel] + structure.shapes[channel][name]] = values
    channels = np.repeat(grid.steady[:, :, None], grid.waves.azimuths, axis=2)
    _add_along_blade(
        phi, structure.first_row, _coefficients(structure, z) @ grid.waves.at, channels
    )
    for channel, added in grid.varying.items():
        channels[channel] += added
    if system.nodes is not None:
        channels[system.nodes.channel] += system.nodes.field(y).reshape(channels.shape[1:])
    return _with_forces(system, grid, (x, z, by_roots, phi), channels, slopes, flow)


def with_slopes(point: Point) -> Point:
    """The point with the partial derivatives of the section and the flow there; itself where it has both."""
    if point.slopes.shape[1] and point.flow.shape[1]:
        return point
    return evaluate(point.system, point.grid, point.x, slopes=True, flow=True)


def begin(system: System, grid: Grid, x: Array) -> Point:
    """The equations at y = 0, but linearised where A y is the `expected` of the nodes.

    A guess of y would not do: between dense nodes A y of it is far off, and sections that stall there have slopes that
    mean nothing. A step from here is to the solution of a linear section.
    """
    nodes = system.nodes
    assert nodes is not None
    expected = np.full((*grid.steady.shape[1:], grid.waves.azimuths), nodes.expected)
    varying = {**grid.varying, nodes.channel: grid.varying.get(nodes.channel, 0.0) + expected}
    point = replace(evaluate(system, replace(grid, varying=varying), x, slopes=True), grid=grid)
    less = response(
        point.forgetful, {nodes.channel: -expected}, np.zeros(len(system.structure.equations))
    )[0]
    return replace(point, residual=point.residual + less)


def with_data(point: Point, data: Any) -> Point:
    """R(x) with other section data, and the flow at the sections; channels and slopes of the shapes stay the same."""
    at = point.x, point.z, point.by_roots, point.phi
    return _with_forces(point.system, replace(point.grid, data=data), at, point.channels, flow=True)


def with_numbers(point: Point, system: System) -> Point:
    """R(x) with other numbers of the design, which its channels do not have: all forces stay."""
    x, z, residual = point.x.copy(), point.z.copy(), point.residual.copy()
    x[: len(system.numbers)] = z[: len(system.numbers)] = system.numbers
    residual[: len(system.structure.equations)] = system.structure.residual.value(z, point.q)
    return replace(point, system=system, x=x, z=z, residual=residual)


_At = tuple[Array, Array, Array, Array]
"""`x`, `z`, `by_roots` and `phi` of a point."""


def _with_forces(
    system: System, grid: Grid, at: _At, channels: Array, slopes: bool = False, flow: bool = False
) -> Point:
    (x, z, _, _), structure, nodes = at, system.structure, system.nodes
    forces, balanced, s = system.section(channels, grid.data, slopes, flow)
    q = np.concatenate([[1.0], _means(system, grid, forces)])
    residual = structure.residual.value(z, q)
    if nodes is not None:
        missing = x[structure.given :].reshape(channels.shape[1:]) - forces[nodes.force]
        residual = np.concatenate([residual, missing.ravel()])
    return Point(system, grid, *at, channels, forces, balanced, s, q, residual)


def _coefficients(structure: Structure, z: Array) -> Array:
    """G: what every shape has of every wave, (shapes, waves)."""
    place, i, j, factor = structure.column_arrays
    g = summed(place, factor * z[i] * z[j], int(structure.first_row[-1]) * structure.waves)
    return g.reshape(-1, structure.waves)


@_compile
def _add_times(factor: float, times: Any, out: Any) -> None:
    for j in range(len(out)):
        out[j] += factor * times[j]


@_compile
def _add_along_blade(along: Any, first: Any, around: Any, out: Any) -> None:
    """Add to fields functions along the blade, (rows, elements), times functions of azimuth, (rows, azimuths).

    first: the first row of each field, and the end.
    """
    for k in range(out.shape[0]):
        for i in range(out.shape[1]):
            for row in range(first[k], first[k + 1]):
                _add_times(along[row, i], around[row], out[k, i])


@_compile
def _add_around(along: Any, first: Any, fields: Any, out: Any) -> None:
    """The transposed operator: add to functions of azimuth the sums along the blade of fields."""
    for k in range(fields.shape[0]):
        for row in range(first[k], first[k + 1]):
            for i in range(fields.shape[1]):
                _add_times(along[row, i], fields[k, i], out[row])


def _means(system: System, grid: Grid, forces: Array) -> Array:
    """The measures of forces but the first, (measures − 1,)."""
    along = np.zeros((len(system.shapes.psi), grid.waves.azimuths))
    _add_around(system.shapes.psi, system.structure.first_weight, forces, along)
    return (along @ grid.waves.mean).ravel()[system.structure.measure_places]


def part(point: Point, channel: int, names: Sequence[Shape]) -> Array:
    """What some shapes add to a channel, (elements, azimuths)."""
    structure = point.system.structure
    rows = structure.rows_of(channel, names)
    return point.phi[rows].T @ (_coefficients(structure, point.z)[rows] @ point.grid.waves.at)


@_compile
def _between(
    slopes: Any, phi: Any, psi: Any, products: Any, blocks: Any, places: Any, factors: Any, out: Any
) -> None:
    """Means of Ψ D Φ w_p w_q from the Fourier coefficients of Σ Ψ D Φ, (coefficients, measures), see `Blocks`."""
    n = phi.shape[1]
    for b in range(len(blocks)):
        slope, first, end, begin, last, waves, start, stop = blocks[b]
        pairs = np.empty(((end - first) * (last - begin), n))
        for i in range(first, end):
            for k in range(begin, last):
                # Rows as arrays would have numba compile words for shapes that differ: 3 s.
                for j in range(n):
                    pairs[(i - first) * (last - begin) + k - begin, j] = psi[i, j] * phi[k, j]
        around = products[:waves].T
        if len(pairs) > n:  # The order of the two products that takes less.
            product = np.dot(pairs, np.dot(slopes[slope], around))
        else:
            product = np.dot(np.dot(pairs, slopes[slope]), around)
        flat = product.reshape(-1)
        for e in range(start, stop):
            value = factors[0, e] * flat[places[2, e]] + factors[1, e] * flat[places[3, e]]
            out[places[0, e], places[1, e]] = value


def jacobian(point: Point, further: Terms = NO_TERMS) -> tuple[Array, Array]:
    """∂R by the states solved for, (equations, equations), and that of further measures; `point` has slopes."""
    structure, nodes, size = (
        point.system.structure,
        point.system.nodes,
        len(point.system.structure.equations),
    )
    terms = structure.residual.stacked(further)
    on_q, on_z = terms.slopes(point.z, point.q, structure.first_state)
    on_z[terms.summing] += _sparse_times(on_q[terms.summing], _measure_slopes(point))
    by_states = _by_free(structure, on_z, point.by_roots)
    if nodes is None:
        return by_states[:size], by_states[size:]
    through = _sparse_times(on_q, _measures_by_channel(point, nodes.channel)) @ nodes.matrix
    by_channel = _force_slope(point, nodes.force, nodes.channel).ravel()
    end = size + len(by_channel)
    full = np.empty((end, end))
    full[:size, :size], full[:size, size:] = by_states[:size], through[:size]
    full[size:, :size] = -_field_slopes(point, nodes.force)
    np.multiply(nodes.matrix, -by_channel[:, None], out=full[size:, size:])
    full[range(size, end), range(size, end)] += 1.0
    return full, np.concatenate([by_states[size:], through[size:]], axis=1)


_MANY_ENTRIES = 20_000
"""Size from which a matrix with few measures in each equation is multiplied as a sparse one. Our choice."""


def _sparse_times(array: Array, other: Array) -> Array:
    """A product whose first factor is mostly zero."""
    return np.asarray(csr_matrix(array) @ other) if array.size > _MANY_ENTRIES else array @ other


def response(point: Point, fields: Mapping[int, Array], given: Array) -> tuple[Array, Array]:
    """∂R and ∂ of the measures where channels have fields added, at the same states; `point` has slopes.

    fields: by channel, (elements, azimuths). given: what the same does to R directly, (equations without nodes,).
    Returns (equations,) and (measures,), the first of which is that of 1.
    """
    structure, nodes = point.system.structure, point.system.nodes
    forces = np.zeros_like(point.forces)
    for slope, (force, channel) in zip(point.slopes, structure.pairs, strict=True):
        if channel in fields:
            forces[force] += slope * fields[channel]
    if point.memory is not None:
        forces += point.memory.times(fields)
    q = np.concatenate([[0.0], _means(point.system, point.grid, forces)])
    residual = given + structure.residual.slopes(point.z, point.q, structure.first_state)[0] @ q
    return residual if nodes is None else np.concatenate(
        [residual, -forces[nodes.force].ravel()]
    ), q


def _force_slope(point: Point, force: int, channel: int) -> Array:
    """∂f/∂c of one force by one channel, (elements, azimuths); 0 where the force has none."""
    pairs, pair = point.system.structure.pairs, (force, channel)
    return point.slopes[pairs.index(pair)] if pair in pairs else np.zeros(point.forces.shape[1:])


def _measures_by_channel(point: Point, channel: int) -> Array:
    """∂ of the measures by a channel at every point, (measures, points)."""
    structure, psi, waves = point.system.structure, point.system.shapes.psi, point.grid.waves
    force, row, wave = structure.measure_keys.T
    weights = psi[structure.first_weight[force] + row][:, :, None]
    slopes = np.stack([_force_slope(point, k, channel) for k in range(structure.forces)])
    out = np.zeros((1 + len(row), *slopes.shape[1:]))
    out[1:] = weights * waves.mean.T[wave][:, None] * slopes[force]
    if point.memory is not None:
        out[1:] += weights * point.memory.by_channel(point.remembered, channel)[force, wave]
    return out.reshape(len(out), -1)


def _field_slopes(point: Point, force: int) -> Array:
    """∂ of a force at every point by the states solved for, (points, states)."""
    structure, waves = point.system.structure, point.grid.waves
    by_atom, shapes = point.coefficient_slopes, len(point.phi)
    spread = np.zeros((shapes * structure.waves, by_atom.shape[0]))
    spread[structure.coefficient_places] = by_atom.toarray().T
    by_free = _by_free(structure, spread, point.by_roots).T
    around = by_free.reshape(-1, shapes, structure.waves) @ waves.at  # (free, shapes, azimuths)
    out = np.zeros((len(by_free), *point.channels.shape[1:]))
    for channel in range(structure.channels):
        first, end = structure.first_row[channel : channel + 2]
        if end > first and (force, channel) in structure.pairs:
            moved = np.matmul(point.phi[first:end].T, around[:, first:end])
            out += moved * _force_slope(point, force, channel)
    return out.reshape(len(out), -1).T


def _measure_slopes(point: Point) -> Array:
    """∂ of the measures by states and derived atoms, (measures, atoms)."""
    structure, psi, waves = point.system.structure, point.system.shapes.psi, point.grid.waves
    between, blocks = np.zeros((len(structure.coefficient_places), len(point.q))), structure.blocks
    _between(
        point.slopes,
        point.phi,
        psi,
        waves.mean_of_products,
        blocks.arrays,
        blocks.places,
        blocks.factors,
        between,
    )
    if point.memory is not None:
        point.memory.add_between(point.remembered, structure, point.phi, psi, waves, between)
    return np.ascontiguousarray((point.coefficient_slopes @ between).T)


def _by_free(structure: Structure, total: Array, by_roots: Array) -> Array:
    """Slopes by the states solved for, from those by states and derived atoms, (rows, …)."""
    first, given = structure.first_state, structure.given
    states = total[:, : given - first]
    if structure.roots:
        states[:, np.array(structure.roots) - first] += total[:, given - first :] @ by_roots
    return np.take(states, structure.free - first, axis=1)


@dataclass(frozen=True, eq=False)
class MeasureSlopes:
    """Slopes of a scalar at a point: what an adjoint begins with."""

    forces: Mapping[int, Array] = field(default_factory=dict[int, Array])
    """By force, (elements, azimuths) or (elements, 1)."""
    channels: Mapping[int, Array] = field(default_factory=dict[int, Array])
    """By channel at the same forces."""
    parts: Sequence[tuple[int, Sequence[Shape], Array]] = ()
    """By what some shapes add to a channel, at the same channel: (channel, names, field)."""
    nodes: Array | None = None
    """By what the nodes add to theirs, at the same channel."""
    terms: Terms | None = None
    """A sum of terms to be added."""


@_compile
def _add_by_channels(slopes: Any, rows: Any, forces: Any, out: Any) -> None:
    """Add Dᵀ times fields of the forces to fields of the channels; rows: see `Structure.slope_rows`."""
    for slope, force, channel in rows:
        for i in range(out.shape[1]):
            for j in range(out.shape[2]):
                out[channel, i, j] += slopes[slope, i, j] * forces[force, i, j]


def transposed(point: Point, v: Array, measure: MeasureSlopes | None = None) -> tuple[Array, Array]:
    """Slopes of v·R plus a measure: by the states solved for, and by every channel at every element and azimuth.

    (equations,), and (channels, elements, azimuths). `point` has slopes.
    """
    structure, waves, psi = point.system.structure, point.grid.waves, point.system.shapes.psi
    measure, nodes, size = measure or MeasureSlopes(), point.system.nodes, len(structure.equations)
    on_q, on_z = (v[:size] @ slopes for slopes in point.residual_slopes)
    if measure.terms is not None:
        more = measure.terms.slopes(point.z, point.q, structure.first_state)
        on_q, on_z = on_q + more[0].sum(axis=0), on_z + more[1].sum(axis=0)
    spread = np.zeros((len(psi), structure.waves))
    spread.ravel()[structure.measure_places] = on_q[1:]
    forces = np.zeros_like(point.forces)
    _add_along_blade(psi, structure.first_weight, spread @ waves.mean.T, forces)
    for force, weights in measure.forces.items():
        forces[force] += weights
    if nodes is not None:
        forces[nodes.force] -= v[size:].reshape(forces.shape[1:])
    channels = (
        np.zeros_like(point.channels) if point.memory is None else point.memory.transposed(forces)
    )
    for channel, weights in measure.channels.items():
        channels[channel] += weights
    used = {*measure.forces, *(() if nodes is None else (nodes.force,))}
    _add_by_channels(
        point.slopes,
        structure.slope_rows(used, () if nodes is None else (nodes.channel,)),
        forces,
        channels,
    )
    around = np.zeros((len(point.phi), waves.azimuths))
    _add_around(point.phi, structure.first_row, channels, around)
    for channel, names, weights in measure.parts:
        rows = structure.rows_of(channel, names)
        around[rows] += point.phi[rows] @ weights
    on_z += point.coefficient_slopes @ (around @ waves.at.T).ravel()[structure.coefficient_places]
    on_states = _by_free(structure, on_z[None], point.by_roots)[0]
    if nodes is None:
        return on_states, channels
    on_field = channels[nodes.channel] + (0.0 if measure.nodes is None else measure.nodes)
    return np.concatenate([on_states, v[size:] + nodes.transposed(on_field.ravel())]), channels
