"""Root pitch and twist at n/rev on the page: widgets, links, history, pictures, curves and words; the dial."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.export.provenance import provenance_lines
from explorer.model.inputs import OPENING, baseline_of, with_rotor
from explorer.model.session_state import Pinned
from explorer.parts.actuate import DialNumbers
from explorer.picture.picture import blade_pose, pitch_series
from explorer.scene.controller import motion_of
from explorer.text.design_words import twist_name, wave_words
from explorer.text.status import validated
from explorer.text.why import why
from explorer.views.dial import front_chart, validation_words, with_wave
from explorer.views.dial_answer import DialAnswer, FittedBlade, FrontDot, dial_answer, front_dots
from explorer.widgets.twist_curve import flown_band, shown_twist
from rotor.actuator import (
    HostBlade,
    default_placement,
    effect,
    find_actuator,
    harmonic_share,
    install,
    programmes,
    tip_amplitude,
)
from rotor.actuator.harmonic import bending
from rotor.design.active_twist import Harmonic, read_harmonics
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.vibration import with_harmonics
from rotor.support.chart import Points
from rotor.trim.analysis import Analysis
from rotor.trim.hub_loads import band_inflows, hub_index
from rotor.trim.solve import solve
from tests.actuate import foreseen

PITCH, TWIST = read_harmonics("3:1.5:180,5:0.2:40", "test"), read_harmonics("2:1:30", "test")
MOVED = replace(OPENING, pitch_per_rev=PITCH, twist_per_rev=TWIST)


def test_another_rotor_and_the_baseline_have_none():
    assert with_rotor(MOVED, "s61").design().pitch_waves == ()
    assert baseline_of(MOVED.design()).pitch_waves == ()


def test_a_pinned_design_with_twist_at_n_per_rev_is_on_the_sliders():
    solution = solve(MOVED.design()).require()
    assert not Pinned(MOVED, solution).driven
    assert Pinned(MOVED, solution).sliders(OPENING, along=False) == MOVED
    assert twist_name(MOVED.design()).endswith(", 3 harmonics")
    assert twist_name(replace(MOVED, pitch_per_rev=()).design()).endswith(", 2/rev twist 1.00°")


def test_each_blade_is_drawn_at_the_pitch_of_its_root():
    """The pose, and the series with which the page turns the rotor by itself; in hover there is none."""
    solution = solve(MOVED.design()).require()
    controls, psi = solution.controls, 0.7
    wave = sum(one.amplitude * math.cos(one.per_rev * psi - one.phase) for one in PITCH)
    still = replace(controls, collective=controls.collective + wave)
    hinge = 0.4
    assert_allclose(
        blade_pose(controls, psi, hinge, solution.design).wxyz, blade_pose(still, psi, hinge).wxyz
    )
    series = motion_of(solution)["pitch"]
    assert len(series) == 11
    waves = [1.0, *(one for n in range(1, 6) for one in (math.cos(n * psi), math.sin(n * psi)))]
    cyclic = (
        controls.collective
        + controls.cyclic_1c * math.cos(psi)
        + controls.cyclic_1s * math.sin(psi)
    )
    assert_allclose(np.dot(series, waves), cyclic + wave)
    assert len(pitch_series(controls, MOVED.design().at(hover=True))) == 3


def test_the_twist_curve_has_the_band_of_twist_at_n_per_rev():
    """A rigid blade has the band of the twist alone: at the tip an amplitude to either side of the jig twist."""
    r = np.array([OPENING.aircraft.rotor.blade.root_cutout, 1.0])
    solution = solve(replace(OPENING, twist_per_rev=TWIST, elastic_twist=False).design()).require()
    band = flown_band(solution, r)
    assert band is not None
    mean, low, high = band
    jig, tip = shown_twist(solution.design)(r), math.degrees(TWIST[0].amplitude)
    assert_allclose(mean, jig, atol=1e-9)
    assert_allclose([low[1] - jig[1], high[1] - jig[1]], [-tip, tip], atol=0.02)
    # To the first element.
    assert_allclose([low[0] - jig[0], high[0] - jig[0]], [0.0, 0.0], atol=0.05)
    still = solve(replace(OPENING, elastic_twist=False).design()).require()
    assert flown_band(still, r) is None
    elastic, pitched = (
        flown_band(solve(one.design()).require(), r)
        for one in (OPENING, replace(OPENING, pitch_per_rev=PITCH))
    )
    assert np.ptp([pitched[1][1], pitched[2][1]]) > np.ptp([elastic[1][1], elastic[2][1]]) + 1.0


def test_words():
    before, after = (
        solve(one.design()).require() for one in (OPENING, replace(OPENING, pitch_per_rev=PITCH))
    )
    assert wave_words(MOVED.design()).startswith(
        "active twist of 1.00° at 2/rev (phase 30°) and root pitch of 1.50°"
    )
    assert wave_words(MOVED.design().at(hover=True)) == wave_words(OPENING.design()) == ""
    assert any("root pitch: 3/rev" in line for line in provenance_lines(after))
    assert "Root pitch at 3/rev and 5/rev" in why(before, after)
    assert "No n/rev root pitch" in why(after, before)
    assert (
        "collective and cyclic only"
        in validated(solve(make_design(rotor="xv15", pitch_per_rev="3:1:0"))).sentence
    )


STEADY = make_design(twist="builtin", mu=0.3, off="dynamic-stall")
"""Dynamic stall has kinks: with it, half of what is left out remains at half the twist, in place of an eighth."""
BENDING = replace(STEADY, models=replace(STEADY.models, bending=True))
WAVES = (Harmonic(2, math.radians(0.8), 4.0), Harmonic(3, math.radians(0.5), 0.8))


STILL = replace(BENDING, active_twist=None)
LOSSES = (10e3, 20e3, 0.0, 0.0)
"""Losses of the drive for 1° [W]; far more than there are, so that they are seen."""


def lost(waves: tuple[Harmonic, ...]) -> float:
    """Per cent of power."""
    watts = sum(LOSSES[one.per_rev - 2] * math.degrees(one.amplitude) ** 2 for one in waves)
    return 100.0 * watts / solve(STILL).power.total


@pytest.fixture(scope="module")
def whole() -> list[DialAnswer]:
    """With every inflow model, the design's own first."""
    models = [
        replace(BENDING.models, inflow=one)
        for one in dict.fromkeys((BENDING.models.inflow, *band_inflows()))
    ]
    flown = with_harmonics(BENDING, WAVES)
    return [dial_answer(replace(flown, models=one), LOSSES, 1.0) for one in models]


@pytest.fixture(scope="module")
def answer(whole: list[DialAnswer]) -> DialNumbers:
    return whole[0].numbers


def changes(
    design: Design, before: tuple[Harmonic, ...], after: tuple[Harmonic, ...]
) -> tuple[float, float]:
    """Changes of power and index [%], by two trims."""
    rest, moved = (solve(with_harmonics(design, waves)).require() for waves in (before, after))
    index = hub_index(Analysis(moved).adjoint) / hub_index(Analysis(rest).adjoint)
    return 100.0 * (moved.power.total / rest.power.total - 1.0), 100.0 * (index - 1.0)


def test_what_is_foreseen_is_what_a_trim_gives(answer: DialNumbers):
    power, index = changes(BENDING, (), WAVES)
    seen = foreseen(answer, WAVES)
    assert_allclose(seen[0], power + lost(WAVES), atol=0.25)
    assert_allclose(seen[1], index, atol=8.0)
    assert_allclose(foreseen(answer, ()), 0.0, atol=1e-3)  # To the digits that are sent.


def test_power_is_that_of_the_blades_of_the_design_and_vibration_that_of_blades_that_bend(
    answer: DialNumbers,
):
    rigid = dial_answer(with_harmonics(STEADY, WAVES), LOSSES, 0.0).numbers
    rest, moved = (
        solve(with_harmonics(STEADY, waves)).require().power.total for waves in ((), WAVES)
    )
    lost = sum(LOSSES[one.per_rev - 2] * math.degrees(one.amplitude) ** 2 for one in WAVES)
    assert_allclose(
        0.01 * rigid.power * foreseen(rigid, WAVES)[0], moved - rest + lost, atol=0.0025 * rest
    )
    assert_allclose(rigid.power, rest, rtol=1e-5)
    assert foreseen(rigid, WAVES)[1] == foreseen(answer, WAVES)[1]


def test_the_front_is_near_its_trims(whole: list[DialAnswer], answer: DialNumbers):
    dots = front_dots(whole[0], [one.numbers for one in whole[1:]])
    assert [one.power for one in dots] == sorted(one.power for one in dots)
    own = [foreseen(answer, one.twist)[1] for one in dots]
    assert own == sorted(own, reverse=True)
    for dot in (dots[0], dots[-1]):
        power, index = changes(BENDING, (), dot.twist)
        full = abs(dot.power - power - lost(dot.twist))
        half = tuple(replace(wave, amplitude=0.5 * wave.amplitude) for wave in dot.twist)
        power, _ = changes(BENDING, (), half)
        # What is left out is of third order: an eighth at half the twist, and a quarter would still be second order.
        assert abs(foreseen(answer, half)[0] - power - lost(half)) < max(full / 4.0, 0.02)
        assert full < 0.4
        assert_allclose(foreseen(answer, dot.twist)[1], index, atol=8.0)
        every = [foreseen(one.numbers, dot.twist) for one in whole]
        assert every[0][0] == pytest.approx(dot.power)
        assert np.mean([shaken for _, shaken in every]) == pytest.approx(dot.index)
        assert dot.over_inflows[0] < dot.index < dot.over_inflows[1]


def test_the_room_that_a_steady_voltage_leaves():
    installed = install(find_actuator("MFC_P1"), default_placement(2), HostBlade(), BENDING.rotor)
    assert FittedBlade(installed, (0.0,)).whole == pytest.approx(
        math.degrees(tip_amplitude(installed))
    )
    assert (
        bending(make_design(mu=0.3, twist="builtin", pitch_per_rev="3:1:0", off="dynamic-stall"))
        == BENDING
    )
    low, high = -500.0, 1500.0
    assert harmonic_share(installed, (0.0,)) == 1.0  # Not driven: about the middle.
    assert harmonic_share(installed, (high,)) == harmonic_share(installed, (low,)) == 0.0
    assert harmonic_share(installed, (250.0,)) == pytest.approx(0.75)


def test_an_effect_is_that_of_two_trims():
    flown = with_harmonics(BENDING, WAVES)
    power, index = changes(BENDING, (), WAVES)
    found = effect(flown, BENDING)
    assert len(found.power) == len(found.index) == 4
    rest = solve(BENDING).require()
    # Pitch links and plies do work too.
    assert_allclose(100.0 * found.power[0] / rest.power.total, power, atol=0.1)
    assert_allclose(found.index[0], index, atol=0.1)
    assert effect(make_design(mu=0.0), make_design(mu=0.0)).index == ()
    assert_allclose(effect(make_design(mu=0.1), make_design(mu=0.1)).power, 0.0, atol=1e-3)


def test_a_dot_moves_one_harmonic_alone():
    moved = with_wave(WAVES, 3, 1.0, 420.0)
    assert moved[0] == WAVES[0]
    assert moved[1] == Harmonic(3, math.radians(1.0), math.radians(60.0))
    assert with_wave(WAVES, 3, 0.01, 60.0) == WAVES[:1]
    assert [one.per_rev for one in with_wave(WAVES, 5, 0.4, 0.0)] == [2, 3, 5]


def test_published_programmes_are_told_with_their_sources():
    """As points where power and vibration belong to one input; what wind tunnels measured of vibration, in words."""
    (points,) = [one for one in front_chart(()).series if isinstance(one, Points)]
    shown = [one for one in programmes() if one.together]
    assert list(points.x) == [one.power_change_percent for one in shown]
    assert [one.source in words for one, words in zip(shown, points.words, strict=True)] == [
        True
    ] * 3
    assert "reduced vibration by 50 to 95 %" in validation_words()
    assert "root pitch saved 3 to 5 % of power" in validation_words()
    measured = [one for one in programmes() if one.power_percent and one.kind != "computed"]
    assert {one.short for one in measured} == {"META", "SKAT"}
    assert {one.control for one in measured} == {"root pitch"}


def test_only_where_wakes_agree_in_sign_is_anything_best():
    agreed, apart = (
        FrontDot(WAVES, -0.5, (-0.7, 0.1), -40.0, over) for over in ((-60.0, -20.0), (-60.0, 51.0))
    )
    assert agreed.agreed
    assert not apart.agreed
    labels = [one.label for one in front_chart((agreed, apart)).series if isinstance(one, Points)]
    assert labels[-2:] == ["models agree", "models disagree"]
    words = [one.words for one in front_chart((apart,)).series if isinstance(one, Points)][-1]
    said = "power -0.5 % (-0.7 to +0.1, unclear), vibration -40 % (-60 to +51, unclear) over inflow models"
    assert words[0].replace("−", "-").startswith(said)


def test_the_dial_knows_every_wake(whole: list[DialAnswer]):
    """3/rev adds vibration with linear inflow where it takes vibration away with the lifting line."""
    every = [one.numbers for one in whole]
    waves = [(Harmonic(3, math.radians(0.5), math.radians(phase)),) for phase in range(0, 360, 30)]
    indices = [[foreseen(one, wave)[1] for one in every] for wave in waves]
    assert any(min(changes) < 0.0 < max(changes) for changes in indices)
