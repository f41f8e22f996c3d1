"""Measured in flight on the page: flights over the power curve, airloads in the probe."""

import math
from dataclasses import replace

import numpy as np
import pytest

from explorer.charts.measured import FlownPowers, source_of
from explorer.charts.probe_measured import airload_comparison, correlation, measured_panel
from explorer.model.inputs import OPENING, Inputs, with_rotor
from explorer.model.stand import condition_of
from explorer.model.units import SI
from explorer.text.status import validated
from explorer.workers.call import at_once
from rotor.trim.solve import solve
from rotor.validation.airloads import MeasuredCurve


def at_test(rotor: str, case: str) -> Inputs:
    condition = condition_of(rotor, case)
    return replace(with_rotor(OPENING, rotor), **condition.inputs)


GAZELLE = with_rotor(OPENING, "gazelle")
FC1 = at_test("gazelle", "FC1")


class TestFlights:
    def test_points_are_those_of_the_report_and_ours_that_of_a_solve(self):
        solution, flown, drawn = solve(FC1.design()), FlownPowers(), list[bool]()
        before = flown.marks(solution, SI)
        assert before.x == (0.14, 0.362, 0.2599, 0.3441)
        assert before.y == pytest.approx((172.5, 441.9, 221.4, 442.6))
        assert before.faint == [False, True, True, True]
        assert "computed" not in before.words[1]
        next(flown.trim_flights(solution, lambda: drawn.append(True)))
        assert not drawn  # Newer input comes first.
        for _ in range(2):
            at_once(flown.trim_flights(solution, lambda: drawn.append(True)))
        assert len(drawn) == 1
        other = solve(at_test("gazelle", "FC2").design())
        assert (
            f"computed {other.power.main_rotor / 1e3:.1f} kW" in flown.marks(solution, SI).words[1]
        )
        percent = 100.0 * (solution.power.main_rotor / 172.5e3 - 1.0)
        assert flown.value(solution) == f"FC1: {percent:.1f} %".replace("-", "−")
        assert "TM-88351" in source_of(solution.design)

    @pytest.mark.parametrize(
        "inputs",
        [
            OPENING,
            replace(GAZELLE, climb_m_s=2.0),
            replace(GAZELLE, law="linear", linear=-5.0),
            with_rotor(OPENING, "hart2"),
        ],
    )
    def test_none_for_another_blade_a_climb_a_stand_and_an_unmeasured_rotor(self, inputs: Inputs):
        solution = solve(inputs.design())
        assert FlownPowers().marks(solution, SI) is None
        assert source_of(solution.design) == ""


class TestAirloads:
    def test_the_nearest_radius_and_condition(self):
        fast = solve(replace(GAZELLE, advance_ratio=0.33).design())
        beside = airload_comparison(fast, 0.9)
        assert beside is not None
        assert (beside.case.name, beside.at_test) == ("FC2", False)
        radii = {0.75: 0.75, 0.9: 0.88, 1.0: 0.97}
        for r, measured in radii.items():
            there = airload_comparison(fast, r)
            assert {curve.quantity: curve.r for curve, _, _ in there.curves} == {
                "cl": measured,
                "cl_u2": measured,
            }
        assert 'data-do="flown" data-value="FC2"' in measured_panel(beside, 1.0)

    @pytest.mark.parametrize("case", ["BL", "MN"])
    def test_hart_2_shows_loads_and_twist_of_the_case_that_is_set(self, case: str):
        solution = solve(at_test("hart2", case).design())
        beside = airload_comparison(solution, 0.87)
        assert beside is not None
        assert (beside.case.name, beside.at_test, beside.blade) == (case, True, True)
        assert [curve.quantity for curve, _, _ in beside.curves] == [
            "cn_m2",
            "cm_m2",
            "tip_twist_deg",
            "tip_flap",
        ]
        html = measured_panel(beside, 1.0)
        assert html.count('"value":"correlation ') == 4
        assert "<button" not in html
        assert "nan" not in html

    def test_another_blade_is_named_and_not_correlated(self):
        beside = airload_comparison(solve(replace(FC1, law="linear", linear=-12.0).design()), 0.75)
        assert beside is not None
        html = measured_panel(beside, 0.0)
        assert "Computed with another twist." in html
        assert '"correlation ' not in html

    def test_the_correlation_is_that_of_the_waves_without_the_mean(self):
        psi = np.linspace(0.0, 2.0 * math.pi, 72, endpoint=False)
        beside = airload_comparison(solve(FC1.design()), 0.75)
        measured = MeasuredCurve(
            beside.case, "cl_u2", 0.75, psi, 0.3 + np.cos(psi) + 5.0 * np.cos(20.0 * psi)
        )
        assert correlation(measured, psi, 7.0 + 2.0 * np.cos(psi)) == pytest.approx(1.0)
        assert correlation(measured, psi, np.cos(psi - math.pi / 3.0)) == pytest.approx(0.5)

    @pytest.mark.parametrize(
        "inputs", [OPENING, with_rotor(OPENING, "bo105"), replace(GAZELLE, advance_ratio=0.0)]
    )
    def test_none_in_hover_and_for_a_rotor_without(self, inputs: Inputs):
        assert airload_comparison(solve(inputs.design()), 0.75) is None


def test_the_probe_shows_the_pitch_link_load_of_the_uh60a():
    """Beside the computed one where the blade twists; a rigid one has none."""
    inputs = at_test("uh60a", "µ 0.30")
    assert inputs.advance_ratio == 0.3
    solution = solve(inputs.design())
    beside = airload_comparison(solution, 0.75)
    assert beside is not None
    assert beside.at_test
    ((measured, _, computed),) = beside.curves
    assert np.ptp(computed) == pytest.approx(np.ptp(solution.elastic.pitch_link_load))
    assert "Pitch link [N]" in measured_panel(beside, 0.0)
    assert validated(solution).words == "pitch-link load measured"
    rigid = replace(inputs.design(), models=replace(inputs.design().models, elastic_twist=False))
    assert airload_comparison(solve(rigid), 0.75) is None
    assert measured.highest == 10


def test_the_chip_says_what_was_measured():
    flying = validated(solve(GAZELLE.design()))
    assert flying.words == "measured in flight"
    assert "4 flights at µ 0.14 to 0.362" in flying.sentence
    solution = solve(FC1.design())
    percent = 100.0 * (solution.power.main_rotor / 172.5e3 - 1.0)
    assert validated(solution).words == f"measured: {percent:.1f} % (FC1)".replace("-", "−")
    changed = validated(solve(replace(FC1, law="linear", linear=-12.0).design()))
    assert "The measured blade has the twist as built." in changed.sentence
    assert validated(solve(with_rotor(OPENING, "hart2").design())).words == "airloads measured"
    assert (
        validated(solve(replace(GAZELLE, advance_ratio=0.0).design())).words
        == "no test data at this condition"
    )
