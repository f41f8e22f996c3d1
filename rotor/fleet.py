"""The rotors that ship, by name; and whatever `--rotor` names, shipped or on disk."""

from functools import cache
from pathlib import Path

from rotor.aircraft import Aircraft
from rotor.assets import SHIPPED_ROTORS, asset_path
from rotor.rotor_file import read_aircraft, read_rotor_file


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
