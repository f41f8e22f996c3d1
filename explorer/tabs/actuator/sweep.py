"""Power over amplitude and phase of the harmonic: trimmed in the background, drawn for every slider position."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.model.units import number
from explorer.tabs.actuator.actuator_inputs import ActuatorInputs
from explorer.workers.job import JobFailed
from explorer.workers.newest_wins import NewestWins
from explorer.workers.pool import PoolClient
from explorer.workers.scheduler import FairScheduler
from rotor.actuator.harmonic import PowerMap, power_map
from rotor.arrays import Array
from rotor.design.design import Design

STILL = 0.3
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""
URGENCY = 3
"""Before verdicts, behind searches."""
_LOOK = 0.05
"""How often a waiting sweep looks around [s]."""
FLAT = 50.0
"""Changes of power below this are called none [W]."""
_POINTS = 73


@dataclass(frozen=True)
class SweepTask:
    """The map of one design and actuator. It pickles."""

    design: Design
    """Without the harmonic; a steady voltage has twisted it already."""
    inputs: ActuatorInputs

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> PowerMap | str:
        """The map, or the sentence that says why there is none."""
        del tell, stop  # It takes a second.
        try:
            made = self.inputs.turning(self.inputs.installed(self.design.rotor), self.design.elastic)
            if made is None or not made.amplitude:
                return f"This actuator cannot respond at {self.inputs.per_rev}/rev."
            return power_map(self.design, made)
        except (ValueError, RuntimeError) as error:
            return str(error)


def sweep_task(inputs: ActuatorInputs, design: Design) -> SweepTask | None:
    """What must be trimmed, whatever amplitude and phase are set; None with the harmonic off and in hover."""
    if not inputs.per_rev or design.hovering:
        return None
    plain = ActuatorInputs()
    steady = replace(inputs, amplitude=0.0, phase=0.0, shown=False, magnified=plain.magnified)
    steady = replace(steady, advance_ratios=plain.advance_ratios)
    return SweepTask(replace(steady.apply(design), active_twist=None), steady)


class SweepWorker:
    """One thread that has the newest map made by a process of the pool."""

    def __init__(self, pool: PoolClient, found: Callable[[], None], name: str) -> None:
        self._pool, self._found = pool, found
        self._wanted: SweepTask | None = None
        # A turn of its own: this thread only waits, and would keep the pages from theirs while it does.
        self._worker = NewestWins(self._round, self._failed, name, scheduler=FairScheduler(1))
        self._known: tuple[SweepTask, PowerMap | str] | None = None

    def start(self) -> None:
        self._worker.start()

    def stop(self) -> None:
        self._worker.stop(timeout=0.0)

    def ask(self, task: SweepTask | None) -> PowerMap | str | None:
        """The answer where it is known; else None, and `found` is called once it is."""
        if self._known is not None and self._known[0] == task:
            return self._known[1]
        if task != self._wanted:
            self._wanted = task
            if task is not None:
                self._worker.wake()
        return None

    def _round(self, superseded: Callable[[], bool]) -> None:
        task, began = self._wanted, time.monotonic()
        if task is None:
            return
        while time.monotonic() - began < STILL:
            if superseded():
                return
            time.sleep(_LOOK)
        end = self._pool.result(task, superseded, URGENCY)
        if end is None:
            return
        made = end.message if isinstance(end, JobFailed) else end.result
        self._known = task, made or "The sweep was stopped: change any setting to try again."
        self._found()

    def _failed(self, error: Exception) -> None:
        if self._wanted is not None:
            self._known = self._wanted, f"The sweep failed ({error}): change any setting to try again."
            self._found()


def phase_plot(found: PowerMap | None, inputs: ActuatorInputs, previous: Range | None) -> Plot:
    """Change of power [kW] over phase [°]: at full amplitude, at this one, and now."""
    phases = np.linspace(0.0, 2.0 * math.pi, _POINTS)
    if found is None:
        return _plot(np.degrees(phases), [np.full(_POINTS, np.nan)] * 3, previous)
    share, phase = 0.01 * inputs.amplitude, math.radians(inputs.phase)
    largest = float(found.shares[-1])
    now = _single(phases, phase, float(found.change(share, phase)))
    return _plot(np.degrees(phases), [found.change(largest, phases), found.change(share, phases), now], previous)


def amplitude_plot(found: PowerMap | None, inputs: ActuatorInputs, previous: Range | None) -> Plot:
    """Change of power [kW] over amplitude [%]: best phase, this phase, the limit beyond which more costs, now."""
    shares = np.linspace(0.0, 1.0, _POINTS)
    if found is None:
        return _plot(100.0 * shares, [np.full(_POINTS, np.nan)] * 4, previous)
    share, phase = 0.01 * inputs.amplitude, math.radians(inputs.phase)
    shown = np.where(shares <= found.shares[-1] + 1e-9, shares, np.nan)
    limit = found.limit(phase)
    series = [
        found.change(shown, found.best()[1]),
        found.change(shown, phase),
        _single(shares, limit, float(found.change(limit, phase))),
        _single(shares, share, float(found.change(share, phase))),
    ]
    return _plot(100.0 * shares, series, previous)


def _single(x: Array, at: float, value: float) -> Array:
    """One point, at the nearest abscissa."""
    points = np.full(len(x), np.nan)
    points[int(np.abs(x - at).argmin())] = value
    return points


def _plot(x: Array, series: list[Array], previous: Range | None) -> Plot:
    kilowatts = [1e-3 * values for values in series]
    seen = np.concatenate([values[np.isfinite(values)] for values in kilowatts])
    low, high = (float(seen.min()), float(seen.max())) if seen.size else (-1.0, 1.0)
    return Plot((x, *kilowatts), held_range(previous, min(low, -0.5), max(high, 0.5)))


def sweep_sentence(found: PowerMap | str | None, inputs: ActuatorInputs, design: Design) -> str:
    """What the charts say: the least power, and the limit beyond which more twist costs at this phase."""
    if design.hovering:
        return "Off in hover: fly faster."
    if found is None:
        return "Trimming amplitudes and phases…"
    if isinstance(found, str):
        return found
    share, phase, change = found.best()
    limit, most = found.limit(math.radians(inputs.phase)), float(found.shares[-1])
    here = "At this phase "
    if limit <= 0.005:
        here += "every amplitude costs power."
    elif limit >= most - 0.005:
        here += f"more twist saves more, up to {number(100.0 * most)} %."
    else:
        here += f"twist beyond {number(100.0 * limit)} % costs power again."
    if change > -FLAT:
        return f"No amplitude saves power at {inputs.per_rev}/rev. {here}"
    least = f"{number(100.0 * share)} % at {number(math.degrees(phase))}°: {number(1e-3 * change, 1, sign=True)} kW"
    return f"Least power: {least}, before the actuator's mass and losses. {here}"
