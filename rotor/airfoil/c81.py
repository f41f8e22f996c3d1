"""C81 airfoil decks: the fixed-column text tables of rotorcraft codes, reading and exact writing.

Card image: a title card (30 characters of name, then 6I2: number of Machs and of angles for cl, cd, cm);
then for each coefficient the Mach cards (seven blanks, then nine fields a card) and for each angle one
card of the angle and nine values, the rest on continuation cards that begin with seven blanks.
Every field has seven characters and may touch its neighbour, so the cards are cut by column. Decks of other widths
are read by their blanks. Lines above the title and words below the last card are left out, and a deck may have no c_m
(counts 0 0).
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rotor.airfoil.numbers import number_of
from rotor.airfoil.polars import one_row_per_angle
from rotor.support.arrays import Array

_FIELD = 7
_PER_CARD = 9
_NAMES = ("cl", "cd", "cm")
_PREAMBLE, _LONGEST_TITLE = 40, 200
"""Lines among which the title is looked for, and its characters."""


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
    """A section's deck; each coefficient has its own angles and Machs. `cm` is None where it has no moment."""

    title: str
    cl: C81Block
    cd: C81Block
    cm: C81Block | None

    @property
    def blocks(self) -> tuple[C81Block, ...]:
        return (self.cl, self.cd) if self.cm is None else (self.cl, self.cd, self.cm)


class _Cards:
    """The cards of one file, taken in order, with error messages that give file and line."""

    def __init__(self, name: str, text: str, by_blanks: bool = False) -> None:
        self.name = name
        self.lines = [line.rstrip() for line in text.splitlines()]
        self.at = 0
        self.title = 1
        """Line of the title."""
        self.by_blanks = by_blanks
        self.place = "its title"

    @property
    def remedy(self) -> str:
        return f"check the counts in line {self.title}"

    def next_card(self) -> str:
        if self.at >= len(self.lines):
            raise ValueError(
                f"{self.name} ends after line {self.at}, at {self.place}: {self.remedy}"
            )
        self.at += 1
        return self.lines[self.at - 1]

    def fail(self, what: str) -> ValueError:
        return ValueError(f"{self.name}, line {self.at}: {what}")

    def number(self, text: str) -> float:
        if (value := number_of(text)) is None:
            raise self.fail(
                f"{text!r} is not a number{'' if self.by_blanks else ': fields are seven characters wide'}"
            )
        return value

    def row(self, count: int, with_angle: bool) -> tuple[float, Array]:
        """`count` values on as many cards as they need, and the angle before them."""
        if self.by_blanks:
            words: list[str] = []
            while len(words) < count + with_angle:
                words += self.next_card().replace(",", " ").split()
            if len(words) > count + with_angle:
                raise self.fail(f"more than {count} values: {self.remedy}")
            numbers = [self.number(word) for word in words]
            return numbers[0], np.array(numbers[with_angle:], dtype=np.float64)
        values: list[float] = []
        angle = 0.0
        first = True
        while len(values) < count:
            card = self.next_card()
            head, body = card[:_FIELD], card[_FIELD:]
            if first and with_angle:
                angle = self.number(head)
            elif head.strip():
                raise self.fail(
                    f"{head!r} stands where a continuation card has blanks: {self.remedy}"
                )
            here = min(_PER_CARD, count - len(values))
            if len(body) > here * _FIELD:
                raise self.fail(f"more than {here} values: {self.remedy}")
            values += [self.number(body[k * _FIELD : (k + 1) * _FIELD]) for k in range(here)]
            first = False
        return angle, np.array(values, dtype=np.float64)


def _block(cards: _Cards, name: str, machs: int, angles: int) -> C81Block:
    cards.place = f"the Mach numbers of {name}"
    _, mach = cards.row(machs, with_angle=False)
    if np.any(np.diff(mach) <= 0.0):
        raise cards.fail(f"the Mach numbers of {name} do not increase: sort them")
    rows: list[tuple[float, ...]] = []
    for count in range(1, angles + 1):
        cards.place = f"angle {count} of {angles} of {name}"
        angle, values = cards.row(machs, with_angle=True)
        if name == "cd" and np.any(values <= 0.0):
            raise cards.fail(f"a cd at {angle:g} deg is not positive: drag must be above zero")
        rows.append((cards.at, angle, *values))
    table = np.array(one_row_per_angle(cards.name, rows), dtype=np.float64)
    return C81Block(mach, table[:, 1], table[:, 2:])


def _title(cards: _Cards) -> tuple[str, list[int]]:
    """The title and its six counts, in columns 31-42 or as the last six words; the cards go on below it."""
    for at, line in enumerate(cards.lines[:_PREAMBLE], start=1):
        if len(line) > _LONGEST_TITLE:
            continue
        fields = [line.ljust(42)[30 + 2 * k : 32 + 2 * k].strip() for k in range(6)]
        words = re.split(r"[\s,]+", line)
        title = line[:30]
        if not all(map(str.isdecimal, fields)):
            fields, title = words[-6:], " ".join(words[:-6])[:30]
        if len(fields) == 6 and all(map(str.isdecimal, fields)):
            counts = [int(field) for field in fields]
            if (
                min(counts[0], counts[2]) >= 1
                and min(counts[1], counts[3]) >= 2
                and max(counts) < 1000
            ):
                cards.at = cards.title = at
                return title.strip(), counts
    cards.at = 1
    first = cards.lines[0] if cards.lines else ""
    raise cards.fail(
        f"columns 31-42 are {first.ljust(42)[30:42]!r}, and no line below has the counts: "
        "end the title with six, of Mach numbers (1 or more) and angles (2 or more) of cl, cd and cm (or 0 0)"
    )


def _deck(cards: _Cards) -> C81Deck:
    title, counts = _title(cards)
    lift, drag = (_block(cards, _NAMES[k], counts[2 * k], counts[2 * k + 1]) for k in range(2))
    moment = _block(cards, "cm", counts[4], counts[5]) if counts[4] and counts[5] else None
    for rest in range(cards.at, len(cards.lines)):
        if re.match(r"\s*[+-]?\.?\d", cards.lines[rest]):  # Words below the last card are left out.
            cards.at = rest + 1
            raise cards.fail(f"numbers after the last card: {cards.remedy}")
    return C81Deck(title, lift, drag, moment)


def parse_c81(text: str, name: str = "deck") -> C81Deck:
    """The deck in `text`, by columns or else by blanks, with its angles in order; of rows alike at one angle the first.

    Raises ValueError with one sentence that gives the line of `name` and the remedy.
    """
    cards = _Cards(name, text)
    try:
        return _deck(cards)
    except ValueError as error:
        free = _Cards(name, text, by_blanks=True)
        try:
            return _deck(free)
        except ValueError as other:
            # A deck by columns is one whose first Mach card is.
            raise (error if cards.at > cards.title + 1 else other) from None


def read_c81(path: Path) -> C81Deck:
    """The deck in the file `path`."""
    return parse_c81(path.read_text(encoding="utf-8"), path.name)


def _field(value: float, decimals: int) -> str:
    """`value` in seven characters with `decimals` decimals, or as many as fit."""
    for fitting in range(decimals, -1, -1):
        text = f"{value:{_FIELD}.{fitting}f}"
        if len(text) == _FIELD:
            return text
    raise ValueError(
        f"{value:g} does not fit into a field of seven characters: C81 holds -99999 to 999999"
    )


def _cards_of(head: str, values: Array, decimals: int) -> list[str]:
    # + 0.0 turns -0.0 into 0.0.
    texts = [_field(round(float(v), decimals) + 0.0, decimals) for v in values]
    starts = range(0, len(texts), _PER_CARD)
    return [(head if s == 0 else " " * _FIELD) + "".join(texts[s : s + _PER_CARD]) for s in starts]


def format_c81(deck: C81Deck) -> str:
    """The deck as C81 text, with fewer decimals where they do not fit; ValueError for more than 99 angles."""
    counts = [n for block in deck.blocks for n in (block.mach.size, block.alpha_deg.size)]
    counts += [0] * (6 - len(counts))
    if max(counts) > 99 or len(deck.title) > 30:
        raise ValueError(
            f"C81 holds 99 angles and a title of 30 characters at most, not {max(counts)} and {deck.title!r}"
        )
    lines = [f"{deck.title:<30}" + "".join(f"{n:2d}" for n in counts)]
    for name, block in zip(_NAMES, deck.blocks, strict=False):
        lines += _cards_of(" " * _FIELD, block.mach, 3)
        for angle, row in zip(block.alpha_deg, block.values, strict=True):
            lines += _cards_of(_field(float(angle), 2), row, 5 if name == "cd" else 4)
    return "\n".join(lines) + "\n"
