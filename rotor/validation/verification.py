"""Verification: our equations beside what they must satisfy, and beside two independent public codes.

Theory: identities, closed forms and integration in time. Codes: dynbem in forward flight, WISDEM's CCBlade in axial
flow. Their numbers are those of the shipped rows: `tests/tools/cross_codes.py` runs the codes.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp  # pyright: ignore[reportUnknownVariableType]

from rotor.aero.disk import azimuths_of
from rotor.aero.inflow.interface import DiskFlow
from rotor.aero.inflow.linear import LinearInflow
from rotor.aero.losses import loss_factor
from rotor.aero.problem import build_problem
from rotor.aero.section import CHANNELS, FZ, LOSS, TH, UP, UR, UT, section
from rotor.columns.hover import closed_form_inflow
from rotor.design.design import Design, with_models
from rotor.engine.waves import waves_at
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Chart, Line, Points
from rotor.trim.analysis import power_gradient
from rotor.trim.forward import first_guess
from rotor.trim.newton import SolverOptions, newton
from rotor.trim.power import profile_power_coefficient
from rotor.trim.solve import solve
from rotor.validation.trust import TrustRow, TrustSet, description, trust_rows

SPEEDS = (0.1, 0.2, 0.3)
"""Advance ratios of the identities, and of dynbem."""
CCBLADE_MASSES = (5000.0, 8322.4)
"""[kg] in hover."""


def theory_set() -> TrustSet:
    """The equations as solved against what they must satisfy."""
    words, (marched, balanced, second) = description("theory"), marched_flapping("thesis", 0.15)
    flapping = math.degrees(np.abs(marched - balanced).max())
    bounds = tuple(
        words.bound(*texts, error(), below, test) for texts, error, below, test in _IDENTITIES
    )
    rest = f"The rest is the neglected 2/rev motion ({math.degrees(second):.2f}°)."
    motion = words.row(
        "First-harmonic flapping, µ 0.15, free flapping",
        f"{flapping:.2f}°",
        flapping,
        0.02,
        against="equation of motion in time",
        note=rest,
    )
    places = range(len(bounds))
    chart = Chart(
        "Errors and their bounds",
        Axis("relative error", log=True),
        Axis(
            names=(
                "ideal twist",
                "closed form (3.3)",
                "parts of the power",
                "gradient by twist",
                "eq. (3.15)",
            )
        ),
        (
            Points("error", [max(row.error or 0.0, 1e-17) for row in bounds], places, 1),
            Points("bound", [row.allowed for row in bounds], places, mark="cross"),
        ),
    )
    met = sum(row.verdict == "met" for row in bounds)
    return words.page(f"{met} of {len(bounds)} within bounds", (*bounds, motion), (chart,))


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
            power = solve(with_models(make_design(mu=mu), inflow=inflow)).require().power
            errors.append(abs(power.shaft / power.main_rotor - 1.0))
    return max(errors)


def _gradient() -> float:
    """Error of ∂P/∂rate at µ 0.25 against differences of 0.001°: section data are C¹, so larger ones straddle knots."""

    def at(rate: float) -> Design:
        return make_design(twist=f"linear:{rate:.9g}", mu=0.25)

    exactly = SolverOptions(
        residual_tolerance=1e-13, inflow_tolerance=1e-12, torsion_tolerance=1e-13
    )
    solution = solve(at(-8.0), options=exactly)
    exact = float(power_gradient(solution).along((solution.disk.r - 0.75)[None])[0])
    step = 0.001
    ends = [
        solve(at(-8.0 + sign * step), solution, exactly).require().power.total for sign in (1, -1)
    ]
    return (ends[0] - ends[1]) / (2.0 * math.radians(step)) / exact - 1.0


def _profile() -> float:
    """∬|U_T|³ over a fine grid against 1 + 3µ² + ⅜µ⁴."""
    n, m, mu = 2000, 720, 0.35
    r = (np.arange(n) + 0.5) / n
    u = np.abs(r[:, None] + mu * np.sin(2.0 * np.pi * np.arange(m) / m))
    return (
        float((u**3).mean()) * 0.5 * 0.0821 * 0.01 / profile_power_coefficient(0.0821, 0.01, mu)
        - 1.0
    )


def marched_flapping(preset: str, mu: float) -> tuple[Array, Array, float]:
    """β0, β1c, β1s [rad] of the motion in time and of the harmonic balance, (3,) each; its amplitude at 2/rev.

    β'' + ν²β = Γ Σ(r − e) dC_T/dr(ψ, β, β') dr − w by Runge–Kutta, its last of 12 turns. The load is that of the
    instant's own β and β' in steady flow, with controls and inflow as trimmed; nothing here uses harmonics.
    """
    design = make_design(
        preset=preset, twist="linear:-10", mu=mu, off="elastic-twist,unsteady,dynamic-stall"
    )
    problem = build_problem(with_models(design, inflow="pitt-peters"))
    trim = newton(problem, first_guess(problem))
    state, elements, model = trim.state, trim.linear.elements, problem.inflow
    assert isinstance(model, LinearInflow)
    disk, flap, flow, loss = (
        problem.disk,
        problem.flap,
        elements.flow,
        trim.point.channels[LOSS, :, :1],
    )
    at_disk = DiskFlow(*design.in_disk_axes(state.shaft_tilt), state.lambda0)
    r, data, arm = disk.r[:, None], problem.section_data(), disk.r - flap.hinge
    spread = np.ones_like(r)
    if problem.design.models.loss_on == "inflow":  # λ_i/F, with F averaged over azimuth.
        around = waves_at(3, azimuths_of(24))
        total = flow.mu_z + model.field(disk.r, around, at_disk)[0]
        spread = 1.0 / loss_factor(r, total, disk.blades, disk.root)[0].mean(axis=1, keepdims=True)

    def rates(psi: float, motion: Array) -> list[float]:
        cos, sin = np.array([math.cos(psi)]), np.array([math.sin(psi)])
        channels = np.zeros((len(CHANNELS), len(r), 1))
        channels[TH] = (
            problem.twist[:, None]
            + state.collective
            + state.cyclic_1c * cos
            + state.cyclic_1s * sin
        )
        channels[UT], channels[UR] = r - elements.swirl[:, None] + flow.mu_x * sin, flow.mu_x * cos
        channels[LOSS] = loss
        channels[UP] = (
            spread * model.field(disk.r, waves_at(3, np.array([psi])), at_disk)[0]
            + arm[:, None] * motion[1]
        )
        channels[UP] += flow.mu_z + flow.mu_x * motion[0] * cos
        moment = float(arm * disk.dr @ section(channels, data, False, False)[0][FZ, :, 0])
        return [
            float(motion[1]),
            flap.load_gain * moment - flap.weight - flap.frequency_squared * float(motion[0]),
        ]

    psi, end = 2.0 * math.pi * np.arange(72) / 72, 24.0 * math.pi
    path = solve_ivp(
        rates, (0.0, end), [0.05, 0.0], t_eval=end - 2.0 * math.pi + psi, rtol=1e-7, atol=1e-9
    )
    assert path.success
    beta: Array = path.y[0]
    marched = np.array(
        [beta.mean(), 2.0 * (beta * np.cos(psi)).mean(), 2.0 * (beta * np.sin(psi)).mean()]
    )
    second = 2.0 * math.hypot((beta * np.cos(2 * psi)).mean(), (beta * np.sin(2 * psi)).mean())
    return marched, np.array([state.coning, state.flap_1c, state.flap_1s]), second


_IDENTITIES = (
    (
        ("Uniform inflow of the ideal twist, eqs. (1.1), (2.28)", "momentum theory"), _ideal_twist, 1e-12,
        "rotor/trim/test_hover.py::test_ideal_twist_gives_uniform_inflow",
    ),
    (
        ("Closed form (3.3) satisfies the annulus balance, F included", "4Fλ²r = ½σC_lα(θr² − λr)"), _closes, 1e-12,
        "rotor/trim/test_hover.py::test_closed_form_closes_the_balance",
    ),
    (
        ("Shaft power is the sum of its parts, three inflow models", "identity"), _energy, 1e-8,
        "rotor/trim/test_power.py::test_energy_identity",
    ),
    (
        ("Gradient of power by linear twist, lifting line", "central differences"), _gradient, 1e-6,
        "rotor/trim/test_gradient.py::test_power_by_the_pitch_of_every_element",
    ),
    (
        ("Profile power with reverse flow, (3.15) corrected", "quadrature of |U_T|³"), _profile, 1e-5,
        "rotor/trim/test_power.py::test_eq_3_15_with_its_first_coefficient_corrected",
    ),
)  # fmt: skip
"""What and against what, the error, its bound, and the test."""


def dynbem_set() -> TrustSet:
    """Pitt–Peters inflow in forward flight."""
    rows = _stored("dynbem")
    power = _percent(rows)
    series = (Line("dynbem's torque over this project's", SPEEDS, power, 1, dots=True),)
    chart = Chart(
        "Torque of dynbem over this project's",
        Axis("advance ratio µ"),
        Axis("difference [%]"),
        series,
    )
    return description("dynbem").page(f"{power[-1]:+.2f} % at most", rows, (chart,))


def ccblade_set() -> TrustSet:
    """Hover, without and with swirl."""
    rows = _stored("ccblade")
    power = _percent(rows)
    series = (
        Line("without swirl", CCBLADE_MASSES, power[0::2], 1, dots=True),
        Line("with swirl", CCBLADE_MASSES, power[1::2], 2, dots=True),
    )
    chart = Chart(
        "Hover power of CCBlade over this project's",
        Axis("mass [kg]"),
        Axis("difference [%]"),
        series,
    )
    return description("ccblade").page(
        f"{power[0]:+.2f} %, with swirl {min(power):+.2f} %", rows, (chart,)
    )


def _stored(name: str) -> list[TrustRow]:
    """The shipped rows of a code, which is run by `tests/tools/cross_codes.py`."""
    return [row for row in trust_rows() if row.set == name]


def _percent(rows: list[TrustRow]) -> tuple[float, ...]:
    return tuple(100.0 * (row.error or 0.0) for row in rows)
