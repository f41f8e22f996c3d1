"""The energy identity, the parts of power, and profile power in closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import dblquad

from rotor import TrimState, make_design, solve
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.linear import MODELS
from rotor.aero.problem import build_problem
from rotor.aero.switches import with_switches
from rotor.trim.power import power_budget, profile_power_coefficient, tail_rotor_power
from tests.rotor.at_state import disk_sums, elements_at

TWISTS = ["uh60a", "linear:0", "linear:-16", "segments:-20,-4@0.5", "quadratic:8,-18"]


@pytest.mark.parametrize("inflow", INFLOW_MODELS)
@pytest.mark.parametrize("mu", [0.08, pytest.param(0.2, marks=pytest.mark.slow), 0.35])
@pytest.mark.parametrize("twist", TWISTS)
def test_energy_identity(inflow: str, mu: float, twist: str):
    """P_shaft = Σ(λ_i dF_z + U dD) + D·V: torque, dissipation and trim are computed apart and must meet."""
    solution = solve(make_design(twist=twist, mu=mu, inflow=inflow)).require()
    assert_allclose(solution.power.shaft, solution.power.main_rotor, rtol=1e-9)


def test_section_identity():
    """U_T dF_x + U_R dF_r = U_P dF_z + V dD at every element: steady lift does no work on its own stream."""
    design = make_design(mu=0.35)
    models = replace(design.models, inflow="pitt-peters", unsteady=False, dynamic_stall=False)
    problem = build_problem(replace(design, models=models))
    elements = elements_at(problem, TrimState(0.2, 0.02, -0.1, 0.1, 0.06, 0.0, 0.0, 0.01))
    speed = np.hypot(np.hypot(elements.u_t, elements.u_p), elements.u_r)
    dissipation = problem.disk.half_solidity[:, None] * speed**3 * elements.cd
    left = elements.u_t * elements.fx - elements.u_p * elements.fz + elements.u_r * elements.fr
    assert_allclose(left, dissipation, rtol=1e-9, atol=1e-15)


def test_thesis_torque_is_not_power():
    """As printed (3.6) the shaft sees no axial flow and draws power from the stream: why the parts are summed there."""
    solution = solve(make_design(preset="thesis", mu=0.3)).require()
    assert solution.power.shaft < 0.5 * solution.power.main_rotor


@pytest.mark.parametrize("name", [model.name for model in MODELS])
def test_induced_power_of_linear_inflow_does_not_depend_on_twist(name: str):
    """Induced power is λ0 C_T and a hub-moment term: the same for every twist to 1 % (DESIGN: ≤ 1 kW … of 150–560)."""
    for mu in (0.15, 0.3):
        induced = []
        for twist in ("linear:0", "linear:-8", "linear:-16"):
            induced.append(
                solve(make_design(twist=twist, mu=mu, inflow=name)).require().power.induced
            )
        assert np.ptp(induced) < 0.01 * np.mean(induced)


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.45])
def test_eq_3_15_with_its_first_coefficient_corrected(mu: float):
    """(3.15) by quadrature with σC_d0/4π and −σC_d0/2π; as printed, 2π first, hover would be 2·σC_d0/8."""
    sigma, drag = 0.0821, 0.01
    whole, _ = dblquad(lambda r, psi: (r + mu * math.sin(psi)) ** 3, 0.0, 2.0 * math.pi, 0.0, 1.0)
    reverse, _ = dblquad(
        lambda r, psi: (r + mu * math.sin(psi)) ** 3,
        math.pi,
        2.0 * math.pi,
        0.0,
        lambda psi: -mu * math.sin(psi),
    )
    corrected = sigma * drag * (whole / (4.0 * math.pi) - reverse / (2.0 * math.pi))
    assert_allclose(profile_power_coefficient(sigma, drag, mu), corrected, rtol=1e-10)
    if mu == 0.0:
        assert_allclose(
            sigma * drag * whole / (2.0 * math.pi), 2.0 * sigma * drag / 8.0, rtol=1e-12
        )


@pytest.mark.parametrize("off", [(), ("reverse_flow",)], ids=["", "no reverse flow"])
def test_numerical_profile_power_of_a_constant_drag(off: tuple[str, ...]):
    """σC_d/4π ∬ |r + µ sin ψ|³ over the blade by quadrature; without reverse flow over the rest of it."""
    mu, drag = 0.4, 0.01
    problem = build_problem(with_switches(make_design(preset="thesis", mu=mu), off))
    elements = elements_at(problem, TrimState(lambda0=1e-9))
    assert (problem.unloaded is None) == (not off)
    loaded = 1.0 if problem.unloaded is None else ~problem.unloaded
    pull = (
        drag * loaded * problem.disk.half_solidity[:, None] * np.hypot(elements.u_t, elements.u_p)
    )
    elements = replace(elements, fx=pull * elements.u_t, fz=-pull * elements.u_p)
    budget, rotor = (
        power_budget(problem, elements, disk_sums(problem.disk, elements)),
        problem.design.rotor,
    )
    root = rotor.blade.root_cutout
    whole, _ = dblquad(
        lambda r, psi: abs(r + mu * math.sin(psi)) ** 3, 0.0, 2.0 * math.pi,
        lambda psi: max(root, -mu * math.sin(psi)) if off else root, 1.0,
    )  # fmt: skip
    expected = rotor.solidity * drag * whole / (4.0 * math.pi)
    # midpoint rule in r
    assert_allclose(budget.profile / problem.design.power_unit, expected, rtol=5e-4)


def test_induced_power_of_uniform_inflow_by_hand():
    """Σ λ0 dF_z = λ0 C_T."""
    design = make_design(mu=0.25)
    solution = solve(
        replace(design, models=replace(design.models, inflow="uniform", swirl=False))
    ).require()
    assert_allclose(
        solution.power.induced,
        solution.controls.lambda0 * solution.ct * design.power_unit,
        rtol=1e-9,
    )


# The tail rotor


TAIL = make_design().tail_rotor or pytest.fail("The UH-60A has a tail rotor.")


def test_hover_power_by_hand():
    """T = Q/(l cos 20°); induced T^1.5/√(2ρA)/B; profile σ c̄_d/8 at the mean angle 6C_T/(σa)."""
    torque = 50_000.0
    thrust = torque / (9.926 * math.cos(math.radians(20.0)))
    area, tip = math.pi * 1.6764**2, 124.62 * 1.6764
    unit = 1.225 * area * tip**2
    solidity = 4 * 0.2469 / (math.pi * 1.6764)
    assert_allclose(solidity, 0.1875, atol=1e-4)  # published, TM-85890
    induced = thrust**1.5 / math.sqrt(2.0 * 1.225 * area) / 0.92
    alpha = 6.0 * (thrust / unit) / (solidity * 5.73)
    drag = 0.0087 - 0.0216 * alpha + 0.4 * alpha**2
    profile = solidity * drag / 8.0 * unit * tip
    assert_allclose(tail_rotor_power(TAIL, torque, 0.0, 1.225)[0], induced + profile, rtol=1e-10)


@pytest.mark.parametrize("speed", [0.0, 30.0, 80.0])
@pytest.mark.parametrize("torque", [-4e4, 5e3, 4e4, 9e4])
def test_slope_is_exact(speed: float, torque: float):
    _, slope = tail_rotor_power(TAIL, torque, speed, 1.1)
    difference = (
        tail_rotor_power(TAIL, torque + 1.0, speed, 1.1)[0]
        - tail_rotor_power(TAIL, torque - 1.0, speed, 1.1)[0]
    ) / 2.0
    assert_allclose(slope, difference, rtol=1e-6)
