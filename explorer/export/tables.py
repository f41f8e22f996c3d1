"""Tables of the report as HTML: the comparison of designs, and condition, power, trim and twist of each."""

import math
from collections.abc import Callable, Iterable

import numpy as np

from explorer.charts.doubt import MOST_ROWS
from explorer.colours import PARTS
from explorer.export.contents import DesignReport, ReportEntry, on_board
from explorer.model.stand import stand_of
from explorer.model.units import TONNE, Units, degrees, number
from explorer.text.design_words import inflow_words, physics_words, stand_words, twist_name
from explorer.text.readout import change_kind, ideal_induced, index_unit, part_change, part_titles
from explorer.text.status import section_title
from rotor import Design, Solution, hub_loads
from rotor.aero.problem import grid_of
from rotor.support.markup import Content, Markup, group, tag
from rotor.trim import why_no_hub_loads
from rotor.trim.doubt import DoubtRow, decimals

STATIONS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0)
"""r/R of the twist table; the root cut-out comes before them."""
Row = tuple[Content, Content]


def change_words(report: DesignReport, entry: ReportEntry) -> Markup:
    """Change of total power against the reference, where the flight condition is the same; none for one design."""
    reference = report.reference
    if report.comparable(entry) and entry is report.entries[0] and report.driven is not None:
        words, _, kind = on_board(report.driven, report.units)
        return tag("span.change", words, class_=kind or None, data_report="on-board")
    if report.is_reference(entry):
        return tag("span.change.dim", "reference") if len(report.all) > 1 else Markup()
    if not report.comparable(entry):
        return tag("span.change.dim", "other flight condition")
    change = entry.solution.power.total - reference.solution.power.total
    words = report.band(entry).saving_words or tag("span.dim", "a free rotor takes no power")
    return tag("span.change", words, class_=change_kind(change, report.band(entry).sureness))


def comparison(report: DesignReport) -> Markup:
    """Every design in a column, the reference last; differences beside the powers."""
    elsewhere = [entry.title for entry in report.entries if not report.comparable(entry)]
    note = (
        f"{', '.join(elsewhere)}: in another flight condition than {report.reference.title}, "
        "so the blade alone does not explain the power difference."
    )

    def compared(name: str) -> list[Content]:
        return [_with_change(report, entry, name) for entry in report.all]

    designs = [entry.solution.design for entry in report.all]
    head = tag("tr", tag("th"), [tag("th", entry.title) for entry in report.all])
    # [px]; a wider table scrolls.
    width = 170 + round(len(report.all) * min(max(890 / len(report.all), 150), 230))
    rows = [
        _row("Twist", [twist_name(design) for design in designs], "words"),
        _row("Speed", [_speed(design, report.units) for design in designs]),
        _row("Mass, altitude", [_weight(design, report.units) for design in designs]),
        _row(
            "Model",
            [_below(inflow_words(d), f"{d.preset}, {physics_words(d)}") for d in designs],
            "words",
        ),
        _row(tag("b", "Total power"), compared("total"), "total"),
        *(
            _row(_named(name, title), compared(name))
            for name, title in part_titles(*designs).items()
        ),
        _row("Main rotor", compared("main_rotor")),
        _row(
            "Least induced, any circulation",
            [_least_induced(entry.solution, report.units) for entry in report.all],
        ),
        _row("Induced factor κ", [number(e.solution.induced_power_factor, 3) for e in report.all]),
        _row("Efficiency", [_efficiency_number(e.solution, "FM ", "L/De ") for e in report.all]),
        _row(
            "Separated area", [f"{number(100 * e.solution.stalled_area, 1)} %" for e in report.all]
        ),
    ]
    return tag(
        "section.comparison",
        tag("h2", "Side by side" if len(report.all) > 1 else "Power"),
        tag(
            "div.wide",
            tag("table", tag("thead", head), tag("tbody", rows), style=f"--wide:{width}px"),
        ),
        tag("p.note", note) if elsewhere else None,
        tag("p.note", f"{report.entries[0].title}: without the mass of its actuator.")
        if report.driven
        else None,
    )


def conditions(solution: Solution) -> Markup:
    """Air, rotor and grid; the flight and the models stand above."""
    design = solution.design
    rotor = design.rotor
    rows: list[Row] = [
        ("Air density", f"{number(design.condition.density, 4)} kg/m³"),
        ("Radius, tip speed", f"{number(rotor.radius, 3)} m, {number(rotor.tip_speed, 1)} m/s"),
        ("Blades, solidity", f"{rotor.blades}, {number(rotor.solidity, 4)}"),
        ("Grid", "{} elements × {} azimuths".format(*grid_of(design))),
    ]
    return _table("Air and rotor", rows)


def trim(solution: Solution) -> Markup:
    c = solution.controls
    stalled = [number(100 * part, 1) for part in (solution.stalled_area, solution.stalled_thrust)]
    rows: list[Row] = [
        ("Collective θ0, at 0.75 R", degrees(c.collective)),
        ("Cyclic θ1c, θ1s", f"{degrees(c.cyclic_1c)}, {degrees(c.cyclic_1s)}"),
        ("Shaft tilt α, forward", degrees(c.shaft_tilt)),
        ("Coning β0", degrees(c.coning)),
        ("Flapping β1c, β1s", f"{degrees(c.flap_1c)}, {degrees(c.flap_1s)}"),
        ("Mean induced inflow λ0", number(c.lambda0, 5)),
        ("CT, CT/σ", f"{number(solution.ct, 5)}, {number(solution.ct_over_sigma, 4)}"),
        ("CP", number(solution.cp, 6)),
        ("κ = Pi/(CT·λ0)", number(solution.induced_power_factor, 3)),
        (
            "Figure of merit" if solution.design.hovering else "Rotor L/De",
            _efficiency_number(solution),
        ),
        ("Reverse flow", f"{number(100 * solution.reverse_flow_area, 1)} % of the disk"),
        ("Separated", f"{stalled[0]} % of the disk, {stalled[1]} % of the thrust"),
        (
            "Past the static angle, attached",
            f"{number(100.0 * solution.past_static_area, 1)} % of the disk",
        ),
    ]
    return _table("Trim", rows)


def doubts(report: DesignReport, entry: ReportEntry) -> Markup:
    """How sure power is, and its change from the reference, each above its causes."""
    band, unit = report.band(entry), report.units.power[0]

    def causes(title: str, words: str, whole: float, of: Callable[[DoubtRow], float]) -> Markup:
        """The whole band, its largest causes, and the rest as one."""
        named = [(f"{row.words} ± {row.size_words}", abs(of(row))) for row in band.rows]
        named.sort(key=lambda one: -one[1])
        sizes = [(words, whole), *named[:MOST_ROWS]]
        if rest := named[MOST_ROWS:]:
            sizes.append((f"{len(rest)} smaller causes", math.hypot(*(size for _, size in rest))))
        # No line ends between a number and its unit.
        bands = [
            f"± {unit.text(size, decimals(unit.of(size)))}".replace(" ", "\u00a0")
            for _, size in sizes
        ]
        return _table(title, zip([name for name, _ in sizes], bands, strict=True))

    power = causes("Uncertainty of power", "Power", band.band, lambda row: row.power)
    within = band.change_band
    if band.sureness is None or within is None:
        return power
    words = f"Change: {band.sureness}"
    change = causes("Uncertainty of the change", words, within, lambda row: row.change or 0.0)
    return group(power, change)


def vibration(solution: Solution) -> Markup:
    """Loads on the hub and frequencies of blades that bend; nothing for others."""
    if not solution.design.models.bending:
        return Markup()
    rows: list[Row] = []
    if (frequencies := solution.blade_frequencies) is not None:
        for name, values in vars(frequencies).items():
            rows.append(
                (
                    f"Blade in {name}",
                    f"{', '.join(number(value, 2) for value in values[:3])} per rev",
                )
            )
    if (reason := why_no_hub_loads(solution.design)) is not None:
        rows.append(("Hub loads", reason.sentence))
    elif (loads := hub_loads(solution)) is not None:
        low, high = loads.band or (loads.index, loads.index)
        force, moment = (
            ", ".join(number(size) for name, size in loads.amplitudes.items() if name[0] == kind)
            for kind in "fm"
        )
        rows += [
            (f"Fx, Fy, Fz at {loads.per_rev}/rev", f"{force} N"),
            (f"Mx, My at {loads.per_rev}/rev", f"{moment} N m"),
            ("Vibration index", f"{number(loads.index, 1)} {index_unit(solution.design)}"),
            (
                "Range over inflow models",
                f"{number(low, 1)} … {number(high, 1)} %: trade-offs, not a level",
            ),
            ("Weights of Fx, Fy, Fz", "0.5, 0.67, 1; moments divided by the radius"),
        ]
    return _table("Vibration", rows)


def blade(design: Design) -> Markup:
    """Twist, zero at 0.75 R, chord and section at given stations."""
    shape = design.rotor.blade
    stations = [shape.root_cutout, *(r for r in STATIONS if r > shape.root_cutout)]
    angles = np.degrees(design.twist(np.array(stations)))
    places = [shape.section_at(r) for r in stations]
    ratios = [tuple(shape.installed(name).chord_ratio for name in place[:2]) for place in places]
    shares = [
        inner + place[2] * (outer - inner)
        for place, (inner, outer) in zip(places, ratios, strict=True)
    ]
    chords = shape.chord(stations) * np.array(shares)  # Of the section itself, as in the STL.
    sections = [section_title(inner) if inner == outer else "blended" for inner, outer, _ in places]
    rows = [
        _row("Built-in twist [°]", [number(angle, 2, sign=True) for angle in angles]),
        _row("Chord [m]", [number(chord, 3) for chord in chords]),
        _row("Section", sections, "words"),
    ]
    head = tag("tr", tag("th", "r/R"), [tag("th", number(r, 2)) for r in stations])
    table = tag("table", tag("thead", head), tag("tbody", rows))
    return group(tag("h3", "Blade"), tag("div.wide.blade", table))


def _table(title: str, rows: Iterable[Row]) -> Markup:
    """Two columns under a title."""
    body = [tag("tr", tag("td", name), tag("td", value)) for name, value in rows]
    return tag("div", tag("h3", title), tag("table", body))


def _row(name: Content, cells: Iterable[Content], kind: str = "") -> Markup:
    return tag("tr", tag("td", name), [tag("td", cell) for cell in cells], class_=kind)


def _named(part: str, title: str) -> Markup:
    """The name of a part of the power behind its colour."""
    return tag("i", style=f"background:{PARTS[part]}") + title


def _below(first: str, second: str) -> Markup:
    """A value, and a smaller line below it."""
    return group(first, tag("br"), tag("small", second))


def _with_change(report: DesignReport, entry: ReportEntry, name: str) -> Content:
    """A part of power, and below it the change from the reference with its band; none in another flight."""
    power, units, band = entry.solution.power, report.units, report.band(entry)
    words = units.watts(getattr(power, name), 1)
    if band.change is None:
        return words
    change, word = part_change(name, power, report.reference.solution.power, band, units)
    return _below(words, f"{change} {units.power[0].symbol}{word and f': {word}'}")


def _least_induced(solution: Solution, units: Units) -> str:
    ideal = ideal_induced(solution)
    return "not available" if ideal is None else units.watts(ideal, 1)


def _speed(design: Design, units: Units) -> Content:
    climb = ", ".join(units.unusual(design))
    if design.hovering:
        return _below("hover", climb) if climb else "hover"
    speed = units.speed[0].text(design.airspeed) + (f", {climb}" if climb else "")
    return _below(f"µ {number(design.condition.advance_ratio, 3)}", speed)


def _weight(design: Design, units: Units) -> Content:
    if (stand := stand_of(design)) is not None:
        return stand_words(stand)
    mass = units.mass.text(design.condition.mass, 2 if units.mass is TONNE else 0)
    return _below(mass, units.altitude.text(design.condition.altitude))


def _efficiency_number(solution: Solution, merit: str = "", ratio: str = "") -> str:
    """Figure of merit in hover, lift to drag in flight, after their names."""
    if solution.design.hovering:
        return merit + number(solution.figure_of_merit, 3)
    return ratio + number(solution.lift_to_drag, 2)
