"""Files of the page: a design's link and file, and the user's own rotor file with its section files."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import viser

from explorer.hosting import browser
from explorer.model.inputs import OWN, inputs_of, with_rotor
from explorer.model.session_state import SessionState
from explorer.sharing import share
from explorer.sharing.share import VIEW, Address, view_code
from explorer.tabs.context import Tab, TabContext
from explorer.text.glossary import hint
from rotor import Aircraft, Design
from rotor.airfoil.c81 import parse_c81
from rotor.airfoil.contour import parse_contour
from rotor.airfoil.decks import on_run_time_grid
from rotor.airfoil.polars import parse_polar_file
from rotor.files.design_file import parse_design
from rotor.files.rotor_file import LARGEST_FILE, read_aircraft, read_tables
from rotor.markup import tag
from rotor.user_input import refusing, shorten

SUFFIXES = (".toml", ".c81", ".txt", ".csv", ".pol", ".dat")
"""Rotor file; C81 deck; polars; outline."""
_MOST_FILES = 40


@dataclass(frozen=True)
class UploadResult:
    sentence: str
    aircraft: Aircraft | None = None
    """Complete: to be flown."""


@dataclass
class UploadedFiles:
    """One session's files by name."""

    texts: dict[str, str] = field(default_factory=dict[str, str])
    waiting: str | None = None
    """A rotor file that names what is not here yet."""

    def add(self, name: str, content: bytes) -> UploadResult:
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
        if suffix == ".c81":  # Read once, so that what is wrong with it is said at once.
            on_run_time_grid(parse_c81(text, name))
        elif suffix == ".dat":
            parse_contour(text, name)
        else:
            parse_polar_file(name, text)
        self.texts[name] = text
        if self.waiting is None:
            return UploadResult(f"{name} is loaded: a rotor file that names it under [sections] will use it.")
        return self._rotor(self.waiting, self.texts[self.waiting])

    def _rotor(self, name: str, text: str) -> UploadResult:
        """A rotor file, when all that it names is here."""
        named = read_tables(name, text).named  # An `outline` may also name a known section.
        missing = [file for file in named if file.lower().endswith(SUFFIXES) and file not in self.texts]
        if missing:
            self.texts[name], self.waiting = text, name
            also = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
            return UploadResult(f"{name} is loaded and needs {missing[0]}{also}: load that next.")
        aircraft = read_aircraft(name, {**self.texts, name: text})
        self.texts[name], self.waiting = text, None
        return UploadResult(" ".join((f"{aircraft.name} is on the page.", *aircraft.remarks)), aircraft)


def add_rotor_upload(context: TabContext) -> None:
    """The button for the files of a rotor of one's own, and what they lead to."""
    files, kinds, said = UploadedFiles(), ",".join(SUFFIXES), hint("rotor_file")
    button = context.gui.add_upload_button(
        "Load rotor file …", icon=viser.Icon.UPLOAD, color="gray", mime_type=kinds, hint=said
    )

    def uploaded(event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        try:
            with refusing(f"{shorten(file.name)!r}", "check its values, see docs/rotor_file.md"):
                result = files.add(file.name, file.content)
                if result.aircraft is not None:
                    context.set_inputs(with_rotor(context.inputs(), OWN, result.aircraft))
        except ValueError as error:
            context.notify("Not loaded", str(error))
            return
        context.notify("Rotor" if result.aircraft else "Kept", result.sentence)

    button.on_upload(uploaded)


MOST_BYTES = 1_000_000
"""A design file may have; written ones have a thousand."""


class FilePanel(Tab):
    """One session's. The address of the page follows the design, and what is shown of it, by itself."""

    def __init__(
        self, context: TabContext, address: Address, kept: Mapping[str, str], folder: viser.GuiFolderHandle
    ) -> None:
        """`kept`: design files that the page kept for what its address cannot hold, by name in the address.

        `folder`: where the upload button goes.
        """
        self._context, self._address, self._kept = context, address, dict(kept)
        self._records: dict[str, dict[str, Any]] = {}
        """Designs that the address cannot hold now, by name in it."""
        gui = context.gui
        with gui.add_folder("Link"):
            gui.add_html(tag("div.rx.rx-dim.rx-small", "Anyone with the link sees this design."))
            self._link = gui.add_button("Copy link", icon=viser.Icon.LINK, hint=hint("link"))
        with folder:
            self._load = gui.add_upload_button(
                "Load design", icon=viser.Icon.UPLOAD, color="gray", mime_type=".json", hint=hint("load")
            )
        context.keyboard.bind("share", self.copy_link)
        self._link.on_click(lambda _: self.copy_link())
        self._load.on_upload(self._loaded)

    def follow(self, state: SessionState) -> None:
        """Bring the address into line with the design, with the one that is pinned, and with the view."""
        pinned = None if state.pin is None else state.pin.inputs
        for name, inputs in ((share.DESIGN, state.inputs), (share.PINNED, pinned)):
            try:
                self._address[name] = None if inputs is None else self._code_of(name, inputs.design())
            except ValueError:
                continue  # It cannot be written; the last one stays.
        self._address[VIEW] = view_code(state.view)

    def keep(self) -> None:
        """Give the page, now that it rests, what its address cannot hold: designs with their decks are long."""
        for name, record in self._records.items():
            text = json.dumps(record, ensure_ascii=False)
            if self._kept.get(name) != text:
                self._kept[name] = text
                browser.keep(self._context.client, name, text)

    def _code_of(self, name: str, design: Design) -> str:
        """What the address says of a design; one that it cannot hold, the page is to keep."""
        self._records.pop(name, None)
        try:
            return share.code_of(design)
        except ValueError:
            self._records[name] = design.to_dict()
            return share.KEPT

    def begin(self, problems: list[tuple[str, str]]) -> None:
        """Pin what the address says is pinned; `problems` get a title and a sentence where it cannot be read."""
        inputs_from = partial(share.inputs_from, kept=self._kept.get(share.PINNED))
        pinned = self._address.read(share.PINNED, inputs_from, None, "Not the A of the link", problems)
        if pinned is not None:
            self._context.pin(pinned)

    def copy_link(self) -> None:
        """The link of what is shown into the clipboard; the address is the same."""
        try:
            share.code_of(self._context.inputs().design())
        except ValueError as error:
            self._context.notify("No link", str(error))
            return
        self._address.write_over()
        if (state := self._context.state()) is not None:
            self.follow(state)
        browser.copy_link(self._context.client, self._address.query)
        self._context.notify("Link copied", "It opens this design. The address of the page is the same link.")

    def stop(self) -> None:
        self._address.stop()

    def _loaded(self, event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        name = shorten(file.name)
        try:
            if len(file.content) > MOST_BYTES:
                raise ValueError(f"{name} has {len(file.content)} bytes: a design file has at most {MOST_BYTES}.")
            with refusing(f"design file {name!r}", "check its values"):
                design = parse_design(file.content, name)
                inputs = share.within(inputs_of(design))
        except ValueError as error:
            self._context.notify("Not loaded", str(error))
            return
        self._context.set_inputs(inputs)
        self._context.notify("Loaded", f"{name} is on the sliders.")
