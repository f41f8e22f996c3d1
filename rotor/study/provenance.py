"""Where a result came from: the package's version and, in a checkout, its commit."""

import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

_PACKAGE = Path(__file__).parent.parent


def package_version() -> str:
    """Version of the installed package; "unknown" for a bare copy of its source."""
    try:
        return version("rotor-explorer")
    except PackageNotFoundError:
        return "unknown"


def commit() -> str | None:
    """The commit that the package runs from, with + where its source differs from it; None outside a checkout."""
    root = _PACKAGE.parent
    if not (root / ".git").exists():
        return None
    head = _git(root, "rev-parse", "--short=12", "HEAD")
    changed = _git(root, "status", "--porcelain", "--", "rotor", "assets")
    return None if head is None else head + ("+" if changed else "")


def _git(root: Path, *arguments: str) -> str | None:
    try:
        done = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True, timeout=10)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.strip() if done.returncode == 0 else None
