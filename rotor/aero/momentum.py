"""Momentum theory: the ideal rotor in hover, climb and forward flight (thesis §2.1, §2.4, §2.5).

Coefficients are of ρA(ΩR)² and ρA(ΩR)³ (eqs. 2.11, 2.12); inflow ratios are velocities over ΩR, positive down.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from rotor.arrays import Array

WAKE_CONTRACTION = 0.5
"""A∞/A of the hovering ideal rotor, eq. (2.8)."""


def hover_induced_velocity(thrust: float, density: float, area: float) -> float:
    """v_h = √(T/2ρA) [m/s], eq. (2.9); thrust [N], density [kg/m³], area [m²]."""
    return math.sqrt(thrust / (2.0 * density * area))


def ideal_power(thrust: float, density: float, area: float) -> float:
    """P = T v_h [W] of the ideal hovering rotor, eq. (2.10)."""
    return thrust * hover_induced_velocity(thrust, density, area)


def thrust_coefficient(thrust: float, density: float, area: float, tip_speed: float) -> float:
    """C_T = T/(ρA V_tip²), eq. (2.11)."""
    return thrust / (density * area * tip_speed**2)


def power_coefficient(power: float, density: float, area: float, tip_speed: float) -> float:
    """C_P = P/(ρA V_tip³), eq. (2.12)."""
    return power / (density * area * tip_speed**3)


def annulus_thrust(r: ArrayLike, inflow: ArrayLike, climb: float = 0.0) -> Array:
    """dC_T/dr = 4λ(λ − λ_c) r of an annulus, eqs. (2.22)–(2.24)."""
    inflow = np.asarray(inflow, dtype=float)
    return 4.0 * inflow * (inflow - climb) * np.asarray(r, dtype=float)


def annulus_power(r: ArrayLike, inflow: ArrayLike, climb: float = 0.0) -> Array:
    """dC_P/dr = 4λ²(λ − λ_c) r of an annulus, eq. (2.25): induced and climb power.

    Eqs. (2.26) and (2.27) print the integrals of these two with (λ − λ_c)²; the exponent is a misprint, as
    (2.24), (2.25) and a uniform inflow show: C_T = 2λ², not 2λ³.
    """
    return np.asarray(inflow, dtype=float) * annulus_thrust(r, inflow, climb)


def glauert_inflow(ct: float, mu_x: float, mu_z: float) -> tuple[float, float]:
    """λ0 = C_T/(2√(µ_x² + (µ_z + λ0)²)) and its slope dλ0/dC_T; eq. (2.30) with the axial flow of a tilted disk.

    For C_T ≥ 0 and µ_z ≥ 0 the root is unique. C_T below zero gives the mirrored root.
    """
    sign = -1.0 if ct < 0.0 else 1.0
    half = 0.5 * abs(ct)
    axial = sign * mu_z
    # λ V(λ) = C_T/2 rises with λ, so the root lies between the two one-flow limits and Newton from above is safe.
    inflow = math.sqrt(half) + max(-axial, 0.0)
    for _ in range(60):
        speed = math.hypot(mu_x, axial + inflow)
        if speed == 0.0:
            return 0.0, 0.0
        error = inflow * speed - half
        slope = speed + inflow * (axial + inflow) / speed
        step = error / slope
        inflow -= step
        if abs(step) <= 1e-15 + 1e-14 * abs(inflow):
            break
    speed = math.hypot(mu_x, axial + inflow)
    slope = speed + inflow * (axial + inflow) / speed if speed > 0.0 else math.inf
    return sign * inflow, 0.5 / slope


def skew_angle(mu_x: float, mu_z: float, lambda0: float) -> float:
    """χ = arctan(µ_x/(µ_z + λ0)) [rad], eq. (2.31): 0 in hover, towards π/2 at speed."""
    return math.atan2(mu_x, mu_z + lambda0)
