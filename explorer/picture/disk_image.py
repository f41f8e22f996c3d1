"""The disk as a picture: polar values → palette indices → a small PNG with transparent corners and cut-out."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from explorer.picture.polar import PolarGrid
from explorer.theme.colours import VOID, Scheme, colour_map, greyed
from rotor.arrays import Array

Bytes = NDArray[np.uint8]

SIZE = 512
"""Pixels along each edge of the page's picture."""
RADII, AZIMUTHS = 176, 768
"""Points of the polar grid behind it: about one pixel each."""
LARGEST = 2400
"""Pixels along each edge of any picture: enough for the height of a 4K screen, about a second."""

# Layout of the 256 palette entries.
_CLEAR = 0
_LEVELS = 190
_VOID = 1 + _LEVELS
_EDGE_COLOURS = 21
_EDGE_ALPHAS = (0.25, 0.5, 0.75)
_FIRST_EDGE = _VOID + 1


@dataclass(frozen=True, eq=False)
class Raster:
    """Where each pixel looks on the polar grid. Row 0 is at the nose (ψ = 180°), columns run to starboard."""

    index: NDArray[np.intp]
    """Flat polar index of each covered pixel, shape (covered,)."""
    covered: NDArray[np.intp]
    """Flat pixel index of each covered pixel."""
    edge_level: Bytes
    """Of each covered pixel: 0 inside, 1…3 for a quarter to three quarters covered."""


def half_width(radius: float, size: int = SIZE) -> float:
    """Half the edge of the square the picture fills [m]: the disk plus a pixel all round."""
    return radius * size / (size - 2)


@lru_cache(maxsize=4)
def _page_raster(inner: float) -> Raster:
    return _raster(inner, SIZE, RADII, AZIMUTHS)


def _raster(inner: float, size: int, radii: int, azimuths: int) -> Raster:
    """`inner`: root cut-out y/R; the polar grid has `radii` × `azimuths` points."""
    coordinate = (2.0 * (np.arange(size) + 0.5) / size - 1.0) * size / (size - 2)
    starboard, aft = np.meshgrid(coordinate, coordinate)
    r = np.hypot(aft, starboard)
    pixel = 2.0 / (size - 2)
    coverage = np.clip((1.0 - r) / pixel + 0.5, 0.0, 1.0) * np.clip((r - inner) / pixel + 0.5, 0.0, 1.0)
    quarters = np.rint(4.0 * coverage).astype(np.uint8).ravel()
    covered = np.flatnonzero(quarters)
    row = np.clip(np.rint((r - inner) / (1.0 - inner) * (radii - 1)), 0, radii - 1).astype(np.intp)
    column = np.rint(np.arctan2(starboard, aft) / (2.0 * np.pi) * azimuths).astype(np.intp) % azimuths
    level = quarters[covered]
    return Raster((row * azimuths + column).ravel()[covered], covered, np.where(level == 4, 0, level).astype(np.uint8))


def indices(
    grid: PolarGrid,
    values: Array,
    low: float,
    high: float,
    void: NDArray[np.bool_] | None = None,
    size: int = SIZE,
) -> Bytes:
    """Palette index of each pixel, shape (size, size), of polar `values` over the range `low`…`high`."""
    inner, usual = float(grid.r[0]), (size, *values.shape) == (SIZE, RADII, AZIMUTHS)
    # The page's own is kept for the next frame; a large one weighs more than it costs to make again.
    raster = _page_raster(inner) if usual else _raster(inner, size, *values.shape)
    scaled = np.clip((values - low) * ((_LEVELS - 1) / (high - low)), 0.0, _LEVELS - 1)
    polar = (scaled + 0.5).astype(np.uint8)
    pixels = polar.ravel()[raster.index]
    edge = raster.edge_level
    edge_colour = pixels.astype(np.uint16) * (_EDGE_COLOURS - 1) // (_LEVELS - 1)
    covered = np.where(edge == 0, pixels + 1, _FIRST_EDGE + edge_colour * 3 + edge - 1).astype(np.uint8)
    if void is not None:
        covered = np.where(void.ravel()[raster.index] & (edge == 0), np.uint8(_VOID), covered)
    image = np.zeros(size * size, dtype=np.uint8)
    image[raster.covered] = covered
    return image.reshape(size, size)


def palette(scheme: Scheme, faded: bool) -> Bytes:
    """The 256 RGBA entries, shape (256, 4); `faded` is the grey picture of an answer that no longer holds."""
    return _palette(scheme, faded).copy()


@lru_cache(maxsize=6)
def _palette(scheme: Scheme, faded: bool) -> Bytes:
    colours = colour_map(scheme, _LEVELS)
    if faded:
        colours = greyed(colours)
    entries = np.zeros((256, 4), dtype=np.uint8)
    entries[_CLEAR, :3] = VOID
    entries[1 : 1 + _LEVELS, :3] = colours
    entries[1 : 1 + _LEVELS, 3] = 255
    entries[_VOID] = (*VOID, 255)
    for colour in range(_EDGE_COLOURS):
        source = colours[colour * (_LEVELS - 1) // (_EDGE_COLOURS - 1)]
        for step, alpha in enumerate(_EDGE_ALPHAS):
            entries[_FIRST_EDGE + 3 * colour + step] = (*source, round(255 * alpha))
    if faded:
        entries[:, 3] = (0.55 * entries[:, 3]).astype(np.uint8)
    return entries
