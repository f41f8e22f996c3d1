"""What forces remember: derivatives by the channels at other azimuths of the same element.

A section whose forces follow lags has, beside the partial derivatives at a point, F_o(ψ) += ∫ … c(ψ'):

    ∂F_o(r, ψ)/∂c(r, ψ') = Σ L_ok(r, ψ) N_kl(r, ψ, ψ') R_lc(r, ψ')

L: forces by what is remembered; N: that by its inputs around the azimuth; R: inputs by channels. No waves come out of
it in pairs, so products of measures and columns are formed at all azimuths of an element.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.engine.terms import Structure
from rotor.engine.waves import WaveGrid

_compile = compiled(error_model="numpy")


@_compile
def _transposed(left: Any, kernel: Any, right: Any, forces: Any, channels: Any) -> None:
    """Add (L N R)ᵀ times weights on the forces to the channels: one pass over N, whose rows lie in a row."""
    outputs, inputs, elements, azimuths = kernel.shape[:4]
    given = np.empty((inputs, azimuths))
    for e in range(elements):
        given[:] = 0.0
        for k in range(outputs):
            for i in range(azimuths):
                weight = 0.0
                for o in range(len(left)):
                    weight += forces[o, e, i] * left[o, k, e, i]
                for inp in range(inputs):
                    for j in range(azimuths):
                        given[inp, j] += weight * kernel[k, inp, e, i, j]
        for inp in range(inputs):
            for c in range(len(channels)):
                for j in range(azimuths):
                    channels[c, e, j] += given[inp, j] * right[inp, c, e, j]


@dataclass(frozen=True, eq=False)
class Memory:
    """The three factors at a point."""

    left: Array
    """L, (forces, outputs, elements, azimuths)."""
    kernel: Array
    """N, (outputs, inputs, elements, azimuths, azimuths)."""
    right: Array
    """R, (inputs, channels, elements, azimuths)."""

    def times(self, fields: Mapping[int, Array]) -> Array:
        """What fields added to channels do to the forces, (forces, elements, azimuths)."""
        given = sum((self.right[:, channel] * field for channel, field in fields.items()), start=np.zeros(1))
        if not fields:
            return np.zeros((len(self.left), *self.left.shape[2:]))
        out = (self.kernel @ given[..., None])[..., 0].sum(axis=1)  # N is not copied.
        return np.einsum("okei,kei->oei", self.left, out)

    def transposed(self, forces: Array) -> Array:
        """From weights on the forces, (forces, elements, azimuths), to the channels, (channels, elements, azimuths)."""
        channels = np.zeros((self.right.shape[1], *forces.shape[1:]))
        _transposed(self.left, self.kernel, self.right, forces, channels)
        return channels

    def by_inputs(self, waves: WaveGrid) -> Array:
        """∂ of the means of all forces with all waves by the inputs at all azimuths.

        (elements, forces, waves, inputs, azimuths)
        """
        forces, outputs, elements, azimuths = self.left.shape
        weighted = np.einsum("okei,ip->keopi", self.left, waves.mean).reshape(outputs, 1, elements, -1, azimuths)
        whole = sum(part @ kernel for part, kernel in zip(weighted, self.kernel, strict=True))  # N is not copied.
        assert not isinstance(whole, int)
        return np.moveaxis(whole, 0, 2).reshape(elements, forces, -1, self.kernel.shape[1], azimuths)

    def by_channel(self, by_inputs: Array, channel: int) -> Array:
        """∂ of the same means by one channel at all azimuths, (forces, waves, elements, azimuths)."""
        return np.einsum("eoplj,lej->opej", by_inputs, self.right[:, channel])

    def add_between(
        self, by_inputs: Array, structure: Structure, phi: Array, psi: Array, waves: WaveGrid, out: Array
    ) -> None:
        """Add ∂ of the measures by the coefficients of the shapes, (coefficients, measures).

        phi, psi: shapes and weights along the blade. Derivatives are those of an element at all azimuths, so all
        products of two waves are formed, not only their sums.
        """
        row, wave = np.divmod(structure.coefficient_places, structure.waves)
        weight, other = np.divmod(structure.measure_places, structure.waves)
        elements, count = len(by_inputs), structure.waves
        for channel, right in enumerate(self.right.swapaxes(0, 1)):
            begin, end = structure.first_row[channel : channel + 2].tolist()
            columns = np.flatnonzero((row >= begin) & (row < end))
            if not (len(columns) and right.any()):
                continue
            onto = (right[:, None] * waves.at[:, None]).transpose(2, 0, 3, 1).reshape(elements, -1, count)
            for force, left in enumerate(self.left):
                first, last = structure.first_weight[force : force + 2].tolist()
                measures = np.flatnonzero((weight >= first) & (weight < last))
                if not (len(measures) and left.any()):
                    continue
                between = by_inputs[:, force].reshape(elements, count, -1) @ onto
                pairs = (psi[first:last, None] * phi[None, begin:end]).reshape(-1, elements)
                product = (pairs @ between.reshape(elements, -1)).reshape(last - first, end - begin, count, count)
                place, shape = weight[measures] - first, (row[columns] - begin)[:, None]
                out[np.ix_(columns, 1 + measures)] += product[place, shape, other[measures], wave[columns][:, None]]
