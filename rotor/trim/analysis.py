"""What is asked of one solution beyond its numbers, kept by whoever asks and gone with it."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

from rotor.aero.problem import Problem
from rotor.columns.flight import flight_system
from rotor.engine.linearise import evaluate
from rotor.support.arrays import Array
from rotor.support.blas_threads import one_blas_thread
from rotor.trim.adjoint import Adjoint, Objective, PitchGradient, power_along
from rotor.trim.hover import hover
from rotor.trim.low_speed import trim_problem
from rotor.trim.newton import LinearisedTrim, first_point
from rotor.trim.power_changes import power_changes
from rotor.trim.solution import Solution, require_solution


class Analysis:
    """A solution with its equations, linearised there; slopes of power share one adjoint. Not for another process.

    The slopes raise RuntimeError with the solution's sentence when it is not converged.
    """

    def __init__(self, solution: Solution, linear: LinearisedTrim | None = None) -> None:
        """linear: of the very trim, as `analyse` has it; None: its equations are evaluated once more when needed."""
        self.solution, self._linear = solution, linear

    @cached_property
    def linear(self) -> LinearisedTrim:
        """The equations at the solution."""
        solution = self.solution
        if self._linear is not None:
            return self._linear
        with one_blas_thread():
            problem = problem_of(solution)
            if solution.design.hovering:
                return hover(problem, solution.start).linear
            system = flight_system(problem)
            x = first_point(problem, system, solution.start)
            return LinearisedTrim(problem, evaluate(system, system.grid, x, slopes=True, flow=True))

    @cached_property
    def adjoint(self) -> Adjoint:
        """The adjoint of the trim, from which the gradient of any measure follows."""
        return Adjoint(self.solution.require(), self.linear)

    @cached_property
    def gradient(self) -> PitchGradient:
        """Gradient of total power by the pitch of each element, ∂P/∂θ(r) [W/rad]."""
        return power_along(self.adjoint)

    @cached_property
    def power_changes(self) -> Mapping[str, Array]:
        """Effect of each uncertain input on power [W], see `rotor.trim.power_changes`."""
        return power_changes(self.adjoint)


def problem_of(solution: Solution) -> Problem:
    """The problem that it solves, with its wake along the course that it was found with."""
    problem = trim_problem(solution.design, solution.freedoms)
    return (
        problem if solution.wake_course is None else replace(problem, course=solution.wake_course)
    )


def analysed(given: Solution | Analysis) -> Analysis:
    """The analysis itself, or that of a solution."""
    return given if isinstance(given, Analysis) else Analysis(require_solution(given))


def power_gradient(given: Solution | Analysis, objective: Objective = "total") -> PitchGradient:
    """∂P/∂θ [W/rad] by the pitch of each element of a converged solution, for `total` or `induced` power.

    Raises RuntimeError with the solution's sentence when it is not converged.
    """
    return power_along(analysed(given).adjoint, objective)
