"""A study as a value: what it can set, its axes, the order of its points, its settings, and the columns of its results.

Axes with values are crossed; ranges are sampled together. The order changes one axis by one step at a time (a reflected
mixed-radix Gray code), the axis with the smallest steps fastest, so that every trim starts next to the previous one. It
is computed, not stored: a study of 10⁹ points needs no memory. A study pickles, compares and has a fingerprint.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rotor.design.aircraft import Aircraft
from rotor.design.design import fingerprint
from rotor.design.quantities import QUANTITIES as QUANTITIES_OF_DESIGN
from rotor.design.quantities import STAND, UNUSUAL
from rotor.design.quantity import Quantity
from rotor.optimisation.concepts import (
    CONCEPTS,
    THREE_SEGMENT_FREE,
    TWO_AIRFOILS,
    TWO_SEGMENT_FREE,
    Concept,
    find_concept,
)
from rotor.optimisation.objective import Quantity as Objective
from rotor.study.series import HUB_COLUMNS, POWERS
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache
from rotor.support.units import unit_of

Value = float | str | bool
Ints = NDArray[np.int64]

Method = Literal["sobol", "latin-hypercube"]


def _quantities() -> Iterator[Quantity]:
    yield from (row for row in QUANTITIES_OF_DESIGN.values() if row.section)
    yield from (replace(row, name=f"stand_{name}", section="fixed") for name, row in STAND.items())
    for concept in CONCEPTS.values():
        for parameter in concept.parameters:
            yield Quantity(parameter.label, "number", unit=parameter.shown_unit, section="fixed")


QUANTITIES: dict[str, Quantity] = {quantity.name: quantity for quantity in _quantities()}
"""By name; the parameters of all twist concepts are among them, angles in degrees with names that end in _deg."""

_SWITCHES = tuple(name for name, row in QUANTITIES.items() if row.kind == "switch")
_LABELS = {parameter.label for concept in CONCEPTS.values() for parameter in concept.parameters}
PLAIN = tuple(name for name in QUANTITIES if name not in _LABELS)
"""Quantities that do not belong to a concept."""

_WIDER: dict[str, Concept] = {
    "two-segment": TWO_SEGMENT_FREE,
    "two-segment-two-airfoils": TWO_AIRFOILS,
    "three-segment": THREE_SEGMENT_FREE,
}
"""Concepts with fixed breaks, and the same with breaks that a study can set."""


def concept_with_breaks(name: str, given: dict[str, float]) -> tuple[Concept, dict[str, float]]:
    """The concept whose parameters include those given by label, and their values by name in SI.

    Raises ValueError for a concept or a parameter that there is not.
    """
    concept = find_concept(name)
    if name in _WIDER and any(
        label not in [parameter.label for parameter in concept.parameters] for label in given
    ):
        concept = _WIDER[name]
    known = {parameter.label: parameter for parameter in concept.parameters}
    for label in given:
        if label not in known:
            raise ValueError(
                f"{label} is not a parameter of the concept {name}: it has {', '.join(known)}"
            )
    return concept, {
        known[label].name: known[label].from_shown(value) for label, value in given.items()
    }


@dataclass(frozen=True)
class StudyAxis:
    name: str
    values: tuple[float, ...] | tuple[str, ...]

    @property
    def textual(self) -> bool:
        return isinstance(self.values[0], str)


@dataclass(frozen=True)
class StudySample:
    """Points distributed evenly over several ranges together."""

    method: Method
    count: int
    seed: int
    ranges: tuple[tuple[str, float, float], ...]
    """Quantity, low, high."""


@dataclass(frozen=True)
class StudyPoints:
    """All points of a study; the values of each by quantity."""

    axes: tuple[StudyAxis, ...]
    sample: StudySample | None

    @property
    def count(self) -> int:
        return math.prod(len(axis.values) for axis in self.axes) * (
            self.sample.count if self.sample else 1
        )

    @property
    def sampled(self) -> dict[str, tuple[float, float]]:
        """Low and high of every sampled range."""
        return {name: (low, high) for name, low, high in self.sample.ranges} if self.sample else {}

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Low and high of every axis of numbers."""
        numbers = [axis for axis in self.axes if not axis.textual]
        return {
            axis.name: (float(min(axis.values)), float(max(axis.values))) for axis in numbers
        } | self.sampled

    def at(self, first: int, last: int) -> list[dict[str, float | str]]:
        """Values of the points first … last − 1 in the order of computation."""
        digits = _walk(
            np.arange(first, last, dtype=np.int64), tuple(size for _, size in self._order)
        )
        columns: dict[str, list[float | str]] = {}
        for (axis, _), digit in zip(self._order, digits, strict=True):
            if isinstance(axis, StudyAxis):
                columns[axis.name] = [axis.values[k] for k in digit]
            else:
                rows = _spread(axis)[digit]
                columns |= {name: rows[:, k].tolist() for k, (name, _, _) in enumerate(axis.ranges)}
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]

    @property
    def _order(self) -> list[tuple[StudyAxis | StudySample, int]]:
        """Axes from slow to fast: texts, then axes by increasing number of values."""
        ranked: list[tuple[float, StudyAxis | StudySample, int]] = [
            (0.0 if axis.textual else len(axis.values), axis, len(axis.values))
            for axis in self.axes
        ]
        if self.sample is not None:
            ranked.append(
                (
                    self.sample.count ** (1.0 / len(self.sample.ranges)),
                    self.sample,
                    self.sample.count,
                )
            )
        return [(axis, size) for _, axis, size in sorted(ranked, key=lambda ranking: ranking[0])]


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


@bytes_cache
@read_only
def _spread(sample: StudySample) -> Array:
    """The points of a sample as values, (count, ranges), neighbours adjacent."""
    from scipy.stats import qmc  # Imported here: it is slow to import.

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


@dataclass(frozen=True)
class OptimumSettings:
    """Settings of the search at each point."""

    starts: int = 3
    """One of them begins at the optimum of the point before."""
    seed: int = 0
    objective: Objective = "total"
    rate: tuple[float, float] | None = None
    """Steepest and flattest twist rate [rad/R]."""
    stalled: float | None = None
    """Largest stalled share of the disk (0…1)."""
    index: float | None = None
    """Largest vibration index [%]."""


@dataclass(frozen=True)
class ShowSettings:
    """Settings of `show`; the results of points do not depend on them."""

    least: str = "power_total_w"
    """The column to minimise."""
    uncertain: tuple[str, ...] = ()
    """Uncertain axes: a robust design is best over all of their values."""


@dataclass(frozen=True)
class Study:
    """A study: points, shared values, settings of search and output."""

    title: str
    points: StudyPoints
    given: tuple[tuple[str, Value], ...]
    optimum: OptimumSettings | None
    """None: each point is a trim."""
    chunk: int
    show: ShowSettings
    aircraft: tuple[tuple[str, Aircraft], ...] = ()
    """Rotors from files of the user's own, by the names that the study file gives them: a worker has no such files."""

    @property
    def count(self) -> int:
        return self.points.count

    @property
    def chunks(self) -> int:
        return -(-self.count // self.chunk)

    def span(self, chunk: int) -> tuple[int, int]:
        """First point of a chunk, and the one after its last."""
        return chunk * self.chunk, min((chunk + 1) * self.chunk, self.count)

    def points_of(self, chunks: Iterable[int]) -> int:
        """How many points these chunks have together."""
        return sum(last - first for first, last in map(self.span, chunks))

    def values(self, first: int, last: int) -> list[dict[str, Value]]:
        """All values of the points first … last − 1."""
        shared = dict(self.given)
        return [{**shared, **values} for values in self.points.at(first, last)]

    @property
    def axis_names(self) -> tuple[str, ...]:
        """Axes in the order of the file, sampled ranges last."""
        return (*(axis.name for axis in self.points.axes), *self.points.sampled)

    @property
    def names(self) -> tuple[str, ...]:
        """All quantities that the study sets."""
        return (*self.axis_names, *(name for name, _ in self.given))

    @property
    def concepts(self) -> tuple[str, ...]:
        """The twist concepts that occur."""
        values = {name: (value,) for name, value in self.given} | {
            axis.name: axis.values for axis in self.points.axes
        }
        return tuple(map(str, values.get("concept", ())))

    @property
    def parameters(self) -> tuple[str, ...]:
        """The concept parameters that the study sets, by label."""
        return tuple(name for name in self.names if name not in PLAIN)

    @property
    def fingerprint(self) -> str:
        """Equal for studies whose points have the same results."""
        return fingerprint(
            (self.points, sorted(self.given), self.optimum, self.chunk, self.aircraft)
        )


def check_uncertain(
    uncertain: tuple[str, ...], axes: tuple[str, ...], sampled: tuple[str, ...]
) -> None:
    """ValueError, with one sentence, for uncertain axes over which no design can be the robust best."""
    for name in uncertain:
        if name not in axes:
            raise ValueError(
                f"axis {name!r} is not an axis of this study: use some of {', '.join(axes)}"
            )
    if set(axes) <= set(uncertain):
        raise ValueError("every axis is uncertain, so there are no designs to compare: omit one")
    fixed = [name for name in sampled if name not in uncertain]
    if fixed and (mixed := [name for name in sampled if name in uncertain]):
        raise ValueError(
            f"{mixed[0]} is sampled together with {fixed[0]}, so no two designs have the same cases: "
            f"give {mixed[0]} a list of values"
        )


def default_chunk(count: int, *, search: bool) -> int:
    """Default number of points per chunk: seconds of work, and not too many files in a folder.

    An optimum takes as long as many trims; a chunk starts cold, and is what a lost worker or a Ctrl-C costs.
    """
    most = 16 if search else 500
    few = max(count // 32, 4)
    return max(min(most, few), -(-count // 20_000))


FREQUENCIES = ("flap_1", "flap_2", "lag_1", "lag_2", "torsion_1")
"""Modes of the rotating blade whose frequencies are in the table."""


@dataclass(frozen=True)
class StudyColumn:
    name: str
    kind: Literal["number", "count", "text"]
    unit: str


_REPORTED = tuple(name for name, row in UNUSUAL.items() if row.reported)
_FLIGHT = (
    "rotor",
    "mu",
    "speed_m_s",
    "mass_kg",
    "altitude_m",
    *_REPORTED,
    "preset",
    "inflow",
    "twist",
)
_HEAD = ("point", "status", "message", *_FLIGHT)
ANSWER = (
    *(f"power_{part}_w" for part in POWERS), "ct", "cp", "ct_over_sigma", "lambda0", "collective_deg", "cyclic_1c_deg",
    "cyclic_1s_deg", "coning_deg", "flap_1c_deg", "flap_1s_deg", "shaft_tilt_deg", "reverse_flow_area_percent",
    "stalled_area_percent", "caveats", "passes", "elapsed_ms",
)  # fmt: skip
"""Results of a trim."""
_VIBRATION = ("index_percent", *HUB_COLUMNS, *(f"{mode}_per_rev" for mode in FREQUENCIES))
"""Columns with `bending`: amplitudes at N_b/rev, without the band over inflow models, which takes three more trims."""
_SAVED = (
    "mean_power_w",
    "hover_power_w",
    "baseline_power_w",
    "saving_percent",
    "saving_doubt_percent",
    "sureness",
)
_SEARCH = (*_SAVED, "local_minima", "active", "evaluations")
"""`mean_power_w` is what the search made small; `hover_power_w` is there with hover_share."""
_COUNTS = ("point", "passes", "local_minima", "evaluations")
_WORDS = ("status", "message", "caveats", "active", "sureness")


def columns_of(study: Study) -> tuple[StudyColumn, ...]:
    """All columns of a study's table: point, status, condition, values set or found, results."""
    given = dict.fromkeys(study.parameters, 0.0)
    searched = (
        [concept_with_breaks(name, given)[0] for name in study.concepts] if study.optimum else []
    )
    parameters = [parameter.label for concept in searched for parameter in concept.parameters]
    first = [name for name in (*study.names, *parameters) if name not in _SWITCHES]
    vibration = _VIBRATION if dict(study.given).get("bending") else ()
    names = (*_HEAD, *first, *ANSWER, *vibration, *(_SEARCH if study.optimum else ()))
    return tuple(_column(name) for name in dict.fromkeys(names))


def _column(name: str) -> StudyColumn:
    row = QUANTITIES.get(name)
    if name in _COUNTS or name in _WORDS or (row is not None and not row.numeric):
        return StudyColumn(name, "count" if name in _COUNTS else "text", "")
    return StudyColumn(name, "number", unit_of(name) if row is None else row.unit)
