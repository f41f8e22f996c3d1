"""`python -m rotor`: the command line. Exit codes: 0 converged, 1 not converged, 2 bad input."""

import argparse
import sys
from collections.abc import Mapping

from rotor import __version__
from rotor.blas_threads import keep_one_blas_thread
from rotor.command import (
    actuator,
    envelope,
    optimise,
    reproduce,
    schedule,
    solve,
    stability,
    study,
    tables,
    validate,
    warm,
)
from rotor.command.common import add_command
from rotor.terminal import OneLineParser, called, run_command


def build_parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=called("rotor", "rotor"),
        description="Helicopter main rotors: trim, power, twist.",
        epilog="Each command has its --help.",
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
        envelope.add_parser,
        study.add_parser,
        stability.add_parser,
        actuator.add_parser,
        reproduce.add_parser,
        validate.add_parser,
        tables.add_airfoil,
        warm.add_parser,
    ):
        add(commands)

    def complete(_: argparse.Namespace) -> int:
        print(completion(commands.choices, "rotor"))
        return 0

    add_command(
        commands, "completion", complete, "prints what completes commands and flags of rotor with Tab",
        "For bash: eval \"$(rotor completion)\"; for zsh after autoload -U bashcompinit && bashcompinit.",
    )  # fmt: skip
    return parser


def completion(commands: Mapping[str, argparse.ArgumentParser], script: str) -> str:
    """What bash reads to complete commands and flags of the script; zsh too, after bashcompinit."""
    flags = {name: " ".join(sorted(command._option_string_actions)) for name, command in commands.items()}  # pyright: ignore[reportPrivateUsage]
    cases = "\n".join(f'    {name}) words="{words}" ;;' for name, words in flags.items())
    return f'''_{script}() {{
  local words="{" ".join(commands)}"
  [ "$COMP_CWORD" -gt 1 ] && case "${{COMP_WORDS[1]}}" in
{cases}
  esac
  COMPREPLY=($(compgen -W "$words" -- "${{COMP_WORDS[COMP_CWORD]}}"))
}}
complete -o default -F _{script} {script}'''


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
