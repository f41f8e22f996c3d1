"""Projection between fields on the disk and the states of the dynamic wake.

A state is a mode φ_n^m(r) cos mψ or sin mψ times one of the blade harmonics 1, cos qψ, sin qψ, q = N_b, 2N_b, …, the
harmonics of N_b identical blades in the fixed frame. As a product of two waves it is a sum of two, with the wave
numbers |m ± q|, and φ_n^m is r^m times a polynomial of r². So the shapes of the states are sums of far fewer terms
g_k(r) cos pψ and g_k(r) sin pψ: g_k is the φ of m = k with the highest n, and g_m, g_m+2, … span all φ_n^m. Order 8
with two blade harmonics has 225 states, and 113 terms. A load acts on the wake through its sums with the terms alone,
and the inflow is a sum of them.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from rotor.aero.inflow.interface import HarmonicShapes
from rotor.aero.inflow.peters_he import Mode, mode_set, radial_functions
from rotor.arrays import Array, Integers
from rotor.compiled import compiled


@dataclass(frozen=True, eq=False)
class Projection:
    """States ↔ terms ↔ fields on one grid. States are ordered by family (cosines, sines), blade harmonic, mode."""

    r: Array
    """Element centres, (elements,)."""
    radial: Array
    """g_k, (S + 1, elements)."""
    waves: Array
    """cos pψ, then sin pψ, p = 0 … S + q_max, (waves, azimuths)."""
    order: Integers
    """k of each term, (terms,)."""
    wave: Integers
    """p of each term, (terms,)."""
    parity: Integers
    """0 for a cosine, 1 for a sine, (terms,)."""
    mixture: Array
    """The shape of each state as a sum of terms, (states, terms)."""
    expansion: Array
    """φ of each mode as a sum of g_k, (modes, S + 1)."""
    load_factor: Array
    """Weight of d in the load on a state, (states,): ½ for m = 0, else 1."""
    field_factor: Array
    """Weight of a state in the field, (states,): 1 for the steady part, 2 for a harmonic."""
    cell: float
    """Δr/N_ψ, by which a sum over the grid becomes ⟨∫ … dr⟩."""
    modes: tuple[Mode, ...]
    """(m, n) of the cosines; the sines are those with m ≥ 1."""
    harmonics: tuple[int, ...]
    """q = N_b, 2N_b, … [per revolution]."""
    spectrum: Array
    """cos pψ, then sin pψ, p = 0 … 2(S + q_max), (harmonics, azimuths), over N_ψ."""
    pairs: Array
    """g_i g_j Δr for i ≥ j, (pairs, elements)."""

    # Every mode (m, n) also has a place for one of g_m, g_m+2, …, as many as there are modes with this m.

    @cached_property
    def mode_order(self) -> Integers:
        """m of each mode, (modes,)."""
        return np.array([m for m, _ in self.modes], dtype=np.int64)

    @cached_property
    def mode_blocks(self) -> Integers:
        """Where the modes with the same m begin and end, (modes, 2)."""
        m = self.mode_order
        return np.stack([np.searchsorted(m, m), np.searchsorted(m, m, side="right")], axis=1)

    @cached_property
    def mode_place(self) -> Integers:
        """k of the place of each mode, (modes,)."""
        return self.mode_order + 2 * (np.arange(len(self.modes)) - self.mode_blocks[:, 0])

    @cached_property
    def block_expansion(self) -> Array:
        """`expansion` by these places, (modes, modes): blocks along the diagonal."""
        same = self.mode_order[:, None] == self.mode_order
        return np.where(same, self.expansion[:, self.mode_place], 0.0)

    @cached_property
    def term_table(self) -> Integers:
        """Index of a term by k, p and whether a sine, (S + 1, waves, 2); for sin 0 that of cos 0."""
        table = np.zeros((len(self.radial), len(self.waves) // 2, 2), dtype=np.int64)
        table[self.order, self.wave, self.parity] = np.arange(self.terms)
        table[:, 0, 1] = table[:, 0, 0]
        return table

    @cached_property
    def no_factor(self) -> tuple[Array, Array]:
        """F = 1 and its slope, (elements,) both, for a wake that holds the tip itself."""
        return np.ones_like(self.r), np.zeros_like(self.r)

    @cached_property
    def _loading(self) -> Array:
        """`mixture` times the weights of `state_loads`."""
        return (self.cell * self.load_factor)[:, None] * self.mixture

    @property
    def states(self) -> int:
        return len(self.mixture)

    @property
    def terms(self) -> int:
        return len(self.order)

    def sums(self, fields: Array) -> Array:
        """Σ over the grid of a field times every term, (…, elements, azimuths) → (…, terms)."""
        spectrum = (self.radial @ fields).reshape(-1, fields.shape[-1]) @ self.waves.T
        return spectrum.reshape(*fields.shape[:-2], -1).take(self._place, axis=-1)

    def field(self, coefficients: Array) -> Array:
        """The sum of the terms, (…, terms) → (…, elements, azimuths)."""
        spectrum = np.zeros((*coefficients.shape[:-1], len(self.radial) * len(self.waves)))
        spectrum[..., self._place] = coefficients
        spectrum = spectrum.reshape(*coefficients.shape[:-1], len(self.radial), len(self.waves))
        return self.radial.T @ (spectrum @ self.waves)

    @cached_property
    def _place(self) -> Integers:
        """Place of each term among all g_k with all waves."""
        return self.order * len(self.waves) + self.wave + self.parity * (len(self.waves) // 2)

    def state_loads(self, sums: Array) -> Array:
        """The load τ on each state from the sums of d with the terms, (terms,) → (states,)."""
        return self._loading @ sums

    def coefficients(self, x: Array) -> Array:
        """The inflow of states in terms, (…, states) → (…, terms)."""
        return (x * self.field_factor) @ self.mixture

    def reduced(self, slope: Array) -> Array:
        """Σ over the grid of term · K · term for a pointwise slope K(r, ψ), (terms, terms).

        A product of two waves is a sum of two, so K enters by its Fourier coefficients alone: sums over r for every
        pair of g, then a look-up for every pair of terms.
        """
        spectrum = (self.pairs @ slope) @ self.spectrum.T
        return _assemble(spectrum, self.order, self.wave, self.parity, self.spectrum.shape[0] // 2, 1.0 / self.cell)

    def against(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """Σ over the grid of term · slope · column of `shapes`, (terms, columns), computed as `reduced`."""
        pairs = (self.radial[:, None] * shapes.radial * shapes.dr).reshape(-1, len(self.r))
        spectrum = ((pairs @ slope) @ self.spectrum.T).reshape(len(self.radial), len(shapes.radial), -1)
        return _assemble_columns(
            spectrum, self.order, self.wave, self.parity, shapes.wave, shapes.parity, self.spectrum.shape[0] // 2,
            1.0 / self.cell,
        )  # fmt: skip


_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def _mean_of_waves(row: Any, p: int, p_sine: int, s: int, s_sine: int, sines: int) -> float:
    """⟨f · wave p · wave s⟩ from the Fourier coefficients of f, cosines, then sines.

    cos p cos s and sin p sin s are ½[cos(p − s) ± cos(p + s)]; sin p cos s is ½[sin(p + s) + sin(p − s)].
    """
    if p_sine == s_sine:
        near, far = row[abs(p - s)], row[p + s]
        return 0.5 * (near - far if p_sine else near + far)
    difference = p - s if p_sine else s - p
    near = row[sines + difference] if difference >= 0 else -row[sines - difference]
    return 0.5 * (row[sines + p + s] + near)


@_compile
def _assemble(spectrum: Any, order: Any, wave: Any, parity: Any, sines: int, factor: float) -> Any:
    """The symmetric matrix of `Projection.reduced` from the spectra of all pairs of g."""
    n = len(order)
    out = np.empty((n, n))
    for a in range(n):
        for b in range(a + 1):
            i, j = max(order[a], order[b]), min(order[a], order[b])
            mean = _mean_of_waves(spectrum[i * (i + 1) // 2 + j], wave[a], parity[a], wave[b], parity[b], sines)
            out[a, b] = out[b, a] = factor * mean
    return out


@_compile
def _assemble_columns(
    spectrum: Any, order: Any, wave: Any, parity: Any, own_wave: Any, own_parity: Any, sines: int, factor: float
) -> Any:
    """The matrix of `Projection.against`, (terms, shapes × harmonics)."""
    n, shapes, functions = len(order), spectrum.shape[1], len(own_wave)
    out = np.empty((n, shapes * functions))
    for a in range(n):
        for k in range(shapes):
            row = spectrum[order[a], k]
            for c in range(functions):
                mean = _mean_of_waves(row, wave[a], parity[a], own_wave[c], own_parity[c], sines)
                out[a, k * functions + c] = factor * mean
    return out


@lru_cache(maxsize=32)
def build_projection(order: int, blades: int, harmonics: int, root: float, elements: int, azimuths: int) -> Projection:
    """The projection of an order S with `harmonics` multiples of the blade number on the grid of `rotor.aero.disk`.

    Elements are equally wide from `root` to 1 and summed by the midpoint rule, azimuths evenly spaced.
    """
    multiples = tuple(k * blades for k in range(1, harmonics + 1))
    highest = order + (multiples[-1] if multiples else 0)
    if azimuths <= 2 * highest:
        raise ValueError(
            f"{azimuths} azimuths cannot resolve the wake's {highest} waves per revolution: use more than {2 * highest}"
        )
    dr = (1.0 - root) / elements
    r = np.linspace(root + 0.5 * dr, 1.0 - 0.5 * dr, elements)
    psi = 2.0 * np.pi * np.arange(azimuths) / azimuths
    modes = mode_set(order)
    expansion = _expansion(modes, order)

    # Blade harmonics as (wave number, whether a sine).
    rotor = [(0, 0)] + [(q, kind) for q in multiples for kind in (0, 1)]
    shapes: list[dict[tuple[int, int, int], float]] = []
    factors: list[tuple[float, float]] = []
    for kind in (0, 1):
        for h, blade in enumerate(rotor):
            for m, n in mode_set(order, kind):
                factors.append((0.5 if m == 0 else 1.0, 1.0 if h == 0 else 2.0))
                shapes.append(_shape(expansion[modes.index((m, n))], m, _product(m, kind, *blade)))
    terms = sorted({term for shape in shapes for term in shape}, key=lambda term: (term[1], term[2], term[0]))
    mixture = np.array([[shape.get(term, 0.0) for term in terms] for shape in shapes])
    phase = np.outer(np.arange(2 * highest + 1), psi)
    radial = radial_functions(_highest(order), r)
    rows, columns = np.tril_indices(order + 1)
    return Projection(
        r=r,
        radial=radial,
        waves=np.concatenate([np.cos(phase[: highest + 1]), np.sin(phase[: highest + 1])]),
        order=np.array([term[0] for term in terms], dtype=np.int64),
        wave=np.array([term[1] for term in terms], dtype=np.int64),
        parity=np.array([term[2] for term in terms], dtype=np.int64),
        mixture=mixture,
        expansion=expansion,
        load_factor=np.array([factor[0] for factor in factors]),
        field_factor=np.array([factor[1] for factor in factors]),
        cell=dr / azimuths,
        modes=modes,
        harmonics=multiples,
        spectrum=np.concatenate([np.cos(phase), np.sin(phase)]) / azimuths,
        pairs=radial[rows] * radial[columns] * dr,
    )


def _highest(order: int) -> tuple[Mode, ...]:
    """The modes of g_0 … g_S: the highest n of every m."""
    return tuple((m, order + (order - m + 1) % 2) for m in range(order + 1))


def _expansion(modes: tuple[Mode, ...], order: int) -> Array:
    """`Projection.expansion`: polynomials of the same span, so their values at enough radii determine it."""
    r = np.sqrt(1.0 - np.square(np.linspace(0.02, 0.98, 4 * order)))
    basis, out = radial_functions(_highest(order), r), np.zeros((len(modes), order + 1))
    for row, (m, n) in zip(out, modes, strict=True):
        row[m::2] = np.linalg.lstsq(basis[m::2].T, radial_functions(((m, n),), r)[0])[0]
    return out


def _shape(
    expansion: Array, m: int, product: tuple[int, tuple[int, int], tuple[float, float]]
) -> dict[tuple[int, int, int], float]:
    """φ times an azimuthal function as amplitudes of terms (k, p, whether a sine)."""
    parity, waves, amplitudes = product
    shape: dict[tuple[int, int, int], float] = {}
    for k in range(m, len(expansion), 2):
        for wave, amplitude in zip(waves, amplitudes, strict=True):
            if wave or not parity:  # sin 0 is none.
                shape[k, wave, parity] = shape.get((k, wave, parity), 0.0) + amplitude * expansion[k]
    return shape


def _product(m: int, m_sine: int, q: int, q_sine: int) -> tuple[int, tuple[int, int], tuple[float, float]]:
    """(cos or sin mψ)(cos or sin qψ) as two waves: whether sines, wave numbers, amplitudes."""
    near, far = abs(m - q), m + q
    if m_sine == q_sine:
        return 0, (near, far), (0.5, -0.5 if m_sine else 0.5)
    # sin a cos b = ½ sin(a + b) + ½ sin(a − b), and sin(−x) = −sin x.
    forward = m >= q if m_sine else q >= m
    return 1, (near, far), (0.5 if forward else -0.5, 0.5)


@_compile
def between_terms(
    cosines: Any, sines: Any, expansion: Any, blocks: Any, m: Any, order: Any, harmonics: Any, table: Any, terms: int
) -> Any:
    """T between the terms, without the cell: blocks of a family between g_k, added at the terms of both sides."""
    out = np.zeros((terms, terms))
    modes, steady = len(m), len(m) - sines.shape[1]
    sine_expansion, sine_blocks = expansion[steady:, steady:], blocks[steady:] - steady
    rows, turns = np.empty((2, modes, 2), np.int64), np.empty((2, modes))
    for h in range(len(harmonics)):
        even = _expanded(cosines[h], expansion, blocks)
        odd = _expanded(sines[h], sine_expansion, sine_blocks)
        weight = 0.5 if h else 0.25
        for side in range(2):
            for i in range(modes):
                wave = harmonics[h] + (m[i] if side == 0 else -m[i])
                turns[side, i] = np.sign(wave)
                rows[side, i] = table[order[i], abs(wave)]
        for i in range(modes):
            for j in range(modes):
                half = weight * (0.5 if m[j] == 0 else 1.0)
                mean, difference = half * even[i, j], 0.0j
                if i >= steady and j >= steady:
                    difference = half * odd[i - steady, j - steady]
                same, opposite = mean + difference, mean - difference
                for side in range(2):
                    row, sine_row, turn = rows[side, i, 0], rows[side, i, 1], turns[side, i]
                    for other in range(2):
                        column, sine_column, back = rows[other, j, 0], rows[other, j, 1], turns[other, j]
                        value = same if side == other else opposite
                        out[row, column] += value.real
                        out[sine_row, sine_column] += turn * back * value.real
                        if h:
                            out[row, sine_column] += back * value.imag
                            out[sine_row, column] -= turn * value.imag
    return out


@_compile
def _expanded(block: Any, expansion: Any, blocks: Any) -> Any:
    """Eᵀ H E with the blocks along the diagonal of E."""
    n = len(block)
    half, out = np.zeros_like(block), np.zeros_like(block)
    for i in range(n):
        for k in range(blocks[i, 0], blocks[i, 1]):
            for j in range(n):
                half[i, j] += expansion[k, i] * block[k, j]
    for i in range(n):
        for k in range(n):
            for j in range(blocks[k, 0], blocks[k, 1]):
                out[i, j] += half[i, k] * expansion[k, j]
    return out
