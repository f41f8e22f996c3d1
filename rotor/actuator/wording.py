"""The verdict as a sentence."""

import math

from rotor.actuator.catalogue import ExtensionTwist, PiezoPly
from rotor.actuator.verdict import Verdict

SMALL = 1.0
"""Powers nearer to zero are called nothing [W]."""


def verdict_sentence(verdict: Verdict) -> str:
    """What an engineer takes home, in two or three short sentences."""
    fitted, pair = verdict.fitted, verdict.baseline.pair
    what = f"{fitted.actuator.name} ({count(verdict)}, {fitted.host.label})"
    first, second = (flight(mu) for mu in pair.advance_ratios)
    need, have = math.degrees(verdict.required), math.degrees(verdict.attainable)
    tested = math.degrees(verdict.attainable_derated)
    if verdict.feasible:
        reach = f"{what} can make the {need:.1f}° that going from {first} to {second} asks for ({have:.1f}° nominal"
    else:
        reach = f"{what} cannot make the {need:.1f}° that going from {first} to {second} asks for ({have:.1f}° nominal"
    reach += f", {tested:.1f}° as tests suggest)." if fitted.derating < 1.0 else ")."
    gross, net = verdict.gross_saving, verdict.net_saving
    mass = fitted.bill.aircraft
    against = "flown twist" if fitted.host.kind == "retrofit" else "best fixed blade"
    saves = f"within its reach it saves {kw(gross)} over the {against}"
    if verdict.pays:
        pay = f"It pays: {saves}, {kw(net)} after its {mass:.0f} kg are carried."
    elif net > 0.0:
        pay = f"It would save {kw(net)} over the {against}, if it could be built and driven."
    else:
        pay = f"It does not pay: {saves}, and carrying its {mass:.0f} kg costs {kw(gross - net)}."
    concept, ideal = verdict.baseline.concept.name, verdict.baseline.ideal_saving
    pay += f" The {concept} concept, free to move, would save {kw(ideal)} over its best fixed blade."
    broken = verdict.broken
    stops = f" Limits broken: {', '.join(limit.name for limit in broken)}." if broken else ""
    return f"{reach} {pay}{stops}"


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
