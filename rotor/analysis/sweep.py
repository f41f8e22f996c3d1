"""Speed sweeps: one design over many advance ratios, each trim started from its neighbour."""

from collections.abc import Iterable

from rotor.design.design import Design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def sweep(design: Design, advance_ratios: Iterable[float], start: Solution | None = None) -> list[Solution]:
    """Solutions in the order of the advance ratios, warm-started along the way."""
    solutions: list[Solution] = []
    for advance_ratio in advance_ratios:
        solution = solve(design.at(mu=advance_ratio), start)
        if solution.converged:
            start = solution
        solutions.append(solution)
    return solutions
