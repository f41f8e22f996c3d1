"""Trim in forward flight: warm start, cold start, then continuation from an easier condition."""

import math
from dataclasses import replace

import numpy as np

from rotor.aero.elements import (
    COLLECTIVE,
    CONING,
    CYCLIC_1C,
    CYCLIC_1S,
    FLAP_1C,
    FLAP_1S,
    LAMBDA0,
    N_STATE,
    SHAFT_TILT,
    Problem,
    expected_wake,
    lay_out,
)
from rotor.design.design import Design
from rotor.trim.newton import Guess, TrimResult, newton
from rotor.trim.solution import Solution

_CONTINUATION_STEPS = 40
_SMALLEST_STEP = 1.0 / 128.0


def trim(problem: Problem, start: Guess | None = None) -> TrimResult:
    """Trim a forward-flight problem from a guess, or from simple estimates.

    Tries the warm start, then a cold start, then continuation from a lighter, slower rotor.
    """
    passes = 0
    best: TrimResult | None = None
    for guess in (start, first_guess(problem)):
        if guess is None:
            continue
        result = newton(problem, guess)
        passes += result.passes
        if result.converged:
            return replace(result, passes=passes)
        best = result if best is None or result.residual < best.residual else best
    assert best is not None
    return _continue(problem, best, passes)


def first_guess(problem: Problem) -> Guess:
    """A state from momentum theory and mean blade angles."""
    design = problem.design
    mu = design.condition.advance_ratio
    tilt = math.atan2(problem.drag, problem.weight)
    ct = math.hypot(problem.weight, problem.drag)
    wake = expected_wake(design, problem.drag)
    solidity = design.rotor.solidity
    state = np.zeros(N_STATE)
    # C_T = ½σa(θ(1 + 3/2 µ²)/3 − λ/2) for an untwisted blade, a near 2π·0.95.
    state[COLLECTIVE] = 3.0 * (2.0 * ct / (solidity * 5.9) + 0.5 * wake.axial) / (1.0 + 1.5 * mu**2)
    state[SHAFT_TILT] = tilt
    state[CONING] = problem.flap.load_gain * 0.7 * ct - problem.flap.weight
    state[LAMBDA0] = wake.lambda0
    if design.models.trim == "propulsive":
        state[CYCLIC_1S] = -8.0 / 3.0 * mu * state[COLLECTIVE]
        state[CYCLIC_1C] = 4.0 / 3.0 * mu * state[CONING]
        state[FLAP_1C] = design.condition.flap_1c
        state[FLAP_1S] = design.condition.flap_1s
    else:
        state[FLAP_1C] = -8.0 / 3.0 * mu * state[COLLECTIVE]
        state[FLAP_1S] = -4.0 / 3.0 * mu * state[CONING]
    return Guess(state)


def guess_of(earlier: Solution) -> Guess:
    """Where an earlier forward-flight solution ended, as a start."""
    controls = earlier.controls
    state = np.empty(N_STATE)
    state[COLLECTIVE], state[CYCLIC_1C], state[CYCLIC_1S] = controls.collective, controls.cyclic_1c, controls.cyclic_1s
    state[SHAFT_TILT], state[CONING] = controls.shaft_tilt, controls.coning
    state[FLAP_1C], state[FLAP_1S], state[LAMBDA0] = controls.flap_1c, controls.flap_1s, controls.lambda0
    return Guess(state, earlier.disk.induced)


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
    t, step = 0.0, 0.25
    reached, before = (0.0, result.last), None
    for _ in range(_CONTINUATION_STEPS):
        if t >= 1.0 or step < _SMALLEST_STEP:
            break
        ahead = min(1.0, t + step)
        near = problem if ahead == 1.0 else lay_out(_easier(design, ahead))
        guess = reached[1].state
        if before is not None:  # Along the secant through the last two trims.
            guess = guess + (guess - before[1].state) * (ahead - t) / (t - before[0])
        result = newton(near, Guess(guess, reached[1].induced))
        passes += result.passes
        if result.converged:
            before, reached, t = reached, (ahead, result.last), ahead
            step *= 1.7
        else:
            step *= 0.4
    if t >= 1.0:
        return replace(result, passes=passes)
    return replace(best, passes=passes, reached=t)
