"""The provenance of a result: the version of the package and, in a checkout, its commit."""

import subprocess
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

_ROOT = Path(__file__).parent.parent.parent


def package_version() -> str:
    """Version of the installed package; "unknown" for a copy of the source."""
    try:
        return version("rotor-explorer")
    except PackageNotFoundError:
        return "unknown"


@cache
def commit() -> str | None:
    """The commit of the checkout, with + where files differ from it; None for an installed package."""
    if not (_ROOT / ".git").exists():
        return None
    command = ["git", "-C", str(_ROOT), "describe", "--always", "--dirty=+", "--exclude=*"]
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=5.0, check=True).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return None
