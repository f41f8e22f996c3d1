"""Chunks on Dask: an embedded cluster of one process a core, or any running one by its address.

A window of chunks is on its way at any time, so that a million points do not flood the scheduler; a chunk whose worker
is lost goes to another one.
"""

import importlib
import logging
import os
import queue
import signal
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from rotor.study.chunks import FinishedChunk, StudyProvenance, VersionMismatch, evaluate_chunk
from rotor.study.study import Study

INSTALL_HINT = "studies need Dask, distributed and pyarrow: pip install 'rotor-explorer[study]'"
_AHEAD = 2
"""Chunks on their way for each thread of a worker: one that runs, one that waits."""
_LOOK = 0.2
"""[s] between looks at whether somebody asked to stop."""
_COUNT = 5.0
"""[s] between counts of the workers, which come and go."""
_RETRIES = 3
"""Times that a chunk may be handed out again after Dask gave it up with its workers."""


class ClusterLost(RuntimeError):
    """The cluster is gone; finished chunks are kept."""


@dataclass
class ChunkRun:
    """How a run of chunks ended."""

    stopped: bool = False
    lost: list[int] = field(default_factory=list[int])
    """Chunks that took their workers down with them, again and again."""


def need_packages() -> None:
    """ValueError, with how to get them, where the packages of studies are missing."""
    try:
        for name in ("dask", "distributed", "pyarrow"):
            importlib.import_module(name)
    except ImportError:
        raise ValueError(INSTALL_HINT) from None


@contextmanager
def connected(address: str | None, workers: int | None) -> Generator[Any]:
    """A Dask client: of the cluster at `address`, or of one made here for the while. ValueError for no answer."""
    distributed: Any = importlib.import_module("distributed")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # What goes wrong is said in our sentences.
    if address is not None:
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
        return
    # Processes begun while Ctrl-C is ignored go on ignoring it: it is for this one to understand.
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        cluster = distributed.LocalCluster(
            n_workers=workers or os.cpu_count() or 1,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",  # Its own choice, 8787, may be taken by another study or cluster.
            scheduler_kwargs={"dashboard": False},
            silence_logs=logging.CRITICAL,
        )
        client = distributed.Client(cluster, set_as_default=False)
    finally:
        signal.signal(signal.SIGINT, before)
    try:
        yield client
    finally:
        client.close(timeout=5)
        cluster.close(timeout=10)


def run_chunks(
    client: Any,
    study: Study,
    chunks: Sequence[int],
    provenance: StudyProvenance,
    take: Callable[[FinishedChunk], None],
    stop: Callable[[], bool],
    wait_for_workers: Callable[[], None] = lambda: None,
) -> ChunkRun:
    """Work chunks off, in any order; `take` has each as soon as it is done.

    `stop` is asked several times a second; True leaves what is on its way. `wait_for_workers` is told when there are
    none. Raises ClusterLost where the scheduler is gone, VersionMismatch where a worker has another version.
    `take` must not raise OSError, which is read as a failure of the cluster.
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


_GONE = "the Dask scheduler is gone: finished chunks are kept; run the same command again to go on"


def _judge(error: BaseException, chunk: int) -> None:
    """Pass over the loss of workers, for which a chunk is tried again; raise what no other worker would do better."""
    if type(error).__name__ == "KilledWorker":
        return
    if isinstance(error, VersionMismatch):
        raise error
    if isinstance(error, ImportError) or "deserialization" in str(error):
        cause = error.__cause__ or error  # Dask wraps what a worker without this package says.
        raise ValueError(
            f"a worker cannot read the study ({str(cause).partition(chr(10))[0]}): install rotor-explorer[study], "
            "the same version, on every worker"
        ) from None
    raise ValueError(f"chunk {chunk} failed on its worker ({type(error).__name__}: {error})") from None
