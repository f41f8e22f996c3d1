"""Concepts of straight segments with movable breaks (thesis §4.1.3–4.1.5)."""

from dataclasses import dataclass, replace

import numpy as np

from rotor.arrays import Array
from rotor.design.blade import with_airfoils
from rotor.design.design import Design
from rotor.design.twist import REFERENCE_RADIUS, PiecewiseLinearTwist, TwistLaw
from rotor.optimisation.concepts.concept import Handle, Parameter, Values
from rotor.optimisation.concepts.smooth import FLATTEST, STEEPEST


@dataclass(frozen=True)
class SegmentsConcept:
    """Straight segments, continuous at their breaks. Values: the rates root to tip, then the breaks."""

    name: str
    title: str
    explanation: str
    segments: tuple[tuple[str, str], ...]
    """Name and title of each segment, root to tip."""
    breaks: tuple[tuple[str, str, float, float], ...]
    """Name, title, low and high of each break, r/R."""
    airfoils: tuple[str, ...] = ()
    """A section for each segment; none: the design's own."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        rates = (
            Parameter(f"{name}_rate", f"{title} rate", "rad/R", STEEPEST, FLATTEST) for name, title in self.segments
        )
        return (*rates, *(Parameter(name, title, "R", low, high) for name, title, low, high in self.breaks))

    @property
    def handles(self) -> tuple[Handle, ...]:
        middles = [0.5 * (low + high) for _, _, low, high in self.breaks]
        ends = (0.0, *middles, 1.0)
        tilts = (Handle(f"{name}_rate", "tilt", ends[k], ends[k + 1]) for k, (name, _) in enumerate(self.segments))
        return (*tilts, *(Handle(name, "slide", low, high) for name, _, low, high in self.breaks))

    @property
    def rate_rows(self) -> tuple[tuple[float, ...], ...]:
        n = len(self.parameters)
        return tuple(tuple(float(k == i) for k in range(n)) for i in range(len(self.segments)))

    def twist(self, values: Values) -> TwistLaw:
        n = len(self.segments)
        return PiecewiseLinearTwist(tuple(float(v) for v in values[:n]), tuple(float(v) for v in values[n:]))

    def slopes(self, values: Values, r: Array) -> Array:
        """By a rate: the length of its segment between 0.75 R and r; by a break: the jump of rate there, for r beyond.

        On the break itself the slope is that from inboard.
        """
        n = len(self.segments)
        rates, breaks = values[:n], values[n:]
        ends = (0.0, *breaks, 1.0)
        out = np.empty((len(values), len(r)))
        for k in range(n):
            out[k] = np.clip(r, ends[k], ends[k + 1]) - min(max(REFERENCE_RADIUS, ends[k]), ends[k + 1])
        for k, place in enumerate(breaks):
            out[n + k] = (rates[k] - rates[k + 1]) * ((r > place) - float(place < REFERENCE_RADIUS))
        return out

    def apply(self, design: Design, values: Values) -> Design:
        law = self.twist(values)
        rotor = design.rotor
        if self.airfoils:
            places = tuple(float(value) for value in values[len(self.segments) :])
            # SC1095 by whichever data the design has it: the document's polynomials, or the decks.
            own = {span.section.partition("-")[0]: span.section for span in rotor.blade.spans}
            rotor = with_airfoils(rotor, [own.get(name, name) for name in self.airfoils], places)
        return replace(design, twist=law, rotor=rotor)
