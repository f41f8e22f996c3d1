"""Net benefit of an actuator: required and attainable twist, voltages, mass, power saving, and the sentence."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly, find_actuator
from rotor.actuator.electrical import Drive, drive
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.limits import Limit, limits
from rotor.actuator.optimum import Baseline, ConditionPair, TwistOptimum, baseline, best_actuated
from rotor.actuator.section import Host, Placement, default_placement
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.optimisation.concepts import Concept, find_concept
from rotor.optimisation.limits import ChangeLimit
from rotor.trim.solve import solve

NOTHING = 1e-6
"""Least twist used as a divisor [rad]."""


@dataclass(frozen=True, eq=False)
class Verdict:
    """One actuator, one concept, one pair of flight conditions. Angles [rad], powers [W], means over the pair."""

    installed: InstalledActuator
    baseline: Baseline
    derating: float
    """Factor on the nominal twist used for the saving."""
    required_segments: Array
    """Change of twist between the optima, by segment [rad], (segments,)."""
    optimum: TwistOptimum
    """The best twist within the actuator's range, at both conditions."""
    reference_power: float
    """Power of the reference blade: twist as built for a retrofit, else the concept's best fixed blade."""
    resting: TwistOptimum
    """The blade with the actuator's stiffness and inertia but no voltage: twist as built for a retrofit, else the best
    fixed jig twist. An elastic blade that is softer or stiffer flies with another twist, before anything is driven."""
    net_power: float
    """Power at these twists with the actuator's mass on board and its drive power."""
    drive: Drive
    limits: tuple[Limit, ...]
    caveats: tuple[str, ...]

    @property
    def required(self) -> float:
        """Root to tip, the magnitudes of the segments added [rad]."""
        return float(np.abs(self.required_segments).sum())

    @property
    def attainable(self) -> float:
        """Root to tip over the whole voltage range, nominal [rad]."""
        return self.installed.attainable

    @property
    def attainable_derated(self) -> float:
        return self.installed.attainable * self.installed.derating

    @property
    def ratio(self) -> float:
        """Required over attainable twist in the worst segment."""
        available = np.maximum(self.installed.segment_twists * self.derating, NOTHING)
        return float(np.max(np.abs(self.required_segments) / available))

    @property
    def feasible(self) -> bool:
        """Whether every segment can supply the required change of twist; other limits are in `limits`."""
        return self.ratio <= 1.0

    @property
    def attained_segments(self) -> Array:
        """Change of twist between the two conditions at the actuated optimum, by segment [rad]."""
        first, second = (np.array(swings) for swings in self.optimum.swings)
        return (second - first) * self.installed.shapes[:, -1] * self.derating

    @property
    def attained(self) -> float:
        """The same root to tip, the magnitudes of the segments added [rad]."""
        return float(np.abs(self.attained_segments).sum())

    @property
    def gross_saving(self) -> float:
        """Saving before the actuator's mass is counted [W]: of the twist, less the cost of the stiffness."""
        return self.reference_power - self.optimum.power

    @property
    def stiffness_cost(self) -> float:
        """Power that the other stiffness and inertia of an elastic blade cost with no voltage [W]."""
        return self.resting.power - self.reference_power

    @property
    def twist_saving(self) -> float:
        """Saving of the change of twist on the same blade with no voltage [W], before the actuator's mass."""
        return self.resting.power - self.optimum.power

    @property
    def ideal_saving(self) -> float:
        """Of unlimited variable twist, over the same blade as the other savings [W].

        `baseline.ideal_saving` is its part beyond the best fixed blade.
        """
        return self.reference_power - self.baseline.ideal_power

    @property
    def net_saving(self) -> float:
        """Saving with the actuator's mass and drive power counted [W]."""
        return self.reference_power - self.net_power

    @property
    def broken(self) -> tuple[Limit, ...]:
        return tuple(limit for limit in self.limits if not limit.ok)

    @property
    def buildable(self) -> bool:
        """Whether only limits on the twist range are exceeded; the actuated optimum keeps those."""
        return all(limit.name in ("voltage", "field", "torque") for limit in self.broken)

    @property
    def pays(self) -> bool:
        return self.net_saving > 0.0 and self.buildable

    @property
    def voltages(self) -> tuple[tuple[float, float], ...]:
        """Voltage of each segment at both conditions [V]; empty for actuators without voltage."""
        return segment_voltages(self.installed, self.optimum.swings)

    @property
    def actuator_off(self) -> Design:
        """The second condition with the actuator on the blade, not driven and without its mass: a sweep starts here."""
        return self.installed.on(self._fixed(self.resting))

    @property
    def without_actuator(self) -> Design:
        """The second condition of the reference blade."""
        return self._fixed(self.baseline.fixed)

    def _fixed(self, jig: TwistOptimum) -> Design:
        design = self.baseline.pair.designs()[1]
        return design if self.installed.host.kind == "retrofit" else self.baseline.concept.apply(design, jig.values)


def try_actuator(
    name: str,
    design: Design,
    mu: tuple[float, float] = (0.0, 0.3),
    *,
    concept: str = "linear",
    plies: int = 2,
    share: float = 0.5,
    new_blade: bool = False,
    derated: bool = False,
) -> Verdict:
    """`judge` by names: could this actuator change the twist between two advance ratios, and would that pay?

    name: an actuator of `actuators()`, for example `MFC_P1`. share: fraction of time at the second advance ratio.
    new_blade: a blade designed for it, of half the torsional stiffness, in place of a retrofit. Raises ValueError with
    one sentence for what cannot be used, RuntimeError where nothing trims.
    """
    host = Host("new", 0.5) if new_blade else Host()
    pair = ConditionPair(design, mu, share)
    return judge(find_actuator(name), pair, find_concept(concept), default_placement(plies), host, derated=derated)


def judge(
    actuator: Actuator,
    pair: ConditionPair,
    concept: Concept,
    placement: Placement,
    host: Host | None = None,
    *,
    derated: bool = False,
    counted: float | None = None,
) -> Verdict:
    """Install the actuator, find the best twist within its range, add its mass, and compute the net saving.

    The segments are those of the concept. `derated` uses the twist measured on a test blade, `counted` any other factor
    on the nominal twist. Raises ValueError for a blade that cannot be built, RuntimeError where nothing trims.
    """
    host = host or Host()
    base = baseline(pair, concept)
    rotor = pair.design.rotor
    divisions = () if isinstance(actuator, ExtensionTwist) else base.divisions
    installed = install(actuator, replace(placement, divisions=divisions), host, rotor)
    share = counted if counted is not None else installed.derating if derated else 1.0
    resting = base.fixed
    if host.kind == "retrofit":
        resting = TwistOptimum((), (), (), _mean_power(pair, pair.designs()))
    reference = resting.power
    if pair.design.elastic:
        resting = best_actuated(pair, base.concept, installed, derating=0.0, starts=[base.fixed.values])
    reached = best_actuated(pair, base.concept, installed, derating=share, starts=[resting.values])
    required = base.segment_changes(divisions)
    swing = tuple(float(b - a) for a, b in zip(*reached.swings, strict=True))
    driven = drive(installed, swing)
    heavy = tuple(with_actuator_mass(solution.design, installed) for solution in reached.solutions)
    asked = tuple(float(x) for x in required / np.maximum(installed.segment_twists * share, NOTHING))
    return Verdict(
        installed=installed,
        baseline=base,
        derating=share,
        required_segments=required,
        optimum=reached,
        reference_power=reference,
        resting=resting,
        net_power=_mean_power(pair, heavy) + driven.hold_power,
        drive=driven,
        limits=limits(installed, asked, reached.solutions[-1]),
        caveats=(*actuator.provenance.warnings(actuator.id), *holding_caveats(actuator)),
    )


def holding_caveats(actuator: Actuator) -> tuple[str, ...]:
    """Caveats of holding a twist for minutes."""
    if not isinstance(actuator, PiezoPly):
        return ()
    return (
        f"{actuator.id}: hysteresis of {100.0 * actuator.hysteresis:.0f} % and creep: holding a twist needs strain "
        "feedback or charge drive. Without voltage the blade returns to its jig twist.",
    )


def with_actuator_mass(design: Design, installed: InstalledActuator) -> Design:
    """The design with the actuator's mass in the aircraft and on the blades, and an elastic blade's new stiffness."""
    blade, rotor, added = design.rotor.blade, design.rotor, installed.added
    hinge = blade.flap_hinge * rotor.radius
    inner, outer = (end - hinge for end in added.span)
    heavier = replace(
        blade,
        mass=blade.mass + installed.masses.blade,
        flap_static_moment=blade.flap_static_moment + added.mass_per_length * (outer**2 - inner**2) / 2.0,
        flap_inertia=blade.flap_inertia + added.mass_per_length * (outer**3 - inner**3) / 3.0,
    )
    condition = replace(design.condition, mass=design.condition.mass + installed.masses.aircraft)
    return installed.on(replace(design, rotor=replace(rotor, blade=heavier), condition=condition))


def change_limit(
    installed: InstalledActuator, reference: TwistLaw, *, root: float = 0.1304, derated: bool = False
) -> ChangeLimit:
    """The actuator's range as a limit on the change of twist in a search.

    Each segment's twist is spread over the whole segment, cut-out and tip included, like the laws of the concepts;
    `best_actuated` uses the true shape along the active span.
    """
    share = installed.derating if derated else 1.0
    ends = share * np.cumsum(installed.segment_twists)
    stations = (root, *installed.placement.divisions, 1.0)
    return ChangeLimit(reference, stations, (0.0, *ends.tolist()))


def segment_voltages(
    installed: InstalledActuator, swings: tuple[tuple[float, ...], ...]
) -> tuple[tuple[float, float], ...]:
    """Voltages of each segment at both conditions [V].

    A retrofit counts from zero volts. A new blade's jig twist is set so that the two voltages of a segment lie around
    zero as far as the negative range allows; without voltage the blade then flies between its two twists.
    """
    actuator = installed.actuator
    if not isinstance(actuator, PiezoPly):
        return ()
    low = actuator.voltage_range[0]
    found: list[tuple[float, float]] = []
    for first, second in zip(*swings, strict=True):
        a, b = first * actuator.voltage_swing, second * actuator.voltage_swing
        if installed.host.kind == "new":
            offset = max(low, -0.5 * abs(b - a)) - min(a, b)
            a, b = a + offset, b + offset
        elif min(a, b) < low - 1e-6 or max(a, b) > actuator.voltage_range[1] + 1e-6:
            a, b = -a, -b  # Fibres laid in the other direction.
        found.append((a, b))
    return tuple(found)


def _mean_power(pair: ConditionPair, designs: tuple[Design, ...]) -> float:
    solutions = [solve(design).require() for design in designs]
    return sum(share * solution.power.total for share, solution in zip(pair.shares, solutions, strict=True))


SMALL = 1.0
"""Powers below this are printed as nothing [W]."""
PRINTED = 50.0
"""Least power that shows in kilowatts with one decimal [W]."""


def headline(verdict: Verdict) -> str:
    """The outcome in one short sentence: net power against the one blade that the whole verdict is compared with."""
    net, against = verdict.net_saving, reference(verdict)
    if abs(net) < SMALL:
        return f"No net benefit: saves as much as it costs vs. {against}."
    if net < 0.0:
        return f"No net benefit: costs {kw(-net)} vs. {against}."
    if verdict.buildable:
        return f"Net benefit: saves {kw(net)} vs. {against}."
    return f"Cannot be built: it would save {kw(net)} vs. {against}."


def verdict_sentence(verdict: Verdict) -> str:
    """The headline, then reach, savings and limits; all powers count from the blade that the headline names."""
    sentences = [headline(verdict), _reach(verdict), _savings(verdict)]
    if verdict.broken:
        sentences.append(f"Limits exceeded: {', '.join(limit.name for limit in verdict.broken)}.")
    return " ".join(sentences)


def reference(verdict: Verdict) -> str:
    """The blade that all savings of a verdict count from."""
    return "the twist as built" if verdict.installed.host.kind == "retrofit" else "the best fixed twist"


def _reach(verdict: Verdict) -> str:
    """Twist supplied against twist needed."""
    installed = verdict.installed
    what = f"{installed.actuator.name} ({count(verdict)}, {installed.host.label})"
    first, second = (flight(mu) for mu in verdict.baseline.pair.advance_ratios)
    need, nominal = math.degrees(verdict.required), math.degrees(verdict.attainable)
    available = f"{nominal:.1f}° nominal"
    if installed.derating < 1.0:
        available += f", {math.degrees(verdict.attainable_derated):.1f}° derated by test"
    can = "can supply" if verdict.feasible else "cannot supply"
    return f"{what} {can} the {need:.1f}° needed from {first} to {second} ({available})."


def _savings(verdict: Verdict) -> str:
    """Of stiffness and of twist, the cost of mass and drive, and what unlimited variable twist would save."""
    cost = verdict.gross_saving - verdict.net_saving
    concept, mass = verdict.baseline.concept.name, verdict.installed.masses.aircraft
    stiffness = ""
    if abs(verdict.stiffness_cost) >= PRINTED:
        other = "softer" if verdict.installed.host.stiffness < 1.0 else "stiffer"
        stiffness = f"With no voltage the {other} elastic blade {_change(-verdict.stiffness_cost)}. "
    text = (
        f"{stiffness}Within its reach the change of twist {_change(verdict.twist_saving)}; "
        f"carrying {mass:.0f} kg and its drive cost {kw(cost)}. "
        f"Unlimited variable twist ({concept}) would save {kw(verdict.ideal_saving)}"
    )
    fixed = verdict.ideal_saving - verdict.baseline.ideal_saving
    return f"{text}, {kw(fixed)} of it with the best fixed twist." if abs(fixed) >= SMALL else f"{text}."


def _change(saving: float) -> str:
    if abs(saving) < SMALL:
        return "saves nothing"
    return f"saves {kw(saving)}" if saving > 0.0 else f"costs {kw(-saving)}"


def count(verdict: Verdict) -> str:
    """Number of plies or tubes as text; "passive" for a laminate."""
    actuator, placement = verdict.installed.actuator, verdict.installed.placement
    if isinstance(actuator, ExtensionTwist):
        return "passive"
    if isinstance(actuator, PiezoPly):
        return f"{placement.plies} {'ply' if placement.plies == 1 else 'plies'}"
    each = " a segment" if placement.divisions else ""
    return f"{placement.plies} {'tube' if placement.plies == 1 else 'tubes'}{each}"


def flight(advance_ratio: float) -> str:
    return "hover" if advance_ratio == 0.0 else f"µ {advance_ratio:.2f}"


def kw(power: float) -> str:
    """Kilowatts with one decimal; "nothing" below SMALL."""
    return "nothing" if abs(power) < SMALL else f"{power / 1e3:.1f} kW"
