"""Pitch and twist at n/rev in the Actuate mode: the dial of twist with the front of power and vibration.

The page foresees while a hand drags the dial (`explorer/web/dial.js`, from the numbers of `dial_matrix`); the design
follows, so that the same drag is trimmed. The front stands beside it with what was published.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.model.inputs import Inputs
from explorer.model.session_state import SessionState
from explorer.model.units import Units, number
from explorer.tabs.background import Call, PoolAnswers
from explorer.tabs.context import TabContext
from explorer.text.design_words import harmonic_words
from rotor import Design, t_matrix
from rotor.actuator import (
    EffectInFlight,
    InstalledActuator,
    Programme,
    effect,
    programmes,
    steady_room,
    tip_amplitude,
    with_actuator_mass,
)
from rotor.actuator.installation import harmonic_loss
from rotor.aero.bending import can_bend
from rotor.chart import Axis, Chart, Line, Points, Rule, as_json, round_ticks, tick_text
from rotor.design import Harmonic, TwistLaw
from rotor.markup import tag
from rotor.optimisation.vibration import TMatrix, front_twists, with_harmonics
from rotor.trim import analyse, why_no_hub_loads
from rotor.trim.hub_loads import BAND, hub_index, index_gains

HARMONICS = (2, 3, 4, 5)
"""Harmonics of the dial: those at which four blades pass vibration on to the hub, and 2/rev, which saves power."""
REACH = 1.5
"""Radius of the dial [°]; active twist rotors have reached 1.1 to 1.4°."""
SHAKE = 5e4
"""By how much the shaking of the cabin is exaggerated; a rigid helicopter would move by F/(m (N_b Ω)²)."""
_FRONT_HARMONICS, _FRONT_REACH, _FRONT_POINTS = (2, 3), 1.0, 7
_LEAST = 0.02
"""An amplitude below this [°] is none."""
_BEST, _SPREAD = "var(--rx-accent)", "color-mix(in srgb, var(--rx-accent) 22%, transparent)"
_FAINT = "var(--rx-faint)"
_VIBRATIONS = (-100.0, -50.0, 0.0, 50.0, 100.0, 200.0, 400.0)
_STILL = 0.4
"""How long the design must stand before it is worked on [s]."""
_DIGITS = 6
_UNMEASURED = "Not validated: we found no measured power benefit of active twist. Published savings are computed."


@dataclass(frozen=True)
class Fitted:
    """The actuator on the blade, and the blade that power and vibration are compared with."""

    installed: InstalledActuator
    volts: tuple[float, ...]
    """Steady voltage of each segment [V]."""
    twist: TwistLaw | None
    """Twist of the blade compared with; None while it is being worked out."""
    against: str
    """What that blade is called."""

    @property
    def whole(self) -> float:
        """Amplitude at n/rev of half the voltage range at the tip of the blade at rest [°]; zero: it cannot follow."""
        return math.degrees(tip_amplitude(self.installed))

    @property
    def losses(self) -> list[float]:
        """Heat in the plies of all blades for 1° at each harmonic of the dial [W]."""
        if not self.whole:
            return [0.0] * len(HARMONICS)
        omega, blades = self.installed.beam.angular_speed, self.installed.masses.blades
        return [blades * harmonic_loss(self.installed, n, 1.0 / self.whole, omega) for n in HARMONICS]


def compared(design: Design, undriven: Design, fitted: Fitted | None) -> tuple[Design, Design] | None:
    """What flies, with the actuator on board, and the blade that it is compared with; None while that is not known.

    Blades bend in both where they can, since vibration needs it, and no blade has pitch at n/rev.
    """
    bends = can_bend(design.rotor)
    flown, still = (
        replace(one, pitch_per_rev=(), models=replace(one.models, bending=bends)) for one in (design, undriven)
    )
    if fitted is None:
        return flown, replace(flown, active_twist=None)
    if fitted.twist is None:
        return None
    return with_actuator_mass(flown, fitted.installed), replace(still, twist=fitted.twist, active_twist=None)


@dataclass(frozen=True)
class FrontDot:
    """One compromise of the front, foreseen."""

    twist: tuple[Harmonic, ...]
    power: float
    """Change of power [%]."""
    index: float
    """Change of the vibration index [%]."""
    over_inflows: tuple[float, float]
    """Least and largest change of the index over inflow models [%]."""

    @property
    def agreed(self) -> bool:
        """Whether the index changes with the same sign with every inflow model."""
        return self.over_inflows[0] * self.over_inflows[1] > 0.0


@dataclass(frozen=True)
class DialAnswer:
    """The response to n/rev twist against another blade, and the front of power and vibration."""

    numbers: dict[str, Any]
    """What `dial.js` needs, per degree."""
    front: tuple[FrontDot, ...]
    """From least power to least vibration."""


def dial_answer(design: Design, reference: Design, losses: Sequence[float], reach: float) -> DialAnswer:
    """The answer for a design with the actuator on board; its active twist counts for its shape alone.

    losses: of the drive for 1° at each harmonic [W]. reach: largest amplitude of the front's harmonics [°].
    ValueError or RuntimeError with a sentence.
    """
    found = list[tuple[TMatrix, float, float]]()
    for inflow in dict.fromkeys((design.models.inflow, *BAND)):
        flown, still = (replace(one, models=replace(design.models, inflow=inflow)) for one in (design, reference))
        try:
            matrix, other = t_matrix(flown, HARMONICS), analyse(still)
            power, index = other.solution.require().power.total, hub_index(other.adjoint)
        except RuntimeError:
            if inflow == design.models.inflow:
                raise
            continue
        second = matrix.second.copy()
        for k, loss in enumerate(np.repeat(losses, 2)):
            second[-1, k, k] += 2.0 * loss / math.radians(1.0) ** 2
        found.append((replace(matrix, second=second), power, index))
    own, *others = (_numbers_of(design, *each) for each in found)
    few = 2 * len(_FRONT_HARMONICS)
    matrix = found[0][0]
    steps = front_twists(
        replace(matrix, harmonics=_FRONT_HARMONICS, slopes=matrix.slopes[:, :few], second=matrix.second[:, :few, :few]),
        math.radians(reach),
        _FRONT_POINTS,
    )
    dots = list[FrontDot]()
    for step in steps:
        x = np.append(step, np.zeros(2 * len(HARMONICS) - few))
        changes = [100.0 * (one.power_and_index(x)[0] / (power, index) - 1.0) for one, power, index in found]
        over = [float(change[1]) for change in changes]
        dots.append(FrontDot(matrix.twist(x), float(changes[0][0]), over[0], (min(over), max(over))))
    return DialAnswer(own | {"inflows": others}, tuple(dots))


def _numbers_of(design: Design, matrix: TMatrix, power: float, index: float) -> dict[str, Any]:
    """What `dial.js` needs with one inflow model; power [W] and index [%] of the blade compared with."""
    degree = math.radians(1.0)
    return {
        "base": _rounded(matrix.base),
        "slopes": _rounded(degree * matrix.slopes),
        "second": _rounded(degree**2 * matrix.second),
        "gains": _rounded(100.0 * index_gains(design)),
        "power": power,
        "index": index,
    }


class TwistDial:
    """One session's."""

    def __init__(self, context: TabContext, grabbed: Callable[[bool], None], after: float) -> None:
        """The panel stands below the widget of order `after`. `grabbed`: the dot was taken (True) or let go."""
        self._context, self._grabbed, gui = context, grabbed, context.gui
        self._answers = PoolAnswers(context.pool, 3, context.wake)
        self._dots: tuple[FrontDot, ...] = ()
        with gui.add_folder("Twist at n/rev", order=after + 0.5):
            gui.add_html(tag("div.rxd", data_dial=True, data_explorer="dial"))
            self._set = gui.add_html("")
            gui.add_html(tag("div.rx.rx-dim.rx-small", _UNMEASURED, data_explorer="unmeasured"))
        self.refresh(context.inputs())
        bridge = context.bridge
        bridge.on("dial", self._act)
        bridge.on("dial_front", self._take_dot)

    def refresh(self, inputs: Inputs) -> None:
        """Say what these inputs have that the dial does not show: by file, link or measured condition too."""
        hidden = [wave for wave in inputs.twist_per_rev if wave.per_rev not in HARMONICS or inputs.active_shape]
        words = harmonic_words(tuple(hidden), inputs.pitch_per_rev)
        shaped = " The twist has the shape of its design file." if inputs.active_shape else ""
        sentence = f"{words[:1].upper()}{words[1:]}.{shaped}" if words else ""
        self._set.content = tag("div.rx.rx-dim.rx-small", sentence, data_explorer="per-rev")

    def show(self, state: SessionState, fitted: Fitted | None) -> None:
        """Follow a converged state; `fitted`: the actuator that the blade carries."""
        if self._context.layout.mode != "actuate":
            self._answers.ask((), _STILL)
            return
        design, inputs, units = state.solution.design, state.inputs, self._context.units
        reason = why_no_hub_loads(design)
        words = "" if reason is None else reason.sentence
        pair = compared(design, inputs.design(), fitted)
        whole = 0.0 if fitted is None else fitted.whole
        room = 0.0 if fitted is None else steady_room(fitted.installed, fitted.volts)
        answer = moved = None
        if pair is not None:
            losses = (0.0,) * len(HARMONICS) if fitted is None else tuple(fitted.losses)
            shaped = with_harmonics(pair[0], (Harmonic(3, math.radians(1.0)),))
            foreseen = Call(dial_answer, (shaped, pair[1], losses, round(whole, 2) or _FRONT_REACH))
            trimmed = Call(effect, pair)
            self._answers.ask((trimmed,) if words else (trimmed, foreseen), _STILL)
            answer, moved = None if words else self._answers.answer(foreseen), self._answers.answer(trimmed)
            words = words or (answer if isinstance(answer, str) else "")
        found = answer if isinstance(answer, DialAnswer) else None
        self._dots = () if found is None else found.front
        drive = 0.0
        if fitted is not None and whole:
            sizes = [(HARMONICS.index(n.per_rev), _polar(n)[0]) for n in inputs.twist_per_rev if n.per_rev in HARMONICS]
            drive = sum(fitted.losses[k] * size**2 for k, size in sizes)
        unit = units.power[0]
        settled = None
        if isinstance(moved, EffectInFlight):
            settled = {
                "power": [unit.of(change + drive) for change in moved.power],
                "index": [round(change, 2) for change in moved.index],
            }
        reach = max(REACH, *(math.ceil(_polar(wave)[0]) for wave in inputs.twist_per_rev), 0.0)
        self._context.bridge.set(
            dial={
                "harmonics": HARMONICS,
                "now": [[wave.per_rev, *_polar(wave)] for wave in inputs.twist_per_rev],
                "reach": reach,
                "whole": round(whole, 4),
                "room": round(room, 4),
                "steady": bool(fitted is not None and any(fitted.volts)),
                "rings": [(at, tick_text(at)) for at in round_ticks(0.0, reach, 4)[1:]],
                "words": words,
                "computing": not words and found is None,
                "settled": settled,
                "problem": moved if isinstance(moved, str) else "",
                "against": "the same blade at rest" if fitted is None else fitted.against,
                "where": _where(design, units),
                "unit": unit.symbol,
                "per_watt": unit.of(1.0),
                "front": [[dot.power, dot.index, _parts(dot.twist)] for dot in self._dots],
                "exaggerated": number(SHAKE),
                "shake": SHAKE / (design.condition.mass * (design.rotor.blades * design.rotor.angular_speed) ** 2),
                "held": self._context.held,
            },
            dial_matrix=None if found is None else found.numbers,
            dial_front=as_json(front_chart(self._dots)),
        )

    def stop(self) -> None:
        """The browser has left."""
        self._answers.stop()

    def _act(self, value: str | Sequence[Sequence[float]]) -> None:
        """`"start"`, `"end"`, or for each harmonic moved `[n, amplitude °, phase °]`."""
        if value == "end":
            self._grabbed(False)
        elif self._context.held:
            return
        elif value == "start":
            self._grabbed(True)
        elif not isinstance(value, str):
            inputs = self._context.inputs()
            moved = inputs.twist_per_rev
            for per_rev, amplitude, phase in value:
                if int(per_rev) in HARMONICS:
                    moved = with_wave(moved, int(per_rev), float(amplitude), float(phase))
            if moved != inputs.twist_per_rev:
                self._context.drag_to(replace(inputs, twist_per_rev=moved))

    def _take_dot(self, number_of: Any) -> None:
        """Apply the twist of a dot of the front."""
        if not self._context.held and 0 <= int(number_of) < len(self._dots):
            twist = tuple(_on_sliders(wave) for wave in self._dots[int(number_of)].twist)
            self._context.set_inputs(replace(self._context.inputs(), twist_per_rev=twist))


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


def _parts(waves: Sequence[Harmonic]) -> list[float]:
    """Cosine and sine of each harmonic of the dial [°]."""
    sizes = {wave.per_rev: np.degrees(wave.amplitude) * np.exp(1j * wave.phase) for wave in waves}
    return [
        round(float(part), 4) for n in HARMONICS for part in (np.real(sizes.get(n, 0.0)), np.imag(sizes.get(n, 0.0)))
    ]


def _where(design: Design, units: Units) -> str:
    """The flight condition, in words."""
    return (
        "in hover"
        if design.hovering
        else f"at {units.speed[0].text(design.condition.advance_ratio * design.rotor.tip_speed)}"
    )


def _dot_words(dot: FrontDot) -> str:
    low, high = (number(end, 0, sign=True) for end in dot.over_inflows)
    words = f"power {number(dot.power, 1, sign=True)} %, vibration {number(dot.index, 0, sign=True)} %"
    words += f" ({low} to {high} over inflow models{')' if dot.agreed else ', which disagree in sign)'}"
    return (
        f"{words}: {harmonic_words(tuple(map(_on_sliders, dot.twist)), ())}. Press to take it, or drag along the front."
    )


def front_chart(dots: Sequence[FrontDot]) -> Chart:
    """The front beside what other programmes reached: with power where both belong to one input, else at the side."""
    shown = [result for result in programmes() if result.vibration_percent is not None]
    paired = [result for result in shown if result.together and result.power_change_percent is not None]
    powers = [0.0, *(dot.power for dot in dots), *(result.power_change_percent or 0.0 for result in paired)]
    low, high = math.floor(min(-2.0, *powers) - 0.3), math.ceil(max(2.0, *powers) + 0.6)
    alone = [result for result in shown if result not in paired]
    most = max(40.0, *(1.15 * dot.index for dot in dots)) if dots else 40.0
    column = 0.09 * (high - low)
    end = high + column * (len(alone) + 0.5)
    ticks = tuple(at for at in round_ticks(low, high, 4) if at < high)
    spreads = [Line("", (dot.power, dot.power), dot.over_inflows, _SPREAD, width=4.0) for dot in dots]
    line = Line("", [dot.power for dot in dots], [dot.index for dot in dots], _BEST, width=1.4)
    best = (line, *(_pressed(dots, agreed) for agreed in (True, False) if agreed in {dot.agreed for dot in dots}))
    return Chart(
        "Vibration by power",
        Axis("power [%]", (low, end), (*ticks, 0.5 * (high + end)), (*map(tick_text, ticks), "vibration alone")),
        Axis("changes [%]", (-100.0, most), tuple(at for at in _VIBRATIONS if at < most)),
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
        "front" if agreed else "models disagree",
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


def _rounded(values: Any) -> Any:
    """Nested lists of a few digits."""
    if getattr(values, "ndim", 0):
        return [_rounded(value) for value in values]
    return float(f"{float(values):.{_DIGITS}g}")
