"""What several commands share: flags of design, search and output, and the progress of long commands."""

import argparse
import json
import math
import os
import re
import signal
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.installation import change_limit, install
from rotor.actuator.section import HostBlade, default_placement
from rotor.aero.inflow import INFLOW_MODELS
from rotor.command.names import COMMANDS
from rotor.design.active_twist import Harmonic
from rotor.design.design import Design
from rotor.design.quantities import ARGUMENTS, HOVER_INFLOWS, NUMBERS, SPEED, STAND, SWEPT
from rotor.design.quantity import Quantity
from rotor.files.design_file import load_design
from rotor.files.make_design import make_design
from rotor.files.rotor_file import find_aircraft
from rotor.optimisation.concepts import CONCEPTS, Concept
from rotor.optimisation.limits import ChangeLimit, Limits
from rotor.optimisation.objective import MISSION_COLUMNS
from rotor.study.results import design_at
from rotor.support.assets import SHIPPED_ROTORS
from rotor.support.progress import ProgressBar
from rotor.support.user_input import check_writable, parse_range

Run = Callable[[argparse.Namespace], int]


def add_command(
    commands: Any, name: str, run: Run, description: str = ""
) -> argparse.ArgumentParser:
    """Add the parser of a command. Its summary in the list of commands also heads its own help unless another is
    given."""
    _, words, examples = COMMANDS[name]
    described = description or f"{words[0].upper()}{words[1:]}."
    parser = commands.add_parser(name, help=words, description=described, examples=examples)
    parser.set_defaults(run=run)
    return parser


_FLAGS = {name: row for name, row in ARGUMENTS.items() if name not in ("models", "stand")}
"""Arguments of `make_design` that have one flag."""


def add_design_arguments(
    parser: argparse.ArgumentParser,
    *,
    speed: bool = False,
    twists: bool = False,
    ranges: bool = False,
) -> None:
    """Add a flag for every argument of `make_design`: those of the speed, several twists and ranges only on demand."""
    parser.usage = "%(prog)s [flags]"
    blade = parser.add_argument_group("design")
    swept = "Give one of these numbers as a range A:B:STEP to sweep over it." if ranges else None
    condition = parser.add_argument_group("flight condition", swept)
    models, stand = parser.add_argument_group("models"), parser.add_argument_group("test stand")
    speeds = condition.add_mutually_exclusive_group() if speed else condition
    words = "let the rotor file name section files outside its own folder"
    blade.add_argument("--allow-outside", action="store_true", help=words)
    for name, row in (_FLAGS | STAND).items():
        if name in SPEED and not speed and not ranges:
            continue
        group = (
            stand
            if name in ("trim", *STAND)
            else models
            if row.section == "models" or name in ("low_speed", "loss_on", "off")
            else blade
        )
        group = speeds if name in SPEED else condition if name in NUMBERS else group
        how = _how(row)
        if name == "twist" and twists:
            how["nargs"] = "+"
        if ranges and name in SWEPT:
            how["type"] = _range
        group.add_argument(f"--{row.flag}", dest=name, **how)


def _how(row: Quantity) -> dict[str, Any]:
    """How argparse reads its flag, and what it says of it."""
    choices = (*INFLOW_MODELS, *HOVER_INFLOWS) if row.name == "inflow" else row.choices
    match row.kind:
        case "switch":
            return {"help": row.help, "action": "store_true"}
        case "choice":
            alone = {"nargs": "?", "const": "on"} if "on" in choices else {}
            return {"help": row.help, "choices": choices, **alone}
        case "whole":
            return {"help": row.help, "type": int, "metavar": "N"}
        case "number":
            return {
                "help": row.help,
                "type": finite,
                "metavar": _SYMBOLS.get(row.unit, row.unit.upper() or "X"),
            }
        case _:
            return {"help": row.help_with(choices), "metavar": _METAVARS.get(row.name, "NAME")}


_METAVARS = {
    "case": "FILE",
    "rotor": "NAME|FILE",
    "twist": "SPEC",
    "twist_per_rev": "N:DEG:PHASE",
    "pitch_per_rev": "N:DEG:PHASE",
    "airfoils": "NAME@R,…",
    "off": "NAME,…",
}
_SYMBOLS = {"°": "DEG", "°C": "DEG_C", "%": "PERCENT", "m/s": "M/S", "kg/m³": "KG/M3", "N m": "NM"}


def _range(text: str) -> list[float]:
    try:
        return parse_range(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def design_from(
    args: argparse.Namespace, twist: str | None = None, mu: float | None = None
) -> Design:
    """The design that the flags describe; `twist` and `mu` in place of theirs. Raises ValueError with one sentence."""
    given = {name: getattr(args, name, None) for name in _FLAGS if name not in SPEED}
    speed = {name: getattr(args, name, None) for name in SPEED} if mu is None else {"mu": mu}
    row = getattr(args, "row", None)
    if row and args.case:
        raise ValueError("--row and --case both give the design to start from: use one of them")
    case = design_at(row) if row else load_design(args.case) if args.case else None
    rotor = find_aircraft(args.rotor, allow_outside=args.allow_outside) if args.rotor else None
    stand = {key: value for key in STAND if (value := getattr(args, key)) is not None}
    known = case is not None and rotor is None and case.condition.stand is not None
    isolated = (rotor or (case and case.aircraft) or find_aircraft(SHIPPED_ROTORS[0])).isolated
    if stand and (args.trim in ("propulsive", "thrust") or not (args.trim or known or isolated)):
        raise ValueError(
            f"{next(iter(stand))} belongs to a test stand: add --trim wind-tunnel, free-rotor or controls"
        )
    changed: dict[str, Any] = (
        given
        | speed
        | {"case": case, "rotor": rotor, "stand": stand or None, "twist": twist or given["twist"]}
    )
    return make_design(**{name: value for name, value in changed.items() if value is not None})


def add_output_arguments(parser: argparse.ArgumentParser, csv: str = "") -> Any:
    """`--json`, and `--csv` where its words name what is written; returns the group for further flags."""
    group = parser.add_argument_group("output")
    if csv:
        group.add_argument(
            "--csv", metavar="FILE", help=f"also write {csv} as CSV; with - print nothing else"
        )
    group.add_argument("--json", action="store_true", help="print the answer as JSON")
    return group


def check_output(args: argparse.Namespace) -> None:
    """ValueError for a file of `--csv` that cannot be written, and for two outputs at once."""
    if args.csv == "-" and args.json:
        raise ValueError("--csv - and --json both print to the output: use one of them")
    if args.csv and args.csv != "-":
        check_writable(args.csv)


def print_result(
    args: argparse.Namespace, record: Callable[[], Any], report: Callable[[], str]
) -> None:
    """Print the answer of a command: with --json the record, else the report; nothing after `--csv -`."""
    if getattr(args, "csv", None) == "-":
        return
    print(json.dumps(record(), indent=2, allow_nan=False) if args.json else report())


def add_processes_argument(parser: argparse.ArgumentParser) -> None:
    words = "processes to run (default: one per core, at most 4)"
    parser.add_argument("--processes", type=int, metavar="N", help=words)


def processes_from(args: argparse.Namespace) -> int:
    """The number of processes asked for, or one per core. Raises ValueError outside 1…64."""
    count = args.processes if args.processes is not None else min(os.cpu_count() or 1, 4)
    if not 1 <= count <= 64:
        raise ValueError(f"{count} processes are outside 1…64: choose one per core")
    return count


def finite(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value


def add_search_arguments(parser: argparse.ArgumentParser, starts: int) -> None:
    """Starting points, seed and limits."""
    search = parser.add_argument_group("search")
    words = f"starting points per search (default {starts})"
    search.add_argument("--starts", type=int, default=starts, metavar="N", help=words)
    search.add_argument(
        "--seed", type=int, default=0, metavar="N", help="seed of the starting points (default 0)"
    )
    search.add_argument(
        "--on-top", action="store_true", help="add the concept to the design's own twist"
    )
    limits = parser.add_argument_group("limits")
    words = "bounds of one parameter in degrees or r/R, e.g. --bound outboard_rate=-20,0; may be repeated"
    limits.add_argument("--bound", action="append", default=[], metavar="NAME=LOW,HIGH", help=words)
    words = "twist rate of every segment in degrees per radius, e.g. --rate-deg -20,0"
    limits.add_argument("--rate-deg", metavar="LOW,HIGH", help=words)
    words = "largest part of the disk area past the static stall angle, separated or still attached"
    limits.add_argument("--stalled-percent", type=finite, metavar="PERCENT", help=words)
    words = "largest vibration index at any condition, relative to the weight; needs --bending, from µ 0.2 on"
    limits.add_argument("--index-percent", type=finite, metavar="PERCENT", help=words)
    words = "largest change from the design's own twist, linear from root to tip"
    limits.add_argument("--change-deg", type=finite, metavar="DEG", help=words)
    words = "allow only the change of twist that this actuator reaches as a retrofit, e.g. MFC_P1"
    limits.add_argument("--actuator", metavar="ID", help=words)
    limits.add_argument("--plies", type=int, metavar="N", help=PLIES_HELP)


def limits_from(args: argparse.Namespace, design: Design, concepts: tuple[Concept, ...]) -> Limits:
    """The limits that the flags describe; ValueError for what no concept can use."""
    units = {parameter.name: parameter for concept in concepts for parameter in concept.parameters}
    bounds: list[tuple[str, float, float]] = []
    for text in args.bound:
        name, _, numbers = str(text).partition("=")
        name = name.removesuffix("_deg")
        if name not in units:
            raise ValueError(
                f"bound {text!r} does not name a parameter: use one of {', '.join(units)}"
            )
        low, high = parse_pair(numbers, f"bound {text!r}", f"{name}=-20,0")
        bounds.append((name, units[name].from_shown(low), units[name].from_shown(high)))
    rate = None
    if args.rate_deg is not None:
        low, high = parse_pair(args.rate_deg, f"rate {args.rate_deg!r}", "--rate-deg -20,0")
        rate = math.radians(low), math.radians(high)
    return Limits(
        bounds=tuple(bounds),
        rate=rate,
        stalled_percent=args.stalled_percent,
        change=_change(args, design),
        change_deg=args.change_deg,
        index_percent=args.index_percent,
    )


def _change(args: argparse.Namespace, design: Design) -> ChangeLimit | None:
    """Limit on the change from the design's own twist to the range of an actuator."""
    if args.actuator is None:
        if args.plies is not None:
            raise ValueError("--plies needs an actuator: add --actuator, for example MFC_P1")
        return None
    if args.change_deg is not None:
        raise ValueError(
            "--change-deg and --actuator both limit the change of twist: give one of them"
        )
    placement = default_placement(2 if args.plies is None else args.plies)
    installed = install(find_actuator(args.actuator), placement, HostBlade(), design.rotor)
    return change_limit(installed, design.twist, root=design.rotor.blade.root_cutout)


def waves_text(harmonics: tuple[Harmonic, ...]) -> str:
    """Harmonics of active twist or root pitch for a reader."""
    return "; ".join(
        f"{wave.per_rev}/rev ±{math.degrees(wave.amplitude):.2f}°, phase {math.degrees(wave.phase):.0f}°"
        for wave in harmonics
    )


def short_spec(spec: str) -> str:
    """A twist SPEC with angles to a hundredth of a degree, which is finer than any optimum is known."""
    angles, at, stations = spec.partition("@")
    return re.sub(r"-?\d+\.\d{3,}", lambda match: f"{float(match[0]):.2f}", angles) + at + stations


CONCEPT_HELP = f"twist concept: {' | '.join(CONCEPTS)}"
DIVISION_HELP = "breaks of the segments in r/R, e.g. 0.5, or 0.48,0.84 for three segments"
MISSION_HELP = (
    f"CSV file with the columns {','.join(MISSION_COLUMNS)}: search for the least mean power"
)
PLIES_HELP = "plies of the actuator per skin, or number of torque tubes (default 2)"


def parse_division(text: str | None) -> tuple[float, ...] | None:
    """r/R of one or two divisions; ValueError for any other text."""
    if text is None:
        return None
    values = _finite_numbers(text, ",")
    if not values:
        raise ValueError(
            f"division {text!r} is not understood: write r/R, for example 0.5 or 0.48,0.84"
        )
    return values


def parse_pair(text: str, what: str, example: str, by: str = ",") -> tuple[float, float]:
    """Two numbers; ValueError for any other text, with `what` and `example`."""
    values = _finite_numbers(text, by)
    if len(values) != 2:
        raise ValueError(f"{what} is not understood: write two numbers, for example {example}")
    return values[0], values[1]


def _finite_numbers(text: str, by: str) -> tuple[float, ...]:
    """Empty where one of them is not a finite number."""
    try:
        values = tuple(float(item) for item in text.split(by))
    except ValueError:
        return ()
    return values if all(map(math.isfinite, values)) else ()


_SECOND_SIGNAL_S = 0.5
"""[s]"""
STOPPED = 130
"""Exit code after Ctrl-C or SIGTERM; results so far are printed."""


@contextmanager
def bar(total: int | None, unit: str) -> Generator[Callable[[str], None]]:
    """A progress bar on stderr if that is a terminal; call it with a short text to advance it by one."""
    hidden = not sys.stderr.isatty()
    shown: Any = ProgressBar(
        total=total, unit=unit, file=sys.stderr, leave=False, dynamic_ncols=True, disable=hidden
    )

    def advance(words: str) -> None:
        shown.set_postfix_str(words, refresh=False)
        shown.update()

    with shown:
        yield advance


@contextmanager
def interruptible() -> Generator[Callable[[], bool]]:
    """A `stop` that returns True after the first Ctrl-C or SIGTERM; a second one interrupts at once.

    Some programs send one Ctrl-C twice, to a process and to its group: two within half a second count as one.
    """
    asked: list[float] = []

    def ask(number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if asked and now - asked[0] > _SECOND_SIGNAL_S:
            signal.default_int_handler(number, frame)
        if not asked:
            asked.append(now)

    before = [(number, signal.signal(number, ask)) for number in (signal.SIGINT, signal.SIGTERM)]
    try:
        yield lambda: bool(asked)
    finally:
        for number, handler in before:
            signal.signal(number, handler)
