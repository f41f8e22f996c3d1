"""What `python -m rotor` prints, says on stderr, writes to files and ends with."""

import contextlib
import io
from pathlib import Path

from .record import Record

QUICK = ("--inflow", "uniform", "--elements", "12", "--azimuths", "24")
"""A coarse model, for commands that solve many designs."""
COMMANDS: tuple[tuple[str, ...], ...] = (
    (),
    ("--help",),
    ("completion",),
    *((name, "--help") for name in ("solve", "sweep", "front", "waterfall", "optimise", "schedule", "study", "actuator",
                                    "reproduce", "validate", "airfoil", "warm")),
    ("solve",),
    ("solve", "--mu", "0.3", "--twist", "linear:-8", "--doubt"),
    ("solve", "--mu", "0.3", "--bending", "--json"),
    ("solve", "--distribution"),
    ("solve", "--mu", "0.5", "--mass-kg", "11000"),
    ("sweep", "--mu", "0.1:0.3:0.1", "--twist", "linear:-8", "linear:-16", "--csv", "sweep.csv"),
    ("airfoil", "show", "sc1095"),
    ("airfoil", "show", "sc1095", "--mach", "0.7", "--alpha", "4", "--json"),
    ("solve", "--twist", "linaer:-8"),
    ("solve", "--mu", "9"),
    ("solve", "--no-such-flag"),
    ("solv",),
)  # fmt: skip


def write(record: Record) -> None:
    """Each command in turn, in an empty folder of its own."""
    for words in COMMANDS:
        run(record, " ".join(("rotor", *words)), words)


def run(record: Record, name: str, words: tuple[str, ...]) -> None:
    """Keep what a command prints, its exit code and the files that it leaves."""
    out = io.StringIO()
    error = io.StringIO()
    before = set(Path().rglob("*"))
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        record.ask(f"{name}/exit code", "rotor.__main__.main", list(words))
    record.keep(f"{name}/stdout", out.getvalue())
    record.keep(f"{name}/stderr", error.getvalue())
    for path in sorted(set(Path().rglob("*")) - before):
        if path.is_file():
            record.keep(f"{name}/{path}", path.read_bytes())
