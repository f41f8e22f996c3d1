"""What dynamic stall needs of a section beside its coefficients, over the Mach number: from its own static data.

In Kirchhoff's flow past a flat plate, separated behind x = f c (Thwaites, Incompressible Aerodynamics, 1960),

    C_n = C_nα (α − α0) K(f),    K = ¼ (1 + √f)²

so the static data give f at every angle, and how far behind the quarter chord the normal force acts gives
m = (C_m − C_m0)/C_n. Lags are those of Leishman and Beddoes (J. AHS 34(3), 1989) for a NACA 0012, in semi-chords of
travel, as the program DSmodel (L. Pancini, github.com/luizpancini/DSmodel, commit f1b38dd) lists them. Its author has
adapted the travel of the vortex up to Mach 0.3; that of Mach 0.4 stands in for it.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rotor.airfoil.c81 import C81Block
from rotor.airfoil.section_table import (
    N_ALPHA,
    N_MACH,
    SEARCH_OUTWARD,
    SectionTable,
    bicubic_coefficients,
    mach_nodes,
    with_nodes,
)
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache

LEAST_SEPARATION = 0.02
"""f where the flow is separated from the leading edge on: its root has no slope at 0 (Leishman and Beddoes)."""
WIDEST = np.deg2rad(50.0)
"""Angle from zero lift within which f and m are used; see `rotor.aero.dynamic_stall`."""
ATTACHED = np.deg2rad(2.0)
"""Angle from zero lift from which secants of C_n are taken: C_nα is the largest up to stall, so f = 1 is reached."""
STALLED = 0.7
"""f below which a section is stalled: that of static stall by Leishman and Beddoes."""
_NEVER = 1e3
"""Angle [rad] of an onset that is not reached."""
_LEAST_C_N = 0.1
"""C_n below which the place where it acts passes over to the quarter chord. Our choice."""

ONSET = (SLOPE, POSITIVE, NEGATIVE, ZERO, LAG_PRESSURE, LAG_SEPARATION, LAG_VORTEX, TRAVEL) = tuple(
    range(8)
)
"""Rows of `StallOnset.numbers`."""

_LAG_MACH = (0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8)
_LAGS = {
    LAG_PRESSURE: (1.7, 1.8, 2.0, 2.5, 3.0, 3.3, 4.3),
    LAG_SEPARATION: (3.0, 2.5, 2.2, 2.0, 2.0, 2.0, 2.0),
    LAG_VORTEX: (6.0, 6.0, 6.0, 6.0, 6.0, 6.0, 4.0),
    TRAVEL: (9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0),
}


class StallOnset(NamedTuple):
    """Onset of stall of one section."""

    numbers: Array
    """At the Mach nodes, (8, nodes): C_nα [1/rad]; angles from zero lift [rad] at which attached flow has the normal
    force of static stall, positive and negative (a negative number); zero-lift angle [rad]; T_p, T_f, T_v, T_vl."""
    tables: Array
    """f and m by the angle from zero lift and the Mach number, (α cells, Mach cells, 2, 4, 4)."""


@bytes_cache
@read_only
def stall_onset(table: SectionTable) -> StallOnset:
    """The onset of stall of a section, from its static data."""
    mach = mach_nodes()
    zero = table.zero_lift_alpha(mach)
    angles = np.arange(-180.0, 180.1, 0.5)
    x = np.deg2rad(angles)[:, None]
    f, m = np.ones((len(x), len(mach))), np.zeros((len(x), len(mach)))
    force, moment = normal_force(table, zero + x, mach), table.moment(zero + x, mach)
    inside = (np.abs(x) <= WIDEST) & (np.abs(x) >= np.deg2rad(1.0)) & (mach >= 0.0)
    secant = np.divide(force, x, out=np.zeros_like(force), where=inside)
    negative, positive = table.stall_alpha(mach)
    attached = (np.abs(x) >= ATTACHED) & (x <= positive - zero) & (x >= negative - zero)
    slope = np.where(attached, secant, 0.0).max(axis=0)
    slope = np.where(slope > 0.0, slope, table.lift_slope(mach))  # Stall begins at the first angle.
    ratio = np.divide(force, slope * x, out=np.ones_like(force), where=inside)
    # Of a section that does not stall.
    least = np.where(positive < np.pi, LEAST_SEPARATION, 1.001 * STALLED)
    f[inside] = np.clip((2.0 * np.sqrt(np.maximum(ratio, 0.25)) - 1.0) ** 2, least, 1.0)[inside]
    if moment is not None:
        of_lift = moment - moment[len(x) // 2]
        m = np.where(np.abs(x) <= WIDEST, of_lift * force / (force * force + _LEAST_C_N**2), 0.0)
    numbers = np.empty((len(ONSET), N_MACH + 1))
    numbers[SLOPE], numbers[ZERO] = slope, zero
    for row, end in ((POSITIVE, positive), (NEGATIVE, negative)):
        numbers[row] = onset_angles(end, normal_force(table, end, mach), slope)
    for row, lags in _LAGS.items():
        numbers[row] = np.interp(mach, _LAG_MACH, lags)
    blocks = (bicubic_coefficients(C81Block(mach, angles, values)) for values in (f, m))
    return StallOnset(numbers, np.ascontiguousarray(np.stack(list(blocks), axis=2)))


def onset_angles(end: Array, force: Array, slope: Array) -> Array:
    """Angles from zero lift [rad] at which attached flow has the normal force of static stall, of one side.

    end: stall angles, ±π of a section that does not stall; force: C_n there; slope: C_nα.
    """
    return np.where(np.abs(end) < np.pi, force / slope, np.copysign(_NEVER, end))


@bytes_cache
@read_only
def unstalled(table: SectionTable) -> SectionTable:
    """A section that does not stall: the flow separates no further than where stall begins.

    From α_s, where f falls to `STALLED`, to ±30° it stays: C_n = C_nα x K(f); drag and moment stay, too. From there to
    ±90°, beside reverse flow, all pass over into the data: our choice. Up to α_s nothing changes.
    """
    mach, degrees = mach_nodes(), np.linspace(-180.0, 180.0, N_ALPHA + 1)
    alpha, zero = np.deg2rad(degrees)[:, None], table.zero_lift_alpha(mach)
    negative, positive = _ends(table)
    end = np.where(alpha > 0.0, positive, negative)
    beyond = ((alpha > positive) | (alpha < negative)) & (np.abs(alpha) < 0.5 * np.pi)
    t = np.clip((np.abs(degrees)[:, None] - 30.0) / 60.0, 0.0, 1.0)
    share = t * t * (3.0 - 2.0 * t)

    def cells(known: Array, here: Array, without: Array) -> Array:
        """Of one coefficient, from its own and its values at the nodes with stall and without."""
        values = np.where(beyond, (1.0 - share) * without + share * here, here)
        return with_nodes(known, beyond, C81Block(mach, degrees, values))

    here, there = table(alpha, mach), table(end, mach)
    normal = normal_force(table, end, mach) * (alpha - zero) / (end - zero)
    lift = (normal - there.cd * np.sin(alpha)) / np.cos(alpha)
    pairs = enumerate(((here.cl, lift), (here.cd, there.cd)))
    forces = np.stack([cells(table.coefficients[:, :, k], *pair) for k, pair in pairs], axis=2)
    known, own, held = table.moment_coefficients, table.moment(alpha, mach), table.moment(end, mach)
    none = np.full(N_MACH + 1, np.pi)
    return replace(
        table,
        coefficients=np.ascontiguousarray(forces),
        alpha_stall_negative=-none,
        alpha_stall_positive=none,
        moment_coefficients=None
        if known is None or own is None or held is None
        else cells(known, own, held),
    )


def _ends(table: SectionTable) -> tuple[Array, Array]:
    """Angles of attack [rad] at the Mach nodes up to which f is at least `STALLED`, at most 30° from zero lift."""
    mach = mach_nodes()
    zero, slope, out = (
        table.zero_lift_alpha(mach),
        stall_onset(table).numbers[SLOPE],
        SEARCH_OUTWARD[:, None],
    )

    def end(side: float) -> Array:
        low = (
            side * normal_force(table, zero + side * out, mach)
            < 0.25 * (1.0 + STALLED**0.5) ** 2 * slope * out
        )
        last = np.where(
            low.any(axis=0), np.maximum(np.argmax(low, axis=0) - 1, 0), len(SEARCH_OUTWARD) - 1
        )
        return zero + side * SEARCH_OUTWARD[last]

    return end(-1.0), end(1.0)


def normal_force(table: SectionTable, alpha: Array, mach: Array) -> Array:
    """C_n of the static data."""
    forces = table(alpha, mach)
    return forces.cl * np.cos(alpha) + forces.cd * np.sin(alpha)
