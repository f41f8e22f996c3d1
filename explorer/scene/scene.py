"""The 3D scene of one client: handles made once, assigned afterwards, never made anew, whatever rotor comes.

Blades lie here without twist and the disk without colours: the page shapes and colours them (`explorer/web/disk.js`).
A file without that script has them as vertices and as a PNG: `RotorNodes.record`.
"""

import math

import numpy as np
import viser

from explorer.colours import Rgb, SceneTheme
from explorer.hosting import viser_compat
from explorer.model.inputs import ViewState
from explorer.picture import disk_image
from explorer.picture.airframe import airframe, mast, rotor_head, size
from explorer.picture.blade_mesh import BladeForm, Faces, Mesh, blade_shape, joined_meshes, straight
from explorer.picture.picture import Blades, Picture, Pose, axis_rotation
from rotor import Design, Rotor
from rotor.design.aircraft import TailRotor

ROTOR, COMPARED = "/rotor", "/compared"
"""Names of the rotor of the sliders and of the one that it is compared with."""
_FLAT = (0.0, math.sqrt(0.5), math.sqrt(0.5), 0.0)
"""Half a turn about the bisector of x and y: a picture's columns run to starboard, its rows aft."""
_BELOW_DISK = -0.06
"""Height of the words about the disk [m]."""
_BELOW_GROUND = 0.3
"""How far the shadow lies below the wheels [m], so that it is not cut when the nose goes down."""


class RotorNodes:
    """Blades, head, disk and the words about it, under one frame."""

    def __init__(self, api: viser.SceneApi, name: str, rotor: Rotor, theme: SceneTheme) -> None:
        self._api, self._name, self._theme = api, name, theme
        self._fitted: Rotor | None = None
        self._sides: disk_image.Sides = ("", "", "", "")
        self.frame = api.add_frame(name, show_axes=False)
        self._head = add_solid(api, f"{name}/head", mast(1.0), theme.head)
        self._blades: list[viser.MeshHandle] = []
        """Meshes for the rotor with most blades so far; those beyond this rotor's are hidden."""
        self._disk = api.add_frame(f"{name}/disk", show_axes=False)
        self.words = picture_plane(api, f"{name}/disk/words", (0.0, 0.0, _BELOW_DISK))
        self.image = picture_plane(api, f"{name}/disk/field", (0.0, 0.0, 0.0))
        self.set_theme(theme)
        self.fit(rotor)

    @property
    def reference_blade(self) -> viser.MeshHandle:
        """The red one, which can be grabbed."""
        return self._blades[0]

    def fit(self, rotor: Rotor) -> None:
        """Make room for a rotor: blades, head, disk and words; nothing when it is the one that is shown."""
        if rotor == self._fitted:
            return
        self._fitted, radius = rotor, rotor.radius
        set_mesh(self._head, joined_meshes([rotor_head(rotor), mast(radius)]))
        start = straight(rotor)
        for blade in self._blades:
            set_mesh(blade, start)
        for k in range(len(self._blades), rotor.blades):
            colour = self._theme.blade if k else self._theme.reference_blade
            blade = add_solid(self._api, f"{self._name}/blade_{k}", start, colour)
            self._blades.append(blade)
            psi = math.radians(ViewState.azimuth_deg) + k * 2.0 * math.pi / rotor.blades
            hinge = rotor.blade.flap_hinge * radius * np.array([math.cos(psi), math.sin(psi), 0.0])
            place_node(blade, Pose(axis_rotation(2, psi), hinge))  # Replaced at the first solution.
        for k, handle in enumerate(self._blades):
            handle.visible = k < rotor.blades
        self.words.render_width = self.words.render_height = 2.0 * disk_image.REACH * radius
        self.image.render_width = self.image.render_height = 2.0 * disk_image.half_width(radius)

    def show(self, picture: Picture, still: bool = True) -> None:
        """Move everything; `still`: False while the page itself moves the blades."""
        viser_compat.set_pose(self.frame, picture.rotor.wxyz)
        place_node(self._disk, picture.disk)
        if still:
            self.turn(picture.blades)

    def turn(self, blades: Blades) -> None:
        viser_compat.set_pose(self._head, axis_rotation(2, blades.azimuth))
        for handle, pose in zip(self._blades, blades.poses, strict=False):
            place_node(handle, pose)

    def forms(self, blades: Blades) -> dict[str, BladeForm]:
        """The form of each blade by the name of its node."""
        count = len(blades.poses)
        forms = blades.forms * count if len(blades.forms) == 1 else blades.forms
        return {handle.name: form for handle, form in zip(self._blades, forms, strict=False)}

    def record(self, rotor: Rotor, blades: Blades, png: bytes, pixels: int) -> None:
        """Shape the blades and colour the disk for a file: a picture of so many `pixels` along each edge."""
        shape, forms = blade_shape(rotor), self.forms(blades)
        for handle in self._blades[: rotor.blades]:
            handle.vertices = forms[handle.name].vertices(shape).astype(np.float32)
        viser_compat.set_png(self.image, png)
        self.image.render_width = self.image.render_height = 2.0 * disk_image.half_width(
            rotor.radius, pixels
        )

    def set_theme(self, theme: SceneTheme) -> None:
        self._theme = theme
        self._head.color = theme.head
        for k, blade in enumerate(self._blades):
            blade.color = theme.blade if k else theme.reference_blade
        self._write()

    def name_sides(self, sides: disk_image.Sides) -> None:
        """Write about the disk what lies at ψ = 0°, 90°, 180° and 270°."""
        if sides != self._sides:
            self._sides = sides
            self._write()

    def _write(self) -> None:
        mask = disk_image.ring_mask(self._sides)
        viser_compat.set_png(self.words, disk_image.tinted_png(mask, self._theme.lettering))


class Scene:
    """The rotor of the sliders, its airframe and shadow, the lights, and at times a second rotor at its place."""

    def __init__(self, api: viser.SceneApi, rotor: Rotor, theme: SceneTheme) -> None:
        self._api, self._theme = api, theme
        self._close = False
        self._fitted: tuple[Rotor, TailRotor | None] = rotor, None
        self.behind = False
        """Whether the aircraft flies far behind something else: then the coloured disk is not in sight."""
        api.set_up_direction("+z")
        api.configure_default_lights(enabled=False)
        self._lights = [
            api.add_light_directional(
                f"/light/{k}",
                color=light.colour,
                intensity=light.intensity,
                position=light.position,
            )
            for k, light in enumerate(theme.lights)
        ]
        self._sky = api.add_light_hemisphere(
            "/light/sky", ground_color=(150, 160, 180), intensity=theme.sky
        )
        self._shadow = picture_plane(api, "/shadow", (0.0, 0.0, 0.0))
        self._airframe = api.add_frame("/airframe", show_axes=False)
        craft = airframe(rotor)
        self._body = add_solid(api, "/airframe/body", craft.body, theme.body)
        self._glass = add_solid(api, "/airframe/glass", craft.glass, theme.glass)
        self._dark_parts = add_solid(api, "/airframe/dark", craft.dark, theme.dark_parts)
        self.rotor = RotorNodes(api, ROTOR, rotor, theme)
        self._compared: RotorNodes | None = None
        self._comparing = self._alone = False
        self._light_up()
        self._fit_airframe()

    def fit(self, design: Design) -> None:
        """Make room for a design; a rotor tested alone has no airframe."""
        rotor, alone = design.rotor, design.condition.stand is not None
        if (fitted := (rotor, design.tail_rotor)) != self._fitted:
            self._fitted = fitted
            self._fit_airframe()
        self.rotor.fit(rotor)
        self.rotor.name_sides(disk_image.sides(design))
        if alone != self._alone:
            self._alone = alone
            self._set_visible()

    def show(self, picture: Picture, still: bool = True) -> None:
        """Assign one frame; call it inside `client.atomic()` so that the page draws it whole."""
        self.rotor.show(picture, still)
        place_node(self._airframe, picture.airframe)

    def show_compared(self, design: Design, picture: Picture) -> RotorNodes:
        """A second rotor at the place of the first: the page draws it left of a handle and the first right of it."""
        if self._compared is None:
            self._compared = RotorNodes(self._api, COMPARED, design.rotor, self._theme)
        self._compared.fit(design.rotor)
        self._compared.name_sides(disk_image.sides(design))
        self._compared.show(picture)
        self._comparing = True
        self._set_visible()
        return self._compared

    def hide_compared(self) -> None:
        if self._comparing:
            self._comparing = False
            self._set_visible()

    def set_behind(self, behind: bool) -> None:
        """Whether the aircraft flies far behind something else: shadow, words and colours of the disk make room."""
        self.behind = behind
        self._set_visible()

    def set_close(self, close: bool) -> None:
        """Whether one blade is looked at from near: airframe, shadow and words make room."""
        self._close = close
        self._set_visible()

    def set_theme(self, theme: SceneTheme) -> None:
        """Colours and lights for a light page or a dark one."""
        if theme is self._theme:
            return
        self._theme = theme
        for handle, colour in (
            (self._body, theme.body),
            (self._glass, theme.glass),
            (self._dark_parts, theme.dark_parts),
        ):
            handle.color = colour
        for handle, light in zip(self._lights, theme.lights, strict=True):
            handle.intensity = light.intensity
        self._sky.intensity = theme.sky
        self._light_up()
        self.rotor.set_theme(theme)
        if self._compared is not None:
            self._compared.set_theme(theme)
        self._draw_shadow()

    def _light_up(self) -> None:
        self._api.configure_environment_map("studio", environment_intensity=self._theme.environment)

    def _fit_airframe(self) -> None:
        craft, radius = airframe(*self._fitted), self._fitted[0].radius
        for handle, mesh in (
            (self._body, craft.body),
            (self._glass, craft.glass),
            (self._dark_parts, craft.dark),
        ):
            set_mesh(handle, mesh)
        half = disk_image.SHADOW_HALF * radius
        self._shadow.render_width = self._shadow.render_height = 2.0 * half
        self._shadow.position = (
            disk_image.SHADOW_CENTRE * radius,
            0.0,
            craft.ground - _BELOW_GROUND * size(radius),
        )
        self._draw_shadow()

    def _draw_shadow(self) -> None:
        mask = disk_image.shadow_mask(airframe(*self._fitted), self._fitted[0].radius)
        viser_compat.set_png(
            self._shadow,
            disk_image.tinted_png(mask, self._theme.shadow, self._theme.shadow_strength),
        )

    def _set_visible(self) -> None:
        self.rotor.words.visible = not (self._close or self.behind)
        self.rotor.image.visible = not self.behind
        self._airframe.visible = not (self._close or self._alone)
        self._shadow.visible = self._airframe.visible and not self.behind
        if self._compared is not None:
            self._compared.frame.visible = self._comparing
            self._compared.words.visible = not self._close


def add_solid(api: viser.SceneApi, name: str, mesh: Mesh, colour: Rgb) -> viser.MeshHandle:
    """A closed surface: only its front is drawn, which costs the page half."""
    vertices = mesh.vertices.astype(np.float32)
    return api.add_mesh_simple(
        name,
        vertices,
        mesh.faces,
        color=colour,
        side="front",
        cast_shadow=False,
        receive_shadow=False,
    )


def set_mesh(handle: viser.MeshHandle, mesh: Mesh) -> None:
    """Another shape. Never faces without their vertices: of two sizes, the page must not draw a mixture."""
    faces: Faces = mesh.faces
    handle.vertices = mesh.vertices.astype(np.float32)
    if not np.array_equal(handle.faces, faces):
        handle.faces = faces


def picture_plane(
    api: viser.SceneApi, name: str, position: tuple[float, float, float]
) -> viser.ImageHandle:
    """A flat picture, nose up; its size and content are assigned later."""
    nothing = np.zeros((2, 2, 4), dtype=np.uint8)
    return api.add_image(
        name,
        nothing,
        1.0,
        1.0,
        format="png",
        wxyz=_FLAT,
        position=position,
        cast_shadow=False,
        receive_shadow=False,
    )


def place_node(handle: viser.SceneNodeHandle, pose: Pose) -> None:
    viser_compat.set_pose(handle, pose.wxyz, pose.position)
