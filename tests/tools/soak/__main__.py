"""`python -m tests.tools.soak`: the command."""

import argparse
import json
import sys

from tests.tools.soak.figures import words
from tests.tools.soak.run import Soak, soak


def main(arguments: list[str] | None = None) -> int:
    """Exit code 0 when it passed, 1 when memory grew or an update was lost, 2 for bad input."""
    options = _parser().parse_args(arguments)
    plan = Soak(options.browsers, options.minutes, options.rate, options.real)
    try:
        report = soak(plan, lambda line: print(line, file=sys.stderr, flush=True))
    except RuntimeError as error:
        print(f"soak: {error}", file=sys.stderr)
        return 2
    print(json.dumps(report.as_json(), indent=2) if options.json else words(report))
    return 0 if report.passed else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m tests.tools.soak",
        description="Send many browsers to a server of its own, each dragging a slider, and report what it did to "
        "them: delays from edit to frame, lost updates, memory.",
    )
    parser.add_argument(
        "--browsers", type=_count, default=Soak.browsers, metavar="N", help="how many at once (default 20)"
    )
    parser.add_argument(
        "--minutes", type=_positive, default=Soak.minutes, metavar="MIN", help="how long they drag (default 10)"
    )
    parser.add_argument(
        "--rate", type=_positive, default=Soak.rate, metavar="HZ", help="edits a second while dragging (default 20)"
    )
    parser.add_argument("--real", type=_pages, default=0, metavar="K", help="and K pages of Chromium")
    parser.add_argument("--json", action="store_true", help="print the report as JSON")
    return parser


def _count(text: str) -> int:
    if not text.isdigit() or not 1 <= int(text) <= 500:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of browsers: give 1…500")
    return int(text)


def _pages(text: str) -> int:
    return 0 if text == "0" else _count(text)


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < 1e6:
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number")
    return value


if __name__ == "__main__":
    sys.exit(main())
