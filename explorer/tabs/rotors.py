"""The menu of rotors, and the user's own rotor file with its section files."""

from dataclasses import dataclass, field
from typing import Any

import viser

from explorer.interface import TabContext
from explorer.state import OWN, with_rotor
from explorer.text.glossary import hint
from rotor.airfoil.c81 import parse_c81
from rotor.airfoil.contour import parse_contour
from rotor.airfoil.polars import parse_polar_file
from rotor.airfoil.wrap import on_run_time_grid
from rotor.design.aircraft import Aircraft
from rotor.files.rotor_file import LARGEST_FILE, named_files, read_aircraft
from rotor.files.toml_table import read_toml
from rotor.user_input import refusing, shorten

SUFFIXES = (".toml", ".c81", ".txt", ".csv", ".pol", ".dat")
"""Rotor file; C81 deck; polars; outline."""
_MOST_FILES = 40


@dataclass(frozen=True)
class UploadResult:
    """What a file led to."""

    sentence: str
    aircraft: Aircraft | None = None
    """Complete: to be flown."""


@dataclass
class UploadedFiles:
    """One session's files by name."""

    texts: dict[str, str] = field(default_factory=dict[str, str])
    waiting: str | None = None
    """A rotor file that names what is not here yet."""

    def take(self, name: str, content: bytes) -> UploadResult:
        """Keep a file; the aircraft as soon as its rotor file and all that names are here.

        Raises ValueError with one sentence for a file that cannot be used; nothing that was kept is lost.
        """
        suffix = name[name.rfind(".") :].lower() if "." in name else ""
        if suffix not in SUFFIXES:
            known = ", ".join(SUFFIXES)
            raise ValueError(f"{name} is not one of {known}: load a rotor file, a deck, polars or an outline.")
        if len(content) > LARGEST_FILE:
            raise ValueError(f"{name} has {len(content) / 1e6:.1f} MB: a rotor's files have 2 MB at most.")
        if len(self.texts) >= _MOST_FILES and name not in self.texts:
            raise ValueError(f"{_MOST_FILES} files are loaded already: reload the page to start again.")
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            raise ValueError(f"{name} is not UTF-8 text: save it as a text file.") from None
        text = text.replace("\r\n", "\n")
        if suffix == ".toml":
            return self._rotor(name, text)
        _check(name, suffix, text)
        self.texts[name] = text
        if self.waiting is None:
            return UploadResult(f"{name} is loaded: a rotor file that names it under [sections] will use it.")
        return self._rotor(self.waiting, self.texts[self.waiting])

    def _rotor(self, name: str, text: str) -> UploadResult:
        """A rotor file, when all that it names is here."""
        missing = [file for file in named_files(read_toml(name, text)) if _is_file(file) and file not in self.texts]
        if missing:
            self.texts[name], self.waiting = text, name
            also = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
            return UploadResult(f"{name} is loaded and needs {missing[0]}{also}: load that next.")
        aircraft = read_aircraft(name, {**self.texts, name: text})
        self.texts[name], self.waiting = text, None
        return UploadResult(" ".join((f"{aircraft.name} is on the page.", *aircraft.remarks)), aircraft)


def _check(name: str, suffix: str, text: str) -> None:
    """Read a section file once, so that what is wrong with it is said at once."""
    if suffix == ".c81":
        on_run_time_grid(parse_c81(text, name))
    elif suffix == ".dat":
        parse_contour(text, name)
    else:
        parse_polar_file(name, text)


def _is_file(word: str) -> bool:
    """Whether an `outline` names a file rather than a known section."""
    return word.lower().endswith(SUFFIXES)


class RotorUpload:
    """The files of one session, and what they lead to."""

    def __init__(self, gui: viser.GuiApi, context: TabContext) -> None:
        self._context, self._files = context, UploadedFiles()
        button = gui.add_upload_button(
            "Load rotor file …",
            icon=viser.Icon.UPLOAD,
            color="gray",
            mime_type=",".join(SUFFIXES),
            hint=hint("rotor_file"),
        )
        button.on_upload(self._taken)

    def _taken(self, event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        try:
            with refusing(f"{shorten(file.name)!r}", "check its values, see docs/rotor_file.md"):
                arrival = self._files.take(file.name, file.content)
                if arrival.aircraft is not None:
                    self._context.set_inputs(with_rotor(self._context.inputs(), OWN, arrival.aircraft))
        except ValueError as error:
            self._context.notify("Not loaded", str(error))
            return
        self._context.notify("Rotor" if arrival.aircraft else "Kept", arrival.sentence)
