"""The installed package: the path of its data files, its version and, in a checkout, its commit.

Data files are in `assets/` of the checkout, or its copy in an installed wheel.
"""

import csv
import subprocess
import tomllib
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

SHIPPED_ROTORS = ("uh60a", "r22", "s61", "gazelle", "bo105")
"""Names of the shipped rotors, each in `assets/<name>.toml`. The first is the default."""

_CASTLES_GRAY = ("castles-gray", "castles-gray-twisted", "castles-gray-4ft", "castles-gray-tapered")
_IN_HOVER = ("knight-hefner-3", "knight-hefner-4", *_CASTLES_GRAY, "caradonna-tung")
MEASURED_ROTORS = ("xv15", "pca2", *_IN_HOVER, "2mrts", "hart2")
"""Names of the shipped rotors that were tested on a stand, each in `assets/rotors/<name>.toml`."""

_PACKAGED = Path(__file__).parent.parent / "_assets"
_CHECKOUT_ROOT = Path(__file__).parents[2]
_CHECKOUT = _CHECKOUT_ROOT / "assets"


def asset_path(name: str) -> Path:
    """Path of a data file, for example `asset_path("uh60a.toml")`.

    Raises FileNotFoundError when neither the wheel nor the checkout has it.
    """
    for folder in (_PACKAGED, _CHECKOUT):
        path = folder / name
        if path.exists():
            return path
    raise FileNotFoundError(
        f"data file {name!r} is in neither {_PACKAGED} nor {_CHECKOUT}: reinstall rotor-explorer"
    )


@cache
def toml_asset(name: str) -> dict[str, Any]:
    """The tables of a TOML file in `assets/`, read once and shared: not to be changed."""
    return tomllib.loads(asset_path(name).read_text(encoding="utf-8"))


def csv_rows(path: Path) -> list[dict[str, str]]:
    """The rows of a table by column; lines that begin with # hold sources and are skipped."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


@cache
def package_version() -> str:
    """Version of the installed package; "unknown" for a copy of the source."""
    try:
        return version("rotor-explorer")
    except PackageNotFoundError:
        return "unknown"


@cache
def commit() -> str | None:
    """The commit of the checkout, with + where files differ from it; None for an installed package."""
    if not (_CHECKOUT_ROOT / ".git").exists():
        return None
    command = ["git", "-C", str(_CHECKOUT_ROOT), "describe", "--always", "--dirty=+", "--exclude=*"]
    try:
        return subprocess.run(
            command, capture_output=True, text=True, timeout=5.0, check=True
        ).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return None
