"""One chunk of a study: its points in order, and the Parquet file of their rows."""

import ctypes
import importlib
import io
import json
import os
import socket
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from rotor.assets import package_version
from rotor.design.design import preset_models
from rotor.study.point import Row, WarmStarts, evaluate
from rotor.study.quantities import QUANTITIES, Value
from rotor.study.study import Column, Study, columns_of

_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3  # malloc.h of glibc

CONVERGED = "converged"
"""Status of a row with a result."""


@dataclass(frozen=True)
class StudyProvenance:
    """Provenance stored in every file of a study."""

    version: str
    commit: str | None
    file_sha256: str


@dataclass(frozen=True)
class FinishedChunk:
    """A finished chunk, with its file as bytes: workers need no access to the folder."""

    chunk: int
    rows: int
    failures: int
    seconds: float
    """Processor time."""
    worker: str
    """Machine and process."""
    content: bytes
    """Parquet."""


class VersionMismatch(ValueError):
    """A worker has another version of this package."""


def evaluate_points(study: Study, first: int, last: int) -> list[Row]:
    """Rows of the points first … last − 1; each starts from the results of those before."""
    warm = WarmStarts(study.points.ranges)
    rows: list[Row] = []
    for number, values in enumerate(study.values(first, last), start=first):
        rows.append({"point": number, **evaluate(values, study, warm)})
    return rows


def evaluate_chunk(study: Study, chunk: int, provenance: StudyProvenance) -> FinishedChunk:
    """Compute a chunk on a worker. VersionMismatch if its package version differs from the command's."""
    if package_version() != provenance.version:
        raise VersionMismatch(
            f"a worker has rotor-explorer {package_version()}, this command {provenance.version}: "
            "install the same version on every worker"
        )
    keep_freed_memory()
    begin = time.process_time()
    rows = evaluate_points(study, *study.span(chunk))
    content = parquet_of(
        rows, columns_of(study), describe(study, provenance) | {"chunk": str(chunk), "worker": _worker()}
    )
    failures = sum(row["status"] != CONVERGED for row in rows)
    return FinishedChunk(chunk, len(rows), failures, time.process_time() - begin, _worker(), content)


@cache
def keep_freed_memory() -> None:
    """Keep up to 64 MB of freed memory in this process (glibc only).

    Dask workers return freed memory above 64 kB at once. A trim allocates arrays of 38 kB to 1 MB all the time, and
    spent a third of its processor time on page faults.
    """
    with suppress(OSError, AttributeError, TypeError):
        libc = ctypes.CDLL(None)
        libc.mallopt(_M_TRIM_THRESHOLD, 64 * 2**20)
        libc.mallopt(_M_MMAP_THRESHOLD, 32 * 2**20)


def _worker() -> str:
    return f"{socket.gethostname()}:{os.getpid()}"


def describe(study: Study, provenance: StudyProvenance) -> dict[str, str]:
    """The provenance in the metadata of every file."""
    given = dict(study.given)
    return {
        "format": "rotor-explorer study",
        "format_version": "1",
        "title": study.title,
        "package_version": provenance.version,
        "commit": provenance.commit or "",
        "study": study.fingerprint,
        "study_file_sha256": provenance.file_sha256,
        "preset": str(given.get("preset", "as the column says" if "preset" in study.axis_names else "flight")),
        "models": json.dumps(_models(study)),
        "axes": json.dumps(study.axis_names),
        "given": json.dumps(given),
        "units": json.dumps({column.name: column.unit for column in columns_of(study) if column.unit}),
    }


def _models(study: Study) -> dict[str, Value]:
    """Models shared by all points: those of the preset with the changes of the study; axes are columns."""
    given = {name: value for name, value in study.given if QUANTITIES[name].section == "models"}
    if "preset" in study.axis_names:
        return given
    models = asdict(preset_models(str(given.get("preset", "flight"))))
    return {name: value for name, value in models.items() if name not in study.axis_names} | given


def parquet_of(rows: list[Row], columns: tuple[Column, ...], about: dict[str, str]) -> bytes:
    """The rows as a Parquet file: units on each column, `about` on the whole, null where a row has no value."""
    arrow: Any = importlib.import_module("pyarrow")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    kinds = {"number": arrow.float64(), "count": arrow.int64(), "text": arrow.string()}
    schema = arrow.schema(
        [arrow.field(one.name, kinds[one.kind], metadata={"unit": one.unit} if one.unit else None) for one in columns],
        metadata=about,
    )
    table = arrow.table({one.name: [row.get(one.name) for row in rows] for one in columns}, schema=schema)
    out = io.BytesIO()
    parquet.write_table(table, out, compression="zstd")
    return out.getvalue()
