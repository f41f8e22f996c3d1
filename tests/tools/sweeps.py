"""Sweeps of one slider in fine steps, drawn at random or given.

Power may bend along a sweep, but it may not jump, and no refusal may lie between trims that were accepted. There is no
command: `pytest tests/rotor/trim/test_smooth.py -m slow` runs them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotor import Design, Solution, make_design, solve
from rotor.design.quantities import CONDITION
from rotor.support.arrays import Array
from rotor.support.assets import SHIPPED_ROTORS
from rotor.trim import SolverOptions
from tests.tools.designs import draw

LARGEST_JUMP = 1.0
"""[kW] of a UH-60A; of another aircraft in proportion to its mass."""
_REFERENCE_MASS = 8322.0
STEPS = {
    "twist": (-20.0, 0.0, 0.25), "mu": (0.0, 0.42, 0.005), "mass_kg": (0.6, 1.4, 0.006),
    "altitude_m": (0.0, 4000.0, 50.0), "climb_m_s": (-10.0, 10.0, 0.2), "rotor_speed_percent": (110.0, 70.0, -0.5),
    "load_factor": (0.5, 2.0, 0.0125),
}  # fmt: skip
"""Sliders of the page, each from its easy end in its steps; mass over that of the aircraft, twist linear [°/R]."""
_ENOUGH = 3
"""Refusals in a row after which a sweep ends."""


@dataclass(frozen=True)
class Sweep:
    """Power along a sweep, (points,) [kW]; NaN where there is none."""

    name: str
    values: Array
    power: Array

    @property
    def jumps(self) -> Array:
        """By how much power jumps at each point, its trend taken away [kW].

        Twice the distance from the cubic through two neighbours on each side, which halves a step between two points.
        """
        p = self.power
        off = np.zeros_like(p)
        off[2:-2] = 2.0 * np.abs(p[2:-2] + (p[:-4] - 4.0 * p[1:-3] - 4.0 * p[3:-1] + p[4:]) / 6.0)
        return np.nan_to_num(off)

    @property
    def islands(self) -> int:
        """How many refusals have a trim on both sides."""
        found = np.flatnonzero(np.isfinite(self.power))
        return 0 if not len(found) else int(found[-1] - found[0] + 1 - len(found))

    def __str__(self) -> str:
        jumps = self.jumps
        at = int(jumps.argmax())
        return f"{self.name}: {jumps[at]:.3f} kW at {self.values[at]:g}, {self.islands} refusals between trims"


def largest_jump(design: Design) -> float:
    """[kW]"""
    return LARGEST_JUMP * max(design.aircraft.mass, 1000.0) / _REFERENCE_MASS


def values_of(design: Design, name: str) -> Array:
    """Of a slider, in its steps."""
    low, high, step = STEPS[name]
    values = np.linspace(low, high, round((high - low) / step) + 1)
    return values * design.aircraft.mass if name == "mass_kg" else values


def sweep(design: Design, name: str, values: Sequence[float] | Array | None = None) -> Sweep:
    """Power of a design over a slider, each trim from the one before as in a drag."""
    values = np.asarray(values_of(design, name) if values is None else values, dtype=float)
    before: Solution | None = None
    power = np.full(len(values), math.nan)
    for k, value in enumerate(values.tolist()):
        if k >= _ENOUGH and before is not None and not np.isfinite(power[k - _ENOUGH : k]).any():
            break
        at = (
            design.with_twist(f"linear:{value}")
            if name == "twist"
            else CONDITION[name].put(design, value)
        )
        before = solve(at, before, SolverOptions(remedy=False))
        if before.converged:
            power[k] = 1e-3 * before.power.total
    return Sweep(name, values, power)


def lasting_jump(design: Design, found: Sweep) -> tuple[float, float]:
    """The largest jump of a sweep [kW] and its place: one that a quarter of the step leaves as it is.

    Near the largest lift power bends so much that it is off the cubic through coarse steps.
    """
    largest, place = 0.0, math.nan
    step = found.values[1] - found.values[0]
    for k in np.flatnonzero(found.jumps > largest_jump(design)):
        fine = sweep(design, found.name, found.values[k] + 0.25 * step * np.arange(-6, 7))
        if fine.jumps.max() > largest:
            largest, place = float(fine.jumps.max()), float(found.values[k])
    return largest, place


def random_sweep(random: np.random.Generator) -> tuple[dict[str, object], Design, Sweep]:
    """A random design of a shipped rotor in flight, and twelve neighbouring places of one of its sliders."""
    while True:
        asked = draw(random, SHIPPED_ROTORS[int(random.integers(len(SHIPPED_ROTORS)))])
        asked = {
            name: value
            for name, value in asked.items()
            if name not in ("trim", "stand", "preset", "inflow")
        }
        design = make_design(**asked)
        if not design.aircraft.isolated and design.condition.stand is None:
            break
    name = tuple(STEPS)[int(random.integers(len(STEPS)))]
    values = values_of(design, name)
    first = int(random.integers(len(values) - 12))
    return asked, design, sweep(design, name, values[first : first + 12])
