"""`airfoil`: shows the data of a section. How the bundled decks are made: `tests/tools/sections`."""

import argparse
import json
from typing import Any

import numpy as np

from rotor.airfoil.sections import TABLE_NAMES, load_installed
from rotor.command.common import add_command


def add_parser(subparsers: Any) -> None:
    parser = add_command(subparsers, "airfoil", run, "shows section data")
    parser.add_argument("action", choices=("show", "build", "verify"), help="build and verify need a checkout")
    parser.add_argument("name", metavar="NAME", help=", ".join(TABLE_NAMES))
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")
    parser.add_argument("--mach", type=float, metavar="M", help="one point, with --alpha")
    parser.add_argument("--alpha", type=float, metavar="DEG", help="angle of attack of that point [deg]")


def run(args: argparse.Namespace) -> int:
    """0; ValueError on bad input."""
    if args.action != "show":
        raise ValueError(
            f"airfoil {args.action} belongs to a checkout of the source: run `python -m tests.tools.sections "
            f"{args.action} {args.name}` there"
        )
    if args.mach is not None or args.alpha is not None:
        return _point(args.name, args.mach, args.alpha, args.json)
    return _show(args.name, args.json)


def _point(name: str, mach: float | None, alpha: float | None, as_json: bool) -> int:
    """Lift, drag and moment at one Mach number and angle of attack about the section's own chord line."""
    if mach is None or alpha is None:
        raise ValueError("a point needs both --mach and --alpha: give the missing one")
    table = load_installed(name).table
    if not 0.0 <= mach <= table.mach_limit:
        raise ValueError(f"--mach {mach:g} is outside the data of {name}, 0…{table.mach_limit:g}: choose within them")
    if not -180.0 <= alpha <= 180.0:
        raise ValueError(f"--alpha {alpha:g} is outside −180…180 deg: choose within them")
    here, moment = table(np.deg2rad(alpha), mach), table.moment(np.deg2rad(alpha), mach)
    answer = {
        "cl": round(float(here.cl), 5),
        "cd": round(float(here.cd), 6),
        "cm": None if moment is None else round(float(moment), 5),
    }
    if as_json:
        print(json.dumps(answer))
        return 0
    print(f"{name}, Mach {mach:g}, {alpha:g} deg: cl {answer['cl']:.4f}, cd {answer['cd']:.5f}, ", end="")
    print("no moment in its source" if moment is None else f"cm {answer['cm']:+.4f}")
    return 0


def _show(name: str, as_json: bool) -> int:
    section = load_installed(name)
    table = section.table
    mach = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])
    slope, zero = table.lift_slope(mach), table.zero_lift_alpha(mach)
    negative, positive = table.stall_alpha(mach)
    sweep = np.deg2rad(np.arange(0.0, 20.0, 0.1))
    columns = {
        "mach": mach,
        "cl_alpha_per_deg": np.deg2rad(slope),
        "zero_lift_deg": np.rad2deg(zero),
        "stall_negative_deg": np.rad2deg(negative),
        "stall_positive_deg": np.rad2deg(positive),
        "cl_max": table(sweep[:, None], mach).cl.max(axis=0),
        "cl_at_4_deg": table(np.deg2rad(4.0), mach).cl,
        "cd_at_0_deg": table(0.0, mach).cd,
        "cd_at_4_deg": table(np.deg2rad(4.0), mach).cd,
    }
    moment = table.moment(0.0, mach)
    if moment is not None:
        columns["cm_at_0_deg"] = moment
    divergence = {f"{a:g}": round(float(table.drag_divergence_mach(np.deg2rad(a))), 3) for a in (0.0, 2.0, 4.0)}
    if as_json:
        answer = {
            "name": section.name,
            "source": table.source,
            "mach_limit": table.mach_limit,
            "incidence_offset_deg": round(float(np.rad2deg(section.incidence_offset)), 6),
            "chord_ratio": section.chord_ratio,
            "drag_divergence_mach": divergence,
            **{key: [round(float(v), 5) for v in values] for key, values in columns.items()},
        }
        print(json.dumps(answer))
        return 0
    print(f"{section.name}: {table.source}")
    print(
        f"data to Mach {table.mach_limit:g}; chord line {np.rad2deg(section.incidence_offset):g} deg nose-down of, "
        f"and chord {section.chord_ratio:g} times, those of SC1095"
    )
    heads = (
        "Mach",
        "cl_alpha/deg",
        "alpha0 deg",
        "stall- deg",
        "stall+ deg",
        "cl max",
        "cl(4)",
        "cd(0)",
        "cd(4)",
        "cm(0)",
    )
    decimals = (2, 4, 2, 1, 1, 3, 3, 4, 4, 4)
    heads, decimals = heads[: len(columns)], decimals[: len(columns)]
    print("  ".join(f"{head:>12}" for head in heads))
    for row in zip(*columns.values(), strict=True):
        print("  ".join(f"{value:12.{d}f}" for value, d in zip(row, decimals, strict=True)))
    print("drag divergence (dcd/dM = 0.1) at Mach " + ", ".join(f"{m:g} at {a} deg" for a, m in divergence.items()))
    return 0
