"""Required against attainable twist along the blade, as chart data."""

import numpy as np

from explorer.charts.plots import Plot, Range, held_range
from explorer.tabs.actuator.state import ActuatorInputs
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.pictures import twist_comparison
from rotor.actuator.verdict import Verdict

_STATIONS = 61


def reach_plot(
    inputs: ActuatorInputs, installed: InstalledActuator, verdict: Verdict | None, root: float, previous: Range | None
) -> Plot:
    """Series: attainable, attainable as counted, required, used by the best twist within reach, now [°].

    Changes from the cut-out outwards; attainable is drawn on the side that is asked for.
    """
    r = np.linspace(root, 1.0, _STATIONS)
    limit = installed.limit(r) - installed.limit(root)
    now = inputs.change(installed, r) - inputs.change(installed, root)
    none = np.full(_STATIONS, np.nan)
    required, used = none, none
    if verdict is not None:
        curves = twist_comparison(verdict, _STATIONS)
        required, used = curves.required, curves.attained
        if required[np.argmax(np.abs(required))] < 0.0:
            limit = -limit
    series = tuple(np.degrees(values) for values in (limit, inputs.share * limit, required, used, now))
    seen = np.concatenate([values[np.isfinite(values)] for values in series])
    return Plot((r, *series), held_range(previous, min(0.0, float(seen.min())), max(0.2, float(seen.max()))))


def blank() -> Plot:
    """An empty chart, on a range that no answer has."""
    none = np.full(2, np.nan)
    return Plot((np.array([0.13, 1.0]), *(none,) * 5), (-1e-3, 1e-3))
