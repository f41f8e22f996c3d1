"""Power and trim of a solution, or of A and B with their differences, as HTML in the units of the page.

Below it, what an actuator saves and costs in words: one place for card, rail and report.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Literal, NamedTuple

import numpy as np

from explorer.colours import PARTS, PINNED, THIS
from explorer.model.inputs import baseline_title
from explorer.model.units import BLANK, SI, WATT, Unit, Units, adding, number
from explorer.text.glossary import tip
from rotor import Design, PowerBudget, Solution
from rotor.actuator import InstalledActuator, Verdict
from rotor.optimisation import Mission
from rotor.optimisation.ideal_bound import ideal_factor, not_bounded
from rotor.support.markup import Content, Markup, tag
from rotor.trim.doubt import ESTIMATED, MOST_OF_SMALL, Doubt, rounded_pair, sure_words, sureness
from rotor.trim.solution import ElasticTwist

PART_TITLES = {
    "induced": "Induced",
    "profile": "Profile",
    "parasite": "Parasite",
    "tail": "Tail rotor",
}
_ON_A_STAND = {"induced": "Induced", "profile": "Profile", "parasite": "Propulsive"}
_MEANT = {"Propulsive": "propulsive"}
"""Names in the glossary of titles that mean something else than their part in flight."""


def part_titles(*designs: Design) -> dict[str, str]:
    """The parts of power and their titles; a rotor on a test stand has no fuselage and no tail rotor.

    That of the climb is among them where one of the designs climbs or descends.
    """
    tested = [design.condition.stand is not None for design in designs]
    if all(tested):
        titles = _ON_A_STAND
    elif any(tested):
        titles = {**PART_TITLES, "parasite": "Parasite, propulsive"}
    else:
        titles = PART_TITLES
    if not any(design.vertical_speed for design in designs):
        return titles
    titles = {**titles, "climb": "Climb"}
    return {name: titles[name] for name in PARTS if name in titles}


def power_panel(
    solution: Solution, baseline: Solution | None, units: Units = SI, band: Doubt | None = None
) -> Markup:
    """Total power with its change, and the table of parts."""
    power = solution.power
    reference = baseline.power if baseline is not None and baseline.converged else None
    titles = part_titles(solution.design)
    rows = [_row(name, title, power, reference, units, band) for name, title in titles.items()]
    against = baseline_title(solution.design, baseline and baseline.design)
    words = tag("span", "total power"), tag("span", f"vs. {against}")
    return _panel(solution, reference, words, tag("table", rows), units, band)


def _panel(
    solution: Solution,
    reference: PowerBudget | None,
    words: Content,
    table: Markup,
    units: Units,
    band: Doubt | None,
) -> Markup:
    """A total with its change, its table of parts and the ideal; `words`: what the total is, and against what."""
    power = solution.power
    total = units.power[0].text(power.total, fineness(power, units))
    return tag(
        "div.rx",
        tag(
            "div.rx-line.rx-base",
            tag("span.rx-total", total, data_explorer="total-power", title=tip("total_power")),
            tag("span.rx-dim", units.other_watts(power.total)),
            tag("span.rx-push", change(power, reference, band)),
        ),
        tag("div.rx-line.rx-dim", words, title=tip("change")),
        table,
        ideal_line(solution, ideal_induced(solution), units),
        data_explorer="power",
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


def ideal_line(solution: Solution, ideal: float | None, units: Units = SI) -> Markup:
    """κ and its ideal bound; ideal: least induced power [W]."""
    kappa = (
        "κ = Pi/(CT·λ0) ",
        tag("b", number(solution.induced_power_factor, 2), data_explorer="kappa"),
    )
    bound: Content = f"ideal: {not_bounded(solution.design)}"
    if ideal is not None and solution.induced_power_factor:
        theory = " (momentum theory)" if solution.design.hovering else ""
        least = solution.induced_power_factor * ideal / solution.power.induced
        power, factor = tag("b", units.watts(ideal)), f", κ {number(least, 2)}{theory}"
        bound = "ideal ", power, factor
    return tag(
        "div.rx-line.rx-dim.rx-kappa", tag("span", kappa), tag("span", bound), title=tip("kappa")
    )


def change(power: PowerBudget, reference: PowerBudget | None, band: Doubt | None = None) -> Markup:
    """Change of the total [%], with its band once that is known: green for a saving whose sign is known, rust for a
    cost; a dash without a reference."""
    if reference is None or reference.total <= 0.0:
        return tag("span.rx-dim", BLANK)
    percent = 100.0 * (power.total / reference.total - 1.0)
    words = "" if band is None else band.saving_words
    words = words or f"{number(percent, 1, sign=True)} %"
    # There is room for the word alone; why it is not "sure" stands on the line, and here in the tooltip.
    words, capped, _ = words.partition(f", {ESTIMATED}")
    title = f"{tip('change')} Likely, {ESTIMATED}." if capped else tip("change")
    kind = change_kind(percent, band and band.sureness)
    return tag(
        "span.rx-change", words, class_=kind and f"rx-{kind}", title=title, data_explorer="change"
    )


def change_kind(change: float, word: str | None) -> Literal["", "less", "more"]:
    """The colour of a change: none unless its sign is sure or likely."""
    if word not in ("sure", "likely"):
        return ""
    return "less" if change < 0.0 else "more"


def part_change(
    name: str,
    power: PowerBudget,
    reference: PowerBudget,
    band: Doubt | None,
    units: Units,
    digits: int = 1,
) -> tuple[str, str]:
    """Change of a part of power, or of the `total`, with its band and whether its sign is known: `−12 ± 4`, `sure`.

    Where the band is not known, and where nothing changes, with these digits and without the last two.
    """
    change = getattr(power, name) - getattr(reference, name)
    unit = units.power[0]
    bands = {} if band is None else {**band.part_bands, "total": band.change_band}
    within = bands.get(name)
    if not within or max(abs(unit.of(change)), unit.of(within)) < 0.05:
        return number(unit.of(change), digits, sign=True), ""
    pair = rounded_pair(unit.of(change), unit.of(within))
    size = number(pair.change, pair.decimals, sign=True)
    word = sureness(change, within, sourced=band is None or band.sourced)
    return f"{size} ± {number(pair.band, pair.decimals)}", word


def fineness(power: PowerBudget, units: Units = SI) -> int:
    """Decimals of a power: one for a light helicopter, none for a heavy one; in watts likewise."""
    return _fineness(power.total, units)


def total_words(total: float, units: Units = SI) -> str:
    """Total power [W] with the decimals of the line: that of an optimum has none that its band does not allow."""
    return f"{total_size(total, units)} {units.power[0].symbol}"


def total_size(total: float, units: Units = SI) -> str:
    """Total power [W] as in `total_words`, without its unit."""
    return number(units.power[0].of(total), _fineness(total, units))


def _fineness(total: float, units: Units) -> int:
    """Decimals of powers beside a total [W]."""
    return 1 if abs(total) < (200.0 if units.power[0] is WATT else 2e5) else 0


def _row(
    name: str,
    title: str,
    power: PowerBudget,
    reference: PowerBudget | None,
    units: Units,
    band: Doubt | None,
) -> Markup:
    """A part of power: its value, its share of the total, its change, and how sure that is."""
    value = getattr(power, name)
    share = 100.0 * value / power.total if power.total > 0.0 else None
    apart, word = BLANK, ""
    if reference is not None:
        apart, word = part_change(name, power, reference, band, units)
    return tag(
        "tr",
        tag("td", patch(PARTS[name]), title),
        tag("td.rx-num", units.watts(value, fineness(power, units))),
        tag("td.rx-num.rx-dim", f"{number(share)} %", style="width:12%"),
        tag("td.rx-num.rx-dim", apart, style="width:28%"),
        tag("td.rx-dim", word, style="width:17%;padding-left:5px"),
        title=tip(_MEANT.get(title, name)),
    )


def index_unit(design: Design) -> str:
    """What the vibration index is a part of: a rotor on a test stand carries no weight."""
    return "% of weight" if design.condition.stand is None else "% of thrust"


def patch(colour: str) -> Markup:
    """A square of the colour, before the name of what is drawn in it."""
    return tag("span.rx-patch", style=f"background:{colour}")


_TrimRow = tuple[str, str, int, str, Callable[[Solution], float | None]]
TRIM_ROWS: dict[str, _TrimRow] = {
    "collective": (
        "Collective θ0",
        "θ0 [°]",
        2,
        "°",
        lambda s: math.degrees(s.controls.collective),
    ),
    "shaft_tilt": ("Shaft tilt α", "α [°]", 2, "°", lambda s: math.degrees(s.controls.shaft_tilt)),
    "cyclic_1c": ("Cyclic θ1c", "θ1c [°]", 2, "°", lambda s: math.degrees(s.controls.cyclic_1c)),
    "coning": ("Coning β0", "β0 [°]", 2, "°", lambda s: math.degrees(s.controls.coning)),
    "cyclic_1s": ("Cyclic θ1s", "θ1s [°]", 2, "°", lambda s: math.degrees(s.controls.cyclic_1s)),
    "flap_1c": ("Flap β1c, β1s", "β1c [°]", 2, "°", lambda s: math.degrees(s.controls.flap_1c)),
    "ct_over_sigma": ("CT/σ", "CT/σ", 4, "", lambda s: s.ct_over_sigma),
    "flap_1s": ("", "β1s [°]", 2, "°", lambda s: math.degrees(s.controls.flap_1s)),
    "kappa": ("", "κ", 2, "", lambda s: s.induced_power_factor),
    "figure_of_merit": ("Figure of merit", "FM", 3, "", lambda s: s.figure_of_merit),
    "lift_to_drag": ("Rotor L/De", "L/De", 2, "", lambda s: s.lift_to_drag),
    "reverse_flow_area": (
        "Reverse flow",
        "rev. [%]",
        1,
        " %",
        lambda s: 100.0 * s.reverse_flow_area,
    ),
    "stalled_area": ("Separated area", "separated [%]", 1, " %", lambda s: 100.0 * s.stalled_area),
    "elastic_tip": (
        "Elastic tip",
        "φ tip [°]",
        2,
        "°",
        lambda s: _elastic(s, lambda e: np.degrees(e.tip.mean())),
    ),
    "elastic_wave": (
        "Elastic 1/rev",
        "",
        2,
        "°",
        lambda s: _elastic(s, lambda e: math.degrees(e.first_harmonic)),
    ),
    "pitch_link": (
        "Pitch link",
        "link [kN]",
        2,
        " kN",
        lambda s: _elastic(s, lambda e: e.pitch_link_load.mean() / 1e3),
    ),
    "pitch_link_wave": (
        "Pitch link ±",
        "",
        2,
        " kN",
        lambda s: _elastic(s, lambda e: 0.5e-3 * np.ptp(e.pitch_link_load)),
    ),
}
"""Title, short title beside A (empty: not there), digits, unit and value of a trim quantity, by its name in the
glossary."""


def _elastic(solution: Solution, read: Callable[[ElasticTwist], float]) -> float | None:
    """A number of the elastic twist; None for a blade that is rigid in torsion."""
    return float(read(solution.elastic)) if solution.elastic else None


def _trim_rows(solution: Solution) -> list[tuple[str, _TrimRow]]:
    """The trim quantities of a flight: in hover with the figure of merit, else with lift to drag."""
    other = "lift_to_drag" if solution.design.hovering else "figure_of_merit"
    return [(key, row) for key, row in TRIM_ROWS.items() if key != other]


def trim_panel(solution: Solution) -> Markup:
    """Trim angles, loading, efficiency and areas, in two columns."""
    flapping = (
        number(math.degrees(angle), 1)
        for angle in (solution.controls.flap_1c, solution.controls.flap_1s)
    )
    cells: list[Markup] = []
    for key, (title, _, digits, unit, read) in _trim_rows(solution):
        value = read(solution)
        if not title or (value is None and key.endswith("_wave")):
            continue
        words, entry = f"{number(value, digits)}{unit}", key
        if key == "flap_1c":
            words, entry = f"{', '.join(flapping)}°", "flapping_1"
        elif value is None:
            words = "rigid" if key == "elastic_tip" else BLANK
        cells.append(
            tag(
                "div.rx-line",
                tag("span.rx-dim", title),
                tag("span.rx-num", words),
                title=tip(entry),
            )
        )
    return tag("div.rx.rx-grid", cells, data_explorer="trim")


def explanation(text: str) -> Markup:
    """The line below a menu, in a box of constant height."""
    return tag("div.rx.rx-dim.rx-small.rx-explain", text)


def dash(colour: str, dashed: bool = False) -> Markup:
    """A short line as in the charts, before the name of what it draws."""
    if dashed:
        return tag("span.rx-dash.rx-dashed", style=f"color:{colour}")
    return tag("span.rx-dash", style=f"background:{colour}")


def outdated(html: Markup) -> Markup:
    """Markup of other inputs than those that are set, with the mark that `outdate` of `common.js` gives."""
    return tag("div", html, data_stale=True, role="group", aria_description="out of date")


def answers(html: Markup) -> Markup:
    """Markup that is marked as a whole from the moment an input changes, until it is sent again."""
    return tag("div", html, data_answers=True)


def compared_power_panel(
    solution: Solution, pinned: Solution, units: Units = SI, band: Doubt | None = None
) -> Markup:
    """Total power with its change relative to A, and the parts of both.

    Where A has no trim it shows dashes.
    """
    power = solution.power
    reference = pinned.power if pinned.converged else None
    against = f", {units.watts(reference.total)}" if reference else ": no trim at this condition"
    titles = {**part_titles(solution.design, pinned.design), "total": "Total"}
    rows = [
        _compared_row(title, name, power, reference, units, band) for name, title in titles.items()
    ]
    symbol = units.power[0].symbol
    head = _cells(symbol, (_name("A"), _name("B"), f"Δ {symbol}", ""), "rx-dim rx-small")
    compared = tag("span", "vs. " if reference else None, _name("A"), against)
    words = tag("span", "total power of ", _name("B")), compared
    return _panel(
        solution, reference, words, tag("table.rx-ab", head, rows, data_explorer="ab"), units, band
    )


def compared_trim_panel(solution: Solution, pinned: Solution) -> Markup:
    """Trim angles, loading, efficiency and areas of A and B, in two columns."""
    head = tag(
        "div.rx-four.rx-dim.rx-small", tag("span"), tag("span", _name("A")), tag("span", _name("B"))
    )
    cells = [head, head]
    for key, (_, short, digits, _, read) in _trim_rows(solution):
        if not short:
            continue
        a = number(read(pinned) if pinned.converged else None, digits)
        b = number(read(solution), digits)
        cells.append(
            tag(
                "div.rx-four",
                tag("span.rx-dim", short),
                tag("span", a),
                tag("span", b),
                title=tip(key),
            )
        )
    return tag("div.rx.rx-grid", cells, data_explorer="trim")


def _name(letter: str) -> Markup:
    """A or B with the mark of its lines in the charts."""
    mark = dash(PINNED, dashed=True) if letter == "A" else dash(THIS)
    return mark + tag("b", letter)


def _compared_row(
    title: str,
    part: str,
    power: PowerBudget,
    reference: PowerBudget | None,
    units: Units,
    band: Doubt | None,
) -> Markup:
    """A part of power, or the total, of A and of B, and the change."""
    b = units.power[0].of(getattr(power, part))
    a = None if reference is None else units.power[0].of(getattr(reference, part))
    changes = (BLANK, "") if reference is None else part_change(part, power, reference, band, units)
    fine = fineness(power, units)
    if part != "total":
        return _cells(
            patch(PARTS[part]) + title,
            (number(a, fine), number(b, fine), *changes),
            tooltip=tip(part),
        )
    return _cells(title, (number(a, fine), number(b, fine), *changes), "rx-sum", tip("total_power"))


def _cells(title: str, values: Iterable[str], kind: str = "", tooltip: str | None = None) -> Markup:
    """A row of a table: a title and numbers."""
    return tag(
        "tr",
        tag("td", title),
        [tag("td.rx-num", value) for value in values],
        class_=kind,
        title=tooltip,
    )


def digits_of(power: float, units: Units, band: float | None = None) -> int:
    """Decimals of a power [W] in the main unit, of a change beside its band those of the pair: models do not agree to
    a tenth."""
    unit = units.power[0]
    if band is not None:
        return rounded_pair(unit.of(power), unit.of(band)).decimals
    return 0 if round(abs(unit.of(power)), 1) >= 10.0 else 1


class BalanceRow(NamedTuple):
    """The power that one part of an actuator adds, or all do; more is positive."""

    name: str
    value: float
    """In the main unit, as `band`."""
    text: str
    """As written: the parts add up to the total."""
    band: float = 0.0
    words: str = ""
    """The band, and whether the sign is known; empty without a band."""
    kind: Literal["", "less", "more"] = ""
    """`change_kind`; a drive's power is known as well as the drive."""


def balance(
    savings: Sequence[tuple[str, float]],
    units: Units,
    band: float | None = None,
    bands: Sequence[float] = (),
    sourced: bool = True,
) -> list[BalanceRow]:
    """The power that each part of an actuator adds, and all of them.

    savings, bands: as of `Verdict`. band: of their sum [W], with which its digits are those of `needs_words`.
    """
    unit = units.power[0]
    digits = digits_of(sum(power for _, power in savings), units, band)
    names = [_BALANCE_NAMES.get(name, name) for name, _ in savings]
    exact = [-unit.of(power) for _, power in savings]
    written = adding(exact, digits)
    within = bands or [0.0] * len(savings)
    rows = list[BalanceRow]()
    for name, value, shown, sure in zip(names, exact, written, within, strict=True):
        text = number(shown, digits, sign=True)
        rows.append(_balance_row(name, value, text, sure, units, sourced))
    total = number(sum(written), digits, sign=True)
    rows.append(_balance_row("total", sum(exact), total, band or 0.0, units, sourced))
    return rows


_BALANCE_NAMES = {"gross": "its twist", "blade": "present blade"}
"""Names on the page of parts of a net saving that have others in `Verdict`."""


def _balance_row(
    name: str, value: float, text: str, band: float, units: Units, sourced: bool
) -> BalanceRow:
    """One row from its value in the main unit, its text, and its band [W]."""
    within = units.power[0].of(band)
    word = None
    if value and (band or name == "drive"):
        word = sureness(value, within)
    words = _row_words(name, value, band, units, sourced)
    return BalanceRow(name, value, text, within, words, change_kind(value, word))


def _row_words(name: str, value: float, band: float, units: Units, sourced: bool) -> str:
    """What a part needs, in the main unit, with its band [W]; empty where the band rounds to nothing."""
    unit = units.power[0]
    if not round(unit.of(band), MOST_OF_SMALL):
        return ""
    return f"{name} {needs_words(-unit.size * value, band, units, sourced)}"


def needs(verdict: Verdict, units: Units) -> str:
    """The power that an actuator needs over its mission, or saves, and how sure that is; first, why it cannot work."""
    net, actuator = verdict.net_saving, verdict.installed.actuator
    words = needs_words(net, verdict.net_band, units, verdict.sourced)
    if actuator.forbidden:
        return f"is {actuator.forbidden}; if it could work, it {words}"
    return words + (", but cannot be built" if net > 0.0 and not verdict.buildable else "")


def change_sizes(change: float, band: float | None, units: Units) -> tuple[str, str]:
    """A change of power [W] without its sign, and its band [W]: `28`, ` ± 3`; empty without a band."""
    unit = units.power[0]
    size = abs(unit.of(change))
    if band is None:
        return number(size, digits_of(change, units)), ""
    pair = rounded_pair(size, unit.of(band))
    return number(pair.change, pair.decimals), f" ± {number(pair.band, pair.decimals)}"


def needs_words(net: float, band: float | None, units: Units, sourced: bool = True) -> str:
    """A net saving [W] in words, with its band [W]: `needs 28 ± 3 kW more (sure)`. `sourced`: as of `sureness`."""
    size, symbol = "".join(change_sizes(net, band, units)), units.power[0].symbol
    words = f"saves {size} {symbol}" if net > 0.0 else f"needs {size} {symbol} more"
    if band is None:
        return words
    return f"{words} ({sure_words(net, band, sourced=sourced)})"


def more_words(net: float, band: float | None, units: Units) -> str:
    """A net saving [W] as a change of power, with its band [W]: `28 ± 3 kW more`."""
    size = "".join(change_sizes(net, band, units))
    return f"{size} {units.power[0].symbol} {'less' if net > 0.0 else 'more'}"


_FUEL = Unit("kg/h of fuel", 1.0 / 3600.0)


def banded(
    change: float,
    band: float,
    units: Units | Unit,
    *,
    sign: bool = False,
    sourced: bool = True,
) -> str:
    """A change, of power in these units [W], with its band and whether its sign is known: `4.2 ± 1.8 kW: sure`."""
    unit = units if isinstance(units, Unit) else units.power[0]
    pair = rounded_pair(unit.of(change), unit.of(band))
    size = number(pair.change, pair.decimals, sign=sign)
    within = number(pair.band, pair.decimals)
    return f"{size} ± {within} {unit.symbol}: {sure_words(change, band, sourced=sourced)}"


def kilograms(mass: float) -> str:
    """A mass [kg] with one decimal below ten."""
    return f"{number(mass, 0 if mass >= 10.0 else 1)} kg"


def mass_parts(installed: InstalledActuator) -> dict[str, str]:
    """What an actuator adds to the aircraft: kilograms of each part in all blades, which add up to those in all."""
    masses, blades = installed.masses, installed.masses.blades
    parts = {
        installed.actuator.noun[1]: blades * masses.actuator,
        "electronics": masses.electronics,
        "leads": blades * masses.wiring,
        "nose weight": blades * masses.balance,
    }
    digits = 0 if masses.aircraft >= 10.0 else 1
    values = adding(list(parts.values()), digits)
    words = {
        name: number(value, digits) for name, value in zip(parts, values, strict=True) if value
    }
    return {**words, "in all": f"{number(sum(values), digits)} kg"}


def mass_words(installed: InstalledActuator) -> str:
    """Its mass on board, and of what."""
    *parts, (_, total) = mass_parts(installed).items()
    return f"{total}: {', '.join(f'{name} {mass}' for name, mass in parts)}" if parts else total


def fuel_words(verdict: Verdict) -> str:
    """Fuel used beyond that without the actuator, with its band and whether its sign is known."""
    saved, band = verdict.fuel_saving, verdict.fuel_band
    if saved is None or band is None:
        return "fuel flow unknown"
    return banded(-saved, band, _FUEL, sign=True, sourced=verdict.sourced)


def mission_words(mission: Mission) -> str:
    """What a mean is taken over, for example `mean over hover, climb, cruise and fast (hours assumed)`."""
    assumed = " (hours assumed)" if mission.assumed else ""
    return f"mean over {mission.words}{assumed}"


def mission_hours(mission: Mission) -> str:
    """The legs with their hours, and whether these are assumed."""
    legs = ", ".join(f"{leg.name} {leg.hours:g} h" for leg in mission.legs)
    assumed = " (assumed)" if mission.assumed else ""
    return f"Mission: {legs}{assumed}."


def limit_words(name: str) -> str:
    """The name of a limit of an actuator, in words."""
    return "minimum torsional stiffness" if name == "torsion-least" else name.replace("-", " ")
