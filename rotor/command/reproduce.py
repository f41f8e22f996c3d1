"""`reproduce`: rebuilds the figures and tables of the source document."""

import argparse
import sys
import time
from collections.abc import Iterable
from typing import Any

from rotor.command.common import (
    STOPPED,
    add_command,
    add_processes_argument,
    bar,
    interruptible,
    processes_from,
)
from rotor.support.progress import ProgressBar
from rotor.support.user_input import make_folder


def add_parser(commands: Any) -> None:
    parser = add_command(commands, "reproduce", run)
    parser.add_argument(
        "out",
        metavar="OUT_DIR",
        help="folder for CSV, SVG, PNG and results.json; created if missing",
    )
    parser.add_argument(
        "--figure",
        metavar="N",
        action="append",
        help="only this figure, e.g. 3.11; may be repeated",
    )
    number = "table {}".format
    words = "only this table, e.g. 4.1"
    parser.add_argument(
        "--table", metavar="N", action="append", dest="figure", type=number, help=words
    )
    words = "also write the trust page: validation.md, validation/, trust.csv"
    parser.add_argument("--trust", action="store_true", help=words)
    add_processes_argument(parser)


def run(args: argparse.Namespace) -> int:
    """0, or 130 when interrupted."""
    # Imported here: no other command needs the catalogue.
    from rotor.support.plots import drawing_module
    from rotor.support.units import typographic
    from rotor.validation.page import SETS, write_trust
    from rotor.validation.thesis.catalogue import (
        ENTRIES,
        CatalogueEntry,
        find_entry,
        searches_of,
        trust_sets,
    )
    from rotor.validation.thesis.files import write_report, write_results, written
    from rotor.validation.thesis.report import Report
    from rotor.validation.thesis.runs import compute_ahead

    drawing_module()  # Fails before the long searches if matplotlib is missing.
    if args.trust and args.figure:
        raise ValueError("--trust needs every figure: leave --figure out")
    processes = processes_from(args)
    wanted = [find_entry(number) for number in args.figure or ()]
    # In the thesis' order.
    entries = [entry for entry in ENTRIES if entry in wanted] if wanted else list(ENTRIES)
    folder = make_folder(args.out)
    begin = time.perf_counter()
    reports: list[tuple[CatalogueEntry, Report]] = []

    def make(wanted: list[CatalogueEntry]) -> None:
        counted: Iterable[CatalogueEntry] = ProgressBar(
            wanted, disable=not sys.stderr.isatty(), leave=False, unit="figure"
        )
        for entry in counted:
            report = written.known.pop((entry.number, folder), None)
            if report is None:
                report = entry.make()
                write_report(report, folder)
            reports.append((entry, report))
            ProgressBar.write(
                f"{report.title:<14}{report.verdict.value:<18}{typographic(report.finding)}"
            )
            ProgressBar.write(f"{'':<14}{'the document:':<18}{typographic(report.statement)}")

    fast = [entry for entry in entries if not entry.slow]
    groups = searches_of(entries)
    count = sum(map(len, groups))
    stopped = False
    if count:
        print(f"{count} searches, in {processes} processes", file=sys.stderr)
        # Figures without searches come first: a run that is stopped has them, and each is quick.
        figures = [[(written, (entry.number, folder))] for entry in fast]
        with interruptible() as stop, bar(count + len(figures), "step") as advance:
            stopped = compute_ahead([*figures, *groups], processes, advance, stop)
        fast = [entry for entry in fast if (entry.number, folder) in written.known]
    make(fast)
    if not stopped:
        make([entry for entry in entries if entry.slow])
    reports.sort(key=lambda pair: entries.index(pair[0]))
    results = write_results(reports, folder, whole=not wanted)
    if args.trust and not stopped:
        sets = [make_set() for make_set in SETS.values()]
        sets += trust_sets(report for _, report in reports)
        print(f"trust page: {write_trust(sets, folder)}")
    left = f", {len(entries) - len(reports)} left out because of Ctrl-C" if stopped else ""
    print(f"{len(reports)} rebuilt in {time.perf_counter() - begin:.0f} s{left}: {results}")
    return STOPPED if stopped else 0
