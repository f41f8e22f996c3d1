"""Newton's method with kept factors on three equations in which a channel is squared."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import root  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

from rotor.engine.linearise import Grid, Shapes, System, evaluate
from rotor.engine.newton import Factors, NewtonLimits, solve
from rotor.engine.terms import Structure
from rotor.engine.waves import COS, SIN, STEADY, wave_grid
from rotor.support.arrays import Array

WANTED = (1.5, 0.6, -0.4)
STATES = tuple(zip(("mean", "cosine", "sine"), (STEADY, COS, SIN), strict=True))


def system(
    wanted: tuple[float, ...] = WANTED, largest: float = math.inf, limit: float = 100.0
) -> System:
    """Means of c² with 1, cos ψ and sin ψ as wanted, c = a + b cos ψ + d sin ψ; no number beyond c = `largest`."""
    s = Structure(((0, 0),), 1, 1, "square")
    for name in ("wanted", *(("wanted", wave) for wave in range(3))):
        s.number(name)
    states = [s.state(name) for name, _ in STATES]
    for (name, wave), state in zip(STATES, states, strict=True):
        s.column(0, "one", wave, 1.0, state)
        row = s.equation(name)
        s.term(row, 1.0, q=s.measure(0, "one", wave))
        s.term(row, -1.0, s.numbers["wanted", wave])
    s.finish(states)

    def section(c: Array, data: Any, slopes: bool, flow: bool) -> tuple[Array, Array, Array]:
        del data
        f = np.where(c > largest, math.nan, c * c)
        return (
            f,
            2.0 * c if slopes else np.zeros((1, 0, c.shape[2])),
            np.zeros((0, int(flow), c.shape[2])),
        )

    grid, thin = (Grid(wave_grid(s.waves, m), np.zeros((1, 1)), {}, None) for m in (16, 8))
    return System(
        s, Shapes(s, {"one": np.ones(1)}, np.ones(1)), grid, thin, section,
        lambda x: (np.zeros(0), np.zeros((0, 0)), {}),
        np.array([1.0, 0.0, *wanted]), np.full(3, 1e-12), np.full(3, limit),
    )  # fmt: skip


def at(of: System, *states: float) -> Array:
    return np.array([*of.numbers, *states])


def limits(steps: float) -> NewtonLimits:
    return NewtonLimits(40, steps, steps, 0.03)


def expected(start: tuple[float, ...], wanted: tuple[float, ...] = WANTED) -> Array:
    """The root by SciPy: the means of c² written out."""

    def residual(x: Array) -> list[float]:
        a, b, d = x
        return [a * a + 0.5 * (b * b + d * d) - wanted[0], a * b - wanted[1], a * d - wanted[2]]

    found = root(residual, start, tol=1e-14)
    assert found.success
    return found.x


@pytest.mark.parametrize("steps", [0.0, 4.0, math.inf])
def test_the_root_is_that_of_scipy(steps: float):
    """New derivatives at every step, where they serve, and once for all."""
    one = system()
    found = solve(one, at(one, 1.0, 0.4, -0.2), None, limits(steps))
    assert found.point.size <= 1.0
    assert_allclose(found.point.x[-3:], expected((1.0, 0.4, -0.2)), rtol=1e-11)


def test_kept_factors_are_corrected_by_what_steps_have_shown(evaluated: list[Factors]):
    """From a root elsewhere no derivatives are evaluated, and fewer steps needed than without corrections."""
    one, other = system(), system((1.2, 0.3, -0.5))
    kept = solve(other, at(other, 1.0, 0.4, -0.2), None, limits(4.0))
    evaluated.clear()
    x = at(one, *kept.point.x[-3:])
    found = solve(one, x, kept.factors, limits(math.inf))
    assert found.point.size <= 1.0
    assert not evaluated
    assert_allclose(found.point.x[-3:], expected((1.0, 0.4, -0.2)), rtol=1e-11)
    plain, passes = x.copy(), 1
    while (point := evaluate(one, one.grid, plain)).size > 1.0:
        plain[-3:] -= kept.factors.solve(point.residual)
        passes += 1
    assert found.passes < 0.7 * passes


def test_no_step_is_longer_than_its_limit():
    one = system(limit=0.01)
    one = replace(one, thin=one.grid)
    found = solve(one, at(one, 1.0, 0.4, -0.2), None, NewtonLimits(4, 0.0, 0.0, 0.03))
    assert found.passes == 4
    assert_allclose(np.abs(found.point.x[-3:] - [1.0, 0.4, -0.2]).max(), 0.03, atol=0.003)


def test_a_singular_system_ends():
    """At c = 0 nothing changes c², and at a = 0 only its mean follows."""
    one = system()
    for start in ((0.0, 0.0, 0.0), (0.0, 1.0, 1.0)):
        found = solve(one, at(one, *start), None, limits(4.0))
        assert found.point.size > 1.0
        assert found.passes <= limits(4.0).most_passes
    assert not Factors.of(evaluate(one, one.grid, at(one, 0.0, 0.0, 0.0), slopes=True)).usable


def test_what_is_not_a_number_ends_or_is_stepped_back_from():
    nowhere, above = system(largest=0.0), system(largest=3.0)
    for one in (nowhere, system((math.nan, 0.0, 0.0))):
        found = solve(one, at(one, 1.0, 0.4, -0.2), None, limits(4.0))
        assert found.point.size == math.inf
        assert found.passes < 5
    start = (0.25, 0.2, -0.1)  # The first step goes beyond.
    x = at(above, *start)
    assert not np.isfinite(
        evaluate(above, above.grid, x + np.array(5 * [0.0] + [4.0, 0.0, 0.0])).residual
    ).all()
    found = solve(above, x, None, limits(4.0))
    assert found.point.size <= 1.0
    assert_allclose(np.abs(found.point.x[-3:]), np.abs(expected((1.0, 0.4, -0.2))), rtol=1e-11)
