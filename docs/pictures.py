"""The drawings of the documentation, computed while the site is built; each function returns HTML with SVG in it."""

from html import escape

import numpy as np

import rotor
from explorer.charts.svg import HALF_EDGE, bar_drawing, disk_drawing, key_entries
from explorer.colours import PARTS
from explorer.export.figures import figure
from explorer.picture.fields import FIELDS
from rotor.support.chart import Axis, Chart, Line

_COLOURS = ("#1c7ed6", "#e8590c", "#0ca678", "#9c36b5")


def power_of_twist() -> str:
    """Power by parts over linear twist, in hover and in fast flight."""
    rates = np.arange(-20.0, 0.1, 2.0)
    charts = []
    for title, speed in (("Hover", 0.0), ("µ = 0.3", 0.3)):
        design = rotor.make_design(mu=speed)
        powers = [rotor.solve(design.with_twist(f"linear:{rate:g}")).power for rate in rates]
        total = np.array([power.total for power in powers])
        series = [Line("total", rates, 100.0 * (total / total.min() - 1.0), "currentColor")]
        for part in ("induced", "profile"):
            values = np.array([getattr(power, part) for power in powers])
            change = 100.0 * (values - values[-1]) / total.min()
            series.append(Line(part, rates, change, PARTS[part], dashes=True))
        charts.append(
            figure(
                Chart(
                    title,
                    Axis("linear twist [°]", range=(-20.0, 0.0)),
                    Axis("change [% of the least power]"),
                    tuple(series),
                )
            )
        )
    return "".join(charts)


def disk_in_fast_flight() -> str:
    """Angle of attack and induced inflow at µ = 0.35, with reverse flow and stall marked."""
    solution = rotor.solve(rotor.make_design(mu=0.35))
    return disk_figure(solution, "Angle of attack") + disk_figure(solution, "Induced inflow λi")


def twist_and_stall() -> str:
    """Angle of attack at µ = 0.35 with little and with much twist."""
    design = rotor.make_design(mu=0.35)
    return "".join(
        disk_figure(
            rotor.solve(design.with_twist(f"linear:{rate}")),
            "Angle of attack",
            f"Twist {rate}°".replace("-", "−"),
        )
        for rate in (-4, -18)
    )


def shipped_rotors() -> str:
    """Power over advance ratio of the shipped rotors, per weight."""
    series = []
    for name, colour in zip(("uh60a", "r22", "s61"), _COLOURS, strict=False):
        table = [
            one
            for one in rotor.sweep(rotor.make_design(rotor=name), np.arange(0.08, 0.321, 0.04))
            if one.converged
        ]
        speeds = np.array([one.design.condition.advance_ratio for one in table])
        loading = np.array([one.power.total / one.design.condition.weight for one in table])
        series.append(Line(table[0].design.rotor.name, speeds, loading, colour))
    speed = Axis("advance ratio µ", range=(0.05, 0.35))
    return figure(Chart("Power over weight", speed, Axis("power over weight [W/N]"), tuple(series)))


def disk_figure(solution: rotor.Solution, field: str, title: str = "") -> str:
    """A field over the disk with its key."""
    shown = FIELDS[field]
    colour_range = shown.low, shown.high
    name = f"bar-{abs(hash((solution.design, field))):x}"
    key = "".join(
        f'<span><svg width="14" height="8">{swatch}</svg> {escape(words)}</span>'
        for words, swatch in key_entries(solution)
    )
    drawn = disk_drawing(solution, shown, colour_range, 400, letters=10.0)
    bar = bar_drawing(shown, colour_range, 200.0, name, 10.0)
    box = f"{-HALF_EDGE:g} {-HALF_EDGE:g} {2 * HALF_EDGE:g} {2 * HALF_EDGE:g}"
    return (
        f"<figure><figcaption><b>{escape(title or shown.title)}</b>{key}</figcaption>"
        f'<svg viewBox="{box}" role="img" aria-label="{escape(shown.title)}">'
        f'{drawn}</svg><svg class="bar-svg" viewBox="-14 0 228 40">{bar}'
        "</svg></figure>"
    )
