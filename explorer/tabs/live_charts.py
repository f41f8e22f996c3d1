"""The live charts: those of the panels, and the strip below the scene."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import viser

from explorer.charts.measured import FlownPowers, MeasuredChart, source_of
from explorer.charts.plots import PowerCurve, Range
from explorer.charts.strip import Role, alpha_chart, lift_chart, power_change_chart, total_power_chart, with_speeds
from explorer.hosting.browser import Bridge
from explorer.model.inputs import baseline_of
from explorer.model.session_state import SessionState
from explorer.model.units import UNITS, number
from rotor import Design, Solution
from rotor.chart import Chart, as_json
from rotor.markup import Markup, tag

_HEIGHT = 94.0
"""Height of the axes [px]."""


def chart_box(chart: Chart, height: float = _HEIGHT) -> Markup:
    """A chart within text for the page, which draws it as wide as there is room; `height` [px] of its axes."""
    told = json.dumps(as_json(chart), ensure_ascii=False, separators=(",", ":"))
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


