"""Pressure and friction around a section at one angle of attack, as XFOIL computes them and as files.

XFOIL writes Cp with CPWR, and the surface points and skin friction with DUMP, in the same order: upper trailing
edge forward around the nose to the lower trailing edge.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rotor.airfoil.build.xfoil import XfoilError, require_xfoil, run_commands
from rotor.airfoil.contour import load_contour
from rotor.arrays import Array
from rotor.assets import asset_path

_COLUMNS = "x,y,cp,cf"
_PANELS, _ITERATIONS = 160, 200


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
        _COLUMNS,
    ]
    rows = zip(pressure.x, pressure.y, pressure.cp, pressure.cf, strict=True)
    lines += [f"{x:.5f},{y:.5f},{cp:.5f},{cf:.6f}" for x, y, cp, cf in rows]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read_pressure(case: PressureCase) -> Pressure:
    """The shipped result. Raises ValueError when the file is damaged."""
    text = asset_path(case.file).read_text(encoding="utf-8")
    found = re.search(r"^# cl (\S+), cd (\S+), cm (\S+)$", text, re.MULTILINE)
    body = [line for line in text.splitlines() if line and not line.startswith("#")]
    if found is None or body[0] != _COLUMNS:
        raise ValueError(f"{case.file} is not a pressure file: restore it, or rebuild it with XFOIL")
    data = np.array([[float(word) for word in line.split(",")] for line in body[1:]])
    cl, cd, cm = (float(word) for word in found.groups())
    return Pressure(case, cl, cd, cm, data[:, 0], data[:, 1], data[:, 2], data[:, 3])
