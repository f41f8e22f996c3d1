"""The terms of the dynamic wake: the functions of which its inflow is a sum, and its answer between them.

A state is a mode φ_n^m(r) cos mψ or sin mψ times one of the blade harmonics 1, cos qψ, sin qψ, q = N_b, 2N_b, …, the
harmonics of N_b identical blades in the fixed frame. As a product of two waves it is a sum of two, with the wave
numbers |m ± q|, and φ_n^m is a sum of g_k(r), k = m, m + 2, … (see `peters_he.CommonBasis`). So the shapes of the
states are sums of far fewer terms g_k(r) cos pψ and g_k(r) sin pψ: order 8 with two blade harmonics has 225 states,
and 113 terms. A load acts on the wake through its means with the terms alone, and the inflow is a sum of them.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

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
from rotor.engine.waves import wave_number, waves_at


class _Basis(NamedTuple):
    """A `CommonBasis` with its terms, for compiled code."""

    gain: Array
    driven: Array
    mass: Array
    uniform: Array
    m: Integers
    order: Integers
    steady: int
    harmonics: Array
    """q = N_b, 2N_b, … [per revolution]."""
    table: Integers
    """Index of a term by k, p and whether a sine, (S + 1, waves, 2); for sin 0 that of cos 0."""


@dataclass(frozen=True, eq=False)
class Projection:
    """The terms along a blade. They are ordered by p, cosines before sines, then by k."""

    r: Array
    """Element centres, (elements,)."""
    dr: float
    order: Integers
    """k of each term, (terms,)."""
    wave: Integers
    """p of each term, (terms,)."""
    parity: Integers
    """0 for a cosine, 1 for a sine, (terms,)."""
    basis: _Basis
    radial: Array
    """g_k, (S + 1, elements)."""

    @property
    def terms(self) -> int:
        return len(self.order)

    @cached_property
    def waves(self) -> Integers:
        """The wave of each term as the engine numbers them, (terms,)."""
        pairs = zip(self.wave.tolist(), self.parity.tolist(), strict=True)
        return np.array([wave_number(p, sine=bool(sine)) for p, sine in pairs], dtype=np.int64)

    def at(self, psi: Array) -> Array:
        """The terms at azimuths [rad], (terms, elements, azimuths)."""
        waves = waves_at(1 + 2 * int(self.wave.max()), psi)
        return self.radial[self.order][:, :, None] * waves[self.waves][:, None, :]

    def nearest(self, field: Array) -> Array:
        """Coefficients of the sum of the terms that is nearest to a field in the mean square, (terms,).

        With an odd number of blades some terms depend on others but for rounding: the part of a field that only their
        difference could hold, 1e-4 of it, is left out. Waves are orthogonal, so every wave is fitted by itself.
        """
        azimuths: int = field.shape[1]
        psi = 2.0 * np.pi * np.arange(azimuths) / azimuths
        means = field @ waves_at(1 + 2 * int(self.wave.max()), psi).T / azimuths
        out = np.zeros(self.terms)
        for wave, fit in self._fits.items():
            out[self.waves == wave] = fit @ means[:, wave]
        return out

    @cached_property
    def _fits(self) -> dict[int, Array]:
        """Pseudo-inverse of the shapes of each wave, over the mean square of the wave, (shapes, elements)."""
        out = dict[int, Array]()
        for wave in sorted(set(self.waves.tolist())):
            shapes = self.radial[self.order[self.waves == wave]]
            out[wave] = np.asarray(np.linalg.pinv(shapes.T, rcond=1e-5), np.float64) * (1.0 if wave == 0 else 2.0)
        return out

    @cached_property
    def peaks(self) -> Array:
        """Largest size of each term on the blade, (terms,)."""
        return np.abs(self.radial).max(axis=1)[self.order]

    def answer(self, means: Array, flow: FlowParameters) -> Array:
        """The wake's answer to the means ⟨∫ term d dr⟩ of a load: coefficients of the inflow, (terms,)."""
        return _answer(means, (flow.half_skew, flow.speed, flow.mass_flow), self.basis)

    def blocks(self, flow: FlowParameters) -> tuple[Array, Array]:
        """Those of cosines and sines, see `peters_he.blocks`."""
        return _blocks((flow.half_skew, flow.speed, flow.mass_flow), self.basis)

    def transfer(self, made: tuple[Array, Array]) -> Array:
        """From means of the load with the terms to coefficients of the inflow, (terms, terms), from the blocks."""
        return _between(*made, self.basis, self.terms)

    def answer_slopes(self, means: Array, flow: FlowParameters, made: tuple[Array, Array]) -> Array:
        """∂ of `answer` by X, V_T and V̄, (3, terms)."""
        return _slopes(means, made, (flow.half_skew, flow.speed, flow.mass_flow), self.basis)


_compile = compiled(error_model="numpy", fastmath={"contract"})


# Between terms and amplitudes of a family in the common basis, as in `peters_he`. With D(p) = Σ d g exp −ipψ, cos mψ
# has the load ½[D(q − m) + D(q + m)] and sin mψ has −½i[D(q − m) − D(q + m)]; the amplitude a of cos mψ adds
# g Re a exp ipψ for p = q ± m to the inflow, that of sin mψ adds ∓i a in place of a.


@_compile
def _loads(sums: Any, sign: float, m: Any, order: Any, harmonics: Any, table: Any) -> Any:
    """Loads τ on a family, half of them for m = 0, (modes, 1 + 2k)."""
    out = np.empty((len(m), 1 + 2 * len(harmonics)))
    for i in range(len(m)):
        weight = 0.5 if m[i] == 0 else 1.0
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
def _answer(means: Any, flow: Any, basis: Any) -> Any:
    """`Projection.answer`: both families, one after the other."""
    out, powers = np.zeros(len(means)), powers_of_skew(flow[0], 2 * basis.m[-1])[0]
    for first, sign in ((0, 1.0), (basis.steady, -1.0)):
        own, k, uniform = basis.m[first:], basis.order[first:], basis.uniform[:, first:].copy()
        influence = influences(basis.gain[first:, first:], basis.driven[first:, first:], own, sign, powers)
        loads = _loads(means, sign, own, k, basis.harmonics, basis.table)
        found = answer(influence[0], influence[1], flow, uniform, basis.harmonics, loads)
        _add(out, found, sign, own, k, basis.harmonics, basis.table)
    return out


@_compile
def _blocks(flow: Any, basis: Any) -> Any:
    """`Projection.blocks`."""
    powers, steady, m = powers_of_skew(flow[0], 2 * basis.m[-1])[0], basis.steady, basis.m
    cosines = influences(basis.gain, basis.driven, m, 1.0, powers)
    sines = influences(basis.gain[steady:, steady:], basis.driven[steady:, steady:], m[steady:], -1.0, powers)
    return (
        blocks(cosines[0], cosines[1], flow, basis.uniform, basis.harmonics),
        blocks(sines[0], sines[1], flow, basis.uniform[:, steady:].copy(), basis.harmonics),
    )


@_compile
def _slopes(means: Any, made: Any, flow: Any, basis: Any) -> Any:
    """`Projection.answer_slopes`."""
    out, powers = np.zeros((3, len(means))), powers_of_skew(flow[0], 2 * basis.m[-1])[1]
    for first, sign in ((0, 1.0), (basis.steady, -1.0)):
        own, k, uniform = basis.m[first:], basis.order[first:], basis.uniform[:, first:].copy()
        slopes = influences(basis.gain[first:, first:], basis.driven[first:, first:], own, sign, powers)
        loads = _loads(means, sign, own, k, basis.harmonics, basis.table)
        mass = basis.mass[first:, first:].copy()
        found = answer_slopes(
            made[0] if sign > 0.0 else made[1], slopes, mass, flow, uniform, basis.harmonics, loads
        )  # fmt: skip
        for row in range(3):
            _add(out[row], found[row], sign, own, k, basis.harmonics, basis.table)
    return out


@_compile
def _between(cosines: Any, sines: Any, basis: Any, terms: int) -> Any:
    """`Projection.transfer`."""
    out, m, order, table, steady = np.zeros((terms, terms)), basis.m, basis.order, basis.table, basis.steady
    for j in range(len(m)):
        weight = 0.5 if m[j] == 0 else 1.0
        for i in range(len(m)):
            out[table[order[i], m[i], 0], table[order[j], m[j], 0]] += weight * cosines[0, j, i]
            if i >= steady and j >= steady:
                out[table[order[i], m[i], 1], table[order[j], m[j], 1]] += weight * sines[0, j - steady, i - steady]
    for k in range(len(basis.harmonics)):
        _between_harmonic(cosines[1 + 2 * k : 3 + 2 * k], sines[1 + 2 * k : 3 + 2 * k], basis, k, out)
    return out


@_compile
def _between_harmonic(cosines: Any, sines: Any, basis: Any, k: int, out: Any) -> None:
    """Add the part of one blade harmonic q.

    Between D(q ± m) of a load and q ± m of the inflow stands half of the blocks of the cosines plus those of the sines
    where both signs are the same, minus them where not.
    """
    m, order, table, steady, modes = basis.m, basis.order, basis.table, basis.steady, len(basis.m)
    rows, turns = np.empty((2, modes, 2), np.int64), np.empty((2, modes))
    for side in range(2):
        for i in range(modes):
            p = int(basis.harmonics[k]) + (m[i] if side == 0 else -m[i])
            turns[side, i] = np.sign(p)
            rows[side, i] = table[order[i], abs(p)]
    for j in range(modes):
        weight = 0.5 * (0.5 if m[j] == 0 else 1.0)
        for i in range(modes):
            real, imaginary = weight * cosines[0, j, i], weight * cosines[1, j, i]
            sine_real, sine_imaginary = 0.0, 0.0
            if i >= steady and j >= steady:
                sine_real = weight * sines[0, j - steady, i - steady]
                sine_imaginary = weight * sines[1, j - steady, i - steady]
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


@lru_cache(maxsize=32)
def build_projection(order: int, blades: int, harmonics: int, root: float, elements: int) -> Projection:
    """The projection of an order S with `harmonics` multiples of the blade number on the elements of `rotor.aero.disk`.

    Elements are equally wide from `root` to 1 and summed by the midpoint rule.
    """
    multiples = [k * blades for k in range(1, harmonics + 1)]
    highest = order + (multiples[-1] if multiples else 0)
    dr = (1.0 - root) / elements
    r = np.linspace(root + 0.5 * dr, 1.0 - 0.5 * dr, elements)
    basis = common_basis(order)
    wave, parity, k = np.array(sorted(_terms(basis, multiples)), dtype=np.int64).T.copy()
    table = np.zeros((order + 1, highest + 1, 2), dtype=np.int64)
    table[k, wave, parity] = np.arange(len(k))
    table[:, 0, 1] = table[:, 0, 0]
    arrays = _Basis(
        basis.gain, basis.driven, basis.mass, basis.uniform, basis.m, basis.order, basis.steady,
        np.array(multiples, dtype=np.float64), table,
    )  # fmt: skip
    return Projection(r, dr, k, wave, parity, arrays, radial_functions(highest_modes(order), r))


def _terms(basis: CommonBasis, multiples: list[int]) -> set[tuple[int, int, int]]:
    """(p, whether a sine, k) of all terms."""
    terms: set[tuple[int, int, int]] = set()
    for m, k in zip(basis.m.tolist(), basis.order.tolist(), strict=True):
        for p in {m, *(abs(q + shift) for q in multiples for shift in (-m, m))}:
            terms |= {(p, sine, k) for sine in ((0, 1) if p else (0,))}  # sin 0 is none.
    return terms
