"""Jig and flown twist on the page: shapes of the blades, overlay, inset, curves, field, probe and numbers."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import PAGE, blade_shape, inset_sections
from explorer.picture.element import probe
from explorer.picture.fields import FIELDS, fitted_range
from explorer.picture.picture import (
    field_values,
    flown_twist,
    follows_azimuth,
    overlay_twist,
    turned_blades,
)
from explorer.picture.polar import DrawnSolution, polar_grid
from explorer.text.readout import trim_panel
from explorer.widgets.twist_curve import flown_band, shown_twist
from rotor import Solution, make_design, solve
from rotor.design import LinearTwist
from rotor.support.arrays import Array

FIELD = FIELDS["Elastic twist"]
VIEW = ViewState()


@pytest.fixture(scope="module")
def rigid() -> Solution:
    return solve(make_design(mu=0.3, off="elastic-twist")).require()


def ring_angles(vertices: Array) -> Array:
    """Pitch of each ring of a blade [rad], from trailing edge to nose."""
    rings = vertices[: -2 * PAGE.points - 2].reshape(-1, PAGE.points, 3)
    nose, tail = rings[:, PAGE.points // 2], rings[:, 0]
    return np.arctan2(nose[:, 2] - tail[:, 2], nose[:, 1] - tail[:, 1])


class TestFlownTwist:
    def test_it_is_the_pitch_that_the_air_meets_less_collective_and_cyclic(self, fast: Solution):
        c, disk = fast.controls, fast.disk
        for k in (0, 17, 60, 101):
            psi = float(disk.psi[k])
            pitch = c.collective + c.cyclic_1c * math.cos(psi) + c.cyclic_1s * math.sin(psi)
            assert_allclose(pitch + flown_twist(fast, psi)(disk.r), disk.theta[:, k], atol=1e-12)

    def test_in_hover_it_is_the_same_at_every_azimuth(self, hover: Solution):
        assert not follows_azimuth(hover)
        assert len(turned_blades(hover, VIEW).forms) == 1  # One does for all.
        assert_allclose(
            flown_twist(hover, 0.3)(hover.disk.r), flown_twist(hover, 4.0)(hover.disk.r), atol=1e-15
        )
        assert float(flown_twist(hover, 0.0)([1.0])[0]) < float(
            hover.design.twist([1.0])[0]
        ) - math.radians(1.0)


class TestBlades:
    def test_untwist_with_azimuth_as_the_tip_does(self, fast: Solution):
        """At true scale the drawn tip moves by what the solution says."""
        blades = turned_blades(fast, replace(VIEW, azimuth_deg=90.0, exaggeration=1.0))
        shape = blade_shape(fast.design.rotor)
        tips = [ring_angles(form.vertices(shape))[-1] for form in blades.forms]
        elastic = fast.disk.elastic_twist
        outermost = np.interp((math.pi / 2, math.pi, 1.5 * math.pi), fast.disk.psi, elastic[-1])
        assert np.ptp(outermost) > math.radians(0.5)
        assert_allclose(np.subtract(tips[1:3], tips[0]), outermost[1:] - outermost[0], atol=2e-4)


class TestInset:
    def test_the_overlay_differs_by_its_jig_twist_alone(self, fast: Solution):
        other, r = LinearTwist(-0.1), np.linspace(0.2, 1.0, 9)
        overlay = overlay_twist(fast, other, 1.0)
        assert overlay is not None
        assert_allclose(
            flown_twist(fast, 1.0)(r) - overlay(r), fast.design.twist(r) - other(r), atol=1e-15
        )

    def test_it_holds_the_flown_angles_and_those_at_three_quarters(self, fast: Solution):
        twist = flown_twist(fast, 1.0)
        made = inset_sections(fast.design.rotor, twist, fast.design.twist, 4.0)
        assert made.datum == pytest.approx(math.degrees(float(twist([0.75])[0])), abs=0.006)
        assert made.overlay_datum == pytest.approx(0.0, abs=0.006)
        tip = made.cuts[-1]
        assert tip.overlay is not None
        assert tip.theta - tip.overlay == pytest.approx(
            math.degrees(float(twist([1.0])[0] - fast.design.twist([1.0])[0])), abs=0.011
        )


class TestCurves:
    def test_flown_less_jig_is_the_elastic_twist(self, fast: Solution):
        r = fast.disk.r
        band = flown_band(fast, r)
        assert band is not None
        mean, low, high = band
        assert_allclose(
            mean - shown_twist(fast.design)(r), np.degrees(fast.elastic.along_blade), atol=1e-9
        )
        assert (low < mean).all()
        assert (mean < high).all()
        assert high[-1] - low[-1] == pytest.approx(math.degrees(np.ptp(fast.elastic.tip)), abs=0.02)


class TestField:
    def test_its_range_is_symmetric_and_holds_the_values(self, fast: Solution):
        values = field_values(fast, FIELD)
        low, high = fitted_range(FIELD, values)
        assert low == -high
        assert high >= np.quantile(np.abs(values), 0.99)
        assert np.abs(values).max() == pytest.approx(
            math.degrees(np.abs(fast.elastic.tip).max()), abs=0.15
        )

    def test_a_rigid_blade_has_none(self, rigid: Solution):
        grid = polar_grid(rigid.disk, 40, 120)
        void = FIELD.void(DrawnSolution(rigid), grid)
        assert void.all()
        assert flown_twist(rigid, 1.0) == rigid.design.twist
        assert probe(rigid, 0.8, 1.0).elastic is None
        assert "rigid" in trim_panel(rigid)
        assert np.isfinite(FIELD.sample(DrawnSolution(rigid), grid)).all()
        assert fitted_range(FIELD, field_values(rigid, FIELD)) == (FIELD.low, FIELD.high)


class TestNumbers:
    def test_the_probe_takes_pitch_apart(self, fast: Solution):
        psi, c = math.radians(90.0), fast.controls
        here = probe(fast, 0.8, psi)
        assert here.elastic is not None
        assert here.theta == pytest.approx(
            c.collective + c.cyclic_1s + float(fast.design.twist([0.8])[0]) + here.elastic, abs=2e-4
        )

    def test_the_trim_lists_tip_twist_and_pitch_link_load(self, fast: Solution):
        elastic = fast.elastic
        text = re.sub(r"<[^>]*>", " ", trim_panel(fast)).replace("−", "-")
        for angle in (elastic.tip.mean(), elastic.first_harmonic):
            assert f"{math.degrees(angle):.2f}°" in text
        half = 0.5 * (elastic.pitch_link_load.max() - elastic.pitch_link_load.min())
        for force in (elastic.pitch_link_load.mean(), half):
            assert f"{force / 1e3:.2f} kN" in text
