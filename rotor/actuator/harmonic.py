"""Harmonic active twist (1/rev, 2/rev): attainable amplitude and its effect on power.

The amplitude is half the voltage range. A rigid trim is given the twist of the rotating blade in vacuum, 1/(1 − (n/ν)²)
near its first mode, without damping. An elastic trim is given the twist of the blade at rest, the moment of the plies;
it finds amplitude and phase itself, with inertia, tension and air (`rotor.aero.elastic`).
Use an inflow model that responds to the load distribution (lifting line).

No measured power of a rotor with active twist was to be had; published savings are computed, or of model rotors.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.catalogue import PiezoPly
from rotor.actuator.installation import InstalledActuator, harmonic_loss, with_actuator_mass
from rotor.arrays import Array
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.design import Design
from rotor.dynamics.torsion import twist_under_moment
from rotor.trim.adjoint import Adjoint
from rotor.trim.hub_loads import BAND, hub_index, why_no_hub_loads
from rotor.trim.solution import Solution
from rotor.trim.solve import in_flow_of, solve_alike

SHAPE_STATIONS = 41
PHASES = 12
RESONANCE_MARGIN = 0.25
"""Least distance from the first torsion frequency [per rev]. Nearer, only damping limits the twist; none is modelled.
Our choice: at 4.6/rev the amplitude then stays below ten times the static twist, 1/(1 − (ω/ω_θ)²)."""


@dataclass(frozen=True, eq=False)
class DynamicTwist:
    """Twist of the whole voltage range at one harmonic."""

    per_rev: int
    amplitude: float
    """At the tip [rad], half of peak to peak, with the dynamic response of the blade in vacuum; at rest for an elastic
    trim, which finds the response."""
    static: float
    """Static amplitude, without the resonance in torsion."""
    stations: tuple[float, ...]
    shape: tuple[float, ...]
    """Over the tip's."""
    at_rest: float = 0.0
    """Amplitude at the tip of the blade at rest [rad], and its shape: what an elastic trim is given."""
    rest_shape: tuple[float, ...] = (0.0, 1.0)
    installed: InstalledActuator | None = None


def dynamic_twist(
    installed: InstalledActuator, per_rev: int, *, derated: bool = False, elastic: bool = False
) -> DynamicTwist:
    """Amplitude and shape at a harmonic; zero for actuators that cannot follow (heat, rotor speed).

    `elastic`: for an elastic trim, which finds the dynamic response itself, damped by the air; amplitude and shape are
    then those of the blade at rest, and no harmonic is refused. Otherwise undamped: ValueError with one sentence at
    resonance.
    """
    if not isinstance(installed.actuator, PiezoPly):
        return DynamicTwist(per_rev, 0.0, 0.0, (0.0, 1.0), (0.0, 1.0))
    if not elastic and abs(per_rev - installed.frequency) < RESONANCE_MARGIN:
        raise ValueError(
            f"{per_rev}/rev is too close to the first torsion frequency of {installed.frequency:.2f}/rev, where only "
            "damping limits the twist and none is modelled: choose another harmonic, stiffness or number of plies"
        )
    share = 0.5 * (installed.derating if derated else 1.0)
    still: Array = share * installed.rest_shapes.sum(axis=0)
    moving = still
    if not elastic:
        low, high = (installed.beam.r[-1] * end for end in installed.placement.span)
        active = np.diff(np.clip(installed.beam.r, low, high)) / np.diff(installed.beam.r)
        moving = twist_under_moment(installed.beam, share * installed.moment * active, per_rev=float(per_rev))
    stations = np.linspace(0.0, 1.0, SHAPE_STATIONS)
    return DynamicTwist(
        per_rev=per_rev,
        amplitude=abs(float(moving[-1])),
        static=share * abs(float(installed.shapes[:, -1].sum())),
        stations=tuple(stations.tolist()),
        shape=_over_the_tip(stations, installed.r, moving),
        at_rest=abs(float(still[-1])),
        rest_shape=_over_the_tip(stations, installed.r, still),
        installed=installed,
    )


def steady_room(installed: InstalledActuator, volts: Sequence[float]) -> float:
    """Part of half the voltage range that steady voltages leave for n/rev, 0…1; none given: 1, about the middle."""
    actuator = installed.actuator
    if not isinstance(actuator, PiezoPly):
        return 0.0
    low, high = actuator.voltage_range
    room = [2.0 * min(high - v, v - low) / (high - low) for v in volts] if any(volts) else [1.0]
    return max(min(room), 0.0)


@dataclass(frozen=True)
class EffectInFlight:
    """What an actuator changes in one flight, against another blade there.

    By inflow model that trims: the design's own first, then those of `hub_loads.BAND`.
    """

    power: tuple[float, ...]
    """[W]"""
    index: tuple[float, ...]
    """Change of the vibration index [%]; empty where there are no hub loads."""


def effect(design: Design, reference: Design) -> EffectInFlight:
    """Change of power and of vibration from `reference` to `design`, both in its flight and with its models.

    `design`: with the actuator's mass and stiffness on board (`with_actuator_mass`). RuntimeError where it does not
    trim with its own inflow model.
    """
    power, index = list[float](), list[float]()
    shaken = why_no_hub_loads(design) is None
    for inflow in dict.fromkeys((design.models.inflow, *BAND)):
        flown = replace(design, models=replace(design.models, inflow=inflow))
        still = in_flow_of(flown, replace(reference, models=flown.models))
        one, other = (solve_alike(each, None, like=still) for each in (flown, still))
        if inflow == design.models.inflow:
            one.require()
            other.require()
        if one.converged and other.converged:
            power.append(one.power.total + _pitching(one) - other.power.total - _pitching(other))
            if shaken:
                index.append(100.0 * (hub_index(Adjoint(one)) / hub_index(Adjoint(other)) - 1.0))
    return EffectInFlight(tuple(power), tuple(index))


def _over_the_tip(stations: Array, r: Array, twist: Array) -> tuple[float, ...]:
    """Twist at the stations over that of the tip."""
    tip = float(twist[-1])
    return tuple(float(value) / tip for value in np.interp(stations, r, twist))


@dataclass(frozen=True, eq=False)
class PhaseSweep:
    """Power against the phase of one harmonic of active twist."""

    dynamic: DynamicTwist
    share: float
    """Fraction of the amplitude used, 0…1."""
    phases: Array
    """[rad], (phases,)."""
    power: Array
    """Change of total power relative to `off` [W], (phases,); phases that did not trim are left out."""
    still: Solution
    """Without the actuator."""
    off: Solution
    """With its plies on the blade, not driven: the other stiffness of an elastic blade moves power by itself."""
    best: Solution
    """The least power found, amplitude and phase by the installed bowl."""
    drive_loss: float
    """Loss in the drives of all blades [W]."""
    net_power: float | None
    """Power of `best` with the actuator's mass and losses [W]; None where it does not trim."""

    @property
    def gross_saving(self) -> float:
        """Against no active twist and no actuator [W]."""
        return self.still.power.total - self.best.power.total

    @property
    def wave_saving(self) -> float:
        """Against the same blade, not driven [W]."""
        return self.off.power.total - self.best.power.total

    @property
    def net_saving(self) -> float | None:
        """Against no actuator, after mass and losses [W]."""
        return None if self.net_power is None else self.still.power.total - self.net_power

    @property
    def response(self) -> tuple[float, float]:
        """Amplitude and phase of the tip's twist at this harmonic in `best` [rad]."""
        return tip_response(self.best, self.dynamic.per_rev)


def phase_sweep(
    design: Design,
    installed: InstalledActuator,
    per_rev: int,
    *,
    reference: Design | None = None,
    derated: bool = False,
) -> PhaseSweep:
    """Sweep the phase at full amplitude, then try the minimum of a quadratic in amplitude and phase.

    The voltage swings about the middle of its range, so no steady change is left; the twist law is that of the middle.
    `reference`: the blade without the actuator that savings count from, `design` unless given. All are trimmed with the
    models of the driven blade: pitch at n/rev makes the flow unsteady, which moves power by itself.
    Raises RuntimeError when a design does not trim without active twist.
    """
    twist = dynamic_twist(installed, per_rev, derated=derated, elastic=design.elastic)
    plain = in_flow_of(with_harmonic(design, twist, 1.0, 0.0), replace(design, active_twist=None))

    def alike(given: Design, start: Solution | None = None) -> Solution:
        return solve_alike(replace(given, models=plain.models), start, like=plain)

    still = alike(reference or plain).require()
    off = alike(installed.on(plain)).require()

    def trimmed(share: float, phases: Sequence[float]) -> list[tuple[float, float, Solution]]:
        trims = [(share, phase, alike(with_harmonic(design, twist, share, phase), off)) for phase in phases]
        return [trim for trim in trims if trim[-1].converged]

    around = trimmed(1.0, [2.0 * math.pi * k / PHASES for k in range(PHASES)]) if twist.amplitude else []
    phases = np.array([phase for _, phase, _ in around])
    changes = np.array([trim.power.total - off.power.total for *_, trim in around])
    bowl = [trial for amplitude, phase in _bowl(phases, changes) for trial in trimmed(amplitude, [phase])]
    share, _, best = min([(0.0, 0.0, off), *around, *bowl], key=lambda trial: trial[-1].power.total)
    loss = installed.masses.blades * harmonic_loss(installed, per_rev, share, installed.beam.angular_speed)
    heavy = alike(with_actuator_mass(best.design, installed))
    return PhaseSweep(
        dynamic=twist,
        share=share,
        phases=phases,
        power=changes,
        still=still,
        off=off,
        best=best,
        drive_loss=loss,
        net_power=heavy.power.total + loss + _pitching(heavy) - _pitching(still) if heavy.converged else None,
    )


def _pitching(solution: Solution) -> float:
    """Power that pitch links and plies put into an elastic blade [W]."""
    return solution.elastic.control_power if solution.elastic is not None else 0.0


def with_harmonic(design: Design, twist: DynamicTwist, share: float, phase: float) -> Design:
    """The design with a share of the actuator's amplitude at a phase [rad], on the blade that the plies stiffen."""
    if design.elastic and twist.installed is not None:
        harmonic = Harmonic(twist.per_rev, share * twist.at_rest, phase)
        active = ActiveTwist((harmonic,), twist.stations, twist.rest_shape)
        return twist.installed.on(replace(design, active_twist=active))
    harmonic = Harmonic(twist.per_rev, share * twist.amplitude, phase)
    return replace(design, active_twist=ActiveTwist((harmonic,), twist.stations, twist.shape))


def tip_response(solution: Solution, per_rev: int) -> tuple[float, float]:
    """Amplitude and phase [rad] of the tip's twist at a harmonic, elastic and active: most nose-up at ψ = phase/n."""
    design, psi = solution.design, solution.disk.psi
    tip = solution.elastic.tip if solution.elastic is not None else np.zeros_like(psi)
    if design.active_twist is not None:
        tip = tip + design.active_twist(np.ones(1), psi)[0]
    wave = 2.0 * np.mean(tip * np.exp(1j * per_rev * psi))
    return float(abs(wave)), float(np.angle(wave))


def _bowl(angle: Array, changes: Array) -> list[tuple[float, float]]:
    """Minimum of ΔP = g·u + ½ u·K u, u = a (cos φ, sin φ), within a ≤ 1: (amplitude, phase).

    Around full amplitude its first harmonic is the slope g; its mean and second harmonic are the curvature K.
    """
    if len(angle) < 8:
        return []
    basis = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle), np.cos(2 * angle), np.sin(2 * angle)])
    mean, gx, gy, cx, cy = np.linalg.lstsq(basis, changes, rcond=None)[0]
    curvature = np.array([[mean + cx, cy], [cy, mean - cx]]) * 2.0
    slope = np.array([gx, gy])
    if np.linalg.eigvalsh(curvature)[0] > 0.0:
        point = -np.linalg.solve(curvature, slope)
        if np.hypot(*point) <= 1.0:
            return [(float(np.hypot(*point)), math.atan2(point[1], point[0]))]
    fine = np.linspace(0.0, 2.0 * math.pi, 361)
    values = np.column_stack([np.cos(fine), np.sin(fine), np.cos(2 * fine), np.sin(2 * fine)]) @ [gx, gy, cx, cy]
    return [(1.0, float(fine[values.argmin()]))]
