"""Waiting for what another thread or process brings about."""

import subprocess
import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")


def until(true: Callable[[], T], run: "subprocess.Popen[bytes] | None" = None) -> T:
    """The first true answer; fails after far longer than a busy machine takes, or where the run has ended."""
    end = time.monotonic() + 240.0
    while not (answer := true()):
        assert time.monotonic() < end, "waited too long"
        assert run is None or run.poll() is None, f"the run ended with {run.returncode}"
        time.sleep(0.005)
    return answer
