"""Projection between fields on the disk and the states of the dynamic wake.

A state is a mode φ_n^m(r) cos mψ or sin mψ times one of the blade harmonics 1, cos qψ, sin qψ, q = N_b, 2N_b, …, the
harmonics of N_b identical blades in the fixed frame. Every such shape is φ(r) times one azimuthal function, so sums
over the disk are two small matrix products, without a matrix of the size of the disk.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rotor.aero.inflow.interface import HarmonicShapes
from rotor.aero.inflow.peters_he import mode_set, radial_functions
from rotor.arrays import Array, Integers
from rotor.compiled import compiled


@dataclass(frozen=True, eq=False)
class Projection:
    """States ↔ fields on one grid. States are ordered by family (cosines, sines), blade harmonic, mode."""

    r: Array
    """Element centres, (elements,)."""
    radial: Array
    """φ of the modes, (modes, elements)."""
    waves: Array
    """cos pψ, then sin pψ, p = 0 … S + q_max, (waves, azimuths): each azimuthal function of a state is a sum of two."""
    mode: Integers
    """Row of `radial` of each state, (states,)."""
    load_factor: Array
    """Weight of d in the load on a state, (states,): ½ for m = 0, else 1."""
    field_factor: Array
    """Weight of a state in the field, (states,): 1 for the steady part, 2 for a harmonic."""
    cell: float
    """Δr/N_ψ, by which a sum over the grid becomes ⟨∫ … dr⟩."""
    family: tuple[int, int]
    """How many cosine and sine modes."""
    harmonics: tuple[int, ...]
    """q = N_b, 2N_b, … [per revolution]."""
    spectrum: Array
    """cos pψ, then sin pψ, p = 0 … 2(S + q_max), (harmonics, azimuths), over N_ψ."""
    pairs: Array
    """φ_i φ_j Δr for i ≥ j, (pairs, elements)."""
    parity: Integers
    """0 where a state's azimuthal function is a sum of cosines, 1 of sines, (states,)."""
    wave: Integers
    """The two wave numbers in it, (states, 2)."""
    share: Array
    """And their amplitudes, (states, 2)."""

    @property
    def states(self) -> int:
        return len(self.mode)

    def loads(self, d: Array) -> Array:
        """W d: the load τ on each state. d (…, elements, azimuths) → (…, states)."""
        return self._analyse(d) * (self.load_factor * self.cell)

    def field(self, x: Array) -> Array:
        """C x: the inflow of states. (…, states) → (…, elements, azimuths)."""
        return self._synthesise(x * self.field_factor)

    def loads_transposed(self, p: Array) -> Array:
        """Wᵀ p, (…, states) → (…, elements, azimuths)."""
        return self._synthesise(p * (self.load_factor * self.cell))

    def field_transposed(self, f: Array) -> Array:
        """Cᵀ f, (…, elements, azimuths) → (…, states)."""
        return self._analyse(f) * self.field_factor

    def _analyse(self, field: Array) -> Array:
        spectrum = self.radial @ (field @ self.waves.T)
        shape = (-1, *spectrum.shape[-2:])
        states = _collect(spectrum.reshape(shape), self.mode, self.parity, self.wave, self.share)
        return states.reshape(*field.shape[:-2], self.states)

    def _synthesise(self, x: Array) -> Array:
        modes, waves = len(self.radial), len(self.waves)
        spectrum = _spread(x.reshape(-1, self.states), self.mode, self.parity, self.wave, self.share, modes, waves)
        return (self.radial.T @ spectrum.reshape(*x.shape[:-1], modes, waves)) @ self.waves

    def reduced(self, slope: Array) -> Array:
        """W diag(K) C for a pointwise slope K(r, ψ), (elements, azimuths) → (states, states).

        A product of two azimuthal functions is a sum of at most eight waves, so K enters by its Fourier coefficients
        alone: sums over r for every pair of modes, then a look-up for every pair of states.
        """
        spectrum = self.pairs @ (slope @ self.spectrum.T)
        return _assemble(
            spectrum, self.mode, self.parity, self.wave, self.share, self.spectrum.shape[0] // 2,
            self.load_factor, self.field_factor,
        )  # fmt: skip

    def against(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """⟨∫ state · slope · column dr⟩ for every state and every column of `shapes`, (states, columns).

        As `reduced`: only the Fourier coefficients of the slope enter. The factors of load or field are left out.
        """
        pairs = (self.radial[:, None] * shapes.radial * shapes.dr).reshape(-1, len(self.r))
        spectrum = (pairs @ (slope @ self.spectrum.T)).reshape(len(self.radial), len(shapes.radial), -1)
        return _assemble_columns(
            spectrum, self.mode, self.parity, self.wave, self.share, shapes.wave, shapes.parity,
            self.spectrum.shape[0] // 2,
        )  # fmt: skip


_compile = compiled()


@_compile
def _collect(spectrum: Any, mode: Any, parity: Any, wave: Any, share: Any) -> Any:
    """Sums with every state from those with every mode and wave, (n, modes, waves) → (n, states)."""
    n, states, sines = len(spectrum), len(mode), spectrum.shape[2] // 2
    out = np.empty((n, states))
    for k in range(n):
        for a in range(states):
            row, first = spectrum[k, mode[a]], parity[a] * sines
            out[k, a] = share[a, 0] * row[first + wave[a, 0]] + share[a, 1] * row[first + wave[a, 1]]
    return out


@_compile
def _spread(x: Any, mode: Any, parity: Any, wave: Any, share: Any, modes: int, waves: int) -> Any:
    """Coefficients of every mode and wave from those of the states, (n, states) → (n, modes, waves)."""
    n, states, sines = len(x), len(mode), waves // 2
    out = np.zeros((n, modes, waves))
    for k in range(n):
        for a in range(states):
            row, first = out[k, mode[a]], parity[a] * sines
            row[first + wave[a, 0]] += share[a, 0] * x[k, a]
            row[first + wave[a, 1]] += share[a, 1] * x[k, a]
    return out


@_compile
def _assemble(spectrum: Any, mode: Any, parity: Any, wave: Any, share: Any, sines: int, rows: Any, columns: Any) -> Any:
    """Σ over waves of products of azimuthal functions times factors of rows and columns, (states, states).

    cos p cos s and sin p sin s are ½[cos(p − s) ± cos(p + s)]; sin p cos s is ½[sin(p + s) + sin(p − s)].
    """
    n = len(mode)
    out = np.empty((n, n))
    for a in range(n):
        for b in range(a + 1):
            i = max(mode[a], mode[b])
            row = spectrum[i * (i + 1) // 2 + min(mode[a], mode[b])]
            total = 0.0
            for u in range(2):
                for v in range(2):
                    weight = 0.5 * share[a, u] * share[b, v]
                    if parity[a] == parity[b]:
                        p, s = wave[a, u], wave[b, v]
                        far = row[p + s] if parity[a] == 0 else -row[p + s]
                        total += weight * (row[abs(p - s)] + far)
                    else:
                        p, s = (wave[a, u], wave[b, v]) if parity[a] == 1 else (wave[b, v], wave[a, u])
                        near = row[sines + p - s] if p >= s else -row[sines + s - p]
                        total += weight * (row[sines + p + s] + near)
            out[a, b] = rows[a] * total * columns[b]
            out[b, a] = rows[b] * total * columns[a]
    return out


@_compile
def _assemble_columns(
    spectrum: Any, mode: Any, parity: Any, wave: Any, share: Any, own_wave: Any, own_parity: Any, sines: int
) -> Any:
    """Σ over waves of products of azimuthal functions and harmonics, (states, shapes × harmonics)."""
    n, shapes, functions = len(mode), spectrum.shape[1], len(own_wave)
    out = np.empty((n, shapes * functions))
    for a in range(n):
        for k in range(shapes):
            row = spectrum[mode[a], k]
            for c in range(functions):
                total = 0.0
                for u in range(2):
                    weight = 0.5 * share[a, u]
                    if parity[a] == own_parity[c]:
                        p, s = wave[a, u], own_wave[c]
                        far = row[p + s] if parity[a] == 0 else -row[p + s]
                        total += weight * (row[abs(p - s)] + far)
                    else:
                        p, s = (wave[a, u], own_wave[c]) if parity[a] == 1 else (own_wave[c], wave[a, u])
                        near = row[sines + p - s] if p >= s else -row[sines + s - p]
                        total += weight * (row[sines + p + s] + near)
                out[a, k * functions + c] = total
    return out


@lru_cache(maxsize=32)
def build_projection(order: int, blades: int, harmonics: int, root: float, elements: int, azimuths: int) -> Projection:
    """The projection of an order S with `harmonics` multiples of the blade number on the grid of `rotor.aero.disk`.

    Elements are equally wide from `root` to 1 and summed by the midpoint rule, azimuths evenly spaced.
    """
    waves = tuple(k * blades for k in range(1, harmonics + 1))
    highest = order + (waves[-1] if waves else 0)
    if azimuths <= 2 * highest:
        raise ValueError(
            f"{azimuths} azimuths cannot resolve the wake's {highest} waves per revolution: use more than {2 * highest}"
        )
    dr = (1.0 - root) / elements
    r = np.linspace(root + 0.5 * dr, 1.0 - 0.5 * dr, elements)
    psi = 2.0 * np.pi * np.arange(azimuths) / azimuths
    modes = mode_set(order)
    radial = radial_functions(modes, r)

    # Blade harmonics as (wave number, whether a sine), and every m as cosine, then sine.
    rotor = [(0, 0)] + [(q, kind) for q in waves for kind in (0, 1)]
    places = [(m, 0) for m in range(order + 1)] + [(m, 1) for m in range(1, order + 1)]
    products = [_product(*place, *own) for place in places for own in rotor]
    index = [
        (modes.index((m, n)), places.index((m, kind)) * len(rotor) + h, 0.5 if m == 0 else 1.0, 1.0 if h == 0 else 2.0)
        for kind in (0, 1)
        for h in range(len(rotor))
        for m, n in mode_set(order, kind)
    ]
    phase = np.outer(np.arange(2 * highest + 1), psi)
    rows, columns = np.tril_indices(len(modes))
    return Projection(
        r=r,
        radial=radial,
        waves=np.concatenate([np.cos(phase[: highest + 1]), np.sin(phase[: highest + 1])]),
        mode=np.array([entry[0] for entry in index], dtype=np.int64),
        load_factor=np.array([entry[2] for entry in index]),
        field_factor=np.array([entry[3] for entry in index]),
        cell=dr / azimuths,
        family=(len(modes), len(mode_set(order, 1))),
        harmonics=waves,
        spectrum=np.concatenate([np.cos(phase), np.sin(phase)]) / azimuths,
        pairs=radial[rows] * radial[columns] * dr,
        parity=np.array([products[entry[1]][0] for entry in index], dtype=np.int64),
        wave=np.array([products[entry[1]][1] for entry in index], dtype=np.int64),
        share=np.array([products[entry[1]][2] for entry in index]),
    )


def _product(m: int, m_sine: int, q: int, q_sine: int) -> tuple[int, tuple[int, int], tuple[float, float]]:
    """(cos or sin mψ)(cos or sin qψ) as two waves: whether sines, wave numbers, amplitudes."""
    near, far = abs(m - q), m + q
    if m_sine == q_sine:
        return 0, (near, far), (0.5, -0.5 if m_sine else 0.5)
    # sin a cos b = ½ sin(a + b) + ½ sin(a − b), and sin(−x) = −sin x.
    forward = m >= q if m_sine else q >= m
    return 1, (near, far), (0.5 if forward else -0.5, 0.5)
