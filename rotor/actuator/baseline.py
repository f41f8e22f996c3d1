"""What an actuator is asked for: the twists of least power at two conditions, and the fixed blade it must beat."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rotor.actuator.reach import Pair, Reached, best_fixed, best_twist
from rotor.arrays import Array
from rotor.design.twist import PiecewiseLinearTwist
from rotor.optimisation.concepts import Concept, restrict

SMOOTH_DIVISIONS = (0.4, 0.55, 0.7, 0.82)
"""r/R of the electrical segments that follow a curved twist law."""


@dataclass(frozen=True, eq=False)
class Baseline:
    """Optima of one concept for a pair of flight conditions, no actuator in sight."""

    pair: Pair
    concept: Concept
    """Its breaks held where the best fixed blade has them: an actuator cannot move them in flight."""
    best: tuple[Reached, Reached]
    """At each condition alone."""
    fixed: Reached
    """One blade for both."""

    @property
    def ideal_power(self) -> float:
        """Mean power if the twist were free to move [W]."""
        return sum(share * best.power for share, best in zip(self.pair.shares, self.best, strict=True))

    @property
    def ideal_saving(self) -> float:
        """Of free movement over the best fixed blade [W]; the shape that plies make can save a little more."""
        return self.fixed.power - self.ideal_power

    @property
    def divisions(self) -> tuple[float, ...]:
        """r/R where the concept's segments meet."""
        law = self.concept.twist(self.fixed.values)
        if isinstance(law, PiecewiseLinearTwist):
            return law.breaks
        return () if len(self.fixed.values) == 1 else SMOOTH_DIVISIONS

    def change(self, r: Array) -> Array:
        """Required change of twist from the first condition to the second at r/R [rad], zero at the cut-out."""
        first, second = (self.concept.twist(best.values) for best in self.best)
        root = self.pair.design.rotor.blade.root_cutout
        start = float(second(root) - first(root))
        return second(r) - first(r) - start

    def segment_changes(self, divisions: tuple[float, ...]) -> Array:
        """Required change over each segment, cut-out to tip [rad], (segments,)."""
        edges = np.array([self.pair.design.rotor.blade.root_cutout, *divisions, 1.0])
        return np.diff(self.change(edges))


@lru_cache(maxsize=64)
def baseline(pair: Pair, concept: Concept) -> Baseline:
    """Find the optima; free breaks are held at those of the best fixed blade.

    Raises RuntimeError with one sentence when no twist trims.
    """
    fixed = best_fixed(pair, concept)
    named = list(zip(concept.parameters, fixed.values, strict=True))
    breaks = {parameter.name: value for parameter, value in named if parameter.unit == "R"}
    if breaks:
        concept = restrict(concept, breaks)
        fixed = replace(fixed, values=tuple(value for parameter, value in named if parameter.unit != "R"))
    first, second = (best_twist(design, concept, [fixed.values]) for design in pair.designs())
    better = best_fixed(pair, concept, [fixed.values, first.values, second.values])
    return Baseline(pair, concept, (first, second), min((fixed, better), key=lambda found: found.power))
