"""The argument parser of all commands."""

import argparse
from functools import partial

from rotor import __version__
from rotor.command import actuator, airfoil, bench, optimise, reproduce, schedule, solve, study, tables, validate
from rotor.terminal import OneLineParser


def build_parser() -> argparse.ArgumentParser:
    """All commands."""
    parser = OneLineParser(
        prog="python -m rotor",
        description="Helicopter main rotors: trim, power, twist.",
        epilog="Each command has its --help.",
        formatter_class=partial(
            argparse.HelpFormatter, indent_increment=1
        ),  # Every name has its help on the same line.
    )
    parser.add_argument("--version", action="version", version=f"rotor-explorer {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=OneLineParser)
    for add in (
        solve.add_parser,
        tables.add_sweep,
        tables.add_front,
        tables.add_waterfall,
        optimise.add_parser,
        schedule.add_parser,
        study.add_parser,
        tables.add_ideal,
        actuator.add_parser,
        reproduce.add_parser,
        reproduce.add_ladder,
        validate.add_parser,
        airfoil.add_parser,
        bench.add_parser,
    ):
        add(commands)
    return parser
