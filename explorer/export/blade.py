"""The blade as STL for printing and CAD, and the rotor as GLB: closed surfaces in metres.

Finer than the blade on the page, with a section wherever the twist has a kink, and never exaggerated.
"""

import math
from typing import cast

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from explorer.export.provenance import PROGRAM
from explorer.picture.blade_mesh import BladeShape, Detail, blade_shape, blade_vertices
from explorer.picture.poses import Pose, blade_pose, blade_twists, rotor_pose
from explorer.picture.rotor_head import mast, rotor_head
from explorer.picture.solids import Faces
from explorer.theme import colours
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.design.twist import PiecewiseLinearTwist, SumTwist, TableTwist, TwistLaw
from rotor.trim.solution import Solution

POINTS, STATIONS = 97, 121
"""Round a section, and from root cut-out to tip: a chord is met to 0.1 mm, the file has 1.3 MB."""
_HEADER = 80
"""Bytes of free text at the head of a binary STL file."""
_Z_UP = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""From z up, as here, to y up, as in glTF."""


def blade_mesh(design: Design, psi: float | None = None) -> trimesh.Trimesh:
    """One blade, watertight [m]: x from the rotor's axis to the tip, y to the leading edge, z up.

    Pitch is zero at 0.75 R, the twist on both sides of it. `psi` [rad]: the azimuth that an active twist is taken at;
    None, or a blade without: the twist law alone.
    """
    shape, vertices = _loft(design, psi)
    return trimesh.Trimesh(vertices + np.array([_hinge(design), 0.0, 0.0]), shape.faces)


def blade_stl(design: Design, psi: float | None = None) -> bytes:
    """The blade as binary STL. The format knows no unit, so the header names it: metres."""
    body = cast(bytes, blade_mesh(design, psi).export(file_type="stl"))
    header = f"{PROGRAM}: {design.rotor.name} blade, twist {design.twist.spec()}; unit metre"
    return header.encode("ascii", "replace")[:_HEADER].ljust(_HEADER) + body[_HEADER:]


def rotor_scene(solution: Solution, azimuth_deg: float) -> trimesh.Scene:
    """Blades, hub and mast in trim, as on the page, y up; the blades share one mesh unless each is twisted apart."""
    design, controls = solution.design, solution.controls
    scene = trimesh.Scene()
    body = _Z_UP @ _matrix(rotor_pose(controls))
    for name, mesh in (("hub", rotor_head(design.rotor)), ("mast", mast(design.rotor.radius))):
        scene.add_geometry(_painted(mesh.vertices, mesh.faces, colours.HUB), name, name, transform=body)
    step = 2.0 * math.pi / design.rotor.blades
    azimuths = tuple(math.radians(azimuth_deg) + k * step for k in range(design.rotor.blades))
    active = bool(blade_twists(design, azimuths))
    for k, psi in enumerate(azimuths):
        shared = "blade" if k else "marked_blade"
        name = f"blade_{k + 1}" if active else shared
        if name not in scene.geometry:
            shape, vertices = _loft(design, psi if active else None)
            colour = colours.BLADE if k else colours.MARKED_BLADE
            scene.geometry[name] = _painted(vertices, shape.faces, colour)
        place = body @ _matrix(blade_pose(controls, psi, _hinge(design)))
        scene.graph.update(frame_to=f"blade_{k + 1}", matrix=place, geometry=name)
    return scene


def rotor_glb(solution: Solution, azimuth_deg: float) -> bytes:
    """The whole rotor as GLB: metres, y up, as the format has it."""
    return cast(bytes, rotor_scene(solution, azimuth_deg).export(file_type="glb", include_normals=True))


def kinks(law: TwistLaw) -> tuple[float, ...]:
    """Stations r/R where the slope of the law jumps."""
    match law:
        case PiecewiseLinearTwist(breaks=breaks):
            return breaks
        case TableTwist(stations=stations):
            return stations
        case SumTwist(base, change):
            return (*kinks(base), *kinks(change))
        case _:
            return ()


def _loft(design: Design, psi: float | None) -> tuple[BladeShape, Array]:
    """In the blade's own axes, from its hinge."""
    active = design.active_twist.stations if design.active_twist is not None and psi is not None else ()
    places = tuple(sorted({*kinks(design.twist), *active}))
    shape = blade_shape(design.rotor, Detail(POINTS, STATIONS, places))
    turning = blade_twists(design, (psi,)) if psi is not None else ()
    return shape, blade_vertices(shape, turning[0] if turning else design.twist)


def _hinge(design: Design) -> float:
    return design.rotor.blade.flap_hinge * design.rotor.radius


def _painted(vertices: Array, faces: Faces, colour: colours.Rgb) -> trimesh.Trimesh:
    """Vertices are kept as they are: the caps have their own, for a sharp edge."""
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    material = PBRMaterial(baseColorFactor=[*colour, 255], metallicFactor=0.1, roughnessFactor=0.6)
    mesh.visual = TextureVisuals(material=material)
    return mesh


def _matrix(pose: Pose) -> Array:
    matrix = trimesh.transformations.quaternion_matrix(pose.wxyz)
    matrix[:3, 3] = pose.position
    return np.asarray(matrix, dtype=np.float64)
