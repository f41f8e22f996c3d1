"""The Actuator tab without a browser: settings, shapes, pictures and words."""

import json
import math
import pickle
import re
import time
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.model.actuator_inputs import (
    MOST_SEGMENTS,
    ActuatorInputs,
    inputs_from_spec,
    lean_verdict,
    verdict_inputs_of,
    verdict_on,
    verdict_tasks,
)
from explorer.model.inputs import Inputs, ViewState, inputs_of, with_rotor
from explorer.model.stand import StandInputs
from explorer.model.units import SI, UNITS
from explorer.picture import lifted_blade as lifted
from explorer.picture.blade_mesh import blade_shape
from explorer.picture.lifted_picture import TWIST_EXAGGERATION, flown_twist, lifted_picture
from explorer.picture.picture import make_picture
from explorer.sharing.share import within
from explorer.text.readout import balance, limit_words
from explorer.views import actuator_words
from explorer.views.actuator import ACTUATOR, FormLook, pull
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.flight import BY_HAND
from explorer.views.page_state import SetHand
from explorer.workers import background
from explorer.workers.background import PoolAnswers
from explorer.workers.call import Call
from rotor.actuator import verdict_details, with_actuator
from rotor.actuator.catalogue import actuators, find_actuator
from rotor.actuator.verdict import Verdict
from rotor.command.actuator import report
from rotor.design.active_twist import linear_active_twist, read_harmonics
from rotor.files.design_file import design_from_record
from rotor.files.make_design import make_design
from rotor.support.processes import JobEnded, JobEvent, JobFailed, JobStarted
from rotor.trim.solve import solve
from tests.actuate import actuate, told
from tests.waited import until

DESIGN = make_design(preset="flight", mu=0.2)
FULL = (100.0,) * MOST_SEGMENTS
ALL = tuple(actuators())


def test_full_voltage_makes_the_twist_that_the_range_gives():
    """+1500 V of a 2000 V range: three quarters of what the blade at rest gains, on its own blade.

    The design is the one that `rotor` makes, with its mass also at rest; a blade that carries none is as it was.
    """
    assert ActuatorInputs().apply(DESIGN) == with_actuator(DESIGN, "MFC_P1")
    assert ActuatorInputs(drives=FULL).apply(DESIGN) == with_actuator(DESIGN, "MFC_P1,drive=100")
    other = make_design(rotor="s61")
    assert ActuatorInputs(drives=FULL).apply(other) is other
    inputs = ActuatorInputs(drives=FULL)
    applied, installed = inputs.apply(DESIGN), inputs.installed(DESIGN.rotor)
    made = applied.twist
    gained = float(made(1.0) - made(0.0)) - float(DESIGN.twist(1.0) - DESIGN.twist(0.0))
    # The table begins at 0.05 R, a hair outboard of the pitch bearing, and holds its end.
    assert_allclose(gained, 0.75 * np.abs(installed.rest_shapes[:, -1]).sum(), rtol=5e-3)
    assert applied.rotor.blade.structure == installed.blade
    assert 1.0 < gained / (0.75 * installed.attainable) < 1.15  # Rotation takes some of it.


SOFT = ActuatorInputs(
    concept="three-segment",
    drives=(10.0, 20.0, 30.0, 0.0, 0.0),
    blade="new",
    stiffness=0.7,
    crossed=True,
)


@pytest.mark.parametrize("inputs", [Inputs(law="builtin", built_inner=2.0), Inputs(law="two")])
@pytest.mark.parametrize(
    "actuator", [ActuatorInputs(drives=(77.0,) * 5), SOFT, ActuatorInputs("SMA_tube", 3)]
)
def test_a_design_file_and_a_link_give_back_sliders_and_actuator(
    inputs: Inputs, actuator: ActuatorInputs
):
    design = actuator.apply(inputs.design())
    read = design_from_record(json.loads(json.dumps(design.to_dict())))
    assert within(inputs_of(read)) == inputs
    assert read.rotor.blade.carried is not None
    assert inputs_from_spec(read.rotor.blade.carried.spec) == actuator
    with pytest.raises(ValueError, match="divisions that no concept"):
        inputs_from_spec("MFC_P1,divisions=0.33")


def test_laid_the_other_way_it_turns_the_other_way():
    installed = ActuatorInputs().installed(DESIGN.rotor)
    there = ActuatorInputs(drives=FULL).change(installed, 1.0)
    assert_allclose(ActuatorInputs(drives=FULL, crossed=True).change(installed, 1.0), -there)
    tube = ActuatorInputs(actuator="SMA_tube", drives=FULL)
    installed = tube.installed(DESIGN.rotor)  # Laid the other way, and driven from zero only.
    assert_allclose(
        replace(tube, crossed=True).change(installed, 1.0), -tube.change(installed, 1.0)
    )
    assert replace(tube, crossed=True).reach(installed) == (-tube.reach(installed)[1], 0.0)
    assert (tube.least_drive, ActuatorInputs().least_drive) == (0.0, -100.0)


@pytest.mark.parametrize("id", ALL)
def test_drive_and_swing_are_inverse(id: str):
    actuator = find_actuator(id)
    for share in (-1.0, -0.37, 0.0, 0.41, 1.0):
        if share >= 0.0 or actuator.drive_range[0]:
            assert_allclose(actuator.share_of(actuator.swing_at(share)), share, atol=1e-9)


def test_each_blade_is_drawn_with_the_twist_of_its_azimuth():
    rigid = replace(DESIGN, models=replace(DESIGN.models, elastic_twist=False))
    wave = linear_active_twist(read_harmonics("1:2:0", "test"), rigid.rotor.blade.root_cutout)
    still, turning = (solve(replace(rigid, active_twist=twist)) for twist in (None, wave))
    same, forms = (
        make_picture(solution, ViewState()).blades.forms for solution in (still, turning)
    )
    assert [len(same), len(forms)] == [1, DESIGN.rotor.blades]
    shapes = [form.vertices(blade_shape(DESIGN.rotor)) for form in forms]
    middle = 0.5 * (shapes[0] + shapes[2])  # Opposite blades at 1/rev move against each other.
    assert_allclose(middle, same[0].vertices(blade_shape(DESIGN.rotor)), atol=1e-3)
    assert np.abs(shapes[0] - shapes[2]).max() > 1e-3


def test_the_question_hangs_on_the_baseline_and_not_on_flight_voltage_or_view():
    inputs = ActuatorInputs()
    climbing = make_design(preset="flight", mu=0.3)
    climbing = replace(climbing, condition=replace(climbing.condition, climb_speed=5.0))
    moved = replace(inputs, drives=FULL, crossed=True)
    assert verdict_inputs_of(inputs, DESIGN) == verdict_inputs_of(moved, climbing)
    others = {
        verdict_inputs_of(replace(inputs, **{key: one}), DESIGN)
        for key, one in (("plies", 3), ("against", "best-fixed"))
    }
    assert verdict_inputs_of(inputs, DESIGN) not in others


@pytest.mark.parametrize("blade", ["retrofit", "new"])
@pytest.mark.parametrize("id", ALL)
def test_the_lifted_blade_is_whole_finite_and_small(id: str, blade):
    """Small enough to be sent at every step of the flight bar."""
    inputs = ActuatorInputs(actuator=id, blade=blade, concept="three-segment", drives=FULL)
    installed = inputs.installed(DESIGN.rotor)
    picture = lifted_picture(inputs, installed, DESIGN)
    for solid in picture.solids.values():
        assert np.isfinite(solid.mesh.vertices).all()
        assert solid.mesh.faces.max() < len(solid.mesh.vertices)
        assert np.abs(solid.mesh.vertices[:, 1]).max() < 0.5 * lifted.CHORD_EXAGGERATION
    assert sum(len(solid.mesh.vertices) for solid in picture.solids.values()) < 9_000
    assert all(np.isfinite(lines).all() for lines in picture.lines.values())
    assert {"skin", "web", "shank", "drive_0"} <= set(picture.solids)


def test_plies_stand_outside_the_true_contour_where_they_are_placed():
    inputs = ActuatorInputs(span=(0.3, 0.8))
    blade = lifted.lifted_blade(inputs.installed(DESIGN.rotor), DESIGN.rotor)
    plies = [part for part in blade.parts if part.segment >= 0]
    assert len(plies) == 2
    for part in plies:
        assert_allclose((part.r[0], part.r[-1]), (0.3, 0.8))
        upper = part.inner[:, 5, 1] > 0.0
        away = part.outer[:, 5, 1] - part.inner[:, 5, 1]
        assert (np.where(upper, away, -away) > 0.0).all()
    skin = next(part for part in blade.parts if part.role == "skin")
    chord = float(DESIGN.rotor.blade.chord(0.5))
    assert_allclose(
        skin.outer[0, [0, skin.outer.shape[1] // 2], 0], (-0.75 * chord, 0.25 * chord), rtol=1e-6
    )


def test_voltage_turns_the_tip_of_the_lifted_blade_nose_up():
    """By the magnified twist: the trailing edge of the tip goes down, the leading edge up."""
    inputs = ActuatorInputs(drives=FULL)
    installed = inputs.installed(DESIGN.rotor)
    rest, driven = (lifted_picture(each, installed, DESIGN) for each in (ActuatorInputs(), inputs))
    angles = []
    for picture in (rest, driven):
        # The tip section, from its trailing edge over the nose.
        ring = picture.lines["edges"][-38:, 0]
        nose, tail = ring[19], ring[0]
        angles.append(math.atan2(nose[2] - tail[2], nose[1] - tail[1]))
    assert_allclose(
        angles[1] - angles[0],
        TWIST_EXAGGERATION * float(inputs.change(installed, 1.0)),
        atol=math.radians(0.3),
    )
    assert len(rest.lines["overlay"]) == len(rest.lines["arrow"]) == 0
    assert len(driven.lines["overlay"]) > 0
    assert len(driven.lines["arrow"]) > 0


@pytest.fixture(scope="module")
def verdict() -> Verdict:
    return verdict_on(verdict_inputs_of(ActuatorInputs(), DESIGN))


def test_the_verdict_is_told_whole(verdict: Verdict):
    numbers = actuator_words.fit_panel(verdict.installed, verdict)
    assert re.search(r"twist required \d", numbers)
    limits = actuator_words.limits_panel(verdict)
    assert all(limit_words(limit.name) in limits for limit in verdict.limits)
    assert "torsion least" not in limits
    assert "▲" in limits  # Recalled data are marked.


def test_the_parts_of_a_verdict_have_the_unit_of_the_view(verdict: Verdict):
    """Also the small power of the drive."""
    for units in UNITS.values():
        unit = units.power[0]
        text = actuator_words.fit_panel(verdict.installed, verdict, units)
        text += verdict_details(verdict, (unit.symbol, unit.size))
        assert set(re.findall(r"(?<=\d )(?:kW|W|hp)\b", text)) == {unit.symbol}
    # The command prints kilowatts alone, also for the drive.
    assert set(re.findall(r"(?<=\d )(?:kW|W|hp)\b", report(verdict))) == {"kW"}


def asked(name: str) -> Call:
    """A task that the pool of the test keeps, or fails."""
    return Call(str, (f"{name} of this test",))


class FakePool:
    """Keeps what is asked; the test ends it."""

    def __init__(self) -> None:
        self.jobs: list[tuple[Call, Callable[[JobEvent], None]]] = []
        self.stopped: list[object] = []

    def begin(self, task: Call, on_event: Callable[[JobEvent], None], **_: object) -> Call:
        self.jobs.append((task, on_event))
        on_event(JobStarted())
        return task

    def stop(self, job: Call, quiet: bool) -> None:
        self.stopped.append((job, quiet))

    @property
    def asked(self) -> list[Call]:
        return [task for task, _ in self.jobs]

    def end(self, result: object) -> None:
        """End the last job."""
        self.jobs[-1][1](JobEnded(result))


def test_the_chosen_actuator_is_judged_first_and_then_all_others():
    question = verdict_inputs_of(ActuatorInputs(actuator="extension_twist"), DESIGN)
    tasks = verdict_tasks(question)
    assert next(iter(tasks)) == "extension_twist"
    assert sorted(tasks) == sorted(ALL)
    unknown = replace(question, actuator="unobtainium")
    # What cannot be judged is a sentence.
    assert "use one of" in verdict_tasks(unknown)["unobtainium"].run()


def test_the_newest_tasks_are_answered_one_at_a_time_and_serve_every_page():
    pool, heard = FakePool(), []
    fake: Any = pool
    answers = PoolAnswers(fake, 5, lambda: heard.append(answers.is_waiting()))
    assert not answers.is_waiting()
    first, second, newest = map(asked, ("first", "second", "newest"))
    answers.ask((first, second), 0.0)
    assert answers.is_waiting()
    until(lambda: pool.asked == [first])
    answers.ask((newest, second), 0.0)
    time.sleep(0.1)
    assert pool.asked == [first]  # It runs to its end.
    pool.end("one")
    until(lambda: pool.asked == [first, newest])
    pool.jobs[-1][1](JobFailed("The process ended."))
    until(lambda: pool.asked[-1] == second)
    pool.end("two")
    assert (answers.answer(newest), answers.answer(second)) == ("The process ended.", "two")
    # Until an answer is told, it is owed.
    assert (heard, answers.is_waiting()) == (
        [True] * 3,
        False,
    )
    assert PoolAnswers(fake, 5, lambda: None).answer(first) == "one"
    answers.ask((asked("never ends"),), 0.0)
    until(lambda: pool.asked[-1] == asked("never ends"))
    assert answers.is_waiting()
    answers.stop()
    assert (pool.stopped, answers.is_waiting()) == ([(asked("never ends"), True)], False)


def test_a_task_ended_after_its_time_is_begun_again_by_itself():
    """A busy machine took a minute for a flight: "This was stopped: change any setting" stood there for ever."""
    pool: Any = FakePool()
    answers = PoolAnswers(pool, 5, lambda: None)
    late, other = asked("late"), asked("other")
    answers.ask((late, other), 0.0)
    until(lambda: pool.asked == [late])
    pool.jobs[-1][1](JobEnded(None, stopped=True, late=True))
    assert pool.asked == [late, other]
    assert "after 10 minutes" in answers.answer(late)
    pool.end("quick")
    assert pool.asked == [late, other, late]
    pool.end("found")
    assert (answers.answer(late), pool.asked[3:]) == ("found", [])


def waiting(urgency: int) -> tuple[FakePool, PoolAnswers]:
    pool: Any = FakePool()
    return pool, PoolAnswers(pool, urgency, lambda: None)


def test_nothing_is_begun_while_somebody_drags():
    (pool, answers), task = waiting(5), asked("wait")
    for _ in range(8):  # Longer than the wait altogether, but never still.
        answers.ask((task,), 0.4)
        time.sleep(0.1)
    assert pool.asked == []
    until(lambda: pool.asked == [task])


def test_at_rest_a_task_runs_to_its_end_and_the_next_waits():
    (pool, answers), first, second = waiting(5), asked("under way"), asked("waits")
    answers.ask((first, second), 0.0)
    until(lambda: pool.asked == [first])
    answers.rest(True)
    pool.end("one")
    assert (answers.answer(first), pool.asked, answers.is_waiting()) == ("one", [first], False)
    answers.rest(False)
    assert pool.asked == [first, second]


def test_what_is_least_urgent_waits_while_any_page_draws(monkeypatch: pytest.MonkeyPatch):
    (soon, urgent), (late, answers), task = waiting(6), waiting(7), asked("bands of a curve")
    server = SimpleNamespace(busy=True)
    monkeypatch.setattr(background, "UPDATES", server)
    for one in (urgent, answers):
        one.ask((task,), 0.0)
    until(lambda: soon.asked == [task])
    time.sleep(0.2)
    assert late.asked == []
    server.busy = False
    until(lambda: late.asked == [task])


def test_the_lifted_blade_is_drawn_as_flown():
    """The part that voltage moves: zero at the root, and at the tip what the two trims differ by."""
    inputs = ActuatorInputs(drives=FULL)
    driven, rest = solve(inputs.apply(DESIGN)), solve(DESIGN)
    flown = flown_twist(driven, rest, 0.5)
    assert flown.moved[0] == 0.0
    assert driven.disk.elastic_twist is not None
    at = int(np.abs(driven.disk.psi - 0.5).argmin())
    # Collective and cyclic move every station alike.
    pitch = driven.disk.theta[:, at] - rest.disk.theta[:, at]
    assert_allclose(flown.moved, pitch - pitch[0], atol=math.radians(0.03))
    installed = inputs.installed(DESIGN.rotor)
    labels = [
        text
        for kind, text, _ in lifted_picture(inputs, installed, DESIGN, flown).labels
        if kind == "tip"
    ]
    assert labels == [
        f"{math.degrees(inputs.tip(installed)):+.2f}° at the tip, drawn × {TWIST_EXAGGERATION:g}"
    ]
    rigid = make_design(preset="thesis", mu=0.2)
    assert flown_twist(solve(rigid), solve(rigid), 0.5) is None


def test_a_lean_verdict_tells_the_same(verdict: Verdict):
    """What comes through the pipe has everything that the tab shows, at a twentieth of the size."""
    small = lean_verdict(verdict_inputs_of(ActuatorInputs(), DESIGN))
    assert len(pickle.dumps(small)) < min(40_000, 0.06 * len(pickle.dumps(verdict)))
    page = [
        (
            actuator_words.fit_panel(one.installed, one),
            actuator_words.limits_panel(one),
            balance(one.savings, SI),
        )
        for one in (verdict, small)
    ]
    assert page[0] == page[1]


INPUTS = Inputs(advance_ratio=0.2)


def test_the_rail_follows_design_voltage_and_verdict(verdict: Verdict):
    """One installed actuator, one verdict; what is not known yet is said to be on its way."""
    now = actuate(INPUTS)
    rest = ACTUATOR.view(now)
    assert rest == ACTUATOR.view(replace(now))
    assert "at rest" in rest["actuator.now"]
    assert rest["actuator.verdict"] == rest["actuator.limits"] == ""
    assert [(one.urgency, one.delay, len(one.calls)) for one in ACTUATOR.asks(now)] == [
        (3, 0.4, 1), (4, 0.0, 0), (7, 2.5, 0)
    ]  # fmt: skip
    flown = told(ACTUATOR, told(ACTUATOR, now, lean_verdict=verdict), flight_of="no flight")
    assert [len(one.calls) for one in ACTUATOR.asks(flown)] == [1, 1, 0]
    paying = replace(flown, hand=replace(flown.hand, on_stage=True))
    weak = {"PZT5A", "PZT5H", "SMA_tube", "extension_twist"}
    asked = [cast("Any", call.arguments[0]) for call in ACTUATOR.asks(paying)[2].calls]
    beside = {question.actuator for question in asked}
    assert beside == set(ALL) - weak - {"MFC_P1"}
    refused = ACTUATOR.view(told(ACTUATOR, now, lean_verdict="No such blade."))
    assert "No such blade." in refused["actuator.verdict"]


def test_where_there_is_no_such_design_the_sentence_stands_alone():
    """All else is as it was; a rotor that carries no actuator has no widgets of one either."""
    now = replace(actuate(INPUTS), problem="No trim at this speed.")
    assert sorted(ACTUATOR.view(now)) == ["actuator.form", "actuator.verdict"]
    assert ACTUATOR.view(now)["actuator.form"].carried
    assert "No trim at this speed." in ACTUATOR.view(now)["actuator.verdict"]
    free = replace(INPUTS, stand=StandInputs("free-rotor"))
    turned = replace(actuate(INPUTS), inputs=free, sliders=free.design(), state=None)
    other_rotor = actuate(with_rotor(INPUTS, "s61"))
    for other, why in ((other_rotor, "choose that rotor."), (turned, "another trim.")):
        shown = dict(ACTUATOR.view(other))
        assert why in shown.pop("actuator.verdict")
        form: FormLook = shown.pop("actuator.form")
        assert not form.carried
        assert not any(form.seen.values())
        assert set(shown.values()) == {""}
        assert ACTUATOR.asks(other) == ()
        assert ACTUATOR_CARD.view(other) == {"assessed": None}


def test_kinds_that_cannot_move_the_blade_lie_behind_a_fold_and_a_chosen_one_stays():
    now = actuate(INPUTS)
    shown = ACTUATOR.view(now)
    kinds = shown["actuator.form"].kinds
    assert set(ALL) - set(kinds) == {"PZT5A", "PZT5H", "SMA_tube", "extension_twist"}
    assert "<summary>4 kinds cannot move this blade</summary>" in shown["actuator.weak"]
    folded = re.findall(r'data-value="(\w+)"[^>]*>[^<]*</button>: ([^<]*)', shown["actuator.weak"])
    assert dict(folded) == {
        "PZT5A": "far too weak",
        "PZT5H": "far too weak",
        "SMA_tube": "no space in the blade",
        "extension_twist": "forbidden by constant rotor speed",
    }
    chosen = ACTUATOR.view(actuate(INPUTS, actuator=ActuatorInputs("PZT5A")))
    assert "PZT5A" in chosen["actuator.form"].kinds
    assert "3 kinds cannot" in chosen["actuator.weak"]
    assert "PZT5A" not in chosen["actuator.weak"]


@pytest.mark.parametrize(
    ("actuator", "label", "hidden"),
    [
        (ActuatorInputs(concept="three-segment", blade="new"), "Voltage 2 [%]", {"drive 3"}),
        (ActuatorInputs(actuator="SMA_tube"), "Drive [%]", {"chord", "stiffness"}),
        (
            ActuatorInputs(actuator="extension_twist"),
            "Drive [%]",
            {"plies", "span", "chord", "stiffness"},
        ),
    ],
)
def test_the_form_has_what_the_actuator_has(actuator: ActuatorInputs, label: str, hidden: set[str]):
    form: FormLook = ACTUATOR.view(actuate(INPUTS, actuator=actuator))["actuator.form"]
    assert label in form.labels.values()
    assert hidden <= {name for name, seen in form.seen.items() if not seen}
    assert form.seen["stiffness"] == (actuator.blade == "new")


def test_the_lifted_blade_is_pulled_from_where_it_was_taken():
    """Trailing edge up is nose down: less voltage, but not beyond the range."""
    now = actuate(INPUTS, actuator=ActuatorInputs(drives=(20.0,) * MOST_SEGMENTS), flown=1.5)
    assert pull(now, 0.5) == ()
    (taken,) = pull(now, None)
    assert isinstance(taken, SetHand)
    held = replace(now, hand=replace(now.hand, **taken.changes))
    for share, drive in ((0.5, -30.0), (4.0, -100.0)):
        assert pull(held, share) == (SetHand(BY_HAND, {"drives": (drive,) * MOST_SEGMENTS}),)
    assert pull(actuate(with_rotor(INPUTS, "s61")), None) == ()
