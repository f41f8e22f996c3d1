"""Pressure and friction around a section from XFOIL, as `rotor.reproduce.sections` reads them.

XFOIL writes Cp with CPWR, and the surface points and skin friction with DUMP, in the same order: upper trailing
edge forward around the nose to the lower trailing edge.
"""

import re
from pathlib import Path

import numpy as np

from rotor.airfoil.contour import load_contour
from rotor.reproduce.sections import PRESSURE_COLUMNS, Pressure, PressureCase
from tests.tools.sections.xfoil import XfoilError, require_xfoil, run_commands

_PANELS, _ITERATIONS = 160, 200


def run_pressure(case: PressureCase) -> Pressure:
    """Run XFOIL; raises XfoilError with one sentence when it is missing or does not converge."""
    require_xfoil()
    inputs: dict[str, str] = {}
    if case.section.startswith("naca"):
        commands = [f"NACA {case.section.removeprefix('naca')}"]
    else:
        points = load_contour(case.section).points
        inputs["section.dat"] = case.section + "\n" + "\n".join(f"{x:.7f} {y:.7f}" for x, y in points) + "\n"
        commands = ["LOAD section.dat"]
    commands += ["PPAR", f"N {_PANELS}", "", "", "OPER", f"VISC {case.reynolds:.0f}", f"MACH {case.mach:g}"]
    commands += ["VPAR", f"N {case.n_crit:g}", "", f"ITER {_ITERATIONS}", "PACC", "polar.txt", ""]
    commands += [f"ALFA {case.alpha_deg:g}", "CPWR cp.txt", "DUMP dump.txt", "", "QUIT", ""]
    written, _ = run_commands(commands, inputs, ("polar.txt", "cp.txt", "dump.txt"))
    _, _, body = written.get("polar.txt", "").partition("------ --------")
    rows = [line.split() for line in body.splitlines()[1:] if line.strip()]
    if not rows or "cp.txt" not in written or "dump.txt" not in written:
        raise XfoilError(f"xfoil did not converge on {case.section} at {case.alpha_deg:g} deg: use the bundled result")
    cp = np.array(re.findall(r"^\s+\S+\s+(\S+)\s*$", written["cp.txt"], re.MULTILINE), dtype=np.float64)
    # The wake follows the surface in the dump.
    surface = [line.split() for line in written["dump.txt"].splitlines()[1:]][: len(cp)]
    columns = np.array([[float(row[k]) for k in (1, 2, 6)] for row in surface])
    cl, cd, cm = float(rows[0][1]), float(rows[0][2]), float(rows[0][4])
    return Pressure(case, cl, cd, cm, columns[:, 0], columns[:, 1], cp, columns[:, 2])


def write_pressure(path: Path, pressure: Pressure) -> None:
    """Write a result as CSV below a header that records how it was made."""
    case = pressure.case
    lines = [
        f"# {case.section}, XFOIL 6.99 (Drela), alpha {case.alpha_deg:g} deg, Mach {case.mach:g}, Re "
        f"{case.reynolds:.0f}, "
        f"Ncrit {case.n_crit:g}, {_PANELS} panels",
        f"# cl {pressure.cl:.4f}, cd {pressure.cd:.5f}, cm {pressure.cm:.4f}",
        "# From the upper trailing edge forward to the lower one; chord lengths; cf over free-stream dynamic pressure.",
        PRESSURE_COLUMNS,
    ]
    rows = zip(pressure.x, pressure.y, pressure.cp, pressure.cf, strict=True)
    lines += [f"{x:.5f},{y:.5f},{cp:.5f},{cf:.6f}" for x, y, cp, cf in rows]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
