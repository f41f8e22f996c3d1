"""From the polars of a section to its C81 deck over ±180° and Mach 0 to 1; other codes' decks on the run-time grid.

Gaps of a polar are closed; below the slowest polar the deck repeats it; between polars it is linear in Mach. Beyond the
fastest, where XFOIL has no shocks, the Mach 0.3 polar is extended by textbook corrections: Prandtl-Glauert lift, a
smooth cap on lift, drag of the lost leading-edge suction, Korn-Lock wave drag. Mach 0.95 and 1.0 use the same formulas
and are extrapolation.

Three constants were read off public SC1095 tables (NASA CR-166309 deck, UMD RANS), so agreement of the
result with those tables is calibration, not evidence: the cap, KORN_KAPPA, and LIFT_DIVERGENCE_MACH
with LINEAR_RISE_FROM. The suction drag has no fitted constant.

Beyond stall follows a closed form. Nine constants fitted by this project to the NACA 0012 measurements over 0..180 deg
of NACA TN 3361 (Critzos, Heyson and Boswinkle 1955), symmetrised; four more for the moment. A 9.5 % section with a
sharp trailing edge behaves similarly there: at 90° like a flat plate, and in reverse flow it stalls early at its sharp
edge. The fit is within 0.039 (cl) and 0.014 (cd) rms of the measurements; it is not independent evidence of them.

Decks of other codes have their own knots, and some end at stall. Values between knots follow PCHIP curves, as in
`section_table`; missing angles are filled by the closed form.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from rotor.airfoil.c81 import C81Block, C81Deck, format_c81, parse_c81
from rotor.airfoil.polars import Polar
from rotor.airfoil.section_table import MACH_STEP, N_MACH
from rotor.support.arrays import Array

BLEND_START_DEG = 16.0  # |alpha| below which only the polar is used.
BLEND_END_DEG = 26.0  # |alpha| above which only the closed form is used.

# cl = sum s_k sin(k a) - P (x/w) exp((1 - (x/w)^2)/2), x = 180 deg - |a|: the last term is reverse-flow lift.
_CL_SIN = (0.07290562895790871, 1.0548966550216816)
_REVERSE_PEAK = 0.4137752069896611
_REVERSE_WIDTH_DEG = 7.719281370720392
_CD_COS = (1.1279, -0.0264, -1.03951, -0.02516, -0.0966)  # cd = sum c_k cos(k a), k from 0.
# cm = sum m_k sin(k a), k from 1, about the quarter chord.
_CM_SIN = (
    -0.58524,
    0.14099,
    -0.03031,
    0.04132,
)
Columns = tuple[Array, Array, Array]
"""cl, cd, cm."""

# Up to here XFOIL is used directly: compared with RANS, its drag is the better one.
NATIVE_MACH_LIMIT = 0.4
# Up to here a polar's Mach number says nothing about its Reynolds number.
INCOMPRESSIBLE_MACH = 0.05
BASE_MACH = 0.3  # The polar that is extended to higher Mach.
# The lift slope is constant above: Prandtl-Glauert would go to infinity.
LIFT_DIVERGENCE_MACH = 0.75
KORN_KAPPA = 0.86  # Technology factor of Korn's relation, fitted to the CR-166309 SC1095 deck.
LINEAR_RISE_FROM = 0.2  # M - M_cr beyond which the wave drag rises linearly; the quartic is far too steep at M 0.9.
# Of tripped XFOIL cd at fixed Mach; Reynolds is proportional to Mach here.
FRICTION_REYNOLDS_POWER = -0.16
# Exponent of the smooth cap beyond the polars; takes 1 % off at 75 % of the cap.
CAP_SHARPNESS = 8.0

# Largest lift coefficient of SC1095 against Mach: own tripped XFOIL to 0.4, then as read off RANS and deck.
_CAP_MACH = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
_CAP_CL = (1.45, 1.45, 1.52, 1.50, 1.43, 1.10, 1.00, 0.93, 0.91, 0.91)


def wrap_coefficients(alpha: Array) -> tuple[Array, Array, Array]:
    """(cl, cd, cm) [-] of the closed form at `alpha` [rad], within -pi..pi; for 20..180 deg either way.

    cl and cm are odd, cd is even; cd lies between 0.043 (at 180 deg) and 2.1 (at 90 deg).
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
    t = np.clip(
        (np.rad2deg(np.abs(alpha)) - BLEND_START_DEG) / (BLEND_END_DEG - BLEND_START_DEG), 0.0, 1.0
    )
    return t * t * (3.0 - 2.0 * t)


def blend(alpha: Array, cl: Array, cd: Array, cm: Array) -> tuple[Array, Array, Array]:
    """Polar values blended into the closed form: cl and cm linearly, cd in its logarithm so that it stays positive."""
    weight = blend_weight(alpha)
    far_cl, far_cd, far_cm = wrap_coefficients(alpha)
    # A cd of zero weight has no effect: there the polar may have any value, and the series is negative.
    log_near, log_far = (
        np.log(np.where(weight < 1.0, cd, 1.0)),
        np.log(np.where(weight > 0.0, far_cd, 1.0)),
    )
    log_cd = (1.0 - weight) * log_near + weight * log_far
    return (
        (1.0 - weight) * cl + weight * far_cl,
        np.exp(log_cd),
        (1.0 - weight) * cm + weight * far_cm,
    )


_LARGEST = 5.0
_CORRECTIONS = 12
"""After these 0.1 % of c_d is left."""
_LEAST_RANGE_DEG = 8.0
"""A deck must at least cover −8…8°: no formula can replace data within it."""


def on_run_time_grid(deck: C81Deck) -> C81Deck:
    """The deck with lift and drag on the run-time grid over ±180°; the same values where its knots already fit.

    A deck of one Mach number is held at all of them. Raises ValueError with one sentence for a deck whose lift or drag
    covers too little; a moment that covers too little is left out.
    """
    try:
        moment = _block(deck.title, deck.cm, 2) if deck.cm else None
    except ValueError:
        moment = None
    return C81Deck(
        deck.title, _block(deck.title, deck.cl, 0), _block(deck.title, deck.cd, 1), moment
    )


def _block(title: str, block: C81Block, kind: int) -> C81Block:
    alpha, mach, values = block.alpha_deg, block.mach, block.values
    if alpha[0] > -_LEAST_RANGE_DEG or alpha[-1] < _LEAST_RANGE_DEG:
        raise ValueError(
            f"{title}: {('cl', 'cd', 'cm')[kind]} covers {alpha[0]:g}…{alpha[-1]:g} deg: "
            f"give at least −{_LEAST_RANGE_DEG:g}…{_LEAST_RANGE_DEG:g} deg"
        )
    if mach[0] < 0.0 or mach[-1] > 1.5 or alpha[0] < -180.0 - 1e-9 or alpha[-1] > 180.0 + 1e-9:
        raise ValueError(
            f"{title}: angles {alpha[0]:g}…{alpha[-1]:g} deg at Mach {mach[0]:g}…{mach[-1]:g}: "
            "keep angles within ±180 deg and Mach within 0…1.5"
        )
    largest = float(np.abs(values).max())
    if kind < 2 and largest > _LARGEST:
        raise ValueError(
            f"{title}: {('cl', 'cd')[kind]} reaches {largest:g}, more than any section has: check the digits"
        )
    on_angles = np.all(np.abs(alpha * 2.0 - np.round(alpha * 2.0)) < 1e-9)
    closed = abs(alpha[0] + 180.0) < 1e-9 and abs(alpha[-1] - 180.0) < 1e-9
    if not (on_angles and closed):
        alpha, values = _whole_circle(alpha, values, kind)
    ends = 0.5 * (values[0] + values[-1])
    values = np.concatenate((ends[None], values[1:-1], ends[None]))
    if len(mach) == 1:
        return C81Block(np.array([0.0, 1.0]), alpha, np.repeat(values, 2, axis=1))
    steps = mach / MACH_STEP
    if np.any(np.abs(steps - np.round(steps)) > 1e-9) or mach[-1] > 1.0 + 1e-9:
        grid = MACH_STEP * np.arange(
            round(mach[0] / MACH_STEP + 0.499), min(int(mach[-1] / MACH_STEP + 1e-9), N_MACH) + 1
        )
        if len(grid) < 2:
            raise ValueError(
                f"{title}: Mach {mach[0]:g}…{mach[-1]:g} is too narrow a range: cover at least 0.1"
            )
        grid = grid.astype(np.float64)
        least, values = values.min(), _through_knots(mach, values, grid)
        mach, values = grid, np.maximum(values, least) if kind == 1 else values
    return C81Block(mach, alpha, values)


def _through_knots(mach: Array, values: Array, grid: Array) -> Array:
    """Values at the run-time grid's Mach numbers whose curve meets the deck's at its own, where these are 0.05 apart.

    The PCHIP curve of the deck read at the grid is off its knots, by up to some 10 % of c_d in the drag rise.
    """
    made = np.asarray(scipy.interpolate.PchipInterpolator(mach, values, axis=1)(grid))
    inside = (mach >= grid[0] - 1e-9) & (mach <= grid[-1] + 1e-9)
    if not inside.any():
        return made
    share = np.stack([np.interp(grid, mach[inside], one) for one in np.eye(int(inside.sum()))])
    for _ in range(_CORRECTIONS):
        slopes = np.asarray(
            scipy.interpolate.PchipInterpolator(grid, made, axis=1).derivative()(grid)
        )
        slopes[:, [0, -1]] = 0.0  # Zero slope at both ends, as in `section_table`.
        curve = scipy.interpolate.CubicHermiteSpline(grid, made, slopes, axis=1)
        made = made + (values[:, inside] - np.asarray(curve(mach[inside]))) @ share
    return made


def _whole_circle(alpha: Array, values: Array, kind: int) -> tuple[Array, Array]:
    """Values at every half degree: the deck within its angles, blended into the closed form beyond them."""
    nodes = np.linspace(-180.0, 180.0, 721)
    curve = scipy.interpolate.PchipInterpolator(alpha, values, axis=0)
    measured = np.asarray(curve(np.clip(nodes, alpha[0], alpha[-1])), dtype=np.float64)
    edge = np.where(nodes < 0.0, float(-alpha[0]), float(alpha[-1])).astype(np.float64)
    fade = np.maximum(edge + BLEND_END_DEG - BLEND_START_DEG, BLEND_END_DEG) - edge
    t: Array = np.clip((np.abs(nodes) - edge) / fade, 0.0, 1.0)
    weight: Array = (t * t * (3.0 - 2.0 * t))[:, None]
    far = wrap_coefficients(np.deg2rad(nodes).astype(np.float64))[kind][:, None]
    if kind != 1:
        return nodes, (1.0 - weight) * measured + weight * far
    # In the logarithm, so that drag stays positive. Short of 20 deg the closed form is too low, even negative.
    return nodes, np.exp(
        (1.0 - weight) * np.log(measured) + weight * np.log(np.maximum(far, measured.min()))
    )


@dataclass(frozen=True)
class SectionTraits:
    """Section parameters of the corrections.

    `thickness` is t/c [-]; `cap_ratio` multiplies the SC1095 cap; `korn` is the technology factor of Korn's relation;
    `fixed_reynolds`: the polars are all of one Reynolds number of several, which is that of any Mach number.
    """

    thickness: float
    cap_ratio: float = 1.0
    korn: float = KORN_KAPPA
    fixed_reynolds: bool = False

    def correct(self, mach: float, alpha: Array, polar: Columns, polar_mach: float) -> Columns:
        """(cl, cd, cm) at `mach` from the polar at `polar_mach`: as it is where both are one, else extended."""
        return (
            polar if polar_mach == mach else corrected_polar(mach, alpha, *polar, self, polar_mach)
        )


def smooth_cap(cl: Array, upper: float, lower: float, sharpness: float = CAP_SHARPNESS) -> Array:
    """`cl`, any shape, limited smoothly to -`lower`..`upper`: x / (1 + |x/cap|^n)^(1/n), n = `sharpness`."""
    cap = np.where(cl >= 0.0, upper, lower)
    return np.asarray(
        cl / (1.0 + np.abs(cl / cap) ** sharpness) ** (1.0 / sharpness), dtype=np.float64
    )


def prandtl_glauert(mach: float, base: float = BASE_MACH) -> float:
    """Growth of lift from `base` to `mach`, √(1 − M0²)/√(1 − M²), constant above lift divergence (Glauert 1928)."""
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
    mach: float, alpha: Array, cl: Array, cd: Array, cm: Array, traits: SectionTraits, base: float
) -> Columns:
    """(cl, cd, cm) at a `mach` beyond the polars, from the polar at `base`; `alpha` [rad] within +-0.5."""
    growth = prandtl_glauert(mach, base)
    cap = float(scipy.interpolate.PchipInterpolator(_CAP_MACH, _CAP_CL)(mach)) * traits.cap_ratio
    lifted = smooth_cap(cl * growth, cap, cap)
    # A polar at Mach 0 is incompressible, not of a rotor at rest: its Reynolds number is the one meant.
    reynolds_ratio = 1.0 if traits.fixed_reynolds or base <= INCOMPRESSIBLE_MACH else mach / base
    friction = float(np.min(cd)) * (1.0 - reynolds_ratio**FRICTION_REYNOLDS_POWER)
    drag = (
        with_lost_suction(alpha, cl * growth, lifted, cd)
        - friction
        + wave_drag(mach, lifted, traits.thickness, traits.korn)
    )
    return lifted, drag, cm * growth


USED_ALPHA_DEG = 16.0  # Beyond, XFOIL jumps between separated branches; values are constant there and blended out.
DECK_MACH = np.array(
    [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0]
)


def deck_alpha_deg() -> Array:
    """The deck's angles [deg], at most 99: dense where flow separates and where reverse flow peaks."""
    reverse = [180.0, 177.5, 175.0, 172.5, 170.0, 167.5, 165.0, 160.0, 155.0, 150.0]
    broadside = [
        140.0,
        130.0,
        120.0,
        105.0,
        90.0,
        75.0,
        60.0,
        50.0,
        40.0,
        35.0,
        30.0,
        26.0,
        24.0,
        22.0,
        20.0,
        18.0,
    ]
    far = np.array(reverse + broadside)
    near = np.concatenate((np.arange(-16.0, 8.0), np.arange(8.0, 16.0, 0.5), [16.0, 17.0]))
    return np.concatenate((-far, near, far[::-1]))


Correction = Callable[[float, Array, Columns, float], Columns]
"""(cl, cd, cm) at a Mach number from angles [rad], a polar there and the polar's own Mach number."""


def assemble_deck(title: str, polars: Sequence[Polar], correct: Correction) -> C81Deck:
    """The deck of one section from its polars, rounded as the C81 text rounds it.

    Up to the fastest polar the polars stand as they are, linear in between in Mach; beyond it the one nearest to
    Mach 0.3 is extended. `correct` does that, as `SectionTraits.correct`.
    """
    ordered = sorted(polars, key=lambda polar: polar.mach)
    base = min(ordered, key=lambda polar: abs(polar.mach - BASE_MACH))
    alpha_deg = deck_alpha_deg()
    alpha = np.deg2rad(alpha_deg)
    near = np.abs(alpha_deg) < BLEND_END_DEG
    columns: list[Columns] = []
    for mach in DECK_MACH:
        native = mach <= ordered[-1].mach + 1e-9
        here = (
            _between(ordered, float(mach), alpha_deg[near])
            if native
            else _at(base, alpha_deg[near])
        )
        inner = correct(float(mach), alpha[near], here, float(mach) if native else base.mach)
        full = [np.ones_like(alpha) for _ in range(3)]
        for whole, part in zip(full, inner, strict=True):
            whole[near] = part
        cl_here, cd_here, cm_here = blend(alpha, full[0], full[1], full[2])
        columns.append((cl_here, _drag_grows_to_broadside(alpha_deg, cd_here), cm_here))
    cl, cd, cm = (np.stack([column[k] for column in columns], axis=1) for k in range(3))
    cl[[0, -1]] = cl[[0, -1]].mean(axis=0)  # −180° and 180° are one angle.
    cm[[0, -1]] = cm[[0, -1]].mean(axis=0)
    deck = C81Deck(title, *(C81Block(DECK_MACH, alpha_deg, values) for values in (cl, cd, cm)))
    return parse_c81(format_c81(deck), title)


def _between(ordered: Sequence[Polar], mach: float, alpha_deg: Array) -> Columns:
    """The polars at a Mach number: the polar of that Mach, or linear between its neighbours; constant outside."""
    slower = max(
        (p for p in ordered if p.mach <= mach + 1e-9), key=lambda p: p.mach, default=ordered[0]
    )
    faster = min(
        (p for p in ordered if p.mach >= mach - 1e-9), key=lambda p: p.mach, default=ordered[-1]
    )
    if faster.mach - slower.mach < 1e-6:
        return _at(slower, alpha_deg)
    share = min(max((mach - slower.mach) / (faster.mach - slower.mach), 0.0), 1.0)
    low, high = _at(slower, alpha_deg), _at(faster, alpha_deg)
    cl, cd, cm = ((1.0 - share) * slow + share * fast for slow, fast in zip(low, high, strict=True))
    return cl, cd, cm


def _at(polar: Polar, alpha_deg: Array) -> Columns:
    """A polar at `alpha_deg`: gaps interpolated monotonically, values constant beyond USED_ALPHA_DEG."""
    where = np.clip(
        alpha_deg,
        max(polar.alpha_deg[0], -USED_ALPHA_DEG),
        min(polar.alpha_deg[-1], USED_ALPHA_DEG),
    )
    columns = polar.cl, np.log(polar.cd), polar.cm
    cl, log_cd, cm = (
        np.asarray(scipy.interpolate.PchipInterpolator(polar.alpha_deg, y)(where)) for y in columns
    )
    # Fully separated, the force stays normal to the chord: its drag grows with tan(alpha).
    beyond = np.deg2rad(np.maximum(np.abs(alpha_deg), USED_ALPHA_DEG))
    return cl, np.exp(log_cd) * np.tan(beyond) / np.tan(np.deg2rad(USED_ALPHA_DEG)), cm


def _drag_grows_to_broadside(alpha_deg: Array, cd: Array) -> Array:
    """`cd` of one Mach, made monotone from its least value outward to +-90 deg.

    The closed form does not depend on Mach, so above Mach 0.8 the blend into it would lower the drag.
    """
    out = cd.copy()
    best = int(np.argmin(np.where(np.abs(alpha_deg) < 16.0, cd, np.inf)))
    up = slice(best, int(np.searchsorted(alpha_deg, 90.0)) + 1)
    down = slice(best, int(np.searchsorted(alpha_deg, -90.0)) - 1, -1)
    for side in (up, down):
        out[side] = np.maximum.accumulate(cd[side])
    return out
