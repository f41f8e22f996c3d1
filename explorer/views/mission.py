"""The mission: hours of its legs, which verdict, balance of power, schedule and search have in common.

They are set on the flight bar of Actuate; for a rotor that carries no actuator, in the Schedule section.
"""

from collections.abc import Sequence

from explorer.model.actuator_inputs import LONGEST, hours_with, mission_over
from explorer.text.readout import mission_hours
from explorer.views.page_state import Effect, OpenPanels, PageState, Panel, SetHand
from rotor import Design
from rotor.dynamics.structure import KNOWN_BLADE
from rotor.optimisation import FlightLeg, standard_flight
from rotor.support.markup import Markup, tag

TEXT = "schedule.mission"
"""Name of the widget that shows it."""


def view(now: PageState) -> dict[str, Markup]:
    """The mission in words, and where there is no flight bar a field for the hours of each leg."""
    design, hours = now.sliders, now.hand.actuator.hours
    if design is None:
        return {}
    try:
        mission = mission_over(design, hours)
    except ValueError as error:  # A free rotor does not hover: set the hours of that leg to 0.
        return {TEXT: _with_fields(str(error), design, hours)}
    if design.aircraft.key == KNOWN_BLADE:
        words = f"{mission_hours(mission)} Set the hours on the flight bar in Actuate."
        return {TEXT: tag("div.rx.rx-dim.rx-small", words, data_explorer="mission")}
    assumed = " (assumed)" if mission.assumed else ""
    return {TEXT: _with_fields(f"Hours of the mission{assumed}", design, hours)}


def _with_fields(words: str, design: Design, hours: Sequence[float]) -> Markup:
    """Words above a field for the hours of each leg."""
    fields = [_field(place, leg) for place, leg in enumerate(standard_flight(design, hours))]
    above = tag("div.rx-dim.rx-small", words)
    return tag("div.rx", above, tag("div.rx-hours", fields), data_explorer="mission")


def _field(place: int, leg: FlightLeg) -> Markup:
    """The hours of a leg, to be edited."""
    field = tag(
        "input",
        type="number",
        min=0.0,
        max=LONGEST,
        step=0.05,
        inputmode="decimal",
        value=f"{leg.hours:g}",
        data_hours=place,
        aria_label=f"Hours of {leg.name} in the mission",
    )
    return tag("label", f"{leg.name} ", field, " h")


def set_hours(now: PageState, leg: int, hours: float) -> tuple[Effect, ...]:
    """The hours of a leg were set."""
    before = now.hand.actuator.hours
    if leg >= len(before):
        return ()
    return (SetHand(actuator={"hours": hours_with(before, leg, hours)}),)


def _in_mission_modes(ui: OpenPanels) -> bool:
    """Whether hours are shown and set: the modes with the flight bar and the Schedule section."""
    return ui.mode in ("optimise", "actuate")


MISSION = Panel(
    view, _in_mission_modes, presses={"hours": lambda now, value: set_hours(now, *value)}
)
