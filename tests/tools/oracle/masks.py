"""What differs from run to run, or from machine to machine, taken out of a text: it says nothing about the program."""

import hashlib
import re
from calendar import month_name
from collections.abc import Sequence
from importlib.metadata import version

MASK = "…"
"""Stands for what was taken out."""
NUMBER = r"\d[\d.,\u2009\u202f]*"
"""A printed number, which may have narrow blanks between its thousands."""
MASKED_KEYS = frozenset(
    ("elapsed", "elapsed_ms", "elapsed_s", "seconds", "serial", "created", "date")
)
"""Names of values that are times or counters of a run."""
_VERSIONED = ("rotor-explorer", "numpy", "scipy", "numba", "viser", "matplotlib")
"""Packages whose version is written into reports and files."""
_MONTHS = "|".join(month_name[1:])
_PATTERNS: Sequence[tuple[re.Pattern[str], str]] = (
    # Addresses of objects in memory.
    (re.compile(r"\b0x[0-9a-f]{6,}\b"), f"0x{MASK}"),
    # Times that something took.
    (re.compile(rf"(?:{NUMBER}\s?ms|(?<=grid, ){NUMBER}\s?s)\b"), f"{MASK} ms"),
    (re.compile(rf"\b(in|after|about) {NUMBER}\s?s\b"), rf"\1 {MASK} s"),
    (re.compile(rf"(· |evaluations, ){NUMBER}\s?s\b"), rf"\1{MASK} s"),
    (re.compile(rf"{NUMBER}/(min|s)\b"), rf"{MASK}/\1"),
    (re.compile(r'(elapsed\w*(?:\\?": |=))[\d.e+-]+'), rf"\1{MASK}"),
    (re.compile(rf"([kM]B \(){NUMBER}\s?s\)"), rf"\1{MASK} s)"),
    # Where a server listens.
    (re.compile(r"127\.0\.0\.1:\d+"), f"127.0.0.1:{MASK}"),
    # A day, and the hour of it.
    (re.compile(r"\b20\d\d-\d\d-\d\d([T ]\d\d:\d\d(:\d\d)?([+-]\d\d:?\d\d|Z)?)?"), MASK),
    (re.compile(rf"\b\d\d? (?:{_MONTHS}) 20\d\d(?:, \d\d:\d\d)?"), MASK),
    # The commit of a checkout, which a plus marks where files differ from it.
    (re.compile(r'\b(commit|git)((?:\\?":)? \\?"?)[0-9a-f]{7,40}\+?'), rf"\1\2{MASK}"),
    *(
        (re.compile(rf"(?i)\b({package}\D{{1,4}}){re.escape(version(package))}"), rf"\1{MASK}")
        for package in _VERSIONED
    ),
)


_PACKED = re.compile(r"\S{2000,}")
"""Pictures and arrays as text."""


def masked(text: str, folders: Sequence[str] = ()) -> str:
    """The text without times, dates, ports, addresses, versions and the paths of these folders.

    Of packed data it has a digest.
    """
    # The longest first: one folder may lie in another.
    for folder in sorted(folders, key=len, reverse=True):
        text = text.replace(folder, MASK)
    for pattern, words in _PATTERNS:
        text = pattern.sub(words, text)
    return _PACKED.sub(_digest, text)


def _digest(packed: re.Match[str]) -> str:
    """Stands for every letter of what nobody reads."""
    return f"⟨{len(packed[0])} letters {hashlib.sha256(packed[0].encode()).hexdigest()[:32]}⟩"
