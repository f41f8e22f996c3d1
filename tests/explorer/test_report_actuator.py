"""The actuator of a report: the same words and numbers as on the rail and on the command line."""

import re
from dataclasses import replace
from functools import cache

import pytest

from explorer.export.contents import DesignReport, ReportEntry, on_board
from explorer.export.figures import actuator_section
from explorer.export.report import report_html
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.units import AVIATION, SI
from explorer.text.readout import needs
from explorer.views.actuated import actuated_blade, flight_doubt
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.flight import earns_state
from explorer.workers.call import at_once
from rotor.actuator import with_actuator
from rotor.actuator.verdict import Against, Verdict, reference, try_actuator
from rotor.command import actuator as command
from rotor.files.make_design import make_design
from rotor.trim.doubt import rounded_pair
from rotor.trim.solve import solve
from tests.actuate import actuate

DESIGN = make_design(inflow="drees", elements=16, azimuths=36)


@cache
def verdict(against: Against = "same-blade") -> Verdict:
    return try_actuator("MFC_P1", DESIGN, against=against)


def numbers(page: str) -> list[str]:
    return re.findall(r'data-report="balance">([^<]*)<', page)


@pytest.mark.parametrize("against", ["same-blade", "best-fixed"])
def test_report_rail_and_command_say_the_same(against: Against):
    """One net power with its band, one balance, one number of fuel."""
    one = verdict(against)
    page = actuator_section(one, SI)
    sentence = re.findall(r'data-report="verdict">([^<]*)<', page)
    rail, printed = earns_state(one, True, SI), command.report(one)
    assert one.net_band is not None
    assert sentence == [f"Compared with {reference(one)}, it {needs(one, SI)} over the mission."]
    pair = rounded_pair(one.net_saving / 1e3, one.net_band / 1e3)
    assert f"(± {pair.band:.{pair.decimals}f} kW: likely" in printed.splitlines()[0]
    assert numbers(page) == [bar.text for bar in rail.bars]
    assert f"<b>{rail.fuel}</b>" in page
    said = re.findall(
        r"^  (?:gross|blade|stiffness|mass|drive|net).*?(saves|costs) (\S+)", printed, re.MULTILINE
    )
    of_command = [
        (1.0 if verb == "saves" else -1.0) * float(size.replace("nothing", "0"))
        for verb, size in said
    ]
    needed = [-float(text.replace("−", "-")) for text in numbers(page)]
    if against == "best-fixed":  # The command begins with what the actuator does.
        needed[:2] = needed[1::-1]
    assert needed == pytest.approx(of_command, abs=1.0)
    assert len(of_command) == len(one.savings) + 1
    assert of_command[-1] == pair.change
    (kilograms,) = re.findall(r"Net\s+fuel:\s+\w+\s+([\d.]+)", printed)
    assert kilograms in rail.fuel


def test_limits_and_caveats_stand_below():
    one = verdict()
    page = actuator_section(one, SI)
    assert one.broken
    for sentence in (*(limit.sentence for limit in one.broken), *one.caveats):
        assert f"<li>{sentence}</li>" in page


def test_what_cannot_be_judged_is_a_sentence():
    assert "<li>No such blade.</li>" in actuator_section("No such blade.", SI)
    assert actuator_section("", SI) == ""


def test_units_are_those_of_the_page():
    page = actuator_section(verdict(), AVIATION)
    assert "hp, mean over hover, climb, cruise and fast (hours assumed)" in page
    assert float(numbers(page)[-1].replace("−", "-")) == pytest.approx(
        -verdict().net_saving / 745.7, abs=0.51
    )


def test_a_report_has_the_section_where_an_actuator_was_chosen():
    entries = [ReportEntry("Now", solve(DESIGN))]
    baseline = ReportEntry("Baseline", solve(baseline_of(DESIGN)))
    for actuator, found in ((verdict(), 1), ("", 0)):
        report = DesignReport(baseline, entries, ViewState(), actuator=actuator)
        assert report_html(report, None).count('<section class="actuator">') == found


def test_the_headline_holds_the_mass_on_board_as_the_page_says_it():
    now = actuate(
        Inputs(law="builtin", inflow="drees"), actuator=ActuatorInputs(drives=(77.0,) * 5)
    )
    task = flight_doubt(now)
    assert task is not None
    now = replace(now, answers={task.key: at_once(task.run(lambda: None))})
    driven, card, state = actuated_blade(now), ACTUATOR_CARD.view(now)["assessed"], now.state
    assert driven is not None
    words, against, kind = on_board(driven, SI)
    assert kind == "more"
    assert words.startswith("needs ")
    assert against == f"with {card.mass} on board, compared with the same blade without it"
    baseline = ReportEntry("Baseline", state.baseline)
    page = report_html(
        DesignReport(baseline, [ReportEntry("Now", state.solution)], ViewState(), driven=driven),
        None,
    )
    headline = page[page.index('<article class="card"') : page.index("</article>")]
    assert re.findall('data-report="on-board">([^<]*)<', headline) == [words]
    assert against in headline
    power = solve(with_actuator(make_design(mu=0.2, inflow="drees"), "MFC_P1,drive=77")).power.total
    assert re.findall('data-report="total-power">([^<]*)<', headline) == [SI.watts(power)]
    assert "MFC P1 at 1" in headline
