"""Solution and view → where blades, disk and airframe stand, and the disk as a PNG for files.

Where things stand are poses from the trim, quaternions (w, x, y, z) and positions; each blade has its own twist.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from explorer.colours import DiskInk, scene_theme
from explorer.model.inputs import ViewState
from explorer.picture import disk_image
from explorer.picture.airframe import SHAFT_FORWARD, size
from explorer.picture.blade_mesh import BladeForm, blade_shape
from explorer.picture.disk_image import encode_png
from explorer.picture.disk_numbers import disk_numbers
from explorer.picture.fields import FIELDS, Field
from explorer.picture.polar import (
    ALL_MARKS,
    NO_MARKS,
    DrawnSolution,
    RegionMarks,
    polar_grid,
    region_codes,
)
from rotor import Design, Rotor, Solution, TrimState, make_design, solve
from rotor.design import REFERENCE_RADIUS, ActiveTwist, TwistLaw
from rotor.support.arrays import Array

BENDING_SHOWN = 10.0
"""Times its bending that a blade is drawn with."""


@dataclass(frozen=True, eq=False)
class Pose:
    """Pose of a child in its parent: a unit quaternion (4,) and a position [m], (3,)."""

    wxyz: Array
    position: Array


def axis_rotation(axis: int, angle: float) -> Array:
    """The rotation by `angle` [rad] about axis 0, 1 or 2."""
    quaternion = np.zeros(4)
    quaternion[0] = math.cos(angle / 2.0)
    quaternion[1 + axis] = math.sin(angle / 2.0)
    return quaternion


def composed_rotation(*rotations: Array) -> Array:
    """The product of quaternions; the last is applied first."""
    w, x, y, z = 1.0, 0.0, 0.0, 0.0
    for rotation in rotations:  # In plain numbers: for four of them arrays take five times as long.
        a, b, c, d = rotation.tolist()
        w, x, y, z = (
            w * a - x * b - y * c - z * d,
            w * b + x * a + y * d - z * c,
            w * c - x * d + y * a + z * b,
            w * d + x * c - y * b + z * a,
        )
    return np.array([w, x, y, z])


def rotate(wxyz: Array, points: Array) -> Array:
    """`points`, shape (..., 3), turned by a quaternion."""
    w, v = wxyz[0], wxyz[1:]
    turned = 2.0 * np.cross(v, np.cross(v, points) + w * points)
    return np.asarray(points + turned, dtype=np.float64)


def rotor_pose(controls: TrimState) -> Pose:
    """The shaft, tilted forward by α (x is aft, so nose-down is a turn about −y)."""
    return Pose(axis_rotation(1, -controls.shaft_tilt), np.zeros(3))


def pitch_series(controls: TrimState, design: Design | None = None) -> list[float]:
    """Root pitch [rad] in harmonics 1, cos ψ, sin ψ, cos 2ψ, …: collective, cyclic and n/rev of the design."""
    series = [controls.collective, controls.cyclic_1c, controls.cyclic_1s]
    given = () if design is None or design.hovering else design.pitch_per_rev
    for n in range(2, max((harmonic.per_rev for harmonic in given), default=1) + 1):
        size, phase = next(
            ((wave.amplitude, wave.phase) for wave in given if wave.per_rev == n), (0.0, 0.0)
        )
        series += [size * math.cos(phase), size * math.sin(phase)]
    return series


def root_pitch(controls: TrimState, psi: float, design: Design | None = None) -> float:
    """Root pitch of a blade at ψ [rad]."""
    mean, *waves = pitch_series(controls, design)
    orders = enumerate(zip(waves[::2], waves[1::2], strict=True), start=1)
    return mean + sum(
        cosine * math.cos(n * psi) + sine * math.sin(n * psi) for n, (cosine, sine) in orders
    )


def blade_pose(controls: TrimState, psi: float, hinge: float, design: Design | None = None) -> Pose:
    """A blade at azimuth ψ [rad] in the shaft frame: flapped about its hinge at `hinge` [m], then pitched.

    The twist is in the blade's own shape, so the pitch here is θ0 + θ1c cos ψ + θ1s sin ψ, and n/rev of a `design`.
    """
    cos, sin = math.cos(psi), math.sin(psi)
    flap = controls.coning + controls.flap_1c * cos + controls.flap_1s * sin
    pitch = root_pitch(controls, psi, design)
    turned = composed_rotation(
        axis_rotation(2, psi), axis_rotation(1, -flap), axis_rotation(0, pitch)
    )
    return Pose(turned, hinge * np.array([cos, sin, 0.0]))


def tip_path_pose(controls: TrimState, drop: float) -> Pose:
    """The plane the blade tips run in, `drop` [m] below the hub so that blades are seen above it.

    z = β1c x + β1s y to first order: turned by −β1c about y and by β1s about x.
    """
    tilt = composed_rotation(
        axis_rotation(1, -controls.flap_1c), axis_rotation(0, controls.flap_1s)
    )
    return Pose(tilt, rotate(tilt, np.array([0.0, 0.0, -drop])))


@dataclass(frozen=True)
class TwistAt:
    """A law with active and elastic twist of one azimuth on top; not zero at 0.75 R."""

    law: TwistLaw
    active: ActiveTwist | None
    psi: float
    """[rad], of the active twist."""
    stations: tuple[float, ...] = (0.0, 1.0)
    """r/R of the elastic twist, ascending; constant beyond."""
    elastic: tuple[float, ...] = (0.0, 0.0)
    """[rad]"""

    def __call__(self, r: ArrayLike) -> Array:
        at = np.atleast_1d(np.asarray(r, dtype=float))
        twist: Array = self.law(at) + np.interp(at, self.stations, self.elastic)
        return twist if self.active is None else twist + self.active(at, np.array([self.psi]))[:, 0]

    def spec(self) -> str:
        return self.law.spec()


def with_active_twist(design: Design, psi: float) -> TwistLaw:
    """Jig twist and active twist of a blade at ψ [rad]."""
    active = None if design.hovering else design.active_twist
    return design.twist if active is None else TwistAt(design.twist, active, psi)


def flown_twist(solution: Solution, psi: float) -> TwistLaw:
    """The twist of a blade in flight at ψ [rad]: jig twist, active twist and elastic twist."""
    return with_elastic_twist(with_active_twist(solution.design, psi), solution, psi)


def with_elastic_twist(law: TwistLaw, solution: Solution, psi: float) -> TwistLaw:
    """A law with the elastic twist of this solution at ψ [rad]; the law itself for a rigid blade."""
    disk = solution.disk
    if disk.elastic_twist is None:
        return law
    elastic = tuple(at_azimuth(solution, disk.elastic_twist, psi).tolist())
    return TwistAt(law, None, psi, tuple(disk.r.tolist()), elastic)


def at_azimuth(solution: Solution, values: Array, psi: float) -> Array:
    """Values (elements, azimuths) at ψ [rad], linear between two azimuths, periodic; (elements,)."""
    n = values.shape[1]
    position = (psi - float(solution.disk.psi[0])) * n / (2.0 * math.pi)
    base = math.floor(position)
    weight = position - base
    return (1.0 - weight) * values[:, base % n] + weight * values[:, (base + 1) % n]


def overlay_twist(solution: Solution, other: TwistLaw, psi: float) -> TwistLaw | None:
    """The twist of the overlay of a blade whose jig twist is `other`, at ψ [rad]; None: there is nothing to compare.

    It has the elastic twist of this solution, so that only the change of jig twist tells the two apart. A blade with
    the same jig twist leaves the overlay to the jig shape of this one.
    """
    jig = solution.design.twist
    if other != jig:
        return with_elastic_twist(other, solution, psi)
    return None if solution.disk.elastic_twist is None else jig


def follows_azimuth(solution: Solution) -> bool:
    """Whether the shape of a blade in flight changes on its way around the disk."""
    design, disk = solution.design, solution.disk
    changes = (
        design.active_twist is not None
        or disk.elastic_twist is not None
        or solution.deflections is not None
    )
    return not design.hovering and changes


def drawn_bending(solution: Solution, r: ArrayLike, psi: float) -> Array | None:
    """How far the axis of a blade at ψ [rad] is drawn off the straight one at r/R, `BENDING_SHOWN` times as far as it
    bends, in the blade's own axes [m], (stations, 3); None where blades do not bend."""
    bent = solution.deflections
    if bent is None:
        return None
    up, forward = (
        BENDING_SHOWN * deflection for deflection in bent.at(np.asarray(r, dtype=float), psi)
    )
    pitch = root_pitch(solution.controls, psi, solution.design)  # The blade's own axes are pitched.
    cos, sin = math.cos(pitch), math.sin(pitch)
    return np.stack([np.zeros_like(up), cos * forward + sin * up, cos * up - sin * forward], axis=1)


DISK_DROP = 0.30
"""How far the coloured disk lies below the hub [m], so that blades are seen on it; of the UH-60A's size."""
LINE_LIFT = 0.02
"""How far lines lie above the disk [m]."""
_LEAST_U_T = 0.2
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
    forms: tuple[BladeForm, ...]
    """Blade by blade where twist follows the azimuth; else one for all."""


@dataclass(frozen=True, eq=False)
class Picture:
    rotor: Pose
    airframe: Pose
    disk: Pose
    blades: Blades


def warm() -> None:
    """Compile and load everything that the first picture would wait for: fields are sampled in either precision."""
    solution = solve(make_design(mu=0.2))
    for field in (FIELDS["Angle of attack"], FIELDS["Mach number"]):
        disk_numbers(solution, field, (field.low, field.high), ALL_MARKS)
    field = FIELDS["Mach number"]
    page_disk_png(solution, field, (field.low, field.high), ViewState(), disk_image.SIZE)


def disk_drop(rotor: Rotor) -> float:
    """How far the coloured disk lies below the hub of this rotor [m]."""
    return DISK_DROP * size(rotor.radius)


def turned_blades(
    solution: Solution, view: ViewState, each: bool = True, bent: bool = True
) -> Blades:
    """The blades with the reference blade at the view's azimuth; `each`: with a form for each, where they differ.

    `bent`: whether bending is drawn."""
    rotor = solution.design.rotor
    first, step = math.radians(view.azimuth_deg), 2.0 * math.pi / rotor.blades
    azimuths = tuple(first + k * step for k in range(rotor.blades))
    hinge = rotor.blade.flap_hinge * rotor.radius
    differ = each and follows_azimuth(solution)
    return Blades(
        azimuth=first,
        poses=tuple(blade_pose(solution.controls, psi, hinge, solution.design) for psi in azimuths),
        forms=tuple(
            flown_form(solution, view, psi, bent) for psi in (azimuths if differ else azimuths[:1])
        ),
    )


_MOST_TURNED = math.radians(60.0)
"""A section may be drawn turned against that at 0.75 R."""


def drawn_times(design: Design, view: ViewState) -> float:
    """How many times its twist a blade is drawn with: what the view asks for, or less, to 0.1, where a section of the
    built-in twist would turn by more than `_MOST_TURNED`."""
    r = np.linspace(design.rotor.blade.root_cutout, 1.0, 25)
    most = float(np.abs(design.twist(r) - design.twist([REFERENCE_RADIUS])).max())
    return min(
        view.exaggeration, max(1.0, math.floor(10.0 * _MOST_TURNED / max(most, 1e-9)) / 10.0)
    )


def flown_form(solution: Solution, view: ViewState, psi: float, bent: bool = True) -> BladeForm:
    """A blade in flight at ψ [rad]: its twist, and where `bent` its bending, enlarged."""
    shape = blade_shape(solution.design.rotor)
    bending = drawn_bending(solution, shape.r, psi) if bent else None
    return BladeForm(
        shape.pitch(flown_twist(solution, psi), drawn_times(solution.design, view)), bending
    )


def make_picture(
    solution: Solution, view: ViewState, each: bool = True, bent: bool = True
) -> Picture:
    """The frame for a converged solution; `each` and `bent` as for `turned_blades`."""
    controls = solution.controls
    return Picture(
        rotor=rotor_pose(controls),
        # In level flight: nose down by what the shaft tilt is more than its lean in the airframe.
        airframe=Pose(axis_rotation(1, SHAFT_FORWARD - controls.shaft_tilt), np.zeros(3)),
        disk=tip_path_pose(controls, disk_drop(solution.design.rotor)),
        blades=turned_blades(solution, view, each, bent),
    )


def marks_of(view: ViewState) -> RegionMarks:
    return RegionMarks(view.stall, view.past_static, view.reverse_flow, view.drag_divergence)


def page_disk_png(
    solution: Solution,
    field: Field,
    colour_range: tuple[float, float],
    view: ViewState,
    pixels: int,
) -> bytes:
    """The disk as the scene shows it: marked regions, in the ink of the page."""
    return disk_png(
        solution,
        field,
        colour_range,
        size=pixels,
        marks=marks_of(view),
        ink=scene_theme(view.dark).ink,
    )


def disk_png(
    solution: Solution,
    field: Field,
    colour_range: tuple[float, float],
    size: int = disk_image.SIZE,
    marks: RegionMarks = NO_MARKS,
    ink: DiskInk | None = None,
) -> bytes:
    """The coloured disk as a PNG of `size` pixels along each edge, at most `disk_image.LARGEST`.

    `marks`: regions drawn into it.
    """
    size = min(size, disk_image.LARGEST)
    grid = polar_grid(solution.disk, *disk_image.grid_size(size))
    half_width = _LINE_PIXELS * 2.0 / max(size, 640)
    drawn = DrawnSolution(solution)
    regions = region_codes(drawn, grid, marks, half_width)
    void = field.void(drawn, grid)
    pixels = disk_image.indices(grid, field.sample(drawn, grid), *colour_range, void, size, regions)
    return encode_png(pixels, disk_image.palette(field.colours, ink))


def field_values(solution: Solution, field: Field) -> Array:
    """Values of a field that the disk shows, each for an equal area, to fit a range to.

    A field without meaning in reverse flow is left out beside it too: angles run away where there is no flow.
    """
    grid = polar_grid(solution.disk, 80, 240)
    # Rows at equal steps of r², since the area of a ring goes with r².
    r = np.sqrt(np.linspace(grid.r[0] ** 2, grid.r[-1] ** 2, 2 * len(grid.r)))
    rows = np.rint(np.interp(r, grid.r, np.arange(len(grid.r)))).astype(int)
    drawn = DrawnSolution(solution)
    values, void = field.sample(drawn, grid)[rows], field.void(drawn, grid)
    if void is None:
        return values.ravel()
    beside = void | (drawn.flow(grid).u_t < _LEAST_U_T) if field.void_in_reverse_flow else void
    return values[~beside[rows]]
