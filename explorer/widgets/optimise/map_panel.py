"""The Map section: power over two parameters of the concept; a click on it takes a point."""

from collections.abc import Callable
from functools import partial

import numpy as np
import viser

from explorer.charts.power_map import PowerMap, default_axes, drawing, least_words
from explorer.model.inputs import with_optimum
from explorer.parts.presses import MapPress
from explorer.text.glossary import hint
from explorer.widgets.context import TabContext
from explorer.widgets.optimise.optimise_panel import OptimisePanel
from explorer.workers.background import BackgroundWork
from explorer.workers.solver import MapLevel, MapTask
from rotor import Design
from rotor.optimisation import nearest
from rotor.optimisation.descent import BAND
from rotor.support.markup import tag
from rotor.support.processes import JobEnded, JobEvent, JobFailed, JobProgress

TIME_LIMIT = 120.0
"""[s] a map may take."""
_URGENCY = 2
"""After searches and schedules."""
_KEY = f"★ least · ● your design, ○ nearest point to it · white outline: within {100 * BAND:g} % of the least"


class MapPanel(BackgroundWork):
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """The map is of what the search is asked for."""
        super().__init__(context.pool, context.wake, TIME_LIMIT, _URGENCY, restarts=True)
        self._context = context
        self._search, gui = search, context.gui
        self.map: PowerMap | None = None
        self.line = "Power over two parameters, the others fixed. Click the map to set a point."
        self._offered: tuple[str, ...] = ()
        self._drawn: object = None
        self._title = gui.add_html("")
        titles = tuple([parameter.title for parameter in self._search.request().known_concept().parameters])
        self._x = gui.add_dropdown("Horizontal", titles, hint=hint("map_across"))
        self._y = gui.add_dropdown("Vertical", titles, hint=hint("map_up"))
        self._draw = gui.add_button("Compute map", icon=viser.Icon.MAP_2, hint=hint("map_draw"))
        self._state = gui.add_html("")
        self._picture = gui.add_html("")
        self._draw.on_click(lambda _: self.begin())
        context.bridge.on("map_at", self._take)

    def prepare(self) -> tuple[MapTask, Callable[[JobEvent], None], str]:
        """The map of the concept chosen for the search, about the design on the sliders."""
        design, request = self._context.inputs().design(), self._search.request()
        concept = request.known_concept()
        titles = [parameter.title for parameter in concept.parameters]
        if len(titles) < 2:
            raise ValueError(f"{concept.title} has one parameter: a map needs two; choose another concept.")
        axes = self._axes(titles)
        objective = request.wanted(design, self._search.legs)
        values = self._search.optimum_of(design, concept.name) or nearest(concept, design.twist)
        task = MapTask(design, concept, objective, axes, values)
        return task, partial(self._hear, task), "Computing …"

    def refresh(self, design: Design | None) -> None:
        """Bring the tab into line with the concept. `design`: on the sliders; None when they mean none."""
        concept = self._search.request().known_concept()
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
        twist, units = None if design is None else design.twist, self._context.units
        seen = drawn, twist, units
        if seen != self._drawn:
            self._drawn = seen
            across, up = (f"{p.title} [{p.shown_unit}]" for p in drawn.parameters)
            self._picture.content = tag(
                "div.rx.rx-small",
                tag("div.rx-line", tag("span", f"↑ {up}"), tag("span", f"{across} →")),
                drawing(drawn, twist),
                tag("div", least_words(drawn, units), data_explorer="map-least"),
                tag("div.rx-dim", _KEY),
            )

    def _take(self, place: MapPress) -> None:
        """The map was clicked: its design there goes onto the sliders."""
        if self.map is not None and not self._context.held:
            design = self.map.task.at(place.x, place.y)
            self._context.set_inputs(with_optimum(self._context.inputs(), design))

    def _axes(self, titles: list[str]) -> tuple[int, int]:
        if self._x.value not in titles or self._y.value not in titles:
            return default_axes(self._search.request().known_concept())
        x, y = titles.index(self._x.value), titles.index(self._y.value)
        if x == y:
            raise ValueError("Both axes are the same parameter: choose two.")
        return x, y

    def _hear(self, task: MapTask, news: JobEvent) -> None:
        match news:
            case JobProgress(MapLevel(powers)):
                grid = np.array([[np.nan if power is None else power for power in row] for row in powers])
                if np.isfinite(grid).any():
                    self.map = PowerMap(task, grid)
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
