"""A study and one of its points in words."""

import math
from html import escape

from explorer.tabs.studies import charts
from explorer.text.units import number
from rotor.study.results import Results


def summary(results: Results) -> str:
    """What was opened: title, points, failures, how many are drawn."""
    failed = results.rows - int(results.good.sum())
    words = [f"{number(results.rows)} of {number(results.points)} points"]
    if failed:
        words.append(f"{number(failed)} failed")
    if results.rows - failed > charts.MOST_POINTS:
        words.append(f"{number(charts.MOST_POINTS)} drawn")
    return f"{results.about.get('title', '')}: {', '.join(words)}."


def numbers(results: Results) -> str:
    """The numbers of the available points."""
    points = results.columns["point"]
    gaps = ", some not computed yet" if points[-1] - points[0] >= results.rows else ""
    return f"{points[0]:.0f}…{points[-1]:.0f}{gaps}"


def point_line(results: Results, row: int | None, heading: str) -> str:
    """A small table of a point: power, and the value of every axis."""
    if row is None:
        return ""
    names = [
        name for name in dict.fromkeys(("power_total_w", "hover_power_w", *results.axes)) if name in results.columns
    ]
    cells = "".join(_line(results, name, row) for name in names)
    head = f"<b>{escape(heading)}: point {results.columns['point'][row]:.0f}</b>"
    return f'<div class="rx rx-small" data-explorer="study-point">{head}<table>{cells}</table></div>'


def _blank(results: Results, name: str, row: int) -> bool:
    return results.numeric(name) and not math.isfinite(results.columns[name][row])


def problem_line(sentence: str) -> str:
    """Why the requested point cannot be shown."""
    return f'<div class="rx rx-small rx-broken" data-explorer="study-point">{escape(sentence)}</div>'


def _line(results: Results, name: str, row: int) -> str:
    value = (
        charts.plain(charts.shown(results, name)[row])
        if results.numeric(name)
        else escape(str(results.columns[name][row]))
    )
    return f'<tr><td>{escape(charts.title(results, name))}</td><td class="rx-num">{value}</td></tr>'
