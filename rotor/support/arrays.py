"""The array types of signatures, whose docstrings give the shapes; arrays that nobody may write to."""

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property, wraps
from typing import Any, ParamSpec, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Singles = NDArray[np.float32]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_P = ParamSpec("_P")
_T = TypeVar("_T")


def fix(value: Any) -> None:
    """Make an array read-only, and all arrays in a tuple, list, mapping or dataclass, which may be shared then."""
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    elif isinstance(value, (tuple, list)):
        for item in cast(tuple[Any, ...], value):
            fix(item)
    elif isinstance(value, Mapping):
        fix(tuple(cast(Mapping[Any, Any], value).values()))
    elif is_dataclass(value) and not isinstance(value, type):
        fix(tuple(vars(value).values()))


def read_only(function: Callable[_P, _T]) -> Callable[_P, _T]:
    """A function whose result is read-only: for what a cache or a cached property hands out."""

    @wraps(function)
    def fixed(*args: _P.args, **kwargs: _P.kwargs) -> _T:
        value = function(*args, **kwargs)
        fix(value)
        return value

    return fixed


class fixed_property(cached_property[_T]):
    """A cached property whose value is read-only."""

    def __init__(self, function: Callable[[Any], _T]) -> None:
        super().__init__(read_only(function))


class ShortRepr:
    """A dataclass that shows its arrays by their shapes."""

    def __repr__(self) -> str:
        values: list[tuple[str, Any]] = [
            (f.name, getattr(self, f.name)) for f in fields(cast(Any, self)) if f.repr
        ]
        shown = (
            f"{name} {value.shape}" if hasattr(value, "shape") else f"{name}={value!r}"
            for name, value in values
        )
        return f"{type(self).__name__}({', '.join(shown)})"
