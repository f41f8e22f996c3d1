"""A picture for a slide: the scene, its line above, and below it the scale of its disk, its marks and its source."""

import io
import json
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from numpy import uint8
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from PIL.PngImagePlugin import PngInfo

from explorer.charts.svg import key_marks
from explorer.colours import colour_map
from explorer.export.provenance import PROGRAM, versions
from explorer.picture.camera_views import Covered
from explorer.picture.fields import Field
from rotor import Solution
from rotor.support.chart import bar_ticks

Ink = tuple[int, int, int]
_NIGHT, _PALE = (17, 24, 36), (233, 238, 245)
_INK, _DIM, _OVERLAY = (24, 33, 47), (95, 107, 128), (141, 152, 170)
HEIGHT = 1080
"""[px]"""
SHAPES = {"16:9": 1920, "4:3": 1440}
"""Widths [px] by name."""
CARDS = Covered(140 / HEIGHT, 118 / HEIGHT)
"""What the line above the scene and the key below it cover."""
_EDGE, _WIDTH = 40, 420
"""[px] of the margin, and of the scale."""
_SWATCH, _DASH_UNIT = 34, 34 / 14
"""[px] of an outline in the key, and of the unit of `KeyMark.dashes`."""
Label = tuple[str, float, float]
"""Words, and where they stand: fractions of the width from the left and of the height from above."""


def view_png(
    scene: NDArray[uint8],
    solution: Solution,
    scale: tuple[Field, tuple[float, float]] | None,
    line: str,
    dark: bool,
    labels: Sequence[Label] = (),
    transparent: bool = False,
) -> bytes:
    """A picture for a slide as a PNG of the size of `scene` (rows, columns, 4), red to alpha of 0…255.

    Above: `line`. Below: the marks of the disk, its `scale` (a quantity with the ends of its colours;
    None: no disk is in sight) and the source. The file says the numbers of the design under `Design`.
    """
    rows, columns = scene.shape[:2]
    ground = (0, 0, 0, 0) if transparent else (*(_NIGHT if dark else (255, 255, 255)), 255)
    picture = Image.new("RGBA", (columns, rows), ground)
    picture.alpha_composite(Image.fromarray(scene))
    draw = ImageDraw.Draw(picture)
    ink, dim = (_PALE, _OVERLAY) if dark else (_INK, _DIM)

    def write(
        x: float, y: float, words: str, height: float, colour: Ink, anchor: str = "ls"
    ) -> None:
        draw.text((x, y), words, colour, ImageFont.truetype(font_path(), height), anchor=anchor)

    lines, height = headline(line, columns - 2 * _EDGE)
    for k, words in enumerate(lines):
        write(_EDGE, 64 + k * 1.2 * height, words, height, ink)
    font = ImageFont.truetype(font_path(), 24)
    for words, x, y in labels:
        half = font.getlength(words) / 2 + 8
        x = min(max(x * columns, half + 8), columns - half - 8)
        draw.rounded_rectangle(
            (x - half, y * rows - 17, x + half, y * rows + 17), 6, (*ground[:3], 225)
        )
        write(x, y * rows, words, 24, ink, "mm")
    below = rows - 48
    source = f"{PROGRAM} {versions()[PROGRAM].partition(' ')[0]}, a model, not a measurement"
    write(columns - _EDGE, below + 28, source, 20, dim, "rs")
    if scale is not None:
        field, ends = scale
        colours = colour_map(field.colours, 256)[None, :, :3]
        picture.paste(Image.fromarray(colours).resize((_WIDTH, 14)), (_EDGE, below - 14))
        write(_EDGE, below - 24, field.label, 24, ink)
        for percent, words in bar_ticks(*ends):
            write(_EDGE + 0.01 * _WIDTH * float(percent), below + 28, words, 22, dim, "ms")
        right = columns - _EDGE
        for mark in reversed(key_marks(solution)):
            write(right, below - 24, mark.title, 24, ink, "rs")
            right -= round(font.getlength(mark.title)) + 12
            length, gap = mark.dashes or (_SWATCH / _DASH_UNIT, 0.0)
            for k in range(round(_SWATCH / _DASH_UNIT / (length + gap))):
                left = right - _SWATCH + _DASH_UNIT * k * (length + gap)
                draw.line(
                    (left, below - 32, left + _DASH_UNIT * length, below - 32), mark.colour, 5
                )
            right -= 64
    numbers = PngInfo()
    numbers.add_itxt("Design", json.dumps(solution.design.to_dict(), ensure_ascii=False))
    out = io.BytesIO()
    picture.save(out, "PNG", pnginfo=numbers)
    return out.getvalue()


def headline(line: str, room: float) -> tuple[list[str], int]:
    """At most two lines within `room` [px], about as long as each other, so that none is but a unit; their height."""
    height = 38
    while len(lines := _wrapped(line, height, room)) > 2:
        height -= 2
    while room > 20 and len(even := _wrapped(line, height, room)) == len(lines):
        lines, room = even, room - 20
    return lines, height


def _wrapped(words: str, height: float, room: float) -> list[str]:
    """As few lines as stay within `room` [px] at this height of type."""
    font, lines = ImageFont.truetype(font_path(), height), [""]
    for word in words.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if font.getlength(longer) > room and lines[-1]:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


@cache
def font_path() -> str:
    """A font with Greek letters, × and the minus, which that of Pillow lacks: what matplotlib brings, which is not
    imported for that, or one of the system. ValueError where there is none."""
    spec = find_spec("matplotlib")
    brought = (
        ()
        if spec is None
        else (str(Path(str(spec.origin)).parent / "mpl-data/fonts/ttf/DejaVuSans.ttf"),)
    )
    for name in (
        *brought,
        "DejaVuSans.ttf",
        "LiberationSans-Regular.ttf",
        "Arial.ttf",
        "arial.ttf",
    ):
        with suppress(OSError):
            return str(ImageFont.truetype(name).path)
    raise ValueError(
        "No font for the words of a picture: install DejaVu Sans, or pip install matplotlib."
    )
