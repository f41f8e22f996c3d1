"""Charts of the panels: uplots made once and then only given data."""

import numpy as np
import viser
from viser import uplot

from explorer.charts.plots import Plot, Range
from explorer.text import readout
from explorer.theme.colours import PINNED, PINNED_DASH, THIS

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


class Chart:
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
