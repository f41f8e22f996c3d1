"""Net benefit: required and attainable twist, net saving, the sentence, and the command."""

import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.__main__ import main
from rotor.actuator.catalogue import actuators, engines_of, find_actuator
from rotor.actuator.installation import change_limit, with_actuator_mass
from rotor.actuator.optimum import (
    STATIONS,
    baseline,
    best_actuated,
    best_fixed,
    twisted,
    widest_changes,
)
from rotor.actuator.section import HostBlade, default_placement
from rotor.actuator.tables import verdict_table
from rotor.actuator.verdict import Verdict, judge, verdict_details, verdict_sentence
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.limits import Limits
from rotor.optimisation.mission import Mission, mission_at, standard_mission
from rotor.optimisation.search import Search, run_search
from rotor.trim.doubt import ESTIMATED, rounded_pair, sure_words, sureness
from rotor.trim.solve import solve

KEYS = [
    "status", "message", "actuator", "plies", "concept", "mission", "required_twist_deg", "attainable_twist_deg",
    "feasible",
    "voltages_v", "added_mass_kg", "torsion_frequency_per_rev", "against", "ideal_saving_w", "gross_saving_w",
    "stiffness_cost_w", "mass_cost_w", "drive_cost_w", "part_bands_w", "net_saving_w", "net_saving_band_w",
    "fuel_saving_kg_h", "fuel_band_kg_h", "limits", "caveats",
]  # fmt: skip

CONCEPTS = ["linear", pytest.param("two-segment", marks=pytest.mark.slow)]


@cache
def coarse() -> Design:
    design = make_design()
    return replace(design, models=replace(design.models, elements=16, azimuths=36))


@cache
def pair() -> Mission:
    """Two legs, as in table 5.2 of the thesis."""
    return mission_at(coarse(), (0.0, 0.3))


@cache
def verdict(
    id: str = "MFC_P1", concept: str = "linear", kind: str = "new", share: float = 0.5
) -> Verdict:
    host = HostBlade() if kind == "retrofit" else HostBlade("new", share)
    placement = default_placement(2)
    return judge(
        find_actuator(id), pair(), find_concept(concept), placement, host, against="best-fixed"
    )


@pytest.mark.slow
def test_baseline_against_the_optimiser():
    """Two codes for one optimum: the search of `optimise` finds no better linear twist at either condition."""
    base = baseline(pair(), find_concept("linear"))
    for design, best in zip(pair().designs(), base.best, strict=True):
        found = run_search(Search(design, find_concept("linear"), starts=2, band=False))
        assert_allclose(best.power, found.best.power, rtol=1e-5)


@pytest.mark.slow
def test_reached_against_brute_force():
    """Linear jig and one swing on a grid: no grid point is better, and the neighbours are hardly worse.

    The grid flies the blade of the verdict: half as stiff, and twisted by the plies as they twist it at rest.
    """
    judged = verdict()
    first, second = (judged.installed.on(design) for design in pair().designs())
    shapes = np.interp(STATIONS, judged.installed.r, judged.installed.shapes_in(first)[0])
    jig = judged.optimum.values[0]
    swing = judged.optimum.swings[1][0]
    least = math.inf
    for rate in jig + np.radians([-1.0, 0.0, 1.0]):
        law = find_concept("linear").twist([rate])
        for v in (0.0, swing - 0.1, swing, swing + 0.1):
            power = [
                solve(replace(first, twist=law)).power.total,
                solve(replace(second, twist=twisted(law, v * shapes))).power.total,
            ]
            least = min(least, float(np.mean(power)))
    assert_allclose(judged.optimum.power, least, rtol=2e-5)


@pytest.mark.slow
def test_more_attainable_twist_saves_more_power():
    linear = find_concept("linear")
    installed = verdict().installed
    powers = [
        best_actuated(pair(), linear, installed, scale=share).power
        for share in (0.0, 0.1, 0.3, 1.0)
    ]
    assert all(a >= b - 0.5 for a, b in pairwise(powers))
    softer = replace(pair(), design=installed.on(pair().design))
    assert_allclose(powers[0], best_fixed(softer, linear).power, rtol=1e-6)
    assert_allclose(powers[0], verdict().resting.power, rtol=1e-6)


@pytest.mark.slow
def test_a_softer_blade_costs_power_with_no_voltage():
    """Half the stiffness doubles the elastic 1/rev twist of flight at µ 0.3, which no fixed jig twist takes away."""
    judged = verdict()
    assert judged.stiffness_cost > 1000.0
    band = judged.band_of("stiffness")
    assert band is not None
    pair = rounded_pair(judged.stiffness_cost / 1e3, band / 1e3)
    size = f"{pair.change:.{pair.decimals}f}"
    assert f"the softer elastic blade costs {size} ± " in verdict_details(judged)
    wave = [
        trims[1].elastic for trims in (judged.baseline.fixed.solutions, judged.resting.solutions)
    ]
    assert 1.5 < wave[1].first_harmonic / wave[0].first_harmonic < 2.5


@pytest.mark.parametrize("kind", ["retrofit", "new"])
@pytest.mark.parametrize("concept", CONCEPTS)
def test_voltages_stay_in_range_and_make_the_change(kind: str, concept: str):
    judged = verdict(concept=concept, kind=kind)
    assert len(judged.voltages) == (1 if concept == "linear" else 2)
    for (a, b), change, twist in zip(
        judged.voltages, judged.attained_segments, judged.installed.segment_twists, strict=True
    ):
        assert min(a, b) >= -500.0 - 1e-6
        assert max(a, b) <= 1500.0 + 1e-6
        assert_allclose(abs(b - a) / 2000.0 * twist, abs(change), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(
    ("id", "kind"), [("MFC_P1", "new"), ("MFC_P1", "retrofit"), ("SMA_tube", "new")]
)
def test_gross_less_costs_is_net_against_either_blade(id: str, kind: str):
    """Each part from trims of its own; another blade to count from moves gross, ideal and net by the same amount."""
    host = HostBlade() if kind == "retrofit" else HostBlade("new", 0.5)
    found = [
        judge(
            find_actuator(id),
            pair(),
            find_concept("linear"),
            default_placement(2),
            host,
            against=against,
        )
        for against in ("best-fixed", "same-blade")
    ]
    for judged in found:
        net = judged.gross_saving - judged.stiffness_cost - judged.mass_cost - judged.drive_cost
        assert_allclose(judged.net_saving, net, atol=1e-6)
        assert_allclose(sum(part for _, part in judged.savings), net, atol=1e-6)
        assert judged.gross_saving <= judged.ideal_saving
        driven = [
            with_actuator_mass(flown.design, judged.installed) for flown in judged.optimum.solutions
        ]
        power = np.mean([solve(design).power.total for design in driven]) + judged.drive.hold_power
        assert_allclose(judged.net_power, power, rtol=1e-6)
    built = np.mean([solve(design).power.total for design in pair().designs()])
    if kind == "retrofit":
        assert_allclose(found[0].bare_power, built, rtol=1e-9)
    fixed = np.mean(
        [
            solve(replace(d, twist=found[0].baseline.fixed_twist)).power.total
            for d in pair().designs()
        ]
    )
    for name in ("gross_saving", "ideal_saving", "net_saving"):
        best, same = (getattr(judged, name) for judged in found)
        assert_allclose(same - best, built - fixed, atol=0.5)


def test_fuel_by_hand():
    """From a table of NASA TM-100991: T700 flows of 349.3, 476.3 and 775 lb/h at 552.6, 911.1 and 1683 hp."""
    judged = verdict()
    engines = engines_of(pair().design.aircraft)
    horse, pound = 745.699872, 0.45359237
    assert_allclose(3600.0 * engines.flow(2.0 * 552.6 * horse), 2.0 * 349.3 * pound, rtol=1e-9)
    assert all(
        2.0 * 552.6 * horse < power < 2.0 * 1683.0 * horse for power in judged.reference_powers
    )
    slopes = [127.0 / 358.5 * pound / horse, 298.7 / 771.9 * pound / horse]
    assert judged.fuel_saving is not None
    assert slopes[0] < 3600.0 * judged.fuel_saving / judged.net_saving < slopes[1] * 1.000001
    used, band, word = re.findall(
        r"Net fuel: \w+ ([\d.]+) ± ([\d.]+) kg/h: (\w+)", verdict_details(judged)
    )[0]
    step = 10.0 ** -len(used.partition(".")[2])
    assert float(used) == pytest.approx(abs(3600.0 * judged.fuel_saving), abs=step)
    assert word == sureness(float(used), float(band), sourced=False) == "likely"


def test_a_class_of_engines_against_one_of_them():
    """The class above 1000 hp of one source is within 15 % of the T700 of another."""
    for power in 2.0 * 745.699872 * np.array([900.0, 1300.0, 1683.0]):
        engines = [engines_of(make_design(rotor=key).aircraft) for key in ("uh60a", "s61")]
        t700, many = (one.flow(power) for one in engines if one is not None)
        assert_allclose(many, t700, rtol=0.15)


def test_required_twist_by_hand():
    """Linear optima of two rates: their difference over the blade from the cut-out to the tip."""
    judged = verdict()
    (first,), (second,) = (best.values for best in judged.baseline.best)
    root = pair().design.rotor.blade.root_cutout
    assert_allclose(judged.required, abs(second - first) * (1.0 - root), rtol=1e-9)
    assert judged.feasible == (judged.required <= judged.attainable)
    assert (
        f" the {math.degrees(judged.required):.1f}° needed between hover and µ 0.30 ("
        in verdict_details(judged)
    )


@pytest.mark.parametrize("kind", ["retrofit", "new"])
def test_no_two_legs_are_farther_apart_than_the_range(kind: str):
    """Over four legs, where the optima lie farther apart than a weak ply moves; its voltages are within their range."""
    host = HostBlade() if kind == "retrofit" else HostBlade("new", 1.0)
    four = standard_mission(coarse())
    ply = find_actuator("MFC_P1")
    judged = judge(ply, four, find_concept("linear"), default_placement(1), host)
    swings = np.array(judged.optimum.swings)[:, 0]
    assert judged.required > 2.0 * judged.attainable
    assert np.ptp(swings) == pytest.approx(1.0 if kind == "new" else np.ptp(swings), abs=1e-6)
    assert np.ptp(swings) <= 1.0 + 1e-6
    assert len(judged.voltages[0]) == len(four.legs)
    assert min(judged.voltages[0]) >= -500.0 - 1e-3
    assert max(judged.voltages[0]) <= 1500.0 + 1e-3
    powers = [solve(flown.design).power.total for flown in judged.optimum.solutions]
    assert_allclose(judged.optimum.power, four.mean(powers), rtol=1e-6)
    assert judged.gross_saving <= judged.ideal_saving


def test_the_widest_change_is_from_the_earlier_to_the_later_leg():
    values = np.array([[0.0, 3.0], [2.0, -1.0], [-1.0, 2.0]])
    assert_allclose(widest_changes(values), [-3.0, -4.0])
    assert_allclose(widest_changes(values[:2]), values[1] - values[0])


def without_band(sentence: str) -> str:
    """A sentence of a verdict without how sure its saving is."""
    said, count = re.subn(
        rf" \(± [0-9.]+ kW: (sure|likely|likely, {ESTIMATED}|unclear)\)", "", sentence
    )
    assert count == 1
    return said


@pytest.mark.parametrize(
    ("choice", "ending", "details"),
    [
        ({"kind": "retrofit"}, "this ply does not pay.", ["(2 plies, retrofit) cannot supply", "temperature"]),
        ({"share": 0.3}, "this ply does not pay.", ["can supply"]),  # A softer blade: optima lie 4.6° apart.
        ({"id": "extension_twist"}, "this laminate does not pay.", ["rotor-speed"]),
        ({"id": "SMA_tube"}, "this tube does not pay.", ["(2 tubes, new blade"]),
        pytest.param({"id": "SMA_tube", "concept": "two-segment"}, "this tube does not pay.",
                     ["(2 tubes a segment, new blade"], marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_the_sentence_agrees_with_the_numbers(
    choice: dict[str, Any], ending: str, details: list[str]
):
    judged = verdict(**choice)
    assert not judged.pays
    assert without_band(verdict_sentence(judged)).endswith(ending)
    assert all(words in verdict_details(judged) for words in details)


def test_the_sentence_is_one_line_of_numbers_that_add_up():
    judged = verdict()
    said = without_band(verdict_sentence(judged))
    gains, costs = (float(number) for number in re.findall(r"([0-9.]+) kW", said))
    assert (
        said
        == f"Saves {gains} kW over the best fixed blade and costs {costs} kW, so this ply does not pay."
    )
    assert_allclose(1e3 * (gains - costs), judged.net_saving, atol=101.0)
    assert judged.net_band is not None
    band = rounded_pair(judged.net_saving / 1e3, judged.net_band / 1e3)
    word = sure_words(judged.net_saving, judged.net_band, sourced=False)
    assert f"(± {band.band:.{band.decimals}f} kW: {word})" in verdict_sentence(judged)
    buildable = tuple(replace(limit, ok=True) for limit in judged.limits)
    first, second = judged.loaded_powers
    more = judged.net_power + 2500.0 - judged.reference_power
    good = replace(
        judged, reference_powers=tuple(x + more for x in judged.reference_powers), limits=buildable
    )
    pair = rounded_pair(good.net_saving / 1e3, judged.net_band / 1e3)
    assert without_band(verdict_sentence(good)).endswith(
        f" kW, a net saving of {pair.change:.{pair.decimals}f} kW."
    )
    stopped = tuple(replace(limit, ok=limit.name != "temperature") for limit in judged.limits)
    assert verdict_sentence(replace(good, limits=stopped)).endswith(
        "but it cannot be built (temperature)."
    )
    even = replace(good, loaded_powers=(first + 2500.0, second + 2500.0))
    assert without_band(verdict_sentence(even)).endswith("this ply does not pay.")


def test_limit_for_the_optimiser():
    """The optimiser's change limit from the actuator: from a blade with too much twist the full change is used."""
    judged = verdict()
    design = pair().designs()[1]
    reference = find_concept("linear").twist([math.radians(-20.0)])
    limit = change_limit(judged.installed, reference)
    found = run_search(
        Search(design, find_concept("linear"), limits=Limits(change=limit), starts=1, band=False)
    )
    root = design.rotor.blade.root_cutout
    law = find_concept("linear").twist(found.best.parameters)
    change = float(np.diff(law([root, 1.0]) - reference([root, 1.0]))[0])
    assert_allclose(change, judged.attainable, rtol=1e-4)


@pytest.mark.parametrize("rotor", ["uh60a", "bo105"])
def test_each_leg_has_the_optimum_of_a_search_over_the_whole_range(rotor: str):
    """The Bo 105 has two valleys in cruise, which differ by 0.01 % of power and by 11°/R inboard."""
    design = make_design(rotor=rotor, inflow="drees", elements=16, azimuths=36)
    base = baseline(standard_mission(design), find_concept("three-segment"))
    for flown, found in zip(base.mission.designs(), base.best, strict=True):
        whole = solve(run_search(Search(flown, base.concept, band=False)).design)
        assert found.power <= whole.power.total * (1.0 + 1e-6)


# Pictures and tables


def test_table_of_verdicts():
    table = verdict_table([verdict(), verdict(kind="retrofit")])
    assert all(len(row) == len(table.columns) for row in table.rows)
    names = ("ideal", "gross", "stiffness", "mass", "drive", "net")
    columns = [table.columns.index(f"{name} kW") for name in names]
    for row in table.rows:
        cells = [row[k].partition(" ± ")[0] for k in columns]
        ideal, *parts, net = map(float, cells)
        assert [" ± " in row[k] for k in columns] == [
            name != "drive" and float(row[k].split()[0]) != 0.0
            for name, k in zip(names, columns, strict=True)
        ]
        assert ideal >= parts[0]  # Free twist saves most, against the same blade.
        steps = [10.0 ** -len(cell.partition(".")[2]) for cell in cells[1:]]
        assert_allclose(sum(parts), net, atol=0.5 * sum(steps) + 0.01)


# Command


@pytest.mark.slow
def test_command_json(answer: Callable[..., Any]):
    found = answer("actuator", "--actuator", "AFC", "--plies", "1")
    assert (list(found), found["actuator"]) == (KEYS, "AFC")
    assert [leg["name"] for leg in found["mission"]["legs"]] == ["hover", "climb", "cruise", "fast"]
    assert found["mission"]["assumed"]
    assert any("from memory" in caveat for caveat in found["caveats"])
    assert found["net_saving_w"] < found["gross_saving_w"]


def test_options_of_the_two_legs_of_before_are_read_with_a_warning(
    capsys: pytest.CaptureFixture[str],
):
    flags = "--json --actuator AFC --inflow uniform --elements 12 --azimuths 24 --to-mu 0.25"
    assert main(["actuator", *flags.split()]) == 0
    out, err = capsys.readouterr()
    legs = json.loads(out)["mission"]["legs"]
    assert [(leg["mu"], leg["hours"]) for leg in legs] == [(0.0, 0.5), (0.25, 0.5)]
    assert "--from-mu, --to-mu and --share end with the next release: use --mission" in err


def test_table_5_1_as_text_and_json(printed: Callable[..., str], answer: Callable[..., Any]):
    assert "MFC_P1" in printed("actuator", "--table", "5.1")
    table = answer("actuator", "--table", "5.1")
    assert list(table) == ["title", "columns", "rows", "notes"]
    assert [row[0] for row in table["rows"]] == list(actuators())


def test_exit_code_is_1_if_nothing_trims(capsys: pytest.CaptureFixture[str]):
    assert main(["actuator", "--json", "--mass-kg", "20000", "--altitude-m", "4000"]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert list(answer) == KEYS
    assert answer["status"] == "not-converged"
    assert answer["net_saving_w"] is None


def test_the_attainable_twist_can_be_solved_as_a_design():
    """The SPEC of an attainable twist is read again, and on the actuated blade it gives the same power."""
    solution = verdict().optimum.solutions[1]
    spec = solution.design.twist.spec()
    again = make_design(twist=spec, mu=0.3, models=solution.design.models)
    again = replace(again, rotor=solution.design.rotor)
    assert_allclose(solve(again).power.total, solution.power.total, rtol=1e-7)
