"""The figures of `aerodynamics.md` and `theory.md`, drawn while the site is built; each function returns HTML."""

import csv
import math
from html import escape

import numpy as np
from pictures import disk_figure

import rotor
from explorer.colours import PARTS
from explorer.export.figures import figure
from rotor.actuator.catalogue import find_actuator
from rotor.actuator.installation import install
from rotor.actuator.section import HostBlade, default_placement
from rotor.aero.losses import loss_factor
from rotor.aero.momentum import axial_inflow, vortex_ring_edge
from rotor.airfoil.sections import load_section
from rotor.study.series import waterfall
from rotor.support.assets import asset_path
from rotor.support.chart import AZIMUTH, COLOURS, Axis, Chart, Line, Points
from rotor.trim.analysis import power_gradient

SPEEDS = np.arange(0.08, 0.361, 0.04)
MU = "advance ratio µ"
RADIUS = "r/R"


def conventions() -> str:
    """The disk from above: where ψ is counted from, and which side advances."""
    words = (
        (0, 132, "middle", "ψ = 0: tail"),
        (116, 5, "start", "ψ = 90°: advancing"),
        (0, -116, "middle", "ψ = 180°: nose"),
        (-116, 5, "end", "ψ = 270°: retreating"),
        (0, -144, "middle", "flight"),
    )
    text = "".join(
        f'<text x="{x}" y="{y}" text-anchor="{end}">{escape(word)}</text>'
        for x, y, end, word in words
    )
    return (
        '<figure><figcaption><b>Azimuth, from above</b></figcaption><svg viewBox="-260 -185 520 325" role="img" '
        'aria-label="Azimuth, from above"><g fill="currentColor" font-size="14">'
        f'{text}<path d="M-6-168L0-182L6-168ZM73-30L78-46L88-32Z"/></g>'
        '<g fill="none" stroke="currentColor"><circle r="105"/><path d="M0-105V105M-105 0H105" stroke-opacity=".3"/>'
        '<path d="M0-158V-170M83 20A85 85 0 0 0 80-32" stroke-width="2"/>'
        '<path d="M0 0L74 74" stroke-width="5"/></g></svg></figure>'
    )


def flight_condition() -> str:
    """Drag over weight, which tilts the shaft."""
    table = _level(SPEEDS)
    drag = [one.power.parasite / one.design.airspeed / one.design.condition.weight for one in table]
    tilt = [math.tan(one.controls.shaft_tilt) for one in table]
    series = (
        Line("drag over weight", SPEEDS, np.array(drag), COLOURS[1]),
        Line("tangent of the shaft's tilt", SPEEDS, np.array(tilt), COLOURS[2], dashes=True),
    )
    return _chart("Drag tilts the rotor", MU, "D/W, tan α", *series)


def momentum() -> str:
    """Power of the ideal rotor in axial flight over its power in hover."""
    climb = np.linspace(-0.45, 2.0, 50)
    ct = 0.0065
    unit = math.sqrt(0.5 * ct)
    power = np.array([(axial_inflow(ct, v * unit) + v * unit) / unit for v in climb])
    edge = vortex_ring_edge(0.0)
    series = (
        Line("ideal rotor", climb, power, COLOURS[1]),
        Line(
            "vortex ring state begins",
            np.array([edge, edge]),
            np.array([0.0, 1.4]),
            COLOURS[2],
            dashes=True,
        ),
    )
    return _chart("Axial climb and descent", "V_c / v_h", "P / P_h", *series)


def twist_laws() -> str:
    """Twist laws over the radius."""
    r = np.linspace(0.13, 1.0, 80)
    laws = ("linear:-12", "quadratic:10,-12", "segments:-4,-14@0.6", "uh60a")
    series = [
        Line(spec, r, np.degrees(rotor.parse_twist(spec)(r)), COLOURS[1 + k])
        for k, spec in enumerate(laws)
    ]
    return _chart("Twist laws, zero at 0.75 R", RADIUS, "twist [°]", *series)


def sections() -> str:
    """Lift and drag of SC1095 over the angle of attack."""
    alpha = np.radians(np.linspace(-6.0, 18.0, 97))
    table, charts = load_section("sc1095"), []
    for name, label in (("cl", "C_l"), ("cd", "C_d")):
        series = [
            Line(
                f"Mach {mach}", np.degrees(alpha), getattr(table(alpha, mach), name), COLOURS[1 + k]
            )
            for k, mach in enumerate((0.3, 0.5, 0.7))
        ]
        charts.append(_chart(f"SC1095, {label}", "angle of attack [°]", label, *series))
    return "".join(charts)


def losses() -> str:
    """Prandtl's factor along the blade."""
    r = np.linspace(0.131, 0.9999, 200)
    series = [
        Line(f"λ = {inflow}", r, loss_factor(r, inflow, 4, 0.13)[0], COLOURS[1 + k])
        for k, inflow in enumerate((0.03, 0.06))
    ]
    return _chart("Tip and root loss, four blades", RADIUS, "F", *series)


def hover() -> str:
    """Inflow along the blade in hover."""
    series = []
    for k, twist in enumerate(("linear:0", "linear:-8", "linear:-16")):
        disk = rotor.solve(rotor.make_design(hover=True, twist=twist)).disk
        title = twist.replace("linear:", "twist ").replace("-", "−") + "°"
        series.append(Line(title, disk.r, disk.induced[:, 0], COLOURS[1 + k]))
    return _chart("Twist evens the inflow of hover", RADIUS, "λ_i", *series)


def velocities() -> str:
    """The two velocities that a section sees."""
    solution = rotor.solve(rotor.make_design(mu=0.3))
    disk = solution.disk
    k = int(np.argmin(np.abs(disk.r - 0.75)))
    psi = np.degrees(disk.psi)
    series = (
        Line("U_T", psi, disk.u_t[k], COLOURS[1]),
        Line("U_P × 10", psi, 10.0 * disk.u_p[k], COLOURS[2]),
    )
    return _chart("At 0.75 R, µ 0.3", "azimuth ψ [°]", "velocity over ΩR", *series, ticks=AZIMUTH)


def inflow() -> str:
    """Induced inflow of three models."""
    names = ("pitt-peters", "local-momentum", "lifting-line")
    solved = (rotor.solve(rotor.make_design(mu=0.2, inflow=name)) for name in names)
    return "".join(
        disk_figure(one, "Induced inflow λi", name) for one, name in zip(solved, names, strict=True)
    )


def elastic() -> str:
    """Elastic twist of the tip around the disk."""
    series = []
    for k, mu in enumerate((0.1, 0.2, 0.3)):
        solution = rotor.solve(rotor.make_design(mu=mu))
        assert solution.elastic is not None
        psi = np.append(np.degrees(solution.disk.psi), 360.0)
        tip = np.degrees(np.append(solution.elastic.tip, solution.elastic.tip[0]))
        series.append(Line(f"µ {mu}", psi, tip, COLOURS[1 + k]))
    return _chart("Elastic twist of the tip", "azimuth ψ [°]", "φ [°]", *series, ticks=AZIMUTH)


def trim() -> str:
    """Controls over speed."""
    table = _level(SPEEDS)
    named = {
        "collective": "collective",
        "lateral θ1c": "cyclic_1c",
        "longitudinal θ1s": "cyclic_1s",
        "shaft tilt": "shaft_tilt",
    }
    series = [
        Line(
            label,
            SPEEDS,
            np.degrees([getattr(one.controls, name) for one in table]),
            COLOURS[1 + k % 4],
        )
        for k, (label, name) in enumerate(named.items())
    ]
    return _chart("Controls of level flight", MU, "angle [°]", *series)


def power() -> str:
    """Power by parts over speed."""
    table = _level(SPEEDS)
    parts = {
        part: np.array([getattr(one.power, part) / 1e3 for one in table])
        for part in PARTS
        if part != "climb"
    }
    total = np.array([one.power.total / 1e3 for one in table])
    series = [Line("total", SPEEDS, total, "currentColor")]
    series += [Line(part, SPEEDS, values, PARTS[part]) for part, values in parts.items()]
    return _chart("Power of level flight", MU, "power [kW]", *series)


def gradient() -> str:
    """What a degree more pitch at one place costs."""
    series = []
    for k, mu in enumerate((0.0, 0.2, 0.35)):
        found = power_gradient(rotor.solve(rotor.make_design(mu=mu)))
        series.append(
            Line(f"µ {mu:g}", found.r, found.density * math.radians(1.0) / 1e3, COLOURS[1 + k])
        )
    return _chart("Power by local pitch, trimmed again", RADIUS, "kW per ° and per R", *series)


def ideal() -> str:
    """The bound at the reference mass, as `assets/ideal_bound.csv` holds it."""
    text = asset_path("ideal_bound.csv").read_text(encoding="utf-8")
    lines = [one for one in text.splitlines() if not one.startswith("#")]
    rows = [row for row in csv.DictReader(lines) if row["mass_kg"] == "8322.4"]
    mu = np.array([float(row["mu"]) for row in rows])
    named = {
        "best linear twist": "linear_twist",
        "any steady twist": "steady_twist",
        "any circulation": "any_circulation",
    }
    series = [
        Line(label, mu, np.array([float(row[name]) for row in rows]), COLOURS[1 + k])
        for k, (label, name) in enumerate(named.items())
    ]
    return _chart("Least induced power over that of momentum theory", MU, "κ", *series)


def presets() -> str:
    """Power over speed by both presets."""
    series = []
    for k, preset in enumerate(("thesis", "flight")):
        table = rotor.sweep(rotor.make_design(preset=preset, twist="linear:-16"), SPEEDS)
        values = np.array([one.power.total / 1e3 if one.converged else math.nan for one in table])
        series.append(Line(preset, SPEEDS, values, COLOURS[1 + k]))
    return _chart("Twist −16°, both presets", MU, "power [kW]", *series)


def switches() -> str:
    """What each effect adds, in the order of the waterfall."""
    steps = waterfall(rotor.make_design(mu=0.3)).steps[1:]
    added = np.array([step.added or 0.0 for step in steps]) / 1e3
    place = np.arange(float(len(steps)))
    chart = Chart(
        "Switched on one after another, µ 0.3", Axis("change of power [kW]"),
        Axis(names=tuple(step.title for step in steps)), (Points("", added, place, COLOURS[1]),),
    )  # fmt: skip
    return figure(chart)


def actuator() -> str:
    """Twist that two plies reach along the blade."""
    design = rotor.make_design()
    series = []
    r = np.linspace(design.rotor.blade.root_cutout, 1.0, 60)
    for k, (title, host) in enumerate(
        {"as built": HostBlade(), "half the stiffness": HostBlade("new", 0.5)}.items()
    ):
        installed = install(find_actuator("MFC_P1"), default_placement(), host, design.rotor)
        whole = installed.change(np.ones(len(installed.shapes)), r)
        series.append(Line(title, r, np.degrees(whole), COLOURS[1 + k]))
    return _chart(
        "MFC P1, two plies, over the whole voltage", RADIUS, "change of twist [°]", *series
    )


def _level(speeds: np.ndarray) -> rotor.SweepTable:
    return rotor.sweep(rotor.make_design(), speeds)


def _chart(title: str, x: str, y: str, *series, ticks: tuple[float, ...] = ()) -> str:
    return figure(Chart(title, Axis(x, ticks=ticks), Axis(y), tuple(series)))
