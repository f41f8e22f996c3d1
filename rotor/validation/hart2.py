"""HART II beside the tunnel, as a set of the trust page: airloads, twist, flapping and tip vortices.

The vortices gave the wake path its one constant, `rotor.aero.lifting_line.STEEPNESS`; nothing else is fitted.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from rotor.aero.lifting_line import WakeCourse
from rotor.support.arrays import Array
from rotor.support.assets import asset_path, csv_rows
from rotor.support.chart import Axis, Chart, Line, Points, Series
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation import airloads
from rotor.validation.trust import TrustRow, TrustSet, description, rms

SET = "hart2-airloads"
LOW_CORRELATION = 0.8
"""Below it a row has a note on its cause. Our choice."""
LARGE_MISS = 0.25
"""|computed − measured| over measured of a harmonic, from which a row has a note on its cause. Our choice."""
_TIP = (("tip_twist_deg", "twist", "°", ".2f", 0.03), ("tip_flap", "flapping", " R", ".4f", 3e-4))
"""Motions of the tip: quantity, what it is called, unit, digits, and by how much its mean may move."""
QUANTITIES = {
    "cn_m2": "C_n M² at 0.87 R",
    "cm_m2": "C_m M² at 0.87 R",
    "tip_twist_deg": "Elastic twist of the tip [°]",
    "tip_flap": "Flap deflection of the tip [z/R]",
}


def measured_vortices(case: str) -> tuple[Array, Array, Array]:
    """Centres of tip vortices of `BL` or `MN` over R: x aft, y to starboard, z up from the hub; (points,) each."""
    rows = [
        row for row in csv_rows(asset_path("measured/hart2_vortices.csv")) if row["case"] == case
    ]
    x, y, z = airloads.columns(rows, *"xyz")
    return x, y, z


def height(course: WakeCourse, x: Array, y: Array) -> Array:
    """z/R of the tip vortices that left the front edge of the disk, where they pass over x, y inside it, (points,).

    A vortex moves along x alone; what passes one place in the disk has left at one azimuth.
    """
    heights = np.empty_like(x)
    for k, (aft, side) in enumerate(zip(x.tolist(), y.tolist(), strict=True)):
        released = math.pi - math.asin(side)
        age = (aft - math.cos(released)) / course.mu_x
        heights[k] = course.nodes(np.array([released + age]), np.array([age]), np.ones(1))[
            0, 0, 0, 2
        ]
    return heights


def cases() -> tuple[airloads.FlownCase, airloads.FlownCase]:
    """BL and MN."""
    baseline, moved = (case for case in airloads.CASES if case.test == SET)
    return baseline, moved


def curves() -> dict[tuple[str, str], airloads.MeasuredCurve]:
    """The measured curves by case and quantity."""
    return {
        (curve.case.name, curve.quantity): curve
        for curve in airloads.measured_curves()
        if curve.case.test == SET
    }


def hart2_set() -> TrustSet:
    """The set of the trust page: airloads, twist and flapping of HART II."""
    solutions = {case.name: solve(case.design()).require() for case in cases()}
    agreements = {
        key: airloads.agreement(curve, solutions[key[0]]) for key, curve in curves().items()
    }
    normal = [agreements[name, "cn_m2"].correlation for name in solutions]
    words = f"C_n M² correlation {normal[0]:.2f}, {normal[1]:.2f}"
    charts = (*_charts(solutions), _vortex_chart(solutions["BL"]))
    return description(SET).page(
        words, _rows(agreements, solutions), charts, points=_points(agreements)
    )


_Agreements = Mapping[tuple[str, str], airloads.CurveAgreement]


def _rows(agreements: _Agreements, solutions: Mapping[str, Solution]) -> Iterator[TrustRow]:
    """Loads, twist, flapping, tip vortices."""
    row = description(SET).row
    for name in solutions:
        size = agreements[name, "cn_m2"].correlation
        what = f"{name}: C_n M² at 0.87 R, correlation"
        note = "normal force" if size < LOW_CORRELATION else ""
        yield row(what, f"{size:.2f}", size, 0.02, note=note)
    for name in solutions:
        size = agreements[name, "cm_m2"].correlation
        yield row(f"{name}: C_m M² at 0.87 R, correlation", f"{size:.2f}", size, 0.03)
    for quantity, motion, unit, digits, allowed in _TIP:
        for name in solutions:
            curve = agreements[name, quantity]
            for n in range(1, airloads.HIGHEST_TIP + 1):
                size, measured = curve.miss(n), curve.amplitude(n, measured=True)
                yield row(
                    f"{name}: tip {motion}, {n}/rev",
                    f"{100 * size:.0f} % of {measured:{digits}}{unit}",
                    size,
                    0.03,
                    note=motion if size > LARGE_MISS else "",
                )
            error = curve.mean - curve.measured_mean
            yield row(
                f"{name}: tip {motion}, mean",
                f"{error:+{digits}}{unit}",
                error,
                allowed,
                note=f"mean {motion}",
            )
    for name, solution in solutions.items():
        size, mean, points = vortex_errors(solution, name)
        what = f"{name}: height of tip vortices, {points} points"
        shown = f"rms {size:.3f} R, mean {mean:+.3f} R"
        yield replace(row(what, shown, size, 2e-3, note="vortices"), verdict="fitted")


def vortex_errors(solution: Solution, case: str) -> tuple[float, float, int]:
    """Root mean square and mean of the height of the tip vortices, computed less measured, over R; number of points."""
    course, (x, y, z) = solution.wake_course, measured_vortices(case)
    assert course is not None
    error = height(course, x, y) - z
    return rms(error), float(error.mean()), len(error)


def _charts(solutions: Mapping[str, Solution]) -> Iterator[Chart]:
    """Loads less their mean, a chart for each case; twist and flapping as they are."""
    beside = curves()
    for quantity in ("cn_m2", "cm_m2"):
        for name, solution in solutions.items():
            measured = beside[name, quantity]
            psi, values = airloads.computed_curve(measured, solution)
            theirs = measured.values - measured.values.mean()
            label = f"{QUANTITIES[quantity]}, {name}, without mean"
            points = Points("measured", np.degrees(measured.psi[::2]), theirs[::2])
            yield airloads.azimuth_chart(
                label,
                label,
                (points, Line("computed", *airloads.closed_around(psi, values - values.mean()), 1)),
            )
    for quantity in ("tip_twist_deg", "tip_flap"):
        series: list[Series] = []
        for k, (name, solution) in enumerate(solutions.items(), start=1):
            measured = beside[name, quantity]
            series.append(Points(f"{name}, measured", np.degrees(measured.psi), measured.values, k))
            series.append(
                Line(
                    "computed",
                    *airloads.closed_around(*airloads.computed_curve(measured, solution)),
                    k,
                )
            )
        yield airloads.azimuth_chart(QUANTITIES[quantity], QUANTITIES[quantity], series)


def _vortex_chart(solution: Solution) -> Chart:
    """Height over x of BL near three planes y."""
    course, (x, y, z) = solution.wake_course, measured_vortices("BL")
    assert course is not None
    series: list[Series] = []
    for k, plane in enumerate((0.4, 0.7, -0.7), start=1):
        here = np.flatnonzero(np.abs(y - plane) < 0.05)
        here = here[np.argsort(x[here])]
        label = f"{'advancing' if plane > 0.0 else 'retreating'}, {abs(plane):g} R, measured"
        series.append(Points(label, x[here], z[here], k))
        along = np.linspace(-math.sqrt(1.0 - plane**2), float(x[here].max()), 30)
        computed = height(course, along, np.full_like(along, plane))
        series.append(Line("computed", along, computed, k))
    return Chart(
        "Tip vortices above the hub, BL",
        Axis("x/R, aft"),
        Axis("z/R of tip vortices, BL"),
        tuple(series),
    )


def _points(agreements: _Agreements) -> tuple[tuple[str, ...], ...]:
    rows: list[tuple[str, ...]] = [
        (
            "Case",
            "Quantity",
            "n",
            "Measured",
            "Measured φ [°]",
            "Computed",
            "Computed φ [°]",
            "Miss [%]",
        )
    ]
    for (name, quantity), beside in agreements.items():
        form = ".2f" if quantity == "tip_twist_deg" else ".5f"
        means = f"{beside.measured_mean:{form}}", f"{beside.mean:{form}}"
        rows.append((name, QUANTITIES[quantity], "mean", means[0], "", means[1], "", ""))
        for n in range(1, len(beside.waves) // 2 + 1):
            size, angle = beside.amplitude(n, measured=True), beside.phase_deg(n, measured=True)
            computed = f"{beside.amplitude(n):{form}}", f"{beside.phase_deg(n):.0f}"
            if float(computed[0]) == 0.0:  # Rigid blades flap at 1/rev alone: the rest is rounding.
                computed = "0", ""
            measured, miss = (f"{size:{form}}", f"{angle:.0f}"), f"{100 * beside.miss(n):.0f}"
            rows.append((name, QUANTITIES[quantity], f"{n}", *measured, *computed, miss))
    return tuple(rows)
