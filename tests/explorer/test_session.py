"""The path of a slider step: what the session calls on its page, and in which order."""

import threading
import time
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from explorer import session as session_module
from explorer.charts import plots
from explorer.hosting.messages import PageFacts
from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import Analyses
from explorer.page import Urgency
from explorer.session import Session
from explorer.views.page_state import PageState
from explorer.workers.newest_wins import NewestWins, UpdatePool
from rotor import Design, Solution, solve
from tests.fake_bridge import Bridge


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
        return replace(self.latest, inputs=self.inputs, view=self.view, sliders=None, preview=None, problem="")

    def counted_from(self, now: PageState) -> None:
        """It is never in Actuate."""

    def pin_or_swap(self, *_: Any) -> bool:
        self.calls.append("pin_or_swap")
        return self.moves_sliders

    def draw(self, now: PageState, solution: Solution, pinned: Solution | None, only_azimuth: bool) -> None:
        self.calls.append("draw")
        self.frames.append(SimpleNamespace(now=now, solution=solution, only_azimuth=only_azimuth))

    def show(self, now: PageState, urgency: Urgency, stop: Any = None) -> None:
        self.latest = now
        self.calls.append(urgency)
        self.states.append(now)

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
    made = Session(client, Inputs(), PageFacts(), shared=SimpleNamespace())  # pyright: ignore[reportArgumentType]
    made._worker = NewestWins(made._update, made._failed, UpdatePool(0))
    return made


def update(session: Session) -> Any:
    """One update with all its steps, in which nothing supersedes it; the page with the calls of this update only."""
    page: Any = session.page
    page.calls.clear()
    session._all_changed = True
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

        def show(self, now: PageState, urgency: Urgency, stop: Any = None) -> None:
            super().show(now, urgency)
            if urgency == "tabs":
                shown.set()

    monkeypatch.setattr(session_module, "Page", WakingPage)
    monkeypatch.setattr(Session, "_failed", lambda _, error: failures.append(error))
    client: Any = SimpleNamespace(client_id=1)
    made = Session(client, Inputs(), PageFacts(), shared=SimpleNamespace())  # pyright: ignore[reportArgumentType]
    made.start()
    assert shown.wait(300.0)  # The kernels may have to be compiled.
    made._worker.stop()
    assert not failures


def test_only_reading_and_pinning_come_before_the_frame(session: Session):
    page = update(session)
    assert page.calls[:3] == ["read", "pin_or_swap", "draw"]
    assert page.calls[3:7] == ["solve A", "address", "results", "tabs"]
    assert page.calls[-1] == "deferred"
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
    page.inputs = replace(Inputs(), advance_ratio=0.45, mass_t=11.0, altitude_m=4000.0, inflow="drees")
    update(session)
    refused = solve(page.inputs.design())
    assert not refused.converged
    assert page.latest.problem == refused.message
    assert page.latest.state is None
    assert "draw" not in page.calls


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
    monkeypatch.setattr(session._curves, "sweep", lambda *_: page.calls.append("sweep") or True)
    update(session)
    assert page.calls[-6:] == ["rest", "kept", "sweep", "rest", "kept", "deferred"]


def test_in_a_crowd_number_and_address_come_with_the_frame(session: Session, monkeypatch: pytest.MonkeyPatch):
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
