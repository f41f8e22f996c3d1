"""The Schedule section: best twist per speed, best fixed blade, the gain of moving; mission mix; CSV."""

from collections.abc import Callable
from functools import partial
from typing import Any

import viser

from explorer.charts import schedule_view
from explorer.charts.schedule_view import ScheduleProgress
from explorer.model import search_run as mission
from explorer.model.inputs import with_optimum
from explorer.text.glossary import hint
from explorer.widgets.context import TabContext
from explorer.widgets.elements import PanelChart, WorkButtons
from explorer.widgets.optimise.optimise_panel import OptimisePanel
from explorer.workers.background import BackgroundWork
from explorer.workers.solver import FixedPowers, ScheduleTask
from rotor import Design
from rotor.optimisation import ScheduleOptimum, SchedulePlan, WeightedCondition
from rotor.optimisation.search import STARTS
from rotor.support.markup import tag
from rotor.support.processes import JobEnded, JobEvent, JobFailed, JobProgress, JobQueued, JobStarted

TIME_LIMIT = 180.0
"""[s] a schedule may take."""
_URGENCY = 1
"""After searches."""


class SchedulePanel(BackgroundWork):
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """Concept, limits and starts are those that the search is asked for; it gets the mission's legs."""
        super().__init__(context.pool, context.wake, TIME_LIMIT, _URGENCY)
        self._context = context
        self._request, gui = search.request, context.gui
        search.legs = self.legs
        self._progress: ScheduleProgress | None = None
        self.line = "Best twist for each leg, and the best fixed blade for all."
        self._drawn: object = None
        self._concept = gui.add_html("")
        self._mission = gui.add_text("Legs, µ:hours", mission.MISSION, multiline=True, hint=hint("mission"))
        self._mission.on_update(lambda _: context.wake())
        self._read = gui.add_html("")
        self._buttons = WorkButtons(gui, self, "Compute schedule", "Stop schedule", ("schedule", "schedule_stop"))
        self._state = gui.add_html("")
        self._table = gui.add_html("")
        self._results = gui.add_button_group(
            "Result", ("Apply fixed", "Save CSV"), visible=False, hint=hint("schedule_result")
        )
        self._twists, self._savings = PanelChart(gui), PanelChart(gui)
        self._results.on_click(self._result_clicked)

    def legs(self, design: Design) -> tuple[WeightedCondition, ...]:
        """The mission's legs; ValueError with one sentence for an invalid mission."""
        return mission.legs(design, self._mission.value)

    def prepare(self) -> tuple[ScheduleTask, Callable[[JobEvent], None], str]:
        """The mission, for the concept that the search is asked for."""
        design, request = self._context.inputs().design(), self._request()
        concept = request.known_concept()
        plan = SchedulePlan(
            design,
            (concept,),
            self.legs(design),
            "induced" if request.objective == "induced" else "total",
            request.limits(design),
            STARTS,
        )
        progress = self._progress = ScheduleProgress(plan)
        return ScheduleTask(plan), partial(self._hear, progress), "Starting a worker …"

    def halt(self) -> None:
        if self.running:
            self.line = "Stopping …"
        super().halt()

    def refresh(self) -> None:
        """Bring everything that only shows into line."""
        title = self._request().known_concept().title
        self._concept.content = tag("div.rx.rx-dim.rx-small", f"Concept: {title}")
        self._read.content = tag("div.rx.rx-dim.rx-small", self._mission_line(), data_explorer="mission")
        kind = "running" if self.running else "idle" if self._progress is None else "done"
        self._state.content = tag("div.rx.rx-dim", self.line, data_explorer="schedule-state", data_kind=kind)
        progress = self._progress
        self._buttons.show(progress and (progress.part_done if self.running else 1.0), self.running)
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

    def _mission_line(self) -> str:
        """What the mission is read as; or why it is none."""
        try:
            legs = mission.mission_of(self._mission.value)
        except ValueError as error:
            return str(error)
        return f"{len(legs)} leg{'s' if len(legs) > 1 else ''}, {sum(hours for _, hours in legs):g} h"

    def _hear(self, progress: ScheduleProgress, news: JobEvent) -> None:
        match news:
            case JobQueued(ahead):
                self.line = "Waiting: next in line" if ahead == 0 else f"Waiting: {ahead} ahead"
            case JobStarted():
                self.line = progress.count
            case JobProgress(ScheduleOptimum() as cell):
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
        fixed = progress.at(None)
        if fixed is not None and fixed.best is not None:
            self._context.set_inputs(with_optimum(self._context.inputs(), fixed.design))
