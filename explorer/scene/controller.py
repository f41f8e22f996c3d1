"""The picture of one session: rotor, disk, ghost and colour range; draws only what has changed."""

from dataclasses import dataclass, replace

import viser

from explorer.interface import RangeDisplay
from explorer.picture.difference import shown_field
from explorer.picture.fields import Field, fitted_range
from explorer.picture.picture import disk_png, field_values, make_picture, turned_blades
from explorer.scene.overlays import Ghost, OtherBlade
from explorer.scene.scene import Scene
from explorer.state import ViewState
from rotor.design.blade import Rotor
from rotor.trim.solution import Solution

Range = tuple[float, float]


@dataclass(frozen=True)
class _Drawn:
    """What decides a frame."""

    solution: Solution
    pinned: Solution | None
    """Where the disk shows the difference to it."""
    view: ViewState
    colour_range: Range
    ghost: OtherBlade | None

    def at(self, azimuth_deg: float) -> "_Drawn":
        """The same with the marked blade elsewhere."""
        return replace(self, view=replace(self.view, azimuth_deg=azimuth_deg))


class SceneController:
    """One session's; everything but the buttons happens on its worker."""

    def __init__(self, client: viser.ClientHandle, rotor: Rotor, display: RangeDisplay) -> None:
        self._client = client
        self._display = display
        self._scene = Scene(client.scene, rotor)
        self._ghost = Ghost(client.scene, rotor)
        self._drawn: _Drawn | None = None
        self._ranges: dict[str, Range] = {}
        """By title of the field, once one was held."""
        self._order: str | None = None
        """Another range that was asked for."""

    def draw(
        self, solution: Solution, view: ViewState, ghost: OtherBlade | None, pinned: Solution | None = None
    ) -> None:
        """Show a converged answer, the ghost of another blade on the marked one, and on the disk B − A if wanted."""
        field = shown_field(view, pinned)
        colour_range = self._range(solution, field)
        wanted = _Drawn(solution, pinned if view.difference else None, view, colour_range, ghost)
        if self._drawn == wanted:
            return
        if self._drawn is not None and self._drawn.at(view.azimuth_deg) == wanted:
            # The same disk, its colours and lines: only the blades turn.
            with self._client.atomic():
                self._scene.turn(turned_blades(solution, view))
            self._client.flush()
            self._drawn = wanted
            return
        picture = make_picture(solution, view, colour_range, field)
        with self._client.atomic():
            self._scene.fit(solution.design.rotor)
            self._scene.show(picture)
            self._ghost.show(ghost, view.exaggeration)
        self._client.flush()  # The frame goes out now; read-outs and charts follow while it is drawn.
        self._display.show_range(field, colour_range, faded=False)
        self._drawn = wanted

    def fade(self, good: Solution | None, view: ViewState, pinned: Solution | None = None) -> None:
        """Show that the picture, of the last good answer, no longer holds."""
        self._drawn = None
        if good is None:
            return
        field = shown_field(view, pinned)
        colour_range = self._range(good, field)
        png = disk_png(good, field, colour_range, faded=True)
        with self._client.atomic():
            self._scene.fade(png)
        self._display.show_range(field, colour_range, faded=True)

    def set_seen(self, seen: bool) -> None:
        """Whether the rotor is in the scene, or makes room for something else."""
        self._scene.set_seen(seen)

    def held_range(self, field: Field) -> Range:
        """The colour range a field has on the page."""
        return self._ranges.get(field.title, (field.low, field.high))

    def order_range(self, order: str) -> None:
        """Fit the colour range to the data ("Rescale") or take its own again ("Default"), in the next round."""
        self._order = order

    def _range(self, solution: Solution, field: Field) -> Range:
        """The colour range: held, unless a button asked for another."""
        order, self._order = self._order, None
        if order == "Rescale":
            self._ranges[field.title] = fitted_range(field, field_values(solution, field))
        elif order == "Default" or field.title not in self._ranges:
            self._ranges[field.title] = (field.low, field.high)
        return self._ranges[field.title]
