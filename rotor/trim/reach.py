"""How far a rotor trims: what is too much stall, and the largest mass, speed and loading with less of it.

The largest values belong to a design and not to what was asked of it: trims are followed from an easy one, on steps
that do not know the value asked for.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import lru_cache

from rotor.aero.problem import Problem
from rotor.columns.blade import Freedom
from rotor.design.design import Design
from rotor.design.quantities import CONDITION, STAND
from rotor.trim.analysis import Analysis
from rotor.trim.assemble import assemble
from rotor.trim.forward import EASY_LOADING, FOLLOWING_PASSES, along, trim_on_course
from rotor.trim.hover import hover
from rotor.trim.low_speed import trim_problem, vortex_ring
from rotor.trim.newton import (
    DEFAULT_OPTIONS,
    FEW_DIGITS,
    Guess,
    SolverOptions,
    TrimResult,
    newton,
)
from rotor.trim.solution import Solution
from rotor.trim.validity import MOST_STALLED, Largest

SHARE_ERROR = 0.1
"""Difference of the stalled share of the lift's moment between the azimuths of a trim and those that are shown: less
than half of this (tested)."""
_LEAST_POWER_SPEED = 0.15
"""Advance ratio from which the largest speed is looked for: the least power is near it."""
_SPEED_STEP = 0.1
"""Step of advance ratio on the way to the largest speed. Our choice: half of it leads to the same speeds."""
_LOADING_STEP = 0.5 * EASY_LOADING
"""Step of C_T/σ on the way to the largest mass or loading. Our choice: half of it leads to the same masses."""
_HALVINGS = 5
"""Halvings of the last step: the largest mass is found to 0.0007 of C_T/σ, the largest speed to 0.003 of µ."""


def too_stalled(found: Analysis) -> bool:
    """Whether stalled sections carry more than `MOST_STALLED` of the lift's moment, in every preset.

    A section stalls where its own lift curve does. The curve of the document's polynomials does so within the range to
    which they were fitted, and all angles beyond that range are beyond stall. Fields over the whole disk are made only
    where the share on the azimuths of the trim is within `SHARE_ERROR` of the limit.
    """
    if found.linear.stalled_moment <= MOST_STALLED - SHARE_ERROR:
        return False
    return found.solution.stalled_moment > MOST_STALLED


def largest(solution: Solution, options: SolverOptions) -> Largest:
    """The largest mass and speed that trim with all else as in a refused design, or the largest C_T/σ on a stand.

    None of them is named where it is no less than in the design: it would be no remedy.
    """
    design = solution.design
    if vortex_ring(design):
        return Largest()
    try:
        if design.condition.stand is not None:
            return _largest_on_stand(design, solution.freedoms, options)
        return _largest_in_flight(design, solution.freedoms, options)
    except _Stopped:
        return Largest()


def _largest_in_flight(
    design: Design, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> Largest:
    """The largest mass, and above the speed of least power also the largest speed."""
    easy, _ = _mass_steps(design)
    mass = _largest_mass(_Question(CONDITION["mass_kg"].put(design, easy), freedoms, options))
    if mass is not None and mass >= design.condition.mass:
        mass = None
    if design.hovering:
        return Largest(mass_kg=mass, hovering=True)
    asked = design.condition.advance_ratio
    if asked <= _LEAST_POWER_SPEED:
        return Largest(mass_kg=mass)
    slow = CONDITION["mu"].put(design, _LEAST_POWER_SPEED)
    mu = _largest_speed(_Question(slow, freedoms, options))
    if mu is not None and mu >= asked:
        mu = None
    return Largest(mass_kg=mass, mu=mu)


def _largest_on_stand(
    design: Design, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> Largest:
    """The largest C_T/σ of a test that asks for a thrust; none where it gives the collective."""
    stand = design.condition.stand
    if stand is None or stand.collective is not None:
        return Largest()
    loading = _largest_loading(_Question(_loaded(design, EASY_LOADING), freedoms, options))
    if loading is not None and loading >= design.weight_coefficient / design.rotor.solidity:
        loading = None
    return Largest(ct_over_sigma=loading, hovering=design.hovering)


class _Stopped(Exception):
    """The caller wants the solve to end: nothing is known, and nothing is kept."""


@dataclass(frozen=True)
class _Question:
    """A design whose largest value of one quantity is looked for; of that quantity it has an easy value."""

    design: Design
    freedoms: tuple[Freedom, ...]
    options: SolverOptions = field(compare=False)
    """Of the refused solve: what stops it. Tolerances are fixed, so that the answer is that of the design."""

    @property
    def tolerances(self) -> SolverOptions:
        """Tolerances of the solver on the way: in hover those of a solve, in forward flight looser ones."""
        if self.design.hovering:
            return replace(DEFAULT_OPTIONS, stop=self.options.stop)
        return replace(FEW_DIGITS, max_passes=FOLLOWING_PASSES, stop=self.options.stop)


@lru_cache(maxsize=256)
def _largest_mass(question: _Question) -> float | None:
    """The largest mass [kg] at the speed of a design; None where none is known."""
    easy, step = _mass_steps(question.design)
    return _last_that_counts(_mass_follower(question), easy, step)


@lru_cache(maxsize=256)
def _largest_speed(question: _Question) -> float | None:
    """The largest advance ratio at the mass of a design; None where it does not trim at that of least power."""
    mu = CONDITION["mu"]
    start = _guess_at_least_power(question)
    if start is None:
        return None
    follower = _Follower(question, lambda value: mu.put(question.design, value), mu.high, start)
    return _last_that_counts(follower, _LEAST_POWER_SPEED, _SPEED_STEP)


@lru_cache(maxsize=256)
def _largest_loading(question: _Question) -> float | None:
    """The largest C_T/σ at the speed and tilt of a test; None where none is known."""
    follower = _Follower(
        question, lambda value: _loaded(question.design, value), STAND["ct_over_sigma"].high
    )
    return _last_that_counts(follower, EASY_LOADING, _LOADING_STEP)


def _loaded(design: Design, loading: float) -> Design:
    """A test with another C_T/σ."""
    stand = design.condition.stand
    assert stand is not None
    test = replace(stand, thrust=None, ct_over_sigma=loading)
    return replace(design, condition=replace(design.condition, stand=test))


def _guess_at_least_power(question: _Question) -> Guess | None:
    """The trim of a design to which that of a light rotor leads; None where it ends before.

    It is on the branch of attached flow, and a mass too large for the rotor is known in fewer steps than from a cold
    start.
    """
    follower = _mass_follower(question)
    mass, step = _mass_steps(question.design)
    while mass < question.design.condition.mass:
        if follower.trim(mass) is None:
            return None
        mass += step
    return follower.guess_at(question.design.condition.mass)


def _mass_follower(question: _Question) -> "_Follower":
    """Trims of a design at growing mass."""
    mass = CONDITION["mass_kg"]
    return _Follower(question, lambda value: mass.put(question.design, value), mass.high)


def _mass_steps(design: Design) -> tuple[int, int]:
    """Mass of a light rotor and step from it [kg]: whole, so that they have no digits of the mass of the design."""
    loading = design.weight_coefficient / design.rotor.solidity
    easy = round(EASY_LOADING * design.condition.mass / max(loading, 1e-9))
    easy = max(easy, int(CONDITION["mass_kg"].low))
    return easy, round(easy * _LOADING_STEP / EASY_LOADING)


class _Follower:
    """Trims of a design while one quantity grows, each begun on the secant through the two before."""

    def __init__(
        self,
        question: _Question,
        design_at: Callable[[float], Design],
        high: float,
        start: Guess | None = None,
    ) -> None:
        """`high`: the largest value of the quantity that exists; `start`: of the first trim."""
        self.high = high
        self._question = question
        self._design_at = design_at
        self._options = question.tolerances
        self._start = start
        self._trims: list[tuple[float, TrimResult]] = []

    def trim(self, value: float) -> Solution | None:
        """The solution at a value of the quantity; None where trims end or too much is stalled."""
        if self._options.asked_to_stop:
            raise _Stopped
        if value > self.high:
            return None
        problem = trim_problem(self._design_at(value), self._question.freedoms)
        result = self._result(problem, value)
        if not result.converged:
            return None
        found = assemble(result, 0.0)
        if not problem.design.hovering and too_stalled(found):
            return None
        self._trims.append((value, result))
        return found.solution

    def counts(self, value: float) -> bool:
        """Whether the trim at a value of the quantity is not refused."""
        solution = self.trim(value)
        return solution is not None and solution.converged

    def guess_at(self, value: float) -> Guess | None:
        """The guess from the trim at a value of the quantity; None as for `trim`."""
        if self.trim(value) is None:
            return None
        _, result = self._trims[-1]
        return result.guess

    def _result(self, problem: Problem, value: float) -> TrimResult:
        if problem.design.hovering:
            return hover(problem, None, self._options)
        if not self._trims:
            return trim_on_course(problem, self._start, self._options, MOST_STALLED)
        last, result = self._trims[-1]
        guess = result.guess
        if len(self._trims) > 1:
            before, earlier = self._trims[-2]
            guess = guess.ahead(earlier.guess, (value - last) / (last - before))
        found = newton(problem, replace(guess, box=None), self._options)
        lies_along_linear_trim = problem.design.models.trim != "free-rotor"
        if lies_along_linear_trim or problem.inflow.wake_along is None or not found.converged:
            return found
        # Its wake lies along the trim found, as in `trim_on_course`.
        laid = replace(problem, course=along(found, problem.course))
        return newton(laid, replace(found.guess, box=None), self._options)


def _last_that_counts(follower: _Follower, easy: float, step: float) -> float | None:
    """The largest value up to which trims are not refused; None where there is none."""
    reached = _first_that_counts(follower, easy, step)
    if reached is None:
        return None
    while follower.counts(reached + step):
        reached += step
    for _ in range(_HALVINGS):
        step *= 0.5
        if follower.counts(reached + step):
            reached += step
    return reached


def _first_that_counts(follower: _Follower, easy: float, step: float) -> float | None:
    """The first value, on whole steps from an easy one, at which a trim is not refused; None where there is none."""
    value = easy
    while value <= follower.high:
        solution = follower.trim(value)
        if solution is None:
            return None
        if solution.converged:
            return value
        # At high speed a light rotor needs more tilt of the shaft than is accepted; a heavier one does not.
        value += step
    return None
