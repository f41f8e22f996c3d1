"""The cut blade in the 3D scene of one client: handles made when first needed, assigned afterwards."""

import numpy as np
import viser

from explorer.tabs.actuator import picture as actuator_picture
from explorer.tabs.actuator.picture import CutPicture

_NOTHING = np.zeros((1, 2, 3), dtype=np.float32)


class CutScene:
    """Under its own frame, which is seen or not."""

    def __init__(self, api: viser.SceneApi) -> None:
        self._api = api
        self._frame = api.add_frame("/cut", show_axes=False, visible=False)
        self._solids: list[viser.MeshHandle] = []
        self._labels: list[viser.LabelHandle] = []
        self._ghost = self._line("ghost", actuator_picture.GHOST, 1.6)
        self._leads = self._line("leads", actuator_picture.LEAD, 2.4)

    def show(self, picture: CutPicture) -> None:
        """Assign one frame; call it inside `client.atomic()`."""
        self._frame.visible = True
        for k, (mesh, colour) in enumerate(picture.solids):
            vertices = mesh.vertices.astype(np.float32)
            if k == len(self._solids):
                self._solids.append(
                    self._api.add_mesh_simple(
                        f"/cut/part_{k}", vertices, mesh.faces, color=colour, side="double",
                        cast_shadow=False, receive_shadow=False,
                    )
                )  # fmt: skip
                continue
            handle = self._solids[k]
            if not np.array_equal(handle.faces, mesh.faces):
                # Never faces without their vertices: of two sizes, the page must not draw a mixture.
                handle.visible = False
                handle.vertices, handle.faces = vertices, mesh.faces
            handle.vertices, handle.color, handle.visible = vertices, colour, True
        for handle in self._solids[len(picture.solids) :]:
            handle.visible = False
        for handle, segments in ((self._ghost, picture.ghost), (self._leads, picture.leads)):
            handle.visible = len(segments) > 0
            if len(segments):
                handle.points = segments.astype(np.float32)
        for k, (text, position) in enumerate(picture.labels):
            if k == len(self._labels):
                self._labels.append(self._api.add_label(f"/cut/label_{k}", text, anchor="bottom-center"))
            label = self._labels[k]
            label.text, label.position, label.visible = text, position, True
        for label in self._labels[len(picture.labels) :]:
            label.visible = False

    def hide(self) -> None:
        self._frame.visible = False

    def _line(self, name: str, colour: tuple[int, int, int], pixels: float) -> viser.LineSegmentsHandle:
        return self._api.add_line_segments(
            f"/cut/{name}", _NOTHING, colour, thickness=pixels, thickness_units="screen", visible=False
        )
