"""A short text that is the same for equal values, to match a results file with what it was computed from."""

import hashlib
from dataclasses import fields, is_dataclass
from typing import Any, cast


def fingerprint(value: object) -> str:
    """16 hexadecimal digits of SHA-256 over every field of a value made of dataclasses, tuples, lists and numbers."""
    return hashlib.sha256(_text(value).encode()).hexdigest()[:16]


def _text(value: Any) -> str:
    """The value with every field of every dataclass: their own `repr` may be shorter."""
    if is_dataclass(value) and not isinstance(value, type):
        inside = ", ".join(f"{field.name}={_text(getattr(value, field.name))}" for field in fields(value) if field.repr)
        return f"{type(value).__qualname__}({inside})"
    if type(value) is tuple:
        items = [_text(item) for item in cast(tuple[Any, ...], value)]
        return f"({items[0]},)" if len(items) == 1 else f"({', '.join(items)})"
    if type(value) is list:
        return f"[{', '.join(_text(item) for item in cast(list[Any], value))}]"
    return repr(value)
