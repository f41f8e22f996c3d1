"""The lecture of one session: where it begins, its caption below the scene, and what it gives back at its end."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import viser

from explorer.interface import SessionState, TabContext
from explorer.overlay.bridge import Bridge
from explorer.pinned import same_but_flight
from explorer.snapshot import PageSnapshot
from explorer.state import Inputs
from explorer.tabs.lecture import steps as cases
from explorer.tabs.lecture import steps as lecture
from explorer.tabs.lecture.presence import Presence
from explorer.tabs.lecture.steps import STEPS
from explorer.text.glossary import hint
from explorer.text.units import UNITS
from explorer.tour import STOPS, stop_begins, tour_at
from explorer.workers.player import Player

_NO_CASE = "–"
_PRESENTING = (
    '<div class="rx rx-dim rx-small">Copies a link. Anyone with the link sees what you set here, as you set it, '
    "and may leave at any time.</div>"
)


class LecturePanel:
    """One session's. Buttons act at once; the caption's numbers follow the session."""

    def __init__(
        self,
        gui: viser.GuiApi,
        bridge: Bridge,
        context: TabContext,
        presence: Presence,
        stage: Callable[[str], None],
    ) -> None:
        """`stage` is called with the mode that a step is shown in; empty once the lecture has ended."""
        self._bridge, self._context, self._presence, self._stage = bridge, context, presence, stage
        self._step: int | None = None
        self._before: PageSnapshot | None = None
        """The visitor's own page, to be given back at the end."""
        self._against: Inputs | None = None
        """A, as the step sets it beside what is on the sliders."""
        self._time: float | None = None
        """[s] since the tour began; None outside it."""
        self._player = Player(self._tour_on, "tour")
        self._held = False
        self._state: SessionState | None = None
        gui.add_html(
            '<div class="rx rx-dim">Seven steps set the page and say what to watch. '
            "End gives your own design back.</div>"
        )
        self._begin = gui.add_button("Start the lecture", icon=viser.Icon.SCHOOL, hint=hint("lecture"))
        self._tour = gui.add_button("One-minute tour", icon=viser.Icon.PLAYER_PLAY, color="gray", hint=hint("tour"))
        self._flights = gui.add_button_group("Fly at µ", tuple(cases.FLIGHTS), hint=hint("lecture_flights"))
        self._case = gui.add_dropdown("Cases", (_NO_CASE, *cases.CASES), hint=hint("document_case"))
        with gui.add_folder("Present to others"):
            self._present = gui.add_button("Present", icon=viser.Icon.PRESENTATION, color="gray", hint=hint("present"))
            gui.add_html(_PRESENTING)
            self._name_present()  # A presenter who loads the page again presents on.
        self._begin.on_click(lambda _: self.toggle())
        self._tour.on_click(lambda _: self.begin_tour())
        bridge.on("lecture", self._clicked)
        self._present.on_click(lambda _: self._present_or_end())
        self._flights.on_click(lambda event: self._fly(cases.FLIGHTS[event.target.value]))
        self._case.on_update(self._take_case)
        context.bind_command("lecture", self.toggle)
        context.bind_command("lecture_next", lambda: self.go(1))
        context.bind_command("lecture_previous", lambda: self.go(-1))

    @property
    def step(self) -> int | None:
        """The step that stands; None outside the lecture."""
        return self._step

    def toggle(self) -> None:
        """Begin with the first step, or end."""
        if self._step is None:
            self.set(0)
        else:
            self.end()

    def go(self, by: int) -> None:
        """To another step; beyond the last the lecture ends."""
        step = 0 if self._step is None else self._step + by
        if step >= len(STEPS):
            self.end()
        else:
            self.set(max(step, 0))

    def begin_tour(self) -> None:
        """Six stops of ten seconds in which the sliders move by themselves; End gives the page back."""
        if self._before is None:
            self._before = PageSnapshot.take(self._context)
        self._stand_at(None)
        self._context.pin(None)
        self._stage("explore")
        self._time = 0.0
        self._player.play()

    def _tour_on(self, seconds: float) -> None:
        """A step of the tour's clock."""
        time = self._time
        if time is None:
            return
        self._time = time + seconds
        instant = tour_at(self._time)
        if instant is None:
            self.end()
            return
        self._context.set_view(instant.view(self._context.view()))
        self._context.set_inputs(self._kept(instant.inputs))
        self._show()

    def set(self, step: int) -> None:
        """Set the page as a step describes it."""
        if self._before is None:
            self._before = PageSnapshot.take(self._context)
        self._stop_tour()
        self._stand_at(step)
        wanted, context = STEPS[step], self._context
        inputs = self._kept(wanted.inputs)
        self._against = lecture.beside(wanted, inputs)
        context.pin(self._against)
        context.set_view(lecture.view_of(wanted, context.view()))
        context.set_inputs(inputs)
        self._stage(wanted.mode)

    def follow(self, step: int | None) -> None:
        """Show the step of another page, which sets the rest."""
        if step != self._step:
            self._against = None
            self._stand_at(step)
            self._stage("" if step is None else STEPS[step].mode)

    def hold(self, held: bool) -> None:
        """Take what moves the page from the user, or give it back."""
        self._held = held
        self._begin.disabled = self._case.disabled = held
        self._flights.visible = not held
        self._show()

    def end(self) -> None:
        """The caption goes, and the visitor's own design, view and A come back."""
        before, self._before = self._before, None
        self._stop_tour()
        self._stand_at(None)
        if before is not None:
            before.restore(self._context)
        self._stage("")

    def show(self, state: SessionState) -> None:
        """Say what is seen now."""
        self._state = state
        self._name_case(state.inputs)
        step = self._step
        if self._time is not None:
            self._show()
        if step is None:
            return
        self._show()
        if self._against is None or state.pin is None or state.pin.inputs != self._against:
            return  # The user has made another design A.
        against = lecture.beside(STEPS[step], state.inputs)
        if against is not None and not same_but_flight(against, self._against):
            self._against = against
            self._context.pin(against)

    def show_failure(self) -> None:
        """There is nothing to say in numbers."""
        self._state = None
        self._show()

    def stop(self) -> None:
        """The browser has left."""
        self._player.pause()

    def _stop_tour(self) -> None:
        self._time = None
        self._player.pause()

    def _stand_at(self, step: int | None) -> None:
        self._step, self._state = step, None
        self._begin.label = "Start the lecture" if step is None else "End the lecture"
        self._show()
        self._context.wake()

    def _show(self) -> None:
        """The caption in the frame."""
        if self._time is not None:
            self._bridge.set(lecture=self._tour_caption(self._time))
            return
        if self._step is None:
            self._bridge.set(lecture=None)
            return
        step, state = STEPS[self._step], self._state
        watch = step.watch + (" The disk shows B − A: blue is less, rust is more." if step.difference else "")
        self._bridge.set(
            lecture={
                "at": self._step,
                "of": len(STEPS),
                "title": step.title,
                "watch": watch,
                "todo": step.do,
                "said": "" if state is None else step.say(state),
                "figures": [] if state is None else [(one.caption, one.value, "") for one in step.numbers(state)],
                "held": self._held,
            }
        )

    def _fly(self, advance_ratio: float) -> None:
        self._context.set_inputs(replace(self._context.inputs(), advance_ratio=advance_ratio))

    def _present_or_end(self) -> None:
        if self._presence.presenting:
            self._presence.end()
        else:
            self._presence.present()
        self._name_present()

    def _name_present(self) -> None:
        self._present.label = "Stop presenting" if self._presence.presenting else "Present"

    def _take_case(self, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None and event.target.value in cases.CASES:
            self._context.set_inputs(self._kept(cases.CASES[event.target.value]))

    def _name_case(self, inputs: Inputs) -> None:
        """The menu names a case for as long as the sliders hold it."""
        held = (title for title, case in cases.CASES.items() if self._kept(case) == inputs)
        if self._case.value != (title := next(held, _NO_CASE)):
            self._case.value = title

    def _kept(self, inputs: Inputs) -> Inputs:
        """These inputs, with the rotor that the user brought still in the menu."""
        return replace(inputs, own_rotor=self._context.inputs().own_rotor)

    def _tour_caption(self, time: float) -> dict[str, Any] | None:
        instant, state = tour_at(time), self._state
        if instant is None:
            return None
        numbers: list[tuple[str, str, str]] = []
        if state is not None:
            power, units = state.solution.power, UNITS[state.view.units]
            numbers = [
                ("total power", units.watts(power.total), ""),
                ("induced", units.watts(power.induced), ""),
                ("profile", units.watts(power.profile), ""),
            ]
        return {
            "at": instant.stop,
            "of": len(STOPS),
            "title": "A tour of one minute",
            "watch": instant.caption,
            "todo": "",
            "said": "",
            "figures": numbers,
            "held": self._held,
        }

    def _clicked(self, which: Any) -> None:
        if self._held:
            return
        if self._time is not None:
            stop = tour_at(self._time)
            now = 0 if stop is None else stop.stop
            to = {"next": now + 1, "back": max(now - 1, 0), "again": now}.get(which)
            if to is None or to >= len(STOPS):
                self.end()
            else:
                self._time = stop_begins(to)
            return
        if self._step is None:
            return
        match which:
            case "back":
                self.go(-1)
            case "next":
                self.go(1)
            case "again":
                self.set(self._step)
            case _:
                self.end()
