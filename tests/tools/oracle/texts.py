"""Words about designs: the line, read-outs, status, why power changed, names of designs; in both unit systems."""

from collections.abc import Mapping
from itertools import permutations
from typing import Any

import numpy as np

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

DRAWN = 300
"""Changes of power with their bands that are drawn."""
BAD_LINKS = (
    "",
    "2;linear:-8",
    "1",
    "1;linaer:-8",
    "1;linear:-8;mu=9",
    "1;linear:-8;speed=3",
    "x" * 50,
)
VIEWS: tuple[Mapping[str, Any], ...] = (
    {}, {"field": "Mach number"}, {"units": "Aviation", "stall": False}, {"exaggeration": 2.0, "wake": False},
    {"difference": True, "reverse_flow": False, "drag_divergence": False},
)  # fmt: skip


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
        record.scenario(name, describe, name, analysis, units)
    record.scenario(
        "pairs", compare, {name: solved[name] for name in PAIRED if name in solved}, units
    )
    record.scenario("changes", describe_changes, units)
    record.scenario("help", explain)
    record.scenario("lecture", lecture, units)
    record.scenario("links", links)


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


def explain(record: Record) -> None:
    """The glossary, and every help that a control or a read-out has."""
    for table in ("CONTROLS", "READOUTS", "SECTIONS", "COLUMNS", "MEASURED"):
        record.keep(table.lower(), named(f"explorer.text.glossary.{table}"))
    for name in named("explorer.text.glossary.CONTROLS"):
        record.ask(f"hint {name}", "explorer.text.glossary.hint", name)
    for name in named("explorer.text.glossary.READOUTS"):
        record.ask(f"tip {name}", "explorer.text.glossary.tip", name)
    record.ask("trust page", "explorer.text.status.trust_page")
    record.ask("coverage", "explorer.text.line.coverage_words")


def lecture(record: Record, units: Mapping[str, Any]) -> None:
    """Every step of the lecture: its words, its facts, and what it says to each guess."""
    for number, step in enumerate(named("explorer.story.steps.STEPS")):
        name = f"lecture {number} {step.name}"
        record.keep(f"{name}/text", step.text)
        facts = record.ask(f"{name}/facts", "explorer.story.facts.facts_of", step)
        for title, system in units.items():
            record.ask(
                f"{name}/{title}/before", "explorer.story.records.step_record", step, None, system
            )
            record.ask(
                f"{name}/{title}/step", "explorer.story.records.step_record", step, facts, system
            )
            record.ask(
                f"{name}/{title}/answer",
                "explorer.story.records.answer_record",
                step,
                facts,
                system,
            )


def describe_changes(record: Record, units: Mapping[str, Any]) -> None:
    """Keep what is said of drawn changes and bands of power, as no two designs have them; of masses and lists."""
    draw = np.random.default_rng(7)
    for number in range(DRAWN):
        change = float(draw.normal(0.0, 3e4))
        band = None if draw.random() < 0.2 else float(abs(draw.normal(0.0, 2e4)))
        known, sourced, built = (bool(draw.random() < 0.5) for _ in range(3))
        for title, system in units.items():
            name = f"change {number}/{title}"
            line = record.make(
                name, "explorer.text.line.change_pieces", change, band, "A", 1e6, system, known, " x",
                sourced=sourced, built=built,
            )  # fmt: skip
            record.keep(f"{name}/pieces", line)
            record.ask(f"{name}/plain", "explorer.text.line.plain", line, "note")
            record.ask(f"{name}/sizes", "explorer.text.readout.change_sizes", change, band, system)
            record.ask(
                f"{name}/total", "explorer.text.readout.total_words", 1e6 + 10.0 * change, system
            )
            if band is not None:
                record.ask(
                    f"{name}/banded",
                    "explorer.text.readout.banded",
                    change,
                    band,
                    system,
                    sourced=sourced,
                )
                record.ask(
                    f"{name}/needs",
                    "explorer.text.readout.needs_words",
                    change,
                    band,
                    system,
                    sourced,
                )
                record.ask(
                    f"{name}/digits", "explorer.text.readout.digits_of", change, system, band
                )
        record.ask(f"change {number}/tiny", "explorer.text.status.tiny", abs(change) * 1e-9)
        record.ask(
            f"change {number}/kilograms", "explorer.text.readout.kilograms", abs(change) * 1e-3
        )
    for names in ((), ("a",), ("a", "b"), ("a", "b", "c")):
        record.ask(f"listed {len(names)}", "explorer.text.design_words.listed", names)
        record.ask(f"over {len(names)}", "explorer.text.line.over_pieces", names)


def links(record: Record) -> None:
    """Designs and views as the address of the page holds them, and back; and what is no link."""
    for name, arguments in all_designs().items():
        design = record.make(f"{name}/linked", "rotor.make_design", **arguments)
        code = record.ask(f"{name}/link", "explorer.sharing.share.code_of", design)
        if code is not None:
            record.ask(
                f"{name}/link read",
                lambda code=code: str(named("explorer.sharing.share.design_from")(code)),
            )
            record.ask(f"{name}/link inputs", "explorer.sharing.share.inputs_from", code)
    for code in BAD_LINKS:
        record.ask(f"bad link {code}", "explorer.sharing.share.inputs_from", code)
    view = named("explorer.model.inputs.ViewState")
    for number, changes in enumerate(VIEWS):
        code = record.ask(f"view {number}", "explorer.sharing.share.view_code", view(**changes))
        record.ask(f"view {number} read", "explorer.sharing.share.view_from", code or "")
