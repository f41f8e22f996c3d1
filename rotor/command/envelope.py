"""`envelope`: the largest load factor and mass over speed, top speed and ceiling, for twists fixed and moving."""

import argparse
from typing import Any

from rotor.command import common
from rotor.study.envelope import SPEEDS, Envelope, LimitReached, envelope
from rotor.support.table import Table, table
from rotor.support.terminal import wrapped
from rotor.support.user_input import parse_range


def add_parser(commands: Any) -> None:
    parser = common.add_command(commands, "envelope", run)
    parser.add_argument("--mu", dest="speeds", metavar="A:B:STEP", help="range of advance ratios (default 0:0.4:0.1)")
    parser.add_argument(
        "--moving",
        action="store_true",
        help="also with the linear twist of least power at each speed, as if it changed in flight",
    )
    common.add_design_arguments(parser, twists=True)
    common.add_output_arguments(parser, "the table")


def run(args: argparse.Namespace) -> int:
    """0 when the rotor flies at every speed, else 1."""
    speeds = parse_range(args.speeds) if args.speeds else SPEEDS
    designs = [common.design_from(args, spec) for spec in args.twist or [None]]
    for speed in speeds:  # Bad input is reported first.
        designs[0].at(mu=speed)
    common.check_output(args)
    asked = [(design, False) for design in designs] + [(designs[0], True)] * args.moving
    with common.bar(len(asked) * len(speeds), "speed") as advance:
        envelopes = [
            envelope(design, speeds, moving=moving, tell=lambda point: advance(f"µ {point.mu:g}"))
            for design, moving in asked
        ]
    if args.csv:
        points_table(*envelopes).write(args.csv)
    common.print_result(
        args, lambda: [each.record() for each in envelopes], lambda: "\n\n".join(map(report, envelopes))
    )
    return 0 if all(point.load_factor.value is not None for each in envelopes for point in each.points) else 1


def points_table(*envelopes: Envelope) -> Table:
    """A row for each point: the keys of its record, and which envelope it is of."""
    columns = (
        "envelope; mu|µ|g; speed_kt|kt|.0f; twist|twist|<; load_factor|n|.2f; limit|limit|<; "
        "load_factor_stall|by stall|.2f; load_factor_engines|engines|.2f; mass_kg|kg at n 1|.0f"
    )
    return table(columns, ((each.label, *point.record().values()) for each in envelopes for point in each.points))


def report(result: Envelope) -> str:
    here, craft = result.design.condition, result.design.aircraft
    lines = [
        ", ".join((craft.name, result.label, f"{here.mass:.0f} kg, {here.altitude:.0f} m", *here.unusual)),
        "",
        points_table(result).text(),
    ]
    knots = result.record()["top_speed_kt"]
    mu = "" if knots is None else f" ({knots:.0f} kt)"
    power = craft.installed_power
    source = (
        "Engines: not in the rotor file"
        if power is None
        else f"Engines: {power / 1e3:.0f} kW, as at sea level on a standard day"
    )
    lines += [
        "",
        f"top speed  {_reach('µ {:.3f}', result.top_speed)}{mu}",
        f"ceiling    {_reach('{:.0f} m', result.ceiling)} at µ {here.advance_ratio:g}",
        wrapped(
            f"{source}; gearboxes and accessories are left out, so limits by engines are upper bounds. n is of a "
            "steady turn at the propulsive force of straight flight."
        ),
    ]
    return "\n".join(lines)


def _reach(form: str, limit: LimitReached) -> str:
    return "none found" if limit.value is None else f"{form.format(limit.value)} by {limit.limit}"
