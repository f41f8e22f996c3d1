"""Hover: blade element momentum theory, annulus by annulus (thesis §2.4), for a given thrust.

Each annulus balances the momentum it gives the air with the lift of its blade elements,

    4 F λ|λ| r = dC_T/dr(θ − λ/r),

from (2.24) with λ_c = 0 and Prandtl's F. With a lift curve C_lα α the balance closes as eq. (3.3).
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from rotor.aero import kernel
from rotor.aero.elements import BladeElements, Problem
from rotor.aero.inflow import Wake
from rotor.aero.losses import loss_factor
from rotor.aero.trim_state import TrimState
from rotor.airfoil.sections import Section
from rotor.arrays import Array
from rotor.trim.options import DEFAULT_OPTIONS, SolverOptions

LIFT_CURVE_MACH = 0.3
"""Mach number at which the linear lift curve of (3.3) is read off; the document's polar has no other."""

_LARGEST_INFLOW = 0.6
"""Bracket of λ, far above any annulus of a rotor."""
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


def hover(problem: Problem, start: float | None = None, options: SolverOptions = DEFAULT_OPTIONS) -> HoverResult:
    """Collective for a thrust equal to the weight; Newton with a bracket, from an optional collective [rad]."""
    annuli = Annuli(problem)
    low, high = -0.3, _LARGEST_COLLECTIVE
    solidity = problem.design.rotor.solidity
    theta0 = (
        start if start is not None else 6.0 * problem.weight / (solidity * 5.9) + 1.5 * math.sqrt(problem.weight / 2)
    )
    best = (math.inf, theta0)
    capped = False
    for _ in range(60):
        thrust, slope = annuli.thrust(theta0)
        error = thrust - problem.weight
        if abs(error) < best[0]:
            best = abs(error), theta0
        if abs(error) <= options.hover_tolerance * problem.weight or high - low < 1e-14:
            break
        if error < 0.0 and slope > 0.0:
            low = theta0
        else:
            high = theta0
            capped = capped or error > 0.0
        step = -error / slope if slope > 0.0 else math.inf
        theta0 = theta0 + min(max(step, -0.1), 0.1) if math.isfinite(step) else 0.5 * (low + high)
        if not low < theta0 < high:
            theta0 = 0.5 * (low + high)
    thrust, _ = annuli.thrust(best[1])
    residual = abs(thrust - problem.weight) / problem.weight
    return HoverResult(
        elements=annuli.over_disk(best[1], thrust),
        residual=residual,
        converged=residual <= options.accepted_hover,
        passes=annuli.passes,
        reached=thrust / problem.weight,
    )


class Annuli:
    """The annuli at a collective; the last inflow is the next start."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.passes = 0
        disk = problem.disk
        self.inflow = np.full_like(disk.r, math.sqrt(problem.weight / 2.0))
        self.ones = np.ones_like(disk.r)
        self.lift_slope, self.zero_lift = lift_curve(problem)

    def loads(self, theta0: float, inflow: Array) -> Array:
        """Section loads with derivatives, (rows, elements)."""
        problem, disk = self.problem, self.problem.disk
        self.passes += 1
        return kernel.element_loads(
            (problem.twist + theta0)[:, None], disk.r[:, None], inflow[:, None], self.ones, problem.tip_mach,
            disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
        )[:, :, 0]  # fmt: skip

    def momentum(self, inflow: Array) -> tuple[Array, Array]:
        """4Fλ|λ|r and its slope by λ."""
        models, rotor, r = self.problem.design.models, self.problem.design.rotor, self.problem.disk.r
        factor, slope = loss_factor(
            r, inflow, rotor.blades, rotor.blade.root_cutout, tip=models.tip_loss, hub=models.hub_loss
        )
        size = np.abs(inflow)
        return 4.0 * factor * inflow * size * r, 4.0 * r * size * (2.0 * factor + slope * inflow)

    def lift(self, theta0: float, inflow: Array) -> tuple[Array, Array, Array]:
        """Lift of the momentum balance, and its slopes by pitch and by λ."""
        if self.problem.design.models.hover_inflow == "annulus":
            loads = self.loads(theta0, inflow)
            return loads[kernel.FZ], loads[kernel.FZ_THETA], loads[kernel.FZ_UP]
        disk = self.problem.disk
        gain = disk.half_solidity * self.lift_slope
        pitch = self.problem.twist + theta0 - self.zero_lift
        return gain * (pitch * disk.r**2 - inflow * disk.r), gain * disk.r**2, -gain * disk.r

    def solve(self, theta0: float) -> tuple[Array, Array]:
        """λ(r) that balances every annulus, and ∂λ/∂θ; safeguarded Newton on all annuli at once."""
        inflow = self.inflow
        low, high = np.full_like(inflow, -_LARGEST_INFLOW), np.full_like(inflow, _LARGEST_INFLOW)
        by_pitch = slope = np.ones_like(inflow)
        for _ in range(80):
            momentum, momentum_slope = self.momentum(inflow)
            lift, by_pitch, by_inflow = self.lift(theta0, inflow)
            error, slope = momentum - lift, momentum_slope - by_inflow
            if np.abs(error).max() <= 1e-15 + 1e-13 * np.abs(lift).max():
                break
            low = np.where(error < 0.0, inflow, low)
            high = np.where(error > 0.0, inflow, high)
            step = np.where(slope > 0.0, -error / np.where(slope > 0.0, slope, 1.0), np.inf)
            ahead = inflow + step
            inflow = np.where((ahead > low) & (ahead < high), ahead, 0.5 * (low + high))
            if (high - low).max() < 1e-15:
                break
        self.inflow = inflow
        return inflow, by_pitch / np.maximum(slope, 1e-12)

    def thrust(self, theta0: float) -> tuple[float, float]:
        """C_T and ∂C_T/∂θ0, the change of inflow included."""
        inflow, response = self.solve(theta0)
        loads = self.loads(theta0, inflow)
        dr = self.problem.disk.dr
        slope = loads[kernel.FZ_THETA] + loads[kernel.FZ_UP] * response
        return float(loads[kernel.FZ].sum() * dr), float(slope.sum() * dr)

    def at(self, theta0: float) -> tuple[BladeElements, Array]:
        """The whole disk at a collective, and ∂λ/∂θ of each annulus, (elements,)."""
        _, response = self.solve(theta0)
        thrust, _ = self.thrust(theta0)
        return self.over_disk(theta0, thrust), response

    def over_disk(self, theta0: float, thrust: float) -> BladeElements:
        """The hovering rotor as blade elements over the whole disk."""
        problem, disk = self.problem, self.problem.disk
        shape = disk.shape

        def everywhere(values: Array) -> Array:
            return np.repeat(values[:, None], shape[1], axis=1)

        induced = everywhere(self.inflow)
        theta = everywhere(problem.twist + theta0)
        u_t = everywhere(disk.r)
        loads = np.repeat(self.loads(theta0, self.inflow)[:, :, None], shape[1], axis=2)
        moment = float(((disk.r - problem.flap.hinge) * loads[kernel.FZ, :, 0]).sum() * disk.dr)
        coning = (problem.flap.load_gain * moment - problem.flap.weight) / problem.flap.frequency_squared
        if not problem.design.models.flapping:
            coning = 0.0
        state = TrimState(collective=theta0, coning=coning, lambda0=math.sqrt(max(thrust, 0.0) / 2.0))
        return BladeElements(
            state, Wake(0.0, 0.0, state.lambda0), theta, u_t, induced, induced, None,
            self.ones, np.zeros((2, shape[0])), np.full(shape[1], coning), loads,
        )  # fmt: skip
