"""One point of a study: from its values to a design, its trim or its optimum, and the row of results.

A point gives a row. If it does not trim, if no design can be made of it, or if an unexpected error occurs, the row has
its status and a message. A lack of memory is no result: MemoryError ends the chunk, which is computed again.

`WarmStarts` makes first guesses for the trims and searches of a chunk from the points computed before. Every trim
unknown and the induced velocity vary smoothly with speed, mass and twist. The guess is a local quadratic model of
nearby trims. A cold trim with the lifting line takes 11 evaluations on average, one started from the previous trim 8.3,
one from the quadratic with the derivatives of the nearest trim 7.3 (80 of 10⁵ points over four sampled ranges).
"""

import math
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from rotor.aero.inflow import inflow_model
from rotor.design.aircraft import Aircraft, reported_names
from rotor.design.design import Design, check_preset, preset_models
from rotor.design.quantities import ARGUMENTS, OPTIONS, STAND, SWITCHES
from rotor.files.make_design import make_design
from rotor.files.rotor_file import shipped_aircraft
from rotor.optimisation.concepts import Concept, restrict
from rotor.optimisation.doubt import saving_doubt
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import at_condition, hover_and_cruise
from rotor.optimisation.results import Optimum, SearchStatus
from rotor.optimisation.search import Search, run_search
from rotor.study.series import HUB_COLUMNS
from rotor.study.study import (
    ANSWER,
    FREQUENCIES,
    PLAIN,
    QUANTITIES,
    OptimumSettings,
    Study,
    Value,
    concept_with_breaks,
)
from rotor.support.arrays import Array
from rotor.support.assets import SHIPPED_ROTORS
from rotor.support.user_input import lacks_means, raise_interrupt
from rotor.trim.analysis import Analysis
from rotor.trim.export import solution_record
from rotor.trim.forward import as_built
from rotor.trim.hub_loads import hub_loads
from rotor.trim.many import analyse_in_step
from rotor.trim.newton import Guess
from rotor.trim.solution import Solution
from rotor.trim.solve import analyse, solve

_KEPT_TRIMS = 500
"""Trims kept."""
_KEPT_FACTORS = 64
"""How many of the last solutions are kept with their factors, which are large."""
_TRIMS_PER_TERM = 1.8
"""Trims that a quadratic is made of, over the number of its terms."""
_REGULARISATION = 1e-8
"""Directions in which the trims nearby spread by less than this part of the whole say nothing."""
_LARGEST_WEIGHTS = 30.0
"""Sum of the weights' sizes beyond which the model is not trusted, and the nearest trim serves."""


class WarmStarts:
    """Trims and optima of the points before, of one chunk."""

    def __init__(self, ranges: Mapping[str, tuple[float, float]]) -> None:
        """`ranges`: low and high of each numeric axis; distances are parts of these."""
        self._ranges = {name: (low, (high - low) or 1.0) for name, (low, high) in ranges.items()}
        self._key: tuple[object, ...] = ()
        self._places = np.zeros((0, len(ranges)))
        self._trims: list[Guess] = []
        self.concept = ""
        """The concept of the last optimum, and its parameters."""
        self.optimum: tuple[float, ...] = ()

    def guess(self, values: Mapping[str, Value], *, hovering: bool) -> Guess | None:
        """The start for the trim of a point; None if no similar point has been trimmed."""
        if self._kind(values, hovering) != self._key or not self._trims:
            return None
        steps = self._places - self._place(values)
        order: list[int] = np.argsort((steps**2).sum(axis=1), kind="stable")[
            : _wanted(steps.shape[1])
        ].tolist()
        near = [self._trims[k] for k in order]
        return near[0].with_array(_weights(steps[order]) @ np.array([trim.array for trim in near]))

    def keep(self, values: Mapping[str, Value], solution: Solution) -> None:
        """Keep a trim to start others from; one that did not converge is of no use."""
        if not solution.converged:
            return
        key, left = self._kind(values, solution.design.hovering), solution.start
        same = not self._trims or len(self._trims[0].array) == len(left.array)
        if key != self._key or not same:
            self._key, self._places, self._trims = key, self._places[:0], []
        self._places = np.vstack([self._places, self._place(values)])[-_KEPT_TRIMS:]
        self._trims = [*self._trims, left][-_KEPT_TRIMS:]
        if len(self._trims) > _KEPT_FACTORS:
            late = self._trims[-_KEPT_FACTORS - 1]
            self._trims[-_KEPT_FACTORS - 1] = replace(late, box=None)

    def _kind(self, values: Mapping[str, Value], hovering: bool) -> tuple[object, ...]:
        """What trims must share to learn from one another."""
        return (hovering, *(value for name, value in values.items() if name not in self._ranges))

    def _place(self, values: Mapping[str, Value]) -> Array:
        return np.array(
            [(float(values[name]) - low) / span for name, (low, span) in self._ranges.items()]
        )


def _wanted(axes: int) -> int:
    """Trims that a quadratic over so many axes is made of."""
    return math.ceil(_TRIMS_PER_TERM * math.comb(axes + 2, 2))


def _weights(steps: Array) -> Array:
    """Weights of the trims whose sum is the value of a quadratic through them at the point, (trims,).

    `steps`: from the point to each trim, the nearest first, (trims, axes). Moving least squares: near trims count more.
    With fewer trims than a quadratic needs it is a plane; where the weights are large, because the point lies far out,
    it is the nearest trim.
    """
    axes = steps.shape[1]
    scale = math.sqrt(float((steps**2).sum(axis=1).max())) or 1.0
    x = steps / scale
    columns = [np.ones(len(x)), *x.T]
    if len(x) >= _wanted(axes):
        columns += [x[:, i] * x[:, j] for i in range(axes) for j in range(i, axes)]
    basis = np.stack(columns, axis=1)
    trust = 1.0 / ((x**2).sum(axis=1) + 1e-3) ** 2
    normal: Array = (basis.T * trust) @ basis
    firm = _REGULARISATION * float(trust.sum()) * np.eye(len(normal))
    firm[0, 0] = 0.0
    value = np.asarray(np.linalg.solve(normal + firm, np.eye(len(normal))[0]), dtype=np.float64)
    weights = trust * (basis @ value)
    weights[0] += 1.0 - weights.sum()
    return weights if float(np.abs(weights).sum()) < _LARGEST_WEIGHTS else np.eye(len(x))[0]


_GRID = ("elements", "azimuths")
_MODELS = ("inflow", *SWITCHES, *OPTIONS)
"""Quantities that are fields of `Models`."""
_ARGUMENTS = tuple(
    name
    for name in QUANTITIES
    if name in ARGUMENTS and name not in ("rotor", "preset", *_MODELS, *_GRID)
)
"""Quantities that are arguments of `make_design`."""

Row = dict[str, Any]
Values = Mapping[str, Value]


def design_of(values: Values, aircraft: Mapping[str, Aircraft]) -> Design:
    """The design that a point's values describe; a twist to be searched for is that of the preset.

    `aircraft`: rotors of the user's own by name. Raises ValueError with one sentence.
    """
    preset = str(values.get("preset", "flight"))
    check_preset(preset)
    models = preset_models(preset)
    changed: dict[str, Any] = {name: values[name] for name in _MODELS if name in values}
    if "inflow" in changed:
        inflow_model(str(changed["inflow"]))
    stand = {key: values[f"stand_{key}"] for key in STAND if f"stand_{key}" in values}
    rotor = str(values.get("rotor", SHIPPED_ROTORS[0]))
    if "mu" in values and "speed_kt" in values:
        raise ValueError("mu and speed_kt are both given: omit one")
    arguments: dict[str, Any] = {name: values[name] for name in _ARGUMENTS if name in values}
    arguments |= {name: int(values[name]) for name in _GRID if name in values}
    return make_design(
        preset=preset,
        rotor=aircraft.get(rotor)
        or shipped_aircraft(rotor),  # No path of the machine: results are passed on.
        **arguments,
        models=replace(models, **changed) if changed else models,
        stand=stand or None,
    )


def trim_of(values: Values, study: Study) -> Design:
    """The design that a point of a study without a search trims. Raises ValueError with one sentence."""
    return _bladed(design_of(values, dict(study.aircraft)), values)


def check_point(values: Values, study: Study) -> None:
    """Raise ValueError, with one sentence, for values that no point of the study can have."""
    design = design_of(values, dict(study.aircraft))
    if study.optimum is None:
        _bladed(design, values)
    else:
        _search(design, values, study.optimum, WarmStarts({}))


def trims_in_step(points: Sequence[Values], study: Study) -> Sequence[Analysis | None]:
    """Trims of the first point and of those after it that differ from it in their twist alone; at least one.

    None where a point has to be trimmed by itself.
    """
    designs = list[Design]()
    with suppress(Exception):  # The row of that point has the sentence.
        for values in points if study.optimum is None else ():
            design = trim_of(values, study)
            if design.hovering or (designs and as_built(design) != as_built(designs[0])):
                break
            designs.append(design)
    if len(designs) < 2:
        return [None]
    try:
        return analyse_in_step(designs, [None] * len(designs))
    except Exception:  # The row of the point that it comes from has the sentence.
        return [None] * len(designs)


def evaluate(
    values: Values, study: Study, warm: WarmStarts, in_step: Analysis | None = None
) -> Row:
    """The row of one point, started from earlier points; its trim and optimum are kept for later ones.

    in_step: its trim, where it is known.
    """
    begin = time.perf_counter()
    row: Row = {name: value for name, value in values.items() if not isinstance(value, bool)}
    try:
        design = design_of(values, dict(study.aircraft))
        row = _condition(design) | row
        if study.optimum is None:
            design = _bladed(design, values)
            trim = in_step or analyse(design, warm.guess(values, hovering=design.hovering))
            solution = trim.solution
            row |= {"status": solution.status.value, "message": solution.message}
        else:
            search = _search(design, values, study.optimum, warm)
            optimum = run_search(search)
            trim = analyse(optimum.design, warm.guess(values, hovering=design.hovering))
            solution = trim.solution
            row |= _found(optimum, search) | {
                "status": optimum.status.value,
                "message": optimum.message,
            }
            if optimum.status is SearchStatus.CONVERGED and not solution.converged:
                row |= {"status": solution.status.value, "message": solution.message}
            if optimum.best is not None:
                warm.concept, warm.optimum = _name(search.concept), optimum.best.parameters
        row["twist"] = values.get("twist") or solution.design.twist.spec()
        if solution.converged:
            row |= _answer(solution)
            if solution.design.models.bending:
                row |= _vibration(trim)
            warm.keep(values, solution)
    except Exception as error:  # An unexpected error of one point must not stop its chunk.
        raise_interrupt(error)
        if lacks_means(error):  # Another worker or the next run computes the row.
            raise MemoryError(str(error)) from error
        bad, fault = isinstance(error, ValueError), f"{type(error).__name__}: {error}"
        row |= (
            {"status": "bad-input", "message": str(error)}
            if bad
            else {"status": "error", "message": fault}
        )
    together = 0.0 if in_step is None else in_step.solution.elapsed
    row["elapsed_ms"] = 1e3 * (time.perf_counter() - begin + together)
    return row


def _bladed(design: Design, values: Values) -> Design:
    """The design with the blade of a concept if one is given; all its parameters must be set."""
    given = _parameters(values)
    if "hover_share" in values:
        raise ValueError("hover_share needs a search: add [optimum], or omit hover_share")
    if "concept" not in values:
        if given:
            raise ValueError(
                f"{next(iter(given))} belongs to a twist concept: name it in [fixed] as concept = …"
            )
        return design
    if "twist" in values:
        raise ValueError("twist and concept are both given: omit one")
    concept, held = concept_with_breaks(str(values["concept"]), given)
    missing = [parameter.label for parameter in concept.parameters if parameter.name not in held]
    if missing:
        raise ValueError(
            f"concept {concept.name} needs {missing[0]}: add it to [axes] or [fixed], or add [optimum] to search for it"
        )
    return concept.apply(design, [held[parameter.name] for parameter in concept.parameters])


def _search(design: Design, values: Values, searching: OptimumSettings, warm: WarmStarts) -> Search:
    if "twist" in values:
        raise ValueError("an optimum searches for the twist: omit twist")
    if "concept" not in values:
        raise ValueError(
            'an optimum needs a twist concept: add for example concept = "two-segment" to [fixed]'
        )
    wide, held = concept_with_breaks(str(values["concept"]), _parameters(values))
    concept = restrict(wide, held) if held else wide
    share = values.get("hover_share")
    objective = (
        at_condition(design, searching.objective)
        if share is None
        else hover_and_cruise(
            design, float(share), design.condition.advance_ratio, searching.objective
        )
    )
    near = warm.optimum if warm.concept == _name(concept) else ()
    limits = Limits(rate=searching.rate, stalled=searching.stalled, index=searching.index)
    guesses = (near,) if near else ()
    return Search(
        design, concept, objective, limits, searching.starts, searching.seed, guesses, band=False
    )


def _name(concept: Concept) -> str:
    return " ".join((concept.name, *(parameter.name for parameter in concept.parameters)))


def _parameters(values: Values) -> dict[str, float]:
    return {name: float(value) for name, value in values.items() if name not in PLAIN}


def _condition(design: Design) -> Row:
    return {
        "rotor": design.aircraft.key or design.aircraft.name,
        "speed_m_s": design.airspeed,
        **{name: design.numbers[name] for name in reported_names([design.unusual])},
        "preset": design.preset,
        "inflow": design.models.inflow,
    }


def _found(optimum: Optimum, search: Search) -> Row:
    best = optimum.best
    row: Row = {
        "baseline_power_w": optimum.baseline_power,
        "saving_percent": None if optimum.saving is None else 100.0 * optimum.saving,
        "local_minima": len(optimum.minima),
        "evaluations": optimum.evaluations,
    }
    if best is None:
        return row
    for parameter, value in zip(search.concept.parameters, best.parameters, strict=True):
        row[parameter.label] = parameter.shown(value)
    row |= {"mean_power_w": best.power, "active": ", ".join(best.active)}
    assert search.objective is not None
    if (doubt := saving_doubt(search.objective, optimum.design, search.design)) is not None:
        row |= {"saving_doubt_percent": doubt.change_band_percent, "sureness": doubt.sureness}
    if (
        any(condition.flight.advance_ratio == 0.0 for condition in search.objective.conditions)
        and len(search.objective.conditions) > 1
    ):
        hover = solve(optimum.design.at(mu=0.0))
        row["hover_power_w"] = hover.power.total if hover.converged else None
    return row


def _answer(solution: Solution) -> Row:
    record = solution_record(solution)
    powers = {f"power_{part}_w": power for part, power in record["power_w"].items()}
    row = {name: value for name, value in {**record, **powers}.items() if name in ANSWER}
    return row | {
        "caveats": ", ".join(caveat.name for caveat in solution.caveats),
        "passes": solution.passes,
    }


def _vibration(trim: Analysis) -> Row:
    """Blade frequencies, and hub loads where the design has them."""
    row, solution = Row(), trim.solution
    if (frequencies := solution.blade_frequencies) is not None:
        for name in FREQUENCIES:
            kind, _, number = name.rpartition("_")
            row[f"{name}_per_rev"] = getattr(frequencies, kind)[int(number) - 1]
    loads = hub_loads(trim, band=False)
    if loads is None:  # A caveat gives the reason.
        return row
    return row | {
        "index_percent": loads.index,
        **dict(zip(HUB_COLUMNS, loads.amplitudes.values(), strict=True)),
    }
