"""What a soak found, as values: delays, lost updates, memory; and whether it passed. Pure."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np
from scipy.stats import theilslopes

GROWTH = 0.015
"""Memory that grew by more than this part of itself after settling, and not by chance, is a leak."""
SETTLING = 0.5
"""The first part of a run that memory is not judged by: caches fill, pages connect, steps to undo are kept."""
_FEWEST = 12
"""Samples of memory without which no slope is claimed."""


@dataclass(frozen=True)
class MemoryUse:
    """Resident memory of the server over the run."""

    start_mb: float
    """Median over the first tenth after settling."""
    end_mb: float
    """Median over the last tenth."""
    slope_mb_per_minute: float
    """Theil–Sen: the median slope of all pairs, which single peaks do not move."""
    slope_low: float
    """Lower end of its 95 % confidence interval."""
    minutes: float
    """Length of what was judged."""

    @property
    def grows(self) -> bool:
        return self.slope_low > 0.0 and self.slope_mb_per_minute * self.minutes > GROWTH * self.start_mb


@dataclass(frozen=True)
class Delays:
    """From an edit leaving the page to the frame that shows it, or a later one [ms]."""

    count: int
    p50: float
    p95: float
    worst: float


@dataclass(frozen=True)
class Visit:
    """What one browser saw."""

    edits: int
    """Moves of a slider."""
    delays_ms: tuple[float, ...]
    """One for each edit that was answered, in order."""
    rounds: int
    """Times it stopped dragging and waited for the last answer."""
    lost: tuple[str, ...]
    """Sentences: last edits whose answer did not come or was not the right one."""
    frames: int
    megabytes: float
    complaints: tuple[str, ...] = ()


@dataclass(frozen=True)
class SoakReport:
    """One soak."""

    browsers: int
    minutes: float
    rate_hz: float
    edits: int
    answered: int
    rounds: int
    lost: tuple[str, ...]
    complaints: tuple[str, ...]
    delays: Delays
    slowest_browser_p95: float
    """p95 of the browser that fared worst [ms]: how fair it was."""
    fastest_browser_p95: float
    frames_per_second: float
    """New blades a browser saw in a second, on average."""
    megabytes_per_second: float
    cpu_percent: float
    """Of one core, by the server."""
    cpu_ms_per_frame: float
    """The same for each frame: what does not depend on how busy the machine is."""
    memory: MemoryUse | None
    """None where there were too few samples."""
    real: Delays | None = None
    """From a key to the frame, in real browsers among the others; None where there were none."""

    @property
    def passed(self) -> bool:
        return not self.lost and not self.complaints and not (self.memory is not None and self.memory.grows)

    def as_json(self) -> dict[str, object]:
        grows = None if self.memory is None else self.memory.grows
        return {**asdict(self), "memory_grows": grows, "passed": self.passed}


def delays(values: Sequence[float]) -> Delays:
    """Percentiles of delays [ms]; zeros where there are none."""
    if not values:
        return Delays(0, 0.0, 0.0, 0.0)
    p50, p95 = np.percentile(values, (50.0, 95.0))
    return Delays(len(values), float(p50), float(p95), max(values))


def memory(samples: Sequence[tuple[float, float]]) -> MemoryUse | None:
    """From (time [s], resident memory [MB]) samples; None for too few of them."""
    if not samples:
        return None
    begin, end = samples[0][0], samples[-1][0]
    settled = [sample for sample in samples if sample[0] >= begin + SETTLING * (end - begin)]
    if len(settled) < _FEWEST:
        return None
    times = np.array([time for time, _ in settled]) / 60.0
    values = np.array([value for _, value in settled])
    slope, _, low, _ = theilslopes(values, times)
    tenth = math.ceil(len(settled) / 10)
    return MemoryUse(
        start_mb=float(np.median(values[:tenth])),
        end_mb=float(np.median(values[-tenth:])),
        slope_mb_per_minute=float(slope),
        slope_low=float(low),
        minutes=float(times[-1] - times[0]),
    )


def judge(
    visits: Sequence[Visit],
    rate_hz: float,
    seconds: float,
    cpu_seconds: float,
    samples: Sequence[tuple[float, float]],
    real: Sequence[Visit] = (),
) -> SoakReport:
    """The report of a run of `seconds`, with the server's processor time and memory samples."""
    everybody = (*visits, *real)
    late = [delays(visit.delays_ms).p95 for visit in visits if visit.delays_ms]
    frames = sum(visit.frames for visit in visits)
    span = max(seconds, 1e-9)
    return SoakReport(
        browsers=len(visits),
        minutes=seconds / 60.0,
        rate_hz=rate_hz,
        edits=sum(visit.edits for visit in visits),
        answered=sum(len(visit.delays_ms) for visit in visits),
        rounds=sum(visit.rounds for visit in visits),
        lost=tuple(line for visit in everybody for line in visit.lost),
        complaints=tuple(line for visit in everybody for line in visit.complaints),
        delays=delays([value for visit in visits for value in visit.delays_ms]),
        slowest_browser_p95=max(late, default=0.0),
        fastest_browser_p95=min(late, default=0.0),
        frames_per_second=frames / span / max(len(visits), 1),
        megabytes_per_second=sum(visit.megabytes for visit in visits) / span,
        cpu_percent=100.0 * cpu_seconds / span,
        cpu_ms_per_frame=1e3 * cpu_seconds / max(frames, 1),
        memory=memory(samples),
        real=delays([value for visit in real for value in visit.delays_ms]) if real else None,
    )


def words(report: SoakReport) -> str:
    """The report for people."""
    d, m = report.delays, report.memory
    lines = [
        f"{report.browsers} browsers, {report.minutes:.1f} min, each dragging at {report.rate_hz:g} Hz",
        f"edits      {report.edits} sent, {report.answered} seen answered, {report.rounds} final answers checked, "
        f"{len(report.lost)} lost",
        f"delay      edit to frame p50 {d.p50:.0f} ms, p95 {d.p95:.0f} ms, worst {d.worst:.0f} ms",
        f"fairness   p95 of the best served browser {report.fastest_browser_p95:.0f} ms, "
        f"of the worst served {report.slowest_browser_p95:.0f} ms",
        f"frames     {report.frames_per_second:.1f} a second and browser, "
        f"{report.megabytes_per_second:.2f} MB/s in all",
        f"processor  {report.cpu_percent:.0f} % of a core, {report.cpu_ms_per_frame:.0f} ms a frame",
        "memory     too few samples for a slope"
        if m is None
        else f"memory     {m.start_mb:.0f} → {m.end_mb:.0f} MB, slope {m.slope_mb_per_minute:+.2f} MB/min "
        f"(at least {m.slope_low:+.2f}) over {m.minutes:.1f} min: {'GROWS' if m.grows else 'flat'}",
    ]
    if report.real is not None:
        r = report.real
        lines.append(
            f"Chromium   {r.count} keys, key to frame p50 {r.p50:.0f} ms, p95 {r.p95:.0f} ms, worst {r.worst:.0f} ms"
        )
    lines += [f"LOST       {line}" for line in report.lost[:10]]
    lines += [f"COMPLAINT  {line}" for line in report.complaints[:10]]
    lines.append("passed" if report.passed else "FAILED")
    return "\n".join(lines)
