"""What each part of the physics costs: the waterfall of power, and each switch off alone."""

from collections.abc import Generator, Sequence
from typing import Any

from explorer.colours import PARTS
from explorer.model.units import SI, Units, number
from explorer.text import readout
from explorer.text.readout import part_titles
from explorer.views.page_state import PageState, Panel, PanelWork, Tell
from rotor import Design
from rotor.aero.switches import SWITCHES, switched_off, with_switches
from rotor.study.series import WaterfallStep, waterfall_steps
from rotor.support.markup import Markup, group, tag
from rotor.trim.power import PowerBudget

WIDTH = 312
"""[px] of the drawing; the panel scales it."""
_BAR_LEFT, _BAR_RIGHT = 112.0, 258.0
_ROW, _BAR_HEIGHT = 31.0, 11.0
_MORE, _LESS = "#d9480f", "#0ca678"
_LONG_NOTE = 30
"""Characters of a note that fit between the left ends of the bars and the right edge."""
_THINNEST = 1.6
"""[px] of a bar that stands for next to nothing."""


def waterfall_chart(steps: Sequence[WaterfallStep], units: Units = SI) -> Markup:
    """Rows from everything off to everything on; "Computing …" without steps."""
    if not steps:
        return tag("div.rx.rx-dim", "Computing …", data_explorer="waterfall", data_steps=0)
    powers = [step.budget for step in steps if step.budget is not None]
    # The total, without what a descent gives back.
    lengths = [
        max(power.total, sum(max(getattr(power, part), 0.0) for part in PARTS)) for power in powers
    ]
    top = 1.04 * max(lengths, default=1.0)
    links = [_link(step, 2.0 + k * _ROW, top) for k, step in enumerate(steps)]
    rows = [_row(step, 2.0 + k * _ROW, top, units) for k, step in enumerate(steps)]
    if (full := steps[-1]).budget is not None:
        rows.append(
            _whole("All switched on", full.budget, full.design, 2.0 + len(steps) * _ROW, top, units)
        )
    box = f"0 0 {WIDTH} {(len(steps) + 1) * _ROW - 8.0:.0f}"
    drawn = tag(
        "svg", links, rows, viewBox=box, width="100%", role="img", aria_label="Waterfall of power"
    )
    entries = [
        tag("span", readout.patch(PARTS[name]), name) for name in part_titles(steps[0].design)
    ]
    key = tag("div.rx-dim.rx-small.rx-line", entries, tag("span", f"[{units.power[0].symbol}]"))
    return tag("div.rx.rx-waterfall", drawn, key, data_explorer="waterfall", data_steps=len(steps))


def _link(step: WaterfallStep, y: float, top: float) -> Markup | None:
    """The line from the row above, which has to lie behind the words of both."""
    if step.budget is None or step.added is None or step.against is None:
        return None
    x = _x(step.against.total, top)
    return tag("line.rx-w-link", x1=x, x2=x, y1=y - 12, y2=y + 13)


def _row(step: WaterfallStep, y: float, top: float, units: Units) -> Markup:
    if step.budget is None:
        sentence, words = tag("title", step.message), _words(0, y + 11, step.title)
        return tag("g", sentence, words, _words(_BAR_LEFT, y + 11, "has no trim", "rx-w-bad"))
    change, added = step.change, step.added
    if change is None or added is None or step.against is None:
        return _whole(step.title, step.budget, step.design, y, top, units)
    before, after = _x(step.against.total, top), _x(step.budget.total, top)
    left, width = min(before, after), abs(after - before)
    if width < _THINNEST:
        left, width = 0.5 * (before + after - _THINNEST), _THINNEST
    bar = None if step.note else _rect(left, y + 2, width, _MORE if added > 0.0 else _LESS)
    beneath = _patches(change, y, units)
    if step.note:  # Begins where the bars begin; a longer one ends at the right edge.
        long = len(step.note) > _LONG_NOTE
        place, look = (WIDTH, "rx-w-note rx-w-number") if long else (_BAR_LEFT, "rx-w-note")
        beneath = _words(place, y + 24, step.note, look)
    power = _words(WIDTH, y + 11, number(units.power[0].of(added), 1, sign=True), "rx-w-number")
    return tag(
        "g", tag("title", _spoken(step, units)), _words(0, y + 11, step.title), bar, power, beneath
    )


def _whole(
    name: str, power: PowerBudget, design: Design, y: float, top: float, units: Units
) -> Markup:
    """A bar of all parts from zero."""
    x, rects, unit = _BAR_LEFT, list[Markup](), units.power[0]
    titles = part_titles(design)
    for part in titles:
        width = max(_x(getattr(power, part), top) - _BAR_LEFT, 0.0)
        rects.append(_rect(x, y + 2, width, PARTS[part]))
        x += width
    parts = ", ".join(f"{part} {unit.text(getattr(power, part))}" for part in titles)
    total = _words(WIDTH, y + 11, number(unit.of(power.total), 1), "rx-w-number rx-w-strong")
    title = tag("title", f"{name}: {unit.text(power.total, 1)}; {parts}")
    return tag("g", title, _words(0, y + 11, name, "rx-w-strong"), rects, total)


def _patches(change: dict[str, float], y: float, units: Units) -> Markup:
    """The change by part: a patch of the part's colour and a number, for parts that change."""
    x, drawn = _BAR_LEFT, []
    for part, value in change.items():
        text = number(units.power[0].of(value), 0, sign=True)
        if text == "0":
            continue
        drawn.append(tag("rect", x=x, y=y + 18, width=6, height=6, rx=1.5, fill=PARTS[part]))
        drawn.append(_words(x + 9, y + 24, text, "rx-w-note"))
        x += 17.0 + 7.2 * len(text)
    return group(drawn)


def _spoken(step: WaterfallStep, units: Units) -> str:
    """The step in words, for those who point at it or have it read out."""
    change, unit = step.change or {}, units.power[0]
    titles = part_titles(step.design)
    parts = ", ".join(
        f"{part} {unit.text(change[part], 1, sign=True)}" for part in titles if part in change
    )
    what = step.switch.on if step.switch else ""
    return f"{step.title} on: {unit.text(step.added, 1, sign=True)} ({parts}). {what}"


def _x(power: float, top: float) -> float:
    return _BAR_LEFT + (_BAR_RIGHT - _BAR_LEFT) * power / top


def _rect(x: float, y: float, width: float, colour: str) -> Markup:
    return tag("rect", x=x, y=y, width=width, height=_BAR_HEIGHT, fill=colour)


def _words(x: float, y: float, text: str, look: str = "") -> Markup:
    return tag("text.rx-w", text, x=x, y=y, class_=look)


WATERFALL_WORDS = (
    "The first row has no flapping, losses, reverse flow, compressibility or fuselage drag. Each further row adds one "
    "effect; every row is a trim. The cost of an effect depends on the others: under Model, each switch shows the cost "
    "of its effect with all others on."
)
_CLIMB = len(SWITCHES) + 1
"""Steps from everything off to everything on; those with each switch off alone follow."""


def waterfall_work(now: PageState) -> tuple[PanelWork, ...]:
    """All steps of the design with everything on: some twenty trims."""
    if now.state is None:
        return ()
    design = with_switches(now.state.solution.design, ())

    def run(tell: Tell) -> Generator[None, None, tuple[WaterfallStep, ...]]:
        """Whole, or not at all: it would grow under the eyes."""
        found = list[WaterfallStep]()
        for step in waterfall_steps(design):
            found.append(step)
            yield
        return tuple(found)

    return (PanelWork("waterfall", (design,), run),)


def waterfall(now: PageState) -> dict[str, Any]:
    """The drawing. The last one stays, greyed, until that of the design on the page is known."""
    steps, current = _known(now)
    drawn = waterfall_chart(steps[:_CLIMB], now.units)
    return {
        "details.waterfall": drawn
        if not steps or (current and not now.problem)
        else readout.outdated(drawn)
    }


def costs(now: PageState) -> dict[str, Any]:
    """What each switch costs, beside it; the last known stays."""
    alone = _known(now)[0][_CLIMB:]
    words = {
        step.switch.name: cost_words(step, now.units) for step in alone if step.switch is not None
    }
    return {"switch.costs": words} if words else {}


def switched_alone(now: PageState) -> tuple[dict[str, WaterfallStep], bool]:
    """Each switch off alone by its name, as far as the page knows it, and whether that is of the design on the page.

    Nothing where other effects than stall are off, since these steps have them all.
    """
    steps, current = _known(now)
    off = (
        {switch.name for switch in switched_off(now.state.solution.design.models)}
        if now.state
        else set[str]()
    )
    if off - {"stall"}:
        return {}, True
    return {step.switch.name: step for step in steps[_CLIMB:] if step.switch is not None}, current


def _known(now: PageState) -> tuple[tuple[WaterfallStep, ...], bool]:
    """The last steps known, and whether they are of the design on the page."""
    asked = waterfall_work(now)
    steps, current = now.latest(asked[0]) if asked else (None, False)
    return steps or (), current


WATERFALL = Panel(waterfall, lambda ui: ui.drawer == "details", works=waterfall_work)
COSTS = Panel(costs, lambda ui: bool(ui.drawer) or not ui.lifted, works=waterfall_work)


def cost_words(step: WaterfallStep, units: Units) -> str:
    """What a switch adds to the power, from the trim without it."""
    if step.note:
        return step.note[:1].upper() + step.note[1:]
    if step.added is None:
        return "No trim without it"
    return f"{units.watts(-step.added, 1, sign=True)} here"
