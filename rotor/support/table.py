"""Tables of the commands: rows as text, as CSV and as records for JSON."""

from collections.abc import Iterable
from dataclasses import dataclass

from rotor.support.terminal import wrapped
from rotor.support.user_input import csv_text, write_whole

CellValue = str | float | None
"""A text or a number; None where there is no value."""


@dataclass(frozen=True)
class TableColumn:
    """One column, of all three forms or of some."""

    key: str
    """Name in CSV and JSON; empty: the column is in the text alone."""
    head: str = ""
    """Heading in text; empty with a key: the column is not there."""
    shown: str = ""
    """Format of numbers in text; < for words, which stand at the left."""
    stored: str = ""
    """Format of numbers in CSV; JSON has them as they are."""

    @property
    def in_text(self) -> bool:
        """Whether the text has it."""
        return bool(self.head) or not self.key


@dataclass(frozen=True)
class Table:
    """Rows with a cell for each column; `table` makes it."""

    columns: tuple[TableColumn, ...]
    rows: tuple[tuple[CellValue, ...], ...]

    def text(self) -> str:
        """Aligned columns below their headings; words at the end that are too long for the terminal go on below."""
        columns = [(k, column) for k, column in enumerate(self.columns) if column.in_text]
        cells = [[column.head, *(_formatted(row[k], column.shown) for row in self.rows)] for k, column in columns]
        sides = [str.ljust if column.shown == "<" else str.rjust for _, column in columns]
        widths = [max(map(len, texts)) for texts in cells]
        lines: list[str] = []
        for texts in zip(*cells, strict=True):
            aligned = (side(text, width) for side, text, width in zip(sides, texts, widths, strict=True))
            line = "  ".join(aligned).rstrip()
            lines.append(wrapped(line, "    ") if texts[-1] and columns[-1][1].shown == "<" else line)
        return "\n".join(lines)

    def csv(self) -> str:
        kept = [(k, column) for k, column in enumerate(self.columns) if column.key]
        rows = ([_formatted(row[k], column.stored) for k, column in kept] for row in self.rows)
        return csv_text([[column.key for _, column in kept], *rows])

    def records(self) -> list[dict[str, CellValue]]:
        return [{c.key: cell for c, cell in zip(self.columns, row, strict=True) if c.key} for row in self.rows]

    def write(self, path: str) -> None:
        """Write the CSV wholly or not at all; the path - is stdout. ValueError where that fails."""
        if path == "-":
            print(self.csv(), end="")
            return
        try:
            write_whole(path, self.csv())
        except OSError as error:
            raise ValueError(f"cannot write {path!r} ({error.strerror}): give a writable file") from None


def table(columns: str, rows: Iterable[Iterable[CellValue]]) -> Table:
    """A table of rows; its columns are `key|heading|format in text|format in CSV`, apart by semicolons.

    The last parts may be left out. With `mu|µ|.2f; |model|<; twist` the text has µ and the model, CSV and JSON mu and
    twist.
    """
    parts = (column.strip(" ").split("|") for column in columns.split(";"))
    return Table(tuple(TableColumn(*part) for part in parts), tuple(map(tuple, rows)))


def _formatted(cell: CellValue, form: str) -> str:
    return "" if cell is None else cell if isinstance(cell, str) else format(cell, form)
