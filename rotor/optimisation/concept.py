"""What a twist concept is: named parameters, the law they make, and its derivatives."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import scipy

from rotor.design.blade import with_airfoils
from rotor.design.design import Design
from rotor.design.twist import SpecTwist, SumTwist, TwistLaw
from rotor.support.arrays import Array

Values = Sequence[float] | Array
"""Parameters of a concept in its order, SI."""
Unit = Literal["rad/R", "rad/R²", "rad/R³", "rad", "R"]
Motion = Literal["tilt", "bend", "slide", "lift"]


@dataclass(frozen=True)
class Handle:
    """The part of the blade that a parameter moves."""

    motion: Motion
    """tilt: the line from `inner` to `outer` turns; bend: it curves; slide: a break moves along the blade between them;
    lift: a point at `inner` moves up and down, and drags the curve out to `outer` on either side."""
    inner: float = 0.0
    """r/R"""
    outer: float = 1.0
    """r/R"""


@dataclass(frozen=True)
class Parameter:
    """One degree of freedom, in SI inside."""

    name: str
    """Short and stable, for scripts."""
    title: str
    """Title on the page."""
    unit: Unit
    low: float
    high: float
    """Default bounds."""
    handle: Handle
    rates: tuple[float, ...]
    """What one unit adds to the twist rate [rad/R] of each segment, or at stations where a smooth law is steepest."""
    start: float = 0.0
    """Where its slider on the page begins, in the shown unit."""
    help: str = ""
    """Hint of the slider: one sentence, and after a bar the equation or the section of docs/theory.md."""
    short: str = ""
    """Label of the slider, where it is shorter than the title."""
    input: str = ""
    """Name of the page's input, where it is not made of the names of law and parameter."""

    @property
    def angular(self) -> bool:
        """Whether it is shown in degrees."""
        return self.unit != "R"

    @property
    def label(self) -> str:
        """Name in files and output, with _deg for angles."""
        return f"{self.name}_deg" if self.angular else self.name

    @property
    def shown_unit(self) -> str:
        """Unit in files and output."""
        return self.unit.replace("rad", "°")

    def shown(self, value: float) -> float:
        """The value in shown units: degrees for angles."""
        return math.degrees(value) if self.angular else value

    def from_shown(self, value: float) -> float:
        """The value [rad or r/R] of a shown number: the inverse of `shown`."""
        return math.radians(value) if self.angular else value


@dataclass(frozen=True)
class Concept:
    """Twist laws with a few parameters, some of which may be fixed; the law may be added to another."""

    name: str
    """On the command line."""
    title: str
    """On the page."""
    explanation: str
    """One line for the page."""
    law: type[SpecTwist]
    every: tuple[Parameter, ...]
    """In the order of `SpecTwist.of`, fixed ones too."""
    page: str = ""
    """Name of the law on the sliders of the page; empty: it is searched only."""
    airfoils: tuple[str, ...] = ()
    """A section for each straight segment; empty: the design's own."""
    fixed: tuple[tuple[str, float], ...] = ()
    """Name and value of each fixed parameter."""
    base: TwistLaw | None = None
    """What the law is added to, for example the blade as built under an actuator."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters, in the order of every vector of values."""
        return tuple(self.every[k] for k in self._free)

    @property
    def handles(self) -> tuple[Handle, ...]:
        """The part of the blade that each free parameter moves."""
        return tuple(parameter.handle for parameter in self.parameters)

    @property
    def rate_rows(self) -> tuple[tuple[float, ...], ...]:
        """Twist rates [rad/R] are linear in the values: one row per segment (or station of a smooth law). Of an added
        law the rates of the change."""
        return tuple(zip(*(parameter.rates for parameter in self.parameters), strict=True))

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the page's inputs, by parameter."""
        return tuple(
            parameter.input or f"{self.page}_{parameter.name}" for parameter in self.parameters
        )

    @property
    def breaks(self) -> tuple[str, ...]:
        """Names of the page's inputs that are break points r/R."""
        return tuple(
            name for name, one in zip(self.inputs, self.parameters, strict=True) if not one.angular
        )

    def twist(self, values: Values) -> TwistLaw:
        """The twist law with these values of the free parameters."""
        law = self.law.of(*self._all(values))
        return law if self.base is None else SumTwist(self.base, law)

    def slopes(self, values: Values, r: Array) -> Array:
        """∂θ_tw(r)/∂value, exact, (free parameters, stations)."""
        return self.law.of(*self._all(values)).slopes(r)[self._free]

    def values_of(self, law: TwistLaw) -> tuple[float, ...] | None:
        """All parameter values of a law of this concept's kind, fixed ones too; None for any other law."""
        values = law.values if isinstance(law, SpecTwist) and type(law) is self.law else ()
        return values if len(values) == len(self.every) else None

    def apply(self, design: Design, values: Values) -> Design:
        """The design with the twist law of these values and with the airfoils of the concept."""
        rotor = design.rotor
        if self.airfoils:
            places = tuple(self._all(values)[len(self.airfoils) :])
            # SC1095 from the data that the design uses: the document's polynomials or the decks.
            sections = {span.section.partition("-")[0]: span.section for span in rotor.blade.spans}
            rotor = with_airfoils(
                rotor, [sections.get(name, name) for name in self.airfoils], places
            )
        return replace(design, twist=self.twist(values), rotor=rotor)

    @property
    def _free(self) -> list[int]:
        held = dict(self.fixed)
        return [k for k, parameter in enumerate(self.every) if parameter.name not in held]

    def _all(self, values: Values) -> list[float]:
        """Values of every parameter."""
        held, free = dict(self.fixed), iter(values)
        return [held[p.name] if p.name in held else float(next(free)) for p in self.every]


def nearest(concept: Concept, law: TwistLaw) -> tuple[float, ...]:
    """The values within bounds whose law is nearest to another one, in the mean square along the blade.

    Uniform pitch does not count: it is absorbed by collective.
    """
    r = np.linspace(0.13, 1.0, 60)
    wanted = law(r) - law(r).mean()
    low, high = np.array([(parameter.low, parameter.high) for parameter in concept.parameters]).T
    span = high - low

    def gap(x: Array) -> Array:
        angles = concept.twist((low + span * x).tolist())(r)
        return angles - angles.mean() - wanted

    def slope(x: Array) -> Array:
        by = concept.slopes((low + span * x).tolist(), r)
        return ((by - by.mean(axis=1, keepdims=True)) * span[:, None]).T

    middle = np.full(len(span), 0.5)
    step = np.linalg.lstsq(slope(middle), -gap(middle))[0]
    inside = np.asarray(middle + np.clip(step, -0.5, 0.5), dtype=np.float64)
    # A law that is linear in its values, within the bounds.
    if np.abs(slope(inside).T @ gap(inside)).max() < 1e-12:
        return tuple((low + span * inside).tolist())
    fit = scipy.optimize.least_squares(gap, middle, jac=slope, bounds=(0.0, 1.0), xtol=1e-12)
    return tuple((low + span * np.clip(fit.x, 0.0, 1.0)).tolist())


def on_top(concept: Concept, law: TwistLaw) -> Concept:
    """The concept added to a fixed law."""
    explanation = f"Added to the twist of the starting design. {concept.explanation}"
    return replace(concept, title=f"{concept.title}, on top", explanation=explanation, base=law)


def restrict(concept: Concept, fixed: Mapping[str, float]) -> Concept:
    """The concept with some parameters fixed (SI); ValueError for an unknown name or a value out of bounds."""
    known, name = {parameter.name: parameter for parameter in concept.parameters}, concept.name
    for key, value in fixed.items():
        if key not in known:
            raise ValueError(f"concept {name} has no parameter {key!r}: it has {', '.join(known)}")
        low, high = known[key].low, known[key].high
        if not low <= value <= high:
            value, low, high = map(known[key].shown, (value, low, high))
            raise ValueError(
                f"{key} {value:g} of concept {name} is outside {low:g}…{high:g}: choose a value inside"
            )
    if len(fixed) >= len(known):
        raise ValueError(f"concept {name} has no free parameter left: leave at least one free")
    return replace(concept, fixed=(*concept.fixed, *fixed.items()), page="")
