"""Linear lags that are periodic around the azimuth, exact after one turn, with slopes."""

import math
from typing import Any

import numpy as np

from rotor.compiled import compiled

_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def spread(coarse: Any, steps: int, out: Any) -> None:
    """Linear between azimuths, onto finer ones."""
    n = len(coarse)
    for k in range(len(out)):
        c, w = k // steps, (k % steps) / steps
        out[k] = (1.0 - w) * coarse[c] + w * coarse[(c + 1) % n]


@_compile
def around(decay: Any, z: Any) -> None:
    """z[k + 1] = decay[k] z[k] + given[k], periodic, where z holds what is given: (azimuths, columns), in place."""
    n, columns = z.shape
    value, rest = np.zeros(columns), 1.0
    for k in range(n):  # First from zero: what is left of a start after one turn is known.
        rest *= decay[k]
        for j in range(columns):
            value[j] = decay[k] * value[j] + z[k, j]
    for j in range(columns):
        value[j] /= 1.0 - rest
    for k in range(n):
        for j in range(columns):
            given = z[k, j]
            z[k, j] = value[j]
            value[j] = decay[k] * value[j] + given


@_compile
def lag(u: Any, du: Any, h: Any, by_mach: Any, dm: Any, z: Any, dz: Any) -> None:
    """z of dz/ds = (u − z)/T, periodic, exact for an input that is linear in s within every step.

    h: step over T; by_mach: its slope by the sum of the Mach numbers at its ends; d…: slopes by the seeds.
    """
    n, seeds = du.shape
    rates = np.empty((n, 5))
    for k in range(n):
        e = math.exp(-h[k])
        if h[k] > 1e-4:
            phi = (1.0 - e) / h[k]
            by = (e - phi) / h[k]
        else:
            phi, by = 1.0 - 0.5 * h[k], -0.5 + h[k] / 3.0
        rates[k, 0], rates[k, 1], rates[k, 2] = e, phi - e, 1.0 - phi
        rates[k, 3], rates[k, 4] = by + e, -by
        z[k] = rates[k, 1] * u[k] + rates[k, 2] * u[(k + 1) % n]
    decay = rates[:, 0]
    around(decay, z.reshape(n, 1))
    for k in range(n if seeds else 0):
        after = (k + 1) % n
        a, b = rates[k, 1], rates[k, 2]
        by = (-decay[k] * z[k] + rates[k, 3] * u[k] + rates[k, 4] * u[after]) * by_mach[k]
        for j in range(seeds):
            dz[k, j] = a * du[k, j] + b * du[after, j] + by * (dm[k, j] + dm[after, j])
    around(decay, dz)


@_compile
def lag_steps(row: Any, fine: Any, mach: Any, unit: float, h: Any, by_mach: Any) -> None:
    """Steps over a lag time, and their slopes by the sum of the Mach numbers at their ends.

    row: the lag time at the mean Mach numbers of the steps and its slope, (2, steps). unit: travel over the sum.
    """
    n = len(mach)
    for k in range(n):
        h[k] = unit * (mach[k] + mach[(k + 1) % n]) / row[0, k]
        by_mach[k] = (unit - h[k] * 0.5 * row[1, k]) / row[0, k]
