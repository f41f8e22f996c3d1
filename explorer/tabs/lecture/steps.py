"""The lecture: eight steps that set the page, say what to watch, and state what is seen in numbers of the moment."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from explorer.interface import SessionState
from explorer.state import INPUT_NAMES, LAWS, Inputs, ViewState
from explorer.text.readout import PART_TITLES
from explorer.text.units import UNITS, number
from rotor.trim.solution import PowerBudget

Say = Callable[[SessionState], str]


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
    """What is seen, in the numbers of the moment; it holds for whatever the sliders are moved to."""
    against: Inputs | None = None
    """A of A/B."""
    field: str = "Induced inflow λi"
    difference: bool = False
    """Whether the disk shows B − A."""
    tab: str = "Results"
    """Of the left panel, to be opened."""


def view_of(step: LectureStep, view: ViewState) -> ViewState:
    """What is shown at a step."""
    return replace(view, field=step.field, difference=step.difference, reverse_flow=True, stall=True, exaggeration=1.0)


def beside(step: LectureStep, inputs: Inputs) -> Inputs | None:
    """A of a step beside what is on the sliders: its own blade and whatever else sets it apart, else as B is computed.

    So that A and B differ by what the step is about, also after the user has chosen another inflow.
    """
    if step.against is None:
        return None
    own = {name for name in INPUT_NAMES if getattr(step.against, name) != getattr(step.inputs, name)}
    return replace(inputs, **{name: getattr(step.against, name) for name in own | _TWIST})


_TWIST = {"law"}.union(*(law.inputs for law in LAWS.values()))


def _power(state: SessionState, watts: float, sign: bool = False) -> str:
    """In the units that are chosen, on one line."""
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
    return f"{area} of the disk is in reverse flow; it costs {_power(state, after.total - before.total)} in all."


def _per_cent(state: SessionState) -> str:
    before, after = _powers(state)
    saving = before.total - after.total
    share = f"{_percent(saving / before.total, 2)} of {_power(state, before.total)}"
    return f"B needs {_power(state, saving)} less than A: {share}."


def _actuator(state: SessionState) -> str:
    needs = _power(state, state.solution.power.total)
    return f"This blade needs {needs} here; the tab says what moving it is worth, net."


def _powers(state: SessionState) -> tuple[PowerBudget, PowerBudget]:
    return state.reference.power, state.solution.power


_LINEAR = Inputs(law="linear")
_UH60A = Inputs(law="builtin")

STEPS: tuple[LectureStep, ...] = (
    LectureStep(
        "A rotor in trim",
        "Every picture is a rotor in trim: it carries the weight, overcomes the drag, and cyclic pitch holds its "
        "disk square to the shaft. Its power has three parts: induced (making lift), profile (dragging blades), "
        "parasite (pushing the fuselage); the tail rotor takes some more.",
        "Drag the advance ratio from 0 to 0.3: induced power falls to about a third, parasite power grows with "
        "the cube of the speed, and the total has a valley.",
        _UH60A,
        _shares,
    ),
    LectureStep(
        "Why more twist helps hover",
        "Without twist (A) the inflow of a hovering disk grows towards the tip. Twist moves lift inboard and "
        "evens the inflow: the same thrust for less induced power.",
        "Drag Rate on from −16° towards −24°: the gain ends where the inflow becomes uneven the other way.",
        replace(_LINEAR, linear=-16.0, advance_ratio=0.0),
        _induced,
        against=replace(_LINEAR, linear=0.0, advance_ratio=0.0),
        difference=True,
    ),
    LectureStep(
        "Why linear inflow cannot see it",
        "A linear model takes its inflow from thrust and speed, not from where on the disk the lift is. Twist "
        "then changes profile power only; the induced part, the largest at this speed, stays where it was.",
        "Drag Rate anywhere: watch the induced line. Then go on to the next step.",
        replace(_LINEAR, linear=-12.0, inflow="pitt-peters"),
        _both,
        against=replace(_LINEAR, linear=0.0, inflow="pitt-peters"),
        difference=True,
    ),
    LectureStep(
        "A wake that answers",
        "The same two blades with a wake that follows the lift over the disk and over time: now the induced part "
        "answers, and most of what twist saves in forward flight is induced power.",
        "Drag Rate again; or compare with Drees and Coleman in the Inflow menu.",
        replace(_LINEAR, linear=-12.0),
        _both,
        against=replace(_LINEAR, linear=0.0),
        difference=True,
    ),
    LectureStep(
        "Four blades are not infinitely many",
        "Textbooks untwist a blade for speed. That rotor has infinitely many blades: its wake is steady, and −16°"
        " (B) costs it induced power against −8° (A). Four blades shed a wake that beats with them.",
        "Untick Infinite blades (Model folder): with four blades the same twist costs nothing.",
        replace(_LINEAR, linear=-16.0, advance_ratio=0.3, inflow="dynamic-wake-infinite-blades"),
        _induced,
        against=replace(_LINEAR, linear=-8.0, advance_ratio=0.3, inflow="dynamic-wake-infinite-blades"),
        difference=True,
    ),
    LectureStep(
        "Where the reverse flow eats power",
        "Inside the outline the air meets the retreating blade from behind. It even drives the blade there, but "
        "its drag pushes the rotor back and its lift points down: the rest of the disk pays for both. A is "
        "computed without it.",
        "Open Probe and walk r at ψ = 270° through the outline; drag the advance ratio: the circle is µR wide.",
        replace(_UH60A, advance_ratio=0.37),
        _reverse,
        against=replace(_UH60A, advance_ratio=0.37, reverse_flow=False),
        field="Power dP/dr",
    ),
    LectureStep(
        "What two segments add",
        "A is the best straight blade at this speed, B the best of two straight pieces. The valley of power is so"
        " flat that degrees of twist decide about tenths of a per cent: compare powers, never angles.",
        "Move Division and both rates: how far can each go before a kilowatt is lost? Or press Optimise.",
        replace(Inputs(), two_inner=-7.9, two_outer=-16.7, two_division=0.7, advance_ratio=0.3),
        _per_cent,
        against=replace(_LINEAR, linear=-13.1, advance_ratio=0.3),
        field="Thrust dT/dr",
    ),
    LectureStep(
        "What a piezo ply can move",
        "Plies of piezoelectric fibres at ±45° twist the blade when a voltage stretches them. The tab holds what "
        "they can reach against what the best twist asks for, and what is left after their mass is carried.",
        "Drag a voltage and watch the blade; add plies: twist grows, so does the mass; then read the verdict.",
        replace(_UH60A, advance_ratio=0.3),
        _actuator,
        tab="Actuator",
    ),
)
