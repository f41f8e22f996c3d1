"""Sections with public tunnel-derived data: levels of lift and drag, shock stall, drag rise, moment; and the lift slope
of NACA 0012 and its like.

XFOIL gives the shape of a polar at low speed, up to Mach 0.4. What tunnels say of its level, and of shocks, is put
on it here. In the SC1095 deck of NASA CR-166309 the drag above its level, the lost lift and the break of the moment,
from Mach 0.5 to 0.9 at all angles, each fall on one curve of the similarity variable

    x = M + 0.046 √((α − α_c)² + 0.8²)        (angles in degrees)

and each curve is a ramp with a rounded onset, slope · w ln(1 + exp((x − x0)/w)). Every constant is named with what
it was read off. `assets/airfoils/CITATION.md` repeats them beside the data that were kept aside.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotor.airfoil.decks import (
    BASE_MACH,
    FRICTION_REYNOLDS_POWER,
    LIFT_DIVERGENCE_MACH,
    Columns,
    SectionTraits,
    prandtl_glauert,
    smooth_cap,
    with_lost_suction,
)
from rotor.support.arrays import Array

CAP_SHARPNESS = 16.0
"""Of the smooth cap on lift: up to Mach 0.4 lift well below the cap must not change."""
MACH_PER_DEGREE = 0.046
"""Mach number that one degree is worth. This, the next four and the onset of SC1095: least squares of ln C_d on the
CR-166309 SC1095 deck, −8 to 10 deg, Mach 0.5 to 0.9; what is left is 8 % rms."""
ROUNDING_DEG = 0.8
DRAG_SLOPE = 0.47
RISE_WIDTH = 0.032
LIFT_LOSS_SLOPE = 2.6
"""Lost lift by x: the same deck, 4 to 12 deg, Mach 0.5 to 0.7."""
LIFT_LOSS_AFTER = 0.080
"""Lift is lost so much later in x than drag rises: as before."""
LIFT_LOSS_MACH = 0.76
"""Lost lift grows with Mach no more above: the same deck, 4 to 8 deg at Mach 0.8."""
SLOPE_LIMIT_MACH = 0.72
"""The lift slope grows no more above: the deck's is largest between Mach 0.7 and 0.8."""
ZERO_LIFT_MACH, ZERO_LIFT_SHIFT_DEG = (0.80, 0.90), 1.5
"""Zero lift moves up by so much between these Mach numbers: the same deck at Mach 0.8 and 0.9."""
POCKET_SLOPE, POCKET_BEFORE, POCKET_WIDTH = 0.10, 0.116, 0.05
"""The supersonic pocket near the nose pulls it up: moment by x, from so much before the onset of drag. Moments of the
C81 form of the same deck, Mach 0.5 to 0.7."""
BREAK_SLOPE, BREAK_AFTER, BREAK_WIDTH = 0.46, 0.089, 0.02
"""The moment breaks behind the shock: the same table."""
TUCK_MACH = (0.70, 0.80)
"""Between these Mach numbers the shock moves to the rear and the moment to the next form."""
TUCK_OFFSET, TUCK_SIZE, TUCK_DEG = -0.0085, 0.040, 2.0
"""C_m at Mach 0.8 above its zero-lift growth, −0.0085 − 0.040 tanh(α/2°): the University of Maryland's net trained on
RANS of SC1095, the only public moment above Mach 0.7. Held to Mach 1."""
TUCK_BREAK_SLOPE, TUCK_BREAK_AFTER = 0.23, 0.284
"""The break at Mach 0.8: the same net."""
SHOCKS_FROM = (0.30, 0.55)
"""Below the lower Mach number stall is that of XFOIL and the cap, above the higher the shock's: the same deck, C_d at
10 and 12 deg, Mach 0.3 to 0.5."""
OWN_STALL = 0.1
"""XFOIL's polar counts as stalled where its C_l is so far from the line of attached flow."""
DRAG_LEVEL = 1.11
"""Tunnels over XFOIL tripped at 5 % chord, M 0.4 to 0.5: midway (0.00885) between the CR-166309 deck (0.0079 over 0 to
4 deg) and the polar of NASA TM-86719 (0.0098 over 0 to 3.6 deg), over XFOIL's 0.0080. McCroskey's tripped NACA 0012
gives 1.07; Timmer (AIAA 2009-268) finds codes of this kind 9 % low over many sections."""

_CAP_MACH = (0.0, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
_CAP_CL = (1.35, 1.35, 1.27, 1.15, 1.10, 0.97, 0.93, 0.93)
"""Largest C_l of SC1095: TM-86719 measures 1.27 where its lift slope says Mach 0.4 to 0.5, the deck 1.25, 1.17 and 1.0
at Mach 0.3, 0.4 and 0.5; taken near the tunnel's. Above, the deck's 1.08, 0.93 and 0.91 at Mach 0.6, 0.7 and 0.8, and
2 to 4 % for the rounding of the cap."""


@dataclass(frozen=True)
class TunnelTraits:
    """What tunnels say of one section."""

    onset: float
    """x at which the drag rise begins."""
    centre_deg: float
    """α_c: the angle about which the drag rise is even [deg]."""
    zero_lift_shift_deg: float
    """How far zero lift lies above XFOIL's [deg]."""
    cap_ratio: float
    """Largest C_l over that of SC1095."""
    negative_cap: float
    """Largest −C_l."""
    reynolds_per_mach: float
    drag_level: float = DRAG_LEVEL
    """C_d of attached flow over XFOIL's."""
    moment_shift: float = 0.0
    """C_m at no lift less XFOIL's."""

    def correct(self, mach: float, alpha: Array, polar: Columns, polar_mach: float) -> Columns:
        """As `SectionTraits.correct`."""
        return tunnel_polar(mach, alpha, *polar, self, polar_mach)


@dataclass(frozen=True)
class MeasuredSlope:
    """Textbook steps, with the lift slope of the tunnels in place of XFOIL's, which is 7 to 10 % steeper.

    All of XFOIL's lift is scaled, its maximum too: a public table of NACA 0012 has less of it as well.
    """

    traits: SectionTraits
    reynolds_per_mach: float

    def correct(self, mach: float, alpha: Array, polar: Columns, polar_mach: float) -> Columns:
        """As `SectionTraits.correct`."""
        cl, cd, cm = polar
        held = min(mach, LIFT_DIVERGENCE_MACH)
        measured = tunnel_lift_slope(held, self.reynolds_per_mach * max(held, 0.1))
        own = _straight(np.rad2deg(alpha), cl)[0] * prandtl_glauert(mach, polar_mach)
        return self.traits.correct(mach, alpha, (cl * measured / own, cd, cm), polar_mach)


def tunnel_lift_slope(mach: float, reynolds: float) -> float:
    """Lift slope [1/deg], (0.1025 + 0.00485 log10(Re/10⁶))/√(1 − M²): the tunnels trusted most, NACA 0012.

    McCroskey, NASA TM-100019 (1987). The SC1095 and R8 decks of CR-166309 agree with it within 3 % up to Mach 0.6.
    """
    return (0.1025 + 0.00485 * math.log10(reynolds / 1e6)) / math.sqrt(1.0 - mach * mach)


def ramp(x: Array, onset: float, width: float = RISE_WIDTH) -> Array:
    """0 far below `onset`, x − `onset` far above it, `width` · ln 2 at it."""
    return width * np.logaddexp(0.0, (x - onset) / width)


def tunnel_polar(
    mach: float,
    alpha: Array,
    cl: Array,
    cd: Array,
    cm: Array,
    traits: TunnelTraits,
    native_mach: float = BASE_MACH,
) -> tuple[Array, Array, Array]:
    """(cl, cd, cm) at `mach` from XFOIL's polar at `native_mach`, which is `mach` itself where XFOIL is used natively.

    `alpha` [rad], increasing, within ±0.5.
    """
    degrees = np.rad2deg(alpha)
    shocks = _smoothstep(mach, *SHOCKS_FROM)
    line = _attached_line(degrees, cl)
    own_stall = np.abs(cl - line) > OWN_STALL
    lift, lost_at_low_speed = _lift(mach, degrees, cl, line, traits, shocks)
    from_centre = degrees - traits.centre_deg
    x = mach + MACH_PER_DEGREE * np.hypot(from_centre, ROUNDING_DEG)

    friction = (
        (max(mach, 1e-3) / native_mach) ** FRICTION_REYNOLDS_POWER if mach > native_mach else 1.0
    )
    section_drag = (1.0 - shocks) * cd + shocks * _held_beyond(own_stall, degrees, cd)
    attached = (
        traits.drag_level
        * friction
        * with_lost_suction(alpha, lift + lost_at_low_speed, lift, section_drag)
    )
    drag = attached + shocks * DRAG_SLOPE * ramp(x, traits.onset)
    return lift, drag, _moment(mach, degrees, x, cm, traits, native_mach, shocks)


def _attached_line(degrees: Array, cl: Array) -> Array:
    """C_l of XFOIL's polar as it would be without stall: the straight line through −3 to 3 deg."""
    slope, zero = _straight(degrees, cl)
    return slope * degrees + zero


def _straight(degrees: Array, cl: Array) -> tuple[float, float]:
    """Slope [1/deg] and C_l at 0° of the straight line through −3 to 3 deg."""
    near = np.abs(degrees) <= 3.0
    slope, zero = np.polyfit(degrees[near], cl[near], 1)
    return float(slope), float(zero)


def _held_beyond(stalled: NDArray[np.bool_], degrees: Array, values: Array) -> Array:
    """`values` up to the first stalled angle on either side of 0, and the value there beyond it."""
    low = degrees[stalled & (degrees < 0.0)].max(initial=degrees[0])
    high = degrees[stalled & (degrees > 0.0)].min(initial=degrees[-1])
    return np.interp(np.clip(degrees, low, high), degrees, values)


def _lift(
    mach: float, degrees: Array, cl: Array, line: Array, traits: TunnelTraits, shocks: float
) -> tuple[Array, Array]:
    """C_l, and what the cap took from it. XFOIL's own stall counts only as far as shocks do not stall the section."""
    own_slope = float((line[-1] - line[0]) / (degrees[-1] - degrees[0]))
    held = min(mach, SLOPE_LIMIT_MACH)
    slope = tunnel_lift_slope(held, traits.reynolds_per_mach * max(held, 0.1))
    shift = ZERO_LIFT_SHIFT_DEG * _smoothstep(mach, *ZERO_LIFT_MACH)
    before_shocks = (1.0 - shocks) * cl + shocks * line
    potential = before_shocks * slope / own_slope - slope * (shift + traits.zero_lift_shift_deg)
    from_centre = degrees - shift - traits.centre_deg
    x = min(mach, LIFT_LOSS_MACH) + MACH_PER_DEGREE * np.hypot(from_centre, ROUNDING_DEG)
    side = np.tanh(from_centre / ROUNDING_DEG)
    after_shock = potential - side * shocks * LIFT_LOSS_SLOPE * ramp(
        x, traits.onset + LIFT_LOSS_AFTER
    )
    cap = float(np.interp(mach, _CAP_MACH, _CAP_CL)) * traits.cap_ratio
    lift = smooth_cap(after_shock, cap, traits.negative_cap, CAP_SHARPNESS)
    return lift, after_shock - lift


def _moment(
    mach: float,
    degrees: Array,
    x: Array,
    cm: Array,
    traits: TunnelTraits,
    native_mach: float,
    shocks: float,
) -> Array:
    side = np.tanh((degrees - traits.centre_deg) / ROUNDING_DEG)
    held = max(min(mach, SLOPE_LIMIT_MACH), native_mach)
    at_zero = float(np.interp(0.0, degrees, cm)) * math.sqrt(
        (1.0 - native_mach**2) / (1.0 - held**2)
    )
    pocket = POCKET_SLOPE * ramp(x, traits.onset - POCKET_BEFORE, POCKET_WIDTH)
    broken = BREAK_SLOPE * ramp(x, traits.onset + BREAK_AFTER, BREAK_WIDTH)
    at_zero += traits.moment_shift
    subsonic = (1.0 - shocks) * (cm + traits.moment_shift) + shocks * (
        at_zero + side * (pocket - broken)
    )
    tuck = TUCK_OFFSET - TUCK_SIZE * np.tanh(degrees / TUCK_DEG)
    tuck = at_zero + tuck - side * TUCK_BREAK_SLOPE * ramp(x, traits.onset + TUCK_BREAK_AFTER)
    share = _smoothstep(mach, *TUCK_MACH)
    return (1.0 - share) * subsonic + share * tuck


def _smoothstep(value: float, start: float, end: float) -> float:
    t = min(max((value - start) / (end - start), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)
