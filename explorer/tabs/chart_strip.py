"""The charts below the scene: what follows a solution, sent to the frame."""

from typing import Any

from explorer.charts.plots import PowerCurve, Range
from explorer.charts.strip import (
    StripChart,
    alpha_chart,
    lift_chart,
    power_change_chart,
    round_ticks,
    where_to_twist_chart,
)
from explorer.interface import SessionState
from explorer.overlay.bridge import Bridge
from explorer.tabs.optimise.race import Race
from explorer.tabs.power_card import against
from explorer.text.units import UNITS, Units
from explorer.theme.colours import START_COLOURS, css
from rotor.trim.adjoint import PitchGradient

_BESIDE_RACE = ("power", "lift")
_ORDER = ("power", "alpha", "lift", "worth")


class ChartStrip:
    """One session's. Axes are held while the data fit them, so that they do not jump during a drag."""

    def __init__(self, bridge: Bridge) -> None:
        self._bridge = bridge
        self._charts: dict[str, StripChart] = {}
        self._kinds: dict[str, str] = {}
        self._faded = self._pinned = False
        self._race: dict[str, Any] | None = None

    def show(self, state: SessionState, gradient: PitchGradient | None) -> None:
        """Follow a converged state; `gradient`: of its power by pitch, None where there is none."""
        self._pinned, self._faded = state.pinned is not None, False
        self._charts["alpha"] = alpha_chart(
            state.solution, state.reference, state.view.azimuth_deg, self._held("alpha")
        )
        self._charts["lift"] = lift_chart(state.solution, state.reference, self._held("lift"))
        if gradient is not None:
            self._charts["worth"] = where_to_twist_chart(gradient, UNITS[state.view.units], self._held("worth"))
        self._send()

    def turn(self, state: SessionState) -> None:
        """The reference blade is elsewhere."""
        self._charts["alpha"] = alpha_chart(
            state.solution, state.reference, state.view.azimuth_deg, self._held("alpha")
        )
        self._send()

    def show_power(self, state: SessionState, curve: PowerCurve, failed: bool = False) -> None:
        """Change of power over µ, once the sweep has arrived; `failed`: the present inputs have no solution."""
        change = None
        if not failed and state.reference.converged:
            change = state.solution.power.total - state.reference.power.total
        self._kinds["power"] = "" if change is None or abs(change) < 500.0 else "good" if change < 0.0 else "bad"
        name, units = against(state.solution.design, state.pinned is not None), UNITS[state.view.units]
        chart = power_change_chart(curve, state.inputs.advance_ratio, change, name, units, self._held("power"))
        self._charts["power"] = chart
        self._send()

    def show_race(self, race: Race | None, units: Units) -> None:
        """The starts of a search in place of the charts along the blade; None: those again."""
        if race is None and self._race is None:
            return
        self._race = None if race is None else race_chart(race, units)
        self._send()

    def fade(self) -> None:
        """The inputs have no solution."""
        self._faded = True
        self._send()

    def _held(self, name: str) -> Range | None:
        chart = self._charts.get(name)
        return None if chart is None else chart.y_range

    def _send(self) -> None:
        charts: list[dict[str, Any]] = [
            {
                **self._charts[name].as_dict(),
                "name": name,
                "kind": self._kinds.get(name, ""),
                "pinned": self._pinned,
                "faded": self._faded,
            }
            for name in (_ORDER if self._race is None else _BESIDE_RACE)
            if name in self._charts
        ]
        self._bridge.set(strip=charts if self._race is None else [self._race, *charts])


def race_chart(race: Race, units: Units) -> dict[str, Any]:
    """The least power so far over the designs that each start has tried."""
    unit = units.power[0]
    low, high = (unit.of(end) for end in race.axis())
    longest = max([10, *(len(start.best) for start in race.starts)])
    lines = [
        {
            "x": list(range(1, len(start.best) + 1)),
            "y": [round(unit.of(power), 3) for power in start.best],
            "role": "saving",
            "colour": css(START_COLOURS[k]),
            "width": 2.8 if start.leads else 1.4,
        }
        for k, start in enumerate(race.starts)
        if start.best
    ]
    if race.start_power is not None:
        level = round(unit.of(race.start_power), 3)
        lines.insert(0, {"x": [1, longest], "y": [level, level], "role": "reference"})
    above = race.above_axis()
    leader = race.leader
    return {
        "name": "race",
        "title": "Race of the starts",
        "unit": f"least {unit.symbol} so far over designs tried",
        "x_range": [1, longest],
        "y_range": [low, high],
        "x_ticks": round_ticks(1.0, float(longest), 5),
        "y_ticks": round_ticks(low, high, 4),
        "lines": lines,
        "dots": [],
        "value": "" if leader is None else f"start {leader.start} leads",
        "note": f"{above} designs lie above the axis." if above else "",
        "kind": "",
        "wide": True,
        "faded": False,
        "pinned": False,
    }
