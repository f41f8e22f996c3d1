"""The actuator of a report: the same words and numbers as on the rail and on the command line."""

import math
import re
from dataclasses import replace
from functools import cache

import pytest

from explorer.export.contents import JudgedActuator, ReportEntry, judged_actuator, report_of
from explorer.export.figures import actuator_section
from explorer.export.report import report_html
from explorer.model.inputs import ViewState, baseline_of
from explorer.model.units import AVIATION, SI
from explorer.tabs.actuator.actuator_words import details_panel
from explorer.tabs.actuator.flight_bar import earns_state
from rotor.actuator.verdict import Against, Verdict, try_actuator
from rotor.command import actuator as command
from rotor.files.make_design import make_design
from rotor.trim.solve import solve

DESIGN = make_design(inflow="drees", elements=16, azimuths=36)


@cache
def verdict(against: Against = "best-fixed") -> Verdict:
    return try_actuator("MFC_P1", DESIGN, against=against)


@cache
def judged() -> JudgedActuator:
    return judged_actuator(verdict())


def numbers(page: str) -> list[str]:
    return re.findall(r'data-report="balance">([^<]*)<', page)


@pytest.mark.parametrize("against", ["best-fixed", "as-built"])
def test_report_rail_and_command_say_the_same(against: Against):
    """One sentence, one balance, one number of fuel."""
    one = verdict(against)
    page = actuator_section(judged_actuator(one), SI)
    sentence = re.findall(r'data-report="verdict">([^<]*)<', page)
    rail, printed = earns_state(one, True, SI), command.report(one)
    assert sentence == [printed.splitlines()[0]]
    assert f"<b>{sentence[0]}</b>" in details_panel(one)
    needed = str.maketrans("+−", "−+")  # The page counts the power needed, the report the power saved.
    assert numbers(page) == [bar["text"].translate(needed) for bar in rail["bars"]]
    assert f"<b>{rail['fuel']}</b>" in page
    of_command = re.findall(r"^  (?:gross|stiffness|mass|drive|net)[^-\d]*(-?[\d.]+) kW", printed, re.MULTILINE)
    assert [float(text.replace("−", "-")) for text in numbers(page)] == [float(text) for text in of_command]
    assert len(of_command) == len(one.savings) + 1
    assert float(of_command[-1]) == pytest.approx(1e-3 * one.net_saving, abs=0.051)
    (kilograms,) = re.findall(r"fuel: ([\d.]+) kg an hour", printed)
    assert kilograms in rail["fuel"]


def test_the_legs_of_the_flight_are_those_of_fly():
    one = judged()
    assert not isinstance(one.flight, str)
    rows = re.findall(r"<tr><td>(.*?)</td></tr>", actuator_section(one, SI))
    assert len(rows) == len(one.flight.legs)
    for k, row in enumerate(rows):
        name, wanted, reached, short, net, _ = (cell.replace("−", "-") for cell in row.split("</td><td>"))
        assert name.startswith(one.flight.legs[k].name)
        assert float(wanted) == pytest.approx(math.degrees(one.flight.wanted[k]), abs=0.051)
        assert float(reached) == pytest.approx(math.degrees(one.flight.reached[k]), abs=0.051)
        assert float(short) == pytest.approx(abs(math.degrees(one.flight.shortfall[k])), abs=0.051)
        assert float(net) == pytest.approx(1e-3 * one.flight.net_saving[k], abs=0.051)


def test_limits_and_caveats_stand_below():
    one = judged()
    page = actuator_section(one, SI)
    assert one.verdict.broken
    for sentence in (*(limit.sentence for limit in one.verdict.broken), *one.verdict.caveats):
        assert f"<li>{sentence}</li>" in page


def test_what_cannot_be_flown_or_judged_is_a_sentence():
    assert "climb: no trim" in actuator_section(replace(judged(), flight="climb: no trim"), SI)
    assert "<li>No such blade.</li>" in actuator_section("No such blade.", SI)
    assert actuator_section("", SI) == ""


def test_units_are_those_of_the_page():
    page = actuator_section(judged(), AVIATION)
    assert "hp, mean of µ 0 and µ 0.3" in page
    assert float(numbers(page)[-1].replace("−", "-")) == pytest.approx(verdict().net_saving / 745.7, abs=0.051)


def test_a_report_has_the_section_where_an_actuator_was_chosen():
    entries = [ReportEntry("Now", solve(DESIGN))]
    baseline = ReportEntry("Baseline", solve(baseline_of(DESIGN)))
    for actuator, found in ((judged(), 1), ("", 0)):
        report = report_of(baseline, entries, ViewState(), actuator=actuator)
        assert report_html(report, None).count('<section class="actuator">') == found
