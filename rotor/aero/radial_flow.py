"""Friction of the air that flows along the blade in forward flight.

Section data hold for the flow across the blade. With U_R = µ_x cos ψ along it as well, skin friction follows the yawed
velocity V = √(U_T² + U_R²) (Harris, J. AHS 11(3), 1966; Johnson, Helicopter Theory, 1980): per length

    dF_x = ½σ c_f (V − |U_T|) U_T        dF_r = ½σ c_f V U_R

beyond what the section data hold. The dissipation of these is U_T dF_x + U_R dF_r, and dF_r adds to C_H. Pressure drag
does not follow the yawed velocity. U_P is left out of V: it changes the result by its square.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotor.aero.disk import Disk
from rotor.arrays import Array
from rotor.compiled import compiled


def skin_friction(reynolds: float) -> float:
    """c_f of both sides of a turbulent flat plate, 0.91/(log10 Re)^2.58 (Prandtl and Schlichting); Re of the chord."""
    return 0.91 / math.log10(max(reynolds, 1e4)) ** 2.58


@dataclass(frozen=True, eq=False)
class RadialFriction:
    """Forces beyond the section data and their slopes by µ_x, (elements, azimuths)."""

    fx: Array
    radial: Array
    """dF_r, outward."""
    fx_slope: Array
    radial_slope: Array


def radial_friction(disk: Disk, mu_x: float, coefficient: float) -> RadialFriction:
    """The friction of radial flow at an advance ratio; `coefficient` is c_f."""
    return RadialFriction(*_friction(disk.r, disk.cos, disk.sin, coefficient * disk.half_solidity, mu_x))


_compile = compiled(error_model="numpy")


@_compile
def _friction(r: Any, cos: Any, sin: Any, gain: Any, mu_x: float) -> Any:
    """The four fields of `RadialFriction`, (4, elements, azimuths); gain: ½σ c_f, (elements,)."""
    n, m = len(r), len(cos)
    out = np.empty((4, n, m))
    for i in range(n):
        for j in range(m):
            across, along = r[i] + mu_x * sin[j], mu_x * cos[j]
            speed = math.sqrt(across * across + along * along + 1e-30)
            excess = speed - abs(across)
            speed_slope = (across * sin[j] + along * cos[j]) / speed
            out[0, i, j] = gain[i] * excess * across
            out[1, i, j] = gain[i] * speed * along
            out[2, i, j] = gain[i] * ((speed_slope - np.sign(across) * sin[j]) * across + excess * sin[j])
            out[3, i, j] = gain[i] * (speed_slope * along + speed * cos[j])
    return out
