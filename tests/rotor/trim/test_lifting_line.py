"""Trims with the lifting line: its wake along the trim, converged on its grid, exact gradient, no step to hover."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, Solution, make_design, optimise, solve
from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import Losses
from rotor.aero.inflow.lifting_line import (
    CIRCULATION,
    LINE_PAIRS,
    LiftingLineInflow,
    LiftingLineTerms,
)
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.section import UP, UT
from rotor.airfoil.sections import load_section
from rotor.columns.flight import disk_sums
from rotor.engine.newton import Factors
from rotor.trim import analyse, power_gradient
from rotor.trim.forward import along, trim
from rotor.trim.low_speed import trim_problem
from rotor.trim.power import power_budget
from rotor.validation import design_at, load_set


def line(
    mu: float, twist: str = "linear:-12", mass: float = 1.0, blades: int = 4, **models: Any
) -> Design:
    """A UH-60A with the lifting line; mass: as a part of its own; blades: of the same solidity."""
    design = make_design(mu=mu, twist=twist)
    blade = design.rotor.blade
    if blades != design.rotor.blades:
        share = design.rotor.blades / blades
        blade = replace(blade, chords=tuple(share * chord for chord in blade.chords))
        rotor = replace(design.rotor, blade=blade, blades=blades)
        design = replace(design, rotor=rotor)
    condition = replace(design.condition, mass=mass * design.condition.mass)
    return replace(
        design,
        condition=condition,
        models=replace(design.models, **{"inflow": "lifting-line"} | models),
    )


def by_linear_twist(solution: Solution) -> float:
    """dP/dθ_1 [W/deg], the tip against the root."""
    gradient = power_gradient(solution)
    return float(gradient.along((gradient.r - 0.75)[None, :])[0]) * math.radians(1.0)


def best_linear(mu: float, **models: Any) -> float:
    """The linear twist of least power [deg], by secants on the gradient."""
    one, other = -12.0, -14.0
    start = solve(line(mu, f"linear:{one}", **models))
    slope, more = (
        by_linear_twist(start),
        by_linear_twist(solve(line(mu, f"linear:{other}", **models), start)),
    )
    for _ in range(4):
        one, other, slope = other, other - more * (other - one) / (more - slope), more
        more = by_linear_twist(solve(line(mu, f"linear:{other:.6f}", **models), start))
    return other


def near_the_tip(solution: Solution) -> float:
    """dC_T/dr at 0.99 R, mean around the azimuth."""
    return float(np.interp(0.99, solution.disk.r, solution.disk.dct.mean(axis=1)))


@pytest.mark.slow
@pytest.mark.parametrize(("mu", "power"), [(0.2, 1e-3), (0.3, 3.5e-3)])
def test_twice_the_panels_change_little(mu: float, power: float):
    """24 → 48: the targets of the model; Richardson's estimate of what remains is half as much."""
    coarse, best = solve(line(mu, elastic_twist=False)), best_linear(mu, elastic_twist=False)
    fine = solve(line(mu, elastic_twist=False, panels=48))
    assert coarse.power.total == pytest.approx(fine.power.total, rel=power)
    assert near_the_tip(coarse) == pytest.approx(near_the_tip(fine), rel=0.04)
    assert best == pytest.approx(best_linear(mu, elastic_twist=False, panels=48), abs=0.3)


def test_lift_falls_towards_the_tip():
    """As a lifting line of finite blades must; the last panel carries less than half of the most loaded one."""
    load = solve(line(0.2)).disk.dct.mean(axis=1)
    outboard = load[np.argmax(load) :]
    assert (np.diff(outboard) < 0.0).all()
    assert load[-1] < 0.5 * load.max()


@pytest.mark.parametrize(("mu", "most"), [(0.2, 0.105), (0.3, 0.25)])
def test_where_to_twist_is_no_saw_tooth(mu: float, most: float):
    """Deviation of the sensitivity from the mean of its neighbours, over its size; the change of section stays."""
    found = power_gradient(solve(line(mu, elastic_twist=False)))
    density, between = found.density, (found.r > 0.5) & (found.r < 0.995)
    off = np.pad(density[1:-1] - 0.5 * (density[:-2] + density[2:]), 1)
    assert math.sqrt((off[between] ** 2).mean() / (density[between] ** 2).mean()) <= most


@pytest.mark.slow
@pytest.mark.parametrize("mu", [0.2, 0.3])
def test_the_outboard_rate_of_three_segments_is_the_same_from_any_start(mu: float):
    found = [
        optimise(line(mu, elastic_twist=False), "three-segment-free", starts=1, seed=k)
        for k in range(6)
    ]
    rates = [float(each.twist.spec().split("@")[0].split(",")[2]) for each in found]
    assert np.ptp(rates) < 0.5


@pytest.mark.parametrize("blades", [2, 3, 5, 7])
def test_any_number_of_blades(blades: int):
    """Same solidity: the fewer the blades, the larger the loss at their tips."""
    found, usual = (
        solve(line(0.2, blades=blades, elastic_twist=False)),
        solve(line(0.2, elastic_twist=False)),
    )
    assert found.converged
    assert (found.power.induced > usual.power.induced) == (blades < 4)


def test_the_loss_at_the_tips_goes_with_one_over_the_number_of_blades():
    """Prandtl's and Goldstein's: κ = κ∞ + c/N_b at equal solidity, and at no number of blades less than 1."""
    over = 1.0 / np.array([4, 7, 8, 9, 12])
    found = np.array(
        [
            solve(line(0.2, blades=round(1.0 / x), elastic_twist=False)).induced_power_factor
            for x in over
        ]
    )
    assert (np.diff(found) < 0.0).all()
    slope, limit = np.polyfit(over, found, 1)
    assert limit > 1.0
    assert_allclose(found, limit + slope * over, atol=0.015)


@dataclass(frozen=True)
class FullLattice(LiftingLineInflow):
    """The lattice is full to another age [rad]."""

    near: float = 0.0

    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> LiftingLineTerms:
        return LiftingLineTerms(
            replace(super().on(disk, course, losses).line, near=self.near), course
        )


@pytest.mark.parametrize(
    ("mu", "azimuths"),
    [(0.2, 24), pytest.param(0.1, 48, marks=pytest.mark.slow)],
    ids=["0.2", "0.1"],
)
def test_the_length_of_the_near_wake_decides_nothing(mu: float, azimuths: int):
    """15 to 120°. At µ 0.1 the strips' steps of 15° are too long where they first pass under a blade, at 90°: 0.9 %."""
    problem, powers = (
        trim_problem(line(mu, elastic_twist=False, line_azimuths=azimuths)),
        list[float](),
    )
    for near in (15.0, 30.0, 60.0, 90.0, 120.0):
        found = trim(replace(problem, inflow=FullLattice(math.radians(near))))
        assert found.converged
        flown = found.linear
        powers.append(power_budget(problem, flown.elements, disk_sums(flown.point)).total)
    assert max(powers) < 1.005 * min(powers)


@pytest.mark.parametrize("mu", [0.12, 0.2, 0.3, 0.35])
@pytest.mark.parametrize("twist", ["linear:-16", "linear:-12", "linear:-8"])
def test_the_wake_along_the_trim_found_changes_little(mu: float, twist: str):
    """The wake lies along the trim of the blade as built with linear inflow; laid again, power moves by this much."""
    problem = trim_problem(line(mu, twist))
    first = trim(problem)
    again = trim(replace(problem, course=along(first, problem.course)))
    trims = [found.linear for found in (first, again)]
    powers = [
        power_budget(problem, found.elements, disk_sums(found.point)).total for found in trims
    ]
    assert powers[1] == pytest.approx(powers[0], rel=3e-3)


def test_power_and_slope_pass_over_to_hover():
    """No step: from µ = 0 on they leave hover as steadily as they go on."""
    advance = [0.0, 0.002, 0.004, 0.006]
    found = [solve(line(mu)) for mu in advance]
    power, slope = [each.power.total for each in found], [by_linear_twist(each) for each in found]
    for values, most in ((power, 3e-3 * power[0]), (slope, 0.15e3)):
        steps = np.diff(values)
        assert abs(steps[0]) < most
        assert abs(steps[0]) < 1.5 * np.abs(steps[1:]).max()


def test_power_falls_steadily_from_hover():
    power = [solve(line(mu)).power.main_rotor for mu in np.arange(0.01, 0.13, 0.01)]
    assert (np.diff(power) < 0.0).all()
    assert (np.abs(np.diff(power, 2)) < 0.02 * power[0]).all()


def steepest_lift(mach: np.ndarray) -> np.ndarray:
    """The largest slope of C_l [1/rad] of the UH-60A's sections at any angle, shape of mach."""
    alpha, nodes = np.radians(np.arange(-8.0, 20.0, 0.25)), np.linspace(0.0, 0.95, 96)
    lift = [load_section(name)(alpha[:, None], nodes).cl for name in ("sc1095", "sc1094r8")]
    slopes = np.diff(lift, axis=1).max(axis=(0, 1)) / (alpha[1] - alpha[0])
    return np.interp(mach, nodes, slopes)


@pytest.mark.parametrize("mu", [0.05, 0.1, 0.15, 0.2, 0.3, 0.4])
def test_a_wake_has_one_circulation(mu: float):
    """A + 1/k is positive definite in the norm of the energy, k = −∂Γ/∂λ.

    With the largest slope that the sections' lift has at any angle at the Mach number there, and 10 % more.
    """
    linear = analyse(line(mu)).linear
    point, disk = linear.point, linear.problem.disk
    nodes = point.system.nodes
    weight = np.repeat(np.sqrt(disk.dr), disk.shape[1])
    wake = weight[:, None] * nodes.matrix / weight
    speed = point.channels[UT]
    steepest = 1.1 * steepest_lift(np.abs(speed) * linear.problem.design.tip_mach)
    fall = np.where(speed > 0.0, steepest * disk.half_solidity[:, None], 1e-9).ravel()
    assert np.linalg.eigvalsh(0.5 * (wake + wake.T) + np.diag(1.0 / fall))[0] > 0.1
    by_inflow = point.slopes[LINE_PAIRS.index((CIRCULATION, UP))]
    assert (-by_inflow.ravel() < fall)[point.channels[UT].ravel() > 0.1].all()
    assert by_inflow.max() < 0.02  # Where lift is held, what grows is U.


def autogiro() -> Design:
    """The PCA-2 at µ 0.42, where linear inflow finds a tilt that is 2° off."""
    measured = load_set("pca2")
    design = design_at(measured, next(point for point in measured.points if point["mu"] > 0.416))
    return replace(design, models=replace(design.models, inflow="lifting-line"))


def test_a_free_rotors_wake_lies_along_the_tilt_that_it_finds():
    design = autogiro()
    found = solve(design).require()
    problem = trim_problem(design)
    first = trim(problem)
    second = trim(replace(problem, course=along(first, problem.course)), first.guess)
    third = trim(replace(problem, course=along(second, problem.course)), second.guess)
    assert abs(first.state.shaft_tilt / third.state.shaft_tilt - 1.0) > 0.02
    assert_allclose(found.controls.shaft_tilt, second.state.shaft_tilt, rtol=1e-7)
    assert_allclose(second.state.shaft_tilt, third.state.shaft_tilt, rtol=3e-3)


@pytest.mark.parametrize("mu", [0.1, 0.2, 0.3])
def test_a_fine_line_takes_no_more_derivatives_than_a_coarse_one(
    mu: float, evaluated: list[Factors]
):
    """A guess of the circulation stalled its tip panels: with 48 of them it took five to nine Jacobians."""
    assert solve(line(mu, panels=48, line_azimuths=24)).converged
    assert 1 <= sum(len(one.weight) > 48 * 24 for one in evaluated) <= 3
