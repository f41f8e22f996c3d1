"""The Actuator tab of one browser: its widgets, and what follows them."""

from collections.abc import Callable
from typing import Any

import viser

from explorer.overlay.bridge import Bridge
from explorer.tabs.actuator import controls as plots
from explorer.tabs.actuator import controls as table
from explorer.tabs.actuator import readout
from explorer.tabs.actuator.controls import ActuatorControls
from explorer.tabs.actuator.picture import CutScene, cut_picture, flown_twist, section_svg, voltage_shares
from explorer.tabs.actuator.state import MOST_SEGMENTS, ActuatorInputs, Question, question_of
from explorer.tabs.actuator.study import CachedVerdicts, VerdictWorker
from explorer.tabs.actuator.sweep import SweepWorker, amplitude_plot, phase_plot, sweep_sentence, sweep_task
from explorer.workers import solver
from explorer.workers.pool import Pool
from rotor.actuator.harmonic import PowerMap
from rotor.actuator.installation import InstalledActuator
from rotor.design.design import Design
from rotor.dynamics.structure import KNOWN_BLADE, check_blade
from rotor.files.make_design import uh60a_rotor
from rotor.trim.solution import Solution


class ActuatorPanel:
    """Widgets, cut blade and background study; everything but `inputs` happens on the session's worker."""

    def __init__(
        self,
        client: viser.ClientHandle,
        bridge: Bridge,
        pool: Pool,
        changed: Callable[[], None],
        fly: Callable[[float], None],
    ) -> None:
        """`changed`: something moved. `fly`: set the page's advance ratio."""
        self._changed = changed
        self._fly = fly
        self._client = client
        self._touched = False
        self._cut = CutScene(client.scene, bridge)
        self._study = VerdictWorker(CachedVerdicts(pool), changed)
        self._sweep = SweepWorker(pool, changed)
        self._rest = solver.BaselineCache()
        self._told: dict[str, str] = {}
        self._drawn: tuple[object, ...] | None = None
        self._asked: Question | None = None
        self._before: tuple[object, ...] = ()
        self._controls = ActuatorControls(client.gui, self._moved)
        self._controls.fly_buttons.on_click(self._fly_clicked)
        self.shown = self._controls.shown
        self.inputs = self._controls.inputs

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
            self.show_failure(str(error))
            return
        self._controls.arrange(inputs, installed)
        rest = self._rest.solve(design) if inputs.driven else None
        self._draw(inputs, installed, design, psi, solution, rest or solution)
        change = solution.power.total - rest.power.total if rest is not None and rest.converged else None
        self._tell("now", self._controls.now, readout.now_panel(inputs, installed, change, solution))
        self._show_sweep(inputs, design)
        self._tell("section", self._controls.section, section_svg(installed, voltage_shares(inputs, installed, psi)))
        self._controls.electrodes.show(installed.actuator, inputs.volts(installed))
        self._tell("bar", self._controls.bar, readout.voltage_bar(installed.actuator))
        self._asked = question
        now = (inputs, design)
        self._study.ask(question, wanted=self._touched, stirred=now != self._before)
        self._before = now
        self._judge(inputs, installed, question, design.rotor.blade.root_cutout)

    def _show_sweep(self, inputs: ActuatorInputs, design: Design) -> None:
        task = sweep_task(inputs, design)
        found = self._sweep.ask(task)
        if not inputs.per_rev:
            return
        self._tell("swept", self._controls.swept, readout.sweep_panel(sweep_sentence(found, inputs, design)))
        drawn = found if isinstance(found, PowerMap) else None
        for chart, plot in (
            (self._controls.over_phase, phase_plot),
            (self._controls.over_amplitude, amplitude_plot),
        ):
            chart.show(plot(drawn, inputs, chart.y_range if drawn is not None else None))

    def show_failure(self, problem: str) -> None:
        """There is no such design: the sentence in place of the verdict, all else as it was."""
        self._tell("verdict", self._controls.verdict, readout.problem_panel(problem))

    def rest(self) -> None:
        """Let go of the blade."""
        self._controls.rest()

    def leave_cut(self) -> None:
        """Back to the rotor."""
        if self.shown.value:
            self.shown.value = False

    def _judge(self, inputs: ActuatorInputs, installed: InstalledActuator, question: Question, root: float) -> None:
        findings = self._study.findings
        verdict = findings.verdict if findings.question == question else None
        tell, places = self._tell, self._controls
        tell("verdict", places.verdict, readout.verdict_panel(findings, question))
        tell("numbers", places.numbers, readout.fit_panel(inputs, installed, verdict))
        tell("segments", places.segments, readout.segments_panel(installed, inputs.share, verdict))
        tell("limits", places.limits, readout.limits_panel(verdict))
        tell("table", places.table, table.table_panel(findings, question))
        places.chart.show(plots.reach_plot(inputs, installed, verdict, root, places.chart.y_range))

    def _draw(
        self,
        inputs: ActuatorInputs,
        installed: InstalledActuator,
        design: Design,
        psi: float,
        solution: Solution,
        rest: Solution,
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
        picture = cut_picture(inputs, installed, design, psi, flown_twist(solution, rest, psi))
        with self._client.atomic():
            self._cut.show(picture)
        self._client.flush()

    def _tell(self, name: str, handle: viser.GuiHtmlHandle, content: str) -> None:
        if self._told.get(name) != content:
            self._told[name] = content
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
            self._changed()
            self._client.add_notification("No verdict yet", "Its voltages are being computed.", auto_close_seconds=4)
            return
        self._controls.take(verdict.installed, verdict.optimum.swings, verdict.voltages, which)
        self._fly(verdict.baseline.pair.advance_ratios[which])

    def _moved(self, by_hand: bool) -> None:
        self._touched = self._touched or by_hand
        self._changed()
