"""Frozen values as Python expressions: exact, with the imports they need, and only what differs from a start."""

import json
import math
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any

from rotor.design.twist import (
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TwistLaw,
)

_WIDTH = 100
"""Characters after which a call is written one argument a line."""
_EXACT = 1e-12
"""Relative: what reading degrees and writing radians may change."""


class Writer:
    """Writes expressions and remembers what they import."""

    def __init__(self) -> None:
        self._names: set[tuple[str, str]] = set()

    def name(self, module: str, name: str) -> str:
        """A name, imported."""
        self._names.add((module, name))
        return name

    def imports(self) -> list[str]:
        """One line a module."""
        modules = sorted({module for module, _ in self._names}, key=lambda m: (m.startswith("rotor"), m))
        return [
            f"from {module} import {', '.join(sorted(n for m, n in self._names if m == module))}" for module in modules
        ]

    def value(self, value: Any) -> str:
        """An expression that makes `value` to the last digit."""
        if isinstance(value, tuple):
            inside = ", ".join(self.value(item) for item in value)
            return f"({inside},)" if len(value) == 1 else f"({inside})"
        if isinstance(value, str):
            return json.dumps(value, ensure_ascii=False)
        if value is None or isinstance(value, (bool, int)):
            return repr(value)
        if isinstance(value, float):
            return repr(float(value))
        if is_dataclass(value) and not isinstance(value, type):
            given = [one for one in fields(value) if getattr(value, one.name) != _default(one)]
            inside = [f"{one.name}={self.value(getattr(value, one.name))}" for one in given]
            return self.call(self.name(type(value).__module__, type(value).__qualname__), inside)
        raise ValueError(f"{value!r} has no name in Python that a script could use: save the design as a file instead.")

    def changes(self, path: str, start: Any, wanted: Any) -> str:
        """An expression for `wanted` that starts from `path`, which holds `start`; empty when they are equal."""
        if start == wanted:
            return ""
        if type(start) is not type(wanted) or not is_dataclass(wanted):
            return self.value(wanted)
        moved = [
            f"{one.name}={change}"
            for one in fields(wanted)
            if (change := self.changes(f"{path}.{one.name}", getattr(start, one.name), getattr(wanted, one.name)))
        ]
        return self.call(self.name("dataclasses", "replace"), [path, *moved])

    def call(self, name: str, arguments: list[str]) -> str:
        """A call, on one line where that is short enough."""
        line = f"{name}({', '.join(arguments)})"
        if len(line) <= _WIDTH and "\n" not in line:
            return line
        inside = "".join(f"    {argument},\n".replace("\n", "\n    ").rstrip(" ") for argument in arguments)
        return f"{name}(\n{inside})"


def _default(one: Field[Any]) -> Any:
    return one.default if one.default is not MISSING else MISSING


def same(first: Any, second: Any) -> bool:
    """Equal, floats to the twelfth digit."""
    if _is_number(first) and _is_number(second):
        return math.isclose(first, second, rel_tol=_EXACT, abs_tol=_EXACT * 1e-3)
    if type(first) is not type(second):
        return False
    if isinstance(first, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if is_dataclass(first):
        return all(same(getattr(first, one.name), getattr(second, one.name)) for one in fields(first))
    return bool(first == second)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def exact_spec(law: TwistLaw) -> str:
    """A law's SPEC with as many digits as bring it back; `TwistLaw.spec` rounds to what people read."""
    match law:
        case LinearTwist(rate):
            return f"linear:{degrees(rate)}"
        case QuadraticTwist(curvature, difference):
            return f"quadratic:{degrees(curvature)},{degrees(difference)}"
        case PiecewiseLinearTwist(rates, breaks):
            return f"segments:{_listed(rates)}" + (f"@{','.join(map(_digits, breaks))}" if breaks else "")
        case SplineTwist(stations, angles):
            return f"spline:{_listed(angles)}@{','.join(map(_digits, stations))}"
        case IdealTwist(tip_pitch):
            return f"ideal:{degrees(tip_pitch)}"
        case SumTwist(base, change):
            return f"{exact_spec(base)}+{exact_spec(change)}"
        case _:
            return law.spec()


def degrees(angle: float) -> str:
    """The shortest number of degrees that is `angle` [rad] again; all digits where none is."""
    exact = math.degrees(angle)
    rounded = (round(exact, digits) for digits in range(15))
    return _digits(next((value for value in rounded if math.radians(value) == angle), exact) + 0.0)


def _listed(angles: tuple[float, ...]) -> str:
    return ",".join(map(degrees, angles))


def _digits(value: float) -> str:
    return repr(int(value)) if value == int(value) else repr(float(value))
