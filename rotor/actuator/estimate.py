"""Net saving of one build to second order about the best fixed blade of its stiffness, from a few trims.

Twist is linear with a rate p, and the actuator adds its shape φ(r), swing v of its range, at the second condition; a
new blade's jig twist is free, so only the difference between both conditions counts. With δ the change of p from the
best fixed blade of that stiffness, s the shares of time, ℓ(r) the linear shape and g_k(r) the exact (adjoint) gradient
of power by pitch at condition k, of the build at rest,

    F(δ, v) = Σ s_k (P_k + a_k δ + ½ h_k δ²) + s₂ (b v + c δ v + ½ d v²),   a_k = g_k·ℓ,   b = g₂·φ

h is the change of a with δ, from gradients on both sides; c and d are the changes of g₂·ℓ and g₂·φ with v, from
one trim of the driven blade. Then

    gross = min over δ of F(δ, 0) − min over δ, |v| ≤ 1 of F(δ, v),   stiffness = min over δ of F(δ, 0) − P_fixed

At the best fixed blade Σ s_k a_k is nearly zero, but g₂ alone is not: what an actuator earns first is s₂ b v, so a
radian of φ is worth (g₂·φ)/(g₂·ℓ) of a radian of linear twist. On a soft blade that ratio can be nearly nothing or
change its sign, because the air twists the blade on; tip twist alone says nothing of it. Mass is that of the build at
rest, by trims with and without it; the drive is that of the swing.

Against the full search of `judge` (measured, tests/rotor/actuator/test_estimate.py): gross within 6 % on elastic
blades and 12 % on rigid ones, which twist further; stiffness within 1 W, mass within 2 %.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.installation import InstalledActuator, drive, with_actuator_mass
from rotor.actuator.optimum import STATIONS, Baseline, ConditionPair, best_fixed, law_shapes, twisted
from rotor.actuator.section import Host, default_placement
from rotor.arrays import Array
from rotor.dynamics.structure import uh60a_torsion
from rotor.dynamics.torsion import Addition, stiffer_blade
from rotor.optimisation.concepts import Concept
from rotor.trim.adjoint import Adjoint, PitchGradient, power_along
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

STEP = math.radians(1.0)
"""Change of twist for second derivatives, per radius or at the tip [rad]."""
NOTHING = 1e-9
"""Least twist [rad] or swing that a derivative is taken over."""


@dataclass(frozen=True, eq=False)
class HostBlade:
    """The best fixed linear twist of a blade of another stiffness, without an actuator on it."""

    pair: ConditionPair
    """The conditions as given: the design has the stiffness of the aircraft's blade."""
    concept: Concept
    rate: float
    """Linear twist [rad per radius]."""
    solutions: tuple[Solution, ...]
    """Trimmed, one per condition."""
    curvatures: tuple[float, ...]
    """h: second derivative of power by the rate, one per condition [W/rad²]."""
    fixed_power: float
    """Mean of the best fixed blade of the aircraft's own stiffness, which savings count from [W]."""


def host_blade(base: Baseline, host: Host) -> HostBlade:
    """Find it; `base` is of the linear concept. Raises RuntimeError where it does not trim."""
    pair, fixed = base.pair, base.fixed
    design = pair.design
    if design.elastic:
        low, high = (end * design.rotor.radius for end in default_placement().span)
        nothing = Addition((low, high), 0.0, 0.0, 0.0)
        structure = stiffer_blade(uh60a_torsion(design.rotor.radius), host.stiffness, nothing)
        blade = replace(design.rotor.blade, structure=structure)
        softer = replace(pair, design=replace(design, rotor=replace(design.rotor, blade=blade)))
        fixed = best_fixed(softer, base.concept, [base.fixed.values], alone=True)
    (rate,) = fixed.values
    curvatures: list[float] = []
    for at_rest in fixed.solutions:
        turned = (base.concept.apply(at_rest.design, [rate + step]) for step in (-STEP, STEP))
        low, high = (_gradient(solve(design, at_rest)) for design in turned)
        linear = base.concept.slopes([rate], low.r)
        curvatures.append(float((high.along(linear) - low.along(linear))[0]) / (2.0 * STEP))
    return HostBlade(pair, base.concept, rate, fixed.solutions, tuple(curvatures), base.fixed.power)


@dataclass(frozen=True)
class Estimate:
    """What one build saves and costs [W], means over both conditions."""

    swing: float
    """Best share of the actuator's range at the second condition, −1…1; the first has none."""
    gross: float
    """Saving of its twist."""
    stiffness_cost: float
    """Saving lost to the stiffness and inertia that the blade has with the actuator on it, at rest."""
    mass_cost: float
    drive_cost: float

    @property
    def net(self) -> float:
        """gross − stiffness − mass − drive."""
        return self.gross - self.stiffness_cost - self.mass_cost - self.drive_cost


def estimate(installed: InstalledActuator, blade: HostBlade, *, derating: float = 1.0) -> Estimate:
    """Estimate a build on its host blade, with `derating` as a factor on its twist; at most six trims.

    Raises RuntimeError with one sentence where the build does not trim.
    """
    pair = blade.pair
    designs = [blade.concept.apply(installed.on(design), [blade.rate]) for design in pair.designs()]
    rest = [solve(design, start).require() for design, start in zip(designs, blade.solutions, strict=True)]
    before = [_gradient(solution) for solution in rest]
    r = before[1].r
    linear = blade.concept.slopes([blade.rate], r)[0]
    offset = pair.mean(float(linear @ gradient.by_element) for gradient in before)
    stiffness = pair.mean(blade.curvatures)
    at_rest = pair.mean(solution.power.total for solution in rest)
    swing, gross = 0.0, 0.0
    shape: Array = derating * law_shapes(installed, pair.design)[0]
    phi: Array = np.interp(r, STATIONS, shape)
    tip = float(np.ptp(shape))
    if tip > NOTHING:
        slope = float(phi @ before[1].by_element)
        trial = -math.copysign(min(1.0, STEP / tip), slope)
        for _ in range(2):  # Once to find the swing, once with second derivatives over just that swing.
            driven = replace(designs[1], twist=twisted(designs[1].twist, trial * shape))
            change = _gradient(solve(driven, rest[1])).by_element - before[1].by_element
            cross, square = float(linear @ change) / trial, float(phi @ change) / trial
            swing, gross = _best_swing(slope, cross, square, offset, stiffness, pair.share)
            if abs(swing) < NOTHING:
                break
            trial = swing
    loaded = [solve(with_actuator_mass(solution.design, installed), solution).require() for solution in rest]
    return Estimate(
        swing=swing,
        gross=gross,
        stiffness_cost=at_rest - 0.5 * offset**2 / stiffness - blade.fixed_power,
        mass_cost=pair.mean(solution.power.total for solution in loaded) - at_rest,
        drive_cost=drive(installed, (swing,)).hold_power,
    )


def _gradient(solution: Solution) -> PitchGradient:
    return power_along(Adjoint(solution))


def _best_swing(
    slope: float, cross: float, square: float, offset: float, stiffness: float, share: float
) -> tuple[float, float]:
    """The swing of least power with the jig twist that suits it, and what it saves.

    With δ(v) = −(A + s₂ c v)/H the saving is −s₂ (b − c A/H) v − ½ (s₂ d − (s₂ c)²/H) v².
    """
    first = share * (slope - cross * offset / stiffness)
    second = share * square - (share * cross) ** 2 / stiffness
    inside = [min(max(-first / second, -1.0), 1.0)] if second > 0.0 else []
    saved, swing = max((-first * v - 0.5 * second * v**2, v) for v in (-1.0, 0.0, 1.0, *inside))
    return swing, saved
