"""What Actuate has of one browser: its widgets, what the hand has set there, and the lifted blade."""

import threading
from dataclasses import replace
from typing import Any

from explorer.model.actuator_inputs import (
    ActuatorInputs,
    HandSettings,
    Outcome,
    hours_text,
    read_against,
    read_hours,
    verdict_inputs_of,
    verdict_tasks,
)
from explorer.picture.lifted_picture import flown_twist, lifted_picture
from explorer.sharing.share import AGAINST, HOURS, Address
from explorer.views.flight import BY_HAND, after_flight
from explorer.views.page_state import SetAddress, SetHand
from explorer.views.pay import SUPPOSED, read_place
from explorer.widgets.actuator.actuator_controls import ActuatorControls
from explorer.widgets.actuator.lifted_scene import LiftedScene
from explorer.widgets.context import TabContext
from explorer.workers import solver
from explorer.workers.background import all_known
from rotor import Design, Solution
from rotor.actuator.verdict import Against
from rotor.dynamics.structure import KNOWN_BLADE, check_blade
from rotor.optimisation.mission import ASSUMED_HOURS


class ActuatorPanel:
    """What is shown of it are panels of `explorer/views`."""

    def __init__(self, context: TabContext, address: Address) -> None:
        """`address` may hold a supposed actuator, the hours of the mission, and what changes count from."""
        self._context, self._address = context, address
        self.blade = LiftedScene(context.client, context.bridge)
        context.leaving.append(self.blade.stop)
        place = address.read(SUPPOSED, read_place, None, "Link: supposed actuator not used")
        hours = address.read(HOURS, read_hours, ASSUMED_HOURS, "Link: mission not used")
        against: Against = address.read(
            AGAINST, read_against, ActuatorInputs.against, "Link: comparison not used"
        )
        self._hand, self._lock = (
            HandSettings(on_stage=place is not None, place=place),
            threading.Lock(),
        )
        self.lifted = False
        """Whether the blade is wanted outside the rotor."""
        self._opened = False
        """Whether the blade ever was out of the rotor."""
        self._radius = 1.0
        self._undriven = solver.BaselineCache()
        self._shown: tuple[ActuatorInputs, Design, Solution, float] | None = None
        self._drawn: tuple[object, ...] | None = None
        self._pays = False
        """Whether the supposed actuator pays: its blade lights green."""
        self.controls = ActuatorControls(
            context.gui, hours, against, context.wake, lambda: self._set(**BY_HAND)
        )
        self.texts = {**self.controls.texts, "actuator.pays": self._light}
        self.inputs = self.controls.inputs

    def hand(self) -> HandSettings:
        return replace(
            self._hand, actuator=self.inputs(), on_board=self._context.layout.mode == "actuate"
        )

    def perform(self, effect: SetHand | SetAddress) -> None:
        """Do what a press said."""
        if isinstance(effect, SetAddress):
            self._address[effect.name] = effect.value
            return
        if effect.changes:
            self._set(**effect.changes)
        if effect.actuator:
            self.controls.place(effect.actuator)

    def write_address(self) -> None:
        """Put the hours of the mission and what changes count from into the address, where they are not as usual."""
        inputs = self.inputs()
        hours = inputs.hours
        self._address[HOURS] = None if hours == ASSUMED_HOURS else hours_text(hours)
        usual = inputs.against == ActuatorInputs.against
        self._address[AGAINST] = None if usual else inputs.against

    def _set(self, **changes: Any) -> None:
        with self._lock:  # Widgets and presses have threads of their own.
            self._hand = replace(self._hand, **changes)
        self._context.wake()

    def put(self, hand: HandSettings) -> None:
        if hand != self.hand():
            self._set(**vars(hand))
            self.controls.place(vars(hand.actuator))

    @property
    def fits(self) -> bool:
        """Whether this rotor's blade is known well enough to carry an actuator."""
        return self._context.inputs().aircraft.key == KNOWN_BLADE

    def outcome(self) -> Outcome:
        """The verdict on the actuator and the design of the sliders, or why there is none, worked out where it is not
        known; empty while nobody has opened Actuate."""
        if not (self._opened and self.fits):
            return ""
        try:
            question = verdict_inputs_of(self.inputs(), self._context.inputs().design())
        except ValueError as error:
            return str(error)
        task = verdict_tasks(question)[question.actuator]
        return all_known().get(task) or task.run()

    def lift(self, out: bool) -> None:
        """Lift one blade out towards the viewer, or let it fly back."""
        self.lifted, self._opened = out, self._opened or out
        if out:
            self._radius = (
                self._context.inputs().aircraft.rotor_for(self._context.inputs().preset).radius
            )
            self.blade.hold(self._radius)
        else:
            self._release()
        self._context.wake()

    def leave(self) -> None:
        """Another mode is open: nothing flies by schedule, and nothing has stopped."""
        if self._hand.stopped or self._hand.flown is not None:
            self.perform(after_flight(self._hand))

    def draw(self, inputs: ActuatorInputs, design: Design, solution: Solution, psi: float) -> None:
        """The lifted blade as it flies: `design` is without the actuator's twist, `solution` with it."""
        self._shown = inputs, design, solution, psi
        if not self.lifted:
            return
        try:
            check_blade(design.aircraft)
            installed = inputs.installed(design.rotor)
        except ValueError:
            self._release()
            return
        frame = (inputs, solution.design, psi if design.elastic else 0.0, self._pays)
        if frame == self._drawn:
            return
        self._drawn = frame
        # The same mass and stiffness, at rest.
        still = replace(solution.design, twist=solution.design.jig)
        alone = self._undriven.solve(still) if inputs.driven and design.elastic else solution
        picture = lifted_picture(
            inputs, installed, design, flown_twist(solution, alone, psi), pays=self._pays
        )
        with self._context.client.atomic():
            self.blade.hold(self._radius)
            self.blade.show(picture)
        self._context.client.flush()

    def _light(self, pays: bool) -> None:
        self._pays = pays
        if self._shown is not None:
            self.draw(*self._shown)

    def _release(self) -> None:
        self.blade.release(self._radius)
        self._drawn = None
