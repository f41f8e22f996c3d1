"""A rebuilt figure: caption, statement of the thesis, our numbers, verdict; and the data of its plots and tables."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

CurveStyle = Literal["line", "thin", "points", "dashed", "both", "band", "fill"]
TableCell = str | float | int


class Agreement(Enum):
    """How our result compares with the statement of the thesis."""

    AGREES = "agrees"
    DIFFERS = "differs"
    ALONE = "no reference"
    """The number of the thesis is not known, or there is no statement to test."""
    INDICATIVE = "indicative"
    """Compared with data of unclear origin or with another model: no verdict."""


@dataclass(frozen=True)
class Curve:
    """One line of a picture."""

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    style: CurveStyle = "line"
    upper: tuple[float, ...] = ()
    """With `band`: y is the lower edge and this the upper."""
    colour: int | None = None
    """Place in the palette; None: the next one."""


@dataclass(frozen=True)
class PlotPanel:
    """One pair of axes."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    title: str = ""
    log: Literal["", "y", "xy"] = ""
    invert_y: bool = False
    equal: bool = False
    """Same scale on both axes, for outlines."""
    y_limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class DiskPanel:
    """A field over the disk seen from above, nose up, ψ = 0 at the bottom, advancing side right."""

    label: str
    r: tuple[float, ...]
    """Element centres y/R."""
    dr: float
    psi: tuple[float, ...]
    """[rad]"""
    values: tuple[tuple[float, ...], ...]
    """(elements, azimuths)"""
    title: str = ""
    zero_line: bool = False
    """Whether the line of zero is drawn (the border of reverse flow, in U_T)."""


@dataclass(frozen=True)
class FieldPanel:
    """A field over a rectangle, with lines of equal value on top where a second field is given."""

    x_label: str
    y_label: str
    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]
    """(y, x)"""
    lines: tuple[tuple[float, ...], ...] = ()
    """(y, x): drawn as ten contours."""
    title: str = ""
    limits: tuple[float, float] | None = None
    """Of the colours."""
    marks: tuple[Curve, ...] = ()
    """Thick red lines on top."""


AnyPanel = PlotPanel | DiskPanel | FieldPanel


@dataclass(frozen=True)
class ReportTable:
    """Rows of numbers and text for a CSV file."""

    name: str
    """Short: part of the file name when a figure has several."""
    columns: tuple[str, ...]
    rows: tuple[tuple[TableCell, ...], ...]


@dataclass(frozen=True)
class Report:
    """One rebuilt figure or table of the thesis."""

    number: str
    """As the thesis numbers it, for example 3.11; or a word for what it does not number."""
    kind: Literal["figure", "table", "claim"]
    caption: str
    """In our own words."""
    statement: str
    """The statement of the thesis."""
    ours: str
    """Our numbers, one or two sentences."""
    verdict: Agreement
    because: str
    """Reason for the difference, or basis of the agreement; one sentence."""
    tables: tuple[ReportTable, ...]
    panels: tuple[AnyPanel, ...] = ()
    companion: tuple[AnyPanel, ...] = ()
    """Panels of a second figure."""
    numbers: Mapping[str, float] = field(default_factory=dict[str, float])
    """Numbers that decide the verdict, by name."""

    @property
    def title(self) -> str:
        """`Figure 3.11`, `Table 3.1`, or the word for what has no number."""
        return self.number if self.kind == "claim" else f"{self.kind.capitalize()} {self.number}"

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
) -> Curve:
    """A curve from arrays; values that are not finite become gaps (NaN) in the picture only."""
    top = () if upper is None else floats(upper)
    return Curve(label, floats(x), floats(y), style, top, colour)


def floats(values: ArrayLike) -> tuple[float, ...]:
    """Plain floats of any array-like, flattened."""
    return tuple(float(value) for value in np.asarray(values, dtype=float).ravel())


def table(name: str, columns: Sequence[str], rows: Iterable[Sequence[TableCell]]) -> ReportTable:
    """A table from any rows; numpy numbers become plain ones."""
    return ReportTable(name, tuple(columns), tuple(tuple(_plain(cell) for cell in row) for row in rows))


def typographic(text: str) -> str:
    """Replace a hyphen before a number by a minus sign."""
    return re.sub(r"(?<![\w.\-])-(?=\d)", "−", text)


def judged(agrees: bool) -> Agreement:
    """Agrees or differs."""
    return Agreement.AGREES if agrees else Agreement.DIFFERS


def _plain(cell: TableCell) -> TableCell:
    if isinstance(cell, (str, bool)):
        return cell
    if isinstance(cell, (int, np.integer)):
        return int(cell)
    value = float(cell)
    return value if math.isfinite(value) else ""
