"""`python -m explorer story FILE`: the lecture as one HTML file without a server, every state computed beforehand.

The file is viser's viewer with two rotors at one place, A and B, and the steps of the page beside it: the guess, its
answer, the control, the handle between A and B. It requests nothing from any host.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from tqdm import tqdm

from explorer import web
from explorer.colours import colour_map, css
from explorer.export.demo import point_record, shape_record, write_page
from explorer.export.provenance import PROGRAM, versions
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.units import UNITS, Units
from explorer.picture.blade_mesh import blade_shape
from explorer.picture.camera_views import Cover, between_cards
from explorer.picture.fields import FIELDS, Field, usual_range
from explorer.scene.controller import SURFACES, TURN_RATES
from explorer.scene.scene import COMPARED, ROTOR
from explorer.scene.still_scene import embedded_viewer, still_page
from explorer.story.facts import Facts, facts_of
from explorer.story.steps import STEPS, LectureStep, quantities, view_of
from explorer.story.telling import answer_record, step_record
from rotor import Rotor, Solution, solve
from rotor.line_chart import round_ticks, tick_text
from rotor.terminal import run_command

_ASPECTS = (0.6, 0.8, 1.0, 1.2, 1.4, 1.7, 2.1)
"""Widths over heights of the canvas that cameras are fitted to; the file takes the next smaller one."""
_COVER = Cover(0.06, 0.2)
_COLOURS = 17


def story_html(steps: Sequence[LectureStep] = STEPS, view: ViewState | None = None, quiet: bool = True) -> str:
    """The file's text; `view`: its units and whether it is dark.

    RuntimeError with a sentence where a design of a step does not trim.
    """
    view, points = view or ViewState(), _Points()
    told = list[dict[str, Any]]()
    for step in tqdm(steps, disable=quiet, leave=False):
        told.append(_step(step, facts_of(step), replace(view_of(step, view), wake=False), points))
    first = points.solutions[told[0]["stops"][0]["b"]]
    record = {
        "steps": told,
        "points": points.records,
        **shape_record(blade_shape(first.design.rotor)),
        "surfaces": SURFACES,
        "rate": TURN_RATES["slow"],
    }
    field = FIELDS[steps[0].field]
    opening = replace(view_of(steps[0], view), wake=False)
    page = still_page(first, opening, usual_range(field, first.design.rotor), compared=first)
    viewer = embedded_viewer([page])
    page = viewer.before + viewer.scenes[0] + viewer.between + ("true" if view.dark else "false") + viewer.after
    words = {
        "styles": web.styles("frame.css", "story.css"),
        "note": escape(f"Computed by {PROGRAM} {versions()[PROGRAM]}. Forward flight is a model, not a measurement."),
        "column": web.text("column.html"),
        "stage": web.text("wipe.html"),
        "data": web.json_block("story-data", record),
        "scripts": web.scripts("scene.js", "still_rotor.js", "wipe.js", "story.js", "story_file.js"),
    }
    front = web.fill("story.html", words)
    body = page.rindex("</body>")
    return page[:body] + front + page[body:]


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


def _step(step: LectureStep, facts: Facts, view: ViewState, points: _Points) -> dict[str, Any]:
    """One step with all its states."""
    units, field = UNITS[view.units], FIELDS[step.field]
    stops, before = list[dict[str, Any]](), None
    for stop in facts.stops:
        b = points.add(stop.inputs, view, field, ROTOR, before)
        before = points.solutions[b]
        a = None if stop.against is None else points.add(stop.against, view, field, COMPARED, before)
        reference = solve(baseline_of(before.design)).require() if a is None else points.solutions[a]
        stops.append({"b": b, "a": a, "figures": _figures(step, before, reference, facts, units)})
    rotor = points.solutions[stops[0]["b"]].design.rotor
    return {
        **step_record(step, facts, units),
        **answer_record(step, facts, units),
        "start": step.control.start,
        "stops": stops,
        "scale": _scale(field, rotor),
        "cameras": _cameras(step, rotor.radius),
    }


def _figures(step: LectureStep, b: Solution, a: Solution, facts: Facts, units: Units) -> list[tuple[str, str]]:
    values = {**facts.words(units), **quantities(b, a, units)}
    return [(caption, values[name]) for name, caption in step.figures]


def _scale(field: Field, rotor: Rotor) -> dict[str, Any]:
    """The colour bar."""
    low, high = usual_range(field, rotor)
    ticks = [[round(100.0 * (at - low) / (high - low), 2), tick_text(at)] for at in round_ticks(low, high, 5)]
    colours = [css(colour) for colour in colour_map(field.colours, _COLOURS).tolist()]
    return {"title": field.title, "unit": field.unit, "ticks": ticks, "colours": colours}


def _cameras(step: LectureStep, radius: float) -> list[tuple[float, list[float], list[float]]]:
    """By width over height of the canvas: position and the point looked at [m]."""
    fitted = [(aspect, between_cards(step.shot.fit(radius, aspect / _COVER.free), _COVER)) for aspect in _ASPECTS]
    return [(aspect, camera.position.round(3).tolist(), camera.look_at.round(3).tolist()) for aspect, camera in fitted]


@dataclass(frozen=True)
class StoryTask:
    """The file as a task of a worker process. It pickles."""

    view: ViewState

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> str:
        """The file's text; RuntimeError where a design of the lecture does not trim."""
        del tell, stop  # A minute; nothing of it is of use before the end.
        return story_html(view=self.view)


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the file is written, 2 for bad input."""
    return run_command("explorer story", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    text = story_html(view=ViewState(dark=options.dark, units=options.units), quiet=not sys.stderr.isatty())
    return write_page(options.out, "story.html", text, f"{len(STEPS)} steps")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m explorer story",
        description="The lecture as one HTML file without a server: ten steps with guess, answer and control.",
    )
    parser.add_argument("out", metavar="FILE", help="where to write; in a folder, its story.html")
    parser.add_argument("--dark", action="store_true", help="for a dark room")
    parser.add_argument("--units", default=ViewState.units, choices=tuple(UNITS), help="default %(default)s")
    return parser
