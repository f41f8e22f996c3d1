"""`airfoil`: rebuilds, verifies or shows the deck of a section.

Exit codes: 0 done, 1 `verify` found a difference, 2 bad input (raised as ValueError, printed by the caller).
"""

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

from rotor.airfoil.build.decks import RECIPES, check_name, compare_decks, make_deck, run_thesis_polar, run_trip_polars
from rotor.airfoil.build.xfoil import XfoilError
from rotor.airfoil.c81 import format_c81, read_c81
from rotor.airfoil.polars import read_polars, write_polars
from rotor.airfoil.polynomial import THESIS_NAME
from rotor.airfoil.sections import load_installed
from rotor.assets import asset_path
from rotor.command.common import add_command

CL_TOLERANCE = 0.01  # XFOIL's convergence depends on version and machine, so files cannot be compared byte by byte.
CD_TOLERANCE = 0.03


def add_parser(subparsers: Any) -> None:
    """Register the command and its three actions."""
    parser = add_command(subparsers, "airfoil", "builds, verifies or shows section data")
    parser.add_argument("action", choices=("build", "verify", "show"), help="what to do")
    parser.add_argument("name", metavar="NAME", help=f"{', '.join(RECIPES)}; show also takes {THESIS_NAME}")
    parser.add_argument(
        "--from-polars", action="store_true", help="build, verify: start from the bundled raw polars, without XFOIL"
    )
    parser.add_argument("--out", metavar="DIR", help="build: where to write (default: the bundled data)")
    parser.add_argument("--json", action="store_true", help="show: one JSON object instead of a table")
    parser.add_argument("--mach", type=float, metavar="M", help="show: one point, with --alpha")
    parser.add_argument("--alpha", type=float, metavar="DEG", help="show: angle of attack of that point [deg]")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """0 done, 1 the rebuilt deck differs from the bundled one; ValueError on bad input or when XFOIL fails."""
    try:
        if args.action == "build":
            return _build(args.name, args.from_polars, args.out)
        if args.action == "verify":
            return _verify(args.name, args.from_polars)
        if args.mach is not None or args.alpha is not None:
            return _point(args.name, args.mach, args.alpha, args.json)
        return _show(args.name, args.json)
    except XfoilError as error:
        raise ValueError(str(error)) from None
    except PermissionError as error:
        raise ValueError(f"cannot write {error.filename!r}: give --out a folder of your own") from None


def _progress(message: str) -> None:
    print(f"  {message}", flush=True)


def _polar_file(name: str) -> str:
    return f"{name}_{RECIPES[name].polars}.polars.csv"


def _build(name: str, from_polars: bool, out: str | None) -> int:
    check_name(name)
    bundled = asset_path("airfoils")
    folder = Path(out) if out else bundled
    if not folder.is_dir():
        raise ValueError(f"--out {out!r} is not a folder: create it first")
    if from_polars:
        polars = read_polars(bundled / _polar_file(name))
    else:
        print(f"{name}: running XFOIL, up to some minutes", flush=True)
        polars = run_trip_polars(name, _progress)
    deck = make_deck(name, polars)  # Everything is computed before anything is written.
    if not from_polars and name == "sc1095":
        write_polars(folder / "sc1095_ncrit9.polars.csv", run_thesis_polar(_progress))
    write_polars(folder / _polar_file(name), polars)
    (folder / f"{name}.c81").write_text(format_c81(deck), encoding="utf-8")
    print(f"wrote {folder / f'{name}.c81'}")
    return 0


def _verify(name: str, from_polars: bool) -> int:
    check_name(name)
    shipped = read_c81(asset_path(f"airfoils/{name}.c81"))
    if from_polars:
        polars = read_polars(asset_path(f"airfoils/{_polar_file(name)}"))
    else:
        print(f"{name}: running XFOIL, up to some minutes", flush=True)
        polars = run_trip_polars(name, _progress)
    found = compare_decks(make_deck(name, polars), shipped)
    good = found.within(CL_TOLERANCE, CD_TOLERANCE)
    print(f"{name}: largest difference in cl {found.cl:.4f} (at {found.cl_at}; allowed {CL_TOLERANCE:g})")
    allowed = 100.0 * CD_TOLERANCE
    print(f"{name}: largest difference in cd {100.0 * found.cd:.2f} % (at {found.cd_at}; allowed {allowed:g} %)")
    print(f"{name}: {'agrees with' if good else 'DIFFERS from'} the bundled deck")
    return 0 if good else 1


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
