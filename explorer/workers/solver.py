"""The solver as the page uses it: warmed at the start, with a cached baseline."""

from dataclasses import dataclass, replace

from rotor.design.design import PRESETS, Design
from rotor.files.make_design import make_design
from rotor.trim.adjoint import power_gradient
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def warm() -> None:
    """Compile and load everything that the first solution and its gradient would wait for."""
    for preset in PRESETS:
        for advance_ratio in (0.0, 0.2):
            power_gradient(solve(make_design(preset=preset, mu=advance_ratio)))


def compile_all() -> None:
    """Compile every kernel of the solver, so that nothing waits for it later: at set-up."""
    warm()
    for advance_ratio, models in (
        (0.0, {"hover_inflow": "free-wake"}), (0.2, {"inflow": "vortex-wake"}), (0.2, {"inflow": "local-momentum"}),
    ):  # fmt: skip
        design = make_design(mu=advance_ratio)
        power_gradient(solve(replace(design, models=replace(design.models, **models))))


def with_vortex_wake(design: Design) -> Design:
    """The same design with the reference inflow; itself in hover, which has no wake to skew."""
    return design if design.hovering else replace(design, models=replace(design.models, inflow="vortex-wake"))


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
