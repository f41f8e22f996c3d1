"""Hover with a free wake as a solution of the program: blade elements, gradient by pitch, filaments, band of power."""

import math
from dataclasses import dataclass, fields, replace

import numpy as np

from rotor.aero.elements import BladeElements, TrimState, TwistState, over_azimuths
from rotor.aero.free_wake import system as line
from rotor.aero.free_wake.roll_up import POWER, RollUp
from rotor.aero.free_wake.settle import Settled, WakeFactors, WakeFilaments, filaments, preview, settle, torque, warm
from rotor.aero.free_wake.system import SHEET_CORE, HoverSystem, WakeEvaluation, WakeState, first_passage_radius
from rotor.aero.inflow import Wake
from rotor.aero.momentum import axial_inflow
from rotor.aero.problem import Problem
from rotor.arrays import Array
from rotor.blas_threads import one_blas_thread
from rotor.trim.hover import hover
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions

TORSION_TOLERANCE = 1e-9
"""Largest residual of the torsion equations [rad]: what the tolerance of the wake leaves."""
FINER_GRID = -0.02
"""Change of power with 36 azimuth steps of a turn for 24, as a part of it: −0.01 to −0.03, more with more twist."""
LEAST_LOADING = 0.01
"""C_T/σ below which a rotor has hardly a wake."""
NO_WAKE = (
    "Not trimmed: the free wake is found for a given thrust of C_T/σ 0.01 or more; give such a thrust, or take hover "
    "inflow annulus."
)
NOT_SETTLED = (
    "Not trimmed: the free wake did not settle at this thrust and twist; take hover inflow annulus, or change the "
    "twist or the mass a little."
)
TIPS_PUSH_DOWN = (
    "Not trimmed: with so much twist for so little thrust the tips push down. The tip vortices lose their circulation, "
    "and the steady free wake that follows from more thrust ends before; take hover inflow annulus, less twist or more "
    "mass."
)


@dataclass(frozen=True, eq=False)
class HoverWakeResult:
    """Where the free wake ended."""

    elements: BladeElements
    residual: float
    """Largest residual of all equations, lengths over R, and |C_T − C_W| over C_W."""
    converged: bool
    passes: int
    reached: float
    """C_T over C_W."""
    message: str
    """Why it did not converge; empty where the annulus balance has not enough thrust either."""
    settled: bool
    """Whether wake and loads are in equilibrium; False after one Newton step from another design's wake."""
    wake: WakeFilaments | None

    @property
    def guess(self) -> Guess:
        """A start for hovering rotors nearby."""
        torsion = self.elements.torsion
        return Guess(self.elements.state, None if torsion is None else torsion.coordinates)


def hover_wake(
    problem: Problem,
    start: WakeState | None = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    elastic: Array | None = None,
) -> HoverWakeResult:
    """Collective for the thrust with a free wake; from an earlier wake, or from the annulus balance.

    elastic: coordinates of the elastic twist to begin with, (modes, functions). With `options.preview`, one Newton step
    from `start` where its factors are still kept, at that elastic twist, marked as not settled.
    """
    twist = elastic[:, 0] if elastic is not None and elastic.shape == problem.given_torsion.shape else None
    if options.preview and start is not None and (twist is not None or problem.torsion is None):
        found = preview(as_flown(problem, twist), start)
        if found is not None:
            return _result(problem, found, twist, settled=found.converged and problem.torsion is None)
    annuli = hover(problem, None, options)
    stand = problem.design.condition.stand
    given = stand is not None and stand.collective is not None
    if given or problem.weight < LEAST_LOADING * problem.design.rotor.solidity:
        return HoverWakeResult(
            annuli.linear.elements, annuli.residual, False, annuli.passes, annuli.reached, NO_WAKE, True, None
        )
    if not annuli.converged:
        return HoverWakeResult(
            annuli.linear.elements, annuli.residual, False, annuli.passes, annuli.reached, "", True, None
        )
    circulation = math.pi / problem.disk.blades * _lift(problem, annuli.linear.elements)
    collective = annuli.linear.elements.state.collective
    if problem.torsion is None:
        result = _result(problem, settle(problem, circulation, collective, start), None, settled=True)
    else:
        assert annuli.linear.elements.torsion is not None
        if twist is None:
            twist = annuli.linear.elements.torsion.coordinates[:, 0]
        result = _with_torsion(problem, circulation, collective, start, twist)
    tips_push_down = float(circulation[problem.disk.r > 0.8].min()) < 0.0
    return result if result.converged or not tips_push_down else replace(result, message=TIPS_PUSH_DOWN)


def _with_torsion(
    problem: Problem, circulation: Array, collective: float, start: WakeState | None, twist: Array
) -> HoverWakeResult:
    """Newton's method on the elastic twist, the wake in equilibrium at every step; slopes are kept while it works."""
    passes, slopes, before = 0, None, math.inf
    while True:
        found = settle(as_flown(problem, twist), circulation, collective, start, compare=slopes is None)
        passes += found.passes
        found = replace(found, passes=passes)
        if not found.converged:
            return _result(problem, found, twist, settled=True)
        start = found.evaluation.state
        result = _result(problem, found, twist, settled=True)
        residual = _torsion_residual(problem, found.evaluation, twist)
        error = float(np.abs(residual).max())
        if error <= TORSION_TOLERANCE:
            return result
        if error > 0.5 * before:
            return replace(result, converged=False, message=NOT_SETTLED)
        if slopes is None or error > 0.1 * before:
            slopes = WakeAdjoint(problem, start, twist).torsion_slopes
        twist, before = twist - np.linalg.solve(slopes, residual), error


def as_flown(problem: Problem, elastic: Array | None) -> Problem:
    """The problem of a rigid blade with the flown twist, for elastic coordinates (modes,)."""
    if problem.torsion is None or elastic is None:
        return problem
    twist = problem.twist + problem.torsion.radial.T @ elastic
    return replace(problem, twist=twist, torsion=None, given_torsion=np.zeros(0))


def _result(problem: Problem, found: Settled, elastic: Array | None, *, settled: bool) -> HoverWakeResult:
    at = found.evaluation
    thrust = float(at.loads[line.FZ].sum() * problem.disk.dr)
    usable = found.converged or not settled
    return HoverWakeResult(
        elements=over_disk(problem, at, elastic),
        residual=max(at.error, abs(thrust / problem.weight - 1.0)),
        converged=usable,
        passes=found.passes,
        reached=thrust / problem.weight,
        message="" if usable else NOT_SETTLED,
        settled=settled,
        wake=filaments(found.system, at),
    )


def _lift(problem: Problem, elements: BladeElements) -> Array:
    """½σ U C_l, (elements,)."""
    speed = np.hypot(elements.u_t[:, 0], elements.u_p[:, 0])
    return problem.disk.half_solidity * speed * elements.cl[:, 0]


def over_disk(problem: Problem, at: WakeEvaluation, elastic: Array | None = None) -> BladeElements:
    """The hovering rotor as blade elements over the whole disk, the same at every azimuth.

    elastic: coordinates of the elastic twist, (modes,).
    """
    disk = problem.disk

    def everywhere(values: Array) -> Array:
        return over_azimuths(values, len(disk.psi))

    collective, loads = at.state.collective, at.loads
    thrust = float(loads[line.FZ].sum() * disk.dr)
    coning = _coning(problem, loads)
    state = TrimState(collective=collective, coning=coning, lambda0=axial_inflow(max(thrust, 0.0), problem.climb))
    twist = None
    if problem.torsion is not None and elastic is not None:
        coordinates = np.zeros_like(problem.given_torsion)
        coordinates[:, 0] = elastic
        moment = everywhere(_moments(problem, at, elastic)[line.MOMENT])
        twist = TwistState(coordinates, everywhere(problem.torsion.radial.T @ elastic), moment)
    zero = np.zeros(disk.shape)
    return BladeElements(
        state=state, flow=Wake(0.0, problem.climb, state.lambda0),
        theta=everywhere(as_flown(problem, elastic).twist + collective), u_t=everywhere(disk.r - at.swirl),
        u_p=everywhere(at.inflow + problem.climb), u_r=zero, beta=np.full(len(disk.psi), coning),
        induced=everywhere(at.inflow), swirl=at.swirl, fz=everywhere(loads[line.FZ]), fx=everywhere(loads[line.FX]),
        fr=zero, alpha=everywhere(loads[line.ALPHA]), mach=everywhere(loads[line.MACH]),
        cl=everywhere(loads[line.CL]), cd=everywhere(loads[line.CD]), cd_mach=everywhere(loads[line.CD_MACH]),
        torsion=twist,
    )  # fmt: skip


def _coning(problem: Problem, loads: Array) -> float:
    """β0 under loads (rows, elements)."""
    if not problem.design.models.flapping:
        return 0.0
    if problem.design.rotor.precone is not None:
        return problem.design.rotor.precone
    moment = float((problem.arm * loads[line.FZ]).sum() * problem.disk.dr)
    return (problem.flap.load_gain * moment - problem.flap.weight) / problem.flap.frequency_squared


def _moments(problem: Problem, at: WakeEvaluation, elastic: Array) -> Array:
    """The rows of `line_loads` of an elastic blade with its moment, (rows, elements)."""
    theta = as_flown(problem, elastic).twist + at.state.collective
    return line.line_loads(problem, theta, problem.disk.r - at.swirl, at.inflow + problem.climb)


def _torsion_residual(problem: Problem, at: WakeEvaluation, elastic: Array) -> Array:
    """Steady elastic twist less what the loads make of it [rad], (modes,)."""
    torsion = problem.torsion
    assert torsion is not None
    load = torsion.modal(_moments(problem, at, elastic)[line.MOMENT]) + torsion.coupling @ elastic
    load = load + torsion.modal_tip_mass * _coning(problem, at.loads)
    return elastic - torsion.gain * load + problem.given_torsion[:, 0]


@dataclass(frozen=True, eq=False)
class LineWeights:
    """Derivatives of a measure at each element of the lifting line, (elements,)."""

    fz: Array
    """By F_z."""
    fx: Array
    inflow: Array
    """By λ_i at the same velocities."""
    u_t: Array
    """By U_T at the same loads, as the next."""
    u_p: Array
    swirl: Array
    """By the swirl at the same velocities."""
    theta: Array
    """By θ at the same loads."""

    def less(self, factors: Array, others: "list[LineWeights]") -> "LineWeights":
        """These weights less Σ factor · other."""

        def field(name: str) -> Array:
            own: Array = getattr(self, name)
            return own - sum(factor * getattr(other, name) for factor, other in zip(factors, others, strict=True))

        return LineWeights(*(field(one.name) for one in fields(LineWeights)))


class WakeAdjoint:
    """The linearised free wake of a settled solution: the gradient of any measure by the pitch along the blade."""

    def __init__(self, problem: Problem, state: WakeState, elastic: Array | None = None) -> None:
        """elastic: coordinates of the elastic twist, (modes,)."""
        self.problem = problem
        self.system = HoverSystem(as_flown(problem, elastic), state.layout)
        self.at = self.system.evaluate(state)
        self.elements = over_disk(problem, self.at, elastic)
        self._factors = WakeFactors.of(self.at.jacobian)
        self._twisting = self._torsion_weights()
        """Derivatives of the torsion residuals but for what the elastic coordinates do by themselves."""
        self._torsion_by_pitch = np.array([self._by_pitch(weights)[0] for weights in self._twisting])

    @property
    def torsion_slopes(self) -> Array:
        """∂(torsion residual) by the elastic coordinates, wake and collective following, (modes, modes)."""
        torsion = self.problem.torsion
        assert torsion is not None
        own = np.eye(len(torsion.gain)) - torsion.gain[:, None] * torsion.coupling
        return own + self._torsion_by_pitch @ torsion.radial.T

    def by_pitch(self, weights: LineWeights) -> Array:
        """∂(measure)/∂θ of each element's jig pitch, (elements,), wake, collective and elastic twist following."""
        by_pitch, factors = self._elastic(weights)
        torsion = self.problem.torsion
        if torsion is None:
            return by_pitch
        return by_pitch - factors @ (self._torsion_by_pitch + torsion.gain[:, None] * torsion.tension)

    def change(self, weights: LineWeights, system: HoverSystem) -> float:
        """First-order change of a measure when the equations of another system hold: other roll-up or core."""
        _, factors = self._elastic(weights)
        weights = weights.less(factors, self._twisting)
        there = system.evaluate(self.at.state, slopes=False)
        _, multipliers = self._by_pitch(weights)
        more_inflow, more_swirl = there.inflow - self.at.inflow, there.swirl - self.at.swirl
        direct = self._along(weights, more_inflow[:, None], more_swirl[:, None])
        return float(direct[0] - multipliers @ (there.residual - self.at.residual))

    def _elastic(self, weights: LineWeights) -> tuple[Array, Array]:
        """∂(measure)/∂θ at the same elastic twist, and the factors of the torsion residuals, (modes,)."""
        by_pitch, _ = self._by_pitch(weights)
        torsion = self.problem.torsion
        if torsion is None:
            return by_pitch, np.zeros(0)
        factors: Array = np.asarray(np.linalg.solve(self.torsion_slopes.T, torsion.radial @ by_pitch), np.float64)
        return by_pitch, factors

    def _by_pitch(self, weights: LineWeights) -> tuple[Array, Array]:
        """∂(measure)/∂θ at the same elastic twist, (elements,), and the multipliers of the equations."""
        at, layout, dr = self.at, self.system.layout, self.problem.disk.dr
        by_theta = weights.fz * at.loads[line.FZ_THETA] + weights.fx * at.loads[line.FX_THETA] + weights.theta
        slopes = self._along(weights, at.inflow_slopes, at.swirl_slopes)
        slopes[-1] += by_theta.sum()
        multipliers = self._factors.solve(slopes, transposed=True)
        _, _, lift = self.system.lift_slopes(at)
        residual = -math.pi / layout.blades * lift * multipliers[layout.geometry : -1]
        residual += multipliers[-1] * dr * at.loads[line.FZ_THETA]
        return by_theta - residual, multipliers

    def _torsion_weights(self) -> list[LineWeights]:
        """Derivatives of the torsion residuals of all modes; none for a rigid blade."""
        problem, torsion, blade = self.problem, self.problem.torsion, self.elements.torsion
        if torsion is None or blade is None:
            return []
        disk, moments = problem.disk, _moments(problem, self.at, blade.coordinates[:, 0])
        modal = -torsion.gain[:, None] * torsion.radial * disk.dr
        coned = np.zeros_like(disk.r)
        if problem.design.models.flapping and problem.design.rotor.precone is None:
            coned = problem.flap.load_gain / problem.flap.frequency_squared * problem.arm * disk.dr
        zero = np.zeros_like(disk.r)
        return [
            LineWeights(
                -lifted * coned, zero, zero, along * moments[line.M_UT], along * moments[line.M_UP], zero,
                along * moments[line.M_THETA],
            )
            for along, lifted in zip(modal, torsion.gain * torsion.modal_tip_mass, strict=True)
        ]  # fmt: skip

    def _along(self, weights: LineWeights, down: Array, turning: Array) -> Array:
        """Change of a measure with λ_i by `down` and the swirl by `turning`, (elements, directions)."""
        loads = self.at.loads
        by_p = weights.fz * loads[line.FZ_UP] + weights.fx * loads[line.FX_UP] + weights.inflow + weights.u_p
        by_t = weights.fz * loads[line.FZ_UT] + weights.fx * loads[line.FX_UT] + weights.u_t
        return by_p @ down + (weights.swirl - by_t) @ turning


@one_blas_thread()
def torque_changes(problem: Problem, state: WakeState, elastic: Array | None = None) -> Array:
    """Change of C_P, as a part of it, with each of the `other_roll_ups`, (roll-ups,), to first order."""
    adjoint = WakeAdjoint(problem, state, elastic)
    disk = problem.disk
    zero = np.zeros_like(disk.r)
    weights = LineWeights(zero, disk.r * disk.dr, zero, zero, zero, zero, zero)
    cp = float(disk.r @ adjoint.at.loads[line.FX]) * disk.dr
    return np.array([adjoint.change(weights, system) / cp for system in other_roll_ups(problem, state, elastic)])


@one_blas_thread()
def flown_torques(problem: Problem, state: WakeState, elastic: Array | None = None) -> Array:
    """C_Q of a settled wake, then of the same rotor in equilibrium with each of the `other_roll_ups`, (1 + roll-ups,).

    The elastic twist stays. NaN where the wake does not settle.
    """
    usual = HoverSystem(as_flown(problem, elastic), state.layout)
    ends = [warm(system, state) for system in (usual, *other_roll_ups(problem, state, elastic))]
    return np.array([torque(end) if end.converged else math.nan for end in ends]) * problem.disk.dr


def other_roll_ups(problem: Problem, state: WakeState, elastic: Array | None) -> list[HoverSystem]:
    """The equations with five other reasonable roll-ups.

    The core of the inboard sheet 0.045 and 0.1 R; the border between tip vortex and inboard sheet 0.05 R further in and
    half way to the tip; the average for the greatest circulation with another power.
    """
    disk, layout = problem.disk, state.layout
    problem = as_flown(problem, elastic)
    passage = first_passage_radius(layout.blades, problem.weight)
    borders = ((passage, POWER, 0.045), (passage, POWER, 0.1), (passage - 0.05, POWER, SHEET_CORE),
               (0.5 * (1.0 + passage), POWER, SHEET_CORE), (passage, 12, SHEET_CORE))  # fmt: skip
    return [
        HoverSystem(problem, layout, RollUp.of(disk.root, layout.elements, layout.inboard, border, power), core)
        for border, power, core in borders
    ]
