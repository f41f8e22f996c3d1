"""Concepts made of others: with parameters held, or as a change on top of a law that stays."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import SumTwist, TwistLaw
from rotor.optimisation.concepts.concept import Concept, Handle, Parameter, Values


@dataclass(frozen=True)
class Restricted:
    """A concept with some parameters held."""

    base: Concept
    fixed: tuple[tuple[str, float], ...]
    name: str
    title: str
    explanation: str

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        held = dict(self.fixed)
        return tuple(parameter for parameter in self.base.parameters if parameter.name not in held)

    @property
    def handles(self) -> tuple[Handle, ...]:
        held = dict(self.fixed)
        return tuple(handle for handle in self.base.handles if handle.parameter not in held)

    @property
    def rate_rows(self) -> tuple[tuple[float, ...], ...]:
        return tuple(tuple(row[k] for k in self._free) for row in self.base.rate_rows)

    def twist(self, values: Values) -> TwistLaw:
        return self.base.twist(self._full(values))

    def slopes(self, values: Values, r: Array) -> Array:
        return self.base.slopes(self._full(values), r)[list(self._free)]

    def apply(self, design: Design, values: Values) -> Design:
        return self.base.apply(design, self._full(values))

    @property
    def _free(self) -> tuple[int, ...]:
        held = dict(self.fixed)
        return tuple(k for k, parameter in enumerate(self.base.parameters) if parameter.name not in held)

    def _full(self, values: Values) -> list[float]:
        held, free = dict(self.fixed), iter(values)
        return [held[p.name] if p.name in held else float(next(free)) for p in self.base.parameters]


@dataclass(frozen=True)
class OnTop:
    """A concept for the change that is added to a law that stays: what an actuator does to the blade as built."""

    base: Concept
    law: TwistLaw

    @property
    def name(self) -> str:
        return self.base.name

    @property
    def title(self) -> str:
        return f"{self.base.title}, on top"

    @property
    def explanation(self) -> str:
        return f"Added to the twist of the blade as it is. {self.base.explanation}"

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return self.base.parameters

    @property
    def handles(self) -> tuple[Handle, ...]:
        return self.base.handles

    @property
    def rate_rows(self) -> tuple[tuple[float, ...], ...]:
        """Rates of the change."""
        return self.base.rate_rows

    def twist(self, values: Values) -> TwistLaw:
        return SumTwist(self.law, self.base.twist(values))

    def slopes(self, values: Values, r: Array) -> Array:
        return self.base.slopes(values, r)

    def apply(self, design: Design, values: Values) -> Design:
        return replace(self.base.apply(design, values), twist=self.twist(values))


def on_top(concept: Concept, law: TwistLaw) -> Concept:
    """The concept as a change of a law that stays."""
    return OnTop(concept, law)


def restrict(
    concept: Concept,
    fixed: Mapping[str, float],
    *,
    name: str | None = None,
    title: str | None = None,
    explanation: str | None = None,
) -> Concept:
    """The concept with some parameters held at values (SI); ValueError for a name or a value it cannot take."""
    known = {parameter.name: parameter for parameter in concept.parameters}
    name = name or concept.name
    for key, value in fixed.items():
        if key not in known:
            raise ValueError(f"concept {name} has no parameter {key!r}: it has {', '.join(known)}")
        low, high = known[key].low, known[key].high
        if not low <= value <= high:
            shown = known[key].shown
            raise ValueError(
                f"{key} {shown(value):g} of concept {name} is outside {shown(low):g}…{shown(high):g}: "
                "choose a value inside"
            )
    if len(fixed) >= len(known):
        raise ValueError(f"concept {name} has nothing left to vary: leave at least one parameter free")
    return Restricted(
        concept,
        tuple(fixed.items()),
        name,
        title or concept.title,
        explanation or concept.explanation,
    )
