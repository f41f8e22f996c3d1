"""A search as a race of its starts: the trace of each, who leads by how much, and the design to preview now."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Literal

from explorer.interpolation import blend, eased
from explorer.state import Inputs, with_optimum
from explorer.tabs.optimise.run import SearchRun
from explorer.text.units import SI, Units, number
from rotor.design.design import Design

StartState = Literal["waiting", "running", "finished"]


@dataclass(frozen=True)
class RaceStart:
    """One start of the search."""

    start: int
    """From 1."""
    powers: tuple[float, ...]
    """Power of every design tried [W]."""
    best: tuple[float, ...]
    """The least so far after each of them [W]."""
    state: StartState
    gap: float | None
    """Its best above the best of all starts [W]; None before its first design."""

    @property
    def leads(self) -> bool:
        """Whether the best of all starts is its own."""
        return self.gap == 0.0

    def legend(self, units: Units = SI) -> str:
        """Its line in the legend: `Start 3: leads`, `Start 1: +0.4 kW`, `Start 6: waiting`."""
        if self.gap is None:
            return f"Start {self.start}: {'no trim' if self.state == 'finished' else self.state}"
        return f"Start {self.start}: {'leads' if self.leads else units.watts(self.gap, 1, sign=True)}"


@dataclass(frozen=True)
class Race:
    """All starts of a search at one time."""

    starts: tuple[RaceStart, ...]
    start_power: float | None
    """Of the design the search began from [W]."""
    best_power: float | None
    """The least so far [W]."""
    evaluations: int

    @property
    def leader(self) -> RaceStart | None:
        """The start with the least power; the first of several."""
        return next((one for one in self.starts if one.leads), None)

    @property
    def change(self) -> float | None:
        """The best less the design it began from [W]: negative once the search has saved power."""
        if self.best_power is None or self.start_power is None:
            return None
        return self.best_power - self.start_power

    def headline(self, units: Units = SI) -> str:
        """The large line: `841.2 kW, −9.1 kW vs. starting design`."""
        if self.best_power is None:
            return "Trimming the starting design …"
        change = self.change
        tail = "" if change is None else f", {units.watts(change, 1, sign=True)} vs. starting design"
        return units.watts(self.best_power, 1) + tail

    def axis(self) -> tuple[float, float]:
        """Range of power [W] that shows where the starts end, not the worst designs tried on the way."""
        ends = [one.best[-1] for one in self.starts if one.best]
        if not ends:
            return 0.0, 1.0
        low = min(ends)
        high = max(1.01 * low, self.start_power or 0.0)
        margin = 0.05 * (high - low)
        return low - margin, high + margin

    def above_axis(self) -> int:
        """How many designs tried lie above the axis: to be said beside a chart that clips them."""
        top = self.axis()[1]
        return sum(power > top for one in self.starts for power in one.powers)


def race_of(run: SearchRun) -> Race:
    """Where a search stands. Reads a snapshot: the run may be written meanwhile."""
    traces = [tuple(trace) for trace in run.traces]
    current = run.progress.start if run.progress is not None else -1
    searching = run.under_way and (run.progress is None or run.progress.phase != "band")
    bests = [tuple(accumulate(trace, min)) for trace in traces]
    least = min((best[-1] for best in bests if best), default=None)
    starts: list[RaceStart] = []
    for k, (trace, best) in enumerate(zip(traces, bests, strict=True)):
        state: StartState = "finished" if k < current or not searching else "running" if k == current else "waiting"
        gap = best[-1] - least if best and least is not None else None
        starts.append(RaceStart(k + 1, trace, best, state, gap))
    tried = run.optimum.evaluations if run.optimum is not None else run.progress.evaluation if run.progress else 0
    return Race(tuple(starts), run.start_power, least, tried)


def inputs_at(inputs: Inputs, preview: Design) -> Inputs:
    """The slider positions that mean the previewed blade in the present flight, so that the sliders follow it."""
    return with_optimum(inputs, preview)


def counting(before: float, after: float, part: float, digits: int = 1) -> str:
    """The large number while it runs from one power to the next [kW or any unit], `part` 0…1."""
    return number(blend(before, after, eased(part)), digits)


def falling_power(powers: Sequence[float], position: float) -> float:
    """Power of a replay between its frames: `position` counts frames from 0 and may lie between two.

    Infinite powers, of a start without trim, are passed over: the next known power stands from the beginning.
    """
    known = [power for power in powers if math.isfinite(power)]
    if not known:
        raise ValueError("a replay needs at least one design with a power")
    filled = list(powers)
    for k in range(len(filled) - 1, -1, -1):
        if not math.isfinite(filled[k]):
            filled[k] = filled[k + 1] if k + 1 < len(filled) else known[-1]
    place = min(max(position, 0.0), len(filled) - 1.0)
    lower = min(int(place), len(filled) - 1)
    upper = min(lower + 1, len(filled) - 1)
    return blend(filled[lower], filled[upper], place - lower)
