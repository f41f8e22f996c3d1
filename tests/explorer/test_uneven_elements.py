"""The page with a trim on few elements, finer towards the tip: pictures and lines as with even ones."""

from collections.abc import Iterator

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.picture.fields import FIELDS
from explorer.picture.polar import Drawn, MarkedRegion, Marks, polar_grid, refined, region_codes
from explorer.picture.wake import inflow_arrows, tip_vortex_path
from rotor.files.make_design import make_design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from tests.uneven import uneven_models


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
        ours, theirs = field.sample(Drawn(few), grid), field.sample(Drawn(even), polar_grid(even.disk, 112, 240))
        inner = (grid.r > 0.2) & (grid.r < 0.97)
        shown = inner[:, None] & (refined(even, polar_grid(even.disk, 112, 240)).u_t > 0.05)
        error = np.abs(ours - theirs)[shown]
        assert np.isfinite(ours).all()
        assert np.quantile(error, 0.98) < 0.04 * (field.high - field.low)

    def test_no_bands(self, few: Solution):
        """Thrust rises and falls smoothly along the blade: no step of an element is seen in its second difference."""
        grid = polar_grid(few.disk, 400, 12)
        values = FIELDS["Thrust dT/dr"].sample(Drawn(few), grid)
        inner = (grid.r > few.disk.r[1]) & (grid.r < 0.8)
        steps = np.abs(np.diff(values[inner], axis=0)).max()
        bends = np.abs(np.diff(values[inner], 2, axis=0)).max()
        assert bends < 0.12 * steps


class TestMarks:
    def test_marks(self, few: Solution, even: Solution):
        shares = []
        for solution in (few, even):
            codes = region_codes(Drawn(solution), polar_grid(solution.disk, 112, 384), Marks(), 0.004)
            assert codes is not None
            shares.append([(codes == region).mean() for region in MarkedRegion])
        assert_allclose(shares[0], shares[1], atol=0.01)

    def test_tip_vortices_and_arrows(self, few: Solution, even: Solution):
        ours, theirs = (np.array(tip_vortex_path(solution).sink) for solution in (few, even))
        assert_allclose(ours, theirs, atol=2e-3)
        assert_allclose(inflow_arrows(few), inflow_arrows(even), atol=0.05)
