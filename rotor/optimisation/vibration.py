"""What moving a twist does to power and to the loads on the hub: the response to n/rev twist, and fronts of both.

The response to active twist at n per revolution, tip relative to root as on a blade at rest, has for every harmonic a
cosine and a sine, A cos(nψ − φ) = a cos nψ + b sin nψ with a = A cos φ and b = A sin φ. At a trim

    J dx = −∂R/∂(a, b),    dm = ∂m/∂x dx + ∂m/∂(a, b)

gives exact slopes of the loads and of power, m, with trim, wake, bending and torsion following: the T-matrix of
higher-harmonic control (W. Johnson, Self-tuning regulators for multicyclic control of helicopter vibration, NASA
TP-1996, 1982). Its change between trims with one harmonic each gives the second order, without which power has no
least.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotor.aero.problem import given_torsion
from rotor.aero.section import RATE, TH
from rotor.aero.unsteady_section import DTH
from rotor.columns.bending import LOADS
from rotor.design.active_twist import Harmonic, PerRev, linear_active_twist, read_harmonics
from rotor.design.design import Design, require_design
from rotor.engine.linearise import jacobian
from rotor.engine.linearise import response as linear_response
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.descent import slsqp
from rotor.optimisation.evaluator import TrimHistory
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import Objective, WeightedCondition, check_index
from rotor.optimisation.results import Minimum, Optimum, SearchStatus
from rotor.optimisation.search import Search, run_search
from rotor.support.arrays import Array
from rotor.support.blas_threads import one_blas_thread
from rotor.trim.adjoint import tail_gain
from rotor.trim.analysis import Analysis, analysed
from rotor.trim.hub_loads import band_inflows, hub_index, index_of, load_units, terms_and_loads
from rotor.trim.many import analyse_many
from rotor.trim.solution import Solution
from rotor.trim.solve import analyse

STEP = math.radians(0.5)
"""Amplitude of the trims that give the second order. Our choice, half of what actuators reach."""


@dataclass(frozen=True, eq=False)
class Response:
    """The response to an active twist by a `TMatrix`."""

    power: float
    """Total power [W]."""
    index: float
    """[%]"""
    loads: dict[str, complex]
    """fx, fy, fz [N], mx, my [N m] at N_b/rev: amplitude and, as the angle, phase of A cos(N_b ψ − φ)."""


@dataclass(frozen=True, eq=False, repr=False)
class TMatrix:
    """The response of hub loads and power to n/rev twist. Columns: cosine and sine of each harmonic in turn, (2 H,)."""

    solution: Solution
    """The trim without active twist."""
    harmonics: tuple[int, ...]
    """(H,)"""
    base: Array
    """Cosine and sine at N_b ψ of fx, fy, fz [N], mx, my [N m], then total power [W], without active twist, (11,)."""
    slopes: Array
    """Slopes of `base` [1/rad], (11, 2 H)."""
    second: Array
    """Second derivatives of `base` [1/rad²], (11, 2 H, 2 H)."""

    def __repr__(self) -> str:
        design = self.solution.design
        return f"TMatrix({design.rotor.name}, mu {design.condition.advance_ratio:g}, harmonics {self.harmonics})"

    def response(self, twist_per_rev: PerRev) -> Response:
        """Response to an active twist, `N:DEG:PHASE[,…]` or as `make_design` takes it; else ValueError."""
        x = np.zeros((len(self.harmonics), 2))
        for harmonic in read_harmonics(twist_per_rev, "twist_per_rev"):
            if harmonic.per_rev not in self.harmonics:
                have = ", ".join(map(str, self.harmonics))
                raise ValueError(
                    f"the matrix has no {harmonic.per_rev}/rev: use {have}, or make it with that harmonic"
                )
            phase = np.array([math.cos(harmonic.phase), math.sin(harmonic.phase)])
            x[self.harmonics.index(harmonic.per_rev)] = harmonic.amplitude * phase
        values = self._values(x.ravel())[0]
        loads = values[:-1].reshape(-1, 2)
        amplitudes = [complex(cosine, sine) for cosine, sine in loads.tolist()]
        index = 100.0 * index_of(self.solution.design, loads)[0]
        return Response(float(values[-1]), index, dict(zip(LOADS, amplitudes, strict=True)))

    def twist(self, x: Array) -> tuple[Harmonic, ...]:
        """Active twist with these cosine and sine amplitudes [rad], (2 H,)."""
        pairs = zip(self.harmonics, x.reshape(-1, 2).tolist(), strict=True)
        return tuple(
            Harmonic(n, math.hypot(a, b), math.atan2(b, a)) for n, (a, b) in pairs if a or b
        )

    def power_and_index(self, x: Array) -> tuple[Array, Array]:
        """Total power [W] and index [%] with cosines and sines [rad], (2,), and their slopes by x, (2, 2 H)."""
        values, slopes = self._values(x)
        index, by_load = index_of(self.solution.design, values[:-1].reshape(-1, 2))
        by_x = 100.0 * by_load.ravel() @ slopes[:-1]
        return np.array([values[-1], 100.0 * index]), np.stack([slopes[-1], by_x])

    def _values(self, x: Array) -> tuple[Array, Array]:
        bent = self.second @ x
        return self.base + (self.slopes + 0.5 * bent) @ x, self.slopes + bent


def with_harmonics(design: Design, harmonics: tuple[Harmonic, ...]) -> Design:
    """The design with this active twist, of the shape along the span that it has or else linear."""
    old = design.active_twist
    if not harmonics:
        return replace(design, active_twist=None)
    if old is not None:
        return replace(design, active_twist=replace(old, harmonics=harmonics))
    return replace(
        design, active_twist=linear_active_twist(harmonics, design.rotor.blade.root_cutout)
    )


def t_matrix(design: Design, harmonics: Sequence[int] = (2, 3, 4, 5)) -> TMatrix:
    """How hub loads and power of a trimmed design respond to twist at n per revolution.

    `response("2:1:240,3:0.5:60")` of the result gives loads, index and power at once.

    Parameters:
        design: a design with hub loads. Only the shape of its active twist along the span is used.
        harmonics: the n of the twist, 1 to 8.

    Returns:
        Slopes and second derivatives of loads [N, N m] and power [W] by the amplitudes [rad].

    Raises:
        ValueError: the design has no hub loads, or a harmonic cannot be used.
        RuntimeError: the design does not trim.
    """
    require_design(design)
    check_index(design, Objective("vibration", (WeightedCondition(design.condition),)), Limits())
    return _matrix(design, read_harmonics([(n, 1.0, 0.0) for n in harmonics], "harmonics"))


def with_power_of(matrix: TMatrix, design: Design) -> TMatrix:
    """The matrix with the power of another design, such as one whose blades do not bend, which has no hub loads."""
    other = _matrix(design, tuple(Harmonic(n, STEP, 0.0) for n in matrix.harmonics))
    rows = {name: getattr(matrix, name).copy() for name in ("base", "slopes", "second")}
    for name, values in rows.items():
        values[-1] = getattr(other, name)[-1]
    return replace(matrix, **rows)


def _matrix(design: Design, waves: tuple[Harmonic, ...]) -> TMatrix:
    """By two orders; of a blade that does not bend, of power alone."""
    shaped = with_harmonics(design, waves)
    trim = analyse(replace(design, active_twist=None))
    base, slopes = _measured(trim, shaped)
    second = np.zeros((*slopes.shape, slopes.shape[1]))
    matrix = TMatrix(trim.solution, tuple(wave.per_rev for wave in waves), base, slopes, second)
    steps = [with_harmonics(shaped, matrix.twist(step)) for step in STEP * np.eye(slopes.shape[1])]
    for k, moved in enumerate(analyse_many(steps, [trim.solution] * len(steps))):
        second[:, :, k] = (_measured(moved, shaped)[1] - slopes) / STEP
    return replace(matrix, second=0.5 * (second + second.transpose(0, 2, 1)))


def _measured(trim: Analysis, shaped: Design) -> tuple[Array, Array]:
    """Loads, of a blade that bends, and power of a trim, (11,) or (1,), and their slopes by the active twist of
    `shaped`, (…, 2 H)."""
    adjoint, solution = trim.adjoint, trim.solution
    problem, point = adjoint.problem, adjoint.point
    structure, torsion, disk = point.system.structure, problem.torsion, problem.disk
    both, values = adjoint.total_terms, np.zeros(0)
    if problem.bending is not None:
        loads, values = terms_and_loads(adjoint)
        both = loads.stacked(both)
    with one_blas_thread():
        matrix, by_state = jacobian(point, both)
        by_measure = both.slopes(point.z, point.q, structure.first_state)[0]
        moved, direct = list[Array](), list[Array]()
        twist = shaped.active_twist
        assert twist is not None
        for harmonic in twist.harmonics:
            for phase in (0.0, 0.5 * math.pi):
                wave = replace(twist, harmonics=(Harmonic(harmonic.per_rev, 1e-3, phase),))
                fields = [1e3 * wave(disk.r, disk.psi, order) for order in range(3)]
                given = np.zeros(len(structure.equations))
                if torsion is not None:
                    added = given_torsion(torsion, np.zeros(len(disk.r)), fields[0], fields[2])
                    for (k, h), value in np.ndenumerate(added):
                        given[structure.equations["twist", k, h]] = value
                moves = {TH: fields[0], RATE: fields[1]}
                if problem.unsteady:
                    moves[problem.inflow_terms.interface.channels + DTH] = fields[2]
                on_equations, on_measures = linear_response(point, moves, given)
                moved.append(on_equations)
                direct.append(on_measures)
        states = np.linalg.solve(matrix, np.stack(moved, axis=1))
    slopes = by_measure @ np.stack(direct, axis=1) - by_state @ states
    watts = solution.design.power_unit * tail_gain(solution)
    units = np.append(np.repeat(load_units(problem.design), 2)[: values.size], watts)[:, None]
    return np.append(values.ravel(), solution.power.total), slopes * units


@dataclass(frozen=True, eq=False)
class FrontPoint:
    """One trimmed point of the trade-off between power and vibration."""

    design: Design
    power: float
    """Total [W]."""
    index: float
    """[%]"""
    preview: tuple[float, float] | None = None
    """Power [W] and index [%] that the T-matrix foresaw; None where there is none."""
    band: tuple[float, float] | None = None
    """Least and largest index over the inflow models of `hub_loads.band_inflows` with which it trims [%]."""
    over_inflows: tuple[float, float] | None = None
    """Least and largest change of the index from the start, each with the same wake [%]; None for the start."""


@dataclass(frozen=True, eq=False, repr=False)
class VibrationFront:
    """Designs of which none has both less power and less vibration than another, from least power to least index."""

    start: FrontPoint
    """What they are compared with: without active twist, or with the twist given."""
    points: tuple[FrontPoint, ...]
    message: str
    """How it was found, in one sentence or two."""

    def __repr__(self) -> str:
        ends = " to ".join(
            f"({power:+.2f} %, {index:+.0f} %)"
            for power, index in self.changes[:: len(self.points) - 1 or 1]
        )
        return f"VibrationFront({len(self.points)} points of power and index: {ends})"

    @property
    def changes(self) -> tuple[tuple[float, float], ...]:
        """Change of power and of index from the start [%], point by point."""
        return tuple(
            (
                100.0 * (point.power / self.start.power - 1.0),
                100.0 * (point.index / self.start.index - 1.0),
            )
            for point in self.points
        )

    @property
    def preview_error(self) -> tuple[float, float] | None:
        """Largest errors of the preview, of power and of index, in per cent of those of the start."""
        pairs = [(point.preview, point) for point in self.points]
        power = [
            abs(seen[0] - point.power) / self.start.power
            for seen, point in pairs
            if seen is not None
        ]
        index = [
            abs(seen[1] - point.index) / self.start.index
            for seen, point in pairs
            if seen is not None
        ]
        return (100.0 * max(power), 100.0 * max(index)) if power else None


def vibration_front(
    design: Design,
    concept: str | None = None,
    *,
    harmonics: Sequence[int] = (2, 3),
    reach_deg: float = 1.0,
    points: int = 5,
) -> VibrationFront:
    """The trade-off between power and vibration: the least power at each of several limits of the vibration index.

    Every point is trimmed. Points of active twist are found with `t_matrix`, those of a
    concept by searches.

    Parameters:
        design: a design with hub loads.
        concept: the static twist to vary, as for `rotor.optimise`; None: active twist is varied instead.
        harmonics: the n per revolution of the active twist.
        reach_deg: its largest amplitude at each harmonic [°], up to 5.
        points: number of points, 2 to 50.

    Returns:
        The points from least power to least index. Each point of active twist states the error of its preview.

    Raises:
        ValueError: an argument cannot be used, or the design has no hub loads.
        RuntimeError: the design does not trim.
    """
    require_design(design)
    if not 2 <= points <= 50:
        raise ValueError(
            f"{points} points of a trade-off curve are outside 2…50: 5 are enough for most"
        )
    if not 0.0 < reach_deg <= 5.0:
        raise ValueError(
            f"reach {reach_deg:g}° of the active twist is outside 0…5°: choose a value inside; actuators reach 1 to 2"
        )
    check_index(design, Objective("vibration", (WeightedCondition(design.condition),)), Limits())
    if concept is not None:
        return _static_front(design, concept, points)
    matrix = t_matrix(design, harmonics)
    start, front, lost = _trimmed(matrix.solution), list[FrontPoint](), 0
    steps = front_twists(matrix, math.radians(reach_deg), points)
    designs = [with_harmonics(design, matrix.twist(x)) for x in steps]
    for x, trim in zip(steps, analyse_many(designs, [matrix.solution] * len(designs)), strict=True):
        power, index = matrix.power_and_index(x)[0].tolist()
        front += (
            [replace(_trimmed(trim), preview=(power, index))] if trim.solution.converged else []
        )
        lost += not trim.solution.converged
    reached = f"at most {reach_deg:g}° each of {', '.join(map(str, matrix.harmonics))}/rev"
    words = f"Active twist, {reached}; every point is trimmed again."
    return _over_inflows(
        VibrationFront(start, tuple(front), words + (f" {lost} did not trim." if lost else ""))
    )


def _trimmed(given: Solution | Analysis) -> FrontPoint:
    adjoint = analysed(given).adjoint
    return FrontPoint(adjoint.solution.design, adjoint.solution.power.total, hub_index(adjoint))


def _over_inflows(front: VibrationFront) -> VibrationFront:
    """With band and changes of the index over inflow models."""
    every = (front.start, *front.points)
    indices = np.array(
        [[_index_with(point, inflow) for inflow in band_inflows()] for point in every]
    )
    changes = 100.0 * (indices / indices[0] - 1.0)
    points = [
        replace(
            point,
            band=_ends([*index, point.index]),
            over_inflows=_ends(change) if point is not front.start else None,
        )
        for point, index, change in zip(every, indices.tolist(), changes.tolist(), strict=True)
    ]
    return replace(front, start=points[0], points=tuple(points[1:]))


def _index_with(point: FrontPoint, inflow: str) -> float:
    """The index with another inflow model [%]; NaN where it does not trim."""
    models = point.design.models
    if inflow == models.inflow:
        return point.index
    other = analyse(replace(point.design, models=replace(models, inflow=inflow)))
    return hub_index(other.adjoint) if other.solution.converged else math.nan


def _ends(values: Sequence[float]) -> tuple[float, float] | None:
    """Least and largest of those that there are."""
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else None


def front_twists(matrix: TMatrix, reach: float, points: int) -> list[Array]:
    """Cosines and sines [rad] of least power for limits of the index, by the T-matrix; `reach` [rad] of each."""
    size, start = (
        2 * len(matrix.harmonics),
        matrix.power_and_index(np.zeros(2 * len(matrix.harmonics)))[0],
    )
    scale = np.array([0.01 * start[0], start[1]])

    def seen(u: Array) -> tuple[Array, Array]:
        values, slopes = matrix.power_and_index(reach * u)
        return values / scale, slopes * (reach / scale[:, None])

    def within(u: Array) -> Array:
        return 1.0 - (u.reshape(-1, 2) ** 2).sum(axis=1)

    def within_slopes(u: Array) -> Array:
        pairs = -2.0 * u.reshape(-1, 2)
        return np.stack(
            [np.where(np.arange(size) // 2 == k, pairs.ravel(), 0.0) for k in range(len(pairs))]
        )

    def least(which: int, starts: Sequence[Array], limit: float | None = None) -> Array:
        """Twist of least power (0) or index (1), with the index at most `limit`."""

        def cost(u: Array) -> tuple[float, Array]:
            values, slopes = seen(u)
            return values[which], slopes[which]

        def room(u: Array) -> float:
            return math.inf if limit is None else limit - seen(u)[0][1]

        def room_slopes(u: Array) -> Array:
            return -seen(u)[1][1]

        limits: list[dict[str, Any]] = [{"type": "ineq", "fun": within, "jac": within_slopes}]
        limits += [] if limit is None else [{"type": "ineq", "fun": room, "jac": room_slopes}]
        options = {"maxiter": 200, "ftol": 1e-9}
        descents = [slsqp(cost, u, constraints=limits, options=options) for u in starts]
        ends = [*(np.asarray(descent.x, dtype=np.float64) for descent in descents), *starts]
        return min(
            (u for u in ends if min(within(u).min(), room(u)) > -1e-6), key=lambda u: cost(u)[0]
        )

    sides = [np.zeros(size), *(0.7 * np.eye(size)), *(-0.7 * np.eye(size))]
    ends = least(0, sides), least(1, sides)
    high, low = (float(seen(u)[0][1]) for u in ends)
    twists = [ends[0]]
    for limit in np.linspace(high, low, points)[1:-1].tolist():
        share = (high - limit) / (high - low)
        twists.append(
            least(0, [ends[1], twists[-1], (1.0 - share) * ends[0] + share * ends[1]], limit)
        )
    return [reach * u for u in (*twists, ends[1])]


def _static_front(design: Design, concept: str, points: int) -> VibrationFront:
    """Front of static twist, by searches."""
    here, family = (WeightedCondition(design.condition),), find_concept(concept)
    start = _trimmed(analyse(design))
    plain = Search(design, family, Objective("total", here), starts=3, band=False)
    least = run_search(replace(plain, limits=Limits(index=_UNREACHED_PERCENT)))
    calm = run_search(replace(plain, objective=Objective("vibration", here)))
    searches, trimmed = [least, calm], TrimHistory()
    front, (high, low) = [_best(least)], (_best(search).index or 0.0 for search in searches)
    for limit in np.linspace(high, low, points)[1:-1].tolist():
        guesses = front[-1].parameters, _best(calm).parameters
        held = replace(plain, limits=Limits(index=limit), starts=len(guesses), guesses=guesses)
        searches.append(run_search(held, trimmed=trimmed))
        front.append(_best(searches[-1]))
    trims = analyse_many(
        [family.apply(design, point.parameters) for point in (*front, _best(calm))]
    )
    lost = sum(search.status is not SearchStatus.CONVERGED for search in searches)
    words = f"Static twist, {family.title.lower()}."
    words += (
        f" {lost} of {len(searches)} searches did not converge: their best twist so far is kept."
        if lost
        else ""
    )
    return _over_inflows(VibrationFront(start, tuple(map(_trimmed, trims)), words))


_UNREACHED_PERCENT = 1e3
"""A limit of the index [%] that no rotor reaches, so that it is measured."""


def _best(optimum: Optimum) -> Minimum:
    if optimum.best is None:
        raise RuntimeError(f"No trade-off curve: {optimum.message}")
    return optimum.best
