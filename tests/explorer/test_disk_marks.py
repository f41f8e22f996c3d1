"""What is marked about the rotor: regions and labels on the disk, words round it, vortices, numbers of the inset.

The compiled loops of these pictures against their plain forms stand at the end.
"""

import math
import pickle
from dataclasses import replace

import msgspec
import numpy as np
import pytest

from explorer.picture import disk_image
from explorer.picture.blade_mesh import inset_sections
from explorer.picture.fields import FIELDS, fitted_range, keeps_range, over_range
from explorer.picture.picture import field_values
from explorer.picture.plan import past_static_segments, separated_segments
from explorer.picture.polar import (
    DrawnSolution,
    MarkedRegion,
    RefinedFlow,
    RegionMarks,
    polar_grid,
    region_codes,
)
from explorer.picture.wake import tip_vortices
from rotor import Solution, make_design, solve
from rotor.design.twist import LinearTwist, PiecewiseLinearTwist
from tests.solved import with_disk

ALPHA = FIELDS["Angle of attack"]


@pytest.fixture(scope="module")
def fast() -> Solution:
    """Heavy and fast, with too little twist outboard: stall, reverse flow and drag divergence."""
    twist = PiecewiseLinearTwist((math.radians(-14.0), math.radians(-8.0)), (0.5,))
    return solve(replace(make_design(mu=0.4, mass_kg=9300.0), twist=twist)).require()


def with_inflow(inflow: str, mu: float) -> Solution:
    """The UH-60A as built."""
    return solve(make_design(mu=mu, inflow=inflow)).require()


def codes_of(solution: Solution, marks: RegionMarks, size: int = 960) -> np.ndarray:
    grid = polar_grid(solution.disk, *disk_image.grid_size(size))
    made = region_codes(DrawnSolution(solution), grid, marks, 2.8 / size)
    assert made is not None
    return made


class TestRegions:
    def test_the_stalled_share_of_the_disk_is_the_solvers(self, fast: Solution):
        codes = codes_of(
            fast, RegionMarks(past_static=False, drag_divergence=False, reverse_flow=False)
        )
        grid = polar_grid(fast.disk, *disk_image.grid_size(960))
        stalled = np.isin(codes, (MarkedRegion.SEPARATED, MarkedRegion.SEPARATED_RIM)) & (
            RefinedFlow(fast, grid).attached < 0.0
        )
        share = (stalled * grid.r[:, None]).sum() / (np.ones_like(stalled) * grid.r[:, None]).sum()
        # The solver counts the whole blade's annulus too, but no strip beside reverse flow is left out there.
        assert share == pytest.approx(fast.stalled_area, abs=0.02)
        assert share > 0.02

    def test_reverse_flow_is_the_circle_r_equals_minus_mu_sin_psi(self, fast: Solution):
        codes = codes_of(fast, RegionMarks(stall=False, past_static=False, drag_divergence=False))
        grid = polar_grid(fast.disk, *disk_image.grid_size(960))
        mu = fast.design.condition.advance_ratio * math.cos(fast.controls.shaft_tilt)
        edge = grid.r[:, None] + mu * np.sin(grid.psi)[None, :]
        clear = np.abs(edge) > 0.02  # Away from the rim.
        assert np.array_equal((codes == MarkedRegion.REVERSE)[clear], (edge < 0.0)[clear])
        rim = codes == MarkedRegion.REVERSE_RIM
        assert rim.any()
        assert np.abs(edge[rim]).max() < 0.02

    def test_drag_divergence_is_dashed(self, fast: Solution):
        dashes = (
            codes_of(fast, RegionMarks(stall=False, past_static=False, reverse_flow=False))
            == MarkedRegion.DASH
        )
        around = dashes.any(axis=0)
        assert np.count_nonzero(np.diff(around.astype(int)) == 1) > 10


UNSTEADY = ("Separation point", "Stall vortex C_n")


class TestDynamicStall:
    def test_its_fields_and_regions_are_what_the_section_does(self):
        solution = solve(make_design(mu=0.35, mass_kg=9500.0)).require()
        separation, vortex = (field_values(solution, FIELDS[title]) for title in UNSTEADY)
        assert 0.0 < separation.min() < 0.5 < separation.max() <= 1.0
        assert 0.02 < vortex.max() < 1.0
        grid = polar_grid(solution.disk, 80, 240)
        flow = RefinedFlow(solution, grid)
        separated = (flow.attached < 0.0) & (flow.u_t > 0.0)
        beyond = (flow.margin < 0.0) & (flow.u_t > 0.0)
        assert np.mean(separated != beyond) / np.mean(separated) > 0.05
        assert len(separated_segments(solution)) > 10

    def test_past_the_static_angle_and_attached_is_a_region_of_its_own(self):
        """Between them the two regions have all that is past the static angle, and share nothing."""
        solution = solve(make_design(mu=0.35, mass_kg=9500.0)).require()
        grid = polar_grid(solution.disk, 120, 480)
        flow = RefinedFlow(solution, grid)
        assert flow.past_static is not None
        past, separated = flow.past_static < 0.0, flow.attached < 0.0
        assert not (past & separated).any()
        assert ((past | separated) >= (flow.margin < 0.0)).all()
        assert len(past_static_segments(solution)) > 10
        ahead = past & (flow.u_t > 0.0)
        area = (ahead * grid.r[:, None]).sum() / grid.r.sum() / len(grid.psi)
        disk = 1.0 - grid.r[0] ** 2
        assert area * disk == pytest.approx(solution.past_static_area, abs=0.003)
        assert solution.past_static_area > 0.01
        steady = solve(make_design(mu=0.35, mass_kg=9500.0, off="dynamic-stall")).require()
        assert steady.past_static_area == 0.0
        assert len(past_static_segments(steady)) == 0
        assert steady.stalled_area > 0.0

    def test_the_dotted_edge_is_marked_only_where_it_is_asked_for(self):
        solution = solve(make_design(mu=0.35, mass_kg=9500.0)).require()
        only = RegionMarks(stall=False, reverse_flow=False, drag_divergence=False)
        dotted = codes_of(solution, only) == MarkedRegion.SEPARATED_RIM
        assert np.count_nonzero(np.diff(dotted.any(axis=0).astype(int)) == 1) > 10


class TestRanges:
    @pytest.mark.parametrize("title", [title for title in FIELDS if title not in UNSTEADY])
    def test_a_fitted_range_uses_the_colours(self, title: str, fast: Solution):
        """Neither saturated nor flat: at most a fiftieth lies beyond, and the values fill half of the range."""
        field = FIELDS[title]
        values = field_values(fast, field)
        low, high = fitted_range(field, values)
        assert np.mean((values < low) | (values > high)) < 0.02
        inner = np.quantile(values, (0.02, 0.98))
        filled = max(abs(inner)) / high if field.two_sided else np.ptp(inner) / (high - low)
        assert filled > 0.5
        assert keeps_range(field, values, (low, high))

    def test_each_end_says_whether_values_lie_beyond(self):
        values = np.linspace(0.0, 1.0, 2001)
        assert over_range(values, (0.0, 1.0)) == (False, False)
        assert over_range(values, (0.1, 1.0)) == (True, False)
        assert over_range(values, (0.0, 0.9)) == (False, True)


class TestFlatPictures:
    def test_words_stand_at_their_sides(self):
        """Ink in the band of the words: nose above, tail below, advancing right, retreating left."""
        mask = disk_image.ring_mask(disk_image.sides(make_design(mu=0.2))).astype(float)
        size = len(mask)
        middle = 0.5 * (size - 1)
        row, column = np.nonzero(mask > 0)
        r = np.hypot(row - middle, column - middle) / (0.5 * size / disk_image.REACH)
        psi = np.degrees(np.arctan2(column - middle, row - middle)) % 360
        words = psi[(r > 1.09) & (r < 1.16)]
        for centre in (15, 90, 180, 270):
            assert np.count_nonzero(np.abs((words - centre + 180) % 360 - 180) < 12) > 500
        assert np.count_nonzero(np.abs(words - 225) < 20) == 0
        assert r.min() > 1.0  # Nothing lies on the disk itself.

    def test_a_rotor_tested_alone_has_no_nose(self):
        assert disk_image.sides(make_design(mu=0.2)) == ("TAIL", "ADVANCING", "NOSE", "RETREATING")
        assert disk_image.sides(make_design(rotor="hart2")) == (
            "DOWNSTREAM",
            "ADVANCING",
            "UPSTREAM",
            "RETREATING",
        )
        assert disk_image.sides(make_design(mu=0.0)) == ("TAIL", "", "NOSE", "")
        still = disk_image.sides(make_design(rotor="caradonna-tung", mu=0.0))
        words = [disk_image.ring_mask(each) for each in (still, disk_image.sides(make_design()))]
        assert np.count_nonzero(words[0]) < np.count_nonzero(words[1])


class TestAirLines:
    @pytest.mark.parametrize("inflow", ["pitt-peters", "lifting-line"])
    def test_a_vortex_begins_at_its_tip(self, inflow: str):
        solution = with_inflow(inflow, 0.4)
        points, age = tip_vortices(solution, [0.3])
        radius, controls = solution.design.rotor.radius, solution.controls
        assert points.shape[1:] == (2, 3)
        assert age.min() == 0.0
        assert age.max() == 1.0
        first = points[0, 0] / radius
        assert np.hypot(first[0], first[1]) == pytest.approx(1.0)
        assert math.atan2(first[1], first[0]) == pytest.approx(0.3)
        flap = controls.coning + controls.flap_1c * math.cos(0.3) + controls.flap_1s * math.sin(0.3)
        assert first[2] == pytest.approx((1.0 - solution.design.rotor.blade.flap_hinge) * flap)

    def test_a_vortex_drifts_with_the_stream(self):
        """After a whole age ζ the point has moved aft by µ_x ζ relative to where it was shed."""
        solution = with_inflow("pitt-peters", 0.4)
        points, controls = tip_vortices(solution, [0.3])[0], solution.controls
        zeta, mu = 2.0 * math.pi * 0.8, 0.4
        last = points[-1, 1] / solution.design.rotor.radius
        left = 0.3 - zeta
        along, down = (
            mu * math.cos(controls.shaft_tilt),
            mu * math.sin(controls.shaft_tilt) + controls.lambda0,
        )
        shed = 1.0 - 0.22 * down / math.hypot(along, down) * (1.0 - math.exp(-zeta / 2.2))
        assert last[0] - shed * math.cos(left) == pytest.approx(along * zeta, rel=1e-6)

    @pytest.mark.parametrize(("mu", "near"), [(0.1, 0.005), (0.2, 0.002), (0.35, 0.001)])
    def test_it_lies_on_the_wake_of_the_lifting_line(self, mu: float, near: float):
        """Also in another process, which gets no equations: x and y to rounding, height as straight lines allow."""
        solution: Solution = pickle.loads(pickle.dumps(with_inflow("lifting-line", mu)))
        course, rotor, controls = solution.wake_course, solution.design.rotor, solution.controls
        for psi in np.linspace(0.0, 2.0 * math.pi, 25):
            points, share = tip_vortices(solution, [psi])
            drawn, age = points[:, 1] / rotor.radius, 2.0 * math.pi * 0.8 * share[:, 1]
            lies = course.nodes(np.array([psi]), age, np.ones(1))[0, :, 0]
            np.testing.assert_allclose(drawn[:, :2], lies[:, :2], atol=1e-12)
            left = psi - age
            flap = (
                controls.coning + controls.flap_1c * np.cos(left) + controls.flap_1s * np.sin(left)
            )
            tip = (1.0 - rotor.blade.flap_hinge) * flap
            np.testing.assert_allclose(
                drawn[:, 2] - tip, lies[:, 2] - course.flapping(left), atol=near
            )

    def test_in_hover_they_contract_and_sink_with_the_inflow_they_meet(self, hover: Solution):
        points, age = tip_vortices(hover, [0.0])
        r = np.hypot(points[..., 0], points[..., 1]) / hover.design.rotor.radius
        assert 0.78 < r.min() < 0.82
        assert (np.diff(points[:, 0, 2]) < 0.0).all()
        assert len(age) == len(points)
        # In hover dz/dζ is λ_i about the radius of the vortex: here of an even inflow, so the pitch is even.
        even = with_disk(hover, replace(hover.disk, induced=np.full_like(hover.disk.induced, 0.06)))
        points, _ = tip_vortices(even, [0.0])
        age = 2.0 * math.pi * 0.8
        sunk = (points[0, 0, 2] - points[-1, 1, 2]) / hover.design.rotor.radius
        assert sunk == pytest.approx(0.06 * age, rel=1e-3)


class TestInset:
    ROTOR = make_design().rotor

    def test_it_is_json_with_true_angles_and_small(self):
        made = inset_sections(
            self.ROTOR, LinearTwist(math.radians(-12.0)), self.ROTOR.builtin_twist, 4.0
        )
        assert len(msgspec.json.encode(made)) < 6000
        assert made.times == 4.0
        assert len(made.cuts) == 8
        for cut in made.cuts:
            assert cut.theta == pytest.approx(-12.0 * (cut.r - 0.75), abs=0.006)
        assert made.r[0] == pytest.approx(self.ROTOR.blade.root_cutout)
        assert made.cuts[-1].r == 1.0
