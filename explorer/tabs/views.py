"""The buttons over the scene: which view, the colour range, and one blade, cut open, in place of the rotor."""

from functools import partial

import viser

from explorer.picture.camera_views import View
from explorer.scene.controller import SceneController
from explorer.tabs.actuator.cut_blade import fit_cut
from explorer.tabs.context import TabContext
from explorer.tabs.probe.probe_panel import ProbePanel

VIEWS: tuple[tuple[View, str], ...] = (("3d", "Aircraft"), ("disk", "Disk"), ("blade", "Blade"), ("side", "Side"))
"""Views of the buttons, and their titles."""
_COMMANDS: dict[str, View] = {"view_3d": "3d", "view_top": "top", "view_blade": "blade", "view_side": "side"}


class SceneViews:
    """One session's."""

    def __init__(
        self, context: TabContext, scene: SceneController, probe: ProbePanel, cut: viser.GuiCheckboxHandle
    ) -> None:
        """`cut`: whether the blade is shown cut open."""
        self._context, self._scene, self._probe, self._cut = context, scene, probe, cut
        self._view: View = "3d"
        cut.on_update(lambda _: self._cut_switched())
        context.bridge.on("view", self.look)
        context.bridge.on("colours", self._colour)
        context.layout.watchers.append(self._mode_changed)
        for name, view in _COMMANDS.items():
            context.keyboard.bind(name, partial(self.look, view))
        context.keyboard.bind("rescale", partial(self._colour, "Rescale"))
        context.keyboard.bind("rescale_default", partial(self._colour, "Default"))
        self._show()

    def look(self, view: View) -> None:
        """Show the rotor from there."""
        self._close_cut()
        self._view = view
        self._scene.look(view)
        self._show()
        self._context.wake()

    def _colour(self, order: str) -> None:
        """A colour range was asked for: fitted ("Rescale") or the field's own ("Default")."""
        self._context.display.order_range(order)
        self._scene.order_range(order)
        self._context.wake()

    def _mode_changed(self) -> None:
        if self._context.layout.mode != "actuate":
            self._close_cut()

    def _close_cut(self) -> None:
        if self._cut.value:
            self._cut.value = False

    def _cut_switched(self) -> None:
        cut, camera = self._cut.value, self._scene.camera
        self._scene.set_seen(not cut)
        self._probe.set_seen(not cut)
        if camera is not None:
            if cut:
                camera.aim_with(partial(fit_cut, camera.radius))
            else:
                camera.aim(self._view)
        self._show()

    def _show(self) -> None:
        self._context.bridge.set(views={"all": VIEWS, "now": "" if self._cut.value else self._view})
