"""One value of the actuator as set: every number on the screen of Actuate, by its quantity, is the same."""

import math
import re
from collections import defaultdict
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from explorer.export.figures import actuator_section
from explorer.model.actuator_inputs import AGAINST, MOST_SEGMENTS, ActuatorInputs
from explorer.model.inputs import Inputs
from explorer.model.units import SI, adding
from explorer.parts.actuate import AssessedPart
from explorer.picture.lifted_picture import lifted_picture
from explorer.views.actuated import ActuatedBlade, actuated_blade
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD, choose
from explorer.views.dial import DIAL
from explorer.views.flight import FLIGHT
from explorer.views.page_state import PageState, SetHand
from explorer.workers.call import Call
from rotor.actuator import with_actuator_mass
from rotor.actuator.verdict import Against, Verdict
from rotor.files.make_design import make_design
from rotor.trim.solve import solve
from tests.actuate import actuate, asked, done, told

INPUTS = Inputs(law="builtin", advance_ratio=0.2, inflow="drees")
DRIVEN = (77.0,) * MOST_SEGMENTS
NUMBER = r"[+−]?\d+(?:\.\d+)?"


@cache
def run(call: Call) -> Any:
    return call.run()


def answered(against: Against, drives: tuple[float, ...]) -> PageState:
    """The page once all that the value waits for is known."""
    now = actuate(INPUTS, actuator=ActuatorInputs(against=against, drives=drives))
    for panel, name in (
        (ACTUATOR, "lean_verdict"),
        (ACTUATOR, "flight_of"),
        (DIAL, "effect"),
        (ACTUATOR_CARD, "other_stroke"),
    ):
        now = told(panel, now, **{name: run(asked(panel, now)[name])})
    return now


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
    flown = replace(now, hand=done(now, FLIGHT.presses["balance"](now, "here")).hand)
    assert FLIGHT.view(flown)["earns"].kind == "computing"
    flown = told(FLIGHT, flown, powers=run(asked(FLIGHT, flown)["powers"]))
    part = FLIGHT.view(flown)["earns"]
    assert (part.kind, part.here, part.where) == ("ready", True, "at 159 km/h")
    return {bar.name: bar.text for bar in part.bars}


def screen(now: PageState) -> dict[str, list[str]]:
    """Every number of all panels of Actuate, by its quantity."""
    found: dict[str, list[str]] = defaultdict(list)

    def read(quantity: str, pattern: str, text: str) -> None:
        matches = re.findall(pattern.replace("#", f"({NUMBER})"), text)
        assert matches, (quantity, pattern, text)
        found[quantity] += [one if isinstance(one, str) else "…".join(one) for one in matches]

    (value, verdict), part, flight, rail = known(now), card(now), FLIGHT.view(now), ACTUATOR.view(now)
    words = " ".join(text for _, text, _ in lifted_picture(now.hand.actuator, value.installed, value.design).labels)
    report = re.sub(r"<[^>]*>", " ", actuator_section(verdict, SI))
    settled, (total,) = DIAL.view(now)["dial"].settled, [bar.text for bar in flight["earns"].bars if bar.total]
    ends = "…".join(f"{math.degrees(end):+.2f}" for end in value.inputs.reach(value.installed)).replace("-", "−")

    found["mass"] = [part.mass.removesuffix(" kg"), f"{sum(float(mass) for _, mass in part.masses):.0f}"]
    found["mass"].append(f"{sum(float(mass) for mass in re.findall(rf'({NUMBER}) kg of', words)):.0f}")
    read("mass", "# kg:", rail["actuator.numbers"])
    read("mass", "for # kg", part.sentence)
    read("mass", "# kg:", report)
    found["tip"] = [part.tip, flight["flight"].tip]
    read("tip", "actuator-twist[^>]*>([^<]*)<", rail["actuator.now"])
    if now.hand.actuator.driven:
        read("tip", f"({NUMBER}°) at the tip", words)
    found["reach"] = [part.reach, f"{ends}°"]
    read("reach", f"by ({NUMBER}…{NUMBER}°) in flight", part.sentence)
    read("power here", "(?:needs|saves) # ±", part.here)
    read("power here", "(?:needs|saves) # ± .* here", part.sentence)
    found["power here"].append(f"{abs(settled.power[0]):.{'0' if abs(settled.power[0]) >= 10.0 else '1'}f}")
    read("power over the flight", "(?:needs|saves) # ±", part.flight)
    read("power over the flight", "here, (?:needs |saves )?# ±", part.sentence)
    read("power over the flight", "(?:needs|saves) # ±", report)
    found["power over the flight"] += [total.lstrip("+−")]
    found["power here"].append(balance_here(now)["total"].lstrip("+−"))
    read("vibration", "vibration # ±", part.vibration)
    found["vibration"].append(f"{settled.index[0]:+.0f}".replace("-", "−"))
    return found


@pytest.mark.parametrize("against", AGAINST)
@pytest.mark.parametrize("drives", [(0.0,) * MOST_SEGMENTS, DRIVEN])
def test_every_number_on_the_screen_is_the_same_number(against: Against, drives: tuple[float, ...]):
    now = answered(against, drives)
    found = screen(now)
    assert {name: set(values) for name, values in found.items() if len(set(values)) > 1} == {}
    assert len(found) == 6
    parts = balance_here(now)
    *each, total = (float(text.replace("−", "-")) for text in parts.values())
    assert sum(each) == pytest.approx(total, abs=1e-9)  # What is written adds up.
    if against == "same-blade" and not any(drives):
        assert float(parts["its twist"]) == 0.0
    title = dict(card(now).baselines)[against]
    assert DIAL.view(now)["dial"].against == f"the {title}"
    assert (" at 77 % of its voltage" in card(now).title) == any(drives)


def test_the_switch_moves_every_change_by_what_lies_between_the_blades():
    """At no voltage, and against the same blade, only mass and stiffness change power and vibration."""
    same = answered("same-blade", (0.0,) * MOST_SEGMENTS)
    (one, verdict), (other, counted) = (known(answered(against, (0.0,) * MOST_SEGMENTS)) for against in AGAINST)
    assert one.here and other.here and one.over_flight and other.over_flight and one.line  # noqa: PT018
    bare = replace(one.design, models=replace(one.design.models, bending=True))
    loaded = with_actuator_mass(bare, one.installed)
    assert one.here.power == pytest.approx(solve(loaded).power.total - solve(bare).power.total, rel=0.03)
    assert abs(one.vibration.index[0]) < 0.5 * abs(other.vibration.index[0])
    assert other.here.power > one.here.power + 1e3
    between = verdict.bare_power - counted.reference_power
    assert other.over_flight.power - one.over_flight.power == pytest.approx(between, abs=1.0)
    assert one.line.net(one.range, one.mass) == pytest.approx(-one.over_flight.power, abs=1.0)
    assert choose(same, "best-fixed") == (SetHand(actuator={"against": "best-fixed"}),)


def test_full_voltage_is_the_reach_and_trims_make_that_twist():
    """Elastic trims with and without voltage: mean over azimuth, tip less root."""
    design = make_design(preset="flight", mu=0.2)
    ends = []
    for end in (-100.0, 100.0):
        inputs = ActuatorInputs(drives=(end,) * MOST_SEGMENTS)
        installed = inputs.installed(design.rotor)
        tips = []
        for flown in (inputs.apply(design), installed.on(design)):
            trim = solve(flown)
            twist = trim.disk.elastic_twist.mean(axis=1) + trim.design.twist(trim.disk.r)
            tips.append(float(np.interp(1.0, trim.disk.r, twist) - twist[0]))
        ends.append(inputs.tip(installed))
        assert tips[0] - tips[1] == pytest.approx(ends[-1], rel=0.02)
    assert replace(ActuatorInputs(), drives=DRIVEN).reach(installed) == tuple(sorted(ends))


def test_rounded_parts_add_up():
    assert adding([58.37, 8.76, 11.67, 53.3]) == [58.0, 9.0, 12.0, 53.0]
    assert adding([-4.73, 0.38, 22.08, 0.0]) == [-5.0, 1.0, 22.0, 0.0]
    assert adding([0.04, 0.04, 0.04], 1) == [0.1, 0.0, 0.0]
