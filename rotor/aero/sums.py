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
_SUM_INDEX: dict[SumName, int] = {name: k for k, name in enumerate(get_args(SumName))}
N_SUMS = len(_SUM_INDEX)


def sum_index(name: SumName) -> int:
    """Place of a sum in the arrays of sums."""
    return _SUM_INDEX[name]


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

    @property
    def array(self) -> Array:
        """In the order of `SumName`, (6,)."""
        return np.array([self.thrust, self.drag, *self.moment, self.torque])


def disk_sums(problem: Problem, elements: BladeElements) -> DiskSums:
    """Thrust, H-force, flap moments and torque."""
    loads = elements.loads
    sums: list[float] = integrate(problem, elements, loads[kernel.FZ][None], loads[kernel.FX][None])[:, 0].tolist()
    thrust, drag, mean, cosine, sine, torque = sums
    if elements.friction is not None:
        drag += radial_drag(problem, elements.friction.radial)
    return DiskSums(thrust, drag, (mean, cosine, sine), torque)


def radial_drag(problem: Problem, radial: Array) -> float:
    """Part of C_H of a field of forces along the blade: Σ dF_r cos ψ."""
    disk = problem.disk
    return float(disk.dr * radial.sum(axis=0) @ disk.cos) / len(disk.psi)


def integrate(problem: Problem, elements: BladeElements, fz: Array, fx: Array) -> Array:
    """(C_T, C_H, M0, M1c, M1s, C_Q) of stacks of F_z and F_x fields, (6, stack): the sums are linear in the loads."""
    disk = problem.disk
    cell = disk.dr / len(disk.psi)
    return _integrate(fz, fx, disk.r, disk.r - problem.flap.hinge, disk.cos, disk.sin, elements.beta, cell)


@compiled(error_model="numpy")
def _integrate(fz: Any, fx: Any, r: Any, arm: Any, cos: Any, sin: Any, beta: Any, cell: float) -> Any:
    """The six sums, as `weighted_loads` summed: along the blade at every azimuth first, then around the disk."""
    count, n, m = fz.shape
    out = np.zeros((6, count))
    along = np.zeros((count, 4, m))  # Sums of F_z, of its moment, of F_x and of its torque.
    for k in range(count):
        for i in range(n):
            for j in range(m):
                along[k, 0, j] += fz[k, i, j]
                along[k, 1, j] += arm[i] * fz[k, i, j]
                along[k, 2, j] += fx[k, i, j]
                along[k, 3, j] += r[i] * fx[k, i, j]
        for j in range(m):
            lift, moment = cell * along[k, 0, j], cell * along[k, 1, j]
            out[0, k] += lift
            out[1, k] += cell * along[k, 2, j] * sin[j] - beta[j] * lift * cos[j]
            out[2, k] += moment
            out[3, k] += 2.0 * moment * cos[j]
            out[4, k] += 2.0 * moment * sin[j]
            out[5, k] += cell * along[k, 3, j]
    return out


def integrate_transposed(problem: Problem, elements: BladeElements, weights: Array) -> tuple[Array, Array]:
    """The transpose of `integrate`: ∂(weights · sums) by F_z and by F_x, (…, 6) → (…, elements, azimuths)."""
    disk = problem.disk
    cell = disk.dr / len(disk.psi)
    thrust, drag, mean, cosine, sine, torque = cell * np.moveaxis(weights, -1, 0)[..., None]
    moment = mean + 2.0 * (cosine * disk.cos + sine * disk.sin)
    arm = (disk.r - problem.flap.hinge)[:, None]
    by_fz: Array = (thrust - drag * elements.beta * disk.cos)[..., None, :] + arm * moment[..., None, :]
    by_fx: Array = (drag * disk.sin)[..., None, :] + torque[..., None, :] * disk.r[:, None]
    return by_fz, by_fx


@dataclass(frozen=True, eq=False)
class Slopes:
    """Derivatives by the chosen unknowns and by the elastic coordinates. Stacks lead with the unknowns."""

    unknowns: tuple[Unknown, ...]
    fz: Array
    """∂F_z, (unknowns, elements, azimuths): an inflow that answers the load is held, one that does not follows."""
    fx: Array
    """∂F_x likewise."""
    prescribed: Array | None
    """∂λ_i of a model that does not depend on the load, (unknowns, elements, azimuths)."""
    answer: InflowColumns | None
    """∂λ_i of one that does, by the unknowns, then by the elastic coordinates."""
    sums: Array
    """∂ of the sums in the order of `SumName` by the unknowns, the inflow following, (6, unknowns)."""
    torsion_sums: Array
    """The same by the elastic coordinates, (6, columns)."""


def slopes(
    problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...], feedback: InflowFeedback | None
) -> Slopes:
    """Exact derivatives of loads and sums by the unknowns. `feedback`: of the response of a load-dependent model."""
    disk, loads, response = problem.disk, elements.loads, elements.response
    fz, fx = np.empty((2, len(unknowns), *elements.theta.shape))
    prescribed: Array | None = None
    answer: InflowColumns | None = None
    shapes = problem.torsion.shapes if problem.torsion is not None else None
    wake = _wake_slopes(problem, elements, unknowns)
    if response is not None and feedback is None:
        prescribed = np.zeros((len(unknowns), *disk.shape))
        by_wake = response.by_wake.reshape(3, -1)
        for k in np.flatnonzero(wake.any(axis=1)):
            np.dot(wake[k], by_wake, out=prescribed[k].reshape(-1))
    for k, unknown in enumerate(unknowns):
        _by_unknown(problem, elements, unknown, None if prescribed is None else prescribed[k], fz[k], fx[k])
    if response is not None and feedback is not None:
        if isinstance(feedback, ColumnFeedback):
            answer = feedback.answer_columns(fz, wake, loads[kernel.FZ_THETA], shapes)
        else:
            answer = FieldColumns.of(response, feedback, fz, wake, loads[kernel.FZ_THETA], shapes)
    total = integrate(problem, elements, fz, fx)
    lift = disk.dr * loads[kernel.FZ].sum(axis=0)
    for k, unknown in enumerate(unknowns):  # β also tilts the lift itself: −β dF_z cos ψ in C_H.
        if unknown in ("coning", "flap_1c", "flap_1s"):
            beta = {"coning": 1.0, "flap_1c": disk.cos, "flap_1s": disk.sin}[unknown]
            total[1, k] -= (lift @ (beta * disk.cos)) / len(disk.psi)
        if unknown == "shaft_tilt" and elements.friction is not None and problem.design.models.disk_axial_flow:
            total[1, k] -= elements.flow.mu_z * radial_drag(problem, elements.friction.radial_slope)
    twisting = np.zeros((N_SUMS, 0))
    if shapes is not None:
        by_theta = weighted_loads(problem, elements, loads[kernel.FZ_THETA], loads[kernel.FX_THETA])
        twisting = shapes.gather(by_theta).reshape(N_SUMS, -1)
    if answer is not None:
        added = answer.integrate(weighted_loads(problem, elements, loads[kernel.FZ_UP], loads[kernel.FX_UP]))
        total += added[:, : len(unknowns)]
        twisting = twisting + added[:, len(unknowns) :]
    return Slopes(unknowns, fz, fx, prescribed, answer, total, twisting)


def _wake_slopes(problem: Problem, elements: BladeElements, unknowns: tuple[Unknown, ...]) -> Array:
    """∂(µ_x, µ_z, λ0) by the unknowns, (unknowns, 3): ∂µ_x/∂α = −µ_z, ∂µ_z/∂α = µ_x."""
    wake = wake_at(problem, elements.state)
    out = np.zeros((len(unknowns), 3))
    for row, unknown in zip(out, unknowns, strict=True):
        if unknown == "shaft_tilt":
            row[:2] = -wake.mu_z, wake.mu_x
        elif unknown == "lambda0":
            row[2] = 1.0
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


def velocity_slopes(problem: Problem, elements: BladeElements, unknown: Unknown) -> tuple[Array | float, Array | float]:
    """∂U_T and ∂U_P by one unknown with the inflow held; broadcast to (elements, azimuths)."""
    cos, sin, flow = problem.disk.cos, problem.disk.sin, elements.flow
    if unknown in ("coning", "flap_1c", "flap_1s"):
        u_p = flow.mu_x * cos * {"coning": 1.0, "flap_1c": cos, "flap_1s": sin}[unknown]
        if unknown != "coning":
            u_p = u_p + (problem.disk.r - problem.flap.hinge)[:, None] * (-sin if unknown == "flap_1c" else cos)
        return 0.0, u_p
    u_t: Array | float = -swirl_slope(problem, elements, unknown)
    if unknown == "shaft_tilt" and problem.design.models.disk_axial_flow:
        return u_t - flow.mu_z * sin, flow.mu_x - flow.mu_z * elements.beta * cos
    return u_t, 0.0


def swirl_slope(problem: Problem, elements: BladeElements, unknown: Unknown) -> Array | float:
    """∂(swirl) by one unknown, (elements, 1) or 0."""
    models, flow = problem.design.models, elements.flow
    if unknown not in ("shaft_tilt", "lambda0") or not models.has("swirl"):
        return 0.0
    if unknown == "shaft_tilt":
        product = flow.lambda0 * flow.mu_x if models.disk_axial_flow else 0.0
    else:
        product = flow.axial + flow.lambda0
    _, slope = swirl_of(problem.disk.r, flow.lambda0 * flow.axial)
    return product * slope[:, None]


def _by_unknown(
    problem: Problem, elements: BladeElements, unknown: Unknown, prescribed: Array | None, fz: Array, fx: Array
) -> None:
    """Write ∂F_z, ∂F_x by one unknown: through θ, U_T, U_P and the loss factor.

    prescribed: ∂λ_i of a model that does not depend on the load; None: λ_i is held.
    """
    disk, loads = problem.disk, elements.loads
    if unknown in ("collective", "cyclic_1c", "cyclic_1s"):
        theta = {"collective": 1.0, "cyclic_1c": disk.cos, "cyclic_1s": disk.sin}[unknown]
        np.multiply(loads[kernel.FZ_THETA], theta, out=fz)
        np.multiply(loads[kernel.FX_THETA], theta, out=fx)
        return
    u_t, u_p = velocity_slopes(problem, elements, unknown)
    if unknown not in ("shaft_tilt", "lambda0"):
        np.multiply(loads[kernel.FZ_UP], u_p, out=fz)
        np.multiply(loads[kernel.FX_UP], u_p, out=fx)
        return
    change = velocity_changes(problem, elements, unknown, u_t, u_p if prescribed is None else u_p + prescribed)
    lift = loads[kernel.LIFT]
    for out, by_ut, by_up, by_ur, along in (
        (fz, kernel.FZ_UT, kernel.FZ_UP, kernel.FZ_UR, elements.u_t),
        (fx, kernel.FX_UT, kernel.FX_UP, kernel.FX_UR, elements.u_p),
    ):
        chain_rule(*change, loads[by_ut], loads[by_up], loads[by_ur], lift, along, out)
    if unknown == "shaft_tilt" and problem.design.models.disk_axial_flow and elements.friction is not None:
        fx -= elements.flow.mu_z * elements.friction.fx_slope


def velocity_changes(
    problem: Problem, elements: BladeElements, unknown: Unknown, u_t: Array | float, u_p: Array | float
) -> tuple[Array, Array, Array, Array]:
    """∂U_T, ∂U_P on the grid, ∂U_R (azimuths,) and ∂F (elements,) by shaft tilt or λ0, for `chain_rule`."""
    by_ut, by_up = np.empty((2, *problem.disk.shape))
    by_ut[:], by_up[:] = u_t, u_p
    tilting = unknown == "shaft_tilt" and problem.design.models.disk_axial_flow
    along = -elements.flow.mu_z * problem.disk.cos if tilting else np.zeros_like(problem.disk.cos)
    return by_ut, by_up, along, elements.loss_slopes[0 if unknown == "shaft_tilt" else 1]


@compiled(error_model="numpy", fastmath={"contract"})
def chain_rule(
    u_t: Any, u_p: Any, u_r: Any, loss: Any, by_ut: Any, by_up: Any, by_ur: Any, lift: Any, along: Any, out: Any
) -> None:
    """Write ∂f/∂U_T δU_T + ∂f/∂U_P δU_P + ∂f/∂U_R δU_R + ½σUC_l · along · δF, (elements, azimuths).

    u_t, u_p (elements, azimuths), u_r (azimuths,) and loss (elements,) are the changes; the others belong to f.
    """
    for i in range(len(loss)):
        for j in range(len(u_r)):
            out[i, j] = (
                by_ut[i, j] * u_t[i, j]
                + by_up[i, j] * u_p[i, j]
                + by_ur[i, j] * u_r[j]
                + lift[i, j] * along[i, j] * loss[i]
            )
