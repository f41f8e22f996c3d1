"""The law of Biot and Savart summed over a rigid helical wake: the hot loop of the vortex lattice.

Compiled by numba: an influence matrix takes some ten million vortex segments.
"""

import math
from typing import Any

import numba  # pyright: ignore[reportMissingTypeStubs]
import numpy as np

from rotor.arrays import Array

YOUNG = 0.8
"""Age [rad] below which a blade's own trailers have no core outboard of `bare_from`: control points lie midway between
smooth trailers, and the lifting line needs them as they are."""


ROUND = 4
"""Pieces that draw a blade's own first trailer step: as one chord it leaves the blade askew, which costs 3 % of induced
power at 36 azimuths and still 1 % at 72; four pieces leave 0.2 %."""


def _compile(function: Any) -> Any:
    options: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy"}
    # Reordered sums let the loops over trailers run on vector registers: six times faster.
    return numba.njit(fastmath={"contract", "reassoc"}, **options)(function)  # pyright: ignore[reportUnknownVariableType, reportUnknownMemberType]


@_compile
def _segment(
    ax: float, ay: float, az: float, a: float, bx: float, by: float, bz: float, b: float, core: float
) -> float:
    """4π times the downwash of a unit vortex from A to B; (ax, ay, az), (bx, by, bz) lead from A, B to the point.

    v = Γ/4π (a×b)/(|a×b|² + core² |AB|²) (|a| + |b|)(1 − a·b/|a||b|), and 0 on the vortex itself.
    """
    cx = ay * bz - az * by
    cy = az * bx - ax * bz
    cz = ax * by - ay * bx
    dot = ax * bx + ay * by + az * bz
    length = a * a + b * b - 2.0 * dot
    return -cz * (a + b) * (1.0 - dot / (a * b)) / (cx * cx + cy * cy + cz * cz + core * core * length + 1e-14)


@_compile
def _nodes(
    edges: Array,
    azimuth: float,
    age: float,
    mu_x: float,
    down: float,
    px: float,
    py: float,
    x: Array,
    y: Array,
    d: Array,
) -> None:
    """Vectors from the nodes of one age to a point (px, py) of the disk, and their lengths, into x, y, d."""
    cos, sin = math.cos(azimuth), math.sin(azimuth)
    for e in range(len(edges)):
        x[e] = px - edges[e] * cos - mu_x * age
        y[e] = py - edges[e] * sin
        d[e] = math.sqrt(x[e] * x[e] + y[e] * y[e] + down * down) + 1e-12


@_compile
def downwash_matrix(
    edges: Array,
    centres: Array,
    azimuths: int,
    blades: int,
    mu_x: float,
    axial: float,
    steps: int,
    core: float,
    bare_from: float,
) -> Array:
    """Downwash at the blade per bound circulation, (azimuths, centres, azimuths, panels): first target, then source.

    A node of age z is at (r cos(ψ_b − z) + µ_x z, r sin(ψ_b − z), −axial z). Between two steps a trailer carries the
    circulation its blade had midway, ½(Γ_k + Γ_k+1); what changes at a step, ½(Γ_k+1 − Γ_k−1), is shed there. The first
    half step's share, ½(Γ_1 − Γ_0), is shed at its middle, Δψ/4. The blade's own bound vortex is left out.
    """
    n = len(centres)
    step = 2.0 * math.pi / azimuths
    out = np.zeros((azimuths, n, azimuths, n))
    ax, ay, a = np.empty(n + 1), np.empty(n + 1), np.empty(n + 1)
    bx, by, b = np.empty(n + 1), np.empty(n + 1), np.empty(n + 1)
    trailed = np.empty(n + 1)
    for j in range(azimuths):
        for i in range(n):
            px = centres[i] * math.cos(j * step)
            py = centres[i] * math.sin(j * step)
            answer = out[j, i]
            for blade in range(blades):
                first = j + blade * azimuths // blades
                _nodes(edges, first * step, 0.0, mu_x, 0.0, px, py, ax, ay, a)
                az = 0.0
                if blade > 0:
                    for e in range(n):
                        answer[first % azimuths, e] += _segment(
                            ax[e], ay[e], 0.0, a[e], ax[e + 1], ay[e + 1], 0.0, a[e + 1], core
                        )
                for k in range(steps):
                    younger = answer[(first - k + 1) % azimuths]
                    here = answer[(first - k) % azimuths]
                    older = answer[(first - k - 1) % azimuths]
                    pieces = ROUND if blade == 0 and k == 0 else 1
                    bare = blade == 0 and k * step < YOUNG and centres[i] > bare_from
                    radius = 0.0 if bare else core
                    if k > 0:
                        for e in range(n):
                            half = 0.5 * _segment(ax[e], ay[e], az, a[e], ax[e + 1], ay[e + 1], az, a[e + 1], core)
                            younger[e] -= half
                            older[e] += half
                    for piece in range(pieces):
                        age = (k + (piece + 1) / pieces) * step
                        bz = axial * age
                        _nodes(edges, first * step - age, age, mu_x, bz, px, py, bx, by, b)
                        for e in range(n + 1):
                            trailed[e] = _segment(ax[e], ay[e], az, a[e], bx[e], by[e], bz, b[e], radius)
                        later = (piece + 0.5) / pieces
                        for e in range(n):
                            across = trailed[e + 1] - trailed[e]
                            here[e] += (1.0 - later) * across
                            older[e] += later * across
                        ax, bx = bx, ax
                        ay, by = by, ay
                        a, b = b, a
                        az = bz
                    if k == 0:
                        age = 0.25 * step
                        sz = axial * age
                        _nodes(edges, first * step - age, age, mu_x, sz, px, py, bx, by, b)
                        for e in range(n):
                            half = 0.5 * _segment(bx[e], by[e], sz, b[e], bx[e + 1], by[e + 1], sz, b[e + 1], core)
                            here[e] -= half
                            older[e] += half
    return out / (4.0 * math.pi)
