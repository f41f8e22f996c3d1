"""The disk as a picture: polar values and marked regions → palette indices → a small PNG, transparent outside."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from explorer.picture.polar import Places, PolarGrid
from explorer.picture.regions import Bytes, MarkedRegion
from explorer.picture.scene_theme import DiskInk
from explorer.theme.colours import VOID, Scheme, colour_map, greyed
from rotor.arrays import Array
from rotor.compiled import compiled

_compile = compiled(error_model="numpy", fastmath={"contract"})

MOVING, AT_REST = 368, 960
"""Pixels along each edge of the page's picture while something is dragged, and afterwards."""
SIZE = 512
"""Pixels along each edge of a picture for export, where nothing else is asked for."""
LARGEST = 2400
"""Pixels along each edge of any picture: enough for the height of a 4K screen, about a second."""

# Layout of the 256 palette entries.
_CLEAR = 0
_LEVELS = 112
_HATCHED = _LEVELS
"""Added to the entry of a colour: the same under a stripe."""
_VOID, _REVERSE, _REVERSE_RIM, _DASH, _STALL_RIM = range(1 + 2 * _LEVELS, 6 + 2 * _LEVELS)
_FIRST_EDGE = _STALL_RIM + 1
_EDGE_COLOURS = 7
_EDGE_ALPHAS = (0.25, 0.5, 0.75)
_STRIPES = 26.0
"""Stripes of the hatch per radius."""
_STRIPE_SHARE = 0.36
_REGION_ENTRIES = {
    MarkedRegion.STALL_RIM: _STALL_RIM,
    MarkedRegion.DASH: _DASH,
    MarkedRegion.REVERSE: _REVERSE,
    MarkedRegion.REVERSE_RIM: _REVERSE_RIM,
}


@dataclass(frozen=True, eq=False)
class Raster:
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
    return (104, 352) if size <= MOVING else (round(0.34 * size), round(1.5 * size))


@lru_cache(maxsize=4)
def _page_raster(inner: float, size: int) -> Raster:
    return _raster(inner, size, *grid_size(size))


def _raster(inner: float, size: int, radii: int, azimuths: int) -> Raster:
    """`inner`: root cut-out y/R; the polar grid has `radii` × `azimuths` points."""
    coordinate = (2.0 * (np.arange(size) + 0.5) / size - 1.0) * size / (size - 2)
    starboard, aft = np.meshgrid(coordinate, coordinate)
    r = np.hypot(aft, starboard)
    pixel = 2.0 / (size - 2)
    coverage = np.clip((1.0 - r) / pixel + 0.5, 0.0, 1.0) * np.clip((r - inner) / pixel + 0.5, 0.0, 1.0)
    quarters = np.rint(4.0 * coverage).astype(np.uint16).ravel()
    covered = np.flatnonzero(quarters)
    row = np.clip(np.rint((r - inner) / (1.0 - inner) * (radii - 1)), 0, radii - 1).astype(np.intp)
    column = np.rint(np.arctan2(starboard, aft) / (2.0 * np.pi) * azimuths).astype(np.intp) % azimuths
    stripe = (((aft - starboard) * _STRIPES) % 1.0 < _STRIPE_SHARE).ravel()[covered]
    level = quarters[covered]
    kind = np.where(level == 4, np.where(stripe, 1, 0), 1 + level).astype(np.uint16)
    index = (row * azimuths + column).ravel()[covered]
    return Raster(index.astype(np.int32), covered.astype(np.int32), kind * np.uint16(256))


@lru_cache(maxsize=1)
def _entries() -> Bytes:
    """Palette entry of each polar code for each kind of pixel, flat, shape (5 × 256,)."""
    code = np.arange(256)
    plain = np.where((code > _HATCHED) & (code <= 2 * _LEVELS), code - _HATCHED, code)
    hatched = code.copy()
    colour = np.clip(plain - 1, 0, _LEVELS - 1) * (_EDGE_COLOURS - 1) // (_LEVELS - 1)
    edges = [_FIRST_EDGE + 3 * colour + step for step in range(3)]
    return np.concatenate((plain, hatched, *edges)).astype(np.uint8)


@lru_cache(maxsize=1)
def _region_entries() -> Bytes:
    """Palette entry by `MarkedRegion`; 0 for those that keep the colour of the field."""
    return np.array([_REGION_ENTRIES.get(region, 0) for region in MarkedRegion], dtype=np.uint8)


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
    inner, usual = float(grid.r[0]), size in (MOVING, AT_REST) and values.shape == grid_size(size)
    # The page's own are kept for the next frame; a large one weighs more than it costs to make again.
    raster = _page_raster(inner, size) if usual else _raster(inner, size, *values.shape)
    codes = levels_of(np.ascontiguousarray(values), low, high, _LEVELS)
    if void is not None:
        np.copyto(codes, _VOID, where=void)
    if regions is not None:
        codes += ((regions == MarkedRegion.STALLED) & (codes <= _LEVELS)) * np.uint8(_HATCHED)
        np.copyto(codes, _region_entries().take(regions), where=regions > MarkedRegion.STALLED)
    image: Bytes = paint(codes, raster.index, raster.covered, raster.kind, _entries(), size * size)
    return image.reshape(size, size)


@_compile
def levels_of(values: Array, low: float, high: float, levels: int) -> Bytes:
    """1…levels for values from `low` to `high` and beyond them."""
    made = np.empty(values.shape, np.uint8)
    scale, most = (levels - 1) / (high - low), levels - 1.0
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            made[i, j] = np.uint8(min(max((values[i, j] - low) * scale, 0.0), most) + 1.5)
    return made


@_compile
def paint(codes: Bytes, index: Places, covered: Places, kind: NDArray[np.uint16], entries: Bytes, pixels: int) -> Bytes:
    """A picture of so many pixels: `covered` ones get the entry of their kind for the code at their index."""
    image, flat = np.zeros(pixels, np.uint8), codes.ravel()
    for k in range(len(covered)):
        image[covered[k]] = entries[kind[k] + flat[index[k]]]
    return image


def palette(scheme: Scheme, faded: bool, ink: DiskInk | None = None) -> Bytes:
    """The 256 RGBA entries, shape (256, 4); `faded` is the grey picture of a solution that no longer holds.

    `ink`: colours of the marked regions, and the opacity of the disk.
    """
    return _palette(scheme, faded, ink or DiskInk()).copy()


@lru_cache(maxsize=8)
def _palette(scheme: Scheme, faded: bool, ink: DiskInk) -> Bytes:
    colours = colour_map(scheme, _LEVELS)
    if faded:
        colours = greyed(colours)
    entries = np.zeros((256, 4), dtype=np.uint8)
    entries[_CLEAR, :3] = VOID
    entries[1 : 1 + _LEVELS, :3] = colours
    entries[1 : 1 + _LEVELS, 3] = round(255 * ink.opacity)
    stripe = np.array(ink.stall, dtype=np.float64)
    entries[1 + _HATCHED : 1 + _HATCHED + _LEVELS, :3] = (0.2 * colours + 0.8 * stripe).astype(np.uint8)
    entries[1 + _HATCHED : 1 + _HATCHED + _LEVELS, 3] = 250
    entries[_VOID] = (*VOID, round(255 * ink.opacity))
    entries[_REVERSE] = (*ink.reverse_flow, 238)
    entries[_REVERSE_RIM] = (*ink.reverse_flow_rim, 255)
    entries[_DASH] = (*ink.drag_divergence, 255)
    entries[_STALL_RIM] = (*ink.stall, 255)
    for colour in range(_EDGE_COLOURS):
        source = colours[colour * (_LEVELS - 1) // (_EDGE_COLOURS - 1)]
        for step, share in enumerate(_EDGE_ALPHAS):
            entries[_FIRST_EDGE + 3 * colour + step] = (*source, round(255 * share * ink.opacity))
    if faded:
        entries[:, 3] = (0.55 * entries[:, 3]).astype(np.uint8)
    return entries
