"""What the data files say: actuators, engines of the shipped aircraft, and what published programmes reached."""

from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, TypeVar

import numpy as np

from rotor.actuator.kind import Actuator, DataProvenance, in_si
from rotor.actuator.laminate import ExtensionTwist
from rotor.actuator.ply import PiezoPly
from rotor.actuator.tube import TorqueTube
from rotor.design.aircraft import Aircraft
from rotor.support.assets import toml_asset
from rotor.support.user_input import check_known

STEPS = (
    "numerical studies",
    "small-scale tests",
    "full-scale wind tunnel",
    "demonstrator",
    "production",
)
"""Steps of development, from 1. Source: Burke & Gatto, Review of Rotary-Wing Morphing Actuation Systems,
Aerospace 13(3) 297, 2026."""


KINDS: dict[str, type[Actuator]] = {
    "ply": PiezoPly,
    "tube": TorqueTube,
    "extension_twist": ExtensionTwist,
}
"""By their tables in the data file."""
K = TypeVar("K", bound=Actuator)


def actuators_of_kind(kind: type[K]) -> dict[str, K]:
    """All actuators of a kind by id."""
    table = next(name for name, known in KINDS.items() if known is kind)
    rows = map(in_si, toml_asset("actuators.toml")[table])
    return {row["id"]: kind.read({**row, **_shared(row)}) for row in rows}


def _shared(row: dict[str, Any]) -> dict[str, Any]:
    """Of the fields that all kinds have, those that are no keys."""
    recalled, assumed = tuple(row["recalled"]), tuple(row["assumed"])
    provenance = DataProvenance(row["source"], recalled, assumed, row["readiness"], row["tested"])
    ends = (row["temperature_min"], row["temperature_max"]) if "temperature_min" in row else None
    return {"provenance": provenance, "temperature_range": ends}


@cache
def actuators() -> dict[str, Actuator]:
    """All actuators by id, in the order of the kinds."""
    return {
        id: actuator for kind in KINDS.values() for id, actuator in actuators_of_kind(kind).items()
    }


def find_actuator(id: str) -> Actuator:
    """The actuator with this id; ValueError lists the known ids for any other."""
    check_known("actuator", id, actuators())
    return actuators()[id]


HORSEPOWER = 745.699872
"""[W]"""
POUND = 0.45359237
"""[kg]"""


@dataclass(frozen=True)
class Engines:
    """The engines of one aircraft: fuel flow of each over its shaft power, as a table or a polynomial.

    Power is that of the rotors: losses of gearboxes and accessories are not in it. At sea level; where a change of some
    kilowatts is asked for, the slope of the curve counts, which is less than the specific consumption.
    """

    count: int
    name: str
    table: tuple[tuple[float, float], ...]
    """(power [W], flow [kg/s]), rising; straight lines between and beyond. Empty: the polynomial counts."""
    polynomial: tuple[float, ...]
    """Flow [kg/s] over power [hp], lowest power first."""
    source: str
    caveat: str
    """What the numbers are not; empty for those of the engine itself."""

    def flow(self, power: float) -> float:
        """Fuel flow of all engines [kg/s] at the power of the rotors [W], shared evenly; no fuel is given back."""
        each = max(power, 0.0) / self.count
        if not self.table:
            return self.count * float(np.polynomial.Polynomial(self.polynomial)(each / HORSEPOWER))
        x, y = np.array(self.table).T
        k = int(np.clip(np.searchsorted(x, each) - 1, 0, len(x) - 2))
        slope = (y[k + 1] - y[k]) / (x[k + 1] - x[k])
        return self.count * float(y[k] + slope * (each - x[k]))


def engines_of(aircraft: Aircraft) -> Engines | None:
    """The engines of a shipped aircraft; None if their fuel flow has no source."""
    row = toml_asset("engines.toml").get(aircraft.key)
    if row is None:
        return None
    points = zip(row.get("power_hp", ()), row.get("flow_lb_h", ()), strict=True)
    return Engines(
        count=row["engines"],
        name=row["name"],
        table=tuple((HORSEPOWER * power, POUND / 3600.0 * flow) for power, flow in points),
        polynomial=tuple(row.get("polynomial_kg_s", ())),
        source=row["source"],
        caveat=row["caveat"],
    )


def fuel_caveats(aircraft: Aircraft) -> tuple[str, ...]:
    """A sentence on what is unknown about the aircraft's fuel flow."""
    engines = engines_of(aircraft)
    if engines is None:
        return (
            f"The fuel flow of the {aircraft.name} engines has no source, so savings are given as power only.",
        )
    return (f"Fuel: {engines.caveat} ({engines.source}).",) if engines.caveat else ()


Control = Literal["active twist", "root pitch", "trailing-edge flap"]
Evidence = Literal["computed", "wind tunnel", "flight"]


@dataclass(frozen=True, kw_only=True)
class Programme:
    """One published result. Changes are against the same rotor without active control [%]; None: not stated."""

    name: str
    short: str
    """For a label beside a point."""
    rotor: str
    control: Control
    kind: Evidence
    per_rev: tuple[int, ...] = ()
    """Harmonics driven; empty where the text does not say."""
    amplitude_deg: tuple[float, float] | None = None
    """Lowest and highest, at the tip or at the root, as `control` says."""
    vibration_percent: tuple[float, float] | None = None
    """Lowest and highest change; negative is less vibration."""
    vibration: str = ""
    """Which measure of vibration that is; empty without one."""
    power_percent: float | None = None
    """Change of rotor power as stated; negative is less."""
    lift_to_drag_percent: float | None = None
    """Change of the rotor's effective lift-to-drag ratio as stated; positive is better."""
    together: bool
    """Whether vibration and power belong to the same input at the same condition."""
    grade: str
    """P authors' own text, S press or another text that quotes them, T quoted by the source document."""
    source: str
    note: str

    @property
    def power_change_percent(self) -> float | None:
        """Change of power [%]: as stated, else that of L/D turned into power at the same lift and speed.

        P ∝ 1/(L/D), so ΔP/P = 1/(1 + ΔL/D) − 1; it counts the rotor's propulsive force as power.
        """
        if self.power_percent is not None or self.lift_to_drag_percent is None:
            return self.power_percent
        return 100.0 * (1.0 / (1.0 + 0.01 * self.lift_to_drag_percent) - 1.0)


@cache
def programmes() -> tuple[Programme, ...]:
    """All published results, in the order of the data file."""
    return tuple(_programme(row) for row in toml_asset("active_twist_programmes.toml")["programme"])


def _programme(row: dict[str, Any]) -> Programme:
    ranges = ("per_rev", "amplitude_deg", "vibration_percent")
    pairs: dict[str, Any] = {key: tuple(row[key]) for key in ranges if key in row}
    return Programme(**(row | pairs))
