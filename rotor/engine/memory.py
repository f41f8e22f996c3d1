"""What forces remember: derivatives by the channels at other azimuths of the same element.

A section whose forces follow lags has, beside the partial derivatives at a point, F_o(ψ) += ∫ … c(ψ'):

    ∂F_o(r, ψ)/∂c(r, ψ') = Σ L_ok(r, ψ) N_kl(r, ψ, ψ') R_lc(r, ψ')

L: forces by what is remembered; N: that by its inputs around the azimuth; R: inputs by channels. N is never formed: its
products, and those of its transposed, follow the linear lags around the azimuth. No waves come out of it in pairs, so
products of measures and columns are formed at all azimuths of an element.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rotor.engine.terms import Structure
from rotor.engine.waves import WaveGrid
from rotor.support.arrays import Array, Integers
from rotor.support.compiled import compiled

_compile = compiled(error_model="numpy")

_NEGLIGIBLE = 1e-30
"""Share of a start that is left, below which it is none: an early end of a sum."""
INPUTS, OUTPUTS = 2, 3
"""Of the lags: the first variables are the inputs, those after them the outputs."""


class Lags(NamedTuple):
    """Linear lags of every element, each fed by those before it, on finer azimuths k.

    A link adds p[k] y[a] + q[k] y[a + 1] to what a variable z is given, from a variable y, where a is k or another
    azimuth. Then z[k] is what is given, or z[k + 1] = decay[k] z[k] + what is given: periodic, or a sum from zero where
    nothing decays.
    """

    links: Integers
    """Variable fed, variable it comes from, row of `places` (−1: a = k), terms (1: no q), (links, 4)."""
    decaying: Integers
    """Row of `decays` of every variable, −1 where it does not lag, (variables,)."""
    linked: Integers
    """How many of the links an element has, (elements,)."""
    share: Array
    """By which the first input counts, (elements, azimuths)."""
    decays: Array
    """(elements, rows, finer azimuths)"""
    factors: Array
    """p and q, (elements, links, 2, finer azimuths)."""
    places: Integers
    """a, (elements, rows, finer azimuths)."""


@_compile
def onto_finer(coarse: Any, steps: int, out: Any) -> None:
    """Linear between azimuths, onto finer ones; after the last comes the first again."""
    n = len(coarse)
    for m in range(steps):
        w = m / steps
        for c in range(n - 1):
            out[c * steps + m] = (1.0 - w) * coarse[c] + w * coarse[c + 1]
        out[(n - 1) * steps + m] = (1.0 - w) * coarse[n - 1] + w * coarse[0]
    out[n * steps] = coarse[0]


@_compile
def onto_coarser(fine: Any, steps: int, out: Any) -> None:
    """The transposed of `onto_finer` over the steps: a mean about every azimuth."""
    n = len(out)
    out[:] = 0.0
    for m in range(steps):
        after = m / (steps * steps)
        here = 1.0 / steps - after
        for c in range(n):
            out[c] += here * fine[c * steps + m]
        for c in range(n if m > 0 else 0):
            out[c] += after * fine[(c - 1 if c > 0 else n - 1) * steps + m]


@_compile
def around(decay: Any, z: Any) -> None:
    """z[k + 1] = decay[k] z[k] + given[k], in place: z holds what is given.

    Periodic, so that its end is its beginning; a sum from zero where nothing decays.
    """
    n = len(decay)
    value, rest, k = 0.0, 1.0, n
    # From zero at first, then with what one turn leaves of the start.
    while k > 0 and rest > _NEGLIGIBLE:
        k -= 1
        value += rest * z[k]
        rest *= decay[k]
    value = value / (1.0 - rest) if rest < 1.0 else 0.0
    for k in range(n):
        given = z[k]
        z[k] = value
        value = decay[k] * value + given
    z[n] = z[0] if rest < 1.0 else value


@_compile
def _back_around(decay: Any, z: Any) -> None:
    """The transposed of `around`, in place, (steps + 1,); or for many columns, (steps + 1, columns)."""
    n, rest, k = len(decay), 1.0, 0
    if z.ndim == 1:
        total = 0.0
        while k < n and rest > _NEGLIGIBLE:
            total += rest * z[k]
            rest *= decay[k]
            k += 1
        total = z[n] + (0.0 if rest == 1.0 else (total + rest * z[n]) / (1.0 - rest))
        z[n] = 0.0
        for k in range(n - 1, -1, -1):
            before = z[k]
            z[k] = total
            total = decay[k] * total + before
    else:
        columns = z.shape[1]
        value = np.zeros(columns)
        while k < n and rest > _NEGLIGIBLE:
            for j in range(columns):
                value[j] += rest * z[k, j]
            rest *= decay[k]
            k += 1
        for j in range(columns):
            value[j] = z[n, j] + (
                0.0 if rest == 1.0 else (value[j] + rest * z[n, j]) / (1.0 - rest)
            )
            z[n, j] = 0.0
        for k in range(n - 1, -1, -1):
            for j in range(columns):
                own = z[k, j]
                z[k, j] = value[j]
                value[j] = decay[k] * value[j] + own


@_compile
def _along_links(lags: Any, e: int, z: Any) -> None:
    """All variables of an element from its inputs, (variables, finer azimuths + 1)."""
    n, count = z.shape[1] - 1, lags.linked[e]
    for link in range(count):
        to, of, row, terms = lags.links[link]
        out, given, (p, q) = z[to], z[of], lags.factors[e, link]
        if row < 0:
            for k in range(n):
                out[k] += p[k] * given[k]
            for k in range(n if terms > 1 else 0):
                out[k] += q[k] * given[k + 1]
        else:
            at = lags.places[e, row]
            for k in range(n):
                out[k] += p[k] * given[at[k]] + q[k] * given[at[k] + 1]
        if link + 1 == count or lags.links[link + 1, 0] != to:
            if lags.decaying[to] >= 0:
                around(lags.decays[e, lags.decaying[to]], out)
            else:
                out[n] = out[0]


@_compile
def _back_along_links(lags: Any, e: int, z: Any) -> None:
    """The transposed of `_along_links` from weights on the outputs, for one column or many, (variables, …, columns)."""
    n, count = z.shape[1] - 1, lags.linked[e]
    for link in range(count - 1, -1, -1):
        to, of, row, terms = lags.links[link]
        weights, out, (p, q) = z[to], z[of], lags.factors[e, link]
        if link + 1 == count or lags.links[link + 1, 0] != to:
            if lags.decaying[to] >= 0:
                _back_around(lags.decays[e, lags.decaying[to]], weights)
            else:
                weights[0] += weights[n]
                weights[n] = 0.0
        at = lags.places[e, max(row, 0)]
        if z.ndim == 2:
            for k in range(n if row < 0 else 0):
                out[k] += p[k] * weights[k]
            for k in range(n if row < 0 and terms > 1 else 0):
                out[k + 1] += q[k] * weights[k]
            for k in range(n if row >= 0 else 0):
                out[at[k]] += p[k] * weights[k]
                out[at[k] + 1] += q[k] * weights[k]
        else:
            for k in range(n):
                here = k if row < 0 else at[k]
                for j in range(z.shape[2]):
                    out[here, j] += p[k] * weights[k, j]
                for j in range(z.shape[2] if terms > 1 else 0):
                    out[here + 1, j] += q[k] * weights[k, j]


@_compile
def _remembered(lags: Any, inputs: Any, out: Any) -> None:
    """N times inputs, (inputs, elements, azimuths); the last output is the first input at the same azimuth."""
    fine = lags.decays.shape[2]
    z = np.empty((len(lags.decaying), fine + 1))
    for e in range(inputs.shape[1]):
        steps = fine // inputs.shape[2]
        z[:] = 0.0
        onto_finer(lags.share[e] * inputs[0, e], steps, z[0])
        onto_finer(inputs[1, e], steps, z[1])
        _along_links(lags, e, z)
        for k in range(OUTPUTS):
            onto_coarser(z[INPUTS + k], steps, out[k, e])
        out[OUTPUTS, e] = inputs[0, e]


@_compile
def _transposed(left: Any, lags: Any, right: Any, forces: Any, out: Any) -> None:
    """(L N R)ᵀ times weights on the forces, (forces, elements, azimuths), (channels, elements, azimuths)."""
    fine, m = lags.decays.shape[2], forces.shape[2]
    z, steps = np.empty((len(lags.decaying), fine + 1)), fine // m
    weights, inputs = np.empty((OUTPUTS + 1, m)), np.empty((INPUTS, m))
    for e in range(out.shape[1]):
        z[:], weights[:] = 0.0, 0.0
        for k in range(OUTPUTS + 1):
            for o in range(len(forces)):
                for j in range(m):
                    weights[k, j] += left[o, k, e, j] * forces[o, e, j]
        for k in range(OUTPUTS):
            onto_finer(weights[k], steps, z[INPUTS + k])
            z[INPUTS + k, fine] = 0.0
        _back_along_links(lags, e, z)
        for k in range(INPUTS):
            z[k, 0] += z[k, fine]
            onto_coarser(z[k], steps, inputs[k])
        for j in range(m):
            inputs[0, j] = lags.share[e, j] * inputs[0, j] + weights[OUTPUTS, j]
        for c in range(len(out)):
            for j in range(m):
                out[c, e, j] = inputs[0, j] * right[0, c, e, j] + inputs[1, j] * right[1, c, e, j]


@_compile
def _back(lags: Any, left: Any, means: Any, out: Any) -> None:
    """(L N)ᵀ times functions of azimuth on each force, (azimuths, functions), (elements, inputs, azimuths, …)."""
    (azimuths, functions), fine = means.shape, lags.decays.shape[2]
    steps, columns = fine // azimuths, len(left) * functions
    z, weights = (
        np.empty((len(lags.decaying), fine + 1, columns)),
        np.empty((OUTPUTS + 1, azimuths, columns)),
    )
    for e in range(len(out)):
        z[:], out[e] = 0.0, 0.0
        for k in range(OUTPUTS + 1):
            for c in range(azimuths):
                for o in range(len(left)):
                    for j in range(functions):
                        weights[k, c, o * functions + j] = left[o, k, e, c] * means[c, j]
        for c in range(azimuths):
            for m in range(1 - steps, steps):
                at, share = (c * steps + m) % fine, 1.0 - abs(m) / steps
                for k in range(OUTPUTS):
                    for j in range(columns):
                        z[INPUTS + k, at, j] += share * weights[k, c, j]
        _back_along_links(lags, e, z)
        for k in range(INPUTS):
            for j in range(columns):
                z[k, 0, j] += z[k, fine, j]
        for c in range(azimuths):
            for m in range(1 - steps, steps):
                at, share = (c * steps + m) % fine, (1.0 - abs(m) / steps) / steps
                for k in range(INPUTS):
                    for j in range(columns):
                        out[e, k, c, j] += share * z[k, at, j]
            for j in range(columns):
                out[e, 0, c, j] = lags.share[e, c] * out[e, 0, c, j] + weights[OUTPUTS, c, j]


@_compile
def _add_pairs(product: Any, of_measures: Any, of_columns: Any, out: Any) -> None:
    """Add to columns and measures what their pairs of functions along the blade and of waves have."""
    (weight, first, other, measures), (row, begin, wave, columns) = of_measures, of_columns
    for c in columns:
        for m in measures:
            out[c, 1 + m] += product[weight[m] - first, row[c] - begin, other[m], wave[c]]


@dataclass(frozen=True, eq=False)
class LagFactors:
    """The three factors at a point."""

    left: Array
    """L, (forces, outputs + 1, elements, azimuths); the last output is the first input at the same azimuth."""
    lags: Lags
    """N."""
    right: Array
    """R, (inputs, channels, elements, azimuths)."""

    def times(self, fields: Mapping[int, Array]) -> Array:
        """How forces respond to fields added to channels, (forces, elements, azimuths)."""
        given, out = np.zeros((INPUTS, *self.left.shape[2:])), np.empty(self.left.shape[1:])
        for channel, field in fields.items():
            given += self.right[:, channel] * field
        _remembered(self.lags, given, out)
        return np.einsum("okei,kei->oei", self.left, out)

    def transposed(self, forces: Array) -> Array:
        """From weights on the forces, (forces, elements, azimuths), to the channels, (channels, elements, azimuths)."""
        out = np.empty(self.right.shape[1:])
        _transposed(self.left, self.lags, self.right, forces, out)
        return out

    @cached_property
    def used(self) -> Integers:
        """The forces that depend on channels at other azimuths."""
        return np.flatnonzero(self.left.any(axis=(1, 2, 3)))

    def by_inputs(self, waves: WaveGrid) -> Array:
        """∂ of the means of the forces used with all waves by the inputs at all azimuths.

        (elements, inputs, azimuths, forces used, waves)
        """
        elements, azimuths = self.left.shape[2:]
        out = np.empty((elements, INPUTS, azimuths, len(self.used) * waves.waves))
        _back(self.lags, self.left[self.used], waves.mean, out)
        return out.reshape(*out.shape[:-1], -1, waves.waves)

    def by_channel(self, by_inputs: Array, channel: int) -> Array:
        """∂ of the means of all forces by one channel at all azimuths, (forces, waves, elements, azimuths)."""
        out = np.zeros((len(self.left), by_inputs.shape[-1], *self.left.shape[2:]))
        out[self.used] = np.einsum("eljop,lej->opej", by_inputs, self.right[:, channel])
        return out

    def add_between(
        self,
        by_inputs: Array,
        structure: Structure,
        phi: Array,
        psi: Array,
        waves: WaveGrid,
        out: Array,
    ) -> None:
        """Add ∂ of the measures by the coefficients of the shapes, (coefficients, measures).

        phi, psi: shapes and weights along the blade. Derivatives are those of an element at all azimuths, so all
        products of two waves are formed, not only their sums.
        """
        if not len(self.used):  # Every section is beyond stall: nothing in it lags.
            return
        row, wave = np.divmod(structure.coefficient_places, structure.waves)
        weight, other = np.divmod(structure.measure_places, structure.waves)
        elements, count = len(by_inputs), structure.waves
        ends = structure.first_weight[self.used], structure.first_weight[self.used + 1]
        measures = [
            np.flatnonzero((weight >= first) & (weight < last))
            for first, last in zip(*ends, strict=True)
        ]
        from_inputs = by_inputs.reshape(elements, -1, len(self.used) * count).swapaxes(1, 2)
        for channel, right in enumerate(self.right.swapaxes(0, 1)):
            begin, end = structure.first_row[channel : channel + 2]
            columns = np.flatnonzero((row >= begin) & (row < end))
            if not (len(columns) and right.any()):
                continue
            onto = np.einsum("lej,qj->eljq", right, waves.at).reshape(elements, -1, count)
            between = (from_inputs @ onto).reshape(elements, len(self.used), -1)
            for k, (first, last) in enumerate(zip(*ends, strict=True)):
                pairs = (psi[first:last, None] * phi[None, begin:end]).reshape(-1, elements)
                product = (pairs @ between[:, k]).reshape(last - first, end - begin, count, count)
                _add_pairs(
                    product, (weight, first, other, measures[k]), (row, begin, wave, columns), out
                )
