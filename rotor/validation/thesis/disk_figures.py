"""The disk in figures: what the fields on it look like, and how many elements and azimuths it needs.

Figures 2.7 and 2.8: inflow and thrust in hover, and velocities in forward flight. Figures 3.7–3.9: power
against the number of blade elements and of azimuths, with the order of convergence.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from rotor.aero.switches import with_switches
from rotor.design.design import TRIM_AZIMUTHS, with_models
from rotor.files.make_design import make_design
from rotor.support.chart import Axis, Chart, Series
from rotor.trim.solution import DiskFields
from rotor.trim.solve import solve
from rotor.validation.thesis.report import Report, curve, judged, panel, report, table
from rotor.validation.thesis.runs import FLIGHT_LINEAR, variant

Curves = dict[str, list[float]]
FINE_ELEMENTS = 200
"""Elements of fig. 2.7: enough to see the load fall within the last per cent of the blade."""
FAST_MU = 0.30
"""Advance ratio of fig. 2.8; the thesis states none."""


def figure_2_7() -> Report:
    """Inflow and thrust in hover."""
    rows: list[tuple[float | str, ...]] = []
    inflow: list[Series] = []
    thrust: list[Series] = []
    numbers: dict[str, float] = {}
    for k, (preset, twist) in enumerate((("thesis", "linear:-16"), ("flight", "uh60a"))):
        design = make_design(preset=preset, twist=twist, mu=0.0)
        disk = solve(with_models(design, elements=FINE_ELEMENTS, azimuths=8)).require().disk
        lift = disk.dct[:, 0]
        inner, outer = _share(disk, lift, 0.5, 0.9), _share(disk, lift, 0.9, 1.0)
        at_peak = float(disk.r[int(lift.argmax())])
        at_tip = float(lift[-1] / lift.max())
        numbers |= {f"{preset}_share": inner, f"{preset}_tip_share": outer}
        numbers |= {f"{preset}_peak": at_peak, f"{preset}_tip_over_peak": at_tip}
        rows += [
            (preset, r, v, f) for r, v, f in zip(disk.r, disk.induced[:, 0], lift, strict=True)
        ]
        inflow.append(curve(f"{preset}, {twist}", disk.r, disk.induced[:, 0], colour=k))
        thrust.append(curve(f"{preset}, {twist}", disk.r, lift, colour=k))
    good = all(
        numbers[f"{p}_share"] > 0.5 and numbers[f"{p}_tip_over_peak"] < 2 / 3
        for p in ("thesis", "flight")
    )
    return report(
        "2.7",
        judged(good),
        tables=[table("blade", ("preset", "r", "lambda_i", "dct_dr"), rows)],
        panels=[
            panel("Induced velocity / ΩR", "r/R", "λ_i", tuple(inflow)),
            panel("Thrust, the whole rotor as if smeared", "r/R", "dC_T/dr", tuple(thrust)),
        ],
        numbers=numbers,
    )


def figure_2_8() -> Report:
    """Velocities in forward flight, with the reverse-flow region."""
    # The figure shows the geometry: without the swirl, which takes 0.0005 ΩR off U_T and widens the region by 2 %.
    solution = solve(with_switches(make_design(mu=FAST_MU), ("swirl",))).require()
    disk = solution.disk
    mu_x = FAST_MU * math.cos(solution.controls.shaft_tilt)
    expected = _reverse_area(mu_x, float(disk.edges[0]))
    computed = solution.reverse_flow_area
    top, low = float(disk.u_t.max()), float(disk.u_t.min())
    # One cell is 1/40 of the blade by 1/120 of the turn: the border of the region cuts through about 60 of them.
    good = abs(computed - expected) < 0.1 * expected and abs(top - (disk.r[-1] + mu_x)) < 1e-9
    rows = [
        (r, math.degrees(psi), disk.u_t[i, 4 * j])
        for i, r in enumerate(disk.r)
        for j, psi in enumerate(disk.psi[::4])
    ]
    curves = tuple(
        curve(f"ψ = {degrees}°", disk.r, disk.u_t[:, degrees * len(disk.psi) // 360])
        for degrees in (0, 90, 180, 270)
    )
    return report(
        "2.8",
        judged(good),
        tables=[table("u_t", ("r", "psi_deg", "u_t"), rows)],
        panels=[panel("", "r/R", "U_T / ΩR", curves)],
        numbers={"reverse_area": computed, "circle_area": expected, "largest": top, "least": low},
    )


def _share(disk: DiskFields, lift: np.ndarray, low: float, high: float) -> float:
    """Part of the thrust between two radii; elements cut by them count by the part inside."""
    edges = disk.edges
    inside = np.maximum(np.minimum(edges[1:], high) - np.maximum(edges[:-1], low), 0.0)
    return float(inside @ lift / (disk.dr @ lift))


def _reverse_area(mu: float, root: float) -> float:
    """Area of r < −µ sin ψ outside r = root, over πR²: ½∫(µ² sin²ψ − root²)dψ where µ|sin ψ| > root."""
    if mu <= root:
        return 0.0
    edge = math.asin(root / mu)
    span = math.pi - 2.0 * edge
    return (
        0.5 * mu**2 * (0.5 * span + 0.5 * math.sin(2.0 * edge)) - 0.5 * root**2 * span
    ) / math.pi


ELEMENTS = (5, 10, 20, 40, 80, 160, 320)
AZIMUTHS = (8, 12, 16, 24, 36, 48, 72, 100, 120, 180, 360)
FINEST_AZIMUTHS = 720
FORWARD = 0.30
"""Advance ratio of figs. 3.8 and 3.9: "high speed forward flight" in the thesis (p. 21)."""
CONVERGED_PART = 1e-3
"""Part of the power that counts as converged."""
CASES = (("thesis", "linear:-16"), (FLIGHT_LINEAR, "uh60a"))
"""Both with linear inflow: the lifting line has a grid of its own."""


@lru_cache(maxsize=256)
def power_on(name: str, twist: str, mu: float, elements: int, azimuths: int) -> float:
    """Main-rotor power on a grid [kW]."""
    design = variant(name, twist=twist, mu=mu)
    return (
        solve(with_models(design, elements=elements, azimuths=azimuths)).require().power.main_rotor
        / 1e3
    )


SPEEDS = (0.1, 0.2, 0.3, 0.35)
"""Advance ratios of the errors of the default grids."""


def linear_errors(mu: float) -> tuple[float, float]:
    """Errors on the azimuths of linear inflow against 240: power with −8° of twist [-], what −16° add to it [kW]."""
    few, fine = (
        [power_on(FLIGHT_LINEAR, f"linear:{rate}", mu, 40, azimuths) for rate in (-8, -16)]
        for azimuths in (TRIM_AZIMUTHS, 240)
    )
    return few[0] / fine[0] - 1.0, few[1] - few[0] - (fine[1] - fine[0])


@lru_cache(maxsize=16)
def line_error(mu: float) -> float:
    """Error of the power of the default model on its panels and azimuths, against twice as many of both [-]."""
    design = make_design(mu=mu)
    finer = with_models(
        design, panels=2 * design.models.panels, line_azimuths=2 * design.models.line_azimuths
    )
    return solve(design).require().power.main_rotor / solve(finer).require().power.main_rotor - 1.0


def convergence_order(powers: Sequence[float]) -> float:
    """p from powers on grids each twice as fine: the slope of log2 of their differences, over the last four.

    Differences that change sign or jump, as borders of airfoils pass through elements, average out.
    """
    steps = np.abs(np.diff(np.asarray(powers, dtype=float)))[-4:]
    return -float(np.polyfit(np.arange(len(steps)), np.log2(steps), 1)[0])


def figure_3_9() -> Report:
    """Azimuths."""
    powers: Curves = {}
    errors: Curves = {}
    numbers: dict[str, float] = {}
    for name, twist in CASES:
        *powers[name], finest = [
            power_on(name, twist, FORWARD, 40, m) for m in (*AZIMUTHS, FINEST_AZIMUTHS)
        ]
        errors[name] = [abs(power / finest - 1.0) for power in powers[name]]
        numbers |= {
            f"{name}_error_at_100": errors[name][AZIMUTHS.index(100)],
            f"{name}_needed": _needed(AZIMUTHS, errors[name]),
            f"{name}_order": -float(
                np.polyfit(np.log(AZIMUTHS[-4:]), np.log(np.maximum(errors[name][-4:], 1e-12)), 1)[
                    0
                ]
            ),
        }
    worst, needed = (
        max(numbers[f"{name}_{key}"] for name, _ in CASES) for key in ("error_at_100", "needed")
    )
    return report(
        "3.9",
        judged(worst < CONVERGED_PART and needed >= 100),
        tables=[
            table("power_kw", ("azimuths", *powers), zip(AZIMUTHS, *powers.values(), strict=True))
        ],
        panels=_grid_panels(
            "azimuths",
            AZIMUTHS,
            powers,
            errors,
            (100, "thesis: 100"),
            f"{FINEST_AZIMUTHS} azimuths",
        ),
        numbers=numbers,
        millionths=1e6 * worst,
        fewer="" if needed >= 100 else ", but far fewer suffice for power",
    )


def elements_figure(number: str) -> Report:
    """Power against the number of elements: 3.7 in hover, 3.8 in forward flight."""
    mu, azimuths = (0.0, 8) if number == "3.7" else (FORWARD, 120)
    powers: Curves = {}
    errors: Curves = {}
    numbers: dict[str, float] = {}
    for name, twist in CASES:
        row = powers[name] = [power_on(name, twist, mu, n, azimuths) for n in ELEMENTS]
        order = convergence_order(row)
        # Richardson's limit with the order found; the finest grid where the differences hardly fall.
        limit = row[-1] + ((row[-1] - row[-2]) / (2.0**order - 1.0) if order > 1.0 else 0.0)
        errors[name] = [abs(power / limit - 1.0) for power in row]
        numbers |= {
            f"{name}_order": order,
            f"{name}_limit_kw": limit,
            f"{name}_error_at_40": errors[name][ELEMENTS.index(40)],
            f"{name}_needed": _needed(ELEMENTS, errors[name]),
        }
    return report(
        number,
        tables=[
            table("power_kw", ("elements", *powers), zip(ELEMENTS, *powers.values(), strict=True))
        ],
        panels=_grid_panels(
            "elements", ELEMENTS, powers, errors, (40, "40 elements: default"), "the limit"
        ),
        numbers=numbers,
    )


def _grid_panels(
    what: str,
    grid: Sequence[int],
    powers: Curves,
    errors: Curves,
    mark: tuple[int, str],
    reference: str,
) -> tuple[Chart, ...]:
    """Power and its error over the grid, each with a dashed line at the marked one."""
    panels: list[Chart] = []
    for label, rows, words in (
        ("power [kW]", powers, mark[1]),
        (f"relative error to {reference}", errors, ""),
    ):
        curves = [
            curve(name, grid, np.maximum(row, 1e-9), "both", colour=k)
            for k, (name, row) in enumerate(rows.items())
        ]
        values = [value for row in rows.values() for value in np.maximum(row, 1e-9)]
        line = curve(words, (mark[0], mark[0]), (min(values), max(values)), "dashed", colour=7)
        panels.append(
            Chart(
                "", Axis(what, log=rows is errors), Axis(label, log=rows is errors), (*curves, line)
            )
        )
    return tuple(panels)


def _needed(grid: tuple[int, ...], errors: list[float]) -> float:
    """The first grid from which on every error stays within `CONVERGED_PART`; infinite where none is."""
    return next((grid[k] for k in range(len(grid)) if max(errors[k:]) < CONVERGED_PART), math.inf)
