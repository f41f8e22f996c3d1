"""What a step of each slider changes. Of the twist exactly, from one adjoint; of the flight by differences of trims."""

from collections.abc import Callable, Mapping
from typing import Any, Literal

from explorer.model.sliders import SLIDERS, SliderSensitivity, flight_sensitivities, slider, twist_sensitivities
from explorer.model.units import Units
from explorer.parts.results import SliderSaving
from explorer.views.page_state import PageState, Panel, PanelWork, Tell
from explorer.views.work import has_power

_HALF_LENGTH = 6.0
"""Change of a step in the unit of power at which the arrow has half the greatest length, so that none looks as long as
a larger one."""


def slopes_asked(now: PageState) -> tuple[PanelWork, ...]:
    """∂P/∂θ(r), and what a step of each slider of the flight changes, at two trims each; none without power."""
    state, analyses = now.state, now.analyses
    if state is None or now.problem or not has_power(state.solution.design):
        return ()
    solution = state.solution

    def of_flight(superseded: Callable[[], bool], tell: Tell) -> Mapping[str, SliderSensitivity] | None:
        found = flight_sensitivities(solution, superseded)
        return None if superseded() else found

    of_twist = PanelWork(
        "slopes", (solution.design,), lambda superseded, tell: analyses.of(solution).gradient, soon=True
    )
    return of_twist, PanelWork("flight-slopes", (solution.design,), of_flight)


def twist_slopes(now: PageState) -> dict[str, float]:
    """Change of power for a unit of each twist slider [W], of the design shown; empty until it is known."""
    asked, state = slopes_asked(now), now.state
    gradient = now.answers.get(asked[0].key) if asked else None
    if state is None or gradient is None or state.solution.design != state.inputs.design():
        return {}
    return {name: one.slope for name, one in twist_sensitivities(state.inputs, gradient).items()}


def worth(now: PageState) -> dict[str, Any]:
    """Until the page rests, what was known of the design before stands there, marked as stale."""
    state, asked, rows = now.state, slopes_asked(now), dict[str, SliderSaving]()
    if state is None or not asked:
        return {"worth": rows}
    (gradient, of_now), (flight, flight_of_now) = map(now.latest, asked)
    if gradient is not None and state.solution.design == state.inputs.design():
        for name, one in twist_sensitivities(state.inputs, gradient).items():
            rows[name] = worth_row(one, now.units, stale=not of_now)
    for name, one in (flight or {}).items():
        rows[name] = worth_row(one, now.units, stale=not flight_of_now)
    return {"worth": rows}


def worth_row(sensitivity: SliderSensitivity, units: Units, *, stale: bool = False) -> SliderSaving:
    """The change of power by a step up, with its sign, and which way saves."""
    ways: dict[int, Literal["up", "down", ""]] = {1: "up", -1: "down", 0: ""}
    way = ways[sensitivity.saving_direction(units)]
    value = sensitivity.value_text(units) if way else "no effect"
    title = SLIDERS[sensitivity.name].label.partition(" [")[0]
    step = slider(sensitivity.name, units).per.removeprefix("/").removeprefix(" per ").strip("()")
    step = step if step[0].isdigit() else f"1{step}" if step[0] == "°" else f"1 {step}"
    sentence = (
        f"{title}: {step} more changes power by {value} {units.power[0].symbol}. "
        f"A {'higher' if way == 'up' else 'lower'} value saves power."
        if way
        else f"{title}: {step} more changes power by less than 0.05 {units.power[0].symbol}."
    )
    size = abs(units.power[0].of(sensitivity.watts()))
    return SliderSaving(
        way, value, sensitivity.unit_text(units), round(size / (size + _HALF_LENGTH), 3), sentence, stale
    )


WORTH = Panel(worth, works=slopes_asked)
