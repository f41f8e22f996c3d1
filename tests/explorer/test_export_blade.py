"""The exported blade: closed, to scale and twisted by any law."""

import io
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose

from explorer.__main__ import main
from explorer.export.blade import blade_mesh, blade_stl
from explorer.picture.picture import with_active_twist
from rotor.airfoil.sections import load_installed
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.twist import (
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TwistLaw,
)
from rotor.files.make_design import change_airfoils, make_design

DESIGN = make_design(preset="flight", mu=0.2)
PLAIN = LinearTwist(0.0)
LAWS: tuple[TwistLaw, ...] = (
    DESIGN.twist,
    QuadraticTwist(math.radians(40.0), math.radians(-30.0)),
    PiecewiseLinearTwist((-0.5, 0.3, -0.6), (0.37, 0.81)),
    IdealTwist(0.12),
    SplineTwist((0.13, 0.4, 0.75, 1.0), (0.2, 0.05, -0.01, -0.12)),
    SumTwist(DESIGN.twist, PiecewiseLinearTwist((-0.2, 0.4), (0.6,))),
)


def cut(mesh: trimesh.Trimesh, r: float) -> np.ndarray:
    """Outline points (y, z) [m] where the mesh crosses r = x/R."""
    lines = trimesh.intersections.mesh_plane(
        mesh, [1.0, 0.0, 0.0], [r * DESIGN.rotor.radius, 0.0, 0.0]
    )
    return np.asarray(lines).reshape(-1, 3)[:, 1:]


def reach(points: np.ndarray, angle: float = 0.0) -> np.ndarray:
    """How far an outline turned by `angle` [rad] reaches in each of 24 directions [m]."""
    directions = 2.0 * math.pi * np.arange(24) / 24 - angle
    return (points @ np.array([np.cos(directions), np.sin(directions)])).max(axis=0)


def chord_of(points: np.ndarray) -> float:
    """[m]"""
    apart = points[:, None] - points[None]
    return float(np.sqrt((apart**2).sum(axis=2)).max())


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.spec()[:24])
def test_any_twist_is_watertight_to_scale_and_turned_as_the_law_says(law: TwistLaw):
    design = replace(DESIGN, twist=law)
    mesh, flat = blade_mesh(design), blade_mesh(replace(DESIGN, twist=PLAIN))
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    # Turning sections moves no material.
    assert mesh.volume == pytest.approx(flat.volume, rel=0.01)
    hinge = design.rotor.blade.flap_hinge * design.rotor.radius
    assert_allclose(mesh.bounds[:, 0], (hinge, design.rotor.radius), rtol=1e-12)
    # Beside and between the lofted sections.
    for r in (
        0.2,
        0.3701,
        0.55,
        0.5999,
        0.75,
        0.8099,
        0.93,
        0.9999,
    ):
        turned, straight = (cut(one, r) for one in (mesh, flat))
        assert_allclose(reach(turned), reach(straight, float(law(r))), atol=2e-4)


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_chord_and_thickness_are_those_of_the_rotor(preset: str):
    design = replace(make_design(preset=preset), twist=PLAIN)
    mesh, blade = blade_mesh(design), design.rotor.blade
    for r in (0.25, 0.6, 0.95):
        inner, outer, weight = blade.section_at(r)
        assert weight in (0.0, 1.0)
        section = load_installed(inner if weight == 0.0 else outer)
        points, chord = cut(mesh, r), float(blade.chord(r)) * section.chord_ratio
        assert_allclose(chord_of(points), chord, rtol=1e-3)
        # 9.4 and 9.5 % thick, a little nose-down.
        assert 0.09 * chord < np.ptp(points[:, 1]) < 0.12 * chord


def test_the_file_is_what_the_mesh_is_and_says_its_unit():
    content = blade_stl(DESIGN)
    assert b"unit metre" in content[:80]
    assert not content.startswith(b"solid")  # That would make readers take it for text.
    read = trimesh.load_mesh(io.BytesIO(content), file_type="stl")
    assert isinstance(read, trimesh.Trimesh)
    assert read.is_watertight
    assert read.volume == pytest.approx(blade_mesh(DESIGN).volume, rel=1e-5)
    assert len(content) < 2_000_000


def test_an_active_twist_is_taken_at_the_azimuth_asked_for():
    design = replace(DESIGN, active_twist=ActiveTwist((Harmonic(1, math.radians(3.0)),)))
    laws = [with_active_twist(design, psi) for psi in (0.0, math.pi)]
    tail, nose = (blade_mesh(replace(DESIGN, twist=law)) for law in laws)
    assert tail.is_watertight
    assert nose.is_watertight
    for r in (0.5, 0.999):
        swing = math.radians(6.0) * (r - 0.13) / 0.87
        assert_allclose(reach(cut(tail, r)), reach(cut(nose, r), swing), atol=2e-4)
    # On its own: the law alone.
    assert_allclose(blade_mesh(design).vertices, blade_mesh(DESIGN).vertices)


def test_sections_that_change_at_once_stay_closed():
    design = replace(DESIGN, rotor=change_airfoils(DESIGN.rotor, "sc1094r8,sc1095@0.62"))
    assert blade_mesh(design).is_watertight


def test_the_command_writes_the_jig_shape(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["blade", "--out", str(tmp_path)]) == 0
    (path,) = tmp_path.iterdir()
    assert path.name.endswith("-as-built.stl")
    assert path.read_bytes() == blade_stl(make_design())
    assert capsys.readouterr().out.count("MB") == 1
