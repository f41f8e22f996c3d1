"""The page's numbers, words and charts, without a server: inputs, read-outs, plots, worker."""

import itertools
import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.charts import plots
from explorer.charts.plots import PowerCurves
from explorer.charts.strip import autorotation_words
from explorer.model.inputs import OPENING, Inputs, baseline_of, baseline_title, inputs_of
from explorer.model.units import number
from explorer.text import readout
from explorer.text.design_words import model_words
from explorer.text.line import twist_pieces
from explorer.text.status import provenance, status_panel, trust_page
from explorer.text.why import why
from explorer.workers.call import at_once
from rotor import Caveat, Design, Solution, Status, make_design, solve
from rotor.aero.switches import SWITCHES, switched_off
from rotor.design.twist import LinearTwist
from rotor.validation.trust import KINDS, trust_rows
from tests.solved import with_caveats

LINEAR = Inputs(law="linear", linear=-8.0).design()


class TestInputs:
    def test_every_switch_of_the_physics_reaches_the_models(self):
        for name in SWITCHES:
            inputs = replace(Inputs(), **{name: False})
            assert [switch.name for switch in switched_off(inputs.design().models)] == [name]
            assert inputs_of(inputs.design()) == inputs

    def test_the_models_in_words_name_the_inflow_in_use(self):
        hover = Inputs(advance_ratio=0.0)
        assert ": annulus balance, " in model_words(hover.design())
        assert ": closed form, eq. (3.3), " in model_words(
            replace(hover, hover_inflow="closed-form").design()
        )
        assert model_words(Inputs(tip_loss=False).design()).endswith(": Lifting line, no tip loss")

    def test_baselines(self):
        assert baseline_of(Inputs(law="linear").design()).twist.spec() == "uh60a"
        assert baseline_of(Inputs(preset="thesis").design()).twist.spec() == "linear:-16"
        assert baseline_title(make_design(preset="thesis")) == "linear −16°"


class TestReadout:
    @pytest.mark.parametrize(
        ("value", "digits", "signed", "text"),
        [
            (1234.4, 0, False, "1\u2009234"),
            (-2.346, 2, False, "−2.35"),
            (3.0, 1, True, "+3.0"),
            (-0.004, 1, True, "0.0"),
            *((value, 0, False, "–") for value in (None, math.nan, math.inf, -math.inf)),
        ],
    )
    def test_numbers(self, value: float | None, digits: int, signed: bool, text: str):
        assert number(value, digits, sign=signed) == text

    def test_change_against_the_baseline(self, cruise: Solution):
        dearer = replace(
            cruise,
            last_power=replace(
                cruise.power, profile=cruise.power.profile + 0.1 * cruise.power.total
            ),
        )
        assert "+10.0 %" in readout.power_panel(dearer, cruise)
        assert re.search(r"−9\.1 %", readout.power_panel(cruise, dearer))

    def test_hover_has_a_figure_of_merit_and_flight_a_lift_to_drag(self, cruise: Solution):
        hover = solve(make_design(mu=0.0))
        assert "Figure of merit" in readout.trim_panel(hover)
        assert "Rotor L/De" in readout.trim_panel(cruise)
        ideal = hover.ct**1.5 / math.sqrt(2.0)  # over ρA(ΩR)³, eq. (2.10)
        assert f"{ideal / hover.cp:.3f}" in readout.trim_panel(hover)

    def test_not_converged_is_a_red_sentence_and_no_change(self, cruise: Solution):
        lost = replace(cruise, status=Status.NOT_CONVERGED, message="Not trimmed: too heavy.")
        assert 'data-explorer="change"' not in readout.power_panel(cruise, lost)
        html = status_panel(lost)
        assert 'data-kind="problem"' in html
        assert "Not trimmed: too heavy. Greyed: last converged solution" in html
        assert "choose less. Greyed" in status_panel(None, "too much: choose less")
        noted = status_panel(with_caveats(cruise, Caveat("a", "Read <this> with care.")))
        assert "Read &lt;this&gt; with care." in noted
        assert 'data-kind="converged"' in noted

    def test_nothing_that_is_no_number_reaches_the_screen(self, cruise: Solution):
        broken = replace(
            cruise,
            last_power=replace(cruise.power, induced=math.nan),
            controls=replace(cruise.controls, collective=math.nan),
            ct=math.inf,
        )
        for html in (
            readout.power_panel(broken, cruise),
            readout.trim_panel(broken),
            provenance(broken),
        ):
            assert not re.search(r"\b(nan|inf)\b", html, re.IGNORECASE)

    def test_kappa_and_the_bound_beside_it(self, cruise: Solution):
        html = readout.power_panel(cruise, None)
        assert f'data-explorer="kappa">{cruise.induced_power_factor:.2f}' in html
        assert "ideal <b>" in html
        ideal = readout.ideal_induced(cruise)
        assert ideal is not None
        assert 0.5 * cruise.power.induced < ideal < cruise.power.induced
        fast = solve(make_design(mu=0.43, mass_kg=6000.0)).require()
        assert readout.ideal_induced(fast) is None
        assert "not converged above" in readout.power_panel(fast, None)


class TestPlots:
    def test_ranges_are_held(self):
        first = plots.held_range(None, 0.0, 2300.0)
        assert first[0] == 0.0
        assert first[1] >= 2300.0
        assert plots.held_range(first, 0.0, 2000.0) == first
        assert plots.held_range(first, 0.0, 1.02 * first[1]) != first
        assert plots.held_range(first, 0.0, 500.0)[1] < first[1]
        assert plots.held_range(first, math.nan, math.nan) == first


class TestPowerCurves:
    def test_sweep_matches_single_solves(self):
        design, curves = LINEAR, PowerCurves()
        assert np.isnan(curves.known(design, baseline_of(design)).design).all()
        assert at_once(curves.sweep(design, baseline_of(design)))
        k = plots.SWEEP.index(0.2)
        known = curves.known(design, baseline_of(design))
        assert_allclose(known.design[k], solve(design).power.total / 1e3, rtol=1e-6)
        assert_allclose(known.reference[k], solve(baseline_of(design)).power.total / 1e3, rtol=1e-6)
        assert (np.diff(known.design[:6]) < 0.0).all()  # From hover, without a gap.

    def test_it_gives_way_before_each_trim_while_others_wait(self, monkeypatch: pytest.MonkeyPatch):
        trims, one = list[Design](), solve(LINEAR)
        monkeypatch.setattr(
            "explorer.charts.plots.solve", lambda design, start: trims.append(design) or one
        )
        assert list(PowerCurves().sweep(LINEAR, LINEAR)) == []
        alone = len(trims)
        monkeypatch.setattr(
            "explorer.charts.plots.UPDATES", SimpleNamespace(crowded=True, waiting=0)
        )
        for k, _ in enumerate(PowerCurves().sweep(LINEAR, LINEAR)):
            assert len(trims) == alone + k
        assert len(trims) == 2 * alone == 2 * len(plots.SWEEP)

    def test_linear_inflow_has_a_gap_beside_hover(self):
        design = Inputs(law="linear", linear=-8.0, inflow="drees").design()
        curves = PowerCurves(haste=math.inf)
        at_once(curves.sweep(design, design, lambda: True))
        known = np.isfinite(curves.known(design, design).design)
        # At µ 0.45 40 % of the disk would be stalled; of a few points the curve ends at the last that trims.
        assert known.tolist() == [mu == 0.0 or 0.075 <= mu < 0.39 for mu in plots.SWEEP]

    def test_a_descent_has_its_curve_beyond_the_vortex_ring_state(self):
        design = Inputs(law="linear", linear=-8.0, climb_m_s=-13.0).design()
        curves = PowerCurves(haste=math.inf)
        assert at_once(curves.sweep(design, baseline_of(design)))
        curve = curves.known(design, baseline_of(design))
        answers = [solve(design.at(mu=mu)) for mu in plots.SWEEP]
        assert np.isfinite(curve.design).tolist() == [one.converged for one in answers]
        assert not np.isfinite(curve.design[:3]).any()
        assert np.isfinite(curve.design[3:]).all()
        words = autorotation_words(curve)
        driven = [
            mu
            for mu, one in zip(plots.SWEEP, answers, strict=True)
            if one.converged and one.power.total < 0.0
        ]
        assert words.startswith(f"Autorotation between µ {driven[0]:g} and {driven[-1]:g}")
        assert words.endswith("No solution below µ 0.075: vortex ring state.")

    def test_newer_input_before_the_coarse_curve_is_known_ends_the_sweep(
        self, monkeypatch: pytest.MonkeyPatch
    ):
        """Old enough, it is swept coarsely; fresh enough, or slow, frames come first, and it is not tried at once."""
        # A busy machine sweeps more slowly.
        monkeypatch.setattr("explorer.charts.plots.OLD_CURVE_S", math.inf)
        curves, design, next_one = (
            PowerCurves(haste=math.inf),
            LINEAR,
            replace(LINEAR, twist=LinearTwist(-0.16)),
        )
        assert at_once(curves.sweep(design, baseline_of(design), lambda: True))
        assert not at_once(curves.sweep(next_one, baseline_of(next_one), lambda: True))
        assert np.isfinite(
            curves.known(next_one, baseline_of(next_one)).design[1:10]
        ).all()  # The one before stays.
        hasty, calls = PowerCurves(haste=0.0), itertools.count()
        assert not at_once(hasty.sweep(design, design, lambda: True))
        assert hasty.recent
        # Input that comes once every third point is known loses nothing, and nothing more is computed.
        late = PowerCurves(haste=0.0)
        assert at_once(late.sweep(design, design, lambda: next(calls) >= 8))
        assert np.isfinite(late.known(design, design).design).all()

    def test_beyond_the_rotor_the_sweep_ends(self, monkeypatch: pytest.MonkeyPatch):
        """A trim that fails is slow to fail: two in a row are enough, one in haste."""
        asked: list[float] = []

        def failing(design: Design, start: Solution | None) -> Solution:
            asked.append(design.condition.advance_ratio)
            answer = solve(design, start)
            return replace(answer, status=Status.NOT_CONVERGED) if asked[-1] > 0.26 else answer

        monkeypatch.setattr("explorer.charts.plots.solve", failing)
        design, curves = LINEAR, PowerCurves(haste=math.inf)
        at_once(curves.sweep(design, design, lambda: True))
        assert asked[-2:] == [0.225, 0.3]
        asked.clear()
        at_once(curves.sweep(design, design, lambda: False))
        assert [mu for mu in asked if mu > 0.24] == [0.3, 0.25, 0.275]
        assert np.isfinite(curves.known(design, design).design[:11]).all()
        assert np.isnan(curves.known(design, design).design[11:]).all()


@pytest.mark.parametrize("law", ["given", "optimised"])
def test_a_search_that_has_found_nothing_yet_has_its_twist_as_built(law: str):
    pieces = twist_pieces(replace(OPENING, law=law), OPENING.design())
    assert "".join(piece.text for piece in pieces) == " with its twist as built"


def test_a_test_stand_has_no_fuselage_and_no_tail_rotor():
    stand = make_design(
        rotor="xv15", mu=0.17, stand={"ct_over_sigma": 0.08, "shaft_tilt_deg": 15.0}
    )
    flight = make_design()
    assert list(readout.part_titles(stand).values()) == ["Induced", "Profile", "Propulsive"]
    assert list(readout.part_titles(flight).values()) == [
        "Induced",
        "Profile",
        "Parasite",
        "Tail rotor",
    ]
    assert readout.part_titles(flight, stand)["parasite"] == "Parasite, propulsive"
    climbing = make_design(climb_m_s=4.0)
    assert list(readout.part_titles(climbing).values()) == [
        "Induced",
        "Profile",
        "Parasite",
        "Climb",
        "Tail rotor",
    ]
    assert list(readout.part_titles(flight, climbing)) == list(readout.part_titles(climbing))
    assert "326 kW" in readout.power_panel(solve(climbing), None)
    solution = solve(stand)
    assert solution.power.tail == 0.0
    html = readout.power_panel(solution, None)
    assert "Propulsive force times airspeed" in html
    assert "Parasite" not in html
    assert "propulsive" in why(
        solution, solve(replace(stand, condition=replace(stand.condition, advance_ratio=0.3)))
    )


# The trust page


def test_every_row_and_kind_is_on_the_page():
    html = trust_page()
    assert html.count('class="rx-trust-row"') == len(trust_rows())
    assert html.count("<h2>") == len(KINDS)
    assert "rotor/trim/test_power.py::test_energy_identity" in html
    shown = re.sub(r'title="[^"]*"', "", html)
    assert not re.search(r"[> ]-\d|\b(nan|inf)\b|C_| %", shown, re.IGNORECASE)
