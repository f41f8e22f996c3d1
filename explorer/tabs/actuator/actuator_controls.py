"""The widgets of Actuate, the table of actuators and the chart of required against attainable twist."""

import math
from collections.abc import Callable, Mapping

import numpy as np
import viser

from explorer.charts.plots import Range, held_range
from explorer.colours import BASELINE, NOW, THIS
from explorer.model.actuator_inputs import (
    AGAINST,
    BLADES,
    CONCEPTS,
    MOST_SEGMENTS,
    ActuatorInputs,
    Outcome,
    Question,
    drive_of,
)
from explorer.model.units import number
from explorer.tabs.form import Form
from explorer.tabs.live_charts import PanelChart
from rotor.actuator import (
    Actuator,
    ExtensionTwist,
    InstalledActuator,
    PiezoPly,
    TorqueTube,
    Verdict,
    actuators,
    find_actuator,
    verdict_sentence,
)
from rotor.actuator.pictures import twist_comparison
from rotor.chart import Axis, Chart, Line
from rotor.design.quantity import Slider
from rotor.markup import Content, Markup, tag
from rotor.optimisation import find_concept


def table_panel(outcomes: Mapping[str, Outcome], question: Question) -> Markup:
    """All actuators on this blade for this question, one row each; those in `outcomes` have an answer."""
    rows = [_row(id, outcomes.get(id), id == question.actuator) for id in actuators()]
    titles = ("Actuator", ("range", tag("br"), "°"), ("kg in", tag("br"), "all"), ("needs", tag("br"), "kW"), "verdict")
    head = tag("tr", [tag("th", title) for title in titles])
    first, second = question.pair.advance_ratios
    note = (
        f"µ {first:g} ↔ {second:g}, {question.host.label}, half the time each. Range: twist from end to end. "
        "▲: some data not verified. Hover over a verdict for the full text."
    )
    table = tag("table.rxa-table", head, rows)
    return tag("div.rx", table, tag("div.rx-dim.rx-small", note), data_explorer="actuator-table")


def _row(id: str, outcome: Outcome | None, chosen: bool) -> Markup:
    actuator = find_actuator(id)
    care = " ", tag("span.rxa-bad", "▲", title="some data not verified")
    cells: Content = tag("td.rx-num.rx-dim", "computing…", colspan=4)
    if isinstance(outcome, str):
        cells = tag("td.rx-num.rxa-bad", "cannot be built", colspan=4, title=outcome)
    elif outcome is not None:
        words, kind = short_verdict(outcome)
        numbers = (
            number(math.degrees(outcome.attainable), 1),
            number(outcome.installed.masses.aircraft),
            number(-1e-3 * outcome.net_saving, 1, sign=True),
        )
        verdict = tag("td.rx-num", words, class_=kind, title=verdict_sentence(outcome))
        cells = [*(tag("td.rx-num", text) for text in numbers), verdict]
    name = tag("td", short_name(id), care if actuator.provenance.recalled else None, title=actuator.name)
    return tag("tr", name, cells, class_="rxa-chosen" if chosen else None)


def short_verdict(verdict: Verdict) -> tuple[str, str]:
    """A few words, and the class that colours them."""
    if verdict.pays:
        return "pays", "rx-less"
    if not verdict.feasible:
        return "too weak", "rxa-bad"
    if verdict.net_saving <= 0.0:
        return "costs more", "rxa-bad"
    return "cannot be built", "rxa-bad"


def short_name(id: str) -> str:
    return id.replace("_", " ")


def actuator_titles() -> dict[str, str]:
    """Titles of the menu of actuators, by id."""
    return {id: f"{short_name(id)}: {_kind(actuator)}" for id, actuator in actuators().items()}


def _kind(actuator: Actuator) -> str:
    if isinstance(actuator, PiezoPly):
        return "d33 fibres" if actuator.electrodes == "interdigitated" else "d31 sheet"
    return "heated tube" if isinstance(actuator, TorqueTube) else "passive"


_STATIONS = 61


def reach_chart(
    inputs: ActuatorInputs, installed: InstalledActuator, verdict: Verdict | None, root: float, previous: Range | None
) -> Chart:
    """Twist that can be attained, that is required, that the best twist within reach uses, and now [°].

    Changes from the cut-out outwards; attainable is drawn on the side that is asked for.
    """
    r = np.linspace(root, 1.0, _STATIONS)
    limit = installed.limit(r) - installed.limit(root)
    now = inputs.change(installed, r) - inputs.change(installed, root)
    lines = list[Line]()
    if verdict is not None:
        required, used = twist_comparison(verdict, _STATIONS)
        if required[np.argmax(np.abs(required))] < 0.0:
            limit = -limit
        lines = [Line("required", r, np.degrees(required), NOW), Line("used", r, np.degrees(used), _USED, width=1.5)]
    attainable = Line("attainable", r, np.degrees(limit), BASELINE, width=1.5)
    lines = [attainable, *lines, Line("now", r, np.degrees(now), THIS)]
    seen = [value for line in lines for value in line.y if math.isfinite(value)]
    y_axis = Axis("°", held_range(previous, min(0.0, *seen), max(0.2, *seen)))
    return Chart("Δtwist", Axis("r/R", (0.1, 1.02)), y_axis, tuple(lines))


_USED = "#2f9e44"
_DRIVES = tuple(f"drive {k}" for k in range(MOST_SEGMENTS))


class ActuatorControls:
    """Widgets and the charts and texts between them, from top to bottom."""

    def __init__(self, gui: viser.GuiApi, moved: Callable[[], None], driven: Callable[[], None]) -> None:
        """`moved`: something changed. `driven`: a hand moved a voltage."""
        self._moved, self._driven = moved, driven
        start = ActuatorInputs()
        form = self.form = Form(gui, self._heard)
        self.verdict = gui.add_html("")
        form.menu("actuator", "Actuator", actuator_titles())
        form.slider("plies", Slider("Plies per side", 1, 8, 1), start.plies)
        form.span("span", "Span [R]", (0.14, 1.0), start.span, 0.05)
        for name in _DRIVES:
            form.slider(name, Slider("Voltage [%]", -100.0, 100.0, 1.0), 0.0, entry="voltage")
        self.bar = gui.add_html("")
        self.now = gui.add_html("")
        with gui.add_folder("Placement and blade", expand_by_default=False):
            form.span("chord", "Chord [c]", (0.0, 0.95), start.chord, 0.05, "chord_range")
            form.menu("blade", "Blade type", BLADES, entry="blade_type")
            form.slider("stiffness", Slider("New blade GJ ×", 0.2, 1.5, 0.05), start.stiffness)
            form.box("crossed", "Fibres at −45°", start.crossed)
        with gui.add_folder("Mission conditions", expand_by_default=False):
            titles = {name: find_concept(name).title for name in CONCEPTS}
            form.menu("concept", "Concept", titles, entry="actuator_concept")
            form.span("advance_ratios", "µ from, to", (0.0, 0.4), start.advance_ratios, 0.02, "pair")
            form.menu("against", "Savings against", AGAINST)
        with gui.add_folder("Reach and limits", expand_by_default=False):
            self.details = gui.add_html("")
            self.numbers = gui.add_html("")
            self.chart = PanelChart(gui)
            self.section = gui.add_html("")
            self.limits = gui.add_html("")
        with gui.add_folder("Modes and damping", expand_by_default=False):
            self.modes = gui.add_html("")
        with gui.add_folder("All actuators on this blade", expand_by_default=False):
            self.table = gui.add_html("")

    def inputs(self) -> ActuatorInputs:
        """What the widgets mean now."""
        values = self.form.values()
        drives = tuple(float(values.pop(name)) for name in _DRIVES)
        return ActuatorInputs(**values, drives=drives)

    def arrange(self, inputs: ActuatorInputs, installed: InstalledActuator) -> None:
        """Which widgets there are, and what they are called."""
        actuator, count, form = installed.actuator, len(installed.shapes), self.form
        ply, passive = isinstance(actuator, PiezoPly), isinstance(actuator, ExtensionTwist)
        word = "Voltage" if ply else "Drive"
        for k, name in enumerate(_DRIVES):
            form.call(name, f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]")
        form.call("plies", "Tubes" if isinstance(actuator, TorqueTube) else "Plies per side")
        form.show({name: k < count for k, name in enumerate(_DRIVES)})
        form.show({"plies": not passive, "span": not passive, "chord": ply, "crossed": ply})
        form.show({"stiffness": inputs.blade == "new"})
        form.call("span", "Span {:.2f}–{:.2f}".format(*inputs.span))
        form.call("chord", "Chord {:.2f}–{:.2f}".format(*inputs.chord))
        form.call("advance_ratios", "µ {:.2f} – {:.2f}".format(*inputs.advance_ratios))

    def undrive(self) -> None:
        """No voltage."""
        self.drive((0.0,) * MOST_SEGMENTS)

    def other_baseline(self) -> None:
        """Count savings from the other blade."""
        now = self.form["against"]
        self.form.place("against", next(other for other in AGAINST if other != now))

    def drive_through(
        self,
        installed: InstalledActuator,
        swings: tuple[tuple[float, ...], ...],
        voltages: tuple[tuple[float, ...], ...],
        x: float,
    ) -> None:
        """Sliders as a flight has them, `x` legs from its first: swings and voltages by leg and segment.

        Fibres are laid the other way where the voltages of the flight oppose its twists.
        """
        actuator = find_actuator(installed.actuator.id)
        shares = np.asarray(swings, dtype=float)
        if isinstance(actuator, PiezoPly):
            wanted, shares = shares, np.asarray(voltages, dtype=float) / actuator.voltage_swing
            opposed = installed.host.kind == "retrofit" and float(np.sum(wanted * shares)) < 0.0
            self.form.place("crossed", opposed)
        legs = np.arange(len(shares))
        drives = [drive_of(actuator, float(np.interp(x, legs, share))) for share in shares.T]
        self.drive((*drives, *(0.0,) * (MOST_SEGMENTS - len(drives))))

    def drive(self, drives: tuple[float, ...], by_hand: bool = False) -> None:
        """Move the voltage sliders."""
        for name, drive in zip(_DRIVES, drives, strict=True):
            self.form.place(name, round(drive))
        self._heard(_DRIVES[0], by_hand)

    def _heard(self, name: str, by_hand: bool) -> None:
        if by_hand and name in _DRIVES:
            self._driven()
        self._moved()
