"""The distance of two blades, and what it adds to the band of a difference in hover."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import rotor
from rotor.design.design import Design
from rotor.support.assets import toml_asset
from rotor.trim.blade_distance import blade_distance, twist_difference
from rotor.trim.doubt import HOVER_BLADE, Doubt, doubt, other_models
from rotor.trim.low_speed import hover_share
from rotor.trim.power_changes import PARTS
from tests.uncertain import SIZES


def hovering(twist: str, **options: Any) -> Design:
    return rotor.make_design(hover=True, twist=twist, **options)


@pytest.mark.parametrize(
    ("twist", "distance"),
    [
        ("linear:-8", 0.0),
        ("linear:-8.1", 0.1 / 12.0),
        ("linear:-12", 1.0 / 3.0),
        ("linear:-4", 1.0 / 3.0),
        ("linear:-20", 1.0),
        ("linear:-24", 1.0),
    ],
)
def test_linear_twists_lie_apart_by_their_rates_over_12_degrees(twist: str, distance: float):
    assert blade_distance(hovering(twist), hovering("linear:-8")) == pytest.approx(distance)


def test_a_ring_counts_by_its_radius_and_the_collective_does_not():
    """By integrals over the disk, of a twist that bends."""
    bent = hovering("quadratic:8,-14")
    plain = hovering("linear:-8")
    root = bent.rotor.blade.root_cutout

    def mean(of: Any) -> float:
        """Over the disk."""
        return quad(lambda r: of(r) * r, root, 1.0)[0] / quad(lambda r: r, root, 1.0)[0]

    def spread(of: Any) -> float:
        centre = mean(of)
        return math.sqrt(mean(lambda r: (of(r) - centre) ** 2))

    exact = spread(lambda r: float(bent.twist(r) - plain.twist(r)))
    far = spread(lambda r: math.radians(12.0) * r)
    assert blade_distance(bent, plain) == pytest.approx(exact / far, rel=2e-3)
    assert np.linalg.norm(twist_difference(bent, plain)) == pytest.approx(exact / far, rel=2e-3)


def other_blades(design: Design) -> dict[str, Design]:
    """The design with another number, radius, chord or section of its blades."""
    one, blade = design.rotor, design.rotor.blade
    spans = tuple(replace(span, section="sc1095") for span in blade.spans)
    rotors = {
        "blades": replace(one, blades=one.blades + 1),
        "radius": replace(one, radius=1.01 * one.radius),
        "chord": replace(one, blade=replace(blade, chords=tuple(1.1 * x for x in blade.chords))),
        "sections": replace(one, blade=replace(blade, spans=spans)),
    }
    return {name: replace(design, rotor=each) for name, each in rotors.items()}


@pytest.mark.parametrize("what", ["blades", "radius", "chord", "sections"])
def test_blades_of_another_planform_are_wholly_different(what: str):
    plain = hovering("linear:-8")
    assert blade_distance(other_blades(plain)[what], plain) == 1.0


def test_equal_blades_have_no_distance_whatever_they_carry():
    """Mass, altitude, rotor speed and stiffness are no shape."""
    plain = hovering("linear:-8")
    structure = plain.rotor.blade.structure
    assert structure is not None
    stiffer = replace(structure, control_stiffness=2.0 * structure.control_stiffness)
    blade = replace(plain.rotor.blade, structure=stiffer)
    others = [
        hovering("linear:-8", mass_kg=9000.0),
        hovering("linear:-8", altitude_m=2000.0),
        hovering("linear:-8", rotor_speed_percent=95.0),
        replace(plain, rotor=replace(plain.rotor, blade=blade)),
    ]
    assert [blade_distance(other, plain) for other in others] == [0.0] * 4
    heavy = doubt(rotor.solve(others[0]), rotor.solve(plain))
    assert HOVER_BLADE not in {row.name for row in heavy.rows}


def difference(twist: str, **flight: Any) -> Doubt:
    """Of a linear twist of −8°."""
    here, there = (
        rotor.solve(rotor.make_design(twist=each, **flight)).require()
        for each in (twist, "linear:-8")
    )
    return doubt(here, there)


def size_of(found: Doubt) -> float:
    """What the distance of the blades does to a change [W]."""
    return next((row.change or 0.0 for row in found.rows if row.name == HOVER_BLADE), 0.0)


def test_in_hover_it_is_a_share_of_power_times_the_distance():
    """Of induced and of profile power alike; the power itself is no less certain."""
    here, there = (rotor.solve(hovering(each)) for each in ("linear:-12", "linear:-8"))
    found = doubt(here, there)
    row = next(row for row in found.rows if row.name == HOVER_BLADE)
    mean = 0.5 * (here.power.main_rotor + there.power.main_rotor)
    assert SIZES[HOVER_BLADE] == 3.0
    assert row.change == pytest.approx(0.03 * mean / 3.0)
    assert sum(row.changes) == pytest.approx(row.change)
    induced = 0.5 * (here.power.induced + there.power.induced)
    assert row.changes[PARTS.index("induced")] == pytest.approx(0.01 * induced)
    assert row.changes[PARTS.index("tail")] == 0.0
    assert row.power == 0.0
    assert found.band == pytest.approx(doubt(here).band)


def test_the_sign_of_a_small_change_is_not_sure_by_construction():
    """A tenth of a degree is no surer than four degrees; past the best twist the sign is unclear."""
    tenth, four, eight = (difference(f"linear:-{rate}", hover=True) for rate in ("8.1", "12", "16"))
    words = [found.sureness for found in (tenth, four, eight)]
    assert words == ["likely", "likely", "unclear"]
    assert tenth.change is not None
    assert tenth.change_band is not None
    assert (1e-3 * tenth.change, 1e-3 * tenth.change_band) == pytest.approx((-0.59, 0.40), abs=0.01)
    assert (1e-3 * (four.change or 0.0), 1e-3 * (four.change_band or 0.0)) == pytest.approx(
        (-17.9, 15.5), abs=0.1
    )
    assert size_of(tenth) == pytest.approx(size_of(four) / 40.0, rel=0.01)


@pytest.mark.slow
def test_guide_and_trust_page_say_what_models_make_of_twist_in_hover():
    guide = (Path(__file__).parents[3] / "docs/guide/doubt.md").read_text(encoding="utf-8")
    page = toml_asset("trust_sets.toml")["doubt"]["text"][2]
    twists = {twist: hovering(twist) for twist in ("linear:0", "linear:-8", "linear:-16")}

    def saved(family: dict[str, Design]) -> str:
        """Of −16° in place of −8° and of none [%]."""
        low, middle, high = (rotor.solve(family[each]).require().power.total for each in twists)
        words = " and ".join(f"{100.0 * (high / other - 1.0):.1f}" for other in (middle, low))
        return words.replace("-", "−")

    slow = {twist: other_models(each)["inflow lifting-line"] for twist, each in twists.items()}
    for text in (guide, page):
        assert f"annuli, whose wake carries no force, say {saved(twists)} %" in text
        assert f"a lifting line near hover {saved(slow)} %" in text


def test_it_fades_with_the_share_of_hover():
    """The band of slow flight has no step, and from µ 0.1 on it is what it was without this row."""
    hover = difference("linear:-12", hover=True)
    crawl = difference("linear:-12", mu=0.002)
    assert size_of(crawl) == pytest.approx(size_of(hover), rel=0.02)
    slow = difference("linear:-12", mu=0.04)
    share = hover_share(rotor.make_design(twist="linear:-12", mu=0.04))
    assert 0.1 < share < 0.6
    mean = 0.03 / 3.0 * share
    assert size_of(slow) == pytest.approx(mean * induced_and_profile(0.04), rel=0.02)
    assert size_of(difference("linear:-12", mu=0.1)) == 0.0


def induced_and_profile(mu: float) -> float:
    """Of the twist of −12° [W]."""
    power = rotor.solve(rotor.make_design(twist="linear:-12", mu=mu)).power
    return power.induced + power.profile
