"""`sweep`: one or more twists over advance ratio."""

import argparse
from typing import Any

from rotor.analysis.sweep import COLUMNS, sweep
from rotor.command.flags import add_command, add_design_arguments, design_from, write_table
from rotor.files.ranges import parse_range


def add_parser(commands: Any) -> None:
    """Register the command."""
    parser = add_command(commands, "sweep", "power of one or more twists over advance ratio")
    parser.add_argument("--mu", required=True, metavar="A:B:STEP", help="for example 0.05:0.40:0.05; 0 is hover")
    add_design_arguments(parser, one_twist=False)
    parser.add_argument("--csv", metavar="FILE", help="write the table to a file as well")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """0 when every point converged, else 1."""
    advance_ratios = parse_range(args.mu)
    specs: list[str | None] = list(args.twist) if args.twist else [None]
    designs = [design_from(args, spec, mu) for spec in specs for mu in advance_ratios]  # Bad input is reported first.
    rows: list[tuple[str, ...]] = []
    converged = True
    longest = max(len(design.twist.spec()) for design in designs)
    widths = (max(22, longest + 2), 7, 10, 14, 10, 15, 12, 12, 13, 8)
    print("".join(f"{name:<{width}}" for name, width in zip(COLUMNS, widths, strict=False)))
    for design in designs[:: len(advance_ratios)]:
        table = sweep(design, advance_ratios)
        converged = converged and all(solution.converged for solution in table)
        for cells in table.rows:
            row = tuple(_text(name, cell) for name, cell in zip(COLUMNS, cells, strict=True))
            rows.append(row)
            print("".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=False)).rstrip())
    if args.csv:
        write_table(args.csv, [COLUMNS, *rows])
    return 0 if converged else 1


def _text(name: str, cell: float | str | None) -> str:
    """A cell as printed: powers and speeds with fixed digits, nothing where there is no value."""
    if cell is None or isinstance(cell, str):
        return cell or ""
    return f"{cell:.4g}" if name == "mu" else f"{cell:.1f}" if name == "speed_kt" else f"{cell:.2f}"
