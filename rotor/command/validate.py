"""`validate`: our number beside every measured point of rotors that were tested."""

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rotor.command.common import add_command, add_output_arguments
from rotor.support.plots import draw_chart, drawing_module
from rotor.support.table import LEFT, CellValue, Column, table
from rotor.support.terminal import wrapped
from rotor.support.user_input import check_known, make_folder
from rotor.validation.airloads import REPORTS, CurveAgreement, airload_agreement
from rotor.validation.compare import (
    FIELDS,
    PAGES,
    SETS,
    Comparison,
    compare,
    comparison_chart,
    load_set,
    page_of,
)
from rotor.validation.flown import POWERS, FlownPower, flown_powers
from rotor.validation.inflow import SET as INFLOW_SET
from rotor.validation.inflow import InflowAgreement, inflow_agreement
from rotor.validation.page import SETS as TRUST_SETS
from rotor.validation.page import write_set
from rotor.validation.trust import description

_OTHERS = [name for name in TRUST_SETS if name not in (*PAGES, *FIELDS)]
"""Sets of the trust page that are not points of a rotor on a stand."""


def add_parser(commands: Any) -> None:
    parser = add_command(commands, "validate", run)
    measured, more = ", ".join((*PAGES, *FIELDS)), ", ".join(_OTHERS)
    words = (
        f"set of points: {measured} (default: all these), {more}; or one set of a report, "
        "for example knight-hefner-3"
    )
    parser.add_argument("sets", nargs="*", metavar="SET", help=words)
    parser.add_argument(
        "--inflow", metavar="NAME", help="inflow model (default: that of preset flight)"
    )
    parser.add_argument("--plot", metavar="DIR", help="also draw each set into this folder")
    parser.add_argument(
        "--page",
        metavar="DIR",
        help="also write the page of each set, with charts, into this folder",
    )
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """0 when every point that counts trims, else 1; a missed target is a result, not a failure."""
    if args.plot:
        drawing_module()  # Fails before the trims if matplotlib is missing.
    names = args.sets or [*PAGES, *FIELDS]
    known = dict.fromkeys((*PAGES, *FIELDS, *TRUST_SETS))
    for name in names:
        if name not in SETS:
            check_known("set", name, known)
    parts = [part for name in names for part in PAGES.get(name, (name,))]
    chosen = [load_set(part) for part in parts if part in SETS]
    comparisons: list[Comparison] = []
    for measured in chosen:
        comparison = compare(measured, args.inflow)
        comparisons.append(comparison)
        if not args.json:
            print(("" if len(comparisons) == 1 else "\n") + report(comparison), flush=True)
    inflow = list(inflow_agreement()) if INFLOW_SET in names else []
    curves = list(airload_agreement(tuple(name for name in names if name in REPORTS)))
    powers = list(flown_powers()) if POWERS in names else []
    others = [TRUST_SETS[name]() for name in names if name in _OTHERS]
    if args.json:
        record = {
            "sets": [comparison.to_dict() for comparison in comparisons],
            "inflow": [asdict(agreement) for agreement in inflow],
            "airloads": [curve.to_dict() | {"fitted": False} for curve in curves],
            "powers": [asdict(power) | {"fitted": False} for power in powers],
            "rows": [asdict(row) for other in others for row in other.rows],
        }
        print(json.dumps(record, indent=2, allow_nan=False))
    else:
        tables = [inflow_report(inflow)] if inflow else []
        tables += [airload_report(curves)] if curves else []
        tables += [power_report(powers)] if powers else []
        for other in others:
            rows = ((row.what, row.shown, row.verdict) for row in other.rows)
            columns = Column("", LEFT), Column("error", LEFT), Column("verdict", LEFT)
            tables.append(f"{other.title}\n{table(columns, rows).text()}")
        if tables:
            print(("\n" if comparisons else "") + "\n\n".join(tables))
    if args.plot:
        for comparison in comparisons:
            draw(comparison, Path(args.plot))
    pages = dict.fromkeys(map(page_of, names))
    for name in pages if args.page else ():
        page = write_set(TRUST_SETS[name](), make_folder(args.page))
        print(f"page: {page}", file=sys.stderr)
    return 1 if any(comparison.lost for comparison in comparisons) else 0


_DIFFERENCES = (
    Column("correlation", ".2f"),
    Column("rms", ".4f"),
    Column("mean", ".4f"),
    Column("measured", ".4f"),
)


def inflow_report(rows: list[InflowAgreement]) -> str:
    cells = (
        (
            row.mu,
            row.model,
            "–" if row.correlation is None else row.correlation,
            row.rms,
            row.mean,
            row.measured_mean,
        )
        for row in rows
    )
    lines = [
        f"{INFLOW_SET}: inflow one chord above the disk of the NASA 2MRTS rotor, laser velocimeter; never fitted",
        table((Column("mu", ".2f"), Column("model", LEFT), *_DIFFERENCES), cells).text(),
        wrapped(description(INFLOW_SET).text[0]),
    ]
    return "\n".join(lines)


def airload_report(rows: list[CurveAgreement]) -> str:
    correlation, rms, *means = _DIFFERENCES
    what = Column("case"), Column("r/R", ".2f"), Column("quantity", LEFT)
    columns = (*what, correlation, rms, Column("of", ".4f"), *means)
    cells = (
        (
            row.case.name,
            row.r,
            row.quantity,
            row.correlation,
            row.rms,
            row.measured_rms,
            row.mean,
            row.measured_mean,
        )
        for row in rows
    )
    lines = [
        *(
            wrapped(f"{name}: {REPORTS[name]}; never fitted")
            for name in dict.fromkeys(row.case.test for row in rows)
        ),
        table(columns, cells).text(),
        wrapped(
            "Harmonics 1 to 10 (of the tip's motion 1 to 3), without the mean; rms of difference and measured."
        ),
    ]
    return "\n".join(lines)


def power_report(rows: list[FlownPower]) -> str:
    columns = (
        *(Column("rotor", LEFT), Column("case"), Column("mu", ".3f"), Column("measured", ".1f")),
        *(Column("computed", ".1f"), Column("error %", "+.1f"), Column("", LEFT)),
    )
    cells: list[tuple[CellValue, ...]] = []
    for row in rows:
        computed, error, words = None, None, "does not trim"
        if row.computed is not None:
            computed, error, words = (
                row.computed / 1e3,
                100.0 * (row.computed / row.measured - 1.0),
                None,
            )
        cells.append((row.rotor, row.case, row.mu, row.measured / 1e3, computed, error, words))
    title = f"{POWERS}: main-rotor power in level flight [kW]; never fitted"
    return f"{title}\n{table(columns, cells).text()}"


def report(comparison: Comparison) -> str:
    measured, quantity = comparison.measured, comparison.measured.quantity
    columns = (
        *(Column(name, ".5g") for name in measured.given),
        *(Column("measured", ".6g"), Column("±", ".2g"), Column("computed", ".6g")),
        *(Column(f"error {measured.unit}", "+.1f"), Column("within scatter", LEFT)),
    )
    cells: list[tuple[CellValue, ...]] = []
    for point in comparison.points:
        computed, words = None, point.message
        if point.computed is not None:
            aside = "" if point in comparison.counting else " (not counted)"
            computed, words = (
                point.computed[quantity],
                f"{'yes' if point.within_scatter else 'no'}{aside}",
            )
        where = (point.given[name] for name in measured.given)
        scatter = measured.scatter_of({**point.given, **point.measured})
        cells.append(
            (*where, point.measured[quantity], scatter, computed, point.error_percent, words)
        )
    lines = [wrapped(f"{measured.name}: {measured.title}"), wrapped(measured.report)]
    lines += [
        f"inflow {comparison.inflow}; never fitted",
        table(columns, cells).text(),
        wrapped(verdict(comparison)),
    ]
    lost = sum(point.computed is None for point in comparison.points)
    if lost:
        where = f"{comparison.lost} of them counted" if comparison.lost else "none of them counted"
        lines.append(f"{lost} of {len(comparison.points)} points do not trim, {where}.")
    lines += [wrapped(words) for words in (measured.remarks, comparison.why_missed) if words]
    return "\n".join(lines)


def verdict(comparison: Comparison) -> str:
    """Root mean square, worst error and target in one line."""
    target = "no target"
    if comparison.passed is not None:
        target = f"target {comparison.measured.target}: {'met' if comparison.passed else 'missed'}"
    if comparison.rms_percent is None:
        return f"no point trims; {target}"
    unit = comparison.measured.unit
    return f"rms {comparison.rms_percent:.1f} {unit}, worst {comparison.worst}; {target}"


def draw(comparison: Comparison, folder: Path) -> Path:
    """Measured and computed points, with the scatter of the test, as `SET.png`."""
    measured = comparison.measured
    figure: Any = drawing_module().Figure(figsize=(7.0, 4.5), layout="constrained")
    draw_chart(comparison_chart([comparison]), figure.subplots()).set_title(
        f"{measured.title}\n{verdict(comparison)}", fontsize="medium"
    )
    path = folder / f"{measured.name}.png"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=120)
    except OSError as error:
        raise ValueError(
            f"cannot write {str(path)!r} ({error.strerror}): give a writable folder"
        ) from None
    return path
