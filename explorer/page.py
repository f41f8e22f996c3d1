"""The page of one client: where its parts stand, and what each of them does when the session calls.

The parts themselves are in `explorer/widgets`, the scene in `explorer/scene`.
"""

import math
import time
from collections.abc import Callable, Hashable, Iterator
from dataclasses import replace
from functools import partial
from typing import Literal

import viser

from explorer.hosting.browser import set_query
from explorer.hosting.messages import PageFacts
from explorer.model.actuator_inputs import (
    AT_REST,
    ActuatorInputs,
    HandSettings,
    inputs_from_spec,
    mission_over,
)
from explorer.model.inputs import Inputs, ViewState
from explorer.model.session_state import PinResult
from explorer.model.sliders import nearest_trim
from explorer.parts.presses import SlidePress
from explorer.scene.camera import FittedCamera
from explorer.scene.controller import SceneController
from explorer.scene.overlays import overlay_of
from explorer.sharing import share
from explorer.sharing.share import VIEW, Address, view_from
from explorer.text.glossary import hint
from explorer.views.actuated import counted_from
from explorer.views.actuator import ACTUATOR
from explorer.views.assessed import ACTUATOR_CARD
from explorer.views.bar import BAR
from explorer.views.dial import DIAL
from explorer.views.drawers import DETAILS, TRUST
from explorer.views.flight import BY_HAND, FLIGHT
from explorer.views.inset import INSET
from explorer.views.line import LINE
from explorer.views.mission import MISSION
from explorer.views.notice import NOTICE, PROMPT
from explorer.views.page_state import (
    Effect,
    MoveSliders,
    OpenPanels,
    PageState,
    PinDesign,
    PinOrder,
    SetGrabbed,
    SetHand,
)
from explorer.views.panel_updater import PanelUpdater
from explorer.views.pay import PAY
from explorer.views.power import HAND, POWER
from explorer.views.prices import PRICES
from explorer.views.ride_cost import RIDE_COST
from explorer.views.strip import STRIP
from explorer.views.vibration import VIBRATION
from explorer.views.waterfall import COSTS, WATERFALL
from explorer.views.worth import WORTH, twist_slopes
from explorer.widgets.actuator.actuator_panel import ActuatorPanel
from explorer.widgets.context import TabContext
from explorer.widgets.controls import SessionCallbacks
from explorer.widgets.design_files import FilePanel, add_rotor_upload
from explorer.widgets.export_panel import ExportPanel
from explorer.widgets.history_panel import HistoryPanel
from explorer.widgets.layout import Sections
from explorer.widgets.lecture.lecture_panel import LecturePanel
from explorer.widgets.optimise.map_panel import MapPanel
from explorer.widgets.optimise.optimise_panel import OptimisePanel
from explorer.widgets.optimise.schedule_panel import SchedulePanel
from explorer.widgets.probe_panel import ProbePanel
from explorer.widgets.results import drawer_texts
from explorer.widgets.twist_curve import TwistCurveEditor
from explorer.widgets.views import SceneViews, SettingsPanel, theme
from rotor import Design, Solution, solve
from rotor.support.markup import tag
from rotor.support.processes import Processes
from rotor.support.user_input import brief

_ACTUATE = ACTUATOR, ACTUATOR_CARD, FLIGHT, PAY, DIAL, MISSION
AT_ONCE = BAR, PROMPT
"""Panels that follow a press before the update that it wakes."""
_NUMBER = LINE, POWER, HAND
PANELS = (
    *(*AT_ONCE, *_NUMBER, VIBRATION, NOTICE, STRIP, WORTH, INSET, DETAILS, TRUST),
    *(WATERFALL, COSTS, PRICES, RIDE_COST, *_ACTUATE),
)
Urgency = Literal["azimuth", "address", "number", "results", "tabs", "power", "rest", "kept"]
"""What of the page follows a state, in order of how soon: only the azimuth changed; what a reload must find, and the
number, with the frame; what stands beside the picture, after every frame; what follows that; power over µ; what is seen
and kept at rest; what could wait."""
_NOT_USED = "The design of this link is not shown"
_NOT_STORED = (
    "Nothing is stored",
    "This browser stores nothing for the page: a reload keeps the design in the address, and loses history, bookmarks "
    "and your own rotors.",
)
_NO_NEAREST = (
    "No nearest design is known",
    "Change what the sentence on top names, or undo the last step.",
)
_NO_LINK = (
    "Link not read",
    "The browser did not give the page its address: reload the page to open a link.",
)


def _acts(hand: HandSettings) -> tuple[Hashable, ...]:
    """What of the hand an answer depends on."""
    return (hand.actuator, hand.state, hand.on_board) if hand.on_board else (False,)


class Page:
    """Built once for a client; the session calls it from its worker thread."""

    def __init__(
        self,
        client: viser.ClientHandle,
        start: Inputs,
        facts: PageFacts,
        pool: Processes,
        callbacks: SessionCallbacks,
    ) -> None:
        """`start`: where the page's address holds no design."""
        address = Address(facts.query, partial(set_query, client))
        address.drop_retired()
        if facts.query is None:
            address.problems.append(_NO_LINK)
        if not facts.stores:
            address.problems.append(_NOT_STORED)
        inputs_from = partial(share.inputs_from, kept=facts.kept.get(share.DESIGN))
        opening, start = start, address.read(share.DESIGN, inputs_from, start, _NOT_USED)
        view = address.read(VIEW, view_from, ViewState(), "Link: view not used")
        theme(client, facts.dark)
        client.gui.set_panel_label("Rotor explorer")
        self.latest = PageState(start, None, None, view=replace(view, dark=facts.dark))
        """As of the last update; `now` has the rest."""
        callbacks = replace(callbacks, wake=partial(self._woken, callbacks.wake))
        self.context = TabContext(client, self.latest, pool, callbacks)
        rotor = start.aircraft.rotor_for(start.preset)
        camera = FittedCamera(client, rotor.radius)
        self.scene = SceneController(
            client, camera, rotor, self.context.display.show_range, facts.dark
        )
        self._add_rail(address)
        self._add_drawers(address, facts)
        self._listen(opening, address)
        for (
            title,
            sentence,
        ) in address.problems:  # Stays until closed: the page does not show what the link names.
            if title == _NOT_USED:
                self._tell(sentence, opening)
            else:
                client.add_notification(title, brief(sentence), color="red")

    def _add_rail(self, address: Address) -> None:
        """What stands on the right beside the sliders of Explore."""
        context = self.context
        with context.layout.modes["optimise"]:
            tasks = Sections(context.gui, context.bridge, "task", ("Search", "Map", "Schedule"))
            with tasks["Search"]:
                self.optimise = OptimisePanel(context, address)
            with tasks["Map"]:
                power_map = MapPanel(context, self.optimise)
            with tasks["Schedule"]:
                self._schedule = SchedulePanel(context, self.optimise)
        context.refreshing += [
            self.optimise.refresh,
            power_map.refresh,
            self._schedule.refresh,
        ]
        with context.layout.modes["actuate"]:
            self.actuator = ActuatorPanel(context, address)
        self.optimise.mission = lambda design: mission_over(design, self.actuator.inputs().hours)
        self._curve = TwistCurveEditor(context, self._blade_grabbed)

    def _add_drawers(self, address: Address, facts: PageFacts) -> None:
        """What stands on the left, and the panels."""
        context, start = self.context, self.latest.inputs
        layout, gui = context.layout, context.gui
        texts = {**drawer_texts(context), **self.actuator.texts, **self._schedule.texts}
        with layout.drawers["probe"]:
            probe = ProbePanel(context, self.scene)
        with layout.drawers["open"]:
            opened = Sections(gui, context.bridge, "opened", ("Files", "History"))
            with opened["Files"]:
                add_rotor_upload(context)
            with opened["History"]:
                self.history = HistoryPanel(
                    context,
                    self.actuator.hand,
                    self._set_actuator,
                    start,
                    facts.kept.get(share.STEPS_KEPT),
                )
        self._views = SceneViews(context, self.scene, probe, self.actuator)
        self._views.follow_browser(facts.scene)
        with layout.drawers["share"]:
            self.file = FilePanel(context, address, facts.kept, opened["Files"], self._carry)
            ExportPanel(context, self.scene, self.history, self.actuator, self.now)
        with layout.drawers["lecture"]:
            self.lecture = lecture = LecturePanel(context, self.scene.camera, self._views, self.now)
        with layout.drawers["settings"]:
            settings = SettingsPanel(context)
        self.panel_updater = PanelUpdater(
            PANELS,
            context.bridge,
            context.keyboard.bind,
            texts,
            context.pool,
            context.wake,
            self.now,
            self._pressed,
            self._perform,
        )
        context.following += [probe.show, settings.show, self.history.show, lecture.show]

    def _listen(self, opening: Inputs, address: Address) -> None:
        """Presses that no part of the page has for itself."""
        context, bridge, camera = self.context, self.context.bridge, self.scene.camera
        context.resting.append(self.panel_updater.rest)
        context.waiting.append(self.panel_updater.is_waiting)
        context.leaving += [self.panel_updater.stop, context.work.stop, bridge.stop]
        context.layout.watchers.append(partial(self.panel_updater.follow, AT_ONCE.__contains__))
        self.scene.on_press(lambda metres: self._curve.grab(metres / camera.radius))
        context.keyboard.bind("reset", partial(self._reset, opening))
        bridge.on("slide", self._slide)
        bridge.on("default", partial(self._default, opening))
        bridge.on("nearest", lambda _: self._nearest_trim())
        bridge.on("aim", lambda _: camera.come_back())
        bridge.on("taken", lambda _: camera.let_go())
        bridge.on(
            "covered",
            lambda cards: camera.leave_free(cards.above, cards.below, cards.left, cards.right),
        )
        bridge.on("hold", lambda held: self._grabbed(bool(held)), at_once=True)
        if (
            actuator := address.read(
                share.CARRIED, inputs_from_spec, None, "Link: actuator not used"
            )
        ) is not None:
            self._carry(actuator)
        elif self.actuator.hand().on_stage:
            context.layout.show_mode("actuate")

    def _tell(self, sentence: str, opening: Inputs) -> None:
        """Over the whole page: the link's design is not the one behind this dialogue."""
        modal = self.context.client.gui.add_modal(_NOT_USED)
        with modal:
            gui = self.context.client.gui
            gui.add_html(tag("div.rx", brief(sentence)))
            gui.add_button(
                f"Show the {opening.aircraft.name} instead", hint=hint("instead")
            ).on_click(lambda _: modal.close())

    def start(self) -> None:
        """The session begins: widgets as they will be, also where the first solution takes long."""
        self.latest = replace(self.latest, inputs=self.context.inputs())
        self._refresh()
        self.panel_updater.follow(AT_ONCE.__contains__)

    def stop(self) -> None:
        """The browser has left: end threads and jobs."""
        for leave in self.context.leaving:
            leave()

    def read(self) -> PageState:
        """What the widgets mean now, without what follows from it. A change of inputs becomes a step of undo."""
        tracker, context = self.context.tracker, self.context
        tracker.pause = context.controls.pauses.longest()
        with context.whole:
            hand = self.actuator.hand()
            inputs, view = self.history.read(tracker.pause), context.display.view
        if self.latest.state is not None:
            self._mark_stale()
        return replace(
            self.latest, inputs=inputs, view=view, hand=hand, sliders=None, preview=None, problem=""
        )

    def counted_from(self, now: PageState) -> Design | None:
        """The blade that changes count from where the design carries an actuator; None: as usual."""
        return counted_from(
            replace(
                now, ui=OpenPanels(self.context.layout.mode), answers=self.panel_updater.answers()
            )
        )

    def pin_or_swap(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what the A/B buttons asked for; True if that moved the sliders, so that another update follows."""
        able = solution if solution is not None and solution.converged else None
        before = self.context.pinboard.pinned
        outcome = self.context.pinboard.act(inputs, able) or PinResult(None)
        if outcome.sentence:
            self.context.notify("A and B", outcome.sentence)
        if outcome.inputs is not None:
            self.context.set_inputs(outcome.inputs)
        if self.context.pinboard.pinned is not before:
            self.history.note_pinned()
        self.context.display.allow_difference(self.context.pinboard.pinned is not None)
        return outcome.inputs is not None

    def draw(
        self, now: PageState, solution: Solution, pinned: Solution | None, only_azimuth: bool
    ) -> None:
        """Draw a converged solution and send it. Nothing else belongs here: it is the delay that the user feels.

        `pinned`: A, where the scene shows it. `only_azimuth`: only the reference blade's azimuth can have changed.
        """
        overlay = overlay_of(
            None if now.preview is None else now.sliders, self.context.pinboard.pinned
        )
        self.scene.camera.resize(solution.design.rotor.radius)
        self._views.before = self._curve.before
        # Otherwise the blade from the tip and the plan of the disk hide the scene.
        if self._views.before is None:
            self.scene.draw(solution, now.view, overlay, pinned)
        if not only_azimuth:
            self._views.show_plan(solution, now.view, at_rest=False)
        psi = math.radians(now.view.azimuth_deg)
        self.scene.camera.ride(psi)
        # Only at harmonics does the lifted blade turn with the marked one.
        if not only_azimuth or solution.design.active_twist is not None:
            self.actuator.draw(now.hand.actuator, now.sliders or solution.design, solution, psi)
        self.context.tracker.solved(now.inputs, solution.power.total)

    def now(self) -> PageState:
        """All that is known, for the panels that are functions of it; safe from any thread."""
        context = self.context
        return replace(
            self.latest,
            ui=OpenPanels(
                context.layout.mode,
                context.layout.drawer,
                self.actuator.lifted,
                self._views.now == "disk",
                self._views.probe.riding,
            ),
            pins=context.pinboard.now,
            kept=self.history.kept,
            steps=self.history.steps,
            station=self._curve.held,
            change=context.tracker.change,
            game=self.optimise.hand.standing,
            searching=self.optimise.notice(self.latest.sliders),
            memory=self.panel_updater.memory,
            answers=self.panel_updater.answers(),
        )

    def _pressed(self) -> PageState:
        """All that is known, with what the widgets mean at this moment; where they mean no design, with the last."""
        now = self.now()
        sliders = (
            now.state.inputs.design()
            if now.sliders is None and now.state is not None
            else now.sliders
        )
        return replace(
            now, inputs=self.context.inputs(), sliders=sliders, hand=self.actuator.hand()
        )

    def _woken(self, wake: Callable[[], None]) -> None:
        """An input may have changed: mark what is shown, long before the answer, and have the session update it."""
        # The page may not be whole yet.
        if self.latest.state is not None:
            self._mark_stale()
        wake()

    def _mark_stale(self) -> None:
        """Say whether what is shown belongs to other inputs than those that are set now."""
        latest, hand = self.latest, self.actuator.hand()
        same = _acts(hand) == _acts(latest.hand) and self.context.inputs() == latest.inputs
        self.context.bridge.set(stale=not same)

    def show(self, now: PageState, urgency: Urgency) -> None:
        """Have what is as urgent as this follow a converged state."""
        last, self.latest, context, follow = (
            self.latest.state,
            now,
            self.context,
            self.panel_updater.follow,
        )
        state = now.state
        if state is None:
            return
        match urgency:
            case "azimuth":
                follow(lambda panel: panel.turns)
                self._views.probe.show(state)
            case "address":
                context.analyses.forget_others(
                    state.solution, state.reference, *self.optimise.hand.solutions
                )
                self.panel_updater.memory = self.panel_updater.memory.then(state, last)
                self.file.follow(state)
                self.actuator.write_address()
            case "number":
                self._learn()
                follow(_NUMBER.__contains__)
            case "results":
                # Each message by itself would wake the thread that sends.
                with context.client.atomic():
                    # While a hand moves on, each answer ends the mark and the next update begins it: in a drag the page
                    # is faint only where answers are slow.
                    context.bridge.set(stale=False)
                    self.optimise.hand.show(state)
                    self._refresh()
                    self._curve.show(state)
                    self._learn()
                    follow()
                    context.display.show(state)
            case "tabs":
                # A change is marked on a thread of its own, which may have come too late.
                self._mark_stale()
                for show in context.following:
                    show(state)
            case "power":
                follow((STRIP,).__contains__)
            case "rest":  # Vortices in the scene.
                self._mark_stale()
                self.scene.draw_at_rest()
                self._views.show_plan(state.solution, state.view, at_rest=True)
            case "kept":
                self.file.follow(state)
                self.file.keep()
                self.history.store()

    def work(self) -> Iterator[None]:
        """Steps of what a page at rest has computed: slopes of power and how sure it is."""
        yield from self.panel_updater.work(soon=True)
        self.lecture.refresh()
        if self._curve.held is not None:
            self._learn()
            self.panel_updater.follow((HAND,).__contains__)

    def work_later(self) -> Iterator[None]:
        """Steps of what may come after the sweep of power over µ."""
        yield from self.history.solve_waiting()
        yield from self.panel_updater.work(soon=False)
        self.lecture.refresh()

    def _learn(self) -> None:
        """Where the station in the hand is best, as far as power and its slopes tell."""
        now = self.now()
        if now.state is not None:
            self._curve.learn(now.state.inputs, now.state.solution.power.total, twist_slopes(now))

    def show_failure(self, now: PageState, good: Solution | None) -> None:
        """Inputs without a solution: the picture, of the last converged one, stays, grey, beneath the sentence."""
        self.latest = now
        self._mark_stale()
        self._refresh()
        self.panel_updater.follow()
        for show in self.context.following:
            show(None)
        self.scene.fade(
            good, now.view, self.context.pinboard.answer if now.view.difference else None
        )

    def _nearest_trim(self) -> None:
        """From inputs without a trim to the nearest that their sentence names; one step of undo takes it back."""
        state = self.context.state()
        if state is not None:
            wanted, carried = (
                self.context.controls.inputs(),
                state.solution.design.rotor.blade.carried,
            )
            kilograms = carried.aircraft_kg if carried else 0.0

            def trims(inputs: Inputs) -> bool:
                try:
                    return solve(self.latest.hand.fit(inputs.design()), state.solution).converged
                except ValueError:
                    return False

            nearest = nearest_trim(wanted, trims, self.latest.problem, kilograms)
            if nearest is None:
                self.context.notify(*_NO_NEAREST)
            else:
                self.context.set_inputs(nearest)

    def show_error(self, sentence: str) -> None:
        """An update failed with an exception."""
        self.latest = replace(self.latest, problem=brief(sentence))
        self._mark_stale()
        self.panel_updater.follow()

    def _refresh(self) -> None:
        """What follows the widgets themselves: visible sliders, units, dark page, and the tabs of long work."""
        inputs, context = self.latest.inputs, self.context
        context.controls.follow(None if self.latest.preview is None else self.latest.shown)
        context.controls.refresh(inputs, context.units)
        for refresh in context.refreshing:
            refresh(self.latest.sliders)

    def _blade_grabbed(self, held: bool) -> None:
        """The blade or a handle of its twist curve was taken by the hand, or let go."""
        self.scene.camera.hold(held)
        self._grabbed(held)

    def _grabbed(self, held: bool) -> None:
        """A slider or a station of the blade was taken by the hand, or let go."""
        self.context.controls.pauses.begin(time.monotonic())
        if held:
            self.context.tracker.grab()
            self._learn()
        else:
            self.context.tracker.release()
        self.history.grab(held)
        self.context.wake()

    def _perform(self, effect: Effect) -> None:
        """Do what a press says."""
        match effect:
            case MoveSliders(inputs, by_hand):
                (self.context.drag_to if by_hand else self.context.set_inputs)(inputs)
            case SetGrabbed(held):
                self._grabbed(held)
            case PinOrder(order):
                self.context.pinboard.ask(order)
                self.context.wake()
            case PinDesign(design):
                self.context.pin(design)
            case _:
                self.actuator.perform(effect)

    def _carry(self, actuator: ActuatorInputs) -> None:
        """A link or a file has an actuator on board: show it. The hours of the mission and what changes count from are
        no part of it, and stay."""
        now = self.actuator.inputs()
        self._set_actuator(replace(actuator, hours=now.hours, against=now.against))
        self.context.layout.show_mode("actuate")

    def _set_actuator(self, actuator: ActuatorInputs) -> None:
        """As if by hand, in whatever mode the page is."""
        self.actuator.perform(SetHand(BY_HAND, vars(actuator)))

    def _default(self, opening: Inputs, label: str) -> None:
        """A slider was double-clicked."""
        mode = self.context.layout.mode
        if mode == "explore":
            self.context.controls.default(label, opening)
        elif mode == "optimise":
            self.optimise.form.default(label)
        else:
            self.actuator.controls.form.default(label)

    def _slide(self, to: SlidePress) -> None:
        """A number of the line, or the dot of power over µ, was moved: its slider moves as if by a hand."""
        forms = (
            self.context.controls.form,
            self.context.controls.stand.form,
            self.actuator.controls.form,
        )
        for form in forms:
            if to.name in form:
                form.move(to.name, to.place)

    def _reset(self, opening: Inputs) -> None:
        """The design of a page without a link; what is shown in its place, a preview, ends."""
        self.context.tracker.reset()
        self.optimise.withdraw()
        self.actuator.perform(SetHand(BY_HAND, {"drives": AT_REST}))
        self.optimise.hand.begin(None)
        self.context.display.turn(ViewState.azimuth_deg)
        self.context.controls.set_inputs(opening)
