"""What forces remember: derivatives by the channels at other azimuths of the same element.

A section whose forces follow lags has, beside the partial derivatives at a point, F_o(ψ) += ∫ … c(ψ'):

    ∂F_o(r, ψ)/∂c(r, ψ') = Σ L_ok(r, ψ) N_kl(r, ψ, ψ') R_lc(r, ψ')

L: forces by what is remembered; N: that by its inputs around the azimuth; R: inputs by channels. No waves come out of
it in pairs, so products of measures and columns are formed at all azimuths of an element.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array


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
        out = np.einsum("kleij,lej->kei", self.kernel, given, optimize=True)
        return np.einsum("okei,kei->oei", self.left, out)

    def transposed(self, forces: Array) -> Array:
        """From weights on the forces, (forces, elements, azimuths), to the channels, (channels, elements, azimuths)."""
        outputs = np.einsum("oei,okei->kei", forces, self.left)
        inputs = np.einsum("kei,kleij->lej", outputs, self.kernel, optimize=True)
        return np.einsum("lej,lcej->cej", inputs, self.right)
