"""The map of power over two parameters of the concept: its axes and its trims, which the stage shows as a landscape."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
import viser

from explorer.model.units import Units, number
from explorer.tabs.background import BackgroundWork
from explorer.tabs.context import TabContext
from explorer.tabs.optimise.optimise_panel import OptimisePanel
from explorer.text.glossary import hint
from explorer.workers.solver import MapLevel, MapTask
from rotor.arrays import Array
from rotor.design import TwistLaw
from rotor.markup import group, tag
from rotor.optimisation import Concept, Parameter, nearest
from rotor.processes import JobEnded, JobEvent, JobFailed, JobProgress


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


def least_words(drawn: Map, units: Units) -> str:
    """The best grid point, and the parameters that the map holds."""

    def at(parameter: Parameter, value: float) -> str:
        return f"{number(parameter.shown(value), 1 if parameter.angular else 2)} {parameter.shown_unit}"

    *place, power = drawn.least
    best = [at(p, p.low + part * (p.high - p.low)) for p, part in zip(drawn.parameters, place, strict=True)]
    held = [
        f"{p.title} {at(p, value)}"
        for k, (p, value) in enumerate(zip(drawn.task.concept.parameters, drawn.task.values, strict=True))
        if k not in drawn.task.axes
    ]
    fixed = f" Fixed: {', '.join(held)}." if held else ""
    return f"Least {units.watts(power, 1)} at {', '.join(best)}.{fixed}"


TIME_LIMIT = 120.0
"""[s] a map may take."""
_URGENCY = 2
"""After searches and schedules."""
_NEAR = 1e-3
"""Twist [rad] within which the design on the sliders is a point of the map."""


class MapPanel(BackgroundWork):
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """The map is of what the search is asked for."""
        super().__init__(context.pool, context.wake, TIME_LIMIT, _URGENCY, restarts=True)
        self._context = context
        self.search, gui = search, context.gui
        self.map: Map | None = None
        self.line = "Power over two parameters, the others fixed, as a landscape in the stage."
        self._offered: tuple[str, ...] = ()
        self._title = gui.add_html("")
        titles = tuple([parameter.title for parameter in self.search.request().known_concept().parameters])
        self._x = gui.add_dropdown("Horizontal", titles, hint=hint("map_across"))
        self._y = gui.add_dropdown("Vertical", titles, hint=hint("map_up"))
        self._draw = gui.add_button("Compute map", icon=viser.Icon.MAP_2, hint=hint("map_draw"))
        self._state = gui.add_html("")
        self._least = gui.add_html("")
        self._draw.on_click(lambda _: self.begin())

    def prepare(self) -> tuple[MapTask, Callable[[JobEvent], None], str]:
        """The map of the concept chosen for the search, about the design on the sliders."""
        design, request = self._context.inputs().design(), self.search.request()
        concept = request.known_concept()
        titles = [parameter.title for parameter in concept.parameters]
        if len(titles) < 2:
            raise ValueError(f"{concept.title} has one parameter: a map needs two; choose another concept.")
        axes = self._axes(titles)
        objective = request.wanted(design, self.search.legs)
        values = self.search.optimum_of(design, concept.name) or nearest(concept, design.twist)
        task = MapTask(design, concept, objective, axes, values)
        return task, partial(self._hear, task), "Computing …"

    def refresh(self) -> None:
        """Bring the tab into line with the concept."""
        concept = self.search.request().known_concept()
        titles = tuple(parameter.title for parameter in concept.parameters)
        if titles != self._offered:
            self._offered = titles
            first, second = default_axes(concept)
            for menu, axis in ((self._x, first), (self._y, second)):
                menu.options = titles
                menu.value = titles[axis]
        self._title.content = tag("div.rx.rx-dim.rx-small", f"Concept: {concept.title}")
        self._state.content = tag("div.rx.rx-dim.rx-small", self.line, data_explorer="map-state")
        drawn = self.map
        if drawn is None:
            return
        words = least_words(drawn, self._context.units)
        open_it = tag("button", "Landscape in the stage", data_do="landscape", data_value="on")
        line = tag("div.rx.rx-small", words, data_explorer="map-least")
        self._least.content = group(line, tag("div.rx.rxl-buttons", open_it))

    def _axes(self, titles: list[str]) -> tuple[int, int]:
        if self._x.value not in titles or self._y.value not in titles:
            return default_axes(self.search.request().known_concept())
        x, y = titles.index(self._x.value), titles.index(self._y.value)
        if x == y:
            raise ValueError("Both axes are the same parameter: choose two.")
        return x, y

    def _hear(self, task: MapTask, news: JobEvent) -> None:
        match news:
            case JobProgress(MapLevel(powers)):
                grid = np.array([[np.nan if power is None else power for power in row] for row in powers])
                if np.isfinite(grid).any():
                    self.map = Map(task, grid)
                    mu = task.objective.conditions[0].flight.advance_ratio
                    where = f"at µ {mu:g}" if len(task.objective.conditions) == 1 else "mean of the legs"
                    self.line = f"{len(powers)} × {len(powers)} points, {where}"
                else:
                    self.line = "No design on this map has a trim."
            case JobFailed(message):
                self.line = message
            case JobEnded(late=True):
                self.line += "; time is up."
            case _:
                pass


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
