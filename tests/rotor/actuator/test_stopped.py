"""An actuator that stops: nothing changes where it worked the same, and a frozen twist is a design like any other."""

import math
from dataclasses import replace
from typing import Any

import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.actuator.stopped import stopped_designs

PLAIN: dict[str, Any] = {
    "inflow": "drees",
    "elements": 24,
    "azimuths": 48,
    "mu": 0.25,
    "twist": "linear:-10",
    "off": "unsteady,dynamic-stall,compressibility,tip-loss,hub-loss,elastic-twist,surface-drag,swirl,swept-tip,"
    "download",
}


def test_stopped_where_it_works_the_same_changes_nothing():
    design = rotor.make_design(**PLAIN)
    (point,) = stopped_designs([design], design)
    assert point.cost == 0.0
    assert point.power_left == pytest.approx((design.aircraft.installed_power or 0.0) - (point.stopped.power or 0.0))


def test_frozen_twist_is_that_design():
    design = rotor.make_design(**PLAIN)
    other = design.with_twist("linear:-16")
    (point,) = stopped_designs([design], other)
    powers = [rotor.solve(one).require().power.total for one in (design, other)]
    assert_allclose(point.cost or 0.0, powers[1] - powers[0], rtol=1e-4)
    assert point.stopped.power == pytest.approx(powers[1], rel=1e-5)


def test_a_twist_frozen_takes_the_pitch_at_the_root_from_the_controls():
    """Built −10° and stopped at −16°, with 0.62 R from root to 0.75 R: 3.7° more at the root."""
    design = rotor.make_design(**PLAIN)
    (rigged,) = stopped_designs([design], design.with_twist("linear:-16"), design.twist)
    (own,) = stopped_designs([design], design.with_twist("linear:-16"))
    low, high = rotor.make_design().aircraft.controls.collective  # pyright: ignore[reportOptionalMemberAccess]
    left = {"own": own.stopped.collective, "rigged": own.stopped.collective + math.radians(6.0 * (0.75 - 0.1304))}
    for point, pitch in ((own, left["own"]), (rigged, left["rigged"])):
        place = (pitch - low) / (high - low)
        assert point.stopped.controls_left is not None
        assert point.stopped.controls_left <= min(place, 1.0 - place) + 1e-12  # A cyclic may be nearer to its stop.
    assert rigged.stopped.controls_left == pytest.approx((high - left["rigged"]) / (high - low))
    assert rotor.make_design(rotor="r22").aircraft.controls is None


def test_frozen_twist_at_n_per_rev_keeps_amplitude_and_phase():
    design = rotor.make_design(**PLAIN, twist_per_rev="2:1.5:200")
    (same,) = stopped_designs([design], design)
    assert same.cost == 0.0
    elsewhere = rotor.make_design(**PLAIN).at(mu=0.15)
    other = replace(elsewhere, active_twist=rotor.make_design(**PLAIN, twist_per_rev="2:1.5:20").active_twist)
    (point,) = stopped_designs([design], other)
    by_phase = {
        phase: rotor.solve(rotor.make_design(**PLAIN, twist_per_rev=f"2:1.5:{phase}")).require().power.total
        for phase in (20, 200)
    }
    assert_allclose(point.stopped.power or 0.0, by_phase[20], rtol=1e-5)
    assert_allclose(point.working.power or 0.0, by_phase[200], rtol=1e-5)
    assert abs(by_phase[20] / by_phase[200] - 1.0) > 2e-4


def test_flown_on_from_hover_the_frozen_twist_costs_power():
    design = rotor.make_design(inflow="drees", elements=16, azimuths=36)
    found = rotor.failure("MFC_P1", design, stops_at=0.0, mu=(0.0, 0.35, 0.0))
    assert (found.actuator, found.stops_at) == ("MFC_P1", 0.0)
    hover, fast, again = found.points
    assert (hover.cost, again) == (0.0, hover)  # One trim, not two that are alike.
    assert fast.cost is not None
    assert fast.cost > 0.0
    with pytest.raises(ValueError, match="needs a blade"):
        rotor.failure("MFC_P1")
