"""Many designs at once: those of one condition in step, from one start, all others by themselves.

A design in step takes the steps that it takes alone, so its answer depends on no other design. It is trimmed by itself
where it does not converge with the derivatives of the start, or where `solve` would look for another trim.
"""

import time
from collections.abc import Iterable, Sequence
from dataclasses import replace

from rotor.design.design import Design, require_design
from rotor.support.blas_threads import one_blas_thread
from rotor.trim.analysis import Analysis
from rotor.trim.assemble import assemble
from rotor.trim.forward import as_built, start_as_built
from rotor.trim.low_speed import trim_problem, vortex_ring
from rotor.trim.newton import DEFAULT_OPTIONS, SolverOptions, newton_together
from rotor.trim.solution import Solution
from rotor.trim.solve import Start, analyse, guess_of, is_suspect_branch

BATCH = 32
"""Designs in one step: their fields then stay in the processor's cache. Our choice."""


def solve_many(
    designs: Iterable[Design], options: SolverOptions = DEFAULT_OPTIONS
) -> list[Solution]:
    """Trim many designs. Where they differ in twist alone and the inflow is a lifting line, they are trimmed in step.

    That saves time where their twists are near each other; all others take as long as with `solve`, one by one.

    Parameters:
        designs: in any order, of any flight conditions and rotors.
        options: limits of the iteration.

    Returns:
        Their solutions in the same order. Each equals that of `solve` to rounding, whatever the other designs are.
        They are light: fields over the disk and caveats are worked out when they are read.

    Raises:
        TypeError: an item is not a design.

    Example:
        >>> designs = [rotor.make_design(twist=f"linear:{rate}", mu=0.3) for rate in (-8, -10, -12)]
        >>> [solution.converged for solution in rotor.solve_many(designs)]
        [True, True, True]
    """
    if isinstance(designs, Design):
        raise TypeError(
            "designs is one design: give several in a list, or write rotor.solve(design)"
        )
    return [trim.solution.light() for trim in analyse_many(list(designs), options=options)]


def analyse_many(
    designs: Sequence[Design],
    starts: Sequence[Start] = (),
    options: SolverOptions = DEFAULT_OPTIONS,
) -> list[Analysis]:
    """`solve_many`, with the equations at the solutions kept.

    starts: for each an earlier solution, or a guess, from which it begins; in step all take the factors of the first.
    """
    starts = starts or [None] * len(designs)
    groups, trims = dict[Design, list[int]](), dict[int, Analysis]()
    for k, design in enumerate(designs):
        groups.setdefault(as_built(require_design(design)), []).append(k)
    for group in groups.values():
        for first in range(0, len(group), BATCH):
            some = group[first : first + BATCH]
            if len(some) > 1 and not options.asked_to_stop:
                found = analyse_in_step(
                    [designs[k] for k in some], [starts[k] for k in some], options
                )
                trims |= {k: trim for k, trim in zip(some, found, strict=True) if trim is not None}
            for k in some:
                if k not in trims:
                    trims[k] = analyse(designs[k], starts[k], options)
    return [trims[k] for k in range(len(designs))]


@one_blas_thread()
def analyse_in_step(
    designs: Sequence[Design], starts: Sequence[Start], options: SolverOptions = DEFAULT_OPTIONS
) -> Sequence[Analysis | None]:
    """Trims of designs that differ in their twist alone; None for those that have to be trimmed by themselves."""
    begin, one = time.perf_counter(), designs[0]
    if one.hovering or one.condition.stand is not None or vortex_ring(one):
        return [None] * len(designs)
    built = start_as_built(trim_problem(one))
    if built is None:
        return [None] * len(designs)
    problems = [trim_problem(design) for design in designs]
    guesses = [
        guess_of(design, start) or built for design, start in zip(designs, starts, strict=True)
    ]
    if guesses[0].factors is None:
        guesses[0] = replace(guesses[0], box=built.box, structure=built.structure)
    results = newton_together(problems, guesses, options)
    each = (time.perf_counter() - begin) / len(designs)
    trims = [
        None if result is None else assemble(result, time.perf_counter() - each)
        for result in results
    ]
    return [None if trim is None or is_suspect_branch(trim) else trim for trim in trims]
