"""The Map section: power over two parameters of the concept; a click on it takes a point."""

from dataclasses import replace

from explorer.charts.power_map import (
    PowerMap,
    default_axes,
    drawing,
    least_words,
    map_of,
    rail_name,
)
from explorer.model.inputs import with_optimum
from explorer.parts.presses import MapPress
from explorer.text.glossary import hint
from explorer.widgets.context import TabContext
from explorer.widgets.elements import WorkButtons
from explorer.widgets.optimise.optimise_panel import OptimisePanel
from explorer.workers.solver import MapLevel, MapTask
from rotor import Design
from rotor.optimisation import nearest
from rotor.optimisation.descent import BAND
from rotor.support.markup import tag

TIME_LIMIT = 120.0
"""[s] a map may take."""
_URGENCY = 2
"""After searches and schedules."""
NAME = "map"
_BEFORE = "Least power over the other parameters. Click the map to set a point."
_KEY = f"★ least · ○ your design, if it has this concept · white outline: within {100 * BAND:g} % of the least"


class MapPanel:
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """The map is of what the search is asked for."""
        self._context, self._work, self._search, gui = context, context.work, search, context.gui
        self.map: PowerMap | None = None
        """The last with a design that trims."""
        self._level: MapLevel | None = None
        """What of the computation is drawn."""
        self._refused = ""
        """Why what was asked for last is no map."""
        self._offered: tuple[str, ...] = ()
        self._drawn: object = None
        self._title = gui.add_html("")
        titles = tuple(
            [
                rail_name(parameter)
                for parameter in self._search.request().known_concept().parameters
            ]
        )
        self._x = gui.add_dropdown("Horizontal", titles, hint=hint("map_across"))
        self._y = gui.add_dropdown("Vertical", titles, hint=hint("map_up"))
        entries = "map_draw", "stop"
        self._buttons = WorkButtons(
            gui, "Compute map", "Stop", entries, self.begin, lambda: self._work.halt(NAME)
        )
        self._state = gui.add_html("")
        self._picture = gui.add_html("")
        context.bridge.on("map_at", self._take)

    def begin(self) -> None:
        """The map of the concept chosen for the search, about the design on the sliders."""
        try:
            task, self._refused = self._task(), ""
        except ValueError as error:
            self._refused = str(error)
            self._context.wake()
        else:
            self._work.begin(NAME, task, TIME_LIMIT, _URGENCY, restarts=True)

    def _task(self) -> MapTask:
        """ValueError with one sentence where there is no map."""
        design, request = self._context.inputs().design(), self._search.request()
        concept = request.known_concept()
        titles = [rail_name(parameter) for parameter in concept.parameters]
        if len(titles) < 2:
            raise ValueError(
                f"{concept.title} has one parameter: a map needs two; choose another concept."
            )
        axes = self._axes(titles)
        objective = replace(request.wanted(design, self._search.mission), quantity="total")
        values = self._search.optimum_of(design, concept.name) or nearest(concept, design.twist)
        return MapTask(design, concept, objective, axes, values)

    def refresh(self, design: Design | None) -> None:
        """Bring the tab into line with the concept. `design`: on the sliders; None when they mean none."""
        concept = self._search.request().known_concept()
        titles = tuple(rail_name(parameter) for parameter in concept.parameters)
        if titles != self._offered:
            self._offered = titles
            first, second = default_axes(concept)
            for menu, axis in ((self._x, first), (self._y, second)):
                menu.options = titles
                menu.value = titles[axis]
        self._title.content = tag("div.rx.rx-dim.rx-small", f"Concept: {concept.title}")
        self._state.content = tag("div.rx.rx-dim.rx-small", self._line(), data_explorer="map-state")
        record = self._work[NAME]
        done = (
            None
            if record is None
            else max([r for r in record.reports if isinstance(r, float)], default=0.0)
        )
        self._buttons.show(done, record is not None and record.under_way)
        drawn = self.map
        if drawn is None:
            return
        twist, units = None if design is None else design.twist, self._context.units
        seen = drawn, twist, units
        if seen != self._drawn:
            self._drawn = seen
            across, up = (f"{rail_name(p)} [{p.shown_unit}]" for p in drawn.parameters)
            self._picture.content = tag(
                "div.rx.rx-small",
                tag("div.rx-line", tag("span", f"↑ {up}"), tag("span", f"{across} →")),
                drawing(drawn, twist),
                tag("div", least_words(drawn, units), data_explorer="map-least"),
                tag("div.rx-dim", _KEY),
            )

    def _take(self, place: MapPress) -> None:
        """The map was clicked: its design there goes onto the sliders."""
        if self.map is not None:
            self._context.set_inputs(
                with_optimum(self._context.inputs(), self.map.at(place.x, place.y))
            )

    def _axes(self, titles: list[str]) -> tuple[int, int]:
        if self._x.value not in titles or self._y.value not in titles:
            return default_axes(self._search.request().known_concept())
        x, y = titles.index(self._x.value), titles.index(self._y.value)
        if x == y:
            raise ValueError("Both axes are the same parameter: choose two.")
        return x, y

    def _line(self) -> str:
        """Takes the last powers, and says how the map stands."""
        record = self._work[NAME]
        if self._refused or record is None:
            return self._refused or _BEFORE
        levels = [report for report in record.reports if isinstance(report, MapLevel)]
        line = (
            "No design on this map has a trim."
            if levels
            else "Computing …"
            if record.under_way
            else "No map"
        )
        if levels:
            last = levels[-1]
            if last is not self._level:
                self._level = last
                self.map = map_of(record.task, levels) or self.map
            if last.least[0] is not None:
                conditions = record.task.objective.conditions
                mu = conditions[0].flight.advance_ratio
                where = f"at µ {mu:g}" if len(conditions) == 1 else "mean of the legs"
                line = f"{last.rows} × {len(last.powers)} points, {where}"
        ended = {"late": "; time is up.", "stopped": "; stopped."}.get(record.state, "")
        return record.sentence or line + ended
