"""Estimates of builds against `judge`, which searches the twist of each by trims."""

from dataclasses import replace
from functools import cache

import pytest
from numpy.testing import assert_allclose

from rotor.actuator.catalogue import Actuator, find_actuator
from rotor.actuator.estimate import HostBlade, estimate, host_blade
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import Baseline, ConditionPair, baseline, law_shapes, twisted
from rotor.actuator.pay import break_even
from rotor.actuator.section import Host, Placement, default_placement
from rotor.actuator.verdict import Verdict, judge
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.trim.solve import solve

WHOLE, INNER, OUTER = (0.2433, 0.9292), (0.2433, 0.6), (0.6, 0.9292)
BUILDS = (
    ("MFC_P1", 1, OUTER, 0.25),
    ("MFC_P1", 1, INNER, 0.5),
    ("MFC_P1", 4, WHOLE, 0.5),
    ("MFC_P1", 2, OUTER, 1.0),
    ("MFC_P2", 2, INNER, 1.0),
    ("PZT5A", 1, WHOLE, 1.0),
    ("SMA_tube", 2, WHOLE, 1.0),
    ("SMA_tube", 1, OUTER, 0.5),
    ("SMA_tube", 4, WHOLE, 0.25),
)
"""Actuator, layers, span and GJ over that of the aircraft's blade."""
Build = tuple[str, int, tuple[float, float], float]


@cache
def coarse(elastic: bool = True) -> Baseline:
    """The UH-60A on a coarse grid with linear inflow, hover and µ 0.3."""
    design = make_design(inflow="drees", elements=16, azimuths=36, off="" if elastic else "elastic-twist")
    return on(design)


def on(design: Design) -> Baseline:
    return baseline(ConditionPair(design, (0.0, 0.3)), find_concept("linear"))


@cache
def blade(stiffness: float) -> HostBlade:
    return host_blade(coarse(), Host("new", stiffness))


def parts(build: Build) -> tuple[Actuator, Placement, Host]:
    name, layers, span, stiffness = build
    return find_actuator(name), replace(default_placement(layers), span=span), Host("new", stiffness)


def installed(build: Build) -> InstalledActuator:
    return install(*parts(build), coarse().pair.design.rotor)


def searched(base: Baseline, build: Build) -> Verdict:
    actuator, placement, host = parts(build)
    return judge(actuator, base.pair, base.concept, placement, host)


def compare(verdict: Verdict, on_host: HostBlade) -> None:
    """Each part, and the net saving."""
    found = estimate(verdict.installed, on_host)
    assert_allclose(found.gross, verdict.gross_saving, rtol=0.1, atol=10.0)
    assert_allclose(found.stiffness_cost, verdict.stiffness_cost, atol=10.0)
    assert_allclose(found.mass_cost, verdict.mass_cost, rtol=0.03)
    assert_allclose(found.drive_cost, verdict.drive_cost, rtol=0.02)
    assert_allclose(found.net, verdict.net_saving, atol=0.03 * verdict.mass_cost + 20.0)
    assert_allclose(found.net, found.gross - found.stiffness_cost - found.mass_cost - found.drive_cost)


@pytest.mark.parametrize("build", BUILDS, ids=lambda build: "{} {} {} {}".format(*build))
def test_every_part_is_that_of_a_search_by_trims(build: Build):
    compare(searched(coarse(), build), blade(build[3]))


@pytest.mark.slow
@pytest.mark.parametrize("build", [BUILDS[k] for k in (0, 1, 6, 8)], ids=lambda build: "{} {} {} {}".format(*build))
def test_the_same_with_the_default_wake(build: Build):
    base = on(make_design())
    compare(searched(base, build), host_blade(base, Host("new", build[3])))


def test_a_rigid_blade_has_no_cost_of_stiffness():
    base = coarse(elastic=False)
    verdict = searched(base, BUILDS[3])
    found = estimate(verdict.installed, host_blade(base, Host()))
    assert verdict.stiffness_cost == 0.0
    assert [name for name, _ in verdict.savings] == ["gross", "mass", "drive"]
    assert_allclose(found.stiffness_cost, 0.0, atol=1.0)
    assert_allclose(found.gross, verdict.gross_saving, rtol=0.1)


def test_tip_twist_says_nothing_of_a_ply_on_the_tip_of_a_soft_blade():
    """Its 1.8° along the whole blade would save 2.1 kW; the air twists the soft blade there, and 0.1 kW is left."""
    base = coarse()
    made = installed(BUILDS[0])
    line = break_even(base.pair)
    found = estimate(made, blade(0.25))
    assert found.gross < 0.1 * line.saving(made.attainable)
    assert abs(found.swing) < 0.5  # More would cost again.


def test_first_earned_is_the_slope_of_one_condition():
    """A thousandth of the twist saves s₂ times its own share of hover or flight alone, here by two plain trims.

    The mean of both conditions does not change to first order along the line, as the blade is the best fixed one.
    """
    base = coarse(elastic=False)
    made, on_host = installed(BUILDS[6]), host_blade(base, Host())
    small = 1e-3
    found = estimate(made, on_host, derating=small)
    flight = on_host.solutions[1].design
    change = found.swing * small * law_shapes(made, flight)[0]
    powers = [solve(replace(flight, twist=twisted(flight.twist, sign * change))).power.total for sign in (-1.0, 1.0)]
    assert_allclose(found.gross, 0.5 * 0.5 * (powers[0] - powers[1]), rtol=0.02)
