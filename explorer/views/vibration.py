"""Vibration of blades that bend: the row of the power card, and what bending costs.

The index of a solution is little work and follows every step of a drag, after its frame. Its band over
wakes is computed while the page rests.
"""

import math
from collections.abc import Generator
from typing import Any

from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.parts.stage import SceneLabel, VibrationPart
from explorer.picture.picture import BENDING_SHOWN
from explorer.text.readout import index_unit
from explorer.views.page_state import PageState, Panel, PanelWork, Tell, as_one_step
from rotor import Design, Solution, hub_loads, solve
from rotor.aero.bending import can_bend
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design.design import with_models
from rotor.trim import Analysis, HubLoads, analyse, why_no_hub_loads
from rotor.trim.hub_loads import band_designs, band_inflows


def vibration(now: PageState) -> dict[str, Any]:
    """The row of the power card, the words in the scene, and those beside the switch."""
    state = now.state
    if state is None:
        return {}
    bends = state.solution.design.models.bending
    return {
        "vibration": _row(now, state) if bends else None,
        "hub_labels": _how_bent(state.solution) if bends and not now.problem else [],
        "switch.bending": _bending_note(now, state),
    }


def works(now: PageState) -> tuple[PanelWork, ...]:
    """The loads of the solution and of a reference with their bands, and the trim of the solution without bending."""
    state = now.state
    if state is None or not state.solution.design.models.bending:
        return ()
    solution, reference = state.solution, state.reference
    compared = reference.converged and reference.design != solution.design
    return (
        _loads_work(now, solution, True),
        *((_loads_work(now, reference, True),) if compared else ()),
        PanelWork("rigid", (solution.design,), as_one_step(lambda: _rigid_power(solution))),
    )


def _loads_work(now: PageState, solution: Solution, band: bool) -> PanelWork:
    def run(tell: Tell) -> Generator[None, None, tuple[HubLoads | None]]:
        trims, given = dict[Design, Analysis](), solution.design
        if why_no_hub_loads(given) is None:
            bent = with_models(given, bending=True)
            for design in {bent, *(band_designs(bent) if band else ())} - {given}:
                yield
                trims[design] = analyse(design)
        yield
        return (
            hub_loads(now.analyses.of(solution), solve=lambda design, _: trims[design], band=band),
        )

    return PanelWork("hub loads", (solution.design, band), run)


def _loads(now: PageState, solution: Solution, band: bool) -> HubLoads | None:
    """Hub loads as far as they are known: without a band those of a blade that bends are little work."""
    known = now.answers.get(_loads_work(now, solution, band).key)
    if known is not None:
        return known[0]
    bends = solution.converged and solution.design.models.bending
    return hub_loads(now.analyses.of(solution), band=False) if bends else None


def _rigid_power(solution: Solution) -> float:
    """Power without bending [W]; NaN where that does not trim."""
    rigid = solve(with_models(solution.design, bending=False))
    return rigid.power.total if rigid.converged else math.nan


def _bending_note(now: PageState, state: SessionState) -> str:
    """What bending costs, or why this blade does not bend."""
    design, words = state.solution.design, ""
    if not can_bend(design.rotor):
        reason = why_no_hub_loads(design)
        words = "" if reason is None else reason.sentence.removeprefix("No hub loads: ")
    elif asked := works(now):
        added = state.solution.power.total - now.answers.get(asked[-1].key, math.nan)
        words = f"{now.units.watts(added, 1, sign=True)} here" if math.isfinite(added) else ""
    return words[:1].upper() + words[1:]


def _row(now: PageState, state: SessionState) -> VibrationPart:
    """The row of the power card; without an index the sentence says why."""
    design, loads = state.solution.design, _loads(now, state.solution, True)
    reason = why_no_hub_loads(design)
    if reason is not None or loads is None:
        sentence = "No hub loads: no trim with bending." if reason is None else reason.sentence
        return VibrationPart(sentence, sentence=sentence)
    band = "band over inflow models: computing"
    if loads.band is not None:
        band = f"{number(loads.band[0], 1)} to {number(loads.band[1], 1)} over inflow models"
    change, kind = _change(state, loads, _loads(now, state.reference, True))
    return VibrationPart(
        _title(loads),
        index=number(loads.index, 1),
        unit=index_unit(design),
        at=f"at {loads.per_rev}/rev",
        band=band,
        change=change,
        kind=kind,
    )


def _change(state: SessionState, loads: HubLoads, reference: HubLoads | None) -> tuple[str, str]:
    """Against A, or the blade as built, with its band; and its class, none where the inflow models differ in sign."""
    if reference is None or state.reference.design == state.solution.design:
        return "", ""
    percent = 100.0 * (loads.index / reference.index - 1.0)
    band, against = loads.change_band(reference), "A" if state.pinned is not None else "as built"
    if band is None:
        return f"{number(percent, 0, sign=True)} % vs. {against}", ""
    low, high = (number(end, 0, sign=True) for end in band)
    kind = "good" if band[1] < 0.0 else "bad" if band[0] > 0.0 else ""
    return (
        f"{number(percent, 0, sign=True)} ({low}…{high}) % vs. {against}{'' if kind else ': unclear'}",
        kind,
    )


def index_band(now: PageState) -> tuple[float, float] | None:
    """Ends over inflow models of the change of the index from the reference [%]; None where they are not known."""
    if (state := now.state) is None or not all(
        one.design.models.bending for one in (state.solution, state.reference)
    ):
        return None
    loads, reference = (_loads(now, one, True) for one in (state.solution, state.reference))
    return None if loads is None or reference is None else loads.change_band(reference)


def _how_bent(solution: Solution) -> list[SceneLabel]:
    """The words in the scene: bending is drawn larger."""
    if solution.deflections is None:
        return []
    rotor = solution.design.rotor
    tip = [1.04 * (1.0 - rotor.blade.flap_hinge) * rotor.radius, 0.0, 0.0]
    title = "Flap and lag bending from the straight blade (grey), drawn ten times as large."
    return [SceneLabel(f"bending × {BENDING_SHOWN:g}", "/rotor/blade_0", tip, title)]


def _title(loads: HubLoads) -> str:
    """What the index is, its parts and its limits."""
    values = ", ".join(
        f"{name[0].upper()}{name[1]} {number(value / 1e3, 2)} {'kN' if name[0] == 'f' else 'kN m'}"
        for name, value in loads.amplitudes.items()
    )
    wakes = ", ".join(INFLOW_MODELS[name].title for name in band_inflows())
    return (
        f"Vibration index: √((0.5 Fx)² + (0.67 Fy)² + Fz²)/W + √(Mx² + My²)/(R W), from hub loads at "
        f"{loads.per_rev}/rev: {values}. Weights of the forces: 0.5 aft, 0.67 to starboard, 1 vertical. "
        f"Band: least and largest with {wakes}. Use it to compare designs; its level is not reliable."
    )


VIBRATION = Panel(vibration, works=works)
