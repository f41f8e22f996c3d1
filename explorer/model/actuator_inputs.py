"""What is set on the Actuator tab, as a value, and what it asks of the worker processes.

Per cent, degrees and volts end here.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import chain, pairwise
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from explorer.model.units import number
from explorer.workers.call import Call
from rotor import Design, Rotor
from rotor.actuator.catalogue import actuators, find_actuator
from rotor.actuator.flight import ActuatorFlight, fly
from rotor.actuator.installation import InstalledActuator, carrying_driven, install, read_actuator
from rotor.actuator.optimum import SMOOTH_DIVISIONS, divisions_of
from rotor.actuator.section import BladeKind, HostBlade, Placement, default_placement
from rotor.actuator.verdict import Against, Verdict, judge
from rotor.dynamics.structure import KNOWN_BLADE
from rotor.optimisation import FlightLeg, Mission, find_concept, standard_flight
from rotor.optimisation.mission import ASSUMED_HOURS
from rotor.support.arrays import Array
from rotor.support.bytes_cache import bytes_cache

CONCEPTS = ("linear", "quadratic", "two-segment", "three-segment")
"""Concepts whose divisions an actuator can be laid out for before any optimum is known."""
MOST_SEGMENTS = len(SMOOTH_DIVISIONS) + 1
AT_REST = (0.0,) * MOST_SEGMENTS
"""No voltage on any segment."""
BLADES: dict[BladeKind, str] = {
    "retrofit": "Existing blade (retrofit)",
    "new": "New blade, softer in torsion",
}
AGAINST: tuple[Against, ...] = ("same-blade", "best-fixed")
"""The blade that every change counts from."""


@dataclass(frozen=True)
class ActuatorInputs:
    actuator: str = "MFC_P1"
    plies: int = 2
    span: tuple[float, float] = default_placement().span
    """r/R"""
    chord: tuple[float, float] = (0.05, 0.80)
    """x/c"""
    blade: BladeKind = "retrofit"
    stiffness: float = 0.5
    """GJ of a new blade over that of the existing one."""
    concept: str = "linear"
    against: Against = "same-blade"
    hours: tuple[float, ...] = ASSUMED_HOURS
    """Flight time of each leg of the standard flight [h]; a leg of no hours is no part of the mission."""
    drives: tuple[float, ...] = AT_REST
    """Per cent of the positive or of the negative voltage, segments from the root; none below `least_drive`."""
    crossed: bool = False
    """Laid the other way, so that positive drive turns the tip down."""

    @property
    def mounting(self) -> tuple[Placement, HostBlade]:
        host = HostBlade() if self.blade == "retrofit" else HostBlade("new", self.stiffness)
        return Placement(self.span, self.chord, self.plies), host

    def installed(self, rotor: Rotor) -> InstalledActuator:
        """The actuator on the blade; ValueError with one sentence where that cannot be built."""
        placement, host = self.mounting
        placement = replace(placement, divisions=concept_divisions(self.concept))
        return install(find_actuator(self.actuator), placement, host, rotor)

    def swings(self, installed: InstalledActuator) -> tuple[float, ...]:
        """Each segment's share of its whole range, positive for tip up."""
        actuator = installed.actuator
        sign = -1.0 if self.crossed and "crossed" in actuator.settings else 1.0
        return tuple(sign * actuator.swing_at(share) for share in self.drive_shares(installed))

    def driven_at(self, installed: InstalledActuator) -> tuple[float, ...]:
        """Drive of each segment, in the unit of the actuator."""
        return tuple(map(installed.actuator.driven_at, self.drive_shares(installed)))

    def drive_shares(self, installed: InstalledActuator) -> tuple[float, ...]:
        """Drive of each segment, −1…1 of either side."""
        return tuple(0.01 * drive for drive in self.drives[: len(installed.shapes)])

    def drive_text(self, installed: InstalledActuator, segment: int) -> str:
        """What drives a segment, in words."""
        return f"{number(self.driven_at(installed)[segment], sign=True)} {installed.actuator.drive_unit}"

    def change(self, installed: InstalledActuator, r: ArrayLike) -> Array:
        """The twist that the actuator adds at r/R [rad]."""
        return installed.change(self.swings(installed), r)

    def tip(self, installed: InstalledActuator) -> float:
        """Twist that it makes at the tip in flight [rad], nose up positive (`InstalledActuator.tip`)."""
        return installed.tip(self.swings(installed))

    def reach(self, installed: InstalledActuator) -> tuple[float, float]:
        """The twist in flight at either end of its drive, the lower first [rad]."""
        ends = self.least_drive, 100.0
        low, high = sorted(
            replace(self, drives=(end,) * MOST_SEGMENTS).tip(installed) for end in ends
        )
        return low, high

    @property
    def least_drive(self) -> float:
        """Low end of the drive [%]: zero for what turns the tip one way only."""
        return -100.0 if find_actuator(self.actuator).drive_range[0] else 0.0

    def apply(self, design: Design) -> Design:
        """The design with the actuator on board, driven; the very same one on a blade of unknown structure."""
        if design.aircraft.key != KNOWN_BLADE:
            return design
        installed = self.installed(design.rotor)
        return carrying_driven(
            design, installed, self.drive_shares(installed), crossed=self.crossed
        )

    @property
    def driven(self) -> bool:
        return any(self.drives)


def inputs_from_spec(text: str) -> ActuatorInputs:
    """What the tab shows of the actuator of a design or a link; ValueError with one sentence."""
    one = read_actuator(text)
    concepts = [name for name in CONCEPTS if concept_divisions(name) == one.placement.divisions]
    if not concepts:
        raise ValueError(
            f"actuator {text!r:.80} has divisions that no concept of this page has: leave them out"
        )
    drives = one.drives * MOST_SEGMENTS if len(one.drives) == 1 else (*one.drives, *AT_REST)
    return ActuatorInputs(
        actuator=one.id,
        plies=one.placement.plies,
        span=one.placement.span,
        chord=one.placement.chord,
        blade=one.host.kind,
        stiffness=one.host.stiffness if one.host.kind == "new" else ActuatorInputs.stiffness,
        concept=concepts[0],
        drives=drives[:MOST_SEGMENTS],
        crossed=one.crossed,
    )


ActuatorState = Literal["set", "schedule", "stopped"]
"""Its voltage is as a hand set it, or follows the flight, or stays as it was when the actuator stopped."""


@dataclass(frozen=True)
class HandSettings:
    """What the hand has set in Actuate.

    `flown`: where on the flight bar the voltages follow the flight; None where a hand set them. `by_hand`: what the
    hand had set before they followed the flight. `stopped`: the actuator has; voltages stay as they are,
    wherever it flies. `pulled`: drives [%] when the lifted blade was taken, and what pulling its trailing edge up by a
    full drive adds. `on_stage`: what would pay is shown in place of the balance of power. `here`: that is of this
    flight, else of the mission. `place`: range of twist [°] and mass of all blades [kg] of the supposed actuator; None
    until it is dragged.
    """

    actuator: ActuatorInputs = field(default_factory=ActuatorInputs)
    flown: float | None = None
    by_hand: ActuatorInputs = field(default_factory=ActuatorInputs)
    stopped: bool = False
    pulled: tuple[tuple[float, ...], float] = (), 0.0
    on_stage: bool = False
    here: bool = False
    place: tuple[float, float] | None = None
    on_board: bool = field(default=False, compare=False)
    """Whether the design carries the actuator: in Actuate."""

    @property
    def state(self) -> ActuatorState:
        return "stopped" if self.stopped else "set" if self.flown is None else "schedule"

    def fit(self, design: Design) -> Design:
        """The design of the sliders as it flies."""
        return self.actuator.apply(design) if self.on_board else design


@dataclass(frozen=True)
class VerdictInputs:
    """All that a verdict depends on."""

    mission: Mission
    concept: str
    actuator: str
    placement: Placement
    host: HostBlade
    against: Against = "same-blade"


def verdict_inputs_of(inputs: ActuatorInputs, design: Design) -> VerdictInputs:
    """What the tab asks about a design."""
    mission = mission_over(replace(design, active_twist=None), inputs.hours)
    return VerdictInputs(mission, inputs.concept, inputs.actuator, *inputs.mounting, inputs.against)


def mission_over(design: Design, hours: Sequence[float]) -> Mission:
    """The mission that the flight bar shows, of a design wherever it flies now; ValueError with less than two legs."""
    flown = tuple(leg for leg in standard_flight(design, hours) if leg.hours > 0.0)
    return Mission(flown[0].of(design), flown)


LONGEST = 99.0
"""Most hours of a leg: our choice, what a field of two digits holds."""
_DIGITS = 2
"""Decimals of the hours."""
_LEAST_LEGS = 2
"""A mission of one flight condition needs no twist that changes."""


def hours_with(hours: Sequence[float], leg: int, time: float) -> tuple[float, ...]:
    """The hours of a mission with another time of one leg; as they were where less than two legs would be left."""
    changed = list(hours)
    changed[leg] = round(min(max(time, 0.0), LONGEST), _DIGITS)
    if sum(each > 0.0 for each in changed) < _LEAST_LEGS:
        return tuple(hours)
    return tuple(changed)


def read_hours(text: str) -> tuple[float, ...]:
    """The hours of a link; ValueError with one sentence for anything else."""
    try:
        hours = tuple(float(part) for part in text.split(","))
    except ValueError:
        hours = ()
    good = len(hours) == len(ASSUMED_HOURS) and all(0.0 <= time <= LONGEST for time in hours)
    if not good or sum(time > 0.0 for time in hours) < _LEAST_LEGS:
        wanted = hours_text(ASSUMED_HOURS)
        raise ValueError(
            f"The mission {text[:40]!r} is not the hours of {len(ASSUMED_HOURS)} legs: write {wanted}."
        )
    return hours


def read_against(text: str) -> Against:
    """The blade that changes count from, of a link; ValueError with one sentence for anything else."""
    for known in AGAINST:
        if text == known:
            return known
    raise ValueError(f"The comparison {text[:40]!r} is not known: choose {' or '.join(AGAINST)}.")


def hours_text(hours: Sequence[float]) -> str:
    """The hours as in a link, for example `0.5,0.25,1,0.25`."""
    return ",".join(f"{time:g}" for time in hours)


@lru_cache(maxsize=16)
def concept_divisions(name: str) -> tuple[float, ...]:
    """r/R where a concept's segments meet."""
    concept = find_concept(name)
    return divisions_of(
        concept.twist([0.5 * (p.low + p.high) for p in concept.parameters]), len(concept.parameters)
    )


Outcome = Verdict | str
"""A verdict, or the sentence that says why there is none."""


def verdict_on(question: VerdictInputs) -> Verdict:
    """The verdict on the actuator asked about; ValueError or RuntimeError with a sentence where there is none."""
    actuator, concept = find_actuator(question.actuator), find_concept(question.concept)
    return judge(
        actuator,
        question.mission,
        concept,
        question.placement,
        question.host,
        against=question.against,
    )


def lean_verdict(question: VerdictInputs) -> Verdict:
    """A verdict, its trims left behind: a twentieth of its size."""
    verdict = verdict_on(question)
    base = verdict.baseline
    best = tuple(replace(optimum, solutions=()) for optimum in base.best)
    base = replace(base, best=best, fixed=replace(base.fixed, solutions=()))
    resting, optimum = (
        replace(twists, solutions=()) for twists in (verdict.resting, verdict.optimum)
    )
    return replace(verdict, baseline=base, resting=resting, optimum=optimum)


def as_it_comes(id: str) -> dict[str, Any]:
    """Of `ActuatorInputs`, another actuator: as it comes, whatever was tried before."""
    start = ActuatorInputs(id)
    return {name: getattr(start, name) for name in ("actuator", "plies", "chord", "crossed")}


def verdict_tasks(question: VerdictInputs) -> dict[str, Call]:
    """By actuator: the chosen one first, then all others as they come, on the same blade and over the same mission."""
    start = ActuatorInputs()
    comes = replace(
        question, placement=replace(question.placement, plies=start.plies, chord=start.chord)
    )
    others = {id: replace(comes, actuator=id) for id in actuators() if id != question.actuator}
    return {
        id: Call(lean_verdict, (one,))
        for id, one in {question.actuator: question, **others}.items()
    }


def schedule_at(flight: ActuatorFlight, installed: InstalledActuator, leg: float) -> dict[str, Any]:
    """Of `ActuatorInputs`, the voltages of a flight at a place counted in its legs, straight between them, in whole per
    cent; nothing where it has none.

    It is laid the other way where the voltages of the flight oppose its twists, or its twists are those.
    """
    if not flight.swings:
        return {}
    actuator, shares, volts = (
        installed.actuator,
        np.asarray(flight.swings),
        np.asarray(flight.voltages),
    )
    changes: dict[str, Any] = {}
    if volts.size:
        swings, shares = shares, volts / actuator.drive_swing
        changes["crossed"] = (
            installed.host.kind == "retrofit" and float(np.sum(swings * shares)) < 0.0
        )
    elif not actuator.drive_range[0]:
        changes["crossed"], shares = float(np.sum(shares)) < 0.0, np.abs(shares)
    legs = np.arange(len(shares))
    drives = [100.0 * actuator.share_of(float(np.interp(leg, legs, share))) for share in shares.T]
    return {**changes, "drives": (*map(float, map(round, drives)), *AT_REST[len(drives) :])}


def flight_of(verdict: Verdict) -> ActuatorFlight:
    return fly(verdict, flight_legs(verdict.baseline.mission.design))


@bytes_cache
def flight_legs(design: Design) -> tuple[FlightLeg, ...]:
    """The standard flight of a design, with a leg half way between any two."""
    legs = standard_flight(design)
    halves = list[FlightLeg]()
    for a, b in pairwise(legs):  # A climb ends half way to the next leg.
        climb = 0.0 if a.climb_speed else 0.5 * b.climb_speed
        halves.append(
            FlightLeg(f"{a.name} to {b.name}", 0.5 * (a.advance_ratio + b.advance_ratio), climb)
        )
    return (*chain.from_iterable(zip(legs, halves, strict=False)), legs[-1])
