"""The actuator of a report: its verdict in one line, the balance of power, the twist over a flight, and its caveats."""

import math
from html import escape

import numpy as np

from explorer.export.report.contents import JudgedActuator
from explorer.export.report.figures import figure, series
from explorer.model.units import Units, number
from explorer.text.readout import balance, fuel_words, pair_words, signed
from rotor.actuator import ActuatorFlight, Verdict, verdict_details, verdict_sentence
from rotor.actuator.verdict import count
from rotor.line_chart import LineChart

_WIDE, _ROW, _NAME, _NUMBER = 480.0, 30.0, 92.0, 74.0
"""[px] of the balance: its width, a row, and the room for names and numbers beside the bars."""
_WANTED, _REACHED, _RANGE = "#e8590c", "#1c7ed6", "#868e96"


def actuator_section(actuator: JudgedActuator | str, units: Units) -> str:
    """The section; empty where no actuator was chosen."""
    if not actuator:
        return ""
    if isinstance(actuator, str):
        return f'<section class="actuator"><h2>Actuator</h2><ul class="care"><li>{escape(actuator)}</li></ul></section>'
    verdict, flight = actuator.verdict, actuator.flight
    kind = "less" if verdict.pays else "more"
    placement, first = verdict.installed.placement, verdict.installed.actuator.name
    low, high = placement.span
    where = f"{count(verdict)}, {verdict.installed.host.label}, {low:.2f}–{high:.2f} R"
    flown = f"<p class='note'>{escape(flight)}</p>" if isinstance(flight, str) else _over_flight(flight)
    legs = "" if isinstance(flight, str) else _legs(flight, verdict, units)
    return (
        f'<section class="actuator"><h2>Actuator</h2><p class="lead">{escape(first)}, {escape(where)}</p>'
        f'<p class="{kind} lead" data-report="verdict">{escape(verdict_sentence(verdict))}</p>'
        f'<p class="dim">{escape(verdict_details(verdict))}</p>'
        f'<div class="charts"><figure class="chart"><figcaption><b>Balance of power</b>'
        f'<span class="dim">{units.power[0].symbol}, {escape(pair_words(verdict))}</span></figcaption>'
        f'{_bars(verdict, units)}<p data-report="fuel"><b>{escape(fuel_words(verdict))}</b></p></figure>'
        f"{flown}</div>{legs}{_cares(verdict)}</section>"
    )


def _bars(verdict: Verdict, units: Units) -> str:
    """Each part beside the end of the one before; what is left from zero."""
    rows = balance(verdict)
    ends, reached = [], 0.0
    for k, (_, power) in enumerate(rows):
        start = 0.0 if k == len(rows) - 1 else reached
        ends.append((start, start + power))
        reached += power
    low, high = min(0.0, *map(min, ends)), max(0.0, *map(max, ends))
    room = _WIDE - _NAME - _NUMBER

    def at(power: float) -> float:
        return _NAME + room * (power - low) / max(high - low, 1.0)

    drawn = f'<line x1="{at(0.0):.1f}" x2="{at(0.0):.1f}" y1="0" y2="{_ROW * len(rows):g}" class="zero"/>'
    for k, ((name, power), (start, end)) in enumerate(zip(rows, ends, strict=True)):
        text, top = signed(power, units), _ROW * k
        kind = {"−": "more", "+": "less"}.get(text[0], "dim")
        left, width = min(at(start), at(end)), abs(at(end) - at(start))
        weight = ' font-weight="650"' if k == len(rows) - 1 else ""
        if kind != "dim":
            drawn += f'<rect x="{left:.1f}" y="{top + 6:g}" width="{width:.1f}" height="{_ROW - 12:g}" class="{kind}"/>'
        drawn += (
            f'<text x="0" y="{top + 20:g}"{weight}>{escape(name)}</text>'
            f'<text x="{_WIDE:g}" y="{top + 20:g}" text-anchor="end" class="{kind}"{weight} data-report="balance">'
            f"{text}</text>"
        )
    said = ", ".join(f"{name} {signed(power, units)}" for name, power in rows)
    return (
        f'<svg viewBox="0 0 {_WIDE:g} {_ROW * len(rows):g}" class="balance" role="img" '
        f'aria-label="{escape(said)} {units.power[0].symbol}">{drawn}</svg>'
    )


def _over_flight(flight: ActuatorFlight) -> str:
    """Tip twist wanted and reached, and what the actuator can reach, over the legs by advance ratio."""
    mu = np.array([leg.advance_ratio for leg in flight.legs])
    low, high = (np.full(len(mu), math.degrees(end)) for end in flight.reach)
    lines = (
        series("within reach", mu, low, "dashed", _RANGE),
        series("", mu, high, "dashed", _RANGE),
        series("wanted", mu, np.degrees(flight.wanted), "line", _WANTED),
        series("reached", mu, np.degrees(flight.reached), "line", _REACHED),
        series("", mu, np.degrees(flight.reached), "points", _REACHED),
    )
    names = ", ".join(leg.name for leg in flight.legs)
    return figure(LineChart("Tip twist over the flight", f"advance ratio µ: {names}", "change of tip twist [°]", lines))


def _legs(flight: ActuatorFlight, verdict: Verdict, units: Units) -> str:
    """A row for each leg."""
    tip_speed = verdict.baseline.pair.design.rotor.tip_speed
    rows = ""
    for k, leg in enumerate(flight.legs):
        speed = units.speed[0].text(leg.advance_ratio * tip_speed)
        climb = units.climb_rate(leg.climb_speed)
        fuel = "–" if flight.fuel_saving is None else number(-3600.0 * float(flight.fuel_saving[k]), 1, sign=True)
        cells = (
            f"{leg.name}, {speed}" + (f", {climb}" if climb else ""),
            *(number(math.degrees(float(of[k])), 1, sign=True) for of in (flight.wanted, flight.reached)),
            number(abs(math.degrees(float(flight.shortfall[k]))), 1),
            signed(float(flight.net_saving[k]), units),
            fuel,
        )
        rows += f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>"
    heads = ("Leg", "wanted °", "reached °", "short °", f"net {units.power[0].symbol}", "fuel kg/h")
    head = "".join(f"<th>{name}</th>" for name in heads)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'


def _cares(verdict: Verdict) -> str:
    """Limits that are exceeded, then caveats."""
    sentences = [*(limit.sentence for limit in verdict.broken), *verdict.caveats]
    items = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences)
    return f'<ul class="care">{items}</ul>' if items else ""
