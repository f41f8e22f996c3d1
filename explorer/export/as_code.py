"""A design as a short Python script or a command line; both compute the power of the page.

Both start from the result of `make_design` and write whatever differs. So a field added to `Design` later is written
too, or refused with a sentence, and never left out silently.
"""

import json
import math
import shlex
import tempfile
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any

from rotor.aero.switches import switched_off
from rotor.assets import SHIPPED_ROTORS
from rotor.command.common import design_from
from rotor.command.parser import build_parser
from rotor.design.blade import airfoils_spec
from rotor.design.design import Design
from rotor.design.twist import (
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TwistLaw,
)
from rotor.files.make_design import make_design

_CALL_WIDTH = 100
"""Characters after which a call is written one argument a line."""
_EXACT = 1e-12
"""Relative tolerance: degrees are read, radians are stored."""
CASE_FILE = "design.json"
"""What a design file is called in a command."""
_WIDTH = 90
"""Characters after which a command goes on in a new line."""


class PythonWriter:
    """Writes frozen values as Python expressions and collects the imports that they need."""

    def __init__(self) -> None:
        self._names: set[tuple[str, str]] = set()

    def name(self, module: str, name: str) -> str:
        """The name, which is added to the imports."""
        self._names.add((module, name))
        return name

    def imports(self) -> list[str]:
        """One line per module."""
        modules = sorted({module for module, _ in self._names}, key=lambda m: (m.startswith("rotor"), m))
        return [
            f"from {module} import {', '.join(sorted(n for m, n in self._names if m == module))}" for module in modules
        ]

    def value(self, value: Any) -> str:
        """An expression that makes `value` to the last digit."""
        if isinstance(value, tuple):
            inside = ", ".join(self.value(item) for item in value)
            return f"({inside},)" if len(value) == 1 else f"({inside})"
        if isinstance(value, str):
            return json.dumps(value, ensure_ascii=False)
        if value is None or isinstance(value, (bool, int)):
            return repr(value)
        if isinstance(value, float):
            return repr(float(value))
        if is_dataclass(value) and not isinstance(value, type):
            given = [one for one in fields(value) if getattr(value, one.name) != _default(one)]
            inside = [f"{one.name}={self.value(getattr(value, one.name))}" for one in given]
            return self.call(self.name(type(value).__module__, type(value).__qualname__), inside)
        raise ValueError(f"{value!r} has no name in Python that a script could use: save the design as a file instead.")

    def changes(self, path: str, start: Any, wanted: Any) -> str:
        """An expression for `wanted` that starts from `path`, which holds `start`; empty when they are equal."""
        if start == wanted:
            return ""
        if type(start) is not type(wanted) or not is_dataclass(wanted):
            return self.value(wanted)
        moved = [
            f"{one.name}={change}"
            for one in fields(wanted)
            if (change := self.changes(f"{path}.{one.name}", getattr(start, one.name), getattr(wanted, one.name)))
        ]
        return self.call(self.name("dataclasses", "replace"), [path, *moved])

    def call(self, name: str, arguments: list[str]) -> str:
        """A call, on one line where that is short enough."""
        line = f"{name}({', '.join(arguments)})"
        if len(line) <= _CALL_WIDTH and "\n" not in line:
            return line
        inside = "".join(f"    {argument},\n".replace("\n", "\n    ").rstrip(" ") for argument in arguments)
        return f"{name}(\n{inside})"


@dataclass(frozen=True)
class CommandLine:
    """A command for a shell, and the design file that it reads where the flags cannot say it all."""

    command: str
    case: str | None = None
    note: str = ""
    """Notes for the reader, one sentence per line."""

    @property
    def text(self) -> str:
        """The whole text, to be pasted into a shell."""
        note = "".join(f"# {line}\n" for line in self.note.splitlines())
        file = "" if self.case is None else f"cat > {CASE_FILE} <<'END'\n{self.case}END\n"
        return f"{note}{file}{self.command}\n"


def as_command_line(design: Design) -> CommandLine:
    """`python -m rotor solve …` for a design, with a design file where the flags do not reach.

    What is returned has been read back to the same design. ValueError with one sentence where neither can hold it.
    """
    flags = _flags(design)
    note = "The twist table is read from a file: run this in its folder.\n" if "table:" in design.twist.spec() else ""
    if _is_read_as(flags, design):
        return CommandLine(_on_lines(["python -m rotor solve", *flags]), None, note)
    case = json.dumps({**design.to_dict(), "twist": exact_spec(design.twist)}, indent=2) + "\n"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, CASE_FILE)
        path.write_text(case, encoding="utf-8")
        if not _is_read_as([f"--case {shlex.quote(str(path))}"], design):
            raise ValueError("Neither flags nor a design file can express this design: copy it as Python.")
    note += "Flags cannot express this design, so it is written to a design file first.\n"
    return CommandLine(f"python -m rotor solve --case {CASE_FILE}", case, note)


def _flags(design: Design) -> list[str]:
    """Flag and value in one string each."""
    condition, plain = design.condition, make_design(preset=design.preset, rotor=design.aircraft)
    words = [f"--rotor {design.aircraft.key}"] if design.aircraft.key not in ("", SHIPPED_ROTORS[0]) else []
    words += [f"--preset {design.preset}"] if design.preset != "flight" else []
    words.append("--hover" if design.hovering else f"--mu {_plain(condition.advance_ratio)}")
    words.append(f"--twist {shlex.quote(exact_spec(design.twist))}")
    if condition.stand is None:
        words.append(f"--mass-kg {_plain(condition.mass)}")
    else:
        words.append(f"--trim {design.models.trim}")
        words += [
            f"--{_FLAGS.get(key, key.replace('_', '-'))} {value}" for key, value in condition.stand.record().items()
        ]
    if condition.altitude:
        words.append(f"--altitude-m {_plain(condition.altitude)}")
    if condition.climb_speed:
        words.append(f"--climb-m-s {_plain(condition.climb_speed)}")
    inflow = "hover_inflow" if design.hovering else "inflow"
    if getattr(design.models, inflow) != getattr(plain.models, inflow):
        words.append(f"--inflow {getattr(design.models, inflow)}")
    if design.models.low_speed != plain.models.low_speed:
        words.append(f"--low-speed {design.models.low_speed}")
    off = switched_off(design.models)
    if off:
        words.append(f"--off {','.join(switch.flag for switch in off)}")
    airfoils = airfoils_spec(design.rotor) if design.rotor != plain.rotor else None
    return [*words, f"--airfoils {shlex.quote(airfoils)}"] if airfoils else words


_FLAGS = {"density_kg_m3": "density"}
"""Flags of the test stand that are not called as the keys of its record."""


def _is_read_as(flags: list[str], design: Design) -> bool:
    """Whether `solve` makes exactly this design from the flags."""
    try:
        args = build_parser().parse_args(["solve", *shlex.split(" ".join(flags))])
        read = design_from(args, args.twist, 0.0 if args.hover else args.mu)
    except ValueError:
        return False
    return same(read, design)


def _plain(value: float) -> str:
    """A number without a needless .0, exact."""
    return repr(int(value)) if value == int(value) else repr(float(value))


def _on_lines(words: list[str]) -> str:
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + len(word) > _WIDTH:
            lines.append("   ")
        lines[-1] += f" {word}"
    return " \\\n".join(lines)


def _twist_of(design: Design, spec: str) -> TwistLaw:
    """The law of a SPEC on this design's rotor at its weight."""
    return make_design(preset=design.preset, rotor=design.aircraft, twist=spec, mass_kg=design.condition.mass).twist


def _aircraft(design: Design, writer: PythonWriter) -> list[str]:
    """The argument for the aircraft; none for the default. A user's own is written out with all its files."""
    files = design.aircraft.files
    if files is None:
        return [] if design.aircraft.key == SHIPPED_ROTORS[0] else [f"rotor={writer.value(design.aircraft.key)}"]
    writer.name("rotor.files.rotor_file", "read_aircraft")
    texts = ", ".join(f"{writer.value(name)}: {writer.value(text)}" for name, text in files.texts)
    return [f"rotor=read_aircraft({writer.value(files.main)}, {{{texts}}})"]


def _test(design: Design) -> dict[str, Any]:
    """The arguments of `make_design` for a test stand; none in flight."""
    stand = design.condition.stand
    return {} if stand is None else {"trim": design.models.trim, "stand": stand.record()}


def as_python(design: Design) -> str:
    """A script that makes the design with `rotor`'s own names, solves it, and prints power by parts and caveats.

    ValueError with one sentence where a part of the design has no name in Python.
    """
    writer, condition = PythonWriter(), design.condition
    writer.name("rotor", "make_design")
    writer.name("rotor", "solve")
    start = make_design(
        preset=design.preset,
        rotor=design.aircraft,
        mu=condition.advance_ratio,
        mass_kg=condition.mass,
        altitude_m=condition.altitude,
        climb_m_s=condition.climb_speed,
        **_test(design),
    )
    spec = exact_spec(design.twist)
    # A SPEC is easier to read; it is used where it is exact and needs no file.
    spoken = "table:" not in spec and _twist_of(design, spec) == design.twist
    arguments = [
        f"preset={writer.value(design.preset)}",
        *_aircraft(design, writer),
        f"twist={writer.value(spec if spoken else design.twist)}",
        f"mu={float(condition.advance_ratio)!r}",
        f"mass_kg={float(condition.mass)!r}",
        f"altitude_m={float(condition.altitude)!r}",
        *([f"climb_m_s={float(condition.climb_speed)!r}"] if condition.climb_speed else []),
        *(f"{name}={value!r}" for name, value in _test(design).items()),
    ]
    made = writer.call("make_design", arguments)
    changed = writer.changes("design", replace(start, twist=design.twist), design)
    return "\n".join(
        [
            f'"""{design.rotor.name}, twist {design.twist.spec()}: trim and power. Units are SI, angles radians."""',
            "",
            *writer.imports(),
            "",
            f"design = {made}",
            *([f"design = {changed}"] if changed else []),
            "solution = solve(design).require()  # RuntimeError with the reason where there is no trim",
            "",
            f"for part in ({', '.join(map(writer.value, _parts(design)))}):",
            '    print(f"{part:<12}{getattr(solution.power, part) / 1e3:14.6f} kW")',
            "for caveat in solution.caveats:",
            '    print("caveat:", caveat.sentence)',
            "",
        ]
    )


def _parts(design: Design) -> list[str]:
    """The powers that a script prints; that of the climb where there is one."""
    climb = ["climb"] if design.condition.climb_speed else []
    return ["total", "main_rotor", "induced", "profile", "parasite", *climb, "tail"]


def _default(one: Field[Any]) -> Any:
    return one.default if one.default is not MISSING else MISSING


def same(first: Any, second: Any) -> bool:
    """Equal, floats to the twelfth digit."""
    if _is_number(first) and _is_number(second):
        return math.isclose(first, second, rel_tol=_EXACT, abs_tol=_EXACT * 1e-3)
    if type(first) is not type(second):
        return False
    if isinstance(first, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    if is_dataclass(first):
        return all(same(getattr(first, one.name), getattr(second, one.name)) for one in fields(first))
    return bool(first == second)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def exact_spec(law: TwistLaw) -> str:
    """A law's SPEC with all digits needed to read it back; `TwistLaw.spec` rounds for people."""
    match law:
        case LinearTwist(rate):
            return f"linear:{degrees(rate)}"
        case QuadraticTwist(curvature, difference):
            return f"quadratic:{degrees(curvature)},{degrees(difference)}"
        case PiecewiseLinearTwist(rates, breaks):
            return f"segments:{_listed(rates)}" + (f"@{','.join(map(_plain, breaks))}" if breaks else "")
        case SplineTwist(stations, angles):
            return f"spline:{_listed(angles)}@{','.join(map(_plain, stations))}"
        case IdealTwist(tip_pitch):
            return f"ideal:{degrees(tip_pitch)}"
        case SumTwist(base, change):
            return f"{exact_spec(base)}+{exact_spec(change)}"
        case _:
            return law.spec()


def degrees(angle: float) -> str:
    """The shortest number of degrees that is `angle` [rad] again; all digits where none is."""
    exact = math.degrees(angle)
    rounded = (round(exact, digits) for digits in range(15))
    return _plain(next((value for value in rounded if math.radians(value) == angle), exact) + 0.0)


def _listed(angles: tuple[float, ...]) -> str:
    return ",".join(map(degrees, angles))
