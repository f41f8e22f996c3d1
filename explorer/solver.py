"""The solver behind one door, opened in the background: importing and warming it must not hold up the first page."""

import threading
from dataclasses import dataclass

from rotor.design import Design
from rotor.presets import PRESETS, make_design
from rotor.solution import Solution

_first = threading.Lock()


def solve(design: Design, start: Solution | None = None) -> Solution:
    """Trim a design, from an earlier solution if one is given."""
    with _first:
        from rotor.solve import solve as trim
    return trim(design, start)


def warm() -> None:
    """Load and run everything once that a first answer would otherwise wait for."""
    for preset in PRESETS:
        solve(make_design(preset))


@dataclass
class Baseline:
    """The baseline's answers of one session, kept while its condition stays."""

    design: Design | None = None
    solution: Solution | None = None

    def solve(self, design: Design) -> Solution:
        if self.solution is None or design != self.design:
            self.solution = solve(design, self.solution if self.solution and self.solution.converged else None)
            self.design = design
        return self.solution
