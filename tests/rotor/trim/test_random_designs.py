"""Random designs over all rotors, presets, stands, climb and descent, n/rev inputs and bending: none goes wrong.

What is checked, and what counts as right: `tests.tools.designs`.
"""

import pytest

from tests.tools.designs import FIRST, RIGHT, run, share


def check(count: int, seed: int) -> None:
    outcomes = run(count, seed)
    assert [(one.kind, one.said, one.asked) for one in outcomes if one.kind not in RIGHT] == []
    plain = sum(one.plain for one in outcomes)
    # Three hundred designs have some sixty in plain level flight, of which one is 2 %: a second one is chance.
    assert (1.0 - share(outcomes, plain=True)) * plain <= max((1.0 - FIRST) * plain, 2.0) + 1e-9
    assert sum(one.kind == "trimmed" for one in outcomes) > 0.8 * count  # 88 % of 3000.


@pytest.mark.slow
def test_three_hundred_designs():
    check(300, seed=5)


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(100, 110))
def test_ten_thousand_designs(seed: int):
    check(1000, seed)
