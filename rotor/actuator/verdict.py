"""Net benefit of an actuator: required and attainable twist, voltages, mass, power saving, and the sentence."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly
from rotor.actuator.electrical import Drive, drive
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.limits import Limit, limits
from rotor.actuator.optimum import Baseline, ConditionPair, TwistOptimum, baseline, best_actuated
from rotor.actuator.section import Host, Placement
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.optimisation.concepts import Concept
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
        """Saving before the actuator's mass is counted [W]."""
        return self.reference_power - self.optimum.power

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
        """The design at the second condition with the actuator off, the start of a harmonic sweep."""
        base = self.baseline
        design = base.pair.designs()[1]
        return design if self.installed.host.kind == "retrofit" else base.concept.apply(design, base.fixed.values)


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
    reached = best_actuated(pair, base.concept, installed, derating=share, starts=[base.fixed.values])
    required = base.segment_changes(divisions)
    reference = base.fixed.power
    if host.kind == "retrofit":
        reference = _mean_power(pair, pair.designs())
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
    """The design with the actuator's mass in the aircraft, and on the flapping blades."""
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
    return replace(design, rotor=replace(rotor, blade=heavier), condition=condition)


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


def verdict_sentence(verdict: Verdict) -> str:
    """The result in two or three short sentences."""
    installed, pair = verdict.installed, verdict.baseline.pair
    what = f"{installed.actuator.name} ({count(verdict)}, {installed.host.label})"
    first, second = (flight(mu) for mu in pair.advance_ratios)
    need, have = math.degrees(verdict.required), math.degrees(verdict.attainable)
    tested = math.degrees(verdict.attainable_derated)
    if verdict.feasible:
        reach = f"{what} can supply the {need:.1f}° needed between {first} and {second} ({have:.1f}° nominal"
    else:
        reach = f"{what} cannot supply the {need:.1f}° needed between {first} and {second} ({have:.1f}° nominal"
    reach += f", {tested:.1f}° derated by test)." if installed.derating < 1.0 else ")."
    gross, net = verdict.gross_saving, verdict.net_saving
    mass = installed.masses.aircraft
    against = "twist as built" if installed.host.kind == "retrofit" else "best fixed blade"
    saves = f"within its range it saves {kw(gross)} against the {against}"
    if verdict.pays:
        pay = f"Net benefit: {saves}, {kw(net)} with its {mass:.0f} kg on board."
    elif net > 0.0:
        pay = f"It would save {kw(net)} against the {against} if it could be built and driven."
    else:
        pay = f"No net benefit: {saves}, and its {mass:.0f} kg cost {kw(gross - net)}."
    concept, ideal = verdict.baseline.concept.name, verdict.baseline.ideal_saving
    pay += f" With free in-flight twist, the {concept} concept would save {kw(ideal)} against its best fixed blade."
    broken = verdict.broken
    stops = f" Limits exceeded: {', '.join(limit.name for limit in broken)}." if broken else ""
    return f"{reach} {pay}{stops}"


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
