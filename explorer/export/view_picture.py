"""The view of the page as a picture, with its line and the scale of its disk."""

import io
import json
import textwrap
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from PIL.PngImagePlugin import PngInfo

from explorer.colours import colour_map
from explorer.picture.fields import Field
from rotor import Solution
from rotor.support.chart import bar_ticks

Ink = tuple[int, int, int]
_NIGHT, _PALE = (17, 24, 36), (233, 238, 245)
_INK, _DIM, _OVERLAY = (24, 33, 47), (95, 107, 128), (141, 152, 170)
_SKY = (243, 246, 250), (25, 31, 41)
"""Behind the view of the page, light and dark."""
_STRIP = 112
"""[px] above the view of the page, and below it."""
_WIDTH = 500
"""[px] of the scale."""


def view_png(
    scene: NDArray[np.uint8], solution: Solution, scale: tuple[Field, tuple[float, float]] | None, dark: bool, line: str
) -> bytes:
    """What the page shows as a PNG: `scene` (rows, columns, 4), red to alpha of 0…255, between its `line` above it and
    below it the `scale` of its disk, a quantity with the ends of its colours; None: there is no disk. The file says the
    numbers of the design under `Design`."""
    rows, columns = scene.shape[:2]
    below = 0 if scale is None else _STRIP
    picture = Image.new("RGB", (columns, _STRIP + rows + below), _NIGHT if dark else "white")
    drawn = Image.fromarray(scene)
    picture.paste(_SKY[dark], (0, _STRIP, columns, _STRIP + rows))
    picture.paste(drawn, (0, _STRIP), drawn)
    draw = ImageDraw.Draw(picture)
    ink, dim = (_PALE, _OVERLAY) if dark else (_INK, _DIM)

    def write(x: float, y: float, words: str, height: float, colour: Ink, anchor: str = "ls") -> None:
        draw.text((x, y), words, colour, ImageFont.truetype(font_path(), height), anchor=anchor)

    rows_of_line = textwrap.wrap(line, max(columns // 14, 20))
    for k, words in enumerate(rows_of_line):
        write(40, 62 + 36 * (k - (len(rows_of_line) > 1)), words, 26, ink)
    if scale is not None:
        field, ends = scale
        x, y = columns // 2 - _WIDTH // 2, _STRIP + rows + 50
        colours = colour_map(field.colours, 256)[None, :, :3]
        picture.paste(Image.fromarray(colours).resize((_WIDTH, 12)), (x, y))
        for percent, words in bar_ticks(*ends):
            write(x + 0.01 * _WIDTH * float(percent), y + 30, words, 16, dim, "ms")
        write(x + _WIDTH // 2, y - 8, field.label, 18, ink, "ms")
    numbers = PngInfo()
    numbers.add_itxt("Design", json.dumps(solution.design.to_dict(), ensure_ascii=False))
    out = io.BytesIO()
    picture.save(out, "PNG", pnginfo=numbers)
    return out.getvalue()


@cache
def font_path() -> str:
    """A font with Greek letters, × and the minus, which that of Pillow lacks: what matplotlib brings, which is not
    imported for that, or one of the system. ValueError where there is none."""
    spec = find_spec("matplotlib")
    brought = () if spec is None else (str(Path(str(spec.origin)).parent / "mpl-data/fonts/ttf/DejaVuSans.ttf"),)
    for name in (*brought, "DejaVuSans.ttf", "LiberationSans-Regular.ttf", "Arial.ttf", "arial.ttf"):
        with suppress(OSError):
            return str(ImageFont.truetype(name).path)
    raise ValueError("No font for the words of a picture: install DejaVu Sans, or pip install matplotlib.")
