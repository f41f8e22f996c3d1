"""The equations of a trim transposed, and their solution without new derivatives.

With the multipliers a of the trim equations R and torsion equations T, and the weights Aᵀv on the load d through the
inflow, the slopes of the Lagrangian of a measure P at every blade element are

    w_z = ∂P/∂F_z − a·∂R/∂F_z + Aᵀv,    w_x = ∂P/∂F_x − a·∂R/∂F_x,    w_m = −a·∂T/∂M,
    ∂L/∂(θ, U_T, U_P, U_R) = ∂P/∂(θ, U_T, U_P, U_R) + w_z ∂F_z/∂(…) + w_x ∂F_x/∂(…) + w_m ∂M/∂(…).

Those by the unknowns are sums of these. They vanish where a is the adjoint and v = ∂L/∂λ; the sums over the azimuth of
∂L/∂θ are then the gradient by the pitch of each element. The wake needs only the sums s of v with its terms, so one
pass over the blade elements takes a and s to what is left of both. The derivatives of a trim nearby solve the system
nearly: the conjugate residual method (Eisenstat, Elman and Schultz, SIAM J. Numer. Anal. 20, 1983) with these as its
preconditioner ends after a few passes.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg.lapack import dgetrf

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem
from rotor.aero.inflow.dynamic_wake import DynamicWakeFeedback, TermColumns
from rotor.aero.inflow.interface import ResponseTerms, TermResponse
from rotor.aero.sums import sums_at_given_loads, unknown_changes
from rotor.aero.torsion_balance import pitch_slope, torsion_at_given_moments
from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.trim.equations import balance_of, unknowns_of
from rotor.trim.newton import Derivatives

TOLERANCE = 1e-11
"""Error of a gradient at which the passes end, as a fraction of it."""
MOST_PASSES = 9
"""Passes after which new derivatives are evaluated instead: they cost more by then. Our choice."""

BY_THETA, BY_UT, BY_INFLOW, TENSION = range(4)
"""Rows of the slopes by element: by θ, U_T and λ, and by θ through the tension on the twist of an elastic blade."""

_FZ_THETA, _FZ_UT, _FZ_UP, _FZ_UR = kernel.FZ_THETA, kernel.FZ_UT, kernel.FZ_UP, kernel.FZ_UR
_FX_THETA, _FX_UT, _FX_UP, _FX_UR = kernel.FX_THETA, kernel.FX_UT, kernel.FX_UP, kernel.FX_UR
_LIFT = kernel.LIFT
_M_UT, _M_UP, _M_UR, _M_RATE = kernel.M_UT, kernel.M_UP, kernel.M_UR, kernel.M_RATE

_NO_FIELD = np.zeros((0, 0))
_NO_FIELDS = np.zeros((0, 0, 0))
_NO_TERMS = ResponseTerms(
    _NO_FIELD, _NO_FIELD, _NO_FIELD, np.zeros(0, dtype=np.int64), _NO_FIELD, np.zeros((3, 0)), _NO_FIELD
)


class _Blade(NamedTuple):
    """What a pass needs of the blade elements, as arrays for compiled code; empty where a design has none of it."""

    loads: Array
    moments: Array
    pitching: Array
    """∂(moment of the air and propeller moment)/∂θ, (elements, azimuths)."""
    u_t: Array
    u_p: Array
    friction: Array
    """∂F_x/∂µ_x of the friction of radial flow."""
    r: Array
    arm: Array
    lag: Array
    cos: Array
    sin: Array
    beta: Array
    weights: Array
    """Of the sums over the disk in the trim equations, times the cell of the grid, (equations, sums)."""
    direct: Array
    """∂(equations)/∂(unknowns) at given loads and moments, (equations + columns, unknowns + columns)."""
    around: Array
    """∂(θ, U_T, U_P, U_P over its arm, U_R, θ') by the unknowns at every azimuth, (unknowns, 6 azimuths)."""
    u_t_along: Array
    loss: Array
    wake: Array
    """∂(µ_x, µ_z, λ0) by the unknowns, (unknowns, 3)."""
    by_wake: Array
    """∂λ_i by these of a model that does not depend on the load, (3, elements × azimuths)."""
    mu_z: Array
    """µ_z in the place of the shaft tilt where the friction follows it, (unknowns,)."""
    by_loss: bool
    shapes: Array
    waves: Array
    rates: Array
    """Of the elastic twist."""
    modal: Array
    """From multipliers of the torsion equations to moments, (modes, functions)."""
    tension: Array
    """From multipliers of their means to the tension on the twist, (modes, elements)."""


class _Nearby(NamedTuple):
    """Derivatives of a trim nearby, as arrays for compiled code."""

    jacobian: Array
    pivots: Any
    """Factors of the transposed Jacobian, a column in each row."""
    feedback: Array
    feedback_pivots: Any
    """Those of (I − T B (K/F) Bᵀ)ᵀ."""
    columns: Array
    """The terms of the inflow by unknowns and elastic coordinates, (columns, terms)."""
    by_terms: Array
    """∂(equations)/∂(terms), (equations + columns, terms)."""


class TransposedTrim:
    """The transposed equations at the blade elements of a trim."""

    def __init__(self, problem: Problem, elements: BladeElements) -> None:
        self._elements, self.unknowns = elements, unknowns_of(problem.design)
        self._problem, unknowns, trims = problem, self.unknowns, len(self.unknowns)
        disk, torsion, response = problem.disk, problem.torsion, elements.response
        changes, forces = unknown_changes(problem, elements, unknowns), balance_of(problem, elements)
        direct = np.zeros((trims + problem.given_torsion.size, trims + problem.given_torsion.size))
        direct[:trims, :trims] = forces.besides_sums(unknowns)
        direct[:trims, :trims] += forces.weights @ sums_at_given_loads(problem, elements, unknowns)
        shapes = waves = rates = modal = pitching = _NO_FIELD
        moments = _NO_FIELDS
        if torsion is not None and elements.torsion is not None:
            direct[trims:] = torsion_at_given_moments(torsion, unknowns)
            shapes, waves, rates = torsion.shapes.radial, torsion.shapes.waves, torsion.shapes.rates
            modal = torsion.gain[:, None] * torsion.shapes.weights
            moments, pitching = elements.torsion.moments, pitch_slope(torsion, elements)
        terms = response.terms() if isinstance(response, TermResponse) else None
        self._terms = terms if terms is not None else _NO_TERMS
        prescribed = response is not None and not problem.inflow.load_dependent
        self._tilt = "shaft_tilt" in unknowns and problem.design.models.disk_axial_flow
        mu_z = np.zeros(trims)
        if self._tilt:
            mu_z[unknowns.index("shaft_tilt")] = elements.flow.mu_z
        self._blade = _Blade(
            loads=elements.loads,
            moments=moments,
            pitching=pitching,
            u_t=elements.u_t,
            u_p=elements.u_p,
            friction=elements.friction.fx_slope if self._tilt and elements.friction is not None else _NO_FIELD,
            r=disk.r,
            arm=changes.arm,
            lag=torsion.lag if torsion is not None else np.zeros_like(disk.r),
            cos=disk.cos,
            sin=disk.sin,
            beta=elements.beta,
            weights=forces.weights * (disk.dr / len(disk.psi)),
            direct=direct,
            around=np.hstack([changes.theta, changes.u_t, changes.u_p, changes.u_p_arm, changes.u_r, changes.rate]),
            u_t_along=changes.u_t_along,
            loss=changes.loss,
            wake=changes.wake,
            by_wake=response.by_wake.reshape(3, -1) if prescribed and response is not None else _NO_FIELD,
            mu_z=mu_z,
            by_loss=bool(elements.loss_slopes.any()),
            shapes=shapes,
            waves=waves,
            rates=rates,
            modal=modal,
            tension=torsion.gain[:, None] * torsion.tension if torsion is not None else np.zeros((0, len(disk.r))),
        )

    def direct(self, swirl: Array, tilt: float) -> Array:
        """A measure's slopes by the unknowns beside those through `given` of `with_nearby`, (unknowns,).

        swirl: the measure's slopes by the swirl of each element, (elements,); tilt: that by the shaft tilt.
        """
        out = -(self._blade.u_t_along @ swirl)
        if self._tilt:
            out[self.unknowns.index("shaft_tilt")] += tilt
        return out

    def with_nearby(self, derivatives: Derivatives, given: Array, direct: Array) -> Array | None:
        """Slopes of a measure at each element, the trim following, (4, elements), see `BY_THETA`.

        given: the measure's slopes by F_z, F_x, λ_i, θ, U_T, U_P and U_R at every element, (7, elements, azimuths);
        direct: those by the unknowns beside, (unknowns,). None where the derivatives are of a trim too far away, or the
        inflow model has no terms.
        """
        factors: Any = _NO_FIELD, np.zeros(0, dtype=np.int32), _NO_FIELD, _NO_FIELD
        if self._problem.inflow.load_dependent:
            feedback, answer, by_terms = derivatives.feedback, derivatives.answer, derivatives.by_terms
            if not isinstance(feedback, DynamicWakeFeedback) or not isinstance(answer, TermColumns) or by_terms is None:
                return None
            columns = np.ascontiguousarray(answer.coefficients.T)
            # Without what no term can hold, which a pass adds by itself.
            by_terms = np.ascontiguousarray(by_terms[:, : columns.shape[1]])
            factors = feedback.lu[0].T, feedback.lu[1], columns, by_terms
        jacobian, pivots, _ = dgetrf(derivatives.jacobian.T)
        found, converged = _conjugate_residuals(
            self._blade, self._terms, _Nearby(jacobian.T, pivots, *factors), given, direct, TOLERANCE, MOST_PASSES
        )
        return found if converged else None

    def with_own(self, derivatives: Derivatives, given: Array, direct: Array) -> Array:
        """The same with the derivatives of this very trim: one solution and one pass."""
        blade = self._blade
        no_load = np.zeros((0, len(blade.cos)))
        multipliers: Array = np.zeros(len(derivatives.jacobian))
        slopes, _, _, source = _pass(blade, multipliers, _NO_FIELD, no_load, _NO_FIELD, _NO_FIELD, given)
        slopes[: len(direct)] += direct
        if derivatives.feedback is not None and derivatives.answer is not None:
            slopes += derivatives.answer.times(derivatives.answer.rows(source[None]))[0]
        multipliers = np.asarray(np.linalg.solve(derivatives.jacobian.T, slopes), dtype=np.float64)
        if derivatives.feedback is None:
            return _pass(blade, multipliers, _NO_FIELD, no_load, _NO_FIELD, _NO_FIELD, given)[1]
        source = _pass(blade, multipliers, _NO_FIELD, no_load, _NO_FIELD, _NO_FIELD, given)[3]
        on_load = np.ascontiguousarray(derivatives.feedback.solve_transposed(source)[1])
        return _pass(blade, multipliers, np.eye(len(on_load)), on_load, _NO_FIELD, _NO_FIELD, given)[1]


_compile = compiled(error_model="numpy", fastmath={"contract", "reassoc"})


@_compile
def _conjugate_residuals(
    blade: Any, terms: Any, nearby: Any, given: Any, direct: Any, tolerance: float, most: int
) -> Any:  # fmt: skip
    """Slopes by element, and whether their error fell to the tolerance; it ends where more passes are to be expected.

    Every pass takes the part of what is left away that its change of the slopes can: with the preconditioner C,
    C(slopes) is made as small as the changes C(pass(step)) of all steps together allow.
    """
    size, own = len(blade.direct), len(terms.place)
    load = np.zeros((0, len(blade.cos)))
    slopes, found, on_terms, _ = _pass(
        blade, np.zeros(size), terms.load_shapes, load, terms.inflow_shapes, terms.beyond, given
    )
    slopes[: len(direct)] += direct
    rest = _correction(nearby, slopes, _sums(terms, on_terms))
    changes, steps = np.zeros((most, size + own)), np.zeros((most, size + own))
    gains = np.zeros((most, *found.shape))
    largest, before = 0.0, math.inf
    for k in range(most):
        steps[k] = rest
        if own > 0:
            load = _around(terms, rest[size:])
        slopes, gains[k], on_terms, _ = _pass(
            blade, rest[:size], terms.load_shapes, load, terms.inflow_shapes, terms.beyond, given[:0]
        )
        if own > 0:
            slopes[: len(blade.wake)] += blade.wake @ (terms.by_wake @ rest[size:])
        changes[k] = -_correction(nearby, slopes, _sums(terms, on_terms) - rest[size:])
        for i in range(k):
            share = changes[k] @ changes[i]
            changes[k] -= share * changes[i]
            steps[k] -= share * steps[i]
            gains[k] -= share * gains[i]
        length = math.sqrt(changes[k] @ changes[k])
        if length == 0.0:
            return found, True
        changes[k] /= length
        steps[k] /= length
        gains[k] /= length
        share = changes[k] @ rest
        found += share * gains[k]
        rest = rest - share * changes[k]
        largest = max(largest, np.abs(gains[k, 0] + gains[k, 3]).max())
        error = largest * math.sqrt(rest @ rest) / np.abs(found[0] + found[3]).max()
        if error <= tolerance:
            return found, True
        if k > 3 and not error * (error / before) ** (most - 1 - k) <= tolerance:
            return found, False
        before = error
    return found, False


@_compile
def _correction(nearby: Any, slopes: Any, sums: Any) -> Any:
    """Multipliers, then sums, that take given slopes by the unknowns and given sums away at the trim nearby."""
    size = len(slopes)
    out = np.empty(size + len(sums))
    if len(sums) > 0:
        slopes = slopes + nearby.columns @ sums
    out[:size] = _solve(nearby.jacobian, nearby.pivots, slopes)
    if len(sums) > 0:
        out[size:] = _solve(nearby.feedback, nearby.feedback_pivots, sums - out[:size] @ nearby.by_terms)
    return out


@_compile
def _solve(factors: Any, pivots: Any, right: Any) -> Any:
    """The solution of equations from LAPACK's factors, of which each row holds a column."""
    n, out = len(right), right.copy()
    for k in range(n):
        out[k], out[pivots[k]] = out[pivots[k]], out[k]
    for k in range(n):
        for i in range(k + 1, n):
            out[i] -= factors[k, i] * out[k]
    for k in range(n - 1, -1, -1):
        out[k] /= factors[k, k]
        for i in range(k):
            out[i] -= factors[k, i] * out[k]
    return out


@_compile
def _around(terms: Any, sums: Any) -> Any:
    """Tᵀ s at every azimuth, (shapes, azimuths)."""
    waves = len(terms.waves)
    spectrum = np.zeros(terms.load_shapes.shape[1] * waves)
    coefficients = sums @ terms.transfer
    for k in range(len(sums)):
        spectrum[terms.place[k]] = coefficients[k]
    return spectrum.reshape(-1, waves) @ terms.waves


@_compile
def _sums(terms: Any, along: Any) -> Any:
    """Sums with the terms from those with the shapes along the blade, (shapes, azimuths) → (terms,)."""
    out = np.empty(len(terms.place))
    if len(out) == 0:
        return out
    spectrum = (along @ terms.waves.T).ravel()
    for k in range(len(out)):
        out[k] = spectrum[terms.place[k]]
    return out


@_compile
def _pass(
    blade: Any, multipliers: Any, load_shapes: Any, load: Any, inflow_shapes: Any, beyond: Any, given: Any
) -> Any:  # fmt: skip
    """One pass over the blade elements, see above.

    Slopes by the unknowns, slopes by element, and ∂L/∂λ: its sums along the blade with the shapes of the terms, and the
    field. load: what Aᵀv has of each of the `load_shapes`, (shapes, azimuths). given: as in `with_nearby`; without it
    all of this is linear in multipliers and load.
    """
    loads, moments, wake = blade.loads, blade.moments, blade.wake
    trims, n, m, modes = len(blade.weights), len(blade.r), len(blade.cos), len(blade.shapes)
    sums = multipliers[:trims] @ blade.weights
    trim = _around_disk(sums, blade.beta, blade.cos, blade.sin)
    modal = np.zeros((0, m))
    if modes > 0:
        modal = (multipliers[trims:].copy().reshape(blade.modal.shape) * blade.modal) @ blade.waves
    w_z = load_shapes @ load if len(load) > 0 else np.zeros((n, m))
    inflow, by_twist = np.empty((n, m)), np.zeros((2, modes, m))
    along, by_element, by_loss = np.zeros((6, m)), np.zeros((4, n)), np.zeros(n)
    rows = np.zeros((6, m))
    w_x, w_m, by_theta, by_ut, by_ur, rate = rows[0], rows[1], rows[2], rows[3], rows[4], rows[5]
    rubbing, past = 0.0, 0.0
    for i in range(n):
        by_up = inflow[i]
        _add_trim_weights(trim[0], trim[1], trim[2], blade.arm[i], sums[5] * blade.r[i], w_z[i], w_x)
        if len(given) > 0:
            _add(given[0, i], w_z[i])
            _add(given[1, i], w_x)
        _by_loads(w_z[i], w_x, loads[_FZ_THETA, i], loads[_FX_THETA, i], by_theta)
        _by_loads(w_z[i], w_x, loads[_FZ_UT, i], loads[_FX_UT, i], by_ut)
        _by_loads(w_z[i], w_x, loads[_FZ_UP, i], loads[_FX_UP, i], by_up)
        _by_loads(w_z[i], w_x, loads[_FZ_UR, i], loads[_FX_UR, i], by_ur)
        if modes > 0:
            w_m[:] = 0.0
            for k in range(modes):
                _add_times(blade.shapes[k, i], modal[k], w_m)
            _by_moments(
                w_m, blade.pitching[i], moments[_M_UT, i], moments[_M_UP, i], moments[_M_UR, i], moments[_M_RATE, i],
                by_theta, by_ut, by_up, by_ur, rate,
            )  # fmt: skip
            _add(rate, along[5])
        if len(given) > 0:
            _add(given[3, i], by_theta)
            _add(given[4, i], by_ut)
            _add(given[5, i], by_up)
            _add(given[6, i], by_ur)
        for k in range(modes):
            _add_times(blade.shapes[k, i], by_theta, by_twist[0, k])
            _add_times(blade.shapes[k, i], rate, by_twist[1, k])
        _add_along(blade.arm[i], by_theta, by_ut, by_up, by_ur, along)
        if len(given) > 0:
            _add(given[2, i], by_up)
        by_element[0, i], by_element[1, i], by_element[2, i] = _sums_of(by_theta, by_ut, by_up)
        if blade.by_loss:
            by_loss[i] = _by_loss(loads[_LIFT, i], blade.u_t[i], blade.u_p[i], w_z[i], w_x, blade.lag[i], w_m)
        if len(blade.friction) > 0:
            rubbing += _dot(blade.friction[i], w_x)
        if len(beyond) > 0:
            past += _dot(beyond[i], by_up)
    slopes = -(multipliers @ blade.direct)
    if modes > 0:
        by_element[3] = -(multipliers[trims :: blade.modal.shape[1]].copy() @ blade.tension)
        slopes[trims:] += (by_twist[0] @ blade.waves.T + by_twist[1] @ blade.rates.T).ravel()
    slopes[:trims] += blade.around @ along.ravel() + blade.u_t_along @ by_element[1] + blade.loss @ by_loss
    for k in range(trims):
        slopes[k] += (wake[k, 1] + wake[k, 2]) * past - blade.mu_z[k] * rubbing
    if len(blade.by_wake) > 0:
        slopes[:trims] += wake @ (blade.by_wake @ inflow.ravel())
    on_terms = inflow_shapes @ inflow if len(inflow_shapes) > 0 else np.zeros((0, m))
    return slopes, by_element, on_terms, inflow


@_compile
def _around_disk(sums: Any, beta: Any, cos: Any, sin: Any) -> Any:
    """−∂(weighted sums over the disk) by F_z, by F_z times its arm and by F_x, but for the torque, (3, azimuths)."""
    thrust, drag, mean, cosine, sine, _ = sums
    out = np.empty((3, len(cos)))
    for j in range(len(cos)):
        out[0, j] = drag * beta[j] * cos[j] - thrust
        out[1, j] = -mean - 2.0 * (cosine * cos[j] + sine * sin[j])
        out[2, j] = -drag * sin[j]
    return out


@_compile
def _add_trim_weights(lift: Any, turn: Any, pull: Any, arm: float, torque: float, w_z: Any, w_x: Any) -> None:
    """w_z more by −a·∂R/∂F_z, and w_x, of one row."""
    for j in range(len(w_x)):
        w_z[j] += lift[j] + arm * turn[j]
        w_x[j] = pull[j] - torque


@_compile
def _by_loads(w_z: Any, w_x: Any, by_fz: Any, by_fx: Any, out: Any) -> None:
    for j in range(len(out)):
        out[j] = w_z[j] * by_fz[j] + w_x[j] * by_fx[j]


@_compile
def _by_moments(
    w_m: Any, pitching: Any, m_ut: Any, m_up: Any, m_ur: Any, m_rate: Any, by_theta: Any, by_ut: Any, by_up: Any,
    by_ur: Any, rate: Any,
) -> None:  # fmt: skip
    for j in range(len(w_m)):
        by_theta[j] += w_m[j] * pitching[j]
        by_ut[j] += w_m[j] * m_ut[j]
    for j in range(len(w_m)):
        by_up[j] += w_m[j] * m_up[j]
        by_ur[j] += w_m[j] * m_ur[j]
    for j in range(len(w_m)):
        rate[j] = w_m[j] * m_rate[j]


@_compile
def _add_along(arm: float, by_theta: Any, by_ut: Any, by_up: Any, by_ur: Any, along: Any) -> None:
    for j in range(len(by_up)):
        along[0, j] += by_theta[j]
        along[1, j] += by_ut[j]
    for j in range(len(by_up)):
        along[2, j] += by_up[j]
        along[3, j] += arm * by_up[j]
        along[4, j] += by_ur[j]


@_compile
def _add(row: Any, to: Any) -> None:
    for j in range(len(to)):
        to[j] += row[j]


@_compile
def _add_times(factor: float, row: Any, to: Any) -> None:
    for j in range(len(to)):
        to[j] += factor * row[j]


@_compile
def _dot(first: Any, second: Any) -> float:
    total = 0.0
    for j in range(len(first)):
        total += first[j] * second[j]
    return total


@_compile
def _sums_of(first: Any, second: Any, third: Any) -> Any:
    one, two, three = 0.0, 0.0, 0.0
    for j in range(len(first)):
        one += first[j]
        two += second[j]
        three += third[j]
    return one, two, three


@_compile
def _by_loss(lift: Any, u_t: Any, u_p: Any, w_z: Any, w_x: Any, lag: float, w_m: Any) -> float:
    """The slope by the loss factor: lift is normal to the air, and acts behind the pitch axis."""
    total = 0.0
    for j in range(len(lift)):
        total += lift[j] * ((w_z[j] - lag * w_m[j]) * u_t[j] + w_x[j] * u_p[j])
    return total
