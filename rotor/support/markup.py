"""HTML and SVG as values: `tag("p.note", "a < b", id="one")` is `<p class="note" id="one">a &lt; b</p>`.

All text and every attribute is escaped here, so that no caller has to think of it, and no other file writes a tag.
"""

import re
from collections.abc import Iterable
from html import escape
from typing import TypeAlias

_ALONE = frozenset({"br", "circle", "hr", "image", "img", "input", "line", "link", "meta", "path", "polygon",
                    "polyline", "rect", "stop"})  # fmt: skip
"""Elements without content, which are closed where they open."""
_TITLE = re.compile("<title>[^<]*</title>")

Content: TypeAlias = "str | Iterable[Content] | None"
"""Text, markup, or several of them; None is nothing."""
Attribute: TypeAlias = str | float | bool | None
"""True: the name alone. None or False: left out. Numbers to the hundredth."""


class Markup(str):
    """Text that is markup already. Joined with `+`, other text is escaped."""

    __slots__ = ()

    def __add__(self, other: str, /) -> "Markup":
        return Markup(str.__add__(self, _written(other)))

    def __radd__(self, other: str, /) -> "Markup":
        return Markup(str.__add__(_written(other), self))


def tag(name: str, /, *content: Content, **attributes: Attribute) -> Markup:
    """An element; `name` may have classes, as in `div.rx.rx-dim`, to which `class_` adds others.

    Attributes are written with hyphens for underscores and without an underscore at the end, as `data_do` and `for_`.
    """
    name, *classes = name.split(".")
    if more := attributes.pop("class_", None):
        classes.append(str(more))
    named: dict[str, Attribute] = {"class": " ".join(classes) or None}
    named |= {key.rstrip("_").replace("_", "-"): value for key, value in attributes.items()}
    inside = group(*content)
    opened = f"<{name}{''.join(_attribute(key, value) for key, value in named.items())}"
    return Markup(f"{opened}/>" if name in _ALONE and not inside else f"{opened}>{inside}</{name}>")


def document(*content: Content, **attributes: Attribute) -> str:
    """A whole HTML file."""
    return f"<!doctype html>{tag('html', *content, **attributes)}\n"


def group(*content: Content) -> Markup:
    """Several parts one after another, without an element around them."""
    return Markup("".join(map(_written, content)))


def start_of(name: str) -> str:
    """How an element starts, to look for it in a page written elsewhere; attributes may follow."""
    return f"<{name}"


def end_of(name: str) -> str:
    """How an element ends, to look for it in a page written elsewhere."""
    return f"</{name}>"


def with_title(page: str, title: str, *before: Content) -> str:
    """A page written elsewhere under another title, with `before` in its head; ValueError for a page without one."""
    page, count = _TITLE.subn(lambda _: group(*before, tag("title", title)), page, count=1)
    if not count:
        raise ValueError("This page has no title that could be replaced.")
    return page


def _written(content: Content) -> str:
    if content is None:
        return ""
    if isinstance(content, Markup):
        return str(content)
    if isinstance(content, str):
        return escape(content, quote=False)
    return "".join(map(_written, content))


def _attribute(name: str, value: Attribute) -> str:
    if value is None or value is False:
        return ""
    if value is True:
        return f" {name}"
    text = (
        (str(value) if isinstance(value, str) else plain(value))
        .replace("&", "&amp;")
        .replace("<", "&lt;")
    )
    quote = "'" if '"' in text and "'" not in text else '"'  # JSON stays readable, and short.
    return f" {name}={quote}{text.replace(quote, '&quot;')}{quote}"


def plain(number: float, digits: int = 2) -> str:
    """A number as short as it can be to so many digits."""
    return (
        f"{round(number, digits) + 0.0:.{digits}f}".rstrip("0").rstrip(".")
        if digits
        else f"{number:.0f}"
    )
