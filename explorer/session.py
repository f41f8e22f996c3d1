"""One browser's explorer: its widgets, scene, charts and worker, wired along the straight path."""

import logging
import math
import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import viser

from explorer import readout, share, solver, style, trust_readout, viser_compat
from explorer.actuator_panel import ActuatorPanel
from explorer.actuator_view import fit_cut
from explorer.address import Address
from explorer.camera import FittedCamera
from explorer.commands import Actions, bind_commands
from explorer.controls import VIEW_BUTTONS, Controls
from explorer.desk import Desk, Moment, Tab
from explorer.export_panel import ExportPanel, Sources
from explorer.file_panel import FilePanel
from explorer.frame import Frame
from explorer.history_panel import HistoryPanel
from explorer.jobs import Share
from explorer.keyboard import Keyboard
from explorer.lecture_panel import LecturePanel
from explorer.map_panel import MapPanel
from explorer.optimise_panel import OptimisePanel
from explorer.overlays import Strip, ghost_of
from explorer.power_curve import PowerCurves
from explorer.presence import Hands, Presence
from explorer.presentation import Stage
from explorer.probe_panel import ProbePanel
from explorer.results_panel import ResultsPanel
from explorer.rotor_upload import RotorUpload
from explorer.schedule_panel import SchedulePanel
from explorer.sensitivity_panel import SensitivityPanel
from explorer.sliders import LIMITS
from explorer.state import Inputs, ViewState, baseline_of, with_optimum
from explorer.studies_panel import StudiesPanel
from explorer.top_bar import TopBar
from explorer.view import View
from explorer.viser_compat import PageFacts, set_style
from explorer.waterfall_panel import WaterfallPanel
from explorer.worker import LatestWins, Sleep
from rotor.design import Design
from rotor.solution import Solution
from rotor.solve import solve

_log = logging.getLogger(__name__)
_CHART_WIDTH, _CONTROL_WIDTH = 340, 320
"""[px]; what they leave at 1280 is still a square."""
_WIDER = 1.25
_BRAND = (28, 126, 214)


class Session:
    """Lives from connect to disconnect. After construction everything happens on the worker's thread."""

    def __init__(
        self,
        client: viser.ClientHandle,
        start: Inputs,
        facts: PageFacts,
        pool: Share,
        stage: Stage,
        sleep: Sleep | None = None,
        studies: Path = Path(),
    ) -> None:
        """`start`: where the page's address holds no design; `sleep`: what the house does about rest.

        `studies`: the folder whose results the Studies tab offers.
        """
        self._client, self._pool = client, pool
        address = Address(facts.query, partial(viser_compat.set_query, client))
        problem = ""
        try:
            code = address[share.DESIGN]
            start = start if code is None else share.inputs_from(code, LIMITS)
        except ValueError as error:
            problem = str(error)
        self._latest: Solution | None = None
        self._good: Solution | None = None
        """The last converged answer: what the picture shows."""
        self._moment: Moment | None = None
        self._shown = threading.Event()
        """Set once the page has its first answer, or the sentence why there is none."""
        self._whole_round = True
        """Whether more may have changed since the last round than where the marked blade is."""
        self._baseline = solver.Baseline()
        self._curves = PowerCurves()
        self._dark = dark = facts.dark
        self._worker = LatestWins(self._round, self._report, f"session-{client.client_id}", self._resting(sleep))

        rotor = self._rotor = start.aircraft.rotor_for(start.preset)
        gui = client.gui
        self._theme()
        gui.set_panel_label("Rotor explorer")
        set_style(client, style.SHEET)  # Before the first widget.
        self._presence = Presence(client, stage, address)
        self._top = TopBar(gui, self._wake, lambda: self._history.undo(), lambda: self._history.redo())
        tabs = gui.add_tab_group()
        with tabs.add_tab("Design"):
            self._controls = Controls(gui, start, self._wake, dark, self._worker.wake)
        self._frame = Frame(client, rotor, self._controls)
        desk = self._desk = Desk(
            inputs=self._controls.inputs,
            set_inputs=self._controls.set_inputs,
            view=self._controls.view,
            set_view=self._controls.set_view,
            turn=self._controls.turn,
            wake=self._wake,
            send=self._send,
            tell=self._notify,
            moment=lambda: self._moment,
            pin=self._top.pin_inputs,
            bind=Keyboard(client).bind,
        )
        with tabs.add_tab("Optimise"):
            self._optimise = OptimisePanel(gui, pool, desk, lambda design: self._schedule.legs(design))
        with tabs.add_tab("Map"):
            self._map = MapPanel(gui, pool, desk, self._optimise)
        with tabs.add_tab("Schedule"):
            self._schedule = SchedulePanel(gui, pool, desk, self._optimise.wishes)
        with tabs.add_tab("Session"):
            self._history = HistoryPanel(gui, desk, start)
            self._file = FilePanel(client, desk, LIMITS, address)
            sources = Sources(lambda: self._camera, lambda: self._history.kept, self._frame.held_range)
            export = ExportPanel(client, desk, sources)
        with tabs.add_tab("Lecture"):
            self._lecture = LecturePanel(client, desk, self._presence, self._enlarge)
        gui.main_panel.dock_right()
        panel = gui.add_panel()
        with panel.add_tab("Results"):
            self._results = ResultsPanel(gui)
        with panel.add_tab("Twist"):
            sensitivity = SensitivityPanel(gui, Strip(client.scene), desk)
        with panel.add_tab("Probe"):
            self._probe = ProbePanel(client, desk)
        with panel.add_tab("Actuator"):
            self._actuator = ActuatorPanel(client, pool, self._wake, self._fly)
        with panel.add_tab("Physics"):
            self._waterfall = WaterfallPanel(gui, desk)
        with panel.add_tab("Studies"):
            self._studies = StudiesPanel(client, desk, LIMITS, studies)
        with panel.add_tab("Trust"):
            gui.add_html(trust_readout.trust_page())
        panel.dock_left()
        self._panel = panel
        self._enlarge(False)
        followers: tuple[Tab, ...] = (self._top, self._probe, sensitivity, self._waterfall)
        self._tabs = (*followers, self._studies, self._history, self._file, export, self._lecture, self._presence)
        """Everything that only follows."""
        self._camera = FittedCamera(client, rotor.radius)
        RotorUpload(self._controls.upload, desk)
        self._actuator.shown.on_update(self._cut_switched)
        controls = self._controls
        controls.reset_button.on_click(lambda _: self._reset())
        controls.view_buttons.on_click(lambda event: self._look(VIEW_BUTTONS[event.target.value]))
        controls.range_buttons.on_click(lambda event: self._colour(event.target.value))
        controls.check_button.on_click(lambda _: self._check())
        self._top.bind(desk)
        self._presence.begin(desk, Hands(lambda: self._lecture.step, self._lecture.follow, self._controls.hold))
        bind_commands(desk, Actions(self._look, self._colour, self._check, self._reset, self._optimise.toggle))
        self._file.begin()
        if problem:
            self._notify("Not the design of the link", problem)

    def start(self) -> None:
        self._actuator.start()
        self._worker.start()
        self._wake()

    def stop(self) -> None:
        self._whole_round = True
        for tab in (self._optimise, self._map, self._schedule, self._actuator, *self._tabs):
            tab.stop()
        self._pool.leave()
        self._worker.stop()

    def _wake(self) -> None:
        """Something changed."""
        self._whole_round = True
        self._worker.wake()

    def until_shown(self, patience: float) -> None:
        """Wait for the first answer to be on its way, at most so long [s]."""
        self._shown.wait(patience)

    def _round(self, superseded: Callable[[], bool]) -> None:
        """Widgets → Design → Solution → pictures; the frame first, then what it is compared with."""
        whole, self._whole_round = self._whole_round, False

        def overtaken() -> bool:
            """Whether something waits that makes the rest of this round needless: not a blade that only turned."""
            return self._whole_round and self._worker.superseded

        def pause() -> bool:
            """The same between two steps of what can wait, where the frames of other pages go first."""
            return superseded() and self._whole_round

        inputs, view = self._history.read(self._controls.pauses.longest()), self._controls.view()
        self._controls.refresh(inputs, view)
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
            if self._settle(inputs, None):
                return
            self._actuator.lose(str(error))
            self._lose(view, readout.status_panel(None, str(error)))
            return
        # What a search shows is a blade at rest: a driven actuator goes first.
        preview = self._optimise.preview(plain) if design == plain else None
        if whole:
            self._follow(plain)
        design = preview or design
        if self._latest is None or self._latest.design != design:
            self._latest = solve(design, self._good)
        solution = self._latest
        if self._settle(inputs if preview is None else with_optimum(inputs, preview), solution):
            return
        if not solution.converged:
            self._actuator.lose(solution.message)
            self._lose(view, readout.status_panel(solution))
            return
        self._good = solution
        self._history.solved(inputs, solution.power.total)
        top = self._top
        # A before the frame only where the frame shows it: nothing else may hold the frame up.
        on_disk = top.solve(design, overtaken()) if view.difference else None
        self._rotor = solution.design.rotor
        self._camera.resize(self._rotor.radius)
        self._frame.draw(solution, view, ghost_of(None if preview is None else plain, top.pinned), on_disk)
        self._camera.ride(math.radians(view.azimuth_deg))
        if whole or actuator.per_rev:  # Only at harmonics does its picture turn with the blade.
            self._actuator.show(actuator, plain, solution, math.radians(view.azimuth_deg))
        baseline = self._baseline.solve(baseline_of(design))
        moment = Moment(inputs, view, solution, baseline, top.solve(design, overtaken()), top.pinned)
        before, self._moment = self._moment, moment
        if not whole and moment.only_turned(before):
            self._results.turn(moment)
            self._probe.show(moment)
            return
        reference = moment.reference.design

        def show_power() -> None:
            self._results.show_power(moment, self._curves.known(design, reference))

        self._results.show(moment)
        show_power()
        if not overtaken():
            for tab in self._tabs:
                tab.show(moment)
            self._file.follow(moment)
        self._shown.set()
        if self._curves.sweep(design, reference, pause, show_power):
            self._file.follow(moment)
            self._waterfall.climb(pause)

    def _settle(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what the buttons of A/B asked; whether that moves the sliders, so that another round follows."""
        moved = self._top.settle(inputs, solution, self._desk)
        self._controls.allow_difference(self._top.pinned is not None)
        return moved

    def _follow(self, design: Design | None) -> None:
        """Bring the tabs that start long work into line with the design on the sliders."""
        self._optimise.refresh(design)
        self._map.refresh(design)
        self._schedule.refresh()

    def _lose(self, view: ViewState, status: str) -> None:
        """The inputs have no answer: the last good one stays, grey, beneath the sentence."""
        self._results.problem(status)
        self._shown.set()
        for tab in self._tabs:
            tab.lose()
        self._frame.fade(self._good, view, self._top.answer if view.difference else None)
        if (last := self._moment) is not None:
            curve = self._curves.known(last.solution.design, last.reference.design)
            self._results.show_power(last, curve, lost=True)

    def _resting(self, sleep: Sleep | None) -> Sleep | None:
        """What is only kept to be quick goes when the page falls asleep; the first touch computes it anew."""

        def falls() -> None:
            self._latest, self._baseline, self._curves = None, solver.Baseline(), PowerCurves()
            if sleep is not None:
                sleep.falls()

        return sleep and replace(sleep, falls=falls)

    def _report(self, error: Exception) -> None:
        self._shown.set()
        _log.error("an update failed", exc_info=error)
        sentence = f"This update failed ({error}): move any slider to go on."
        self._results.problem(readout.status_panel(None, sentence))

    def _send(self, name: str, content: bytes) -> None:
        self._client.send_file_download(name, content, save_immediately=True)

    def _notify(self, title: str, sentence: str) -> None:
        self._client.add_notification(title, sentence, auto_close_seconds=6)

    def _enlarge(self, big: bool) -> None:
        """Big type in wider panels, or panels as wide as the rotor beside them can spare."""
        set_style(self._client, style.SHEET + (style.BIG if big else ""))
        factor = _WIDER if big else 1.0
        self._panel.set_width(factor * _CHART_WIDTH)
        self._client.gui.main_panel.set_width(factor * _CONTROL_WIDTH)

    def _theme(self) -> None:
        self._client.gui.configure_theme(
            dark_mode=self._dark, show_logo=False, show_share_button=False, brand_color=_BRAND
        )

    def _fly(self, advance_ratio: float) -> None:
        self._controls.set_inputs(replace(self._controls.inputs(), advance_ratio=advance_ratio))

    def _cut_switched(self, event: viser.GuiEvent[Any]) -> None:
        """One blade, cut open, in place of the rotor."""
        cut = bool(event.target.value)
        self._frame.set_seen(not cut)
        self._probe.set_seen(not cut)
        if cut:
            self._camera.aim_with(partial(fit_cut, self._rotor.radius))
        else:
            self._camera.aim("3d")

    def _look(self, view: View) -> None:
        self._actuator.leave_cut()
        self._camera.aim(view)

    def _check(self) -> None:
        self._results.check()
        self._wake()

    def _colour(self, order: str) -> None:
        self._frame.order_range(order)
        self._wake()

    def _reset(self) -> None:
        self._actuator.rest()
        self._controls.reset()
