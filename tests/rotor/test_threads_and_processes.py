"""Solving leaves the caller's BLAS threads as they were; processes do not run the caller's script again."""

import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from rotor import make_design, solve
from rotor.design.twist import LinearTwist
from rotor.support.blas_threads import _libraries, one_blas_thread


def threads() -> list[int]:
    return [library.get_num_threads() for libraries in _libraries() for library in libraries]


@pytest.fixture
def two_threads():
    with threadpool_limits(limits=2, user_api="blas"):
        if 2 not in threads():
            pytest.skip("this BLAS has one thread only")
        yield


@pytest.mark.usefixtures("two_threads")
def test_overlapping_threads_restore_the_first_setting():
    """A enters, B enters, A leaves, B leaves: the limit holds until B has left, and then the old setting is back."""
    before = threads()
    seen: list[list[int]] = []
    inside, leave = threading.Event(), threading.Event()

    def other() -> None:
        with one_blas_thread():
            inside.set()
            leave.wait(60.0)
            seen.append(threads())

    thread = threading.Thread(target=other)
    with one_blas_thread():
        thread.start()
        assert inside.wait(60.0)
    leave.set()
    thread.join()
    assert set(seen[0]) == {1}
    assert threads() == before


def test_a_trim_runs_on_one_thread():
    """A twist law that looks at the limit while it is evaluated."""
    seen: list[int] = []

    class Witness(LinearTwist):
        def __call__(self, r: object) -> np.ndarray:
            seen.extend(threads())
            return super().__call__(np.asarray(r))

    assert solve(replace(make_design(), twist=Witness(-0.2))).converged
    assert set(seen) == {1}


_SCRIPT = """
from rotor.support.worker_process import start_process
print("script", flush=True)
process = start_process(print, ("work",), "worker")
process.join()
print(process.exitcode, __spec__)
"""


def test_a_script_without_a_guard_runs_once(tmp_path: Path):
    script = tmp_path / "script.py"
    script.write_text(_SCRIPT, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=120
    )
    assert done.stdout.split() == ["script", "work", "0", "None"]
    assert done.stderr == ""
