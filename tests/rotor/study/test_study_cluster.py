"""Studies on real Dask processes, started as by a user: on loopback, killed without warning, and continued."""

import importlib
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotor.assets import package_version
from rotor.study.chunks import FinishedChunk, StudyProvenance, connected, evaluate_points, run_chunks
from rotor.study.results import Results, read_results
from rotor.study.study_file import read_study

pytestmark = pytest.mark.slow
linux = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")

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
        running.append(subprocess.Popen(list(command), cwd=ROOT, env=env, start_new_session=True, **more))
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
        one = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", tmp_path / "scratch")
        cluster.workers.append(start(DASK, "worker", cluster.address, *one, **QUIET))
    # Before there is work: a worker that comes late would find all of it done by the other.
    subprocess.run([sys.executable, "-c", _BOTH, cluster.address], check=True, timeout=PATIENCE)
    return cluster


def until(true: Callable[[], bool], run: "subprocess.Popen[bytes] | None" = None) -> None:
    """Wait; fail if the run has ended."""
    begin = time.monotonic()
    while not true():
        assert time.monotonic() - begin < PATIENCE, "waited too long"
        assert run is None or run.poll() is None, f"the run ended with {run.returncode}"
        time.sleep(0.05)


def files(folder: Path) -> dict[str, int]:
    """Finished chunks, and when they were written [ns]."""
    return {path.name: path.stat().st_mtime_ns for path in folder.glob("chunk-*.parquet")}


def study_file(tmp_path: Path) -> Path:
    path = tmp_path / "small.toml"
    path.write_text(STUDY, encoding="utf-8")
    return path


def command(file: Path, out: Path, *more: str) -> list[str]:
    return [sys.executable, "-W", "error", "-m", "rotor", "study", str(file), "--out", str(out), *more]


def finished(file: Path, out: Path, *more: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(command(file, out, *more), cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)


def same_as_serial(file: Path, results: Results) -> None:
    """All rows, and the numbers of one process that computes the chunks in turn."""
    study = read_study(file).study
    assert_array_equal(results.columns["point"], np.arange(study.count))
    assert results.good.all()
    for chunk in (0, 17, study.chunks - 1):
        first, last = study.span(chunk)
        for row in evaluate_points(study, first, last):
            for name in ("power_total_w", "power_induced_w", "collective_deg", "lambda0", "mu", "mass_kg"):
                assert_allclose(results.columns[name][row["point"]], row[name], rtol=1e-10)


def workers_of(folder: Path) -> set[str]:
    parquet: Any = importlib.import_module("pyarrow.parquet")
    return {parquet.read_metadata(path).metadata[b"worker"].decode() for path in folder.glob("chunk-*.parquet")}


def test_two_workers_give_the_results_of_one_process(cluster: Cluster, tmp_path: Path):
    file, out = study_file(tmp_path), tmp_path / "out"
    done = finished(file, out, "--scheduler", cluster.address)
    assert (done.returncode, done.stderr.count("\n")) == (0, 1)
    assert "has no encryption and no password" in done.stderr
    assert "1,860 of 1,860 points, 0 failed" in done.stdout
    same_as_serial(file, read_results(out))
    assert len(workers_of(out)) == 2


def test_no_results_are_lost_with_a_killed_worker(cluster: Cluster, tmp_path: Path, start: Callable[..., Any]):
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(*command(file, out, "--scheduler", cluster.address), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    until(lambda: len(workers_of(out)) == 2, run)
    before = len(files(out))
    assert before < 75
    cluster.workers[0].kill()
    assert run.wait(PATIENCE) == 0, run.stderr.read()
    same_as_serial(file, read_results(out))


def test_a_killed_run_continues_from_its_folder(tmp_path: Path, start: Callable[..., Any]):
    """SIGKILL, then the same command on its own cluster: no finished chunk is computed again."""
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


def test_ctrl_c_leaves_usable_results(tmp_path: Path, start: Callable[..., Any]):
    """Sent to the process group, as from a terminal; results so far are shown, and no process is left."""
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(*command(file, out), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    until(lambda: len(files(out)) >= 5, run)
    os.killpg(run.pid, signal.SIGINT)
    printed, complained = run.communicate(timeout=PATIENCE)
    assert run.returncode == 130
    assert complained.decode().startswith("rotor: stopped with ")
    assert complained.count(b"\n") == 1
    assert "least power_total_w" in printed.decode()
    assert read_results(out).rows >= 125
    until(lambda: not group_lives(run.pid))
    assert start(*command(file, out), stdout=subprocess.DEVNULL).wait(PATIENCE) == 0
    same_as_serial(file, read_results(out))


def group_lives(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def test_another_cluster_on_the_machine_does_not_interfere(tmp_path: Path):
    """Another program has Dask's default port: no message about it."""
    file = tmp_path / "two.toml"
    file.write_text(STUDY.replace('"6000:9000:100"', "[7000]").replace('"0.05:0.34:0.01"', "[0.2]"), encoding="utf-8")
    with socket.socket() as taken:
        with suppress(OSError):  # Somebody else has it, which does as well.
            taken.bind(("127.0.0.1", 8787))
            taken.listen()
        done = finished(file, tmp_path / "out", "--workers", "1")
    assert (done.returncode, done.stderr) == (0, "")


def where(_: float) -> tuple[int, set[str]]:
    """This process, and the local addresses of its TCP sockets that listen, as /proc writes them."""
    sockets: set[str] = set()
    for one in Path("/proc/self/fd").iterdir():
        with suppress(OSError):
            sockets.add(str(one.readlink()))
    rows = [line.split() for name in ("tcp", "tcp6") for line in Path(f"/proc/net/{name}").read_text().splitlines()]
    return os.getpid(), {row[1] for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in sockets}


def die(_: float) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@linux
@pytest.mark.parametrize("workers", [1, 2])
def test_workers_of_this_machine_are_reached_from_this_machine_only(workers: int):
    before = where(0.0)[1]  # Other tests of this process may have servers.
    with connected(None, workers) as client:
        process, ports = client.submit(where, 0.0).result()
        assert (process == os.getpid()) == (workers == 1)
        for port in (ports | where(0.0)[1]) - before:
            assert port.startswith("0100007F:")  # 127.0.0.1
        assert client.scheduler.address.startswith("inproc" if workers == 1 else "tls")


def test_a_killed_process_of_this_machine_is_replaced(tmp_path: Path):
    study = read_study(study_file(tmp_path)).study
    provenance = StudyProvenance(package_version(), None, "")
    done: list[FinishedChunk] = []
    with connected(None, 2) as client:
        assert client.submit(die, 0.0).exception() is not None
        ended = run_chunks(client, study, [0, 1, 2], provenance, done.append, lambda: False)
    assert not ended.lost
    assert sorted(one.chunk for one in done) == [0, 1, 2]


_PARENT = """
import os, signal
from rotor.study.chunks import connected
if __name__ == "__main__":
    with connected(None, 2) as client:
        print(*client.run(os.getpid).values(), flush=True)
        os.kill(os.getpid(), signal.SIGKILL)
"""


@linux
def test_processes_end_with_a_parent_that_was_killed(tmp_path: Path):
    (tmp_path / "parent.py").write_text(_PARENT, encoding="utf-8")
    parent = subprocess.run(
        [sys.executable, tmp_path / "parent.py"], env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL, text=True,
    )  # fmt: skip
    assert parent.returncode == -signal.SIGKILL
    processes = [int(word) for word in parent.stdout.split()]
    assert len(processes) == 2
    until(lambda: not any(_alive(process) for process in processes))


def _alive(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_error_without_a_scheduler_at_the_address_is_one_sentence(tmp_path: Path):
    address = "tcp://127.0.0.1:9"
    done = finished(study_file(tmp_path), tmp_path / "out", "--scheduler", address)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert address in done.stderr
    assert "dask scheduler" in done.stderr


def test_error_for_a_lost_scheduler_is_one_sentence(cluster: Cluster, tmp_path: Path, start: Callable[..., Any]):
    """The scheduler is killed during a run: finished chunks are kept, and the command reports it."""
    file, out = study_file(tmp_path), tmp_path / "out"
    run = start(*command(file, out, "--scheduler", cluster.address), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    until(lambda: len(files(out)) >= 5, run)
    cluster.scheduler.kill()
    _, complained = run.communicate(timeout=PATIENCE)
    assert run.returncode == 1
    assert "the Dask scheduler is gone" in complained.decode()
    assert read_results(out).rows >= 125
