"""The lecture: steps that each set the page, ask for a guess, and answer it with computed numbers.

What is said at a step is in its file in the folder `text`; every number in it is a name in braces, which `facts` finds.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from explorer.model.inputs import LAWS, Inputs, ViewState
from explorer.model.undo import differing
from explorer.model.units import Units, degrees, number
from explorer.picture.camera_views import Shot
from explorer.text.readout import PART_TITLES
from rotor import Solution, hub_loads

_TEXT = Path(__file__).parent / "text"
_HEADINGS = ("Compare", "Guess", "Answer", "Try")
MOVED = frozenset({"law"}.union(*(law.inputs for law in LAWS.values())))
"""Inputs that mean the jig twist."""


@dataclass(frozen=True)
class StepText:
    """What is said at a step, with names of numbers in braces."""

    title: str
    watch: str
    """What to look at, and why it is so."""
    question: str
    options: tuple[str, ...]
    """Answers to choose from, that of the least value first."""
    answer: str
    todo: str
    """What to try; the control's name in asterisks."""
    a: str = ""
    """What A is; empty where nothing is compared."""
    b: str = ""

    @property
    def parts(self) -> tuple[str, ...]:
        """All of it but the title."""
        return tuple(filter(None, (self.watch, self.question, *self.options, self.answer, self.todo, self.a, self.b)))


def step_text(name: str) -> StepText:
    """What the Markdown file of a step says.

    ValueError for one that is not laid out as `# title`, a text, and `## Compare` (`A: …`, `B: …`; may be left out),
    `## Guess` (a question and a list), `## Answer`, `## Try` in this order.
    """
    text = (_TEXT / f"{name}.md").read_text(encoding="utf-8")
    first, *rest = re.split(r"\n## (\w+)\n", text)
    head = re.fullmatch(r"# ([^\n]+)\n\n(.+)", first, re.DOTALL)
    said = dict(zip(rest[::2], map(str.strip, rest[1::2]), strict=True))
    guess = re.fullmatch(r"(.+?)\n\n((?:- [^\n]+\n?)+)", said.get("Guess", ""), re.DOTALL)
    pair = re.fullmatch(r"A: (.+)\n\nB: (.+)", said.get("Compare", "A: -\n\nB: -"))
    wanted = [heading for heading in _HEADINGS if heading in said or heading != "Compare"]
    if head is None or guess is None or pair is None or rest[::2] != wanted or not all(said.values()):
        raise ValueError(
            f"{name}.md is no step of the lecture: write '# title', a text, '## Compare' with 'A: …' and 'B: …' or "
            "without it, '## Guess' with a question and a list, '## Answer' and '## Try'"
        )
    options = tuple(line.removeprefix("- ") for line in guess[2].splitlines())
    title, watch, question, answer, todo = (
        " ".join(part.split()) for part in (head[1], head[2], guess[1], said["Answer"], said["Try"])
    )
    compared = (pair[1], pair[2]) if "Compare" in said else ("", "")
    return StepText(title, watch, question, options, answer, todo, *compared)


@dataclass(frozen=True)
class Control:
    """What is moved at a step, through designs that can be computed beforehand."""

    label: str
    values: tuple[float, ...]
    """A switch has two."""
    apply: Callable[[Inputs, float], Inputs]
    words: Callable[[float], str]
    """What stands beside it."""
    start: int
    """Place in `values` at which the step begins."""
    kind: Literal["slider", "switch"] = "slider"


@dataclass(frozen=True)
class LectureStep:
    """One stop of the lecture."""

    name: str
    """Name of the lecture's file and of what finds its numbers."""
    text: StepText
    inputs: Inputs
    control: Control
    shot: Shot
    figures: tuple[tuple[str, str], tuple[str, str], tuple[str, str]]
    """Three large numbers: name of the quantity, caption."""
    bounds: tuple[float, ...]
    """Between the answers of the guess; there is one more answer than bounds."""
    against: Inputs | None = None
    """A of A/B."""
    field: str = "Induced inflow λi"
    mode: Literal["explore", "actuate"] = "explore"
    """Mode of the page in which the step is seen."""

    def begin(self) -> Inputs:
        """What stands on the sliders at first."""
        return self.control.apply(self.inputs, self.control.values[self.control.start])


def view_of(step: LectureStep, view: ViewState) -> ViewState:
    """What is shown at a step: A and B on either side of a handle where they are compared."""
    compared = step.against is not None
    return replace(view, field=step.field, difference=False, wipe=compared, reverse_flow=True, stall=True)


def beside(against: Inputs | None, stated: Inputs, inputs: Inputs) -> Inputs | None:
    """A for the inputs on the sliders, where a step sets `against` beside its `own` inputs; None without A.

    A and B differ by the twist and by what differs there, so only by the subject of the step, also after the user has
    chosen another inflow.
    """
    if against is None:
        return None
    return replace(inputs, **{name: getattr(against, name) for name in differing(against, stated) | MOVED})


def quantities(b: Solution, a: Solution, units: Units) -> dict[str, str]:
    """Numbers with their units, each on one line: of A (the reference), of B (the design), and of B − A."""
    before, after = a.power, b.power

    def power(watts: float, sign: bool = False) -> str:
        return on_one_line(units.watts(watts, sign=sign))

    def percent(share: float, digits: int = 0, sign: bool = False) -> str:
        return f"{number(100.0 * share, digits, sign=sign)}\u00a0%"

    words = {
        **{f"{name}_share": percent(getattr(after, name) / after.total) for name in PART_TITLES},
        **{
            f"{name}_{which}": power(getattr(part, name))
            for name in ("total", "induced")
            for which, part in (("a", before), ("b", after))
        },
        **{
            f"{name}_change": power(getattr(after, name) - getattr(before, name), sign=True)
            for name in ("total", "induced", "profile")
        },
        "induced_percent": percent(after.induced / before.induced - 1.0, 1, sign=True),
        "total_percent": percent(after.total / before.total - 1.0, 2, sign=True),
        "reverse_area": percent(b.reverse_flow_area, 1),
        "tilt": degrees(b.controls.shaft_tilt, 1),
    }
    loads_a, loads_b = hub_loads(a, band=False), hub_loads(b, band=False)
    if loads_a is not None and loads_b is not None:
        words["index_b"] = percent(0.01 * loads_b.index, 1)
        words["index_change"] = percent(loads_b.index / loads_a.index - 1.0, 0, sign=True)
    return words


def on_one_line(text: str) -> str:
    """A number and its unit are not parted."""
    return text.replace(" ", "\u00a0").replace("\u2009", "\u00a0")


def angle_words(rate: float) -> str:
    """A rate of twist [°/R]."""
    return f"{number(rate, 1 if rate % 1.0 else 0)}°/R"


def speed_words(advance_ratio: float) -> str:
    """An advance ratio, or that there is none."""
    return f"µ\u00a0{advance_ratio:.3f}".rstrip("0").ljust(6, "0") if advance_ratio else "hover"


def _steps(low: float, high: float, step: float) -> tuple[float, ...]:
    count = round((high - low) / step) + 1
    return tuple(round(low + k * step, 4) for k in range(count))


def _fly(values: tuple[float, ...], start: float, label: str = "Advance ratio") -> Control:
    return Control(
        label, values, lambda inputs, mu: replace(inputs, advance_ratio=mu), speed_words, values.index(start)
    )


def _twist(start: float) -> Control:
    values = _steps(-24.0, 0.0, 2.0)[::-1]
    return Control("Twist", values, lambda inputs, rate: replace(inputs, linear=rate), angle_words, values.index(start))


SPEEDS = (0.0, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35)
"""Advance ratios of the steps whose twist follows the speed: those of `rotor.reproduce.ladder`."""
FRONT = 5
"""Points of the front of power and vibration, after the blade without active twist."""
_LINEAR, _UH60A = Inputs(law="linear"), Inputs(law="builtin")
_POWERS = (("total_a", "total power, A"), ("total_b", "total power, B"), ("total_percent", "change from A to B"))
_CHANGES = (
    ("induced_change", "induced power, B − A"),
    ("profile_change", "profile power, B − A"),
    ("total_change", "total power, B − A"),
)
_CRAFT = ((0.16, 0.0, -0.16), (1.0, 0.72, 0.2))
_LONG = ((0.24, 0.0, -0.1), (1.3, 0.4, 0.3))
_DISK = ((0.0, 0.0, -0.05), (1.12, 1.12, 0.06))
_BLADE = ((0.3, 0.55, -0.02), (0.3, 0.42, 0.06))
"""Centre and half size of what a camera holds, in radii."""

STEPS: tuple[LectureStep, ...] = (
    LectureStep(
        "trim", step_text("trim"), _UH60A, _fly(_steps(0.0, 0.35, 0.025), 0.2), Shot(48.0, 20.0, *_CRAFT),
        (("total_b", "total power"), ("induced_share", "induced share"), ("parasite_share", "parasite share")),
        bounds=(0.5, 1.0),
    ),
    LectureStep(
        "hover_twist", step_text("hover_twist"), replace(_LINEAR, advance_ratio=0.0), _twist(-16.0),
        Shot(30.0, 33.0, *_DISK),
        (("induced_a", "induced power, A"), ("induced_b", "induced power, B"), ("induced_percent", "from A to B")),
        bounds=(0.02, 0.12), against=replace(_LINEAR, linear=0.0, advance_ratio=0.0), field="Total inflow λ",
    ),
    LectureStep(
        "linear_inflow", step_text("linear_inflow"), replace(_LINEAR, inflow="pitt-peters"), _twist(-12.0),
        Shot(-24.0, 36.0, *_DISK), _CHANGES, bounds=(0.1,),
        against=replace(_LINEAR, linear=0.0, inflow="pitt-peters"),
    ),
    LectureStep(
        "responding_wake", step_text("responding_wake"), _LINEAR, _twist(-12.0), Shot(-24.0, 36.0, *_DISK), _CHANGES,
        bounds=(0.5,), against=replace(_LINEAR, linear=0.0),
    ),
    LectureStep(
        "fast_twist", step_text("fast_twist"), replace(_LINEAR, linear=-11.6, advance_ratio=0.35),
        Control(
            "Fuselage drag", (1.0, 0.0), lambda inputs, on: replace(inputs, fuselage=on > 0.5),
            lambda on: "as it is" if on > 0.5 else "none", 0, "switch",
        ),
        Shot(70.0, 24.0, *_LONG), (*_POWERS[1:], ("tilt", "shaft tilt, forward")),
        bounds=(-0.005, 0.005), against=replace(_LINEAR, linear=-4.0, advance_ratio=0.35), field="Thrust dT/dr",
    ),
    LectureStep(
        "reverse_flow", step_text("reverse_flow"), _UH60A, _fly(_steps(0.17, 0.41, 0.02), 0.37),
        Shot(0.0, 74.0, *_DISK),
        (("reverse_area", "of the disk in reverse flow"), ("profile_change", "profile power it costs"),
         ("total_change", "total power it costs")),
        bounds=(0.0, 0.01), against=replace(_UH60A, reverse_flow=False), field="Power dP/dr",
    ),
    LectureStep(
        "two_segments", step_text("two_segments"),
        replace(Inputs(), law="two", two_inner=-4.0, two_outer=-15.6, two_division=0.7, advance_ratio=0.3),
        Control("Inboard twist", _steps(-16.0, 4.0, 2.0), lambda inputs, rate: replace(inputs, two_inner=rate),
                angle_words, 6),
        Shot(20.0, 20.0, *_BLADE), _POWERS, bounds=(0.002, 0.02),
        against=replace(_LINEAR, linear=-10.6, advance_ratio=0.3), field="Thrust dT/dr",
    ),
    LectureStep(
        "fixed_or_moving", step_text("fixed_or_moving"), _LINEAR, _fly(SPEEDS, 0.0, "Speed"),
        Shot(24.0, 18.0, *_BLADE), _POWERS, bounds=(0.01, 0.05), against=replace(_LINEAR, linear=-12.0),
        field="Total inflow λ",
    ),
    LectureStep(
        "power_or_vibration", step_text("power_or_vibration"), replace(_UH60A, advance_ratio=0.3, bending=True),
        Control("Compromise", tuple(map(float, range(FRONT))), lambda inputs, _: inputs,
                lambda at: "least power" if at == 0.0 else "least vibration" if at == FRONT - 1 else "between", 0),
        Shot(64.0, 20.0, *_LONG),
        (("total_percent", "power, from A to B"), ("index_b", "vibration index"), ("index_change", "from A to B")),
        bounds=(0.0,), against=replace(_UH60A, advance_ratio=0.3, bending=True), field="Angle of attack",
    ),
    LectureStep(
        "piezoelectric_ply", step_text("piezoelectric_ply"), _UH60A, _fly(SPEEDS, 0.3, "Speed"),
        Shot(20.0, 20.0, *_BLADE),
        (("required", "twist wanted"), ("attainable", "twist in reach"), ("net", "power, on balance")),
        bounds=(0.0,), mode="actuate",
    ),
)  # fmt: skip
