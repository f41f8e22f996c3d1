"""The widgets of Actuate, the table of actuators and the chart of required against attainable twist."""

import math
from collections.abc import Callable, Mapping
from html import escape
from typing import Any

import numpy as np
import viser

from explorer.charts.plots import Range, held_range
from explorer.colours import BASELINE, NOW, THIS
from explorer.model.units import number
from explorer.tabs.actuator.actuator_inputs import (
    AGAINST,
    BLADES,
    CONCEPTS,
    MOST_SEGMENTS,
    ActuatorInputs,
    Question,
    drive_of,
)
from explorer.tabs.actuator.actuator_tasks import Outcome
from explorer.tabs.live_charts import PanelChart
from explorer.text.glossary import hint
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
from rotor.optimisation import find_concept


def table_panel(outcomes: Mapping[str, Outcome], question: Question) -> str:
    """All actuators on this blade for this question, one row each; those in `outcomes` have an answer."""
    rows = "".join(_row(id, outcomes.get(id), id == question.actuator) for id in actuators())
    titles = ("Actuator", "avail.<br>°", "kg", "net<br>kW", "verdict")
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
    cells = '<td class="rx-num rx-dim" colspan="4">computing…</td>'
    if isinstance(outcome, str):
        cells = f'<td class="rx-num rxa-bad" colspan="4" title="{escape(outcome)}">cannot be built</td>'
    elif outcome is not None:
        words, kind = short_verdict(outcome)
        numbers = (
            number(math.degrees(outcome.attainable), 1),
            number(outcome.installed.masses.aircraft),
            number(1e-3 * outcome.net_saving, 1, sign=True),
        )
        why = escape(verdict_sentence(outcome))
        cells = "".join(f'<td class="rx-num">{one}</td>' for one in numbers)
        cells += f'<td class="rx-num {kind}" title="{why}">{words}</td>'
    look = ' class="rxa-chosen"' if chosen else ""
    return f'<tr{look}><td title="{escape(actuator.name)}">{escape(short_name(id))}{care}</td>{cells}</tr>'


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
    seen = [value for one in lines for value in one.y if math.isfinite(value)]
    y_axis = Axis("°", held_range(previous, min(0.0, *seen), max(0.2, *seen)))
    return Chart("Δtwist", Axis("r/R", (0.1, 1.02)), y_axis, tuple(lines))


_USED = "#2f9e44"


class ActuatorControls:
    """Widgets and the charts and texts between them, from top to bottom."""

    def __init__(self, gui: viser.GuiApi, moved: Callable[[bool], None], driven: Callable[[], None]) -> None:
        """`moved`: something changed, by a hand or not. `driven`: a hand moved a voltage."""
        self._gui, self._moved, self._driven = gui, moved, driven
        self._handles: dict[str, Any] = {}
        """By field of `ActuatorInputs`."""
        self._menus: dict[str, dict[str, Any]] = {}
        """What each title of a menu means."""
        self.verdict = gui.add_html("")
        self._menu("actuator", "Actuator", {title: id for id, title in actuator_titles().items()})
        self._slider("plies", "Plies per side", 1, 8, 1)
        self._range("span", "Span [R]", 0.14, 1.0, 0.05)
        self._drives = [
            self._watched(gui.add_slider("Voltage [%]", -100.0, 100.0, 1.0, 0.0, hint=hint("voltage")), self._driven)
            for _ in range(MOST_SEGMENTS)
        ]
        self.bar = gui.add_html("")
        self.now = gui.add_html("")
        with gui.add_folder("Placement and blade", expand_by_default=False):
            self._range("chord", "Chord [c]", 0.0, 0.95, 0.05, "chord_range")
            self._menu("blade", "Blade type", BLADES, "blade_type")
            self._slider("stiffness", "New blade GJ ×", 0.2, 1.5, 0.05)
            self._handles["crossed"] = self._watched(gui.add_checkbox("Fibres at −45°", False, hint=hint("crossed")))
        with gui.add_folder("Mission conditions", expand_by_default=False):
            titles = {find_concept(name).title: name for name in CONCEPTS}
            self._menu("concept", "Concept", titles, "actuator_concept")
            self._range("advance_ratios", "µ from, to", 0.0, 0.4, 0.02, "pair")
            self._menu("against", "Savings against", AGAINST)
        with gui.add_folder("Reach and limits", expand_by_default=False):
            self.numbers = gui.add_html("")
            self.chart = PanelChart(gui)
            self.segments = gui.add_html("")
            self.section = gui.add_html("")
            self.limits = gui.add_html("")
        with gui.add_folder("All actuators on this blade", expand_by_default=False):
            self.table = gui.add_html("")

    def inputs(self) -> ActuatorInputs:
        """What the widgets mean now."""
        values = {name: _read(handle.value) for name, handle in self._handles.items()}
        values |= {name: menu[self._handles[name].value] for name, menu in self._menus.items()}
        drives = tuple(float(handle.value) for handle in self._drives)
        return ActuatorInputs(**values, drives=drives)

    def arrange(self, inputs: ActuatorInputs, installed: InstalledActuator) -> None:
        """Which widgets there are, and what they are called."""
        count = len(installed.shapes)
        word = "Voltage" if isinstance(installed.actuator, PiezoPly) else "Drive"
        for k, handle in enumerate(self._drives):
            handle.visible = k < count
            handle.label = f"{word} {k + 1} [%]" if count > 1 else f"{word} [%]"
        self._handles["plies"].label = "Tubes" if isinstance(installed.actuator, TorqueTube) else "Plies per side"
        passive = isinstance(installed.actuator, ExtensionTwist)
        ply = isinstance(installed.actuator, PiezoPly)
        seen = {
            "plies": not passive, "span": not passive, "chord": ply, "crossed": ply,
            "stiffness": inputs.blade == "new",
        }  # fmt: skip
        for name, visible in seen.items():
            self._handles[name].visible = visible
        self._handles["span"].label = "Span {:.2f}–{:.2f}".format(*inputs.span)
        self._handles["chord"].label = "Chord {:.2f}–{:.2f}".format(*inputs.chord)
        self._handles["advance_ratios"].label = "µ {:.2f} – {:.2f}".format(*inputs.advance_ratios)

    def undrive(self) -> None:
        """No voltage."""
        self.drive((0.0,) * MOST_SEGMENTS)

    def other_baseline(self) -> None:
        """Count savings from the other blade."""
        now = self._handles["against"]
        now.value = next(title for title in AGAINST if title != now.value)

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
            self._handles["crossed"].value = opposed
        legs = np.arange(len(shares))
        drives = [drive_of(actuator, float(np.interp(x, legs, share))) for share in shares.T]
        self.drive((*drives, *(0.0,) * (MOST_SEGMENTS - len(drives))))

    def drive(self, drives: tuple[float, ...]) -> None:
        """Move the voltage sliders."""
        for handle, drive in zip(self._drives, drives, strict=True):
            handle.value = round(drive)
        self._moved(False)

    def _slider(self, name: str, label: str, low: float, high: float, step: float, entry: str = "") -> None:
        """`entry`: of the glossary, where it has another name."""
        start = getattr(ActuatorInputs(), name)
        handle = self._gui.add_slider(label, low, high, step, start, hint=hint(entry or name))
        self._handles[name] = self._watched(handle)

    def _range(self, name: str, label: str, low: float, high: float, least: float, entry: str = "") -> None:
        start = getattr(ActuatorInputs(), name)
        handle = self._gui.add_multi_slider(label, low, high, 0.01, start, min_range=least, hint=hint(entry or name))
        self._handles[name] = self._watched(handle)

    def _menu(self, name: str, label: str, meanings: Mapping[str, Any], entry: str = "") -> None:
        self._menus[name] = dict(meanings)
        handle = self._gui.add_dropdown(label, tuple(meanings), hint=hint(entry or name))
        self._handles[name] = self._watched(handle)

    def _watched(self, handle: Any, by_hand: Callable[[], None] = lambda: None) -> Any:
        """`by_hand`: called on top where the user moves it."""

        def heard(event: Any) -> None:
            if event.client is not None:
                by_hand()
            self._moved(event.client is not None)

        handle.on_update(heard)
        return handle


def _read(value: Any) -> Any:
    """Both ends of a range in their order; anything else as it is."""
    return tuple(sorted(round(float(end), 4) for end in value)) if isinstance(value, tuple) else value
