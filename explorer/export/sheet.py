"""A picture to be kept: the disk or the view of the rotor with title, flight, power, colour bar and caveats, as SVG.

The browser that asked for it turns it into pixels: it has the letters, Greek ones too, that a server may not have.
"""

import textwrap
from dataclasses import dataclass

from explorer.charts import svg
from explorer.export.disk_drawing import HALF, OUTLINES, bar_drawing, disk_drawing, key_entries
from explorer.export.provenance import PROGRAM, versions
from explorer.model.inputs import ViewState
from explorer.model.units import SI, UNITS, Units
from explorer.picture.fields import FIELDS, Field
from explorer.text.design_words import flight_words, model_words, title_words, wave_words
from explorer.text.readout import part_titles
from explorer.theme.colours import PARTS
from rotor.trim.solution import Solution

SIZES = {
    "1280 × 720": (1280, 720),
    "1920 × 1080": (1920, 1080),
    "3840 × 2160": (3840, 2160),
    "2000 × 2000": (2000, 2000),
}
SMALLEST, LARGEST = 300, 4096
"""[px] along either edge; smaller text cannot be read, and some browsers have no larger canvas."""


@dataclass(frozen=True)
class Paper:
    """Size and background of a picture."""

    width: int
    height: int
    """[px]"""
    dark: bool = False
    transparent: bool = False

    def __post_init__(self) -> None:
        for edge in (self.width, self.height):
            if not SMALLEST <= edge <= LARGEST:
                raise ValueError(
                    f"A picture of {self.width} × {self.height} pixels cannot be made: "
                    f"keep both edges within {SMALLEST}…{LARGEST}."
                )
        if not 0.4 <= self.width / self.height <= 3.0:
            raise ValueError(
                f"{self.width} × {self.height} leaves no room for words beside the disk: "
                "keep the longer edge within two and a half times the shorter."
            )

    @property
    def unit(self) -> float:
        """Unit of all lengths: a hundredth of the shorter edge [px]."""
        return min(self.width, self.height) / 100.0

    @property
    def beside(self) -> bool:
        """Whether the text is beside the picture; else it is above and below."""
        return self.width >= 1.35 * self.height


_PAPER = {False: "#ffffff", True: "#141416"}
_INK = {False: "#212529", True: "#e9ecef"}
_FONT = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif"
_INDENT = "\u2003 "
"""Indent as wide as the sign of a caveat."""


@dataclass(frozen=True, eq=False)
class DiskContent:
    """What is on the disk."""

    field: Field
    colour_range: tuple[float, float]
    outlines: tuple[str, ...] = tuple(OUTLINES)
    """Names of outlines in `ViewState`."""
    note: str = ""
    """A line below the title, for example the title of A."""
    units: Units = SI


def shown(
    view: ViewState, field: Field | None = None, colour_range: tuple[float, float] | None = None, note: str = ""
) -> DiskContent:
    """The content of the disk on the page; `field` and `colour_range` where they differ from those of the view."""
    field = field or FIELDS[view.field]
    return DiskContent(
        field,
        colour_range or (field.low, field.high),
        tuple(n for n in OUTLINES if getattr(view, n)),
        note,
        UNITS[view.units],
    )


def window(solution: Solution, paper: Paper) -> tuple[int, int, int, int]:
    """The rectangle of the rotor's view: x, y, width, height [px]."""
    if paper.beside:
        return 0, 0, paper.width, paper.height
    top = round(13 * paper.unit)
    return 0, top, paper.width, paper.height - top - round(_below(solution, paper) * paper.unit)


def _below(solution: Solution, paper: Paper) -> float:
    """Height of the text below the picture, in units of the paper."""
    lines = sum(map(len, _caveats(solution, paper.width - 8 * paper.unit, paper.unit)))
    return 18.0 + 2.5 * lines


def disk_sheet(solution: Solution, shown: DiskContent, paper: Paper) -> str:
    """The disk from above."""
    u = paper.unit
    edge = 96 * u if paper.beside else min(96 * u, paper.height - (13 + _below(solution, paper)) * u)
    x = 1 * u if paper.beside else 0.5 * (paper.width - edge)
    y = 0.5 * (paper.height - edge) if paper.beside else 13 * u
    pixels = round(edge * 100.0 / HALF)
    drawn = disk_drawing(solution, shown.field, shown.colour_range, pixels, shown.outlines, 6.5, shown.units)
    disk = f'<svg x="{x:.1f}" y="{y:.1f}" width="{edge:.1f}" height="{edge:.1f}" viewBox="{_SQUARE}">{drawn}</svg>'
    if not paper.beside:
        return _page(paper, disk + _above_and_below(solution, shown, paper))
    left = edge + 4 * u
    return _page(paper, disk + _column(solution, shown, paper, left, paper.width - left - 4 * u))


def view_sheet(solution: Solution, shown: DiskContent, paper: Paper, render: bytes) -> str:
    """The view of the rotor; `render`: a PNG of the size of its `window`."""
    x, y, wide, high = window(solution, paper)
    seen = svg.image(x, y, wide, high, render)
    if not paper.beside:
        return _page(paper, seen + _above_and_below(solution, shown, paper))
    u = paper.unit
    right, caveats = paper.width - 40 * u, _caveats(solution, 42 * u, u)
    bottom = paper.height - 3 * u
    above = bottom - 2.5 * u * sum(map(len, caveats)) - 18 * u
    words = _heading(solution, shown, 4 * u, 7 * u, 58 * u, u) + _power(solution, shown.units, 4 * u, above, 30 * u, u)
    scale = _scale(solution, shown, right, paper.height - 21 * u, 36 * u, u)
    return _page(
        paper, seen + words + scale + _warning(solution, 4 * u, bottom, 42 * u, u) + _foot(paper, right + 36 * u, "end")
    )


_SQUARE = f"{-HALF:g} {-HALF:g} {2 * HALF:g} {2 * HALF:g}"


def _page(paper: Paper, inside: str) -> str:
    ground = "" if paper.transparent else f'<rect width="100%" height="100%" fill="{_PAPER[paper.dark]}"/>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{paper.width}" height="{paper.height}" '
        f'viewBox="0 0 {paper.width} {paper.height}" font-family="{_FONT}" '
        f'color="{_INK[paper.dark]}">{ground}{inside}</svg>'
    )


def _column(solution: Solution, shown: DiskContent, paper: Paper, x: float, wide: float) -> str:
    """All text and scales, beside the disk."""
    u = paper.unit
    return (
        _heading(solution, shown, x, 9 * u, wide, u)
        + _power(solution, shown.units, x, 32 * u, wide, u)
        + _scale(solution, shown, x, 61 * u, wide, u)
        + _warning(solution, x, paper.height - 7 * u, wide, u)
        + _foot(paper, x, "start")
    )


def _above_and_below(solution: Solution, shown: DiskContent, paper: Paper) -> str:
    u, wide = paper.unit, paper.width
    top = paper.height - (_below(solution, paper) - 1) * u
    return (
        _heading(solution, shown, 4 * u, 5.5 * u, wide - 8 * u, u)
        + _power(solution, shown.units, 4 * u, top, 0.44 * wide, u)
        + _scale(solution, shown, 0.55 * wide, top, wide * 0.45 - 4 * u, u)
        + _warning(solution, 4 * u, paper.height - 5.5 * u, wide - 8 * u, u)
        + _foot(paper, wide - 4 * u, "end")
    )


def _heading(solution: Solution, shown: DiskContent, x: float, y: float, wide: float, u: float) -> str:
    """Twist, flight and models."""
    design = solution.design
    title = _wrapped(title_words(design), wide, 3.0 * u, bold=True)
    below = [flight_words(design, shown.units), *_wrapped(model_words(design), wide, 2.1 * u)]
    if shown.note:
        below.append(shown.note)
    if words := wave_words(design):
        below[:0] = _wrapped(f"with {words}", wide, 2.1 * u)
    under = y + len(title) * 3.9 * u
    return _lines(title, x, y, 3.0 * u, 650) + _lines(below, x, under, 2.1 * u, opacity=0.8)


def _power(solution: Solution, units: Units, x: float, y: float, wide: float, u: float) -> str:
    """Total power, and its parts as a bar and as text."""
    power = solution.power
    titles = part_titles(solution.design)
    values = {name: max(getattr(power, name), 0.0) for name in titles}
    total = max(sum(values.values()), 1.0)
    bars, words, at, columns = [], [], x, 2 if wide > 40 * u else 1
    for k, (name, value) in enumerate(values.items()):
        bars.append(
            f'<rect x="{at:.1f}" y="{y + 2.2 * u:.1f}" width="{wide * value / total:.1f}" height="{1.8 * u:.1f}" '
            f'fill="{PARTS[name]}"/>'
        )
        at += wide * value / total
        column, row = x + (k % columns) * wide / 2, y + (7.0 + 2.9 * (k // columns)) * u
        words.append(
            f'<rect x="{column:.1f}" y="{row - 1.5 * u:.1f}" width="{1.5 * u:.1f}" height="{1.5 * u:.1f}" '
            f'fill="{PARTS[name]}"/>' + svg.text(column + 2.4 * u, row, f"{titles[name]} {units.watts(value)}", 1.9 * u)
        )
    beside = (x + wide, y) if columns > 1 else (x, y - 4.6 * u)
    return (
        svg.text(x, y, units.watts(power.total), 4.6 * u, weight=650)
        + svg.text(*beside, "total power", 2.0 * u, anchor="end" if columns > 1 else "start", opacity=0.7)
        + "".join(bars + words)
    )


def _scale(solution: Solution, shown: DiskContent, x: float, y: float, wide: float, u: float) -> str:
    """Colour bar and key, its label's baseline at `y`."""
    field, size = shown.field, 2.2 * u
    drawn = bar_drawing(field, shown.colour_range, wide, "scale", size)
    bar = f'<g transform="translate({x:.1f} {y - size:.1f})">{drawn}</g>'
    entries, at, row = [], x, y + 10.6 * u
    for title, swatch in key_entries(solution, field, shown.outlines):
        needed = (5.0 + 1.0 * len(title)) * u
        if at > x and at + needed > x + wide:
            at, row = x, row + 2.7 * u
        entries.append(
            f'<g transform="translate({at:.1f} {row - 1.5 * u:.1f}) scale({0.2 * u:.3f})">{swatch}</g>'
            + svg.text(at + 3.5 * u, row, title, 1.8 * u)
        )
        at += needed
    return bar + "".join(entries)


def _foot(paper: Paper, x: float, anchor: str) -> str:
    u = paper.unit
    words = f"{PROGRAM} {versions()[PROGRAM].split(' ')[0]} · a model, not a measurement"
    return svg.text(x, paper.height - 2.6 * u, words, 1.7 * u, anchor=anchor, opacity=0.6)


def _warning(solution: Solution, x: float, bottom: float, wide: float, u: float) -> str:
    """All caveats; the last line ends at `bottom`."""
    lines = [line for block in _caveats(solution, wide, u) for line in block]
    return _lines(lines, x, bottom - 2.5 * u * (len(lines) - 1), 1.9 * u)


def _caveats(solution: Solution, wide: float, u: float) -> list[list[str]]:
    """Caveats wrapped to lines, each with its sign, further lines indented."""
    blocks = [_wrapped(caveat.sentence, wide - 3 * u, 1.9 * u) for caveat in solution.caveats]
    return [[f"▲ {block[0]}", *(f"{_INDENT}{line}" for line in block[1:])] for block in blocks]


def _wrapped(words: str, wide: float, size: float, bold: bool = False) -> list[str]:
    """Lines that fit into `wide`, by the mean width of letters."""
    return textwrap.wrap(words, max(int(wide / ((0.56 if bold else 0.53) * size)), 8)) or [""]


def _lines(lines: list[str], x: float, y: float, size: float, weight: int = 400, opacity: float = 1.0) -> str:
    return "".join(
        svg.text(x, y + 1.3 * size * k, line, size, weight=weight, opacity=opacity) for k, line in enumerate(lines)
    )
