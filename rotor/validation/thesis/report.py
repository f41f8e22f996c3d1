"""A rebuilt figure: caption, statement of the thesis, our numbers, verdict; and the data of its plots and tables."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from string import Formatter
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rotor.support.assets import toml_asset
from rotor.support.chart import Axis, Band, Chart, Line, Points, Series

CurveStyle = Literal["line", "points", "dashed", "both", "band"]
TableCell = str | float | int
TOLERANCE = 1e-3
"""Part of the power by which a twist that the thesis calls the best may exceed our least: the band of every optimum."""


class Agreement(Enum):
    """How our result compares with the statement of the thesis."""

    AGREES = "agrees"
    DIFFERS = "differs"
    NO_REFERENCE = "no reference"
    """Nothing was compared: the number of the thesis is not known, or there is no statement to test."""
    INPUT = "input reproduced"
    """The numbers of the thesis are our input."""
    INDICATIVE = "indicative"
    """Compared with data of unclear origin or with another model: no verdict."""


@dataclass(frozen=True)
class ReportTable:
    """Rows of numbers and text for a CSV file."""

    name: str
    """Short: part of the file name when a figure has several."""
    columns: tuple[str, ...]
    rows: tuple[tuple[TableCell, ...], ...]


@dataclass(frozen=True, kw_only=True)
class Report:
    """One rebuilt figure or table of the thesis."""

    number: str
    """Number in the thesis, for example 3.11; or a word for what it does not number."""
    kind: Literal["figure", "table", "claim"] = "figure"
    caption: str
    """In our own words."""
    statement: str
    """What the thesis says."""
    finding: str
    """What this project finds, one or two sentences."""
    verdict: Agreement
    because: str
    """Reason for the difference, or basis of the agreement; one sentence."""
    tables: tuple[ReportTable, ...]
    panels: tuple[Chart, ...] = ()
    numbers: Mapping[str, float] = field(default_factory=dict[str, float])
    """Numbers that decide the verdict, by name."""

    @property
    def title(self) -> str:
        """`Figure 3.11`, `Table 3.1`, or the word for what has no number."""
        return self.number if self.kind == "claim" else f"{self.kind.capitalize()} {self.number}"

    @property
    def checkable(self) -> bool:
        """Whether anything of the thesis was compared or loaded."""
        return self.verdict is not Agreement.NO_REFERENCE

    @property
    def stem(self) -> str:
        """Name of its files, without ending."""
        return f"{self.kind}-{self.number}".lower().replace(" ", "-").replace(".", "_")


def curve(
    label: str,
    x: ArrayLike,
    y: ArrayLike,
    style: CurveStyle = "line",
    *,
    upper: ArrayLike | None = None,
    colour: int | None = None,
) -> Series:
    """A series from arrays; values that are not finite become gaps (NaN) in the picture only.

    upper: with `band`, of which y is the lower edge. colour: place among the colours after the ink; None: the next one.
    """
    across, up = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    place = None if colour is None else colour + 1
    if style == "band":
        return Band(
            label, across, up, np.asarray(() if upper is None else upper, dtype=float), place
        )
    if style == "points":
        return Points(label, across, up, place)
    return Line(label, across, up, place, dashes=style == "dashed", dots=style == "both")


def panel(title: str, x: str, y: str, series: Iterable[Series]) -> Chart:
    """A chart whose axes have labels only."""
    return Chart(title, Axis(x), Axis(y), tuple(series))


def with_gap(
    label: str,
    mu: Sequence[float],
    y: Sequence[float],
    style: CurveStyle = "both",
    *,
    colour: int,
    upper: Sequence[float] | None = None,
) -> list[Series]:
    """A curve over forward flight and its point in hover, not joined: no inflow model is validated between them."""
    parts: list[Series] = []
    for words, flying in ((label, True), ("", False)):
        keep = [k for k, mu in enumerate(mu) if (mu > 0.0) is flying]
        top = [upper[k] for k in keep] if upper else None
        parts.append(
            curve(
                words, [mu[k] for k in keep], [y[k] for k in keep], style, upper=top, colour=colour
            )
        )
    return parts


def table(name: str, columns: Sequence[str], rows: Iterable[Sequence[TableCell]]) -> ReportTable:
    """A table from any rows; numpy numbers become plain ones."""
    return ReportTable(
        name, tuple(columns), tuple(tuple(_plain(cell) for cell in row) for row in rows)
    )


def thesis() -> dict[str, dict[str, Any]]:
    """What the thesis says, and what this project finds, by number: `assets/thesis.toml`; last `drawings`."""
    return toml_asset("thesis.toml")


def report(
    number: str,
    verdict: Agreement = Agreement.NO_REFERENCE,
    *,
    tables: Sequence[ReportTable],
    panels: Sequence[Chart] = (),
    numbers: Mapping[str, float] | None = None,
    **words: str | float,
) -> Report:
    """The report of what was computed, its text from `thesis` filled with `numbers` and `words`.

    number: as the catalogue has it, for example `3.11`, `table 4.1`, `tail rotor`.
    """
    entry, numbers = thesis()[number], numbers or {}
    caption, finding, because = (
        _filled(entry[key], {**numbers, **words}) for key in ("caption", "finding", "because")
    )
    title = entry.get("title")
    known = (
        f"{title}. Only this caption is known; the numbers of the thesis are not."
        if title
        else entry["statement"]
    )
    return Report(
        number=number.removeprefix("table ").capitalize(),
        kind="table"
        if number.startswith("table ")
        else "figure"
        if number[0].isdigit()
        else "claim",
        caption=caption,
        statement=known,
        finding=finding,
        verdict=verdict,
        because=because,
        tables=tuple(tables),
        panels=tuple(panels),
        numbers=numbers,
    )


def _filled(text: str, values: Mapping[str, str | float]) -> str:
    """A text with its fields filled; a number and its per cent sign stand apart."""
    return "".join(
        before + ("" if field is None else re.sub(r"%$", " %", format(values[field], form or "")))
        for before, field, form, _ in Formatter().parse(text)
    )


def by_name(values: Mapping[str, float], form: str = "{:.1f} %") -> str:
    """`2.1 % (thesis), 9.9 % (flight)`: parts by name, shown in per cent, or as `form` says."""
    factor = 100.0 if "%" in form else 1.0
    return ", ".join(f"{form.format(factor * value)} ({name})" for name, value in values.items())


def judged(agrees: bool) -> Agreement:
    return Agreement.AGREES if agrees else Agreement.DIFFERS


def _plain(cell: TableCell) -> TableCell:
    if isinstance(cell, (str, bool)):
        return cell
    if isinstance(cell, (int, np.integer)):
        return int(cell)
    value = float(cell)
    return value if math.isfinite(value) else ""
