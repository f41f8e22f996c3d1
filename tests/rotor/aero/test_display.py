"""Uneven elements, and trims on few azimuths that are shown on many: fields, areas, sums, gradients."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotor import Design, Solution, make_design, solve
from rotor.aero.disk import stations
from rotor.aero.display import at_display_azimuths, resampling
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.linear import LinearInflow
from rotor.aero.problem import build_problem
from rotor.aero.switches import with_switches
from rotor.airfoil.stall_delay import delayed_lift
from rotor.design.design import Models, with_models
from rotor.files.design_file import design_from_record
from rotor.trim import Analysis, analyse

FAST, HEAVY = 0.35, 9500.0
ELEMENTS, AZIMUTHS = 24, {"few azimuths": 24, "many azimuths": 120}


class OwnGrid(LinearInflow):
    """Linear inflow on a grid of its own, finer towards the tip."""

    fine_tip = True

    def grid(self, models: Models, blades: int) -> tuple[int, int]:
        del models, blades
        return ELEMENTS, AZIMUTHS[self.name]


@pytest.fixture(scope="module", autouse=True)
def models() -> Iterator[None]:
    """Pitt and Peters' inflow on the two grids, as `few azimuths` and `many azimuths`."""
    like = INFLOW_MODELS["pitt-peters"]
    assert isinstance(like, LinearInflow)
    with pytest.MonkeyPatch.context() as patch:
        for name in AZIMUTHS:
            patch.setitem(
                INFLOW_MODELS, name, OwnGrid(name, name, "", like.longitudinal, like.lateral)
            )
        yield


def heavy(inflow: str = "few azimuths", mu: float = FAST) -> Design:
    return make_design(mu=mu, mass_kg=HEAVY, inflow=inflow)


@pytest.fixture(scope="module")
def few() -> Solution:
    return solve(heavy()).require()


@pytest.fixture(scope="module")
def memoryless() -> Solution:
    """Coefficients follow from the flow of the moment."""
    return solve(with_switches(heavy(), ("dynamic_stall",))).require()


@pytest.fixture(scope="module")
def many() -> Solution:
    return solve(heavy("many azimuths")).require()


class TestElements:
    def test_widths_fill_the_blade_and_are_finest_at_the_tip(self):
        disk = build_problem(heavy()).disk
        edges, r = stations(disk.root, ELEMENTS, fine_tip=True)
        assert_allclose(disk.edges, edges, atol=1e-15)
        assert_array_equal(disk.r, r)
        assert (np.diff(disk.dr) < 0.0).all()
        assert (disk.edges[:-1] < disk.r).all()
        assert (disk.r < disk.edges[1:]).all()
        assert_allclose(disk.cells.sum() * len(disk.psi), 1.0 - disk.root**2, rtol=1e-14)

    def test_power_is_that_of_a_fine_even_grid(self, few: Solution):
        design = heavy("pitt-peters")
        fine = solve(replace(design, models=replace(design.models, elements=320))).require()
        assert_allclose(few.power.total, fine.power.total, rtol=4e-3)
        assert_allclose(few.controls.collective, fine.controls.collective, atol=math.radians(0.1))


@pytest.mark.parametrize("source", [24, 25])
def test_what_the_samples_resolve_is_exact(source: int):
    psi, fine = (2.0 * math.pi * np.arange(n) / n for n in (source, 5 * source))
    matrix = resampling(source, 5 * source)
    for wave in range((source + 1) // 2):
        for function in (np.cos, np.sin):
            assert_allclose(function(wave * psi) @ matrix, function(wave * fine), atol=1e-13)


@pytest.mark.parametrize(
    ("given", "solved", "shown"),
    [({"inflow": "drees"}, 48, 144), ({"inflow": "drees", "azimuths": 36}, 36, 36), ({}, 24, 120),
     ({"inflow": "drees", "azimuths": 120}, 120, 120), ({"azimuths": 36}, 36, 36), ({"preset": "thesis"}, 120, 120),
     ({"preset": "thesis", "inflow": "lifting-line"}, 24, 120), ({"preset": "thesis", "azimuths": 48}, 48, 48)],
    ids=str,
)  # fmt: skip
def test_azimuths_of_trim_and_fields(given: dict[str, Any], solved: int, shown: int):
    """Those asked for, else those of the inflow model and what a picture needs; a design file keeps what was asked."""
    design = make_design(mu=0.2, **given)
    trim = analyse(design)
    assert len(trim.linear.problem.disk.psi) == solved
    assert trim.solution.disk.theta.shape[1] == shown
    assert design.to_dict().get("azimuths") == given.get("azimuths")
    assert design_from_record(design.to_dict()) == design


class TestFields:
    def test_a_trim_on_the_grid_asked_for_is_shown_as_it_is(self, many: Solution):
        trim = analyse(many.design)
        problem, elements = trim.linear.problem, trim.linear.elements
        shown = at_display_azimuths(problem, elements)
        assert shown[0] is problem
        assert shown[1] is elements
        assert trim.solution.disk.alpha is elements.alpha

    def test_at_the_azimuths_of_the_trim_they_are_its_own(self, memoryless: Solution):
        e, disk, step = (
            Analysis(memoryless).linear.elements,
            memoryless.disk,
            120 // AZIMUTHS["few azimuths"],
        )
        for name in ("theta", "u_t", "u_p", "induced", "alpha", "mach", "cl", "cd"):
            assert_allclose(getattr(disk, name)[:, ::step], getattr(e, name), atol=1e-10)
        assert_allclose(disk.dct[:, ::step], e.fz, atol=1e-12)
        assert_allclose(disk.cd_mach[:, ::step], e.cd_mach, atol=1e-8)

    def test_dynamic_stall_is_followed_at_the_azimuths_shown(self, few: Solution):
        """Its lags are those of the path between the azimuths, which is finer in the picture than in the trim."""
        e, disk, step = Analysis(few).linear.elements, few.disk, 120 // AZIMUTHS["few azimuths"]
        assert_allclose(disk.alpha[:, ::step], e.alpha, atol=1e-10)
        assert_allclose(disk.dct[:, ::step], e.fz, atol=0.01 * e.fz.max())
        assert np.quantile(np.abs(disk.cl[:, ::step] - e.cl)[e.u_t > 0.1], 0.99) < 0.03

    def test_between_they_are_those_of_a_trim_there(self, few: Solution, many: Solution):
        for name in ("theta", "u_t", "u_p", "induced", "mach", "dct", "dcq", "elastic_twist"):
            expected = getattr(many.disk, name)
            error = np.abs(getattr(few.disk, name) - expected)
            # Moments where the flow separates are not smooth, nor is yawed drag about reverse flow.
            near = {"elastic_twist": 8e-3, "dcq": 6e-3}.get(name, 5e-3)
            assert np.quantile(error, 0.99) < near * np.abs(expected).max(), name
        # Not so near the centre of reverse flow, where an angle of attack turns with the last digits of velocities.
        outside = many.disk.u_t > 0.1
        assert np.degrees(np.abs(few.disk.alpha - many.disk.alpha)[outside]).max() < 0.3

    def test_no_coefficient_is_interpolated(self, memoryless: Solution):
        """Every C_l is that of the section at its own α and Mach number, also where the table bends."""
        blade, disk = memoryless.design.rotor.blade, memoryless.disk
        inner, outer, _ = blade.section_at(float(disk.r[-4]))
        assert inner == outer
        installed = blade.installed(inner)
        gain = float(Analysis(memoryless).linear.problem.disk.delay[-4])
        assert gain > 0.01
        alpha = disk.alpha[-4] - installed.incidence_offset
        expected = delayed_lift(installed.table, gain, alpha, disk.mach[-4])
        assert_allclose(disk.cl[-4], expected, atol=1e-12)


class TestSums:
    def test_power_and_thrust_are_those_of_the_trim(self, few: Solution):
        assert_allclose(few.power.shaft, few.power.main_rotor, rtol=1e-9)
        disk = Analysis(few).linear.problem.disk
        assert_allclose(few.ct, (disk.dr @ Analysis(few).linear.elements.fz).mean(), rtol=1e-14)
        assert_allclose((few.disk.dr @ few.disk.dct).mean(), few.ct, rtol=1e-4)


class TestAreas:
    @pytest.mark.parametrize("mu", [0.25, 0.30, 0.31, 0.32, 0.33, 0.34, FAST])
    def test_reverse_flow_is_the_circle(self, mu: float):
        """½∫(µ² sin²ψ − r_root²)dψ/π; without the swirl, which widens it."""
        solution = solve(with_switches(heavy(mu=mu), ("swirl",))).require()
        along, root = (
            mu * math.cos(solution.controls.shaft_tilt),
            solution.design.rotor.blade.root_cutout,
        )
        sine = np.sin(np.linspace(0.0, math.pi, 20001))
        expected = 0.5 * np.maximum((along * sine) ** 2 - root**2, 0.0).mean()
        assert_allclose(solution.reverse_flow_area, expected, rtol=0.03)

    @pytest.mark.parametrize(
        ("mu", "mass", "near"), [(0.2, 12e3, 0.1), (FAST, HEAVY, 0.04), (FAST, 11e3, 0.04)]
    )
    def test_stall_is_that_of_a_fine_grid(self, mu: float, mass: float, near: float):
        """Without its delay, which leaves less than 1 % of the disk at µ 0.2."""
        coarse, fine = self._stalled(mu, mass, delays=False)
        assert fine > 0.002
        assert_allclose(coarse, fine, rtol=near, atol=2e-4)

    @pytest.mark.parametrize(
        ("mu", "mass", "near"), [(0.2, 12e3, 0.0015), (FAST, HEAVY, 0.0015), (FAST, 11e3, 0.0015)]
    )
    def test_delayed_stall_is_that_of_a_fine_grid(self, mu: float, mass: float, near: float):
        """Within .15 % of the disk."""
        coarse, fine = self._stalled(mu, mass, delays=True)
        assert fine > 0.002
        assert_allclose(coarse, fine, rtol=0.0, atol=near)

    @pytest.mark.parametrize(("mu", "mass"), [(0.2, 12e3), (FAST, HEAVY), (FAST, 11e3)])
    def test_other_regions_are_those_of_a_fine_grid(self, mu: float, mass: float):
        """Areas within 0.8 % of the disk, the thrust in them within 0.6 %: 24 elements beside 320."""
        design = heavy("pitt-peters", mu).at(mass_kg=mass)
        fine = replace(design, models=replace(design.models, elements=320, azimuths=360))
        one, other = (solve(asked).require().regions for asked in (design, fine))
        assert other.past_static > 0.02
        assert other.drag_divergence > 0.04
        assert_allclose(one.past_static, other.past_static, rtol=0.0, atol=0.008)
        assert_allclose(one.drag_divergence, other.drag_divergence, rtol=0.0, atol=0.008)
        assert_allclose(one.past_static_thrust, other.past_static_thrust, rtol=0.0, atol=0.006)

    def _stalled(self, mu: float, mass: float, *, delays: bool) -> tuple[float, float]:
        """Stalled area on 24 uneven elements, and on a fine grid."""
        design = with_models(heavy("pitt-peters", mu).at(mass_kg=mass), stall_delay=delays)
        fine = replace(design, models=replace(design.models, elements=320, azimuths=360))
        coarse = with_models(heavy(mu=mu).at(mass_kg=mass), stall_delay=delays)
        return solve(coarse).require().stalled_area, solve(fine).require().stalled_area
