"""Twist that follows the azimuth: limits, identity, and what it does to power."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.harmonic import effect, tip_amplitude
from rotor.actuator.installation import InstalledActuator, install, with_actuator_mass
from rotor.actuator.section import HostBlade, default_placement
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.aircraft import Stand
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.solve import solve
from tests.torsion_waves import driven_by_plies, tip_wave

DEGREE = math.radians(1.0)


def turning(design: Design, *harmonics: Harmonic, **shape: tuple[float, ...]) -> Design:
    return replace(design, active_twist=ActiveTwist(harmonics, **shape))


def driven(
    design: Design,
    installed: InstalledActuator,
    per_rev: int,
    share: float = 1.0,
    phase: float = 0.0,
) -> Design:
    """The blade with the plies on it and a share of their amplitude, in the shape that they twist a blade at rest."""
    at_rest = installed.rest_shapes.sum(axis=0)
    shape = tuple((at_rest / at_rest[-1]).tolist())
    wave = Harmonic(per_rev, share * tip_amplitude(installed), phase)
    return installed.on(turning(design, wave, stations=tuple(installed.r.tolist()), shape=shape))


def mfc(design: Design, plies: int = 2, host: HostBlade | None = None) -> InstalledActuator:
    return install(
        find_actuator("MFC_P1"), default_placement(plies), host or HostBlade(), design.rotor
    )


def powers(design: Design, installed: InstalledActuator) -> tuple[list[Design], np.ndarray]:
    """2/rev at twelve phases, and the power that each changes of the blade that is not driven [W]."""
    waves = [
        driven(design, installed, 2, phase=phase)
        for phase in np.linspace(0.0, math.tau, 12, endpoint=False)
    ]
    still = solve(replace(waves[0], active_twist=None)).require()
    return waves, np.array(
        [solve(wave, still).require().power.total - still.power.total for wave in waves]
    )


def test_uniform_once_per_revolution_twist_is_cyclic_pitch():
    """Uniform 1/rev twist equals cyclic pitch: the trim cancels it, and nothing else changes."""
    design = make_design(mu=0.25)
    plain = solve(design).require()
    turned = turning(design, Harmonic(1, 2.0 * DEGREE, 0.5), stations=(0.0, 1.0), shape=(1.0, 1.0))
    solution = solve(turned).require()
    assert_allclose(solution.power.total, plain.power.total, rtol=1e-9)
    shift = 2.0 * DEGREE * np.array([math.cos(0.5), math.sin(0.5)])
    cyclic = [solution.controls.cyclic_1c, solution.controls.cyclic_1s]
    assert_allclose(
        np.array(cyclic) + shift, [plain.controls.cyclic_1c, plain.controls.cyclic_1s], atol=1e-9
    )


def test_twice_per_revolution_saves_power_at_high_speed():
    """Published: 1–2 % (wind tunnel) to 3.3 % (computed, ±4°); a degree of 2/rev should give about a per cent."""
    design = make_design(mu=0.35)
    _, changes = powers(design, mfc(design))
    assert 0.005 < -changes.min() / solve(design).require().power.total < 0.03
    assert changes.max() > 0.0  # The wrong phase costs.


def in_vacuum(installed: InstalledActuator, per_rev: int) -> float:
    """Amplitude of the tip [rad] that half the voltage range makes at a harmonic, without air."""
    beam = installed.beam
    low, high = (beam.r[-1] * end for end in installed.placement.span)
    active = np.diff(np.clip(beam.r, low, high)) / np.diff(beam.r)
    return abs(driven_by_plies(beam, 0.5 * installed.moment * active, per_rev))


@pytest.mark.parametrize("per_rev", [1, 2, 3])
def test_in_thin_air_the_trim_answers_the_plies_as_a_beam(per_rev: int):
    """Tip amplitude against finite elements at that frequency, without air; stiff controls, straight tip."""
    stand = Stand(collective=0.05, density=0.05, tip_mach=0.6)
    design = make_design(mu=0.2, trim="wind-tunnel", stand=stand, inflow="pitt-peters")
    design = replace(design, models=replace(design.models, swept_tip=False))
    installed = mfc(design)
    installed = replace(installed, blade=replace(installed.blade, control_stiffness=1e9))
    moved, still = (
        tip_wave(solve(one).require(), per_rev)
        for one in (driven(design, installed, per_rev), installed.on(design))
    )
    moved -= still
    assert abs(moved) == pytest.approx(in_vacuum(installed, per_rev), rel=0.01)
    assert abs(np.degrees(np.angle(moved))) < 2.0


def test_air_damps_and_stiffens_the_answer():
    """At sea level the swept tip's lift holds the blade and the air delays it: the tip follows later and less."""
    design = make_design(mu=0.2)
    installed = mfc(design)
    wave = tip_wave(solve(driven(design, installed, 3)).require(), 3)
    assert abs(wave) < 0.9 * in_vacuum(installed, 3)
    assert 5.0 < np.degrees(np.angle(wave)) < 60.0


def test_amplitude_and_phase_of_a_known_wave():
    design = make_design(mu=0.2, preset="thesis")
    active = replace(design, active_twist=ActiveTwist((Harmonic(2, 0.02, 0.7),)))
    assert_allclose(tip_wave(solve(active).require(), 2), 0.02 * np.exp(0.7j), rtol=1e-9)


def test_resonance_is_flown_by_an_elastic_blade():
    """At 4/rev with first torsion at 4.04/rev the air holds the tip near its twist at rest; in vacuum nothing does."""
    design = make_design(mu=0.2, inflow="pitt-peters")
    installed = mfc(design, host=HostBlade("new", 0.8))
    assert abs(installed.frequency - 4.0) < 0.05
    wave = tip_wave(solve(driven(design, installed, 4, 0.2)).require(), 4)
    assert 0.8 < abs(wave) / (0.2 * tip_amplitude(installed)) < 1.6


@pytest.mark.slow
def test_the_saving_grows_with_speed():
    """Net of its mass 2/rev loses at low speed and gains at high speed, as published."""
    net = list[float]()
    for mu in (0.15, 0.35):
        design = make_design(mu=mu)
        installed = install(
            find_actuator("MFC_P1_HT"), default_placement(1), HostBlade(), design.rotor
        )
        waves, changes = powers(design, installed)
        loaded = with_actuator_mass(waves[int(changes.argmin())], installed)
        net.append(effect(loaded, design).power[0])
        assert changes.min() < net[-1]
    assert net[1] < 0.0 < net[0]
