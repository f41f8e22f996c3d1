"""Reads the tables in tests/data/inflow."""

import csv
from pathlib import Path

FOLDER = Path(__file__).parent / "data" / "inflow"


def table(name: str) -> list[dict[str, str]]:
    """Rows of a table, comments left out."""
    with (FOLDER / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
