"""What follows a solution on the frame and in the drawer of power and trim."""

import math
from collections.abc import Callable

from explorer.model.session_state import SessionState
from explorer.model.units import UNITS
from explorer.picture.blade_inset import inset
from explorer.picture.poses import flown_twist, follows_azimuth
from explorer.scene.overlays import ghost_twist
from explorer.tabs.chart_strip import ChartStrip
from explorer.tabs.context import TabContext
from explorer.tabs.power_card import PowerCard, SliderSensitivities, against
from explorer.text import comparison as ab_readout
from explorer.text import readout
from explorer.text.status import status_panel, trust_page
from rotor.analysis.series import between_drag_areas
from rotor.trim.adjoint import PitchGradient, power_gradient
from rotor.trim.solution import Solution


class ResultsPanel:
    """One session's."""

    def __init__(self, context: TabContext) -> None:
        gui, bridge, layout = context.gui, context.bridge, context.layout
        self._bridge, self._layout = bridge, layout
        self.card = PowerCard(bridge, context.tracker)
        self.strip = ChartStrip(bridge)
        self.sliders = SliderSensitivities(bridge)
        self._state: SessionState | None = None
        """The last converged one."""
        self._gradient: tuple[Solution, PitchGradient] | None = None
        self._band: tuple[Solution, tuple[Solution, Solution] | None] | None = None
        """A solution, and the same flight with the lowest and the highest drag area."""
        with layout.in_drawer("details"):
            self._power = gui.add_html("")
            self._trim = gui.add_html("")
        with layout.in_drawer("trust"):
            self._status = gui.add_html(status_panel(None))
            gui.add_html(trust_page())

    def show(self, state: SessionState, pause: float) -> None:
        """Follow a converged state. `pause`: the longest rest of the inputs [s] since the last one."""
        self._state = state
        self.card.show(state, pause)
        self._show_inset(state)
        gradient = self._gradient_of(state.solution)
        self.sliders.show(state, gradient)
        self.strip.show(state, gradient)
        if self._layout.drawer == "trust":
            self._status.content = status_panel(state.solution, pinned=state.pinned)
        if self._layout.drawer == "details":
            self._power.content, self._trim.content = _numbers(state, self._band_words(state))

    def turn(self, state: SessionState) -> None:
        """The reference blade is elsewhere: what is drawn along it follows."""
        if follows_azimuth(state.solution):
            self._show_inset(state)
        self.strip.turn(state)

    def solve_deferred(self, superseded: Callable[[], bool]) -> None:
        """The page rests: compute what can wait."""
        if self._state is not None:
            self.sliders.solve_flight(self._state, superseded)
            self.strip.solve_measured(self._state, superseded)
            self._solve_band(self._state, superseded)

    def problem(self, sentence: str) -> None:
        """Keep the last converged numbers, greyed, with the sentence that says why there are none."""
        self.card.show_problem(sentence)
        self.strip.fade()
        self.sliders.clear()
        self._status.content = status_panel(None, sentence)
        if self._state is not None:
            numbers = _numbers(self._state, self._band_words(self._state))
            self._power.content, self._trim.content = map(readout.faded, numbers)

    def _show_inset(self, state: SessionState) -> None:
        solution, psi = state.solution, math.radians(state.view.azimuth_deg)
        design, reference = solution.design, state.reference.design
        elastic, changed = solution.elastic is not None, reference.twist != design.twist
        same_size = design.rotor.radius == reference.rotor.radius
        ghost = ghost_twist(solution, reference.twist, psi) if same_size or not changed else None
        name = against(design, state.pinned is not None).removeprefix(f"{design.aircraft.name} ")
        names = {
            "name": f"flown, ψ {state.view.azimuth_deg:.0f}°" if follows_azimuth(solution) else "flown",
            "name_hint": "Jig twist and elastic twist, at the azimuth of the reference blade.",
            "ghost_name": name if changed else "jig",
            "ghost_hint": "The ghost has the same elastic twist: only the change of jig twist is seen."
            if changed
            else "The blade as built, without the loads of flight.",
        }
        if not elastic:
            plain = {"name": "this blade", "name_hint": "The blade is rigid in torsion here."}
            names |= {**plain, "ghost_name": name, "ghost_hint": ""}
        shown = inset(design.rotor, flown_twist(solution, psi), ghost, state.view.exaggeration)
        self._bridge.set(inset={**shown, **names})

    def _solve_band(self, state: SessionState, superseded: Callable[[], bool]) -> None:
        """Power between the drag areas of the sources: two more trims."""
        solution = state.solution
        if superseded() or readout.open_drag_area(solution.design) is None:
            return
        if self._band is None or self._band[0] is not solution:
            self._band = solution, between_drag_areas(solution)
        words = self._band_words(state)
        self.card.show_band(words)
        if self._layout.drawer == "details":
            self._power.content = _numbers(state, words)[0]

    def _band_words(self, state: SessionState) -> str:
        """The band of this state as far as it is known."""
        known = self._band is not None and self._band[0] is state.solution
        ends = self._band[1] if self._band is not None and known else None
        return readout.drag_band_words(state.solution.design, ends, UNITS[state.view.units])

    def _gradient_of(self, solution: Solution) -> PitchGradient | None:
        if solution.design.models.trim == "free-rotor":
            return None  # Its shaft takes no power, whatever the twist.
        if self._gradient is None or self._gradient[0] is not solution:
            self._gradient = solution, power_gradient(solution)
        return self._gradient[1]


def _numbers(state: SessionState, band: str) -> tuple[str, str]:
    """Power and trim: of this design, or of A and B."""
    solution, pinned, units = state.solution, state.pinned, UNITS[state.view.units]
    if pinned is None:
        return readout.power_panel(solution, state.baseline, units, band), readout.trim_panel(solution)
    return ab_readout.power_panel(solution, pinned, units, band), ab_readout.trim_panel(solution, pinned)
