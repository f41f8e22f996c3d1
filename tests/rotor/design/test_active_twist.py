"""Twist that follows the azimuth: limits, identity, and what it does to power."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.harmonic import dynamic_twist, phase_sweep, tip_response, with_harmonic
from rotor.actuator.installation import install
from rotor.actuator.section import Host, default_placement
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.aircraft import Stand
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.solve import at_rest, solve

DEGREE = math.radians(1.0)


def turning(design: Design, *harmonics: Harmonic, **shape: tuple[float, ...]) -> Design:
    return replace(design, active_twist=ActiveTwist(harmonics, **shape))


def test_uniform_once_per_revolution_twist_is_cyclic_pitch():
    """Uniform 1/rev twist equals cyclic pitch: the trim cancels it, and nothing else changes."""
    design = make_design(mu=0.25)
    plain = solve(design).require()
    turned = turning(design, Harmonic(1, 2.0 * DEGREE, 0.5), stations=(0.0, 1.0), shape=(1.0, 1.0))
    solution = solve(turned).require()
    assert_allclose(solution.power.total, plain.power.total, rtol=1e-9)
    shift = 2.0 * DEGREE * np.array([math.cos(0.5), math.sin(0.5)])
    cyclic = [solution.controls.cyclic_1c, solution.controls.cyclic_1s]
    assert_allclose(np.array(cyclic) + shift, [plain.controls.cyclic_1c, plain.controls.cyclic_1s], atol=1e-9)


def test_twice_per_revolution_saves_power_at_high_speed():
    """Published: 1–2 % (wind tunnel) to 3.3 % (computed, ±4°); a degree of 2/rev should give about a per cent."""
    design = make_design(mu=0.35)
    installed = install(find_actuator("MFC_P1"), default_placement(2), Host(), design.rotor)
    swept = phase_sweep(design, installed, 2)
    share = swept.gross_saving / swept.still.power.total
    assert 0.005 < share < 0.03
    assert swept.best.design.active_twist is not None
    assert swept.best.design.active_twist.harmonics[0].amplitude <= swept.dynamic.amplitude * (1.0 + 1e-12)
    assert swept.power.max() > 0.0  # The wrong phase costs.


@pytest.mark.parametrize("per_rev", [1, 2, 3])
def test_in_thin_air_the_trim_answers_the_plies_as_a_beam(per_rev: int):
    """Tip amplitude against finite elements at that frequency, without air; stiff controls, straight tip."""
    stand = Stand(collective=0.05, density=0.05, tip_mach=0.6)
    design = make_design(mu=0.2, trim="wind-tunnel", stand=stand, inflow="pitt-peters")
    design = replace(design, models=replace(design.models, swept_tip=False))
    installed = install(find_actuator("MFC_P1"), default_placement(2), Host(), design.rotor)
    installed = replace(installed, blade=replace(installed.blade, control_stiffness=1e9))
    made = replace(dynamic_twist(installed, per_rev), installed=installed)

    def wave(turned: Design) -> complex:
        amplitude, phase = tip_response(solve(turned).require(), per_rev)
        return complex(amplitude * np.exp(1j * phase))

    moved = wave(with_harmonic(design, made, 1.0, 0.0)) - wave(installed.on(design))
    assert abs(moved) == pytest.approx(made.amplitude, rel=0.01)
    assert abs(np.degrees(np.angle(moved))) < 2.0


def test_air_damps_and_stiffens_the_answer():
    """At sea level the swept tip's lift holds the blade and the air delays it: the tip follows later and less."""
    design = make_design(mu=0.2)
    installed = install(find_actuator("MFC_P1"), default_placement(2), Host(), design.rotor)
    made = dynamic_twist(installed, 3)
    amplitude, phase = tip_response(solve(with_harmonic(design, made, 1.0, 0.0)).require(), 3)
    assert amplitude < 0.9 * made.amplitude
    assert 5.0 < math.degrees(phase) < 60.0


def test_amplitude_and_phase_of_a_known_wave():
    design = make_design(mu=0.2, preset="thesis")
    active = replace(design, active_twist=ActiveTwist((Harmonic(2, 0.02, 0.7),)))
    assert_allclose(tip_response(solve(active).require(), 2), (0.02, 0.7), rtol=1e-9)


def test_resonance_is_flown_by_an_elastic_blade_and_refused_by_a_rigid_one():
    """At 4/rev with first torsion at 4.04/rev the air holds the tip near its twist at rest; in vacuum nothing does."""
    design = make_design(mu=0.2, inflow="pitt-peters")
    installed = install(find_actuator("MFC_P1"), default_placement(2), Host("new", 0.8), design.rotor)
    assert abs(installed.frequency - 4.0) < 0.05
    with pytest.raises(ValueError, match="too close to the first torsion frequency"):
        dynamic_twist(installed, 4)
    made = dynamic_twist(installed, 4, elastic=True)
    solution = solve(with_harmonic(design, made, 0.2, 0.0)).require()
    assert 0.8 < tip_response(solution, 4)[0] / (0.2 * made.at_rest) < 1.6


@pytest.mark.slow
def test_the_saving_grows_with_speed():
    """Net of its mass 2/rev loses at low speed and gains at high speed, as published."""
    installed = install(find_actuator("MFC_P1_HT"), default_placement(1), Host(), make_design().rotor)
    slow, fast = (phase_sweep(make_design(mu=mu), installed, 2) for mu in (0.15, 0.35))
    assert slow.net_saving is not None
    assert fast.net_saving is not None
    assert slow.net_saving < 0.0 < fast.net_saving
    assert slow.gross_saving > slow.net_saving
    assert fast.gross_saving > fast.net_saving


def test_power_of_twice_per_revolution_vanishes_with_its_amplitude():
    """Driven or not, the blade has one flow: a thousandth of the twist moves power by a thousandth, not by a step."""
    design = make_design(mu=0.3, inflow="pitt-peters")
    installed = install(find_actuator("MFC_P1"), default_placement(2), Host(), design.rotor)
    slight = replace(installed, rest_shapes=1e-3 * installed.rest_shapes)
    full, least = (phase_sweep(design, one, 2) for one in (installed, slight))
    assert_allclose(least.dynamic.at_rest, 1e-3 * full.dynamic.at_rest, rtol=1e-9)
    slope = np.ptp(least.power) / 1e-3
    assert_allclose(slope, np.ptp(full.power), rtol=0.1)
    assert np.abs(least.power).max() < 2e-5 * least.off.power.total
    steady = solve(replace(least.off.design, models=design.models)).require()
    assert abs(steady.power.total - least.off.power.total) > 20.0 * np.abs(least.power).max()  # What the step would be.


@pytest.mark.parametrize("given", ["twist_per_rev=2:{}:90", "pitch_per_rev=3:{}:200"])
def test_what_per_rev_is_compared_with_has_its_flow(given: str):
    """Power less that of the blade at rest is proportional to a small amplitude."""
    name, text = given.split("=")
    by_size: list[dict[str, Any]] = [{name: text.format(size)} for size in (0.02, 0.01)]
    few, fewer = (make_design(mu=0.3, inflow="pitt-peters", **one) for one in by_size)
    changes = [solve(one).require().power.total - solve(at_rest(one)).require().power.total for one in (few, fewer)]
    assert_allclose(changes[0], 2.0 * changes[1], rtol=0.05)
    assert at_rest(few) == at_rest(fewer)


def test_the_flow_at_rest_is_given_only_where_it_would_differ():
    plain = make_design(mu=0.3)
    assert at_rest(plain) == plain
    assert at_rest(turning(plain, Harmonic(1, DEGREE))) == plain
    bent = make_design(mu=0.3, bending=True)
    assert at_rest(turning(bent, Harmonic(2, DEGREE))) == bent
    assert at_rest(turning(plain, Harmonic(2, DEGREE))).models.unsteady == "on"
    steady = make_design(mu=0.3, unsteady="off")
    assert at_rest(turning(steady, Harmonic(2, DEGREE))) == steady
