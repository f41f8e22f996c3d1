"""One table of a TOML file, read key by key, with messages that name file, line, value and remedy.

tomllib gives line numbers for broken syntax only; for a bad value the line is found by looking for its key.
Own code, because msgspec 0.22 reports neither line, value, unit nor more than one bound: with a translation of its
messages, and one type per table, the rotor and section files took as many lines (about 580) and lost the units.
"""

import difflib
import math
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, cast

REQUIRED: Any = object()
"""Default of a key that must be there."""


@dataclass
class TomlTable:
    """The values of a table, and the keys read so far: `finish` rejects all others."""

    file: str
    text: str
    path: tuple[str, ...]
    values: dict[str, Any]
    index: int = 0
    """Position in a list of tables."""
    used: set[str] = field(default_factory=set[str])

    def fail(self, key: str | None, what: str) -> ValueError:
        """The error to raise: file and line, then a sentence with key, value and remedy."""
        line = find_line(self.text, self.path, key, self.index)
        return ValueError(f"{self.file}{f', line {line}' if line else ''}: {what}")

    def has(self, key: str) -> bool:
        return key in self.values

    def number(
        self, key: str, default: Any = REQUIRED, *, low: float = -math.inf, high: float = math.inf, unit: str = ""
    ) -> Any:
        """A number within low…high, or the default where the key is missing."""
        value = self._take(key, default, f"add {key} = …{f'  # {unit}' if unit else ''}")
        return value if value is default else self._real(key, value, "is", f"{max(low, 1.0):g}", low, high, unit)

    def count(self, key: str, default: Any = REQUIRED, *, low: int, high: int) -> Any:
        """A whole number within low…high."""
        value = self._take(key, default, f"add {key} = {low}")
        if value is default:
            return value
        if isinstance(value, bool) or not isinstance(value, int):
            raise self.fail(key, f"{key} is {value!r}, not a whole number: write for example {key} = {low}")
        self._real(key, value, "is", "", low, high)
        return value

    def numbers(self, key: str, default: Any = REQUIRED, *, low: float = -math.inf, high: float = math.inf) -> Any:
        """A list of numbers within low…high, as a tuple; one number is read as a list of one."""
        value = self._take(key, default, f"add {key} = […]")
        if value is default:
            return value
        items = cast(list[Any], value if isinstance(value, list) else [value])
        return tuple(self._real(key, item, "holds", "[0.2, 1.0]", low, high) for item in items)

    def string(self, key: str, default: Any = REQUIRED, *, choices: Sequence[str] = ()) -> Any:
        """A text, one of `choices` where they are given."""
        value = self._take(key, default, f'add {key} = "…"')
        if value is default:
            return value
        if not isinstance(value, str) or not value.strip():
            raise self.fail(key, f'{key} is {value!r}, not a text: write for example {key} = "{(*choices, "name")[0]}"')
        if choices and value not in choices:
            raise self.fail(key, f"{key} is {value!r}: use {' or '.join(choices)}{_near(value, choices)}")
        return value

    def strings(self, key: str, default: Any = REQUIRED) -> Any:
        """A list of texts as a tuple, of one at least where it must be there; one text is read as a list of one."""
        value = self._take(key, default, f'add {key} = ["…"]')
        if value is default or (value == [] and default is not REQUIRED):
            return default
        items = cast(list[Any], value if isinstance(value, list) else [value])
        if not items or not all(isinstance(item, str) and item for item in items):
            raise self.fail(
                key, f'{key} is {value!r}, not a list of texts: write for example {key} = ["a.txt", "b.txt"]'
            )
        return tuple(cast(list[str], items))

    def table(self, key: str, default: Any = REQUIRED) -> Any:
        """The table [… .key]."""
        value = self._take(key, default, f"add the table [{'.'.join((*self.path, key))}]")
        if value is default:
            return value
        if not isinstance(value, dict):
            raise self.fail(key, f"{key} is {value!r}, not a table: begin it with [{'.'.join((*self.path, key))}]")
        return TomlTable(self.file, self.text, (*self.path, key), cast(dict[str, Any], value))

    def tables(self, key: str, example: str) -> list["TomlTable"]:
        """A list of tables, written inline or as [[… .key]]."""
        value = self._take(key, REQUIRED, f"add {key} = [{example}]")
        items = cast(list[Any], value if isinstance(value, list) else [value])
        if not items or not all(isinstance(item, dict) for item in items):
            raise self.fail(key, f"{key} is not a list of tables: write {key} = [{example}]")
        path = (*self.path, key)
        return [TomlTable(self.file, self.text, path, cast(dict[str, Any], item), k) for k, item in enumerate(items)]

    def finish(self) -> None:
        """Reject keys that were not read: a misspelt key must not be ignored."""
        for key in self.values:
            if key not in self.used:
                known = sorted(self.used)
                remedy = _near(key, known) or f": the keys are {', '.join(known)}"
                raise self.fail(key, f"unknown key {key!r}{remedy}")

    def _take(self, key: str, default: Any, remedy: str) -> Any:
        self.used.add(key)
        if key in self.values:
            return self.values[key]
        if default is REQUIRED:
            where = f"[{'.'.join(self.path)}]" if self.path else "the file"
            raise self.fail(None, f"{where} has no {key}: {remedy}")
        return default

    def _real(self, key: str, value: Any, says: str, example: str, low: float, high: float, unit: str = "") -> float:
        """The number as a float within low…high."""
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.fail(key, f"{key} {says} {value!r}, not a number: write for example {key} = {example}")
        try:
            value = float(value)
        except OverflowError:  # TOML allows integers of any length.
            value = math.inf
        if not (math.isfinite(value) and low <= value <= high):
            bounds = f"{low:g}…{high:g}" if math.isfinite(high) else f"{low:g} or more"
            raise self.fail(
                key, f"{key} is {value:g}, outside {bounds}{f' {unit}' if unit else ''}: check value and unit"
            )
        return value


def read_toml(file: str, text: str) -> TomlTable:
    """The file's top table; ValueError with line and remedy for text that is not TOML."""
    try:
        return TomlTable(file, text, (), tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        what = str(error)
        match = re.search(r" \(at (?:line (\d+), column \d+|end of document)\)$", what)
        line = match[1] if match else None
        reason = what[: match.start()] if match else what
        place = f", line {line}" if line else ", at its end" if match else ""
        raise ValueError(f"{file}{place}: this is not TOML ({reason}): write key = value, texts in quotes") from None
    except RecursionError:
        raise ValueError(f"{file}: this is not a file of this program (too many brackets): write key = value") from None
    except ValueError:
        raise ValueError(f"{file}: an integer has thousands of digits: check the values") from None


def find_line(text: str, path: tuple[str, ...], key: str | None, index: int = 0) -> int | None:
    """The line that sets `key` in the table `path`, the `index`-th of that name; else the line of the table, or None.

    The keys of an inline table stand below the header of the table around it.
    """
    header: tuple[str, ...] = ()
    keys: list[int] = []
    tables: list[int] = []
    for number, line in enumerate(text.splitlines(), start=1):
        bare = line.partition("#")[0].strip()
        if bare.startswith("[") and bare.endswith("]"):  # No pattern: on a long line that is none it took minutes.
            header = tuple(part.strip().strip("\"'") for part in bare.strip("[] \t").split("."))
            if header == path:
                tables.append(number)
            elif key is not None and header == (*path, key):
                keys.append(number)
        elif key is not None and header in (path, path[:-1]):
            keys += [number] * len(re.findall(rf"(?:^|[{{,.\s]){re.escape(key)}\s*=", bare))
        if path and header == path[:-1] and re.match(rf"{re.escape(path[-1])}\s*=", bare):
            tables.append(number)
    places = keys or tables
    return places[min(index, len(places) - 1)] if places else None


def _near(word: str, words: Sequence[str]) -> str:
    close = difflib.get_close_matches(word, words, n=1, cutoff=0.5)
    return f": did you mean {close[0]}?" if close else ""
