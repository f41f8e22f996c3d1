"""Linear inflow in forward flight: λ_i = λ0 (1 + k_x r cos ψ + k_y r sin ψ), eqs. (2.29), (3.4).

Eq. (2.29) prints φ for ψ; (3.4) is right. The models differ in k_x and k_y only. None of them responds to the load
distribution.

The loss at the ends of the blades is one of two (`Models.loss_on`). On the lift, F C_l: induced power then all but does
not depend on twist. On the inflow, as eq. (3.3) has it: an annulus whose air moves by F λ_i on average balances
dC_T = 4 F λ_i √(µ² + λ²) r dr, in hover 4 F λ² r dr. Where √(µ² + λ²) hardly depends on F, which is so beyond µ 0.1,
blades with the same load meet λ_i/F. The λ_i of (3.4) is then the mean around the azimuth, whose mean over the disk
(2.30) ties to C_T.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotor.aero.disk import Disk, azimuths_of
from rotor.aero.inflow.interface import Atoms, Followed, InflowModel, InflowTerms, Losses, Wake
from rotor.aero.lifting_line.geometry import WakeCourse
from rotor.aero.losses import SMALLEST_TIP_FACTOR, mean_loss_factor
from rotor.aero.section import LOSS, UP
from rotor.arrays import Array
from rotor.engine.terms import Shape, Structure
from rotor.engine.waves import COS, SIN, STEADY

Gradient = tuple[float, float, float]
"""A gradient k with its slopes by µ_x and by the axial flow µ_z + λ0."""

LOSS_AZIMUTHS = 24
"""Azimuths over which the loss factor is averaged; 24 agree with 360 to 1e-4 in F (tested)."""
_COS, _SIN = np.cos(azimuths_of(LOSS_AZIMUTHS)), np.sin(azimuths_of(LOSS_AZIMUTHS))


@dataclass(frozen=True)
class LinearInflow(InflowModel):
    """A first-harmonic inflow model."""

    name: str
    title: str
    explanation: str
    longitudinal: Callable[[Wake], Gradient]
    """k_x"""
    lateral: Callable[[Wake], Gradient]
    """k_y"""

    load_dependent = False

    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> "LinearTerms":
        """The model on a disk."""
        del course
        on_lift = losses.on == "lift"
        return LinearTerms(self, disk, losses) if on_lift else LossyInflowTerms(self, disk, losses)

    def strengths(self, wake: Wake) -> Atoms:
        """λ0 k_x and λ0 k_y, with slopes by (µ_x, µ_z, λ0)."""
        gradients = self.longitudinal(wake), self.lateral(wake)
        return {name: of_mean(own, wake.lambda0) for name, own in zip(STRENGTHS, gradients, strict=True)}

    def field(self, r: Array, cos: Array, sin: Array, wake: Wake) -> Array:
        """λ_i at radii (n,) and azimuths (m,), and its slopes by (µ_x, µ_z, λ0), (4, n, m)."""
        weights = np.array([[value, *slopes] for value, slopes in self.strengths(wake).values()])
        out = np.tensordot(weights, np.stack([np.outer(r, cos), np.outer(r, sin)]), (0, 0))
        out[0] += wake.lambda0
        out[3] += 1.0
        return out


def of_mean(gradient: Gradient, lambda0: float) -> tuple[float, tuple[float, float, float]]:
    """λ0 k, and its slopes by (µ_x, µ_z, λ0)."""
    k, by_mu, by_axial = gradient
    return lambda0 * k, (lambda0 * by_mu, lambda0 * by_axial, k + lambda0 * by_axial)


STRENGTHS = ("lambda0 kx", "lambda0 ky")
"""Made atoms of linear inflow."""


class LinearTerms(InflowTerms):
    """Linear inflow on a disk: columns 1, r cos ψ and r sin ψ in U_P, and Prandtl's factors on the section lift."""

    key = "linear"
    names = ("inflow", "1"), ("inflow", "r")
    live = ((LOSS, "loss"),)

    def __init__(self, model: LinearInflow, disk: Disk, losses: Losses) -> None:
        self._model, self._disk, self._losses = model, disk, losses

    def build(self, structure: Structure) -> None:
        """The three columns; F is a live shape."""
        one, along = self.names
        kx, ky = (structure.quantity(name) for name in STRENGTHS)
        structure.column(UP, one, STEADY, 1.0, structure.states["lambda0"])
        structure.column(UP, along, COS, 1.0, kx)
        structure.column(UP, along, SIN, 1.0, ky)

    def shapes(self) -> dict[Shape, Array]:
        """1 and r."""
        return dict(zip(self.names, (np.ones_like(self._disk.r), self._disk.r), strict=True))

    def follow(self, wake: Wake, mu_z: float, sees_tilt: bool) -> Followed:
        """λ0 k_x, λ0 k_y and the loss factor."""
        return Followed(self._model.strengths(wake), {(LOSS, "loss"): self.factor(wake, mu_z, sees_tilt)})

    def factor(self, wake: Wake, mu_z: float, sees_tilt: bool) -> tuple[Array, Array]:
        """F, (elements,), averaged over azimuth (thesis p. 24), and its slopes by (µ_x, µ_z, λ0), (3, elements)."""
        disk, (tip, hub, _) = self._disk, self._losses
        if not (tip or hub):
            return np.ones_like(disk.r), np.zeros((3, len(disk.r)))
        field = self._model.field(disk.r, _COS, _SIN, wake)
        found = mean_loss_factor(disk.r, mu_z + field[0], field[1:], (disk.blades, disk.root), tip, hub)
        if sees_tilt:
            found[3] += found[1]  # λ by µ_z itself.
        return found[0], found[2:]

    def axial(self, wake: Wake, u_t: Array) -> tuple[Array, Array]:
        """Zero: the load does not change it."""
        return np.zeros((len(u_t),) * 2), np.zeros((len(u_t),) * 2)


class LossyInflowTerms(LinearTerms):
    """Linear inflow on a disk with Prandtl's factors on the inflow: the three columns are λ_i/F."""

    key = "linear over F"
    live = tuple((UP, name) for name in LinearTerms.names)
    names = (*LinearTerms.names, *((name, by) for name in LinearTerms.names for by in ("tilt", "inflow")))

    def build(self, structure: Structure) -> None:
        """All columns are live."""
        for name in STRENGTHS:
            structure.quantity(name)

    def live_columns(self, structure: Structure) -> list[tuple[int, Shape, int, int]]:
        """λ0/F, λ0 k_x r cos ψ/F and λ0 k_y r sin ψ/F."""
        one, along = LinearTerms.names
        kx, ky = (structure.derived[name] for name in STRENGTHS)
        lambda0 = structure.states["lambda0"]
        return [(UP, one, STEADY, lambda0), (UP, along, COS, kx), (UP, along, SIN, ky)]

    def shapes(self) -> dict[Shape, Array]:
        """None that stand still."""
        return {}

    def follow(self, wake: Wake, mu_z: float, sees_tilt: bool) -> Followed:
        """λ0 k_x, λ0 k_y, 1/F and r/F; F is 0.1 at least, for at the very tip λ_i/F would have no bound."""
        factor, slopes = self.factor(wake, mu_z, sees_tilt)
        free = factor > SMALLEST_TIP_FACTOR
        over = 1.0 / np.where(free, factor, SMALLEST_TIP_FACTOR)
        by_wake = np.where(free, -slopes * over**2, 0.0)
        shapes = zip(LinearTerms.names, (1.0, self._disk.r), strict=True)
        live = {(UP, name): (over * along, by_wake * along) for name, along in shapes}
        return Followed(self._model.strengths(wake), live)


def _zero(wake: Wake) -> Gradient:
    del wake
    return 0.0, 0.0, 0.0


def half_skew(wake: Wake) -> Gradient:
    """tan(χ/2) = µ_x/(V + |µ_z + λ0|), regular from hover to edgewise flight and on to upflow.

    In upflow the wake is above the disk, the mirror image of one below with the same angle, and induces the same.
    """
    size = abs(wake.axial)
    total = wake.speed + size
    slope = wake.mu_x / (wake.speed * total)
    return wake.mu_x / total, size / (wake.speed * total), -math.copysign(slope, wake.axial)


def scaled_half_skew(gain: float) -> Callable[[Wake], Gradient]:
    """k = gain · tan(χ/2)."""

    def gradient(wake: Wake) -> Gradient:
        value, by_mu, by_axial = half_skew(wake)
        return gain * value, gain * by_mu, gain * by_axial

    return gradient


def _drees_longitudinal(wake: Wake) -> Gradient:
    """(4/3)(1 − cos χ − 1.8µ²)/sin χ, written with sin χ = µ_x/V so that hover is regular."""
    value, by_mu, by_axial = half_skew(wake)
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
        scaled_half_skew(1.0), _zero,
    ),
    LinearInflow(
        "drees", "Drees", "kx = 4/3 (1 − cos χ − 1.8µ²)/sin χ and a lateral ky = −2µ (1949).",
        _drees_longitudinal, _drees_lateral,
    ),
    LinearInflow("white-blake", "White–Blake", "kx = √2 sin χ, a stronger gradient (1979).", _white_blake, _zero),
    LinearInflow(
        "pitt-peters", "Pitt–Peters (15π/32)", "kx = 15π/32 tan(χ/2): the three-state Pitt–Peters theory, steady.",
        scaled_half_skew(15.0 * math.pi / 32.0), _zero,
    ),
    LinearInflow(
        "pitt-peters-15pi/23", "Pitt–Peters (15π/23 as printed)",
        "kx = 15π/23 tan(χ/2), eq. (2.32) as the document prints it; closer to measured gradients.",
        scaled_half_skew(15.0 * math.pi / 23.0), _zero,
    ),
)  # fmt: skip
