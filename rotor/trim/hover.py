"""Hover and axial flight: blade element momentum theory, annulus by annulus (thesis §2.4), for a given thrust.

Each annulus balances the momentum it gives the air with the lift of its blade elements,

    4 F λ_i|λ| r = dC_T/dr(θ − λ/r),    λ = λ_c + λ_i,

which is (2.24) with Prandtl's F; λ_c = 0 in hover. With a lift curve C_lα α the balance closes as eq. (2.28), in hover
(3.3).
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rotor.aero import kernel
from rotor.aero.elastic import TorsionState, air_moments
from rotor.aero.elements import BladeElements, Problem, swirl_of
from rotor.aero.inflow import Wake
from rotor.aero.losses import HUB_FACTOR, end_factor
from rotor.aero.momentum import axial_inflow
from rotor.aero.trim_state import TrimState
from rotor.airfoil.sections import Section
from rotor.arrays import Array
from rotor.compiled import compiled
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions

LIFT_CURVE_MACH = 0.3
"""Mach number at which the linear lift curve of (3.3) is read off; the document's polar has no other."""

_LARGEST_INFLOW = 0.6
"""Bracket of λ, far above any annulus of a rotor."""
_MOST_PASSES = 80
"""Evaluations after which a balance of annuli ends as it is."""
_LARGEST_COLLECTIVE = math.radians(40.0)


def closed_form_inflow(
    r: ArrayLike,
    pitch: ArrayLike,
    solidity: ArrayLike,
    lift_slope: float,
    *,
    factor: ArrayLike = 1.0,
    climb: float = 0.0,
) -> Array:
    """λ(r) of eq. (2.28), with the loss factor F of eq. (3.3), for a linear lift curve.

    pitch θ [rad] from the zero-lift line, lift_slope C_lα [1/rad], climb λ_c; shapes broadcast. (3.3) is (2.28) with
    λ_c = 0 and σ → σ/F, the outer 1/F included; it closes 4Fλ²r = ½σC_lα(θr² − λr). Below zero pitch the mirrored root
    is taken.
    """
    r, pitch = np.asarray(r, dtype=float), np.asarray(pitch, dtype=float)
    k = np.asarray(solidity, dtype=float) * lift_slope / (16.0 * np.asarray(factor, dtype=float))
    sign = np.where(pitch * r < climb, -1.0, 1.0)
    half = k - sign * 0.5 * climb
    return sign * (np.sqrt(half**2 + 2.0 * k * sign * pitch * r) - half)


def lift_curve(problem: Problem) -> tuple[Array, Array]:
    """C_lα [1/rad] and the zero-lift pitch [rad] of each element's linear lift curve, (elements,); blended sections."""
    disk, blade = problem.disk, problem.design.rotor.blade
    names = dict.fromkeys(span.section for span in blade.spans)  # In the order of `Disk.tables`.
    slopes, zeros = np.array([_straight_line(blade.installed(name)) for name in names]).T
    first, second = disk.section.T
    return (
        slopes[first] + disk.weight * (slopes[second] - slopes[first]),
        zeros[first] + disk.weight * (zeros[second] - zeros[first]),
    )


@lru_cache(maxsize=64)
def _straight_line(section: Section) -> tuple[float, float]:
    zero = float(section.table.zero_lift_alpha(LIFT_CURVE_MACH)) + section.incidence_offset
    return float(section.table.lift_slope(LIFT_CURVE_MACH)), zero


@dataclass(frozen=True, eq=False)
class HoverResult:
    """Where the hover solution ended."""

    elements: BladeElements
    residual: float
    """|C_T − C_W| over C_W."""
    converged: bool
    passes: int
    """Evaluations of the blade elements."""
    reached: float
    """C_T over C_W."""


def hover(
    problem: Problem,
    start: float | None = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    elastic: Array | None = None,
) -> HoverResult:
    """Collective for a thrust equal to the weight; Newton with a bracket, from an optional collective [rad].

    On a test stand the thrust is the one given; with the collective given only the elastic twist is to be found. An
    elastic blade twists with every step; `elastic`: coordinates of its twist to begin with, (modes, functions).
    """
    annuli = Annuli(problem)
    if elastic is not None and len(elastic) == len(annuli.elastic):
        annuli.elastic = elastic[:, 0].copy()
    stand = problem.design.condition.stand
    if stand is not None and stand.collective is not None:
        thrust, _ = annuli.thrust(stand.collective)
        for _ in range(20):
            if annuli.torsion_error <= options.torsion_tolerance:
                break
            annuli.twist_with(0.0)
            thrust, _ = annuli.thrust(stand.collective)
        elements = annuli.over_disk(stand.collective, thrust)
        return HoverResult(elements, 0.0, annuli.torsion_error <= options.accepted_hover, annuli.passes, 1.0)
    low, high = -0.3, _LARGEST_COLLECTIVE
    solidity = problem.design.rotor.solidity
    theta0 = (
        start
        if start is not None
        else 6.0 * problem.weight / (solidity * 5.9)
        + 1.5 * (axial_inflow(problem.weight, problem.climb) + problem.climb)
    )
    best, twist_of_best = (math.inf, theta0), annuli.elastic
    for _ in range(60):
        thrust, slope = annuli.thrust(theta0)
        error = thrust - problem.weight
        size = max(abs(error) / problem.scale, annuli.torsion_error)
        if size < best[0]:
            best, twist_of_best = (size, theta0), annuli.elastic
        balanced = abs(error) <= options.hover_tolerance * problem.scale
        if (balanced and annuli.torsion_error <= options.torsion_tolerance) or high - low < 1e-14:
            break
        margin = 5.0 * annuli.torsion_error  # The twist still moves by about this much, and the balance with it.
        if error < 0.0 and slope > 0.0:
            low = max(low, theta0 - margin)
        else:
            high = min(high, theta0 + margin)
        step = -error / slope if slope > 0.0 else math.inf
        ahead = theta0 + min(max(step, -0.1), 0.1) if math.isfinite(step) else 0.5 * (low + high)
        if not low < ahead < high:
            ahead = 0.5 * (low + high)
        annuli.twist_with(ahead - theta0)
        theta0 = ahead
    annuli.elastic = twist_of_best
    thrust, _ = annuli.thrust(best[1])
    residual = abs(thrust - problem.weight) / problem.scale
    return HoverResult(
        elements=annuli.over_disk(best[1], thrust),
        residual=residual,
        converged=max(residual, annuli.torsion_error) <= options.accepted_hover,
        passes=annuli.passes,
        reached=thrust / problem.scale,
    )


def steady_coning(problem: Problem, loads: Array) -> float:
    """β0 of a hovering rotor under loads (rows, elements)."""
    if not problem.design.models.flapping:
        return 0.0
    if problem.design.rotor.precone is not None:
        return problem.design.rotor.precone
    moment = float(((problem.disk.r - problem.flap.hinge) * loads[kernel.FZ]).sum() * problem.disk.dr)
    return (problem.flap.load_gain * moment - problem.flap.weight) / problem.flap.frequency_squared


def steady_moments(problem: Problem, loads: Array, u_t: Array, inflow: Array) -> Array:
    """Moments of the air on an elastic hovering blade with derivatives, (rows, elements).

    loads (rows, elements); u_t, inflow λ_i (elements,) over ΩR.
    """
    assert problem.torsion is not None
    still = np.zeros_like(u_t)[:, None]
    return air_moments(
        problem.torsion, problem.disk, problem.tip_mach, u_t[:, None], inflow[:, None] + problem.climb, np.zeros(1),
        still, np.ascontiguousarray(loads[:, :, None]),
    )[:, :, 0]  # fmt: skip


@dataclass(frozen=True, eq=False)
class AnnulusSlopes:
    """Derivatives of the annuli by the pitch of each element, inflow included, and by the elastic coordinates."""

    thrust: Array
    """∂C_T by the pitch of each element, (elements,)."""
    torsion: Array
    """∂(torsion residual) by the same, (modes, elements)."""
    shapes: Array
    """Φ_k, (modes, elements)."""
    own: Array
    """∂(torsion residual) by the elastic coordinates at the same pitch, (modes, modes)."""

    @property
    def matrix(self) -> Array:
        """∂(thrust, torsion residual) by (collective, elastic coordinates), (1 + modes, 1 + modes)."""
        rows = np.concatenate([self.thrust[None], self.torsion])
        matrix = np.asarray(rows @ self.columns.T, dtype=np.float64)
        matrix[1:, 1:] += self.own
        return matrix

    @property
    def columns(self) -> Array:
        """∂θ of each element by (collective, elastic coordinates), (1 + modes, elements)."""
        return np.concatenate([np.ones((1, len(self.thrust))), self.shapes])


_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def _momentum(r: float, inflow: float, climb: float, ends: Any) -> Any:
    """4Fλ_i|λ|r of an annulus and its slope by λ_i; ends: f times |λ| of `loss_factor` at tip and root."""
    total = inflow + climb
    (tip, tip_slope), (hub, hub_slope) = end_factor(ends[0], total), end_factor(ends[1], total)
    factor, slope = tip * hub, tip_slope * hub + tip * hub_slope
    size, signed = abs(total), math.copysign(inflow, inflow * total)
    climbing = 4.0 * r * factor * (signed - size)  # 0 in hover.
    return 4.0 * factor * inflow * size * r, 4.0 * r * size * (2.0 * factor + slope * inflow) + climbing


@_compile
def _lift(
    theta: Array, inflow: float, climb: float, swirls: bool, r: float, tip_mach: float, half_solidity: Array,
    section: Any, weight: Array, offset: Array, tables: Array, cos_sweep: Array, sin_sweep: Array,
) -> Any:  # fmt: skip
    """F_z of an annulus, and its slopes by pitch and by λ_i, the swirl included; arrays hold its one element."""
    total = inflow + climb
    swirl, slope = swirl_of(r, inflow * total) if swirls else (0.0, 0.0)
    loads = kernel.element_loads(
        theta.reshape((1, 1)), np.full((1, 1), r - swirl), np.full((1, 1), total), np.zeros(1), np.ones(1), tip_mach,
        half_solidity, section, weight, offset, tables, cos_sweep, sin_sweep,
    )[:, 0, 0]  # fmt: skip
    by_inflow = loads[kernel.FZ_UP] - loads[kernel.FZ_UT] * (inflow + total) * slope
    return loads[kernel.FZ], loads[kernel.FZ_THETA], by_inflow


@_compile
def _linear_lift(angle: float, total: float, r: float, gain: float) -> Any:
    """The same for a linear lift curve and small angles, as (2.28) takes it; gain: ½σ C_lα."""
    return gain * (angle * r**2 - total * r), gain * r**2, -gain * r


@_compile
def _balance(
    theta: Array, start: Array, climb: float, swirls: bool, r: Array, ends: Array, closed: bool, lift_slope: Array,
    zero_lift: Array, tip_mach: float, half_solidity: Array, section: Any, weight: Array, offset: Array, tables: Array,
    cos_sweep: Array, sin_sweep: Array,
) -> Any:  # fmt: skip
    """λ_i and ∂λ_i/∂θ of every annulus, (2, elements), and the most evaluations of one.

    Newton's method with a bracket. closed: with the linear lift curve.
    """
    out, most = np.empty((2, len(r))), 0
    for i in range(len(r)):
        one = slice(i, i + 1)
        inflow, low, high, passes = start[i], -_LARGEST_INFLOW, _LARGEST_INFLOW, 0
        while True:
            passes += 1
            if closed:
                gain = half_solidity[i] * lift_slope[i]
                lift, by_pitch, by_inflow = _linear_lift(theta[i] - zero_lift[i], inflow + climb, r[i], gain)
            else:
                lift, by_pitch, by_inflow = _lift(
                    theta[one], inflow, climb, swirls, r[i], tip_mach, half_solidity[one], section[one], weight[one],
                    offset[one], tables, cos_sweep[one], sin_sweep[one],
                )  # fmt: skip
            momentum, momentum_slope = _momentum(r[i], inflow, climb, ends[:, i])
            error, slope = momentum - lift, momentum_slope - by_inflow
            if abs(error) <= 1e-15 + 1e-13 * abs(lift) or high - low < 1e-15 or passes == _MOST_PASSES:
                break
            low, high = (inflow, high) if error < 0.0 else (low, inflow)
            ahead = inflow - error / slope if slope > 0.0 else math.inf
            inflow = ahead if low < ahead < high else 0.5 * (low + high)
        out[0, i], out[1, i] = inflow, by_pitch / max(slope, 1e-12)
        most = max(most, passes)
    return out, most


class Annuli:
    """The annuli at a collective and an elastic twist; the last inflow is the next start."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.passes = 0
        disk = problem.disk
        self.inflow = np.full_like(disk.r, axial_inflow(problem.scale, problem.climb))
        """λ_i"""
        self.ones = np.ones_like(disk.r)
        self.lift_slope, self.zero_lift = lift_curve(problem)
        self.elastic: Array = np.zeros(len(problem.given_torsion))
        """Steady elastic twist of each mode [rad], (modes,); empty for a rigid blade."""
        self._residual: Array = self.elastic
        self._slopes: AnnulusSlopes | None = None

    @property
    def torsion_error(self) -> float:
        """Largest residual of the torsion equations at the last `thrust` [rad]; 0 for a rigid blade."""
        return float(np.abs(self._residual).max(initial=0.0))

    def pitch(self, theta0: float) -> Array:
        """θ of each element, (elements,)."""
        torsion = self.problem.torsion
        pitch = self.problem.twist + theta0
        return pitch if torsion is None else pitch + torsion.shapes.radial.T @ self.elastic

    def loads(self, theta0: float, inflow: Array) -> Array:
        """Section loads with derivatives, (rows, elements)."""
        problem, disk = self.problem, self.problem.disk
        self.passes += 1
        u_t = disk.r - self.swirl(inflow)[0]
        return kernel.element_loads(
            self.pitch(theta0)[:, None], u_t[:, None], inflow[:, None] + problem.climb, np.zeros(1), self.ones,
            problem.tip_mach, disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables, disk.cos_sweep,
            disk.sin_sweep,
        )[:, :, 0]  # fmt: skip

    def moments(self, loads: Array, inflow: Array) -> Array:
        """Moments of the air with derivatives, (rows, elements), of an elastic blade."""
        return steady_moments(self.problem, loads, self.problem.disk.r - self.swirl(inflow)[0], inflow)

    def swirl(self, inflow: Array) -> tuple[Array, Array]:
        """Swirl of each annulus over ΩR and its slope by λ_i, (elements,)."""
        if not self.problem.design.models.has("swirl"):
            return np.zeros_like(inflow), np.zeros_like(inflow)
        total = inflow + self.problem.climb
        swirl, slope = swirl_of(self.problem.disk.r, inflow * total)
        return swirl, (inflow + total) * slope

    def by_inflow(self, loads: Array, inflow: Array, fz_or_fx: int) -> Array:
        """∂F_z or ∂F_x by λ_i at the same pitch: through U_P, and through the swirl in U_T."""
        by_t, by_p = (kernel.FZ_UT, kernel.FZ_UP) if fz_or_fx == kernel.FZ else (kernel.FX_UT, kernel.FX_UP)
        return loads[by_p] - loads[by_t] * self.swirl(inflow)[1]

    def solve(self, theta0: float) -> tuple[Array, Array]:
        """λ_i(r) that balances every annulus, and ∂λ_i/∂θ."""
        problem, disk = self.problem, self.problem.disk
        models, rotor = problem.design.models, problem.design.rotor
        far = np.full_like(disk.r, math.inf)
        ends = np.stack([
            0.5 * rotor.blades * (1.0 - disk.r) if models.tip_loss else far,
            0.5 * HUB_FACTOR * (disk.r - rotor.blade.root_cutout) if models.hub_loss else far,
        ])  # fmt: skip
        closed = models.hover_inflow != "annulus"
        (self.inflow, response), passes = _balance(
            self.pitch(theta0), self.inflow, problem.climb, models.has("swirl"), disk.r, ends, closed, self.lift_slope,
            self.zero_lift, problem.tip_mach, disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
            disk.cos_sweep, disk.sin_sweep,
        )  # fmt: skip
        self.passes += 0 if closed else passes
        return self.inflow, response

    def thrust(self, theta0: float) -> tuple[float, float]:
        """C_T and ∂C_T/∂θ0, the change of inflow and of elastic twist included."""
        inflow, response = self.solve(theta0)
        loads = self.loads(theta0, inflow)
        dr = self.problem.disk.dr
        slope = loads[kernel.FZ_THETA] + self.by_inflow(loads, inflow, kernel.FZ) * response
        thrust, by_collective = float(loads[kernel.FZ].sum() * dr), float(slope.sum() * dr)
        if self.problem.torsion is None:
            return thrust, by_collective
        self._residual, self._slopes = self._torsion(theta0, loads, slope * dr, response)
        matrix = self._slopes.matrix
        error, twisting = np.linalg.solve(matrix[1:, 1:], np.stack([self._residual, matrix[1:, 0]], axis=1)).T
        return thrust - float(matrix[0, 1:] @ error), by_collective - float(matrix[0, 1:] @ twisting)

    def twist_with(self, step: float) -> None:
        """Newton's step of the elastic twist that goes with a step of the collective."""
        if self._slopes is not None:
            matrix = self._slopes.matrix
            self.elastic = self.elastic - np.linalg.solve(matrix[1:, 1:], self._residual + matrix[1:, 0] * step)

    def _torsion(
        self, theta0: float, loads: Array, thrust_slope: Array, response: Array
    ) -> tuple[Array, AnnulusSlopes]:
        """Residual of the torsion equations, (modes,), and the derivatives by pitch."""
        problem, torsion = self.problem, self.problem.torsion
        assert torsion is not None
        dr, theta, arm = problem.disk.dr, self.pitch(theta0), problem.disk.r - problem.flap.hinge
        moments = self.moments(loads, self.inflow)
        modal = torsion.gain[:, None] * torsion.shapes.radial * dr
        air = moments[kernel.M_THETA] + (moments[kernel.M_UP] - moments[kernel.M_UT] * self._turning()) * response
        lifted = torsion.gain * torsion.modal(torsion.tip_mass)
        hinged = problem.design.models.flapping and problem.design.rotor.precone is None
        gain = problem.flap.load_gain / problem.flap.frequency_squared if hinged else 0.0
        residual = (
            self.elastic
            - modal @ (moments[kernel.MOMENT] - 0.5 * torsion.inertia * np.sin(2.0 * theta))
            - torsion.gain * (torsion.coupling @ self.elastic)
            - lifted * self.coning(loads)
            + problem.given_torsion[:, 0]
        )
        by_pitch = -modal * (air - torsion.inertia * np.cos(2.0 * theta)) - gain * np.outer(lifted, arm * thrust_slope)
        own = np.eye(len(self.elastic)) - torsion.gain[:, None] * torsion.coupling
        return residual, AnnulusSlopes(thrust_slope, by_pitch, torsion.shapes.radial, own)

    def _turning(self) -> Array:
        """∂(swirl)/∂λ of each annulus, (elements,)."""
        return self.swirl(self.inflow)[1]

    def coning(self, loads: Array) -> float:
        """β0 under loads (rows, elements)."""
        return steady_coning(self.problem, loads)

    def at(self, theta0: float) -> tuple[BladeElements, Array, AnnulusSlopes | None]:
        """The whole disk at a collective, ∂λ/∂θ of each annulus, (elements,), and the slopes of an elastic blade."""
        _, response = self.solve(theta0)
        thrust, _ = self.thrust(theta0)
        return self.over_disk(theta0, thrust), response, self._slopes

    def over_disk(self, theta0: float, thrust: float) -> BladeElements:
        """The hovering rotor as blade elements over the whole disk."""
        problem, disk = self.problem, self.problem.disk
        shape = disk.shape

        def everywhere(values: Array) -> Array:
            return np.repeat(values[:, None], shape[1], axis=1)

        induced = everywhere(self.inflow)
        theta = everywhere(self.pitch(theta0))
        swirl = self.swirl(self.inflow)[0]
        u_t = everywhere(disk.r - swirl)
        section_loads = self.loads(theta0, self.inflow)
        loads = np.repeat(section_loads[:, :, None], shape[1], axis=2)
        coning = self.coning(section_loads)
        state = TrimState(collective=theta0, coning=coning, lambda0=axial_inflow(max(thrust, 0.0), problem.climb))
        torsion = None
        if problem.torsion is not None:
            coordinates = np.zeros_like(problem.given_torsion)
            coordinates[:, 0] = self.elastic
            moments = np.repeat(self.moments(section_loads, self.inflow)[:, :, None], shape[1], axis=2)
            torsion = TorsionState(coordinates, problem.torsion.shapes.field(coordinates), np.zeros(shape), moments)
        return BladeElements(
            state, Wake(0.0, problem.climb, state.lambda0), theta, u_t, induced + problem.climb, induced, None,
            self.ones, np.zeros((2, shape[0])), np.full(shape[1], coning), loads, swirl, None, torsion,
        )  # fmt: skip
