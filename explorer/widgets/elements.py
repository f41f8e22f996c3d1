"""Widgets that several panels have: a chart, and the buttons of long work with its progress."""

from collections.abc import Callable

import viser

from explorer.charts.plots import Range
from explorer.charts.svg import chart_box
from explorer.text.glossary import hint
from rotor.support.chart import Chart, drawn_chart
from rotor.support.markup import tag


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
        """The y axis, kept while the data fit it; None without a chart."""
        return None if self._chart is None else self._chart.y.range


class WorkButtons:
    """Buttons that begin and stop long work, and the bar of its progress."""

    def __init__(
        self,
        gui: viser.GuiApi,
        begin: str,
        stop: str,
        entries: tuple[str, str],
        *actions: Callable[[], None],
    ) -> None:
        """`entries`: of the glossary, and `actions`, of the two buttons."""
        self.begin = gui.add_button(begin, icon=viser.Icon.PLAYER_PLAY, hint=hint(entries[0]))
        self._halt = gui.add_button(
            stop,
            icon=viser.Icon.PLAYER_STOP,
            color=(201, 42, 42),
            visible=False,
            hint=hint(entries[1]),
        )
        self._bar = gui.add_progress_bar(0.0)
        for button, action in zip((self.begin, self._halt), actions, strict=True):
            button.on_click(lambda _, action=action: action())

    def show(self, part_done: float | None, under_way: bool) -> None:
        """`part_done`: 0…1; None where nothing was begun yet."""
        self.begin.visible, self._halt.visible = not under_way, under_way
        self._bar.visible = part_done is not None
        if part_done is not None:
            self._bar.value, self._bar.animated = round(100.0 * part_done, 1), under_way
