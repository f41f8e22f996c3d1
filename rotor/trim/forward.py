"""Trim in forward flight: warm start, cold start, then continuation from an easier condition."""

import math
from dataclasses import replace

from rotor.aero.elements import Problem, build_problem, expected_wake
from rotor.aero.trim_state import TrimState
from rotor.design.aircraft import FlightCondition
from rotor.design.design import Design
from rotor.trim.newton import Guess, TrimResult, newton
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions
from rotor.trim.solution import Solution


def trim(problem: Problem, start: Guess | None = None, options: SolverOptions = DEFAULT_OPTIONS) -> TrimResult:
    """Trim a forward-flight problem from a guess, or from simple estimates.

    Tries the warm start, then a cold start, then continuation from a lighter, slower rotor.
    """
    passes = 0
    best: TrimResult | None = None
    for guess in (start, first_guess(problem)):
        if guess is None:
            continue
        result = newton(problem, guess, options)
        passes += result.passes
        if result.converged:
            return replace(result, passes=passes)
        best = result if best is None or result.residual < best.residual else best
    assert best is not None
    return _continue(problem, best, passes, options)


def first_guess(problem: Problem) -> Guess:
    """A state from momentum theory and mean blade angles."""
    design = problem.design
    mu = design.condition.advance_ratio
    ct = math.hypot(problem.weight, problem.drag)
    wake = expected_wake(design, problem.drag)
    # C_T = ½σa(θ(1 + 3/2 µ²)/3 − λ/2) for an untwisted blade, a near 2π·0.95.
    collective = 3.0 * (2.0 * ct / (design.rotor.solidity * 5.9) + 0.5 * wake.axial) / (1.0 + 1.5 * mu**2)
    coning = problem.flap.load_gain * 0.7 * ct - problem.flap.weight
    state = TrimState(
        collective=collective,
        shaft_tilt=math.atan2(problem.drag, problem.weight),
        coning=coning,
        lambda0=wake.lambda0,
    )
    if design.models.trim == "propulsive":
        cyclic = {"cyclic_1s": -8.0 / 3.0 * mu * collective, "cyclic_1c": 4.0 / 3.0 * mu * coning}
        return Guess(replace(state, **cyclic, flap_1c=design.condition.flap_1c, flap_1s=design.condition.flap_1s))
    return Guess(replace(state, flap_1c=-8.0 / 3.0 * mu * collective, flap_1s=-4.0 / 3.0 * mu * coning))


def guess_of(earlier: Solution) -> Guess:
    """The trim of an earlier solution, as a start."""
    return Guess(earlier.controls, earlier.disk.induced)


def _easier(design: Design, t: float) -> Design:
    """The design in the flight condition of `easier_condition`."""
    return replace(design, condition=easier_condition(design, t))


def easier_condition(design: Design, t: float) -> FlightCondition:
    """The condition on the way from a light rotor at moderate speed (t = 0) to the wanted one (t = 1)."""
    condition = design.condition
    speed = condition.advance_ratio
    easy_speed = min(max(speed, 0.08), 0.2)
    blade_loading = design.weight_coefficient / design.rotor.solidity
    easy_mass = min(condition.mass, 0.045 * condition.mass / max(blade_loading, 1e-9))
    return replace(
        condition,
        advance_ratio=easy_speed + t * (speed - easy_speed),
        mass=easy_mass + t * (condition.mass - easy_mass),
    )


def _continue(problem: Problem, best: TrimResult, passes: int, options: SolverOptions) -> TrimResult:
    """Follow the trim from an easier condition in adaptive steps; where it ends on the way, tell how far it came."""
    design = problem.design
    easy = build_problem(_easier(design, 0.0))
    result = newton(easy, first_guess(easy), options)
    passes += result.passes
    if not result.converged:
        return replace(best, passes=passes, reached=0.0)
    t, step = 0.0, 0.25
    latest, before = (0.0, result.elements), None
    for _ in range(options.continuation_steps):
        if t >= 1.0 or step < options.smallest_continuation_step:
            break
        ahead = min(1.0, t + step)
        near = problem if ahead == 1.0 else build_problem(_easier(design, ahead))
        state = latest[1].state
        if before is not None:  # Along the secant through the last two trims.
            guess, last = state.array(), before[1].state.array()
            state = TrimState.from_array(guess + (guess - last) * (ahead - t) / (t - before[0]))
        result = newton(near, Guess(state, latest[1].induced), options)
        passes += result.passes
        if result.converged:
            before, latest, t = latest, (ahead, result.elements), ahead
            step *= 1.7
        else:
            step *= 0.4
    if t >= 1.0:
        return replace(result, passes=passes)
    return replace(best, passes=passes, reached=t)
