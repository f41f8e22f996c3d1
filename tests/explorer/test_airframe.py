"""Airframe, rotor head and their primitives: closed surfaces, faces outward, and the dimensions of the aircraft."""

import math

import numpy as np
import pytest
import trimesh

from explorer.picture.airframe import airframe, mast, rotor_head
from explorer.picture.blade_mesh import Mesh
from rotor.design.blade import Rotor
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import SHIPPED_ROTORS


def rotor_named(name: str) -> Rotor:
    return shipped_aircraft(name).rotor_for("flight")


def solid(mesh: Mesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)


def parts_of(mesh: Mesh) -> list[trimesh.Trimesh]:
    return list(solid(mesh).split(only_watertight=False))


@pytest.mark.parametrize("name", SHIPPED_ROTORS)
class TestEveryRotor:
    def test_all_parts_are_closed_and_face_outward(self, name: str):
        craft = airframe(rotor_named(name))
        for mesh in (craft.body, craft.dark, rotor_head(rotor_named(name)), mast(rotor_named(name).radius)):
            parts = parts_of(mesh)
            assert parts
            assert all(part.is_watertight and part.volume > 0.0 for part in parts)

    def test_it_clears_the_disk_and_stands_on_the_ground(self, name: str):
        craft, radius = airframe(rotor_named(name)), rotor_named(name).radius
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
