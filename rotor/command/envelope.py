"""`envelope`: the largest load factor and mass over speed, top speed and ceiling, for twists fixed and moving."""

import argparse
from typing import Any

from rotor.command.common import (
    add_command,
    add_design_arguments,
    add_output_arguments,
    bar,
    check_output,
    design_from,
    print_result,
    write_records,
)  # fmt: skip
from rotor.study.envelope import SPEEDS, Envelope, Reach, envelope
from rotor.terminal import wrapped
from rotor.user_input import parse_range


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands,
        "envelope",
        run,
        "largest load factor and mass over speed, top speed and ceiling, by stall and engines",
    )
    add_design_arguments(parser, twists=True)
    parser.add_argument("--mu", dest="speeds", metavar="A:B:STEP", help="advance ratios (default 0:0.4:0.1)")
    parser.add_argument(
        "--moving", action="store_true", help="the linear twist of least power at each speed too, as if moved in flight"
    )
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """0 when the rotor flies at every speed, else 1."""
    speeds = parse_range(args.speeds) if args.speeds else SPEEDS
    designs = [design_from(args, spec) for spec in args.twist or [None]]
    for speed in speeds:  # Bad input is reported first.
        designs[0].at(mu=speed)
    check_output(args)
    asked = [(design, False) for design in designs] + [(designs[0], True)] * args.moving
    with bar(len(asked) * len(speeds), "speed") as advance:
        envelopes = [
            envelope(design, speeds, moving=moving, tell=lambda point: advance(f"µ {point.mu:g}"))
            for design, moving in asked
        ]
    rows = [{"envelope": each.label, **point.record()} for each in envelopes for point in each.points]
    if args.csv:
        write_records(args.csv, rows)
    print_result(args, lambda: [each.record() for each in envelopes], lambda: "\n\n".join(map(report, envelopes)))
    return 0 if all(point.load_factor.value is not None for each in envelopes for point in each.points) else 1


def report(result: Envelope) -> str:
    here, craft = result.design.condition, result.design.aircraft
    lines = [
        ", ".join((craft.name, result.label, f"{here.mass:.0f} kg, {here.altitude:.0f} m", *here.beside)),
        "",
        f"{'µ':<7}{'kt':>6}{'n':>8}  {'limit':<9}{'by stall':>9}{'engines':>9}{'kg at n 1':>11}   twist",
    ]
    for point in result.points:
        row, n = point.record(), point.load_factor
        mass = "" if point.mass_kg is None else f"{point.mass_kg:.0f}"
        lines.append(
            f"{row['mu']:<7g}{row['speed_kt']:>6.0f}{_number(n.value):>8}  {n.limit:<9}{_number(n.stall):>9}"
            f"{_number(n.engines):>9}{mass:>11}   {row['twist']}"
        )
    knots = result.record()["top_speed_kt"]
    mu = "" if knots is None else f" ({knots:.0f} kt)"
    power = craft.installed_power
    source = "Engines: not in the rotor file" if power is None else f"Engines: {power / 1e3:.0f} kW, as at sea level"
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


def _reach(form: str, limit: Reach) -> str:
    return "none found" if limit.value is None else f"{form.format(limit.value)} by {limit.limit}"


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.2f}"
