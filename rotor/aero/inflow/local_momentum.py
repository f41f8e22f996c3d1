"""Local (sector) momentum theory: every point of the disk balances its own load as if it were a rotor by itself.

    λ_i = d/(4 r F V) + λ0 k_x r cos ψ,      V = √(µ_x² + (µ_z + λ0)²)

The first term is the annulus balance (2.24) taken point by point: the part w = p/2V of the linear actuator disk that
leaves out all coupling along the wake. Beyond µ 0.3 it is too favourable: induced power 17–37 % low. The second term
restores the fore-aft gradient of the skewed wake, which does not change the power but corrects the lateral cyclic.

So the section balances itself: it finds λ with λ = g F_z(…, U_P + λ), g = 1/(4 r F V), at every point, and its
derivatives follow by the implicit function theorem, dλ = (g Σ ∂F_z/∂c dc + F_z dg)/(1 − g ∂F_z/∂U_P).
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import (
    DiskFlow,
    FlowTerms,
    InflowModel,
    InflowTerms,
    Losses,
    SectionInterface,
)
from rotor.aero.inflow.linear import of_mean, scaled_half_skew
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.losses import tip_factor
from rotor.aero.section import CHANNELS, FORCES, FR, FX, FZ, LOSS, PAIRS, UP, M, section
from rotor.engine.terms import Shape, Structure
from rotor.engine.waves import COS, STEADY
from rotor.support.arrays import Array
from rotor.support.compiled import compiled

_GRADIENT = scaled_half_skew(15.0 * math.pi / 32.0)
"""k_x: that of the exact actuator disk for a load that vanishes at the hub (three-state theory)."""
_STRENGTH = "lambda0 kx"

GAIN, MEAN = len(CHANNELS), len(CHANNELS) + 1
"""Channels beside those of the section: g, and λ0, from which the search for λ begins."""
BALANCED = len(FORCES)
"""λ, in the place of a further force."""
_LARGEST_INFLOW = 0.6
"""Bracket of λ, far above any annulus of a rotor."""
MOST_PASSES = 80


@compiled(error_model="numpy")
def bracket_of(points: int) -> Any:
    """Lower and upper bound of λ at every point, (points,) each."""
    return np.full(points, -_LARGEST_INFLOW), np.full(points, _LARGEST_INFLOW)


@compiled(error_model="numpy")
def balancing_step(inflow: Any, bracket: Any, error: Any, slope: Any, scale: Any) -> bool:
    """A step of Newton's method in a bracket at every point that is not in balance, in place; False: all are.

    error: residual, slope: its derivative by λ, scale: what it is measured by; all (points,).
    """
    low, high = bracket
    moved = False
    for i in range(len(inflow)):
        if abs(error[i]) <= 1e-15 + 1e-13 * abs(scale[i]) or high[i] - low[i] < 1e-15:
            continue
        moved = True
        if error[i] < 0.0:
            low[i] = inflow[i]
        else:
            high[i] = inflow[i]
        ahead = inflow[i] - error[i] / slope[i] if slope[i] > 0.0 else math.inf
        inflow[i] = ahead if low[i] < ahead < high[i] else 0.5 * (low[i] + high[i])
    return moved


def _sector_section(c: Array, data: Any, slopes: bool, flow: bool) -> tuple[Array, Array, Array]:
    """The section with the inflow that balances its own lift; as `section.section`, with the rows of `_SECTORS`."""
    gain, channels, inflow = c[GAIN], c[:GAIN].copy(), c[MEAN].copy()
    points, bracket = inflow.ravel(), bracket_of(inflow.size)
    for _ in range(MOST_PASSES):
        channels[UP] = c[UP] + inflow
        f, d, _ = section(channels, data, True, False)
        error, slope = inflow - gain * f[FZ], 1.0 - gain * d[_UP_ROW]
        if not balancing_step(points, bracket, error.ravel(), slope.ravel(), points):
            break
    channels[UP] = c[UP] + inflow
    f, d, s = section(channels, data, slopes, flow)
    f = np.concatenate([f, inflow[None]])
    if not slopes:
        return f, d, s
    rigid = len(data.moment_gain) == 0
    unused = [k for k, (o, channel) in enumerate(PAIRS) if channel == LOSS or (o == M and rigid)]
    d[unused] = 0.0
    through = 1.0 / (1.0 - gain * d[_UP_ROW])
    out = np.empty((len(SECTOR_PAIRS), *gain.shape))
    for k, (force, channel) in enumerate(SECTOR_PAIRS):
        follows = (
            f[FZ] * through if channel == GAIN else gain * through * d[PAIRS.index((FZ, channel))]
        )
        if force == BALANCED:
            out[k] = follows
        elif channel == GAIN:
            out[k] = d[PAIRS.index((force, UP))] * follows
        else:
            own = d[PAIRS.index((force, channel))] if (force, channel) in PAIRS else 0.0
            out[k] = own + d[PAIRS.index((force, UP))] * follows
    rest = [k for k, pair in enumerate(PAIRS) if pair not in SECTOR_PAIRS]
    return f, np.concatenate([out, d[rest]]), s


_UP_ROW = PAIRS.index((FZ, UP))
_FOLLOWED = tuple(channel for force, channel in PAIRS if force == FZ)
SECTOR_PAIRS = tuple(
    (force, channel) for force in (FZ, FX, FR, M, BALANCED) for channel in (*_FOLLOWED, GAIN)
)
"""Forces that follow the inflow, and the channels that the inflow follows."""


_SECTORS = SectionInterface(
    _sector_section,
    (*SECTOR_PAIRS, *(pair for pair in PAIRS if pair not in SECTOR_PAIRS)),
    len(CHANNELS) + 2,
    len(FORCES) + 1,
    BALANCED,
)


@dataclass(frozen=True)
class LocalMomentumInflow(InflowModel):
    """The inflow at a point depends on the load at that point alone."""

    name = "local-momentum"
    title = "Local momentum (sectors)"
    explanation = (
        "Each sector responds to its own load, plus a fore-aft gradient: "
        "induced power 17–37 % low above µ 0.3."
    )
    pointwise = False
    load_dependent = True

    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> "SectorTerms":
        """The model on a disk."""
        del course
        return SectorTerms(disk, losses.spacing if losses.tip else math.inf)


class SectorTerms(InflowTerms):
    """Local momentum theory on a disk: one column for the gradient, and a section that balances itself."""

    key = "sectors"
    names = (("inflow", "r"),)
    live = ((GAIN, "gain"),)
    interface = _SECTORS

    def __init__(self, disk: Disk, spacing: float) -> None:
        self._disk, self._spacing = disk, spacing

    def build(self, structure: Structure) -> None:
        """λ0 k_x r cos ψ in U_P; the gain is a live shape."""
        structure.column(UP, self.names[0], COS, 1.0, structure.quantity(_STRENGTH))
        structure.column(MEAN, "one", STEADY, 1.0, structure.states["lambda0"])

    def shapes(self) -> dict[Shape, Array]:
        """r"""
        return {self.names[0]: self._disk.r}

    def follow(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> FlowTerms:
        """λ0 k_x and the gain 1/(4 r F V)."""
        del mu_z, sees_tilt
        gradient = of_mean(_GRADIENT(flow), flow.lambda0)
        return FlowTerms({_STRENGTH: gradient}, {(GAIN, "gain"): self._gain(flow)})

    def _gain(self, flow: DiskFlow) -> tuple[Array, Array]:
        """1/(4 r F V) and its slopes by (µ_x, µ_z, λ0), (elements,) and (3, elements)."""
        disk, speed = self._disk, flow.speed
        factor, factor_slope = tip_factor(disk.r, flow.axial, self._spacing * disk.blades)
        gain = 1.0 / (4.0 * disk.r * factor * speed)
        by_axial = -gain * factor_slope / factor
        by_speed = np.array([flow.mu_x, flow.axial, flow.axial]) / speed**2
        return gain, -np.outer(by_speed, gain) + np.outer([0.0, 1.0, 1.0], by_axial)

    def axial(self, flow: DiskFlow, u_t: Array) -> tuple[Array, Array]:
        """Diagonal: 1/(4 r F V)."""
        return np.diag(self._gain(flow)[0]), np.zeros((len(u_t),) * 2)


MODELS = (LocalMomentumInflow(),)
