"""The lecture: steps that set the page and state what is seen in numbers; flights to begin from.

What to watch and what to try at a step is in its file in the folder `text`.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from explorer.model.inputs import INPUT_NAMES, LAWS, Inputs, ViewState, preset_inflow
from explorer.model.session_state import SessionState
from explorer.model.units import UNITS, number
from explorer.text.readout import PART_TITLES
from rotor.trim.solution import PowerBudget

FLIGHTS = {"Hover": 0.0, "0.15": 0.15, "0.24": 0.24, "0.37": 0.37}
"""Advance ratios: hover, minimum power, cruise, high speed."""

_THESIS = Inputs(preset="thesis", law="linear", linear=-16.0, advance_ratio=0.0, **preset_inflow("thesis"))
DOCUMENT: dict[str, Inputs] = {
    "Document: hover, −16° (baseline)": _THESIS,
    "Document: hover optimum, −13.5°": replace(_THESIS, linear=-13.5),
    "Document: from µ 0.18, −8°": replace(_THESIS, linear=-8.0, advance_ratio=0.18),
}
"""Designs whose twist and flight condition the source document states (chapter 3): linear twist, its preset."""
EXAMPLES: dict[str, Inputs] = {
    "Example: low speed, µ 0.10, −12°": replace(_THESIS, linear=-12.0, advance_ratio=0.1),
    "Example: high speed, µ 0.35, −4°": replace(_THESIS, linear=-4.0, advance_ratio=0.35),
}
"""Our own cases in the preset of the document, which prints no advance ratio for low and high speed."""
CASES = {**DOCUMENT, **EXAMPLES}
"""The menu."""


Say = Callable[[SessionState], str]


@dataclass(frozen=True)
class LargeNumber:
    """A number to be read from the back of the room."""

    value: str
    """With its unit, on one line."""
    caption: str


_TEXT = Path(__file__).parent / "text"


def step_text(name: str) -> tuple[str, str, str]:
    """Title, what to watch, and what to try at a step: from its Markdown file.

    ValueError for a file that is not laid out as `# title`, a text, `## Try` and a text.
    """
    text = (_TEXT / f"{name}.md").read_text(encoding="utf-8")
    found = re.fullmatch(r"# ([^\n]+)\n\n([^#]+)\n\n## Try\n\n([^#]+)\n", text)
    if found is None:
        raise ValueError(f"{name}.md is no step of the lecture: write '# title', a text, '## Try' and a text")
    title, watch, do = (" ".join(part.split()) for part in found.groups())
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
    say: Say
    """What is seen, in the present numbers; it holds wherever the sliders are moved."""
    numbers: Callable[[SessionState], tuple[LargeNumber, LargeNumber, LargeNumber]]
    """Three large numbers beside the caption."""
    against: Inputs | None = None
    """A of A/B."""
    field: str = "Induced inflow λi"
    difference: bool = False
    """Whether the disk shows B − A."""
    mode: str = "explore"
    """Mode of the page in which the step is seen."""


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


def _power(state: SessionState, watts: float, sign: bool = False) -> str:
    """In the chosen units, on one line."""
    return UNITS[state.view.units].watts(watts, sign=sign).replace(" ", "\u00a0").replace("\u2009", "\u00a0")


def _percent(share: float, digits: int = 0, sign: bool = False) -> str:
    return f"{number(100.0 * share, digits, sign=sign)}\u00a0%"


def _shares(state: SessionState) -> str:
    power = state.solution.power
    shares = ", ".join(
        f"{title.lower()} {_percent(getattr(power, name) / power.total)}" for name, title in PART_TITLES.items()
    )
    return f"Now {_power(state, power.total)}: {shares}."


def _induced(state: SessionState) -> str:
    before, after = _powers(state)
    a, b = before.induced, after.induced
    change = f"{_power(state, b - a, sign=True)} ({_percent(b / a - 1.0, 1, sign=True)})"
    return f"Induced power: A {_power(state, a)}, B {_power(state, b)}; {change}."


def _both(state: SessionState) -> str:
    before, after = _powers(state)
    induced, profile = after.induced - before.induced, after.profile - before.profile
    return f"From A to B: induced {_power(state, induced, sign=True)}, profile {_power(state, profile, sign=True)}."


def _reverse(state: SessionState) -> str:
    before, after = _powers(state)
    area = _percent(state.solution.reverse_flow_area, 1)
    return f"{area} of the disk is in reverse flow; it costs {_power(state, after.total - before.total)} in total."


def _per_cent(state: SessionState) -> str:
    before, after = _powers(state)
    saving = before.total - after.total
    share = f"{_percent(saving / before.total, 2)} of {_power(state, before.total)}"
    return f"B needs {_power(state, saving)} less than A: {share}."


def _actuator(state: SessionState) -> str:
    needs = _power(state, state.solution.power.total)
    return f"This blade needs {needs} here; the verdict gives the net benefit of changing its twist in flight."


def _powers(state: SessionState) -> tuple[PowerBudget, PowerBudget]:
    return state.reference.power, state.solution.power


def _total_and_parts(state: SessionState) -> tuple[LargeNumber, LargeNumber, LargeNumber]:
    power = state.solution.power
    return (
        LargeNumber(_power(state, power.total), "total power"),
        LargeNumber(_percent(power.induced / power.total), "induced share"),
        LargeNumber(_percent(power.parasite / power.total), "parasite share"),
    )


def _induced_numbers(state: SessionState) -> tuple[LargeNumber, LargeNumber, LargeNumber]:
    before, after = _powers(state)
    return (
        LargeNumber(_power(state, before.induced), "induced power, A"),
        LargeNumber(_power(state, after.induced), "induced power, B"),
        LargeNumber(_percent(after.induced / before.induced - 1.0, 1, sign=True), "change from A to B"),
    )


def _change_numbers(state: SessionState) -> tuple[LargeNumber, LargeNumber, LargeNumber]:
    before, after = _powers(state)
    return (
        LargeNumber(_power(state, after.induced - before.induced, sign=True), "induced power, B − A"),
        LargeNumber(_power(state, after.profile - before.profile, sign=True), "profile power, B − A"),
        LargeNumber(_power(state, after.total - before.total, sign=True), "total power, B − A"),
    )


def _reverse_numbers(state: SessionState) -> tuple[LargeNumber, LargeNumber, LargeNumber]:
    before, after = _powers(state)
    return (
        LargeNumber(_percent(state.solution.reverse_flow_area, 1), "of the disk in reverse flow"),
        LargeNumber(_power(state, after.profile - before.profile, sign=True), "profile power it costs"),
        LargeNumber(_power(state, after.total - before.total, sign=True), "total power it costs"),
    )


def _saving_numbers(state: SessionState) -> tuple[LargeNumber, LargeNumber, LargeNumber]:
    before, after = _powers(state)
    return (
        LargeNumber(_power(state, before.total), "total power, A"),
        LargeNumber(_power(state, after.total), "total power, B"),
        LargeNumber(_percent(after.total / before.total - 1.0, 2, sign=True), "change from A to B"),
    )


def _actuator_numbers(state: SessionState) -> tuple[LargeNumber, LargeNumber, LargeNumber]:
    power, units = state.solution.power, UNITS[state.view.units]
    mass = units.mass.text(state.solution.design.condition.mass, 1 if units.mass.size > 1.0 else 0)
    return (
        LargeNumber(_power(state, power.total), "total power"),
        LargeNumber(_power(state, 0.01 * power.total), "one per cent of that"),
        LargeNumber(mass.replace(" ", "\u00a0").replace("\u2009", "\u00a0"), "gross mass"),
    )


_LINEAR = Inputs(law="linear")
_UH60A = Inputs(law="builtin")

STEPS: tuple[LectureStep, ...] = (
    LectureStep(
        *step_text("trim"),
        _UH60A,
        _shares,
        _total_and_parts,
    ),
    LectureStep(
        *step_text("hover_twist"),
        replace(_LINEAR, linear=-16.0, advance_ratio=0.0),
        _induced,
        _induced_numbers,
        against=replace(_LINEAR, linear=0.0, advance_ratio=0.0),
        difference=True,
    ),
    LectureStep(
        *step_text("linear_inflow"),
        replace(_LINEAR, linear=-12.0, inflow="pitt-peters"),
        _both,
        _change_numbers,
        against=replace(_LINEAR, linear=0.0, inflow="pitt-peters"),
        difference=True,
    ),
    LectureStep(
        *step_text("responding_wake"),
        replace(_LINEAR, linear=-12.0),
        _both,
        _change_numbers,
        against=replace(_LINEAR, linear=0.0),
        difference=True,
    ),
    LectureStep(
        *step_text("reverse_flow"),
        replace(_UH60A, advance_ratio=0.37),
        _reverse,
        _reverse_numbers,
        against=replace(_UH60A, advance_ratio=0.37, reverse_flow=False),
        field="Power dP/dr",
    ),
    LectureStep(
        *step_text("two_segments"),
        replace(Inputs(), law="two", two_inner=-4.0, two_outer=-15.6, two_division=0.7, advance_ratio=0.3),
        _per_cent,
        _saving_numbers,
        against=replace(_LINEAR, linear=-10.6, advance_ratio=0.3),
        field="Thrust dT/dr",
    ),
    LectureStep(
        *step_text("piezoelectric_ply"),
        replace(_UH60A, advance_ratio=0.3),
        _actuator,
        _actuator_numbers,
        mode="actuate",
    ),
)
