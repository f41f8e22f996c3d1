"""A Dask cluster as the executor of a study: its client, and whether anybody is left to compute."""

import logging
import time
from collections.abc import Callable, Generator
from concurrent.futures import BrokenExecutor, Executor
from contextlib import contextmanager
from typing import Any

from rotor.support.user_input import extra_module

_QUERY_INTERVAL = 5.0
"""[s] between the questions how many workers there are."""
_REPLY_TIMEOUT = 10.0
"""[s] until an answer counts as missing."""
_WORKER_TIMEOUT = 300.0
"""[s] a run waits for workers that went, or for its scheduler's answer: both may come back."""


class ExecutorLost(RuntimeError):
    """The executor takes no more work; finished chunks are kept."""

    def __init__(self, reason: object) -> None:
        super().__init__(
            f"the workers are gone ({reason}): finished chunks are kept; run the study again to continue"
        )


@contextmanager
def dask_client(address: str) -> Generator[Any]:
    """A client of the Dask scheduler at `address`. ValueError with one sentence where none answers.

    A scheduler at a tls:// address is reached with the certificates of Dask's own configuration.
    """
    distributed = extra_module("distributed", "a study on a Dask cluster")
    for name in tuple(logging.root.manager.loggerDict):  # Dask sets the level of several of them.
        if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
            # Errors are reported by this package.
            logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = distributed.Client(address, timeout="10s")
    except (OSError, ValueError, TimeoutError) as error:
        raise ValueError(
            f"no Dask scheduler answers at {address!r} ({type(error).__name__}): start one with `dask scheduler`, "
            "and give the tcp://host:port that it prints"
        ) from None
    except TypeError:  # What Dask raises where a tls:// address has no certificates.
        raise ValueError(
            f"{address!r} needs certificates: set distributed.comm.tls in Dask's configuration"
        ) from None
    try:
        yield client
    finally:
        client.close(timeout=5)


class ClusterWatch:
    """Asks a Dask cluster now and then whether workers are left, for Dask waits for new ones without end.

    Other executors say themselves what they lose.
    """

    def __init__(self, executor: Executor, warn: Callable[[str], None]) -> None:
        """`warn` gets a sentence when there are none."""
        dask = type(executor).__module__.partition(".")[0] == "distributed"
        self._client: Any = getattr(executor, "_client", None) if dask else None
        self._warn = warn
        self._asked = time.monotonic()
        self._had = False
        """Whether there were workers; before, the run waits for the first."""
        self._since: float | None = None
        """When they were first missed."""

    def check(self) -> None:
        """Call often while nothing comes. ExecutorLost where nobody has been there for too long."""
        if self._client is None or time.monotonic() - self._asked < _QUERY_INTERVAL:
            return
        missing = self._missing()
        now = self._asked = time.monotonic()
        if not missing:
            self._had, self._since = True, None
        elif self._since is None:
            if self._had or missing != _NO_WORKERS:
                self._since = now
                self._warn(
                    f"{missing}; waiting {_WORKER_TIMEOUT / 60.0:g} min for a change, Ctrl-C ends the run now"
                )
        elif now - self._since > _WORKER_TIMEOUT:
            raise ExecutorLost(missing)

    def chunk_received(self) -> None:
        """A chunk came from a worker."""
        self._had, self._since = True, None

    def _missing(self) -> str:
        try:
            return (
                ""
                if self._client.sync(self._client.scheduler.ncores, callback_timeout=_REPLY_TIMEOUT)
                else _NO_WORKERS
            )
        except (OSError, TimeoutError, RuntimeError, BrokenExecutor):
            return "the scheduler does not answer"


_NO_WORKERS = "no worker is left"
