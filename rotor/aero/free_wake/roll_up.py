"""Roll-up: from the circulation along the blade to a tip vortex and a few inboard trailers, with exact derivatives.

The lifting line is cut into strips. Each becomes one bound vortex between two trailing filaments, with the impulse
∫ Γ r dr of its strip. So the filaments as a whole keep Σγ = 0 and Σγ r², the thrust that the wake carries. Inboard
filaments leave from the borders of the strips. The tip vortex has the greatest circulation of the outer strip, as an
average weighted with Γ to a high power, and leaves from the radius that keeps the impulse: the centroid of the trailing
vorticity outboard of that maximum, as Betz's rules for roll-up have it (Betz 1932; Donaldson & Bilanin, AGARDograph
204, 1975). The weighted average has no jumps where Γ is level over part of the blade.
"""

from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array

POWER = 4
"""Power of Γ in the weight of the average that stands for the greatest circulation; even."""
INNERMOST, OUTERMOST = 0.20, 0.85
"""Part of the area of the outer strip inside of which the tip vortex leaves the blade: between these two. Where the
centroid is beyond, another circulation keeps the impulse."""
_SOFTNESS = 0.025


@dataclass(frozen=True, eq=False)
class RolledUp:
    """Filaments behind one blade, from root to tip. Circulations over ΩR², lengths over R."""

    bound: Array
    """Circulation of the strips of the lifting line, (strips,)."""
    strength: Array
    """Circulation of the filaments, positive as that of a tip vortex, (strips + 1,)."""
    release: Array
    """r/R where they leave the blade, (strips + 1,)."""
    bound_slopes: Array
    """∂bound/∂Γ, (strips, elements)."""
    strength_slopes: Array
    """∂strength/∂Γ, (strips + 1, elements)."""
    tip_slopes: Array
    """∂(release of the tip vortex)/∂Γ, (elements,)."""


@dataclass(frozen=True, eq=False)
class RollUp:
    """Strips of a lifting line with equally wide elements."""

    borders: Array
    """r/R, root to 1, (strips + 1,)."""
    moments: Array
    """∫ r dr over the part of each element in each strip, (strips, elements)."""
    lengths: Array
    """∫ dr over the part of each element in the outer strip, (elements,)."""
    power: int = POWER

    @classmethod
    def of(cls, root: float, elements: int, inboard: int, outer: float, power: int = POWER) -> "RollUp":
        """Strips from `root`: `inboard` equally wide ones up to `outer`, and the outer strip up to the tip."""
        outer = max(outer, root + 0.5 * (1.0 - root))
        borders = np.append(np.linspace(root, outer, inboard + 1), 1.0)
        edges = np.linspace(root, 1.0, elements + 1)
        low = np.maximum(edges[:-1], borders[:-1, None])
        high = np.maximum(np.minimum(edges[1:], borders[1:, None]), low)
        return cls(borders, 0.5 * (high**2 - low**2), (high - low)[-1], power)

    def __call__(self, circulation: Array) -> RolledUp:
        """The filaments of a circulation Γ/ΩR² along the blade, (elements,)."""
        squares = np.diff(self.borders**2)
        impulse = self.moments @ circulation
        by_circulation = 2.0 * self.moments / squares[:, None]
        bound = 2.0 * impulse / squares
        release = self.borders.copy()

        square, square_slopes = self._tip_square(circulation, float(impulse[-1]))
        release[-1] = np.sqrt(square)
        outer = square - self.borders[-2] ** 2
        bound[-1] = 2.0 * impulse[-1] / outer
        by_circulation[-1] = 2.0 * self.moments[-1] / outer - bound[-1] / outer * square_slopes

        trailing = np.zeros(
            (len(bound) + 1, len(bound))
        )  # What leaves at a border is the step of the bound circulation.
        trailing[1:] += np.eye(len(bound))
        trailing[:-1] -= np.eye(len(bound))
        return RolledUp(
            bound, trailing @ bound, release, by_circulation, trailing @ by_circulation,
            0.5 * square_slopes / release[-1],
        )  # fmt: skip

    def _tip_square(self, circulation: Array, impulse: float) -> tuple[float, Array]:
        """Square of the release radius of the tip vortex and its slopes by Γ."""
        inner = float(self.borders[-2]) ** 2
        area = 1.0 - inner
        size = float(np.abs(circulation).max()) or 1.0
        scaled = circulation / size
        weight = self.lengths * scaled**self.power
        low, high = float(weight.sum()), float(weight @ scaled)
        if high * impulse <= 0.0:
            return inner + OUTERMOST * area, np.zeros_like(circulation)
        raw = 2.0 * impulse / size * low / high
        slopes = raw * (
            self.moments[-1] / impulse
            + (self.power / low - (self.power + 1) / high * scaled) * self.lengths * scaled ** (self.power - 1) / size
        )
        below, above = (raw / area - INNERMOST) / _SOFTNESS, (raw / area - OUTERMOST) / _SOFTNESS
        share = INNERMOST + _SOFTNESS * (np.logaddexp(0.0, below) - np.logaddexp(0.0, above))
        return inner + area * float(share), (_logistic(below) - _logistic(above)) * slopes


def _logistic(x: float) -> float:
    return float(0.5 * (1.0 + np.tanh(0.5 * x)))
