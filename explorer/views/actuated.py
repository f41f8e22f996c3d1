"""The state of Actuate: the actuator on the blade of the sliders, what it moves, costs and gives, and what is asked.

Tip twist is that in flight, at the tip, nose up positive: what the actuator adds to the rotating blade
(`InstalledActuator.tip`). All changes count from one blade, `ActuatorInputs.against`.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, cast

import numpy as np

from explorer.model.actuator_inputs import (
    ActuatorInputs,
    Outcome,
    VerdictInputs,
    flight_legs,
    flight_of,
    verdict_inputs_of,
    verdict_tasks,
)
from explorer.views.dial_answer import HARMONICS, FittedBlade, compared
from explorer.views.page_state import OpenPanels, PageState
from explorer.workers.call import Call
from rotor import Design
from rotor.actuator import (
    ActuatorFlight,
    EffectInFlight,
    FlightLeg,
    InstalledActuator,
    OtherStroke,
    Verdict,
    effect,
    other_stroke,
    powers,
)
from rotor.actuator.verdict import Against
from rotor.dynamics.structure import check_blade
from rotor.trim.doubt import sureness


def in_actuate(ui: OpenPanels) -> bool:
    return ui.mode == "actuate"


def blade_out(ui: OpenPanels) -> bool:
    """Whether Actuate shows the blade out of the rotor."""
    return in_actuate(ui) and ui.lifted


def actuated_blade(now: PageState) -> "ActuatedBlade | None":
    """One for all panels; None where the sliders mean no design, or one that cannot carry the actuator."""
    found = now.of(_built)
    return found if isinstance(found, ActuatedBlade) else None


def problem(now: PageState) -> str:
    """Why there is no solution, or no such actuator; empty where there are both."""
    found = now.of(_built)
    return now.problem or (found if isinstance(found, str) else "")


def _built(now: PageState) -> "ActuatedBlade | str":
    design, inputs = now.sliders, now.hand.actuator
    if design is None:
        return now.problem
    try:
        check_blade(design.aircraft)
        installed, question = inputs.installed(design.rotor), verdict_inputs_of(inputs, design)
    except ValueError as error:
        return str(error)
    tasks = verdict_tasks(question)
    outcomes = {id: now.answers.get(task) for id, task in tasks.items()}
    outcome = outcomes[question.actuator]
    verdict = outcome if isinstance(outcome, Verdict) else None
    flight_task = None if verdict is None else Call(flight_of, (verdict,))
    line_task = Call(other_stroke, (verdict,)) if verdict is not None and installed.masses.aircraft else None
    flight, line = now.answers.get(flight_task), now.answers.get(line_task)
    line = line if isinstance(line, OtherStroke) else None
    judged = tasks, outcomes, outcome, verdict, flight_task, flight, flight_legs(design), line_task, line
    return ActuatedBlade(now, design, installed, inputs, question, *judged)


class PowerChange(NamedTuple):
    """A change of power [W], more is positive, and its band, to both sides; None: not known."""

    power: float
    band: float | None

    @property
    def kind(self) -> Literal["gain", "loss", ""]:
        """Empty where its sign is unclear."""
        if self.band is not None and sureness(self.power, self.band) == "unclear":
            return ""
        return "loss" if self.power > 0.0 else "gain"


@dataclass(frozen=True, eq=False)
class ActuatedBlade:
    """The actuator on the blade, and what is known of it; of an answer, a sentence says why there is none, None that it
    is on its way. Twists of the tip in flight [rad]."""

    now: PageState = field(repr=False)
    design: Design
    """On the sliders, without the actuator's twist."""
    installed: InstalledActuator
    inputs: ActuatorInputs
    question: VerdictInputs
    tasks: Mapping[str, Call]
    """Of verdicts, by actuator: the chosen one first."""
    outcomes: Mapping[str, Outcome | None]
    """By actuator."""
    outcome: Outcome | None
    """Of the chosen one."""
    verdict: Verdict | None
    flight_task: Call | None
    flight: ActuatorFlight | str | None
    legs: tuple[FlightLeg, ...]
    line_task: Call | None
    line: OtherStroke | None
    """The verdict with another range and mass; None: not known."""

    @property
    def name(self) -> str:
        return self.installed.actuator.id.replace("_", " ")

    @property
    def mass(self) -> float:
        """On board [kg]: of all blades, and the electronics."""
        return self.installed.masses.aircraft

    @property
    def range(self) -> float:
        """From one end of the reach to the other."""
        return self.installed.attainable

    @property
    def wanted(self) -> float | None:
        """Twist of least power in this flight; None: not known."""
        if not isinstance(self.flight, ActuatorFlight):
            return None
        speeds = [leg.advance_ratio for leg in self.legs]
        return float(np.interp(self.now.inputs.advance_ratio, speeds, self.flight.wanted))

    @property
    def here(self) -> PowerChange | None:
        """In this flight."""
        known = self.now.of(change_here)
        return PowerChange(known.power[0], known.band) if isinstance(known, EffectInFlight) else None

    @property
    def vibration(self) -> EffectInFlight | None:
        """In this flight; None where there are no hub loads."""
        known = self.now.of(change_here)
        return known if isinstance(known, EffectInFlight) and known.index else None

    @property
    def over_flight(self) -> PowerChange | None:
        """Mean over the mission, at its best twist."""
        return None if self.verdict is None else PowerChange(-self.verdict.net_saving, self.verdict.net_band)


def against_words(one: ActuatedBlade, against: Against) -> str:
    """The blade that changes count from."""
    if against == "best-fixed":
        return "best fixed blade"
    return "same blade without it" if one.question.host.kind == "retrofit" else "present blade"


def fitted(now: PageState) -> FittedBlade | None:
    """The actuator on the blade, and the blade compared with; None where there is no actuator."""
    if (one := actuated_blade(now)) is None:
        return None
    inputs = one.inputs
    fixed = None if one.verdict is None else one.verdict.baseline.fixed_twist
    twist = one.design.twist if inputs.against == "same-blade" else fixed
    return FittedBlade(
        one.installed, inputs.driven_at(one.installed), twist, f"the {against_words(one, inputs.against)}"
    )


def pair_compared(now: PageState) -> Any:
    """What flies, and the blade compared with; None where not both are known."""
    if now.state is None or now.sliders is None or now.problem:
        return None
    return compared(now.state.solution.design, now.sliders, now.of(fitted))


def effect_asked(now: PageState) -> Call | None:
    """The trims of what flies and of the blade compared with."""
    pair = now.of(pair_compared)
    return None if pair is None else Call(effect, pair)


def change_here(now: PageState) -> EffectInFlight | str | None:
    """What the actuator changes in this flight, its drive included; or why that is not known."""
    found, on_blade = now.answers.get(now.of(effect_asked)), now.of(fitted)
    if not isinstance(found, EffectInFlight) or on_blade is None:
        return found
    drive = _drive(now, on_blade)
    return EffectInFlight(tuple(power + drive for power in found.power), found.index, found.band)


def _drive(now: PageState, on_blade: FittedBlade) -> float:
    """Power that the drive takes in this flight [W]."""
    losses = dict(zip(HARMONICS, on_blade.losses, strict=True))
    drive = sum(losses.get(one.per_rev, 0.0) * math.degrees(one.amplitude) ** 2 for one in now.inputs.twist_per_rev)
    verdict = one.verdict if (one := actuated_blade(now)) is not None and now.hand.actuator.driven else None
    return drive + (0.0 if verdict is None else verdict.drive.hold_power)


def parts_asked(now: PageState) -> Call | None:
    """Trims of the blade compared with, with the twist, and with the stiffness too; None where not all are known."""
    pair, one = now.of(pair_compared), actuated_blade(now)
    if pair is None or one is None or now.state is None or now.sliders is None:
        return None
    twisted, _ = compared(now.state.solution.design, now.sliders, None) or pair
    return Call(powers, ((pair[1], twisted, one.installed.on(twisted)),))


def parts_here(now: PageState) -> tuple[tuple[str, float], ...]:
    """Name and saving [W] of each part in this flight, as `Verdict.savings`; their sum is that of `change_here`."""
    found, on_blade, known = now.answers.get(now.of(parts_asked)), now.of(fitted), now.of(change_here)
    if not isinstance(found, tuple) or on_blade is None or not isinstance(known, EffectInFlight):
        return ()
    bare, twisted, stiff = cast("tuple[float, float, float]", found)
    drive = _drive(now, on_blade)
    stiffness = (("stiffness", twisted - stiff),) if twisted != stiff else ()
    return (
        ("gross", bare - twisted),
        *stiffness,
        ("mass", stiff - bare - known.power[0] + drive),
        ("drive", 0.0 - drive),
    )


def here_problem(now: PageState) -> str:
    """Why there is no verdict, or none in this flight; empty where there is one or it is on its way."""
    one, found = actuated_blade(now), now.of(change_here)
    outcome = None if one is None else one.outcome
    return outcome if isinstance(outcome, str) else found if isinstance(found, str) else ""
