"""The chart of a search: power against evaluation, every start its own line, the best above them."""

import numpy as np
import viser

from explorer.tabs.chart_panel import Chart, line
from explorer.tabs.optimise.plot import TRACES, search_plot
from explorer.theme.colours import BASELINE, THIS, colour_map, css

_HEIGHT = 118


def search_chart(gui: viser.GuiApi) -> Chart:
    """Made once, empty; what it shows later is `search_plot`."""
    # In steps of seven, so that a few starts already have colours apart.
    shades = colour_map("sequential", TRACES + 2)[7 * np.arange(TRACES) % TRACES]
    blank = search_plot(None, None)
    return Chart(
        gui,
        "Power [kW] per start",
        (("best", THIS), ("current design", BASELINE)),
        "evaluation",
        (
            line("current design", BASELINE, 1.5, (5, 3)),
            *(line(f"start {k + 1}", css(shades[k]), 1.0) for k in range(TRACES)),
            line("best", THIS, 2.2),
        ),
        blank,
        blank.x_range or (1.0, 2.0),
        _HEIGHT,
    )
