"""A rotor on a test stand or in a wind tunnel: what is given there in place of weight and drag.

The rotor is fixed to its mount, which takes whatever force the rotor makes. In place of weight and drag the shaft's
tilt, the thrust or the collective, and the flapping are given; tip Mach number and air density are those of the test.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from rotor.design.quantities import LOAD_KEYS, STAND, Flapping

_BY_FIELD = {row.field: row for row in STAND.values()}
"""Quantities by field."""


@dataclass(frozen=True)
class Stand:
    """The inputs of a test; exactly one of thrust, ct_over_sigma and collective is given."""

    shaft_tilt: float | None = None
    """α [rad], positive forward; left out it is 0. A free rotor finds its tilt: there it is where the search
    starts."""
    thrust: float | None = None
    """Along the shaft [N]."""
    ct_over_sigma: float | None = None
    """The same over ρA(ΩR)²σ."""
    collective: float | None = None
    """Pitch at 0.75 R [rad]."""
    cyclic_1c: float = 0.0
    """Given cyclic [rad], used where the flapping is free."""
    cyclic_1s: float = 0.0
    flapping: Flapping = "trimmed"
    """`trimmed`: cyclic keeps first-harmonic flapping at its given value; `free`: the blades flap as they like;
    `hub-moments`: they do, and cyclic gives the hub the moments below."""
    hub_roll: float = 0.0
    """Moment of the rotor on its hub [N m], towards the retreating side."""
    hub_pitch: float = 0.0
    """The same nose up."""
    tip_mach: float | None = None
    """ΩR over the speed of sound; left out, that of the standard atmosphere."""
    density: float | None = None
    """Air density [kg/m³]; left out, that of the standard atmosphere."""

    def __post_init__(self) -> None:
        given = [name for name in LOAD_KEYS if getattr(self, STAND[name].field) is not None]
        if len(given) != 1:
            named = " and ".join(given) or "none of them"
            raise ValueError(f"a test stand is given {named}: give one of thrust_n, ct_over_sigma and collective_deg")
        for name, row in _BY_FIELD.items():
            value = getattr(self, name)
            if row.kind == "choice":
                row.check_choice(value)
            elif value is not None:
                row.check(row.shown(value))
        if self.flapping != "free" and (self.cyclic_1c or self.cyclic_1s):
            trims = "flapping" if self.flapping == "trimmed" else "hub moments"
            raise ValueError(f"cyclic is given, but it trims the {trims}: leave it out, or give flapping free")
        if self.flapping != "hub-moments" and (self.hub_roll or self.hub_pitch):
            raise ValueError("hub moments are given, but do not trim the rotor: give flapping hub-moments as well")

    def __str__(self) -> str:
        given = self.record().items()
        return ", ".join(f"{key} {value}" if isinstance(value, str) else f"{key} {value:.5g}" for key, value in given)

    @property
    def tilt(self) -> float:
        """The shaft tilt given [rad]."""
        return self.shaft_tilt or 0.0

    def record(self) -> dict[str, Any]:
        """For a design file: what is given, angles in degrees; `read_stand` reads it back."""
        values = ((_BY_FIELD[field.name], getattr(self, field.name)) for field in fields(self))
        return {row.name: row.shown(value) for row, value in values if value is not None and value != row.default}


def read_stand(record: Mapping[str, Any], trim: str) -> Stand:
    """The stand of a record with the keys of `Stand.record`, for one of `STAND_TRIMS`.

    Flapping that is not given is trimmed in a wind tunnel, and free otherwise. Raises ValueError with one sentence.
    """
    values: dict[str, Any] = {}
    for key, value in record.items():
        if key not in STAND:
            raise ValueError(f"test stand key {key!r} is not known: use {', '.join(STAND)}")
        row = STAND[key]
        if row.numeric and (isinstance(value, bool) or not isinstance(value, int | float)):
            raise ValueError(f"test stand key {key!r} is {value!r}: give a number")
        values[row.field] = row.si(value)
    values.setdefault("flapping", "trimmed" if trim == "wind-tunnel" else "free")
    return Stand(**values)
