"""Projection between fields on the disk and the terms of the dynamic wake, and the wake's answer between terms.

A state is a mode φ_n^m(r) cos mψ or sin mψ times one of the blade harmonics 1, cos qψ, sin qψ, q = N_b, 2N_b, …, the
harmonics of N_b identical blades in the fixed frame. As a product of two waves it is a sum of two, with the wave
numbers |m ± q|, and φ_n^m is a sum of g_k(r), k = m, m + 2, … (see `peters_he.CommonBasis`). So the shapes of the
states are sums of far fewer terms g_k(r) cos pψ and g_k(r) sin pψ: order 8 with two blade harmonics has 225 states,
and 113 terms. A load acts on the wake through its sums with the terms alone, and the inflow is a sum of them.

Even waves are the same at ψ and ψ + π, odd ones change sign. So fields are folded into their sums and differences half
a turn apart, and each half meets half of the waves on half of the disk; with an even number of blades also half of the
g_k, because k + p is then even in every term.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from rotor.aero.inflow.interface import HarmonicShapes
from rotor.aero.inflow.peters_he import (
    CommonBasis,
    FlowParameters,
    answer,
    answer_slopes,
    blocks,
    common_basis,
    highest_modes,
    influences,
    powers_of_skew,
    radial_functions,
)  # fmt: skip
from rotor.arrays import Array, Integers
from rotor.compiled import compiled

Halves = tuple[Array, Array]
"""Arrays of the even and of the odd functions."""


@dataclass(frozen=True, eq=False)
class Projection:
    """Terms ↔ fields on one grid. Terms are ordered by p, cosines before sines, then by k."""

    r: Array
    """Element centres, (elements,)."""
    azimuths: int
    order: Integers
    """k of each term, (terms,)."""
    wave: Integers
    """p of each term, (terms,)."""
    parity: Integers
    """0 for a cosine, 1 for a sine, (terms,)."""
    table: Integers
    """Index of a term by k, p and whether a sine, (S + 1, waves, 2); for sin 0 that of cos 0."""
    groups: Integers
    """Where the terms of one wave begin, (groups + 1,)."""
    cell: float
    """Δr/N_ψ, by which a sum over the grid becomes ⟨∫ … dr⟩."""
    basis: CommonBasis
    harmonics: Array
    """q = N_b, 2N_b, … [per revolution]."""
    radial: Array
    """g_k, (S + 1, elements)."""
    parts: Halves
    """Those of the even waves, and those of the odd."""
    waves: Halves
    """cos pψ, then sin pψ, p = 0 … S + q_max, over half of the azimuths: (waves, azimuths/2) each."""
    place: Integers
    """Place of each term among all g_k with all waves of the even, then of the odd half, (terms,)."""
    pairs: Halves
    """g_i g_j Δr for i ≥ j that products of terms with even and with odd waves hold, (pairs, elements) each."""
    pair: Integers
    """Place of each pair among them, (2, S + 1, S + 1)."""
    spectrum: Halves
    """As `waves`, p = 0 … 2(S + q_max), over N_ψ."""
    no_factor: tuple[Array, Array]
    """F = 1 and its slope, (elements,) both, for a wake that holds the tip itself."""

    @property
    def terms(self) -> int:
        return len(self.order)

    def sums(self, fields: Array) -> Array:
        """Σ over the grid of a field times every term, (…, elements, azimuths) → (…, terms)."""
        stack = np.ascontiguousarray(fields).reshape(-1, *fields.shape[-2:])
        return _sums(stack, *self.parts, *self.waves, self.place).reshape(*fields.shape[:-2], -1)

    def field(self, coefficients: Array) -> Array:
        """The sum of the terms, (…, terms) → (…, elements, azimuths)."""
        stack = np.ascontiguousarray(coefficients).reshape(-1, self.terms)
        out = _field(stack, *self.parts, *self.waves, self.place, self.azimuths)
        return out.reshape(*coefficients.shape[:-1], *out.shape[-2:])

    def nearest(self, field: Array) -> Array:
        """Coefficients of the sum of the terms that is nearest to a field in the mean square, (terms,).

        With an odd number of blades some terms depend on others but for rounding: the part of a field that only their
        difference could hold, 1e-4 of it, is left out.
        """
        return self._to_nearest @ self.sums(field)

    @cached_property
    def _to_nearest(self) -> Array:
        """Pseudo-inverse of Σ over the grid of term · term."""
        products = self.reduced(np.ones((len(self.r), self.azimuths)))
        return np.asarray(np.linalg.pinv(products, rcond=1e-10, hermitian=True), dtype=np.float64)

    @cached_property
    def _peaks(self) -> Array:
        """Largest size of each term on the grid, (terms,)."""
        return np.abs(self.radial).max(axis=1)[self.order]

    def bound(self, coefficients: Array) -> float:
        """What the sum of the terms does not exceed anywhere."""
        return float(self._peaks @ np.abs(coefficients))

    @cached_property
    def radial_columns(self) -> Array:
        """`radial` with an element in every row, (elements, S + 1)."""
        return self.radial.T.copy()

    @cached_property
    def all_waves(self) -> Array:
        """cos pψ, then sin pψ, p = 0 … S + q_max, over all azimuths, (waves, azimuths)."""
        waves = np.arange(int(self.wave.max()) + 1)
        phase = np.outer(waves, 2.0 * np.pi * np.arange(self.azimuths) / self.azimuths)
        return np.concatenate([np.cos(phase), np.sin(phase)])

    @cached_property
    def terms_by_shape(self) -> tuple[Integers, Integers, Integers]:
        """`begin`, `term` and `wave` of `ResponseTerms`, waves as in `all_waves`."""
        begin, term, wave = [0], list[int](), list[int]()
        row = self.wave + self.parity * (len(self.all_waves) // 2)
        for k in range(len(self.radial)):
            own = np.flatnonzero(self.order == k)
            padding = [self.terms] * (-len(own) % 4)
            term += [*own.tolist(), *padding]
            wave += [*row[own].tolist(), *([0] * len(padding))]
            begin.append(len(term))
        return np.array(begin, dtype=np.int64), np.array(term, dtype=np.int64), np.array(wave, dtype=np.int64)

    def reduced(self, slope: Array) -> Array:
        """Σ over the grid of term · K · term for a pointwise slope K(r, ψ), (terms, terms).

        A product of two waves is a sum of two, so K enters by its Fourier coefficients alone: sums over r for every
        pair of g, then a look-up for every pair of terms.
        """
        return _reduced(
            np.ascontiguousarray(slope), *self.pairs, self.pair, *self.spectrum, self.groups, self.order, self.wave,
            self.parity, 1.0 / self.cell,
        )  # fmt: skip

    def against(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """Σ over the grid of term · slope · column of `shapes`, (terms, columns), computed as `reduced`."""
        return _against(
            np.ascontiguousarray(slope), self.radial, shapes.radial * shapes.dr, *self.spectrum, self.order,
            self.wave, self.parity, shapes.wave, shapes.parity, 1.0 / self.cell,
        )  # fmt: skip

    def answer(self, sums: Array, flow: FlowParameters) -> Array:
        """The wake's answer to the sums of a load: coefficients of the inflow, (terms,)."""
        basis = self.basis
        return _answer(
            sums, (flow.half_skew, flow.speed, flow.mass_flow), basis.gain, basis.driven, basis.uniform, basis.m,
            basis.order, basis.steady, self.harmonics, self.table, self.cell,
        )  # fmt: skip

    def blocks(self, flow: FlowParameters) -> tuple[Array, Array]:
        """Those of cosines and sines, see `peters_he.blocks`."""
        basis = self.basis
        return _blocks(
            (flow.half_skew, flow.speed, flow.mass_flow), basis.gain, basis.driven, basis.uniform, basis.m,
            basis.steady, self.harmonics,
        )  # fmt: skip

    def transfer(self, made: tuple[Array, Array]) -> Array:
        """From sums of the load with the terms to coefficients of the inflow, (terms, terms), from the blocks."""
        basis = self.basis
        return _between(
            *made, basis.m, basis.order, basis.steady, self.harmonics, self.table, self.cell, self.terms
        )  # fmt: skip

    def answer_slopes(self, sums: Array, flow: FlowParameters, made: tuple[Array, Array]) -> Array:
        """∂ of `answer` by X, V_T and V̄, (3, terms)."""
        basis = self.basis
        return _slopes(
            sums, *made, (flow.half_skew, flow.speed, flow.mass_flow), basis.gain, basis.driven, basis.mass,
            basis.uniform, basis.m, basis.order, basis.steady, self.harmonics, self.table, self.cell,
        )  # fmt: skip


_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def _fold(field: Any, half: int, even: Any, odd: Any) -> None:
    """Sum and difference of a field and itself half a turn on, (elements, azimuths/2) both.

    Where the azimuths are odd in number there is no half turn: all azimuths then stand in both.
    """
    elements, azimuths = field.shape
    for i in range(elements):
        if half == azimuths:
            for j in range(half):
                even[i, j] = odd[i, j] = field[i, j]
        else:
            for j in range(half):
                even[i, j] = field[i, j] + field[i, half + j]
                odd[i, j] = field[i, j] - field[i, half + j]


@_compile
def _sums(fields: Any, radial: Any, odd_radial: Any, waves: Any, odd_waves: Any, place: Any) -> Any:
    """`Projection.sums` of a stack."""
    half, size = waves.shape[1], len(radial) * len(waves)
    even, odd = np.empty((fields.shape[1], half)), np.empty((fields.shape[1], half))
    spectrum = np.empty(size + len(odd_radial) * len(odd_waves))
    out = np.empty((len(fields), len(place)))
    for n in range(len(fields)):
        _fold(fields[n], half, even, odd)
        np.dot(radial @ even, waves.T, spectrum[:size].reshape(len(radial), len(waves)))
        np.dot(odd_radial @ odd, odd_waves.T, spectrum[size:].reshape(len(odd_radial), len(odd_waves)))
        for t in range(len(place)):
            out[n, t] = spectrum[place[t]]
    return out


@_compile
def _field(
    coefficients: Any, radial: Any, odd_radial: Any, waves: Any, odd_waves: Any, place: Any, azimuths: int
) -> Any:  # fmt: skip
    """`Projection.field` of a stack."""
    half, size = waves.shape[1], len(radial) * len(waves)
    spectrum = np.zeros(size + len(odd_radial) * len(odd_waves))
    out = np.empty((len(coefficients), radial.shape[1], azimuths))
    for n in range(len(coefficients)):
        for t in range(len(place)):
            spectrum[place[t]] = coefficients[n, t]
        even = radial.T @ (spectrum[:size].reshape(len(radial), len(waves)) @ waves)
        odd = odd_radial.T @ (spectrum[size:].reshape(len(odd_radial), len(odd_waves)) @ odd_waves)
        for i in range(len(even)):
            for j in range(half):
                out[n, i, j] = even[i, j] + odd[i, j]
            for j in range(azimuths - half):
                out[n, i, half + j] = even[i, j] - odd[i, j]
    return out


@_compile
def _product_of_waves(p: int, p_sine: int, s: int, s_sine: int) -> tuple[int, int, float, float]:
    """Wave p times wave s as ±½ wave |p − s| ± ½ wave p + s: numbers of both, factors of both.

    cos p cos s and sin p sin s are ½[cos(p − s) ± cos(p + s)]; sin p cos s is ½[sin(p + s) + sin(p − s)].
    """
    if p_sine == s_sine:
        return abs(p - s), p + s, 0.5, -0.5 if p_sine else 0.5
    difference = p - s if p_sine else s - p
    return abs(difference), p + s, 0.5 if difference >= 0 else -0.5, 0.5


@_compile
def _reduced(
    slope: Any, pairs: Any, odd_pairs: Any, pair: Any, waves: Any, odd_waves: Any, groups: Any, order: Any, wave: Any,
    parity: Any, factor: float,
) -> Any:  # fmt: skip
    """`Projection.reduced`, symmetric, wave by wave."""
    half, n = waves.shape[1], len(order)
    even, odd = np.empty((len(slope), half)), np.empty((len(slope), half))
    _fold(slope, half, even, odd)
    # (waves, pairs): the pairs of one wave lie side by side.
    spectrum, odd_spectrum = waves @ (pairs @ even).T, odd_waves @ (odd_pairs @ odd).T
    out = np.empty((n, n))
    for first in range(len(groups) - 1):
        p, p_sine = wave[groups[first]], parity[groups[first]]
        for second in range(first + 1):
            s, s_sine = wave[groups[second]], parity[groups[second]]
            near, far, by_near, by_far = _product_of_waves(p, p_sine, s, s_sine)
            rows, places = (spectrum, pair[0]) if near % 2 == 0 else (odd_spectrum, pair[1])
            shift = 0 if p_sine == s_sine else len(rows) // 2
            near_row, far_row = rows[shift + near // 2], rows[shift + far // 2]
            by_near, by_far = factor * by_near, factor * by_far
            for a in range(groups[first], groups[first + 1]):
                own = places[order[a]]
                for b in range(groups[second], groups[second + 1]):
                    k = own[order[b]]
                    out[a, b] = by_near * near_row[k] + by_far * far_row[k]
    for a in range(n):
        for b in range(a):
            out[b, a] = out[a, b]
    return out


@_compile
def _against(
    slope: Any, radial: Any, shapes: Any, waves: Any, odd_waves: Any, order: Any, wave: Any,
    parity: Any, own_wave: Any, own_parity: Any, factor: float,
) -> Any:  # fmt: skip
    """The matrix of `Projection.against`, (terms, shapes × harmonics)."""
    half, count, functions = waves.shape[1], len(shapes), len(own_wave)
    even, odd = np.empty((len(slope), half)), np.empty((len(slope), half))
    _fold(slope, half, even, odd)
    pairs = np.empty((len(radial), count, len(slope)))
    for k in range(len(radial)):
        for c in range(count):
            for i in range(len(slope)):
                pairs[k, c, i] = radial[k, i] * shapes[c, i]
    flat = pairs.reshape(-1, len(slope))
    spectrum, odd_spectrum = (flat @ even) @ waves.T, (flat @ odd) @ odd_waves.T
    out = np.empty((len(order), count * functions))
    for a in range(len(order)):
        for h in range(functions):
            near, far, by_near, by_far = _product_of_waves(wave[a], parity[a], own_wave[h], own_parity[h])
            rows = spectrum if near % 2 == 0 else odd_spectrum
            shift = 0 if parity[a] == own_parity[h] else rows.shape[1] // 2
            for c in range(count):
                row = rows[order[a] * count + c]
                out[a, c * functions + h] = factor * (by_near * row[shift + near // 2] + by_far * row[shift + far // 2])
    return out


# Between terms and amplitudes of a family in the common basis, as in `peters_he`. With D(p) = Σ d g exp −ipψ, cos mψ
# has the load ½[D(q − m) + D(q + m)] and sin mψ has −½i[D(q − m) − D(q + m)]; the amplitude a of cos mψ adds
# g Re a exp ipψ for p = q ± m to the inflow, that of sin mψ adds ∓i a in place of a.


@_compile
def _loads(sums: Any, sign: float, m: Any, order: Any, harmonics: Any, table: Any, cell: float) -> Any:
    """Loads τ on a family, half of them for m = 0, (modes, 1 + 2k)."""
    out = np.empty((len(m), 1 + 2 * len(harmonics)))
    for i in range(len(m)):
        weight = cell * (0.5 if m[i] == 0 else 1.0)
        out[i, 0] = weight * sums[table[order[i], m[i], 0 if sign > 0.0 else 1]]
        for k in range(len(harmonics)):
            near, far = int(harmonics[k]) - m[i], int(harmonics[k]) + m[i]
            near_terms, far_terms = table[order[i], abs(near)], table[order[i], far]
            near_real, near_imaginary = sums[near_terms[0]], -np.sign(near) * sums[near_terms[1]]
            far_real, far_imaginary = sums[far_terms[0]], -sums[far_terms[1]]
            if sign > 0.0:
                out[i, 1 + 2 * k] = 0.5 * weight * (near_real + far_real)
                out[i, 2 + 2 * k] = 0.5 * weight * (near_imaginary + far_imaginary)
            else:
                out[i, 1 + 2 * k] = 0.5 * weight * (near_imaginary - far_imaginary)
                out[i, 2 + 2 * k] = -0.5 * weight * (near_real - far_real)
    return out


@_compile
def _add(out: Any, amplitudes: Any, sign: float, m: Any, order: Any, harmonics: Any, table: Any) -> None:
    """Add the terms of a family's amplitudes, (modes, 1 + 2k), to coefficients."""
    for i in range(len(m)):
        out[table[order[i], m[i], 0 if sign > 0.0 else 1]] += amplitudes[i, 0]
        for k in range(len(harmonics)):
            near, far = int(harmonics[k]) - m[i], int(harmonics[k]) + m[i]
            near_terms, far_terms = table[order[i], abs(near)], table[order[i], far]
            real, imaginary = amplitudes[i, 1 + 2 * k], amplitudes[i, 2 + 2 * k]
            if sign > 0.0:
                out[near_terms[0]] += real
                out[far_terms[0]] += real
                out[near_terms[1]] -= np.sign(near) * imaginary
                out[far_terms[1]] -= imaginary
            else:
                out[near_terms[0]] -= imaginary
                out[far_terms[0]] += imaginary
                out[near_terms[1]] -= np.sign(near) * real
                out[far_terms[1]] += real


@_compile
def _answer(
    sums: Any, flow: Any, gain: Any, driven: Any, uniform: Any, m: Any, order: Any, steady: int, harmonics: Any,
    table: Any, cell: float,
) -> Any:  # fmt: skip
    """`Projection.answer`: both families, one after the other."""
    out, powers = np.zeros(len(sums)), powers_of_skew(flow[0], 2 * m[-1])[0]
    for first, sign in ((0, 1.0), (steady, -1.0)):
        own, k = m[first:], order[first:]
        influence = influences(gain[first:, first:], driven[first:, first:], own, sign, powers)
        loads = _loads(sums, sign, own, k, harmonics, table, cell)
        found = answer(influence[0], influence[1], flow, uniform[:, first:].copy(), harmonics, loads)
        _add(out, found, sign, own, k, harmonics, table)
    return out


@_compile
def _blocks(flow: Any, gain: Any, driven: Any, uniform: Any, m: Any, steady: int, harmonics: Any) -> Any:
    """`Projection.blocks`."""
    powers = powers_of_skew(flow[0], 2 * m[-1])[0]
    cosines = influences(gain, driven, m, 1.0, powers)
    sines = influences(gain[steady:, steady:], driven[steady:, steady:], m[steady:], -1.0, powers)
    return (
        blocks(cosines[0], cosines[1], flow, uniform, harmonics),
        blocks(sines[0], sines[1], flow, uniform[:, steady:].copy(), harmonics),
    )


@_compile
def _slopes(
    sums: Any, cosines: Any, sines: Any, flow: Any, gain: Any, driven: Any, mass: Any, uniform: Any, m: Any, order: Any,
    steady: int, harmonics: Any, table: Any, cell: float,
) -> Any:  # fmt: skip
    """`Projection.answer_slopes`."""
    out, powers = np.zeros((3, len(sums))), powers_of_skew(flow[0], 2 * m[-1])[1]
    for first, sign in ((0, 1.0), (steady, -1.0)):
        own, k = m[first:], order[first:]
        slopes = influences(gain[first:, first:], driven[first:, first:], own, sign, powers)
        loads = _loads(sums, sign, own, k, harmonics, table, cell)
        found = answer_slopes(
            cosines if sign > 0.0 else sines, slopes, mass[first:, first:].copy(), flow, uniform[:, first:].copy(),
            harmonics, loads,
        )  # fmt: skip
        for row in range(3):
            _add(out[row], found[row], sign, own, k, harmonics, table)
    return out


@_compile
def _between(
    cosines: Any, sines: Any, m: Any, order: Any, steady: int, harmonics: Any, table: Any, cell: float, terms: int
) -> Any:  # fmt: skip
    """`Projection.transfer`. Between D(q ± m) of a load and q ± m of the inflow stands half of the blocks of the
    cosines plus those of the sines where both signs are the same, minus them where not."""
    out = np.zeros((terms, terms))
    modes = len(m)
    for j in range(modes):
        weight = cell * (0.5 if m[j] == 0 else 1.0)
        for i in range(modes):
            out[table[order[i], m[i], 0], table[order[j], m[j], 0]] += weight * cosines[0, j, i]
            if i >= steady and j >= steady:
                out[table[order[i], m[i], 1], table[order[j], m[j], 1]] += weight * sines[0, j - steady, i - steady]
    rows, turns = np.empty((2, modes, 2), np.int64), np.empty((2, modes))
    for k in range(len(harmonics)):
        for side in range(2):
            for i in range(modes):
                p = int(harmonics[k]) + (m[i] if side == 0 else -m[i])
                turns[side, i] = np.sign(p)
                rows[side, i] = table[order[i], abs(p)]
        for j in range(modes):
            weight = 0.5 * cell * (0.5 if m[j] == 0 else 1.0)
            for i in range(modes):
                real, imaginary = weight * cosines[1 + 2 * k, j, i], weight * cosines[2 + 2 * k, j, i]
                sine_real, sine_imaginary = 0.0, 0.0
                if i >= steady and j >= steady:
                    sine_real = weight * sines[1 + 2 * k, j - steady, i - steady]
                    sine_imaginary = weight * sines[2 + 2 * k, j - steady, i - steady]
                for side in range(2):
                    row, sine_row, turn = rows[side, i, 0], rows[side, i, 1], turns[side, i]
                    for other in range(2):
                        column, sine_column, back = rows[other, j, 0], rows[other, j, 1], turns[other, j]
                        add_real = real + sine_real if side == other else real - sine_real
                        add_imaginary = imaginary + sine_imaginary if side == other else imaginary - sine_imaginary
                        out[row, column] += add_real
                        out[sine_row, sine_column] += turn * back * add_real
                        out[row, sine_column] += back * add_imaginary
                        out[sine_row, column] -= turn * add_imaginary
    return out


@lru_cache(maxsize=32)
def build_projection(order: int, blades: int, harmonics: int, root: float, elements: int, azimuths: int) -> Projection:
    """The projection of an order S with `harmonics` multiples of the blade number on the grid of `rotor.aero.disk`.

    Elements are equally wide from `root` to 1 and summed by the midpoint rule, azimuths evenly spaced.
    """
    multiples = [k * blades for k in range(1, harmonics + 1)]
    highest = order + (multiples[-1] if multiples else 0)
    if azimuths <= 2 * highest:
        raise ValueError(
            f"{azimuths} azimuths cannot resolve the wake's {highest} waves per revolution: use more than {2 * highest}"
        )
    dr = (1.0 - root) / elements
    r = np.linspace(root + 0.5 * dr, 1.0 - 0.5 * dr, elements)
    half = azimuths // 2 if azimuths % 2 == 0 else azimuths
    basis = common_basis(order)

    terms = np.array(sorted(_terms(basis, multiples)), dtype=np.int64)
    by_term: Integers = terms.T.copy()
    wave, parity, k = by_term[0], by_term[1], by_term[2]
    table = np.zeros((order + 1, highest + 1, 2), dtype=np.int64)
    table[k, wave, parity] = np.arange(len(terms))
    table[:, 0, 1] = table[:, 0, 0]
    begins = np.flatnonzero(np.diff(2 * wave + parity, prepend=-1))

    radial, psi = radial_functions(highest_modes(order), r), 2.0 * np.pi * np.arange(half) / azimuths
    phase = np.outer(np.arange(2 * highest + 1), psi)
    both = [(np.cos(phase[first::2]), np.sin(phase[first::2])) for first in (0, 1)]
    counts = [len(range(first, highest + 1, 2)) for first in (0, 1)]
    waves = [np.concatenate([part[:count] for part in parts]) for parts, count in zip(both, counts, strict=True)]
    odd = wave % 2
    # The g_k of each half, the places of k among them, and those of the terms among all products with its waves.
    used: list[Integers] = [np.flatnonzero(np.bincount(k[odd == half_of])) for half_of in (0, 1)]
    rank: Integers = np.array([int(np.searchsorted(used[int(p) % 2], int(i))) for p, i in zip(wave, k, strict=True)])
    across = np.array([len(part) for part in waves])
    place = rank * across[odd] + wave // 2 + parity * across[odd] // 2 + odd * len(used[0]) * across[0]
    rows, columns = np.tril_indices(order + 1)
    pair = np.zeros((2, order + 1, order + 1), dtype=np.int64)
    pairs: list[Array] = []
    for odd_pair in (0, 1):
        chosen = (rows + columns) % 2 == odd_pair if blades % 2 == 0 else rows >= columns
        i, j = rows[chosen], columns[chosen]
        pair[odd_pair, i, j] = pair[odd_pair, j, i] = np.arange(len(i))
        pairs.append(radial[i] * radial[j] * dr)
    return Projection(
        r=r,
        azimuths=azimuths,
        order=k,
        wave=wave,
        parity=parity,
        table=table,
        groups=np.append(begins, len(terms)),
        cell=dr / azimuths,
        basis=basis,
        harmonics=np.array(multiples, dtype=np.float64),
        radial=radial,
        parts=(radial[used[0]], radial[used[1]]),
        waves=(waves[0], waves[1]),
        place=place,
        pairs=(pairs[0], pairs[1]),
        pair=pair,
        spectrum=(np.concatenate(both[0]) / azimuths, np.concatenate(both[1]) / azimuths),
        no_factor=(np.ones_like(r), np.zeros_like(r)),
    )


def _terms(basis: CommonBasis, multiples: list[int]) -> set[tuple[int, int, int]]:
    """(p, whether a sine, k) of all terms."""
    terms: set[tuple[int, int, int]] = set()
    for m, k in zip(basis.m.tolist(), basis.order.tolist(), strict=True):
        for p in {m, *(abs(q + shift) for q in multiples for shift in (-m, m))}:
            terms |= {(p, sine, k) for sine in ((0, 1) if p else (0,))}  # sin 0 is none.
    return terms
