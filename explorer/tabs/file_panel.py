"""The link of the design and its file: copied, saved, loaded."""

import json
from collections.abc import Mapping
from functools import partial
from typing import Any

import viser

from explorer.hosting import browser
from explorer.interface import SessionState, TabContext
from explorer.sharing import share
from explorer.sharing.address import Address
from explorer.sharing.view_code import VIEW, view_code
from explorer.state import inputs_of
from explorer.text.glossary import hint
from rotor.design.design import Design
from rotor.files.design_file import parse_design
from rotor.user_input import refusing, shorten

MOST_BYTES = 1_000_000
"""A design file may have; written ones have a thousand."""


class FilePanel:
    """One session's. The address of the page follows the design, and what is shown of it, by itself."""

    def __init__(
        self,
        client: viser.ClientHandle,
        context: TabContext,
        address: Address,
        kept: Mapping[str, str],
        folder: viser.GuiFolderHandle,
    ) -> None:
        """`kept`: design files that the page kept for what its address cannot hold, by name in the address.

        `folder`: where the upload button goes.
        """
        self._client, self._context, self._address, self._kept = client, context, address, dict(kept)
        self._records: dict[str, dict[str, Any]] = {}
        """Designs that the address cannot hold now, by name in it."""
        gui = client.gui
        with gui.add_folder("Link and file"):
            gui.add_html('<div class="rx rx-dim rx-small">Anyone with the link sees this design.</div>')
            self._link = gui.add_button("Copy link", icon=viser.Icon.LINK, hint=hint("link"))
            self._save = gui.add_button("Save design", icon=viser.Icon.DOWNLOAD, color="gray", hint=hint("save"))
        with folder:
            self._load = gui.add_upload_button(
                "Load design", icon=viser.Icon.UPLOAD, color="gray", mime_type=".json", hint=hint("load")
            )
        context.bind_command("share", self.copy_link)
        self._link.on_click(lambda _: self.copy_link())
        self._save.on_click(lambda _: self.save())
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
                browser.keep(self._client, name, text)

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
        inputs_from = partial(
            share.inputs_from, kept=self._kept.get(share.PINNED), tell=partial(share.tell_retired, problems)
        )
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
        browser.copy_link(self._client, self._address.query)
        self._context.notify("Link copied", "It opens this design. The address of the page is the same link.")

    def save(self) -> None:
        """The design file, as `--case` and `--design` read it."""
        try:
            record = self._context.inputs().design().to_dict()
        except ValueError as error:
            self._context.notify("Nothing saved", str(error))
            return
        self._context.download("design.json", (json.dumps(record, indent=2, ensure_ascii=False) + "\n").encode())

    def show(self, state: SessionState) -> None:
        """The address follows once the page is at rest: see `follow`."""

    def show_failure(self) -> None:
        """The address keeps the last design."""

    def stop(self) -> None:
        self._address.stop()

    def _loaded(self, event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        name = shorten(file.name)
        said: list[str] = []
        try:
            if len(file.content) > MOST_BYTES:
                raise ValueError(f"{name} has {len(file.content)} bytes: a design file has at most {MOST_BYTES}.")
            with refusing(f"design file {name!r}", "check its values"):
                design = parse_design(file.content, name, said.append)
                inputs = share.within(inputs_of(design))
        except ValueError as error:
            self._context.notify("Not loaded", str(error))
            return
        self._context.set_inputs(inputs)
        self._context.notify("Loaded", " ".join([f"{name} is on the sliders.", *said]))
