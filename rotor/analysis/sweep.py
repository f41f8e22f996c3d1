"""Speed sweeps: one design over many advance ratios, each trim started from its neighbour."""

from collections.abc import Iterable
from dataclasses import replace

from rotor.design.design import Design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def at_advance_ratio(design: Design, advance_ratio: float) -> Design:
    """The same design at another speed."""
    return replace(design, condition=replace(design.condition, advance_ratio=advance_ratio))


def sweep(design: Design, advance_ratios: Iterable[float], start: Solution | None = None) -> list[Solution]:
    """Solutions in the order of the advance ratios, warm-started along the way."""
    solutions: list[Solution] = []
    for advance_ratio in advance_ratios:
        solution = solve(at_advance_ratio(design, advance_ratio), start)
        if solution.converged:
            start = solution
        solutions.append(solution)
    return solutions
