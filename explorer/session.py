"""One browser's explorer: its widgets, scene, charts and worker, wired along the straight path."""

import logging
import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import viser

from explorer import plots, readout, solver, style, trust_readout
from explorer.actuator_panel import ActuatorPanel
from explorer.actuator_view import fit_cut
from explorer.camera import FittedCamera
from explorer.charts import Charts
from explorer.controls import Controls
from explorer.fields import FIELDS, fitted_range
from explorer.jobs import Pool
from explorer.map_panel import MapPanel
from explorer.optimise_panel import Hooks, OptimisePanel
from explorer.overlays import Ghost, Strip
from explorer.picture import disk_png, field_values, make_picture
from explorer.power_curve import PowerCurves
from explorer.scene import Scene
from explorer.schedule_panel import SchedulePanel
from explorer.sensitivity_panel import SensitivityPanel
from explorer.state import Inputs, ViewState, baseline_of
from explorer.worker import LatestWins
from rotor.design import Design
from rotor.presets import uh60a_rotor
from rotor.solution import Solution
from rotor.solve import solve
from rotor.twist import TwistLaw

_log = logging.getLogger(__name__)
_CHART_WIDTH, _CONTROL_WIDTH = 340, 320
"""[px]; what they leave at 1280 is still a square."""
_BRAND = (28, 126, 214)


class Session:
    """Lives from connect to disconnect. After construction everything happens on the worker's thread."""

    def __init__(self, client: viser.ClientHandle, start: Inputs, dark: bool, pool: Pool) -> None:
        self._client = client
        self._latest: Solution | None = None
        self._good: Solution | None = None
        """The last converged answer: what the picture shows."""
        self._drawn: tuple[Solution, ViewState, tuple[float, float], TwistLaw | None] | None = None
        self._ranges = {title: (field.low, field.high) for title, field in FIELDS.items()}
        self._range_order: str | None = None
        self._ghost_twist: TwistLaw | None = None
        """Of the blade a search began from, while its designs are shown."""
        self._baseline = solver.Baseline()
        self._checked: Solution | None = None
        """The last check with the vortex wake."""
        self._check_wanted = False
        self._curves = PowerCurves()
        self._dark = dark
        self._worker = LatestWins(self._round, self._report, f"session-{client.client_id}")

        rotor = self._rotor = uh60a_rotor(start.preset)
        gui = client.gui
        self._theme()
        gui.set_panel_label("Rotor explorer")
        gui.add_html(style.SHEET)
        self._scene = Scene(client.scene, rotor)
        self._ghost = Ghost(client.scene, rotor)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Design"):
            self._controls = Controls(gui, start, self._worker.wake, dark)
        with tabs.add_tab("Optimise"):
            hooks = Hooks(
                self._controls.inputs,
                self._controls.set_inputs,
                self._worker.wake,
                lambda design: self._schedule.legs(design),
            )
            self._optimise = OptimisePanel(gui, pool, hooks)
        with tabs.add_tab("Map"):
            self._map = MapPanel(gui, pool, hooks, self._optimise.wishes, self._optimise.optimum_of)
        with tabs.add_tab("Schedule"):
            self._schedule = SchedulePanel(gui, pool, hooks, self._optimise.wishes, self._send)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(_CONTROL_WIDTH)
        panel = gui.add_panel()
        with panel.add_tab("Results"):
            self._status = gui.add_html(readout.status_panel(None))
            self._power = gui.add_html("")
            self._trim = gui.add_html("")
            self._check = gui.add_html("")
            self._charts = Charts(gui, *plots.blank())
        with panel.add_tab("Where to twist"):
            self._sensitivity = SensitivityPanel(gui, Strip(client.scene), self._worker.wake)
        with panel.add_tab("Actuator"):
            self._actuator = ActuatorPanel(client, self._worker.wake, self._fly)
        with panel.add_tab("Trust"):
            gui.add_html(trust_readout.trust_page())
        panel.dock_left()
        panel.set_width(_CHART_WIDTH)
        self._camera = FittedCamera(client, rotor.radius)
        self._actuator.shown.on_update(self._cut_switched)
        self._controls.reset_button.on_click(lambda _: self._actuator.rest())
        self._controls.view_buttons.on_click(self._view_clicked)
        self._controls.range_buttons.on_click(self._range_clicked)
        self._controls.check_button.on_click(self._check_clicked)

    def start(self) -> None:
        self._actuator.start()
        self._worker.start()
        self._worker.wake()

    def stop(self) -> None:
        self._optimise.close()
        self._map.close()
        self._schedule.close()
        self._actuator.stop()
        self._worker.stop()

    def _round(self, superseded: Callable[[], bool]) -> None:
        """Widgets → Design → Solution → pictures; the frame first, then what it is compared with."""
        inputs, view = self._controls.inputs(), self._controls.view()
        self._controls.refresh(inputs)
        if view.dark != self._dark:
            self._dark = view.dark
            self._theme()
        try:
            plain = inputs.design()
            actuator = self._actuator.inputs()
            design = actuator.apply(plain)
        except ValueError as error:
            self._follow(None)
            self._latest = None
            self._actuator.lose(str(error))
            self._lose(view, readout.status_panel(None, str(error)))
            return
        # What a search shows is a blade at rest: a driven actuator goes first.
        preview = self._optimise.preview(plain) if design == plain else None
        self._follow(plain)
        self._ghost_twist = None if preview is None else plain.twist
        design = preview or design
        if self._latest is None or self._latest.design != design:
            self._latest = solve(design, self._good)
        if not self._latest.converged:
            self._actuator.lose(self._latest.message)
            self._lose(view, readout.status_panel(self._latest))
            return
        self._good = self._latest
        self._draw(self._good, view)
        self._actuator.show(actuator, plain, self._good, math.radians(view.azimuth_deg))
        self._tell(self._good, self._baseline.solve(baseline_of(design)), view)
        self._compare(self._good)
        if not superseded():
            self._sensitivity.show(self._good, view.exaggeration)
        if self._curves.sweep(design, superseded):
            self._plot_power(self._good)

    def _follow(self, design: Design | None) -> None:
        """Bring the tabs that start long work into line with the design on the sliders."""
        self._optimise.refresh(design)
        self._map.refresh(design)
        self._schedule.refresh()

    def _draw(self, solution: Solution, view: ViewState) -> None:
        colour_range = self._range(solution, view)
        wanted = (view, colour_range, self._ghost_twist)
        if self._drawn is not None and self._drawn[0] is solution and self._drawn[1:] == wanted:
            return
        picture = make_picture(solution, view, colour_range)
        with self._client.atomic():
            self._scene.show(picture)
            self._ghost.show(uh60a_rotor(solution.design.preset), self._ghost_twist, view.exaggeration)
        self._client.flush()  # The frame goes out now; read-outs and charts follow while it is drawn.
        self._controls.show_range(view.field, colour_range, faded=False)
        self._drawn = (solution, *wanted)

    def _tell(self, solution: Solution, baseline: Solution, view: ViewState) -> None:
        self._status.content = readout.status_panel(solution)
        self._power.content = readout.power_panel(solution, baseline)
        self._trim.content = readout.trim_panel(solution)
        charts = self._charts
        charts.twist.show(plots.twist_plot(solution.design, baseline.design, charts.twist.y_range))
        charts.alpha.show(plots.alpha_plot(solution, view.azimuth_deg))
        charts.lift.show(plots.lift_plot(solution, view.azimuth_deg))
        self._plot_power(solution)

    def _compare(self, solution: Solution) -> None:
        """The vortex wake beside the answer, once asked for; an older check is taken away."""
        if self._checked is not None and self._checked.design != solver.with_vortex_wake(solution.design):
            self._checked = None
            self._check.content = ""
        if self._check_wanted:
            self._check_wanted = False
            self._check.content = readout.check_panel(None, solution)
            self._checked = solve(solver.with_vortex_wake(solution.design), solution)
            self._check.content = readout.check_panel(self._checked, solution)

    def _plot_power(self, solution: Solution, lost: bool = False) -> None:
        design, chart = solution.design, self._charts.power
        now = None if lost else solution.power.total / 1e3
        curve = self._curves.known(design)
        if not np.isfinite(curve.design).any():
            return  # The first sweep is on its way.
        chart.show(plots.power_plot(curve, design.condition.advance_ratio, now, chart.y_range))

    def _lose(self, view: ViewState, status: str) -> None:
        """Keep the last good answer, but grey, with the sentence in red."""
        self._status.content = status
        self._drawn = None
        self._sensitivity.lose()
        if self._good is None:
            return
        colour_range = self._range(self._good, view)
        png = disk_png(self._good, FIELDS[view.field], colour_range, faded=True)
        with self._client.atomic():
            self._scene.fade(png)
        self._controls.show_range(view.field, colour_range, faded=True)
        self._power.content = readout.faded(readout.power_panel(self._good, None))
        self._trim.content = readout.faded(readout.trim_panel(self._good))
        self._plot_power(self._good, lost=True)

    def _range(self, solution: Solution, view: ViewState) -> tuple[float, float]:
        """The colour range: held, unless a button asked for another."""
        order, self._range_order = self._range_order, None
        field = FIELDS[view.field]
        if order == "Rescale":
            self._ranges[view.field] = fitted_range(field, field_values(solution, field))
        elif order == "Default":
            self._ranges[view.field] = (field.low, field.high)
        return self._ranges[view.field]

    def _report(self, error: Exception) -> None:
        _log.error("an update failed", exc_info=error)
        self._status.content = readout.status_panel(None, f"This update failed ({error}): move any slider to go on.")

    def _send(self, name: str, content: bytes) -> None:
        self._client.send_file_download(name, content, save_immediately=True)

    def _theme(self) -> None:
        self._client.gui.configure_theme(
            dark_mode=self._dark, show_logo=False, show_share_button=False, brand_color=_BRAND
        )

    def _fly(self, advance_ratio: float) -> None:
        self._controls.set_inputs(replace(self._controls.inputs(), advance_ratio=advance_ratio))

    def _cut_switched(self, event: viser.GuiEvent[Any]) -> None:
        """One blade, cut open, in place of the rotor."""
        cut = bool(event.target.value)
        self._scene.set_seen(not cut)
        if cut:
            self._camera.aim_with(partial(fit_cut, self._rotor.radius))
        else:
            self._camera.aim("3d")

    def _view_clicked(self, event: viser.GuiEvent[Any]) -> None:
        self._actuator.leave_cut()
        self._camera.aim("3d" if event.target.value == "3D" else "top")

    def _check_clicked(self, event: viser.GuiEvent[Any]) -> None:
        del event
        self._check_wanted = True
        self._worker.wake()

    def _range_clicked(self, event: viser.GuiEvent[Any]) -> None:
        self._range_order = event.target.value
        self._worker.wake()
