"""The button that takes a user's own rotor, file by file; a bad one gets a sentence, and the page goes on."""

from typing import Any

import viser

from explorer.desk import Desk
from explorer.rotor_shelf import Shelf
from explorer.rotors import OWN
from explorer.state import with_rotor


class RotorUpload:
    """One session's."""

    def __init__(self, button: viser.GuiUploadButtonHandle, desk: Desk) -> None:
        self._desk, self._shelf = desk, Shelf()
        button.on_upload(self._taken)

    def _taken(self, event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        try:
            arrival = self._shelf.take(file.name, file.content)
            if arrival.aircraft is not None:
                self._desk.set_inputs(with_rotor(self._desk.inputs(), OWN, arrival.aircraft))
        except ValueError as error:
            self._desk.tell("Not loaded", str(error))
            return
        self._desk.tell("Rotor" if arrival.aircraft else "Kept", arrival.sentence)
