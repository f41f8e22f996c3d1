"""Airloads, twist and power of rotors in flight: what the files say, how curves are compared, and what is found."""

import cmath
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Solution, make_design, solve
from rotor.aero.lifting_line import WakeCourse
from rotor.trim.analysis import Analysis
from rotor.validation import hart2
from rotor.validation.airloads import (
    HART2_BASELINE,
    PITCH_LINK,
    PITCH_LINK_SPEEDS,
    CurveAgreement,
    agreement,
    airload_agreement,
    computed_curve,
    harmonics,
    measured_curves,
    wave_amplitude,
)
from rotor.validation.flown import (
    flown_angles,
    flown_powers,
    shape_errors,
    tail_pitch,
)
from rotor.validation.hart2 import height, measured_vortices
from rotor.validation.trust import rms


def test_harmonics_of_a_known_curve_at_uneven_points():
    """0.3 + 0.2 cos ψ − 0.1 sin 4ψ, with a 20/rev that is left out."""
    psi = np.sort(np.random.default_rng(3).uniform(0.0, 2.0 * math.pi, 400))
    found = harmonics(
        psi, 0.3 + 0.2 * np.cos(psi) - 0.1 * np.sin(4 * psi) + 0.02 * np.cos(20 * psi), 10
    )
    wanted = np.zeros(21)
    wanted[[0, 1, 14]] = 0.3, 0.2, -0.1
    assert_allclose(found, wanted, atol=0.006)


def test_measured_curves_are_those_of_the_reports():
    """Means of the published curves: C_n M² 0.0900; twist −0.52° with 0.28, 0.56, 0.05° at 1, 2, 3/rev; c_l 0.676."""
    curves = {(one.case.name, one.quantity, one.r): one for one in measured_curves()}
    normal = curves["BL", "cn_m2", 0.87]
    assert len(normal.psi) == 256
    assert_allclose(harmonics(normal.psi, normal.values, 10)[0], 0.090, atol=0.001)
    twist = curves["BL", "tip_twist_deg", 1.0]
    found = harmonics(twist.psi, twist.values, 3)
    assert_allclose(found[0], -0.52, atol=0.02)
    assert_allclose(np.hypot(found[1:4], found[4:]), [0.28, 0.56, 0.05], atol=0.03)
    lift = curves["FC2", "cl_u2", 0.75]
    speed = (0.75 + 0.362 * np.sin(lift.psi)) ** 2
    assert_allclose(harmonics(lift.psi, lift.values / speed, 10)[0], 0.676, atol=0.03)


def test_baseline_of_hart2_is_that_of_the_tunnel():
    """µ 0.151, C_T/σ 0.0594: 3300 N on 4π m² at 218.24 m/s in 1.2055 kg/m³ with solidity 0.0770."""
    design = HART2_BASELINE.design()
    assert_allclose(design.condition.advance_ratio, 0.151, atol=5e-4)
    ct = 3300.0 / (1.2055 * 4.0 * math.pi * 218.24**2)
    assert_allclose(design.weight_coefficient / design.rotor.solidity, ct / 0.0770, rtol=1e-3)


def found(test: str) -> dict[tuple[str, str, float], CurveAgreement]:
    return {(one.case.name, one.quantity, one.r): one for one in airload_agreement((test,))}


def test_airloads_of_the_gazelle():
    """Nothing fitted: c_l correlates by 0.9 and more with flight at three radii and two speeds, lift by 0.7."""
    mine = found("gazelle-airloads")
    assert [quantity for _, quantity, _ in mine] == ["cl", "cl_u2"] * 6
    for (_, quantity, _), one in mine.items():
        assert one.correlation > {"cl": 0.9, "cl_u2": 0.7}[quantity]
        assert one.rms < one.measured_rms
        assert abs(one.mean / one.measured_mean - 1.0) < 0.25


def test_a_blade_whose_root_moves_at_3_per_rev():
    """HART II against itself: MN less BL at 3/rev, which 0.8° of root pitch and the torsion it excites make.

    Nothing fitted: normal force 9 % small and 23° late, twist of the tip 6 % large and 2° early.
    """
    mine = found("hart2-airloads")
    for quantity, r, size, angle in (
        ("cn_m2", 0.87, 0.15, 30.0),
        ("tip_twist_deg", 1.0, 0.15, 10.0),
    ):
        moved, base = mine["MN", quantity, r], mine["BL", quantity, r]
        theirs = wave_amplitude(moved.measured_waves, 3) - wave_amplitude(base.measured_waves, 3)
        ours = wave_amplitude(moved.waves, 3) - wave_amplitude(base.waves, 3)
        assert abs(abs(ours) / abs(theirs) - 1.0) < size, quantity
        assert abs(math.degrees(cmath.phase(ours / theirs))) < angle, quantity


def test_powers_of_flight():
    """Power of the Gazelle within 15 % of flight."""
    rows = list(flown_powers())
    assert [row.rotor for row in rows] == ["gazelle"] * 4 + ["bo105"] * 13
    for row in rows:
        assert row.computed is not None
        if row.rotor == "gazelle":
            assert abs(row.computed / row.measured - 1.0) < 0.15


def test_shape_is_free_of_level():
    """3 % up and down about a level 20 % high; the same at half the level."""
    assert_allclose(shape_errors([1.2 * 1.03, 1.2 * 0.97], [1.0, 1.0]), (0.03, 0.2))
    assert_allclose(shape_errors([0.6 * 103.0, 0.6 * 194.0], [100.0, 200.0]), (0.03, -0.4))


def test_controls_of_flight():
    """Four pitch angles of the Bo 105, 11, 13, 12 and 10 points, within 1.5° rms; of the Gazelle within 2° rms."""
    angles = flown_angles()
    assert [one.quantity for one in angles] == ["theta0", "theta1c", "theta1s", "theta0_tail"]
    assert [len(one.measured) for one in angles] == [11, 13, 12, 10]
    assert max(rms(one.error) for one in angles) < 1.5
    collective = angles[0]
    assert min(collective.measured) == 12.09
    assert_allclose(collective.error.mean(), -1.2, atol=0.2)
    mine = [row for row in flown_powers() if row.measured_angles and row.angles]
    errors = np.array([np.subtract(row.angles or (), row.measured_angles or ()) for row in mine])
    assert errors.shape == (4, 3)
    assert (np.sqrt((errors**2).mean(axis=0)) < 2.0).all()


def test_pitch_of_the_tail_rotor_in_hover():
    """The blade-element integral of dC_T = ½σa(θr² − λr)dr over the blade gives the thrust back, λ² = ½C_T/B²."""
    solution = solve(make_design(rotor="bo105", mu=0.0)).require()
    tail = solution.design.tail_rotor
    pitch, tip_speed = tail_pitch(solution), tail.angular_speed * tail.radius
    thrust = solution.power.main_rotor / 44.4 / (6.0 * math.cos(tail.cant))
    ct = thrust / (solution.design.condition.density * math.pi * tail.radius**2 * tip_speed**2)
    r = (np.arange(2000) + 0.5) / 2000.0
    inflow = math.sqrt(0.5 * ct) / tail.tip_loss
    solidity = 2.0 * 0.18 / (math.pi * 0.95)
    assert_allclose(0.5 * solidity * 5.7 * (pitch * r**2 - inflow * r).mean(), ct, rtol=1e-3)
    with pytest.raises(ValueError, match="no tail rotor"):
        tail_pitch(replace(solution, design=replace(solution.design, tail_rotor=None)))


def test_validate_shows_them(printed: Callable[..., str], answer: Callable[..., Any]):
    rows = answer("validate", "hart2-airloads")["airloads"]
    assert [row["quantity"] for row in rows] == ["cn_m2", "cm_m2", "tip_twist_deg", "tip_flap"] * 2
    assert [row["case"] for row in rows] == ["BL"] * 4 + ["MN"] * 4
    assert not any(row["fitted"] for row in rows)
    assert "HART II, DNW 2001" in printed("validate", "hart2-airloads")


# HART II: definitions against facts and closed forms


CURVES = hart2.curves()
CASES = {case.name: case for case in hart2.cases()}


@pytest.fixture(scope="module")
def solutions() -> dict[str, Solution]:
    return {name: solve(case.design()).require() for name, case in CASES.items()}


def test_amplitude_and_phase_of_a_known_curve(solutions: dict[str, Solution]):
    """2 cos(3ψ − 40°) beside the computed twist: amplitude, phase, and the difference by the law of cosines."""
    psi = np.linspace(0.0, 2.0 * math.pi, 30, endpoint=False)
    curve = replace(
        CURVES["MN", "tip_twist_deg"], psi=psi, values=2.0 * np.cos(3.0 * psi - math.radians(40.0))
    )
    one = agreement(curve, solutions["MN"])
    assert_allclose(one.amplitude(3, measured=True), 2.0)
    assert_allclose(one.phase_deg(3, measured=True), 40.0)
    assert_allclose(one.late_deg(3), one.phase_deg(3) - 40.0)
    assert_allclose(one.ratio(3), 0.5 * one.amplitude(3) - 1.0)
    third = (
        4.0
        + one.amplitude(3) ** 2
        - 4.0 * one.amplitude(3) * math.cos(math.radians(one.late_deg(3)))
    )
    assert_allclose(one.miss(3), 0.5 * math.sqrt(third))


def test_measured_motion_and_vortices_are_those_of_the_source():
    """23 flap positions a case, a mean of −0.006 R; 46 and 43 vortices above the hub, most in the disk."""
    for name, points in (("BL", 46), ("MN", 43)):
        flap = CURVES[name, "tip_flap"]
        assert len(flap.psi) == 23
        assert_allclose(flap.waves[0], -0.006, atol=4e-4)
        x, y, z = measured_vortices(name)
        assert len(x) == points
        assert (np.hypot(x, y) > 1.0).sum() <= 2
        assert 0.0 < z.min() < z.max() < 0.14
    twist = CURVES["MN", "tip_twist_deg"].waves
    assert_allclose(np.hypot(twist[1:4], twist[4:]), [0.28, 0.42, 1.28], atol=0.03)


def test_height_of_a_vortex_that_no_inflow_moves():
    """Then it rises along a straight line: β0 above the hub at the edge, −µ_z t above that."""
    course = WakeCourse(
        0.15, -0.0113, 0.0, coning=0.04, flap_1c=0.0, flap_1s=0.0, core=(1e-4, 1e-6)
    )
    x, y = np.array([-0.8, 0.0, 0.6]), np.array([0.6, 0.0, -0.7])
    age = (x + np.sqrt(1.0 - y * y)) / 0.15
    assert_allclose(height(course, x, y), 0.04 + 0.0113 * age, atol=1e-12)


def test_moment_of_the_pitch_rate(solutions: dict[str, Solution]):
    """C_m of MN at 3/rev, −(π/4) c θ̇/U at 0.87 R with U = ΩR (0.87 + µ sin ψ) over the section's own by hand."""
    solution = solutions["MN"]
    disk, psi = solution.disk, solution.disk.psi
    i = int(np.argmin(np.abs(disk.r - 0.87)))
    theta = harmonics(psi, disk.theta[i], 8)
    order = np.arange(1, 9)
    rate = order * theta[9:] @ np.cos(np.outer(order, psi)) - order * theta[1:9] @ np.sin(
        np.outer(order, psi)
    )
    speed = disk.r[i] + solution.design.condition.advance_ratio * np.sin(psi)
    mach = 2.0 * 109.01 / 342.2
    by_hand = -0.25 * math.pi * 0.0605 * rate * speed * mach**2
    curve = replace(CURVES["MN", "cm_m2"], r=float(disk.r[i]))
    whole = harmonics(*computed_curve(curve, solution), 3)
    expected = harmonics(psi, by_hand, 3)
    assert math.hypot(expected[3], expected[6]) > 0.001
    rest = whole - expected  # The section's own moment, a fifth of it, and that of d²θ/dt².
    assert math.hypot(rest[3], rest[6]) < 0.0007


# Pitch-link loads of the UH-60A: the source's numbers and signs


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
    # By a fit to all 252 and 135 points.
    for mu, n, size, phase in (
        (0.15, 1, 1630.0, 48.0),
        (0.37, 2, 1340.0, 76.0),
    ):
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
    # The bearing's share in two modes only.
    assert_allclose(ours, by_hand, atol=0.12 * np.ptp(ours))
    assert np.corrcoef(ours, by_hand)[0, 1] > 0.98
