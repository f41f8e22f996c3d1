"""Newton's method on the exact Jacobian, for trim unknowns, elastic twist and induced inflow together.

The derivatives of the last few trims are kept. A trim that starts from one of them takes its first steps with these,
which are nearly its own after the step of a slider, and the gradient of power needs the same ones. The residual has to
meet the same tolerance, whatever the derivatives of the steps.
"""

import math
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, evaluate_elements, wake_at
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.interface import InflowColumns, InflowFeedback
from rotor.aero.sums import Slopes, slopes
from rotor.aero.torsion_balance import torsion_error, torsion_slopes
from rotor.aero.trial_loads import LoadsByInflow, TrialLoads, evaluate_loads, loads_of
from rotor.aero.trim_state import TrimState, Unknown
from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.trim.equations import Balance, balance, balance_of, unknowns_of, with_given_values
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions

_NEARLY = 10.0
"""Expected residual over its tolerance at which a step may well be the last. Our choice."""
_MOST_SLOW_STEPS = 4
"""Steps that hardly reduce the residual before the iteration ends."""


@dataclass(frozen=True, eq=False)
class Derivatives:
    """Exact derivatives at an iterate, as far as steps need them."""

    unknowns: tuple[Unknown, ...]
    jacobian: Array
    """Of the trim equations, then of the torsion equations, by the unknowns and the elastic coordinates."""
    weights: Array
    """Of the sums over the disk in the trim equations, (equations, sums)."""
    feedback: InflowFeedback | None
    answer: InflowColumns | None
    """∂λ_i by the unknowns and the elastic coordinates; None for a model that does not depend on the load."""
    by_terms: Array | None
    """Of these equations by the terms of an inflow that answers the load, (equations + columns, terms)."""
    by_inflow: LoadsByInflow
    shape: tuple[int, int]
    """(elements, azimuths)"""

    def serve(self, problem: Problem, unknowns: tuple[Unknown, ...]) -> bool:
        """Whether steps can be made with them: whether they are for these unknowns on this grid."""
        return (
            self.unknowns == unknowns
            and len(self.jacobian) == len(unknowns) + problem.given_torsion.size
            and self.shape == problem.disk.shape
            and (self.feedback is not None) == problem.inflow.load_dependent
        )


@dataclass(frozen=True, eq=False)
class Guess:
    """Where to start: the trim state, and the induced field for a load-dependent model."""

    state: TrimState
    induced: Array | None = None
    elastic: Array | None = None
    """Coordinates of the elastic twist, (modes, functions)."""
    derivatives: Derivatives | None = None
    """Those at or near an earlier trim, for the first steps."""


@dataclass(frozen=True, eq=False)
class TrimResult:
    """Where Newton's method ended."""

    elements: BladeElements
    residual: float
    """Largest residual over `Problem.scale`."""
    converged: bool
    passes: int
    """Evaluations of the blade elements."""
    reached: float = 1.0
    """How far continuation from an easier condition came (1: all the way)."""
    derivatives: Derivatives | None = None
    """Those of the last step, where they reduced the residual so much that they are near those of the trim."""


@dataclass(frozen=True, eq=False)
class KeptTrim:
    """What is known of a trim beside its solution."""

    induced: Array
    """The array of the solution's inflow."""
    derivatives: Derivatives | None
    """At the trim or near it, 0.5 MB."""
    elements: BladeElements | None
    """1.3 MB; None once other trims have followed."""
    problem: Problem | None = None
    """The design on its grid, kept as long as the blade elements."""


class KeptTrims:
    """The trims used last, known by the array of their inflow."""

    def __init__(self, most: int = 64, whole: int = 4) -> None:
        """most: trims kept; whole: with their blade elements."""
        self._most, self._whole = most, whole
        self._lock = threading.Lock()
        self._kept: dict[int, KeptTrim] = {}
        """By the identity of the array, which lives as long as the trim is kept; the one used last at the end."""

    def of(self, induced: Array) -> KeptTrim | None:
        """The trim with this very array; None where it is not kept."""
        with self._lock:
            kept = self._kept.pop(id(induced), None)
            if kept is not None:
                self._kept[id(induced)] = kept
            return kept

    def keep(self, kept: KeptTrim) -> None:
        """Keep a trim, in the place of the one that was used longest ago."""
        with self._lock:
            self._kept.pop(id(kept.induced), None)
            self._kept[id(kept.induced)] = kept
            while len(self._kept) > self._most:
                del self._kept[next(iter(self._kept))]
            whole = [key for key, one in self._kept.items() if one.elements is not None]
            for key in whole[: -self._whole]:
                self._kept[key] = replace(self._kept[key], elements=None, problem=None)


KEPT = KeptTrims()


@dataclass(frozen=True, eq=False)
class _Iterate:
    """The loads at a trial state, with the residual of every equation."""

    loads: TrialLoads
    balance: Balance
    inflow_error: Array | None
    """The model's response less the trial field; None for a model that does not depend on the load."""
    torsion_error: Array
    """Residual of the torsion equations [rad], (columns,); none for a rigid blade."""
    size: float
    """Largest residual over its tolerance: at most 1 when all equations are met."""
    elements: BladeElements | None
    """None where only the loads were evaluated."""


def newton(problem: Problem, start: Guess, options: SolverOptions = DEFAULT_OPTIONS) -> TrimResult:
    """Newton's method on trim unknowns, elastic twist and inflow together, with a step limit and backtracking.

    Eliminating the inflow by the model's own feedback leaves a system of the trim unknowns and, for an elastic blade,
    its torsion coordinates. The derivatives are kept over several steps, because they cost more than an evaluation; the
    first steps are made with those of the start, if it has any.
    """
    unknowns = unknowns_of(problem.design)
    limits = np.array([options.inflow_step if name == "lambda0" else options.angle_step for name in unknowns])
    shape = problem.given_torsion.shape
    limits = np.concatenate([limits, np.full(problem.given_torsion.size, options.angle_step)])
    elastic = start.elastic if start.elastic is not None and start.elastic.shape == shape else np.zeros(shape)
    state = with_given_values(problem, start.state)
    induced = start.induced
    if problem.inflow.load_dependent and (induced is None or induced.shape != problem.disk.shape):
        induced = _prescribed_start(problem, state)
    derivatives = start.derivatives
    if derivatives is not None and not derivatives.serve(problem, unknowns):
        derivatives = None
    latest, serving, secants = derivatives, False, _Secants(derivatives)
    point = _evaluate(problem, state, induced, elastic, options, whole=derivatives is None)
    passes, slow_steps, expected = 1, 0, math.inf
    while point.size > 1.0 and passes < options.max_passes and slow_steps < _MOST_SLOW_STEPS:
        fresh = derivatives is None
        if derivatives is None:
            if options.pause is not None:
                options.pause()
            elements = _elements(problem, point)
            latest = derivatives = differentiate(problem, elements, unknowns, point.balance)[1]
            secants = _Secants(derivatives)
        step, inflow_step = _step(problem, point, derivatives, secants)
        if step is None:
            break
        step *= min(1.0, float((limits / np.maximum(np.abs(step), 1e-12)).min()))
        fraction = 1.0
        while True:
            state = point.loads.state.moved(unknowns, fraction * step[: len(unknowns)])
            induced = None
            if point.inflow_error is not None:
                induced = inflow_step(fraction * step, fraction)
                induced += point.loads.induced
            elastic = point.loads.elastic + fraction * step[len(unknowns) :].reshape(shape)
            trial = _evaluate(problem, state, induced, elastic, options, whole=expected <= _NEARLY)
            passes += 1
            if trial.size < point.size or not fresh or fraction < 0.2 or passes >= options.max_passes:
                break
            fraction *= 0.5
        secants.taken = fraction * step
        serving = trial.size <= options.kept_ratio * point.size
        if _steps_left(trial.size, point.size) > options.most_old_steps:
            derivatives = None
        expected = trial.size * min(trial.size / point.size, 1.0)
        if trial.size >= point.size and not fresh:
            continue  # The old derivatives do not serve here: take the step again with new ones.
        slow_steps = slow_steps + 1 if trial.size > 0.9 * point.size else 0
        if trial.size < point.size or slow_steps < _MOST_SLOW_STEPS:
            point = trial
    residual, difference = float(np.abs(point.balance.error).max()) / problem.scale, 0.0
    twisting = float(np.abs(point.torsion_error).max()) if problem.torsion is not None else 0.0
    if point.inflow_error is not None:
        difference = float(np.abs(point.inflow_error).max()) / _inflow_scale(problem, point.loads)
    accepted = max(residual, twisting) <= options.accepted_residual and difference <= options.accepted_inflow
    converged = point.size <= 1.0 or accepted
    return TrimResult(_elements(problem, point), residual, converged, passes, derivatives=latest if serving else None)


def _steps_left(size: float, before: float) -> float:
    """How many more steps reach a size of 1, if each leaves the same part of the residual as the last one did."""
    if size <= 1.0:
        return 0.0
    return math.log(size) / math.log(before / size) if size < before else math.inf


def coordinates_of(elements: BladeElements) -> Array:
    """Coordinates of the elastic twist, (modes, functions); empty for a rigid blade."""
    return elements.torsion.coordinates if elements.torsion is not None else np.zeros(0)


def _elements(problem: Problem, point: _Iterate) -> BladeElements:
    """The blade elements of an iterate; their loads have slopes."""
    if point.elements is not None:
        return point.elements
    loads = point.loads
    return evaluate_elements(problem, loads.state, loads.induced, loads.elastic, loads.response)


def _evaluate(
    problem: Problem, state: TrimState, induced: Array | None, elastic: Array, options: SolverOptions, *, whole: bool
) -> _Iterate:
    """whole: with the blade elements, where these will be needed; loads alone take less time."""
    elements = evaluate_elements(problem, state, induced, elastic) if whole else None
    loads = loads_of(problem, elements) if elements is not None else evaluate_loads(problem, state, induced, elastic)
    forces = balance(problem, state, loads.flow, loads.sums)
    size = float(np.abs(forces.error).max()) / (problem.scale * options.residual_tolerance)
    twisting = elastic
    if problem.torsion is not None:
        twisting = torsion_error(problem, state, elastic, loads.modal).ravel()
        size = max(size, float(np.abs(twisting).max()) / options.torsion_tolerance)
    inflow_error = None
    if problem.inflow.load_dependent:
        inflow_error, largest = _difference(loads.response.induced, loads.induced)
        size = max(size, largest / (_inflow_scale(problem, loads) * options.inflow_tolerance))
    return _Iterate(loads, forces, inflow_error, twisting, size if math.isfinite(size) else math.inf, elements)


@compiled()
def _difference(one: Any, other: Any) -> Any:
    """one − other, (elements, azimuths), and its largest size; not a number where the difference is none somewhere."""
    out, largest, total = np.empty_like(one), 0.0, 0.0
    for i in range(len(one)):
        for j in range(one.shape[1]):
            out[i, j] = one[i, j] - other[i, j]
            largest = max(largest, abs(out[i, j]))
            total += out[i, j]
    return out, largest if math.isfinite(total) else math.nan


def _inflow_scale(problem: Problem, loads: TrialLoads) -> float:
    """What differences of inflow are measured by: |λ0|, at least a small part of hover's."""
    return max(abs(loads.flow.lambda0), 0.02 * math.sqrt(problem.scale / 2.0))


def differentiate(
    problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...], forces: Balance | None = None
) -> tuple[Slopes, Derivatives]:
    """Exact derivatives at these elements, of which `forces` is the balance, by trim unknowns and elastic twist."""
    forces = forces if forces is not None else balance_of(problem, elements)
    feedback = inflow_feedback(problem, elements)
    found = slopes(problem, elements, unknowns, feedback)
    matrix, by_terms = full_jacobian(problem, elements, found, forces)
    by_inflow = LoadsByInflow.at(elements)
    return found, Derivatives(
        unknowns, matrix, forces.weights, feedback, found.answer, by_terms, by_inflow, problem.disk.shape
    )


def full_jacobian(
    problem: Problem, elements: BladeElements, by_unknown: Slopes, forces: Balance | None = None
) -> tuple[Array, Array | None]:
    """Derivatives of all equations by all unknowns: those of the trim first, then those of torsion.

    Beside them those by the terms of an inflow that answers the load.
    """
    forces = forces if forces is not None else balance_of(problem, elements)
    matrix = forces.jacobian(by_unknown)
    by_terms = None if by_unknown.by_terms is None else forces.weights @ by_unknown.by_terms
    if problem.torsion is None:
        return matrix, by_terms
    twisting, torsion_by_terms = torsion_slopes(problem, elements, by_unknown)
    matrix = np.vstack([np.hstack([matrix, forces.weights @ by_unknown.torsion_sums]), twisting])
    if by_terms is not None and torsion_by_terms is not None:
        by_terms = np.vstack([by_terms, torsion_by_terms])
    return matrix, by_terms


def inflow_feedback(problem: Problem, elements: BladeElements) -> InflowFeedback | None:
    """The feedback load → inflow → load at these elements; None for a model that does not depend on the load."""
    if not problem.inflow.load_dependent or elements.response is None:
        return None
    return elements.response.feedback(elements.loads[kernel.FZ_UP])


class _Secants:
    """The Jacobian of steps with the same derivatives, corrected by what the steps have shown (Broyden 1965)."""

    def __init__(self, derivatives: Derivatives | None) -> None:
        self.matrix: Array = derivatives.jacobian if derivatives is not None else np.zeros((0, 0))
        self.taken: Array | None = None
        """The last step."""
        self._residual: Array | None = None

    def at(self, residual: Array) -> Array:
        """The Jacobian, given the residual after the last step: the least change by which it agrees with that step.

        Changes of an unknown are measured by what they do to the residual.
        """
        if self.taken is not None and self._residual is not None:
            weighted: Array = self.taken * np.einsum("ij,ij->j", self.matrix, self.matrix)
            missed: Array = residual - self._residual - self.matrix @ self.taken
            length = max(float(self.taken @ weighted), 1e-300)
            self.matrix = self.matrix + missed[:, None] * (weighted / length)
        self._residual = residual
        return self.matrix


def _step(
    problem: Problem, point: _Iterate, derivatives: Derivatives, secants: _Secants
) -> tuple[Array | None, Callable[[Array, float], Array]]:
    """The Newton step of the trim unknowns, and the step of λ_i that goes with a (shortened) step of theirs."""
    error, torsion_error, inflow_change = point.balance.error, point.torsion_error, None
    if point.inflow_error is not None and derivatives.feedback is not None:
        inflow_change = derivatives.feedback.solve(point.inflow_error[None])
        sums, modal = derivatives.by_inflow.change(problem, inflow_change[0])
        error = error + point.balance.weights @ sums
        if problem.torsion is not None:
            twisting = problem.torsion.gain[:, None] * problem.torsion.shapes.analyse(modal)
            torsion_error = torsion_error - twisting.ravel()
    step: Array | None = None
    with suppress(np.linalg.LinAlgError):
        residual = np.concatenate([error, torsion_error])
        step = np.asarray(np.linalg.solve(secants.at(residual), -residual), dtype=np.float64)

    def inflow_step(taken: Array, fraction: float) -> Array:
        assert inflow_change is not None
        assert derivatives.answer is not None
        out = derivatives.answer.field(taken)
        out += inflow_change[0] if fraction == 1.0 else fraction * inflow_change[0]
        return out

    return step, inflow_step


def _prescribed_start(problem: Problem, state: TrimState) -> Array:
    """A first field for a load-dependent model: Pitt–Peters at the same wake."""
    no_load = np.zeros((0, 0))
    return INFLOW_MODELS["pitt-peters"].respond(problem.disk, wake_at(problem, state), no_load).induced
