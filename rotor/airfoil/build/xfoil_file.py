"""Polar files that XFOIL itself writes (PACC), and our own CSV of polars, as a user brings them."""

import re

import numpy as np

from rotor.airfoil.polars import COLUMNS, Polar, parse_polars

_MOST_ANGLES = 2000


def parse_polar_file(name: str, text: str) -> tuple[Polar, ...]:
    """The polars in `text`: one of an XFOIL polar file, or all of a CSV with the columns of `COLUMNS`.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    if COLUMNS in text:
        return parse_polars(text, name).polars
    lines = text.splitlines()
    dashes = next((k for k, line in enumerate(lines) if re.match(r"\s*-{4,}[\s-]+$", line)), None)
    if dashes is None or dashes == 0:
        raise ValueError(
            f"{name} is no XFOIL polar file: save it with PACC in XFOIL's OPER menu, or write a CSV headed {COLUMNS}"
        )
    heads = lines[dashes - 1].lower().split()
    if heads[:3] != ["alpha", "cl", "cd"]:
        raise ValueError(
            f"{name}, line {dashes}: the columns begin {' '.join(heads[:3])!r}, not alpha CL CD: use XFOIL's order"
        )
    head = " ".join(lines[:dashes])
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
                f"{name}, line {number}: {line.strip()!r} is no row of numbers: remove or mend it"
            ) from None
        if not (np.isfinite([alpha, cl, cd, cm]).all() and cd > 0.0 and abs(cl) < 5.0 and abs(alpha) <= 180.0):
            raise ValueError(f"{name}, line {number}: cl {cl:g}, cd {cd:g} at {alpha:g} deg cannot be: remove the row")
        rows[alpha] = (cl, cd, cm)
    if not 8 <= len(rows) <= _MOST_ANGLES:
        raise ValueError(f"{name} holds {len(rows)} angles: give 8…{_MOST_ANGLES}, for example ASEQ -10 16 0.5")
    if not 0.0 <= mach < 1.0:
        raise ValueError(f"{name}: Mach {mach:g} is outside 0…1: run XFOIL again with MACH below 1")
    angles = sorted(rows)
    values = np.array([rows[angle] for angle in angles], dtype=np.float64)
    return (Polar(mach, reynolds, np.array(angles), values[:, 0], values[:, 1], values[:, 2]),)


def _value(name: str, head: str, pattern: str, what: str) -> float:
    found = re.search(pattern, head)
    if found is None:
        raise ValueError(f"{name} does not say {what!r} above its columns: keep the heading that XFOIL writes")
    return float(found[1].replace(" ", ""))
