"""The trim of a problem from a guess by Newton's method, and whether it is accepted."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial

import numpy as np

from rotor.aero.display import own_stalled_parts
from rotor.aero.elements import STATE_NAMES, BladeElements, TrimState
from rotor.aero.problem import Problem
from rotor.aero.section import FZ
from rotor.aero.side_by_side import side_by_side
from rotor.columns.flight import SystemTolerances, elements_of, flight_system, parts_of, state_of
from rotor.columns.hover import hover_elements
from rotor.columns.trims import with_given_values
from rotor.engine.linearise import Point, System, evaluate
from rotor.engine.lockstep import can_share_steps, solve_together
from rotor.engine.newton import Factors, NewtonLimits, Solved, solve
from rotor.engine.waves import STEADY
from rotor.support.arrays import Array


@dataclass(frozen=True, repr=False)
class SolverOptions(SystemTolerances):
    """Tolerances and limits of the solvers. The defaults serve every design; a test may tighten them."""

    def __repr__(self) -> str:
        changed = ((one.name, getattr(self, one.name)) for one in fields(self))
        named = (
            f"{name}={value!r}" for name, value in changed if value != getattr(SolverOptions, name)
        )
        return f"{type(self).__name__}({', '.join(named)})"

    accepted_residual: float = 1e-7
    accepted_inflow: float = 1e-6
    """Residuals of trim and inflow where Newton's method makes no more progress: the slopes of stall data jump from one
    table cell to the next, and a root element on such a jump can keep the last digits of its own inflow from settling.
    Power still closes to 1e-6."""
    max_passes: int = 60
    """Evaluations of the blade elements in one run of Newton's method."""
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
    slopes: bool = True
    """Whether slopes of power will be asked for: then the last evaluation has the partial derivatives."""
    remedy: bool = True
    """Whether a refusal names the largest mass and speed that trim, on a stand the largest C_T/σ. To find them takes
    longer than the trim."""

    @property
    def asked_to_stop(self) -> bool:
        """Whether the caller wants the solve to end."""
        return self.stop is not None and self.stop()


DEFAULT_OPTIONS = SolverOptions()
FEW_DIGITS = SolverOptions(
    residual_tolerance=1e-6, torsion_tolerance=1e-6, inflow_tolerance=1e-4,
    accepted_residual=1e-6, accepted_inflow=1e-4, slopes=False, remedy=False,
)  # fmt: skip
"""The same equations, solved to the digits that are shown: power within 4e-7 (tested)."""


@dataclass(eq=False)
class FactorBox:
    """Factors for the first steps from a guess."""

    factors: Factors | None = None
    """Those of the steps that led to it, until slopes of its trim have them made there."""
    at_trim: bool = False
    """Whether they were made at its trim."""


@dataclass(frozen=True, eq=False)
class Guess:
    """The start of a trim, which a solution leaves for the next one."""

    state: TrimState
    elastic: Array | None = None
    """Coordinates of the elastic twist, (modes, functions)."""
    bending: Array | None = None
    """Coordinates of bending but for those in `state`, and of further freedoms, flat."""
    inflow: Array | None = None
    """Nodes of an inflow that answers the load."""
    inflow_kind: Hashable = None
    """The inflow that they belong to."""
    box: FactorBox | None = None
    structure: Hashable = None
    """The equations that its factors belong to."""

    @property
    def factors(self) -> Factors | None:
        """LU factors of a Jacobian for the first steps; None without them."""
        return None if self.box is None else self.box.factors

    @property
    def array(self) -> Array:
        """All numbers of the guess in one vector."""
        others = (
            part.ravel() for part in (self.elastic, self.bending, self.inflow) if part is not None
        )
        return np.concatenate([self.state.array(), *others])

    def with_array(self, numbers: Array) -> "Guess":
        """This guess with other numbers, in the order of `array`."""
        parts, first = dict[str, Array](), len(STATE_NAMES)
        for name in ("elastic", "bending", "inflow"):
            if (part := getattr(self, name)) is not None:
                parts[name] = numbers[first : first + part.size].reshape(part.shape)
                first += part.size
        return replace(self, state=TrimState.from_array(numbers[: len(STATE_NAMES)]), **parts)

    def ahead(self, before: "Guess", steps: float) -> "Guess":
        """The guess `steps` ahead on the secant from an earlier trim to this one; itself where they differ in
        kind."""
        here, there = self.array, before.array
        if len(here) != len(there) or self.inflow_kind != before.inflow_kind:
            return self
        return self.with_array(here + steps * (here - there))


@dataclass(frozen=True, eq=False)
class LinearisedTrim:
    """A trim's equations at its solution."""

    problem: Problem
    point: Point
    """With the flow at the sections."""

    @cached_property
    def elements(self) -> BladeElements:
        """The blade elements at the solution."""
        return (hover_elements if self.problem.design.hovering else elements_of)(
            self.problem, self.point
        )

    @cached_property
    def stalled_moment(self) -> float:
        """Part of the lift moment that stalled sections carry [-], on the azimuths of the trim."""
        return own_stalled_parts(self.problem, self.elements)[1]


@dataclass(frozen=True, eq=False)
class TrimResult:
    """The last iterate of a trim, in forward flight or hover."""

    problem: Problem
    point: Point
    residual: float
    """Largest residual over `Problem.scale`; in hover |C_T − C_W| over C_W."""
    converged: bool
    passes: int
    """Evaluations of the blade elements."""
    factors: Factors | None = None
    """Factors of the last derivatives, where they reduced the residual so much that they are near those of the trim."""
    steady: bool = True
    """Whether axial flow has a steady wake at the collective given."""
    led: bool = False
    """Whether continuation from an easier condition found it."""

    @property
    def state(self) -> TrimState:
        """Controls, flapping and inflow of the iterate in forward flight."""
        return state_of(self.point.system.structure, self.point.x)

    @property
    def thrust(self) -> float:
        """C_T along the shaft in forward flight."""
        return float(self.point.q[self.point.system.structure.measure(FZ, "one", STEADY)])

    @cached_property
    def linear(self) -> LinearisedTrim:
        """The equations there, with the flow at the sections."""
        point = self.point
        if not point.flow.shape[1]:
            point = evaluate(point.system, point.grid, point.x, slopes=True, flow=True)
        return LinearisedTrim(self.problem, point)

    @property
    def guess(self) -> Guess:
        """A start for trims nearby."""
        if self.problem.design.hovering:
            hovering = self.linear.elements
            return Guess(
                hovering.state, None if hovering.torsion is None else hovering.torsion.coordinates
            )
        structure = self.point.system.structure
        state, twist, bending, inflow = parts_of(structure, self.point.x)
        modes = len(self.problem.given_torsion)
        elastic = twist.reshape(modes, -1).copy() if modes else None
        kind, box = self.problem.inflow_terms.key, FactorBox(self.factors)
        return Guess(state, elastic, bending.copy(), inflow.copy(), kind, box, structure.name)


def newton(problem: Problem, start: Guess, options: SolverOptions = DEFAULT_OPTIONS) -> TrimResult:
    """Newton's method on trim unknowns, elastic twist and inflow together, see `rotor.engine.newton`."""
    system = flight_system(problem, options)
    factors = start.factors if start.structure == system.structure.name else None
    limits = _limits(problem, system, options)
    return _ended(
        problem, solve(system, first_point(problem, system, start), factors, limits), options
    )


def newton_together(
    problems: Sequence[Problem], starts: Sequence[Guess], options: SolverOptions = DEFAULT_OPTIONS
) -> list[TrimResult | None]:
    """`newton` of designs that differ in their twist alone, in step; None for those that take other steps than these.

    All take the factors of the first start. See `rotor.engine.lockstep`.
    """
    systems = [flight_system(problem, options) for problem in problems]
    one, factors = systems[0], starts[0].factors
    if factors is None or starts[0].structure != one.structure.name or not factors.usable:
        return [None] * len(problems)
    begun = list(map(first_point, problems, systems, starts))
    places = [
        k
        for k, x in enumerate(begun)
        if can_share_steps(systems[k], one)
        and (one.nodes is None or x[one.structure.given :].any())
    ]
    x = np.array([begun[k] for k in places])
    limits, data = _limits(problems[0], one, options), partial(side_by_side, one.grid.data)
    found = zip(
        places, solve_together([systems[k] for k in places], x, factors, limits, data), strict=True
    )
    ended = {k: _ended(problems[k], solved, options) for k, solved in found if solved is not None}
    return [ended.get(k) for k in range(len(problems))]


def _limits(problem: Problem, system: System, options: SolverOptions) -> NewtonLimits:
    # Derivatives by so many unknowns cost as much as fifteen steps, on finer grids more.
    if system.nodes is not None:
        finer = len(system.nodes.matrix) / 576.0
        most, kept = max(20.0, 7.0 * finer), max(20.0, 10.0 * finer)
        return NewtonLimits(options.max_passes, most, kept, kept_ratio=0.5, slopes=options.slopes)
    limits = NewtonLimits(options.max_passes, slopes=options.slopes)
    return limits if problem.inflow.load_dependent else replace(limits, most_steps_on_few=0.0)


def _ended(problem: Problem, solved: Solved, options: SolverOptions) -> TrimResult:
    """Where Newton's method ended, and whether it is accepted."""
    residual, twisting, difference = _errors(solved.point, options)
    accepted = (
        max(residual, twisting) <= options.accepted_residual
        and difference <= options.accepted_inflow
    )
    converged = solved.point.size <= 1.0 or accepted
    return TrimResult(
        problem, solved.point, residual, converged, solved.passes, factors=solved.factors
    )


def first_point(problem: Problem, system: System, start: Guess) -> Array:
    """(1, numbers, states) of a guess."""
    state, terms = with_given_values(problem, start.state), problem.inflow_terms
    elastic: Array = np.zeros_like(problem.given_torsion)
    # It may have more waves, or fewer.
    if start.elastic is not None and len(start.elastic) == len(elastic):
        both = min(elastic.shape[1], start.elastic.shape[1])
        elastic[:, :both] = start.elastic[:, :both]
    inflow = start.inflow
    if inflow is None or start.inflow_kind != terms.key:
        inflow = np.zeros(0 if system.nodes is None else len(system.nodes.matrix))
    given = len(system.numbers) + len(STATE_NAMES) + elastic.size
    others = np.zeros(system.structure.given - given)
    if start.bending is not None and len(start.bending) == len(others):
        others[:] = start.bending
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
