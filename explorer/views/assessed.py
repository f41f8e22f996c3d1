"""The actuator as set: what it moves, costs and gives, as one value that every panel reads, and the card that says it.

Tip twist is that in flight, at the tip, nose up positive: what the actuator adds to the rotating blade
(`InstalledActuator.tip`). All changes count from one blade, `ActuatorInputs.against`.
"""

import math
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, cast

import numpy as np

from explorer.model.actuator_inputs import AGAINST, ActuatorInputs
from explorer.model.units import Units, number
from explorer.parts.actuate import AssessedPart
from explorer.text.readout import mass_parts, needs_words
from explorer.views.actuated import ActuatedBlade, actuated_blade, blade_out
from explorer.views.dial_answer import HARMONICS, FittedBlade, compared
from explorer.views.page_state import Effect, PageState, Panel, Questions, SetHand
from explorer.workers.call import Call
from rotor.actuator import ActuatorFlight, EffectInFlight, OtherStroke, effect, other_stroke, powers
from rotor.actuator.verdict import Against
from rotor.trim.doubt import sureness

_URGENCY, _STILL = 6, 1.0
"""Of what would make it pay, behind all verdicts' chosen one; how long the question must stand [s]."""


class PowerChange(NamedTuple):
    """A change of power [W], more is positive, and its band by uncertain inputs, to both sides; None: not known."""

    power: float
    band: float | None

    @property
    def kind(self) -> Literal["gain", "loss", ""]:
        """Empty where its sign is unclear."""
        if self.band is not None and sureness(self.power, self.band) == "unclear":
            return ""
        return "loss" if self.power > 0.0 else "gain"


@dataclass(frozen=True, eq=False)
class Assessment:
    """The actuator as set. Twists of the tip in flight [rad]; None: not known.

    `reach`: at either end of the voltage; `wanted`: of least power in this flight. `here`: in this flight, `vibration`
    [%] by inflow model, empty where none is told. `flight`: mean over the mission, at its best twist; `line`: with
    another range and mass.
    """

    one: ActuatedBlade
    tip: float
    reach: tuple[float, float]
    wanted: float | None
    here: PowerChange | None
    vibration: tuple[float, ...]
    flight: PowerChange | None
    line: OtherStroke | None

    @property
    def name(self) -> str:
        return self.one.installed.actuator.id.replace("_", " ")

    @property
    def mass(self) -> float:
        """On board [kg]: of all blades, and the electronics."""
        return self.one.installed.masses.aircraft

    @property
    def range(self) -> float:
        """From one end of the reach to the other."""
        return self.one.installed.attainable


def against_words(one: ActuatedBlade, against: Against) -> str:
    """The blade that changes count from."""
    if against == "best-fixed":
        return "best fixed blade"
    return "same blade without it" if one.question.host.kind == "retrofit" else "present blade"


def fitted(now: PageState) -> FittedBlade | None:
    """The actuator on the blade, and the blade compared with; None where there is no actuator."""
    if (one := actuated_blade(now)) is None:
        return None
    inputs = now.hand.actuator
    fixed = None if one.verdict is None else one.verdict.baseline.fixed_twist
    twist = one.design.twist if inputs.against == "same-blade" else fixed
    return FittedBlade(
        one.installed, inputs.driven_at(one.installed), twist, f"the {against_words(one, inputs.against)}"
    )


def pair_compared(now: PageState) -> Any:
    """What flies, and the blade compared with; None where not both are known."""
    if now.state is None or now.sliders is None or now.problem:
        return None
    return compared(now.state.solution.design, now.sliders, now.of(fitted))


def effect_asked(now: PageState) -> Call | None:
    """The trims of what flies and of the blade compared with."""
    pair = now.of(pair_compared)
    return None if pair is None else Call(effect, pair)


def change_here(now: PageState) -> EffectInFlight | str | None:
    """What the actuator changes in this flight, its drive included; or why that is not known."""
    found, on_blade = now.answers.get(now.of(effect_asked)), now.of(fitted)
    if not isinstance(found, EffectInFlight) or on_blade is None:
        return found
    drive = _drive(now, on_blade)
    return EffectInFlight(tuple(power + drive for power in found.power), found.index, found.band)


def _drive(now: PageState, on_blade: FittedBlade) -> float:
    """Power that the drive takes in this flight [W]."""
    losses = dict(zip(HARMONICS, on_blade.losses, strict=True))
    drive = sum(losses.get(one.per_rev, 0.0) * math.degrees(one.amplitude) ** 2 for one in now.inputs.twist_per_rev)
    verdict = one.verdict if (one := actuated_blade(now)) is not None and now.hand.actuator.driven else None
    return drive + (0.0 if verdict is None else verdict.drive.hold_power)


def parts_asked(now: PageState) -> Call | None:
    """Trims of the blade compared with, with the twist, and with the stiffness too; None where not all are known."""
    pair, one = now.of(pair_compared), actuated_blade(now)
    if pair is None or one is None or now.state is None or now.sliders is None:
        return None
    twisted, _ = compared(now.state.solution.design, now.sliders, None) or pair
    return Call(powers, ((pair[1], twisted, one.installed.on(twisted)),))


def parts_here(now: PageState) -> tuple[tuple[str, float], ...]:
    """Name and saving [W] of each part in this flight, as `Verdict.savings`; their sum is that of `change_here`."""
    found, on_blade, known = now.answers.get(now.of(parts_asked)), now.of(fitted), now.of(change_here)
    if not isinstance(found, tuple) or on_blade is None or not isinstance(known, EffectInFlight):
        return ()
    bare, twisted, stiff = cast("tuple[float, float, float]", found)
    drive = _drive(now, on_blade)
    stiffness = (("stiffness", twisted - stiff),) if twisted != stiff else ()
    return (
        ("gross", bare - twisted),
        *stiffness,
        ("mass", stiff - bare - known.power[0] + drive),
        ("drive", 0.0 - drive),
    )


def assessment(now: PageState) -> Assessment | None:
    """One for all panels; None where the blade carries no actuator."""
    return now.of(_assessment)


def _assessment(now: PageState) -> Assessment | None:
    if (one := actuated_blade(now)) is None:
        return None
    inputs, verdict, changed = now.hand.actuator, one.verdict, now.of(change_here)
    known = changed if isinstance(changed, EffectInFlight) else None
    line, wanted = now.answers.get(now.of(_line_asked)), None
    if isinstance(one.flight, ActuatorFlight):
        speeds = [leg.advance_ratio for leg in one.legs]
        wanted = float(np.interp(now.inputs.advance_ratio, speeds, one.flight.wanted))
    return Assessment(
        one=one,
        tip=inputs.tip(one.installed),
        reach=inputs.reach(one.installed),
        wanted=wanted,
        here=None if known is None else PowerChange(known.power[0], known.band),
        vibration=() if known is None else known.index,
        flight=None if verdict is None else PowerChange(-verdict.net_saving, verdict.net_band),
        line=line if isinstance(line, OtherStroke) else None,
    )


def _line_asked(now: PageState) -> Call | None:
    verdict = None if (one := actuated_blade(now)) is None else one.verdict
    return Call(other_stroke, (verdict,)) if verdict is not None and verdict.installed.masses.aircraft else None


def asks(now: PageState) -> tuple[Questions, ...]:
    call = now.of(_line_asked)
    return (Questions(_URGENCY, () if call is None else (call,), _STILL),)


def _angle(radians: float) -> str:
    return f"{number(math.degrees(radians), 2, sign=True)}°"


def _reach(value: Assessment) -> str:
    return "…".join(map(_angle, value.reach)).replace("°…", "…")


def _title(value: Assessment, inputs: ActuatorInputs) -> str:
    """What it is, and its drive as on the sliders."""
    installed = value.one.installed
    shares = ", ".join(number(100.0 * share) for share in inputs.drive_shares(installed))
    driven = f"at {shares} % of its {installed.actuator.drive_noun}" if inputs.driven else "at rest"
    return f"{value.name}, {installed.count}{installed.actuator.a_side}, {driven}"


def _vibration(value: Assessment) -> str:
    """The change of vibration here, with its band over inflow models."""
    if not value.vibration:
        return "" if value.here is None else "no vibration data here"
    told = value.vibration[0], min(value.vibration), max(value.vibration)
    own, low, high = (number(change, 0, sign=True) for change in told)
    if told[1] * told[2] <= 0.0:
        return f"vibration unclear ({low}…{high} %)"
    return f"vibration {own} % ({low}…{high})"


def _sentences(value: Assessment, units: Units) -> tuple[str, tuple[str, ...]]:
    """What it moves, costs and gives; and what would make it pay: words, and every second one a number to drag."""
    total, flight, verdict = mass_parts(value.one.installed)["in all"], value.flight, value.one.verdict
    known = [change for change in (value.here, flight) if change]
    powers = [needs_words(-change.power, change.band, units) for change in known]
    if len(powers) == 2 and known[0].power * known[1].power > 0.0:  # One verb and one unit serve both.
        powers[1] = powers[1].partition(" ")[2].replace(f" {units.power[0].symbol}", "").replace(" more", "")
    places = (["here"] if value.here else []) + ["over the flight"]
    said = ", ".join(f"{power} {place}" for power, place in zip(powers, places, strict=False))
    moves = f"{value.name} moves the tip by {_reach(value)} in flight for {total}{': it ' if said else ''}{said}."
    mass = None if verdict is None else verdict.mass_allowed
    if flight is None or mass is None:
        return moves, ()
    if not mass:
        return moves, ("It would not pay, however light.",)
    wide = None if value.line is None else value.line.twist_for(value.mass)
    pays = f"It {'pays' if flight.power < 0.0 else 'would pay'} below ", f"{number(mass, 0 if mass >= 10.0 else 1)} kg"
    if wide is not None:
        return moves, (*pays, " or with a range above ", f"{number(math.degrees(wide), 1)}°", ".")
    return moves, (*pays, "." if value.line is None else f"; no twist pays at {total}.")


def card(now: PageState) -> dict[str, AssessedPart | None]:
    """Three columns and the sentence."""
    if (value := assessment(now)) is None:
        return {} if now.problem else {"assessed": None}
    one, units, against = value.one, now.units, now.hand.actuator.against
    *parts, (_, total) = mass_parts(one.installed).items()
    said, pays = _sentences(value, units)
    both = value.here, value.flight
    here, flight = ("" if each is None else needs_words(-each.power, each.band, units) for each in both)
    part = AssessedPart(
        title=_title(value, now.hand.actuator),
        tip=_angle(value.tip),
        reach=_reach(value),
        wanted="" if value.wanted is None else _angle(value.wanted),
        mass=total,
        masses=tuple(parts),
        here=here,
        kind="" if value.here is None else value.here.kind,
        flight=flight,
        vibration=_vibration(value),
        problem=here_problem(now),
        against=against,
        baselines=tuple((each, against_words(one, each)) for each in AGAINST),
        said=said,
        pays=pays,
        range=round(math.degrees(value.range), 2),
        kilograms=round(value.mass, 1),
    )
    return {"assessed": part}


def here_problem(now: PageState) -> str:
    """Why there is no verdict, or none in this flight; empty where there is one or it is on its way."""
    one, found = actuated_blade(now), now.of(change_here)
    outcome = None if one is None else one.outcome
    return outcome if isinstance(outcome, str) else found if isinstance(found, str) else ""


def choose(now: PageState, against: Against) -> tuple[Effect, ...]:
    """Count every change from this blade."""
    return (SetHand(actuator={"against": against}),) if against in AGAINST else ()


ACTUATOR_CARD = Panel(card, blade_out, asks, presses={"against": choose})
