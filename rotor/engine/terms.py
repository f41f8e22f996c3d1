"""The structure of a rotor's equations as lists of terms; their numbers come with each design.

    atoms     z = (1, numbers, states, derived)       numbers: given by the design; derived: from states, by formulas
    columns   channel(r, ψ) += factor z_i z_j Φ(r) w(ψ)
    measures  Q_k = mean over ψ of Σ Ψ(r) w(ψ) F(r, ψ) Δr
    terms     R_e += factor z_i z_j Q_k,   Q_0 = 1

A structure is made once for each combination of trim, blade and wake, and shared: once finished nothing of it changes.
"""

from collections.abc import Collection, Hashable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy.sparse import csr_matrix

from rotor.engine.waves import STEADY, products, times_wave
from rotor.support.arrays import Array, Integers, fix, fixed_property
from rotor.support.compiled import compiled

ONE = 0
"""The atom 1."""

Shape = Hashable
"""Name of a function along the blade."""


def summed(place: Integers, values: Array, size: int) -> Array:
    """Sums of the values with the same place, (size,)."""
    return np.asarray(np.bincount(place, values, size), dtype=np.float64)


@compiled(error_model="numpy")
def _slopes(
    row: Any,
    measure: Any,
    first: Any,
    second: Any,
    factor: Any,
    z: Any,
    q: Any,
    skipped: int,
    by_q: Any,
    by_z: Any,
) -> None:
    """`Terms.slopes`; skipped: atoms before the first."""
    for k in range(len(row)):
        i, j, value = first[k], second[k], q[measure[k]]
        by_q[row[k], measure[k]] += factor[k] * z[i] * z[j]
        if i >= skipped:
            by_z[row[k], i - skipped] += factor[k] * z[j] * value
        if j >= skipped:
            by_z[row[k], j - skipped] += factor[k] * z[i] * value


Term = tuple[int, int, int, int, float] | tuple[int, int, int, int, float, int]
"""(equation, measure, z_i, z_j, factor), and a number by which it is multiplied."""


Sum = list[tuple[float, int, int, int]]
Addend = tuple[float, int, int, int] | tuple[float, int, int, int, int]
"""(factor, z_i, z_j, Q) and a number: of a sum."""


@dataclass(frozen=True, eq=False)
class Terms:
    """A list of terms: what equations and other measures are sums of."""

    row: Integers
    """The equation of each term, (terms,), as the next five."""
    measure: Integers
    first: Integers
    """z_i"""
    second: Integers
    """z_j"""
    number: Integers
    """The atom of a number, or 1: a third factor, which no state changes."""
    factor: Array
    rows: int
    """Number of equations."""

    @classmethod
    def of(cls, terms: Sequence[Term], rows: int) -> "Terms":
        """Terms from their list; rows: number of equations."""
        places = [(*term[:4], term[5] if len(term) > 5 else ONE) for term in terms]
        columns = np.array(places, dtype=np.int64).reshape(-1, 5).T.copy()
        return cls(
            *columns, factor=np.array([term[4] for term in terms], dtype=np.float64), rows=rows
        )

    def value(self, z: Array, q: Array) -> Array:
        """(rows,)"""
        weights = self.factor * z[self.number] * z[self.first] * z[self.second] * q[self.measure]
        return summed(self.row, weights, self.rows)

    def slopes(self, z: Array, q: Array, first_atom: int) -> tuple[Array, Array]:
        """∂ by the measures, (rows, measures), and by the atoms from one on, (rows, atoms)."""
        by_q, by_z = np.zeros((self.rows, len(q))), np.zeros((self.rows, len(z) - first_atom))
        # One kernel for a column of many, too.
        factor, q = (
            self.factor * z[self.number],
            np.ascontiguousarray(q),
        )
        _slopes(
            self.row, self.measure, self.first, self.second, factor, z, q, first_atom, by_q, by_z
        )
        return by_q, by_z

    @fixed_property
    def summing(self) -> Integers:
        """The equations with measures other than 1."""
        return np.unique(self.row[self.measure > 0])

    def stacked(self, other: "Terms") -> "Terms":
        """The rows of these terms, then those of others."""
        names = "measure", "first", "second", "number", "factor"
        pairs = ((getattr(self, name), getattr(other, name)) for name in names)
        row = np.concatenate([self.row, other.row + self.rows])
        return Terms(row, *(np.concatenate(pair) for pair in pairs), rows=self.rows + other.rows)


NO_TERMS = Terms.of((), 0)
"""No rows."""


@dataclass(frozen=True, eq=False)
class Blocks:
    """Where the derivatives of the measures by the wave coefficients stand, for each pair of force and channel."""

    arrays: Integers
    """By block: row of the section's partial derivatives, first and last weight, first and last shape, how many
    waves their products have, and where its entries begin and end, (blocks, 8)."""
    places: Integers
    """By entry: coefficient and measure, and places of the two waves of their product, (4, entries)."""
    factors: Array
    """Factors of the two waves of each entry, (2, entries)."""


def _kind_of(name: Hashable) -> Hashable:
    """The first word of a name."""
    return cast(tuple[Hashable, ...], name)[0] if isinstance(name, tuple) else name


class Structure:
    """Atoms, columns, measures and equations, and once finished all places in the matrices."""

    def __init__(
        self, pairs: tuple[tuple[int, int], ...], channels: int, forces: int, name: Hashable = None
    ) -> None:
        """pairs: force and channel of each row of the section's partial derivatives.

        name: the same for structures with the same atoms and equations.
        """
        self.pairs, self.channels, self.forces, self.name = pairs, channels, forces, name
        # Atoms by name.
        self.numbers, self.states, self.derived = (dict[Hashable, int]() for _ in range(3))
        self.roots: tuple[int, ...] = ()
        """States that derived atoms follow."""
        self.shapes, self.weights = (
            [dict[Shape, int]() for _ in range(count)] for count in (channels, forces)
        )
        """By channel, and by force."""
        self.columns = list[tuple[int, int, int, int, int, float]]()
        self.measures = dict[tuple[int, int, int], int]()
        self.terms = list[Term]()
        self.equations = dict[Hashable, int]()
        self.sums = dict[str, Terms]()
        self.free = np.zeros(0, dtype=np.int64)
        """The atoms solved for, (equations,)."""
        self.waves, self.finished = 1, False
        self._slope_rows = dict[tuple[frozenset[int], frozenset[int]], Integers]()

    def number(self, name: Hashable) -> int:
        """The atom of a number that the design gives."""
        assert not self.states, "numbers come before states"
        return self.numbers.setdefault(name, 1 + len(self.numbers))

    def state(self, name: Hashable) -> int:
        """The atom of a quantity that may be solved for."""
        assert not self.derived, "states come before what is derived from them"
        return self.states.setdefault(name, 1 + len(self.numbers) + len(self.states))

    def quantity(self, name: Hashable) -> int:
        """The atom of a quantity derived from states."""
        return self.derived.setdefault(
            name, 1 + len(self.numbers) + len(self.states) + len(self.derived)
        )

    def column(
        self,
        channel: int,
        shape: Shape,
        wave: int,
        factor: float,
        i: int,
        j: int = ONE,
        times: int = STEADY,
    ) -> None:
        """Add factor · z_i z_j · Φ(r) w_wave(ψ) w_times(ψ) to a channel."""
        shapes = self.shapes[channel]
        row = shapes.setdefault(shape, len(shapes))
        for product, share in times_wave(wave, times):
            if factor * share:
                self.columns.append((channel, row, product, i, j, factor * share))

    def measure(self, force: int, shape: Shape, wave: int) -> int:
        """Q_k: the mean of Σ Ψ w F Δr; of a finished structure one that it has."""
        weights = self.weights[force]
        if self.finished:
            return self.measures[force, weights[shape], wave]
        key = force, weights.setdefault(shape, len(weights)), wave
        return self.measures.setdefault(key, 1 + len(self.measures))

    def equation(self, name: Hashable) -> int:
        """The number of a new equation; ValueError for a name in use."""
        if name in self.equations:
            raise ValueError(f"There is already an equation {name!r}: give this one another name.")
        return self.equations.setdefault(name, len(self.equations))

    def term(
        self,
        equation: int,
        factor: float,
        i: int = ONE,
        j: int = ONE,
        q: int = 0,
        number: int = ONE,
    ) -> None:
        """Add factor · z_i z_j Q_q to an equation, times a number."""
        self.terms.append((equation, q, i, j, factor, number))

    def sum(self, name: str, terms: Sequence[Addend]) -> None:
        """Add a measure that is a sum of terms."""
        numbers = [term[4] if len(term) > 4 else ONE for term in terms]
        self.sums[name] = Terms.of(
            [(0, t[3], t[1], t[2], t[0], number) for t, number in zip(terms, numbers, strict=True)],
            1,
        )

    def finish(self, free: Sequence[int]) -> "Structure":
        """free: the atoms solved for, as many as there are equations, else ValueError."""
        if len(free) != len(self.equations):
            raise ValueError(
                f"{len(free)} states have {len(self.equations)} equations: give one equation for each state."
            )
        self.free = np.array(free, dtype=np.int64)
        highest = max(
            [0, *(column[2] for column in self.columns), *(key[2] for key in self.measures)]
        )
        self.waves, self.finished = highest + 1 + highest % 2, True
        fix(self.free)
        return self

    @property
    def given(self) -> int:
        """Length of the vector (1, numbers, states)."""
        return 1 + len(self.numbers) + len(self.states)

    @fixed_property
    def first_state(self) -> int:
        """The first state in `given`."""
        return 1 + len(self.numbers)

    @fixed_property
    def residual(self) -> Terms:
        """The terms of all equations."""
        return Terms.of(self.terms, len(self.equations))

    @fixed_property
    def kinds(self) -> tuple[list[Hashable], list[Hashable]]:
        """Kind of every equation and of every state solved for: the first word of its name, or the name."""
        by_atom = {atom: name for name, atom in self.states.items()}
        names = list(self.equations), [by_atom[atom] for atom in self.free.tolist()]
        equations, states = ([_kind_of(name) for name in kind] for kind in names)
        return equations, states

    def equations_of(self, kind: Hashable) -> Integers:
        """The equations of a kind."""
        return np.flatnonzero([name == kind for name in self.kinds[0]])

    def states_of(self, kind: Hashable) -> Integers:
        """Places of the states of a kind among those solved for."""
        return np.flatnonzero([name == kind for name in self.kinds[1]])

    @fixed_property
    def first_row(self) -> Integers:
        """Row of the first shape of each channel among all shapes, (channels + 1,)."""
        return np.cumsum([0, *(len(shapes) for shapes in self.shapes)])

    def rows_of(self, channel: int, names: Sequence[Shape]) -> Integers:
        """Rows of some shapes of a channel among all shapes."""
        shapes = self.shapes[channel]
        return self.first_row[channel] + np.array([shapes[name] for name in names], dtype=np.int64)

    @fixed_property
    def first_weight(self) -> Integers:
        """First measure of each force among all measures, (forces + 1,)."""
        return np.cumsum([0, *(len(weights) for weights in self.weights)])

    @fixed_property
    def column_arrays(self) -> tuple[Integers, Integers, Integers, Array]:
        """Wave coefficient, z_i, z_j and factor of each column, (columns,) each."""
        columns = np.array(self.columns, dtype=float).reshape(-1, 6)
        channel, row, wave, i, j = columns[:, :5].astype(np.int64).T
        return (self.first_row[channel] + row) * self.waves + wave, i, j, columns[:, 5].copy()

    @fixed_property
    def measure_places(self) -> Integers:
        """Place of each measure among all weights times all waves, (measures,)."""
        force, row, wave = self.measure_keys.T
        return (self.first_weight[force] + row) * self.waves + wave

    @fixed_property
    def measure_keys(self) -> Integers:
        """Force, number of the weight among its own, and wave of each measure, (measures, 3)."""
        return np.array(list(self.measures), dtype=np.int64).reshape(-1, 3)

    @fixed_property
    def _coefficients(self) -> tuple[Integers, Integers]:
        """The wave coefficients that columns have, and which of them each column adds to."""
        return np.unique(self.column_arrays[0], return_inverse=True)

    @fixed_property
    def by_atom(self) -> tuple[Integers, csr_matrix]:
        """∂(wave coefficients)/∂z by states and derived atoms, (atoms, coefficients).

        Where its values stand among the columns by their z_i, then by their z_j; the matrix, without its values.
        """
        _, column = self._coefficients
        _, i, j, _ = self.column_arrays
        atoms, column = np.concatenate([i, j]) - self.first_state, np.tile(column, 2)
        order = np.argsort(atoms, kind="stable")
        order = order[atoms[order] >= 0]
        first = np.searchsorted(
            atoms[order], np.arange(self.given + len(self.derived) - self.first_state + 1)
        )
        shape = len(first) - 1, len(self.coefficient_places)
        pattern = csr_matrix((np.zeros(len(order)), column[order], first), shape)
        fix((pattern.data, pattern.indices, pattern.indptr))
        return order, pattern

    @fixed_property
    def coefficient_places(self) -> Integers:
        """The wave coefficients that columns have, among all of all shapes."""
        return self._coefficients[0]

    def slope_rows(self, others: Collection[int] = (), further: Collection[int] = ()) -> Integers:
        """Row, force and channel of the section's derivatives of forces with measures and others, (rows, 3).

        Only those by channels that have columns, and further ones: the section may leave the others undefined.
        """
        key = frozenset(others), frozenset(further)
        if key not in self._slope_rows:
            used = [bool(weights) or o in others for o, weights in enumerate(self.weights)]
            rows = [
                (k, o, c)
                for k, (o, c) in enumerate(self.pairs)
                if used[o] and (self.shapes[c] or c in further)
            ]
            self._slope_rows[key] = np.array(rows, dtype=np.int64).reshape(-1, 3)
            fix(self._slope_rows[key])
        return self._slope_rows[key]

    @fixed_property
    def blocks(self) -> Blocks:
        """A block for every force with measures and channel with columns that change with the states."""
        number, factor = products(self.waves)
        row, wave = np.divmod(self._coefficients[0], self.waves)
        changing = np.zeros(len(row), dtype=np.bool_)
        _, first, second, _ = self.column_arrays
        changing[self._coefficients[1][np.maximum(first, second) >= self.first_state]] = True
        keys, arrays, places, factors = (
            self.measure_keys,
            list[list[int]](),
            list[Array](),
            list[Array](),
        )
        entries = 0
        for slope, (o, c) in enumerate(self.pairs):
            rows = np.flatnonzero(keys[:, 0] == o)
            mine = np.flatnonzero(
                (row >= self.first_row[c]) & (row < self.first_row[c + 1]) & changing
            )
            if not len(rows) or not len(mine):
                continue
            # Those that do not change come last.
            shapes = int(row[mine].max()) + 1 - int(self.first_row[c])
            pair = keys[rows, 1] * shapes + (row[mine] - self.first_row[c])[:, None]
            both = slice(None), keys[rows, 2][None, :], wave[mine][:, None]
            spectrum = 1 + 2 * int((keys[rows, 2].max() + 1) // 2 + (wave[mine].max() + 1) // 2)
            at = pair * spectrum + number[both]
            ends = np.broadcast_arrays(mine[:, None], 1 + rows[None, :])
            places.append(np.stack([*ends, *at]).reshape(4, -1))
            factors.append(factor[both].reshape(2, -1))
            begin = int(self.first_row[c])
            spans = [*self.first_weight[o : o + 2].tolist(), begin, begin + shapes]
            arrays.append([slope, *spans, spectrum, entries, entries + pair.size])
            entries += pair.size
        return Blocks(
            np.array(arrays, dtype=np.int64).reshape(-1, 8),
            np.concatenate([np.zeros((4, 0)), *places], axis=1).astype(np.int64),
            np.concatenate([np.zeros((2, 0)), *factors], axis=1),
        )
