"""Newton's method on the exact Jacobian, for trim unknowns and induced inflow together."""

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, evaluate_elements, wake_at
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.interface import InflowFeedback
from rotor.aero.sums import Slopes, integrate, slopes
from rotor.aero.trim_state import TrimState, Unknown
from rotor.arrays import Array
from rotor.trim.equations import combine_sums, jacobian, residuals, unknowns_of, with_given_values
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions

_MOST_SLOW_STEPS = 4
"""Steps that hardly reduce the residual before the iteration ends."""


@dataclass(frozen=True, eq=False)
class Guess:
    """Where to start: the trim state, and the induced field for a load-dependent model."""

    state: TrimState
    induced: Array | None = None


@dataclass(frozen=True, eq=False)
class TrimResult:
    """Where Newton's method ended."""

    elements: BladeElements
    residual: float
    """Largest residual over C_W."""
    converged: bool
    passes: int
    """Evaluations of the blade elements."""
    reached: float = 1.0
    """How far continuation from an easier condition came (1: all the way)."""


@dataclass(frozen=True, eq=False)
class _Iterate:
    """The blade elements at a trial state, with the residual of every equation."""

    elements: BladeElements
    error: Array
    inflow_error: Array | None
    """The model's response less the trial field; None for a model that does not depend on the load."""
    size: float
    """Largest residual over its tolerance: at most 1 when all equations are met."""


@dataclass(frozen=True, eq=False)
class _Derivatives:
    """Exact derivatives at an iterate."""

    slopes: Slopes
    jacobian: Array
    feedback: InflowFeedback | None


def newton(problem: Problem, start: Guess, options: SolverOptions = DEFAULT_OPTIONS) -> TrimResult:
    """Newton's method on trim unknowns and inflow together, with a step limit and backtracking.

    Eliminating the inflow by the model's own feedback leaves a system of the trim unknowns only. For a load-dependent
    model the derivatives are kept over several steps, because they cost more than an evaluation.
    """
    unknowns = unknowns_of(problem.design.models)
    limits = np.array([options.inflow_step if name == "lambda0" else options.angle_step for name in unknowns])
    state = with_given_values(problem, start.state)
    induced = start.induced
    if problem.inflow.load_dependent and (induced is None or induced.shape != problem.disk.shape):
        induced = _prescribed_start(problem, state)
    point = _evaluate(problem, state, induced, options)
    passes, slow_steps = 1, 0
    derivatives: _Derivatives | None = None
    while point.size > 1.0 and passes < options.max_passes and slow_steps < _MOST_SLOW_STEPS:
        fresh = derivatives is None
        if derivatives is None:
            derivatives = _differentiate(problem, point.elements, unknowns)
        step, inflow_step = _step(problem, point, derivatives)
        if step is None:
            break
        step *= min(1.0, float((limits / np.maximum(np.abs(step), 1e-12)).min()))
        fraction = 1.0
        while True:
            state = point.elements.state.moved(unknowns, fraction * step)
            induced = None
            if point.inflow_error is not None:
                induced = point.elements.induced + fraction * inflow_step(step)
            trial = _evaluate(problem, state, induced, options)
            passes += 1
            if trial.size < point.size or not fresh or fraction < 0.2 or passes >= options.max_passes:
                break
            fraction *= 0.5
        if trial.size > options.refresh_ratio * point.size or not problem.inflow.load_dependent:
            derivatives = None
        if trial.size >= point.size and not fresh:
            continue  # The old derivatives do not serve here: take the step again with new ones.
        slow_steps = slow_steps + 1 if trial.size > 0.9 * point.size else 0
        if trial.size < point.size or slow_steps < _MOST_SLOW_STEPS:
            point = trial
    residual, difference = float(np.abs(point.error).max()) / problem.weight, 0.0
    if point.inflow_error is not None:
        difference = float(np.abs(point.inflow_error).max()) / abs(point.elements.flow.lambda0)
    accepted = residual <= options.accepted_residual and difference <= options.accepted_inflow
    return TrimResult(point.elements, residual, point.size <= 1.0 or accepted, passes)


def _evaluate(problem: Problem, state: TrimState, induced: Array | None, options: SolverOptions) -> _Iterate:
    elements = evaluate_elements(problem, state, induced)
    error = residuals(problem, elements)
    size = float(np.abs(error).max()) / (problem.weight * options.residual_tolerance)
    inflow_error = None
    if problem.inflow.load_dependent and elements.response is not None:
        inflow_error = elements.response.induced - elements.induced
        tolerance = abs(elements.flow.lambda0) * options.inflow_tolerance
        size = max(size, float(np.abs(inflow_error).max()) / tolerance)
    return _Iterate(elements, error, inflow_error, size if math.isfinite(size) else math.inf)


def _differentiate(problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...]) -> _Derivatives:
    feedback = inflow_feedback(problem, elements)
    by_unknown = slopes(problem, elements, unknowns, feedback)
    return _Derivatives(by_unknown, jacobian(problem, elements, by_unknown), feedback)


def inflow_feedback(problem: Problem, elements: BladeElements) -> InflowFeedback | None:
    """The feedback load → inflow → load at these elements; None for a model that does not depend on the load."""
    if not problem.inflow.load_dependent or elements.response is None:
        return None
    return elements.response.feedback(elements.loads[kernel.FZ_UP])


def _step(
    problem: Problem, point: _Iterate, derivatives: _Derivatives
) -> tuple[Array | None, Callable[[Array], Array]]:
    """The Newton step of the trim unknowns, and the step of λ_i that goes with a (shortened) step of theirs."""
    error, inflow_change = point.error, None
    if point.inflow_error is not None and derivatives.feedback is not None:
        inflow_change = derivatives.feedback.solve(point.inflow_error[None])
        loads = point.elements.loads
        change = integrate(
            problem, point.elements, loads[kernel.FZ_UP] * inflow_change, loads[kernel.FX_UP] * inflow_change
        )
        error = error + combine_sums(problem, point.elements, change)[:, 0]
    step: Array | None = None
    with suppress(np.linalg.LinAlgError):
        step = np.asarray(np.linalg.solve(derivatives.jacobian, -error), dtype=np.float64)

    def inflow_step(taken: Array) -> Array:
        assert inflow_change is not None
        assert derivatives.slopes.inflow is not None
        return inflow_change[0] + np.tensordot(taken, derivatives.slopes.inflow, axes=1)

    return step, inflow_step


def _prescribed_start(problem: Problem, state: TrimState) -> Array:
    """A first field for a load-dependent model: Pitt–Peters at the same wake."""
    no_load = np.zeros((0, 0))
    return INFLOW_MODELS["pitt-peters"].respond(problem.disk, wake_at(problem, state), no_load).induced
