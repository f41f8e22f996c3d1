"""A step of the lecture as records: its words with the numbers filled in, and its chart, in the page's units."""

import math

from explorer.model.units import Units, number
from explorer.parts.frame import StepAnswer, StepControl, StepPart
from explorer.story.facts import StepChart, StepFacts
from explorer.story.steps import STEPS, LectureStep, angle_words, speed_words
from rotor.support.chart import Axis, Band, Chart, Line, Series, drawn_chart


def step_record(step: LectureStep, facts: StepFacts | None, units: Units) -> StepPart:
    """What is said before the guess. `facts`: None while they are computed; a sentence that needs them is empty."""
    known, text, control = None if facts is None else facts.words(units), step.text, step.control

    def filled(sentence: str) -> str:
        if known is None:
            return "" if "{" in sentence else sentence
        return sentence.format_map(known)

    return StepPart(
        name=step.name,
        title=text.title,
        watch=filled(text.watch),
        question=filled(text.question),
        options=[filled(option) for option in text.options],
        todo=filled(text.todo),
        control=StepControl(
            label=control.label,
            kind=control.kind,
            words=[stop.words for stop in facts.stops] if facts else [],
        ),
        last=step is STEPS[-1],
    )


def answer_record(step: LectureStep, facts: StepFacts, units: Units) -> StepAnswer:
    """What is said after it, with the chart in the page's units."""
    chart = facts.chart
    unit = units.power[0]
    ways = {
        "power": (unit.size, f" [{unit.symbol}]"),
        "percent": (0.01, " [%]"),
        "angle": (1.0, ""),
    }
    size, symbol = ways[chart.kind]
    wide = 100.0 if chart.x_kind == "signed" else 1.0
    x = [wide * value for value in chart.x]
    names = {line.name: "" if len(chart.lines) < 2 else line.name for line in chart.lines}
    dots = len(x) < 7 and len(chart.lines) == 1
    series = list[Series]()
    for line in chart.lines:
        y = [math.nan if value is None else value / size for value in line.y]
        dashed = line.colour in ("a", "limit")
        series.append(Line(names[line.name], x, y, _colour(line.colour), dashed, 2.4, dots=dots))
    if chart.band is not None:
        low, high = ([y / size for y in edge] for edge in chart.band)
        series.insert(0, Band("", x, low, high, _colour("accent")))
    ends = (chart.x[0], chart.x[-1])
    x_title = chart.x_title + (" [%]" if chart.x_kind == "signed" else "")
    words = tuple(_x_words(chart, end) for end in ends)
    x_axis = Axis(x_title, (x[0], x[-1]), (x[0], x[-1]), words)
    colours = [_colour(dot) for dot in chart.dots or [line.colour for line in chart.lines]]
    return StepAnswer(
        right=facts.right,
        open=facts.open,
        answer=step.text.answer.format_map(facts.words(units)),
        chart=drawn_chart(Chart(chart.y_title + symbol, x_axis, Axis(), tuple(series))),
        dots=[
            [
                (round(wide * at, 4), round(y / size, 4), colour)
                for (at, y), colour in zip(stop.dots, colours, strict=False)
            ]
            for stop in facts.stops
        ],
    )


_ROLES = {"a": "pinned", "b": "blade", "limit": "overlay", "total": "ink"}
"""Roles of colours on the page, by what a line of the lecture is."""


def _colour(name: str) -> str:
    return f"var(--rx-{_ROLES.get(name, name)})"


def _x_words(chart: StepChart, x: float) -> str:
    if chart.x_kind == "mu":
        return speed_words(x)
    return (
        angle_words(x).removesuffix("/R")
        if chart.x_kind == "rate"
        else f"{number(100.0 * x, 1, sign=True)} %"
    )
