"""The lecture: steps that set the page and state what is seen in numbers; flights to begin from.

What to watch and what to try at a step is in its file in the folder `text`.
"""

import re
from dataclasses import dataclass, replace
from pathlib import Path

from explorer.model.inputs import INPUT_NAMES, LAWS, Inputs, ViewState, preset_inflow
from explorer.model.session_state import SessionState
from explorer.model.units import UNITS, number
from explorer.text.readout import PART_TITLES

FLIGHTS = {"Hover": 0.0, "0.15": 0.15, "0.24": 0.24, "0.37": 0.37}
"""Advance ratios: hover, minimum power, cruise, high speed."""

_THESIS = Inputs(preset="thesis", law="linear", linear=-16.0, advance_ratio=0.0, **preset_inflow("thesis"))
_STATED = {"hover optimum, −13.5°": (0.0, -13.5), "hover, −16°": (0.0, -16.0), "from µ 0.18, −8°": (0.18, -8.0)}
"""What the source document states (chapter 3): advance ratio, linear twist [°]. It does not say of what length."""
_SPAN = 1.0 - _THESIS.design().rotor.blade.root_cutout
DOCUMENT: dict[str, Inputs] = {
    f"Document: {title} {unit}": replace(_THESIS, advance_ratio=mu, linear=round(twist / length, 1))
    for unit, length in (("root to tip", _SPAN), ("per radius", 1.0))
    for title, (mu, twist) in _STATED.items()
}
"""In both readings of its twist, in its preset; first the one that gives more of its statements."""
EXAMPLES: dict[str, Inputs] = {
    "Example: low speed, µ 0.10, −12°": replace(_THESIS, linear=-12.0, advance_ratio=0.1),
    "Example: high speed, µ 0.35, −4°": replace(_THESIS, linear=-4.0, advance_ratio=0.35),
}
"""Our own cases in the preset of the document, which prints no advance ratio for low and high speed."""
CASES = {**DOCUMENT, **EXAMPLES}
"""The menu."""


_TEXT = Path(__file__).parent / "text"


def step_text(name: str) -> tuple[str, str, str]:
    """Title, what to watch, and what to try at a step: from its Markdown file.

    ValueError for a file that is not laid out as `# title`, a text, `## Try` and a text.
    """
    text = (_TEXT / f"{name}.md").read_text(encoding="utf-8")
    parts = re.fullmatch(r"# ([^\n]+)\n\n([^#]+)\n\n## Try\n\n([^#]+)\n", text)
    if parts is None:
        raise ValueError(f"{name}.md is no step of the lecture: write '# title', a text, '## Try' and a text")
    title, watch, do = (" ".join(part.split()) for part in parts.groups())
    return title, watch, do


@dataclass(frozen=True)
class LectureStep:
    """One stop of the lecture."""

    title: str
    watch: str
    """What to look at, and why it is so."""
    do: str
    """What to try."""
    inputs: Inputs
    sentence: str
    """What is seen, with names of `quantities` in braces; it holds wherever the sliders are moved."""
    numbers: tuple[tuple[str, str], tuple[str, str], tuple[str, str]]
    """Three large numbers beside the caption: name of the quantity, caption."""
    against: Inputs | None = None
    """A of A/B."""
    field: str = "Induced inflow λi"
    difference: bool = False
    """Whether the disk shows B − A."""
    mode: str = "explore"
    """Mode of the page in which the step is seen."""

    def say(self, state: SessionState) -> str:
        """The sentence in the present numbers."""
        return self.sentence.format_map(quantities(state))

    def figures(self, state: SessionState) -> list[tuple[str, str, str]]:
        """Caption and value of each large number, as the frame draws them."""
        values = quantities(state)
        return [(caption, values[name], "") for name, caption in self.numbers]


def view_of(step: LectureStep, view: ViewState) -> ViewState:
    """What is shown at a step."""
    return replace(view, field=step.field, difference=step.difference, reverse_flow=True, stall=True)


def beside(step: LectureStep, inputs: Inputs) -> Inputs | None:
    """A of a step for the inputs on the sliders: the step's own blade and differences, all else as in B.

    So A and B differ only by the subject of the step, also after the user has chosen another inflow.
    """
    if step.against is None:
        return None
    own = {name for name in INPUT_NAMES if getattr(step.against, name) != getattr(step.inputs, name)}
    return replace(inputs, **{name: getattr(step.against, name) for name in own | _TWIST})


_TWIST = {"law"}.union(*(law.inputs for law in LAWS.values()))


def quantities(state: SessionState) -> dict[str, str]:
    """Numbers with their units, each on one line: of A (the reference), of B (the design), and of B − A."""
    a, b, units = state.reference.power, state.solution.power, UNITS[state.view.units]

    def power(watts: float, sign: bool = False) -> str:
        return _on_one_line(units.watts(watts, sign=sign))

    def percent(share: float, digits: int = 0, sign: bool = False) -> str:
        return f"{number(100.0 * share, digits, sign=sign)}\u00a0%"

    shares = {name: percent(getattr(b, name) / b.total) for name in PART_TITLES}
    tonnes = units.mass.size > 1.0
    return {
        **{f"{name}_share": share for name, share in shares.items()},
        "shares": ", ".join(f"{title.lower()} {shares[name]}" for name, title in PART_TITLES.items()),
        **{
            f"{name}_{which}": power(getattr(one, name))
            for name in ("total", "induced")
            for which, one in (("a", a), ("b", b))
        },
        **{
            f"{name}_change": power(getattr(b, name) - getattr(a, name), sign=True)
            for name in ("total", "induced", "profile")
        },
        "induced_percent": percent(b.induced / a.induced - 1.0, 1, sign=True),
        "total_percent": percent(b.total / a.total - 1.0, 2, sign=True),
        "saving": power(a.total - b.total),
        "saving_percent": percent(1.0 - b.total / a.total, 2),
        "cost": power(b.total - a.total),
        "reverse_area": percent(state.solution.reverse_flow_area, 1),
        "one_percent": power(0.01 * b.total),
        "mass": _on_one_line(units.mass.text(state.solution.design.condition.mass, 1 if tonnes else 0)),
    }


def _on_one_line(text: str) -> str:
    return text.replace(" ", "\u00a0").replace("\u2009", "\u00a0")


_LINEAR = Inputs(law="linear")
_UH60A = Inputs(law="builtin")
_BOTH = "From A to B: induced {induced_change}, profile {profile_change}."
_CHANGES = (
    ("induced_change", "induced power, B − A"),
    ("profile_change", "profile power, B − A"),
    ("total_change", "total power, B − A"),
)

STEPS: tuple[LectureStep, ...] = (
    LectureStep(
        *step_text("trim"),
        _UH60A,
        "Now {total_b}: {shares}.",
        (("total_b", "total power"), ("induced_share", "induced share"), ("parasite_share", "parasite share")),
    ),
    LectureStep(
        *step_text("hover_twist"),
        replace(_LINEAR, linear=-16.0, advance_ratio=0.0),
        "Induced power: A {induced_a}, B {induced_b}; {induced_change} ({induced_percent}).",
        (
            ("induced_a", "induced power, A"),
            ("induced_b", "induced power, B"),
            ("induced_percent", "change from A to B"),
        ),
        against=replace(_LINEAR, linear=0.0, advance_ratio=0.0),
        difference=True,
    ),
    LectureStep(
        *step_text("linear_inflow"),
        replace(_LINEAR, linear=-12.0, inflow="pitt-peters"),
        _BOTH,
        _CHANGES,
        against=replace(_LINEAR, linear=0.0, inflow="pitt-peters"),
        difference=True,
    ),
    LectureStep(
        *step_text("responding_wake"),
        replace(_LINEAR, linear=-12.0),
        _BOTH,
        _CHANGES,
        against=replace(_LINEAR, linear=0.0),
        difference=True,
    ),
    LectureStep(
        *step_text("fast_twist"),
        replace(_LINEAR, linear=-11.6, advance_ratio=0.35),
        "B needs {saving} less than A: {saving_percent} of {total_a}.",
        (("total_a", "total power, A"), ("total_b", "total power, B"), ("total_percent", "change from A to B")),
        against=replace(_LINEAR, linear=-4.0, advance_ratio=0.35),
        field="Thrust dT/dr",
    ),
    LectureStep(
        *step_text("reverse_flow"),
        replace(_UH60A, advance_ratio=0.37),
        "{reverse_area} of the disk is in reverse flow; it costs {cost} in total.",
        (
            ("reverse_area", "of the disk in reverse flow"),
            ("profile_change", "profile power it costs"),
            ("total_change", "total power it costs"),
        ),
        against=replace(_UH60A, advance_ratio=0.37, reverse_flow=False),
        field="Power dP/dr",
    ),
    LectureStep(
        *step_text("two_segments"),
        replace(Inputs(), law="two", two_inner=-4.0, two_outer=-15.6, two_division=0.7, advance_ratio=0.3),
        "B needs {saving} less than A: {saving_percent} of {total_a}.",
        (("total_a", "total power, A"), ("total_b", "total power, B"), ("total_percent", "change from A to B")),
        against=replace(_LINEAR, linear=-10.6, advance_ratio=0.3),
        field="Thrust dT/dr",
    ),
    LectureStep(
        *step_text("piezoelectric_ply"),
        replace(_UH60A, advance_ratio=0.3),
        "This blade needs {total_b} here; the verdict gives the net benefit of changing its twist in flight.",
        (("total_b", "total power"), ("one_percent", "one per cent of that"), ("mass", "gross mass")),
        mode="actuate",
    ),
)
