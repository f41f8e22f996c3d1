"""Twist laws θ_tw(r): how the blade is pre-twisted along its radius, and how they are written as text.

Every law returns radians, nose-up positive, for r = y/R, and is zero at 0.75 R, so that the collective is the
pitch at 0.75 R whatever the law. Rates are radians per radius. As text, a law is a SPEC such as
`segments:-12,-4@0.5`, or a table of two columns.

`LAWS` has the classes of a SPEC, which the command line, design files and links read. In
`rotor.optimisation.concepts` stand the parameters of those that the optimiser and the page move. One file: the laws and
their text.
"""

import math
import re
from collections.abc import Callable
from dataclasses import astuple, dataclass, fields
from functools import cache, lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any, ClassVar, Protocol, Self, runtime_checkable

import numpy as np
import scipy
from numpy.typing import ArrayLike

from rotor.support.arrays import Array
from rotor.support.assets import SHIPPED_ROTORS, toml_asset
from rotor.support.user_input import did_you_mean, read_text, refusing

REFERENCE_RADIUS = 0.75
"""r/R where every twist law is zero."""


SEARCHED_STATIONS = (0.13, 0.30, 0.46, 0.61, REFERENCE_RADIUS, 0.88, 1.0)
"""r/R of the angles that a search of a smooth curve moves; that at 0.75, where every law is zero, stays."""


@runtime_checkable
class TwistLaw(Protocol):
    """A twist law: the built-in pitch along the blade."""

    def __call__(self, r: ArrayLike) -> Array:
        """Built-in twist at r = y/R [rad], zero at 0.75 R; same shape as r."""
        ...

    def spec(self) -> str:
        """The SPEC of the law, which `parse_twist` reads back."""
        ...


@dataclass(frozen=True)
class SpecTwist(TwistLaw):
    """A law with a SPEC. This base class serves laws whose fields are angles [rad], in the order of the SPEC."""

    kind: ClassVar[str]
    """First word of its SPEC."""
    form: ClassVar[str]
    """What follows the colon, in words."""
    example: ClassVar[str]
    """The same in numbers."""
    noun: ClassVar[str]
    """Name on the page where its numbers are left out."""

    @classmethod
    def read(cls, angles: tuple[float, ...], places: tuple[float, ...], spec: str) -> Self:
        """The law of the angles [rad] and of the stations r/R after @ of a SPEC; ValueError where they do not fit."""
        if len(angles) != len(fields(cls)) or places:
            numbers = f"{len(fields(cls))} number{'s' * (len(fields(cls)) > 1)}"
            raise ValueError(
                f"twist {spec!r} needs {numbers}: write {cls.kind}:{cls.form}, for example {cls.kind}:{cls.example}"
            )
        return cls(*angles)

    @classmethod
    def of(cls, *values: float) -> Self:
        """The law with these parameters, in SI units."""
        return cls(*values)

    @property
    def values(self) -> tuple[float, ...]:
        """The parameters of the law in SI units."""
        return astuple(self)

    def spec(self) -> str:
        """The SPEC of the law, which `parse_twist` reads back."""
        return f"{self.kind}:{_pairs(self.values, ())}"

    def slopes(self, r: Array) -> Array:
        """Exact derivatives ∂θ_tw(r)/∂value at the stations r = y/R, (values, stations)."""
        raise NotImplementedError(f"{type(self).__name__} has no parameters to search")


@dataclass(frozen=True)
class LinearTwist(SpecTwist):
    """θ_tw = rate (r − 0.75)."""

    kind, form, example, noun = "linear", "RATE", "-8", "linear"
    rate: float
    """[rad per radius], negative when the tip is nose-down."""

    def __call__(self, r: ArrayLike) -> Array:
        return self.rate * (np.asarray(r, dtype=float) - REFERENCE_RADIUS)

    def slopes(self, r: Array) -> Array:
        return (r - REFERENCE_RADIUS)[None]


@dataclass(frozen=True)
class QuadraticTwist(SpecTwist):
    """θ_tw = a r² + b r + c, with a + b the tip-minus-root difference (thesis §4.1.2)."""

    kind, form, example, noun = "quadratic", "A,D", "6,-14", "quadratic"
    curvature: float
    """a, the second-order coefficient [rad per radius²]."""
    difference: float
    """θ(r=1) − θ(r=0) [rad], so that curvature 0 is the linear law of that rate."""

    def __call__(self, r: ArrayLike) -> Array:
        r = np.asarray(r, dtype=float)
        slope = self.difference - self.curvature
        return self.curvature * (r**2 - REFERENCE_RADIUS**2) + slope * (r - REFERENCE_RADIUS)

    def slopes(self, r: Array) -> Array:
        line = r - REFERENCE_RADIUS
        return np.stack([r**2 - REFERENCE_RADIUS**2 - line, line])


@dataclass(frozen=True)
class PiecewiseLinearTwist(SpecTwist):
    """Linear segments, continuous at movable breaks (thesis §4.1.3–4.1.5)."""

    kind, form, example, noun = "segments", "RATES@BREAKS", "-12,-4@0.5", "segments"
    rates: tuple[float, ...]
    """[rad per radius], root to tip, one per segment."""
    breaks: tuple[float, ...]
    """r/R of the divisions, ascending, one fewer than the rates."""

    def __post_init__(self) -> None:
        if len(self.breaks) != len(self.rates) - 1:
            raise ValueError(
                f"{len(self.rates)} segment rates need {len(self.rates) - 1} break(s), {len(self.breaks)} given: "
                f"write for example segments:{self.example}"
            )
        ends = (0.0, *self.breaks, 1.0)
        if any(low >= high for low, high in pairwise(ends)):
            raise ValueError(
                f"segment breaks {list(self.breaks)} must ascend between 0 and 1: reorder or move them"
            )

    def __call__(self, r: ArrayLike) -> Array:
        r = np.asarray(r, dtype=float)
        knots = np.array((0.0, *self.breaks, 1.0))
        values = np.concatenate(([0.0], np.cumsum(np.array(self.rates) * np.diff(knots))))
        return np.interp(r, knots, values) - np.interp(REFERENCE_RADIUS, knots, values)

    @classmethod
    def read(cls, angles: tuple[float, ...], places: tuple[float, ...], spec: str) -> Self:
        return cls(angles, places)

    @classmethod
    def of(cls, *values: float) -> Self:
        """The rates root to tip, then the breaks."""
        n = (len(values) + 1) // 2
        return cls(values[:n], values[n:])

    @property
    def values(self) -> tuple[float, ...]:
        return (*self.rates, *self.breaks)

    def spec(self) -> str:
        return f"segments:{_pairs(self.rates, self.breaks)}"

    def slopes(self, r: Array) -> Array:
        """Slopes: by a rate, the length of its segment from 0.75 R to r; by a break, its jump of rate, for r beyond.

        On the break itself the slope is that from inboard.
        """
        n, rates = len(self.rates), self.rates
        ends = (0.0, *self.breaks, 1.0)
        out = np.empty((n + len(self.breaks), len(r)))
        for k in range(n):
            out[k] = np.clip(r, ends[k], ends[k + 1]) - min(
                max(REFERENCE_RADIUS, ends[k]), ends[k + 1]
            )
        for k, place in enumerate(self.breaks):
            out[n + k] = (rates[k] - rates[k + 1]) * ((r > place) - float(place < REFERENCE_RADIUS))
        return out


@dataclass(frozen=True)
class SplineTwist(SpecTwist):
    """A smooth curve through a few angles: the cubic spline without knots at the second and last but one station.

    It represents every linear and quadratic law exactly.
    """

    kind, form, example, noun = (
        "spline",
        "ANGLES@STATIONS",
        "9,6,0,-5@0.13,0.4,0.75,1",
        "smooth curve",
    )
    stations: tuple[float, ...]
    """r/R, ascending, four or more."""
    angles: tuple[float, ...]
    """[rad]; shifted so that the law is zero at 0.75 R."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.angles) or len(self.stations) < 4:
            raise ValueError(
                f"{len(self.angles)} spline angles at {len(self.stations)} stations: give four or more of each, "
                f"for example spline:{self.example}"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(
                f"spline stations {list(self.stations)} must ascend: reorder or move them"
            )
        if not (self.stations[0] >= 0.0 and self.stations[-1] <= 1.0):
            raise ValueError(
                f"spline stations {list(self.stations)} must lie within 0…1: give them as r/R"
            )

    def __call__(self, r: ArrayLike) -> Array:
        radii = np.asarray(r, dtype=float)
        angles = np.array(self.angles)
        return (
            spline_basis(self.stations, radii) @ angles
            - spline_basis(self.stations, REFERENCE_RADIUS) @ angles
        )

    @classmethod
    def read(cls, angles: tuple[float, ...], places: tuple[float, ...], spec: str) -> Self:
        return cls(places, angles)

    @classmethod
    def of(cls, *values: float) -> Self:
        """The law through these angles [rad] at `SEARCHED_STATIONS`."""
        return cls(SEARCHED_STATIONS, values)

    def spec(self) -> str:
        return f"spline:{_pairs(self.angles, self.stations)}"

    def slopes(self, r: Array) -> Array:
        return (spline_basis(self.stations, r) - spline_basis(self.stations, REFERENCE_RADIUS)).T


@dataclass(frozen=True)
class SumTwist:
    """A twist law plus a change, as an actuator adds one to the blade as built."""

    base: TwistLaw
    change: TwistLaw
    name: str = ""
    """Of the change, where a program made it from many numbers; a SPEC has the numbers alone."""

    def __call__(self, r: ArrayLike) -> Array:
        return self.base(r) + self.change(r)

    def spec(self) -> str:
        return f"{self.base.spec()}+{self.change.spec()}"


@dataclass(frozen=True)
class IdealTwist(SpecTwist):
    """θ = θ_tip / r, eq. (1.1): uniform inflow in hover when the collective puts θ_tip at the tip.

    Source: thesis eq. (1.1), p. 2. Singular at r = 0, so it needs a root cut-out.
    """

    kind, form, example, noun = "ideal", "TIP", "6.4", "ideal"
    tip_pitch: float
    """θ_tip [rad]."""

    def __call__(self, r: ArrayLike) -> Array:
        return self.tip_pitch * (1.0 / np.asarray(r, dtype=float) - 1.0 / REFERENCE_RADIUS)


@dataclass(frozen=True)
class TableTwist(SpecTwist):
    """Linear interpolation between stations; constant beyond the first and last."""

    kind, form, example, noun = "points", SplineTwist.form, SplineTwist.example, "from a table"
    stations: tuple[float, ...]
    """r/R, ascending."""
    angles: tuple[float, ...]
    """[rad]; shifted so that the law is zero at 0.75 R."""
    name: str = "table"
    """Name of the law in a SPEC: a shipped rotor's name, or table:FILE."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.angles) or len(self.stations) < 2:
            raise ValueError(
                f"a twist table needs two or more stations with one angle each; {len(self.stations)} radii and "
                f"{len(self.angles)} angles given: complete the rows"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(
                f"twist table radii {list(self.stations)} must ascend: sort the rows, one row per radius"
            )

    def __call__(self, r: ArrayLike) -> Array:
        zero = np.interp(REFERENCE_RADIUS, self.stations, self.angles)
        return np.interp(np.asarray(r, dtype=float), self.stations, self.angles) - zero

    @classmethod
    def read(cls, angles: tuple[float, ...], places: tuple[float, ...], spec: str) -> Self:
        return cls(places, angles, spec)

    def spec(self) -> str:
        return self.name


def _degrees(angle: float) -> str:
    return f"{round(math.degrees(angle), 6):.10g}"


def _pairs(angles: tuple[float, ...], places: tuple[float, ...]) -> str:
    """Angles in degrees, and r/R after @."""
    at = f"@{','.join(f'{place:.10g}' for place in places)}" if places else ""
    return ",".join(map(_degrees, angles)) + at


def ideal_tip_pitch(ct: float, solidity: float, lift_slope: float) -> float:
    """θ_tip [rad] of the ideal twist θ_tip/r, eq. (1.1), that carries C_T in hover with uniform inflow.

    From ½σa(θ_tip − λ) r = 4λ² r with λ = √(C_T/2): θ_tip = 4C_T/(σa) + √(C_T/2).
    """
    return 4.0 * ct / (solidity * lift_slope) + math.sqrt(ct / 2.0)


def spline_basis(knots: tuple[float, ...], x: ArrayLike, *, derivative: int = 0) -> Array:
    """B with spline(x) = B · values at the knots, (…, knots); end condition not-a-knot."""
    return np.asarray(_spline(knots)(np.asarray(x, dtype=float), derivative))


@lru_cache(maxsize=32)
def _spline(knots: tuple[float, ...]) -> "scipy.interpolate.CubicSpline":
    return scipy.interpolate.CubicSpline(knots, np.eye(len(knots)))


LAWS = {
    law.kind: law
    for law in (
        LinearTwist,
        QuadraticTwist,
        PiecewiseLinearTwist,
        SplineTwist,
        TableTwist,
        IdealTwist,
    )
}
"""Laws that a SPEC writes out, by its first word."""
_NAMES = (*LAWS, "builtin", "table", *SHIPPED_ROTORS)
SPEC_FORMS = (
    *(f"{law.kind}:{law.form}" for law in LAWS.values()),
    "ideal",
    "builtin",
    SHIPPED_ROTORS[0],
    "table:FILE",
)
"""Every form of a SPEC."""
_PLUS = re.compile(rf"\+(?=(?:{'|'.join(_NAMES)})\b)")
"""Between the laws of a sum, not the plus sign of a number or of a file's name."""
_NUMBER = re.compile(r"([-+−]?\d*\.?\d+)\s*°?")
_MOST_LAWS, _MOST_ROWS = 20, 1000
"""Laws of a sum, which is evaluated law by law within each other, and numbers of one law."""


def parse_twist(
    spec: str,
    *,
    builtin: TwistLaw | None = None,
    ideal_tip_pitch: Callable[[], float] | None = None,
) -> TwistLaw:
    """The twist law of a SPEC. Angles in the SPEC are degrees, stations are r/R; the law returns radians.

    The forms are `SPEC_FORMS`: `linear:-8`, `segments:-12,-4@0.5`; `points` has straight lines between its stations;
    `uh60a` is the built-in twist of a shipped rotor. A plus sign adds laws: `uh60a+linear:-2`.
    `builtin` is the law that the SPEC `builtin` stands for; `ideal_tip_pitch` gives the angle [rad] of `ideal` without
    a number. `make_design` and `Design.with_twist` supply both.

    Raises TypeError or ValueError with one sentence that names the value and the remedy.
    """
    if not isinstance(spec, str):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass numbers
        remedy = (
            f'write "linear:{spec}"'
            if isinstance(spec, int | float)
            else 'write a text such as "linear:-12"'
        )
        raise TypeError(
            f"twist {spec!r} is not a twist: {remedy} (degrees per radius), or pass a twist law"
        )
    first, *others = _PLUS.split(spec.strip())
    if len(others) >= _MOST_LAWS:
        raise ValueError(f"twist adds {len(others) + 1} laws: give at most {_MOST_LAWS}")
    if spec.count(",") > 2 * _MOST_ROWS:
        raise ValueError(
            f"twist has {spec.count(',') + 1} numbers: give at most {_MOST_ROWS} stations"
        )
    if others:
        law = parse_twist(first, builtin=builtin, ideal_tip_pitch=ideal_tip_pitch)
        for other in others:
            law = SumTwist(
                law, parse_twist(other, builtin=builtin, ideal_tip_pitch=ideal_tip_pitch)
            )
        return law
    return _single_twist(spec, builtin, ideal_tip_pitch)


def _single_twist(
    spec: str, builtin: TwistLaw | None, ideal_tip_pitch: Callable[[], float] | None
) -> TwistLaw:
    kind, _, rest = spec.strip().partition(":")
    if not rest and builtin is not None and kind in ("builtin", builtin.spec()):
        return builtin
    if not rest and kind in SHIPPED_ROTORS:
        return shipped_twist(kind)
    if rest and kind in ("builtin", *SHIPPED_ROTORS):
        raise ValueError(
            f"twist {spec!r} has numbers, which {kind} does not take: write {kind} or {kind}+linear:-2"
        )
    if kind == "builtin":
        raise ValueError(
            f"twist {spec!r} needs a rotor: pass it to make_design, or name {', '.join(SHIPPED_ROTORS)}"
        )
    if kind == "ideal" and not rest:
        if ideal_tip_pitch is None:
            raise ValueError(
                f"twist {spec!r} needs a rotor and a weight: pass it to make_design, or write ideal:6.4"
            )
        return IdealTwist(ideal_tip_pitch())
    if kind in LAWS:
        before, _, after = rest.partition("@")
        try:
            return LAWS[kind].read(_angles(before, spec), _stations(after, spec), spec.strip())
        except _NotANumber as error:
            raise ValueError(f"{error}: write for example {kind}:{LAWS[kind].example}") from None
    if kind == "table" and rest:
        return read_twist_table(Path(rest))
    if kind == "table":
        raise ValueError(
            f"twist {spec!r} names no file: write table:FILE, two columns of r/R and degrees"
        )
    number = _NUMBER.fullmatch(spec.strip())
    bare = f": write linear:{number[1].replace('−', '-')} for a linear twist, or" if number else ""
    raise ValueError(
        f"twist {spec!r} is not known{bare or did_you_mean(kind, _NAMES) or ':'} "
        f"use {', '.join(SPEC_FORMS[:-1])} or {SPEC_FORMS[-1]}"
    )


@cache
def shipped_twist(name: str) -> TwistLaw:
    """The built-in twist of a shipped rotor as it flies, from its file in `assets/`."""
    given: dict[str, Any] = toml_asset(f"{name}.toml")["main_rotor"]
    if "linear_twist_deg" in given:
        return LinearTwist(math.radians(given["linear_twist_deg"]))
    return TableTwist(
        tuple(given["twist_r"]),
        tuple(math.radians(angle) for angle in given["twist_deg"]),
        name=name,
    )


def inline_spec(law: TwistLaw) -> str:
    """The SPEC of a law as any other machine can read it: the rows of a table file in place of its name."""
    match law:
        case TableTwist(stations, angles, name) if name.startswith("table"):
            return f"points:{_pairs(angles, stations)}"
        case SumTwist(base, change):
            return f"{inline_spec(base)}+{inline_spec(change)}"
        case _:
            return law.spec()


@refusing("twist table", "give a two-column file (r/R, degrees)")
def read_twist_table(path: Path) -> TableTwist:
    """Read a text table, r/R and twist in degrees; `#` begins a comment, commas or blanks separate; else ValueError."""
    text = read_text(path, "twist table", "give the path of a two-column file (r/R, degrees)")
    rows: list[tuple[float, float]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        items = line.partition("#")[0].replace(",", " ").split()
        if not items:
            continue
        try:
            r, angle = (float(item) for item in items)
        except ValueError:
            if not rows and not items[0].replace(".", "").lstrip("+-").isdigit():
                continue  # a heading row
            raise ValueError(
                f"twist table {str(path)!r} line {number} reads {line.strip()!r}: write two numbers, r/R and degrees"
            ) from None
        if not (0.0 <= r <= 1.0 and math.isfinite(angle) and abs(angle) <= 60.0):
            raise ValueError(
                f"twist table {str(path)!r} line {number} has r/R {r:g} and {angle:g}°: keep r/R in 0…1, twist in ±60°"
            )
        rows.append((r, math.radians(angle)))
    if len(rows) > _MOST_ROWS:
        raise ValueError(
            f"twist table {str(path)!r} has {len(rows)} rows: give at most {_MOST_ROWS}"
        )
    return TableTwist(tuple(r for r, _ in rows), tuple(a for _, a in rows), name=f"table:{path}")


class _NotANumber(ValueError):
    """The text where a SPEC needs a number."""


def _angles(text: str, spec: str) -> tuple[float, ...]:
    """[rad]"""
    return tuple(math.radians(_number(item, spec)) for item in text.split(","))


def _stations(text: str, spec: str) -> tuple[float, ...]:
    return tuple(_number(item, spec) for item in text.split(",")) if text else ()


def _number(text: str, spec: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or abs(value) > 100.0:
        raise _NotANumber(f"twist {spec!r} holds {text!r}, not a number in −100…100")
    return value
