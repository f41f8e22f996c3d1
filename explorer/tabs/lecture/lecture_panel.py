"""The lecture of one session: where it begins, its caption below the scene, and what it gives back at its end."""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import viser

from explorer.model.inputs import OWN, Inputs, ViewState
from explorer.model.pinned import same_but_flight
from explorer.model.session_state import SessionState
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.layout import by_hand
from explorer.tabs.lecture.steps import CASES, FLIGHTS, STEPS, beside, view_of
from explorer.text.glossary import hint

_NO_CASE = "–"


@dataclass(frozen=True)
class PageSnapshot:
    """The design on the sliders, what is shown, and A."""

    inputs: Inputs
    view: ViewState
    pinned: Inputs | None
    """A of A/B; None: nothing is pinned."""

    @staticmethod
    def of(context: TabContext) -> "PageSnapshot":
        """The page as it is now."""
        state = context.state()
        pin = None if state is None else state.pin
        return PageSnapshot(context.inputs(), context.view(), None if pin is None else pin.inputs)

    def restore(self, context: TabContext) -> None:
        """Give the page back.

        Units and dark mode stay as they are now, because they belong to the room, not to the design; a rotor file
        brought meanwhile stays in the menu.
        """
        now = context.view()
        inputs = self.inputs
        if inputs.rotor != OWN:
            inputs = replace(inputs, own_rotor=context.inputs().own_rotor)
        context.pin(self.pinned)
        context.display.set_view(replace(self.view, units=now.units, dark=now.dark))
        context.set_inputs(inputs)


class LecturePanel(Tab):
    """One session's. Buttons act at once; the caption's numbers follow the session."""

    def __init__(self, context: TabContext) -> None:
        self._context, gui = context, context.gui
        self._step: int | None = None
        self._before: PageSnapshot | None = None
        """The visitor's own page, to be given back at the end."""
        self._against: Inputs | None = None
        """A, as the step sets it beside what is on the sliders."""
        self._state: SessionState | None = None
        gui.add_html(
            '<div class="rx rx-dim">Eight steps set the page and say what to watch. '
            "End gives your own design back.</div>"
        )
        self._begin = gui.add_button("Start the lecture", icon=viser.Icon.SCHOOL, hint=hint("lecture"))
        self._flights = gui.add_button_group("Fly at µ", tuple(FLIGHTS), hint=hint("lecture_flights"))
        self._case = gui.add_dropdown("Cases", (_NO_CASE, *CASES), hint=hint("document_case"))
        self._begin.on_click(lambda _: self.toggle())
        self._flights.on_click(lambda event: self._fly(FLIGHTS[event.target.value]))
        by_hand(self._case, self._case_chosen)
        context.bridge.on("lecture", self._clicked)
        bind = context.keyboard.bind
        bind("lecture", self.toggle)
        bind("lecture_next", lambda: self.go(1))
        bind("lecture_previous", lambda: self.go(-1))
        for name, advance_ratio in zip(("hover", "mu_015", "mu_024", "mu_037"), FLIGHTS.values(), strict=True):
            bind(name, partial(self._fly, advance_ratio))

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

    def set(self, step: int) -> None:
        """Set the page as a step describes it."""
        if self._before is None:
            self._before = PageSnapshot.of(self._context)
        self._stand_at(step)
        wanted, context = STEPS[step], self._context
        inputs = self._kept(wanted.inputs)
        self._against = beside(wanted, inputs)
        context.pin(self._against)
        context.display.set_view(view_of(wanted, context.view()))
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
        self._begin.disabled = self._case.disabled = held
        self._flights.visible = not held
        self._show()

    def end(self) -> None:
        """The caption goes, and the visitor's own design, view and A come back."""
        before, self._before = self._before, None
        self._stand_at(None)
        if before is not None:
            before.restore(self._context)
        self._stage("")

    def show(self, state: SessionState) -> None:
        """Say what is seen now."""
        self._state = state
        self._name_case(state.inputs)
        if self._step is None:
            return
        self._show()
        if self._against is None or state.pin is None or state.pin.inputs != self._against:
            return  # The user has made another design A.
        against = beside(STEPS[self._step], state.inputs)
        if against is not None and not same_but_flight(against, self._against):
            self._against = against
            self._context.pin(against)

    def show_failure(self) -> None:
        """There is nothing to say in numbers."""
        self._state = None
        self._show()

    def _stage(self, mode: str) -> None:
        """The mode that a step is shown in, without a drawer; empty once the lecture has ended."""
        layout = self._context.layout
        layout.drawers_locked = self._step is not None
        if mode:
            layout.show_drawer("")
        layout.show_mode(mode or "explore")

    def _stand_at(self, step: int | None) -> None:
        self._step, self._state = step, None
        self._begin.label = "Start the lecture" if step is None else "End the lecture"
        self._show()
        self._context.wake()

    def _show(self) -> None:
        """The caption in the frame."""
        if self._step is None:
            self._context.bridge.set(lecture=None)
            return
        step, state = STEPS[self._step], self._state
        watch = step.watch + (" The disk shows B − A: blue is less, rust is more." if step.difference else "")
        self._context.bridge.set(
            lecture={
                "at": self._step,
                "of": len(STEPS),
                "title": step.title,
                "watch": watch,
                "todo": step.do,
                "said": "" if state is None else step.say(state),
                "figures": [] if state is None else step.figures(state),
                "held": self._context.held,
            }
        )

    def _fly(self, advance_ratio: float) -> None:
        self._context.set_inputs(replace(self._context.inputs(), advance_ratio=advance_ratio))

    def _case_chosen(self, title: str) -> None:
        if title in CASES:
            self._context.set_inputs(self._kept(CASES[title]))

    def _name_case(self, inputs: Inputs) -> None:
        """The menu names a case for as long as the sliders hold it."""
        held = (title for title, case in CASES.items() if self._kept(case) == inputs)
        if self._case.value != (title := next(held, _NO_CASE)):
            self._case.value = title

    def _kept(self, inputs: Inputs) -> Inputs:
        """These inputs, with the rotor that the user brought still in the menu."""
        return replace(inputs, own_rotor=self._context.inputs().own_rotor)

    def _clicked(self, which: Any) -> None:
        if self._context.held or self._step is None:
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
