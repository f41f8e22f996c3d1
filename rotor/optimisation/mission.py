"""A mission: flight conditions and the hours flown in each, as a table that a person can edit."""

import csv
import math
from dataclasses import replace
from pathlib import Path

from rotor.design.design import Design
from rotor.optimisation.objective import Leg

COLUMNS = ("mu", "mass_kg", "altitude_m", "hours")


def read_mission(path: str | Path, design: Design) -> tuple[Leg, ...]:
    """Legs of a CSV table with the columns mu, mass_kg, altitude_m, hours; `#` starts a comment.

    Only mu is needed: mass and altitude left out or blank are the design's own, hours are 1. Raises ValueError with one
    sentence that names file, line and remedy.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ValueError(f"mission {str(path)!r} does not exist: give a CSV file with {', '.join(COLUMNS)}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"mission {str(path)!r} cannot be read ({error}): give a CSV text file") from None
    numbered = [(number, line.partition("#")[0].strip()) for number, line in enumerate(text.splitlines(), start=1)]
    rows = [(number, next(csv.reader([line]))) for number, line in numbered if line]
    if not rows:
        raise ValueError(f"mission {str(path)!r} is empty: begin it with the line {','.join(COLUMNS)}")
    heading = [cell.strip() for cell in rows[0][1]]
    unknown = [name for name in heading if name not in COLUMNS]
    if unknown or "mu" not in heading:
        raise ValueError(
            f"mission {str(path)!r} line {rows[0][0]} reads {','.join(heading)!r}: "
            f"write the heading {','.join(COLUMNS)}, of which mu is needed"
        )
    if len(rows) < 2:
        raise ValueError(f"mission {str(path)!r} has no legs: add a line such as 0.2,8322,0,1.5")
    return tuple(_leg(path, number, dict(zip(heading, cells, strict=False)), design) for number, cells in rows[1:])


def _leg(path: Path, line: int, cells: dict[str, str], design: Design) -> Leg:
    condition = design.condition
    try:
        condition = replace(
            condition,
            advance_ratio=_number(cells, "mu", None),
            mass=_number(cells, "mass_kg", condition.mass),
            altitude=_number(cells, "altitude_m", condition.altitude),
        )
        return Leg(condition, _number(cells, "hours", 1.0))
    except ValueError as error:
        raise ValueError(f"mission {str(path)!r} line {line}: {error}") from None


def _number(cells: dict[str, str], name: str, default: float | None) -> float:
    text = cells.get(name, "").strip()
    if not text and default is not None:
        return default
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{name} is {text!r}: write a number")
    return value
