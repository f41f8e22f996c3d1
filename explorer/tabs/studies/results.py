"""The results of studies beneath a folder of this machine: to choose from, and to read."""

import json
import os
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from rotor.study.results import ABOUT, Results, read_results

_DEPTH = 3
_MOST_FOLDERS = 3000
"""Looked into: a home folder must not hold the page up."""


@dataclass(frozen=True)
class FoundStudy:
    """One result."""

    path: Path
    title: str

    def label(self, root: Path) -> str:
        """As the menu shows it."""
        return os.path.relpath(self.path, root)


def find_studies(root: Path) -> tuple[FoundStudy, ...]:
    """Folders that hold a study, at most so deep beneath `root`, which itself may be one; in order of their names."""
    found: list[FoundStudy] = []
    looked, level = 0, [root]
    for _ in range(_DEPTH + 1):
        below: list[Path] = []
        for folder in level:
            looked += 1
            if looked > _MOST_FOLDERS:
                break
            if (folder / ABOUT).is_file():
                found.append(FoundStudy(folder, _title(folder)))
                continue  # A study has nothing beneath it.
            with suppress(OSError):
                below += [one for one in sorted(folder.iterdir()) if one.is_dir() and one.name[0] not in "._"]
        level = below
    return tuple(sorted(found, key=lambda one: one.path))


def open_study(path: Path) -> Results:
    """The results in a folder, as far as they are there; read once for all pages. ValueError with one sentence."""
    chunks = [one.stat().st_mtime_ns for one in path.glob("chunk-*.parquet")]
    return _read(path, len(chunks), max(chunks, default=0))


@lru_cache(maxsize=3)
def _read(path: Path, chunks: int, newest: int) -> Results:
    del chunks, newest  # They only tell a study that has gone on from what was read of it before.
    return read_results(path, texts=False)


def _title(folder: Path) -> str:
    try:
        return str(json.loads((folder / ABOUT).read_text(encoding="utf-8"))["title"])
    except (OSError, ValueError, KeyError, TypeError):
        return ""
