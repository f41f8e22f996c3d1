"""The equations at a point, their exact Jacobian, and the Jacobian transposed.

    channels   c = Φᵀ G W,  G = Σ factor z_i z_j                    K
    section    f(c), D = ∂f/∂c at every point                       `System.section`
    measures   Q = mean Ψ f Wᵀ Δr                                   P
    residual   R(z, Q),  closures  y − T(z) Q

    J = ∂R/∂Q (Pᵀ D K) ∂G/∂z ∂z/∂x + ∂R/∂z ∂z/∂x,  and Jᵀ v by the same operators transposed.

A product of two waves is a sum of two, so Pᵀ D K takes only the Fourier coefficients of Σ Ψ D Φ: one product along the
blade for each pair of shapes, one around the azimuth, and two numbers for each entry.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from rotor.arrays import Array, Integers
from rotor.compiled import compiled
from rotor.engine.terms import Shape, Structure, Terms, summed
from rotor.engine.waves import WaveGrid

_compile = compiled(error_model="numpy", fastmath={"contract"})

Live = Mapping[tuple[int, Shape], Array]
"""Shapes that follow the states, by channel and name."""


class Closure(Protocol):
    """y = T(z) Q for some states y, with a matrix that depends on a few atoms."""

    rows: Integers
    """Equations, (size,)."""
    measures: Integers
    """Q, (size,)."""
    atoms: Integers
    """That T depends on, (few,)."""

    def value(self, z: Array, q: Array) -> Array:
        """T(z) Q, (size,)."""
        ...

    def linear(self, z: Array, q: Array) -> tuple[Array, Array]:
        """T, (size, size), and ∂(T Q)/∂ the atoms, (size, few)."""
        ...


class Shapes:
    """Functions along the blade, by channel and by force, for one structure and blade."""

    def __init__(self, structure: Structure, values: Mapping[Shape, Array], elements: int) -> None:
        """values: by name, (elements,); those that are missing are live."""
        none = np.zeros(elements)

        def stack(all_names: Sequence[Mapping[Shape, int]]) -> Array:
            return np.array([values.get(name, none) for own in all_names for name in own]).reshape(-1, elements)

        self.phi = stack(structure.shapes)
        """(shapes of all channels, elements)"""
        self.psi = stack(structure.weights)
        """(weights of all forces, elements)"""


@dataclass(frozen=True, eq=False)
class Grid:
    """The blade elements on one number of azimuths."""

    waves: WaveGrid
    dr: float
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
    """x → made atoms, their slopes by the roots (made, roots), live shapes."""
    numbers: Array
    tolerance: Array
    """Of each equation, (equations,)."""
    limits: Array
    """Largest step of each state solved for, (equations,)."""
    closures: tuple[Closure, ...] = ()


@dataclass(frozen=True, eq=False)
class Point:
    """The equations at x = (1, numbers, states), with what their derivatives need."""

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
    def size(self) -> float:
        """Largest residual over its tolerance; the rows of a closure are added up, for they are parts of one field."""
        error = np.abs(self.residual) / self.system.tolerance
        for closure in self.system.closures:
            error[closure.rows[0]] = error[closure.rows].sum()
        size = float(error.max())
        return size if np.isfinite(size) else np.inf

    @cached_property
    def closures(self) -> "list[tuple[Closure, Array, Array]]":
        """The closures with their matrices and slopes."""
        return [(closure, *closure.linear(self.z, self.q)) for closure in self.system.closures]


def evaluate(system: System, grid: Grid, x: Array, *, slopes: bool = False, flow: bool = False) -> Point:
    """R(x); with the partial derivatives of the section, and the flow at the sections, where asked for."""
    structure, shapes = system.structure, system.shapes
    made, by_roots, live = system.make(x)
    z = np.concatenate([x, made])
    phi = shapes.phi
    if live:
        phi = phi.copy()
        for (channel, name), values in live.items():
            phi[structure.first_row[channel] + structure.shapes[channel][name]] = values
    channels = np.empty((structure.channels, phi.shape[1], grid.waves.azimuths))
    _channels(phi, structure.first_row, _coefficients(structure, z) @ grid.waves.at, grid.steady, channels)
    for channel, added in grid.varying.items():
        channels[channel] += added
    forces, found, s = system.section(channels, grid.data, slopes, flow)
    along = np.zeros((len(shapes.psi), grid.waves.azimuths))
    _along_blade(shapes.psi, structure.first_weight, forces, along)
    q = np.empty(1 + len(structure.measures))
    q[0], q[1:] = 1.0, (along @ grid.waves.mean).ravel()[structure.measure_places] * grid.dr
    residual = structure.residual.value(z, q)
    for closure in system.closures:
        residual[closure.rows] -= closure.value(z, q)
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
    rows = structure.first_row[channel] + np.array([structure.shapes[channel][name] for name in names])
    return point.phi[rows].T @ (_coefficients(structure, point.z)[rows] @ point.grid.waves.at)


@_compile
def _between(
    slopes: Any, phi: Any, psi: Any, products: Any, dr: float, blocks: Any, places: Any, factors: Any, out: Any
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
            out[places[0, e], places[1, e]] = dr * one


def jacobian(point: Point, further: Terms | None = None) -> tuple[Array, Array]:
    """∂R by the states solved for, (equations, equations), and that of further measures; `point` has slopes."""
    structure, z, q = point.system.structure, point.z, point.q
    first = structure.first_state
    by_z = _measure_slopes(point)
    on_q, total = structure.residual.slopes(z, q, first)
    summing = structure.residual.summing
    total[summing] += on_q[summing] @ by_z
    for closure, matrix, by_atoms in point.closures:
        total[closure.rows] -= matrix @ by_z[closure.measures]
        total[np.ix_(closure.rows, closure.atoms - first)] -= by_atoms
    added = np.zeros((0, total.shape[1]))
    if further is not None:
        on_q, on_z = further.slopes(z, q, first)
        added = on_z + on_q @ by_z
    return _by_free(structure, total, point.by_roots), _by_free(structure, added, point.by_roots)


def _measure_slopes(point: Point) -> Array:
    """∂ of the measures by states and made atoms, (measures, atoms)."""
    system, structure, grid, z = point.system, point.system.structure, point.grid, point.z
    by_atom, order = structure.by_atom
    between, blocks = np.zeros((by_atom.shape[1], len(point.q))), structure.blocks
    _between(
        point.slopes, point.phi, system.shapes.psi, grid.waves.mean_of_products, grid.dr, blocks.arrays, blocks.places,
        blocks.factors, between,
    )  # fmt: skip
    _, i, j, factor = structure.column_arrays
    by_atom.data = np.concatenate([factor * z[j], factor * z[i]])[order]
    return np.ascontiguousarray((by_atom @ between).T)


def _by_free(structure: Structure, total: Array, by_roots: Array) -> Array:
    """Slopes by the states solved for, from those by states and made atoms, (rows, …)."""
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
    terms: Terms | None = None
    """A sum of terms to be added."""


@_compile
def _through_section(point: Any, around: Any, forces: Any, channels: Any, out: Any, by_element: Any) -> None:
    """From functions of azimuth by weights, (weights, azimuths), to such by shapes, (shapes, azimuths): Φ Dᵀ Ψᵀ.

    point: (Φ, Ψ, first shapes, first weights, D, rows of D by (force, channel)). forces, channels: what is added there,
    (…, elements, azimuths), or without elements. by_element: slopes by channel, summed over the azimuths.
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
    on_q, on_z = structure.residual.transposed(v, z, q)
    for closure, matrix, by_atoms in point.closures:
        on_q[closure.measures] -= v[closure.rows] @ matrix
        on_z[closure.atoms] -= v[closure.rows] @ by_atoms
    if measure.terms is not None:
        more_q, more_z = measure.terms.transposed(np.ones(measure.terms.rows), z, q)
        on_q, on_z = on_q + more_q, on_z + more_z
    spread = np.zeros(structure.first_weight[-1] * structure.waves)
    spread[structure.measure_places] = on_q[1:] * grid.dr
    around = spread.reshape(-1, structure.waves) @ grid.waves.mean.T
    along, by_element = np.zeros((len(shapes.phi), grid.waves.azimuths)), np.empty(point.channels.shape[:2])
    rows = structure.slope_rows(tuple(measure.forces))
    arrays = point.phi, shapes.psi, structure.first_row, structure.first_weight, point.slopes, rows
    forces, channels = _stack(measure.forces, point.forces.shape), _stack(measure.channels, point.channels.shape)
    _through_section(arrays, around, forces, channels, along, by_element)
    for channel, names, own in measure.parts:
        rows = structure.first_row[channel] + np.array([structure.shapes[channel][name] for name in names])
        along[rows] += point.phi[rows] @ own
    place, i, j, factor = structure.column_arrays
    value = factor * (along @ grid.waves.at.T).ravel()[place]
    on_z = on_z + summed(i, value * z[j], len(z)) + summed(j, value * z[i], len(z))
    return _by_free(structure, on_z[None, structure.first_state :], point.by_roots)[0], by_element


def _stack(fields: Mapping[int, Array], shape: tuple[int, ...]) -> Array:
    """The fields in one array, without elements where there are none."""
    out = np.zeros(shape if fields else (shape[0], 0, shape[2]))
    for k, own in fields.items():
        out[k] += own
    return out
