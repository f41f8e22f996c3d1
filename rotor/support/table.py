"""Tables of the commands: rows as text, as CSV and as records for JSON."""

from collections.abc import Iterable
from dataclasses import dataclass

from rotor.support.markup import Markup, tag
from rotor.support.terminal import wrapped
from rotor.support.user_input import csv_text, write_output

CellValue = str | float | None
"""A text or a number; None where there is no value."""


LEFT = "<"
"""Format of words, which stand at the left."""


@dataclass(frozen=True)
class Column:
    """One column, of all three forms or of some."""

    head: str | None = None
    """Heading in text; None: the text does not have the column."""
    shown: str = ""
    """Format of numbers in text, or `LEFT`."""
    key: str = ""
    """Name in CSV and JSON; empty: they do not have the column."""
    stored: str = ""
    """Format of numbers in CSV; JSON has them as they are."""


@dataclass(frozen=True)
class Table:
    """Rows with a cell for each column; `table` makes it of any iterables."""

    columns: tuple[Column, ...]
    rows: tuple[tuple[CellValue, ...], ...]

    def text(self) -> str:
        """Aligned columns below their headings; words at the end that are too long for the terminal go on below."""
        columns = [
            (k, column.head, column.shown)
            for k, column in enumerate(self.columns)
            if column.head is not None
        ]
        cells = [
            [head, *(_formatted(row[k], shown) for row in self.rows)] for k, head, shown in columns
        ]
        sides = [str.ljust if shown == LEFT else str.rjust for _, _, shown in columns]
        widths = [max(map(len, texts)) for texts in cells]
        lines: list[str] = []
        for texts in zip(*cells, strict=True):
            aligned = (
                side(text, width) for side, text, width in zip(sides, texts, widths, strict=True)
            )
            line = "  ".join(aligned).rstrip()
            lines.append(wrapped(line, "    ") if texts[-1] and sides[-1] is str.ljust else line)
        return "\n".join(lines)

    def html(self) -> Markup:
        """The table for a notebook."""
        shown = [(k, column) for k, column in enumerate(self.columns) if column.head is not None]
        heads = tag("tr", [tag("th", column.head) for _, column in shown])
        rows = (
            tag("tr", [tag("td", _formatted(row[k], _number(column))) for k, column in shown])
            for row in self.rows
        )
        return tag("table", tag("thead", heads), tag("tbody", rows))

    def csv(self) -> str:
        """The table as CSV text."""
        kept = [(k, column) for k, column in enumerate(self.columns) if column.key]
        rows = ([_formatted(row[k], column.stored) for k, column in kept] for row in self.rows)
        return csv_text([[column.key for _, column in kept], *rows])

    def records(self) -> list[dict[str, CellValue]]:
        return [
            {c.key: cell for c, cell in zip(self.columns, row, strict=True) if c.key}
            for row in self.rows
        ]

    def write(self, path: str) -> None:
        """Write the CSV wholly or not at all; the path - is stdout. ValueError where that fails."""
        if path == "-":
            print(self.csv(), end="")
            return
        write_output(path, self.csv())


def table(columns: Iterable[Column], rows: Iterable[Iterable[CellValue]]) -> Table:
    """A table of rows."""
    return Table(tuple(columns), tuple(map(tuple, rows)))


def _number(column: Column) -> str:
    return "" if column.shown == LEFT else column.shown


def _formatted(cell: CellValue, form: str) -> str:
    return "" if cell is None else cell if isinstance(cell, str) else format(cell, form)
