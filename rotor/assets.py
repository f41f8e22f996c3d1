"""The path of data files: `assets/` of the checkout, or its copy in an installed wheel."""

import csv
from pathlib import Path

SHIPPED_ROTORS = ("uh60a", "r22", "s61")
"""Names of the shipped rotors, each in `assets/<name>.toml`. The first is the default."""

_PACKAGED = Path(__file__).parent / "_assets"
_CHECKOUT = Path(__file__).parent.parent / "assets"


def asset_path(name: str) -> Path:
    """Path of a data file, for example `asset_path("uh60a.toml")`.

    Raises FileNotFoundError when neither the wheel nor the checkout has it.
    """
    for folder in (_PACKAGED, _CHECKOUT):
        path = folder / name
        if path.exists():
            return path
    raise FileNotFoundError(f"data file {name!r} is in neither {_PACKAGED} nor {_CHECKOUT}: reinstall rotor-explorer")


def csv_rows(path: Path) -> list[dict[str, str]]:
    """The rows of a table by column; lines that begin with # hold sources and are skipped."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))
