"""The trim of a problem from a guess, and whether it is accepted."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotor.aero.elements import STATE_NAMES, BladeElements, TrimState
from rotor.aero.problem import Problem
from rotor.aero.section import FZ
from rotor.arrays import Array
from rotor.columns.flight import SystemTolerances, elements_of, flight_system, parts_of, state_of
from rotor.columns.hover import hover_elements
from rotor.columns.trims import with_given_values
from rotor.engine.linearise import Point, System, evaluate
from rotor.engine.newton import DEFAULT_LIMITS, Factors, NewtonLimits, Solved, solve
from rotor.engine.waves import STEADY


@dataclass(frozen=True)
class SolverOptions:
    """Tolerances and limits of the solvers. The defaults serve every design; a test may tighten them."""

    residual_tolerance: float = 1e-10
    """Largest residual of the trim equations, as a fraction of C_W; it keeps the energy identity to 1e-9."""
    inflow_tolerance: float = 1e-8
    """Largest difference of N_b Γ/π from that of the lift, as a fraction of C_W."""
    torsion_tolerance: float = 1e-10
    """Largest residual of the equations of torsion and bending [rad]."""
    accepted_residual: float = 1e-7
    accepted_inflow: float = 1e-6
    """The same two where Newton's method makes no more progress: the slopes of stall data jump from one table cell to
    the next, and a root element on such a jump can keep the last digits of its own inflow from settling. Power still
    closes to 1e-6."""
    max_passes: int = DEFAULT_LIMITS.most_passes
    """Evaluations of the blade elements in one run of Newton's method."""
    most_old_steps: float = DEFAULT_LIMITS.most_steps
    """This and the next two as in `NewtonLimits`."""
    most_old_steps_of_nodes: float = 10.0
    """The same with unknowns at every point, whose derivatives cost as much as ten steps; and of the next."""
    kept_ratio_of_nodes: float = 0.5
    most_old_steps_of_start: float = DEFAULT_LIMITS.most_steps_on_few
    kept_ratio: float = DEFAULT_LIMITS.kept_ratio
    angle_step: float = 0.08
    """Largest Newton step of an angle [rad]: beyond it the section slopes no longer hold."""
    inflow_step: float = 0.02
    """Largest Newton step of λ0, over ΩR."""
    hover_tolerance: float = 1e-12
    """Difference of C_T from C_W in hover at which the iteration ends, as a fraction of C_W."""
    accepted_hover: float = 1e-10
    """Difference at which hover counts as converged, as a fraction of C_W."""
    continuation_steps: int = 40
    """Most steps of continuation from an easier condition."""
    most_passes: int = 600
    """Evaluations of the blade elements in one solve, after which continuation gives up."""
    stop: Callable[[], bool] | None = None
    """Asked between two runs of Newton's method; True ends a solve that has not converged."""
    smallest_continuation_step: float = 1.0 / 128.0
    """Step, as a part of the whole way, below which continuation gives up."""

    @property
    def asked_to_stop(self) -> bool:
        return self.stop is not None and self.stop()


DEFAULT_OPTIONS = SolverOptions()


@dataclass(frozen=True, eq=False)
class Guess:
    """Where a trim starts: what a solution leaves for the next one."""

    state: TrimState
    elastic: Array | None = None
    """Coordinates of the elastic twist, (modes, functions)."""
    bending: Array | None = None
    """Coordinates of bending but for those in `state`, flat."""
    inflow: Array | None = None
    """Nodes of an inflow that answers the load."""
    inflow_kind: Hashable = None
    """The inflow that they belong to."""
    factors: Factors | None = None
    """Those of the last derivatives, for the first steps."""
    structure: Hashable = None
    """The equations that they belong to."""


@dataclass(frozen=True, eq=False)
class LinearisedTrim:
    """A trim's equations at its solution."""

    problem: Problem
    point: Point
    """With the partial derivatives and the flow at the sections."""

    @cached_property
    def elements(self) -> BladeElements:
        """The blade elements there."""
        return (hover_elements if self.problem.design.hovering else elements_of)(self.problem, self.point)


@dataclass(frozen=True, eq=False)
class TrimResult:
    """Where Newton's method ended."""

    problem: Problem
    point: Point
    residual: float
    """Largest residual over `Problem.scale`."""
    converged: bool
    passes: int
    """Evaluations of the blade elements."""
    reached: float = 1.0
    """How far continuation from an easier condition came (1: all the way)."""
    factors: Factors | None = None
    """Those of the last derivatives, where they reduced the residual so much that they are near those of the trim."""
    nearest: "TrimResult | None" = None
    """The last trim that continuation found on its way, where it did not come all the way."""

    @property
    def state(self) -> TrimState:
        return state_of(self.point.system.structure, self.point.x)

    @property
    def thrust(self) -> float:
        """C_T along the shaft."""
        return float(self.point.q[self.point.system.structure.measure(FZ, "one", STEADY)])

    @cached_property
    def linear(self) -> LinearisedTrim:
        """The equations there."""
        point = self.point
        if not (point.flow.shape[1] and point.slopes.shape[1]):
            point = evaluate(point.system, point.grid, point.x, slopes=True, flow=True)
        return LinearisedTrim(self.problem, point)

    @property
    def guess(self) -> Guess:
        """A start for trims nearby."""
        structure = self.point.system.structure
        state, twist, bending, inflow = parts_of(structure, self.point.x)
        modes = len(self.problem.given_torsion)
        elastic = twist.reshape(modes, -1).copy() if modes else None
        return Guess(
            state, elastic, bending.copy(), inflow.copy(), self.problem.inflow_terms.key, self.factors, structure.name
        )  # fmt: skip


def tolerances(options: SolverOptions) -> SystemTolerances:
    """As the system of a flight takes them."""
    return SystemTolerances(
        options.residual_tolerance, options.inflow_tolerance, options.torsion_tolerance, options.angle_step,
        options.inflow_step,
    )  # fmt: skip


def newton(problem: Problem, start: Guess, options: SolverOptions = DEFAULT_OPTIONS) -> TrimResult:
    """Newton's method on trim unknowns, elastic twist and inflow together, see `rotor.engine.newton`."""
    system = flight_system(problem, tolerances(options))
    factors = start.factors if start.structure == system.structure.name else None
    most_on_few = options.most_old_steps_of_start if problem.inflow.load_dependent else 0.0
    most_steps, kept_ratio = options.most_old_steps, options.kept_ratio
    if system.nodes is not None:
        most_steps, kept_ratio = options.most_old_steps_of_nodes, options.kept_ratio_of_nodes
    limits = NewtonLimits(options.max_passes, most_steps, most_on_few, kept_ratio)
    return _ended(problem, solve(system, first_point(problem, system, start), factors, limits), options)


def _ended(problem: Problem, found: Solved, options: SolverOptions) -> TrimResult:
    """Whether the iteration ended at a trim."""
    residual, twisting, difference = _errors(found.point, options)
    accepted = max(residual, twisting) <= options.accepted_residual and difference <= options.accepted_inflow
    converged = found.point.size <= 1.0 or accepted
    return TrimResult(problem, found.point, residual, converged, found.passes, factors=found.factors)


def first_point(problem: Problem, system: System, start: Guess) -> Array:
    """(1, numbers, states) of a guess."""
    state, terms = with_given_values(problem, start.state), problem.inflow_terms
    elastic: Array = np.zeros_like(problem.given_torsion)
    if start.elastic is not None and len(start.elastic) == len(elastic):  # It may have more waves, or fewer.
        both = min(elastic.shape[1], start.elastic.shape[1])
        elastic[:, :both] = start.elastic[:, :both]
    inflow = start.inflow
    if inflow is None or start.inflow_kind != terms.key:
        inflow = terms.start()
    given = len(system.numbers) + len(STATE_NAMES) + elastic.size
    others = np.zeros(system.structure.given - given)
    bends = len(system.structure.states_of("bend"))
    if start.bending is not None and len(start.bending) == bends:
        others[:bends] = start.bending
    return np.concatenate([system.numbers, state.array(), elastic.ravel(), others, inflow])


def _errors(point: Point, options: SolverOptions) -> tuple[float, float, float]:
    """Largest residual of the trim, of torsion and bending, and of the inflow, as `SolverOptions` measures."""
    system, structure = point.system, point.system.structure
    ratio = np.abs(point.residual) / system.tolerance
    elastic = np.concatenate([structure.equations_of(kind) for kind in ("twist", "bend")])
    ratio, nodes = np.split(ratio, [len(structure.equations)])
    return (
        float(np.delete(ratio, elastic).max()) * options.residual_tolerance,
        float(ratio[elastic].max(initial=0.0)) * options.torsion_tolerance,
        float(nodes.max(initial=0.0)) * options.inflow_tolerance,
    )
