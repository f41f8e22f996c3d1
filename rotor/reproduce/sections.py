"""Figures 2.3, 2.4, 3.1–3.6: pressure and forces around sections from XFOIL; polynomial fits of lift and drag."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.polynomial.chebyshev import chebval

from rotor.airfoil.polars import read_polars
from rotor.airfoil.polynomial import (
    DRAG_ORDER,
    FIT_RANGE_DEG,
    LIFT_ORDER,
    FitError,
    fit_error_study,
    fit_polynomials,
    thesis_polar,
)
from rotor.arrays import Array
from rotor.assets import asset_path
from rotor.reproduce.report import Agreement, PlotPanel, Report, ReportTable, curve, judged, table

Coefficient = Literal["lift", "drag"]
ARROW = 0.25
"""Chords per unit of Cp in the arrows."""
PRESSURE_COLUMNS = "x,y,cp,cf"


@dataclass(frozen=True)
class PressureCase:
    """One section in one flow."""

    section: str
    """A bundled outline, or `naca23015`, which XFOIL generates."""
    alpha_deg: float
    mach: float
    reynolds: float
    n_crit: float

    @property
    def file(self) -> str:
        """Path of the shipped result below `assets`."""
        return f"airfoils/{self.section}_alpha{self.alpha_deg:g}.pressure.csv"


PRESSURE_CASES = tuple(PressureCase(name, 3.0, 0.3, 3.68e6, 9.0) for name in ("naca23015", "sc1095", "sc1094r8"))
"""The document gives α 3° for the SC sections; Mach, Reynolds number and transition are our assumptions
throughout."""


@dataclass(frozen=True, eq=False)
class Pressure:
    """Pressure and friction around a section; arrays are ordered as in `Contour`."""

    case: PressureCase
    cl: float
    cd: float
    cm: float
    """XFOIL's own, cm about the quarter chord."""
    x: Array
    y: Array
    """Surface points [chord], x aft along the chord line, y up."""
    cp: Array
    cf: Array
    """Skin friction over free-stream dynamic pressure, positive in the direction of the flow."""

    @property
    def forces(self) -> Array:
        """−Cp n dl of each panel [chord], (panels, 2): the arrows of figs. 2.3, 3.1 and 3.2 times their panel's length.

        A closed outline run from the upper trailing edge forward has its outward normal at (−dy, dx)/dl turned by the
        sense of travel: n dl = (dy, −dx).
        """
        cp = 0.5 * (self.cp + np.roll(self.cp, -1))
        dx, dy = np.roll(self.x, -1) - self.x, np.roll(self.y, -1) - self.y
        return np.stack((-cp * dy, cp * dx), axis=1)

    def integrated_lift(self) -> float:
        """cl of the pressure alone, normal to the free stream: the sum of `forces` turned by α."""
        along, up = self.forces.sum(axis=0)
        alpha = np.deg2rad(self.case.alpha_deg)
        return float(up * np.cos(alpha) - along * np.sin(alpha))

    def integrated_moment(self) -> float:
        """cm about the quarter chord of the pressure alone, nose-up positive."""
        force = self.forces
        x = 0.5 * (self.x + np.roll(self.x, -1)) - 0.25
        y = 0.5 * (self.y + np.roll(self.y, -1))
        return float((force[:, 0] * y - force[:, 1] * x).sum())


def read_pressure(case: PressureCase) -> Pressure:
    """The shipped result. Raises ValueError when the file is damaged."""
    text = asset_path(case.file).read_text(encoding="utf-8")
    found = re.search(r"^# cl (\S+), cd (\S+), cm (\S+)$", text, re.MULTILINE)
    body = [line for line in text.splitlines() if line and not line.startswith("#")]
    if found is None or body[0] != PRESSURE_COLUMNS:
        raise ValueError(f"{case.file} is not a pressure file: restore it, or rebuild it with XFOIL")
    data = np.array([[float(word) for word in line.split(",")] for line in body[1:]])
    cl, cd, cm = (float(word) for word in found.groups())
    return Pressure(case, cl, cd, cm, data[:, 0], data[:, 1], data[:, 2], data[:, 3])


FORCES = {
    "2.3": ("naca23015", "NACA 23015", "XFOIL gives how the forces are distributed around a section (p. 9–10)."),
    "3.1": ("sc1095", "SC1095", "The SC1095 of the UH-60A at 3° (p. 17)."),
    "3.2": ("sc1094r8", "SC1094 R8", "The SC1094 R8 of the UH-60A at 3° (p. 18)."),
}
"""By number: the section, its name, and what the thesis says."""


def shipped(section: str) -> Pressure:
    """The shipped XFOIL run of a section."""
    return read_pressure(next(case for case in PRESSURE_CASES if case.section == section))


def figure_2_4() -> Report:
    """Pressure on NACA 23015."""
    pressure = shipped("naca23015")
    nose = int(np.argmin(pressure.x))
    upper, lower = slice(None, nose + 1), slice(nose, None)
    peak = int(np.argmin(pressure.cp))
    stagnation = float(pressure.cp.max())
    expected = _stagnation_pressure(pressure.case)
    good = abs(stagnation / expected - 1.0) < 0.02 and peak < nose
    return Report(
        number="2.4",
        caption="Pressure coefficient on the upper and lower side of NACA 23015. The thesis states neither angle nor "
        f"flow; ours: {_flow(pressure.case)}.",
        statement="XFOIL gives how the pressure coefficient changes over the top and the bottom of a section (p. 9).",
        ours=f"Least Cp {pressure.cp[peak]:.2f} at {100 * pressure.x[peak]:.0f} % chord on the upper side; largest "
        f"{stagnation:.3f}, where isentropic flow at rest has {expected:.3f}.",
        verdict=Agreement.ALONE if good else Agreement.DIFFERS,
        because="Nothing to compare with. The stagnation pressure is that of compressible flow, and suction sits on "
        "the upper side.",
        tables=(_table(pressure),),
        panels=(
            PlotPanel(
                "x/c",
                "Cp",
                (
                    curve("upper side", pressure.x[upper], pressure.cp[upper]),
                    curve("lower side", pressure.x[lower], pressure.cp[lower]),
                ),
                invert_y=True,
            ),
        ),
        numbers={"cp_min": float(pressure.cp[peak]), "stagnation": stagnation, "isentropic": expected},
    )


def force_figure(number: str) -> Report:
    """Pressure forces around a section; `number` is one of `FORCES`."""
    section, title, statement = FORCES[number]
    pressure = shipped(section)
    integrated = pressure.integrated_lift()
    gap = integrated / pressure.cl - 1.0
    beside = _beside_polar(pressure)
    return Report(
        number=number,
        caption=f"Pressure forces around {title}: arrows of −Cp normal to the surface; {_flow(pressure.case)}. "
        "Angle, Mach and Reynolds number are ours where the thesis is silent.",
        statement=statement,
        ours=f"cl {pressure.cl:.3f}, cd {pressure.cd:.5f}, cm {pressure.cm:.3f}; the arrows add up to cl "
        f"{integrated:.3f} ({round(100 * gap, 2) + 0.0:+.2f} %). {beside[0]}".rstrip(),
        verdict=Agreement.ALONE if abs(gap) < 5e-3 else Agreement.DIFFERS,
        because="The arrows integrate to XFOIL's lift, which verifies order, sign and scale, not XFOIL; the thesis "
        "gives no number to compare.",
        tables=(_table(pressure),),
        panels=(_arrows(pressure),),
        numbers={"cl": pressure.cl, "cl_integrated": integrated, "cd": pressure.cd, **beside[1]},
    )


def _beside_polar(pressure: Pressure) -> tuple[str, dict[str, float]]:
    """The tripped polar behind the flown deck, at the same angle."""
    if pressure.case.section == "naca23015":
        return "", {}
    polars = read_polars(asset_path(f"airfoils/{pressure.case.section}_trip5.polars.csv")).polars
    tripped = next(polar for polar in polars if abs(polar.mach - pressure.case.mach) < 1e-9)
    at = pressure.case.alpha_deg
    cl = float(np.interp(at, tripped.alpha_deg, tripped.cl))
    cd = float(np.interp(at, tripped.alpha_deg, tripped.cd))
    words = f"Tripped at 5 % chord, as the flown deck has it: cl {cl:.3f}, cd {cd:.5f}. "
    return words, {"cl_tripped": cl, "cd_tripped": cd}


def _arrows(pressure: Pressure) -> PlotPanel:
    length = np.hypot(np.roll(pressure.x, -1) - pressure.x, np.roll(pressure.y, -1) - pressure.y)
    arrow = ARROW * pressure.forces / np.maximum(length, 1e-9)[:, None]
    push = pressure.cp + np.roll(pressure.cp, -1) > 0.0
    outline = curve("outline", np.append(pressure.x, pressure.x[0]), np.append(pressure.y, pressure.y[0]), colour=7)
    curves = [outline]
    for label, chosen, colour in (("suction", ~push, 0), ("pressure", push, 1)):
        x: list[float] = []
        y: list[float] = []
        for k in np.flatnonzero(chosen)[:-1:2]:
            # Suction points outward from the surface, pressure inward and is drawn ending on it.
            start = np.array([pressure.x[k], pressure.y[k]])
            tail, head = (start, start + arrow[k]) if label == "suction" else (start - arrow[k], start)
            x += [float(tail[0]), float(head[0]), float("nan")]
            y += [float(tail[1]), float(head[1]), float("nan")]
        curves.append(curve(label, x, y, colour=colour))
    return PlotPanel("x/c", "y/c", tuple(curves), equal=True)


def _flow(case: PressureCase) -> str:
    return f"α {case.alpha_deg:g}°, Mach {case.mach:g}, Re {case.reynolds / 1e6:.2f} million, Ncrit {case.n_crit:g}"


def _stagnation_pressure(case: PressureCase) -> float:
    """Cp of flow brought to rest isentropically: ((1 + 0.2 M²)^3.5 − 1)/(0.7 M²)."""
    square = case.mach**2
    return ((1.0 + 0.2 * square) ** 3.5 - 1.0) / (0.7 * square)


def _table(pressure: Pressure) -> ReportTable:
    rows = zip(pressure.x, pressure.y, pressure.cp, pressure.cf, strict=True)
    return table("pressure", ("x_over_c", "y_over_c", "cp", "cf"), rows)


RANGES = ((-10.0, 15.0), (-10.0, 20.0))
"""Ranges of the fit [deg]: ours, and one that reaches into stall. The thesis states none."""
GOOD = 0.01
"""Part of the coefficient's own spread over the range that a good compromise may miss."""
ATTACHED_DEG = (-4.0, 8.0)
"""Where a blade flies: drag there decides power."""


FITS: dict[str, tuple[Coefficient, int]] = {
    "3.3": ("lift", LIFT_ORDER),
    "3.4": ("drag", DRAG_ORDER),
    "3.5": ("lift", LIFT_ORDER),
    "3.6": ("drag", DRAG_ORDER),
}
"""By number: the coefficient, and the order of the thesis."""


def error_figure(number: str) -> Report:
    """Error of a fit against its order; `number` is 3.3 or 3.4."""
    which, chosen = FITS[number]
    polar = thesis_polar()
    studies = {low_high: fit_error_study(polar, low_high) for low_high in RANGES}
    numbers: dict[str, float] = {}
    for low, high in RANGES:
        errors = {one.order: _rms(one, which) for one in studies[low, high]}
        name = f"{low:g}_{high:g}"
        numbers |= {
            f"at_{name}": errors[chosen],
            f"from_2_{name}": errors[2] / errors[chosen],
            f"last_step_{name}": errors[chosen - 2] / errors[chosen],
            f"next_step_{name}": errors[chosen] / errors[chosen + 2],
        }
    spread = _spread(which)
    share = numbers["at_-10_15"] / spread
    knee = knee_of([(one.order, _rms(one, which)) for one in studies[RANGES[0]]])
    enough = next(one.order for one in studies[RANGES[0]] if _rms(one, which) < GOOD * spread)
    rows = [
        (one.order, *(_rms(studies[pair][k], which) for pair in RANGES)) for k, one in enumerate(studies[RANGES[0]])
    ]
    symbol = "Cl" if which == "lift" else "Cd"
    panel = PlotPanel(
        "polynomial order",
        f"rms error of {symbol}",
        tuple(
            curve(f"α {low:g}…{high:g}°", [r[0] for r in rows], [r[k + 1] for r in rows], "both")
            for k, (low, high) in enumerate(RANGES)
        )
        + tuple(
            curve(f"{words} {order}", (order, order), (min(r[1] for r in rows), max(r[2] for r in rows)), "dashed")
            for words, order in (("thesis: order", chosen), ("our knee: order", knee))
        ),
        log="y",
    )
    return Report(
        number=number,
        caption=f"Error of the {which} polynomial of SC1095 against its order, over two ranges of α. Data: XFOIL, M "
        "0.3, Re 3.68 million, Ncrit 9 (our assumption; the thesis states range and flow nowhere).",
        statement=f"Order {chosen} is a good compromise between error and cost (p. 18).",
        ours=f"Order {chosen}: rms {numbers['at_-10_15']:.5f} over −10…15°, {100 * share:.2f} % of the spread of "
        f"{symbol}; {numbers['from_2_-10_15']:.0f} times better than order 2. Over −10…20° the step to it from order "
        f"{chosen - 2} gains a factor {numbers['last_step_-10_20']:.2f}, the step to order {chosen + 2} another "
        f"{numbers['next_step_-10_20']:.2f}.",
        verdict=judged(knee == chosen),
        because=f"Our knee over −10…15° is at order {knee}, and the error is below {100 * GOOD:.0f} % of the spread "
        f"from order {enough} on. There is no plateau: a higher order always helps slightly, because stall is a kink.",
        tables=(table("error", ("order", *(f"rms_{low:g}_{high:g}_deg" for low, high in RANGES)), rows),),
        panels=(panel,),
        numbers={**numbers, "share_of_spread": share, "knee": knee, "enough": enough},
    )


def knee_of(points: Sequence[tuple[int, float]]) -> int:
    """The order whose error lies furthest below the straight line between first and last, in log10 of the error."""
    order = np.array([point[0] for point in points], dtype=np.float64)
    error = np.log10([point[1] for point in points])
    line = error[0] + (error[-1] - error[0]) * (order - order[0]) / (order[-1] - order[0])
    return int(order[int(np.argmax(line - error))])


def fit_figure(number: str) -> Report:
    """A fit beside its data; `number` is 3.5 or 3.6."""
    which, order = FITS[number]
    polar = thesis_polar()
    fit = fit_polynomials(polar)
    low, high = FIT_RANGE_DEG
    keep = (polar.alpha_deg >= low) & (polar.alpha_deg <= high)
    alpha_deg = polar.alpha_deg[keep]
    which_one, symbol = (0, "Cl") if which == "lift" else (1, "Cd")
    data = (polar.cl, polar.cd)[which_one][keep]
    made = fit(np.deg2rad(alpha_deg))[which_one]
    rms = float(np.sqrt(np.mean((made - data) ** 2)))
    attached = (alpha_deg >= ATTACHED_DEG[0]) & (alpha_deg <= ATTACHED_DEG[1])
    relative = made[attached] / data[attached] - 1.0 if which == "drag" else np.zeros(1)
    fine = np.linspace(low, high, 401)
    smooth = fit(np.deg2rad(fine))[which_one]
    # Outside its range the same polynomial, unheld, is worthless: the reason why it must be clamped.
    t = (2.0 * np.deg2rad(30.0) - sum(fit.fit_range)) / (fit.fit_range[1] - fit.fit_range[0])
    series = (fit.cl_series, fit.cd_series)[which_one]
    unheld = float(np.asarray(chebval(t, series), dtype=np.float64))
    words = f"rms {rms:.5f} over {low:g}…{high:g}°."
    if which == "drag":
        words += f" In attached flow ({ATTACHED_DEG[0]:g}…{ATTACHED_DEG[1]:g}°) Cd is off by "
        words += f"{100 * np.sqrt(np.mean(relative**2)):.1f} % rms, {100 * np.abs(relative).max():.1f} % at most."
    words += f" Without holding the end values it would give {symbol} {unheld:.3g} at 30°."
    return Report(
        number=number,
        caption=f"{'Lift' if which == 'lift' else 'Drag'} of SC1095 and its polynomial of order {order}.",
        statement="Polynomials of high order can also represent stall and the drag bucket, and so carry all the "
        "information of the section (p. 18).",
        ours=words,
        verdict=judged(rms < GOOD * _spread(which)),
        because="Inside the range of the fit it does; outside it must be held at its end values, which the thesis "
        "does not mention and a trim needs from µ 0.15.",
        tables=(
            table(
                "fit", ("alpha_deg", symbol.lower(), f"{symbol.lower()}_fit"), zip(alpha_deg, data, made, strict=True)
            ),
        ),
        panels=(
            PlotPanel(
                "α [°]", symbol, (curve("XFOIL", alpha_deg, data, "points"), curve(f"order {order}", fine, smooth))
            ),
        ),
        numbers={
            "rms": rms,
            "attached_rms": float(np.sqrt(np.mean(relative**2))),
            "attached_max": float(np.abs(relative).max()),
            "unheld_at_30": unheld,
        },
    )


def _rms(error: FitError, which: Coefficient) -> float:
    return error.cl_rms if which == "lift" else error.cd_rms


def _spread(which: Coefficient) -> float:
    """Largest less smallest coefficient over the range of the fit."""
    polar = thesis_polar()
    low, high = FIT_RANGE_DEG
    keep = (polar.alpha_deg >= low) & (polar.alpha_deg <= high)
    return float(np.ptp((polar.cl if which == "lift" else polar.cd)[keep]))
