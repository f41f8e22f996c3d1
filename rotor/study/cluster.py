"""Runs chunks in processes of this machine, one per core, or on a running Dask cluster by its address.

Only a window of chunks is submitted at a time, so that a million points do not flood the scheduler. A chunk whose
worker is lost is submitted again.
"""

import importlib
import logging
import os
import queue
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from rotor.study.chunks import FinishedChunk, StudyProvenance, VersionMismatch, evaluate_chunk
from rotor.study.local_processes import LocalProcesses
from rotor.study.study import Study

INSTALL_HINT = "studies need pyarrow, on a cluster Dask too: pip install 'rotor-explorer[study]'"
_AHEAD = 2
"""Submitted chunks per thread of a worker: one running, one waiting."""
_LOOK = 0.2
"""[s] between checks for a request to stop."""
_COUNT = 5.0
"""[s] between counts of the workers, which may join and leave."""
_RETRIES = 3
"""Times that a chunk is submitted again after its workers were lost."""


class ClusterLost(RuntimeError):
    """The cluster is gone; finished chunks are kept."""


@dataclass
class ChunkRun:
    """How a run of chunks ended."""

    stopped: bool = False
    lost: list[int] = field(default_factory=list[int])
    """Chunks that repeatedly stopped their workers."""


def need_packages(cluster: bool = False) -> None:
    """ValueError with the remedy where the packages of studies are missing; `cluster`: also those of Dask."""
    try:
        for name in ("pyarrow", *(("dask", "distributed") if cluster else ())):
            importlib.import_module(name)
    except ImportError:
        raise ValueError(INSTALL_HINT) from None


@contextmanager
def connected(address: str | None, workers: int | None) -> Generator[Any]:
    """A Dask client of the cluster at `address`, or processes of this machine. ValueError without a cluster there.

    A cluster at a tls:// address is reached with the certificates of Dask's own configuration.
    """
    if address is None:
        processes = LocalProcesses(workers or os.cpu_count() or 1)
        try:
            yield processes
        finally:
            processes.close()
        return
    distributed: Any = importlib.import_module("distributed")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # Errors are reported by this package.
    try:
        client = distributed.Client(address, timeout="10s", set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise ValueError(
            f"no Dask scheduler answers at {address!r} ({type(error).__name__}): start one with `dask scheduler`, "
            "and give the tcp://host:port that it prints"
        ) from None
    try:
        yield client
    finally:
        client.close(timeout=5)


def run_chunks(
    client: Any,
    study: Study,
    chunks: Sequence[int],
    provenance: StudyProvenance,
    take: Callable[[FinishedChunk], None],
    stop: Callable[[], bool],
    wait_for_workers: Callable[[], None] = lambda: None,
) -> ChunkRun:
    """Compute chunks in any order; `take` is called with each finished one.

    `stop` is called several times a second; True ends the run. `wait_for_workers` is called without workers. Raises
    ClusterLost where the scheduler is gone, VersionMismatch where a worker has another version. `take` must not raise
    OSError, which is read as a failure of the cluster.
    """
    ended, news = ChunkRun(), queue.SimpleQueue[Any]()
    waiting, under_way = iter(chunks), dict[Any, int]()
    tries = dict.fromkeys(chunks, 0)
    counted, threads, lonely = -_COUNT, 0, False

    def submit(chunk: int) -> None:
        tries[chunk] += 1
        key = f"rotor-study-{study.fingerprint}-{os.getpid()}-{chunk}-{tries[chunk]}"
        future = client.submit(evaluate_chunk, study, chunk, provenance, key=key, pure=False)
        under_way[future] = chunk
        future.add_done_callback(news.put)

    try:
        while True:
            if time.monotonic() - counted > _COUNT:
                counted, threads = time.monotonic(), sum(client.nthreads().values())
                if threads == 0 and not lonely:
                    wait_for_workers()
                lonely = threads == 0
            while len(under_way) < _AHEAD * max(threads, 1) and (chunk := next(waiting, None)) is not None:
                submit(chunk)
            if not under_way:
                return ended
            if stop():
                ended.stopped = True
                return ended
            try:
                future = news.get(timeout=_LOOK)
            except queue.Empty:
                continue
            chunk = under_way.pop(future)
            if future.status == "finished":
                take(future.result())
            elif future.status == "error":
                _judge(future.exception(), chunk)
                if tries[chunk] <= _RETRIES:
                    submit(chunk)
                else:
                    ended.lost.append(chunk)
            else:
                raise ClusterLost(_GONE)
            future.release()
    except OSError:  # Dask's own CommClosedError, and TimeoutError, are among these.
        raise ClusterLost(_GONE) from None
    finally:
        for future in under_way:
            future.cancel()


_GONE = "the Dask scheduler is gone: finished chunks are kept; run the same command again to continue"


def _judge(error: BaseException, chunk: int) -> None:
    """Ignore the loss of workers, after which a chunk is retried; raise every other error."""
    if type(error).__name__ in ("KilledWorker", "BrokenProcessPool"):
        return
    if isinstance(error, VersionMismatch):
        raise error
    if isinstance(error, ImportError) or "deserialization" in str(error):
        cause = error.__cause__ or error  # Dask wraps the error of a worker without this package.
        raise ValueError(
            f"a worker cannot read the study ({str(cause).partition(chr(10))[0]}): install rotor-explorer[study], "
            "the same version, on every worker"
        ) from None
    raise ValueError(f"chunk {chunk} failed on its worker ({type(error).__name__}: {error})") from None
