"""The Actuator tab of one browser: its widgets, and what follows them."""

from collections.abc import Callable
from typing import Any

import viser
from viser import uplot

from explorer import actuator_plots, actuator_readout, solver
from explorer.actuator_picture import cut_picture, voltage_shares
from explorer.actuator_scene import CutScene
from explorer.actuator_section import section_svg
from explorer.actuator_state import (
    BLADES,
    CONCEPTS,
    HARMONICS,
    MOST_SEGMENTS,
    ActuatorInputs,
    Question,
    drive_of,
    question_of,
)
from explorer.actuator_study import Study
from explorer.charts import Chart
from explorer.colours import BASELINE, NOW, THIS
from rotor.actuator.catalogue import ExtensionTwist, PiezoPly, TorqueTube, find_actuator
from rotor.actuator.fitted import Fitted
from rotor.concepts import find_concept
from rotor.design import Design
from rotor.solution import Solution

_FLY = ("At rest", "At first µ", "At second µ")
_USED = "#2f9e44"


class ActuatorPanel:
    """Widgets, cut blade and background study; everything but `inputs` happens on the session's worker."""

    def __init__(self, client: viser.ClientHandle, changed: Callable[[], None], fly: Callable[[float], None]) -> None:
        """`changed`: something moved. `fly`: set the page's advance ratio."""
        self._changed = changed
        self._fly = fly
        self._client = client
        self._touched = False
        self._cut = CutScene(client.scene)
        self._study = Study(changed, f"study-{client.client_id}")
        self._rest = solver.Baseline()
        self._told: dict[str, str] = {}
        self._drawn: tuple[object, ...] | None = None
        self._asked: Question | None = None
        self._titles = actuator_readout.actuator_titles()
        self._concepts = {name: find_concept(name).title for name in CONCEPTS}
        self._build(client.gui)

    def _build(self, gui: viser.GuiApi) -> None:
        start = ActuatorInputs()
        watched = self._watched
        gui.add_html(actuator_readout.SHEET)
        self.shown = watched(
            gui.add_checkbox("Show blade cut", False, hint="Shows one blade, opened, in place of the rotor.")
        )
        self._magnified = watched(
            gui.add_slider("Movement ×", 1.0, 20.0, 1.0, start.magnified, hint="Exaggerates it in the cut blade only.")
        )
        self._now = gui.add_html("")
        self._drives = [
            watched(gui.add_slider("Voltage [%]", -100.0, 100.0, 1.0, 0.0, hint=_DRIVE_HINT))
            for _ in range(MOST_SEGMENTS)
        ]
        self._bar = gui.add_html("")
        self.fly_buttons = gui.add_button_group(
            "Set", _FLY, hint="Voltages of the verdict at its two flight conditions, and the advance ratio with them."
        )
        self.fly_buttons.on_click(self._fly_clicked)
        self._verdict = gui.add_html("")
        self._numbers = gui.add_html("")
        with gui.add_folder("Actuator and placement"):
            self._actuator = watched(gui.add_dropdown("Actuator", tuple(self._titles.values())))
            self._plies = watched(gui.add_slider("Plies a side", 1, 8, 1, start.plies, hint="Tubes, for the tube."))
            self._span = watched(
                gui.add_multi_slider("Span [R]", 0.14, 1.0, 0.01, start.span, min_range=0.05, hint="Active, from–to.")
            )
            self._chord = watched(
                gui.add_multi_slider(
                    "Chord [c]", 0.0, 0.95, 0.01, start.chord, min_range=0.05,
                    hint="Active, from–to. The de-ice mat heats the first 0.12 c.",
                )
            )  # fmt: skip
            self._blade = watched(gui.add_dropdown("Blade type", tuple(BLADES)))
            self._stiffness = watched(
                gui.add_slider("GJ of new ×", 0.2, 1.5, 0.05, start.stiffness, hint="Over the flown blade's.")
            )
            self._crossed = watched(
                gui.add_checkbox("Fibres crossed", False, hint="Laid at −45°: positive voltage turns the tip down.")
            )
            self._counted = watched(
                gui.add_slider(
                    "Derating [%]", 40.0, 100.0, 1.0, start.counted,
                    hint="Share of the nominal twist to count on. A tested blade showed about 62 % of its model.",
                )
            )  # fmt: skip
        with gui.add_folder("Question"):
            self._concept = watched(gui.add_dropdown("Concept", tuple(self._concepts.values())))
            self._pair = watched(
                gui.add_multi_slider(
                    "µ from, to", 0.0, 0.4, 0.01, start.advance_ratios, min_range=0.02, hint="Two flight conditions."
                )
            )
        key = (("attainable", BASELINE), ("required", NOW), ("used", _USED), ("now", THIS))
        self._chart = Chart(
            gui,
            "Δtwist [°]",
            key,
            "radius r/R",
            (
                _line("attainable", BASELINE, 1.5),
                _line("as counted", BASELINE, 1.5, (5, 3)),
                _line("required", NOW),
                _line("used", _USED, 1.5),
                _line("now", THIS),
            ),
            actuator_plots.blank(),
            (0.1, 1.02),
        )
        self._segments = gui.add_html("")
        self._section = gui.add_html("")
        self._limits = gui.add_html("")
        with gui.add_folder("All actuators on this blade"):
            self._table = gui.add_html("")
        with gui.add_folder("Twist that follows the azimuth"):
            self._per_rev = watched(
                gui.add_dropdown("Harmonic", tuple(HARMONICS), hint="Of rotor speed; rests in hover.")
            )
            self._amplitude = watched(
                gui.add_slider("Amplitude [%]", 0.0, 100.0, 1.0, start.amplitude, hint="Of half the voltage range.")
            )
            self._phase = watched(
                gui.add_slider("Phase [°]", 0.0, 360.0, 5.0, start.phase, hint="The tip is most nose-up at phase/n.")
            )

    def start(self) -> None:
        self._study.start()

    def stop(self) -> None:
        self._study.stop()

    def inputs(self) -> ActuatorInputs:
        """What the widgets mean now."""
        return ActuatorInputs(
            actuator=_key(self._titles, self._actuator.value),
            plies=int(self._plies.value),
            span=_ends(self._span.value),
            chord=_ends(self._chord.value),
            blade=BLADES[self._blade.value],
            stiffness=float(self._stiffness.value),
            counted=float(self._counted.value),
            concept=_key(self._concepts, self._concept.value),
            advance_ratios=_ends(self._pair.value),
            drives=tuple(float(handle.value) for handle in self._drives),
            crossed=bool(self._crossed.value),
            per_rev=HARMONICS[self._per_rev.value],
            amplitude=float(self._amplitude.value),
            phase=float(self._phase.value),
            shown=bool(self.shown.value),
            magnified=float(self._magnified.value),
        )

    def show(self, inputs: ActuatorInputs, design: Design, solution: Solution, psi: float) -> None:
        """Everything that follows: `design` is without the actuator's twist, `solution` with it."""
        try:
            fitted = inputs.fitted(design.rotor)
            question = question_of(inputs, design) if self._touched else None
        except ValueError as error:
            self.lose(str(error))
            return
        self._arrange(inputs, fitted)
        self._draw(inputs, fitted, design, psi)
        rest = self._rest.solve(design) if inputs.driven else None
        change = solution.power.total - rest.power.total if rest is not None and rest.converged else None
        self._tell("now", self._now, actuator_readout.now_panel(inputs, fitted, change))
        self._tell("section", self._section, section_svg(fitted, voltage_shares(inputs, fitted, psi)))
        self._tell("bar", self._bar, actuator_readout.voltage_bar(fitted.actuator))
        self._asked = question
        if question is not None:
            self._study.ask(question)
        self._judge(inputs, fitted, question, design.rotor.blade.root_cutout)

    def lose(self, problem: str) -> None:
        """There is no such design: the sentence in place of the verdict, all else as it was."""
        self._tell("verdict", self._verdict, actuator_readout.verdict_panel(self._study.findings, None, problem))

    def rest(self) -> None:
        """Let go of the blade."""
        self._per_rev.value = next(iter(HARMONICS))
        self._drive((0.0,) * MOST_SEGMENTS)

    def leave_cut(self) -> None:
        """Back to the rotor."""
        if self.shown.value:
            self.shown.value = False

    def _judge(self, inputs: ActuatorInputs, fitted: Fitted, question: Question | None, root: float) -> None:
        findings = self._study.findings
        verdict = findings.verdict if question is not None and findings.question == question else None
        tell = self._tell
        tell("verdict", self._verdict, actuator_readout.verdict_panel(findings, question))
        tell("numbers", self._numbers, actuator_readout.fit_panel(inputs, fitted, verdict))
        tell("segments", self._segments, actuator_readout.segments_panel(fitted, inputs.share, verdict))
        tell("limits", self._limits, actuator_readout.limits_panel(verdict))
        tell("table", self._table, actuator_readout.table_panel(findings, question))
        self._chart.show(actuator_plots.reach_plot(inputs, fitted, verdict, root, self._chart.y_range))

    def _draw(self, inputs: ActuatorInputs, fitted: Fitted, design: Design, psi: float) -> None:
        if not inputs.shown:
            self._cut.hide()
            self._drawn = None
            return
        frame = (inputs, design.rotor, design.twist, psi if inputs.per_rev else 0.0)
        if frame == self._drawn:
            return
        self._drawn = frame
        picture = cut_picture(inputs, fitted, design, psi)
        with self._client.atomic():
            self._cut.show(picture)
        self._client.flush()

    def _arrange(self, inputs: ActuatorInputs, fitted: Fitted) -> None:
        """Which widgets there are, and what they are called."""
        count = len(fitted.shapes)
        word = "Voltage" if isinstance(fitted.actuator, PiezoPly) else "Drive"
        for k, handle in enumerate(self._drives):
            handle.visible = k < count
            handle.label = f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]"
        self._plies.label = "Tubes" if isinstance(fitted.actuator, TorqueTube) else "Plies a side"
        passive = isinstance(fitted.actuator, ExtensionTwist)
        for handle in (self._plies, self._span):
            handle.visible = not passive
        self._chord.visible = self._crossed.visible = isinstance(fitted.actuator, PiezoPly)
        self._magnified.visible = inputs.shown
        self._span.label = "Span {:.2f}–{:.2f}".format(*inputs.span)
        self._chord.label = "Chord {:.2f}–{:.2f}".format(*inputs.chord)
        self._pair.label = "µ {:.2f} – {:.2f}".format(*inputs.advance_ratios)
        self._stiffness.visible = inputs.blade == "new"
        self._amplitude.visible = self._phase.visible = inputs.per_rev > 0

    def _tell(self, name: str, handle: viser.GuiHtmlHandle, content: str) -> None:
        if self._told.get(name) != content:
            self._told[name] = content
            handle.content = content

    def _fly_clicked(self, event: viser.GuiEvent[Any]) -> None:
        self._touched = True
        which = _FLY.index(event.target.value) - 1
        if which < 0:
            self._drive((0.0,) * MOST_SEGMENTS)
            return
        findings = self._study.findings
        verdict = findings.verdict
        if verdict is None or findings.question != self._asked:
            self._changed()
            self._client.add_notification("No verdict yet", "Its voltages are being computed.", auto_close_seconds=4)
            return
        self._set(verdict.fitted, verdict.reached.swings, verdict.voltages, which)
        self._fly(verdict.baseline.pair.advance_ratios[which])

    def _set(
        self,
        fitted: Fitted,
        swings: tuple[tuple[float, ...], ...],
        voltages: tuple[tuple[float, float], ...],
        which: int,
    ) -> None:
        """Sliders as the verdict has them at one of its conditions."""
        actuator = find_actuator(fitted.actuator.id)
        if isinstance(actuator, PiezoPly):
            unit = actuator.voltage_swing
            made = [pair[which] / unit for pair in voltages]
            wanted = [swing[which] for swing in zip(*swings, strict=True)]
            # Fibres laid the other way where the verdict's voltages oppose its twists.
            opposed = fitted.host.kind == "retrofit" and sum(a * b for a, b in zip(made, wanted, strict=True)) < 0.0
            self._crossed.value = opposed
        else:
            made = list(swings[which])
        drives = [drive_of(actuator, swing) for swing in made]
        self._drive((*drives, *(0.0,) * (MOST_SEGMENTS - len(drives))))

    def _drive(self, drives: tuple[float, ...]) -> None:
        for handle, drive in zip(self._drives, drives, strict=True):
            handle.value = round(drive)
        self._changed()

    def _watched(self, handle: Any) -> Any:
        def moved(event: viser.GuiEvent[Any]) -> None:
            self._touched = self._touched or event.client is not None
            self._changed()

        handle.on_update(moved)
        return handle


_DRIVE_HINT = "Per cent of the positive, or of the smaller negative, end of the voltage range."


def _line(label: str, colour: str, width: float = 2.0, dash: tuple[float, ...] | None = None) -> uplot.Series:
    series = uplot.Series(label=label, stroke=colour, width=width, points=uplot.Series_Points(show=False), pxAlign=0)
    if dash is not None:
        series["dash"] = dash
    return series


def _ends(values: tuple[float, ...]) -> tuple[float, float]:
    low, high = sorted(round(float(value), 4) for value in values)
    return low, high


def _key(titles: dict[str, str], title: str) -> str:
    return next(key for key, value in titles.items() if value == title)
