"""How sure power, its change and the best twist are: rows of what the doubt consists of."""

import math
from collections.abc import Sequence

from explorer.model.units import SI, Unit, Units, number
from explorer.text.line import coverage_words
from rotor.optimisation.results import BestTwist, TwistRange
from rotor.support.markup import Markup, tag
from rotor.trim.doubt import Doubt, OtherModels, banded, decimals

_SQUARE_METRE = Unit("m²", 1.0)
MOST_ROWS = 6
"""What comes after is too small to see."""
_LEAST_PART = 1e-4
"""A row that is a smaller part of the longest is left out."""


def doubt_rows(band: Doubt, units: Units = SI, models: Sequence[OtherModels] = ()) -> Markup:
    """The sentence, what each uncertain input does to the change of power, or where there is none to power, and what
    other models give."""
    unit = units.power[0]
    title = (
        "Sources of uncertainty in the change"
        if band.change is not None
        else "Sources of uncertainty"
    )
    sizes = [
        (row, abs(unit.of(row.power if row.change is None else row.change)))
        for row in band.rows[:MOST_ROWS]
    ]
    longest = max((size for _, size in sizes), default=0.0) or 1.0
    rows = [
        tag(
            "tr",
            tag("td", row.words),
            tag("td", tag("i", style=f"width:{100.0 * size / longest:.0f}%")),
            tag("td.rx-num", f"± {number(size, decimals(size))} {unit.symbol}"),
            title=f"{row.words}, {row.size_words}: {row.source}",
        )
        for row, size in sizes
        if size >= _LEAST_PART * longest
    ]
    words = f"Other models: {'; '.join(_in_words(each, band, units) for each in models)}."
    outside = sum(abs(each.power - band.power) > band.band for each in models)
    if outside == 1:
        words += " One lies outside the band."
    elif outside:
        words += f" {outside} lie outside the band."
    with_others = tag("div.rx-dim", words) if models else Markup()
    held = tag("div.rx-dim", f"{coverage_words()}.") if band.of == "Power" else Markup()
    return tag(
        "div.rx.rx-doubt",
        tag("b", band.in_words("It", (unit.symbol, unit.size))),
        held,
        tag("div.rx-dim", title),
        tag("table", rows),
        with_others,
    )


def _in_words(beside: OtherModels, band: Doubt, units: Units) -> str:
    """`bending 1 368 kW, saves 2.3 ± 0.7 %: sure`, with the band of the same change by the design's own model."""
    words = f"{beside.name} {units.watts(beside.power)}"
    if beside.change is None or band.change_band is None:
        return words
    percent, within = (
        100.0 * size / abs(beside.power - beside.change)
        for size in (beside.change, band.change_band)
    )
    return f"{words}, {'saves' if percent <= 0.0 else 'costs'} {banded(abs(percent), within, '%')}"


def twist_ranges(best: BestTwist, units: Units = SI) -> Markup:
    """The best linear twist, and how far each cause moves it, as bars on one scale; the line is the best twist."""
    rate = math.degrees(best.rate)
    places = [rate, *(math.degrees(end) for each in best.ranges for end in each.rates)]
    low, width = min(places), (max(places) - min(places)) or 1.0

    def part(place: float) -> float:
        return 100.0 * (place - low) / width

    rows: list[Markup] = []
    for each in best.ranges:
        first, last = (math.degrees(end) for end in each.rates)
        left, right = sorted((part(first), part(last)))
        drawn = tag("i", style=f"margin-left:{left:.0f}%;width:{right - left:.0f}%")
        bar = drawn, tag("s", style=f"left:{part(rate):.0f}%")
        reach = f"{number(first, 1)} … {number(last, 1)}"
        cells = tag("td", _cause(each, units)), tag("td", tag("div", bar)), tag("td.rx-num", reach)
        rows.append(tag("tr", cells))
    title = f"Best linear twist for this flight: {number(rate, 1)} °/R"
    if best.cost is not None:
        title += f"; with other inputs or inflow the best twist would need about {units.watts(best.cost, 1)} less"
    return tag("div.rx.rx-doubt", tag("b", title), tag("table", rows), data_explorer="twist-ranges")


def _cause(each: TwistRange, units: Units) -> str:
    match each.cause:
        case "flat":
            return "power within 0.1 %"
        case "doubt":
            return "uncertain inputs, inflow"
        case "wake":
            return "annuli … lifting line"
        case _:
            pass
    assert each.ends is not None
    unit, digits = (
        (units.mass, 0 if units.mass.size < 1.0 else 1)
        if each.cause == "mass"
        else (_SQUARE_METRE, 1)
    )
    return (
        f"{each.cause} {number(unit.of(each.ends[0]), digits)} … {unit.text(each.ends[1], digits)}"
    )
