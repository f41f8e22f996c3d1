"""The state of a visitor's page, kept while a lecture or a tour sets its own, and given back at the end."""

from dataclasses import dataclass, replace

from explorer.interface import TabContext
from explorer.state import OWN, Inputs, ViewState


@dataclass(frozen=True)
class PageSnapshot:
    """The design on the sliders, what is shown, and A."""

    inputs: Inputs
    view: ViewState
    pinned: Inputs | None
    """A of A/B; None: nothing is pinned."""

    @staticmethod
    def take(context: TabContext) -> "PageSnapshot":
        """The page as it is now."""
        state = context.state()
        pin = None if state is None else state.pin
        return PageSnapshot(context.inputs(), context.view(), None if pin is None else pin.inputs)

    def restore(self, context: TabContext) -> None:
        """Give the page back.

        Units and dark mode stay as they are now, because they belong to the room, not to the design; a rotor file
        brought meanwhile stays in the menu.
        """
        now = context.view()
        inputs = self.inputs
        if inputs.rotor != OWN:
            inputs = replace(inputs, own_rotor=context.inputs().own_rotor)
        context.pin(self.pinned)
        context.set_view(replace(self.view, units=now.units, dark=now.dark))
        context.set_inputs(inputs)
