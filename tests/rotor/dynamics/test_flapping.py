"""Flapping by harmonic balance against the equation of motion marched in time (the document's ode45)."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotor.aero.elements import BladeElements
from rotor.aero.inflow import INFLOW_MODELS, DiskFlow
from rotor.aero.inflow.linear import LinearInflow
from rotor.aero.losses import loss_factor
from rotor.aero.problem import Problem, build_problem, in_disk_axes
from rotor.aero.section import FZ, LOSS, TH, UP, UR, UT, section
from rotor.arrays import Array
from rotor.dynamics.flapping import flap_dynamics, lock_number
from rotor.files.make_design import make_design, uh60a_rotor
from rotor.trim.forward import first_guess
from rotor.trim.newton import newton


def trimmed(preset: str, mu: float) -> tuple[Problem, BladeElements, Array]:
    """The problem, its trim, and the loss factor of the elements."""
    design = make_design(preset=preset, mu=mu, twist="linear:-10")
    problem = build_problem(replace(design, models=replace(design.models, inflow="pitt-peters", elastic_twist=False)))
    result = newton(problem, first_guess(problem))
    assert result.converged
    return problem, result.linear.elements, result.point.channels[LOSS, :, :1]


def march(problem: Problem, at: BladeElements, loss: Array, revolutions: int) -> np.ndarray:
    """β(ψ) over the last revolution of β'' + ν²β = Γ Σ(r − e) dC_T/dr(ψ, β, β') dr − w, by Runge–Kutta.

    The load is evaluated at the instant's own β and β' with controls and inflow as trimmed; nothing here uses
    harmonics.
    """
    disk, flap, flow, state, data = problem.disk, problem.flap, at.flow, at.state, problem.section_data()
    along, through = in_disk_axes(problem.design.condition.advance_ratio, problem.climb, state.shaft_tilt)
    wake, model, arm = DiskFlow(along, through, state.lambda0), INFLOW_MODELS["pitt-peters"], disk.r - flap.hinge
    assert isinstance(model, LinearInflow)
    spread = np.ones((len(disk.r), 1))
    if problem.design.models.loss_on == "inflow":  # λ_i/F, with F averaged over azimuth.
        around = np.arange(24) * math.pi / 12.0
        total = flow.mu_z + model.field(disk.r, np.cos(around), np.sin(around), wake)[0]
        factor, _ = loss_factor(disk.r[:, None], total, disk.blades, disk.root)
        spread = 1.0 / factor.mean(axis=1, keepdims=True)

    def acceleration(psi: float, beta: float, rate: float) -> float:
        cos, sin = np.array([math.cos(psi)]), np.array([math.sin(psi)])
        c = np.zeros((6, len(disk.r), 1))
        c[TH, :, 0] = problem.twist + state.collective + state.cyclic_1c * cos + state.cyclic_1s * sin
        c[UT, :, 0] = disk.r - at.swirl + flow.mu_x * sin
        c[UP, :, 0] = arm * rate + flow.mu_z + flow.mu_x * beta * cos
        c[UP] += spread * model.field(disk.r, cos, sin, wake)[0]
        c[UR], c[LOSS] = flow.mu_x * cos, loss
        moment = float(arm * disk.dr @ section(c, data, False, False)[0][FZ, :, 0])
        return flap.load_gain * moment - flap.weight - flap.frequency_squared * beta

    end = 2.0 * math.pi * revolutions
    psi = end - 2.0 * math.pi + np.linspace(0.0, 2.0 * math.pi, 73)[:-1]
    answer = solve_ivp(
        lambda t, y: [y[1], acceleration(t, y[0], y[1])], (0.0, end), [0.05, 0.0], t_eval=psi, rtol=1e-7, atol=1e-9
    )
    assert answer.success
    return answer.y[0]


@pytest.mark.parametrize(("preset", "mu"), [("flight", 0.15), ("thesis", 0.15), ("thesis", 0.3)])
def test_ode_agrees_with_harmonic_balance(preset: str, mu: float):
    """First harmonics of the marched motion against the balance: the difference is the neglected 2/rev and higher."""
    problem, at, loss = trimmed(preset, mu)
    beta, state = march(problem, at, loss, revolutions=12), at.state
    psi = np.linspace(0.0, 2.0 * math.pi, 73)[:-1]
    marched = [beta.mean(), 2.0 * (beta * np.cos(psi)).mean(), 2.0 * (beta * np.sin(psi)).mean()]
    balanced = [state.coning, state.flap_1c, state.flap_1s]
    second = math.hypot(2.0 * (beta * np.cos(2 * psi)).mean(), 2.0 * (beta * np.sin(2 * psi)).mean())
    # A 2/rev motion of amplitude b reaches 1/rev only through µ: its velocity 2br meets µ sin ψ (4/3 µb against the
    # damping ∫r³), its slope meets µ cos ψ (2/3 µb). So 2µb bounds what the balance neglects.
    assert_allclose(marched, balanced, atol=2.0 * mu * second + 2e-5)
    assert second < math.radians(0.6)


def test_no_hinge_offset_leaves_no_first_harmonic_moment():
    problem, at, _ = trimmed("thesis", 0.25)
    moment = problem.disk.r * problem.disk.dr @ at.fz
    assert_allclose((moment @ problem.disk.cos, moment @ problem.disk.sin), 0.0, atol=1e-11)


def test_published_flap_frequency_and_lock_number():
    """ν = 1.035/rev and γ = 8.07 for c = 1.73 ft (8.19 published, TM-85890) at a = 5.73, sea level."""
    rotor = uh60a_rotor("flight")
    assert_allclose(math.sqrt(rotor.flap_frequency_squared), 1.035, atol=1e-3)
    assert_allclose(lock_number(rotor, 1.225, 5.73), 8.07, atol=0.05)


def test_document_inertia():
    """13.92 kg/m about a hinge at the centre: m R³/3 = 2539 kg m², Lock number 6.5."""
    rotor = uh60a_rotor("thesis")
    assert_allclose(rotor.blade.flap_inertia, 2539.0, atol=1.0)
    assert_allclose(lock_number(rotor, 1.225, 5.73), 6.5, atol=0.05)
    assert rotor.flap_frequency_squared == 1.0


def test_blade_weight_lowers_the_coning():
    """g S/(I Ω²) = 9.807·385.66/(2050.8·729) = 0.00253 rad."""
    rotor = uh60a_rotor("flight")
    assert_allclose(flap_dynamics(rotor, 1.225, blade_weight=True).weight, 0.00253, atol=1e-5)
    assert flap_dynamics(rotor, 1.225, blade_weight=False).weight == 0.0
