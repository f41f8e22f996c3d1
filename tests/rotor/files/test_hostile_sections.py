"""Every polar and deck a user can bring is flown or refused in one sentence."""

import random
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from test_rotor_file import GOOD, polar_file

from rotor.airfoil.c81 import format_c81, parse_c81
from rotor.airfoil.polars import Polar, parse_polar_file, read_polars
from rotor.airfoil.sections import load_section
from rotor.assets import asset_path
from rotor.design.aircraft import Aircraft
from rotor.files.make_design import make_design
from rotor.files.rotor_file import read_aircraft
from rotor.trim.solve import solve

POLAR = read_polars(asset_path("airfoils/naca0012_trip5.polars.csv")).polars[2]
DECK = asset_path("airfoils/naca0012.c81").read_text(encoding="utf-8")


def with_section(line: str, **files: str) -> Aircraft:
    text = GOOD.replace('"naca0012"', '"mine"', 1) + f'\n[sections.mine]\n{line}\noutline = "naca0012"\n'
    return read_aircraft("my.toml", {"my.toml": text, **files})


def with_polar(text: str) -> Aircraft:
    return with_section('polars = "a.txt"', **{"a.txt": text})


def with_deck(text: str) -> Aircraft:
    return with_section('deck = "a.c81"', **{"a.c81": text})


def changed(**values: object) -> str:
    """The polar with other values, as XFOIL writes it."""
    fields = {name: getattr(POLAR, name) for name in ("mach", "reynolds", "alpha_deg", "cl", "cd", "cm")}
    return polar_file(Polar(**{**fields, **values}))


def test_a_polar_at_mach_0_flies_as_one_at_low_mach():
    """XFOIL writes Mach 0.000 unless it is told otherwise. Prandtl–Glauert lift at Mach 0.3 is 4.8 % above it."""
    zero, low = (with_polar(changed(mach=mach)) for mach in (0.0, 0.3))
    assert any("incompressible" in remark for remark in zero.remarks)
    powers = [solve(make_design(rotor=craft, mu=mu)).power.total for craft in (zero, low) for mu in (0.0, 0.2)]
    assert_allclose(powers[:2], powers[2:], rtol=0.03)
    table = zero.rotor.blade.installed("mine").table
    assert_allclose(table.lift_slope(0.3) / table.lift_slope(0.0), 1.0 / np.sqrt(1.0 - 0.3**2), rtol=0.01)


@pytest.mark.parametrize("mach", [1e-6, 0.001, 0.05, 0.06, 0.1])
def test_friction_stays_positive_at_any_low_mach(mach: float):
    table = with_polar(changed(mach=mach)).rotor.blade.installed("mine").table
    assert np.all(table(np.zeros(20), np.linspace(0.0, 0.7, 20)).cd > 0.4 * POLAR.cd.min())


@pytest.mark.parametrize(
    "lift", [np.zeros_like(POLAR.cl), np.full_like(POLAR.cl, 0.5), -POLAR.cl, POLAR.cl + 3.0], ids=range(4)
)
def test_lift_that_does_not_rise_through_zero_is_refused(lift: np.ndarray):
    with pytest.raises(ValueError, match=r"lift|cl stays") as refusal:
        with_polar(changed(cl=lift))
    assert len(str(refusal.value)) < 300


def test_a_deck_without_lift_is_refused():
    deck = parse_c81(DECK)
    flat = replace(deck, title="FLAT", cl=replace(deck.cl, values=np.zeros_like(deck.cl.values)))
    with pytest.raises(ValueError, match="lift does not rise through zero"):
        with_deck(format_c81(flat))


@pytest.mark.parametrize("suffix", ["polar", "csv", "deck"])
def test_one_wrong_digit_is_flown_or_refused(suffix: str):
    """Any digit becomes any other character of a number: a sentence, or a section that trims or says why not."""
    random.seed(suffix)
    text = {
        "polar": polar_file(POLAR),
        "csv": "mach,reynolds,alpha_deg,cl,cd,cm\n"
        + "\n".join(
            f"0.3,3e6,{a:g},{cl:.4f},{cd:.5f},{cm:.4f}"
            for a, cl, cd, cm in zip(POLAR.alpha_deg, POLAR.cl, POLAR.cd, POLAR.cm, strict=True)
        ),
        "deck": DECK,
    }[suffix]
    places = [match.start() for match in re.finditer(r"\d", text)]
    flown, sentences = 0, list[str]()
    for _ in range(12):
        at = random.choice(places)
        wrong = text[:at] + random.choice("0123456789-. ") + text[at + 1 :]
        try:
            craft = with_deck(wrong) if suffix == "deck" else with_polar(wrong)
        except ValueError as refusal:
            sentences.append(str(refusal))
            continue
        for mu in (0.0, 0.2):
            solution = solve(make_design(rotor=craft, mu=mu))
            assert solution.message
            assert not solution.converged or np.isfinite(solution.power.total)
        flown += 1
    assert flown >= 3
    assert all(0 < len(sentence) < 400 for sentence in sentences)


@pytest.mark.parametrize(
    ("heading", "says"),
    [("Mach = 0.1.2", "keep the heading"), ("Mach =   1.300", "outside 0…1"), ("Mach = .", "keep the heading")],
)
def test_a_heading_with_a_wrong_digit_is_refused(heading: str, says: str):
    text = re.sub(r"Mach =\s+[0-9.]+", heading, polar_file(POLAR))
    with pytest.raises(ValueError, match=says):
        parse_polar_file("a.txt", text)


@pytest.mark.parametrize("name", ["sc1095", "sc1094r8", "naca0012", "naca63a015"])
def test_shipped_sections_pass_the_same_checks(name: str):
    assert np.all(load_section(name).lift_slope(np.linspace(0.0, 0.9, 10)) > 2.0)
