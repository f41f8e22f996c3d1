"""What follows a solution on the frame: power card, sensitivities beside the sliders, and the drawer of power.

One file, because all of it is drawn from one solution in one update.
"""

import math
import re
from collections.abc import Callable
from typing import Any

from explorer.charts.doubt import card_words, doubt_rows
from explorer.hosting.browser import Bridge
from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.sliders import SLIDERS, SliderSensitivity, flight_sensitivities, slider, twist_sensitivities
from explorer.model.undo import PowerTracker
from explorer.model.units import BLANK, SI, UNITS, Units, number
from explorer.picture.blade_mesh import inset
from explorer.picture.picture import flown_twist, follows_azimuth
from explorer.scene.overlays import ghost_twist
from explorer.tabs.background import PoolAnswers
from explorer.tabs.context import TabContext
from explorer.tabs.live_charts import ChartStrip, against
from explorer.text import readout
from explorer.text.readout import fineness, ideal_induced, part_titles
from explorer.text.status import cautions, status_panel, trust_page, validated
from explorer.text.why import why
from explorer.workers.call import Call
from rotor import Solution, doubt
from rotor.markup import Markup
from rotor.trim import Analysis, PitchGradient
from rotor.trim.doubt import models_beside

_STILL = 0.6
"""[s] without a change before other models are solved."""
_HALF = 6e3
"""Change [W] of a step at which the arrow has half the greatest length, so that none looks as long as a larger one."""


class SliderSensitivities:
    """One session's. Twist sliders follow at once, exactly; flight sliders once the page rests."""

    def __init__(self, bridge: Bridge) -> None:
        self._bridge = bridge
        self._twist: dict[str, SliderSensitivity] = {}
        self._flight: dict[str, SliderSensitivity] = {}

    def show(self, state: SessionState, gradient: PitchGradient | None) -> None:
        """Follow a converged state; those of flight sliders are not known yet."""
        current = gradient is not None and state.solution.design == state.inputs.design()
        self._twist = twist_sensitivities(state.inputs, gradient) if gradient is not None and current else {}
        self._flight = {}
        self._send(state)

    @property
    def slopes(self) -> dict[str, float]:
        """Change of power for a unit of each twist slider [W]."""
        return {name: worth.slope for name, worth in self._twist.items()}

    def solve_flight(self, state: SessionState, superseded: Callable[[], bool]) -> None:
        """Compute those of the flight sliders, unless newer input comes."""
        flight = flight_sensitivities(state.solution, superseded)
        if not superseded():
            self._flight = flight
            self._send(state)

    def clear(self) -> None:
        self._twist, self._flight = {}, {}
        self._bridge.set(worth={})

    def _send(self, state: SessionState) -> None:
        units = UNITS[state.view.units]
        known = {**self._twist, **self._flight}
        self._bridge.set(worth={name: sensitivity_row(state.inputs, change, units) for name, change in known.items()})


def sensitivity_row(inputs: Inputs, sensitivity: SliderSensitivity, units: Units) -> dict[str, Any]:
    """The change of power by a step up, with its sign, where the arrow starts along the slider, and which way saves."""
    form = slider(sensitivity.name, SI, inputs.aircraft)
    at = (getattr(inputs, sensitivity.name) - form.low) / (form.high - form.low)
    way = {1: "up", -1: "down", 0: ""}[sensitivity.saving_direction]
    value = sensitivity.value_text(units) if way else "no effect"
    if sensitivity.name in inputs.idle:
        value = "no effect without a change of twist"
    title = SLIDERS[sensitivity.name].label.partition(" [")[0]
    step = slider(sensitivity.name, units).per.removeprefix("/").removeprefix(" per ").strip("()")
    step = step if step[0].isdigit() else f"1{step}" if step[0] == "°" else f"1 {step}"
    sentence = (
        f"{title}: {step} more changes power by {value} {units.power[0].symbol}. "
        f"A {'higher' if way == 'up' else 'lower'} value saves power."
        if way
        else f"{title}: {step} more changes power by less than 0.05 kW."
    )
    size = abs(sensitivity.watts())
    return {
        "at": round(min(max(at, 0.0), 1.0), 4),
        "way": way,
        "value": value,
        "unit": sensitivity.unit_text(units),
        "size": round(size / (size + _HALF), 3),
        "sentence": sentence,
    }


_NOTICEABLE = 0.05
"""Changes below this [%] have no colour."""
_TELLING = 0.1
"""In descent and autorotation total power is near zero: below this part of its positive parts it has no percentage."""
_STALLED = 0.01
"""Part of the thrust, or a fifth of that of the disk, from which stall is named beside the power: near the root much of
the disk may be stalled without weight.
"""


class PowerCard:
    """One session's. It keeps the solution before a grab, so that it can say why power changed."""

    def __init__(self, bridge: Bridge, tracker: PowerTracker) -> None:
        self._bridge, self._tracker = bridge, tracker
        self._last: Solution | None = None
        self._before: Solution | None = None
        """The solution that the change since the grab counts from."""
        self._counted_from: float | None = None
        """Power of the solution that the change counts from [W]."""
        self._content: dict[str, Any] | None = None
        self._doubt = _NO_DOUBT

    def show(self, state: SessionState, pause: float) -> None:
        """Show a converged state. `pause`: the longest rest of the inputs [s] since the last one."""
        solution, units = state.solution, UNITS[state.view.units]
        self._tracker.solved(state.inputs, solution.power.total, pause)
        if self._tracker.reference != self._counted_from:
            first = self._tracker.reference == solution.power.total
            self._counted_from, self._before = self._tracker.reference, solution if first else self._last
        self._last = solution
        numbers = {**_numbers(state, units), **self._change(state, units)}
        self._content = {**numbers, "problem": "", "status": _status(state), **self._doubt}
        self._bridge.set(power=self._content)

    def show_doubt(self, words: dict[str, Any]) -> None:
        """Say how sure the numbers shown are; while the twist moves, the words of the step before stay."""
        self._doubt = words
        if self._content is not None and not self._content["problem"]:
            self._content = {**self._content, **words}
            self._bridge.set(power=self._content)

    def show_problem(self, sentence: str) -> None:
        """Keep the last numbers, greyed, beside the sentence that says why there are none."""
        if self._content is None:
            self._content = _EMPTY
        status = {"kind": "problem", "words": "no trim", "title": sentence}
        sentence = re.sub(r" The nearest trim found is at .*?\.(?= |$)", "", sentence)  # The button may find another.
        problem = f"{sentence.rstrip('.')}. Greyed: last converged solution."
        self._bridge.set(power={**self._content, "problem": problem, "status": status})

    def hand(self, units: Units) -> dict[str, Any] | None:
        """Power, its change and that before the grab, for the scale beside the blade; None before any solution."""
        last, change = self._last, self._tracker.change or 0.0
        if last is None:
            return None
        unit, digits = units.power[0], fineness(last.power)
        return {
            "power": units.watts(last.power.total, digits),
            "change": unit.text(change, digits, sign=True),
            "kind": _kind(change, last.power.total),
            "now": round(unit.of(last.power.total), 2),
            "before": round(unit.of(last.power.total - change), 2),
            "digits": digits,
        }

    def _change(self, state: SessionState, units: Units) -> dict[str, Any]:
        """Change since the grab, else from the reference, and why."""
        solution, reference, pinned = state.solution, state.reference, state.pinned is not None
        change, before, words = self._tracker.change, self._before, "since grabbed"
        if change is None or before is None:
            if solution.design == reference.design or not reference.converged:
                rest = "same as A" if pinned else "as built"
                return {"since": None, "rest": rest, "why": "Pull the blade tip up or down."}
            change, before = solution.power.total - reference.power.total, reference
            words = "vs. A" if pinned else "vs. as built"
        value = units.watts(change, fineness(solution.power), sign=True)
        since = {"value": value, "words": words, "kind": _kind(change, solution.power.total)}
        return {"since": since, "rest": "", "why": why(before, solution, units)}


def _numbers(state: SessionState, units: Units) -> dict[str, Any]:
    solution, power = state.solution, state.solution.power
    reference = state.reference.power if state.reference.converged else None
    unit, digits = units.power[0], fineness(power)
    whole = sum(max(getattr(power, name), 0.0) for name in part_titles(solution.design))
    apart = percent = None
    if reference is not None:
        apart = units.watts(power.total - reference.total, digits, sign=True)
        if reference.total > _TELLING * whole:
            percent = 100.0 * (power.total / reference.total - 1.0)
    parts = []
    for name, words in part_titles(solution.design).items():
        value = getattr(power, name)
        title = f"{words} power {units.watts(value, digits)}"
        if reference is not None:
            title += f", {units.watts(value - getattr(reference, name), digits, sign=True)} vs. reference"
        share = round(value / whole, 5) if whole > 0.0 else 0.0
        shown = {"name": words.removesuffix(" rotor"), "value": number(unit.of(value), digits)}
        parts.append({"part": name, **shown, "share": share, "title": title})
    ideal = ideal_induced(solution)
    return {
        "total": number(unit.of(power.total), digits),
        "unit": unit.symbol,
        "change": apart or BLANK if percent is None else f"{number(percent, 1, sign=True)} %",
        "kind": "" if percent is None else _kind(percent, 100.0),
        "against": against(solution.design, state.pinned is not None),
        "parts": parts,
        "ideal": None if ideal is None or whole <= 0.0 else round(ideal / whole, 5),
        "ideal_title": "" if ideal is None else f"Least induced power at this lift: {units.watts(ideal)}",
    }


def _status(state: SessionState) -> dict[str, str]:
    """The chip: trimmed, or engines, stalled area, number of caveats; and how well this rotor is validated here."""
    reasons = cautions(state.solution, state.pinned)
    stalled = state.solution.stalled_area
    record = validated(state.solution)
    title = " ".join([*reasons, record.sentence])
    if state.solution.power.total < 0.0:
        words = "autorotation"
    elif (installed := _exceeded(state.solution)) is not None:
        words = f"engines give only {UNITS[state.view.units].watts(installed)}"
    elif max(state.solution.stalled_thrust, 0.2 * stalled) >= _STALLED:
        thrust = number(100.0 * state.solution.stalled_thrust, 1)
        words = f"{number(100.0 * stalled, 1)} % of disk, {thrust} % of thrust stalled"
    elif reasons:
        words = "1 caveat" if len(reasons) == 1 else f"{len(reasons)} caveats"
    else:
        title = f"{state.solution.message} {record.sentence} Click: how far to trust it."
        return {"kind": "converged", "words": "trimmed", "measured": record.words, "title": title}
    return {"kind": "care", "words": words, "measured": record.words, "title": title}


def _exceeded(solution: Solution) -> float | None:
    """Power of the engines [W] where the rotors take more; None where they do not, or it is not known."""
    beyond = any(caveat.name == "installed-power" for caveat in solution.caveats)
    return solution.design.aircraft.installed_power if beyond else None


def _kind(change: float, total: float) -> str:
    """Class of a change of power [W]."""
    if total <= 0.0 or abs(100.0 * change / total) < _NOTICEABLE:
        return ""
    return "good" if change < 0.0 else "bad"


_NO_DOUBT: dict[str, Any] = {"within": "", "change_within": "", "sure": "", "doubt": ""}
_EMPTY: dict[str, Any] = {
    **_NO_DOUBT,
    **dict.fromkeys(("kind", "ideal_title", "rest", "why"), ""),
    **dict.fromkeys(("ideal", "since")),
    "total": "–",
    "unit": "kW",
    "change": "–",
    "against": "as built",
    "parts": [],
}


class ResultsPanel:
    def __init__(self, context: TabContext) -> None:
        gui, bridge, layout = context.gui, context.bridge, context.layout
        self._bridge, self._layout = bridge, layout
        self.card = PowerCard(bridge, context.tracker)
        self.strip = ChartStrip(bridge)
        self.sliders = SliderSensitivities(bridge)
        self._models = PoolAnswers(context.pool, 5, context.wake)
        """The powers with other models."""
        self._state: SessionState | None = None
        """The last converged one."""
        self._analyses = context.analyses
        with layout.in_drawer("details"):
            self._power = gui.add_html("")
            self._trim = gui.add_html("")
        with layout.in_drawer("trust"):
            self._status = gui.add_html(status_panel(None))
            self._doubts = gui.add_html("")
            gui.add_html(trust_page())

    def show(self, state: SessionState, pause: float) -> None:
        """Follow a converged state. `pause`: the longest rest of the inputs [s] since the last one."""
        self._state = state
        self.card.show(state, pause)
        self._show_inset(state)
        own, other = self._analyses.of(state.solution), self._analyses.of(state.reference)
        self.sliders.show(state, _gradient(own))
        self.strip.show(state)
        self._show_doubt(state, own, other)
        if self._layout.drawer == "trust":
            self._status.content = status_panel(state.solution, pinned=state.pinned)
        if self._layout.drawer == "details":
            self._power.content, self._trim.content = _tables(state)

    def stop(self) -> None:
        """The browser has left."""
        self._models.stop()

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

    def problem(self, sentence: str) -> None:
        """Keep the last converged numbers, greyed, with the sentence that says why there are none."""
        self.card.show_problem(sentence)
        self.strip.fade()
        self.sliders.clear()
        self._status.content = status_panel(None, sentence)
        if self._state is not None:
            self._power.content, self._trim.content = map(readout.faded, _tables(self._state))

    def _show_doubt(self, state: SessionState, own: Analysis, other: Analysis) -> None:
        """How sure power is, and its change from the reference."""
        solution, reference = state.solution, state.reference
        if solution.design.models.trim == "free-rotor":
            self.card.show_doubt(_NO_DOUBT)
            self._doubts.content = ""
            return
        there = reference.design
        compared = reference.converged and there != solution.design and there.models.trim != "free-rotor"
        units, doubted = UNITS[state.view.units], doubt(own, other if compared else None)
        self.card.show_doubt(card_words(doubted, units))
        task = Call(models_beside, (solution.design, there if compared else None))
        opened = self._layout.drawer == "trust"
        self._models.ask((task,) if opened else (), _STILL)
        if opened:
            models = self._models.answer(task)
            self._doubts.content = doubt_rows(doubted, units, models if isinstance(models, tuple) else ())

    def _show_inset(self, state: SessionState) -> None:
        solution, psi = state.solution, math.radians(state.view.azimuth_deg)
        design, reference = solution.design, state.reference.design
        elastic, changed = solution.elastic is not None, reference.twist != design.twist
        same_size = design.rotor.radius == reference.rotor.radius
        ghost = ghost_twist(solution, reference.twist, psi) if same_size or not changed else None
        name = against(design, state.pinned is not None).removeprefix(f"{design.aircraft.name} ")
        names = {
            "name": "flown",
            "name_hint": "Jig twist and elastic twist, at the azimuth of the reference blade"
            + (f", ψ {state.view.azimuth_deg:.0f}°." if follows_azimuth(solution) else "."),
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


def _gradient(analysis: Analysis) -> PitchGradient | None:
    """None for a free rotor: its shaft takes no power, whatever the twist."""
    return None if analysis.solution.design.models.trim == "free-rotor" else analysis.gradient


def _tables(state: SessionState) -> tuple[Markup, Markup]:
    """Power and trim: of this design, or of A and B."""
    solution, pinned, units = state.solution, state.pinned, UNITS[state.view.units]
    if pinned is None:
        return readout.power_panel(solution, state.baseline, units), readout.trim_panel(solution)
    return readout.compared_power_panel(solution, pinned, units), readout.compared_trim_panel(solution, pinned)
