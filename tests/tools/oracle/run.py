"""One kind of values asked of one checkout, in a process and a folder of its own."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from .record import Record

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
from oracle.run import write_kind
write_kind({kind!r}, {out!r})
"""
"""The program of a kind: the packages are those of the checkout, the scripts are ours."""
_SETTINGS = {
    "COLUMNS": "100",
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "PYTHONPATH": "",
}


def run_kind(
    checkout: Path, kind: str, out: Path, begin: Callable[[], None] | None = None
) -> tuple[bool, str]:
    """Whether a kind of values could be asked of a checkout, and one line on how it went.

    Its values are then in `out`/KIND.txt. `begin`: what the new process does first.
    """
    scripts = Path(__file__).parents[1]
    program = _START.format(checkout=str(checkout), scripts=str(scripts), kind=kind, out=str(out))
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=checkout,
        env={**os.environ, **_SETTINGS},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        preexec_fn=begin,
    )
    name = f"{kind} of {checkout}"
    if done.returncode != 0:
        return False, f"{name} ended with {done.returncode}\n{done.stderr}"
    return True, f"{name}: {done.stdout.splitlines()[-1]}"


def write_kind(kind: str, out: str) -> None:
    """Ask the checkout that is first on the path for one kind of values, and write them to `out`/KIND.txt.

    Its scenarios run in a temporary folder, and see no files of earlier ones.
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
    print(f"{len(record.values)} values, {processor_time():.0f} s of processor")


def processor_time() -> float:
    """Of this process and of those that it waited for [s]."""
    return sum(os.times()[:4])
