"""The quantities that a study can set: names, units, and their section in the file."""

from dataclasses import dataclass
from typing import Literal

from rotor.aero.switches import SWITCHES
from rotor.design.stand import STAND_KEYS
from rotor.optimisation.concepts import CONCEPTS, Concept
from rotor.optimisation.concepts.catalogue import THREE_SEGMENT_FREE, TWO_AIRFOILS, TWO_SEGMENT_FREE
from rotor.user_input import did_you_mean

Value = float | str | bool
Kind = Literal["number", "text", "flag"]
QuantitySection = Literal["fixed", "models"]


@dataclass(frozen=True)
class Quantity:
    """One thing that a study can hold or vary."""

    name: str
    kind: Kind
    unit: str
    section: QuantitySection
    """The section of the study file that holds it; as an axis it is in [axes]."""
    whole: bool = False
    """Whether a number of it is a whole one."""


_PARAMETERS = [parameter for concept in CONCEPTS.values() for parameter in concept.parameters]
_LABELS = {parameter.label for parameter in _PARAMETERS}


_KIND: dict[str, tuple[Kind, str]] = {
    "flapping": ("text", ""),
    "thrust_n": ("number", "N"),
    "density_kg_m3": ("number", "kg/m³"),
    **{key: ("number", "°") for key in STAND_KEYS if key.endswith("_deg")},
}


def _all() -> dict[str, Quantity]:
    plain = [
        Quantity("rotor", "text", "", "fixed"),
        Quantity("mu", "number", "", "fixed"),
        Quantity("speed_kt", "number", "kt", "fixed"),
        Quantity("mass_kg", "number", "kg", "fixed"),
        Quantity("altitude_m", "number", "m", "fixed"),
        Quantity("climb_m_s", "number", "m/s", "fixed"),
        Quantity("twist", "text", "", "fixed"),
        Quantity("twist_per_rev", "text", "", "fixed"),
        Quantity("pitch_per_rev", "text", "", "fixed"),
        Quantity("airfoils", "text", "", "fixed"),
        Quantity("concept", "text", "", "fixed"),
        Quantity("hover_share", "number", "", "fixed"),
        *(Quantity(f"stand_{key}", *_KIND.get(key, ("number", "")), "fixed") for key in STAND_KEYS),
        Quantity("trim", "text", "", "models"),
        Quantity("preset", "text", "", "models"),
        Quantity("inflow", "text", "", "models"),
        *(Quantity(name, "flag", "", "models") for name in SWITCHES),
        Quantity("bending", "flag", "", "models"),
        Quantity("dynamic_stall", "flag", "", "models"),
        Quantity("elements", "number", "", "models", whole=True),
        Quantity("azimuths", "number", "", "models", whole=True),
    ]
    made = [Quantity(one.label, "number", one.shown_unit, "fixed") for one in _PARAMETERS]
    return {one.name: one for one in (*plain, *made)}


QUANTITIES: dict[str, Quantity] = _all()
"""By name; the parameters of all twist concepts are among them, angles in degrees with names that end in _deg."""

PLAIN = tuple(name for name in QUANTITIES if name not in _LABELS)
"""Quantities that do not belong to a concept."""

_WIDER: dict[str, Concept] = {
    "two-segment": TWO_SEGMENT_FREE,
    "two-segment-two-airfoils": TWO_AIRFOILS,
    "three-segment": THREE_SEGMENT_FREE,
}
"""Concepts with fixed breaks, and the same with breaks that a study can set."""


def concept_with_breaks(name: str, given: dict[str, float]) -> tuple[Concept, dict[str, float]]:
    """The concept whose parameters include those given by label, and their values by name in SI.

    Raises ValueError for a concept or a parameter that there is not.
    """
    if name not in CONCEPTS:
        hint = did_you_mean(name, CONCEPTS) or ":"
        raise ValueError(f"concept {name!r} is not known{hint} use one of {', '.join(CONCEPTS)}")
    concept = CONCEPTS[name]
    if name in _WIDER and any(label not in [one.label for one in concept.parameters] for label in given):
        concept = _WIDER[name]
    known = {one.label: one for one in concept.parameters}
    for label in given:
        if label not in known:
            raise ValueError(f"{label} is no parameter of the concept {name}: it has {', '.join(known)}")
    return concept, {known[label].name: known[label].from_shown(value) for label, value in given.items()}


def concept_labels(name: str, given: tuple[str, ...]) -> tuple[str, ...]:
    """Labels of a concept's parameters, with the breaks where a study sets those."""
    concept, _ = concept_with_breaks(name, dict.fromkeys(given, 0.0))
    return tuple(parameter.label for parameter in concept.parameters)
