"""The picture of the view: the font of its words."""

from types import SimpleNamespace

import pytest
from PIL import ImageFont

from explorer.export.view_picture import font_path


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
