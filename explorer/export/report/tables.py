"""Tables of the report as HTML: the comparison of designs, and condition, power, trim and twist of each."""

from collections.abc import Callable
from html import escape

import numpy as np

from explorer.charts.vibration import index_unit
from explorer.colours import PARTS
from explorer.export.report.contents import DesignReport, ReportEntry
from explorer.model.inputs import PRESET_TITLES
from explorer.model.stand import stand_of
from explorer.model.units import FOOT, FOOT_PER_MINUTE, KILOGRAM, METRE, POUND, SI, TONNE, Units, degrees, number
from explorer.text.design_words import inflow_words, physics_words, stand_words, twist_words
from explorer.text.readout import ideal_induced, part_titles
from explorer.text.status import section_title
from rotor import Design, Solution
from rotor.aero.problem import grid_of
from rotor.trim import why_no_hub_loads

STATIONS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0)
"""r/R of the twist table; the root cut-out comes before them."""
Row = tuple[str, str]


def change_words(report: DesignReport, entry: ReportEntry) -> str:
    """Change of total power against the reference, where the flight condition is the same."""
    reference = report.reference
    if entry is reference:
        return '<span class="change dim">reference</span>'
    if not report.comparable(entry):
        return '<span class="change dim">other flight condition</span>'
    change = 100.0 * (entry.solution.power.total / reference.solution.power.total - 1.0)
    kind = "" if abs(change) < 0.05 else " less" if change < 0.0 else " more"
    return f'<span class="change{kind}">{number(change, 1, sign=True)} %</span>'


def comparison(report: DesignReport) -> str:
    """Every design in a column, the reference last; differences beside the powers."""
    reference = report.reference.solution
    elsewhere = [entry.title for entry in report.entries if not report.comparable(entry)]
    note = (
        f"<p class='note'>{escape(', '.join(elsewhere))}: at another flight condition than "
        f"{escape(report.reference.title)}; the power difference is not due to the blade alone.</p>"
        if elsewhere
        else ""
    )

    def compared(value: Callable[[Solution], float]) -> list[str]:
        return [
            _with_change(entry.solution, reference if report.comparable(entry) else entry.solution, value, report.units)
            for entry in report.all
        ]

    head = "".join(f"<th>{escape(entry.title)}</th>" for entry in report.all)
    width = 170 + round(len(report.all) * min(max(890 / len(report.all), 150), 230))  # [px]; a wider table scrolls.
    rows = [
        _row("Twist", [escape(twist_words(entry.solution.design.twist)) for entry in report.all], "words"),
        _row("Speed", [_speed(entry.solution.design, report.units) for entry in report.all]),
        _row("Mass, altitude", [_weight(entry.solution.design, report.units) for entry in report.all]),
        _row("Model", [_model(entry.solution.design) for entry in report.all], "words"),
        _row("<b>Total power</b>", compared(lambda solution: solution.power.total), "total"),
        *(
            _row(
                f'<i style="background:{PARTS[name]}"></i>{title}',
                compared(lambda solution, name=name: getattr(solution.power, name)),
            )
            for name, title in part_titles(*(entry.solution.design for entry in report.all)).items()
        ),
        _row("Induced factor κ", [number(e.solution.induced_power_factor, 3) for e in report.all]),
        _row("Efficiency", [_efficiency_number(e.solution, "FM ", "L/De ") for e in report.all]),
        _row("Stalled area", [f"{number(100 * e.solution.stalled_area, 1)} %" for e in report.all]),
    ]
    return (
        f'<section class="comparison"><h2>Side by side</h2><div class="wide">'
        f'<table style="width:{width}px"><thead><tr><th></th>{head}</tr>'
        f"</thead><tbody>{''.join(rows)}</tbody></table></div>{note}</section>"
    )


def _load(design: Design) -> list[tuple[str, str]]:
    """What the rotor carries and where, or the test."""
    condition, stand = design.condition, stand_of(design)
    if stand is not None:
        return [("Test stand", stand_words(stand))]
    climb = condition.climb_speed
    rate = f"{number(climb, 1)} m/s · {FOOT_PER_MINUTE.text(climb)}"
    return [
        *([("Rate of climb", rate)] if climb else []),
        ("Mass", f"{KILOGRAM.text(condition.mass, 1)} · {POUND.text(condition.mass)}"),
        ("Pressure altitude", f"{METRE.text(condition.altitude)} · {FOOT.text(condition.altitude)}"),
    ]


def conditions(solution: Solution) -> str:
    """Flight condition, rotor and models."""
    design = solution.design
    condition, rotor = design.condition, design.rotor
    rows = [
        ("Advance ratio µ", number(condition.advance_ratio, 3)),
        ("Airspeed", SI.airspeed(design.airspeed)),
        *_load(design),
        ("Air density", f"{number(condition.density, 4)} kg/m³"),
        ("Radius, tip speed", f"{number(rotor.radius, 3)} m, {number(rotor.tip_speed, 1)} m/s"),
        ("Blades, solidity", f"{rotor.blades}, {number(rotor.solidity, 4)}"),
        ("Preset", PRESET_TITLES.get(design.preset, design.preset)),
        ("Inflow", inflow_words(design)),
        ("Physics", physics_words(design)),
        ("Grid", "{} elements × {} azimuths".format(*grid_of(design))),
        ("Twist SPEC", design.twist.spec()),
    ]
    return _table("Condition and model", rows)


def parts(report: DesignReport, entry: ReportEntry) -> str:
    """Power by parts with shares and the change against the reference."""
    power, units = entry.solution.power, report.units
    ideal = ideal_induced(entry.solution)
    rows = [
        (f'<i style="background:{PARTS[name]}"></i>{title}', _share(getattr(power, name), power.total, units))
        for name, title in part_titles(entry.solution.design).items()
    ]
    rows += [
        ("Main rotor", units.watts(power.main_rotor, 1)),
        ("<b>Total</b>", f"<b>{units.watts(power.total, 1)}</b>"),
    ]
    if report.comparable(entry):
        change = units.watts(power.total - report.reference.solution.power.total, 1, sign=True)
        rows.append((f"vs. {escape(report.reference.title)}", change))
    rows.append(("Least induced, any circulation", "not settled" if ideal is None else units.watts(ideal, 1)))
    return _table("Power", rows, raw=True)


def trim(solution: Solution) -> str:
    """The trim and the coefficients of the rotor."""
    c = solution.controls
    stalled = [number(100 * part, 1) for part in (solution.stalled_area, solution.stalled_thrust)]
    rows = [
        ("Collective θ0, at 0.75 R", degrees(c.collective)),
        ("Cyclic θ1c, θ1s", f"{degrees(c.cyclic_1c)}, {degrees(c.cyclic_1s)}"),
        ("Shaft tilt α, forward", degrees(c.shaft_tilt)),
        ("Coning β0", degrees(c.coning)),
        ("Flapping β1c, β1s", f"{degrees(c.flap_1c)}, {degrees(c.flap_1s)}"),
        ("Mean induced inflow λ0", number(c.lambda0, 5)),
        ("CT, CT/σ", f"{number(solution.ct, 5)}, {number(solution.ct_over_sigma, 4)}"),
        ("CP", number(solution.cp, 6)),
        ("κ = Pi/(CT·λ0)", number(solution.induced_power_factor, 3)),
        ("Figure of merit" if solution.design.hovering else "Rotor L/De", _efficiency_number(solution)),
        ("Reverse flow", f"{number(100 * solution.reverse_flow_area, 1)} % of the disk"),
        ("Stalled", f"{stalled[0]} % of the disk, {stalled[1]} % of the thrust"),
    ]
    return _table("Trim", rows)


def vibration(solution: Solution) -> str:
    """Loads on the hub and frequencies of blades that bend; nothing for others."""
    if not solution.design.models.bending:
        return ""
    rows: list[Row] = []
    if (frequencies := solution.blade_frequencies) is not None:
        for name, own in vars(frequencies).items():
            rows.append((f"Blade in {name}", f"{', '.join(number(value, 2) for value in own[:3])} per rev"))
    if (reason := why_no_hub_loads(solution.design)) is not None:
        rows.append(("Hub loads", reason.sentence))
    elif (loads := solution.hub_loads) is not None:
        low, high = loads.band or (loads.index, loads.index)
        force, moment = (
            ", ".join(number(size) for name, size in loads.amplitudes.items() if name[0] == kind) for kind in "fm"
        )
        rows += [
            (f"Fx, Fy, Fz at {loads.per_rev}/rev", f"{force} N"),
            (f"Mx, My at {loads.per_rev}/rev", f"{moment} N m"),
            ("Vibration index", f"{number(loads.index, 1)} {index_unit(solution.design)}"),
            ("The same over wakes", f"{number(low, 1)} … {number(high, 1)} %: trade-offs, not a level"),
            ("Weights of Fx, Fy, Fz", "0.5, 0.67, 1; moments over the radius"),
        ]
    return _table("Vibration", rows)


def blade(design: Design) -> str:
    """Twist, zero at 0.75 R, chord and section at given stations."""
    shape = design.rotor.blade
    stations = [shape.root_cutout, *(r for r in STATIONS if r > shape.root_cutout)]
    angles, chords = np.degrees(design.twist(np.array(stations))), shape.chord(stations)
    places = [shape.section_at(r) for r in stations]
    sections = [section_title(inner) if inner == outer else "blended" for inner, outer, _ in places]
    rows = [
        _row("Twist [°]", [number(angle, 2, sign=True) for angle in angles]),
        _row("Chord [m]", [number(chord, 3) for chord in chords]),
        _row("Section", [escape(name) for name in sections], "words"),
    ]
    head = "".join(f"<th>{number(r, 2)}</th>" for r in stations)
    return (
        f'<h3>Blade</h3><div class="wide blade"><table><thead><tr><th>r/R</th>{head}</tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table></div>"
    )


def _table(title: str, rows: list[Row], raw: bool = False) -> str:
    """Two columns; `raw`: the cells are HTML already."""
    body = "".join(
        f"<tr><td>{name if raw else escape(name)}</td><td>{value if raw else escape(value)}</td></tr>"
        for name, value in rows
    )
    return f"<div><h3>{escape(title)}</h3><table>{body}</table></div>"


def _row(name: str, cells: list[str], kind: str = "") -> str:
    return f'<tr class="{kind}"><td>{name}</td>{"".join(f"<td>{cell}</td>" for cell in cells)}</tr>'


def _with_change(solution: Solution, reference: Solution, value: Callable[[Solution], float], units: Units) -> str:
    """A power, and below it the difference in its unit and in per cent."""
    here, there = value(solution), value(reference)
    if solution is reference:
        return units.watts(here, 1)
    per_cent = f" · {number(100.0 * (here / there - 1.0), 1, sign=True)} %" if abs(there) > 1.0 else ""
    return f"{units.watts(here, 1)}<br><small>{units.watts(here - there, 1, sign=True)}{per_cent}</small>"


def _share(part: float, total: float, units: Units) -> str:
    return f"{units.watts(part, 1)} <small>{number(100.0 * part / total)} %</small>"


def _speed(design: Design, units: Units) -> str:
    climb = units.climb_rate(design.condition.climb_speed)
    if design.hovering:
        return f"hover<br><small>{climb}</small>" if climb else "hover"
    speed = units.speed[0].text(design.airspeed) + (f", {climb}" if climb else "")
    return f"µ {number(design.condition.advance_ratio, 3)}<br><small>{speed}</small>"


def _weight(design: Design, units: Units) -> str:
    if (stand := stand_of(design)) is not None:
        return stand_words(stand)
    mass = units.mass.text(design.condition.mass, 2 if units.mass is TONNE else 0)
    return f"{mass}<br><small>{units.altitude.text(design.condition.altitude)}</small>"


def _model(design: Design) -> str:
    return f"{escape(inflow_words(design))}<br><small>{escape(design.preset)}, {escape(physics_words(design))}</small>"


def _efficiency_number(solution: Solution, merit: str = "", ratio: str = "") -> str:
    """Figure of merit in hover, lift to drag in flight, after their names."""
    if solution.design.hovering:
        return merit + number(solution.figure_of_merit, 3)
    return ratio + number(solution.lift_to_drag, 2)
