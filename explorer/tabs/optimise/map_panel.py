"""The map of power over two parameters of the concept: its picture, and a click that takes a point."""

import base64
import math
from dataclasses import dataclass
from functools import cache, lru_cache
from html import escape

import numpy as np
import viser
from scipy.ndimage import binary_dilation

from explorer.colours import NOW, colour_map, css
from explorer.model.inputs import with_optimum
from explorer.model.units import SI, Units, number
from explorer.picture.disk_image import encode_png
from explorer.picture.landscape import refined
from explorer.tabs.context import TabContext
from explorer.tabs.layout import by_hand
from explorer.tabs.optimise.optimise_panel import OptimisePanel
from explorer.text.glossary import hint
from explorer.workers.pool import Job, JobEnded, JobEvent, JobFailed, JobProgress
from explorer.workers.solver import MapLevel, MapTask
from rotor import Design
from rotor.arrays import Array
from rotor.chart import round_ticks, tick_text
from rotor.design import TwistLaw
from rotor.optimisation import Concept, Parameter, nearest
from rotor.optimisation.descent import BAND as _BAND

CONTOURS = (0.005, 0.01, 0.02, 0.04, 0.08)
"""Power above the least, as parts of it, at which lines are drawn."""
COLOURS_END = 0.08
"""At which the colours end."""
_WIDE, _HIGH = 508, 380
"""Pixels of the picture: two for each of the drawing's units."""
_LEFT, _TOP, _W, _H = 36, 6, 254, 190
_LEVELS = 200
_LINE, _EDGE = 201, 202
_THICKER = ((0, 0, 0), (0, 1, 1), (0, 1, 0))
"""A pixel more below and to the right."""

FIELD = "Take point"
"""The label of the text field that a click writes to."""


@dataclass(frozen=True, eq=False)
class Map:
    task: MapTask
    powers: Array
    """[W], (rows along y, columns along x); NaN where a design does not trim."""

    @property
    def parameters(self) -> tuple[Parameter, Parameter]:
        x, y = (self.task.concept.parameters[axis] for axis in self.task.axes)
        return x, y

    @property
    def least(self) -> tuple[float, float, float]:
        """Place (0…1 along x and y) and power [W] of the best grid point."""
        row, column = np.unravel_index(np.nanargmin(self.powers), self.powers.shape)
        n = len(self.powers) - 1
        return float(column) / n, float(row) / n, float(self.powers[row, column])


def picture(powers: Array) -> bytes:
    """PNG: colours by power above the least, lines at CONTOURS, the 0.1 % band white within a white edge."""
    values = refined(powers, _WIDE, _HIGH)[::-1]
    excess = values / float(np.nanmin(powers)) - 1.0
    known = np.isfinite(excess)
    excess = np.where(known, excess, 9.0)
    pixels = (1.0 + np.clip(excess / COLOURS_END, 0.0, 1.0) ** 0.5 * (_LEVELS - 1)).astype(np.uint8)
    ring = np.searchsorted([_BAND, *CONTOURS], excess)
    change = np.zeros(ring.shape, dtype=bool)
    change[:, 1:] |= ring[:, 1:] != ring[:, :-1]
    change[1:, :] |= ring[1:, :] != ring[:-1, :]
    pixels[binary_dilation(change, _THICKER)] = _LINE
    band = excess <= _BAND
    pixels[binary_dilation(band, _THICKER, 2) & ~band] = _EDGE
    pixels[~known] = 0
    entries = np.zeros((256, 4), dtype=np.uint8)
    entries[1 : 1 + _LEVELS, :3] = colour_map("sequential", _LEVELS)
    entries[1 : 1 + _LEVELS, 3] = 255
    entries[_LINE] = (255, 255, 255, 130)
    entries[_EDGE] = (255, 255, 255, 255)
    return encode_png(pixels, entries)


def drawing(drawn: Map, here: tuple[float, float] | None, exact: bool) -> str:
    """SVG of a map. `here`: the design on the sliders, 0…1 along each axis; hollow unless `exact`."""
    x, y = drawn.parameters
    at_x, at_y, _ = drawn.least
    data = base64.b64encode(picture(drawn.powers)).decode()
    marks = [_star(_LEFT + at_x * _W, _TOP + (1.0 - at_y) * _H)]
    if here is not None:
        fill = NOW if exact else "none"
        marks.append(
            f'<circle cx="{_LEFT + here[0] * _W:.1f}" cy="{_TOP + (1.0 - here[1]) * _H:.1f}" r="4.5" fill="{fill}" '
            f'stroke="{"#fff" if exact else NOW}" stroke-width="1.8" pointer-events="none"/>'
        )
    return (
        f'<svg viewBox="0 0 300 222" width="100%" class="rx-map" data-explorer="map">'
        f'<image x="{_LEFT}" y="{_TOP}" width="{_W}" height="{_H}" preserveAspectRatio="none" '
        f'href="data:image/png;base64,{data}" {_clicks(x, y)}/>'
        f'<rect x="{_LEFT}" y="{_TOP}" width="{_W}" height="{_H}" fill="none" stroke="currentColor" opacity=".4"/>'
        f"{_axis(x, True)}{_axis(y, False)}{''.join(marks)}</svg>"
    )


def _star(x: float, y: float) -> str:
    points = " ".join(
        f"{x + r * math.sin(k * math.pi / 5.0):.1f},{y - r * math.cos(k * math.pi / 5.0):.1f}"
        for k in range(10)
        for r in (6.5 if k % 2 == 0 else 2.7,)
    )
    return f'<polygon points="{points}" fill="#fff" stroke="#111" stroke-width="1" pointer-events="none"/>'


def _axis(parameter: Parameter, along: bool) -> str:
    low, high = parameter.shown(parameter.low), parameter.shown(parameter.high)
    out = []
    for value in round_ticks(low, high, 5):
        part = (value - low) / (high - low)
        if along:
            at = _LEFT + part * _W
            out.append(f'<text x="{at:.1f}" y="{_TOP + _H + 13}" text-anchor="middle">{tick_text(value)}</text>')
            out.append(f'<path d="M{at:.1f},{_TOP + _H} v4" stroke="currentColor"/>')
        else:
            at = _TOP + (1.0 - part) * _H
            out.append(f'<text x="{_LEFT - 6}" y="{at + 3.5:.1f}" text-anchor="end">{tick_text(value)}</text>')
            out.append(f'<path d="M{_LEFT},{at:.1f} h-4" stroke="currentColor"/>')
    return f'<g font-size="12" fill="currentColor">{"".join(out)}</g>'


def _clicks(x: Parameter, y: Parameter) -> str:
    """Attributes for `explorer/web/page.js`: a click writes its place into the text field, as if it had been typed."""
    across, up = (f"{p.shown(p.low):.6g} {p.shown(p.high):.6g} {_digits(p)}" for p in (x, y))
    return f'data-write="{FIELD}" data-x="{across}" data-y="{up}"'


def least_text(drawn: Map) -> str:
    """The best grid point as it is typed into the text field."""
    places = zip(drawn.parameters, drawn.least[:2], strict=True)
    return " ".join(f"{p.shown(p.low + at * (p.high - p.low)):.{_digits(p)}f}" for p, at in places)


def _digits(parameter: Parameter) -> int:
    return 1 if parameter.angular else 3


def point_of(text: str, drawn: Map) -> tuple[float, ...]:
    """The concept's parameters at a typed or clicked point; ValueError with one sentence for any other text."""
    try:
        x, y = (float(item) for item in text.replace(",", " ").replace("−", "-").split())
    except ValueError:
        raise ValueError(f"{text!r} is not a point: type two numbers, x and y.") from None
    values = list(drawn.task.values)
    for axis, parameter, value in zip(drawn.task.axes, drawn.parameters, (x, y), strict=True):
        inside = parameter.from_shown(value)
        if not (math.isfinite(value) and parameter.low - 1e-9 <= inside <= parameter.high + 1e-9):
            raise ValueError(f"{number(value, 3)} {parameter.shown_unit} lies outside the map.")
        values[axis] = min(max(inside, parameter.low), parameter.high)
    return tuple(values)


def legend(drawn: Map, exact: bool | None, units: Units = SI) -> str:
    """Marks, least power, contour lines, and the fixed parameters; `exact` as in `drawing`, None without a design."""
    mark = "" if exact is None else "● design on the sliders" if exact else "○ nearest to the design on the sliders"
    *place, power = drawn.least
    best = [
        f"{number(p.shown(p.low + part * (p.high - p.low)), 1 if p.angular else 2)} {p.shown_unit}"
        for p, part in zip(drawn.parameters, place, strict=True)
    ]
    held = [
        f"{p.title} {number(p.shown(value), 1 if p.angular else 2)} {p.shown_unit}"
        for k, (p, value) in enumerate(zip(drawn.task.concept.parameters, drawn.task.values, strict=True))
        if k not in drawn.task.axes
    ]
    return (
        '<div class="rx rx-small" data-explorer="map-legend">'
        f"<div>★ {units.watts(power, 1)} at {', '.join(best)}</div>"
        f'<div style="color:{NOW}">{mark}</div>'
        f'<div class="rx-dim">Click the map, or type x and y, such as {least_text(drawn)}.</div>'
        f'<div class="rx-dim">White outline: within {100 * _BAND:g} % of the least.</div>'
        f'<div class="rx-dim">{"Fixed: " + escape(", ".join(held)) + "." if held else ""}</div></div>'
    )


@cache
def colour_bar() -> str:
    """SVG: the colours of power above the least, with the contour lines at their places [%]."""
    colours = colour_map("sequential", 25)
    stops = "".join(f'<stop offset="{k / 24:.3f}" stop-color="{css(rgb)}"/>' for k, rgb in enumerate(colours))
    marks = []
    for part in (0.0, *CONTOURS):
        x = _LEFT + math.sqrt(part / COLOURS_END) * _W
        line = f'<path d="M{x:.1f},2 v9" stroke="#fff" opacity=".8"/>' if 0.0 < part < COLOURS_END else ""
        marks.append(f'{line}<text x="{x:.1f}" y="22" text-anchor="middle">{100 * part:g}</text>')
    return (
        '<svg viewBox="0 0 300 38" width="100%" class="rx-map" data-explorer="map-colours" role="img" '
        'aria-label="colours: power above the least, 0 to 8 %">'
        f'<defs><linearGradient id="rx-map-colours">{stops}</linearGradient></defs>'
        f'<rect x="{_LEFT}" y="2" width="{_W}" height="9" rx="2" fill="url(#rx-map-colours)"/>'
        f'<g font-size="12" fill="currentColor">{"".join(marks)}'
        f'<text x="{_LEFT + _W / 2}" y="35" text-anchor="middle" opacity=".7">'
        "power above the least [%]</text></g></svg>"
    )


def title(drawn: Map) -> str:
    x, y = drawn.parameters
    return (
        f'<div class="rx rx-line rx-small rx-map-title"><span>↑ {escape(y.title)} [{y.shown_unit}]</span>'
        f"<span>{escape(x.title)} [{x.shown_unit}] →</span></div>"
    )


TIME_LIMIT = 120.0
"""[s] a map may take."""
_URGENCY = 2
"""After searches and schedules."""
_NEAR = 1e-3
"""Twist [rad] within which the design on the sliders is a point of the map."""


class MapPanel:
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """The map is of what the search is asked for."""
        self._context, self.search, gui = context, search, context.gui
        self._job: Job | None = None
        self._task: MapTask | None = None
        self.map: Map | None = None
        self._line = "Power over two parameters, the others fixed. Click the map to take a point."
        self._offered: tuple[str, ...] = ()
        self._drawn: object = None
        self._title = gui.add_html("")
        titles = tuple([parameter.title for parameter in self.search.request().known_concept().parameters])
        self._x = gui.add_dropdown("Horizontal", titles, hint=hint("map_across"))
        self._y = gui.add_dropdown("Vertical", titles, hint=hint("map_up"))
        self._draw = gui.add_button("Compute map", icon=viser.Icon.MAP_2, hint=hint("map_draw"))
        self._state = gui.add_html("")
        self._picture = gui.add_html("")
        self._point = gui.add_text(FIELD, "", visible=False, hint=hint("map_point"))
        self._legend = gui.add_html("")
        self._draw.on_click(lambda _: self.begin())
        by_hand(self._point, self._apply)

    def begin(self) -> None:
        """Draw the map of the concept chosen for the search, about the design on the sliders."""
        try:
            design, request = self._context.inputs().design(), self.search.request()
            concept = request.known_concept()
            titles = [parameter.title for parameter in concept.parameters]
            if len(titles) < 2:
                raise ValueError(f"{concept.title} has one parameter: a map needs two; choose another concept.")
            axes = self._axes(titles)
            objective = request.wanted(design, self.search.legs)
        except ValueError as error:
            self._line = str(error)
            self._context.wake()
            return
        values = self.search.optimum_of(design, concept.name) or nearest(concept, design.twist)
        task = self._task = MapTask(design, concept, objective, axes, values)
        if self._job is not None:
            self._context.pool.stop(self._job, quiet=True)
        self._line = "Computing …"
        self._job = self._context.pool.submit(task, lambda news: self._on_event(task, news), TIME_LIMIT, _URGENCY)
        self._context.wake()

    def stop(self) -> None:
        if self._job is not None:
            self._context.pool.stop(self._job, quiet=True)

    def refresh(self, design: Design | None) -> None:
        """Bring the tab into line with the concept and with the design on the sliders."""
        concept = self.search.request().known_concept()
        titles = tuple(parameter.title for parameter in concept.parameters)
        if titles != self._offered:
            self._offered = titles
            first, second = default_axes(concept)
            for menu, axis in ((self._x, first), (self._y, second)):
                menu.options = titles
                menu.value = titles[axis]
        self._title.content = f'<div class="rx rx-dim rx-small">Concept: {concept.title}</div>'
        self._state.content = f'<div class="rx rx-dim rx-small" data-explorer="map-state">{self._line}</div>'
        drawn = self.map
        if drawn is None:
            return
        here, exact = (None, False) if design is None else place_on(drawn, design.twist)
        units = self._context.units
        seen = (id(drawn), here, exact, units)
        if seen != self._drawn:
            self._drawn = seen
            box = f"{title(drawn)}{drawing(drawn, here, exact)}{colour_bar()}"
            self._picture.content = (
                f'<div class="rx" data-explorer="map-box">{box}</div>'
                '<div class="rx rxl-buttons"><button data-map-large>Enlarge the map</button>'
                '<button data-do="landscape" data-value="on">Landscape in the stage</button></div>'
            )
            self._legend.content = legend(drawn, None if here is None else exact, units)
            self._point.visible = True

    def _axes(self, titles: list[str]) -> tuple[int, int]:
        if self._x.value not in titles or self._y.value not in titles:
            return default_axes(self.search.request().known_concept())
        x, y = titles.index(self._x.value), titles.index(self._y.value)
        if x == y:
            raise ValueError("Both axes are the same parameter: choose two.")
        return x, y

    def _on_event(self, task: MapTask, news: JobEvent) -> None:
        if task is not self._task:
            return
        match news:
            case JobProgress(MapLevel(powers)):
                grid = np.array([[np.nan if power is None else power for power in row] for row in powers])
                if np.isfinite(grid).any():
                    self.map = Map(task, grid)
                    mu = task.objective.conditions[0].flight.advance_ratio
                    where = f"at µ {mu:g}" if len(task.objective.conditions) == 1 else "mean of the legs"
                    self._line = f"{len(powers)} × {len(powers)} points, {where}"
                else:
                    self._line = "No design on this map has a trim."
            case JobFailed(message):
                self._line = message
            case JobEnded(late=True):
                self._line += "; time is up."
            case _:
                pass
        self._context.wake()

    def _apply(self, text: str) -> None:
        drawn = self.map
        if drawn is None or not text.strip():
            return
        try:
            inputs = self._context.inputs()
            design = drawn.task.concept.apply(inputs.design(), point_of(text, drawn))
        except ValueError as error:
            self._line = str(error)
            self._context.wake()
            return
        self._context.set_inputs(with_optimum(inputs, design))


def default_axes(concept: Concept) -> tuple[int, int]:
    """Division across and outer rate up, where there are such."""
    motions = [handle.motion for handle in concept.handles]
    if len(motions) < 2:
        return 0, 0
    across = motions.index("slide") if "slide" in motions else 0
    rates = [k for k, motion in enumerate(motions) if motion != "slide" and k != across]
    return across, rates[-1]


@lru_cache(maxsize=8)
def place_on(drawn: Map, twist: TwistLaw) -> tuple[tuple[float, float], bool]:
    """Where a twist, or the nearest of the concept, lies on a map, 0…1, and whether it lies in its plane."""
    task = drawn.task
    values, on_map = nearest(task.concept, twist), list(task.values)
    for axis in task.axes:
        on_map[axis] = values[axis]
    r = np.linspace(0.15, 1.0, 40)
    exact = float(np.abs(task.concept.twist(on_map)(r) - twist(r)).max()) < _NEAR
    x, y = (
        (values[axis] - parameter.low) / (parameter.high - parameter.low)
        for axis, parameter in zip(task.axes, drawn.parameters, strict=True)
    )
    return (x, y), exact
