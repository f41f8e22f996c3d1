"""Airloads, twist and power of rotors in flight: what the files say, how curves are compared, and what is found."""

import cmath
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.__main__ import main
from rotor.files.make_design import make_design
from rotor.trim.solve import solve
from rotor.validation.airloads import (
    HART2_BASELINE,
    CurveAgreement,
    airload_agreement,
    harmonics,
    measured_curves,
    wave_amplitude,
)
from rotor.validation.flown import LEAST, flown_angles, flown_powers, shape_errors, tail_pitch
from rotor.validation.trust import rms


def test_harmonics_of_a_known_curve_at_uneven_points():
    """0.3 + 0.2 cos ψ − 0.1 sin 4ψ, with a 20/rev that is left out."""
    psi = np.sort(np.random.default_rng(3).uniform(0.0, 2.0 * math.pi, 400))
    found = harmonics(psi, 0.3 + 0.2 * np.cos(psi) - 0.1 * np.sin(4 * psi) + 0.02 * np.cos(20 * psi), 10)
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
        assert one.correlation > {"cl": LEAST, "cl_u2": 0.7}[quantity]
        assert one.rms < one.measured_rms
        assert abs(one.mean / one.measured_mean - 1.0) < 0.25


def test_a_blade_whose_root_moves_at_3_per_rev():
    """HART II against itself: MN less BL at 3/rev, which 0.8° of root pitch and the torsion it excites make.

    Nothing fitted: normal force 9 % small and 23° late, twist of the tip 6 % large and 2° early.
    """
    mine = found("hart2-airloads")
    for quantity, r, size, angle in (("cn_m2", 0.87, 0.15, 30.0), ("tip_twist_deg", 1.0, 0.15, 10.0)):
        moved, base = mine["MN", quantity, r], mine["BL", quantity, r]
        theirs = wave_amplitude(moved.measured_waves, 3) - wave_amplitude(base.measured_waves, 3)
        ours = wave_amplitude(moved.waves, 3) - wave_amplitude(base.waves, 3)
        assert abs(abs(ours) / abs(theirs) - 1.0) < size, quantity
        assert abs(math.degrees(cmath.phase(ours / theirs))) < angle, quantity


def test_powers_of_flight():
    """Power of the Gazelle within 15 % of flight; the drag areas of the sources enclose ours."""
    rows = list(flown_powers())
    assert [row.rotor for row in rows] == ["gazelle"] * 4 + ["bo105"] * 13
    for row in rows:
        assert row.ours is not None
        assert row.band[0] <= row.ours <= row.band[1]
        if row.rotor == "gazelle":
            assert abs(row.ours / row.measured - 1.0) < 0.15


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


def test_validate_shows_them(capsys: pytest.CaptureFixture[str]):
    assert main(["validate", "hart2-airloads", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["airloads"]
    assert [row["quantity"] for row in rows] == ["cn_m2", "cm_m2", "tip_twist_deg", "tip_flap"] * 2
    assert [row["case"] for row in rows] == ["BL"] * 4 + ["MN"] * 4
    assert not any(row["fitted"] for row in rows)
    assert main(["validate", "hart2-airloads"]) == 0
    assert "HART II, DNW 2001" in capsys.readouterr().out
