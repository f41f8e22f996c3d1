"""The source document: `reproduce` rebuilds its figures, `ladder` changes its assumptions one at a time."""

import argparse
import math
import sys
import time
from collections.abc import Sequence
from typing import Any

from tqdm import tqdm

from rotor.command.common import (
    STOPPED,
    add_command,
    add_output_arguments,
    add_processes_argument,
    bar,
    check_output,
    interruptible,
    print_result,
    processes_from,
    write_table,
)
from rotor.reproduce.ladder import (
    FAST,
    FAST_KMH,
    HOVER,
    NOTHING,
    SPEEDS,
    TRIM,
    Ladder,
    Least,
    MovingTwist,
    Step,
    Ways,
    calls,
    check_speeds,
    climb,
)
from rotor.user_input import make_folder, parse_range


def add_parser(commands: Any) -> None:
    parser = add_command(
        commands, "reproduce", run, "rebuilds every figure and table of the thesis that can be rebuilt"
    )
    parser.add_argument("out", metavar="OUT_DIR", help="folder for CSV, SVG, PNG and index.html; made when missing")
    parser.add_argument(
        "--figure", metavar="N", action="append", help="only this one, for example 3.11 or 'table 4.1'; repeatable"
    )
    parser.add_argument(
        "--trust",
        action="store_true",
        help="also make the trust page: validation.md, validation/, trust.csv",
    )
    add_processes_argument(parser)


def run(args: argparse.Namespace) -> int:
    """0, or 130 when interrupted."""
    # Here, because no other command needs the catalogue.
    from rotor.plots import drawing_module
    from rotor.reproduce.catalogue import ENTRIES, CatalogueEntry, find_entry, searches_of, trust_sets
    from rotor.reproduce.page import write_all, write_report, written
    from rotor.reproduce.report import Report
    from rotor.reproduce.runs import compute_ahead
    from rotor.units import typographic
    from rotor.validation.page import SETS, write_trust

    drawing_module()  # Missing, it is said before the searches.
    if args.trust and args.figure:
        raise ValueError("--trust needs every figure: leave --figure out")
    processes = processes_from(args)
    wanted = [find_entry(number) for number in args.figure or ()]
    entries = [entry for entry in ENTRIES if entry in wanted] if wanted else list(ENTRIES)  # In the thesis' order.
    folder = make_folder(args.out)
    begin = time.perf_counter()
    reports: list[tuple[CatalogueEntry, Report]] = []

    def make(wanted: list[CatalogueEntry]) -> None:
        for entry in tqdm(wanted, disable=not sys.stderr.isatty(), leave=False, unit="figure"):
            report = written.known.pop((entry.number, folder), None)
            if report is None:
                report = entry.make()
                write_report(report, folder)
            reports.append((entry, report))
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
    reports.sort(key=lambda pair: entries.index(pair[0]))
    page = write_all(reports, folder)
    if args.trust and not stopped:
        sets = [make_set() for make_set in SETS.values()]
        sets += trust_sets(report for _, report in reports)
        print(f"trust page: {write_trust(sets, folder)}")
    left = f", {len(entries) - len(reports)} left out because of Ctrl-C" if stopped else ""
    print(f"{len(reports)} rebuilt in {time.perf_counter() - begin:.0f} s{left}: {page}")
    return STOPPED if stopped else 0


def add_ladder(commands: Any) -> None:
    parser = add_command(
        commands,
        "ladder",
        run_ladder,
        "from preset thesis to flight, one assumption at a time: how far it moves the best twist",
    )
    parser.add_argument("--mu", metavar="A:B:STEP", help="hover (0) and advance ratios (default 0,0.1,0.15,…,0.35)")
    add_processes_argument(parser)
    add_output_arguments(parser)


def run_ladder(args: argparse.Namespace) -> int:
    """0, or 130 when interrupted."""
    from rotor.reproduce.runs import compute_ahead

    speeds = check_speeds(parse_range(args.mu)) if args.mu else SPEEDS
    check_output(args)
    groups = calls(speeds)
    with interruptible() as stop, bar(len({call for group in groups for call in group}), "optimum") as advance:
        if compute_ahead(groups, processes_from(args), advance, stop):
            return STOPPED
    ladder = climb(speeds)
    if args.csv:
        write_table(args.csv, ladder_rows(ladder))
    print_result(args, lambda: ladder_record(ladder), lambda: ladder_text(ladder))
    return 0


def ladder_text(ladder: Ladder) -> str:
    heads = ["hover" if mu == 0.0 else f"µ {mu:g}" for mu in ladder.speeds]
    wide = 46
    lines = [
        "UH-60A, 8322.4 kg, sea level: linear twist of least total power [°/R]; each line changes one assumption more.",
        "Moves, at the µ named: in the ladder / changed alone on thesis / taken back alone from flight. Saves: what a",
        "moving twist saves beyond the best fixed one, equal time at each speed.",
        f"−17.3° over −11.5°: main-rotor power at {FAST_KMH:.0f} km/h; Keys et al. measured {100 * FAST:+.0f} %.",
        "",
        f"{'':<{wide}}" + "".join(f"{head:>8}" for head in heads)
        + "".join(f"{f'moves at {mu:g}':>21}" for mu in ladder.named) + f"{'saves':>9}{'−17.3/−11.5':>13}",
    ]  # fmt: skip
    for step in ladder.steps:
        moved = _moves(step) if step.moves else f"{'':{21 * len(ladder.named)}}"
        lines.append(f"{step.words:<{wide}}{_rates(step.best)}{moved}{_end(step)}")
        if step.name == TRIM[-1]:
            lines.append(f"{'  ' + ladder.trim.words:<{wide}}{'':{8 * len(heads)}}{_moves(ladder.trim)}")
    lines += [
        f"Eight rigid blades of half the chord in place of four move it by {ladder.eight_blades_deg:+.1f}°.",
        f"Without fuselage drag, which tilts the disk, the best of flight is {ladder.without_drag_deg:.1f}°.",
        "",
        "flight with each inflow model",
    ]
    lines += [
        f"{row.inflow:<{wide}}{_rates(row.best)}{'':{21 * len(ladder.named)}}{100 * row.moving.gain:7.2f} %"
        for row in ladder.inflows
    ]
    return "\n".join(lines)


def ladder_rows(ladder: Ladder) -> list[tuple[str, ...]]:
    """The CSV: a line for each step, or inflow model of the preset flight, and advance ratio.

    A step moves the best twist in the ladder, alone on thesis, and taken back alone from flight, at some of them.
    """
    rows = [("step", "mu", "best_twist_deg", "power_w", *(f"{way}_deg" for way in Ways._fields))]
    for name, best, moves in (
        *((step.name, step.best, step.moves) for step in ladder.steps),
        *((row.inflow, row.best, ()) for row in ladder.inflows),
    ):
        moved = dict(zip(ladder.named, moves, strict=False))
        for mu, least in zip(ladder.speeds, best, strict=True):
            ways = (f"{way:.3f}" for way in moved[mu]) if mu in moved else [""] * len(Ways._fields)
            rows.append((name, f"{mu:g}", f"{least.rate_deg:.3f}", f"{1e3 * least.power_kw:.1f}", *ways))
    return rows


def _rates(best: Sequence[Least]) -> str:
    return "".join(f"{twist.rate_deg:8.1f}" for twist in best)


def _moves(step: Step) -> str:
    words = (" / ".join("–" if abs(way) < NOTHING else f"{way:+.1f}" for way in ways) for ways in step.moves)
    return "".join(f"{word:>21}" for word in words)


def _end(step: Step) -> str:
    return f"{100 * step.moving.gain:7.2f} %{100 * step.strong_over_weak[1]:+11.1f} %"


def ladder_record(ladder: Ladder) -> dict[str, Any]:
    return {
        "speeds_mu": list(ladder.speeds),
        "named_mu": list(ladder.named),
        "steps": [_step_record(step) for step in ladder.steps],
        "trim": _step_record(ladder.trim),
        "eight_blades_deg": ladder.eight_blades_deg,
        "without_drag_deg": ladder.without_drag_deg,
        "wakes": [
            {"inflow": row.inflow, **_least_record(row.best), **_moving_record(row.moving)} for row in ladder.inflows
        ],
        "measured": {"hover_percent": 100 * HOVER, "fast_percent": 100 * FAST, "fast_km_h": FAST_KMH},
    }


def _step_record(step: Step) -> dict[str, Any]:
    hover, fast = step.strong_over_weak
    return {
        "step": step.name,
        "change": step.words,
        **_least_record(step.best),
        # Those at the fastest of the named speeds; `moves` has them all.
        "moves_deg": step.moves[-1].in_ladder if step.moves else None,
        "alone_on_thesis_deg": step.moves[-1].alone_on_thesis if step.moves else None,
        "alone_off_flight_deg": step.moves[-1].alone_off_flight if step.moves else None,
        "moves": [{f"{name}_deg": way for name, way in ways._asdict().items()} for ways in step.moves],
        **_moving_record(step.moving),
        "strong_over_weak_percent": {"hover": 100 * hover, "fast": 100 * fast},
    }


def _least_record(best: Sequence[Least]) -> dict[str, Any]:
    return {
        "best_twist_deg": [twist.rate_deg for twist in best],
        "band_deg": [None if math.isnan(sum(twist.band_deg)) else list(twist.band_deg) for twist in best],
        "power_w": [1e3 * twist.power_kw for twist in best],
    }


def _moving_record(twist: MovingTwist) -> dict[str, float]:
    return {"best_fixed_deg": twist.fixed_deg, "moving_saves_percent": 100.0 * twist.gain}
