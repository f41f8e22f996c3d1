"""Power over amplitude and phase of the harmonic: trimmed in the background, drawn for every slider position."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.model.units import number
from explorer.tabs.actuator.actuator_inputs import ActuatorInputs
from rotor.actuator.harmonic import PowerMap, power_map
from rotor.arrays import Array
from rotor.design.design import Design

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


def phase_plot(power: PowerMap, inputs: ActuatorInputs, previous: Range | None) -> Plot:
    """Change of power [kW] over phase [°]: at full amplitude, at this one, and now."""
    phases = np.linspace(0.0, 2.0 * math.pi, _POINTS)
    share, phase = 0.01 * inputs.amplitude, math.radians(inputs.phase)
    largest = float(power.shares[-1])
    now = _single(phases, phase, float(power.change(share, phase)))
    return _plot(np.degrees(phases), [power.change(largest, phases), power.change(share, phases), now], previous)


def amplitude_plot(power: PowerMap, inputs: ActuatorInputs, previous: Range | None) -> Plot:
    """Change of power [kW] over amplitude [%]: best phase, this phase, the limit beyond which more costs, now."""
    shares = np.linspace(0.0, 1.0, _POINTS)
    share, phase = 0.01 * inputs.amplitude, math.radians(inputs.phase)
    shown = np.where(shares <= power.shares[-1] + 1e-9, shares, np.nan)
    limit = power.limit(phase)
    series = [
        power.change(shown, power.best()[1]),
        power.change(shown, phase),
        _single(shares, limit, float(power.change(limit, phase))),
        _single(shares, share, float(power.change(share, phase))),
    ]
    return _plot(100.0 * shares, series, previous)


def _single(x: Array, at: float, value: float) -> Array:
    """One point, at the nearest abscissa."""
    points = np.full(len(x), np.nan)
    points[int(np.abs(x - at).argmin())] = value
    return points


def _plot(x: Array, series: list[Array], previous: Range | None) -> Plot:
    kilowatts = [1e-3 * values for values in series]
    seen = np.concatenate(kilowatts)
    low, high = min(float(np.nanmin(seen)), -0.5), max(float(np.nanmax(seen)), 0.5)
    return Plot((x, *kilowatts), held_range(previous, low, high))


def sweep_sentence(power: PowerMap | str | None, inputs: ActuatorInputs, design: Design) -> str:
    """What the charts say: the least power, and the limit beyond which more twist costs at this phase."""
    if design.hovering:
        return "Off in hover: fly faster."
    if power is None:
        return "Trimming amplitudes and phases…"
    if isinstance(power, str):
        return power
    share, phase, change = power.best()
    limit, most = power.limit(math.radians(inputs.phase)), float(power.shares[-1])
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
