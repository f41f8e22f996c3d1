"""Power, trim and speed of a solution as HTML, in the units of the page."""

import math
from html import escape

import numpy as np

from explorer.model.inputs import baseline_title
from explorer.model.units import BLANK, SI, Units, degrees, number
from explorer.text.glossary import tip
from explorer.theme.colours import PARTS
from rotor.analysis.ideal_bound import ideal_factor, not_bounded
from rotor.design.design import Design
from rotor.trim.solution import PowerBudget, Solution

PART_TITLES = {"induced": "Induced", "profile": "Profile", "parasite": "Parasite", "tail": "Tail rotor"}
_ON_A_STAND = {"induced": "Induced", "profile": "Profile", "parasite": "Propulsive"}
_MEANT = {"Propulsive": "propulsive"}
"""Names in the glossary of titles that mean something else than their part in flight."""


def part_titles(*designs: Design) -> dict[str, str]:
    """The parts of power and their titles; a rotor on a test stand has no fuselage and no tail rotor.

    That of the climb is among them where one of the designs climbs or descends.
    """
    tested = [design.condition.stand is not None for design in designs]
    if all(tested):
        return _ON_A_STAND
    titles = {**PART_TITLES, "parasite": "Parasite, propulsive"} if any(tested) else PART_TITLES
    if not any(design.condition.climb_speed for design in designs):
        return titles
    return {name: "Climb" if name == "climb" else titles[name] for name in PARTS}


def power_panel(solution: Solution, baseline: Solution | None, units: Units = SI, band: str = "") -> str:
    """Total power with its change, the bar of parts, and the table of parts; `band`: as `drag_band_words` says it."""
    power = solution.power
    reference = baseline.power if baseline is not None and baseline.converged else None
    titles = part_titles(solution.design)
    rows = "".join(_row(name, title, power, reference, units) for name, title in titles.items())
    ideal = ideal_induced(solution)
    return (
        f'<div class="rx" data-explorer="power">{total_line(power, reference, units)}'
        f'<div class="rx-line rx-dim"{tip("change")}><span>total power</span>'
        f"<span>vs. {escape(baseline_title(solution.design))}</span></div>"
        f'<div class="rx-bar">{bar(power, ideal)}</div><table>{rows}</table>{ideal_line(solution, ideal, units)}'
        f"{band_line(band)}</div>"
    )


def band_line(words: str) -> str:
    """The band of the drag area below the table of powers; empty without words."""
    return f'<div class="rx-dim" data-explorer="drag-band"{tip("drag_band")}>{escape(words)}</div>' if words else ""


def open_drag_area(design: Design) -> tuple[float, float] | None:
    """Lowest and highest drag area [m²] that the sources allow; None where they give one, in hover and on a stand."""
    flies = design.condition.stand is None and not design.hovering and design.models.fuselage
    return design.fuselage.drag_area_band if flies else None


def drag_band_words(design: Design, ends: tuple[Solution, Solution] | None, units: Units) -> str:
    """Total power between the drag areas of the sources; empty where they give one, or `ends` are not known."""
    areas = open_drag_area(design)
    if areas is None or ends is None:
        return ""
    digits = fineness(ends[0].power)
    low, high = (number(units.power[0].of(end.power.total), digits) for end in ends)
    return f"Drag area {number(areas[0], 2)} to {number(areas[1], 2)} m²: {low} to {high} {units.power[0].symbol}"


def total_line(power: PowerBudget, reference: PowerBudget | None, units: Units) -> str:
    """The total in both units of power, and its change."""
    large, small = units.power
    return (
        f'<div class="rx-line rx-base"><span class="rx-total" data-explorer="total-power"{tip("total_power")}>'
        f'{large.text(power.total, fineness(power))}</span><span class="rx-dim">{small.text(power.total)}</span>'
        f'<span class="rx-push"{tip("change")}>{change(power, reference)}</span></div>'
    )


def ideal_induced(solution: Solution) -> float | None:
    """The least induced power [W] of any circulation at this lift; None where the bound does not hold or converge."""
    design = solution.design
    if not_bounded(design):
        return None
    factor = ideal_factor(design.condition.advance_ratio, solution.ct, design.aircraft.key)
    if factor is None or not math.isfinite(solution.ct):
        return None
    return factor * solution.ct * solution.controls.lambda0 * design.power_unit


def ideal_line(solution: Solution, ideal: float | None, units: Units = SI) -> str:
    """κ and its ideal bound."""
    kappa = f'κ = Pi/(CT·λ0) <b data-explorer="kappa">{number(solution.induced_power_factor, 2)}</b>'
    bound = f"ideal: {not_bounded(solution.design)}"
    if ideal is not None:
        unit = solution.ct * solution.controls.lambda0 * solution.design.power_unit
        bound = f'<i class="rx-mark"></i> ideal <b>{units.watts(ideal)}</b>, κ {number(ideal / unit, 2)}'
        if solution.design.hovering:
            bound += " (momentum theory)"
    return f'<div class="rx-line rx-dim rx-kappa"{tip("kappa")}><span>{kappa}</span><span>{bound}</span></div>'


def change(power: PowerBudget, reference: PowerBudget | None) -> str:
    """Change of the total [%]: green for less, rust for more; a dash without a reference."""
    if reference is None or reference.total <= 0.0:
        return f'<span class="rx-dim">{BLANK}</span>'
    percent = 100.0 * (power.total / reference.total - 1.0)
    return (
        f'<span class="rx-change{direction(percent)}" data-explorer="change">{number(percent, 1, sign=True)} %</span>'
    )


def direction(percent: float) -> str:
    """CSS class of a change: green for less, rust for more, none below 0.05 %."""
    return "" if abs(percent) < 0.05 else " rx-less" if percent < 0.0 else " rx-more"


def bar(power: PowerBudget, ideal: float | None) -> str:
    """The parts side by side, and a mark at the ideal induced power."""
    values = {name: getattr(power, name) for name in PARTS}
    parts = {name: value if value > 0.0 and math.isfinite(value) else 0.0 for name, value in values.items()}
    total = max(sum(parts.values()), 1.0)
    spans = "".join(
        f'<span style="flex:{value / total:.5f};background:{PARTS[name]}"></span>' for name, value in parts.items()
    )
    if ideal is None:
        return spans
    return spans + f'<i class="rx-mark" style="position:absolute;left:{100.0 * ideal / total:.2f}%"></i>'


def fineness(power: PowerBudget) -> int:
    """Decimals of a power: one for a light helicopter, none for a heavy one."""
    return 1 if power.total < 2e5 else 0


def _row(name: str, title: str, power: PowerBudget, reference: PowerBudget | None, units: Units) -> str:
    value = getattr(power, name)
    share = 100.0 * value / power.total if power.total > 0.0 else None
    apart = None if reference is None else value - getattr(reference, name)
    return (
        f"<tr{tip(_MEANT.get(title, name))}><td>"
        f'<span class="rx-patch" style="background:{PARTS[name]}"></span>{title}</td>'
        f'<td class="rx-num">{units.watts(value, fineness(power))}</td>'
        f'<td class="rx-num rx-dim" style="width:19%">{number(share)} %</td>'
        f'<td class="rx-num rx-dim" style="width:25%">{units.watts(apart, fineness(power), sign=True)}</td></tr>'
    )


def trim_panel(solution: Solution) -> str:
    """Trim angles, loading, efficiency and areas, in two columns."""
    c = solution.controls
    efficiency = ("lift_to_drag", "Rotor L/De", number(solution.lift_to_drag, 2))
    if solution.design.hovering:
        efficiency = ("figure_of_merit", "Figure of merit", number(solution.figure_of_merit, 3))
    entries = (
        ("collective", "Collective θ0", degrees(c.collective)),
        ("shaft_tilt", "Shaft tilt α", degrees(c.shaft_tilt)),
        ("cyclic_1c", "Cyclic θ1c", degrees(c.cyclic_1c)),
        ("coning", "Coning β0", degrees(c.coning)),
        ("cyclic_1s", "Cyclic θ1s", degrees(c.cyclic_1s)),
        ("flapping_1", "Flap β1c, β1s", f"{number(math.degrees(c.flap_1c), 1)}, {degrees(c.flap_1s, 1)}"),
        ("ct_over_sigma", "CT/σ", number(solution.ct_over_sigma, 4)),
        efficiency,
        ("reverse_flow_area", "Reverse flow", f"{number(100.0 * solution.reverse_flow_area, 1)} %"),
        ("stalled_area", "Stalled area", f"{number(100.0 * solution.stalled_area, 1)} %"),
        *_elastic(solution),
    )
    cells = "".join(
        f'<div class="rx-line"{tip(key)}><span class="rx-dim">{name}</span><span class="rx-num">{value}</span></div>'
        for key, name, value in entries
    )
    return f'<div class="rx rx-grid" data-explorer="trim">{cells}</div>'


def _elastic(solution: Solution) -> tuple[tuple[str, str, str], ...]:
    """Elastic twist of the tip: mean and 1/rev amplitude. Load of one pitch link: mean and half of peak to peak."""
    elastic = solution.elastic
    if elastic is None:
        return ("elastic_tip", "Elastic tip", "rigid"), ("pitch_link", "Pitch link", BLANK)
    load = elastic.pitch_link_load / 1e3
    return (
        ("elastic_tip", "Elastic tip", degrees(float(elastic.tip.mean()))),
        ("elastic_wave", "Elastic 1/rev", degrees(elastic.first_harmonic)),
        ("pitch_link", "Pitch link", f"{number(float(load.mean()), 2)} kN"),
        ("pitch_link_wave", "Pitch link ±", f"{number(0.5 * float(np.ptp(load)), 2)} kN"),
    )


def explanation(text: str) -> str:
    """The line below a menu, in a box of constant height."""
    return f'<div class="rx rx-dim rx-small rx-explain">{escape(text)}</div>'


def heading(title: str, key: tuple[tuple[str, str] | tuple[str, str, bool], ...], entry: str = "") -> str:
    """A chart's title with the key of its lines: name, colour, and whether the line is dashed. `entry`: its tooltip."""
    entries = "".join(f"<span>{dash(colour, *dashed)}{escape(name)}</span>" for name, colour, *dashed in key)
    return (
        f'<div class="rx rx-line rx-heading"{tip(entry) if entry else ""}><span>{escape(title)}</span>{entries}</div>'
    )


def dash(colour: str, dashed: bool = False) -> str:
    """The sample of a line."""
    if dashed:
        return f'<span class="rx-dash rx-dashed" style="color:{colour}"></span>'
    return f'<span class="rx-dash" style="background:{colour}"></span>'


def faded(html: str) -> str:
    """The same text, greyed: out of date."""
    return f'<div class="rx-faded">{html}</div>'
