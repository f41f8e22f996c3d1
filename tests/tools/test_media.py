"""The film's plan and its file, without a browser."""

import shutil
from collections import Counter
from pathlib import Path

import pytest
from PIL import Image

from tests.tools import media


@pytest.mark.parametrize("frames", [1, 7, 300, 1800])
def test_the_storyboard_has_every_frame(frames: int):
    assert len(list(media.storyboard(frames))) == frames


def test_acts_last_as_long_as_their_shares_say():
    counted = Counter((act.slider, act.key) for act in media.storyboard(44 * 50))
    assert counted["Adv. ratio", "ArrowRight"] == 6 * 50
    assert counted["Rate", "ArrowLeft"] == 5 * 50


@pytest.mark.parametrize("frames", [44, 1800])
def test_keys_and_buttons_do_not_depend_on_the_length(frames: int):
    story = list(media.storyboard(frames))
    pressed = [act.button for act in story if act.button]
    assert pressed == ["Optimise this blade", "Apply", "Explore", "Actuate", "Explore"]
    assert sum(act.presses for act in story if act.key == "ArrowRight") == 100 + 36
    assert sum(act.presses for act in story if act.key == "ArrowLeft") == 100 + 36


def test_frames_become_an_animation_of_their_length(tmp_path: Path):
    for k, colour in enumerate(("red", "green", "blue")):
        Image.new("RGB", (64, 48), colour).save(tmp_path / f"{k:05d}.png")
    media.encode(tmp_path, 10.0, tmp_path / "film.webp")
    with Image.open(tmp_path / "film.webp") as film:
        assert (film.format, film.size, getattr(film, "n_frames", 1)) == ("WEBP", (64, 48), 3)


def test_what_is_missing_is_said_before_the_first_frame(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert media.main(["film", str(tmp_path / "film.mp4")]) == 2
    assert "apt-get install ffmpeg" in capsys.readouterr().err
    assert media.main(["film", str(tmp_path / "film.txt")]) == 2
    assert "is not a film" in capsys.readouterr().err
    assert media.main(["film", str(tmp_path / "film.webp"), "--size", "800x600"]) == 2
    assert "has no sliders" in capsys.readouterr().err
    assert media.main(["poster", str(tmp_path / "poster.png"), "--size", "wide"]) == 2
    assert "is not a size" in capsys.readouterr().err
