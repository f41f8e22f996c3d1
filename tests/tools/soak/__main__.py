"""`python -m tests.tools.soak`: many browsers drag a slider for minutes; delays, lost updates and memory."""

import argparse
import json
import sys

from tests.tools.soak.run import soak, words


def main(arguments: list[str] | None = None) -> int:
    """Exit code 0 when it passed, 1 when memory grew or an update was lost, 2 for bad input."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.tools.soak",
        description="Send many browsers to a server of its own, each dragging a slider, and report what it did to "
        "them: delays from edit to frame, lost updates, memory.",
    )
    parser.add_argument("--browsers", type=_count, default=20, metavar="N", help="how many at once (default 20)")
    parser.add_argument("--minutes", type=_positive, default=10.0, metavar="MIN", help="how long (default 10)")
    parser.add_argument("--rate", type=_positive, default=20.0, metavar="HZ", help="edits a second (default 20)")
    parser.add_argument("--json", action="store_true", help="print the report as JSON")
    options = parser.parse_args(arguments)
    try:
        report = soak(
            options.browsers, options.minutes, options.rate, lambda line: print(line, file=sys.stderr, flush=True)
        )
    except RuntimeError as error:
        print(f"soak: {error}", file=sys.stderr)
        return 2
    print(json.dumps(report, indent=2) if options.json else words(report))
    return 0 if report["passed"] else 1


def _count(text: str) -> int:
    if not text.isdigit() or not 1 <= int(text) <= 500:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of browsers: give 1…500")
    return int(text)


def _positive(text: str) -> float:
    value = float(text)
    if not 0.0 < value < 1e6:
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number")
    return value


if __name__ == "__main__":
    sys.exit(main())
