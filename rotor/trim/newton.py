"""Newton's method on the exact Jacobian, for trim unknowns, elastic twist and induced inflow together.

The derivatives of the last few trims are kept. A trim that starts from one of them takes its first steps with these,
which are nearly its own after the step of a slider, and the gradient of power needs the same ones. The residual has to
meet the same tolerance, whatever the derivatives of the steps.
"""

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.linalg.lapack import dgesv

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, evaluate_elements, wake_at
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.interface import InflowColumns, InflowFeedback
from rotor.aero.sums import Slopes, slopes
from rotor.aero.torsion_balance import torsion_error, torsion_slopes
from rotor.aero.trial_loads import TrialLoads, evaluate_loads, loads_of
from rotor.aero.trim_state import TrimState, Unknown
from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.trim.equations import Balance, balance, balance_of, unknowns_of, with_given_values
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions

_NEAR = 1e6
"""Residual over its tolerance to which a trim is solved on few azimuths. Our choice."""
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
    feedback: InflowFeedback | None
    answer: InflowColumns | None
    """∂λ_i by the unknowns and the elastic coordinates; None for a model that does not depend on the load."""
    by_terms: Array | None
    """Of these equations by the coordinates of an inflow that answers the load, (equations + columns, coordinates)."""

    def serve(self, problem: Problem, unknowns: tuple[Unknown, ...]) -> bool:
        """Whether steps can be made with them: whether they are for these unknowns and coordinates."""
        size = problem.inflow_basis.size if problem.inflow.load_dependent else 0
        return (
            self.unknowns == unknowns
            and len(self.jacobian) == len(unknowns) + problem.given_torsion.size
            and size == (self.by_terms.shape[1] if self.by_terms is not None else 0)
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
    inflow: Array
    """Coordinates of the trial's inflow; none of a model that does not depend on the load."""
    balance: Balance
    inflow_error: Array
    """Those of the model's response less these."""
    largest_error: float
    """Bound of the field that has the coordinates `inflow_error`."""
    torsion_error: Array
    """Residual of the torsion equations [rad], (columns,); none for a rigid blade."""
    size: float
    """Largest residual over its tolerance: at most 1 when all equations are met."""
    elements: BladeElements | None
    """None where only the loads were evaluated."""


def newton(problem: Problem, start: Guess, options: SolverOptions = DEFAULT_OPTIONS) -> TrimResult:
    """Newton's method on trim unknowns, elastic twist and inflow together, with a step limit and backtracking.

    Eliminating the inflow by the model's own feedback leaves a system of the trim unknowns and, for an elastic blade,
    its torsion coordinates. Unknowns, elastic coordinates and coordinates of the inflow mean the same on every grid, so
    derivatives are evaluated on few azimuths, and a start without derivatives is trimmed there first. The derivatives
    are kept over several steps; the first steps are made with those of the start, if it has any.
    """
    unknowns = unknowns_of(problem.design)
    shape = problem.given_torsion.shape
    elastic = start.elastic if start.elastic is not None and start.elastic.shape == shape else np.zeros(shape)
    state, inflow = with_given_values(problem, start.state), np.zeros(0)
    if problem.inflow.load_dependent:
        induced = start.induced
        if induced is None or induced.shape != problem.disk.shape:
            induced = _prescribed_start(problem, state)
        inflow = problem.inflow_basis.nearest(induced, wake_at(problem, state))
    derivatives = start.derivatives
    if derivatives is not None and not derivatives.serve(problem, unknowns):
        derivatives = None
    iteration = _Iteration(problem, unknowns, derivatives, options)
    if derivatives is None and problem.thinned is not problem and options.max_passes > 1:
        near = iteration.run(problem.thinned, state, inflow, elastic, _NEAR)
        if near.size <= _NEAR:
            state, inflow, elastic = near.loads.state, near.inflow, near.loads.elastic
        else:  # Whether there is a trim is for all azimuths to say, from the same start.
            iteration = _Iteration(problem, unknowns, None, options, iteration.passes)
    point = iteration.run(problem, state, inflow, elastic, 1.0)
    residual, difference = float(np.abs(point.balance.error).max()) / problem.scale, 0.0
    twisting = float(np.abs(point.torsion_error).max()) if problem.torsion is not None else 0.0
    if len(point.inflow_error) > 0:
        difference = point.largest_error / _inflow_scale(problem, point.loads)
    accepted = max(residual, twisting) <= options.accepted_residual and difference <= options.accepted_inflow
    converged = point.size <= 1.0 or accepted
    return TrimResult(
        _elements(problem, point), residual, converged, iteration.passes, derivatives=iteration.serving_derivatives
    )


class _Iteration:
    """The steps of one run of Newton's method, on few azimuths first and then on all."""

    def __init__(
        self,
        problem: Problem,
        unknowns: tuple[Unknown, ...],
        derivatives: Derivatives | None,
        options: SolverOptions,
        passes: int = 0,
    ) -> None:
        self.passes = passes
        """Evaluations of the blade elements, on few azimuths or on all."""
        limits = [options.inflow_step if name == "lambda0" else options.angle_step for name in unknowns]
        self._limits = np.array(limits + [options.angle_step] * problem.given_torsion.size)
        self._problem, self._unknowns, self._options = problem, unknowns, options
        self._derivatives = self._latest = derivatives
        self._secants = _Secants(derivatives)
        self._serving = False

    @property
    def _thin(self) -> Problem:
        """Where derivatives are evaluated."""
        return self._problem.thinned

    @property
    def serving_derivatives(self) -> Derivatives | None:
        """Those of the last step, if it left little of the residual."""
        return self._latest if self._serving else None

    def run(self, problem: Problem, state: TrimState, inflow: Array, elastic: Array, goal: float) -> _Iterate:
        """Steps until the residual is within `goal` times the tolerance, or no more progress is made."""
        options, slow_steps, expected = self._options, 0, math.inf
        most_old_steps = options.most_old_steps
        if goal > 1.0:  # Of a prescribed inflow derivatives cost no more than a step.
            most_old_steps = options.most_old_steps_of_start if problem.inflow.load_dependent else 0.0
        self._secants.begin()
        point = _evaluate(problem, state, inflow, elastic, options, whole=self._at_these(problem))
        self.passes += 1
        while point.size > goal and self.passes < options.max_passes and slow_steps < _MOST_SLOW_STEPS:
            fresh = self._derivatives is None
            derivatives = self._derivatives or self._differentiate(problem, point)
            step, inflow_step = _step(point, derivatives, self._secants)
            if step is None:
                break
            step = _within(step, self._limits)
            trial, fraction = self._taken(problem, point, step, inflow_step(step), 1.0, expected), 1.0
            while fresh and trial.size >= point.size and fraction >= 0.2 and self.passes < options.max_passes:
                fraction *= 0.5
                trial = self._taken(problem, point, step, inflow_step(step), fraction, expected)
            self._secants.taken = fraction * step
            self._serving = trial.size <= options.kept_ratio * point.size
            if _steps_left(trial.size, point.size, goal) > most_old_steps:
                self._derivatives = None
            expected = trial.size * min(trial.size / point.size, 1.0)
            if trial.size >= point.size and not fresh:
                continue  # The old derivatives do not serve here: take the step again with new ones.
            slow_steps = slow_steps + 1 if trial.size > 0.9 * point.size else 0
            if trial.size < point.size or slow_steps < _MOST_SLOW_STEPS:
                point = trial
        return point

    def _at_these(self, problem: Problem) -> bool:
        """Whether derivatives are evaluated next, at the blade elements of this problem."""
        return self._derivatives is None and problem is self._thin

    def _taken(
        self, problem: Problem, point: _Iterate, step: Array, inflow_step: Array, fraction: float, expected: float
    ) -> _Iterate:
        """The iterate a fraction of a step on."""
        self.passes += 1
        loads, count = point.loads, len(self._unknowns)
        return _evaluate(
            problem,
            loads.state.moved(self._unknowns, fraction * step[:count]),
            point.inflow + fraction * inflow_step,
            loads.elastic + fraction * step[count:].reshape(loads.elastic.shape),
            self._options,
            whole=expected <= _NEARLY,
        )

    def _differentiate(self, problem: Problem, point: _Iterate) -> Derivatives:
        """New derivatives, on few azimuths, at an iterate."""
        if self._options.pause is not None:
            self._options.pause()
        thin, loads, forces = self._thin, point.loads, point.balance if problem is self._thin else None
        elements = (
            _elements(thin, point)
            if forces is not None
            else evaluate_elements(thin, loads.state, _field(thin, loads.state, point.inflow), loads.elastic)
        )
        found = differentiate(thin, elements, self._unknowns, forces)[1]
        self._derivatives = self._latest = found
        self._secants = _Secants(found)
        return found


def _steps_left(size: float, before: float, goal: float) -> float:
    """How many more steps reach the goal, if each leaves the same part of the residual as the last one did."""
    if size <= goal:
        return 0.0
    return math.log(size / goal) / math.log(before / size) if size < before else math.inf


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
    problem: Problem, state: TrimState, inflow: Array, elastic: Array, options: SolverOptions, *, whole: bool
) -> _Iterate:
    """whole: with the blade elements, where these will be needed; loads alone take less time."""
    induced = _field(problem, state, inflow)
    elements = evaluate_elements(problem, state, induced, elastic) if whole else None
    loads = loads_of(problem, elements) if elements is not None else evaluate_loads(problem, state, induced, elastic)
    forces = balance(problem, state, loads.flow, loads.sums)
    size = _largest(forces.error) / (problem.scale * options.residual_tolerance)
    twisting = elastic
    if problem.torsion is not None:
        twisting = torsion_error(problem, state, elastic, loads.modal).ravel()
        size = max(size, _largest(twisting) / options.torsion_tolerance)
    inflow_error, largest = inflow, 0.0
    if problem.inflow.load_dependent:
        inflow_error = loads.response.coordinates - inflow
        largest = problem.inflow_basis.bound(inflow_error)
        size = max(size, largest / (_inflow_scale(problem, loads) * options.inflow_tolerance))
    size = size if math.isfinite(size) else math.inf
    return _Iterate(loads, inflow, forces, inflow_error, largest, twisting, size, elements)


def _field(problem: Problem, state: TrimState, inflow: Array) -> Array | None:
    """λ_i of coordinates; None for a model that does not depend on the load."""
    if not problem.inflow.load_dependent:
        return None
    return problem.inflow_basis.field(inflow, wake_at(problem, state))


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
    if by_terms is not None:  # Without what no term can hold.
        by_terms = np.ascontiguousarray(by_terms[:, : problem.inflow_basis.size])
    return found, Derivatives(unknowns, matrix, feedback, found.answer, by_terms)


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

    def begin(self) -> None:
        """Forget the last step, for steps from elsewhere."""
        self.taken = self._residual = None

    def at(self, residual: Array) -> Array:
        """The Jacobian, given the residual after the last step: the least change by which it agrees with that step.

        Changes of an unknown are measured by what they do to the residual.
        """
        if self.taken is not None and self._residual is not None:
            self.matrix = _corrected(self.matrix, self.taken, residual - self._residual)
        self._residual = residual
        return self.matrix


@compiled(error_model="numpy")
def _corrected(matrix: Any, step: Any, change: Any) -> Any:
    """The matrix nearest to this one by which a step changes the residual as it did."""
    missed, weighted, length = change - matrix @ step, np.zeros(len(step)), 1e-300
    for j in range(len(step)):
        for i in range(len(matrix)):
            weighted[j] += matrix[i, j] * matrix[i, j] * step[j]
        length += weighted[j] * step[j]
    out = np.empty_like(matrix)
    for i in range(len(matrix)):
        for j in range(len(step)):
            out[i, j] = matrix[i, j] + missed[i] * weighted[j] / length
    return out


@compiled(error_model="numpy")
def _within(step: Any, limits: Any) -> Any:
    """The step, shortened where an unknown would move by more than its limit."""
    share = 1.0
    for k in range(len(step)):
        share = min(share, limits[k] / max(abs(step[k]), 1e-12))
    return share * step


@compiled(error_model="numpy")
def _largest(values: Any) -> float:
    """The largest size; not a number where one value is none."""
    largest, total = 0.0, 0.0
    for value in values:
        largest = max(largest, abs(value))
        total += value
    return largest if math.isfinite(total) else math.nan


def _step(
    point: _Iterate, derivatives: Derivatives, secants: _Secants
) -> tuple[Array | None, Callable[[Array], Array]]:
    """The Newton step of unknowns and elastic coordinates, and the step of the inflow that goes with one of theirs."""
    residual, answer = np.concatenate([point.balance.error, point.torsion_error]), derivatives.answer
    settled = point.inflow_error
    if answer is not None and derivatives.by_terms is not None:
        settled = answer.solve(settled)
        residual += derivatives.by_terms @ settled
    _, _, step, singular = dgesv(secants.at(residual), -residual)
    return None if singular else step, lambda taken: settled if answer is None else settled + answer.change(taken)


def _prescribed_start(problem: Problem, state: TrimState) -> Array:
    """A first field for a load-dependent model: Pitt–Peters at the same wake."""
    no_load = np.zeros((0, 0))
    return INFLOW_MODELS["pitt-peters"].respond(problem.disk, wake_at(problem, state), no_load).induced
