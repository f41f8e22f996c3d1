"""The picture of one session: rotor, disk, ghost and colour range; draws only what has changed."""

import viser

from explorer.controls import Controls
from explorer.fields import FIELDS, fitted_range
from explorer.overlays import Ghost
from explorer.picture import disk_png, field_values, make_picture
from explorer.scene import Scene
from explorer.state import ViewState
from rotor.blade import Rotor
from rotor.presets import uh60a_rotor
from rotor.solution import Solution
from rotor.twist import TwistLaw

Range = tuple[float, float]


class Frame:
    """One session's; everything but the buttons happens on its worker."""

    def __init__(self, client: viser.ClientHandle, rotor: Rotor, controls: Controls) -> None:
        self._client = client
        self._controls = controls
        self._scene = Scene(client.scene, rotor)
        self._ghost = Ghost(client.scene, rotor)
        self._drawn: tuple[Solution, ViewState, Range, TwistLaw | None] | None = None
        self._ranges = {title: (field.low, field.high) for title, field in FIELDS.items()}
        self._order: str | None = None
        """Another range that was asked for."""

    def draw(self, solution: Solution, view: ViewState, ghost: TwistLaw | None) -> None:
        """Show a converged answer, and the ghost of another blade on the marked one."""
        colour_range = self._range(solution, view)
        wanted = (view, colour_range, ghost)
        if self._drawn is not None and self._drawn[0] is solution and self._drawn[1:] == wanted:
            return
        picture = make_picture(solution, view, colour_range)
        with self._client.atomic():
            self._scene.show(picture)
            self._ghost.show(uh60a_rotor(solution.design.preset), ghost, view.exaggeration)
        self._client.flush()  # The frame goes out now; read-outs and charts follow while it is drawn.
        self._controls.show_range(view.field, colour_range, faded=False)
        self._drawn = (solution, *wanted)

    def fade(self, good: Solution | None, view: ViewState) -> None:
        """Show that the picture, of the last good answer, no longer holds."""
        self._drawn = None
        if good is None:
            return
        colour_range = self._range(good, view)
        png = disk_png(good, FIELDS[view.field], colour_range, faded=True)
        with self._client.atomic():
            self._scene.fade(png)
        self._controls.show_range(view.field, colour_range, faded=True)

    def set_seen(self, seen: bool) -> None:
        """Whether the rotor is in the scene, or makes room for something else."""
        self._scene.set_seen(seen)

    def order_range(self, order: str) -> None:
        """Fit the colour range to the data ("Rescale") or take its own again ("Default"), in the next round."""
        self._order = order

    def _range(self, solution: Solution, view: ViewState) -> Range:
        """The colour range: held, unless a button asked for another."""
        order, self._order = self._order, None
        field = FIELDS[view.field]
        if order == "Rescale":
            self._ranges[view.field] = fitted_range(field, field_values(solution, field))
        elif order == "Default":
            self._ranges[view.field] = (field.low, field.high)
        return self._ranges[view.field]
