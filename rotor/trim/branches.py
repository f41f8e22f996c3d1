"""The trim of least power, where a rotor deep in stall has several."""

import time
from dataclasses import replace

from rotor.trim.assemble import assemble
from rotor.trim.forward import trim_along
from rotor.trim.newton import SolverOptions
from rotor.trim.solution import Solution


def least_of_branches(solution: Solution, most_stalled: float, options: SolverOptions) -> Solution:
    """The trim of least power of a solution and the trim that belongs to those of easier conditions."""
    if solution.linear is None or options.asked_to_stop:
        return solution
    other = trim_along(solution.linear.problem, options, most_stalled)
    if other is None:
        return solution
    begin = time.perf_counter() - solution.elapsed
    other = assemble(replace(other, passes=solution.passes + other.passes), begin)
    if not solution.converged or not other.converged:
        return other if other.converged else solution
    return other if other.power.total < solution.power.total else solution
