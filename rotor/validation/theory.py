"""Verification by theory: identities, closed forms and integration in time."""

import math
from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp  # pyright: ignore[reportUnknownVariableType]

from rotor.aero.inflow.interface import Wake
from rotor.aero.inflow.linear import LinearInflow
from rotor.aero.problem import build_problem, in_disk_axes
from rotor.aero.section import CHANNELS, FZ, LOSS, TH, UP, UT, section
from rotor.arrays import Array
from rotor.columns.hover import closed_form_inflow
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.line_chart import LineChart, Series
from rotor.trim.adjoint import power_gradient
from rotor.trim.forward import first_guess
from rotor.trim.newton import SolverOptions, newton
from rotor.trim.power import profile_power_coefficient
from rotor.trim.solve import solve
from rotor.validation.trust import TrustRow, TrustSet, bound

SPEEDS = (0.1, 0.2, 0.3)


def theory() -> TrustSet:
    """The equations as solved against what they must satisfy."""
    flapping, second = _flapping()
    bounds = (
        bound("theory", "Uniform inflow of the ideal twist, eqs. (1.1), (2.28)", "momentum theory", _ideal_twist(),
              1e-12, "rotor/trim/test_hover.py::test_ideal_twist_gives_uniform_inflow"),
        bound("theory", "Closed form (3.3) satisfies the annulus balance, F included", "4Fλ²r = ½σC_lα(θr² − λr)",
              _closes(), 1e-12, "rotor/trim/test_hover.py::test_closed_form_closes_the_balance"),
        bound("theory", "Shaft power is the sum of its parts, three inflow models", "identity", _energy(), 1e-8,
              "rotor/trim/test_power.py::test_energy_identity"),
        bound("theory", "Gradient of power by linear twist, lifting line", "central differences", _gradient(), 1e-6,
              "rotor/aero/test_inflow_load_dependent.py::test_adjoint_against_differences"),
        bound("theory", "Profile power with reverse flow, (3.15) corrected", "quadrature of |U_T|³", _profile(), 1e-5,
              "rotor/trim/test_power.py::test_eq_3_15_with_its_first_coefficient_corrected"),
    )  # fmt: skip
    rows = (
        *bounds,
        TrustRow(
            "theory", "verification", "First-harmonic flapping, µ 0.15, free flapping",
            "equation of motion in time", f"{flapping:.2f}°", flapping, 0.02,
            "rotor/dynamics/test_flapping.py::test_ode_agrees_with_harmonic_balance",
            f"The rest is the neglected 2/rev motion ({second:.2f}°).",
        ),
    )  # fmt: skip
    places = tuple(map(float, range(len(bounds))))
    chart = LineChart(
        "Errors and their bounds", "relative error", "",
        (
            Series("error", tuple(max(row.error or 0.0, 1e-17) for row in bounds), places, "points", 1),
            Series("bound", tuple(row.allowed for row in bounds), places, "crosses"),
        ),
        log="x",
        names=("ideal twist", "closed form (3.3)", "parts of the power", "gradient by twist", "eq. (3.15)"),
    )  # fmt: skip
    met = sum(row.verdict == "met" for row in bounds)
    return TrustSet(
        "theory", "Theory", "Identities and closed forms", f"{met} of {len(bounds)} within bounds",
        "Momentum theory, identities of the discretised equations, closed forms and integration in time.",
        rows, (chart,),
    )  # fmt: skip


def _ideal_twist() -> float:
    """Spread of λ over its mean, r 0.13…1, linear lift curve, no losses."""
    r = np.linspace(0.13, 1.0, 50)
    inflow = closed_form_inflow(r, 0.12 / r, 0.0821, 5.9)
    return float(np.ptp(inflow) / inflow.mean())


def _closes() -> float:
    r = np.linspace(0.15, 0.99, 50)
    pitch, solidity, slope, factor = 0.25 - 0.15 * r, 0.0821, 5.9, 0.4 + 0.5 * r
    inflow = closed_form_inflow(r, pitch, solidity, slope, factor=factor)
    push = 4.0 * factor * inflow**2 * r
    return float(np.abs(push / (0.5 * solidity * slope * (pitch * r**2 - inflow * r)) - 1.0).max())


def _energy() -> float:
    errors: list[float] = []
    for inflow in ("lifting-line", "local-momentum", "pitt-peters"):
        for mu in SPEEDS:
            power = solve(_with_inflow(make_design(mu=mu), inflow)).require().power
            errors.append(abs(power.shaft / power.main_rotor - 1.0))
    return max(errors)


def _gradient() -> float:
    """Of ∂P/∂rate at µ 0.25, by differences of 0.001°: section data are C¹, so larger ones straddle knots."""

    def at(rate: float) -> Design:
        return make_design(twist=f"linear:{rate:.9g}", mu=0.25)

    exactly = SolverOptions(residual_tolerance=1e-13, inflow_tolerance=1e-12, torsion_tolerance=1e-13)
    solution = solve(at(-8.0), options=exactly)
    exact = float(power_gradient(solution).along((solution.disk.r - 0.75)[None])[0])
    step = 0.001
    ends = [solve(at(-8.0 + sign * step), solution, exactly).require().power.total for sign in (1, -1)]
    return (ends[0] - ends[1]) / (2.0 * math.radians(step)) / exact - 1.0


def _profile() -> float:
    """∬|U_T|³ over a fine grid against 1 + 3µ² + ⅜µ⁴."""
    n, m, mu = 2000, 720, 0.35
    r = (np.arange(n) + 0.5) / n
    u = np.abs(r[:, None] + mu * np.sin(2.0 * np.pi * np.arange(m) / m))
    return float((u**3).mean()) * 0.5 * 0.0821 * 0.01 / profile_power_coefficient(0.0821, 0.01, mu) - 1.0


def _flapping() -> tuple[float, float]:
    """Largest difference of β0, β1c, β1s [°] between balance and marched motion; the marched 2/rev amplitude [°]."""
    design = _with_inflow(make_design(preset="thesis", twist="linear:-10", mu=0.15), "pitt-peters")
    problem = build_problem(design)
    trim = newton(problem, first_guess(problem))
    state, elements, model = trim.state, trim.linear.elements, problem.inflow
    assert isinstance(model, LinearInflow)
    disk, flap, flow, loss = problem.disk, problem.flap, elements.flow, trim.point.channels[LOSS, :, :1]
    wake = Wake(*in_disk_axes(design.condition.advance_ratio, problem.climb, state.shaft_tilt), state.lambda0)
    r, data = disk.r[:, None], problem.section_data(len(disk.psi))

    def rates(psi: float, motion: Array) -> list[float]:
        cos, sin = np.array([math.cos(psi)]), np.array([math.sin(psi)])
        channels = np.zeros((len(CHANNELS), len(r), 1))
        channels[TH] = problem.twist[:, None] + state.collective + state.cyclic_1c * cos + state.cyclic_1s * sin
        channels[UT], channels[LOSS] = r - elements.swirl[:, None] + flow.mu_x * sin, loss
        channels[UP] = model.field(disk.r, cos, sin, wake)[0] + (r - flap.hinge) * motion[1]
        channels[UP] += flow.mu_z + flow.mu_x * motion[0] * cos
        moment = float(problem.arm * disk.dr @ section(channels, data, False, False)[0][FZ, :, 0])
        return [float(motion[1]), flap.load_gain * moment - flap.droop - flap.frequency_squared * float(motion[0])]

    turns, n = 10, 36
    psi = 2.0 * math.pi * np.arange(n) / n
    end = 2.0 * math.pi * turns
    found = solve_ivp(rates, (0.0, end), [0.05, 0.0], t_eval=end - 2.0 * math.pi + psi, rtol=1e-7, atol=1e-9)
    beta: Array = found.y[0]
    marched = (beta.mean(), 2.0 * (beta * np.cos(psi)).mean(), 2.0 * (beta * np.sin(psi)).mean())
    balanced = (state.coning, state.flap_1c, state.flap_1s)
    second = 2.0 * math.hypot((beta * np.cos(2 * psi)).mean(), (beta * np.sin(2 * psi)).mean())
    gap = max(abs(float(a) - float(b)) for a, b in zip(marched, balanced, strict=True))
    return math.degrees(gap), math.degrees(second)


def _with_inflow(design: Design, inflow: str) -> Design:
    return replace(design, models=replace(design.models, inflow=inflow))
