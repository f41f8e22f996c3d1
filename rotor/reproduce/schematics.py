"""Drawings of the theory: stream tube, blade element, annulus, reverse flow, flapping hinge, active twist.

Drawn to scale from this program's own geometry and solutions; where something is exaggerated, the caption says so.
The thesis takes these drawings from textbooks, and they hold no numbers, so nothing is compared.
"""

import math

import numpy as np

from rotor.actuator.pictures import twist_under_voltage
from rotor.airfoil.contour import load_contour
from rotor.arrays import Array
from rotor.files.make_design import make_design, uh60a_rotor, uh60a_twist
from rotor.reproduce.actuated_blade import BLADES, fitted_blade
from rotor.reproduce.actuator_sheets import sheet
from rotor.reproduce.report import Agreement, Arrow, Curve, CurveStyle, Note, PlotPanel, Report, curve, floats, table
from rotor.reproduce.runs import solved
from rotor.trim.solve import solve

STATION = 0.5
"""r/R of the blade element of figures 2.2 and 2.5."""
SPEEDS = (0.1, 0.2, 0.3, 0.4)
"""µ of the circles of reverse flow."""


def contraction(below: Array) -> Array:
    """Radius of the hovering stream tube over R, a distance z/R below (negative: above) the rotor.

    On the axis of a semi-infinite vortex cylinder the induced velocity is v (1 + z/√(1 + z²)); with it as the mean over
    the tube, conservation of mass (2.2) gives the radius, which tends to 1/√2 far below.
    """
    return 1.0 / np.sqrt(1.0 + below / np.sqrt(1.0 + below**2))


def reverse_flow_circle(mu: float) -> tuple[Array, Array]:
    """Border U_T = r + µ sin ψ = 0 seen from above, nose up: a circle of diameter µ on the retreating side."""
    psi = np.linspace(math.pi, 2.0 * math.pi, 121)
    r = -mu * np.sin(psi)
    return r * np.sin(psi), -r * np.cos(psi)


def figure_2_1() -> Report:
    """Stream tube in hover."""
    solution = solved("thesis", "linear:-16", 0.0).require()
    tip_speed = make_design(preset="thesis").rotor.tip_speed
    v = math.sqrt(solution.ct / 2.0) * tip_speed
    z = np.linspace(-0.55, 1.6, 120)
    radius = contraction(z)
    sides = tuple(
        curve("", side * part * radius, -z, "line" if part == 1.0 else "thin", colour=0 if part == 1.0 else 7)
        for part in (1.0, 0.7)
        for side in (-1.0, 1.0)
    )
    far = float(contraction(np.array([1.6]))[0])
    disk = curve("", (-1.0, 1.0), (0.0, 0.0), "line", colour=1)
    arrows = (
        Arrow((0.0, 0.02), (0.0, -0.38), 0),
        Arrow((0.0, -0.85), (0.0, -1.55), 0),
        Arrow((0.0, 0.08), (0.0, 0.5), 1),
    )
    notes = (
        Note(f"v = {v:.1f} m/s", 0.06, -0.3, "left"),
        Note("w = 2v", 0.06, -1.1, "left"),
        Note(f"= {2 * v:.1f} m/s", 0.06, -1.22, "left"),
        Note(f"T = {solution.design.condition.weight / 1e3:.1f} kN", 0.06, 0.4, "left"),
        Note("rotor disk, A", 1.06, 0.0, "left"),
        Note(f"{far:.3f} R → R/√2", far + 0.06, -1.5, "left"),
    )
    return _drawing(
        "2.1",
        "Stream tube of the hovering rotor at 8322.4 kg: surfaces that enclose all and half of the flow, to scale; "
        "the radius follows from conservation of mass with the velocity on the axis of a vortex cylinder.",
        "Momentum theory: the velocity far below is twice that in the disk (p. 6–8).",
        f"v = √(T/2ρA) = {v:.2f} m/s, w = {2 * v:.2f} m/s; the tube contracts to 1/√2 = 0.707 of the radius.",
        (PlotPanel("", "", (*sides, disk), equal=True, arrows=arrows, notes=notes, drawing=True),),
        {"v": v, "w": 2.0 * v, "far": far},
    )


def figure_2_2() -> Report:
    """Blade element and its velocity triangle."""
    disk = solved("thesis", "linear:-16", 0.0).require().disk
    k = int(np.abs(disk.r - STATION).argmin())
    theta, alpha = float(disk.theta[k, 0]), float(disk.alpha[k, 0])
    u_t, u_p = float(disk.u_t[k, 0]), float(disk.u_p[k, 0])
    phi, cl, cd = math.atan2(u_p, u_t), float(disk.cl[k, 0]), float(disk.cd[k, 0])
    points = load_contour("sc1095").points - np.array([0.25, 0.0])
    # The element moves to the left: the leading edge is on the left, pitch turns it up.
    turn = np.array([[math.cos(theta), math.sin(theta)], [-math.sin(theta), math.cos(theta)]])
    outline = points @ turn.T
    chord = np.array([[-0.25, 0.0], [0.75, 0.0]]) @ turn.T
    # Velocities of the air end at the quarter chord: U_T from ahead, U_P from above.
    size = 1.5 / math.hypot(u_t, u_p)
    ahead, above = -size * u_t, size * u_p
    lift = 0.55 * np.array([math.sin(phi), math.cos(phi)])
    drag = 0.55 * (cd / cl) * 10.0 * np.array([math.cos(phi), -math.sin(phi)])
    arrows = (
        Arrow((ahead, above), (0.0, above), 0),
        Arrow((ahead, above), (ahead, 0.0), 0),
        Arrow((ahead, above), (0.0, 0.0), 1),
        Arrow((0.0, 0.0), (float(lift[0]), float(lift[1])), 2),
        Arrow((0.0, 0.0), (float(drag[0]), float(drag[1])), 3),
    )
    plane = curve("", (ahead - 0.05, 0.95), (0.0, 0.0), "dashed", colour=7)
    notes = (
        Note(f"U_T = {u_t:.3f} ΩR", 0.5 * ahead, above + 0.05),
        Note(f"U_P = {u_p:.4f} ΩR", ahead - 0.04, 0.5 * above, "right"),
        Note("U", 0.62 * ahead, 0.62 * above - 0.06),
        Note(f"dL  (C_l = {cl:.2f})", float(lift[0]) + 0.04, float(lift[1]), "left"),
        Note(f"dD × 10  (C_d = {cd:.4f})", 0.1, -0.26, "left"),
        Note(
            f"θ = {math.degrees(theta):.1f}°   φ = {math.degrees(phi):.1f}°   α = {math.degrees(alpha):.1f}°",
            -1.0,
            -0.26,
        ),
        Note("plane of rotation", 0.95, 0.05, "right"),
    )
    section = (curve("", outline[:, 0], outline[:, 1], "fill", colour=7), plane)
    return _drawing(
        "2.2",
        f"Blade element at {disk.r[k]:.2f} R in hover, linear −16°: section, velocities and forces per length at "
        "their true angles; drag ten times as long.",
        "Angle of attack α = θ − φ with φ = arctan(U_P/U_T) (p. 8, 21).",
        f"θ {math.degrees(theta):.2f}° less φ {math.degrees(phi):.2f}° is α {math.degrees(alpha):.2f}°, as solved.",
        (
            PlotPanel(
                "", "", (*section, curve("", chord[:, 0], chord[:, 1], "thin", colour=4)),
                equal=True, arrows=arrows, notes=notes, drawing=True,
            ),
        ),
        {"theta": theta, "phi": phi, "alpha": alpha},
    )  # fmt: skip


def figure_2_5() -> Report:
    """Annulus of local momentum theory, and reverse flow."""
    rotor = make_design(preset="thesis").rotor
    dr = (1.0 - rotor.blade.root_cutout) / 20.0
    outer, inner = (_circle(STATION + side * dr / 2) for side in (1.0, -1.0))
    ring_x, ring_y = (np.concatenate([out, back[::-1]]) for out, back in zip(outer, inner, strict=True))
    chord = float(rotor.blade.chord(0.75)) / rotor.radius
    blades: list[Curve] = []
    for k in range(rotor.blades):
        turn = math.radians(30.0 + 360.0 / rotor.blades * k)
        along = np.array([math.sin(turn), -math.cos(turn)])
        across = np.array([along[1], -along[0]])
        corners = [
            r * along + c * chord * across
            for r, c in ((rotor.blade.root_cutout, 0.25), (1.0, 0.25), (1.0, -0.75), (rotor.blade.root_cutout, -0.75))
        ]
        closed = np.array([*corners, corners[0]])
        blades.append(curve("", closed[:, 0], closed[:, 1], "thin", colour=7))
    rim = _circle(1.0)
    annulus: tuple[Curve, ...] = (
        curve("", ring_x, ring_y, "fill", colour=0),
        curve("", *rim, "thin", colour=7),
        *blades,
    )
    borders = [curve(f"µ = {mu:g}", *reverse_flow_circle(mu), "line", colour=k) for k, mu in enumerate(SPEEDS)]
    cut_out = _circle(rotor.blade.root_cutout)
    share = {mu: _reversed_share(mu, rotor.blade.root_cutout) for mu in SPEEDS}
    return _drawing(
        "2.5",
        "The disk from above, nose up. Left: one annulus of local momentum theory, 2πr dr, with the thesis preset's "
        "blades, to scale. Right: borders of reverse flow, U_T = 0, circles of diameter µ; the dashed circle is the "
        "root cut-out, inside of which no blade is.",
        "Momentum and blade-element theory meet in annuli (p. 11); reverse flow is where U_T ≤ 0 (p. 23).",
        "Part of the lifting disk in reverse flow: "
        + ", ".join(f"{100 * value:.1f} % at µ {mu:g}" for mu, value in share.items())
        + ".",
        (
            PlotPanel(
                "", "", annulus, title="Annulus", equal=True, drawing=True,
                notes=(Note("dr", 0.0, STATION + 0.08), Note("R", 0.0, 1.07), Note("Ω ↺", 0.0, 0.0)),
            ),
            PlotPanel(
                "", "",
                (*borders, curve("", *rim, "thin", colour=7), curve("", *cut_out, "dashed", colour=7)),
                title="Reverse flow", equal=True, drawing=True,
                arrows=(Arrow((0.55, 0.35), (0.55, 0.7), 7),),
                notes=(Note("flight", 0.6, 0.5, "left"), Note("advancing", 0.7, -0.1), Note("retreating", -0.7, -0.1)),
            ),
        ),
        {f"share_{mu:g}": value for mu, value in share.items()},
    )  # fmt: skip


def figure_2_9() -> Report:
    """Flapping hinge and reference frames of the blade."""
    design = make_design(mu=0.2)
    solution = solve(design).require()
    rotor = design.rotor
    hinge = rotor.blade.flap_hinge
    state = solution.controls
    coning = float(state.coning)
    tip = np.array([hinge + (1 - hinge) * math.cos(coning), (1 - hinge) * math.sin(coning)])
    unit = 0.22
    outward, upward = np.array([math.cos(coning), math.sin(coning)]), np.array([-math.sin(coning), math.cos(coning)])
    middle = np.array([hinge, 0.0]) + 0.55 * outward
    arrows = (
        Arrow((0.0, 0.0), (0.0, 0.38), 0),
        Arrow((0.0, 0.0), (0.34, 0.0), 0),
        Arrow(_pair(middle), _pair(middle + unit * outward), 1),
        Arrow(_pair(middle), _pair(middle + unit * upward), 1),
        Arrow(_pair(middle + 0.12 * outward), _pair(middle + 0.12 * outward + 0.3 * upward), 2),
        Arrow((float(middle[0]) + 0.1, float(middle[1])), (float(middle[0]) + 0.42, float(middle[1])), 3),
    )
    notes = (
        Note("z, shaft", 0.02, 0.4, "left"),
        Note("x, hub", 0.3, -0.06),
        Note("y, blade", float(tip[0]) - 0.08, float(tip[1]) + 0.04, "center"),
        Note("z, blade", float((middle + unit * upward)[0]) - 0.02, float((middle + unit * upward)[1]), "right"),
        Note(
            "dL", float((middle + 0.12 * outward + 0.3 * upward)[0]) + 0.02, float((middle + 0.3 * upward)[1]), "left"
        ),
        Note("centrifugal force", float(middle[0]) + 0.44, float(middle[1]) - 0.01, "left"),
        Note(f"hinge, e = {hinge:.4f} R", hinge, -0.12, "left"),
        Note(f"β₀ = {math.degrees(coning):.2f}°", 0.45, -0.05, "left"),
    )
    lines = (
        curve("", (0.0, 0.9), (0.0, 0.0), "dashed", colour=7),
        curve("", (0.0, 0.0), (-0.25, 0.3), "line", colour=7),
        curve("", (0.0, hinge), (0.0, 0.0), "line", colour=7),
        curve("", (hinge, float(tip[0])), (0.0, float(tip[1])), "line", colour=0),
        curve("", (hinge,), (0.0,), "points", colour=1),
    )
    return _drawing(
        "2.9",
        "Blade on its flapping hinge, to scale: frame of the hub and frame of the blade, mean flapping at µ 0.2 "
        "(flight preset). The thesis neglects the offset of the hinge.",
        "Flapping balances the moments of lift and centrifugal force about the hinge; its offset is neglected (p. 15, "
        "24).",
        f"Coning {math.degrees(coning):.2f}°, hinge at {hinge:.4f} R in the flight preset, "
        f"{make_design(preset='thesis').rotor.blade.flap_hinge:g} in the thesis preset.",
        (PlotPanel("", "", lines, equal=True, arrows=arrows, notes=notes, drawing=True),),
        {"coning": coning, "hinge": hinge},
    )


def figure_5_1() -> Report:
    """What active twist control is."""
    name = "new blade, GJ/2, 2 plies"
    plies, host = BLADES[name]
    installed = fitted_blade(plies, host)
    high = sheet("MFC_P1").voltage_range[1]
    bent = twist_under_voltage(installed, [high])
    law, rotor = uh60a_twist(), uh60a_rotor("flight")
    chord = float(rotor.blade.chord(0.75)) / rotor.radius
    points = load_contour("sc1095").points - np.array([0.25, 0.0])
    rest: list[Curve] = []
    driven: list[Curve] = []
    scale = 5.0
    stations = (0.25, 0.4, 0.55, 0.7, 0.85, 1.0)
    rows: list[tuple[float, float, float]] = []
    for k, r in enumerate(stations):
        jig = float(law(np.array([r]))[0])
        more = float(np.interp(r, bent.r, bent.twist))
        rows.append((r, math.degrees(jig), math.degrees(more)))
        cases: tuple[tuple[float, CurveStyle, list[Curve], str], ...] = (
            (jig, "thin", rest, "at 0 V"),
            (jig + scale * more, "line", driven, f"at {high:.0f} V, change × {scale:.0f}"),
        )
        for angle, style, into, label in cases:
            turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
            shape = np.vstack([points, points[:1]]) @ turn.T + np.array([1.25 * k, 0.0])
            colour = 7 if style == "thin" else 1
            into.append(curve("" if k else label, shape[:, 0], shape[:, 1], style, colour=colour))
    front, rear = (0.25 - x for x in installed.placement.chord)
    root, (start, end) = rotor.blade.root_cutout, installed.placement.span
    plan = [
        curve("", (root, 1, 1, root, root), _scaled((0.25, 0.25, -0.75, -0.75, 0.25), chord), "thin", colour=7),
        curve("", (start, end, end, start, start), _scaled((front, front, rear, rear, front), chord), "fill", colour=1),
    ]
    width = (front - rear) * chord
    for y in np.arange(start, end - width, 0.02):
        plan.append(curve("", (float(y), float(y) + width), _scaled((rear, front), chord), "thin", colour=7))
    return _drawing(
        "5.1",
        "Active twist: plies with fibres at 45° to the span on both skins (above, planform to scale) shear the skins "
        f"and so twist the blade (below, sections from {stations[0]:g} R to the tip at 0 V and at {high:.0f} V; the "
        f"change is drawn {scale:.0f} times as large). {name.capitalize()}.",
        "Active Twist Control. Only this caption is known.",
        f"At {high:.0f} V the tip turns by {rows[-1][2]:.2f}° against the root.",
        (
            PlotPanel("", "", tuple(plan), title="Planform with plies", equal=True, drawing=True),
            PlotPanel(
                "", "", (*rest, *driven), title="Sections", equal=True, drawing=True,
                notes=tuple(Note(f"{r:g} R", 1.25 * k + 0.25, -0.42) for k, r in enumerate(stations)),
            ),
        ),
        {"tip_deg": rows[-1][2]},
        (("r", "twist_at_rest_deg", "change_deg"), rows),
        stacked=True,
    )  # fmt: skip


def _drawing(
    number: str, caption: str, statement: str, ours: str, panels: tuple[PlotPanel, ...], numbers: dict[str, float],
    rows: tuple[tuple[str, ...], list[tuple[float, float, float]]] | None = None, *, stacked: bool = False,
) -> Report:  # fmt: skip
    listed = rows or (("name", "value"), [])
    body = listed[1] if rows else list(numbers.items())
    return Report(
        number=number,
        kind="figure",
        caption=caption,
        statement=statement,
        ours=ours,
        verdict=Agreement.ALONE,
        because="A drawing of our own from this program's geometry and solution; the thesis shows one without numbers.",
        tables=(table("numbers", listed[0], body),),
        panels=panels,
        numbers=numbers,
        stacked=stacked,
    )


def _circle(radius: float) -> tuple[Array, Array]:
    turn = np.linspace(0.0, 2.0 * math.pi, 181)
    return radius * np.cos(turn), radius * np.sin(turn)


def _reversed_share(mu: float, root: float) -> float:
    """Part of the disk outside the root cut-out in which U_T is negative."""
    r = root + (1.0 - root) * (np.arange(400, dtype=np.float64)[:, None] + 0.5) / 400
    psi = 2.0 * math.pi * np.arange(720) / 720
    return float(((r + mu * np.sin(psi) < 0.0) * r).sum() / (r * np.ones_like(psi)).sum())


def _scaled(values: tuple[float, ...], by: float) -> tuple[float, ...]:
    return floats(by * np.array(values))


def _pair(point: Array) -> tuple[float, float]:
    return float(point[0]), float(point[1])
