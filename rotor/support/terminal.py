"""What both command lines share: errors as one line on stderr, and text that any terminal or pipe can take."""

import argparse
import codecs
import contextlib
import io
import os
import re
import shutil
import signal
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, cast

from rotor.support.user_input import brief, did_you_mean, raise_interrupt

_ASCII = {
    "−": "-", "–": "-", "…": "...", "≤": "<=", "≥": ">=", "≈": "~", "→": "->", "×": "x", "·": "*", "±": "+/-",
    "°": " deg", "²": "^2", "³": "^3", "½": "1/2", "√": "sqrt", "∞": "inf", "µ": "mu", "μ": "mu", "α": "alpha",
    "β": "beta", "δ": "delta", "Δ": "Delta", "θ": "theta", "κ": "kappa", "λ": "lambda", "π": "pi", "ρ": "rho",
    "σ": "sigma", "φ": "phi", "ψ": "psi", "Ω": "Omega",
}  # fmt: skip
"""What stands for a character that an output cannot encode; any other becomes a question mark."""
_ERRORS = "rotor-ascii"


_PROGRAMS = ("-m", "rotor")
"""What `sys.argv` begins with while `python -m rotor` and the installed command read their modules."""


def stop_while_read() -> None:
    """Let Ctrl-C end the command without a traceback while its modules are still read."""
    if (
        Path((sys.argv or [""])[0]).name in _PROGRAMS
        and threading.current_thread() is threading.main_thread()
    ):
        signal.signal(signal.SIGINT, _leave)


def _leave(number: int, frame: object) -> NoReturn:
    del number, frame
    _say("rotor: stopped")
    os._exit(130)


def command_words(package: str, script: str) -> str:
    """What a user types to run it: the installed script where that was called, else the package."""
    return script if Path(sys.argv[0]).stem == script else f"python -m {package}"


def _columns() -> int:
    return min(max(shutil.get_terminal_size((100, 24)).columns, 60), 100)


class _HelpFormatter(argparse.HelpFormatter):
    """Lines that fit the terminal, at most 100 letters; an indented line is a command, which stays whole."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, indent_increment=1, width=_columns())

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        lines = text.splitlines()
        return "\n".join(
            line if line[:3] == "   " else textwrap.fill(indent + line, width) for line in lines
        )

    def _split_lines(self, text: str, width: int) -> list[str]:
        return textwrap.wrap(" ".join(text.split()), width, break_on_hyphens=False)


class OneLineParser(argparse.ArgumentParser):
    """Reports errors in one line and suggests the nearest name for one that is not known.

    `examples`: what each shows, and the words after the program's name. They follow the flags in the help.
    """

    def __init__(
        self, *args: Any, examples: Sequence[tuple[str, str]] = (), **options: Any
    ) -> None:
        super().__init__(
            *args, **{"formatter_class": _HelpFormatter, "allow_abbrev": False, **options}
        )
        self.examples = examples
        if examples:
            lines = (f" {shown}:\n   {self.prog} {words}".rstrip() for shown, words in examples)
            self.epilog = "\n".join(
                ("examples:", *lines, *(("", self.epilog) if self.epilog else ()))
            )
        # Also lists and ranges: --rate-deg -20,0.
        self._negative_number_matcher = re.compile(r"^-\.?\d")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Parse as argparse does; a value that is given but empty is an error, not the default."""
        options, rest = super().parse_known_args(args, namespace)
        for name, value in vars(options).items():
            items = cast(list[Any], value if isinstance(value, list) else [value])
            if any(isinstance(item, str) and not item.strip() for item in items):
                self.error(f"{name.replace('_', '-')} is empty: give a value, or leave it out")
        for flag in rest:
            if flag.startswith("--"):
                name = flag.partition("=")[0]
                known = self._option_string_actions.keys() - {"--help"}
                self.error(
                    f"{name} is not a flag of this command{did_you_mean(name, sorted(known))}"
                )
        return options, rest

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            known = [str(choice) for choice in action.choices]
            what = "command" if action.dest == "command" else "value"
            hint = did_you_mean(str(value), known) or ":"
            raise argparse.ArgumentError(
                action, f"{str(value)!r} is not a known {what}{hint} use {', '.join(known)}"
            )

    def error(self, message: str) -> NoReturn:
        """One sentence for `run_command`."""
        raise ValueError(f"{message}; see {self.prog} --help")


class StopSignal:
    """Ctrl-C and a service manager's stop (SIGINT, SIGTERM): a KeyboardInterrupt at once, and remembered.

    Python discards an exception that comes up in the callback of a weak reference or in a finalizer. A program that
    only waits for the exception would then run on.
    """

    def __init__(self) -> None:
        self._came = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._stop)

    def _stop(self, number: int, frame: object) -> NoReturn:
        del number, frame
        self._came = True
        raise KeyboardInterrupt

    def wait(self) -> NoReturn:
        """KeyboardInterrupt when a signal comes, or if one has come."""
        while not self._came:
            time.sleep(0.2)
        raise KeyboardInterrupt


def wrapped(text: str, indent: str = "") -> str:
    """A sentence in lines that fit the terminal, or 100 letters; all but the first begin with `indent`."""
    return textwrap.fill(
        text, _columns(), subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )


def run_command(program: str, run: Callable[[], int]) -> int:
    """The exit code of `run`. Bad input and an output that cannot be written give 2 and one line on stderr."""
    # Python has None for a stream that is closed, as by `2>&-`: whoever closes stderr wants no messages.
    sys.stderr = sys.stderr or Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - until the process ends
    if sys.stdout is None:
        _say(f"{program}: the output is closed: write it to a file, or to {os.devnull}")
        return 2
    make_encodable()
    if signal.getsignal(signal.SIGINT) is _leave:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        try:
            code = run()
        except Exception as error:
            raise_interrupt(error)
            raise
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # The reader of the pipe has closed it.
        _discard_output()
        return 0
    except KeyboardInterrupt:
        _say(f"{program}: stopped")
        return 130
    except (ValueError, OverflowError) as error:
        _say(f"{program}: {brief(error)}")
    except RecursionError:
        _say(f"{program}: the input is nested too deeply: simplify it")
    except MemoryError:
        _say(f"{program}: there is not enough memory: ask for less at once")
    except OSError as error:
        _say(f"{program}: {brief(_sentence(error))}")
        _discard_output()
    return 2


def make_encodable() -> None:
    """Write characters that stdout or stderr cannot encode, as in a pipe on Windows, in ASCII rather than fail."""
    codecs.register_error(_ERRORS, _in_ascii)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=_ERRORS)


def _in_ascii(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    failed = error.object[error.start : error.end]
    return "".join(_ASCII.get(letter, "?") for letter in failed), error.end


def _sentence(error: OSError) -> str:
    if error.strerror is None:  # Raised by a library, with a sentence of its own.
        return f"{error or type(error).__name__}"
    if error.filename is None:
        return f"the output cannot be written ({error.strerror}): free the disk, or write elsewhere"
    return f"{str(error.filename)!r} cannot be used ({error.strerror}): check the path"


def _say(line: str) -> None:
    with contextlib.suppress(OSError, ValueError):
        print(line, file=sys.stderr, flush=True)


def _discard_output() -> None:
    """Python writes what is left in its buffers when it ends, and would fail once more."""
    with contextlib.suppress(OSError, ValueError):
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, sys.stdout.fileno())
        os.close(null)
