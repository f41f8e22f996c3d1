"""Power over two parameters as a surface in space, as arrays: heights, its grid and walls, water in the valley.

Metres of the scene, about the middle of the map: x along the horizontal parameter, y along the vertical one, z up.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from explorer.colours import colour_map
from explorer.picture.blade_mesh import Mesh
from explorer.picture.camera_views import Camera, direction, framed
from explorer.picture.plan import crossings
from rotor.arrays import Array

SIZE, HEIGHT = 12.0, 3.9
"""Edge of the map and height of its range of power [m]."""
BASE = -0.7
"""Where the walls end [m]."""
POINTS = 97
"""Points of the surface along each edge."""
MOST = 0.4
"""Power above the least, as a part of it, at which the surface is cut off."""
_ABOVE = math.radians(33.0)
_SPARE = 1.05
"""Margin round the map for its ticks and titles."""
_BLADE_GAP = 1.6
"""Between the map's corner and the blade beside it [m]."""


def refined(powers: Array, wide: int, high: int) -> Array:
    """Smooth between grid points, (high, wide), first row low; straight where some do not trim, NaN next to those."""
    n = len(powers) - 1
    row, column = np.linspace(0.0, n, high), np.linspace(0.0, n, wide)
    degree = 3 if np.isfinite(powers).all() else 1
    known = np.where(np.isfinite(powers), powers, 1e9)
    grid = np.arange(n + 1.0)
    values = RectBivariateSpline(grid, grid, known, kx=degree, ky=degree)(row, column)
    return np.where(values < 1e8, values, np.nan)


@dataclass(frozen=True, eq=False)
class Landscape:
    """Power over the unit square."""

    powers: Array
    """[W], (rows along y, columns along x), finely; NaN where a design does not trim."""
    band: float
    """Power above the least that the water covers, as a part of it."""

    @property
    def least(self) -> float:
        """[W]"""
        return float(np.nanmin(self.powers))

    @property
    def top(self) -> float:
        """Power at which the surface ends [W]."""
        return min(float(np.nanmax(self.powers)), (1.0 + MOST) * self.least)

    @property
    def near(self) -> tuple[float, float]:
        """The corner that faces the camera, ±1 along x and y: the lowest, which hides least of the valley."""
        corners = [(x, y) for y in (-1.0, 1.0) for x in (-1.0, 1.0)]
        values = [self.powers[0 if y < 0 else -1, 0 if x < 0 else -1] for x, y in corners]
        return corners[int(np.argmin(np.where(np.isfinite(values), values, np.inf)))]

    def height(self, power: Array | float) -> Array:
        """z of a power [m]."""
        span = max(self.top - self.least, 1e-9)
        return np.asarray(HEIGHT * (np.minimum(power, self.top) - self.least) / span, dtype=np.float64)

    def at(self, x: float, y: float) -> float:
        """Power at a place, 0…1 along x and y [W]; NaN beside designs that do not trim."""
        n = len(self.powers) - 1
        column, row = min(max(x, 0.0), 1.0) * n, min(max(y, 0.0), 1.0) * n
        i, j = min(int(row), n - 1), min(int(column), n - 1)
        u, v = row - i, column - j
        p = self.powers
        low, high = (1.0 - v) * p[i, j] + v * p[i, j + 1], (1.0 - v) * p[i + 1, j] + v * p[i + 1, j + 1]
        return float((1.0 - u) * low + u * high)

    def place(self, x: float, y: float, power: float | None = None, lift: float = 0.0) -> list[float]:
        """A point over the map [m]: on the surface, or at a power above it, raised by `lift`."""
        on = self.at(x, y)
        known = [value for value in (on, power) if value is not None and math.isfinite(value)]
        z = float(self.height(max(known))) if known else 0.0
        return [SIZE * (x - 0.5), SIZE * (y - 0.5), z + lift]

    def surface(self) -> Mesh:
        """The surface seen from above; nothing where designs do not trim."""
        n = len(self.powers)
        at = SIZE * (np.linspace(0.0, 1.0, n) - 0.5)
        z = self.height(np.where(np.isfinite(self.powers), self.powers, self.least))
        x, y = np.meshgrid(at, at)
        vertices = np.stack((x, y, z), axis=-1).reshape(-1, 3)
        k = np.arange(n * n).reshape(n, n)
        a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, :-1].ravel(), k[1:, 1:].ravel()
        known = np.isfinite(self.powers).ravel()
        faces = np.concatenate((np.stack((a, b, d), 1), np.stack((a, d, c), 1)))
        return Mesh(vertices, faces[known[faces].all(axis=1)].astype(np.uint32))

    def colours(self, ends: float) -> NDArray[np.uint8]:
        """Colour of each vertex: by power above the least, to `ends` as a part of it, as on the flat map, (n, 3)."""
        shades = colour_map("sequential", 200)
        excess = np.nan_to_num(self.powers / self.least - 1.0, nan=0.0)
        return shades[(np.clip(excess / ends, 0.0, 1.0) ** 0.5 * 199).astype(int)].reshape(-1, 3)

    def walls(self) -> Mesh:
        """From the edge of the surface down to the base, on the two sides that face the camera."""
        n, (x, y) = len(self.powers), self.near
        at, z = SIZE * (np.linspace(0.0, 1.0, n) - 0.5), self.height(np.nan_to_num(self.powers, nan=self.least))
        sides = (
            np.stack((at, np.full(n, 0.5 * y * SIZE), z[0 if y < 0 else -1]), 1),
            np.stack((np.full(n, 0.5 * x * SIZE), at, z[:, 0 if x < 0 else -1]), 1),
        )
        vertices = [np.concatenate((edge, edge * [1.0, 1.0, 0.0] + [0.0, 0.0, BASE])) for edge in sides]
        k = np.arange(n - 1)
        strip = np.concatenate((np.stack((k, k + n, k + n + 1), 1), np.stack((k, k + n + 1, k + 1), 1)))
        return Mesh(np.concatenate(vertices), np.concatenate((strip, strip + 2 * n)).astype(np.uint32))

    def water(self) -> Mesh:
        """A level surface at the top of the band: what of the valley is below it is flooded."""
        edge, z = 0.4995 * SIZE, float(self.height((1.0 + self.band) * self.least))
        corners = np.array([[-edge, -edge, z], [edge, -edge, z], [edge, edge, z], [-edge, edge, z]])
        return Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32))

    def shore(self) -> Array:
        """Where the water meets the surface, as segments [m], (n, 2, 3)."""
        return self.contour((1.0 + self.band) * self.least, 0.015)

    def contour(self, power: float, lift: float) -> Array:
        """Segments of a line of one power on the surface [m], (n, 2, 3)."""
        at = SIZE * (np.linspace(0.0, 1.0, len(self.powers)) - 0.5)
        flat = crossings(at, at, self.powers.T - power)
        height = np.full((*flat.shape[:2], 1), float(self.height(power)) + lift)
        return np.concatenate((flat, height), axis=2)

    def valley(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """From where to where the band reaches along x and along y, 0…1."""
        with np.errstate(invalid="ignore"):
            row, column = np.nonzero(self.powers <= (1.0 + self.band) * self.least)
        n = len(self.powers) - 1
        return (float(column.min()) / n, float(column.max()) / n), (float(row.min()) / n, float(row.max()) / n)

    def blade_place(self, length: float) -> tuple[Array, float]:
        """Root of a blade of this length [m] right of the map that points at the viewer, and its turn about z [rad]."""
        x, y = self.near
        towards = np.array([x, y, 0.0]) / math.sqrt(2.0)
        right = np.array([-towards[1], towards[0], 0.0])
        beside = (SIZE / math.sqrt(2.0) + _BLADE_GAP) * right
        return beside - 0.5 * length * towards + [0.0, 0.0, 1.0], math.atan2(towards[1], towards[0])

    def camera(self, length: float, aspect: float) -> Camera:
        """Over the near corner, with map, ticks and the blade in view."""
        x, y = self.near
        edge = 0.5 * _SPARE * SIZE
        points = [[u * edge, v * edge, z] for u in (-1, 1) for v in (-1, 1) for z in (BASE, 0.85 * HEIGHT)]
        root, turn = self.blade_place(length)
        tip = root + length * np.array([math.cos(turn), math.sin(turn), 0.0])
        return framed(np.array([*points, root, tip]), direction(math.atan2(y, x), _ABOVE), aspect)
