"""The Schedule section: best twist per speed, best fixed blade, the gain of moving; mission mix; CSV."""

from functools import partial
from typing import Any

import viser

from explorer.charts import schedule_view
from explorer.charts.schedule_view import ScheduleProgress
from explorer.model.inputs import with_optimum
from explorer.text.glossary import hint
from explorer.views.mission import TEXT as MISSION_TEXT
from explorer.widgets.context import TabContext
from explorer.widgets.elements import PanelChart, WorkButtons
from explorer.widgets.optimise.optimise_panel import OptimisePanel
from explorer.workers.solver import ScheduleTask
from rotor import Design
from rotor.optimisation import SchedulePlan
from rotor.optimisation.search import STARTS
from rotor.support.markup import tag

TIME_LIMIT = 180.0
"""[s] a schedule may take."""
_URGENCY = 1
"""After searches."""
NAME = "schedule"
_BEFORE = "Best twist for each leg, and the best fixed blade for all."


class SchedulePanel:
    def __init__(self, context: TabContext, search: OptimisePanel) -> None:
        """Concept, limits, starts and mission are those of the search."""
        self._context, self._work, self._request, gui = (
            context,
            context.work,
            search.request,
            context.gui,
        )
        self._search = search
        self._refused = ""
        """Why what was asked for last is no schedule."""
        self._drawn: object = None
        self._concept = gui.add_html("")
        mission = gui.add_html("")
        self.texts = {MISSION_TEXT: partial(setattr, mission, "content")}
        entries, halt = ("schedule", "schedule_stop"), partial(context.work.halt, NAME)
        self._buttons = WorkButtons(
            gui, "Compute schedule", "Stop schedule", entries, self.begin, halt
        )
        self._state = gui.add_html("")
        self._table = gui.add_html("")
        words = hint("schedule_result")
        self._results = gui.add_button_group(
            "Result", ("Apply fixed", "Save CSV"), visible=False, hint=words
        )
        self._twists, self._savings = PanelChart(gui), PanelChart(gui)
        self._results.on_click(self._result_clicked)

    def begin(self) -> None:
        """The mission, for the concept that the search is asked for."""
        request = self._request()
        try:
            design = self._context.inputs().design()
            concepts = (request.known_concept(),)
            legs = self._search.mission(design).conditions
            quantity = "induced" if request.objective == "induced" else "total"
            plan = SchedulePlan(design, concepts, legs, quantity, request.limits(design), STARTS)
            self._refused = ""
        except ValueError as error:
            self._refused = str(error)
            self._context.wake()
        else:
            self._work.begin(NAME, ScheduleTask(plan), TIME_LIMIT, _URGENCY)

    def refresh(self, _: Design | None) -> None:
        """Bring everything that only shows into line."""
        title = self._request().known_concept().title
        self._concept.content = tag("div.rx.rx-dim.rx-small", f"Concept: {title}")
        record, units = self._work[NAME], self._context.units
        under_way = record is not None and record.under_way
        kind = "running" if under_way else "idle" if record is None else "done"
        progress = None if record is None else ScheduleProgress.of(record)
        line = self._refused or _BEFORE
        if record is not None and progress is not None and not self._refused:
            line = record.sentence or record.words(progress.count, f"{progress.count} kept")
        self._state.content = tag(
            "div.rx.rx-dim", line, data_explorer="schedule-state", data_kind=kind
        )
        self._buttons.show(progress and (progress.part_done if under_way else 1.0), under_way)
        if progress is None:
            return
        self._results.visible = not under_way and progress.at(None) is not None
        seen = progress, units
        if seen != self._drawn:
            self._drawn = seen
            self._table.content = schedule_view.table(progress, units)
            self._twists.show(schedule_view.twist_chart(progress, self._twists.y_range))
            self._savings.show(schedule_view.saving_chart(progress, self._savings.y_range))

    def _result_clicked(self, event: viser.GuiEvent[Any]) -> None:
        record = self._work[NAME]
        if record is None:
            return
        progress = ScheduleProgress.of(record)
        if event.target.value == "Save CSV":
            self._context.download("twist-schedule.csv", schedule_view.csv_of(progress))
            return
        fixed = progress.at(None)
        if fixed is not None and fixed.best is not None:
            self._context.set_inputs(with_optimum(self._context.inputs(), fixed.design))
