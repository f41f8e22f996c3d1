"""Records of trims for files without a server: blades as flown."""

import base64
import math
from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose

from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import blade_shape
from explorer.scene.still_scene import flown_pitch, point_record
from rotor import make_design, parse_twist, solve

DESIGN = make_design(twist="linear:-12", mu=0.2)
SHAPE = blade_shape(DESIGN.rotor)
VIEW = ViewState()


def test_blades_are_drawn_as_flown():
    """At the tip, four times the jig twist and elastic twist outboard of 0.75 R, at the azimuths of the trim."""
    solution = solve(DESIGN).require()
    elastic, r = solution.disk.elastic_twist, solution.disk.r
    assert elastic is not None
    inside, tip = (np.array([np.interp(at, r, column) for column in elastic.T]) for at in (0.75, 1.0))
    waves = flown_pitch(solution, SHAPE, 4.0)[:, -1]
    n = np.arange(1, 5)[:, None] * solution.disk.psi
    drawn = waves[0] + waves[1::2] @ np.cos(n) + waves[2::2] @ np.sin(n)
    assert_allclose(np.degrees(drawn), np.degrees(4 * (math.radians(-3.0) + tip - inside) + inside), atol=1e-3)


def test_a_rigid_blade_has_its_jig_shape_at_every_azimuth():
    rigid = replace(DESIGN, models=replace(DESIGN.models, elastic_twist=False))
    record = point_record(solve(rigid).require(), SHAPE, VIEW, (0.0, 10.0))
    flown = np.frombuffer(base64.b64decode(record["flown"]), np.float32)
    assert_allclose(flown, SHAPE.pitch(parse_twist("linear:-12"), VIEW.exaggeration), atol=1e-6)
