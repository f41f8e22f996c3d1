"""The Actuator tab of one browser: its widgets, and what follows them."""

import math
from dataclasses import replace
from typing import Any

from explorer.model.actuator_inputs import (
    AGAINST,
    MOST_SEGMENTS,
    ActuatorInputs,
    Outcome,
    Question,
    flight_of,
    question_of,
    verdict_tasks,
)
from explorer.sharing.share import Address
from explorer.tabs.actuator import actuator_words as words
from explorer.tabs.actuator.actuator_controls import ActuatorControls, reach_chart, table_panel
from explorer.tabs.actuator.flight_bar import FlightBar
from explorer.tabs.actuator.lifted_picture import LiftedScene, flown_twist, lifted_picture
from explorer.tabs.actuator.per_rev import Fitted
from explorer.tabs.actuator.what_would_pay import WhatWouldPay
from explorer.tabs.background import PoolAnswers
from explorer.tabs.context import TabContext
from explorer.tabs.form import Form
from explorer.workers import solver
from explorer.workers.call import Call
from rotor import Design, Solution
from rotor.actuator import InstalledActuator, Verdict, actuator_stability
from rotor.dynamics.structure import KNOWN_BLADE, check_blade
from rotor.files.make_design import uh60a_rotor

Flown = tuple[Solution, Solution]
_FULL = 100.0
"""The whole voltage on its slider [%]."""
_STILL = 0.4
"""How long a question must stand before it is worked on [s], so that a dragged slider starts nothing."""
_IDLE = 2.5
"""How long the page must have been still before work is begun that nobody asked for [s]."""


class ActuatorPanel:
    """Widgets, cut blade and background study; everything but `inputs` happens on the session's worker."""

    def __init__(self, context: TabContext, address: Address, problems: list[tuple[str, str]]) -> None:
        """`address` may hold a supposed actuator; `problems` as in `WhatWouldPay`."""
        self._context = context
        self._blade = LiftedScene(context.client, context.bridge)
        self.lifted = False
        """Whether the blade is wanted outside the rotor."""
        self._opened = False
        """Whether it ever was."""
        self._radius = 1.0
        # Verdicts come behind searches, maps and schedules.
        self._verdicts = PoolAnswers(context.pool, 5, context.wake)
        self._others = PoolAnswers(context.pool, 6, context.wake)
        """Verdicts on the actuators that are not chosen."""
        self._verdict: Verdict | None = None
        """The last one that was shown."""
        self._undriven = solver.BaselineCache()
        self._drawn: tuple[object, ...] | None = None
        self._before: tuple[object, ...] = ()
        self._flights = PoolAnswers(context.pool, 4, context.wake)
        self._modes = PoolAnswers(context.pool, 7, context.wake)
        """Modes of the blade with the actuator and without, worked out behind all else."""
        self.fitted: Fitted | None = None
        """The actuator on the blade for the dial of n/rev; None where it cannot be built."""
        self._controls = ActuatorControls(context.gui, context.wake, lambda: self._flight_bar.leave_to_hand())
        self._flight_bar = FlightBar(context, self._controls)
        context.bridge.on("against", lambda _: self._controls.other_baseline())
        context.bridge.on("pull", self._pull)
        self._pulled = (0.0,) * MOST_SEGMENTS, 0.0
        """Drives [%] when the lifted blade was taken, and what pulling its trailing edge up by a full drive adds."""
        self.pay = WhatWouldPay(context, address, problems)
        self.inputs = self._controls.inputs
        self.top = self._controls.now.order

    def stop(self) -> None:
        """The browser has left."""
        for answers in (self._verdicts, self._others, self._flights, self._modes):
            answers.stop()
        self._blade.stop()
        self.pay.stop()

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
            question = question_of(self.inputs(), self._context.inputs().design())
        except ValueError as error:
            return str(error)
        task = verdict_tasks(question)[question.actuator]
        return self._answer(task) or task.run()

    def _answer(self, task: Call) -> Any:
        return self._verdicts.answer(task) or self._others.answer(task)

    def _ask(self, answers: PoolAnswers, tasks: tuple[Call, ...], delay: float, moved: bool = True) -> None:
        """Have these answered where they are seen: a driven actuator is in the frame of other modes too."""
        answers.ask(tasks if self._context.layout.mode == "actuate" else (), delay, moved)

    def rest(self) -> None:
        """Another mode is open: what only this one shows is not worked out, so that frames have the processor, and what
        was said of a design says nothing of the next."""
        for answers in (self._verdicts, self._others, self._flights, self._modes):
            answers.ask((), 0.0)
        self.fitted = None
        self.pay.rest()

    def lift(self, out: bool) -> None:
        """Lift one blade out towards the viewer, or let it fly back."""
        self._opened = self._opened or out
        self.lifted = out
        if out:
            self._radius = self._context.inputs().aircraft.rotor_for(self._context.inputs().preset).radius
            self._blade.hold(self._radius)
        else:
            self._blade.release(self._radius)
            self._drawn = None
            self._flight_bar.hide()
        self._context.wake()

    def show(self, inputs: ActuatorInputs, design: Design, solution: Solution, psi: float) -> None:
        """Everything that follows: `design` is without the actuator's twist, `solution` with it."""
        try:
            if design.aircraft.key != KNOWN_BLADE:
                self._controls.arrange(inputs, inputs.installed(uh60a_rotor(design.preset)))
            check_blade(design.aircraft)
            installed = inputs.installed(design.rotor)
            question = question_of(inputs, design)
        except ValueError as error:
            self._blade.release(self._radius)
            self._drawn = self.fitted = None
            self.show_problem(str(error))
            self.pay.refresh(None)
            return
        self._controls.arrange(inputs, installed)
        alone = self._undriven.solve(design) if inputs.driven else None
        self._controls.now.content = words.now_panel(inputs, installed, solution)
        self._controls.section.content = words.section_svg(installed, inputs.drive_shares(installed))
        self._controls.bar.content = words.voltage_bar(installed.actuator)
        tasks, now = tuple(verdict_tasks(question).values()), (inputs, design)
        self._ask(self._verdicts, tasks[:1], _STILL, now != self._before)
        self._ask(self._others, tasks[1:], _IDLE, now != self._before)
        self._before = now
        verdict = self._show_verdict(inputs, installed, question, design)
        answers = map(self._answer, tasks)
        self.pay.refresh(question.pair, [answer for answer in answers if isinstance(answer, Verdict)])
        self._draw(inputs, installed, design, psi, (solution, alone or solution))
        fixed = None if verdict is None else verdict.baseline.fixed_twist
        twist = design.twist if inputs.against == "as-built" else fixed
        against = f"the {AGAINST[inputs.against][0].lower()}{AGAINST[inputs.against][1:]}"
        self.fitted = Fitted(installed, inputs.volts(installed), twist, against)

    def _pull(self, share: float | None) -> None:
        """The lifted blade was taken (None), or its trailing edge is pulled up by this share of the full drive."""
        inputs, fitted = self.inputs(), self.fitted
        if self._context.held or fitted is None:
            return
        if share is None:
            full = replace(inputs, drives=(_FULL,) * MOST_SEGMENTS)
            nose_up = full.tip(fitted.installed, self._context.inputs().design())
            self._pulled = inputs.drives, -math.copysign(_FULL, nose_up)
            return
        start, whole = self._pulled
        self._controls.drive(tuple(min(max(drive + share * whole, -_FULL), _FULL) for drive in start), by_hand=True)

    def show_problem(self, problem: str) -> None:
        """There is no such design: the sentence in place of the verdict, all else as it was."""
        self._controls.verdict.content = words.problem_panel(problem)

    def reset(self) -> None:
        """Nothing driven."""
        self._controls.undrive()

    def _show_verdict(
        self, inputs: ActuatorInputs, installed: InstalledActuator, question: Question, design: Design
    ) -> Verdict | None:
        outcomes = {id: self._answer(task) for id, task in verdict_tasks(question).items()}
        outcome = outcomes[question.actuator]
        verdict = outcome if isinstance(outcome, Verdict) else None
        places = self._controls
        places.verdict.content = words.problem_panel(outcome)
        places.details.content = words.details_panel(verdict)
        places.numbers.content = words.fit_panel(installed, verdict)
        places.limits.content = words.limits_panel(verdict)
        modes = None if verdict is None else Call(actuator_stability, (installed, design))
        self._ask(self._modes, () if modes is None else (modes,), _IDLE)
        places.modes.content = words.modes_panel(self._modes.answer(modes) if modes is not None else None)
        places.table.content = table_panel(outcomes, question)
        task = None if verdict is None else Call(flight_of, (verdict,))
        self._ask(self._flights, () if task is None else (task,), 0.0)
        if self.lifted:
            tip = math.degrees(inputs.tip(installed, design))
            answer = self._flights.answer(task)
            self._flight_bar.show(self._context.inputs(), design, installed, outcome, answer, tip)
        root = design.rotor.blade.root_cutout
        places.chart.show(reach_chart(inputs, installed, verdict, root, places.chart.y_range))
        self._verdict = verdict or self._verdict
        return verdict

    def _draw(
        self, inputs: ActuatorInputs, installed: InstalledActuator, design: Design, psi: float, flown: Flown
    ) -> None:
        """`flown`: with the actuator and without."""
        if not self.lifted:
            self._blade.release(self._radius)
            self._drawn = None
            return
        frame = (inputs, flown[0].design, psi if design.elastic else 0.0, self.pay.pays)
        if frame == self._drawn:
            return
        self._drawn = frame
        picture = lifted_picture(inputs, installed, design, flown_twist(*flown, psi), pays=self.pay.pays)
        with self._context.client.atomic():
            self._blade.hold(self._radius)
            self._blade.show(picture)
        self._context.client.flush()

    @property
    def form(self) -> Form:
        """The sliders and menus of the actuator."""
        return self._controls.form
