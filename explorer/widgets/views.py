"""What is shown: views and colour range by the buttons over the scene, units, theme and size of type."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Literal

import viser

from explorer.model.inputs import ViewState
from explorer.model.session_state import Look, ScreenState, SessionState
from explorer.model.units import UNITS
from explorer.parts.frame import ViewsPart
from explorer.parts.presses import Drawn, SectionPress
from explorer.picture.camera_views import Camera, View
from explorer.picture.fields import FIELDS, shown_field
from explorer.picture.lifted_blade import fit_lifted
from explorer.picture.plan import plan
from explorer.scene.controller import SceneController
from explorer.text.glossary import hint
from explorer.widgets.actuator.actuator_panel import ActuatorPanel
from explorer.widgets.context import TabContext
from explorer.widgets.layout import by_hand
from explorer.widgets.probe_panel import ProbePanel
from rotor import Solution
from rotor.support.markup import tag

_BRAND = (37, 99, 235)


def theme(client: viser.ClientHandle, dark: bool) -> None:
    client.gui.configure_theme(
        dark_mode=dark, show_logo=False, show_share_button=False, brand_color=_BRAND
    )


_TIMES = {f"×{times:g}": times for times in (1.0, 2.0, 4.0)}
"""How many times its twist a blade may be drawn with."""


class SettingsPanel:
    def __init__(self, context: TabContext) -> None:
        self._context, gui, bind = context, context.gui, context.keyboard.bind
        view = context.display.view
        self._themed = view.dark
        self._units = gui.add_dropdown(
            "Units", tuple(UNITS), initial_value=view.units, hint=hint("units")
        )
        self._dark = gui.add_checkbox("Dark page", view.dark, hint=hint("dark"))
        self._big = gui.add_checkbox("Big type", False, hint=hint("big_type"))
        self._times = gui.add_dropdown("Drawn twist", tuple(_TIMES), hint=hint("times"))
        by_hand(self._units, lambda title: self._change(units=title))
        by_hand(self._dark, lambda dark: self._change(dark=dark))
        by_hand(self._times, lambda title: self._change(exaggeration=_TIMES[title]))
        self._big.on_update(lambda _: self._enlarge())
        words = tag("p", "Keys: press ", tag("b", "?"), " for the list, Ctrl+K to find a command.")
        gui.add_html(tag("div.rx.rx-dim.rx-small", words))
        bind("units", lambda: self._change(units=_after(tuple(UNITS), context.display.view.units)))
        bind("dark", lambda: self._change(dark=not context.display.view.dark))
        bind("field_next", lambda: self._step_field(1))
        bind("field_previous", lambda: self._step_field(-1))

    def show(self, state: SessionState | None) -> None:
        """Follow the view, which keys change too."""
        del state
        view = self._context.display.view
        if view.dark != self._themed:
            self._themed = view.dark
            theme(self._context.client, view.dark)
        self._units.value, self._dark.value = view.units, view.dark
        self._times.value = f"×{view.exaggeration:g}"

    def _change(self, **values: object) -> None:
        display = self._context.display
        display.set_view(replace(display.view, **values))  # pyright: ignore[reportArgumentType]

    def _step_field(self, step: int) -> None:
        """The next quantity that there is, or the one before."""
        state, shown = self._context.state(), self._context.display.view.field
        titles = [
            t for t in FIELDS if state is None or t == shown or FIELDS[t].exists(state.solution)
        ]
        self._change(field=_after(tuple(titles), shown, step))

    def _enlarge(self) -> None:
        """Big type in wider panels, or both as usual."""
        self._context.bridge.set(big=self._big.value)
        self._context.layout.enlarge(self._big.value)


def _after(titles: tuple[str, ...], title: str, step: int = 1) -> str:
    """The title so many places on, round and round."""
    return titles[(titles.index(title) + step) % len(titles)]


VIEWS: tuple[tuple[View, str], ...] = (("disk", "Disk"), ("blade", "Blade"), ("side", "Side"))
"""Views of the buttons after that of the whole, and their titles."""
_MISSING: dict[Drawn, str] = {
    "drawn": "",
    "none": "No 3D: this browser has no WebGL. Switch on hardware acceleration, or use another browser.",
    "lost": "The browser has lost the 3D view. It returns on its own, or when you reload the page.",
}
_RIDE: tuple[Literal["ride"], str] = ("ride", "Ride")
"""The view that goes with a blade section, and its title."""
_COMMANDS: dict[str, View | Literal["ride"]] = {
    "view_3d": "3d",
    "view_top": "top",
    "view_blade": "blade",
    "view_side": "side",
    "view_ride": "ride",
}


class SceneViews:
    def __init__(
        self,
        context: TabContext,
        scene: SceneController,
        probe: ProbePanel,
        actuator: ActuatorPanel,
    ) -> None:
        self._context, self._scene, self.probe, self._actuator = context, scene, probe, actuator
        self._view: View = "3d"
        self._missing = ""
        """Why the browser draws no scene."""
        self._mode = context.layout.mode
        self._on_blade: Callable[[float], Camera] | None = None
        """The camera's subject while the blade is lifted out."""
        self._planned: tuple[object, ...] | None = None
        """What the page's plan of the disk shows at rest."""
        self.before: Solution | None = None
        """The answer when the blade was taken into the hand, while it is seen from the tip with the plan beside it."""
        self._lifted_before = False
        """Whether the blade was out of the rotor before a ride."""
        probe.ride.ended.append(self._after_ride)
        context.bridge.on("view", self.look)
        context.bridge.on("ride", self._ride)
        context.bridge.on("colours", self._colour)
        context.bridge.on("scene", self.follow_browser)
        context.layout.watchers.append(self._mode_changed)
        context.following.append(lambda _: self._show())
        for name, view in _COMMANDS.items():
            context.keyboard.bind(name, partial(self.look, view))
        context.keyboard.bind("rescale", partial(self._colour, "Rescale"))
        context.keyboard.bind("rescale_default", partial(self._colour, "Default"))
        self._show()

    @property
    def now(self) -> Look:
        return "actuator" if self._actuator.lifted else "disk" if self._missing else self._view

    def follow_browser(self, scene: Drawn) -> None:
        """Where the browser draws no scene, the plan of the disk stands in its place, in every mode."""
        self._missing = _MISSING[scene]
        self._scene.drawn = not self._missing
        self._lift(self._mode == "actuate")
        self._show()
        self._context.wake()

    def on_screen(self) -> ScreenState:
        """What is on screen, searches apart: the design is the user's own."""
        context, hand = self._context, self._actuator.hand()
        return ScreenState(
            context.inputs(),
            context.display.view,
            context.pinboard.inputs,
            context.layout.mode,
            self.now,
            hand,
        )

    def put(self, wanted: ScreenState) -> None:
        """Show this, all at once; units and theme stay as the user has them."""
        context, layout = self._context, self._context.layout
        self._leave_ride()
        with context.whole:
            view = context.display.view
            if view != (other := replace(wanted.view, units=view.units, dark=view.dark)):
                context.display.set_view(other)
            if wanted.against != context.pinboard.inputs:
                context.pin(wanted.against)
            if wanted.inputs != context.inputs():
                context.set_inputs(wanted.inputs)
            self._actuator.put(wanted.hand)
            if wanted.mode != layout.mode:
                layout.show_mode(wanted.mode)
            if wanted.look != self.now:
                self.look(wanted.look)

    def look(self, view: Look | Literal["ride"]) -> None:
        """Show the rotor from there, or the blade with its actuator, or go with a section, where there is a scene."""
        if view == "ride":
            self._ride("off" if self.probe.riding else None)
            return
        if self._missing:
            return
        self._leave_ride()
        if view == "actuator":
            self._lift(True)
            return
        self._lift(False, view)
        self._view = view
        if view != "disk":
            self._hide_plan()
        self._scene.look(view)
        self._show()
        self._context.wake()

    def _ride(self, at: SectionPress | Literal["off"] | None) -> None:
        """Go with the section there, or with the one that is chosen; "off": the page has come back from it."""
        if at == "off":
            self.probe.ride.end(brought_back=True)
            return
        lifted = self._actuator.lifted
        if lifted:
            self._lift(False, self._view)
        self.probe.take_along(at)
        if self.probe.riding:
            self._lifted_before = self._lifted_before or lifted
        elif lifted:
            self._lift(True)
        self._show()

    def _leave_ride(self) -> None:
        """Something else is shown from now on."""
        self._lifted_before = False
        self.probe.ride.end()

    def _after_ride(self) -> None:
        """The blade is lifted out again, if it was."""
        lifted, self._lifted_before = self._lifted_before, False
        if lifted:
            self._lift(True)
        self._show()
        self._context.wake()

    def show_plan(self, solution: Solution, view: ViewState, at_rest: bool) -> None:
        """The disk from above, drawn by the page itself."""
        answer = self._context.pinboard.answer
        pinned = answer if answer is not None and answer.converged else None
        if self._actuator.lifted and not self._actuator.fits:
            self._lift(False)
        self._show()  # Another rotor may carry an actuator, or not.
        before, other = self.before, self._actuator.lifted or self.before is not None
        self._context.bridge.set(wipe=view.wipe and pinned is not None and not other)
        view = replace(view, wipe=view.wipe and not other)
        if before is not None:
            view = replace(view, stall=True, reverse_flow=True, drag_divergence=False)
        elif not (self.now == "disk" or self._missing):
            self._hide_plan()
            return
        field = shown_field(view, pinned)
        colour_range = self._scene.held_range(field)
        wanted = solution, replace(view, azimuth_deg=0.0), colour_range, pinned, before
        if not at_rest and self._planned == wanted:
            return  # It stands there already, with its values.
        self._planned = wanted if at_rest else None
        compared = pinned or before
        content = plan(
            solution, view, field, colour_range, at_rest, None if compared is solution else compared
        )
        held = None if before is None else "before" if pinned is None else "A"
        self._context.bridge.set(plan=replace(content, held=held))

    def _hide_plan(self) -> None:
        self._planned = None
        self._context.bridge.set(plan=None)

    def _colour(self, order: str) -> None:
        """A colour range was asked for: fitted ("Rescale") or the field's own ("Default")."""
        self._context.display.fitted = order == "Rescale"
        self._scene.order_range(order)
        self._context.wake()

    def _mode_changed(self) -> None:
        """Actuate opens on the blade that carries the actuator."""
        before, self._mode = self._mode, self._context.layout.mode
        if self._mode != before:  # Otherwise only the drawer has changed.
            self._leave_ride()
            self._lift(self._mode == "actuate")
            if before == "actuate":
                self._actuator.leave()
            self._context.wake()  # A voltage acts in Actuate only.
        self._show()

    def _lift(self, out: bool, towards: View | None = None) -> None:
        """Lift the blade out, the helicopter flying on behind it, or fly back to a view of the rotor."""
        out, camera = out and self._actuator.fits, self._scene.camera
        if out == self._actuator.lifted:
            return
        self._actuator.lift(out)
        self._scene.set_behind(out)
        self.probe.seen = not out
        if out:
            self._on_blade = partial(fit_lifted, camera.radius)
            camera.aim_with(self._on_blade)
        elif towards is None and camera.subject is self._on_blade:
            # Otherwise a step of the lecture has aimed it elsewhere already.
            camera.aim(self._view)
        self._show()

    def _show(self) -> None:
        on_stage = self._context.layout.mode == "actuate" and self._actuator.fits
        whole = "Aircraft" if self._context.inputs().stand is None else "Rotor"
        views = (*([("actuator", "Actuator")] if on_stage else []), ("3d", whole), *VIEWS, _RIDE)
        now = "ride" if self.probe.riding else self.now
        self._context.bridge.set(views=ViewsPart(views, now, self._missing))
