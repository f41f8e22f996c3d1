"""The Results tab: how the solve ended, power by parts, trim, the check with the vortex wake, and four charts."""

import numpy as np
import viser

from explorer.charts import plots
from explorer.charts.plots import PowerCurve
from explorer.interface import SessionState
from explorer.tabs.chart_panel import AB_KEY, ALPHA_KEY, IDEAL_KEY, LIFT_KEY, POWER_KEY, STALL_KEY, TWIST_KEY, Charts
from explorer.text import comparison as ab_readout
from explorer.text import readout
from explorer.text.status import status_panel
from explorer.text.units import UNITS, Units
from explorer.workers.solver import with_vortex_wake
from rotor.design.aircraft import Aircraft
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_POWER, _TRIM = 158, 90
"""Heights of the two read-outs [px]."""


class ResultsPanel:
    """One session's."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._status = gui.add_html(status_panel(None))
        self._power = gui.add_html(readout.reserved(_POWER))
        self._trim = gui.add_html(readout.reserved(_TRIM))
        self._check = gui.add_html("")
        self._charts = Charts(gui, *plots.blank())
        self._state: SessionState | None = None
        """The last good one."""
        self._charted: Aircraft | None = None
        """Whose power the chart shows."""
        self._checked: Solution | None = None
        """The last check with the vortex wake."""
        self._check_wanted = False

    def show(self, state: SessionState) -> None:
        """Follow a converged answer."""
        self._state = state
        solution, pinned = state.solution, state.pinned
        ab = pinned is not None
        self._status.content = status_panel(solution, pinned=pinned)
        self._power.content, self._trim.content = _numbers(state)
        charts = self._charts
        twist = plots.twist_plot(solution.design, state.reference.design, charts.twist.y_range, ab)
        charts.twist.show(twist, AB_KEY if ab else TWIST_KEY)
        self.turn(state)
        charts.apart.set_visible(ab)
        self._compare(solution, UNITS[state.view.units])

    def turn(self, state: SessionState) -> None:
        """The marked blade is elsewhere: what is drawn along it follows."""
        solution, pinned, azimuth, charts = state.solution, state.pinned, state.view.azimuth_deg, self._charts
        ab = pinned is not None
        charts.alpha.show(plots.alpha_plot(solution, azimuth, pinned), (*AB_KEY, *STALL_KEY) if ab else ALPHA_KEY)
        charts.lift.show(plots.lift_plot(solution, azimuth, pinned), AB_KEY if ab else LIFT_KEY)

    def show_power(self, state: SessionState, curve: PowerCurve, lost: bool = False) -> None:
        """Power over µ, once the first sweep has arrived; without the present point where there is none.

        A curve of another rotor does not wait for that: it is taken away.
        """
        solution, pinned, charts = state.solution, state.pinned, self._charts
        stale = self._charted not in (None, solution.design.aircraft)
        if not np.isfinite(curve.design).any() and not stale:
            return
        self._charted = solution.design.aircraft
        mu, ab = solution.design.condition.advance_ratio, pinned is not None
        unit = UNITS[state.view.units].power[0]
        curve = curve.in_unit(unit)
        now = None if lost else unit.of(solution.power.total)
        power = plots.power_plot(curve, mu, now, charts.power.y_range, ab)
        key = (*AB_KEY, *IDEAL_KEY) if ab else POWER_KEY
        if not np.isfinite(curve.ideal).any():
            key = tuple(line for line in key if line not in IDEAL_KEY)
        charts.power.show(power, key, f"Power [{unit.symbol}] over µ")
        if pinned is not None:
            apart = None
            if not lost and pinned.converged and pinned.design.condition == solution.design.condition:
                apart = unit.of(solution.power.total - pinned.power.total)
            plot = plots.apart_plot(curve, mu, apart, charts.apart.y_range)
            charts.apart.show(plot, title=f"B − A [{unit.symbol}] over µ")

    def problem(self, status: str) -> None:
        """Keep the last good answer, but grey, with the sentence in red."""
        self._status.content = status
        if self._state is not None:
            self._power.content, self._trim.content = map(readout.faded, _numbers(self._state))

    def check(self) -> None:
        """Compute the vortex wake beside the answer in the next round."""
        self._check_wanted = True

    def _compare(self, solution: Solution, units: Units) -> None:
        """The vortex wake beside the answer, once asked for; an older check is taken away."""
        if self._checked is not None and self._checked.design != with_vortex_wake(solution.design):
            self._checked = None
            self._check.content = ""
        if self._check_wanted:
            self._check_wanted = False
            self._check.content = readout.check_panel(None, solution, units)
            self._checked = solve(with_vortex_wake(solution.design), solution)
        if self._checked is not None:
            self._check.content = readout.check_panel(self._checked, solution, units)


def _numbers(state: SessionState) -> tuple[str, str]:
    """Power and trim: of this design, or of A and B."""
    solution, pinned, units = state.solution, state.pinned, UNITS[state.view.units]
    if pinned is None:
        return readout.power_panel(solution, state.baseline, units), readout.trim_panel(solution)
    return ab_readout.power_panel(solution, pinned, units), ab_readout.trim_panel(solution, pinned)
