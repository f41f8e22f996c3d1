"""The source document: `reproduce` rebuilds its figures, `ladder` changes its assumptions one at a time."""

import argparse
import json
import os
import sys
import time
from typing import Any

from tqdm import tqdm

from rotor.command.common import STOPPED, add_command, bar, interruptible
from rotor.user_input import make_folder, parse_range


def add_parser(commands: Any) -> None:
    """Register the command."""
    parser = add_command(commands, "reproduce", "rebuilds every figure and table of the thesis that can be rebuilt")
    parser.add_argument("out", metavar="OUT_DIR", help="folder for CSV, SVG, PNG and index.html; made when missing")
    parser.add_argument(
        "--figure", metavar="N", action="append", help="only this one, for example 3.11 or 'table 4.1'; repeatable"
    )
    parser.add_argument(
        "--trust",
        action="store_true",
        help="also make the trust page: validation.md, validation/, trust.csv, sensitivity.csv",
    )
    parser.add_argument("--processes", type=int, metavar="N", help="processes to use (default: one a core, at most 4)")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """0, or 130 when interrupted."""
    # Here, because no other command needs the catalogue.
    from rotor.reproduce.catalogue import ENTRIES, CatalogueEntry, find_entry, searches_of, trust_sets
    from rotor.reproduce.page import write_all, write_report, written
    from rotor.reproduce.report import Report, typographic
    from rotor.reproduce.runs import compute_ahead
    from rotor.validation.page import SETS, write_trust
    from rotor.validation.sensitivity import sensitivity

    if args.trust and args.figure:
        raise ValueError("--trust needs every figure: leave --figure out")
    processes = _processes(args)
    wanted = [find_entry(number) for number in args.figure or ()]
    entries = [entry for entry in ENTRIES if entry in wanted] if wanted else list(ENTRIES)  # In the thesis' order.
    folder = make_folder(args.out)
    begin = time.perf_counter()
    made: list[tuple[CatalogueEntry, Report]] = []

    def make(wanted: list[CatalogueEntry]) -> None:
        for entry in tqdm(wanted, disable=not sys.stderr.isatty(), leave=False, unit="figure"):
            report = written.known.pop((entry.number, folder), None)
            if report is None:
                report = entry.make()
                write_report(report, folder)
            made.append((entry, report))
            tqdm.write(f"{report.title:<14}{report.verdict.value:<14}{typographic(report.ours)}")

    fast = [entry for entry in entries if not entry.slow]
    groups = searches_of(entries)
    count = sum(map(len, groups))
    stopped = False
    if count:
        print(f"{count} searches, in {processes} processes", file=sys.stderr)
        # Figures without searches come first: a page that is stopped has them, and each takes a second at most.
        figures = [[(written, (entry.number, folder))] for entry in fast]
        with interruptible() as stop, bar(count + len(figures), "step") as advance:
            stopped = compute_ahead([*figures, *groups], processes, advance, stop)
        fast = [entry for entry in fast if (entry.number, folder) in written.known]
    make(fast)
    if not stopped:
        make([entry for entry in entries if entry.slow])
    made.sort(key=lambda pair: entries.index(pair[0]))
    page = write_all(made, folder)
    if args.trust and not stopped:
        sets = [make_set() for make_set in SETS.values()]
        sets += trust_sets(report for _, report in made)
        print(f"trust page: {write_trust(sets, list(sensitivity()), folder)}")
    left = f", {len(entries) - len(made)} left out because of Ctrl-C" if stopped else ""
    print(f"{len(made)} rebuilt in {time.perf_counter() - begin:.0f} s{left}: {page}")
    return STOPPED if stopped else 0


def add_ladder(commands: Any) -> None:
    """Register `ladder`."""
    parser = add_command(
        commands, "ladder", "from preset thesis to flight, one assumption at a time: how far it moves the best twist"
    )
    parser.add_argument("--mu", metavar="A:B:STEP", help="hover (0) and advance ratios (default 0,0.1,0.15,…,0.35)")
    parser.add_argument("--processes", type=int, metavar="N", help="processes to use (default: one a core, at most 4)")
    parser.add_argument("--json", action="store_true", help="machine-readable output")
    parser.set_defaults(run=run_ladder)


def run_ladder(args: argparse.Namespace) -> int:
    """0, or 130 when interrupted."""
    from rotor.reproduce.ladder import SPEEDS, calls, check_speeds, climb, record, text
    from rotor.reproduce.runs import compute_ahead

    speeds = check_speeds(parse_range(args.mu)) if args.mu else SPEEDS
    groups = calls(speeds)
    with interruptible() as stop, bar(len({call for group in groups for call in group}), "optimum") as advance:
        if compute_ahead(groups, _processes(args), advance, stop):
            return STOPPED
    found = climb(speeds)
    print(json.dumps(record(found), indent=2, allow_nan=False) if args.json else text(found))
    return 0


def _processes(args: argparse.Namespace) -> int:
    """How many were asked for, or one a core; ValueError outside 1…64."""
    count = args.processes if args.processes is not None else min(os.cpu_count() or 1, 4)
    if not 1 <= count <= 64:
        raise ValueError(f"{count} processes are outside 1…64: give one a core")
    return count
