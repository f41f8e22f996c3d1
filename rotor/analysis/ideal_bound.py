"""The least induced power at a condition, as factors κ on momentum theory's C_T λ0; and the shipped table of them."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from rotor.aero.elements import expected_wake
from rotor.analysis.ideal_circulation import (
    InducedPower,
    LinearBlade,
    bound_lattice,
    least_induced_power,
    least_twisted_power,
)
from rotor.arrays import Array
from rotor.assets import asset_path, csv_rows
from rotor.blas_threads import one_blas_thread
from rotor.design.design import Design

LIFT_LIMIT = (-0.6, 1.2)
"""Section lift coefficients a blade can have, for the bound that knows stall."""
TWIST_SHAPES = 6
"""Chebyshev polynomials over the span: more change the least power of any steady twist by less than 0.1 %."""


@dataclass(frozen=True)
class Bound:
    """Induced power over C_T λ0 at one condition, with zero hub moments; linear aerodynamics."""

    mu: float
    ct: float
    lambda0: float
    any_circulation: float
    """Any circulation that varies smoothly over the disk, none in reverse flow."""
    lift_limited: float
    """The same within `LIFT_LIMIT`; infinite where none carries the thrust."""
    steady_twist: float
    """Any fixed twist."""
    linear_twist: float
    """The best linear twist."""
    linear_rate: float
    """That twist [rad per radius]."""


@one_blas_thread()
def find_bound(design: Design) -> Bound:
    """The bound for a design's rotor, thrust and speed (not for its twist or sections). Takes seconds."""
    rotor = design.rotor
    drag = design.drag / design.thrust_unit
    wake = expected_wake(design, drag)
    ct = math.hypot(design.weight_coefficient, drag)
    lattice = bound_lattice(rotor.blades, round(rotor.blade.root_cutout, 2))
    r = lattice.r
    blade = LinearBlade(chord=rotor.reference_chord / rotor.radius)
    across = (2.0 * r - 1.0 - lattice.root) / (1.0 - lattice.root)
    shapes = chebvander(across, TWIST_SHAPES).T[1:].astype(float)
    straight = r - 0.75

    def factor(found: InducedPower) -> float:
        return found.coefficient / (ct * wake.lambda0)

    linear = least_twisted_power(lattice, wake, ct, blade, 0.0 * r, straight[None])
    try:
        limited = factor(least_induced_power(lattice, wake, ct, chord=blade.chord, cl_range=LIFT_LIMIT))
    except ValueError:  # No circulation within the limit carries this thrust.
        limited = math.inf
    return Bound(
        mu=design.condition.advance_ratio,
        ct=ct,
        lambda0=wake.lambda0,
        any_circulation=factor(least_induced_power(lattice, wake, ct)),
        lift_limited=limited,
        steady_twist=factor(least_twisted_power(lattice, wake, ct, blade, 0.0 * r, shapes)),
        linear_twist=factor(linear),
        linear_rate=float(linear.amounts[3]),
    )


TABLE_ROTOR = "uh60a"
"""The shipped table is of this rotor; another's bound takes `python -m rotor ideal --rotor`."""


def ideal_factor(mu: float, ct: float, rotor: str = TABLE_ROTOR) -> float | None:
    """κ of any circulation within the lift limit, from the shipped table (`python -m rotor ideal`) of the UH-60A.

    Linear between the table's advance ratios and C_T, held beyond its C_T; 1 in hover, where an even load is ideal.
    None beyond its fastest, 0.40: there reverse-flow lift decides and the bound has not settled. None for any other
    `rotor` by name: its blade number, root and chord make another bound.
    """
    speeds, thrusts, factors = _table()
    if mu > speeds[-1] or rotor != TABLE_ROTOR:
        return None
    at_thrust = [_between(ct, thrusts, row) for row in factors]
    return float(np.interp(mu, [0.0, *speeds.tolist()], [1.0, *at_thrust]))


def _between(x: float, places: Array, values: Array) -> float:
    return float(np.interp(x, places, values))


@cache
def _table() -> tuple[Array, Array, Array]:
    """Advance ratios, thrust coefficients, lift-limited κ (speeds, thrusts)."""
    rows = csv_rows(asset_path("ideal_bound.csv"))
    speeds = sorted({float(row["mu"]) for row in rows})
    masses = sorted({float(row["mass_kg"]) for row in rows})
    by_place = {(float(row["mu"]), float(row["mass_kg"])): row for row in rows}
    thrusts = np.array([float(by_place[speeds[0], mass]["ct"]) for mass in masses])
    factors = [[float(by_place[mu, mass]["lift_limited"]) for mass in masses] for mu in speeds]
    return np.array(speeds), thrusts, np.array(factors)
