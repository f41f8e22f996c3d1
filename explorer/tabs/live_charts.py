"""Charts within the text of a panel."""

import msgspec
import viser

from explorer.charts.plots import Range
from rotor.support.chart import Chart, DrawnChart, drawn_chart
from rotor.support.markup import Markup, tag

_HEIGHT = 94.0
"""Height of the axes [px]."""


def chart_box(chart: DrawnChart, height: float = _HEIGHT) -> Markup:
    """A chart within text for the page, which draws it as wide as there is room; `height` [px] of its axes."""
    told = msgspec.json.encode(chart).decode()
    return tag("div.rx-chart", data_chart=told, data_high=height)


class PanelChart:
    """A chart in a panel; nothing until it is shown one."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._html = gui.add_html("")
        self._chart: Chart | None = None

    def show(self, chart: Chart | None) -> None:
        """None: no chart."""
        self._chart = chart
        self._html.content = "" if chart is None else tag("div.rx", chart_box(drawn_chart(chart)))

    @property
    def y_range(self) -> Range | None:
        """To be held as long as it serves; None without a chart."""
        return None if self._chart is None else self._chart.y.range
