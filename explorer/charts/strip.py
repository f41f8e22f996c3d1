"""The charts of the results strip as plain values: power over µ, α and lift.

Each chart compares this design with its reference. Gaps are NaN. Power has two scales: that of the speeds about the
least, in which one designs, and the whole.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from explorer.charts.curve_bands import Bands, band_along
from explorer.charts.plots import SWEEP, PowerCurve, Range, alpha_along, angles_along, held_range
from explorer.model.units import KILOWATT, SI, Units, number
from explorer.picture.picture import at_azimuth
from rotor import Design, Solution
from rotor.aero.display import STALLED
from rotor.support.arrays import Array, Booleans
from rotor.support.chart import Axis, Band, Chart, Line, Points, Rule, Values

Role = Literal["this", "reference", "pinned", "limit", "saving", "earlier", "flown"]
"""What a line stands for.
`earlier`: of the design before this one; `flown`: with elastic twist; `pinned`: A as the reference."""
LOOKS: dict[Role, tuple[str, float, str]] = {
    "this": ("var(--rx-blade)", 2.1, ""),
    "saving": ("var(--rx-accent)", 2.0, ""),
    "flown": ("var(--rx-accent)", 1.7, ""),
    "earlier": ("var(--rx-overlay)", 1.6, ""),
    "reference": ("var(--rx-overlay)", 1.5, "4 3"),
    "pinned": ("var(--rx-pinned)", 1.7, "6 3"),
    "limit": ("var(--rx-stall)", 1.3, "3 3"),
}
"""Colour, width [px] and dashes by role."""
Scales = tuple[Range | None, Range | None]
NONE: Scales = (None, None)
_BOWL = 1.25
"""Powers up to this part of the least lie on the scale that a chart opens with."""
_LEAST_SWEPT = 4
"""Fewest points from which a top speed is shown."""
INK, THIS, SAVING = "var(--rx-ink)", LOOKS["this"][0], LOOKS["saving"][0]


def role_line(role: Role, x: Values, y: Values, *, label: str = "", filled: bool = False) -> Line:
    colour, width, dashes = LOOKS[role]
    return Line(label, x, y, colour, dashes, width, filled=filled)


def now_dot(x: float, y: float, band: float = 0.0) -> Points:
    """The present condition, in the units of the axes, as `band`."""
    return Points("", (x,), (y,), THIS, size=4.5, words=("now",), scatter=(band,) if band else ())


def _hover_dot(y: float) -> Points:
    return Points("", (0.0,), (y,), SAVING, size=3.5, words=("hover",))


_FINE = np.linspace(SWEEP[0], SWEEP[-1], 5 * len(SWEEP) - 4)
"""Advance ratios at which a curve is drawn, those of `SWEEP` among them."""


def _smooth(role: Role, power: Array, *, filled: bool = False) -> Line:
    """A cubic through the values of a sweep, with its gaps."""
    known = np.isfinite(power)
    if known.sum() < _LEAST_SWEPT:
        return role_line(role, SWEEP, power, filled=filled)
    between = np.interp(_FINE, SWEEP, known) > 1.0 - 1e-9
    values = CubicSpline(np.array(SWEEP)[known], power[known])(_FINE)
    return role_line(role, _FINE, np.where(between, values, np.nan), filled=filled)


def _near(power: Array, values: Array) -> list[float]:
    """The values where the power of a sweep is about the least; all where the air drives the rotor."""
    least = min(_known(power.tolist()), default=0.0)
    return values[power < (_BOWL * least if least > 0.0 else math.inf)].tolist()


def power_change_chart(
    curve: PowerCurve,
    mu: float,
    change: float | None,
    reference: str,
    units: Units = SI,
    held: Scales = NONE,
    band: float | None = None,
) -> Chart:
    """Change of total power against the reference over µ; hover and the present condition are dots.

    `curve`: in kW over `SWEEP`. `change`: at the present condition [W], None without trim. `reference`: its name.
    `held`: the two scales before. `band`: of `change` [W], None where it is not known.
    """
    unit = units.power[0]
    within = unit.of(band or 0.0)
    apart = (curve.design - curve.reference) * (KILOWATT.size / unit.size)
    mus = np.array(SWEEP)
    now = math.nan if change is None else unit.of(change)
    reach = now, now - within, now + within
    seen = (*apart[mus <= max(0.4, mu)], *reach, 0.0)
    near, whole = _scales(
        (*_near(curve.design, apart), *reach, -2.0, 2.0), (*seen, -2.0, 2.0), held
    )
    line = _smooth("saving" if curve.current else "earlier", apart, filled=curve.current)
    hover = [_hover_dot(float(apart[0]))] if curve.current else []
    return Chart(
        "Power over µ",
        Axis("µ", (0.0, SWEEP[-1]), (0.0, 0.2, 0.4)),
        Axis(f"{unit.symbol} vs. {reference}", near, whole=whole),
        (line, *hover, now_dot(mu, now, within)),
        note=autorotation_words(curve),
    )


def _scales(
    near: Sequence[float], whole: Sequence[float], held: Scales
) -> tuple[Range, Range | None]:
    """The axis about some values, and that of all where it is another; each is held while its values fit."""
    ends = ([end(_known(of), default=math.nan) for end in (min, max)] for of in (near, whole))
    first, second = (
        held_range(before, low, high) for before, (low, high) in zip(held, ends, strict=True)
    )
    return first, None if second == first else second


def _known(values: Sequence[float]) -> list[float]:
    return [value for value in values if math.isfinite(value)]


def autorotation_words(curve: PowerCurve) -> str:
    """Where the air drives the rotor in descent, and where no speed has an answer; empty in level flight and climb."""
    mus, driven, known = np.array(SWEEP), curve.design < 0.0, np.isfinite(curve.design)
    if not curve.current or not driven.any():
        return ""
    words = f"Autorotation between µ {mus[driven][0]:g} and {mus[driven][-1]:g}: the air drives the rotor."
    return (
        words if known[0] else f"{words} No solution below µ {mus[known][0]:g}: vortex ring state."
    )


def total_power_chart(
    curve: PowerCurve,
    mu: float,
    total: float | None,
    units: Units = SI,
    held: Scales = NONE,
    marks: Points | None = None,
    design: Design | None = None,
) -> Chart:
    """Total power over µ of a design that is its own reference; hover and the present condition are dots.

    `curve`: in kW over `SWEEP`. `total`: at the present condition [W], None without trim. `held`: the two scales
    before. `marks`: main-rotor power measured in flight; then the computed one is a line. `design`: draws the
    power of its engines, where the rotor file has it.
    """
    unit = units.power[0]
    here = curve.in_unit(unit)
    power = here.design
    mus, now = np.array(SWEEP), math.nan if total is None else unit.of(total)
    flown = ((), ()) if marks is None else (marks.x, marks.y)
    # Measured flights end far below µ 0.4, so their axis is shorter.
    fastest = max(flown[0], default=0.4)
    values = (*power[mus <= max(fastest + 0.03, mu)], now, *flown[1])
    least = int(np.nanargmin(np.where(mus > 0.0, power, math.inf)))
    known = curve.current and math.isfinite(power[least])
    role: Role = "saving" if curve.current else "earlier"
    line = _smooth(role, power)
    driven = replace(line, y=[min(value, 0.0) or math.nan for value in line.y], filled=True)
    value = "driven by the air" if now < 0.0 else f"least near µ {mus[least]:.2f}" if known else ""
    note, engines = autorotation_words(curve), []
    if design is not None and design.aircraft.installed_power is not None:
        installed = unit.of(design.aircraft.installed_power)
        engines = [role_line("limit", mus, np.full(len(mus), installed))]
        top = top_speed(mus, power, installed) if curve.current else math.nan
        note += f" Engines: {number(installed)} {unit.symbol} at sea level on a standard day, less in high or warm air."
        note += " Gearbox losses and limits are not included, so the top speed is an upper bound."
        if math.isfinite(top) and value and now >= 0.0:
            value = f"top ≤ {units.speed[0].text(top * design.rotor.tip_speed)}"
    shaft = (
        [] if here.main_rotor is None or marks is None else [_smooth("reference", here.main_rotor)]
    )
    bowl, all_of_it = _near(power, power), (0.0, *values)
    y_range, whole = _scales((*bowl, now, *flown[1]) if bowl else all_of_it, all_of_it, held)
    return Chart(
        "Power over µ",
        Axis("µ", (0.0, SWEEP[-1]), (0.0, 0.2, 0.4)),
        Axis(f"{unit.symbol}; dashed: rotor" if shaft else unit.symbol, y_range, whole=whole),
        (
            *_mostly_seen(engines, whole or y_range),
            *shaft,
            line,
            *([driven] if (power < 0.0).any() else []),
            *([] if marks is None else [marks]),
            *([_hover_dot(float(power[0]))] if curve.current else []),
            now_dot(mu, now),
        ),
        value=value,
        note=note.strip(),
    )


def with_band(chart: Chart, bands: Bands, units: Units) -> Chart:
    """Power over µ, or its change, with the band of its curve, if any speed has one, in place of the area to zero."""
    line = next(line for line in chart.series if isinstance(line, Line) and line.colour == SAVING)
    x, y = np.array(line.x), np.array(line.y)
    half = band_along(bands, x) / units.power[0].size
    known = np.isfinite(y + half)
    if not known.any():
        return chart
    x, y, half = x[known], y[known], half[known]
    note = f"{chart.note} Shaded: its uncertainty.".strip()
    series = (replace(one, filled=False) if one is line else one for one in chart.series)
    return replace(chart, series=(Band("", x, y - half, y + half, SAVING), *series), note=note)


def _mostly_seen(limits: list[Line], y_range: Range) -> list[Line]:
    """The series of which most lies within the axis."""
    low, high = y_range
    return [limit for limit in limits if np.mean([low <= value <= high for value in limit.y]) > 0.5]


def top_speed(mus: Array, power: Array, installed: float) -> float:
    """The advance ratio beyond which power stays above what is installed; NaN where the curve does not reach it.

    `power` (points,), in the unit of `installed`; NaN where there is no trim.
    """
    known = np.isfinite(power)
    x, above = mus[known], power[known] - installed
    below = np.flatnonzero(above <= 0.0)
    if not len(below) or below[-1] == len(x) - 1:
        return math.nan
    k = below[-1]
    return float(x[k] + (x[k + 1] - x[k]) * above[k] / (above[k] - above[k + 1]))


def with_speeds(chart: Chart, curve: PowerCurve, design: Design) -> tuple[Chart, float]:
    """Power over µ with walls and two speeds of level flight; and the fastest µ before them.

    A wall is the power of the engines, or the last trim of the sweep. Endurance is longest where power is least, range
    where power over speed is, as long as fuel flow is proportional to power (Leishman, Principles of Helicopter
    Aerodynamics, 2nd ed., chapter 5). `curve`: in kW over `SWEEP`.
    """
    mus, known = np.array(SWEEP), np.isfinite(curve.design)
    x, power = mus[known], curve.design[known]
    if len(x) < _LEAST_SWEPT:
        return chart, math.nan
    walls, marks = [(float(x[-1]), "no trim")] if x[-1] < mus[-1] else [], ()
    installed = design.aircraft.installed_power
    if installed is not None and math.isfinite(
        top := top_speed(mus, curve.design, installed / KILOWATT.size)
    ):
        walls.append((top, "engines"))
    if design.vertical_speed == 0.0:
        marks = _economic_speeds(tuple(x.tolist()), tuple(power.tolist()))
    drawn = next(line for line in chart.series if isinstance(line, Line) and line.colour == SAVING)

    def mark(mu: float, word: str) -> Points:
        return Points(
            "",
            (mu,),
            (float(np.interp(mu, drawn.x, drawn.y)),),
            SAVING,
            "ring",
            words=(f"Longest {word}: µ {mu:.2f}, if fuel flow follows power",),
            names=(word,),
            size=3.5,
            name_place="above" if word == "endurance" else "below",
        )

    rules = [Rule(mu, label=word, colour=LOOKS["limit"][0]) for mu, word in walls]
    *lines, now = chart.series
    series = (*lines, *(mark(*of) for of in marks), now)
    chart = replace(chart, series=series, rules=(*chart.rules, *rules))
    return chart, min((mu for mu, _ in walls), default=float(x[-1]))


@lru_cache(maxsize=8)
def _economic_speeds(
    mus: tuple[float, ...], power: tuple[float, ...]
) -> tuple[tuple[float, str], ...]:
    """µ of least power and of least power over speed, with what it is best for, where they lie within the curve.

    Kept, because a curve stays the same while the speed is dragged.
    """
    fine, marks = np.linspace(max(mus[0], 0.02), mus[-1], 800), list[tuple[float, str]]()
    total = CubicSpline(mus, power)(fine)
    for word, cost in (("endurance", total), ("range", total / fine)):
        k = int(np.argmin(cost))
        if 0 < k < len(fine) - 1:
            marks.append((float(fine[k]), word))
    return tuple(marks)


_ALONG = Axis("r/R", (0.1, 1.0), (0.1, 1.0), ("root", "tip"))


def alpha_chart(
    solution: Solution,
    reference: Solution | None,
    azimuth_deg: float,
    previous: Range | None = None,
    compared: Role = "reference",
) -> Chart:
    """α along the reference blade with the static stall angles; gaps in reverse flow.

    What lies between is shaded where α is past a static angle, in the colour of stall where the flow is separated.
    """
    lower, upper, alpha = angles_along(solution, azimuth_deg)
    r = solution.disk.r
    lines, seen = list[Line](), [alpha]
    if reference is not None and reference.converged:
        other = alpha_along(reference, azimuth_deg)
        lines.append(role_line(compared, reference.disk.r, other))
        seen.append(other)
    lines.append(role_line("this", r, alpha))
    finite = np.concatenate(seen)
    finite = np.clip(finite[np.isfinite(finite)], -15.0, 20.0)
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    bands, value, note = list[Band](), "", ""
    if solution.design.models.stall:
        blade = _blade_flow(solution, azimuth_deg)
        bands = _past_static_bands(blade)
        value, note = _stall_words(blade)
    y_range = held_range(previous, min(low, -2.0), max(high, 14.0))
    limits = _mostly_seen([role_line("limit", r, limit) for limit in (lower, upper)], y_range)
    return Chart(
        "Angle of attack",
        _ALONG,
        Axis("° on the red blade", y_range),
        (*bands, *limits, *lines),
        value=value,
        note=note,
    )


class _BladeFlow(NamedTuple):
    """The flow along a blade at one azimuth, (radii,) each; NaN in reverse flow."""

    r: Array
    """y/R"""
    alpha: Array
    """[°]"""
    static: Array
    """The static stall angle on the side of α [°]."""
    margin: Array
    """To the static stall angle [°], negative past it."""
    separated: Booleans
    past_static: Booleans
    """Past the static stall angle with the flow still attached."""


_SHADE = 0.45
"""Opacity of what lies between α and the static stall angle."""
_ALONG_BLADE = 240
"""Even radii, besides those of the elements, at which regions along a blade are told apart."""


def _blade_flow(solution: Solution, azimuth_deg: float) -> _BladeFlow:
    disk = solution.disk
    r = np.union1d(disk.r, np.linspace(disk.r[0], disk.r[-1], _ALONG_BLADE))
    lower, upper, alpha = (
        np.interp(r, disk.r, values) for values in angles_along(solution, azimuth_deg)
    )
    margin = np.minimum(upper - alpha, alpha - lower)
    separated = margin < 0.0
    if disk.unsteady is not None:
        separation = at_azimuth(solution, disk.unsteady.separation, math.radians(azimuth_deg))
        separated = (np.interp(r, disk.r, separation) < STALLED) & np.isfinite(alpha)
    return _BladeFlow(
        r=r,
        alpha=alpha,
        static=np.where(alpha > 0.5 * (lower + upper), upper, lower),
        margin=margin,
        separated=separated,
        past_static=(margin < 0.0) & ~separated,
    )


def _past_static_bands(blade: _BladeFlow) -> list[Band]:
    """The areas between α and the static stall angle, one for each stretch of the blade."""
    bands = list[Band]()
    for where, colour in (
        (blade.past_static, "var(--rx-dim)"),
        (blade.separated, LOOKS["limit"][0]),
    ):
        for part in _stretches(where):
            x, alpha, static = blade.r[part], blade.alpha[part], blade.static[part]
            low, high = np.minimum(alpha, static), np.maximum(alpha, static)
            bands.append(Band("", x, low, high, colour, opacity=_SHADE))
    return bands


def _stretches(where: Booleans) -> list[slice]:
    """The runs of true values."""
    ends = np.flatnonzero(np.diff(np.concatenate(([False], where, [False]))))
    return [slice(int(first), int(last)) for first, last in ends.reshape(-1, 2)]


def lift_chart(
    solution: Solution,
    reference: Solution | None,
    previous: Range | None = None,
    compared: Role = "reference",
) -> Chart:
    """Lift of one blade per metre of span, mean of a revolution [kN/m]."""
    lines = [role_line("this", solution.disk.r, lift_per_metre(solution) / 1e3)]
    if reference is not None and reference.converged:
        lines.insert(0, role_line(compared, reference.disk.r, lift_per_metre(reference) / 1e3))
    low, high = (end(end(line.y) for line in lines) for end in (min, max))
    peak = float(solution.disk.r[np.argmax(lines[-1].y)])
    scale = Axis("kN/m per blade", held_range(previous, min(0.0, low), high))
    return Chart(
        "Lift",
        _ALONG,
        scale,
        tuple(lines),
        value=f"peak at {peak:.2f} R",
        note="Mean over azimuth.",
    )


def lift_per_metre(solution: Solution) -> Array:
    """Thrust of one blade per metre of span, mean of a revolution [N/m], (elements,)."""
    return solution.disk.dct.mean(axis=1) * solution.design.thrust_per_metre


def _stall_words(blade: _BladeFlow) -> tuple[str, str]:
    """Value and note of a chart: whether a blade has separated flow, is past the static angle, or how far before it."""
    if blade.separated.any():
        return "separated", f"Separated between {_ends(blade.r, blade.separated)} R."
    if blade.past_static.any():
        return (
            "past the static angle",
            f"Past the static stall angle, still attached, between {_ends(blade.r, blade.past_static)} R.",
        )
    if not np.isfinite(blade.margin).any():
        return "", ""
    at = int(np.nanargmin(blade.margin))
    margin = number(float(blade.margin[at]), 1)
    return f"{margin}° to static stall", f"Least margin at {blade.r[at]:.2f} R."


def _ends(r: Array, where: Booleans) -> str:
    """The first and the last radius of a region: `0.42 and 0.55`."""
    return f"{float(r[where].min()):.2f} and {float(r[where].max()):.2f}"
