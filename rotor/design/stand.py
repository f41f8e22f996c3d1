"""A rotor on a test stand or in a wind tunnel: what is given there in place of weight and drag.

The rotor is fixed to its mount, which takes whatever force the rotor makes. In place of weight and drag the shaft's
tilt, the thrust or the collective, and the flapping are given; tip Mach number and air density are those of the test.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

StandTrim = Literal["wind-tunnel", "free-rotor", "controls"]
STAND_TRIMS: tuple[StandTrim, ...] = get_args(StandTrim)
"""`wind-tunnel`: shaft tilt and thrust or collective given; `free-rotor`: no torque, collective or thrust given;
`controls`: collective, cyclic and shaft tilt given."""

LARGEST_CT_OVER_SIGMA = 0.25
"""Far beyond stall."""
Flapping = Literal["trimmed", "free", "hub-moments"]

_DEGREES = ("shaft_tilt", "collective", "cyclic_1c", "cyclic_1s")
"""Fields that are degrees in records and on the command line."""
_RECORD = {
    "shaft_tilt": "shaft_tilt_deg", "thrust": "thrust_n", "ct_over_sigma": "ct_over_sigma",
    "collective": "collective_deg", "cyclic_1c": "cyclic_1c_deg", "cyclic_1s": "cyclic_1s_deg", "flapping": "flapping",
    "hub_roll": "hub_roll_nm", "hub_pitch": "hub_pitch_nm", "tip_mach": "tip_mach", "density": "density_kg_m3",
}  # fmt: skip
"""Keys of a record, by field."""


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
        given = [name for name in ("thrust", "ct_over_sigma", "collective") if getattr(self, name) is not None]
        if len(given) != 1:
            named = " and ".join(_RECORD[name] for name in given) or "none of them"
            raise ValueError(f"a test stand is given {named}: give one of thrust_n, ct_over_sigma and collective_deg")
        limits = {
            "shaft_tilt": (-40.0, 40.0), "collective": (-30.0, 35.0), "cyclic_1c": (-30.0, 30.0),
            "cyclic_1s": (-30.0, 30.0), "thrust": (0.0, 2e6), "ct_over_sigma": (0.0, LARGEST_CT_OVER_SIGMA),
            "tip_mach": (0.02, 0.95), "density": (0.05, 3.0),
            "hub_roll": (-1e6, 1e6), "hub_pitch": (-1e6, 1e6),
        }  # fmt: skip
        for name, (low, high) in limits.items():
            value = getattr(self, name)
            shown = value if value is None or name not in _DEGREES else math.degrees(value)
            if shown is not None and not (math.isfinite(shown) and low - 1e-9 <= shown <= high + 1e-9):
                raise ValueError(f"{_RECORD[name]} {shown:g} is outside {low:g}…{high:g}: choose a value inside")
        if self.flapping not in get_args(Flapping):
            raise ValueError(f"flapping {self.flapping!r} is not known: use {', '.join(get_args(Flapping))}")
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
        plain = {"cyclic_1c": 0.0, "cyclic_1s": 0.0, "hub_roll": 0.0, "hub_pitch": 0.0}
        values = {name: getattr(self, name) for name in _RECORD}
        return {
            _RECORD[name]: math.degrees(value) if name in _DEGREES else value
            for name, value in values.items()
            if value is not None and value != plain.get(name)
        }


STAND_KEYS = tuple(_RECORD.values())
LOAD_KEYS = ("thrust_n", "ct_over_sigma", "collective_deg")
"""Of which one is given."""


def read_stand(record: Mapping[str, Any], trim: str) -> Stand:
    """The stand of a record with the keys of `Stand.record`, for one of `STAND_TRIMS`.

    Flapping that is not given is trimmed in a wind tunnel, and free otherwise. Raises ValueError with one sentence.
    """
    fields = {key: name for name, key in _RECORD.items()}
    values: dict[str, Any] = {}
    for key, value in record.items():
        if key not in fields:
            raise ValueError(f"test stand key {key!r} is not known: use {', '.join(fields)}")
        if key != "flapping" and (isinstance(value, bool) or not isinstance(value, int | float)):
            raise ValueError(f"test stand key {key!r} is {value!r}: give a number")
        values[fields[key]] = math.radians(value) if fields[key] in _DEGREES else value
    values.setdefault("flapping", "trimmed" if trim == "wind-tunnel" else "free")
    return Stand(**values)
