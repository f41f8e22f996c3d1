"""The array types of signatures, whose docstrings give the shapes; arrays that nobody may write to."""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import fields, is_dataclass
from functools import cached_property, wraps
from threading import Lock
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


def size_of(value: Any) -> int:
    """Bytes of an array, or of all arrays in a tuple, list or dataclass."""
    if isinstance(value, np.ndarray):
        return value.nbytes
    if isinstance(value, (tuple, list)):
        return sum(map(size_of, cast(tuple[Any, ...], value)))
    return size_of(tuple(vars(value).values())) if is_dataclass(value) and not isinstance(value, type) else 0


def bytes_cache(most: int) -> Callable[[Callable[_P, _T]], Callable[_P, _T]]:
    """A decorator like `lru_cache` for large results: it keeps so many bytes of arrays, and one result at least."""

    def keep_results(function: Callable[_P, _T]) -> Callable[_P, _T]:
        known, lock = OrderedDict[Hashable, _T](), Lock()

        @wraps(function)
        def cached(*args: _P.args, **kwargs: _P.kwargs) -> _T:
            key = args, tuple(kwargs.items())
            with lock:
                if key in known:
                    known.move_to_end(key)
                    return known[key]
            value = function(*args, **kwargs)
            with lock:
                known[key] = value
                size = sum(map(size_of, known.values()))
                while size > most and len(known) > 1:
                    size -= size_of(known.popitem(last=False)[1])
            return value

        cached.__dict__["cache_clear"] = known.clear
        return cached

    return keep_results


class fixed_property(cached_property[_T]):
    """A cached property whose value is read-only."""

    def __init__(self, function: Callable[[Any], _T]) -> None:
        super().__init__(read_only(function))


class ShortRepr:
    """A dataclass that shows its arrays by their shapes."""

    def __repr__(self) -> str:
        values: list[tuple[str, Any]] = [(f.name, getattr(self, f.name)) for f in fields(cast(Any, self)) if f.repr]
        shown = (f"{name} {value.shape}" if hasattr(value, "shape") else f"{name}={value!r}" for name, value in values)
        return f"{type(self).__name__}({', '.join(shown)})"
