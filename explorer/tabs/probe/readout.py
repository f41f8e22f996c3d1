"""The probe in words: where it is, the section in its wind, a table, and its place on the lift curve; as HTML."""

import math
from html import escape

import numpy as np

from explorer.charts import svg
from explorer.tabs.probe.drawing import ALPHA, DRAG, LIFT, Scales, drawing
from explorer.tabs.probe.element import Blend, FlowRegion, Probe
from explorer.text.glossary import tip
from explorer.text.status import section_title
from explorer.text.units import number
from explorer.theme.colours import LIMIT, NOW
from rotor.trim.solution import Solution

_CHIPS = {
    FlowRegion.IDLE: "back",
    FlowRegion.ATTACHED: "good",
    FlowRegion.STALLED: "bad",
    FlowRegion.REVERSE: "back",
    FlowRegion.DIVERGED: "bad",
}
_WIDTH, _HEIGHT = 312.0, 96.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 26.0, 300.0, 6.0, 80.0


def probe_panel(probe: Probe, solution: Solution, opened: bool = False) -> str:
    """Everything about one blade element, one beneath the other; `opened`: its small angles drawn wider."""
    disk, design = solution.disk, solution.design
    fastest = design.rotor.tip_speed * float(np.hypot(disk.u_t, disk.u_p).max())
    per_metre = design.thrust_unit / (design.rotor.blades * design.rotor.radius)
    strongest = per_metre * float(np.hypot(disk.dct, disk.dcq).max())
    picture, scales = drawing(probe, fastest, strongest, opened)
    return (
        f'<div class="rx rx-probe" data-explorer="probe">{_head(probe)}{picture}{_key(scales)}{_table(probe)}'
        f"{lift_curve(probe)}</div>"
    )


def where(psi: float) -> str:
    """What an azimuth [rad] is called."""
    names = ("over the tail", "aft, advancing", "advancing side", "ahead, advancing",
             "over the nose", "ahead, retreating", "retreating side", "aft, retreating")  # fmt: skip
    return names[round(math.degrees(psi) / 45.0) % 8]


def sections_of(section: Blend) -> str:
    """Name of the section; of two where one goes over into the other."""
    return " → ".join(dict.fromkeys(section_title(s.name) for s, _ in section.installed()))


def _head(probe: Probe) -> str:
    alpha, region = tip("probe_alpha"), tip("probe_region")
    chip = f"rx-push rx-chip rx-chip-{_CHIPS[probe.region]}"
    return (
        f'<div class="rx-line rx-base"><span class="rx-best" data-explorer="probe-alpha"{alpha}>'
        f"α {_deg(probe.alpha, 1)}</span>"
        f'<span class="rx-dim" data-explorer="probe-place">{where(probe.psi)}</span>'
        f'<span class="{chip}" data-explorer="probe-region"{region}>{probe.region.value}</span></div>'
    )


def _key(scales: Scales) -> str:
    """The colours of the arrows, and what is drawn larger than true or than on the scale of the whole disk."""
    entries = (("velocity", "currentColor", scales.velocity), ("lift", LIFT, scales.lift), ("drag", DRAG, scales.drag))
    keys = "".join(
        f'<span><span class="rx-dash" style="background:{colour}"></span>{name}{_times(factor)}</span>'
        for name, colour, factor in entries
    )
    view = f"angles{_times(scales.angles)}" if scales.angles > 1 else "seen from the hub"
    return f'<div class="rx-line rx-small rx-dim rx-base">{keys}<span class="rx-push">{view}</span></div>'


def _times(factor: int) -> str:
    return f" ×{factor}" if factor > 1 else ""


def _table(probe: Probe) -> str:
    margin = probe.stall_margin
    efficiency = probe.cl / probe.cd if probe.cd > 0.0 else None
    entries = (
        ("probe_u_t", "Tangential U<sub>T</sub>", f"{number(probe.u_t, 1)} m/s"),
        ("probe_mach", "Mach", number(probe.mach, 3)),
        ("probe_u_p", "Perpendicular U<sub>P</sub>", f"{number(probe.u_p, 1)} m/s"),
        ("probe_cl", "C<sub>l</sub>", number(probe.cl, 3)),
        ("probe_induced", "Induced v<sub>i</sub>", f"{number(probe.induced, 1)} m/s"),
        ("probe_cd", "C<sub>d</sub>", number(probe.cd, 4)),
        ("probe_theta", "Pitch θ", _deg(probe.theta)),
        ("probe_ratio", "C<sub>l</sub>/C<sub>d</sub>", number(efficiency, 1)),
        ("probe_phi", "Inflow φ", _deg(probe.phi)),
        ("probe_m2cn", "M²c<sub>n</sub>", number(probe.m2cn, 3)),
        ("probe_margin", "Stall margin", "–" if margin is None else _deg(margin, 1)),
        ("probe_drag", "Drag", f"{number(probe.drag)} N/m"),
        ("probe_thrust", "Thrust", f"{number(probe.thrust / 1e3, 2)} kN/m"),
        ("probe_torque", "Torque", f"{number(probe.torque / 1e3, 2)} kN m/m"),
        ("probe_section", "Section", escape(sections_of(probe.section))),
        ("probe_power", "Power", f"{number(probe.power / 1e3, 1)} kW/m"),
    )
    cells = "".join(
        f'<div class="rx-line"{tip(key)}><span class="rx-dim">{name}</span><span class="rx-num">{value}</span></div>'
        for key, name, value in entries
    )
    return f'<div class="rx-grid">{cells}</div>'


def lift_curve(probe: Probe) -> str:
    """C_l over α of this section at this Mach number, both stall angles, and where the element is."""
    degrees = math.degrees(probe.alpha)
    low, high, step = (-15.0, 20.0, 5.0) if -15.0 < degrees < 20.0 else (-180.0, 180.0, 60.0)
    alpha = np.linspace(low, high, 91)
    curve = probe.section.lift_curve(np.radians(alpha), probe.table_mach)
    bottom, top = min(-1.0, float(curve.min()), probe.cl), max(1.6, float(curve.max()), probe.cl)

    def x(value: float) -> float:
        return _LEFT + (value - low) / (high - low) * (_RIGHT - _LEFT)

    def y(value: float) -> float:
        return _BOTTOM - (value - bottom) / (top - bottom) * (_BOTTOM - _TOP)

    marks = []
    for tick in np.arange(low, high + 0.1, step):
        marks.append(svg.line((x(tick), _BOTTOM), (x(tick), _BOTTOM + 3.0), width=0.8))
        if tick % (2.0 * step) == 0.0:
            marks.append(svg.tick((x(tick), _HEIGHT - 4.0), f"{number(tick)}°", "middle"))
    for tick in (-1.0, 0.0, 1.0):
        style = 'opacity=".5"' if tick == 0.0 else 'opacity=".18"'
        marks.append(svg.line((_LEFT, y(tick)), (_RIGHT, y(tick)), width=0.8, style=style))
        marks.append(svg.tick((_LEFT - 5.0, y(tick) + 3.5), number(tick), "end"))
    for angle in probe.stall:
        end = math.degrees(angle)
        if low < end < high:
            marks.append(svg.line((x(end), _TOP), (x(end), _BOTTOM), LIMIT, 1.2, 'stroke-dasharray="4 3"'))
    path = " ".join(f"{x(a):.1f},{y(cl):.1f}" for a, cl in zip(alpha.tolist(), curve.tolist(), strict=True))
    marks.append(f'<polyline points="{path}" fill="none" stroke="{LIFT}" stroke-width="1.8"/>')
    here = x(degrees), y(probe.cl)
    marks.append(svg.line((here[0], _BOTTOM), here, ALPHA, 1.0))
    if not probe.idle:
        marks.append(f'<circle cx="{here[0]:.1f}" cy="{here[1]:.1f}" r="4" fill="{NOW}" stroke="{svg.BODY}"/>')
    return (
        f'<div class="rx-line rx-probe-title"{tip("chart_lift_curve")}><span><b>Lift curve</b></span>'
        f'<span class="rx-dim">C<sub>l</sub> over α at Mach {number(probe.table_mach, 2)}</span>'
        f'<span><span class="rx-dash" style="background:{LIMIT}"></span>stall</span></div>'
        f'<svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" role="img" '
        f'aria-label="Lift coefficient over angle of attack">{"".join(marks)}</svg>'
    )


def _deg(angle: float, digits: int = 2) -> str:
    return f"{number(math.degrees(angle), digits)}°"
