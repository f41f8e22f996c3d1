"""What the thesis omits or misprints, each with two lines of Python that are run to show it."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.polynomial.chebyshev import chebval

from rotor.aero.losses import prandtl
from rotor.aero.momentum import glauert_inflow
from rotor.airfoil.polynomial import THESIS_READING, polynomial_section, polynomial_table
from rotor.airfoil.sections import load_section
from rotor.files.make_design import make_design
from rotor.reproduce.report import ReportTable, table
from rotor.reproduce.runs import variant
from rotor.trim.solve import solve

ROUNDING = 1e-9
"""Smaller values are shown as 0."""


@dataclass(frozen=True)
class Misprint:
    """One misprint, ambiguity or omission."""

    equation: str
    page: str
    kind: str
    """`misprint`, `ambiguous`, or `omission`."""
    printed: str
    ours: str
    """What this program computes, and why."""
    setting: str
    """First line: a statement."""
    showing: str
    """Second line: an expression of two values, as printed and ours."""
    unit: str = ""


MISPRINTS: tuple[Misprint, ...] = (
    Misprint(
        "2.26", "12", "misprint", "C_T = 4∫λ(λ − λc)² r dr", "4∫λ(λ − λc) r dr, as (2.24): uniform inflow must give "
        "2λ².",
        "lam, r = 0.05, (np.arange(1000) + 0.5) / 1000",
        "4 * np.mean(lam * lam**2 * r), 4 * np.mean(lam * lam * r)",
    ),
    Misprint(
        "2.27", "12", "misprint", "C_Pi = 4∫λ²(λ − λc)² r dr", "4∫λ²(λ − λc) r dr, as (2.25): uniform inflow must "
        "give λC_T.",
        "lam, r = 0.05, (np.arange(1000) + 0.5) / 1000",
        "4 * np.mean(lam**2 * lam**2 * r), 4 * np.mean(lam**2 * lam * r)",
    ),
    Misprint(
        "2.18", "9", "misprint", "dC_P = N_b dF_x Ωy/(ρA(ΩR)²)", "(ΩR)³, as its left side has it. Shown: dC_P of "
        "1 N at 0.75 R, times ρA.",
        "tip_speed, r = 27.0 * 8.1788, 0.75",
        "r * tip_speed / tip_speed**2, r * tip_speed / tip_speed**3",
    ),
    Misprint(
        "2.29", "12", "misprint", "λi = λ0(1 + kx r cos φ + ky r sin φ)",
        "ψ for φ, as (3.4). Shown: the fore-aft range of λi/λ0 at 0.75 R; with φ, the inflow angle, there is none.",
        "kx, phi, psi = 1.9, np.full(360, np.radians(5)), np.radians(np.arange(360))",
        "np.ptp(1 + kx * 0.75 * np.cos(phi)), np.ptp(1 + kx * 0.75 * np.cos(psi))",
    ),
    Misprint(
        "2.30", "13", "omission", "λ0 = C_T/(2√(µ² + λ0²))",
        "√(µx² + (µz + λ0)²): the disk is tilted. Shown: λ0 at µ 0.35 with the shaft 8° forward.",
        "ct, mu, tilt = 0.0067, 0.35, np.radians(8)",
        "glauert_inflow(ct, mu, 0.0)[0], glauert_inflow(ct, mu * np.cos(tilt), mu * np.sin(tilt))[0]",
    ),
    Misprint(
        "2.32", "13", "misprint", "kx = (15π/23) tan(χ/2), named Pitt–Peters",
        "15π/32 is the gain of their three-state matrix (½, 15π/64). Both are kept, by name; measured gradients are "
        "closer to the printed value.",
        "mean, gradient = 1 / 2, 15 * np.pi / 64",
        "15 * np.pi / 23, gradient / mean",
    ),
    Misprint(
        "3.3", "18", "omission", "one lift-curve slope for hover",
        "The closed form needs a straight lift curve; the flight preset balances each annulus with the real curve. "
        "Shown: hover power, linear −16°, flight preset with each.",
        "design = make_design(twist='linear:-16', mu=0.0)",
        "hover_kw(design, 'closed-form'), hover_kw(design, 'annulus')", "kW",
    ),
    Misprint(
        "3.5–3.7", "21, 23", "omission", "reverse flow: only the drag changes its sign",
        "φ by atan2 and section data over ±180°. Shown: Cl at 175°; NACA 0012 measures −0.54 (TN 3361).",
        "alpha = np.radians(175.0)",
        "float(polynomial_table(reading)(alpha, 0.3).cl), float(load_section('sc1095')(alpha, 0.3).cl)",
    ),
    Misprint(
        "3.1, 3.2", "18", "omission", "polynomials of order 10 and 12, range and ends not mentioned",
        "Constant beyond the ends of the fit. Shown: Cl at 30°, extrapolated and constant.",
        "fit, end = polynomial_section(reading), polynomial_section(reading).fit_range",
        "free(fit.cl_series, end, np.radians(30)), float(fit(np.radians(30))[0])",
    ),
    Misprint(
        "3.6", "21", "omission", "U_P without µ sin α ΩR",
        "Through a tilted disk there is axial flow. Without it torque × Ω leaves out the parasite power and the "
        "power that the disk, flapped back, takes from the stream. Shown at µ 0.30: torque × Ω, and the sum of parts "
        "that the thesis preset takes as power.",
        "power = solve(make_design(preset='thesis', mu=0.30)).require().power",
        "power.shaft / 1e3, power.main_rotor / 1e3", "kW",
    ),
    Misprint(
        "3.4 and abstract", "20, ix", "omission", "linear inflow, and twist that evens the inflow",
        "Linear inflow does not respond to the load distribution. Shown: difference in induced power between 0° and "
        "−16° at µ 0.2, as printed and with the lifting line.",
        "spread = lambda name: abs(induced_kw(name, 0) - induced_kw(name, -16))",
        "spread('thesis'), spread('thesis-wake')", "kW",
    ),
    Misprint(
        "3.12", "22", "misprint", "T = ∫∫ Nb Fz dy dψ over 0…2π",
        "1/2π before it: thrust is the mean over a turn. Shown: thrust over weight of a trimmed hover.",
        "one = solve(make_design(preset='thesis', mu=0.0)).require()",
        "2 * np.pi * one.ct / one.design.weight_coefficient, one.ct / one.design.weight_coefficient",
    ),
    Misprint(
        "3.13", "22", "misprint", "P = ∫∫ Nb Ωy Fx dy dψ over 0…2π",
        "1/2π before it, as in (3.12). Shown: shaft power of the same hover.",
        "one = solve(make_design(preset='thesis', mu=0.0)).require()",
        "2 * np.pi * one.power.shaft / 1e3, one.power.shaft / 1e3", "kW",
    ),
    Misprint(
        "3.14", "22", "misprint", "Δy = (1 − Rmin/Rmax)/N", "That is Δr = Δy/R. Shown: N = 40, as printed and in "
        "metres.",
        "root, radius = 0.1304, 8.1788",
        "(1 - root) / 40, radius * (1 - root) / 40", "m",
    ),
    Misprint(
        "3.15", "24", "misprint", "C_P0 = σCd0/2π ∬(r + µ sin ψ)³ …",
        "The first coefficient is σCd0/4π: hover must give σCd0/8. The second, σCd0/2π, is right.",
        "sigma, cd0, r = 0.0821, 0.01, (np.arange(1000) + 0.5) / 1000",
        "sigma * cd0 / (2 * np.pi) * 2 * np.pi * np.mean(r**3), sigma * cd0 / (4 * np.pi) * 2 * np.pi * np.mean(r**3)",
    ),
    Misprint(
        "3.17", "24", "ambiguous", "f = (B/2)(r − rmin)/(rφ) with B ≈ 0.95",
        "Computed as printed. By its form, and in other codes, B would be the number of blades. Shown: F at 0.2 R, λ "
        "0.06.",
        "spacing = 0.5 * (0.20 - 0.1304) / 0.06",
        "float(prandtl(0.95 * spacing)[0]), float(prandtl(4 * spacing)[0])",
    ),
    Misprint(
        "3.19", "24", "omission", "f_drag and A_eq without numbers",
        "Whole aircraft f = 3.265 m² (35.14 ft²). Shown: fuselage drag × speed at µ 0.3 without (0) and with it.",
        "design = make_design(preset='thesis', mu=0.30)",
        "0.0, design.fuselage.drag(design.condition.density, design.airspeed) * design.airspeed / 1e3", "kW",
    ),
    Misprint(
        "§3.2", "25", "misprint", "weight W = 8322.4 kg",
        "A mass. Shown: C_W taken literally in newton, and with g; the second is the round 0.0065 of flight-test "
        "reports.",
        "design = make_design(preset='thesis')",
        "design.condition.mass / design.thrust_unit, design.condition.weight / design.thrust_unit",
    ),
    Misprint(
        "§3.3", "27", "omission", "twist of −13.5°, −16° without a unit",
        "Degrees per radius here; the caption of figure 4.3 says root to tip, over which a blade from 0.1304 R turns "
        "0.87 times that. Shown: what −16° is per radius, read so and read as root to tip.",
        "rate, root = -16.0, make_design(preset='thesis').rotor.blade.root_cutout",
        "rate, rate / (1 - root)", "°/R",
    ),
    Misprint(
        "throughout", "", "misprint", "advanced ratio", "Advance ratio: µ = V/(ΩR). Shown: 90 kt, with and without ΩR.",
        "speed, tip = 90 * 1852 / 3600, 27.0 * 8.1788",
        "speed, speed / tip",
    ),
)  # fmt: skip


def shown_values(misprint: Misprint) -> tuple[float, float]:
    """Run the two lines: the value as printed and ours."""
    names = dict(_names())
    exec(misprint.setting, names)
    printed, ours = eval(misprint.showing, names)
    return float(printed), float(ours)


@cache
def _names() -> dict[str, Any]:
    def hover_kw(design: Any, hover: Any) -> float:
        models = replace(design.models, hover_inflow=hover)
        return solve(replace(design, models=models)).require().power.main_rotor / 1e3

    def induced_kw(name: str, rate: float) -> float:
        return solve(variant(name, twist=f"linear:{rate:g}", mu=0.2)).require().power.induced / 1e3

    def free(series: Any, ends: tuple[float, float], alpha: float) -> float:
        t = (2.0 * alpha - sum(ends)) / (ends[1] - ends[0])
        return float(np.asarray(chebval(t, series.coef), dtype=np.float64))

    helpers: tuple[Callable[..., Any], ...] = (
        hover_kw, induced_kw, free, glauert_inflow, prandtl, make_design, solve, polynomial_section, polynomial_table,
        load_section,
    )  # fmt: skip
    return {"np": np, "reading": THESIS_READING, **{helper.__name__: helper for helper in helpers}}


def misprint_table() -> ReportTable:
    """Every misprint with its lines and what they give."""
    rows: list[tuple[str, ...]] = []
    for misprint in MISPRINTS:
        unit = f" {misprint.unit}" if misprint.unit else ""
        where = ", ".join(
            filter(None, (misprint.equation, f"p. {misprint.page}" if misprint.page else "", misprint.kind))
        )
        values = (f"{_short(value)}{unit}" for value in shown_values(misprint))
        rows.append((where, misprint.printed, misprint.ours, f"{misprint.setting}\n{misprint.showing}", *values))
    return table("misprints", ("Equation", "As printed", "Ours, and why", "Python", "Printed", "Ours"), rows)


def _short(value: float) -> str:
    if not math.isfinite(value):
        return "—"
    return f"{value:.4g}" if abs(value) > ROUNDING else "0"
