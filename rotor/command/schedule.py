"""`schedule`: optimum twist at each flight condition, best fixed blade, and the gain of in-flight twist change."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from rotor.command import common
from rotor.command.optimise import named
from rotor.design.aircraft import in_words, reported_names
from rotor.design.design import Design
from rotor.optimisation.concepts import CONCEPTS, Concept, find_concept, on_top
from rotor.optimisation.mission import standard_mission
from rotor.optimisation.objective import POWERS, WeightedCondition, read_mission
from rotor.optimisation.results import Optimum, SearchStatus
from rotor.optimisation.schedule import Schedule, ScheduleOptimum, SchedulePlan, run_plan
from rotor.support.table import CellValue, Column, Table, table
from rotor.support.terminal import wrapped
from rotor.support.units import power_text, power_unit
from rotor.support.user_input import parse_range

DEFAULT_CONCEPTS = ("linear", "two-segment", "three-segment", "free-form")
_DIVIDED = ("two-segment", "two-segment-two-airfoils")


def add_parser(commands: Any) -> None:
    parser = common.add_command(commands, "schedule", run)
    words = f"{common.CONCEPT_HELP} | all (default {', '.join(DEFAULT_CONCEPTS)})"
    parser.add_argument(
        "--concept", nargs="+", default=list(DEFAULT_CONCEPTS), metavar="NAME", help=words
    )
    parser.add_argument(
        "--division", metavar="R", help="break of two-segment concepts in r/R (default 0.5)"
    )
    where = parser.add_mutually_exclusive_group()
    words = (
        "range of advance ratios, equal hours at each (default: hover, climb, cruise and fast "
        "flight for assumed hours)"
    )
    where.add_argument("--mu", dest="range", metavar="A:B:STEP", help=words)
    where.add_argument("--mission", metavar="FILE", help=common.MISSION_HELP)
    parser.add_argument(
        "--objective", default="total", choices=POWERS, help="power to minimise (default total)"
    )
    common.add_processes_argument(parser)
    common.add_design_arguments(parser)
    common.add_search_arguments(parser, 4)
    common.add_output_arguments(parser, "the table")


def run(args: argparse.Namespace) -> int:
    """0 when every optimum was found, 1 when not, 130 stopped by Ctrl-C with the results so far printed."""
    plan = plan_from(args)
    processes = common.processes_from(args)
    common.check_output(args)
    total = len(plan.concepts) * (len(plan.conditions) + 1)
    with common.interruptible() as stop, common.bar(total, " optima") as advance:

        def add(cell: ScheduleOptimum) -> None:
            advance(
                f"{cell.concept} {'fixed' if cell.condition is None else f'condition {cell.condition + 1}'}"
            )

        schedule = run_plan(plan, add, stop, processes if total > 2 else 1)
        stopped = stop()
    if args.csv:
        optima_table(schedule).write(args.csv)
    assumed = args.range is None and args.mission is None
    common.print_result(args, lambda: record(schedule), lambda: report(schedule, assumed=assumed))
    if schedule.message:
        print(f"rotor: {schedule.message}", file=sys.stderr)
    return common.STOPPED if stopped and not schedule.complete else 0 if schedule.converged else 1


def plan_from(args: argparse.Namespace) -> SchedulePlan:
    names = list(CONCEPTS) if args.concept == ["all"] else list(dict.fromkeys(args.concept))
    division = common.parse_division(args.division)
    names.sort(key=lambda name: list(CONCEPTS).index(name) if name in CONCEPTS else -1)
    concepts = tuple(find_concept(name, division if name in _DIVIDED else None) for name in names)
    design = common.design_from(args)
    if args.on_top:
        concepts = tuple(on_top(concept, design.twist) for concept in concepts)
    conditions = sorted(
        _conditions(args, design), key=lambda one: (one.flight.advance_ratio, one.flight.mass)
    )
    limits = common.limits_from(args, design, concepts)
    for concept in concepts:
        limits.bounds_of(concept)
    return SchedulePlan(
        design, concepts, tuple(conditions), args.objective, limits, args.starts, args.seed
    )


def _conditions(args: argparse.Namespace, design: Design) -> Sequence[WeightedCondition]:
    """The flight conditions that are asked for, with their hours."""
    if args.mission:
        return read_mission(args.mission, design)
    if args.range is None:
        return standard_mission(design).conditions
    ratios = sorted(set(parse_range(args.range)))
    return [WeightedCondition(replace(design.condition, advance_ratio=mu)) for mu in ratios]


def record(schedule: Schedule) -> dict[str, Any]:
    """The JSON of `schedule --json`; values not found are null."""
    plan = schedule.plan
    quantities = _quantities(plan)
    gains = {concept.name: schedule.in_flight_gain(concept.name) for concept in plan.concepts}
    return {
        "status": "converged"
        if schedule.converged
        else "not-converged"
        if schedule.complete
        else "stopped",
        "concepts": [concept.name for concept in plan.concepts],
        "objective": plan.quantity,
        "conditions": [
            {
                **{name: condition.flight.numbers[name] for name in quantities},
                "hours": condition.hours,
                "baseline_power_w": _baseline(schedule, k),
                "optima": {
                    concept.name: _entry(schedule.at(k, concept.name), concept)
                    for concept in plan.concepts
                },
            }
            for k, condition in enumerate(plan.conditions)
        ],
        "fixed": {
            concept.name: _entry(schedule.at(None, concept.name), concept)
            for concept in plan.concepts
        },
        "worth": {
            name: None
            if gain is None
            else {
                "baseline_w": gain.baseline,
                "fixed_w": gain.fixed,
                "moving_w": gain.moving,
                "gain_w": gain.gain,
                "gain_percent": 100.0 * gain.share,
                "gain_band_w": sure.change_band
                if (sure := schedule.gain_doubt(name)) is not None
                else None,
                "sureness": sure and sure.sureness,
            }
            for name, gain in gains.items()
        },
    }


def _quantities(plan: SchedulePlan) -> tuple[str, ...]:
    """Quantities of the flight conditions that tables and JSON have."""
    return reported_names(condition.flight.unusual for condition in plan.conditions)


def _baseline(schedule: Schedule, condition: int) -> float | None:
    return next(
        (cell.optimum.baseline_power for cell in schedule.cells if cell.condition == condition),
        None,
    )


def _entry(optimum: Optimum | None, concept: Concept) -> dict[str, Any] | None:
    if optimum is None:
        return None
    best = optimum.best
    return {
        "status": optimum.status.value,
        "parameters": {} if best is None else named(concept, best.parameters),
        "twist": None if best is None else best.twist,
        "met": [] if best is None else list(best.active),
        "power_w": None if best is None else best.power,
        "saving_percent": optimum.saving_percent,
        "saving_doubt_percent": optimum.doubt and optimum.doubt.change_band_percent,
        "sureness": optimum.doubt and optimum.doubt.sureness,
    }


def report(schedule: Schedule, *, assumed: bool = False) -> str:
    """The text of `schedule`. `assumed`: whether the hours of its mission are those of the default."""
    lines: list[str] = []
    before: object = ...
    for cell in schedule.cells:
        if cell.condition != before:
            before = cell.condition
            lines.append(
                f"{_where(schedule, cell.condition)}: {_power(cell.optimum.baseline_power)} with the present twist"
            )
        lines.append(_line(cell, max(len(concept.name) for concept in schedule.plan.concepts)))
    if any(cell.optimum.best is not None and cell.optimum.best.active for cell in schedule.cells):
        lines.append("*: at a bound or limit that holds it, so the least power lies beyond")
    lines.append("")
    for concept in schedule.plan.concepts:
        gain = schedule.in_flight_gain(concept.name)
        if gain is not None:
            (symbol, size), sure = power_unit(gain.baseline), schedule.gain_doubt(concept.name)
            sentence = (
                f"{concept.title}: starting design {gain.baseline / size:.1f} {symbol}, best fixed "
                f"{gain.fixed / size:.1f} {symbol}, variable {gain.moving / size:.1f} {symbol}. "
                f"{'' if sure is None else f'Beyond that, variable twist {sure.saving_words}.'}"
            )
            lines.append(wrapped(sentence, "  "))
    if assumed:
        lines.append("The hours of the mission are assumed: give yours with --mission.")
    if not schedule.complete:
        lines.append("Stopped before the end.")
    return "\n".join(lines)


def _where(schedule: Schedule, condition: int | None) -> str:
    if condition is None:
        return "One fixed blade for all"
    flight = schedule.plan.conditions[condition].flight
    mass, altitude = f"{flight.mass:.6g} kg", f"{flight.altitude:.4g} m"
    return ", ".join((f"µ {flight.advance_ratio:.4g}", mass, altitude, *in_words(flight.unusual)))


def _power(power: float | None) -> str:
    return "no trim" if power is None else power_text(power, 1)


def _line(cell: ScheduleOptimum, width: int) -> str:
    """An optimum of the table, and below it what holds it; what could not be found says why."""
    optimum = cell.optimum
    if optimum.best is None:
        return wrapped(
            f"  {cell.concept:<{width}}  {optimum.status.value}: {optimum.message}", "    "
        )
    met = f"\n    * {', '.join(optimum.best.active)}" if optimum.best.active else ""
    status = "" if optimum.status is SearchStatus.CONVERGED else f"  ({optimum.status.value})"
    power, twist = _power(optimum.best.power), common.short_spec(optimum.best.twist)
    return f"  {cell.concept:<{width}}{power:>11}  {optimum.saving_words:<26}  {twist}{status}{met}"


def optima_table(schedule: Schedule) -> Table:
    """The CSV: an optimum a row; those of the one blade for all conditions come last, without hours."""
    quantities = _quantities(schedule.plan)
    columns = (
        *(Column(key=name, stored=".6g" if name == "mass_kg" else ".4g") for name in quantities),
        Column(key="hours", stored=".4g"),
        *(Column(key=key) for key in ("concept", "status")),
        *(Column(key=key, stored=".2f") for key in ("baseline_kw", "power_kw")),
        *(Column(key=key, stored=".2f") for key in ("saving_percent", "saving_doubt_percent")),
        *(Column(key=key) for key in ("sureness", "twist", "met")),
    )
    rows: list[tuple[CellValue, ...]] = []
    for cell in schedule.cells:
        optimum, best = cell.optimum, cell.optimum.best
        flight: tuple[CellValue, ...] = ("all", *(None for _ in quantities))
        if cell.condition is not None:
            condition = schedule.plan.conditions[cell.condition]
            flight = (*(condition.flight.numbers[name] for name in quantities), condition.hours)
        rows.append(
            (
                *flight,
                cell.concept,
                optimum.status.value,
                optimum.baseline_power and optimum.baseline_power / 1e3,
                best and best.power / 1e3,
                optimum.saving and 100.0 * optimum.saving,
                optimum.doubt and optimum.doubt.change_band_percent,
                optimum.doubt and optimum.doubt.sureness,
                best and best.twist,
                best and ", ".join(best.active),
            )
        )
    return table(columns, rows)
