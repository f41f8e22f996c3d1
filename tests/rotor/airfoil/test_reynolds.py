"""Section data of several Reynolds numbers: which an element takes, and what a small rotor gains by speed."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Aircraft, Design, make_design, solve
from rotor.aero.problem import build_problem
from rotor.airfoil.c81 import format_c81
from rotor.airfoil.decks import SectionTraits, assemble_deck
from rotor.airfoil.polars import COLUMNS, Polar
from rotor.airfoil.reynolds import by_reynolds, shares
from rotor.airfoil.sections import OwnSection, install_own
from rotor.design.blade import Span
from rotor.files.rotor_file import read_aircraft
from rotor.trim import SolverOptions, power_gradient

KNOTS = (50e3, 100e3, 200e3, 400e3)
ALPHA = np.arange(-10.0, 16.5, 0.5)
DRONE = """\
name = "28 inches"

[main_rotor]
blades = 2
radius_m = 0.3556
speed_rpm = 3000.0
root_cutout_r = 0.15
chord_m = 0.035
section = "mine"
twist_r = [0.15, 1.0]
twist_deg = [12.0, -4.0]
flap_hinge_m = 0.0
blade_mass_kg = 0.2

[sections.mine]
polars = "all.csv"
outline = "naca0012"
"""


def polar(reynolds: float, power: float = -0.2, mach: float = 0.0) -> Polar:
    """Drag with a power of the Reynolds number, at all angles."""
    drag = (0.012 + 8e-5 * ALPHA**2) * (reynolds / 1e5) ** power
    return Polar(mach, reynolds, ALPHA, 1.3 * np.tanh(0.1 * ALPHA / 1.3), drag, 0.0 * ALPHA)


def polar_text(one: Polar) -> str:
    rows = zip(one.alpha_deg, one.cl, one.cd, one.cm, strict=True)
    return "\n".join(
        f"{one.mach:g},{one.reynolds:.0f},{a:.2f},{cl:.6f},{cd:.8f},{cm:g}"
        for a, cl, cd, cm in rows
    )


@cache
def drone(power: float = -0.2, knots: tuple[float, ...] = KNOTS, toml: str = DRONE) -> Aircraft:
    rows = [polar_text(polar(number, power)) for number in knots]
    return read_aircraft("my.toml", {"my.toml": toml, "all.csv": "\n".join((COLUMNS, *rows, ""))})


def test_linear_in_the_logarithm_and_held_at_the_ends():
    assert shares(KNOTS, 100e3) == ((1, 1.0),)
    (low, first), (high, second) = shares(KNOTS, 100e3 * 2.0**0.25)
    assert (low, high) == (1, 2)
    assert_allclose((first, second), (0.75, 0.25), rtol=1e-12)
    assert shares(KNOTS, 1e3) == ((0, 1.0),)
    assert shares(KNOTS, 1e7) == ((3, 1.0),)


def test_polars_are_sorted_by_reynolds_number_and_filled_at_other_mach_numbers():
    one_each = [polar(1e5 * mach, mach=mach) for mach in (0.1, 0.2, 0.3)]
    assert by_reynolds(one_each) == ((1e4, tuple(one_each)),)
    alone = polar(3e5, mach=0.3)
    families = by_reynolds([polar(4e5, mach=0.1), alone, polar(1e5, mach=0.1)])
    assert [(number, [one.reynolds for one in family]) for number, family in families] == [
        (1e5, [1e5, 3e5]),
        (4e5, [4e5, 3e5]),
    ]
    given = ((1e5, 0.1), (4e5, 0.1), (2e5, 0.2), (8e5, 0.2))
    both = by_reynolds([polar(number, mach=mach) for number, mach in given])
    assert [number for number, _ in both] == [1e5, 2e5, 4e5, 8e5]
    between = both[1][1][0]  # Mach 0.1 at 2e5, half way in the logarithm.
    assert (between.mach, between.reynolds) == (0.1, 2e5)
    assert_allclose(between.cd, 0.5 * (polar(1e5).cd + polar(4e5).cd), rtol=1e-12)
    assert both[0][1][1].reynolds == 2e5  # Held below the lowest of Mach 0.2.


def test_two_polars_of_one_reynolds_number_and_too_many_are_refused():
    with pytest.raises(
        ValueError, match="two polars of mine have Mach 0 and Reynolds number 100,000: keep one"
    ):
        drone(knots=(100e3, 200e3, 100.5e3))
    with pytest.raises(
        ValueError, match=r"my\.toml, line 16: the polars of mine have 13 Reynolds numbers: keep 12"
    ):
        drone(knots=tuple(1e4 * 1.5**k for k in range(13)))


def test_an_element_takes_the_data_of_its_own_reynolds_number():
    """Ω r c/ν by hand; drag of an element is that of the two nearest polars, linear in log Re."""
    design = make_design(rotor=drone(), mu=0.0)
    disk, air = build_problem(design).disk, design.condition
    number = 3000.0 * np.pi / 30.0 * 0.3556 * disk.r * 0.035 * air.density / air.viscosity
    assert number.min() < KNOTS[0] < number.max() < KNOTS[-1]
    cd_zero = [item.table(0.0, 0.1).cd for item in disk.sections]
    ours = [
        (1.0 - w) * cd_zero[a] + w * cd_zero[b]
        for (a, b), w in zip(disk.section, disk.weight, strict=True)
    ]
    by_hand = np.interp(np.log(number), np.log(KNOTS), [polar(knot).cd[20] for knot in KNOTS])
    assert ALPHA[20] == 0.0
    assert_allclose(ours, by_hand, rtol=2e-3)  # Decks have five decimals.


def test_a_reynolds_number_on_a_knot_is_that_table_alone():
    section = drone().rotor.blade.installed("mine")
    assert section.one_at(200e3) is section.of_reynolds[2][1]
    between = section.one_at(150e3).table(0.05, 0.2)
    (low, first), (high, second) = section.at(150e3)
    assert first + second == pytest.approx(1.0)
    assert_allclose(
        between.cd, first * low.table(0.05, 0.2).cd + second * high.table(0.05, 0.2).cd, rtol=1e-12
    )
    at_an_end = make_design(rotor=drone(), mu=0.0, altitude_m=0.0)
    alone = drone(knots=(400e3,))
    fast = replace(
        at_an_end, rotor=replace(at_an_end.rotor, angular_speed=at_an_end.rotor.angular_speed * 1e4)
    )
    assert {item.table.name for item in build_problem(fast).disk.sections} == {"mine"}
    assert set(build_problem(fast).disk.section.ravel()) == {3}
    assert_allclose(
        build_problem(fast).disk.tables[3],
        alone.rotor.blade.installed("mine").table.coefficients,
        rtol=1e-12,
    )


def test_data_that_do_not_depend_on_it_give_the_answer_of_one_polar():
    for mu in (0.0, 0.2):
        several, one = (
            solve(make_design(rotor=drone(0.0, knots), mu=mu, inflow="drees"))
            for knots in (KNOTS, KNOTS[:1])
        )
        assert several.require().power.shaft == pytest.approx(one.require().power.shaft, rel=1e-9)


def test_a_small_rotor_gains_by_speed():
    """At one C_T/σ and without Mach number, profile power goes with Re^-0.2 as the data do; figure of merit rises."""
    merit, profile, speeds = list[float](), list[float](), (1000.0, 2000.0, 3000.0, 4500.0)
    knots = tuple(6250.0 * 2.0**k for k in range(8))
    for speed in speeds:
        craft = drone(knots=knots, toml=DRONE.replace("3000.0", f"{speed}"))
        design = make_design(rotor=craft, trim="wind-tunnel", mu=0.0, stand={"ct_over_sigma": 0.09})
        solution = solve(
            replace(design, models=replace(design.models, compressibility=False))
        ).require()
        merit.append(solution.ct**1.5 / 2.0**0.5 / solution.cp)
        profile.append(solution.power.profile / design.power_unit)
    assert merit[-1] - merit[0] > 0.05
    assert np.all(np.diff(merit) > 0.0)
    assert_allclose(
        np.array(profile) / profile[0], (np.array(speeds) / speeds[0]) ** -0.2, rtol=3e-3
    )


def test_power_adds_up_and_its_slope_by_twist_is_exact():
    """By differences of 0.001°: tables are C¹, so larger ones straddle knots."""
    craft, exactly = drone(), SolverOptions(residual_tolerance=1e-13, inflow_tolerance=1e-12)

    def at(rate: float) -> Design:
        stand = {"ct_over_sigma": 0.07, "shaft_tilt_deg": 4.0}
        return make_design(
            rotor=craft, trim="wind-tunnel", mu=0.2, twist=f"linear:{rate:.9g}", stand=stand
        )

    solution = solve(at(-8.0), options=exactly).require()
    assert len({*build_problem(solution.design).disk.section.ravel().tolist()}) > 2
    assert solution.power.shaft == pytest.approx(solution.power.main_rotor, rel=1e-9)
    slope = float(power_gradient(solution).along((solution.disk.r - 0.75)[None])[0])
    ends = [
        solve(at(-8.0 + step), solution, exactly).require().power.total for step in (0.001, -0.001)
    ]
    assert (ends[0] - ends[1]) / np.deg2rad(0.002) == pytest.approx(slope, rel=2e-5)


def test_reynolds_numbers_beyond_the_data_are_said():
    said = [
        caveat.sentence for caveat in solve(make_design(rotor=drone(), mu=0.0)).require().caveats
    ]
    assert any(
        "R the Reynolds number is" in one and "the data of mine at 50,000 are used there" in one
        for one in said
    )
    wide = solve(make_design(rotor=drone(knots=(5e3, 1e6)), mu=0.0)).require()
    assert "reynolds-outside-data" not in [caveat.name for caveat in wide.caveats]


def test_between_two_spans_each_section_has_its_own_reynolds_number():
    def own(name: str, level: float) -> OwnSection:
        decks = tuple(
            (number, format_c81(assemble_deck(name, [replace(polar(number), cd=level * polar(number).cd)],
                                              SectionTraits(thickness=0.12, fixed_reynolds=True).correct)))
            for number in KNOTS
        )  # fmt: skip
        return OwnSection(name, decks[0][1], "naca0012", name, decks=decks)

    rotor = drone().rotor
    spans = (Span(0.15, 0.5, "one"), Span(0.7, 1.0, "other"))
    rotor = replace(
        rotor,
        blade=replace(rotor.blade, spans=spans, own_sections=(own("one", 1.0), own("other", 2.0))),
    )
    design = replace(make_design(rotor=drone(), mu=0.2, inflow="drees"), rotor=rotor)
    disk, blade = build_problem(design).disk, rotor.blade
    inside = [k for k, r in enumerate(disk.r) if 0.5 < r < 0.7]
    assert inside
    alpha, mach = 0.06, 0.15
    tip = 0.035 * 100.0 * math.pi * 0.3556 * 1.225 / 1.789e-5
    for k, r in enumerate(disk.r.tolist()):
        parts = blade.mixture(r, design.reynolds_per_metre)
        between = KNOTS[0] < r * tip < KNOTS[-1]  # Two of the four, else the lowest.
        assert len(parts) == (2 if k in inside else 1) * (2 if between else 1)
        by_hand = sum(share * float(part.table(alpha, mach).cd) for part, share in parts)
        (a, b), weight = disk.section[k], disk.weight[k]
        ours = [float(disk.sections[row].table(alpha, mach).cd) for row in (a, b)]
        assert (1.0 - weight) * ours[0] + weight * ours[1] == pytest.approx(by_hand, rel=1e-12)
    assert solve(design).converged
    assert install_own(blade.own_sections[0]).of_reynolds[0][0] == KNOTS[0]
