"""The Actuator tab without a browser: settings, shapes, pictures and words."""

import math
import pickle
import re
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.charts.plots import Plot
from explorer.model.inputs import ViewState, baseline_of
from explorer.picture.camera_views import FIELD_OF_VIEW
from explorer.picture.picture import make_picture
from explorer.tabs.actuator import actuator_controls as actuator_plots
from explorer.tabs.actuator import actuator_controls as actuator_table
from explorer.tabs.actuator import actuator_words as actuator_readout
from explorer.tabs.actuator import cut_blade as actuator_cut
from explorer.tabs.actuator.actuator_inputs import (
    CONCEPTS,
    MOST_SEGMENTS,
    ActuatorInputs,
    concept_divisions,
    drive_of,
    question_of,
    swing_of,
)
from explorer.tabs.actuator.actuator_tasks import PoolAnswers, answer, lean, sweep_task, verdict_tasks
from explorer.tabs.actuator.actuator_words import amplitude_plot, phase_plot, sweep_sentence
from explorer.tabs.actuator.cut_picture import cut_picture, flown_twist, section_svg, share_colour, voltage_shares
from explorer.workers.pool import JobEnded, JobEvent, JobFailed, JobStarted
from rotor.actuator.catalogue import PiezoPly, actuators, find_actuator
from rotor.actuator.harmonic import PowerMap
from rotor.actuator.verdict import Verdict, verdict_sentence
from rotor.files.make_design import make_design
from rotor.trim.solve import solve

DESIGN = make_design(preset="flight", mu=0.2)
FULL = (100.0,) * MOST_SEGMENTS
ALL = tuple(actuators())


def test_at_rest_the_design_is_the_very_same():
    assert ActuatorInputs().apply(DESIGN) is DESIGN


def test_full_voltage_makes_the_twist_that_the_range_gives():
    """+1500 V of a 2000 V range: three quarters of what the blade at rest gains, derated, on its own blade."""
    inputs = ActuatorInputs(drives=FULL, counted=60.0)
    applied, installed = inputs.apply(DESIGN), inputs.installed(DESIGN.rotor)
    made = applied.twist
    gained = float(made(1.0) - made(0.0)) - float(DESIGN.twist(1.0) - DESIGN.twist(0.0))
    # The table begins at 0.05 R, a hair outboard of the pitch bearing, and holds its end.
    assert_allclose(gained, 0.6 * 0.75 * np.abs(installed.rest_shapes[:, -1]).sum(), rtol=5e-3)
    assert applied.rotor.blade.structure == installed.blade
    assert 1.0 < gained / (0.6 * 0.75 * installed.attainable) < 1.15  # Rotation takes some of it.


def test_crossed_fibres_turn_the_other_way():
    installed = ActuatorInputs().installed(DESIGN.rotor)
    there = ActuatorInputs(drives=FULL).change(installed, 1.0)
    assert_allclose(ActuatorInputs(drives=FULL, crossed=True).change(installed, 1.0), -there)
    tube = ActuatorInputs(actuator="SMA_tube", drives=FULL)
    installed = tube.installed(DESIGN.rotor)  # Has no fibres to cross.
    assert_allclose(replace(tube, crossed=True).change(installed, 1.0), tube.change(installed, 1.0))


@pytest.mark.parametrize("id", ALL)
def test_drive_and_swing_are_inverse(id: str):
    actuator = find_actuator(id)
    for drive in (-100.0, -37.0, 0.0, 41.0, 100.0):
        if isinstance(actuator, PiezoPly) and drive < 0.0 and actuator.voltage_range[0] == 0.0:
            continue
        assert_allclose(drive_of(actuator, swing_of(actuator, drive)), drive, atol=1e-9)


def test_a_new_twist_changes_power_and_a_harmonic_too():
    still = solve(DESIGN).power.total
    steady = solve(ActuatorInputs(drives=FULL).apply(DESIGN)).power.total
    turning = ActuatorInputs(per_rev=2, amplitude=100.0).apply(DESIGN)
    assert abs(steady - still) > 500.0
    assert turning.active_twist is not None
    assert abs(solve(turning).power.total - still) > 500.0


def test_each_blade_is_drawn_with_the_twist_of_its_azimuth():
    rigid = replace(DESIGN, models=replace(DESIGN.models, elastic_twist=False))
    still, turning = (solve(i.apply(rigid)) for i in (ActuatorInputs(), ActuatorInputs(per_rev=1, amplitude=100.0)))
    assert make_picture(still, ViewState(), (0.0, 10.0)).blades.shapes == ()
    shapes = make_picture(turning, ViewState(), (0.0, 10.0)).blades.shapes
    assert len(shapes) == DESIGN.rotor.blades
    middle = 0.5 * (shapes[0] + shapes[2])  # Opposite blades at 1/rev move against each other.
    assert_allclose(middle, make_picture(still, ViewState(), (0.0, 10.0)).blade_vertices, atol=1e-3)
    assert np.abs(shapes[0] - shapes[2]).max() > 1e-3


def test_the_baseline_has_no_actuator():
    turning = ActuatorInputs(per_rev=2, drives=FULL).apply(DESIGN)
    assert baseline_of(turning) == baseline_of(DESIGN)


@pytest.mark.parametrize("concept", CONCEPTS)
def test_segments_fit_the_sliders(concept: str):
    assert len(concept_divisions(concept)) + 1 <= MOST_SEGMENTS


def test_the_question_does_not_hang_on_speed_voltage_or_view():
    inputs = ActuatorInputs()
    fast = make_design(preset="flight", mu=0.3)
    moved = replace(inputs, drives=FULL, shown=True, per_rev=1, crossed=True)
    assert question_of(inputs, DESIGN) == question_of(moved, fast)
    assert question_of(inputs, DESIGN) != question_of(replace(inputs, plies=3), DESIGN)


@pytest.mark.parametrize("blade", ["retrofit", "new"])
@pytest.mark.parametrize("id", ALL)
def test_the_cut_blade_is_whole_finite_and_small(id: str, blade):
    inputs = ActuatorInputs(actuator=id, blade=blade, concept="three-segment", drives=FULL)
    installed = inputs.installed(DESIGN.rotor)
    picture = cut_picture(inputs, installed, DESIGN, 0.0)
    for mesh, colour in picture.solids:
        assert np.isfinite(mesh.vertices).all()
        assert mesh.faces.max() < len(mesh.vertices)
        assert np.abs(mesh.vertices[:, 1]).max() < 0.5
        assert all(0 <= channel <= 255 for channel in colour)
    assert sum(len(mesh.vertices) for mesh, _ in picture.solids) < 25_000
    assert np.isfinite(picture.ghost).all()
    assert np.isfinite(picture.leads).all()


def test_walls_stand_on_the_true_contour_and_plies_outside():
    installed = ActuatorInputs().installed(DESIGN.rotor)
    cut = actuator_cut.cut_blade(installed, DESIGN.rotor)
    plies = [part for part in cut.parts if part.role == "ply"]
    assert plies
    for part in plies:
        upper = part.outer[:, 5, 1] > 0.0
        away = part.inner[:, 5, 1] - part.outer[:, 5, 1]
        assert (np.where(upper, away, -away) > 0.0).all()
    spar = next(part for part in cut.parts if part.role == "spar")
    assert_allclose(spar.outer[:, 0, 0], 0.25 * float(DESIGN.rotor.blade.chord(0.5)), rtol=1e-6)
    assert (spar.inner[:, 10, 1] > spar.outer[:, 10, 1]).all()  # The lower wall grows inwards.


def test_voltage_turns_the_tip_of_the_cut_blade_nose_up():
    inputs = ActuatorInputs(drives=FULL, magnified=10.0)
    installed = inputs.installed(DESIGN.rotor)
    cut = actuator_cut.cut_blade(installed, DESIGN.rotor)
    tail = [
        cut_picture(each, installed, DESIGN, 0.0).solids[-4][0].vertices[:, 2].min()
        for each in (ActuatorInputs(), inputs)
    ]
    assert len(cut.parts) >= 8
    assert tail[1] < tail[0]  # Nose up is tail down.


def test_leads_run_from_the_box_to_every_segment():
    inputs = ActuatorInputs(concept="three-segment")
    cut = actuator_cut.cut_blade(inputs.installed(DESIGN.rotor), DESIGN.rotor)
    leads = actuator_cut.lead_segments(cut, DESIGN.rotor, np.zeros(len(cut.edge_r)))
    ends = {round(float(x), 6) for x in leads[:, 1, 0]}
    for low, _ in actuator_cut.spans_of(cut):
        assert round(float(cut.outward(low)), 6) in ends


@pytest.mark.parametrize("aspect", [0.6, 0.9, 1.6])
def test_the_close_up_holds_the_whole_blade(aspect: float):
    camera = actuator_cut.fit_cut(DESIGN.rotor.radius, aspect)
    inputs = ActuatorInputs(drives=FULL)
    picture = cut_picture(inputs, inputs.installed(DESIGN.rotor), DESIGN, 0.0)
    points = np.concatenate([mesh.vertices for mesh, _ in picture.solids]) - camera.position
    forward = camera.look_at - camera.position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    depth = points @ forward
    tangent = math.tan(FIELD_OF_VIEW / 2.0)
    assert depth.min() > 1.0  # The near plane.
    assert np.abs(points @ np.cross(right, forward) / depth).max() < tangent
    assert np.abs(points @ right / depth).max() < tangent * aspect


def test_colours_of_voltage_are_two_sided():
    red, _, blue = share_colour(1.0)
    assert red > blue
    red, _, blue = share_colour(-1.0)
    assert blue > red
    assert len(set(share_colour(0.0))) == 1


def test_the_harmonic_moves_the_colour_with_azimuth():
    inputs = ActuatorInputs(per_rev=1, amplitude=50.0)
    installed = inputs.installed(DESIGN.rotor)
    assert voltage_shares(inputs, installed, 0.0)[0] > 0.0 > voltage_shares(inputs, installed, math.pi)[0]


@pytest.mark.parametrize("id", ALL)
def test_the_section_is_drawn_with_its_plies(id: str):
    installed = ActuatorInputs(actuator=id).installed(DESIGN.rotor)
    svg = section_svg(installed, (0.5,))
    assert svg.count('class="rx-ply"') == (2 if isinstance(installed.actuator, PiezoPly) else 0)
    assert "nan" not in svg.lower()


def test_more_voltage_than_there_is_is_said():
    inputs = ActuatorInputs(per_rev=1, amplitude=100.0)
    installed = inputs.installed(DESIGN.rotor)
    assert "beyond −500…1\u2009500 V" in actuator_readout.over_range(inputs, installed)
    assert actuator_readout.over_range(replace(inputs, amplitude=40.0), installed) == ""
    assert actuator_readout.over_range(replace(inputs, drives=(100.0 / 3.0,)), installed) == ""  # 500 V, the middle.


@pytest.fixture(scope="module")
def verdict() -> Verdict:
    found = answer(question_of(ActuatorInputs(), DESIGN))
    assert isinstance(found, Verdict)
    return found


def test_the_verdict_is_told_whole(verdict: Verdict):
    inputs = ActuatorInputs()
    question = question_of(inputs, DESIGN)
    panel = actuator_readout.verdict_panel(verdict, None)
    assert 'data-kind="ready"' in panel
    assert verdict_sentence(verdict)[:40] in panel
    numbers = actuator_readout.fit_panel(inputs, verdict.installed, verdict)
    assert re.search(r"Required Δtwist</span><span class=\"rx-num\">\d", numbers)
    limits = actuator_readout.limits_panel(verdict)
    assert all(actuator_readout.limit_words(limit.name) in limits for limit in verdict.limits)
    assert "torsion least" not in limits
    table = actuator_table.table_panel({"MFC_P1": verdict}, question)
    assert table.count("computing…") == len(ALL) - 1
    assert "▲" in table  # Recalled data are marked.


def test_the_balance_adds_up_to_the_net_saving(verdict: Verdict):
    """Gross less stiffness, mass and drive; each bar begins where the one before it ends."""
    panel = actuator_readout.verdict_panel(verdict, None).partition('data-explorer="balance"')[2]
    kilowatts = [float(text.replace("−", "-")) for text in re.findall(r"([+−]?[\d.]+) kW</span>", panel)]
    assert len(kilowatts) == len(verdict.savings) + 1
    assert sum(kilowatts[:-1]) == pytest.approx(kilowatts[-1], abs=0.21)
    assert kilowatts[-1] == pytest.approx(1e-3 * verdict.net_saving, abs=0.051)
    assert kilowatts[0] == pytest.approx(1e-3 * verdict.gross_saving, abs=0.051)
    bars = [tuple(map(float, pair)) for pair in re.findall(r"left:([\d.]+)%;width:([\d.]+)%", panel)]
    ends = [{round(left, 0), round(left + width, 0)} for left, width in bars]
    assert all(one & two for one, two in pairwise(ends[:-1]))
    zero = float(re.findall(r'<u style="left:([\d.]+)%', panel)[0])
    assert any(abs(zero - end) < 0.6 for end in ends[-1])


def test_an_old_verdict_is_not_shown_as_the_new_one(verdict: Verdict):
    panel = actuator_readout.verdict_panel(None, verdict)
    assert 'data-kind="computing"' in panel
    assert "rx-faded" in panel
    question = question_of(ActuatorInputs(), DESIGN)
    assert actuator_table.table_panel({}, question).count("computing…") == len(ALL)


@pytest.mark.slow
def test_derating_of_ones_own_counts(verdict: Verdict):
    half = answer(replace(question_of(ActuatorInputs(), DESIGN), share=0.5))
    assert isinstance(half, Verdict)
    assert_allclose(half.ratio, 2.0 * verdict.ratio, rtol=1e-9)
    assert half.gross_saving < verdict.gross_saving


def test_what_cannot_be_built_is_a_sentence():
    question = question_of(ActuatorInputs(), DESIGN)
    assert "use one of" in str(answer(replace(question, actuator="unobtainium")))


def test_the_chart_shows_need_and_reach(verdict: Verdict):
    plot = actuator_plots.reach_plot(ActuatorInputs(drives=FULL), verdict.installed, verdict, 0.13, None)
    r, limit, counted, required, used, now = plot.data
    assert len({len(values) for values in plot.data}) == 1
    assert_allclose(abs(required[-1]), math.degrees(verdict.required), rtol=1e-6)
    assert_allclose(counted, limit)
    assert (np.abs(used) <= np.abs(limit) + 0.01).all()
    assert now[-1] > 0.0
    assert plot.y_range[0] <= min(map(np.min, plot.data[1:]))
    assert r[0] == pytest.approx(0.13)


@dataclass(frozen=True)
class Asked:
    """A task that the pool of the test keeps, or fails."""

    name: str

    def run(self, tell: Any, stop: Any) -> None:
        raise AssertionError(tell, stop)


class FakePool:
    """Keeps what is asked; the test ends it."""

    def __init__(self) -> None:
        self.jobs: list[tuple[Asked, Callable[[JobEvent], None]]] = []
        self.stopped: list[object] = []

    def submit(self, task: Asked, on_event: Callable[[JobEvent], None], **_: object) -> Asked:
        self.jobs.append((task, on_event))
        on_event(JobStarted())
        return task

    def stop(self, job: Asked, quiet: bool) -> None:
        self.stopped.append((job, quiet))

    @property
    def asked(self) -> list[str]:
        return [task.name for task, _ in self.jobs]

    def end(self, result: object) -> None:
        """Of the last one."""
        self.jobs[-1][1](JobEnded(result))


def until(true: Callable[[], bool]) -> None:
    """Fails after a minute."""
    end = time.monotonic() + 60.0
    while not true():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_the_chosen_actuator_is_judged_first_and_then_all_others():
    question = question_of(ActuatorInputs(actuator="extension_twist"), DESIGN)
    names = [task.question.actuator for task in verdict_tasks(question)]
    assert names[0] == "extension_twist"
    assert sorted(names) == sorted(ALL)


def test_the_newest_tasks_are_answered_one_at_a_time_and_serve_every_page():
    pool, heard = FakePool(), []
    fake: Any = pool
    answers = PoolAnswers(fake, 5, lambda: heard.append(True))
    first, second, newest = (Asked(f"{name} of this test") for name in ("first", "second", "newest"))
    answers.ask((first, second), 0.0)
    until(lambda: pool.asked == [first.name])
    answers.ask((newest, second), 0.0)
    time.sleep(0.1)
    assert pool.asked == [first.name]  # It runs to its end.
    pool.end("one")
    until(lambda: pool.asked == [first.name, newest.name])
    pool.jobs[-1][1](JobFailed("The process ended."))
    until(lambda: pool.asked[-1] == second.name)
    pool.end(None)
    assert (answers.answer(newest), len(heard)) == ("The process ended.", 3)
    assert "change any setting" in answers.answer(second)
    assert PoolAnswers(fake, 5, lambda: None).answer(first) == "one"
    answers.ask((Asked("never ends"),), 0.0)
    until(lambda: pool.asked[-1] == "never ends")
    answers.stop()
    assert pool.stopped == [(Asked("never ends"), True)]


def test_nothing_is_begun_while_somebody_drags():
    pool: Any = FakePool()
    answers = PoolAnswers(pool, 5, lambda: None)
    task = Asked("wait")
    for _ in range(8):  # Longer than the wait altogether, but never still.
        answers.ask((task,), 0.4)
        time.sleep(0.1)
    assert pool.asked == []
    answers.ask((task,), 0.4, moved=False)  # A round that an answer woke.
    until(lambda: pool.asked == ["wait"])


def bowl(depth: float) -> PowerMap:
    """ΔP = −2 depth·a cos φ + b a²: least at φ = 0, a = depth/b, with b = 4 kW."""
    shares, phases = np.array([0.5, 1.0]), 2.0 * np.pi * np.arange(12) / 12
    changes = -2.0 * depth * shares[:, None] * np.cos(phases) + 4000.0 * shares[:, None] ** 2
    return PowerMap(2, shares, phases, changes)


def test_the_limit_beyond_which_more_twist_costs():
    found = bowl(1000.0)
    assert_allclose(found.best(), (0.25, 0.0, -250.0), atol=1e-9)
    assert_allclose(found.change(0.3, np.pi), 600.0 + 360.0)
    turning = ActuatorInputs(per_rev=2, amplitude=40.0)
    assert sweep_sentence(found, turning, DESIGN).endswith("At this phase twist beyond 25 % costs power again.")
    assert "25 % at 0°: −0.2 kW" in sweep_sentence(found, turning, DESIGN)
    assert "every amplitude costs" in sweep_sentence(found, replace(turning, phase=180.0), DESIGN)
    assert "more twist saves more, up to 100 %" in sweep_sentence(bowl(5000.0), turning, DESIGN)
    assert sweep_sentence(bowl(0.0), turning, DESIGN).startswith("No amplitude saves power at 2/rev.")
    x, _, here, limit, now = amplitude_plot(found, turning, None).data
    assert_allclose(x[np.isfinite(limit)], 25.0, atol=0.7)
    assert_allclose(np.nanmin(here), -0.25, atol=1e-3)
    assert_allclose(x[np.isfinite(now)], 40.0, atol=0.7)
    x, full, here, now = phase_plot(found, replace(turning, phase=90.0), None).data
    assert_allclose(x[np.isfinite(now)], 90.0)
    assert_allclose((full.min(), here.min()), (2.0, -0.16), atol=1e-9)


def test_a_sweep_is_asked_for_once_for_all_amplitudes_and_phases():
    turning = ActuatorInputs(per_rev=2)
    task = sweep_task(turning, DESIGN)
    assert task == sweep_task(replace(turning, amplitude=80.0, phase=90.0, shown=True), DESIGN)
    assert task != sweep_task(replace(turning, drives=FULL), DESIGN)
    assert pickle.loads(pickle.dumps(task)) == task
    assert sweep_task(ActuatorInputs(), DESIGN) is None
    assert sweep_task(turning, make_design(mu=0.0)) is None


@pytest.mark.slow
def test_a_sweep_agrees_with_the_slider():
    """The map at an amplitude and phase, and the change of power that the page shows there."""
    turning = ActuatorInputs(per_rev=2, amplitude=70.0, phase=200.0)
    task = sweep_task(turning, DESIGN)
    assert task is not None
    found = task.run(lambda _: None, lambda: False)
    assert isinstance(found, PowerMap)
    alone = solve(replace(turning, amplitude=1e-6).apply(DESIGN)).power.total
    shown = solve(turning.apply(DESIGN)).power.total - alone
    assert_allclose(found.change(0.7, math.radians(200.0)), shown, atol=20.0)


def test_the_cut_of_an_elastic_blade_is_as_flown():
    """The part that voltage moves: zero at the root, and at the tip what the two trims differ by."""
    inputs = ActuatorInputs(drives=FULL, per_rev=2, amplitude=50.0)
    driven, rest = solve(inputs.apply(DESIGN)), solve(DESIGN)
    flown = flown_twist(driven, rest, 0.5)
    assert flown is not None
    assert flown.moved[0] == 0.0
    assert driven.disk.elastic_twist is not None
    at = int(np.abs(driven.disk.psi - 0.5).argmin())
    pitch = driven.disk.theta[:, at] - rest.disk.theta[:, at]  # Collective and cyclic move every station alike.
    assert_allclose(flown.moved, pitch - pitch[0], atol=math.radians(0.03))
    installed = inputs.installed(DESIGN.rotor)
    labels = [text for text, _ in cut_picture(inputs, installed, DESIGN, 0.5, flown).labels]
    assert any(f"tip {math.degrees(flown.moved[-1]):+.2f}°" in text.replace("−", "-") for text in labels)
    rigid = make_design(preset="thesis", mu=0.2)
    assert flown_twist(solve(rigid), solve(rigid), 0.5) is None


def test_a_lean_verdict_tells_the_same(verdict: Verdict):
    """What comes through the pipe has everything that the tab shows, at a hundredth of the size."""
    small = lean(verdict)
    assert len(pickle.dumps(small)) < 0.03 * len(pickle.dumps(verdict))
    question = question_of(ActuatorInputs(), DESIGN)
    page = [
        (
            actuator_readout.verdict_panel(one, None),
            actuator_readout.fit_panel(ActuatorInputs(), one.installed, one),
            actuator_readout.segments_panel(one.installed, 1.0, one),
            actuator_readout.limits_panel(one),
            actuator_table.table_panel({"MFC_P1": one}, question),
        )
        for one in (verdict, small)
    ]
    assert page[0] == page[1]
    for full, left in zip(*(reach(one).data for one in (verdict, small)), strict=True):
        assert_allclose(left, full)


def reach(verdict: Verdict) -> Plot:
    return actuator_plots.reach_plot(ActuatorInputs(), verdict.installed, verdict, 0.13, None)
