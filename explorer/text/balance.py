"""What an actuator saves and costs, in words: one place for card, rail and report."""

from explorer.model.units import Units, number
from rotor.actuator import Verdict

_SECONDS = 3600.0


def signed(power: float, units: Units) -> str:
    """A saving [W] in the main unit, with one decimal."""
    return number(units.power[0].of(power), 1, sign=True)


def balance(verdict: Verdict) -> list[tuple[str, float]]:
    """Name and saving [W] of each part, and of what is left."""
    parts = [(name if not k else f"− {name}", power) for k, (name, power) in enumerate(verdict.savings)]
    return [*parts, ("= net", verdict.net_saving)]


def fuel_used(verdict: Verdict) -> float | None:
    """More fuel than without the actuator [kg/h]; None where the engines have no source."""
    return None if verdict.fuel_saving is None else -_SECONDS * verdict.fuel_saving


def fuel_words(verdict: Verdict) -> str:
    """That in words."""
    used = fuel_used(verdict)
    return "no source for fuel" if used is None else f"{number(used, 1, sign=True)} kg of fuel an hour"


def pair_words(verdict: Verdict) -> str:
    """The two flight conditions of a verdict."""
    first, second = verdict.baseline.pair.advance_ratios
    return f"mean of µ {first:g} and µ {second:g}"
