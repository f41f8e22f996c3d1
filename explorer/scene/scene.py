"""The 3D scene of one client: handles made once, assigned afterwards, never made anew, whatever rotor comes."""

import math

import numpy as np
import viser

from explorer.hosting import viser_compat
from explorer.picture import meshes
from explorer.picture.disk_image import half_width
from explorer.picture.picture import OUTLINE_COLOURS, Blades, Picture
from explorer.picture.poses import Pose, about
from explorer.state import ViewState
from explorer.theme import colours
from rotor.arrays import Array
from rotor.design.blade import Rotor

_DISK_TURN = (0.0, np.sqrt(0.5), np.sqrt(0.5), 0.0)
"""Half a turn about the bisector of x and y: the picture's columns run to starboard, its rows aft."""
_NOTHING = np.zeros((1, 2, 3))


class Scene:
    """Blades, hub, disk, outlines, arrows and labels of one rotor."""

    def __init__(self, api: viser.SceneApi, rotor: Rotor) -> None:
        api.set_up_direction("+z")
        api.configure_default_lights(cast_shadow=False)
        self._api = api
        self._seen = True
        self._fitted: Rotor | None = None
        self._rotor = api.add_frame("/rotor", show_axes=False)
        some = meshes.mast(1.0)
        self._hub = self._solid(api, "/rotor/hub", some, colours.HUB)
        self._mast = self._solid(api, "/rotor/mast", some, colours.HUB)
        self._blades: list[viser.MeshHandle] = []
        """Of the rotor with most blades so far; those beyond this rotor's are hidden."""
        self._disk = api.add_frame("/rotor/disk", show_axes=False)
        self._image = api.add_image(
            "/rotor/aero/disk/field",
            np.zeros((2, 2, 4), dtype=np.uint8),
            1.0,
            1.0,
            format="png",
            wxyz=_DISK_TURN,
            cast_shadow=False,
            receive_shadow=False,
        )
        self._rim = self._line(api, "/rotor/aero/disk/rim", np.zeros((1, 2, 3)), colours.RIM, 1.6)
        self._outlines: dict[str, tuple[viser.LineSegmentsHandle, ...]] = {}
        for name, (line, casing) in OUTLINE_COLOURS.items():
            self._outlines[name] = (
                self._line(api, f"/rotor/aero/disk/{name}_casing", _NOTHING, casing, 4.6),
                self._line(api, f"/rotor/aero/disk/{name}", _NOTHING, line, 2.0),
            )
        self._turning = self._solid(api, "/rotor/aero/disk/rotation", meshes.rotation_arrow(1.0), colours.RIM)
        self._azimuths = {
            degrees: api.add_label(f"/rotor/aero/disk/psi_{degrees}", f"ψ = {degrees}°", anchor="center-center")
            for degrees in (0, 90, 180, 270)
        }
        self._flight = api.add_frame("/flight", show_axes=False, visible=False)
        self._arrow = self._solid(api, "/flight/arrow", meshes.flight_arrow(1.0), colours.MARKED_BLADE)
        self._flight_label = api.add_label("/flight/label", "", anchor="center-left")
        self.fit(rotor)

    def fit(self, rotor: Rotor) -> None:
        """Make room for a rotor: its blades, hub, disk and marks; nothing when it is the one that is shown."""
        if rotor == self._fitted:
            return
        self._fitted, radius = rotor, rotor.radius
        for handle, mesh in (
            (self._hub, meshes.hub(rotor)),
            (self._mast, meshes.mast(radius)),
            (self._turning, meshes.rotation_arrow(radius)),
            (self._arrow, meshes.flight_arrow(radius)),
        ):
            handle.vertices, handle.faces = mesh.vertices.astype(np.float32), mesh.faces
        shape = meshes.blade_shape(rotor)
        start = meshes.blade_vertices(shape, rotor.builtin_twist)
        for k in range(len(self._blades), rotor.blades):
            colour = colours.BLADE if k else colours.MARKED_BLADE
            self._blades.append(self._solid(self._api, f"/rotor/blade_{k}", meshes.Mesh(start, shape.faces), colour))
            psi = math.radians(ViewState.azimuth_deg) + k * 2.0 * math.pi / rotor.blades
            hinge = rotor.blade.flap_hinge * radius * np.array([math.cos(psi), math.sin(psi), 0.0])
            _place(self._blades[k], Pose(about(2, psi), hinge))  # Until the first answer says more.
        for k, handle in enumerate(self._blades):
            handle.visible = k < rotor.blades
        self._image.render_width = self._image.render_height = 2.0 * half_width(radius)
        cutout = rotor.blade.root_cutout * radius
        rim = (meshes.circle_segments(radius), meshes.circle_segments(cutout, 60), meshes.tick_segments(radius))
        self._rim.points = np.concatenate(rim).astype(np.float32)
        for degrees, label in self._azimuths.items():
            psi = np.radians(degrees)
            label.position = 1.135 * radius * np.array([np.cos(psi), np.sin(psi), 0.0])
        self._flight_label.position = np.array([-1.27 * radius, 0.035 * radius, 0.0])

    def show(self, picture: Picture) -> None:
        """Assign one frame; call it inside `client.atomic()` so that the page draws it whole."""
        _place(self._rotor, picture.rotor)
        _place(self._disk, picture.disk)
        for handle, _ in zip(self._blades, picture.blades.poses, strict=False):
            if not np.array_equal(handle.faces, picture.blade_faces):
                handle.faces = picture.blade_faces
            if not picture.blades.shapes:
                handle.vertices = picture.blade_vertices.astype(np.float32)
        self.turn(picture.blades)
        viser_compat.set_png(self._image, picture.png)
        for name, segments in picture.outlines.items():
            for lift, handle in enumerate(self._outlines[name]):
                handle.visible = len(segments) > 0
                if len(segments):
                    handle.points = (segments + np.array([0.0, 0.0, 0.05 * lift])).astype(np.float32)
        self._flight.visible = self._seen and picture.flight_label != ""
        if picture.flight_label:
            self._flight_label.text = picture.flight_label

    def turn(self, blades: Blades) -> None:
        """Move the blades, and nothing else."""
        for handle, pose in zip(self._blades, blades.poses, strict=False):
            _place(handle, pose)
        for handle, shape in zip(self._blades, blades.shapes, strict=False):
            handle.vertices = shape.astype(np.float32)

    def set_seen(self, seen: bool) -> None:
        """Whether the rotor is in the scene, or makes room for something else."""
        self._seen = seen
        self._rotor.visible = seen
        self._flight.visible = seen and self._flight_label.text != ""

    def fade(self, png: bytes) -> None:
        """Show that the picture is no longer the answer: a grey disk, no outlines."""
        viser_compat.set_png(self._image, png)
        for handles in self._outlines.values():
            for handle in handles:
                handle.visible = False

    def _solid(self, api: viser.SceneApi, name: str, mesh: meshes.Mesh, colour: colours.Rgb) -> viser.MeshHandle:
        return api.add_mesh_simple(
            name, mesh.vertices, mesh.faces, color=colour, side="double", cast_shadow=False, receive_shadow=False
        )

    def _line(
        self, api: viser.SceneApi, name: str, segments: Array, colour: colours.Rgb, pixels: float
    ) -> viser.LineSegmentsHandle:
        return api.add_line_segments(
            name,
            segments.astype(np.float32),
            colour,
            thickness=pixels,
            thickness_units="screen",
            visible=segments is not _NOTHING,
        )


def _place(handle: viser.SceneNodeHandle, pose: Pose) -> None:
    handle.wxyz = pose.wxyz
    handle.position = pose.position
