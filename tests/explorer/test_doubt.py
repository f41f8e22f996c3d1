"""How sure power is, as the page and the report say it."""

import math
import re
from dataclasses import replace

import pytest

from explorer.charts.doubt import MOST_ROWS, doubt_rows, twist_ranges
from explorer.model.inputs import OPENING, with_rotor
from explorer.model.stand import condition_of
from explorer.model.units import AVIATION, SI, UNITS, Units, units_of
from explorer.text.line import plain, power_pieces
from explorer.text.status import status_panel, validated
from rotor import doubt, solve
from rotor.files.rotor_file import shipped_aircraft
from rotor.optimisation.results import BestTwist, TwistRange
from rotor.trim.doubt import Doubt, DoubtRow, OtherModels

FC1 = replace(with_rotor(OPENING, "gazelle"), **condition_of("gazelle", "FC1").inputs)
ROWS = tuple(
    DoubtRow(f"row {k}", f"input {k}", 5.0, "a report", 1e3 * (8 - k), 1e2 * (8 - k))
    for k in range(8)
)


@pytest.mark.parametrize("against", [None, 905e3])
def test_rows_are_the_largest_and_name_their_source(against: float | None):
    html = doubt_rows(Doubt(900e3, ROWS, against))
    assert html.count("<tr") == MOST_ROWS
    assert "input 0, 5 %: a report" not in html  # No name ends in _percent.
    assert "input 0, 5: a report" in html
    assert html.count("width:100%") == 1


def test_what_is_nothing_but_rounding_is_no_row():
    rows = *ROWS[:2], DoubtRow("drag rise", "Mach number", 0.005, "a report", 1e-12, 1e-12)
    assert doubt_rows(Doubt(900e3, rows)).count("<tr") == 2


def test_other_models_stand_beside_the_rows():
    models = OtherModels("bending", 980e3, -20e3), OtherModels("inflow uniform", 900e3)
    html = doubt_rows(Doubt(990e3, ROWS, 1000e3), SI, models)
    assert "Other models: bending 980 kW, saves 2.00 ± 0.14 %: sure; inflow uniform 900 kW." in html
    assert " One lies outside the band." in html
    assert "outside" not in doubt_rows(Doubt(990e3, ROWS, 1000e3), SI, models[:1])
    assert "Other models" not in doubt_rows(Doubt(990e3, ROWS))


@pytest.mark.parametrize(
    "units", [*UNITS.values(), units_of("SI", shipped_aircraft("knight-hefner-3"))]
)
def test_the_drawer_of_trust_has_one_unit_of_power(units: Units):
    """That of the page, in the sentence, the rows, the other models, the caveats and what was measured."""
    heavy = with_rotor(replace(OPENING, advance_ratio=0.38), "uh60a")
    b, a = (solve(replace(heavy, mass_t=mass).design()).require() for mass in (9.5, 8.32))
    assert any("kW" in caveat.sentence for caveat in b.caveats)
    flown = solve(FC1.design()).require()
    assert "kW" in validated(flown).sentence
    models = (OtherModels("bending", 980e3, -20e3),)
    for solution, pinned in ((b, a), (a, None), (flown, None)):
        band = doubt(solution, pinned)
        line = plain(power_pieces(solution, units, band)) + "".join(
            piece.title or "" for piece in power_pieces(solution, units, band)
        )
        html = status_panel(solution, pinned=pinned, units=units) + doubt_rows(band, units, models)
        text = html.replace("<i>W</i>", "weight") + line
        assert set(re.findall(r"(?<=\d )(?:kW|W|hp)\b", text)) == {units.power[0].symbol}


def test_powers_of_a_sentence_keep_their_decimals():
    assert AVIATION.in_power_unit("The engines give 2300 kW, 1.5 kW and 373 W.") == (
        "The engines give 3\u2009084 hp, 2.0 hp and 1 hp."
    )
    assert SI.in_power_unit("Within 12 % of 900 kW.") == "Within 12 % of 900 kW."


def test_ranges_of_the_best_twist_are_bars_on_one_scale():
    ranges = (
        TwistRange("flat", (math.radians(-12.0), math.radians(-10.0))),
        TwistRange("mass", (math.radians(-10.0), math.radians(-14.0)), (6658.0, 9987.0)),
        TwistRange("drag area", (math.radians(-7.0), math.radians(-13.0)), (0.0, 4.08)),
        TwistRange("wake", (math.radians(-11.0), math.radians(-15.0))),
    )
    best = BestTwist(math.radians(-11.0), ranges)
    html = twist_ranges(best)
    assert "−11.0 °/R" in html
    assert html.count("width:25%") == 1  # −12 to −10 between −15 and −7.
    assert html.count("left:50%") == 4  # −11.
    for words in (
        "mass 6.7 … 10.0 t",
        "drag area 0.0 … 4.1 m²",
        "−7.0 … −13.0",
        "annuli … lifting line",
    ):
        assert words in html
    assert "mass 14\u2009678 … 22\u2009018 lb" in twist_ranges(best, AVIATION)
