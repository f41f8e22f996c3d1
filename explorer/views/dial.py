"""Pitch and twist at n/rev in the Actuate mode: the dial of twist with the front of power and vibration.

The page foresees while a hand drags the dial (`explorer/web/dial.js`, from the numbers of `dial_matrix`); the design
follows, so that the same drag is trimmed. The front stands beside it with what was published.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from explorer.model.units import number
from explorer.parts.actuate import DialMatrix, DialPart, ModelChanges
from explorer.parts.presses import WavePress
from explorer.text.design_words import harmonic_words
from explorer.views.actuated import (
    effect_call,
    fitted,
    in_actuate,
    per_rev_heat,
    per_rev_power,
    still_work,
)
from explorer.views.dial_answer import HARMONICS, DialAnswer, FrontDot, dial_answer, front_dots
from explorer.views.page_state import (
    Effect,
    MoveSliders,
    PageState,
    Panel,
    PanelWork,
    Questions,
    SetGrabbed,
)
from explorer.workers.call import Call
from rotor import Design
from rotor.actuator import EffectInFlight, Programme, effect, programmes
from rotor.design import Harmonic
from rotor.design.design import with_models
from rotor.optimisation.vibration import with_harmonics
from rotor.support.chart import Axis, Chart, Line, Points, Rule, drawn_chart, round_ticks, tick_text
from rotor.support.markup import tag
from rotor.trim import why_no_hub_loads
from rotor.trim.hub_loads import band_inflows

_MIN_REACH_DEG = 1.5
"""Radius of the dial [°]; active twist rotors have reached 1.1 to 1.4°."""
_SHAKE_EXAGGERATION = 5e4
"""By how much the shaking of the cabin is exaggerated; a rigid helicopter would move by F/(m (N_b Ω)²)."""
_FRONT_REACH_DEG = 1.0
"""Largest amplitude of the front where no actuator says one [°]."""
_MIN_AMPLITUDE_DEG = 0.02
"""An amplitude below this [°] is none."""
_BEST, _SPREAD = "var(--rx-accent)", "color-mix(in srgb, var(--rx-accent) 22%, transparent)"
_FAINT = "var(--rx-faint)"
_VIBRATIONS = (-100.0, -50.0, 0.0, 50.0, 100.0, 200.0, 400.0)
_URGENCY, _LATER, _DELAY_S = 4, 7, 0.4
"""What is trimmed comes behind the verdict, the dial behind what would pay: it is folded at first. Last, how long the
design must stand before it is worked on [s]."""


def _asked(now: PageState) -> tuple[Call, ...]:
    """What foresees with each inflow model, the design's own first; none where not all of it is known, or can be."""
    design, on_blade = now.of(_flown), now.of(fitted)
    if design is None or why_no_hub_loads(design) is not None:
        return ()
    losses = (0.0,) * len(HARMONICS) if on_blade is None else tuple(on_blade.losses)
    reach = (0.0 if on_blade is None else round(on_blade.whole, 2)) or _FRONT_REACH_DEG
    shaped, calls = with_harmonics(design, (Harmonic(3, math.radians(1.0)),)), list[Call]()
    for inflow in dict.fromkeys((design.models.inflow, *band_inflows())):
        flown = with_models(shaped, inflow=inflow)
        calls.append(Call(dial_answer, (flown, losses, 0.0 if calls else reach)))
    return tuple(calls)


def _flown(now: PageState) -> Design | None:
    """What the page shows; None where there is nothing."""
    return None if now.state is None or now.problem else now.state.solution.design


def _moved(now: PageState) -> Call | None:
    """Trims with n/rev twist and without it; None without it."""
    design = now.of(_flown)
    if design is None or design.active_twist is None:
        return None
    return Call(effect, (design, replace(design, active_twist=None)))


def _settled(now: PageState) -> ModelChanges | str | None:
    """What n/rev twist alone changes, as trimmed: power here, that of the other inflow models and vibration once they
    are known. Why that is not known, or None on its way."""
    known, found, unit = now.of(per_rev_power), now.answers.get(now.of(_moved)), now.units.power[0]
    if not now.inputs.twist_per_rev:
        return ModelChanges((0.0,), (0.0,))
    if known is None or isinstance(found, str):
        return found if isinstance(found, str) else None
    others, index = (
        (found.power[1:], found.index) if isinstance(found, EffectInFlight) else ((), ())
    )
    powers = known[0], *(power + per_rev_heat(now) for power in others)
    return ModelChanges(tuple(map(unit.of, powers)), tuple(round(change, 2) for change in index))


def works(now: PageState) -> tuple[PanelWork, ...]:
    work = now.of(still_work)
    return () if work is None else (work,)


def asks(now: PageState) -> tuple[Questions, ...]:
    """What is trimmed first; then two processes share the inflow models."""
    trimmed, calls = (
        [call for call in (now.of(effect_call), now.of(_moved)) if call],
        now.of(_asked),
    )
    first = Questions(_URGENCY, tuple(trimmed), _DELAY_S)
    return (
        first,
        Questions(_LATER, calls[::2], _DELAY_S),
        Questions(_LATER + 1, calls[1::2], _DELAY_S),
    )


def _answer(now: PageState) -> DialMatrix | str | None:
    """What foresees, with as many inflow models as are known, or why nothing does; None on its way."""
    own, *others = (*map(now.answers.get, now.of(_asked)), None)
    if not isinstance(own, DialAnswer):
        return own
    found = tuple(other.numbers for other in others if isinstance(other, DialAnswer))
    return DialMatrix(**vars(own.numbers), inflows=found)


def _waits(now: PageState) -> bool:
    """Whether not every inflow model has answered yet: then nothing is called best."""
    return any(now.answers.get(call) is None for call in now.of(_asked))


def _dots(now: PageState) -> tuple[FrontDot, ...]:
    """Once all inflow models have answered."""
    answer = now.of(_answer)
    if not isinstance(answer, DialMatrix) or now.of(_waits):
        return ()
    return front_dots(now.answers[now.of(_asked)[0]], answer.inflows)


def view(now: PageState) -> dict[str, Any]:
    """The dial, its numbers and its front; and in words what is set that the dial does not show."""
    words = {"actuator.per_rev": _set_words(now)}
    if now.state is None or now.problem:
        return words
    answer = now.of(_answer)
    return {
        **words,
        "dial": _dial(now, now.state.solution.design, answer),
        "dial_matrix": answer if isinstance(answer, DialMatrix) else None,
        "dial_front": drawn_chart(front_chart(now.of(_dots))),
    }


def _dial(now: PageState, design: Design, answer: DialMatrix | str | None) -> DialPart:
    on_blade, waves, unit = now.of(fitted), now.inputs.twist_per_rev, now.units.power[0]
    whole = 0.0 if on_blade is None else on_blade.whole
    settled, moving = now.of(_settled), bool(waves) and now.answers.get(now.of(_moved)) is None
    reason = why_no_hub_loads(design)
    words = reason.sentence if reason is not None else answer if isinstance(answer, str) else ""
    speed = design.condition.advance_ratio * design.rotor.tip_speed
    reach = max(_MIN_REACH_DEG, *(math.ceil(_polar(wave)[0]) for wave in waves), 0.0)
    return DialPart(
        harmonics=HARMONICS,
        now=tuple((wave.per_rev, *_polar(wave)) for wave in waves),
        reach=reach,
        whole=round(whole, 4),
        room=0.0
        if on_blade is None or not on_blade.whole
        else round(on_blade.room / on_blade.whole, 4),
        rings=tuple((at, tick_text(at)) for at in round_ticks(0.0, reach, 4)[1:]),
        words=words,
        computing=not words and (answer is None or now.of(_waits) or moving),
        settled=settled if isinstance(settled, ModelChanges) else None,
        problem=settled if isinstance(settled, str) else "",
        against="the same without n/rev",
        where="in hover" if design.hovering else f"at {now.units.speed[0].text(speed)}",
        unit=unit.symbol,
        per_watt=unit.of(1.0),
        front=tuple((dot.power, dot.index, _parts(dot.twist)) for dot in now.of(_dots)),
        exaggerated=number(_SHAKE_EXAGGERATION),
        shake=_SHAKE_EXAGGERATION
        / (design.condition.mass * (design.rotor.blades * design.rotor.angular_speed) ** 2),
    )


def validation_words() -> str:
    """What the dial rests on, for example `no measured power saving by active twist`, and what was measured instead."""
    tested = [one for one in programmes() if one.kind != "computed"]
    vibration = [one.vibration_percent for one in tested if one.vibration_percent]
    least = -max(high for _, high in vibration)
    most = -min(low for low, _ in vibration)
    powers = [-one.power_percent for one in tested if one.power_percent]
    return (
        "Not validated: we found no measured power saving by active twist; published savings by it are computed. "
        f"In wind tunnels, n/rev root pitch saved {number(min(powers))} to {number(max(powers))} % of power, and "
        f"n/rev pitch or twist reduced vibration by {number(least)} to {number(most)} %."
    )


def _set_words(now: PageState) -> str:
    """What these inputs have that the dial does not show: by file, link or measured condition too."""
    inputs = now.inputs
    hidden = [
        wave
        for wave in inputs.twist_per_rev
        if wave.per_rev not in HARMONICS or inputs.active_shape
    ]
    words = harmonic_words(tuple(hidden), inputs.pitch_per_rev)
    shaped = " The twist keeps the shape given in its design file." if inputs.active_shape else ""
    sentence = f"{words[:1].upper()}{words[1:]}.{shaped}" if words else ""
    return tag("div.rx.rx-dim.rx-small", sentence, data_explorer="per-rev")


def move_dot(now: PageState, value: str | Sequence[WavePress]) -> tuple[Effect, ...]:
    """The dot: `"start"`, `"end"`, or each harmonic moved."""
    if isinstance(value, str):
        return (SetGrabbed(value == "start"),)
    moved = now.inputs.twist_per_rev
    for wave in value:
        if wave.per_rev in HARMONICS:
            moved = with_wave(moved, wave.per_rev, wave.amplitude, wave.phase)
    return (
        (MoveSliders(replace(now.inputs, twist_per_rev=moved)),)
        if moved != now.inputs.twist_per_rev
        else ()
    )


def take_dot(now: PageState, number_of: int) -> tuple[Effect, ...]:
    """Apply the twist of a dot of the front."""
    dots = now.of(_dots)
    if not 0 <= number_of < len(dots):
        return ()
    twist = tuple(map(_on_sliders, dots[number_of].twist))
    return (MoveSliders(replace(now.inputs, twist_per_rev=twist), by_hand=False),)


DIAL = Panel(view, in_actuate, asks, works, presses={"dial": move_dot, "dial_front": take_dot})


def with_wave(
    waves: tuple[Harmonic, ...], per_rev: int, amplitude: float, phase: float
) -> tuple[Harmonic, ...]:
    """The harmonics with this one at another amplitude and phase [°]; none below `_MIN_AMPLITUDE_DEG`."""
    kept = [wave for wave in waves if wave.per_rev != per_rev]
    if amplitude >= _MIN_AMPLITUDE_DEG:
        kept.append(
            Harmonic(per_rev, math.radians(min(amplitude, 20.0)), math.radians(phase % 360.0))
        )
    return tuple(sorted(kept, key=lambda wave: wave.per_rev))


def _on_sliders(wave: Harmonic) -> Harmonic:
    """With the digits that the page shows."""
    size, phase = _polar(wave)
    return Harmonic(wave.per_rev, math.radians(size), math.radians(phase))


def _polar(wave: Harmonic) -> tuple[float, float]:
    """Amplitude and phase [°]."""
    return round(math.degrees(wave.amplitude), 2), round(math.degrees(wave.phase), 1) % 360.0


def _parts(waves: Sequence[Harmonic]) -> tuple[float, ...]:
    """Cosine and sine of each harmonic of the dial [°]."""
    sizes = {wave.per_rev: np.degrees(wave.amplitude) * np.exp(1j * wave.phase) for wave in waves}
    found = [complex(sizes.get(n, 0.0)) for n in HARMONICS]
    return tuple(round(part, 4) for size in found for part in (size.real, size.imag))


def _dot_words(dot: FrontDot) -> str:
    power = _spread("power", dot.power, dot.powers, 1)
    twist = harmonic_words(tuple(map(_on_sliders, dot.twist)), ())
    over = f"{power}, {_spread('vibration', dot.index, dot.over_inflows, 0)} over inflow models"
    return f"{over}: {twist}. Press to apply it, or drag along the curve."


def _spread(name: str, value: float, ends: tuple[float, float], digits: int) -> str:
    """A change with its ends over inflow models."""
    change, low, high = (number(one, digits, sign=True) for one in (value, *ends))
    return f"{name} {change} % ({low} to {high}{'' if ends[0] * ends[1] > 0.0 else ', unclear'})"


def front_chart(dots: Sequence[FrontDot]) -> Chart:
    """The front beside what other programmes reached, where power and vibration belong to one input."""
    shown = [
        result
        for result in programmes()
        if result.together and result.power_change_percent is not None
    ]
    powers = [
        0.0,
        *(end for dot in dots for end in dot.powers),
        *(one.power_change_percent or 0.0 for one in shown),
    ]
    most = max(40.0, *(1.15 * dot.index for dot in dots)) if dots else 40.0
    spreads = [
        Line("", (dot.power, dot.power), dot.over_inflows, _SPREAD, width=4.0) for dot in dots
    ]
    spreads += [Line("", dot.powers, (dot.index, dot.index), _SPREAD, width=4.0) for dot in dots]
    line = Line("", [dot.power for dot in dots], [dot.index for dot in dots], _BEST, width=1.4)
    best = (
        line,
        *(
            _pressed(dots, agreed)
            for agreed in (True, False)
            if agreed in {dot.agreed for dot in dots}
        ),
    )
    return Chart(
        "Vibration by power",
        Axis(
            "power [%]", (math.floor(min(-2.0, *powers) - 0.3), math.ceil(max(2.0, *powers) + 0.6))
        ),
        Axis("changes [%]", (-100.0, most), tuple(at for at in _VIBRATIONS if at < most)),
        (*spreads, _published(shown), *(best if dots else ())),
        (Rule(0.0, colour=_FAINT, dashes=""),),
    )


def _pressed(dots: Sequence[FrontDot], agreed: bool) -> Points:
    """The dots on whose sign all inflow models agree, which alone are called best, or the others."""
    chosen = [(k, dot) for k, dot in enumerate(dots) if dot.agreed == agreed]
    return Points(
        "models agree" if agreed else "models disagree",
        [dot.power for _, dot in chosen],
        [dot.index for _, dot in chosen],
        _BEST,
        "dot" if agreed else "ring",
        words=[_dot_words(dot) for _, dot in chosen],
        action="dial_front",
        press=[str(k) for k, _ in chosen],
        size=5.0,
    )


def _published(shown: Sequence[Programme]) -> Points:
    ends = [result.vibration_percent or (0.0, 0.0) for result in shown]
    return Points(
        "published, computed",
        [result.power_change_percent or 0.0 for result in shown],
        [0.5 * (low + high) for low, high in ends],
        "var(--rx-dim)",
        "ring",
        scatter=[0.5 * abs(high - low) for low, high in ends],
        words=[programme_words(result) for result in shown],
        size=4.5,
    )


def programme_words(result: Programme) -> str:
    """A published result in a sentence or two, with its source."""
    parts = [
        f"{result.name}: {result.control}, {'measured in ' if result.kind != 'computed' else ''}{result.kind}"
    ]
    if result.vibration_percent is not None:
        parts.append(f"{result.vibration} {_range(result.vibration_percent)}")
    if result.power_change_percent is not None:
        parts.append(f"power {number(result.power_change_percent, 1, sign=True)} %")
    apart = (
        ""
        if result.together or result.power_change_percent is None
        else " The two are separate best results."
    )
    return f"{', '.join(parts)}.{apart} {result.note} {result.source}."


def _range(ends: tuple[float, float]) -> str:
    low, high = (number(end, 0, sign=True) for end in ends)
    return f"{low} %" if low == high else f"{low} to {high} %"
