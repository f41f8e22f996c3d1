"""What is shown, as a short text for the page's address, and back: `1;field=mach;stall=off`.

Version, and only what differs from how a page begins. Where the reference blade stands and whether the page is dark are
left out: the one turns while one looks, the other is every reader's own.
"""

import unicodedata
from collections.abc import Iterable
from dataclasses import fields, replace
from typing import Any

from explorer.model.inputs import TWIST_SHOWN, ViewState
from explorer.model.units import UNITS
from explorer.picture.fields import FIELDS
from explorer.sharing.share import cut

VERSION = 1
VIEW = "v"
"""Name of the view in the address."""

_PLAIN = ViewState()
_NAMES = tuple(item.name for item in fields(ViewState) if item.name not in ("azimuth_deg", "dark"))
_SWITCHED = {"on": True, "off": False}


def _by_word(titles: Iterable[str]) -> dict[str, str]:
    """Titles by their first word, or by two where it is another's, in small letters that every keyboard has."""
    named: dict[str, str] = {}
    for title in titles:
        words = unicodedata.normalize("NFKD", title).lower().split()
        named["-".join(words[:2]) if words[0] in named else words[0]] = title
    return named


_CHOICES = {"field": _by_word(FIELDS), "units": _by_word(UNITS)}
_WORDS = {name: {title: word for word, title in choices.items()} for name, choices in _CHOICES.items()}


def view_code(view: ViewState) -> str | None:
    """The view as a text; None for one that shows what every page begins with."""
    words = [f"{name}={_word(name, value)}" for name in _NAMES if (value := getattr(view, name)) != _default(name)]
    return ";".join((str(VERSION), *words)) if words else None


def view_from(code: str) -> ViewState:
    """The view a text means; ValueError with one sentence for one that means none."""
    version, *words = code.strip().split(";")
    if version != str(VERSION):
        raise ValueError(f"The view in the address, {cut(code)!r}, is not of version {VERSION}: ask for a new link.")
    view = _PLAIN
    for word in words:
        name, _, value = word.partition("=")
        if name not in _NAMES:
            raise ValueError(f"The view in the address holds {cut(word)!r}: choose {', '.join(_NAMES)}.")
        view = replace(view, **{name: _value(name, value)})
    return view


def _default(name: str) -> Any:
    return getattr(_PLAIN, name)


def _word(name: str, value: Any) -> str:
    if name in _CHOICES:
        return _WORDS[name][value]
    return f"{value:g}" if isinstance(value, float) else "on" if value else "off"


def _value(name: str, word: str) -> Any:
    if isinstance(_default(name), float):
        return _number(name, word)
    choices: dict[str, Any] = _CHOICES.get(name, _SWITCHED)
    if word not in choices:
        raise ValueError(f"The view in the address has {name}={cut(word)!r}: choose {', '.join(choices)}.")
    return choices[word]


def _number(name: str, word: str) -> float:
    low, high = TWIST_SHOWN
    try:
        value = float(word)
    except ValueError:
        value = float("nan")
    if not low <= value <= high:
        raise ValueError(f"The view in the address has {name}={cut(word)!r}: give a number from {low:g} to {high:g}.")
    return value
