"""The table of actuators with their verdicts, and what they are called."""

import math
from html import escape

from explorer.tabs.actuator.state import Question
from explorer.tabs.actuator.study import Findings, Outcome
from explorer.text.units import number
from rotor.actuator.catalogue import Actuator, PiezoPly, TorqueTube, actuators, find_actuator
from rotor.actuator.verdict import Verdict, verdict_sentence


def table_panel(findings: Findings, question: Question) -> str:
    """All actuators on this blade for this question, one row each."""
    asked = findings.question
    known = dict(findings.others)
    # Rows are about the same question whatever actuator is chosen now.
    if asked is None or (asked.pair, asked.concept, asked.placement, asked.host, asked.share) != (
        question.pair, question.concept, question.placement, question.host, question.share,
    ):  # fmt: skip
        known = {}
    rows = "".join(_row(id, known.get(id), id == question.actuator) for id in actuators())
    head = "<tr><th>Actuator</th><th>available °</th><th>derated °</th><th>kg</th><th>net kW</th><th>verdict</th></tr>"
    first, second = question.pair.advance_ratios
    return (
        f'<div class="rx" data-explorer="actuator-table"><table class="rxa-table">{head}{rows}</table>'
        f'<div class="rx-dim rx-small">µ {first:g} ↔ {second:g}, {escape(question.host.label)}, half the time each. '
        "▲: some data from memory, not verified. Hover over a verdict for the full text.</div></div>"
    )


def _row(id: str, outcome: Outcome | None, chosen: bool) -> str:
    actuator = find_actuator(id)
    care = (
        ' <span title="some data from memory, not verified" class="rxa-bad">▲</span>'
        if actuator.provenance.recalled
        else ""
    )
    name = f'<td title="{escape(actuator.name)}">{escape(short_name(id))}{care}</td>'
    look = ' class="rxa-chosen"' if chosen else ""
    if outcome is None:
        return f'<tr{look}>{name}<td class="rx-num rx-dim" colspan="5">computing…</td></tr>'
    if isinstance(outcome, str):
        why = f'<td class="rx-num rxa-bad" colspan="5" title="{escape(outcome)}">cannot be built</td>'
        return f"<tr{look}>{name}{why}</tr>"
    words, kind = short_verdict(outcome)
    cells = (
        number(math.degrees(outcome.attainable), 1),
        number(math.degrees(outcome.attainable_derated), 1),
        number(outcome.installed.masses.aircraft),
        number(1e-3 * outcome.net_saving, 1, sign=True),
    )
    numbers = "".join(f'<td class="rx-num">{cell}</td>' for cell in cells)
    why = escape(verdict_sentence(outcome))
    return f'<tr{look}>{name}{numbers}<td class="rx-num {kind}" title="{why}">{words}</td></tr>'


def short_verdict(verdict: Verdict) -> tuple[str, str]:
    """A few words, and the class that colours them."""
    if verdict.pays:
        return "net benefit", "rx-less"
    if not verdict.feasible:
        return "too weak", "rxa-bad"
    if verdict.net_saving <= 0.0:
        return "net cost", "rxa-bad"
    return "cannot be built", "rxa-bad"


def short_name(id: str) -> str:
    return id.replace("_", " ")


def actuator_titles() -> dict[str, str]:
    """Of the menu, by id."""
    return {id: f"{short_name(id)}: {_kind(actuator)}" for id, actuator in actuators().items()}


def _kind(actuator: Actuator) -> str:
    if isinstance(actuator, PiezoPly):
        return "d33 fibres" if actuator.electrodes == "interdigitated" else "d31 sheet"
    return "heated tube" if isinstance(actuator, TorqueTube) else "passive"
