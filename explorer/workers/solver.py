"""The solver as the page uses it: warmed at the start, with a cached baseline."""

from dataclasses import dataclass

from rotor import Design, Solution, make_design, solve
from rotor.design.design import PRESETS
from rotor.trim import power_gradient


def warm() -> None:
    """Compile and load everything that a solution and its gradient would wait for, the default's first."""
    for preset in PRESETS:
        for advance_ratio in (0.2, 0.0):
            power_gradient(solve(make_design(preset=preset, mu=advance_ratio)))


def compile_all() -> None:
    """Compile every kernel of the solver, so that nothing waits for it later: at set-up."""
    warm()
    power_gradient(solve(make_design(mu=0.2, inflow="local-momentum")))
    power_gradient(solve(make_design(mu=0.2, bending=True)))


@dataclass
class BaselineCache:
    """The last baseline solution of a session, reused while its design stays the same."""

    design: Design | None = None
    solution: Solution | None = None

    def solve(self, design: Design) -> Solution:
        if self.solution is None or design != self.design:
            self.solution = solve(design, self.solution if self.solution and self.solution.converged else None)
            self.design = design
        return self.solution
