"""Fuel flow over power, of the engines in `assets/engines.toml`.

Power is that of the rotors: losses of gearboxes and accessories are not in it. At sea level; where a change of some
kilowatts is asked for, the slope of the curve counts, which is less than the specific consumption.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from rotor.assets import asset_path
from rotor.design.aircraft import Aircraft

HORSEPOWER = 745.699872
"""[W]"""
POUND = 0.45359237
"""[kg]"""


@dataclass(frozen=True)
class Engines:
    """The engines of one aircraft: fuel flow of each as a table or a polynomial over its shaft power."""

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
    """The engines of a shipped aircraft; None without a source for their fuel flow."""
    return _all().get(aircraft.key)


def fuel_caveats(aircraft: Aircraft) -> tuple[str, ...]:
    """What is not known of the fuel flow of an aircraft, in a sentence."""
    engines = engines_of(aircraft)
    if engines is None:
        return (f"No source for the fuel flow of the engines of {aircraft.name}: savings are told as power only.",)
    return (f"Fuel: {engines.caveat} ({engines.source}).",) if engines.caveat else ()


@cache
def _all() -> dict[str, Engines]:
    data = tomllib.loads(asset_path("engines.toml").read_text(encoding="utf-8"))
    return {key: _engines(row) for key, row in data.items()}


def _engines(row: dict[str, Any]) -> Engines:
    points = zip(row.get("power_hp", ()), row.get("flow_lb_h", ()), strict=True)
    return Engines(
        count=row["engines"],
        name=row["name"],
        table=tuple((HORSEPOWER * power, POUND / 3600.0 * flow) for power, flow in points),
        polynomial=tuple(row.get("polynomial_kg_s", ())),
        source=row["source"],
        caveat=row["caveat"],
    )
