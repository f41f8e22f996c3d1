"""Which values of two runs differ."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

ABOUT = 60
"""Characters shown on each side of the first difference."""


@dataclass(frozen=True)
class Difference:
    """The values of one kind that are not equal in two runs, by name."""

    kind: str
    changed: Mapping[str, tuple[str, str]]
    """What was there, and what is here."""
    gone: Sequence[str]
    """Names that only the other run has."""
    new: Sequence[str]
    """Names that only this run has."""

    def __bool__(self) -> bool:
        return bool(self.changed or self.gone or self.new)

    def words(self, most: int = 40) -> str:
        """What differs, a name in a line, and of changed values the text about the first difference."""
        lines = [
            f"{self.kind}: {len(self.changed)} changed, {len(self.gone)} gone, {len(self.new)} new"
        ]
        for name, (there, here) in list(self.changed.items())[:most]:
            lines += [f"  {name}", *(f"    {line}" for line in first_difference(there, here))]
        lines += [f"  gone: {name}" for name in self.gone[:most]]
        lines += [f"  new: {name}" for name in self.new[:most]]
        if max(len(self.changed), len(self.gone), len(self.new)) > most:
            lines.append(f"  … of each kind the first {most}: the rest by diff")
        return "\n".join(lines)


def read(folder: Path, kind: str) -> dict[str, str]:
    """The values of a kind by name, as a run wrote them."""
    values = dict[str, str]()
    # Not by splitlines, which would also break at separators within a value.
    for line in (folder / f"{kind}.txt").read_text("utf-8").split("\n")[:-1]:
        name, _, text = line.partition(": ")
        values[name] = text
    return values


def difference(kind: str, there: Mapping[str, str], here: Mapping[str, str]) -> Difference:
    """What is not equal in two runs."""
    changed = {
        name: (there[name], here[name])
        for name in sorted(there.keys() & here.keys())
        if there[name] != here[name]
    }
    gone = sorted(there.keys() - here.keys())
    new = sorted(here.keys() - there.keys())
    return Difference(kind, changed, gone, new)


def first_difference(there: str, here: str) -> tuple[str, str]:
    """Excerpts of two texts about the first character that differs, as `- 902.⟦9 kW⟧` and `+ 902.⟦8 kW⟧`.

    The mark ⟦ stands before that character; ⟧ only ends the excerpt.
    """
    at = 0
    while at < min(len(there), len(here)) and there[at] == here[at]:
        at += 1
    return _excerpt("-", there, at), _excerpt("+", here, at)


def _excerpt(sign: str, text: str, at: int) -> str:
    """The text up to `ABOUT` characters on each side of a place, with the sign and the mark."""
    begin = max(0, at - ABOUT)
    before = ("…" if begin else "") + text[begin:at]
    after = text[at : at + ABOUT] + ("…" if len(text) > at + ABOUT else "")
    return f"{sign} {before}⟦{after}⟧"
