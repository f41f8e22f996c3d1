"""Pitch and twist at n/rev in the Actuate mode: the dial of twist with the front of power and vibration.

The page foresees while a hand drags the dial (`explorer/web/dial.js`, from the numbers of `dial_matrix`); the design
follows, so that the same drag is trimmed. The front stands beside it with what was published.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.tabs.actuator.actuator_tasks import Call, PoolAnswers
from explorer.tabs.context import TabContext
from explorer.text.design_words import harmonic_words
from rotor import Design, t_matrix, vibration_front
from rotor.actuator import Programme, programmes
from rotor.aero.bending import can_bend
from rotor.design import Harmonic
from rotor.optimisation.vibration import with_harmonics
from rotor.trim import why_no_hub_loads
from rotor.trim.hub_loads import index_gains

HARMONICS = (2, 3, 4, 5)
"""Of the dial: those at which a blade of four passes vibration on to the hub, and 2/rev, which saves power."""
REACH = 2.0
"""Radius of the dial [°]; active twist rotors have reached 1.1 to 1.4°."""
_FRONT_HARMONICS, _FRONT_REACH, _FRONT_POINTS = (2, 3), 1.0, 7
_LEAST = 0.02
"""An amplitude below this [°] is none."""
_STILL = 0.4
"""How long the design must stand before it is worked on [s]."""
_DIGITS = 6
_UNMEASURED = "Not validated: we found no measured power benefit of active twist. Published savings are computed."


def dial_matrix(design: Design) -> dict[str, Any]:
    """What `dial.js` needs, per degree: the response of power and hub loads to n/rev twist.

    The shape of the design's active twist counts, its harmonics do not. ValueError or RuntimeError with a sentence.
    """
    matrix, degree = t_matrix(design, HARMONICS), math.radians(1.0)
    return {
        "base": _rounded(matrix.base),
        "slopes": _rounded(degree * matrix.slopes),
        "second": _rounded(degree**2 * matrix.second),
        "gains": _rounded(100.0 * index_gains(design)),
        "power": float(matrix.base[-1]),
        "index": float(matrix.response([]).index),
    }


@dataclass(frozen=True)
class FrontDot:
    """One compromise of the front, trimmed."""

    twist: tuple[Harmonic, ...]
    power: float
    """Change from the blade without n/rev twist [%]."""
    index: float
    """The same of the vibration index [%]."""
    over_wakes: tuple[float, float] | None
    """Least and largest change of the index over wakes [%]."""


def front_dots(design: Design) -> tuple[FrontDot, ...]:
    """The front from least power to least vibration; ValueError or RuntimeError with a sentence."""
    front = vibration_front(design, harmonics=_FRONT_HARMONICS, reach_deg=_FRONT_REACH, points=_FRONT_POINTS)
    dots = list[FrontDot]()
    for point, (power, index) in zip(front.points, front.changes, strict=True):
        twist = point.design.active_twist
        dots.append(FrontDot(() if twist is None else twist.harmonics, power, index, point.over_wakes))
    return tuple(dots)


class TwistDial:
    """One session's."""

    def __init__(self, context: TabContext, grabbed: Callable[[bool], None]) -> None:
        """Its place is where the context stands. `grabbed`: the dot was taken (True) or let go."""
        self._context, self._grabbed, gui = context, grabbed, context.gui
        self._answers = PoolAnswers(context.pool, 3, context.wake)
        self._dots: tuple[FrontDot, ...] = ()
        with gui.add_folder("Pitch and twist at n/rev"):
            self._set = gui.add_html("")
            self._vibration = gui.add_html("", visible=False)
            gui.add_html('<div class="rxd" data-dial data-explorer="dial"></div>')
            gui.add_html(f'<div class="rx rx-dim rx-small" data-explorer="unmeasured">{_UNMEASURED}</div>')
            gui.add_html(f'<div class="rx rx-small" data-explorer="programmes">{programme_table()}</div>')
        self.refresh(context.inputs())
        bridge = context.bridge
        bridge.set(dial_published=published())
        bridge.on("dial", self._act)
        bridge.on("dial_front", self._take_dot)
        bridge.on("dial_bend", lambda _: self._bend())

    def refresh(self, inputs: Inputs) -> None:
        """Say what these inputs have set, by file, link or measured condition too."""
        words = harmonic_words(inputs.twist_per_rev, inputs.pitch_per_rev) or "none set"
        shaped = " The twist has the shape of its design file." if inputs.active_shape else ""
        self._set.content = (
            f'<div class="rx rx-dim rx-small" data-explorer="per-rev">{words[:1].upper()}{words[1:]}.{shaped}</div>'
        )

    def show(self, state: SessionState, vibration: str, index: float | None) -> None:
        """Follow a converged state; `vibration` and its `index` [%]: empty and None, blades do not bend."""
        content = f'<div class="rx rx-small" data-explorer="per-rev-vibration">{escape(vibration)}</div>'
        self._vibration.visible, self._vibration.content = bool(vibration), content if vibration else ""
        if self._context.layout.mode != "actuate":
            self._answers.ask((), _STILL)
            return
        solution, inputs = state.solution, state.inputs
        words, action = self._why_not(solution.design)
        answer, front = None, None
        if not words:
            shaped = with_harmonics(replace(solution.design, pitch_per_rev=()), (Harmonic(3, math.radians(1.0)),))
            tasks = Call(dial_matrix, (shaped,)), Call(front_dots, (shaped,))
            self._answers.ask(tasks, _STILL)
            answer, front = (self._answers.answer(task) for task in tasks)
            words = answer if isinstance(answer, str) else ""
        matrix = answer if isinstance(answer, dict) else None
        self._dots = front if isinstance(front, tuple) else ()
        settled = None
        if matrix is not None and index is not None:
            settled = [solution.power.total / matrix["power"] - 1.0, index / matrix["index"] - 1.0]
        self._context.bridge.set(
            dial={
                "harmonics": HARMONICS,
                "now": [[one.per_rev, *_polar(one)] for one in inputs.twist_per_rev],
                "reach": max(REACH, *(math.ceil(_polar(one)[0]) for one in inputs.twist_per_rev), 0.0),
                "words": words,
                "action": action,
                "computing": not words and matrix is None,
                "settled": None if settled is None else [round(100.0 * one, 2) for one in settled],
                "held": self._context.held,
            },
            dial_matrix=matrix,
            dial_front={
                "words": front if isinstance(front, str) else "" if front or words else "Computing the front …",
                "dots": [_dot(one) for one in self._dots],
            },
        )

    def stop(self) -> None:
        """The browser has left."""
        self._answers.stop()

    def _why_not(self, design: Design) -> tuple[str, str]:
        """The sentence why there is no vibration to foresee, and what a button could do about it."""
        reason = why_no_hub_loads(design)
        if reason is not None:
            return reason.sentence, ""
        if design.models.bending:
            return "", ""
        return (
            ("Vibration and this preview need blades that bend.", "Let blades bend")
            if can_bend(design.rotor)
            else ("No vibration: the rotor file has no bending stiffness.", "")
        )

    def _act(self, value: Sequence[Any]) -> None:
        """`[n, "start"]`, `[n, "end"]`, or `[n, [amplitude °, phase °]]`."""
        per_rev, change = int(value[0]), value[1]
        if change == "end":
            self._grabbed(False)
        elif self._context.held or per_rev not in HARMONICS:
            return
        elif change == "start":
            self._grabbed(True)
        else:
            inputs = self._context.inputs()
            moved = with_wave(inputs.twist_per_rev, per_rev, float(change[0]), float(change[1]))
            if moved != inputs.twist_per_rev:
                self._context.drag_to(replace(inputs, twist_per_rev=moved))

    def _take_dot(self, number_of: Any) -> None:
        """Apply the twist of a dot of the front."""
        if not self._context.held and 0 <= int(number_of) < len(self._dots):
            twist = tuple(_on_sliders(one) for one in self._dots[int(number_of)].twist)
            self._context.set_inputs(replace(self._context.inputs(), twist_per_rev=twist))

    def _bend(self) -> None:
        if not self._context.held:
            self._context.set_inputs(replace(self._context.inputs(), bending=True))


def with_wave(waves: tuple[Harmonic, ...], per_rev: int, amplitude: float, phase: float) -> tuple[Harmonic, ...]:
    """The harmonics with this one at another amplitude and phase [°]; none below `_LEAST`."""
    size = 0.0 if amplitude < _LEAST else min(amplitude, 20.0)
    return _replaced(waves, Harmonic(per_rev, math.radians(size), math.radians(phase % 360.0)))


def _replaced(waves: tuple[Harmonic, ...], own: Harmonic) -> tuple[Harmonic, ...]:
    """The harmonics with `own` in place of that of its order; none there where its amplitude is zero."""
    others = [one for one in waves if one.per_rev != own.per_rev]
    return tuple(sorted([*others, own] if own.amplitude else others, key=lambda one: one.per_rev))


def _on_sliders(one: Harmonic) -> Harmonic:
    """With the digits that the page shows."""
    size, phase = _polar(one)
    return Harmonic(one.per_rev, math.radians(size), math.radians(phase))


def _polar(one: Harmonic) -> tuple[float, float]:
    """Amplitude and phase [°]."""
    return round(math.degrees(one.amplitude), 2), round(math.degrees(one.phase), 1) % 360.0


def _dot(one: FrontDot) -> dict[str, Any]:
    words = f"power {number(one.power, 1, sign=True)} %, vibration {number(one.index, 0, sign=True)} %"
    if one.over_wakes is not None:
        low, high = one.over_wakes
        words += f" ({number(low, 0, sign=True)} to {number(high, 0, sign=True)} over wakes)"
    return {
        "power": round(one.power, 3),
        "index": round(one.index, 2),
        "wakes": None if one.over_wakes is None else [round(end, 1) for end in one.over_wakes],
        "words": f"{words}: {harmonic_words(tuple(map(_on_sliders, one.twist)), ())}",
    }


def published() -> list[dict[str, Any]]:
    """What other programmes reached, for the chart: with power where both belong to one input, else without."""
    return [
        {
            "name": f"{one.short}{_orders(one)}",
            "power": one.power_change_percent if one.together else None,
            "vibration": one.vibration_percent,
            "kind": one.kind,
            "words": programme_words(one),
        }
        for one in programmes()
        if one.vibration_percent is not None
    ]


def _orders(one: Programme) -> str:
    """The harmonics, where the short name alone does not tell two results apart."""
    twins = [other for other in programmes() if other.short == one.short]
    return f" {'+'.join(map(str, one.per_rev))}/rev" if len(twins) > 1 and one.per_rev else ""


def programme_words(one: Programme) -> str:
    """A published result in a sentence or two, with its source."""
    said = [f"{one.name}: {one.control}, {'measured in ' if one.kind != 'computed' else ''}{one.kind}"]
    if one.vibration_percent is not None:
        said.append(f"{one.vibration} {_range(one.vibration_percent)}")
    if one.power_change_percent is not None:
        said.append(f"power {number(one.power_change_percent, 1, sign=True)} %")
    apart = "" if one.together or one.power_change_percent is None else " Each is the largest of its kind."
    return f"{', '.join(said)}.{apart} {one.note} {one.source}."


def _range(ends: tuple[float, float]) -> str:
    low, high = (number(end, 0, sign=True) for end in ends)
    return f"{low} %" if low == high else f"{low} to {high} %"


def programme_table() -> str:
    """HTML: every published result with its kind and its source."""
    rows = "".join(
        f'<tr title="{escape(programme_words(one))}"><td>{escape(one.short + _orders(one))}</td>'
        f"<td>{escape(one.kind)}</td>"
        f'<td class="rx-num">{"–" if one.vibration_percent is None else _range(one.vibration_percent)}</td>'
        f'<td class="rx-num">{_power_of(one)}</td></tr>'
        f'<tr class="rx-dim"><td colspan="4">{escape(one.control.capitalize())}. {escape(one.source)}.</td></tr>'
        for one in programmes()
    )
    return (
        "<details><summary>Published programmes and their sources</summary><table class='rxd-table'>"
        '<tr class="rx-dim"><td></td><td></td><td class="rx-num">vibration</td><td class="rx-num">power</td></tr>'
        f"{rows}</table><div class='rx-dim'>Other rotors, other measures of vibration. * Largest of its kind, not "
        "together with the vibration beside it.</div></details>"
    )


def _power_of(one: Programme) -> str:
    if one.power_change_percent is None:
        return "–"
    return f"{number(one.power_change_percent, 1, sign=True)} %{'' if one.together else ' *'}"


def _rounded(values: Any) -> Any:
    """Nested lists of a few digits."""
    if getattr(values, "ndim", 0):
        return [_rounded(one) for one in values]
    return float(f"{float(values):.{_DIGITS}g}")
