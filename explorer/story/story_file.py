"""A step as records for the page and the file, and `python -m explorer story FILE`: the lecture as one HTML file.

The records have the words of a step with their numbers filled in, and its chart in the page's units.

The file is viser's viewer with two rotors at one place, A and B, every state computed beforehand, and the steps of the
page beside it: the guess, its answer, the control, the handle between A and B. It requests nothing from any host.
"""

import argparse
import math
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from explorer import web
from explorer.colours import colour_map, css
from explorer.export.provenance import PROGRAM, versions
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.units import UNITS, Units, number
from explorer.parts.frame import StepAnswer, StepControl, StepPart
from explorer.picture.blade_mesh import blade_shape
from explorer.picture.camera_views import Covered, between_cards
from explorer.picture.fields import FIELDS, Field, usual_range
from explorer.scene.controller import SURFACES, TURN_RATE
from explorer.scene.scene import COMPARED, ROTOR
from explorer.scene.still_scene import embedded_viewer, point_record, shape_record, still_page
from explorer.story.facts import StepChart, StepFacts, facts_of
from explorer.story.steps import STEPS, LectureStep, angle_words, compared_quantities, speed_words, view_of
from rotor import Solution, solve
from rotor.support.chart import Axis, Band, Chart, Line, Series, bar_ticks, drawn_chart
from rotor.support.markup import end_of, with_title
from rotor.support.progress import ProgressBar
from rotor.support.terminal import OneLineParser, command_words, run_command
from rotor.support.user_input import check_writable, write_whole

_ASPECTS = (0.6, 0.8, 1.0, 1.2, 1.4, 1.7, 2.1)
"""Widths over heights of the canvas that cameras are fitted to; the file takes the next smaller one."""
_COVER = Covered(0.06, 0.2)
_COLOURS = 17


def step_record(step: LectureStep, facts: StepFacts | None, units: Units) -> StepPart:
    """What is said before the guess. `facts`: None while they are computed; a sentence that needs them is empty."""
    known, text, control = None if facts is None else facts.words(units), step.text, step.control

    def said(sentence: str) -> str:
        if known is None:
            return "" if "{" in sentence else sentence
        return sentence.format_map(known)

    return StepPart(
        name=step.name,
        title=text.title,
        watch=said(text.watch),
        a=said(text.a),
        b=said(text.b),
        question=said(text.question),
        options=[said(option) for option in text.options],
        todo=said(text.todo),
        control=StepControl(
            label=control.label, kind=control.kind, words=[stop.words for stop in facts.stops] if facts else []
        ),
        last=step is STEPS[-1],
    )


def answer_record(step: LectureStep, facts: StepFacts, units: Units) -> StepAnswer:
    """What is said after it, with the chart in the page's units."""
    chart = facts.chart
    unit = units.power[0]
    ways = {"power": (unit.size, f" [{unit.symbol}]"), "percent": (0.01, " [%]"), "angle": (1.0, "")}
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
    return angle_words(x).removesuffix("/R") if chart.x_kind == "rate" else f"{number(100.0 * x, 1, sign=True)} %"


def story_html(
    steps: Sequence[LectureStep] = STEPS,
    view: ViewState | None = None,
    quiet: bool = True,
    tell: Callable[[int], None] = lambda done: None,
) -> str:
    """The file's text. `view`: its units and whether it is dark; `tell` hears how many steps are done.

    RuntimeError with a sentence where a design of a step does not trim.
    """
    view, points = view or ViewState(), _Points()
    told = list[dict[str, Any]]()
    shown: Iterable[LectureStep] = ProgressBar(steps, disable=quiet, leave=False)
    for step in shown:
        told.append(_step(step, facts_of(step), replace(view_of(step, view), wake=False), points))
        tell(len(told))
    first = points.solutions[told[0]["stops"][0]["b"]]
    record = {
        "steps": told,
        "points": points.records,
        **shape_record(blade_shape(first.design.rotor)),
        "surfaces": SURFACES,
        "rate": TURN_RATE / 3.0,
    }
    field = FIELDS[steps[0].field]
    opening = replace(view_of(steps[0], view), wake=False)
    page = still_page(first, opening, usual_range(field, first.design.rotor), compared=first)
    viewer = embedded_viewer([page])
    page = viewer.before + viewer.scenes[0] + viewer.between + ("true" if view.dark else "false") + viewer.after
    words = {
        "styles": web.styles("frame.css", "story.css", "small.css"),
        "note": f"Computed by {PROGRAM} {versions()[PROGRAM]}. Forward flight: a model, not a measurement.",
        "column": web.text("column.html"),
        "stage": web.text("wipe.html"),
        "data": web.json_block("story-data", record),
        "scripts": web.scripts(
            *("common.js", "chart.js", "scene.js", "still_rotor.js", "wipe.js", "story.js", "story_file.js")
        ),
    }
    page, front = with_title(page, "Rotor explorer: lecture", web.policy()), web.fill("story.html", words)
    body = page.rindex(end_of("body"))
    return f"{page[:body]}{front}{page[body:]}"


class _Points:
    """Trims of the file, each once for a rotor and a field."""

    def __init__(self) -> None:
        self.records: list[dict[str, Any]] = []
        self.solutions: list[Solution] = []
        self._known: dict[tuple[object, ...], int] = {}

    def add(self, inputs: Inputs, view: ViewState, field: Field, root: str, start: Solution | None) -> int:
        """Number of a design's record; RuntimeError where it does not trim."""
        design = inputs.design()
        key = design, view, field.title, root
        if key not in self._known:
            solution = solve(design, start).require()
            shape, colours = blade_shape(design.rotor), usual_range(field, design.rotor)
            self._known[key] = len(self.records)
            self.records.append(point_record(solution, shape, view, colours, root))
            self.solutions.append(solution)
        return self._known[key]


def _step(step: LectureStep, facts: StepFacts, view: ViewState, points: _Points) -> dict[str, Any]:
    units, field = UNITS[view.units], FIELDS[step.field]
    stops, before = list[dict[str, Any]](), None
    for stop in facts.stops:
        b = points.add(stop.inputs, view, field, ROTOR, before)
        before = points.solutions[b]
        a = None if stop.against is None else points.add(stop.against, view, field, COMPARED, before)
        reference = solve(baseline_of(before.design)).require() if a is None else points.solutions[a]
        values = {**facts.words(units), **compared_quantities(before, reference, units)}
        stops.append({"b": b, "a": a, "figures": [(caption, values[name]) for name, caption in step.figures]})
    rotor = points.solutions[stops[0]["b"]].design.rotor
    cameras = [
        (aspect, between_cards(step.shot.fit(rotor.radius, aspect / _COVER.free), _COVER)) for aspect in _ASPECTS
    ]
    return {
        **vars(step_record(step, facts, units)),
        **vars(answer_record(step, facts, units)),
        "start": step.control.start,
        "stops": stops,
        "scale": {
            "title": field.title,
            "unit": field.unit,
            "ticks": bar_ticks(*usual_range(field, rotor)),
            "colours": [css(colour) for colour in colour_map(field.colours, _COLOURS).tolist()],
        },
        # By width over height of the canvas: position and the point looked at [m].
        "cameras": [(aspect, at.position.round(3).tolist(), at.look_at.round(3).tolist()) for aspect, at in cameras],
    }


@dataclass(frozen=True)
class StoryTask:
    """The file as a task of a worker process. It pickles."""

    view: ViewState

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> str:
        """The file's text, told by the number of steps done; RuntimeError where a design does not trim."""
        del stop  # A minute; nothing of it is of use before the end.
        return story_html(view=self.view, tell=tell)


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the file is written, 2 for bad input."""
    return run_command("explorer story", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    target = Path(options.out) / "story.html" if Path(options.out).is_dir() else Path(options.out)
    check_writable(target)  # Not after a minute.
    text = story_html(view=ViewState(dark=options.dark, units=options.units), quiet=not sys.stderr.isatty())
    try:
        write_whole(target, text)
    except OSError as error:
        raise ValueError(f"cannot write {str(target)!r} ({error.strerror}): give a writable file") from None
    print(f"{target}: {len(STEPS)} steps, {target.stat().st_size / 1e6:.1f} MB")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=command_words("explorer", "rotor-explorer") + " story",
        description="Write the lecture as one HTML file that needs no server: ten questions with a rotor to drag.",
        examples=(("For a dark room", "lecture.html --dark"),),
    )
    parser.add_argument("out", metavar="FILE", help="file to write, or a folder for story.html")
    parser.add_argument("--dark", action="store_true", help="dark colours")
    parser.add_argument(
        "--units", default=ViewState.units, choices=tuple(UNITS), help="units of the numbers (default %(default)s)"
    )
    return parser
