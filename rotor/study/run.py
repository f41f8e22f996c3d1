"""A study run to its end: its chunks on any executor, each stored as soon as it is finished.

By default the executor is processes of this machine. That of a Dask client (`client.get_executor()`), of mpi4py
(`MPIPoolExecutor`) and any other `concurrent.futures.Executor` compute the same numbers.
"""

import hashlib
import os
from collections import Counter
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from contextlib import closing, contextmanager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from queue import Empty, SimpleQueue

from rotor.study.chunks import (
    FinishedChunk,
    StudyFolder,
    StudyProvenance,
    VersionMismatch,
    arrow_modules,
    evaluate_chunk,
    evaluate_points,
)
from rotor.study.cluster import ClusterWatch, ExecutorLost
from rotor.study.results import Results, read_results
from rotor.study.study import Study
from rotor.study.study_file import StudyFile, read_study
from rotor.support.assets import commit, package_version
from rotor.support.processes import Processes

_POLL_INTERVAL = 0.1
"""[s] between the questions whether to stop."""
_MOST_TRIES = 3
"""Workers that a chunk may cost."""
_GIVEN_UP = "KilledWorker"
"""Dask's error for a chunk that several workers were lost with."""


@dataclass
class ChunkRun:
    """How a run of chunks ended."""

    stopped: bool = False
    lost: list[int] = field(default_factory=list[int])
    """Chunks that repeatedly stopped their workers."""

    @property
    def sentence(self) -> str:
        """A sentence on what went wrong; empty where nothing did."""
        if not self.lost:
            return ""
        chunks = "1 chunk" if len(self.lost) == 1 else f"{len(self.lost)} chunks"
        return (
            f"{chunks} stopped their workers, perhaps for lack of memory: run the same study again"
        )


def run_study(
    study: str | Path,
    executor: Executor | None = None,
    *,
    out: str | Path | None = None,
    workers: int | None = None,
    notify: Callable[[int, int], None] | None = None,
) -> Results:
    """Compute the points of a study file, or those that are still missing in its folder, and return its results.

    Parameters:
        study: a study file, or the name of a shipped one (docs/scale.md).
        executor: where chunks are computed: any `concurrent.futures.Executor` whose workers have this package, for
            example `client.get_executor()` of a Dask client, or `mpi4py.futures.MPIPoolExecutor()`. By default
            processes of this machine.
        out: the folder of the results, by default named as the file.
        workers: how many processes of this machine, by default one per core.
        notify: called with the number of points done, and of all points, after each chunk.

    Returns:
        The whole table: `columns["power_total_w"]` and others by name, arrays by point.

    Raises:
        TypeError: the executor is none.
        ValueError: the file or the folder cannot be used, or a worker has another version; one sentence with the
            remedy. MissingExtra, one of these, where pyarrow is not installed.
        RuntimeError: the executor is gone, chunks repeatedly stopped their workers, or the disk is full. Finished
            chunks are kept, and the next call continues.

    Example:
        >>> _ = pathlib.Path("speeds.toml").write_text("axes.mu = [0.1, 0.2]")
        >>> results = rotor.run_study("speeds.toml", workers=1)
        >>> results.columns["mu"].tolist()
        [0.1, 0.2]
    """
    if executor is not None and not isinstance(executor, Executor):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(
            f"executor is of type {type(executor).__name__}: give a concurrent.futures.Executor, for example that of a "
            "Dask client, client.get_executor()"
        )
    if executor is not None and workers is not None:
        raise ValueError("workers are the processes of this machine: omit them, or omit executor")
    check_workers(workers)
    file = read_study(study)
    with closing(open_study_folder(file, out)) as store:
        missing, total = store.missing(), store.study.count
        done = total - store.study.points_of(missing)

        def heard(chunk: FinishedChunk) -> None:
            nonlocal done
            done += chunk.rows
            if notify is not None:
                notify(done, total)

        if missing:
            with (
                nullcontext(executor)
                if executor is not None
                else local_processes(file.study, workers) as pool
            ):
                ended = run_chunks(pool, store, missing, heard)
            if ended.lost:
                raise RuntimeError(ended.sentence)
        return read_results(store.folder)


def open_study_folder(file: StudyFile, out: str | Path | None) -> StudyFolder:
    """The folder of a study, by default named as its file. ValueError with one sentence where it cannot be used."""
    arrow_modules()  # Check before the folder is made.
    provenance = StudyProvenance(
        package_version(), commit(), hashlib.sha256(file.text.encode()).hexdigest()
    )
    return StudyFolder(out or Path(file.path).stem, file, provenance)


def check_workers(workers: int | None) -> None:
    """ValueError outside 1…1024, before a folder is opened for them."""
    if workers is not None and not 1 <= workers <= 1024:
        raise ValueError(f"{workers} workers are outside 1…1024: use one per core")


@contextmanager
def local_processes(study: Study, workers: int | None) -> Generator[Executor]:
    """Processes of this machine, by default one per core; they end with the context."""
    evaluate_points(study, 0, 1)  # Compiles the kernels once, not in every process.
    pool = Processes(workers or os.cpu_count() or 1)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def run_chunks(
    executor: Executor,
    store: StudyFolder,
    chunks: Sequence[int],
    notify: Callable[[FinishedChunk], None],
    stop: Callable[[], bool] = lambda: False,
    warn: Callable[[str], None] = lambda sentence: None,
) -> ChunkRun:
    """Compute chunks in any order and store them; `notify` is called with each, in this thread.

    A chunk whose worker was lost, or had too little memory, is computed again. `stop` is called several times a second;
    True ends the run. `warn` gets a sentence where a cluster has no workers left. Raises ExecutorLost where the
    executor takes no more work, VersionMismatch where a worker has another version.
    """
    ended, tries, watch = ChunkRun(), Counter[int](), ClusterWatch(executor, warn)
    under_way: dict[Future[FinishedChunk], int] = {}
    finished: SimpleQueue[Future[FinishedChunk]] = SimpleQueue()

    def submit(chunk: int) -> None:
        tries[chunk] += 1
        try:
            future = executor.submit(evaluate_chunk, store.study, chunk, store.provenance)
        except RuntimeError as error:  # BrokenExecutor, or an executor that was shut down.
            raise ExecutorLost(error) from None
        under_way[future] = chunk
        future.add_done_callback(finished.put)

    try:
        for chunk in chunks:
            submit(chunk)
        while under_way:
            if stop():
                ended.stopped = True
                break
            try:
                future = finished.get(timeout=_POLL_INTERVAL)
            except Empty:
                watch.check()
                continue
            chunk = under_way.pop(future)
            if future.cancelled():  # By Dask, when its scheduler is gone.
                raise ExecutorLost("their scheduler ended, or cancelled the work")
            match future.exception():
                case None:
                    done = future.result()
                    watch.chunk_received()
                    store.keep(done.chunk, done.content)
                    notify(done)
                case BrokenExecutor() | MemoryError() if tries[chunk] < _MOST_TRIES:
                    submit(chunk)
                case error if (
                    isinstance(error, BrokenExecutor | MemoryError)
                    or type(error).__name__ == _GIVEN_UP
                ):
                    ended.lost.append(chunk)
                # Dask's CommClosedError is among these.
                case OSError() | CancelledError() as error:
                    raise ExecutorLost(type(error).__name__)
                case error:
                    raise _explained(error, chunk)
        return ended
    finally:
        for future in under_way:
            future.cancel()


def _explained(error: BaseException, chunk: int) -> ValueError:
    """The failure of a whole chunk as one sentence."""
    if isinstance(error, VersionMismatch):
        return error
    if isinstance(error, ImportError) or "deserialization" in str(error):
        cause = error.__cause__ or error  # Dask wraps the error of a worker without this package.
        return ValueError(
            f"a worker cannot read the study ({str(cause).partition(chr(10))[0]}): install pyarrow and "
            "the same version of rotor-explorer on every worker"
        )
    return ValueError(f"chunk {chunk} failed on its worker ({type(error).__name__}: {error})")
