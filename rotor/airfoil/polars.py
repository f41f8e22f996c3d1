"""Raw polars as files: CSV with a header that records how it was made, and XFOIL polar files (PACC)."""

import re
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
    """Write a polar set; four to five decimals, as XFOIL prints them, so no digit is lost."""
    lines = [f"# {line}" for line in polar_set.header] + [COLUMNS]
    for p in polar_set.polars:
        for a, cl, cd, cm in zip(p.alpha_deg, p.cl, p.cd, p.cm, strict=True):
            lines.append(f"{p.mach:g},{p.reynolds:.0f},{a:g},{cl:.4f},{cd:.5f},{cm:.4f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read_polars(path: Path) -> PolarSet:
    """Read a polar set written by `write_polars`, see `parse_polars`."""
    return parse_polars(path.read_text(encoding="utf-8"), path.name)


def parse_polars(text: str, name: str) -> PolarSet:
    """The polar set in `text`. Raises ValueError with the line of `name` that is damaged."""
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
        raise ValueError(f"{name} holds no polar: give one row at least")
    data = np.array(rows, dtype=np.float64)
    polars: list[Polar] = []
    machs = np.unique(data[:, 0])
    if len(machs) > _MOST_MACHS:
        raise ValueError(f"{name} holds polars at {len(machs)} Mach numbers: {_MOST_MACHS} are allowed")
    for mach in machs:
        part = data[data[:, 0] == mach]
        part = part[np.argsort(part[:, 2])]
        polars.append(Polar(float(mach), float(part[0, 1]), part[:, 2], part[:, 3], part[:, 4], part[:, 5]))
    return PolarSet(tuple(header), tuple(polars))


_MOST_ANGLES = 2000
_MOST_MACHS = 30
_HEAD, _LONGEST_HEAD = 40, 8000
"""Lines and characters above the columns that are looked at; XFOIL writes twelve lines."""


def parse_polar_file(name: str, text: str) -> tuple[Polar, ...]:
    """The polars in `text`: one of an XFOIL polar file, or all of a CSV with the columns of `COLUMNS`.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    if COLUMNS in text:
        return tuple(_checked(name, polar) for polar in parse_polars(text, name).polars)
    lines = text.splitlines()
    dashes = next((k for k, line in enumerate(lines) if re.match(r"\s*-{4}[\s-]+$", line)), None)
    if dashes is None or dashes == 0:
        raise ValueError(
            f"{name} is not an XFOIL polar file: save it with PACC in XFOIL's OPER menu, or write a CSV headed "
            f"{COLUMNS}"
        )
    heads = lines[dashes - 1].lower().split()
    if heads[:3] != ["alpha", "cl", "cd"]:
        raise ValueError(
            f"{name}, line {dashes}: the columns begin {' '.join(heads[:3])!r}, not alpha CL CD: use XFOIL's order"
        )
    head = " ".join(" ".join(lines[max(dashes - _HEAD, 0) : dashes]).split())[-_LONGEST_HEAD:]
    mach = _value(name, head, r"Mach\s*=\s*([0-9.]+)", "Mach =")
    reynolds = _value(name, head, r"Re\s*=\s*([0-9.]+(?:\s*e\s*[+-]?\s*[0-9]+)?)", "Re =")
    moment = heads.index("cm") if "cm" in heads else None
    rows: dict[float, tuple[float, float, float]] = {}
    for number, line in enumerate(lines[dashes + 1 :], start=dashes + 2):
        if not line.strip():
            continue
        try:
            words = [float(word) for word in line.split()]
            alpha, cl, cd = words[:3]
            cm = words[moment] if moment is not None else 0.0
        except (ValueError, IndexError):
            raise ValueError(
                f"{name}, line {number}: {line.strip()!r} is not a row of numbers: remove or correct it"
            ) from None
        if not (np.isfinite([alpha, cl, cd, cm]).all() and cd > 0.0 and abs(cl) < 5.0 and abs(alpha) <= 180.0):
            raise ValueError(f"{name}, line {number}: cl {cl:g}, cd {cd:g} at {alpha:g} deg cannot be: remove the row")
        rows[alpha] = (cl, cd, cm)
    angles = sorted(rows)
    values = np.array([rows[angle] for angle in angles], dtype=np.float64)
    return (_checked(name, Polar(mach, reynolds, np.array(angles), *(values.T if angles else np.empty((3, 0))))),)


def _checked(name: str, polar: Polar) -> Polar:
    """The polar; ValueError with one sentence for one that is not a section's."""
    alpha, cl = polar.alpha_deg, polar.cl
    if not 8 <= len(alpha) <= _MOST_ANGLES:
        raise ValueError(f"{name} holds {len(alpha)} angles: give 8…{_MOST_ANGLES}, for example ASEQ -10 16 0.5")
    if not 0.0 <= polar.mach < 1.0:
        raise ValueError(f"{name}: Mach {polar.mach:g} is outside 0…1: run XFOIL again with MACH below 1")
    if np.any(np.diff(alpha) <= 0.0):
        raise ValueError(f"{name} holds an angle twice at Mach {polar.mach:g}: keep one row of each")
    if np.abs(alpha).max() > 180.0 or np.abs(cl).max() > 5.0:
        raise ValueError(
            f"{name} holds angles beyond ±180 deg or cl beyond ±5 at Mach {polar.mach:g}: correct the rows"
        )
    near = np.abs(alpha) < 8.0
    if np.any(near) and cl[near].max() - cl[near].min() < 0.1:
        raise ValueError(
            f"{name}: cl stays within {cl[near].min():g}…{cl[near].max():g} between −8 and 8 deg: give a polar whose "
            "lift rises with the angle"
        )
    return polar


def _value(name: str, head: str, pattern: str, what: str) -> float:
    match = re.search(pattern, head)
    if match is None:
        raise ValueError(f"{name} does not say {what!r} above its columns: keep the heading that XFOIL writes")
    try:
        return float(match[1].replace(" ", ""))
    except ValueError:
        raise ValueError(f"{name} has {match[0]!r} above its columns: keep the heading that XFOIL writes") from None
