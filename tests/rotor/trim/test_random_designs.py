"""Random designs over all rotors, presets, stands, climb and descent, n/rev inputs and bending: none goes wrong.

What is checked, and what counts as right: `tests.tools.designs`.
"""

import pytest

from tests.tools.designs import FIRST, RIGHT, run, share


def check(count: int, seed: int) -> None:
    outcomes = run(count, seed)
    assert [(one.kind, one.said, one.asked) for one in outcomes if one.kind not in RIGHT] == []
    if count >= 1000:  # Three hundred have some sixty in plain level flight: one of them is 2 %.
        assert share(outcomes, plain=True) >= FIRST
    assert sum(one.kind == "trimmed" for one in outcomes) > 0.8 * count  # 88 % of 3000.


@pytest.mark.slow
def test_three_hundred_designs():
    check(300, seed=5)


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(100, 110))
def test_ten_thousand_designs(seed: int):
    check(1000, seed)
