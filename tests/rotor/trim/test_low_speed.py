"""Forward flight that passes over to hover: limits, smoothness, gradient, records."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotor import Design, make_design, solve
from rotor.aero.momentum import glauert_inflow
from rotor.design.quantities import HOVER_INFLOWS, HoverInflow, LowSpeed
from rotor.trim.low_speed import FASTEST, axial_share, inflow_ratio
from rotor.trim.newton import SolverOptions
from tests.patched import Patch
from tests.solved import assert_same_trim


def design(
    twist: str = "linear:-12", low_speed: LowSpeed = "hover", elastic_twist: bool = True
) -> Design:
    made = make_design(hover=True, twist=twist)
    return replace(
        made, models=replace(made.models, low_speed=low_speed, elastic_twist=elastic_twist)
    )


def watts(what: Design) -> float:
    return (
        solve(what, None, SolverOptions(residual_tolerance=1e-12, inflow_tolerance=1e-11))
        .require()
        .power.total
    )


@pytest.mark.parametrize(
    ("mu", "ratio"),
    [(0.0, 1.0), (math.sqrt(1.5), math.sqrt(0.5)), (100.0, 0.01)],
    ids=["hover", "", "fast"],
)
def test_inflow_ratio_is_glauerts(mu: float, ratio: float):
    """λ̄⁴ + µ̄² λ̄² = 1: λ̄² is ½ at µ̄² = 3/2, and λ̄ tends to 1/µ̄."""
    assert inflow_ratio(mu) == pytest.approx(ratio, abs=1e-8)
    assert inflow_ratio(mu) == pytest.approx(
        glauert_inflow(2.0 * 0.08**2, 0.08 * mu, 0.0)[0] / 0.08, rel=1e-8
    )


def test_share_falls_faster_than_the_fifth_power_and_ends():
    """Below λ̄⁵, and 0 from FASTEST on, where value, slope and curvature are 0: no kink."""
    speeds = np.linspace(0.0, 0.2, 81)
    share = np.array([axial_share(mu, 2.0 * 0.06**2) for mu in speeds])
    fifth = np.array([inflow_ratio(mu / 0.06) ** 5 for mu in speeds])
    assert share[0] == 1.0
    assert (share <= fifth).all()
    assert (fifth - share).max() < 0.23
    assert (share[speeds < 0.06 * FASTEST - 1e-9] > 0.0).all()
    assert (share[speeds > 0.06 * FASTEST + 1e-9] == 0.0).all()
    assert axial_share(0.06 * (FASTEST - 0.01), 2.0 * 0.06**2) < 1e-6


def climbing(climb: float, hover_inflow: HoverInflow) -> Design:
    at = design().at(climb_m_s=climb)
    return replace(at, models=replace(at.models, hover_inflow=hover_inflow))


AXIAL = {
    **{f"{twist}, elastic {on}": design(twist, elastic_twist=on)
       for twist in ("linear:0", "linear:-24", "builtin") for on in (True, False)},
    **{f"{climb} m/s, {inflow}": climbing(climb, inflow)
       for climb in (-4.0, 3.0, 15.0) for inflow in HOVER_INFLOWS},
}  # fmt: skip


@pytest.mark.parametrize("at", AXIAL.values(), ids=AXIAL)
def test_hover_is_the_limit_of_forward_flight(at: Design):
    assert watts(at.at(mu=0.002)) == pytest.approx(watts(at), rel=1e-3)
    assert watts(at.at(mu=1e-4)) == pytest.approx(watts(at), rel=1e-5)


def test_it_changes_slow_flight_alone():
    """Of the lifting line alone it is a step of 2 % at most from the balance of annuli."""
    with_, without = design(), design(low_speed="wake")
    assert watts(without.at(mu=0.002)) < 0.995 * watts(without)
    for one in (without.with_twist("linear:-8"), without.with_twist("linear:-16")):
        assert 0.98 < watts(one.at(mu=0.002)) / watts(one) < 1.0
    assert watts(with_.at(mu=0.1)) == pytest.approx(watts(without.at(mu=0.1)), rel=2e-3)


def test_at_speed_it_is_exactly_the_forward_wake_and_hover_is_not_computed(patch: Patch):
    def unasked(design: Design, course: object) -> None:
        pytest.fail("hover is computed")

    patch("rotor.trim.low_speed.hover_difference", unasked)
    with_, without = design("linear:-12.345"), design("linear:-12.345", low_speed="wake")
    assert_same_trim(solve(with_.at(mu=0.15)), solve(without.at(mu=0.15)))
    with pytest.raises(pytest.fail.Exception, match="hover is computed"):
        watts(with_.at(mu=0.02))


def test_linear_inflow_has_no_blend():
    at = design().at(mu=0.05)
    with_ = replace(at, models=replace(at.models, inflow="drees"))
    without = replace(with_, models=replace(with_.models, low_speed="wake"))
    assert_same_trim(solve(with_), solve(without))


def test_where_hover_has_no_answer_a_caveat_says_so(patch: Patch):
    """A blade that stalls in hover no longer flies slowly either, so hover is made to have no answer."""
    at = make_design(rotor="r22", mu=0.04)
    assert "low-speed-not-matched" not in {caveat.name for caveat in solve(at).require().caveats}
    patch("rotor.trim.low_speed.hover_difference", lambda design, course: None)
    found = solve(at).require()
    assert "low-speed-not-matched" in {caveat.name for caveat in found.caveats}
    without = replace(at, models=replace(at.models, low_speed="wake"))
    assert_same_trim(found, solve(without))
    faster = solve(at.at(mu=0.15)).require()
    assert "low-speed-not-matched" not in {caveat.name for caveat in faster.caveats}
