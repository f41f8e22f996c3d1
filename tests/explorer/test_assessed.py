"""One value of the actuator as set: every number on the screen of Actuate, by its quantity, is the same."""

import json
import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.export.contents import DesignReport, ReportEntry, on_board
from explorer.export.figures import actuator_section
from explorer.export.provenance import provenance_lines
from explorer.export.report import report_html
from explorer.model.actuator_inputs import AGAINST, MOST_SEGMENTS, ActuatorInputs, ActuatorState
from explorer.model.inputs import ViewState
from explorer.model.session_state import SessionState
from explorer.model.units import SI, adding
from explorer.page import PANELS
from explorer.parts.actuate import AssessedPart, PowerBar
from explorer.parts.presses import SupposePress
from explorer.parts.results import LinePiece
from explorer.picture.lifted_picture import lifted_picture
from explorer.sharing.share import code_of, design_from
from explorer.text.readout import limit_words
from explorer.views.actuated import ActuatedBlade, actuated_blade
from explorer.views.actuator import ACTUATOR
from explorer.views.actuator_words import limits_panel
from explorer.views.assessed import ACTUATOR_CARD, choose
from explorer.views.dial import DIAL
from explorer.views.flight import FLIGHT
from explorer.views.line import LINE, line_text
from explorer.views.page_state import OpenPanels, PageState, SetHand
from explorer.views.pay import PAY
from explorer.views.power import POWER
from explorer.views.vibration import VIBRATION
from explorer.views.worth import WORTH
from explorer.workers.call import Call
from rotor import Design, Solution, doubt
from rotor.actuator import (
    HostBlade,
    default_placement,
    effect,
    find_actuator,
    fly,
    install,
    tip_amplitude,
    try_actuator,
    with_actuator,
)
from rotor.actuator.verdict import Against, Verdict, judge, verdict_details
from rotor.command import actuator as command
from rotor.design import Harmonic
from rotor.design.active_twist import read_harmonics
from rotor.files.design_file import design_from_record
from rotor.files.make_design import make_design
from rotor.optimisation import FlightLeg
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.vibration import with_harmonics
from rotor.trim.doubt import ESTIMATED, RoundedPair, rounded_pair, sureness
from rotor.trim.solve import solve
from tests.actuate import INPUTS, actuate, answered, done, run, worked

DRIVEN = (77.0,) * MOST_SEGMENTS
DESIGN = make_design(mu=0.2, inflow="drees")
NUMBER = r"[+−]?\d+(?:\.\d+)?"


@cache
def trimmed(design: Design) -> Solution:
    return solve(design).require()


def card(now: PageState) -> AssessedPart:
    part = ACTUATOR_CARD.view(now)["assessed"]
    assert isinstance(part, AssessedPart)
    return part


def known(now: PageState) -> tuple[ActuatedBlade, Verdict]:
    value = actuated_blade(now)
    assert value is not None
    assert value.verdict is not None
    return value, value.verdict


def balance_here(now: PageState) -> dict[str, str]:
    """Each part of the power in this flight, as written."""
    part = FLIGHT.view(replace(now, hand=done(now, FLIGHT.presses["balance"](now, "here")).hand))[
        "earns"
    ]
    assert (part.kind, part.here, part.where) == ("ready", True, "at 159 km/h")
    return {bar.name: bar.text for bar in part.bars}


def screen(now: PageState) -> dict[str, list[str]]:
    """Every number with a unit of all panels of Actuate, of the power card and of exports, by its quantity."""
    found: dict[str, list[str]] = defaultdict(list)

    def read(quantity: str, pattern: str, text: str) -> None:
        matches = re.findall(pattern.replace("#", f"({NUMBER})"), text)
        assert matches, (quantity, pattern, text)
        found[quantity] += [one if isinstance(one, str) else "…".join(one) for one in matches]

    (value, verdict), part, flight, rail = (
        known(now),
        card(now),
        FLIGHT.view(now),
        ACTUATOR.view(now),
    )
    words = " ".join(
        text
        for _, text, _ in lifted_picture(now.hand.actuator, value.installed, value.design).labels
    )
    report = re.sub(r"<[^>]*>", " ", actuator_section(verdict, SI))
    (total,) = [bar.text for bar in flight["earns"].bars if bar.total]

    found["mass"] = [part.mass.removesuffix(" kg")]
    found["mass"].append(
        f"{sum(float(mass) for mass in re.findall(rf'({NUMBER}) kg of', words)):.0f}"
    )
    read("mass", "# kg:", report)
    staged = replace(now, hand=replace(now.hand, on_stage=True))
    kinds = re.sub(r"<[^>]*>", " ", PAY.view(staged)["actuator.kinds"].replace("</tr>", "\n"))
    row = rf"(?m)^ +{value.name} +"
    read("range", f"{row}# ", kinds)
    found["range in flight"] = [f"{part.range:.2f}"]
    read("mass", f"{row}{NUMBER} +#", kinds)
    read("power over the flight", rf"{row}{NUMBER} +{NUMBER} +[+−]([\d.]+) ±", kinds)
    read("range in flight", "range of tip twist #° in flight", rail["actuator.numbers"])
    read("torsion", "first torsion at #/rev", rail["actuator.numbers"])
    read("fuel", "([\\d.]+) ±", flight["earns"].fuel)
    read("fuel", "Net fuel: \\w+ # ±", report)
    for share in POWER.view(now)["power"].parts:
        found[share.part] = [share.value]
    found["tip"] = [part.tip, flight["flight"].tip]
    read("tip", "actuator-twist[^>]*>([^<]*)<", rail["actuator.now"])
    if now.hand.actuator.driven:
        read("tip", f"({NUMBER}°) at the tip", words)
    found["reach"] = [part.reach]
    assert part.end.removesuffix("°") in part.reach
    assert part.scale is not None
    for mark in part.scale.marks:
        assert f"{mark.name} {mark.value}" in part.scale.sentence
        for name in mark.name.split(", "):
            found[f"power {name}"].append(mark.value)
    found["power"] += [mark.value for mark in part.scale.marks if mark.flown]
    said = line_text(now)
    read("power", "needs # ±", said)
    read("power", r": # kW, [0-9.]+ % of the disk", flight["flight"].words)
    read("stalled", "# % of the disk separated", flight["flight"].words)
    read("power here", "kW.*: # ± .*kW (?:more|less) than", said)
    read("power compared with", r"than [a-z ]+ \(#\)", said)
    found["power here"].append(balance_here(now)["total"].lstrip("+−"))
    read("power over the flight", "^# ± .* (?:more|less)$", part.earns)
    read("power over the flight", ", it (?:needs|saves) # ±", report)
    found["power over the flight"].append(total.lstrip("+−"))
    read("power here", "(?:needs|saves) # ±", on_board(value, SI)[0])
    assert now.state is not None
    design = now.state.solution.design
    carried = design.rotor.blade.carried
    assert carried is not None
    exported = {
        "CSV": float(
            re.findall(r"total power ([\d.]+) kW", "\n".join(provenance_lines(now.state.solution)))[
                0
            ]
        ),
        "link": 1e-3
        * trimmed(
            with_actuator(design_from(code_of(now.inputs.design())), carried.spec)
        ).power.total,
        "design file": 1e-3
        * trimmed(design_from_record(json.loads(json.dumps(design.to_dict())))).power.total,
    }
    found["power"] += [f"{kilowatts:.0f}" for kilowatts in exported.values()]
    entries = ReportEntry("Blade", now.state.baseline), [ReportEntry("Now", now.state.solution)]
    page = report_html(DesignReport(*entries, ViewState(), driven=value, line=said), None)
    assert said.replace("\u00a0", " ") in page.replace("\u00a0", " ")
    read("power", 'data-report="total-power">#\\s?kW', page.partition("</article>")[0])
    if "unclear" not in part.vibration:
        read("vibration", r"vibration # %", part.vibration)
    for words in (*part.over, *part.required):
        if words == "no space" or " far above " in words:
            continue
        (name,) = [
            limit.name
            for limit in verdict.broken
            if words.startswith(f"{limit_words(limit.name)} ")
        ]
        read(f"limit {name}", f"({NUMBER}) of (?:at least )?{NUMBER} ", words.replace("\u2009", ""))
    assert not {limit.split()[0] for limit in part.over} & {"voltage", "field"}
    return found


@cache
def scheduled_drive(id: str, against: Against) -> float:
    """In the flight of `DESIGN` [%]."""
    verdict = judged(against, id)
    swing = fly(verdict, [FlightLeg("here", 0.2)]).swings[0][0]
    return float(round(100.0 * verdict.installed.actuator.share_of(swing)))


@cache
def judged(against: Against, id: str = "MFC_P1") -> Verdict:
    return try_actuator(id, DESIGN, against=against)


def as_said(watts: float, band: float | None) -> str:
    if band is None:
        return f"{abs(1e-3 * watts):.{0 if abs(watts) >= 9950.0 else 1}f}"
    return printed_size(rounded_pair(1e-3 * watts, 1e-3 * band))


def printed_size(pair: RoundedPair) -> str:
    return f"{abs(pair.change):.{pair.decimals}f}"


def of_rotor(id: str, against: Against, state: ActuatorState, drive: float) -> dict[str, str]:
    """The same quantities, by `rotor` alone."""
    verdict = judged(against, id)
    installed = verdict.installed
    scale = {
        "without it": DESIGN,
        "at rest": with_actuator(DESIGN, f"{id},drive=0"),
        "as set": with_actuator(DESIGN, f"{id},drive={drive}"),
        "by schedule": with_actuator(DESIGN, f"{id},drive={scheduled_drive(id, against)}"),
        "best fixed blade": replace(DESIGN, twist=verdict.baseline.fixed_twist),
    }
    if state == "stopped":
        scale["stopped"] = scale["as set"]
    if state == "schedule":
        drive = scheduled_drive(id, against)
    flown = trimmed(with_actuator(DESIGN, f"{id},drive={drive}"))
    blade = (
        DESIGN if against == "same-blade" else replace(DESIGN, twist=verdict.baseline.fixed_twist)
    )
    other = trimmed(blade)
    bent = [replace(one, models=replace(one.models, bending=True)) for one in (flown.design, blade)]
    index = run(Call(effect, tuple(bent))).index
    least = -1.0 if id in ("MFC_P1", "AFC") else 0.0  # A tube turns the tip one way.
    ends = [
        installed.tip([installed.actuator.swing_at(end)] * len(installed.shapes))
        for end in (least, 1.0)
    ]
    tip = math.degrees(
        installed.tip([installed.actuator.swing_at(0.01 * drive)] * len(installed.shapes))
    )
    fuel, within = verdict.fuel_saving, verdict.fuel_band
    assert fuel is not None
    assert within is not None
    found = {
        "mass": f"{installed.masses.aircraft:.0f}",
        "tip": f"{tip:+.2f}°" if drive else "0.00°",
        "reach": "…".join(f"{math.degrees(end):+.2f}" if end else "0.00" for end in sorted(ends))
        + "°",
        "range": f"{math.degrees(verdict.attainable):.1f}",
        "range in flight": f"{math.degrees(verdict.attainable):.2f}",
        "torsion": f"{installed.frequency:.2f}",
        "fuel": printed_size(rounded_pair(3600.0 * fuel, 3600.0 * within)),
        "stalled": f"{100.0 * flown.stalled_area:.1f}",
        **{
            name: f"{1e-3 * getattr(flown.power, name):.0f}"
            for name in ("induced", "profile", "parasite", "tail")
        },
        "power": f"{1e-3 * flown.power.total:.0f}",
        "power compared with": f"{1e-3 * other.power.total:.0f}",
        **{
            f"power {name}": f"{1e-3 * trimmed(design).power.total:.0f}"
            for name, design in scale.items()
        },
        "power here": as_said(
            flown.power.total - other.power.total + (verdict.drive.hold_power if drive else 0.0),
            None if flown.design == other.design else doubt(flown, other).change_band,
        ),
        "power over the flight": as_said(verdict.net_saving, verdict.net_band),
        **{
            f"limit {limit.name}": f"{limit.value:.{0 if max(limit.value, limit.bound) >= 20.0 else 2}f}"
            for limit in verdict.broken
            if not limit.far_above
        },
    }
    if min(index) * max(index) > 0.0:
        found["vibration"] = f"{sum(index) / len(index):+.0f}"
    return {name: text.replace("-", "−") for name, text in found.items()}


def check_mass_that_pays(now: PageState, allowed: float) -> None:
    """The card names the mass [kg] at which it breaks even with its band, unless the band holds no mass as well."""
    value, _ = known(now)
    assert value.line is not None
    words = "".join(card(now).pays)
    band = value.line.band(value.range, allowed) / value.line.per_kg
    if not allowed:
        assert words == "It would not pay, however light."
        return
    pair = rounded_pair(allowed, band)
    named = f"pay below {pair.change:.{pair.decimals}f} kg (± {pair.band:.{pair.decimals}f} kg)"
    assert (named in words.replace("pays", "pay")) == (allowed >= band)
    assert ("no mass is sure to pay" in words) == (allowed < band)


STATES = ("set", 0.0), ("set", 77.0), ("schedule", 77.0), ("stopped", 77.0)
SCREENS = (
    *(("MFC_P1", "same-blade", *state) for state in STATES),
    *(("MFC_P1", "best-fixed", *state) for state in STATES[1:3]),
    *((id, "same-blade", *state) for id in ("AFC", "SMA_tube") for state in STATES[1:]),
)


@pytest.mark.parametrize(("id", "against", "state", "drive"), SCREENS)
def test_every_number_on_the_screen_is_that_of_rotor(
    id: str, against: Against, state: ActuatorState, drive: float
):
    now = answered(against, (drive,) * MOST_SEGMENTS, state, id)
    found = screen(now)
    assert {name: set(values) for name, values in found.items()} == {
        name: {value} for name, value in of_rotor(id, against, state, drive).items()
    }
    check_mass_that_pays(now, judged(against, id).mass_allowed or 0.0)
    parts = balance_here(now)
    *each, total = (float(text.replace("−", "-")) for text in parts.values())
    assert sum(each) == pytest.approx(total, abs=1e-9)  # What is written adds up.
    if against == "same-blade" and not drive:
        assert float(parts["its twist"]) == 0.0
    assert ("present blade" in parts) == (against == "best-fixed")
    than = "without it" if against == "same-blade" else "with the best fixed blade"
    states = {"set": "at", "schedule": "by schedule at", "stopped": "stopped at"}
    assert re.search(
        rf", twist as built, with {id.replace('_', ' ')} {states[state]} .* than {than} \(\d+\), ",
        line_text(now),
    )


@pytest.mark.parametrize("against", AGAINST)
def test_one_that_hardly_moves_says_so_once_and_has_no_number_beyond_its_limits(against: Against):
    """PZT5A shears by its thickness alone: 0.00° of tip twist, and volts by the million for what is required."""
    now = answered(against, DRIVEN, "set", "PZT5A")
    value, verdict = known(now)
    part = card(now)
    volts = next(limit for limit in verdict.broken if limit.name == "voltage")
    assert value.installed.too_weak
    assert volts.value > 1e4 * volts.bound
    assert (part.reach, part.pays) == ("", ())
    assert (part.buildable, part.tip, part.end) == ("not buildable: far too weak", "0.00°", "")
    required = " ".join(part.required)
    assert f"voltage far above {volts.bound:.0f} V" in required
    assert "field far above " in required
    details = verdict_details(verdict)
    assert details.count("far too weak") == 1
    assert " moves 0.00°: far too weak for the " in details
    texts = [
        *(one for one in parts_of(part) if isinstance(one, str)),
        re.sub(r"<[^>]*>", " ", actuator_section(verdict, SI)),
        re.sub(r"<[^>]*>", " ", limits_panel(verdict)),
        command.report(verdict),
    ]
    for text in texts:
        assert re.findall(r"\d{6,}", text.replace("\u2009", "")) == []
        assert "0.00…0.00" not in text


def test_while_the_blade_is_out_only_what_is_seen_is_computed():
    """Costs of switches and of the sliders of a flight are not; the dial, which is folded, comes last."""
    now = actuate(INPUTS)
    works = {work.name for panel in PANELS if panel.seen(now.ui) for work in panel.works(now)}
    assert works == {"doubt", "measured", "slopes", "still"}
    now = replace(now, ui=replace(now.ui, lifted=False))
    assert {"flight-slopes", "waterfall"} < {
        w.name for p in PANELS if p.seen(now.ui) for w in p.works(now)
    }
    now = answered("same-blade", DRIVEN)
    last = {one.urgency for one in DIAL.asks(now)[1:]}
    assert min(last) > max(
        one.urgency for one in (*ACTUATOR.asks(now)[:2], *ACTUATOR_CARD.asks(now))
    )


def test_twist_at_n_per_rev_adds_the_same_to_card_dial_and_balance():
    """Card less card at rest is the dial's reading, which lies inside its band; its drive is in the balance. A twist
    that the voltage leaves no room for is a limit exceeded."""
    waves = read_harmonics("3:0.75:60", "test")
    rest, run_at = (
        answered("same-blade", DRIVEN, inputs=replace(INPUTS, twist_per_rev=twist))
        for twist in ((), waves)
    )
    before, after = known(rest)[0].here, known(run_at)[0].here
    dials = [DIAL.view(now)["dial"].settled for now in (rest, run_at)]
    assert before is not None
    assert after is not None
    assert (dials[0].power, dials[0].index) == ((0.0,), (0.0,))
    assert 1e-3 * (after.power - before.power) == pytest.approx(dials[1].power[0], abs=2e-3)
    assert len(dials[1].power) == len(dials[1].index) > 3
    assert_allclose(dials[1].power[0], 1e-3 * _alone(waves), atol=2e-3)
    drive = [float(balance_here(now)["drive"].replace("−", "-")) for now in (rest, run_at)]
    assert drive[1] > drive[0]
    assert (card(rest).over[-1][:5], card(run_at).over[-1]) == (
        card(rest).over[-1][:5],
        "twist at n/rev 0.75 of 0.30°",
    )
    assert ", 3/rev twist 0.75° at 60°, " in line_text(run_at)
    assert ", with 3/rev 0.75°" in ACTUATOR.view(run_at)["actuator.now"]


def _alone(waves: tuple[Harmonic, ...]) -> float:
    """What the waves add [W], by `rotor` alone."""
    design = with_actuator(DESIGN, "MFC_P1,drive=77")
    flown, still = trimmed(with_harmonics(design, waves)), trimmed(design)
    installed = find_actuator("MFC_P1"), default_placement(), HostBlade(), design.rotor
    on_blade = install(*installed)
    share = waves[0].amplitude / tip_amplitude(on_blade)
    heat = 4.0 * on_blade.actuator.harmonic_loss(on_blade, 3, 1.0) * share**2
    assert flown.elastic is not None
    assert still.elastic is not None
    work = flown.elastic.control_power - still.elastic.control_power
    return flown.power.total - still.power.total + heat + work


def test_the_switch_moves_every_change_by_what_lies_between_the_blades():
    """At no voltage, and against the same blade, only mass and stiffness change power and vibration."""
    same = answered("same-blade", (0.0,) * MOST_SEGMENTS)
    (one, verdict), (other, counted) = (
        known(answered(against, (0.0,) * MOST_SEGMENTS)) for against in AGAINST
    )
    assert one.here and other.here and one.over_flight and other.over_flight and one.line  # noqa: PT018
    fixed = replace(DESIGN, twist=counted.baseline.fixed_twist)
    between = trimmed(DESIGN).power.total - trimmed(fixed).power.total
    assert other.here.power - one.here.power == pytest.approx(between, abs=1.0)
    assert one.vibration
    assert other.vibration
    assert abs(one.vibration[0]) < 0.5 * abs(other.vibration[0])
    between = verdict.bare_power - counted.reference_power
    assert other.over_flight.power - one.over_flight.power == pytest.approx(between, abs=1.0)
    assert one.line.net(one.range, one.mass) == pytest.approx(-one.over_flight.power, abs=1.0)
    assert choose(same, "best-fixed") == (SetHand(actuator={"against": "best-fixed"}),)


def test_one_press_makes_it_feasible():
    """The actuator that it sets has no limit exceeded but those of the range, which the voltage keeps."""
    now = answered("same-blade", DRIVEN)
    assert card(now).feasible == "1 ply, chord from 0.15"
    moved = done(now, ACTUATOR_CARD.presses["feasible"](now, None)).hand.actuator
    one = judged("same-blade")
    other = replace(one.installed.placement, plies=moved.plies, chord=moved.chord)
    assert not one.buildable
    assert judge(
        one.installed.actuator, one.baseline.mission, find_concept("linear"), other
    ).buildable


def test_full_voltage_is_the_reach_and_trims_make_that_twist():
    """Elastic trims with and without voltage: mean over azimuth, tip less root."""
    design = make_design(preset="flight", mu=0.2)
    ends = []
    for end in (-100.0, 100.0):
        inputs = ActuatorInputs(drives=(end,) * MOST_SEGMENTS)
        installed = inputs.installed(design.rotor)
        tips = []
        for flown in (
            with_actuator(design, f"MFC_P1,drive={end}"),
            with_actuator(design, "MFC_P1"),
        ):
            trim = solve(flown)
            twist = trim.disk.elastic_twist.mean(axis=1) + trim.design.twist(trim.disk.r)
            tips.append(float(np.interp(1.0, trim.disk.r, twist) - twist[0]))
        ends.append(inputs.tip(installed))
        assert tips[0] - tips[1] == pytest.approx(ends[-1], rel=0.02)
    assert replace(ActuatorInputs(), drives=DRIVEN).reach(installed) == tuple(sorted(ends))


def test_rounded_parts_add_up():
    assert adding([58.37, 8.76, 11.67, 53.3]) == [58.0, 9.0, 12.0, 53.0]
    assert adding([-4.73, 0.38, 22.08, 0.0]) == [-4.0, 0.0, 22.0, 0.0]  # Not 1 for 0.38.
    assert adding([0.04, 0.04, 0.04], 1) == [0.1, 0.0, 0.0]


_SIZE = r"[+−]?\d[\d\u2009]*(?:\.\d+)?"
_WITHIN = re.compile(
    rf"({_SIZE}) ± ({_SIZE})(?: kW| %)?(?: more| less)?(?: vs\. [^:,]*)?(?: than [^,]*,|:| \() ?(sure|likely|unclear)"
)
_BETWEEN = re.compile(rf"({_SIZE}) %? ?\(({_SIZE})(?:…| to )({_SIZE})")
_COLOURED = ("gain", "loss", "good", "bad")


def parts_of(value: Any) -> Iterator[Any]:
    """Every part that the page draws, and every text in it."""
    yield value
    if is_dataclass(value) and not isinstance(value, type):
        value = [getattr(value, one.name) for one in fields(value)]
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list | tuple):
        for each in value:
            yield from parts_of(each)


def size(text: str) -> float:
    return float(text.replace("\u2009", "").replace("−", "-"))


def check_bands(shown: Mapping[str, Any], *, sourced: bool) -> tuple[int, int]:
    """Every value lies inside its band, has the word that its band gives, and no colour without sure or likely; how
    many values have a band to either side, and how many have two ends."""
    texts, ranges = set[tuple[str, str, str]](), set[tuple[str, str, str]]()
    for part in parts_of(shown):
        if isinstance(part, str):
            plain = re.sub(r"<[^>]*>", "", part)
            texts |= set(_WITHIN.findall(plain))
            ranges |= set(_BETWEEN.findall(plain))
        elif isinstance(part, PowerBar) and part.band:
            assert (part.kind != "") == ("(unclear)" not in part.title), part
        elif getattr(part, "kind", "") in _COLOURED and not isinstance(part, LinePiece):
            words = " ".join(one for one in parts_of(part) if isinstance(one, str))
            assert "unclear" not in words, words
            between = [(size(low), size(high)) for _, low, high in _BETWEEN.findall(words)]
            assert re.search(r"sure|likely|^drive", words) or any(
                low * high > 0.0 for low, high in between
            ), words
    for value, band, word in texts:
        assert sureness(size(value), size(band), sourced=sourced) == word
    for value, low, high in ranges:
        assert size(low) <= size(value) <= size(high), (value, low, high)
    line = shown.get("line")
    pieces = {piece.part: piece for piece in line.pieces} if line is not None else {}
    sure = pieces["sure"].text.removeprefix(", ") if "sure" in pieces else ""
    word, _, reason = sure.partition(", ")
    assert reason in ("", ESTIMATED)
    texts |= {(pieces["moved"].text, pieces["sure-band"].text[3:], word)} if word else set()
    if "moved" in pieces:
        assert (pieces["moved"].kind != "") == (word in ("sure", "likely"))
    if word:
        assert (
            sureness(
                size(pieces["moved"].text), size(pieces["sure-band"].text[3:]), sourced=sourced
            )
            == word
        )
    return len(texts), len(ranges)


@pytest.mark.parametrize(
    ("id", "state"), [("MFC_P1", "schedule"), ("AFC", "set"), ("SMA_tube", "stopped")]
)
def test_every_value_of_actuate_lies_inside_its_band_and_has_its_word_and_colour(
    id: str, state: ActuatorState
):
    waves = read_harmonics("3:0.5:60", "test") if id == "AFC" else ()
    now = answered("same-blade", DRIVEN, state, id, replace(INPUTS, twist_per_rev=waves))
    now = replace(now, hand=replace(now.hand, on_stage=True))
    found = [
        check_bands(
            {name: part for panel in PANELS for name, part in panel.view(now).items()},
            sourced=False,
        )
    ]
    found.append(
        check_bands(
            PAY.view(done(now, PAY.presses["suppose"](now, SupposePress(3.0, 20.0)))), sourced=False
        )
    )
    assert found[0][0] >= 5
    assert found[1][0] >= 1


@pytest.mark.parametrize("bends", [False, True])
def test_every_value_of_explore_lies_inside_its_band_and_has_its_word_and_colour(bends: bool):
    inputs = replace(INPUTS, built_outer=-6.0, bending=bends)
    solution, built = (trimmed(one.design()) for one in (inputs, replace(inputs, built_outer=0.0)))
    now = PageState(
        inputs,
        None,
        SessionState(inputs, ViewState(), solution, built, None),
        ui=OpenPanels("explore"),
    )
    now = replace(now, sliders=inputs.design())
    for panel in (LINE, WORTH, VIBRATION) if bends else (LINE, WORTH):
        now = worked(panel, now)
    shown = {name: part for panel in PANELS for name, part in panel.view(now).items()}
    assert check_bands(shown, sourced=True)[0] >= 5
    parts = [part for part in shown["power"].parts if part.name in ("Induced", "Profile", "Tail")]
    assert len([part for part in parts if _WITHIN.search(part.title)]) == 3
    assert " ± " in shown["power"].why
    if bends:
        low, high = map(float, re.findall(r"[\d.]+", shown["vibration"].band))
        assert low <= float(shown["vibration"].index) <= high
        assert _BETWEEN.search(shown["vibration"].change)
