"""A soak from end to end: a server of its own, visitors, a watch on its memory, a report."""

import asyncio
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import psutil

from tests.tools.soak.drag import Dragger, expected
from tests.tools.soak.figures import SoakReport, judge
from tests.tools.soak.real import visit

_END = 10.0
"""[s] a server may take to end."""
_WATCH = 2.0
"""[s] between looks at memory, less in a short run."""
_FIRST = 2.0
"""[s] for each visitor, until its page has all its charts."""
_ARRIVAL = 0.05
"""[s] between one visitor's coming and the next one's."""


@dataclass(frozen=True)
class Soak:
    """How many, how long, how fast."""

    browsers: int = 20
    minutes: float = 10.0
    rate: float = 20.0
    """Edits a second while a slider is held: the page sends no more."""
    real: int = 0
    """Chromium pages among them, besides the others."""


@contextmanager
def server(*options: str) -> Iterator[tuple[str, int]]:
    """A server in a process of its own: its address and process id. RuntimeError if it does not start."""
    command = [sys.executable, "-m", "explorer", "--port", "0", "--no-browser", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            for line in process.stdout:
                if found := re.search(r"http://\S+", line):
                    yield found[0], process.pid
                    return
            raise RuntimeError(f"The server ended with exit code {process.wait()} before it printed an address.")
        finally:
            process.terminate()
            try:
                process.wait(_END)
            except subprocess.TimeoutExpired:
                process.kill()


def soak(plan: Soak, tell: Callable[[str], None] = lambda line: None) -> SoakReport:
    """Run it; `tell` takes a line now and then. RuntimeError where there is no server, or no browser to be had."""
    expected()
    with server("--max-sessions", str(plan.browsers + plan.real)) as (address, pid):
        try:
            return asyncio.run(_soak(plan, address, pid, tell))
        except ExceptionGroup as group:
            if group.subgroup(psutil.NoSuchProcess):
                raise RuntimeError("The server ended during the soak: its own messages say why.") from None
            raise group.exceptions[0] from None


async def _soak(plan: Soak, address: str, pid: int, tell: Callable[[str], None]) -> SoakReport:
    begin = time.monotonic() + _FIRST * (1 + plan.browsers) + 5.0 * plan.real
    end = begin + 60.0 * plan.minutes
    tell(f"{address}: {plan.browsers} browsers for {plan.minutes:g} min")
    samples: list[tuple[float, float]] = []
    async with asyncio.TaskGroup() as group:
        visits = []
        pages = group.create_task(visit(address, plan.real, begin, end)) if plan.real else None
        for k in range(plan.browsers):
            visits.append(group.create_task(Dragger(f"browser {k + 1}", k).run(address, begin, end, plan.rate)))
            await asyncio.sleep(_ARRIVAL)
        await asyncio.sleep(max(begin - time.monotonic(), 0.0))
        server = psutil.Process(pid)
        before, told = sum(server.cpu_times()[:2]), begin
        every = min(_WATCH, plan.minutes * 60.0 / 40.0)
        while not all(task.done() for task in visits):
            await asyncio.sleep(every)
            samples.append((time.monotonic(), server.memory_info().rss / 1e6))
            if samples[-1][0] - told > 30.0:
                told = samples[-1][0]
                tell(f"{(told - begin) / 60.0:5.1f} min  {samples[-1][1]:.0f} MB")
        seconds, used = time.monotonic() - begin, sum(server.cpu_times()[:2]) - before
    real = pages.result() if pages else []
    return judge([task.result() for task in visits], plan.rate, seconds, used, samples, real)
