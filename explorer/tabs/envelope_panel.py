"""The flight envelope of the design on the sliders: largest load factor over speed.

It is found when asked for, and from then on again whenever the sliders have come to rest.
"""

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from explorer.charts.strip import LOOKS, now_dot, role_line
from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.tabs.background import BackgroundWork
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.live_charts import chart_box
from explorer.text.glossary import hint
from rotor import Design, envelope
from rotor.chart import Axis, Chart, Line, Rule
from rotor.markup import Markup, tag
from rotor.processes import JobEnded, JobEvent, JobProgress
from rotor.study.envelope import SPEEDS, Envelope, EnvelopePoint, Reach, limit_line
from rotor.units import KNOT
from rotor.worker_process import Stop, Tell

_LIMIT = 600.0
"""Longest time of an envelope [s], which takes half a minute on an idle machine."""
_URGENCY = 3
_REST = 1.5
"""How long the design has to rest before its envelope is found again [s]."""
_START = "The largest load factor of a steady turn at each speed, by stall and by the engines."


@dataclass(frozen=True)
class EnvelopeTask:
    """Reports each point, then the whole; a sentence where there is none."""

    design: Design
    moving: bool = False
    """With the best linear twist of each speed in place of the design's."""

    def run(self, tell: Tell, stop: Stop) -> Envelope | str:
        def heard(point: EnvelopePoint) -> None:
            tell(point)
            if stop():
                raise RuntimeError("Stopped.")

        try:
            return envelope(self.design, moving=self.moving, tell=heard)
        except (ValueError, RuntimeError) as error:
            return str(error)


class EnvelopePanel(BackgroundWork, Tab):
    """One client's, where the context stands."""

    def __init__(self, context: TabContext) -> None:
        super().__init__(context.pool, context.wake, _LIMIT, _URGENCY, restarts=True)
        self._design: Design | None = None
        """On the sliders, at load factor 1; None without a trim."""
        self._mu = self._now = 0.0
        self._asked: EnvelopeTask | None = None
        self._awaited: EnvelopeTask | None = None
        """What the design on the sliders asks for; it may not have rested yet."""
        self._timer: threading.Timer | None = None
        self._points: tuple[EnvelopePoint, ...] = ()
        self._whole: Envelope | None = None
        self._earlier: Envelope | None = None
        self.line = _START
        with context.gui.add_folder("Flight envelope"):
            button = context.gui.add_button("Find envelope", hint=hint("envelope"))
            self._moving = context.gui.add_checkbox("Best twist of each speed", False, hint=hint("envelope_moving"))
            self._html = context.gui.add_html("")
        button.on_click(lambda _: self.begin())
        self._moving.on_update(lambda _: self._follow())
        self._draw()

    def prepare(self) -> tuple[EnvelopeTask, Callable[[JobEvent], None], str]:
        """The envelope of the design that is shown; the last one stays beside it."""
        task = self._task()
        if task is None:
            raise ValueError("An envelope is of flight: show a design in flight that trims.")
        self._earlier, self._whole, self._points = self._whole or self._earlier, None, ()
        self._asked = task
        return task, partial(self._hear, task), "Looking for the limits at µ 0 …"

    def show(self, state: SessionState) -> None:
        design = state.solution.design
        condition = design.condition
        self._mu, self._now = condition.advance_ratio, condition.load_factor
        flies = condition.stand is None
        self._design = replace(design, condition=replace(condition, load_factor=1.0)) if flies else None
        self._follow()
        self._draw()

    def show_failure(self) -> None:
        self._design = None
        self._draw()

    def stop(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        BackgroundWork.stop(self)

    def _task(self) -> EnvelopeTask | None:
        return None if self._design is None else EnvelopeTask(self._design, self._moving.value)

    def _follow(self) -> None:
        """Where an envelope was found before, find that of another design once it rests."""
        task = self._task()
        if task == self._awaited:
            return
        self._awaited = task
        if self._timer is not None:
            self._timer.cancel()
        if self._asked is not None and task is not None and self._at_rest(task) != self._at_rest(self._asked):
            self._timer = threading.Timer(_REST, self.begin)
            self._timer.daemon = True
            self._timer.start()

    def _hear(self, task: EnvelopeTask, news: JobEvent) -> None:
        if task is not self._asked:
            return  # Of the one before.
        match news:
            case JobProgress(EnvelopePoint() as point):
                self._points = (*self._points, point)
                further = [speed for speed in SPEEDS if speed > point.mu]
                self.line = f"Looking for the limits at µ {further[0]:g} …" if further else "Top speed and ceiling …"
            case JobEnded(Envelope() as whole):
                self._whole, self.line = whole, ""
            case _:
                self._ended_without(news)
        self._draw()

    def _draw(self) -> None:
        task = self._task()
        stale = bool(self._points) and (task is None or self._at_rest(self._asked) != self._at_rest(task))
        drawn = [tag("div.rx-dim", "Of an earlier design: found again once this one rests.")] if stale else []
        if self._points:
            top = None if self._whole is None else self._whole.top_speed
            chart = envelope_chart(self._points, self._earlier, self._mu, self._now, top)
            drawn.append(tag("div", chart_box(chart, 130.0), data_explorer="envelope-chart"))
        if self.line:
            drawn.append(tag("div.rx-dim", self.line))
        if self._whole is not None:
            drawn += [tag("div", words) for words in envelope_words(self._whole)]
        self._html.content = tag("div.rx.rx-small", drawn, data_explorer="envelope")

    @staticmethod
    def _at_rest(task: EnvelopeTask | None) -> EnvelopeTask | None:
        """Without its speed, which moves the ceiling alone."""
        return None if task is None else replace(task, design=task.design.at(hover=True))


def envelope_chart(
    points: tuple[EnvelopePoint, ...], earlier: Envelope | None, mu: float, now: float, top: Reach | None = None
) -> Chart:
    """Largest load factor by stall and by engines, the earlier of two designs grey, and the design itself as a dot."""

    def lines(of: tuple[EnvelopePoint, ...], reaches: Reach | None, colour: str, before: str) -> list[Line]:
        return [
            replace(
                role_line("this", *limit_line(of, name, reaches), label=f"{before}{name}"),
                colour=colour, width=1.6 if before else 2.1, dashes=dashes,
            )
            for name, dashes in (("stall", ""), ("engines", "5 3"))
        ]  # fmt: skip

    drawn = [] if earlier is None else lines(earlier.points, earlier.top_speed, LOOKS["earlier"][0], "before: ")
    drawn += lines(points, top, LOOKS["this"][0], "")
    seen = [value for line in drawn for value in line.y if value == value]
    return Chart(
        "Load factor",
        Axis("µ", (0.0, SPEEDS[-1])),
        Axis("n", (0.0, max(2.2, *seen, now))),
        (*drawn, now_dot(mu, now)),
        (Rule(1.0, along="y"),),
        note="Of a steady turn at the propulsive force of straight flight; the lower of both lines counts.",
    )


def envelope_words(curve: Envelope) -> list[Markup]:
    """Top speed, ceiling and largest mass in a line each."""

    def said(reach: Reach, shown: Callable[[float], str]) -> str:
        return "no limit found" if reach.value is None else f"{shown(reach.value)} by {reach.limit}"

    knots = curve.design.rotor.tip_speed / KNOT
    best = max(curve.points, key=lambda point: point.mass_kg or 0.0)
    mu = curve.design.condition.advance_ratio
    return [
        tag("span", f"Top speed {said(curve.top_speed, lambda value: f'{number(knots * value)} kt (µ {value:.3f})')}."),
        tag("span", f"Ceiling {said(curve.ceiling, lambda value: f'{number(value)} m')} at µ {mu:g}."),
        tag("span", f"Largest mass {number(best.mass_kg or 0.0)} kg, at µ {best.mu:g}."),
        tag("span.rx-dim", "Engines as at sea level, without losses: upper bounds."),
    ]
