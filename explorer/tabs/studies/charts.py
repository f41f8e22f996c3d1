"""Charts of a study as Plotly figures: scatter, parallel coordinates, the front of hover against cruise power.

Each point carries its number, for the click that takes it. Plotly is imported when the first chart is made.
"""

import importlib
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from explorer.text.units import number
from explorer.theme.colours import BASELINE, NOW, THIS, colour_map, css
from rotor.study.findings import HoverCruisePairs
from rotor.study.results import Results

Ints = NDArray[np.int64]

MOST_POINTS = 3000
"""Drawn; more than these a panel of 300 pixels cannot show, nor a browser drag."""
_MOST_LINES = 600
TITLES = {
    "mu": "advance ratio µ",
    "speed_kt": "speed [kt]",
    "mass_kg": "mass [kg]",
    "altitude_m": "altitude [m]",
    "climb_m_s": "climb [m/s]",
    "power_total_w": "power [kW]",
    "power_main_rotor_w": "rotor power [kW]",
    "power_induced_w": "induced [kW]",
    "power_profile_w": "profile [kW]",
    "power_parasite_w": "parasite [kW]",
    "power_climb_w": "climb [kW]",
    "power_tail_w": "tail rotor [kW]",
    "mean_power_w": "mean power [kW]",
    "hover_power_w": "hover power [kW]",
    "baseline_power_w": "baseline power [kW]",
    "saving_percent": "saving [%]",
    "division": "break point r/R",
    "ct_over_sigma": "C_T/σ",
    "stalled_area_percent": "stalled area [%]",
}
"""What people read; the others are read from name and unit."""
_HIDDEN = ("point", "passes", "elapsed_ms", "ct", "cp", "lambda0", "evaluations", "local_minima", "speed_m_s")


def title(results: Results, name: str) -> str:
    """A column in the user's words, with its unit."""
    if name in TITLES:
        return TITLES[name]
    unit = results.unit(name)
    words = name.removesuffix("_deg").removesuffix("_percent").replace("_", " ")
    return f"{words} [{unit}]" if unit else words


def shown(results: Results, name: str) -> NDArray[np.float64]:
    """A column of numbers as people read it: kW for W."""
    return results.columns[name] / (1e3 if results.unit(name) == "W" else 1.0)


def choices(results: Results) -> tuple[str, ...]:
    """Columns worth an axis of a chart: numbers that vary, or all of a single point; what the study varies first.

    Last those that some points have no value of, as of a parameter that only one of several concepts has.
    """
    numbers = [name for name in results.columns if results.numeric(name) and name not in _HIDDEN]
    varying = [name for name in numbers if len(np.unique(results.columns[name][results.good])) > 1] or numbers
    whole = [name for name in varying if np.isfinite(results.columns[name][results.good]).all()]
    front = [name for name in (*results.axes, "power_total_w") if name in varying]
    return tuple(dict.fromkeys((*front, *whole, *varying)))


def picked(results: Results, keep: int | None = None, *, most: int = MOST_POINTS) -> Ints:
    """Rows to draw: all good ones, or as many of them evenly chosen; the one to keep is among them."""
    rows = np.flatnonzero(results.good)
    if len(rows) > most:
        rows = np.sort(np.random.default_rng(0).choice(rows, most, replace=False))
    return rows if keep is None or keep in rows else np.append(rows, keep)


def scatter(results: Results, x: str, y: str, colour: str, now: int | None, dark: bool) -> Any:
    """One column over another, coloured by a third; the row taken last has a ring."""
    rows = picked(results, now)
    marks = {
        "size": 5 if len(rows) > 400 else 7,
        "color": shown(results, colour)[rows],
        "colorscale": _scale(),
        "colorbar": {"title": {"text": title(results, colour), "side": "right"}, "thickness": 8, "len": 1.0},
        "line": {"width": 0},
    }
    points = {
        "type": "scatter",
        "mode": "markers",
        "x": shown(results, x)[rows],
        "y": shown(results, y)[rows],
        "customdata": _numbers(results, rows),
        "marker": marks,
        "hovertext": _hover(results, rows),
        "hoverinfo": "text",
    }
    traces = [points]
    if now is not None:
        traces.append(_ring(float(shown(results, x)[now]), float(shown(results, y)[now])))
    return _figure(traces, title(results, x), title(results, y), dark)


def front(results: Results, pairs: HoverCruisePairs, cruise: float, now: int | None, dark: bool) -> Any:
    """Hover power over cruise power of every blade, and the line of those that none beats in both."""
    best = pairs.best
    order = np.flatnonzero(best)[np.argsort(pairs.cruise[best], kind="stable")]
    others = np.flatnonzero(~best)
    if len(others) > MOST_POINTS:
        others = np.sort(np.random.default_rng(0).choice(others, MOST_POINTS, replace=False))
    traces: list[dict[str, Any]] = []
    for chosen, style in (
        (others, {"mode": "markers", "marker": {"size": 5, "color": BASELINE, "opacity": 0.6}}),
        (order, {"mode": "lines+markers", "marker": {"size": 7, "color": THIS}, "line": {"color": THIS, "width": 1.5}}),
    ):
        traces.append(
            {
                "type": "scatter",
                "x": pairs.cruise[chosen] / 1e3,
                "y": pairs.hover[chosen] / 1e3,
                "customdata": _numbers(results, pairs.row[chosen]),
                "hovertext": _hover(results, pairs.row[chosen]),
                "hoverinfo": "text",
                **style,
            }
        )
    if now is not None and (at := np.flatnonzero(pairs.row == now)).size:
        traces.append(_ring(float(pairs.cruise[at[0]]) / 1e3, float(pairs.hover[at[0]]) / 1e3))
    figure = _figure(traces, f"power at µ {cruise:g} [kW]", "power in hover [kW]", dark)
    # Near the front; what lies far from it comes with a double click.
    figure.update_xaxes(range=_near(pairs.cruise, pairs.cruise[best]), autorange=False)
    figure.update_yaxes(range=_near(pairs.hover, pairs.hover[best]), autorange=False)
    return figure


def _near(powers: NDArray[np.float64], best: NDArray[np.float64]) -> list[float]:
    """From just below the best power to well beyond the front [kW]."""
    low, high = float(best.min()) / 1e3, float(best.max()) / 1e3
    span = max(high - low, 0.01 * low)
    return [low - 0.15 * span, min(high + 1.2 * span, float(powers.max()) / 1e3 + 0.1 * span)]


def empty(dark: bool) -> Any:
    """Nothing, where a chart will be."""
    return _figure([], "", "", dark)


def parallel(results: Results, colour: str, dark: bool) -> Any:
    """Every axis and the power as upright scales, a line for each row; a drag along a scale picks lines out."""
    rows = picked(results, most=_MOST_LINES)
    texts = tuple(name for name in results.axes if not results.numeric(name))
    names = [
        name for name in dict.fromkeys((*results.axes, "power_total_w", colour)) if name in (*texts, *choices(results))
    ]
    lines = {
        "type": "parcoords",
        "dimensions": [_dimension(results, name, rows) for name in names],
        "line": {"color": shown(results, colour)[rows], "colorscale": _scale()},
        "labelangle": -30,
        "labelfont": {"size": 11},
        "tickfont": {"size": 9},
        "rangefont": {"size": 9},
    }
    figure = _figure([lines], "", "", dark)
    slanting = round(5.2 * len(_short(results, names[-1])))  # [px] that the last label reaches to the right
    figure.update_layout(margin={"l": 40, "r": max(52, slanting), "t": 78, "b": 26})
    return figure


def _dimension(results: Results, name: str, rows: Ints) -> dict[str, Any]:
    """One upright scale; texts stand on it at 0, 1, …"""
    label = _short(results, name)
    if results.numeric(name):
        return {"label": label, "values": shown(results, name)[rows]}
    texts, codes = np.unique(results.columns[name][rows].astype(str), return_inverse=True)
    return {"label": label, "values": codes, "tickvals": list(range(len(texts))), "ticktext": texts.tolist()}


def plain(value: float) -> str:
    """A number with five digits that count, without zeros at its end."""
    digits = max(0, 4 - math.floor(math.log10(abs(value)))) if value and math.isfinite(value) else 0
    text = number(value, min(digits, 6))
    return text.rstrip("0").rstrip(".") if "." in text else text


def _short(results: Results, name: str) -> str:
    return title(results, name).replace("advance ratio ", "")


def _hover(results: Results, rows: Ints) -> list[str]:
    """What a point says under the mouse: its number, every axis, the power."""
    points = _numbers(results, rows)
    names = [name for name in dict.fromkeys((*results.axes, "power_total_w")) if name in results.columns]
    columns = [
        [plain(value) for value in shown(results, name)[rows]]
        if results.numeric(name)
        else results.columns[name][rows].tolist()
        for name in names
    ]
    heads = [title(results, name) for name in names]
    return [
        "<br>".join([f"point {point}", *(f"{head} {one}" for head, one in zip(heads, line, strict=True))])
        for point, line in zip(points.tolist(), zip(*columns, strict=True), strict=True)
    ]


def _numbers(results: Results, rows: Ints) -> Ints:
    """The numbers of the points in these rows."""
    return results.columns["point"][rows].astype(np.int64)


def _ring(x: float, y: float) -> dict[str, Any]:
    mark = {"size": 13, "color": "rgba(0,0,0,0)", "line": {"color": NOW, "width": 2.5}}
    return {"type": "scatter", "mode": "markers", "x": [x], "y": [y], "marker": mark, "hoverinfo": "skip"}


def _scale() -> list[list[Any]]:
    shades = colour_map("sequential", 9)
    return [[k / 8.0, css(shade)] for k, shade in enumerate(shades)]


def _figure(traces: list[dict[str, Any]], x: str, y: str, dark: bool) -> Any:
    plotly: Any = importlib.import_module("plotly.graph_objects")
    ink, grid = ("#c9c9c9", "rgba(255,255,255,0.13)") if dark else ("#333", "rgba(0,0,0,0.10)")
    axis: dict[str, Any] = {
        "gridcolor": grid,
        "zeroline": False,
        "linecolor": grid,
        "title": {"standoff": 4},
        "automargin": True,
    }
    axis["autorange"] = True  # Said, because Plotly else keeps that the chart before had a range of its own.
    return plotly.Figure(
        data=traces,
        layout={
            "paper_bgcolor": "rgba(0,0,0,0)",
            "plot_bgcolor": "rgba(0,0,0,0)",
            "font": {"color": ink, "size": 11},
            "margin": {"l": 8, "r": 8, "t": 10, "b": 8},
            "showlegend": False,
            "hovermode": "closest",
            "dragmode": "zoom",
            "hoverlabel": {"align": "left", "font": {"size": 11}},
            "xaxis": {**axis, "title": {"text": x, "standoff": 4}},
            "yaxis": {**axis, "title": {"text": y, "standoff": 4}},
        },
    )
