"""The actuator as set: what it moves, costs and gives, as one value that every panel reads, and the card that says it.

Tip twist is that in flight, at the tip, nose up positive: what the actuator adds to the rotating blade
(`InstalledActuator.tip`). All changes count from one blade, `ActuatorInputs.against`.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from explorer.model.actuator_inputs import AGAINST
from explorer.model.units import Units, number
from explorer.parts.actuate import AssessedPart, Sign
from explorer.text.readout import mass_parts, needs_words
from explorer.views.actuated import Built, built, in_actuate
from explorer.views.dial_answer import HARMONICS, Fitted, compared
from explorer.views.now import Asked, Effect, Now, Panel, SetHand
from explorer.workers.call import Call
from rotor.actuator import ActuatorFlight, EffectInFlight, OtherStroke, PiezoPly, effect, other_stroke
from rotor.actuator.verdict import Against, count

_URGENCY, _STILL = 6, 1.0
"""Of what would make it pay, behind all verdicts' chosen one; how long the question must stand [s]."""


@dataclass(frozen=True)
class Change:
    """A change of power [W], more is positive, with its band by uncertain inputs, to both sides; None: not known."""

    power: float
    band: float | None


@dataclass(frozen=True, eq=False)
class Assessed:
    """The actuator as set. Angles [rad], powers [W]; None: not known yet, or not to be known."""

    one: Built
    tip: float
    """Tip twist now."""
    reach: tuple[float, float]
    """Tip twist at either end of the voltage."""
    wanted: float | None
    """Tip twist of least power in this flight, were the reach without end."""
    here: Change | None
    powers: tuple[float, ...]
    """Changes of power in this flight by inflow model, the design's own first."""
    vibration: tuple[float, ...]
    """Changes of the vibration index in this flight [%] by inflow model; empty: none is told here."""
    flight: Change | None
    """Mean over the mission, at its best twist."""
    line: OtherStroke | None
    """What another stroke and another mass would save over the mission."""

    @property
    def mass(self) -> float:
        """On board [kg]: of all blades, and the electronics."""
        return self.one.installed.masses.aircraft

    @property
    def range(self) -> float:
        """From one end of the reach to the other."""
        return self.one.installed.attainable

    @property
    def mass_that_pays(self) -> float | None:
        """With its twist [kg]; 0 where it would not pay without any mass."""
        return None if self.one.verdict is None else self.one.verdict.mass_allowed

    @property
    def range_that_pays(self) -> float | None:
        """With its mass; None where none does."""
        return None if self.line is None else self.line.twist_for(self.mass)

    @property
    def name(self) -> str:
        return self.one.installed.actuator.id.replace("_", " ")


def against_words(one: Built, against: Against) -> str:
    """The blade that changes count from."""
    if against == "best-fixed":
        return "best fixed blade"
    return "same blade without it" if one.question.host.kind == "retrofit" else "present blade"


def fitted(now: Now) -> Fitted | None:
    """The actuator on the blade, and the blade compared with; None where there is no actuator."""
    if (one := built(now)) is None:
        return None
    inputs = now.hand.actuator
    fixed = None if one.verdict is None else one.verdict.baseline.fixed_twist
    twist = one.design.twist if inputs.against == "same-blade" else fixed
    return Fitted(one.installed, inputs.volts(one.installed), twist, f"the {against_words(one, inputs.against)}")


def pair_compared(now: Now) -> Any:
    """What flies, and the blade compared with; None where not both are known."""
    if now.state is None or now.sliders is None or now.problem:
        return None
    return compared(now.state.solution.design, now.sliders, now.of(fitted))


def effect_asked(now: Now) -> Call | None:
    """The trims of what flies and of the blade compared with."""
    pair = now.of(pair_compared)
    return None if pair is None else Call(effect, pair)


def here(now: Now) -> EffectInFlight | str | None:
    """What the actuator changes in this flight, its drive included; or why that is not known."""
    found, on_blade = now.answers.get(now.of(effect_asked)), now.of(fitted)
    if not isinstance(found, EffectInFlight) or on_blade is None:
        return found
    losses = dict(zip(HARMONICS, on_blade.losses, strict=True))
    drive = sum(losses.get(one.per_rev, 0.0) * math.degrees(one.amplitude) ** 2 for one in now.inputs.twist_per_rev)
    verdict = one.verdict if (one := built(now)) is not None and now.hand.actuator.driven else None
    drive += 0.0 if verdict is None else verdict.drive.hold_power
    return EffectInFlight(tuple(power + drive for power in found.power), found.index, found.band)


def assessed(now: Now) -> Assessed | None:
    """One for all panels; None where the blade carries no actuator."""
    return now.of(_assessed)


def _assessed(now: Now) -> Assessed | None:
    if (one := built(now)) is None:
        return None
    inputs, verdict, changed = now.hand.actuator, one.verdict, now.of(here)
    known = changed if isinstance(changed, EffectInFlight) else None
    line, wanted = now.answers.get(now.of(_line_asked)), None
    if isinstance(one.flight, ActuatorFlight):
        speeds = [leg.advance_ratio for leg in one.legs]
        wanted = float(np.interp(now.inputs.advance_ratio, speeds, one.flight.wanted))
    return Assessed(
        one=one,
        tip=inputs.tip(one.installed),
        reach=inputs.reach(one.installed),
        wanted=wanted,
        here=None if known is None else Change(known.power[0], known.band),
        powers=() if known is None else known.power,
        vibration=() if known is None else known.index,
        flight=None if verdict is None else Change(-verdict.net_saving, verdict.net_band),
        line=line if isinstance(line, OtherStroke) else None,
    )


def _line_asked(now: Now) -> Call | None:
    verdict = None if (one := built(now)) is None else one.verdict
    return Call(other_stroke, (verdict,)) if verdict is not None and verdict.installed.masses.aircraft else None


def asks(now: Now) -> tuple[Asked, ...]:
    call = now.of(_line_asked)
    return (Asked(_URGENCY, () if call is None else (call,), _STILL),)


def range_words(low: float, high: float, digits: int, unit: str) -> str:
    return f"{number(low, digits, sign=True)}…{number(high, digits, sign=True)}{unit}"


def title(value: Assessed, now: Now) -> str:
    """What it is, and its drive as on the sliders."""
    installed, inputs = value.one.installed, now.hand.actuator
    side, drive = (" a side", "voltage") if isinstance(installed.actuator, PiezoPly) else ("", "drive")
    shares = ", ".join(number(100.0 * share) for share in inputs.drive_shares(installed))
    return f"{value.name}, {count(installed)}{side}, {f'at {shares} % of its {drive}' if inputs.driven else 'at rest'}"


def vibration_words(value: Assessed) -> str:
    """The change of vibration here, with its band over inflow models."""
    if not value.vibration:
        return "" if value.here is None else "no vibration is told here"
    low, high = min(value.vibration), max(value.vibration)
    return f"vibration {number(value.vibration[0], 0, sign=True)} % ({range_words(low, high, 0, '')})"


def pays_words(value: Assessed) -> tuple[str, str]:
    """The mass and the range with which it would pay; empty where there is none, or it is not known."""
    mass, wide = value.mass_that_pays, value.range_that_pays
    return (
        f"{number(mass, 0 if mass >= 10.0 else 1)} kg" if mass else "",
        f"{number(math.degrees(wide), 1)}°" if wide else "",
    )


def sentences(value: Assessed, units: Units) -> tuple[str, tuple[str, ...]]:
    """What it moves, costs and gives; and what would make it pay: words, and every second one a number to drag."""
    flight, total = value.flight, mass_parts(value.one.installed)["in all"]
    reach = range_words(*map(math.degrees, value.reach), 2, "°")
    powers = [
        (needs_words(-change.power, change.band, units), where)
        for change, where in ((value.here, "here"), (flight, "over the flight"))
        if change
    ]
    said = ", ".join(f"{words} {where}" for words, where in powers)
    if len({words.split()[0] for words, _ in powers}) == 1 and len(powers) == 2:  # One verb and unit serve both.
        bare = powers[1][0].partition(" ")[2].replace(f" {units.power[0].symbol}", "").replace(" more", "")
        said = f"{powers[0][0]} here, {bare} over the flight"
    moves = f"{value.name} moves the tip by {reach} in flight for {total}{': it ' if said else ''}{said}."
    mass, wide = pays_words(value)
    if flight is None or value.mass_that_pays is None:
        return moves, ()
    if not mass:
        return moves, ("It would not pay, however light.",)
    pays = f"It {'pays' if flight.power < 0.0 else 'would pay'} below "
    if wide:
        return moves, (pays, mass, ", or with a range of ", wide, ".")
    return moves, (pays, mass, "." if value.line is None else f"; no twist pays for {total}.")


def _kind(power: float | None) -> Sign:
    return "" if power is None else "loss" if power > 0.0 else "gain"


def card(now: Now) -> dict[str, AssessedPart | None]:
    """Three columns and the sentence, while the blade is out of the rotor."""
    value = assessed(now) if now.hand.lifted and in_actuate(now.ui) else None
    if value is None:
        return {} if now.hand.lifted and now.problem else {"assessed": None}
    one, units, inputs = value.one, now.units, now.hand.actuator
    *parts, (_, total) = mass_parts(one.installed).items()
    wanted = "" if value.wanted is None else f"{number(math.degrees(value.wanted), 2, sign=True)}°"
    here, flight, (said, pays) = value.here, value.flight, sentences(value, units)
    part = AssessedPart(
        title=title(value, now),
        tip=f"{number(math.degrees(value.tip), 2, sign=True)}°",
        reach=range_words(*map(math.degrees, value.reach), 2, "°"),
        wanted=wanted,
        mass=total,
        masses=tuple(parts),
        here="" if here is None else needs_words(-here.power, here.band, units),
        kind=_kind(None if here is None else here.power),
        flight="" if flight is None else needs_words(-flight.power, flight.band, units),
        vibration=vibration_words(value),
        problem=here_problem(now),
        against=inputs.against,
        baselines=tuple((each, against_words(one, each)) for each in AGAINST),
        said=said,
        pays=pays,
        range=round(math.degrees(value.range), 2),
        kilograms=round(value.mass, 1),
    )
    return {"assessed": part}


def here_problem(now: Now) -> str:
    """Why there is no verdict, or none in this flight; empty where there is one or it is on its way."""
    one, found = built(now), now.of(here)
    outcome = None if one is None else one.outcome
    return outcome if isinstance(outcome, str) else found if isinstance(found, str) else ""


def choose(now: Now, against: Against) -> tuple[Effect, ...]:
    """Count every change from this blade."""
    return (SetHand(actuator={"against": against}),) if against in AGAINST else ()


ASSESSED = Panel(card, in_actuate, asks, presses={"against": choose})
