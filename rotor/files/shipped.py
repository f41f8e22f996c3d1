"""The rotors that ship, by name; and whatever `--rotor` names, shipped or on disk."""

from functools import cache
from pathlib import Path

from rotor.assets import SHIPPED_ROTORS, asset_path
from rotor.design.aircraft import Aircraft
from rotor.files.rotor_file import LARGEST_FILE, named_files, read_aircraft
from rotor.files.toml_table import read_toml


@cache
def shipped_aircraft(name: str) -> Aircraft:
    """A shipped aircraft; ValueError for a name that is none."""
    if name not in SHIPPED_ROTORS:
        raise ValueError(
            f"rotor {name!r} is not known: use {', '.join(SHIPPED_ROTORS)}, or the path of a rotor file (.toml)"
        )
    file = f"{name}.toml"
    return read_aircraft(file, {file: asset_path(file).read_text(encoding="utf-8")}, key=name)


def find_aircraft(name: str) -> Aircraft:
    """The aircraft that `--rotor` names: a shipped one, or a rotor file's. ValueError with one sentence otherwise."""
    if name in SHIPPED_ROTORS or not ("." in name or "/" in name or Path(name).exists()):
        return shipped_aircraft(name)
    return read_rotor_file(name)


def read_rotor_file(path: str | Path) -> Aircraft:
    """The aircraft of a rotor file on disk, with the section files beside it.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    path = Path(path)
    texts = {path.name: read_text(path)}
    top = read_toml(path.name, texts[path.name])
    for name in named_files(top):
        beside = path.parent / name
        if beside.is_file():
            texts[name] = read_text(beside)
    return read_aircraft(path.name, texts)


def read_text(path: Path) -> str:
    """The text of a file; ValueError where it cannot be had."""
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError(f"{path.name} has {path.stat().st_size / 1e6:.1f} MB: a rotor's files have 2 MB at most")
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ValueError(f"rotor file {str(path)!r} does not exist: give a shipped rotor's name or a path") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path.name} cannot be read as text ({error}): save it as UTF-8") from None
