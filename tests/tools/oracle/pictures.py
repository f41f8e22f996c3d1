"""Charts, disks, blades, wakes, cameras and probes: as data, and as the SVG or PNG that is sent."""

import math
from collections.abc import Mapping
from typing import Any

from .designs import solve_named
from .record import Record, named

CHARTED = (
    "as built", "hover", "slow", "fast", "bent", "bent, 3/rev", "2/rev twist", "2 and 3/rev pitch", "climbing",
    "thesis", "thesis, hover", "few stations", "without dynamic-stall", "without flapping",
    "twist segments:-4,-16,-8@0.4,0.8", "bo105", "r22, hover", "gazelle", "tunnel, tilted", "free rotor",
    "stand, hover", "hart2",
)  # fmt: skip
"""Designs that are drawn."""
SWEPT = (
    "as built",
    "inflow drees",
    "hover, linear",
    "descending",
    "bo105",
    "r22",
    "thesis, linear",
    "free rotor",
)
"""Designs whose power is drawn over advance ratio, each beside the one before it."""
PLACES = ((0.25, 270.0), (0.4, 300.0), (0.5, 0.0), (0.75, 65.0), (0.87, 180.0), (0.99, 90.0))
"""r/R and azimuth [°] of sections that are probed."""
ACTUATORS = ("MFC_P1", "MFC_P2", "SMA_tube")
VIEWS = ("3d", "disk", "top", "blade", "side")
REGIONS = (
    "reverse_flow_segments",
    "separated_segments",
    "past_static_segments",
    "drag_divergence_segments",
)


def write(record: Record) -> None:
    """Pictures of each design, of pairs, and those of no design."""
    solved = solve_named(record, CHARTED)
    view = named("explorer.model.inputs.ViewState")()
    before = solved["as built"]
    for name, solution in solved.items():
        record.scenario(f"{name}/rotor", draw_rotor, name, solution, view)
        record.scenario(f"{name}/disk", draw_disk, name, solution, view)
        record.scenario(f"{name}/lines", draw_lines, name, solution, before)
        record.scenario(f"{name}/sections", probe, name, solution)
    record.scenario("curves", draw_curves, solve_named(record, SWEPT, "curve of "))
    record.scenario("actuators", draw_actuators, before)
    record.scenario("colours", draw_colours)


def draw_rotor(record: Record, name: str, solution: Any, view: Any) -> None:
    """Poses and shapes of the blades, the airframe, the inset, the wake, and where cameras stand."""
    picture = "explorer.picture"
    design = solution.design
    for azimuth in (0.0, 65.0, 270.0):
        turned = record.make(
            f"{name}/view at {azimuth}", "explorer.model.inputs.ViewState", azimuth_deg=azimuth
        )
        record.ask(
            f"{name}/picture at {azimuth}", f"{picture}.picture.make_picture", solution, turned
        )
    shape = record.ask(f"{name}/blade shape", f"{picture}.blade_mesh.blade_shape", design.rotor)
    form = record.ask(f"{name}/form", f"{picture}.picture.flown_form", solution, view, 1.0)
    if form is not None:
        record.ask(f"{name}/vertices", form.vertices, shape)
    record.ask(f"{name}/airframe", f"{picture}.airframe.airframe", design.rotor, design.tail_rotor)
    record.ask(f"{name}/head", f"{picture}.airframe.rotor_head", design.rotor)
    record.ask(f"{name}/mast", f"{picture}.airframe.mast", design.rotor.radius)
    record.ask(f"{name}/sides", f"{picture}.disk_image.sides", design)
    built = design.rotor.builtin_twist
    record.ask(
        f"{name}/inset",
        f"{picture}.blade_mesh.inset_sections",
        design.rotor,
        design.twist,
        built,
        4.0,
    )
    record.ask(
        f"{name}/overlay",
        f"{picture}.blade_mesh.overlay_segments",
        design.rotor,
        built,
        design.twist,
        4.0,
        1e-3,
    )
    record.ask(f"{name}/path", f"{picture}.wake.tip_vortex_path", solution)
    record.ask(f"{name}/vortices", f"{picture}.wake.tip_vortices", solution, (0.0, 1.0, 4.0))
    record.ask(f"{name}/motion", "explorer.scene.controller.motion_of", solution)
    for place in VIEWS:
        tilt = solution.controls.shaft_tilt
        record.ask(
            f"{name}/camera {place}",
            f"{picture}.camera_views.fit",
            place,
            design.rotor.radius,
            1.5,
            0.6,
            tilt,
        )
    for origin in ((0.0, 0.0, 20.0), (3.0, 2.0, 15.0)):
        record.ask(
            f"{name}/pick {origin}",
            f"{picture}.camera_views.pick",
            solution,
            origin,
            (0.1, 0.2, -1.0),
        )
        record.ask(
            f"{name}/pick blade {origin}",
            f"{picture}.camera_views.pick_blade",
            solution,
            view,
            origin,
            (0.1, 0.2, -1.0),
        )


def draw_disk(record: Record, name: str, solution: Any, view: Any) -> None:
    """The disk coloured by each field: its range, numbers, outlines and picture."""
    picture = "explorer.picture"
    fields = named("explorer.picture.fields.FIELDS")
    marks = record.ask(f"{name}/marks", f"{picture}.picture.marks_of", view)
    record.ask(f"{name}/fields", f"{picture}.fields.fields_of", solution)
    for region in named("explorer.picture.plan.REGIONS"):
        record.ask(f"{name}/{region} share", f"{picture}.plan.region_words", solution, region)
    record.ask(f"{name}/around", f"{picture}.plan.around_chart", solution)
    record.ask(f"{name}/key", "explorer.charts.svg.key_entries", solution)
    for region in REGIONS:
        record.ask(f"{name}/{region}", f"{picture}.plan.{region}", solution)
    for title, field in fields.items():
        if not field.exists(solution):
            continue
        place = f"{name}/{title}"
        ends = record.ask(
            f"{place}/range", f"{picture}.fields.usual_range", field, solution.design.rotor
        )
        values = record.ask(f"{place}/values", f"{picture}.picture.field_values", solution, field)
        record.ask(f"{place}/fitted", f"{picture}.fields.fitted_range", field, values)
        record.ask(f"{place}/beyond", f"{picture}.fields.over_range", values, ends)
        record.ask(
            f"{place}/numbers", f"{picture}.disk_numbers.disk_numbers", solution, field, ends, marks
        )
    field = fields[view.field]
    ends = (field.low, field.high)
    record.ask(f"{name}/png", f"{picture}.picture.page_disk_png", solution, field, ends, view, 256)
    record.ask(f"{name}/plan", f"{picture}.plan.plan", solution, view, field, ends, True)
    record.ask(f"{name}/drawing", "explorer.charts.svg.disk_drawing", solution, field, ends, 128)
    record.ask(f"{name}/bar", "explorer.charts.svg.bar_drawing", field, ends, 200.0, "bar")


def draw_lines(record: Record, name: str, solution: Any, before: Any) -> None:
    """Keep charts along the blade, alone and beside another design, with measured points and bands of doubt."""
    charts = "explorer.charts"
    for azimuth in (65.0, 270.0):
        for other, reference in (("alone", None), ("beside", before)):
            ask_chart(
                record,
                f"{name}/alpha at {azimuth}, {other}",
                f"{charts}.strip.alpha_chart",
                solution,
                reference,
                azimuth,
            )
    ask_chart(record, f"{name}/lift", f"{charts}.strip.lift_chart", solution, before)
    measured = record.make(f"{name}/measured", f"{charts}.measured.MeasuredChart")
    flown = record.make(f"{name}/flights", f"{charts}.measured.FlownPowers")
    record.ask(f"{name}/source", f"{charts}.measured.source_of", solution.design)
    points = record.ask(f"{name}/points", measured.chart, solution)
    keep_chart(record, f"{name}/points", points)
    band = record.make(f"{name}/doubt", "rotor.doubt", solution, before)
    for title, units in units_by_title().items():
        record.ask(f"{name}/{title}/marks", flown.marks, solution, units)
        record.ask(f"{name}/{title}/doubt rows", f"{charts}.doubt.doubt_rows", band, units)


def probe(record: Record, name: str, solution: Any) -> None:
    """Sections at a few places of the disk, and what was measured there."""
    for r, degrees in PLACES:
        place = f"{name}/section {r} at {degrees}"
        here = record.ask(
            place, "explorer.picture.element.probe", solution, r, math.radians(degrees)
        )
        for opened in (False, True):
            record.ask(
                f"{place}/panel {opened}",
                "explorer.charts.probe_drawing.probe_panel",
                here,
                solution,
                opened,
            )
        ask_chart(record, f"{place}/lift", "explorer.charts.probe_measured.lift_chart", here)
        beside = record.ask(
            f"{place}/airloads", "explorer.charts.probe_measured.airload_comparison", solution, r
        )
        if beside is not None:
            record.ask(
                f"{place}/measured",
                "explorer.charts.probe_measured.measured_panel",
                beside,
                math.radians(degrees),
            )
    record.ask(f"{name}/ride", "explorer.picture.ride.turn_of", solution, 0.75, 30.0)


def draw_curves(record: Record, solved: Mapping[str, Any]) -> None:
    """Power over advance ratio, and its change from another design's."""
    strip = "explorer.charts.strip"
    curves = named("explorer.charts.plots.PowerCurves")()
    reference = None
    for name, solution in solved.items():
        design = solution.design
        other = reference or design
        for _ in curves.sweep(design, other):
            pass
        curve = record.ask(f"{name}/curve", curves.known, design, other)
        mu = design.condition.advance_ratio
        change = 1234.5 if reference else 0.0
        bands = record.ask(
            f"{name}/bands", "explorer.charts.curve_bands.curve_bands", design, reference
        )
        for title, units in units_by_title().items():
            place = f"{name}/{title}"
            total = ask_chart(
                record,
                f"{place}/total",
                f"{strip}.total_power_chart",
                curve,
                mu,
                solution.power.total,
                units,
                design=design,
            )
            ask_chart(
                record,
                f"{place}/change",
                f"{strip}.power_change_chart",
                curve,
                mu,
                change,
                "A",
                units,
                band=800.0,
            )
            ask_chart(record, f"{place}/banded", f"{strip}.with_band", total, bands, units)
            marked = record.make(f"{place}/speeds", f"{strip}.with_speeds", total, curve, design)
            if marked is not None:
                keep_chart(record, f"{place}/speeds", marked[0])
                record.keep(f"{place}/fastest", marked[1])
        reference = design


def draw_actuators(record: Record, solution: Any) -> None:
    """The blade with each kind of actuator, out of the rotor."""
    design = solution.design
    for id in ACTUATORS:
        for drives in ((0.0,) * 5, (77.0, 30.0, 50.0, 0.0, 100.0)):
            name = f"{id} at {drives[0]}"
            inputs = record.make(
                f"{name}/inputs", "explorer.model.actuator_inputs.ActuatorInputs", id, drives=drives
            )
            installed = record.ask(f"{name}/installed", inputs.installed, design.rotor)
            record.ask(
                f"{name}/picture",
                "explorer.picture.lifted_picture.lifted_picture",
                inputs,
                installed,
                design,
            )
            record.ask(f"{name}/reach", inputs.reach, installed)
            record.ask(f"{name}/flown", lambda inputs=inputs: str(inputs.apply(design)))
    record.ask(
        "lifted camera", "explorer.picture.lifted_blade.fit_lifted", design.rotor.radius, 1.5
    )


def draw_colours(record: Record) -> None:
    """Colours, palettes and the drawings of twist concepts."""
    colours = named("explorer.colours")
    for name, value in sorted(vars(colours).items()):
        if name.isupper():
            record.keep(f"colours/{name}", value)
    for name, concept in named("rotor.optimisation.concepts.CONCEPTS").items():
        record.ask(f"concept {name}", "explorer.charts.concept.concept_picture", concept)
    for title, field in named("explorer.picture.fields.FIELDS").items():
        record.ask(
            f"palette of {title}", "explorer.picture.disk_image.palette", field.colours, None
        )


def ask_chart(record: Record, name: str, path: str, *arguments: Any, **options: Any) -> Any:
    """The chart that a function returns, which is kept as of `keep_chart`; None where there is none."""
    chart = record.make(name, path, *arguments, **options)
    keep_chart(record, name, chart)
    return chart


def keep_chart(record: Record, name: str, chart: Any) -> None:
    """Keep a chart as the page's script takes it, and as SVG; nothing where there is none."""
    if chart is None:
        return
    record.ask(f"{name}/drawn", "rotor.support.chart.drawn_chart", chart)
    record.ask(f"{name}/svg", "rotor.support.chart_svg.svg", chart)


def units_by_title() -> Mapping[str, Any]:
    """The unit systems of the page."""
    return named("explorer.model.units.UNITS")
