"""Power between the lowest and the highest drag area that the sources of an aircraft allow."""

from dataclasses import replace

from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def power_band(solution: Solution) -> tuple[float, float] | None:
    """Total power [W] of the same flight with the lowest and the highest drag area of the rotor file.

    None in hover, on a test stand, where the file states one value only, and where one of the two does not trim.
    """
    design, band = solution.design, solution.design.fuselage.drag_area_band
    flies = design.condition.stand is None and not design.hovering and design.models.fuselage
    if band is None or not flies or not solution.converged:
        return None
    ends = [solve(replace(design, fuselage=replace(design.fuselage, drag_area=area)), solution) for area in band]
    if not all(end.converged for end in ends):
        return None
    return ends[0].power.total, ends[1].power.total
