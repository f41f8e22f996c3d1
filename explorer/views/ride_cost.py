"""What separated flow costs while the page rides with a section: the price on the disk, as it adds up over the turn."""

import math
from typing import Any

import numpy as np

from explorer.model.units import Units
from explorer.parts.stage import RideCostPart
from explorer.views.page_state import PageState, Panel
from explorer.views.prices import switch_cost
from explorer.views.waterfall import switched_alone, waterfall_work
from rotor.study.series import WaterfallStep
from rotor.support.arrays import Array

_STEPS = 72
"""Steps of the turn, from the sums at whose ends the page reads."""


def ride_cost(now: PageState) -> dict[str, Any]:
    """The price of separated flow, and its sum over the azimuth."""
    return {"ride_cost": None if now.state is None else _cost_part(now)}


def _cost_part(now: PageState) -> RideCostPart:
    """That price; a sentence where there is none."""
    assert now.state is not None
    solution = now.state.solution
    if not solution.design.models.stall:
        return _without_price("Stall is switched off")
    if not solution.stalled_area:
        return _without_price("Nothing is separated on this disk")
    steps, current = switched_alone(now)
    step = steps.get("stall")
    if step is None:
        return _without_price("" if current else "Computing what stall costs …")
    words = switch_cost(step, now.units, on=True)
    return RideCostPart(
        words=f"Stall {words[:1].lower()}{words[1:]}",
        spent=_spent(step, now.units),
        unit=now.units.power[0].symbol,
        stale=not current,
    )


def _without_price(words: str) -> RideCostPart:
    return RideCostPart(words, spent=(), unit="", stale=False)


def _spent(step: WaterfallStep, units: Units) -> list[float]:
    """The price summed from ψ = 0 to each step of the turn, in the unit of the page."""
    if step.added_around is None:
        return []
    unit = units.power[0]
    return [unit.of(watts) for watts in price_summed(step.added_around, _STEPS).tolist()]


def price_summed(added_around: Array, steps: int) -> Array:
    """The price of an effect from ψ = 0 to each of so many steps of a turn [W], (steps + 1,); the last is all of it.

    `added_around`: what leaving it out adds to the power over the azimuth [W]. Each azimuth stands for the part of the
    turn about it, half a step to either side.
    """
    azimuths = len(added_around)
    step = 2.0 * math.pi / azimuths
    shares = -added_around / azimuths
    # Half of the part about ψ = 0 lies at the end of the turn.
    ends = step * (np.arange(-1, azimuths + 1) + 0.5)
    reached = np.concatenate([[0.0], np.cumsum(np.append(shares, shares[0]))])
    psi = np.linspace(0.0, 2.0 * math.pi, steps + 1)
    return np.interp(psi, ends, reached) - 0.5 * shares[0]


RIDE_COST = Panel(ride_cost, lambda ui: ui.riding, works=waterfall_work)
