"""Trust rows of the first kind: identities, limits, differences, and our own theories against one another."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp  # pyright: ignore[reportUnknownVariableType]

from rotor.aero import kernel
from rotor.aero.elements import build_problem, evaluate_elements, wake_at
from rotor.arrays import Array
from rotor.assets import SHIPPED_ROTORS
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.reproduce.grids import figure_3_7, figure_3_8, figure_3_9
from rotor.reproduce.trust import TrustRow
from rotor.reproduce.velocities import figure_2_8
from rotor.trim.adjoint import power_gradient
from rotor.trim.forward import first_guess
from rotor.trim.hover import closed_form_inflow
from rotor.trim.newton import newton
from rotor.trim.power import profile_power_coefficient
from rotor.trim.solve import solve

SPEEDS = (0.1, 0.2, 0.3)


def verification() -> Iterator[TrustRow]:
    """The fast rows."""
    yield _bound("Uniform inflow of the ideal twist in hover, eqs. (1.1), (2.28)", "momentum theory", _ideal_twist(),
                 1e-12, "rotor/trim/test_hover.py::test_ideal_twist_gives_uniform_inflow")  # fmt: skip
    yield _bound("Closed form (3.3) closes the annulus balance, F included", "4Fλ²r = ½σC_lα(θr² − λr)", _closes(),
                 1e-12, "rotor/trim/test_hover.py::test_closed_form_closes_the_balance")  # fmt: skip
    yield _bound("Shaft power = induced + profile + parasite, µ 0.1…0.3, three inflow models", "identity", _energy(),
                 1e-8, "rotor/trim/test_power.py::test_energy_identity")  # fmt: skip
    yield _bound("Gradient of power by linear twist, dynamic wake", "central differences", _gradient(), 1e-5,
                 "rotor/aero/test_inflow_reacting.py::test_adjoint_against_differences")  # fmt: skip
    yield _bound("Profile power with reverse flow, (3.15) corrected", "quadrature of |U_T|³", _profile(), 1e-5,
                 "rotor/trim/test_power.py::test_eq_3_15_with_its_first_coefficient_corrected")  # fmt: skip
    flapping, second = _flapping()
    yield TrustRow(
        "verification", "First-harmonic flapping, µ 0.15, free flapping", "the equation of motion marched in time",
        f"{flapping:.2f}°", flapping, 0.02, "rotor/dynamics/test_flapping.py::test_ode_agrees_with_harmonic_balance",
        f"What is left is the neglected 2/rev motion ({second:.2f}°).",
    )  # fmt: skip
    hover, forward, azimuths = figure_3_7(), figure_3_8(), figure_3_9()
    for name, report in (("hover", hover), ("µ 0.30", forward)):
        error = max(report.numbers[f"{preset}_error_at_40"] for preset in ("thesis", "flight"))
        yield _percent(f"Power at 40 elements, {name}", "limit of finer grids", error, 2e-4,
                       "rotor/reproduce/test_chapter_3.py::test_figure_3_7")  # fmt: skip
    error = max(azimuths.numbers[f"{preset}_error_at_100"] for preset in ("thesis", "flight"))
    yield _bound("Power at 100 azimuths, µ 0.30", "720 azimuths", error, 1e-5,
                 "rotor/reproduce/test_chapter_3.py::test_figure_3_9")  # fmt: skip
    area = figure_2_8().numbers
    yield _percent("Reverse-flow area, µ 0.30, counted in cells", "the circle r = −µ sin ψ",
                   area["reverse_area"] / area["circle_area"] - 1.0, 5e-3,
                   "rotor/reproduce/test_chapter_2.py::test_figure_2_8")  # fmt: skip


def between_theories() -> Iterator[TrustRow]:
    """Slow: dynamic wake against the vortex lattice, two theories of finite blades that share no code but the trim."""
    for mu in SPEEDS:
        power = [_total(inflow, mu, -16.0) for inflow in ("dynamic-wake", "vortex-wake")]
        yield _percent(f"Trimmed total power by the dynamic wake, µ {mu:g}, −16°",
                       "the same trim with a vortex lattice wake", power[0] / power[1] - 1.0, 2e-3,
                       "rotor/aero/test_inflow_vortex.py::test_power_agrees")  # fmt: skip
    best = [_best_rate(inflow) for inflow in ("dynamic-wake", "vortex-wake")]
    yield TrustRow(
        "verification", "Best linear twist by the dynamic wake, µ 0.2", "the same with a vortex lattice wake",
        f"{best[0] - best[1]:+.1f}°", best[0] - best[1], 0.1,
        "rotor/aero/test_inflow_vortex.py::test_best_linear_twist_agrees",
        f"{best[0]:.1f}° and {best[1]:.1f}°.",
    )  # fmt: skip
    for name in SHIPPED_ROTORS[1:]:
        design = make_design(rotor=name)
        power = [_main_rotor(design, inflow) for inflow in ("dynamic-wake", "vortex-wake")]
        yield _percent(
            f"{design.rotor.blades} blades ({design.aircraft.name}): main-rotor power, µ 0.2",
            "the same trim with a vortex lattice wake",
            power[0] / power[1] - 1.0,
            2e-3,
            "rotor/files/test_rotors.py::test_dynamic_wake_of_two_and_of_five_blades_is_near_the_vortex_wake",
        )


def _main_rotor(design: Design, inflow: str) -> float:
    """[W]"""
    return solve(replace(design, models=replace(design.models, inflow=inflow))).require().power.main_rotor


def _bound(what: str, against: str, error: float, below: float, test: str) -> TrustRow:
    """An error that is rounding or discretisation: its size matters, not its digits."""
    return TrustRow("verification", what, against, f"below {below:.0e}", abs(error), below, test)


def _percent(what: str, against: str, error: float, allowed: float, test: str) -> TrustRow:
    return TrustRow("verification", what, against, f"{100 * error:+.2f} %", error, allowed, test)


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
    for inflow in ("dynamic-wake", "local-momentum", "pitt-peters"):
        for mu in SPEEDS:
            power = solve(_with_inflow(make_design(mu=mu), inflow)).require().power
            errors.append(abs(power.shaft / power.main_rotor - 1.0))
    return max(errors)


def _gradient() -> float:
    """Of ∂P/∂rate at µ 0.25, by differences of 0.05°."""

    def at(rate: float) -> Design:
        return make_design(twist=f"linear:{rate:.9g}", mu=0.25)

    solution = solve(at(-8.0))
    exact = float(power_gradient(solution).along((solution.disk.r - 0.75)[None])[0])
    step = 0.05
    ends = [solve(at(-8.0 + sign * step), solution).require().power.total for sign in (1, -1)]
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
    state = newton(problem, first_guess(problem)).elements.state
    disk, flap, elements = problem.disk, problem.flap, evaluate_elements(problem, state)
    flow = elements.flow
    r = disk.r

    def rates(psi: float, motion: Array) -> list[float]:
        cos, sin = np.array([math.cos(psi)]), np.array([math.sin(psi)])
        here = replace(disk, psi=np.array([psi]), cos=cos, sin=sin)
        induced = problem.inflow.respond(here, wake_at(problem, state), np.zeros((0, 0))).induced
        theta = (problem.twist + state.collective + state.cyclic_1c * cos + state.cyclic_1s * sin)[:, None]
        u_t = (r + flow.mu_x * sin)[:, None]
        u_p = induced + ((r - flap.hinge) * motion[1] + flow.mu_z + flow.mu_x * motion[0] * cos)[:, None]
        loads = kernel.element_loads(
            theta, u_t, u_p, elements.loss, problem.tip_mach,
            disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
        )  # fmt: skip
        moment = float((r - flap.hinge) @ loads[kernel.FZ, :, 0]) * disk.dr
        return [float(motion[1]), flap.load_gain * moment - flap.weight - flap.frequency_squared * float(motion[0])]

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


def _total(inflow: str, mu: float, rate: float) -> float:
    design = make_design(twist=f"linear:{rate:g}", mu=mu)
    return solve(_with_inflow(design, inflow)).require().power.total


def _best_rate(inflow: str) -> float:
    """Least of a quartic through the powers of six twists [°/R]."""
    rates = np.array([0.0, -4.0, -8.0, -12.0, -16.0, -20.0])
    fit = np.polyfit(rates, [_total(inflow, 0.2, float(rate)) for rate in rates], 4)
    fine = np.linspace(-20.0, 0.0, 2001)
    return float(fine[np.polyval(fit, fine).argmin()])
