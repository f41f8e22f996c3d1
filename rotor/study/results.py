"""The results of a study on disk: written chunk by chunk, read complete or still running.

A folder has one Parquet file per chunk, each written completely or not at all. `pandas.read_parquet(FOLDER)` reads
them as one table. All other names begin with `_` or a dot, which Parquet readers ignore. A file that a visitor uploads
is read in a process of its own, one at a time: some kilobytes may unpack to gigabytes.
"""

import hashlib
import importlib
import json
import math
import os
import pickle
import random
import sys
import threading
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from rotor.design.design import Design
from rotor.files.make_design import Tell, warn
from rotor.spawn import start_process
from rotor.study.chunks import CONVERGED, StudyProvenance, describe
from rotor.study.point import design_of
from rotor.study.study import PLAIN, QUANTITIES, Study, Value, concept_with_breaks
from rotor.study.study_file import StudyFile
from rotor.user_input import brief, is_file, make_folder, read_bytes, refusing, shorten

ABOUT, SOURCE = "_study.json", "_study.toml"
"""The description of the folder, and a copy of the study file."""
_MEMORY = 2 * 10**9
"""[bytes] beyond what the process has after its start; an accepted file unpacks to a fifth of it."""
_PATIENCE = 60.0
"""[s]"""
_one_at_a_time = threading.Lock()


def sha256(text: str) -> str:
    """SHA-256 of a study file's text, as hexadecimal digits."""
    return hashlib.sha256(text.encode()).hexdigest()


class StoreError(RuntimeError):
    """A chunk could not be written; earlier chunks are kept."""


_LOCK = "_lock"
"""Left behind by a run that found no room for more."""


class Store:
    """The folder of one study, open for writing."""

    def __init__(self, folder: str | Path, file: StudyFile, provenance: StudyProvenance) -> None:
        """Begin or continue a folder. ValueError for one that belongs to another study, or that somebody writes to."""
        self.folder, self.study = Path(folder), file.study
        try:
            make_folder(self.folder)
            known = read_about(self.folder) if (self.folder / ABOUT).exists() else None
            if known is None and any(one.name != _LOCK for one in self.folder.iterdir()):
                raise ValueError(f"folder {str(folder)!r} holds other files: give a new one with --out DIR")
            if known is not None:
                self._check(known, provenance)
            self._lock = _hold(self.folder)
            self._write(ABOUT, _about(file.study, provenance, known))  # First: a folder without it is not a study's.
            self._write(SOURCE, file.text.encode())
            for left in self.folder.glob(".*.part"):  # Left by a run that was killed while writing.
                left.unlink()
        except OSError as error:
            raise ValueError(f"cannot write to {str(folder)!r} ({error.strerror}): give --out DIR") from None

    def close(self) -> None:
        """Release the folder."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def missing(self) -> list[int]:
        """Missing chunks in random order, so that an interrupted run covers the whole study.

        A file of another study, or one that cannot be read, counts as missing.
        """
        parquet: Any = importlib.import_module("pyarrow.parquet")
        found: set[int] = set()
        for path in self.folder.glob("chunk-*.parquet"):
            with suppress(Exception):  # A damaged file counts as missing.
                about = parquet.read_metadata(path)
                number = int(about.metadata[b"chunk"])
                first, last = self.study.span(number)
                if about.metadata[b"study"].decode() == self.study.fingerprint and about.num_rows == last - first:
                    found.add(number)
        left = [chunk for chunk in range(self.study.chunks) if chunk not in found]
        random.Random(0).shuffle(left)
        return left

    def keep(self, chunk: int, content: bytes) -> None:
        """Store a chunk. StoreError, for example where the disk is full, leaves the folder as it was."""
        name = f"chunk-{chunk:06d}.parquet"
        try:
            self._write(name, content)
        except OSError as error:
            raise StoreError(
                f"cannot write to {str(self.folder)!r} ({error.strerror}): free the disk or fix its permissions, and "
                "run the same "
                "command again; finished chunks are kept"
            ) from None

    def _check(self, known: dict[str, Any], provenance: StudyProvenance) -> None:
        if known.get("study") != self.study.fingerprint:
            raise ValueError(
                f"folder {str(self.folder)!r} holds another study ({known.get('title')}): give another --out DIR, "
                "or the study file as it was"
            )
        if known.get("package_version") != provenance.version:
            raise ValueError(
                f"folder {str(self.folder)!r} was computed by rotor-explorer {known.get('package_version')}, this is "
                f"{provenance.version}: give another --out DIR, or install that version"
            )

    def _write(self, name: str, content: bytes) -> None:
        part = self.folder / f".{name}.part"
        try:
            with part.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            part.replace(self.folder / name)
        except OSError:
            with suppress(OSError):
                part.unlink()
            raise


def read_about(folder: str | Path) -> dict[str, Any]:
    """The contents of a folder's `_study.json`; ValueError if no study wrote it."""
    path = Path(folder) / ABOUT
    if not is_file(path):
        raise ValueError(f"{shorten(str(folder))!r} holds no study: give the --out DIR of a study")
    remedy = "give the --out DIR of a study"
    with refusing(f"{shorten(str(path))!r}", remedy):
        about: Any = json.loads(read_bytes(path, "description", remedy))
    if not isinstance(about, dict) or about.get("format") != "rotor-explorer study":  # pyright: ignore[reportUnknownMemberType]
        raise ValueError(f"{str(path)!r} is not a study of this program: give the --out DIR of a study")
    return about  # pyright: ignore[reportUnknownVariableType]


def _about(study: Study, provenance: StudyProvenance, known: dict[str, Any] | None) -> bytes:
    places = study.points
    axes: dict[str, Any] = {axis.name: list(axis.values) for axis in places.axes}
    if places.sample is not None:
        axes |= {name: {"low": low, "high": high} for name, low, high in places.sample.ranges}
    said = describe(study, provenance)
    record = {
        **said,
        "models": json.loads(said["models"]),
        "units": json.loads(said["units"]),
        "axes": axes,
        "sample": None if places.sample is None else [places.sample.method, places.sample.count, places.sample.seed],
        "given": json.loads(said["given"]),
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
        raise ValueError(f"another run writes to {str(folder)!r}: wait for it, or give another --out DIR") from None
    return handle


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
    except MemoryError:  # One of Arrow's exceptions too.
        raise
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


def design_of_row(results: Results, row: int, tell: Tell = warn) -> Design:
    """The design of a row (0 upward); `tell` as in `current_model`.

    ValueError for one that has no blade, or is of a rotor file that is not here.
    """
    given: dict[str, Any] = results.about.get("given", {})
    values: dict[str, Value] = {name: value for name, value in given.items() if name in PLAIN}
    values |= {name: results.columns[name][row] for name in results.axes if name in PLAIN}
    blade = {
        name: float(results.columns[name][row])
        for name in results.columns
        if name in QUANTITIES and name not in PLAIN and math.isfinite(results.columns[name][row])
    }
    design = design_of({name: value for name, value in values.items() if name != "concept"}, {}, tell)
    if "concept" not in values:
        return design
    concept, held = concept_with_breaks(str(values["concept"]), blade)
    if len(held) < len(concept.parameters):
        raise ValueError(f"point {row} found no blade: choose another one")
    return concept.apply(design, [held[one.name] for one in concept.parameters])


def read_bounded(content: bytes, name: str, *, memory: int = _MEMORY, patience: float = _PATIENCE) -> Results:
    """As `read_file`. ValueError also for a file that needs more memory [bytes] or time [s] to read."""
    with _one_at_a_time:
        ours, theirs = Pipe(duplex=False)
        reader = start_process(_read, (theirs, content, name, memory), "parquet")
        theirs.close()
        try:
            answer = pickle.loads(ours.recv_bytes()) if ours.poll(patience) else "it takes too long to read"
        except EOFError:
            answer = "it needs too much memory to read"
        finally:
            ours.close()
            reader.kill()
            reader.join()
    if isinstance(answer, Results):
        return answer
    if answer.startswith("it "):
        raise ValueError(f"{shorten(name)!r} cannot be shown ({answer}): give a smaller file, or the study's folder")
    raise ValueError(answer)


def _read(answer: Connection, content: bytes, name: str, memory: int) -> None:
    """In the other process: send the results, or a sentence."""
    made: Results | str
    try:
        importlib.import_module("pyarrow.parquet")  # Its own code is not counted.
        limit_memory(memory)
        made = read_file(content, name)
        answer.send_bytes(pickle.dumps(made))
        return
    except MemoryError:  # Arrow's is one too.
        made = "it needs too much memory to read"
    except Exception as error:
        made = brief(error)
    answer.send_bytes(pickle.dumps(made))


def limit_memory(memory: int) -> None:
    """Bound the address space of this process (Linux; elsewhere the sizes that the file itself gives must do)."""
    if sys.platform != "linux":
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    most = pages * resource.getpagesize() + memory
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
