"""Every term of every equation left out in turn: some test must fail. `python -m tests.tools.mutation [--only TEXT]`.

Terms and columns are those that `rotor.engine.terms.Structure` is given, named by the line that gives them, counted
from the head of its function, and, for a term, by the equation. As a plugin of pytest (`-p tests.tools.mutation`) it
leaves out the one that `ROTOR_LEFT_OUT` names, or writes the names of all into the file that `ROTOR_TERMS` names.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from rotor.engine.terms import Structure

ROOT = Path(__file__).parent.parent.parent
TRIM, AERO = "tests/rotor/trim/test_", "tests/rotor/aero/test_"
OWN = {
    "bending": (f"{TRIM}bending.py",),
    "hover": (f"{TRIM}hover.py", f"{TRIM}climb.py"),
    "inflow": (f"{AERO}inflow.py", f"{AERO}new_inflow.py", f"{AERO}inflow_load_dependent.py"),
    "": (f"{TRIM}elastic_twist.py", f"{TRIM}power.py", f"{TRIM}stand.py"),
}
"""Tests that are asked first, by a word in the name of the term."""
TESTS = (
    *(file for files in OWN.values() for file in files), f"{TRIM}invariants.py", f"{TRIM}lifting_line.py",
    f"{AERO}radial_flow_swirl_sweep.py", f"{AERO}switches.py", f"{AERO}unsteady_section.py",
    "tests/rotor/engine/test_linearised.py", "tests/rotor/files/test_flown_rotors.py",
)  # fmt: skip
"""Those that compare trims with theory, identities and other methods."""
SURVIVORS = {
    "inflow/local_momentum.py:SectorTerms.build+3": "only where the search for the inflow of a point begins"
}
"""Terms whose loss no test may notice, and why."""


def _named(call: Any, equation: str) -> str:
    """The term that the caller's caller gives."""
    code, line = call.f_back.f_code, call.f_back.f_lineno
    file, line = Path(code.co_filename), line - code.co_firstlineno
    return f"{file.parent.name}/{file.name}:{code.co_qualname}+{line}{equation}"


def _patch(left_out: str, found: set[str]) -> None:
    term, column = Structure.term, Structure.column

    def own_term(self: Structure, equation: int, *rest: Any, **named: Any) -> None:
        kind = list(self.equations)[equation]
        name = _named(sys._getframe(), f" {kind[0] if isinstance(kind, tuple) else kind}")
        found.add(name)
        if name != left_out:
            term(self, equation, *rest, **named)

    def own_column(
        self: Structure,
        channel: int,
        shape: Any,
        wave: int,
        factor: float,
        *rest: Any,
        **named: Any,
    ) -> None:
        name = _named(sys._getframe(), "")
        found.add(name)
        column(self, channel, shape, wave, 0.0 if name == left_out else factor, *rest, **named)

    Structure.term, Structure.column = own_term, own_column


if left_out := os.environ.get("ROTOR_LEFT_OUT"):
    _patch(left_out, set())
_FOUND: set[str] = set()
if os.environ.get("ROTOR_TERMS"):
    _patch("", _FOUND)


def pytest_sessionfinish() -> None:
    if listed := os.environ.get("ROTOR_TERMS"):
        Path(listed).write_text("\n".join(sorted(_FOUND)), encoding="utf-8")


def run(tests: tuple[str, ...], **environment: str) -> subprocess.CompletedProcess[str]:
    """The tests in a process of their own, up to the first that fails."""
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-x",
        "-n",
        "0",
        "-p",
        "tests.tools.mutation",
        *tests,
    ]
    return subprocess.run(
        command, cwd=ROOT, env={**os.environ, **environment}, capture_output=True, text=True
    )


def main() -> int:
    """Print each term with the test that notices its loss; 1 where there is a survivor that is not listed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="terms whose name has this text")
    only = parser.parse_args().only
    listed = ROOT / "artefacts" / "terms.txt"
    listed.parent.mkdir(exist_ok=True)
    whole = run(TESTS, ROTOR_TERMS=str(listed))
    if whole.returncode:
        print(f"the tests fail with every term in place:\n{whole.stdout[-3000:]}")
        return 1
    alive = list[str]()
    for name in filter(lambda name: only in name, listed.read_text(encoding="utf-8").split("\n")):
        own = next(files for word, files in OWN.items() if word in name)
        done = run(own, ROTOR_LEFT_OUT=name)
        if done.returncode == 0:
            done = run(TESTS, ROTOR_LEFT_OUT=name)
        failed = [line for line in done.stdout.split("\n") if line.startswith(("FAILED", "ERROR"))]
        print(f"{name}: {failed[0].split(' - ')[0] if failed else 'SURVIVES'}", flush=True)
        alive += [] if done.returncode == 1 else [name]
    print(f"{len(alive)} survive: {', '.join(alive) or 'none'}")
    return int(not set(alive) <= set(SURVIVORS))


if __name__ == "__main__":
    sys.exit(main())
