"""What the players of a game have reached."""

from collections.abc import Sequence

import numpy as np

from explorer.model.units import Units
from rotor.support.chart import Axis, Chart, Line

_BINS = 10


def histogram(powers: Sequence[float], ends: tuple[float, float], units: Units) -> Chart:
    """How many players have which least power [W], in bins from the least of the game to its start (`ends`)."""
    # Whatever a link holds.
    unit, least, start = (
        units.power[0],
        ends[0],
        max(ends[1], ends[0] + 1.0),
    )
    counts, edges = np.histogram(np.clip(powers, least, start), _BINS, (least, start))
    steps = np.repeat([unit.of(float(edge) - least) for edge in edges], 2)
    heights = np.concatenate([[0.0], np.repeat(counts, 2), [0.0]])
    return Chart(
        "Each player's best",
        Axis(f"{unit.symbol} above the least", (0.0, float(steps[-1]))),
        Axis("players", (0.0, max(float(counts.max()), 4.0))),
        (Line("", steps, heights, filled=True),),
    )
