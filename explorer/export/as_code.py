"""A design as text that runs elsewhere: a short Python script, or a command line. Both give the page's power.

Neither lists what a design may hold. Both start from what `make_design` makes and write down whatever differs, so that
a choice added to `Design` is written too, or refused in a sentence, and never left out in silence.
"""

import json
import shlex
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from explorer.export.code_writer import Writer, exact_spec, same
from rotor.aero.switches import switched_off
from rotor.assets import SHIPPED_ROTORS
from rotor.command.flags import design_from
from rotor.command.parser import build_parser
from rotor.design.blade import airfoils_spec
from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.files.design_file import design_record
from rotor.files.make_design import make_design

CASE_FILE = "design.json"
"""What a design file is called in a command."""
_WIDTH = 90
"""Characters after which a command goes on in a new line."""


@dataclass(frozen=True)
class CommandLine:
    """A command for a shell, and the design file that it reads where the flags cannot say it all."""

    command: str
    case: str | None = None
    note: str = ""
    """What the reader must know; one sentence a line."""

    @property
    def text(self) -> str:
        """All of it, to be pasted into a shell."""
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
    case = json.dumps({**design_record(design), "twist": exact_spec(design.twist)}, indent=2) + "\n"
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
    words += [f"--twist {shlex.quote(exact_spec(design.twist))}", f"--mass-kg {_plain(condition.mass)}"]
    if condition.altitude:
        words.append(f"--altitude-m {_plain(condition.altitude)}")
    if design.models.inflow != plain.models.inflow:
        words.append(f"--inflow {design.models.inflow}")
    off = switched_off(design.models)
    if off:
        words.append(f"--off {','.join(switch.flag for switch in off)}")
    airfoils = airfoils_spec(design.rotor) if design.rotor != plain.rotor else None
    return [*words, f"--airfoils {shlex.quote(airfoils)}"] if airfoils else words


def _is_read_as(flags: list[str], design: Design) -> bool:
    """Whether `solve` makes this very design of the flags."""
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
    """What a SPEC means on this design's rotor at its weight."""
    return make_design(preset=design.preset, rotor=design.aircraft, twist=spec, mass_kg=design.condition.mass).twist


def _aircraft(design: Design, writer: Writer) -> list[str]:
    """The argument that names the aircraft, nothing for the default; a user's own is written out with all its files."""
    files = design.aircraft.files
    if files is None:
        return [] if design.aircraft.key == SHIPPED_ROTORS[0] else [f"rotor={writer.value(design.aircraft.key)}"]
    writer.name("rotor.files.rotor_file", "read_aircraft")
    texts = ", ".join(f"{writer.value(name)}: {writer.value(text)}" for name, text in files.texts)
    return [f"rotor=read_aircraft({writer.value(files.main)}, {{{texts}}})"]


def as_python(design: Design) -> str:
    """A script that makes the design with `rotor`'s own names, solves it, and prints power by parts and caveats.

    ValueError with one sentence where a part of the design has no name in Python.
    """
    writer, condition = Writer(), design.condition
    writer.name("rotor", "make_design")
    writer.name("rotor", "solve")
    start = make_design(
        preset=design.preset,
        rotor=design.aircraft,
        mu=condition.advance_ratio,
        mass_kg=condition.mass,
        altitude_m=condition.altitude,
    )
    spec = exact_spec(design.twist)
    # A SPEC is what people write; it serves where it says the law to the last digit and needs no file.
    spoken = "table:" not in spec and _twist_of(design, spec) == design.twist
    arguments = [
        f"preset={writer.value(design.preset)}",
        *_aircraft(design, writer),
        f"twist={writer.value(spec if spoken else design.twist)}",
        f"mu={float(condition.advance_ratio)!r}",
        f"mass_kg={float(condition.mass)!r}",
        f"altitude_m={float(condition.altitude)!r}",
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
            'for part in ("total", "main_rotor", "induced", "profile", "parasite", "tail"):',
            '    print(f"{part:<12}{getattr(solution.power, part) / 1e3:14.6f} kW")',
            "for caveat in solution.caveats:",
            '    print("caveat:", caveat.sentence)',
            "",
        ]
    )
