"""`python -m explorer report`: design files → one HTML report, without a page and without a browser."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from explorer.export.report.contents import ReportEntry, report_of
from explorer.export.report.document import report_html
from explorer.model.inputs import ViewState, baseline_of, baseline_title
from explorer.picture.fields import FIELDS
from explorer.scene.still_scene import make_stage
from rotor.files.design_file import load_design
from rotor.terminal import run_command
from rotor.trim.solve import solve
from rotor.user_input import write_whole


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the report is written, 1 when a design does not trim, 2 for bad input."""
    return run_command("explorer report", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    entries = [ReportEntry(Path(file).stem, solve(load_design(file))) for file in options.designs]
    view = ViewState(field=options.field)
    first = entries[0].solution.design
    try:
        report = report_of(ReportEntry(baseline_title(first), solve(baseline_of(first))), entries, view)
    except ValueError as error:
        print(f"explorer report: {error}", file=sys.stderr)
        return 1
    stage = make_stage([entry.solution for entry in report.shown], view, report.colour_range(FIELDS[view.field]))
    try:
        write_whole(options.out, report_html(report, stage))
    except OSError as error:
        print(
            f"explorer report: cannot write {options.out!r} ({error.strerror}): give a writable file", file=sys.stderr
        )
        return 2
    print(f"{options.out}: {len(entries)} design{'s' if len(entries) > 1 else ''}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m explorer report",
        description="Designs side by side as one HTML file that opens without a server.",
    )
    parser.add_argument(
        "designs",
        nargs="+",
        metavar="FILE",
        help="design files (JSON); changes count from the first one's baseline twist",
    )
    parser.add_argument("--out", default="report.html", metavar="FILE", help="where to write (default report.html)")
    parser.add_argument(
        "--field", default=ViewState.field, choices=tuple(FIELDS), metavar="NAME", help=f"in 3D: {', '.join(FIELDS)}"
    )
    return parser
