"""How far a rotor trims: what is too much stall, and the largest mass, speed and loading with less of it.

The largest values belong to a design and not to what was asked of it: trims are followed from an easy one, on steps
that do not know the value asked for.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from rotor.aero.problem import Problem
from rotor.columns.blade import Freedom
from rotor.design.aircraft import Stand
from rotor.design.design import Design
from rotor.design.quantities import CONDITION, STAND
from rotor.trim.analysis import Analysis
from rotor.trim.assemble import assemble
from rotor.trim.forward import EASY_LOADING, FOLLOWING_PASSES, trim_on_course
from rotor.trim.low_speed import trim_problem, vortex_ring
from rotor.trim.newton import FEW_DIGITS, Guess, SolverOptions, TrimResult, newton
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
    """The largest mass and speed that trim with all else as in a refused design, or the largest C_T/σ on a stand."""
    design = solution.design
    if design.hovering or vortex_ring(design):
        return Largest()
    few = replace(FEW_DIGITS, max_passes=FOLLOWING_PASSES, stop=options.stop)
    stand = design.condition.stand
    if stand is None:
        return Largest(
            mass_kg=_largest_mass(design, solution.freedoms, few),
            mu=_largest_speed(design, solution.freedoms, few),
        )
    if stand.collective is None and design.models.trim == "wind-tunnel":
        return Largest(ct_over_sigma=_largest_loading(design, stand, solution.freedoms, few))
    return Largest()


def _largest_mass(
    design: Design, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> float | None:
    """The largest mass [kg] at the speed of a design; None where none is known."""
    follower = _mass_follower(design, freedoms, options)
    easy, step = _mass_steps(design)
    return _last_that_counts(follower, easy, step, design.condition.mass)


def _largest_speed(
    design: Design, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> float | None:
    """The largest advance ratio at the mass of a design; None where it does not trim at that of least power."""
    mu = CONDITION["mu"]
    asked = design.condition.advance_ratio
    if asked <= _LEAST_POWER_SPEED:
        return None
    start = _guess_at_least_power(mu.put(design, _LEAST_POWER_SPEED), freedoms, options)
    if start is None:
        return None
    follower = _Follower(lambda value: mu.put(design, value), mu.high, freedoms, options, start)
    return _last_that_counts(follower, _LEAST_POWER_SPEED, _SPEED_STEP, asked)


def _guess_at_least_power(
    design: Design, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> Guess | None:
    """The trim of a design to which that of a light rotor leads; None where it ends before.

    It is on the branch of attached flow, and a mass too large for the rotor is known in fewer steps than from a cold
    start.
    """
    follower = _mass_follower(design, freedoms, options)
    mass, step = _mass_steps(design)
    while mass < design.condition.mass:
        if follower.trim(mass) is None:
            return None
        mass += step
    return follower.guess_at(design.condition.mass)


def _largest_loading(
    design: Design, stand: Stand, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> float | None:
    """The largest C_T/σ at the speed and tilt of a test; None where none is known."""

    def loaded(value: float) -> Design:
        test = replace(stand, thrust=None, ct_over_sigma=value)
        return replace(design, condition=replace(design.condition, stand=test))

    follower = _Follower(loaded, STAND["ct_over_sigma"].high, freedoms, options)
    asked = design.weight_coefficient / design.rotor.solidity
    return _last_that_counts(follower, EASY_LOADING, _LOADING_STEP, asked)


def _mass_follower(
    design: Design, freedoms: tuple[Freedom, ...], options: SolverOptions
) -> "_Follower":
    mass = CONDITION["mass_kg"]
    return _Follower(lambda value: mass.put(design, value), mass.high, freedoms, options)


def _mass_steps(design: Design) -> tuple[int, int]:
    """Mass of a light rotor and step from it [kg]: whole, so that they have no digits of the mass of the design."""
    loading = design.weight_coefficient / design.rotor.solidity
    easy = round(EASY_LOADING * design.condition.mass / max(loading, 1e-9))
    easy = max(easy, int(CONDITION["mass_kg"].low))
    return easy, round(easy * _LOADING_STEP / EASY_LOADING)


@dataclass(eq=False)
class _Follower:
    """Trims of a design while one quantity grows, each begun on the secant through the two before."""

    design_at: Callable[[float], Design]
    high: float
    """The largest value of the quantity that exists."""
    freedoms: tuple[Freedom, ...]
    options: SolverOptions
    start: Guess | None = None
    """Of the first trim."""

    def __post_init__(self) -> None:
        self._trims: list[tuple[float, TrimResult]] = []

    def trim(self, value: float) -> Solution | None:
        """The solution at a value of the quantity; None where trims end, too much is stalled, or the caller stops."""
        if value > self.high or self.options.asked_to_stop:
            return None
        problem = trim_problem(self.design_at(value), self.freedoms)
        result = self._result(problem, value)
        if not result.converged:
            return None
        found = assemble(result, 0.0)
        if too_stalled(found):
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
        if not self._trims:
            return trim_on_course(problem, self.start, self.options, MOST_STALLED)
        last, result = self._trims[-1]
        guess = result.guess
        if len(self._trims) > 1:
            before, earlier = self._trims[-2]
            guess = guess.ahead(earlier.guess, (value - last) / (last - before))
        return newton(problem, replace(guess, box=None), self.options)


def _last_that_counts(follower: _Follower, easy: float, step: float, asked: float) -> float | None:
    """The largest value up to which trims are not refused; None where there is none below the one asked for."""
    reached = _first_that_counts(follower, easy, step, asked)
    if reached is None:
        return None
    while reached < asked and follower.counts(reached + step):
        reached += step
    for _ in range(_HALVINGS):
        step *= 0.5
        if follower.counts(reached + step):
            reached += step
    # The design was refused at the value asked for, so that no value beyond it is a remedy.
    if reached >= asked or follower.options.asked_to_stop:
        return None
    return reached


def _first_that_counts(follower: _Follower, easy: float, step: float, asked: float) -> float | None:
    """The first value, on whole steps from an easy one, at which a trim is not refused; None as above."""
    value = easy
    while value < asked:
        solution = follower.trim(value)
        if solution is None:
            return None
        if solution.converged:
            return value
        # At high speed a light rotor needs more tilt of the shaft than is accepted; a heavier one does not.
        value += step
    return None
