"""The equations of equilibrium in forward flight, and their exact Jacobian.

`propulsive` (flight preset): collective, cyclic, shaft tilt and coning so that the vertical force carries the weight,
the forward force the drag, and the first-harmonic flapping has its given value. `thrust` (thesis preset): collective
and free flapping so that the thrust is the resultant of weight and drag; no cyclic. In both λ0 closes eq. (2.30) with
the axial flow of the tilted disk. Rigid blades have neither flapping nor cyclic among their unknowns: collective, λ0
and, where drag is balanced, the shaft tilt remain, and the hub carries the moments.
"""

import math
from dataclasses import replace

import numpy as np

from rotor.aero.elements import BladeElements, Problem
from rotor.aero.sums import Slopes, disk_sums
from rotor.aero.trim_state import TrimState, Unknown
from rotor.arrays import Array
from rotor.design.design import Models

UNKNOWNS: dict[str, tuple[Unknown, ...]] = {
    "propulsive": ("collective", "shaft_tilt", "coning", "cyclic_1c", "cyclic_1s", "lambda0"),
    "thrust": ("collective", "coning", "flap_1c", "flap_1s", "lambda0"),
}
"""The quantities that each trim solves for."""

_ZERO_WHEN_RIGID: tuple[Unknown, ...] = ("coning", "cyclic_1c", "cyclic_1s", "flap_1c", "flap_1s")
"""Rigid blades do not flap, and no cyclic keeps the rotor from rolling."""


def unknowns_of(models: Models) -> tuple[Unknown, ...]:
    """The quantities that these models solve for, in the order of `UNKNOWNS`."""
    chosen = UNKNOWNS[models.trim]
    return chosen if models.flapping else tuple(name for name in chosen if name not in _ZERO_WHEN_RIGID)


def with_given_values(problem: Problem, start: TrimState) -> TrimState:
    """The start with every quantity that is not solved for at its given value."""
    state, condition, models = start, problem.design.condition, problem.design.models
    if not models.flapping:
        state = replace(state, **dict.fromkeys(_ZERO_WHEN_RIGID, 0.0))
    elif models.trim == "propulsive":
        state = replace(state, flap_1c=condition.flap_1c, flap_1s=condition.flap_1s)
    else:
        state = replace(state, cyclic_1c=0.0, cyclic_1s=0.0)
    if models.trim == "thrust":
        state = replace(state, shaft_tilt=math.atan2(problem.drag, problem.weight))
    return replace(state, lambda0=max(state.lambda0, 1e-4))


def residuals(problem: Problem, elements: BladeElements) -> Array:
    """Residual of each trim equation in units of C_T, (unknowns,): forces, flapping, momentum."""
    total = disk_sums(problem, elements)
    state, flap = elements.state, problem.flap
    spring = flap.frequency_squared
    flapping = [
        total.moment[0] - (flap.weight + spring * state.coning) / flap.load_gain,
        total.moment[1] - (spring - 1.0) * state.flap_1c / flap.load_gain,
        total.moment[2] - (spring - 1.0) * state.flap_1s / flap.load_gain,
    ]
    if not problem.design.models.flapping:
        flapping = []
    momentum = 2.0 * elements.flow.lambda0 * elements.flow.speed - total.thrust
    if problem.design.models.trim == "propulsive":
        cos, sin = math.cos(state.shaft_tilt), math.sin(state.shaft_tilt)
        vertical = total.thrust * cos + total.drag * sin - problem.weight
        forward = total.thrust * sin - total.drag * cos - problem.drag
        return np.array([vertical, forward, *flapping, momentum])
    return np.array([total.thrust - math.hypot(problem.weight, problem.drag), *flapping, momentum])


def jacobian(problem: Problem, elements: BladeElements, slopes: Slopes) -> Array:
    """Exact derivatives of `residuals` by the unknowns, (residuals, unknowns)."""
    matrix = combine_sums(problem, elements, slopes.sums)
    state, flap, flow = elements.state, problem.flap, elements.flow
    spring = flap.frequency_squared
    column = {unknown: k for k, unknown in enumerate(slopes.unknowns)}
    first = len(matrix) - 4  # Rows: the force balance or balances, three of flapping, momentum.
    for row, (name, stiffness) in enumerate((("coning", spring), ("flap_1c", spring - 1.0), ("flap_1s", spring - 1.0))):
        if name in column:
            matrix[first + row, column[name]] -= stiffness / flap.load_gain
    # d(2λ0 V) with V = √(µ_x² + (µ_z + λ0)²); by the tilt V ∂V = µ_x λ0, since µ_x dµ_x + µ_z dµ_z = 0.
    matrix[-1, column["lambda0"]] += 2.0 * (flow.speed + flow.lambda0 * flow.axial / flow.speed)
    if "shaft_tilt" in column:
        tilt = column["shaft_tilt"]
        if problem.design.models.disk_axial_flow:
            matrix[-1, tilt] += 2.0 * flow.lambda0**2 * flow.mu_x / flow.speed
        cos, sin = math.cos(state.shaft_tilt), math.sin(state.shaft_tilt)
        total = disk_sums(problem, elements)
        matrix[0, tilt] += -total.thrust * sin + total.drag * cos
        matrix[1, tilt] += total.thrust * cos + total.drag * sin
    return matrix


def combine_sums(problem: Problem, elements: BladeElements, sums: Array) -> Array:
    """The part of the residuals that is linear in the sums over the disk, for columns of sums, (residuals, columns)."""
    thrust, drag, *moments = sums
    if not problem.design.models.flapping:
        moments = []
    if problem.design.models.trim == "thrust":
        return np.stack([thrust, *moments, -thrust])
    cos, sin = math.cos(elements.state.shaft_tilt), math.sin(elements.state.shaft_tilt)
    return np.stack([thrust * cos + drag * sin, thrust * sin - drag * cos, *moments, -thrust])
