"""`ideal`: the least induced power over all circulations and over all steady twists."""

import argparse
import math
import sys
from typing import Any

from tqdm import tqdm

from rotor.analysis.ideal_bound import Bound, find_bound
from rotor.assets import SHIPPED_ROTORS
from rotor.command.flags import add_command, add_rotor_argument, write_table
from rotor.files.make_design import make_design
from rotor.files.ranges import parse_range
from rotor.files.rotor_file import find_aircraft

COLUMNS = (
    "mu", "mass_kg", "ct", "lambda0", "glauert_kw", "any_circulation", "lift_limited", "steady_twist", "linear_twist",
    "linear_deg",
)  # fmt: skip

_EXPLANATION = (
    "# Least induced power over C_T λ0 (momentum theory, glauert_kw) of the {rotor} at sea level: any circulation;\n"
    "# any within section lift −0.6…1.2; any steady twist; the best linear twist and its rate. Vortex lattice, rigid\n"
    "# helical wake, zero hub moments, linear aerodynamics.\n"
    "# Made by: python -m rotor ideal --mu A:B:STEP --mass-kg LIST --csv FILE{flag}\n"
)


def add_parser(commands: Any) -> None:
    """Register the command."""
    parser = add_command(commands, "ideal", "least induced power over all circulations and over all steady twists")
    parser.add_argument(
        "--mu", required=True, metavar="A:B:STEP", help="advance ratios above 0, for example 0.1:0.4:0.1"
    )
    parser.add_argument(
        "--mass-kg", metavar="LIST", help="aircraft masses, as 5000,8322.4 (default: the reference mass)"
    )
    add_rotor_argument(parser)
    parser.add_argument("--csv", metavar="FILE", help="write the table to a file as well")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """0; bad input is for the caller."""
    craft = find_aircraft(args.rotor or SHIPPED_ROTORS[0])
    speeds = parse_range(args.mu)
    masses = parse_range(args.mass_kg) if args.mass_kg else [craft.mass]
    if min(speeds) < 0.02:
        raise ValueError(f"advance ratio {min(speeds):g} is too low for a skewed wake: start at 0.02 or more")
    designs = [make_design(rotor=craft, mu=mu, mass_kg=mass) for mu in speeds for mass in masses]
    rows: list[tuple[str, ...]] = []
    print("".join(f"{name:>16}" for name in COLUMNS))
    for design in tqdm(designs, disable=not sys.stderr.isatty(), leave=False):
        bound = find_bound(design)
        rows.append(_row(design.condition.mass, bound, bound.ct * bound.lambda0 * design.power_unit))
        print("".join(f"{cell:>16}" for cell in rows[-1]))
    if args.csv:
        flag = f" --rotor {args.rotor}" if args.rotor else ""
        write_table(args.csv, [COLUMNS, *rows], _EXPLANATION.format(rotor=craft.name, flag=flag))
    return 0


def _row(mass: float, bound: Bound, glauert: float) -> tuple[str, ...]:
    factors = (bound.any_circulation, bound.lift_limited, bound.steady_twist, bound.linear_twist)
    return (
        f"{bound.mu:.4g}",
        f"{mass:.6g}",
        f"{bound.ct:.6f}",
        f"{bound.lambda0:.6f}",
        f"{glauert / 1e3:.2f}",
        *(f"{factor:.4f}" for factor in factors),
        f"{math.degrees(bound.linear_rate):.2f}",
    )
