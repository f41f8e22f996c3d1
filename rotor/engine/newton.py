"""Newton's method on the Jacobian, corrected by what its steps have shown.

Unknowns mean the same on every number of azimuths, so derivatives are evaluated on few, and a start without derivatives
is solved there first. Factors are kept over several steps and for the next solution: with each step they are corrected
by Broyden's rank-one change (Math. Comp. 19, 1965), which needs no new factors,

    H ← H + (s − H y)(W s)ᵀ H / (W s)ᵀ H y,    s: step, y: change of R, W: what changes of an unknown do to R.

The residual has to meet the same tolerance, whatever the derivatives of the steps. The first two Jacobians of a
solution leave out what forces remember; all others are exact.

Where a whole step raises the residual, part of it is taken: until the residual falls, or the next step with the same
derivatives is shorter (natural monotonicity; P. Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3).
Near stall the residual has to rise on the way to a trim.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dgetrf, dgetrs, sgetrf, sgetrs

from rotor.engine.linearise import Grid, Point, System, begin, evaluate, jacobian, transposed
from rotor.support.arrays import Array

_COARSE_RATIO = 1e6
"""Residual over its tolerance to which a trim is solved on few azimuths. Our choice."""
LAST_STEP_RATIO = 3.0
"""Expected residual over its tolerance at which a step may well be the last. Our choice: 2 of 144 trims expect more."""
_HOPED = 0.1
"""Part of the residual that a first step with kept factors is expected to leave. Our choice."""
MOST_SLOW_STEPS = 4
"""Steps that hardly reduce the residual before the iteration ends."""
_MOST_RISES = 3
"""Steps that raise the residual before the iteration ends. Our choice."""
_LEAST_PART = 1.0 / 64.0
"""Part of a step below which it is not divided further. Our choice."""
_MOST_FORGETFUL = 2
"""How often a solution evaluates derivatives without what forces remember: to form these takes as long as a third of
all the rest, and they spare steps near deep stall only. Our choice."""
_MOST_PRODUCTS = 40
"""Products with a Jacobian after which factors nearby do not serve for its transposed."""
KRYLOV_TOLERANCE = 1e-10
"""Residual over the right side at which such a solution ends. Our choice."""
_SINGLE_PRECISION_FROM = 200
"""Equations from which factors are kept in single precision: what a step misses by it, the next one corrects."""


@dataclass(frozen=True, eq=False)
class Factors:
    """LU factors of a Jacobian, in single precision where there are many equations."""

    lu: Array
    pivots: Array
    weight: Array
    """W, the squares of the columns in units of the tolerances, (equations,)."""

    @classmethod
    def of(cls, point: Point) -> "Factors":
        """Factors of the Jacobian at a point with slopes."""
        matrix = jacobian(point)[0]
        return cls.of_matrix(matrix, point.system.tolerance**-2.0 @ matrix**2)

    @classmethod
    def of_matrix(cls, matrix: Array, weight: Array | None = None) -> "Factors":
        """Factors of a Jacobian, which is spent; without W where no steps are made with them."""
        if len(matrix) < _SINGLE_PRECISION_FROM:
            lu, pivots, singular = dgetrf(matrix.T, overwrite_a=True)
        else:
            lu, pivots, singular = sgetrf(matrix.T.astype(np.float32, order="F"), overwrite_a=True)
        weight = np.zeros(len(matrix)) if weight is None else weight
        return cls(lu, pivots, np.full_like(weight, math.nan) if singular else weight)

    @property
    def usable(self) -> bool:
        return bool(np.isfinite(self.weight).all())

    def solve(self, right: Array, *, transposed: bool = False) -> Array:
        """J⁻¹ b or J⁻ᵀ b."""
        solver = dgetrs if self.lu.dtype == np.float64 else sgetrs
        return np.asarray(
            solver(self.lu, self.pivots, right, trans=int(not transposed))[0], dtype=np.float64
        )


@dataclass(frozen=True)
class NewtonLimits:
    """How hard a solution is tried."""

    most_passes: int = 60
    most_steps: float = 4.0
    """Derivatives are evaluated again when more steps than this are to be expected with those of this solution:
    derivatives cost as much as two to four, and one or two steps follow them."""
    most_kept_steps: float = 4.0
    """The same with factors of an earlier solution."""
    most_steps_on_few: float = 2.0
    """Most steps with derivatives on few azimuths: these derivatives serve all later steps."""
    kept_ratio: float = 0.03
    """Factors are kept for the next solution where the last step left less than this part of the residual."""
    slopes: bool = True
    """Whether the last point is to have partial derivatives, for slopes of measures."""


DEFAULT_LIMITS = NewtonLimits()


@dataclass(frozen=True, eq=False)
class Solved:
    """Where the iteration ended."""

    point: Point
    passes: int
    """Evaluations of the equations."""
    factors: Factors | None
    """Factors of the last step, where they left little of the residual."""


def solve_transposed(
    point: Point, right: Array, near: Factors, tolerance: float = KRYLOV_TOLERANCE
) -> Array | None:
    """J⁻ᵀ b at a point with slopes, from the factors of a Jacobian nearby; None where these are too far.

    By flexible generalised minimal residuals (Saad, SIAM J. Sci. Comput. 14, 1993): with factors in single precision
    the preconditioner is not quite linear, so every step that it makes is kept. g is normal to the columns of the
    Hessenberg matrix: the residual is |b|/|g|.
    """
    size = float(np.linalg.norm(right))
    basis, steps = (
        np.empty((_MOST_PRODUCTS + 1, len(right))),
        np.empty((_MOST_PRODUCTS, len(right))),
    )
    hessenberg, g = np.zeros((_MOST_PRODUCTS + 1, _MOST_PRODUCTS)), np.ones(_MOST_PRODUCTS + 1)
    if not size:
        return np.zeros_like(right)
    basis[0] = right / size
    for k in range(_MOST_PRODUCTS):
        known, column = basis[: k + 1], hessenberg[:, k]
        steps[k] = near.solve(basis[k], transposed=True)
        new = transposed(point, steps[k])[0]
        for _ in range(2):  # One pass of Gram–Schmidt loses digits, so do two.
            shares = known @ new
            new -= shares @ known
            column[: k + 1] += shares
        column[k + 1] = length = max(float(np.linalg.norm(new)), 1e-300)
        basis[k + 1] = new / length
        g[k + 1] = -(g[: k + 1] @ column[: k + 1]) / length
        if float(np.linalg.norm(g[: k + 2])) * tolerance >= 1.0:
            q, r = np.linalg.qr(hessenberg[: k + 2, : k + 1])
            return np.asarray(np.linalg.solve(r, size * q[0]), dtype=np.float64) @ steps[: k + 1]
    return None


class _Corrected:
    """Factors, and the corrections of the steps made with them."""

    def __init__(self, factors: Factors) -> None:
        self.factors = factors
        self._updates: list[tuple[Array, Array]] = []
        self._before: Array | None = None
        """H R at the point before."""
        self.taken: Array | None = None
        """The last step."""

    def begin(self) -> None:
        """Forget the last step, for steps from elsewhere."""
        self._before = self.taken = None

    def step(self, residual: Array) -> Array:
        """−H R, after the correction by the last step."""
        step = self.factors.solve(residual)
        for change, along in self._updates:
            step += change * (along @ step)
        if self._before is not None and self.taken is not None:
            shown = step - self._before  # H y
            along = self.factors.weight * self.taken
            length = float(along @ shown)
            if length:
                change = (self.taken - shown) / length
                self._updates.append((change, along))
                step = step + change * (along @ step)
        self._before = step
        return -step


def solve(
    system: System, x: Array, factors: Factors | None = None, limits: NewtonLimits = DEFAULT_LIMITS
) -> Solved:
    """From x = (1, numbers, states): with factors on all azimuths at once, else on few azimuths first."""
    run = _Steps(system, factors, limits)
    if factors is None and system.thin is not system.grid and limits.most_passes > 1:
        near = run(system.thin, x, _COARSE_RATIO, limits.most_steps_on_few)
        if near.size <= _COARSE_RATIO:
            x = near.x
        else:  # Only all azimuths, from the same start, decide whether there is a solution.
            run = _Steps(system, None, limits, run.passes)
    point = run(system.grid, x, 1.0, limits.most_steps)
    return Solved(point, run.passes, run.latest if run.serving else None)


class _Steps:
    """The steps of one solution."""

    def __init__(
        self, system: System, factors: Factors | None, limits: NewtonLimits, passes: int = 0
    ) -> None:
        self.passes = passes
        self.latest = factors
        self.serving = factors is not None
        """Whether the last step left little of the residual."""
        self._made = 0
        """How often derivatives were evaluated."""
        self._system, self._limits = system, limits
        self._corrected = _Corrected(factors) if factors is not None else None

    def __call__(self, grid: Grid, x: Array, goal: float, most_steps: float) -> Point:
        """Steps until the residual is within `goal` times the tolerance, or no more progress is made."""
        system, limits, slow_steps, rises, near = (
            self._system,
            self._limits,
            0,
            0,
            self._corrected is not None,
        )
        if self._corrected is not None:
            self._corrected.begin()
        judged = system.nodes is None or x[system.structure.given :].any()
        if judged:
            point = self._at(grid, x, slopes=not near and grid is system.thin, flow=near)
        else:
            point, self.passes = begin(system, grid, x), self.passes + 1
        expected = _HOPED * point.size if near else math.inf
        while point.size > goal and self.passes < limits.most_passes:
            if slow_steps >= MOST_SLOW_STEPS or rises >= _MOST_RISES:
                break
            fresh = self._corrected is None
            corrected = self._corrected or self._differentiate(point)
            if not corrected.factors.usable:
                break
            step = corrected.step(point.residual)
            if not np.isfinite(step).all():
                break
            length = self._length(step)
            step /= max(1.0, length)
            part, last, nearer = 1.0, expected <= LAST_STEP_RATIO, False
            trial = self._moved(point, step, last)
            while fresh and trial.size >= point.size:
                after = self._length(corrected.factors.solve(trial.residual))
                nearer = after < (1.0 - 0.25 * part / max(1.0, length)) * length
                if nearer or part <= _LEAST_PART or self.passes >= limits.most_passes:
                    break
                part *= 0.5
                trial = self._moved(point, part * step, last)
            corrected.taken = part * step
            self.serving = trial.size <= limits.kept_ratio * point.size
            most = most_steps if self._made else limits.most_kept_steps
            if judged and steps_left(trial.size, point.size, goal) > most:
                self._corrected = None
            # Not the first step from `begin`, which shows how far the nodes were off.
            judged = True
            expected = trial.size * min(trial.size / point.size, 1.0)
            if trial.size >= point.size and not fresh:
                self._corrected = None  # The old derivatives do not serve here: take the step again with new ones.
                continue
            # The residual is expected to fall to 1 − hoped of itself.
            hoped = part / max(1.0, length)
            rises += nearer
            slow_steps = (
                slow_steps + 1
                if trial.size > (1.0 - 0.1 * hoped) * point.size and not nearer
                else 0
            )
            if trial.size < point.size or nearer or slow_steps < MOST_SLOW_STEPS:
                point = trial
        return point

    def _length(self, step: Array) -> float:
        """Length of a step, in units of the largest allowed."""
        return float((np.abs(step) / self._system.limits).max())

    def _at(self, grid: Grid, x: Array, *, slopes: bool = False, flow: bool = False) -> Point:
        self.passes += 1
        return evaluate(self._system, grid, x, slopes=slopes, flow=flow)

    def _moved(self, point: Point, step: Array, last: bool) -> Point:
        """A step on; where it may well be the last, with all that a solution and its adjoint need."""
        x = point.x.copy()
        x[self._system.free] += step
        return self._at(point.grid, x, slopes=last and self._limits.slopes, flow=last)

    def _differentiate(self, point: Point) -> _Corrected:
        """New factors, on few azimuths."""
        system = self._system
        near = (
            point
            if point.grid is system.thin
            else evaluate(system, system.thin, point.x, slopes=True)
        )
        if not near.slopes.shape[1]:
            near = evaluate(system, system.thin, point.x, slopes=True)
        self._made += 1
        self.latest = Factors.of(near.forgetful if self._made <= _MOST_FORGETFUL else near)
        self._corrected = _Corrected(self.latest)
        return self._corrected


def steps_left(size: float, before: float, goal: float) -> float:
    """How many more steps reach the goal, if each leaves the same part of the residual as the last one did."""
    if size <= goal:
        return 0.0
    return math.log(size / goal) / math.log(before / size) if size < before else math.inf
