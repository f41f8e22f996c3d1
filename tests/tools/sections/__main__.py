"""`python -m tests.tools.sections build NAME` rebuilds a bundled deck. Exit codes: 0 done, 2 bad input."""

import argparse
from pathlib import Path

from rotor.airfoil.c81 import format_c81
from rotor.airfoil.polars import COLUMNS, PolarSet, read_polars
from rotor.support.assets import asset_path
from rotor.support.terminal import run_command
from tests.tools.sections.recipes import (
    RECIPES,
    make_deck,
    recipe_of,
    run_thesis_polar,
    run_trip_polars,
)
from tests.tools.sections.xfoil import XfoilError


def main(argv: list[str] | None = None) -> int:
    """Build one section."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.tools.sections", description="Bundled section data."
    )
    parser.add_argument("action", choices=("build",))
    parser.add_argument("name", metavar="NAME", help=", ".join(RECIPES))
    parser.add_argument(
        "--from-polars",
        action="store_true",
        help="start from the bundled raw polars, without XFOIL",
    )
    parser.add_argument("--out", metavar="DIR", help="where to write (default: the bundled data)")
    args = parser.parse_args(argv)

    def run() -> int:
        try:
            return _build(args.name, args.from_polars, args.out)
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


if __name__ == "__main__":
    raise SystemExit(main())
