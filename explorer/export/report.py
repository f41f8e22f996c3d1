"""Designs as one HTML file that needs no server and no network: power, trim, 3D, disks, charts.

`python -m explorer report` makes it of design files, without a page and without a browser.
"""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from explorer import web
from explorer.charts.plots import PowerCurves
from explorer.colours import PARTS
from explorer.export import figures, tables
from explorer.export.contents import DesignReport, ReportEntry, colours_of, on_board
from explorer.export.figures import actuator_section
from explorer.export.live import live_html
from explorer.export.provenance import document_html
from explorer.model.inputs import ViewState, baseline_of, baseline_title
from explorer.model.units import Units, number
from explorer.picture.fields import FIELDS
from explorer.scene.still_scene import EmbeddedViewer, make_stage
from explorer.text.design_words import flight_words, model_words, title_words, wave_words
from explorer.text.line import sentence
from explorer.text.readout import part_titles
from explorer.text.status import tiny
from rotor import Solution, load_design, solve
from rotor.support.markup import Markup, group, tag
from rotor.support.terminal import OneLineParser, command_words, run_command
from rotor.support.user_input import check_suffix, write_output
from rotor.trim.doubt import decimals


def report_html(
    report: DesignReport,
    stage: EmbeddedViewer | None,
    curves: PowerCurves | None = None,
    rotor: bytes | None = None,
) -> str:
    """The file's text. `stage`: the 3D scenes of `report.shown`, in their order; `curves`: power already swept;
    `rotor`: the first design as the page drew it, a WebP for paper."""
    several = len(report.shown) > 1
    first = report.entries[0].solution
    title = f"{len(report.shown)} designs compared" if several else title_words(first.design)
    overview = [
        figures.front(report, rotor),
        _glance(report),
        _stage(report, stage),
        tables.comparison(report),
        figures.overview(report, curves or PowerCurves()),
        actuator_section(report.actuator, report.units),
    ]
    sections = [_section(report, k) for k in range(len(report.shown))]
    return document_html(
        title,
        first,
        title if several else report.line or _line(report),
        group(overview, sections),
        "Every design here is trimmed: thrust balances weight and drag, and the parts of power add up to the total.",
        report.when,
        units=report.units,
    )


def _line(report: DesignReport) -> str:
    """Of the first design against the reference."""
    entry, reference = report.entries[0], report.reference.solution
    other = reference if report.comparable(entry) else None
    # The models stand below it, in words.
    return sentence(entry.solution, report.units, other, report.band(entry), models=False)


def _glance(report: DesignReport) -> Markup:
    """A card for each design: power, its change, its parts."""
    cards = [_card(report, k, colour) for k, colour in enumerate(colours_of(report))]
    titles = part_titles(*(entry.solution.design for entry in report.all))
    parts = [
        tag("span", tag("i", style=f"background:{PARTS[name]}"), title)
        for name, title in titles.items()
    ]
    return tag("section.glance", tag("div.cards", cards), tag("p.parts", parts))


def _card(report: DesignReport, k: int, colour: str) -> Markup:
    entry = report.all[k]
    power, design = entry.solution.power, entry.solution.design
    largest = max(
        sum(max(getattr(other.solution.power, name), 0.0) for name in PARTS) for other in report.all
    )
    values = {name: max(getattr(power, name), 0.0) for name in PARTS}
    bar = [
        tag("i", style=f"width:{100.0 * value / largest:.3f}%;background:{PARTS[name]}")
        for name, value in values.items()
    ]
    total = tag("b", report.units.watts(power.total), data_report="total-power")
    band = report.units.power[0].of(report.band(entry).band)
    total += tag("span", f" ± {number(band, decimals(band))}")
    small = tag("span.dim", report.units.other_watts(power.total))
    return tag(
        "article.card",
        tag(
            "h3",
            tag("a", entry.title, href=f"#design-{k}") if entry in report.shown else entry.title,
        ),
        tag("div.big", total, small, tables.change_words(report, entry)),
        tag("div.bar", bar),
        tag("div", title_words(design)),
        tag("div.dim", flight_words(design, report.units)),
        tag("div", on_board(report.driven, report.units)[1])
        if k == 0 and report.driven is not None
        else None,
        style=f"--mark:{colour}",
    )


def _stage(report: DesignReport, stage: EmbeddedViewer | None) -> Markup:
    if stage is None:
        return Markup()
    tabs = [
        tag("button", entry.title, type="button", data_scene=k)
        for k, entry in enumerate(report.shown)
    ]
    hint = tag("span.dim", "Drag to turn, right button to move, wheel to zoom.")
    shown = FIELDS[report.view.field]
    return tag(
        "section.stage",
        tag("h2", "The rotor in trim"),
        tag("div.tabs", tabs if len(report.shown) > 1 else None, hint),
        tag("iframe", id="viewer", title="The rotor in three dimensions"),
        tag("div.scale", figures.bar(shown, report.colour_range(shown), "stage-bar")),
        web.json_block("stage", asdict(stage)),
    )


def _section(report: DesignReport, k: int) -> Markup:
    entry, colour = report.shown[k], colours_of(report)[k]
    solution = entry.solution
    design, active = solution.design, wave_words(solution.design)
    text = json.dumps(design.to_dict(), indent=1, ensure_ascii=False)
    return tag(
        "section.design",
        tag("h2", entry.title),
        tag("p.lead", title_words(design)),
        tag("p.dim", f"With {active}.") if active else None,
        tag("p.dim", flight_words(design, report.units), tag("br"), model_words(design)),
        _caveats(solution, report.units),
        figures.disks(report, entry, k),
        tag(
            "div.tables",
            tables.conditions(solution),
            tables.trim(solution),
            tables.vibration(solution),
            tables.doubts(report, entry),
        ),
        tables.blade(design),
        figures.along(solution),
        tag("details", tag("summary", "Design file"), tag("pre", text)),
        id=f"design-{k}",
        style=f"--mark:{colour}",
    )


def _caveats(solution: Solution, units: Units) -> Markup:
    if solution.caveats:
        sentences = (units.in_power_unit(caveat.sentence) for caveat in solution.caveats)
        return tag("ul.care", [tag("li", sentence) for sentence in sentences])
    sentence = f"Trimmed: it carries its weight and overcomes its drag, within {tiny(solution.residual)} of the weight."
    return tag("p.good", sentence)


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the report is written, 1 when a design does not trim, 2 for bad input."""
    return run_command("explorer report", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    check_suffix(options.out, ".html")
    if options.live:
        if len(options.designs) > 1:
            raise ValueError(
                f"--live takes one design, not {len(options.designs)}: make a file of each"
            )
        html = live_html(solve(load_design(options.designs[0])))
        write_output(options.out, html)
        print(f"{options.out}: {len(html) / 1e3:.0f} kB")
        return 0
    entries = [ReportEntry(Path(file).stem, solve(load_design(file))) for file in options.designs]
    view = ViewState(field=options.field)
    first = entries[0].solution.design
    baseline = ReportEntry(baseline_title(first), solve(baseline_of(first)))
    try:
        report = DesignReport(baseline, entries, view)
    except ValueError as error:
        print(f"explorer report: {error}", file=sys.stderr)
        return 1
    stage = make_stage(
        [entry.solution for entry in report.shown], view, report.colour_range(FIELDS[view.field])
    )
    write_output(options.out, report_html(report, stage))
    print(f"{options.out}: {len(entries)} design{'s' if len(entries) > 1 else ''}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=command_words("explorer", "rotor-explorer") + " report",
        description="Write designs side by side as one HTML file that opens without a server.",
        examples=(
            ("Two designs", "a.json b.json --out report.html"),
            ("One whose twist can be dragged", "a.json --live --out page.html"),
        ),
    )
    words = "design files; changes are relative to the baseline twist of the first"
    parser.add_argument("designs", nargs="+", metavar="FILE", help=words)
    words = "a page that travels: the sliders of one design's twist work in the file"
    parser.add_argument("--live", action="store_true", help=words)
    parser.add_argument(
        "--out", default="report.html", metavar="FILE", help="file to write (default report.html)"
    )
    words = f"field on the 3D disk: {', '.join(FIELDS)}"
    parser.add_argument(
        "--field", default=ViewState.field, choices=tuple(FIELDS), metavar="NAME", help=words
    )
    return parser
