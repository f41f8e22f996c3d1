"""A chart as a value: two axes, series of lines, points and bands, and rules.

`rotor.support.chart_svg` draws it for the trust page, reports and the documentation, `rotor.support.plots` with
matplotlib, and `explorer/web/chart.js` on the page from `drawn_chart`. Ticks, ends of the axes and colours are decided
here, so that all draw the same.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from msgspec import Struct

from rotor.support.arrays import Array

Span = tuple[float, float]
Mark = Literal["dot", "cross", "ring"]
NamePlace = Literal["above", "below"]
Values: TypeAlias = Sequence[float] | Array
"""Any numbers; a series keeps them as a tuple of floats."""
Colour: TypeAlias = int | str | None
"""Place in `COLOURS`, a colour as CSS writes it, or None: the next of `COLOURS` after the ink."""
AZIMUTH = (0.0, 90.0, 180.0, 270.0, 360.0)
"""Ticks of a chart over azimuth [°]."""
COLOURS = (
    "currentColor",
    "#1c7ed6",
    "#e8590c",
    "#0ca678",
    "#be4bdb",
    "#e8a100",
    "#1098ad",
    "#a0694b",
    "#868e96",
)
"""Ink first, for what was measured, then ours; each can be read on white and on black."""
INK = 0
_DASHES = "6 4"


@dataclass(frozen=True)
class Axis:
    """One axis of a chart: its title, unit, scale and ends."""

    label: str = ""
    range: Span | None = None
    """Ends of the axis; None: as the series ask for. What lies beyond is cut off."""
    ticks: tuple[float, ...] = ()
    """Where they stand; empty: at round numbers."""
    words: tuple[str, ...] = ()
    """What stands at each of them instead of its number."""
    unit: str = ""
    """Behind the number of each tick."""
    log: bool = False
    names: tuple[str, ...] = ()
    """Names of the places 0, 1, … of y, which then run down the left side; values and error bars lie along x."""
    whole: Span | None = None
    """Ends that show all, which the page draws on demand; None: those of `range`."""


def _keep(series: object, *names: str) -> None:
    """The values of a series as tuples of floats."""
    for name in names:
        numbers: list[float] = np.asarray(getattr(series, name), dtype=float).ravel().tolist()
        object.__setattr__(series, name, tuple(numbers))


@dataclass(frozen=True)
class Line:
    """Values joined by a line; NaN is a gap."""

    label: str
    """For the key; empty leaves it out."""
    x: Values
    y: Values
    colour: Colour = None
    dashes: bool | str = False
    """True, or the lengths of dashes and gaps as SVG writes them."""
    width: float = 2.0
    dots: bool = False
    """Whether each value has a dot."""
    filled: bool = False
    """Whether the area down to zero is tinted."""

    def __post_init__(self) -> None:
        _keep(self, "x", "y")


@dataclass(frozen=True)
class Points:
    """Values drawn as separate marks."""

    label: str
    x: Values
    y: Values
    colour: Colour = INK
    mark: Mark = "dot"
    scatter: Values = ()
    """Half the length of an error bar on each point, along the axis of values."""
    words: Sequence[str] = ()
    """What is said of each where the pointer rests on it."""
    action: str = ""
    """Name of what the page does with a press on each."""
    press: Sequence[str] = ()
    """What a press on each says to the page; empty: it cannot be pressed."""
    names: Sequence[str] = ()
    """What stands beside each in the drawing."""
    name_place: NamePlace = "above"
    faint: Sequence[bool] = ()
    size: float = 4.0
    """Radius [px]."""

    def __post_init__(self) -> None:
        _keep(self, "x", "y", "scatter")


@dataclass(frozen=True)
class Band:
    """The area between two lines over one abscissa; where y has names, x counts these and the area lies along x."""

    label: str
    x: Values
    low: Values
    high: Values
    colour: Colour = None
    opacity: float = 0.17

    def __post_init__(self) -> None:
        _keep(self, "x", "low", "high")


Series: TypeAlias = Line | Points | Band


@dataclass(frozen=True)
class Rule:
    """A line across the chart at one value, or an area between two in which nothing is drawn."""

    at: float
    to: float | None = None
    label: str = ""
    along: Literal["x", "y"] = "x"
    """The axis that has the value."""
    colour: str = "currentColor"
    dashes: str = "3 3"


@dataclass(frozen=True)
class Chart:
    """One pair of axes and everything that is drawn on them."""

    title: str
    x: Axis
    y: Axis
    series: tuple[Series, ...]
    rules: tuple[Rule, ...] = ()
    value: str = ""
    """The number to remember."""
    note: str = ""
    """One sentence: what the chart says, or what lies outside it."""

    def span(self, axis: Literal["x", "y"]) -> Span:
        """Ends of an axis, as given or of all values with their error bars; of the logarithm on a logarithmic axis."""
        scale = self.x if axis == "x" else self.y
        if scale.range is not None:
            return scaled(scale.range[0], scale.log), scaled(scale.range[1], scale.log)
        if scale.names:
            return len(scale.names) - 0.5, -0.5
        known = [
            scaled(value, scale.log)
            for value in (*self._values(axis), *scale.ticks)
            if math.isfinite(value)
        ]
        low, high = (min(known), max(known)) if known else (0.0, 1.0)
        if scale.ticks:
            return low, high
        if low == high:
            return low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
        if not scale.log and 0.0 < low < 0.5 * high:
            low = 0.0
        margin = 0.06 * (high - low)
        return (low if low == 0.0 else low - margin), (high if high == 0.0 else high + margin)

    def ticks(self, axis: Literal["x", "y"], about: int) -> list[tuple[float, str]]:
        """Value and text of at most about so many ticks."""
        scale = self.x if axis == "x" else self.y
        if scale.names:
            return [(float(k), name) for k, name in enumerate(scale.names)]
        places = scale.ticks or _ticks(self.span(axis), about, scale.log)
        if scale.words:
            return list(zip(places, scale.words, strict=True))
        return [(value, tick_text(value, scale.log) + scale.unit) for value in places]

    def colours(self) -> list[str]:
        """Colour of each series."""
        colours, turn = list[str](), 0
        for series in self.series:
            turn += series.colour is None
            colour = (turn - 1) % (len(COLOURS) - 1) + 1 if series.colour is None else series.colour
            colours.append(COLOURS[colour % len(COLOURS)] if isinstance(colour, int) else colour)
        return colours

    def _values(self, axis: Literal["x", "y"]) -> Iterable[float]:
        along = "x" if self.y.names else "y"
        for series in self.series:
            if isinstance(series, Band):
                yield from ((*series.low, *series.high) if axis == along else series.x)
                continue
            values = series.x if axis == "x" else series.y
            if isinstance(series, Points) and series.scatter and axis == along:
                for value, half in zip(values, series.scatter, strict=True):
                    yield from (value - half, value + half)
            else:
                yield from values


def dash_lengths(line: Line) -> str | None:
    """Dashes as SVG writes them; None for a line without gaps."""
    return _DASHES if line.dashes is True else line.dashes or None


class DrawnScale(Struct, frozen=True):
    """Ends of an axis, and the places and texts of its ticks."""

    range: Span
    ticks: list[tuple[float, str]]


class DrawnAxis(DrawnScale, frozen=True, omit_defaults=True, kw_only=True):
    label: str
    log: bool = False
    ends: bool = False
    """Whether words stand at its two ends alone."""
    whole: DrawnScale | None = None
    """The scale that shows all."""


class _DrawnSeries(Struct, frozen=True, omit_defaults=True, tag_field="kind"):
    label: str
    colour: str
    x: list[float | None]


class DrawnLine(_DrawnSeries, frozen=True, tag="line"):
    y: list[float | None]
    width: float
    dashes: str | None = None
    dots: bool = False
    filled: bool = False


class DrawnPoints(_DrawnSeries, frozen=True, tag="points"):
    y: list[float | None]
    mark: Mark
    size: float
    words: Sequence[str] = ()
    action: str = ""
    press: Sequence[str] = ()
    names: Sequence[str] = ()
    faint: Sequence[bool] = ()
    name_place: NamePlace | None = None
    scatter: Sequence[float | None] = ()


class DrawnBand(_DrawnSeries, frozen=True, tag="band"):
    low: list[float | None]
    high: list[float | None]
    opacity: float = 0.17


class DrawnChart(Struct, frozen=True, omit_defaults=True):
    """A chart as the page draws it: numbers rounded to what a pixel shows, gaps as None.

    Its JSON leaves out what says nothing, for it is sent with every answer.
    """

    title: str
    x: DrawnAxis
    y: DrawnAxis
    series: list[DrawnLine | DrawnPoints | DrawnBand]
    value: str
    note: str
    rules: tuple[Rule, ...] = ()


def drawn_chart(chart: Chart) -> DrawnChart:
    """The chart with its ticks, the ends of its axes and its colours."""
    spans = ("x", chart.span("x")), ("y", chart.span("y"))
    digits = {
        axis: max(0, 4 - math.floor(math.log10(abs(end - start) or 1.0)))
        for axis, (start, end) in spans
    }
    series = [
        _drawn_series(one, colour, digits)
        for one, colour in zip(chart.series, chart.colours(), strict=True)
    ]
    x, y = _drawn_axis(chart, "x", 5), _drawn_axis(chart, "y", 4 if chart.y.whole is None else 2)
    return DrawnChart(chart.title, x, y, series, chart.value, chart.note, chart.rules)


def _drawn_axis(chart: Chart, axis: Literal["x", "y"], about: int) -> DrawnAxis:
    scale = chart.x if axis == "x" else chart.y
    low, high = chart.span(axis)
    ends, ticks, two = (float(low), float(high)), chart.ticks(axis, about), len(scale.words) == 2
    whole = scale.whole
    told = (
        None
        if whole is None
        else DrawnScale(whole, [(at, tick_text(at)) for at in round_ticks(*whole, about)])
    )
    return DrawnAxis(ends, ticks, label=scale.label, log=scale.log, ends=two, whole=told)


def _drawn_series(
    series: Series, colour: str, digits: dict[str, int]
) -> DrawnLine | DrawnPoints | DrawnBand:
    x = _rounded(series.x, digits["x"])
    if isinstance(series, Band):
        low, high = _rounded(series.low, digits["y"]), _rounded(series.high, digits["y"])
        return DrawnBand(series.label, colour, x, low, high, series.opacity)
    y = _rounded(series.y, digits["y"])
    if isinstance(series, Line):
        return DrawnLine(
            series.label,
            colour,
            x,
            y,
            series.width,
            dash_lengths(series),
            series.dots,
            series.filled,
        )
    return DrawnPoints(
        series.label,
        colour,
        x,
        y,
        series.mark,
        series.size,
        words=tuple(series.words),
        action=series.action,
        press=tuple(series.press),
        names=tuple(series.names),
        faint=tuple(series.faint),
        name_place=series.name_place if series.names else None,
        scatter=tuple(_rounded(series.scatter, digits["y"] + 1)),
    )


def _rounded(values: Values, digits: int) -> list[float | None]:
    rounded: list[float] = np.round(np.asarray(values, dtype=np.float64), digits).tolist()
    return [value if math.isfinite(value) else None for value in rounded]


def scaled(value: float, log: bool) -> float:
    """A value on the scale of an axis, its logarithm on a logarithmic one."""
    return math.log10(max(value, 1e-300)) if log else value


def _ticks(span: Span, about: int, log: bool) -> list[float]:
    """Round values within a range, at most about that many; whole powers of ten on a logarithmic axis."""
    low, high = span
    if log:
        every = max(1, math.ceil((high - low) / about))
        return [10.0**k for k in range(math.ceil(low), math.floor(high) + 1) if k % every == 0]
    return round_ticks(low, high, about)


def round_up(step: float) -> float:
    """The round number 1, 2 or 5 × 10ⁿ nearest above `step`."""
    power = 10.0 ** math.floor(math.log10(step))
    return power * next(
        factor for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= step * (1.0 - 1e-9)
    )


def round_ticks(low: float, high: float, about: int) -> list[float]:
    """At most `about` + 1 round numbers within an axis, zero among them where it is inside."""
    step = round_up((high - low) / about)
    return [
        round(k * step, 12)
        for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)
    ]


def bar_ticks(low: float, high: float) -> list[tuple[float, str]]:
    """Place [% of its length] and text of round numbers along a colour bar."""
    return [
        (round(100.0 * (at - low) / (high - low), 2), tick_text(at))
        for at in round_ticks(low, high, 5)
    ]


def tick_text(value: float, log: bool = False) -> str:
    """A tick's number with a true minus sign and no needless digits; a power of ten on a logarithmic axis."""
    if log and not 0.1 <= value <= 1e4:
        return "10" + f"{round(math.log10(value))}".translate(
            str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
        )
    return f"{round(value, 6) + 0.0:.6g}".replace("-", "−")
