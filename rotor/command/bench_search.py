"""The searches of `bench`: seconds that a reader waits for an optimum, and for a schedule."""

import os
import time
from dataclasses import replace

from rotor.files.make_design import make_design
from rotor.optimisation.concepts import CONCEPTS, find_concept
from rotor.optimisation.objective import WeightedCondition
from rotor.optimisation.schedule import Plan, run_plan
from rotor.optimisation.search import Search, run_search
from rotor.trim.solve import solve

TARGETS_S = {
    "optimum, two segments": 1.0,
    "optimum, three segments, 16 starts": 5.0,
    "schedule, 15 conditions, 8 concepts": 60.0,
}
"""Targets of the project [s], flight preset, one core for an optimum, two for the schedule."""

_ADVANCE_RATIOS = (0.1, 0.2, 0.3)


def measure_searches(*, long: bool) -> dict[str, float]:
    """Seconds by name; mean over three advance ratios, bands included. `long` adds the schedule."""
    figures: dict[str, float] = {}
    for name, concept, starts in (
        ("optimum, two segments", "two-segment", 6),
        ("optimum, three segments, 16 starts", "three-segment", 16),
    ):
        elapsed = 0.0
        for mu in _ADVANCE_RATIOS:
            design = make_design(preset="flight", mu=mu)
            solve(design)  # Lays out the grid and the wake once, as a page has long done.
            elapsed += run_search(Search(design, find_concept(concept), starts=starts)).elapsed
        figures[name] = elapsed / len(_ADVANCE_RATIOS)
    if long:
        design = make_design(preset="flight")
        ratios = [0.0, *(0.05 + 0.025 * k for k in range(1, 15))]
        conditions = tuple(WeightedCondition(replace(design.condition, advance_ratio=mu)) for mu in ratios)
        begin = time.perf_counter()
        run_plan(Plan(design, tuple(CONCEPTS.values()), conditions), processes=min(2, os.cpu_count() or 1))
        figures["schedule, 15 conditions, 8 concepts"] = time.perf_counter() - begin
    return figures
