"""The commands, as `assets/commands.toml` lists them. Reading one reads no other."""

from typing import NamedTuple

from rotor.support.assets import toml_asset


class Command(NamedTuple):
    """One command."""

    adds: str
    """The function that adds its flags, in its file of this folder."""
    help: str
    examples: list[tuple[str, str]]
    """What each does, and its arguments."""


COMMANDS = {name: Command(**row) for name, row in toml_asset("commands.toml").items()}
