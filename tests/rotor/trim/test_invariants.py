"""Symmetry, scaling, grids: what no choice of numbers may change."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.columns.flight import LEAST_AZIMUTHS, flight_system
from rotor.design.design import Design
from rotor.design.structure import BladeStructure
from rotor.design.twist import LinearTwist
from rotor.engine.linearise import System, evaluate, jacobian
from rotor.files.make_design import make_design
from rotor.trim.low_speed import trim_problem
from rotor.trim.solve import solve


def test_scaling_at_fixed_mach_leaves_coefficients():
    """Twice the radius at half the speed of rotation, masses to match: all coefficients and angles stay."""
    design = make_design(mu=0.25)
    rotor, blade, structure = design.rotor, design.rotor.blade, design.rotor.blade.structure
    assert structure is not None
    # Weight does not scale with a speed squared at fixed g, nor skin friction with the Reynolds number twice as large.
    models = replace(design.models, blade_weight=False, radial_friction=False)
    big = replace(
        rotor,
        radius=2.0 * rotor.radius,
        angular_speed=0.5 * rotor.angular_speed,
        reference_chord=2.0 * rotor.reference_chord,
        blade=replace(
            blade,
            chords=tuple(2.0 * c for c in blade.chords),
            flap_inertia=32.0 * blade.flap_inertia,
            flap_static_moment=16.0 * blade.flap_static_moment,
            mass=8.0 * blade.mass,
            structure=BladeStructure(
                radius=2.0 * structure.radius,
                stations=tuple(2.0 * r for r in structure.stations),
                torsional_stiffness=tuple(16.0 * gj for gj in structure.torsional_stiffness),
                mass_per_length=tuple(4.0 * m for m in structure.mass_per_length),
                torsional_inertia=tuple(16.0 * i for i in structure.torsional_inertia),
                tension_gyration=4.0 * structure.tension_gyration,
                clamp=2.0 * structure.clamp,
                control_stiffness=8.0 * structure.control_stiffness,
                pitch_horn=2.0 * structure.pitch_horn,
            ),
        ),
    )
    scaled = replace(
        design,
        rotor=big,
        condition=replace(design.condition, mass=4.0 * design.condition.mass),
        fuselage=replace(design.fuselage, drag_area=4.0 * design.fuselage.drag_area),
        models=models,
    )
    design = replace(design, models=models)
    a, b = solve(design).require(), solve(scaled).require()
    assert_allclose(b.ct, a.ct, rtol=1e-9)
    assert_allclose(b.cp, a.cp, rtol=1e-8)
    for name in ("collective", "cyclic_1c", "cyclic_1s", "shaft_tilt", "coning", "lambda0"):
        assert_allclose(getattr(b.controls, name), getattr(a.controls, name), atol=1e-9)
    assert a.elastic is not None
    assert b.elastic is not None
    assert_allclose(b.elastic.tip, a.elastic.tip, atol=1e-9)
    assert_allclose(b.elastic.pitch_link_load, 4.0 * a.elastic.pitch_link_load, rtol=1e-7)


def test_start_of_azimuth_does_not_matter():
    """Uniform grids of a multiple share stations: 60 azimuths are every second of 120."""
    design = make_design(mu=0.2, inflow="drees")
    coarse = solve(replace(design, models=replace(design.models, azimuths=60))).require()
    fine = solve(design).require()
    assert_allclose(coarse.power.total, fine.power.total, rtol=1e-4)
    assert_allclose(coarse.disk.psi, fine.disk.psi[::2], rtol=1e-14)


def test_warm_start_changes_nothing():
    design = make_design(mu=0.22, twist="linear:-9")
    other = solve(make_design(mu=0.222, twist="linear:-9.5"))
    cold, warm = solve(design).require(), solve(design, other).require()
    assert_allclose(warm.power.total, cold.power.total, rtol=1e-9)
    assert warm.passes <= cold.passes


def test_twist_offset_is_absorbed_by_collective():
    """A constant added to the twist is collective: the same rotor."""
    from rotor.design.twist import TableTwist

    a = solve(make_design(mu=0.2, twist=LinearTwist(-0.2))).require()
    table = TableTwist((0.0, 1.0), (0.3, 0.1))
    b = solve(make_design(mu=0.2, twist=table)).require()
    assert_allclose(b.power.total, a.power.total, rtol=1e-10)


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_low_speed_tends_to_symmetry(preset: str):
    """With no losses and uniform inflow, µ → 0 leaves no azimuthal dependence: hover's limit of the trim."""
    design = make_design(preset=preset, mu=1e-4, twist="linear:-8")
    models = replace(design.models, inflow="uniform", tip_loss=False, hub_loss=False, swirl=False)
    solution = solve(replace(design, models=models)).require()
    assert np.ptp(solution.disk.dct, axis=1).max() < 2e-3 * solution.disk.dct.max()
    assert_allclose(solution.controls.lambda0, math.sqrt(solution.ct / 2.0), rtol=1e-4)


def test_uniform_inflow_hover_limit_is_momentum_theory():
    """µ → 0, uniform inflow: induced power T v_h, within the 10⁻⁴ of µ²."""
    design = make_design(mu=1e-4)
    models = replace(design.models, inflow="uniform", tip_loss=False, hub_loss=False, swirl=False)
    solution = solve(replace(design, models=models)).require()
    assert_allclose(solution.power.induced / design.power_unit, solution.ct**1.5 / math.sqrt(2.0), rtol=1e-4)


@pytest.mark.parametrize(("preset", "mu"), [("flight", 0.0), ("thesis", 0.0), ("flight", 0.3), ("thesis", 0.3)])
def test_elements_converge(preset: str, mu: float):
    """Figs. 3.7, 3.8: power settles with the number of elements; 40 are within 0.6 % of 320, and 80 nearer."""
    design = make_design(preset=preset, twist="linear:-16", mu=mu, inflow="drees")

    def power(elements: int) -> float:
        return solve(replace(design, models=replace(design.models, elements=elements))).require().power.main_rotor

    fine = power(320)
    errors = [abs(power(n) / fine - 1.0) for n in (20, 40, 80)]
    assert errors[1] < 6e-3
    assert errors[2] < errors[0]


def test_azimuths_converge():
    """Fig. 3.9: the document requires at least 100 azimuths; here 120 are within 0.02 % of 720."""
    design = make_design(preset="thesis", twist="linear:-16", mu=0.3)

    def power(azimuths: int) -> float:
        return solve(replace(design, models=replace(design.models, azimuths=azimuths))).require().power.main_rotor

    fine = power(720)
    assert_allclose(power(120), fine, rtol=2e-4)
    assert abs(power(16) / fine - 1.0) > abs(power(120) / fine - 1.0)


def test_reverse_flow_area_is_the_circle():
    """The region r < −µ sin ψ is a circle of diameter µ, area µ²/4 of the disk; the cut-out's part is not blade."""
    design = make_design(mu=0.4)
    fine = solve(
        replace(design, models=replace(design.models, inflow="uniform", swirl=False, elements=400, azimuths=720))
    ).require()
    mu_x = 0.4 * math.cos(fine.controls.shaft_tilt)
    r0 = design.rotor.blade.root_cutout
    psi = math.pi + (np.arange(20_000) + 0.5) * math.pi / 20_000
    edge = np.clip(-mu_x * np.sin(psi), r0, None)
    expected = 0.5 * (edge**2 - r0**2).mean()
    assert_allclose(fine.reverse_flow_area, expected, rtol=5e-3)


@pytest.mark.parametrize("mu", [0.1, 0.35])
@pytest.mark.parametrize("inflow", ["pitt-peters", "local-momentum"])
def test_few_azimuths_stand_for_all(inflow: str, mu: float):
    """The trim on a third of the azimuths, and its derivatives as a step on all: what is left of the error."""
    made = make_design(mu=mu)
    design = replace(made, models=replace(made.models, inflow=inflow))
    whole = solve(design).require()
    few = solve(replace(design, models=replace(design.models, azimuths=LEAST_AZIMUTHS))).require()
    assert few.disk.theta.shape[1] == LEAST_AZIMUTHS
    assert_allclose(few.power.total, whole.power.total, rtol=1e-5)
    assert whole.linear is not None
    system, x = whole.linear.point.system, whole.linear.point.x
    assert system.thin.waves.azimuths == LEAST_AZIMUTHS
    matrices = [jacobian(evaluate(system, grid, x, slopes=True))[0] for grid in (system.grid, system.thin)]
    left = np.eye(len(matrices[0])) - np.linalg.solve(matrices[1], matrices[0])
    assert np.abs(np.linalg.eigvals(left)).max() < 1e-2


def test_azimuths_that_cannot_be_thinned():
    """No fewer than 40 are left, and all of a lifting line."""

    def system(of: Design) -> System:
        return flight_system(trim_problem(of))

    few = make_design(mu=0.2, inflow="drees")
    few = replace(few, models=replace(few.models, azimuths=72))
    whole = system(few)
    assert whole.thin is whole.grid
    assert solve(few).converged
    more = replace(few, models=replace(few.models, azimuths=150))
    assert system(more).thin.waves.azimuths == 50
    line = system(make_design(mu=0.2))
    assert line.thin is line.grid
