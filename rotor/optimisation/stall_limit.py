"""A smooth measure of the stalled part of the disk, that an optimiser can hold to a limit.

The stalled area of a `Solution` counts cells, so it moves in jumps. Here each cell counts by a logistic function of its
stall margin, half where the margin is zero, and fades out towards reverse flow; as both widths go to zero the measure
becomes that count.
"""

import math

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import Pass, Problem
from rotor.airfoil.table import MACH_STEP
from rotor.arrays import Array
from rotor.trim.adjoint import Adjoint, Weights

WIDTH = math.radians(0.5)
"""Margin [rad] over which a cell changes from attached to stalled (logistic scale)."""
REVERSE_WIDTH = 0.02
"""U_T over which cells fade out next to the reverse-flow region."""


def stalled_share(adjoint: Adjoint) -> tuple[float, Array]:
    """Stalled part of πR² (0…1), reverse flow not counted, and its gradient by each element's pitch [1/rad]."""
    problem, one = adjoint.problem, adjoint.one
    disk = problem.disk
    ring = 2.0 * disk.r[:, None] * disk.dr / len(disk.psi)
    margin, by_alpha, by_mach = _margin(problem, one)
    counted = 0.5 * (1.0 - np.tanh(0.5 * margin / WIDTH))
    by_margin = -counted * (1.0 - counted) / WIDTH
    x = np.clip(one.u_t / REVERSE_WIDTH, 0.0, 1.0)
    window, window_slope = x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / REVERSE_WIDTH

    # α = θ − atan2(U_P, U_T), M = U·M_tip.
    square = one.u_t**2 + one.u_p**2 + 1e-30
    over_t, over_p = one.u_t / square, one.u_p / square
    mach = one.loads[kernel.MACH]
    slope = ring * window * by_margin
    weights = Weights(
        pitch=slope * by_alpha,
        across=slope * (by_alpha * over_p + by_mach * mach * over_t) + ring * window_slope * counted,
        down=slope * (-by_alpha * over_t + by_mach * mach * over_p),
    )
    return float((ring * window * counted).sum()), adjoint.by_pitch(weights)


def _margin(problem: Problem, one: Pass) -> tuple[Array, Array, Array]:
    """Angle of attack left before stall [rad], and its slopes by α and Mach: `kernel.stall_margins` differentiated."""
    disk = problem.disk
    alpha, mach = one.loads[kernel.ALPHA], one.loads[kernel.MACH]
    top = disk.stall.shape[2] - 1
    x = np.minimum(mach / MACH_STEP, top - 1e-9)
    k = x.astype(np.int64)
    v = x - k
    inside = (mach / MACH_STEP < top) / MACH_STEP
    ends: list[Array] = []
    slopes: list[Array] = []
    for end in (0, 1):
        angle, slope = np.zeros_like(alpha), np.zeros_like(alpha)
        for which in (0, 1):
            share = (disk.weight if which else 1.0 - disk.weight)[:, None]
            row = disk.stall[disk.section[:, which], end]
            here, ahead = np.take_along_axis(row, k, axis=1), np.take_along_axis(row, k + 1, axis=1)
            angle += share * (here + v * (ahead - here) + disk.offset[:, which][:, None])
            slope += share * (ahead - here) * inside
        ends.append(angle)
        slopes.append(slope)
    above, below = ends[1] - alpha, alpha - ends[0]
    upper = above < below
    margin: Array = np.minimum(above, below)
    by_alpha: Array = np.where(upper, -1.0, 1.0)
    by_mach: Array = np.where(upper, slopes[1], -slopes[0])
    return margin, by_alpha, by_mach
