"""A and B side by side as HTML: power by parts and trim, each with the difference B − A."""

import math
from collections.abc import Callable

from explorer.model.units import SI, Units, number
from explorer.text.glossary import tip
from explorer.text.readout import (
    band_line,
    bar,
    dash,
    direction,
    fineness,
    ideal_induced,
    ideal_line,
    part_titles,
    total_line,
)
from explorer.theme.colours import PARTS, PINNED, THIS
from rotor.trim.solution import PowerBudget, Solution

_Entry = tuple[str, str, Callable[[Solution], float | None], int]
"""Symbol, name in the glossary, function that reads the value, digits."""


def power_panel(solution: Solution, pinned: Solution, units: Units = SI, band: str = "") -> str:
    """Total power with its change relative to A, the bars of both on one scale, and the parts of both.

    Where A has no trim it shows dashes. `band`: of B, as `drag_band_words` says it.
    """
    power = solution.power
    reference = pinned.power if pinned.converged else None
    against = (
        f"vs. {_name('A')}, {units.watts(reference.total)}" if reference else f"{_name('A')}: no trim at this condition"
    )
    ideal = ideal_induced(solution)
    rows = [
        _row(title, power, reference, lambda p, n=name: getattr(p, n), units, name)
        for name, title in part_titles(solution.design, pinned.design).items()
    ]
    rows.append(_row("Total", power, reference, lambda p: p.total, units))
    symbol = units.power[0].symbol
    head = _cells(symbol, (_name("A"), _name("B"), f"Δ {symbol}", "Δ %"), "rx-dim rx-small")
    table = f'<table class="rx-ab" data-explorer="ab">{head}{"".join(rows)}</table>'
    return (
        f'<div class="rx" data-explorer="power">{total_line(power, reference, units)}'
        f'<div class="rx-line rx-dim"{tip("change")}><span>total power of {_name("B")}</span>'
        f"<span>{against}</span></div>"
        f"{_bars(power, reference, ideal)}{table}{ideal_line(solution, ideal, units)}{band_line(band)}</div>"
    )


def trim_panel(solution: Solution, pinned: Solution) -> str:
    """Trim angles, loading, efficiency and areas of A and B, in two columns."""
    degrees, per_cent = math.degrees, 100.0
    efficiency: _Entry = ("L/De", "lift_to_drag", lambda s: s.lift_to_drag, 2)
    if solution.design.hovering:
        efficiency = ("FM", "figure_of_merit", lambda s: s.figure_of_merit, 3)
    entries: tuple[_Entry, ...] = (
        ("θ0 [°]", "collective", lambda s: degrees(s.controls.collective), 2),
        ("α [°]", "shaft_tilt", lambda s: degrees(s.controls.shaft_tilt), 2),
        ("θ1c [°]", "cyclic_1c", lambda s: degrees(s.controls.cyclic_1c), 2),
        ("β0 [°]", "coning", lambda s: degrees(s.controls.coning), 2),
        ("θ1s [°]", "cyclic_1s", lambda s: degrees(s.controls.cyclic_1s), 2),
        ("β1c [°]", "flap_1c", lambda s: degrees(s.controls.flap_1c), 2),
        ("CT/σ", "ct_over_sigma", lambda s: s.ct_over_sigma, 4),
        ("β1s [°]", "flap_1s", lambda s: degrees(s.controls.flap_1s), 2),
        ("κ", "kappa", lambda s: s.induced_power_factor, 2),
        efficiency,
        ("rev. [%]", "reverse_flow_area", lambda s: per_cent * s.reverse_flow_area, 1),
        ("stall [%]", "stalled_area", lambda s: per_cent * s.stalled_area, 1),
        ("φ tip [°]", "elastic_tip", lambda s: degrees(float(s.elastic.tip.mean())) if s.elastic else None, 2),
        ("link [kN]", "pitch_link", lambda s: float(s.elastic.pitch_link_load.mean()) / 1e3 if s.elastic else None, 2),
    )
    head = f'<div class="rx-four rx-dim rx-small"><span></span><span>{_name("A")}</span><span>{_name("B")}</span></div>'
    cells = [head, head]
    for short, key, read, digits in entries:
        a = number(read(pinned) if pinned.converged else None, digits)
        cells.append(
            f'<div class="rx-four"{tip(key)}><span class="rx-dim">{short}</span>'
            f"<span>{a}</span><span>{number(read(solution), digits)}</span></div>"
        )
    return f'<div class="rx rx-grid" data-explorer="trim">{"".join(cells)}</div>'


def _name(letter: str) -> str:
    """A or B with the mark of its lines in the charts."""
    return f"{dash(PINNED, dashed=True) if letter == 'A' else dash(THIS)}<b>{letter}</b>"


def _bars(power: PowerBudget, reference: PowerBudget | None, ideal: float | None) -> str:
    """A above B; the length of a bar is the total power."""
    longest = max(power.total, reference.total if reference else 0.0, 1.0)
    lines = []
    for letter, one, mark in (("A", reference, None), ("B", power, ideal)):
        length = 100.0 * max(one.total, 0.0) / longest if one else 0.0
        filled = f'<div class="rx-bar" style="width:{length:.2f}%">{bar(one, mark) if one else ""}</div>'
        lines.append(f'<span class="rx-dim">{letter}</span><div>{filled}</div>')
    return f'<div class="rx-bars">{"".join(lines)}</div>'


def _row(
    title: str,
    power: PowerBudget,
    reference: PowerBudget | None,
    read: Callable[[PowerBudget], float],
    units: Units,
    part: str = "",
) -> str:
    unit = units.power[0]
    b = unit.of(read(power))
    a = None if reference is None else unit.of(read(reference))
    apart = None if a is None else b - a
    percent = None if a is None or apart is None or a <= 0.0 else 100.0 * apart / a
    changes = (number(apart, 1, sign=True), number(percent, 1, sign=True))
    fine = fineness(power)
    if part:
        patch = f'<span class="rx-patch" style="background:{PARTS[part]}"></span>'
        return _cells(patch + title, (number(a, fine), number(b, fine), *changes), tooltip=tip(part))
    kind = "" if percent is None else direction(percent)
    coloured = (f'<span class="{kind.strip()}">{text}</span>' for text in changes)
    return _cells(title, (number(a, fine), number(b, fine), *coloured), "rx-sum", tip("total_power"))


def _cells(title: str, values: tuple[str, ...], kind: str = "", tooltip: str = "") -> str:
    cells = "".join(f'<td class="rx-num">{value}</td>' for value in values)
    return f'<tr class="{kind}"{tooltip}><td>{title}</td>{cells}</tr>'
