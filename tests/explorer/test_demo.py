"""The demo without a server: the numbers in the file are the solver's, and nothing in it leads to another host."""

import base64
import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from explorer.__main__ import main
from explorer.export.demo import demo_html

TWISTS, SPEEDS = (-16.0, -12.0, 0.0), (0.0, 0.2)


@pytest.fixture(scope="module")
def page() -> str:
    return demo_html(rotor.make_design(), TWISTS, SPEEDS)


@pytest.fixture(scope="module")
def data(page: str) -> dict:
    return record_of(page)


def record_of(page: str) -> dict:
    found = re.search(r'<script id="demo-data" type="application/json">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    return json.loads(found[1])


def test_powers_are_those_of_a_trim_from_cold(data: dict):
    for s, mu in enumerate(SPEEDS):
        for t, twist in enumerate(TWISTS):
            power = rotor.solve(rotor.make_design(twist=f"linear:{twist}", mu=mu)).power
            parts = [getattr(power, name) / 1e3 for name, _, _ in data["parts"]]
            assert_allclose(data["points"][s][t]["power"], parts, atol=0.011)
            assert_allclose(sum(parts), power.total / 1e3, rtol=1e-12)


def floats(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), np.float32)


def test_blades_are_drawn_as_flown(data: dict):
    """At the tip, four times the jig twist and elastic twist outboard of 0.75 R, at the azimuths of the trim."""
    assert_allclose(np.degrees(floats(data["jig"][1])[-1]), 4 * -12.0 * 0.25, atol=1e-4)
    solution = rotor.solve(rotor.make_design(twist="linear:-12", mu=0.2)).require()
    elastic, r = solution.disk.elastic_twist, solution.disk.r
    assert elastic is not None
    inside, tip = (np.array([np.interp(at, r, column) for column in elastic.T]) for at in (0.75, 1.0))
    waves = floats(data["points"][1][1]["flown"]).reshape(-1, data["rings"][0])[:, -1]
    n = np.arange(1, 5)[:, None] * solution.disk.psi
    drawn = waves[0] + waves[1::2] @ np.cos(n) + waves[2::2] @ np.sin(n)
    assert_allclose(np.degrees(drawn), np.degrees(4 * (math.radians(-3.0) + tip - inside) + inside), atol=1e-3)


def test_a_rigid_blade_has_its_jig_shape_at_every_azimuth():
    design = rotor.make_design()
    models = replace(design.models, elastic_twist=False)
    page = demo_html(replace(design, models=models), (-12.0,), (0.2,))
    data = record_of(page)
    assert_allclose(floats(data["points"][0][0]["flown"]), floats(data["jig"][0]), atol=1e-7)
    assert "jig" not in data["note"]


def test_it_requests_nothing_from_any_host(page: str):
    front = page[page.index('id="demo"') :]
    assert not re.search(r"https?://", front)
    assert not re.search(
        r"""(\ssrc=|<link[^>]*\shref=|url\(|@import\s)["']?(https?:)?//""", page[: page.index("<body>")]
    )


def test_a_design_that_does_not_trim_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    rotor.make_design(mass_kg=40_000).save(tmp_path / "heavy.json")
    assert main(["demo", str(tmp_path / "out.html"), "--design", str(tmp_path / "heavy.json")]) == 2
    assert "does not trim" in capsys.readouterr().err
    assert not (tmp_path / "out.html").exists()
