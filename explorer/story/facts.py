"""What a step of the lecture tells in numbers: designs along its control, a chart, the numbers of its text, the answer.

Nothing is stored: all of it is computed, in a worker process or when a file is written.
"""

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from explorer.model.actuator_inputs import ActuatorInputs, schedule_at
from explorer.model.inputs import Inputs
from explorer.model.units import SI, number
from explorer.story.numbers import ChartLine, ControlStop, Kind, Number, StepChart, StepFacts
from explorer.story.steps import (
    FRONT,
    SPEEDS,
    STEPS,
    LectureStep,
    angle_words,
    compared_inputs,
    speed_words,
)
from explorer.text.design_words import listed
from explorer.text.readout import limit_words
from rotor import Solution, doubt, make_design, solve, vibration_front
from rotor.actuator import fly, try_actuator
from rotor.actuator.verdict import Verdict
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design import Harmonic
from rotor.design.uncertain import uncertain_inputs
from rotor.optimisation.doubt import difference_doubt
from rotor.optimisation.mission import FlightLeg
from rotor.optimisation.vibration import FrontPoint
from rotor.trim.doubt import Doubt, sure_words, with_other_inflow
from rotor.validation.thesis.ladder import RUNGS, TRIM, linear_optimum, moving_twist

ACTUATOR = "MFC_P1"
"""Actuator of the last step."""
_FLAT_SHARE = 0.001
"""Part of the least power within which an optimum is called flat, as everywhere in the program."""
_HARMONICS, _REACH = (2, 3), 1.0
"""Active twist of the front: harmonics, and the largest amplitude of each [°]."""
_BUILT = tuple(RUNGS)
"""The preset `flight`, as the ladder names its assumptions."""


def facts_of(step: LectureStep) -> StepFacts:
    """Compute what a step tells. RuntimeError with a sentence where a design of the step does not trim."""
    return _FINDERS[step.name](step)


def facts_at(number: int) -> StepFacts:
    """Facts of a step by its number, from 0: a step cannot be pickled for a worker process."""
    return facts_of(STEPS[number])


def _trim(step: LectureStep) -> StepFacts:
    flight = _ControlSweep(step)
    powers = [solution.power for solution in flight.b]
    values = step.control.values
    hover, cruise, low = (
        powers[0],
        powers[values.index(0.3)],
        int(np.argmin([power.total for power in powers])),
    )
    names = "induced", "profile", "parasite"
    parts = tuple(
        ChartLine(name, name, tuple(getattr(power, name) for power in powers)) for name in names
    )
    totals = tuple(power.total for power in powers)
    chart = StepChart(
        "advance ratio", "power", "power", values, "mu", (ChartLine("total", "b", totals), *parts)
    )
    ratio = cruise.induced / hover.induced
    numbers = (
        _of(
            "power",
            hover_induced=hover.induced,
            cruise_induced=cruise.induced,
            least_power=powers[low].total,
        )
        | _of("percent", induced_ratio=ratio)
        | _of("mu", cruise_mu=0.3, least_mu=values[low])
    )
    return flight.facts(numbers, ratio, chart, totals)


def _hover_twist(step: LectureStep) -> StepFacts:
    blades = _ControlSweep(step)
    a, b = blades.pair
    rigid = tuple(name for name in _BUILT if name != "elastic")
    elastic = b.disk.elastic_twist
    assert elastic is not None
    named, saving = _named(step, a, b), 1.0 - b.power.induced / a.power.induced
    within = (named["induced_change"].band or 0.0) / a.power.induced
    numbers = (
        named
        | {"induced_saving": Number("percent", saving, band=within)}
        | _of("angle", elastic=float(np.degrees(np.mean(elastic[0] - elastic[-1]))))
        | _of(
            "rate",
            best=linear_optimum(_BUILT, 0.0, None).rate_deg,
            best_rigid=linear_optimum(rigid, 0.0, None).rate_deg,
        )
    )
    totals = tuple(solution.power.total for solution in blades.b)
    level = (a.power.total,) * len(totals)
    lines = ChartLine("A", "a", level), ChartLine("B", "b", totals)
    chart = StepChart("twist [°/R]", "total power", "power", step.control.values, "rate", lines)
    return blades.facts(numbers, saving, chart, level, totals)


def _linear_inflow(step: LectureStep) -> StepFacts:
    """Changes of power from A to B over twist with linear inflow, and beside them those with a wake.

    They have no bands: with this model the band of a change is little else than a share of its distance from the wake.
    """
    blades = _ControlSweep(step)
    a, b = blades.pair
    changes = blades.changes()
    by_wake = blades.changes_with_other_inflow()
    start = step.control.start
    numbers = _named(step, a, b) | _inflow_distance(b)
    for part, values in changes.items():
        numbers[f"{part}_change"] = Number("change", values[start])
        numbers[f"{part}_other"] = Number("change", by_wake[part][start])
    ratio = abs(changes["induced"][start]) / abs(changes["profile"][start])
    chart = _changes_chart(step, changes)
    facts = blades.facts(numbers, ratio, chart, changes["induced"], changes["profile"])
    stops = list[ControlStop]()
    for k, stop in enumerate(facts.stops):
        other = {f"{part}_change": Number("change", by_wake[part][k]) for part in by_wake}
        stops.append(replace(stop, other_model=other))
    return replace(facts, stops=tuple(stops))


def _responding_wake(step: LectureStep) -> StepFacts:
    """Changes of power from A to B over twist with a wake, and the change that linear inflow gives."""
    blades = _ControlSweep(step)
    a, b = blades.pair
    changes = blades.changes()
    linear = blades.changes_with_other_inflow()
    start = step.control.start
    part = changes["induced"][start] / changes["total"][start]
    numbers = _named(step, a, b) | _inflow_distance(b) | _of("percent", induced_part=part)
    numbers |= _of("change", total_other=linear["total"][start])
    chart = _changes_chart(step, changes)
    return blades.facts(numbers, part, chart, changes["induced"], changes["profile"])


def _changes_chart(step: LectureStep, changes: Mapping[str, tuple[float, ...]]) -> StepChart:
    """Changes of induced and profile power over twist."""
    lines = tuple(ChartLine(part, part, changes[part]) for part in ("induced", "profile"))
    return StepChart("twist [°/R]", "B − A", "power", step.control.values, "rate", lines)


def _inflow_distance(solution: Solution) -> dict[str, Number]:
    """The share of the distance between two inflow models that is in the band of a change."""
    for row in uncertain_inputs(solution.design):
        if row.name == "inflow_model_percent":
            return _of("percent", model_share=0.01 * row.size)
    raise LookupError("inflow_model_percent is not among the uncertain inputs.")


def _fast_twist(step: LectureStep) -> StepFacts:
    blades = _ControlSweep(step)
    (a, b), without = blades.pair, (blades.a[1], blades.b[1])
    rates, own = (
        tuple(float(rate) for rate in range(0, -21, -2)),
        (_against(step).linear, step.inputs.linear),
    )
    lines, dots = list[ChartLine](), list[list[tuple[float, float]]]()
    for k, (stop, name) in enumerate(
        zip(blades.stops, ("with fuselage drag", "without"), strict=True)
    ):
        totals = [
            solve(replace(stop.inputs, linear=rate).design(), blades.b[k]).require().power.total
            for rate in rates
        ]
        ends = [solution.power.total for solution in (blades.a[k], blades.b[k])]
        lowest = min(*totals, *ends)
        lines.append(
            ChartLine(
                name, "b" if k == 0 else "limit", tuple(total / lowest - 1.0 for total in totals)
            )
        )
        dots.append([(rate, total / lowest - 1.0) for rate, total in zip(own, ends, strict=True)])
    chart = StepChart(
        "twist [°/R]", "above least", "percent", rates, "rate", tuple(lines), dots=("a", "b")
    )
    fast = step.inputs.advance_ratio

    def rate(on: Sequence[str]) -> float:
        return linear_optimum(tuple(on), fast, None).rate_deg

    before = _BUILT[: _BUILT.index(TRIM[0])]
    pairs = (
        (before, (*before, *TRIM)),
        ((), TRIM),
        ([name for name in _BUILT if name not in TRIM], _BUILT),
    )
    moves = sorted(abs(rate(trimmed) - rate(untrimmed)) for untrimmed, trimmed in pairs)
    numbers = (
        _named(step, a, b)
        | _of("rate", trim_low=moves[0], trim_high=moves[-1])
        | _said(without_drag=doubt(*without).saving_words)
    )
    facts = blades.facts(numbers, b.power.total / a.power.total - 1.0, chart)
    stops = tuple(replace(stop, dots=tuple(at)) for stop, at in zip(facts.stops, dots, strict=True))
    return replace(facts, stops=stops)


def _reverse_flow(step: LectureStep) -> StepFacts:
    flight = _ControlSweep(step)
    a, b = flight.pair
    costs = tuple(
        solution.power.total - other.power.total
        for solution, other in zip(flight.b, flight.a, strict=True)
    )
    slow = step.control.values.index(0.25)
    share, sure = b.power.total / a.power.total - 1.0, doubt(flight.b[slow], flight.a[slow])
    named = _named(step, a, b)
    numbers = (
        named
        | _of("percent", area=b.reverse_flow_area, cost_percent=share)
        | {"cost": replace(named["total_change"], kind="power")}
        | {"slow_cost": Number("power", costs[slow], band=sure.change_band)}
        | _of("mu", slow_mu=step.control.values[slow])
    )
    lines = (ChartLine("cost, B − A", "b", costs),)
    chart = StepChart("advance ratio", "cost", "power", step.control.values, "mu", lines)
    return flight.facts(numbers, share, chart, costs)


def _two_segments(step: LectureStep) -> StepFacts:
    blades = _ControlSweep(step)
    a, b = blades.pair
    changes = tuple(solution.power.total / a.power.total - 1.0 for solution in blades.b)
    most = (1.0 + _FLAT_SHARE) * min(solution.power.total for solution in blades.b)
    rated = zip(step.control.values, blades.b, strict=True)
    flat = [rate for rate, solution in rated if solution.power.total < most]
    inputs = step.begin()
    numbers = (
        _named(step, a, b)
        | _of("percent", flat=_FLAT_SHARE, **{"break": inputs.two_division})
        | _said(
            twist_inner=angle_words(inputs.two_inner), twist_outer=angle_words(inputs.two_outer)
        )
        | _of("rate", flat_low=min(flat), flat_high=max(flat))
    )
    level = (0.0,) * len(changes)
    lines = ChartLine("A", "a", level), ChartLine("B", "b", changes)
    chart = StepChart(
        "inboard twist [°/R]", "against A", "percent", step.control.values, "rate", lines
    )
    saving, band = (
        1.0 - b.power.total / a.power.total,
        0.01 * (doubt(b, a).change_band_percent or 0.0),
    )
    return _banded(
        step, blades.facts(numbers, saving, chart, level, changes), saving - band, saving + band
    )


def _fixed_or_moving(step: LectureStep) -> StepFacts:
    best = [linear_optimum(_BUILT, mu, None) for mu in SPEEDS]
    moving = moving_twist(_BUILT, SPEEDS, None)
    gains = [moving_twist(_BUILT, SPEEDS, inflow).gain for inflow in INFLOW_MODELS]
    fixed, rates = round(moving.fixed_deg, 2), tuple(round(twist.rate_deg, 2) for twist in best)
    low, high = zip(*(twist.band_deg for twist in best), strict=True)

    def stop(mu: float, rate: float) -> ControlStop:
        b, a = (replace(step.inputs, advance_ratio=mu, linear=twist) for twist in (rate, fixed))
        return ControlStop(
            f"{speed_words(mu)}, {angle_words(rate)}", b, a, ((mu, fixed), (mu, rate))
        )

    stops = tuple(map(stop, SPEEDS, rates))
    moved = [solve(each.inputs.design()) for each in stops]
    held = [solve(each.against.design()) for each in stops if each.against is not None]
    sure = difference_doubt((1.0 / len(stops),) * len(stops), moved, held)
    inside = sum(a <= fixed <= b for a, b in zip(low, high, strict=True))
    numbers = (
        _of("rate", hover_best=rates[0], fast_best=rates[-1])
        | _of("mu", fast_mu=SPEEDS[-1])
        | _of("fine", gain_low=min(gains), gain_high=max(gains))
        | _said(saves="" if sure is None else sure.saving_words)
        | _of("count", wakes=len(gains), inside=inside, speeds=len(SPEEDS))
        | _of(
            "power",
            gain_power=1e3 * moving.gain * moving.fixed_kw,
            fixed_power=1e3 * moving.fixed_kw,
        )
        | _of("percent", band=_FLAT_SHARE)
    )
    lines = (
        ChartLine("best fixed, A", "a", (fixed,) * len(SPEEDS)),
        ChartLine("best at each speed, B", "b", rates),
    )
    chart = StepChart("advance ratio", "twist [°/R]", "angle", SPEEDS, "mu", lines, (low, high))
    return _banded(
        step, _answered(step, stops, numbers, moving.gain, chart), min(gains), max(gains)
    )


def _power_or_vibration(step: LectureStep) -> StepFacts:
    front = vibration_front(
        step.inputs.design(), harmonics=_HARMONICS, reach_deg=_REACH, points=FRONT
    )
    changes = [(0.01 * power, 0.01 * index) for power, index in front.changes]
    stops = list[ControlStop]()
    for k, (point, (power, index)) in enumerate(zip(front.points, changes, strict=True)):
        twist = point.design.active_twist
        waves = () if twist is None else tuple(map(_rounded, twist.harmonics))
        inputs = replace(step.inputs, twist_per_rev=waves)
        stops.append(
            ControlStop(
                step.control.words(float(k)),
                inputs,
                step.against,
                ((power, index),),
                index_band=point.over_inflows,
            )
        )
    first, last = front.points[0], front.points[-1]
    powers, indices = zip(*changes, strict=True)
    start = solve(front.start.design)
    saves, costs = (
        doubt(solve(point.design, start), start).saving_words for point in (first, last)
    )
    numbers = (
        _named(step, None, None)
        | _said(harmonics=" and ".join(map(str, _HARMONICS)), reach=f"{_REACH:g}°")
        | _of("count", blades=last.design.rotor.blades)
        | _said(saves=saves, costs=costs)
        | _of("signed", index_change=indices[0], best_index=indices[-1])
        | _said(index_wakes=_over_wakes(first), best_wakes=_over_wakes(last))
    )
    lines, across = (ChartLine("front", "b", indices),), "power, change from A"
    chart = StepChart(across, "vibration index, change from A", "percent", powers, "signed", lines)
    return _banded(
        step,
        _answered(step, tuple(stops), numbers, indices[0], chart),
        *(0.01 * end for end in first.over_inflows or (0.0, 0.0)),
    )


def _over_wakes(point: FrontPoint) -> str:
    """Least and largest change of the vibration index over wake models, as `−20 % to +31 %`."""
    low, high = (Number("signed", 0.01 * end) for end in point.over_inflows or (0.0, 0.0))
    return f"{low.words(SI)} to {high.words(SI)}"


def _rounded(wave: Harmonic) -> Harmonic:
    """To 1e-4°: a link of the step holds 1, not 1.0000000000931712."""
    turn, phase = (
        math.radians(round(math.degrees(angle), 4)) for angle in (wave.amplitude, wave.phase)
    )
    return replace(wave, amplitude=turn, phase=phase)


def _piezoelectric_ply(step: LectureStep) -> StepFacts:
    """By schedule at each speed: what twist alone changes, and what the aircraft needs with all of the actuator."""
    flight, verdict = _ControlSweep(step), try_actuator(ACTUATOR, make_design())
    installed = verdict.installed
    flown = fly(verdict, [FlightLeg(speed_words(mu), mu) for mu in SPEEDS])
    set_to = [
        ActuatorInputs(ACTUATOR, **schedule_at(flown, installed, k)) for k in range(len(SPEEDS))
    ]
    twisted, loaded = list[Solution](), list[Solution]()
    for bare, actuator in zip(flight.b, set_to, strict=True):
        loaded.append(solve(actuator.apply(bare.design), bare).require())
        twisted.append(solve(replace(bare.design, twist=loaded[-1].design.twist), bare).require())
    pairs = [
        list(zip(*pair, strict=True))
        for pair in ((loaded, flight.b), (twisted, flight.b), (loaded, twisted))
    ]
    net, twist, cost = (
        [after.power.total - before.power.total for after, before in pair] for pair in pairs
    )
    start, reach = step.control.start, [math.degrees(end) for end in set_to[0].reach(installed)]
    within = [doubt(*pair).change_band or 0.0 for pair in pairs[0]]
    here, gross, costs = (doubt(*pair[start]) for pair in pairs)
    over = [
        limit_words(limit.name)
        for limit in verdict.broken
        if limit.name not in installed.actuator.range_limits
    ]
    numbers = (
        _said(limits=listed(over), actuator=installed.actuator.name)
        | _said(sure_here=_sureness(here), sure_gross=_sureness(gross), sure_cost=_sureness(costs))
        | _said(sure=_net_sureness(verdict))
        | _of("mu", mu=SPEEDS[start])
        | _said(
            reach_low=f"{number(reach[0], 1, sign=True)}°",
            reach_high=f"{number(reach[1], 1, sign=True)}°",
        )
        | {"gross": Number("power", -twist[start], band=gross.change_band)}
        | {"cost": Number("power", cost[start], band=costs.change_band)}
        | {"here": Number("power", net[start], band=here.change_band)}
        | {"net_cost": Number("power", -verdict.net_saving, band=verdict.net_band)}
        | _of("mass", mass=installed.masses.aircraft)
    )
    lines = ChartLine("twist alone", "a", tuple(twist)), ChartLine("with its mass", "b", tuple(net))
    ends = tuple(
        tuple(power + sign * band for power, band in zip(net, within, strict=True))
        for sign in (-1.0, 1.0)
    )
    chart = StepChart(
        "advance ratio", "extra power", "power", SPEEDS, "mu", lines, (ends[0], ends[1])
    )
    facts = flight.facts(numbers, verdict.net_saving, chart, twist, net)
    stops = [
        replace(
            stop,
            actuator=one,
            numbers=_said(tip=f"{number(math.degrees(one.tip(installed)), 2, sign=True)}°"),
        )
        for stop, one in zip(facts.stops, set_to, strict=True)
    ]
    return replace(facts, stops=tuple(stops))


def _sureness(change: Doubt) -> str:
    """Whether the sign of a change is known, and why no more than that; empty where there is no change."""
    if change.sureness is None or change.change is None or change.change_band is None:
        return ""
    return sure_words(change.change, change.change_band, sourced=change.sourced)


def _net_sureness(verdict: Verdict) -> str:
    """Whether the sign of the net saving is known, and why no more than that; empty without a band."""
    if verdict.net_band is None:
        return ""
    return sure_words(verdict.net_saving, verdict.net_band, sourced=verdict.sourced)


_FINDERS: dict[str, Callable[[LectureStep], StepFacts]] = {
    "trim": _trim,
    "hover_twist": _hover_twist,
    "linear_inflow": _linear_inflow,
    "responding_wake": _responding_wake,
    "fast_twist": _fast_twist,
    "reverse_flow": _reverse_flow,
    "two_segments": _two_segments,
    "fixed_or_moving": _fixed_or_moving,
    "power_or_vibration": _power_or_vibration,
    "piezoelectric_ply": _piezoelectric_ply,
}
"""By name of the step."""


class _ControlSweep:
    """The designs along the control of a step, trimmed: B, and A beside each."""

    def __init__(self, step: LectureStep) -> None:
        """RuntimeError where one does not trim."""
        self._step, control = step, step.control
        b = [control.apply(step.inputs, value) for value in control.values]
        a = [compared_inputs(step.against, step.inputs, inputs) for inputs in b]
        stops = zip(control.values, b, a, strict=True)
        self.stops = tuple(
            ControlStop(control.words(value), inputs, other, ()) for value, inputs, other in stops
        )
        self.b, self.a = _trimmed(b), _trimmed([inputs for inputs in a if inputs is not None])

    @property
    def pair(self) -> tuple[Solution, Solution]:
        """A and B as the step begins."""
        start = self._step.control.start
        return self.a[start], self.b[start]

    def changes(self) -> dict[str, tuple[float, ...]]:
        """Changes from A to B of total power and of its parts along the control [W]."""
        return _power_changes(self.b, self.a)

    def changes_with_other_inflow(self) -> dict[str, tuple[float, ...]]:
        """`changes` of the same blades with the other of the two inflow models that a band compares."""
        b = [solve(with_other_inflow(solution.design)).require() for solution in self.b]
        a = [solve(with_other_inflow(solution.design)).require() for solution in self.a]
        return _power_changes(b, a)

    def facts(
        self,
        numbers: Mapping[str, Number],
        answer: float,
        chart: StepChart,
        *curves: Sequence[float],
    ) -> StepFacts:
        """With dots on these curves over the values of the control."""
        placed = enumerate(zip(self.stops, self._step.control.values, strict=True))
        stops = tuple(
            replace(stop, dots=tuple((value, curve[k]) for curve in curves))
            for k, (stop, value) in placed
        )
        return _answered(self._step, stops, numbers, answer, chart)


def _power_changes(b: Sequence[Solution], a: Sequence[Solution]) -> dict[str, tuple[float, ...]]:
    pairs = [(after.power, before.power) for after, before in zip(b, a, strict=True)]
    return {
        part: tuple(getattr(after, part) - getattr(before, part) for after, before in pairs)
        for part in ("total", "induced", "profile", "tail")
    }


def _trimmed(designs: Sequence[Inputs]) -> list[Solution]:
    """Each from the one before; those that are equal once."""
    solutions = list[Solution]()
    for inputs in designs:
        design, before = inputs.design(), solutions[-1] if solutions else None
        solutions.append(
            before if before and before.design == design else solve(design, before).require()
        )
    return solutions


def _answered(
    step: LectureStep,
    stops: tuple[ControlStop, ...],
    numbers: Mapping[str, Number],
    answer: float,
    chart: StepChart,
) -> StepFacts:
    """With the bounds between the answers, and the right one."""
    bounds = {
        f"bound_{k}" if len(set(map(abs, step.bounds)) - {0.0}) > 1 else "bound": Number(
            "percent", abs(bound)
        )
        for k, bound in enumerate(step.bounds, start=1)
        if bound
    }
    return StepFacts(stops, {**bounds, **numbers}, bisect_right(step.bounds, answer), chart)


def _banded(step: LectureStep, facts: StepFacts, low: float, high: float) -> StepFacts:
    """With the other answers from `low` to `high`, the ends of its band."""
    places = range(bisect_right(step.bounds, low), bisect_right(step.bounds, high) + 1)
    return replace(facts, open=tuple(place for place in places if place != facts.right))


def _named(step: LectureStep, a: Solution | None, b: Solution | None) -> dict[str, Number]:
    """What most texts name: the flight, the twists, powers of A and B and their differences."""
    inputs = step.begin()
    numbers = _of("mu", mu=inputs.advance_ratio) | _said(twist_b=angle_words(inputs.linear))
    if step.against is not None:
        numbers |= _said(twist_a=angle_words(step.against.linear))
    if a is None or b is None:
        return numbers
    sure = doubt(b, a)
    bands = {**sure.part_bands, "total": sure.change_band}
    for name in ("total", "induced", "profile", "tail"):
        of_a, of_b = getattr(a.power, name), getattr(b.power, name)
        numbers |= _of("power", **{f"{name}_a": of_a, f"{name}_b": of_b})
        numbers[f"{name}_change"] = Number("change", of_b - of_a, band=bands.get(name))
    numbers |= _of("power", saving=a.power.total - b.power.total) | _said(saves=sure.saving_words)
    return numbers


def _of(kind: Kind, **values: float) -> dict[str, Number]:
    """Numbers of one kind by the names that the text has for them."""
    return {name: Number(kind, value) for name, value in values.items()}


def _said(**texts: str) -> dict[str, Number]:
    return {name: Number("words", 0.0, text) for name, text in texts.items()}


def _against(step: LectureStep) -> Inputs:
    assert step.against is not None
    return step.against
