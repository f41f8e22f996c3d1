"""A row of the table of quantities: what it holds and what can be asked of it. The rows: `rotor.design.quantities`."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from decimal import Decimal
from numbers import Real
from typing import Any, Literal

from rotor.support.user_input import check_known, did_you_mean

Kind = Literal["number", "whole", "text", "choice", "switch", "object"]
"""`text`: names, a SPEC or harmonics, checked where it is read. `choice`: one of `choices`. `object`: not written out
here."""


def number(name: str, value: object, example: str) -> float:
    """The value as a float; TypeError with one sentence when it is not a real number, ValueError if too large."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} is {value!r}, not a number: write for example {name}={example}")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(
            f"{name} has hundreds of digits: write for example {name}={example}"
        ) from None


@dataclass(frozen=True)
class Slider:
    """How the page shows a number in one system of units."""

    label: str
    low: float
    high: float
    step: float
    natural: float = 1.0
    """The step that an engineer thinks in, in the unit of the page's input."""
    per: str = "/°"
    """What follows the power for a natural step: `/0.1 R`, ` per °/R`."""
    unit: str = ""
    """What a value is followed by in words, where it is not the unit of the name."""
    size: float = 1.0
    """One of its unit, in the unit of the name."""

    @property
    def digits(self) -> int:
        """Decimals that tell two steps apart."""
        return max(0, -math.floor(math.log10(self.step)))


@dataclass(frozen=True)
class Quantity:
    """One quantity of a design: its names, unit, bounds and texts, and how to get and set it."""

    name: str
    """Argument of `make_design`, and of a study; people read the unit of a number at its end."""
    kind: Kind
    help: str = ""
    """Help of the flag and of the argument, one clause."""
    place: str = ""
    """Fields that lead to it from a `Design`, as `condition.mass`; empty where it sets several."""
    what: str = ""
    """In sentences, as `rate of climb`."""
    short: str = ""
    """Before the value in reports, which have it where it is not the default: `climb`."""
    plain: str = ""
    """The default in words: `level flight`."""
    below: str = ""
    """The word before a value below zero, which is then without its sign: `descent`."""
    low: float = -math.inf
    high: float = math.inf
    """Bounds in the unit of the name."""
    high_on_stand: float | None = None
    """Where a test may go further than flight."""
    default: Any = None
    """What nobody needs to say; None where it follows from rotor or preset."""
    examples: tuple[float, ...] = ()
    choices: tuple[str, ...] = ()
    """The names that it may have; of a text those that the help lists."""
    unit: str = ""
    """Of a number, as a symbol; `°` is held in radians."""
    in_flight: bool = False
    """Whether it is for flight only: a test stand has none."""
    in_place: str = ""
    """What the page shows on a test stand in its place."""
    axial: bool = False
    """Whether it needs models with the axial flow of the tilted disk, which the document's have not."""
    key: str = ""
    """Key in design files; empty where they have none."""
    word: str = ""
    """In a link, where it is shorter than the key."""
    section: Literal["", "fixed", "models"] = ""
    """Section of a study file; as an axis it is in [axes]. Empty: not for studies."""
    written: bool = False
    """Whether every design file has it; else only where it is not the default."""
    reported: bool = False
    """Whether every table and JSON has it; else only where it is not the default."""
    input: str = ""
    """Name of the page's input."""
    input_size: float = 1.0
    """One unit of that input, in the unit of the name."""
    slider: Slider | None = None
    """In SI."""
    aviation: Slider | None = None
    """In aviation units, where they differ."""
    title: str = ""
    """Title of a switch."""
    on: str = ""
    """The effect that a switch adds, one sentence."""
    off: str = ""
    """The model without it, one sentence."""
    hint: str = ""
    """Hint on the page, where it says more than the help; after a bar the equation or the section of docs/theory.md."""

    def of_input(self, value: float) -> float:
        """The page's input in the unit of the name, by its decimals: 2.01 t are 2010 kg, not 2009.9999999999998."""
        return (
            value
            if self.input_size == 1.0
            else float(Decimal(repr(float(value))) * Decimal(self.input_size))
        )

    def as_input(self, value: float) -> float:
        """The page's input for a value in the unit of the name, which `of_input` gives back."""
        return (
            value
            if self.input_size == 1.0
            else float(Decimal(repr(float(value))) / Decimal(self.input_size))
        )

    @property
    def flag(self) -> str:
        """The flag on the command line, without the dashes in front."""
        return self.name.removesuffix("_kg_m3").replace("_", "-")

    @property
    def numeric(self) -> bool:
        """Whether the quantity is a number."""
        return self.kind in ("number", "whole")

    @property
    def field(self) -> str:
        """Name of the dataclass field that holds the quantity."""
        return self.place.rpartition(".")[2]

    def help_with(self, choices: Iterable[str]) -> str:
        """The help text, followed by the allowed names if the quantity is a text."""
        return (
            f"{self.help}: {', '.join(choices)}" if self.kind == "text" and choices else self.help
        )

    @property
    def heading(self) -> str:
        """The label with a capital, to begin a line."""
        return f"{self.what[:1].upper()}{self.what[1:]}"

    @property
    def axis_title(self) -> str:
        """The title of a chart's axis: label and unit."""
        return self.heading + (f" [{self.unit}]" if self.unit else "")

    @property
    def tooltip(self) -> str:
        """The tooltip on the page, with the source after a bar."""
        if self.kind == "switch" and not self.hint:
            return f"{self.on} Off: {self.off}"
        return self.hint or f"{self.help[:1].upper()}{self.help[1:]}."

    def of(self, design: Any) -> Any:
        """The value of a design in the unit of the name; None where the design has none."""
        for name in self.place.split("."):
            design = None if design is None else getattr(design, name)
        return None if design is None else self.shown(design)

    def usual(self, design: Any) -> Any:
        """The default value; if the row has none, the value of the aircraft of the design."""
        return self.of(design.aircraft) if self.default is None else self.default

    def put(self, design: Any, value: Any) -> Any:
        """The design with this value, in the unit of the name; ValueError if it is out of bounds."""
        return replaced(design, self.place.split("."), self.si(value))

    def si(self, value: Any) -> Any:
        """The value as the design holds it: angles in radians."""
        return math.radians(value) if self.unit == "°" else value

    def shown(self, value: Any) -> Any:
        """A value as the design holds it, converted to the unit of the name: angles to degrees."""
        return math.degrees(value) if self.unit == "°" else value

    def read(self, value: object) -> float:
        """The value as a float in the unit of the name; TypeError or ValueError with one sentence for no number."""
        return number(self.name, value, f"{self.examples[-1]:g}")

    def check(self, value: float, tested: bool = False) -> None:
        """Raise ValueError with one sentence if the value, in the unit of the name, is out of bounds."""
        high = self.high if self.high_on_stand is None or not tested else self.high_on_stand
        slack = 1e-9 if self.unit == "°" else 0.0  # Of an angle that was radians.
        if not (math.isfinite(value) and self.low - slack <= value <= high + slack):
            words, unit = (
                (self.what, self.unit and f" {self.unit}") if self.what else (self.name, "")
            )
            tonnes = self.unit == "kg" and self.low <= 1e3 * value <= high
            remedy = f"{value:g} t is {1e3 * value:g} kg" if tonnes else "choose a value inside"
            raise ValueError(
                f"{words} {value:g}{unit} is outside {self.low:g}…{high:g}{unit}: {remedy}"
            )

    def check_choice(self, value: Any) -> None:
        """Raise ValueError with one sentence if the value is not one of `choices`."""
        check_known(self.name.replace("_", " "), value, self.choices)

    def in_words(self, value: float) -> str:
        """The value with its word: `climb 5 m/s`, `descent 3 m/s`."""
        falls = bool(self.below) and value < 0.0
        return f"{self.below if falls else self.short} {abs(value) if falls else value:g} {self.unit}".rstrip()

    def applies(self, *, tested: bool, axial: bool) -> bool:
        """Whether the quantity has an effect on a test stand or in flight, and with these models."""
        return not (tested and self.in_flight) and (axial or not self.axial)


def check_names(
    function: Callable[..., Any],
    given: Iterable[str],
    known: Iterable[str],
    elsewhere: Callable[[str], str],
) -> None:
    """TypeError with one sentence for a name among the `**` arguments of a function that is none of those known.

    elsewhere: the code that does what a name asks for; empty where there is none.
    """
    names = [*(function.__kwdefaults__ or {}), *known]
    for name in given:
        if name not in names:
            code = elsewhere(name)
            hint = (
                f": write {code}"
                if code
                else did_you_mean(name, names) or f": it takes {', '.join(names)}"
            )
            raise TypeError(f"{function.__name__}() has no argument {name!r}{hint}")


def replaced(thing: Any, names: list[str], value: Any) -> Any:
    """A value made of dataclasses with another value in the field that `names` lead to."""
    first, *rest = names
    return replace(
        thing, **{first: replaced(getattr(thing, first), rest, value) if rest else value}
    )
