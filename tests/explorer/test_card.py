"""The picture to be shared: its size, and that it shows the design."""

import io
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image, ImageFont

from explorer.export.card import SIZE, card_png, font_path, view_png
from explorer.model.units import SI
from explorer.picture.fields import FIELDS
from rotor import Solution, make_design, solve

FIELD = FIELDS["Angle of attack"]


def card(solution: Solution, against: Solution, *lines: str) -> Image.Image:
    return Image.open(io.BytesIO(card_png(solution, against, "as built", FIELD, (-4.0, 14.0), SI, lines)))


def test_shows_disk_blade_and_change():
    built, washed = solve(make_design(mu=0.3)), solve(make_design(mu=0.3, twist="linear:-14"))
    picture, same = card(washed, built), card(built, built)
    assert picture.size == SIZE == (1200, 630)
    pixels, without = (np.asarray(one.convert("RGB")).astype(int) for one in (picture, same))
    # The change is green where power falls, and grey where there is none.
    change, none = (one[255:305, 40:300] for one in (pixels, without))
    assert (change[..., 1] - change[..., 0] > 60).any()
    assert not (none[..., 1] - none[..., 0] > 60).any()
    # A blade across the lower left, and the colours of the disk right of it.
    red = pixels[400:560, 48:740, 0] - pixels[400:560, 48:740, 2] > 80
    assert np.ptp(np.nonzero(red.any(axis=0))[0]) > 600
    assert len(np.unique(pixels[100:400, 790:1150].reshape(-1, 3), axis=0)) > 200
    # Nothing touches the edges.
    assert (pixels[[0, -1]] == 255).all()
    assert (pixels[:, [0, -1]] == 255).all()


def test_without_matplotlib_the_system_has_a_font(monkeypatch: pytest.MonkeyPatch):
    """A base installation: the font is found by its name, and where there is none, a sentence says so."""
    real, asked = ImageFont.truetype, []

    def truetype(name: str, *more: float) -> SimpleNamespace:
        asked.append(name)
        if name != "Arial.ttf":
            raise OSError(name)
        return SimpleNamespace(path="/fonts/Arial.ttf")

    monkeypatch.setattr("explorer.export.card.find_spec", lambda _: None)
    monkeypatch.setattr(ImageFont, "truetype", truetype)
    assert font_path.__wrapped__() == "/fonts/Arial.ttf"
    monkeypatch.setattr(ImageFont, "truetype", lambda *_: real("no such font"))
    with pytest.raises(ValueError, match="install DejaVu Sans, or pip install"):
        font_path.__wrapped__()
    assert asked[0] == "DejaVuSans.ttf"


def test_further_lines_stand_between_power_and_blade():
    """The longest that a page says: it does not reach the disk, and the second does not reach the blade."""
    built = solve(make_design(mu=0.3))
    supposed = "actuator of 12.3° for 1200 kg needs 1234 kW more (± 123 kW: likely)"
    plain, told = (
        np.asarray(card(built, built, *lines).convert("RGB")).astype(int)
        for lines in ((), ("optimiser 1,234 kW", supposed))
    )
    rows, columns = np.nonzero((plain != told).any(axis=-1))
    assert 340 < rows.min() < rows.max() < 408
    assert 40 < columns.min() < columns.max() < 770


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
