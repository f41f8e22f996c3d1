"""What the thesis omits or misprints, each with two lines of Python that are run to show it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.polynomial.chebyshev import chebval

from rotor.aero.losses import prandtl
from rotor.aero.momentum import glauert_inflow
from rotor.airfoil.polynomial import THESIS_READING, polynomial_section, polynomial_table
from rotor.airfoil.sections import load_section
from rotor.design.design import with_models
from rotor.files.make_design import make_design
from rotor.support.assets import toml_asset
from rotor.trim.solve import solve
from rotor.validation.thesis.report import ReportTable, table
from rotor.validation.thesis.runs import variant

ROUNDING = 1e-9
"""Smaller values are shown as 0."""


@dataclass(frozen=True)
class Misprint:
    """One misprint, ambiguity or omission."""

    equation: str
    kind: str
    """`misprint`, `ambiguous`, or `omission`."""
    printed: str
    corrected: str
    """What this program computes, and why."""
    setting: str
    """First line: a statement."""
    showing: str
    """Second line: an expression of two values, as printed and corrected."""
    unit: str = ""
    page: str = ""


MISPRINTS = tuple(Misprint(**row) for row in toml_asset("misprints.toml")["misprint"])


def shown_values(misprint: Misprint) -> tuple[float, float]:
    """Run the two lines: the value as printed and corrected."""
    names = dict(_names())
    exec(misprint.setting, names)
    printed, corrected = eval(misprint.showing, names)
    return float(printed), float(corrected)


@cache
def _names() -> dict[str, Any]:
    def hover_kw(design: Any, hover: Any) -> float:
        return solve(with_models(design, hover_inflow=hover)).require().power.main_rotor / 1e3

    def induced_kw(name: str, rate: float) -> float:
        return solve(variant(name, twist=f"linear:{rate:g}", mu=0.2)).require().power.induced / 1e3

    def free(series: Any, ends: tuple[float, float], alpha: float) -> float:
        t = (2.0 * alpha - sum(ends)) / (ends[1] - ends[0])
        return float(np.asarray(chebval(t, series.coef), dtype=np.float64))

    theory: tuple[Callable[..., Any], ...] = (
        hover_kw,
        induced_kw,
        free,
        glauert_inflow,
        prandtl,
        make_design,
        solve,
    )
    helpers = (*theory, polynomial_section, polynomial_table, load_section)
    return {"np": np, "reading": THESIS_READING, **{helper.__name__: helper for helper in helpers}}


def misprint_table() -> ReportTable:
    """Every misprint with its lines and what they give."""
    rows: list[tuple[str, ...]] = []
    for misprint in MISPRINTS:
        unit = f" {misprint.unit}" if misprint.unit else ""
        where = ", ".join(
            filter(
                None,
                (misprint.equation, f"p. {misprint.page}" if misprint.page else "", misprint.kind),
            )
        )
        values = (f"{_short(value)}{unit}" for value in shown_values(misprint))
        rows.append(
            (
                where,
                misprint.printed,
                misprint.corrected,
                f"{misprint.setting}\n{misprint.showing}",
                *values,
            )
        )
    return table(
        "misprints",
        ("Equation", "As printed", "Corrected, and why", "Python", "Printed", "Corrected"),
        rows,
    )


def _short(value: float) -> str:
    if not math.isfinite(value):
        return "—"
    return f"{value:.4g}" if abs(value) > ROUNDING else "0"
