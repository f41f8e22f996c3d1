"""From polars at a few Mach numbers to a deck over all angles and Machs.

Polars as they are -> gaps closed -> compressibility beyond the fastest polar -> the closed form beyond stall ->
rounded C81 deck. Below the slowest polar it repeats; Mach 0.95 and 1.0 use the same formulas and are extrapolation.
"""

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotor.airfoil.build.compressibility import BASE_MACH, SectionTraits, capped_polar, corrected_polar
from rotor.airfoil.c81 import C81Block, C81Deck, format_c81, parse_c81
from rotor.airfoil.polars import Polar
from rotor.airfoil.wrap import BLEND_END_DEG, blend
from rotor.arrays import Array

Columns = tuple[Array, Array, Array]

USED_ALPHA_DEG = 16.0  # Beyond, XFOIL jumps between separated branches; values are held there and blended away.
DECK_MACH = np.array([0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0])


def deck_alpha_deg() -> Array:
    """The deck's angles [deg], at most 99: dense where flow separates and where reverse flow peaks."""
    reverse = [180.0, 177.5, 175.0, 172.5, 170.0, 167.5, 165.0, 160.0, 155.0, 150.0]
    broadside = [140.0, 130.0, 120.0, 105.0, 90.0, 75.0, 60.0, 50.0, 40.0, 35.0, 30.0, 26.0, 24.0, 22.0, 20.0, 18.0]
    far = np.array(reverse + broadside)
    near = np.concatenate((np.arange(-16.0, 8.0), np.arange(8.0, 16.0, 0.5), [16.0, 17.0]))
    return np.concatenate((-far, near, far[::-1]))


def assemble_deck(title: str, polars: Sequence[Polar], traits: SectionTraits) -> C81Deck:
    """The deck of one section from its polars, rounded as the C81 text rounds it.

    Up to the fastest polar the polars stand as they are, linear in between in Mach; beyond it the one nearest to
    Mach 0.3 is taken on by `compressibility`.
    """
    ordered = sorted(polars, key=lambda polar: polar.mach)
    base = min(ordered, key=lambda polar: abs(polar.mach - BASE_MACH))
    alpha_deg = deck_alpha_deg()
    alpha = np.deg2rad(alpha_deg)
    near = np.abs(alpha_deg) < BLEND_END_DEG
    columns: list[Columns] = []
    for mach in DECK_MACH:
        if mach <= ordered[-1].mach + 1e-9:
            inner = capped_polar(float(mach), alpha[near], *_between(ordered, float(mach), alpha_deg[near]), traits)
        else:
            inner = corrected_polar(float(mach), alpha[near], *_at(base, alpha_deg[near]), traits, base.mach)
        full = [np.ones_like(alpha) for _ in range(3)]
        for whole, part in zip(full, inner, strict=True):
            whole[near] = part
        cl_here, cd_here, cm_here = blend(alpha, full[0], full[1], full[2])
        columns.append((cl_here, _drag_grows_to_broadside(alpha_deg, cd_here), cm_here))
    cl, cd, cm = (np.stack([column[k] for column in columns], axis=1) for k in range(3))
    cl[[0, -1]] = cl[[0, -1]].mean(axis=0)  # The two ends are one angle.
    cm[[0, -1]] = cm[[0, -1]].mean(axis=0)
    deck = C81Deck(title, *(C81Block(DECK_MACH, alpha_deg, values) for values in (cl, cd, cm)))
    return parse_c81(format_c81(deck), title)


def _between(ordered: Sequence[Polar], mach: float, alpha_deg: Array) -> Columns:
    """The polars at a Mach number: the one that has it, or linear between its neighbours; held at the ends."""
    slower = max((p for p in ordered if p.mach <= mach + 1e-9), key=lambda p: p.mach, default=ordered[0])
    faster = min((p for p in ordered if p.mach >= mach - 1e-9), key=lambda p: p.mach, default=ordered[-1])
    if faster.mach - slower.mach < 1e-6:
        return _at(slower, alpha_deg)
    share = min(max((mach - slower.mach) / (faster.mach - slower.mach), 0.0), 1.0)
    low, high = _at(slower, alpha_deg), _at(faster, alpha_deg)
    cl, cd, cm = ((1.0 - share) * one + share * two for one, two in zip(low, high, strict=True))
    return cl, cd, cm


def _at(polar: Polar, alpha_deg: Array) -> Columns:
    """A polar at `alpha_deg`: gaps bridged monotonically, values held beyond USED_ALPHA_DEG."""
    where = np.clip(alpha_deg, max(polar.alpha_deg[0], -USED_ALPHA_DEG), min(polar.alpha_deg[-1], USED_ALPHA_DEG))
    cl, log_cd, cm = (
        np.asarray(PchipInterpolator(polar.alpha_deg, y)(where)) for y in (polar.cl, np.log(polar.cd), polar.cm)
    )
    # Fully separated, the force stays normal to the chord: its drag leans on with tan(alpha).
    beyond = np.deg2rad(np.maximum(np.abs(alpha_deg), USED_ALPHA_DEG))
    return cl, np.exp(log_cd) * np.tan(beyond) / np.tan(np.deg2rad(USED_ALPHA_DEG)), cm


def _drag_grows_to_broadside(alpha_deg: Array, cd: Array) -> Array:
    """`cd` of one Mach made to grow outward from its least value to +-90 deg.

    The closed form knows no Mach number, so that above Mach 0.8 the blend would fall into it.
    """
    out = cd.copy()
    best = int(np.argmin(np.where(np.abs(alpha_deg) < 16.0, cd, np.inf)))
    up = slice(best, int(np.searchsorted(alpha_deg, 90.0)) + 1)
    down = slice(best, int(np.searchsorted(alpha_deg, -90.0)) - 1, -1)
    for side in (up, down):
        out[side] = np.maximum.accumulate(cd[side])
    return out
