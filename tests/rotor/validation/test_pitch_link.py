"""Pitch-link loads of the UH-60A: the source's numbers, signs, and what the trust page says of them."""

import math

import numpy as np
from numpy.testing import assert_allclose

from rotor.files.make_design import make_design
from rotor.trim.analysis import Analysis
from rotor.trim.solve import solve
from rotor.validation.airloads import PITCH_LINK, PITCH_LINK_SPEEDS, computed_curve, measured_curves


def test_measured_loads_are_those_of_the_figure():
    """Highest and lowest digitised points, as printed, in pounds-force; none of the curves has a mean."""
    curves = [one for one in measured_curves() if one.case.test == PITCH_LINK]
    printed = ((543.2, -460.1), (592.8, -426.2), (619.5, -460.0), (813.4, -596.6))
    assert [one.case.conditions["mu"] for one in curves] == list(PITCH_LINK_SPEEDS)
    for one, (high, low) in zip(curves, printed, strict=False):
        assert_allclose(one.values.max() / 4.44822, high, rtol=0.02)
        assert_allclose(one.values.min() / 4.44822, low, rtol=0.02)
    for one in curves:
        assert len(one.psi) == 90
        assert abs(one.values.mean()) < 0.01 * np.ptp(one.values)
    for mu, n, size, phase in ((0.15, 1, 1630.0, 48.0), (0.37, 2, 1340.0, 76.0)):  # By a fit to all 252 and 135 points.
        wave = next(one for one in curves if one.case.conditions["mu"] == mu).waves
        found = complex(wave[n], wave[n + 10])
        assert_allclose(abs(found), size, rtol=0.03)
        assert_allclose(math.degrees(np.angle(found)), phase, atol=2.0)


def test_load_is_that_of_the_moment_nose_up_on_the_blade():
    """The link holds the blade by a moment against its elastic twist at the bearing: K_θ φ_root over the horn.

    A blade twisted nose up at the root pulls its nose down by the link, which is where the measured load is positive.
    """
    measured = next(one for one in measured_curves() if one.case.test == PITCH_LINK)
    solution = solve(make_design(mu=0.3)).require()
    elastic, structure = solution.elastic, solution.design.rotor.blade.structure
    psi, ours = computed_curve(measured, solution)
    torsion = Analysis(solution).linear.problem.torsion
    root = torsion.modes.shape[:, 0] @ elastic.coordinates
    order = (np.arange(len(root)) + 1) // 2
    around = sum(
        own * (np.cos(n * psi) if k % 2 or not k else np.sin(n * psi))
        for k, (own, n) in enumerate(zip(root, order, strict=True))
    )
    by_hand = structure.control_stiffness * (around - root[0]) / structure.pitch_horn
    assert np.ptp(ours) > 1000.0
    assert_allclose(ours, by_hand, atol=0.12 * np.ptp(ours))  # The bearing's share in two modes only.
    assert np.corrcoef(ours, by_hand)[0, 1] > 0.98
