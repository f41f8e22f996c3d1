"""The axes of a study, and the order in which its points are computed.

Axes with values are crossed; ranges are sampled together. The order changes one axis by one step at a time (a reflected
mixed-radix Gray code), the axis with the smallest steps fastest, so that every trim starts next to the previous one. It
is computed, not stored: a study of 10⁹ points needs no memory.

"""

import math
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from rotor.arrays import Array

Ints = NDArray[np.int64]

Method = Literal["sobol", "latin-hypercube"]


@dataclass(frozen=True)
class Axis:
    """A quantity and the values it takes."""

    name: str
    values: tuple[float, ...] | tuple[str, ...]

    @property
    def textual(self) -> bool:
        return isinstance(self.values[0], str)


@dataclass(frozen=True)
class Sample:
    """Points distributed evenly over several ranges together."""

    method: Method
    count: int
    seed: int
    ranges: tuple[tuple[str, float, float], ...]
    """Quantity, low, high."""

    def __post_init__(self) -> None:
        if not 1 <= self.count <= 2**24:
            raise ValueError(f"sample count {self.count} is outside 1…{2**24}: choose a number inside")
        if self.seed < 0:
            raise ValueError(f"sample seed {self.seed} is negative: give 0 or more")


@dataclass(frozen=True)
class StudyPoints:
    """All points of a study; the values of each by quantity."""

    axes: tuple[Axis, ...]
    sample: Sample | None

    @property
    def count(self) -> int:
        return math.prod(
            (len(axis.values) for axis in self.axes), start=1 if self.sample is None else self.sample.count
        )

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Low and high of every axis of numbers."""
        grids = {
            axis.name: (float(min(axis.values)), float(max(axis.values))) for axis in self.axes if not axis.textual
        }
        return grids | ({name: (low, high) for name, low, high in self.sample.ranges} if self.sample else {})

    def at(self, first: int, last: int) -> list[dict[str, float | str]]:
        """Values of the points first … last − 1 in the order of computation."""
        digits = _walk(np.arange(first, last, dtype=np.int64), tuple(size for _, size in self._order))
        columns: dict[str, list[float | str]] = {}
        for (axis, _), digit in zip(self._order, digits, strict=True):
            if isinstance(axis, Axis):
                columns[axis.name] = [axis.values[k] for k in digit]
            else:
                rows = _spread(axis)[digit]
                columns |= {name: rows[:, k].tolist() for k, (name, _, _) in enumerate(axis.ranges)}
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]

    @property
    def _order(self) -> list[tuple[Axis | Sample, int]]:
        """Axes from slow to fast: texts, then axes by increasing number of values."""
        ranked: list[tuple[float, Axis | Sample, int]] = [
            (0.0 if axis.textual else len(axis.values), axis, len(axis.values)) for axis in self.axes
        ]
        if self.sample is not None:
            ranked.append((self.sample.count ** (1.0 / len(self.sample.ranges)), self.sample, self.sample.count))
        return [(axis, size) for _, axis, size in sorted(ranked, key=lambda one: one[0])]


def _walk(positions: Ints, sizes: tuple[int, ...]) -> list[Ints]:
    """Digits of each axis, slow to fast; each runs back and forth, so neighbours differ by one step."""
    digits: list[Ints] = []
    block = math.prod(sizes)
    for size in sizes:
        turn = positions // block
        block //= size
        digit = positions // block % size
        digits.append(np.where(turn % 2 == 0, digit, size - 1 - digit))
    return digits


@cache
def _spread(sample: Sample) -> Array:
    """The points of a sample as values, (count, ranges), neighbours adjacent."""
    n, d = sample.count, len(sample.ranges)
    if sample.method == "sobol":
        # The sequence is balanced over powers of two; a first part of it is distributed nearly as well.
        unit = qmc.Sobol(d, seed=sample.seed).random_base2((n - 1).bit_length())[:n]
    else:
        unit = qmc.LatinHypercube(d, seed=sample.seed).random(n)
    low, high = np.array([(low, high) for _, low, high in sample.ranges]).T
    return low + (high - low) * unit[_snake(unit)]


def _snake(unit: Array) -> Ints:
    """An order of points of the unit cube that runs back and forth through its cells."""
    n, d = unit.shape
    cells = max(1, round(n ** (1.0 / d)))
    number = np.zeros(n, dtype=np.int64)
    for k in range(d - 1):
        cell = np.minimum((unit[:, k] * cells).astype(np.int64), cells - 1)
        number = number * cells + np.where(number % 2 == 0, cell, cells - 1 - cell)
    along = np.where(number % 2 == 0, unit[:, -1], -unit[:, -1])
    return np.lexsort((along, number)).astype(np.int64)
