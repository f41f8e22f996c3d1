"""From a `Design` to its `Solution`."""

import time
from collections.abc import Sequence
from dataclasses import replace

from rotor.columns.blade import Freedom
from rotor.columns.flight import check_freedoms
from rotor.design.design import Design, require_design
from rotor.support.blas_threads import one_blas_thread
from rotor.trim.analysis import Analysis
from rotor.trim.assemble import assemble
from rotor.trim.forward import first_guess, trim_along, trim_on_course
from rotor.trim.hover import hover
from rotor.trim.low_speed import trim_problem, vortex_ring
from rotor.trim.newton import DEFAULT_OPTIONS, Guess, SolverOptions, newton
from rotor.trim.reach import largest, too_stalled
from rotor.trim.secant import steps_ahead
from rotor.trim.solution import Solution, Status
from rotor.trim.validity import MOST_STALLED, largest_sentence, stalled_sentence

Start = Solution | Guess | None


def solve(
    design: Design,
    start: Start = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    *,
    freedoms: Sequence[Freedom] = (),
) -> Solution:
    """Trim a design: the controls, inflow and blade motion at which forces and moments balance.

    Parameters:
        design: the design to trim, from `make_design`.
        start: an earlier solution, or a guess, from which the iteration begins. The answer does not depend on it.
        options: limits of the iteration.
        freedoms: further freedoms of the blade, in forward flight with blades that do not bend.

    Returns:
        The trim of least power where there are several. A design that does not trim comes back as well, with
        `Status.NOT_CONVERGED` and one sentence in `message`.

    Raises:
        TypeError: a design, a start or a freedom is of another type.
        ValueError: freedoms cannot be used here, or their equations and `power` contradict their columns.

    Example:
        >>> trim = rotor.solve(rotor.make_design(twist="linear:-8", mu=0.2))
        >>> trim.converged
        True
        >>> 0.0 < trim.power.induced < trim.power.main_rotor < trim.power.total  # [W]
        True
    """
    return analyse(design, start, options, freedoms=freedoms).solution


@one_blas_thread()
def analyse(
    design: Design,
    start: Start = None,
    options: SolverOptions = DEFAULT_OPTIONS,
    *,
    freedoms: Sequence[Freedom] = (),
) -> Analysis:
    """`solve`, with the equations at the solution kept: for gradients, `doubt`, `hub_loads`. Raises as `solve` does."""
    if not isinstance(start, Solution | Guess | None):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(f"start is {start!r:.80}: give an earlier solution or leave it out")
    found = _trim_branch(require_design(design), start, options, freedoms)
    solution = replace(found.solution, before=_begun(design, start))
    found = Analysis(solution, found.linear)
    if solution.converged and not design.hovering and too_stalled(found):
        sentence = stalled_sentence(design, solution.stalled_moment)
        solution = replace(solution, status=Status.NOT_CONVERGED, message=sentence)
    if not solution.converged and options.remedy and not options.asked_to_stop:
        remedy = largest_sentence(largest(solution, options))
        solution = replace(solution, message=f"{solution.message} {remedy}".rstrip())
    return Analysis(solution, found.linear)


def _trim_branch(
    design: Design, start: Start, options: SolverOptions, freedoms: Sequence[Freedom]
) -> Analysis:
    """The trim of least power, however much is stalled."""
    begin = time.perf_counter()
    problem = trim_problem(design, freedoms)
    if freedoms:
        check_freedoms(problem)
    if vortex_ring(design):  # There is no steady wake: a state near it.
        few = replace(DEFAULT_OPTIONS, max_passes=2)
        near = hover(problem) if design.hovering else newton(problem, first_guess(problem), few)
        return assemble(replace(near, converged=False), begin)
    guess = guess_of(design, start)
    if design.hovering:
        return assemble(hover(problem, guess, options), begin)
    result = trim_on_course(problem, guess, options, MOST_STALLED)
    found = assemble(result, begin)
    if (
        design.condition.stand is not None
        or result.led
        or not (result.converged and is_suspect_branch(found))
    ):
        return found
    return _least_of_branches(found, options)


def _least_of_branches(found: Analysis, options: SolverOptions) -> Analysis:
    """Of a trim and one led from easier conditions that of less power; a rotor deep in stall has several."""
    ahead = (
        None if options.asked_to_stop else trim_along(found.linear.problem, options, MOST_STALLED)
    )
    if ahead is None:
        return found
    first = found.solution
    other = assemble(
        replace(ahead, passes=first.passes + ahead.passes), time.perf_counter() - first.elapsed
    )
    if not first.converged or not other.solution.converged:
        return other if other.solution.converged else found
    return other if other.solution.power.total < first.power.total else found


def is_suspect_branch(found: Analysis) -> bool:
    """Whether there is so much stall, or so little power, that it may not be the trim of least power."""
    return not found.solution.converged or too_stalled(found)


def guess_of(design: Design, start: Start) -> Guess | None:
    """The start of a trim; None if the earlier solution did not converge, or hovered and this design does not."""
    if not isinstance(start, Solution):
        return start
    if not start.converged or (start.design.hovering and not design.hovering):
        return None
    if (
        start.before is None
        or (steps := steps_ahead(start.before[0], start.design, design)) is None
    ):
        return start.start
    return start.start.ahead(start.before[1], steps)


def _begun(design: Design, start: Start) -> tuple[Design, Guess] | None:
    """What a solution keeps of the one that it was started from: of one for the same design, what that one keeps."""
    if not isinstance(start, Solution) or not start.converged:
        return None
    return (
        start.before if start.design == design else (start.design, replace(start.start, box=None))
    )
