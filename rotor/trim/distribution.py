"""Lift, coefficients and flow of one blade along its span and around the disk, in SI units, of a solution."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotor.aero.problem import LOW_MACH, build_problem, on_azimuths
from rotor.airfoil.sections import Section
from rotor.design.design import Design
from rotor.support.arrays import Array, ShortRepr
from rotor.trim.solution import DiskFields, Solution, require_solution

_SHOWN = (0.25, 0.4, 0.55, 0.7, 0.8, 0.87, 0.92, 0.96, 0.99)
"""r/R near which rows of the table stand."""


@dataclass(frozen=True, eq=False, repr=False)
class Distribution(ShortRepr):
    """Loads and flow of one blade; arrays are (elements, azimuths) unless stated otherwise."""

    r: Array
    """Element centres y/R, (elements,)."""
    psi: Array
    """Azimuth of the blade [rad], 0 over the tail, (azimuths,)."""
    lift: Array
    """Force of one blade along the shaft per span [N/m], dF_z/dy: lift, less what drag pulls down. Its mean around the
    azimuth, times the elements' widths and the number of blades, is the thrust."""
    cl: Array
    cm: Array
    """About the quarter chord, nose up, by the section's own data at `alpha` and `mach`; NaN where they have no
    moment."""
    mach: Array
    """Normal to the quarter chord where the models count the sweep of the tip."""
    alpha: Array
    """Angle of attack at the blade's reference line [rad]."""
    inflow: Array
    """Induced velocity [m/s], positive down through the disk; the flight's own part along the shaft is not in it."""

    def to_dict(self) -> dict[str, Any]:
        """The record that `solve --json --distribution` prints: angles in degrees, lists [r][psi], None for no `cm`."""
        moments = self.cm.astype(object)
        moments[np.isnan(self.cm)] = None
        return {
            "r": self.r.tolist(),
            "psi_deg": np.degrees(self.psi).tolist(),
            "lift_n_per_m": self.lift.tolist(),
            "cl": self.cl.tolist(),
            "cm": moments.tolist(),
            "mach": self.mach.tolist(),
            "alpha_deg": np.degrees(self.alpha).tolist(),
            "inflow_m_s": self.inflow.tolist(),
        }

    def table(self) -> str:
        """Mean and largest lift [N/m] at a few radii, and the azimuth [°] of the largest."""
        lines = [f"{'r/R':>6}{'mean N/m':>10}{'max N/m':>10}{'at ψ':>7}"]
        for i in dict.fromkeys(int(np.argmin(np.abs(self.r - r))) for r in _SHOWN):
            lift = self.lift[i]
            where = (
                f"{math.degrees(self.psi[lift.argmax()]):.0f}°"
                if np.ptp(lift) > 1e-6 * np.abs(lift).max()
                else "–"
            )
            lines.append(f"{self.r[i]:6.3f}{lift.mean():10.0f}{lift.max():10.0f}{where:>7}")
        return "\n".join(lines)


def distribution(solution: Solution) -> Distribution:
    """Loads and flow of one blade, on the elements and azimuths of `solution.disk`; in hover the same at all azimuths.

    Raises RuntimeError when the solution did not converge, TypeError for anything but a solution.
    """
    design, disk = require_solution(solution).design, solution.require().disk
    lift, inflow = disk.dct * design.thrust_per_metre, disk.induced * design.rotor.tip_speed
    return Distribution(
        disk.r, disk.psi, lift, disk.cl, _moments(design, disk), disk.mach, disk.alpha, inflow
    )


def _moments(design: Design, flow: DiskFields) -> Array:
    """C_m by section data at the flow of a solution; NaN without data, 0 on elements that carry no load."""
    problem = on_azimuths(build_problem(design), len(flow.psi))
    disk, moments = problem.disk, np.zeros_like(flow.alpha)
    for which, shares in enumerate((1.0 - disk.weight, disk.weight)):
        for i in np.flatnonzero(shares).tolist():
            section = disk.sections[int(disk.section[i, which])]
            moments[i] += shares[i] * _moment(design, section, flow.alpha[i], flow.mach[i])
    if flow.unsteady is not None:
        moments += flow.unsteady.moment
    if problem.unloaded is not None:
        moments[problem.unloaded & np.isfinite(moments)] = 0.0
    return moments


def _moment(design: Design, section: Section, alpha: Array, mach: Array) -> Array:
    """C_m of one section of the blade at angles of attack about the blade's reference line, shape of alpha."""
    at = mach if design.models.compressibility else np.full_like(mach, LOW_MACH)
    moment = section.table.moment(alpha - section.incidence_offset, at)
    return np.full_like(alpha, np.nan) if moment is None else moment
