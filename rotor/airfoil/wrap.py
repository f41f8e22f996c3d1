"""Closed form of a section's coefficients far beyond stall, and the blend into it.

Nine constants fitted by this project to the NACA 0012 measurements over 0..180 deg of NACA TN 3361
(Critzos, Heyson and Boswinkle 1955), symmetrised; four more for the moment. A 9.5 % section with a sharp
trailing edge behaves alike there: broadside it is a plate, backwards it stalls early at its sharp edge.
The fit is within 0.039 (cl) and 0.014 (cd) rms of the measurements; it is not independent evidence of them.
"""

import numpy as np

from rotor.arrays import Array

BLEND_START_DEG = 16.0  # |alpha| below which the polar stands alone.
BLEND_END_DEG = 26.0  # |alpha| above which the closed form stands alone.

# cl = sum s_k sin(k a) - P (x/w) exp((1 - (x/w)^2)/2), x = 180 deg - |a|: the last term is reverse-flow lift.
_CL_SIN = (0.07290562895790871, 1.0548966550216816)
_REVERSE_PEAK = 0.4137752069896611
_REVERSE_WIDTH_DEG = 7.719281370720392
_CD_COS = (1.1279, -0.0264, -1.03951, -0.02516, -0.0966)  # cd = sum c_k cos(k a), k from 0.
_CM_SIN = (-0.58524, 0.14099, -0.03031, 0.04132)  # cm = sum m_k sin(k a), k from 1, about the quarter chord.


def wrap_coefficients(alpha: Array) -> tuple[Array, Array, Array]:
    """(cl, cd, cm) [-] of the closed form at `alpha` [rad], within -pi..pi; for 20..180 deg either way.

    cl and cm are odd, cd is even; cd lies between 0.043 (backwards) and 2.1 (broadside).
    """
    size = np.abs(alpha)
    x = (np.pi - size) / np.deg2rad(_REVERSE_WIDTH_DEG)
    cl = sum((s * np.sin(k * size) for k, s in enumerate(_CL_SIN, start=1)), np.zeros_like(size))
    cl = np.sign(alpha) * (cl - _REVERSE_PEAK * x * np.exp(0.5 * (1.0 - x * x)))
    cd = sum((c * np.cos(k * size) for k, c in enumerate(_CD_COS)), np.zeros_like(size))
    cm = sum((m * np.sin(k * alpha) for k, m in enumerate(_CM_SIN, start=1)), np.zeros_like(size))
    return cl, cd, cm


def blend_weight(alpha: Array) -> Array:
    """Share of the closed form at `alpha` [rad]: 0 below 16 deg, 1 above 26 deg, a smoothstep between."""
    t = np.clip((np.rad2deg(np.abs(alpha)) - BLEND_START_DEG) / (BLEND_END_DEG - BLEND_START_DEG), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def blend(alpha: Array, cl: Array, cd: Array, cm: Array) -> tuple[Array, Array, Array]:
    """Polar values blended into the closed form: cl and cm linearly, cd in its logarithm so that it stays positive."""
    weight = blend_weight(alpha)
    far_cl, far_cd, far_cm = wrap_coefficients(alpha)
    # Each cd plays no part where its weight is zero: there the polar may be anything, and the series is negative.
    log_near, log_far = np.log(np.where(weight < 1.0, cd, 1.0)), np.log(np.where(weight > 0.0, far_cd, 1.0))
    log_cd = (1.0 - weight) * log_near + weight * log_far
    return (1.0 - weight) * cl + weight * far_cl, np.exp(log_cd), (1.0 - weight) * cm + weight * far_cm
