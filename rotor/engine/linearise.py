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
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

from rotor.arrays import Array, Integers
from rotor.compiled import compiled
from rotor.engine.memory import Memory, on_forces
from rotor.engine.terms import Shape, Structure, Terms, summed
from rotor.engine.waves import WaveGrid

_compile = compiled(error_model="numpy", fastmath={"contract"})

_sums = compiled(error_model="numpy", fastmath={"contract", "reassoc", "nsz"})  # Sums in any order make vector code.

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
    """Of y − f."""
    limit: float
    """Largest step of y."""

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
            return np.array([values.get(name, none) for own in all_names for name in own]).reshape(-1, len(widths))

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
    """The same on few azimuths, or `grid` itself."""
    section: Callable[[Array, Any, bool, bool], tuple[Array, Array, Array]]
    """Channels and the data of the grid → forces, partial derivatives and flow; the last two where asked for."""
    make: Callable[[Array], tuple[Array, Array, Live]]
    """x → derived atoms, their slopes by the roots (derived, roots), live shapes."""
    numbers: Array
    tolerance: Array
    """Of each equation, (equations,)."""
    limits: Array
    """Largest step of each state solved for, (equations,)."""
    nodes: Nodes | None = None
    """Their equations and unknowns come after all others."""
    memory: Callable[[Array, Any], Memory] | None = None
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
    def memory(self) -> Memory | None:
        """How forces follow channels at other azimuths."""
        found = self.system.memory
        return None if found is None else found(self.channels, self.grid.data)

    @cached_property
    def remembered(self) -> Array:
        """∂ of the means of all forces with all waves by the inputs of the memory at all azimuths.

        (elements, forces, waves, inputs, azimuths)
        """
        assert self.memory is not None
        return self.memory.by_inputs(self.grid.waves)

    @cached_property
    def size(self) -> float:
        """Largest residual over its tolerance."""
        size = float((np.abs(self.residual) / self.system.tolerance).max())
        return size if np.isfinite(size) else np.inf


def evaluate(system: System, grid: Grid, x: Array, *, slopes: bool = False, flow: bool = False) -> Point:
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
    channels = np.empty((structure.channels, phi.shape[1], grid.waves.azimuths))
    _channels(phi, structure.first_row, _coefficients(structure, z) @ grid.waves.at, grid.steady, channels)
    for channel, added in grid.varying.items():
        channels[channel] += added
    nodes = system.nodes
    if nodes is not None:
        channels[nodes.channel] += nodes.field(y).reshape(channels.shape[1:])
    forces, found, s = system.section(channels, grid.data, slopes, flow)
    along = np.zeros((len(shapes.psi), grid.waves.azimuths))
    _along_blade(shapes.psi, structure.first_weight, forces, along)
    q = np.empty(1 + len(structure.measures))
    q[0], q[1:] = 1.0, (along @ grid.waves.mean).ravel()[structure.measure_places]
    residual = structure.residual.value(z, q)
    if nodes is not None:
        missing = y.reshape(channels.shape[1:]) - forces[nodes.force]
        residual = np.concatenate([residual, missing.ravel()])
    return Point(system, grid, x, z, by_roots, phi, channels, forces, found, s, q, residual)


def _coefficients(structure: Structure, z: Array) -> Array:
    """G: what every shape has of every wave, (shapes, waves)."""
    place, i, j, factor = structure.column_arrays
    g = summed(place, factor * z[i] * z[j], int(structure.first_row[-1]) * structure.waves)
    return g.reshape(-1, structure.waves)


@_compile
def _add_times(factor: float, one: Any, out: Any) -> None:
    for j in range(len(out)):
        out[j] += factor * one[j]


@_compile
def _add_product(one: Any, other: Any, out: Any) -> None:
    for j in range(len(out)):
        out[j] += one[j] * other[j]


@_compile
def _channels(phi: Any, first: Any, around: Any, steady: Any, out: Any) -> None:
    """Φᵀ times functions of azimuth, (shapes, azimuths), channel by channel."""
    for k in range(out.shape[0]):
        for i in range(out.shape[1]):
            for j in range(out.shape[2]):
                out[k, i, j] = steady[k, i]
            for row in range(first[k], first[k + 1]):
                _add_times(phi[row, i], around[row], out[k, i])


@_compile
def _along_blade(psi: Any, first: Any, forces: Any, out: Any) -> None:
    """Σ along the blade of every weight times its force, (weights, azimuths)."""
    for o in range(len(first) - 1):
        for row in range(first[o], first[o + 1]):
            for i in range(psi.shape[1]):
                _add_times(psi[row, i], forces[o, i], out[row])


def part(point: Point, channel: int, names: Sequence[Shape]) -> Array:
    """What some shapes add to a channel, (elements, azimuths)."""
    structure = point.system.structure
    own = [structure.shapes[channel][name] for name in names]
    rows = structure.first_row[channel] + np.array(own, dtype=np.int64)
    return point.phi[rows].T @ (_coefficients(structure, point.z)[rows] @ point.grid.waves.at)


@_compile
def _between(
    slopes: Any, phi: Any, psi: Any, products: Any, blocks: Any, places: Any, factors: Any, out: Any
) -> None:  # fmt: skip
    """Means of Ψ D Φ w_p w_q from the Fourier coefficients of Σ Ψ D Φ, (coefficients, measures), see `Blocks`."""
    n = phi.shape[1]
    for b in range(len(blocks)):
        slope, first, end, own, last, waves, start, stop = blocks[b]
        pairs = np.empty(((end - first) * (last - own), n))
        for i in range(first, end):
            for k in range(own, last):
                row = (i - first) * (last - own) + k - own
                for e in range(n):
                    pairs[row, e] = psi[i, e] * phi[k, e]
        around = products[:waves].T
        if len(pairs) > n:  # The order of the two products that takes less.
            found = np.dot(pairs, np.dot(slopes[slope], around))
        else:
            found = np.dot(np.dot(pairs, slopes[slope]), around)
        flat = found.reshape(-1)
        for e in range(start, stop):
            one = factors[0, e] * flat[places[2, e]] + factors[1, e] * flat[places[3, e]]
            out[places[0, e], places[1, e]] = one


def jacobian(point: Point, further: Terms | None = None) -> tuple[Array, Array]:
    """∂R by the states solved for, (equations, equations), and that of further measures; `point` has slopes."""
    structure, z, q = point.system.structure, point.z, point.q
    first = structure.first_state
    by_z = _measure_slopes(point)
    nodes = point.system.nodes
    on_q, total = structure.residual.slopes(z, q, first)
    summing = structure.residual.summing
    total[summing] += _sparse_times(on_q[summing], by_z)
    added, further_q = np.zeros((0, total.shape[1])), np.zeros((0, len(q)))
    if further is not None:
        further_q, on_z = further.slopes(z, q, first)
        added = on_z + further_q @ by_z
    own, other = _by_free(structure, total, point.by_roots), _by_free(structure, added, point.by_roots)
    if nodes is None:
        return own, other
    on_channel = _sparse_times(np.concatenate([on_q, further_q]), _measures_by_channel(point, nodes.channel))
    through = on_channel @ nodes.matrix
    by_channel = _force_slope(point, nodes.force, nodes.channel).ravel()
    size, points = len(own), len(by_channel)
    full = np.empty((size + points, size + points))
    full[:size, :size], full[:size, size:] = own, through[:size]
    full[size:, :size] = -_field_slopes(point, nodes.force)
    np.multiply(nodes.matrix, -by_channel[:, None], out=full[size:, size:])
    full[range(size, size + points), range(size, size + points)] += 1.0
    return full, np.concatenate([other, through[size:]], axis=1)


_MANY_ENTRIES = 20_000
"""Size from which a matrix with few measures in each equation is multiplied as a sparse one. Our choice."""


def _sparse_times(one: Array, other: Array) -> Array:
    """A product whose first factor is mostly zero."""
    return np.asarray(csr_matrix(one) @ other) if one.size > _MANY_ENTRIES else one @ other


def response(point: Point, fields: Mapping[int, Array], given: Array) -> tuple[Array, Array]:
    """∂R and ∂ of the measures where channels have fields added, at the same states; `point` has slopes.

    fields: by channel, (elements, azimuths). given: what the same does to R directly, (equations without nodes,).
    Returns (equations,) and (measures,), the first of which is that of 1.
    """
    structure, psi, waves, nodes = point.system.structure, point.system.shapes.psi, point.grid.waves, point.system.nodes
    forces = np.zeros_like(point.forces)
    for slope, (force, channel) in zip(point.slopes, structure.pairs, strict=True):
        if channel in fields:
            forces[force] += slope * fields[channel]
    if point.memory is not None:
        forces += point.memory.times(fields)
    along, q = np.zeros((len(psi), waves.azimuths)), np.zeros(len(point.q))
    _along_blade(psi, structure.first_weight, forces, along)
    q[1:] = (along @ waves.mean).ravel()[structure.measure_places]
    residual = given + structure.residual.slopes(point.z, point.q, structure.first_state)[0] @ q
    return residual if nodes is None else np.concatenate([residual, -forces[nodes.force].ravel()]), q


def _force_slope(point: Point, force: int, channel: int) -> Array:
    """∂f/∂c of one force by one channel, (elements, azimuths); 0 where the force has none."""
    pairs = point.system.structure.pairs
    return (
        point.slopes[pairs.index((force, channel))] if (force, channel) in pairs else np.zeros(point.forces.shape[1:])
    )


def _measures_by_channel(point: Point, channel: int) -> Array:
    """∂ of the measures by a channel at every point, (measures, points)."""
    structure, psi, waves = point.system.structure, point.system.shapes.psi, point.grid.waves
    row, wave = np.divmod(structure.measure_places, structure.waves)
    force = np.searchsorted(structure.first_weight, row, side="right") - 1
    out = np.zeros((1 + len(row), psi.shape[1], waves.azimuths))
    for k in np.unique(force).tolist():
        own = force == k
        weights = psi[row[own]][:, :, None] * waves.mean.T[wave[own]][:, None, :]
        out[1 + np.flatnonzero(own)] = weights * _force_slope(point, k, channel)
    if point.memory is not None:
        out[1:] += psi[row][:, :, None] * point.memory.by_channel(point.remembered, channel)[force, wave]
    return out.reshape(len(out), -1)


def _field_slopes(point: Point, force: int) -> Array:
    """∂ of a force at every point by the states solved for, (points, states)."""
    structure, waves = point.system.structure, point.grid.waves
    by_atom, order = structure.by_atom
    _, i, j, factor = structure.column_arrays
    by_atom.data = np.concatenate([factor * point.z[j], factor * point.z[i]])[order]
    size = int(structure.first_row[-1]) * structure.waves
    spread = np.zeros((by_atom.shape[0], size))
    spread[:, structure.coefficient_places] = by_atom.toarray()
    by_free = _by_free(structure, np.ascontiguousarray(spread.T), point.by_roots).T
    around = by_free.reshape(-1, int(structure.first_row[-1]), structure.waves) @ waves.at  # (free, shapes, azimuths)
    out = np.zeros((len(by_free), point.channels.shape[1], waves.azimuths))
    for channel in range(structure.channels):
        first, end = structure.first_row[channel : channel + 2]
        if end > first and (force, channel) in structure.pairs:
            moved = np.matmul(point.phi[first:end].T, around[:, first:end])
            out += moved * _force_slope(point, force, channel)
    return out.reshape(len(out), -1).T


def _measure_slopes(point: Point) -> Array:
    """∂ of the measures by states and derived atoms, (measures, atoms)."""
    system, structure, grid, z = point.system, point.system.structure, point.grid, point.z
    by_atom, order = structure.by_atom
    between, blocks = np.zeros((by_atom.shape[1], len(point.q))), structure.blocks
    _between(
        point.slopes, point.phi, system.shapes.psi, grid.waves.mean_of_products, blocks.arrays, blocks.places,
        blocks.factors, between,
    )  # fmt: skip
    if point.memory is not None:
        point.memory.add_between(point.remembered, structure, point.phi, system.shapes.psi, grid.waves, between)
    _, i, j, factor = structure.column_arrays
    by_atom.data = np.concatenate([factor * z[j], factor * z[i]])[order]
    return np.ascontiguousarray((by_atom @ between).T)


def _by_free(structure: Structure, total: Array, by_roots: Array) -> Array:
    """Slopes by the states solved for, from those by states and derived atoms, (rows, …)."""
    first, given = structure.first_state, structure.given
    states = total[:, : given - first]
    if structure.roots:
        states[:, np.array(structure.roots) - first] += total[:, given - first :] @ by_roots
    return np.take(states, structure.free - first, axis=1)


@dataclass(frozen=True, eq=False)
class Measure:
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
def _through_section(
    point: Any, around: Any, forces: Any, channels: Any, out: Any, by_element: Any, kept: int, field: Any
) -> None:  # fmt: skip
    """From functions of azimuth by weights, (weights, azimuths), to such by shapes, (shapes, azimuths): Φ Dᵀ Ψᵀ.

    point: (Φ, Ψ, first shapes, first weights, D, rows of D by (force, channel)). forces, channels: what is added there,
    (…, elements, azimuths), or without elements. by_element: slopes by channel, summed over the azimuths. field: those
    of the channel `kept` at every point, or without elements.
    """
    phi, psi, first, first_weight, slopes, rows = point
    m = around.shape[1]
    force, by_channel = np.zeros((len(first_weight) - 1, m)), np.zeros((len(first) - 1, m))
    for i in range(phi.shape[1]):
        force[:], by_channel[:] = 0.0, 0.0
        for o in range(len(force)):
            for row in range(first_weight[o], first_weight[o + 1]):
                _add_times(psi[row, i], around[row], force[o])
        if forces.shape[1] > 0:
            force += forces[:, i]
        if channels.shape[1] > 0:
            by_channel += channels[:, i]
        for k in range(len(rows)):
            _add_product(slopes[rows[k, 0], i], force[rows[k, 1]], by_channel[rows[k, 2]])
        if field.shape[0] > 0:
            for j in range(m):
                field[i, j] = by_channel[kept, j]
        for c in range(len(by_channel)):
            by_element[c, i] = by_channel[c].sum()
            for row in range(first[c], first[c + 1]):
                _add_times(phi[row, i], by_channel[c], out[row])


def transposed(point: Point, v: Array, measure: Measure | None = None) -> tuple[Array, Array]:
    """Slopes of v·R plus a measure: by the states solved for, and by every channel at every element around the azimuth.

    (equations,), and (channels, elements): summed over the azimuths. `point` has slopes.
    """
    structure, grid, z, q, shapes = point.system.structure, point.grid, point.z, point.q, point.system.shapes
    measure = measure or Measure()
    equations, nodes = len(structure.equations), point.system.nodes
    v, on_nodes = v[:equations], v[equations:]
    on_q, on_z = structure.residual.transposed(v, z, q)
    if measure.terms is not None:
        more_q, more_z = measure.terms.transposed(np.ones(measure.terms.rows), z, q)
        on_q, on_z = on_q + more_q, on_z + more_z
    spread = np.zeros(structure.first_weight[-1] * structure.waves)
    spread[structure.measure_places] = on_q[1:]
    around = spread.reshape(-1, structure.waves) @ grid.waves.mean.T
    along, by_element = np.zeros((len(shapes.phi), grid.waves.azimuths)), np.empty(point.channels.shape[:2])
    by_force, shape = dict(measure.forces), point.forces.shape[1:]
    if nodes is not None:
        by_force[nodes.force] = by_force.get(nodes.force, 0.0) - on_nodes.reshape(shape)
    rows = structure.slope_rows(tuple(by_force), () if nodes is None else (nodes.channel,))
    arrays = point.phi, shapes.psi, structure.first_row, structure.first_weight, point.slopes, rows
    forces, channels = _stack(by_force, point.forces.shape), _stack(measure.channels, point.channels.shape)
    if point.memory is not None:
        whole = on_forces(shapes.psi, structure.first_weight, around)
        whole += forces if by_force else 0.0
        remembered = point.memory.transposed(whole)
        channels = remembered if not measure.channels else channels + remembered
    field = np.empty(shape if nodes is not None else (0, shape[1]))
    kept = 0 if nodes is None else nodes.channel
    _through_section(arrays, around, forces, channels, along, by_element, kept, field)
    for channel, names, own in measure.parts:
        places = [structure.shapes[channel][name] for name in names]
        rows = structure.first_row[channel] + np.array(places, dtype=np.int64)
        along[rows] += point.phi[rows] @ own
    place, i, j, factor = structure.column_arrays
    value = factor * (along @ grid.waves.at.T).ravel()[place]
    on_z = on_z + summed(i, value * z[j], len(z)) + summed(j, value * z[i], len(z))
    by_free = _by_free(structure, on_z[None, structure.first_state :], point.by_roots)[0]
    if nodes is not None:
        if measure.nodes is not None:
            field += measure.nodes
        by_nodes = on_nodes + nodes.transposed(field.ravel())
        by_free = np.concatenate([by_free, by_nodes])
    return by_free, by_element


def _stack(fields: Mapping[int, Array], shape: tuple[int, ...]) -> Array:
    """The fields in one array, without elements where there are none."""
    out = np.zeros(shape if fields else (shape[0], 0, shape[2]))
    for k, own in fields.items():
        out[k] += own
    return out
