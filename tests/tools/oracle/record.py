"""Values by name: what a tree answered, each as one line in which every bit shows."""

import dataclasses
import hashlib
import importlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from enum import Enum
from typing import Any

import msgspec
import numpy as np

from .masks import MASK, MASKED_KEYS, masked

SHORT = 12
"""Numbers of an array up to which they are written; of a longer one its digest is."""
FLAT = 3
"""Levels of fields and keys that have a line each; what lies deeper stands in one line."""


class Absent(Exception):
    """A name that the tree does not have."""


def named(path: str) -> Any:
    """What a tree has under a dotted path, such as `rotor.trim.solve.analyse`.

    `new.path|old.path` takes the first that exists: so a script asks two trees for what was renamed. `Absent` where the
    tree has none of them.
    """
    for one in path.split("|"):
        parts = one.split(".")
        for count in range(len(parts), 0, -1):
            module = ".".join(parts[:count])
            try:
                found: Any = importlib.import_module(module)
            except ModuleNotFoundError as error:
                # Another module that is missing is a fault of the tree, not a name that it lacks.
                if error.name is None or not module.startswith(error.name):
                    raise
                continue
            try:
                for name in parts[count:]:
                    found = getattr(found, name)
            except AttributeError:
                break
            return found
    raise Absent(path)


Function = str | Callable[..., Any]
"""A function, or its dotted path as of `named`."""


class Record:
    """The values of one kind, by name. A failure is a value, too, so that no scenario keeps another from its answer."""

    def __init__(self, folders: Sequence[str] = ()) -> None:
        """`folders`: whose paths are taken out of every text."""
        self.values: dict[str, str] = {}
        self._folders = tuple(folders)

    def ask(self, name: str, function: Function, *arguments: Any, **options: Any) -> Any:
        """What a function returns, which is kept under the name; None where it fails."""
        return self._try(name, lambda: _callable(function)(*arguments, **options), kept=True)

    def make(self, name: str, function: Function, *arguments: Any, **options: Any) -> Any:
        """What a function returns, which is not kept, for further questions; None where it fails.

        Why it fails is kept.
        """
        return self._try(name, lambda: _callable(function)(*arguments, **options), kept=False)

    def scenario(self, name: str, write: Callable[..., None], *arguments: Any) -> None:
        """Have a scenario write its values; where it fails half way, those after it are kept all the same."""
        self.make(f"{name}/whole", write, self, *arguments)

    def ask_attribute(self, name: str, thing: Any, attribute: str) -> Any:
        """An attribute of an object, which is kept under the name; None where it fails."""

        def read() -> Any:
            if not hasattr(type(thing), attribute) and attribute not in getattr(
                thing, "__dict__", {}
            ):
                raise Absent(f"{type(thing).__name__}.{attribute}")
            return getattr(thing, attribute)

        return self._try(name, read, kept=True)

    def keep(self, name: str, value: Any) -> None:
        """Keep a value, in as many lines as it has fields."""
        for line, text in flattened(name, value):
            self._add(line, text)

    def lines(self) -> list[str]:
        """All values, sorted by name."""
        return [f"{name}: {text}" for name, text in sorted(self.values.items())]

    def _add(self, line: str, text: str) -> None:
        if line in self.values:
            raise ValueError(f"{line!r} is kept twice: give each value a name of its own")
        if ": " in line:
            raise ValueError(f"{line!r} has a colon, which ends a name")
        self.values[line] = masked(text, self._folders)

    def _try(self, name: str, question: Callable[[], Any], *, kept: bool) -> Any:
        """What the question answers; where it fails, None, and the line says so as no value does."""
        try:
            answer = question()
        except Absent as absent:
            self._add(name, f"absent from this tree: {absent}")
            return None
        except (Exception, SystemExit) as error:
            sentence = json.dumps(str(error), ensure_ascii=False)
            self._add(name, f"failed: {type(error).__name__} {sentence}")
            return None
        if kept:
            self.keep(name, answer)
        return answer


def _callable(function: Function) -> Callable[..., Any]:
    return named(function) if isinstance(function, str) else function


def flattened(name: str, value: Any, depth: int = FLAT) -> Iterator[tuple[str, str]]:
    """Lines of a value: one for each field or key, down to a depth."""
    fields = _fields(value)
    if fields is None or depth == 0:
        yield name, exact(value)
        return
    if not fields:
        yield name, "{}"
    for key, one in fields.items():
        text = str(key).replace(": ", " ")
        if key in MASKED_KEYS:
            yield f"{name}/{text}", MASK
        else:
            yield from flattened(f"{name}/{text}", one, depth - 1)


def exact(value: Any) -> str:
    """The value in one line, from which no other value has the same."""
    if isinstance(value, np.ndarray):
        return _array(value)
    if isinstance(value, bytes | bytearray | memoryview):
        return _bytes(bytes(value))
    return json.dumps(_plain(value), ensure_ascii=False)


def _bytes(data: bytes) -> str:
    """Length and digest of a file's bytes; of text the digest alone, without what differs from run to run."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        return f"{len(data)} bytes {_digest(data)}"
    return f"text {_digest(masked(text).encode('utf-8'))}"


def _plain(value: Any) -> Any:
    """What JSON can hold of a value; Python writes floats with all digits that tell them apart."""
    if value is None or isinstance(value, bool | int | float | str):
        # Of a subclass, as markup, the text itself.
        return str(value) if isinstance(value, str) else value
    if isinstance(value, Enum):
        return value.name
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, np.ndarray | bytes | bytearray | memoryview):
        return exact(value)
    fields = _fields(value)
    if fields is not None:
        return {
            str(key): MASK if key in MASKED_KEYS else _plain(one) for key, one in fields.items()
        }
    if isinstance(value, Set):
        return sorted((_plain(one) for one in value), key=str)
    if isinstance(value, Sequence):
        return [_plain(one) for one in value]
    if callable(value):
        return f"function {getattr(value, '__qualname__', type(value).__name__)}"
    return repr(value)


def _fields(value: Any) -> Mapping[Any, Any] | None:
    """Public fields of a record or items of a mapping; None for other values."""
    if isinstance(value, Mapping):
        return value
    if isinstance(value, type):
        return None
    if dataclasses.is_dataclass(value):
        names = [one.name for one in dataclasses.fields(value)]
    elif isinstance(value, msgspec.Struct):
        names = list(value.__struct_fields__)
    else:
        return None
    return {name: getattr(value, name) for name in names if not name.startswith("_")}


def _array(value: np.ndarray) -> str:
    """Type, shape and every bit of an array: its numbers where they are few, else a digest with least and largest."""
    kind = f"{value.dtype}{list(value.shape)}"
    if value.size <= SHORT:
        return f"{kind} {json.dumps(_plain(value.tolist()))}"
    if value.dtype == object:
        return f"{kind} {json.dumps(_plain(value.tolist()), ensure_ascii=False)}"
    digest = _digest(np.ascontiguousarray(value).tobytes())
    if value.dtype.kind not in "fiub":
        return f"{kind} {digest}"
    numbers = value[np.isfinite(value)]
    ends = f"from {numbers.min()} to {numbers.max()}" if numbers.size else "without a number"
    return f"{kind} {digest} {ends}"


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:32]
