"""The elastic twist in the trim: limits, time march, exact derivatives, energy, phase in flight, sizes."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from patched import Patch
from scipy.integrate import cumulative_trapezoid, solve_ivp

from rotor import Design, Solution, make_design, solve
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.linear import LinearInflow
from rotor.aero.problem import build_problem
from rotor.aero.section import LOSS, RATE, TH, UP, UR, UT, M, section
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.engine.newton import Factors
from rotor.engine.waves import rate_of, wave_grid, waves_at
from rotor.trim.analysis import Analysis
from rotor.trim.forward import first_guess
from rotor.trim.newton import SolverOptions, newton
from tests.solved import assert_same_trim

TIGHT = SolverOptions(residual_tolerance=1e-12, inflow_tolerance=1e-10, torsion_tolerance=1e-12)


def design(
    mu: float, *, inflow: str | None = None, small: bool = False, on: bool = True, **changes: object
) -> Design:
    made = make_design(mu=mu, inflow=inflow) if inflow else make_design(mu=mu)
    grid = {"elements": 16, "azimuths": 48} if small else {}
    return replace(made, models=replace(made.models, elastic_twist=on, **grid, **changes))


def flapping(made: Design) -> Design:
    """With given flapping, active twist and n/rev root pitch, so that every term of the equations is there."""
    active = ActiveTwist((Harmonic(2, 0.02, 0.3), Harmonic(3, 0.02, 1.5)), (0.2, 0.9), (0.0, 1.0))
    pitch = tuple(Harmonic(n, size, 0.5 * n) for n, size in ((2, 0.017), (3, 0.012), (5, 0.005)))
    condition = replace(made.condition, flap_1c=-0.02, flap_1s=0.01)
    return replace(made, condition=condition, active_twist=active, pitch_per_rev=pitch)


def with_structure(made: Design, **changes: object) -> Design:
    blade = made.rotor.blade
    assert blade.structure is not None
    structure = replace(blade.structure, **changes)
    return replace(made, rotor=replace(made.rotor, blade=replace(blade, structure=structure)))


@pytest.mark.parametrize(
    ("mu", "unsteady", "near"), [(0.0, True, 1e-8), (0.25, False, 1e-8), (0.25, True, 3e-5)]
)
def test_a_stiff_blade_is_the_rigid_one(mu: float, unsteady: bool, near: float):
    """GJ and control stiffness × 10⁸: the rigid answer, and to rounding with the effect off.

    In unsteady flow a rigid blade turns about the quarter chord, one with a structure about the axis of its pitch.
    """
    made = design(mu, unsteady=unsteady)
    structure = made.rotor.blade.structure
    stiff = with_structure(
        made,
        torsional_stiffness=tuple(1e8 * gj for gj in structure.torsional_stiffness),
        control_stiffness=1e8 * structure.control_stiffness,
    )
    rigid, off = solve(design(mu, on=False, unsteady=unsteady)).require(), make_design(mu=mu)
    off = replace(off, models=replace(off.models, elastic_twist=False, unsteady=unsteady))
    bare = replace(off, rotor=replace(off.rotor, blade=replace(off.rotor.blade, structure=None)))
    assert_allclose(solve(stiff).require().power.total, rigid.power.total, rtol=near)
    assert_same_trim(solve(off), rigid)
    assert_same_trim(solve(bare), rigid)
    assert rigid.elastic is None
    assert rigid.disk.elastic_twist is None


@pytest.mark.parametrize("inflow", INFLOW_MODELS)
def test_energy(inflow: str):
    """Shaft power is the sum of the parts, to rounding, whatever the pitch does around the disk.

    What pitch links and plies put into the blades is what the air takes, −Σ dC_M θ': all else stores energy.
    """
    made = flapping(design(0.23, inflow=inflow, small=True))
    rigid = solve(
        replace(made, models=replace(made.models, elastic_twist=False)), options=TIGHT
    ).require()
    assert_allclose(rigid.power.shaft, rigid.power.main_rotor, rtol=1e-9)
    solution = solve(made, options=TIGHT).require()
    problem, point = Analysis(solution).linear.problem, Analysis(solution).linear.point
    air = point.forces[M] + 0.5 * problem.torsion.inertia[:, None] * np.sin(
        2.0 * point.channels[TH]
    )
    taken = -problem.disk.dr @ (air * point.channels[RATE]).mean(axis=1)
    assert abs(taken) * made.power_unit > 400.0
    assert_allclose(solution.elastic.control_power, taken * made.power_unit, rtol=1e-6)
    assert_allclose(solution.power.shaft, solution.power.main_rotor, rtol=1e-9)


def test_static_twist_in_hover_by_integration():
    """(GJ_e φ')' = −m with K_θ at the root, in SI, m from the solution's own flow; straight tip."""
    made = design(0.0, swept_tip=False)
    solution = solve(made).require()
    structure, rotor, disk = made.rotor.blade.structure, made.rotor, solution.disk
    metres, speed = disk.r * rotor.radius, rotor.angular_speed
    flow = rotor.tip_speed * np.hypot(disk.u_t, disk.u_p)[:, 0]
    blade = rotor.blade
    coefficient = np.zeros(len(metres))
    chord = np.zeros(len(metres))
    for i, station in enumerate(disk.r):
        inner, outer, blend = blade.section_at(float(station))
        for name, share in ((inner, 1.0 - blend), (outer, blend)):
            section = blade.installed(name)
            moment = section.table.moment(
                disk.alpha[i, 0] - section.incidence_offset, disk.mach[i, 0]
            )
            assert moment is not None
            coefficient[i] += share * float(moment)
            chord[i] += share * section.chord_ratio * float(blade.chord(station))
    air = 0.5 * made.condition.density * flow**2 * chord**2 * coefficient
    inertia = structure.at(metres, structure.torsional_inertia)
    propeller = -inertia * speed**2 * 0.5 * np.sin(2.0 * disk.theta[:, 0])
    built = np.gradient(made.twist(disk.r), metres)

    r = np.linspace(structure.clamp, rotor.radius, 4000)
    pull = structure.centrifugal_force(r, speed) * structure.tension_gyration
    load = np.where(
        r < made.rotor.blade.root_cutout * rotor.radius, 0.0, np.interp(r, metres, air + propeller)
    )
    twisted = np.where((r < metres[0]) | (r > metres[-1]), 0.0, np.interp(r, metres, built))
    outboard = np.flip(cumulative_trapezoid(np.flip(load), -np.flip(r), initial=0))
    slope = (outboard - pull * twisted) / (structure.at(r, structure.torsional_stiffness) + pull)
    turned = outboard[0] / structure.control_stiffness + cumulative_trapezoid(slope, r, initial=0)
    expected = np.interp(metres, r, turned)
    # Two modes, and forty elements with the blade root taken as one: 2 % of the twist at the tip.
    assert_allclose(solution.elastic.along_blade, expected, atol=0.02 * np.abs(expected).max())
    assert_allclose(solution.elastic.control_moment.mean(), -outboard[0], rtol=0.02)


@pytest.mark.slow
def test_harmonic_balance_against_a_time_march():
    """q'' + ν²q = loads at the instant's own φ and φ', by Runge–Kutta, controls and inflow as trimmed."""
    made = design(
        0.3, inflow="pitt-peters", radial_friction=False, unsteady=False, dynamic_stall=False
    )
    problem = build_problem(made)
    result = newton(problem, first_guess(problem))
    assert result.converged
    elements, torsion, disk = result.linear.elements, problem.torsion, problem.disk
    assert isinstance(problem.inflow, LinearInflow)
    state, model, modes = elements.state, problem.inflow, len(torsion.gain)
    tension, wake, data = torsion.tension @ problem.twist, elements.flow, problem.section_data()
    channels = np.zeros((6, len(disk.r), 1))
    channels[LOSS] = result.point.channels[LOSS][:, :1]

    def acceleration(psi: float, y: np.ndarray) -> np.ndarray:
        q, rate = y[:modes], y[modes:]
        cos, sin = math.cos(psi), math.sin(psi)
        cyclic = state.cyclic_1c * cos + state.cyclic_1s * sin
        channels[TH, :, 0] = problem.twist + state.collective + cyclic + q @ torsion.radial
        channels[RATE, :, 0] = state.cyclic_1s * cos - state.cyclic_1c * sin + rate @ torsion.radial
        channels[UT, :, 0] = disk.r - elements.swirl + wake.mu_x * sin
        channels[UP] = model.field(disk.r, waves_at(3, np.array([psi])), wake)[0]
        channels[UP] += wake.mu_z + wake.mu_x * state.coning * cos
        channels[UR] = wake.mu_x * cos
        along = section(channels, data, False, False)[0][M, :, 0] + torsion.inertia * cyclic
        load = (
            torsion.modal(along + torsion.tip_mass * state.coning) + torsion.coupling @ q - tension
        )
        return torsion.frequency**2 * (torsion.gain * load - q)

    waves = wave_grid(torsion.functions, len(disk.psi)).at
    rates = np.array(
        [factor * waves[wave] for wave, factor in map(rate_of, range(torsion.functions))]
    )
    start = elements.torsion.coordinates @ waves[:, 0], elements.torsion.coordinates @ rates[:, 0]
    turns = 10
    span = (0.0, 2.0 * math.pi * turns)
    marched = solve_ivp(
        lambda psi, y: np.concatenate([y[modes:], acceleration(psi, y)]),
        span,
        np.concatenate(start),
        t_eval=span[1] - 2.0 * math.pi + disk.psi[::4],
        max_step=0.02,
        rtol=1e-5,
        atol=1e-7,
    )
    tip = marched.y[:modes].sum(axis=0)
    trimmed = (elements.torsion.coordinates @ waves[:, ::4]).sum(axis=0)
    # Harmonics above the eighth are the difference.
    assert_allclose(tip, trimmed, atol=math.radians(0.01))


def test_nose_down_in_the_second_quadrant_at_high_speed():
    """Flight tests of the UH-60A at high speed: the moment of the tip and the pitch-link load are nose-down in the
    second quadrant (T. H. Maier and W. G. Bousman, "An examination of the aerodynamic moment on rotor blade tips using
    flight test data and analysis", 18th European Rotorcraft Forum, 1992, abstract)."""
    elastic = solve(design(0.36)).require().elastic
    first, second, third, fourth = (float(part.mean()) for part in np.split(elastic.tip, 4))
    assert second < min(first, third, fourth)
    quarter = len(elastic.tip) // 4  # At 75° it is as far nose-down once more.
    assert elastic.tip[quarter : 2 * quarter].min() < elastic.tip.min() + math.radians(0.1)
    load = [float(part.mean()) for part in np.split(elastic.pitch_link_load, 4)]
    assert max(load) == load[1]  # It holds the nose up.


def test_two_modes_suffice(patch: Patch):
    """Power within 0.03 %, the tip within 0.1° and within 0.03° in the mean of six modes."""
    few = solve(design(0.35)).require()
    assert few.shown  # Read with its own modes.
    patch("rotor.aero.problem.TORSION_MODES", 6)
    many = solve(design(0.35)).require()
    assert few.power.total != many.power.total
    assert_allclose(few.power.total, many.power.total, rtol=3e-4)
    assert_allclose(few.elastic.tip, many.elastic.tip, atol=math.radians(0.1))
    assert_allclose(few.elastic.tip.mean(), many.elastic.tip.mean(), atol=math.radians(0.03))


def test_tension_unwinds_a_blade_and_its_tip_mass_lifts_the_nose():
    """Mass behind the axis of a coned blade is pulled down behind it: with a heavier swept tip the nose goes up."""
    light = design(0.0)
    structure = light.rotor.blade.structure
    outside = np.array(structure.stations) > 0.93 * structure.radius
    masses = tuple(np.where(outside, 2.0, 1.0) * np.array(structure.mass_per_length))
    heavy = with_structure(light, mass_per_length=masses, tension_gyration=0.0)
    light = with_structure(light, tension_gyration=0.0)
    assert mean_tip(solve(heavy)) > mean_tip(solve(light))
    # k_A² of zero leaves the blade more nose-down at the tip, by ∫ F k_A² θ'/GJ dr to first order.
    made = design(0.0)
    structure = made.rotor.blade.structure
    without = with_structure(made, tension_gyration=0.0)
    change = mean_tip(solve(made)) - mean_tip(solve(without))
    r = np.linspace(made.rotor.blade.root_cutout * made.rotor.radius, made.rotor.radius, 2000)
    pull = structure.centrifugal_force(r, made.rotor.angular_speed) * structure.tension_gyration
    twist = made.twist(r / made.rotor.radius)
    by_hand = -np.trapezoid(
        pull / structure.at(r, structure.torsional_stiffness) * np.gradient(twist, r), r
    )
    assert by_hand > 0.0
    assert_allclose(change, by_hand, rtol=0.35)  # The propeller moment and the air answer to it.


def mean_tip(solution: Solution) -> float:
    elastic = solution.require().elastic
    return float(elastic.tip.mean())


def test_the_next_trim_uses_the_derivatives_of_the_last(evaluated: list[Factors]):
    """As a cold start answers, without evaluating derivatives; a copy from another process comes without them."""
    start, near = solve(design(0.252), solve(design(0.25))).require(), design(0.254)
    alone = solve(near).require()
    for before, times in ((start, 0), (pickle.loads(pickle.dumps(start)), 1)):
        evaluated.clear()
        assert_allclose(solve(near, before).require().power.total, alone.power.total, rtol=1e-9)
        assert len(evaluated) == times
