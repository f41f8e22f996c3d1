"""Charts with matplotlib, an extra of the installation: it is imported when something is drawn."""

from typing import Any

from rotor.support.chart import Band, Chart, Line
from rotor.support.units import typographic
from rotor.support.user_input import extra_module

_NAME_PLACES: dict[str, dict[str, Any]] = {
    "above": {"xytext": (0, 4), "textcoords": "offset points", "ha": "center"},
    "below": {"xytext": (0, -12), "textcoords": "offset points", "ha": "center"},
}
_MARKERS = {"dot": "o", "cross": "x", "ring": "o"}


def drawing_module(name: str = "matplotlib.figure") -> Any:
    """A module of matplotlib; MissingExtra, one sentence with the remedy, where that is not installed.

    ValueError where matplotlib finds no folder for its own files, without which it cannot be imported.
    """
    try:
        return extra_module(name, "a picture")
    except OSError:
        raise ValueError(
            "a picture needs a folder that matplotlib can write its own files to: set MPLCONFIGDIR to one"
        ) from None


def new_axes(**options: Any) -> Any:
    """Axes in a new pyplot figure."""
    return drawing_module("matplotlib.pyplot").subplots(**options)[1]


def draw_chart(chart: Chart, ax: Any = None, *, legend: bool = True) -> Any:
    """A chart into `ax` or new axes, with the colours and ends of `rotor.support.chart`; NaN leaves a gap. Returns the
    axes.

    `legend`: whether the axes have one, where more than one series is named.
    """
    if ax is None:
        ax = new_axes()
    named = bool(chart.y.names)
    for series, colour in zip(chart.series, chart.colours(), strict=True):
        ink = "0.2" if colour == "currentColor" else colour
        if isinstance(series, Band):
            if len(series.x) == 1 and not named:  # A band of one point has no area.
                ax.plot(
                    (series.x[0], series.x[0]),
                    (series.low[0], series.high[0]),
                    color=ink,
                    alpha=0.3,
                    linewidth=5,
                )
                continue
            fill = ax.fill_betweenx if named else ax.fill_between
            fill(series.x, series.low, series.high, color=ink, alpha=0.15, linewidth=0)
            continue
        look: dict[str, Any] = {"color": ink, "label": typographic(series.label) or None}
        if isinstance(series, Line):
            look |= {"linestyle": "--" if series.dashes else "-"} | (
                {"marker": "o", "markersize": 3} if series.dots else {}
            )
        else:
            look |= {
                "linestyle": "none",
                "marker": _MARKERS[series.mark],
                "markersize": series.size,
            }
            for x, y, name in zip(series.x, series.y, series.names, strict=False):
                ax.annotate(name, (x, y), **_NAME_PLACES[series.name_place])
            if series.scatter:
                error = {"xerr" if named else "yerr": series.scatter}
                ax.errorbar(
                    series.x, series.y, fmt="none", ecolor=ink, alpha=0.45, capsize=2, **error
                )
        ax.plot(series.x, series.y, **look)
    for name, axis in (("x", chart.x), ("y", chart.y)):
        getattr(ax, f"set_{name}label")(axis.label)
        if axis.log:
            getattr(ax, f"set_{name}scale")("log")
        if axis.ticks:
            getattr(ax, f"set_{name}ticks")(axis.ticks)
        if axis.range is not None:
            getattr(ax, f"set_{name}lim")(*axis.range)
    if named:
        ax.set_yticks(range(len(chart.y.names)), chart.y.names)
        ax.invert_yaxis()
    if chart.title:
        ax.set_title(chart.title)
    if legend and sum(bool(series.label) for series in chart.series) > 1:
        ax.legend()
    return ax
