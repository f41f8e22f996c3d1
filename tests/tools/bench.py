"""Processor times of evaluations, trims, searches and studies, beside their targets.

`python -m tests.tools.bench [--json] [--against DIR | --release | --page | --brief]`
"""

import argparse
import itertools
import json
import statistics
import subprocess
import sys
import tarfile
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import starmap
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import numpy as np

from rotor import Design, Solution, make_design, solve
from rotor.aero.problem import build_problem
from rotor.engine.linearise import evaluate
from rotor.optimisation import Search, find_concept, run_search
from rotor.study.chunks import evaluate_points
from rotor.study.point import trim_of
from rotor.study.study_file import read_study
from rotor.trim import analyse, power_gradient
from rotor.trim.forward import first_guess
from rotor.trim.newton import FEW_DIGITS, newton
from rotor.trim.power_changes import power_changes
from tests.tools import measured

T = TypeVar("T")
TARGETS_S = {"optimum, two segments": 0.6}
"""Targets of the project [s], flight preset, one core."""

TARGETS_MS = {
    "evaluation": 0.25, "rigid blade, warm": 4.0, "bending blade, cold": 60.0, "bending blade, warm": 6.0,
    "cold": 40.0, "warm": 4.0, "gradient": 2.0, "doubt": 8.0,
}  # fmt: skip
"""Targets of the project [ms], on the grid of each model, one core of an idle machine."""

TARGETS_UNSTEADY = {"cold": 1.3, "warm": 1.3, "gradient": 1.4}
"""Targets of the project: time with unsteady flow and dynamic stall over that with steady sections."""

LOST = 1.1
"""Time over that of the last release from which a figure is named."""
_ROOT = Path(__file__).parents[2]
_ADVANCE_RATIOS = (0.1, 0.15, 0.2, 0.25, 0.3, 0.35)
_SEARCH_ADVANCE_RATIOS = (0.1, 0.2, 0.3)
TARGET_PER_SECOND = 28.0
"""10⁵ trims of elastic blades with the lifting line on two cores in 30 minutes."""
_POINTS = 200


def measure_searches() -> dict[str, float]:
    """Seconds by name; mean over three advance ratios, bands included."""
    figures: dict[str, float] = {}
    for name, concept, starts in (
        ("optimum, two segments", "two-segment", 6),
        ("optimum, three segments, 16 starts", "three-segment", 16),
    ):
        elapsed = 0.0
        for mu in _SEARCH_ADVANCE_RATIOS:
            design = make_design(preset="flight", mu=mu)
            solve(design)  # Builds the grid and the wake once, as an open page has done.
            elapsed += run_search(Search(design, find_concept(concept), starts=starts)).elapsed
        figures[name] = elapsed / len(_SEARCH_ADVANCE_RATIOS)
    return figures


def measure_batch() -> dict[str, float]:
    """Trims a second of processor time, one core; the middle of the shipped study of 10⁵ sampled trims."""
    study = read_study("hundred_thousand.toml").study
    first = study.chunks // 2 * study.chunk
    designs = [trim_of(values, study) for values in study.values(first, first + _POINTS)]
    return {
        "each by itself": _points_per_second(lambda: [solve(design) for design in designs]),
        "as a study works them off": _points_per_second(
            lambda: evaluate_points(study, first, first + _POINTS)
        ),
    }


def _points_per_second(call: Callable[[], Any]) -> float:
    begin = time.process_time()
    call()
    return _POINTS / (time.process_time() - begin)


def main(argv: list[str] | None = None) -> int:
    """Exit code 0: targets are printed, not enforced."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="machine-readable output")
    other = parser.add_mutually_exclusive_group()
    other.add_argument(
        "--against",
        type=Path,
        metavar="DIR",
        help="time another checkout too, and print the ratios",
    )
    other.add_argument("--release", action="store_true", help="time the last release too")
    other.add_argument(
        "--page", action="store_true", help="write docs/measured.md, on an idle machine"
    )
    other.add_argument(
        "--brief",
        action="store_true",
        help="only the models of the page, in seconds: how fast it is here",
    )
    args = parser.parse_args(argv)
    if args.page:
        measured.write(_least)
        return 0
    if args.brief:
        for name, value in measure({"": _CASES[""]}, 5).items():
            print(_line(name, value, "10.3f", TARGETS_MS.get(name), "≤"))
        return 0
    with TemporaryDirectory(prefix="release-") as room:
        answer = _timed(unpacked_release(Path(room)) if args.release else args.against)
    print(json.dumps(answer, indent=2, allow_nan=False) if args.json else report(answer))
    return 0


def _least() -> dict[str, Any]:
    """The best figures of some runs."""
    runs = [(measure(), measure_searches(), measure_batch()) for _ in range(measured.RUNS)]
    times, searches, rates = zip(*runs, strict=True)
    return {
        "ms": {name: min(one[name] for one in times) for name in times[0]},
        "seconds": {name: min(one[name] for one in searches) for name in searches[0]},
        "trims_per_second_and_core": {name: max(one[name] for one in rates) for name in rates[0]},
    }


def _timed(checkout: Path | None) -> dict[str, Any]:
    """All figures, beside those of another checkout if there is one."""
    theirs = None if checkout is None else started(checkout)
    answer: dict[str, Any] = {
        "ms": measure(),
        "targets_ms": TARGETS_MS,
        "unsteady_over_steady": measure_unsteady(),
        "targets_unsteady": TARGETS_UNSTEADY,
        "seconds": measure_searches(),
        "targets_s": TARGETS_S,
        "trims_per_second_and_core": measure_batch(),
        "target_per_second": TARGET_PER_SECOND,
    }
    if theirs is not None:
        out, err = theirs.communicate()
        if theirs.returncode == 0:
            answer["time_over_theirs"] = time_ratios(answer, json.loads(out))
        else:
            print(f"{str(checkout)!r} could not be timed: {err.strip()[-200:]}", file=sys.stderr)
    return answer


def report(answer: dict[str, Any]) -> str:
    batch, targets = answer["trims_per_second_and_core"], answer["targets_ms"] | answer["targets_s"]
    unsteady: dict[str, float] = answer["unsteady_over_steady"]
    minutes = 1e5 / (2.0 * 60.0 * batch["as a study works them off"])
    lines = [
        "milliseconds of processor time (median), flight preset, mean of µ 0.10…0.35; lifting line and elastic blade",
        "where nothing else is said, linear inflow on 40 × 48\n",
        *(
            _line(name, value, "10.3f", targets.get(name), "≤")
            for name, value in answer["ms"].items()
        ),
        "\nunsteady flow and dynamic stall over steady sections, medians of pairs\n",
        *(
            _line(name, value, "10.2f", TARGETS_UNSTEADY[name], "≤")
            for name, value in unsteady.items()
        ),
        "\nseconds, lifting line, elastic blade\n",
        *(
            _line(name, value, "10.2f", targets.get(name), "≤")
            for name, value in answer["seconds"].items()
        ),
        "\ntrims a second and core, elastic blades sampled over speed, weight, altitude and twist\n",
        *(
            _line(name, value, "10.0f", answer["target_per_second"], "≥")
            for name, value in batch.items()
        ),
        _line("10⁵ of them on two cores [minutes]", minutes, "10.1f", 30.0, "≤"),
    ]
    if ratios := answer.get("time_over_theirs"):
        lines += ["\ntime here over time in the other checkout\n"]
        lines += [f"{name:<44}{ratio:10.2f}" for name, ratio in ratios.items()]
        lost = [f"{name} {ratio:.2f}" for name, ratio in ratios.items() if ratio > LOST]
        lines += [f"\nlost more than {100 * (LOST - 1):.0f} %: {'; '.join(lost) or 'nothing'}"]
    return "\n".join(lines)


def started(checkout: Path) -> subprocess.Popen[str]:
    """The own bench of another checkout, by this Python, at the same time: what slows one slows both.

    The kernels of both are compiled before, side by side.
    """
    own = (checkout / "tests/tools/bench.py").exists()
    # A command of rotor until version 0.3.
    words = ["tests.tools.bench"] if own else ["rotor", "bench"]
    warm, quiet = [sys.executable, "-m", "rotor", "warm"], subprocess.DEVNULL
    begun = [
        subprocess.Popen(warm, cwd=place, stdout=quiet, stderr=quiet) for place in (_ROOT, checkout)
    ]
    for compiling in begun:
        compiling.wait()
    call = [sys.executable, "-m", *words, "--json"]
    return subprocess.Popen(
        call, cwd=checkout, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def unpacked_release(folder: Path) -> Path | None:
    """A folder with the files of the last release before this commit, by tag or change of version; None without one."""
    release = _git("describe", "--tags", "--abbrev=0", "HEAD^")
    if not release and _git("rev-parse", "--is-shallow-repository") == "false":
        release = _git("log", "-1", "--format=%h", "-G^version = ", "HEAD^", "--", "pyproject.toml")
    packed = folder / "release.tar"
    if not release or _git("archive", f"--output={packed}", release, done="yes") != "yes":
        print("No earlier release in this clone: its times are not compared.", file=sys.stderr)
        return None
    with tarfile.open(packed) as files:
        files.extractall(folder, filter="data")
    print(f"Beside the release {release}.", file=sys.stderr)
    return folder


def _git(*words: str, done: str = "") -> str:
    """What git answers, or `done` where that is nothing; empty where it fails or is missing."""
    with suppress(OSError):
        answer = subprocess.run(
            ["git", *words], cwd=_ROOT, capture_output=True, text=True, check=False
        )
        if answer.returncode == 0:
            return answer.stdout.strip() or done
    return ""


def time_ratios(ours: dict[str, Any], theirs: dict[str, Any]) -> dict[str, float]:
    """Time of each figure here over that of the other; below one: faster here."""
    ratios = {
        name: value / theirs[kind][name]
        for kind in ("ms", "seconds")
        for name, value in ours[kind].items()
        if name in theirs[kind]
    }
    batch = "trims_per_second_and_core"
    return ratios | {
        name: theirs[batch][name] / rate
        for name, rate in ours[batch].items()
        if name in theirs[batch]
    }


def _line(name: str, value: float, form: str, target: float | None, sign: str) -> str:
    """A figure beside its target, if it has one, and what part of it that is."""
    beside = "" if target is None else f"   target {sign} {target:g}   ({value / target:.1f} of it)"
    return f"{name:<44}{value:{form}}{beside}"


_CASES: dict[str, dict[str, Any]] = {
    "": {"inflow": "lifting-line", "elastic_twist": True, "bending": False},
    "linear inflow, ": {"inflow": "pitt-peters", "elastic_twist": False, "bending": False},
    "rigid blade, ": {"inflow": "lifting-line", "elastic_twist": False, "bending": False},
    "bending blade, ": {"inflow": "lifting-line", "elastic_twist": True, "bending": True},
}
"""Models, by what a figure is called after."""


def measure(cases: dict[str, dict[str, Any]] = _CASES, runs: int = 15) -> dict[str, float]:
    """Figures [ms] by name."""
    figures: dict[str, float] = {}
    for beside, models in cases.items():
        designs = _designs(0.0, "linear:-16", models)
        nearby = _designs(0.002, "linear:-15.5", models)  # One slider step away.
        solutions = [solve(design) for design in designs]
        problems = [build_problem(design) for design in designs]
        points = [newton(problem, first_guess(problem)).linear.point for problem in problems]
        figures[f"{beside}evaluation"] = _mean(
            lambda point: evaluate(
                point.system, point.system.grid, point.x, slopes=True, flow=True
            ),
            points,
            50,
        )
        figures[f"{beside}cold"] = _mean(lambda design: solve(_new(design)), designs, runs)
        for solution in solutions:
            power_gradient(solution)  # As of a design that the page shows.
        pairs = list(zip(nearby, solutions, strict=True))
        figures[f"{beside}warm"] = _mean(lambda pair: solve(*pair), pairs, runs)
        figures[f"{beside}warm, new speed"] = _mean(
            lambda pair: solve(_new(pair[0]), pair[1]), pairs, runs
        )
        figures[f"{beside}moving"] = statistics.fmean(map(_moving, solutions))
        figures[f"{beside}gradient"] = statistics.fmean(starmap(partial(_gradient, runs), pairs))
        figures[f"{beside}doubt"] = _mean(
            power_changes, [analyse(design).adjoint for design in designs], runs
        )
    figures["hover, cold"] = _time(lambda: solve(make_design(preset="flight", mu=0.0)), runs)
    return figures


def measure_unsteady(pairs: int = 30) -> dict[str, float]:
    """Time with unsteady flow and dynamic stall over that with steady sections, by name; mean over speed.

    Taken in turn, so that whatever else the machine does slows both.
    """
    ratios: dict[str, list[float]] = {name: [] for name in TARGETS_UNSTEADY}
    for mu in _ADVANCE_RATIOS:
        cases: list[tuple[Design, Design, Solution]] = []
        for off in (None, "unsteady,dynamic-stall"):
            begun, nearby = (
                make_design(twist=twist, mu=mu, off=off) for twist in ("linear:-16", "linear:-15.5")
            )
            start = solve(begun)
            power_gradient(start)
            cases.append((begun, nearby, start))
        times = np.array([[_three(*case) for case in cases] for _ in range(pairs + 1)])[1:]
        for name, ratio in zip(
            ratios, np.median(times[:, 0] / times[:, 1], axis=0).tolist(), strict=True
        ):
            ratios[name].append(ratio)
    return {name: statistics.fmean(each) for name, each in ratios.items()}


def _three(design: Design, nearby: Design, start: Solution) -> tuple[float, float, float]:
    """Processor times of a cold trim, a warm one and its gradient [s]."""
    begin = time.process_time()
    solve(_new(design))
    cold = time.process_time()
    trim = analyse(nearby, start)
    warm = time.process_time()
    power_gradient(trim)
    return cold - begin, warm - cold, time.process_time() - warm


_COUNT = itertools.count(1)


def _new(design: Design) -> Design:
    """The design at a speed that no cache knows."""
    return design.at(mu=design.condition.advance_ratio + 1e-7 * next(_COUNT))


def _designs(faster: float, twist: str, models: dict[str, Any]) -> list[Design]:
    """Over speed, at advance ratios higher by `faster`."""
    designs = [make_design(preset="flight", twist=twist, mu=mu + faster) for mu in _ADVANCE_RATIOS]
    return [replace(design, models=replace(design.models, **models)) for design in designs]


def _gradient(runs: int, nearby: Design, start: Solution) -> float:
    """The gradient of a new trim [ms], its derivatives included, which the next trim then uses."""
    times: list[float] = []
    for _ in range(runs + 1):
        trim = analyse(nearby, start)
        begin = time.process_time()
        power_gradient(trim)
        times.append(time.process_time() - begin)
    return 1e3 * statistics.median(times[1:])


def _moving(start: Solution) -> float:
    """A frame of a drag [ms]: each trim a quarter of a degree from the last one, which turns round half way."""
    design, latest, times = start.design, start, list[float]()
    for k in (*range(1, 17), *range(15, 0, -1)):
        begin = time.process_time()
        latest = analyse(
            design.with_twist(f"linear:{-16.0 + 0.25 * k}"), latest, FEW_DIGITS
        ).solution
        times.append(time.process_time() - begin)
    return 1e3 * statistics.median(times)


def _mean(call: Callable[[T], Any], cases: list[T], runs: int) -> float:
    return statistics.fmean(_time(partial(call, case), runs) for case in cases)


def _time(call: Callable[[], Any], runs: int) -> float:
    """Median milliseconds of processor time of a call, one warm-up first."""
    call()
    times: list[float] = []
    for _ in range(runs):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return 1e3 * statistics.median(times)


if __name__ == "__main__":
    raise SystemExit(main())
