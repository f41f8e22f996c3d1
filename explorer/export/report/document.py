"""Designs as one HTML file that needs no server and no network: power, trim, 3D, disks, charts.

`python -m explorer report` makes it of design files, without a page and without a browser.
"""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from html import escape
from pathlib import Path

from explorer import web
from explorer.charts.plots import PowerCurves
from explorer.colours import PARTS
from explorer.export.provenance import PROGRAM, versions
from explorer.export.report import figures, tables
from explorer.export.report.contents import DesignReport, ReportEntry, colours_of, judged_actuator, report_of
from explorer.export.report.figures import actuator_section
from explorer.model.inputs import ViewState, baseline_of, baseline_title
from explorer.picture.fields import FIELDS
from explorer.scene.still_scene import EmbeddedViewer, make_stage
from explorer.text.design_words import flight_words, model_words, title_words, wave_words
from explorer.text.readout import part_titles
from explorer.text.status import tiny
from rotor import Design, Solution, load_design, solve
from rotor.actuator import try_actuator
from rotor.dynamics.structure import check_blade
from rotor.terminal import run_command
from rotor.user_input import write_whole


def report_html(report: DesignReport, stage: EmbeddedViewer | None, curves: PowerCurves | None = None) -> str:
    """The file's text. `stage`: the 3D scenes of `report.shown`, in their order; `curves`: power already swept."""
    several = len(report.shown) > 1
    title = f"{len(report.shown)} designs compared" if several else title_words(report.entries[0].solution.design)
    overview = [
        _glance(report),
        _stage(report, stage),
        tables.comparison(report),
        figures.overview(report, curves or PowerCurves()),
        actuator_section(report.actuator, report.units),
    ]
    sections = [_section(report, k) for k in range(len(report.shown))]
    rows = "".join(f"<tr><td>{escape(name)}</td><td>{escape(text)}</td></tr>" for name, text in versions().items())
    return web.fill(
        "report.html",
        {
            "title": escape(title),
            "program": escape(PROGRAM),
            "styles": web.styles("report.css"),
            "when": escape(f"{report.when.day} {report.when:%B %Y, %H:%M}"),
            "version": escape(versions()[PROGRAM]),
            "content": "".join((*overview, *sections)),
            "versions": rows,
            "scripts": web.scripts("report.js"),
        },
    )


def _glance(report: DesignReport) -> str:
    """A card for each design: power, its change, its parts."""
    colours = colours_of(report)
    cards = "".join(_card(report, k, colour) for k, colour in enumerate(colours))
    titles = part_titles(*(entry.solution.design for entry in report.all))
    parts = "".join(f'<span><i style="background:{PARTS[name]}"></i>{title}</span>' for name, title in titles.items())
    return f'<section class="glance"><div class="cards">{cards}</div><p class="parts">{parts}</p></section>'


def _card(report: DesignReport, k: int, colour: str) -> str:
    entry = report.all[k]
    power, design = entry.solution.power, entry.solution.design
    largest = max(sum(max(getattr(other.solution.power, name), 0.0) for name in PARTS) for other in report.all)
    values = {name: max(getattr(power, name), 0.0) for name in PARTS}
    bar = "".join(
        f'<i style="width:{100.0 * value / largest:.3f}%;background:{PARTS[name]}"></i>'
        for name, value in values.items()
    )
    change = tables.change_words(report, entry)
    title = escape(entry.title)
    if entry in report.shown:
        title = f'<a href="#design-{k}">{title}</a>'
    return (
        f'<article class="card" style="--mark:{colour}"><h3>{title}</h3>'
        f'<div class="big"><b data-report="total-power">{report.units.watts(power.total)}</b>'
        f'<span class="dim">{report.units.power[1].text(power.total)}</span>{change}</div>'
        f'<div class="bar">{bar}</div><div>{escape(title_words(design))}</div>'
        f'<div class="dim">{escape(flight_words(design, report.units))}</div></article>'
    )


def _stage(report: DesignReport, stage: EmbeddedViewer | None) -> str:
    if stage is None:
        return ""
    tabs = "".join(
        f'<button type="button" data-scene="{k}">{escape(entry.title)}</button>' for k, entry in enumerate(report.shown)
    )
    shown = FIELDS[report.view.field]
    bar = figures.bar(shown, report.colour_range(shown), "stage-bar")
    return (
        f'<section class="stage"><h2>The rotor in trim</h2>'
        f'<div class="tabs">{tabs if len(report.shown) > 1 else ""}<span class="dim">'
        "Drag to turn, right button to move, wheel to zoom.</span></div>"
        '<iframe id="viewer" title="The rotor in three dimensions"></iframe>'
        f'<div class="scale">{bar}</div>{web.json_block("stage", asdict(stage))}</section>'
    )


def _section(report: DesignReport, k: int) -> str:
    """Everything about one design."""
    entry, colour = report.shown[k], colours_of(report)[k]
    solution = entry.solution
    active = ""
    if words := wave_words(solution.design):
        active = f'<p class="dim">With {escape(words)}.</p>'
    return (
        f'<section class="design" id="design-{k}" style="--mark:{colour}"><h2>{escape(entry.title)}</h2>'
        f'<p class="lead">{escape(title_words(solution.design))}</p>{active}'
        f'<p class="dim">{escape(flight_words(solution.design, report.units))}<br>'
        f"{escape(model_words(solution.design))}</p>"
        f"{_caveats(solution)}"
        f'<div class="tables">{tables.conditions(solution)}{tables.parts(report, entry)}'
        f"{tables.trim(solution)}{tables.vibration(solution)}</div>{tables.blade(solution.design)}"
        f"{figures.disks(report, entry, k)}{figures.along(solution)}{_design_file(solution.design)}</section>"
    )


def _design_file(design: Design) -> str:
    """The design as its file, which the page, the command line and Python open."""
    text = json.dumps(design.to_dict(), indent=1, ensure_ascii=False)
    return f"<details><summary>Design file</summary><pre>{escape(text)}</pre></details>"


def _caveats(solution: Solution) -> str:
    sentences = "".join(f"<li>{escape(caveat.sentence)}</li>" for caveat in solution.caveats)
    if not sentences:
        return (
            '<p class="good">Trimmed: it carries its weight and overcomes its drag, with a residual of '
            f"less than {tiny(solution.residual)} of the weight.</p>"
        )
    return f'<ul class="care">{sentences}</ul>'


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the report is written, 1 when a design does not trim, 2 for bad input."""
    return run_command("explorer report", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    entries = [ReportEntry(Path(file).stem, solve(load_design(file))) for file in options.designs]
    view = ViewState(field=options.field)
    first = entries[0].solution.design
    baseline = ReportEntry(baseline_title(first), solve(baseline_of(first)))
    if options.actuator:
        check_blade(first.aircraft)
    try:
        chosen = judged_actuator(try_actuator(options.actuator, first)) if options.actuator else ""
    except RuntimeError as error:
        print(f"explorer report: {error}", file=sys.stderr)
        return 1
    try:
        report = report_of(baseline, entries, view, actuator=chosen)
    except ValueError as error:
        print(f"explorer report: {error}", file=sys.stderr)
        return 1
    stage = make_stage([entry.solution for entry in report.shown], view, report.colour_range(FIELDS[view.field]))
    try:
        write_whole(options.out, report_html(report, stage))
    except OSError as error:
        raise ValueError(f"cannot write {options.out!r} ({error.strerror}): give a writable file") from None
    print(f"{options.out}: {len(entries)} design{'s' if len(entries) > 1 else ''}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m explorer report",
        description="Designs side by side as one HTML file that opens without a server.",
    )
    parser.add_argument(
        "designs",
        nargs="+",
        metavar="FILE",
        help="design files (JSON); changes count from the first one's baseline twist",
    )
    parser.add_argument("--out", default="report.html", metavar="FILE", help="where to write (default report.html)")
    parser.add_argument(
        "--actuator",
        metavar="ID",
        help="judge it on the first design, hover and µ 0.3 (list: rotor actuator --table 5.1)",
    )
    parser.add_argument(
        "--field", default=ViewState.field, choices=tuple(FIELDS), metavar="NAME", help=f"in 3D: {', '.join(FIELDS)}"
    )
    return parser
