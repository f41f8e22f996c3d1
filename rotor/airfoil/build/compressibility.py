"""From a low-speed polar to high subsonic Mach numbers, where XFOIL has no shocks.

XFOIL is used directly up to Mach 0.4. Above, its Mach 0.3 polar is extended by textbook corrections:
Prandtl-Glauert lift, a smooth cap on lift, drag of the lost leading-edge suction, Korn-Lock wave drag.
Three constants were read off public SC1095 tables (NASA CR-166309 deck, UMD RANS), so agreement of the
result with those tables is calibration, not evidence: the cap, KORN_KAPPA, and LIFT_DIVERGENCE_MACH
with LINEAR_RISE_FROM. The suction drag has no fitted constant.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotor.arrays import Array

NATIVE_MACH_LIMIT = 0.4  # Up to here XFOIL is used directly: compared with RANS, its drag is the better one.
INCOMPRESSIBLE_MACH = 0.05  # Up to here a polar's Mach number says nothing about its Reynolds number.
BASE_MACH = 0.3  # The polar that is extended to higher Mach.
LIFT_DIVERGENCE_MACH = 0.75  # The lift slope is constant above: Prandtl-Glauert would go to infinity.
KORN_KAPPA = 0.86  # Technology factor of Korn's relation, fitted to the CR-166309 SC1095 deck.
LINEAR_RISE_FROM = 0.2  # M - M_cr beyond which the wave drag rises linearly; the quartic is far too steep at M 0.9.
FRICTION_REYNOLDS_POWER = -0.16  # Of tripped XFOIL cd at fixed Mach; Reynolds is proportional to Mach here.
CAP_SHARPNESS = 8.0  # Exponent of the smooth cap above Mach 0.4; takes 1 % off at 75 % of the cap.
NATIVE_CAP_SHARPNESS = 16.0  # The same up to Mach 0.4, where lift well below the cap must not change.

# Largest lift coefficient of SC1095 against Mach: own tripped XFOIL to 0.4, then as read off RANS and deck.
_CAP_MACH = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
_CAP_CL = (1.45, 1.45, 1.52, 1.50, 1.43, 1.10, 1.00, 0.93, 0.91, 0.91)


@dataclass(frozen=True)
class SectionTraits:
    """Section parameters of the corrections.

    `thickness` is t/c [-]; `cap_ratio` multiplies the SC1095 cap; `cap_native` says whether XFOIL's own
    lift is capped below Mach 0.4 too; `negative_ratio` is the cap at negative lift over that at positive;
    `korn` is the technology factor of Korn's relation.
    """

    thickness: float
    cap_ratio: float = 1.0
    cap_native: bool = False
    negative_ratio: float = 1.0
    korn: float = KORN_KAPPA


def lift_cap(mach: float, traits: SectionTraits) -> float:
    """Largest positive lift coefficient [-] at `mach`, monotone between the read-off values."""
    return float(PchipInterpolator(_CAP_MACH, _CAP_CL)(mach)) * traits.cap_ratio


def smooth_cap(cl: Array, upper: float, lower: float, sharpness: float = CAP_SHARPNESS) -> Array:
    """`cl` limited smoothly to -`lower`..`upper`: x / (1 + |x/cap|^n)^(1/n), n = `sharpness`."""
    cap = np.where(cl >= 0.0, upper, lower)
    return np.asarray(cl / (1.0 + np.abs(cl / cap) ** sharpness) ** (1.0 / sharpness), dtype=np.float64)


def prandtl_glauert(mach: float, base: float = BASE_MACH) -> float:
    """Growth of lift from `base` to `mach`: sqrt(1 - M0^2) / sqrt(1 - M^2), constant above lift divergence."""
    held = min(mach, LIFT_DIVERGENCE_MACH)
    return float(np.sqrt((1.0 - base**2) / (1.0 - held**2)))


def wave_drag(mach: float, cl: Array, thickness: float, korn: float = KORN_KAPPA) -> Array:
    """Wave drag coefficient [-] by Korn's relation and Lock's fourth-power law, for an unswept section.

    M_dd = kappa - t/c - |cl|/10, M_cr = M_dd - (0.1/80)^(1/3), cd = 20 (M - M_cr)^4 (Mason 1990),
    continued with its own slope beyond M - M_cr = LINEAR_RISE_FROM.
    """
    critical = korn - thickness - np.abs(cl) / 10.0 - (0.1 / 80.0) ** (1.0 / 3.0)
    excess = np.maximum(mach - critical, 0.0)
    quartic = np.minimum(excess, LINEAR_RISE_FROM)
    return 20.0 * quartic**4 + 80.0 * LINEAR_RISE_FROM**3 * (excess - quartic)


def with_lost_suction(alpha: Array, potential_cl: Array, cl: Array, cd: Array) -> Array:
    """`cd` [-] plus the drag of the leading-edge suction that goes with the lost lift, (cl_potential - cl) tan(alpha).

    `alpha` [rad], below 90 deg. Attached flow tilts the normal force forward by the suction; lost lift has
    none. With no suction left the force is normal to the chord, so that pressure drag (all above the least
    `cd`) can be no more than cl tan(alpha); where the polar itself has more, its value is kept.
    """
    lean = np.tan(np.abs(alpha))
    pressure = cd - np.min(cd)
    full = np.maximum(np.abs(cl) * lean, pressure)
    return np.min(cd) + np.minimum(pressure + np.abs(potential_cl - cl) * lean, full)


def corrected_polar(
    mach: float, alpha: Array, cl: Array, cd: Array, cm: Array, traits: SectionTraits,
    base: float = BASE_MACH,
) -> tuple[Array, Array, Array]:  # fmt: skip
    """(cl, cd, cm) at a `mach` beyond the polars, from the polar at `base`; `alpha` [rad] within +-0.5."""
    growth = prandtl_glauert(mach, base)
    cap = lift_cap(mach, traits)
    lifted = smooth_cap(cl * growth, cap, cap * traits.negative_ratio)
    # A polar at Mach 0 is incompressible, not of a rotor at rest: its Reynolds number is the one meant.
    reynolds_ratio = mach / base if base > INCOMPRESSIBLE_MACH else 1.0
    friction = float(np.min(cd)) * (1.0 - reynolds_ratio**FRICTION_REYNOLDS_POWER)
    drag = (
        with_lost_suction(alpha, cl * growth, lifted, cd)
        - friction
        + wave_drag(mach, lifted, traits.thickness, traits.korn)
    )
    return lifted, drag, cm * growth


def capped_polar(
    mach: float, alpha: Array, cl: Array, cd: Array, cm: Array, traits: SectionTraits
) -> tuple[Array, Array, Array]:
    """(cl, cd, cm) of a native polar, its positive lift capped where XFOIL's own maximum is too high."""
    if not traits.cap_native:
        return cl, cd, cm
    held = np.where(cl > 0.0, smooth_cap(cl, lift_cap(mach, traits), 1.0, NATIVE_CAP_SHARPNESS), cl)
    return held, with_lost_suction(alpha, cl, held, cd), cm
