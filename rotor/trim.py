"""Trim in forward flight: Newton's method on the exact Jacobian, warm-started, with continuation when that fails.

`propulsive` (flight preset): collective, cyclic, shaft tilt and coning so that the vertical force carries the weight,
the forward force the drag, and the first-harmonic flapping is as wanted. `thrust` (thesis preset): collective and free
flapping so that the thrust is the resultant of weight and drag; no cyclic. Both: λ0 closes eq. (2.30) with the axial
flow of the tilted disk.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotor.design import Design
from rotor.elements import (
    COLLECTIVE,
    CONING,
    CYCLIC_1C,
    CYCLIC_1S,
    FLAP_1C,
    FLAP_1S,
    LAMBDA0,
    N_STATE,
    SHAFT_TILT,
    Pass,
    Problem,
    lay_out,
    run_pass,
    sums,
    sums_jacobian,
)
from rotor.momentum import glauert_inflow

Array = NDArray[np.float64]

UNKNOWNS: dict[str, tuple[int, ...]] = {
    "propulsive": (COLLECTIVE, SHAFT_TILT, CONING, CYCLIC_1C, CYCLIC_1S, LAMBDA0),
    "thrust": (COLLECTIVE, CONING, FLAP_1C, FLAP_1S, LAMBDA0),
}
"""Which state entries each trim solves for."""

TOLERANCE = 1e-10
"""Largest accepted residual as a fraction of C_W; keeps the energy identity to 1e-9."""
MAX_PASSES = 30
_STEP_LIMIT = np.array([0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.02])
"""Largest Newton step per state entry [rad; λ0 over ΩR]: beyond it the section slopes no longer hold."""
_CONTINUATION_STEPS = 40
_SMALLEST_STEP = 1.0 / 128.0


@dataclass(frozen=True, eq=False)
class TrimResult:
    """Where Newton's method ended."""

    last: Pass
    residual: float
    """Largest residual over C_W."""
    passes: int
    reached: float = 1.0
    """How far continuation from an easier condition came (1: all the way)."""

    @property
    def converged(self) -> bool:
        return self.residual <= TOLERANCE


def trim(problem: Problem, start: Array | None = None) -> TrimResult:
    """Trim a forward-flight problem from a state vector, or from simple estimates.

    Tries the warm start, then a cold start, then continuation from a lighter, slower rotor.
    """
    passes = 0
    best: TrimResult | None = None
    for state in (start, first_guess(problem)):
        if state is None:
            continue
        result = newton(problem, state)
        passes += result.passes
        if result.converged:
            return replace(result, passes=passes)
        best = result if best is None or result.residual < best.residual else best
    assert best is not None
    return _continue(problem, best, passes)


def first_guess(problem: Problem) -> Array:
    """A state from momentum theory and mean blade angles."""
    design = problem.design
    mu = design.condition.advance_ratio
    weight, drag = problem.weight, problem.drag
    tilt = math.atan2(drag, weight)
    ct = math.hypot(weight, drag)
    lambda0, _ = glauert_inflow(ct, mu * math.cos(tilt), mu * math.sin(tilt))
    solidity = design.rotor.solidity
    state = np.zeros(N_STATE)
    # C_T = ½σa(θ(1 + 3/2 µ²)/3 − λ/2) for an untwisted blade, a near 2π·0.95.
    inflow = lambda0 + mu * math.sin(tilt)
    state[COLLECTIVE] = 3.0 * (2.0 * ct / (solidity * 5.9) + 0.5 * inflow) / (1.0 + 1.5 * mu**2)
    state[SHAFT_TILT] = tilt
    state[CONING] = problem.flap.load_gain * 0.7 * ct - problem.flap.weight
    state[LAMBDA0] = lambda0
    if design.models.trim == "propulsive":
        state[CYCLIC_1S] = -8.0 / 3.0 * mu * state[COLLECTIVE]
        state[CYCLIC_1C] = 4.0 / 3.0 * mu * state[CONING]
        state[FLAP_1C] = design.condition.flap_1c
        state[FLAP_1S] = design.condition.flap_1s
    else:
        state[FLAP_1C] = -8.0 / 3.0 * mu * state[COLLECTIVE]
        state[FLAP_1S] = -4.0 / 3.0 * mu * state[CONING]
    return state


def newton(problem: Problem, start: Array, max_passes: int = MAX_PASSES) -> TrimResult:
    """Newton's method with a step limit and backtracking on the largest residual."""
    unknowns = UNKNOWNS[problem.design.models.trim]
    state = _with_givens(problem, start)
    one = run_pass(problem, state)
    error = residuals(problem, one)
    size = _size(problem, error)
    passes = 1
    stalled = 0
    while size > TOLERANCE and passes < max_passes and stalled < 4:
        try:
            step = np.linalg.solve(jacobian(problem, one, unknowns), -error)
        except np.linalg.LinAlgError:
            break
        step *= min(1.0, float((_STEP_LIMIT[list(unknowns)] / np.maximum(np.abs(step), 1e-12)).min()))
        fraction = 1.0
        while True:
            trial_state = state.copy()
            trial_state[list(unknowns)] += fraction * step
            trial = run_pass(problem, trial_state)
            trial_error = residuals(problem, trial)
            trial_size = _size(problem, trial_error)
            passes += 1
            if trial_size < size or fraction < 0.2 or passes >= max_passes:
                break
            fraction *= 0.5
        stalled = stalled + 1 if trial_size > 0.9 * size else 0
        if trial_size >= size and stalled >= 4:
            break
        state, one, error, size = trial_state, trial, trial_error, trial_size
    return TrimResult(one, size, passes)


def residuals(problem: Problem, one: Pass) -> Array:
    """What is left of each trim equation, in units of C_T, in the order of the unknowns."""
    total = sums(problem, one)
    state, flap = one.state, problem.flap
    spring = flap.frequency_squared
    flapping = [
        total.moment[0] - (flap.weight + spring * state[CONING]) / flap.load_gain,
        total.moment[1] - (spring - 1.0) * state[FLAP_1C] / flap.load_gain,
        total.moment[2] - (spring - 1.0) * state[FLAP_1S] / flap.load_gain,
    ]
    momentum = 2.0 * one.flow.lambda0 * one.flow.speed - total.thrust
    if problem.design.models.trim == "propulsive":
        cos, sin = math.cos(state[SHAFT_TILT]), math.sin(state[SHAFT_TILT])
        vertical = total.thrust * cos + total.drag * sin - problem.weight
        forward = total.thrust * sin - total.drag * cos - problem.drag
        return np.array([vertical, forward, *flapping, momentum])
    return np.array([total.thrust - math.hypot(problem.weight, problem.drag), *flapping, momentum])


def jacobian(problem: Problem, one: Pass, unknowns: tuple[int, ...]) -> Array:
    """Exact derivatives of `residuals` by the unknowns, (residuals, unknowns)."""
    thrust, drag, *moments = sums_jacobian(problem, one, unknowns)
    state, flap, flow = one.state, problem.flap, one.flow
    spring = flap.frequency_squared
    place = {unknown: k for k, unknown in enumerate(unknowns)}
    for row, (entry, stiffness) in enumerate(((CONING, spring), (FLAP_1C, spring - 1.0), (FLAP_1S, spring - 1.0))):
        if entry in place:
            moments[row][place[entry]] -= stiffness / flap.load_gain
    momentum = -thrust
    # d(2λ0 V): V = √(µ_x² + (µ_z + λ0)²), and by the tilt ∂V = µ_x (λ0)/V since µ_x dµ_x + µ_z dµ_z = 0.
    momentum[place[LAMBDA0]] += 2.0 * (flow.speed + flow.lambda0 * flow.axial / flow.speed)
    if SHAFT_TILT not in place:
        return np.stack([thrust, *moments, momentum])
    tilt = place[SHAFT_TILT]
    if problem.design.models.disk_axial_flow:
        momentum[tilt] += 2.0 * flow.lambda0**2 * flow.mu_x / flow.speed
    cos, sin = math.cos(state[SHAFT_TILT]), math.sin(state[SHAFT_TILT])
    vertical = thrust * cos + drag * sin
    forward = thrust * sin - drag * cos
    total = sums(problem, one)
    vertical[tilt] += -total.thrust * sin + total.drag * cos
    forward[tilt] += total.thrust * cos + total.drag * sin
    return np.stack([vertical, forward, *moments, momentum])


def _with_givens(problem: Problem, start: Array) -> Array:
    """The start with every entry that is not solved for at its given value."""
    state = start.copy()
    condition = problem.design.condition
    if problem.design.models.trim == "propulsive":
        state[FLAP_1C], state[FLAP_1S] = condition.flap_1c, condition.flap_1s
    else:
        state[CYCLIC_1C] = state[CYCLIC_1S] = 0.0
        state[SHAFT_TILT] = math.atan2(problem.drag, problem.weight)
    state[LAMBDA0] = max(state[LAMBDA0], 1e-4)
    return state


def _size(problem: Problem, error: Array) -> float:
    size = float(np.abs(error).max()) / problem.weight
    return size if math.isfinite(size) else math.inf


def _easier(design: Design, t: float) -> Design:
    """The design on the way from a light rotor at moderate speed (t = 0) to the wanted condition (t = 1)."""
    condition = design.condition
    speed = condition.advance_ratio
    easy_speed = min(max(speed, 0.08), 0.2)
    easy_mass = min(condition.mass, 0.045 * condition.mass / max(_blade_loading(design), 1e-9))
    return replace(
        design,
        condition=replace(
            condition,
            advance_ratio=easy_speed + t * (speed - easy_speed),
            mass=easy_mass + t * (condition.mass - easy_mass),
        ),
    )


def _blade_loading(design: Design) -> float:
    return design.weight_coefficient / design.rotor.solidity


def _continue(problem: Problem, best: TrimResult, passes: int) -> TrimResult:
    """Follow the trim from an easier condition in adaptive steps; say how far it came when the trim ends on the way."""
    design = problem.design
    easy = lay_out(_easier(design, 0.0))
    result = newton(easy, first_guess(easy))
    passes += result.passes
    if not result.converged:
        return replace(best, passes=passes, reached=0.0)
    t, step, previous = 0.0, 0.25, None
    state = result.last.state
    for _ in range(_CONTINUATION_STEPS):
        if t >= 1.0 or step < _SMALLEST_STEP:
            break
        ahead = min(1.0, t + step)
        near = problem if ahead == 1.0 else lay_out(_easier(design, ahead))
        guess = state if previous is None else state + (state - previous[1]) * (ahead - t) / (t - previous[0])
        result = newton(near, guess)
        passes += result.passes
        if result.converged:
            previous, t, state = (t, state), ahead, result.last.state
            step *= 1.7
        else:
            step *= 0.4
    if t >= 1.0:
        return replace(result, passes=passes)
    # The last state that did trim, shown at the wanted condition, is the honest picture of how far it got.
    return replace(best, passes=passes, reached=t)
