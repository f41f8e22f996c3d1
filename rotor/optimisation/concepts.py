"""The twist concepts by name: families of blades with a few named degrees of freedom (thesis chapter 4).

Families with one smooth curve (thesis §4.1.1, §4.1.2, free form) and with straight segments (§4.1.3–4.1.5).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotor.design.twist import (
    REFERENCE_RADIUS,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    TwistLaw,
    spline_basis,
)
from rotor.optimisation.concept import Concept as Concept
from rotor.optimisation.concept import Handle as Handle
from rotor.optimisation.concept import Parameter as Parameter
from rotor.optimisation.concept import Values as Values
from rotor.optimisation.concept import nearest as nearest
from rotor.optimisation.concept import on_top as on_top
from rotor.optimisation.concept import restrict as restrict
from rotor.support.arrays import Array
from rotor.support.user_input import did_you_mean

STEEPEST, FLATTEST = math.radians(-30.0), math.radians(10.0)
"""Default bounds of a twist rate [rad/R]: beyond them blades stall at the root or carry negative lift at the tip."""


@dataclass(frozen=True)
class OneRate:
    """One rate from root to tip."""

    parameters = (Parameter("rate", "Rate", "rad/R", STEEPEST, FLATTEST),)
    handles = (Handle("rate", "tilt", 0.0, 1.0),)
    rate_rows = ((1.0,),)

    def twist(self, values: Values) -> TwistLaw:
        return LinearTwist(float(values[0]))

    def slopes(self, values: Values, r: Array) -> Array:
        del values
        return (r - REFERENCE_RADIUS)[None]


@dataclass(frozen=True)
class Parabola:
    """A parabola: its second-order coefficient a and the difference from root to tip."""

    parameters = (
        Parameter("curvature", "Curvature a", "rad/R²", math.radians(-40.0), math.radians(40.0)),
        Parameter("difference", "Root to tip", "rad", STEEPEST, FLATTEST),
    )
    handles = (Handle("curvature", "bend", 0.0, 1.0), Handle("difference", "tilt", 0.0, 1.0))
    rate_rows = ((-1.0, 1.0), (1.0, 1.0))
    """θ' = 2 a r + (D − a) at the centre and at the tip; linear between."""

    def twist(self, values: Values) -> TwistLaw:
        return QuadraticTwist(float(values[0]), float(values[1]))

    def slopes(self, values: Values, r: Array) -> Array:
        del values
        line = r - REFERENCE_RADIUS
        return np.stack([r**2 - REFERENCE_RADIUS**2 - line, line])


_LOOSE_STEEPEST, _LOOSE_FLATTEST = math.radians(-40.0), math.radians(30.0)


@dataclass(frozen=True)
class FreeForm:
    """A cubic spline through seven angles, that at 0.75 R being zero: the envelope of the others.

    It rounds off kinks, so a law of straight segments may be slightly better.
    """

    knots: tuple[float, ...] = (0.13, 0.30, 0.46, 0.61, REFERENCE_RADIUS, 0.88, 1.0)
    """r/R; one is at 0.75, where every law is zero."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return tuple(
            Parameter(
                f"twist_{round(100 * knot):03d}",
                f"Twist at {knot:.2f} R",
                "rad",
                *sorted((_LOOSE_STEEPEST * (knot - REFERENCE_RADIUS), _LOOSE_FLATTEST * (knot - REFERENCE_RADIUS))),
            )
            for knot in self.knots
            if knot != REFERENCE_RADIUS
        )

    @property
    def handles(self) -> tuple[Handle, ...]:
        steps = (0.0, *np.diff(self.knots).tolist(), 0.0)
        return tuple(
            Handle(parameter.name, "lift", self.knots[k], max(steps[k : k + 2]))
            for parameter, k in zip(self.parameters, self._free, strict=True)
        )

    @property
    def rate_rows(self) -> tuple[tuple[float, ...], ...]:
        between = [0.5 * (a + b) for a, b in zip(self.knots, self.knots[1:], strict=False)]
        stations = sorted((*self.knots, *between))
        rates = spline_basis(self.knots, stations, derivative=1)[:, self._free]
        return tuple(tuple(row) for row in rates.tolist())

    def twist(self, values: Values) -> TwistLaw:
        angles = [0.0] * len(self.knots)
        for k, value in zip(self._free, values, strict=True):
            angles[k] = float(value)
        return SplineTwist(self.knots, tuple(angles))

    def slopes(self, values: Values, r: Array) -> Array:
        del values
        return (spline_basis(self.knots, r) - spline_basis(self.knots, REFERENCE_RADIUS))[:, self._free].T

    @property
    def _free(self) -> list[int]:
        return [k for k, knot in enumerate(self.knots) if knot != REFERENCE_RADIUS]


@dataclass(frozen=True)
class Segments:
    """Straight segments, continuous at their breaks. Values: the rates root to tip, then the breaks."""

    segments: tuple[tuple[str, str], ...]
    """Name and title of each segment, root to tip."""
    breaks: tuple[tuple[str, str, float, float], ...]
    """Name, title, low and high of each break, r/R."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        rates = (
            Parameter(f"{name}_rate", f"{title} rate", "rad/R", STEEPEST, FLATTEST) for name, title in self.segments
        )
        return (*rates, *(Parameter(name, title, "R", low, high) for name, title, low, high in self.breaks))

    @property
    def handles(self) -> tuple[Handle, ...]:
        middles = [0.5 * (low + high) for _, _, low, high in self.breaks]
        ends = (0.0, *middles, 1.0)
        tilts = (Handle(f"{name}_rate", "tilt", ends[k], ends[k + 1]) for k, (name, _) in enumerate(self.segments))
        return (*tilts, *(Handle(name, "slide", low, high) for name, _, low, high in self.breaks))

    @property
    def rate_rows(self) -> tuple[tuple[float, ...], ...]:
        n = len(self.parameters)
        return tuple(tuple(float(k == i) for k in range(n)) for i in range(len(self.segments)))

    def twist(self, values: Values) -> TwistLaw:
        n = len(self.segments)
        return PiecewiseLinearTwist(tuple(float(v) for v in values[:n]), tuple(float(v) for v in values[n:]))

    def slopes(self, values: Values, r: Array) -> Array:
        """By a rate: the length of its segment between 0.75 R and r; by a break: the jump of rate there, for r beyond.

        On the break itself the slope is that from inboard.
        """
        n = len(self.segments)
        rates, breaks = values[:n], values[n:]
        ends = (0.0, *breaks, 1.0)
        out = np.empty((len(values), len(r)))
        for k in range(n):
            out[k] = np.clip(r, ends[k], ends[k + 1]) - min(max(REFERENCE_RADIUS, ends[k]), ends[k + 1])
        for k, place in enumerate(breaks):
            out[n + k] = (rates[k] - rates[k + 1]) * ((r > place) - float(place < REFERENCE_RADIUS))
        return out


DIVISION = 0.5
AIRFOIL_BREAKS = (0.4814, 0.8385)
"""Middles of the UH-60A's blends from SC1095 to SC1094 R8 and back, r/R (assets/uh60a.toml)."""

_TWO = (("inboard", "Inboard"), ("outboard", "Outboard"))
_THREE = (("inboard", "Inboard"), ("middle", "Middle"), ("outboard", "Outboard"))
_DIVISION = ("division", "Division", 0.25, 0.92)

TWO_SEGMENT_FREE = Concept(
    "two-segment-free", "Two segments, free break", "Two straight segments with a free break point.",
    Segments(_TWO, (_DIVISION,)),
)  # fmt: skip
TWO_AIRFOILS = Concept(
    "two-segment-two-airfoils",
    "Two segments, two airfoils",
    # The document's own order is not in what we hold. The tip needs the later drag rise of the SC1095; the inboard
    # blade, slow on the retreating side, the greater lift of the SC1094 R8. Swapped, the best blade takes
    # 4 kW more in hover, 29 kW at µ 0.2 (division 0.5, lifting line, 8322 kg).
    "SC1094 R8 inboard for lift at low speed, SC1095 outboard for its later drag rise; they change at the division.",
    Segments(_TWO, (_DIVISION,)),
    airfoils=("sc1094r8", "sc1095"),
)
THREE_SEGMENT_FREE = Concept(
    "three-segment-free", "Three segments, free breaks", "Three straight segments with free breaks.",
    Segments(_THREE, (("inner_break", "Inboard break", 0.2, 0.64), ("outer_break", "Outboard break", 0.66, 0.95))),
)  # fmt: skip


def _two_segment(division: float) -> Concept:
    return restrict(
        TWO_SEGMENT_FREE,
        {"division": division},
        name="two-segment",
        title="Two segments",
        explanation=f"Two straight segments that meet at {division:g} R.",
    )


def _three_segment(inner: float, outer: float) -> Concept:
    if not 0.15 <= inner < outer <= 0.97:
        raise ValueError(f"divisions {inner:g}, {outer:g} must ascend between 0.15 and 0.97 R: reorder or move them")
    anywhere = (("inner_break", "Inboard break", 0.15, 0.97), ("outer_break", "Outboard break", 0.15, 0.97))
    return restrict(
        replace(THREE_SEGMENT_FREE, family=Segments(_THREE, anywhere)),
        {"inner_break": inner, "outer_break": outer},
        name="three-segment",
        title="Three segments",
        explanation=f"Three straight segments that meet at {inner:.3g} and {outer:.3g} R, where the airfoils change.",
    )


CONCEPTS: dict[str, Concept] = {
    concept.name: concept
    for concept in (
        Concept("linear", "Linear", "One rate from root to tip.", OneRate()),
        Concept("quadratic", "Quadratic", "A parabola: its curvature, and the twist from root to tip.", Parabola()),
        _two_segment(DIVISION),
        TWO_SEGMENT_FREE,
        restrict(TWO_AIRFOILS, {"division": DIVISION}),
        _three_segment(*AIRFOIL_BREAKS),
        THREE_SEGMENT_FREE,
        Concept(
            "free-form", "Free form", "A smooth curve through seven points, the bound for any smooth shape.", FreeForm()
        ),
    )
}
"""Concepts by name, the simplest first; a search of a concept may start from those before it."""


def find_concept(name: str, division: Sequence[float] | None = None) -> Concept:
    """The concept of that name, its breaks fixed at `division` (r/R) if given.

    Raises ValueError with one sentence that names the value and the remedy.
    """
    if not isinstance(name, str):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
        raise TypeError(f'concept is {name!r:.40}, not a text: write for example "linear"')
    if name not in CONCEPTS:
        hint = did_you_mean(name, CONCEPTS) or ":"
        raise ValueError(f"concept {name!r} is not known{hint} use one of {', '.join(CONCEPTS)}")
    if division is None:
        return CONCEPTS[name]
    match name, *division:
        case "two-segment", place:
            return _two_segment(place)
        case "two-segment-two-airfoils", place:
            return restrict(TWO_AIRFOILS, {"division": place})
        case "three-segment", inner, outer:
            return _three_segment(inner, outer)
        case _:
            given = "1 division" if len(division) == 1 else f"{len(division)} divisions"
    raise ValueError(
        f"concept {name} cannot take {given}: give one for two-segment and "
        "two-segment-two-airfoils, two for three-segment, none for the others"
    )
