"""What would pay: the break-even line of this rotor, where the present actuator stands, and the builds nearest to it.

Worked out in the background when asked for, and kept until the design or the flight conditions are others.
"""

import math
from dataclasses import dataclass

import numpy as np

from explorer.model.units import number
from explorer.tabs.actuator.actuator_tasks import Call, PoolAnswers
from explorer.tabs.context import TabContext
from explorer.tabs.live_charts import chart_box
from explorer.text.glossary import hint
from rotor.actuator import BreakEven, ConditionPair, PaySearch, Verdict, break_even, pay_sentence, what_would_pay
from rotor.actuator.pay import Candidate, search_sentence
from rotor.chart import Axis, Band, Chart, Line, Points, Series
from rotor.markup import Markup, tag

_LIMIT = 300.0
"""Of a search [s], which takes ten on an idle machine."""
_KEPT_SPACE = "\u00a0"
_SHOWN = 5
"""Builds in the table."""
_START = "How far an actuator must twist this blade, and how light it must be, before it saves more than it costs."
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


def pay_tasks(pair: ConditionPair) -> tuple[Call, Call]:
    """The line alone, which comes first, and all of the answer."""
    return Call(pay_answer, (pair, False)), Call(pay_answer, (pair, True))


class PayPanel:
    """One client's, where the context stands."""

    def __init__(self, context: TabContext) -> None:
        # Asked for by hand, so before the verdicts on the other actuators.
        self._answers = PoolAnswers(context.pool, 4, context.wake, _LIMIT)
        self._asked: ConditionPair | None = None
        self._wanted = False
        self._context = context
        with context.gui.add_folder("What would pay"):
            self._button = context.gui.add_button("Find what would pay", hint=hint("what_would_pay"))
            self._html = context.gui.add_html(str(_small("start", _START, ".rx-dim")))
        self._button.on_click(lambda _: self._ask())

    def show(self, pair: ConditionPair, verdict: Verdict | None) -> None:
        """Follow the design; `verdict` on its actuator, once there is one."""
        if self._wanted:
            self._wanted, self._asked = False, pair
            self._answers.ask(pay_tasks(pair), 0.0)
        asked = self._asked
        if asked is None:
            return
        line_alone, answer = (self._answers.answer(task) for task in pay_tasks(asked))
        if not isinstance(answer, PayAnswer):
            answer = line_alone or answer
        if isinstance(answer, PayAnswer):
            self._html.content = pay_panel(answer, verdict, stale=asked != pair)
        else:
            self._html.content = _small("computing" if answer is None else "problem", answer or _COMPUTING)

    def stop(self) -> None:
        """The browser has left."""
        self._answers.stop()

    def _ask(self) -> None:
        """On a thread of viser's: the question is put when the design is known, by `show`."""
        self._wanted = True
        self._context.wake()


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
        [tag("div", one) for one in more],
        charts,
        _table(answer.builds),
        data_explorer="pay",
        data_kind="ready",
    )


def _table(builds: tuple[Candidate, ...]) -> Markup | None:
    if not builds:
        return None
    rows = list[Markup]()
    for one in builds:
        cells = (math.degrees(one.installed.attainable), 1), (one.mass, 0), (100.0 * one.earned, 0)
        name = one.name.replace(" × ", _KEPT_SPACE.join(("", "×", ""))).replace(" R", f"{_KEPT_SPACE}R")
        net = one.estimate.net
        numbers = [tag("td", number(value, places)) for value, places in cells]
        last = tag("td.rx-less" if net > 0.0 else "td.rxa-bad", number(1e-3 * net, 1, sign=True))
        rows.append(tag("tr", tag("td", name), numbers, last))
    heads = ("nearest builds", "°", "kg", ("earns", tag("br"), "%"), ("net", tag("br"), "kW"))
    head = tag("tr", [tag("th", one) for one in heads])
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
    x, allowed = [*map(math.degrees, fine), x_most], [*(even.mass_allowed(one) for one in fine), largest]
    half = [even.mass_allowed(one, 0.5 * even.ideal_saving) for one in fine]
    series: list[Series] = [
        Band("pays", x, (y_range[0],) * len(x), allowed, _PAYS),
        Line("no drive power", x, allowed, _LINE),
        Line("driven", x[:-1], [one if one >= y_range[0] else math.nan for one in half], _LINE, "4 3"),
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
