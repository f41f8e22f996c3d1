"""A soak from end to end: a server of its own, visitors that drag a slider, a watch on its memory, a report.

`wire` speaks the page's protocol, `visitor` is a browser without a screen, `drag` what each of them does.
"""

import asyncio
import math
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import psutil
from scipy.stats import theilslopes

from tests.tools.soak.drag import Dragger, Visit, expected

GROWTH = 0.015
"""Memory that grew by more than this part of itself after settling, and not by chance, is a leak."""
SETTLING = 0.5
"""The first part of a run that memory is not judged by: caches fill, pages connect, steps to undo are kept."""
_FEWEST = 12
"""Samples of memory without which no slope is claimed."""
_END = 10.0
"""[s] a server may take to end."""
_WATCH = 2.0
"""[s] between looks at memory, less in a short run."""
_FIRST = 2.0
"""[s] for each visitor, until its page has all its charts."""
_ARRIVAL = 0.05
"""[s] between one visitor's coming and the next one's."""


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


def soak(browsers: int, minutes: float, rate_hz: float, tell: Callable[[str], None]) -> dict[str, Any]:
    """The report of `judge`; `tell` takes a line now and then. RuntimeError where there is no server."""
    expected()
    with server("--max-sessions", str(browsers)) as (address, pid):
        tell(f"{address}: {browsers} browsers for {minutes:g} min")
        try:
            return asyncio.run(_soak(browsers, minutes, rate_hz, address, psutil.Process(pid), tell))
        except ExceptionGroup as group:
            if group.subgroup(psutil.NoSuchProcess):
                raise RuntimeError("The server ended during the soak: its own messages say why.") from None
            raise group.exceptions[0] from None


async def _soak(
    browsers: int, minutes: float, rate_hz: float, address: str, process: psutil.Process, tell: Callable[[str], None]
) -> dict[str, Any]:
    begin = time.monotonic() + _FIRST * (1 + browsers)
    end = begin + 60.0 * minutes
    samples: list[tuple[float, float]] = []
    async with asyncio.TaskGroup() as group:
        visits: list[asyncio.Task[Visit]] = []
        for k in range(browsers):
            visits.append(group.create_task(Dragger(f"browser {k + 1}", k).run(address, begin, end, rate_hz)))
            await asyncio.sleep(_ARRIVAL)
        await asyncio.sleep(max(begin - time.monotonic(), 0.0))
        before, told = sum(process.cpu_times()[:2]), begin
        while not all(task.done() for task in visits):
            await asyncio.sleep(min(_WATCH, minutes * 60.0 / 40.0))
            samples.append((time.monotonic(), process.memory_info().rss / 1e6))
            if samples[-1][0] - told > 30.0:
                told = samples[-1][0]
                tell(f"{(told - begin) / 60.0:5.1f} min  {samples[-1][1]:.0f} MB")
        seconds, used = time.monotonic() - begin, sum(process.cpu_times()[:2]) - before
    return judge([task.result() for task in visits], rate_hz, seconds, used, samples)


def percentiles(values: Sequence[float]) -> dict[str, float]:
    """Count and percentiles of delays [ms]; zeros where there are none."""
    p50, p95, worst = np.percentile(values, (50.0, 95.0, 100.0)).tolist() if values else (0.0, 0.0, 0.0)
    return {"count": len(values), "p50": p50, "p95": p95, "worst": worst}


def memory(samples: Sequence[tuple[float, float]]) -> dict[str, float] | None:
    """Slope of (time [s], resident memory [MB]) samples after settling; None for too few of them.

    The slope is the median of those of all pairs (Theil–Sen), which single peaks do not move; `slope_low` the lower end
    of its 95 % confidence interval; start and end are medians over the first and the last tenth.
    """
    settled = [(at, size) for at, size in samples if at >= (1.0 - SETTLING) * samples[0][0] + SETTLING * samples[-1][0]]
    if len(settled) < _FEWEST:
        return None
    times, values = np.array(settled).T / np.array([[60.0], [1.0]])
    slope, _, low, _ = theilslopes(values, times)
    tenth = math.ceil(len(values) / 10)
    return {
        "start_mb": float(np.median(values[:tenth])),
        "end_mb": float(np.median(values[-tenth:])),
        "slope_mb_per_minute": float(slope),
        "slope_low": float(low),
        "minutes": float(times[-1] - times[0]),
    }


def grows(use: dict[str, float]) -> bool:
    """Whether memory grew for certain, and by more than `GROWTH`."""
    return use["slope_low"] > 0.0 and use["slope_mb_per_minute"] * use["minutes"] > GROWTH * use["start_mb"]


def judge(
    visits: Sequence[Visit],
    rate_hz: float,
    seconds: float,
    cpu_seconds: float,
    samples: Sequence[tuple[float, float]],
) -> dict[str, Any]:
    """The report of a run of `seconds`, with the server's processor time and memory samples."""
    late = [percentiles(visit.delays_ms)["p95"] for visit in visits if visit.delays_ms]
    lost = [line for visit in visits for line in visit.lost]
    complaints = [line for visit in visits for line in visit.complaints]
    frames, use = sum(visit.frames for visit in visits), memory(samples)
    return {
        "browsers": len(visits),
        "minutes": seconds / 60.0,
        "rate_hz": rate_hz,
        "edits": sum(visit.edits for visit in visits),
        "answered": sum(len(visit.delays_ms) for visit in visits),
        "rounds": sum(visit.rounds for visit in visits),
        "lost": lost,
        "complaints": complaints,
        "delays": percentiles([value for visit in visits for value in visit.delays_ms]),
        "slowest_browser_p95": max(late, default=0.0),
        "fastest_browser_p95": min(late, default=0.0),
        "frames_per_second": frames / seconds / len(visits),
        "megabytes_per_second": sum(visit.megabytes for visit in visits) / seconds,
        "cpu_percent": 100.0 * cpu_seconds / seconds,
        "cpu_ms_per_frame": 1e3 * cpu_seconds / max(frames, 1),
        "memory": use,
        "memory_grows": None if use is None else grows(use),
        "passed": not lost and not complaints and not (use is not None and grows(use)),
    }


def words(report: dict[str, Any]) -> str:
    """The report for people."""
    lines = [
        "{browsers} browsers, {minutes:.1f} min, each dragging at {rate_hz:g} Hz",
        "edits      {edits} sent, {answered} seen answered, {rounds} final answers checked, {count} lost",
        "delay      edit to frame p50 {p50:.0f} ms, p95 {p95:.0f} ms, worst {worst:.0f} ms",
        "fairness   p95 of the best served browser {fastest_browser_p95:.0f} ms, of the worst served "
        "{slowest_browser_p95:.0f} ms",
        "frames     {frames_per_second:.1f} a second and browser, {megabytes_per_second:.2f} MB/s in all",
        "processor  {cpu_percent:.0f} % of a core, {cpu_ms_per_frame:.0f} ms a frame",
        "memory     {start_mb:.0f} → {end_mb:.0f} MB, slope {slope_mb_per_minute:+.2f} MB/min (at least "
        "{slope_low:+.2f}) over {judged:.1f} min: {grown}",
    ]
    found = report["memory"]
    if found is None:
        lines[-1] = "memory     too few samples for a slope"
    else:
        found = {**found, "judged": found["minutes"], "grown": "GROWS" if report["memory_grows"] else "flat"}
    numbers = {**(found or {}), **report["delays"], **report, "count": len(report["lost"])}
    return "\n".join(
        [
            *(line.format_map(numbers) for line in lines),
            *(f"LOST       {line}" for line in report["lost"][:10]),
            *(f"COMPLAINT  {line}" for line in report["complaints"][:10]),
            "passed" if report["passed"] else "FAILED",
        ]
    )
