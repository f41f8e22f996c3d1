"""Reports as files: a CSV file per table, a picture of each, and `results.json` with statement, numbers and verdict."""

import io
import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rotor.support.assets import asset_path
from rotor.support.chart import Chart
from rotor.support.plots import draw_chart, drawing_module
from rotor.support.units import typographic
from rotor.support.user_input import csv_text, write_whole
from rotor.validation.thesis.catalogue import CatalogueEntry, find_entry
from rotor.validation.thesis.misprints import misprint_table
from rotor.validation.thesis.report import Report, ReportTable
from rotor.validation.thesis.runs import CachedFunction

_WIDTH, _HEIGHT = 4.2, 3.2
"""Inches of one panel."""
NAMED_CURVES = 3
"""Curves for whose names there is room in a panel."""


def _same_key(panels: tuple[Chart, ...]) -> bool:
    """Whether several panels name the same curves, too many to lie over them: one legend below serves all."""
    keys = [tuple(series.label for series in panel.series) for panel in panels]
    return len(keys) == len(panels) > 1 and len(set(keys)) == 1 and len(keys[0]) > NAMED_CURVES


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
    with drawing_module("matplotlib.style").context(asset_path("thesis.mplstyle")):
        figure: Any = drawing_module().Figure(figsize=(width, height * down), layout="constrained")
        axes: Any = figure.subplots(down, across, squeeze=False)
        for k, panel in enumerate(panels):
            draw_chart(panel, axes[k // across][k % across], legend=not legend_below)
        if legend_below:
            handles, labels = axes[0][0].get_legend_handles_labels()
            columns = math.ceil(len(labels) / math.ceil(len(labels) / 5))
            figure.legend(handles, labels, loc="outside lower center", ncols=columns)
        for k in range(count, down * across):
            axes[k // across][k % across].axis("off")
        # Transparent: the page has a dark form.
        for kind, how in (
            ("svg", {"metadata": {"Date": None}, "transparent": True}),
            ("png", {"dpi": 130}),
        ):
            content = io.BytesIO()
            figure.savefig(content, format=kind, **how)
            write_whole(folder / f"{report.stem}.{kind}", content.getvalue())


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
    rows = (
        [cell if isinstance(cell, str) else f"{cell:.6g}" for cell in row] for row in table.rows
    )
    write_whole(path, csv_text([table.columns, *rows], heading))


def write_results(
    reports: Sequence[tuple[CatalogueEntry, Report]], folder: Path, *, whole: bool = True
) -> Path:
    """`results.json`: what the thesis says of each, our numbers and the verdict; of the `whole` thesis `misprints.csv`
    beside it."""
    if whole:
        found = misprint_table()
        text = csv_text([found.columns, *found.rows], "# What the thesis omits or misprints\n")
        write_whole(folder / "misprints.csv", text)
    path = folder / "results.json"
    records = [_record(entry.chapter, report) for entry, report in reports]
    write_whole(path, json.dumps(records, indent=2, ensure_ascii=False, allow_nan=False) + "\n")
    return path


def _record(chapter: str, report: Report) -> dict[str, Any]:
    return {
        "title": report.title,
        "chapter": chapter,
        "caption": report.caption,
        "statement": report.statement,
        "finding": typographic(report.finding),
        "verdict": report.verdict.value,
        "because": typographic(report.because),
        "numbers": {
            name: value if math.isfinite(value) else None for name, value in report.numbers.items()
        },
        "tables": [csv_name(report, table) for table in report.tables],
        "pictures": [f"{report.stem}.{end}" for end in ("svg", "png") if report.panels],
    }
