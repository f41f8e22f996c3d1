"""The command line in pipes of other encodings, on full disks, and after Ctrl-C: one line and an exit code."""

import contextlib
import io
import random
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from explorer.__main__ import main as explorer
from rotor import make_design, solve
from rotor.__main__ import main
from rotor.support.terminal import StopSignal, run_command


def piped(monkeypatch: pytest.MonkeyPatch, encoding: str) -> tuple[io.BytesIO, io.BytesIO]:
    """Output and errors as bytes, as a pipe of that encoding takes them."""
    pipes = io.BytesIO(), io.BytesIO()
    for name, pipe in zip(("stdout", "stderr"), pipes, strict=True):
        monkeypatch.setattr(
            sys, name, io.TextIOWrapper(pipe, encoding=encoding, write_through=True)
        )
    return pipes


@pytest.mark.parametrize("encoding", ["cp1252", "cp437", "cp932", "ascii", "latin-1", "utf-8"])
def test_a_solution_is_printed_in_any_encoding(monkeypatch: pytest.MonkeyPatch, encoding: str):
    """Windows gives a pipe the encoding of its region: cp1252 has neither κ nor ≤."""
    out, err = piped(monkeypatch, encoding)
    assert main(["solve", "--hover", "--preset", "thesis"]) == 0
    text = out.getvalue().decode(encoding)
    assert ("κ = P_i/(C_T λ0)" if encoding == "utf-8" else "P_i/(C_T ") in text
    assert encoding != "cp1252" or "kappa = P_i/(C_T lambda0)" in text
    assert "?" not in text
    assert err.getvalue() == b""
    assert main(["solve", "--twist", "linear:≤κ"]) == 2
    assert err.getvalue().decode(encoding).startswith("rotor: twist")
    with pytest.raises(SystemExit, match="0"):
        main(["solve", "--help"])
    with pytest.raises(SystemExit, match="0"):
        explorer(["--help"])
    assert b"--mass-kg" in out.getvalue()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
@pytest.mark.parametrize("arguments", [["solve", "--hover"], ["solve", "--hover", "--json"]])
def test_a_full_disk_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], arguments: list[str]
):
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        monkeypatch.setattr(sys, "stdout", full)
        code = main(arguments)
        print("what Python would write as it ends")
    assert code == 2
    assert capsys.readouterr().err == (
        "rotor: the output cannot be written (No space left on device): free the disk, or write elsewhere\n"
    )


def caused(error: BaseException, by: BaseException) -> BaseException:
    error.__cause__ = by
    return error


@pytest.mark.parametrize(
    ("error", "code", "says"),
    [
        (ValueError("µ is 9: choose less"), 2, "rotor: µ is 9: choose less\n"),
        (OverflowError("too large"), 2, "rotor: too large\n"),
        (RecursionError(), 2, "rotor: the input is nested too deeply: simplify it\n"),
        (MemoryError(), 2, "rotor: there is not enough memory: ask for less at once\n"),
        (
            PermissionError(13, "Permission denied", "a.csv"),
            2,
            "rotor: 'a.csv' cannot be used (Permission denied)",
        ),
        (KeyboardInterrupt(), 130, "rotor: stopped\n"),
        (
            caused(SystemError("kernel"), caused(SystemError("kernel"), KeyboardInterrupt())),
            130,
            "rotor: stopped\n",
        ),
    ],
)
def test_failures_are_one_line(
    error: BaseException, code: int, says: str, capsys: pytest.CaptureFixture[str]
):
    def run() -> int:
        raise error

    assert run_command("rotor", run) == code
    err = capsys.readouterr().err
    assert err.startswith(says)
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    "run", [lambda: main(["solve", "--hover"]), lambda: explorer(["--port", "0"])]
)
def test_a_closed_output_is_one_line(
    run: Callable[[], int], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setattr(sys, "stdout", None)  # As Python has it after `>&-`.
    assert run() == 2
    error = capsys.readouterr().err
    assert "the output is closed: write it to a file" in error
    assert error.count("\n") == 1
    monkeypatch.setattr(sys, "stderr", None)
    assert run() == 2
    sys.stderr.close()


def test_ctrl_c_within_a_kernel_is_a_keyboard_interrupt():
    """Every sixth was a SystemError of numba. Python discards one in thousands: no loop may wait for it."""
    solve(make_design())
    delays, before = random.Random(1), signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        interrupted = 0
        for _ in range(60):
            try:
                signal.setitimer(signal.ITIMER_REAL, delays.uniform(0.0005, 0.02))
                while signal.getitimer(signal.ITIMER_REAL)[0]:
                    solve(make_design(mu=delays.uniform(0.15, 0.3)))
            except KeyboardInterrupt:
                interrupted += 1
        assert interrupted > 50
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def test_a_stop_whose_exception_is_lost_still_ends_the_program():
    """Python prints and discards one that comes up while a weak reference is cleared."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        stop = StopSignal()
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGTERM)
        with pytest.raises(KeyboardInterrupt):
            stop.wait()
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@pytest.mark.parametrize(
    ("module", "where", "sent", "code", "said"),
    [
        ("rotor", "rotor.trim.solve", signal.SIGINT, 130, "rotor: stopped\n"),
        ("explorer", "rotor.trim.solve", signal.SIGTERM, 0, ""),
        ("explorer", "explorer.app", signal.SIGTERM, 0, ""),
        ("explorer", "explorer.app", signal.SIGINT, 0, ""),
    ],
)
def test_a_signal_while_modules_are_read_ends_without_a_traceback(
    module: str, where: str, sent: signal.Signals, code: int, said: str
):
    """For 0.4 s Ctrl-C gave a traceback, and a service's stop before serving ended with -15."""
    program = f"""
import os, runpy, sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == {where!r}:
            os.kill(os.getpid(), {int(sent)})
sys.meta_path.insert(0, Finder())
sys.argv = ["-m", "solve"] if {module!r} == "rotor" else ["-m", "--no-browser", "--port", "0"]
runpy.run_module({module!r}, run_name="__main__", alter_sys=True)
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=120
    )
    assert (ended.returncode, ended.stderr) == (code, said)
