"""The optimiser's blade beside one's own: only in the same flight, by its own trim, with the band of the difference."""

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from explorer.model.units import AVIATION, SI
from explorer.sharing.share import code_of, design_from
from explorer.tabs.optimise.optimise_panel import same_but_twist
from explorer.views.notice import comparison
from rotor import doubt, make_design, solve
from rotor.optimisation import optimise

START = make_design(mu=0.2, twist="linear:-4")


def test_the_same_flight_and_models_and_no_other():
    optimum = replace(START, twist=make_design(mu=0.2, twist="linear:-11").twist)
    assert same_but_twist(optimum, START)
    others: list[dict[str, Any]] = [{"mu": 0.21}, {"mass_kg": 9000.0}, {"inflow": "drees"}, {"rotor": "r22"}]
    for other in others:
        asked: dict[str, Any] = {"mu": 0.2, "twist": "linear:-4", **other}
        assert not same_but_twist(optimum, make_design(**asked))


def test_an_optimum_that_came_by_a_link_is_still_the_rival_with_the_same_power():
    """Ten digits of each parameter stand in a link."""
    optimum = optimise(START, "linear", starts=1).design
    sent = design_from(code_of(optimum))
    assert same_but_twist(sent, START)
    assert solve(sent).require().power.total == pytest.approx(solve(optimum).require().power.total, rel=1e-9)


def test_the_words_are_the_difference_of_two_trims_and_its_band():
    own, other = solve(START).require(), solve(make_design(mu=0.2, twist="linear:-11")).require()
    band = doubt(own, other)
    more, less = comparison(own, other, band, SI), comparison(other, own, band, SI)
    found = re.search(r"yours (\d+\.\d+) ± (\d+\.\d+) kW more: (\w+)", more)
    assert found, more
    assert float(found[1]) == pytest.approx((own.power.total - other.power.total) / 1e3, abs=0.06)
    assert float(found[2]) == pytest.approx((band.change_band or np.nan) / 1e3, abs=0.06)
    assert found[3] == band.sureness
    assert f"{found[1]} ± {found[2]} kW less" in less
    near = solve(make_design(mu=0.2, twist="linear:-11.001")).require()
    assert comparison(near, other, doubt(near, other), SI).endswith("yours the same")
    assert " hp more" in comparison(own, other, band, AVIATION)
    assert comparison(own, other, None, SI).endswith(f"yours {found[1]} kW more")
