"""Pictures of a design: one to be shared, of the size that pages show beside a link, with blade, disk, two numbers and
title; and the view of the page with title and scale."""

import io
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache, partial
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from explorer.colours import colour_map
from explorer.model.units import Units
from explorer.picture.blade_mesh import blade_shape, blade_vertices
from explorer.picture.fields import Field
from explorer.picture.picture import disk_png
from explorer.picture.polar import ALL_MARKS
from explorer.text.design_words import flight_words, title_words
from explorer.text.readout import fineness
from rotor import Solution
from rotor.arrays import Array
from rotor.chart import bar_ticks
from rotor.design import TwistLaw

SIZE = 1200, 630
_TIMES = 4.0
"""Times its twist relative to that at 0.75 R that the blade is drawn with."""
_WIDER = 2.0
"""Times its chord that it is drawn with, so that the twist is seen."""
_FINER = 2
"""Pixels drawn for one that is kept, each way."""
Ink = tuple[int, int, int]
_NIGHT, _PALE = (17, 24, 36), (233, 238, 245)
_INK, _DIM, _GHOST = (24, 33, 47), (95, 107, 128), (141, 152, 170)
_BLADE, _GOOD, _BAD = (220, 63, 38), (6, 112, 79), (188, 64, 11)
_SKY = (243, 246, 250), (25, 31, 41)
"""Behind the view of the page, light and dark."""
_STRIP = 112
"""[px] above the view of the page, and below it."""


def card_png(
    solution: Solution,
    against: Solution,
    name: str,
    field: Field,
    colour_range: tuple[float, float],
    units: Units,
    lines: Sequence[str] = (),
) -> bytes:
    """The picture as a PNG. `against`: the design compared with, its name `name`; its blade is drawn grey. `lines`:
    what else it says, two at most."""
    picture = Image.new("RGB", (_FINER * SIZE[0], _FINER * SIZE[1]), "white")
    draw = ImageDraw.Draw(picture)
    write = partial(_write, draw, _FINER)
    design = solution.design
    write(48, 78, title_words(design), 34)
    write(48, 116, flight_words(design, units), 22, _DIM)
    power, other = solution.power.total, against.power.total
    write(48, 226, units.watts(power, fineness(solution.power)), 84)
    change = 100.0 * (power / other - 1.0)
    ink = _DIM if abs(change) < 0.05 else _GOOD if change < 0.0 else _BAD
    write(48, 300, f"{change:+.1f} %".replace("-", "−"), 52, ink)
    write(48, 334, f"power against {name}", 22, _DIM)
    for k, words in enumerate(lines):
        write(48, 367 + 28 * k, words, 20, _DIM)
    png = disk_png(solution, field, colour_range, size=_FINER * 400, marks=ALL_MARKS)
    disk = Image.open(io.BytesIO(png)).convert("RGBA")
    picture.paste(disk, (_FINER * 770, _FINER * 20), disk)
    write(970, 436, "tail", 16, _DIM, "ms")
    _scale(picture, write, (820, 470), 300, field, colour_range, times=_FINER)
    for law, grey in ((against.design.twist, True), (design.twist, False)):
        _draw_blade(draw, solution, law, grey)
    write(48, 606, f"Twist × {_TIMES:g}, chord × {_WIDER:g}; grey: {name}", 16, _DIM)
    out = io.BytesIO()
    picture.resize(SIZE, Image.Resampling.LANCZOS).save(out, "PNG", optimize=True)
    return out.getvalue()


def view_png(
    scene: NDArray[np.uint8],
    solution: Solution,
    scale: tuple[Field, tuple[float, float]] | None,
    units: Units,
    dark: bool,
) -> bytes:
    """What the page shows as a PNG: `scene` (rows, columns, 4), red to alpha of 0…255, between title, flight and power
    above it and below it the `scale` of its disk, a quantity with the ends of its colours; None: there is no disk."""
    rows, columns = scene.shape[:2]
    below = 0 if scale is None else _STRIP
    picture = Image.new("RGB", (columns, _STRIP + rows + below), _NIGHT if dark else "white")
    drawn = Image.fromarray(scene)
    picture.paste(_SKY[dark], (0, _STRIP, columns, _STRIP + rows))
    picture.paste(drawn, (0, _STRIP), drawn)
    write = partial(_write, ImageDraw.Draw(picture), 1)
    ink, dim = (_PALE, _GHOST) if dark else (_INK, _DIM)
    write(40, 52, title_words(solution.design), 32, ink)
    write(40, 90, flight_words(solution.design, units), 22, dim)
    write(columns - 40, 72, units.watts(solution.power.total, fineness(solution.power)), 52, ink, "rs")
    if scale is not None:
        _scale(picture, write, (columns // 2 - 250, _STRIP + rows + 50), 500, *scale, ink, dim)
    out = io.BytesIO()
    picture.save(out, "PNG")
    return out.getvalue()


def _write(
    draw: ImageDraw.ImageDraw, times: int, x: float, y: float, words: str, height: float, ink: Ink = _INK,
    anchor: str = "ls",
) -> None:  # fmt: skip
    """Words at a place, in pixels of which `times` are drawn for one that is kept."""
    draw.text((times * x, times * y), words, ink, ImageFont.truetype(font_path(), times * height), anchor=anchor)


def _scale(
    picture: Image.Image, write: Callable[..., None], place: tuple[int, int], width: int, field: Field,
    colour_range: tuple[float, float], ink: Ink = _INK, dim: Ink = _DIM, times: int = 1,
) -> None:  # fmt: skip
    """A field's colours from a place to the right, its name above and numbers below."""
    (x, y), colours = place, colour_map(field.colours, 256)[None, :, :3]
    picture.paste(Image.fromarray(colours).resize((times * width, times * 12)), (times * x, times * y))
    for percent, words in bar_ticks(*colour_range):
        write(x + 0.01 * width * float(percent), y + 30, words, 16, dim, "ms")
    write(x + width // 2, y - 8, field.label, 18, ink, "ms")


@cache
def font_path() -> str:
    """A font with Greek letters, × and the minus, which that of Pillow lacks: what matplotlib brings, which is not
    imported for that, or one of the system. ValueError where there is none."""
    spec = find_spec("matplotlib")
    brought = () if spec is None else (str(Path(str(spec.origin)).parent / "mpl-data/fonts/ttf/DejaVuSans.ttf"),)
    for name in (*brought, "DejaVuSans.ttf", "LiberationSans-Regular.ttf", "Arial.ttf", "arial.ttf"):
        with suppress(OSError):
            return str(ImageFont.truetype(name).path)
    raise ValueError("No font for the words of a picture: install DejaVu Sans, or pip install 'rotor-explorer[plot]'.")


def _draw_blade(draw: ImageDraw.ImageDraw, solution: Solution, law: TwistLaw, grey: bool) -> None:
    """One blade as seen from above its tip path, ahead of the leading edge; the faces behind first."""
    shape = blade_shape(solution.design.rotor)
    points = blade_vertices(shape, law, _TIMES)
    x, y, z = points.T
    scale = _FINER * 660.0 / (x.max() - x.min())
    flat = np.stack(
        (_FINER * 60.0 + scale * (x - x.min()), _FINER * 470.0 - _WIDER * scale * (0.9 * z - 0.45 * y)), axis=1
    )
    faces: Array = points[shape.faces]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    light = np.abs(normals @ (0.2, 0.4, 0.9)) / np.where(lengths > 0.0, lengths, 1.0)
    for k in np.argsort(faces[:, :, 2].mean(axis=1) * 0.45 + faces[:, :, 1].mean(axis=1) * 0.9):
        shade = tuple(int((0.55 + 0.45 * light[k]) * part) for part in (_GHOST if grey else _BLADE))
        draw.polygon([tuple(corner) for corner in flat[shape.faces[k]]], fill=shade)
