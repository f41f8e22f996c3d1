"""Which part of Theodorsen's lift deficiency the lattice has by itself, and what is added under unsteady sections."""

import math

import numpy as np
import pytest
from scipy.special import kv

from rotor.aero.lifting_line.geometry import WakeCourse
from rotor.aero.lifting_line.influence import Line, lattice_lag, shed_correction, theodorsen

LINE = Line(4, 0.15, 24, 24)
COURSE = WakeCourse(0.3, 0.02, 0.01, 0.0, 0.0, 0.0, (1e-4, 0.0))
HALF_CHORD = 0.0322
"""Of a UH-60A, over R."""
PANEL = 16
FREQUENCIES = (0.05, 0.1, 0.2)


def deficiency(k: float) -> complex:
    """C(k) by modified Bessel functions: another way than the code's."""
    one, zero = kv([1.0, 0.0], np.full(2, 1j * k))
    return complex(one / (one + zero))


def of_downwash(downwash: complex) -> complex:
    """Lift over its quasi-steady value: L = 2πρUb (Uα − w) with w = downwash · L/ρU."""
    return 1.0 / (1.0 + 2.0 * math.pi * HALF_CHORD * downwash)


@pytest.mark.parametrize(("k", "published"), [(0.05, 0.909 - 0.130j), (0.1, 0.832 - 0.172j), (0.2, 0.728 - 0.189j)])
def test_theodorsens_function(k: float, published: complex):
    """NACA Report 496, table 4: F and −G."""
    assert abs(theodorsen(np.array([k]))[0] - published) < 1e-3
    assert theodorsen(np.array([k]))[0] == pytest.approx(deficiency(k), abs=1e-12)


@pytest.mark.parametrize(("k", "short"), list(zip(FREQUENCIES, (0.011, 0.035, 0.073), strict=True)))
def test_the_lattice_alone_has_too_little_lift(k: float, short: float):
    harmonic = np.array([k * LINE.r[PANEL] / HALF_CHORD])
    own, whole = of_downwash(lattice_lag(LINE, COURSE, PANEL, harmonic)[0]), deficiency(k)
    assert abs(own) / abs(whole) - 1.0 == pytest.approx(-short, abs=2e-3)


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_with_what_is_added_it_has_theodorsens_within_a_hundredth(n: int):
    """k from 0.036 to 0.18 at 0.9 R: what the issue asks for is 3 %."""
    g = np.exp(1j * n * LINE.psi)
    added = (shed_correction(LINE, COURSE, np.full(24, HALF_CHORD))[PANEL] @ g / g).mean()
    own = lattice_lag(LINE, COURSE, PANEL, np.array([n]))[0]
    whole = deficiency(n * HALF_CHORD / LINE.r[PANEL])
    assert abs(of_downwash(own + added) / whole - 1.0) < 0.01


def test_nothing_is_added_to_a_circulation_that_rests_nor_inboard():
    added = shed_correction(LINE, COURSE, np.full(24, HALF_CHORD))
    assert np.abs(added.sum(axis=2)).max() < 1e-12
    assert np.abs(added[LINE.r < COURSE.mu_x + 0.05]).max(initial=0.0) == 0.0
