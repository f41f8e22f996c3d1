"""Where to twist: the change of power by pitch along the blade, as a chart and as colours on the reference blade."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from explorer.charts.plots import Range, held_range
from explorer.charts.strip import role_line
from explorer.colours import BASELINE, colour_map
from explorer.model.session_state import SessionState
from explorer.picture.blade_mesh import BladeShape, blade_shape, blade_vertices
from explorer.picture.picture import drawn_bending, flown_twist, follows_azimuth
from explorer.scene.overlays import Strip
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.live_charts import PanelChart
from explorer.text.glossary import READOUTS, hint
from rotor import Solution
from rotor.arrays import Array
from rotor.chart import Axis, Chart, Line
from rotor.design import TwistLaw
from rotor.markup import Markup, tag
from rotor.trim import PitchGradient
from rotor.trim.adjoint import adjoint_of, power_along

_KILOWATT_PER_DEGREE = math.radians(1.0) / 1e3
_ALONG, _ACROSS = 150, 9
_COLOURS = 127


def sensitivity_chart(solution: Solution, previous: Range | None, pinned: Solution | None = None) -> Chart:
    """Induced power alone, total power of A and, last, total power. Trim kept throughout.

    All in kW per degree per unit of r/R; there is no A where none is pinned or it has no trim.
    """
    adjoint = adjoint_of(solution)
    total, induced = (power_along(adjoint, power) for power in ("total", "induced"))
    lines = [Line("induced", induced.r, induced.density * _KILOWATT_PER_DEGREE, BASELINE, "5 3", 1.5)]
    if pinned is not None and pinned.converged:
        along = _of_pinned(pinned)
        lines.append(role_line("pinned", along.r, along.density * _KILOWATT_PER_DEGREE, label="A"))
    here = "B" if len(lines) > 1 else "total"
    lines.append(role_line("saving", total.r, total.density * _KILOWATT_PER_DEGREE, label=here))
    seen = [value for line in lines for value in line.y if math.isfinite(value)]
    y_range = held_range(previous, min(-1.0, *seen), max(1.0, *seen))
    note = READOUTS["chart_sensitivity"].text
    return Chart("dP/dθ", Axis("r/R", (0.1, 1.02)), Axis("kW/° per r/R", y_range), tuple(lines), note=note)


@lru_cache(maxsize=4)
def _of_pinned(solution: Solution) -> PitchGradient:
    """A stays while the sliders move: half the work of a round."""
    return power_along(adjoint_of(solution), "total")


def strip(
    shape: BladeShape, twist: TwistLaw, exaggeration: float, chart: Chart, bent: Array | None = None
) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """Points just above the reference blade, in blade axes, (n, 3), and their colours: rust costs power, blue saves."""
    count, around = shape.rings.shape[:2]
    rings = blade_vertices(shape, twist, exaggeration, bent)[: count * around].reshape(count, around, 3)[6:]
    upper = rings[:, : around // 2 + 1]  # From the trailing edge over the upper side to the nose.
    r = np.linspace(float(shape.r[6]), 1.0, _ALONG)
    columns = np.linspace(1, upper.shape[1] - 2, _ACROSS).astype(int)
    points = np.stack(
        [[np.interp(r, shape.r[6:], upper[:, column, axis]) for axis in range(3)] for column in columns], axis=0
    )
    points[:, 2] += 0.03
    stations, along = _total(chart)
    values = np.interp(r, stations, along)
    half = max(map(abs, chart.span("y")))
    signed = np.sign(values) * np.sqrt(np.minimum(np.abs(values) / half, 1.0))  # The tip would outshine all else.
    shades = np.rint((0.5 + 0.5 * signed) * (_COLOURS - 1)).astype(int)
    colours = np.broadcast_to(colour_map("diverging", _COLOURS)[shades], (len(columns), _ALONG, 3))
    return points.transpose(0, 2, 1).reshape(-1, 3).astype(np.float32), colours.reshape(-1, 3).copy()


def _total(chart: Chart) -> tuple[Array, Array]:
    """r/R and power of its last line."""
    line = chart.series[-1]
    assert isinstance(line, Line)
    return np.array(line.x), np.array(line.y)


def explanation(chart: Chart) -> Markup:
    """What to do, in a line, under the chart."""
    r, values = _total(chart)
    if not np.isfinite(values).all():
        return Markup()
    up, down = float(r[np.argmin(values)]), float(r[np.argmax(values)])
    if max(abs(values)) < 1.0:
        return _box("No local change of pitch saves power: the twist is near its optimum.")
    return _box(
        f"Power falls fastest with more pitch near {up:.2f} R and less pitch near {down:.2f} R, retrimmed. "
        "Uniform pitch is absorbed by collective."
    )


def _box(text: str) -> Markup:
    return tag("div.rx.rx-dim.rx-small.rx-where", text, data_explorer="sensitivity")


_HEIGHT = 220
_WORDS = (
    "Power sensitivity to local pitch, with the rotor retrimmed: positive where more pitch costs power, negative where "
    "it saves."
)


class SensitivityPanel(Tab):
    def __init__(self, context: TabContext, strip: Strip) -> None:
        self._strip, self._layout, gui = strip, context.layout, context.gui
        self._shown: tuple[Solution, Solution | None, bool, float, float] | None = None
        gui.add_html(tag("div.rx.rx-dim.rx-small.rx-found", _WORDS))
        self._chart = PanelChart(gui, _HEIGHT)
        self._words = gui.add_html("")
        self._paint = gui.add_checkbox("Paint blade", False, hint=hint("paint"))
        self._paint.on_update(lambda _: context.wake())

    def show(self, state: SessionState) -> None:
        solution, exaggeration, paint = state.solution, state.view.exaggeration, self._paint.value
        turning = paint and follows_azimuth(solution)  # The paint lies on the blade as flown.
        wanted = (solution, state.pinned, paint, exaggeration, state.view.azimuth_deg if turning else 0.0)
        if self._shown == wanted:
            return
        if not (paint or self._layout.drawer == "twist"):  # The chart costs an adjoint of its own.
            self.show_failure()  # What stands here is no longer this solution's.
            return
        chart = sensitivity_chart(solution, self._chart.y_range, state.pinned)
        self._chart.show(chart)
        self._words.content = explanation(chart)
        if paint:
            shape = blade_shape(solution.design.rotor)
            psi = math.radians(state.view.azimuth_deg)
            bent = drawn_bending(solution, shape.r, psi)
            self._strip.show(*strip(shape, flown_twist(solution, psi), exaggeration, chart, bent))
        else:
            self._strip.hide()
        self._shown = wanted

    def show_failure(self) -> None:
        """The answer no longer holds."""
        self._shown = None
        self._strip.hide()
