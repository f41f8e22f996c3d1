"""Runs chunks on Dask: on processes of this machine, one per core, or on a running cluster by its address."""

import importlib
import logging
import os
import signal
import time
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from importlib.util import find_spec
from typing import Any

from rotor.study.chunks import FinishedChunk, StudyProvenance, VersionMismatch, evaluate_chunk
from rotor.study.study import Study

_LOOK = 0.1
"""[s] between checks for finished chunks, and for a request to stop."""


class ClusterLost(RuntimeError):
    """The cluster is gone; finished chunks are kept."""


@dataclass
class ChunkRun:
    """How a run of chunks ended."""

    stopped: bool = False
    lost: list[int] = field(default_factory=list[int])
    """Chunks that repeatedly stopped their workers."""


@contextmanager
def connected(address: str | None, workers: int | None) -> Generator[Any]:
    """A Dask client of the cluster at `address`, or of one on this machine. ValueError without a cluster there.

    On this machine one worker is a thread of this process. More are processes that talk over 127.0.0.1, with TLS and
    certificates of this run where the package `cryptography` is installed. A cluster at a tls:// address is reached
    with the certificates of Dask's own configuration.
    """
    distributed: Any = importlib.import_module("distributed")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # Errors are reported by this package.
    if address is None:
        with _local_cluster(workers or os.cpu_count() or 1) as cluster, distributed.Client(cluster) as client:
            yield client
        return
    try:
        client = distributed.Client(address, timeout="10s")
    except (OSError, ValueError, TimeoutError) as error:
        raise ValueError(
            f"no Dask scheduler answers at {address!r} ({type(error).__name__}): start one with `dask scheduler`, "
            "and give the tcp://host:port that it prints"
        ) from None
    try:
        yield client
    finally:
        client.close(timeout=5)


def _local_cluster(workers: int) -> Any:
    """A Dask cluster of so many workers on this machine; nothing of it can be reached from others."""
    distributed: Any = importlib.import_module("distributed")
    config: Any = importlib.import_module("dask").config
    several = workers > 1
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # The processes inherit it: Ctrl-C is left to this one.
    try:
        with config.set({"distributed.scheduler.http.routes": [], "distributed.worker.http.routes": []}):
            return distributed.LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=several,
                host="127.0.0.1" if several else None,
                dashboard_address="127.0.0.1:0",
                worker_dashboard_address="127.0.0.1:0",
                memory_limit=0,  # A trim needs little; Dask would stop workers on a machine that is nearly full.
                silence_logs=logging.CRITICAL,
                protocol=None if several else "inproc://",
                security=distributed.Security.temporary() if several and find_spec("cryptography") else None,
            )
    finally:
        signal.signal(signal.SIGINT, before)


def run_chunks(
    client: Any,
    study: Study,
    chunks: Sequence[int],
    provenance: StudyProvenance,
    keep: Callable[[FinishedChunk], None],
    stop: Callable[[], bool],
) -> ChunkRun:
    """Compute chunks in any order; `keep` is called with each finished one.

    Dask computes a chunk again whose worker was lost. `stop` is called several times a second; True ends the run.
    Raises ClusterLost where the scheduler is gone, VersionMismatch where a worker has another version. `keep` must not
    raise OSError, which is read as a failure of the cluster.
    """
    distributed: Any = importlib.import_module("distributed")
    ended = ChunkRun()
    under_way: dict[Any, int] = {}
    try:
        # A key of its own for each run: another run of the same study may be on this cluster.
        keys = [f"rotor-study-{study.fingerprint}-{os.getpid()}-{time.time_ns()}-{chunk}" for chunk in chunks]
        task = partial(evaluate_chunk, study, provenance=provenance)
        under_way = dict(zip(client.map(task, chunks, key=keys, pure=False), chunks, strict=True))
        finished = distributed.as_completed(under_way)
        while under_way:
            if stop():
                ended.stopped = True
                break
            batch = finished.next_batch(block=False)
            if not batch:
                time.sleep(_LOOK)
            for future in batch:
                chunk = under_way.pop(future)
                if future.status != "error":
                    keep(future.result())  # Computed again where its worker was lost meanwhile.
                elif type(error := future.exception()).__name__ == "KilledWorker":
                    ended.lost.append(chunk)
                else:
                    raise _explained(error, chunk)
                future.release()
        return ended
    except (OSError, CancelledError):  # Dask's own CommClosedError, and TimeoutError, are among these.
        raise ClusterLost(
            "the Dask scheduler is gone: finished chunks are kept; run the same command again to continue"
        ) from None
    finally:
        client.cancel(list(under_way))


def _explained(error: BaseException, chunk: int) -> ValueError:
    """The failure of a whole chunk as one sentence."""
    if isinstance(error, VersionMismatch):
        return error
    if isinstance(error, ImportError) or "deserialization" in str(error):
        cause = error.__cause__ or error  # Dask wraps the error of a worker without this package.
        return ValueError(
            f"a worker cannot read the study ({str(cause).partition(chr(10))[0]}): install rotor-explorer, "
            "the same version, on every worker"
        )
    return ValueError(f"chunk {chunk} failed on its worker ({type(error).__name__}: {error})")
