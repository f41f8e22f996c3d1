"""Sums over the disk, and their exact derivatives by the trim unknowns.

A trim unknown acts on a blade element only through θ, U_T, U_P and the loss factor: collective and cyclic are columns
in θ; coning and flapping are columns in U_P; tilt and λ0 change the velocities and the inflow. The response of the
inflow to the changed load is added where the model is load-dependent. An elastic coordinate is a column in θ as well.
"""

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem, swirl_of, wake_at
from rotor.aero.inflow.interface import ColumnFeedback, FieldColumns, InflowColumns, InflowFeedback
from rotor.aero.trim_state import Unknown
from rotor.arrays import Array
from rotor.compiled import compiled

SumName = Literal["thrust", "drag", "moment", "moment_1c", "moment_1s", "torque"]
"""The sums over the disk, in the order of the arrays of sums."""
SUM_NAMES: tuple[SumName, ...] = get_args(SumName)
N_SUMS = len(SUM_NAMES)
_DRAG = SUM_NAMES.index("drag")


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
    return _integrate(fz, fx, disk.r, disk.r - problem.flap.hinge, disk.cos, disk.sin, elements.beta, cell)


@compiled(error_model="numpy")
def _integrate(fz: Any, fx: Any, r: Any, arm: Any, cos: Any, sin: Any, beta: Any, cell: float) -> Any:
    """The six sums, as `weighted_loads` summed: along the blade at every azimuth first, then around the disk."""
    count, n, m = fz.shape
    out, no_friction = np.zeros((6, count)), np.zeros(m)
    for k in range(count):
        along = np.zeros((5, m))
        for i in range(n):
            add_along_blade(arm[i], r[i], fz[k, i], fx[k, i], no_friction, along)
        out[:, k] = around_disk(along, cos, sin, beta, cell)
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


@dataclass(frozen=True, eq=False)
class Slopes:
    """Derivatives by the chosen unknowns and by the elastic coordinates. Stacks lead with the unknowns."""

    unknowns: tuple[Unknown, ...]
    fz: Array
    """∂F_z, (unknowns, elements, azimuths): an inflow that answers the load is held, one that does not follows."""
    fx: Array
    """∂F_x likewise."""
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
    loads, response = elements.loads, elements.response
    answer: InflowColumns | None = None
    shapes = problem.torsion.shapes if problem.torsion is not None else None
    by_wake = response.by_wake if response is not None and feedback is None else None
    changes = unknown_changes(problem, elements, unknowns)
    by_fz = loads[kernel.FZ_THETA], loads[kernel.FZ_UT], loads[kernel.FZ_UP], loads[kernel.FZ_UR]
    by_fx = loads[kernel.FX_THETA], loads[kernel.FX_UT], loads[kernel.FX_UP], loads[kernel.FX_UR]
    fz = changes.follow(by_fz, loads[kernel.LIFT] * elements.u_t, by_wake)
    fx = changes.follow(by_fx, loads[kernel.LIFT] * elements.u_p, by_wake)
    if elements.friction is not None and problem.design.models.disk_axial_flow and "shaft_tilt" in unknowns:
        fx[unknowns.index("shaft_tilt")] -= elements.flow.mu_z * elements.friction.fx_slope
    if response is not None and feedback is not None:
        if isinstance(feedback, ColumnFeedback):
            answer = feedback.answer_columns(fz, changes.wake, loads[kernel.FZ_THETA], shapes)
        else:
            answer = FieldColumns.of(response, feedback, fz, changes.wake, loads[kernel.FZ_THETA], shapes)
    total = integrate(problem, elements, fz, fx) + sums_at_given_loads(problem, elements, unknowns)
    twisting = np.zeros((N_SUMS, 0))
    rows: Array | None = None
    if shapes is not None:
        by_theta = weighted_loads(problem, elements, loads[kernel.FZ_THETA], loads[kernel.FX_THETA])
        twisting = shapes.gather(by_theta).reshape(N_SUMS, -1)
    if answer is not None:
        rows = answer.rows(weighted_loads(problem, elements, loads[kernel.FZ_UP], loads[kernel.FX_UP]))
        added = answer.times(rows)
        total += added[:, : len(unknowns)]
        twisting = twisting + added[:, len(unknowns) :]
    return Slopes(unknowns, fz, fx, changes, by_wake, answer, total, twisting, rows)


def sums_at_given_loads(problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...]) -> Array:
    """∂ of the sums by the unknowns at the same F_z and F_x, (6, unknowns)."""
    disk, out = problem.disk, np.zeros((N_SUMS, len(unknowns)))
    lift = np.zeros(0)
    for k, unknown in enumerate(unknowns):  # β also tilts the lift itself: −β dF_z cos ψ in C_H.
        if unknown in ("coning", "flap_1c", "flap_1s"):
            lift = lift if lift.size else disk.dr * elements.loads[kernel.FZ].sum(axis=0)
            beta = {"coning": 1.0, "flap_1c": disk.cos, "flap_1s": disk.sin}[unknown]
            out[1, k] -= (lift @ (beta * disk.cos)) / len(disk.psi)
        if unknown == "shaft_tilt" and elements.friction is not None and problem.design.models.disk_axial_flow:
            out[1, k] -= elements.flow.mu_z * radial_drag(problem, elements.friction.radial_slope)
    return out


def weighted_loads(problem: Problem, elements: BladeElements, fz: Array, fx: Array) -> Array:
    """What every element adds to the six sums with fields of F_z and F_x, (6, elements, azimuths)."""
    disk = problem.disk
    cell = disk.dr / len(disk.psi)
    return _weighted(fz, fx, disk.r, disk.r - problem.flap.hinge, disk.cos, disk.sin, elements.beta, cell)


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


@dataclass(frozen=True, eq=False)
class UnknownChanges:
    """What a unit of each unknown changes at the blade elements, the inflow held: functions of r and of ψ.

    ∂U_T = u_t_along(r) + u_t(ψ) and ∂U_P = u_p(ψ) + (r − e) u_p_arm(ψ).
    """

    theta: Array
    """∂θ, (unknowns, azimuths), as all but two."""
    rate: Array
    """∂θ'"""
    u_t: Array
    u_p: Array
    u_p_arm: Array
    u_r: Array
    """∂U_R"""
    u_t_along: Array
    """(unknowns, elements): less the change of the swirl."""
    loss: Array
    """∂F, (unknowns, elements)."""
    wake: Array
    """∂(µ_x, µ_z, λ0), (unknowns, 3)."""
    arm: Array
    """r − e, (elements,)."""

    def follow(
        self,
        by: tuple[Array, Array, Array, Array],
        by_loss: Array,
        by_wake: Array | None = None,
        by_rate: Array | None = None,
    ) -> Array:
        """∂f by the unknowns, (unknowns, elements, azimuths), of a field f.

        by: its slopes by θ, U_T, U_P and U_R; by_loss: that by F; by_wake: ∂λ_i of a model that does not depend on the
        load, as in `Slopes`; by_rate: its slope by θ', 0 where left out.
        """
        return _follow(
            self.theta, self.rate, self.u_t, self.u_p, self.u_p_arm, self.u_r, self.u_t_along, self.loss, self.wake,
            self.arm, *by, by_loss, by_wake if by_wake is not None else _HELD,
            by_rate if by_rate is not None else _NO_RATE,
        )  # fmt: skip


_HELD = np.zeros((0, 0, 0))
"""∂λ_i of an inflow that is held."""
_NO_RATE = np.zeros((0, 0))


def unknown_changes(problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...]) -> UnknownChanges:
    """The changes at the blade elements by the unknowns."""
    disk, flow, models = problem.disk, elements.flow, problem.design.models
    cos, sin = disk.cos, disk.sin
    theta, rate, u_t, u_p, u_p_arm, u_r = np.zeros((6, len(unknowns), len(cos)))
    u_t_along, loss = np.zeros((2, len(unknowns), len(disk.r)))
    wake, at = np.zeros((len(unknowns), 3)), wake_at(problem, elements.state)
    for k, unknown in enumerate(unknowns):
        if unknown == "collective":
            theta[k] = 1.0
        elif unknown == "cyclic_1c":
            theta[k], rate[k] = cos, -sin
        elif unknown == "cyclic_1s":
            theta[k], rate[k] = sin, cos
        elif unknown == "coning":
            u_p[k] = flow.mu_x * cos
        elif unknown == "flap_1c":
            u_p[k], u_p_arm[k] = flow.mu_x * cos * cos, -sin
        elif unknown == "flap_1s":
            u_p[k], u_p_arm[k] = flow.mu_x * cos * sin, cos
        elif unknown == "shaft_tilt":
            loss[k], wake[k, :2] = elements.loss_slopes[0], (-at.mu_z, at.mu_x)
            if models.disk_axial_flow:  # ∂µ_x/∂α = −µ_z, ∂µ_z/∂α = µ_x
                u_t[k], u_p[k], u_r[k] = -flow.mu_z * sin, flow.mu_x - flow.mu_z * elements.beta * cos, -flow.mu_z * cos
        elif unknown == "lambda0":
            loss[k], wake[k, 2] = elements.loss_slopes[1], 1.0
    if models.has("swirl"):
        _, slope = swirl_of(disk.r, flow.lambda0 * flow.axial)
        if "shaft_tilt" in unknowns and models.disk_axial_flow:
            u_t_along[unknowns.index("shaft_tilt")] = -flow.lambda0 * flow.mu_x * slope
        if "lambda0" in unknowns:
            u_t_along[unknowns.index("lambda0")] = -(flow.axial + flow.lambda0) * slope
    return UnknownChanges(theta, rate, u_t, u_p, u_p_arm, u_r, u_t_along, loss, wake, disk.r - problem.flap.hinge)


@compiled(error_model="numpy", fastmath={"contract"})
def _follow(
    theta: Any, rate: Any, u_t: Any, u_p: Any, u_p_arm: Any, u_r: Any, u_t_along: Any, loss: Any, wake: Any, arm: Any,
    by_theta: Any, by_ut: Any, by_up: Any, by_ur: Any, by_loss: Any, by_wake: Any, by_rate: Any,
) -> Any:  # fmt: skip
    """The chain rule of `UnknownChanges.follow`; an unknown changes either the pitch or velocities and losses."""
    n, m = by_theta.shape
    out = np.empty((len(theta), n, m))
    for k in range(len(theta)):
        pitches, moves_wake = theta[k].any(), len(by_wake) > 0 and wake[k].any()
        for i in range(n):
            if pitches:
                for j in range(m):
                    out[k, i, j] = by_theta[i, j] * theta[k, j]
                if len(by_rate) > 0:
                    for j in range(m):
                        out[k, i, j] += by_rate[i, j] * rate[k, j]
                continue
            for j in range(m):
                out[k, i, j] = (
                    by_ut[i, j] * (u_t_along[k, i] + u_t[k, j])
                    + by_up[i, j] * (u_p[k, j] + arm[i] * u_p_arm[k, j])
                    + by_ur[i, j] * u_r[k, j]
                    + by_loss[i, j] * loss[k, i]
                )
            if moves_wake:
                for j in range(m):
                    inflow = (
                        wake[k, 0] * by_wake[0, i, j] + wake[k, 1] * by_wake[1, i, j] + wake[k, 2] * by_wake[2, i, j]
                    )
                    out[k, i, j] += by_up[i, j] * inflow
    return out
