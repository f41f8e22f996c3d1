"""One turn with a section as a moving picture for a slide: the scene, the horizon, and α against stall as a bar."""

import io
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from explorer.colours import scene_theme
from explorer.export.view_picture import font_path
from explorer.model.units import number
from explorer.parts.stage import RidePart
from explorer.picture.camera_views import RIDE_VIEW, Camera, camera_axes
from explorer.picture.element import FlowRegion

WIDTH, HEIGHT = 960, 540
"""[px]"""
FRAME_MS = 80
"""Of each picture."""
_STRIP = 84
"""[px] below the scene, for words and bar."""
_LIGHT = (
    (252, 253, 255),
    (205, 221, 246),
    (190, 198, 210),
    (228, 233, 240),
    (24, 33, 47),
    (224, 62, 40),
)
_DARK = ((17, 24, 36), (38, 56, 92), (44, 52, 66), (24, 31, 43), (233, 238, 245), (255, 107, 84))
"""Sky above and at the horizon, ground there and below, ink, and the bar."""


def horizon(camera: Camera) -> float:
    """How far below the upper edge of the film the horizon is, over its height; it may lie outside 0…1."""
    rise = float(camera_axes(camera)[2][2])
    return 0.5 + 0.5 * math.tan(math.asin(rise)) / math.tan(0.5 * RIDE_VIEW)


def gif(
    frames: Sequence[NDArray[np.uint8]],
    ride: RidePart,
    azimuths: Sequence[int],
    horizons: Sequence[float],
    dark: bool,
) -> bytes:
    """A GIF that repeats, a frame for each of `azimuths` (columns of `ride`), from scenes (HEIGHT, WIDTH, 4)."""
    drawn = [_frame(*each, ride, dark) for each in zip(frames, azimuths, horizons, strict=True)]
    first, *rest = (
        one.quantize(128, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE) for one in drawn
    )
    out = io.BytesIO()
    first.save(out, "GIF", save_all=True, append_images=rest, duration=FRAME_MS, loop=0, disposal=1)
    return out.getvalue()


def _frame(
    scene: NDArray[np.uint8], k: int, horizon: float, ride: RidePart, dark: bool
) -> Image.Image:
    above, at, below, low, ink, bar = _DARK if dark else _LIGHT
    rows = (np.arange(HEIGHT) / HEIGHT)[:, None, None]
    sky, end = np.clip(rows / max(horizon, 1e-3), 0.0, 1.0), max(1.0 - horizon, 1e-3)
    ground = np.clip((rows - horizon) / end, 0.0, 1.0)
    mixed = np.where(
        rows < horizon,
        above + sky * np.subtract(at, above),
        below + ground * np.subtract(low, below),
    )
    picture = Image.fromarray(np.broadcast_to(mixed, (HEIGHT, WIDTH, 3)).astype(np.uint8)).convert(
        "RGBA"
    )
    picture.alpha_composite(Image.fromarray(scene))
    draw = ImageDraw.Draw(picture)
    draw.rectangle((0, HEIGHT - _STRIP, WIDTH, HEIGHT), above)
    region, filled = ride.region[k], ride.filled[k]
    stalls, colour = region == FlowRegion.STALLED.value, scene_theme(dark).ink.stall
    psi = number(360.0 * k / len(ride.region))
    font = ImageFont.truetype(font_path(), 24)
    draw.text((28, HEIGHT - 50), f"{ride.r:.2f} R · ψ {psi}°", ink, font, anchor="ls")
    words = region if ride.u[k] < 0.0 else f"α {number(ride.alpha[k], 1)}°"
    if filled is not None:
        words += " · stalled" if stalls else f" · {ride.margin[k]}° to stall"
    draw.text((WIDTH - 28, HEIGHT - 50), words, colour if stalls else ink, font, anchor="rs")
    left, right, top, foot = 28, WIDTH - 28, HEIGHT - 36, HEIGHT - 16
    draw.rounded_rectangle((left, top, right, foot), 6, low)
    if filled:
        end = left + min(filled, 1.0) * (right - left)
        draw.rounded_rectangle((left, top, max(end, left + 12), foot), 6, colour if stalls else bar)
    draw.line((right, top - 4, right, foot + 4), colour, 4)
    return picture.convert("RGB")
