"""A study file as sections and keys, each of which knows its line."""

import re
import tomllib
from typing import Any, cast

SECTIONS: dict[str, tuple[str, ...]] = {
    "": ("title", "chunk"),
    "axes": (),
    "fixed": (),
    "models": (),
    "sample": ("method", "count", "seed"),
    "optimum": ("starts", "seed", "objective", "rate_deg", "stalled_percent"),
    "show": ("least", "uncertain"),
}
"""Sections and their keys; empty: names of quantities."""


class Document:
    """A parsed study file. ValueError, with a sentence that names the line, for a key that no study has."""

    def __init__(self, text: str, name: str) -> None:
        self._lines, self._name = text.splitlines(), name
        try:
            self._content = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            raise ValueError(f"study file {name!r} is no TOML ({error}): mend that line") from None
        for key, value in self._content.items():
            if key not in SECTIONS[""] and key not in SECTIONS:
                names = ", ".join([*SECTIONS[""], *(f"[{name}]" for name in SECTIONS if name)])
                raise self.wrong("", key, f"{key!r} is not known there: a study file has {names}")
            if key in SECTIONS and not isinstance(value, dict):
                raise self.wrong("", key, f"{key} is no section: write [{key}] on a line, and its keys beneath")
        for section, keys in SECTIONS.items():
            for key in self.section(section) if keys and section else ():
                if key not in keys:
                    raise self.wrong(section, key, f"{key!r} is not known in [{section}]: it has {', '.join(keys)}")

    def section(self, name: str) -> dict[str, Any]:
        """The keys of a section; those above all sections by the name ''."""
        return self._content if not name else cast(dict[str, Any], self._content.get(name, {}))

    def has(self, section: str) -> bool:
        return section in self._content

    def wrong(self, section: str, key: str, sentence: str) -> ValueError:
        """The error that says a sentence about a key, with its line."""
        line = self._line(section, key)
        return ValueError(f"study file {self._name!r}{f' line {line}' if line else ''}: {sentence}")

    def _line(self, section: str, key: str) -> int | None:
        """Where a key stands, or its section, written as [section], [section.key], section.key = or section = {…}."""
        here, found = "", None
        for number, line in enumerate(self._lines, start=1):
            heading = re.match(r"\s*\[+\s*([\w-]+)\s*(?:\.\s*([\w-]+)\s*)?\]", line)
            if heading:
                here = heading[1]
                if heading[2] and (here, heading[2]) == (section, key):
                    return number
                if here == (section or key) and not heading[2]:
                    found = number
            elif here == section and key and re.match(rf"\s*[\"']?{re.escape(key)}[\"']?\s*[.=]", line):
                return number
            elif here == "" and section and (dotted := re.match(rf"\s*{section}\s*(?:\.\s*([\w-]+)\s*)?[.=]", line)):
                if dotted[1] == key:
                    return number
                found = number
        return found
