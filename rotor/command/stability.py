"""`stability`: damping and frequency of the modes of the trimmed blade, and margins to flutter and divergence."""

import argparse
import json
from collections.abc import Sequence
from typing import Any

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.installation import install
from rotor.actuator.limits import actuator_stability
from rotor.actuator.section import HostBlade, default_placement
from rotor.command import common
from rotor.dynamics.structure import check_blade
from rotor.support.table import CellValue, Table, table
from rotor.support.terminal import wrapped
from rotor.support.user_input import parse_range
from rotor.trim.stability import AIRS, BoundaryPoint, stability, stability_boundary


def add_parser(commands: Any) -> None:
    parser = common.add_command(commands, "stability", run)
    parser.add_argument(
        "--air",
        choices=AIRS,
        default=AIRS[0],
        help="quasi-steady or unsteady lift, which lags by shed vorticity (default quasi-steady)",
    )
    parser.add_argument(
        "--cg-offset-percent",
        type=common.finite,
        default=0.0,
        metavar="PERCENT",
        help="move the centre of gravity of the lifting blade aft by this percentage of the chord (default 0)",
    )
    parser.add_argument(
        "--boundary",
        metavar="A:B:STEP",
        help="also find the torsional stiffness required over centre-of-gravity offsets in per cent of the chord",
    )
    parser.add_argument("--actuator", metavar="ID", help="also analyse the blade with this actuator, e.g. MFC_P1")
    parser.add_argument("--plies", type=int, metavar="N", help=common.PLIES_HELP)
    common.add_design_arguments(parser, speed=True)
    common.add_output_arguments(parser, "the modes, or with --boundary its lines,")


def run(args: argparse.Namespace) -> int:
    """0, or 1 where the design does not trim."""
    design, offset = common.design_from(args), 0.01 * args.cg_offset_percent
    if args.actuator is None and args.plies is not None:
        raise ValueError("--plies needs an actuator: add --actuator, for example MFC_P1")
    offsets = tuple(0.01 * place for place in parse_range(args.boundary)) if args.boundary else ()
    common.check_output(args)
    try:
        if args.actuator is not None:
            check_blade(design.aircraft)
            placement = default_placement(2 if args.plies is None else args.plies)
            result = actuator_stability(
                install(find_actuator(args.actuator), placement, HostBlade(), design.rotor),
                design,
                air=args.air,
                offset=offset,
            )
        else:
            result = stability(design, air=args.air, offset=offset)
        points = stability_boundary(design, offsets, air=args.air)
    except RuntimeError as error:
        message = {"status": "not-converged", "message": str(error)}
        print(json.dumps(message, indent=2) if args.json else f"not converged: {error}")
        return 1
    boundary = boundary_table(points)
    record = result.to_dict() | ({"boundary": boundary.records()} if offsets else {})
    if args.csv:
        modes: list[dict[str, CellValue]] = record["modes"]
        (boundary if offsets else table("; ".join(modes[0]), (mode.values() for mode in modes))).write(args.csv)
    common.print_result(args, lambda: record, lambda: _report(result.table(), boundary))
    return 0


def boundary_table(points: Sequence[BoundaryPoint]) -> Table:
    """Stiffness needed in torsion over the offset of the centre of gravity."""
    columns = (
        "cg_offset_percent_chord|c.g. aft, % c|.1f; instability_stiffness_percent|unstable below %|.0f; "
        "divergence_stiffness_percent|diverges below %|.0f"
    )
    return table(
        columns, ((100.0 * p.offset, 100.0 * p.instability_stiffness, 100.0 * p.divergence_stiffness) for p in points)
    )


def _report(modes: str, boundary: Table) -> str:
    lines = [wrapped(line, "  ") if line.endswith(".") else line for line in modes.splitlines()]
    if boundary.rows:
        lines += ["", "part of the stiffness in torsion", boundary.text()]
    return "\n".join(lines)
