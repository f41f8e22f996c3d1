"""The page with a trim on few elements, finer towards the tip: pictures, lines, probe and files as with even ones."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.export.provenance import blade_csv, disk_csv
from explorer.picture.fields import FIELDS, difference
from explorer.picture.polar import polar_grid, refined
from explorer.picture.regions import MarkedRegion, Marks, region_codes
from explorer.picture.wake import inflow_arrows, tip_vortex_path
from explorer.tabs.probe.element import probe
from explorer.text.status import provenance
from explorer.text.why import lift_centroid, why
from rotor.files.make_design import make_design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from tests.uneven import ELEMENTS, uneven_models


@pytest.fixture(scope="module")
def few() -> Iterator[Solution]:
    with uneven_models():
        yield solve(make_design(mu=0.35, mass_kg=9500.0, inflow="few azimuths")).require()


@pytest.fixture(scope="module")
def even() -> Solution:
    return solve(make_design(mu=0.35, mass_kg=9500.0, inflow="pitt-peters")).require()


class TestFields:
    def test_interpolation_along_the_blade(self, few: Solution):
        """Straight lines everywhere, parabolas but in the first and the last gap, and in even steps through all."""
        disk = few.disk
        grid = polar_grid(disk, 112, 240)
        assert_allclose(grid.r[[0, -1]], disk.edges[[0, -1]], atol=1e-15)
        assert_allclose(grid.along @ disk.r, grid.r, atol=1e-14)
        inner = (grid.r > disk.r[1]) & (grid.r < disk.r[-2])
        assert_allclose((grid.along @ disk.r**2)[inner], grid.r[inner] ** 2, atol=1e-14)

    @pytest.mark.parametrize("title", FIELDS)
    def test_they_are_those_of_even_elements(self, title: str, few: Solution, even: Solution):
        field = FIELDS[title]
        grid = polar_grid(few.disk, 112, 240)
        ours, theirs = field.sample(few, grid), field.sample(even, polar_grid(even.disk, 112, 240))
        inner = (grid.r > 0.2) & (grid.r < 0.97)
        shown = inner[:, None] & (refined(even, polar_grid(even.disk, 112, 240)).u_t > 0.05)
        error = np.abs(ours - theirs)[shown]
        assert np.isfinite(ours).all()
        assert np.quantile(error, 0.98) < 0.04 * (field.high - field.low)

    def test_no_bands(self, few: Solution):
        """Thrust rises and falls smoothly along the blade: no step of an element is seen in its second difference."""
        grid = polar_grid(few.disk, 400, 12)
        values = FIELDS["Thrust dT/dr"].sample(few, grid)
        inner = (grid.r > few.disk.r[1]) & (grid.r < 0.8)
        steps = np.abs(np.diff(values[inner], axis=0)).max()
        bends = np.abs(np.diff(values[inner], 2, axis=0)).max()
        assert bends < 0.12 * steps

    def test_difference_to_even_elements(self, few: Solution, even: Solution):
        grid = polar_grid(few.disk, 60, 90)
        changed = difference(FIELDS["Mach number"], even).sample(few, grid)
        assert np.abs(changed).max() < 0.02


class TestMarks:
    def test_marks(self, few: Solution, even: Solution):
        shares = []
        for solution in (few, even):
            codes = region_codes(solution, polar_grid(solution.disk, 112, 384), Marks(), 0.004)
            assert codes is not None
            shares.append([(codes == region).mean() for region in MarkedRegion])
        assert_allclose(shares[0], shares[1], atol=0.01)

    def test_tip_vortices_and_arrows(self, few: Solution, even: Solution):
        ours, theirs = (np.array(tip_vortex_path(solution).sink) for solution in (few, even))
        assert_allclose(ours, theirs, atol=2e-3)
        assert_allclose(inflow_arrows(few), inflow_arrows(even), atol=0.05)


class TestProbe:
    def test_at_a_station_it_is_what_the_disk_holds(self, few: Solution):
        disk = few.disk
        for i in range(ELEMENTS):
            p = probe(few, float(disk.r[i]), float(disk.psi[7]))
            assert_allclose((p.theta, p.mach, p.cl), (disk.theta[i, 7], disk.mach[i, 7], disk.cl[i, 7]), rtol=1e-13)

    def test_between_stations_it_is_near_the_lift_curve(self, few: Solution):
        for r in (0.3, 0.55, 0.8, 0.95, 0.99):
            p = probe(few, r, 1.234)
            assert p.section.lift_curve(np.array([p.alpha]), p.mach)[0] == pytest.approx(p.cl, abs=0.02)


def test_words(few: Solution, even: Solution):
    a, b = lift_centroid(few), lift_centroid(even)
    assert_allclose((a.radial, a.lateral, a.longitudinal), (b.radial, b.lateral, b.longitudinal), atol=2e-3)
    assert "diverg" not in why(even, few)
    assert "24 × 24 grid" in provenance(few)
    assert "40 × 120 grid" in provenance(even)


def test_files(few: Solution):
    """Each row has its element's width, so thrust adds up."""
    lines = disk_csv(few).decode().splitlines()
    note = next(line for line in lines if "elements of widths" in line)
    widths = [float(word) for word in note.split("dr/R = ")[1].split(" from")[0].split()]
    assert_allclose(widths, few.disk.dr, rtol=1e-8)
    assert math.isclose(sum(widths), 1.0 - few.design.rotor.blade.root_cutout, rel_tol=1e-8)
    assert len([line for line in lines if line[0].isdigit()]) == ELEMENTS * 120
    assert len(blade_csv(few, few.design, 270.0).splitlines()) > ELEMENTS
