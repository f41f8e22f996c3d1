"""Harmonic active twist (1/rev, 2/rev): attainable amplitude and its effect on power.

The amplitude is half the voltage range; the blade responds dynamically in torsion, 1/(1 − (n/ν)²) near its first mode.
Use an inflow model that responds to the load distribution (dynamic wake).

"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.catalogue import PiezoPly
from rotor.actuator.electrical import harmonic_drive
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.verdict import with_actuator_mass
from rotor.arrays import Array
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.design import Design
from rotor.dynamics.structure import twist_under_moment
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

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
    """At the tip [rad], half of peak to peak, with the dynamic response of the blade."""
    static: float
    """The same without it."""
    stations: tuple[float, ...]
    shape: tuple[float, ...]
    """Over the tip's."""


def dynamic_twist(installed: InstalledActuator, per_rev: int, *, derated: bool = False) -> DynamicTwist:
    """Amplitude and shape at a harmonic; zero for actuators that cannot follow (heat, rotor speed).

    Undamped: ValueError with one sentence at resonance.
    """
    if not isinstance(installed.actuator, PiezoPly):
        return DynamicTwist(per_rev, 0.0, 0.0, (0.0, 1.0), (0.0, 1.0))
    if abs(per_rev - installed.frequency) < RESONANCE_MARGIN:
        raise ValueError(
            f"{per_rev}/rev is too close to the first torsion frequency of {installed.frequency:.2f}/rev, where only "
            "damping limits the twist and none is modelled: choose another harmonic, stiffness or number of plies"
        )
    low, high = (installed.beam.r[-1] * end for end in installed.placement.span)
    share = np.diff(np.clip(installed.beam.r, low, high)) / np.diff(installed.beam.r)
    moment = 0.5 * installed.moment * share * (installed.derating if derated else 1.0)
    static = twist_under_moment(installed.beam, moment)
    moving = twist_under_moment(installed.beam, moment, per_rev=float(per_rev))
    stations = np.linspace(0.0, 1.0, SHAPE_STATIONS)
    relative: Array = moving / moving[-1]
    shape = np.interp(stations, installed.r, relative)
    return DynamicTwist(
        per_rev, abs(float(moving[-1])), abs(float(static[-1])), tuple(stations.tolist()), tuple(shape.tolist())
    )


@dataclass(frozen=True, eq=False)
class PhaseSweep:
    """Power against the phase of one harmonic of active twist."""

    dynamic: DynamicTwist
    share: float
    """Fraction of the amplitude used, 0…1."""
    phases: Array
    """[rad], (phases,)."""
    power: Array
    """Change of total power relative to no active twist [W], (phases,); phases that did not trim are left out."""
    still: Solution
    """Without active twist."""
    best: Solution
    """The least power found, amplitude and phase by the installed bowl."""
    drive_loss: float
    """Of all blades [W]."""
    net_power: float | None
    """Power of `best` with the actuator's mass and losses [W]; None where it does not trim."""

    @property
    def gross_saving(self) -> float:
        """Against no active twist and no actuator [W]."""
        return self.still.power.total - self.best.power.total

    @property
    def net_saving(self) -> float | None:
        """The same after mass and losses [W]."""
        return None if self.net_power is None else self.still.power.total - self.net_power


def phase_sweep(design: Design, installed: InstalledActuator, per_rev: int, *, derated: bool = False) -> PhaseSweep:
    """Sweep the phase at full amplitude, then try the minimum of a quadratic in amplitude and phase.

    The voltage swings about the middle of its range, so no steady change is left; the twist law is that of the middle.
    Raises RuntimeError when the design does not trim without active twist.
    """
    made = dynamic_twist(installed, per_rev, derated=derated)
    still = solve(replace(design, active_twist=None)).require()
    phases: list[float] = []
    changes: list[float] = []
    best, least = still, 0.0
    for k in range(PHASES if made.amplitude else 0):
        phase = 2.0 * math.pi * k / PHASES
        turned = solve(with_harmonic(design, made, 1.0, phase), still)
        if not turned.converged:
            continue
        phases.append(phase)
        changes.append(turned.power.total - still.power.total)
        if changes[-1] < least:
            best, least = turned, changes[-1]
    share = 1.0 if best is not still else 0.0
    for amplitude, phase in _bowl(phases, changes):
        turned = solve(with_harmonic(design, made, amplitude, phase), still)
        if turned.converged and turned.power.total - still.power.total < least:
            best, least, share = turned, turned.power.total - still.power.total, amplitude
    loss = installed.masses.blades * harmonic_drive(installed, per_rev, share, installed.beam.angular_speed).loss
    heavy = solve(with_actuator_mass(best.design, installed))
    return PhaseSweep(
        dynamic=made,
        share=share,
        phases=np.array(phases),
        power=np.array(changes),
        still=still,
        best=best,
        drive_loss=loss,
        net_power=heavy.power.total + loss if heavy.converged else None,
    )


def with_harmonic(design: Design, made: DynamicTwist, share: float, phase: float) -> Design:
    """The design with a share of the actuator's amplitude at a phase [rad]."""
    harmonic = Harmonic(made.per_rev, share * made.amplitude, phase)
    return replace(design, active_twist=ActiveTwist((harmonic,), made.stations, made.shape))


def _bowl(phases: list[float], changes: list[float]) -> list[tuple[float, float]]:
    """Minimum of ΔP = g·u + ½ u·K u, u = a (cos φ, sin φ), within a ≤ 1: (amplitude, phase).

    Around full amplitude its first harmonic is the slope g; its mean and second harmonic are the curvature K.
    """
    if len(phases) < 8:
        return []
    angle = np.array(phases)
    basis = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle), np.cos(2 * angle), np.sin(2 * angle)])
    mean, gx, gy, cx, cy = np.linalg.lstsq(basis, np.array(changes), rcond=None)[0]
    curvature = np.array([[mean + cx, cy], [cy, mean - cx]]) * 2.0
    slope = np.array([gx, gy])
    if np.linalg.eigvalsh(curvature)[0] > 0.0:
        point = -np.linalg.solve(curvature, slope)
        if np.hypot(*point) <= 1.0:
            return [(float(np.hypot(*point)), math.atan2(point[1], point[0]))]
    fine = np.linspace(0.0, 2.0 * math.pi, 361)
    values = np.column_stack([np.cos(fine), np.sin(fine), np.cos(2 * fine), np.sin(2 * fine)]) @ [gx, gy, cx, cy]
    return [(1.0, float(fine[values.argmin()]))]
