"""The test stand of the page: its inputs, links, measured conditions, the chart over measured points, and the chip."""

from dataclasses import replace

import pytest

from explorer.charts.measured import MeasuredChart
from explorer.export.provenance import condition_line
from explorer.model.inputs import OPENING, Inputs, with_rotor
from explorer.model.session_state import Pinned
from explorer.model.stand import (
    TRIM_TITLES,
    StandInputs,
    equivalent_stand,
    load_of,
    measured_conditions,
)
from explorer.text.design_words import flight_name, flight_words
from explorer.text.status import row_of, validated
from explorer.widgets.controls import DesignControls
from explorer.workers.call import at_once
from rotor import make_design, solve
from rotor.support.chart import Points
from rotor.validation.compare import SETS, load_set
from tests.curves import curves

XV15 = next(one for one in measured_conditions("xv15") if one.test == "Tunnel, 15° forward")
FORWARD = replace(with_rotor(OPENING, "xv15"), advance_ratio=XV15.advance_ratio, stand=XV15.stand)


def test_the_wind_tunnel_begins_with_what_the_flight_had():
    flight = solve(Inputs(law="builtin", advance_ratio=0.2, download=False).design())
    stand = equivalent_stand(flight)
    tested = solve(Inputs(law="builtin", advance_ratio=0.2, stand=stand).design())
    assert tested.power.main_rotor == pytest.approx(flight.power.main_rotor, rel=0.02)
    assert load_of(tested, "thrust_n") == pytest.approx(
        flight.ct * flight.design.thrust_unit, rel=2e-3
    )
    held = solve(
        replace(
            OPENING,
            stand=replace(stand, load="collective_deg", value=load_of(tested, "collective_deg")),
        ).design()
    )
    assert held.ct_over_sigma == pytest.approx(stand.value, rel=5e-3)


def test_a_flies_along_into_a_test_and_back():
    flight, tested = solve(OPENING.design()), solve(replace(OPENING, stand=StandInputs()).design())
    assert Pinned(OPENING, flight).design(tested.design).models.trim == "wind-tunnel"
    assert (
        Pinned(replace(OPENING, stand=StandInputs()), tested).design(flight.design) == flight.design
    )
    assert (
        Pinned(OPENING, flight).sliders(replace(OPENING, stand=StandInputs()), along=True).stand
        == StandInputs()
    )


def test_a_test_in_words():
    design = FORWARD.design()
    assert flight_name(FORWARD) == "µ 0.125, wind tunnel, CT/σ 0.075, tilt 15.0°, tip Mach 0.691"
    assert "wind tunnel" in flight_words(design)
    assert "kg" not in condition_line(design)


class TestWidgets:
    def test_choices_by_hand(self, controls: DesignControls):
        panel = controls.stand

        def choose(name: str, value: object) -> None:
            panel.form.place(name, value)
            panel._heard(name, by_hand=True)

        choose("trim", "wind-tunnel")
        assert controls.inputs().stand == StandInputs()
        assert panel.form._handles["measured_test"].visible
        choose("stand_load", "collective_deg")
        choose("collective_deg", 6.5)
        assert controls.inputs().stand == StandInputs(load="collective_deg", value=6.5)
        choose("trim", "controls")
        assert controls.inputs().stand == StandInputs(
            "controls", "collective_deg", 6.5, flapping="free"
        )
        choose("trim", "flight")
        assert controls.inputs().stand is None
        assert not panel.form._handles["measured_test"].visible
        controls._choose_rotor("xv15")
        assert TRIM_TITLES["flight"] not in panel.form._handles["trim"].options
        choose("measured_test", XV15.test)
        assert controls.inputs().stand is not None
        assert panel.form._handles["measured_point"].visible
        choose("shaft_tilt_deg", 12.0)
        controls.refresh(controls.inputs(), controls._units)
        assert not panel.form._handles["measured_point"].visible
        controls.set_inputs(FORWARD)
        assert controls.inputs() == FORWARD

    def test_the_tip_mach_number_follows_the_rotor_speed(self, controls: DesignControls):
        given = StandInputs(load="thrust_n", value=5e4)
        controls.set_inputs(replace(OPENING, stand=given))
        shown, thrust = (controls.stand.form._handles[name] for name in ("tip_mach", "thrust_n"))
        before, most = shown.value, thrust.max
        controls.form.place("rotor_speed_percent", 80.0)
        controls.refresh(controls.inputs(), controls._units)
        assert shown.value == pytest.approx(0.8 * before, rel=1e-5)
        controls.set_inputs(controls.inputs())
        assert thrust.max == pytest.approx(0.64 * most, rel=0.02)
        assert controls.inputs().stand == given


def test_the_chart_has_every_point_its_scatter_and_our_error():
    solution, chart = solve(FORWARD.design()), MeasuredChart()
    assert chart.chart(solve(OPENING.design())) is None
    before = chart.chart(solution)
    assert before is not None
    line, marks, _ = curves(before)
    assert len(marks.x) == 4
    assert len(line.x) == 0
    drawn: list[bool] = []
    at_once(chart.trim_points(solution, lambda: drawn.append(True)))
    after = chart.chart(solution)
    assert drawn
    assert after is not None
    assert after.value.startswith("+")
    assert "rms 5.4 %" in after.value
    line, marks, here = curves(after)
    assert isinstance(marks, Points)
    assert marks.y == pytest.approx([5.7, 5.95, 6.2, 6.65])
    assert marks.scatter == pytest.approx([0.1] * 4)
    computed = dict(zip(line.x, line.y, strict=True))
    assert computed[FORWARD.advance_ratio] == pytest.approx(here.y[0], rel=1e-5)
    assert "computed 6.0" in marks.words[0]


@pytest.mark.parametrize("name", [name for name in SETS if load_set(name).against is None])
def test_every_set_has_its_row_with_the_default_inflow(name: str):
    measured = load_set(name)
    row = row_of(measured, "annulus" if measured.kind == "hover" else "lifting-line")
    assert row.error is not None


def test_the_chip_says_how_well_the_region_is_validated():
    record = validated(solve(FORWARD.design()))
    assert record.words == "measured: rms 5.4 %"
    assert "missed" in record.sentence
    assert (
        validated(solve(replace(FORWARD, inflow="uniform").design())).words == "measured: rms 1.3 %"
    )
    assert (
        validated(solve(replace(FORWARD, inflow="drees").design())).words
        == "not compared with this inflow"
    )
    assert (
        "twist as built"
        in validated(solve(replace(FORWARD, law="linear", linear=-30.0).design())).sentence
    )
    fast = validated(solve(replace(FORWARD, advance_ratio=0.35).design()))
    assert fast.words == "outside the test range"
    assert "µ 0.35, tested 0.125…0.2" in fast.sentence
    uh60a = validated(solve(OPENING.design()))
    assert uh60a.words == "no test data at this condition"
    rising = validated(solve(replace(OPENING, advance_ratio=0.0, climb_m_s=3.0).design()))
    assert rising.words == "outside the test range"
    assert "rate of climb 3 m/s, tested in level flight" in rising.sentence
    assert "in hover only" in uh60a.sentence
    for rotor in ("castles-gray", "castles-gray-twisted"):
        stand = validated(
            solve(
                make_design(rotor=rotor, mu=0.0, trim="wind-tunnel", stand={"ct_over_sigma": 0.08})
            )
        )
        assert "This project has no usable measurement of what twist saves." in stand.sentence
