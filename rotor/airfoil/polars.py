"""Polar files: any table whose heading names angle, lift and drag, as XFOIL, XFLR5, airfoil sites, AeroDyn and QBlade
write them, and our own CSV, whose first lines record how it was made.

Mach and Reynolds number are columns, or stand above the heading. Angles may be in radians, where the heading says so,
and run from 0 to 360 deg.
"""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from rotor.airfoil.numbers import STATED, number_of, number_stated
from rotor.support.arrays import Array

COLUMNS = "mach,reynolds,alpha_deg,cl,cd,cm"
"""Heading of the CSV."""


@dataclass(frozen=True, eq=False)
class Polar:
    """Coefficients of one section at one Mach and Reynolds number against angle of attack.

    `alpha_deg` [deg] increases strictly and may have gaps where XFOIL did not converge;
    `cl`, `cd`, `cm` [-] have its shape, cm about the quarter chord. `reynolds` is None where its file says none.
    """

    mach: float
    reynolds: float | None
    alpha_deg: Array
    cl: Array
    cd: Array
    cm: Array


@dataclass(frozen=True, eq=False)
class PolarSet:
    """Polars of one section with one transition setting, in order of Mach and Reynolds number.

    `header` holds the comment lines of the file (source, code version, settings), without `#`; `assumed` what the file
    does not say, and what is taken instead.
    """

    header: tuple[str, ...]
    polars: tuple[Polar, ...]
    assumed: tuple[str, ...] = ()


def read_polars(path: Path) -> PolarSet:
    """The polars in the file `path`, see `parse_polars`."""
    return parse_polars(path.read_text(encoding="utf-8"), path.name)


_NAMES = {
    **dict.fromkeys(("alpha", "alphadeg", "aoa", "aoadeg", "angle", "angleofattack"), "alpha"),
    **dict.fromkeys(("re", "reynolds", "reynoldsnumber"), "reynolds"),
    **dict.fromkeys(("m", "ma", "mach", "machnumber"), "mach"),
}
"""Other names of columns."""
_SECOND_WORDS = ("xtr", "deg", "degrees", "rad", "radians", "of", "attack", "number", "no")
"""Words of a heading that belong to the word before them where blanks part the columns."""
_RADIANS = re.compile(r"\b(?:alpha|aoa|angle)[a-z _]*[^a-z]*_?rad(?:ians?)?\b")
_MOST_ANGLES = 2000
_MOST_POLARS = 60
_HEAD, _LONGEST_HEAD, _LONGEST_HEADING = 80, 20_000, 400
"""Lines and characters above a heading that are looked at, and characters of a heading; AeroDyn writes fifty lines."""
_SAME_ANGLE = 1e-6
"""[deg]"""
_ALIKE = (0.02, 0.002)
"""Rows of one angle are one where no coefficient differs by more than this share of it plus this."""
_LEAST_REYNOLDS = 1000.0
"""A smaller number is one that was not given in full."""
_LARGEST_STEP = (1.0, 0.25)
"""Of c_l, c_d between angles at most `_STEP_DEG` apart, to `_STEPS_TO_DEG`. Our choice; shipped data stay below."""
_STEP_DEG, _STEPS_TO_DEG = 2.0, 30.0
Row = tuple[int, float, float, float, float]
"""Line of the file; angle [deg], c_l, c_d, c_m."""


@dataclass(frozen=True)
class _Heading:
    """The line that names the columns of a table."""

    line: int
    """Counted from 0."""
    mark: str | None
    """Between two columns; None: blanks."""
    at: dict[str, int]
    """Column by name."""
    columns: int
    """Number of names; more of them than of the numbers in a row tell no number's name."""
    radians: bool

    def row(self, line: str) -> tuple[float, ...] | None:
        """Mach, Reynolds number, angle, c_l, c_d and c_m of a line, NaN without such a column; None for other lines."""
        words = _split(line, self.mark)
        places = [self.at.get(name) for name in ("mach", "reynolds", "alpha", "cl", "cd", "cm")]
        if len(words) <= max(place for place in places if place is not None):
            return None
        row = [
            value
            for place in places
            if (value := np.nan if place is None else number_of(words[place])) is not None
        ]
        if len(row) < len(places):
            return None
        row[2] = math.degrees(row[2]) if self.radians else row[2]
        row[2] -= 360.0 if 180.0 < row[2] <= 360.0 else 0.0
        return tuple(row)


def _split(line: str, mark: str | None) -> list[str]:
    return [word.strip(" \t\"'") for word in line.split(mark)]


def _headings(lines: list[str]) -> list[_Heading]:
    found: list[_Heading] = []
    for place, line in enumerate(lines):
        if len(line) > _LONGEST_HEADING or "c" not in line.lower():
            continue
        for mark in (";", ",", None):
            keys = [
                re.sub(r"\([^()]*\)|\[[^]]*\]|[^a-z0-9]", "", word.lower())
                for word in _split(line, mark)
            ]
            keys = keys if mark else [key for key in keys if key and key not in _SECOND_WORDS]
            names = [_NAMES.get(key, key) for key in keys]
            if {"alpha", "cl", "cd"} <= set(names):
                at = {name: names.index(name) for name in names}
                found.append(
                    _Heading(place, mark, at, len(names), _RADIANS.search(line.lower()) is not None)
                )
                break
    return found


def parse_polars(text: str, name: str) -> PolarSet:
    """The polars in `text`, one for each pair of Mach and Reynolds number, rows in any order.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    lines = text.splitlines()
    headings = _headings(lines)
    if not headings:
        raise ValueError(
            f"{name} has no line that names columns alpha, cl and cd: save a polar with PACC in XFOIL's OPER menu, or "
            f"write a CSV headed {COLUMNS}"
        )
    groups: dict[tuple[float, float], list[Row]] = {}
    begin, stated, assumed = 0, (np.nan, np.nan), dict[str, None]()
    for heading, end in zip(
        headings, [*(after.line for after in headings[1:]), len(lines)], strict=True
    ):
        stated = _stated(name, lines[max(begin, heading.line - _HEAD) : heading.line], stated)
        begin = heading.line + 1
        for number, (mach, reynolds, *values) in _rows(name, lines, heading, end):
            begin = number
            mach, reynolds = (
                stated[0] if np.isnan(mach) else mach,
                stated[1] if np.isnan(reynolds) else reynolds,
            )
            if 0.0 < reynolds < _LEAST_REYNOLDS:
                raise ValueError(
                    f"{name}: Reynolds number {reynolds:g} is not a blade's: give it in full, such as 500000"
                )
            if np.isnan(mach):
                assumed["names no Mach number: it is taken as incompressible"] = None
            if heading.radians:
                assumed["has its angles in radians"] = None
            if "cm" not in heading.at:
                assumed["has no cm: it is taken as 0"] = None
            key = (float(np.nan_to_num(mach)), float(np.nan_to_num(reynolds)))
            alpha, cl, cd, cm = values
            groups.setdefault(key, []).append((number, alpha, cl, cd, float(np.nan_to_num(cm))))
            if len(groups) > _MOST_POLARS:
                raise ValueError(
                    f"{name} holds more than {_MOST_POLARS} polars, one for each Mach and Reynolds number: keep fewer"
                )
    if not groups:
        raise ValueError(f"{name} has no rows of numbers below its heading: give at least 8 angles")
    polars = tuple(
        _polar(name, mach, reynolds, groups[mach, reynolds]) for mach, reynolds in sorted(groups)
    )
    return PolarSet(
        tuple(line[1:].strip() for line in lines if line.startswith("#")), polars, tuple(assumed)
    )


def _rows(
    name: str, lines: list[str], heading: _Heading, end: int
) -> Iterator[tuple[int, tuple[float, ...]]]:
    """The rows of a table with the lines they stand on, counted from 1."""
    some, other = False, None
    for number, line in enumerate(lines[heading.line + 1 : end], start=heading.line + 2):
        row, words = heading.row(line), line.split()
        if (
            not some
            and heading.mark is None
            and 3 <= len(words) < heading.columns
            and None not in map(number_of, words)
        ):
            raise ValueError(
                f"{name}, line {heading.line + 1}: the heading names {heading.columns} columns, but line {number} has "
                f"{len(words)} numbers: write the name of each column as one word"
            )
        if row is None:
            # Units below a heading, and words below the last row, are left out.
            if some and other is None and line.strip(" \t,;") and not line.startswith("#"):
                other = number, line.strip()
            continue
        if other is not None:
            raise ValueError(
                f"{name}, line {other[0]}: {other[1]!r} is not a row of numbers: correct or remove it"
            )
        alpha, cl, cd, cm = row[2:]
        if not (cd > 0.0 and abs(cl) < 5.0 and not abs(cm) > 1.0 and abs(alpha) <= 180.0):
            says = f"cl {cl:g}, cd {cd:g}{'' if np.isnan(cm) else f', cm {cm:g}'}"
            raise ValueError(
                f"{name}, line {number}: {says} at {alpha:g} deg is not possible: remove the row"
            )
        some = True
        yield number, row
    if other is not None and end == len(lines) and re.match(r"[+-]?\.?\d", other[1]):
        raise ValueError(
            f"{name}, line {other[0]}: {other[1]!r} is not a row of numbers: correct or remove it"
        )


def _stated(name: str, above: list[str], before: tuple[float, float]) -> tuple[float, float]:
    """Mach and Reynolds number above a heading, else those of the table `before`. ValueError for a polar at neither."""
    head = " ".join(" ".join(above).split())[-_LONGEST_HEAD:].lower()
    if varied := re.search(r"(reynolds|mach) number ?~", head):
        raise ValueError(
            f"{name}: its {varied[1].capitalize()} number changes with lift (XFOIL type 2 or 3): run TYPE 1"
        )
    mach = _value(name, head, rf"\bmach\b\W{{0,12}}(?:number\W{{0,12}})?{STATED}")
    reynolds = _value(name, head, rf"\bre(?:ynolds)?\b\W{{0,12}}(?:number\W{{0,12}})?{STATED}")
    if reynolds is None and (millions := _value(name, head, rf"(?:^| ){STATED} re\b")) is not None:
        reynolds = millions * (1e6 if millions < 1e3 else 1.0)  # AeroDyn.
    return before[0] if mach is None else mach, before[1] if reynolds is None else reynolds


def _value(name: str, head: str, pattern: str) -> float | None:
    match = re.search(pattern, head)
    if match is None:
        return None
    if (value := number_stated(match[1])) is None:
        raise ValueError(f"{name} has {match[0]!r} above its columns: correct the number")
    return value


def _polar(name: str, mach: float, reynolds: float, rows: list[Row]) -> Polar:
    """ValueError with one sentence for a polar that is not a section's."""
    if not 0.0 <= mach < 1.0:
        raise ValueError(f"{name}: Mach {mach:g} is outside 0…1: run XFOIL again with MACH below 1")
    rows = one_row_per_angle(name, rows)
    _, alpha, cl, cd, cm = np.array(rows, dtype=np.float64).T
    if not 8 <= len(alpha) <= _MOST_ANGLES:
        raise ValueError(
            f"{name} holds {len(alpha)} angles: give 8…{_MOST_ANGLES}, for example ASEQ -10 16 0.5"
        )
    for k in np.flatnonzero((np.diff(alpha) <= _STEP_DEG) & (np.abs(alpha[1:]) <= _STEPS_TO_DEG)):
        for what, values, most in zip(("cl", "cd"), (cl, cd), _LARGEST_STEP, strict=True):
            if abs(step := values[k + 1] - values[k]) > most:
                says = f"{what} {'rises' if step > 0.0 else 'falls'} by {abs(step):.3g} from {alpha[k]:g} to"
                raise ValueError(
                    f"{name}, line {rows[k + 1][0]}: {says} {alpha[k + 1]:g} deg, as no section does: correct the row"
                )
    near = np.abs(alpha) < 8.0
    if np.any(near) and cl[near].max() - cl[near].min() < 0.1:
        raise ValueError(
            f"{name}: cl stays within {cl[near].min():g}…{cl[near].max():g} between −8 and 8 deg: give a polar whose "
            "lift rises with the angle"
        )
    return Polar(mach, reynolds if reynolds > 0.0 else None, alpha, cl, cd, cm)


RowOfAngle = TypeVar("RowOfAngle", bound=tuple[float, ...])


def one_row_per_angle(name: str, rows: Sequence[RowOfAngle]) -> list[RowOfAngle]:
    """Rows of (line, angle [deg], values …) sorted by angle; of equal rows at one angle the first is kept.

    ValueError for an angle that comes again with other values.
    """
    kept: list[RowOfAngle] = []
    for row in sorted(rows, key=lambda row: row[1]):
        if not kept or row[1] - kept[-1][1] > _SAME_ANGLE:
            kept.append(row)
        elif any(
            abs(b - a) > _ALIKE[0] * abs(a) + _ALIKE[1]
            for a, b in zip(kept[-1][2:], row[2:], strict=True)
        ):
            lines = sorted((int(kept[-1][0]), int(row[0])))
            raise ValueError(
                f"{name}, line {lines[1]}: {row[1]:g} deg again, unlike line {lines[0]}: keep one of the two rows"
            )
    return kept
