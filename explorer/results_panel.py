"""The Results tab: how the solve ended, power by parts, trim, the check with the vortex wake, and four charts."""

import numpy as np
import viser

from explorer import plots, readout
from explorer.charts import Charts
from explorer.desk import Moment
from explorer.plots import PowerCurve
from explorer.solver import with_vortex_wake
from rotor.solution import Solution
from rotor.solve import solve


class ResultsPanel:
    """One session's."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._status = gui.add_html(readout.status_panel(None))
        self._power = gui.add_html("")
        self._trim = gui.add_html("")
        self._check = gui.add_html("")
        self._charts = Charts(gui, *plots.blank())
        self._checked: Solution | None = None
        """The last check with the vortex wake."""
        self._check_wanted = False

    def show(self, moment: Moment) -> None:
        """Follow a converged answer."""
        solution, azimuth = moment.solution, moment.view.azimuth_deg
        self._status.content = readout.status_panel(solution)
        self._power.content = readout.power_panel(solution, moment.baseline)
        self._trim.content = readout.trim_panel(solution)
        charts = self._charts
        charts.twist.show(plots.twist_plot(solution.design, moment.baseline.design, charts.twist.y_range))
        charts.alpha.show(plots.alpha_plot(solution, azimuth))
        charts.lift.show(plots.lift_plot(solution, azimuth))
        self._compare(solution)

    def show_power(self, solution: Solution, curve: PowerCurve, lost: bool = False) -> None:
        """Power over µ, once the first sweep has arrived; without the present point where there is none."""
        if not np.isfinite(curve.design).any():
            return
        chart, now = self._charts.power, None if lost else solution.power.total / 1e3
        chart.show(plots.power_plot(curve, solution.design.condition.advance_ratio, now, chart.y_range))

    def problem(self, status: str, good: Solution | None) -> None:
        """Keep the last good answer, but grey, with the sentence in red."""
        self._status.content = status
        if good is not None:
            self._power.content = readout.faded(readout.power_panel(good, None))
            self._trim.content = readout.faded(readout.trim_panel(good))

    def check(self) -> None:
        """Compute the vortex wake beside the answer in the next round."""
        self._check_wanted = True

    def _compare(self, solution: Solution) -> None:
        """The vortex wake beside the answer, once asked for; an older check is taken away."""
        if self._checked is not None and self._checked.design != with_vortex_wake(solution.design):
            self._checked = None
            self._check.content = ""
        if self._check_wanted:
            self._check_wanted = False
            self._check.content = readout.check_panel(None, solution)
            self._checked = solve(with_vortex_wake(solution.design), solution)
            self._check.content = readout.check_panel(self._checked, solution)
