"""The state of Actuate: the actuator on the blade of the sliders, what it moves, costs and gives, and what is asked.

Tip twist is that in flight, at the tip, nose up positive: what the actuator adds to the rotating blade
(`InstalledActuator.tip`). All changes count from one blade, `ActuatorInputs.against`.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Literal, NamedTuple, cast

from explorer.model.actuator_inputs import (
    ActuatorInputs,
    Outcome,
    VerdictInputs,
    as_it_comes,
    flight_legs,
    flight_of,
    verdict_inputs_of,
    verdict_tasks,
)
from explorer.views.dial_answer import HARMONICS, FittedBlade
from explorer.views.page_state import OpenPanels, PageState, PanelWork, as_one_step
from explorer.views.work import doubt_work
from explorer.workers.call import Call
from rotor import Design, Solution, solve
from rotor.actuator import (
    ActuatorFlight,
    EffectInFlight,
    InstalledActuator,
    OtherStroke,
    Verdict,
    actuators,
    effect,
    other_stroke,
    powers,
)
from rotor.actuator.harmonic import bending, pitching_power
from rotor.actuator.limits import why_immovable
from rotor.actuator.verdict import Against
from rotor.design import TwistLaw
from rotor.dynamics.structure import check_blade
from rotor.optimisation import FlightLeg
from rotor.trim.doubt import sureness

_FREE_ROTOR = (
    "A free rotor, turned by the wind, cannot hover, and actuators are computed for a mission that does: choose "
    "another trim."
)
"""Why a free rotor carries no actuator."""


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
    carried = found.mass if isinstance(found, ActuatedBlade) else 0.0
    return now.units.in_sliders(now.problem, carried) or (found if isinstance(found, str) else "")


def no_carrier(now: PageState) -> str:
    """Why this rotor carries no actuator, and what to choose; empty where it may carry one."""
    design = now.sliders
    if design is None:
        return ""
    try:
        check_blade(design.aircraft)
    except ValueError as error:
        return str(error)
    if design.models.trim == "free-rotor":
        return _FREE_ROTOR
    return ""


def immovable_kinds(now: PageState) -> Mapping[str, str]:
    """Kind → why it cannot move this blade. Other kinds are tested as they come, the chosen one as it is set."""
    blade = actuated_blade(now)
    if blade is None:
        return {}
    found = dict[str, str]()
    for id in actuators():
        inputs = blade.inputs
        if id != inputs.actuator:
            inputs = replace(inputs, **as_it_comes(id))
        try:
            reason = why_immovable(inputs.installed(blade.design.rotor))
        except ValueError:
            # A kind that cannot be laid out there says so itself, once it is chosen.
            continue
        if reason:
            found[id] = reason
    return found


def _built(now: PageState) -> "ActuatedBlade | str":
    design, inputs = now.sliders, now.hand.actuator
    if design is None:
        return now.problem
    try:
        if carrier := no_carrier(now):
            return carrier
        installed, question = inputs.installed(design.rotor), verdict_inputs_of(inputs, design)
    except ValueError as error:
        return str(error)
    tasks = verdict_tasks(question)
    outcomes = {id: now.answers.get(task) for id, task in tasks.items()}
    outcome = outcomes[question.actuator]
    verdict = outcome if isinstance(outcome, Verdict) else None
    flight_task = None if verdict is None else Call(flight_of, (verdict,))
    line_task = (
        Call(other_stroke, (verdict,))
        if verdict is not None and installed.masses.aircraft
        else None
    )
    flight, line = now.answers.get(flight_task), now.answers.get(line_task)
    line = line if isinstance(line, OtherStroke) else None
    judged = (
        tasks,
        outcomes,
        outcome,
        verdict,
        flight_task,
        flight,
        flight_legs(design),
        line_task,
        line,
    )
    return ActuatedBlade(now, design, installed, inputs, question, *judged)


class PowerChange(NamedTuple):
    """A change of power [W], more is positive, and its band, to both sides; None: not known. `built`: whether what
    makes it is known to keep its limits."""

    power: float
    band: float | None
    built: bool = True

    @property
    def kind(self) -> Literal["gain", "loss", ""]:
        """Empty where its sign is not known, and for a gain that nothing within its limits makes."""
        if self.band is None or sureness(self.power, self.band) == "unclear":
            return ""
        return "loss" if self.power > 0.0 else "gain" if self.built else ""


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
        """Range of tip twist over the whole drive [rad]."""
        return self.installed.attainable

    @property
    def fixed_twist(self) -> TwistLaw | None:
        """Twist of the reference blade, from which changes count; None while it is computed."""
        if self.inputs.against == "same-blade":
            return self.design.twist
        return None if self.verdict is None else self.verdict.baseline.fixed_twist

    @property
    def here(self) -> PowerChange | None:
        """Change of power in this flight, drive included, from the reference blade; None while it is not known."""
        trims, drive = self.now.of(compared_trims), self.now.of(drive_power)
        if trims is None or drive is None:
            return None
        flown, other = trims
        task = self.now.of(flight_doubt)
        doubt = None if task is None else self.now.answers.get(task.key)
        change = flown.power.total - other.power.total + drive
        # Less is what trims end at.
        band = None if doubt is None or doubt.sureness is None else doubt.change_band
        return PowerChange(change, band, self.built)

    @property
    def vibration(self) -> tuple[float, ...] | None:
        """Vibration index in this flight [%] by inflow model; empty without hub loads, None while it is computed."""
        known = self.now.answers.get(self.now.of(effect_call))
        return (
            known.index
            if isinstance(known, EffectInFlight)
            else ()
            if isinstance(known, str)
            else None
        )

    @property
    def over_flight(self) -> PowerChange | None:
        """Mean over the mission, at its best twist."""
        one = self.verdict
        return None if one is None else PowerChange(-one.net_saving, one.net_band, one.buildable)

    @property
    def built(self) -> bool:
        """Whether it is known to keep its limits."""
        return self.verdict is not None and self.verdict.buildable

    @property
    def sourced(self) -> bool:
        """Whether all its values have a source, as `rotor.trim.doubt.sureness` asks."""
        return self.installed.actuator.provenance.sourced


def against_words(one: ActuatedBlade, against: Against) -> str:
    """The blade that changes count from."""
    if against == "best-fixed":
        return "best fixed blade"
    return "same blade without it" if one.question.host.kind == "retrofit" else "present blade"


def counted_from(now: PageState) -> Design | None:
    """The blade that changes count from, without an actuator; the present one while the best is worked out.

    None outside Actuate, and where the blade carries no actuator.
    """
    if not in_actuate(now.ui) or (one := actuated_blade(now)) is None:
        return None
    return replace(
        one.design, twist=one.fixed_twist or one.design.twist, active_twist=None, pitch_per_rev=()
    )


def compared_trims(now: PageState) -> tuple[Solution, Solution] | None:
    """Solutions of the design shown and of the reference blade; None while either is unknown."""
    state, one = now.state, actuated_blade(now)
    if (
        now.problem
        or state is None
        or one is None
        or one.fixed_twist is None
        or not state.baseline.converged
    ):
        return None
    known = (
        state.solution.design.rotor.blade.carried is not None
        and state.baseline.design.twist == one.fixed_twist
    )
    return (state.solution, state.baseline) if known else None


def flight_doubt(now: PageState) -> PanelWork | None:
    """How sure the change of power in this flight is; the power card asks the same unless A is pinned."""
    trims = now.of(compared_trims)
    return (
        None
        if trims is None or trims[0].design == trims[1].design
        else doubt_work("doubt", *trims, now.analyses)
    )


def fitted(now: PageState) -> FittedBlade | None:
    """The actuator on the blade; None where there is none."""
    one = actuated_blade(now)
    return None if one is None else FittedBlade(one.installed, one.inputs.driven_at(one.installed))


def effect_call(now: PageState) -> Call | None:
    """Trims with blades that bend, of what the page shows and of the blade compared with: for vibration."""
    trims = now.of(compared_trims)
    return (
        None
        if trims is None
        else Call(effect, (bending(trims[0].design), bending(trims[1].design)))
    )


def still_work(now: PageState) -> PanelWork | None:
    """The trim of what the page shows without twist at n/rev, which the dial compares with; None without a trim."""
    if now.state is None or now.problem:
        return None
    flown = now.state.solution
    still = replace(flown.design, active_twist=None)
    return PanelWork(
        "still",
        (still,),
        as_one_step(lambda: flown if flown.design == still else solve(still, flown)),
        soon=True,
    )


def per_rev_power(now: PageState) -> tuple[float, float] | None:
    """What twist at n/rev alone adds to what the page shows [W]: all of it, and the part that its drive takes, as heat
    and as work on the blade; None where that is not known."""
    work, waves = now.of(still_work), now.inputs.twist_per_rev
    if not waves or now.state is None:
        return 0.0, 0.0
    flown, still = now.state.solution, None if work is None else now.answers.get(work.key)
    if still is None or not still.converged:
        return None
    drive = per_rev_heat(now) + pitching_power(flown) - pitching_power(still)
    return flown.power.total - still.power.total + drive, drive


def drive_power(now: PageState) -> float | None:
    """Power that the drive takes in this flight [W]: held, and at n/rev; None where that is not known."""
    verdict = (
        one.verdict
        if (one := actuated_blade(now)) is not None and now.hand.actuator.driven
        else None
    )
    per_rev = now.of(per_rev_power)
    return (
        None
        if per_rev is None
        else per_rev[1] + (0.0 if verdict is None else verdict.drive.hold_power)
    )


def per_rev_heat(now: PageState) -> float:
    """Heat in the plies of all blades at n/rev [W]."""
    if (on_blade := now.of(fitted)) is None:
        return 0.0
    losses = dict(zip(HARMONICS, on_blade.losses, strict=True))
    return sum(
        losses.get(each.per_rev, 0.0) * math.degrees(each.amplitude) ** 2
        for each in now.inputs.twist_per_rev
    )


def parts_call(now: PageState) -> Call | None:
    """Trims of the blade that changes count from, the present one, with the actuator's twist, with its stiffness, with
    its mass; None where not all are known."""
    trims, one = now.of(compared_trims), actuated_blade(now)
    if trims is None or one is None:
        return None
    flown, bare = trims[0].design, replace(one.design, active_twist=None, pitch_per_rev=())
    twisted = replace(one.design, twist=flown.twist)
    return Call(powers, ((trims[1].design, bare, twisted, one.installed.on(twisted), flown),))


def saving_parts(now: PageState) -> tuple[tuple[str, float, float], ...]:
    """Name, saving and its band [W] of each part in this flight, the savings as `Verdict.savings`; their sum is
    `ActuatedBlade.here`."""
    found, drive = now.answers.get(now.of(parts_call)), now.of(drive_power)
    if not isinstance(found, tuple) or drive is None:
        return ()
    steps = pairwise(cast("tuple[tuple[float, float], ...]", found))
    named = zip(("blade", "gross", "stiffness", "mass"), steps, strict=True)
    parts = [(name, before - after, band) for name, ((before, _), (after, band)) in named]
    return (
        *(part for part in parts if part[1] or part[0] in ("gross", "mass")),
        ("drive", 0.0 - drive, 0.0),
    )


def no_verdict(now: PageState) -> str:
    """Why there is no verdict, or none in this flight; empty where there is one or it is on its way."""
    one, state = actuated_blade(now), now.state
    if one is not None and isinstance(one.outcome, str):
        return one.outcome
    return "" if state is None or state.baseline.converged else state.baseline.message
