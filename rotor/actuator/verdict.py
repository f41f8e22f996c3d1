"""Net benefit of an actuator: required and attainable twist, voltages, mass, power saving, and the sentence.

One file, because a verdict is one value: whoever reads a saving finds beside it what it is made of and how it is found.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rotor.actuator.catalogue import engines_of, find_actuator, fuel_caveats
from rotor.actuator.installation import install, with_actuator_mass
from rotor.actuator.kind import Actuator, Drive, InstalledActuator, Limit
from rotor.actuator.limits import limits
from rotor.actuator.optimum import (
    Baseline,
    TwistOptimum,
    baseline,
    best_actuated,
    best_twist,
    widest_changes,
)
from rotor.actuator.section import HostBlade, Placement, default_placement
from rotor.design.design import Design, require_design
from rotor.optimisation.concepts import Concept, find_concept
from rotor.optimisation.doubt import difference_doubt
from rotor.optimisation.mission import Mission, standard_mission
from rotor.support.arrays import Array
from rotor.support.units import KILOWATT
from rotor.trim.analysis import Analysis
from rotor.trim.doubt import Doubt, pair_text, rounded_pair, sure_words, sureness
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

MIN_TWIST = 1e-6
"""Least twist used as a divisor [rad]."""
Against = Literal["same-blade", "best-fixed"]
"""The blade that savings are counted from: the same one without the actuator, or the best fixed one."""


@dataclass(frozen=True, eq=False)
class Verdict:
    """One actuator, one concept, one mission. Angles [rad], powers [W], means over the mission.

    All savings count from one blade, `against`, and add up: gross − stiffness − mass − drive = net (`savings`).
    """

    installed: InstalledActuator
    baseline: Baseline
    against: Against
    required_segments: Array
    """Widest change of twist between the optima of two legs, by segment [rad], (segments,)."""
    optimum: TwistOptimum
    """The best twist within the actuator's range, on each leg."""
    resting: TwistOptimum
    """The blade with the actuator's stiffness and inertia but no voltage: its own jig twist for a retrofit, else the
    best fixed one. An elastic blade that is softer or stiffer flies with another twist, before anything is driven."""
    reference_powers: tuple[float, ...]
    """Powers of the blade that savings are counted from, by leg [W]."""
    bare_power: float
    """Mean of the blade at rest with the stiffness and inertia it has without the actuator [W]."""
    free_power: float
    """Mean with unlimited twist in flight on the blade that carries the actuator, without its mass [W]."""
    loaded_powers: tuple[float, ...]
    """Driven, with the actuator's mass on board, by leg [W]; its drive is not in it."""
    drive: Drive
    doubt: Doubt | None
    """How sure the saving is, before the drive."""
    parts_doubt: Mapping[str, Doubt | None]
    """How sure its parts are, by the names of `savings`, and `ideal`; the drive's is known as well as the drive."""
    limits: tuple[Limit, ...]
    caveats: tuple[str, ...]

    @property
    def required(self) -> float:
        """Required twist from root to tip, the sum of the segments' magnitudes [rad]."""
        return float(np.abs(self.required_segments).sum())

    @property
    def attainable(self) -> float:
        """Nominal twist from root to tip over the whole voltage range [rad]."""
        return self.installed.attainable

    @property
    def ratio(self) -> float:
        """Required over attainable twist in the worst segment [-]."""
        available = np.maximum(self.installed.segment_twists, MIN_TWIST)
        return float(np.max(np.abs(self.required_segments) / available))

    @property
    def feasible(self) -> bool:
        """Whether every segment can supply the required change of twist; other limits are in `limits`."""
        return self.ratio <= 1.0

    @property
    def attained_segments(self) -> Array:
        """Widest change of twist between two legs at the actuated optimum, by segment [rad]."""
        return widest_changes(np.array(self.optimum.swings) * self.installed.shapes[:, -1])

    @property
    def attained(self) -> float:
        """Twist reached from root to tip, the sum of the segments' magnitudes [rad]."""
        return float(np.abs(self.attained_segments).sum())

    @property
    def reference_power(self) -> float:
        """Power of the baseline blade [W]."""
        return self.baseline.mission.mean(self.reference_powers)

    @property
    def net_power(self) -> float:
        """Power with the actuator's mass on board and its drive [W]."""
        return self.baseline.mission.mean(self.loaded_powers) + self.drive.hold_power

    @property
    def net_band(self) -> float | None:
        """Uncertainty of `net_saving`, ± [W]; None where it is not known."""
        return self.band_of("net")

    def band_of(self, name: str) -> float | None:
        """Uncertainty of a part of `savings`, of the `ideal` saving or of `net`, ± [W]; None where it is not known."""
        doubt = self.doubt if name == "net" else self.parts_doubt.get(name)
        return None if doubt is None else doubt.change_band

    @property
    def gross_saving(self) -> float:
        """Saving of the twist that the actuator makes, before what it costs [W]; never above `ideal_saving`."""
        return self.reference_power - self.optimum.power + self.stiffness_cost

    @property
    def ideal_saving(self) -> float:
        """Saving of unlimited twist in flight: of the concept, or of the plies where their shape is better [W]."""
        return self.reference_power - self.free_power + self.stiffness_cost

    @property
    def stiffness_cost(self) -> float:
        """Power that the changed stiffness and inertia of an elastic blade cost without voltage [W]."""
        return self.resting.power - self.bare_power

    @property
    def mass_cost(self) -> float:
        """Power that carrying the actuator costs [W]."""
        return self.baseline.mission.mean(self.loaded_powers) - self.optimum.power

    @property
    def mass_allowed(self) -> float | None:
        """Mass on board at which the actuator breaks even [kg]; None for an actuator without mass."""
        mass = self.installed.masses.aircraft
        return max(0.0, mass * (1.0 + self.net_saving / self.mass_cost)) if mass else None

    @property
    def drive_cost(self) -> float:
        """Power that holding the twist takes [W]."""
        return self.drive.hold_power

    @property
    def net_saving(self) -> float:
        """Saving less the cost of stiffness, mass and drive [W]."""
        return self.reference_power - self.net_power

    @property
    def savings(self) -> tuple[tuple[str, float], ...]:
        """Name and saving [W] of each part, costs negative; their sum is `net_saving`. First, where they differ, the
        blade without the actuator against the best fixed one."""
        blades = self.reference_power - self.bare_power
        parts = (
            [("blade", blades)]
            if self.against == "best-fixed" and blades
            else list[tuple[str, float]]()
        )
        parts.append(("gross", self.gross_saving - sum(part for _, part in parts)))
        if self.stiffness_cost:
            parts.append(("stiffness", -self.stiffness_cost))
        return (*parts, ("mass", -self.mass_cost), ("drive", 0.0 - self.drive_cost))

    @property
    def bands(self) -> tuple[float, ...]:
        """Uncertainty of each of `savings`, ± [W]; 0 for the drive and where it is not known."""
        return tuple(self.band_of(name) or 0.0 for name, _ in self.savings)

    @property
    def fuel_saving(self) -> float | None:
        """Fuel saved [kg/s]; None where the engines of the aircraft have no source."""
        engines = engines_of(self.baseline.mission.design.aircraft)
        if engines is None:
            return None
        pairs = zip(self.reference_powers, self.loaded_powers, strict=True)
        return self.baseline.mission.mean(
            engines.flow(before) - engines.flow(after + self.drive.hold_power)
            for before, after in pairs
        )

    @property
    def fuel_band(self) -> float | None:
        """Uncertainty of `fuel_saving`, ± [kg/s], in proportion to that of power; None where it is not known."""
        saved, band = self.fuel_saving, self.net_band
        return (
            None
            if saved is None or band is None or not self.net_saving
            else band * abs(saved / self.net_saving)
        )

    @property
    def broken(self) -> tuple[Limit, ...]:
        """The entries of `limits` that are not met."""
        return tuple(limit for limit in self.limits if not limit.ok)

    @property
    def buildable(self) -> bool:
        """Whether it can be built: only limits on the twist range are exceeded, and the actuated optimum keeps
        those."""
        return all(limit.name in self.installed.actuator.range_limits for limit in self.broken)

    @property
    def pays(self) -> bool:
        """Whether it can be built and its net saving is positive."""
        return self.net_saving > 0.0 and self.buildable

    @property
    def sourced(self) -> bool:
        """Whether all values of the actuator have a source: else its savings are never `sure` (`sureness`)."""
        return self.installed.actuator.provenance.sourced

    @property
    def voltages(self) -> tuple[tuple[float, ...], ...]:
        """Voltages of each segment, one for each leg [V]; empty for actuators without voltage."""
        return self.installed.actuator.voltages(self.optimum.swings, self.installed.host)


def try_actuator(
    name: str,
    design: Design,
    mission: Mission | None = None,
    *,
    concept: str = "linear",
    plies: int = 2,
    new_blade: bool = False,
    against: Against = "same-blade",
) -> Verdict:
    """`judge` by names: could this actuator change the twist from leg to leg of a mission, and would that pay?

    name: an actuator of `actuators()`, for example `MFC_P1`. mission: of this design; None for `standard_mission`.
    new_blade: a blade designed for it, of half the torsional stiffness, in place of a retrofit.
    against: savings count from the `same-blade` without the actuator, or from the concept's best fixed one.

    ValueError with one sentence for what cannot be used, RuntimeError where nothing trims.
    """
    if isinstance(name, Design):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise TypeError(
            "the actuator's name comes first: rotor.actuator.try_actuator('MFC_P1', design)"
        )
    host = HostBlade("new", 0.5) if new_blade else HostBlade()
    return judge(
        find_actuator(name),
        mission or standard_mission(require_design(design)),
        find_concept(concept),
        default_placement(plies),
        host,
        against=against,
    )


def judge(
    actuator: Actuator,
    mission: Mission,
    concept: Concept,
    placement: Placement,
    host: HostBlade | None = None,
    *,
    against: Against = "same-blade",
) -> Verdict:
    """Install the actuator, find the best twist within its range, add its mass, and compute the net saving.

    The segments are those of the concept. `against`: the blade that savings are counted from. Raises ValueError for a
    blade that cannot be built, RuntimeError where nothing trims.
    """
    host = host or HostBlade()
    base = baseline(mission, concept)
    rotor, aircraft = mission.design.rotor, mission.design.aircraft
    installed = install(actuator, replace(placement, divisions=base.divisions), host, rotor)
    resting, counted_from = base.fixed, base.fixed.solutions
    near = counted_from
    if host.kind == "retrofit" or against == "same-blade":
        built = [
            solve(design, start).require()
            for design, start in zip(mission.designs(), near, strict=True)
        ]
        if host.kind == "retrofit":
            resting, near = TwistOptimum((), (), (), mission.mean(_totals(built))), built
        if against == "same-blade":
            counted_from = built
    bare, bare_power, free = near, resting.power, [best.solutions[0] for best in base.best]
    if mission.design.elastic:
        resting = best_actuated(
            mission, base.concept, installed, scale=0.0, starts=[base.fixed.values], near=near
        )
        near = resting.solutions
        free = [
            best_twist(installed.on(design), base.concept, [best.values], alone=True).solutions[0]
            for design, best in zip(mission.designs(), base.best, strict=True)
        ]
    reached = best_actuated(mission, base.concept, installed, starts=[resting.values], near=near)
    required = base.segment_changes(installed.placement.divisions)
    heavy = [
        solve(with_actuator_mass(flown.design, installed), flown).require()
        for flown in reached.solutions
    ]
    free = [
        min(two, key=lambda trim: trim.power.total)
        for two in zip(free, reached.solutions, strict=True)
    ]
    doubts = _doubts(
        mission.shares, against, reached.solutions, near, bare, counted_from, heavy, free
    )
    asked = tuple(float(x) for x in required / np.maximum(installed.segment_twists, MIN_TWIST))
    return Verdict(
        installed=installed,
        baseline=base,
        against=against,
        required_segments=required,
        optimum=reached,
        resting=resting,
        reference_powers=_totals(counted_from),
        bare_power=bare_power,
        free_power=mission.mean(_totals(free)),
        loaded_powers=_totals(heavy),
        drive=actuator.drive(installed, tuple(widest_changes(np.array(reached.swings)).tolist())),
        doubt=doubts.pop("net"),
        parts_doubt=doubts,
        limits=limits(installed, asked, reached.solutions),
        caveats=(*actuator.caveats, *fuel_caveats(aircraft)),
    )


def _doubts(
    shares: Sequence[float], against: Against, *blades: Sequence[Solution]
) -> dict[str, Doubt | None]:
    """How sure the parts of a verdict are, and `net`. blades: trims of the one that is driven, at rest, bare, that
    savings count from, with the actuator's mass, and free."""
    known = {id(trim): Analysis(trim) for trims in blades for trim in trims}
    flown, still, own, other, loaded, ideal = (
        [known[id(trim)] for trim in trims] for trims in blades
    )
    same_blade = own == other or against == "best-fixed"
    steps = {"blade": (own, other), "gross": (flown, still if same_blade else other)}
    steps |= {
        "stiffness": (still, own),
        "mass": (loaded, flown),
        "ideal": (ideal, still if own == other else other),
    }
    return {
        name: difference_doubt(shares, *step)
        for name, step in {"net": (loaded, other), **steps}.items()
    }


def _totals(solutions: Sequence[Solution]) -> tuple[float, ...]:
    return tuple(solution.power.total for solution in solutions)


MIN_SHOWN_W = 1.0
"""Powers below this are printed as nothing [W]."""
MIN_SHOWN_IN_KW = 50.0
"""Least power that shows in kilowatts with one decimal [W]."""


def verdict_sentence(verdict: Verdict) -> str:
    """One line: what the twist saves, what the actuator costs, and whether it pays."""
    parts = (
        verdict.gross_saving,
        *(part for name, part in verdict.savings if name not in ("blade", "gross")),
    )
    gains, costs = (sum(max(sign * part, 0.0) for part in parts) for sign in (1.0, -1.0))
    forbidden = verdict.installed.actuator.forbidden
    text = (
        f"Saves {kilowatt_text(gains)} over {reference(verdict)} and costs {kilowatt_text(costs)}"
    )
    text = f"{forbidden.capitalize()}; if it could work, it s{text[1:]}" if forbidden else text
    sure = net_band_words(verdict) and f" ({net_band_words(verdict)})"
    if verdict.net_saving < MIN_SHOWN_W:
        return f"{text}, so this {verdict.installed.actuator.noun[0]} does not pay{sure}."
    but = "" if verdict.pays or forbidden else f", but it cannot be built ({_broken(verdict)})"
    return f"{text}, a net saving of {_net_saving(verdict)}{sure}{but}."


def net_band_words(verdict: Verdict) -> str:
    """The band of the net saving, and whether its sign is known."""
    band = verdict.net_band
    if band is None:
        return ""
    pair = rounded_pair(verdict.net_saving / 1e3, band / 1e3)
    words = sure_words(verdict.net_saving, band, sourced=verdict.sourced)
    return f"± {pair.band:.{pair.decimals}f} kW: {words}"


def _net_saving(verdict: Verdict) -> str:
    """The net saving in kilowatts, with the decimals of its band."""
    if verdict.net_band is None:
        return kilowatt_text(verdict.net_saving)
    pair = rounded_pair(verdict.net_saving / 1e3, verdict.net_band / 1e3)
    return f"{pair.change:.{pair.decimals}f} kW"


def verdict_details(verdict: Verdict, unit: tuple[str, float] = KILOWATT) -> str:
    """What the one line leaves out: reach, parts of the saving, fuel, ideal twist and limits. `unit`: symbol and size
    [W] of the unit of power."""
    sentences, saved, band = (
        [_reach(verdict), _savings(verdict, unit)],
        verdict.fuel_saving,
        verdict.fuel_band,
    )
    if saved is not None:
        size, sourced = f"{abs(3600.0 * saved):.1f} kg/h", verdict.sourced
        if band is not None:
            word = sureness(saved, band, sourced=sourced)
            size = f"{pair_text(abs(3600.0 * saved), 3600.0 * band, 'kg/h')}: {word}"
        sentences.append(f"Net fuel: {'saves' if saved >= 0.0 else 'costs'} {size}.")
    if verdict.broken:
        sentences.append(f"Limits exceeded: {_broken(verdict)}.")
    return " ".join(sentences)


def reference(verdict: Verdict) -> str:
    """The baseline blade of all savings of a verdict."""
    same = (
        "the same blade without it"
        if verdict.installed.host.kind == "retrofit"
        else "the present blade"
    )
    return same if verdict.against == "same-blade" else "the best fixed blade"


def _broken(verdict: Verdict) -> str:
    return ", ".join(limit.name for limit in verdict.broken)


def _reach(verdict: Verdict) -> str:
    """Twist supplied against twist needed."""
    installed = verdict.installed
    what = f"{installed.actuator.name} ({installed.count}, {installed.host.label})"
    legs = verdict.baseline.mission.words
    need, nominal = math.degrees(verdict.required), math.degrees(verdict.attainable)
    if installed.too_weak:
        return f"{what} moves 0.00°: far too weak for the {need:.1f}° needed between {legs}."
    can = "can supply" if verdict.feasible else "cannot supply"
    return f"{what} {can} the {need:.1f}° needed between {legs} ({nominal:.1f}° nominal)."


def _savings(verdict: Verdict, unit: tuple[str, float]) -> str:
    """Each part of the net saving, and what unlimited variable twist would save."""
    installed, concept = verdict.installed, verdict.baseline.concept.name
    start = verdict.reference_power - verdict.bare_power
    gross = dict(verdict.savings)["gross"]
    parts = [f"Against {reference(verdict)}, its twist {part_words(verdict, 'gross', gross, unit)}"]
    if abs(start) >= MIN_SHOWN_IN_KW:
        parts[0] += f", and its built-in twist alone {part_words(verdict, 'blade', start, unit)}"
    if abs(verdict.stiffness_cost) >= MIN_SHOWN_IN_KW:
        other = "softer" if installed.host.stiffness < 1.0 else "stiffer"
        parts.append(
            f"the {other} elastic blade {part_words(verdict, 'stiffness', -verdict.stiffness_cost, unit)}"
        )
    mass = installed.masses.aircraft
    parts.append(f"carrying {mass:.0f} kg {part_words(verdict, 'mass', -verdict.mass_cost, unit)}")
    parts.append(f"its drive costs {_size_text(verdict.drive_cost, unit)}")
    ideal = part_words(verdict, "ideal", verdict.ideal_saving, unit)
    return f"{'; '.join(parts)}. Unlimited twist in flight ({concept}) {ideal}."


def part_words(
    verdict: Verdict, name: str, saving: float, unit: tuple[str, float] = KILOWATT
) -> str:
    """What a part saves or costs, with its band, as `saves 9.2 ± 3.6 kW: sure`."""
    verb, size, band = (
        "costs" if saving <= -MIN_SHOWN_W else "saves",
        abs(saving),
        verdict.band_of(name),
    )
    if not band or size < MIN_SHOWN_W:
        return f"{verb} {_size_text(size, unit)}"
    # The sentence of the verdict says once why no word is `sure`.
    word = sureness(size, band, sourced=verdict.sourced)
    symbol, watts = unit
    return f"{verb} {pair_text(size / watts, band / watts, symbol)}: {word}"


def kilowatt_text(power: float, digits: int = 1) -> str:
    """A power [W] in kilowatts; "nothing" below MIN_SHOWN_W."""
    return _size_text(power, KILOWATT, digits)


def _size_text(power: float, unit: tuple[str, float], digits: int = 1) -> str:
    """A power [W] in a unit; "nothing" below MIN_SHOWN_W."""
    if abs(power) < MIN_SHOWN_W:
        return "nothing"
    symbol, watts = unit
    return f"{power / watts:.{digits}f} {symbol}"
