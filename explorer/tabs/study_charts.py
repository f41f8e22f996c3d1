"""Charts of a study as SVG: a scatter of its columns, and the front of hover against cruise power.

A click on a point writes its number into the text field of that name.
"""

import math
from html import escape

import numpy as np
from numpy.typing import NDArray

from explorer.charts import svg
from explorer.charts.strip import round_ticks
from explorer.colours import BASELINE, NOW, THIS, colour_map, css
from explorer.model.units import number
from rotor.study.results import HoverCruisePairs, Results

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
Range = tuple[float, float]

FIELD = "Point no."
"""The label of the text field that a click writes to."""
MOST_POINTS = 3000
"""Drawn; more than these a panel of 300 pixels cannot show, nor a browser drag."""
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


def shown(results: Results, name: str) -> Floats:
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


def picked(rows: Ints, keep: int | None = None) -> Ints:
    """All of these rows, or `MOST_POINTS` of them evenly chosen; the one to keep is among them."""
    if len(rows) > MOST_POINTS:
        rows = np.sort(np.random.default_rng(0).choice(rows, MOST_POINTS, replace=False))
    return rows if keep is None or keep in rows else np.append(rows, keep)


def scatter(results: Results, x: str, y: str, colour: str, now: int | None) -> str:
    """One column over another, coloured by a third; the row applied last has a ring."""
    rows = picked(np.flatnonzero(results.good), now)
    across, up, shade = (shown(results, name)[rows] for name in (x, y, colour))
    known = np.isfinite(across) & np.isfinite(up) & np.isfinite(shade)
    chart = _Chart(_with_margin(across[known]), _with_margin(up[known]))
    low, high = _ends(shade[known])
    scale = colour_map("sequential", _SHADES)
    share = (shade - low) / (high - low) if high > low else np.zeros(len(rows))
    for k in np.flatnonzero(known):
        fill = css(scale[round(float(share[k]) * (_SHADES - 1))])
        chart.point(float(across[k]), float(up[k]), 2.6 if len(rows) > 400 else 3.6, fill, results, int(rows[k]), now)
    bar = "".join(
        f'<rect x="{_LEFT + k * _WIDE / _SHADES:.1f}" y="{_HEIGHT - 26:g}" width="{_WIDE / _SHADES + 0.3:.1f}" '
        f'height="6" fill="{css(one)}"/>'
        for k, one in enumerate(scale)
    )
    ends = (
        svg.tick((_LEFT, _HEIGHT - 10.0), plain(low), "start")
        + svg.tick((_LEFT + 0.5 * _WIDE, _HEIGHT - 10.0), title(results, colour), "middle")
        + svg.tick((_LEFT + _WIDE, _HEIGHT - 10.0), plain(high), "end")
    )
    return chart.drawing(title(results, x), title(results, y), bar + ends)


def front(results: Results, pairs: HoverCruisePairs, cruise: float, now: int | None) -> str:
    """Hover power over cruise power of every blade, and the line of those that none beats in both.

    The axes show the front and its surroundings; what lies far from it is beyond them.
    """
    order = np.flatnonzero(pairs.best)[np.argsort(pairs.cruise[pairs.best], kind="stable")]
    chart = _Chart(_near(pairs.cruise, order), _near(pairs.hover, order))
    across, up = pairs.cruise / 1e3, pairs.hover / 1e3
    chart.line(across[order], up[order])
    for chosen, radius, fill in ((picked(np.flatnonzero(~pairs.best)), 2.6, BASELINE), (order, 3.6, THIS)):
        for k in chosen:
            chart.point(float(across[k]), float(up[k]), radius, fill, results, int(pairs.row[k]), now)
    return chart.drawing(f"power at µ {cruise:g} [kW]", "power in hover [kW]")


def plain(value: float) -> str:
    """A number with five digits that count, without zeros at its end."""
    digits = max(0, 4 - math.floor(math.log10(abs(value)))) if value and math.isfinite(value) else 0
    text = number(value, min(digits, 6))
    return text.rstrip("0").rstrip(".") if "." in text else text


_WIDTH, _HEIGHT = 312.0, 300.0
_LEFT, _TOP, _WIDE, _HIGH = 46.0, 18.0, 258.0, 212.0
"""Of the frame within the drawing."""
_SHADES = 33


class _Chart:
    """Axes, and the marks that lie within them."""

    def __init__(self, x: Range, y: Range) -> None:
        self._x, self._y = x, y
        self._marks: list[str] = []

    def point(self, x: float, y: float, radius: float, fill: str, results: Results, row: int, now: int | None) -> None:
        """A point of the study, to be clicked; that of the row `now` has a ring."""
        if not (self._x[0] <= x <= self._x[1] and self._y[0] <= y <= self._y[1]):
            return
        place = f'cx="{self._across(x):.1f}" cy="{self._up(y):.1f}"'
        if row == now:
            self._marks.append(f'<circle {place} r="{radius + 3.0:g}" fill="none" stroke="{NOW}" stroke-width="2.5"/>')
        self._marks.append(
            f'<circle {place} r="{radius:g}" fill="{fill}" class="rx-take" data-write="{FIELD}" '
            f'data-value="{results.columns["point"][row]:.0f}"><title>{escape(_words(results, row))}</title></circle>'
        )

    def line(self, x: Floats, y: Floats) -> None:
        points = " ".join(f"{self._across(a):.1f},{self._up(b):.1f}" for a, b in zip(x, y, strict=True))
        self._marks.append(f'<polyline points="{points}" fill="none" stroke="{THIS}" stroke-width="1.5"/>')

    def drawing(self, x_title: str, y_title: str, below: str = "") -> str:
        """The whole chart; `below`: what stands beneath its axis."""
        bottom, axes = _TOP + _HIGH, []
        for value in round_ticks(*self._x, 5):
            at = self._across(value)
            axes.append(svg.line((at, _TOP), (at, bottom), width=0.8, style=_GRID))
            axes.append(svg.tick((at, bottom + 12.0), plain(value), "middle"))
        for value in round_ticks(*self._y, 5):
            at = self._up(value)
            axes.append(svg.line((_LEFT, at), (_LEFT + _WIDE, at), width=0.8, style=_GRID))
            axes.append(svg.tick((_LEFT - 4.0, at + 3.5), plain(value), "end"))
        axes.append(svg.tick((2.0, 10.0), f"↑ {y_title}", "start"))
        axes.append(svg.tick((_WIDTH - 2.0, bottom + 26.0), f"{x_title} →", "end"))
        return (
            f'<svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" role="img" data-explorer="study-chart" '
            f'aria-label="{escape(y_title)} over {escape(x_title)}">{"".join(axes)}{"".join(self._marks)}{below}</svg>'
        )

    def _across(self, x: float) -> float:
        return _LEFT + (x - self._x[0]) / (self._x[1] - self._x[0]) * _WIDE

    def _up(self, y: float) -> float:
        return _TOP + (self._y[1] - y) / (self._y[1] - self._y[0]) * _HIGH


_GRID = 'opacity=".15"'


def _ends(values: Floats) -> Range:
    return (float(values.min()), float(values.max())) if values.size else (0.0, 1.0)


def _with_margin(values: Floats) -> Range:
    """Room for all values; also about a single one."""
    low, high = _ends(values)
    margin = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
    return low - margin, high + margin


def _near(powers: Floats, best: Ints) -> Range:
    """From just below the best power to well beyond the front [kW]."""
    low, high = float(powers[best].min()) / 1e3, float(powers[best].max()) / 1e3
    span = max(high - low, 0.01 * low)
    return low - 0.15 * span, min(high + 1.2 * span, float(powers.max()) / 1e3 + 0.1 * span)


def axis_names(results: Results, *first: str) -> list[str]:
    """These columns and every axis, as far as the study has them."""
    return [name for name in dict.fromkeys((*first, *results.axes)) if name in results.columns]


def value_text(results: Results, name: str, row: int) -> str:
    """A value as people read it."""
    return plain(shown(results, name)[row]) if results.numeric(name) else str(results.columns[name][row])


def _words(results: Results, row: int) -> str:
    """What a point says when it is pointed at: its number, every axis, the power."""
    lines = [
        f"{title(results, name)} {value_text(results, name, row)}" for name in axis_names(results, "power_total_w")
    ]
    return "\n".join([f"point {results.columns['point'][row]:.0f}", *lines])
