"""Chart data of a search: power against evaluation, every start its own trace. Finite throughout."""

import math

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.tabs.optimise.run import SearchRun
from explorer.text.units import KILOWATT, Unit

TRACES = 16
"""Traces of the chart, and the most starts of a search on the page."""
_SHORTEST = 24


def search_plot(run: SearchRun | None, previous: Range | None, unit: Unit = KILOWATT) -> Plot:
    """Series: the design it began from, TRACES starts, the best start again; over the start's own evaluations.

    A start that has ended goes on level; one that has not begun lies outside the axis.
    """
    traces = [list(trace) for trace in run.traces[:TRACES]] if run is not None else []
    length = _round_up(max([_SHORTEST, *(len(trace) for trace in traces)]))
    x = np.arange(1.0, length + 1.0)
    begun = [np.array(trace) / unit.size for trace in traces if trace]
    start = unit.of(run.start_power) if run is not None and run.start_power is not None else None
    if begun:
        least = min(float(trace.min()) for trace in begun)
        # Ranged on where the starts end and on what they improve, not on the worst design that was tried.
        top = max(start or 0.0, least * 1.01)
        y_range = held_range(previous, least - 0.05 * (top - least), top)
    else:
        least, y_range = math.inf, previous or (0.0, 1.0)
    outside = y_range[1] + 10.0 * (y_range[1] - y_range[0])
    lines = [np.full(length, outside) for _ in range(TRACES)]
    best = np.full(length, outside)
    for k, trace in enumerate(traces):
        if trace:
            values = np.array(trace) / unit.size
            lines[k] = np.minimum(np.concatenate((values, np.full(length - len(values), values.min()))), outside)
            if values.min() == least:
                best = np.minimum.accumulate(lines[k])
    level = np.full(length, outside if start is None else start)
    return Plot((x, level, *lines, best), y_range, (1.0, float(length)))


def _round_up(length: int) -> int:
    size = _SHORTEST
    while size < length:
        size = int(1.5 * size)
    return size
