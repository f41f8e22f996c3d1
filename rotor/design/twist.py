"""Twist laws θ_tw(r): how the blade is pre-twisted along its radius.

Every law returns radians, nose-up positive, for r = y/R, and is zero at 0.75 R, so that the collective is the
pitch at 0.75 R whatever the law. Rates are radians per radius.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from rotor.arrays import Array

REFERENCE_RADIUS = 0.75
"""r/R where every twist law is zero."""


@runtime_checkable
class TwistLaw(Protocol):
    """A function that gives the built-in pitch along the blade."""

    def __call__(self, r: ArrayLike) -> Array:
        """Built-in twist at r = y/R [rad], zero at 0.75 R; same shape as r."""
        ...

    def spec(self) -> str:
        """The law as `parse_twist` reads it."""
        ...


@dataclass(frozen=True)
class LinearTwist:
    """θ_tw = rate (r − 0.75)."""

    rate: float
    """[rad per radius], negative when the tip is nose-down."""

    def __call__(self, r: ArrayLike) -> Array:
        return self.rate * (np.asarray(r, dtype=float) - REFERENCE_RADIUS)

    def spec(self) -> str:
        return f"linear:{_degrees(self.rate)}"


@dataclass(frozen=True)
class QuadraticTwist:
    """θ_tw = a r² + b r + c, with a + b the tip-minus-root difference (thesis §4.1.2)."""

    curvature: float
    """a, the second-order coefficient [rad per radius²]."""
    difference: float
    """θ(r=1) − θ(r=0) [rad], so that curvature 0 is the linear law of that rate."""

    def __call__(self, r: ArrayLike) -> Array:
        r = np.asarray(r, dtype=float)
        slope = self.difference - self.curvature
        return self.curvature * (r**2 - REFERENCE_RADIUS**2) + slope * (r - REFERENCE_RADIUS)

    def spec(self) -> str:
        return f"quadratic:{_degrees(self.curvature)},{_degrees(self.difference)}"


@dataclass(frozen=True)
class PiecewiseLinearTwist:
    """Linear segments, continuous at movable breaks (thesis §4.1.3–4.1.5)."""

    rates: tuple[float, ...]
    """[rad per radius], root to tip, one per segment."""
    breaks: tuple[float, ...]
    """r/R of the divisions, ascending, one fewer than the rates."""

    def __post_init__(self) -> None:
        if len(self.breaks) != len(self.rates) - 1:
            raise ValueError(
                f"{len(self.rates)} segment rates need {len(self.rates) - 1} break(s), {len(self.breaks)} given: "
                "write for example segments:-12,-4@0.5"
            )
        ends = (0.0, *self.breaks, 1.0)
        if any(low >= high for low, high in pairwise(ends)):
            raise ValueError(f"segment breaks {list(self.breaks)} must ascend between 0 and 1: reorder or move them")

    def __call__(self, r: ArrayLike) -> Array:
        r = np.asarray(r, dtype=float)
        knots = np.array((0.0, *self.breaks, 1.0))
        values = np.concatenate(([0.0], np.cumsum(np.array(self.rates) * np.diff(knots))))
        return np.interp(r, knots, values) - np.interp(REFERENCE_RADIUS, knots, values)

    def spec(self) -> str:
        rates = ",".join(_degrees(rate) for rate in self.rates)
        return f"segments:{rates}" + (f"@{','.join(f'{b:.10g}' for b in self.breaks)}" if self.breaks else "")


@dataclass(frozen=True)
class SplineTwist:
    """A smooth curve through a few angles: the cubic spline without knots at the second and last but one station.

    It represents every linear and quadratic law exactly.
    """

    stations: tuple[float, ...]
    """r/R, ascending, four or more."""
    angles: tuple[float, ...]
    """[rad]; shifted so that the law is zero at 0.75 R."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.angles) or len(self.stations) < 4:
            raise ValueError(
                f"{len(self.angles)} spline angles at {len(self.stations)} stations: give four or more of each, "
                "for example spline:9,6,0,-5@0.13,0.4,0.75,1"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(f"spline stations {list(self.stations)} must ascend: reorder or move them")
        if not (self.stations[0] >= 0.0 and self.stations[-1] <= 1.0):
            raise ValueError(f"spline stations {list(self.stations)} must lie within 0…1: give them as r/R")

    def __call__(self, r: ArrayLike) -> Array:
        radii = np.asarray(r, dtype=float)
        angles = np.array(self.angles)
        return spline_basis(self.stations, radii) @ angles - spline_basis(self.stations, REFERENCE_RADIUS) @ angles

    def spec(self) -> str:
        angles = ",".join(_degrees(angle) for angle in self.angles)
        return f"spline:{angles}@{','.join(f'{station:.10g}' for station in self.stations)}"


@dataclass(frozen=True)
class SumTwist:
    """A twist law plus a change, as an actuator adds one to the blade as built."""

    base: TwistLaw
    change: TwistLaw

    def __call__(self, r: ArrayLike) -> Array:
        return self.base(r) + self.change(r)

    def spec(self) -> str:
        return f"{self.base.spec()}+{self.change.spec()}"


@dataclass(frozen=True)
class IdealTwist:
    """θ = θ_tip / r, eq. (1.1): uniform inflow in hover when the collective puts θ_tip at the tip.

    Source: thesis eq. (1.1), p. 2. Singular at r = 0, so it needs a root cut-out.
    """

    tip_pitch: float
    """θ_tip [rad]."""

    def __call__(self, r: ArrayLike) -> Array:
        return self.tip_pitch * (1.0 / np.asarray(r, dtype=float) - 1.0 / REFERENCE_RADIUS)

    def spec(self) -> str:
        return f"ideal:{_degrees(self.tip_pitch)}"


@dataclass(frozen=True)
class TableTwist:
    """Linear interpolation between stations; constant beyond the first and last."""

    stations: tuple[float, ...]
    """r/R, ascending."""
    angles: tuple[float, ...]
    """[rad]; shifted so that the law is zero at 0.75 R."""
    name: str = "table"
    """Name of the law in a SPEC: a shipped rotor's name, or table:FILE."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.angles) or len(self.stations) < 2:
            raise ValueError(
                f"a twist table needs two or more stations with one angle each; {len(self.stations)} radii and "
                f"{len(self.angles)} angles given: complete the rows"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(f"twist table radii {list(self.stations)} must ascend: sort the rows, one row per radius")

    def __call__(self, r: ArrayLike) -> Array:
        zero = np.interp(REFERENCE_RADIUS, self.stations, self.angles)
        return np.interp(np.asarray(r, dtype=float), self.stations, self.angles) - zero

    def spec(self) -> str:
        return self.name


def _degrees(angle: float) -> str:
    return f"{round(math.degrees(angle), 6):.10g}"


def ideal_tip_pitch(ct: float, solidity: float, lift_slope: float) -> float:
    """θ_tip [rad] of the ideal twist θ_tip/r, eq. (1.1), that carries C_T in hover with uniform inflow.

    From ½σa(θ_tip − λ) r = 4λ² r with λ = √(C_T/2): θ_tip = 4C_T/(σa) + √(C_T/2).
    """
    return 4.0 * ct / (solidity * lift_slope) + math.sqrt(ct / 2.0)


def spline_basis(knots: tuple[float, ...], x: ArrayLike, *, derivative: int = 0) -> Array:
    """B with spline(x) = B · values at the knots, (…, knots); end condition not-a-knot."""
    return np.asarray(_spline(knots)(np.asarray(x, dtype=float), derivative))


@lru_cache(maxsize=32)
def _spline(knots: tuple[float, ...]) -> CubicSpline:
    return CubicSpline(knots, np.eye(len(knots)))
