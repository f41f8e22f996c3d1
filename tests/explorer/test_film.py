"""One turn with a section as a GIF: as many pictures as the turn has points, a bar that fills, the horizon in sight."""

import io
import math

import numpy as np
import pytest
from PIL import Image

from explorer.export import film
from explorer.picture.camera_views import RIDE_VIEW, riding, seen_at
from explorer.picture.element import AZIMUTHS, turn_of
from rotor import make_design, solve

SOLUTION = solve(
    make_design(mu=0.35, mass_kg=9500.0, elements=12, azimuths=24, inflow="pitt-peters")
)
TURN = turn_of(SOLUTION, 0.8, 0.0)
CAMERAS = [riding(SOLUTION, TURN.out, 2.0 * math.pi * k / AZIMUTHS) for k in range(AZIMUTHS)]


def test_disk_section_and_horizon_stay_in_sight():
    aspect, tilt = film.WIDTH / film.HEIGHT, SOLUTION.controls.shaft_tilt
    for k, camera in enumerate(CAMERAS):
        assert 0.02 < film.horizon(camera) < 0.35
        # Level with the eye.
        far = camera.position + 1e6 * np.array([*(camera.look_at - camera.position)[:2], 0.0])
        assert seen_at(camera, far[None], aspect, RIDE_VIEW)[0, 1] == pytest.approx(
            film.horizon(camera), abs=1e-4
        )
        psi = 2.0 * math.pi * k / AZIMUTHS
        x, y = TURN.out * math.cos(psi), TURN.out * math.sin(psi)
        # Of a blade that does not flap.
        section = np.array([[x * math.cos(tilt), y, x * math.sin(tilt)]])
        across, down = seen_at(camera, section, aspect, RIDE_VIEW)[0]
        assert 0.3 < across < 0.7
        assert film.horizon(camera) < down < 0.8


@pytest.mark.parametrize("dark", [False, True])
def test_the_clip_has_a_picture_for_each_point_of_the_turn_and_its_bar_fills(dark: bool):
    order = [(5 + k) % AZIMUTHS for k in range(AZIMUTHS)]
    scenes = np.zeros((AZIMUTHS, film.HEIGHT, film.WIDTH, 4), dtype=np.uint8)
    clip = film.gif(list(scenes), TURN, order, [film.horizon(CAMERAS[k]) for k in order], dark)
    shown = Image.open(io.BytesIO(clip))
    assert (shown.format, getattr(shown, "n_frames", 1), shown.size) == (
        "GIF",
        AZIMUTHS,
        (film.WIDTH, film.HEIGHT),
    )
    lengths, wanted = [], []
    for place, k in enumerate(order):
        shown.seek(place)
        assert shown.info["duration"] == film.FRAME_MS
        row = np.asarray(shown.convert("RGB"), dtype=int)[film.HEIGHT - 26, 40 : film.WIDTH - 40]
        lengths.append(
            np.mean(np.abs(row - row[-1]).sum(axis=1) > 60)
            if (TURN.filled[k] or 0.0) < 0.9
            else math.nan
        )
        wanted.append(TURN.filled[k] or 0.0)
    seen = np.isfinite(lengths)
    assert seen.sum() > AZIMUTHS // 2
    assert np.abs(np.array(lengths)[seen] - np.array(wanted)[seen]).max() < 0.03
