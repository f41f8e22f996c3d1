"""What would pay: the break-even line of this rotor, where the present actuator stands, and the builds nearest to it.

Worked out in the background when asked for, and kept until the design or the flight conditions are others.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from explorer.model.units import number
from explorer.tabs.background import BackgroundWork
from explorer.tabs.context import TabContext
from explorer.tabs.live_charts import chart_box
from explorer.text.glossary import hint
from explorer.workers.pool import JobEnded, JobEvent, JobProgress
from rotor.actuator import BreakEven, ConditionPair, PaySearch, Verdict, break_even, pay_sentence, what_would_pay
from rotor.actuator.pay import Candidate, search_sentence
from rotor.chart import Axis, Band, Chart, Line, Points, Series
from rotor.markup import Markup, tag
from rotor.processes import Stop, Tell

_LIMIT = 300.0
"""Longest time of a search [s], which takes ten on an idle machine."""
_KEPT_SPACE = "\u00a0"
_SHOWN = 5
"""Builds in the table."""
_START = "How far an actuator must twist this blade, and how light it must be, before it saves more than it costs."
_URGENCY = 4
"""Asked for by hand, so before the verdicts on the other actuators."""
_NO_BLADE = "This blade carries no actuator, as the sentence above says: choose the UH-60A, or change the build."
_COMPUTING = "Trimming the break-even line, then material, layers, span and stiffness…"


@dataclass(frozen=True)
class PayAnswer:
    """What the panel shows; it pickles in some kilobytes."""

    even: BreakEven
    sentences: tuple[str, ...]
    builds: tuple[Candidate, ...]


def pay_answer(pair: ConditionPair, builds: bool) -> PayAnswer:
    """The break-even line, and with `builds` the builds nearest to it.

    ValueError or RuntimeError with a sentence where there is none.
    """
    search = what_would_pay(pair, judged=0) if builds else PaySearch(break_even(pair), (), ())
    said = tuple(filter(None, (pay_sentence(search.even), search_sentence(search))))
    return PayAnswer(search.even, said, search.candidates[:_SHOWN])


@dataclass(frozen=True)
class PayTask:
    """Reports the line, then searches the builds; its result is a sentence where there is no answer."""

    pair: ConditionPair

    def run(self, tell: Tell, stop: Stop) -> PayAnswer | str:
        del stop  # Ten seconds.
        try:
            tell(pay_answer(self.pair, builds=False))
            return pay_answer(self.pair, builds=True)
        except (ValueError, RuntimeError) as error:
            return str(error)


class PayPanel(BackgroundWork):
    """One client's, where the context stands."""

    def __init__(self, context: TabContext) -> None:
        super().__init__(context.pool, context.wake, _LIMIT, _URGENCY, restarts=True)
        self._bridge = context.bridge
        self._pair: ConditionPair | None = None
        """Conditions of the design on the sliders; None where it carries no actuator."""
        self._asked: ConditionPair | None = None
        self._answer: PayAnswer | None = None
        """To what was asked last."""
        self.line = _START
        with context.gui.add_folder("What would pay"):
            button = context.gui.add_button("Find what would pay", hint=hint("what_would_pay"))
            self._html = context.gui.add_html(_small("start", _START, ".rx-dim"))
        button.on_click(lambda _: self.begin())

    def prepare(self) -> tuple[PayTask, Callable[[JobEvent], None], str]:
        """The search for the pair of conditions that is shown."""
        if self._pair is None:
            raise ValueError(_NO_BLADE)
        self._asked, self._answer = self._pair, None
        return PayTask(self._pair), partial(self._hear, self._pair), _COMPUTING

    def refresh(self, pair: ConditionPair | None, verdict: Verdict | None) -> None:
        """Follow the design; `verdict` on its actuator, once there is one."""
        self._pair = pair
        # The last sentence counts the builds that pay: it stands on the stage, as long as it is about what is shown.
        answer = self._answer if self._asked == pair else None
        self._bridge.set(pays=None if answer is None else answer.sentences[-1])
        if self._answer is not None:
            self._html.content = pay_panel(self._answer, verdict, stale=self._asked != pair)
            return
        kind = "computing" if self.running else "start" if self.line == _START else "problem"
        self._html.content = _small(kind, self.line, ".rx-dim" if kind == "start" else "")

    def _hear(self, pair: ConditionPair, news: JobEvent) -> None:
        if pair is not self._asked:
            return  # Of the search before.
        match news:
            case JobProgress(PayAnswer() as answer) | JobEnded(PayAnswer() as answer):
                self._answer = answer
            case _:
                self._ended_without(news)


def _small(kind: str, text: str, look: str = "") -> Markup:
    return tag(f"div.rx{look}.rx-small", text, data_explorer="pay", data_kind=kind)


def pay_panel(answer: PayAnswer, verdict: Verdict | None, *, stale: bool = False) -> Markup:
    """Sentences, both charts and the nearest builds."""
    lead, *more = answer.sentences
    earlier = "Of an earlier design or pair of conditions: find again."
    charts = []
    if answer.even.worthwhile:
        drawn = {"pay-mass": mass_chart(answer.even, verdict), "pay-drive": drive_chart(answer.even)}
        charts = [tag("div", chart_box(chart, _HEIGHT), data_explorer=name) for name, chart in drawn.items()]
        charts.append(tag("div.rx-dim", "Earns: what its twist saves over what it costs."))
    return tag(
        "div.rx.rx-small.rx-faded" if stale else "div.rx.rx-small",
        tag("div.rx-dim", earlier) if stale else None,
        tag("b", lead),
        [tag("div", sentence) for sentence in more],
        charts,
        _table(answer.builds),
        data_explorer="pay",
        data_kind="ready",
    )


def _table(builds: tuple[Candidate, ...]) -> Markup | None:
    if not builds:
        return None
    rows = list[Markup]()
    for build in builds:
        cells = (math.degrees(build.installed.attainable), 1), (build.mass, 0), (100.0 * build.earned, 0)
        name = build.name.replace(" × ", _KEPT_SPACE.join(("", "×", ""))).replace(" R", f"{_KEPT_SPACE}R")
        net = build.estimate.net
        numbers = [tag("td", number(value, places)) for value, places in cells]
        last = tag("td.rx-less" if net > 0.0 else "td.rxa-bad", number(1e-3 * net, 1, sign=True))
        rows.append(tag("tr", tag("td", name), numbers, last))
    heads = ("nearest builds", "°", "kg", ("earns", tag("br"), "%"), ("net", tag("br"), "kW"))
    head = tag("tr", [tag("th", head) for head in heads])
    return tag("table.rxa-table.rxa-pay", head, rows, data_explorer="pay-builds")


_LINE, _PAYS = "#1c7ed6", "#0ca678"
_HEIGHT = 130.0


def mass_chart(even: BreakEven, verdict: Verdict | None) -> Chart:
    """Break-even mass over twist, with the present actuator as a point; mass on a logarithmic scale.

    The point stands at the linear twist that saves as much over the best fixed blade as the actuator's own twist does,
    with its stiffness counted: tip twist alone does not say what a shape is worth.
    """
    largest, mass = float(even.masses[-1]), 0.0 if verdict is None else verdict.installed.masses.aircraft
    x_most = 1.08 * math.degrees(float(even.twists[-1]))
    y_range = 10.0 ** math.floor(math.log10(0.05 * largest)), 2.0 * max(mass, largest)
    fine = np.linspace(0.0, float(even.twists[-1]), 60)[1:].tolist()
    x, allowed = [*map(math.degrees, fine), x_most], [*(even.mass_allowed(twist) for twist in fine), largest]
    half = [even.mass_allowed(twist, 0.5 * even.ideal_saving) for twist in fine]
    series: list[Series] = [
        Band("pays", x, (y_range[0],) * len(x), allowed, _PAYS),
        Line("no drive power", x, allowed, _LINE),
        Line("driven", x[:-1], [mass_kg if mass_kg >= y_range[0] else math.nan for mass_kg in half], _LINE, "4 3"),
    ]
    if verdict is not None:
        name = verdict.installed.actuator.id.replace("_", " ")
        worth = math.degrees(even.twist_for(verdict.baseline.fixed.power - verdict.optimum.power))
        words = f"{name}: worth {worth:.1f}°, {mass:.0f} kg; {'pays' if verdict.net_saving > 0.0 else 'does not pay'}"
        colour = _PAYS if verdict.net_saving > 0.0 else "var(--rx-bad)"
        series.append(Points(name, (worth,), (mass or y_range[0],), colour, size=4.5, words=(words,)))
    return Chart(
        "Mass that pays",
        Axis("range of linear twist [°]", (0.0, x_most)),
        Axis("kg, all blades", y_range, log=True),
        tuple(series),
        note="Driven: half of what unlimited twist saves goes to the drive. Point: the linear twist that saves as much "
        "as this actuator, its stiffness counted.",
    )


def drive_chart(even: BreakEven) -> Chart:
    """Drive power that pays over mass, with all and with half of the twist."""
    largest, all_twist = float(even.masses[-1]), float(even.twists[-1])
    lines = list[Line]()
    for twist, dashes in ((all_twist, ""), (0.5 * all_twist, "4 3")):
        masses = np.linspace(0.0, even.mass_allowed(twist), 12)
        power = [1e-3 * even.net(twist, mass) for mass in masses.tolist()]
        lines.append(Line(f"{math.degrees(twist):.1f}°", masses, power, _LINE, dashes))
    return Chart(
        "Drive power that pays",
        Axis("mass, all blades [kg]", (0.0, 1.05 * largest)),
        Axis("kW", (0.0, 1.1e-3 * even.ideal_saving)),
        tuple(lines),
    )
