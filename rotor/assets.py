"""Where the data files are: `assets/` of the checkout, or its copy inside an installed wheel."""

from pathlib import Path

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
