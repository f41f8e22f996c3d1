"""The four charts of the results strip as plain values: power change over µ, α, lift, and where to twist.

Each chart compares this design with its reference. Gaps are NaN in the arrays and None in `as_dict`.
"""

import math
from dataclasses import asdict, dataclass, fields
from functools import cached_property
from typing import Any, Literal

import numpy as np

from explorer.charts.plots import SWEEP, PowerCurve, Range, angles_along, held_range
from explorer.model.units import KILOWATT, SI, Units, number
from rotor import Aircraft, Solution
from rotor.arrays import Array
from rotor.chart import round_ticks
from rotor.trim import PitchGradient

Role = Literal["this", "reference", "limit", "saving", "earlier", "flown"]
"""What a line stands for; the page chooses its colour.
`earlier`: of the design before this one; `flown`: with elastic twist."""

_SHOWN_QUANTILE = 0.93
"""Share of the stations whose sensitivity fits the axis: the tip's spike would flatten all others."""


@dataclass(frozen=True, eq=False)
class StripLine:
    x: Array
    y: Array
    role: Role
    filled: bool = False
    """Whether the area down to zero is tinted."""


@dataclass(frozen=True)
class StripDot:
    x: float
    y: float
    label: str
    """`hover`, or empty for the present condition."""


@dataclass(frozen=True)
class StripMark:
    """One measured point with its scatter."""

    x: float
    y: float
    error: float
    """Scatter of y, up and down."""
    words: str
    """Measured value, ours and the error."""
    case: str = ""
    """Name of the flight that a press sets; empty: it cannot be pressed."""
    elsewhere: bool = False
    """Whether it was flown with another mass or at another altitude than the lines of the chart."""


@dataclass(frozen=True, eq=False)
class StripBand:
    x: Array
    low: Array
    high: Array


@dataclass(frozen=True)
class StripGap:
    """Where a chart has no lines, and why."""

    low: float
    high: float
    words: str


@dataclass(frozen=True, eq=False)
class StripChart:
    title: str
    unit: str
    """Unit and what is compared, beside the title."""
    x_range: Range
    y_range: Range
    lines: tuple[StripLine, ...]
    dots: tuple[StripDot, ...] = ()
    marks: tuple[StripMark, ...] = ()
    band: StripBand | None = None
    value: str = ""
    """The number to remember, in the corner."""
    note: str = ""
    """One sentence: what the chart says, or what lies outside it."""
    x_name: str = "r/R"
    """What the horizontal axis is."""
    gap: StripGap | None = None

    def _seen(self, line: StripLine) -> bool:
        """Whether most of a line lies within the axis: a limit of which only small parts do is left out."""
        low, high = self.y_range
        return bool(np.mean((line.y >= low) & (line.y <= high)) > 0.5)

    @cached_property
    def as_dict(self) -> dict[str, Any]:
        """The chart as JSON can hold it, rounded to what a pixel shows."""
        digits = max(0, 4 - math.floor(math.log10(self.y_range[1] - self.y_range[0])))
        y_digits = {"y": digits, "low": digits, "high": digits, "error": digits + 1, "x": 5}

        def plain(part: Any) -> dict[str, Any]:
            """The fields of a part of the chart, numbers rounded."""
            values = {one.name: getattr(part, one.name) for one in fields(part)}
            return {name: _plain(own, y_digits[name]) if name in y_digits else own for name, own in values.items()}

        band = self.band
        if band is not None:
            known = np.isfinite(band.low) & np.isfinite(band.high)
            band = StripBand(band.x[known], band.low[known], band.high[known])
        return {
            **{name: getattr(self, name) for name in ("title", "unit", "x_name", "value", "note")},
            "x_range": list(self.x_range),
            "y_range": list(self.y_range),
            "x_ticks": round_ticks(*self.x_range, 5),
            "y_ticks": round_ticks(*self.y_range, 4),
            "lines": [plain(line) for line in self.lines if line.role != "limit" or self._seen(line)],
            "dots": [plain(dot) for dot in self.dots if math.isfinite(dot.y)],
            "marks": [plain(mark) for mark in self.marks],
            "band": None if band is None else plain(band),
            **({} if self.gap is None else {"gap": asdict(self.gap)}),
        }


def power_change_chart(
    curve: PowerCurve, mu: float, change: float | None, reference: str, units: Units = SI, previous: Range | None = None
) -> StripChart:
    """Change of total power against the reference over µ; hover and the present condition are dots.

    `curve`: in kW over `SWEEP`. `change`: at the present condition [W], None without trim. `reference`: its name.
    """
    unit = units.power[0]
    apart = (curve.design - curve.reference) * (KILOWATT.size / unit.size)
    mus = np.array(SWEEP)
    now = math.nan if change is None else unit.of(change)
    seen = [value for value in (*apart[mus <= max(0.4, mu)], now, 0.0) if math.isfinite(value)]
    return StripChart(
        title="Power over µ",
        unit=f"{unit.symbol} vs. {reference}",
        x_range=(0.0, SWEEP[-1]),
        y_range=held_range(previous, min(-2.0, *seen), max(2.0, *seen)),
        lines=(StripLine(mus, apart, "saving" if curve.current else "earlier", filled=curve.current),),
        dots=(*([StripDot(0.0, float(apart[0]), "hover")] if curve.current else []), StripDot(mu, now, "")),
        value="" if change is None else f"{number(now, 1 if abs(now) < 9.95 else 0, sign=True)} {unit.symbol}",
        note=autorotation_words(curve),
        x_name="µ",
    )


def autorotation_words(curve: PowerCurve) -> str:
    """Where the air drives the rotor in descent, and where no speed has an answer; empty in level flight and climb."""
    mus, driven, known = np.array(SWEEP), curve.design < 0.0, np.isfinite(curve.design)
    if not curve.current or not driven.any():
        return ""
    words = f"Autorotation between µ {mus[driven][0]:g} and {mus[driven][-1]:g}: the air drives the rotor."
    return words if known[0] else f"{words} No answer below µ {mus[known][0]:g}: vortex ring state."


def total_power_chart(
    curve: PowerCurve,
    mu: float,
    total: float | None,
    units: Units = SI,
    held: Range | None = None,
    marks: tuple[StripMark, ...] = (),
    aircraft: Aircraft | None = None,
) -> StripChart:
    """Total power over µ of a design that is its own reference; hover and the present condition are dots.

    `curve`: in kW over `SWEEP`. `total`: at the present condition [W], None without trim. `held`: the axis before.
    `marks`: main-rotor power measured in flight; then there is a line of ours too. `aircraft`: draws the power of its
    engines, where its file has it.
    """
    unit = units.power[0]
    here = curve.in_unit(unit)
    power = here.design
    mus, now = np.array(SWEEP), math.nan if total is None else unit.of(total)
    fastest = max([mark.x for mark in marks], default=0.4)  # Flights are slow, and their points low, beside 0.4.
    values = (*power[mus <= max(fastest + 0.03, mu)], now, *(mark.y for mark in marks))
    seen = [value for value in values if math.isfinite(value)]
    least = int(np.nanargmin(np.where(mus > 0.0, power, math.inf)))
    known = curve.current and math.isfinite(power[least])
    role: Role = "saving" if curve.current else "earlier"
    driven = StripLine(mus, np.where(power < 0.0, power, np.nan), role, filled=True)
    value = "autorotation" if now < 0.0 else f"least near µ {mus[least]:.2f}" if known else ""
    note, engines = autorotation_words(curve), []
    if aircraft is not None and aircraft.installed_power is not None:
        installed = unit.of(aircraft.installed_power)
        engines = [StripLine(mus, np.full(len(mus), installed), "limit")]
        top = top_speed(mus, power, installed) if curve.current else math.nan
        note += f" Engines: {number(installed)} {unit.symbol} at sea level, less at altitude; losses of gearboxes and"
        note += " what the gearbox allows are not counted, so the top speed is an upper bound."
        if math.isfinite(top) and value and now >= 0.0:
            value = f"least µ {mus[least]:.2f} · top ≤ {units.speed[0].text(top * aircraft.rotor.tip_speed)}"
    shaft = [] if here.main_rotor is None or not marks else [StripLine(mus, here.main_rotor, "reference")]
    return StripChart(
        title="Power over µ",
        unit=f"{unit.symbol}; dashed: rotor" if shaft else unit.symbol,
        x_range=(0.0, SWEEP[-1]),
        y_range=held_range(held, min(0.0, *seen) if seen else 0.0, max(seen, default=math.nan)),
        lines=(*engines, *shaft, StripLine(mus, power, role), *([driven] if (power < 0.0).any() else [])),
        dots=(*([StripDot(0.0, float(power[0]), "hover")] if curve.current else []), StripDot(mu, now, "")),
        marks=marks,
        band=None if here.band is None else StripBand(mus, here.band[0], here.band[1]),
        value=value,
        note=note.strip(),
        x_name="µ",
    )


def top_speed(mus: Array, power: Array, installed: float) -> float:
    """The advance ratio beyond which power stays above what is installed; NaN where the curve does not reach it.

    `power` (points,), in the unit of `installed`; NaN where there is no trim.
    """
    known = np.isfinite(power)
    x, above = mus[known], power[known] - installed
    below = np.flatnonzero(above <= 0.0)
    if not len(below) or below[-1] == len(x) - 1:
        return math.nan
    k = below[-1]
    return float(x[k] + (x[k + 1] - x[k]) * above[k] / (above[k] - above[k + 1]))


def alpha_chart(
    solution: Solution, reference: Solution | None, azimuth_deg: float, previous: Range | None = None
) -> StripChart:
    """α along the reference blade with the stall limits, and the least margin before stall; gaps in reverse flow."""
    lower, upper, alpha = angles_along(solution, azimuth_deg)
    r = solution.disk.r
    lines = [StripLine(r, lower, "limit"), StripLine(r, upper, "limit")]
    seen = [alpha]
    if reference is not None and reference.converged:
        other = angles_along(reference, azimuth_deg)[2]
        lines.append(StripLine(reference.disk.r, other, "reference"))
        seen.append(other)
    lines.append(StripLine(r, alpha, "this"))
    finite = np.concatenate(seen)
    finite = np.clip(finite[np.isfinite(finite)], -15.0, 20.0)
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    value, note = _margin(r, np.minimum(upper - alpha, alpha - lower))
    return StripChart(
        title="Angle of attack",
        unit=f"° at ψ {azimuth_deg:.0f}°",
        x_range=(0.1, 1.0),
        y_range=held_range(previous, min(low, -2.0), max(high, 14.0)),
        lines=tuple(lines),
        value=value,
        note=note,
    )


def lift_chart(solution: Solution, reference: Solution | None, previous: Range | None = None) -> StripChart:
    """Lift of one blade per metre of span, mean of a revolution [kN/m]."""
    lines = [StripLine(solution.disk.r, lift_per_metre(solution) / 1e3, "this")]
    if reference is not None and reference.converged:
        lines.insert(0, StripLine(reference.disk.r, lift_per_metre(reference) / 1e3, "reference"))
    low, high = (float(end([end(line.y) for line in lines])) for end in (np.min, np.max))
    peak = float(solution.disk.r[np.argmax(lines[-1].y)])
    return StripChart(
        title="Lift",
        unit="kN/m per blade",
        x_range=(0.1, 1.0),
        y_range=held_range(previous, min(0.0, low), high),
        lines=tuple(lines),
        value=f"peak at {peak:.2f} R",
        note="Mean over azimuth.",
    )


def lift_per_metre(solution: Solution) -> Array:
    """Thrust of one blade per metre of span, mean of a revolution [N/m], (elements,)."""
    design = solution.design
    per_blade = design.thrust_unit / (design.rotor.blades * design.rotor.radius)
    return solution.disk.dct.mean(axis=1) * per_blade


def where_to_twist_chart(gradient: PitchGradient, units: Units = SI, previous: Range | None = None) -> StripChart:
    """Power for a degree more pitch per unit of r/R along the blade, trim kept.

    The axis fits most of the blade; `note` says how high the clipped spike, as a rule at the tip, really is.
    """
    unit = units.power[0]
    density = gradient.density * math.radians(1.0) / unit.size
    reach = max(1.0, 1.25 * float(np.quantile(np.abs(density), _SHOWN_QUANTILE)))
    y_range = held_range(previous, -reach, reach)
    outside = int(np.argmax(np.maximum(density - y_range[1], y_range[0] - density)))
    value = note = ""
    if not y_range[0] <= density[outside] <= y_range[1]:
        height = number(float(density[outside]), 0, sign=True)
        value = f"{height} at {gradient.r[outside]:.2f} R"
        note = f"Off the chart: {height} at {gradient.r[outside]:.2f} R."
    return StripChart(
        title="Pitch sensitivity",
        unit=f"{unit.symbol}/° per R",
        x_range=(0.1, 1.0),
        y_range=y_range,
        lines=(StripLine(gradient.r, density, "saving", filled=True),),
        value=value,
        note=note,
    )


def _margin(r: Array, margin: Array) -> tuple[str, str]:
    """The least margin before stall, or the stretch that is stalled, as value and note of a chart."""
    known = np.isfinite(margin)
    if not known.any():
        return "", ""
    stalled = known & (margin < 0.0)
    if stalled.any():
        inner, outer = float(r[stalled].min()), float(r[stalled].max())
        return "stalled", f"Stalled between {inner:.2f} and {outer:.2f} R."
    at = int(np.nanargmin(margin))
    return f"{number(float(margin[at]), 1)}° to stall", f"Least margin at {r[at]:.2f} R."


def _plain(values: float | Array, digits: int) -> Any:
    """A number, or a list of them with None for NaN."""
    rounded = np.round(np.asarray(values, dtype=float), digits)
    return np.where(np.isfinite(rounded), rounded.astype(object), np.array(None)).tolist()
