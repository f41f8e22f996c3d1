"""The gate for everything that a page says: what is not known, finite, in range and short is dropped.

`message_fault` looks at each message of viser's, `checked_press` at what our scripts send through the bridge: a table
says which names there are, and what comes with each. What is dropped is told in the log, a few times a minute with the
number of those left out (`limits.RepeatFilter`).
"""

import json
import logging
import math
import re
from collections.abc import Callable, Mapping
from typing import Any

from rotor.user_input import brief

LONGEST_TEXT = 20_000
"""Characters of a text field."""
LONGEST_PRESS = 300
"""Characters of a press: name and value as JSON."""
LARGEST = 1e15
"""No number of a page is larger."""
_ITEMS, _DEPTH = 10_000, 6
_FREE = frozenset(("content", "payload", "value"))
"""Fields of other lengths: parts of a file, pictures, and what the browser kept, which have limits of their own."""
_log = logging.getLogger(__name__)

Check = Callable[[Any], Any]
"""The value as the action takes it; ValueError where it cannot."""


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < LARGEST


def message_fault(fields: Mapping[str, Any]) -> str:
    """What is wrong with the fields of a message; empty where nothing is."""
    for name, value in fields.items():
        if name not in _FREE and not _is_plain(value, _DEPTH):
            return f"{name} is {brief(repr(value)[:200])}"
    return ""


def dropped(what: str) -> None:
    """Tell that something was dropped."""
    _log.warning("dropped from a page: %s", what)


def _is_plain(value: Any, depth: int) -> bool:
    if isinstance(value, (dict, list, tuple)):
        parts = [*value, *value.values()] if isinstance(value, dict) else value
        return depth > 0 and len(parts) <= _ITEMS and all(_is_plain(part, depth - 1) for part in parts)
    if isinstance(value, (str, bytes)):
        return len(value) <= LONGEST_TEXT
    return value is None or isinstance(value, bool) or is_number(value)


def _nothing(value: Any) -> None:
    """A press, whose name says it all: it has no value."""


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ValueError("neither true nor false")
    return value


def _number(low: float, high: float) -> Check:
    def check(value: Any) -> float:
        size: Any = value
        if isinstance(value, str) and re.fullmatch("[0-9.]{1,8}", value):  # A button has it as text.
            size = float(value)
        if not is_number(size) or not low <= size <= high:
            raise ValueError(f"no number between {low:g} and {high:g}")
        return float(size)

    return check


def _count(value: Any) -> int:
    """A place in a list; a button has it as text."""
    count: Any = value
    if isinstance(value, str):
        count = int(value) if re.fullmatch("[0-9]{1,6}", value) else -1
    if not is_number(count) or count != math.floor(count) or not 0 <= count < 1e6:
        raise ValueError("no place in a list")
    return int(count)


def _text(value: Any) -> str:
    if not isinstance(value, str) or len(value) > 100:
        raise ValueError("no short text")
    return value


def _word(*words: str) -> Check:
    def check(value: Any) -> str:
        if value not in words:
            raise ValueError(f"none of {', '.join(words)}")
        return str(value)

    return check


def _row(*checks: Check) -> Check:
    def check(value: Any) -> list[Any]:
        if not isinstance(value, list) or len(value) != len(checks):
            raise ValueError(f"not {len(checks)} values")
        return [check(part) for check, part in zip(checks, value, strict=True)]

    return check


def _some(check: Check, most: int) -> Check:
    def each(value: Any) -> list[Any]:
        if not isinstance(value, list) or not 0 < len(value) <= most:
            raise ValueError(f"not 1 to {most} values")
        return [check(part) for part in value]

    return each


def _either(*checks: Check) -> Check:
    def check(value: Any) -> Any:
        reasons: list[str] = []
        for check in checks:
            try:
                return check(value)
            except ValueError as error:
                reasons.append(str(error))
        raise ValueError("; ".join(reasons))

    return check


def _none(value: Any) -> None:
    if value is not None:
        raise ValueError("not empty")


_radius, _hand = _number(0.0, 1.0), _word("start", "end")
PRESSES: dict[str, Check] = {
    **dict.fromkeys(
        ("pin", "swap", "back", "undo", "redo", "times", "pace", "play", "against", "apply", "discard",
         "halt", "land", "nearest"),
        _nothing,
    ),
    **dict.fromkeys(("along", "hold"), _flag),
    **dict.fromkeys(("field", "region", "mode", "drawer", "task", "opened", "rotor", "flown"), _text),
    **dict.fromkeys(("story", "guess", "stop", "dial_front"), _count),
    **dict.fromkeys(("grab_at", "twist_by_hand"), _radius),
    "ride": _either(_word("off"), _row(_radius, _number(-3600.0, 3600.0)), _nothing),
    "azimuth": _number(-3600.0, 3600.0),
    "fly": _number(0.0, 100.0),
    "speed": _number(0.0, 1.0),
    "wiped": _number(-1.0, 2.0),
    "covered": _row(_number(-10.0, 10.0), _number(-10.0, 10.0)),
    "difference": _word("on", "off"),
    "landscape": _word("on"),
    "view": _word("actuator", "3d", "disk", "blade", "top", "side"),
    "colours": _word("Rescale", "Default"),
    "lecture": _word("back", "next", "end"),
    "idle": _row(_count, _flag),
    "knot": _row(_text, _either(_hand, _row(_either(_none, _number(-2.0, 2.0)), _number(-360.0, 360.0)))),
    "dial": _either(_hand, _some(_row(_count, _number(0.0, 90.0), _number(-3600.0, 3600.0)), 9)),
}  # fmt: skip
"""Every press of the page's scripts, and what its value must be."""


def checked_press(text: Any) -> tuple[str, Any] | None:
    """Name and value of a press; None, and a line in the log, for what no page of ours sends."""
    try:
        if not isinstance(text, str) or len(text) > LONGEST_PRESS:
            raise ValueError("it is too long")
        serial, name, value = json.loads(text)
        if not is_number(serial) or not isinstance(name, str) or name not in PRESSES:
            raise ValueError("no such press")
        return name, PRESSES[name](value)
    except (ValueError, TypeError, RecursionError) as error:
        dropped(f"press {brief(repr(text)[:80])}: {error}")
        return None
