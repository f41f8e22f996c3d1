"""Random command lines of every command that computes: few and short ones here, more every night.

Each must end with exit code 0, 1 or 2 within its time, without a traceback or a warning, and with one line where it is
refused.
"""

import argparse
import shlex
import time
import warnings
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

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


def random_line(random: np.random.Generator, commands: tuple[str, ...]) -> list[str]:
    """Arguments of one command."""
    subparsers = next(
        a for a in build_parser()._actions if isinstance(a, argparse._SubParsersAction)
    )
    name = str(random.choice(commands))
    actions = [
        a for a in subparsers.choices[name]._actions if a.option_strings and a.dest != "help"
    ]
    line = [name, "--inflow", "drees"] if name != "airfoil" else [name]
    for k in random.permutation(len(actions))[: int(random.integers(0, 6))]:
        action = actions[k]
        line.append(str(random.choice(action.option_strings)))
        if action.nargs != 0 and not (action.nargs == "?" and random.random() < 0.5):
            likely = (
                PLAUSIBLE.get(action.dest) or tuple(map(str, action.choices or ())) or ("0.3", "2")
            )
            line.append(str(random.choice(likely if random.random() < 0.75 else ODD)))
    return line


def fault(code: object, out: str, err: str, seconds: float) -> str:
    """What is wrong with how a command line ended."""
    if code not in (0, 1, 2):
        return f"exit code {code}"
    if "Traceback" in err or "Warning" in err:
        return err[-300:]
    if code == 2 and (out or len(err.strip().splitlines()) != 1):
        return f"not one line: {err[-300:]!r} after {out[-100:]!r}"
    return f"{seconds:.0f} s" if seconds > LIMIT else ""


@pytest.mark.parametrize(
    ("count", "commands"),
    [(20, SHORT), pytest.param(1000, COMMANDS, marks=[pytest.mark.slow, pytest.mark.nightly])],
)
def test_no_command_line_ends_badly(
    count: int, commands: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
):  # fmt: skip
    monkeypatch.chdir(tmp_path)
    warnings.simplefilter("error")
    random, codes, wrong = np.random.default_rng(1), Counter[object](), list[str]()
    for _ in range(count):
        line, begin = random_line(random, commands), time.perf_counter()
        try:
            code = main(line)
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 2
        except BaseException as error:
            error.add_note(shlex.join(line))
            raise
        codes[code] += 1
        out, err = capsys.readouterr()
        if what := fault(code, out, err, time.perf_counter() - begin):
            wrong.append(f"{shlex.join(line)}: {what}")
    assert wrong == []
    assert codes[0]
    assert codes[2]
