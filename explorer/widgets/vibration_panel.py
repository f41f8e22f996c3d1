"""Vibration of blades that bend: the row of the power card.

The index of a solution is little work and follows every step of a drag, after its frame. Its band over
wakes is computed while the page rests.
"""

from collections.abc import Callable
from dataclasses import replace

from explorer.model.session_state import SessionState
from explorer.model.units import UNITS, number
from explorer.parts.stage import SceneLabel, VibrationPart
from explorer.picture.picture import BENDING_SHOWN
from explorer.scene.scene import ROTOR
from explorer.text.readout import index_unit
from explorer.widgets.context import TabContext
from rotor import Solution, hub_loads, solve
from rotor.aero.bending import can_bend
from rotor.aero.inflow import INFLOW_MODELS
from rotor.trim import DEFAULT_OPTIONS, HubLoads, analyse, why_no_hub_loads
from rotor.trim.hub_loads import band_inflows

_NOTICEABLE = 0.5
"""Changes of the index below this [% of itself] have no colour."""


class VibrationPanel:
    def __init__(self, context: TabContext) -> None:
        self._context = context
        self._state: SessionState | None = None
        self._loads: dict[Solution, HubLoads | None] = {}
        """Hub loads of the present solution and of its reference."""
        self._rigid: tuple[Solution, Solution] | None = None
        """A solution, and that of the same design without bending."""

    def show(self, state: SessionState) -> None:
        self._state = state
        self._say_at_switch(state)
        if not state.solution.design.models.bending:
            self._loads = {}
            self._context.bridge.set(vibration=None, hub_labels=[])
            return
        known = self._loads
        self._loads = {solution: known[solution] for solution in (state.solution, state.reference) if solution in known}
        for solution in (state.solution, state.reference):
            if solution not in self._loads and solution.converged and solution.design.models.bending:
                self._loads[solution] = hub_loads(self._context.analyses.of(solution), band=False)
        self._draw()

    def solve_deferred(self, superseded: Callable[[], bool]) -> None:
        """The page rests: compute what can wait, until newer input comes."""
        state = self._state
        if state is None or not state.solution.design.models.bending:
            return
        solution, reference = state.solution, state.reference
        steps: tuple[Callable[[], None], ...] = (
            lambda: self._solve_loads(reference, False, superseded),
            lambda: self._solve_loads(solution, True, superseded),
            lambda: self._solve_cost(state),
        )
        for step in steps:
            if superseded():
                return
            step()

    def problem(self) -> None:
        """The inputs have no answer: what stands here is of the last one."""
        self._context.bridge.set(hub_labels=[])

    def _solve_loads(self, solution: Solution, band: bool, superseded: Callable[[], bool]) -> None:
        known = self._loads.get(solution)
        if not solution.converged or (known is not None and (known.band is not None or not band)):
            return
        options = replace(DEFAULT_OPTIONS, stop=superseded)
        analysis = self._context.analyses.of(solution)
        loads = hub_loads(analysis, solve=lambda design, start: analyse(design, start, options), band=band)
        if not superseded():
            self._loads[solution] = loads
            self._draw()

    def _solve_cost(self, state: SessionState) -> None:
        """What bending adds to the power: one more trim."""
        solution = state.solution
        if self._rigid is None or self._rigid[0] is not solution:
            rigid = replace(solution.design, models=replace(solution.design.models, bending=False))
            self._rigid = solution, solve(rigid)
        self._say_at_switch(state)

    def _say_at_switch(self, state: SessionState) -> None:
        """Beside the switch: what bending costs, or why this blade does not bend."""
        solution, words = state.solution, ""
        if not can_bend(solution.design.rotor):
            reason = why_no_hub_loads(solution.design)
            words = "" if reason is None else reason.sentence.removeprefix("No hub loads: ")
        elif solution.design.models.bending and self._rigid is not None and self._rigid[0] is solution:
            rigid = self._rigid[1]
            if rigid.converged:
                added = solution.power.total - rigid.power.total
                words = f"{UNITS[state.view.units].watts(added, 1, sign=True)} here"
        self._context.controls.show_bending(words[:1].upper() + words[1:])

    def _draw(self) -> None:
        if self._state is not None:
            labels = _how_bent(self._state.solution)
            self._context.bridge.set(vibration=self._card(self._state), hub_labels=labels)

    def _card(self, state: SessionState) -> VibrationPart | None:
        """The row of the power card; None without bending."""
        design = state.solution.design
        if not design.models.bending:
            return None
        reason, loads = why_no_hub_loads(design), self._loads.get(state.solution)
        if reason is not None or loads is None:
            sentence = "No hub loads: no trim with bending." if reason is None else reason.sentence
            return VibrationPart(sentence, sentence=sentence)
        band = "band over inflow models: computing"
        if loads.band is not None:
            band = f"{number(loads.band[0], 1)} to {number(loads.band[1], 1)} over inflow models"
        change, kind = self._change(state, loads)
        return VibrationPart(
            _title(loads),
            index=number(loads.index, 1),
            unit=index_unit(design),
            at=f"at {loads.per_rev}/rev",
            band=band,
            change=change,
            kind=kind,
        )

    def _change(self, state: SessionState, loads: HubLoads) -> tuple[str, str]:
        """Against A, or the blade as built; and its class."""
        reference = self._loads.get(state.reference)
        if reference is None or state.reference.design == state.solution.design:
            return "", ""
        percent = 100.0 * (loads.index / reference.index - 1.0)
        kind = "" if abs(percent) < _NOTICEABLE else "good" if percent < 0.0 else "bad"
        against = "A" if state.pinned is not None else "as built"
        return f"{number(percent, 0, sign=True)} % vs. {against} ({number(reference.index, 1)})", kind


def _how_bent(solution: Solution) -> list[SceneLabel]:
    """The words in the scene: bending is drawn larger."""
    if solution.deflections is None:
        return []
    rotor = solution.design.rotor
    tip = [1.04 * (1.0 - rotor.blade.flap_hinge) * rotor.radius, 0.0, 0.0]
    title = "Flap and lag bending from the straight blade (grey), drawn ten times as large."
    return [SceneLabel(f"bending × {BENDING_SHOWN:g}", f"{ROTOR}/blade_0", tip, title)]


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
