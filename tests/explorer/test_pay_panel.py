"""The panel that says what would pay: its words and drawings, without a server."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import viser

from explorer.model.units import SI
from explorer.sharing.share import Address
from explorer.tabs.actuator.pay_panel import PayAnswer, PayPanel, PayTask, drive_chart, mass_chart, pay_panel, place_of
from explorer.tabs.background import PoolAnswers
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.estimate import Estimate
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import BreakEven, Candidate, Supposed
from rotor.actuator.section import Host, default_placement
from rotor.actuator.verdict import judge
from rotor.chart import Points
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.processes import Job, JobEnded, JobProgress
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
    html = pay_panel(answer())
    assert "<b>Pays if it twists.</b>" in html
    assert 'data-explorer="pay-drive"' in html
    rows = re.findall(r"<tr><td>(.*?)</td><td>", html)
    assert [row.replace("\u00a0", " ") for row in rows] == [
        "MFC P1, 1 ply, 0.24–0.93 R, GJ × 0.5",
        "MFC P1, 2 plies, 0.24–0.93 R, GJ × 0.5",
    ]
    assert ">+1.0</td>" in html  # 2000 − 900 − 100 W
    assert ">200</td>" in html  # of its cost
    assert "find again" not in html
    assert "find again" in pay_panel(answer(), stale=True)
    assert "data-chart" not in pay_panel(answer(even(10.0)))  # Nothing is to be saved.


def test_points_are_what_the_verdicts_say():
    """Each actuator at the reach of its tip and its mass, red where it does not pay; with its whole price in words."""
    design = make_design(inflow="drees", elements=16, azimuths=36)
    pair = ConditionPair(design, (0.0, 0.3))
    judged = judge(find_actuator("MFC_P1"), pair, find_concept("linear"), default_placement(2), Host("new", 0.5))
    line = replace(even(4000.0), pair=pair)
    chart = mass_chart(line, [judged])
    point = chart.series[-1]
    assert isinstance(point, Points)
    assert judged.net_saving < 0.0
    assert point.colour == "var(--rx-bad)"
    assert point.x[0] == pytest.approx(math.degrees(judged.installed.attainable))
    assert point.y[0] == pytest.approx(judged.installed.masses.aircraft)
    assert point.names == ("MFC P1",)
    assert f"needs {-judged.net_saving / 1e3:.0f} kW more" in point.words[0]
    assert not [one for one in mass_chart(line).series if isinstance(one, Points)]
    edge = curves(chart)[1]
    assert point.y[0] > np.interp(point.x[0], edge.x, edge.y)  # More mass than pays.


@pytest.mark.parametrize("text", ["", "4", "4,12,1", "91,12", "4,0", "4,-1", "1e9,1", "4,20000", "..,1", "nan,1"])
def test_a_place_that_is_none_is_refused_with_the_remedy(text: str):
    assert place_of("4.2,12") == (4.2, 12.0)
    with pytest.raises(ValueError, match=re.escape(repr(text)) + r".*write 4,12\."):
        place_of(text)


def test_drive_falls_to_nothing_at_the_mass_that_pays():
    whole, half = curves(drive_chart(even()))
    assert whole.x[-1] > half.x[-1]  # More twist pays for more mass,
    assert whole.y[0] > half.y[0]  # and more power at no mass.
    assert whole.y[-1] == pytest.approx(half.y[-1], abs=0.002)  # Both end on the axis.


Jobs = list[Job]
Stage = dict[str, Any]
Press = Callable[[Any], None]


@pytest.fixture
def panel_of(server: viser.ViserServer):
    """A panel opened with a query, its jobs, what it sets on the stage, its press, and the queries it writes."""

    def made(query: str = "") -> tuple[PayPanel, Jobs, Stage, Press, list[str], list[tuple[str, str]]]:
        jobs: Jobs = []
        stage: Stage = {}
        presses: dict[str, Press] = {}
        written: list[str] = []
        problems: list[tuple[str, str]] = []

        def submit(task: Any, on_event: Any, limit: float, urgency: int) -> Job:
            jobs.append(Job(len(jobs), task, on_event, limit, urgency))
            return jobs[-1]

        pool = SimpleNamespace(submit=submit, stop=lambda job, quiet=False: job.silence() if quiet else None)
        bridge = SimpleNamespace(set=stage.update, on=presses.__setitem__)
        context: Any = SimpleNamespace(
            gui=server.gui, pool=pool, wake=lambda: None, bridge=bridge, held=False, units=SI
        )
        panel = PayPanel(context, Address(query, written.append, pause=0.0), problems)
        return panel, jobs, stage, presses["suppose"], written, problems

    return made


def test_the_search_reports_the_line_first_and_says_why_there_is_none(panel_of: Any):
    panel, jobs, stage, *_ = panel_of()
    pair = ConditionPair(DESIGN, (0.0, 0.3))

    def shown(pair: ConditionPair | None = pair) -> str:
        panel.refresh(pair)
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
    assert stage == {"pays": "None of 2 builds pays.", "suppose": None}
    assert "find again" in shown(ConditionPair(DESIGN, (0.0, 0.2)))
    assert stage == {"pays": None, "suppose": None}  # It was told about other conditions.
    panel.begin()
    jobs[1].tell(JobEnded("No twist saves anything here."))
    assert "No twist saves anything here." in shown()


def test_a_supposed_actuator_is_dragged_and_stays_in_the_address(panel_of: Any, monkeypatch: pytest.MonkeyPatch):
    """Read off the line at once, and told with its band when it is trimmed; gone with a press."""
    line, known = even(), dict[str, Any]()
    pair = line.pair
    monkeypatch.setattr(PoolAnswers, "ask", lambda self, tasks, delay: None)
    monkeypatch.setattr(PoolAnswers, "answer", lambda self, task: known.get(task.function.__name__))
    panel, _, stage, press, written, _ = panel_of("d=1")
    panel.refresh(pair)
    assert stage["suppose"] is None
    press("on")
    panel.refresh(pair)
    assert "Trimming" in stage["suppose"]["words"]
    known["break_even"] = line
    press([2.0, 4.3])
    panel.refresh(pair)
    # On the line: 3000·½·1.5 W of twist less 4.3·200 W of mass.
    assert stage["suppose"]["words"] == "2.0° for 4.3 kg saves 1.4 kW …"
    assert stage["suppose"]["at"] == [2.0, 4.3]
    assert panel.pays
    assert written[-1].endswith("i=2,4.3")
    known["suppose"] = Supposed(1100.0, 0.0001, 300.0)
    panel.refresh(pair)
    assert stage["suppose"]["words"] == "2.0° for 4.3 kg saves 1.1 kW (± 0.3 kW: sure), −0.4 kg of fuel an hour"
    assert panel.sentence == "2.0° for 4.3 kg saves 1.1 kW (± 0.3 kW: sure)"
    assert stage["suppose"]["kind"] == "gain"
    known["suppose"] = Supposed(1100.0, 0.0001, 1500.0)
    panel.refresh(pair)
    assert "cannot be told" in panel.sentence
    panel.rest()  # Another mode may show another design: the shared picture does not speak of this one.
    assert (panel.sentence, panel.pays) == ("", False)
    panel.refresh(pair)
    assert "cannot be told" in panel.sentence
    assert (stage["suppose"]["kind"], panel.pays) == ("", False)
    known["suppose"] = "No trim there."
    panel.refresh(pair)
    assert stage["suppose"]["note"] == "No trim there."
    del known["suppose"]
    press([2.0, 50.0])
    panel.refresh(pair)
    assert stage["suppose"]["kind"] == "loss"
    assert not panel.pays
    press("off")
    panel.refresh(pair)
    assert stage["suppose"] is None
    assert "i=" not in written[-1]


def test_a_link_holds_the_supposed_actuator(panel_of: Any):
    panel, *_, problems = panel_of("d=1&i=3.2,9")
    assert panel.on_stage
    assert not problems
    panel, *_, problems = panel_of("d=1&i=3.2;9")
    assert not panel.on_stage
    assert "write 4,12" in problems[0][1]
