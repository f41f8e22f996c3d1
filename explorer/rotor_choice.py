"""The rotors of the page's menu, and the weights that the page offers for each."""

from functools import cache

from rotor.assets import SHIPPED_ROTORS
from rotor.design.aircraft import Aircraft
from rotor.files.rotor_file import shipped_aircraft

OWN = "own"
"""Name in `Inputs` of the user's own rotor."""
_LIGHTEST, _HEAVIEST = 0.6, 1.32
"""Ends of the weight slider over the rotor's reference mass."""


@cache
def menu_titles(own: Aircraft | None) -> dict[str, str]:
    """The menu: name in `Inputs` → title; the user's own rotor comes last."""
    titles = {name: shipped_aircraft(name).name for name in SHIPPED_ROTORS}
    return titles if own is None else {**titles, OWN: f"{own.name} (own)"}


def mass_range(aircraft: Aircraft) -> tuple[float, float, float]:
    """Lowest, highest and step of the weight slider [t], round numbers about the reference mass."""
    tonnes = aircraft.mass / 1e3
    step = 0.05 if tonnes > 3.0 else 0.01 if tonnes > 1.0 else 0.005
    low, high = (round(share * tonnes / step) for share in (_LIGHTEST, _HEAVIEST))
    return round(max(low * step, 0.1), 4), round(high * step, 4), step


def reference_mass_t(aircraft: Aircraft) -> float:
    """The reference mass [t], rounded, within the range of the weight slider."""
    low, high, _ = mass_range(aircraft)
    tonnes = aircraft.mass / 1e3
    return min(max(round(tonnes, 2 if tonnes > 1.0 else 3), low), high)
