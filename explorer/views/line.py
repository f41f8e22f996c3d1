"""The line on top of the page: in Explore and Optimise of the twist, in Actuate of the actuator."""

from dataclasses import replace
from typing import Any

from explorer.model.actuator_inputs import AGAINST
from explorer.model.session_state import Pinned, SessionState, compared_with
from explorer.model.undo import KeptDesign
from explorer.parts.results import LineMenu, LineOption, LinePart, LinePiece, LineStatus
from explorer.text.design_words import flight_name, title_words
from explorer.text.line import (
    WIDE,
    blade_pieces,
    carrying_pieces,
    change_pieces,
    control,
    flight_pieces,
    layout_words,
    over_pieces,
    plain,
    power_pieces,
    than_words,
)
from explorer.text.readout import fineness, limit_words
from explorer.views.actuated import (
    ActuatedBlade,
    actuated_blade,
    against_words,
    compared_trims,
    drive_power,
    flight_doubt,
    in_actuate,
)
from explorer.views.actuator import DRIVES, actuator_titles
from explorer.views.assessed import choose
from explorer.views.flight import STATES
from explorer.views.page_state import (
    Effect,
    PageState,
    Panel,
    PanelWork,
    PinDesign,
    PinOrder,
)
from explorer.views.power import status
from explorer.views.work import shown_doubt
from rotor.actuator.verdict import MIN_SHOWN_W
from rotor.design.quantity import Slider

BUILT = "built"
"""Press to compare with the blade as built."""
THIS = "this"
"""Press to compare with the present design, kept as A."""
_DRIVE = Slider("Voltage [%]", -100.0, 100.0, 1.0)


def works(now: PageState) -> tuple[PanelWork, ...]:
    """How sure power and its change are."""
    here = now.of(flight_doubt) if in_actuate(now.ui) else None
    return (*shown_doubt(now), *(() if here is None else (here,)))


def line(now: PageState) -> LinePart:
    """What the hand has set, and the answer of the last trim; while there is none of it, why."""
    one, state, units = actuated_blade(now) if in_actuate(now.ui) else None, now.state, now.units
    problem = units.in_sliders(now.problem, 0.0 if one is None else one.mass)
    design = now.preview or now.sliders
    if one is None:
        pieces = flight_pieces(now.shown, units) + blade_pieces(now.shown, design)
    else:
        pieces = flight_pieces(now.shown, units, one.mass)
        pieces += carrying_pieces(now.shown, design, _actuator(one))
    if problem or state is None:
        words = (
            f" has no trim: {problem.removeprefix('Not trimmed: ').rstrip('.')}"
            if problem
            else " …"
        )
        pieces.append(LinePiece(words, "problem"))
        return LinePart(pieces, LineStatus("problem", "", problem), problem)
    doubts = [(task, *now.latest(task)) for task in shown_doubt(now)]
    band, known = (doubts[0][1], doubts[0][2]) if doubts else (None, True)
    pieces += power_pieces(state.solution, units, band, known)
    pieces += _flight_change(one) if one is not None else _change(now)
    return LinePart(pieces, status(state, units))


def _actuator(one: ActuatedBlade) -> list[LinePiece]:
    """Its state, and the voltages as controls."""
    state, drives = one.now.hand.state, one.inputs.drives[: len(one.installed.shapes)]
    word, noun = (
        "at" if state == "set" else f"{STATES[state]} at",
        one.installed.actuator.drive_noun.capitalize(),
    )
    late = state == "schedule" and one.flight is None
    forbidden = one.installed.actuator.forbidden
    placement, host = one.inputs.mounting
    layout = layout_words(one.inputs.actuator, placement, host, crossed=one.inputs.crossed)
    name = LinePiece(one.name, menu=_actuator_menu(one))
    pieces = [LinePiece(" with "), name, LinePiece(f"{layout} ")]
    pieces += [LinePiece(f"({forbidden}) ", "forbidden", "bad")] if forbidden else []
    pieces += [LinePiece(word, "state" if late else "", stale=late), LinePiece(" ")]
    for k, drive in enumerate(drives):
        label = f"{noun} {k + 1} [%]" if len(drives) > 1 else f"{noun} [%]"
        pieces += [LinePiece(", ")] if k else []
        pieces.append(
            control(DRIVES[k], replace(_DRIVE, label=label, low=one.inputs.least_drive), drive)
        )
    return [*pieces, LinePiece("\u00a0%"), LinePiece(f" {noun.lower()}", WIDE)]


def _actuator_menu(one: ActuatedBlade) -> LineMenu:
    """All actuators; the rail's menu leaves out those that cannot move this blade."""
    chosen = one.inputs.actuator
    titles = actuator_titles()
    options = [LineOption(title, "kind", id, id == chosen) for id, title in titles.items()]
    return LineMenu("actuator", "Actuator", options)


def _flight_change(one: ActuatedBlade) -> list[LinePiece]:
    """With its mass and its drive, and the limits that are exceeded."""
    here, now, menu = one.here, one.now, _blade_menu(one)
    than = _than(one)
    blade = LinePiece(_than_blade(one), "against", menu=menu)
    if here is None:
        computing = LinePiece(": computing the change from ", "moved", stale=True)
        return [computing, blade, LinePiece(" …", "more", stale=True)]
    if here.band is None and abs(here.power) < MIN_SHOWN_W:
        return [LinePiece(": no change from ", "than"), blade]
    digit = (
        0.5 * 10.0 ** -fineness(now.state.solution.power, now.units)
        if now.state is not None
        else 0.5
    )
    note = (
        ", drive included" if abs(now.units.power[0].of(drive_power(now) or 0.0)) >= digit else ""
    )
    reach = one.installed.actuator.range_limits
    broken = () if one.verdict is None else one.verdict.broken
    over = over_pieces([limit_words(each.name) for each in broken if each.name not in reach])
    how = {"sourced": one.sourced, "built": one.built, "menu": menu}
    _, other = now.of(compared_trims) or (None, None)
    if other is None:
        return over
    return (
        change_pieces(here.power, here.band, than, other.power.total, now.units, note=note, **how)
        + over
    )


def _than(one: ActuatedBlade) -> str:
    """The blade that changes of an actuator count from, as the line names it."""
    against = one.question.against
    return "without it" if against == "same-blade" else f"with the {against_words(one, against)}"


def _than_blade(one: ActuatedBlade) -> str:
    """The same blade by itself: `the blade without it`."""
    against = one.question.against
    return (
        "the blade without it" if against == "same-blade" else f"the {against_words(one, against)}"
    )


def _blade_menu(one: ActuatedBlade) -> LineMenu:
    """The blades that changes of an actuator can count from."""
    chosen = one.question.against
    options = [
        LineOption(against_words(one, each), "against", each, each == chosen) for each in AGAINST
    ]
    return LineMenu("than", "Compared with", options)


def _change(now: PageState) -> list[LinePiece]:
    """From the blade as built, or A; nothing where that is what is shown."""
    state = now.state
    if state is None or not state.reference.converged:
        return []
    solution, reference, pinned = state.solution, state.reference, state.pinned is not None
    if solution.design == reference.design:
        same = LinePiece("A", "against", menu=_design_menu(now, state))
        return [LinePiece(": same as ", "than"), same] if pinned else []
    if "free-rotor" in (solution.design.models.trim, reference.design.models.trim):
        return []
    band, known = now.latest(shown_doubt(now)[0])
    within = None if band is None else band.change_band
    change = solution.power.total - reference.power.total
    than = than_words(solution.design, reference.design, pinned)
    # Twist that follows the azimuth takes an actuator.
    carried = solution.design.rotor.blade.carried is not None
    built = carried or solution.design.pitch_waves in ((), reference.design.pitch_waves)
    other = reference.power.total
    menu = _design_menu(now, state)
    pieces = change_pieces(
        change, within, than, other, now.units, known=known, menu=menu, built=built
    )
    if not built:
        pieces.append(LinePiece("; no actuator on board makes this", "unbuilt"))
    return pieces


def _design_menu(now: PageState, state: SessionState) -> LineMenu:
    """The designs that the one on the sliders can be compared with: the blade as built, A, and the bookmarks."""
    pinned = now.pins.pinned
    built = than_words(state.solution.design, state.baseline.design, pinned=False)
    options = [LineOption(built, "compare", BUILT, pinned is None)]
    compared = compared_with(pinned)
    marked = [_marked(kept) for kept in now.kept]
    chosen = [compared_with(bookmark) == compared for bookmark in marked]
    if pinned is None:
        options.append(LineOption("this design: keep it as A", "compare", THIS))
    elif not any(chosen):
        title = title_words(pinned.solution.design)
        options.append(LineOption(f"A: {title}", "compare", "a", chosen=True))
    for k, bookmark in enumerate(marked):
        blade = title_words(bookmark.solution.design)
        title = f"bookmark: {blade}, {flight_name(bookmark.inputs, now.units)}"
        options.append(LineOption(title, "compare", k, chosen[k]))
    return LineMenu("than", "Compared with", options)


def compare(now: PageState, wanted: str | int) -> tuple[Effect, ...]:
    """Compare with the blade as built, with the present design as A, or with a bookmark, by its place."""
    if wanted == BUILT:
        return () if now.pins.pinned is None else (PinOrder("unpin"),)
    if wanted == THIS:
        return (PinOrder("pin"),)
    if isinstance(wanted, int) and wanted < len(now.kept):
        return (PinDesign(_marked(now.kept[wanted])),)
    return ()


def _marked(kept: KeptDesign) -> Pinned:
    """A bookmark as A, with the actuator that it had on board."""
    return Pinned(kept.inputs, kept.solution)


def line_text(now: PageState) -> str:
    """The line as it is exported, with what is to be noted of the answer."""
    told = line(now)
    return plain(told.pieces, told.status.words if told.status.kind == "care" else "")


def view(now: PageState) -> dict[str, Any]:
    return {"line": line(now)}


LINE = Panel(view, works=works, presses={"compare": compare, "against": choose})
