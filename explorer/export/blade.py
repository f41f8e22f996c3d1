"""The blade as STL, for printing and CAD: a closed surface in metres.

Finer than the blade on the page, with a section wherever the twist has a kink, and never exaggerated. The jig shape has
the twist law alone; the flown shape also has what elasticity and an active twist add at one azimuth.
`python -m explorer blade` writes both.
"""

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import cast

import numpy as np
import trimesh

from explorer.export.provenance import PROGRAM, file_stem
from explorer.picture.blade_mesh import Detail, blade_shape, blade_vertices
from explorer.picture.picture import at_azimuth, with_active_twist
from rotor import Design, Solution, load_design, make_design, solve
from rotor.design import PiecewiseLinearTwist, SumTwist, TableTwist, TwistLaw
from rotor.terminal import called, help_formatter, run_command
from rotor.user_input import write_whole

POINTS, STATIONS = 97, 121
"""Round a section, and from root cut-out to tip: a chord is met to 0.1 mm, the file has 1.3 MB."""
_HEADER = 80
"""Bytes of free text at the head of a binary STL file."""


def blade_mesh(design: Design) -> trimesh.Trimesh:
    """One blade, watertight [m]: x from the rotor's axis to the tip, y to the leading edge, z up.

    Pitch is zero at 0.75 R, the twist on both sides of it, without active twist.
    """
    active = () if design.active_twist is None else design.active_twist.stations
    places = tuple(sorted({*kinks(design.twist), *active}))
    shape = blade_shape(design.rotor, Detail(POINTS, STATIONS, places))
    hinge = design.rotor.blade.flap_hinge * design.rotor.radius
    return trimesh.Trimesh(blade_vertices(shape, design.twist) + np.array([hinge, 0.0, 0.0]), shape.faces)


def blade_stl(design: Design) -> bytes:
    """The blade as binary STL. The format has no unit, so the header names it: metres."""
    body = cast(bytes, blade_mesh(design).export(file_type="stl"))
    header = f"{PROGRAM}: {design.rotor.name} blade, twist {design.twist.spec()}; unit metre"
    return header.encode("ascii", "replace")[:_HEADER].ljust(_HEADER) + body[_HEADER:]


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
            path, content = folder / f"{file_stem(jig, 'blade', name)}.stl", blade_stl(design)
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
        description="One blade as STL, in metres, in jig shape and as flown.",
    )
    parser.add_argument("--design", metavar="FILE", help="design file (JSON); default the UH-60A at µ = 0.2")
    parser.add_argument("--psi", type=float, default=90.0, metavar="DEG", help="azimuth as flown (default 90)")
    parser.add_argument("--out", default=".", metavar="DIR", help="folder (default: this one)")
    return parser
