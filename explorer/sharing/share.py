"""What the page writes into its address and keeps in the browser, as text: designs, views and steps.

A design holds the record of a design file, `1;segments:-14,-8@0.5;mu=0.25;mass=9000`: version, twist, and what differs
from the preset's own design. A plus sign is written `~`, as in `1;uh60a~segments:-2,1@0.5`: viser's client writes the
query of the address anew without its escapes, after which a plus sign reads as a space.

Of a rotor of one's own it holds the whole design file, compressed: `1;file=…`.

A view, `1;field=mach;stall=off`, holds what differs from how a page begins, but for azimuth and dark page. Steps to
undo are kept as codes of designs; those of a rotor of one's own, which are long, are left out.

The server keeps the query of the address, in which several parts of the page have a name: `Address`.
"""

import base64
import json
import math
import threading
import time
import unicodedata
import zlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar
from urllib.parse import parse_qsl, quote

from explorer.model.inputs import LAWS, OWN, TWIST_SHOWN, TWISTS, Inputs, ViewState, inputs_of
from explorer.model.sliders import SLIDERS, limits, slider
from explorer.model.units import SI, UNITS
from explorer.picture.fields import FIELDS
from rotor import Design, make_design
from rotor.design.aircraft import Aircraft
from rotor.design.quantities import BY_KEY
from rotor.files.design_file import design_from_record, parse_design
from rotor.support.bytes_cache import bytes_cache
from rotor.support.user_input import refusing

VERSION = 1
DESIGN = "d"
"""Name of the design in the address."""
PINNED = "a"
"""Name of the design that is pinned beside it."""
CARRIED = "actuator"
"""Name of the actuator on board in the address."""
HOURS = "h"
"""Name of the mission's hours in the address."""
AGAINST = "against"
"""Name of the blade that changes of an actuator count from in the address."""
LONGEST = 1800
"""Most characters of a design: every browser and mail program accepts an address of this length."""
LONGEST_OWN = 8000
"""Most characters of a design with a rotor of one's own. Our choice: web servers commonly take lines of 8 kB."""
MOST_BYTES = 1_000_000
"""A design file may have; written ones have a thousand."""
_FILE = "file="

MOST_ELEMENTS = 48
"""Most blade elements of a design on the page, which shares its server with others."""
MOST_AZIMUTHS = 240
MOST_LINE_AZIMUTHS = 48
"""Most azimuths of a lifting line, whose work grows with the square of its points and more."""

KEPT = "own"
"""Stands for a design that does not fit into an address: the page keeps its file, also over a reload."""

_PLUS = "~"
"""Stands for a plus sign."""

_SHORT = {key: row.word for key, row in BY_KEY.items() if row.word}
_LONG = {short: key for key, short in _SHORT.items()}
_LEFT_OUT = ("format", "version", "twist")
STEPS_KEPT = "steps"
MOST_STEPS = 50
"""Most steps before the present that are kept, and most after it."""
VIEW = "v"
"""Name of the view in the address."""

_RETIRED = {
    "follow": "a page no longer follows another",
    "present": "a page no longer leads others",
}
"""Names that links of earlier versions have, and why nothing reads them now."""

_PLAIN_VIEW = ViewState()
_NAMES = tuple(item.name for item in fields(ViewState) if item.name not in ("azimuth_deg", "dark"))
_SWITCHED = {"on": True, "off": False}

_READABLE = ":;,@/="
"""Characters that are not escaped in the query, so that a design in it can be read."""
_PAUSE = 0.4
"""[s] between two changes of the address: browsers refuse a hundred in half a minute."""

_Part = TypeVar("_Part")


def code_of(design: Design) -> str:
    """The design as text; ValueError with one sentence for one that does not fit into an address."""
    record = design.to_dict()
    if design.aircraft.files is not None:
        content = zlib.compress(json.dumps(record, separators=(",", ":")).encode(), 9)
        code = f"{VERSION};{_FILE}{base64.urlsafe_b64encode(content).decode().rstrip('=')}"
        if len(code) > LONGEST_OWN:
            raise ValueError(
                f"A link with your rotor has {len(code):,} characters, and mail and servers take {LONGEST_OWN:,}: save "
                "the design as a file and send the file."
            )
        return code
    usual = _usual(record["preset"], design.aircraft)
    changed = {
        key: value
        for key, value in record.items()
        if key not in _LEFT_OUT and value != usual.get(key)
    }
    words = [
        str(VERSION),
        record["twist"],
        *(f"{_SHORT.get(key, key)}={_word(v)}" for key, v in changed.items()),
    ]
    code = ";".join(words).replace("+", _PLUS)
    if len(code) > LONGEST:
        raise ValueError("This design is too long for a link: save it as a file and send the file.")
    return code


@bytes_cache
def _usual(preset: str, aircraft: Aircraft) -> Mapping[str, Any]:
    """What a text need not say."""
    plain = make_design()
    usual = make_design(preset=preset, rotor=aircraft).to_dict()
    return usual | {"preset": plain.preset, "rotor": plain.aircraft.key}


@refusing("The design in the address", "ask for a new link")
def design_from(code: str) -> Design:
    """The design of a text; ValueError with one sentence for an invalid one."""
    version, _, rest = code.strip().partition(";")
    if version != str(VERSION) or not rest:
        raise ValueError(
            f"The design in the address, {clipped(code)!r}, is not version {VERSION}: ask for a new link."
        )
    own, most = rest.startswith(_FILE), LONGEST_OWN if rest.startswith(_FILE) else LONGEST
    if len(code) > most:
        raise ValueError(
            f"The design in the address has {len(code)} characters; at most {most} are allowed."
        )
    if own:
        return parse_design(_unpacked(rest.removeprefix(_FILE)), "of this link")
    twist, *words = rest.replace(_PLUS, "+").split(";")
    if "table:" in twist:  # An address must not make the server open a file.
        raise ValueError(
            f"The twist {clipped(twist)!r} is a file on the sender's machine: ask for the design file."
        )
    record: dict[str, Any] = {"twist": twist}
    for word in words:
        key, equals, value = word.partition("=")
        if not equals:
            raise ValueError(
                f"The design in the address holds {clipped(word)!r}, not of the form key=value: ask for a new link."
            )
        record[_LONG.get(key, key)] = _value(value)
    try:
        return design_from_record(record)
    except ValueError as error:
        raise ValueError(f"The design in the address cannot be used: {error}") from None


def _unpacked(text: str) -> bytes:
    """The design file of a code; ValueError for one that is damaged, or larger than a design file."""
    try:
        unpack = zlib.decompressobj()
        content = unpack.decompress(
            base64.b64decode(text + "=" * (-len(text) % 4), b"-_", True), MOST_BYTES
        )
    except (ValueError, zlib.error):
        raise ValueError(
            "The link is damaged or cut off: ask for it again, or for the design file."
        ) from None
    if not unpack.eof or unpack.unused_data:
        raise ValueError("The link is damaged, cut off or too large: ask for the design file.")
    return content


@refusing("The design in the address", "ask for a new link")
def inputs_from(code: str, kept: str | None = None) -> Inputs:
    """The slider positions of a text; ValueError also for a position outside a slider's range.

    `kept`: the design file that the page has where the text is `KEPT`.
    """
    if code == KEPT and kept is None:
        raise ValueError(
            "Its rotor is the sender's own and too large for a link: ask for the design file, and load it in Files."
        )
    record = kept if code == KEPT else None
    return within(
        inputs_of(parse_design(record.encode(), "of this page") if record else design_from(code))
    )


def within(inputs: Inputs) -> Inputs:
    """The inputs, where the page's sliders can hold them; else ValueError with one sentence.

    A twist beyond its sliders is kept as it is, as one from a file.
    """
    _check_grid(inputs)
    if any(not _holds(name, inputs) for name in LAWS[inputs.law].inputs):
        plain = {name: row.default for name, row in TWISTS.items()}
        inputs = replace(inputs, law="given", given=inputs.design().twist, **plain)
    for name in SLIDERS:
        if not _holds(name, inputs):
            form = slider(name, SI, inputs.aircraft)
            raise ValueError(
                f"{form.label} is {getattr(inputs, name):g}, outside this page's {form.low:g}…{form.high:g}: "
                "bring it inside."
            )
    return inputs


def _check_grid(inputs: Inputs) -> None:
    elements, azimuths = inputs.elements or 0, inputs.azimuths or 0
    most = MOST_LINE_AZIMUTHS if inputs.inflow == "lifting-line" else MOST_AZIMUTHS
    if elements > MOST_ELEMENTS or azimuths > most:
        raise ValueError(
            f"The design asks for {elements or 'the usual'} blade elements and {azimuths or 'the usual'} azimuths, but "
            f"this page computes with at most {MOST_ELEMENTS} and {most}: solve it with `python -m rotor solve`."
        )


def _holds(name: str, inputs: Inputs) -> bool:
    low, high = limits(name, inputs.aircraft)
    return low - 1e-9 <= getattr(inputs, name) <= high + 1e-9


def _word(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.10g}"
    return (
        value
        if isinstance(value, str)
        else json.dumps(value, separators=(",", ":"), ensure_ascii=False)
    )


def _value(word: str) -> object:
    try:
        return json.loads(word)
    except ValueError:  # Also an integer of thousands of digits.
        return word


def clipped(text: str) -> str:
    """A text of the address, shortened for a sentence."""
    return text if len(text) <= 40 else text[:39] + "…"


@dataclass(frozen=True)
class StoredHistory:
    """Steps before and after the present, and designs that the user set aside; each oldest first."""

    past: tuple[Inputs, ...] = ()
    present: Inputs | None = None
    future: tuple[Inputs, ...] = ()
    bookmarks: tuple[Inputs, ...] = ()

    def text(self) -> str:
        past, future = _codes(self.past[-MOST_STEPS:]), _codes(self.future[:MOST_STEPS])
        present = None if self.present is None else _code(self.present)
        record = {
            "past": past,
            "present": present,
            "future": future,
            "bookmarks": _codes(self.bookmarks),
        }
        return json.dumps(record, separators=(",", ":"), ensure_ascii=False)


def read_history(text: str | None, start: Inputs) -> StoredHistory:
    """What the page kept, for a session that begins with `start`; what cannot be read is left out.

    `start` is another design than the last present one where a link was opened: that one is then a step before it.
    """
    try:
        record: Any = json.loads(text or "{}")
        past, future, bookmarks = (
            _inputs(record.get(name, [])) for name in ("past", "future", "bookmarks")
        )
        present = _inputs([record["present"]] if record.get("present") else [])
    except (ValueError, TypeError, AttributeError, RecursionError):
        return StoredHistory(present=start)
    same = [inputs for inputs in present if _code(inputs) == _code(start)]
    before, after = (past, future) if same or not present else ((*past, *present), ())
    return StoredHistory(before[-MOST_STEPS:], start, after[:MOST_STEPS], bookmarks)


@bytes_cache
def _code(inputs: Inputs) -> str | None:
    """The code of the design; None where the inputs mean none, or one of a rotor of one's own."""
    if inputs.rotor == OWN:
        return None
    try:
        return code_of(inputs.design())
    except ValueError:
        return None


def _codes(steps: Iterable[Inputs]) -> list[str]:
    return [code for code in map(_code, steps) if code is not None]


def _inputs(codes: list[Any]) -> tuple[Inputs, ...]:
    steps: list[Inputs] = []
    for code in codes[: 2 * MOST_STEPS]:
        try:
            steps.append(inputs_from(str(code)))
        except ValueError:
            continue  # Of another version of the program, or changed in the page.
    return tuple(steps)


def _by_word(titles: Iterable[str]) -> dict[str, str]:
    """Titles by their first word, or by two where it is another's, in small letters that every keyboard has."""
    named: dict[str, str] = {}
    for title in titles:
        words = unicodedata.normalize("NFKD", title).lower().split()
        named["-".join(words[:2]) if words[0] in named else words[0]] = title
    return named


_CHOICES = {"field": _by_word(FIELDS), "units": _by_word(UNITS)}
_WORDS = {
    name: {title: word for word, title in choices.items()} for name, choices in _CHOICES.items()
}


def view_code(view: ViewState) -> str | None:
    """The view as a text; None for one that shows what every page begins with."""
    shown = ((name, getattr(view, name)) for name in _NAMES)
    words = [
        f"{name}={_view_word(name, value)}"
        for name, value in shown
        if value != getattr(_PLAIN_VIEW, name)
    ]
    return ";".join((str(VERSION), *words)) if words else None


def view_from(code: str) -> ViewState:
    """The view a text means; ValueError with one sentence for one that means none."""
    version, *words = code.strip().split(";")
    if version != str(VERSION):
        raise ValueError(
            f"The view in the address, {clipped(code)!r}, is not version {VERSION}: ask for a new link."
        )
    view = _PLAIN_VIEW
    for word in words:
        name, _, value = word.partition("=")
        if name not in _NAMES:
            raise ValueError(
                f"The view in the address holds {clipped(word)!r}: choose {', '.join(_NAMES)}."
            )
        view = replace(view, **{name: _view_value(name, value)})
    return view


def _view_word(name: str, value: Any) -> str:
    if name in _CHOICES:
        return _WORDS[name][value]
    return f"{value:g}" if isinstance(value, float) else "on" if value else "off"


def _view_value(name: str, word: str) -> Any:
    if isinstance(getattr(_PLAIN_VIEW, name), float):
        return _number(name, word)
    choices: dict[str, Any] = _CHOICES.get(name, _SWITCHED)
    if word not in choices:
        raise ValueError(
            f"The view in the address has {name}={clipped(word)!r}: choose {', '.join(choices)}."
        )
    return choices[word]


def _number(name: str, word: str) -> float:
    low, high = TWIST_SHOWN
    try:
        value = float(word)
    except ValueError:
        value = float("nan")
    if not low <= value <= high:
        raise ValueError(
            f"The view in the address has {name}={clipped(word)!r}: give a number from {low:g} to {high:g}."
        )
    return value


def parameter(query: str, name: str) -> str | None:
    """The value of a name; None where it is not there."""
    return dict(parse_qsl(query.lstrip("?"), keep_blank_values=True)).get(name)


def with_parameter(query: str, name: str, value: str | None) -> str:
    """The query with a name set, at its end; None removes it. Everything else stays."""
    pairs = [
        pair for pair in parse_qsl(query.lstrip("?"), keep_blank_values=True) if pair[0] != name
    ]
    if value is not None:
        pairs.append((name, value))
    return "?" + "&".join(
        f"{quote(key, _READABLE)}={quote(text, _READABLE)}" for key, text in pairs
    )


class Address:
    """The address of one page; safe from any thread."""

    def __init__(
        self, query: str | None, write: Callable[[str], None], pause: float = _PAUSE
    ) -> None:
        """`query`: that of the opened page; None, not known, is never written over. `write` puts another into the
        address, at least `pause` [s] apart."""
        self.query, self._pause = query or "", pause
        """As it is or is about to be written."""
        self._write = write if query is not None else lambda query: None
        self._lock = threading.Lock()
        self._written = -math.inf
        self._waiting: threading.Timer | None = None
        self._unread: dict[str, list[str | None]] = {}
        """Names whose value could not be read, with what the page opened with instead, once that is known."""
        self.problems: list[tuple[str, str]] = []
        """A title and a sentence for each value that could not be read, or that nothing reads."""

    def __getitem__(self, name: str) -> str | None:
        return parameter(self.query, name)

    def read(self, name: str, meaning: Callable[[str], _Part], usual: _Part, title: str) -> _Part:
        """The meaning of a name's value; `usual` where there is none or a bad one, a problem under `title`.

        A bad value stays in the address until the page shows something else than it opened with: whoever wrote it can
        mend it there.
        """
        value = self[name]
        if value is None:
            return usual
        try:
            with refusing(f"What the address holds as {name!r}", "ask for a new link"):
                return meaning(value)
        except ValueError as error:
            self.problems.append((title, str(error)))
            self._unread[name] = []
            return usual

    def drop_retired(self) -> None:
        """Remove the names that only earlier versions read; each is a problem."""
        for name, reason in _RETIRED.items():
            if self[name] is not None:
                sentence = f"{name!r} was left out: {reason}."
                self.problems.append((f"Link: {name} not used", sentence))
                self[name] = None

    def __setitem__(self, name: str, value: str | None) -> None:
        with self._lock:
            if (opened := self._unread.get(name)) is not None:
                if not opened:
                    opened.append(value)
                if opened == [value]:
                    return
                del self._unread[name]
            if value == parameter(self.query, name):
                return
            self.query = with_parameter(self.query, name, value)
            wait = self._pause - (time.monotonic() - self._written)
            if self._waiting is not None:
                return  # The waiting write will take the newest value.
            if wait > 0.0:
                self._waiting = threading.Timer(wait, self._put)
                self._waiting.daemon = True
                self._waiting.start()
                return
        self._put()

    def write_over(self) -> None:
        """What could not be read need not stay any longer."""
        with self._lock:
            self._unread.clear()

    def stop(self) -> None:
        with self._lock:
            if self._waiting is not None:
                self._waiting.cancel()

    def _put(self) -> None:
        with self._lock:
            self._waiting, self._written = None, time.monotonic()
            self._write(self.query)
