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
    """How far the edge of stall is: some twenty trims; none while sections do not stall."""
    if now.state is None or now.problem or not now.state.solution.design.models.stall:
        return ()
    solution = now.state.solution

    def run(tell: Tell) -> Generator[None, None, StallEdges]:
        return (yield from stall_edges(solution))

    return (PanelWork("stall-edges", (solution.design,), run),)


def prices(now: PageState) -> dict[str, Any]:
    """By region. The last ones known stand there as stale until those of the present design are."""
    if now.state is None:
        return {"prices": None}
    solution = now.state.solution
    models = solution.design.models
    steps, current = switched_alone(now)
    waits = ("Computing …",) if not steps and not current else ()
    on = {"stall": models.stall, "reverse_flow": True}
    shown = {
        name: RegionPrice(
            (_cost(steps[name], now.units, on[name]),) if name in steps else waits,
            stale=not current,
        )
        for name in on
    }
    stall, asked = shown["stall"], stall_edge_work(now)
    if models.stall and not solution.stalled_area:
        stall = RegionPrice(())  # What is not there has no price.
    if asked:
        edges, of_now = now.latest(asked[0])
        lines = () if edges is None else _edges(edges, now.units)
        stall = replace(stall, lines=(*stall.lines, *lines), stale=stall.stale or not of_now)
    return {
        "prices": shown
        | {"stall": replace(stall, press="Without stall" if models.stall else "With stall")}
    }


def _cost(step: WaterfallStep, units: Units, on: bool) -> str:
    """From the trim without the effect and that with all; on: whether the page has the effect."""
    if step.note or step.added is None:
        return cost_words(step, units)
    does = "save" if step.added > 0.0 else "cost"
    verb = f"{does.capitalize()}s" if on else f"Would {does}"
    size = units.watts(abs(step.added), 1)
    if size == units.watts(0.0, 1):
        size = f"less than {units.watts(0.1 * units.power[0].size, 1)}"
    return f"{verb} {size}"


def _edges(edges: StallEdges, units: Units) -> list[str]:
    """Where separated flow begins, or ends, by each quantity alone."""
    ways = list[str]()
    if edges.mass_kg is not None:
        mass = units.mass.text(abs(edges.mass_kg), 2 if units.mass is TONNE else 0)
        ways.append(f"with {mass} {'less' if edges.mass_kg < 0.0 else 'more'}")
    if edges.twist_deg is not None:
        ways.append(f"with twist {number(edges.twist_deg, 1, sign=True)}°/R")
    verb = "Ends" if edges.separated else "Begins"
    lines = _speeds(edges.mu, verb)
    for way in ways:
        lines.append(f"{'or' if lines else verb} {way}")
    return lines


def _speeds(attached: AttachedRange, verb: str) -> list[str]:
    """Between which advance ratios no flow is separated."""
    low, high = (end if end is None else number(end, 3) for end in (attached.low, attached.high))
    if low is not None and high is not None:
        return [f"None from µ {low} to {high}"]
    beyond, before = ("above", "below") if verb == "Ends" else ("below", "above")
    if low is not None:
        return [f"{verb} {beyond} µ {low}"]
    if high is not None:
        return [f"{verb} {before} µ {high}"]
    return []


def switch_stall(now: PageState, value: object) -> tuple[Effect, ...]:
    """The disk with attached flow throughout, or as it is: a trim of its own."""
    del value
    return (MoveSliders(replace(now.inputs, stall=not now.inputs.stall), by_hand=False),)


PRICES = Panel(prices, lambda ui: ui.disk, works=stall_edge_work, presses={"unstall": switch_stall})
