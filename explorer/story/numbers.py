"""The numbers, the chart and the stops of a step of the lecture, and how a number is written."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs
from explorer.model.units import Unit, Units, number
from explorer.story.steps import on_one_line, speed_words
from explorer.text.readout import digits_of
from rotor.trim.doubt import rounded_pair

Kind = Literal[
    "power", "change", "percent", "fine", "signed", "angle", "rate", "mu", "mass", "count", "words"
]


@dataclass(frozen=True)
class Number:
    """A number of the text, in SI; angles in degrees, rates of twist in °/R, shares as parts of one."""

    kind: Kind
    value: float
    text: str = ""
    """Text of a fact of kind "words"."""
    band: float | None = None
    """Either side of a difference of powers; None: not known."""

    def words(self, units: Units) -> str:
        """The fact as it is written, on one line."""
        value = self.value
        match self.kind:
            case "power" | "change" | "percent" if self.band:
                text = self._banded_words(value, self.band, units)
            case "power" | "change":
                text = units.watts(value, digits_of(value, units), sign=self.kind == "change")
            case "percent" | "fine" | "signed":
                digits = self._percent_digits(value)
                text = f"{number(100.0 * value, digits, sign=self.kind == 'signed')} %"
            case "angle":
                text = f"{number(value, 1)}°"
            case "rate":
                text = f"{number(value, 1)}°/R"
            case "mu":
                text = speed_words(value)
            case "mass":
                text = units.mass.text(value, 0) if units.mass.size < 1.0 else f"{number(value)} kg"
            case "count":
                text = number(value)
            case "words":
                return self.text
        return on_one_line(text)

    def _banded_words(self, value: float, band: float, units: Units) -> str:
        """The value with its band, as `−44 ± 25 kW`."""
        unit = Unit("%", 0.01) if self.kind == "percent" else units.power[0]
        pair = rounded_pair(unit.of(value), unit.of(band))
        size = number(pair.change, pair.decimals, sign=self.kind == "change")
        return f"{size} ± {number(pair.band, pair.decimals)} {unit.symbol}"

    def _percent_digits(self, share: float) -> int:
        """Decimals of a percentage."""
        if self.kind == "fine":
            return 2
        if abs(share) >= 0.095 or (100.0 * share) % 1.0 == 0.0:
            return 0
        return 1


@dataclass(frozen=True)
class ChartLine:
    """One line of a chart, in the colour of a part of power, "a", "b" or "limit"; None where there is no trim."""

    name: str
    colour: str
    y: tuple[float | None, ...]


@dataclass(frozen=True)
class StepChart:
    """What is drawn in the caption: power [W], a part of one, or degrees over what is moved."""

    x_title: str
    y_title: str
    kind: Literal["power", "percent", "angle"]
    x: tuple[float, ...]
    x_kind: Literal["mu", "rate", "signed"]
    lines: tuple[ChartLine, ...]
    band: tuple[tuple[float, ...], tuple[float, ...]] | None = None
    """Low and high."""
    dots: tuple[str, ...] = ()
    """Colours of the dots; those of the lines where none are given."""


@dataclass(frozen=True)
class ControlStop:
    """A place of the control: what is seen there."""

    words: str
    inputs: Inputs
    against: Inputs | None
    dots: tuple[tuple[float, float], ...]
    """Where it is on the chart."""
    actuator: ActuatorInputs | None = None
    """What is set of the actuator there, in Actuate."""
    numbers: Mapping[str, Number] = field(default_factory=dict[str, Number])
    """Large numbers of this place alone."""
    other_model: Mapping[str, Number] = field(default_factory=dict[str, Number])
    """Large numbers as the inflow model of the page gives them here, where the step is about another one."""
    index_band: tuple[float, float] | None = None
    """Ends over inflow models of the change of the vibration index from A [%]; None where the step has none."""


@dataclass(frozen=True)
class StepFacts:
    """What a step needs beside the trim that is seen."""

    stops: tuple[ControlStop, ...]
    numbers: Mapping[str, Number]
    right: int
    """Place of the right answer among those to choose from."""
    chart: StepChart
    open: tuple[int, ...] = ()
    """Places of other answers that its band does not rule out."""

    def words(self, units: Units) -> dict[str, str]:
        """The numbers as they are written."""
        return words_of(self.numbers, units)


def words_of(numbers: Mapping[str, Number], units: Units) -> dict[str, str]:
    """The numbers as they are written, by their names."""
    return {name: number.words(units) for name, number in numbers.items()}
