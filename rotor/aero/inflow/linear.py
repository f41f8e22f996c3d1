"""Linear inflow in forward flight: λ_i = λ0 (1 + k_x r cos ψ + k_y r sin ψ), eqs. (2.29), (3.4).

Eq. (2.29) prints φ for ψ; (3.4) is right. The models differ in k_x and k_y only, and have their slopes.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotor.aero.inflow.harmonic import HarmonicInflow
from rotor.aero.inflow.interface import DiskFlow
from rotor.engine.waves import COS, SIN
from rotor.support.arrays import Array

Gradient = tuple[float, float, float]
"""A gradient k with its slopes by µ_x and by the axial flow µ_z + λ0."""


def _zero(flow: DiskFlow) -> Gradient:
    del flow
    return 0.0, 0.0, 0.0


@dataclass(frozen=True)
class LinearInflow(HarmonicInflow):
    """A first-harmonic inflow model."""

    name: str
    title: str
    explanation: str
    longitudinal: Callable[[DiskFlow], Gradient]
    """k_x"""
    lateral: Callable[[DiskFlow], Gradient] = _zero
    """k_y"""
    usual: bool = False
    in_index_band: bool = False

    columns = (COS, "r"), (SIN, "r")

    def along(self, r: Array) -> dict[str, Array]:
        return {"r": r}

    def gains(self, flow: DiskFlow) -> tuple[float, float]:
        """k_x and k_y."""
        return self.longitudinal(flow)[0], self.lateral(flow)[0]

    def strengths(self, flow: DiskFlow) -> Array:
        """λ0 k_x and λ0 k_y with their slopes by (µ_x, µ_z, λ0), by hand, (2, 4)."""
        gradients = self.longitudinal(flow), self.lateral(flow)
        return np.array(
            [(value, *slopes) for value, slopes in (of_mean(k, flow.lambda0) for k in gradients)]
        )


def of_mean(gradient: Gradient, lambda0: float) -> tuple[float, tuple[float, float, float]]:
    """λ0 k, and its slopes by (µ_x, µ_z, λ0), by the product rule."""
    k, by_mu, by_axial = gradient
    return lambda0 * k, (lambda0 * by_mu, lambda0 * by_axial, k + lambda0 * by_axial)


def half_skew(flow: DiskFlow) -> Gradient:
    """tan(χ/2) = µ_x/(V + |µ_z + λ0|), regular from hover to edgewise flight and on to upflow.

    In upflow the wake is above the disk, the mirror image of one below with the same angle, and induces the same.
    """
    size = abs(flow.axial)
    total = flow.speed + size
    slope = flow.mu_x / (flow.speed * total)
    return flow.mu_x / total, size / (flow.speed * total), -math.copysign(slope, flow.axial)


def scaled_half_skew(gain: float) -> Callable[[DiskFlow], Gradient]:
    """k = gain · tan(χ/2), see `half_skew`."""

    def gradient(flow: DiskFlow) -> Gradient:
        value, by_mu, by_axial = half_skew(flow)
        return gain * value, gain * by_mu, gain * by_axial

    return gradient


def _drees_longitudinal(flow: DiskFlow) -> Gradient:
    """(4/3)(1 − cos χ − 1.8µ²)/sin χ, written with sin χ = µ_x/V so that hover is regular."""
    value, by_mu, by_axial = half_skew(flow)
    scale = 4.0 / 3.0
    speed = flow.speed
    return (
        scale * (value - 1.8 * flow.mu_x * speed),
        scale * (by_mu - 1.8 * (speed + flow.mu_x**2 / speed)),
        scale * (by_axial - 1.8 * flow.mu_x * flow.axial / speed),
    )


def _drees_lateral(flow: DiskFlow) -> Gradient:
    return -2.0 * flow.mu_x, -2.0, 0.0


def _white_blake(flow: DiskFlow) -> Gradient:
    """√2 sin χ."""
    cube = flow.speed**3
    root = math.sqrt(2.0)
    return (
        root * flow.mu_x / flow.speed,
        root * flow.axial**2 / cube,
        -root * flow.mu_x * flow.axial / cube,
    )


MODELS = (
    LinearInflow(
        "uniform", "Uniform", "Glauert's mean inflow everywhere: no fore-aft gradient.", _zero, in_index_band=True,
    ),
    LinearInflow(
        "coleman", "Coleman", "kx = tan(χ/2), from a uniformly loaded skewed vortex cylinder (1945).",
        scaled_half_skew(1.0),
    ),
    LinearInflow(
        "drees", "Drees", "kx = 4/3 (1 − cos χ − 1.8µ²)/sin χ and a lateral ky = −2µ (1949).",
        _drees_longitudinal, _drees_lateral, in_index_band=True,
    ),
    LinearInflow("white-blake", "White–Blake", "kx = √2 sin χ, a stronger gradient (1979).", _white_blake),
    LinearInflow(
        "pitt-peters", "Pitt–Peters (15π/32)", "kx = 15π/32 tan(χ/2): the three-state Pitt–Peters theory, steady.",
        scaled_half_skew(15.0 * math.pi / 32.0), usual=True, in_index_band=True,
    ),
    LinearInflow(
        "pitt-peters-15pi/23", "Pitt–Peters (15π/23 as printed)",
        "kx = 15π/23 tan(χ/2), eq. (2.32) as the document prints it; closer to measured gradients.",
        scaled_half_skew(15.0 * math.pi / 23.0),
    ),
)  # fmt: skip
