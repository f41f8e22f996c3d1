"""The files that a session saves, as names and bytes: shapes, tables, the report."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from explorer.charts.plots import Range
from explorer.charts.power_curve import PowerCurves
from explorer.export.blade import blade_stl, flown_design, rotor_glb
from explorer.export.disk_drawing import disk_svg
from explorer.export.provenance import blade_csv, disk_csv, file_stem, power_csv
from explorer.export.report.contents import DesignReport, JudgedActuator, ReportEntry, report_of
from explorer.export.report.document import report_html
from explorer.model.inputs import baseline_title
from explorer.model.session_state import SessionState
from explorer.model.undo import KeptDesign
from explorer.model.units import UNITS
from explorer.picture.fields import shown_field
from explorer.picture.picture import marks_of
from explorer.scene.still_scene import EmbeddedViewer, scene_page
from explorer.text.design_words import flight_words, title_words
from explorer.text.readout import fineness


@dataclass(frozen=True)
class File:
    """A file to be saved."""

    name: str
    content: bytes

    @property
    def size(self) -> str:
        """The size as text."""
        count = len(self.content)
        return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{max(count / 1e3, 1.0):.0f} kB"


def jig_file(state: SessionState) -> File:
    """One blade in jig shape as STL, for manufacture."""
    design = state.solution.design
    return File(f"{file_stem(design, 'blade', 'jig')}.stl", blade_stl(design))


def flown_file(state: SessionState) -> File:
    """The reference blade as flown at its azimuth as STL."""
    solution, azimuth = state.solution, state.view.azimuth_deg
    name = file_stem(solution.design, "blade", "flown", f"psi{azimuth:.0f}")
    return File(f"{name}.stl", blade_stl(flown_design(solution, math.radians(azimuth))))


def rotor_file(state: SessionState) -> File:
    """The rotor in trim as GLB."""
    solution = state.solution
    return File(f"{file_stem(solution.design, 'rotor')}.glb", rotor_glb(solution, state.view.azimuth_deg))


def disk_file(state: SessionState) -> File:
    """Every field over the disk as CSV."""
    return File(f"{file_stem(state.solution.design, 'disk')}.csv", disk_csv(state.solution))


def along_file(state: SessionState) -> File:
    """The blade at the marked azimuth as CSV."""
    azimuth = state.view.azimuth_deg
    content = blade_csv(state.solution, state.reference.design, azimuth)
    return File(f"{file_stem(state.solution.design, 'blade', f'psi{azimuth:.0f}')}.csv", content)


def power_file(state: SessionState, curves: PowerCurves) -> File:
    """Power over advance ratio as CSV."""
    design, reference = state.solution.design, state.reference.design
    curves.sweep(design, reference, lambda: False)
    content = power_csv(state.solution, reference, curves.known(design, reference))
    return File(f"{file_stem(design, 'power')}.csv", content)


def session_report(
    state: SessionState, kept: Sequence[KeptDesign], colour_range: Range, actuator: JudgedActuator | str = ""
) -> DesignReport:
    """The report of the present and the kept designs, compared with A or the baseline, and of the actuator chosen."""
    pinned, solution = state.pinned, state.solution
    if state.pin is None:
        reference = ReportEntry(baseline_title(solution.design), state.baseline)
    else:
        # A may not converge in the present flight condition; then its own solution is used.
        flies = pinned is not None and pinned.converged
        reference = ReportEntry("A, pinned", pinned if pinned is not None and flies else state.pin.solution)
    others = [item for item in kept if item.solution.design not in (solution.design, reference.solution.design)]
    entries = [
        ReportEntry("Now", solution),
        *(ReportEntry(f"Kept {k + 1}", item.solution) for k, item in enumerate(others)),
    ]
    return report_of(
        reference,
        entries,
        state.view,
        {state.view.field: colour_range},
        own_section=state.pin is not None,
        actuator=actuator,
    )


def scene_file(state: SessionState, colour_range: Range) -> File:
    """The rotor in trim as one HTML page to be turned with the mouse, without a server."""
    solution, view = state.solution, replace(state.view, difference=False)
    design, units = solution.design, UNITS[view.units]
    powers = units.watts(solution.power.total, fineness(solution.power))
    line = f"{powers} · {flight_words(design, units)} · {view.field} on the disk"
    times = f" · twist exaggeration × {view.exaggeration:g}" if view.exaggeration != 1.0 else ""
    page = scene_page(solution, view, colour_range, title_words(design), line + times)
    return File(f"{file_stem(design, 'scene')}.html", page.encode("utf-8"))


def report_file(report: DesignReport, stage: EmbeddedViewer | None, curves: PowerCurves) -> File:
    """The report as one HTML file."""
    name = file_stem(report.entries[0].solution.design, "report")
    return File(f"{name}.html", report_html(report, stage, curves).encode("utf-8"))


def disk_drawing_file(state: SessionState, colour_range: Range) -> File:
    """The disk from above as SVG, as the page colours and marks it."""
    view, solution = state.view, state.solution
    field = shown_field(view, state.pinned)
    drawing = disk_svg(solution, field, colour_range, marks_of(view), UNITS[view.units])
    return File(f"{file_stem(solution.design, 'disk', field.title)}.svg", drawing.encode("utf-8"))
