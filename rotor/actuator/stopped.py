"""An actuator that stops in flight: its twist frozen where it was, on all blades or on one.

On all blades the frozen twist is one more design at each speed. On one blade, the others keep their trim: controls,
inflow and airspeed are theirs, and the one that differs has its own flapping, from

    (ν² − n²) Δβ_n = Γ [Σ (r − e) ΔdC_T/dr dr]_n,    ΔU_P = (r − e) Δβ' + µ_x cos ψ Δβ

with the forces of the section at its own pitch and velocities. Its loads on the hub less those of the others do not
cancel over the blades; at once per revolution they shake the airframe. Left out for one blade: that the pilot trims
again, that the wake of one blade differs, motion in lag, bending, and a change of elastic twist.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import root

from rotor.actuator.flight import FlightLeg, fly
from rotor.actuator.installation import with_actuator_mass
from rotor.actuator.verdict import Verdict, try_actuator
from rotor.aero.inflow import inflow_model
from rotor.aero.section import FR, FX, FZ, TH, UP
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.units import KNOT

_HARMONICS = 6
"""Harmonics of the flapping of a blade that differs."""


@dataclass(frozen=True)
class OneBlade:
    """What a blade that differs from the others puts into the hub at once per revolution, amplitudes."""

    aft_n: float
    side_n: float
    up_n: float
    roll_nm: float
    pitch_nm: float
    track_m: float
    """Largest height of its tip over the path of the others', or depth below it [m]."""

    @property
    def force_n(self) -> float:
        """The largest of the forces [N]."""
        return max(self.aft_n, self.side_n, self.up_n)

    @property
    def moment_nm(self) -> float:
        """The larger of the moments [N m]."""
        return max(self.roll_nm, self.pitch_nm)


@dataclass(frozen=True)
class Flown:
    """A trim in numbers."""

    twist: float
    """Twist of the tip relative to the root, built in as well [rad]."""
    power: float | None
    """Power of all rotors [W]; None where it does not trim."""
    stalled_area: float
    collective: float
    """[rad], as the following; pitch at 0.75 R."""
    cyclic: float
    """Amplitude of the cyclic."""
    controls_left: float | None
    """The least part of a control's range that is left to its stop, 0.5 in the middle and negative beyond; None where
    the rotor file does not say."""
    message: str

    def record(self) -> dict[str, float | None]:
        """Numbers, for JSON and tables; angles in degrees."""
        return {
            "power_w": self.power,
            "twist_deg": math.degrees(self.twist),
            "stalled_percent": 100.0 * self.stalled_area,
            "collective_deg": math.degrees(self.collective),
            "cyclic_deg": math.degrees(self.cyclic),
            "controls_left_percent": None if self.controls_left is None else 100.0 * self.controls_left,
        }


@dataclass(frozen=True)
class FailurePoint:
    """One speed with the actuator working, and with it stopped."""

    mu: float
    speed: float
    """[m/s]"""
    working: Flown
    stopped: Flown
    power_left: float | None
    """Power left of the engines, stopped [W]; None where their power is not known, or nothing trims."""
    one_blade: OneBlade | None
    """Stopped on one blade only; None where the working rotor does not trim, in hover, and where twist at n/rev is
    another than at the stop."""

    @property
    def cost(self) -> float | None:
        """Power that the failure of all blades costs [W]."""
        here, there = self.stopped.power, self.working.power
        return None if here is None or there is None else here - there

    def record(self) -> dict[str, Any]:
        """Texts and numbers, for JSON and tables; angles in degrees."""
        trims: dict[str, Any] = {}
        for name, trim in (("working", self.working), ("stopped", self.stopped)):
            trims |= {f"{name}_{key}": value for key, value in trim.record().items()}
        return {
            "mu": self.mu,
            "speed_kt": self.speed / KNOT,
            **trims,
            "message": self.stopped.message,
            "cost_w": self.cost,
            "power_left_w": self.power_left,
            "one_blade": None if self.one_blade is None else asdict(self.one_blade),
        }


@dataclass(frozen=True)
class Failure:
    """An actuator stopped at one speed, over several."""

    actuator: str
    stops_at: float
    """Advance ratio at which it stops."""
    points: tuple[FailurePoint, ...]

    def record(self) -> dict[str, Any]:
        """Texts, numbers and lists, for JSON."""
        points = [point.record() for point in self.points]
        return {"actuator": self.actuator, "stops_at_mu": self.stops_at, "points": points}


SPEEDS = (0.0, 0.1, 0.2, 0.3, 0.35)
"""Advance ratios at which a frozen twist is flown."""


def failure(
    actuator: str | Verdict, design: Design | None = None, *, stops_at: float = 0.0, mu: Iterable[float] = SPEEDS
) -> Failure:
    """Stop an actuator at one speed and fly on: power, stall, controls, engines' power, and one blade alone.

    The twist of the working actuator at each speed is the best within its range (`fly`), held drive not counted.

    Parameters:
        actuator: name of an actuator, for example `MFC_P1`, as a retrofit; or a verdict on one.
        design: what carries it; not used with a verdict.
        stops_at: advance ratio at which it stops.
        mu: advance ratios at which the frozen twist is flown.

    Returns:
        A point for each advance ratio, in order: the trims of all blades working and all stopped, and one blade alone.

    Raises:
        ValueError: the blade cannot carry the actuator, or a speed cannot be used.
        RuntimeError: no working actuator trims.
    """
    if isinstance(actuator, str):
        if design is None:
            raise ValueError("an actuator needs a blade: give a design, for example rotor.make_design()")
        actuator = try_actuator(actuator, design)
    speeds = [stops_at, *mu]
    flight = fly(actuator, [FlightLeg(f"µ {speed:g}", speed) for speed in speeds])
    heavy = [with_actuator_mass(driven, actuator.installed) for driven in flight.designs]
    return Failure(actuator.installed.actuator.id, stops_at, frozen(heavy[1:], heavy[0], flight.jig))


def frozen(working: Sequence[Design], stopped: Design, jig: TwistLaw | None = None) -> tuple[FailurePoint, ...]:
    """Each design as it is, and with the twist and the active twist of the one at which the actuator stops.

    jig: the twist at which the stops of the controls hold, for pitch is given at the root; by default each its own.
    """
    points: list[FailurePoint] = []
    for design in working:
        stuck = replace(design, twist=stopped.twist, active_twist=stopped.active_twist)
        here = solve(design)
        there = here if stuck == design else solve(stuck, here)
        engines = design.aircraft.installed_power
        left = None if engines is None or not there.converged else engines - there.power.total
        alone = here.converged and stuck.active_twist == design.active_twist and not why_not_one(design)
        shaken = one_blade(here, stopped.twist) if alone else None
        mu = design.condition.advance_ratio
        points.append(FailurePoint(mu, design.airspeed, _flown(here, jig), _flown(there, jig), left, shaken))
    return tuple(points)


def _flown(trim: Solution, jig: TwistLaw | None) -> Flown:
    design, controls = trim.design, trim.controls
    stops, stations = design.aircraft.controls, [design.rotor.blade.root_cutout, 0.75, 1.0]
    root, rest, tip = design.twist(stations)
    left = None
    if stops is not None:
        as_rigged = (design.twist if jig is None else jig)(stations)
        turned = float(root - rest - (as_rigged[0] - as_rigged[1]))
        left = stops.left(controls.collective + turned, controls.cyclic_1c, controls.cyclic_1s)
    power = trim.power.total if trim.converged else None
    cyclic = math.hypot(controls.cyclic_1c, controls.cyclic_1s)
    return Flown(float(tip - root), power, trim.stalled_area, controls.collective, cyclic, left, trim.message)


def why_not_one(design: Design) -> str:
    """Why one blade alone cannot be solved, in a sentence; empty where it can."""
    if design.hovering:
        return "In hover the inflow is balanced annulus by annulus with all blades alike: give a speed."
    if design.models.bending or not design.models.flapping:
        return "One blade alone is solved with blades that flap as rigid ones: bending off, flapping on."
    return "" if inflow_model(design.models.inflow).pointwise else f"{design.models.inflow} balances each blade alone."


def one_blade(trim: Solution, twist: TwistLaw) -> OneBlade:
    """One blade with another twist on a trimmed rotor: its loads at once per revolution on the hub, less the others'.

    Raises RuntimeError where the rotor does not trim, ValueError where `why_not_one` says.
    """
    linear = trim.require().linear
    assert linear is not None
    problem, point, design = linear.problem, linear.point, trim.design
    if reason := why_not_one(design):
        raise ValueError(reason)
    disk, flap, blade, radius = problem.disk, problem.flap, design.rotor.blade, design.rotor.radius
    channels: Array = point.channels
    psi = disk.psi
    arm, change = np.maximum(disk.r - flap.hinge, 0.0), twist(disk.r) - design.twist(disk.r)
    mu_x = design.condition.advance_ratio * math.cos(trim.controls.shaft_tilt)
    n = np.arange(1, _HARMONICS + 1)
    angles = np.outer(n, psi)
    waves = np.concatenate([np.ones((1, len(psi))), np.cos(angles), np.sin(angles)])
    order = np.concatenate([[0], n, n])
    rates = order[:, None] * np.concatenate([np.zeros((1, len(psi))), -np.sin(angles), np.cos(angles)])

    def loads(flapping: Array) -> Array:
        """Forces along the blade, (forces, elements, azimuths)."""
        moved = channels.copy()
        moved[TH] += change[:, None]
        moved[UP] += arm[:, None] * (flapping @ rates) + mu_x * np.cos(psi) * (flapping @ waves)
        return point.system.section(moved, point.grid.data, False, False)[0]

    others = point.system.section(channels, point.grid.data, False, False)[0]
    stiffness = flap.frequency_squared - order**2.0

    def residual(flapping: Array) -> Array:
        moment = flap.load_gain * (arm * disk.dr) @ (loads(flapping)[FZ] - others[FZ])
        means = waves @ moment / len(psi)
        means[1:] *= 2.0
        return stiffness * flapping - means

    solved: Any = root(residual, np.zeros(len(order)), tol=1e-12)
    flapping: Array = solved.x
    each = design.thrust_unit / design.rotor.blades
    inertia = blade.flap_static_moment * design.rotor.angular_speed**2
    more: list[Array] = [each * (disk.dr @ (loads(flapping)[k] - others[k])) for k in (FZ, FX, FR)]
    lift_change, drag, friction = more
    moved: list[Array] = [flapping @ waves, flapping @ rates, -(order**2 * flapping) @ waves]
    beta, beta_rate, beta_second = moved
    c = trim.controls
    rest: Array = c.coning + c.flap_1c * np.cos(psi) + c.flap_1s * np.sin(psi)
    rest_rate: Array = c.flap_1s * np.cos(psi) - c.flap_1c * np.sin(psi)
    rest_second = c.coning - rest
    # ρ = e + l (1 − β²/2): outward −m (ρ'' − ρ), forward −2 m ρ', both less those of the others.
    whole, whole_rate, whole_second = rest + beta, rest_rate + beta_rate, rest_second + beta_second
    growth = whole_rate**2 + whole * whole_second - rest_rate**2 - rest * rest_second
    up = lift_change - inertia * beta_second
    lift: Array = each * (disk.dr @ others[FZ])
    outward = friction - (lift + lift_change) * whole + lift * rest + inertia * (growth - 0.5 * (whole**2 - rest**2))
    forward = -drag + 2.0 * inertia * (whole * whole_rate - rest * rest_rate)
    moment = flap.hinge * radius * up + blade.flap_spring * beta

    def once(load: Array) -> float:
        return 2.0 * math.hypot(float(load @ np.cos(psi)), float(load @ np.sin(psi))) / len(psi)

    return OneBlade(
        aft_n=once(outward * np.cos(psi) - forward * np.sin(psi)),
        side_n=once(outward * np.sin(psi) + forward * np.cos(psi)),
        up_n=once(up),
        roll_nm=once(moment * np.sin(psi)),
        pitch_nm=once(moment * np.cos(psi)),
        track_m=float((1.0 - flap.hinge) * radius * np.abs(beta).max()),
    )
