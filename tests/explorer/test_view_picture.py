"""The picture of the view: the scene between title and scale."""

import io
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image, ImageFont

from explorer.export.view_picture import font_path, view_png
from explorer.model.units import SI
from explorer.picture.fields import FIELDS
from rotor import make_design, solve

FIELD = FIELDS["Angle of attack"]


def test_without_matplotlib_the_system_has_a_font(monkeypatch: pytest.MonkeyPatch):
    """A base installation: the font is found by its name, and where there is none, a sentence says so."""
    real, asked = ImageFont.truetype, []

    def truetype(name: str, *more: float) -> SimpleNamespace:
        asked.append(name)
        if name != "Arial.ttf":
            raise OSError(name)
        return SimpleNamespace(path="/fonts/Arial.ttf")

    monkeypatch.setattr("explorer.export.view_picture.find_spec", lambda _: None)
    monkeypatch.setattr(ImageFont, "truetype", truetype)
    assert font_path.__wrapped__() == "/fonts/Arial.ttf"
    monkeypatch.setattr(ImageFont, "truetype", lambda *_: real("no such font"))
    with pytest.raises(ValueError, match="install DejaVu Sans, or pip install"):
        font_path.__wrapped__()
    assert asked[0] == "DejaVuSans.ttf"


def test_the_view_stands_between_title_and_scale():
    """The scene is in it as it was; a stage without the disk has no scale."""
    solution, scene = solve(make_design(mu=0.3)), np.random.default_rng(1).integers(0, 255, (400, 1920, 4), np.uint8)
    scene[..., 3] = 255
    scene[:100, :, 3] = 0  # The sky.
    for scale, dark, paper in (((FIELD, (-4.0, 14.0)), False, 255), (None, True, 17)):
        png = view_png(scene, solution, scale, SI, dark)
        pixels = np.asarray(Image.open(io.BytesIO(png))).astype(int)
        below = pixels[512:]
        assert np.array_equal(pixels[212:512], scene[100:, :, :3])
        assert np.ptp(pixels[112:212], axis=(0, 1)).max() == 0
        assert pixels[0, 0, 0] == paper
        assert len(below) == (0 if scale is None else 112)
        assert len(np.unique(below.reshape(-1, 3), axis=0)) > 200 or scale is None
        # Words left and right above it, and nothing at the edges.
        inked = np.nonzero((pixels[:112] != pixels[0, 0]).any(axis=(0, 2)))[0]
        assert 40 <= inked.min() < 300
        assert 1600 < inked.max() <= 1880
