"""Files of the page: a design's link and file, and the user's own rotor file with its section files."""

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import viser

from explorer.hosting import browser
from explorer.model.actuator_inputs import ActuatorInputs, inputs_from_spec
from explorer.model.inputs import OWN, inputs_of, with_rotor
from explorer.model.session_state import SessionState
from explorer.sharing import share
from explorer.sharing.share import VIEW, Address, view_code
from explorer.text.glossary import hint
from explorer.widgets.context import TabContext
from rotor import Aircraft, Design
from rotor.files.design_file import parse_design
from rotor.files.rotor_file import LARGEST_FILE, read_aircraft, read_tables
from rotor.support.markup import Markup, tag
from rotor.support.user_input import brief, refusing, shorten, text_of

_ROTOR_FILE, _DESIGN_FILE = ".toml", ".json"
_MOST_FILES = 40


@dataclass(frozen=True)
class UploadResult:
    sentence: str
    aircraft: Aircraft | None = None
    """Complete: to be flown."""


@dataclass
class UploadedFiles:
    """The files of a session by name. The key of the rotor file that names a file tells its kind."""

    texts: dict[str, str] = field(default_factory=dict[str, str])
    rotor: str | None = None
    """The last rotor file: it is read again when a file comes that it names."""

    def add(self, name: str, content: bytes) -> UploadResult:
        """Keep a file; the aircraft as soon as its rotor file and all that it names are here, whatever the order.

        Raises ValueError with one sentence for a file that cannot be used; nothing that was kept is lost.
        """
        if len(content) > LARGEST_FILE:
            raise ValueError(
                f"{name} has {len(content) / 1e6:.1f} MB: the limit for rotor files is 2 MB."
            )
        if len(self.texts) >= _MOST_FILES and name not in self.texts:
            raise ValueError(
                f"{_MOST_FILES} files are loaded already: reload the page to start again."
            )
        try:
            text = text_of(content)
        except UnicodeDecodeError:
            raise ValueError(f"{name} is not text: save it as a text file.") from None
        if name.lower().endswith(_ROTOR_FILE):
            return self._rotor(name, {**self.texts, name: text})
        if self.rotor is not None:
            named = read_tables(self.rotor, self.texts[self.rotor]).named
            if name in map(_base_name, named):
                return self._rotor(self.rotor, {**self.texts, name: text})
        if name.lower().endswith(_DESIGN_FILE):
            raise ValueError(
                f"{name} is not a rotor file ({_ROTOR_FILE}): use Load design for a design."
            )
        self.texts[name] = text
        return UploadResult(
            f"{name} waits for a rotor file ({_ROTOR_FILE}) that names it under [sections]: load that."
        )

    def _rotor(self, name: str, texts: dict[str, str]) -> UploadResult:
        """A rotor file, when all that it names is here; it is kept while one of these cannot be used."""
        named = read_tables(name, texts[name]).named
        self.texts[name], self.rotor = texts[name], name
        here = {file: texts[_base_name(file)] for file in named if _base_name(file) in texts}
        missing = [_base_name(file) for file in named if file not in here]
        if missing:
            self.texts = texts
            also = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
            return UploadResult(f"{name} is loaded and needs {missing[0]}{also}: load that next.")
        aircraft = read_aircraft(name, {name: texts[name], **here})
        self.texts = texts
        return UploadResult(" ".join((f"{aircraft.name} is loaded.", *aircraft.remarks)), aircraft)


def _base_name(file: str) -> str:
    """Without its folders, as a browser gives it."""
    return re.split(r"[\\/]", file)[-1]


def _result_line(context: TabContext) -> Callable[..., None]:
    """A line in the drawer below its button, and the function that reports there, and over the scene, what became of a
    file; success is reported over the scene alone."""
    line = context.gui.add_html("")

    def report(title: str, sentence: str, kind: str = "done") -> None:
        stays = tag(
            "div.rx.rx-small.rx-export", brief(sentence), data_explorer="upload", data_kind=kind
        )
        line.content = Markup() if kind == "done" else stays
        context.notify(title, sentence)

    return report


def add_rotor_upload(context: TabContext) -> None:
    """The button for the files of a rotor of one's own, and what they lead to."""
    files = UploadedFiles()
    button = context.gui.add_upload_button(
        "Load rotor file …",
        icon=viser.Icon.UPLOAD,
        color="gray",
        mime_type="*/*",
        hint=hint("rotor_file"),
    )

    report = _result_line(context)

    def uploaded(event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        try:
            with refusing(f"{shorten(file.name)!r}", "check its values, see docs/rotor_file.md"):
                result = files.add(file.name, file.content)
                if result.aircraft is not None:
                    context.set_inputs(with_rotor(context.inputs(), OWN, result.aircraft))
        except ValueError as error:
            report("Not loaded", str(error), "problem")
            return
        report(
            *(("Rotor", result.sentence) if result.aircraft else ("Kept", result.sentence, "waits"))
        )

    button.on_upload(uploaded)


def _about(fits: bool) -> str:
    """What the button of the link will do."""
    words = (
        "Anyone with the link sees this design."
        if fits
        else "Too large for a link: save a file, and send that."
    )
    return tag("div.rx.rx-dim.rx-small", words)


class FilePanel:
    """One session's. The address of the page follows the design, and what is shown of it, by itself."""

    def __init__(
        self,
        context: TabContext,
        address: Address,
        kept: Mapping[str, str],
        folder: viser.GuiFolderHandle,
        carry: Callable[[ActuatorInputs], None],
    ) -> None:
        """`kept`: design files that the page kept for what its address cannot hold, by name in the address.

        `folder`: where the upload button goes. `carry`: takes an actuator on board.
        """
        self._context, self._address, self._kept, self._carry = context, address, dict(kept), carry
        self._records: dict[str, dict[str, Any]] = {}
        """Designs that the address cannot hold now, by name in it."""
        gui = context.gui
        with gui.add_folder("Link"):
            self._about = gui.add_html(_about(True))
            self._link = gui.add_button("Copy link", icon=viser.Icon.LINK, hint=hint("link"))
        with folder:
            self._load = gui.add_upload_button(
                "Load design",
                icon=viser.Icon.UPLOAD,
                color="gray",
                mime_type=_DESIGN_FILE,
                hint=hint("load"),
            )
            self._report = _result_line(context)
        context.leaving.append(address.stop)
        context.keyboard.bind("share", self.copy_link)
        self._link.on_click(lambda _: self.copy_link())
        self._load.on_upload(self._loaded)
        inputs_from = partial(share.inputs_from, kept=kept.get(share.PINNED))
        pinned = address.read(share.PINNED, inputs_from, None, "Link: A not used")
        if pinned is not None:
            context.pin(pinned)

    def follow(self, state: SessionState) -> None:
        """Bring the address into line with the design, with the one that is pinned, and with the view."""
        pinned = None if state.pin is None else state.pin.inputs
        for name, inputs in ((share.DESIGN, state.inputs), (share.PINNED, pinned)):
            try:
                self._address[name] = (
                    None if inputs is None else self._code_of(name, inputs.design())
                )
            except ValueError:
                continue  # It cannot be written; the last one stays.
        carried = state.solution.design.rotor.blade.carried
        self._address[share.CARRIED] = None if carried is None else carried.spec
        self._address[VIEW] = view_code(state.view)
        fits = share.DESIGN not in self._records
        if self._link.disabled == fits:
            self._about.content, self._link.disabled = _about(fits), not fits

    def keep(self) -> None:
        """Give the page, now that it rests, what its address cannot hold: designs with their decks are long."""
        for name, record in self._records.items():
            text = json.dumps(record, ensure_ascii=False)
            if self._kept.get(name) != text:
                self._kept[name] = text
                browser.store_text(self._context.client, name, text)

    def _code_of(self, name: str, design: Design) -> str:
        """What the address says of a design; one that it cannot hold, the page is to keep."""
        self._records.pop(name, None)
        try:
            return share.code_of(design)
        except ValueError:
            self._records[name] = design.to_dict()
            return share.KEPT

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
        self._context.notify(
            "Link copied", "It opens this design. The address of the page is the same link."
        )

    def _loaded(self, event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        name = shorten(file.name)
        try:
            if len(file.content) > share.MOST_BYTES:
                raise ValueError(
                    f"{name} has {len(file.content)} bytes: design files have at most {share.MOST_BYTES}."
                )
            with refusing(f"design file {name!r}", "check its values"):
                design = parse_design(file.content, name)
                inputs, carried = share.within(inputs_of(design)), design.rotor.blade.carried
                actuator = None if carried is None else inputs_from_spec(carried.spec)
        except ValueError as error:
            self._report("Not loaded", str(error), "problem")
            return
        self._context.set_inputs(inputs)
        if actuator is not None:
            self._carry(actuator)
        self._report("Loaded", f"{name} is on the sliders.")
