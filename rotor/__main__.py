"""`python -m rotor`: the command line. Exit codes: 0 converged, 1 not converged, 2 bad input."""

import argparse
import sys
from functools import partial

from rotor import __version__
from rotor.blas_threads import keep_one_blas_thread
from rotor.command import actuator, bench, optimise, reproduce, schedule, solve, study, tables, validate
from rotor.terminal import OneLineParser, run_command


def build_parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="python -m rotor",
        description="Helicopter main rotors: trim, power, twist.",
        epilog="Each command has its --help.",
        formatter_class=partial(argparse.HelpFormatter, indent_increment=1),  # So names have their help beside them.
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
        tables.add_airfoil,
        bench.add_parser,
    ):
        add(commands)
    return parser


def main(argv: list[str] | None = None) -> int:
    """Run one command; bad input gives one line on stderr."""
    keep_one_blas_thread()

    def run() -> int:
        parser = build_parser()
        if not (sys.argv[1:] if argv is None else argv):
            parser.print_help()
            return 0
        args = parser.parse_args(argv)
        return args.run(args)

    return run_command("rotor", run)


if __name__ == "__main__":
    raise SystemExit(main())
