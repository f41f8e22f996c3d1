"""The history of a session as text that the page keeps, so that a reload or a restart of the server restores it.

The designs are written as codes of the address. One that no address holds, of a rotor of one's own, is left out.
"""

import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from explorer.model.inputs import Inputs
from explorer.sharing.share import code_of, inputs_from

NAME = "steps"
"""Under which the page keeps it."""
LONGEST = 50
"""Most steps before the present that are kept, and most after it."""


@dataclass(frozen=True)
class StoredHistory:
    """Steps before and after the present, and designs that the user set aside; each oldest first."""

    past: tuple[Inputs, ...] = ()
    present: Inputs | None = None
    future: tuple[Inputs, ...] = ()
    bookmarks: tuple[Inputs, ...] = ()

    def text(self) -> str:
        """As the page keeps it."""
        past, future = _codes(self.past[-LONGEST:]), _codes(self.future[:LONGEST])
        present = None if self.present is None else _code(self.present)
        record = {"past": past, "present": present, "future": future, "bookmarks": _codes(self.bookmarks)}
        return json.dumps(record, separators=(",", ":"), ensure_ascii=False)


def read_history(text: str | None, start: Inputs) -> StoredHistory:
    """What the page kept, for a session that begins with `start`; what cannot be read is left out.

    `start` is another design than the last present one where a link was opened: that one is then a step before it.
    """
    try:
        record: Any = json.loads(text or "{}")
        past, future, bookmarks = (_inputs(record.get(name, [])) for name in ("past", "future", "bookmarks"))
        present = _inputs([record["present"]] if record.get("present") else [])
    except (ValueError, TypeError, AttributeError, RecursionError):
        return StoredHistory(present=start)
    same = [one for one in present if _code(one) == _code(start)]
    before, after = (past, future) if same or not present else ((*past, *present), ())
    return StoredHistory(before[-LONGEST:], start, after[:LONGEST], bookmarks)


@lru_cache(maxsize=1024)
def _code(inputs: Inputs) -> str | None:
    """The code of the design; None where the inputs mean none, or one that no address holds."""
    try:
        return code_of(inputs.design())
    except ValueError:
        return None


def _codes(steps: Iterable[Inputs]) -> list[str]:
    return [code for code in map(_code, steps) if code is not None]


def _inputs(codes: list[Any]) -> tuple[Inputs, ...]:
    found: list[Inputs] = []
    for code in codes[: 2 * LONGEST]:
        try:
            found.append(inputs_from(str(code), tell=lambda _: None))
        except ValueError:
            continue  # Of another version of the program, or changed in the page.
    return tuple(found)
