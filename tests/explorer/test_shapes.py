"""The page's meshes: closed, truly shaped, visibly twisted."""

import math

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from explorer.picture import meshes
from explorer.picture.section_outline import blade_axes_outline
from rotor.airfoil.contour import load_contour, thickness_and_camber
from rotor.airfoil.sections import load_installed
from rotor.design.twist import LinearTwist
from rotor.files.make_design import uh60a_rotor

ROTOR = uh60a_rotor("flight")
SHAPE = meshes.blade_shape(ROTOR)


def section_angle(vertices: np.ndarray, ring: int) -> float:
    """Nose-up angle [rad] of a ring of the loft, from its trailing edge to its nose."""
    points = SHAPE.rings.shape[1]
    outline = vertices[ring * points : (ring + 1) * points]
    nose, tail = outline[(points - 1) // 2], 0.5 * (outline[0] + outline[-1])
    return math.atan2(nose[2] - tail[2], nose[1] - tail[1])


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_blade_is_watertight_and_the_right_way_out(preset: str):
    rotor = uh60a_rotor(preset)
    shape = meshes.blade_shape(rotor)
    mesh = trimesh.Trimesh(meshes.blade_vertices(shape, rotor.builtin_twist), shape.faces)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0.0


def test_blade_volume_is_that_of_its_sections():
    """∫ area dr of the true outlines, the round shank left out."""
    lifting = SHAPE.r >= ROTOR.blade.root_cutout - 1e-9
    y, z = SHAPE.rings[lifting, :, 0], SHAPE.rings[lifting, :, 1]
    area = 0.5 * np.abs(np.sum(y * np.roll(z, -1, axis=1) - z * np.roll(y, -1, axis=1), axis=1))
    assert_allclose(area.mean(), 0.064 * ROTOR.reference_chord**2, rtol=0.06)  # 0.68 of thickness 9.45 % times chord.
    lifted = float(np.trapezoid(area, SHAPE.outward[lifting]))
    mesh = trimesh.Trimesh(meshes.blade_vertices(SHAPE, LinearTwist(0.0)), SHAPE.faces)
    shank = math.pi * 0.085**2 * (ROTOR.blade.root_cutout - ROTOR.blade.flap_hinge) * ROTOR.radius
    assert lifted < mesh.volume < lifted + 1.1 * shank


def test_twist_shows_from_root_to_tip():
    """−12° per radius turns the tip against the root by −12° times the lifting span."""
    flat = meshes.blade_vertices(SHAPE, LinearTwist(0.0))
    twisted = meshes.blade_vertices(SHAPE, LinearTwist(math.radians(-12.0)))
    last, root = len(SHAPE.r) - 1, 6
    turned = [section_angle(twisted, ring) - section_angle(flat, ring) for ring in (root, last)]
    span = 1.0 - ROTOR.blade.root_cutout
    assert_allclose(turned[1] - turned[0], math.radians(-12.0) * span, rtol=1e-9)


def test_twist_is_zero_at_three_quarters_and_exaggeration_multiplies_it():
    twist = LinearTwist(math.radians(-10.0))
    once, thrice = (meshes.blade_vertices(SHAPE, twist, factor) for factor in (1.0, 3.0))
    flat = meshes.blade_vertices(SHAPE, LinearTwist(0.0))
    last = len(SHAPE.r) - 1
    zero = section_angle(flat, last)
    assert_allclose(section_angle(thrice, last) - zero, 3.0 * (section_angle(once, last) - zero), rtol=1e-9)
    near = int(np.abs(SHAPE.r - 0.75).argmin())
    expected = math.radians(-10.0) * (SHAPE.r[near] - 0.75)
    assert_allclose(section_angle(once, near) - section_angle(flat, near), expected, atol=1e-9)


def test_only_vertices_change_with_the_twist():
    one, other = (meshes.blade_vertices(SHAPE, LinearTwist(rate)) for rate in (0.0, -0.2))
    assert one.shape == other.shape
    assert SHAPE.faces.max() == len(one) - 1


def test_sc1095_outline_keeps_its_thickness():
    outline = blade_axes_outline(load_installed("sc1095"), 45)
    thickness, _, _ = thickness_and_camber(load_contour("sc1095"))
    assert_allclose(np.ptp(outline[:, 0]), 1.0, atol=2e-3)
    assert thickness - 0.004 < np.ptp(outline[:, 1]) < thickness + 0.012  # Camber adds to the height.


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


@pytest.mark.parametrize("mesh", [meshes.hub(ROTOR), meshes.mast(ROTOR.radius)], ids=["hub", "mast"])
def test_hub_and_mast_are_closed(mesh: meshes.Mesh):
    body = trimesh.Trimesh(mesh.vertices, mesh.faces)
    assert body.is_watertight
    assert body.volume > 0.0


def test_arrows_point_the_right_way():
    flight = meshes.flight_arrow(8.0).vertices
    assert flight[:, 0].argmin() == 6  # The tip leads, towards −x.
    turn = meshes.rotation_arrow(8.0).vertices
    tip, first = turn[-1], turn[0]
    assert math.atan2(tip[1], tip[0]) > math.atan2(first[1], first[0])  # Counter-clockwise seen from above.
    assert np.hypot(turn[:, 0], turn[:, 1]).min() > 8.0
