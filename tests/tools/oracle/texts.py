"""Words about designs: the line, read-outs, status, why power changed, names of designs; in both unit systems."""

from itertools import permutations
from typing import Any

from .designs import all_designs
from .record import Record, named

UNITS = {"SI": "explorer.model.units.SI", "aviation": "explorer.model.units.AVIATION"}
PAIRED = (
    "as built", "hover", "hover, linear", "slow", "fast and heavy", "beyond its trim", "bent", "2/rev twist",
    "2 and 3/rev pitch", "climbing", "fast rotor", "few stations", "thesis", "loss on inflow", "other sections",
    "twist linear:-8", "twist segments:-4,-16,-8@0.4,0.8", "inflow drees", "without compressibility",
    "hover without tip-loss", "bo105", "r22, hover", "free rotor", "tunnel, tilted", "stand, hover",
)  # fmt: skip
"""Designs that are compared with each other, each with each."""


def write(record: Record) -> None:
    """Words of each design, of pairs, and of changes that no design has."""
    units = {name: named(path) for name, path in UNITS.items()}
    solved = dict[str, Any]()
    for name, arguments in all_designs().items():
        design = record.make(f"{name}/design", "rotor.make_design", **arguments)
        analysis = record.make(f"{name}/solution", "rotor.trim.solve.analyse", design)
        if analysis is None:
            continue
        solved[name] = analysis
        describe(record, name, analysis, units)
    compare(record, {name: solved[name] for name in PAIRED if name in solved}, units)


def describe(record: Record, name: str, analysis: Any, units: dict[str, Any]) -> None:
    """What is said of one design and its solution."""
    solution = analysis.solution
    design = solution.design
    text = "explorer.text"
    for words in (
        "wave_words",
        "title_words",
        "twist_name",
        "wave_names",
        "model_words",
        "inflow_words",
        "physics_words",
    ):
        record.ask(f"{name}/{words}", f"{text}.design_words.{words}", design)
    inputs = record.ask(f"{name}/inputs", "explorer.model.inputs.inputs_of", design)
    record.ask(f"{name}/status", f"{text}.status.status_panel", solution)
    record.ask(f"{name}/trim", f"{text}.readout.trim_panel", solution)
    record.ask(f"{name}/part titles", f"{text}.readout.part_titles", design)
    band = record.make(f"{name}/band", "rotor.doubt", analysis) if solution.converged else None
    for title, system in units.items():
        record.ask(
            f"{name}/{title}/flight_words", f"{text}.design_words.flight_words", design, system
        )
        record.ask(
            f"{name}/{title}/flight_name", f"{text}.design_words.flight_name", inputs, system
        )
        record.ask(f"{name}/{title}/flight_pieces", f"{text}.line.flight_pieces", inputs, system)
        record.ask(f"{name}/{title}/twist_pieces", f"{text}.line.twist_pieces", inputs, design)
        record.ask(f"{name}/{title}/sentence", f"{text}.line.sentence", solution, system)
        record.ask(
            f"{name}/{title}/banded sentence", f"{text}.line.sentence", solution, system, None, band
        )
        record.ask(f"{name}/{title}/power", f"{text}.readout.power_panel", solution, None, system)
        record.ask(
            f"{name}/{title}/banded power",
            f"{text}.readout.power_panel",
            solution,
            solution,
            system,
            band,
        )


def compare(record: Record, solved: dict[str, Any], units: dict[str, Any]) -> None:
    """What is said of a design beside another one."""
    text = "explorer.text"
    for (one, before), (other, after) in permutations(solved.items(), 2):
        name = f"{one} > {other}"
        a = before.solution
        b = after.solution
        record.ask(f"{name}/than", f"{text}.line.than_words", b.design, a.design, False)
        record.ask(f"{name}/against", f"{text}.design_words.against", b.design, a.design, False)
        record.ask(f"{name}/cautions", f"{text}.status.cautions", b, a)
        for title, system in units.items():
            record.ask(f"{name}/{title}/why", f"{text}.why.why", a, b, system)
            record.ask(f"{name}/{title}/sentence", f"{text}.line.sentence", b, system, a)
