"""Friction of the air that flows along the blade in forward flight.

Section data hold for the flow across the blade. With U_R = µ_x cos ψ along it as well, skin friction follows the yawed
velocity V = √(U_T² + U_R²) (Harris, J. AHS 11(3), 1966; Johnson, Helicopter Theory, 1980): per length

    dF_x = ½σ c_f (V − |U_T|) U_T        dF_r = ½σ c_f V U_R

beyond what the section data hold. The dissipation of these is U_T dF_x + U_R dF_r, and dF_r adds to C_H. Pressure drag
does not follow the yawed velocity. U_P is left out of V: it changes the result by its square.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rotor.aero.disk import Disk
from rotor.arrays import Array, Booleans
from rotor.compiled import compiled


def skin_friction(reynolds: float) -> float:
    """c_f of both sides of a turbulent flat plate, 0.91/(log10 Re)^2.58 (Prandtl and Schlichting); Re of the chord."""
    return 0.91 / math.log10(max(reynolds, 1e4)) ** 2.58


@dataclass(frozen=True, eq=False)
class RadialFriction:
    """Forces beyond the section data and their slopes by µ_x, (elements, azimuths)."""

    disk: Disk
    mu_x: float
    coefficient: float
    """c_f"""
    unloaded: Booleans | None = None
    """Elements without any load, (elements, azimuths)."""

    @property
    def fx(self) -> Array:
        return self._forces[0]

    @property
    def radial(self) -> Array:
        """dF_r, outward."""
        return self._forces[1]

    @property
    def fx_slope(self) -> Array:
        return self._slopes[0]

    @property
    def radial_slope(self) -> Array:
        return self._slopes[1]

    @cached_property
    def _forces(self) -> Array:
        return self._on_loaded(_forces)

    @cached_property
    def _slopes(self) -> Array:
        return self._on_loaded(_slopes)

    def _on_loaded(self, fields: Callable[..., Array]) -> Array:
        disk = self.disk
        out = fields(disk.r, disk.cos, disk.sin, self.coefficient * disk.half_solidity, self.mu_x)
        if self.unloaded is not None:
            out[:, self.unloaded] = 0.0
        return out


_TINY = 1e-30
"""Added to squares of velocities, so that nothing divides by zero."""

_compile = compiled(error_model="numpy")


@_compile
def _forces(r: Any, cos: Any, sin: Any, gain: Any, mu_x: float) -> Any:
    """F_x and F_r, (2, elements, azimuths); gain: ½σ c_f, (elements,)."""
    out = np.zeros((2, len(r), len(cos)))
    for i in range(len(r)):
        friction_of_row(r[i], cos, sin, gain[i], mu_x, out[0, i], out[1, i])
    return out


@_compile
def friction_of_row(r: float, cos: Any, sin: Any, gain: float, mu_x: float, fx: Any, radial: Any) -> None:
    """F_r of one row, and its F_x added to `fx`."""
    for j in range(len(cos)):
        across, along = r + mu_x * sin[j], mu_x * cos[j]
        speed = math.sqrt(across * across + along * along + _TINY)
        fx[j] += gain * (speed - abs(across)) * across
        radial[j] = gain * speed * along


@_compile
def _slopes(r: Any, cos: Any, sin: Any, gain: Any, mu_x: float) -> Any:
    """Their slopes by µ_x."""
    out = np.empty((2, len(r), len(cos)))
    for i in range(len(r)):
        friction_slopes_of_row(r[i], cos, sin, gain[i], mu_x, out[0, i], out[1, i])
    return out


@_compile
def friction_slopes_of_row(r: float, cos: Any, sin: Any, gain: float, mu_x: float, fx: Any, radial: Any) -> None:
    """Slopes by µ_x of F_x and F_r of one row."""
    for j in range(len(cos)):
        across, along = r + mu_x * sin[j], mu_x * cos[j]
        speed = math.sqrt(across * across + along * along + _TINY)
        speed_slope = (across * sin[j] + along * cos[j]) / speed
        excess_slope = speed_slope - math.copysign(1.0, across) * sin[j]
        fx[j] = gain * (excess_slope * across + (speed - abs(across)) * sin[j])
        radial[j] = gain * (speed_slope * along + speed * cos[j])
