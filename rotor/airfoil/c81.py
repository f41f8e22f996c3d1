"""C81 airfoil decks: the fixed-column text tables of rotorcraft codes, strict reading and exact writing.

Card image: a title card (30 characters of name, then 6I2: number of Machs and of angles for cl, cd, cm);
then for each coefficient the Mach cards (seven blanks, then nine fields a card) and for each angle one
card of the angle and nine values, the rest on continuation cards that begin with seven blanks.
Every field has seven characters and may touch its neighbour, so the cards are cut by column.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rotor.arrays import Array

_FIELD = 7
_PER_CARD = 9
_NAMES = ("cl", "cd", "cm")


@dataclass(frozen=True, eq=False)
class C81Block:
    """One coefficient: `values` of shape (angles, Machs) over `alpha_deg` [deg] and `mach`, both increasing."""

    mach: Array
    alpha_deg: Array
    values: Array

    def __post_init__(self) -> None:
        assert self.values.shape == (self.alpha_deg.size, self.mach.size)


@dataclass(frozen=True, eq=False)
class C81Deck:
    """A section's deck; each coefficient has its own angles and Machs."""

    title: str
    cl: C81Block
    cd: C81Block
    cm: C81Block


class _Cards:
    """The cards of one file, taken in order, with error messages that give file and line."""

    def __init__(self, name: str, text: str) -> None:
        self.name = name
        self.lines = [line.rstrip() for line in text.splitlines()]
        self.at = 0

    def next_card(self) -> str:
        if self.at >= len(self.lines):
            raise ValueError(f"{self.name} ends after line {self.at}: a card is missing, compare the counts in line 1")
        self.at += 1
        return self.lines[self.at - 1]

    def fail(self, what: str) -> ValueError:
        return ValueError(f"{self.name}, line {self.at}: {what}")

    def number(self, text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            raise self.fail(f"{text!r} is not a number: fields are seven characters wide") from None
        if not np.isfinite(value):
            raise self.fail(f"{text!r} is not finite: give a number")
        return value

    def row(self, count: int, with_angle: bool) -> tuple[float, Array]:
        """`count` values on as many cards as they need, and the angle before them."""
        values: list[float] = []
        angle = 0.0
        first = True
        while len(values) < count:
            card = self.next_card()
            head, body = card[:_FIELD], card[_FIELD:]
            if first and with_angle:
                angle = self.number(head)
            elif head.strip():
                raise self.fail(f"{head!r} stands where a continuation card has blanks: check the counts in line 1")
            here = min(_PER_CARD, count - len(values))
            if len(body) > here * _FIELD:
                raise self.fail(f"more than {here} values: check the counts in line 1")
            values += [self.number(body[k * _FIELD : (k + 1) * _FIELD]) for k in range(here)]
            first = False
        return angle, np.array(values, dtype=np.float64)


def _block(cards: _Cards, name: str, machs: int, angles: int) -> C81Block:
    _, mach = cards.row(machs, with_angle=False)
    if np.any(np.diff(mach) <= 0.0):
        raise cards.fail(f"the Mach numbers of {name} do not increase: sort them")
    rows: list[Array] = []
    alpha: list[float] = []
    for _ in range(angles):
        angle, values = cards.row(machs, with_angle=True)
        if alpha and angle <= alpha[-1]:
            raise cards.fail(f"angle {angle:g} of {name} does not exceed the one before: sort the angles")
        if name == "cd" and np.any(values <= 0.0):
            raise cards.fail(f"a cd at {angle:g} deg is not positive: drag must be above zero")
        alpha.append(angle)
        rows.append(values)
    return C81Block(mach, np.array(alpha, dtype=np.float64), np.array(rows, dtype=np.float64))


def parse_c81(text: str, name: str = "deck") -> C81Deck:
    """The deck in `text`. Raises ValueError with one sentence that gives the line of `name` and the remedy."""
    cards = _Cards(name, text)
    head = cards.next_card().ljust(42)
    counts: list[int] = []
    for k in range(6):
        field = head[30 + 2 * k : 32 + 2 * k]
        if not field.strip().isdigit() or int(field) < 2:
            raise cards.fail(f"columns 31-42 are {head[30:42]!r}: give six two-digit counts (6I2) of at least 2")
        counts.append(int(field))
    blocks = [_block(cards, _NAMES[k], counts[2 * k], counts[2 * k + 1]) for k in range(3)]
    for rest in range(cards.at, len(cards.lines)):
        if cards.lines[rest].strip():
            cards.at = rest + 1
            raise cards.fail("text after the last card: check the counts in line 1")
    return C81Deck(head[:30].strip(), *blocks)


def read_c81(path: Path) -> C81Deck:
    """The deck in the file `path`."""
    return parse_c81(path.read_text(encoding="utf-8"), path.name)


def _field(value: float, decimals: int) -> str:
    """`value` in seven characters with `decimals` decimals, or as many as fit."""
    for fitting in range(decimals, -1, -1):
        text = f"{value:{_FIELD}.{fitting}f}"
        if len(text) == _FIELD:
            return text
    raise ValueError(f"{value:g} does not fit into a field of seven characters: C81 holds -99999 to 999999")


def _cards_of(head: str, values: Array, decimals: int) -> list[str]:
    texts = [_field(round(float(v), decimals) + 0.0, decimals) for v in values]  # + 0.0 turns -0.0 into 0.0.
    starts = range(0, len(texts), _PER_CARD)
    return [(head if s == 0 else " " * _FIELD) + "".join(texts[s : s + _PER_CARD]) for s in starts]


def format_c81(deck: C81Deck) -> str:
    """The deck as text: Mach with three decimals, angles two, cl and cm four, cd five, fewer where they do not fit."""
    blocks = (deck.cl, deck.cd, deck.cm)
    counts = [n for block in blocks for n in (block.mach.size, block.alpha_deg.size)]
    if max(counts) > 99 or len(deck.title) > 30:
        raise ValueError(
            f"C81 holds 99 angles and a title of 30 characters at most, not {max(counts)} and {deck.title!r}"
        )
    lines = [f"{deck.title:<30}" + "".join(f"{n:2d}" for n in counts)]
    for name, block in zip(_NAMES, blocks, strict=True):
        lines += _cards_of(" " * _FIELD, block.mach, 3)
        for angle, row in zip(block.alpha_deg, block.values, strict=True):
            lines += _cards_of(_field(float(angle), 2), row, 5 if name == "cd" else 4)
    return "\n".join(lines) + "\n"
