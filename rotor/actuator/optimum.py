"""Optimum twist over a mission, with and without an actuator.

With an actuator the optimum is sought among the twists it can make,

    θ_k(r) = θ_jig(p; r) + s Σ_j v_kj φ_j(r),   k = 1 … legs,

with φ_j the twist of segment j over its whole voltage range: of the blade at rest where the trim is elastic, which
finds what rotation and air make of it, else of the rotating blade. s scales the range: 0 for a blade that carries the
actuator without driving it. A new blade chooses its jig twist p within the concept, so only differences of v matter:
v is zero on the first leg, and no two legs differ by more than the range. A retrofit keeps its twist, so its voltages
count from zero. SLSQP with exact gradients minimises the mean power of the legs, weighted by their hours.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np

from rotor.actuator.kind import InstalledActuator
from rotor.actuator.limits import interpolate_rows
from rotor.design.design import Design
from rotor.design.twist import REFERENCE_RADIUS, PiecewiseLinearTwist, SumTwist, TwistLaw
from rotor.optimisation.concepts import Concept, nearest, restrict
from rotor.optimisation.descent import slsqp
from rotor.optimisation.mission import Mission
from rotor.support.arrays import Array
from rotor.support.bytes_cache import bytes_cache
from rotor.trim.adjoint import PitchGradient
from rotor.trim.solution import Solution
from rotor.trim.solve import analyse

Starts = Sequence[Sequence[float]]
"""Parameters to begin from, each of one descent."""
STATIONS = np.linspace(0.0, 1.0, 41)
"""r/R between which the actuator's shapes are straight."""
FLATTENED_SHARE = 0.5
"""A second start: the first law flattened by this much."""


@dataclass(frozen=True, eq=False)
class TwistOptimum:
    """An optimum over one condition or the legs of a mission."""

    values: tuple[float, ...]
    """The concept's parameters of the jig twist (SI)."""
    swings: tuple[tuple[float, ...], ...]
    """Per condition and segment, as a share of the whole range; empty without an actuator."""
    solutions: tuple[Solution, ...]
    """Trimmed, one per condition."""
    power: float
    """Mean by shares of time [W]."""


def best_twist(
    design: Design,
    concept: Concept,
    starts: Starts = (),
    *,
    alone: bool = False,
    known: "_Known | None" = None,
) -> TwistOptimum:
    """The concept's twist of least power at one condition; `alone`: search from these starts only."""
    return _search(((design,), (1.0,), ()), concept, None, starts, alone=alone, known=known)


def best_fixed(
    mission: Mission, concept: Concept, *, known: "_Known | None" = None
) -> TwistOptimum:
    """The concept's fixed twist of least mean power."""
    return _search((mission.designs(), mission.shares, ()), concept, None, (), known=known)


def best_actuated(
    mission: Mission,
    concept: Concept,
    installed: InstalledActuator,
    *,
    scale: float = 1.0,
    starts: Starts = (),
    near: Sequence[Solution] = (),
) -> TwistOptimum:
    """Least mean power [W] with the actuator within `scale` times its range; `near`: trims to start from."""
    return _search((mission.designs(), mission.shares, near), concept, (installed, scale), starts)


def best_swings(
    design: Design, installed: InstalledActuator, bounds: Array, near: Solution
) -> TwistOptimum:
    """Least power at one condition of a blade with fixed built-in twist; bounds of swings (segments, 2); a trim
    nearby. RuntimeError where it does not trim."""
    flights = ((design,), (1.0,), (near,))
    reached = _MeanPowerMinimiser(flights, None, (installed, 1.0), bounds, {}).descend(())
    if reached is None:
        raise RuntimeError(
            "The rotor does not trim at this flight condition: reduce the mass or the advance ratio."
        )
    return reached


_Flights = tuple[tuple[Design, ...], tuple[float, ...], Sequence[Solution]]
"""Designs at their conditions, the shares of time, and trims to begin with: one for each, or none."""
_Fitted = tuple[InstalledActuator, float] | None
"""An actuator, and the part of its range that is used."""
_AT_REST = (0.0, 0.0)
_Known = dict[Design, tuple[Solution, PitchGradient | None]]
"""What is trimmed already: searches meet in their starts, and a descent asks for its ends again."""


def _search(
    flights: _Flights,
    concept: Concept,
    fitted: _Fitted,
    starts: Starts,
    *,
    alone: bool = False,
    known: _Known | None = None,
) -> TwistOptimum:
    known = {} if known is None else known
    installed, driven = fitted and fitted[0], bool(fitted and fitted[1])
    if installed is not None and installed.host.kind == "retrofit":
        low, high = installed.actuator.retrofit_swings
        either = ((low, high), (-high, -low)) if driven else (_AT_REST,)  # Direction of fibres.
        found = [_with_own_twist(flights, fitted, ends, known) for ends in either]
    else:
        # From the first condition: only differences matter.
        segments = len(installed.shapes) if installed else 0
        others = (len(flights[0]) - 1) * segments
        bounds = [_AT_REST] * segments + [(-1.0, 1.0) if driven else _AT_REST] * others
        minimiser = _MeanPowerMinimiser(flights, concept, fitted, bounds, known)
        jigs = list(starts)
        if not alone and (installed is None or not starts):
            first = nearest(concept, flights[0][0].twist)
            flatter = tuple(
                v * FLATTENED_SHARE if p.angular else v
                for v, p in zip(first, concept.parameters, strict=True)
            )
            jigs += [first, flatter]
        found = [minimiser.descend(jig) for jig in jigs]
    optima = [optimum for optimum in found if optimum is not None]
    if not optima:
        raise RuntimeError(
            "No twist of this concept trims at these conditions: reduce mass or advance ratio."
        )
    return min(optima, key=lambda reached: reached.power)


def _with_own_twist(
    flights: _Flights, fitted: _Fitted, ends: tuple[float, float], known: _Known
) -> TwistOptimum | None:
    """Least power of a blade that keeps its built-in twist, leg by leg; None where a leg does not trim.

    No leg's swings bear on another leg.
    """
    assert fitted is not None
    designs, shares, near = flights
    bounds = [ends] * len(fitted[0].shapes)
    legs: list[TwistOptimum] = []
    for k, design in enumerate(designs):
        alone = ((design,), (1.0,), near[k : k + 1])
        reached = _MeanPowerMinimiser(alone, None, fitted, bounds, known).descend(())
        if reached is None:
            return None
        legs.append(reached)
    return TwistOptimum(
        (),
        tuple(leg.swings[0] for leg in legs),
        tuple(leg.solutions[0] for leg in legs),
        sum(share * leg.power for share, leg in zip(shares, legs, strict=True)),
    )


class _MeanPowerMinimiser:
    """Finds the least mean power of some conditions within bounds; each trim starts from the previous one."""

    def __init__(
        self,
        flights: _Flights,
        concept: Concept | None,
        fitted: _Fitted,
        swings: Sequence[tuple[float, float]] | Array,
        known: _Known,
    ) -> None:
        """concept: of the jig twist; None: the designs keep theirs. swings: bounds of each, condition by condition."""
        self.known = known
        (self.designs, self.shares, near), self.concept = flights, concept
        self.trims: list[Solution | None] = [*near] or [None] * len(self.designs)
        self.segments, self.shapes = 0, np.zeros((0, len(STATIONS)))
        if fitted:
            installed, scale = fitted
            self.segments, self.shapes = (
                len(installed.shapes),
                scale * law_shapes(installed, self.designs[0]),
            )
            self.designs = tuple(installed.on(design) for design in self.designs)
        bounds = [(p.low, p.high) for p in concept.parameters] if concept else []
        self.low, high = np.array([*bounds, *swings]).T
        self.span = high - self.low
        self.within_range = self._within_range()

    def descend(self, jig: Sequence[float]) -> TwistOptimum | None:
        start = np.concatenate((jig, np.zeros(len(self.low) - len(jig))))
        free, x0 = self.span > 0.0, np.zeros_like(start)
        x0[free] = np.clip((start[free] - self.low[free]) / self.span[free], 0.0, 1.0)
        first = self._power(x0)
        if first is None:
            return None
        unit = first[0]

        def scaled(x: Array) -> tuple[float, Array]:
            power = self._power(x)
            if power is None:  # Penalty: worse than the start, with a gradient back to it.
                return 1.0 + float(np.sum((x - x0) ** 2)), 2.0 * (x - x0)
            return power[0] / unit, power[1] / unit

        x, final = x0, first
        if free.any():
            bounds, options = [(0.0, float(f)) for f in free], {"maxiter": 60, "ftol": 1e-9}
            ended = slsqp(scaled, x0, bounds=bounds, constraints=self.within_range, options=options)
            x = np.asarray(np.clip(ended.x, 0.0, 1.0), dtype=np.float64)
            final = self._power(x)
            if final is None or final[0] > unit:
                x, final = x0, self._power(x0)
        assert final is not None
        values, each = self._split(x)
        swings = tuple(tuple(row) for row in each.tolist()) if self.segments else ()
        return TwistOptimum(
            tuple(values), swings, tuple(trim for trim in self.trims if trim is not None), final[0]
        )

    def _within_range(self) -> list[dict[str, Any]]:
        """Constraints that no two legs after the first differ by more than the range, as scipy takes them.

        Bounds say so of the first leg, where a blade chooses its jig twist, and of all legs where it keeps its own.
        """
        later = range(1, len(self.designs))
        rows: list[Array] = []
        if self.concept is not None:
            place = np.arange(len(self.low)) - (len(self.low) - len(self.designs) * self.segments)
            for one, other in combinations(later, 2):
                for segment in range(self.segments):
                    row = 1.0 * (place == one * self.segments + segment)
                    rows.append(row - (place == other * self.segments + segment))
        slopes = np.array(rows) * self.span if rows else np.zeros((0, len(self.low)))
        if not slopes.any():
            return []
        offset = np.array(rows) @ self.low

        def room(x: Array) -> Array:
            apart = offset + slopes @ x
            return np.concatenate([1.0 - apart, 1.0 + apart])

        both = np.concatenate([-slopes, slopes])

        def slopes_of_room(_: Array) -> Array:
            return both

        return [{"type": "ineq", "fun": room, "jac": slopes_of_room}]

    def _split(self, x: Array) -> tuple[list[float], Array]:
        """Parameters of the jig twist, and swings, (conditions, segments), of a scaled point."""
        values, swings = self.low + self.span * x, len(self.designs) * self.segments
        jigs = len(values) - swings
        return values[:jigs].tolist(), values[jigs:].reshape(len(self.designs), self.segments)

    def _power(self, x: Array) -> tuple[float, Array] | None:
        """Mean power and its gradient by x; None when a condition does not trim."""
        jig, swings = self._split(x)
        power, slope = 0.0, np.zeros_like(x)
        by_jig, by_swings = slope[: len(jig)], slope[len(jig) :].reshape(swings.shape)
        for k, (design, share) in enumerate(zip(self.designs, self.shares, strict=True)):
            flown = self.concept.apply(design, jig) if self.concept else design
            if np.any(swings[k]):
                flown = replace(flown, twist=twisted(flown.twist, swings[k] @ self.shapes))
            if (found := self.known.get(flown)) is None:
                trim = analyse(flown, self.trims[k])
                found = trim.solution, trim.gradient if trim.solution.converged else None
                self.known[flown] = found
            solution, by_pitch = found
            if by_pitch is None:
                return None
            self.trims[k] = solution
            power += share * solution.power.total
            if self.concept:
                by_jig += share * by_pitch.along(self.concept.slopes(jig, by_pitch.r))
            if self.segments:
                by_swings[k] = share * by_pitch.along(
                    interpolate_rows(by_pitch.r, STATIONS, self.shapes)
                )
        return power, slope * self.span


def law_shapes(installed: InstalledActuator, design: Design) -> Array:
    """What each segment's whole range adds to the design's twist law at STATIONS, zero at 0.75 R [rad], (segments,
    stations)."""
    places = np.append(STATIONS, REFERENCE_RADIUS)
    shapes = interpolate_rows(places, installed.r, installed.shapes_in(design))
    return shapes[:, :-1] - shapes[:, -1:]


def twisted(jig: TwistLaw, change: Array, name: str = "") -> TwistLaw:
    """A jig law with a named change of twist [rad] at STATIONS on top; its SPEC can be read again."""
    rates = np.diff(change) / np.diff(STATIONS)
    return SumTwist(
        jig, PiecewiseLinearTwist(tuple(rates.tolist()), tuple(STATIONS[1:-1].tolist())), name
    )


SMOOTH_DIVISIONS = (0.4, 0.55, 0.7, 0.82)
"""r/R of the electrical segments that follow a curved twist law."""


def divisions_of(law: TwistLaw, parameters: int) -> tuple[float, ...]:
    """r/R where the segments of an actuator meet so that it can follow a law with this number of parameters."""
    if isinstance(law, PiecewiseLinearTwist):
        return law.breaks
    return () if parameters == 1 else SMOOTH_DIVISIONS


@dataclass(frozen=True, eq=False)
class Baseline:
    """Optima of one concept over a mission, without an actuator."""

    mission: Mission
    concept: Concept
    """Breaks fixed where the best fixed blade has them: an actuator cannot move them in flight."""
    best: tuple[TwistOptimum, ...]
    """On each leg alone."""
    fixed: TwistOptimum
    """One blade for all legs."""

    @property
    def ideal_power(self) -> float:
        """Mean power with free in-flight twist [W]."""
        return self.mission.mean(best.power for best in self.best)

    @property
    def ideal_saving(self) -> float:
        """Saving of free in-flight twist against the best fixed blade [W]; the plies' shape can save slightly more."""
        return self.fixed.power - self.ideal_power

    @property
    def fixed_twist(self) -> TwistLaw:
        """The law of the best fixed blade."""
        return self.concept.twist(self.fixed.values)

    @property
    def divisions(self) -> tuple[float, ...]:
        """Stations r/R at which the segments of the concept meet."""
        return divisions_of(self.fixed_twist, len(self.fixed.values))

    def segment_changes(self, divisions: tuple[float, ...]) -> Array:
        """Widest change of twist between the optima of two legs over each segment, cut-out to tip [rad], (segments,).

        Positive where the later leg of the two has the tip further up.
        """
        edges = np.array([self.mission.design.rotor.blade.root_cutout, *divisions, 1.0])
        twists = [np.diff(self.concept.twist(best.values)(edges)) for best in self.best]
        return widest_changes(np.array(twists))


def widest_changes(values: Array) -> Array:
    """From (legs, segments), the change between the two legs that are farthest apart, the later less the earlier."""
    lowest = values.argmin(axis=0)
    highest = values.argmax(axis=0)
    return np.where(highest >= lowest, 1.0, -1.0) * np.ptp(values, axis=0)


@bytes_cache
def baseline(mission: Mission, concept: Concept) -> Baseline:
    """Find the optima; free breaks are fixed at those of the best fixed blade.

    Raises RuntimeError with one sentence when no twist trims.
    """
    known: _Known = {}
    fixed = best_fixed(mission, concept, known=known)
    named = list(zip(concept.parameters, fixed.values, strict=True))
    breaks = {parameter.name: value for parameter, value in named if parameter.unit == "R"}
    if breaks:
        concept = restrict(concept, breaks)
        fixed = replace(
            fixed, values=tuple(value for parameter, value in named if parameter.unit != "R")
        )
    designs = mission.designs()
    best = tuple(best_twist(design, concept, [fixed.values], known=known) for design in designs)
    by_speed = sorted(range(len(designs)), key=lambda k: designs[k].condition.advance_ratio)
    # Without breaks the other two starts are those found above.
    starts = [fixed.values, best[by_speed[0]].values, best[by_speed[-1]].values]
    flights = designs, mission.shares, ()
    better = _search(flights, concept, None, starts, alone=not breaks, known=known)
    return Baseline(mission, concept, best, min((fixed, better), key=lambda optimum: optimum.power))
