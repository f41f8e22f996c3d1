"""The same flight without stall, and where stall begins: edges are those of the stalled area that the page shows."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.workers.call import at_once
from rotor import make_design, solve
from rotor.aero.switches import with_switches
from rotor.airfoil.sections import load_section
from rotor.airfoil.stall_onset import SLOPE, STALLED, stall_onset, unstalled
from rotor.design.quantities import CONDITION
from rotor.trim.stall_edge import stall_edges

NEAR = 0.05
"""Of a step: five times as far as the edge is found to."""


class TestSectionWithoutStall:
    TABLE = load_section("sc1095")
    WITHOUT = unstalled(TABLE)

    def test_up_to_its_stall_angle_nothing_changes(self):
        alpha, mach = np.radians(np.linspace(-6.0, 6.0, 97))[:, None], np.linspace(0.0, 0.6, 25)
        one, other = self.TABLE(alpha, mach), self.WITHOUT(alpha, mach)
        assert_allclose(other.cl, one.cl, rtol=1e-12, atol=1e-14)
        assert_allclose(other.cd, one.cd, rtol=1e-12)
        without, own = (
            np.asarray(table.moment(alpha, mach)) for table in (self.WITHOUT, self.TABLE)
        )
        assert_allclose(without, own, atol=1e-14)

    def test_beyond_it_the_normal_force_rises_nearly_as_in_attached_flow_and_drag_stays(self):
        """Thin-aerofoil theory: 2π/√(1 − M²) per radian from zero lift, of which K(0.7) = 0.84 is left at least."""
        angles = np.radians([16.0, 20.0, 28.0])
        here, zero = self.WITHOUT(angles, 0.3), float(self.WITHOUT.zero_lift_alpha(0.3))
        secant = (here.cl * np.cos(angles) + here.cd * np.sin(angles)) / (angles - zero)
        assert np.ptp(secant) < 0.01 * secant[0]
        assert 0.8 < secant[0] / (2.0 * np.pi / np.sqrt(1.0 - 0.3**2)) < 1.0
        assert_allclose(here.cd, here.cd[0], rtol=1e-6)
        assert here.cd[2] < 0.1 * self.TABLE(angles[2], 0.3).cd

    def test_in_reverse_flow_the_data_stay(self):
        alpha = np.radians([95.0, 150.0, 175.0, -120.0])
        assert_allclose(self.WITHOUT(alpha, 0.4).cl, self.TABLE(alpha, 0.4).cl, atol=1e-12)

    def test_it_separates_no_further_than_where_stall_begins(self):
        onset, own = stall_onset(self.WITHOUT), stall_onset(self.TABLE)
        # Attached flow is the same.
        assert_allclose(onset.numbers[SLOPE], own.numbers[SLOPE], rtol=1e-12)
        steps = np.arange(-50, 51) + 360  # Nodes to ±25° from zero lift, half a degree apart.
        assert onset.tables[steps, :13, 0, 0, 0].min() > STALLED
        assert own.tables[steps, :13, 0, 0, 0].min() < 0.1


@pytest.mark.parametrize(("mu", "mass"), [(0.3, 10000.0), (0.2, 9500.0), (0.0, 8322.0)])
def test_without_stall_no_part_of_the_disk_stalls(mu: float, mass: float):
    design = make_design(mu=mu, mass_kg=mass)
    without, own = solve(with_switches(design, ("stall",))).require(), solve(design).require()
    assert without.stalled_area == 0.0
    assert not without.disk.stalled.any()
    if own.stalled_area > 0.03:  # Far into stall it costs power.
        assert own.power.total > without.power.total + 1e3
    elif own.stalled_area == 0.0 and not mu:
        assert_allclose(without.power.total, own.power.total, rtol=1e-9)


def test_where_nothing_stalls_it_costs_nothing():
    design = make_design(mu=0.1, mass_kg=7000.0)
    own = solve(design).require()
    assert own.stalled_area == 0.0
    assert solve(with_switches(design, ("stall",)), own).power.total == pytest.approx(
        own.power.total, rel=1e-4
    )


@pytest.mark.slow
@pytest.mark.parametrize(("mass", "stalls"), [(7000.0, False), (8322.0, True)])
def test_edges_are_those_of_the_stalled_area(mass: float, stalls: bool):
    design = make_design(mu=0.2, mass_kg=mass)
    here = solve(design)
    assert (here.stalled_area > 0.0) == stalls == (here.least_margin < 0.0)
    edges = at_once(stall_edges(here))
    assert edges.separated == stalls
    assert edges.mass_kg is not None

    def separates(name: str, value: float) -> bool:
        return solve(CONDITION[name].put(design, value), here).stalled_area > 0.0

    beside = NEAR * 0.04 * mass * float(np.sign(edges.mass_kg))
    edge = mass + edges.mass_kg
    assert separates("mass_kg", edge - beside) == stalls
    assert separates("mass_kg", edge + beside) != stalls
    low, high = edges.mu.low, edges.mu.high
    assert high is not None
    assert not separates("mu", high - NEAR * 0.02)
    assert separates("mu", high + NEAR * 0.02)
    assert low is not None
    assert low < high
    assert separates("mu", low - NEAR * 0.02)
    assert not separates("mu", low + NEAR * 0.02)
