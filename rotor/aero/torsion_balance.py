"""The balance of the blade in torsion: residual, exact derivatives, moment on the control system, and work.

The residual of mode k and harmonic h is the elastic twist less what the loads of `rotor.aero.elastic` make of it, in
radians. Its derivatives by the trim unknowns and by the elastic coordinates include the response of the inflow.
"""

import math
from functools import lru_cache
from typing import Any

import numpy as np

from rotor.aero import kernel
from rotor.aero.elastic import BladeTorsion, TorsionState
from rotor.aero.elements import BladeElements, Problem
from rotor.aero.inflow.interface import HarmonicShapes
from rotor.aero.sums import HELD, Slopes, add_product, chain_rule, velocity_changes
from rotor.aero.trim_state import TrimState, Unknown
from rotor.arrays import Array
from rotor.compiled import compiled

_M_THETA, _M_RATE, _M_UT, _M_UP, _M_UR = kernel.M_THETA, kernel.M_RATE, kernel.M_UT, kernel.M_UP, kernel.M_UR

_compile = compiled(error_model="numpy", fastmath={"contract"})


def torsion_of(problem: Problem, elements: BladeElements) -> tuple[BladeTorsion, TorsionState]:
    """Both halves of an elastic blade."""
    assert problem.torsion is not None
    assert elements.torsion is not None
    return problem.torsion, elements.torsion


def torsion_residual(problem: Problem, elements: BladeElements) -> Array:
    """Elastic twist less what the loads make of it [rad], (modes, functions)."""
    _, blade = torsion_of(problem, elements)
    return torsion_error(problem, elements.state, blade.coordinates, modal_moments(problem, elements))


def torsion_error(problem: Problem, state: TrimState, elastic: Array, modal: Array) -> Array:
    """The same from the coordinates of the elastic twist, (modes, functions), and `modal_moments`."""
    torsion = problem.torsion
    assert torsion is not None
    return _torsion_error(
        torsion.shapes.analyse(modal), elastic, torsion.coupling, torsion.modal_tip_mass, torsion.modal_inertia,
        torsion.dynamic, torsion.gain, problem.given_torsion, state.coning, state.cyclic_1c, state.cyclic_1s,
    )  # fmt: skip


@_compile
def _torsion_error(
    load: Any, elastic: Any, coupling: Any, tip_mass: Any, inertia: Any, dynamic: Any, gain: Any, given: Any,
    coning: float, cyclic_1c: float, cyclic_1s: float,
) -> Any:  # fmt: skip
    """`torsion_error` from the harmonics of the modal moments, (modes, functions), which become those of all loads."""
    out = np.empty_like(elastic)
    for k in range(len(load)):
        load[k, 0] += tip_mass[k] * coning
        load[k, 1] += inertia[k] * cyclic_1c
        load[k, 2] += inertia[k] * cyclic_1s
        for h in range(load.shape[1]):
            for other in range(len(load)):
                load[k, h] += coupling[k, other] * elastic[other, h]
            out[k, h] = dynamic[k, h] * elastic[k, h] - gain[k] * load[k, h] + given[k, h]
    return out


def modal_moments(problem: Problem, elements: BladeElements) -> Array:
    """Σ along the blade of Φ_k (dC_M/dr − j ½ sin 2θ), (modes, azimuths)."""
    torsion, blade = torsion_of(problem, elements)
    return _modal_moments(torsion.shapes.radial, torsion.inertia, blade.moments[kernel.MOMENT], elements.theta)


def torsion_slopes(problem: Problem, elements: BladeElements, by_unknown: Slopes) -> tuple[Array, Array | None]:
    """∂(torsion residual) by the trim unknowns, then by the elastic coordinates, (columns, unknowns + columns).

    Beside it those by the terms of an inflow that answers the load, (columns, terms), see `InflowColumns.rows`.
    """
    torsion, blade = torsion_of(problem, elements)
    shapes, unknowns = torsion.shapes, by_unknown.unknowns
    by_trim, pairs = _moments_by_unknowns(
        by_unknown.changes, blade.moments, elements.loads[kernel.LIFT], elements.u_t, elements.theta,
        by_unknown.by_wake if by_unknown.by_wake is not None else HELD, torsion.inertia, torsion.lag, shapes.radial,
    )  # fmt: skip
    found = np.empty((shapes.columns, len(unknowns) + shapes.columns))
    found[:, : len(unknowns)] = shapes.analyse(by_trim).reshape(len(unknowns), -1).T
    found[:, len(unknowns) :] = _between_columns(torsion, pairs)
    gain, rows = _gain_of_columns(torsion), None
    if by_unknown.answer is not None:
        rows = by_unknown.answer.projected_rows(blade.moments[kernel.M_UP], shapes)
        found += by_unknown.answer.times(rows)
        rows *= -gain
    found *= -gain
    found += torsion_at_given_moments(torsion, unknowns)
    return found, rows


@lru_cache(maxsize=32)
def _gain_of_columns(torsion: BladeTorsion) -> Array:
    """1/(m_k ν_k²) of every column, (columns, 1)."""
    return np.repeat(torsion.gain, len(torsion.shapes.waves))[:, None]


@_compile
def _moments_by_unknowns(
    changes: Any, moments: Any, lift: Any, u_t: Any, theta: Any, by_wake: Any, inertia: Any, lag: Any, shapes: Any
) -> Any:  # fmt: skip
    """Σ along the blade of Φ_k ∂(moment) by the unknowns, (unknowns, modes, azimuths), and Φ_k Φ_l ∂(moment).

    The latter by θ and by θ', (modes, modes, 2, azimuths). The moment is that of the air and of the propeller; the lift
    acts x behind the pitch axis, and follows the loss factor.
    """
    (modes, n), unknowns, m = shapes.shape, len(changes.theta), theta.shape[1]
    out, pairs = np.zeros((unknowns, modes, m)), np.zeros((modes, modes, 2, m))
    row, pitching, by_ut, by_up = np.empty(m), np.empty(m), np.empty(m), np.empty(m)
    for i in range(n):
        rating, m_ut, m_up, m_ur = moments[_M_RATE, i], moments[_M_UT, i], moments[_M_UP, i], moments[_M_UR, i]
        rising, tangential = lift[i], u_t[i]
        _pitching(inertia[i], moments[_M_THETA, i], theta[i], pitching)
        for k in range(unknowns):
            if changes.pitches[k]:
                for j in range(m):
                    row[j] = pitching[j] * changes.theta[k, j] + rating[j] * changes.rate[k, j]
            else:
                velocity_changes(changes, k, i, by_wake, by_ut, by_up)
                chain_rule(m_ut, m_up, m_ur, by_ut, by_up, changes.u_r, k, row)
                if lag[i] * changes.loss[k, i] != 0.0:
                    add_product(-lag[i] * changes.loss[k, i], rising, tangential, row)
            for one in range(modes):
                for j in range(m):
                    out[k, one, j] += shapes[one, i] * row[j]
        for one in range(modes):
            for other in range(modes):
                both = shapes[one, i] * shapes[other, i]
                for j in range(m):
                    pairs[one, other, 0, j] += both * pitching[j]
                    pairs[one, other, 1, j] += both * rating[j]
    return out, pairs


@_compile
def _pitching(inertia: float, by_theta: Any, theta: Any, out: Any) -> None:
    """∂(moment of the air and propeller moment)/∂θ of one row."""
    for j in range(len(out)):
        out[j] = by_theta[j] - inertia * of_double_angle(theta[j])[1]


@lru_cache(maxsize=32)
def torsion_at_given_moments(torsion: BladeTorsion, unknowns: tuple[Unknown, ...]) -> Array:
    """∂(torsion residual) at given moments of the air and propeller moment, (columns, unknowns + columns)."""
    modes, functions = torsion.dynamic.shape
    load = np.zeros((modes, functions, len(unknowns)))
    for k, unknown in enumerate(unknowns):
        if unknown in ("cyclic_1c", "cyclic_1s"):
            load[:, 1 if unknown == "cyclic_1c" else 2, k] = torsion.modal_inertia
        if unknown == "coning":
            load[:, 0, k] = torsion.modal_tip_mass
    own, same = np.zeros((modes, functions, modes, functions)), list(range(functions))
    own[:, same, :, same] = torsion.coupling
    columns = modes * functions
    found = np.hstack([load.reshape(columns, -1), own.reshape(columns, columns)])
    found *= -np.repeat(torsion.gain, functions)[:, None]
    found[:, len(unknowns) :] += np.diag(torsion.dynamic.ravel())
    return found


def pitch_slope(torsion: BladeTorsion, elements: BladeElements) -> Array:
    """∂(moment of the air and propeller moment)/∂θ, (elements, azimuths)."""
    assert elements.torsion is not None
    return elements.torsion.moments[kernel.M_THETA] - propeller_moment(torsion.inertia, elements.theta)[1]


@_compile
def propeller_moment(inertia: Any, theta: Any) -> Any:
    """j ½ sin 2θ and its slope j cos 2θ, (2, elements, azimuths)."""
    n, m = theta.shape
    out = np.empty((2, n, m))
    for i in range(n):
        for j in range(m):
            sine, cosine = of_double_angle(theta[i, j])
            out[0, i, j] = 0.5 * inertia[i] * sine
            out[1, i, j] = inertia[i] * cosine
    return out


@_compile
def _modal_moments(shapes: Any, inertia: Any, moment: Any, theta: Any) -> Any:
    """`modal_moments`."""
    out = np.zeros((len(shapes), theta.shape[1]))
    for i in range(len(theta)):
        add_modal_moments(shapes[:, i], inertia[i], moment[i].copy(), theta[i], out)
    return out


@_compile
def add_modal_moments(shapes: Any, inertia: float, moment: Array, theta: Array, out: Any) -> None:
    """Add one row to `modal_moments`; dC_M/dr becomes the moment with that of the propeller."""
    for j in range(len(theta)):
        moment[j] -= 0.5 * inertia * of_double_angle(theta[j])[0]
    for k in range(len(shapes)):
        for j in range(len(theta)):
            out[k, j] += shapes[k] * moment[j]


@_compile
def of_double_angle(angle: float) -> Any:
    """sin and cos of twice an angle, to 4·10⁻¹⁶ (tested), without branches so that loops over it become vector code.

    Of the rest y after turns of π/2 with the polynomials of Cephes for |y| ≤ π/4 (S. Moshier, Methods and Programs for
    Mathematical Functions, 1989); each turn changes both signs.
    """
    turns = math.floor(angle * (2.0 / math.pi) + 0.5)
    sign = 1.0 - 2.0 * (turns - 2.0 * math.floor(0.5 * turns))
    y = (angle - turns * 1.5707963267948966) - turns * 6.123233995736766e-17
    s = y * y
    sine = 1.58962301576546568e-10 * s - 2.50507477628578073e-8
    sine = ((sine * s + 2.75573136213857245e-6) * s - 1.98412698295895386e-4) * s + 8.33333333332211859e-3
    sine = y + y * s * (sine * s - 1.66666666666666307e-1)
    cosine = -1.13585365213876817e-11 * s + 2.08757008419747317e-9
    cosine = ((cosine * s - 2.75573141792967388e-7) * s + 2.48015872888517045e-5) * s - 1.38888888888730564e-3
    cosine = 1.0 - 0.5 * s + s * s * (cosine * s + 4.16666666666665929e-2)
    return sign * 2.0 * sine * cosine, sign * (1.0 - 2.0 * sine * sine)


def _between_columns(torsion: BladeTorsion, pairs: Array) -> Array:
    """`HarmonicShapes.project` of ∂(moment)/∂θ · column + ∂(moment)/∂θ' · its rate, (columns as rows, columns).

    pairs: as `_moments_by_unknowns` returns.
    """
    modes, functions = torsion.dynamic.shape
    blocks = (pairs.reshape(modes * modes, -1) @ _products(torsion.shapes)).reshape(modes, modes, functions, functions)
    return blocks.transpose(0, 2, 1, 3).reshape(modes * functions, modes * functions)


@lru_cache(maxsize=32)
def _products(shapes: HarmonicShapes) -> Array:
    """Every function of ψ as `HarmonicShapes.project` weighs it times every function, then times every rate.

    (2 × azimuths, functions as rows × functions).
    """
    analysis = (shapes.waves * shapes.weights[:, None]).T[:, :, None]
    products = [analysis * waves.T[:, None, :] for waves in (shapes.waves, shapes.rates)]
    return np.concatenate(products).reshape(2 * shapes.waves.shape[1], -1)


def _loads(problem: Problem, elements: BladeElements) -> Array:
    """All moments per unit of r about the pitch axis, inertia included, (elements, azimuths)."""
    torsion, blade = torsion_of(problem, elements)
    disk, state, shapes = problem.disk, elements.state, torsion.shapes
    elastic = (blade.coordinates * -(shapes.wave**2)) @ shapes.waves
    cyclic = -(state.cyclic_1c * disk.cos + state.cyclic_1s * disk.sin)
    found = _all_moments(
        blade.moments[kernel.MOMENT], elements.theta, torsion.inertia, torsion.tip_mass * state.coning, shapes.radial,
        elastic, cyclic,
    )  # fmt: skip
    if problem.active_rates[1].size > 1:
        found -= torsion.inertia[:, None] * problem.active_rates[1]
    return found


@_compile
def _all_moments(
    moment: Any, theta: Any, inertia: Any, coned: Any, shapes: Any, elastic: Any, cyclic: Any
) -> Any:  # fmt: skip
    """dC_M/dr − j (θ'' + ½ sin 2θ) + w β0, with θ'' = Σ Φ_k q_k'' and that of the cyclic, (azimuths,)."""
    n, m = theta.shape
    out, acceleration = np.empty((n, m)), np.empty(m)
    for i in range(n):
        acceleration[:] = cyclic
        for k in range(len(shapes)):
            for j in range(m):
                acceleration[j] += shapes[k, i] * elastic[k, j]
        for j in range(m):
            turned = acceleration[j] + 0.5 * of_double_angle(theta[i, j])[0]
            out[i, j] = moment[i, j] - inertia[i] * turned + coned[i]
    return out


def control_loads(problem: Problem, elements: BladeElements) -> tuple[Array, float]:
    """Moment of the control system on one blade, and the power that moves the pitching blades.

    The moment [N m], nose up, (azimuths,), is what balances all loads on the blade. The power, over ρA(ΩR)³, is that of
    pitch links and actuators. The links take it from the shaft, because the swashplate does not move. Inertia,
    propeller moment, tension and elasticity store energy and give it back, so once torsion is in balance it is what the
    air takes, −Σ dC_M θ'.
    """
    torsion, blade = torsion_of(problem, elements)
    disk, state = problem.disk, elements.state
    loads = _loads(problem, elements)
    total = loads.sum(axis=0)
    moment = -torsion.moment_unit * disk.dr * total
    cyclic = state.cyclic_1s * disk.cos - state.cyclic_1c * disk.sin
    work = -float(total @ cyclic) * disk.dr
    if problem.active_rates[0].size > 1:
        work -= float(np.vdot(loads, problem.active_rates[0])) * disk.dr
        twist = problem.twist[:, None] + problem.active
        modal = torsion.tension.T @ (blade.coordinates @ torsion.shapes.waves)
        work += float(((torsion.own_tension @ twist + modal) * problem.active_rates[0]).sum())
    return moment, work / len(disk.psi)
