"""Reports as files: a CSV per table, figures, and `index.html` with statement, result and agreement of each."""

import base64
import math
from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from rotor.assets import asset_path
from rotor.chart import Chart
from rotor.markup import Content, Markup, document, group, tag
from rotor.plots import draw_chart, drawing_module
from rotor.reproduce.catalogue import DRAWINGS, CatalogueEntry, find_entry
from rotor.reproduce.misprints import misprint_table
from rotor.reproduce.report import (
    Agreement,
    Report,
    ReportTable,
    TableCell,
)
from rotor.reproduce.runs import CachedFunction
from rotor.units import typographic
from rotor.user_input import csv_text

_STYLE = {
    "font.size": 9.0,
    "font.family": "sans-serif",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#aaaaaa",
    "grid.alpha": 0.4,
    "grid.linewidth": 0.6,
    "axes.edgecolor": "#888888",
    "axes.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "legend.framealpha": 0.8,  # Above the lines, where no corner is free.
    "legend.edgecolor": "none",
    "lines.linewidth": 1.6,
    "svg.fonttype": "none",
    "svg.hashsalt": "rotor",
}
_WIDTH, _HEIGHT = 4.2, 3.2
"""Inches of one panel."""
FEW = 3
"""Curves for whose names there is room in a panel."""


def _same_key(panels: tuple[Chart, ...]) -> bool:
    """Whether several panels name the same curves, too many to lie over them: one legend below serves all."""
    keys = [tuple(series.label for series in panel.series) for panel in panels]
    return len(keys) == len(panels) > 1 and len(set(keys)) == 1 and len(keys[0]) > FEW


def draw(report: Report, folder: Path) -> None:
    """Write `stem.svg` and `stem.png`; nothing for a report without panels."""
    panels = report.panels
    if not panels:
        return
    legend_below = _same_key(panels)
    count = len(panels)
    across = count if count <= 3 else 3 if count % 3 == 0 else 2
    down = math.ceil(count / across)
    # A single picture is wider, so that its text is not enlarged on the page.
    width, height = (1.5 * _WIDTH, 1.25 * _HEIGHT) if count == 1 else (_WIDTH * across, _HEIGHT)
    if count == 1 and panels[0].y.names:
        width, height = 1.9 * _WIDTH, 1.5 * _HEIGHT
    with drawing_module("matplotlib").rc_context(_STYLE):
        figure: Any = drawing_module().Figure(figsize=(width, height * down), layout="constrained")
        axes: Any = figure.subplots(down, across, squeeze=False)
        for k, panel in enumerate(panels):
            place = axes[k // across][k % across]
            draw_chart(panel, place, legend=not legend_below)
        if legend_below:
            handles, labels = axes[0][0].get_legend_handles_labels()
            columns = math.ceil(len(labels) / math.ceil(len(labels) / 5))
            figure.legend(handles, labels, loc="outside lower center", ncols=columns)
        for k in range(count, down * across):
            axes[k // across][k % across].axis("off")
        # Transparent: the page has a dark form.
        figure.savefig(folder / f"{report.stem}.svg", metadata={"Date": None}, transparent=True)
        figure.savefig(folder / f"{report.stem}.png", dpi=130)


LONG = 60
"""Letters of a cell from which a table holds sentences."""
ROWS = 60
"""Rows of a table shown on the page; the CSV has them all."""
COLOURS = {
    Agreement.AGREES: "#1d7a46",
    Agreement.DIFFERS: "#b3452c",
    Agreement.NO_REFERENCE: "#5b6770",
    Agreement.INPUT: "#5b6770",
    Agreement.INDICATIVE: "#9a6b00",
}


TALK = "today.html"
MISPRINTS_PAGE = "misprints.html"


def write_talk(entries: Sequence[tuple[CatalogueEntry, Report]], folder: Path) -> None:
    """Write the last chapter as a page of one screen, where it was made."""
    report = _talk_of(entries)
    if report is None:
        return
    answer, *others = report.tables
    rows = [(tag("dt", typographic(str(words))), tag("dd", typographic(str(text)))) for words, text in answer.rows]
    files = [tag("a", f"CSV {typographic(other.name)}", href=csv_name(report, other)) for other in others]
    picture = tag("div", _image(report, folder), tag("p.small", typographic(report.caption)))
    body = (
        tag("p.lead", typographic(report.ours)),
        tag("div.two", picture, tag("dl", rows)),
        tag("p.small", typographic(report.because), " ", _listed(files)),
    )
    _write_beside(folder / TALK, "What the thesis would have found", body, kind="talk")


def write_misprints(folder: Path) -> Path:
    """Write the page of what the thesis omits or misprints into `folder`; its path."""
    body = (
        tag("p", "Each with two lines that were run to make this page."),
        tag("div.shown.text", _rows(misprint_table())),
    )
    return _write_beside(folder / MISPRINTS_PAGE, "What the thesis omits or misprints", body)


def _write_beside(path: Path, title: str, body: Content, kind: str | None = None) -> Path:
    """Write a page that leads back to the index; its path."""
    back = tag("p.small", tag("a", "The thesis, rebuilt", href="index.html"))
    path.write_text(_page(title, back, tag("h1", title), body, kind=kind), encoding="utf-8")
    return path


def _page(title: str, *content: Content, kind: str | None = None) -> str:
    """A whole file."""
    style = Markup(asset_path("thesis_page.css").read_text(encoding="utf-8"))
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("title", typographic(title)),
        tag("meta", name="viewport", content="width=device-width,initial-scale=1"),
        tag("style", style),
    )
    return document(head, tag("body", tag("main", *content)), lang="en", class_=kind)


def _listed(parts: Sequence[Markup]) -> list[Content]:
    """With dots between them."""
    return [part for link in parts for part in (" · ", link)][1:]


def _talk_of(entries: Sequence[tuple[CatalogueEntry, Report]]) -> Report | None:
    return next((report for entry, report in entries if entry.number == "today"), None)


def _head(entries: Sequence[tuple[CatalogueEntry, Report]]) -> Markup:
    counts = Counter(report.verdict for _, report in entries)
    summary = ", ".join(
        f"{agreement.value} {counts[agreement]}"
        for agreement in Agreement
        if counts[agreement] and agreement is not Agreement.NO_REFERENCE
    )
    checkable, captions = (
        sum(getattr(report, name) for _, report in entries) for name in ("checkable", "caption_only")
    )
    drawings = "; ".join(f"{number}, {words}" for number, words in DRAWINGS.items())
    rows = [
        tag(
            "tr",
            tag("td", tag("a", typographic(report.title), href=f"#{report.stem}")),
            tag("td", _chip(report.verdict)),
            tag("td", typographic(report.statement)),
        )
        for _, report in entries
    ]
    talk = (" ", tag("a", "Its main results then and now, on one page", href=TALK), ".") if _talk_of(entries) else None
    return group(
        tag("h1", "The thesis, rebuilt"),
        tag(
            "p",
            "Figures and tables of M. Lonoce, ",
            tag("i", "Helicopter Blade Twist Optimization in Forward Flight"),
            " (MSc thesis, Instituto Superior Técnico, 2016), computed anew. Captions are ours; no picture is taken "
            "from there. ",
            tag("b", "thesis"),
            " is the model as printed, ",
            tag("b", "flight"),
            " the best available, ",
            tag("b", "thesis-wake"),
            " the thesis preset with a wake that responds to loading. The text is available up to figure 3.15; of "
            "chapters 4 to 6 only the captions.",
        ),
        tag(
            "p",
            f"{checkable} checkable against the thesis{f' ({summary})' if summary else ''}; {captions} ours under its "
            f"captions; {len(entries) - checkable - captions} without a statement to check; {len(DRAWINGS)} pictures "
            "of the thesis that show nothing of its model, not rebuilt. ",
            tag("a", "What the thesis omits or misprints", href=MISPRINTS_PAGE),
            ".",
            talk,
        ),
        tag(
            "details",
            tag("summary", "Contents"),
            tag("table.toc", rows),
            tag("p.small", f"Not rebuilt: figures {typographic(drawings)}."),
            open=True,
        ),
    )


def _article(report: Report, folder: Path) -> Markup:
    image = _image(report, folder) if report.panels else None
    files = [
        tag("a", f"CSV {typographic(table.name.replace('_', ' '))}", href=csv_name(report, table))
        for table in report.tables
    ]
    if image:
        files += [tag("a", end.upper(), href=f"{report.stem}.{end}") for end in ("svg", "png")]
    words = (("The thesis", report.statement), ("Ours", report.ours),
             (report.verdict.value.capitalize(), report.because))  # fmt: skip
    said = tag("dl", [(tag("dt", head), tag("dd", typographic(text))) for head, text in words])
    if report.caption_only:
        more = tag("summary", "more"), tag("p", typographic(f"{report.because} {report.statement}"))
        said = group(tag("p", typographic(report.ours)), tag("details", *more))
    return tag(
        "article",
        tag("h3", typographic(report.title), " ", _chip(report.verdict)),
        tag("div", typographic(report.caption)),
        image,
        [tag(f"div.{_shown_as(table)}", _rows(table)) for table in report.tables if table.shown],
        said,
        tag("div.small.files", _listed(files)),
        [_details(table) for table in report.tables if not table.shown],
        id=report.stem,
    )


def _image(report: Report, folder: Path) -> Markup:
    data = base64.b64encode((folder / f"{report.stem}.svg").read_bytes()).decode("ascii")
    # In print a picture of three rows and more is higher.
    kind = "tall" if len(report.panels) > 4 and len(report.panels) % 3 else "plot"
    return tag(f"img.{kind}", alt=typographic(report.title), src=f"data:image/svg+xml;base64,{data}")


def _details(table: ReportTable) -> Markup:
    left = tag("p.small", f"{len(table.rows) - ROWS} more rows in the CSV.") if len(table.rows) > ROWS else None
    title = tag("summary", typographic(table.name.replace("_", " ")))
    return tag("details", title, tag("div.scroll", _rows(table)), left)


def _rows(table: ReportTable) -> Markup:
    """The first rows of a table, for the page."""
    head = tag("tr", [tag("th", typographic(column)) for column in table.columns])
    return tag("table", head, [tag("tr", map(_cell, row)) for row in table.rows[:ROWS]])


def _cell(cell: TableCell) -> Markup:
    if not isinstance(cell, str):
        return tag("td", f"{cell:.5g}")
    if "\n" in cell:
        return tag("td.code", cell)  # To be copied: its hyphens stay.
    return tag("td.yes" if cell.startswith("yes ") else "td", typographic(cell))


def _shown_as(table: ReportTable) -> str:
    """Classes of an open table: sentences may be broken into lines, numbers not."""
    longest = max(len(cell) for row in table.rows for cell in row if isinstance(cell, str))
    return "shown.text" if longest > LONG else "shown"


def _chip(verdict: Agreement) -> Markup:
    return tag("span.chip", verdict.value, style=f"background:{COLOURS[verdict]}")


@CachedFunction
def written(number: str, folder: Path) -> Report:
    """The report of an entry, its files written to the folder; for another process."""
    report = find_entry(number).make()
    write_report(report, folder)
    return report


def write_report(report: Report, folder: Path) -> None:
    """CSV per table, SVG and PNG."""
    for table in report.tables:
        write_csv(folder / csv_name(report, table), report, table)
    draw(report, folder)


def csv_name(report: Report, table: ReportTable) -> str:
    """`figure-3_11-thesis_kw.csv`; without the table's name where it is the only one."""
    return f"{report.stem}.csv" if len(report.tables) == 1 else f"{report.stem}-{table.name}.csv"


def write_csv(path: Path, report: Report, table: ReportTable) -> None:
    """One table with a heading of comments."""
    heading = f"# {report.title}: {report.caption}\n# Made by: python -m rotor reproduce\n"
    # Six significant digits are more than the accuracy of any.
    rows = ([cell if isinstance(cell, str) else f"{cell:.6g}" for cell in row] for row in table.rows)
    path.write_text(csv_text([table.columns, *rows], heading), encoding="utf-8", newline="")


def write_all(reports: Sequence[tuple[CatalogueEntry, Report]], folder: Path) -> Path:
    """The page `index.html` with everything made, the page of misprints and the page for a lecture."""
    write_misprints(folder)
    write_talk(reports, folder)
    parts = [_head(reports)]
    for chapter, entries in groupby(reports, key=lambda pair: pair[0].chapter):
        parts.append(tag("h2", typographic(chapter)))
        parts += [_article(report, folder) for _, report in entries]
    path = folder / "index.html"
    path.write_text(_page("The thesis, rebuilt", parts), encoding="utf-8")
    return path
