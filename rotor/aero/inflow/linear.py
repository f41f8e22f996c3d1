"""Linear inflow in forward flight: λ_i = λ0 (1 + k_x r cos ψ + k_y r sin ψ), eqs. (2.29), (3.4).

Eq. (2.29) prints φ for ψ; (3.4) is right. The models differ in k_x and k_y only. None of them responds to the load
distribution, so with them induced power does not depend on twist.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import AnyField, InflowFeedback, Wake
from rotor.arrays import Array
from rotor.compiled import compiled

Gradient = tuple[float, float, float]
"""A gradient k with its slopes by µ_x and by the axial flow µ_z + λ0."""


@dataclass(frozen=True)
class LinearInflow(AnyField):
    """A first-harmonic inflow model."""

    name: str
    title: str
    explanation: str
    """One line for the page: what the model is, and its source."""
    longitudinal: Callable[[Wake], Gradient]
    """k_x"""
    lateral: Callable[[Wake], Gradient]
    """k_y"""

    load_dependent = False

    def without_tip_loss(self) -> "LinearInflow":
        """Itself: the factor is on the section lift."""
        return self

    def with_wake_geometry(self, expected: Wake) -> "LinearInflow":
        """Itself: the wake follows the trim."""
        del expected
        return self

    def respond(self, disk: Disk, wake: Wake, load: Array) -> "PrescribedResponse":
        """The prescribed field; the load is ignored."""
        del load
        return self.field(disk.r, disk.cos, disk.sin, wake)

    def field(self, r: Array, cos: Array, sin: Array, wake: Wake) -> "PrescribedResponse":
        """The same at radii (n,) and azimuths given by cos ψ, sin ψ (m,)."""
        return PrescribedResponse(r, cos, sin, wake.lambda0, self.longitudinal(wake), self.lateral(wake))


class PrescribedResponse:
    """The response of a prescribed inflow, A = 0."""

    def __init__(self, r: Array, cos: Array, sin: Array, lambda0: float, kx: Gradient, ky: Gradient) -> None:
        self._r, self._lambda0, self._kx, self._ky = r, lambda0, kx, ky
        self._around = cos, sin
        self._by_wake: Array | None = None
        self.induced: Array = _field(r, cos, sin, lambda0, kx[0], ky[0])
        """λ_i, (elements, azimuths)."""

    @property
    def by_wake(self) -> Array:
        """Its slopes by (µ_x, µ_z, λ0), (3, elements, azimuths)."""
        found = self._by_wake
        if found is None:
            self._by_wake = found = _slopes(self._r, *self._around, self._lambda0, self._kx, self._ky)
        return found

    def around(self, cos: Array, sin: Array) -> "PrescribedResponse":
        """The same inflow at other azimuths."""
        return PrescribedResponse(self._r, cos, sin, self._lambda0, self._kx, self._ky)

    @property
    def coordinates(self) -> Array:
        """As `InflowResponse`."""
        return self.induced.ravel()

    def apply(self, fields: Array) -> Array:
        """Zero: the load does not change a prescribed inflow."""
        return np.zeros_like(fields)

    def apply_transposed(self, field: Array) -> Array:
        """Zero: the load does not change a prescribed inflow."""
        return np.zeros_like(field)

    def feedback(self, slope: Array) -> InflowFeedback:
        """No feedback."""
        del slope
        return _NoFeedback()


@compiled()
def _field(r: Any, cos: Any, sin: Any, lambda0: float, kx: float, ky: float) -> Any:
    """λ_i"""
    out = np.empty((len(r), len(cos)))
    for i in range(len(r)):
        for j in range(len(cos)):
            out[i, j] = lambda0 * (1.0 + r[i] * (kx * cos[j] + ky * sin[j]))
    return out


@compiled()
def _slopes(r: Any, cos: Any, sin: Any, lambda0: float, kx: Any, ky: Any) -> Any:
    """The slopes of λ_i from k_x and k_y with their slopes by µ_x and by the axial flow."""
    n, m = len(r), len(cos)
    out = np.empty((3, n, m))
    for i in range(n):
        for j in range(m):
            by_axial = lambda0 * r[i] * (kx[2] * cos[j] + ky[2] * sin[j])
            out[0, i, j] = lambda0 * r[i] * (kx[1] * cos[j] + ky[1] * sin[j])
            out[1, i, j] = by_axial
            out[2, i, j] = 1.0 + r[i] * (kx[0] * cos[j] + ky[0] * sin[j]) + by_axial
    return out


class _NoFeedback:
    def solve(self, fields: Array) -> Array:
        return fields

    def solve_transposed(self, field: Array) -> tuple[Array, Array]:
        return field, np.zeros_like(field)


def _zero(wake: Wake) -> Gradient:
    del wake
    return 0.0, 0.0, 0.0


def _half_skew(wake: Wake) -> Gradient:
    """tan(χ/2) = µ_x/(V + |µ_z + λ0|), regular from hover to edgewise flight and on to upflow.

    In upflow the wake is above the disk, the mirror image of one below with the same angle, and induces the same.
    """
    size = abs(wake.axial)
    total = wake.speed + size
    slope = wake.mu_x / (wake.speed * total)
    return wake.mu_x / total, size / (wake.speed * total), -math.copysign(slope, wake.axial)


def _scaled_half_skew(gain: float) -> Callable[[Wake], Gradient]:
    def gradient(wake: Wake) -> Gradient:
        value, by_mu, by_axial = _half_skew(wake)
        return gain * value, gain * by_mu, gain * by_axial

    return gradient


def _drees_longitudinal(wake: Wake) -> Gradient:
    """(4/3)(1 − cos χ − 1.8µ²)/sin χ, written with sin χ = µ_x/V so that hover is regular."""
    value, by_mu, by_axial = _half_skew(wake)
    scale = 4.0 / 3.0
    speed = wake.speed
    return (
        scale * (value - 1.8 * wake.mu_x * speed),
        scale * (by_mu - 1.8 * (speed + wake.mu_x**2 / speed)),
        scale * (by_axial - 1.8 * wake.mu_x * wake.axial / speed),
    )


def _drees_lateral(wake: Wake) -> Gradient:
    return -2.0 * wake.mu_x, -2.0, 0.0


def _white_blake(wake: Wake) -> Gradient:
    """√2 sin χ."""
    cube = wake.speed**3
    root = math.sqrt(2.0)
    return root * wake.mu_x / wake.speed, root * wake.axial**2 / cube, -root * wake.mu_x * wake.axial / cube


LINEAR_MODELS = (
    LinearInflow("uniform", "Uniform", "Glauert's mean inflow everywhere: no fore-aft gradient.", _zero, _zero),
    LinearInflow(
        "coleman", "Coleman", "kx = tan(χ/2), from a uniformly loaded skewed vortex cylinder (1945).",
        _scaled_half_skew(1.0), _zero,
    ),
    LinearInflow(
        "drees", "Drees", "kx = 4/3 (1 − cos χ − 1.8µ²)/sin χ and a lateral ky = −2µ (1949).",
        _drees_longitudinal, _drees_lateral,
    ),
    LinearInflow("white-blake", "White–Blake", "kx = √2 sin χ, a stronger gradient (1979).", _white_blake, _zero),
    LinearInflow(
        "pitt-peters", "Pitt–Peters (15π/32)", "kx = 15π/32 tan(χ/2): the three-state Pitt–Peters theory, steady.",
        _scaled_half_skew(15.0 * math.pi / 32.0), _zero,
    ),
    LinearInflow(
        "pitt-peters-15pi/23", "Pitt–Peters (15π/23 as printed)",
        "kx = 15π/23 tan(χ/2), eq. (2.32) as the document prints it; closer to measured gradients.",
        _scaled_half_skew(15.0 * math.pi / 23.0), _zero,
    ),
)  # fmt: skip
