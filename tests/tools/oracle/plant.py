"""Small faults planted in a copy of the tree, one by one: which of them changes a value?"""

import ast
import os
import random
import resource
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.tools.faults import faults_in, text_with

from .compare import difference, read

LEFT_OUT = (".git", ".venv", "artefacts", "dist", ".hypothesis", ".pytest_cache", "docs")
"""Folders that no value depends on."""
LIKELY_KINDS = {
    "explorer/text": ("text", "panel", "search", "export"),
    "explorer/story": ("text",),
    "explorer/sharing": ("text", "session"),
    "explorer/views": ("panel", "session"),
    "explorer/charts": ("picture", "panel", "search", "export", "session"),
    "explorer/picture": ("picture", "export", "session"),
    "explorer/export": ("export", "session"),
    "explorer/model": ("panel", "text", "search", "session"),
    "explorer/widgets": ("session",),
    "rotor/command": ("command",),
    "rotor/validation": ("command", "text"),
    "rotor/optimisation": ("search", "command"),
    "rotor/study": ("command",),
    "rotor/actuator": ("panel", "command"),
    "rotor": ("physics", "command", "text"),
}
"""By the folder of a fault, the kinds that are most likely to notice it; the others follow."""
LIMIT_S = 900
"""Processor time of one kind [s]: a fault may make a loop endless."""
RunKind = Callable[[Path, str, Path], bool]
"""Writes the values that a checkout has of a kind into a folder; False where it cannot be run."""


class KindFailedError(Exception):
    """A kind that cannot be run even without a fault, which can show none."""


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong in a file."""

    file: str
    line: int
    words: str
    """What stands there, and what in its place."""
    text: str
    """The file with the fault."""

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.words}"


def faults_of(root: Path, files: Sequence[str], count: int, seed: int) -> list[Fault]:
    """So many faults drawn from all that the files, or the files of folders, can have."""
    found = list[tuple[str, int]]()
    texts = dict[str, str]()
    for place in files:
        for path in sorted((root / place).rglob("*.py")) or [root / place]:
            file = str(path.relative_to(root))
            texts[file] = path.read_text("utf-8")
            found += [(file, number) for number in range(len(_faults(ast.parse(texts[file]))))]
    drawn = random.Random(seed).sample(found, min(count, len(found)))
    return [_fault(file, texts[file], number) for file, number in sorted(drawn)]


def plant(
    root: Path, files: Sequence[str], count: int, seed: int, kinds: Sequence[str], run: RunKind
) -> list[Fault]:
    """Print of each fault which kind notices it, and by which value; returns those that none does.

    `KindFailedError` where a kind cannot be run in the tree as it is.
    """
    missed = list[Fault]()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        checkout = shutil.copytree(
            root, folder / "tree", ignore=shutil.ignore_patterns(*LEFT_OUT), symlinks=True
        )
        known = dict[str, dict[str, str]]()
        for fault in faults_of(root, files, count, seed):
            noticed = ""
            for kind in _order(fault.file, kinds):
                if kind not in known:
                    values = _values(checkout, kind, folder, run)
                    if values is None:
                        raise KindFailedError(f"{kind} cannot be run without a fault")
                    known[kind] = values
                noticed = _noticed(checkout, fault, kind, folder, known[kind], run)
                if noticed:
                    break
            print(f"{fault}: {noticed or 'NOT NOTICED'}", flush=True)
            if not noticed:
                missed.append(fault)
    return missed


def _order(file: str, kinds: Sequence[str]) -> list[str]:
    """The kinds, the likeliest first."""
    parts = [part for part in LIKELY_KINDS if file.startswith(f"{part}/")]
    likely = LIKELY_KINDS[max(parts, key=len)] if parts else ()
    first = [kind for kind in likely if kind in kinds]
    return first + [kind for kind in kinds if kind not in first]


def _noticed(
    checkout: Path, fault: Fault, kind: str, folder: Path, known: dict[str, str], run: RunKind
) -> str:
    """What shows a fault, as `text, 3 values, as built/status`; empty where no value of the kind does.

    The checkout has the fault only while the kind is run.
    """
    place = checkout / fault.file
    before = place.read_bytes()
    stat = place.stat()
    place.write_text(fault.text, "utf-8")
    try:
        values = _values(checkout, kind, folder, run)
    finally:
        place.write_bytes(before)
        # With the time of before, the kernels that are kept for the file serve again.
        os.utime(place, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    if values is None:
        return f"{kind} cannot be run"
    found = difference(kind, known, values)
    names = [*found.changed, *found.gone, *found.new]
    return f"{kind}, {len(names)} values, {names[0]}" if names else ""


def _values(checkout: Path, kind: str, folder: Path, run: RunKind) -> dict[str, str] | None:
    """The values of a kind by name; None where it cannot be run."""
    return read(folder, kind) if run(checkout, kind, folder) else None


def limit_processor_time() -> None:
    """End this process once it has taken `LIMIT_S` of processor time."""
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT_S, LIMIT_S))


def _fault(file: str, text: str, number: int) -> Fault:
    """The fault of that number among all that a file with this text can have."""
    tree = ast.parse(text)
    right, words, wrong = _faults(tree)[number]
    return Fault(file, getattr(right, "lineno", 0), words, text_with(tree, right, wrong))


def _faults(tree: ast.Module) -> list[tuple[ast.AST, str, ast.AST]]:
    """Operators, numbers and returned values as `tests.tools.faults` has them, and texts without a word."""
    return faults_in(tree) + list(_texts(tree))


def _texts(tree: ast.Module) -> Iterator[tuple[ast.AST, str, ast.AST]]:
    """Every text of several words without its first, docstrings apart."""
    documentation = {
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and node not in documentation
        ):
            first, _, rest = node.value.partition(" ")
            if first.isalpha() and rest:
                yield node, f"{node.value[:40]!r} without {first!r}", ast.Constant(rest)
