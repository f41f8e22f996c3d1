"""The blade as STL, for printing and CAD: a closed surface in metres.

Finer than the blade on the page, with a section wherever the twist has a kink, and never exaggerated. It is the
blade as built: the twist law alone. `python -m explorer blade` writes it.
"""

import argparse
from collections.abc import Sequence
from typing import cast

import numpy as np
import trimesh

from explorer.export.provenance import PROGRAM, file_name
from explorer.picture.blade_mesh import LoftDetail, blade_shape, blade_vertices
from explorer.text.design_words import title_words
from rotor import Design, load_design, make_design
from rotor.design import PiecewiseLinearTwist, SumTwist, TableTwist, TwistLaw
from rotor.support.terminal import OneLineParser, command_words, run_command
from rotor.support.user_input import make_folder, write_output

POINTS, STATIONS = 97, 121
"""Round a section, and from root cut-out to tip: a chord is met to 0.1 mm."""
_HEADER = 80
"""Bytes of free text at the head of a binary STL file."""


def blade_mesh(design: Design) -> trimesh.Trimesh:
    """One blade, watertight [m]: x from the rotor's axis to the tip, y to the leading edge, z up.

    Pitch is zero at 0.75 R, the twist on both sides of it, without active twist.
    """
    active = () if design.active_twist is None else design.active_twist.stations
    places = tuple(sorted({*kinks(design.twist), *active}))
    shape = blade_shape(design.rotor, LoftDetail(POINTS, STATIONS, places))
    hinge = design.rotor.blade.flap_hinge * design.rotor.radius
    return trimesh.Trimesh(
        blade_vertices(shape, design.twist) + np.array([hinge, 0.0, 0.0]), shape.faces
    )


def blade_stl(design: Design) -> bytes:
    """The blade as binary STL. The format has no unit, so the header names it: metres."""
    body = cast(bytes, blade_mesh(design).export(file_type="stl"))
    header = f"{PROGRAM}, unit metre: {title_words(design)}"
    return header.encode("ascii", "replace")[:_HEADER].ljust(_HEADER) + body[_HEADER:]


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
    """0 when the file is written, 2 for bad input."""
    return run_command("explorer blade", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    design = load_design(options.design) if options.design else make_design()
    path, content = make_folder(options.out) / file_name(design, "-as-built.stl"), blade_stl(design)
    write_output(path, content)
    print(f"{path}: {len(content) / 1e6:.1f} MB")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=command_words("explorer", "rotor-explorer") + " blade",
        description="Write one blade as STL in metres, with its twist as built.",
        examples=(("The blade of a UH-60A", "--out cad"),),
    )
    parser.add_argument(
        "--design", metavar="FILE", help="design file (default: the UH-60A at µ 0.2)"
    )
    parser.add_argument(
        "--out", default=".", metavar="DIR", help="folder to write into (default: this one)"
    )
    return parser
