"""The Actuator tab of one browser: its widgets, and what follows them."""

from dataclasses import replace
from typing import Any

import viser

from explorer.tabs.actuator import actuator_controls as plots
from explorer.tabs.actuator import actuator_controls as table
from explorer.tabs.actuator import actuator_words as words
from explorer.tabs.actuator.actuator_controls import ActuatorControls
from explorer.tabs.actuator.actuator_inputs import MOST_SEGMENTS, ActuatorInputs, Question, question_of
from explorer.tabs.actuator.cut_picture import CutScene, cut_picture, flown_twist, section_svg, voltage_shares
from explorer.tabs.actuator.study import CachedVerdicts, VerdictWorker
from explorer.tabs.actuator.sweep import SweepWorker, amplitude_plot, phase_plot, sweep_sentence, sweep_task
from explorer.tabs.context import TabContext
from explorer.workers import solver
from rotor.actuator.harmonic import PowerMap
from rotor.actuator.installation import InstalledActuator
from rotor.design.design import Design
from rotor.dynamics.structure import KNOWN_BLADE, check_blade
from rotor.files.make_design import uh60a_rotor
from rotor.trim.solution import Solution


class ActuatorPanel:
    """Widgets, cut blade and background study; everything but `inputs` happens on the session's worker."""

    def __init__(self, context: TabContext) -> None:
        self._context, client = context, context.client
        self._touched = False
        self._cut = CutScene(client.scene, context.bridge)
        self._study = VerdictWorker(CachedVerdicts(context.pool), context.wake, f"study-{client.client_id}")
        self._sweep = SweepWorker(context.pool, context.wake, f"sweep-{client.client_id}")
        self._undriven = solver.BaselineCache()
        self._sent: dict[str, str] = {}
        self._drawn: tuple[object, ...] | None = None
        self._asked: Question | None = None
        self._before: tuple[object, ...] = ()
        self._controls = ActuatorControls(context.gui, self._moved)
        self._controls.fly_buttons.on_click(self._fly_clicked)
        self.shown = self._controls.shown
        self.inputs = self._controls.inputs

    def start(self) -> None:
        self._study.start()
        self._sweep.start()

    def stop(self) -> None:
        self._study.stop()
        self._sweep.stop()

    def show(self, inputs: ActuatorInputs, design: Design, solution: Solution, psi: float) -> None:
        """Everything that follows: `design` is without the actuator's twist, `solution` with it."""
        try:
            if design.aircraft.key != KNOWN_BLADE:
                self._controls.arrange(inputs, inputs.installed(uh60a_rotor(design.preset)))
            check_blade(design.aircraft)
            installed = inputs.installed(design.rotor)
            inputs.turning(installed, design.elastic)  # Resonance of a rigid trim is reported here.
            question = question_of(inputs, design)
        except ValueError as error:
            self._cut.hide()
            self._drawn = None
            self.show_problem(str(error))
            return
        self._controls.arrange(inputs, installed)
        alone = self._undriven.solve(design) if inputs.driven else None
        self._draw(inputs, installed, design, psi, solution, alone or solution)
        change = solution.power.total - alone.power.total if alone is not None and alone.converged else None
        self._set("now", self._controls.now, words.now_panel(inputs, installed, change, solution))
        self._show_sweep(inputs, design)
        self._set("section", self._controls.section, section_svg(installed, voltage_shares(inputs, installed, psi)))
        self._controls.electrodes.show(installed.actuator, inputs.volts(installed))
        self._set("bar", self._controls.bar, words.voltage_bar(installed.actuator))
        self._asked = question
        now = (inputs, design)
        self._study.ask(question, wanted=self._touched, stirred=now != self._before)
        self._before = now
        self._judge(inputs, installed, question, design.rotor.blade.root_cutout)

    def _show_sweep(self, inputs: ActuatorInputs, design: Design) -> None:
        task = sweep_task(inputs, design)
        answer = self._sweep.ask(task)
        if not inputs.per_rev:
            return
        self._set("swept", self._controls.swept, words.sweep_panel(sweep_sentence(answer, inputs, design)))
        drawn = answer if isinstance(answer, PowerMap) else None
        for chart, plot in (
            (self._controls.over_phase, phase_plot),
            (self._controls.over_amplitude, amplitude_plot),
        ):
            chart.show(plot(drawn, inputs, chart.y_range if drawn is not None else None))

    def show_problem(self, problem: str) -> None:
        """There is no such design: the sentence in place of the verdict, all else as it was."""
        self._set("verdict", self._controls.verdict, words.problem_panel(problem))

    def reset(self) -> None:
        """Nothing driven."""
        self._controls.reset()

    def _judge(self, inputs: ActuatorInputs, installed: InstalledActuator, question: Question, root: float) -> None:
        findings = self._study.findings
        verdict = findings.verdict if findings.question == question else None
        tell, places = self._set, self._controls
        tell("verdict", places.verdict, words.verdict_panel(findings, question))
        tell("numbers", places.numbers, words.fit_panel(inputs, installed, verdict))
        tell("segments", places.segments, words.segments_panel(installed, inputs.share, verdict))
        tell("limits", places.limits, words.limits_panel(verdict))
        tell("table", places.table, table.table_panel(findings, question))
        places.chart.show(plots.reach_plot(inputs, installed, verdict, root, places.chart.y_range))

    def _draw(
        self,
        inputs: ActuatorInputs,
        installed: InstalledActuator,
        design: Design,
        psi: float,
        solution: Solution,
        alone: Solution,
    ) -> None:
        if not inputs.shown:
            self._cut.hide()
            self._drawn = None
            return
        turning = inputs.per_rev > 0 or design.elastic
        frame = (inputs, solution.design, psi if turning else 0.0)
        if frame == self._drawn:
            return
        self._drawn = frame
        picture = cut_picture(inputs, installed, design, psi, flown_twist(solution, alone, psi))
        with self._context.client.atomic():
            self._cut.show(picture)
        self._context.client.flush()

    def _set(self, name: str, handle: viser.GuiHtmlHandle, content: str) -> None:
        if self._sent.get(name) != content:
            self._sent[name] = content
            handle.content = content

    def _fly_clicked(self, event: viser.GuiEvent[Any]) -> None:
        self._touched = True
        which = event.target.options.index(event.target.value) - 1
        if which < 0:
            self._controls.drive((0.0,) * MOST_SEGMENTS)
            return
        findings = self._study.findings
        verdict = findings.verdict
        if verdict is None or findings.question != self._asked:
            self._context.wake()
            self._context.client.add_notification(
                "No verdict yet", "Its voltages are being computed.", auto_close_seconds=4
            )
            return
        self._controls.drive_as(verdict.installed, verdict.optimum.swings, verdict.voltages, which)
        mu = verdict.baseline.pair.advance_ratios[which]
        self._context.set_inputs(replace(self._context.inputs(), advance_ratio=mu))

    def _moved(self, by_hand: bool) -> None:
        self._touched = self._touched or by_hand
        self._context.wake()
