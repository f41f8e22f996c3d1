"""The blade as STL and as section curves for printing and CAD, and the rotor as GLB: closed surfaces in metres.

Finer than the blade on the page, with a section wherever the twist has a kink, and never exaggerated. The jig shape has
the twist law alone; the flown shape also has what elasticity and an active twist add at one azimuth.
`python -m explorer blade` writes both. STEP is left to the CAD program: the permissive libraries that write it bring a
whole geometry kernel, and every CAD program lofts curves.
"""

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import cast

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from explorer import colours
from explorer.export.provenance import PROGRAM, file_stem
from explorer.picture.airframe import mast, rotor_head
from explorer.picture.blade_mesh import BladeShape, Detail, Faces, blade_shape, blade_vertices
from explorer.picture.picture import (
    Pose,
    at_azimuth,
    blade_pose,
    flown_twist,
    follows_azimuth,
    rotor_pose,
    with_active_twist,
)
from rotor import Design, Solution, load_design, make_design, solve
from rotor.arrays import Array
from rotor.design import PiecewiseLinearTwist, SumTwist, TableTwist, TwistLaw
from rotor.terminal import called, help_formatter, run_command
from rotor.user_input import csv_text, write_whole

POINTS, STATIONS = 97, 121
"""Round a section, and from root cut-out to tip: a chord is met to 0.1 mm, the file has 1.3 MB."""
_HEADER = 80
"""Bytes of free text at the head of a binary STL file."""
_Z_UP = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""From z up, as here, to y up, as in glTF."""


def blade_mesh(design: Design) -> trimesh.Trimesh:
    """One blade, watertight [m]: x from the rotor's axis to the tip, y to the leading edge, z up.

    Pitch is zero at 0.75 R, the twist on both sides of it, without active twist.
    """
    shape, vertices = _loft(design)
    return trimesh.Trimesh(vertices + np.array([_hinge(design), 0.0, 0.0]), shape.faces)


def blade_stl(design: Design) -> bytes:
    """The blade as binary STL. The format has no unit, so the header names it: metres."""
    body = cast(bytes, blade_mesh(design).export(file_type="stl"))
    header = f"{PROGRAM}: {design.rotor.name} blade, twist {design.twist.spec()}; unit metre"
    return header.encode("ascii", "replace")[:_HEADER].ljust(_HEADER) + body[_HEADER:]


def section_curves(design: Design) -> bytes:
    """The blade's sections as closed curves, CSV: one curve after another from the hinge to the tip, points in metres.

    Axes as in `blade_mesh`. The first point of a curve is repeated at its end; all curves begin at the trailing edge
    and have as many points, so that a loft through them does not twist.
    """
    shape, vertices = _loft(design)
    count = len(shape.r)
    curves = vertices[: count * POINTS].reshape(count, POINTS, 3) + np.array([_hinge(design), 0.0, 0.0])
    rows: list[tuple[object, ...]] = [("section", "r_over_R", "x_m", "y_m", "z_m")]
    for k, (r, curve) in enumerate(zip(shape.r.tolist(), curves, strict=True)):
        for x, y, z in [*curve.tolist(), curve[0].tolist()]:
            rows.append((k, f"{r:.6g}", f"{x:.6f}", f"{y:.6f}", f"{z:.6f}"))
    return csv_text(rows).encode("ascii")


def flown_design(solution: Solution, psi: float) -> Design:
    """The design with the twist of the blade in flight at `psi` [rad] as its law: active and elastic twist included.

    As every law it is zero at 0.75 R: what elasticity does there is left to the pitch.
    """
    design, elastic = solution.design, solution.disk.elastic_twist
    law = with_active_twist(design, psi)
    if elastic is not None:
        at = at_azimuth(solution, elastic, psi)
        law = SumTwist(law, TableTwist(tuple(solution.disk.r.tolist()), tuple(at.tolist()), "elastic"))
    return replace(design, twist=law, active_twist=None)


def rotor_scene(solution: Solution, azimuth_deg: float) -> trimesh.Scene:
    """Blades as flown, hub and mast, as on the page, y up; blades share one mesh unless twist follows the azimuth."""
    design, controls = solution.design, solution.controls
    scene = trimesh.Scene()
    body = _Z_UP @ _matrix(rotor_pose(controls))
    for name, mesh in (("hub", rotor_head(design.rotor)), ("mast", mast(design.rotor.radius))):
        scene.add_geometry(_painted(mesh.vertices, mesh.faces, colours.HUB), name, name, transform=body)
    step = 2.0 * math.pi / design.rotor.blades
    azimuths = tuple(math.radians(azimuth_deg) + k * step for k in range(design.rotor.blades))
    differ = follows_azimuth(solution)
    for k, psi in enumerate(azimuths):
        shared = "blade" if k else "marked_blade"
        name = f"blade_{k + 1}" if differ else shared
        if name not in scene.geometry:
            shape, vertices = _loft(design, flown_twist(solution, psi))
            colour = colours.BLADE if k else colours.MARKED_BLADE
            scene.geometry[name] = _painted(vertices, shape.faces, colour)
        place = body @ _matrix(blade_pose(controls, psi, _hinge(design), design))
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


def _loft(design: Design, flown: TwistLaw | None = None) -> tuple[BladeShape, Array]:
    """In the blade's own axes, from its hinge; `flown`: a twist in place of the design's."""
    active = design.active_twist.stations if design.active_twist is not None and flown is not None else ()
    places = tuple(sorted({*kinks(design.twist), *active}))
    shape = blade_shape(design.rotor, Detail(POINTS, STATIONS, places))
    return shape, blade_vertices(shape, flown or design.twist)


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


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when all files are written, 1 when the design does not trim, 2 for bad input."""
    return run_command("explorer blade", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    jig = load_design(options.design) if options.design else make_design()
    shapes = {"jig": jig}
    if jig.rotor.blade.structure is not None or jig.active_twist is not None:
        elastic = jig.rotor.blade.structure is not None
        solution = solve(replace(jig, models=replace(jig.models, elastic_twist=elastic)))
        if not solution.converged:
            raise ValueError(f"there is no flown shape: {solution.message}")
        shapes[f"flown-psi{options.psi:g}"] = flown_design(solution, math.radians(options.psi))
    folder = Path(options.out)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, design in shapes.items():
            stem = folder / file_stem(jig, "blade", name)
            for path, content in ((f"{stem}.stl", blade_stl(design)), (f"{stem}.csv", section_curves(design))):
                write_whole(path, content)
                print(f"{path}: {len(content) / 1e6:.1f} MB")
    except OSError as error:
        raise ValueError(f"cannot write to {str(folder)!r} ({error.strerror}): give a folder") from None
    if len(shapes) == 1:
        print("Torsional stiffness is not given in the rotor file: the flown shape is the jig shape.")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        formatter_class=help_formatter,
        prog=called("explorer", "rotor-explorer") + " blade",
        description="One blade for CAD, in metres, in jig shape and as flown: STL, and section curves to loft as CSV.",
    )
    parser.add_argument("--design", metavar="FILE", help="design file (JSON); default the UH-60A at µ = 0.2")
    parser.add_argument("--psi", type=float, default=90.0, metavar="DEG", help="azimuth as flown (default 90)")
    parser.add_argument("--out", default=".", metavar="DIR", help="folder (default: this one)")
    return parser
