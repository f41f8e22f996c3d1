"""A schedule as charts, words and CSV: twist per speed, what it saves, and what moving is worth."""

import csv
import io
import math
from dataclasses import dataclass, field

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.text.units import SI, Units, number
from rotor.optimisation.schedule import Cell, Plan, Schedule
from rotor.optimisation.search import Optimum

LEGS = 6
"""Rows of the mission table, so traces of the twist chart."""
_COLUMNS = ("mu", "mass_kg", "altitude_m", "hours", "as_it_is_kw", "best_kw", "saving_percent", "fixed_kw", "twist")


@dataclass
class PlanProgress:
    """What is known of a plan with one concept."""

    plan: Plan
    cells: list[Cell] = field(default_factory=list)
    fixed_powers: tuple[float | None, ...] = ()

    @property
    def schedule(self) -> Schedule:
        return Schedule(self.plan, tuple(self.cells))

    def at(self, leg: int | None) -> Optimum | None:
        """The optimum at a leg; None: the fixed blade."""
        return self.schedule.at(leg, self.plan.concepts[0].name)

    def fixed_power(self, leg: int) -> float | None:
        return self.fixed_powers[leg] if leg < len(self.fixed_powers) else None

    @property
    def part_done(self) -> float:
        """0…1"""
        return len(self.cells) / (len(self.plan.conditions) + 1)


def twist_plot(progress: PlanProgress | None, previous: Range | None) -> Plot:
    """Series: LEGS best twists and the best fixed one [°]; one that is not known lies outside the axis."""
    r = np.linspace(0.13, 1.0, 80)
    optima = (
        [] if progress is None else [*(progress.at(k) for k in range(len(progress.plan.conditions))), progress.at(None)]
    )
    known = [np.degrees(one.design.twist(r)) for one in optima if one is not None and one.best is not None]
    y_range = (
        held_range(previous, min(map(np.min, known)), max(map(np.max, known))) if known else previous or (-1.0, 1.0)
    )
    lines = [np.full(len(r), 1e3) for _ in range(LEGS + 1)]
    for k, one in enumerate(optima):
        if one is not None and one.best is not None:
            lines[LEGS if k == len(optima) - 1 else k] = np.degrees(one.design.twist(r))
    return Plot((r, *lines), y_range)


def saving_plot(progress: PlanProgress | None, previous: Range | None) -> Plot:
    """Series: no saving, best fixed blade, best twist per leg [% of the blade as it is] over µ; legs that are known."""
    legs = [] if progress is None else [(leg, *_saving(progress, k)) for k, leg in enumerate(progress.plan.conditions)]
    points = sorted((leg.flight.advance_ratio, *saved) for leg, *saved in legs if math.isfinite(saved[0]))
    mu, moving, fixed = np.array(points or [(0.0, math.nan, math.nan), (0.4, math.nan, math.nan)]).T
    known = np.concatenate((fixed, moving))
    known = known[np.isfinite(known)]
    y_range = previous or (0.0, 1.0)
    if len(known):
        y_range = held_range(previous, min(0.0, float(known.min())), max(0.1, float(known.max())))
    outside = 10.0 * y_range[1] + 10.0
    lines = (np.where(np.isfinite(values), values, outside) for values in (fixed, moving))
    return Plot((mu, np.zeros(len(mu)), *lines), y_range)


def _saving(progress: PlanProgress, leg: int) -> tuple[float, float]:
    """Of the best twist of a leg and of the best fixed blade there [%]; NaN when not known."""
    one, fixed = progress.at(leg), progress.fixed_power(leg)
    if one is None or one.saving is None or one.baseline_power is None:
        return math.nan, math.nan
    return 100.0 * one.saving, math.nan if fixed is None else 100.0 * (1.0 - fixed / one.baseline_power)


def table(progress: PlanProgress, units: Units = SI) -> str:
    """HTML: one row a leg, then what moving is worth."""
    rows = []
    for k, leg in enumerate(progress.plan.conditions):
        one = progress.at(k)
        moving, fixed = _saving(progress, k)
        baseline = None if one is None or one.baseline_power is None else units.power[0].of(one.baseline_power)
        rows.append(
            f"<tr><td>{number(leg.flight.advance_ratio, 2) if leg.flight.advance_ratio else 'hover'}</td>"
            f'<td class="rx-num">{number(baseline)}</td><td class="rx-num">{number(fixed, 2)}</td>'
            f'<td class="rx-num">{number(moving, 2)}</td></tr>'
        )
    heading = (
        f'<tr class="rx-dim rx-small"><td>µ</td><td class="rx-num">current [{units.power[0].symbol}]</td>'
        '<td class="rx-num">fixed [%]</td><td class="rx-num">variable [%]</td></tr>'
    )
    body = f"{verdict(progress, units)}<table>{heading}{''.join(rows)}</table>"
    return f'<div class="rx rx-found" data-explorer="schedule">{body}</div>'


def verdict(progress: PlanProgress, units: Units = SI) -> str:
    """What the best fixed blade saves, and what moving is worth beyond it."""
    worth = progress.schedule.worth(progress.plan.concepts[0].name)
    if worth is None:
        return ""
    saved = worth.baseline - worth.fixed
    return (
        f'<table><tr><td>Best fixed blade saves</td><td class="rx-num">{units.watts(saved, 1)}</td>'
        f'<td class="rx-num" style="width:26%">{number(100.0 * saved / worth.baseline, 2)} %</td></tr>'
        "<tr><td><b>Additional saving from variable twist</b></td>"
        f'<td class="rx-num"><b>{units.watts(worth.gain, 1)}</b></td>'
        f'<td class="rx-num"><b>{number(100.0 * worth.share, 2)} %</b></td></tr></table>'
    )


def csv_of(progress: PlanProgress) -> bytes:
    """The schedule as a CSV file; what is not known is blank."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(_COLUMNS)
    for k, leg in enumerate(progress.plan.conditions):
        one, c = progress.at(k), leg.flight
        best = None if one is None else one.best
        writer.writerow(
            (
                f"{c.advance_ratio:g}",
                f"{c.mass:g}",
                f"{c.altitude:g}",
                f"{leg.hours:g}",
                _kilowatt(None if one is None else one.baseline_power),
                _kilowatt(None if best is None else best.power),
                "" if one is None or one.saving is None else f"{100.0 * one.saving:.3f}",
                _kilowatt(progress.fixed_power(k)),
                "" if best is None else best.twist,
            )
        )
    fixed = progress.at(None)
    if fixed is not None and fixed.best is not None:
        hours = sum(leg.hours for leg in progress.plan.conditions)
        mean = (_kilowatt(fixed.baseline_power), "", "", _kilowatt(fixed.best.power))
        writer.writerow(("mean", "", "", f"{hours:g}", *mean, fixed.best.twist))
    return text.getvalue().encode()


def _kilowatt(watts: float | None) -> str:
    return "" if watts is None else f"{watts / 1e3:.3f}"
