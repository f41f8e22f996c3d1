"""The best twist an actuator can reach: jig twist and voltages together, at two flight conditions.

Not a check afterwards: the optimum is sought among what the fitted actuator can do,

    θ_k(r) = θ_jig(p; r) + s Σ_j v_kj φ_j(r),   k = from, to,

with φ_j the twist that segment j makes over its whole voltage range, rotating, and s the derating. A blade made for it
chooses its jig twist p within the concept, so only differences of v count; a retrofit keeps the twist it has, so its
voltages count from zero volts. Mean power of the two conditions, by their shares of time, is made least by SLSQP on
exact gradients.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize

from rotor.actuator.catalogue import PiezoPly
from rotor.actuator.fitted import Fitted
from rotor.actuator.flap_bending import interpolate_columns
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import REFERENCE_RADIUS, PiecewiseLinearTwist, SumTwist, TwistLaw
from rotor.optimisation.concepts import Concept, nearest
from rotor.trim.adjoint import Adjoint, power_along
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

STATIONS = np.linspace(0.0, 1.0, 41)
"""r/R between which the actuator's shapes are straight."""
REFERENCE = np.array([REFERENCE_RADIUS])
FLATTER = 0.5
"""A second start: the first law flattened by this much."""


@dataclass(frozen=True)
class Pair:
    """Two flight conditions of one aircraft."""

    design: Design
    """Rotor, models, mass and altitude; its twist is what a retrofit starts from."""
    advance_ratios: tuple[float, float]
    """From, to."""
    share: float = 0.5
    """Part of the time spent in the second."""

    def __post_init__(self) -> None:
        if not 0.0 < self.share < 1.0:
            raise ValueError(
                f"time share {self.share:g} is not between 0 and 1: give the part of the time in the second state"
            )
        if self.advance_ratios[0] == self.advance_ratios[1]:
            raise ValueError(f"both conditions have advance ratio {self.advance_ratios[0]:g}: give two that differ")

    @property
    def shares(self) -> tuple[float, float]:
        return 1.0 - self.share, self.share

    def designs(self, base: Design | None = None) -> tuple[Design, Design]:
        """The design at both conditions."""
        base = base or self.design
        first, second = (
            replace(base, condition=replace(base.condition, advance_ratio=mu)) for mu in self.advance_ratios
        )
        return first, second


@dataclass(frozen=True, eq=False)
class Reached:
    """An optimum over one or two conditions."""

    values: tuple[float, ...]
    """The concept's parameters of the jig twist (SI)."""
    swings: tuple[tuple[float, ...], ...]
    """Per condition and segment, as a share of the whole range; empty without an actuator."""
    solutions: tuple[Solution, ...]
    """Trimmed, one per condition."""
    power: float
    """Mean by shares of time [W]."""


def best_twist(design: Design, concept: Concept, starts: Sequence[Sequence[float]] = ()) -> Reached:
    """The concept's twist of least power at one condition."""
    return _search((design,), (1.0,), concept, None, 1.0, starts)


def best_fixed(pair: Pair, concept: Concept, starts: Sequence[Sequence[float]] = ()) -> Reached:
    """The concept's one twist of least mean power: the blade that an actuator has to beat."""
    return _search(pair.designs(), pair.shares, concept, None, 1.0, starts)


def best_reach(
    pair: Pair, concept: Concept, fitted: Fitted, *, derating: float = 1.0, starts: Sequence[Sequence[float]] = ()
) -> Reached:
    """The least mean power with the actuator, within what it can do."""
    return _search(pair.designs(), pair.shares, concept, fitted, derating, starts)


def _search(
    designs: tuple[Design, ...],
    shares: tuple[float, ...],
    concept: Concept,
    fitted: Fitted | None,
    derating: float,
    starts: Sequence[Sequence[float]],
) -> Reached:
    keeps_twist = fitted is not None and fitted.host.kind == "retrofit"
    jigs: list[Sequence[float]] = [()] if keeps_twist else list(starts)
    if not keeps_twist and (fitted is None or not starts):
        first = nearest(concept, designs[0].twist)
        jigs += [first, _flatter(concept, first)]
    found: list[Reached] = []
    for orientation in (1.0, -1.0) if keeps_twist else (1.0,):
        task = _Task(designs, shares, None if keeps_twist else concept, fitted, derating, orientation)
        found += [reached for jig in jigs if (reached := task.descend(jig)) is not None]
    if not found:
        raise RuntimeError(
            "No twist of this concept trims at the flight conditions asked for: lower the weight or the advance ratio."
        )
    return min(found, key=lambda reached: reached.power)


def _flatter(concept: Concept, values: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(v * FLATTER if p.angular else v for v, p in zip(values, concept.parameters, strict=True))


class _Task:
    """One descent: remembers its last trims as the next starts."""

    def __init__(
        self,
        designs: tuple[Design, ...],
        shares: tuple[float, ...],
        concept: Concept | None,
        fitted: Fitted | None,
        derating: float,
        orientation: float,
    ) -> None:
        self.designs, self.shares, self.concept = designs, shares, concept
        self.trims: list[Solution | None] = [None] * len(designs)
        self.segments = len(fitted.shapes) if fitted else 0
        self.shapes = np.zeros((0, len(STATIONS)))
        if fitted:
            self.shapes = derating * (_on_stations(STATIONS, fitted) - _on_stations(REFERENCE, fitted))
        self.bounds = self._jig_bounds() + self._swing_bounds(fitted, orientation)
        self.low = np.array([low for low, _ in self.bounds])
        self.span = np.array([high - low for low, high in self.bounds])

    def _jig_bounds(self) -> list[tuple[float, float]]:
        return [(p.low, p.high) for p in self.concept.parameters] if self.concept else []

    def _swing_bounds(self, fitted: Fitted | None, orientation: float) -> list[tuple[float, float]]:
        """Of v: a new blade counts from its first condition; a retrofit from zero volts, by how its fibres run."""
        if fitted is None:
            return []
        if self.concept is not None:
            return [(0.0, 0.0)] * self.segments + [(-1.0, 1.0)] * self.segments
        low, high = (0.0, 1.0)
        if isinstance(fitted.actuator, PiezoPly):
            low, high = (volts / fitted.actuator.voltage_swing for volts in fitted.actuator.voltage_range)
        ends = (low, high) if orientation > 0.0 else (-high, -low)
        return [ends] * (2 * self.segments)

    def descend(self, jig: Sequence[float]) -> Reached | None:
        start = np.concatenate((jig, np.zeros(len(self.bounds) - len(jig))))
        free = self.span > 0.0
        x0 = np.zeros_like(start)
        x0[free] = np.clip((start[free] - self.low[free]) / self.span[free], 0.0, 1.0)
        first = self._power(x0)
        if first is None:
            return None
        unit = first[0]

        def scaled(x: Array) -> tuple[float, Array]:
            made = self._power(x)
            if made is None:  # A wall: worse than the start, leading back to it.
                return 1.0 + float(np.sum((x - x0) ** 2)), 2.0 * (x - x0)
            return made[0] / unit, made[1] / unit

        ended = minimize(
            scaled, x0, jac=True, method="SLSQP", bounds=[(0.0, float(f)) for f in free],
            options={"ftol": 1e-9, "maxiter": 60},
        )  # fmt: skip
        x = np.clip(np.asarray(ended.x, dtype=float), 0.0, 1.0)
        final = self._power(x)
        if final is None or final[0] > unit:
            x, final = x0, self._power(x0)
        assert final is not None
        values = (self.low + self.span * x).tolist()
        own = len(jig)
        swings = tuple(
            tuple(values[own + k * self.segments : own + (k + 1) * self.segments]) for k in range(len(self.designs))
        )
        solutions = tuple(trim for trim in self.trims if trim is not None)
        return Reached(tuple(values[:own]), swings if self.segments else (), solutions, final[0])

    def _power(self, x: Array) -> tuple[float, Array] | None:
        """Mean power and its gradient by x; None when a condition does not trim."""
        values = (self.low + self.span * x).tolist()
        own = len(values) - 2 * self.segments
        jig = values[:own]
        power, slope = 0.0, np.zeros_like(x)
        for k, (design, share) in enumerate(zip(self.designs, self.shares, strict=True)):
            made = self.concept.apply(design, jig) if self.concept else design
            begin = own + k * self.segments
            swings = np.array(values[begin : begin + self.segments])
            solution = solve(replace(made, twist=self._law(made.twist, swings)), self.trims[k])
            if not solution.converged:
                return None
            self.trims[k] = solution
            by_pitch = power_along(Adjoint(solution))
            power += share * solution.power.total
            if self.concept and own:
                slope[:own] += share * by_pitch.along(self.concept.slopes(jig, by_pitch.r))
            if self.segments:
                shapes = interpolate_columns(by_pitch.r, STATIONS, self.shapes.T).T
                slope[begin : begin + self.segments] += share * by_pitch.along(shapes)
        return power, slope * self.span

    def _law(self, jig: TwistLaw, swings: Array) -> TwistLaw:
        return twisted(jig, swings @ self.shapes) if self.segments and np.any(swings) else jig


def _on_stations(stations: Array, fitted: Fitted) -> Array:
    """What each segment makes at r/R, (segments, stations)."""
    return interpolate_columns(stations, fitted.r, fitted.shapes.T).T


def twisted(jig: TwistLaw, change: Array) -> TwistLaw:
    """A jig law with a change of twist [rad] at STATIONS on top; its SPEC can be read again."""
    rates = np.diff(change) / np.diff(STATIONS)
    return SumTwist(jig, PiecewiseLinearTwist(tuple(rates.tolist()), tuple(STATIONS[1:-1].tolist())))
