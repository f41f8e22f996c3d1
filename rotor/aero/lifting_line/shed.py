"""What the lattice's shed vorticity lacks of a thin aerofoil's, where lift changes faster than its steps follow.

With lift ρUΓ, Γ ~ exp(inψ), Theodorsen's function C(k) asks for the downwash (1/C − 1) Γ/2πb at the line, k = n b/r
(NACA Report 496, 1935). Shed lines 15° apart behind a line without chord leave 1 to 8 % less lift than C at k 0.05 to
0.2. The difference, in two dimensions and at the mean speed r, is the same for all azimuths: it adds to a panel's own
block.
Inboard, where the wake passes back over the blade, it fades out as the core of the young trailers does.
"""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import exp1, hankel2

from rotor.aero.lifting_line.geometry import WakeCourse
from rotor.aero.lifting_line.influence import BARE, TURNS, Line, build_wake, own_core, strip_of
from rotor.arrays import Array


def theodorsen(k: Array) -> NDArray[np.complex128]:
    """C(k), complex; 1 at k = 0."""
    one, zero = hankel2(1, np.maximum(k, 1e-12)), hankel2(0, np.maximum(k, 1e-12))
    return np.asarray(one / (one + 1j * zero), dtype=np.complex128)


def lattice_lag(line: Line, course: WakeCourse, panel: int, harmonic: Array) -> NDArray[np.complex128]:
    """Downwash over ΩR of a panel's own shed lines by its circulation exp(inψ) over ΩR², in a straight wake: complex.

    harmonic: n, (harmonics,). The lines are those of `build_wake`, as if they ran on along the blade.
    """
    wake = build_wake(line, WakeCourse(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, course.core), np.zeros(1))
    row, rows = wake.places[:, 0], wake.rows
    own = np.flatnonzero((row == rows[1] + panel) | (row == rows[4] + strip_of(line, panel)))
    age = -0.5 * (wake.ends[0, own, 2] + wake.ends[0, own, 5]).astype(np.float64)  # It sinks by 1 in an age of 1.
    x, core = line.r[panel] * age, wake.core[own].astype(np.float64)
    core = np.where(core < 0.0, own_core(line, course)[panel], core)
    gain = -wake.shares[own] * (x / (2.0 * math.pi * np.sqrt(x**4 + core)))[:, None]
    step = 2.0 * math.pi / line.azimuths
    return (
        np.exp(-1j * step * np.multiply.outer(harmonic, wake.places[own, 1:])).reshape(len(harmonic), -1) @ gain.ravel()
    )


def shed_correction(line: Line, course: WakeCourse, half_chord: Array) -> Array:
    """To be added to A between azimuths of a panel, (panels, azimuths, azimuths); half_chord: b/R, (panels,)."""
    n = np.arange((line.azimuths + 1) // 2, dtype=np.float64)
    age = 2.0 * math.pi * np.arange(line.azimuths) / line.azimuths
    back = (np.arange(line.azimuths)[:, None] - np.arange(line.azimuths)) % line.azimuths
    share = np.clip((line.r - course.mu_x - BARE[0]) / (BARE[1] - BARE[0]), 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    out = np.empty((line.panels, line.azimuths, line.azimuths))
    for i, r in enumerate(line.r):
        whole = (1.0 / theodorsen(n * half_chord[i] / r) - 1.0) / (2.0 * math.pi * half_chord[i])
        beyond = np.zeros_like(whole)  # Further back than the shed lines reach.
        beyond[1:] = 1j * n[1:] / (2.0 * math.pi * r) * exp1(1j * n[1:] * 2.0 * math.pi * TURNS)
        missing = share[i] * (whole - beyond - lattice_lag(line, course, i, n))
        missing[0] = 0.0
        out[i] = (2.0 / line.azimuths * (missing @ np.exp(1j * np.outer(n, age))).real)[back]
    return out
