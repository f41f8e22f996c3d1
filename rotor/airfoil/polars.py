"""Raw polars as files: what XFOIL computed, before any correction, in a CSV with a header that says how."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rotor.arrays import Array

COLUMNS = "mach,reynolds,alpha_deg,cl,cd,cm"
"""Heading of the CSV."""


@dataclass(frozen=True, eq=False)
class Polar:
    """Coefficients of one section at one Mach and Reynolds number against angle of attack.

    `alpha_deg` [deg] increases strictly and may have gaps where XFOIL did not converge;
    `cl`, `cd`, `cm` [-] have its shape, cm about the quarter chord.
    """

    mach: float
    reynolds: float
    alpha_deg: Array
    cl: Array
    cd: Array
    cm: Array


@dataclass(frozen=True, eq=False)
class PolarSet:
    """Polars of one section with one transition setting, in order of Mach number.

    `header` holds the comment lines of the file (source, code version, settings), without `#`.
    """

    header: tuple[str, ...]
    polars: tuple[Polar, ...]


def write_polars(path: Path, polar_set: PolarSet) -> None:
    """Write a polar set; four to five decimals, as XFOIL prints them, so nothing is lost."""
    lines = [f"# {line}" for line in polar_set.header] + [COLUMNS]
    for p in polar_set.polars:
        for a, cl, cd, cm in zip(p.alpha_deg, p.cl, p.cd, p.cm, strict=True):
            lines.append(f"{p.mach:g},{p.reynolds:.0f},{a:g},{cl:.4f},{cd:.5f},{cm:.4f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read_polars(path: Path) -> PolarSet:
    """Read a polar set written by `write_polars`, see `parse_polars`."""
    return parse_polars(path.read_text(encoding="utf-8"), path.name)


def parse_polars(text: str, name: str) -> PolarSet:
    """The polar set in `text`; a damaged line is a ValueError that names it in `name`."""
    header: list[str] = []
    rows: list[tuple[float, ...]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("#"):
            header.append(line[1:].strip())
            continue
        if line == COLUMNS or not line.strip():
            continue
        try:
            row = tuple(float(word) for word in line.split(","))
        except ValueError:
            row = ()
        if len(row) != 6 or not np.isfinite(row).all() or not row[4] > 0.0:
            raise ValueError(f"{name}, line {number}: {line!r} is not `{COLUMNS}` with cd > 0: fix the line")
        rows.append(row)
    if not rows:
        raise ValueError(f"{name} holds no polar: rebuild it with `python -m rotor airfoil build`")
    data = np.array(rows, dtype=np.float64)
    polars: list[Polar] = []
    for mach in np.unique(data[:, 0]):
        part = data[data[:, 0] == mach]
        part = part[np.argsort(part[:, 2])]
        polars.append(Polar(float(mach), float(part[0, 1]), part[:, 2], part[:, 3], part[:, 4], part[:, 5]))
    return PolarSet(tuple(header), tuple(polars))
