"""The lecture: steps that each set the page, ask for a guess, and answer it with computed numbers.

`steps.toml` says what each sets, moves and shows, and its words; a number in them is a name in braces, which `facts`
finds.
"""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, NamedTuple

from explorer.model.inputs import TWISTS, Inputs, ViewState
from explorer.model.undo import differing
from explorer.model.units import Unit, Units, degrees, number
from explorer.picture.camera_views import CameraShot
from explorer.text.readout import PART_TITLES, banded, digits_of, fineness
from rotor import PowerBudget, Solution, hub_loads
from rotor.trim.doubt import Doubt, decimals

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
    """What the twist of A is at every place of the control; empty where it is not special."""
    b: str = ""

    @property
    def parts(self) -> tuple[str, ...]:
        """All texts of the step except the title."""
        return tuple(
            filter(
                None,
                (self.watch, self.question, *self.options, self.answer, self.todo, self.a, self.b),
            )
        )


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
        if not self.moves:
            return inputs
        moved: dict[str, Any] = {self.moves: value > 0.5 if self.kind == "switch" else value}
        return replace(inputs, **moved)

    def words(self, value: float) -> str:
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
        """The inputs at the start of the step."""
        return self.control.apply(self.inputs, self.control.values[self.control.start])


def view_of(step: LectureStep, view: ViewState) -> ViewState:
    """What is shown at a step: A and B on either side of a handle where they are compared."""
    compared = step.against is not None
    return replace(
        view, field=step.field, difference=False, wipe=compared, reverse_flow=True, stall=True
    )


def compared_inputs(against: Inputs | None, stated: Inputs, inputs: Inputs) -> Inputs | None:
    """A for the inputs on the sliders, where a step sets `against` beside its `own` inputs; None without A.

    A and B differ by the twist and by what differs there, so only by the subject of the step, also after the user has
    chosen another inflow.
    """
    if against is None:
        return None
    return replace(
        inputs, **{name: getattr(against, name) for name in differing(against, stated) | MOVED}
    )


_BLANK = "\u00a0"
"""Keeps the place of a band on its way."""


class Figure(NamedTuple):
    """A large number with its unit, and beside it its band, of a change with whether its sign is known."""

    value: str
    within: str = ""
    """`± 4 kW, likely`; a blank where it is not known yet, empty where there is none."""


def compared_quantities(
    b: Solution,
    a: Solution,
    units: Units,
    sure: tuple[Doubt, Doubt] | None = None,
    index_band: tuple[float, float] | None = None,
) -> dict[str, Figure]:
    """Numbers with their units, each on one line: of A (the reference), of B (the design), and of B − A.

    `sure`: of A's power, and of B's with its change; `index_band`: of the change of the vibration index [%]. None where
    they are not known.
    """
    before, after, unit = a.power, b.power, units.power[0]
    bands = {} if sure is None else {**sure[1].part_bands, "total": sure[1].change_band}

    def percent(share: float, digits: int = 0, sign: bool = False) -> str:
        return f"{number(100.0 * share, digits, sign=sign)} %"

    def power(part: PowerBudget, which: int) -> Figure:
        band = None if sure is None else sure[which].band
        digits = 0 if band is None else max(fineness(part, units), decimals(unit.of(band)))
        return Figure(
            units.watts(part.total), _BLANK if band is None else f"± {unit.text(band, digits)}"
        )

    def change(name: str, unit: Unit, least: int) -> Figure:
        moved, within = getattr(after, name) - getattr(before, name), bands.get(name)
        if not within or max(abs(unit.of(moved)), unit.of(within)) < 0.5 * 10.0**-least:
            return Figure(unit.text(moved, least, sign=True), "" if bands else _BLANK)
        words = banded(moved, within, unit, sign=True, sourced=sure is None or sure[1].sourced)
        size, _, rest = words.partition(" ± ")
        return Figure(f"{size} {unit.symbol}", f"± {rest.replace(':', ',')}")

    found = {
        **{
            f"{name}_share": Figure(percent(getattr(after, name) / after.total))
            for name in PART_TITLES
        },
        **{
            f"{name}_change": change(
                name, unit, digits_of(getattr(after, name) - getattr(before, name), units)
            )
            for name in ("total", "induced", "profile")
        },
        "total_a": power(before, 0),
        "total_b": power(after, 1),
        "induced_a": Figure(units.watts(before.induced)),
        "induced_b": Figure(units.watts(after.induced)),
        "induced_percent": change("induced", Unit("%", 0.01 * before.induced), 1),
        "total_percent": change("total", Unit("%", 0.01 * before.total), 2),
        "reverse_area": Figure(percent(b.reverse_flow_area, 1)),
        "tilt": Figure(degrees(b.controls.shaft_tilt, 1)),
    }
    loads_a, loads_b = hub_loads(a, band=False), hub_loads(b, band=False)
    if loads_a is not None and loads_b is not None:
        found["index_b"] = Figure(percent(0.01 * loads_b.index, 1))
        within = _BLANK
        if index_band is not None:
            low, high = (number(end, 0, sign=True) for end in index_band)
            within = f"{low}…{high} %{', unclear' if index_band[0] * index_band[1] <= 0.0 else ''}"
        found["index_change"] = Figure(
            percent(loads_b.index / loads_a.index - 1.0, 0, sign=True), within
        )
    return {name: Figure(*map(on_one_line, figure)) for name, figure in found.items()}


def on_one_line(text: str) -> str:
    """A number and its unit are not parted."""
    return text.replace(" ", "\u00a0").replace("\u2009", "\u00a0")


def angle_words(rate: float) -> str:
    """A rate of twist [°/R]."""
    return f"{number(rate, 1 if rate % 1.0 else 0)}°/R"


def speed_words(advance_ratio: float) -> str:
    """An advance ratio, or that there is none."""
    return f"µ\u00a0{advance_ratio:.3f}".rstrip("0").ljust(6, "0") if advance_ratio else "hover"


def _control(
    label: str, start: float, moves: str = "", ends: Sequence[float] = (), **kind: Any
) -> StepSlider:
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
    words: dict[str, Any] = {
        key: tuple(part) if key == "options" else " ".join(part.split())
        for key, part in text.items()
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
