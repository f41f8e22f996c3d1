"""The live charts: those of the panels, and the strip below the scene."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import msgspec
import viser

from explorer.charts.measured import FlownPowers, MeasuredChart, source_of
from explorer.charts.plots import PowerCurve, Range
from explorer.charts.strip import Role, alpha_chart, lift_chart, power_change_chart, total_power_chart, with_speeds
from explorer.hosting.browser import Bridge
from explorer.model.inputs import baseline_of
from explorer.model.session_state import SessionState
from explorer.model.units import UNITS, number
from rotor import Design, Solution
from rotor.chart import Chart, drawn_chart
from rotor.markup import Markup, tag

_HEIGHT = 94.0
"""Height of the axes [px]."""


def chart_box(chart: Chart, height: float = _HEIGHT) -> Markup:
    """A chart within text for the page, which draws it as wide as there is room; `height` [px] of its axes."""
    told = msgspec.json.encode(drawn_chart(chart)).decode()
    return tag("div.rx-chart", data_chart=told, data_high=height)


class PanelChart:
    """A chart in a panel; nothing until it is shown one."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._html = gui.add_html("")
        self._chart: Chart | None = None

    def show(self, chart: Chart | None) -> None:
        """None: no chart."""
        self._chart = chart
        self._html.content = "" if chart is None else tag("div.rx", chart_box(chart))

    @property
    def y_range(self) -> Range | None:
        """To be held as long as it serves; None without a chart."""
        return None if self._chart is None else self._chart.y.range


_ORDER = ("power", "alpha", "lift")
_VIBRATION = "vibration"
"""Takes the place of the lift where blades bend."""
_MEASURED = "measured"
"""Takes the place of power over µ on a test stand, for a rotor that was measured."""


class ChartStrip:
    """One session's. Axes are held while the data fit them, so that they do not jump during a drag."""

    def __init__(self, bridge: Bridge) -> None:
        self._bridge = bridge
        self._charts: dict[str, Chart] = {}
        self._told: dict[str, dict[str, Any]] = {}
        """The charts as the page draws them."""
        self._kinds: dict[str, str] = {}
        self._faded = self._pinned = False
        self._plain = False
        """Whether power over µ shows the power itself."""
        self._measured = MeasuredChart()
        self._flown = FlownPowers()
        self._power: tuple[SessionState, PowerCurve, bool] | None = None
        """What power over µ shows, to be drawn again when more is known."""

    def show(self, state: SessionState) -> None:
        """Follow a converged state; sent together with power over µ: `show_power` follows at once."""
        self._pinned, self._faded = state.pinned is not None, False
        self._show_alpha(state)
        self._place("lift", lift_chart(state.solution, state.reference, self._held("lift"), self._compared))
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
        held = self._held("alpha")
        self._place("alpha", alpha_chart(state.solution, state.reference, azimuth, held, self._compared))

    def _place(self, name: str, chart: Chart | None) -> None:
        """In the place of the one before; None: it goes."""
        self._charts.pop(name, None)
        if chart is not None:
            self._charts[name], self._told[name] = chart, msgspec.to_builtins(drawn_chart(chart))

    @property
    def _compared(self) -> Role:
        return "pinned" if self._pinned else "reference"

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
            chart = total_power_chart(curve, mu, total, units, held, marks, design)
            notes = [chart.note, band_words(design, curve.band is not None), source_of(design)]
            value = "" if failed else self._flown.value(state.solution)
            chart = replace(chart, value=value or chart.value, note=" ".join(note for note in notes if note))
        else:
            chart = power_change_chart(curve, mu, change, name, units, held)
        fastest = math.nan
        if level := curve.current and state.inputs.stand is None:
            chart, fastest = with_speeds(chart, curve, design)
        self._place("power", chart)
        if level and not failed and math.isfinite(fastest):
            self._told["power"]["speeds"] = {"mu": mu, "fastest": math.floor(200.0 * fastest) / 200.0}
        self._send()

    def show_vibration(self, chart: Chart | None) -> None:
        """The vibration index over µ; None where there is none."""
        if chart is None and _VIBRATION not in self._charts:
            return
        self._place(_VIBRATION, chart)
        self._send()

    def vibration_range(self) -> tuple[Range | None, Role]:
        """The axis of that chart, to be held, and what its reference is."""
        return self._held(_VIBRATION), self._compared

    def fade(self) -> None:
        self._faded = True
        self._send()

    def _held(self, name: str) -> Range | None:
        chart = self._charts.get(name)
        return None if chart is None else chart.y.range

    def _names(self) -> tuple[str, ...]:
        names = _ORDER
        if _VIBRATION in self._charts:
            names = ("power", _VIBRATION, *(name for name in names[1:] if name != "lift"))
        return (_MEASURED, *names[1:]) if _MEASURED in self._charts else names

    def _send(self) -> None:
        common = {"pinned": self._pinned, "faded": self._faded}
        charts: list[dict[str, Any]] = [
            {**self._told[name], "name": name, "kind": self._kinds.get(name, ""), **common}
            for name in self._names()
            if name in self._charts
        ]
        self._bridge.set(strip=charts)


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
