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
from rotor.aero.inflow.interface import Atoms, DiskFlow, Followed, InflowModel, InflowTerms, Losses
from rotor.aero.lifting_line import WakeCourse
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


def _zero(flow: DiskFlow) -> Gradient:
    del flow
    return 0.0, 0.0, 0.0


@dataclass(frozen=True)
class LinearInflow(InflowModel):
    """A first-harmonic inflow model."""

    name: str
    title: str
    explanation: str
    longitudinal: Callable[[DiskFlow], Gradient]
    """k_x"""
    lateral: Callable[[DiskFlow], Gradient] = _zero
    """k_y"""

    load_dependent = False

    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> "LinearTerms":
        """The model on a disk."""
        del course
        on_lift = losses.on == "lift"
        return LinearTerms(self, disk, losses) if on_lift else LossyInflowTerms(self, disk, losses)

    def strengths(self, flow: DiskFlow) -> Atoms:
        """λ0 k_x and λ0 k_y, with slopes by (µ_x, µ_z, λ0)."""
        gradients = self.longitudinal(flow), self.lateral(flow)
        return {name: of_mean(gradient, flow.lambda0) for name, gradient in zip(STRENGTHS, gradients, strict=True)}

    def field(self, r: Array, cos: Array, sin: Array, flow: DiskFlow) -> Array:
        """λ_i at radii (n,) and azimuths (m,), and its slopes by (µ_x, µ_z, λ0), (4, n, m)."""
        weights = np.array([[value, *slopes] for value, slopes in self.strengths(flow).values()])
        out = np.tensordot(weights, np.stack([np.outer(r, cos), np.outer(r, sin)]), (0, 0))
        out[0] += flow.lambda0
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
        constant, along = self.names
        kx, ky = (structure.quantity(name) for name in STRENGTHS)
        structure.column(UP, constant, STEADY, 1.0, structure.states["lambda0"])
        structure.column(UP, along, COS, 1.0, kx)
        structure.column(UP, along, SIN, 1.0, ky)

    def shapes(self) -> dict[Shape, Array]:
        """1 and r."""
        return dict(zip(self.names, (np.ones_like(self._disk.r), self._disk.r), strict=True))

    def follow(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> Followed:
        """λ0 k_x, λ0 k_y and the loss factor."""
        return Followed(self._model.strengths(flow), {(LOSS, "loss"): self.factor(flow, mu_z, sees_tilt)})

    def factor(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> tuple[Array, Array]:
        """F, (elements,), averaged over azimuth (thesis p. 24), and its slopes by (µ_x, µ_z, λ0), (3, elements)."""
        disk, (tip, hub, _, spacing) = self._disk, self._losses
        if not (tip or hub):
            return np.ones_like(disk.r), np.zeros((3, len(disk.r)))
        field = self._model.field(disk.r, _COS, _SIN, flow)
        factors = mean_loss_factor(disk.r, mu_z + field[0], field[1:], (spacing * disk.blades, disk.root), tip, hub)
        if sees_tilt:
            factors[3] += factors[1]  # λ by µ_z itself.
        return factors[0], factors[2:]

    def axial(self, flow: DiskFlow, u_t: Array) -> tuple[Array, Array]:
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
        constant, along = LinearTerms.names
        kx, ky = (structure.derived[name] for name in STRENGTHS)
        lambda0 = structure.states["lambda0"]
        return [(UP, constant, STEADY, lambda0), (UP, along, COS, kx), (UP, along, SIN, ky)]

    def shapes(self) -> dict[Shape, Array]:
        """None that stand still."""
        return {}

    def follow(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> Followed:
        """λ0 k_x, λ0 k_y, 1/F and r/F; F is 0.1 at least, for at the very tip λ_i/F would have no bound."""
        factor, slopes = self.factor(flow, mu_z, sees_tilt)
        free = factor > SMALLEST_TIP_FACTOR
        over = 1.0 / np.where(free, factor, SMALLEST_TIP_FACTOR)
        by_flow = np.where(free, -slopes * over**2, 0.0)
        shapes = zip(LinearTerms.names, (1.0, self._disk.r), strict=True)
        live = {(UP, name): (over * along, by_flow * along) for name, along in shapes}
        return Followed(self._model.strengths(flow), live)


def half_skew(flow: DiskFlow) -> Gradient:
    """tan(χ/2) = µ_x/(V + |µ_z + λ0|), regular from hover to edgewise flight and on to upflow.

    In upflow the wake is above the disk, the mirror image of one below with the same angle, and induces the same.
    """
    size = abs(flow.axial)
    total = flow.speed + size
    slope = flow.mu_x / (flow.speed * total)
    return flow.mu_x / total, size / (flow.speed * total), -math.copysign(slope, flow.axial)


def scaled_half_skew(gain: float) -> Callable[[DiskFlow], Gradient]:
    """k = gain · tan(χ/2)."""

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
    return root * flow.mu_x / flow.speed, root * flow.axial**2 / cube, -root * flow.mu_x * flow.axial / cube


LINEAR_MODELS = (
    LinearInflow("uniform", "Uniform", "Glauert's mean inflow everywhere: no fore-aft gradient.", _zero),
    LinearInflow(
        "coleman",
        "Coleman",
        "kx = tan(χ/2), from a uniformly loaded skewed vortex cylinder (1945).",
        scaled_half_skew(1.0),
    ),
    LinearInflow(
        "drees",
        "Drees",
        "kx = 4/3 (1 − cos χ − 1.8µ²)/sin χ and a lateral ky = −2µ (1949).",
        _drees_longitudinal,
        _drees_lateral,
    ),
    LinearInflow("white-blake", "White–Blake", "kx = √2 sin χ, a stronger gradient (1979).", _white_blake),
    LinearInflow(
        "pitt-peters",
        "Pitt–Peters (15π/32)",
        "kx = 15π/32 tan(χ/2): the three-state Pitt–Peters theory, steady.",
        scaled_half_skew(15.0 * math.pi / 32.0),
    ),
    LinearInflow(
        "pitt-peters-15pi/23",
        "Pitt–Peters (15π/23 as printed)",
        "kx = 15π/23 tan(χ/2), eq. (2.32) as the document prints it; closer to measured gradients.",
        scaled_half_skew(15.0 * math.pi / 23.0),
    ),
)
