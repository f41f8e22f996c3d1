"""An actuator over a flight, against its verdict, the beam model and trims of its own; and one that stops, whose frozen
twist is a design like any other."""

import math
import pickle
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.flight import ActuatorFlight, fly
from rotor.actuator.installation import with_actuator_mass
from rotor.actuator.section import HostBlade, default_placement
from rotor.actuator.stopped import stopped_designs
from rotor.actuator.verdict import Verdict, judge
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.mission import FlightLeg, mission_at, standard_flight
from rotor.trim.solve import solve

LEGS = (FlightLeg("hover", 0.0), FlightLeg("climb", 0.15, 5.0), FlightLeg("fast", 0.3))


@cache
def verdict(
    kind: str = "new", id: str = "MFC_P1", preset: str = "flight", concept: str = "linear"
) -> Verdict:
    design = make_design(preset=preset)
    coarse = replace(design, models=replace(design.models, elements=16, azimuths=36))
    host = HostBlade() if kind == "retrofit" else HostBlade("new", 0.5)
    mission = mission_at(coarse, (0.0, 0.3))
    return judge(find_actuator(id), mission, find_concept(concept), default_placement(2), host)


@cache
def flown(kind: str = "new", id: str = "MFC_P1") -> ActuatorFlight:
    return fly(verdict(kind, id), LEGS)


@pytest.mark.parametrize(
    ("kind", "id"), [("retrofit", "MFC_P1"), ("new", "MFC_P1"), ("new", "SMA_tube")]
)
def test_the_legs_of_the_verdict_save_what_the_verdict_says(kind: str, id: str):
    """Both find the least power within one range; the flight may drive the first condition too, which a jig does as
    well for a new blade, but for the shape of the plies."""
    judged, both = verdict(kind, id), fly(verdict(kind, id), (LEGS[0], LEGS[2]))
    loaded = [
        solve(with_actuator_mass(design, judged.installed)).require().power.total
        for design in both.designs
    ]
    saving = judged.reference_power - float(np.mean(loaded)) - judged.drive.hold_power
    assert saving >= judged.net_saving - 1.0
    assert_allclose(saving, judged.net_saving, rtol=1e-5 if kind == "retrofit" else 0.01)


@pytest.mark.parametrize("kind", ["retrofit", "new"])
def test_the_range_is_that_of_the_beam_and_no_twist_lies_beyond_it(kind: str):
    flight = flown(kind)
    low, high = flight.reach
    assert np.all((low - 1e-6 < flight.reached) & (flight.reached < high + 1e-6))
    assert [design.condition.climb_speed for design in flight.designs] == [0.0, 5.0, 0.0]
    assert np.ptp(flight.reached) > 0.5 * (high - low)  # The legs ask for different twists.
    assert_allclose(high - low, abs(verdict(kind).installed.shapes[0, -1]), rtol=1e-9)


def test_voltages_make_the_reached_twist():
    """By the beam model: zero volts is the zero of the twists."""
    judged = verdict("new", preset="thesis")  # Rigid: the shapes are those of the rotating blade.
    legs = standard_flight(judged.baseline.mission.design)
    assert not any(leg.climb_speed for leg in legs)  # Its models know level flight only.
    flight = fly(judged, legs)
    for volts, twist in zip(flight.voltages, flight.reached, strict=True):
        assert_allclose(judged.installed.tip(np.array(volts) / 2000.0), twist, atol=1e-9)


def test_no_solution_is_carried_along():
    assert len(pickle.dumps(flown())) < 100_000


def test_a_leg_that_does_not_trim_is_named():
    with pytest.raises(RuntimeError, match="fast: "):
        fly(verdict(), (FlightLeg("hover", 0.0), FlightLeg("fast", 0.59)))
    with pytest.raises(ValueError, match="needs a leg"):
        fly(verdict(), ())


OFF = "unsteady,dynamic-stall,compressibility,tip-loss,hub-loss,elastic-twist,surface-drag,swirl,swept-tip,download"
PLAIN: dict[str, Any] = {
    "inflow": "drees", "elements": 24, "azimuths": 48, "mu": 0.25, "twist": "linear:-10", "off": OFF,
}  # fmt: skip


def test_stopped_where_it_works_the_same_changes_nothing():
    design = rotor.make_design(**PLAIN)
    (point,) = stopped_designs([design], design)
    assert point.cost == 0.0
    assert point.power_left == pytest.approx(
        (design.aircraft.installed_power or 0.0) - (point.stopped.power or 0.0)
    )


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
    left = {
        "own": own.stopped.collective,
        "rigged": own.stopped.collective + math.radians(6.0 * (0.75 - 0.1304)),
    }
    for point, pitch in ((own, left["own"]), (rigged, left["rigged"])):
        place = (pitch - low) / (high - low)
        assert point.stopped.controls_left is not None
        # A cyclic may be nearer to its stop.
        assert point.stopped.controls_left <= min(place, 1.0 - place) + 1e-12
    assert rigged.stopped.controls_left == pytest.approx((high - left["rigged"]) / (high - low))
    assert rotor.make_design(rotor="r22").aircraft.controls is None


def test_frozen_twist_at_n_per_rev_keeps_amplitude_and_phase():
    design = rotor.make_design(**PLAIN, twist_per_rev="2:1.5:200")
    (same,) = stopped_designs([design], design)
    assert same.cost == 0.0
    elsewhere = rotor.make_design(**PLAIN).at(mu=0.15)
    other = replace(
        elsewhere, active_twist=rotor.make_design(**PLAIN, twist_per_rev="2:1.5:20").active_twist
    )
    (point,) = stopped_designs([design], other)
    by_phase = {
        phase: rotor.solve(rotor.make_design(**PLAIN, twist_per_rev=f"2:1.5:{phase}"))
        .require()
        .power.total
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
