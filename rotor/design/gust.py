"""A gust: air that moves up or down where the aircraft flies, beside its climb."""

from dataclasses import dataclass

import numpy as np

from rotor.support.arrays import Array


@dataclass(frozen=True)
class Gust:
    """Vertical motion of the air, steady as the aircraft sees it. For w(r, ψ), derive a frozen dataclass from it."""

    uniform: float = 0.0
    """Of all the air, up [m/s]: rotor, wake and airframe meet a descent at this speed."""

    def over_disk(self, r: Array, psi: Array, order: int = 0) -> Array:
        """Gust [m/s] at r/R and azimuth ψ [rad], up along the shaft, added to `uniform`; order 1: its ψ derivative.

        r and psi broadcast, as the result does. Only the blades meet it: the mean over the disk belongs in `uniform`.
        """
        del order
        return np.zeros(np.broadcast_shapes(r.shape, psi.shape))

    @property
    def axisymmetric(self) -> bool:
        """Whether the gust is the same at all azimuths, which hover requires."""
        r, psi = (
            np.linspace(0.0, 1.0, 16)[:, None],
            np.linspace(0.0, 2.0 * np.pi, 90, endpoint=False),
        )
        return not np.any(self.over_disk(r, psi, 1))
