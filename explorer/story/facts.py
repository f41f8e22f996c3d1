"""What a step of the lecture tells in numbers: designs along its control, a chart, the numbers of its text, the answer.

Nothing is stored: all of it is computed, a second or two for a step, in a worker process or when a file is written.
"""

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from explorer.model.inputs import Inputs
from explorer.model.units import Units, number
from explorer.story.steps import FRONT, SPEEDS, STEPS, LectureStep, angle_words, beside, on_one_line, speed_words
from rotor import Solution, make_design, solve, vibration_front
from rotor.actuator import try_actuator
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design import LinearTwist
from rotor.reproduce.ladder import RUNGS, TRIM, built, least, moving_twist

Kind = Literal["power", "change", "percent", "fine", "signed", "angle", "mu", "mass", "count", "words"]
ACTUATOR = "MFC_P1"
"""Actuator of the last step."""
_FLAT = 0.001
"""Part of the least power within which an optimum is called flat, as everywhere in the program."""
_HARMONICS, _REACH = (2, 3), 1.0
"""Active twist of the front: harmonics, and the largest amplitude of each [°]."""
_BUILT = tuple(RUNGS)
"""The preset `flight`, as the ladder names its assumptions."""


@dataclass(frozen=True)
class Number:
    """A number of the text, in SI; angles in degrees, shares as parts of one."""

    kind: Kind
    value: float
    text: str = ""
    """Text of a fact of kind "words"."""

    def words(self, units: Units) -> str:
        """The fact as it is written, on one line."""
        value = self.value
        match self.kind:
            case "power" | "change":
                text = units.watts(value, sign=self.kind == "change")
            case "percent" | "fine" | "signed":
                digits = 2 if self.kind == "fine" else 0 if abs(value) >= 0.095 or (100.0 * value) % 1.0 == 0.0 else 1
                text = f"{number(100.0 * value, digits, sign=self.kind == 'signed')} %"
            case "angle":
                text = f"{number(value, 1)}°"
            case "mu":
                text = speed_words(value)
            case "mass":
                text = units.mass.text(value, 0) if units.mass.size < 1.0 else f"{number(value)} kg"
            case "count":
                text = number(value)
            case "words":
                return self.text
        return on_one_line(text)


@dataclass(frozen=True)
class ChartLine:
    """One line of a chart."""

    name: str
    colour: str
    """A part of power, "a", "b" or "limit"."""
    y: tuple[float | None, ...]
    """None where there is no trim."""


@dataclass(frozen=True)
class StepChart:
    """What is drawn in the caption: power [W], a part of one, or degrees over what is moved."""

    x_title: str
    y_title: str
    kind: Literal["power", "percent", "angle"]
    x: tuple[float, ...]
    x_kind: Literal["mu", "rate", "signed"]
    lines: tuple[ChartLine, ...]
    band: tuple[tuple[float, ...], tuple[float, ...]] | None = None
    """Low and high."""
    dots: tuple[str, ...] = ()
    """Colours of the dots; those of the lines where none are given."""


@dataclass(frozen=True)
class Stop:
    """One position of the control."""

    words: str
    inputs: Inputs
    against: Inputs | None
    dots: tuple[tuple[float, float], ...]
    """Where it is on the chart."""


@dataclass(frozen=True)
class Facts:
    """What a step needs beside the trim that is seen."""

    stops: tuple[Stop, ...]
    numbers: Mapping[str, Number]
    right: int
    """Place of the right answer among those to choose from."""
    chart: StepChart

    def words(self, units: Units) -> dict[str, str]:
        """The numbers as they are written."""
        return {name: number.words(units) for name, number in self.numbers.items()}


def facts_of(step: LectureStep) -> Facts:
    """Compute what a step tells. RuntimeError with a sentence where a design of the step does not trim."""
    return _FINDERS[step.name](step)


def facts_at(number: int) -> Facts:
    """Facts of a step by its number, from 0: a step cannot be pickled for a worker process."""
    return facts_of(STEPS[number])


def _trim(step: LectureStep) -> Facts:
    flight = _Sweep(step)
    powers = [solution.power for solution in flight.b]
    values = step.control.values
    hover, cruise, low = powers[0], powers[values.index(0.3)], int(np.argmin([power.total for power in powers]))
    parts = tuple(
        ChartLine(name, name, tuple(getattr(power, name) for power in powers))
        for name in ("induced", "profile", "parasite")
    )
    chart = StepChart(
        "advance ratio", "power", "power", values, "mu",
        (ChartLine("total", "b", tuple(power.total for power in powers)), *parts),
    )  # fmt: skip
    ratio = cruise.induced / hover.induced
    numbers = {
        "hover_induced": Number("power", hover.induced), "cruise_induced": Number("power", cruise.induced),
        "induced_ratio": Number("percent", ratio), "cruise_mu": Number("mu", 0.3),
        "least_mu": Number("mu", values[low]), "least_power": Number("power", powers[low].total),
    }  # fmt: skip
    return flight.facts(numbers, ratio, chart, tuple(power.total for power in powers))


def _hover_twist(step: LectureStep) -> Facts:
    blades = _Sweep(step)
    a, b = blades.pair
    rigid = tuple(name for name in _BUILT if name != "elastic")
    elastic = b.disk.elastic_twist
    assert elastic is not None
    saving = 1.0 - b.power.induced / a.power.induced
    numbers = {
        **_named(step, a, b), "induced_saving": Number("percent", saving),
        "elastic": Number("angle", float(np.degrees(np.mean(elastic[0] - elastic[-1])))),
        "best": Number("angle", least(_BUILT, 0.0, None).rate_deg),
        "best_rigid": Number("angle", least(rigid, 0.0, None).rate_deg),
    }  # fmt: skip
    totals = tuple(solution.power.total for solution in blades.b)
    chart = StepChart(
        "twist [°/R]", "total power", "power", step.control.values, "rate",
        (ChartLine("A", "a", (a.power.total,) * len(totals)), ChartLine("B", "b", totals)),
    )  # fmt: skip
    return blades.facts(numbers, saving, chart, (a.power.total,) * len(totals), totals)


def _changes(step: LectureStep) -> Facts:
    """Changes of induced and profile power from A to B, over twist: with linear inflow, and with a wake."""
    blades = _Sweep(step)
    a, b = blades.pair
    induced, profile = (
        tuple(
            getattr(solution.power, name) - getattr(other.power, name)
            for solution, other in zip(blades.b, blades.a, strict=True)
        )
        for name in ("induced", "profile")
    )
    chart = StepChart(
        "twist [°/R]", "B − A", "power", step.control.values, "rate",
        (ChartLine("induced", "induced", induced), ChartLine("profile", "profile", profile)),
    )  # fmt: skip
    by_induced, by_profile = (getattr(b.power, name) - getattr(a.power, name) for name in ("induced", "profile"))
    part = by_induced / (b.power.total - a.power.total)
    numbers = {**_named(step, a, b), "induced_part": Number("percent", part)}
    answer = abs(by_induced) / abs(by_profile) if step.name == "linear_inflow" else part
    return blades.facts(numbers, answer, chart, induced, profile)


def _fast_twist(step: LectureStep) -> Facts:
    blades = _Sweep(step)
    (a, b), without = blades.pair, (blades.a[1], blades.b[1])
    rates = tuple(float(rate) for rate in range(0, -21, -2))
    lines, dots = list[ChartLine](), list[list[tuple[float, float]]]()
    for k, (stop, name) in enumerate(zip(blades.stops, ("with fuselage drag", "without"), strict=True)):
        totals = [
            solve(replace(stop.inputs, linear=rate).design(), blades.b[k]).require().power.total for rate in rates
        ]
        ends = [solution.power.total for solution in (blades.a[k], blades.b[k])]
        lowest = min(*totals, *ends)
        lines.append(ChartLine(name, "b" if k == 0 else "limit", tuple(total / lowest - 1.0 for total in totals)))
        dots.append([
            (rate, total / lowest - 1.0)
            for rate, total in zip((_against(step).linear, step.inputs.linear), ends, strict=True)
        ])  # fmt: skip
    chart = StepChart("twist [°/R]", "above least", "percent", rates, "rate", tuple(lines), dots=("a", "b"))
    fast = step.inputs.advance_ratio

    def rate(on: Sequence[str]) -> float:
        return least(tuple(on), fast, None).rate_deg

    before = _BUILT[: _BUILT.index(TRIM[0])]
    moves = sorted(abs(move) for move in (
        rate((*before, *TRIM)) - rate(before), rate(TRIM) - rate(()),
        rate(_BUILT) - rate([name for name in _BUILT if name not in TRIM]),
    ))  # fmt: skip
    numbers = {
        **_named(step, a, b), "trim_low": Number("angle", moves[0]), "trim_high": Number("angle", moves[-1]),
        "without_drag": Number("fine", 1.0 - without[0].power.total / without[1].power.total),
    }  # fmt: skip
    facts = blades.facts(numbers, b.power.total / a.power.total - 1.0, chart)
    stops = tuple(replace(stop, dots=tuple(at)) for stop, at in zip(facts.stops, dots, strict=True))
    return replace(facts, stops=stops)


def _reverse_flow(step: LectureStep) -> Facts:
    flight = _Sweep(step)
    a, b = flight.pair
    costs = tuple(solution.power.total - other.power.total for solution, other in zip(flight.b, flight.a, strict=True))
    slow = step.control.values.index(0.25)
    numbers = {
        **_named(step, a, b), "area": Number("percent", b.reverse_flow_area),
        "cost": Number("power", b.power.total - a.power.total),
        "cost_percent": Number("percent", b.power.total / a.power.total - 1.0),
        "slow_mu": Number("mu", step.control.values[slow]), "slow_cost": Number("power", costs[slow]),
    }  # fmt: skip
    chart = StepChart(
        "advance ratio", "cost", "power", step.control.values, "mu", (ChartLine("cost, B − A", "b", costs),)
    )  # fmt: skip
    return flight.facts(numbers, b.power.total / a.power.total - 1.0, chart, costs)


def _two_segments(step: LectureStep) -> Facts:
    blades = _Sweep(step)
    a, b = blades.pair
    changes = tuple(solution.power.total / a.power.total - 1.0 for solution in blades.b)
    flat = [
        rate
        for rate, solution in zip(step.control.values, blades.b, strict=True)
        if solution.power.total < (1.0 + _FLAT) * min(other.power.total for other in blades.b)
    ]
    inputs = step.begin()
    numbers = {
        **_named(step, a, b), "break": Number("percent", inputs.two_division),
        "twist_inner": Number("words", 0.0, angle_words(inputs.two_inner)),
        "twist_outer": Number("words", 0.0, angle_words(inputs.two_outer)),
        "twist_a": Number("words", 0.0, angle_words(_against(step).linear)),
        "flat": Number("percent", _FLAT),
        "flat_low": Number("angle", min(flat)), "flat_high": Number("angle", max(flat)),
    }  # fmt: skip
    chart = StepChart(
        "inboard twist [°/R]", "against A", "percent", step.control.values, "rate",
        (ChartLine("A", "a", (0.0,) * len(changes)), ChartLine("B", "b", changes)),
    )  # fmt: skip
    return blades.facts(numbers, 1.0 - b.power.total / a.power.total, chart, (0.0,) * len(changes), changes)


def _fixed_or_moving(step: LectureStep) -> Facts:
    best = [least(_BUILT, mu, None) for mu in SPEEDS]
    moving = moving_twist(_BUILT, SPEEDS, None)
    gains = [moving_twist(_BUILT, SPEEDS, inflow).gain for inflow in INFLOW_MODELS]
    baseline = built(_BUILT, SPEEDS[0]).twist
    assert isinstance(baseline, LinearTwist)
    fixed, rates = round(moving.fixed_deg, 2), tuple(round(twist.rate_deg, 2) for twist in best)
    low, high = zip(*(twist.band_deg for twist in best), strict=True)
    stops = tuple(
        Stop(
            f"{speed_words(mu)}, {angle_words(rate)}", replace(step.inputs, advance_ratio=mu, linear=rate),
            replace(step.inputs, advance_ratio=mu, linear=fixed), ((mu, fixed), (mu, rate)),
        )
        for mu, rate in zip(SPEEDS, rates, strict=True)
    )  # fmt: skip
    numbers = {
        "hover_best": Number("angle", rates[0]), "fast_best": Number("angle", rates[-1]),
        "fast_mu": Number("mu", SPEEDS[-1]), "fixed": Number("words", 0.0, angle_words(round(fixed, 1))),
        "gain": Number("fine", moving.gain), "gain_low": Number("fine", min(gains)),
        "gain_high": Number("fine", max(gains)), "wakes": Number("count", len(gains)),
        "gain_power": Number("power", 1e3 * moving.gain * moving.fixed_kw),
        "fixed_power": Number("power", 1e3 * moving.fixed_kw), "band": Number("percent", _FLAT),
        "inside": Number("count", sum(a <= fixed <= b for a, b in zip(low, high, strict=True))),
        "speeds": Number("count", len(SPEEDS)),
        "fixed_saving": Number("fine", 1.0 - moving.fixed_kw / moving.baseline_kw),
        "baseline": Number("words", 0.0, f"a fixed {angle_words(round(math.degrees(baseline.rate), 1))}"),
    }  # fmt: skip
    chart = StepChart(
        "advance ratio", "twist [°/R]", "angle", SPEEDS, "mu",
        (ChartLine("best fixed, A", "a", (fixed,) * len(SPEEDS)), ChartLine("best at each speed, B", "b", rates)),
        (low, high),
    )  # fmt: skip
    return _answered(step, stops, numbers, moving.gain, chart)


def _power_or_vibration(step: LectureStep) -> Facts:
    front = vibration_front(step.inputs.design(), harmonics=_HARMONICS, reach_deg=_REACH, points=FRONT)
    changes = [(0.01 * power, 0.01 * index) for power, index in front.changes]
    stops = list[Stop]()
    for k, (point, (power, index)) in enumerate(zip(front.points, changes, strict=True)):
        twist = point.design.active_twist
        waves = () if twist is None else twist.harmonics
        inputs = replace(step.inputs, twist_per_rev=waves)
        stops.append(Stop(step.control.words(float(k)), inputs, step.against, ((power, index),)))
    last, ends = front.points[-1], front.points[-1].over_inflows or (0.0, 0.0)
    numbers = {
        **_named(step, None, None), "harmonics": Number("words", 0.0, " and ".join(map(str, _HARMONICS))),
        "reach": Number("words", 0.0, f"{_REACH:g}°"),
        "blades": Number("count", last.design.rotor.blades),
        "power_saving": Number("fine", -changes[0][0]), "index_change": Number("signed", changes[0][1]),
        "best_index": Number("signed", changes[-1][1]), "power_cost": Number("fine", changes[-1][0]),
        "wakes_low": Number("signed", 0.01 * ends[0]), "wakes_high": Number("signed", 0.01 * ends[1]),
    }  # fmt: skip
    powers, indices = zip(*changes, strict=True)
    chart = StepChart(
        "power, change from A", "vibration index, change from A", "percent", powers, "signed",
        (ChartLine("front", "b", indices),),
    )  # fmt: skip
    return _answered(step, tuple(stops), numbers, changes[0][1], chart)


def _piezoelectric_ply(step: LectureStep) -> Facts:
    flight = _Sweep(step)
    verdict = try_actuator(ACTUATOR, make_design())
    best = [least(_BUILT, mu, None).rate_deg for mu in SPEEDS]
    span = 1.0 - flight.b[0].design.rotor.blade.root_cutout
    wanted = tuple((rate - best[0]) * span for rate in best)
    reach = math.degrees(verdict.attainable)
    numbers = {
        "actuator": Number("words", 0.0, verdict.installed.actuator.name),
        "to_mu": Number("mu", verdict.baseline.pair.advance_ratios[1]),
        "required": Number("angle", math.degrees(verdict.required)), "attainable": Number("angle", reach),
        "gross": Number("power", verdict.gross_saving), "net_cost": Number("power", -verdict.net_saving),
        "net": Number("change", -verdict.net_saving),
        "mass": Number("mass", verdict.installed.masses.aircraft),
    }  # fmt: skip
    chart = StepChart(
        "advance ratio", "change of twist [°]", "angle", SPEEDS, "mu",
        (ChartLine("reach", "limit", (reach,) * len(SPEEDS)), ChartLine("wanted", "b", wanted)),
        ((0.0,) * len(SPEEDS), (reach,) * len(SPEEDS)),
    )  # fmt: skip
    return flight.facts(numbers, verdict.net_saving, chart, (reach,) * len(SPEEDS), wanted)


_FINDERS: dict[str, Callable[[LectureStep], Facts]] = {
    "trim": _trim, "hover_twist": _hover_twist, "linear_inflow": _changes, "responding_wake": _changes,
    "fast_twist": _fast_twist, "reverse_flow": _reverse_flow, "two_segments": _two_segments,
    "fixed_or_moving": _fixed_or_moving, "power_or_vibration": _power_or_vibration,
    "piezoelectric_ply": _piezoelectric_ply,
}  # fmt: skip
"""By name of the step."""


class _Sweep:
    """The designs along the control of a step, trimmed: B, and A beside each."""

    def __init__(self, step: LectureStep) -> None:
        """RuntimeError where one does not trim."""
        self._step, control = step, step.control
        b = [control.apply(step.inputs, value) for value in control.values]
        a = [beside(step.against, step.inputs, inputs) for inputs in b]
        self.stops = tuple(
            Stop(control.words(value), inputs, other, ())
            for value, inputs, other in zip(control.values, b, a, strict=True)
        )  # fmt: skip
        self.b, self.a = _trimmed(b), _trimmed([inputs for inputs in a if inputs is not None])

    @property
    def pair(self) -> tuple[Solution, Solution]:
        """A and B as the step begins."""
        start = self._step.control.start
        return self.a[start], self.b[start]

    def facts(self, numbers: Mapping[str, Number], answer: float, chart: StepChart, *curves: Sequence[float]) -> Facts:
        """With dots on these curves over the values of the control."""
        stops = tuple(
            replace(stop, dots=tuple((value, curve[k]) for curve in curves))
            for k, (stop, value) in enumerate(zip(self.stops, self._step.control.values, strict=True))
        )
        return _answered(self._step, stops, numbers, answer, chart)


def _trimmed(designs: Sequence[Inputs]) -> list[Solution]:
    """Each from the one before; those that are equal once."""
    solutions = list[Solution]()
    for inputs in designs:
        design, before = inputs.design(), solutions[-1] if solutions else None
        solutions.append(before if before and before.design == design else solve(design, before).require())
    return solutions


def _answered(
    step: LectureStep, stops: tuple[Stop, ...], numbers: Mapping[str, Number], answer: float, chart: StepChart
) -> Facts:
    """With the bounds between the answers, and the right one."""
    bounds = {
        f"bound_{k}" if len(set(map(abs, step.bounds)) - {0.0}) > 1 else "bound": Number("percent", abs(bound))
        for k, bound in enumerate(step.bounds, start=1)
        if bound
    }
    return Facts(stops, {**bounds, **numbers}, bisect_right(step.bounds, answer), chart)


def _named(step: LectureStep, a: Solution | None, b: Solution | None) -> dict[str, Number]:
    """What most texts name: the flight, the twists, powers of A and B and their differences."""
    inputs = step.begin()
    numbers = {"mu": Number("mu", inputs.advance_ratio), "twist_b": Number("angle", inputs.linear)}
    if step.against is not None:
        numbers["twist_a"] = Number("angle", step.against.linear)
    if a is None or b is None:
        return numbers
    parts = ("total", "induced", "profile")
    return {
        **numbers,
        **{f"{name}_a": Number("power", getattr(a.power, name)) for name in parts},
        **{f"{name}_b": Number("power", getattr(b.power, name)) for name in parts},
        **{f"{name}_change": Number("change", getattr(b.power, name) - getattr(a.power, name)) for name in parts},
        "saving": Number("power", a.power.total - b.power.total),
        "saving_percent": Number("fine", 1.0 - b.power.total / a.power.total),
    }


def _against(step: LectureStep) -> Inputs:
    assert step.against is not None
    return step.against
