"""The panel that says what would pay: its words and drawings, without a server."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import viser

from explorer.tabs.actuator.pay_panel import PayAnswer, PayPanel, PayTask, drive_chart, mass_chart, pay_panel
from explorer.workers.pool import Job, JobEnded, JobProgress
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.estimate import Estimate
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import BreakEven, Candidate
from rotor.actuator.section import Host, default_placement
from rotor.actuator.verdict import judge
from rotor.chart import Points
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from tests.curves import curves

DESIGN = make_design(inflow="drees")


def even(gain: float = 3000.0) -> BreakEven:
    """A made-up line: saving x(2 − x) of a range of 4°, 200 W per kilogram."""
    x = np.linspace(0.0, 1.0, 9)
    gross = gain * x * (2.0 - x)
    return BreakEven(
        ConditionPair(DESIGN, (0.0, 0.3)), 1.4e6, math.radians(4.0), math.radians(4.0) * x, gross, x, gross / 200.0
    )


def built(plies: int = 2) -> InstalledActuator:
    return install(find_actuator("MFC_P1"), default_placement(plies), Host("new", 0.5), DESIGN.rotor)


def answer(line: BreakEven | None = None) -> PayAnswer:
    builds = tuple(Candidate(built(n), Estimate(1.0, 2000.0, 100.0, 900.0 * n, 0.0)) for n in (1, 2))
    return PayAnswer(line or even(), ("Pays if it twists.", "None of 2 builds pays."), builds)


def test_the_panel_holds_sentence_charts_and_builds():
    html = pay_panel(answer(), None)
    assert "<b>Pays if it twists.</b>" in html
    assert 'data-explorer="pay-mass"' in html
    assert 'data-explorer="pay-drive"' in html
    rows = re.findall(r"<tr><td>(.*?)</td><td>", html)
    assert [row.replace("\u00a0", " ") for row in rows] == [
        "MFC P1, 1 ply, 0.24–0.93 R, GJ × 0.5",
        "MFC P1, 2 plies, 0.24–0.93 R, GJ × 0.5",
    ]
    assert ">+1.0</td>" in html  # 2000 − 900 − 100 W
    assert ">200</td>" in html  # of its cost
    assert "find again" not in html
    assert "find again" in pay_panel(answer(), None, stale=True)
    assert "data-chart" not in pay_panel(answer(even(10.0)), None)  # Nothing is to be saved.


def test_the_point_is_what_the_verdict_says():
    """Red where it does not pay; it stands at the linear twist that saves as much as the plies do."""
    design = make_design(inflow="drees", elements=16, azimuths=36)
    pair = ConditionPair(design, (0.0, 0.3))
    judged = judge(find_actuator("MFC_P1"), pair, find_concept("linear"), default_placement(2), Host("new", 0.5))
    line = replace(even(4000.0), pair=pair)
    chart = mass_chart(line, judged)
    point = chart.series[-1]
    assert isinstance(point, Points)
    assert judged.net_saving < 0.0
    assert point.colour == "var(--rx-bad)"
    worth = math.degrees(line.twist_for(judged.gross_saving - judged.stiffness_cost))
    assert 0.0 < worth < 4.0
    assert f"worth {worth:.1f}°, {judged.installed.masses.aircraft:.0f} kg" in point.words[0]
    assert point.words[0].startswith("MFC P1")
    assert point.words[0].endswith("does not pay")
    assert not [one for one in mass_chart(line, None).series if isinstance(one, Points)]
    edge = curves(chart)[1]
    assert point.y[0] > np.interp(point.x[0], edge.x, edge.y)  # More mass than pays.


def test_drive_falls_to_nothing_at_the_mass_that_pays():
    whole, half = curves(drive_chart(even()))
    assert whole.x[-1] > half.x[-1]  # More twist pays for more mass,
    assert whole.y[0] > half.y[0]  # and more power at no mass.
    assert whole.y[-1] == pytest.approx(half.y[-1], abs=0.002)  # Both end on the axis.


def test_the_search_reports_the_line_first_and_says_why_there_is_none(server: viser.ViserServer):
    jobs: list[Job] = []

    def submit(task: Any, on_event: Any, limit: float, urgency: int) -> Job:
        jobs.append(Job(len(jobs), task, on_event, limit, urgency))
        return jobs[-1]

    pool = SimpleNamespace(submit=submit, stop=lambda job, quiet=False: job.silence() if quiet else None)
    stage = dict[str, Any]()
    bridge = SimpleNamespace(set=stage.update)
    context: Any = SimpleNamespace(gui=server.gui, pool=pool, wake=lambda: None, bridge=bridge)
    panel, pair = PayPanel(context), ConditionPair(DESIGN, (0.0, 0.3))

    def shown(pair: ConditionPair | None = pair) -> str:
        panel.refresh(pair, None)
        return panel._html.content

    panel.begin()  # No blade that carries an actuator is shown yet.
    assert jobs == []
    assert 'data-kind="problem"' in shown()
    panel.begin()
    assert jobs[0].task == PayTask(pair)
    assert 'data-kind="computing"' in shown()
    jobs[0].tell(JobProgress(answer()))
    assert 'data-kind="ready"' in shown()
    assert panel.running
    jobs[0].tell(JobEnded(answer()))
    assert not panel.running
    assert "find again" not in shown()
    assert stage == {"pays": "None of 2 builds pays."}
    assert "find again" in shown(ConditionPair(DESIGN, (0.0, 0.2)))
    assert stage == {"pays": None}  # It was told about other conditions.
    panel.begin()
    jobs[1].tell(JobEnded("No twist saves anything here."))
    assert "No twist saves anything here." in shown()
