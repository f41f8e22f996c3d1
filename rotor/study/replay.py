"""A row of a study as a design again, with the blade that was set or found there."""

import math
from typing import Any

from rotor.design.design import Design
from rotor.study.point import design_of
from rotor.study.quantities import PLAIN, QUANTITIES, Value, blade_concept
from rotor.study.results import Results


def design_of_row(results: Results, row: int) -> Design:
    """The design of a row (0 upward). ValueError for one that has no blade, or is of a rotor file that is not here."""
    given: dict[str, Any] = results.about.get("given", {})
    values: dict[str, Value] = {name: value for name, value in given.items() if name in PLAIN}
    values |= {name: results.columns[name][row] for name in results.axes if name in PLAIN}
    blade = {
        name: float(results.columns[name][row])
        for name in results.columns
        if name in QUANTITIES and name not in PLAIN and math.isfinite(results.columns[name][row])
    }
    design = design_of({name: value for name, value in values.items() if name != "concept"}, {})
    if "concept" not in values:
        return design
    concept, held = blade_concept(str(values["concept"]), blade)
    if len(held) < len(concept.parameters):
        raise ValueError(f"point {row} found no blade: choose another one")
    return concept.apply(design, [held[one.name] for one in concept.parameters])
