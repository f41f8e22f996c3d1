"""A and B without a server: what the buttons do, A's answer, the read-outs, the charts, B − A over the disk."""

import io
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from explorer.colours import PINNED_OVERLAY, VOID
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs
from explorer.model.session_state import Analyses, Pinboard, Pinned, apply_order
from explorer.model.units import SI
from explorer.picture.fields import FIELDS, difference, fitted_range
from explorer.picture.picture import disk_png, field_values
from explorer.picture.polar import DrawnSolution, polar_grid
from explorer.scene.overlays import overlay_of
from explorer.text import readout
from explorer.text.design_words import title_words
from explorer.text.status import cautions, status_panel
from rotor import Caveat, Design, Solution, Status, doubt, make_design, solve
from rotor.trim.doubt import sureness
from tests.solved import with_caveats

QUICK = replace(make_design().models, inflow="uniform", elements=20, azimuths=36)
"""Where the physics does not matter."""
A_INPUTS = Inputs(law="linear", linear=-8.0, advance_ratio=0.2)
B_INPUTS = Inputs(law="linear", linear=-16.0, advance_ratio=0.3, mass_t=7.5)


def quick(inputs: Inputs) -> Design:
    return replace(inputs.design(), models=QUICK)


@pytest.fixture(scope="module")
def a() -> Solution:
    return solve(quick(A_INPUTS)).require()


@pytest.fixture(scope="module")
def b() -> Solution:
    return solve(quick(B_INPUTS)).require()


@pytest.fixture(scope="module")
def along(a: Solution, b: Solution) -> Solution:
    """A in B's flight."""
    return solve(replace(a.design, condition=b.design.condition)).require()


@pytest.fixture(scope="module")
def lost(along: Solution) -> Solution:
    return replace(along, status=Status.NOT_CONVERGED, message="Not trimmed: too heavy.")


class TestButtons:
    def test_a_design_without_a_trim_is_told_and_a_stays(self, a: Solution):
        before = Pinned(A_INPUTS, a)
        for order in ("pin", "swap"):
            after = apply_order(order, before, B_INPUTS, None, True)
            assert (after.pinned, after.inputs) == (before, None)
            assert "no trim" in after.sentence
        assert apply_order("unpin", before, B_INPUTS, None, True).pinned is None

    def test_swap_exchanges_the_two_in_the_flight_that_is_compared(self, a: Solution, b: Solution):
        after = apply_order("swap", Pinned(A_INPUTS, a), B_INPUTS, b, True)
        assert (after.pinned.inputs, after.pinned.solution) == (B_INPUTS, b)
        assert after.inputs == replace(A_INPUTS, advance_ratio=0.3, mass_t=7.5)
        assert apply_order("swap", Pinned(A_INPUTS, a), B_INPUTS, b, False).inputs == A_INPUTS

    def test_back_puts_a_on_the_sliders_and_keeps_it(self, a: Solution, b: Solution):
        pinned = Pinned(A_INPUTS, a)
        for trimmed in (b, None):
            after = apply_order("back", pinned, B_INPUTS, trimmed, False)
            assert (after.pinned, after.inputs, after.sentence) == (pinned, A_INPUTS, "")

    def test_buttons_of_a_pinned_design_do_nothing_without_one(self, b: Solution):
        for order in ("swap", "back", "unpin"):
            after = apply_order(order, None, B_INPUTS, b, True)
            assert (after.pinned, after.inputs, after.sentence) == (None, None, "")

    def test_a_driven_blade_is_named_and_said_to_stay_driven(self, a: Solution, b: Solution):
        driven = replace(a, design=ActuatorInputs(drives=(50.0,) * 5).apply(a.design))
        pinned = Pinned(A_INPUTS, driven)
        assert title_words(driven.design) == "UH-60A · linear −8\u00a0°/R + MFC P1 at 750 V"
        flown = pinned.design(b.design)  # With its own actuator, and without the other's.
        assert flown.condition.mass == pytest.approx(b.design.condition.mass + 132.1, abs=0.1)
        assert Pinned(A_INPUTS, a).design(driven.design).condition.mass == pytest.approx(
            a.design.condition.mass
        )
        assert "actuator" in apply_order("back", pinned, B_INPUTS, b, True).sentence

    def test_the_overlay_is_that_of_a_search_before_that_of_a(self, a: Solution, b: Solution):
        pinned = Pinned(A_INPUTS, a)
        of_a, of_search = overlay_of(None, pinned), overlay_of(b.design, pinned)
        assert (of_a.twist, of_a.colour) == (a.design.twist, PINNED_OVERLAY)
        assert (of_search.twist, of_search.colour) == (b.design.twist, None)
        assert overlay_of(None, None) is None


class TestPinboard:
    @pytest.fixture
    def board(self, a: Solution) -> Pinboard:
        """With A pinned."""
        board = Pinboard()
        assert board.act(A_INPUTS, a) is None  # Nothing asked, nothing done.
        board.ask("pin")
        assert board.act(A_INPUTS, a) is not None
        return board

    def test_a_is_solved_only_where_it_flies_along_elsewhere(
        self, board: Pinboard, a: Solution, b: Solution, along: Solution
    ):
        board.along = False
        assert board.solve(b.design) is a
        board.along = True
        assert board.solve(a.design) is a
        answer = board.solve(b.design)
        assert answer.design.condition == b.design.condition
        assert answer.design.twist == a.design.twist
        assert_allclose(answer.power.total, along.power.total, rtol=1e-7)
        assert board.solve(b.design) is answer

    def test_no_trim_there_is_an_answer_too_and_is_survived(self, board: Pinboard, a: Solution):
        heavy = quick(replace(A_INPUTS, mass_t=11.0, altitude_m=4000.0, advance_ratio=0.44))
        answer = board.solve(heavy)
        assert not answer.converged
        assert board.solve(a.design, hurried=True) is answer
        back = board.solve(a.design)
        assert back.converged

    def test_what_follows_a_swap_waits_until_the_sliders_have_moved(
        self, board: Pinboard, a: Solution, b: Solution
    ):
        board.ask("swap")
        board.ask("unpin")
        outcome = board.act(B_INPUTS, b)
        assert outcome.inputs is not None
        assert board.act(outcome.inputs, a) is not None
        assert board.pinned is None


def cells(html: str, row: str) -> list[str]:
    """The texts of a table row that begins with `row`."""
    plain = re.sub(r"<(?!/?t[rd])[^>]*>", "", html)
    rows = (re.findall(r"<td[^>]*>(.*?)</td>", line) for line in re.findall(r"<tr.*?</tr>", plain))
    return next(line for line in rows if line and line[0] == row)


def value(text: str) -> float:
    return float(text.replace("\u2009", "").replace("−", "-"))


class TestReadOut:
    def test_every_part_has_a_b_and_the_difference(self, along: Solution, b: Solution):
        html = readout.compared_power_panel(b, along)
        assert cells(html, "kW")[1:] == ["A", "B", "Δ kW", ""]
        apart = 0.0
        for title, name in (("Induced", "induced"), ("Profile", "profile"), ("Tail rotor", "tail")):
            one, other = getattr(along.power, name) / 1e3, getattr(b.power, name) / 1e3
            shown = [value(text) for text in cells(html, title)[1:4]]
            assert_allclose(shown[:2], [one, other], atol=0.51)
            assert_allclose(shown[2], other - one, atol=0.051)
            apart += shown[2]
        assert_allclose(
            value(cells(html, "Total")[3]), apart + value(cells(html, "Parasite")[3]), atol=0.21
        )
        assert cells(html, "Parasite")[3:] == ["0.0", ""]  # The same airframe at the same speed.
        band = doubt(b, along)
        banded = readout.compared_power_panel(b, along, SI, band)
        for title, within in (("Induced", band.part_bands["induced"]), ("Total", band.change_band)):
            change, word = cells(banded, title)[3:]
            apart, shown = (value(text) for text in change.split(" ± "))
            assert_allclose(shown, 1e-3 * (within or 0.0), rtol=0.1, atol=0.05)
            assert word == sureness(apart, shown)

    def test_where_a_has_no_trim_there_are_dashes_and_a_sentence(self, lost: Solution, b: Solution):
        html = readout.compared_power_panel(b, lost)
        assert "no trim at this condition" in html
        assert cells(html, "Total")[1] == "–"
        assert cells(html, "Total")[3:] == ["–", ""]
        assert 'data-explorer="change"' not in html
        assert "–" in readout.compared_trim_panel(b, lost)
        assert "A: Not trimmed: too heavy." in status_panel(b, pinned=lost)

    def test_cautions_say_whose_they_are_and_what_else_differs(
        self, a: Solution, along: Solution, b: Solution
    ):
        stall, mach = Caveat("stall", "Stalled."), Caveat("mach", "Fast.")
        noted = cautions(with_caveats(b, stall, mach), with_caveats(along, stall))
        assert noted == ["Stalled.", "B: Fast."]
        assert "fly in different conditions" in cautions(b, a)[0]
        other = replace(along, design=replace(along.design, models=replace(QUICK, inflow="drees")))
        assert "different models" in cautions(b, other)[0]
        assert cautions(with_caveats(b, stall), None) == ["Stalled."]


class TestDisk:
    def test_is_b_minus_a(self, along: Solution, b: Solution):
        field = FIELDS["Induced inflow λi"]
        grid = polar_grid(b.disk, 60, 90)
        expected = field.sample(DrawnSolution(b), grid) - field.sample(DrawnSolution(along), grid)
        apart = difference(field, along)
        assert_allclose(apart.sample(DrawnSolution(b), grid), expected, atol=1e-12)
        low, high = fitted_range(apart, field_values(b, apart))
        assert low == -high < 0.0

    def test_other_elements_and_azimuths_meet_on_one_grid(self, along: Solution, b: Solution):
        fine = solve(replace(along.design, models=replace(QUICK, elements=40, azimuths=72)))
        field, grid = FIELDS["Mach number"], polar_grid(b.disk, 60, 90)
        # Further in, Mach has a kink round the reverse flow, and further out the sweep of the tip bends it within an
        # element: no two grids see these alike.
        outboard = (grid.r > 0.4) & (grid.r < 0.85)
        coarse_apart, fine_apart = (
            difference(field, one).sample(DrawnSolution(b), grid)[outboard] for one in (along, fine)
        )
        assert_allclose(fine_apart, coarse_apart, atol=1e-3)

    def test_void_beyond_the_shorter_blade_and_in_either_reverse_flow(
        self, along: Solution, b: Solution
    ):
        rotor = along.design.rotor
        blade = replace(rotor.blade, root_cutout=0.3)
        short = solve(replace(along.design, rotor=replace(rotor, blade=blade)))
        grid = polar_grid(b.disk, 60, 90)
        void = difference(FIELDS["Mach number"], short).void(DrawnSolution(b), grid)
        assert void[grid.r < 0.299].all()
        assert not void[grid.r > 0.301].any()
        slow = solve(
            replace(along.design, condition=replace(along.design.condition, advance_ratio=0.1))
        )
        alpha = difference(FIELDS["Angle of attack"], slow).void(DrawnSolution(b), grid)
        other_way = difference(FIELDS["Angle of attack"], b).void(DrawnSolution(slow), grid)
        assert alpha.any()
        assert (alpha == other_way).all()

    def test_without_a_trim_of_a_all_is_void(self, lost: Solution, b: Solution):
        field = difference(FIELDS["Thrust dT/dr"], lost)
        image = np.array(
            Image.open(io.BytesIO(disk_png(b, field, (field.low, field.high)))).convert("RGBA")
        )
        assert tuple(image[len(image) // 4, len(image) // 2, :3]) == VOID
        assert fitted_range(field, field_values(b, field)) == (field.low, field.high)


def test_a_pinned_design_of_the_document_stays_level_beside_a_climb():
    level = replace(
        make_design(preset="thesis"),
        models=replace(make_design(preset="thesis").models, elements=20),
    )
    pinned = Pinned(Inputs(preset="thesis"), solve(level).require())
    climbing = make_design(climb_m_s=5.0, mu=0.25)
    moved = pinned.design(climbing)
    assert moved.condition == replace(climbing.condition, climb_speed=0.0)
    assert Inputs(preset="thesis", climb_m_s=5.0).design().condition.climb_speed == 0.0


def test_analyses_of_what_is_no_longer_shown_are_forgotten(cruise: Solution, fast: Solution):
    analyses = Analyses()
    kept, other = analyses.of(cruise), analyses.of(fast)
    analyses.forget_others(cruise, None)
    assert analyses.of(cruise) is kept
    assert analyses.of(fast) is not other
