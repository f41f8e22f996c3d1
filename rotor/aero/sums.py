"""Sums over the disk, and their exact derivatives by the trim unknowns.

A trim unknown acts on a blade element only through θ, U_T, U_P and the loss factor: collective and cyclic are columns
in θ; coning and flapping are columns in U_P; tilt and λ0 change the velocities and the inflow. The response of the
inflow to the changed load is added where the model is load-dependent. An elastic coordinate is a column in θ as well.
"""

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, get_args

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, swirl_of, wake_at
from rotor.aero.inflow.interface import ColumnFeedback, FieldColumns, InflowColumns, InflowFeedback
from rotor.aero.radial_flow import friction_slopes_of_row
from rotor.aero.trim_state import STATE_NAMES, Unknown, places_of
from rotor.arrays import Array, Booleans
from rotor.compiled import compiled

SumName = Literal["thrust", "drag", "moment", "moment_1c", "moment_1s", "torque"]
"""The sums over the disk, in the order of the arrays of sums."""
SUM_NAMES: tuple[SumName, ...] = get_args(SumName)
N_SUMS = len(SUM_NAMES)
_DRAG = SUM_NAMES.index("drag")

_compile = compiled(error_model="numpy", fastmath={"contract"})


@dataclass(frozen=True)
class DiskSums:
    """Sums over the disk, as coefficients of ρA(ΩR)²."""

    thrust: float
    """C_T along the shaft, eq. (3.12)."""
    drag: float
    """C_H, aft in the hub plane: Σ (dF_x sin ψ − β dF_z cos ψ + dF_r cos ψ)."""
    moment: tuple[float, float, float]
    """Flap moment Σ (r − e) dF_z: mean, cos ψ and sin ψ parts."""
    torque: float
    """C_Q: Σ r dF_x."""


def disk_sums(problem: Problem, elements: BladeElements) -> DiskSums:
    """Thrust, H-force, flap moments and torque."""
    thrust, drag, mean, cosine, sine, torque = sum_array(problem, elements).tolist()
    return DiskSums(thrust, drag, (mean, cosine, sine), torque)


def sum_array(problem: Problem, elements: BladeElements) -> Array:
    """The same in the order of `SumName`, (6,)."""
    loads = elements.loads
    sums = integrate(problem, elements, loads[kernel.FZ : kernel.FZ + 1], loads[kernel.FX : kernel.FX + 1])[:, 0]
    if elements.friction is not None:
        sums[_DRAG] += radial_drag(problem, elements.friction.radial)
    return sums


def radial_drag(problem: Problem, radial: Array) -> float:
    """Part of C_H of a field of forces along the blade: Σ dF_r cos ψ."""
    disk = problem.disk
    return float(_along_flight(radial, disk.cos)) * disk.dr / len(disk.psi)


@compiled(error_model="numpy", fastmath={"contract", "reassoc"})
def _along_flight(radial: Any, cos: Any) -> float:
    """Σ over the grid of a field times cos ψ."""
    total = 0.0
    for i in range(len(radial)):
        for j in range(len(cos)):
            total += radial[i, j] * cos[j]
    return total


def integrate(problem: Problem, elements: BladeElements, fz: Array, fx: Array) -> Array:
    """(C_T, C_H, M0, M1c, M1s, C_Q) of stacks of F_z and F_x fields, (6, stack): the sums are linear in the loads."""
    disk = problem.disk
    cell = disk.dr / len(disk.psi)
    return _integrate(fz, fx, disk.r, problem.arm, disk.cos, disk.sin, elements.beta, cell)


@compiled(error_model="numpy")
def _integrate(fz: Any, fx: Any, r: Any, arm: Any, cos: Any, sin: Any, beta: Any, cell: float) -> Any:
    """The six sums, as `weighted_loads` summed: along the blade at every azimuth first, then around the disk."""
    count, n, m = fz.shape
    out = np.zeros((6, count))
    for k in range(count):
        along = np.zeros((1, 5, m))
        for i in range(n):
            add_to_sums(arm[i], r[i], fz[k, i], fx[k, i], along, 0)
        out[:, k] = around_disk(along[0], cos, sin, beta, cell)
    return out


@compiled(error_model="numpy")
def add_along_blade(arm: float, r: float, fz: Any, fx: Any, radial: Any, along: Any) -> None:
    """Add one row to the sums along the blade of F_z, (r − e) F_z, F_x, r F_x and F_r, (5, azimuths)."""
    for j in range(len(fz)):
        along[0, j] += fz[j]
        along[1, j] += arm * fz[j]
        along[2, j] += fx[j]
        along[3, j] += r * fx[j]
        along[4, j] += radial[j]


@compiled(error_model="numpy")
def add_to_sums(arm: float, r: float, fz: Any, fx: Any, along: Any, k: int) -> None:
    """The same to one of several, (sums, 5, azimuths), without forces along the blade."""
    for j in range(len(fz)):
        along[k, 0, j] += fz[j]
        along[k, 1, j] += arm * fz[j]
    for j in range(len(fx)):
        along[k, 2, j] += fx[j]
        along[k, 3, j] += r * fx[j]


@compiled(error_model="numpy")
def around_disk(along: Any, cos: Any, sin: Any, beta: Any, cell: float) -> Any:
    """The six sums from those along the blade; cell: element width over R times part of a turn."""
    out = np.zeros(6)
    for j in range(len(cos)):
        lift, moment = cell * along[0, j], cell * along[1, j]
        out[0] += lift
        out[1] += cell * (along[2, j] * sin[j] + along[4, j] * cos[j]) - beta[j] * lift * cos[j]
        out[2] += moment
        out[3] += 2.0 * moment * cos[j]
        out[4] += 2.0 * moment * sin[j]
        out[5] += cell * along[3, j]
    return out


@compiled(error_model="numpy")
def at_azimuths(along: Any, cos: Any, sin: Any, beta: Any, cell: float) -> Any:
    """What every azimuth adds to the six sums, (6, azimuths)."""
    out = np.empty((6, len(cos)))
    for j in range(len(cos)):
        out[:, j] = around_disk(along[:, j : j + 1], cos[j : j + 1], sin[j : j + 1], beta[j : j + 1], cell)
    return out


@dataclass(frozen=True, eq=False)
class Slopes:
    """Derivatives by the chosen unknowns and by the elastic coordinates. Stacks lead with the unknowns."""

    unknowns: tuple[Unknown, ...]
    changes: "UnknownChanges"
    by_wake: Array | None
    """∂λ_i by (µ_x, µ_z, λ0) of a model that does not depend on the load, (3, elements, azimuths)."""
    answer: InflowColumns | None
    """∂λ_i of one that does, by the unknowns, then by the elastic coordinates."""
    sums: Array
    """∂ of the sums in the order of `SumName` by the unknowns, the inflow following, (6, unknowns)."""
    torsion_sums: Array
    """The same by the elastic coordinates, (6, columns)."""
    by_terms: Array | None
    """The same by the terms of an inflow that answers the load, (6, terms), see `InflowColumns.rows`."""


def slopes(
    problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...], feedback: InflowFeedback | None
) -> Slopes:
    """Exact derivatives of loads and sums by the unknowns. `feedback`: of the response of a load-dependent model."""
    disk, loads, response = problem.disk, elements.loads, elements.response
    answer: InflowColumns | None = None
    shapes = problem.torsion.shapes if problem.torsion is not None else None
    by_wake = response.by_wake if response is not None and feedback is None else None
    changes = unknown_changes(problem, elements, unknowns)
    fz, total, twist = _by_unknowns(
        changes, loads, elements.u_t, elements.u_p, by_wake if by_wake is not None else HELD, disk.r, disk.cos,
        disk.sin, elements.beta, disk.dr / len(disk.psi), *_tilting_friction(problem, elements),
        shapes.radial if shapes is not None else _NO_SHAPES, feedback is not None,
    )  # fmt: skip
    if response is not None and feedback is not None:
        if isinstance(feedback, ColumnFeedback):
            answer = feedback.answer_columns(fz, changes.wake, loads[kernel.FZ_THETA], shapes)
        else:
            answer = FieldColumns.of(response, feedback, fz, changes.wake, loads[kernel.FZ_THETA], shapes)
    twisting = (twist @ shapes.waves.T).reshape(N_SUMS, -1) if shapes is not None else np.zeros((N_SUMS, 0))
    rows: Array | None = None
    if answer is not None:
        rows = answer.rows(weighted_loads(problem, elements, loads[kernel.FZ_UP], loads[kernel.FX_UP]))
        added = answer.times(rows)
        total += added[:, : len(unknowns)]
        twisting = twisting + added[:, len(unknowns) :]
    return Slopes(unknowns, changes, by_wake, answer, total, twisting, rows)


def _tilting_friction(problem: Problem, elements: BladeElements) -> tuple[Array, float, Any]:
    """½σ c_f of the friction that follows the shaft tilt, (elements,), or none; µ_x; elements without load."""
    if elements.friction is None or not problem.design.models.disk_axial_flow:
        return _NO_FRICTION, 0.0, _ALL_LOADED
    unloaded = problem.unloaded if problem.unloaded is not None else _ALL_LOADED
    return problem.friction * problem.disk.half_solidity, elements.flow.mu_x, unloaded


@_compile
def _by_unknowns(
    changes: Any, loads: Any, u_t: Any, u_p: Any, by_wake: Any, r: Any, cos: Any, sin: Any, beta: Any, cell: float,
    friction: Any, mu_x: float, unloaded: Any, shapes: Any, keep: bool,
) -> Any:  # fmt: skip
    """∂F_z by the unknowns, if it is to be kept, ∂ of the six sums, and what a twist by shapes adds to them.

    (unknowns, elements, azimuths), (6, unknowns) and (6, modes, azimuths). The inflow is held, or follows the wake.
    """
    unknowns, n, m = len(changes.theta), len(r), len(cos)
    fz = np.empty((unknowns if keep else 0, n, m))
    along, pitched, lift = np.zeros((unknowns, 5, m)), np.zeros((1 + len(shapes), 5, m)), np.zeros(m)
    row, fx, by_ut, by_up, rubbing, radial = (
        np.empty(m),
        np.empty(m),
        np.empty(m),
        np.empty(m),
        np.empty(m),
        np.empty(m),
    )
    for i in range(n):
        arm, fz_theta, fx_theta, rising = changes.arm[i], loads[FZ_THETA, i], loads[FX_THETA, i], loads[LIFT, i]
        fz_ut, fz_up, fz_ur = loads[FZ_UT, i], loads[FZ_UP, i], loads[FZ_UR, i]
        fx_ut, fx_up, fx_ur = loads[FX_UT, i], loads[FX_UP, i], loads[FX_UR, i]
        tangential, normal = u_t[i], u_p[i]
        for j in range(m):
            lift[j] += loads[FZ, i, j]
        add_to_sums(arm, r[i], fz_theta, fx_theta, pitched, 0)
        for k in range(len(shapes)):
            for j in range(m):
                row[j], fx[j] = shapes[k, i] * fz_theta[j], shapes[k, i] * fx_theta[j]
            add_to_sums(arm, r[i], row, fx, pitched, 1 + k)
        if len(friction) > 0:
            friction_slopes_of_row(r[i], cos, sin, friction[i], mu_x, rubbing, radial)
            if len(unloaded) > 0:
                rubbing[unloaded[i]], radial[unloaded[i]] = 0.0, 0.0
        for k in range(unknowns):
            if changes.pitches[k]:
                if keep:
                    for j in range(m):
                        fz[k, i, j] = fz_theta[j] * changes.theta[k, j]
                continue
            velocity_changes(changes, k, i, by_wake, by_ut, by_up)
            chain_rule(fz_ut, fz_up, fz_ur, by_ut, by_up, changes.u_r, k, row)
            chain_rule(fx_ut, fx_up, fx_ur, by_ut, by_up, changes.u_r, k, fx)
            if changes.loss[k, i] != 0.0:
                add_product(changes.loss[k, i], rising, tangential, row)
                add_product(changes.loss[k, i], rising, normal, fx)
            if len(friction) > 0 and changes.mu_x[k] != 0.0:
                for j in range(m):
                    fx[j] += changes.mu_x[k] * rubbing[j]
                    along[k, 4, j] += changes.mu_x[k] * radial[j]
            add_to_sums(arm, r[i], row, fx, along, k)
            if keep:
                for j in range(m):
                    fz[k, i, j] = row[j]
    sums, twist = np.empty((6, unknowns)), np.empty((6, len(shapes), m))
    for k in range(len(shapes)):
        twist[:, k] = at_azimuths(pitched[1 + k], cos, sin, beta, cell)
    for k in range(unknowns):
        if changes.pitches[k]:
            along[k] = pitched[0] * changes.theta[k]
        sums[:, k] = around_disk(along[k], cos, sin, beta, cell)
        sums[1, k] -= tilted_lift(lift, changes.beta[k], cos, cell)
    return fz, sums, twist


@_compile
def tilted_lift(lift: Any, beta: Any, cos: Any, cell: float) -> float:
    """Σ dF_z ∂β cos ψ: a blade that rises tilts its own lift, which is part of C_H."""
    total = 0.0
    for j in range(len(cos)):
        total += lift[j] * beta[j] * cos[j]
    return cell * total


def sums_at_given_loads(problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...]) -> Array:
    """∂ of the sums by the unknowns at the same F_z and F_x, (6, unknowns)."""
    disk, out = problem.disk, np.zeros((N_SUMS, len(unknowns)))
    cell, lift = disk.dr / len(disk.psi), elements.loads[kernel.FZ].sum(axis=0)
    for k, unknown in enumerate(unknowns):
        if unknown in ("coning", "flap_1c", "flap_1s"):
            beta = {"coning": np.ones_like(disk.cos), "flap_1c": disk.cos, "flap_1s": disk.sin}[unknown]
            out[_DRAG, k] = -tilted_lift(lift, beta, disk.cos, cell)
        if unknown == "shaft_tilt" and elements.friction is not None and problem.design.models.disk_axial_flow:
            out[_DRAG, k] = -elements.flow.mu_z * radial_drag(problem, elements.friction.radial_slope)
    return out


def weighted_loads(problem: Problem, elements: BladeElements, fz: Array, fx: Array) -> Array:
    """What every element adds to the six sums with fields of F_z and F_x, (6, elements, azimuths)."""
    disk = problem.disk
    cell = disk.dr / len(disk.psi)
    return _weighted(fz, fx, disk.r, problem.arm, disk.cos, disk.sin, elements.beta, cell)


@compiled(error_model="numpy")
def _weighted(fz: Any, fx: Any, r: Any, arm: Any, cos: Any, sin: Any, beta: Any, cell: float) -> Any:
    n, m = fz.shape
    out = np.empty((6, n, m))
    for i in range(n):
        for j in range(m):
            out[0, i, j] = cell * fz[i, j]
            out[1, i, j] = cell * (sin[j] * fx[i, j] - beta[j] * cos[j] * fz[i, j])
            out[2, i, j] = cell * arm[i] * fz[i, j]
        for j in range(m):
            moment = 2.0 * cell * arm[i] * fz[i, j]
            out[3, i, j] = moment * cos[j]
            out[4, i, j] = moment * sin[j]
            out[5, i, j] = cell * r[i] * fx[i, j]
    return out


class UnknownChanges(NamedTuple):
    """What a unit of each unknown changes at the blade elements, the inflow held: functions of r and of ψ.

    ∂U_T = u_t_along(r) + u_t(ψ) and ∂U_P = u_p(ψ) + (r − e) u_p_arm(ψ).
    """

    theta: Array
    """∂θ, (unknowns, azimuths), as the next six."""
    rate: Array
    """∂θ'"""
    u_t: Array
    u_p: Array
    u_p_arm: Array
    u_r: Array
    """∂U_R"""
    beta: Array
    """∂β"""
    u_t_along: Array
    """(unknowns, elements): less the change of the swirl."""
    loss: Array
    """∂F, (unknowns, elements)."""
    wake: Array
    """∂(µ_x, µ_z, λ0), (unknowns, 3)."""
    mu_x: Array
    """∂µ_x as the blade elements see it, (unknowns,)."""
    arm: Array
    """r − e, (elements,)."""
    pitches: Booleans
    """Whether an unknown changes the pitch; the others change the velocities and losses, (unknowns,)."""


HELD = np.zeros((0, 0, 0))
"""∂λ_i of an inflow that is held."""
_NO_SHAPES = np.zeros((0, 0))
_NO_FRICTION = np.zeros(0)
_ALL_LOADED = np.zeros((0, 0), np.bool_)


def unknown_changes(problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...]) -> UnknownChanges:
    """The changes at the blade elements by the unknowns."""
    disk, flow, models = problem.disk, elements.flow, problem.design.models
    at = wake_at(problem, elements.state)
    places = places_of(unknowns)
    pitches = places <= _CYCLIC_1S
    around, along, wake, mu_x = _changes(
        places, disk.r, disk.cos, disk.sin, elements.beta, (flow.mu_x, flow.mu_z, flow.lambda0),
        (at.mu_x, at.mu_z), elements.loss_slopes, models.disk_axial_flow, models.has("swirl"),
    )  # fmt: skip
    theta, rate, u_t, u_p, u_p_arm, u_r, rising = around
    return UnknownChanges(
        theta, rate, u_t, u_p, u_p_arm, u_r, rising, along[0], along[1], wake, mu_x, problem.arm, pitches
    )


_PLACES = range(len(STATE_NAMES))
_COLLECTIVE, _CYCLIC_1C, _CYCLIC_1S, _SHAFT_TILT, _CONING, _FLAP_1C, _FLAP_1S, _LAMBDA0 = _PLACES
_THETA, _RATE, _U_T, _U_P, _U_P_ARM, _U_R, _BETA = range(7)
FZ, LIFT = kernel.FZ, kernel.LIFT
FZ_THETA, FZ_UT, FZ_UP, FZ_UR = kernel.FZ_THETA, kernel.FZ_UT, kernel.FZ_UP, kernel.FZ_UR
FX_THETA, FX_UT, FX_UP, FX_UR = kernel.FX_THETA, kernel.FX_UT, kernel.FX_UP, kernel.FX_UR


@compiled(error_model="numpy")
def _changes(
    places: Any, r: Any, cos: Any, sin: Any, beta: Any, flow: Any, at: Any, loss_slopes: Any, axial_flow: bool,
    swirls: bool,
) -> Any:  # fmt: skip
    """The fields of `UnknownChanges`: functions of ψ, (7, unknowns, azimuths), of r, (2, unknowns, elements), the rest.

    flow: µ_x, µ_z and λ0 of the blade elements; at: µ_x, µ_z of the wake.
    """
    (mu_x, mu_z, lambda0), unknowns = flow, len(places)
    around, along = np.zeros((7, unknowns, len(cos))), np.zeros((2, unknowns, len(r)))
    wake, by_mu_x = np.zeros((unknowns, 3)), np.zeros(unknowns)
    turning = swirl_of(r, lambda0 * (mu_z + lambda0))[1] if swirls else np.zeros(len(r))
    for k in range(unknowns):
        unknown = places[k]
        if unknown == _COLLECTIVE:
            around[_THETA, k] = 1.0
        elif unknown == _CYCLIC_1C:
            around[_THETA, k], around[_RATE, k] = cos, -sin
        elif unknown == _CYCLIC_1S:
            around[_THETA, k], around[_RATE, k] = sin, cos
        elif unknown == _CONING:
            around[_BETA, k], around[_U_P, k] = 1.0, mu_x * cos
        elif unknown == _FLAP_1C:
            around[_BETA, k], around[_U_P, k], around[_U_P_ARM, k] = cos, mu_x * cos * cos, -sin
        elif unknown == _FLAP_1S:
            around[_BETA, k], around[_U_P, k], around[_U_P_ARM, k] = sin, mu_x * cos * sin, cos
        elif unknown == _SHAFT_TILT:
            along[1, k] = loss_slopes[0]
            wake[k, 0], wake[k, 1] = -at[1], at[0]
            if axial_flow:  # ∂µ_x/∂α = −µ_z, ∂µ_z/∂α = µ_x
                by_mu_x[k] = -mu_z
                around[_U_T, k], around[_U_R, k] = -mu_z * sin, -mu_z * cos
                around[_U_P, k] = mu_x - mu_z * beta * cos
                along[0, k] = -lambda0 * mu_x * turning
        elif unknown == _LAMBDA0:
            along[0, k] = -(mu_z + 2.0 * lambda0) * turning
            along[1, k] = loss_slopes[1]
            wake[k, 2] = 1.0
    return around, along, wake, by_mu_x


# Loops along a row of azimuths with few arrays and no branches, so that the compiler makes vector code of them. Rows of
# what belongs to one unknown are not taken out of their arrays: that takes as long as half of the arithmetic.


@_compile
def velocity_changes(changes: Any, k: int, i: int, by_wake: Any, u_t: Any, u_p: Any) -> None:
    """∂U_T and ∂U_P of row i by unknown k, the inflow held, or following the wake with the slopes `by_wake`."""
    along, arm = changes.u_t_along[k, i], changes.arm[i]
    for j in range(len(u_t)):
        u_t[j] = along + changes.u_t[k, j]
    for j in range(len(u_p)):
        u_p[j] = changes.u_p[k, j] + arm * changes.u_p_arm[k, j]
    for one in range(len(by_wake)):
        share = changes.wake[k, one]
        if share != 0.0:
            for j in range(len(u_p)):
                u_p[j] += share * by_wake[one, i, j]


@_compile
def chain_rule(by_ut: Any, by_up: Any, by_ur: Any, u_t: Any, u_p: Any, u_r: Any, k: int, out: Any) -> None:
    """∂f/∂U_T ∂U_T + ∂f/∂U_P ∂U_P + ∂f/∂U_R ∂U_R of one row; u_r: ∂U_R of several unknowns, of which k."""
    for j in range(len(out)):
        out[j] = by_ut[j] * u_t[j] + by_up[j] * u_p[j]
    for j in range(len(out)):
        out[j] += by_ur[j] * u_r[k, j]


@_compile
def add_product(factor: float, one: Any, other: Any, out: Any) -> None:
    """Add a multiple of a product of rows."""
    for j in range(len(out)):
        out[j] += factor * one[j] * other[j]
