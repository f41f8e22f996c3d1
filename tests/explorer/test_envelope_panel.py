"""The panel of the flight envelope: its task, its chart and its words, without a browser."""

import html
from types import SimpleNamespace
from typing import Any

import pytest
import viser

from explorer.model.units import number
from explorer.tabs import envelope_panel
from explorer.tabs.envelope_panel import EnvelopePanel, EnvelopeTask, envelope_chart
from rotor import make_design, solve
from rotor.processes import Job, JobEnded, JobProgress
from rotor.study.envelope import Envelope, EnvelopePoint, Reach
from tests.curves import curves

DESIGN = make_design(inflow="drees", elements=12, azimuths=24, mu=0.2, load_factor=1.1)
AT_REST = DESIGN.at(load_factor=1.0)
POINTS = tuple(
    EnvelopePoint(AT_REST.at(mu=mu), Reach(stall, engines))
    for mu, stall, engines in ((0.1, 2.0, 1.6), (0.2, 1.8, None), (0.3, None, None))
)
WHOLE = Envelope(AT_REST, False, POINTS, Reach(None, 0.38), Reach(5500.0, None))


def test_the_task_reports_points_and_stops():
    told = list[Any]()

    def tell(point: EnvelopePoint) -> None:
        told.append(point)

    assert EnvelopeTask(AT_REST).run(tell, lambda: True) == "Stopped."
    assert len(told) == 1
    stand = make_design(stand={"ct_over_sigma": 0.07}, mu=0.2)
    assert "an envelope is of flight" in str(EnvelopeTask(stand).run(tell, lambda: False))


def test_the_chart_has_both_limits_gaps_and_the_design_before():
    stall, engines = curves(envelope_chart(POINTS, None, 0.2, 1.1))[:2]
    assert stall.y[:2] == (2.0, 1.8)
    assert engines.y[0] == 1.6
    assert engines.y[1] != engines.y[1]
    labels = [line.label for line in curves(envelope_chart(POINTS, WHOLE, 0.2, 1.1))[:4]]
    assert labels == ["before: stall", "before: engines", "stall", "engines"]


def test_the_line_of_engines_goes_through_the_top_speed():
    nowhere = EnvelopePoint(AT_REST.at(mu=0.4), Reach(1.3, 0.0))
    engines = curves(envelope_chart((*POINTS, nowhere), None, 0.2, 1.0, WHOLE.top_speed))[1]
    assert dict(zip(engines.x, engines.y, strict=True))[0.38] == 1.0
    assert list(engines.x) == sorted(engines.x)


def waited(panel: EnvelopePanel) -> None:
    """The rest before the next envelope is over."""
    assert panel._timer is not None
    panel._timer.join(60.0)


def test_the_panel_follows_the_search_and_says_what_is_old(server: viser.ViserServer, monkeypatch: pytest.MonkeyPatch):
    jobs: list[Job] = []

    def submit(task: Any, on_event: Any, limit: float, urgency: int) -> Job:
        jobs.append(Job(len(jobs), task, on_event, limit, urgency))
        return jobs[-1]

    pool = SimpleNamespace(submit=submit, stop=lambda job, quiet=False: None)
    context: Any = SimpleNamespace(gui=server.gui, pool=pool, wake=lambda: None)
    panel = EnvelopePanel(context)

    def shown() -> str:
        return html.unescape(panel._html.content)

    panel.begin()
    assert jobs == []
    state: Any = SimpleNamespace(solution=solve(DESIGN))
    panel.show(state)
    panel.begin()
    assert jobs[0].task == EnvelopeTask(AT_REST)
    jobs[0].tell(JobProgress(POINTS[0]))
    assert "Looking for the limits at µ 0.2" in shown()
    assert "data-chart" in shown()
    jobs[0].tell(JobEnded(WHOLE))
    assert "by engines" in shown()
    assert f"Ceiling {number(5500.0)} m by stall at µ 0.2" in shown()
    assert "earlier design" not in shown()
    panel.show(SimpleNamespace(solution=solve(DESIGN.at(mu=0.3))))  # pyright: ignore[reportArgumentType]
    assert panel._timer is None  # Speed does not move the envelope.

    monkeypatch.setattr(envelope_panel, "_REST", 0.0)
    other: Any = SimpleNamespace(solution=solve(DESIGN.with_twist("linear:-4")))
    panel.show(other)
    assert "Of an earlier design" in shown() or len(jobs) == 2
    waited(panel)
    assert jobs[1].task == EnvelopeTask(AT_REST.with_twist("linear:-4"))
    jobs[1].tell(JobProgress(POINTS[0]))
    assert "Of an earlier design" not in shown()
    panel._moving.value = True
    waited(panel)
    assert jobs[2].task == EnvelopeTask(AT_REST.with_twist("linear:-4"), moving=True)
    panel.show(other)
    assert len(jobs) == 3
