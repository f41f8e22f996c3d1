"""The Map tab: power over two parameters of the concept, in the background, and a click that takes a point."""

import numpy as np
import viser

from explorer.interface import TabContext
from explorer.state import with_optimum
from explorer.tabs.optimise import power_map
from explorer.tabs.optimise.optimise_panel import OptimisePanel
from explorer.text.glossary import hint
from explorer.text.units import UNITS
from explorer.workers.job import Job, JobEnded, JobEvent, JobFailed, JobProgress
from explorer.workers.pool import PoolClient
from explorer.workers.tasks import MapLevel, MapTask
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.optimisation.concepts import Concept, nearest

TIME_LIMIT = 120.0
"""[s] a map may take."""
_URGENCY = 2
"""After searches and schedules."""
_NEAR = 1e-3
"""Twist [rad] within which the design on the sliders is a point of the map."""


class MapPanel:
    """One session's map."""

    def __init__(self, gui: viser.GuiApi, pool: PoolClient, context: TabContext, search: OptimisePanel) -> None:
        """The map is of what the Optimise tab asks for."""
        self._pool, self._context, self._search, self._request = pool, context, search, search.request
        self._job: Job | None = None
        self._task: MapTask | None = None
        self._map: power_map.Map | None = None
        self._line = "Power over two parameters, the others fixed. Click the map to take a point."
        self._offered: tuple[str, ...] = ()
        self._drawn: object = None
        self._here: tuple[object, tuple[float, ...], bool] | None = None
        self._title = gui.add_html("")
        titles = tuple([parameter.title for parameter in self._request().known_concept().parameters])
        self._x = gui.add_dropdown("Horizontal", titles, hint=hint("map_across"))
        self._y = gui.add_dropdown("Vertical", titles, hint=hint("map_up"))
        self._draw = gui.add_button("Compute map", icon=viser.Icon.MAP_2, hint=hint("map_draw"))
        self._state = gui.add_html("")
        self._picture = gui.add_html("")
        self._point = gui.add_text(power_map.FIELD, "", visible=False, hint=hint("map_point"))
        self._legend = gui.add_html("")
        self._draw.on_click(lambda _: self.begin())
        self._point.on_update(lambda event: self._take() if event.client is not None else None)

    def begin(self) -> None:
        """Draw the map of the concept chosen for the search, about the design on the sliders."""
        try:
            design, request = self._context.inputs().design(), self._request()
            concept = request.known_concept()
            titles = [parameter.title for parameter in concept.parameters]
            if len(titles) < 2:
                raise ValueError(f"{concept.title} has one parameter: a map needs two; choose another concept.")
            axes = self._axes(titles)
            objective = request.wanted(design, self._search.legs)
        except ValueError as error:
            self._line = str(error)
            self._context.wake()
            return
        values = self._search.optimum_of(design, concept.name) or nearest(concept, design.twist)
        task = self._task = MapTask(design, concept, objective, axes, values)
        if self._job is not None:
            self._pool.stop(self._job, quiet=True)
        self._line = "Computing …"
        self._job = self._pool.submit(task, lambda news: self._on_event(task, news), TIME_LIMIT, _URGENCY)
        self._context.wake()

    def stop(self) -> None:
        """The browser has left."""
        if self._job is not None:
            self._pool.stop(self._job, quiet=True)

    def refresh(self, design: Design | None) -> None:
        """Bring the tab into line with the concept and with the design on the sliders."""
        concept = self._request().known_concept()
        titles = tuple(parameter.title for parameter in concept.parameters)
        if titles != self._offered:
            self._offered = titles
            first, second = default_axes(concept)
            for menu, axis in ((self._x, first), (self._y, second)):
                menu.options = titles
                menu.value = titles[axis]
        self._title.content = f'<div class="rx rx-dim rx-small">Concept: {concept.title}</div>'
        self._state.content = f'<div class="rx rx-dim rx-small" data-explorer="map-state">{self._line}</div>'
        drawn = self._map
        if drawn is None:
            return
        here, exact = self._place(drawn, design)
        units = UNITS[self._context.view().units]
        seen = (id(drawn), here, exact, units)
        if seen != self._drawn:
            self._drawn = seen
            self._picture.content = (
                f'<div class="rx">{power_map.title(drawn)}{power_map.drawing(drawn, here, exact)}</div>'
            )
            self._legend.content = power_map.legend(drawn, units)
            self._point.visible = True

    def _axes(self, titles: list[str]) -> tuple[int, int]:
        if self._x.value not in titles or self._y.value not in titles:
            return default_axes(self._request().known_concept())
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
                    self._map = power_map.Map(task, grid)
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

    def _place(self, drawn: power_map.Map, design: Design | None) -> tuple[tuple[float, float] | None, bool]:
        """Where the design on the sliders lies on the map, and whether it lies in its plane."""
        if design is None:
            return None, False
        key = (id(drawn.task), design.twist)
        if self._here is None or self._here[0] != key:
            self._here = (key, *_nearest_place(drawn, design.twist))
        _, place, exact = self._here
        return (place[0], place[1]), exact

    def _take(self) -> None:
        drawn = self._map
        if drawn is None or not self._point.value.strip():
            return
        try:
            inputs = self._context.inputs()
            design = drawn.task.concept.apply(inputs.design(), power_map.point_of(self._point.value, drawn))
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


def _nearest_place(drawn: power_map.Map, twist: TwistLaw) -> tuple[tuple[float, ...], bool]:
    task = drawn.task
    values = nearest(task.concept, twist)
    on_map = list(task.values)
    for axis in task.axes:
        on_map[axis] = values[axis]
    r = np.linspace(0.15, 1.0, 40)
    exact = float(np.abs(task.concept.twist(on_map)(r) - twist(r)).max()) < _NEAR
    place = tuple(
        (values[axis] - parameter.low) / (parameter.high - parameter.low)
        for axis, parameter in zip(task.axes, drawn.parameters, strict=True)
    )
    return place, exact
