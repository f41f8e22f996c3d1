"""The concepts by name."""

from collections.abc import Sequence
from dataclasses import replace

from rotor.optimisation.concepts.concept import Concept, restrict
from rotor.optimisation.concepts.families import FreeFormConcept, LinearConcept, QuadraticConcept, SegmentsConcept

DIVISIONS = (0.4, 0.5, 0.6, 0.7)
"""The divisions of the document's two-segment blades (thesis §4.1.3)."""
DIVISION = 0.5
AIRFOIL_BREAKS = (0.4814, 0.8385)
"""Middles of the UH-60A's blends from SC1095 to SC1094 R8 and back, r/R (assets/uh60a.toml)."""

_TWO = (("inboard", "Inboard"), ("outboard", "Outboard"))
_THREE = (("inboard", "Inboard"), ("middle", "Middle"), ("outboard", "Outboard"))
_DIVISION = ("division", "Division", 0.25, 0.92)

TWO_SEGMENT_FREE = SegmentsConcept(
    "two-segment-free", "Two segments, free division", "Two straight segments with a free division.", _TWO,
    (_DIVISION,),
)  # fmt: skip
TWO_AIRFOILS = SegmentsConcept(
    "two-segment-two-airfoils",
    "Two segments, two airfoils",
    # The document's own order is not in what we hold. The tip needs the later drag rise of the SC1095; the inboard
    # blade, slow on the retreating side, the greater lift of the SC1094 R8. Swapped, the best blade takes
    # 4 to 7 kW more from hover to µ 0.35 (division 0.5, dynamic wake, 8322 kg).
    "SC1094 R8 inboard for lift at low speed, SC1095 outboard for its later drag rise; they change at the division.",
    _TWO,
    (_DIVISION,),
    airfoils=("sc1094r8", "sc1095"),
)
THREE_SEGMENT_FREE = SegmentsConcept(
    "three-segment-free", "Three segments, free breaks", "Three straight segments with free breaks.", _THREE,
    (("inner_break", "Inboard break", 0.2, 0.64), ("outer_break", "Outboard break", 0.66, 0.95)),
)  # fmt: skip


def _two_segment(division: float) -> Concept:
    return restrict(
        TWO_SEGMENT_FREE,
        {"division": division},
        name="two-segment",
        title="Two segments",
        explanation=f"Two straight segments, divided at {division:g} R.",
    )


def _three_segment(inner: float, outer: float) -> Concept:
    if not 0.15 <= inner < outer <= 0.97:
        raise ValueError(f"divisions {inner:g}, {outer:g} must ascend between 0.15 and 0.97 R: reorder or move them")
    anywhere = replace(
        THREE_SEGMENT_FREE,
        breaks=(("inner_break", "Inboard break", 0.15, 0.97), ("outer_break", "Outboard break", 0.15, 0.97)),
    )
    return restrict(
        anywhere,
        {"inner_break": inner, "outer_break": outer},
        name="three-segment",
        title="Three segments",
        explanation=f"Three straight segments that meet at {inner:.3g} and {outer:.3g} R, where the airfoils change.",
    )


CONCEPTS: dict[str, Concept] = {
    concept.name: concept
    for concept in (
        LinearConcept(),
        QuadraticConcept(),
        _two_segment(DIVISION),
        TWO_SEGMENT_FREE,
        restrict(TWO_AIRFOILS, {"division": DIVISION}),
        _three_segment(*AIRFOIL_BREAKS),
        THREE_SEGMENT_FREE,
        FreeFormConcept(),
    )
}
"""Concepts by name, the simplest first; a search of a concept may start from those before it."""


def find_concept(name: str, division: Sequence[float] | None = None) -> Concept:
    """The concept of that name, its breaks held at `division` (r/R) where one is given.

    Raises ValueError with one sentence that names the value and the remedy.
    """
    if name not in CONCEPTS:
        raise ValueError(f"concept {name!r} is not known: use one of {', '.join(CONCEPTS)}")
    if division is None:
        return CONCEPTS[name]
    if name in ("two-segment", "two-segment-two-airfoils") and len(division) == 1:
        if name == "two-segment":
            return _two_segment(division[0])
        return restrict(TWO_AIRFOILS, {"division": division[0]})
    if name == "three-segment" and len(division) == 2:
        return _three_segment(division[0], division[1])
    given = "1 division" if len(division) == 1 else f"{len(division)} divisions"
    raise ValueError(
        f"concept {name} cannot take {given}: give one with two-segment and "
        "two-segment-two-airfoils, two with three-segment, none with the others"
    )
