"""The commands of the page itself: flight, view and design. Tabs bind their own."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from explorer.interface import TabContext
from explorer.picture.camera_views import View
from explorer.picture.fields import FIELDS
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


def bind_commands(context: TabContext, actions: Actions) -> None:
    """Give the commands of the page their actions."""
    for name, mu in SPEEDS.items():
        context.bind_command(name, partial(_fly, context, mu))
    for name, view in VIEWS.items():
        context.bind_command(name, partial(actions.look, view))
    context.bind_command("field_next", partial(_show_field, context, 1))
    context.bind_command("field_previous", partial(_show_field, context, -1))
    context.bind_command("rescale", partial(actions.colours, "Rescale"))
    context.bind_command("rescale_default", partial(actions.colours, "Default"))
    context.bind_command("dark", lambda: context.set_view(replace(context.view(), dark=not context.view().dark)))
    context.bind_command("units", partial(_change_units, context))
    context.bind_command("check", actions.check)
    context.bind_command("reset", actions.reset)
    context.bind_command("optimise", actions.search)


def _fly(context: TabContext, mu: float) -> None:
    context.set_inputs(replace(context.inputs(), advance_ratio=mu))


def _change_units(context: TabContext) -> None:
    view, titles = context.view(), tuple(UNITS)
    context.set_view(replace(view, units=titles[(titles.index(view.units) + 1) % len(titles)]))


def _show_field(context: TabContext, step: int) -> None:
    titles, view = tuple(FIELDS), context.view()
    context.set_view(replace(view, field=titles[(titles.index(view.field) + step) % len(titles)]))
