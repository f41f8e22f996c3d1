"""What an actuator would have to be: the break-even line of twist, mass and drive.

The line knows no blade structure, so it holds for any rotor: twist is linear along the blade, its range is
used over all legs, the mass lies evenly on the blades over the span where plies would be. With the range x and
the mass m of all blades together

    net(x, m, W) = gross(x) − cost(m) − W,   gross(x) = P_fixed − min over θ of Σ_k s_k P_k(θ_k),   θ ≤ θ_k ≤ θ + x

and the line is where net = 0. P_fixed is the best fixed blade, s_k the share of time of a leg, θ_k the twist within the
range that is nearest to the leg's own optimum. A ply over part of the span, or on
a softer blade, saves more or less than its tip twist would along the whole blade.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from rotor.actuator.optimum import Baseline, baseline, best_actuated, widest_changes
from rotor.actuator.section import default_placement
from rotor.actuator.verdict import Verdict
from rotor.design.design import Design
from rotor.design.uncertain import UNCERTAIN
from rotor.dynamics.structure import heavier
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.doubt import difference_doubt
from rotor.optimisation.mission import Mission
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache
from rotor.support.chart import Axis, Chart, Line
from rotor.support.units import GRAVITY
from rotor.trim.doubt import Doubt, banded
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

LINE_POINTS = 9
"""Points of the break-even line, zero included."""
WANTED_SHARE = 0.9
"""Share of the ideal saving that a requirement asks for: the last tenth takes twist without end."""
MIN_SAVING_SHARE = 1e-4
"""Least ideal saving, over power, that an actuator is looked for."""


@dataclass(frozen=True)
class Requirement:
    """An actuator that just breaks even, its mass and its drive each costing half of what its twist saves."""

    twist: float
    """Range of the tip relative to the root [rad]."""
    mass: float
    """Mass of the actuators on all blades and their electronics [kg]."""
    drive: float
    """Held all the time [W]."""


@dataclass(frozen=True, eq=False)
class BreakEven:
    """Where an actuator of linear twist begins to pay on one rotor; arrays are (points,), twist ascending from zero."""

    mission: Mission
    fixed_power: float
    """Mean of the best fixed blade [W]."""
    change: float
    """Widest between the optima of two legs, tip relative to root, signed [rad]; the last of `twists` is its size."""
    twists: Array
    """Range of the tip relative to the root [rad]."""
    gross: Array
    """Saving before mass and drive [W]."""
    rates: Array
    """Linear twist on each leg [rad per radius], (points, legs)."""
    masses: Array
    """Mass of all blades whose carrying costs as much as the twist saves [kg]."""
    ideal_band: float
    """Uncertainty of `ideal_saving`, ± [W]."""

    @property
    def ideal_saving(self) -> float:
        """Saving of unlimited twist [W]."""
        return float(self.gross[-1])

    @property
    def worthwhile(self) -> bool:
        """Whether unlimited twist saves enough to be worth a search."""
        return self.ideal_saving > MIN_SAVING_SHARE * self.fixed_power

    def saving(self, twist: float) -> float:
        """Gross saving of a range of twist [W], interpolated linearly between trims."""
        return float(np.interp(twist, self.twists, self.gross))

    def twist_for(self, saving: float) -> float:
        """Range of linear twist that saves this much [rad]; 0 for a loss, the whole range beyond the ideal saving."""
        return float(np.interp(saving, self.gross, self.twists))

    def cost(self, mass: float) -> float:
        """Power that carrying a mass costs [W]; extrapolated with the last slope."""
        x, y = self.masses, self.gross
        if mass <= x[-1]:
            return float(np.interp(mass, x, y))
        return float(y[-1] + (mass - x[-1]) * (y[-1] - y[-2]) / (x[-1] - x[-2]))

    def net(self, twist: float, mass: float, watts: float = 0.0) -> float:
        """Net saving [W] of a range [rad], a mass of all blades [kg] and a drive power [W]."""
        return self.saving(twist) - self.cost(mass) - watts

    def mass_allowed(self, twist: float, watts: float = 0.0) -> float:
        """Mass on all blades at which the actuator breaks even [kg]; 0 where the drive alone costs more than is
        saved."""
        return float(np.interp(self.saving(twist) - watts, self.gross, self.masses))

    @property
    def requirement(self) -> Requirement:
        """The twist that gives most of the ideal saving, and the mass and drive that share this saving evenly."""
        wanted = WANTED_SHARE * self.ideal_saving
        twist = self.twist_for(wanted)
        return Requirement(twist, self.mass_allowed(twist, 0.5 * wanted), 0.5 * wanted)


@bytes_cache
@read_only
def break_even(mission: Mission) -> BreakEven:
    """The break-even line of any rotor over a mission, by searches.

    Raises RuntimeError with one sentence where nothing trims.
    """
    base = baseline(mission, find_concept("linear"))
    best = np.array([optimum.values[0] for optimum in base.best])
    root = mission.design.rotor.blade.root_cutout
    largest = float(widest_changes(best[:, None])[0])
    twists = np.linspace(0.0, abs(largest), LINE_POINTS)
    task = _Flown(base)
    gross = np.zeros(LINE_POINTS)
    masses = np.zeros(LINE_POINTS)
    rates = np.full((LINE_POINTS, len(best)), base.fixed.values[0])
    for k in range(1, LINE_POINTS):
        rates[k], power = task.best(best, float(twists[k]))
        gross[k] = max(base.fixed.power - power, float(gross[k - 1]))
        masses[k] = task.mass(rates[k], base.fixed.power, float(masses[k - 1]))
    span = 1.0 - root
    ideal = difference_doubt(
        mission.shares, [optimum.solutions[0] for optimum in base.best], base.fixed.solutions
    )
    assert ideal is not None
    within = ideal.change_band or 0.0
    return BreakEven(
        mission, base.fixed.power, span * largest, span * twists, gross, rates, masses, within
    )


class _Flown:
    """Mean power of a linear twist that differs from leg to leg; each trim starts from the one before."""

    def __init__(self, base: Baseline) -> None:
        self.base = base
        self.mission = base.mission
        self.trims: tuple[Solution | None, ...] = (None,) * len(base.best)

    def power(self, rates: Array, mass: float = 0.0) -> float:
        """With a mass on all blades together [kg]."""
        designs = [
            self.base.concept.apply(one, [rate])
            for one, rate in zip(self.mission.designs(), rates.tolist(), strict=True)
        ]
        trims = tuple(
            solve(with_mass(design, mass), near).require()
            for design, near in zip(designs, self.trims, strict=True)
        )
        self.trims = trims
        return self.mission.mean(trim.power.total for trim in trims)

    def best(self, optima: Array, reach: float) -> tuple[Array, float]:
        """The rates of least power within some range of each other, and that power; `optima`: each leg's own."""
        search = minimize_scalar(
            lambda low: self.power(np.clip(optima, low, low + reach)),
            bounds=(float(optima.min()) - 0.01, float(optima.max()) - reach + 0.01),
            method="bounded",
            options={"xatol": 1e-5},
        )
        return np.clip(optima, search.x, search.x + reach), float(search.fun)

    def mass(self, rates: Array, target: float, start: float) -> float:
        """The mass with which that twist takes the target power [kg], by secants."""
        a, b = start, start + max(1.0, 1e-3 * self.mission.design.condition.mass)
        fa, fb = self.power(rates, a) - target, self.power(rates, b) - target
        for _ in range(12):
            a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
            fb = self.power(rates, b) - target
            if abs(fb) < 1e-3:
                break
        return max(b, 0.0)


def with_mass(design: Design, mass: float) -> Design:
    """The design with a mass [kg] spread evenly on all blades over the span where plies would be.

    On a test stand, which has no weight, the rotor makes so much more thrust; ValueError where its collective is given.
    """
    if not mass:
        return design
    low, high = (end * design.rotor.radius for end in default_placement().span)
    condition = replace(design.condition, mass=design.condition.mass + mass)
    rotor = heavier(design.rotor, mass / design.rotor.blades, (low, high))
    loaded, stand = replace(design, rotor=rotor, condition=condition), design.condition.stand
    if stand is None:
        return loaded
    weight = GRAVITY * mass
    if stand.thrust is not None:
        more = replace(stand, thrust=stand.thrust + weight)
    elif stand.ct_over_sigma is not None:
        loading = weight / (design.thrust_unit * design.rotor.solidity)
        more = replace(stand, ct_over_sigma=stand.ct_over_sigma + loading)
    else:
        raise ValueError(
            "the collective is given, so the rotor carries no set weight: give a thrust instead"
        )
    return replace(loaded, condition=replace(loaded.condition, stand=more))


@dataclass(frozen=True, eq=False)
class OtherStroke:
    """What the actuator of a verdict would save with another stroke and another mass, by the rules of the verdict.

    Stiffness, shape and drive are its own, so that its own stroke and mass save what the verdict says.
    """

    twists: Array
    """Range of the tip in flight, ascending from none [rad], (strokes,)."""
    saved: Array
    """Before its mass [W], (strokes,); never falling."""
    per_kg: float
    """Power that a kilogram on board costs [W]."""
    changes: Array
    """What each uncertain input adds to the power with each stroke, before its mass [W], (inputs, strokes)."""
    changes_per_kg: Array
    """And to `per_kg` [W], (inputs,)."""

    def net(self, twist: float, mass: float) -> float:
        """Net saving of a range of twist [rad] and a mass on all blades [kg]; twist beyond the line's range is not
        used."""
        return float(np.interp(twist, self.twists, self.saved)) - self.per_kg * mass

    def band(self, twist: float, mass: float) -> float:
        """Uncertainty of `net`, ± [W]."""
        rows: list[Array] = list(self.changes)
        at = [float(np.interp(twist, self.twists, row)) for row in rows]
        return float(np.linalg.norm(np.array(at) + self.changes_per_kg * mass))

    def mass_allowed(self, twist: float) -> float:
        """Mass on all blades at which it breaks even [kg]; 0 where the twist alone costs more than it saves."""
        return max(0.0, self.net(twist, 0.0) / self.per_kg)

    def twist_for(self, mass: float) -> float | None:
        """Smallest range of twist [rad] that pays for a mass on all blades [kg]; None if none does."""
        cost = self.per_kg * mass
        return float(np.interp(cost, self.saved, self.twists)) if cost <= self.saved[-1] else None


OTHER_STROKES = (0.5, 2.0, 4.0)
"""Of the actuator's own, beside none and all of it."""


def other_stroke(verdict: Verdict) -> OtherStroke:
    """The break-even line of a verdict: an optimum over the same flights for each of `OTHER_STROKES`.

    ValueError for an actuator that has no mass, RuntimeError where nothing trims.
    """
    installed, base = verdict.installed, verdict.baseline
    mass = installed.masses.aircraft
    if not mass:
        raise ValueError(
            f"{installed.actuator.name} adds no mass, so no break-even mass applies: choose another actuator"
        )
    powers = {0.0: verdict.resting.power, 1.0: verdict.optimum.power}
    flown = verdict.optimum.solutions
    if not flown:  # The trims were left behind.
        flown = best_actuated(
            base.mission, base.concept, installed, starts=[verdict.optimum.values]
        ).solutions
    reference = _trims(base, flown, fixed=verdict.against == "best-fixed")
    resting = _resting_trims(verdict, flown)
    doubts = {0.0: difference_doubt(base.mission.shares, resting, reference)}
    start = [verdict.resting.values]
    near = flown
    for stroke in OTHER_STROKES:
        found = best_actuated(
            base.mission, base.concept, installed, scale=stroke, starts=start, near=near
        )
        powers[stroke] = found.power
        near = found.solutions
        doubts[stroke] = difference_doubt(base.mission.shares, near, reference)
    strokes = sorted(powers)
    least = [min(strokes[: k + 1], key=lambda stroke: powers[stroke]) for k in range(len(strokes))]
    saved = np.array(
        [verdict.reference_power - verdict.drive.hold_power - powers[stroke] for stroke in least]
    )
    twists, per_kg = np.array(strokes) * installed.attainable, verdict.mass_cost / mass
    carried = _changes(verdict.parts_doubt["mass"])
    changes = {stroke: _changes(doubt) for stroke, doubt in doubts.items()}
    changes[1.0] = _changes(verdict.doubt) - carried
    return OtherStroke(
        twists, saved, per_kg, np.array([changes[stroke] for stroke in least]).T, carried / mass
    )


def _resting_trims(verdict: Verdict, near: Sequence[Solution]) -> Sequence[Solution]:
    """Trims of the blade of a verdict with its actuator at rest, without its mass; `near`: trims to start from."""
    base = verdict.baseline
    installed = verdict.installed
    if verdict.resting.solutions:
        return verdict.resting.solutions
    if base.mission.design.elastic:
        values = [verdict.resting.values]
        resting = best_actuated(
            base.mission, base.concept, installed, scale=0.0, starts=values, near=near
        )
        return resting.solutions
    # The actuator changes a rigid blade by its drive alone.
    return _trims(base, near, fixed=installed.host.kind != "retrofit")


def _trims(base: Baseline, near: Sequence[Solution], *, fixed: bool) -> Sequence[Solution]:
    """Trims of the blade without an actuator: the best fixed one, or as built; `near`: trims to start from."""
    designs = base.mission.designs()
    if fixed:
        designs = [base.concept.apply(design, base.fixed.values) for design in designs]
    return [solve(design, start).require() for design, start in zip(designs, near, strict=True)]


def _changes(doubt: Doubt | None) -> Array:
    """What each uncertain input does to a difference [W], in the order of all."""
    assert doubt is not None  # All that a verdict is made of trims.
    found = {row.name: row.change or 0.0 for row in doubt.rows}
    return np.array([found.get(row.name, 0.0) for row in UNCERTAIN])


def pay_sentence(even: BreakEven) -> str:
    """One line on the twist, mass and drive that an actuator would need to break even on this rotor."""
    needed, ideal = even.requirement, even.ideal_saving
    change = math.degrees(abs(even.change))
    saves = banded(ideal / 1e3, even.ideal_band / 1e3, "kW")
    if not even.worthwhile:
        return (
            f"No actuator pays: unlimited twist saves, of {even.fixed_power / 1e3:.0f} kW, {saves} "
            f"({change:.1f}° between the optima)."
        )
    return (
        f"Pays if it twists ≥ {math.degrees(needed.twist):.1f}° for ≤ {needed.mass:.1f} kg and "
        f"{needed.drive / 1e3:.2f} kW; with no drive power, for ≤ {even.mass_allowed(needed.twist):.1f} kg. "
        f"Unlimited twist saves {saves}."
    )


def break_even_chart(even: BreakEven) -> Chart:
    """Mass that just pays over twist, without drive power and with half of what unlimited twist saves."""
    half, degrees = 0.5 * even.ideal_saving, tuple(np.degrees(even.twists).tolist())
    driven = tuple(even.mass_allowed(twist, half) for twist in even.twists.tolist())
    lines = (
        Line("no drive power", degrees, tuple(even.masses.tolist()), 1),
        Line(f"{half / 1e3:.2f} kW of drive", degrees, driven, 1, dashes=True),
    )
    return Chart(
        "Pays below the line",
        Axis("range of linear twist [°]"),
        Axis("mass of all blades [kg]"),
        lines,
    )
