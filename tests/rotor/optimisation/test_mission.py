"""Missions: legs with hours, as designs, as conditions of an objective, and from a file."""

from dataclasses import replace
from pathlib import Path

import pytest

from rotor import make_design
from rotor.optimisation.mission import (
    ASSUMED_HOURS,
    FlightLeg,
    Mission,
    mission_at,
    mission_from,
    standard_flight,
    standard_mission,
)


def test_the_default_is_called_assumed_until_hours_are_given():
    design = make_design()
    default = standard_mission(design)
    assert default.assumed
    assert [leg.hours for leg in default.legs] == list(ASSUMED_HOURS)
    assert default.words == "hover, climb, cruise and fast"
    assert not Mission(design, standard_flight(design, (1.0, 1.0, 1.0, 1.0))).assumed


def test_means_are_by_hours():
    mission = mission_at(make_design(), (0.0, 0.1, 0.3), (1.0, 2.0, 1.0))
    assert mission.shares == (0.25, 0.5, 0.25)
    assert mission.mean([4.0, 8.0, 12.0]) == pytest.approx(8.0)
    assert mission.words == "hover, µ 0.10 and µ 0.30"


def test_legs_are_conditions_of_the_same_aircraft():
    design = make_design(mu=0.2, mass_kg=8000, altitude_m=500)
    mission = standard_mission(design)
    for flown, leg, condition in zip(
        mission.designs(), mission.legs, mission.conditions, strict=True
    ):
        assert flown == leg.of(design)
        assert flown.condition == condition.flight
        assert (condition.flight.mass, condition.flight.altitude) == (8000, 500)
        assert condition.hours == leg.hours
    assert [leg.climb_speed for leg in mission.legs] == [0.0, 5.0, 0.0, 0.0]


def test_a_stand_does_not_climb():
    assert [leg.climb_speed for leg in standard_flight(make_design(rotor="hart2"))] == [0.0] * 4


def test_a_file_gives_whole_conditions(tmp_path: Path):
    path = tmp_path / "mission.csv"
    path.write_text("mu,hours,mass_kg\n0,1,8000\n0.2,3,7800\n")
    mission = mission_from(path, make_design())
    assert [flown.condition.mass for flown in mission.designs()] == [8000, 7800]
    assert mission.shares == (0.25, 0.75)
    assert not mission.assumed


def test_what_is_no_mission_is_refused():
    design = make_design()
    with pytest.raises(ValueError, match="give at least two that differ"):
        mission_at(design, (0.3, 0.3))
    legs = standard_flight(design)
    idle = replace(legs[0], hours=0.0)
    with pytest.raises(ValueError, match="leg hover has 0 hours"):
        Mission(design, (idle, *legs[1:]))
    with pytest.raises(ValueError, match="give at least two"):
        Mission(design, (FlightLeg("hover", 0.0),))
