"""The commands of the page itself: flight, view and design. Tabs bind their own."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from explorer.picture.camera_views import View
from explorer.picture.fields import FIELDS
from explorer.tabs.interface import Desk
from explorer.tabs.lecture.cases import FLIGHTS
from explorer.text.units import UNITS

SPEEDS = dict(zip(("hover", "mu_015", "mu_024", "mu_037"), FLIGHTS.values(), strict=True))
"""Advance ratios of the flight presets, by command."""
VIEWS: dict[str, View] = {"view_3d": "3d", "view_top": "top", "view_blade": "blade", "view_side": "side"}


@dataclass(frozen=True)
class Actions:
    """What the session's parts can do at once."""

    look: Callable[[View], None]
    colours: Callable[[str], None]
    """"Rescale" or "Default"."""
    check: Callable[[], None]
    reset: Callable[[], None]
    search: Callable[[], None]
    """Start the optimiser, or stop it."""


def bind_commands(desk: Desk, actions: Actions) -> None:
    """Give the commands of the page their actions."""
    for name, mu in SPEEDS.items():
        desk.bind(name, partial(_fly, desk, mu))
    for name, view in VIEWS.items():
        desk.bind(name, partial(actions.look, view))
    desk.bind("field_next", partial(_show_field, desk, 1))
    desk.bind("field_previous", partial(_show_field, desk, -1))
    desk.bind("rescale", partial(actions.colours, "Rescale"))
    desk.bind("rescale_default", partial(actions.colours, "Default"))
    desk.bind("dark", lambda: desk.set_view(replace(desk.view(), dark=not desk.view().dark)))
    desk.bind("units", partial(_change_units, desk))
    desk.bind("check", actions.check)
    desk.bind("reset", actions.reset)
    desk.bind("optimise", actions.search)


def _fly(desk: Desk, mu: float) -> None:
    desk.set_inputs(replace(desk.inputs(), advance_ratio=mu))


def _change_units(desk: Desk) -> None:
    view, titles = desk.view(), tuple(UNITS)
    desk.set_view(replace(view, units=titles[(titles.index(view.units) + 1) % len(titles)]))


def _show_field(desk: Desk, step: int) -> None:
    titles, view = tuple(FIELDS), desk.view()
    desk.set_view(replace(view, field=titles[(titles.index(view.field) + step) % len(titles)]))
