"""The charts below the scene: power over µ or what was measured, α, and lift.

Axes are held while the data fit them, so that they do not jump during a drag.
"""

import math
from collections.abc import Callable, Generator, Mapping
from dataclasses import replace
from typing import Any

from explorer.charts.curve_bands import curve_bands
from explorer.charts.measured import source_of
from explorer.charts.plots import PowerCurve, any_speed
from explorer.charts.strip import (
    Role,
    alpha_chart,
    lift_chart,
    power_change_chart,
    total_power_chart,
    with_band,
    with_speeds,
)
from explorer.model.session_state import SessionState
from explorer.parts.results import Kind, MarkedSpeeds, StripChart
from explorer.text.design_words import against
from explorer.text.readout import change_kind
from explorer.views.page_state import PageState, Panel, PanelMemory, PanelWork, Questions, Tell
from explorer.views.work import shown_doubt
from explorer.workers.call import Call
from rotor import Solution
from rotor.support.chart import Chart, drawn_chart

_KINDS: Mapping[str, Kind] = {"": "", "less": "good", "more": "bad"}
_WHOLE = "-whole"
_URGENCY, _DELAY_S = 8, 1.5
"""Of the band of the curve, behind all else; how long the design must stand before it is worked on [s]."""


def strip(now: PageState) -> dict[str, Any]:
    """A test that was measured has its chart in place of power over µ."""
    state = now.state
    if state is None:
        return {}
    held = now.memory.ranges.get
    solution, reference, psi = state.solution, state.reference, state.view.azimuth_deg
    compared: Role = "reference" if state.pinned is None else "pinned"
    drawn = list[StripChart]()

    def add(name: str, chart: Chart, kind: Kind = "", speeds: MarkedSpeeds | None = None) -> None:
        drawn.append(StripChart(name, kind, bool(now.problem), drawn_chart(chart), speeds))

    if (measured := now.measured.chart(solution, held("measured"))) is not None:
        add("measured", measured)
    elif now.curve is not None:
        add(*_power(now, state, now.curve))
    add("alpha", alpha_chart(solution, reference, psi, held("alpha"), compared))
    add("lift", lift_chart(solution, reference, held("lift"), compared))
    return {"strip": drawn}


def _power(
    now: PageState, state: SessionState, curve: PowerCurve
) -> tuple[str, Chart, Kind, MarkedSpeeds | None]:
    """Change of power over µ; the power itself where the design is its own reference."""
    design, reference, failed = state.solution.design, state.reference, bool(now.problem)
    # A preview, such as the flight of a schedule, is not what the sliders show.
    mu, pinned, units = design.condition.advance_ratio, state.pinned is not None, now.units
    axis = _axis(now, "power")
    held = now.memory.ranges.get(axis), now.memory.ranges.get(axis + _WHOLE)
    change = (
        state.solution.power.total - reference.power.total
        if not failed and reference.converged
        else None
    )
    band = now.answers.get(shown_doubt(now)[0].key)
    kind = _KINDS[change_kind(change or 0.0, band and band.sureness)]
    if design == reference.design:
        marks = now.flown.marks(state.solution, units)
        total = None if failed else state.solution.power.total
        chart = total_power_chart(curve, mu, total, units, held, marks, design)
        notes = [chart.note, source_of(design)]
        value = "" if failed else now.flown.value(state.solution)
        chart = replace(
            chart, value=value or chart.value, note=" ".join(note for note in notes if note)
        )
    else:
        name = against(design, reference.design, pinned).removeprefix(f"{design.aircraft.name} ")
        chart = power_change_chart(curve, mu, change, name, units, held, band and band.change_band)
    if not curve.current or state.inputs.stand is not None:
        return "power", chart, kind, None
    if isinstance(bands := now.answers.get(bands_call(now)), tuple):
        chart = with_band(chart, bands, units)
    chart, fastest = with_speeds(chart, curve, design)
    known = not failed and math.isfinite(fastest)
    return (
        "power",
        chart,
        kind,
        MarkedSpeeds(mu, math.floor(200.0 * fastest) / 200.0) if known else None,
    )


def bands_call(now: PageState) -> Call | None:
    if now.state is None or now.problem or now.state.inputs.stand is not None:
        return None
    design, reference = now.state.solution.design, now.state.reference
    other = None if design == reference.design or not reference.converged else reference.design
    return Call(curve_bands, (any_speed(design), other and any_speed(other)))


def asks(now: PageState) -> tuple[Questions, ...]:
    call = bands_call(now)
    return (Questions(_URGENCY, () if call is None else (call,), _DELAY_S),)


def remember_ranges(now: PageState, shown: Mapping[str, Any]) -> PanelMemory:
    """The axes that the next charts hold."""
    axes = {_axis(now, one.name): one.chart.y for one in shown.get("strip", ())}
    ranges = {name: axis.range for name, axis in axes.items()}
    ranges |= {
        name + _WHOLE: axis.whole.range for name, axis in axes.items() if axis.whole is not None
    }
    return replace(now.memory, ranges={**now.memory.ranges, **ranges})


def _axis(now: PageState, name: str) -> str:
    """Power over µ has another axis where it is the change."""
    changed = now.state is not None and now.state.solution.design != now.state.reference.design
    return f"{name}-change" if name == "power" and changed else name


def measured_trims(now: PageState) -> tuple[PanelWork, ...]:
    """Our trims at what was measured: on a test stand, or in flight, there only beside the power itself."""
    if now.state is None:
        return ()
    solution = now.state.solution

    def work(name: str, trim: Callable[[Solution, Tell], Generator[None, None, None]]) -> PanelWork:
        def run(tell: Tell) -> Generator[None, None, bool]:
            yield from trim(solution, tell)
            return True

        return PanelWork(name, (solution.design,), run)

    points = work("measured", now.measured.trim_points)
    plain = solution.design == now.state.reference.design
    return (points, work("flights", now.flown.trim_flights)) if plain else (points,)


STRIP = Panel(
    strip,
    asks=asks,
    works=lambda now: (*measured_trims(now), *shown_doubt(now)),
    turns=True,
    remember=remember_ranges,
)
