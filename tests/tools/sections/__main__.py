"""`python -m tests.tools.sections`: rebuilds a bundled deck, or compares a rebuilt one with it.

Exit codes: 0 done, 1 `verify` found a difference, 2 bad input.
"""

import argparse
from pathlib import Path

from rotor.airfoil.c81 import format_c81, read_c81
from rotor.airfoil.polars import COLUMNS, PolarSet, read_polars
from rotor.support.assets import asset_path
from rotor.support.terminal import run_command
from tests.tools.sections.recipes import RECIPES, compare_decks, make_deck, recipe_of, run_thesis_polar, run_trip_polars
from tests.tools.sections.xfoil import XfoilError

CL_TOLERANCE = 0.01  # XFOIL's convergence depends on version and machine, so files cannot be compared byte by byte.
CD_TOLERANCE = 0.03


def main(argv: list[str] | None = None) -> int:
    """Build or verify one section."""
    parser = argparse.ArgumentParser(prog="python -m tests.tools.sections", description="Bundled section data.")
    parser.add_argument("action", choices=("build", "verify"))
    parser.add_argument("name", metavar="NAME", help=", ".join(RECIPES))
    parser.add_argument("--from-polars", action="store_true", help="start from the bundled raw polars, without XFOIL")
    parser.add_argument("--out", metavar="DIR", help="build: where to write (default: the bundled data)")
    args = parser.parse_args(argv)

    def run() -> int:
        try:
            if args.action == "build":
                return _build(args.name, args.from_polars, args.out)
            return _verify(args.name, args.from_polars)
        except XfoilError as error:
            raise ValueError(str(error)) from None

    return run_command("sections", run)


def _progress(message: str) -> None:
    print(f"  {message}", flush=True)


def _polar_file(name: str) -> str:
    return f"{name}_{recipe_of(name).polars}.polars.csv"


def write_polars(path: Path, polar_set: PolarSet) -> None:
    """Write a polar set; four to five decimals, as XFOIL prints them, so no digit is lost."""
    lines = [f"# {line}" for line in polar_set.header] + [COLUMNS]
    for p in polar_set.polars:
        for a, cl, cd, cm in zip(p.alpha_deg, p.cl, p.cd, p.cm, strict=True):
            lines.append(f"{p.mach:g},{p.reynolds or 0.0:.0f},{a:g},{cl:.4f},{cd:.5f},{cm:.4f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _polars(name: str, from_polars: bool) -> PolarSet:
    """The bundled polars, or those that XFOIL computes now."""
    file = asset_path(f"airfoils/{_polar_file(name)}")
    if from_polars:
        return read_polars(file)
    print(f"{name}: running XFOIL, up to some minutes", flush=True)
    return run_trip_polars(name, _progress)


def _build(name: str, from_polars: bool, out: str | None) -> int:
    recipe_of(name)
    folder = Path(out) if out else asset_path("airfoils")
    if not folder.is_dir():
        raise ValueError(f"--out {out!r} is not a folder: create it first")
    polars = _polars(name, from_polars)
    deck = make_deck(name, polars)  # Everything is computed before anything is written.
    if not from_polars and name == "sc1095":
        write_polars(folder / "sc1095_ncrit9.polars.csv", run_thesis_polar(_progress))
    write_polars(folder / _polar_file(name), polars)
    (folder / f"{name}.c81").write_text(format_c81(deck), encoding="utf-8")
    print(f"wrote {folder / f'{name}.c81'}")
    return 0


def _verify(name: str, from_polars: bool) -> int:
    polars = _polars(name, from_polars)
    found = compare_decks(make_deck(name, polars), read_c81(asset_path(f"airfoils/{name}.c81")))
    good = found.cl <= CL_TOLERANCE and found.cd <= CD_TOLERANCE
    print(f"{name}: largest difference in cl {found.cl:.4f} (at {found.cl_at}; allowed {CL_TOLERANCE:g})")
    allowed = 100.0 * CD_TOLERANCE
    print(f"{name}: largest difference in cd {100.0 * found.cd:.2f} % (at {found.cd_at}; allowed {allowed:g} %)")
    print(f"{name}: {'agrees with' if good else 'DIFFERS from'} the bundled deck")
    return 0 if good else 1


if __name__ == "__main__":
    raise SystemExit(main())
