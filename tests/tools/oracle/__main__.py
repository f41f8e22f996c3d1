"""What this tree answers, as text, and whether another tree answers the same.

    python -m tests.tools.oracle OUT                      write OUT/KIND.txt, sorted lines `name: value`
    python -m tests.tools.oracle OUT --against DIR        and print which values differ in DIR: a checkout, or the OUT
                                                          of an earlier run
    python -m tests.tools.oracle OUT --only text,physics  some kinds only
    python -m tests.tools.oracle --plant FILE --count 6   plant faults in a copy: which are noticed?

Exit code 0: all values are equal, every fault is noticed; 1: some are not; 2: a kind could not be run.
"""

import argparse
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .compare import difference, read
from .plant import KindFailedError, limit_processor_time, plant
from .run import KINDS, run_kind

ROOT = Path(__file__).parents[3]


def main() -> int:
    """Run the kinds that are asked for and compare them, or plant faults."""
    args = _arguments()
    if args.plant:
        return _plant(args)
    out: Path = args.out.resolve()
    there: Path | None = args.against
    runs = [(ROOT, kind, out) for kind in args.only]
    if there is not None and (there / "rotor").is_dir():
        runs += [(there.resolve(), kind, out / "against") for kind in args.only]
        there = out / "against"
    if not _run(runs, args.processes):
        return 2
    return 0 if there is None else _compare(there, out, args.only)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m tests.tools.oracle",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("out", type=Path, nargs="?", help="folder of the values")
    parser.add_argument("--against", type=Path, metavar="DIR", help="a checkout, or an earlier OUT")
    parser.add_argument(
        "--only",
        type=lambda text: text.split(","),
        default=list(KINDS),
        metavar="KIND,…",
        help=f"kinds to run: {', '.join(KINDS)}",
    )
    parser.add_argument("--processes", type=int, default=1, metavar="N", help="kinds run at once")
    parser.add_argument("--plant", nargs="+", metavar="FILE", help="files or folders for faults")
    parser.add_argument("--count", type=int, default=6, metavar="N", help="faults to plant")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the draw of faults")
    args = parser.parse_args()
    unknown = [kind for kind in args.only if kind not in KINDS]
    if unknown:
        parser.error(f"{', '.join(unknown)}: the kinds are {', '.join(KINDS)}")
    if args.out is None and not args.plant:
        parser.error("give a folder for the values")
    return args


def _run(runs: Sequence[tuple[Path, str, Path]], processes: int) -> bool:
    """Whether every kind of every checkout could be run."""

    def run(checkout: Path, kind: str, out: Path) -> bool:
        out.mkdir(parents=True, exist_ok=True)
        done, words = run_kind(checkout, kind, out)
        print(words, flush=True)
        return done

    with ThreadPoolExecutor(processes) as pool:
        begun = [pool.submit(run, *each) for each in runs]
    return all(each.result() for each in begun)


def _compare(there: Path, here: Path, kinds: Sequence[str]) -> int:
    """Print what differs between two runs."""
    differences = [difference(kind, read(there, kind), read(here, kind)) for kind in kinds]
    for one in differences:
        print(one.words() if one else f"{one.kind}: equal")
    return 1 if any(differences) else 0


def _plant(args: argparse.Namespace) -> int:
    """Print which of some faults are noticed."""

    def run(checkout: Path, kind: str, out: Path) -> bool:
        done, _ = run_kind(checkout, kind, out, limit_processor_time)
        return done

    try:
        missed = plant(ROOT, args.plant, args.count, args.seed, args.only, run)
    except KindFailedError as error:
        print(error)
        return 2
    print(f"{len(missed)} of {args.count} faults are not noticed (seed {args.seed})")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
