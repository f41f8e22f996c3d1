"""`python -m explorer`: start the page, print its address, open a browser where there is one."""

import argparse
import sys
import threading
import webbrowser
from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> int:
    """Exit code 0 after Ctrl-C, 2 for bad input."""
    options = _parser().parse_args(arguments)
    try:
        return _run(options)
    except KeyboardInterrupt:
        print()
        return 0


def _run(options: argparse.Namespace) -> int:
    from explorer.app import App, PortBusy
    from explorer.state import Inputs, inputs_of
    from rotor.case import read_case

    try:
        start = inputs_of(read_case(options.design)) if options.design else Inputs()
        app = App(options.host, options.port, start)
    except (ValueError, FileNotFoundError, PortBusy) as error:
        print(f"explorer: {error}", file=sys.stderr)
        return 2
    try:
        print(f"Rotor explorer: {app.address}   (Ctrl-C stops it)", flush=True)
        if not options.no_browser:
            _open_browser(app.address)
        threading.Event().wait()
    finally:
        app.stop()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m explorer", description="Explore helicopter blade twist in a browser."
    )
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine only)")
    parser.add_argument("--port", type=_port, default=8080, help="port to listen on (default 8080)")
    parser.add_argument("--design", metavar="FILE", help="design file (JSON) to start from")
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser")
    return parser


def _port(text: str) -> int:
    if not text.isdigit() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is not a port: give a number in 0…65535")
    return int(text)


def _open_browser(address: str) -> None:
    try:
        webbrowser.get()
    except webbrowser.Error:
        return  # No browser here; the printed address is enough.
    webbrowser.open(address)


if __name__ == "__main__":
    sys.exit(main())
