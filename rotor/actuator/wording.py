"""The verdict in words: a headline, and the sentences behind it."""

import math

from rotor.actuator.catalogue import ExtensionTwist, PiezoPly
from rotor.actuator.verdict import Verdict

SMALL = 1.0
"""Powers nearer to zero are called nothing [W]."""


def headline(verdict: Verdict) -> str:
    """The outcome in one short sentence: net power against the one blade that the whole verdict is compared with."""
    net, against = verdict.net_saving, reference(verdict)
    if abs(net) < SMALL:
        return f"No net benefit: saves as much as it costs vs. {against}."
    if net < 0.0:
        return f"No net benefit: costs {kw(-net)} vs. {against}."
    if verdict.buildable:
        return f"Net benefit: saves {kw(net)} vs. {against}."
    return f"Cannot be built: it would save {kw(net)} vs. {against}."


def verdict_sentence(verdict: Verdict) -> str:
    """The headline, then reach, savings and limits; all powers count from the blade that the headline names."""
    sentences = [headline(verdict), _reach(verdict), _savings(verdict)]
    if verdict.broken:
        sentences.append(f"Limits exceeded: {', '.join(limit.name for limit in verdict.broken)}.")
    return " ".join(sentences)


def reference(verdict: Verdict) -> str:
    """The blade that all savings of a verdict count from."""
    return "the twist as built" if verdict.fitted.host.kind == "retrofit" else "the best fixed twist"


def _reach(verdict: Verdict) -> str:
    """Twist supplied against twist needed."""
    fitted = verdict.fitted
    what = f"{fitted.actuator.name} ({count(verdict)}, {fitted.host.label})"
    first, second = (flight(mu) for mu in verdict.baseline.pair.advance_ratios)
    need, nominal = math.degrees(verdict.required), math.degrees(verdict.attainable)
    available = f"{nominal:.1f}° nominal"
    if fitted.derating < 1.0:
        available += f", {math.degrees(verdict.attainable_derated):.1f}° derated by test"
    can = "can supply" if verdict.feasible else "cannot supply"
    return f"{what} {can} the {need:.1f}° needed from {first} to {second} ({available})."


def _savings(verdict: Verdict) -> str:
    """Before mass and drive, after them, and what unlimited variable twist would save from the same blade."""
    gross, cost = verdict.gross_saving, verdict.gross_saving - verdict.net_saving
    concept, mass = verdict.baseline.concept.name, verdict.fitted.bill.aircraft
    change = "saves nothing" if abs(gross) < SMALL else f"saves {kw(gross)}" if gross > 0.0 else f"costs {kw(-gross)}"
    text = (
        f"Within its reach the change of twist {change}; carrying {mass:.0f} kg and its drive cost {kw(cost)}. "
        f"Unlimited variable twist ({concept}) would save {kw(verdict.ideal_saving)}"
    )
    fixed = verdict.ideal_saving - verdict.baseline.ideal_saving
    return f"{text}, {kw(fixed)} of it with the best fixed twist." if abs(fixed) >= SMALL else f"{text}."


def count(verdict: Verdict) -> str:
    """Plies, tubes or nothing to count."""
    actuator, placement = verdict.fitted.actuator, verdict.fitted.placement
    if isinstance(actuator, ExtensionTwist):
        return "passive"
    if isinstance(actuator, PiezoPly):
        return f"{placement.plies} {'ply' if placement.plies == 1 else 'plies'}"
    each = " a segment" if placement.divisions else ""
    return f"{placement.plies} {'tube' if placement.plies == 1 else 'tubes'}{each}"


def flight(advance_ratio: float) -> str:
    return "hover" if advance_ratio == 0.0 else f"µ {advance_ratio:.2f}"


def kw(power: float) -> str:
    """Signed kilowatts, one decimal; nothing where it is nothing."""
    return "nothing" if abs(power) < SMALL else f"{power / 1e3:.1f} kW"
