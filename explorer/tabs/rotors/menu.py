"""The button that takes a rotor of the user's own, file by file; a bad one gets a sentence."""

from typing import Any

import viser

from explorer.interface import TabContext
from explorer.rotor_choice import OWN
from explorer.state import with_rotor
from explorer.tabs.rotors.uploaded_files import SUFFIXES, UploadedFiles
from explorer.text.glossary import hint


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
            arrival = self._files.take(file.name, file.content)
            if arrival.aircraft is not None:
                self._context.set_inputs(with_rotor(self._context.inputs(), OWN, arrival.aircraft))
        except ValueError as error:
            self._context.notify("Not loaded", str(error))
            return
        self._context.notify("Rotor" if arrival.aircraft else "Kept", arrival.sentence)
