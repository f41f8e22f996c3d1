"""Which small faults in a file change a value of the oracle?

    python -m tests.tools.oracle.plant FILE [--count N] [--seed N] [--only KIND,…]

Before a file is rewritten, this shows whether the oracle would see a mistake in it. Faults are those of
`tests.tools.faults`, each planted alone in a copy of this checkout. Exit code 1 where one of them changes nothing.
"""

import argparse
import shutil
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tests.tools import faults

from .__main__ import KINDS, ROOT, Run
from .compare import difference, read

COPIED = ("rotor", "explorer", "tests", "assets", "pyproject.toml")
"""What a checkout needs to answer."""


def copy_checkout(place: Path) -> None:
    """Copy this checkout, with its compiled kernels, whose sources keep their times."""
    place.mkdir()
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, place / name)
        else:
            shutil.copy2(source, place / name)


def answers(checkout: Path, kinds: Sequence[str], out: Path) -> dict[str, dict[str, str]]:
    """Values by name of each kind that could be run."""
    out.mkdir()
    ran = [kind for kind in kinds if Run(checkout, kind, out).go()]
    return {kind: read(out, kind) for kind in ran}


def first_change(
    right: dict[str, dict[str, str]], wrong: dict[str, dict[str, str]], kinds: Sequence[str]
) -> str:
    """The first kind that a fault changes, with the name of a value; empty where all are equal."""
    for kind in kinds:
        if kind not in wrong:
            return f"{kind} could not be run"
        found = difference(kind, right[kind], wrong[kind])
        names = [*found.changed, *found.gone, *found.new]
        if names:
            return f"{kind}, {names[0]}"
    return ""


def main() -> int:
    """Plant each fault, and print what it changes."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("file", help="file of rotor or explorer, from the root of the checkout")
    parser.add_argument("--count", type=int, default=6, help="faults (default 6)")
    parser.add_argument("--seed", type=int, default=1, help="draws them (default 1)")
    parser.add_argument("--only", default=",".join(KINDS), metavar="KIND,…")
    args = parser.parse_args()
    if not (ROOT / args.file).is_file():
        parser.error(f"{args.file} is no file of {ROOT}: give one of rotor or explorer")
    kinds = [kind for kind in args.only.split(",") if kind in KINDS]
    unseen = 0
    with tempfile.TemporaryDirectory() as folder:
        checkout = Path(folder, "checkout")
        copy_checkout(checkout)
        right = answers(checkout, kinds, Path(folder, "right"))
        if len(right) < len(kinds):
            return 2
        place = checkout / args.file
        before = place.read_text("utf-8")
        planted = faults.sample([args.file], args.count, args.seed)
        for number, (_, where, name, text) in enumerate(planted):
            place.write_text(text, "utf-8")
            wrong = answers(checkout, kinds, Path(folder, f"wrong{number}"))
            place.write_text(before, "utf-8")
            changed = first_change(right, wrong, kinds)
            print(f"{args.file}:{where} in {name}: {changed or 'NOT NOTICED'}", flush=True)
            if not changed:
                unseen += 1
        print(f"{len(planted) - unseen} of {len(planted)} faults change a value")
    return 1 if unseen else 0


if __name__ == "__main__":
    sys.exit(main())
