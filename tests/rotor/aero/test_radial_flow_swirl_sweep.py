"""Yawed drag, swirl, swept tip and download against textbook closed forms and hand calculations."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.aero.losses import loss_factor
from rotor.aero.problem import Problem, build_problem
from rotor.aero.section import FR, FX, FZ, LOSS, PAIRS, TH, UP, UR, UT, M, SectionData, section
from rotor.aero.switches import no_effect, with_switches
from rotor.design.design import BEYOND_DOCUMENT
from rotor.support.arrays import Array
from tests.solved import assert_same_trim


def flow_at(problem: Problem, mu: float) -> Array:
    """Channels of an untwisted blade that does not flap."""
    disk = problem.disk
    channels = np.zeros((6, *disk.shape))
    channels[UT], channels[UP], channels[UR] = disk.r[:, None] + mu * disk.sin, 0.01, mu * disk.cos
    channels[TH], channels[LOSS] = 0.1, 1.0
    return channels


def with_drag_of_one(problem: Problem) -> SectionData:
    """Sections without lift whose C_d is 1."""
    tables = np.zeros_like(problem.section_data().tables)
    tables[:, :, :, 1, 0, 0] = 1.0
    return problem.section_data()._replace(tables=tables)


@pytest.mark.parametrize("mu", [0.1, 0.3, 0.5])
def test_profile_power_and_drag_with_yawed_flow(mu: float):
    """Of constant C_d: C_P0 = σc_d/8 (1 + 4.5µ² + 1.61µ^3.7), C_H = σc_d/8 (3µ + 1.98µ^2.7) (Johnson 1980)."""
    design = make_design(mu=mu)
    blade = replace(design.rotor.blade, root_cutout=0.001, spans=design.rotor.blade.spans[-1:])
    design = replace(
        design, rotor=replace(design.rotor, blade=replace(blade, chord_stations=(0.0, 1.0)))
    )
    problem = build_problem(
        replace(design, models=replace(design.models, elements=400, azimuths=360))
    )
    disk, forces = (
        problem.disk,
        section(flow_at(problem, mu), with_drag_of_one(problem), False, False)[0],
    )
    across: np.ndarray = disk.r[:, None] + mu * disk.sin
    width = disk.dr / len(disk.psi)
    power = width @ (forces[FX] * across + forces[FR] * mu * disk.cos).sum(axis=1)
    drag = width @ (forces[FX] * disk.sin + forces[FR] * disk.cos).sum(axis=1)
    unit = 2.0 * disk.half_solidity.mean() / 8.0
    assert_allclose(power / unit, 1.0 + 4.5 * mu**2 + 1.61 * mu**3.7, rtol=0.01)
    assert_allclose(drag / unit, 3.0 * mu + 1.98 * mu**2.7, rtol=0.02)


def small_problem() -> Problem:
    """Few elements of a blade with a swept tip, elastic in torsion."""
    design = make_design(mu=0.4)
    return build_problem(replace(design, models=replace(design.models, panels=8, line_azimuths=24)))


def test_air_along_the_blade_alone_pulls_along_it():
    """A plate in spanwise flow: F_r = ½σ C_d U_R |U_R|, no lift, no torque."""
    problem = small_problem()
    channels = np.zeros((6, *problem.disk.shape))
    channels[LOSS], channels[UR] = 1.0, 0.3 * problem.disk.cos
    forces = section(channels, with_drag_of_one(problem), False, False)[0]
    pull = problem.disk.half_solidity[:, None] * np.abs(channels[UR]) * channels[UR]
    assert_allclose(forces[FR], pull, rtol=1e-12, atol=1e-15)
    assert np.abs(forces[[FZ, FX]]).max() < 1e-15


def test_without_yaw_the_section_is_that_of_its_plane():
    problem = small_problem()
    channels, data = flow_at(problem, 0.4), problem.section_data()
    channels[UR] = 0.0
    plane = data._replace(yawed=False)
    for yawed, own in zip(
        section(channels, data, True, True), section(channels, plane, True, True), strict=True
    ):
        rows = [
            k
            for k in range(len(own))
            if len(own) < 6 or PAIRS[k] not in ((FR, UR), (FZ, LOSS), (FX, LOSS), (M, LOSS))
        ]
        assert_allclose(yawed[rows], own[rows], rtol=0, atol=1e-14)


def test_slopes_of_yawed_drag_against_differences():
    """All forces by all channels in reverse flow, stall and yaw up to 90°; the step that agrees best counts."""
    problem, random = small_problem(), np.random.default_rng(4)
    data, channels = problem.section_data(), flow_at(problem, 0.4)
    channels[:3] += random.normal(scale=0.1, size=(3, *problem.disk.shape))
    slopes = section(channels, data, True, False)[1]
    for (force, channel), slope in zip(PAIRS, slopes, strict=True):
        if channel != LOSS:
            off = np.inf
            for step in (1e-4, 1e-5, 1e-6):
                ahead, behind = channels.copy(), channels.copy()
                ahead[channel] += step
                behind[channel] -= step
                pair = (section(c, data, False, False)[0][force] for c in (ahead, behind))
                off = np.minimum(off, np.abs((next(pair) - next(pair)) / (2.0 * step) - slope))
            assert off.max() < 3e-7 * np.abs(slopes).max(), (force, channel)


def test_swirl_is_what_the_torque_gives_the_air():
    """An annulus takes a torque 4 r² λ u when the air turns by u at the disk and 2u below: dC_Q = r dF_x."""
    solution = solve(make_design(hover=True)).require()
    disk = solution.disk
    inflow = disk.induced[:, 0]
    swirl = disk.r - disk.u_t[:, 0]
    assert (swirl > 0.0).all()
    middle = (disk.r > 0.3) & (disk.r < 0.9)
    lifting = disk.dct[:, 0] * disk.u_p[:, 0] / disk.u_t[:, 0]  # The part of F_x that lift makes.
    factor, _ = loss_factor(disk.r, inflow, 4, solution.design.rotor.blade.root_cutout)
    turned = 4.0 * factor * disk.r**2 * inflow * swirl
    # What the closed form leaves out, twice λ²/r² and the drag of U_P.
    error = 3.0 * inflow**2 / disk.r**2 + 0.01
    assert (np.abs(turned / (disk.r * lifting) - 1.0) < error)[middle].all()
    assert (error[middle] < 0.12).all()


@pytest.mark.parametrize(
    ("effect", "mu", "low", "high"),
    [
        ("swirl", 0.0, 0.003, 0.012), ("swirl", 0.3, -0.001, 0.002),
        ("swept_tip", 0.0, -3e-3, 1e-3), ("swept_tip", 0.3, -0.04, -0.01),
    ],
)  # fmt: skip
def test_what_an_effect_costs(effect: str, mu: float, low: float, high: float):
    """Swirl is about 1 % of hover power at helicopter disk loadings (Johnson 1980, §2-3) and fades with λ0 λ.

    Sweep saves where the advancing tip is past drag divergence.
    """
    design = make_design(mu=mu)
    with_it, without = (
        solve(d).require().power.total for d in (design, with_switches(design, (effect,)))
    )
    assert low < with_it / without - 1.0 < high


def test_a_swept_tip_sees_the_flow_normal_to_its_quarter_chord():
    """Over the nose U_T cos Λ + µ sin Λ, over the tail U_T cos Λ − µ sin Λ, abeam (1 + µ) r cos Λ."""
    design = make_design(mu=0.3)
    solution = solve(design).require()
    problem = build_problem(design)
    disk, cos, sin = solution.disk, math.cos(math.radians(20.0)), math.sin(math.radians(20.0))
    mu = 0.3 * math.cos(solution.controls.shaft_tilt)
    for azimuth, along in ((0, mu), (30, 0.0), (60, -mu), (90, 0.0)):
        normal = math.hypot(disk.u_t[-1, azimuth] * cos - along * sin, disk.u_p[-1, azimuth])
        assert_allclose(disk.mach[-1, azimuth], normal * problem.tip_mach, rtol=1e-12)
        inboard = math.hypot(disk.u_t[10, azimuth], disk.u_p[10, azimuth])
        assert_allclose(disk.mach[10, azimuth], inboard * problem.tip_mach, rtol=1e-12)


def test_sweep_begins_smoothly_over_one_chord():
    blade, radius = make_design().rotor.blade, make_design().rotor.radius
    half = 0.5 * 0.5273 / 8.1788
    sweep = np.degrees(blade.sweep([0.9286 - half, 0.9286, 0.9286 + half, 1.0], radius))
    assert_allclose(sweep, [0.0, 10.0, 20.0, 20.0], atol=1e-9)


def test_download_is_the_stated_part_in_hover_and_fades_with_the_skew_of_the_wake():
    """Thrust over weight less one: 3.5 % cos²χ, χ the skew of momentum theory's wake, so 45° leaves half."""
    shares = [
        build_problem(make_design(mu=mu)).weight / make_design(mu=mu).weight_coefficient - 1.0
        for mu in (0.0, 0.1)
    ]
    assert_allclose(shares[0], 0.035, rtol=1e-12)
    # λ_h; µ = λ gives χ = 45° where λ⁴·2 = λ_h⁴.
    wake = math.sqrt(make_design().weight_coefficient / 2.0)
    mu = wake / 2.0**0.25
    design = replace(make_design(mu=mu), fuselage=replace(make_design().fuselage, drag_area=0.0))
    assert_allclose(
        build_problem(design).weight / design.weight_coefficient - 1.0, 0.0175, rtol=1e-6
    )
    assert 0.0 < shares[1] < 0.006


def test_a_rough_surface_multiplies_profile_power_in_hover():
    """All section drag 10 % up, thrust and inflow all but the same: profile power 10 % up."""
    design = make_design(hover=True)
    rough = replace(
        design, rotor=replace(design.rotor, blade=replace(design.rotor.blade, surface_drag=1.1))
    )
    smooth, real, off = (
        solve(d).require() for d in (design, rough, with_switches(rough, ("surface_drag",)))
    )
    assert_allclose(real.power.profile / smooth.power.profile, 1.1, rtol=2e-3)
    assert_same_trim(off, smooth)
    assert no_effect(design, "surface_drag")
    assert not no_effect(rough, "surface_drag")


def test_the_document_has_none_of_them():
    for mu in (0.0, 0.3):
        design = make_design(preset="thesis", mu=mu)
        assert_same_trim(solve(design), solve(with_switches(design, BEYOND_DOCUMENT)))
        for name in BEYOND_DOCUMENT:
            assert no_effect(design, name) == "the source document does not have it"
