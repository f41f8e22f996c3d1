"""Reports, tables, files of the blade and pages that travel."""

from datetime import UTC, datetime
from typing import Any

from .designs import solve_named
from .pictures import units_by_title
from .record import Record, named

WHEN = datetime(2024, 2, 29, 12, 0, tzinfo=UTC)
EXPORTED = (
    "as built", "hover", "fast", "bent", "2/rev twist", "thesis", "bo105", "tunnel, tilted", "free rotor", "slow",
    "twist points:8,2,-6@0.2,0.6,1",
)  # fmt: skip
TRAVELLING = (
    "twist linear:-8",
    "twist segments:-14,-8@0.5",
    "twist quadratic:6,-14",
    "hover, linear",
    "thesis",
)
"""Designs of which a page is made that works without a server; of others it says why not."""


def write(record: Record) -> None:
    """What can be saved of each design, and reports of several."""
    solved = solve_named(record, EXPORTED)
    reference = solved["as built"]
    for name, solution in solved.items():
        record.scenario(f"{name}/tables", save_tables, name, solution, reference)
    record.scenario("reports", make_reports, solved)
    for name, solution in solve_named(record, TRAVELLING, "page of ").items():
        for title, units in units_by_title().items():
            record.ask(f"{name}/{title}", "explorer.export.live.live_html", solution, units)


def save_tables(record: Record, name: str, solution: Any, reference: Any) -> None:
    """Tables, names of files and the blade's shape."""
    export = "explorer.export"
    design = solution.design
    curve = named("explorer.charts.plots.PowerCurves")().known(design, reference.design)
    record.ask(f"{name}/disk.csv", f"{export}.provenance.disk_csv", solution)
    record.ask(
        f"{name}/blade.csv", f"{export}.provenance.blade_csv", solution, reference.design, 65.0
    )
    record.ask(
        f"{name}/power.csv", f"{export}.provenance.power_csv", solution, reference.design, curve
    )
    record.ask(f"{name}/condition", f"{export}.provenance.condition_line", design)
    record.ask(f"{name}/provenance", f"{export}.provenance.provenance_lines", solution)
    record.ask(f"{name}/file name", f"{export}.provenance.file_name", design, "-report.html")
    record.ask(f"{name}/stl", f"{export}.blade.blade_stl", design)
    record.ask(f"{name}/kinks", f"{export}.blade.kinks", design.twist)
    record.ask(f"{name}/conditions", f"{export}.tables.conditions", solution)
    record.ask(f"{name}/trim", f"{export}.tables.trim", solution)
    record.ask(f"{name}/vibration", f"{export}.tables.vibration", solution)
    record.ask(f"{name}/blade", f"{export}.tables.blade", design)
    record.ask(f"{name}/along", f"{export}.figures.along", solution)
    record.ask(f"{name}/saved design", "rotor.Design.to_dict", design)
    record.ask(f"{name}/link", "explorer.sharing.share.code_of", design)


def make_reports(record: Record, solved: dict[str, Any]) -> None:
    """One design, and several side by side; in each unit system."""
    entry = named("explorer.export.contents.ReportEntry")
    first, second, third = (solved[name] for name in ("fast", "as built", "hover"))
    groups = {
        "one design": [("Now", first)],
        "three designs": [("Now", first), ("Kept <1>", second), ("Hover", third)],
        "free rotor": [("Free", solved["free rotor"])],
        "bent": [("Bent", solved["bent"])],
    }
    stage = record.make(
        "stage", "explorer.scene.still_scene.EmbeddedViewer", "a", "b", "c", ("d", "e", "f")
    )
    for title in units_by_title():
        view = record.make(f"view in {title}", "explorer.model.inputs.ViewState", units=title)
        for name, designs in groups.items():
            place = f"report of {name} in {title}"
            entries = [entry(*one) for one in designs]
            reference = entry("As built", designs[0][1] if name == "free rotor" else second)
            report = record.make(
                place, "explorer.export.contents.DesignReport", reference, entries, view, when=WHEN
            )
            record.ask(place, "explorer.export.report.report_html", report, stage)
