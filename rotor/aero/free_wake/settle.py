"""Newton's method for the hovering rotor with its free wake: from a prescribed wake, or from an earlier one.

A cold start takes the circulation of annulus momentum theory and Landgrebe's wake. Newton's method follows the wake in
pseudo-time, whose step grows as the residual falls, first with half the azimuths and a wide core of the tip vortex.
Where shorter steps do not help, the circulation follows in pseudo-time too: near stall the branch of attached flow may
end, where Newton's method stops at the least residual and time goes on to separated flow. Where that fails it is run
again with small steps, and then from an easier rotor: medium thrust, milder twist, or both, approached in steps. A warm
start goes on with the factors of the last Jacobian as long as the residual falls. All ways end at the same equations
with the same tolerance.
"""

import math
from collections import deque
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from rotor.aero.free_wake import system as line
from rotor.aero.free_wake.system import (
    STEPS,
    HoverSystem,
    WakeEvaluation,
    WakeLayout,
    WakeState,
    landgrebe_radius,
    landgrebe_rates,
    layout_of,
)
from rotor.aero.momentum import axial_inflow
from rotor.aero.problem import Problem
from rotor.aero.section import stall_margins
from rotor.arrays import Array

TOLERANCE = 1e-10
"""Largest residual: of lengths over R, of circulation over ΩR², of C_T."""
_KEPT_RATIO = 0.7
"""WakeFactors are kept while a step leaves less than this part of the residual."""
_REJECTED = 3
"""Rejected steps in a row after which the circulation follows in pseudo-time as the nodes do."""
_MOST_STEPS = 40, 60
"""Passes of a stage, and those after that."""
_NEAR = 2e-3
"""Residual of the full grid from which factors are kept: a Jacobian takes as long as six residuals."""
_LONGEST_STEPS = 0.15, 0.02, 0.1
"""Largest change in a step: of a node over R, of Γ/ΩR², of the collective [rad]."""
_STAGES = ((0.08, 3e-3, 1.0), (0.04, 1e-3, 4.0), (0.02, 1e-3, 8.0))
"""With half the azimuths: what is added to the core of the tip vortex over R, the residual that suffices, and the
first step of pseudo-time in radians of wake azimuth."""


@dataclass(frozen=True, eq=False)
class Settled:
    """Where the iteration ended."""

    system: HoverSystem
    evaluation: WakeEvaluation
    converged: bool
    passes: int
    """Evaluations of the equations."""
    damped: bool = False
    """Whether the circulation had to follow in pseudo-time, so that others may be in equilibrium too."""


@dataclass(frozen=True, eq=False)
class WakeFactors:
    """A matrix in the product of its triangles."""

    lu: tuple[Array, NDArray[np.int32]]

    @classmethod
    def of(cls, matrix: Array) -> "WakeFactors":
        return cls(lu_factor(matrix, check_finite=False))

    def solve(self, right: Array, *, transposed: bool = False) -> Array:
        """The solution of A x = b or of Aᵀ x = b."""
        return lu_solve(self.lu, right, trans=1 if transposed else 0, check_finite=False)


class KeptFactors:
    """WakeFactors of the Jacobians of the last few wakes: 3 MB each, so that only the latest are worth keeping."""

    def __init__(self, most: int = 4) -> None:
        self._kept: deque[tuple[WakeState, WakeFactors]] = deque(maxlen=most)

    def of(self, state: WakeState) -> WakeFactors | None:
        """The factors kept for this very state; None where there are none.

        What is used is kept longest: all previews of a drag begin at the same wake.
        """
        for entry in list(self._kept):
            if entry[0] is state:
                with suppress(ValueError):  # Another thread has moved it.
                    self._kept.remove(entry)
                self._kept.append(entry)
                return entry[1]
        return None

    def keep(self, state: WakeState, factors: WakeFactors) -> None:
        self._kept.append((state, factors))


KEPT = KeptFactors()


def settle(
    problem: Problem, circulation: Array, collective: float, start: WakeState | None = None, *, compare: bool = True
) -> Settled:
    """The wake in equilibrium with the loads at the thrust of the problem.

    circulation Γ/ΩR² (elements,) and collective [rad] begin a cold start; `start` is an earlier wake of one layout.
    More than one wake may be in equilibrium: with one tip vortex below and another above the next blade, or with the
    root stalled or not. Where that may be so, and with `compare`, the wake that follows from that of mild twist is
    found too (after a start that went on to separated flow, that of an easier rotor), and the one of less torque is
    returned, so that it does not depend on the start.
    """
    found = _any(problem, circulation, collective, start)
    if not (compare and found.converged and _may_have_another(found)):
        return found
    easiest = _easiest(problem)
    other = _from_easier(problem, found) if found.damped else _follow(problem, easiest, found.system.layout)
    passes = found.passes + other.passes
    chosen = other if other.converged and torque(other) < torque(found) else found
    return replace(chosen, passes=passes)


def _any(problem: Problem, circulation: Array, collective: float, start: WakeState | None) -> Settled:
    """A wake in equilibrium: from an earlier one, from a prescribed one, or from that of an easier rotor."""
    layout = layout_of(problem)
    system = HoverSystem(problem, layout)
    passes = 0
    if start is not None and start.layout == layout:
        found = warm(system, start)
        passes += found.passes
        if found.converged:
            return found
    coarse = HoverSystem(problem, layout_of(problem, STEPS // 2))
    for haste in (1.0, 0.2):
        found = cold(system, coarse, circulation, collective, haste)
        passes += found.passes
        if found.converged:
            return replace(found, passes=passes)
    found = _from_easier(problem, found)
    return replace(found, passes=passes + found.passes)


def _may_have_another(found: Settled) -> bool:
    """Whether the tip vortex passes above the next blade, or a blade element is stalled."""
    at, layout, disk = found.evaluation, found.system.layout, found.system.problem.disk
    margins = stall_margins(
        at.loads[line.ALPHA][:, None], at.loads[line.MACH][:, None], (disk.r - at.swirl)[:, None],
        disk.section, disk.weight, disk.offset, disk.stall,
    )  # fmt: skip
    return float(at.height[-1, layout.steps // layout.blades]) > 0.0 or bool((margins < 0.0).any())


def torque(found: Settled) -> float:
    """∫ r dF_x, C_Q over the width of an element."""
    return float(found.system.problem.disk.r @ found.evaluation.loads[line.FX])


def preview(problem: Problem, start: WakeState) -> Settled | None:
    """One Newton step from an earlier wake, with the factors kept for it if there are any; None where it leads astray.

    The wake is close to its equilibrium, not in it.
    """
    if start.layout != layout_of(problem):
        return None
    factors = KEPT.of(start)
    system = HoverSystem(problem, start.layout)
    before = system.evaluate(start, slopes=factors is None)
    if factors is None:
        factors = _factorise(before, math.inf)
        KEPT.keep(start, factors)
    step = _limited(-factors.solve(before.residual), start.layout)
    moved = WakeState(start.layout, start.values + step)
    after = system.evaluate(moved, slopes=False)
    if not after.error < max(before.error, TOLERANCE):
        return None
    KEPT.keep(moved, factors)
    return Settled(system, after, after.error <= TOLERANCE, 2)


def warm(system: HoverSystem, start: WakeState) -> Settled:
    """Newton's method from an earlier wake with kept factors, made anew where the residual does not fall."""
    factors = KEPT.of(start)
    return _with_kept_factors(system, system.evaluate(start, slopes=factors is None), factors)


def _with_kept_factors(system: HoverSystem, point: WakeEvaluation, factors: WakeFactors | None = None) -> Settled:
    """Newton's method from an evaluation, its Jacobian factorised where no `factors` are given."""
    passes, first = 1, point.error
    while point.error > TOLERANCE and passes < 40:
        fresh = factors is None
        if factors is None:
            if not point.jacobian.size:
                point = system.evaluate(point.state)
                passes += 1
            factors = _factorise(point, math.inf)
        step = _limited(-factors.solve(point.residual), system.layout)
        trial = system.evaluate(WakeState(system.layout, point.state.values + step), slopes=False)
        passes += 1
        if not trial.error < 10.0 * max(point.error, 0.1 * first):
            if fresh:
                break
            factors = None
            continue
        if trial.error > _KEPT_RATIO * point.error:
            factors = None
            if not fresh and trial.error > point.error:
                continue
        point = trial
    converged = point.error <= TOLERANCE and _ends_below(point)
    if converged and factors is not None:
        KEPT.keep(point.state, factors)
    return Settled(system, point, converged, passes)


def cold(system: HoverSystem, coarse: HoverSystem, circulation: Array, collective: float, haste: float) -> Settled:
    """From a prescribed wake, with half the azimuths first; `haste` scales the steps of pseudo-time."""
    passes, damped = 0, False
    state = _prescribed(coarse, circulation, collective)
    for core, enough, pace in _STAGES:
        found = _pseudo_time(coarse, state, core, enough, pace * haste)
        state, passes, damped = found.evaluation.state, passes + found.passes, damped or found.damped
    found = _pseudo_time(system, _interpolated(state, coarse, system), 0.0, _NEAR, 8.0 * haste)
    passes, damped = passes + found.passes, damped or found.damped
    if found.converged:
        near = found.evaluation
        found = _with_kept_factors(system, near)
        if not found.converged:
            found = _pseudo_time(system, near.state, 0.0, TOLERANCE, 32.0 * haste)
        passes, damped = passes + found.passes, damped or found.damped
    return replace(found, passes=passes, damped=damped)


def _pseudo_time(system: HoverSystem, state: WakeState, core: float, enough: float, pace: float) -> Settled:
    """Newton's method on (unknowns − step of pseudo-time), which is Newton's own method as the step grows."""
    point = system.evaluate(state, core)
    passes, most = 1, _MOST_STEPS[0]
    factors, rejected, damped = None, 0, False
    while point.error > enough and passes < most:
        factors = _factorise(point, pace, damped=damped)
        step = _limited(-factors.solve(point.residual), system.layout)
        trial = system.evaluate(WakeState(system.layout, point.state.values + step), core)
        passes += 1
        if not trial.error <= 3.0 * point.error:
            rejected, pace = rejected + 1, 0.25 * pace
            if rejected == _REJECTED and not damped:
                damped, pace, most = True, 1.0, passes + _MOST_STEPS[1]
            if pace < 1e-3:
                break
            continue
        pace = min(pace * min(max(1.5 * point.error / max(trial.error, 1e-30), 0.5), 4.0), 1e6)
        point, rejected = trial, 0
    converged = point.error <= enough and (enough > TOLERANCE or _ends_below(point))
    if converged and enough <= TOLERANCE and factors is not None:
        KEPT.keep(point.state, factors)
    return Settled(system, point, converged, passes, damped)


def _ends_below(point: WakeEvaluation) -> bool:
    """Whether the free turns end below the disk, as the turns of constant pitch behind them take for granted."""
    return bool((point.height[:, point.state.layout.free] < 0.0).all())


def _from_easier(problem: Problem, failed: Settled) -> Settled:
    """Follow the wake from an easier rotor to the one asked for: mild twist and medium thrust, or one of them alone."""
    easiest, passes = _easiest(problem), 0
    for easy in (easiest, replace(easiest, twist=problem.twist), replace(easiest, weight=problem.weight)):
        found = _follow(problem, easy, failed.system.layout)
        passes += found.passes
        if found.converged:
            return replace(found, passes=passes)
    return replace(failed, passes=passes)


def _easiest(problem: Problem) -> Problem:
    """Medium thrust and mild linear twist."""
    solidity = problem.design.rotor.solidity
    medium = min(max(problem.weight, 0.06 * solidity), 0.09 * solidity)
    return replace(problem, weight=medium, twist=math.radians(-12.0) * (problem.disk.r - 0.75))


def _follow(problem: Problem, easy: Problem, layout: WakeLayout) -> Settled:
    """From a cold start of the easy problem in steps that shrink where Newton's method fails."""

    def between(t: float) -> Problem:
        if t == 1.0:
            return problem
        weight = easy.weight + t * (problem.weight - easy.weight)
        return replace(problem, weight=weight, twist=easy.twist + t * (problem.twist - easy.twist))

    coarse = HoverSystem(easy, layout_of(easy, STEPS // 2))
    found = cold(HoverSystem(easy, layout), coarse, *_uniform_start(easy), 1.0)
    passes, t, step = found.passes, 0.0, 0.25
    if not found.converged:
        return found
    state = found.evaluation.state
    while t < 1.0 and step > 0.02 and passes < 150:
        ahead = min(1.0, t + step)
        found = warm(HoverSystem(between(ahead), layout), state)
        passes += found.passes
        if found.converged:
            state, t, step = found.evaluation.state, ahead, 1.5 * step
        else:
            step *= 0.4
    return replace(found, converged=found.converged and t == 1.0, passes=passes)


def _uniform_start(problem: Problem) -> tuple[Array, float]:
    """Circulation that gives the thrust evenly but for the tip, and a collective for it."""
    disk = problem.disk
    shape = np.sqrt(np.minimum(1.0, (1.0 - disk.r) / 0.06)) * np.minimum(1.0, (disk.r - disk.root) / 0.1)
    circulation = shape * math.pi * problem.weight / (disk.blades * disk.dr * float(shape @ disk.r))
    slope = problem.design.rotor.solidity * 5.9
    axial = axial_inflow(problem.weight, problem.climb) + problem.climb
    return circulation, 6.0 * problem.weight / slope + 1.5 * axial


def _prescribed(system: HoverSystem, circulation: Array, collective: float) -> WakeState:
    """A wake from measured tip vortices, inboard filaments below; the circulation falls to zero at the tip."""
    problem, layout = system.problem, system.layout
    disk = problem.disk
    circulation = circulation * np.sqrt(np.minimum(1.0, (1.0 - disk.r) / 0.06))
    release = system.roll_up(circulation).release
    age: Array = layout.step * np.arange(1, layout.free + 1, dtype=np.float64)
    first = 2.0 * math.pi / layout.blades
    k1, k2 = landgrebe_rates(problem.weight, problem.design.rotor.solidity, 0.0)
    nodes = np.empty((layout.filaments, layout.free, 2))
    nodes[..., 0] = release[:, None] * landgrebe_radius(age, problem.weight)
    nodes[..., 1] = -1.5 * math.sqrt(problem.weight / 2.0) * age
    nodes[-1, :, 1] = k1 * np.minimum(age, first) + k2 * np.maximum(age - first, 0.0)
    nodes[..., 1] -= problem.climb * age
    return WakeState(layout, np.concatenate([nodes.ravel(), circulation, [collective]]))


def _interpolated(state: WakeState, coarse: HoverSystem, fine: HoverSystem) -> WakeState:
    """The same wake with the azimuths of another layout."""
    layout = fine.layout
    nodes = np.zeros((layout.filaments, coarse.layout.free + 1, 2))
    nodes[:, 1:] = state.nodes
    nodes[:, 0, 0] = fine.roll_up(state.circulation).release
    ages = layout.step * np.arange(1, layout.free + 1)
    known = coarse.layout.step * np.arange(coarse.layout.free + 1)
    moved = np.array([[np.interp(ages, known, row[:, c]) for c in range(2)] for row in nodes])
    values = np.concatenate([moved.transpose(0, 2, 1).ravel(), state.circulation, [state.collective]])
    return WakeState(layout, values)


def _factorise(point: WakeEvaluation, pace: float, *, damped: bool = False) -> WakeFactors:
    """With steps of pseudo-time of `pace` radians of wake azimuth for the nodes; `damped`: for the circulation too."""
    layout = point.state.layout
    jacobian = point.jacobian.copy()
    diagonal = np.arange(layout.geometry)
    jacobian[diagonal, diagonal] += layout.step / pace
    if damped:
        loads = np.arange(layout.geometry, layout.size - 1)
        jacobian[loads, loads] += 1.0 / pace
    return WakeFactors.of(jacobian)


def _limited(step: Array, layout: WakeLayout) -> Array:
    """The step, shortened so that no unknown moves further than `_LONGEST_STEPS`."""
    sizes = np.abs(step)
    parts = sizes[: layout.geometry].max(), sizes[layout.geometry : -1].max(), sizes[-1]
    ratios = [limit / max(float(size), 1e-30) for limit, size in zip(_LONGEST_STEPS, parts, strict=True)]
    return step * min(1.0, *ratios)


@dataclass(frozen=True, eq=False)
class WakeFilaments:
    """The vortex filaments of all blades, for drawing."""

    points: Array
    """x, y, z over R, (filaments, points, 3): blade after blade, root to tip. Blade 0 lies over the tail, ψ = 0, along
    the x-axis; y points to the advancing side, z up; the first point is on the blade."""
    core_radius: Array
    """Over R, (filaments, points)."""
    circulation: Array
    """Over ΩR², positive as that of a tip vortex, (filaments,)."""
    state: WakeState
    """The unknowns of the wake, from which an iteration may begin."""

    @property
    def tip_vortices(self) -> Array:
        """Those of `points` that leave at the tips, (blades, points, 3)."""
        return self.points[self.state.layout.filaments - 1 :: self.state.layout.filaments]


def filaments(system: HoverSystem, at: WakeEvaluation) -> WakeFilaments:
    """The filaments behind all blades in the coordinates of the rotor."""
    layout = system.layout
    blade = 2.0 * math.pi * np.arange(layout.blades) / layout.blades
    psi = blade[:, None] - layout.step * np.arange(layout.nodes)  # (blades, nodes)
    x = at.radius * np.cos(psi)[:, None]
    y = at.radius * np.sin(psi)[:, None]
    z = np.broadcast_to(at.height, x.shape)
    points = np.stack([x, y, z], axis=-1).reshape(-1, layout.nodes, 3)
    core = np.sqrt(system.core_squares(at.rolled))
    return WakeFilaments(
        points, np.tile(core, (layout.blades, 1)), np.tile(at.rolled.strength, layout.blades), at.state
    )
