"""The limits of validity of a solution, and why a design did not trim or a trim is refused, in sentences for the user.

Caveats are a table of name, condition and sentence; it makes the file long, and is read from top to bottom. The
sentences of failures below share its limits.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from rotor.aero.elements import BladeElements, DiskSums, TrimState
from rotor.aero.momentum import VORTEX_RING_ONSET, vortex_ring_edge
from rotor.aero.problem import Problem
from rotor.aero.switches import switched_off
from rotor.airfoil.polynomial import THESIS_NAME
from rotor.arrays import Array
from rotor.design.aircraft import FIXED_SHARE, Stand
from rotor.design.design import Design
from rotor.trim.forward import easier_condition
from rotor.trim.low_speed import hover_share
from rotor.trim.power import HubMoment, PowerBudget
from rotor.trim.solution import Caveat, DiskFields, ElasticTwist

LOW_SPEED = 0.075
"""Below this advance ratio linear inflow is not trusted (thesis p. 26)."""
LOWEST_SPEED = 0.05
"""Below it a wake rolls up at once, and no model that leaves this out has been compared with measurement."""
HIGH_SPEED = 0.40
"""Above it reverse flow and stall decide: the lift over drag of the PCA-2 is missed by more than 10 %."""
HOVER_CAUTION = 0.12
"""C_T/σ in hover from which maximum lift decides, the least certain part of the section data. Our choice."""
LARGEST_BUILT_TWIST = math.radians(25.0)
"""Root to tip, with a margin: the UH-60A has 18° nominal. Only tiltrotor blades, propellers in cruise, have more."""
STALL_SHARE = 0.02
"""Stalled part of the disk above which dynamic stall would change the results."""
MOST_STALLED = 0.25
"""Part of the thrust that stalled sections carry beyond which there is no power. Measured rotors have up to 22 % (a
tilted XV-15). Beyond the largest lift a rotor balances the same weight once more, at a multiple of the power, with 33
to 56 % of the thrust stalled and 19 to 44 % of the disk: the share of the disk does not tell the two apart."""
CONTROL_SHARE = 0.005
"""Power of pitch links and actuators over that of the main rotor from which it is named. Our choice."""
FAST_PITCH = 0.2
"""Reduced frequency ωc/2V at 0.75 R from which it is named. Our choice: Theodorsen's |C(k)| has fallen to 0.75."""


@dataclass(frozen=True)
class Trimmed:
    """A converged trim, and what several caveats read of it."""

    problem: Problem
    total: DiskSums
    fields: DiskFields
    stalled: float
    moment: HubMoment
    power: PowerBudget
    elastic: ElasticTwist | None
    state: TrimState

    @property
    def design(self) -> Design:
        return self.problem.design

    @property
    def mu(self) -> float:
        return self.design.condition.advance_ratio

    @property
    def on_stand(self) -> bool:
        return self.design.condition.stand is not None

    @property
    def fixed_inflow(self) -> bool:
        """Whether the inflow does not respond to where the lift is."""
        return not self.problem.inflow.load_dependent

    @property
    def twist(self) -> float:
        """From root to tip [rad]."""
        ends = self.design.twist(np.array([self.design.rotor.blade.root_cutout, 1.0]))
        return float(ends[1] - ends[0])

    @property
    def loading(self) -> float:
        """C_T/σ."""
        return self.total.thrust / self.design.rotor.solidity

    @property
    def descent(self) -> tuple[float, float]:
        """Rate of descent, and that at which the vortex ring state begins, over the induced velocity in hover."""
        inflow = math.sqrt(0.5 * self.design.weight_coefficient)
        return -self.design.climb_ratio / inflow, -vortex_ring_edge(self.mu / inflow)

    @property
    def highest_wave(self) -> int:
        """The highest harmonic of rotor speed in the pitch."""
        return max((harmonic.per_rev for wave in self.design.pitch_waves for harmonic in wave.harmonics), default=0)

    @property
    def reduced_frequency(self) -> float:
        """ωc/2V of that harmonic at 0.75 R."""
        return self.highest_wave * self.design.rotor.reference_chord / (1.5 * self.design.rotor.radius)

    @property
    def beyond_stops(self) -> list[str]:
        """What each control that is beyond its stops needs, and what it has, in words."""
        stops, state, words = self.design.aircraft.controls, self.state, list[str]()
        if stops is None:
            return words
        ranges = {"collective": stops.collective, "lateral": stops.lateral, "longitudinal": stops.longitudinal}
        for name, place in stops.places(state.collective, state.cyclic_1c, state.cyclic_1s).items():
            if not 0.0 <= place <= 1.0:
                low, high = (math.degrees(end) for end in ranges[name])
                what = name if name == "collective" else f"{name} cyclic"
                words.append(f"{what} {low + place * (high - low):.1f}° of {low:.1f} to {high:.1f}°")
        return words

    @property
    def control_power(self) -> float:
        """What pitch links and actuators put into the blades [W]."""
        return 0.0 if self.elastic is None else self.elastic.control_power

    @property
    def top_mach(self) -> float:
        return float(self.fields.mach.max())

    @property
    def by_polynomials(self) -> bool:
        """Whether section data are polynomials of one Mach number."""
        return self.problem.disk.fit_range is not None

    @property
    def clamped(self) -> float:
        """Part of πR², reverse flow not counted, where a polynomial polar is clamped."""
        if self.problem.disk.fit_range is None:
            return 0.0
        low, high = self.problem.disk.fit_range
        outside = ((self.fields.alpha < low) | (self.fields.alpha > high)) & (self.fields.u_t >= 0.0)
        return float(self.fields.cells @ outside.sum(axis=1))


@dataclass(frozen=True)
class _Rule:
    name: str
    applies: Callable[[Trimmed], object]
    sentence: Callable[[Trimmed], str]


_RULES = (
    _Rule(
        "teetering",
        lambda trim: trim.design.aircraft.hub == "teetering" and trim.design.rotor.precone is None,
        lambda trim: "A teetering hub has built-in coning; here the blades cone as if each were hinged at the shaft.",
    ),
    _Rule(
        "twist-beyond-built",
        lambda trim: trim.design.twist != trim.design.rotor.builtin_twist and abs(trim.twist) > LARGEST_BUILT_TWIST,
        lambda trim: (
            f"The blade twists by {math.degrees(trim.twist):.0f}° from root to tip; helicopter blades are built with "
            "about 20° or less. Read the result as an extrapolation."
        ),
    ),
    _Rule(
        "no-tail-rotor",
        lambda trim: trim.design.tail_rotor is None and trim.design.models.tail_rotor_solved and not trim.on_stand,
        lambda trim: (
            f"The rotor file has no tail rotor: {100.0 * FIXED_SHARE:.0f} % of main-rotor power is used instead."
        ),
    ),
    _Rule(
        "thesis-models",
        lambda trim: trim.design.preset == "thesis" and trim.design.aircraft.stated is None,
        lambda trim: (
            f"The document does not treat the {trim.design.aircraft.name}: these are its models with this rotor's "
            "blade."
        ),
    ),
    _Rule(
        "no-blade-structure",
        lambda trim: trim.design.models.has("elastic_twist") and trim.design.rotor.blade.structure is None,
        lambda trim: (
            "The rotor file has no blade structure: the blade is rigid in torsion here, though real blades twist by "
            "degrees in flight."
        ),
    ),
    _Rule("switched-off", lambda trim: switched_off(trim.design.models), lambda trim: _switches(trim.design)),
    _Rule(
        "rigid-blades", lambda trim: not trim.design.models.flapping and trim.mu > 0.0, lambda trim: _rigid(trim.moment)
    ),
    _Rule(
        "rigid-blades-linear-inflow",
        lambda trim: not trim.design.models.flapping and trim.mu > 0.0 and trim.fixed_inflow,
        lambda trim: "Linear inflow does not respond to unequal lift: the induced power of rigid blades is too low.",
    ),
    _Rule(
        "active-twist-rests",
        lambda trim: trim.design.active_twist and trim.design.hovering,
        lambda trim: "Active twist is off in hover, where only the twist law acts.",
    ),
    _Rule(
        "root-pitch-rests",
        lambda trim: trim.design.pitch_per_rev and trim.design.hovering,
        lambda trim: "Root pitch at harmonics of rotor speed is off in hover, where nothing follows azimuth.",
    ),
    _Rule(
        "fast-pitch",
        lambda trim: trim.reduced_frequency > FAST_PITCH and not trim.problem.unsteady,
        lambda trim: (
            f"At {trim.highest_wave}/rev the reduced frequency at 0.75 R is {trim.reduced_frequency:.2f}; section data "
            "are steady, and only the wake that a lifting line sheds and the damping of the pitch rate answer to it."
        ),
    ),
    _Rule(
        "control-power",
        lambda trim: trim.design.pitch_waves and abs(trim.control_power) > CONTROL_SHARE * abs(trim.power.main_rotor),
        lambda trim: (
            f"Pitch links and actuators put {trim.control_power / 1e3:.1f} kW into the pitching blades; that is not "
            "part of the power here."
        ),
    ),
    _Rule(
        "torque-without-drag",
        lambda trim: trim.design.models.trim == "thrust" and not trim.on_stand and trim.mu > 0.0,
        lambda trim: (
            f"Only the thrust is trimmed, so the shaft's torque carries {trim.power.shaft / 1e3:.0f} kW; with the "
            f"drag of the airframe the rotor takes {trim.power.main_rotor / 1e3:.0f} kW, the sum of its parts."
        ),
    ),
    _Rule(
        "low-speed-inflow",
        lambda trim: 0.0 < trim.mu < LOW_SPEED and trim.fixed_inflow,
        lambda trim: f"Linear inflow is not valid below advance ratio {LOW_SPEED:g}; this is {trim.mu:.3f}.",
    ),
    _Rule(
        "low-speed-inflow",
        lambda trim: 0.0 < trim.mu < LOWEST_SPEED and not trim.fixed_inflow,
        lambda trim: f"No skewed-wake model is validated below advance ratio {LOWEST_SPEED:g}; this is {trim.mu:.3f}.",
    ),
    _Rule(
        "low-speed-not-matched",
        lambda trim: hover_share(trim.design) and trim.problem.joined is None,
        lambda trim: (
            "The hover model has no answer at this weight, so the inflow does not pass over to hover at low speed."
        ),
    ),
    _Rule(
        "vortex-ring",
        lambda trim: (
            trim.design.condition.climb_speed < 0.0
            and trim.descent[0] > -VORTEX_RING_ONSET
            and trim.descent[1] < math.inf
        ),
        lambda trim: (
            f"The descent is {trim.descent[0]:.2f} of the induced velocity in hover: at this low speed measured inflow "
            f"exceeds that of momentum theory from {-VORTEX_RING_ONSET:g} on, and at {trim.descent[1]:.2f} the vortex "
            "ring state begins."
        ),
    ),
    _Rule(
        "beyond-autorotation",
        lambda trim: trim.power.main_rotor < 0.0 and not trim.on_stand,
        lambda trim: (
            "The air drives the rotor: beyond the rate of descent of autorotation power is negative, and with the "
            "engine off the rotor turns faster."
        ),
    ),
    _Rule(
        "installed-power",
        lambda trim: trim.power.total > (trim.design.aircraft.installed_power or math.inf) and not trim.on_stand,
        lambda trim: (
            f"The rotors take {1e-3 * trim.power.total:.0f} kW; the engines give "
            f"{1e-3 * (trim.design.aircraft.installed_power or 0.0):.0f} kW at sea level, and less at altitude."
        ),
    ),
    _Rule(
        "controls",
        lambda trim: not trim.on_stand and trim.beyond_stops,
        lambda trim: f"The trim needs more than the controls give: {', '.join(trim.beyond_stops)}.",
    ),
    _Rule(
        "high-speed",
        lambda trim: trim.mu > HIGH_SPEED,
        lambda trim: (
            f"Above advance ratio {HIGH_SPEED:.2f} reverse flow and stall decide, which the sections here describe "
            "roughly."
        ),
    ),
    _Rule(
        "blade-loading",
        lambda trim: trim.design.hovering and trim.loading > HOVER_CAUTION,
        lambda trim: (
            f"C_T/σ {trim.loading:.3f} in hover is above {HOVER_CAUTION:g}: maximum lift decides here, and power comes "
            f"out too low. {_nearest_to_stall(trim.fields.stall_margin, trim.problem.disk.r)}"
        ),
    ),
    _Rule(
        "stall",
        lambda trim: trim.stalled > STALL_SHARE and trim.fields.unsteady is None,
        lambda trim: (
            f"{100.0 * trim.stalled:.1f} % of the disk is stalled; section data are steady, without dynamic stall."
        ),
    ),
    _Rule(
        "no-dynamic-stall",
        lambda trim: (
            trim.design.models.has("dynamic_stall") and not trim.problem.inflow.pointwise and not trim.design.hovering
        ),
        lambda trim: (
            f"The inflow {trim.design.models.inflow} balances the load at each point by itself, which sections that "
            "stall with lags do not allow: they are steady here."
        ),
    ),
    _Rule(
        "stall",
        lambda trim: trim.stalled > STALL_SHARE and trim.fields.unsteady is not None,
        lambda trim: (
            f"{100.0 * trim.stalled:.1f} % of the disk is stalled; the lags of dynamic stall are those of a NACA 0012."
        ),
    ),
    _Rule(
        "no-compressibility",
        lambda trim: trim.by_polynomials and trim.top_mach > 0.5,
        lambda trim: f"The section polar holds for one Mach number; the tip reaches Mach {trim.top_mach:.2f}.",
    ),
    _Rule(
        "mixed-section-data",
        lambda trim: (
            trim.by_polynomials
            and any(not span.section.startswith(THESIS_NAME) for span in trim.design.rotor.blade.spans)
        ),
        lambda trim: (
            f"Part of the blade has the polynomials {THESIS_NAME} of one Mach number and transition, the rest "
            "tables with Mach number: their difference is one of data, not of airfoils."
        ),
    ),
    _Rule(
        "polynomial-clamped",
        lambda trim: trim.clamped > 0.0,
        lambda trim: (
            f"{100.0 * trim.clamped:.1f} % of the disk is outside the fitted range of the polynomials and clamped."
        ),
    ),
    _Rule(
        "mach-outside-data",
        lambda trim: not trim.by_polynomials and trim.top_mach > trim.problem.disk.mach_limit,
        lambda trim: (
            f"The tip reaches Mach {trim.top_mach:.2f}; section data end at {trim.problem.disk.mach_limit:.2f} and are "
            "constant above."
        ),
    ),
)
"""Caveats in the order in which they are listed."""


def caveats(trim: Trimmed) -> Iterator[Caveat]:
    """The limits of validity that a converged solution exceeds."""
    for remark in trim.design.aircraft.remarks:
        yield Caveat("rotor-file", remark)
    for rule in _RULES:
        if rule.applies(trim):
            yield Caveat(rule.name, rule.sentence(trim))


def _switches(design: Design) -> str:
    names = ", ".join(switch.title.lower() for switch in switched_off(design.models))
    return f"Switched off: {names}. The result is for teaching, not for the aircraft."


def _nearest_to_stall(margin: Array, r: Array) -> str:
    """The element of a hovering blade that is nearest to stall, or furthest beyond it."""
    least = margin.min(axis=1)
    at = int(least.argmin())
    side = "below" if least[at] >= 0.0 else "above"
    return f"At {r[at]:.2f} R the blade is {abs(math.degrees(least[at])):.1f}° {side} its stall angle."


def _rigid(moment: HubMoment) -> str:
    side = "retreating" if moment.roll >= 0.0 else "advancing"
    nose = "up" if moment.pitch >= 0.0 else "down"
    return (
        f"Rigid blades without cyclic: the hub carries {abs(moment.roll) / 1e3:.0f} kN m rolling to the {side} side "
        f"and {abs(moment.pitch) / 1e3:.0f} kN m nose-{nose}."
    )


HOVER_LIMIT = 0.17
"""Largest C_T/σ: every blade element at its maximum lift, as tests show (Prouty, Helicopter Performance, Stability, and
Control, 1986, figure 5.2; Bousman, NASA TM-2000-209601, is quoted with 0.18 for SC1095 at tip Mach 0.65)."""
LARGEST_FLAPPING = math.radians(20.0)
"""Coning and flapping, whose equations are those of small angles."""
LARGEST_CONTROL = math.radians(35.0)
"""Collective at 0.75 R and cyclic: no rotor's controls reach further."""
LARGEST_TILT = math.radians(40.0)
"""Shaft tilt: beyond it the rotor flies as a propeller."""


def implausible(problem: Problem, elements: BladeElements, total: DiskSums) -> str:
    """Why a trim that closes is refused all the same, as a sentence; empty where nothing speaks against it."""
    state, design = elements.state, problem.design
    lighter = "lower the mass, the altitude or the speed"
    checks = (
        ("coning", state.coning, LARGEST_FLAPPING, "check the blade's mass and flap inertia, or lower the mass"),
        ("flapping", math.hypot(state.flap_1c, state.flap_1s), LARGEST_FLAPPING, lighter),
        ("collective", state.collective, LARGEST_CONTROL, lighter),
        ("cyclic", math.hypot(state.cyclic_1c, state.cyclic_1s), LARGEST_CONTROL, lighter),
        ("shaft tilt", state.shaft_tilt, LARGEST_TILT, "raise the mass, or lower the speed or the drag area"),
        ("elastic twist", _largest_twist(elements), LARGEST_FLAPPING, "stiffen the blade, or lower the mass"),
    )
    for name, value, largest, remedy in checks:
        if not abs(value) <= largest:
            return (
                f"Not trimmed: the forces balance at a {name} of {math.degrees(value):,.0f}°, beyond "
                f"±{math.degrees(largest):.0f}°, where these equations no longer hold: {remedy}."
            )
    loading = total.thrust / design.rotor.solidity
    if design.hovering and loading > HOVER_LIMIT:
        return (
            f"Not trimmed: hover needs C_T/σ {loading:.3f}, and rotors have reached about {HOVER_LIMIT:g} with every "
            "blade element at its maximum lift: lower the mass or the altitude."
        )
    return ""


def _largest_twist(elements: BladeElements) -> float:
    """Elastic twist of the largest size [rad]; 0 for a rigid blade."""
    if elements.torsion is None:
        return 0.0
    twist = elements.torsion.twist
    return float(twist.flat[np.abs(twist).argmax()])


def _share(stalled: float, reached: float) -> str:
    """How much of the disk is stalled: at the nearest trim found, or where the last attempt ended."""
    where = "there" if 0.0 < reached < 1.0 else "in the last attempt"
    return f" {100.0 * stalled:.0f} % of the disk is stalled {where}." if stalled > STALL_SHARE else ""


def failure_sentence(design: Design, reached: float, stalled: float) -> str:
    """Why a design did not trim, and the remedy."""
    condition = design.condition
    if condition.stand is not None:
        return _stand_failure(design, condition.stand, reached, stalled)
    share = _share(stalled, reached)
    if design.hovering:
        return (
            f"Not trimmed: the hovering rotor produces at most {100.0 * reached:.0f} % of the thrust that "
            f"{condition.mass:.0f} kg at {condition.altitude:.0f} m needs; lower the mass or the altitude."
        )
    near = easier_condition(design, reached)
    how_far = ""
    if reached > 0.0 and near.advance_ratio == condition.advance_ratio:
        how_far = f" A trim was found only up to {math.floor(near.mass)} kg."
    elif reached > 0.0:
        how_far = f" The nearest trim found is at {near.mass:.0f} kg and advance ratio {near.advance_ratio:.3f}."
    return (
        f"Not trimmed: {condition.mass:.0f} kg at {condition.altitude:.0f} m and advance ratio "
        f"{condition.advance_ratio:.3f} is beyond this rotor.{how_far}{share} "
        f"Lower the mass, the altitude or the speed{'' if design.models.flapping else ', or let the blades flap'}."
    )


def stalled_sentence(design: Design, stalled: float, mass: float | None, mu: float | None) -> str:
    """Why a trim with very much stall has no power, with the largest mass and advance ratio that have one."""
    remedy = "Lower the thrust or the advance ratio."
    if design.condition.stand is None:
        largest = [f"{math.floor(mass)} kg at this speed"] if mass is not None else []
        largest += [f"advance ratio {math.floor(1e3 * mu) / 1e3:.3f} at this mass"] if mu is not None else []
        remedy = "Lower the mass, the altitude or the speed."
        remedy = f"The largest that trim are {' and '.join(largest)}." if len(largest) > 1 else remedy
        remedy = f"The largest that trims is {largest[0]}." if len(largest) == 1 else remedy
    return (
        f"Not trimmed: {100.0 * stalled:.0f} % of the thrust comes from stalled sections, and beyond "
        f"{100.0 * MOST_STALLED:.0f} % no measured rotor says what power it takes. {remedy}"
    )


def _stand_failure(design: Design, stand: Stand, reached: float, stalled: float) -> str:
    """Why a rotor on a test stand did not trim."""
    share = _share(stalled, reached)
    mu = design.condition.advance_ratio
    what = f"the rotor on the stand has no equilibrium at advance ratio {mu:.3f}"
    if stand.collective is not None:
        return (
            f"Not trimmed: {what} with collective {math.degrees(stand.collective):.2f}° and positive thrust.{share} "
            "Change the collective or the advance ratio."
        )
    wanted = design.weight_coefficient / design.rotor.solidity
    how_far = ""
    if 0.0 < reached < 1.0 and not design.hovering:  # In hover it is the share of the thrust.
        near = easier_condition(design, reached).stand
        how_far = f" The nearest trim found is at C_T/σ {near.ct_over_sigma:.4f}." if near is not None else ""
    return f"Not trimmed: {what} with C_T/σ {wanted:.4f}.{how_far}{share} Lower the thrust or the advance ratio."
