"""One number of bytes for all caches of this process: what was used longest ago goes first, whichever cache has it.

A result counts with its arguments: their arrays and long texts, those that several results hold once, and an estimate
for all other objects. Results grow where they have cached properties, so each is measured again after its 2nd, 8th,
32nd, … use.
"""

import gc
from collections import Counter, OrderedDict
from collections.abc import Callable, Generator, Hashable
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache, wraps
from threading import RLock
from types import FunctionType, ModuleType
from typing import Any, ParamSpec, TypeVar, cast

import numpy as np
from numba.core.dispatcher import Dispatcher
from numpy.typing import NDArray

_P = ParamSpec("_P")
_T = TypeVar("_T")

CACHE_BYTES = 256 * 2**20
"""By default: room for tables of the five shipped rotors, and for a lifting line in tens of conditions."""
LEAST = 64 * 2**20
"""[bytes]; with less, tables would be made anew in each trim."""
_LONG_TEXT = 1000
"""Characters of a text from which it is counted by itself."""
_OBJECT_BYTES = 64
"""[bytes] of any other object, an estimate."""
_MEASURED = frozenset((1, *(2 * 4**k for k in range(16))))
_NUMBERS = frozenset((float, int, bool, complex, type(None)))


@lru_cache(maxsize=1024)
def _is_code(kind: type) -> bool:
    """Whether objects of a type belong to the program. Dispatchers are known by an abstract class: slowly."""
    return issubclass(kind, (type, FunctionType, ModuleType, Dispatcher))


@dataclass(eq=False)
class _Result:
    cache: "dict[Hashable, _Result]"
    key: Hashable
    value: Any
    uses: int = 0
    buffers: dict[int, tuple[Any, int]] = field(default_factory=dict[int, tuple[Any, int]])
    """Arrays, each the owner of its memory, and long texts, with their bytes, by identity."""
    rest: int = 0
    """[bytes] of all else."""

    def measure(self) -> None:
        seen, left = set[int](), list[Any]([self.key, self.value])
        self.rest = 0
        while left:
            one = left.pop()
            if id(one) in seen or _is_code(one.__class__):
                continue
            seen.add(id(one))
            if isinstance(one, np.ndarray):
                owner = cast(NDArray[Any], one)
                while isinstance(owner.base, np.ndarray):
                    owner = owner.base
                self.buffers[id(owner)] = owner, owner.nbytes
            elif isinstance(one, (str, bytes)) and len(one) >= _LONG_TEXT:
                self.buffers[id(one)] = one, len(one)
            else:
                parts = gc.get_referents(one)
                self.rest += _OBJECT_BYTES * (1 + len(parts))
                left += [part for part in parts if type(part) not in _NUMBERS]


class _Kept:
    """The results of all caches, the last used last."""

    def __init__(self) -> None:
        self.lock = RLock()
        self.limit, self.bytes = CACHE_BYTES, 0
        self.caches = list[dict[Hashable, _Result]]()
        self._results = OrderedDict[_Result, None]()
        self._holders = Counter[int]()
        """How many results hold a buffer."""

    @contextmanager
    def whole(self) -> Generator[None]:
        """What is changed within is changed whole. Ctrl-C may come at any place: then all is forgotten."""
        with self.lock:
            try:
                yield
            except BaseException:
                for known in self.caches:
                    known.clear()
                self._results.clear()
                self._holders.clear()
                self.bytes = 0
                raise

    def use(self, result: _Result) -> None:
        """It is new, or used once more."""
        with self.whole():
            if result.uses and result not in self._results:
                return  # Another thread has just dropped it.
            self._results[result] = None
            self._results.move_to_end(result)
            result.uses += 1
            if result.uses in _MEASURED:
                self._count(result, -1)
                result.measure()
                self._count(result, 1)
                self.fit()

    def drop(self, result: _Result) -> None:
        """Within `whole`."""
        result.cache.pop(result.key, None)
        if result in self._results:
            del self._results[result]
            self._count(result, -1)

    def fit(self) -> None:
        """Drop what was used longest ago, but never the last: two calls in turn would make it anew each time."""
        while self.bytes > self.limit and len(self._results) > 1:
            self.drop(next(iter(self._results)))

    def _count(self, result: _Result, sign: int) -> None:
        self.bytes += sign * result.rest
        for place, (_, size) in result.buffers.items():
            others = self._holders[place] if sign > 0 else self._holders[place] - 1
            self.bytes += 0 if others else sign * size
            self._holders[place] += sign
            if not self._holders[place]:
                del self._holders[place]


_kept = _Kept()


def bytes_kept() -> int:
    """Bytes of all results that are kept."""
    return _kept.bytes


def limit_caches(size: int) -> None:
    """Let all caches of this process keep so many bytes together; ValueError below `LEAST`."""
    if size < LEAST:
        raise ValueError(
            f"{size / 2**20:.4g} MB is too little for caches: give at least {LEAST // 2**20} MB"
        )
    with _kept.whole():
        _kept.limit = size
        _kept.fit()


def bytes_cache(function: Callable[_P, _T]) -> Callable[_P, _T]:
    """A decorator like `lru_cache`, for functions whose results or arguments hold arrays. Safe from any thread."""
    known = dict[Hashable, _Result]()
    _kept.caches.append(known)

    @wraps(function)
    def cached(*args: _P.args, **kwargs: _P.kwargs) -> _T:
        key = args, tuple(kwargs.items())
        result = known.get(key)
        if result is None:
            made = _Result(known, key, function(*args, **kwargs))
            with _kept.lock:
                # Another thread was faster: all share its result.
                result = known.setdefault(key, made)
                _kept.use(result)
        else:
            _kept.use(result)
        return result.value

    def clear() -> None:
        with _kept.whole():
            for result in list(known.values()):
                _kept.drop(result)

    cached.__dict__["cache_clear"] = clear
    return cached
