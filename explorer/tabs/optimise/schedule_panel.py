"""The Schedule section: best twist per speed, best fixed blade, the gain of moving; mission mix; CSV."""

from collections.abc import Callable
from functools import partial
from typing import Any

import viser

from explorer.model.inputs import with_optimum
from explorer.tabs.background import BackgroundWork
from explorer.tabs.context import Player, TabContext
from explorer.tabs.live_charts import PanelChart
from explorer.tabs.optimise import schedule_view
from explorer.tabs.optimise import search_run as mission
from explorer.tabs.optimise.optimise_panel import OptimisePanel
from explorer.tabs.optimise.schedule_view import PlanProgress, ScheduleFlight
from explorer.text.glossary import hint
from explorer.workers.solver import FixedPowers, ScheduleTask
from rotor import Design
from rotor.markup import tag
from rotor.optimisation import Cell, Plan, WeightedCondition
from rotor.processes import JobEnded, JobEvent, JobFailed, JobProgress, JobQueued, JobStarted

TIME_LIMIT = 180.0
"""[s] a schedule may take."""
_STAYS = 1.5
"""[s] the end of the playback is shown."""
_URGENCY = 1
"""After searches."""


class SchedulePanel(BackgroundWork):
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """Concept, limits and starts are those that the search is asked for; it gets the mission's legs."""
        super().__init__(context.pool, context.wake, TIME_LIMIT, _URGENCY)
        self._context = context
        self._request, gui = search.request, context.gui
        search.legs = self.legs
        self._flight: ScheduleFlight | None = None
        self._time = 0.0
        self._player = Player(self._fly_on, "schedule-flight")
        context.bridge.on("land", lambda _: self.land())
        self._progress: PlanProgress | None = None
        self.line = "Best twist for each leg, and the best fixed blade for all."
        self._drawn: object = None
        self._concept = gui.add_html("")
        with gui.add_folder("Mission"):
            gui.add_html(tag("div.rxp-columns", tag("span", "µ"), tag("span", "hours")))
            self._rows = [
                gui.add_vector2(
                    f"Leg {k + 1}",
                    (row.advance_ratio, row.hours),
                    min=(0.0, 0.0),
                    max=(0.45, 99.0),
                    step=0.05,
                    hint=hint("leg"),
                )
                for k, row in enumerate(mission.ROWS)
            ]
        self.add_buttons(gui, "Compute schedule", "Stop schedule", ("schedule", "schedule_stop"))
        self._state = gui.add_html("")
        self._table = gui.add_html("")
        self._results = gui.add_button_group(
            "Result", ("Apply fixed", "Play", "Save CSV"), visible=False, hint=hint("schedule_result")
        )
        self._twists, self._savings = PanelChart(gui), PanelChart(gui)
        self._results.on_click(self._result_clicked)

    def legs(self, design: Design) -> tuple[WeightedCondition, ...]:
        """The mission's legs; ValueError with one sentence for an invalid mission."""
        return mission.legs(design, [mission.MissionRow(*(float(x) for x in row.value)) for row in self._rows])

    def prepare(self) -> tuple[ScheduleTask, Callable[[JobEvent], None], str]:
        """The mission of the rows, for the concept that the search is asked for."""
        design, request = self._context.inputs().design(), self._request()
        concept = request.known_concept()
        plan = Plan(
            design,
            (concept,),
            self.legs(design),
            "induced" if request.objective == "induced" else "total",
            request.limits(design),
            request.starts,
        )
        progress = self._progress = PlanProgress(plan)
        return ScheduleTask(plan), partial(self._hear, progress), "Starting a worker …"

    def halt(self) -> None:
        """Stop; what was found stays."""
        if self.running:
            self.line = "Stopping …"
        super().halt()

    def play(self) -> None:
        """Fly the schedule: speed runs, the blade untwists, savings count up; pressed again, stop."""
        if self._flight is not None:
            self.land()
            return
        progress = self._progress
        if progress is None:
            return
        try:
            self._flight, self._time = ScheduleFlight(progress), 0.0
        except ValueError as error:
            self.line = str(error)
        else:
            self._context.tracker.reset()
            self._player.play()
        self._context.wake()

    def land(self) -> None:
        """Stop the playback; the page shows the sliders again."""
        if self._flight is not None:
            self._context.tracker.reset()
        self._flight = None
        self._player.pause()
        self._context.wake()

    def preview(self) -> Design | None:
        """The design of the playback to show instead of the sliders'."""
        flight = self._flight
        return None if flight is None else flight.at(self._time).design

    def notice(self) -> dict[str, object] | None:
        """The bar over the scene during the playback."""
        flight = self._flight
        if flight is None:
            return None
        numbers = flight.at(self._time).numbers(self._context.units)
        text = " · ".join(f"{caption} {value}" for caption, value in numbers)
        return {"text": text[:1].upper() + text[1:], "actions": [("land", "Stop")]}

    def _fly_on(self, seconds: float) -> None:
        flight = self._flight
        if flight is None:
            return
        self._time += seconds
        if self._time > flight.seconds + _STAYS:
            self.land()
        else:
            self._context.wake()

    def stop(self) -> None:
        self._player.pause()
        super().stop()

    def refresh(self) -> None:
        """Bring everything that only shows into line."""
        title = self._request().known_concept().title
        self._concept.content = tag("div.rx.rx-dim.rx-small", f"Concept: {title}")
        kind = "running" if self.running else "idle" if self._progress is None else "done"
        self._state.content = tag("div.rx.rx-dim", self.line, data_explorer="schedule-state", data_kind=kind)
        progress = self._progress
        self.show_progress(progress and (progress.part_done if self.running else 1.0), self.running)
        if progress is None:
            return
        self._results.visible = not self.running and progress.at(None) is not None
        units = self._context.units
        seen = (id(progress), len(progress.cells), len(progress.fixed_powers), units)
        if seen != self._drawn:
            self._drawn = seen
            self._table.content = schedule_view.table(progress, units)
            self._twists.show(schedule_view.twist_chart(progress, self._twists.y_range))
            self._savings.show(schedule_view.saving_chart(progress, self._savings.y_range))

    def _hear(self, progress: PlanProgress, news: JobEvent) -> None:
        match news:
            case JobQueued(ahead):
                self.line = "Waiting: next in line" if ahead == 0 else f"Waiting: {ahead} ahead"
            case JobStarted():
                self.line = progress.count
            case JobProgress(Cell() as cell):
                progress.cells.append(cell)
                self.line = progress.count
            case JobProgress(FixedPowers(powers)):
                progress.fixed_powers = powers
            case JobEnded(_, stopped, late):
                why = "Time is up" if late else "Stopped"
                self.line = f"{why}: {progress.count} kept." if late or stopped else "Done."
            case JobFailed(message):
                self.line = message
            case _:
                pass

    def _result_clicked(self, event: viser.GuiEvent[Any]) -> None:
        progress = self._progress
        if progress is None:
            return
        if event.target.value == "Save CSV":
            self._context.download("twist-schedule.csv", schedule_view.csv_of(progress))
            return
        if event.target.value == "Play":
            self.play()
            return
        fixed = progress.at(None)
        if fixed is not None and fixed.best is not None:
            self._context.set_inputs(with_optimum(self._context.inputs(), fixed.design))
