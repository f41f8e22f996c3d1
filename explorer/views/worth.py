"""What a step of each slider changes: of the twist exactly, from one adjoint, with the band of two designs a step
apart; of the flight by differences of trims, with the band of power in proportion, because all its parts change."""

from collections.abc import Generator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any, Literal

from explorer.colours import PARTS
from explorer.model.inputs import LAWS, Inputs
from explorer.model.sliders import (
    SLIDERS,
    SliderSensitivity,
    flight_sensitivities,
    limits,
    slider,
    twist_sensitivities,
)
from explorer.model.units import SI, Units, number
from explorer.parts.results import SliderSaving
from explorer.text.readout import banded, fineness
from explorer.views.page_state import PageState, Panel, PanelWork, as_one_step
from explorer.views.work import has_power, shown_doubt
from rotor import doubt, solve
from rotor.trim.analysis import Analysis
from rotor.trim.doubt import sureness
from rotor.trim.power import PowerBudget

_HALF_LENGTH = 0.005
"""Change of a step, as a part of the power that is needed, at which the arrow has half the greatest length, so that
none looks as long as a larger one."""
_NOTHING = 1e-6
"""[W]: a handle that acts changes more by a step, at an optimum too, where its slope is zero to the digits shown."""


def slopes_work(now: PageState) -> tuple[PanelWork, ...]:
    """∂P/∂θ(r), and what a step of each slider of the flight changes, at two trims each; none without power."""
    state, analyses = now.state, now.analyses
    if state is None or now.problem or not has_power(state.solution.design):
        return ()
    solution = state.solution

    about = (solution.design,)
    of_twist = PanelWork(
        "slopes", about, as_one_step(lambda: analyses.of(solution).gradient), soon=True
    )
    works = of_twist, PanelWork("flight-slopes", about, lambda tell: flight_sensitivities(solution))
    of_steps = PanelWork(
        "twist-steps", about, lambda tell: step_bands(state.inputs, analyses.of(solution))
    )
    return (*works, of_steps) if state.inputs.design() == solution.design else works


def step_bands(inputs: Inputs, here: Analysis) -> Generator[None, None, Mapping[str, float]]:
    """Band of what a step of each twist slider changes [W]; without those whose design does not trim."""
    found = dict[str, float]()
    for name in LAWS[inputs.law].inputs:
        yield
        step, high = slider(name, SI).natural, limits(name)[1]
        step = step if getattr(inputs, name) + step <= high else -step
        with suppress(ValueError):
            there = solve(
                replace(inputs, **{name: getattr(inputs, name) + step}).design(), here.solution
            )
            if there.converged and (band := doubt(there, here).change_band) is not None:
                found[name] = band
    return found


def twist_slopes(now: PageState) -> dict[str, float]:
    """Change of power for a unit of each twist slider [W], of the design shown; empty until it is known."""
    asked, state = slopes_work(now), now.state
    gradient = now.answers.get(asked[0].key) if asked else None
    if state is None or gradient is None or state.solution.design != state.inputs.design():
        return {}
    return {name: one.slope for name, one in twist_sensitivities(state.inputs, gradient).items()}


def worth(now: PageState) -> dict[str, Any]:
    """Until the page rests, what was known of the design before stands there, marked as stale."""
    state, asked, rows = now.state, slopes_work(now), dict[str, SliderSaving]()
    if state is None or not asked:
        return {"worth": rows}
    (gradient, of_now), (flight, flight_of_now), *rest = map(now.latest, asked)
    bands: Mapping[str, float] = (rest[0][0] if rest else None) or {}
    power = state.solution.power
    sure = now.latest(shown_doubt(now)[0])[0]
    part = None if sure is None or not sure.power else sure.band / abs(sure.power)
    if gradient is not None and state.solution.design == state.inputs.design():
        for name, one in twist_sensitivities(state.inputs, gradient).items():
            rows[name] = worth_row(one, power, now.units, bands.get(name), stale=not of_now)
    for name, one in (flight or {}).items():
        band = part and part * abs(one.watts(now.units))
        rows[name] = worth_row(one, power, now.units, band, stale=not flight_of_now)
    return {"worth": rows}


def worth_row(
    one: SliderSensitivity,
    power: PowerBudget,
    units: Units,
    band: float | None = None,
    *,
    stale: bool = False,
) -> SliderSaving:
    """The change of `power` by a step up, with its sign and band [W], and which way saves if that is known; one
    decimal more than power has."""
    ways: dict[int, Literal["up", "down", ""]] = {1: "up", -1: "down", 0: ""}
    digits = 1 + fineness(power, units)
    way = ways[one.saving_direction(units, digits)]
    change = one.watts(units)
    none = "flat here" if abs(change) > _NOTHING else "no effect"
    value = one.value_text(units, digits) if way else none
    title = SLIDERS[one.name].label.partition(" [")[0]
    step = slider(one.name, units).per.removeprefix("/").removeprefix(" per ").strip("()")
    step = step if step[0].isdigit() else f"1{step}" if step[0] == "°" else f"1 {step}"
    words = (
        f"{value} {units.power[0].symbol}"
        if band is None
        else banded(change, band, units, sign=True)
    )
    less = f"less than {number(0.5 * 10.0**-digits, digits + 1)} {units.power[0].symbol}"
    sentence = f"{title}: {step} more changes power by {words if way else less}."
    if way and (band is None or sureness(change, band) == "unclear"):
        way, value = "", f"{value} {one.unit_text(units)}"
    elif way:
        sentence += f" A {'higher' if way == 'up' else 'lower'} value saves power."
    size, needed = abs(one.watts()), sum(max(getattr(power, name), 0.0) for name in PARTS)
    part = round(size / (size + _HALF_LENGTH * needed), 3) if size else 0.0
    return SliderSaving(way, value, one.unit_text(units), part, sentence, stale)


WORTH = Panel(worth, works=lambda now: slopes_work(now)[: 1 if now.ui.lifted else None])
