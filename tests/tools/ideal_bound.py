"""Make the table of the ideal bound, `assets/ideal_bound.csv`: `python -m tests.tools.ideal_bound`. Some minutes."""

import math

from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.ideal_bound import find_bound
from rotor.support.assets import asset_path
from rotor.support.user_input import csv_text

SPEEDS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4)
MASSES = (5000.0, 6500.0, 8322.4, 9600.0, 11000.0)
COLUMNS = (
    "mu", "mass_kg", "ct", "lambda0", "glauert_kw", "any_circulation", "lift_limited", "steady_twist",
    "linear_twist", "linear_deg",
)  # fmt: skip
HEADING = """\
# Least induced power over C_T λ0 (momentum theory, glauert_kw) of the UH-60A at sea level: any circulation;
# any within section lift −0.6…1.2; any steady twist; the best linear twist and its rate in °/R. Lifting
# lines, the wake of the inflow model lifting-line, zero hub moments, linear aerodynamics.
# Made by: python -m tests.tools.ideal_bound
"""


def row(design: Design) -> tuple[str, ...]:
    """A line of the table: `COLUMNS`."""
    bound = find_bound(design)
    glauert = bound.ct * bound.lambda0 * design.power_unit / 1e3
    factors = (bound.any_circulation, bound.lift_limited, bound.steady_twist, bound.linear_twist)
    return (
        f"{bound.mu:.4g}",
        f"{design.condition.mass:.6g}",
        f"{bound.ct:.6f}",
        f"{bound.lambda0:.6f}",
        f"{glauert:.1f}",
        *(f"{factor:.3f}" for factor in factors),
        f"{math.degrees(bound.linear_rate):.1f}",
    )


if __name__ == "__main__":
    made = [row(make_design(mu=mu, mass_kg=mass)) for mu in SPEEDS for mass in MASSES]
    asset_path("ideal_bound.csv").write_text(csv_text([COLUMNS, *made], HEADING), encoding="utf-8", newline="")
