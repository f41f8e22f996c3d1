"""What separated and reverse flow cost, beside their regions on the disk, and where the flow begins to separate."""

from collections.abc import Generator
from dataclasses import replace
from typing import Any

from explorer.model.units import TONNE, Units, number
from explorer.parts.stage import RegionPrice
from explorer.views.page_state import Effect, MoveSliders, PageState, Panel, PanelWork, Tell
from explorer.views.waterfall import cost_words, switched_alone
from rotor.study.series import WaterfallStep
from rotor.trim.stall_edge import AttachedRange, StallEdges, stall_edges


def stall_edge_work(now: PageState) -> tuple[PanelWork, ...]:
    """The work that finds the edges of stall, some twenty trims; none while sections do not stall."""
    if now.state is None or now.problem or not now.state.solution.design.models.stall:
        return ()
    solution = now.state.solution

    def run(tell: Tell) -> Generator[None, None, StallEdges]:
        return (yield from stall_edges(solution))

    return (PanelWork("stall-edges", (solution.design,), run),)


def prices(now: PageState) -> dict[str, Any]:
    """The price of each region. Until those of the present design are known, the last ones stand there as stale."""
    if now.state is None:
        return {"prices": None}
    models = now.state.solution.design.models
    press = "Without stall" if models.stall else "With stall"
    return {
        "prices": {
            "stall": replace(_stall_price(now), press=press),
            "reverse_flow": _switch_price(now, "reverse_flow", on=True),
        }
    }


def _stall_price(now: PageState) -> RegionPrice:
    """What separated flow costs, and where it begins or ends; without stall what stall would cost."""
    assert now.state is not None
    solution = now.state.solution
    if not solution.design.models.stall:
        return _switch_price(now, "stall", on=False)
    price = _switch_price(now, "stall", on=True)
    if not solution.stalled_area:
        # What is not there has no price.
        price = RegionPrice(())
    works = stall_edge_work(now)
    if not works:
        return price
    edges, of_now = now.latest(works[0])
    lines = () if edges is None else _edges(edges, now.units)
    return RegionPrice((*price.lines, *lines), stale=price.stale or not of_now)


def _switch_price(now: PageState, switch: str, *, on: bool) -> RegionPrice:
    """What an effect costs; `on`: whether the page has it."""
    steps, current = switched_alone(now)
    if switch in steps:
        lines = (switch_cost(steps[switch], now.units, on),)
    elif not steps and not current:
        lines = ("Computing …",)
    else:
        lines = ()
    return RegionPrice(lines, stale=not current)


def switch_cost(step: WaterfallStep, units: Units, on: bool) -> str:
    """What an effect costs or saves, as `Costs 10.5 kW`; `on`: whether the page has it, else `Stall would cost 0.8 kW`.

    The power is compared with that of the same flight without the effect.
    """
    if step.note or step.added is None:
        return cost_words(step, units)
    does = "save" if step.added > 0.0 else "cost"
    # Of the regions only stall can be off.
    verb = f"{does.capitalize()}s" if on else f"Stall would {does}"
    size = units.watts(abs(step.added), 1)
    if size == units.watts(0.0, 1):
        size = f"less than {units.watts(0.1 * units.power[0].size, 1)}"
    return f"{verb} {size}"


def _edges(edges: StallEdges, units: Units) -> list[str]:
    """Where separated flow begins, or ends, by each quantity alone: `Begins above µ 0.302`, `or with 0.06 t more`."""
    verb = "Ends" if edges.separated else "Begins"
    ways = list[str]()
    if edges.mass_kg is not None:
        mass = units.mass.text(abs(edges.mass_kg), 2 if units.mass is TONNE else 0)
        ways.append(f"with {mass} {'less' if edges.mass_kg < 0.0 else 'more'}")
    if edges.twist_deg is not None:
        ways.append(f"with Δ twist {number(edges.twist_deg, 1, sign=True)}°/R")
    lines = _speeds(edges.mu, verb)
    # Between two speeds without separated flow, "or" would say that the other ways lead to none either.
    joins = bool(lines) and (edges.separated or not _has_both_ends(edges.mu))
    for way in ways:
        lines.append(f"or {way}" if joins else f"{verb} {way}")
        joins = True
    return lines


def _speeds(attached: AttachedRange, verb: str) -> list[str]:
    """Between which advance ratios no flow is separated; `verb`: what separated flow does at an end of them."""
    low = "" if attached.low is None else number(attached.low, 3)
    high = "" if attached.high is None else number(attached.high, 3)
    if low and high:
        return [f"None from µ {low} to {high}"]
    ends = verb == "Ends"
    if low:
        return [f"{verb} {'above' if ends else 'below'} µ {low}"]
    if high:
        return [f"{verb} {'below' if ends else 'above'} µ {high}"]
    return []


def _has_both_ends(attached: AttachedRange) -> bool:
    return attached.low is not None and attached.high is not None


def switch_stall(now: PageState, value: object) -> tuple[Effect, ...]:
    """The flight without stall, or with it again: a trim of its own."""
    del value
    return (MoveSliders(replace(now.inputs, stall=not now.inputs.stall), by_hand=False),)


PRICES = Panel(prices, lambda ui: ui.disk, works=stall_edge_work, presses={"unstall": switch_stall})
