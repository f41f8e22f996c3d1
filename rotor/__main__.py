"""`python -m rotor`: the command line. Exit codes: 0 converged, 1 not converged, 2 bad input."""

import argparse
import sys
from collections.abc import Mapping
from importlib import import_module

from rotor import __version__
from rotor.command.names import COMMANDS
from rotor.support.blas_threads import keep_one_blas_thread
from rotor.support.terminal import OneLineParser, command_words, run_command

_COMPLETION = "completion"


def build_parser(command: str | None = None) -> argparse.ArgumentParser:
    """The parser of all commands, or of one with its flags where its name is given: to read the others takes a
    second."""
    parser = OneLineParser(
        prog=command_words("rotor", "rotor"),
        description="Helicopter main rotors: trim, power, twist.",
        epilog="For the flags and examples of a command: COMMAND --help",
    )
    parser.add_argument("--version", action="version", version=f"rotor-explorer {__version__}")
    commands = parser.add_subparsers(
        dest="command", required=True, metavar="COMMAND", parser_class=OneLineParser
    )
    for name, (where, words, _) in COMMANDS.items():
        if command in (None, name):
            module, _, add = where.partition(".")
            getattr(import_module(f"rotor.command.{module}"), add)(commands)
        else:
            commands.add_parser(name, help=words)

    def complete(_: argparse.Namespace) -> int:
        print(completion(commands.choices, "rotor"))
        return 0

    words = "print a shell script that completes commands and flags with Tab"
    hint = (
        'Use eval "$(rotor completion)"; in zsh first run autoload -U bashcompinit && bashcompinit.'
    )
    examples = (("Print the script", ""),)
    commands.add_parser(_COMPLETION, help=words, description=hint, examples=examples).set_defaults(
        run=complete
    )
    return parser


def completion(commands: Mapping[str, argparse.ArgumentParser], script: str) -> str:
    """A script with which bash, or zsh after bashcompinit, completes commands and flags."""
    flags = {
        name: " ".join(sorted(command._option_string_actions)) for name, command in commands.items()
    }  # pyright: ignore[reportPrivateUsage]
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

    def run() -> int:
        given = sys.argv[1:] if argv is None else argv
        first = given[0] if given else ""
        parser = build_parser(
            first if first in COMMANDS or first in ("", "-h", "--help", "--version") else None
        )
        if not given:
            parser.print_help()
            return 0
        args = parser.parse_args(argv)
        keep_one_blas_thread()
        code = args.run(args)
        compiled = sys.modules.get("rotor.support.compiled")  # Not every command reads it.
        if compiled is not None and first != "warm" and (unkept := compiled.why_not_kept()):
            print(f"rotor: {unkept}", file=sys.stderr)
        return code

    return run_command("rotor", run)


if __name__ == "__main__":
    raise SystemExit(main())
