"""Files read as they are declared: msgspec structs and types with bounds, and one sentence for what is wrong.

msgspec says where a value is wrong; the sentence has the value, and the remedy from what is declared there. For a value
neither msgspec nor tomllib gives the line: it is found by looking for the key.
"""

import re
import threading
import tomllib
from collections.abc import Generator
from contextlib import contextmanager
from typing import Annotated, Any, TypeVar, cast

import msgspec
from msgspec import Meta, inspect

from rotor.design.quantity import Kind
from rotor.support.units import unit_of
from rotor.support.user_input import did_you_mean, shorten

Place = tuple[str | int, ...]
"""Keys, and positions in lists, that lead to a value."""
Declared = TypeVar("Declared")

Text = Annotated[str, Meta(min_length=1)]
"""Without a pattern: msgspec 0.22 ends the process at a list or a text of a pattern, or at a number or a list of fixed
length."""
Share = Annotated[float, Meta(ge=0.0, le=1.0)]
Number = Annotated[float, Meta(ge=-1e12, le=1e12)]
"""No quantity is larger, and a number without bounds may be NaN or infinite."""
Whole = Annotated[int, Meta(ge=-(10**12), le=10**12)]
BY_KIND: dict[Kind, Any] = {
    "number": Number,
    "whole": Whole,
    "text": str,
    "choice": str,
    "switch": bool,
}
"""What a file gives for each kind of quantity."""


class FileTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A table of a file: its keys with their types, bounds and defaults. Another key is an error."""


class Refusal(ValueError):
    """What is wrong at a place of a file, in one sentence; from `__post_init__` the place is that in the table."""

    def __init__(self, sentence: str, *place: str | int) -> None:
        super().__init__(sentence)
        self.place = place


_one_at_a_time = threading.Lock()
"""msgspec 0.22 ends the process where several threads use a type for the first time."""


def convert(value: Any, declared: type[Declared], *place: str) -> Declared:
    """The value at a place of a file as it is declared. Raises Refusal."""
    try:
        with _one_at_a_time:
            return msgspec.convert(value, declared)
    except msgspec.ValidationError as error:
        found, cause = re.search(r" - at `\$([\w.\[\]]+)`$", str(error)), error.__cause__
    except UnicodeEncodeError as error:
        raise Refusal(
            f"{shorten(repr(error.object))} holds half of a character: write it whole"
        ) from None
    at: Place = place
    options = _options(inspect.type_info(declared))
    for key, position in re.findall(r"\.(\w+)|\[(\d+)\]", found[1] if found else ""):
        part = key or int(position)
        at, value = (*at, part), value[part]
        options = [each for option in options for each in _below(option, part)]
    if isinstance(cause, Refusal):
        raise Refusal(str(cause), *at, *cause.place)
    raise _refusal(at, value, options)


def _options(declared: inspect.Type) -> list[inspect.Type]:
    """The types of which a value may have any."""
    types = declared.types if isinstance(declared, inspect.UnionType) else (declared,)
    return [each for each in types if not isinstance(each, inspect.NoneType)]


def _below(declared: inspect.Type, part: str | int) -> list[inspect.Type]:
    """The types that a key of a table, or a value of a list, may have."""
    match declared:
        case inspect.StructType(fields=fields):
            return [
                each
                for field in fields
                if field.encode_name == part
                for each in _options(field.type)
            ]
        case inspect.VarTupleType(item_type=item):
            return _options(item)
        case inspect.TupleType(item_types=items):
            return _options(items[int(part)])
        case _:
            return []


def _refusal(place: Place, value: Any, options: list[inspect.Type]) -> Refusal:
    """Why a value is none of its options."""
    for each in options:
        match each, value:
            case inspect.StructType(), dict():
                return _wrong_key(place, cast("dict[str, Any]", value), each)
            case inspect.VarTupleType(), []:
                return Refusal(f"{_key(place)[0]} has no values: give at least one", *place)
            case inspect.LiteralType(values=choices), _ if (
                isinstance(value, str) or len(options) == 1
            ):
                names = [str(choice) for choice in choices]
                hint = (isinstance(value, str) and did_you_mean(value, names)) or ":"
                return Refusal(
                    f"{_entry(place, repr(value))}{hint} use {' or '.join(names)}", *place
                )
            case (inspect.IntType(ge=low, le=high), int()) | (
                inspect.FloatType(ge=low, le=high),
                int() | float(),
            ):
                if not isinstance(value, bool):
                    return _out_of_bounds(place, value, low, high)
            case _:
                pass
    wanted, examples = zip(*(_WORDS[type(each)] for each in options), strict=True)
    return Refusal(
        f"{_entry(place, repr(value))}, not {' or '.join(wanted)}: write for example {examples[0]}",
        *place,
    )


def _wrong_key(place: Place, table: dict[str, Any], declared: inspect.StructType) -> Refusal:
    """The first key that is not known, or not there."""
    known = {field.encode_name: field for field in declared.fields}
    for key in table:
        if key not in known:
            hint = did_you_mean(key, known) or f": the keys are {', '.join(known)}"
            return Refusal(f"unknown key {shorten(key)!r}{hint}", *place, key)
    missing = next(key for key, field in known.items() if field.required and key not in table)
    where = ".".join(part for part in place if isinstance(part, str))
    example = _WORDS[type(_options(known[missing].type)[0])][1]
    return Refusal(
        f"{f'[{where}]' if where else 'the file'} has no {missing}: add {missing} = {example}",
        *place,
    )


_WORDS: dict[type[inspect.Type], tuple[str, str]] = {
    inspect.IntType: ("a whole number", "3"),
    inspect.FloatType: ("a number", "1.0"),
    inspect.StrType: ("a text", '"name"'),
    inspect.LiteralType: ("a text", '"…"'),
    inspect.BoolType: ("true or false", "true"),
    inspect.VarTupleType: ("a list", "[…]"),
    inspect.TupleType: ("a list of numbers", "[0.2, 1.0]"),
    inspect.StructType: ("a table", "{ … }"),
    inspect.DictType: ("a table", "{ … }"),
}
"""What is declared in words, and an example."""


def _key(place: Place) -> tuple[str, str]:
    """The last key of a place, and the verb between it and a value."""
    key = next((part for part in reversed(place) if isinstance(part, str)), "the file")
    return key, "holds" if place and isinstance(place[-1], int) else "is"


def _entry(place: Place, value: str) -> str:
    return f"{' '.join(_key(place))} {shorten(value)}"


def check_bounds(value: float, low: float, high: float, *place: str | int, given: str) -> None:
    """Refusal for a number outside bounds that follow from another key, `given` with its value: either may be wrong.
    The unit is the end of its key's name."""
    if not low <= value <= high:
        raise _out_of_bounds(place, value, low, high, f" with {given}: check values and units")


def _out_of_bounds(
    place: Place,
    value: float,
    low: float | None,
    high: float | None,
    remedy: str = ": check value and unit",
) -> Refusal:
    bounds = f"{low:g}…{high:g} {unit_of(_key(place)[0])}".rstrip()
    number = f"{value:g}" if isinstance(value, float) else str(value)
    return Refusal(f"{_entry(place, number)}, outside {bounds}{remedy}", *place)


def one_of(table: FileTable, *keys: str) -> str:
    """The key that a table has; Refusal unless it is exactly one of these."""
    given = [key for key in keys if getattr(table, key) is not None]
    if len(given) > 1:
        raise Refusal(
            f"{given[0]} and {given[1]} give the same quantity: keep one of them", given[1]
        )
    if not given:
        raise Refusal(
            f"there is no {' or '.join(keys)}: add {'one of them' if len(keys) > 1 else 'it'}"
        )
    return given[0]


@contextmanager
def naming(file: str, text: str) -> Generator[None]:
    """Turn a Refusal of the block into ValueError with the file, and the line that its place has in the text."""
    try:
        yield
    except Refusal as error:
        line = find_line(text, error.place)
        raise ValueError(f"{file}{f', line {line}' if line else ''}: {error}") from None


def read_toml(file: str, text: str) -> dict[str, Any]:
    """The values of a TOML file; ValueError with line and remedy for text that is not TOML."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        what = str(error)
        match = re.search(r" \(at (?:line (\d+), column \d+|end of document)\)$", what)
        line = match[1] if match else None
        reason = what[: match.start()] if match else what
        place = f", line {line}" if line else ", at its end" if match else ""
        slashes = ", / in paths" if line and "\\" in text.split("\n")[int(line) - 1] else ""
        raise ValueError(
            f"{file}{place}: this is not TOML ({reason}): write key = value, texts in quotes{slashes}"
        ) from None
    except RecursionError:
        raise ValueError(
            f"{file}: this is not a file of this program (too many brackets): write key = value"
        ) from None
    except ValueError:
        raise ValueError(f"{file}: an integer has thousands of digits: check the values") from None


def find_line(text: str, place: Place) -> int | None:
    """The line of a place: where its key is set, else where the nearest table around it begins, or None.

    The keys of an inline table stand below the header of the table around it.
    """
    names = tuple(part for part in place if isinstance(part, str))
    index = next((part for part in reversed(place) if isinstance(part, int)), 0)
    path, key = names[:-1], names[-1] if names else None
    header: tuple[str, ...] = ()
    keys: list[int] = []
    tables: list[int] = []
    for number, line in enumerate(text.splitlines(), start=1):
        bare = line.partition("#")[0].strip()
        # A pattern was slow on a long line without one.
        if bare.startswith("[") and bare.endswith("]"):
            header = tuple(part.strip().strip("\"'") for part in bare.strip("[] \t").split("."))
            if header == path:
                tables.append(number)
            elif key is not None and header == names:
                keys.append(number)
        elif key is not None and header in (path, path[:-1]):
            keys += [number] * len(re.findall(rf"(?:^|[{{,.\s]){re.escape(key)}\s*=", bare))
        if path and header == path[:-1] and re.match(rf"{re.escape(path[-1])}\s*=", bare):
            tables.append(number)
    places = keys or tables
    if not places:
        return find_line(text, names[:-1]) if names else None
    return places[min(index, len(places) - 1)]
