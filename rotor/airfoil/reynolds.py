"""Polars of several Reynolds numbers: one set of polars by Mach number for each Reynolds number.

Drag of attached flow goes with a power of the Reynolds number, and lift slope and largest lift with its logarithm
(McCroskey, NASA TM-100019), so all is linear in that logarithm between two polars. Beyond them the nearest is held.
"""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from rotor.airfoil.polars import Polar
from rotor.support.arrays import Array


def _number(polar: Polar) -> float:
    """Its Reynolds number; 0 where that is not stated, which only a polar alone at its Mach number may."""
    return polar.reynolds or 0.0


def _same_mach(one: Polar, other: Polar) -> bool:
    return abs(one.mach - other.mach) < 0.01


def _same_reynolds(one: float, other: float) -> bool:
    return abs(one - other) <= 0.01 * other


def same_conditions(one: Polar, other: Polar) -> bool:
    """Whether two polars have the same Mach number, within 0.01, and Reynolds number, within 1 % or not stated."""
    numbers = _number(one), _number(other)
    return _same_mach(one, other) and (0.0 in numbers or _same_reynolds(*numbers))


def by_reynolds(polars: Sequence[Polar]) -> tuple[tuple[float, tuple[Polar, ...]], ...]:
    """Reynolds numbers, ascending, with a polar there for every Mach number; one set where no Mach number comes twice.

    The Reynolds numbers are those of the Mach numbers that come several times. At a Mach number without a polar of one,
    its own are interpolated.
    """
    of_mach = list[list[Polar]]()
    for polar in sorted(polars, key=lambda polar: polar.mach):
        if of_mach and _same_mach(polar, of_mach[-1][0]):
            of_mach[-1].append(polar)
        else:
            of_mach.append([polar])
    numbers = sorted(_number(polar) for group in of_mach if len(group) > 1 for polar in group)
    if not numbers:
        return ((_number(polars[0]), tuple(polars)),)
    several = numbers[:1] + [
        high for low, high in pairwise(numbers) if not _same_reynolds(low, high)
    ]
    return tuple(
        (number, tuple(_polar_at(group, number) for group in of_mach)) for number in several
    )


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
    ordered = sorted(polars, key=_number)
    if len(ordered) == 1:
        return ordered[0]
    known = [_number(polar) for polar in ordered]
    near = next(
        (place for place, number in enumerate(known) if _same_reynolds(number, reynolds)), None
    )
    parts = shares(known, reynolds) if near is None else ((near, 1.0),)
    if len(parts) == 1:
        return ordered[parts[0][0]]
    (first, _), (second, share) = parts
    low, high = ordered[first], ordered[second]
    start, end = (
        max(low.alpha_deg[0], high.alpha_deg[0]),
        min(low.alpha_deg[-1], high.alpha_deg[-1]),
    )
    alpha: Array = np.union1d(low.alpha_deg, high.alpha_deg)
    alpha = alpha[(alpha >= start) & (alpha <= end)]

    def between(of_low: Array, of_high: Array) -> Array:
        at_low: Array = np.interp(alpha, low.alpha_deg, of_low)
        at_high: Array = np.interp(alpha, high.alpha_deg, of_high)
        return (1.0 - share) * at_low + share * at_high

    return Polar(
        low.mach,
        reynolds,
        alpha,
        between(low.cl, high.cl),
        between(low.cd, high.cd),
        between(low.cm, high.cm),
    )
