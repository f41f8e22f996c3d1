"""The flight envelope of the design on the sliders: largest load factor over speed, worked out when asked for."""

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
from explorer.workers.pool import JobEnded, JobEvent, JobProgress
from rotor import Design, envelope
from rotor.chart import Axis, Chart, Line, Rule
from rotor.markup import Markup, tag
from rotor.processes import Stop, Tell
from rotor.study.envelope import SPEEDS, Envelope, EnvelopePoint, Reach
from rotor.units import KNOT

_LIMIT = 600.0
"""Longest time of an envelope [s], which takes half a minute on an idle machine."""
_URGENCY = 3
_START = "The largest load factor of a steady turn at each speed, by stall and by the engines."


@dataclass(frozen=True)
class EnvelopeTask:
    """Reports each point, then the whole; a sentence where there is none."""

    design: Design

    def run(self, tell: Tell, stop: Stop) -> Envelope | str:
        def heard(point: EnvelopePoint) -> None:
            tell(point)
            if stop():
                raise RuntimeError("Stopped.")

        try:
            return envelope(self.design, tell=heard)
        except (ValueError, RuntimeError) as error:
            return str(error)


class EnvelopePanel(BackgroundWork, Tab):
    """One client's, where the context stands."""

    def __init__(self, context: TabContext) -> None:
        super().__init__(context.pool, context.wake, _LIMIT, _URGENCY, restarts=True)
        self._design: Design | None = None
        """On the sliders, at load factor 1; None without a trim."""
        self._mu = self._now = 0.0
        self._asked: Design | None = None
        self._points: tuple[EnvelopePoint, ...] = ()
        self._whole: Envelope | None = None
        self._earlier: Envelope | None = None
        self.line = _START
        with context.gui.add_folder("Flight envelope"):
            button = context.gui.add_button("Find envelope", hint=hint("envelope"))
            self._html = context.gui.add_html("")
        button.on_click(lambda _: self.begin())
        self._draw()

    def prepare(self) -> tuple[EnvelopeTask, Callable[[JobEvent], None], str]:
        """The envelope of the design that is shown; the last one stays beside it."""
        if self._design is None:
            raise ValueError("An envelope is of flight: show a design in flight that trims.")
        self._earlier, self._whole, self._points = self._whole or self._earlier, None, ()
        self._asked = self._design
        return EnvelopeTask(self._design), partial(self._hear, self._design), "Looking for the limits at µ 0 …"

    def show(self, state: SessionState) -> None:
        design = state.solution.design
        condition = design.condition
        self._mu, self._now = condition.advance_ratio, condition.load_factor
        flies = condition.stand is None
        self._design = replace(design, condition=replace(condition, load_factor=1.0)) if flies else None
        self._draw()

    def show_failure(self) -> None:
        self._design = None
        self._draw()

    def stop(self) -> None:
        BackgroundWork.stop(self)

    def _hear(self, design: Design, news: JobEvent) -> None:
        if design is not self._asked:
            return  # Of the one before.
        match news:
            case JobProgress(EnvelopePoint() as point):
                self._points = (*self._points, point)
                further = [speed for speed in SPEEDS if speed > point.mu]
                self.line = f"Looking for the limits at µ {further[0]:g} …" if further else "Top speed and ceiling …"
            case JobEnded(Envelope() as found):
                self._whole, self.line = found, ""
            case _:
                self._ended_without(news)
        self._draw()

    def _draw(self) -> None:
        stale = bool(self._points) and self._at_rest(self._asked) != self._at_rest(self._design)
        drawn = [tag("div.rx-dim", "Of an earlier design: find again.")] if stale else []
        if self._points:
            chart = envelope_chart(self._points, self._earlier, self._mu, self._now)
            drawn.append(tag("div", chart_box(chart, 130.0), data_explorer="envelope-chart"))
        if self.line:
            drawn.append(tag("div.rx-dim", self.line))
        if self._whole is not None:
            drawn += [tag("div", words) for words in envelope_words(self._whole)]
        self._html.content = tag("div.rx.rx-small", drawn, data_explorer="envelope")

    @staticmethod
    def _at_rest(design: Design | None) -> Design | None:
        """Without its speed, which moves the ceiling alone."""
        return None if design is None else design.at(hover=True)


def envelope_chart(points: tuple[EnvelopePoint, ...], earlier: Envelope | None, mu: float, now: float) -> Chart:
    """Largest load factor by stall and by engines, the earlier of two designs grey, and the design itself as a dot."""

    def lines(of: tuple[EnvelopePoint, ...], colour: str, name: str) -> list[Line]:
        mus = [point.mu for point in of]
        stall, engines = (
            [float("nan") if value is None else value for value in values]
            for values in zip(*((point.load_factor.stall, point.load_factor.engines) for point in of), strict=True)
        )
        width = 1.6 if name else 2.1
        return [
            replace(role_line("this", mus, stall, label=f"{name}stall"), colour=colour, width=width),
            replace(role_line("this", mus, engines, label=f"{name}engines"), colour=colour, width=width, dashes="5 3"),
        ]

    drawn = [] if earlier is None else lines(earlier.points, LOOKS["earlier"][0], "before: ")
    drawn += lines(points, LOOKS["this"][0], "")
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
