"""Studies on processes, on a real Dask cluster and on other executors: killed without warning, and continued."""

import importlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import (
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotor.study.chunks import evaluate_points
from rotor.study.results import Results, read_results
from rotor.study.run import run_study
from rotor.study.study_file import read_study
from tests.waited import until

pytestmark = pytest.mark.slow
ROOT = Path(__file__).parent.parent.parent.parent
DASK = Path(sys.executable).with_name("dask")
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
PATIENCE = 240.0
"""Time limit of every step [s], on a busy machine."""

STUDY = """
title = "Small trims"
chunk = 25
[axes]
mu = "0.05:0.34:0.01"
mass_kg = "6000:9000:100"
rate_deg = [-16, -8]
[fixed]
concept = "linear"
[models]
inflow = "pitt-peters"
elements = 16
azimuths = 48
"""
"""1 860 trims of some 3 ms in 75 chunks."""


@dataclass
class Cluster:
    """A scheduler and its workers."""

    address: str
    scheduler: "subprocess.Popen[bytes]"
    workers: list["subprocess.Popen[bytes]"] = field(default_factory=list)


@pytest.fixture
def start() -> "Iterator[Callable[..., subprocess.Popen[bytes]]]":
    """Start a program; it is stopped when the test ends."""
    running: list[subprocess.Popen[Any]] = []

    def begin(*command: str | Path, **more: Any) -> "subprocess.Popen[Any]":
        # A `dask worker` does not look into its own folder for packages; the installed one may be another checkout.
        env = {**os.environ, "PYTHONPATH": str(ROOT)}
        running.append(
            subprocess.Popen(list(command), cwd=ROOT, env=env, start_new_session=True, **more)
        )
        return running[-1]

    yield begin
    for process in running:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()  # Closes its pipes as well.


_BOTH = """
import sys
from distributed import Client
with Client(sys.argv[1], timeout=200) as client:
    client.wait_for_workers(2, timeout=200)
    client.run(__import__, "rotor.study.chunks")
"""


@pytest.fixture
def cluster(start: Callable[..., Any], tmp_path: Path) -> Cluster:
    """`dask scheduler` and two `dask worker` commands, as docs/scale.md says."""
    address_file = tmp_path / "scheduler.json"
    local = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    scheduler = start(DASK, "scheduler", *local, "--scheduler-file", address_file, **QUIET)
    until(lambda: address_file.exists() and address_file.stat().st_size > 0)
    cluster = Cluster(json.loads(address_file.read_text())["address"], scheduler)
    for _ in range(2):
        one = (
            "--nthreads",
            "1",
            "--no-nanny",
            "--no-dashboard",
            "--local-directory",
            tmp_path / "scratch",
        )
        cluster.workers.append(start(DASK, "worker", cluster.address, *one, **QUIET))
    # Before there is work: a worker that comes late would find all of it done by the other.
    subprocess.run([sys.executable, "-c", _BOTH, cluster.address], check=True, timeout=PATIENCE)
    return cluster


def files(folder: Path) -> dict[str, int]:
    """Finished chunks, and when they were written [ns]."""
    return {path.name: path.stat().st_mtime_ns for path in folder.glob("chunk-*.parquet")}


def study_file(tmp_path: Path) -> Path:
    path = tmp_path / "small.toml"
    path.write_text(STUDY, encoding="utf-8")
    return path


def command(file: Path, out: Path, *more: str) -> list[str]:
    return [
        sys.executable,
        "-W",
        "error",
        "-m",
        "rotor",
        "study",
        str(file),
        "--out",
        str(out),
        *more,
    ]


def finished(file: Path, out: Path, *more: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        command(file, out, *more), cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE
    )


def same_as_serial(file: Path, results: Results) -> None:
    """All rows, and the numbers of one process that computes the chunks in turn."""
    study = read_study(file).study
    assert_array_equal(results.columns["point"], np.arange(study.count))
    assert results.good.all()
    for chunk in (0, 17, study.chunks - 1):
        first, last = study.span(chunk)
        for row in evaluate_points(study, first, last):
            for name in (
                "power_total_w",
                "power_induced_w",
                "collective_deg",
                "lambda0",
                "mu",
                "mass_kg",
            ):
                assert_allclose(results.columns[name][row["point"]], row[name], rtol=1e-10)


def workers_of(folder: Path) -> set[str]:
    parquet: Any = importlib.import_module("pyarrow.parquet")
    return {
        parquet.read_metadata(path).metadata[b"worker"].decode()
        for path in folder.glob("chunk-*.parquet")
    }


def test_no_results_are_lost_with_a_killed_worker(
    cluster: Cluster, tmp_path: Path, start: Callable[..., Any]
):
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(
        *command(file, out, "--scheduler", cluster.address),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    until(lambda: len(workers_of(out)) == 2, run)
    before = len(files(out))
    assert before < 75
    cluster.workers[0].kill()
    assert run.wait(PATIENCE) == 0, run.stderr.read()
    same_as_serial(file, read_results(out))


def test_a_killed_run_continues_from_its_folder(tmp_path: Path, start: Callable[..., Any]):
    """SIGKILL, then the same command: no finished chunk is computed again."""
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(*command(file, out), **QUIET)
    until(lambda: len(files(out)) >= 10, run)
    os.kill(run.pid, signal.SIGKILL)
    run.wait()
    before = files(out)
    assert 10 <= len(before) < 75
    again = start(*command(file, out), **QUIET)
    assert again.wait(PATIENCE) == 0
    after = files(out)
    assert len(after) == 75
    assert {name: after[name] for name in before} == before
    same_as_serial(file, read_results(out))


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_leaves_usable_results(
    how: signal.Signals, tmp_path: Path, start: Callable[..., Any]
):
    """SIGINT to the process group, as from a terminal; results so far are shown, and no process is left."""
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(*command(file, out), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    until(lambda: len(files(out)) >= 5, run)
    (os.killpg if how is signal.SIGINT else os.kill)(run.pid, how)
    printed, complained = run.communicate(timeout=PATIENCE)
    assert run.returncode == 130
    assert complained.decode().startswith("rotor: stopped with ")
    assert complained.count(b"\n") == 1
    assert "least power_total_w" in printed.decode()
    assert read_results(out).rows >= 125
    until(lambda: not group_lives(run.pid))


def group_lives(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.parametrize(
    ("address", "remedy"),
    [("tcp://127.0.0.1:9", "dask scheduler"), ("tls://127.0.0.1:9", "set distributed.comm.tls")],
)
def test_error_without_a_scheduler_at_the_address_is_one_sentence(
    address: str, remedy: str, tmp_path: Path
):
    done = finished(study_file(tmp_path), tmp_path / "out", "--scheduler", address)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert address in done.stderr
    assert remedy in done.stderr


FEW = (
    STUDY.replace('"6000:9000:100"', "[7000, 8000]")
    .replace('"0.05:0.34:0.01"', '"0.1:0.3:0.05"')
    .replace("25", "5")
)
"""20 trims in four chunks."""


class Fragile(Executor):
    """Loses the workers of some chunks, so often for each; computes the others here."""

    def __init__(self, losses: dict[int, int]) -> None:
        self.losses = losses

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        chunk = args[1]
        if self.losses.get(chunk, 0):
            self.losses[chunk] -= 1
            future.set_exception(BrokenExecutor("lost"))
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def few(tmp_path: Path) -> Path:
    path = tmp_path / "few.toml"
    path.write_text(FEW, encoding="utf-8")
    return path


def test_any_executor_computes_the_same_numbers(tmp_path: Path):
    """Threads too, at the same time in one process, and processes of the standard library."""
    file = few(tmp_path)
    told: list[tuple[int, int]] = []
    expected = run_study(
        file, out=tmp_path / "here", workers=1, notify=lambda *points: told.append(points)
    )
    assert told == [(5, 20), (10, 20), (15, 20), (20, 20)]
    with (
        ThreadPoolExecutor(4) as threads,
        ProcessPoolExecutor(2, get_context("spawn")) as processes,
    ):
        for name, executor in {"threads": threads, "processes": processes}.items():
            results = run_study(file, executor, out=tmp_path / name)
            for column in ("power_total_w", "collective_deg", "flap_1c_deg", "passes"):
                assert_array_equal(results.columns[column], expected.columns[column], column)


def test_a_chunk_whose_worker_was_lost_is_computed_again_three_times_at_most(tmp_path: Path):
    file = few(tmp_path)
    assert run_study(file, Fragile({0: 2, 3: 1}), out=tmp_path / "again").good.all()
    with pytest.raises(RuntimeError, match="1 chunk stopped their workers"):
        run_study(file, Fragile({2: 3}), out=tmp_path / "lost")
    assert read_results(tmp_path / "lost").rows == 15
    assert run_study(file, Fragile({}), out=tmp_path / "lost").rows == 20


def test_an_executor_that_is_gone_or_is_none_is_one_sentence(tmp_path: Path):
    closed = ThreadPoolExecutor(1)
    closed.shutdown()
    with pytest.raises(RuntimeError, match="the workers are gone"):
        run_study(few(tmp_path), closed, out=tmp_path / "out")
    client: Any = object()
    with pytest.raises(TypeError, match=r"client\.get_executor"):
        run_study(few(tmp_path), client)
    with pytest.raises(ValueError, match="omit them"):
        run_study(few(tmp_path), closed, workers=2)


def test_workers_of_another_version_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("rotor.study.run.package_version", lambda: "0.0")
    with (
        ThreadPoolExecutor(1) as threads,
        pytest.raises(ValueError, match="install the same version on every worker"),
    ):
        run_study(few(tmp_path), threads, out=tmp_path / "out")


@pytest.mark.parametrize("missing", ["pyarrow", "distributed"])
def test_a_missing_extra_is_one_sentence(missing: str, tmp_path: Path):
    hide = f"import sys; sys.modules[{missing!r}] = None; from rotor.__main__ import main; sys.exit(main(sys.argv[1:]))"
    study = [
        "study",
        str(few(tmp_path)),
        "--out",
        str(tmp_path / "out"),
        "--scheduler",
        "tcp://127.0.0.1:9",
    ]
    done = subprocess.run(
        [sys.executable, "-c", hide, *study], cwd=ROOT, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert f"needs {missing}: pip install {missing}\n" in done.stderr


class KillsAtThird:
    """Hears of finished chunks, and kills processes at the third."""

    def __init__(self, processes: list["subprocess.Popen[bytes]"]) -> None:
        self.processes, self.left = processes, 3

    def __call__(self, done: int, total: int) -> None:
        del done, total
        self.left -= 1
        if self.left == 0:
            for process in self.processes:
                process.kill()


def test_a_cluster_without_workers_ends_the_study_and_what_is_done_is_kept(
    cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Dask itself waits for new workers without end."""
    monkeypatch.setattr("rotor.study.cluster._QUERY_INTERVAL", 1.0)
    monkeypatch.setattr("rotor.study.cluster._WORKER_TIMEOUT", 2.0)
    file, out = study_file(tmp_path), tmp_path / "out"
    distributed: Any = importlib.import_module("distributed")
    with (
        distributed.Client(cluster.address) as client,
        pytest.raises(RuntimeError, match="no worker is left"),
    ):
        run_study(file, client.get_executor(), out=out, notify=KillsAtThird(cluster.workers))
    kept = files(out)
    assert 3 <= len(kept) < 75
    run_study(file, out=out, workers=1)
    assert {name: at for name, at in files(out).items() if name in kept} == kept


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_a_run_whose_scheduler_ends_says_so_in_its_last_line(
    how: signal.Signals, cluster: Cluster, tmp_path: Path, start: Callable[..., Any]
):
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(
        *command(file, out, "--scheduler", cluster.address),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    until(lambda: len(files(out)) >= 3, run)
    cluster.scheduler.send_signal(how)
    assert run.wait(PATIENCE) == 1
    said = run.stderr.read().decode()
    assert "Traceback" not in said
    warning, *_, last = said.splitlines()  # Between them a busy machine may say that it waits.
    assert "has no encryption" in warning
    assert last.startswith("rotor: the workers are gone (")
    assert len(files(out)) >= 3
