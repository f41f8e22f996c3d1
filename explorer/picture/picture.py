"""Solution and view → one picture as arrays: everything the scene assigns in a frame."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from explorer.model.inputs import ViewState
from explorer.picture import disk_image
from explorer.picture.airframe import size
from explorer.picture.blade_mesh import blade_shape, blade_vertices
from explorer.picture.disk_image import encode_png
from explorer.picture.fields import FIELDS, Field
from explorer.picture.polar import polar_grid, refined
from explorer.picture.poses import (
    Pose,
    airframe_pose,
    blade_pose,
    drawn_bending,
    flown_twist,
    follows_azimuth,
    rotor_pose,
    tip_path_pose,
)
from explorer.picture.regions import NO_MARKS, Marks, region_codes
from explorer.picture.scene_theme import DiskInk, scene_theme
from rotor import Rotor, Solution, make_design, solve
from rotor.arrays import Array

DISK_DROP = 0.30
"""How far the coloured disk lies below the hub [m], so that blades are seen on it; of the UH-60A's size."""
LINE_LIFT = 0.02
"""How far lines lie above the disk [m]."""
_SLOW = 0.2
"""U_T/ΩR below which a field without meaning in reverse flow does not count for its range."""
_LINE_PIXELS = 1.4
"""Half the width of the lines on the disk, in pixels of its picture at rest."""


@dataclass(frozen=True, eq=False)
class Blades:
    """Where the blades are; all that changes while the rotor turns."""

    azimuth: float
    """ψ of the reference blade [rad]."""
    poses: tuple[Pose, ...]
    """The reference blade first."""
    shapes: tuple[Array, ...]
    """Vertices blade by blade where twist follows the azimuth; empty when all are drawn alike."""


@dataclass(frozen=True, eq=False)
class Picture:
    rotor: Pose
    airframe: Pose
    disk: Pose
    blades: Blades
    blade_vertices: Array
    """Vertices of the reference blade as flown, shape (n, 3); for every blade, unless `blades` says otherwise."""
    blade_faces: NDArray[np.uint32]
    """Shape (m, 3); changes only with the rotor."""
    png: bytes
    png_size: int
    """Pixels along each edge of `png`."""


def warm() -> None:
    """Compile and load everything that the first picture would wait for: fields are sampled in either precision."""
    solution = solve(make_design(mu=0.2))
    for field in (FIELDS["Angle of attack"], FIELDS["Mach number"]):
        page_disk_png(solution, field, (field.low, field.high), ViewState(), disk_image.MOVING)


def disk_drop(rotor: Rotor) -> float:
    """How far the coloured disk lies below the hub of this rotor [m]."""
    return DISK_DROP * size(rotor.radius)


def turned_blades(solution: Solution, view: ViewState, each: bool = True, bent: bool = True) -> Blades:
    """The blades with the reference blade at the view's azimuth; `each`: with a shape for each, where they differ.

    `bent`: whether bending is drawn."""
    rotor = solution.design.rotor
    first, step = math.radians(view.azimuth_deg), 2.0 * math.pi / rotor.blades
    azimuths = tuple(first + k * step for k in range(rotor.blades))
    hinge = rotor.blade.flap_hinge * rotor.radius
    differ = each and follows_azimuth(solution)
    return Blades(
        azimuth=first,
        poses=tuple(blade_pose(solution.controls, psi, hinge, solution.design) for psi in azimuths),
        shapes=tuple(flown_vertices(solution, view, psi, bent) for psi in azimuths if differ),
    )


def flown_vertices(solution: Solution, view: ViewState, psi: float, bent: bool = True) -> Array:
    """Vertices of a blade in flight at ψ [rad], shape (n, 3); its twist, and where `bent` its bending, enlarged."""
    shape = blade_shape(solution.design.rotor)
    bending = drawn_bending(solution, shape.r, psi) if bent else None
    return blade_vertices(shape, flown_twist(solution, psi), view.exaggeration, bending)


def make_picture(
    solution: Solution,
    view: ViewState,
    colour_range: tuple[float, float],
    field: Field | None = None,
    pixels: int = disk_image.AT_REST,
    bent: bool = True,
) -> Picture:
    """The frame for a converged solution. `field`: on the disk, where it is not just that of the view.

    `pixels`: along each edge of the disk's picture; the small one of a moving page bends the reference blade alone.
    `bent`: whether bending is drawn.
    """
    rotor, controls = solution.design.rotor, solution.controls
    shape = blade_shape(rotor)
    return Picture(
        rotor=rotor_pose(controls),
        airframe=airframe_pose(controls),
        disk=tip_path_pose(controls, disk_drop(rotor)),
        blades=turned_blades(solution, view, pixels != disk_image.MOVING, bent),
        blade_vertices=flown_vertices(solution, view, math.radians(view.azimuth_deg), bent),
        blade_faces=shape.faces,
        png=page_disk_png(solution, field or FIELDS[view.field], colour_range, view, pixels),
        png_size=pixels,
    )


def marks_of(view: ViewState) -> Marks:
    """The regions a view marks."""
    return Marks(view.stall, view.reverse_flow, view.drag_divergence)


def page_disk_png(
    solution: Solution,
    field: Field,
    colour_range: tuple[float, float],
    view: ViewState,
    pixels: int,
) -> bytes:
    """The disk as the scene shows it: marked regions, in the ink of the page."""
    ink = scene_theme(view.dark).ink
    return disk_png(solution, field, colour_range, size=pixels, marks=marks_of(view), ink=ink)


def disk_png(
    solution: Solution,
    field: Field,
    colour_range: tuple[float, float],
    faded: bool = False,
    size: int = disk_image.SIZE,
    marks: Marks = NO_MARKS,
    ink: DiskInk | None = None,
) -> bytes:
    """The coloured disk as a PNG of `size` pixels along each edge, at most `disk_image.LARGEST`.

    `marks`: regions drawn into it.
    """
    size = min(size, disk_image.LARGEST)
    grid = polar_grid(solution.disk, *disk_image.grid_size(size))
    half_width = _LINE_PIXELS * 2.0 / max(size, 640)
    regions = region_codes(solution, grid, marks, half_width)
    void = field.void(solution, grid)
    pixels = disk_image.indices(grid, field.sample(solution, grid), *colour_range, void, size, regions)
    return encode_png(pixels, disk_image.palette(field.colours, faded, ink))


def field_values(solution: Solution, field: Field) -> Array:
    """Values of a field that the disk shows, each for an equal area, to fit a range to.

    A field without meaning in reverse flow is left out beside it too: angles run away where there is no flow.
    """
    grid = polar_grid(solution.disk, 80, 240)
    # Rows at equal steps of r², which ring areas go with.
    r = np.sqrt(np.linspace(grid.r[0] ** 2, grid.r[-1] ** 2, 2 * len(grid.r)))
    rows = np.rint(np.interp(r, grid.r, np.arange(len(grid.r)))).astype(int)
    values, void = field.sample(solution, grid)[rows], field.void(solution, grid)
    if void is None:
        return values.ravel()
    beside = void | (refined(solution, grid).u_t < _SLOW) if field.void_in_reverse_flow else void
    return values[~beside[rows]]
