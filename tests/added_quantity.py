"""Run in a copy of the sources that has one quantity more, `warmer_k`: finds it wherever quantities are.

By `tests/rotor/design/test_added_quantity.py`, which makes the copy.
"""

# A type checker does not know the quantity.
# pyright: reportCallIssue=false, reportAttributeAccessIssue=false

import argparse
import contextlib
import csv
import inspect
import io
import json
import tempfile
from dataclasses import fields, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import viser

import explorer
import rotor
from explorer.export.provenance import condition_line, file_stem
from explorer.export.tables import conditions
from explorer.model.inputs import OPENING, ROWS, Inputs, inputs_of, with_rotor
from explorer.model.session_state import Pinned, same_but_flight
from explorer.model.sliders import SLIDERS, flight_sensitivities, limits
from explorer.model.undo import History, PowerTracker, differing
from explorer.model.units import AVIATION, SI
from explorer.sharing.share import code_of, inputs_from
from explorer.tabs.controls import DesignControls, SessionCallbacks
from explorer.text.design_words import flight_name, flight_words
from explorer.text.glossary import hint
from explorer.text.why import why
from rotor.__main__ import main
from rotor.command.common import add_design_arguments
from rotor.command.common import design_from as design_from_flags
from rotor.files.design_file import load_design
from rotor.optimisation.objective import read_mission
from rotor.study.chunks import evaluate_points
from rotor.study.study import columns_of
from rotor.study.study_file import parse_study

NAME, VALUE = "warmer_k", 15.0
SMALL: dict[str, Any] = {"elements": 12, "azimuths": 24, "inflow": "drees"}
HERE = Path(tempfile.mkdtemp())


def said(*command: str) -> str:
    """What a command prints."""
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.suppress(SystemExit):
        main(list(command))
    return out.getvalue()


def refused(make: Any) -> str:
    """The sentence of the ValueError that comes."""
    try:
        make()
    except ValueError as error:
        return str(error)
    raise AssertionError("it was taken")


def in_python() -> None:
    """Argument, its words and its limits; meaning; JSON, CSV and reports."""
    design, plain = rotor.make_design(warmer_k=VALUE, **SMALL), rotor.make_design(**SMALL)
    assert design.condition.warmer == VALUE
    assert plain.at(warmer_k=VALUE) == design
    for function in (rotor.make_design, rotor.Design.at, rotor.sweep):
        assert NAME in inspect.signature(function).parameters
    assert "warmer_k: air warmer than that of the standard atmosphere" in (rotor.make_design.__doc__ or "")
    assert "warmer_k: warmer air [K]." in (rotor.sweep.__doc__ or "")
    assert "warmer air 50 K is outside -40…40 K" in refused(lambda: rotor.make_design(warmer_k=50))
    assert "warmer 15 K" in repr(design)
    solution = rotor.solve(design).require()
    assert solution.power.total != rotor.solve(plain).power.total
    assert solution.to_dict()[NAME] == VALUE
    assert NAME not in rotor.solve(plain).to_dict()
    table = rotor.sweep(plain, warmer_k=[0, VALUE])
    assert table.to_dict()[NAME] == [0.0, VALUE]
    table.to_csv(HERE / "sweep.csv")
    with (HERE / "sweep.csv").open(encoding="utf-8") as file:
        assert [float(row[NAME]) for row in csv.DictReader(file)] == [0.0, VALUE]


def in_commands() -> None:
    """Flag, help, report and JSON of `solve`, and a sweep."""
    assert "--warmer-k" in said("solve", "--help")
    parser = argparse.ArgumentParser()
    add_design_arguments(parser)
    flags = parser.parse_args([f"--warmer-k={VALUE}", "--inflow=drees", "--elements=12", "--azimuths=24"])
    assert design_from_flags(flags, mu=0.2) == rotor.make_design(warmer_k=VALUE, **SMALL)
    command = ("solve", "--inflow=drees", "--elements=12", "--azimuths=24", f"--warmer-k={VALUE}")
    assert "warmer 15 K" in said(*command)
    assert json.loads(said(*command, "--json"))[NAME] == VALUE


def in_files() -> None:
    """Key of a design file, word of a link, axis of a study, column of a mission."""
    design = rotor.make_design(warmer_k=VALUE, **SMALL)
    assert design.to_dict()[NAME] == VALUE
    assert NAME not in rotor.make_design(**SMALL).to_dict()
    design.save(HERE / "design.json")
    assert load_design(HERE / "design.json") == design
    code = code_of(design)
    assert ";isa=15" in code
    assert inputs_from(code).design().condition == design.condition
    assert "outside this page's -30…30" in refused(lambda: inputs_from(code.replace("isa=15", "isa=35")))
    study = parse_study(
        "[axes]\nwarmer_k = [0, 15]\n[fixed]\nmu = 0.2\n[models]\ninflow = 'drees'\nelements = 12\nazimuths = 24"
    )
    assert next(column.unit for column in columns_of(study) if column.name == NAME) == "K"
    rows = evaluate_points(study, 0, 2)
    assert [row[NAME] for row in rows] == [0.0, VALUE]
    assert rows[0]["power_total_w"] != rows[1]["power_total_w"]
    (HERE / "mission.csv").write_text(f"mu,{NAME}\n0.2,{VALUE}\n", encoding="utf-8")
    assert read_mission(HERE / "mission.csv", rotor.make_design(**SMALL))[0].flight == design.condition


def as_values() -> None:
    """Input, slider, units, tooltip, sensitivity; words of undo, A and B, reports."""
    assert NAME in {item.name for item in fields(Inputs)}
    warm = replace(OPENING, inflow="drees", **{NAME: VALUE})
    plain = replace(OPENING, inflow="drees")
    assert warm.design().condition.warmer == VALUE
    assert inputs_of(warm.design()) == warm
    assert SLIDERS[NAME].label == "Warmer [K]"
    assert limits(NAME) == (-30.0, 30.0)
    assert hint(NAME) == "Air warmer than that of the standard atmosphere. Theory, section 2."
    assert differing(plain, warm) == {NAME}
    history = History(plain)
    assert history.note(warm, 1.0)
    assert history.undo() == plain
    assert "warmer 15.0 K" in flight_name(warm)
    assert "colder 27 °F" in flight_name(replace(warm, **{NAME: -VALUE}), AVIATION)
    solution, reference = rotor.solve(warm.design()), rotor.solve(plain.design())
    assert "warmer 15.0 K" in flight_words(solution.design)
    assert "warmer 15 K" in condition_line(solution.design)
    assert "isa15" in file_stem(solution.design)
    assert "15.0 K · 27 °F" in conditions(solution)
    assert "warmer 15.0 k" in why(reference, solution).lower()
    assert "standard air" in why(solution, reference).lower()
    assert NAME in flight_sensitivities(solution)
    assert same_but_flight(plain, warm)
    assert getattr(Pinned(plain, reference).sliders(warm, along=True), NAME) == VALUE
    assert getattr(with_rotor(warm, "bo105"), NAME) == VALUE


def on_the_page() -> None:
    """The widget: place, units, read, hold."""
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        bridge: Any = SimpleNamespace(on=lambda *_: None)
        callbacks = SessionCallbacks(lambda: None, lambda: None, lambda: None)
        controls = DesignControls(server.gui, bridge, OPENING, PowerTracker(), callbacks)
        handle = controls._form._handles[NAME]
        assert (handle.label, handle.min, handle.max) == ("Warmer [K]", -30.0, 30.0)
        assert not handle.visible  # Folded while it stands at its default.
        handle.value = 10.0
        assert getattr(controls.inputs(), NAME) == 10.0
        warm = replace(OPENING, **{NAME: VALUE})
        controls.set_inputs(warm)
        assert handle.value == VALUE
        controls.refresh(warm, AVIATION)
        assert handle.visible
        assert (handle.label, round(handle.value, 6)) == ("Warmer [°F]", 27.0)
        assert controls.inputs() == warm
        controls.refresh(warm, SI)
        assert (handle.label, handle.value) == ("Warmer [K]", VALUE)
        controls.hold(True)
        assert handle.disabled
    finally:
        server.stop()


if __name__ == "__main__":
    for package in (rotor, explorer):
        assert Path(str(package.__file__)).is_relative_to(Path.cwd())
    assert NAME in ROWS
    for part in (in_python, in_commands, in_files, as_values, on_the_page):
        part()
    print(f"found everywhere below {Path.cwd()}")
