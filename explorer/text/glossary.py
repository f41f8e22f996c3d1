"""One sentence for every control and every read-out, with its equation or its section of docs/theory.md.

The sentences are in `glossary.toml`; those of the quantities of a design come from their table.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from explorer.model.inputs import TWISTS
from rotor.design.quantities import BY_INPUT


@dataclass(frozen=True)
class Term:
    sentence: str
    equations: tuple[str, ...] = ()
    """Equations of the source document, as numbered in docs/theory.md."""
    section: int = 0
    """Section of docs/theory.md, where there is no equation; 0: neither, the entry is about the page."""

    @property
    def text(self) -> str:
        if self.equations:
            name = "Eq." if len(self.equations) == 1 else "Eqs."
            return (
                f"{self.sentence} {name} {', '.join(f'({number})' for number in self.equations)}."
            )
        return f"{self.sentence} Theory, section {self.section}." if self.section else self.sentence


def _terms(entries: Mapping[str, str]) -> dict[str, Term]:
    """By name; names with one sentence stand together, and its source follows a bar."""
    terms: dict[str, Term] = {}
    for names, text in entries.items():
        sentence, _, source = text.partition(" | ")
        section = int(source.removeprefix("section ")) if source.startswith("section ") else 0
        equations = tuple(source.split(", ")) if source and not section else ()
        terms |= dict.fromkeys(names.split(), Term(sentence, equations, section))
    return terms


_FILE = tomllib.loads((Path(__file__).parent / "glossary.toml").read_text(encoding="utf-8"))
_QUANTITIES = {name: row.tooltip for name, row in {**BY_INPUT, **TWISTS}.items()}
CONTROLS: dict[str, Term] = _terms(_QUANTITIES) | _terms(_FILE["controls"])
"""By the field of `Inputs` or `ViewState`, or a name of the widget's own."""
READOUTS: dict[str, Term] = _terms(_FILE["readouts"])
SECTIONS: dict[str, str] = _FILE["sections"]
COLUMNS: dict[str, str] = _FILE["columns"]
MEASURED: dict[str, tuple[str, str]] = _FILE["measured"]
"""Symbol and meaning."""


def hint(name: str) -> str:
    """What a control says when it is pointed at; KeyError for one without an entry."""
    return CONTROLS[name].text


def tip(name: str) -> str:
    """What a read-out says when it is pointed at; KeyError for one without an entry."""
    return READOUTS[name].text
