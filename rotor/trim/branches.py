"""The trim of least power, where a rotor deep in stall has several."""

import time
from dataclasses import replace

from rotor.trim.analysis import Analysis
from rotor.trim.assemble import assemble
from rotor.trim.forward import trim_along
from rotor.trim.newton import SolverOptions


def least_of_branches(found: Analysis, most_stalled: float, options: SolverOptions) -> Analysis:
    """The trim of least power of one found and the trim that belongs to those of easier conditions."""
    ahead = None if options.asked_to_stop else trim_along(found.linear.problem, options, most_stalled)
    if ahead is None:
        return found
    first = found.solution
    other = assemble(replace(ahead, passes=first.passes + ahead.passes), time.perf_counter() - first.elapsed)
    if not first.converged or not other.solution.converged:
        return other if other.solution.converged else found
    return other if other.solution.power.total < first.power.total else found
