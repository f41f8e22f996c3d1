"""What would pay: the break-even line of this rotor, where the present actuator stands, and the builds nearest to it.

Worked out in the background when asked for, and kept until the design or the flight conditions are others.
"""

import math
from dataclasses import dataclass
from html import escape

import numpy as np

from explorer.charts.svg import line, polygon, tick, words
from explorer.model.units import number
from explorer.tabs.actuator.actuator_tasks import Call, PoolAnswers
from explorer.tabs.context import TabContext
from explorer.text.glossary import hint
from rotor.actuator import BreakEven, ConditionPair, PaySearch, Verdict, break_even, pay_sentence, what_would_pay
from rotor.actuator.pay import Candidate, search_sentence
from rotor.chart import round_ticks, tick_text

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
            self._html = context.gui.add_html(_small("start", _START, " rx-dim"))
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


def _small(kind: str, text: str, look: str = "") -> str:
    return f'<div class="rx{look} rx-small" data-explorer="pay" data-kind="{kind}">{escape(text)}</div>'


def pay_panel(answer: PayAnswer, verdict: Verdict | None, *, stale: bool = False) -> str:
    """Sentences, both charts and the nearest builds."""
    lead, *more = answer.sentences
    old = '<div class="rx-dim">Of an earlier design or pair of conditions: find again.</div>' if stale else ""
    body = "".join(f"<div>{escape(one)}</div>" for one in more)
    charts = ""
    if answer.even.worthwhile:
        charts = mass_chart(answer.even, verdict) + drive_chart(answer.even)
    faded = " rx-faded" if stale else ""
    return (
        f'<div class="rx rx-small{faded}" data-explorer="pay" data-kind="ready">{old}<b>{escape(lead)}</b>{body}'
        f"{charts}{_table(answer.builds)}</div>"
    )


def _table(builds: tuple[Candidate, ...]) -> str:
    if not builds:
        return ""
    rows = ""
    for one in builds:
        cells = (math.degrees(one.installed.attainable), 1), (one.mass, 0), (100.0 * one.earned, 0)
        name = one.name.replace(" × ", _KEPT_SPACE.join(("", "×", ""))).replace(" R", f"{_KEPT_SPACE}R")
        rows += f"<tr><td>{escape(name)}</td>"
        rows += "".join(f"<td>{number(value, places)}</td>" for value, places in cells)
        net = one.estimate.net
        rows += f'<td class="{"rx-less" if net > 0.0 else "rxa-bad"}">{number(1e-3 * net, 1, sign=True)}</td></tr>'
    head = "<tr><th>nearest builds</th><th>°</th><th>kg</th><th>earns<br>%</th><th>net<br>kW</th></tr>"
    return f'<table class="rxa-table rxa-pay" data-explorer="pay-builds">{head}{rows}</table>'


_WIDE, _HIGH = 300.0, 190.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 40.0, 10.0, 8.0, 36.0
_LINE = "#1c7ed6"


@dataclass(frozen=True)
class _Frame:
    """Axes of a small drawing."""

    x_most: float
    y_low: float
    y_most: float
    log: bool

    def at(self, x: float, y: float) -> tuple[float, float]:
        wide, high = _WIDE - _LEFT - _RIGHT, _HIGH - _TOP - _BOTTOM
        if self.log:
            share = math.log(max(y, self.y_low) / self.y_low) / math.log(self.y_most / self.y_low)
        else:
            share = (y - self.y_low) / (self.y_most - self.y_low)
        return _LEFT + wide * x / self.x_most, _TOP + high * (1.0 - share)

    def draw(self, x_label: str, y_label: str, drawn: str, name: str, said: str) -> str:
        """Grid, numbers and labels below what is drawn."""
        marks = ""
        for value in round_ticks(0.0, self.x_most, 5):
            x, y = self.at(value, self.y_low)
            marks += line((x, _TOP), (x, y), "currentColor", 1.0, 'opacity=".14"') + tick(
                (x, y + 14), tick_text(value), "middle"
            )
        decades = [10.0**k for k in range(-2, 4) if self.y_low <= 10.0**k <= self.y_most]
        for value in decades if self.log else round_ticks(self.y_low, self.y_most, 4):
            x, y = self.at(0.0, value)
            marks += line((x, y), (_WIDE - _RIGHT, y), "currentColor", 1.0, 'opacity=".14"') + tick(
                (x - 5, y + 4), tick_text(value), "end"
            )
        middle = 0.5 * (_TOP + _HIGH - _BOTTOM)
        labels = words((0.5 * (_LEFT + _WIDE), _HIGH - 4.0), x_label)
        labels += f'<g transform="translate(11 {middle:.0f}) rotate(-90)">{words((0.0, 0.0), y_label)}</g>'
        return (
            f'<svg viewBox="0 0 {_WIDE:g} {_HIGH:g}" width="100%" role="img" aria-label="{escape(said)}" '
            f'data-explorer="{name}">{marks}{drawn}{labels}</svg>'
        )


def mass_chart(even: BreakEven, verdict: Verdict | None) -> str:
    """Break-even mass over twist, with the present actuator as a point; mass on a logarithmic scale.

    The point stands at the linear twist that saves as much over the best fixed blade as the actuator's own twist does,
    with its stiffness counted: tip twist alone does not say what a shape is worth.
    """
    largest = float(even.masses[-1])
    mass = 0.0 if verdict is None else verdict.installed.masses.aircraft
    frame = _Frame(
        1.08 * math.degrees(float(even.twists[-1])),
        10.0 ** math.floor(math.log10(0.05 * largest)),
        2.0 * max(mass, largest),
        True,
    )
    fine = np.linspace(0.0, float(even.twists[-1]), 60)[1:]
    edge = [frame.at(math.degrees(x), even.mass_allowed(x)) for x in fine.tolist()]
    right = frame.at(frame.x_most, largest)
    driven = [(math.degrees(x), even.mass_allowed(x, 0.5 * even.ideal_saving)) for x in fine.tolist()]
    half = [frame.at(x, mass_then) for x, mass_then in driven if mass_then >= frame.y_low]
    floor = frame.at(frame.x_most, frame.y_low), frame.at(math.degrees(float(fine[0])), frame.y_low)
    drawn = polygon([*edge, right, *floor], 'fill="#0ca678" fill-opacity=".13"')
    drawn += _path([*edge, right], "") + _path(half, 'stroke-dasharray="4 3"')
    drawn += words(frame.at(0.72 * frame.x_most, 0.28 * largest), "pays")
    said = "Mass that pays over twist"
    if verdict is not None:
        drawn += _point(frame, even, verdict)
        said += f"; {_id(verdict)} {'pays' if verdict.net_saving > 0.0 else 'does not pay'}"
    key = (
        '<div class="rx-dim">Line: no drive power. Dashed: half of what unlimited twist saves goes to the drive. '
        "Point: the linear twist that saves as much as this actuator, its stiffness counted. "
        "Earns: what its twist saves over what it costs.</div>"
    )
    return frame.draw("range of linear twist [°]", "mass, all blades [kg]", drawn, "pay-mass", said) + key


def _id(verdict: Verdict) -> str:
    return verdict.installed.actuator.id.replace("_", " ")


def _point(frame: _Frame, even: BreakEven, verdict: Verdict) -> str:
    """The present actuator: red where it does not pay, green where it does, as its verdict says."""
    mass = verdict.installed.masses.aircraft
    worth = math.degrees(even.twist_for(verdict.baseline.fixed.power - verdict.optimum.power))
    x, y = frame.at(worth, mass or frame.y_low)
    inward = -9.0 if x > 0.6 * _WIDE else 9.0
    colour = "#0ca678" if verdict.net_saving > 0.0 else "var(--rx-bad)"
    label = f"{_id(verdict)}: worth {worth:.1f}°, {mass:.0f} kg"
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{colour}"/>' + words(
        (x + inward, y + 4.0), label, "end" if inward < 0.0 else "start"
    )


def drive_chart(even: BreakEven) -> str:
    """Drive power that pays over mass, with all and with half of the twist."""
    largest, all_twist = float(even.masses[-1]), float(even.twists[-1])
    frame = _Frame(1.05 * largest, 0.0, 1.1e-3 * even.ideal_saving, False)
    drawn = ""
    for twist, look, dx in ((all_twist, "", 0.35), (0.5 * all_twist, 'stroke-dasharray="4 3"', 0.12)):
        end = even.mass_allowed(twist)
        points = [(mass, 1e-3 * even.net(twist, mass)) for mass in np.linspace(0.0, end, 12).tolist()]
        drawn += _path([frame.at(*point) for point in points], look)
        at = frame.at(dx * largest, 1e-3 * even.net(twist, dx * largest))
        drawn += words((at[0] + 4.0, at[1] - 5.0), f"{math.degrees(twist):.1f}°", "start")
    said = "Drive power that pays over mass"
    return frame.draw("mass, all blades [kg]", "drive [kW]", drawn, "pay-drive", said)


def _path(points: list[tuple[float, float]], look: str) -> str:
    places = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{places}" fill="none" stroke="{_LINE}" stroke-width="2" {look}/>'
