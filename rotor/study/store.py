"""The results of a study on disk: a folder with one Parquet file per chunk, each written completely or not at all.

`pandas.read_parquet(FOLDER)` reads them as one table. All other names begin with `_` or a dot, which Parquet readers
ignore.

"""

import hashlib
import importlib
import json
import os
import random
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from rotor.study.chunks import StudyProvenance, describe
from rotor.study.study import Study
from rotor.study.study_file import StudyFile

ABOUT, SOURCE = "_study.json", "_study.toml"
"""What the folder holds, for people and programs; a copy of the study file."""


def sha256(text: str) -> str:
    """Of a study file's text."""
    return hashlib.sha256(text.encode()).hexdigest()


class StoreError(RuntimeError):
    """A chunk could not be written; earlier chunks are kept."""


class Store:
    """The folder of one study, open for writing."""

    def __init__(self, folder: str | Path, file: StudyFile, provenance: StudyProvenance) -> None:
        """Begin or continue a folder. ValueError for one that belongs to another study, or that somebody writes to."""
        self.folder, self.study = Path(folder), file.study
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            known = read_about(self.folder) if (self.folder / ABOUT).exists() else None
            if known is None and any(self.folder.iterdir()):
                raise ValueError(f"folder {str(folder)!r} holds other files: give a new one with --out DIR")
            if known is not None:
                self._check(known, provenance)
            self._lock = _hold(self.folder)
            self._write(SOURCE, file.text.encode())
            self._write(ABOUT, _about(file.study, provenance, known))
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
            with suppress(OSError):
                (self.folder / f".{name}.part").unlink()
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
        with part.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        part.replace(self.folder / name)


def read_about(folder: str | Path) -> dict[str, Any]:
    """What a folder's `_study.json` says; ValueError where it is none of ours."""
    path = Path(folder) / ABOUT
    try:
        about: Any = json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        raise ValueError(f"{str(folder)!r} holds no study: give the --out DIR of a study") from None
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ValueError(f"{str(path)!r} cannot be read ({error}): give the --out DIR of a study") from None
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
    handle = os.open(folder / "_lock", os.O_RDWR | os.O_CREAT, 0o644)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(handle)
        raise ValueError(f"another run writes to {str(folder)!r}: wait for it, or give another --out DIR") from None
    return handle
