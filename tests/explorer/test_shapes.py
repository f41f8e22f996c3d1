"""The blade's mesh: closed, truly shaped, visibly twisted."""

import math

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from explorer.picture import blade_mesh
from explorer.picture.airframe import airframe, mast, rotor_head
from explorer.picture.blade_mesh import Mesh
from rotor.design.blade import Rotor
from rotor.design.twist import LinearTwist
from rotor.files.make_design import uh60a_rotor
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import SHIPPED_ROTORS

ROTOR = uh60a_rotor("flight")
SHAPE = blade_mesh.blade_shape(ROTOR)


def section_angle(vertices: np.ndarray, ring: int) -> float:
    """Nose-up angle [rad] of a ring of the loft, from its trailing edge to its nose."""
    points = SHAPE.rings.shape[1]
    outline = vertices[ring * points : (ring + 1) * points]
    nose, tail = outline[(points - 1) // 2], 0.5 * (outline[0] + outline[-1])
    return math.atan2(nose[2] - tail[2], nose[1] - tail[1])


def test_blade_volume_is_that_of_its_sections():
    """∫ area dr of the true outlines, the round shank left out."""
    lifting = SHAPE.r >= ROTOR.blade.root_cutout - 1e-9
    y, z = SHAPE.rings[lifting, :, 0], SHAPE.rings[lifting, :, 1]
    area = 0.5 * np.abs(np.sum(y * np.roll(z, -1, axis=1) - z * np.roll(y, -1, axis=1), axis=1))
    # 0.68 of thickness 9.45 % times chord.
    assert_allclose(area.mean(), 0.064 * ROTOR.reference_chord**2, rtol=0.06)
    lifted = float(np.trapezoid(area, SHAPE.outward[lifting]))
    mesh = trimesh.Trimesh(blade_mesh.blade_vertices(SHAPE, LinearTwist(0.0)), SHAPE.faces)
    shank = math.pi * 0.085**2 * (ROTOR.blade.root_cutout - ROTOR.blade.flap_hinge) * ROTOR.radius
    assert lifted < mesh.volume < lifted + 1.1 * shank


def test_twist_is_zero_at_three_quarters_and_exaggeration_multiplies_it():
    twist = LinearTwist(math.radians(-10.0))
    once, thrice = (blade_mesh.blade_vertices(SHAPE, twist, factor) for factor in (1.0, 3.0))
    flat = blade_mesh.blade_vertices(SHAPE, LinearTwist(0.0))
    last = len(SHAPE.r) - 1
    zero = section_angle(flat, last)
    assert_allclose(
        section_angle(thrice, last) - zero, 3.0 * (section_angle(once, last) - zero), rtol=1e-9
    )
    near = int(np.abs(SHAPE.r - 0.75).argmin())
    expected = math.radians(-10.0) * (SHAPE.r[near] - 0.75)
    assert_allclose(section_angle(once, near) - section_angle(flat, near), expected, atol=1e-9)


class TestSweptTip:
    def test_the_tip_of_the_uh60a_is_swept_by_20_degrees_from_0_929(self):
        """The quarter chord lies 0.071 R tan 20° = 211 mm behind the axis; the structural model of SONATA has 196."""
        assert_allclose(
            blade_mesh.swept_back(ROTOR, 1.0),
            0.071 * 8.1788 * math.tan(math.radians(20.0)),
            rtol=1e-12,
        )
        flat = blade_mesh.blade_vertices(SHAPE, LinearTwist(0.0))
        points = SHAPE.rings.shape[1]
        nose = flat[: len(SHAPE.r) * points].reshape(-1, points, 3)[:, points // 2]
        swept = SHAPE.r > 0.935
        slope = np.diff(nose[swept, 1]) / np.diff(nose[swept, 0])
        assert_allclose(slope, -math.tan(math.radians(20.0)), rtol=1e-6)

    @pytest.mark.parametrize("name", ["r22", "s61"])
    def test_other_rotors_have_straight_blades(self, name: str):
        assert (
            blade_mesh.swept_back(
                shipped_aircraft(name).rotor_for("flight"), [0.5, 0.95, 1.0]
            ).max()
            == 0.0
        )


# Airframe, rotor head and their primitives


def rotor_named(name: str) -> Rotor:
    return shipped_aircraft(name).rotor_for("flight")


def solid(mesh: Mesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)


def parts_of(mesh: Mesh) -> list[trimesh.Trimesh]:
    return list(solid(mesh).split(only_watertight=False))


@pytest.mark.parametrize("name", SHIPPED_ROTORS)
class TestEveryRotor:
    def test_all_parts_are_closed_and_face_outward(self, name: str):
        craft = airframe(rotor_named(name), shipped_aircraft(name).tail_rotor)
        for mesh in (
            craft.body,
            craft.dark,
            rotor_head(rotor_named(name)),
            mast(rotor_named(name).radius),
        ):
            parts = parts_of(mesh)
            assert parts
            assert all(part.is_watertight and part.volume > 0.0 for part in parts)

    def test_it_clears_the_disk_and_stands_on_the_ground(self, name: str):
        rotor = rotor_named(name)
        craft, radius = airframe(rotor, shipped_aircraft(name).tail_rotor), rotor.radius
        inside = np.hypot(craft.body.vertices[:, 0], craft.body.vertices[:, 1]) < radius
        assert craft.body.vertices[inside, 2].max() < -0.05 * radius
        lowest = craft.dark.vertices[:, 2].min()
        assert lowest == pytest.approx(craft.ground, abs=0.01 * radius)

    def test_the_head_has_an_arm_for_each_blade(self, name: str):
        rotor = rotor_named(name)
        head = rotor_head(rotor).vertices
        psi = np.degrees(np.arctan2(head[:, 1], head[:, 0]))
        far = np.hypot(head[:, 0], head[:, 1]) > 0.95 * np.hypot(head[:, 0], head[:, 1]).max()
        step = 360.0 / rotor.blades
        arms = np.unique(np.round(psi[far] / step) % rotor.blades)
        assert len(arms) == rotor.blades


@pytest.mark.parametrize(
    ("name", "length"), [("s61", 17.96), ("bo105", 8.56), ("gazelle", 9.53), ("r22", 6.30)]
)
def test_each_helicopter_has_its_length_and_its_tail_rotor(name: str, length: float):
    aircraft = shipped_aircraft(name)
    rotor, tail = rotor_named(name), aircraft.tail_rotor
    craft = airframe(rotor, tail)
    assert np.ptp(craft.body.vertices[:, 0]) == pytest.approx(length, abs=0.02)
    aft = [
        part.vertices
        for part in parts_of(craft.dark)
        if part.vertices[:, 1].min() > 0.0 and part.vertices[:, 0].min() > 0.5 * rotor.radius
    ]
    if tail is None:  # A fan in the fin.
        assert not aft
        return
    assert len(aft) == 1 + tail.blades
    away = np.concatenate(aft) - aft[0].mean(axis=0)
    assert aft[0].mean(axis=0)[0] == pytest.approx(tail.arm, abs=0.02)
    assert np.linalg.norm(away, axis=1).max() == pytest.approx(tail.radius, rel=0.01)


class TestBlackHawk:
    """Against the dimensions in Jane's All the World's Aircraft."""

    CRAFT = airframe(rotor_named("uh60a"))

    def test_fuselage_length_and_width(self):
        body = self.CRAFT.body.vertices
        # The fin's tip is the aftmost point: nose to there is 15.26 m.
        assert np.ptp(body[:, 0]) == pytest.approx(15.26, abs=0.1)
        cabin = body[(body[:, 0] < 2.0) & (body[:, 2] > -2.6)]
        assert np.ptp(cabin[np.abs(cabin[:, 0]) < 1.0, 1]) == pytest.approx(2.36, abs=0.1)

    def test_tail_rotor_is_on_starboard_3_35_m_wide_and_canted_20_degrees(self):
        dark = self.CRAFT.dark.vertices
        rotor = dark[(dark[:, 0] > 7.8) & (dark[:, 2] > -2.0)]
        assert rotor[:, 1].mean() > 0.0
        middle = rotor.mean(axis=0)
        assert 2.0 * np.linalg.norm(rotor - middle, axis=1).max() == pytest.approx(3.35, abs=0.1)
        normal = np.linalg.svd(rotor - middle)[2][-1]
        assert math.degrees(math.asin(abs(normal[2]))) == pytest.approx(20.0, abs=1.0)
