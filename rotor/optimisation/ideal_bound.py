"""How far induced power is above the least that blades can have, by the shipped table of the UH-60A.

The bound κ is the least induced power over C_T λ0 of momentum theory, of any circulation within the section lift limit
without roll or pitch moment, in the wake of the inflow model of lifting lines. `tests/tools/ideal_bound.py` makes the
table and has the equations.
"""

from functools import cache

import numpy as np

from rotor.aero.inflow.lifting_line import LiftingLineInflow
from rotor.design.design import Design
from rotor.support.arrays import Array, read_only
from rotor.support.assets import asset_path, csv_rows
from rotor.trim.low_speed import hover_share

TABLE_ROTOR = "uh60a"
"""The shipped table is of this rotor."""


def not_bounded(design: Design) -> str:
    """Why the bound says nothing about this design's induced power, as a clause; empty where it holds.

    It is that of flapping blades in the wake of the lifting line, and comparable with this model alone: a prescribed
    inflow and the sector model can have less induced power than any circulation of real blades. In hover it is momentum
    theory, which bounds the annuli too.
    """
    models = design.models
    if design.aircraft.key != TABLE_ROTOR:
        return "not computed for this rotor"
    if design.vertical_speed:
        return "computed for level flight only"
    if not design.hovering:
        if models.inflow != LiftingLineInflow.name:
            return "does not bound this inflow"
        if hover_share(design):
            return "does not bound inflow that passes over to hover"
        if not design.flaps:
            return "does not bound rigid blades"
    if not 0.0 <= design.condition.advance_ratio <= float(_table()[0][-1]):
        return "not converged above µ 0.40"
    return ""


def ideal_factor(mu: float, ct: float, rotor: str = TABLE_ROTOR) -> float | None:
    """κ of any circulation within the lift limit, from the shipped table of the UH-60A.

    Linear between the table's advance ratios and C_T, held beyond its C_T and where none was found; 1 in hover, where
    an even load is ideal. None beyond its fastest, 0.40: there reverse-flow lift decides and the bound has not
    converged. None for any other `rotor` by name: its blade number, root and chord make another bound.
    """
    speeds, thrusts, factors = _table()
    if mu > speeds[-1] or rotor != TABLE_ROTOR:
        return None
    at_thrust = [_between(ct, thrusts, row) for row in factors]
    return float(np.interp(mu, [0.0, *speeds.tolist()], [1.0, *at_thrust]))


def _between(x: float, places: Array, values: Array) -> float:
    known = np.isfinite(values)
    return float(np.interp(x, places[known], values[known]))


@cache
@read_only
def _table() -> tuple[Array, Array, Array]:
    """Advance ratios, thrust coefficients, lift-limited κ (speeds, thrusts)."""
    rows = csv_rows(asset_path("ideal_bound.csv"))
    speeds = sorted({float(row["mu"]) for row in rows})
    masses = sorted({float(row["mass_kg"]) for row in rows})
    by_place = {(float(row["mu"]), float(row["mass_kg"])): row for row in rows}
    thrusts = np.array([float(by_place[speeds[0], mass]["ct"]) for mass in masses])
    factors = [[float(by_place[mu, mass]["lift_limited"]) for mass in masses] for mu in speeds]
    return np.array(speeds), thrusts, np.array(factors)
