"""Figures 5.8–5.10 and tables 5.1, 5.2: plies on the blade, how far they twist it, and whether it pays. Ours alone."""

import math

import numpy as np

from rotor.actuator import tables as actuator_tables
from rotor.actuator.catalogue import derating
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pictures import electronics_station, section_picture, twist_under_voltage
from rotor.actuator.section import Host, default_placement
from rotor.design.twist import PiecewiseLinearTwist
from rotor.files.make_design import uh60a_rotor
from rotor.optimisation.concepts import find_concept
from rotor.reproduce.actuator_sheets import sheet
from rotor.reproduce.report import (
    Agreement,
    Curve,
    CurveStyle,
    PlotPanel,
    Report,
    ReportTable,
    caption_only,
    curve,
    table,
)
from rotor.reproduce.runs import CachedFunction, variant

SPEEDS = (0.0, 0.3)
"""The two flight conditions of Table 5.2."""
BLADES: dict[str, tuple[int, Host]] = {
    "flown blade, 1 ply": (1, Host()),
    "flown blade, 2 plies": (2, Host()),
    "flown blade, 4 plies": (4, Host()),
    "new blade, GJ/2, 2 plies": (2, Host("new", 0.5)),
}
STYLES: dict[str, CurveStyle] = {"outline": "thin", "ply": "line"}
"""Of the parts of a section that are too thin to fill."""


def fitted_blade(plies: int, host: Host, divisions: tuple[float, ...] = ()) -> InstalledActuator:
    """MFC P1 as the worked example places it."""
    return install(sheet("MFC_P1"), default_placement(plies, divisions), host, uh60a_rotor("flight"))


def figure_5_8() -> Report:
    """The blade with its black box."""
    rotor = uh60a_rotor("flight")
    law = find_concept("three-segment").twist((0.0, 0.0, 0.0))
    assert isinstance(law, PiecewiseLinearTwist)
    installed = fitted_blade(2, Host(), law.breaks)
    box, placement = electronics_station(installed), installed.placement
    front, rear = (0.25 - x for x in placement.chord)
    blade = (rotor.blade.root_cutout, 1.0)
    curves = [
        _box("blade", blade, (0.25, -0.75), 7),
        *(_box(f"segment {k + 1}", ends, (front, rear), k, "fill") for k, ends in enumerate(placement.segments)),
        _box("drive electronics", box, (0.12, -0.12), 3, "fill"),
    ]
    rows = [("drive electronics", *box), *((f"segment {k + 1}", *ends) for k, ends in enumerate(placement.segments))]
    masses = installed.masses
    return Report(
        number="5.8",
        kind="figure",
        caption="The blade with its plies in three electrical segments, each with a voltage of its own, and the box "
        "of drive electronics inboard of them (our layout).",
        statement=caption_only("Figure 5.8"),
        ours=f"Active from {placement.span[0]:.2f} to {placement.span[1]:.2f} R and {placement.chord[0]:.2f} to "
        f"{placement.chord[1]:.2f} c, both skins, 2 plies: {masses.actuator:.1f} kg of plies, {masses.wiring:.1f} kg "
        f"of leads and {masses.balance:.1f} kg of nose weight on a blade.",
        verdict=Agreement.ALONE,
        because="The de-ice mat excludes plies on the nose, the pressurised spar excludes leads inside it; sources: "
        "assets/uh60a_structure.toml.",
        tables=(table("layout", ("part", "start_r", "end_r"), rows),),
        panels=(PlotPanel("r/R", "from the quarter chord [c]", tuple(curves), y_limits=(-0.85, 0.35)),),
        legend_below=True,
        numbers={"box_end": box[1], "active_start": placement.span[0], "ply_kg": masses.actuator},
    )


def figure_5_9() -> Report:
    """The section with its actuators."""
    panels: list[PlotPanel] = []
    rows: list[tuple[str | float, ...]] = []
    for title, host in (("flown blade: plies on the spar and the aft skin", Host()),
                        ("new blade: plies in its torsion box", Host("new", 0.5))):  # fmt: skip
        picture = section_picture(fitted_blade(2, host), exaggerate=3.0)
        curves: list[Curve] = []
        roles: set[str] = set()
        for part in picture.parts:
            points = np.vstack([part.points, part.points[:1]]) / picture.chord
            label = "" if part.role in roles else part.role
            roles.add(part.role)
            colour = ("outline", "spar", "skin", "web", "ply").index(part.role)
            style = STYLES.get(part.role, "fill")
            curves.append(curve(label, points[:, 0], points[:, 1], style, colour=(7, 0, 5, 6, 1)[colour]))
            rows += [(host.label, part.label, y, z) for y, z in points]
        panels.append(PlotPanel("x/c", "z/c", tuple(curves), title=title, equal=True))
    installed = fitted_blade(2, Host())
    return Report(
        number="5.9",
        kind="figure",
        caption="Section SC1095 with ±45° plies on both skins; walls and plies three times as thick as they are.",
        statement=caption_only("Figure 5.9"),
        ours=f"On the flown blade the section, plies included, has GJ {1e-3 * installed.section_stiffness:.1f} kN·m²; "
        f"the whole voltage range twists it as {installed.moment:.0f} N·m would.",
        verdict=Agreement.ALONE,
        because="Contour from the coordinates of the section, wall thickness calibrated on the published GJ.",
        tables=(table("outlines", ("blade", "part", "x_c", "z_c"), rows),),
        panels=tuple(panels),
        numbers={"stiffness": installed.section_stiffness, "moment": installed.moment},
    )


def figure_5_10() -> Report:
    """Torsion angle along the blade."""
    curves: list[Curve] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    low, high = sheet("MFC_P1").voltage_range
    for k, (name, (plies, host)) in enumerate(BLADES.items()):
        installed = fitted_blade(plies, host)
        up, down = (twist_under_voltage(installed, [volts]) for volts in (high, low))
        curves.append(curve(name, up.r, np.degrees(up.twist), colour=k))
        curves.append(curve("", down.r, np.degrees(down.twist), "dashed", colour=k))
        rows += [(name, r, *np.degrees(ends)) for r, *ends in zip(up.r, up.twist, down.twist, strict=True)]
        numbers[name] = math.degrees(installed.attainable)
    return Report(
        number="5.10",
        kind="figure",
        caption=f"Twist of the rotating blade with every ply at {high:.0f} V (full) and at {low:.0f} V (dashed), zero "
        "at 0 V: a volt acts on the plies like a kelvin of the thermal analogy.",
        statement=caption_only("Figure 5.10"),
        ours="Root to tip over the whole range: "
        + "; ".join(f"{name}: {value:.2f}°" for name, value in numbers.items())
        + ".",
        verdict=Agreement.ALONE,
        because="Thin-walled laminate section (Bredt–Batho) on a rotating beam in torsion; finite elements of the "
        "section agree within 2 % (tests/rotor/actuator/test_actuator_fem.py). "
        "With the low end of the maker's strain and what one "
        f"tested blade relative to its model, use {100 * derating(sheet('MFC_P1')):.0f} %.",
        tables=(table("twist", ("blade", "r", f"at_{high:.0f}_v_deg", f"at_{low:.0f}_v_deg"), rows),),
        panels=(PlotPanel("r/R", "twist [°]", tuple(curves)),),
        numbers=numbers,
    )


def table_5_1() -> Report:
    """Properties of actuators."""
    made = actuator_tables.table_5_1()
    return Report(
        number="5.1",
        kind="table",
        caption="Properties of the actuators in this package; columns and choice are ours.",
        statement=caption_only("Table 5.1"),
        ours=f"{len(made.rows)} actuators. " + " ".join(made.notes),
        verdict=Agreement.ALONE,
        because="Each number carries its source and grade in assets/actuators.toml.",
        tables=(_as_table("properties", made),),
        numbers={"actuators": float(len(made.rows))},
    )


@CachedFunction
def compared(name: str) -> actuator_tables.ActuatorTable:
    """Table 5.2 of one variant: four optima a concept, and the reach of six actuators."""
    return actuator_tables.table_5_2(ConditionPair(variant(name, mu=SPEEDS[0]), SPEEDS))


def table_5_2() -> Report:
    """Actuators and concepts compared."""
    made = compared("flight")
    net = made.columns.index("net kW")
    best = made.rows[0]
    gains = [float(row[net]) for row in made.rows]
    return Report(
        number="5.2",
        kind="table",
        caption=f"Actuators and twist concepts compared between hover and µ {SPEEDS[1]:g}, half the time each, on the "
        "flown blade (flight preset); best net saving first.",
        statement=caption_only("Table 5.2"),
        ours=f"{sum(gain > 0.0 for gain in gains)} of {len(gains)} have a net benefit. The best is {best[0]} with the "
        f"{best[1]} concept: {best[net]} kW net. {made.notes[1]}",
        verdict=Agreement.ALONE,
        because=made.notes[0],
        tables=(_as_table("verdicts", made),),
        numbers={"largest_net_kw": max(gains), "rows": float(len(gains))},
    )


def _as_table(name: str, made: actuator_tables.ActuatorTable) -> ReportTable:
    return table(name, made.columns, made.rows, shown=True)


def _box(
    label: str, along: tuple[float, float], across: tuple[float, float], colour: int, style: CurveStyle = "line"
) -> Curve:
    (a, b), (c, d) = along, across
    return curve(label, (a, b, b, a, a), (c, c, d, d, c), style, colour=colour)
