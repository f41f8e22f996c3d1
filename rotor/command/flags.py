"""Flags that several commands share, what they mean, and tables as files."""

import argparse
import csv
import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from rotor.aero.inflow import inflow_model
from rotor.aero.switches import parse_switches
from rotor.assets import SHIPPED_ROTORS
from rotor.design.design import Design
from rotor.files.design_file import read_design
from rotor.files.make_design import change_airfoils, make_design
from rotor.files.rotor_file import find_aircraft


def add_command(commands: Any, name: str, words: str, description: str = "") -> argparse.ArgumentParser:
    """A command's parser; its words stand in the list of commands, and above its own flags unless there are others."""
    return commands.add_parser(name, help=words, description=description or f"{words[0].upper()}{words[1:]}.")


def add_design_arguments(parser: argparse.ArgumentParser, *, one_twist: bool) -> None:
    """The flags that describe a design."""
    twist = (
        "linear:-8 | quadratic:A,D | segments:-12,-4@0.5 | spline:ANGLES@STATIONS | points:ANGLES@STATIONS | ideal | "
        "builtin | uh60a | table:FILE (degrees, per radius)"
    )
    add_rotor_argument(parser)
    parser.add_argument("--twist", metavar="SPEC", nargs=None if one_twist else "+", help=twist)
    parser.add_argument(
        "--preset", metavar="NAME", help="flight (default): what we believe; thesis: as the document states"
    )
    parser.add_argument("--inflow", metavar="NAME", help="forward-flight inflow model, for example pitt-peters")
    parser.add_argument(
        "--mass-kg", type=finite, metavar="KG", help="aircraft mass (default: the rotor's reference mass)"
    )
    parser.add_argument("--altitude-m", type=finite, metavar="M", help="pressure altitude (default 0)")
    parser.add_argument("--airfoils", metavar="SPEC", help="sections root to tip, as sc1094r8,sc1095@0.5")
    parser.add_argument("--off", metavar="NAMES", help="switch off parts of the physics, as tip-loss,reverse-flow")
    parser.add_argument("--case", metavar="FILE", help="design file (JSON); other flags override it")


def add_rotor_argument(parser: argparse.ArgumentParser) -> None:
    """`--rotor`."""
    parser.add_argument(
        "--rotor", metavar="NAME|FILE", help=f"{', '.join(SHIPPED_ROTORS)} or a rotor file (docs/rotor_file.md)"
    )


def design_from(args: argparse.Namespace, twist: str | None, advance_ratio: float | None) -> Design:
    """The design that the flags describe, on top of a design file where one is given."""
    base = read_design(args.case) if args.case else None
    blade = base if base and not (args.preset or args.rotor) else None  # Another rotor, or preset, has its own blade.
    design = make_design(
        preset=args.preset or (base.preset if base else "flight"),
        rotor=find_aircraft(args.rotor) if args.rotor else base.aircraft if base else SHIPPED_ROTORS[0],
        twist=twist or (blade.twist if blade else None),
        mass_kg=args.mass_kg
        if args.mass_kg is not None
        else (base.condition.mass if base and not args.rotor else None),
        altitude_m=args.altitude_m if args.altitude_m is not None else (base.condition.altitude if base else 0.0),
        models=base.models if base and not args.preset else None,
    )
    if advance_ratio is None:
        advance_ratio = base.condition.advance_ratio if base else 0.2
    if args.inflow:
        inflow_model(args.inflow)
        design = replace(design, models=replace(design.models, inflow=args.inflow))
    if args.off is not None:
        off = parse_switches(args.off)
        design = replace(design, models=replace(design.models, **dict.fromkeys(off, False)))
    if blade:
        design = replace(design, rotor=blade.rotor, active_twist=blade.active_twist)
    if args.airfoils:
        design = replace(design, rotor=change_airfoils(design.rotor, args.airfoils))
    return design.at(mu=advance_ratio)


def write_table(path: str, rows: Iterable[Iterable[str]], heading: str = "") -> None:
    """Write rows as CSV below a heading of comment lines; ValueError when the file cannot be written."""
    try:
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            file.write(heading)
            csv.writer(file, lineterminator="\n").writerows(rows)
    except OSError as error:
        raise ValueError(f"cannot write {path!r} ({error.strerror}): give a writable file") from None


def finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value
