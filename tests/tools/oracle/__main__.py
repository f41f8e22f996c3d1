"""What this tree answers, as text, and whether another tree answers the same.

    python -m tests.tools.oracle OUT                     writes OUT/KIND.txt, sorted lines `name: value`
    python -m tests.tools.oracle OUT --against DIR       and says which values differ in DIR: a checkout, or an
                                                         OUT of an earlier run
    python -m tests.tools.oracle OUT --only text,physics some kinds: physics, text, command, picture, panel, session

Exit code 0: all values are equal; 1: some differ; 2: a kind could not be run.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from .compare import difference, read
from .record import Record

ROOT = Path(__file__).parents[3]
KINDS = {
    "physics": "physics",
    "text": "texts",
    "command": "commands",
    "picture": "pictures",
    "export": "exports",
    "panel": "panels",
    "search": "searches",
    "session": "session",
}
"""Kinds of values, and the module that writes each."""
_START = """
import sys
sys.path[:0] = [{checkout!r}]
sys.path.append({scripts!r})
from oracle.__main__ import write
write({kind!r}, {out!r})
"""
"""The program of a kind: the packages are those of the checkout, the scripts are ours."""


@dataclass(frozen=True)
class Run:
    """One kind of values, asked of one checkout."""

    checkout: Path
    kind: str
    out: Path

    def go(self) -> bool:
        """Whether it could be run; its values are then in a file of `out`."""
        scripts = Path(__file__).parents[1]
        program = _START.format(
            checkout=str(self.checkout), scripts=str(scripts), kind=self.kind, out=str(self.out)
        )
        settings = {
            "COLUMNS": "100",
            "OPENBLAS_NUM_THREADS": "1",
            "OMP_NUM_THREADS": "1",
            "PYTHONPATH": "",
        }
        done = subprocess.run(
            [sys.executable, "-c", program],
            cwd=self.checkout,
            env={**os.environ, **settings},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
        )
        if done.returncode != 0:
            print(f"{self.kind} of {self.checkout} failed:\n{done.stderr}", file=sys.stderr)
            return False
        print(f"{self.kind} of {self.checkout}: {done.stdout.splitlines()[-1]}", flush=True)
        return True


def write(kind: str, out: str) -> None:
    """Ask the packages that are first on the path for one kind of values, and write them to a file.

    Runs in a process of its own, in a folder of its own: what one kind leaves behind is in no other's way.
    """
    import rotor

    checkout = Path(sys.path[0])
    found = Path(rotor.__file__).parents[1]
    if found != checkout:
        raise RuntimeError(f"rotor is that of {found}, not of {checkout}")
    with tempfile.TemporaryDirectory() as folder:
        record = Record((str(checkout), folder, str(Path(folder).resolve())))
        os.chdir(folder)
        import_module(f".{KINDS[kind]}", __package__).write(record)
        os.chdir(checkout)
    Path(out, f"{kind}.txt").write_text("\n".join(record.lines()) + "\n", "utf-8")
    print(f"{len(record.values)} values, {time.process_time():.0f} s of processor")


def main() -> int:
    """Run the kinds that are asked for, and compare."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, help="folder of the values")
    parser.add_argument("--against", type=Path, metavar="DIR", help="a checkout, or an earlier OUT")
    parser.add_argument("--only", default=",".join(KINDS), metavar="KIND,…")
    parser.add_argument("--processes", type=int, default=1, help="kinds that run at once")
    args = parser.parse_args()
    kinds = [kind for kind in args.only.split(",") if kind]
    unknown = [kind for kind in kinds if kind not in KINDS]
    if unknown:
        parser.error(f"{', '.join(unknown)}: the kinds are {', '.join(KINDS)}")
    args.out.mkdir(parents=True, exist_ok=True)
    runs = [Run(ROOT, kind, args.out.resolve()) for kind in kinds]
    there = args.against
    if there is not None and (there / "rotor").is_dir():
        there = args.out / "against"
        there.mkdir(exist_ok=True)
        runs += [Run(args.against.resolve(), kind, there.resolve()) for kind in kinds]
    with ThreadPoolExecutor(args.processes) as pool:
        done = list(pool.map(Run.go, runs))
    if not all(done):
        return 2
    if there is None:
        return 0
    differences = [difference(kind, read(there, kind), read(args.out, kind)) for kind in kinds]
    for one in differences:
        print(one.words() if one else f"{one.kind}: equal")
    return 1 if any(differences) else 0


if __name__ == "__main__":
    sys.exit(main())
