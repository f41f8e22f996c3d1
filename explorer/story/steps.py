"""The lecture: steps that each set the page, ask for a guess, and answer it with computed numbers.

`steps.toml` says what each sets, moves and shows, and its words; a number in them is a name in braces, which `facts`
finds.
"""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

from explorer.model.inputs import TWISTS, Inputs, ViewState
from explorer.model.undo import differing
from explorer.model.units import Units, degrees, number
from explorer.picture.camera_views import CameraShot
from explorer.text.readout import PART_TITLES, digits_of
from rotor import Solution, hub_loads

MOVED = frozenset({"law", *TWISTS})
"""Inputs that mean the built-in twist."""


@dataclass(frozen=True)
class StepText:
    """The words of a step, with names of numbers in braces."""

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


@dataclass(frozen=True)
class StepSlider:
    """What is moved at a step, through designs that can be computed beforehand."""

    label: str
    moves: str
    """Field of `Inputs`; empty where the designs are found otherwise."""
    values: tuple[float, ...]
    """A switch has two."""
    start: int
    """Place in `values` at which the step begins."""
    kind: Literal["slider", "switch"] = "slider"

    def apply(self, inputs: Inputs, value: float) -> Inputs:
        """The inputs with the control at a value."""
        if not self.moves:
            return inputs
        moved: dict[str, Any] = {self.moves: value > 0.5 if self.kind == "switch" else value}
        return replace(inputs, **moved)

    def words(self, value: float) -> str:
        """What stands beside it."""
        if self.kind == "switch":
            return "as it is" if value > 0.5 else "none"
        if not self.moves:
            ends = {self.values[0]: "least power", self.values[-1]: "least vibration"}
            return ends.get(value, "between")
        return speed_words(value) if self.moves == "advance_ratio" else angle_words(value)


@dataclass(frozen=True)
class LectureStep:
    """One stop of the lecture."""

    name: str
    """Name of the lecture's file and of what finds its numbers."""
    text: StepText
    inputs: Inputs
    control: StepSlider
    shot: CameraShot
    figures: tuple[tuple[str, str], ...]
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


def compared_inputs(against: Inputs | None, stated: Inputs, inputs: Inputs) -> Inputs | None:
    """A for the inputs on the sliders, where a step sets `against` beside its `own` inputs; None without A.

    A and B differ by the twist and by what differs there, so only by the subject of the step, also after the user has
    chosen another inflow.
    """
    if against is None:
        return None
    return replace(inputs, **{name: getattr(against, name) for name in differing(against, stated) | MOVED})


def compared_quantities(b: Solution, a: Solution, units: Units) -> dict[str, str]:
    """Numbers with their units, each on one line: of A (the reference), of B (the design), and of B − A."""
    before, after = a.power, b.power

    def power(watts: float, sign: bool = False) -> str:
        return on_one_line(units.watts(watts, digits_of(watts, units) if sign else 0, sign=sign))

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


def _control(label: str, start: float, moves: str = "", ends: Sequence[float] = (), **kind: Any) -> StepSlider:
    """`ends`: both, and the step between values; without them the speeds."""
    values = SPEEDS
    if ends:
        first, last, by = ends
        values = tuple(round(first + k * by, 4) for k in range(round((last - first) / by) + 1))
    return StepSlider(label, moves, values, values.index(start), **kind)


def _step(
    name: str,
    text: dict[str, Any],
    inputs: dict[str, Any],
    control: dict[str, Any],
    shot: tuple[float, float, str],
    figures: dict[str, str],
    bounds: Sequence[float],
    against: dict[str, Any] | None = None,
    **shown: Any,
) -> LectureStep:
    """A step as its table in `steps.toml` has it."""
    words: dict[str, Any] = {
        key: tuple(part) if key == "options" else " ".join(part.split()) for key, part in text.items()
    }
    return LectureStep(
        name,
        StepText(**words),
        Inputs(**inputs),
        _control(**control),
        CameraShot(*shot[:2], *map(tuple, _FILE["boxes"][shot[2]])),
        tuple(figures.items()),
        tuple(bounds),
        None if against is None else Inputs(**against),
        **shown,
    )


_FILE = tomllib.loads(Path(__file__).with_name("steps.toml").read_text(encoding="utf-8"))
SPEEDS: tuple[float, ...] = tuple(_FILE["speeds"])
STEPS = tuple(_step(name, **row) for name, row in _FILE["steps"].items())
FRONT = next(len(step.control.values) for step in STEPS if step.name == "power_or_vibration")
"""Points of the front of power and vibration, after the blade without active twist."""
