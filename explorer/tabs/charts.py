"""The live charts: uplots made once and then only given data, and the strip below the scene."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import viser
from viser import uplot

from explorer.charts.measured import FlownPowers, MeasuredChart, source_of
from explorer.charts.plots import Plot, PowerCurve, Range
from explorer.charts.strip import (
    StripChart,
    alpha_chart,
    lift_chart,
    power_change_chart,
    total_power_chart,
    where_to_twist_chart,
)
from explorer.interface import SessionState
from explorer.overlay.bridge import Bridge
from explorer.tabs.optimise.run import Starts
from explorer.tabs.power_card import against
from explorer.text import readout
from explorer.text.units import UNITS, Units, number
from explorer.theme.colours import PINNED, PINNED_DASH, START_COLOURS, THIS, css
from rotor.design.design import Design
from rotor.line_chart import round_ticks
from rotor.trim.adjoint import PitchGradient
from rotor.trim.solution import Solution

_HEIGHT = 94
_GRID = uplot.Axis_Grid(show=True, width=1)
_TICKS = uplot.Axis_Ticks(show=True, width=1, size=4)
_FONT = "11px sans-serif"

Key = tuple[tuple[str, str] | tuple[str, str, bool], ...]
"""Name, colour, and whether the line is dashed, of each series that is told apart."""
AB_KEY: Key = (("B", THIS), ("A", PINNED, True))
"""While two designs are compared."""


def line(label: str, colour: str, width: float = 2.0, dash: tuple[float, ...] | None = None) -> uplot.Series:
    series = uplot.Series(label=label, stroke=colour, width=width, points=uplot.Series_Points(show=False), pxAlign=0)
    if dash is not None:
        series["dash"] = dash
    return series


def pinned_line() -> uplot.Series:
    """A, in any chart."""
    return line("A", PINNED, 1.8, PINNED_DASH)


def points(label: str, colour: str, size: float) -> uplot.Series:
    return uplot.Series(
        label=label, stroke=colour, width=0, points=uplot.Series_Points(show=True, size=size, fill=colour)
    )


class Chart:
    """One titled chart with a key that also serves as axis label."""

    def __init__(
        self,
        gui: viser.GuiApi,
        title: str,
        key: Key,
        abscissa: str,
        series: tuple[uplot.Series, ...],
        plot: Plot,
        x_range: Range,
        height: int = _HEIGHT,
        name: str = "",
    ) -> None:
        """`name`: of the chart in the glossary."""
        self._title, self._key, self._name = title, key, name
        self._heading = gui.add_html(readout.heading(title, key, name))
        self._x_range = x_range
        self._y_range = plot.y_range
        self._handle = gui.add_uplot(
            plot.data,
            (uplot.Series(label=abscissa), *series),
            scales=self._scales(),
            axes=(
                uplot.Axis(size=20, gap=2, space=45, grid=_GRID, ticks=_TICKS, font=_FONT),
                uplot.Axis(size=42, gap=3, space=15, grid=_GRID, ticks=_TICKS, font=_FONT),
            ),
            legend=uplot.Legend(show=False),
            cursor=uplot.Cursor(points=uplot.Cursor_Points(show=False), drag=uplot.Cursor_Drag(x=False, y=False)),
            height=height,
            padding=(8, 14, 0, 0),
        )

    def show(self, plot: Plot, key: Key | None = None, title: str = "") -> None:
        """New data; `key`, `title`: others than before, where other series are filled or the unit has changed."""
        named = title or self._title, key or self._key
        if named != (self._title, self._key):
            self._title, self._key = named
            self._heading.content = readout.heading(*named, self._name)
        x_range = plot.x_range or self._x_range
        if (plot.y_range, x_range) != (self._y_range, self._x_range):
            # A new scale rebuilds the chart in the page, so ranges are held as long as they serve.
            self._y_range, self._x_range = plot.y_range, x_range
            self._handle.scales = self._scales()
        self._handle.data = plot.data

    def set_visible(self, visible: bool) -> None:
        self._heading.visible = self._handle.visible = visible

    @property
    def y_range(self) -> Range:
        return self._y_range

    def _scales(self) -> dict[str, uplot.Scale]:
        return {"x": uplot.Scale(time=False, range=self._x_range), "y": uplot.Scale(range=self._y_range)}


_BESIDE_STARTS = ("power", "lift")
_ORDER = ("power", "alpha", "lift", "worth")
_MEASURED = "measured"
"""Takes the place of power over µ on a test stand, for a rotor that was measured."""


class ChartStrip:
    """One session's. Axes are held while the data fit them, so that they do not jump during a drag."""

    def __init__(self, bridge: Bridge) -> None:
        self._bridge = bridge
        self._charts: dict[str, StripChart] = {}
        self._kinds: dict[str, str] = {}
        self._faded = self._pinned = False
        self._plain = False
        """Whether power over µ shows the power itself."""
        self._starts: dict[str, Any] | None = None
        self._measured = MeasuredChart()
        self._flown = FlownPowers()
        self._power: tuple[SessionState, PowerCurve, bool] | None = None
        """What power over µ shows, to be drawn again when more is known."""

    def show(self, state: SessionState, gradient: PitchGradient | None) -> None:
        """Follow a converged state; `gradient`: of its power by pitch, None where there is none.

        Sent together with power over µ: `show_power` follows at once.
        """
        self._pinned, self._faded = state.pinned is not None, False
        self._charts["alpha"] = alpha_chart(
            state.solution, state.reference, state.view.azimuth_deg, self._held("alpha")
        )
        self._charts["lift"] = lift_chart(state.solution, state.reference, self._held("lift"))
        if gradient is not None:
            self._charts["worth"] = where_to_twist_chart(gradient, UNITS[state.view.units], self._held("worth"))
        else:
            self._charts.pop("worth", None)
        self._show_measured(state.solution)

    def rest(self, state: SessionState, superseded: Callable[[], bool]) -> None:
        """The page rests: trim at the measured points of this rotor, of a test or in flight."""

        def shown() -> None:
            self._show_measured(state.solution)
            self._send()

        def flown() -> None:
            if self._power is not None:
                self.show_power(*self._power)

        self._measured.trim_points(state.solution, superseded, shown)
        if self._plain:
            self._flown.trim_flights(state.solution, superseded, flown)

    def _show_measured(self, solution: Solution) -> None:
        chart = self._measured.chart(solution, self._held(_MEASURED))
        if chart is None:
            self._charts.pop(_MEASURED, None)
        else:
            self._charts[_MEASURED] = chart

    def turn(self, state: SessionState) -> None:
        """The reference blade is elsewhere."""
        self._charts["alpha"] = alpha_chart(
            state.solution, state.reference, state.view.azimuth_deg, self._held("alpha")
        )
        self._send()

    def show_power(self, state: SessionState, curve: PowerCurve, failed: bool = False) -> None:
        """Change of power over µ, once the sweep has arrived; the power itself where the design is its own reference.

        `failed`: the present inputs have no solution.
        """
        change = None
        self._power = state, curve, failed
        if not failed and state.reference.converged:
            change = state.solution.power.total - state.reference.power.total
        # A preview, such as the flight of a schedule, is elsewhere than the sliders.
        mu = state.solution.design.condition.advance_ratio
        self._kinds["power"] = "" if change is None or abs(change) < 500.0 else "good" if change < 0.0 else "bad"
        design, units = state.solution.design, UNITS[state.view.units]
        name = against(design, state.pinned is not None).removeprefix(f"{design.aircraft.name} ")
        plain = design == state.reference.design
        held = self._held("power") if plain == self._plain else None
        self._plain = plain
        if plain:
            marks = self._flown.marks(state.solution, units)
            chart = total_power_chart(curve, mu, None if failed else state.solution.power.total, units, held, marks)
            notes = [chart.note, band_words(design, curve.band is not None), source_of(design)]
            value = "" if failed else self._flown.value(state.solution)
            chart = replace(chart, value=value or chart.value, note=" ".join(note for note in notes if note))
        else:
            chart = power_change_chart(curve, mu, change, name, units, held)
        self._charts["power"] = chart
        self._send()

    def show_starts(self, starts: Starts | None, units: Units) -> None:
        """The starts of a search in place of the charts along the blade; None: those again."""
        if starts is None and self._starts is None:
            return
        self._starts = None if starts is None else starts_chart(starts, units)
        self._send()

    def fade(self) -> None:
        """The inputs have no solution."""
        self._faded = True
        self._send()

    def _held(self, name: str) -> Range | None:
        chart = self._charts.get(name)
        return None if chart is None else chart.y_range

    def _names(self) -> tuple[str, ...]:
        names = _ORDER if self._starts is None else _BESIDE_STARTS
        return (_MEASURED, *names[1:]) if _MEASURED in self._charts else names

    def _send(self) -> None:
        charts: list[dict[str, Any]] = [
            {
                **self._charts[name].as_dict,
                "name": name,
                "kind": self._kinds.get(name, ""),
                "pinned": self._pinned,
                "faded": self._faded,
            }
            for name in self._names()
            if name in self._charts
        ]
        self._bridge.set(strip=charts if self._starts is None else [self._starts, *charts])


def band_words(design: Design, drawn: bool) -> str:
    """What the band of power over µ is; empty where none is drawn."""
    areas = design.fuselage.drag_area_band
    if areas is None or not drawn:
        return ""
    return f"Band: drag areas of {number(areas[0], 2)} to {number(areas[1], 2)} m², which the sources allow."


def starts_chart(starts: Starts, units: Units) -> dict[str, Any]:
    """The least power so far over the designs that each start has tried."""
    unit = units.power[0]
    low, high = (unit.of(end) for end in starts.axis())
    longest = max([10, *(len(start.best) for start in starts.each)])
    lines = [
        {
            "x": list(range(1, len(start.best) + 1)),
            "y": [round(unit.of(power), 3) for power in start.best],
            "role": "saving",
            "colour": css(START_COLOURS[k]),
            "width": 2.8 if start.is_best else 1.4,
        }
        for k, start in enumerate(starts.each)
        if start.best
    ]
    if starts.start_power is not None:
        level = round(unit.of(starts.start_power), 3)
        lines.insert(0, {"x": [1, longest], "y": [level, level], "role": "reference"})
    above = starts.above_axis()
    best = starts.best_start
    return {
        "name": "starts",
        "title": "Searches from several starts",
        "unit": f"least {unit.symbol} so far over designs tried",
        "x_range": [1, longest],
        "y_range": [low, high],
        "x_ticks": round_ticks(1.0, float(longest), 5),
        "x_name": "",
        "y_ticks": round_ticks(low, high, 4),
        "lines": lines,
        "dots": [],
        "value": "" if best is None else f"start {best.number} is best",
        "note": f"{above} designs lie above the axis." if above else "",
        "kind": "",
        "wide": True,
        "faded": False,
        "pinned": False,
    }
