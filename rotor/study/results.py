"""The results of a study, complete or still running, and what they show.

They are read from its folder or from one file. Shown are the best point, the robust best design and main effects; any
row is a design again.
"""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from rotor.design.design import Design
from rotor.study.chunks import CONVERGED, arrow_modules, is_undamaged, read_about
from rotor.study.point import design_of
from rotor.study.study import PLAIN, QUANTITIES, Value, concept_with_breaks
from rotor.support.arrays import Array, Booleans, Integers
from rotor.support.user_input import is_file, shorten

_LEAST_DIVIDED = 20
"""Number of values from which an axis is divided into ten parts."""
_LEAST_PER_PART = 10
"""Least mean number of values per part of a sampled axis: with fewer, noise looks like an effect."""


@dataclass(frozen=True, eq=False)
class Results:
    """The rows of a study as columns, in the order of the points."""

    about: dict[str, Any]
    """The folder's `_study.json`, or the metadata of one file."""
    axes: tuple[str, ...]
    columns: dict[str, NDArray[Any]]
    """Numbers as float64 with NaN where a row has none, texts as objects; (rows,)."""

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.columns["point"])

    @property
    def points(self) -> int:
        """Number of points of the study, missing ones included."""
        return int(self.about.get("points", self.rows))

    @property
    def good(self) -> Booleans:
        """True for each row that has a result, (rows,)."""
        return self.columns["status"] == CONVERGED

    def row_of(self, point: int) -> int | None:
        """Row of a point by its number; None if it is missing."""
        rows = np.flatnonzero(self.columns["point"] == point)
        return int(rows[0]) if rows.size else None

    def unit(self, column: str) -> str:
        """Unit of a column; empty without one."""
        return str(self.about.get("units", {}).get(column, ""))

    def numeric(self, column: str) -> bool:
        """Whether a column holds numbers."""
        return self.columns[column].dtype == np.float64

    @property
    def sampled(self) -> tuple[str, ...]:
        """Axes that are sampled together, where the whole folder was read."""
        axes = self.about.get("axes")
        ranges = cast(dict[str, Any], axes) if isinstance(axes, dict) else {}
        return tuple(name for name in self.axes if isinstance(ranges.get(name), dict))

    def codes(self, names: tuple[str, ...]) -> Integers:
        """A number for each row, from 0, equal for rows that agree in all these columns, (rows,)."""
        code = np.zeros(self.rows, dtype=np.int64)
        for name in names:
            values = self.columns[name]
            _, levels = np.unique(
                values if self.numeric(name) else values.astype(str), return_inverse=True
            )
            code = np.unique(code * (int(levels.max(initial=0)) + 1) + levels, return_inverse=True)[
                1
            ].astype(np.int64)
        return code


def read_results(folder: str | Path) -> Results:
    """The results in a folder; ValueError with one sentence for one without a study, or without a result yet."""
    about = read_about(folder)
    paths = sorted(Path(folder).glob("chunk-*.parquet"))
    if not paths:
        raise ValueError(
            f"folder {str(folder)!r} has no finished chunk yet: let the study run longer"
        )
    arrow, _ = arrow_modules()
    tables = list[Any]()
    for path in paths:
        try:
            tables.append(_read_chunk(path))
        except MemoryError:  # pyarrow's ArrowMemoryError is one, too.
            raise
        except (OSError, ValueError, arrow.ArrowException) as error:
            raise ValueError(
                f"{path.name} of {str(folder)!r} is damaged ({shorten(str(error))}): run the study again for its points"
            ) from None
        if tables[-1].schema != tables[0].schema:
            raise ValueError(
                f"{path.name} of {str(folder)!r} belongs to another study: move it elsewhere"
            )
    return Results(about, tuple(map(str, about["axes"])), columns_from(arrow.concat_tables(tables)))


def _read_chunk(path: Path) -> Any:
    """The table of a chunk; an error for one that is not as it was written."""
    _, parquet = arrow_modules()
    metadata: dict[bytes, bytes] = parquet.read_schema(str(path)).metadata or {}
    if metadata.get(b"format_version") != b"1" and not is_undamaged(path.read_bytes()):
        raise ValueError("its digest is another")
    # Not from bytes: an Arrow thread that frees Python's bytes while Python exits aborts the process.
    return parquet.read_table(str(path))


def read_file(path: str | Path) -> Results:
    """The results in one Parquet file of a study, or in several that were joined; ValueError for any other file."""
    arrow, parquet = arrow_modules()
    try:
        of_study = Path(path).name.startswith("chunk-")  # Joined files have no digest.
        table = _read_chunk(Path(path)) if of_study else parquet.read_table(str(path))
        metadata: dict[bytes, bytes] = table.schema.metadata or {}
        stored: dict[str, Any] = {key.decode(): value.decode() for key, value in metadata.items()}
        about: dict[str, Any] = stored | {
            key: json.loads(stored[key]) for key in ("axes", "given", "units")
        }
        results = Results(about, tuple(about["axes"]), columns_from(table))
        if not {"point", "status", *results.axes} <= results.columns.keys():
            raise KeyError(path)
    except MemoryError:  # pyarrow's ArrowMemoryError is one, too.
        raise
    except (OSError, KeyError, ValueError, arrow.ArrowException):
        raise ValueError(
            f"{Path(path).name!r} is not a study result: give a chunk-….parquet of its folder"
        ) from None
    return results


def columns_from(table: Any) -> dict[str, NDArray[Any]]:
    """An Arrow table's columns as arrays; equal texts are one object."""
    arrow, _ = arrow_modules()
    columns: dict[str, NDArray[Any]] = {}
    for name in table.column_names:
        column = table.column(name)
        if arrow.types.is_string(column.type) or arrow.types.is_dictionary(column.type):
            coded = column.dictionary_encode().combine_chunks()
            words = np.array([*coded.dictionary.to_pylist(), None], dtype=object)
            columns[name] = words[coded.indices.fill_null(len(words) - 1).to_numpy()]
        else:
            columns[name] = column.cast(arrow.float64()).to_numpy()
    return columns


def design_of_row(results: Results, row: int) -> Design:
    """The design of a row (0 upward).

    ValueError for one that has no blade, or is of a rotor file that is not here.
    """
    given: dict[str, Any] = results.about.get("given", {})
    values: dict[str, Value] = {name: value for name, value in given.items() if name in PLAIN}
    values |= {name: results.columns[name][row] for name in results.axes if name in PLAIN}
    varied = {
        name: column[row]
        for name, column in results.columns.items()
        if name in QUANTITIES and name not in PLAIN
    }
    blade = {name: float(value) for name, value in varied.items() if math.isfinite(value)}
    design = design_of({name: value for name, value in values.items() if name != "concept"}, {})
    if "concept" not in values:
        return design
    concept, held = concept_with_breaks(str(values["concept"]), blade)
    if len(held) < len(concept.parameters):
        raise ValueError(
            f"point {row} has no optimum, because its search failed: choose another point"
        )
    return concept.apply(design, [held[parameter.name] for parameter in concept.parameters])


def design_at(place: str) -> Design:
    """The design of a point of a study, from `FOLDER:N` or `chunk-….parquet:N`, N as in the column `point`.

    ValueError with one sentence for a place that has no such point, and as `read_results` and `design_of_row`.
    """
    path, _, number = place.rpartition(":")
    if not (path and number.isdecimal()):
        raise ValueError(
            f"row {shorten(place)!r} is not understood: give a study's folder and a point, as DIR:17"
        )
    results = read_file(path) if is_file(path) else read_results(path)
    row = results.row_of(int(number))
    if row is None:
        points = results.columns["point"]
        raise ValueError(
            f"study {shorten(path)!r} has no finished point {number}: give one of {points.min():.0f}…{points.max():.0f}"
        )
    return design_of_row(results, row)


@dataclass(frozen=True)
class RobustDesign:
    """A design and its results over all uncertain cases."""

    design: dict[str, Any]
    """Values of the axes that are not uncertain."""
    worst: float
    """Largest value of the column compared, in its unit."""
    mean: float
    """Its mean."""
    cases: int


@dataclass(frozen=True)
class RobustBest:
    """The best designs over all uncertain cases."""

    least_worst: RobustDesign
    least_mean: RobustDesign
    designs: int
    """Number of designs compared: those with a result in every case."""
    dropped: int
    """Number of designs left out: a case failed or is missing."""


def best_row(results: Results, least: str) -> int | None:
    """The row with the least value of a column; None where no row has one."""
    values = np.where(results.good, results.columns[least], math.nan)
    return int(np.nanargmin(values)) if np.isfinite(values).any() else None


def robust_best(results: Results, least: str, uncertain: tuple[str, ...]) -> RobustBest | None:
    """The design of the least worst case and that of the least mean; None where no design has all its cases.

    Designs differ in the axes that are not uncertain. Each must have results in as many cases as the finished rows have
    combinations of the uncertain axes.
    """
    chosen = tuple(name for name in results.axes if name not in uncertain)
    design, case = results.codes(chosen), results.codes(uncertain)
    cases, designs = int(case.max()) + 1, int(design.max()) + 1
    values = np.where(results.good, results.columns[least], math.nan)
    known = np.isfinite(values)
    count = np.bincount(design[known], minlength=designs)
    whole = count == cases
    if not whole.any():
        return None
    worst = np.full(designs, -math.inf)
    np.maximum.at(worst, design[known], values[known])
    mean = np.bincount(design[known], weights=values[known], minlength=designs) / np.maximum(
        count, 1
    )

    def robust(of: Array) -> RobustDesign:
        at = int(np.argmin(np.where(whole, of, math.inf)))
        row = int(np.argmax(design == at))
        values = {name: results.columns[name][row] for name in chosen}
        return RobustDesign(values, float(worst[at]), float(mean[at]), cases)

    return RobustBest(robust(worst), robust(mean), int(whole.sum()), int((~whole).sum()))


@dataclass(frozen=True)
class MainEffect:
    """Main effect of one axis, averaged over all others."""

    axis: str
    share: float
    """Fraction of the variance due to this axis alone (0…1), the first-order Sobol' index."""
    least_at: Any
    least: float
    """Mean of the column at the value, or in the part of the range, where that is least."""
    most_at: Any
    most: float


def main_effects(results: Results, column: str) -> tuple[MainEffect, ...]:
    """The main effect of every axis on a column, the strongest first; ranges in tenths, or in fewer parts."""
    values = results.columns[column]
    known = results.good & np.isfinite(values)
    if known.sum() < 2 or float(np.var(values[known])) == 0.0:
        return ()
    shares = [
        _effect(
            axis, *_levels(results.columns[axis][known], axis in results.sampled), values[known]
        )
        for axis in results.axes
    ]
    return tuple(sorted(shares, key=lambda effect: -effect.share))


def _effect(axis: str, levels: list[Any], code: Integers, values: Array) -> MainEffect:
    count = np.bincount(code, minlength=len(levels))
    means = np.bincount(code, weights=values, minlength=len(levels)) / np.maximum(count, 1)
    share = float((count * (means - values.mean()) ** 2).sum() / count.sum() / np.var(values))
    low = int(np.argmin(np.where(count > 0, means, math.inf)))
    high = int(np.argmax(np.where(count > 0, means, -math.inf)))
    return MainEffect(axis, share, levels[low], float(means[low]), levels[high], float(means[high]))


def _levels(at: NDArray[Any], sampled: bool) -> tuple[list[Any], Integers]:
    """The values of an axis, or the middles of parts of its range where it has many; and which one each row has."""
    levels, code = np.unique(at if at.dtype == np.float64 else at.astype(str), return_inverse=True)
    if at.dtype == np.float64 and (sampled or len(levels) > _LEAST_DIVIDED):
        parts = min(10, max(2, len(levels) // _LEAST_PER_PART)) if sampled else 10
        low, part = float(levels[0]), float(levels[-1] - levels[0]) / parts or 1.0
        middles = [low + (k + 0.5) * part for k in range(parts)]
        return middles, np.clip(np.floor((at - low) / part), 0, parts - 1).astype(np.int64)
    return levels.tolist(), code.astype(np.int64)
