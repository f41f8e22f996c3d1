"""Hover and axial flight: collective, coning and steady elastic twist for a given thrust, see `rotor.columns.hover`."""

import math
from dataclasses import replace

import numpy as np

from rotor.aero.inflow.local_momentum import BALANCED
from rotor.aero.momentum import axial_flow_is_steady, axial_inflow, is_windmill
from rotor.aero.problem import Problem
from rotor.aero.section import FZ
from rotor.columns.hover import hover_system
from rotor.engine.linearise import Point, System, evaluate, jacobian
from rotor.support.arrays import Array
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions, TrimResult

_LARGEST_COLLECTIVE = math.radians(40.0)


def hover(
    problem: Problem, start: Guess | None = None, options: SolverOptions = DEFAULT_OPTIONS
) -> TrimResult:
    """Collective for a thrust equal to the weight; Newton with a bracket, from an optional start.

    On a test stand the thrust is the one given; with the collective given only the elastic twist is to be found. An
    elastic blade twists with every step.
    """
    stand, collective = (
        problem.design.condition.stand,
        start.state.collective if start is not None else None,
    )
    if stand is not None and stand.collective is not None:
        return _with_collective(problem, stand.collective, start, options)
    system = hover_system(problem)
    climb = problem.air.climb
    if collective is None:
        collective = 6.0 * problem.weight / (problem.design.rotor.solidity * 5.9)
        collective += 1.5 * (axial_inflow(problem.weight, climb) + climb)
    found = _for_thrust(problem, system, _first(problem, system, collective, start), options)
    return (
        found if found.converged else replace(found, steady=not is_windmill(problem.weight, climb))
    )


def _first(problem: Problem, system: System, collective: float, start: Guess | None) -> Array:
    """(1, numbers, states) to begin with."""
    precone = problem.design.rotor.precone
    coning = precone if precone is not None and problem.design.models.flapping else 0.0
    twist = np.zeros(len(problem.given_torsion))
    if start is not None and start.elastic is not None and len(start.elastic) == len(twist):
        twist = start.elastic[:, 0]
    return np.concatenate([system.numbers, [collective, coning], twist])


def _with_collective(
    problem: Problem, collective: float, start: Guess | None, options: SolverOptions
) -> TrimResult:
    """Coning and elastic twist at a given collective, in the state of axial flow that its thrust has.

    No two states hold at one collective: wind against the thrust lifts a windmill more than a rotor whose wake goes on
    below it, and only the latter may carry more.
    """
    climb, scale = problem.air.climb, problem.scale

    def state(ct: float) -> tuple[TrimResult, float]:
        system = hover_system(problem, ct)
        result = _twisted(problem, system, _first(problem, system, collective, start), options)
        return result, float(problem.disk.dr @ result.point.forces[FZ, :, 0])

    climbing, thrust = state(math.copysign(scale, climb))
    if thrust * climb >= 0.0:
        return climbing
    windmill, thrust = state(math.copysign(0.0, -climb))
    area = problem.disk.r * problem.disk.dr
    if (
        is_windmill(thrust, climb)
        and 2.0 * abs(area @ windmill.point.forces[BALANCED, :, 0]) <= abs(climb) * area.sum()
    ):
        return windmill  # It takes at most half of the wind, on the mean over the disk.
    # The wake goes against the wind.
    descending, thrust = state(math.copysign(max(scale, climb * climb), -climb))
    steady = axial_flow_is_steady(thrust, climb) and not is_windmill(thrust, climb)
    return replace(descending, steady=steady)


def _twisted(problem: Problem, system: System, x: Array, options: SolverOptions) -> TrimResult:
    """Coning and elastic twist of one state of axial flow."""
    passes, error = 0, math.inf
    point = evaluate(system, system.grid, x, slopes=True, flow=True)
    for _ in range(20):
        passes += 1
        error = _error(point, problem)
        if error <= options.torsion_tolerance or not len(system.structure.free):
            break
        x = point.x.copy()
        x[system.structure.free] -= np.linalg.solve(jacobian(point)[0], point.residual)
        point = evaluate(system, system.grid, x, slopes=True, flow=True)
    return TrimResult(problem, point, 0.0, error <= options.accepted_hover, passes)


def _error(point: Point, problem: Problem, first: int = 0) -> float:
    """Largest residual of the equations of torsion [rad] and of coning, in parts of C_W."""
    modes = len(problem.given_torsion)
    others = np.abs(point.residual[first:])
    coning, twist = others[: len(others) - modes], others[len(others) - modes :]
    return max(float(twist.max(initial=0.0)), float(coning.max(initial=0.0)) / problem.scale)


def _for_thrust(problem: Problem, system: System, x: Array, options: SolverOptions) -> TrimResult:
    """Newton's method for the collective with a bracket; coning and elastic twist go with every step."""
    collective, free = system.structure.states["collective"], system.structure.free
    low, high, best, passes = -0.3, _LARGEST_COLLECTIVE, (math.inf, x), 0
    for _ in range(60):
        point = evaluate(system, system.grid, x, slopes=True)
        passes += 1
        matrix, rest = jacobian(point)[0], point.residual[1:]
        answers = np.linalg.solve(matrix[1:, 1:], np.stack([rest, matrix[1:, 0]], axis=1))
        error = float(point.residual[0] - matrix[0, 1:] @ answers[:, 0])
        slope, off = float(matrix[0, 0] - matrix[0, 1:] @ answers[:, 1]), _error(point, problem, 1)
        size = max(abs(error) / problem.scale, off)
        if size < best[0]:
            best = size, x
        balanced = abs(error) <= options.hover_tolerance * problem.scale
        if (balanced and off <= options.torsion_tolerance) or high - low < 1e-14:
            break
        theta, margin = float(x[collective]), 5.0 * off  # The twist still moves by about this much.
        # A windmill's thrust has an end, beyond which part of the disk is turbulent.
        if math.isnan(error):
            high = theta
        elif error < 0.0 and slope > 0.0:
            low = max(low, theta - margin)
        else:
            high = min(high, theta + margin)
        step = -error / slope if slope > 0.0 else math.inf
        ahead = theta + min(max(step, -0.1), 0.1) if math.isfinite(step) else 0.5 * (low + high)
        if not low < ahead < high:
            ahead = 0.5 * (low + high)
        x = x.copy()
        x[collective] = ahead
        x[free[1:]] -= np.nan_to_num(answers) @ np.array([1.0, ahead - theta])
    point = evaluate(system, system.grid, best[1], slopes=True, flow=True)
    residual = abs(float(point.residual[0])) / problem.scale
    converged = max(residual, _error(point, problem, 1)) <= options.accepted_hover
    return TrimResult(problem, point, residual, converged, passes)
