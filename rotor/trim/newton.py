"""Newton's method on the exact Jacobian, for trim unknowns and induced inflow together."""

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import Pass, Problem, run_pass, skewed
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.interface import InflowFeedback
from rotor.aero.sums import Slopes, slopes, weigh
from rotor.arrays import Array
from rotor.trim.equations import combine_sums, jacobian, residuals, unknowns_of, with_givens

TOLERANCE = 1e-10
"""Largest accepted residual as a fraction of C_W; keeps the energy identity to 1e-9."""
INFLOW_TOLERANCE = 1e-8
"""Largest accepted distance of λ_i from what the model answers, as a fraction of λ0."""
ACCEPTED, INFLOW_ACCEPTED = 1e-7, 1e-3
"""The same two where Newton's method gets no further: the slopes of measured-looking stall jump from knot to knot, and
an element at the root that sits on such a jump can keep the last digits of its own inflow from settling. Power then
closes to 1e-6 all the same."""
MAX_PASSES = 40
_REFRESH = 0.15
"""Derivatives are made anew when a step with old ones leaves more than this part of the residual."""
_STEP_LIMIT = np.array([0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.02])
"""Largest Newton step per state entry [rad; λ0 over ΩR]: beyond it the section slopes no longer hold."""


@dataclass(frozen=True, eq=False)
class Guess:
    """Where to start: trim unknowns, and the induced field for a load-dependent model."""

    state: Array
    induced: Array | None = None


@dataclass(frozen=True, eq=False)
class TrimResult:
    """Where Newton's method ended."""

    last: Pass
    residual: float
    """Largest residual over C_W."""
    converged: bool
    passes: int
    reached: float = 1.0
    """How far continuation from an easier condition came (1: all the way)."""


@dataclass(frozen=True, eq=False)
class _Point:
    """A pass with what is left of every equation."""

    one: Pass
    error: Array
    gap: Array | None
    """What the model answers less what was tried; None for a model that does not react."""
    size: float
    """1 where all equations are met as well as wanted."""


@dataclass(frozen=True, eq=False)
class _Linearised:
    """A pass's exact derivatives; kept while they serve."""

    slopes: Slopes
    jacobian: Array
    loop: InflowFeedback | None


def newton(problem: Problem, start: Guess, max_passes: int = MAX_PASSES) -> TrimResult:
    """Newton's method on trim unknowns and inflow together, with a step limit and backtracking.

    Eliminating the inflow by the model's own loop leaves a system of the trim unknowns only. For a load-dependent model
    the derivatives are kept over several steps, because they cost more than a pass.
    """
    unknowns = list(unknowns_of(problem.design.models))
    state = with_givens(problem, start.state)
    induced = start.induced
    if problem.inflow.load_dependent and (induced is None or induced.shape != problem.disk.shape):
        induced = _prescribed_start(problem, state)
    point = _evaluate(problem, state, induced)
    passes, poor = 1, 0
    kept: _Linearised | None = None
    while point.size > 1.0 and passes < max_passes and poor < 4:
        fresh = kept is None
        if kept is None:
            kept = _linearise(problem, point.one, tuple(unknowns))
        step, inflow_step = _step(problem, point, kept)
        if step is None:
            break
        step *= min(1.0, float((_STEP_LIMIT[unknowns] / np.maximum(np.abs(step), 1e-12)).min()))
        fraction = 1.0
        while True:
            trial_state = point.one.state.copy()
            trial_state[unknowns] += fraction * step
            moved = None if point.gap is None else point.one.induced + fraction * inflow_step(step)
            trial = _evaluate(problem, trial_state, moved)
            passes += 1
            if trial.size < point.size or not fresh or fraction < 0.2 or passes >= max_passes:
                break
            fraction *= 0.5
        if trial.size > _REFRESH * point.size or not problem.inflow.load_dependent:
            kept = None
        if trial.size >= point.size and not fresh:
            continue  # Old derivatives led astray: try again from here with new ones.
        poor = poor + 1 if trial.size > 0.9 * point.size else 0
        if trial.size < point.size or poor < 4:
            point = trial
    residual = float(np.abs(point.error).max()) / problem.weight
    gap = 0.0 if point.gap is None else float(np.abs(point.gap).max()) / abs(point.one.flow.lambda0)
    settled = point.size <= 1.0 or (residual <= ACCEPTED and gap <= INFLOW_ACCEPTED)
    return TrimResult(point.one, residual, settled, passes)


def _evaluate(problem: Problem, state: Array, induced: Array | None) -> _Point:
    one = run_pass(problem, state, induced)
    error = residuals(problem, one)
    size = float(np.abs(error).max()) / (problem.weight * TOLERANCE)
    gap = None
    if problem.inflow.load_dependent and one.response is not None:
        gap = one.response.induced - one.induced
        size = max(size, float(np.abs(gap).max()) / (abs(one.flow.lambda0) * INFLOW_TOLERANCE))
    return _Point(one, error, gap, size if math.isfinite(size) else math.inf)


def _linearise(problem: Problem, one: Pass, unknowns: tuple[int, ...]) -> _Linearised:
    loop = None
    if problem.inflow.load_dependent and one.response is not None:
        loop = one.response.feedback(one.loads[kernel.FZ_UP])
    made = slopes(problem, one, unknowns, loop)
    return _Linearised(made, jacobian(problem, one, made), loop)


def _step(problem: Problem, point: _Point, kept: _Linearised) -> tuple[Array | None, Callable[[Array], Array]]:
    """The Newton step of the trim unknowns, and the step of λ_i that goes with a (shortened) step of theirs."""
    error, answer = point.error, None
    if point.gap is not None and kept.loop is not None:
        answer = kept.loop.solve(point.gap[None])
        loads = point.one.loads
        shift = weigh(problem, point.one, loads[kernel.FZ_UP] * answer, loads[kernel.FX_UP] * answer)
        error = error + combine_sums(problem, point.one, shift)[:, 0]
    step: Array | None = None
    with suppress(np.linalg.LinAlgError):
        step = np.asarray(np.linalg.solve(kept.jacobian, -error), dtype=np.float64)

    def inflow_step(taken: Array) -> Array:
        assert answer is not None
        assert kept.slopes.inflow is not None
        return answer[0] + np.tensordot(taken, kept.slopes.inflow, axes=1)

    return step, inflow_step


def _prescribed_start(problem: Problem, state: Array) -> Array:
    """A first field for a load-dependent model: Pitt–Peters at the same wake."""
    nothing = np.zeros((0, 0))
    return INFLOW_MODELS["pitt-peters"].respond(problem.disk, skewed(problem, state), nothing).induced
