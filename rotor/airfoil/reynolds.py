"""Polars of several Reynolds numbers: one set of polars by Mach number for each Reynolds number.

Drag of attached flow goes with a power of the Reynolds number, and lift slope and largest lift with its logarithm
(McCroskey, NASA TM-100019), so all is linear in that logarithm between two polars. Beyond them the nearest is held.
"""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from rotor.airfoil.polars import Polar
from rotor.arrays import Array


def same_mach(one: Polar, other: Polar) -> bool:
    """Whether two polars count as of one Mach number: within 0.01."""
    return abs(one.mach - other.mach) < 0.01


def same_reynolds(one: float, other: float) -> bool:
    """Whether two Reynolds numbers count as one: within 1 %."""
    return abs(one / other - 1.0) <= 0.01


def by_reynolds(polars: Sequence[Polar]) -> tuple[tuple[float, tuple[Polar, ...]], ...]:
    """Reynolds numbers, ascending, with a polar there for every Mach number; one set where no Mach number comes twice.

    The Reynolds numbers are those of the Mach numbers that come several times. At a Mach number without a polar of one,
    its own are interpolated.
    """
    of_mach = list[list[Polar]]()
    for polar in sorted(polars, key=lambda polar: polar.mach):
        if of_mach and same_mach(polar, of_mach[-1][0]):
            of_mach[-1].append(polar)
        else:
            of_mach.append([polar])
    numbers = sorted(polar.reynolds for group in of_mach if len(group) > 1 for polar in group)
    if not numbers:
        return ((polars[0].reynolds, tuple(polars)),)
    several = numbers[:1] + [high for low, high in pairwise(numbers) if not same_reynolds(low, high)]
    return tuple((number, tuple(_polar_at(group, number) for group in of_mach)) for number in several)


def shares(known: Sequence[float], reynolds: float) -> tuple[tuple[int, float], ...]:
    """Places among Reynolds numbers, ascending, with their shares, linear in the logarithm; the ends are held."""
    after = int(np.searchsorted(known, reynolds))
    if after in (0, len(known)) or known[after] == reynolds:
        return ((min(after, len(known) - 1), 1.0),)
    low, high = known[after - 1], known[after]
    share = math.log(reynolds / low) / math.log(high / low)
    return (after - 1, 1.0 - share), (after, share)


def _polar_at(polars: Sequence[Polar], reynolds: float) -> Polar:
    """The polar of one Mach number at a Reynolds number, over the angles that both of its neighbours have."""
    ordered = sorted(polars, key=lambda polar: polar.reynolds)
    near = next((polar for polar in ordered if same_reynolds(polar.reynolds, reynolds)), None)
    parts = shares([polar.reynolds for polar in ordered], reynolds)
    if near is not None or len(parts) == 1:
        return near or ordered[parts[0][0]]
    weighted = [(ordered[place], share) for place, share in parts]
    low, high = (polar for polar, _ in weighted)
    start, end = max(low.alpha_deg[0], high.alpha_deg[0]), min(low.alpha_deg[-1], high.alpha_deg[-1])
    alpha = np.union1d(low.alpha_deg, high.alpha_deg)
    alpha = alpha[(alpha >= start) & (alpha <= end)]

    def between(name: str) -> Array:
        parts = (weight * np.interp(alpha, polar.alpha_deg, getattr(polar, name)) for polar, weight in weighted)
        return sum(parts, np.zeros(len(alpha)))

    return Polar(low.mach, reynolds, alpha, between("cl"), between("cd"), between("cm"))
