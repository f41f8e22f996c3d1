"""What stands where on the page of one client, and what its buttons do to one another."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import viser

from explorer.charts.plots import PowerCurve
from explorer.hosting import viser_compat
from explorer.hosting.viser_compat import PageFacts, set_style
from explorer.interface import Failure, Frame, Reading, SessionCallbacks, SessionState, SharedServices, Tab, TabContext
from explorer.picture.camera_views import View
from explorer.pinned import Pinned
from explorer.scene.camera import FittedCamera
from explorer.scene.controller import SceneController
from explorer.scene.overlays import Strip, ghost_of
from explorer.sharing import share
from explorer.sharing.address import Address
from explorer.sharing.view_code import VIEW, view_from
from explorer.state import Inputs, ViewState
from explorer.tabs.actuator.panel import ActuatorPanel
from explorer.tabs.actuator.view import fit_cut
from explorer.tabs.controls import VIEW_BUTTONS, DesignControls
from explorer.tabs.export_panel import ExportPanel, ExportSources
from explorer.tabs.file_panel import FilePanel
from explorer.tabs.history.panel import HistoryPanel
from explorer.tabs.keys.commands import Actions, bind_commands
from explorer.tabs.keys.keyboard import Keyboard
from explorer.tabs.lecture.panel import LecturePanel
from explorer.tabs.lecture.presence import Presence, PresentationHooks
from explorer.tabs.optimise.map_panel import MapPanel
from explorer.tabs.optimise.optimise_panel import OptimisePanel
from explorer.tabs.optimise.schedule_panel import SchedulePanel
from explorer.tabs.optimise.sensitivity_panel import SensitivityPanel
from explorer.tabs.physics.waterfall_panel import WaterfallPanel
from explorer.tabs.probe.panel import ProbePanel
from explorer.tabs.results import ResultsPanel
from explorer.tabs.rotors.menu import RotorUpload
from explorer.tabs.studies.panel import StudiesPanel
from explorer.tabs.top_bar import TopBar
from explorer.text.status import status_panel, trust_page
from explorer.text.units import UNITS
from explorer.theme import style_sheet as style
from rotor.design.design import Design
from rotor.trim.solution import Solution

_CHART_WIDTH, _CONTROL_WIDTH = 340, 320
"""[px]; what they leave at 1280 is still a square."""
_WIDER = 1.25
"""Panels with big type, to those without."""
_BRAND = (28, 126, 214)


class Page:
    """Built once for a client. It is the session's `SessionPage`."""

    def __init__(
        self,
        client: viser.ClientHandle,
        start: Inputs,
        facts: PageFacts,
        shared: SharedServices,
        callbacks: SessionCallbacks,
    ) -> None:
        """`start`: where the page's address holds no design."""
        self._client, self._callbacks, self._dark = client, callbacks, facts.dark
        address = Address(facts.query, partial(viser_compat.set_query, client))
        problems: list[tuple[str, str]] = []
        inputs_from = partial(share.inputs_from, kept=facts.kept.get(share.DESIGN))
        start = address.read(share.DESIGN, inputs_from, start, "Not the design of the link", problems)
        view = address.read(VIEW, view_from, ViewState(), "Not the view of the link", problems)
        gui = client.gui
        self._theme()
        gui.set_panel_label("Rotor explorer")
        set_style(client, style.SHEET)  # Before the first widget.
        gui.main_panel.dock_right()
        self._presence = Presence(client, shared.presentations, address)
        self.top = TopBar(gui, callbacks.wake, lambda: self.history.undo(), lambda: self.history.redo())
        tabs = gui.add_tab_group()
        with tabs.add_tab("Design"):
            self.controls = DesignControls(
                gui, start, callbacks.wake, replace(view, dark=facts.dark), callbacks.azimuth_changed
            )
        rotor = start.aircraft.rotor_for(start.preset)
        self._radius = rotor.radius
        self.scene = SceneController(client, rotor, self.controls.display)
        self._keyboard = Keyboard(client)
        context = self.context = TabContext(
            inputs=self.controls.inputs,
            set_inputs=self.controls.set_inputs,
            view=self.controls.display.view,
            set_view=self.controls.display.set_view,
            set_azimuth=self.controls.display.turn,
            wake=callbacks.wake,
            download=self._download,
            notify=self._notify,
            state=callbacks.state,
            pin=self.top.pin_inputs,
            bind_command=self._keyboard.bind,
        )
        with tabs.add_tab("Optimise"):
            self.optimise = OptimisePanel(gui, shared.pool, context, lambda design: self.schedule.legs(design))
        with tabs.add_tab("Map"):
            self.map = MapPanel(gui, shared.pool, context, self.optimise)
        with tabs.add_tab("Schedule"):
            self.schedule = SchedulePanel(gui, shared.pool, context, self.optimise.request)
        with tabs.add_tab("Session"):
            self.history = HistoryPanel(gui, context, start)
            self.file = FilePanel(client, context, address, facts.kept)
            sources = ExportSources(lambda: self.camera, lambda: self.history.kept, self.scene.held_range)
            export = ExportPanel(client, context, sources)
        with tabs.add_tab("Lecture"):
            self.lecture = LecturePanel(client, context, self._presence, self._enlarge)
        panel = self._panel = gui.add_panel()
        with panel.add_tab("Results"):
            self.results = ResultsPanel(gui)
        with panel.add_tab("Twist"):
            sensitivity = SensitivityPanel(gui, Strip(client.scene), context)
        with panel.add_tab("Probe"):
            self.probe = ProbePanel(client, context)
        with panel.add_tab("Actuator"):
            self.actuator = ActuatorPanel(client, shared.pool, callbacks.wake, self._fly)
            self._actuator_inputs = self.actuator.inputs()
        with panel.add_tab("Physics"):
            self.waterfall = WaterfallPanel(gui)
        with panel.add_tab("Studies"):
            studies = StudiesPanel(client, context, shared.studies)
        with panel.add_tab("Trust"):
            gui.add_html(trust_page())
        panel.dock_left()
        self._enlarge(False)
        followers: tuple[Tab, ...] = (self.top, self.probe, sensitivity, self.waterfall, studies)
        self.tabs = (*followers, self.history, self.file, export, self.lecture, self._presence)
        """Everything that only follows."""
        self.camera = FittedCamera(client, rotor.radius)
        RotorUpload(self.controls.rotor.button, context)
        self._wire()
        for title, sentence in problems:
            self._notify(title, sentence)

    def start(self) -> None:
        """The session begins: widgets as they will be, also where the first solution takes long."""
        self.actuator.start()
        self._refresh(Reading(self.controls.inputs(), self.controls.display.view()))

    def stop(self) -> None:
        """The browser has left."""
        for tab in (self.optimise, self.map, self.schedule, self.actuator, *self.tabs):
            tab.stop()

    def read(self) -> tuple[Inputs, ViewState]:
        """What the widgets mean now."""
        return self.history.read(self.controls.pauses.longest()), self.controls.display.view()

    def driven(self, design: Design) -> Design:
        """The design with the actuator's twist; ValueError where it cannot drive this blade."""
        self._actuator_inputs = self.actuator.inputs()
        return self._actuator_inputs.apply(design)

    def preview(self, design: Design) -> Design | None:
        """The design of a search to show in place of the one on the sliders."""
        return self.optimise.preview(design)

    @property
    def pin(self) -> Pinned | None:
        """A of A/B."""
        return self.top.pinned

    def pin_or_swap(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what the A/B buttons asked for; whether that moves the sliders."""
        moved = self.top.settle(inputs, solution, self.context)
        self.controls.display.allow_difference(self.top.pinned is not None)
        return moved

    def solve_pinned(self, present: Design, hurried: bool) -> Solution | None:
        """A beside the present design; None when nothing is pinned."""
        return self.top.solve(present, hurried)

    def show_frame(self, frame: Frame) -> None:
        """Rotor, disk and camera; the cut blade of the actuator where it is looked at or driven."""
        reading, solution = frame.reading, frame.solution
        ghost = ghost_of(reading.sliders if reading.previewed else None, self.top.pinned)
        self._radius = solution.design.rotor.radius
        self.camera.resize(self._radius)
        self.scene.draw(solution, reading.view, ghost, frame.pinned)
        self.camera.ride(math.radians(reading.view.azimuth_deg))
        # Only at harmonics does the cut blade turn with the marked one.
        if self._actuator_in_frame and (not frame.only_azimuth or self._actuator_inputs.per_rev):
            self._show_actuator(reading, solution)

    def show_azimuth(self, state: SessionState) -> None:
        """Only the azimuth of the marked blade changed."""
        self.results.turn(state)
        self.probe.show(state)

    def show_results(self, reading: Reading, state: SessionState) -> None:
        """Numbers, charts, and the tabs that start long work."""
        self._refresh(reading)
        self.history.solved(reading.inputs, state.solution.power.total)
        self.results.show(state)

    def show_power(self, state: SessionState, curve: PowerCurve, failed: bool = False) -> None:
        """Power over advance ratio."""
        self.results.show_power(state, curve, failed)

    def follow(self, reading: Reading, state: SessionState) -> None:
        """All other tabs, and the address."""
        if not self._actuator_in_frame:
            self._show_actuator(reading, state.solution)
        for tab in self.tabs:
            tab.show(state)
        self.file.follow(state)

    def rest(self, state: SessionState, stop: Callable[[], bool]) -> None:
        """What can wait: the address once more, the waterfall, what the page keeps of an own rotor."""
        self.file.follow(state)
        self.waterfall.climb(stop)
        if not stop():
            self.file.keep()

    def show_failure(self, failure: Failure) -> None:
        """The last converged picture stays, grey, beneath the sentence."""
        reading, solution = failure.reading, failure.solution
        self._refresh(reading)
        self.actuator.show_failure(failure.message)
        self.results.problem(status_panel(None, failure.message) if solution is None else status_panel(solution))
        for tab in self.tabs:
            tab.show_failure()
        self.scene.fade(failure.good, reading.view, self.top.answer if reading.view.difference else None)

    def show_error(self, sentence: str) -> None:
        """An update failed with an exception."""
        self.results.problem(status_panel(None, sentence))

    @property
    def _actuator_in_frame(self) -> bool:
        return self._actuator_inputs.shown or self._actuator_inputs.driven

    def _show_actuator(self, reading: Reading, solution: Solution) -> None:
        design, azimuth = reading.sliders or solution.design, math.radians(reading.view.azimuth_deg)
        self.actuator.show(self._actuator_inputs, design, solution, azimuth)

    def _refresh(self, reading: Reading) -> None:
        """What follows the widgets themselves: visible sliders, units, dark page, and the tabs of long work."""
        self.controls.refresh(reading.inputs, UNITS[reading.view.units])
        if reading.view.dark != self._dark:
            self._dark = reading.view.dark
            self._theme()
        self.optimise.refresh(reading.sliders)
        self.map.refresh(reading.sliders)
        self.schedule.refresh()

    def _wire(self) -> None:
        """Buttons to what they do, once everything stands."""
        controls, context = self.controls, self.context
        self.actuator.shown.on_update(self._cut_switched)
        controls.reset_button.on_click(lambda _: self._reset())
        controls.view_buttons.on_click(lambda event: self._look(VIEW_BUTTONS[event.target.value]))
        controls.display.range_buttons.on_click(lambda event: self._colour(event.target.value))
        controls.check_button.on_click(lambda _: self._check())
        self.top.bind(context)
        self._presence.begin(context, PresentationHooks(lambda: self.lecture.step, self.lecture.follow, self._hold))
        bind_commands(context, Actions(self._look, self._colour, self._check, self._reset, self.optimise.toggle))
        self.file.begin()

    def _hold(self, held: bool) -> None:
        """Leave what moves the page to a presenter, or give it back."""
        for part in (self.controls, self.top, self.lecture, self._keyboard):
            part.hold(held)

    def _download(self, name: str, content: bytes) -> None:
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
        self.controls.set_inputs(replace(self.controls.inputs(), advance_ratio=advance_ratio))

    def _cut_switched(self, event: viser.GuiEvent[Any]) -> None:
        """One blade, cut open, in place of the rotor."""
        cut = bool(event.target.value)
        self.scene.set_seen(not cut)
        self.probe.set_seen(not cut)
        if cut:
            self.camera.aim_with(partial(fit_cut, self._radius))
        else:
            self.camera.aim("3d")

    def _look(self, view: View) -> None:
        self.actuator.leave_cut()
        self.camera.aim(view)

    def _check(self) -> None:
        self.results.check()
        self._callbacks.wake()

    def _colour(self, order: str) -> None:
        self.scene.order_range(order)
        self._callbacks.wake()

    def _reset(self) -> None:
        self.actuator.rest()
        self.controls.reset()
