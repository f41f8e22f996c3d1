"""Flat pictures round the disk: the words and ticks outside its rim, and the airframe's shadow.

Each is a mask 0…255; its colour is given when it is encoded, so light and dark pages share the drawing.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageChops, ImageDraw, ImageFilter, ImageFont

from explorer.picture.airframe import Airframe
from explorer.picture.png import encode_png
from explorer.theme.colours import Rgb

Bytes = NDArray[np.uint8]

REACH = 1.2
"""Half the edge of the picture with the words, in radii."""
RING_SIZE = 1792
"""Its pixels along each edge."""
SHADOW_HALF, SHADOW_CENTRE = 1.72, 0.27
"""Half the edge of the shadow's picture and how far aft of the hub its middle lies, in radii."""
_SHADOW_SIZE = 384
_SHARP = 2
"""The words are drawn this many times as large and reduced: lines and arcs have no smooth edges of their own."""


def tinted_png(mask: Bytes, colour: Rgb, strength: float = 1.0) -> bytes:
    """A mask as a PNG of one colour, as opaque as the mask says."""
    entries = np.empty((256, 4), dtype=np.uint8)
    entries[:, :3] = colour
    entries[:, 3] = np.rint(strength * np.arange(256))
    return encode_png(mask, entries, effort=6)


@lru_cache(maxsize=1)
def ring_mask() -> Bytes:
    """Rim, azimuth ticks, sense of rotation and four words, shape (RING_SIZE, RING_SIZE). Row 0 is at the nose."""
    ring = _Ring(RING_SIZE * _SHARP)
    ring.circle(1.012, 0.0035, 150)
    for degrees in range(0, 360, 10):
        long, medium = degrees % 90 == 0, degrees % 30 == 0
        reach = 0.034 if long else 0.024 if medium else 0.013
        ring.tick(degrees, 1.024, 1.024 + reach, 0.0040 if long else 0.0027, 215 if long else 125)
    ring.word("NOSE", 180.0, 1.122, 0.084, outward=True)
    # Beside the boom, where neither the fin nor the stabilator hides it.
    ring.word("TAIL", 15.0, 1.122, 0.084, outward=False)
    ring.word("ADVANCING", 90.0, 1.122, 0.079, outward=False)
    ring.word("RETREATING", 270.0, 1.122, 0.079, outward=True)
    for degrees in (0, 90, 180, 270):
        ring.word(f"{degrees}°", degrees + 3.4, 1.051, 0.036, outward=degrees > 90, strength=185)
    ring.arrow(116.0, 146.0, 1.092, 0.0055, 195)
    return ring.reduced()


class _Ring:
    """A square picture in polar coordinates: radius in R, azimuth in degrees, nose up, advancing side right."""

    def __init__(self, size: int) -> None:
        self._size, self._unit = size, 0.5 * size / REACH
        self._image = Image.new("L", (size, size), 0)
        self._draw = ImageDraw.Draw(self._image)

    def circle(self, r: float, width: float, strength: int) -> None:
        self._draw.ellipse(self._box(r), outline=strength, width=self._pixels(width))

    def tick(self, degrees: float, first: float, last: float, width: float, strength: int) -> None:
        ends = [self._at(degrees, first), self._at(degrees, last)]
        self._draw.line(ends, fill=strength, width=self._pixels(width))

    def arrow(self, first: float, last: float, r: float, width: float, strength: int) -> None:
        """An arc with a head at its later end."""
        # Pillow counts clockwise from +x; the azimuth runs counter-clockwise from straight down.
        self._draw.arc(self._box(r), 90.0 - last, 90.0 - first, fill=strength, width=self._pixels(width))
        head = [self._at(last, r - 0.016), self._at(last, r + 0.016), self._at(last + 2.2, r)]
        self._draw.polygon(head, fill=strength)

    def word(self, text: str, degrees: float, r: float, height: float, outward: bool, strength: int = 245) -> None:
        """Letters along a circle, their heads `outward` or towards the hub."""
        font = ImageFont.load_default(self._pixels(height))
        gap = 0.13 * height
        widths = [font.getlength(letter) / self._unit + gap for letter in text]
        place = -0.5 * sum(widths)
        for letter, width in zip(text, widths, strict=True):
            sense = -1.0 if outward else 1.0
            at = degrees + sense * math.degrees((place + 0.5 * width) / r)
            place += width
            edge = self._pixels(1.8 * height)
            tile = Image.new("L", (edge, edge), 0)
            stroke = self._pixels(0.035 * height)
            middle = (0.5 * tile.width, 0.5 * tile.height)
            pen = ImageDraw.Draw(tile)
            pen.text(middle, letter, fill=strength, font=font, anchor="mm", stroke_width=stroke, stroke_fill=strength)
            tile = tile.rotate(at + (180.0 if outward else 0.0), Image.Resampling.BICUBIC)
            x, y = self._at(at, r)
            corner = (round(x - 0.5 * tile.width), round(y - 0.5 * tile.height))
            under = self._image.crop((*corner, corner[0] + tile.width, corner[1] + tile.height))
            self._image.paste(ImageChops.lighter(under, tile), corner)

    def reduced(self) -> Bytes:
        return np.asarray(self._image.reduce(_SHARP))

    def _at(self, degrees: float, r: float) -> tuple[float, float]:
        psi, middle = math.radians(degrees), 0.5 * self._size
        return middle + r * self._unit * math.sin(psi), middle + r * self._unit * math.cos(psi)

    def _box(self, r: float) -> tuple[float, float, float, float]:
        low, high = 0.5 * self._size - r * self._unit, 0.5 * self._size + r * self._unit
        return low, low, high, high

    def _pixels(self, length: float) -> int:
        return max(1, round(length * self._unit))


@lru_cache(maxsize=2)
def letter_mask(text: str) -> Bytes:
    """One large letter, shape (256, 256)."""
    tile = Image.new("L", (256, 256), 0)
    font = ImageFont.load_default(200)
    ImageDraw.Draw(tile).text((128, 128), text, fill=245, font=font, anchor="mm", stroke_width=5, stroke_fill=245)
    return np.asarray(tile)


@lru_cache(maxsize=4)
def shadow_mask(craft: Airframe, radius: float) -> Bytes:
    """The airframe's soft shadow on the ground, and a faint one of the disk, seen from above. Row 0 is ahead."""
    size, half = _SHADOW_SIZE, SHADOW_HALF * radius
    unit = 0.5 * size / half

    def place(points: NDArray[np.float64]) -> list[tuple[float, float]]:
        return [(0.5 * size + y * unit, 0.5 * size + (x - SHADOW_CENTRE * radius) * unit) for x, y in points]

    disk, body = Image.new("L", (size, size), 0), Image.new("L", (size, size), 0)
    (left, top), (right, bottom) = place(np.array([[-radius, -radius], [radius, radius]]))
    ImageDraw.Draw(disk).ellipse((left, top, right, bottom), fill=46)
    pen = ImageDraw.Draw(body)
    for triangle in craft.body.vertices[craft.body.faces][:, :, :2]:
        pen.polygon(place(triangle), fill=170)
    soft = ImageFilter.GaussianBlur(0.042 * size), ImageFilter.GaussianBlur(0.018 * size)
    return np.asarray(ImageChops.add(disk.filter(soft[0]), body.filter(soft[1])))
