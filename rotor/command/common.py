"""What several commands share: flags of design and search, tables as CSV files, and the progress of long commands."""

import argparse
import csv
import math
import signal
import sys
import time
from collections.abc import Callable, Generator, Iterable
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import Any, get_args

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.installation import install
from rotor.actuator.section import Host, default_placement
from rotor.actuator.verdict import change_limit
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES, parse_switches
from rotor.airfoil.sections import TABLE_NAMES
from rotor.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.design.aircraft import FASTEST_CLIMB
from rotor.design.design import HOVER_INFLOWS, LOW_SPEEDS, TRIMS, Design
from rotor.design.retired import current_model
from rotor.design.stand import LOAD_KEYS, Flapping
from rotor.files.design_file import load_design
from rotor.files.make_design import change_airfoils, make_design
from rotor.files.rotor_file import find_aircraft
from rotor.optimisation.concepts import CONCEPTS, Concept
from rotor.optimisation.search import ChangeLimit, Limits, even_change_limit
from rotor.user_input import did_you_mean


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
    for flag, what in (("--twist-per-rev", "active twist, tip relative to root"), ("--pitch-per-rev", "root pitch")):
        parser.add_argument(
            flag, metavar="N:DEG:PHASE,…",
            help=f"{what}: DEG cos(N ψ − PHASE) degrees at N/rev, e.g. 3:1:180; 2:0:0 takes away that of a design file",
        )  # fmt: skip
    parser.add_argument("--preset", metavar="NAME", help="flight (default): best available; thesis: as printed")
    parser.add_argument(
        "--inflow", metavar="NAME",
        help=f"forward-flight inflow model: {' | '.join(INFLOW_MODELS)}; or that of hover: {' | '.join(HOVER_INFLOWS)}",
    )  # fmt: skip
    parser.add_argument(
        "--low-speed", choices=LOW_SPEEDS,
        help="hover (flight): the inflow model passes over to that of hover near µ = 0; wake (thesis): it does not",
    )  # fmt: skip
    parser.add_argument(
        "--mass-kg", type=finite, metavar="KG", help="aircraft mass (default: the rotor's reference mass)"
    )
    parser.add_argument("--altitude-m", type=finite, metavar="M", help="pressure altitude (default 0)")
    parser.add_argument(
        "--climb-m-s", type=finite, metavar="V",
        help=f"rate of climb, {-FASTEST_CLIMB:g}…{FASTEST_CLIMB:g} m/s, negative in descent (default 0); preset flight",
    )  # fmt: skip
    parser.add_argument(
        "--airfoils", metavar="SPEC",
        help=f"sections root to tip, e.g. sc1094r8,sc1095@0.5, of {', '.join(TABLE_NAMES)}",
    )  # fmt: skip
    parser.add_argument(
        "--off", metavar="NAMES",
        help=f"switch off physical effects, separated by commas: {', '.join(one.flag for one in SWITCHES.values())}",
    )  # fmt: skip
    parser.add_argument("--case", metavar="FILE", help="design file (JSON); other flags override it")
    stand = parser.add_argument_group("test stand")
    stand.add_argument("--trim", metavar="NAME", help=f"{' | '.join(TRIMS)} (the last three: a rotor on a test stand)")
    for flag, unit, words in _STAND_FLAGS:
        stand.add_argument(flag, type=finite, metavar=unit, help=words)
    stand.add_argument(
        "--flapping", choices=get_args(Flapping),
        help="trimmed by cyclic (default in a wind tunnel), free, or free with cyclic that gives hub moments",
    )  # fmt: skip


_STAND_FLAGS = (
    ("--shaft-tilt-deg", "DEG", "tilt of the shaft, positive forward (default 0; a free rotor finds its own)"),
    ("--ct-over-sigma", "C", "blade loading"),
    ("--thrust-n", "N", "thrust along the shaft"),
    ("--collective-deg", "DEG", "pitch at 0.75 R"),
    ("--cyclic-1c-deg", "DEG", "given cyclic, with free flapping"),
    ("--cyclic-1s-deg", "DEG", "the same, sine part"),
    ("--hub-roll-nm", "NM", "given hub moment, towards the retreating side, with flapping hub-moments"),
    ("--hub-pitch-nm", "NM", "the same, nose up"),
    ("--tip-mach", "M", "tip speed over the speed of sound"),
    ("--density", "RHO", "air density, kg/m³"),
)


def _stand_from(args: argparse.Namespace, base: Design | None) -> tuple[str | None, dict[str, Any] | None]:
    """Trim and test stand of the flags, on top of those of a design file."""
    before = base.condition.stand if base and not args.rotor else None
    trim: str | None = args.trim or (base.models.trim if base and before else None)
    given = {flag[2:].replace("-", "_"): getattr(args, flag[2:].replace("-", "_")) for flag, _, _ in _STAND_FLAGS}
    given = {
        "density_kg_m3" if key == "density" else key: value for key, value in given.items() if value is not None
    } | ({"flapping": args.flapping} if args.flapping else {})
    if trim in ("propulsive", "thrust") or (trim is None and given and not _isolated(args, base)):
        if given:
            raise ValueError(
                f"{next(iter(given))} belongs to a test stand: add --trim wind-tunnel, free-rotor or controls"
            )
        return trim, None
    record = before.record() if before and args.trim in (None, base.models.trim if base else None) else {}
    if any(key in given for key in LOAD_KEYS):
        record = {key: value for key, value in record.items() if key not in LOAD_KEYS}
    record |= given
    return trim, record or None


def _isolated(args: argparse.Namespace, base: Design | None) -> bool:
    craft = find_aircraft(args.rotor) if args.rotor else base.aircraft if base else None
    return craft is not None and craft.isolated


def add_rotor_argument(parser: argparse.ArgumentParser) -> None:
    """`--rotor`."""
    parser.add_argument(
        "--rotor",
        metavar="NAME|FILE",
        help=f"{', '.join((*SHIPPED_ROTORS, *MEASURED_ROTORS))} or a rotor file (docs/rotor_file.md)",
    )


def design_from(args: argparse.Namespace, twist: str | None, advance_ratio: float | None) -> Design:
    """The design that the flags describe, on top of a design file where one is given."""
    base = load_design(args.case) if args.case else None
    blade = base if base and not (args.preset or args.rotor) else None  # Another rotor or preset has its own blade.
    trim, stand = _stand_from(args, base)
    design = make_design(
        trim=trim,
        stand=stand,
        preset=args.preset or (base.preset if base else "flight"),
        rotor=find_aircraft(args.rotor) if args.rotor else base.aircraft if base else SHIPPED_ROTORS[0],
        twist=twist or (blade.twist if blade else None),
        twist_per_rev=args.twist_per_rev or (),
        pitch_per_rev=args.pitch_per_rev if args.pitch_per_rev is not None else (base.pitch_per_rev if base else ()),
        mass_kg=args.mass_kg
        if args.mass_kg is not None
        else (base.condition.mass if base and not args.rotor else None),
        altitude_m=args.altitude_m if args.altitude_m is not None else (base.condition.altitude if base else 0.0),
        climb_m_s=args.climb_m_s if args.climb_m_s is not None else (base.condition.climb_speed if base else 0.0),
        models=base.models if base and not args.preset else None,
    )
    if advance_ratio is None:
        advance_ratio = base.condition.advance_ratio if base else 0.2
    if args.inflow:
        design = with_inflow(design, args.inflow)
    if args.low_speed:
        design = replace(design, models=replace(design.models, low_speed=args.low_speed))
    if args.off is not None:
        off = parse_switches(args.off)
        design = replace(design, models=replace(design.models, **dict.fromkeys(off, False)))
    if blade:
        design = replace(design, rotor=blade.rotor)
        if args.twist_per_rev is None:
            design = replace(design, active_twist=blade.active_twist)
    if args.airfoils:
        design = replace(design, rotor=change_airfoils(design.rotor, args.airfoils))
    return design.at(mu=advance_ratio)


def with_inflow(design: Design, name: str) -> Design:
    """The design with an inflow model by name, of forward flight or of hover; ValueError for an unknown name."""
    options = {"inflow": tuple(INFLOW_MODELS), "hover_inflow": HOVER_INFLOWS}
    for option, names in options.items():
        if (current := current_model(option, name)) in names:
            return replace(design, models=replace(design.models, **{option: current}))
    known = [one for names in options.values() for one in names]
    hint = did_you_mean(name, known) or ":"
    raise ValueError(f"inflow model {name!r} is not known{hint} use one of {', '.join(known)}")


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


def add_search_arguments(parser: argparse.ArgumentParser, starts: int) -> None:
    """Starting points, seed and limits."""
    parser.add_argument(
        "--starts", type=int, default=starts, metavar="N", help=f"starting points per search (default {starts})"
    )
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of the starting points (default 0)")
    parser.add_argument("--on-top", action="store_true", help="add the concept to the design's own twist")
    limits = parser.add_argument_group("limits")
    limits.add_argument(
        "--bound", action="append", default=[], metavar="NAME=LOW,HIGH",
        help="bounds of one parameter, degrees or r/R, e.g. --bound outboard_rate=-20,0; repeatable",
    )  # fmt: skip
    limits.add_argument(
        "--rate-deg", metavar="LOW,HIGH", help="twist rate of every segment, degrees per radius, e.g. --rate-deg=-20,0"
    )
    limits.add_argument("--stalled-percent", type=finite, metavar="P", help="largest stalled fraction of the disk")
    limits.add_argument(
        "--change-deg", type=finite, metavar="DEG",
        help="largest change from the design's own twist, root to tip, linear along the blade",
    )  # fmt: skip
    limits.add_argument(
        "--actuator", metavar="ID",
        help="limit the change of twist to the range of this actuator as a retrofit, e.g. MFC_P1",
    )  # fmt: skip
    limits.add_argument("--plies", type=int, metavar="N", help="plies of that actuator per skin (default 2)")
    limits.add_argument("--derated", action="store_true", help="use that range derated by test")


def limits_from(args: argparse.Namespace, design: Design, concepts: tuple[Concept, ...]) -> Limits:
    """The limits that the flags describe; ValueError for what no concept can use."""
    units = {parameter.name: parameter for one in concepts for parameter in one.parameters}
    bounds: list[tuple[str, float, float]] = []
    for text in args.bound:
        name, _, numbers = str(text).partition("=")
        name = name.removesuffix("_deg")
        if name not in units:
            raise ValueError(f"bound {text!r} names no parameter: use one of {', '.join(units)}")
        low, high = _pair(numbers, f"bound {text!r}", f"{name}=-20,0")
        bounds.append((name, units[name].from_shown(low), units[name].from_shown(high)))
    rate = None
    if args.rate_deg is not None:
        low, high = _pair(args.rate_deg, f"rate {args.rate_deg!r}", "--rate-deg=-20,0")
        rate = math.radians(low), math.radians(high)
    if args.change_deg is not None and args.change_deg < 0.0:
        raise ValueError(f"change limit {args.change_deg:g}° is negative: give 0 or more")
    return Limits(
        bounds=tuple(bounds),
        rate=rate,
        stalled=None if args.stalled_percent is None else args.stalled_percent / 100.0,
        change=_change(args, design),
    )


def _change(args: argparse.Namespace, design: Design) -> ChangeLimit | None:
    """Limit on the change from the design's own twist: an angle, or the range of an actuator."""
    if args.actuator is None:
        if args.plies is not None or args.derated:
            raise ValueError("--plies and --derated need an actuator: add --actuator, for example MFC_P1")
        root = design.rotor.blade.root_cutout
        return None if args.change_deg is None else even_change_limit(design.twist, math.radians(args.change_deg), root)
    if args.change_deg is not None:
        raise ValueError("--change-deg and --actuator both limit the change of twist: give one of them")
    placement = default_placement(2 if args.plies is None else args.plies)
    installed = install(find_actuator(args.actuator), placement, Host(), design.rotor)
    return change_limit(installed, design.twist, root=design.rotor.blade.root_cutout, derated=args.derated)


def concept_help() -> str:
    """All names."""
    return " | ".join(CONCEPTS)


def parse_division(text: str | None) -> list[float] | None:
    """r/R of one or two divisions."""
    if text is None:
        return None
    try:
        values = [float(item) for item in text.split(",")]
    except ValueError:
        values = [math.nan]
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"division {text!r} is not understood: write r/R, for example 0.5 or 0.4,0.8")
    return values


def _pair(text: str, what: str, example: str) -> tuple[float, float]:
    try:
        low, high = (float(item) for item in text.split(","))
    except ValueError:
        low = high = math.nan
    if not (math.isfinite(low) and math.isfinite(high)):
        raise ValueError(f"{what} is not understood: write two numbers, for example {example}")
    return low, high


_TWICE = 0.5
"""[s]"""
STOPPED = 130
"""Exit code after Ctrl-C; results so far are printed."""


@contextmanager
def bar(total: int | None, unit: str) -> Generator[Callable[[str], None]]:
    """A progress bar on stderr if that is a terminal; call it with a short text to advance it by one."""
    if not sys.stderr.isatty():
        yield lambda words: None
        return
    from tqdm import tqdm

    made: Any = tqdm(total=total, unit=unit, file=sys.stderr, leave=False, dynamic_ncols=True)

    def advance(words: str) -> None:
        made.set_postfix_str(words, refresh=False)
        made.update()

    try:
        yield advance
    finally:
        made.close()


@contextmanager
def interruptible() -> Generator[Callable[[], bool]]:
    """A `stop` that returns True after the first Ctrl-C; a second one interrupts at once.

    Some programs send one Ctrl-C twice, to a process and to its group: two within half a second count as one.
    """
    asked: list[float] = []

    def ask(number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if asked and now - asked[0] > _TWICE:
            signal.default_int_handler(number, frame)
        if not asked:
            asked.append(now)

    before = signal.signal(signal.SIGINT, ask)
    try:
        yield lambda: bool(asked)
    finally:
        signal.signal(signal.SIGINT, before)
