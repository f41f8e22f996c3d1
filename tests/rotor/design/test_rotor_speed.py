"""Rotor speed as a quantity: what scales with Ω and what does not, and that it reaches everything from its row."""

import argparse
import re
from dataclasses import replace
from typing import Any

import pytest
from numpy.testing import assert_allclose

import rotor
from explorer.model.inputs import inputs_of, with_rotor
from explorer.model.sliders import SLIDERS
from explorer.sharing.share import code_of, design_from
from explorer.text.glossary import CONTROLS
from rotor.command.common import add_design_arguments
from rotor.command.common import design_from as design_from_flags
from rotor.design.design import Design
from rotor.design.quantities import CONDITION, NUMBERS, SWEPT, Flight
from rotor.dynamics.torsion import blade_modes
from rotor.files.design_file import design_from_record
from rotor.optimisation.objective import read_mission
from rotor.study.series import sweep_columns
from rotor.study.study import columns_of
from rotor.study.study_file import parse_study
from rotor.support.units import KNOT

SMALL: dict[str, Any] = {"elements": 12, "azimuths": 24}


def simple(percent: float, **more: Any) -> Design:
    """A rigid blade in incompressible air, without the losses that depend on speed."""
    off = "compressibility,flapping,elastic-twist,swirl,download,surface-drag"
    return rotor.make_design(off=off, inflow="drees", rotor_speed_percent=percent, **more, **SMALL)


def test_its_own_speed_is_the_rotor_as_built():
    design = rotor.make_design(mu=0.2, **SMALL)
    again = design.at(rotor_speed_percent=83.0).at(rotor_speed_percent=100.0)
    assert again == design
    assert again.rotor == design.aircraft.rotor
    assert again.rotor.angular_speed == design.aircraft.rotor.angular_speed


def test_profile_power_goes_with_the_cube_at_the_same_blade_loading():
    """At one C_T all coefficients are the same without Mach number, so that weights ∝ Ω² have powers ∝ Ω³."""
    base = rotor.solve(simple(100.0, hover=True)).require()
    for percent in (75.0, 105.0):
        share = percent / 100.0
        mass = base.design.condition.mass * share**2
        slow = rotor.solve(simple(percent, hover=True, mass_kg=mass)).require()
        assert_allclose(slow.ct, base.ct, rtol=1e-6)
        for part in ("profile", "induced"):
            assert_allclose(
                getattr(slow.power, part), getattr(base.power, part) * share**3, rtol=2e-5
            )


def test_ideal_induced_power_does_not_depend_on_rotor_speed():
    """Momentum theory: T √(T/2ρA); ours differs by less than the change of κ, while profile power falls."""
    full, slow = (rotor.solve(simple(percent, hover=True)).require() for percent in (100.0, 90.0))
    assert_allclose(slow.power.induced, full.power.induced, rtol=0.02)
    assert slow.power.profile < 0.85 * full.power.profile


def test_torsion_frequency_per_revolution_rises_as_the_rotor_slows():
    """ω² = ω_0² + k Ω²: the elastic part stays in rad/s, the centrifugal part stays per revolution."""
    design = rotor.make_design(**SMALL)
    structure = design.rotor.blade.structure
    assert structure is not None

    def per_rev(percent: float) -> float:
        speed = design.at(rotor_speed_percent=percent).rotor.angular_speed
        return float(blade_modes(structure, speed, 1).frequency[0]) / speed

    rest = float(blade_modes(structure, 1e-3, 1).frequency[0])
    own = design.aircraft.rotor.angular_speed
    centrifugal = per_rev(100.0) ** 2 - (rest / own) ** 2
    for percent in (70.0, 110.0):
        assert_allclose(
            per_rev(percent) ** 2, (rest / (own * percent / 100.0)) ** 2 + centrifugal, rtol=2e-3
        )


def test_flapping_with_hinge_offset_keeps_its_frequency_and_a_spring_does_not():
    design = rotor.make_design(**SMALL)
    slow = design.at(rotor_speed_percent=80.0)
    assert_allclose(
        slow.rotor.flap_frequency_squared, design.rotor.flap_frequency_squared, rtol=1e-12
    )
    sprung = replace(
        design, rotor=replace(design.rotor, blade=replace(design.rotor.blade, flap_spring=1e4))
    )
    slower = sprung.at(rotor_speed_percent=80.0)
    assert_allclose(
        slower.rotor.flap_spring_ratio * 0.8**2, sprung.rotor.flap_spring_ratio, rtol=1e-12
    )


def test_advance_ratio_stays_unless_the_airspeed_is_given():
    design = rotor.make_design(mu=0.3)
    assert design.at(rotor_speed_percent=90.0).condition.advance_ratio == 0.3
    for slow in (
        rotor.make_design(speed_kt=120, rotor_speed_percent=90),
        design.at(rotor_speed_percent=90).at(speed_kt=120),
    ):
        assert_allclose(slow.airspeed, 120 * KNOT, rtol=1e-12)
    assert_allclose(slow.tip_mach, 0.9 * design.tip_mach, rtol=1e-12)
    assert_allclose(slow.weight_coefficient, design.weight_coefficient / 0.81, rtol=1e-12)


def test_a_given_tip_mach_number_excludes_it():
    stand = {"ct_over_sigma": 0.07, "tip_mach": 0.6}
    with pytest.raises(
        ValueError, match=r"rotor speed 90 % and tip_mach 0\.6 both .* give one of them"
    ):
        rotor.make_design(stand=stand, rotor_speed_percent=90)


def test_a_quantity_is_found_everywhere_from_its_row(tmp_path):
    """Flag, file, link, study, sweep, mission, JSON, report, slider and tooltip, wherever its place in a design is."""
    parser = argparse.ArgumentParser()
    add_design_arguments(parser)
    assert Flight.__annotations__.keys() == SWEPT.keys() - {"mu"}  # What a type checker sees of it.
    for name, row in NUMBERS.items():
        if name == "mu":
            continue
        value = (
            float(row.examples[0]) if row.examples[0] != row.default else float(row.examples[-1])
        )
        changed: dict[str, Any] = {name: value}
        wrong: dict[Any, tuple[type[Exception], str]] = {
            row.high + 1.0: (ValueError, f"is outside {row.low:g}…{row.high:g}"),
            "little": (TypeError, f"{name} is 'little', not a number"),
        }
        for beyond, (error, words) in wrong.items():
            with pytest.raises(error, match=re.escape(words)):
                rotor.make_design(**{name: beyond})
        design = rotor.make_design(**changed, **SMALL)
        assert row.of(design) == value
        assert row.put(rotor.make_design(**SMALL), value) == design
        again = rotor.make_design(**SMALL).at(**changed)
        assert again == design == rotor.make_design(case=again)
        grid = [f"--{key}={size}" for key, size in SMALL.items()]
        assert (
            design_from_flags(parser.parse_args([f"--{row.flag}={value}", *grid]), mu=0.2) == design
        )
        assert design_from_record(design.to_dict()) == design
        assert f"{row.word}={value:g}" in code_of(design)
        assert design_from(code_of(design)) == design
        shown = inputs_of(design)
        assert shown.design() == design
        assert (other := with_rotor(shown, "bo105").design()).fuselage == other.aircraft.fuselage
        assert (row.input in SLIDERS) == (name in CONDITION)
        assert row.input in CONTROLS
        assert name in sweep_columns([design])
        study = parse_study(f"[axes]\nmu = [0.2]\n{name} = [{value}]")
        assert next(column.unit for column in columns_of(study) if column.name == name) == row.unit
        assert name in rotor.solution_record(rotor.solve(design))
        mission = tmp_path / "mission.csv"
        mission.write_text(f"mu,{name}\n0.2,{value}\n", encoding="utf-8")
        if name in CONDITION:
            assert read_mission(mission, rotor.make_design(**SMALL))[0].flight == design.condition
        if row.short:
            assert row.in_words(value) in repr(design)


def test_drag_area_is_that_of_the_airframe():
    """Parasite power ½ρV³f; without an area of its own it is the rotor file's."""
    design = rotor.make_design(
        mu=0.2, twist="linear:-12", drag_area_m2=2.0, off="download", **DREES
    )
    power = rotor.solve(design).require().power
    assert_allclose(
        power.parasite, 0.5 * design.condition.density * design.airspeed**3 * 2.0, rtol=1e-8
    )
    table = rotor.sweep(design, drag_area_m2=[2.0, 3.0])
    assert [one.design.fuselage.drag_area for one in table.solutions] == [2.0, 3.0]
    assert (
        "drag_area_m2" not in design.at(drag_area_m2=design.aircraft.fuselage.drag_area).to_dict()
    )


# Load factor: a heavier aircraft with the same drag; in a climb power lifts the weight alone


DREES: dict[str, Any] = {"elements": 12, "azimuths": 24, "inflow": "drees"}


def test_one_is_the_design_without_it():
    design = rotor.make_design(mu=0.2, **DREES)
    assert design.at(load_factor=1.7).at(load_factor=1.0) == design
    assert "load_factor" not in design.to_dict()


@pytest.mark.parametrize("mu", [0.0, 0.02, 0.25])
def test_it_is_a_heavier_aircraft_with_the_same_drag(mu: float):
    """n = 1.2 at a mass m is n = 1 at 1.2 m."""
    design = rotor.make_design(mu=mu, mass_kg=7000, load_factor=1.2, **DREES)
    turning, heavy = (
        rotor.solve(one).require() for one in (design, design.at(mass_kg=8400, load_factor=1))
    )
    assert_allclose(vars(turning.power)["induced"], heavy.power.induced, rtol=1e-9)
    assert_allclose(turning.power.total, heavy.power.total, rtol=1e-9)
    assert_allclose(turning.controls.array(), heavy.controls.array(), rtol=1e-7, atol=1e-10)
    assert turning.power.total > rotor.solve(design.at(load_factor=1)).require().power.total
    assert_allclose(turning.lift_to_drag or 0.0, heavy.lift_to_drag or 0.0, rtol=1e-9)


def test_in_a_climbing_turn_power_lifts_the_weight_alone():
    """Along the path the rotor pulls D + W sin γ, not n times the weight's part: W V_c is gained."""
    design = rotor.make_design(mu=0.2, climb_m_s=4.0, load_factor=1.5, off="download", **DREES)
    turn, level = rotor.solve(design).require(), rotor.solve(design.at(climb_m_s=0.0)).require()
    assert_allclose(turn.power.climb, design.condition.weight * 4.0, rtol=1e-12)
    assert_allclose(turn.power.parasite, design.drag * design.flight_speed, rtol=1e-9)
    assert_allclose(turn.power.main_rotor, turn.power.shaft, rtol=1e-6)
    assert_allclose(turn.power.main_rotor - level.power.main_rotor, turn.power.climb, rtol=0.05)


def test_hover_needs_the_power_of_momentum_theory():
    """P_i ∝ n^1.5, of a rotor whose loading keeps its shape within per cents."""
    design = rotor.make_design(hover=True, off="download", **DREES)
    one, two = (rotor.solve(design.at(load_factor=n)).require() for n in (1.0, 1.5))
    assert_allclose(two.power.induced / one.power.induced, 1.5**1.5, rtol=0.03)
