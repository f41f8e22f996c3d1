"""The lecture of one session: its steps beside the scene, guess and control of each, and what its end gives back.

Also the flights and designs of the source document to begin from.
"""

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import viser

from explorer.model.actuator_inputs import HandSettings
from explorer.model.inputs import OWN, Inputs, preset_inflow
from explorer.model.session_state import ScreenState, SessionState, same_but_flight
from explorer.model.units import UNITS, Units
from explorer.parts.frame import LecturePart
from explorer.scene.camera import FittedCamera
from explorer.story.facts import facts_at
from explorer.story.numbers import ControlStop, StepFacts, words_of
from explorer.story.records import answer_record, step_record
from explorer.story.sides import side_names
from explorer.story.steps import (
    STEPS,
    Figure,
    compared_inputs,
    compared_quantities,
    on_one_line,
    view_of,
)
from explorer.text.glossary import hint
from explorer.views.page_state import PageState
from explorer.views.vibration import index_band
from explorer.views.work import shown_doubt
from explorer.widgets.context import TabContext
from explorer.widgets.layout import by_hand
from explorer.widgets.views import SceneViews
from explorer.workers.background import PoolAnswers
from explorer.workers.call import Call
from rotor import doubt
from rotor.support.markup import tag

FLIGHTS = {"Hover": 0.0, "0.15": 0.15, "0.24": 0.24, "0.37": 0.37}
"""Advance ratios: hover, minimum power, cruise, high speed."""

_THESIS = Inputs(
    preset="thesis", law="linear", linear=-16.0, advance_ratio=0.0, **preset_inflow("thesis")
)
_STATED = {
    "hover optimum, −13.5°": (0.0, -13.5),
    "hover, −16°": (0.0, -16.0),
    "from µ 0.18, −8°": (0.18, -8.0),
}
"""What the source document states (chapter 3): advance ratio, linear twist [°]. It does not say of what length."""
_SPAN = 1.0 - _THESIS.design().rotor.blade.root_cutout
DOCUMENT: dict[str, Inputs] = {
    f"Document: {title} {unit}": replace(_THESIS, advance_ratio=mu, linear=round(twist / length, 1))
    for unit, length in (("root to tip", _SPAN), ("per radius", 1.0))
    for title, (mu, twist) in _STATED.items()
}
"""In both readings of its twist, in its preset; first the one that gives more of its statements."""
EXAMPLES: dict[str, Inputs] = {
    "Example: low speed, µ 0.10, −12°": replace(_THESIS, linear=-12.0, advance_ratio=0.1),
    "Example: high speed, µ 0.35, −4°": replace(_THESIS, linear=-4.0, advance_ratio=0.35),
}
"""Our own cases in the preset of the document, which prints no advance ratio for low and high speed."""
CASES = {**DOCUMENT, **EXAMPLES}
"""The menu."""
_NO_CASE = "–"


OTHER_DESIGN = "The page shows another design than this step: its text and chart are about its own."
_WORDS = "Ten steps. Each sets the page, asks you to guess and gives the answer. End restores your design."


@dataclass(frozen=True)
class StoryPlace:
    """Where the lecture stands."""

    step: int
    guess: int | None = None
    """The answer that was chosen; None before."""
    stop: int = 0
    """Position of the step's control."""


class LecturePanel:
    """The lecture of a session. Buttons act at once; the numbers follow the session."""

    def __init__(
        self,
        context: TabContext,
        camera: FittedCamera,
        screen: SceneViews,
        now: Callable[[], PageState],
    ) -> None:
        self._context, self._camera, self._screen, self._now, gui = (
            context,
            camera,
            screen,
            now,
            context.gui,
        )
        self.place: StoryPlace | None = None
        """Where the lecture is; None outside it."""
        self._guesses: dict[int, int] = {}
        """Answers chosen, by step."""
        self._before: ScreenState | None = None
        """The visitor's own page, to be given back at the end."""
        self._against: Inputs | None = None
        """A, as the step sets it beside what is on the sliders."""
        self._state: SessionState | None = None
        self._showing = threading.Lock()
        """Held from reading the place to sending it: an answer that comes as the lecture ends shows nothing."""
        self._answers = PoolAnswers(context.pool, 4, self._facts_received)
        context.resting.append(self._answers.rest)
        context.waiting.append(self._answers.is_waiting)
        context.leaving.append(self._answers.stop)
        gui.add_html(tag("div.rx.rx-dim", _WORDS))
        self._begin = gui.add_button(
            "Start the lecture", icon=viser.Icon.SCHOOL, hint=hint("lecture")
        )
        flights = gui.add_button_group("Fly at µ", tuple(FLIGHTS), hint=hint("lecture_flights"))
        self._case = gui.add_dropdown("Cases", (_NO_CASE, *CASES), hint=hint("document_case"))
        self._begin.on_click(lambda _: self.toggle())
        flights.on_click(lambda event: self._fly(FLIGHTS[event.target.value]))
        by_hand(self._case, self._case_chosen)
        on = context.bridge.on
        on("lecture", self._pressed)
        on("story", self._step_requested)
        on("guess", self._guessed)
        on("stop", self._stop_requested)
        bind = context.keyboard.bind
        bind("lecture", self.toggle)
        bind("lecture_next", lambda: self.go(1))
        bind("lecture_previous", lambda: self.go(-1))
        for name, advance_ratio in zip(
            ("hover", "mu_015", "mu_024", "mu_037"), FLIGHTS.values(), strict=True
        ):
            bind(name, partial(self._fly, advance_ratio))

    def toggle(self) -> None:
        """Begin with the first step, or end."""
        if self.place is None:
            self.set(0)
        else:
            self.end()

    def go(self, by: int) -> None:
        """Go to another step; after the last one the lecture ends in Actuate."""
        step = 0 if self.place is None else self.place.step + by
        if step >= len(STEPS):
            before, now = self._leave(), self._screen.on_screen()
            back = now if before is None else replace(now, view=before.view, against=before.against)
            self._screen.put(replace(back, mode="actuate", look="actuator"))
        else:
            self.set(max(step, 0))

    def set(self, step: int) -> None:
        if self._before is None:
            self._before = self._screen.on_screen()
            self._guesses.clear()
        wanted = STEPS[step]
        self._stand_at(StoryPlace(step, self._guesses.get(step), wanted.control.start))
        self._stage()
        inputs, self._against = self._designs()
        view, look = (
            view_of(wanted, self._context.display.view),
            "actuator" if wanted.mode == "actuate" else "3d",
        )
        self._screen.put(ScreenState(inputs, view, self._against, wanted.mode, look, self._hand()))
        if wanted.mode == "explore":
            self._camera.aim_with(
                lambda aspect: wanted.shot.fit(self._camera.radius, aspect), eased=True
            )

    def end(self) -> None:
        """The steps go, and the visitor's own design, view and A come back."""
        before = self._leave()
        if before is not None:  # A rotor file brought meanwhile stays in the menu.
            inputs = before.inputs if before.inputs.rotor == OWN else self._kept(before.inputs)
            self._camera.aim("3d")
            self._screen.put(replace(before, inputs=inputs))

    def refresh(self) -> None:
        """Take the bands that are known by now."""
        if self.place is not None:
            self._show()

    def show(self, state: SessionState | None) -> None:
        """Say what is seen now; None: the inputs have no solution, so there is nothing to say in numbers."""
        self._state = state
        if state is None or self.place is not None:
            self._show()
        if state is None:
            return
        own = state.inputs.own_rotor
        held = (
            title for title, case in CASES.items() if replace(case, own_rotor=own) == state.inputs
        )
        self._case.value = next(held, _NO_CASE)
        if self.place is None:
            return
        if self._against is None or state.pin is None or state.pin.inputs != self._against:
            return  # The user has made another design A.
        against = self._reference_inputs(state.inputs)
        if against is not None and not same_but_flight(against, self._against):
            self._against = against
            self._context.pin(against)

    def _leave(self) -> ScreenState | None:
        """No step stands any more; the visitor's own page."""
        before, self._before = self._before, None
        self._stand_at(None)
        self._stage()
        return before

    def _stage(self) -> None:
        """No drawer while a step stands."""
        layout = self._context.layout
        layout.drawers_locked = self.place is not None
        if self.place is not None:
            layout.show_drawer("")

    def _stand_at(self, place: StoryPlace | None) -> None:
        if place is not None:  # The step that stands first, then those after it.
            steps = (*range(place.step, len(STEPS)), *range(place.step))
            self._answers.ask(tuple(map(_task, steps)), 0.0)
        self.place, self._state = place, None
        self._begin.label = "Start the lecture" if place is None else "End the lecture"
        self._show()
        self._context.wake()

    def _facts(self, step: int) -> StepFacts | None:
        """What is computed of a step; None until then."""
        facts = self._answers.answer(_task(step))
        return facts if isinstance(facts, StepFacts) else None

    def _facts_received(self) -> None:
        """A step's numbers are there: those of the one that stands also put its control where they say."""
        place = self.place
        if place is not None and self._facts(place.step) is not None:
            step = STEPS[place.step]
            if place.stop == step.control.start and self._context.inputs() == self._kept(
                step.begin()
            ):
                self._move()
        self._show()

    def _move(self) -> None:
        """The design where the control is."""
        if self.place is not None:
            inputs, self._against = self._designs()
            screen = replace(
                self._screen.on_screen(), inputs=inputs, against=self._against, hand=self._hand()
            )
            self._screen.put(screen)

    def _hand(self) -> HandSettings:
        """What the control sets of the actuator."""
        facts = None if self.place is None else self._facts(self.place.step)
        actuator = (
            None if facts is None or self.place is None else facts.stops[self.place.stop].actuator
        )
        return HandSettings() if actuator is None else HandSettings(actuator, here=True)

    def _designs(self) -> tuple[Inputs, Inputs | None]:
        """B where the control is, and A beside it."""
        place = self.place or StoryPlace(0)
        facts, step = self._facts(place.step), STEPS[place.step]
        inputs = self._kept(step.begin() if facts is None else facts.stops[place.stop].inputs)
        return inputs, self._reference_inputs(inputs)

    def _reference_inputs(self, inputs: Inputs) -> Inputs | None:
        """A of the step for these inputs."""
        if self.place is None:
            return None
        facts, step = self._facts(self.place.step), STEPS[self.place.step]
        if facts is None:
            return compared_inputs(step.against, step.inputs, inputs)
        stop = facts.stops[self.place.stop]
        return compared_inputs(stop.against, stop.inputs, inputs)

    def _show(self) -> None:
        with self._showing:
            self._send()

    def _send(self) -> None:
        place, bridge, units = (
            self.place,
            self._context.bridge,
            UNITS[self._context.display.view.units],
        )
        if place is None:
            bridge.set(lecture=None)
            return
        step, state, answer = (
            STEPS[place.step],
            self._state,
            self._answers.answer(_task(place.step)),
        )
        facts = answer if isinstance(answer, StepFacts) else None
        guessed = place.guess is not None
        values = dict[str, Figure]()
        if guessed and state is not None and facts is not None:
            own = {**facts.words(units), **words_of(facts.stops[place.stop].numbers, units)}
            values = {
                **{name: Figure(words) for name, words in own.items()},
                **self._compared(state, units, facts.stops[place.stop]),
            }
        a, b = self._side_names(state)
        none = Figure("–" if guessed else "?")
        shown = [(caption, values.get(name, none)) for name, caption in step.figures]
        bridge.set(
            steps=[step_record(step, self._facts(k), units) for k, step in enumerate(STEPS)],
            lecture=LecturePart(
                at=place.step,
                guess=place.guess,
                answer=answer_record(step, facts, units) if guessed and facts is not None else None,
                stop=place.stop,
                figures=[(caption, one.value, one.within) for caption, one in shown],
                a=a,
                b=b,
                note=self._note(),
                busy=state is None,
                problem=answer if isinstance(answer, str) else "",
            ),
        )

    def _side_names(self, state: SessionState | None) -> tuple[str, str]:
        """Names of A and B of the solution on the page, or of the sliders until there is one."""
        if self.place is None:
            return "", ""
        step = STEPS[self.place.step]
        if step.against is None:
            return "", ""
        if state is None or state.pin is None:
            b, a = self._designs()
        else:
            b, a = state.inputs, state.pin.inputs
        return side_names(step.text, self._stop(), a, b)

    def _stop(self) -> ControlStop | None:
        """The place of the control, its designs with the rotor that the user brought in the menu; None until known."""
        if self.place is None:
            return None
        facts = self._facts(self.place.step)
        if facts is None:
            return None
        stop = facts.stops[self.place.stop]
        against = None if stop.against is None else self._kept(stop.against)
        return replace(stop, inputs=self._kept(stop.inputs), against=against)

    def _note(self) -> str:
        """That the solution on the page is of another design than the step's; empty where it is not, or on its way."""
        stop, state = self._stop(), self._state
        if stop is None or state is None:
            return ""
        if state.inputs == stop.inputs or state.inputs != self._context.inputs():
            return ""
        return OTHER_DESIGN

    def _compared(self, state: SessionState, units: Units, stop: ControlStop) -> dict[str, Figure]:
        """What is seen, with the bands of the line once they are known, and what the step knows at this place."""
        on_page = state.inputs == self._kept(stop.inputs)
        now = replace(self._now(), state=state)
        sure = now.answers.get(shown_doubt(now)[0].key)
        a = state.reference
        both = None if sure is None or not a.converged else (doubt(now.analyses.of(a)), sure)
        vibration = index_band(now)
        if vibration is None and on_page:
            vibration = stop.index_band
        values = compared_quantities(state.solution, a, units, both, vibration)
        return values | _by_two_models(values, stop, units, on_page)

    def _fly(self, advance_ratio: float) -> None:
        self._context.set_inputs(replace(self._context.inputs(), advance_ratio=advance_ratio))

    def _case_chosen(self, title: str) -> None:
        if title in CASES:
            self._context.set_inputs(self._kept(CASES[title]))

    def _kept(self, inputs: Inputs) -> Inputs:
        """These inputs, with the rotor that the user brought still in the menu."""
        return replace(inputs, own_rotor=self._context.inputs().own_rotor)

    def _pressed(self, which: Any) -> None:
        if self.place is None:
            return
        match which:
            case "back":
                self.go(-1)
            case "next":
                self.go(1)
            case _:
                self.end()

    def _step_requested(self, step: Any) -> None:
        """A dot was pressed, or the steps were scrolled."""
        if self.place is not None and int(step) != self.place.step:
            self.set(min(max(int(step), 0), len(STEPS) - 1))

    def _guessed(self, answer: Any) -> None:
        place = self.place
        if place is None or place.guess is not None:
            return
        if 0 <= int(answer) <= len(STEPS[place.step].bounds):
            self._guesses[place.step] = int(answer)
            self._change(replace(place, guess=int(answer)))

    def _stop_requested(self, stop: Any) -> None:
        place = self.place
        facts = None if place is None else self._facts(place.step)
        if place is None or facts is None:
            return
        place = replace(place, stop=min(max(int(stop), 0), len(facts.stops) - 1))
        if place != self.place:
            # The sliders first, so that the place never stands beside those of another.
            self.place = place
            self._move()
            self._show()

    def _change(self, place: StoryPlace) -> None:
        """Another place within the step."""
        self.place = place
        self._show()


def _by_two_models(
    values: dict[str, Figure], stop: ControlStop, units: Units, on_page: bool
) -> dict[str, Figure]:
    """Changes without bands, and beside each what the other inflow model gives, where that design is `on_page`."""
    found = dict[str, Figure]()
    for name, other in stop.other_model.items():
        if name in values:
            within = f"with the wake {other.words(units)}" if on_page else ""
            found[name] = Figure(values[name].value, on_one_line(within))
    return found


def _task(step: int) -> Call:
    return Call(facts_at, (step,))
