"""The panel that says what would pay: its words and drawings, without a server."""

import math
import pickle
import re
from dataclasses import replace

import numpy as np
import pytest

from explorer.tabs.actuator.pay_panel import PayAnswer, drive_chart, mass_chart, pay_panel, pay_tasks
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.estimate import Estimate
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import BreakEven, Candidate
from rotor.actuator.section import Host, default_placement
from rotor.actuator.verdict import judge
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept

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
    assert min(int(size) for size in re.findall(r'font-size="(\d+)"', html)) >= 12
    assert "<svg" not in pay_panel(answer(even(10.0)), None)  # Nothing is to be saved.


def test_the_point_is_what_the_verdict_says():
    """Red where it does not pay; it stands at the linear twist that saves as much as the plies do."""
    design = make_design(inflow="drees", elements=16, azimuths=36)
    pair = ConditionPair(design, (0.0, 0.3))
    judged = judge(find_actuator("MFC_P1"), pair, find_concept("linear"), default_placement(2), Host("new", 0.5))
    line = replace(even(4000.0), pair=pair)
    drawn = mass_chart(line, judged)
    assert judged.net_saving < 0.0
    assert "var(--rx-bad)" in drawn
    worth = math.degrees(line.twist_for(judged.gross_saving - judged.stiffness_cost))
    assert 0.0 < worth < 4.0
    assert f"worth {worth:.1f}°, {judged.installed.masses.aircraft:.0f} kg" in drawn
    assert "MFC P1 does not pay" in drawn
    assert "<circle" not in mass_chart(line, None)
    circle, edge = (re.search(pattern, drawn) for pattern in (r'cy="([\d.]+)" r', r'<polyline points="[\d.]+,([\d.]+)'))
    assert circle is not None
    assert edge is not None
    assert float(circle[1]) < float(edge[1])  # Higher on the page: more mass.


def test_drive_falls_to_nothing_at_the_mass_that_pays():
    drawn = drive_chart(even())
    lines = [
        [tuple(map(float, pair.split(","))) for pair in points.split()]
        for points in re.findall(r'<polyline points="([^"]+)"', drawn)
    ]
    assert len(lines) == 2
    whole, half = lines
    assert whole[-1][0] > half[-1][0]  # More twist pays for more mass.
    assert whole[-1][1] == pytest.approx(half[-1][1], abs=0.2)  # Both end on the axis.
    assert whole[0][1] < half[0][1]  # and more power at no mass.


def test_the_task_pickles_and_says_why_there_is_no_answer():
    for task in pay_tasks(ConditionPair(make_design(mass_kg=20_000.0, altitude_m=4000.0), (0.0, 0.3))):
        assert pickle.loads(pickle.dumps(task)) == task
        assert "reduce the mass" in task.run()
    assert len(pickle.dumps(answer())) < 200_000
