"""What stall and reverse flow cost, beside their regions on the disk, and how far away the edge of stall is."""

from collections.abc import Generator
from dataclasses import replace
from typing import Any

from explorer.model.units import TONNE, Units, number
from explorer.parts.stage import RegionPrice
from explorer.views.page_state import Effect, MoveSliders, PageState, Panel, PanelWork, Tell
from explorer.views.waterfall import cost_words, switched_alone
from rotor.study.series import WaterfallStep
from rotor.trim.stall_edge import stall_edges


def stall_edge_work(now: PageState) -> tuple[PanelWork, ...]:
    """How far the edge of stall is: some twenty trims; none while sections do not stall."""
    if now.state is None or now.problem or not now.state.solution.design.models.stall:
        return ()
    solution = now.state.solution

    def run(tell: Tell) -> Generator[None, None, tuple[bool, float, dict[str, float | None]]]:
        found = yield from stall_edges(solution)
        return solution.stalled_area > 0.0, solution.design.condition.advance_ratio, found

    return (PanelWork("stall-edges", (solution.design,), run),)


def prices(now: PageState) -> dict[str, Any]:
    """By region. The last ones known stand there as stale until those of the present design are."""
    if now.state is None:
        return {"prices": None}
    models = now.state.solution.design.models
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
    if asked:
        known, of_now = now.latest(asked[0])
        stalls, mu, edges = known or (False, 0.0, {})
        lines = _edges(stalls, mu, edges, now.units)
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
    return f"{f'{does.capitalize()}s' if on else f'Would {does}'} {units.watts(abs(step.added), 1)}"


def _edges(stalls: bool, mu: float, edges: dict[str, float | None], units: Units) -> list[str]:
    """Where stall begins, or ends, by each quantity alone; mu: advance ratio here."""
    by_mu, by_mass, by_twist = (edges.get(name) for name in ("mu", "mass_kg", "twist"))
    ways = [] if by_mu is None else [f"at µ {number(mu + by_mu, 3)}"]
    if by_mass is not None:
        mass = units.mass.text(abs(by_mass), 2 if units.mass is TONNE else 0)
        ways.append(f"with {mass} {'less' if by_mass < 0.0 else 'more'}")
    if by_twist is not None:
        ways.append(f"with twist {number(by_twist, 1, sign=True)}°/R")
    return [f"{'or' if k else 'Ends' if stalls else 'Begins'} {way}" for k, way in enumerate(ways)]


def switch_stall(now: PageState, value: object) -> tuple[Effect, ...]:
    """The disk without stall, or with it again: a trim of its own."""
    del value
    return (MoveSliders(replace(now.inputs, stall=not now.inputs.stall), by_hand=False),)


PRICES = Panel(prices, lambda ui: ui.disk, works=stall_edge_work, presses={"unstall": switch_stall})
