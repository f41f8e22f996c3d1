"""The probe: the disk's own values, the velocity triangle, the sums of the trim, and the click that sets it."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from explorer.charts.probe_drawing import drawing, printed_angles, probe_panel
from explorer.charts.probe_measured import lift_chart
from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import blade_shape
from explorer.picture.camera_views import pick, pick_blade
from explorer.picture.element import FlowRegion, probe
from explorer.picture.picture import (
    DISK_DROP,
    composed_rotation,
    make_picture,
    rotate,
    rotor_pose,
    tip_path_pose,
)
from explorer.picture.ride import AZIMUTHS, turn_of
from rotor import Solution, make_design, solve
from rotor.aero.switches import with_switches
from rotor.design.design import FLIGHT_MODELS
from tests.solved import with_disk

SIMPLE = replace(FLIGHT_MODELS, reverse_flow=False, compressibility=False, tip_loss=False)
CASES = {
    "hover": make_design(preset="flight", mu=0.0),
    "cruise": make_design(preset="flight", mu=0.2),
    "fast": make_design(preset="flight", mu=0.37),
    "fast, on its own grid": make_design(
        preset="flight", mu=0.37, models=replace(FLIGHT_MODELS, azimuths=24)
    ),
    "thesis": make_design(preset="thesis", mu=0.3),
    "switched off": make_design(preset="flight", mu=0.3, models=SIMPLE),
}


@pytest.fixture(scope="module", params=CASES)
def solution(request: pytest.FixtureRequest) -> Solution:
    return solve(CASES[request.param]).require()


@pytest.fixture(scope="module")
def fast() -> Solution:
    return solve(CASES["fast"]).require()


@pytest.fixture(scope="module")
def steady(fast: Solution) -> Solution:
    """What a section does follows from the flow at its quarter chord at that moment."""
    return solve(with_switches(fast.design, ("unsteady", "dynamic_stall")), fast).require()


def stations(solution: Solution) -> list[tuple[int, int]]:
    rows, columns = solution.disk.u_t.shape
    return [(i, j) for i in range(0, rows, 3) for j in range(0, columns, 7)] + [
        (rows - 1, columns - 1)
    ]


def test_at_a_station_it_is_what_the_disk_holds(solution: Solution):
    disk, speed = solution.disk, solution.design.rotor.tip_speed
    for i, j in stations(solution):
        p = probe(solution, float(disk.r[i]), float(disk.psi[j]))
        seen = (
            p.theta,
            p.u_t / speed,
            p.u_p / speed,
            p.induced / speed,
            p.mach,
            p.cl,
            p.cd,
            p.cd_mach,
        )
        fields = (
            disk.theta,
            disk.u_t,
            disk.u_p,
            disk.induced,
            disk.mach,
            disk.cl,
            disk.cd,
            disk.cd_mach,
        )
        assert_allclose(seen, [field[i, j] for field in fields], rtol=1e-14, atol=1e-15)
        assert_allclose(math.remainder(p.alpha - disk.alpha[i, j], math.tau), 0.0, atol=1e-13)
        if disk.u_t[i, j] < 0.0:
            assert p.region is (
                FlowRegion.REVERSE if solution.design.models.reverse_flow else FlowRegion.IDLE
            )
        else:
            assert p.stall_margin == pytest.approx(disk.stall_margin[i, j], abs=1e-12)
            assert (p.region is FlowRegion.SEPARATED) == disk.stalled[i, j]


@pytest.mark.parametrize("solution", ["hover", "fast, on its own grid", "thesis"], indirect=True)
def test_its_loads_add_up_to_the_trim(solution: Solution):
    """Σ over stations of N_b dT = C_T ρA(ΩR)², and of the power likewise, whatever the loss factor took."""
    design, disk = solution.design, solution.disk
    rotor = design.rotor
    cell = rotor.blades * np.repeat(disk.dr, len(disk.psi)) * rotor.radius / len(disk.psi)
    all_of_them = [probe(solution, float(r), float(psi)) for r in disk.r for psi in disk.psi]
    assert_allclose(
        cell @ [p.thrust for p in all_of_them], solution.ct * design.thrust_unit, rtol=1e-12
    )
    shaft = (disk.r * disk.dr @ disk.dcq).sum() / len(disk.psi) * design.power_unit
    assert_allclose(cell @ [p.power for p in all_of_them], shaft, rtol=1e-12)


@given(r=st.floats(0.14, 1.0), psi=st.floats(-7.0, 14.0))
def test_the_triangle_closes_anywhere(r: float, psi: float, steady: Solution):
    root = steady.design.rotor.blade.root_cutout
    p = probe(steady, max(r, root), psi)
    assert probe(steady, p.r, psi + math.tau).alpha == pytest.approx(p.alpha, abs=1e-9)
    assert_allclose(p.u**2, p.u_t**2 + p.u_p**2, rtol=1e-12)
    assert -math.pi < p.alpha <= math.pi
    assert_allclose(math.remainder(p.theta - p.phi - p.alpha, math.tau), 0.0, atol=1e-12)
    # Forces turned from flow to disk and back: one vector.
    assert_allclose(math.hypot(p.lift, p.drag), math.hypot(p.thrust, p.pull), rtol=1e-12)
    assert_allclose(
        p.thrust,
        p.lift * math.cos(p.phi) - p.drag * math.sin(p.phi),
        atol=1e-9 * abs(p.lift) + 1e-9,
    )
    assert p.cd > 0.0
    assert p.stall is not None
    assert all(math.isfinite(value) for value in (p.cl, p.lift, p.power, *p.stall))


def test_loads_are_the_coefficients_times_the_pressure(fast: Solution):
    """q c C_l and q c C_d by hand; the lifting line takes no loss factor off.

    Yawed drag is along another velocity, and apparent mass adds to lift in unsteady flow.
    """
    off = "radial_friction", "unsteady", "dynamic_stall"
    fast = solve(with_switches(fast.design, off), fast).require()
    disk, density = fast.disk, fast.design.condition.density
    for i, j in stations(fast):
        p = probe(fast, float(disk.r[i]), float(disk.psi[j]))
        pressure = 0.5 * density * p.u**2 * p.chord
        assert_allclose((p.lift, p.drag), (pressure * p.cl, pressure * p.cd), rtol=1e-9, atol=1e-9)


def test_alpha_turns_with_the_flow_not_through_zero(fast: Solution):
    """Between two stations on both sides of ±180° the mean of the angles is 0°, where the flow never was."""
    disk = fast.disk
    sign = np.where(np.arange(len(disk.psi)) % 2 == 0, 1.0, -1.0)
    behind = np.full(disk.u_t.shape, -0.2)
    down = 0.02 * sign * np.ones_like(behind)
    alpha = -np.arctan2(down, behind)
    wind = replace(disk, u_t=behind, u_p=down, theta=np.zeros_like(behind), alpha=alpha)
    p = probe(with_disk(fast, wind), 0.5, float(0.5 * disk.psi[1]))
    assert_allclose(abs(p.alpha), math.pi)
    assert p.region is FlowRegion.REVERSE


def test_an_r_off_the_blade_is_refused(fast: Solution):
    with pytest.raises(ValueError, match=r"r/R 0\.05 is not on the blade: choose 0\.\d+ … 1"):
        probe(fast, 0.05, 0.0)


class TestPick:
    @staticmethod
    def on_disk(solution: Solution, r: float, psi: float) -> np.ndarray:
        """A point of the drawn disk in the world."""
        shaft, disk = rotor_pose(solution.controls), tip_path_pose(solution.controls, DISK_DROP)
        place = r * solution.design.rotor.radius * np.array([math.cos(psi), math.sin(psi), 0.0])
        inside = disk.position + rotate(disk.wxyz, place)
        assert_allclose(rotate(composed_rotation(shaft.wxyz, disk.wxyz), place) + rotate(shaft.wxyz, disk.position),
                        rotate(shaft.wxyz, inside), atol=1e-12)  # fmt: skip
        return rotate(shaft.wxyz, inside)

    @given(
        r=st.floats(0.15, 1.01),  # The rim is not missed by a pixel.
        psi=st.floats(0.0, 6.28),
        eye=st.tuples(st.floats(-30, 30), st.floats(-30, 30), st.floats(6, 60)),
        stretch=st.floats(0.01, 100.0),
    )
    def test_a_ray_through_a_point_finds_it(self, r, psi, eye, stretch, fast: Solution):
        r = max(r, fast.design.rotor.blade.root_cutout)
        point = self.on_disk(fast, r, psi)
        found = pick(fast, eye, stretch * (point - np.array(eye)))
        assert_allclose(found[0], min(r, 1.0), atol=1e-9)
        assert_allclose(math.remainder(found[1] - psi, math.tau), 0.0, atol=1e-9)

    def test_beside_the_disk_behind_and_edge_on_there_is_nothing(self, fast: Solution):
        above = np.array([0.0, 0.0, 30.0])
        for r in (0.02, 1.1):
            assert pick(fast, above, self.on_disk(fast, r, 1.0) - above) is None
        assert pick(fast, above, (0.0, 0.0, 1.0)) is None
        normal = rotate(
            composed_rotation(
                rotor_pose(fast.controls).wxyz, tip_path_pose(fast.controls, 0.0).wxyz
            ),
            np.eye(3)[0],
        )
        assert pick(fast, above, normal) is None


@pytest.mark.parametrize("psi_deg", [65.0, 250.0])
@pytest.mark.parametrize("bending", [False, True])
def test_a_ray_at_a_blade_finds_its_section_and_keeps_the_azimuth(psi_deg: float, bending: bool):
    """Against the vertices of the picture, placed in the world as the page places them."""
    solution = solve(make_design(mu=0.2, models=replace(FLIGHT_MODELS, bending=bending)))
    view = ViewState(azimuth_deg=psi_deg)
    picture, shape = make_picture(solution, view), blade_shape(solution.design.rotor)
    points = shape.rings.shape[1]
    for k, pose in enumerate(picture.blades.poses):
        own = picture.blades.forms[k].vertices(shape)
        for r in (0.98, 0.78, 0.54, 0.35):
            ring = int(np.argmin(np.abs(shape.r - r)))
            top = own[ring * points + points // 4]
            place = rotate(picture.rotor.wxyz, pose.position + rotate(pose.wxyz, top))
            # From where the upper side is seen at any pitch.
            eye = place + np.array([4.0, -3.0, 30.0])
            found = pick_blade(solution, view, eye, place - eye)
            assert_allclose(found[0], shape.r[ring], atol=0.003)
            assert found[1] == (psi_deg + 90.0 * k) % 360.0
    assert pick_blade(solution, view, (22.0, 33.0, 15.0), (0.0, 0.0, 1.0)) is None


def numbers_of(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


class TestAngles:
    """The section's angles add up to its angle of attack as they are printed."""

    @given(r=st.floats(0.14, 1.0), psi=st.floats(0.0, 6.3))
    def test_printed_angles_add_up(self, r: float, psi: float, fast: Solution):
        p = probe(fast, max(r, fast.design.rotor.blade.root_cutout), psi)
        assert p.pitch_rate is not None
        theta, phi, rate, *turn, alpha = numbers_of(
            printed_angles(p).sentence.replace("− 3", "−3").replace("−", "-")
        )
        assert theta - phi + rate + math.fsum(turn) == pytest.approx(alpha, abs=1e-9)
        exact = [math.degrees(angle) for angle in (p.theta, p.phi, p.pitch_rate)]
        # No part is rounded by more than a step.
        assert_allclose([theta, phi, rate], exact, atol=0.1)
        assert alpha == pytest.approx(math.degrees(p.alpha), abs=0.0501)

    def test_the_part_of_the_pitch_rate_is_that_of_the_flow_at_three_quarters_of_the_chord(
        self, fast: Solution
    ):
        """Of the UH-60A the outer half of the blade pitches by some tenths of a degree on each side."""
        disk = fast.disk
        parts = [probe(fast, 0.75, k * math.tau / 24).pitch_rate or 0.0 for k in range(24)]
        assert 0.05 < math.degrees(max(parts)) < 1.0
        assert 0.05 < -math.degrees(min(parts)) < 1.0
        p = probe(fast, float(disk.r[12]), float(disk.psi[6]))
        ahead = disk.alpha[12, 6] - disk.theta[12, 6] + math.atan2(disk.u_p[12, 6], disk.u_t[12, 6])
        assert p.pitch_rate == pytest.approx(math.remainder(ahead, math.tau), abs=1e-12)

    def test_the_drawer_names_the_formula_that_is_used(self, fast: Solution, steady: Solution):
        moving = probe_panel(probe(fast, 0.75, 0.0), fast)
        still = probe_panel(probe(steady, 0.75, 0.0), steady)
        assert re.search(r">θ [\d.]+° − φ [\d.]+° \+ pitch rate [(−\d.]+°\)? = α [\d.]+°<", moving)
        assert 'title="α = θ − φ + pitch rate: ' in moving
        assert "pitch rate" not in still
        assert 'title="α = θ − φ: ' in still
        p = probe(fast, 0.75, 0.0)
        angles = printed_angles(p)
        for name, angle in (("θ", angles.theta), ("φ", angles.phi)):
            assert f">{name} {angle:.1f}°<".replace("-", "−") in moving

    def test_a_whole_turn_is_a_part_of_the_sum(self, fast: Solution):
        """In reverse flow the wind may come from more than half a turn away."""
        p = probe(fast, 0.75, 0.0)
        back = replace(p, theta=0.2, phi=-3.0, pitch_rate=0.0, alpha=3.2 - math.tau)
        words = "θ 11.4° − φ (−171.9°) + pitch rate 0.0° − 360° = α −176.7°"
        assert printed_angles(back).sentence == words


class TestDrawing:
    def test_the_section_stands_at_its_pitch_and_the_wind_at_its_angle(self, fast: Solution):
        p = probe(fast, 0.75, math.radians(270.0))
        drawn, _ = drawing(p, 300.0, 8e3)
        shape = np.array(numbers_of(re.findall(r'points="([^"]*)"', drawn)[0])).reshape(-1, 2)
        assert len(shape) == 61  # The outline is the first polygon.
        nose, tail = shape[30], 0.5 * (shape[0] + shape[-1])
        pitch = math.atan2(tail[1] - nose[1], tail[0] - nose[0])
        assert pitch == pytest.approx(
            p.theta - p.section.parts[0][0].incidence_offset, abs=math.radians(0.5)
        )
        reach = math.dist(nose, tail)
        assert reach == pytest.approx(100.0, rel=0.02)

    def test_in_reverse_flow_the_wind_comes_from_the_trailing_edge(self, fast: Solution):
        p = probe(fast, 0.25, math.radians(270.0))
        assert p.region is FlowRegion.REVERSE
        drawn, _ = drawing(p, 300.0, 8e3)
        wind = next(
            line for line in re.findall(r"<line[^>]*>", drawn) if 'stroke-width="2.6"' in line
        )
        start, end = (float(wind.split(f'{name}="')[1].split('"')[0]) for name in ("x1", "x2"))
        assert start > end > 180.0  # From the right, ending behind the trailing edge.
        panel = probe_panel(p, fast)
        assert "reverse flow" in panel
        assert "retreating side" in panel

    def test_every_region_of_the_disk_has_its_words(self, fast: Solution):
        """A section past the static angle, attached, had none, and the drawer stood still."""
        sections = [
            probe(fast, float(r), float(psi)) for r in fast.disk.r for psi in fast.disk.psi[::4]
        ]
        regions = {p.region for p in sections}
        assert {FlowRegion.ATTACHED, FlowRegion.PAST_STATIC, FlowRegion.REVERSE} <= regions
        for region in regions:
            first = next(p for p in sections if p.region is region)
            assert f">{region.value}<" in probe_panel(first, fast)

    def test_the_point_lies_on_the_lift_curve(self, steady: Solution):
        """At a station exactly; between two as near as the stations are."""
        disk = steady.disk
        p = probe(steady, float(disk.r[15]), float(disk.psi[17]))
        assert p.section.lift_curve(np.array([p.alpha]), p.mach)[0] == pytest.approx(p.cl, abs=1e-9)
        q = probe(steady, float(disk.r[15] + 0.4 * disk.dr[15]), float(disk.psi[17] + 0.01))
        assert q.section.lift_curve(np.array([q.alpha]), q.mach)[0] == pytest.approx(q.cl, abs=2e-3)


class TestRide:
    """One turn with a section: a steady section's point is on its lift curve all the way round."""

    @pytest.mark.parametrize("near", [0.3, 0.75])
    def test_the_point_is_on_its_curve_and_the_triangle_closes(self, near: float, steady: Solution):
        r = float(steady.disk.r[np.abs(steady.disk.r - near).argmin()])
        turn, step = turn_of(steady, r, 40.0), AZIMUTHS // math.gcd(AZIMUTHS, len(steady.disk.psi))
        reversed_flow = np.array(turn.u) < 0.0
        # At ψ 270° the air comes from behind inboard of µ.
        assert reversed_flow.any() == (near < 0.37)
        for k in range(0, AZIMUTHS, step):  # Where the disk has a station.
            on_curve = np.interp(turn.alpha[k], turn.angles, turn.curves[k])
            # Beside the hub the flow stands across the section.
            if abs(turn.alpha[k]) < max(turn.angles):
                assert on_curve == pytest.approx(turn.cl[k], abs=0.01)
            assert turn.lift[k] == pytest.approx(
                probe(steady, r, math.tau * k / AZIMUTHS).lift / 1e3, abs=1e-3
            )
            if not reversed_flow[k]:
                assert turn.theta[k] - turn.phi[k] == pytest.approx(turn.alpha[k], abs=0.02)


@pytest.fixture(scope="module")
def stalled() -> Solution:
    return solve(make_design(mu=0.35, mass_kg=9500.0)).require()


class TestDynamicStall:
    def test_the_region_is_what_the_section_does(self, stalled: Solution):
        unsteady, disk = stalled.disk.unsteady, stalled.disk
        differ = (unsteady.separation < 0.7) & (disk.stall_margin > 0.02) & (disk.u_t > 0.1)
        i, j = np.argwhere(differ)[0].tolist()  # Still separated, though the angle has come back.
        p = probe(stalled, float(disk.r[i]), float(disk.psi[j]))
        assert p.region is FlowRegion.SEPARATED
        assert p.unsteady.separation == pytest.approx(unsteady.separation[i, j], abs=1e-12)

    def test_without_stall_there_is_no_margin(self, stalled: Solution):
        without = solve(with_switches(stalled.design, ("stall",)))
        p = probe(without, 0.6, math.radians(285.0))
        assert (p.stall_margin, p.region) == (None, FlowRegion.ATTACHED)
        assert "stall" not in lift_chart(p).y.label
        assert set(turn_of(without, 0.6, 285.0).margin) == {None}

    def test_the_loop_is_the_disks_own(self, stalled: Solution):
        disk = stalled.disk
        p = probe(stalled, disk.r[12], 1.0)
        assert_allclose(p.unsteady.loop[0], disk.alpha[12], atol=1e-9)
        assert_allclose(p.unsteady.loop[1], disk.cl[12], atol=1e-12)

    def test_the_drawer_draws_its_turn(self, stalled: Solution):
        p = probe(stalled, 0.6, math.radians(285.0))
        assert "a turn" in [one.label for one in lift_chart(p).series]
        steady = solve(
            replace(stalled.design, models=replace(stalled.design.models, dynamic_stall=False))
        )
        assert "a turn" not in [one.label for one in lift_chart(probe(steady, 0.6, 1.0)).series]
