"""The drawers of power and trim, and of how far to trust them."""

from typing import Any

from explorer.charts.doubt import doubt_rows
from explorer.text import readout
from explorer.text.status import status_panel
from explorer.views.page_state import PageState, Panel, Questions
from explorer.views.work import shown_doubt
from explorer.workers.call import Call
from rotor.support.markup import Markup
from rotor.trim.doubt import alternative_models

_URGENCY, _STILL = 5, 0.6
"""[s] without a change before other models are solved."""


def details(now: PageState) -> dict[str, Any]:
    """Power and trim: of this design, or of A and B; greyed while there is no trim."""
    state, units = now.state, now.units
    if state is None:
        return {}
    solution, pinned = state.solution, state.pinned
    band = now.answers.get(shown_doubt(now)[0].key)
    if pinned is None:
        tables = (
            readout.power_panel(solution, state.baseline, units, band),
            readout.trim_panel(solution),
        )
    else:
        power = readout.compared_power_panel(solution, pinned, units, band)
        tables = power, readout.compared_trim_panel(solution, pinned)
    power, trim = map(readout.outdated, tables) if now.problem else tables
    return {"details.power": power, "details.trim": trim}


def trust(now: PageState) -> dict[str, Any]:
    """The status, what the doubt consists of, and what other models give. While the design moves the rows of the step
    before stay, greyed."""
    state, asked = now.state, shown_doubt(now)
    if now.problem or state is None:
        return {"trust.status": status_panel(None, now.problem or None)}
    rows = Markup()
    found, current = now.latest(asked[0]) if asked else (None, True)
    if found is not None:
        models = now.answers.get(_model_questions(now)[0].calls[0]) if current else None
        rows = doubt_rows(found, now.units, models if isinstance(models, tuple) else ())
        rows = rows if current else readout.outdated(rows)
    status = status_panel(state.solution, pinned=state.pinned, units=now.units)
    return {"trust.status": status, "trust.doubts": rows}


def _model_questions(now: PageState) -> tuple[Questions, ...]:
    return tuple(
        Questions(_URGENCY, (Call(alternative_models, work.about),), _STILL)
        for work in shown_doubt(now)
    )


DETAILS = Panel(details, lambda ui: ui.drawer == "details", works=shown_doubt)
TRUST = Panel(trust, lambda ui: ui.drawer == "trust", _model_questions, shown_doubt)
