"""The address: random designs through it as viser's client rewrites it, links that cannot be read, and its writing."""

import json
import random
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any
from urllib.parse import parse_qsl, quote

import pytest

from explorer.model.inputs import LAWS, OPENING, TWISTS, Inputs, with_rotor
from explorer.model.sliders import SLIDERS
from explorer.model.stand import StandInputs
from explorer.sharing.share import (
    DESIGN,
    Address,
    code_of,
    design_from,
    inputs_from,
    parameter,
    with_parameter,
)
from rotor.design.active_twist import Harmonic, read_harmonics
from rotor.design.design import Design
from rotor.design.twist import SplineTwist, SumTwist, TableTwist, parse_twist
from rotor.files.design_file import design_from_record
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from tests.waited import until

KEPT_BY_BROWSERS = "!$%&'()*+,-./:;=?@[\\]^_`{|}~"
"""Characters of a query that the parser of addresses leaves as they are; a `#` would end the query."""


def rewritten(query: str) -> str:
    """The query as viser's client leaves it when it connects: names and values without their escapes, put together.

    `syncSearchParamServer` of viser/client/src/SearchParamsUtils.ts, and what `history.replaceState` makes of it.
    """
    pairs = parse_qsl(query.removeprefix("?"), keep_blank_values=True)
    bare = "&".join(f"{name}={value}" for name, value in pairs)
    return "?" + quote(bare.partition("#")[0], KEPT_BY_BROWSERS)


def random_inputs(chance: random.Random) -> Inputs:
    """Any design that the sliders, menus and design files can make."""

    def place(name: str) -> float:
        form = SLIDERS[name]
        return round(
            form.low + form.step * chance.randint(0, round((form.high - form.low) / form.step)), 4
        )

    inputs = Inputs(
        law=chance.choice(("builtin", *(law for law in LAWS if law != "optimised"))),
        **{name: place(name) for name in TWISTS},
        advance_ratio=chance.randint(0, 90) / 200.0,
        mass_t=chance.randint(100, 219) / 20.0, altitude_m=chance.randint(0, 80) * 50.0,
        climb_m_s=chance.choice((0.0, chance.randint(-200, 200) / 10.0)),
        inflow=chance.choice(("uniform", "drees", "pitt-peters-15pi/23", "local-momentum", "lifting-line")),
        hover_inflow=chance.choice(("annulus", "closed-form")), preset=chance.choice(("flight", "flight", "thesis")),
        tip_loss=chance.random() < 0.8, elastic_twist=chance.random() < 0.8, fuselage=chance.random() < 0.8,
        bending=chance.random() < 0.3,
        rotor_speed_percent=chance.choice((100.0, chance.randint(70, 110))),
        load_factor=chance.choice((1.0, chance.randint(10, 16) / 10.0)),
        unsteady=chance.random() < 0.8,
        dynamic_stall=chance.random() < 0.8,
        elements=chance.choice((None, None, 12, 48)),
        azimuths=chance.choice((None, None, 16, 48)),
    )  # fmt: skip
    if inputs.preset == "thesis":
        inputs = replace(inputs, climb_m_s=0.0)
    if inputs.law == "given":
        inputs = replace(inputs, given=_twist_from_a_file(chance))
    if chance.random() < 0.3:
        law, rotor = inputs.law, chance.choice((*SHIPPED_ROTORS[1:], *MEASURED_ROTORS))
        other = with_rotor(replace(inputs, preset="flight"), rotor)
        inputs = replace(other, law=law, given=inputs.given, built_inner=chance.choice((0.0, 3.0)))
        if inputs.aircraft.isolated:
            tilt = chance.choice((None, place("linear")))
            inputs = replace(
                inputs, stand=StandInputs("wind-tunnel", "ct_over_sigma", 0.06, tilt), climb_m_s=0.0
            )
    return replace(inputs, **_waves(chance)) if chance.random() < 0.3 else inputs


def _waves(chance: random.Random) -> dict[str, Any]:
    """n/rev pitch and twist as the page's sliders and design files give them."""

    def waves(lowest: int) -> tuple[Harmonic, ...]:
        text = ",".join(
            f"{n}:{chance.randint(1, 200) / 20:g}:{chance.randint(0, 71) * 5}"
            for n in range(lowest, 9)
            if chance.random() < 0.3
        )
        return read_harmonics(text, "test")

    twist = waves(1)
    shape = chance.choice((None, ((0.3, 0.9), (0.0, 1.0)))) if twist else None
    return {"pitch_per_rev": waves(2), "twist_per_rev": twist, "active_shape": shape}


def _twist_from_a_file(chance: random.Random) -> SplineTwist | TableTwist | SumTwist:
    angles = tuple(chance.uniform(-0.2, 0.2) for _ in range(4))
    stations = (0.13, 0.4, 0.75, 1.0)
    several = parse_twist(
        f"linear:{chance.randint(-9, 9)}+segments:-2,{chance.randint(-9, 9)}@0.5+quadratic:6,-14"
    )
    assert isinstance(several, SumTwist)
    return chance.choice(
        (SplineTwist(stations, angles), TableTwist(stations, angles, "table:mine.txt"), several)
    )


def random_designs(count: int) -> Iterator[Design]:
    chance = random.Random(20)
    while count:
        try:
            design = random_inputs(chance).design()
        except ValueError:
            continue  # A combination that the page refuses with a sentence.
        count -= 1
        yield design


def test_a_thousand_random_designs_come_back_from_a_file_and_an_address_that_the_client_has_rewritten():
    sums = 0
    for design in random_designs(1000):
        code = code_of(design)
        assert "mine.txt" not in code  # A table travels with its numbers.
        sums += isinstance(design.twist, SumTwist)
        query = with_parameter("?fixedDpr=0.5", DESIGN, code)
        for _ in range(3):  # It rewrites it at each connection, and the page may lose its server.
            query = rewritten(query)
            assert parameter(query, DESIGN) == code
        shown = inputs_from(code)
        assert shown.design().pitch_waves == design.pitch_waves
        assert code_of(shown.design()) == code
        file = design_from_record(json.loads(json.dumps(design.to_dict())))
        for again in (design_from(parameter(query, DESIGN) or ""), file):
            assert code_of(again) == code
            assert (again.models, again.rotor, again.preset) == (
                design.models,
                design.rotor,
                design.preset,
            )
            assert (again.active_twist, again.pitch_per_rev) == (
                design.active_twist,
                design.pitch_per_rev,
            )
            assert again.condition.advance_ratio == pytest.approx(
                design.condition.advance_ratio, rel=1e-9
            )
            assert again.condition.mass == pytest.approx(design.condition.mass, rel=1e-9)
            assert again.condition.rotor_speed_percent == design.condition.rotor_speed_percent
            assert again.condition.load_factor == pytest.approx(
                design.condition.load_factor, rel=1e-9
            )
            r = (0.2, 0.33, 0.5, 0.75, 0.9, 1.0)
            # To a millionth of a degree.
            assert again.twist(r) == pytest.approx(design.twist(r), abs=1e-7)
    assert sums > 200
    chance = random.Random(20)
    assert {random_inputs(chance).law for _ in range(200)} == set(LAWS) - {"optimised"}


def test_the_changed_twist_as_built_is_again_on_its_sliders():
    inputs = replace(
        OPENING, built_inner=-2.0, built_outer=1.5, built_division=0.6, advance_ratio=0.25
    )
    code = code_of(inputs.design())
    assert code == "1;uh60a~segments:-2,1.5@0.6;mu=0.25"
    assert inputs_from(code) == inputs


class TestUnreadable:
    def opened(self, query: str) -> tuple[Address, list[str]]:
        written: list[str] = []
        address = Address(query, written.append, pause=0.0)
        assert address.read(DESIGN, inputs_from, OPENING, "Link: design not used") == OPENING
        return address, written

    def test_it_is_said_and_stays_in_the_address_until_the_design_changes(self):
        address, written = self.opened("?d=1;bent:3;mu=0.3&v=1;field=mach")
        assert [title for title, _ in address.problems] == ["Link: design not used"]
        assert "'bent:3' is not known" in address.problems[0][1]
        opening = code_of(OPENING.design())
        for _ in range(3):
            address[DESIGN] = opening
        assert written == []
        address["v"] = None  # Another part of the address: that one could be read.
        assert written == ["?d=1;bent:3;mu=0.3"]
        changed = code_of(replace(OPENING, mass_t=9.0).design())
        address[DESIGN] = changed
        address[DESIGN] = opening
        assert written[1:] == [f"?d={changed}", f"?d={opening}"]

    def test_a_copied_link_holds_what_is_shown(self):
        address, _ = self.opened("?d=1;bent:3")
        opening = code_of(OPENING.design())
        address[DESIGN] = opening
        address.write_over()
        address[DESIGN] = opening
        assert address.query == f"?d={opening}"

    def test_an_address_that_is_not_known_is_not_written(self):
        written: list[str] = []
        address = Address(None, written.append, pause=0.0)
        address[DESIGN] = "1;linear:-8"
        assert (address[DESIGN], written) == ("1;linear:-8", [])


class TestAddress:
    def test_names_stand_beside_each_other_and_hold_any_text(self):
        query = with_parameter("?fixedDpr=0.5&darkMode&d=1;old", "d", "1;segments:-14,-8@0.5")
        assert query == "?fixedDpr=0.5&darkMode=&d=1;segments:-14,-8@0.5"
        assert parameter(query, "d") == "1;segments:-14,-8@0.5"
        assert parameter(with_parameter(query, "d", None), "d") is None
        text = '1;uh60a+linear:-2;name="a&b=c d"'
        query = with_parameter("", "d", text)
        assert "+" not in query
        assert parameter(query, "d") == text

    def test_written_when_it_changes(self):
        written: list[str] = []
        address = Address("?a=1", written.append, pause=0.0)
        address["b"] = "2"
        address["b"] = "2"
        address["a"] = None
        assert written == ["?a=1&b=2", "?b=2"]

    def test_a_flood_ends_with_the_newest(self):
        """Fifty changes in a moment; on a machine that halts in their midst, at the next try."""
        for pause in (0.1, 1.0, 10.0, 60.0):
            written: list[str] = []
            address = Address("", written.append, pause)
            begun = time.monotonic()
            for k in range(50):
                address["d"] = str(k)
            if time.monotonic() - begun < pause:
                break
        until(lambda: written[-1] == "?d=49")
        assert written == ["?d=0", "?d=49"]
