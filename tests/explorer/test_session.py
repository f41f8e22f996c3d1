"""The path of a slider step: what the session calls on its page, and in which order."""

import math
import threading
import time
from collections.abc import Generator, Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from explorer import session as session_module
from explorer.charts import plots
from explorer.hosting.messages import PageFacts
from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import Analyses
from explorer.model.sliders import SLIDERS
from explorer.page import Urgency
from explorer.session import Session
from explorer.text.readout import TRIM_ROWS
from explorer.views.page_state import PageState
from explorer.workers.newest_wins import NewestWins, UpdatePool
from explorer.workers.solver import BaselineCache
from rotor import Design, Solution, make_design, solve
from rotor.trim import DEFAULT_OPTIONS, SolverOptions, analyse
from rotor.trim.newton import FEW_DIGITS
from rotor.trim.solution import Status
from tests.fake_bridge import Bridge
from tests.solved import assert_same_trim


class RecordingPage:
    """A page without widgets: the test sets what it reads, and what the session has it show is listed."""

    def __init__(self, *_: Any) -> None:
        self.inputs, self.view = Inputs(), ViewState()
        self.latest = PageState(self.inputs, None, None)
        self.calls: list[str] = []
        """In order; a call of `show` by its urgency."""
        self.frames: list[SimpleNamespace] = []
        """What each frame showed."""
        self.states: list[PageState] = []
        """What was shown beside a frame, or in its place."""
        self.found: Design | None = None
        self.moves_sliders = False
        pinboard = SimpleNamespace(pinned=None, solve=lambda *_: self.calls.append("solve A"))
        self.context = SimpleNamespace(analyses=Analyses(), pinboard=pinboard, bridge=Bridge())
        self.optimise = SimpleNamespace(preview=lambda design: self.found)

    def read(self) -> PageState:
        self.calls.append("read")
        return replace(
            self.latest, inputs=self.inputs, view=self.view, sliders=None, preview=None, problem=""
        )

    def counted_from(self, now: PageState) -> None:
        """It is never in Actuate."""

    def pin_or_swap(self, *_: Any) -> bool:
        self.calls.append("pin_or_swap")
        return self.moves_sliders

    def draw(
        self, now: PageState, solution: Solution, pinned: Solution | None, only_azimuth: bool
    ) -> None:
        self.calls.append("draw")
        self.frames.append(SimpleNamespace(now=now, solution=solution, only_azimuth=only_azimuth))

    def show(self, now: PageState, urgency: Urgency) -> None:
        self.latest = now
        self.calls.append(urgency)
        self.states.append(now)

    def work(self) -> Iterator[None]:
        self.calls.append("work")
        yield

    def work_later(self) -> Iterator[None]:
        self.calls.append("work later")
        yield

    def show_failure(self, now: PageState, good: Solution | None) -> None:
        self.latest, self.good = now, good
        self.calls.append("show_failure")
        self.states.append(now)

    def show_error(self, sentence: str) -> None:
        self.latest = replace(self.latest, problem=sentence)


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Session:
    """Its worker does not run: a test calls `_update` itself. Its power curves have four points."""
    monkeypatch.setattr(session_module, "Page", RecordingPage)
    monkeypatch.setattr(plots, "SWEEP", plots.SWEEP[::6])
    monkeypatch.setattr(plots, "_FEW", (0, 1, 2, 3))
    monkeypatch.setattr(plots, "_FEWEST", (0, 1, 2, 3))
    client: Any = SimpleNamespace(client_id=1)
    made = Session(client, Inputs(), PageFacts(), pool=SimpleNamespace())  # pyright: ignore[reportArgumentType]
    made._worker = NewestWins(made._update, made._failed, UpdatePool(0))
    return made


def update(session: Session) -> Any:
    """One update after a rest, with all its steps, in which nothing supersedes it; the page with its calls only."""
    page: Any = session.page
    page.calls.clear()
    session._all_changed, session._framed = True, -math.inf
    steps = session._update()
    assert steps is not None
    for _ in steps:
        pass
    return page


def test_a_wake_before_the_page_is_whole_waits_for_the_start(monkeypatch: pytest.MonkeyPatch):
    """As a link with A does. Before, the update ran in a session without a page."""
    failures, shown = list[Exception](), threading.Event()

    class WakingPage(RecordingPage):
        def __init__(self, *arguments: Any) -> None:
            arguments[-1].wake()
            time.sleep(0.05)
            super().__init__(*arguments)

        def start(self) -> None: ...

        def show(self, now: PageState, urgency: Urgency) -> None:
            super().show(now, urgency)
            if urgency == "tabs":
                shown.set()

    monkeypatch.setattr(session_module, "Page", WakingPage)
    monkeypatch.setattr(Session, "_failed", lambda _, error: failures.append(error))
    client: Any = SimpleNamespace(client_id=1)
    made = Session(client, Inputs(), PageFacts(), pool=SimpleNamespace())  # pyright: ignore[reportArgumentType]
    made.start()
    assert shown.wait(300.0)  # The kernels may have to be compiled.
    made._worker.stop()
    assert not failures


def test_only_reading_and_pinning_come_before_the_frame(session: Session):
    page = update(session)
    assert page.calls[:3] == ["read", "pin_or_swap", "draw"]
    assert page.calls[3:7] == ["solve A", "address", "results", "tabs"]
    assert page.calls[-1] == "work later"
    assert page.frames[-1].solution is page.states[-1].state.solution


def test_inputs_without_a_design_keep_the_last_picture(session: Session):
    good = update(session).frames[-1].solution
    page: Any = session.page
    page.inputs = replace(Inputs(), law="three", three_inner_break=0.7, three_outer_break=0.6)
    update(session)
    assert page.calls == ["read", "pin_or_swap", "show_failure"]
    assert page.good is good
    assert page.latest.state.solution is good
    assert page.latest.sliders is None
    assert "out of order" in page.latest.problem


def test_trim_that_does_not_converge_shows_its_own_sentence(session: Session):
    page: Any = session.page
    page.inputs = replace(
        Inputs(), advance_ratio=0.45, mass_t=11.0, altitude_m=4000.0, inflow="drees"
    )
    update(session)
    refused = solve(page.inputs.design())
    assert not refused.converged
    assert page.latest.problem == refused.message
    assert page.latest.state is None
    assert "draw" not in page.calls


def moved_quickly(session: Session, **values: Any) -> Solution:
    """A step of a drag, and what its frame shows; the steps that follow are done too."""
    page: Any = session.page
    page.inputs, session._all_changed = replace(page.inputs, **values), True
    session._worker.woken = session._framed = time.monotonic()
    steps = session._update()
    assert steps is not None
    for _ in steps:
        pass
    return session._latest or pytest.fail("no solution")


def test_a_moving_slider_is_solved_to_the_digits_shown_and_at_rest_to_the_end(session: Session):
    """The frame of the rest is one more update, which nobody asked for."""
    page = update(session)
    page.calls.clear()
    moving = moved_quickly(session, mass_t=8.5)
    assert page.calls[-1] == "tabs"
    whole = solve(moving.design)
    assert moving.residual > 1e-10 >= whole.residual
    assert session._all_changed  # It has woken itself.
    steps = session._update()
    assert steps is not None
    at_rest = page.frames[-1].solution
    assert at_rest.design == moving.design
    assert at_rest.residual <= 1e-10
    assert_same_trim(at_rest, whole)
    assert "work" in [page.calls[-1] for _ in steps]
    assert page.frames[-1].solution is page.latest.state.solution
    assert not session._all_changed


def test_a_moving_slider_refuses_only_what_is_solved_to_the_end(
    session: Session, monkeypatch: pytest.MonkeyPatch
):
    page, tried = update(session), list[float]()

    def hardly(
        self: Analyses, design: Design, start: Solution | None, options: SolverOptions
    ) -> Solution:
        tried.append(options.residual_tolerance)
        answer = analyse(design, start, options).solution
        return replace(answer, status=Status.NOT_CONVERGED) if len(tried) == 1 else answer

    monkeypatch.setattr(Analyses, "solve", hardly)
    assert moved_quickly(session, mass_t=8.6).converged
    assert tried == [FEW_DIGITS.residual_tolerance, DEFAULT_OPTIONS.residual_tolerance]
    assert "show_failure" not in page.calls


def test_a_change_soon_after_a_frame_is_of_a_drag_however_long_it_waited(session: Session):
    """On a busy server frames take longer than a hand rests between two changes."""
    page = update(session)
    session._framed, session._worker.woken = -1000.0, -1000.1 + session_module._DRAGGED
    page.inputs, session._all_changed = replace(page.inputs, mass_t=8.7), True
    assert session._update() is not None
    assert page.frames[-1].solution.residual > 1e-10


def test_a_baseline_moves_with_its_slider_and_is_solved_to_the_end_at_rest():
    known, design = BaselineCache(), make_design(mu=0.21)
    known.solve(make_design(mu=0.2))
    moving = known.solve(design, moving=True)
    assert moving.residual > 1e-10
    assert known.solve(design, moving=True) is moving
    at_rest = known.solve(design)
    assert at_rest.residual <= 1e-10
    assert known.solve(design, moving=True) is at_rest


def test_no_digit_changes_when_a_slider_comes_to_rest():
    """Every slider in a drag: what a moving trim misses is less than a hundredth of the last digit shown."""
    begun, tried = Inputs(), 0
    start = solve(begun.design())
    for name, slider in SLIDERS.items():
        if not isinstance(value := getattr(begun, name, None), float):
            continue
        for law in ("two", "three") if "_" in name else ("linear",):
            moving = start
            for part in (0.2, 0.3, 0.5):
                changed = replace(begun, law=law, **{name: value + part * slider.natural})
                moving = analyse(changed.design(), moving, FEW_DIGITS).solution.require()
                rest = solve(changed.design(), moving)
                assert moving.power.total == pytest.approx(rest.power.total, rel=1e-6)
                for key, (_, _, digits, _, read) in TRIM_ROWS.items():
                    one, other = read(moving), read(rest)
                    assert (one is None) == (other is None), (name, key)
                    if one is not None and other is not None:
                        assert abs(one - other) < 0.01 * 10.0**-digits, (name, key)
            tried += 1
    assert tried > 12


def test_azimuth_alone_updates_little(session: Session):
    page = update(session)
    page.calls.clear()
    page.view = replace(page.view, azimuth_deg=75.0)
    session._all_changed = False
    assert session._update() is None
    assert page.calls == ["read", "pin_or_swap", "draw", "solve A", "azimuth"]
    assert page.frames[-1].only_azimuth


def test_search_is_shown_in_place_of_the_sliders(session: Session):
    page: Any = session.page
    page.found = replace(Inputs(), two_inner=-9.0).design()
    update(session)
    now = page.frames[-1].now
    assert now.preview == page.frames[-1].solution.design == page.found
    assert now.sliders == Inputs().design()


def test_the_page_is_kept_before_the_power_curve(session: Session, monkeypatch: pytest.MonkeyPatch):
    """A page that is loaded again early must find its own rotor."""
    page: Any = session.page

    def sweep(*_: object) -> Generator[None, None, bool]:
        page.calls.append("sweep")
        yield
        return True

    monkeypatch.setattr(session._curves, "sweep", sweep)
    update(session)
    assert page.calls[-8:] == [
        "rest",
        "work",
        "kept",
        "sweep",
        "rest",
        "kept",
        "work",
        "work later",
    ]


def test_in_a_crowd_number_and_address_come_with_the_frame(
    session: Session, monkeypatch: pytest.MonkeyPatch
):
    """What follows a frame waits 1.7 s with six pages; one that is loaded anew meanwhile would lose its edit."""
    monkeypatch.setattr(session_module, "UPDATES", SimpleNamespace(waiting=3, busy=True))
    page: Any = session.page
    session._update()
    assert page.calls == ["read", "pin_or_swap", "draw", "solve A", "address", "number"]


def test_steps_show_the_blade_where_it_was_turned_to_since(session: Session):
    page: Any = session.page
    steps = session._update()
    assert steps is not None
    page.view = replace(page.view, azimuth_deg=75.0)
    assert session._update() is None
    next(steps)
    assert page.calls[-1] == "results"
    assert page.states[-1].state.view.azimuth_deg == 75.0


def test_nothing_of_an_update_that_failed_is_used_by_the_next(session: Session):
    update(session)
    session._failed(ZeroDivisionError("made to fail"))
    assert (session._good, session._latest) == (None, None)
    assert update(session).states[-1].state.solution.converged
