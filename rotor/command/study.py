"""`study`: runs a study file on all cores or on a cluster; `study show`: best points, effects, failures."""

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Generator
from concurrent.futures import Executor
from contextlib import closing, contextmanager
from dataclasses import asdict
from typing import Any

import numpy as np

from rotor.command.common import (
    STOPPED,
    add_command,
    add_output_arguments,
    check_output,
    interruptible,
    print_result,
)
from rotor.study.chunks import FinishedChunk, StudyFolder, StudyFolderError, evaluate_points
from rotor.study.cluster import ExecutorLost, dask_client
from rotor.study.results import Results, best_row, main_effects, read_results, robust_best
from rotor.study.run import ChunkRun, check_workers, local_processes, open_study_folder, run_chunks
from rotor.study.study import Study, check_uncertain
from rotor.study.study_file import StudyFile, read_study
from rotor.support.progress import ProgressBar
from rotor.support.table import Column, table
from rotor.support.terminal import wrapped
from rotor.support.units import power_text

_MOST_MESSAGES = 3
"""Largest number of different failure messages printed."""
_ENOUGH_POINTS = 100
"""Points from which shares of a sample hold: of 20 points an axis that has two thirds once got half a per cent."""


def record(
    results: Results, least: str | None = None, uncertain: tuple[str, ...] | None = None
) -> dict[str, Any]:
    """The JSON of `study show --json`; None where there is no result. ValueError for an unknown column or axis."""
    least, uncertain = _aims(results, least, uncertain)
    row = best_row(results, least)
    messages: list[str] = results.columns["message"][~results.good].tolist()
    robust = robust_best(results, least, uncertain) if uncertain else None
    lists: list[str | None] = results.columns["caveats"].tolist()
    caveats = Counter(name for names in lists if names for name in names.split(", "))
    return {
        "title": results.about.get("title", ""),
        "points": results.points,
        "done": results.rows,
        "failed": int((~results.good).sum()),
        "sentences": dict(Counter(messages).most_common(_MOST_MESSAGES)),
        "caveats": dict(caveats.most_common()),
        "least": least,
        "best": None
        if row is None
        else {name: _plain(column[row]) for name, column in results.columns.items()},
        "uncertain": list(uncertain),
        "robust": robust and asdict(robust),
        "sensitivities": [asdict(effect) for effect in main_effects(results, least)],
        "package_version": results.about.get("package_version", ""),
        "commit": results.about.get("commit") or None,
    }


def report(results: Results, shown: dict[str, Any]) -> str:
    least = shown["least"]

    def value(number: float) -> str:
        return _shown(number, results.unit(least))

    lines = [
        f"{shown['title']}: {shown['done']:,} of {shown['points']:,} points, {shown['failed']:,} failed"
    ]
    best = shown["best"]
    if best is None:
        lines.append(f"no point has a value of {least}")
    else:
        where = [*results.axes, *(name for name in ("twist",) if name not in results.axes)]
        lines += [
            "",
            f"least {least}: {value(best[least])}",
            f"  {_at({name: best[name] for name in where})}",
        ]
    robust = shown["robust"]
    if robust is not None:
        cases = robust["least_worst"]["cases"]
        counts = f"{_count(cases, 'case')}; {_count(robust['designs'], 'design')}"
        lines += ["", f"robust over {', '.join(shown['uncertain'])} ({counts})"]
        for name, design in (
            ("least worst case", robust["least_worst"]),
            ("least mean", robust["least_mean"]),
        ):
            lines.append(
                f"  {name:<17} worst {value(design['worst'])}, mean {value(design['mean'])}: {_at(design['design'])}"
            )
        if robust["dropped"]:
            lines.append(
                f"  {_count(robust['dropped'], 'design')} left out: a case failed or is not finished"
            )
    elif shown["uncertain"]:
        lines += ["", f"no design has a result in every case of {', '.join(shown['uncertain'])}"]
    if shown["sensitivities"]:
        so_far = "" if shown["done"] == shown["points"] else ", from the finished points"
        lines += [
            "",
            f"what {least} depends on{so_far}: share of its variance; mean where that is least … most",
        ]
        for row in shown["sensitivities"]:
            low = f"{value(row['least'])} at {_text(row['least_at'])}"
            high = f"{value(row['most'])} at {_text(row['most_at'])}"
            lines.append(f"  {row['axis']:<20}{100 * row['share']:6.1f} %   {low} … {high}")
        if results.sampled and results.good.sum() < _ENOUGH_POINTS:
            points = _count(int(results.good.sum()), "point")
            lines.append(
                f"  rough: {points} of a sample; with fewer than {_ENOUGH_POINTS}, chance decides the shares"
            )
    if shown["caveats"]:
        each = ", ".join(f"{name} at {count:,}" for name, count in shown["caveats"].items())
        one = "DIR:N" if best is None else f"DIR:{best['point']:.0f}"
        lines += [
            "",
            wrapped(
                f"caveats of points: {each}; python -m rotor solve --row {one} says more", "  "
            ),
        ]
    if shown["failed"]:
        lines += ["", f"{shown['failed']:,} failed, for example:"]
        lines += [f"  {count:,} × {sentence}" for sentence, count in shown["sentences"].items()]
    return "\n".join(lines)


def _aims(
    results: Results, least: str | None, uncertain: tuple[str, ...] | None
) -> tuple[str, tuple[str, ...]]:
    least = least or str(results.about.get("least", "power_total_w"))
    numbers = [name for name in results.columns if results.numeric(name)]
    if least not in numbers:
        raise ValueError(f"column {least!r} does not exist: use one of {', '.join(numbers)}")
    if uncertain is None:
        uncertain = tuple(results.about.get("uncertain", ()))
    else:
        check_uncertain(uncertain, results.axes, results.sampled)
    return least, uncertain


def _plain(value: Any) -> Any:
    if isinstance(value, float):  # numpy's floats are floats as well.
        return float(value) if math.isfinite(value) else None
    return value


def _at(values: dict[str, Any]) -> str:
    return ", ".join(f"{name} {_text(value)}" for name, value in values.items())


def _count(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _shown(number: float, unit: str) -> str:
    if unit == "W":
        return power_text(number, 2)
    return f"{number:.6g}{' ' if unit not in ('', '°', '%') else ''}{unit}"


_PLAIN = (
    "has no encryption and no password: whoever can reach it can run programs on its workers and here; use it on a "
    "trusted network only, or give tls://… (docs/scale.md)"
)
_SAY_EVERY = 60.0
"""[s] between lines of progress without a terminal."""
_TIMED_PLACES = 8
"""All over a study at which a dry run takes the time of some points,"""
_TIMED_SEARCHES = 8
"""this many searches at each, three times as many trims."""


def add_parser(commands: Any) -> None:
    words = "Run a study file. `study show DIR` prints the best point, the robust best design and the sensitivities."
    parser = add_command(commands, "study", run, words)
    words = "study file, shipped example (two_segment.toml), or the word show"
    parser.add_argument("file", metavar="FILE.toml", help=words)
    parser.add_argument(
        "folder", metavar="DIR", nargs="?", help="with show: the --out DIR of a study"
    )
    words = "address of a running Dask cluster, tls://… outside trusted networks (default: the cores of this machine)"
    parser.add_argument("--scheduler", metavar="tcp://HOST:PORT", help=words)
    words = "processes to run on this machine (default: one per core)"
    parser.add_argument("--workers", type=int, metavar="N", help=words)
    words = "folder of the results (default: the file's name); an unfinished study in it is resumed"
    parser.add_argument("--out", metavar="DIR", help=words)
    words = "check the file and estimate the time without running it"
    parser.add_argument("--dry-run", action="store_true", help=words)
    parser.add_argument("--least", metavar="COLUMN", help="with show: the column to minimise")
    parser.add_argument("--uncertain", metavar="AXIS,…", help="with show: axes that are uncertain")
    add_output_arguments(parser, "all points (with show)")


def run(args: argparse.Namespace) -> int:
    """0 if every point converged, 1 if not, 130 if stopped by Ctrl-C or SIGTERM; finished chunks are kept."""
    if args.file == "show":
        return _show(args)
    for flag in ("folder", "least", "uncertain", "csv", "json"):
        if getattr(args, flag):
            name = repr(args.folder) if flag == "folder" else f"--{flag}"
            raise ValueError(f"{name} is for show only: write `study show DIR`")
    file = read_study(args.file)
    if args.workers is not None and args.scheduler:
        raise ValueError(
            "--workers starts processes on this machine, --scheduler uses a cluster: omit one"
        )
    check_workers(args.workers)
    if args.dry_run:
        return _dry_run(file)
    with closing(open_study_folder(file, args.out)) as store:
        return _run(args, store)


def _run(args: argparse.Namespace, store: StudyFolder) -> int:
    study = store.study
    missing = store.missing(_ProgressDisplay.say)
    done = study.count - study.points_of(missing)
    print(f"{study.title}: {study.count:,} points, {done:,} done → {store.folder}", flush=True)
    message, ended = "", ChunkRun()
    if missing:
        with interruptible() as stop, closing(_ProgressDisplay(study.count, done)) as progress:
            try:
                with _executor(args, study) as executor:
                    ended = run_chunks(executor, store, missing, progress.add, stop, progress.say)
            except (ExecutorLost, StudyFolderError) as error:
                message = str(error)
        if progress.points:
            print(progress.sentence())
    return _summary(store, ended, message)


@contextmanager
def _executor(args: argparse.Namespace, study: Study) -> Generator[Executor]:
    """Processes of this machine, or the Dask cluster that is asked for."""
    if args.scheduler is None:
        with local_processes(study, args.workers) as executor:
            yield executor
        return
    with dask_client(args.scheduler) as client:
        if not args.scheduler.startswith("tls://"):
            print(f"rotor: {args.scheduler} {_PLAIN}", file=sys.stderr)
        if not client.nthreads():
            print(
                f"rotor: no workers yet; start some with `dask worker {args.scheduler}`",
                file=sys.stderr,
            )
        yield client.get_executor()


class _ProgressDisplay:
    """A run so far: a bar on a terminal, else a line per minute with rate, time left and failures."""

    def __init__(self, total: int, done: int) -> None:
        self._total, self._before = total, done
        self._begin = self._said = time.monotonic()
        self.points, self._failed = 0, 0
        self._seconds = 0.0
        """Processor time of the workers."""
        self._workers: set[str] = set()
        self._bar: Any = ProgressBar(
            total=total,
            initial=done,
            unit=" points",
            file=sys.stderr,
            dynamic_ncols=True,
            smoothing=0.05,
            disable=not sys.stderr.isatty(),
        )

    def add(self, done: FinishedChunk) -> None:
        self.points += done.rows
        self._failed += done.failures
        self._seconds += done.seconds
        self._workers.add(done.worker)
        self._bar.set_postfix_str(f"{self._failed:,} failed", refresh=False)
        self._bar.update(done.rows)
        if self._bar.disable and time.monotonic() - self._said > _SAY_EVERY:
            self._said = time.monotonic()
            rate, now = self.points / (self._said - self._begin), self._before + self.points
            left = _span((self._total - now) / rate)
            words = f"{now:,} of {self._total:,} points, {_rate(rate)}, {left} left, {self._failed:,} failed"
            print(words, file=sys.stderr, flush=True)

    @staticmethod
    def say(sentence: str) -> None:
        """A line of its own, also beside the bar."""
        ProgressBar.write(f"rotor: {sentence}", file=sys.stderr)

    def close(self) -> None:
        self._bar.close()

    def sentence(self) -> str:
        elapsed = time.monotonic() - self._begin
        rate, each = _rate(self.points / elapsed), 1e3 * self._seconds / self.points
        workers = f"{len(self._workers)} worker{'s' if len(self._workers) > 1 else ''}"
        return f"{self.points:,} points in {_span(elapsed)} on {workers}: {rate}, {each:.2f} ms of processor time each"


def _summary(store: StudyFolder, ended: ChunkRun, message: str) -> int:
    missing = store.missing()
    done = store.study.count - store.study.points_of(missing)
    results = read_results(store.folder) if done else None
    if results is not None:
        print(report(results, record(results)))
    if ended.stopped and missing:
        words = f"rotor: stopped with {done:,} of {store.study.count:,} points kept; run the same command to continue"
        print(words, file=sys.stderr)
        return STOPPED
    if message := message or ended.sentence:
        print(f"rotor: {message}", file=sys.stderr)
    return 0 if not missing and results is not None and results.good.all() else 1


def _show(args: argparse.Namespace) -> int:
    if not args.folder:
        raise ValueError("show needs a folder: write `study show DIR`")
    for flag in ("scheduler", "workers", "out", "dry_run"):
        if getattr(args, flag):
            raise ValueError(
                f"--{flag.replace('_', '-')} is for running a study: omit it with `study show`"
            )
    results = read_results(args.folder)
    uncertain = (
        None
        if args.uncertain is None
        else tuple(name.strip() for name in args.uncertain.split(","))
    )
    shown = record(results, args.least, uncertain)
    check_output(args)
    if args.csv:
        rows = (map(_plain, row) for row in zip(*results.columns.values(), strict=True))
        table((Column(key=name) for name in results.columns), rows).write(args.csv)
    print_result(args, lambda: shown, lambda: report(results, shown))
    return 0


def _dry_run(file: StudyFile) -> int:
    study = file.study
    each, count = estimate(study)
    print(f"{study.title}: {study.count:,} points in {study.chunks:,} chunks of {study.chunk:,}")
    print(
        f"about {1e3 * each:.{0 if each > 0.01 else 1}f} ms a point on this core (from {count} all over the study), "
        f"{_span(each * study.count)} on one core"
    )
    return 0


def estimate(study: Study) -> tuple[float, int]:
    """Processor time of a point [s], and the number of points it was taken from.

    Chunks from the first to the last, for the corners of crossed axes are where trims are hardest: near the limit of
    thrust a point may cost eight times the usual.
    """
    last, run = (
        study.chunks - 1,
        _TIMED_SEARCHES if study.optimum is not None else 3 * _TIMED_SEARCHES,
    )
    places = sorted({round(last * k / (_TIMED_PLACES - 1)) for k in range(_TIMED_PLACES)})
    costs: list[float] = []
    count = 0
    for place in places:
        first, end = study.span(place)
        points = min(end - first, run)
        evaluate_points(study, first, first + 1)  # Compiles kernels and builds grids.
        start = _seconds(study, first, first + 1)
        whole = _seconds(study, first, first + points) if points > 1 else start
        # The first point of a chunk starts cold, the others from their neighbours.
        costs.append(start + (whole - start) / max(points - 1, 1) * (end - first - 1))
        count += points
    if len(places) == study.chunks:
        return sum(costs) / study.count, count
    return float(np.trapezoid(costs, places)) / last / study.chunk, count


def _seconds(study: Study, first: int, last: int) -> float:
    begin = time.process_time()
    evaluate_points(study, first, last)
    return time.process_time() - begin


def _rate(points_per_second: float) -> str:
    """Points per second, or per minute below five per second."""
    return (
        f"{points_per_second:,.0f}/s"
        if points_per_second >= 5.0
        else f"{60.0 * points_per_second:,.0f}/min"
    )


def _span(seconds: float) -> str:
    for size, name in ((86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:,.1f} {name}"
    return f"{seconds:.0f} s" if seconds >= 1.0 else "less than a second"
