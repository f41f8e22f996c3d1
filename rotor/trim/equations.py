"""The equations of equilibrium in forward flight, and their exact Jacobian.

`propulsive` (flight preset): collective, cyclic, shaft tilt and coning so that the vertical force carries the weight,
the forward force the drag, and the first-harmonic flapping is as wanted. `thrust` (thesis preset): collective and free
flapping so that the thrust is the resultant of weight and drag; no cyclic. Both: λ0 closes eq. (2.30) with the axial
flow of the tilted disk. Blades held rigid have no flapping to find and no cyclic to find it with: what remains is
collective, λ0 and, where drag is balanced, the shaft tilt; the hub carries whatever moments come of it.
"""

import math

import numpy as np

from rotor.aero.elements import (
    COLLECTIVE,
    CONING,
    CYCLIC_1C,
    CYCLIC_1S,
    FLAP_1C,
    FLAP_1S,
    LAMBDA0,
    SHAFT_TILT,
    Pass,
    Problem,
)
from rotor.aero.sums import Slopes, sums
from rotor.arrays import Array
from rotor.design.design import Models

UNKNOWNS: dict[str, tuple[int, ...]] = {
    "propulsive": (COLLECTIVE, SHAFT_TILT, CONING, CYCLIC_1C, CYCLIC_1S, LAMBDA0),
    "thrust": (COLLECTIVE, CONING, FLAP_1C, FLAP_1S, LAMBDA0),
}
"""Which state entries each trim solves for."""

_HELD = {CONING, CYCLIC_1C, CYCLIC_1S, FLAP_1C, FLAP_1S}
"""What is zero when the blades are held rigid: nothing flaps, and no cyclic keeps the rotor from rolling."""


def unknowns_of(models: Models) -> tuple[int, ...]:
    """The state entries that these models solve for, in the order of `UNKNOWNS`."""
    chosen = UNKNOWNS[models.trim]
    return chosen if models.flapping else tuple(entry for entry in chosen if entry not in _HELD)


def with_givens(problem: Problem, start: Array) -> Array:
    """The start with every entry that is not solved for at its given value."""
    state = start.copy()
    condition = problem.design.condition
    if not problem.design.models.flapping:
        state[sorted(_HELD)] = 0.0
    elif problem.design.models.trim == "propulsive":
        state[FLAP_1C], state[FLAP_1S] = condition.flap_1c, condition.flap_1s
    else:
        state[CYCLIC_1C] = state[CYCLIC_1S] = 0.0
    if problem.design.models.trim == "thrust":
        state[SHAFT_TILT] = math.atan2(problem.drag, problem.weight)
    state[LAMBDA0] = max(state[LAMBDA0], 1e-4)
    return state


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
    if not problem.design.models.flapping:
        flapping = []
    momentum = 2.0 * one.flow.lambda0 * one.flow.speed - total.thrust
    if problem.design.models.trim == "propulsive":
        cos, sin = math.cos(state[SHAFT_TILT]), math.sin(state[SHAFT_TILT])
        vertical = total.thrust * cos + total.drag * sin - problem.weight
        forward = total.thrust * sin - total.drag * cos - problem.drag
        return np.array([vertical, forward, *flapping, momentum])
    return np.array([total.thrust - math.hypot(problem.weight, problem.drag), *flapping, momentum])


def jacobian(problem: Problem, one: Pass, made: Slopes) -> Array:
    """Exact derivatives of `residuals` by the unknowns, (residuals, unknowns)."""
    answer = combine_sums(problem, one, made.sums)
    state, flap, flow = one.state, problem.flap, one.flow
    spring = flap.frequency_squared
    place = {unknown: k for k, unknown in enumerate(made.unknowns)}
    first = len(answer) - 4  # Rows: the force balance or balances, three of flapping, momentum.
    for row, (entry, stiffness) in enumerate(((CONING, spring), (FLAP_1C, spring - 1.0), (FLAP_1S, spring - 1.0))):
        if entry in place:
            answer[first + row, place[entry]] -= stiffness / flap.load_gain
    # d(2λ0 V) with V = √(µ_x² + (µ_z + λ0)²); by the tilt V ∂V = µ_x λ0, since µ_x dµ_x + µ_z dµ_z = 0.
    answer[-1, place[LAMBDA0]] += 2.0 * (flow.speed + flow.lambda0 * flow.axial / flow.speed)
    if SHAFT_TILT in place:
        tilt = place[SHAFT_TILT]
        if problem.design.models.disk_axial_flow:
            answer[-1, tilt] += 2.0 * flow.lambda0**2 * flow.mu_x / flow.speed
        cos, sin = math.cos(state[SHAFT_TILT]), math.sin(state[SHAFT_TILT])
        total = sums(problem, one)
        answer[0, tilt] += -total.thrust * sin + total.drag * cos
        answer[1, tilt] += total.thrust * cos + total.drag * sin
    return answer


def combine_sums(problem: Problem, one: Pass, total: Array) -> Array:
    """The part of the residuals that is linear in the sums, for columns of sums, (residuals, columns)."""
    thrust, drag, *moments = total
    if not problem.design.models.flapping:
        moments = []
    if problem.design.models.trim == "thrust":
        return np.stack([thrust, *moments, -thrust])
    cos, sin = math.cos(one.state[SHAFT_TILT]), math.sin(one.state[SHAFT_TILT])
    return np.stack([thrust * cos + drag * sin, thrust * sin - drag * cos, *moments, -thrust])
