"""The page's pictures as arrays, without a server: disk image, colours, outlines, camera."""

import io
import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from explorer.colours import VOID
from explorer.model.inputs import ViewState
from explorer.picture import disk_image
from explorer.picture.camera_views import (
    FIELD_OF_VIEW,
    UNCOVERED,
    USUAL_COVER,
    Camera,
    Covered,
    View,
    between_cards,
    fit,
)
from explorer.picture.fields import FIELDS
from explorer.picture.lifted_blade import fit_lifted
from explorer.picture.picture import (
    DISK_DROP,
    blade_pose,
    disk_png,
    drawn_times,
    make_picture,
    rotate,
    tip_path_pose,
)
from explorer.picture.polar import DrawnSolution, PolarGrid, RefinedFlow, polar_grid
from rotor import Solution, make_design, solve
from rotor.aero.inflow.lifting_line import LiftingLineTerms
from rotor.trim.analysis import Analysis


def grid_of(solution: Solution) -> PolarGrid:
    return polar_grid(solution.disk, *disk_image.grid_size(disk_image.SIZE))


def opened(png: bytes) -> np.ndarray:
    """RGBA, shape (rows, columns, 4), as any reader of PNG sees it."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGBA"))


def at(image: np.ndarray, r: float, psi_deg: float) -> np.ndarray:
    """The pixel at radius r and azimuth ψ, with ψ = 0 at the bottom and 90° at the right."""
    half = disk_image.SIZE / 2
    psi = math.radians(psi_deg)
    return image[int(half * (1.0 + r * math.cos(psi))), int(half * (1.0 + r * math.sin(psi)))]


class TestDiskPicture:
    def test_advancing_side_is_at_the_right_and_nose_up(self, fast: Solution):
        """Mach is largest at ψ = 90° and smallest at 270°."""
        field = FIELDS["Mach number"]
        image = opened(disk_png(fast, field, (field.low, field.high))).astype(int)
        luminance = image[..., :3] @ [0.2126, 0.7152, 0.0722]
        right, left, top, bottom = (
            at(luminance[..., None], 0.8, psi)[0] for psi in (90, 270, 180, 0)
        )
        assert right > top > left
        assert abs(top - bottom) < 6.0
        # Pitt–Peters puts the stronger inflow aft, ψ = 0, at the bottom.
        field = FIELDS["Induced inflow λi"]
        image = opened(disk_png(fast, field, (field.low, field.high))).astype(int)
        redness = image[..., 0] - image[..., 2]
        assert at(redness[..., None], 0.9, 0)[0] > at(redness[..., None], 0.9, 180)[0] + 15

    def test_cut_out_and_reverse_flow_are_clear(self, fast: Solution):
        image = opened(disk_png(fast, FIELDS["Mach number"], (0.0, 0.9)))
        assert image[0, 0, 3] == 0
        assert at(image, 0.0, 0.0)[3] == 0
        assert all(
            at(image, r, psi)[3] == 255 for r in (0.16, 0.5, 0.98) for psi in range(0, 360, 15)
        )
        field = FIELDS["Angle of attack"]
        image = opened(disk_png(fast, field, (field.low, field.high)))
        assert tuple(at(image, 0.2, 270)[:3]) == VOID
        assert tuple(at(image, 0.4, 270)[:3]) != VOID

    def test_no_wedge_where_the_turn_closes(self, hover: Solution):
        """In hover a ring has one colour all round; edge pixels excepted."""
        field = FIELDS["Thrust dT/dr"]
        image = opened(disk_png(hover, field, (field.low, field.high))).astype(int)
        ring = np.array([at(image, 0.7, psi) for psi in np.arange(-8.0, 8.0, 0.25)])
        assert np.ptp(ring, axis=0).max() <= 4


class TestFields:
    @pytest.mark.parametrize("title", FIELDS)
    @pytest.mark.parametrize("mu", [0.0, 0.05, 0.3])
    def test_every_field_is_finite(self, title: str, mu: float):
        solution = solve(make_design(mu=mu))
        assert np.isfinite(FIELDS[title].sample(DrawnSolution(solution), grid_of(solution))).all()

    def test_thrust_per_blade_sums_to_the_weight(self, hover: Solution):
        """∫ dT/dr dr over R, four blades, is the thrust that holds 8322.4 kg and 3.5 % of download up."""
        grid = grid_of(hover)
        # [N/m]
        per_blade = 1e3 * FIELDS["Thrust dT/dr"].sample(DrawnSolution(hover), grid).mean(axis=1)
        lift = 4.0 * np.trapezoid(per_blade, grid.r) * hover.design.rotor.radius
        assert_allclose(lift, 1.035 * hover.design.condition.weight, rtol=0.02)

    def test_circulation_is_that_of_the_panels(self, fast: Solution):
        """Where nothing is stalled the field is the circulation that the lifting line was solved for."""
        point, terms = Analysis(fast).linear.point, Analysis(fast).linear.problem.inflow_terms
        assert isinstance(terms, LiftingLineTerms)
        rotor, grid, line = fast.design.rotor, grid_of(fast), terms.line
        solved = point.x[point.system.structure.given :].reshape(line.panels, line.azimuths)
        solved = solved * math.pi / rotor.blades * rotor.tip_speed * rotor.radius  # [m²/s]
        shown = FIELDS["Circulation"].sample(DrawnSolution(fast), grid)
        around = np.array([np.interp(line.r, grid.r, column) for column in shown.T]).T.mean(axis=1)
        outer = line.r > 0.6
        assert_allclose(around[outer], solved.mean(axis=1)[outer], rtol=0.03)

    @pytest.mark.parametrize("preset", ["flight", "thesis"])
    def test_stall_margin_is_that_of_the_solver(self, preset: str):
        """On the solver's own points, outside reverse flow, to rounding in single precision."""
        solution = solve(make_design(preset=preset, mu=0.3))
        disk = solution.disk
        same = RefinedFlow(
            solution, PolarGrid(disk.r, disk.psi, np.eye(len(disk.r)), np.eye(len(disk.psi)))
        ).margin
        ahead = disk.u_t > 0.0
        assert_allclose(same[ahead], disk.stall_margin[ahead], atol=2e-6)


class TestPoses:
    def test_blade_points_to_its_azimuth_with_nose_up_leading_edge(self, hover: Solution):
        controls = replace(hover.controls, coning=0.0, flap_1c=0.0, flap_1s=0.0, collective=0.2)
        pose = blade_pose(controls, math.pi / 2, 0.4)
        assert_allclose(rotate(pose.wxyz, np.array([1.0, 0.0, 0.0])), [0.0, 1.0, 0.0], atol=1e-12)
        leading_edge = rotate(pose.wxyz, np.array([0.0, 1.0, 0.0]))
        # The advancing blade moves forward (−x) and its nose points up.
        assert_allclose(leading_edge, [-math.cos(0.2), 0.0, math.sin(0.2)], atol=1e-12)
        assert_allclose(pose.position, [0.0, 0.4, 0.0], atol=1e-12)

    def test_flapping_follows_each_blade(self, hover: Solution):
        controls = replace(hover.controls, coning=0.05, flap_1c=-0.03, flap_1s=0.01)
        for psi, beta in ((0.0, 0.02), (math.pi, 0.08), (math.pi / 2, 0.06)):
            outward = rotate(blade_pose(controls, psi, 0.0).wxyz, np.array([1.0, 0.0, 0.0]))
            assert_allclose(math.asin(outward[2]), beta, atol=1e-12)

    def test_coloured_disk_lies_under_the_tips_all_round(self, hover: Solution):
        controls = replace(hover.controls, coning=0.05, flap_1c=-0.08, flap_1s=0.03)
        disk = tip_path_pose(controls, DISK_DROP)
        normal = rotate(disk.wxyz, np.array([0.0, 0.0, 1.0]))
        for psi in np.linspace(0.0, 2.0 * math.pi, 24):
            tip = 8.0 * rotate(blade_pose(controls, psi, 0.0).wxyz, np.array([1.0, 0.0, 0.0]))
            assert_allclose((tip - disk.position) @ normal, 8.0 * 0.05 + DISK_DROP, atol=0.03)


class TestPicture:
    def test_marked_blade_is_first_and_blades_are_evenly_spaced(self, fast: Solution):
        view = ViewState(azimuth_deg=30.0)
        picture = make_picture(fast, view)
        azimuths = [
            math.degrees(math.atan2(p.position[1], p.position[0])) % 360
            for p in picture.blades.poses
        ]
        assert_allclose(azimuths, [30.0, 120.0, 210.0, 300.0], atol=1e-9)
        assert picture.blades.azimuth == pytest.approx(math.radians(30.0))

    def test_the_airframe_leans_by_the_shaft_tilt_less_the_shaft_in_the_airframe(
        self, fast: Solution
    ):
        """The nose is at −x: it goes down by the shaft tilt, less the 3° that the shaft leans forward already."""
        nose = rotate(make_picture(fast, ViewState()).airframe.wxyz, np.array([-1.0, 0.0, 0.0]))
        down = math.degrees(math.asin(-nose[2]))
        assert_allclose(down, math.degrees(fast.controls.shaft_tilt) - 3.0, atol=1e-9)


def on_canvas(
    camera: Camera, aspect: float, points: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where points are seen: across and up in −1…1 of the canvas, and the camera's right in the world."""
    forward = camera.look_at - camera.position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    seen = points - camera.position
    tan = math.tan(FIELD_OF_VIEW / 2.0)
    depth = seen @ forward
    assert depth.min() > 1.0  # The near plane.
    return (
        seen @ right / depth / (tan * aspect),
        seen @ np.cross(right, forward) / depth / tan,
        right,
    )


class TestCamera:
    ASPECTS = (0.6, 0.85, 1.3, 2.2)
    PSI = np.linspace(0.0, 2.0 * math.pi, 60)
    RIM = 8.18 * np.stack((np.cos(PSI), np.sin(PSI), np.zeros_like(PSI)), axis=1)

    @pytest.mark.parametrize("aspect", ASPECTS)
    @pytest.mark.parametrize("view", ["disk", "top"])
    def test_disk_fills_the_canvas_and_stays_inside(self, view: View, aspect: float):
        x, y, right = on_canvas(fit(view, 8.18, aspect), aspect, self.RIM)
        assert_allclose(right, [0.0, 1.0, 0.0], atol=1e-3)  # ψ = 90° at the right.
        assert 0.5 < max(np.abs(x).max(), np.abs(y).max()) < 1.0
        assert y[0] < y[30]  # The tail is below the nose.

    @pytest.mark.parametrize("aspect", ASPECTS)
    @pytest.mark.parametrize("radius", [3.84, 8.18, 9.45])
    def test_the_aircraft_is_inside_with_its_tail_rotor_and_the_words(
        self, radius: float, aspect: float
    ):
        reach = radius * np.array([[1.24, 0.0, 0.0], [1.2, 0.0, -0.45], [-0.6, 0.0, -0.45]])
        x, y, right = on_canvas(
            fit("3d", radius, aspect),
            aspect,
            np.concatenate((1.16 / 8.18 * radius * self.RIM, reach)),
        )
        assert 0.6 < max(np.abs(x).max(), np.abs(y).max()) < 1.0
        assert right[1] > 0.8  # The advancing side is at the right.

    @pytest.mark.parametrize("aspect", ASPECTS)
    @pytest.mark.parametrize("view", ["3d", "top", "side", "blade"])
    def test_a_framed_view_lies_between_the_cards(self, view: View, aspect: float):
        cover = Covered(0.2, 0.3, left=0.25, right=0.1)
        points = (
            self.RIM if view != "blade" else 8.18 * np.array([[0.05, 0.0, 0.0], [1.0, 0.0, 0.03]])
        )
        x, y, _ = on_canvas(fit(view, 8.18, aspect, cover=cover), aspect, points)
        assert x.min() > -1.0 + 2.0 * cover.left
        assert x.max() < 1.0 - 2.0 * cover.right
        assert y.max() < 1.0 - 2.0 * cover.above
        assert y.min() > -1.0 + 2.0 * cover.below

    def test_the_camera_rises_with_the_shaft_tilt(self):
        """A rotor tilted by 6° more is seen 4.8° further from above."""
        usual, tilted = (fit("3d", 8.18, 1.6, tilt=math.radians(tilt)) for tilt in (3.0, 9.0))
        rise = [
            math.asin((c.position - c.look_at)[2] / np.linalg.norm(c.position - c.look_at))
            for c in (usual, tilted)
        ]
        assert math.degrees(rise[1] - rise[0]) == pytest.approx(4.8)

    @pytest.mark.parametrize("aspect", ASPECTS)
    def test_from_the_advancing_side_the_nose_is_right_and_the_disk_a_line(self, aspect: float):
        x, y, right = on_canvas(fit("side", 8.18, aspect, cover=UNCOVERED), aspect, self.RIM)
        assert_allclose(right, [-1.0, 0.0, 0.0], atol=1e-9)
        assert 0.65 < np.abs(x).max() < 1.0
        assert np.ptp(y) < 0.25 * np.ptp(x) * aspect

    @pytest.mark.parametrize("aspect", [0.6, 0.9, 1.2, 1.6, 2.85])
    @pytest.mark.parametrize(
        "cover",
        [
            UNCOVERED,
            Covered(0.2, 0.1),
            Covered(0.1, 0.2, left=0.3),
            Covered(0.2, 0.2, left=0.2, right=0.2),
            USUAL_COVER,
        ],
    )
    def test_behind_the_lifted_blade_the_helicopter_is_whole(self, cover: Covered, aspect: float):
        """A narrow canvas cut it at the cabin."""
        camera = between_cards(fit_lifted(8.18, cover.free_aspect(aspect)), cover, aspect)
        tail, nose = 8.18 * np.array([[1.3, 0.0, 0.45], [-1.0, 0.0, 0.15]])
        x, y, _ = on_canvas(camera, aspect, np.vstack((self.RIM, tail, nose)))
        assert np.abs((x, y)).max() < 1.0

    @pytest.mark.parametrize("aspect", ASPECTS)
    @pytest.mark.parametrize("psi", [0.0, 1.0, 3.0, 5.5])
    def test_the_marked_blade_fills_the_canvas_wherever_it_is(self, psi: float, aspect: float):
        r = np.linspace(0.05, 1.0, 12)[:, None] * 8.18
        ahead = np.array([-math.sin(psi), math.cos(psi), 0.0])
        blade = r * np.array([math.cos(psi), math.sin(psi), 0.06])  # Coned by 3.4°.
        points = np.concatenate((blade + 0.15 * ahead, blade - 0.4 * ahead))
        x, y, _ = on_canvas(fit("blade", 8.18, aspect, psi, cover=UNCOVERED), aspect, points)
        assert 0.7 < max(np.abs(x).max(), np.abs(y).max()) < 1.0
        before, _, _ = on_canvas(
            fit("blade", 8.18, aspect, 0.0, cover=UNCOVERED), aspect, points @ _about_z(psi)
        )
        assert_allclose(x, before, atol=1e-9)  # It rides with the blade.


def _about_z(angle: float) -> np.ndarray:
    """Right-hand factor that turns points back by `angle`."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize(("rotor", "times"), [("uh60a", 4.0), ("xv15", 2.0), ("r22", 4.0)])
def test_no_section_is_drawn_turned_by_more_than_60_degrees(rotor: str, times: float):
    """The XV-15's root stood at 120° with four times its twist."""
    design = make_design(rotor=rotor, mu=0.2)
    found = drawn_times(design, ViewState())
    assert found == pytest.approx(times, abs=0.5)
    r = np.linspace(design.rotor.blade.root_cutout, 1.0, 9)
    assert (
        np.abs(found * (design.twist(r) - design.twist([0.75]))).max() <= math.radians(60.0) + 1e-9
    )
