"""What a visitor sees while all places are taken; it goes away by itself when one is free."""

import viser

from explorer.hosting import viser_compat
from explorer.theme import style_sheet as style


class WaitingPage:
    """One visitor's: a dialogue in the middle of an empty page. No rotor, no worker."""

    def __init__(self, client: viser.ClientHandle, places: int, ahead: int, dark: bool) -> None:
        self._places = places
        gui = self._gui = client.gui
        viser_compat.set_style(client, style.SHEET)
        gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
        gui.main_panel.minimize()
        self._modal = gui.add_modal("Rotor explorer")
        with self._modal:
            self._words = gui.add_html(full_house(places, ahead))

    def show(self, ahead: int) -> None:
        """So many wait before this one."""
        self._words.content = full_house(self._places, ahead)

    def close(self) -> None:
        """A place is free: make room for the session."""
        self._modal.close()
        self._gui.main_panel.expand()


def full_house(places: int, ahead: int) -> str:
    """The sentences, as HTML."""
    taken = f"All {places} places are taken." if places > 1 else "The place is taken."
    others = "1 visitor waits" if ahead == 1 else f"{ahead} visitors wait"
    line = f"{others} before you." if ahead else "You are next."
    return (
        '<div class="rx rx-lobby" data-explorer="lobby">'
        f"<p><b>{taken}</b> {line}</p>"
        "<p>Leave this page open: the explorer appears here as soon as somebody leaves, or rests for long.</p>"
        '<p class="rx-dim">To run one of your own: <code>make run</code>. '
        "Whoever runs this one can allow more: <code>--max-sessions</code>.</p></div>"
    )
