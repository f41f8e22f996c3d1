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
from weakref import WeakKeyDictionary

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

TOLERANCE = 1e-10
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
_NO_PLACES = np.zeros(0, dtype=np.int64)
_NO_TERMS = ResponseTerms(
    _NO_FIELD, _NO_FIELD, _NO_FIELD, np.zeros(1, dtype=np.int64), _NO_PLACES, _NO_PLACES, _NO_FIELD, np.zeros((3, 0)),
    _NO_FIELD,
)  # fmt: skip

_ROWS = 4
"""Rows of blade elements that are summed along the blade at a time."""


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
    rubbing: Array
    """Its sums along the blade, and those over r, (2, azimuths)."""
    r: Array
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
    """Functions along the blade: those of the terms of the inflow, 1 and r − e, then zeros, (elements, shapes)."""
    through: Array
    """1, r − e, and those of the terms over F, (2 + shapes of the terms, elements and zeros)."""
    twisting: Array
    """1 and the modes of the elastic twist, (1 + modes, elements and zeros)."""
    waves: Array
    rates: Array
    """Of the elastic twist."""
    modal: Array
    """From multipliers of the torsion equations to moments, (modes, functions)."""
    tension: Array
    """From multipliers of their means to the tension on the twist, (modes, elements)."""


class Given(NamedTuple):
    """Slopes of a measure at each element, (elements, azimuths), or (0, 0) where it has none."""

    fz: Array = _NO_FIELD
    """By F_z."""
    fx: Array = _NO_FIELD
    """By F_x."""
    inflow: Array = _NO_FIELD
    """By λ_i at the same velocities."""
    theta: Array = _NO_FIELD
    """By θ at the same loads, as the next three."""
    u_t: Array = _NO_FIELD
    u_p: Array = _NO_FIELD
    u_r: Array = _NO_FIELD


_NOTHING = Given()


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


_NEARBY: WeakKeyDictionary[Derivatives, _Nearby] = WeakKeyDictionary()
"""Those of the derivatives in use."""


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
        modes = waves = rates = modal = pitching = _NO_FIELD
        moments = _NO_FIELDS
        if torsion is not None and elements.torsion is not None:
            direct[trims:] = torsion_at_given_moments(torsion, unknowns)
            modes, waves, rates = torsion.shapes.radial, torsion.shapes.waves, torsion.shapes.rates
            modal = torsion.gain[:, None] * torsion.shapes.weights
            moments, pitching = elements.torsion.moments, pitch_slope(torsion, elements)
        terms = response.terms() if isinstance(response, TermResponse) else None
        self._terms = terms if terms is not None else _NO_TERMS
        prescribed = response is not None and not problem.inflow.load_dependent
        self._tilt = "shaft_tilt" in unknowns and problem.design.models.disk_axial_flow
        mu_z, friction = np.zeros(trims), _NO_FIELD
        if self._tilt:
            mu_z[unknowns.index("shaft_tilt")] = elements.flow.mu_z
            if elements.friction is not None:
                friction = elements.friction.fx_slope
        shapes, through, twisting = _along_blade(
            self._terms.load_shapes, self._terms.inflow_shapes, modes, changes.arm, _ROWS
        )
        self._blade = _Blade(
            loads=elements.loads,
            moments=moments,
            pitching=pitching,
            u_t=elements.u_t,
            u_p=elements.u_p,
            friction=friction,
            rubbing=np.stack([np.ones_like(disk.r), disk.r]) @ friction if friction.size else np.zeros((2, 0)),
            r=disk.r,
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
            through=through,
            twisting=twisting,
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

    def with_nearby(self, derivatives: Derivatives, given: Given, direct: Array) -> Array | None:
        """Slopes of a measure at each element, the trim following, (4, elements), see `BY_THETA`.

        direct: the measure's slopes by the unknowns beside the given ones, (unknowns,). None where the derivatives are
        of a trim too far away, or the inflow model has no terms.
        """
        nearby = _NEARBY.get(derivatives)
        if nearby is None:
            nearby = self._nearby(derivatives)
            if nearby is None:
                return None
            _NEARBY[derivatives] = nearby
        found, converged = _conjugate_residuals(self._blade, self._terms, nearby, given, direct, TOLERANCE, MOST_PASSES)
        return found if converged else None

    def _nearby(self, derivatives: Derivatives) -> _Nearby | None:
        """The derivatives for compiled code; None where the inflow model has no terms."""
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
        return _Nearby(jacobian.T, pivots, *factors)

    def with_own(self, derivatives: Derivatives, given: Given, direct: Array) -> Array:
        """The same with the derivatives of this very trim: one solution and one pass."""
        blade = self._blade
        no_load = np.zeros((blade.shapes.shape[1], len(blade.cos)))
        multipliers: Array = np.zeros(len(derivatives.jacobian))
        slopes, _, _, source = _pass(blade, multipliers, no_load, _NO_FIELD, given)
        slopes[: len(direct)] += direct
        if derivatives.feedback is not None and derivatives.answer is not None:
            slopes += derivatives.answer.times(derivatives.answer.rows(source[None]))[0]
        multipliers = np.asarray(np.linalg.solve(derivatives.jacobian.T, slopes), dtype=np.float64)
        _, found, _, source = _pass(blade, multipliers, no_load, _NO_FIELD, given)
        if derivatives.feedback is None:
            return found
        on_load = derivatives.feedback.solve_transposed(source)[1]
        given = given._replace(fz=given.fz + on_load if given.fz.size else np.ascontiguousarray(on_load))
        return _pass(blade, multipliers, no_load, _NO_FIELD, given)[1]


_compile = compiled(error_model="numpy", fastmath={"contract", "reassoc"})


@_compile
def _along_blade(load_shapes: Any, inflow_shapes: Any, modes: Any, arm: Any, rows: int) -> Any:
    """`shapes`, `through` and `twisting` of `_Blade`, filled up to multiples of `rows`."""
    own, n = len(inflow_shapes), len(arm)
    full = n + -n % rows
    shapes, through = np.zeros((n, 2 + own + -(2 + own) % rows)), np.zeros((2 + own, full))
    twisting = np.zeros((1 + len(modes), full))
    for i in range(n):
        for k in range(own):
            shapes[i, k] = load_shapes[i, k]
            through[2 + k, i] = inflow_shapes[k, i]
        shapes[i, own] = through[0, i] = twisting[0, i] = 1.0
        shapes[i, own + 1] = through[1, i] = arm[i]
        for k in range(len(modes)):
            twisting[1 + k, i] = modes[k, i]
    return shapes, through, twisting


@_compile
def _conjugate_residuals(
    blade: Any, terms: Any, nearby: Any, given: Any, direct: Any, tolerance: float, most: int
) -> Any:  # fmt: skip
    """Slopes by element, and whether their error fell to the tolerance; it ends where more passes are to be expected.

    Every pass takes the part of what is left away that its change of the slopes can: with the preconditioner C,
    C(slopes) is made as small as the changes C(pass(step)) of all steps together allow.
    """
    size, own, shape = len(blade.direct), len(terms.transfer), (blade.shapes.shape[1], len(blade.cos))
    slopes, found, on_terms, _ = _pass(blade, np.zeros(size), _around(terms, np.zeros(own), shape), terms.beyond, given)
    slopes[: len(direct)] += direct
    rest = _correction(nearby, slopes, _sums(terms, on_terms))
    changes, steps = np.zeros((most, size + own)), np.zeros((most, size + own))
    gains = np.zeros((most, *found.shape))
    largest, before = 0.0, math.inf
    for k in range(most):
        steps[k] = rest
        around = _around(terms, rest[size:], shape)
        slopes, gains[k], on_terms, _ = _pass(blade, rest[:size], around, terms.beyond, _NOTHING)
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
def _around(terms: Any, sums: Any, shape: Any) -> Any:
    """Tᵀ s at every azimuth for each function along the blade, (shapes, azimuths)."""
    waves, begin, term, wave = terms.waves, terms.begin, terms.term, terms.wave
    out, coefficients = np.zeros(shape), np.zeros(len(sums) + 1)  # The last one stands where there is no term.
    if len(sums) > 0:
        coefficients[:-1] = sums @ terms.transfer
    for k in range(len(begin) - 1):
        for t in range(begin[k], begin[k + 1], 4):
            a, b, c, d = wave[t], wave[t + 1], wave[t + 2], wave[t + 3]
            by_a, by_b = coefficients[term[t]], coefficients[term[t + 1]]
            by_c, by_d = coefficients[term[t + 2]], coefficients[term[t + 3]]
            for j in range(shape[1]):
                out[k, j] += by_a * waves[a, j] + by_b * waves[b, j] + by_c * waves[c, j] + by_d * waves[d, j]
    return out


@_compile
def _sums(terms: Any, along: Any) -> Any:
    """Sums with the terms from those with the shapes along the blade, (shapes, azimuths) → (terms,)."""
    waves, begin, term, wave = terms.waves, terms.begin, terms.term, terms.wave
    out = np.zeros(len(terms.transfer) + 1)
    for k in range(len(begin) - 1):
        for t in range(begin[k], begin[k + 1], 4):
            a, b, c, d = wave[t], wave[t + 1], wave[t + 2], wave[t + 3]
            on_a, on_b, on_c, on_d = 0.0, 0.0, 0.0, 0.0
            for j in range(waves.shape[1]):
                on_a += along[k, j] * waves[a, j]
                on_b += along[k, j] * waves[b, j]
                on_c += along[k, j] * waves[c, j]
                on_d += along[k, j] * waves[d, j]
            out[term[t]], out[term[t + 1]], out[term[t + 2]], out[term[t + 3]] = on_a, on_b, on_c, on_d
    return out[:-1]


# Rows of what a pass sums along the blade at every azimuth, in the order of `_Blade.around`. By θ and by θ' times each
# mode of the elastic twist follow, then by U_P times each function of the terms.
_THETA, _UT, _UP, _UP_ARM, _UR, _RATE, _BESIDE = range(7)


@_compile
def _pass(blade: Any, multipliers: Any, around: Any, beyond: Any, given: Any) -> Any:
    """One pass over the blade elements, see above.

    Slopes by the unknowns, slopes by element, and ∂L/∂λ: its sums along the blade with the shapes of the terms, and the
    field. around: what Aᵀv has of each function along the blade, (shapes, azimuths), to which what is left of w_z is
    added. given: the measure's slopes; without them all of this is linear in multipliers and load.
    """
    loads, moments, wake, twisting = blade.loads, blade.moments, blade.wake, blade.twisting
    trims, n, m, modes, own = (
        len(blade.weights),
        len(blade.r),
        len(blade.cos),
        len(twisting) - 1,
        len(blade.through) - 2,
    )
    sums = multipliers[:trims] @ blade.weights
    pull = _around_disk(sums, blade.beta, blade.cos, blade.sin, around[own], around[own + 1])
    modal = np.zeros((modes, m))
    if modes > 0:
        modal = (multipliers[trims:].copy().reshape(blade.modal.shape) * blade.modal) @ blade.waves
    along, by_element, by_loss = np.zeros((_BESIDE + 2 * modes + own, m)), np.zeros((4, n)), np.zeros(n)
    weights, inflow = np.zeros((3, m)), np.zeros((twisting.shape[1], m))
    w_z, w_x, w_m = weights[0], weights[1], weights[2]
    by_theta, by_ut, by_ur, rate = np.zeros((4, m)), np.zeros((4, m)), np.zeros((4, m)), np.zeros((4, m))
    rubbing, past = 0.0, 0.0
    for first in range(0, n, 4):
        by_up = inflow[first : first + 4]
        for c in range(min(4, n - first)):
            i = first + c
            _weigh_lift(blade.shapes, i, around, w_z)
            _weigh_drag(pull, sums[5] * blade.r[i], w_x)
            _add(given.fz, i, w_z)
            _add(given.fx, i, w_x)
            if len(blade.friction) > 0 and len(given.fx) > 0:
                rubbing += _on_row(blade.friction, given.fx, i)
            if modes > 0:
                _weigh_moment(twisting, i, modal, w_m)
                _by_loads_and_moments(w_z, w_x, w_m, loads, _FZ_THETA, _FX_THETA, blade.pitching, i, by_theta, c)
                _by_loads_and_moments(w_z, w_x, w_m, loads, _FZ_UT, _FX_UT, moments[_M_UT], i, by_ut, c)
                _by_loads_and_moments(w_z, w_x, w_m, loads, _FZ_UP, _FX_UP, moments[_M_UP], i, by_up, c)
                _by_loads_and_moments(w_z, w_x, w_m, loads, _FZ_UR, _FX_UR, moments[_M_UR], i, by_ur, c)
                _by_moments(w_m, moments, _M_RATE, i, rate, c)
            else:
                _by_loads(w_z, w_x, loads, _FZ_THETA, _FX_THETA, i, by_theta, c)
                _by_loads(w_z, w_x, loads, _FZ_UT, _FX_UT, i, by_ut, c)
                _by_loads(w_z, w_x, loads, _FZ_UP, _FX_UP, i, by_up, c)
                _by_loads(w_z, w_x, loads, _FZ_UR, _FX_UR, i, by_ur, c)
            _add(given.theta, i, by_theta[c])
            _add(given.u_t, i, by_ut[c])
            _add(given.u_p, i, by_up[c])
            _add(given.u_r, i, by_ur[c])
            if blade.by_loss:
                by_loss[i] = _by_loss(loads[_LIFT, i], blade.u_t[i], blade.u_p[i], w_z, w_x, blade.lag[i], w_m)
        _add_rows(twisting, 0, first, by_ut, along, _UT)
        _add_rows(twisting, 0, first, by_ur, along, _UR)
        _add_rows(blade.through, 0, first, by_up, along, _UP)
        _add_rows(blade.through, 1, first, by_up, along, _UP_ARM)
        for k in range(1 + modes):
            _add_rows(twisting, k, first, by_theta, along, _THETA if k == 0 else _BESIDE + k - 1)
            if modes > 0:
                _add_rows(twisting, k, first, rate, along, _RATE if k == 0 else _BESIDE + modes + k - 1)
        for c in range(min(4, n - first)):
            i = first + c
            _add(given.inflow, i, by_up[c])
            by_element[0, i], by_element[1, i], by_element[2, i] = _sum(by_theta, c), _sum(by_ut, c), _sum(by_up, c)
            if len(beyond) > 0:
                past += _on_row(beyond, inflow, i)
        for k in range(own):
            _add_rows(blade.through, 2 + k, first, by_up, along, _BESIDE + 2 * modes + k)
    slopes = -(multipliers @ blade.direct)
    if modes > 0:
        by_element[3] = -(multipliers[trims :: blade.modal.shape[1]].copy() @ blade.tension)
        by_twist, by_rate = along[_BESIDE : _BESIDE + modes], along[_BESIDE + modes : _BESIDE + 2 * modes]
        slopes[trims:] += (by_twist @ blade.waves.T + by_rate @ blade.rates.T).ravel()
    slopes[:trims] += blade.around @ along[:_BESIDE].ravel() + blade.u_t_along @ by_element[1] + blade.loss @ by_loss
    if len(blade.friction) > 0:
        rubbing += pull @ blade.rubbing[0] - sums[5] * blade.rubbing[1].sum()
    for k in range(trims):
        slopes[k] += (wake[k, 1] + wake[k, 2]) * past - blade.mu_z[k] * rubbing
    if len(blade.by_wake) > 0:
        slopes[:trims] += wake @ (blade.by_wake @ inflow[:n].ravel())
    return slopes, by_element, along[_BESIDE + 2 * modes :], inflow[:n]


@_compile
def _around_disk(sums: Any, beta: Any, cos: Any, sin: Any, lift: Any, turn: Any) -> Any:
    """−∂(weighted sums over the disk) by F_z, by F_z times its arm and, returned, by F_x but for the torque."""
    thrust, drag, mean, cosine, sine, _ = sums
    pull = np.empty(len(cos))
    for j in range(len(cos)):
        lift[j] = drag * beta[j] * cos[j] - thrust
        turn[j] = -mean - 2.0 * (cosine * cos[j] + sine * sin[j])
        pull[j] = -drag * sin[j]
    return pull


# Of one row i of the blade elements each. In the loops one array is written and at most eight are read, four functions
# or four rows at a time: so the compiler makes vector code of them, and memory is read and written less often.


@_compile
def _weigh_lift(shapes: Any, i: int, around: Any, w_z: Any) -> None:
    """w_z, from functions along the blade and around the disk."""
    a, b, c, d = shapes[i, 0], shapes[i, 1], shapes[i, 2], shapes[i, 3]
    for j in range(len(w_z)):
        w_z[j] = a * around[0, j] + b * around[1, j] + c * around[2, j] + d * around[3, j]
    for k in range(4, shapes.shape[1], 4):
        a, b, c, d = shapes[i, k], shapes[i, k + 1], shapes[i, k + 2], shapes[i, k + 3]
        for j in range(len(w_z)):
            w_z[j] += a * around[k, j] + b * around[k + 1, j] + c * around[k + 2, j] + d * around[k + 3, j]


@_compile
def _weigh_drag(pull: Any, torque: float, w_x: Any) -> None:
    for j in range(len(w_x)):
        w_x[j] = pull[j] - torque


@_compile
def _weigh_moment(twisting: Any, i: int, modal: Any, w_m: Any) -> None:
    for j in range(len(w_m)):
        w_m[j] = twisting[1, i] * modal[0, j]
    for k in range(1, len(modal)):
        for j in range(len(w_m)):
            w_m[j] += twisting[1 + k, i] * modal[k, j]


@_compile
def _by_loads(w_z: Any, w_x: Any, loads: Any, fz: int, fx: int, i: int, out: Any, c: int) -> None:
    for j in range(len(w_z)):
        out[c, j] = w_z[j] * loads[fz, i, j] + w_x[j] * loads[fx, i, j]


@_compile
def _by_loads_and_moments(
    w_z: Any, w_x: Any, w_m: Any, loads: Any, fz: int, fx: int, moment: Any, i: int, out: Any, c: int
) -> None:  # fmt: skip
    for j in range(len(w_z)):
        out[c, j] = w_z[j] * loads[fz, i, j] + w_x[j] * loads[fx, i, j] + w_m[j] * moment[i, j]


@_compile
def _by_moments(w_m: Any, moments: Any, row: int, i: int, out: Any, c: int) -> None:
    for j in range(len(w_m)):
        out[c, j] = w_m[j] * moments[row, i, j]


@_compile
def _add_rows(functions: Any, k: int, first: int, rows: Any, out: Any, place: int) -> None:
    """Add four rows, (4, azimuths), times a function along the blade."""
    a, b, c, d = functions[k, first], functions[k, first + 1], functions[k, first + 2], functions[k, first + 3]
    for j in range(rows.shape[1]):
        out[place, j] += a * rows[0, j] + b * rows[1, j] + c * rows[2, j] + d * rows[3, j]


@_compile
def _add(field: Any, i: int, to: Any) -> None:
    """Add a field, unless there is none."""
    if len(field) > 0:
        for j in range(len(to)):
            to[j] += field[i, j]


@_compile
def _on_row(one: Any, other: Any, i: int) -> float:
    total = 0.0
    for j in range(one.shape[1]):
        total += one[i, j] * other[i, j]
    return total


@_compile
def _sum(rows: Any, c: int) -> float:
    total = 0.0
    for j in range(rows.shape[1]):
        total += rows[c, j]
    return total


@_compile
def _by_loss(lift: Any, u_t: Any, u_p: Any, w_z: Any, w_x: Any, lag: float, w_m: Any) -> float:
    """The slope by the loss factor: lift is normal to the air, and acts behind the pitch axis."""
    total = 0.0
    for j in range(len(lift)):
        total += lift[j] * ((w_z[j] - lag * w_m[j]) * u_t[j] + w_x[j] * u_p[j])
    return total
