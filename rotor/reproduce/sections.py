"""Figures 2.3, 2.4, 3.1, 3.2: pressure and forces around sections, from shipped XFOIL output."""

import numpy as np

from rotor.airfoil.build.pressure import PRESSURE_CASES, Pressure, PressureCase, read_pressure, run_pressure
from rotor.airfoil.build.xfoil import XfoilError
from rotor.airfoil.polars import read_polars
from rotor.assets import asset_path
from rotor.reproduce.report import Panel, Report, Table, curve, judged, table

TITLES = {"naca23015": "NACA 23015", "sc1095": "SC1095", "sc1094r8": "SC1094 R8"}
SHIFT = 0.02
"""cl by which a rerun of XFOIL may differ from the shipped run: its convergence moves with version and machine."""
ARROW = 0.25
"""Chords per unit of Cp in the arrows."""


def forces(section: str) -> tuple[Pressure, str]:
    """The result to show and where it comes from: rerun where XFOIL is installed, shipped otherwise."""
    case = next(case for case in PRESSURE_CASES if case.section == section)
    shipped = read_pressure(case)
    try:
        fresh = run_pressure(case)
    except XfoilError:
        return shipped, "Shipped XFOIL output; no XFOIL here to rerun it."
    moved = fresh.cl - shipped.cl
    if abs(moved) > SHIFT:
        return shipped, f"Shipped XFOIL output; XFOIL here gives a cl {moved:+.3f} away from it, which is not used."
    return fresh, f"Rerun with XFOIL here; its cl is {moved:+.4f} from the shipped run."


def figure_2_3() -> Report:
    """Forces around NACA 23015."""
    return _forces("2.3", "naca23015", "XFOIL gives how the forces are distributed around a section (p. 9–10).")


def figure_2_4() -> Report:
    """Pressure on NACA 23015."""
    pressure, origin = forces("naca23015")
    nose = int(np.argmin(pressure.x))
    upper, lower = slice(None, nose + 1), slice(nose, None)
    peak = int(np.argmin(pressure.cp))
    stagnation = float(pressure.cp.max())
    expected = _stagnation_pressure(pressure.case)
    good = abs(stagnation / expected - 1.0) < 0.02 and peak < nose
    return Report(
        number="2.4",
        kind="figure",
        caption="Pressure coefficient on the upper and lower side of NACA 23015. The document states neither angle nor "
        f"flow; ours: {_flow(pressure.case)}. {origin}",
        statement="XFOIL gives how the pressure coefficient changes over the top and the bottom of a section (p. 9).",
        ours=f"Least Cp {pressure.cp[peak]:.2f} at {100 * pressure.x[peak]:.0f} % chord on the upper side; largest "
        f"{stagnation:.3f}, where isentropic flow at rest has {expected:.3f}.",
        verdict=judged(good),
        because="The stagnation pressure is that of compressible flow, and suction sits on the upper side.",
        tables=(_table(pressure),),
        panels=(
            Panel(
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


def figure_3_1() -> Report:
    """SC1095 at 3°."""
    return _forces("3.1", "sc1095", "The SC1095 of the UH-60A at 3° (p. 17).")


def figure_3_2() -> Report:
    """SC1094 R8 at 3°."""
    return _forces("3.2", "sc1094r8", "The SC1094 R8 of the UH-60A at 3° (p. 18).")


def _forces(number: str, section: str, statement: str) -> Report:
    pressure, origin = forces(section)
    integrated = pressure.integrated_lift()
    gap = integrated / pressure.cl - 1.0
    beside = _beside_polar(pressure)
    return Report(
        number=number,
        kind="figure",
        caption=f"Pressure forces around {TITLES[section]}: arrows of −Cp normal to the surface; "
        f"{_flow(pressure.case)}. "
        f"Angle, Mach and Reynolds number are ours where the document is silent. {origin}",
        statement=statement,
        ours=f"cl {pressure.cl:.3f}, cd {pressure.cd:.5f}, cm {pressure.cm:.3f}; the arrows add up to cl "
        f"{integrated:.3f} "
        f"({round(100 * gap, 2) + 0.0:+.2f} %). {beside[0]}".rstrip(),
        verdict=judged(abs(gap) < 5e-3),
        because="The arrows carry XFOIL's lift, which proves order, sign and scale, not XFOIL; the document prints no "
        "number to set beside.",
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


def _arrows(pressure: Pressure) -> Panel:
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
    return Panel("x/c", "y/c", tuple(curves), equal=True)


def _flow(case: PressureCase) -> str:
    return f"α {case.alpha_deg:g}°, Mach {case.mach:g}, Re {case.reynolds / 1e6:.2f} million, Ncrit {case.n_crit:g}"


def _stagnation_pressure(case: PressureCase) -> float:
    """Cp of flow brought to rest isentropically: ((1 + 0.2 M²)^3.5 − 1)/(0.7 M²)."""
    square = case.mach**2
    return ((1.0 + 0.2 * square) ** 3.5 - 1.0) / (0.7 * square)


def _table(pressure: Pressure) -> Table:
    rows = zip(pressure.x, pressure.y, pressure.cp, pressure.cf, strict=True)
    return table("pressure", ("x_over_c", "y_over_c", "cp", "cf"), rows)
