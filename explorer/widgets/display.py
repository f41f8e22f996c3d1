"""What is shown on the disk and how: the field card of the frame ↔ `ViewState`. None of it moves the design."""

import threading
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

from explorer.colours import Scheme, colour_map, css
from explorer.hosting.browser import Bridge
from explorer.model.inputs import ViewState
from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.parts.stage import FieldPart, TurnPart
from explorer.picture.fields import FIELDS, Field, fields_of
from explorer.picture.plan import REGIONS as OUTLINED
from rotor import Solution
from rotor.support.chart import bar_ticks

SWITCHES = ("stall", "past_static", "reverse_flow", "wake", "drag_divergence")
"""Fields of `ViewState` that a press switches."""
_COLOURS = 17


class Display:
    """The view of one client. It has no widgets of viser's: the frame shows it and reports what is pressed."""

    def __init__(
        self,
        bridge: Bridge,
        start: ViewState,
        changed: Callable[[], None],
        turned: Callable[[], None],
    ) -> None:
        """`changed`: something is shown otherwise. `turned`: it was only the reference blade."""
        self._bridge, self._changed, self._turned = bridge, changed, turned
        self._lock = threading.RLock()
        self.view = replace(start, difference=False)
        self._awaited = start.difference
        """B − A is to be shown as soon as there is an A."""
        self._allowed = self._playing = self._faded = False
        self.fitted = False
        """Whether a fitted colour range was asked for, not the field's own."""
        self._shares: dict[str, str] = {}
        self._fields = list(FIELDS)
        self._range: tuple[Field, tuple[float, float]] | None = None
        self._beyond = (False, False)
        bridge.on("field", lambda title: self._change(field=title) if title in FIELDS else None)
        bridge.on("region", self._switch_region)
        bridge.on("difference", lambda way: self._change(difference=way == "on" and self._allowed))
        bridge.on("azimuth", self.turn)
        self._show_turn()

    def set_view(self, view: ViewState) -> None:
        with self._lock:
            self._awaited = view.difference and not self._allowed
            self.view = replace(view, difference=view.difference and self._allowed)
        self._show_turn()
        self._show_field()
        self._changed()

    def turn(self, azimuth_deg: float) -> None:
        with self._lock:
            self.view = replace(self.view, azimuth_deg=azimuth_deg % 360.0)
        self._show_turn()
        self._turned()

    def set_playing(self, playing: bool) -> None:
        self._playing = playing
        self._show_turn()

    def show_range(
        self,
        field: Field,
        colour_range: tuple[float, float],
        faded: bool,
        beyond: tuple[bool, bool],
    ) -> None:
        """The colour bar of a field; `beyond`: whether values lie below its range, and above."""
        self._range, self._faded, self._beyond = (field, colour_range), faded, beyond
        self._show_field()

    def show(self, state: SessionState) -> None:
        """How much of the disk is separated or past the static angle, which regions it has none of, and the quantities
        that its models have."""
        self._fields, self._shares = fields_of(state.solution), _shares(state.solution, state.view)
        self._show_field()

    def allow_difference(self, allowed: bool) -> None:
        """Whether there is a pinned design that the disk can show the difference from."""
        with self._lock:
            if allowed == self._allowed:
                return
            self._allowed = allowed
            wanted = allowed and (self._awaited or self.view.difference)
            self._awaited = False
            self.view = replace(self.view, difference=wanted)
        self._show_field()
        self._changed()

    def _change(self, **values: Any) -> None:
        with self._lock:
            self.view = replace(self.view, **values)
        self._show_field()
        self._changed()

    def _switch_region(self, name: str) -> None:
        if name in SWITCHES or (name == "wipe" and self._allowed):
            self._change(**{name: not getattr(self.view, name)})

    def _show_turn(self) -> None:
        self._bridge.set(turn=TurnPart(self.view.azimuth_deg, self._playing))

    def _show_field(self) -> None:
        if self._range is None:
            return
        (field, range_), view = self._range, self.view
        self._bridge.set(
            field=FieldPart(
                fields=[title for title in FIELDS if title in self._fields or title == view.field],
                field=view.field,
                unit=f"{field.unit}{field.note}",
                colours=_bar(field.colours),
                ticks=bar_ticks(*range_),
                stale=self._faded,
                fitted=self.fitted,
                regions={name: getattr(view, name) for name in SWITCHES},
                shares=self._shares,
                difference=view.difference if self._allowed else None,
                wipe=view.wipe,
                beyond=self._beyond,
            )
        )


def _shares(solution: Solution, view: ViewState) -> dict[str, str]:
    """Part of the disk that is separated, or past the static angle; of regions that are shown also that there is
    none."""
    shares = dict[str, str]()
    for name, region in OUTLINED.items():
        stall = name in ("stall", "past_static")
        area, _ = region.share(solution.regions)
        if stall and area:
            shares[name] = f"{number(100.0 * area, 1)} %"
        elif not getattr(view, name) or len(region.outline(solution)):
            continue
        elif stall and not solution.design.models.stall:
            shares[name] = "not modelled"
        else:
            shares[name] = "none"
    return shares


@cache
def _bar(scheme: Scheme) -> list[str]:
    """Colours of the bar, as style sheets write them."""
    return [css(colour) for colour in colour_map(scheme, _COLOURS).tolist()]
