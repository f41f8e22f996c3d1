"""Reads the results of a study, complete or still running, and rebuilds the design of a row."""

import importlib
import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from rotor.design.design import Design
from rotor.study.chunks import CONVERGED
from rotor.study.point import design_of
from rotor.study.quantities import PLAIN, QUANTITIES, Value, concept_with_breaks
from rotor.study.store import read_about

Ints = NDArray[np.int64]


_LARGEST = 400_000_000
"""Bytes that a single file may unpack to."""


@dataclass(frozen=True, eq=False)
class Results:
    """The results of a study, complete or partial."""

    about: dict[str, Any]
    """The folder's `_study.json`, or the metadata of one file."""
    axes: tuple[str, ...]
    columns: dict[str, NDArray[Any]]
    """Numbers as float64 with NaN where a row has none, texts as objects; (rows,)."""

    @property
    def rows(self) -> int:
        return len(self.columns["point"])

    @property
    def points(self) -> int:
        """Number of points of the whole study."""
        return int(self.about.get("points", self.rows))

    @property
    def good(self) -> NDArray[np.bool_]:
        """Rows with a result, (rows,)."""
        return self.columns["status"] == CONVERGED

    def row_of(self, point: int) -> int | None:
        """Row of a point by its number; None if it is missing."""
        found = np.flatnonzero(self.columns["point"] == point)
        return int(found[0]) if found.size else None

    def unit(self, column: str) -> str:
        return str(self.about.get("units", {}).get(column, ""))

    def numeric(self, column: str) -> bool:
        return self.columns[column].dtype == np.float64

    @property
    def sampled(self) -> tuple[str, ...]:
        """Axes that are sampled together, where the whole folder was read."""
        said = self.about.get("axes")
        ranges = cast(dict[str, Any], said) if isinstance(said, dict) else {}
        return tuple(name for name in self.axes if isinstance(ranges.get(name), dict))

    def codes(self, names: tuple[str, ...]) -> Ints:
        """The same number for rows that agree in all these columns, 0 upward, (rows,)."""
        code = np.zeros(self.rows, dtype=np.int64)
        for name in names:
            values = self.columns[name]
            _, own = np.unique(values if self.numeric(name) else values.astype(str), return_inverse=True)
            code = np.unique(code * (int(own.max(initial=0)) + 1) + own, return_inverse=True)[1].astype(np.int64)
        return code


def read_results(folder: str | Path, *, texts: bool = True) -> Results:
    """The results in a folder; without `texts` those columns are left out but for axes and status, which is quicker.

    ValueError with one sentence for a folder without a study, or without a result yet.
    """
    about = read_about(folder)
    paths = sorted(Path(folder).glob("chunk-*.parquet"))
    if not paths:
        raise ValueError(f"folder {str(folder)!r} has no finished chunk yet: let the study run longer")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    axes = tuple(str(name) for name in about["axes"])
    names = _wanted(parquet.read_schema(paths[0]), axes, texts)
    return Results(about, axes, columns_from(parquet.read_table([str(path) for path in paths], columns=names)))


def read_file(content: bytes, name: str) -> Results:
    """The results in one Parquet file of a study, or in several that were joined, without texts as `read_results`.

    ValueError for any other file, and for one that would fill the memory: some bytes can stand for millions of rows.
    """
    parquet: Any = importlib.import_module("pyarrow.parquet")
    arrow: Any = importlib.import_module("pyarrow")
    try:
        file = parquet.ParquetFile(arrow.BufferReader(content))
        metadata: dict[bytes, bytes] = file.schema_arrow.metadata or {}
        said: dict[str, Any] = {
            key.decode(): value.decode() for key, value in metadata.items() if key != b"ARROW:schema"
        }
        foreign = ValueError(f"{name!r} is not a result of a study: give a chunk-….parquet of its folder")
        if said.get("format") != "rotor-explorer study":
            raise foreign
        try:
            said |= {key: json.loads(said[key]) for key in ("axes", "given", "units", "models")}
        except (KeyError, json.JSONDecodeError):
            raise foreign from None
        about, axes = file.metadata, tuple(said["axes"])
        if not {"point", "status", "power_total_w", *axes} <= set(file.schema_arrow.names):
            raise foreign
        packed = sum(about.row_group(k).total_byte_size for k in range(about.num_row_groups))
        size = max(packed, 8 * about.num_rows * about.num_columns)
        if size > _LARGEST:
            raise ValueError(
                f"{name!r} unpacks to {size / 1e6:,.0f} MB, more than {_LARGEST / 1e6:.0f} MB: "
                "give a smaller file, or open the study's folder"
            )
        names = _wanted(file.schema_arrow, axes, texts=False)
        table = parquet.read_table(arrow.BufferReader(content), columns=names, read_dictionary=names)
    except (OSError, arrow.ArrowException) as error:
        raise ValueError(f"{name!r} is not a Parquet file ({error}): give a chunk-….parquet of a study") from None
    return Results(said, axes, columns_from(table))


def _wanted(schema: Any, axes: tuple[str, ...], texts: bool) -> list[str]:
    """Names of the columns to read: numbers, axes and status, and the other texts on demand."""
    arrow: Any = importlib.import_module("pyarrow")
    return [one.name for one in schema if texts or not arrow.types.is_string(one.type) or one.name in (*axes, "status")]


def columns_from(table: Any) -> dict[str, NDArray[Any]]:
    """An Arrow table's columns as arrays; equal texts are one object."""
    arrow: Any = importlib.import_module("pyarrow")
    made: dict[str, NDArray[Any]] = {}
    for name in table.column_names:
        column = table.column(name)
        if arrow.types.is_string(column.type) or arrow.types.is_dictionary(column.type):
            coded = column.dictionary_encode().combine_chunks()
            words = np.array([*coded.dictionary.to_pylist(), None], dtype=object)
            made[name] = words[coded.indices.fill_null(len(words) - 1).to_numpy()]
        else:
            made[name] = column.cast(arrow.float64()).to_numpy()
    return made


def design_of_row(results: Results, row: int) -> Design:
    """The design of a row (0 upward). ValueError for one that has no blade, or is of a rotor file that is not here."""
    given: dict[str, Any] = results.about.get("given", {})
    values: dict[str, Value] = {name: value for name, value in given.items() if name in PLAIN}
    values |= {name: results.columns[name][row] for name in results.axes if name in PLAIN}
    blade = {
        name: float(results.columns[name][row])
        for name in results.columns
        if name in QUANTITIES and name not in PLAIN and math.isfinite(results.columns[name][row])
    }
    design = design_of({name: value for name, value in values.items() if name != "concept"}, {})
    if "concept" not in values:
        return design
    concept, held = concept_with_breaks(str(values["concept"]), blade)
    if len(held) < len(concept.parameters):
        raise ValueError(f"point {row} found no blade: choose another one")
    return concept.apply(design, [held[one.name] for one in concept.parameters])
