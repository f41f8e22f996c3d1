"""Pitch and twist at n/rev in the Actuate mode: the dial of twist with the front of power and vibration.

The page foresees while a hand drags the dial (`explorer/web/dial.js`, from the numbers of `dial_matrix`); the design
follows, so that the same drag is trimmed. The front stands beside it with what was published.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.tabs.background import Call, PoolAnswers
from explorer.tabs.context import TabContext
from explorer.text.design_words import harmonic_words
from rotor import Design, t_matrix, vibration_front
from rotor.actuator import Programme, programmes
from rotor.aero.bending import can_bend
from rotor.chart import Axis, Chart, Line, Points, Rule, as_json, round_ticks, tick_text
from rotor.design import Harmonic
from rotor.markup import Markup, tag
from rotor.optimisation.vibration import with_harmonics
from rotor.trim import why_no_hub_loads
from rotor.trim.hub_loads import BAND, index_gains

HARMONICS = (2, 3, 4, 5)
"""Harmonics of the dial: those at which four blades pass vibration on to the hub, and 2/rev, which saves power."""
REACH = 2.0
"""Radius of the dial [°]; active twist rotors have reached 1.1 to 1.4°."""
_FRONT_HARMONICS, _FRONT_REACH, _FRONT_POINTS = (2, 3), 1.0, 7
_LEAST = 0.02
"""An amplitude below this [°] is none."""
_BEST, _SPREAD = "var(--rx-accent)", "color-mix(in srgb, var(--rx-accent) 22%, transparent)"
_FAINT = "var(--rx-faint)"
_VIBRATIONS = (-100.0, -75.0, -50.0, -25.0, 0.0, 25.0)
_STILL = 0.4
"""How long the design must stand before it is worked on [s]."""
_DIGITS = 6
_UNMEASURED = "Not validated: we found no measured power benefit of active twist. Published savings are computed."


def dial_matrix(design: Design) -> dict[str, Any]:
    """What `dial.js` needs, per degree: the response of power and hub loads to n/rev twist.

    The shape of the design's active twist counts, its harmonics do not. ValueError or RuntimeError with a sentence.
    """
    others = (inflow for inflow in BAND if inflow != design.models.inflow)
    numbers = _numbers_of(design)
    return numbers | {
        "inflows": [each for each in map(partial(_with_inflow_model, design), others) if each is not None]
    }


def _with_inflow_model(design: Design, inflow: str) -> dict[str, Any] | None:
    """What `dial.js` needs of one further inflow model; None where it does not trim."""
    try:
        return _numbers_of(replace(design, models=replace(design.models, inflow=inflow)))
    except RuntimeError:
        return None


def _numbers_of(design: Design) -> dict[str, Any]:
    """What `dial.js` needs with the inflow model of the design."""
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
    """Change of the vibration index from the blade without n/rev twist [%]."""
    over_inflows: tuple[float, float] | None
    """Least and largest change of the index over inflow models [%]."""

    @property
    def agreed(self) -> bool:
        """Whether the index changes with the same sign with every inflow model."""
        return self.over_inflows is None or self.over_inflows[0] * self.over_inflows[1] > 0.0


def front_dots(design: Design) -> tuple[FrontDot, ...]:
    """The front from least power to least vibration; ValueError or RuntimeError with a sentence."""
    front = vibration_front(design, harmonics=_FRONT_HARMONICS, reach_deg=_FRONT_REACH, points=_FRONT_POINTS)
    dots = list[FrontDot]()
    for point, (power, index) in zip(front.points, front.changes, strict=True):
        twist = point.design.active_twist
        dots.append(FrontDot(() if twist is None else twist.harmonics, power, index, point.over_inflows))
    return tuple(dots)


class TwistDial:
    """One session's."""

    def __init__(self, context: TabContext, grabbed: Callable[[bool], None]) -> None:
        """The panel stands where the context does. `grabbed`: the dot was taken (True) or let go."""
        self._context, self._grabbed, gui = context, grabbed, context.gui
        self._answers = PoolAnswers(context.pool, 3, context.wake)
        self._dots: tuple[FrontDot, ...] = ()
        with gui.add_folder("Pitch and twist at n/rev"):
            self._set = gui.add_html("")
            self._vibration = gui.add_html("", visible=False)
            gui.add_html(tag("div.rxd", data_dial=True, data_explorer="dial"))
            gui.add_html(tag("div.rx.rx-dim.rx-small", _UNMEASURED, data_explorer="unmeasured"))
            gui.add_html(tag("div.rx.rx-small", programme_table(), data_explorer="programmes"))
        self.refresh(context.inputs())
        bridge = context.bridge
        bridge.on("dial", self._act)
        bridge.on("dial_front", self._take_dot)
        bridge.on("dial_bend", lambda _: self._bend())

    def refresh(self, inputs: Inputs) -> None:
        """Say what these inputs have set, by file, link or measured condition too."""
        words = harmonic_words(inputs.twist_per_rev, inputs.pitch_per_rev) or "none set"
        shaped = " The twist has the shape of its design file." if inputs.active_shape else ""
        sentence = f"{words[:1].upper()}{words[1:]}.{shaped}"
        self._set.content = tag("div.rx.rx-dim.rx-small", sentence, data_explorer="per-rev")

    def show(self, state: SessionState, vibration: str, index: float | None) -> None:
        """Follow a converged state; `vibration` and its `index` [%]: empty and None, blades do not bend."""
        content = tag("div.rx.rx-small", vibration, data_explorer="per-rev-vibration")
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
        reach = max(REACH, *(math.ceil(_polar(wave)[0]) for wave in inputs.twist_per_rev), 0.0)
        self._context.bridge.set(
            dial={
                "harmonics": HARMONICS,
                "now": [[wave.per_rev, *_polar(wave)] for wave in inputs.twist_per_rev],
                "reach": reach,
                "rings": [(at, tick_text(at)) for at in round_ticks(0.0, reach, 4)[1:]],
                "words": words,
                "action": action,
                "computing": not words and matrix is None,
                "settled": None if settled is None else [round(100.0 * change, 2) for change in settled],
                "held": self._context.held,
            },
            dial_matrix=matrix,
            dial_front=as_json(front_chart(self._dots))
            | {"words": front if isinstance(front, str) else "" if front or words else "Computing the front …"},
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
            twist = tuple(_on_sliders(wave) for wave in self._dots[int(number_of)].twist)
            self._context.set_inputs(replace(self._context.inputs(), twist_per_rev=twist))

    def _bend(self) -> None:
        if not self._context.held:
            self._context.set_inputs(replace(self._context.inputs(), bending=True))


def with_wave(waves: tuple[Harmonic, ...], per_rev: int, amplitude: float, phase: float) -> tuple[Harmonic, ...]:
    """The harmonics with this one at another amplitude and phase [°]; none below `_LEAST`."""
    size = 0.0 if amplitude < _LEAST else min(amplitude, 20.0)
    return _replaced(waves, Harmonic(per_rev, math.radians(size), math.radians(phase % 360.0)))


def _replaced(waves: tuple[Harmonic, ...], harmonic: Harmonic) -> tuple[Harmonic, ...]:
    """The harmonics with `own` in place of that of its order; none there where its amplitude is zero."""
    others = [wave for wave in waves if wave.per_rev != harmonic.per_rev]
    return tuple(sorted([*others, harmonic] if harmonic.amplitude else others, key=lambda wave: wave.per_rev))


def _on_sliders(wave: Harmonic) -> Harmonic:
    """With the digits that the page shows."""
    size, phase = _polar(wave)
    return Harmonic(wave.per_rev, math.radians(size), math.radians(phase))


def _polar(wave: Harmonic) -> tuple[float, float]:
    """Amplitude and phase [°]."""
    return round(math.degrees(wave.amplitude), 2), round(math.degrees(wave.phase), 1) % 360.0


def _dot_words(dot: FrontDot) -> str:
    words = f"power {number(dot.power, 1, sign=True)} %, vibration {number(dot.index, 0, sign=True)} %"
    if dot.over_inflows is not None:
        low, high = dot.over_inflows
        words += f" ({number(low, 0, sign=True)} to {number(high, 0, sign=True)} over inflow models"
        words += ")" if dot.agreed else ", which disagree in sign)"
    return f"{words}: {harmonic_words(tuple(map(_on_sliders, dot.twist)), ())}. Press to apply it."


def front_chart(dots: Sequence[FrontDot]) -> Chart:
    """The front beside what other programmes reached: with power where both belong to one input, else at the side."""
    shown = [result for result in programmes() if result.vibration_percent is not None]
    paired = [result for result in shown if result.together and result.power_change_percent is not None]
    powers = [0.0, *(dot.power for dot in dots), *(result.power_change_percent or 0.0 for result in paired)]
    low, high = math.floor(min(-2.0, *powers) - 0.3), math.ceil(max(2.0, *powers) + 0.6)
    alone = [result for result in shown if result not in paired]
    column = 0.09 * (high - low)
    end = high + column * (len(alone) + 0.5)
    ticks = [at for at in round_ticks(low, high, 4) if at < high]
    spreads = [
        Line("", (dot.power, dot.power), dot.over_inflows, _SPREAD, width=4.0)
        for dot in dots
        if dot.over_inflows is not None
    ]
    line = Line("", [dot.power for dot in dots], [dot.index for dot in dots], _BEST, width=1.4)
    best = (line, *(_pressed(dots, agreed) for agreed in (True, False) if agreed in {dot.agreed for dot in dots}))
    return Chart(
        "Vibration by power",
        Axis("power [%]", (low, end), (*ticks, 0.5 * (high + end)), (*map(tick_text, ticks), "vibration alone")),
        Axis("changes [%]", (-100.0, 40.0), _VIBRATIONS),
        (
            *spreads,
            _published(
                "published, measured", [result for result in shown if result.kind != "computed"], high, column, alone
            ),
            _published("computed", [result for result in shown if result.kind == "computed"], high, column, alone),
            *(best if dots else ()),
        ),
        (Rule(high, colour=_FAINT, dashes=""), Rule(0.0, colour=_FAINT, dashes="")),
    )


def _pressed(dots: Sequence[FrontDot], agreed: bool) -> Points:
    """The dots on whose sign all inflow models agree, which alone are called best, or the others."""
    chosen = [(k, dot) for k, dot in enumerate(dots) if dot.agreed == agreed]
    return Points(
        "best, press to apply" if agreed else "models disagree",
        [dot.power for _, dot in chosen],
        [dot.index for _, dot in chosen],
        _BEST,
        "dot" if agreed else "ring",
        words=[_dot_words(dot) for _, dot in chosen],
        action="dial_front",
        press=[str(k) for k, _ in chosen],
        size=5.0,
    )


def _published(
    label: str, shown: Sequence[Programme], high: float, column: float, alone: Sequence[Programme]
) -> Points:
    """Programmes at their power, or where they are one of those `alone` in a column of its own beyond `high`."""
    ends = [result.vibration_percent or (0.0, 0.0) for result in shown]
    return Points(
        label,
        [
            high + column * (alone.index(result) + 0.75) if result in alone else result.power_change_percent or 0.0
            for result in shown
        ],
        [0.5 * (low + high) for low, high in ends],
        "var(--rx-dim)",
        "ring" if label == "computed" else "dot",
        scatter=[0.5 * abs(high - low) for low, high in ends],
        words=[programme_words(result) for result in shown],
        names=[f"{result.short}{_orders(result)}" for result in shown],
        beside="upward" if shown and shown[0] in alone else "below",
        size=4.5,
    )


def _orders(result: Programme) -> str:
    """The harmonics, where the short name alone does not tell two results apart."""
    twins = [other for other in programmes() if other.short == result.short]
    return f" {'+'.join(map(str, result.per_rev))}/rev" if len(twins) > 1 and result.per_rev else ""


def programme_words(result: Programme) -> str:
    """A published result in a sentence or two, with its source."""
    said = [f"{result.name}: {result.control}, {'measured in ' if result.kind != 'computed' else ''}{result.kind}"]
    if result.vibration_percent is not None:
        said.append(f"{result.vibration} {_range(result.vibration_percent)}")
    if result.power_change_percent is not None:
        said.append(f"power {number(result.power_change_percent, 1, sign=True)} %")
    apart = "" if result.together or result.power_change_percent is None else " Each is the largest of its kind."
    return f"{', '.join(said)}.{apart} {result.note} {result.source}."


def _range(ends: tuple[float, float]) -> str:
    low, high = (number(end, 0, sign=True) for end in ends)
    return f"{low} %" if low == high else f"{low} to {high} %"


def programme_table() -> Markup:
    """Every published result with its kind and its source."""
    rows = [tag("tr.rx-dim", tag("td"), tag("td"), tag("td.rx-num", "vibration"), tag("td.rx-num", "power"))]
    for programme in programmes():
        vibration = programme.vibration_percent
        source = f"{programme.control.capitalize()}. {programme.source}."
        rows += [
            tag(
                "tr",
                tag("td", programme.short + _orders(programme)),
                tag("td", programme.kind),
                tag("td.rx-num", "–" if vibration is None else _range(vibration)),
                tag("td.rx-num", _power_of(programme)),
                title=programme_words(programme),
            ),
            tag("tr.rx-dim", tag("td", source, colspan=4)),
        ]
    note = (
        "Other rotors, other measures of vibration. * Largest of its kind, not together with the vibration beside it."
    )
    return tag(
        "details",
        tag("summary", "Published programmes and their sources"),
        tag("table.rxd-table", rows),
        tag("div.rx-dim", note),
    )


def _power_of(result: Programme) -> str:
    if result.power_change_percent is None:
        return "–"
    return f"{number(result.power_change_percent, 1, sign=True)} %{'' if result.together else ' *'}"


def _rounded(values: Any) -> Any:
    """Nested lists of a few digits."""
    if getattr(values, "ndim", 0):
        return [_rounded(value) for value in values]
    return float(f"{float(values):.{_DIGITS}g}")
