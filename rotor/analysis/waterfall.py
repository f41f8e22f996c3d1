"""Power of each physical effect: from all effects off to all on, one trim per step.

The power of an effect depends on the effects already on, so it is also computed with each effect removed on its own.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rotor.aero.switches import SWITCHES, Switch, no_effect, with_switches
from rotor.design.design import Design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

PARTS = ("induced", "profile", "parasite", "tail")
"""Parts of the total, as in `PowerBudget`."""


@dataclass(frozen=True, eq=False)
class WaterfallStep:
    """One trim and its difference from a reference trim."""

    switch: Switch | None
    """The switch changed; None at the start."""
    solution: Solution
    against: Solution | None
    """The last step before it that trimmed, or the full model; None at the start."""
    note: str = ""
    """Why this switch has no effect here, as a clause."""

    @property
    def title(self) -> str:
        return self.switch.title if self.switch else "All switched off"

    @property
    def power(self) -> float | None:
        """Total [W]; None where it did not trim."""
        return self.solution.power.total if self.solution.converged else None

    @property
    def change(self) -> dict[str, float] | None:
        """What it added to each part [W]; None at the start and where it did not trim."""
        if self.against is None or not self.solution.converged:
            return None
        here, before = self.solution.power, self.against.power
        return {part: getattr(here, part) - getattr(before, part) for part in PARTS}

    @property
    def added(self) -> float | None:
        """The sum of `change` [W]."""
        change = self.change
        return None if change is None else sum(change.values())


def switch_on_steps(design: Design, order: Sequence[str] = tuple(SWITCHES)) -> Iterator[WaterfallStep]:
    """The steps of the waterfall, each trimmed when it is asked for. The design's own switches do not matter.

    A step that does not trim is skipped: the next is compared with the last that did.
    """
    left = list(order)
    solution = solve(with_switches(design, left))
    yield WaterfallStep(None, solution, None)
    last = solution if solution.converged else None
    for name in order:
        left.remove(name)
        solution = solve(with_switches(design, left), last)
        yield WaterfallStep(SWITCHES[name], solution, last, no_effect(solution.design, name))
        last = solution if solution.converged else last


def switch_off_steps(design: Design, full: Solution) -> Iterator[WaterfallStep]:
    """The full model with one switch off at a time. `full`: the same design's solution with everything on."""
    for name, switch in SWITCHES.items():
        alone = with_switches(design, (name,))
        yield WaterfallStep(switch, solve(alone, full), full if full.converged else None, no_effect(alone, name))


@dataclass(frozen=True, eq=False)
class Waterfall:
    """All steps of the waterfall."""

    steps: tuple[WaterfallStep, ...]
    """All off, then one more on at each step; the last is the full model."""
    alone: tuple[WaterfallStep, ...]
    """Each switch off alone, compared with the full model."""

    @property
    def full(self) -> Solution:
        return self.steps[-1].solution

    @property
    def converged(self) -> bool:
        return all(step.solution.converged for step in (*self.steps, *self.alone))


def waterfall(design: Design) -> Waterfall:
    """Thirteen trims: all switches on one after another, then each one off alone."""
    steps = tuple(switch_on_steps(design))
    return Waterfall(steps, tuple(switch_off_steps(design, steps[-1].solution)))
