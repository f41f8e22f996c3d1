"""The page of one client: the arrangement of its panels, and the actions of its buttons on each other.

Building and wiring are one file, because every button acts on panels that are made here.
The panels themselves are in `explorer/tabs`, the scene in `explorer/scene`.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import viser

from explorer.charts.plots import PowerCurve
from explorer.hosting.browser import PageFacts, set_query
from explorer.interface import Failure, Frame, Reading, SessionCallbacks, SessionState, SharedServices, Tab, TabContext
from explorer.overlay.bridge import Bridge
from explorer.picture.camera_views import View
from explorer.pinned import Pinned
from explorer.scene.camera import FittedCamera
from explorer.scene.controller import SceneController
from explorer.scene.grab import BladeGrab
from explorer.scene.overlays import Strip, ghost_of
from explorer.sharing import share, stored_history
from explorer.sharing.address import Address
from explorer.sharing.presentation import PRESENT
from explorer.sharing.view_code import VIEW, view_from
from explorer.stand import condition_of
from explorer.state import Inputs, ViewState, with_optimum
from explorer.tabs.actuator.cut import fit_cut
from explorer.tabs.actuator.panel import ActuatorPanel
from explorer.tabs.controls import DesignControls, PerRevControls
from explorer.tabs.display import Display
from explorer.tabs.export_panel import ExportPanel, ExportSources
from explorer.tabs.file_panel import FilePanel
from explorer.tabs.history.panel import HistoryPanel
from explorer.tabs.keys import Actions, Keyboard, bind_commands
from explorer.tabs.layout import MODES, Layout, Sections
from explorer.tabs.lecture.panel import LecturePanel
from explorer.tabs.lecture.presence import Presence, PresentationHooks
from explorer.tabs.optimise.map_panel import MapPanel
from explorer.tabs.optimise.optimise_panel import OptimisePanel
from explorer.tabs.optimise.schedule_panel import SchedulePanel
from explorer.tabs.optimise.sensitivity import SensitivityPanel
from explorer.tabs.power_card import beside_labels
from explorer.tabs.probe.panel import ProbePanel
from explorer.tabs.results import ResultsPanel
from explorer.tabs.rotors import RotorUpload
from explorer.tabs.settings_panel import SettingsPanel
from explorer.tabs.studies.panel import StudiesPanel
from explorer.tabs.top_bar import TopBar
from explorer.tabs.waterfall import WaterfallPanel
from explorer.text.units import UNITS
from rotor.design.design import Design
from rotor.trim.solution import Solution
from rotor.user_input import brief

_BRAND = (37, 99, 235)
_UNTOLD = "No link was read", "The browser did not tell the page its address: load the page again to open a link."
VIEWS: tuple[tuple[View, str], ...] = (("3d", "Aircraft"), ("disk", "Disk"), ("blade", "Blade"), ("side", "Side"))
"""Views of the buttons over the scene, and their titles."""


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
        address = Address(facts.query, partial(set_query, client))
        problems: list[tuple[str, str]] = [] if facts.query is not None else [_UNTOLD]
        inputs_from = partial(
            share.inputs_from, kept=facts.kept.get(share.DESIGN), tell=partial(share.tell_retired, problems)
        )
        start = address.read(share.DESIGN, inputs_from, start, "Not the design of the link", problems)
        view = address.read(VIEW, view_from, ViewState(), "Not the view of the link", problems)
        gui = client.gui
        self._theme()
        gui.set_panel_label("Rotor explorer")
        self.bridge = bridge = Bridge(client)
        self._presence = Presence(client, shared.presentations, address, facts.kept.get(PRESENT, ""))
        self.layout = layout = Layout(client, bridge)
        self.top = TopBar(bridge, layout, callbacks.wake)
        self.display = Display(bridge, replace(view, dark=facts.dark), callbacks.wake, callbacks.azimuth_changed)
        with layout.in_mode("explore"):
            self.controls = DesignControls(gui, start, callbacks.wake)
            self.controls.stand.state = callbacks.state
        self._start, self._touched, self._held, self._pause = start, False, False, 0.0
        self._view: View = "3d"
        rotor = start.aircraft.rotor_for(start.preset)
        self._radius = rotor.radius
        self.scene = SceneController(client, rotor, self.display, facts.dark)
        self._keyboard = Keyboard(client)
        context = self.context = TabContext(
            inputs=self.controls.inputs,
            set_inputs=self._put,
            view=self.display.view,
            set_view=self.display.set_view,
            set_azimuth=self.display.turn,
            wake=callbacks.wake,
            download=self._download,
            notify=self._notify,
            state=callbacks.state,
            pin=self.top.pin_inputs,
            bind_command=self._keyboard.bind,
        )
        with layout.in_mode("optimise"):
            tasks = Sections(gui, bridge, "task", ("Search", "Map", "Schedule"))
            with tasks["Search"]:
                self.optimise = OptimisePanel(
                    gui, bridge, shared.pool, context, lambda design: self.schedule.legs(design), self._preview_changed
                )
            with tasks["Map"]:
                self.map = MapPanel(gui, shared.pool, context, self.optimise)
            with tasks["Schedule"]:
                self.schedule = SchedulePanel(
                    gui, bridge, shared.pool, context, self.optimise.request, self._preview_changed
                )
        with layout.in_mode("actuate"):
            self.actuator = ActuatorPanel(client, bridge, shared.pool, callbacks.wake, self._fly)
            self._actuator_inputs = self.actuator.inputs()
            self.per_rev = PerRevControls(gui, start, self.controls.inputs, self.controls.change)
            self.controls.placed = self.per_rev.place
        self._followed: Reading | None = None
        """What all tabs but the actuator's have followed."""
        self.results = ResultsPanel(gui, bridge, layout)
        with layout.in_drawer("details"):
            self.waterfall = WaterfallPanel(gui, self.controls.show_costs)
        with layout.in_drawer("twist"):
            self.sensitivity = SensitivityPanel(gui, Strip(client.scene), context, lambda: layout.drawer == "twist")
        with layout.in_drawer("probe"):
            self.probe = ProbePanel(
                client, bridge, context, self._set_playing, lambda: self._open("probe"), lambda: self.display.turn_rate
            )
        with layout.in_drawer("open"):
            opened = Sections(gui, bridge, "opened", ("Studies", "Files", "History"))
            with opened["Studies"]:
                studies = StudiesPanel(client, context, shared.studies)
            with opened["History"]:
                self.history = HistoryPanel(client, context, start, facts.kept.get(stored_history.NAME))
        with opened["Files"]:
            RotorUpload(gui, context)
        with layout.in_drawer("share"):
            self.file = FilePanel(client, context, address, facts.kept, opened["Files"])
            sources = ExportSources(lambda: self.history.kept, self.scene.held_range)
            export = ExportPanel(client, context, sources, lambda: self._open("share"))
        with layout.in_drawer("lecture"):
            self.lecture = LecturePanel(gui, bridge, context, self._presence, self._set_stage)
        with layout.in_drawer("settings"):
            settings = SettingsPanel(gui, self.display, self._enlarge)
        followers: tuple[Tab, ...] = (self.top, self.probe, self.sensitivity, self.waterfall, studies, settings)
        self.tabs = (*followers, self.history, self.file, export, self.lecture, self._presence)
        """Everything that only follows."""
        self.camera = self.scene.camera = FittedCamera(client, rotor.radius)
        self._wire(problems)
        for title, sentence in problems:  # They stay until they are closed: the link does not show what it names.
            client.add_notification(title, brief(sentence), color="red")

    def start(self) -> None:
        """The session begins: widgets as they will be, also where the first solution takes long."""
        self._refresh(Reading(self.controls.inputs(), self.display.view()))

    def stop(self) -> None:
        """The browser has left."""
        for tab in (self.optimise, self.map, self.schedule, self.actuator, *self.tabs):
            tab.stop()
        self.bridge.stop()

    def read(self) -> tuple[Inputs, ViewState]:
        """What the widgets mean now."""
        self._pause = self.controls.pauses.longest()
        return self.history.read(self._pause), self.display.view()

    def driven(self, design: Design) -> Design:
        """The design with the actuator's twist; ValueError where it cannot drive this blade."""
        self._actuator_inputs = self.actuator.inputs()
        return self._actuator_inputs.apply(design)

    def preview(self, design: Design) -> Design | None:
        """The design of a search to show in place of the one on the sliders."""
        return self.schedule.preview(design) or self.optimise.preview(design)

    @property
    def pin(self) -> Pinned | None:
        """A of A/B."""
        return self.top.pinned

    def pin_or_swap(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what the A/B buttons asked for; whether that moves the sliders."""
        moved = self.top.settle(inputs, solution, self.context)
        self.display.allow_difference(self.top.pinned is not None)
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
        self.bridge.set(arc=None if reading.previewed else self.grab.arc(solution, reading.view))
        self.camera.ride(math.radians(reading.view.azimuth_deg))
        # Only at harmonics does the cut blade turn with the marked one.
        turning = self._actuator_inputs.per_rev or solution.design.active_twist is not None
        if self._actuator_in_frame and (not frame.only_azimuth or turning):
            self._show_actuator(reading, solution)

    def _fly_measured(self, case: str) -> None:
        """Set a measured flight or test of this rotor, by its name."""
        condition = condition_of(self.controls.inputs().rotor, case)
        if condition is not None and not self._held:
            self.controls.stand.set_measured(condition)

    def show_power_number(self, state: SessionState) -> None:
        """Power, and what stands beside the hand: what a drag needs at each step."""
        self.results.card.show(state, self._pause)
        self._show_hand(state)

    def show_azimuth(self, state: SessionState) -> None:
        """Only the azimuth of the reference blade changed."""
        self.results.turn(state)
        self.sensitivity.show(state)
        self.probe.show(state)

    def show_results(self, reading: Reading, state: SessionState) -> None:
        """Numbers, charts, and the tabs that start long work."""
        self._refresh(reading)
        self.history.solved(reading.inputs, state.solution.power.total)
        self.results.show(state, self._pause)
        self._show_hand(state)
        self.bridge.set(beside_labels=beside_labels(state))
        self.display.show(state)

    def show_power(self, state: SessionState, curve: PowerCurve, failed: bool = False) -> None:
        """Power over advance ratio."""
        self.results.show_power(state, curve, failed)

    def follow(self, reading: Reading, state: SessionState) -> None:
        """All other tabs, and the address; the actuator's panel at rest, unless it is seen."""
        self._followed = reading
        if not self._actuator_in_frame and self.layout.mode == "actuate":
            self._show_actuator(reading, state.solution)
        for tab in self.tabs:
            tab.show(state)
        self.file.follow(state)

    def settle(self, state: SessionState) -> None:
        """The fine picture, the address, and what the page keeps of an own rotor and of the steps.

        It comes before the power curve: an early reload must find it.
        """
        self.scene.draw_finely()
        self.file.follow(state)
        self.file.keep()
        self.history.store()

    def rest(self, state: SessionState, stop: Callable[[], bool]) -> None:
        """What can wait: also the worth of flight sliders, and the waterfall."""
        self.settle(state)
        self.history.rest(stop)
        if self._followed is not None and not self._actuator_in_frame and self.layout.mode != "actuate":
            self._show_actuator(self._followed, state.solution)
        self.results.rest(stop)
        self.waterfall.climb(stop)

    def show_failure(self, failure: Failure) -> None:
        """The last converged picture stays, grey, beneath the sentence."""
        reading = failure.reading
        self._refresh(reading)
        self.actuator.show_failure(failure.message)
        self.results.problem(failure.message)
        for tab in self.tabs:
            tab.show_failure()
        self.scene.fade(failure.good, reading.view, self.top.answer if reading.view.difference else None)

    def show_error(self, sentence: str) -> None:
        """An update failed with an exception."""
        self.results.problem(brief(sentence))

    @property
    def _actuator_in_frame(self) -> bool:
        return self._actuator_inputs.shown or self._actuator_inputs.driven

    def _show_actuator(self, reading: Reading, solution: Solution) -> None:
        design, azimuth = reading.sliders or solution.design, math.radians(reading.view.azimuth_deg)
        self.actuator.show(self._actuator_inputs, design, solution, azimuth)

    def _refresh(self, reading: Reading) -> None:
        """What follows the widgets themselves: visible sliders, units, dark page, and the tabs of long work."""
        self.controls.follow(_on_sliders(reading))
        self.controls.refresh(reading.inputs, UNITS[reading.view.units])
        if reading.view.dark != self._dark:
            self._dark = reading.view.dark
            self._theme()
        self.top.show_design(reading.inputs, self.history.steps)
        self._touched = self._touched or reading.inputs != self._start
        self._prompt()
        self.optimise.refresh(reading.sliders)
        self.map.refresh(reading.sliders)
        self.schedule.refresh()
        self.bridge.set(notice=self.schedule.notice() or self.optimise.notice(reading.sliders))
        searching = self.layout.mode == "optimise"
        self.results.strip.show_starts(self.optimise.starts if searching else None, UNITS[reading.view.units])

    def _wire(self, problems: list[tuple[str, str]]) -> None:
        """Buttons to what they do, once everything stands; `problems` get what the page does not show as named."""
        controls, context, bridge = self.controls, self.context, self.bridge
        self.actuator.shown.on_update(self._cut_switched)
        controls.reset_button.on_click(lambda _: self._reset())
        controls.optimise_button.on_click(lambda _: self._optimise())
        bridge.on("mode", self._set_mode)
        bridge.on("drawer", self._toggle_drawer)
        bridge.on("rotor", lambda name: None if self._held else controls.choose_rotor(name))
        bridge.on("flown", self._fly_measured)
        bridge.on("undo", lambda _: self._step(self.history.undo))
        bridge.on("redo", lambda _: self._step(self.history.redo))
        bridge.on("view", lambda name: self._look(name))
        bridge.on("covered", lambda ends: self.camera.leave_free(float(ends[0]), float(ends[1])))
        bridge.on("colours", self._colour)
        bridge.on("play", lambda _: self.probe.toggle())
        controls.touched = self.results.card.tracker.touch
        bridge.on("hold", lambda held: None if self._held else self._took(bool(held)), at_once=True)
        by_hand = replace(context, set_inputs=self._pull)
        self.results.curve.bind(by_hand, lambda: not self._held, self._took)
        blade = self.scene.scene.rotor.reference_blade
        self.grab = BladeGrab(blade, by_hand, lambda: not self._held, self._grabbed)
        self.top.bind(context)
        self._presence.begin(context, PresentationHooks(lambda: self.lecture.step, self.lecture.follow, self._hold))
        bind_commands(context, Actions(self._look, self._colour, self._reset, self.optimise.toggle))
        self.file.begin(problems)
        self._show_views()
        self.top.refresh()

    def _hold(self, held: bool) -> None:
        """Leave what moves the page to a presenter, or give it back."""
        self._held = held
        for part in (self.controls, self.per_rev, self.display, self.top, self.lecture, self._keyboard):
            part.hold(held)

    def _put(self, inputs: Inputs) -> None:
        """Another design comes by no hand: no change since an earlier grab counts."""
        self.results.card.forget()
        self.controls.set_inputs(inputs)

    def _pull(self, inputs: Inputs) -> None:
        """A hand moves the blade, or its twist curve."""
        self.results.card.tracker.touch()
        self.controls.set_inputs(inputs)

    def _grabbed(self, held: bool) -> None:
        """The reference blade was taken by the hand, or let go."""
        self.camera.hold(held)
        self._took(held)

    def _took(self, held: bool) -> None:
        """A slider, the blade or a handle of its twist curve was taken, or let go."""
        tracker = self.results.card.tracker
        if held:
            tracker.grab()
            if (state := self.context.state()) is not None:
                self.grab.learn(state.inputs, self.results.worth.slopes)
        else:
            tracker.release()
            self.bridge.set(hand=None, arc=None)
        self.history.grab(held)
        self._callbacks.wake()

    def _show_hand(self, state: SessionState) -> None:
        """Power and its change beside the pointer, while the blade or its twist curve is held."""
        self.grab.learn(state.inputs, self.results.worth.slopes)
        hand, place = self.results.card.hand(UNITS[state.view.units]), self.grab.place or self.results.curve.place
        self.bridge.set(hand={**hand, "place": place} if hand is not None and place else None)

    def _prompt(self) -> None:
        """What to do first, until something was done."""
        wanted = not (self._touched or self._held) and self.layout.mode == "explore"
        tip = [0.97 * self._radius, 0.0, 0.0]
        words = {"text": "Drag the twist", "node": "/rotor/blade_0", "at": tip} if wanted else None
        self.bridge.set(prompt=words)

    def _step(self, step: Callable[[], None]) -> None:
        if not self._held:
            step()

    def _set_playing(self, playing: bool) -> None:
        """The rotor turns by itself from now on, or stands."""
        self.display.set_playing(playing)
        self.scene.play(playing)

    def _set_mode(self, mode: str) -> None:
        if mode in MODES:
            if self.layout.mode == "actuate" and mode != "actuate":
                self.actuator.leave_cut()
            self.layout.show_mode(mode)
            self.top.refresh()
            self._callbacks.wake()

    def _optimise(self) -> None:
        self._set_mode("optimise")
        self.optimise.begin()

    def _preview_changed(self) -> None:
        """A search or a playback begins, or its design was taken or left: no change since an earlier grab counts."""
        self.results.card.forget()

    def _toggle_drawer(self, name: str) -> None:
        self.layout.show_drawer(name)
        self.top.refresh()
        self._callbacks.wake()

    def _open(self, name: str) -> None:
        if self.layout.drawer != name and self.lecture.step is None:
            self._toggle_drawer(name)

    def _set_stage(self, mode: str) -> None:
        """A step of the lecture stands, or it has ended."""
        if mode:
            self.layout.show_drawer("")
        self._set_mode(mode or "explore")

    def _download(self, name: str, content: bytes) -> None:
        self._client.send_file_download(name, content, save_immediately=True)

    def _notify(self, title: str, sentence: str) -> None:
        self._client.add_notification(title, brief(sentence), auto_close_seconds=6)

    def _enlarge(self, big: bool) -> None:
        """Big type in wider panels, or both as usual."""
        self.bridge.set(big=big)
        self.layout.enlarge(big)

    def _theme(self) -> None:
        self._client.gui.configure_theme(
            dark_mode=self._dark, show_logo=False, show_share_button=False, brand_color=_BRAND
        )

    def _fly(self, advance_ratio: float) -> None:
        self._put(replace(self.controls.inputs(), advance_ratio=advance_ratio))

    def _cut_switched(self, event: viser.GuiEvent[Any]) -> None:
        """One blade, cut open, in place of the rotor."""
        cut = bool(event.target.value)
        self.scene.set_seen(not cut)
        self.probe.set_seen(not cut)
        if cut:
            self.camera.aim_with(partial(fit_cut, self._radius))
        else:
            self.camera.aim(self._view)
        self._show_views()

    def _look(self, view: View) -> None:
        self.actuator.leave_cut()
        self._view = view
        self.scene.look(view)
        self._show_views()
        self._callbacks.wake()

    def _show_views(self) -> None:
        self.bridge.set(views={"all": VIEWS, "now": "" if self.actuator.shown.value else self._view})

    def _colour(self, order: str) -> None:
        self.display.order_range(order)
        self.scene.order_range(order)
        self._callbacks.wake()

    def _reset(self) -> None:
        """The design the page began with; what is shown in its place, a preview or a flight, ends."""
        self.results.card.forget()
        self.schedule.land()
        self.optimise.withdraw()
        self.actuator.rest()
        self.controls.reset()


def _on_sliders(reading: Reading) -> Inputs | None:
    """What the sliders show of a preview; None where there is none."""
    if not reading.previewed or reading.design is None:
        return None
    preview = with_optimum(reading.inputs, reading.design)
    return replace(preview, advance_ratio=reading.design.condition.advance_ratio)
