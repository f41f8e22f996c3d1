"""Where the texts of power and trust stand, in their drawers and beside the switches of the models."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from explorer.text.readout import answers
from explorer.text.status import status_panel, trust_page
from explorer.views.waterfall import WATERFALL_WORDS, waterfall_chart
from explorer.widgets.context import TabContext
from rotor.support.markup import Markup, tag


def drawer_texts(context: TabContext) -> Mapping[str, Callable[[Any], None]]:
    """Makes the widgets; what shows the value of each text, by its name."""
    gui, layout = context.gui, context.layout

    def text(content: Markup) -> Callable[[Markup], None]:
        return partial(setattr, gui.add_html(content), "content")

    def answer(content: Markup) -> Callable[[Markup], None]:
        widget = gui.add_html(answers(content))
        return lambda shown: setattr(widget, "content", answers(shown))

    with layout.drawers["details"]:
        power, trim = answer(Markup()), answer(Markup())
        gui.add_html(tag("div.rx.rx-dim.rx-small.rx-found", WATERFALL_WORDS))
        waterfall = answer(waterfall_chart(()))
    with layout.drawers["trust"]:
        # The status says why there is no answer, too.
        status, doubts = text(status_panel(None)), answer(Markup())
        gui.add_html(trust_page())
    return {
        "details.power": power,
        "details.trim": trim,
        "details.waterfall": waterfall,
        "trust.status": status,
        "trust.doubts": doubts,
        "switch.costs": context.controls.show_costs,
        "switch.bending": context.controls.show_bending,
    }
