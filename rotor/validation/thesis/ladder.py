"""From the preset `thesis` to the preset `flight`, one assumption at a time: how far each moves the best linear twist.

It begins with the reading of the thesis that holds most (`rotor.validation.thesis.readings`). The notebook
`docs/notebooks/09_three_questions.py` goes up it. Beside it the value of a twist that moves with speed, and the power
of twist −17.3° over −11.5° at 330 km/h, which was measured on another rotor (Keys et al. 1987, thesis p. 26, 28).
"""

import math
from collections.abc import Collection
from dataclasses import dataclass, replace

from rotor.airfoil.polynomial import THESIS_READING
from rotor.design.blade import with_airfoils
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.objective import Objective, WeightedCondition
from rotor.optimisation.search import Search, run_search
from rotor.trim.solve import solve
from rotor.validation.thesis.runs import CachedFunction

RUNGS = {
    "table": "section table at Mach 0.3 for polynomials",
    "mach": "section data follow the Mach number: drag rise",
    "wake": "lifting line for linear inflow, F on it",
    "cyclic": "trim by cyclic for free flapping",
    "axial": "µ sin α in U_P, eq. (3.6)",
    "blade": "blade as built: SC1094 R8, hinge, masses",
    "losses": "swirl, yawed drag, swept tip, download",
    "unsteady": "unsteady flow, dynamic stall, stall delayed by rotation",
    "elastic": "blade elastic in torsion",
}
"""Assumptions by name, in the order of the ladder: what takes the place of what."""
TRIM = ("cyclic", "axial")
"""Counted as one change too: the trim of an aircraft has both."""
SPEEDS = (0.0, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35)
STRONG, WEAK = -17.3, -11.5
"""Twists of Keys et al. [°], read per radius."""
HOVER, FAST, FAST_KMH = -0.024, 0.05, 330.0
"""Measured by Keys et al.: power of −17.3° over −11.5° in hover and at 330 km/h, as the thesis quotes it."""
_LOSSES = ("swirl", "radial_friction", "surface_drag", "swept_tip", "download", "tail_rotor_solved")
_LINEAR = find_concept("linear")


def rung_design(
    on: Collection[str], mu: float, twist: str = "linear:-16", inflow: str | None = None
) -> Design:
    """The UH-60A with these of `RUNGS`: none gives the power of the preset `thesis`, all are the preset `flight`."""
    thesis, flight = (
        make_design(preset=preset, twist=twist, mu=mu) for preset in ("thesis", "flight")
    )
    rotor = flight.rotor if "blade" in on else thesis.rotor
    if ("table" in on) != ("blade" in on):
        rotor = with_airfoils(rotor, ("sc1095" if "table" in on else THESIS_READING.name,), ())
    own, stated = flight.models, thesis.models
    models = replace(
        flight.models,
        inflow=inflow or (own if "wake" in on else stated).inflow,
        low_speed=(own if "wake" in on else stated).low_speed,
        loss_on=(own if "wake" in on else stated).loss_on,
        azimuths=(own if "wake" in on else stated).azimuths,
        # Equation (3.3) has one lift-curve slope, which a table over angle of attack does not.
        hover_inflow=(own if "table" in on else stated).hover_inflow,
        trim="propulsive" if "cyclic" in on else "thrust",
        disk_axial_flow="axial" in on,
        blade_weight="blade" in on,
        compressibility="mach" in on,
        unsteady="unsteady" in on,
        dynamic_stall="unsteady" in on,
        stall_delay="unsteady" in on,
        elastic_twist="elastic" in on,
        **dict.fromkeys(_LOSSES, "losses" in on),
    )
    return replace(flight, rotor=rotor, models=models)


@dataclass(frozen=True)
class LinearOptimum:
    """The linear twist of least total power at one speed."""

    mu: float
    rate_deg: float
    """[°/R]"""
    band_deg: tuple[float, float]
    """Within 0.1 % of that power."""
    power_kw: float


@dataclass(frozen=True)
class MovingTwist:
    """A linear twist that moves with speed, and what it saves beyond the best fixed one, equal time at each speed."""

    fixed_deg: float
    """[°/R]"""
    fixed_kw: float
    """Mean total power of the best fixed twist."""
    baseline_kw: float
    """Mean total power of a fixed −16°."""
    gain: float
    """What moving saves, as a part of the fixed blade's power."""


@CachedFunction
def linear_optimum(on: tuple[str, ...], mu: float, inflow: str | None) -> LinearOptimum:
    """The best linear twist; ValueError where the blade does not trim."""
    design = rung_design(on, mu, inflow=inflow)
    optimum = run_search(Search(design, _LINEAR, starts=2))
    if optimum.best is None:
        raise ValueError(
            f"no linear twist trims at advance ratio {mu:g} with {design.models.inflow}: leave it out"
        )
    band = (optimum.band[0].low, optimum.band[0].high) if optimum.band else (math.nan, math.nan)
    low, high = map(math.degrees, band)
    return LinearOptimum(
        mu, math.degrees(optimum.best.parameters[0]), (low, high), optimum.best.power / 1e3
    )


@CachedFunction
def moving_twist(on: tuple[str, ...], speeds: tuple[float, ...], inflow: str | None) -> MovingTwist:
    """The best fixed blade, and what moving saves beyond it; ValueError where it does not trim at all speeds."""
    moving = [linear_optimum(on, mu, inflow) for mu in speeds]
    design = rung_design(on, speeds[0], inflow=inflow)
    conditions = tuple(
        WeightedCondition(replace(design.condition, advance_ratio=mu)) for mu in speeds
    )
    guess = (math.radians(sum(least.rate_deg for least in moving) / len(moving)),)
    search = Search(
        design, _LINEAR, Objective("total", conditions), starts=1, guesses=(guess,), band=False
    )
    optimum = run_search(search)
    fixed, baseline = optimum.best, optimum.baseline_power
    if fixed is None or baseline is None:
        raise ValueError(
            f"no linear twist trims at all of {len(speeds)} advance ratios: leave the fastest out"
        )
    mean = 1e3 * sum(least.power_kw for least in moving) / len(moving)
    return MovingTwist(
        math.degrees(fixed.parameters[0]),
        fixed.power / 1e3,
        baseline / 1e3,
        1.0 - mean / fixed.power,
    )


@CachedFunction
def strong_over_weak(on: tuple[str, ...], kmh: float) -> float:
    """Part by which twist −17.3° needs more main-rotor power than −11.5°."""
    mu = kmh / 3.6 / make_design().rotor.tip_speed
    strong, weak = (
        solve(rung_design(on, mu, f"linear:{rate}")).require().power.main_rotor
        for rate in (STRONG, WEAK)
    )
    return strong / weak - 1.0
