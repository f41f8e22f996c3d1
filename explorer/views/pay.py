"""What would pay: the mass that the actuator as set might have, over its range, and where real and supposed ones stand;
all kinds in a table below their menu.

The supposed actuator is dragged (`explorer/web/flight.js`) and stays in the address. Line and balance are those of
`explorer.views.actuated`: at the chosen actuator both say the same.
"""

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from explorer.model.actuator_inputs import as_it_comes
from explorer.model.units import SI, Units, number
from explorer.parts.actuate import SupposePart
from explorer.parts.presses import SupposePress
from explorer.text.design_words import listed
from explorer.text.readout import (
    change_sizes,
    kilograms,
    limit_words,
    mission_words,
    needs,
    needs_words,
)
from explorer.views.actuated import (
    ActuatedBlade,
    PowerChange,
    actuated_blade,
    against_words,
    immovable_kinds,
    in_actuate,
    no_verdict,
)
from explorer.views.page_state import Effect, PageState, Panel, SetAddress, SetHand
from rotor.actuator import OtherStroke, Verdict, actuators
from rotor.support.chart import Axis, Band, Chart, Line, Points, Series, drawn_chart
from rotor.support.markup import Markup, tag
from rotor.trim.doubt import rounded_pair, sure_words, sureness

SUPPOSED = "i"
"""Name of the supposed actuator in the address, as `4.2,12`: degrees and kilograms."""
MOST_TWIST, MOST_MASS = 90.0, 1e4
"""Largest twist [°] and mass [kg] of a supposed actuator that a link may hold."""
_PLACE = re.compile(",".join([r"\d{1,5}(?:\.\d{1,4})?"] * 2), re.ASCII)
_LINE, _PAYS = "#1c7ed6", "#0ca678"


def _verdicts(one: ActuatedBlade) -> list[Verdict]:
    """As far as there are any, the chosen actuator's first."""
    return [outcome for outcome in one.outcomes.values() if isinstance(outcome, Verdict)]


def view(now: PageState) -> dict[str, Any]:
    """The stage, whether the supposed actuator pays (its blade lights green), and all kinds."""
    if now.problem:
        return {}
    shown, one = _stage(now), actuated_blade(now)
    kinds = Markup() if one is None else _kinds(one, now)
    return {
        "suppose": shown,
        "actuator.pays": shown is not None and shown.kind == "gain",
        "actuator.kinds": kinds,
    }


def _kinds(one: ActuatedBlade, now: PageState) -> Markup:
    """Every kind that moves this blade, as it comes, beside the chosen one as set: by press, for they take a while."""
    state, words = ("off", "Close the comparison") if now.hand.on_stage else ("on", "Compare kinds")
    press = tag("button.rx-link", words, data_do="suppose", data_value=state, type="button")
    if not now.hand.on_stage:
        return tag("div.rx", press, data_explorer="kinds")
    heads = "kind", "range [°]", "mass [kg]", f"power [{now.units.power[0].symbol}]"
    rows = [tag("tr.rx-dim", [tag("th", head) for head in heads])]
    folded = now.of(immovable_kinds).keys() - {one.question.actuator}
    for id in actuators():
        if id not in folded:
            rows += _kind(one, id, now.units)
    mean = mission_words(one.question.mission)
    note = f"Power by schedule, {mean}, against the {against_words(one, one.inputs.against)}."
    return tag(
        "div.rx.rxa-kinds", tag("table", rows), tag("p.rx-dim", note), press, data_explorer="kinds"
    )


def _kind(one: ActuatedBlade, id: str, units: Units) -> list[Markup]:
    """Two rows: its numbers; what it exceeds, and how sure the power is."""
    outcome, chosen, actuator = one.outcomes[id], id == one.question.actuator, actuators()[id]
    verdict = outcome if isinstance(outcome, Verdict) else None
    power, kind, words = "…", "", "computing" if outcome is None else str(outcome)
    numbers: tuple[str, ...] = "", ""
    if verdict is not None:
        net, mass = verdict.net_saving, verdict.installed.masses.aircraft
        numbers = (
            number(math.degrees(verdict.installed.attainable), 1),
            number(mass, 0 if mass >= 10.0 else 1),
        )
        power = ("−" if net > 0.0 else "+") + "".join(change_sizes(net, verdict.net_band, units))
        kind = PowerChange(-net, verdict.net_band, verdict.buildable).kind
        kept = verdict.installed.actuator.range_limits
        over = listed(
            [limit_words(limit.name) for limit in verdict.broken if limit.name not in kept]
        )
        over = f"over its limits in {over}" if over else "within its limits"
        band = verdict.net_band
        sure = "" if band is None else sure_words(net, band, sourced=verdict.sourced)
        words = "; ".join(filter(None, (actuator.forbidden or over, sure)))
    name = tag("button.rx-link", id.replace("_", " "), data_do="kind", data_value=id, type="button")
    cells = (
        tag("td", name),
        *(tag("td.rx-num", text) for text in numbers),
        tag("td.rx-num", power, data_kind=kind),
    )
    return [
        tag("tr", cells, data_chosen=chosen or None),
        tag("tr.rx-dim.rx-small", tag("td", words, colspan=4)),
    ]


def take_kind(now: PageState, id: str) -> tuple[Effect, ...]:
    """Take another actuator, as it comes."""
    return (SetHand(actuator=as_it_comes(id)),) if id in actuators() else ()


def _stage(now: PageState) -> SupposePart | None:
    """What the page draws; None where it shows the balance of power."""
    one = actuated_blade(now) if now.hand.on_stage else None
    if one is None:
        return None
    if one.line is None or one.verdict is None or one.over_flight is None:
        none = "" if one.mass else f"{one.name} adds no mass, so no break-even mass applies."
        return SupposePart(none or no_verdict(now) or "Computing break-even…")
    units = now.units
    line = one.line
    own = _put(math.degrees(one.range), one.mass)
    place = now.hand.place or own
    if place == own:
        # A place has few digits: what stands here is what the card says of the actuator itself.
        twist = one.range
        mass = one.mass
        saving = -one.over_flight.power
        band = one.over_flight.band
        built = one.over_flight.built
        most = one.verdict.mass_allowed or 0.0
    else:
        twist = math.radians(place[0])
        mass = place[1]
        saving = line.net(twist, mass)
        band = line.band(twist, mass)
        built = True
        most = line.mass_allowed(twist)
    least = line.twist_for(mass)
    notes = [_allowed(line, twist, most)]
    notes += [] if least is None else [f"with this mass, above {number(math.degrees(least), 1)}°"]
    gives = needs_words(saving, band, units, one.sourced)
    return SupposePart(
        words=f"{number(math.degrees(twist), 1)}° for {kilograms(mass)} {gives} over the mission",
        kind=PowerChange(-saving, band, built).kind,
        note=f"{'; '.join(notes)}.",
        chart=drawn_chart(mass_chart(line, _verdicts(one), units)),
        at=place,
    )


def _allowed(line: OtherStroke, twist: float, most: float) -> str:
    """The mass [kg] at which a range of twist breaks even, with its band."""
    if not most:
        return "With this range it never pays"
    pays = mass_that_pays(line, twist, most)
    if pays is None:
        return "With this range no mass is sure to pay"
    size, band = pays
    return f"With this range it pays below {size.removesuffix(' kg')} ± {band}"


def mass_that_pays(line: OtherStroke, twist: float, mass: float) -> tuple[str, str] | None:
    """The mass [kg] at which a range of twist breaks even, and its band; None where the band holds no mass as well."""
    band = line.band(twist, mass) / line.per_kg
    if sureness(mass, band) == "unclear":
        return None
    pair = rounded_pair(mass, band)
    return f"{number(pair.change, pair.decimals)} kg", f"{number(pair.band, pair.decimals)} kg"


def _put(degrees: float, mass: float) -> tuple[float, float]:
    """With the digits of a place."""
    return round(degrees, 2), float(f"{mass:.3g}")


def move_supposed(now: PageState, value: str | SupposePress) -> tuple[Effect, ...]:
    """The stage shows the line or no longer, or the supposed actuator is dragged there."""
    on_stage, place = now.hand.on_stage, now.hand.place
    if isinstance(value, str):
        on_stage = value == "on"
    else:
        place = _put(value.tip, value.mass)
    kept = "{:g},{:g}".format(*place) if on_stage and place is not None else None
    return SetHand({"on_stage": on_stage, "place": place}), SetAddress(SUPPOSED, kept)


PAY = Panel(view, in_actuate, presses={"suppose": move_supposed, "kind": take_kind})


def read_place(text: str) -> tuple[float, float]:
    """Twist [°] and mass [kg] of a link; ValueError with one sentence for anything else."""
    parts = list(map(float, text.split(","))) if _PLACE.fullmatch(text) else []
    if not parts or parts[0] > MOST_TWIST or not 0.0 < parts[1] <= MOST_MASS:
        raise ValueError(
            f"The supposed actuator {text[:40]!r} is not a twist in degrees and a mass in kg: write 4,12."
        )
    return parts[0], parts[1]


def mass_chart(line: OtherStroke, verdicts: Sequence[Verdict] = (), units: Units = SI) -> Chart:
    """Mass that just pays over the range, with its band, and actuators as points at their own range and mass; mass is
    logarithmic."""
    real = sorted(verdicts, key=lambda verdict: -verdict.installed.masses.aircraft)
    places = [
        (math.degrees(one.installed.attainable), one.installed.masses.aircraft) for one in real
    ]
    end = float(line.twists[-1])
    x_most = 1.08 * max(math.degrees(end), *(degrees for degrees, _ in places), 0.0)
    largest = line.mass_allowed(end) or 1.0
    y_range = (
        10.0 ** math.floor(math.log10(0.05 * largest)),
        3.0 * max(largest, *(mass for _, mass in places), 0.0),
    )
    fine = [*np.linspace(0.0, end, 60).tolist(), math.radians(x_most)]
    x, allowed = (
        [*map(math.degrees, fine)],
        [max(line.mass_allowed(twist), y_range[0]) for twist in fine],
    )
    within = (
        np.array([line.band(*place) for place in zip(fine, allowed, strict=True)]) / line.per_kg
    )
    series: list[Series] = [
        Band("pays", x, (y_range[0],) * len(x), allowed, _PAYS),
        Band("", x, np.maximum(allowed - within, y_range[0]), allowed + within, "var(--rx-dim)"),
        Line("just pays", x, allowed, _LINE),
    ]
    for verdict, (degrees, mass) in zip(real, places, strict=True):
        name = verdict.installed.actuator.id.replace("_", " ")
        words = f"{name}: {degrees:.1f}° for {mass:.0f} kg on this blade {needs(verdict, units)}"
        kind = PowerChange(-verdict.net_saving, verdict.net_band).kind
        colour = "var(--rx-dim)" if not kind else _PAYS if verdict.pays else "var(--rx-bad)"
        place = (degrees,), (max(mass, y_range[0]),)
        series.append(Points("", *place, colour, size=4.5, words=(words,), names=(name,)))
    return Chart(
        "Mass that pays",
        Axis("range of tip twist in flight [°]", (0.0, x_most)),
        Axis("mass on board [kg]", y_range, log=True),
        tuple(series),
        note="Line and grey band: the actuator as set, with another range and mass but the same stiffness and "
        "drive. Points: real actuators on this blade.",
    )
