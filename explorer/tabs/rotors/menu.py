"""The menu of rotors, and the button that takes a user's own, file by file; a bad one gets a sentence."""

from collections.abc import Callable
from typing import Any

import viser

from explorer.interface import TabContext
from explorer.rotor_choice import OWN, menu_titles
from explorer.state import Inputs, with_rotor
from explorer.tabs.rotors.uploaded_files import SUFFIXES, UploadedFiles
from explorer.text.glossary import hint


class RotorMenu:
    """The widgets of one session. What is chosen is asked for; `show` makes it so."""

    def __init__(self, gui: viser.GuiApi, start: Inputs, chosen: Callable[[str], None]) -> None:
        """`chosen`: hears the name of a rotor that the user picked."""
        self._chosen = chosen
        self._titles = menu_titles(start.own_rotor)
        self.menu = gui.add_dropdown(
            "Rotor", tuple(self._titles.values()), initial_value=self._titles[start.rotor], hint=hint("rotor")
        )
        accepted, icon = ",".join(SUFFIXES), viser.Icon.UPLOAD
        self.button = gui.add_upload_button(
            "Load rotor file …", icon=icon, color="gray", mime_type=accepted, hint=hint("rotor_file")
        )
        self.menu.on_update(self._picked)

    def show(self, inputs: Inputs) -> None:
        """The menu as these inputs have it."""
        self._titles = menu_titles(inputs.own_rotor)
        if self.menu.options != tuple(self._titles.values()):
            self.menu.options = tuple(self._titles.values())
        self.menu.value = self._titles[inputs.rotor]

    def _picked(self, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None:  # Not when a loaded design moved it.
            self._chosen(next(name for name, title in self._titles.items() if title == event.target.value))


class RotorUpload:
    """The files of one session, and what they lead to."""

    def __init__(self, button: viser.GuiUploadButtonHandle, context: TabContext) -> None:
        self._context, self._shelf = context, UploadedFiles()
        button.on_upload(self._taken)

    def _taken(self, event: viser.GuiEvent[Any]) -> None:
        file = event.target.value
        try:
            arrival = self._shelf.take(file.name, file.content)
            if arrival.aircraft is not None:
                self._context.set_inputs(with_rotor(self._context.inputs(), OWN, arrival.aircraft))
        except ValueError as error:
            self._context.notify("Not loaded", str(error))
            return
        self._context.notify("Rotor" if arrival.aircraft else "Kept", arrival.sentence)
