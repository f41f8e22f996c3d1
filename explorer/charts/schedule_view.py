"""A schedule as charts, words and CSV."""

import math
from dataclasses import dataclass, field

import numpy as np

from explorer.charts.plots import Range, held_range
from explorer.colours import NOW, THIS, colour_map, css
from explorer.model.units import SI, Units, number
from explorer.text.readout import banded, change_kind
from explorer.workers.background import WorkRecord
from explorer.workers.solver import FixedBlade
from rotor import Optimum
from rotor.design.aircraft import reported_names
from rotor.optimisation import Schedule, ScheduleOptimum, SchedulePlan
from rotor.support.chart import Axis, Chart, Line, Points
from rotor.support.markup import Content, Markup, tag
from rotor.support.user_input import csv_text
from rotor.trim.doubt import Doubt, rounded_pair

_COLUMNS = (
    "hours", "as_it_is_kw", "best_kw", "saving_percent", "saving_doubt_percent", "sureness", "fixed_kw",
    "fixed_doubt_percent", "fixed_sureness", "twist",
)  # fmt: skip


@dataclass(frozen=True)
class ScheduleProgress:
    """The optima of one concept of a plan that are known so far."""

    plan: SchedulePlan
    cells: tuple[ScheduleOptimum, ...] = ()
    fixed: FixedBlade = field(default_factory=FixedBlade)

    @staticmethod
    def of(record: WorkRecord) -> "ScheduleProgress":
        reports = record.reports
        cells = tuple(one for one in reports if isinstance(one, ScheduleOptimum))
        fixed = next((one for one in reports if isinstance(one, FixedBlade)), FixedBlade())
        return ScheduleProgress(record.task.plan, cells, fixed)

    @property
    def schedule(self) -> Schedule:
        return Schedule(self.plan, self.cells)

    def at(self, leg: int | None) -> Optimum | None:
        """The optimum at a leg; None: the fixed blade."""
        return self.schedule.at(leg, self.plan.concepts[0].name)

    def doubts(self, leg: int) -> tuple[Doubt | None, Doubt | None]:
        """Power and saving on a leg of the best fixed blade, and of the leg's best twist; None while not known."""
        optimum, fixed = self.at(leg), self.fixed.doubts
        return fixed[leg] if leg < len(fixed) else None, optimum and optimum.doubt

    @property
    def count(self) -> str:
        """How many optima are known, of how many."""
        return f"{len(self.cells)} of {len(self.plan.conditions) + 1} optima"

    @property
    def part_done(self) -> float:
        """Finished part of the plan, 0…1."""
        return len(self.cells) / (len(self.plan.conditions) + 1)


def twist_chart(progress: ScheduleProgress, previous: Range | None) -> Chart | None:
    """The best twist [°] of each leg, pale in hover to dark in fast flight, and the best fixed one, as far as known."""
    r, legs = np.linspace(0.13, 1.0, 80), len(progress.plan.conditions)
    # The ends of the map are not seen on every background.
    shades = colour_map("sequential", legs + 3)[2:]
    lines: list[Line] = []
    for k, leg in enumerate((*range(legs), None)):
        optimum = progress.at(leg)
        if optimum is not None and optimum.best is not None:
            twist = np.degrees(optimum.design.twist(r))
            name = "hover" if k == 0 else "fast" if k == legs - 1 else ""
            fixed = Line("fixed", r, twist, NOW, "5 3")
            lines.append(fixed if leg is None else Line(name, r, twist, css(shades[k]), width=1.5))
    if not lines:
        return None
    seen = [value for line in lines for value in line.y]
    return Chart(
        "Best twist",
        Axis("r/R", (0.1, 1.02)),
        Axis("°", held_range(previous, min(seen), max(seen))),
        tuple(lines),
    )


def saving_chart(progress: ScheduleProgress, previous: Range | None) -> Chart | None:
    """Saving of the best fixed blade and of the best twist per leg [% of the blade as it is]; legs that are known."""
    legs = [
        (
            leg.flight.advance_ratio,
            *(value for band in progress.doubts(k) for value in _saving(band)),
        )
        for k, leg in enumerate(progress.plan.conditions)
    ]
    mu, fixed, fixed_band, moving, band = (
        np.array(sorted(leg for leg in legs if math.isfinite(leg[3]))).reshape(-1, 5).T
    )
    if not len(mu):
        return None
    seen = [
        0.0,
        *np.nan_to_num([fixed - fixed_band, fixed + fixed_band, moving - band, moving + band])
        .ravel()
        .tolist(),
    ]
    lines = (
        Points("", mu, moving, THIS, size=2.5, scatter=band),
        Points("", mu, fixed, NOW, size=2.5, scatter=fixed_band),
        Line("fixed", mu, fixed, NOW, "5 3", 1.8),
        Line("variable", mu, moving, THIS),
    )
    y_axis = Axis("%", held_range(previous, min(seen), max(0.1, *seen)))
    return Chart("Saving", Axis("µ", (-0.012, 0.462)), y_axis, lines)


def _saving(band: Doubt | None) -> tuple[float, float]:
    """A saving and its band [%]; NaN when not known."""
    within = None if band is None else band.change_band_percent
    if band is None or within is None or not band.against:
        return math.nan, math.nan
    return 100.0 * (1.0 - band.power / band.against), within


def table(progress: ScheduleProgress, units: Units = SI) -> Markup:
    """One row a leg, then the gain of moving."""
    heads = (f"current [{units.power[0].symbol}]", "fixed saves [%]", "variable saves [%]")
    rows = [tag("tr.rx-dim.rx-small", tag("td", "µ"), [tag("td.rx-num", head) for head in heads])]
    for k, leg in enumerate(progress.plan.conditions):
        optimum, mu = progress.at(k), leg.flight.advance_ratio
        power = None if optimum is None else optimum.baseline_power
        baseline = None if power is None else units.power[0].of(power)
        cells = (number(baseline), *map(_percent, progress.doubts(k)))
        rows.append(
            tag(
                "tr",
                tag("td", number(mu, 2) if mu else "hover"),
                [tag("td.rx-num", cell) for cell in cells],
            )
        )
    return tag(
        "div.rx.rx-found", verdict(progress, units), tag("table", rows), data_explorer="schedule"
    )


def _percent(band: Doubt | None) -> Content:
    """A saving of a leg [%], with its band and its word, which alone gives it a colour."""
    (saved, within), word = _saving(band), band and band.sureness
    if not word:
        return number(saved, 2)
    pair = rounded_pair(saved, within)
    kind = change_kind(-saved, word)
    words = (
        f"{number(pair.change, pair.decimals)} ± {number(pair.band, pair.decimals)}",
        tag("br"),
        tag("span.rx-small", word),
    )
    return tag("span", words, class_=kind and f"rx-{kind}")


def verdict(progress: ScheduleProgress, units: Units = SI) -> Markup:
    """What the best fixed blade saves, and the gain of moving beyond it."""
    gain = progress.schedule.in_flight_gain(progress.plan.concepts[0].name)
    if gain is None:
        return Markup()
    fixed = progress.at(None)
    rows = (
        ("Best fixed blade", gain.baseline - gain.fixed, fixed and fixed.doubt),
        ("Variable twist, beyond that", gain.gain, progress.fixed.gain),
    )
    cells = (
        tag("tr", tag("td", name), tag("td.rx-num", _saved(saved, band, units)))
        for name, saved, band in rows
    )
    return tag("table", cells)


def _saved(power: float, band: Doubt | None, units: Units) -> str:
    """A saving [W]; with its band once that is known."""
    if band is None or band.change_band is None:
        return units.watts(power, 1)
    return banded(power, band.change_band, units)


def csv_of(progress: ScheduleProgress) -> bytes:
    """The schedule as a CSV file; what is not known is blank."""
    names = reported_names(leg.flight.unusual for leg in progress.plan.conditions)
    rows: list[tuple[str, ...]] = [(*names, *_COLUMNS)]
    for k, leg in enumerate(progress.plan.conditions):
        optimum, (still, moving) = progress.at(k), progress.doubts(k)
        best = None if optimum is None else optimum.best
        rows.append(
            (
                *(f"{leg.flight.numbers[name]:g}" for name in names),
                f"{leg.hours:g}",
                _kilowatt(None if optimum is None else optimum.baseline_power),
                _kilowatt(None if best is None else best.power),
                ""
                if optimum is None or optimum.saving is None
                else f"{100.0 * optimum.saving:.3f}",
                *_banded_cells(moving),
                _kilowatt(still and still.power),
                *_banded_cells(still),
                "" if best is None else best.twist,
            )
        )
    fixed = progress.at(None)
    if fixed is not None and fixed.best is not None:
        hours = sum(leg.hours for leg in progress.plan.conditions)
        mean = (
            _kilowatt(fixed.baseline_power),
            *5 * ("",),
            _kilowatt(fixed.best.power),
            *_banded_cells(fixed.doubt),
        )
        rows.append(("mean", *("" for _ in names[1:]), f"{hours:g}", *mean, fixed.best.twist))
    return csv_text(rows).encode()


def _banded_cells(band: Doubt | None) -> tuple[str, str]:
    _, within = _saving(band)
    return f"{within:.3f}" if math.isfinite(within) else "", (band and band.sureness) or ""


def _kilowatt(watts: float | None) -> str:
    return "" if watts is None else f"{watts / 1e3:.3f}"
