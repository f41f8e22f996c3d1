"""Loads and flow of one blade by radius and azimuth: identities with the solution and with its section data."""

import json
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor import Distribution, Solution, distribution
from rotor.aero.problem import LOW_MACH, build_problem
from rotor.aero.unsteady_section import SLOWEST
from rotor.airfoil.stall_delay import delay_gain, delayed_lift


def with_models(design: rotor.Design, **models: object) -> rotor.Design:
    return replace(design, models=replace(design.models, **models))


@pytest.fixture(scope="module")
def flight() -> Solution:
    return rotor.solve(with_models(rotor.make_design(mu=0.3), inflow="lifting-line")).require()


@pytest.fixture(scope="module")
def steady() -> Solution:
    """What the section data say at each place and time, without memory."""
    return rotor.solve(rotor.make_design(mu=0.3, off="unsteady,dynamic-stall")).require()


@pytest.fixture(scope="module")
def hovering() -> Solution:
    return rotor.solve(rotor.make_design(hover=True)).require()


@pytest.fixture(scope="module")
def found(flight: Solution) -> Distribution:
    return distribution(flight)


@pytest.mark.parametrize("which", ["flight", "hovering"])
def test_lift_of_all_blades_is_the_thrust(which: str, request: pytest.FixtureRequest):
    solution: Solution = request.getfixturevalue(which)
    made, head = distribution(solution), solution.design.rotor
    thrust = head.blades * head.radius * float(solution.disk.dr @ made.lift.mean(axis=1))
    assert thrust == pytest.approx(solution.ct * solution.design.thrust_unit, rel=1e-3)


def by_coefficients(solution: Solution) -> tuple[Distribution, np.ndarray, np.ndarray]:
    """½ρ c (U C_l U_T − V C_d U_P) of a lifting line, which has no loss factor, and ½ρ U² c."""
    disk, design, found = solution.disk, solution.design, distribution(solution)
    head = design.rotor
    chord = (
        build_problem(design).disk.half_solidity[:, None]
        * 2.0
        * math.pi
        * head.radius
        / head.blades
    )
    speed = np.hypot(disk.u_t, disk.u_p)
    gain = 0.5 * design.condition.density * head.tip_speed**2 * chord
    return (
        found,
        gain * (speed * found.cl * disk.u_t - np.hypot(speed, disk.u_r) * disk.cd * disk.u_p),
        gain * speed**2,
    )


def test_lift_is_that_of_the_coefficients(steady: Solution):
    """Near ½ρ U² c C_l where U_P is small."""
    found, exact, gain = by_coefficients(steady)
    assert_allclose(found.lift, exact, rtol=1e-12, atol=1e-9)
    i, j = int(np.argmin(np.abs(found.r - 0.75))), int(np.argmin(np.abs(found.psi - 0.5 * math.pi)))
    assert found.lift[i, j] == pytest.approx((gain * found.cl)[i, j], rel=0.01)


def test_lift_of_unsteady_flow_has_apparent_mass(flight: Solution):
    """But for what the axis of pitch is off the quarter chord, which `DiskFields.apparent` leaves out."""
    found, circulatory, gain = by_coefficients(flight)
    disk = flight.disk
    held = 1.0 + SLOWEST**2 / (disk.u_t**2 + disk.u_p**2)
    pushed = gain * held * disk.apparent[0] * np.cos(disk.theta)
    error = np.abs(found.lift - circulatory - pushed)
    assert np.quantile(error, 0.95) < 0.02 * np.abs(pushed).max()
    assert error.max() < 0.1 * np.abs(pushed).max()


def blended(solution: Solution, coefficient: Callable[..., np.ndarray]) -> np.ndarray:
    """A coefficient at the flow of a solution, one element and azimuth at a time.

    coefficient: of a table, its g of the delay of stall, α and Mach number.
    """
    disk, blade = solution.disk, solution.design.rotor.blade
    out = np.empty_like(disk.alpha)
    for i, j in np.ndindex(*out.shape):
        inner, outer, share = blade.section_at(float(disk.r[i]))
        parts = blade.installed(inner), blade.installed(outer)
        ratio = (1.0 - share) * parts[0].chord_ratio + share * parts[1].chord_ratio
        chord = blade.chord(float(disk.r[i])) * ratio
        gain = delay_gain(chord / (disk.r[i] * solution.design.rotor.radius))
        values = [
            coefficient(
                at.table, float(gain), disk.alpha[i, j] - at.incidence_offset, disk.mach[i, j]
            )
            for at in parts
        ]
        out[i, j] = (1.0 - share) * values[0] + share * values[1]
    return out


def test_coefficients_are_those_of_the_section_data(steady: Solution):
    """The look-up of C_m gives the solution's own C_l, so it is at the right angle and Mach number."""
    found = distribution(steady)
    moments = blended(steady, lambda table, gain, alpha, mach: table.moment(alpha, mach))
    assert_allclose(found.cl, blended(steady, delayed_lift), atol=1e-9)
    assert_allclose(found.cm, moments, atol=1e-12)
    assert -0.1 < found.cm[found.r > 0.5].mean() < 0.0


def test_sections_without_moments_have_none():
    made = distribution(rotor.solve(rotor.make_design(preset="thesis", mu=0.2)).require())
    assert np.isnan(made.cm).all()
    record = json.loads(json.dumps(made.to_dict(), allow_nan=False))
    assert record["cm"][3][5] is None
    assert record["cl"][3][5] is not None


def test_models_that_are_switched_off(steady: Solution):
    """Without reverse flow there is no load, hence no moment, inside its circle; one Mach number for all sections."""
    design = steady.design
    solution = rotor.solve(with_models(design, reverse_flow=False, compressibility=False)).require()
    made, inside = (
        distribution(solution),
        solution.disk.r[:, None] + 0.3 * np.sin(solution.disk.psi) < 0.0,
    )
    for field in (made.lift, made.cl, made.cm):
        assert (field[inside] == 0.0).all()
    table = design.rotor.blade.installed("sc1095").table
    k = int(np.argmin(np.abs(made.r - 0.95)))
    there = table.moment(made.alpha[k], LOW_MACH)
    assert there is not None
    assert_allclose(made.cm[k], there, atol=1e-12)


def test_table(found: Distribution):
    rows = [line.split() for line in found.table().splitlines()[1:]]
    assert 6 <= len(rows) <= 9
    for r, mean, most, where in rows:
        i = int(np.argmin(np.abs(found.r - float(r))))
        assert float(mean) == pytest.approx(found.lift[i].mean(), abs=0.6)
        assert float(most) == pytest.approx(found.lift[i].max(), abs=0.6)
        at = int(np.argmin(np.abs(np.degrees(found.psi) - float(where.rstrip("°")))))
        assert found.lift[i, at] == found.lift[i].max()


def test_a_design_that_does_not_trim_has_none():
    with pytest.raises(RuntimeError):
        distribution(rotor.solve(rotor.make_design(hover=True, mass_kg=18_000)))
