"""The widgets of Actuate, the table of actuators and the chart of required against attainable twist."""

import math
from collections.abc import Callable
from html import escape
from typing import Any

import numpy as np
import viser

from explorer.charts.plots import Plot, Range, held_range
from explorer.model.units import number
from explorer.tabs.actuator import actuator_words as words
from explorer.tabs.actuator.actuator_inputs import (
    BLADES,
    CONCEPTS,
    HARMONICS,
    MOST_SEGMENTS,
    ActuatorInputs,
    Question,
    drive_of,
)
from explorer.tabs.actuator.electrodes import ElectrodesPanel
from explorer.tabs.actuator.study import Findings, Outcome
from explorer.tabs.actuator.sweep import amplitude_plot, phase_plot
from explorer.tabs.chart_strip import Chart, line, points
from explorer.tabs.controls import key_of
from explorer.text.glossary import hint
from explorer.theme.colours import BASELINE, LIMIT, NOW, THIS
from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly, TorqueTube, actuators, find_actuator
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.pictures import twist_comparison
from rotor.actuator.verdict import Verdict, verdict_sentence
from rotor.optimisation.concepts import find_concept


def table_panel(findings: Findings, question: Question) -> str:
    """All actuators on this blade for this question, one row each."""
    asked = findings.question
    known = dict(findings.others)
    # Rows are about the same question whatever actuator is chosen now.
    if asked is None or (asked.pair, asked.concept, asked.placement, asked.host, asked.share) != (
        question.pair, question.concept, question.placement, question.host, question.share,
    ):  # fmt: skip
        known = {}
    rows = "".join(_row(id, known.get(id), id == question.actuator) for id in actuators())
    titles = ("Actuator", "avail.<br>°", "derated<br>°", "kg", "net<br>kW", "verdict")
    head = f"<tr>{''.join(f'<th>{title}</th>' for title in titles)}</tr>"
    first, second = question.pair.advance_ratios
    return (
        f'<div class="rx" data-explorer="actuator-table"><table class="rxa-table">{head}{rows}</table>'
        f'<div class="rx-dim rx-small">µ {first:g} ↔ {second:g}, {escape(question.host.label)}, half the time each. '
        "▲: some data not verified. Hover over a verdict for the full text.</div></div>"
    )


def _row(id: str, outcome: Outcome | None, chosen: bool) -> str:
    actuator = find_actuator(id)
    care = ' <span title="some data not verified" class="rxa-bad">▲</span>' if actuator.provenance.recalled else ""
    name = f'<td title="{escape(actuator.name)}">{escape(short_name(id))}{care}</td>'
    look = ' class="rxa-chosen"' if chosen else ""
    if outcome is None:
        return f'<tr{look}>{name}<td class="rx-num rx-dim" colspan="5">computing…</td></tr>'
    if isinstance(outcome, str):
        why = f'<td class="rx-num rxa-bad" colspan="5" title="{escape(outcome)}">cannot be built</td>'
        return f"<tr{look}>{name}{why}</tr>"
    words, kind = short_verdict(outcome)
    cells = (
        number(math.degrees(outcome.attainable), 1),
        number(math.degrees(outcome.attainable_derated), 1),
        number(outcome.installed.masses.aircraft),
        number(1e-3 * outcome.net_saving, 1, sign=True),
    )
    numbers = "".join(f'<td class="rx-num">{cell}</td>' for cell in cells)
    why = escape(verdict_sentence(outcome))
    return f'<tr{look}>{name}{numbers}<td class="rx-num {kind}" title="{why}">{words}</td></tr>'


def short_verdict(verdict: Verdict) -> tuple[str, str]:
    """A few words, and the class that colours them."""
    if verdict.pays:
        return "net benefit", "rx-less"
    if not verdict.feasible:
        return "too weak", "rxa-bad"
    if verdict.net_saving <= 0.0:
        return "net cost", "rxa-bad"
    return "cannot be built", "rxa-bad"


def short_name(id: str) -> str:
    return id.replace("_", " ")


def actuator_titles() -> dict[str, str]:
    """Of the menu, by id."""
    return {id: f"{short_name(id)}: {_kind(actuator)}" for id, actuator in actuators().items()}


def _kind(actuator: Actuator) -> str:
    if isinstance(actuator, PiezoPly):
        return "d33 fibres" if actuator.electrodes == "interdigitated" else "d31 sheet"
    return "heated tube" if isinstance(actuator, TorqueTube) else "passive"


_STATIONS = 61


def reach_plot(
    inputs: ActuatorInputs, installed: InstalledActuator, verdict: Verdict | None, root: float, previous: Range | None
) -> Plot:
    """Series: attainable, attainable as counted, required, used by the best twist within reach, now [°].

    Changes from the cut-out outwards; attainable is drawn on the side that is asked for.
    """
    r = np.linspace(root, 1.0, _STATIONS)
    limit = installed.limit(r) - installed.limit(root)
    now = inputs.change(installed, r) - inputs.change(installed, root)
    none = np.full(_STATIONS, np.nan)
    required, used = none, none
    if verdict is not None:
        curves = twist_comparison(verdict, _STATIONS)
        required, used = curves.required, curves.attained
        if required[np.argmax(np.abs(required))] < 0.0:
            limit = -limit
    series = tuple(np.degrees(values) for values in (limit, inputs.share * limit, required, used, now))
    seen = np.concatenate([values[np.isfinite(values)] for values in series])
    return Plot((r, *series), held_range(previous, min(0.0, float(seen.min())), max(0.2, float(seen.max()))))


def blank() -> Plot:
    """An empty chart, on a range that no answer has."""
    none = np.full(2, np.nan)
    return Plot((np.array([0.13, 1.0]), *(none,) * 5), (-1e-3, 1e-3))


def fly_titles(advance_ratios: tuple[float, float]) -> tuple[str, ...]:
    """The buttons that fly: without voltage, and at each of two conditions."""
    return ("At rest", *("Hover" if mu == 0.0 else f"Cruise µ {mu:.2f}" for mu in advance_ratios))


_USED = "#2f9e44"


class ActuatorControls:
    """Widgets and the charts and texts between them, from top to bottom."""

    def __init__(self, gui: viser.GuiApi, moved: Callable[[bool], None]) -> None:
        """`moved`: something changed, by a hand or not."""
        self._moved = moved
        self._titles = actuator_titles()
        self._concepts = {name: find_concept(name).title for name in CONCEPTS}
        start = ActuatorInputs()
        watched = self._watched
        self.verdict = gui.add_html("")
        self.shown = watched(gui.add_checkbox("Show blade cut", False, hint=hint("cut")))
        self._magnified = watched(
            gui.add_slider("Deformation ×", 1.0, 20.0, 1.0, start.magnified, hint=hint("magnified"))
        )
        self.now = gui.add_html("")
        self._drives = [
            watched(gui.add_slider("Voltage [%]", -100.0, 100.0, 1.0, 0.0, hint=hint("voltage")))
            for _ in range(MOST_SEGMENTS)
        ]
        self.bar = gui.add_html("")
        self.fly_buttons = gui.add_button_group("Fly at", fly_titles(start.advance_ratios), hint=hint("fly"))
        self.numbers = gui.add_html("")
        with gui.add_folder("Actuator and placement"):
            self._actuator = watched(gui.add_dropdown("Actuator", tuple(self._titles.values()), hint=hint("actuator")))
            self._plies = watched(gui.add_slider("Plies per side", 1, 8, 1, start.plies, hint=hint("plies")))
            self._span = watched(
                gui.add_multi_slider("Span [R]", 0.14, 1.0, 0.01, start.span, min_range=0.05, hint=hint("span"))
            )
            self._chord = watched(
                gui.add_multi_slider(
                    "Chord [c]", 0.0, 0.95, 0.01, start.chord, min_range=0.05,
                    hint=hint("chord_range"),
                )
            )  # fmt: skip
            self._blade = watched(gui.add_dropdown("Blade type", tuple(BLADES), hint=hint("blade_type")))
            self._stiffness = watched(
                gui.add_slider("New blade GJ ×", 0.2, 1.5, 0.05, start.stiffness, hint=hint("stiffness"))
            )
            self._crossed = watched(gui.add_checkbox("Fibres at −45°", False, hint=hint("crossed")))
            self._counted = watched(
                gui.add_slider(
                    "Derating [%]", 40.0, 100.0, 1.0, start.counted,
                    hint=hint("derating"),
                )
            )  # fmt: skip
        with gui.add_folder("Mission conditions"):
            self._concept = watched(
                gui.add_dropdown("Concept", tuple(self._concepts.values()), hint=hint("actuator_concept"))
            )
            self._pair = watched(
                gui.add_multi_slider(
                    "µ from, to", 0.0, 0.4, 0.01, start.advance_ratios, min_range=0.02, hint=hint("pair")
                )
            )
        key = (("attainable", BASELINE), ("required", NOW), ("used", _USED), ("now", THIS))
        self.chart = Chart(
            gui,
            "Δtwist [°]",
            key,
            "radius r/R",
            (
                line("attainable", BASELINE, 1.5),
                line("as counted", BASELINE, 1.5, (5, 3)),
                line("required", NOW),
                line("used", _USED, 1.5),
                line("now", THIS),
            ),
            blank(),
            (0.1, 1.02),
        )
        self.segments = gui.add_html("")
        self.section = gui.add_html("")
        self.limits = gui.add_html("")
        with gui.add_folder("All actuators on this blade"):
            self.table = gui.add_html("")
        self.electrodes = ElectrodesPanel(gui)
        with gui.add_folder("Harmonic active twist"):
            gui.add_html(words.unmeasured())
            self._per_rev = watched(gui.add_dropdown("Harmonic", tuple(HARMONICS), hint=hint("harmonic")))
            self._amplitude = watched(
                gui.add_slider("Amplitude [%]", 0.0, 100.0, 1.0, start.amplitude, hint=hint("amplitude"))
            )
            self._phase = watched(gui.add_slider("Phase [°]", 0.0, 360.0, 5.0, start.phase, hint=hint("phase")))
            self.swept = gui.add_html("")
            key = (("full", BASELINE, True), ("as set", NOW), ("now", THIS))
            self.over_phase = Chart(
                gui,
                "ΔkW over phase [°]",
                key,
                "phase [°]",
                (line("full amplitude", BASELINE, 1.5, (5, 3)), line("this amplitude", NOW), points("now", THIS, 8.0)),
                phase_plot(None, start, None),
                (0.0, 360.0),
            )
            key = (("best", BASELINE, True), ("as set", NOW), ("limit", LIMIT))
            self.over_amplitude = Chart(
                gui,
                "ΔkW over amplitude [%]",
                key,
                "amplitude [%]",
                (
                    line("best phase", BASELINE, 1.5, (5, 3)),
                    line("this phase", NOW),
                    points("limit", LIMIT, 9.0),
                    points("now", THIS, 8.0),
                ),
                amplitude_plot(None, start, None),
                (0.0, 100.0),
            )

    def inputs(self) -> ActuatorInputs:
        """What the widgets mean now."""
        return ActuatorInputs(
            actuator=key_of(self._titles, self._actuator.value),
            plies=int(self._plies.value),
            span=_ends(self._span.value),
            chord=_ends(self._chord.value),
            blade=BLADES[self._blade.value],
            stiffness=float(self._stiffness.value),
            counted=float(self._counted.value),
            concept=key_of(self._concepts, self._concept.value),
            advance_ratios=_ends(self._pair.value),
            drives=tuple(float(handle.value) for handle in self._drives),
            crossed=bool(self._crossed.value),
            per_rev=HARMONICS[self._per_rev.value],
            amplitude=float(self._amplitude.value),
            phase=float(self._phase.value),
            shown=bool(self.shown.value),
            magnified=float(self._magnified.value),
        )

    def arrange(self, inputs: ActuatorInputs, installed: InstalledActuator) -> None:
        """Which widgets there are, and what they are called."""
        count = len(installed.shapes)
        word = "Voltage" if isinstance(installed.actuator, PiezoPly) else "Drive"
        for k, handle in enumerate(self._drives):
            handle.visible = k < count
            handle.label = f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]"
        self._plies.label = "Tubes" if isinstance(installed.actuator, TorqueTube) else "Plies per side"
        passive = isinstance(installed.actuator, ExtensionTwist)
        for handle in (self._plies, self._span):
            handle.visible = not passive
        self._chord.visible = self._crossed.visible = isinstance(installed.actuator, PiezoPly)
        self._magnified.visible = inputs.shown
        self._span.label = "Span {:.2f}–{:.2f}".format(*inputs.span)
        self._chord.label = "Chord {:.2f}–{:.2f}".format(*inputs.chord)
        self._pair.label = "µ {:.2f} – {:.2f}".format(*inputs.advance_ratios)
        if self.fly_buttons.options != (titles := fly_titles(inputs.advance_ratios)):
            self.fly_buttons.options = titles
        self._stiffness.visible = inputs.blade == "new"
        turning = inputs.per_rev > 0
        self._amplitude.visible = self._phase.visible = self.swept.visible = turning
        for chart in (self.over_phase, self.over_amplitude):
            chart.set_visible(turning)

    def reset(self) -> None:
        """Nothing driven."""
        self._per_rev.value = next(iter(HARMONICS))
        self.drive((0.0,) * MOST_SEGMENTS)

    def drive_as(
        self,
        installed: InstalledActuator,
        swings: tuple[tuple[float, ...], ...],
        voltages: tuple[tuple[float, float], ...],
        which: int,
    ) -> None:
        """Sliders as the verdict has them at one of its conditions."""
        actuator = find_actuator(installed.actuator.id)
        if isinstance(actuator, PiezoPly):
            unit = actuator.voltage_swing
            made = [pair[which] / unit for pair in voltages]
            wanted = [swing[which] for swing in zip(*swings, strict=True)]
            # Fibres laid the other way where the verdict's voltages oppose its twists.
            opposed = installed.host.kind == "retrofit" and sum(a * b for a, b in zip(made, wanted, strict=True)) < 0.0
            self._crossed.value = opposed
        else:
            made = list(swings[which])
        drives = [drive_of(actuator, swing) for swing in made]
        self.drive((*drives, *(0.0,) * (MOST_SEGMENTS - len(drives))))

    def drive(self, drives: tuple[float, ...]) -> None:
        """Move the voltage sliders."""
        for handle, drive in zip(self._drives, drives, strict=True):
            handle.value = round(drive)
        self._moved(False)

    def _watched(self, handle: Any) -> Any:
        handle.on_update(lambda event: self._moved(event.client is not None))
        return handle


def _ends(values: tuple[float, ...]) -> tuple[float, float]:
    low, high = sorted(round(float(value), 4) for value in values)
    return low, high
