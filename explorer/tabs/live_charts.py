"""The live charts: uplots of the panels, made once and then only given data, and the strip below the scene."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
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
from explorer.colours import PINNED, PINNED_DASH, THIS
from explorer.hosting.browser import Bridge
from explorer.model.inputs import baseline_of
from explorer.model.session_state import SessionState
from explorer.model.units import UNITS, number
from explorer.text import readout
from rotor import Design, Solution
from rotor.trim import PitchGradient

_GRID = uplot.Axis_Grid(show=True, width=1)
_TICKS = uplot.Axis_Ticks(show=True, width=1, size=4)
_FONT = "11px sans-serif"

Key = tuple[tuple[str, str] | tuple[str, str, bool], ...]
"""Name, colour, and whether the line is dashed, of each series that is told apart."""
AB_KEY: Key = (("B", THIS), ("A", PINNED, True))
"""While two designs are compared."""
_BLANK = (-1e-3, 1e-3)
"""Vertical range of an empty chart, which no answer has."""


def line(colour: str, width: float = 2.0, dash: tuple[float, ...] | None = None) -> uplot.Series:
    series = uplot.Series(stroke=colour, width=width, points=uplot.Series_Points(show=False), pxAlign=0)
    if dash is not None:
        series["dash"] = dash
    return series


def pinned_line() -> uplot.Series:
    """A, in any chart."""
    return line(PINNED, 1.8, PINNED_DASH)


def points(colour: str, size: float) -> uplot.Series:
    return uplot.Series(stroke=colour, width=0, points=uplot.Series_Points(show=True, size=size, fill=colour))


class PanelChart:
    """One titled chart with a key that also serves as axis label; empty until it is shown something."""

    def __init__(
        self,
        gui: viser.GuiApi,
        title: str,
        key: Key,
        series: tuple[uplot.Series, ...],
        x_range: Range,
        height: int = 94,
        name: str = "",
    ) -> None:
        """`name`: of the chart in the glossary."""
        self._key, self._count = key, len(series)
        self._heading = gui.add_html(readout.heading(title, key, name))
        self._title, self._name = title, name
        self._x_range, self._y_range = x_range, _BLANK
        self._handle = gui.add_uplot(
            self._blank().data,
            (uplot.Series(), *series),
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

    def show(self, plot: Plot | None, key: Key | None = None) -> None:
        """New data; None: an empty chart. `key`: another than before, where other series are filled."""
        plot = plot or self._blank()
        if key is not None and key != self._key:
            self._key = key
            self._heading.content = readout.heading(self._title, key, self._name)
        x_range = plot.x_range or self._x_range
        if (plot.y_range, x_range) != (self._y_range, self._x_range):
            # A new scale rebuilds the chart in the page, so ranges are held as long as they serve.
            self._y_range, self._x_range = plot.y_range, x_range
            self._handle.scales = self._scales()
        self._handle.data = plot.data

    def set_visible(self, visible: bool) -> None:
        self._heading.visible = self._handle.visible = visible

    @property
    def y_range(self) -> Range | None:
        """To be held as long as it serves; None while the chart is empty."""
        return None if self._y_range == _BLANK else self._y_range

    def _blank(self) -> Plot:
        none = np.full(2, np.nan)
        return Plot((np.array(self._x_range), *(none,) * self._count), _BLANK)

    def _scales(self) -> dict[str, uplot.Scale]:
        return {"x": uplot.Scale(time=False, range=self._x_range), "y": uplot.Scale(range=self._y_range)}


_BESIDE_STARTS = ("power", "lift")
_ORDER = ("power", "alpha", "lift", "worth")
_VIBRATION = "vibration"
"""Takes the place of the lift where blades bend."""
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
        self._show_alpha(state)
        self._charts["lift"] = lift_chart(state.solution, state.reference, self._held("lift"))
        units, held = UNITS[state.view.units], self._held("worth")
        self._place("worth", None if gradient is None else where_to_twist_chart(gradient, units, held))
        self._show_measured(state.solution)

    def solve_measured(self, state: SessionState, superseded: Callable[[], bool]) -> None:
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
        self._place(_MEASURED, self._measured.chart(solution, self._held(_MEASURED)))

    def turn(self, state: SessionState) -> None:
        self._show_alpha(state)
        self._send()

    def _show_alpha(self, state: SessionState) -> None:
        azimuth = state.view.azimuth_deg
        self._charts["alpha"] = alpha_chart(state.solution, state.reference, azimuth, self._held("alpha"))

    def _place(self, name: str, chart: StripChart | None) -> None:
        """In the place of the one before; None: it goes."""
        self._charts.pop(name, None)
        if chart is not None:
            self._charts[name] = chart

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
            total = None if failed else state.solution.power.total
            chart = total_power_chart(curve, mu, total, units, held, marks, design.aircraft)
            notes = [chart.note, band_words(design, curve.band is not None), source_of(design)]
            value = "" if failed else self._flown.value(state.solution)
            chart = replace(chart, value=value or chart.value, note=" ".join(note for note in notes if note))
        else:
            chart = power_change_chart(curve, mu, change, name, units, held)
        self._charts["power"] = chart
        self._send()

    def show_vibration(self, chart: StripChart | None) -> None:
        """The vibration index over µ; None where there is none."""
        if chart is None and _VIBRATION not in self._charts:
            return
        self._place(_VIBRATION, chart)
        self._send()

    def vibration_range(self) -> Range | None:
        """The axis of that chart, to be held."""
        return self._held(_VIBRATION)

    def show_starts(self, chart: dict[str, Any] | None) -> None:
        """The starts of a search in place of the charts along the blade; None: those again."""
        if chart is not None or self._starts is not None:
            self._starts = chart
            self._send()

    def fade(self) -> None:
        self._faded = True
        self._send()

    def _held(self, name: str) -> Range | None:
        chart = self._charts.get(name)
        return None if chart is None else chart.y_range

    def _names(self) -> tuple[str, ...]:
        names = _ORDER if self._starts is None else _BESIDE_STARTS
        if _VIBRATION in self._charts:
            names = ("power", _VIBRATION, *(name for name in names[1:] if name != "lift"))
        return (_MEASURED, *names[1:]) if _MEASURED in self._charts else names

    def _send(self) -> None:
        common = {"pinned": self._pinned, "faded": self._faded}
        charts: list[dict[str, Any]] = [
            {**self._charts[name].as_dict, "name": name, "kind": self._kinds.get(name, ""), **common}
            for name in self._names()
            if name in self._charts
        ]
        self._bridge.set(strip=charts if self._starts is None else [self._starts, *charts])


def against(design: Design, pinned: bool) -> str:
    """What changes are measured against, in words."""
    if pinned:
        return "A"
    built = baseline_of(design).twist == design.rotor.builtin_twist
    return f"{design.aircraft.name} as built" if built else design.aircraft.twist_title(design.preset)


def band_words(design: Design, drawn: bool) -> str:
    """What the band of power over µ is; empty where none is drawn."""
    areas = design.fuselage.drag_area_band
    if areas is None or not drawn:
        return ""
    return f"Band: drag areas of {number(areas[0], 2)} to {number(areas[1], 2)} m², which the sources allow."
