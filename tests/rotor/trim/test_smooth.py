"""Power follows its trend along every slider: no model comes or goes under the hand."""

import math
from typing import Any, cast

import numpy as np
import pytest

from rotor import Design, make_design, optimise, solve
from rotor.design.quantities import CONDITION
from rotor.optimisation.concepts import find_concept
from rotor.trim.forward import found_course
from tests.tools.sweeps import (
    STEPS,
    Sweep,
    largest_jump,
    lasting_jump,
    random_sweep,
    sweep,
    values_of,
)

ROTORS = [("uh60a", False), ("uh60a", True), ("gazelle", False)]
HEAVY = make_design(mu=0.2, mass_kg=10900.0)
TOLERANCE = 1e-4
"""Of power: a search stops where its step is worth less."""


@pytest.mark.slow
@pytest.mark.parametrize("name", STEPS)
@pytest.mark.parametrize(("rotor", "bending"), ROTORS)
def test_power_follows_its_trend_along_a_slider(rotor: str, bending: bool, name: str):
    design = make_design(rotor=rotor, mu=0.25, bending=bending)
    found = sweep(design, name, values_of(design, name)[:: 2 if bending else 1])
    assert np.isfinite(found.power).sum() > 25
    assert not found.islands, found
    assert lasting_jump(design, found)[0] <= largest_jump(design), found


@pytest.mark.parametrize(("name", "values"), [
    ("twist", np.arange(-18.0, -15.9, 0.25)), ("mass_kg", np.arange(10_850.0, 11_000.0, 25.0)),
    ("altitude_m", np.arange(1_900.0, 2_200.0, 50.0)),
])  # fmt: skip
def test_power_follows_its_trend_where_a_twentieth_of_the_disk_stalls(
    name: str, values: np.ndarray
):
    found = sweep(HEAVY, name, values)
    assert np.isfinite(found.power).all()
    assert found.jumps.max() < 0.5


FAST_BO105 = make_design(
    rotor="bo105", mu=0.4517, mass_kg=1543.0, altitude_m=5578.0, climb_m_s=-11.58, twist="linear:-17.9",
    twist_per_rev="6:1.68:284",
)  # fmt: skip


@pytest.mark.parametrize(("design", "name", "values"), [
    (make_design(mass_kg=9_500.0), "mu", np.arange(0.4522, 0.4543, 0.0003)),
    (make_design(mass_kg=10_000.0), "mu", np.arange(0.4404, 0.4425, 0.0003)),
    (FAST_BO105, "load_factor", np.arange(1.040, 1.0428, 0.0004)),
])  # fmt: skip
def test_power_follows_its_trend_where_sections_with_a_largest_lift_lay_no_wake(
    design: Design, name: str, values: np.ndarray
):
    """The wake lies along a trim that all these have: where it ended, the wake fell back on an estimate and jumped."""
    found = sweep(design, name, values)
    assert np.isfinite(found.power).all()
    assert found.jumps.max() < 0.3
    assert all(found_course(CONDITION[name].put(design, value)) for value in values.tolist())


def test_a_jump_is_found_and_an_island_too():
    """The measure itself: a step of 2 kW on a parabola counts in full, the parabola alone does not."""
    x = np.arange(12.0)
    parabola = 900.0 + x**2
    stepped = parabola + np.where(x > 5.0, 2.0, 0.0)
    assert Sweep("mu", x, parabola).jumps.max() < 1e-9
    assert Sweep("mu", x, stepped).jumps.max() == pytest.approx(2.0, rel=0.01)
    assert Sweep("mu", x, np.where(x == 4.0, math.nan, parabola)).islands == 1


@pytest.mark.parametrize("name", ["twist_per_rev", "pitch_per_rev"])
@pytest.mark.parametrize("per_rev", [2, 3, 5, 8])
def test_power_begins_at_nought_with_pitch_at_n_per_rev(name: str, per_rev: int):
    """0.01° and its opposite lie on a line through none: the flow is the same with and without."""
    still = solve(make_design(mu=0.2)).require()
    for phase in (0, 90):
        one, other = (
            solve(
                make_design(mu=0.2, **cast(Any, {name: f"{per_rev}:0.01:{phase + turn}"})), still
            ).power.total
            for turn in (0, 180)
        )
        assert abs(0.5 * (one + other) - still.power.total) < 10.0  # [W]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mass", "mu"),
    [(10_900.0, 0.2), (8_322.0, 0.1), (9_500.0, 0.3), (7_500.0, 0.35), (10_300.0, 0.25)],
)
def test_no_slider_beats_the_search(mass: float, mu: float):
    design = make_design(mu=mu, mass_kg=mass)
    linear = optimise(design, "linear", starts=2).best
    found = sweep(design, "twist", np.arange(-20.0, -4.9, 0.5))
    assert np.nanmin(found.power) >= 1e-3 * linear.power * (1.0 - TOLERANCE)

    concept, segments = find_concept("two-segment"), optimise(design, "two-segment", starts=3)
    assert segments.best.power <= linear.power * (1.0 + TOLERANCE)
    best = np.array(segments.best.parameters)
    steps = {"rad/R": math.radians(0.5), "r/R": 0.01}
    for k, parameter in enumerate(concept.parameters):
        for times in (-12, -4, -2, -1, 1, 2, 4, 12):
            values = best.copy()
            values[k] = np.clip(
                best[k] + times * steps[parameter.unit], parameter.low, parameter.high
            )
            moved = solve(concept.apply(design, values), start=None)
            assert not moved.converged or moved.power.total >= segments.best.power * (
                1.0 - TOLERANCE
            )


@pytest.mark.nightly
@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_power_follows_its_trend_along_a_random_slider(seed: int):
    asked, design, found = random_sweep(np.random.default_rng(seed))
    assert not found.islands, (asked, found)
    assert lasting_jump(design, found)[0] <= largest_jump(design), (asked, found)
