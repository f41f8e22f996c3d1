"""What the page and the file get of a step: its words with their numbers filled in, its chart in the page's units."""

from collections.abc import Sequence
from typing import Any

from explorer.model.units import Unit, Units, number
from explorer.story.facts import ChartLine, Facts, StepChart
from explorer.story.steps import STEPS, LectureStep, angle_words, speed_words

_AWAITED = "…"
"""In place of a number that is still computed."""


class _Awaited(dict[str, str]):
    def __missing__(self, name: str) -> str:
        return _AWAITED


def step_record(step: LectureStep, facts: Facts | None, units: Units) -> dict[str, Any]:
    """What is said before the guess; `facts`: None while they are computed."""
    said, text, control = _words(facts, units), step.text, step.control
    return {
        "name": step.name,
        "title": text.title,
        "watch": text.watch.format_map(said),
        "a": text.a.format_map(said),
        "b": text.b.format_map(said),
        "question": text.question.format_map(said),
        "options": [option.format_map(said) for option in text.options],
        "todo": text.todo.format_map(said),
        "control": {"label": control.label, "kind": control.kind, "words": [stop.words for stop in facts.stops]}
        if facts
        else {"label": control.label, "kind": control.kind, "words": []},
        "last": step is STEPS[-1],
    }


def answer_record(step: LectureStep, facts: Facts, units: Units) -> dict[str, Any]:
    """What is said after it."""
    return {
        "right": facts.right,
        "answer": step.text.answer.format_map(_words(facts, units)),
        "chart": chart_record(facts, units),
    }


def chart_record(facts: Facts, units: Units) -> dict[str, Any]:
    """The chart in numbers of its axes' units; `dots`: by position of the control, in the order of the lines."""
    chart = facts.chart
    size, symbol = _y_unit(chart, units)
    wide = 100.0 if chart.x_kind == "signed" else 1.0

    def scaled(values: Sequence[float | None]) -> list[float | None]:
        return [None if value is None else round(value / size, 4) for value in values]

    return {
        "x": [round(wide * x, 4) for x in chart.x],
        "x_title": chart.x_title + (" [%]" if chart.x_kind == "signed" else ""),
        "x_ends": [_x_words(chart, x) for x in (chart.x[0], chart.x[-1])],
        "y_title": chart.y_title + symbol,
        "lines": [_line(line, scaled(line.y)) for line in chart.lines],
        "band": None if chart.band is None else [scaled(edge) for edge in chart.band],
        "dot_colours": chart.dots or [line.colour for line in chart.lines],
        "dots": [[[round(wide * x, 4), round(y / size, 4)] for x, y in stop.dots] for stop in facts.stops],
    }


def _line(line: ChartLine, y: list[float | None]) -> dict[str, Any]:
    return {"name": line.name, "colour": line.colour, "y": y}


def _y_unit(chart: StepChart, units: Units) -> tuple[float, str]:
    if chart.kind == "power":
        unit: Unit = units.power[0]
        return unit.size, f" [{unit.symbol}]"
    return (0.01, " [%]") if chart.kind == "percent" else (1.0, "")


def _x_words(chart: StepChart, x: float) -> str:
    if chart.x_kind == "mu":
        return speed_words(x)
    return angle_words(x).removesuffix("/R") if chart.x_kind == "rate" else f"{number(100.0 * x, 1, sign=True)} %"


def _words(facts: Facts | None, units: Units) -> dict[str, str]:
    return _Awaited({} if facts is None else facts.words(units))
