"""The blade's mesh: closed, truly shaped, visibly twisted."""

import math

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from explorer.picture import blade_mesh
from explorer.picture.blade_mesh import blade_axes_outline
from rotor.airfoil.contour import load_contour
from rotor.airfoil.sections import load_installed
from rotor.design.twist import LinearTwist
from rotor.files.make_design import uh60a_rotor
from rotor.files.rotor_file import shipped_aircraft

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
    assert_allclose(area.mean(), 0.064 * ROTOR.reference_chord**2, rtol=0.06)  # 0.68 of thickness 9.45 % times chord.
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
    assert_allclose(section_angle(thrice, last) - zero, 3.0 * (section_angle(once, last) - zero), rtol=1e-9)
    near = int(np.abs(SHAPE.r - 0.75).argmin())
    expected = math.radians(-10.0) * (SHAPE.r[near] - 0.75)
    assert_allclose(section_angle(once, near) - section_angle(flat, near), expected, atol=1e-9)


def test_r8_is_drooped_by_one_degree_and_longer():
    """Rotated nose-down by 1° and stretched by 1.009875 about the quarter chord."""
    from rotor.airfoil.contour import resample

    own = resample(load_contour("sc1094r8"), 45).points
    own_axes = np.stack((0.25 - own[:, 0], own[:, 1]), axis=1)
    installed = blade_axes_outline(load_installed("sc1094r8"), 45)
    nose, tail = 22, 0
    before, after = own_axes[nose] - own_axes[tail], installed[nose] - installed[tail]
    assert_allclose(np.hypot(*after) / np.hypot(*before), 1.009875, rtol=1e-9)
    turn = math.degrees(math.atan2(*after[::-1]) - math.atan2(*before[::-1]))
    assert_allclose(turn, -1.0, atol=1e-9)


class TestSweptTip:
    def test_the_tip_of_the_uh60a_is_swept_by_20_degrees_from_0_929(self):
        """The quarter chord lies 0.071 R tan 20° = 211 mm behind the axis; the structural model of SONATA has 196."""
        assert_allclose(blade_mesh.swept_back(ROTOR, 1.0), 0.071 * 8.1788 * math.tan(math.radians(20.0)), rtol=1e-12)
        flat = blade_mesh.blade_vertices(SHAPE, LinearTwist(0.0))
        points = SHAPE.rings.shape[1]
        nose = flat[: len(SHAPE.r) * points].reshape(-1, points, 3)[:, points // 2]
        swept = SHAPE.r > 0.935
        slope = np.diff(nose[swept, 1]) / np.diff(nose[swept, 0])
        assert_allclose(slope, -math.tan(math.radians(20.0)), rtol=1e-6)

    @pytest.mark.parametrize("name", ["r22", "s61"])
    def test_other_rotors_have_straight_blades(self, name: str):
        assert blade_mesh.swept_back(shipped_aircraft(name).rotor_for("flight"), [0.5, 0.95, 1.0]).max() == 0.0
