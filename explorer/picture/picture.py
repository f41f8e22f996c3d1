"""Solution and view → one picture as arrays: everything the scene assigns in a frame."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from explorer.picture import disk_image
from explorer.picture.fields import FIELDS, Field
from explorer.picture.meshes import blade_shape, blade_vertices, size
from explorer.picture.moving_blades import blade_twists
from explorer.picture.outlines import drag_divergence_segments, reverse_flow_segments, stall_segments
from explorer.picture.png import encode_png
from explorer.picture.polar import polar_grid
from explorer.picture.poses import Pose, blade_pose, rotor_pose, tip_path_pose
from explorer.state import ViewState
from explorer.text.units import UNITS
from explorer.theme import colours
from rotor.arrays import Array
from rotor.design.blade import Rotor
from rotor.trim.solution import Solution

DISK_DROP = 0.35
"""How far the coloured disk lies below the hub [m], so that blades are seen on it; of the UH-60A's size."""
LINE_LIFT = 0.02
"""How far lines lie above the disk [m]."""

OUTLINE_COLOURS = {
    "reverse_flow": (colours.REVERSE_FLOW, colours.CASING_DARK),
    "stall": (colours.STALL, colours.CASING_LIGHT),
    "drag_divergence": (colours.DRAG_DIVERGENCE, colours.CASING_LIGHT),
}
"""Line and casing, by the name of the toggle in `ViewState`."""


@dataclass(frozen=True, eq=False)
class Blades:
    """Where the blades are; all that changes while the rotor turns."""

    poses: tuple[Pose, ...]
    """The marked blade first."""
    shapes: tuple[Array, ...]
    """Vertices blade by blade where twist follows the azimuth; empty when all are alike."""


@dataclass(frozen=True, eq=False)
class Picture:
    """What one frame shows."""

    rotor: Pose
    disk: Pose
    blades: Blades
    blade_vertices: Array
    """Shape (n, 3); the same for every blade, unless `blades` says otherwise."""
    blade_faces: NDArray[np.uint32]
    """Shape (m, 3); changes only with the rotor."""
    png: bytes
    outlines: dict[str, Array]
    """Segments in the disk plane [m], shape (n, 2, 3), by toggle; empty when off."""
    flight_label: str
    """Empty in hover."""


def disk_drop(rotor: Rotor) -> float:
    """How far the coloured disk lies below the hub of this rotor [m]."""
    return DISK_DROP * size(rotor.radius)


def turned_blades(solution: Solution, view: ViewState) -> Blades:
    """The blades with the marked one at the view's azimuth."""
    rotor = solution.design.rotor
    first, step = math.radians(view.azimuth_deg), 2.0 * math.pi / rotor.blades
    azimuths = tuple(first + k * step for k in range(rotor.blades))
    hinge = rotor.blade.flap_hinge * rotor.radius
    twists = blade_twists(solution.design, azimuths)
    return Blades(
        poses=tuple(blade_pose(solution.controls, psi, hinge) for psi in azimuths),
        shapes=tuple(blade_vertices(blade_shape(rotor), twist, view.exaggeration) for twist in twists),
    )


def make_picture(
    solution: Solution, view: ViewState, colour_range: tuple[float, float], field: Field | None = None
) -> Picture:
    """The frame for a converged solution. `field`: on the disk, where it is not just that of the view."""
    rotor, controls = solution.design.rotor, solution.controls
    speed = solution.design.airspeed
    shape = blade_shape(rotor)
    return Picture(
        rotor=rotor_pose(controls),
        disk=tip_path_pose(controls, disk_drop(rotor)),
        blades=turned_blades(solution, view),
        blade_vertices=blade_vertices(shape, solution.design.twist, view.exaggeration),
        blade_faces=shape.faces,
        png=disk_png(solution, field or FIELDS[view.field], colour_range),
        outlines=_outlines(solution, view),
        flight_label=UNITS[view.units].speed[0].text(speed) if speed > 0.0 else "",
    )


def disk_png(
    solution: Solution,
    field: Field,
    colour_range: tuple[float, float],
    faded: bool = False,
    size: int = disk_image.SIZE,
) -> bytes:
    """The coloured disk as a PNG of `size` pixels along each edge, at most `disk_image.LARGEST`."""
    size = min(size, disk_image.LARGEST)
    fineness = size / disk_image.SIZE
    grid = polar_grid(solution.disk, round(fineness * disk_image.RADII), round(fineness * disk_image.AZIMUTHS))
    pixels = disk_image.indices(grid, field.sample(solution, grid), *colour_range, field.void(solution, grid), size)
    return encode_png(pixels, disk_image.palette(field.colours, faded))


def field_values(solution: Solution, field: Field) -> Array:
    """All values of a field that the disk shows, to fit a range to."""
    grid = polar_grid(solution.disk, 80, 240)
    values, void = field.sample(solution, grid), field.void(solution, grid)
    return values.ravel() if void is None else values[~void]


def _outlines(solution: Solution, view: ViewState) -> dict[str, Array]:
    sources = {
        "reverse_flow": reverse_flow_segments,
        "stall": stall_segments,
        "drag_divergence": drag_divergence_segments,
    }
    return {
        name: _in_space(source(solution) if getattr(view, name) else np.zeros((0, 2, 2)), solution.design.rotor.radius)
        for name, source in sources.items()
    }


def _in_space(segments: Array, radius: float) -> Array:
    lifted = np.full((*segments.shape[:2], 1), LINE_LIFT)
    return np.concatenate((radius * segments, lifted), axis=2)
