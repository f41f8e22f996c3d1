"""How alike two trims are whose equations are the same."""

from dataclasses import astuple, replace

from numpy.testing import assert_allclose

from rotor.trim.newton import DEFAULT_OPTIONS
from rotor.trim.solution import Caveat, DiskFields, Solution

SAME = 10.0 * DEFAULT_OPTIONS.residual_tolerance
"""Part of power by which two trims may differ that are solved apart, even with equal equations: processors sum in
different orders, and a step that ends just within the tolerance on one ends just beyond it on another. The tolerance is
`residual_tolerance` of the weight; power may move by ten times as much."""


def assert_same_trim(one: Solution, other: Solution) -> None:
    """Power by parts, of the total, and controls [rad]."""
    total = abs(other.require().power.total)
    assert_allclose(astuple(one.require().power), astuple(other.power), rtol=0.0, atol=SAME * total)
    assert_allclose(astuple(one.controls), astuple(other.controls), rtol=0.0, atol=SAME)


def with_caveats(solution: Solution, *caveats: Caveat) -> Solution:
    """The solution with other caveats."""
    return replace(solution, find_shown=lambda _: replace(solution.shown, caveats=caveats))


def with_disk(solution: Solution, disk: DiskFields) -> Solution:
    """The solution with other fields over the disk."""
    return replace(solution, find_shown=lambda _: replace(solution.shown, disk=disk))
