"""Chunks of a study: the points of one in order, its Parquet file, and the folder of all.

A folder has one file per chunk, each written completely or not at all. `pandas.read_parquet(FOLDER)` reads them as one
table. All other names begin with `_` or a dot, which Parquet readers ignore. Each file holds a digest of all its other
bytes before its footer, where Parquet readers do not look.
"""

import ctypes
import hashlib
import io
import json
import logging
import os
import random
import socket
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

from rotor.design.design import preset_models
from rotor.study.point import Row, WarmStarts, evaluate, trims_in_step
from rotor.study.study import QUANTITIES, Study, Value, columns_of
from rotor.study.study_file import StudyFile
from rotor.support.assets import package_version
from rotor.support.blas_threads import one_blas_thread
from rotor.support.user_input import (
    extra_module,
    is_file,
    make_folder,
    read_bytes,
    refusing,
    shorten,
    write_whole,
)
from rotor.trim.many import BATCH

ABOUT, SOURCE, _LOCK = "_study.json", "_study.toml", "_lock"
"""The description of the folder, a copy of the study file, and a lock, left behind by a run that found no room."""
_log = logging.getLogger(__name__)
_DIGEST = 32
"""[bytes]"""
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3  # malloc.h of glibc

CONVERGED = "converged"
"""Status of a row with a result."""


@dataclass(frozen=True)
class StudyProvenance:
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
    """[s]"""
    worker: str
    """Machine and process."""
    content: bytes
    """Parquet."""


class VersionMismatch(ValueError):
    """A worker has another version of this package."""


def evaluate_points(study: Study, first: int, last: int) -> list[Row]:
    """Rows of the points first … last − 1; each starts from the results of those before.

    Points one after another that differ in their twist alone are trimmed in step.
    """
    warm, rows, values = WarmStarts(study.points.ranges), list[Row](), study.values(first, last)
    while len(rows) < len(values):
        left = values[len(rows) : len(rows) + BATCH]
        trims = trims_in_step(left, study)
        rows += [
            evaluate(point, study, warm, trim) for point, trim in zip(left, trims, strict=False)
        ]
    return [{"point": number, **row} for number, row in enumerate(rows, start=first)]


@one_blas_thread()
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
    worker = f"{socket.gethostname()}:{os.getpid()}"
    content = _parquet(
        rows, study, describe(study, provenance) | {"chunk": chunk, "worker": worker}
    )
    failures = sum(row["status"] != CONVERGED for row in rows)
    return FinishedChunk(chunk, len(rows), failures, time.process_time() - begin, worker, content)


@cache
def keep_freed_memory() -> None:
    """Keep up to 64 MB of freed memory in this process (glibc only).

    Workers of Dask return freed memory above 64 kB at once. A trim allocates larger arrays all the time, and lost
    much of its processor time to page faults.
    """
    with suppress(OSError, AttributeError, TypeError):
        libc = ctypes.CDLL(None)
        libc.mallopt(_M_TRIM_THRESHOLD, 64 * 2**20)
        libc.mallopt(_M_MMAP_THRESHOLD, 32 * 2**20)


def describe(study: Study, provenance: StudyProvenance) -> dict[str, Any]:
    """The provenance that goes into the metadata of every file and the description of the folder."""
    given = dict(study.given)
    return {
        "format": "rotor-explorer study",
        "format_version": "2",
        "title": study.title,
        "package_version": provenance.version,
        "commit": provenance.commit or "",
        "study": study.fingerprint,
        "study_file_sha256": provenance.file_sha256,
        "preset": str(
            given.get("preset", "as the column says" if "preset" in study.axis_names else "flight")
        ),
        "models": _models(study),
        "axes": list(study.axis_names),
        "given": given,
        "units": {column.name: column.unit for column in columns_of(study) if column.unit},
    }


def _models(study: Study) -> dict[str, Value]:
    """Models shared by all points: those of the preset with the changes of the study; axes are columns."""
    given = {name: value for name, value in study.given if QUANTITIES[name].section == "models"}
    if "preset" in study.axis_names:
        return given
    models = asdict(preset_models(str(given.get("preset", "flight"))))
    return {
        name: value
        for name, value in models.items()
        if value is not None and name not in study.axis_names
    } | given


def arrow_modules() -> tuple[Any, Any]:
    """`pyarrow` and `pyarrow.parquet`; MissingExtra with one sentence where they are not installed."""
    what = "the results of a study are Parquet files, which"
    return extra_module("pyarrow", what), extra_module("pyarrow.parquet", what)


def _parquet(rows: list[Row], study: Study, about: dict[str, Any]) -> bytes:
    """The rows as a Parquet file: units on each column, `about` on the whole, null where a row has no value."""
    arrow, parquet = arrow_modules()
    kinds = {"number": arrow.float64(), "count": arrow.int64(), "text": arrow.string()}
    fields = [
        arrow.field(
            name.name, kinds[name.kind], metadata={"unit": name.unit} if name.unit else None
        )
        for name in columns_of(study)
    ]
    # What pandas reads into `attrs` of its data frame.
    about = about | {"PANDAS_ATTRS": {"units": about["units"]}}
    texts = {
        key: value if isinstance(value, str) else json.dumps(value) for key, value in about.items()
    }
    table = arrow.Table.from_pylist(rows, schema=arrow.schema(fields, metadata=texts))
    out = io.BytesIO()
    parquet.write_table(table, out, compression="zstd")
    content, footer = out.getvalue(), _footer(out.getvalue())
    return content[:footer] + hashlib.sha256(content).digest() + content[footer:]


def _footer(content: bytes) -> int:
    """Where the footer of a Parquet file begins: its length and four letters end the file."""
    return len(content) - 8 - int.from_bytes(content[-8:-4], "little")


def is_undamaged(content: bytes) -> bool:
    """Whether a chunk is as it was written. Not every damage is an error of its reader: some change a number."""
    footer = _footer(content)
    start = footer - _DIGEST
    return (
        start > 0
        and hashlib.sha256(content[:start] + content[footer:]).digest() == content[start:footer]
    )


class StudyFolderError(RuntimeError):
    """A chunk could not be written, which leaves earlier ones as they were, or is not of this study."""


class StudyFolder:
    """The folder of one study, open for writing."""

    def __init__(self, folder: str | Path, file: StudyFile, provenance: StudyProvenance) -> None:
        """Begin or continue a folder. ValueError for one that belongs to another study, or that somebody writes to."""
        self.folder, self.study, self.provenance = Path(folder), file.study, provenance
        try:
            make_folder(self.folder)
            known = read_about(self.folder) if (self.folder / ABOUT).exists() else None
            if known is None and any(path.name != _LOCK for path in self.folder.iterdir()):
                raise ValueError(
                    f"folder {str(folder)!r} holds other files: give a new one with --out DIR"
                )
            if known is not None:
                self._check(known, provenance)
            self._lock = _hold(self.folder)
            # Written first: a folder without it is not a study.
            write_whole(self.folder / ABOUT, _about(file.study, provenance, known))
            write_whole(self.folder / SOURCE, file.text)
            for left in self.folder.glob(".*.part"):  # Left by a run that was killed while writing.
                left.unlink()
        except OSError as error:
            raise ValueError(
                f"cannot write to {str(folder)!r} ({error.strerror}): give --out DIR"
            ) from None

    def close(self) -> None:
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def missing(self, warn: Callable[[str], None] = _log.warning) -> list[int]:
        """Missing chunks in random order, so that an interrupted run covers the whole study.

        A file that is damaged, or of another study, version or commit, is set aside, and `warn` gets a sentence.
        """
        present: set[int] = set()
        for path in sorted(self.folder.glob("chunk-*.parquet")):
            try:
                present.add(self._chunk_in(path))
            except MemoryError:
                raise
            except Exception as error:
                fault = error if isinstance(error, StudyFolderError) else "is damaged"
                path.replace(aside := path.with_name(f"_{path.name}"))
                warn(
                    f"{path.name} {fault}: it is now {aside.name}, and its points are computed again"
                )
        left = [chunk for chunk in range(self.study.chunks) if chunk not in present]
        random.Random(0).shuffle(left)
        return left

    def keep(self, chunk: int, content: bytes) -> None:
        """Store a chunk. StoreError, for example where the disk is full, leaves the folder as it was."""
        try:
            write_whole(self.folder / f"chunk-{chunk:06d}.parquet", content)
        except OSError as error:
            raise StudyFolderError(
                f"cannot write to {str(self.folder)!r} ({error.strerror}): free the disk or fix its permissions, and "
                "run the same command again; finished chunks are kept"
            ) from None

    def _chunk_in(self, path: Path) -> int:
        """The number of a chunk whose file can be used; StudyFolderError for another's, any error for a damaged one."""
        if not is_undamaged(path.read_bytes()):
            raise ValueError
        metadata = arrow_modules()[1].read_metadata(str(path))
        about = {key.decode(): value.decode() for key, value in metadata.metadata.items()}
        if about["study"] != self.study.fingerprint:
            raise StudyFolderError("belongs to another study")
        if (by := _computed_by(about)) != (
            here := _computed_by(describe(self.study, self.provenance))
        ):
            raise StudyFolderError(f"was computed by {by}, this is {here}")
        return int(about["chunk"])

    def _check(self, known: dict[str, Any], provenance: StudyProvenance) -> None:
        if known.get("study") != self.study.fingerprint:
            raise ValueError(
                f"folder {str(self.folder)!r} holds another study ({known.get('title')}): give another --out DIR, "
                "or the study file as it was"
            )
        if (by := _computed_by(known)) != (here := _computed_by(describe(self.study, provenance))):
            raise ValueError(
                f"folder {str(self.folder)!r} was computed by {by}, this is {here}: give another --out DIR, or install "
                "what it was computed by"
            )


def _computed_by(about: dict[str, Any]) -> str:
    """Version and, of a checkout, commit."""
    at = f" at commit {about['commit']}" if about.get("commit") else ""
    return f"rotor-explorer {about.get('package_version')}{at}"


def read_about(folder: str | Path) -> dict[str, Any]:
    """The contents of a folder's `_study.json`; ValueError if no study wrote it."""
    path = Path(folder) / ABOUT
    if not is_file(path):
        raise ValueError(f"{shorten(str(folder))!r} holds no study: give the --out DIR of a study")
    remedy = "give the --out DIR of a study"
    with refusing(f"{shorten(str(path))!r}", remedy):
        about: Any = json.loads(read_bytes(path, "description", remedy))
    if not isinstance(about, dict) or about.get("format") != "rotor-explorer study":  # pyright: ignore[reportUnknownMemberType]
        raise ValueError(
            f"{str(path)!r} is not a study of this program: give the --out DIR of a study"
        )
    return about  # pyright: ignore[reportUnknownVariableType]


def _about(study: Study, provenance: StudyProvenance, known: dict[str, Any] | None) -> bytes:
    places = study.points
    axes: dict[str, Any] = {axis.name: list(axis.values) for axis in places.axes}
    axes |= {name: {"low": low, "high": high} for name, (low, high) in places.sampled.items()}
    record = {
        **describe(study, provenance),
        "axes": axes,
        "sample": None
        if places.sample is None
        else [places.sample.method, places.sample.count, places.sample.seed],
        "points": study.count,
        "chunk": study.chunk,
        "chunks": study.chunks,
        "least": study.show.least,
        "uncertain": list(study.show.uncertain),
        "begun": known["begun"] if known else datetime.now(UTC).isoformat(timespec="seconds"),
    }
    return (json.dumps(record, indent=2, ensure_ascii=False) + "\n").encode()


def _hold(folder: Path) -> int | None:
    """A lock that is released when the process ends; None where the system has no such lock."""
    try:
        import fcntl
    except ImportError:
        return None
    handle = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o644)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(handle)
        raise ValueError(
            f"another run writes to {str(folder)!r}: wait for it, or give another --out DIR"
        ) from None
    return handle
