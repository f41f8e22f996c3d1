"""`optimise`: the twist of least power or vibration for one flight condition, or for several at once."""

import argparse
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from rotor.command import common
from rotor.design.blade import airfoils_spec
from rotor.design.design import Design
from rotor.optimisation.concepts import Concept, find_concept, on_top
from rotor.optimisation.doubt import saving_doubt
from rotor.optimisation.objective import (
    QUANTITIES,
    Objective,
    at_condition,
    evaluate_objective,
    hover_and_cruise,
    read_mission,
)
from rotor.optimisation.results import Minimum, Optimum, ParameterBand, Progress, SearchStatus
from rotor.optimisation.search import STARTS, Search, nearby_flights, run_search
from rotor.support.terminal import wrapped
from rotor.support.units import power_text, seconds_text
from rotor.trim.doubt import Doubt, other_models
from rotor.trim.hub_loads import hub_loads
from rotor.trim.solution import Solution


def add_parser(commands: Any) -> None:
    parser = common.add_command(commands, "optimise", run)
    parser.add_argument(
        "--concept",
        default="linear",
        metavar="NAME",
        help=f"{common.CONCEPT_HELP} (default linear)",
    )
    parser.add_argument("--division", metavar="R,…", help=common.DIVISION_HELP)
    parser.add_argument(
        "--objective",
        default="total",
        metavar="NAME",
        help="what to minimise: total (power, default) | induced (power) | hover-cruise (mean power of hover and the "
        "given speed) | vibration (index of the hub loads)",
    )
    words = "with hover-cruise: fraction of time in hover (default 0.5)"
    parser.add_argument("--hover-share", type=common.finite, metavar="0…1", help=words)
    parser.add_argument("--mission", metavar="FILE", help=common.MISSION_HELP)
    words = "omit the range of each parameter that costs 0.1 %% of power"
    parser.add_argument("--no-band", dest="band", action="store_false", help=words)
    parser.add_argument(
        "--doubt", action="store_true", help="also search with other models, masses and drag areas"
    )
    common.add_design_arguments(parser, speed=True)
    common.add_search_arguments(parser, STARTS)
    common.add_output_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """0 converged, 1 not converged, 130 stopped by Ctrl-C with the best design so far printed."""
    design = common.design_from(args)
    concept = find_concept(args.concept, common.parse_division(args.division))
    if args.on_top:
        concept = on_top(concept, design.twist)
    objective = _objective(args, design)
    alone = objective == at_condition(design)
    if args.doubt and not alone:
        raise ValueError(
            "--doubt needs the least total power of one condition: leave --mission and --objective out"
        )
    limits = common.limits_from(args, design, (concept,))
    search = Search(design, concept, objective, limits, args.starts, args.seed, band=args.band)
    with common.interruptible() as stop, common.bar(None, " designs") as advance:
        optimum = run_search(search, lambda progress: advance(_words(progress)), stop)
    if optimum.best is not None and optimum.doubt is None:
        optimum = _with_doubt(optimum, objective, design)
    beside = _extra_results(design, objective, optimum)
    if optimum.best is not None and optimum.status is SearchStatus.CONVERGED:
        if args.doubt:
            beside = replace(beside, flights=_in_other_flights(search, optimum.best))
        if args.doubt or (design.hovering and alone):
            beside = replace(
                beside, models=_from(search, optimum.best, other_models(design).items())
            )
    common.print_result(
        args,
        lambda: record(optimum, concept, beside),
        lambda: report(optimum, concept, beside, objective),
    )
    return {
        SearchStatus.CONVERGED: 0,
        SearchStatus.NOT_CONVERGED: 1,
        SearchStatus.STOPPED: common.STOPPED,
    }[optimum.status]


@dataclass(frozen=True)
class _ExtraResults:
    """What belongs beside the answer of a search."""

    caveats: tuple[str, ...] = ()
    """Caveats of the best design."""
    index_band: tuple[float, float] | None = None
    """Least and largest mean index of the best design over inflow models [%]; None where it is not asked for."""
    same_airfoils: Doubt | None = None
    """Beside the starting twist on the airfoils of the best design; None where the airfoils are the same."""
    models: tuple[tuple[str, Optimum], ...] = ()
    """What searches with other models find, by the name of the model."""
    flights: tuple[tuple[str, Optimum], ...] = ()
    """Optima with other masses and drag areas, by the words for it."""


def _extra_results(design: Design, objective: Objective, optimum: Optimum) -> _ExtraResults:
    if optimum.best is None:
        return _ExtraResults()
    solutions = evaluate_objective(objective, optimum.design, gradient=False).solutions
    caveats = dict.fromkeys(
        caveat.sentence for solution in solutions for caveat in solution.caveats
    )
    changed = optimum.design.rotor.blade.spans != design.rotor.blade.spans
    start = replace(design, rotor=optimum.design.rotor)
    same = saving_doubt(objective, optimum.design, start) if changed else None
    return _ExtraResults(
        tuple(caveats),
        None if optimum.best.index is None else _index_band(objective, solutions),
        same,
    )


def _in_other_flights(search: Search, best: Minimum) -> tuple[tuple[str, Optimum], ...]:
    """With other masses and drag areas, from the same best twist."""
    units = {"mass": "{:.0f} kg", "drag area": "{:.1f} m²"}
    designs = [
        (f"{cause} {units[cause].format(end)}", design)
        for cause, ends, pair in nearby_flights(search.design)
        for end, design in zip(ends, pair, strict=True)
    ]
    return _from(search, best, designs)


def _from(
    search: Search, best: Minimum, designs: Iterable[tuple[str, Design]]
) -> tuple[tuple[str, Optimum], ...]:
    """Optima of other designs, from the same best twist."""
    other = replace(search, objective=None, guesses=(best.parameters,), starts=1, band=False)
    found = [(name, design, run_search(replace(other, design=design))) for name, design in designs]
    return tuple(
        (name, _with_doubt(optimum, at_condition(design), design))
        for name, design, optimum in found
    )


def _with_doubt(optimum: Optimum, objective: Objective, start: Design) -> Optimum:
    return replace(optimum, doubt=optimum.best and saving_doubt(objective, optimum.design, start))


def _index_band(objective: Objective, solutions: Sequence[Solution]) -> tuple[float, float] | None:
    """Least and largest mean index of some trims over inflow models [%]."""
    ends = [
        loads.band
        for each in solutions
        if (loads := hub_loads(each)) is not None and loads.band is not None
    ]
    if len(ends) < len(solutions):
        return None
    low, high = (
        sum(share * end[k] for share, end in zip(objective.shares, ends, strict=True))
        for k in (0, 1)
    )
    return low, high


def _objective(args: argparse.Namespace, design: Design) -> Objective:
    if args.objective == "hover-cruise":
        if args.mission or args.hover:
            raise ValueError(
                "objective hover-cruise sets its own conditions: omit --mission and --hover"
            )
        return hover_and_cruise(
            design,
            0.5 if args.hover_share is None else args.hover_share,
            design.condition.advance_ratio,
        )
    if args.hover_share is not None:
        raise ValueError(
            f"hover share {args.hover_share:g} needs its objective: add --objective hover-cruise"
        )
    if args.objective not in QUANTITIES:
        raise ValueError(
            f"objective {args.objective!r} is not known: use {', '.join(QUANTITIES)} or hover-cruise"
        )
    objective = at_condition(design, args.objective)
    return (
        replace(objective, conditions=read_mission(args.mission, design))
        if args.mission
        else objective
    )


def _words(progress: Progress) -> str:
    best = "" if progress.best_power is None else f", best {power_text(progress.best_power, 2)}"
    best += "" if progress.best_index is None else f", index {progress.best_index:.2f} %"
    return f"{progress.phase} {progress.start + 1}/{progress.starts}{best}"


def named(concept: Concept, values: tuple[float, ...]) -> dict[str, float]:
    """Parameters by label, degrees in labels that end in _deg."""
    return {
        one.label: round(one.shown(value), 6)
        for one, value in zip(concept.parameters, values, strict=True)
    }


def record(optimum: Optimum, concept: Concept, beside: _ExtraResults) -> dict[str, Any]:
    """The JSON of `optimise --json`; values not found are null."""
    best, band = optimum.best, beside.index_band and list(beside.index_band)
    index = {"index_percent": best and best.index, "index_band_percent": band}
    return {
        "status": optimum.status.value,
        "concept": optimum.concept,
        "parameters": {} if best is None else named(concept, best.parameters),
        "twist": None if best is None else best.twist,
        "power_w": None if best is None else best.power,
        "baseline_power_w": optimum.baseline_power,
        "saving_percent": None if optimum.saving is None else 100.0 * optimum.saving,
        **(
            {}
            if best is None or best.index is None
            else index | {"baseline_index_percent": optimum.baseline_index}
        ),
        "band": _bands(concept, optimum.band),
        "local_minima": [_minimum(minimum, concept) for minimum in optimum.minima],
        "evaluations": optimum.evaluations,
        "elapsed_s": optimum.elapsed,
        "message": optimum.message,
        **_sure(optimum),
        "doubt_band": _bands(concept, optimum.doubt_band),
        "doubt_cost_w": optimum.doubt_cost,
        "active": [] if best is None else list(best.active),
        "airfoils": airfoils_spec(optimum.design.rotor),
        "starts": optimum.starts,
        "seed": optimum.seed,
        "same_airfoils_power_w": beside.same_airfoils and beside.same_airfoils.against,
        "caveats": list(beside.caveats),
        **(
            {"models": {name: _other(other, concept) for name, other in beside.models}}
            if beside.models
            else {}
        ),
        **(
            {"flights": {name: _other(other, concept) for name, other in beside.flights}}
            if beside.flights
            else {}
        ),
    }


def _other(optimum: Optimum, concept: Concept) -> dict[str, Any]:
    return {
        "parameters": {} if optimum.best is None else named(concept, optimum.best.parameters),
        "power_w": None if optimum.best is None else optimum.best.power,
        "saving_percent": optimum.saving_percent,
        **_sure(optimum),
    }


def _sure(optimum: Optimum) -> dict[str, float | str | None]:
    doubt = optimum.doubt
    return {
        "saving_doubt_percent": doubt and doubt.change_band_percent,
        "sureness": doubt and doubt.sureness,
    }


def _bands(concept: Concept, bands: Sequence[ParameterBand]) -> dict[str, list[float]]:
    """By label, low and high."""
    by_name = {parameter.name: parameter for parameter in concept.parameters}
    return {
        by_name[band.parameter].label: [
            round(by_name[band.parameter].shown(end), 6) for end in (band.low, band.high)
        ]
        for band in bands
    }


def _minimum(minimum: Minimum, concept: Concept) -> dict[str, Any]:
    return {
        "parameters": named(concept, minimum.parameters),
        "twist": minimum.twist,
        "power_w": minimum.power,
        **({} if minimum.index is None else {"index_percent": minimum.index}),
        "starts": list(minimum.starts),
        "active": list(minimum.active),
    }


def digits_of_band(width: float) -> int:
    """Decimals that show a tenth of a band's width, at most 3: more would be noise on a flat optimum."""
    return min(max(math.ceil(1.0 - math.log10(width)), 0), 3) if width > 0.0 else 3


def _in_hover(beside: _ExtraResults, optimum: Optimum, k: int) -> list[float]:
    """The parameter of that index with the other inflow model of hover, where there is one."""
    optima = [other.best for _, other in beside.models] if optimum.design.hovering else []
    return [best.parameters[k] for best in optima if best is not None]


def report(optimum: Optimum, concept: Concept, beside: _ExtraResults, objective: Objective) -> str:
    best = optimum.best
    lines = [wrapped(f"{concept.title}: {optimum.status.value}. {optimum.message}")]
    if best is None:
        return "\n".join(lines)
    least = "index" if objective.quantity == "vibration" else "power"
    bands = {band.parameter: band for band in optimum.band}
    doubts = {band.parameter: band for band in optimum.doubt_band}
    for k, (parameter, value) in enumerate(zip(concept.parameters, best.parameters, strict=True)):
        band = bands.get(parameter.name)
        low, high = (parameter.shown(band.low), parameter.shown(band.high)) if band else (0.0, 1.0)
        digits = digits_of_band(high - low)
        line = f"{parameter.title:<20}{parameter.shown(value):z9.{digits}f} {parameter.shown_unit}"
        if band:
            line += f"   {low:z.{digits}f} to {high:z.{digits}f} within 0.1 % of the {least}"
        if sure := doubts.get(parameter.name):
            low, high = parameter.shown(sure.low), parameter.shown(sure.high)
            causes = ", ".join(
                f"{words} {parameter.shown(by):+z.{digits}f}" for words, by in sure.causes
            )
            line += (
                f", {low:z.{digits}f} to {high:z.{digits}f} with other inputs or inflow ({causes})"
            )
        for line_rate in _in_hover(beside, optimum, k):
            low, high = sorted((parameter.shown(value), parameter.shown(line_rate)))
            line += f", {low:z.{digits}f} to {high:z.{digits}f} between annuli and a lifting line"
        lines.append(wrapped(line, " " * 38))
    lines.append(f"twist {common.short_spec(best.twist)}")
    airfoils = airfoils_spec(optimum.design.rotor)
    if airfoils:
        lines.append(f"airfoils {airfoils}")
    lines.append(
        f"power {power_text(best.power, 1)}"
        + (f"; active limits: {', '.join(best.active)}" if best.active else "")
    )
    if optimum.baseline_power is not None and optimum.saving is not None:
        lines.append(
            f"starting design {power_text(optimum.baseline_power, 1)}; the best {optimum.saving_words}"
        )
        if optimum.doubt_cost is not None:
            cost = power_text(optimum.doubt_cost, 1)
            lines.append(
                f"with inputs or inflow off by their uncertainty, the best twist would need {cost} less than this one"
            )
    if best.index is not None:
        low, high = beside.index_band or (best.index, best.index)
        before = (
            ""
            if optimum.baseline_index is None
            else f"; starting design {optimum.baseline_index:.2f} %"
        )
        lines.append(
            f"index {best.index:.2f} % of the weight, {low:.1f} to {high:.1f} % over inflow models: for comparison, "
            f"not an absolute level{before}"
        )
    if beside.same_airfoils is not None:
        power = power_text(beside.same_airfoils.against or 0.0, 1)
        lines.append(
            f"starting twist on these airfoils {power}; the best {beside.same_airfoils.saving_words}"
        )
    for name, outcome in (*beside.models, *beside.flights):
        twist = "no optimum" if outcome.best is None else common.short_spec(outcome.best.twist)
        lines.append(
            f"with {name}: {twist}" + (f", {outcome.saving_words}" if outcome.saving_words else "")
        )
    for other in optimum.minima[1:]:
        lines.append(
            f"local minimum: {power_text(other.power, 1)} with {common.short_spec(other.twist)}"
        )
    lines.append(f"{optimum.evaluations} evaluations, {seconds_text(optimum.elapsed)}")
    lines += [wrapped(f"caveat: {caveat}", "  ") for caveat in beside.caveats]
    return "\n".join(lines)
