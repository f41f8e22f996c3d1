"""Flat pictures of the disk as small PNGs: its field with marked regions, words and ticks outside its rim, the shadow.

The words and the shadow are masks 0…255, coloured when they are encoded: light and dark pages share the drawing.
"""

import math
import struct
import zlib
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageChops, ImageDraw, ImageFilter, ImageFont

from explorer.colours import VOID, DiskInk, Rgb, Scheme, colour_map
from explorer.picture.airframe import Airframe
from explorer.picture.polar import Bytes, MarkedRegion, Places, PolarGrid
from rotor import Design
from rotor.support.arrays import Array
from rotor.support.compiled import compiled

_compile = compiled(error_model="numpy", fastmath={"contract"})

Sides = tuple[str, str, str, str]
"""Words about the disk at ψ = 0°, 90°, 180° and 270°; empty: none there."""
SIZE = 512
"""Pixels along each edge of a picture for export, where nothing else is asked for."""
LARGEST = 2400
"""Pixels along each edge of any picture: enough for the height of a 4K screen."""

# Layout of the 256 palette entries.
_CLEAR = 0
_LEVELS = 112
_HATCHED = _LEVELS
"""Added to the entry of a colour: the same under a stripe."""
_VOID, _REVERSE, _REVERSE_RIM, _DASH, _SEPARATED_RIM = range(1 + 2 * _LEVELS, 6 + 2 * _LEVELS)
_FIRST_EDGE = _SEPARATED_RIM + 1
_EDGE_COLOURS = 7
_EDGE_ALPHAS = (0.25, 0.5, 0.75)
_STRIPES = 26.0
"""Stripes of the hatch per radius."""
_STRIPE_SHARE = 0.36
_REGION_ENTRIES = np.array([0, 0, _SEPARATED_RIM, _DASH, _REVERSE, _REVERSE_RIM], dtype=np.uint8)
"""By `MarkedRegion`; 0 for those that keep the colour of the field."""
REACH = 1.2
"""Half the edge of the picture with the words, in radii."""
RING_SIZE = 1792
"""Pixels of the ring's image along each edge."""
SHADOW_HALF, SHADOW_CENTRE = 1.72, 0.27
"""Half the edge of the shadow's picture and how far aft of the hub its middle lies, in radii."""
_SHADOW_SIZE = 384
_OVERSAMPLING = 2
"""The words are drawn this many times as large and reduced: lines and arcs have no smooth edges of their own."""


@dataclass(frozen=True, eq=False)
class PixelGrid:
    """Where each pixel looks on the polar grid. Row 0 is at the nose (ψ = 180°), columns run to starboard."""

    index: Places
    """Flat polar index of each covered pixel, shape (covered,)."""
    covered: Places
    """Flat pixel index of each covered pixel."""
    kind: NDArray[np.uint16]
    """Row of the table that turns polar codes into palette entries, times 256: inside, under a stripe, or an edge pixel
    a quarter to three quarters covered."""


def half_width(radius: float, size: int = SIZE) -> float:
    """Half the edge of the square the picture fills [m]: the disk plus a pixel all round."""
    return radius * size / (size - 2)


def grid_size(size: int) -> tuple[int, int]:
    """Radii and azimuths of the polar grid behind a picture of `size` pixels: about one pixel each."""
    return round(0.34 * size), round(1.5 * size)


def _raster(inner: float, size: int, radii: int, azimuths: int) -> PixelGrid:
    """`inner`: root cut-out y/R; the polar grid has `radii` × `azimuths` points."""
    coordinate = (2.0 * (np.arange(size) + 0.5) / size - 1.0) * size / (size - 2)
    starboard, aft = np.meshgrid(coordinate, coordinate)
    r = np.hypot(aft, starboard)
    pixel = 2.0 / (size - 2)
    coverage = np.clip((1.0 - r) / pixel + 0.5, 0.0, 1.0) * np.clip(
        (r - inner) / pixel + 0.5, 0.0, 1.0
    )
    quarters = np.rint(4.0 * coverage).astype(np.uint16).ravel()
    covered = np.flatnonzero(quarters)
    row = np.clip(np.rint((r - inner) / (1.0 - inner) * (radii - 1)), 0, radii - 1).astype(np.intp)
    column = (
        np.rint(np.arctan2(starboard, aft) / (2.0 * np.pi) * azimuths).astype(np.intp) % azimuths
    )
    stripe = (((aft - starboard) * _STRIPES) % 1.0 < _STRIPE_SHARE).ravel()[covered]
    level = quarters[covered]
    kind = np.where(level == 4, np.where(stripe, 1, 0), 1 + level).astype(np.uint16)
    index = (row * azimuths + column).ravel()[covered]
    return PixelGrid(index.astype(np.int32), covered.astype(np.int32), kind * np.uint16(256))


@lru_cache(maxsize=1)
def _entries() -> Bytes:
    """Palette entry of each polar code for each kind of pixel, flat, shape (5 × 256,)."""
    code = np.arange(256)
    plain = np.where((code > _HATCHED) & (code <= 2 * _LEVELS), code - _HATCHED, code)
    hatched = code.copy()
    colour = np.clip(plain - 1, 0, _LEVELS - 1) * (_EDGE_COLOURS - 1) // (_LEVELS - 1)
    edges = [_FIRST_EDGE + 3 * colour + step for step in range(3)]
    return np.concatenate((plain, hatched, *edges)).astype(np.uint8)


def indices(
    grid: PolarGrid,
    values: Array,
    low: float,
    high: float,
    void: NDArray[np.bool_] | None = None,
    size: int = SIZE,
    regions: Bytes | None = None,
) -> Bytes:
    """Palette index of each pixel, shape (size, size), of polar `values` over the range `low`…`high`.

    `regions`: a `MarkedRegion` for each polar point, drawn over the colours.
    """
    raster = _raster(float(grid.r[0]), size, *values.shape)
    codes = levels_of(np.ascontiguousarray(values), low, high, _LEVELS)
    if void is not None:
        np.copyto(codes, _VOID, where=void)
    if regions is not None:
        codes += ((regions == MarkedRegion.SEPARATED) & (codes <= _LEVELS)) * np.uint8(_HATCHED)
        np.copyto(codes, _REGION_ENTRIES.take(regions), where=regions > MarkedRegion.SEPARATED)
    image: Bytes = paint(codes, raster.index, raster.covered, raster.kind, _entries(), size * size)
    return image.reshape(size, size)


@_compile
def levels_of(values: Array, low: float, high: float, levels: int) -> Bytes:
    """1…levels for values from `low` to `high` and beyond them."""
    image = np.empty(values.shape, np.uint8)
    scale, most = (levels - 1) / (high - low), levels - 1.0
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            image[i, j] = np.uint8(min(max((values[i, j] - low) * scale, 0.0), most) + 1.5)
    return image


@_compile
def paint(
    codes: Bytes,
    index: Places,
    covered: Places,
    kind: NDArray[np.uint16],
    entries: Bytes,
    pixels: int,
) -> Bytes:
    """A picture of so many pixels: `covered` ones get the entry of their kind for the code at their index."""
    image, flat = np.zeros(pixels, np.uint8), codes.ravel()
    for k in range(len(covered)):
        image[covered[k]] = entries[kind[k] + flat[index[k]]]
    return image


@lru_cache(maxsize=8)
def palette(scheme: Scheme, ink: DiskInk | None) -> Bytes:
    """The 256 RGBA entries, shape (256, 4), kept; `ink`: colours of the marked regions, and the disk's opacity."""
    ink = ink or DiskInk()
    colours = colour_map(scheme, _LEVELS)
    entries = np.zeros((256, 4), dtype=np.uint8)
    entries[_CLEAR, :3] = VOID
    entries[1 : 1 + _LEVELS, :3] = colours
    entries[1 : 1 + _LEVELS, 3] = round(255 * ink.opacity)
    stripe = np.array(ink.stall, dtype=np.float64)
    entries[1 + _HATCHED : 1 + _HATCHED + _LEVELS, :3] = (0.2 * colours + 0.8 * stripe).astype(
        np.uint8
    )
    entries[1 + _HATCHED : 1 + _HATCHED + _LEVELS, 3] = 250
    entries[_VOID] = (*VOID, round(255 * ink.opacity))
    entries[_REVERSE] = (*ink.reverse_flow, 238)
    entries[_REVERSE_RIM] = (*ink.reverse_flow_rim, 255)
    entries[_DASH] = (*ink.drag_divergence, 255)
    entries[_SEPARATED_RIM] = (*ink.stall, 255)
    for colour in range(_EDGE_COLOURS):
        source = colours[colour * (_LEVELS - 1) // (_EDGE_COLOURS - 1)]
        for step, share in enumerate(_EDGE_ALPHAS):
            entries[_FIRST_EDGE + 3 * colour + step] = (*source, round(255 * share * ink.opacity))
    entries.flags.writeable = False
    return entries


def encode_png(pixels: Bytes, entries: Bytes, effort: int = 1) -> bytes:
    """A palette PNG: `pixels` of shape (rows, columns), `entries` RGBA of shape (256, 4), `effort` of zlib 0…9.

    A quarter of the size and a tenth of the time of a true-colour PNG. Pillow would take half as long again,
    and hold the interpreter lock while it packs.
    """
    rows, columns = pixels.shape
    lines = np.zeros((rows, columns + 1), dtype=np.uint8)  # Each begins with its filter: none.
    lines[:, 1:] = pixels
    return b"".join(
        (
            b"\x89PNG\r\n\x1a\n",
            _chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 3, 0, 0, 0)),
            _chunk(b"PLTE", entries[:, :3].tobytes()),
            _chunk(b"tRNS", entries[:, 3].tobytes()),
            _chunk(b"IDAT", zlib.compress(lines.tobytes(), effort)),
            _chunk(b"IEND", b""),
        )
    )


def _chunk(kind: bytes, content: bytes) -> bytes:
    """Length, kind, content and check sum."""
    return (
        struct.pack(">I", len(content))
        + kind
        + content
        + struct.pack(">I", zlib.crc32(content, zlib.crc32(kind)))
    )


def tinted_png(mask: Bytes, colour: Rgb, strength: float = 1.0) -> bytes:
    """A mask as a PNG of one colour, as opaque as the mask says."""
    entries = np.empty((256, 4), dtype=np.uint8)
    entries[:, :3] = colour
    entries[:, 3] = np.rint(strength * np.arange(256))
    return encode_png(mask, entries, effort=6)


def sides(design: Design) -> Sides:
    """What lies at ψ = 0°, 90°, 180° and 270°: of the helicopter, or of the stream past a rotor tested alone."""
    flown = design.condition.stand is None
    if not design.condition.advance_ratio:  # No side advances.
        return ("TAIL", "", "NOSE", "") if flown else ("", "", "", "")
    aft, ahead = ("TAIL", "NOSE") if flown else ("DOWNSTREAM", "UPSTREAM")
    return aft, "ADVANCING", ahead, "RETREATING"


@lru_cache(maxsize=3)
def ring_mask(words: Sides) -> Bytes:
    """Rim, azimuth ticks, sense of rotation and the words, shape (RING_SIZE, RING_SIZE). Row 0 is at ψ = 180°."""
    ring = _Ring(RING_SIZE * _OVERSAMPLING)
    ring.circle(1.012, 0.0035, 150)
    for degrees in range(0, 360, 10):
        long, medium = degrees % 90 == 0, degrees % 30 == 0
        reach = 0.034 if long else 0.024 if medium else 0.013
        ring.tick(degrees, 1.024, 1.024 + reach, 0.0040 if long else 0.0027, 215 if long else 125)
    aft, advancing, ahead, retreating = words
    ring.word(ahead, 180.0, 1.122, 0.084, outward=True)
    # Beside the boom, neither fin nor stabilator hides it.
    ring.word(aft, 15.0 if aft == "TAIL" else 0.0, 1.122, 0.084, outward=False)
    ring.word(advancing, 90.0, 1.122, 0.079, outward=False)
    ring.word(retreating, 270.0, 1.122, 0.079, outward=True)
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
        self._draw.line(
            [self._at(degrees, first), self._at(degrees, last)],
            fill=strength,
            width=self._pixels(width),
        )

    def arrow(self, first: float, last: float, r: float, width: float, strength: int) -> None:
        """An arc with a head at its later end."""
        # Pillow counts clockwise from +x; the azimuth runs counter-clockwise from straight down.
        self._draw.arc(
            self._box(r), 90.0 - last, 90.0 - first, fill=strength, width=self._pixels(width)
        )
        head = [self._at(last, r - 0.016), self._at(last, r + 0.016), self._at(last + 2.2, r)]
        self._draw.polygon(head, fill=strength)

    def word(
        self, text: str, degrees: float, r: float, height: float, outward: bool, strength: int = 245
    ) -> None:
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
            pen.text(
                middle,
                letter,
                fill=strength,
                font=font,
                anchor="mm",
                stroke_width=stroke,
                stroke_fill=strength,
            )
            tile = tile.rotate(at + (180.0 if outward else 0.0), Image.Resampling.BICUBIC)
            x, y = self._at(at, r)
            corner = (round(x - 0.5 * tile.width), round(y - 0.5 * tile.height))
            under = self._image.crop((*corner, corner[0] + tile.width, corner[1] + tile.height))
            self._image.paste(ImageChops.lighter(under, tile), corner)

    def reduced(self) -> Bytes:
        return np.asarray(self._image.reduce(_OVERSAMPLING))

    def _at(self, degrees: float, r: float) -> tuple[float, float]:
        psi, middle = math.radians(degrees), 0.5 * self._size
        return middle + r * self._unit * math.sin(psi), middle + r * self._unit * math.cos(psi)

    def _box(self, r: float) -> tuple[float, float, float, float]:
        low, high = 0.5 * self._size - r * self._unit, 0.5 * self._size + r * self._unit
        return low, low, high, high

    def _pixels(self, length: float) -> int:
        return max(1, round(length * self._unit))


@lru_cache(maxsize=4)
def shadow_mask(craft: Airframe, radius: float) -> Bytes:
    """The airframe's soft shadow on the ground, and the disk's, from above; radius [m]. Row 0 is ahead."""
    size, half = _SHADOW_SIZE, SHADOW_HALF * radius
    unit = 0.5 * size / half

    def place(points: NDArray[np.float64]) -> list[tuple[float, float]]:
        return [
            (0.5 * size + y * unit, 0.5 * size + (x - SHADOW_CENTRE * radius) * unit)
            for x, y in points
        ]

    disk, body = Image.new("L", (size, size), 0), Image.new("L", (size, size), 0)
    (left, top), (right, bottom) = place(np.array([[-radius, -radius], [radius, radius]]))
    ImageDraw.Draw(disk).ellipse((left, top, right, bottom), fill=46)
    pen = ImageDraw.Draw(body)
    for triangle in craft.body.vertices[craft.body.faces][:, :, :2]:
        pen.polygon(place(triangle), fill=170)
    soft = ImageFilter.GaussianBlur(0.042 * size), ImageFilter.GaussianBlur(0.018 * size)
    return np.asarray(ImageChops.add(disk.filter(soft[0]), body.filter(soft[1])))
