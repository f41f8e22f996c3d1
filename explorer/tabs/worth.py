"""What a step of each slider is worth, for the arrows below the sliders."""

from collections.abc import Callable
from typing import Any

from explorer.interface import SessionState
from explorer.overlay.bridge import Bridge
from explorer.sensitivity import SliderSensitivity, flight_sensitivities, natural_step, twist_sensitivities
from explorer.sliders import SLIDERS, slider
from explorer.text.units import UNITS, Units
from rotor.trim.adjoint import PitchGradient

_LONGEST = 6e3
"""Saving [W] of a step at which the arrow is as long as it gets."""


def place(name: str) -> str:
    """The empty row below a slider that the arrow goes into, as HTML."""
    return f'<div class="rxp-worth" data-worth="{name}"></div>'


class SliderWorth:
    """One session's. Twist sliders follow at once, exactly; flight sliders once the page rests."""

    def __init__(self, bridge: Bridge) -> None:
        self._bridge = bridge
        self._twist: dict[str, SliderSensitivity] = {}
        self._flight: dict[str, SliderSensitivity] = {}

    def show(self, state: SessionState, gradient: PitchGradient | None) -> None:
        """Follow a converged state; what flight sliders are worth is not known yet."""
        own = gradient is not None and state.solution.design == state.inputs.design()
        self._twist = twist_sensitivities(state.inputs, gradient) if gradient is not None and own else {}
        self._flight = {}
        self._send(state)

    def rest(self, state: SessionState, superseded: Callable[[], bool]) -> None:
        """Compute what the flight sliders are worth, unless newer input comes."""
        found = flight_sensitivities(state.solution, superseded)
        if not superseded():
            self._flight = found
            self._send(state)

    def clear(self) -> None:
        """The inputs have no solution."""
        self._twist, self._flight = {}, {}
        self._bridge.set(worth={})

    def _send(self, state: SessionState) -> None:
        units = UNITS[state.view.units]
        self._bridge.set(
            worth={name: _arrow(state, one, units) for name, one in {**self._twist, **self._flight}.items()}
        )


def _arrow(state: SessionState, one: SliderSensitivity, units: Units) -> dict[str, Any]:
    """Where the arrow starts along the slider, which way saves, and how much a step that way saves."""
    form = slider(one.name, UNITS["SI"], state.inputs.aircraft)
    at = (getattr(state.inputs, one.name) - form.low) / (form.high - form.low)
    way = {1: "up", -1: "down", 0: ""}[one.saving_direction]
    saved = units.power[0].text(-abs(one.watts(units)), 1, sign=True).split(" ")[0]
    title = SLIDERS[one.name].label.partition(" [")[0]
    step = natural_step(one.name, units).unit.removeprefix("/")
    sentence = (
        f"{title}: a step of {step} {way} changes power by {saved} {units.power[0].symbol}."
        if way
        else f"{title}: a step changes power by less than 0.05 kW."
    )
    return {
        "at": round(min(max(at, 0.0), 1.0), 4), "way": way,
        "saving": saved if way else "flat", "unit": one.unit_text(units),
        "size": round(abs(one.watts()) / _LONGEST, 3), "sentence": sentence,
    }  # fmt: skip
