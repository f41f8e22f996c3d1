"""Random command lines of every command that computes.

Each must end with exit code 0, 1 or 2 within its time, without a traceback or a warning, and with one line where it is
refused.
"""

import argparse
import contextlib
import io
import os
import shlex
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from rotor.__main__ import build_parser, main

SHORT = ("solve", "airfoil")
COMMANDS = (*SHORT, "sweep", "front", "waterfall", "optimise", "schedule", "actuator")
"""Without those that take minutes. Files of studies are tried in tests/rotor/study."""
PLAUSIBLE = {
    "mu": ("0", "0.1", "0.3", "0.1:0.3:0.1"), "twist": ("linear:-8", "segments:-5,-12@0.5", "builtin"),
    "rotor": ("uh60a", "gazelle", "bo105", "xv15"), "mass_kg": ("7000", "9500"), "altitude_m": ("0", "3000"),
    "rotor_speed_percent": ("95", "105"), "load_factor": ("1.2",), "climb_m_s": ("3", "-3"),
    "twist_per_rev": ("2:1:180",), "pitch_per_rev": ("3:0.5:0",), "actuator": ("MFC_P1",),
    "starts": ("1",), "points": ("2",), "save": ("a.json",), "csv": ("a.csv", "-"), "plot": ("a.svg",),
    "rate_deg": ("-20,0",), "concept": ("linear", "two-segment"), "division": ("0.5",),
}  # fmt: skip
"""Values that may be right, by flag."""
ODD = (
    "", " ", "0", "-0", "-1", "1e-300", "9e29", "1e400", "nan", "inf", "-inf", "0x10", "1_000", "1,5", "1:2",
    "0:1:1e-9", "1:0:0.1", "a=b", "=", "linear:", "linear:nan", "spline:1,2@3,4", "x" * 300, "ψ", "\n", "'",
    "../../a", "/dev/null", ".", "-", "--", "3:1", "9:9:9",
)  # fmt: skip
LIMIT = 180.0
"""[s] of one command."""


def lines(count: int, seed: int, commands: Sequence[str] = COMMANDS) -> Iterator[list[str]]:
    """Arguments of one command after another; the same for the same seed."""
    random = np.random.default_rng(seed)
    parser = build_parser()
    subparsers = next(a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    for _ in range(count):
        name = str(random.choice(commands))
        actions = [a for a in subparsers.choices[name]._actions if a.option_strings and a.dest != "help"]
        line = [name, "--inflow", "drees"] if name != "airfoil" else [name]
        for k in random.permutation(len(actions))[: int(random.integers(0, 6))]:
            action = actions[k]
            line.append(str(random.choice(action.option_strings)))
            if action.nargs != 0 and not (action.nargs == "?" and random.random() < 0.5):
                line.append(_value(action, random))
        yield line


def _value(action: argparse.Action, random: np.random.Generator) -> str:
    likely = PLAUSIBLE.get(action.dest) or tuple(map(str, action.choices or ())) or ("0.3", "2")
    return str(random.choice(likely if random.random() < 0.75 else ODD))


def tried(line: list[str]) -> tuple[int | None, str]:
    """Exit code, and what is wrong with how this command line ended."""
    out, err = io.StringIO(), io.StringIO()
    begin = time.perf_counter()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), warnings.catch_warnings():
            warnings.simplefilter("error")
            code = main(line)
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 2
    except BaseException as error:
        return None, f"{type(error).__name__}: {error}"
    said, spent = err.getvalue(), time.perf_counter() - begin
    if code not in (0, 1, 2):
        return code, f"exit code {code}"
    if "Traceback" in said or "Warning" in said:
        return code, said[-300:]
    if code == 2 and (out.getvalue() or len(said.strip().splitlines()) != 1):
        return code, f"not one line: {said[-300:]!r} after {out.getvalue()[-100:]!r}"
    return code, f"{spent:.0f} s" if spent > LIMIT else ""


def run(count: int, seed: int, commands: Sequence[str] = COMMANDS) -> tuple[Counter[int | None], list[str]]:
    """How often each exit code came, and the lines that went wrong. Files are written to a folder that is removed."""
    codes: Counter[int | None] = Counter()
    wrong: list[str] = []
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            for line in lines(count, seed, commands):
                code, what = tried(line)
                codes[code] += 1
                if what:
                    wrong.append(f"{shlex.join(line)}: {what}")
                    print(wrong[-1], flush=True)
        finally:
            os.chdir(before)
    return codes, wrong
