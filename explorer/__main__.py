"""`python -m explorer`: start the page, print its address, open a browser where there is one."""

import os
import signal
import sys

_SIGNALS = signal.SIGINT, signal.SIGTERM


def _leave(number: int, frame: object) -> None:
    os._exit(0)


if __name__ == "__main__" or sys.argv[0].endswith("rotor-explorer"):
    # While modules are still read, Ctrl-C and a service's stop find nothing to tidy up.
    for _signal in _SIGNALS:
        signal.signal(_signal, _leave)

import argparse
import webbrowser
from collections.abc import Sequence
from importlib import import_module

from explorer.hosting.request_filter import host_name, is_loopback, warning
from explorer.hosting.server_limits import SESSIONS
from rotor import __version__
from rotor.support.compiled import compiling, why_not_kept
from rotor.support.terminal import OneLineParser, StopSignal, command_words, run_command
from rotor.support.user_input import did_you_mean, shorten

_COMMANDS = {"report": "explorer.export.report", "blade": "explorer.export.blade"}
"""Modules with commands of their own, loaded when one is asked for."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Exit code 0 after Ctrl-C, 2 for bad input; that of their own for `report` and `blade`."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given and given[0] in _COMMANDS:
        if signal.getsignal(signal.SIGINT) is _leave:
            signal.signal(signal.SIGINT, signal.default_int_handler)
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
        return import_module(_COMMANDS[given[0]]).main(given[1:])

    def run() -> int:
        parser = _parser()
        if given and not given[0].startswith("-"):
            remedy = (
                did_you_mean(given[0], _COMMANDS) or f": use {', '.join(_COMMANDS)}, or flags alone"
            )
            parser.error(f"{shorten(given[0])} is not a command{remedy}")
        try:
            return _run(parser.parse_args(given))
        except KeyboardInterrupt:
            print(flush=True)
            # LLVM aborts if the process exits normally while one of its threads runs.
            if compiling():
                os._exit(0)
            return 0

    return run_command("explorer", run)


def _run(options: argparse.Namespace) -> int:
    from explorer.app import App, PortBusy
    from explorer.hosting.server_limits import ServerLimits, limit_log, limit_memory_pools
    from explorer.model.inputs import OPENING, inputs_of
    from rotor import load_design
    from rotor.support.blas_threads import keep_one_blas_thread
    from rotor.support.compiled import log_compiling

    limit_memory_pools()
    keep_one_blas_thread()
    limit_log()
    log_compiling()
    try:
        start = inputs_of(load_design(options.design)) if options.design is not None else OPENING
        limits = ServerLimits(sessions=options.max_sessions, allow_hosts=tuple(options.allow_host))
        app = App(options.host, options.port, start, limits)
    except PortBusy as error:
        raise ValueError(str(error)) from None
    try:
        if not is_loopback(options.host):
            print(warning(options.host), file=sys.stderr, flush=True)
        print(f"Rotor explorer: {app.address}   (Ctrl-C stops it)", flush=True)
        if not options.no_browser:
            _open_browser(app.address)
        stop = StopSignal()
        app.wait_until_warm()
        if unkept := why_not_kept():
            print(unkept, file=sys.stderr, flush=True)
        stop.wait()
    finally:
        app.stop()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=command_words("explorer", "rotor-explorer"),
        description="Explore helicopter blade twist in a browser.",
        epilog="Further commands with their own --help: report (designs side by side as an HTML file), "
        "blade (its shape as STL).",
        examples=(
            ("The page on another port, without opening a browser", "--port 8090 --no-browser"),
            ("From a saved design", "--design mine.json"),
        ),
    )
    parser.add_argument("--version", action="version", version=f"rotor-explorer {__version__}")
    words = "address to listen on (default: this machine only)"
    parser.add_argument("--host", default="127.0.0.1", metavar="ADDRESS", help=words)
    parser.add_argument(
        "--port", type=_port, default=8080, metavar="N", help="port to listen on (default 8080)"
    )
    parser.add_argument("--design", metavar="FILE", help="design file to start from")
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser")
    words = (
        "further host name by which the page is reached, as behind a reverse proxy; may be repeated"
    )
    parser.add_argument(
        "--allow-host", metavar="NAME", type=_host_name, action="append", default=[], help=words
    )
    words = f"largest number of active pages (default {SESSIONS}); others wait"
    parser.add_argument("--max-sessions", metavar="N", type=_sessions, default=SESSIONS, help=words)
    return parser


def _port(text: str) -> int:
    if not text.isdigit() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is not a port: give a number in 0…65535")
    return int(text)


def _host_name(text: str) -> str:
    try:
        return host_name(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _sessions(text: str) -> int:
    if not text.isdigit() or not 1 <= int(text) <= 1000:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of pages: give 1…1000")
    return int(text)


def _open_browser(address: str) -> None:
    try:
        webbrowser.get()
    except webbrowser.Error:
        return  # No browser on this machine; the printed address is enough.
    webbrowser.open(address)


if __name__ == "__main__":
    sys.exit(main())
