"""Reports as files: a CSV per table, pictures, and one page that shows them all."""

import csv
from collections.abc import Sequence
from pathlib import Path

from rotor.reproduce.catalogue import Entry
from rotor.reproduce.misprints import write_misprints
from rotor.reproduce.page import write_page
from rotor.reproduce.pictures import can_draw, draw
from rotor.reproduce.report import Cell, Report, Table


def write_report(report: Report, folder: Path, *, pictures: bool) -> None:
    """CSV per table, SVG and PNG."""
    for one in report.tables:
        write_csv(folder / csv_name(report, one), report, one)
    if pictures:
        draw(report, folder)


def csv_name(report: Report, one: Table) -> str:
    """`figure-3_11-thesis_kw.csv`; without the table's name where it is the only one."""
    return f"{report.stem}.csv" if len(report.tables) == 1 else f"{report.stem}-{one.name}.csv"


def write_csv(path: Path, report: Report, one: Table) -> None:
    """One table with a heading of comments."""
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {report.title}: {report.caption}\n# Made by: python -m rotor reproduce\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(one.columns)
        writer.writerows([shown(cell) for cell in row] for row in one.rows)


def shown(cell: Cell) -> str:
    """Six digits are more than any of it is worth."""
    return cell if isinstance(cell, str) else f"{cell:.6g}"


def write_all(made: Sequence[tuple[Entry, Report]], folder: Path) -> Path:
    """The page `index.html` with everything made, and the page of misprints."""
    write_misprints(folder)
    return write_page(made, folder, pictures=can_draw())
