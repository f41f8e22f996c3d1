"""The picture of one session: rotor, disk, overlay and colour range; draws only what has changed.

The page gets numbers: it twists the blades and colours the disk by `disk.js`. `draw_at_rest` adds what is seen at rest
alone. The page also gives surfaces their gloss and turns the rotor smoothly, at the rate of the screen: `scene.js`
moves blades and tip vortices by the formula of `explorer.picture.wake`. Both lean on private names of viser's client
(`__viserMutable`: nodeRefFromName, nodePoseData, requestRender); each has a browser test.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import viser

from explorer.colours import DiskInk, Scheme, scene_theme
from explorer.hosting.browser import call
from explorer.model.inputs import ViewState, baseline_of
from explorer.picture.blade_mesh import BladeForm
from explorer.picture.camera_views import View
from explorer.picture.disk_numbers import disk_ink, disk_numbers
from explorer.picture.fields import (
    CLIPPED_SHARE,
    Field,
    fitted_range,
    keeps_range,
    over_range,
    shown_field,
    usual_range,
)
from explorer.picture.picture import (
    field_values,
    make_picture,
    marks_of,
    pitch_series,
    turned_blades,
)
from explorer.picture.polar import NO_MARKS
from explorer.picture.wake import tip_vortex_path
from explorer.scene.camera import FittedCamera
from explorer.scene.overlays import VORTICES, AirLines, OtherBlade, Overlay
from explorer.scene.scene import COMPARED, ROTOR, Scene
from rotor import Rotor, Solution
from rotor.support.arrays import Array

Range = tuple[float, float]
_WITHIN = False, False
"""No values beyond the colour range, as far as is known."""
TURN_RATE, BEHIND_RATE = math.radians(54.0), math.radians(162.0)
"""[rad/s] at which a played rotor turns; at the normal one flapping and pitching of one blade can be followed."""
SURFACES = {
    f"{ROTOR}/blade_0": {"roughness": 0.55},
    **{f"{ROTOR}/blade_{k}": {"roughness": 0.42} for k in range(1, 8)},
    f"{ROTOR}/head": {"roughness": 0.38, "metalness": 0.55},
    "/airframe/glass": {"roughness": 0.12, "metalness": 0.2},
    **{name: {"flat": True} for name in ("/shadow", f"{ROTOR}/disk/words", f"{ROTOR}/disk/field")},
    **{name: {"flat": True} for name in ("/compared/disk/words", "/compared/disk/field")},
}
"""Materials by node: how rough and metallic, or a flat picture, which must not hide what lies behind its corners."""


def motion_of(solution: Solution, root: str = ROTOR) -> dict[str, Any]:
    """What `rotorScene.move` needs: how blades flap and pitch, and where the tip vortices go."""
    rotor, controls = solution.design.rotor, solution.controls
    return {
        "root": root,
        "blades": rotor.blades,
        "hinge": rotor.blade.flap_hinge * rotor.radius,
        "flap": [controls.coning, controls.flap_1c, controls.flap_1s],
        "pitch": pitch_series(controls, solution.design),
        "radius": rotor.radius,
        "vortices": VORTICES,
        "path": asdict(tip_vortex_path(solution)),
    }


class PageScene:
    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._played = self._spun = False
        self._motion: Solution | None = None
        self._inks: dict[str, tuple[Scheme, DiskInk, bool]] = {}
        call(client, "rotorScene.dress", SURFACES)

    def form(self, forms: Mapping[str, BladeForm]) -> None:
        """Shape the blades of these nodes."""

        def numbers(values: Array | None, digits: int) -> Any:
            return None if values is None else values.round(digits).tolist()

        shaped = {
            node: [numbers(form.pitch, 5), numbers(form.bent, 4), numbers(form.size, 3)]
            for node, form in forms.items()
        }
        call(self._client, "rotorDisk.form", shaped)

    def paint(
        self,
        solution: Solution,
        field: Field,
        ends: Range,
        view: ViewState,
        root: str = ROTOR,
        faded: bool = False,
    ) -> None:
        """Colour the disk; `faded`: that of a solution that no longer holds."""
        ink = field.colours, scene_theme(view.dark).ink, faded
        marks = NO_MARKS if faded else marks_of(view)
        if ink != self._inks.get(root):
            self._inks[root] = ink
            call(self._client, "rotorDisk.ink", root, disk_ink(*ink))
        call(self._client, "rotorDisk.paint", root, disk_numbers(solution, field, ends, marks))

    def move(self, solution: Solution) -> None:
        """How the blades flap and pitch from now on; sent at once only while the rotor turns."""
        self._motion = solution
        if self.playing:
            self._send(solution)

    def compare(self, solution: Solution | None) -> None:
        """How the blades of A move, where it is at the same place."""
        motion = None if solution is None else motion_of(solution, COMPARED)
        call(self._client, "rotorScene.compare", motion)

    def turn(self, azimuth: float) -> None:
        """The reference blade is at ψ [rad] now; the page goes on from here until the next message."""
        if self.playing:
            call(self._client, "rotorScene.turn", round(azimuth, 4))

    @property
    def playing(self) -> bool:
        return self._motion is not None and (self._played or self._spun)

    def play(self, playing: bool) -> None:
        """Let the page move the blades as it will, or leave them to the scene again."""
        self._switch(playing, self._spun)

    def spin(self, spinning: bool) -> None:
        """Let the page turn the rotor by itself where nothing else does, or no more."""
        if spinning != self._spun:
            call(self._client, "rotorScene.spin", BEHIND_RATE if spinning else 0.0)
        self._switch(self._played, spinning)

    def _switch(self, played: bool, spun: bool) -> None:
        before = self.playing
        self._played, self._spun = played, spun
        if self.playing and not before and self._motion is not None:
            self._send(self._motion)
        elif before and not self.playing:
            call(self._client, "rotorScene.stop")

    def _send(self, solution: Solution) -> None:
        call(self._client, "rotorScene.move", motion_of(solution))


ShowRange = Callable[[Field, Range, bool, tuple[bool, bool]], None]
"""Shows the colour bar of a field: whether the disk no longer holds; whether values lie below the range, and above."""


@dataclass(frozen=True)
class _PictureInputs:
    """All that one picture of the scene depends on."""

    solution: Solution
    pinned: Solution | None
    """Where the disk shows the difference to it, or it is wiped."""
    view: ViewState
    colour_range: Range
    overlay: OtherBlade
    look: View
    """The camera's: labels on the disk face it."""

    def at(self, azimuth_deg: float) -> "_PictureInputs":
        """This picture with the reference blade elsewhere."""
        return replace(self, view=replace(self.view, azimuth_deg=azimuth_deg))


class SceneController:
    """One session's; everything but the buttons happens on its worker."""

    def __init__(
        self,
        client: viser.ClientHandle,
        camera: FittedCamera,
        rotor: Rotor,
        show_range: ShowRange,
        dark: bool = False,
    ) -> None:
        """`camera`: follows the shaft tilt."""
        self._client = client
        self._show_range = show_range
        theme = scene_theme(dark)
        self.scene = Scene(client.scene, rotor, theme)
        self._overlay = Overlay(client.scene, rotor, theme)
        self._air = AirLines(client.scene)
        self._page = PageScene(client)
        self.camera = camera
        self.drawn = True
        """Whether the browser draws what it is sent."""
        self._look: View = "3d"
        self._drawn: _PictureInputs | None = None
        self._compared = False
        """Whether A is at the place of B."""
        self._rested = False
        """Whether the lines that are seen at rest are drawn."""
        self._ranges: dict[str, Range] = {}
        """By title of the field, once one was held."""
        self._chosen: set[str] = set()
        """Titles whose range the user asked for: it stays."""
        self._order: str | None = None
        """Another range that was asked for."""

    def on_press(self, take: Callable[[float], None]) -> None:
        """Call `take` with the distance from the hub [m] at which the reference blade is pressed."""

        async def dragged(event: viser.SceneNodeDragEvent[Any]) -> None:
            if event.phase == "start":
                take(float(np.linalg.norm(event.start_position)))

        self.scene.rotor.reference_blade.on_drag("left")(dragged)

    def draw(
        self,
        solution: Solution,
        view: ViewState,
        overlay: OtherBlade | None,
        pinned: Solution | None = None,
    ) -> None:
        """Show a converged solution, the overlay of another blade on the reference blade, and B − A or A if wanted."""
        if overlay is None:
            as_built = baseline_of(solution.design)
            overlay = OtherBlade(as_built.rotor, as_built.twist, None)
        field = shown_field(view, pinned)
        colour_range = self._range(solution, field)
        wanted = _PictureInputs(solution, pinned, view, colour_range, overlay, self._look)
        if self._drawn == wanted:
            return
        if self._drawn is not None and self._drawn.at(view.azimuth_deg) == wanted:
            # The same disk and its colours: only the blades turn.
            blades = turned_blades(solution, view)
            with self._client.atomic():
                if not self._page.playing:
                    self.scene.rotor.turn(blades)
                if len(blades.forms) > 1:
                    other = self._overlay.show(
                        overlay, solution, view, at_rest=not self._page.playing
                    )
                    self._page.form(self.scene.rotor.forms(blades) | other)
                self._page.turn(blades.azimuth)
                if not self._page.playing:  # Else the page moves them.
                    self._air.hide_vortices()
            self._client.flush()
            self._drawn, self._rested = wanted, False
            return
        picture = make_picture(solution, view)
        with self._client.atomic():
            theme = scene_theme(view.dark)
            self.scene.set_theme(theme)
            self._overlay.set_theme(theme)
            self.scene.fit(solution.design)
            self.scene.show(picture, still=not self._page.playing)
            other = self._overlay.show(overlay, solution, view, at_rest=False)
            self._page.form(self.scene.rotor.forms(picture.blades) | other)
            self._page.paint(solution, field, colour_range, view)
            self._page.move(solution)
            self._show_range(field, colour_range, False, _WITHIN)
            self.camera.follow(solution.controls.shaft_tilt)
        self._client.flush()  # The frame goes out now; read-outs and charts follow while it is drawn.
        self._drawn, self._rested = wanted, False

    def draw_at_rest(self) -> None:
        """Nothing moves: draw the overlay's edges, vortices, and A to be wiped.

        The colour range of a difference that no longer fits is fitted now; any other holds across designs.
        """
        drawn = self._drawn
        if drawn is None or self._rested:
            return
        solution, view = drawn.solution, drawn.view
        field = shown_field(view, drawn.pinned)
        values = field_values(solution, field)
        if (
            field.note
            and field.title not in self._chosen
            and not keeps_range(field, values, drawn.colour_range)
        ):
            fitted = fitted_range(field, values, trim=CLIPPED_SHARE)
            self._ranges[field.title], drawn = fitted, replace(drawn, colour_range=fitted)
            self._page.paint(solution, field, fitted, view)
        self._show_range(field, drawn.colour_range, False, over_range(values, drawn.colour_range))
        compared = (
            drawn.pinned
            if view.wipe and drawn.pinned is not None and drawn.pinned.converged
            else None
        )
        with self._client.atomic():
            self._overlay.show(drawn.overlay, solution, view, at_rest=True)
            self._air.show(solution, view, scene_theme(view.dark))
            if compared is not None:
                self._air.hide_vortices()
            if view.wipe or self._compared:
                self._compared = compared is not None
                self._page.compare(compared)
            if compared is None:
                self.scene.hide_compared()
            else:
                picture = make_picture(compared, view)
                nodes = self.scene.show_compared(compared.design, picture)
                self._page.form(nodes.forms(picture.blades))
                self._page.paint(compared, field, drawn.colour_range, view, COMPARED)
        self._client.flush()
        self._drawn, self._rested = drawn, True

    def fade(self, good: Solution | None, view: ViewState, pinned: Solution | None = None) -> None:
        """Show that the picture, of the last converged solution, no longer holds."""
        self._drawn = None
        if good is None:
            return
        field = shown_field(view, pinned)
        colour_range = self._range(good, field)
        self._page.paint(good, field, colour_range, view, faded=True)
        self._show_range(field, colour_range, True, _WITHIN)

    def play(self, playing: bool) -> None:
        """Whether the azimuth walks on by itself: the page then turns the rotor smoothly between its steps."""
        self._page.play(playing)
        drawn = self._drawn
        if not playing and drawn is not None:
            with self._client.atomic():
                self.scene.rotor.turn(turned_blades(drawn.solution, drawn.view))
                self._air.show(drawn.solution, drawn.view, scene_theme(drawn.view.dark))

    def set_behind(self, behind: bool) -> None:
        """Whether the aircraft flies on behind something that is looked at: its rotor turns, its words make room."""
        self.scene.set_behind(behind)
        self._page.spin(behind)
        if not behind:
            self.play(self._page.playing)

    def look(self, view: View) -> None:
        """Aim the camera. Near the blade, airframe and words make room; labels on the disk turn in the next update."""
        self._look = view
        self.scene.set_close(view == "blade")
        self.camera.aim(view)

    @property
    def scale(self) -> tuple[Field, Range] | None:
        """The quantity on the disk of the scene and the ends of its colours; None where no such disk is in sight."""
        drawn = self._drawn
        if drawn is None or self.scene.behind:
            return None
        return shown_field(drawn.view, drawn.pinned), drawn.colour_range

    def held_range(self, field: Field) -> Range:
        """The colour range a field has on the page."""
        return self._ranges.get(field.title, (field.low, field.high))

    def order_range(self, order: str) -> None:
        """Fit the colour range to all values ("Rescale") or leave it to the page ("Default"), in the next update."""
        self._order = order

    def _range(self, solution: Solution, field: Field) -> Range:
        """The field's usual range, or the one fitted to all values on request; that of B − A when it is first shown."""
        order, self._order = self._order, None
        if order == "Rescale":
            self._ranges[field.title] = fitted_range(field, field_values(solution, field))
            self._chosen.add(field.title)
        elif order == "Default":
            self._ranges.pop(field.title, None)
            self._chosen.discard(field.title)
        if field.title in self._chosen or (field.note and field.title in self._ranges):
            return self._ranges[field.title]
        usual = usual_range(field, solution.design.rotor)
        self._ranges[field.title] = (
            fitted_range(field, field_values(solution, field), trim=CLIPPED_SHARE)
            if field.note
            else usual
        )
        return self._ranges[field.title]
