"""The twist concepts by name: blades with a few named degrees of freedom (thesis chapter 4).

One smooth curve (thesis §4.1.1, §4.1.2, free form) and straight segments (§4.1.3–4.1.5). Those with
a name in `Concept.page` are laws on the sliders of the page too.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rotor.design.twist import (
    REFERENCE_RADIUS,
    SEARCHED_STATIONS,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    spline_basis,
)
from rotor.optimisation.concept import Concept, Handle, Parameter, Values, nearest, on_top, restrict
from rotor.support.user_input import check_known

__all__ = (
    "CONCEPTS",
    "Concept",
    "Handle",
    "Parameter",
    "Values",
    "find_concept",
    "nearest",
    "on_top",
    "restrict",
)
STEEPEST, FLATTEST = math.radians(-30.0), math.radians(10.0)
"""Default bounds of a twist rate [rad/R]: beyond them blades stall at the root or carry negative lift at the tip."""


_RATE = "Twist rate in degrees per radius; negative turns the outboard end nose-down. | section 4"
_BREAK = "Break point: radius where two twist segments meet, as a fraction of R. | section 4"


def _rate(word: str, tilt: Handle, rates: tuple[float, ...], start: float, name: str) -> Parameter:
    title = word.capitalize()
    return Parameter(
        f"{word}_rate",
        f"{title} rate",
        "rad/R",
        STEEPEST,
        FLATTEST,
        tilt,
        rates,
        start,
        _RATE,
        title,
        name,
    )


def _break(
    name: str, title: str, ends: tuple[float, float], pieces: int, start: float, short: str
) -> Parameter:
    return Parameter(
        name, title, "R", *ends, Handle("slide", *ends), (0.0,) * pieces, start, _BREAK, short
    )


def _free_form() -> Iterator[Parameter]:
    """Angles at stations. The spline rounds off kinks, so a law of straight segments may be slightly better."""
    steps = (0.0, *np.diff(SEARCHED_STATIONS).tolist(), 0.0)
    between = (0.5 * (inner + outer) for inner, outer in pairwise(SEARCHED_STATIONS))
    rates = spline_basis(
        SEARCHED_STATIONS, sorted((*SEARCHED_STATIONS, *between)), derivative=1
    ).T.tolist()
    for k, at in enumerate(SEARCHED_STATIONS):
        low, high = sorted(math.radians(rate) * (at - REFERENCE_RADIUS) for rate in (-40.0, 30.0))
        handle = Handle("lift", at, max(steps[k : k + 2]))
        yield Parameter(
            _angle_at(at), f"Twist at {at:.2f} R", "rad", low, high, handle, tuple(rates[k])
        )


def _angle_at(station: float) -> str:
    return f"twist_{round(100 * station):03d}"


DIVISION = 0.5
AIRFOIL_BREAKS = (0.4814, 0.8385)
"""Middles of the UH-60A's blends from SC1095 to SC1094 R8 and back, r/R (assets/uh60a.toml)."""

TWO_SEGMENT_FREE = Concept(
    "two-segment-free", "Two segments, free break point", "Two straight segments with a free break point.",
    PiecewiseLinearTwist,
    (
        _rate("inboard", Handle("tilt", 0.0, 0.585), (1.0, 0.0), -14.0, "two_inner"),
        _rate("outboard", Handle("tilt", 0.585, 1.0), (0.0, 1.0), -8.0, "two_outer"),
        _break("division", "Break point", (0.25, 0.92), 2, 0.5, "Break point"),
    ),
    "two",
)  # fmt: skip
TWO_AIRFOILS = Concept(
    "two-segment-two-airfoils",
    "Two segments, two airfoils",
    # The document's own order is in a chapter that we do not have. The tip needs the later drag rise of the SC1095;
    # inboard, slow on the retreating side, the blade needs the greater lift of the SC1094 R8. Swapped, the best blade
    # takes 4 kW more in hover, 29 kW at µ 0.2 (division 0.5, lifting line, 8322 kg).
    "SC1094 R8 inboard for lift at low speed, SC1095 outboard for its later drag rise; they change at the break point.",
    PiecewiseLinearTwist,
    TWO_SEGMENT_FREE.every,
    airfoils=("sc1094r8", "sc1095"),
)
THREE_SEGMENT_FREE = Concept(
    "three-segment-free", "Three segments, free break points", "Three straight segments with free break points.",
    PiecewiseLinearTwist,
    (
        _rate("inboard", Handle("tilt", 0.0, 0.42), (1.0, 0.0, 0.0), -16.0, "three_inner"),
        _rate("middle", Handle("tilt", 0.42, 0.805), (0.0, 1.0, 0.0), -12.0, "three_middle"),
        _rate("outboard", Handle("tilt", 0.805, 1.0), (0.0, 0.0, 1.0), -6.0, "three_outer"),
        _break("inner_break", "Inboard break point", (0.2, 0.64), 3, 0.4, "Break 1"),
        _break("outer_break", "Outboard break point", (0.66, 0.95), 3, 0.75, "Break 2"),
    ),
    "three",
)  # fmt: skip


def _two_segment(division: float) -> Concept:
    words = f"Two straight segments that meet at {division:g} R."
    free = replace(TWO_SEGMENT_FREE, name="two-segment", title="Two segments", explanation=words)
    return restrict(free, {"division": division})


def _three_segment(inner: float, outer: float) -> Concept:
    if not 0.15 <= inner < outer <= 0.97:
        raise ValueError(
            f"divisions {inner:g}, {outer:g} must ascend between 0.15 and 0.97 R: reorder or move them"
        )
    words = f"Three straight segments that meet at {inner:.3g} and {outer:.3g} R, where the airfoils change."
    anywhere = tuple(
        one if one.angular else replace(one, low=0.15, high=0.97)
        for one in THREE_SEGMENT_FREE.every
    )
    free = Concept("three-segment", "Three segments", words, PiecewiseLinearTwist, anywhere)
    return restrict(free, {"inner_break": inner, "outer_break": outer})


CONCEPTS: dict[str, Concept] = {
    concept.name: concept
    for concept in (
        Concept(
            "linear", "Linear", "One rate from root to tip.", LinearTwist,
            (
                Parameter(
                    "rate", "Rate", "rad/R", STEEPEST, FLATTEST, Handle("tilt"), (1.0,), -12.0, _RATE, input="linear"
                ),
            ),
            "linear",
        ),
        Concept(
            "quadratic", "Quadratic", "A parabola: its curvature, and the twist from root to tip.", QuadraticTwist,
            (  # θ' = 2 a r + (D − a), linear from the centre to the tip.
                Parameter(
                    "curvature", "Curvature a", "rad/R²", math.radians(-40.0), math.radians(40.0), Handle("bend"),
                    (-1.0, 1.0), 8.0, "Second-order coefficient of the twist; 0 gives linear twist. | section 4",
                    "Curvature",
                ),
                Parameter(
                    "difference", "Root to tip", "rad", STEEPEST, FLATTEST, Handle("tilt"), (1.0, 1.0), -14.0,
                    "Twist at the tip minus twist at the centre of rotation. | section 4", "Tip−root",
                ),
            ),
            "quadratic",
        ),
        _two_segment(DIVISION),
        TWO_SEGMENT_FREE,
        restrict(TWO_AIRFOILS, {"division": DIVISION}),
        _three_segment(*AIRFOIL_BREAKS),
        THREE_SEGMENT_FREE,
        Concept(
            "free-form", "Free form", "A smooth curve through seven points, the bound for any smooth shape.",
            SplineTwist, tuple(_free_form()), fixed=((_angle_at(REFERENCE_RADIUS), 0.0),),
        ),
    )
}  # fmt: skip
"""Concepts by name, the simplest first; a search of a concept may start from those before it."""


def find_concept(name: str, division: Sequence[float] | None = None) -> Concept:
    """The concept of that name, its breaks fixed at `division` (r/R) if given.

    Raises TypeError or ValueError with one sentence that names the value and the remedy.
    """
    if not isinstance(name, str):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
        raise TypeError(f'concept is {name!r:.40}, not a text: write for example "linear"')
    check_known("concept", name, CONCEPTS)
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
