"""Compute the answers to the three questions of README.md: `python -m tests.tools.answers` writes docs/answers.json.

From that file `tests.tools.readme` writes the section of the README. The question of actuators is answered twice: as
the page asks it, against the same blade without the actuator, and against the best fixed blade. Powers in W.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

import rotor
from explorer.model.actuator_inputs import ActuatorInputs, verdict_inputs_of, verdict_on
from explorer.model.inputs import OPENING
from rotor.actuator.tables import COMPARED_ACTUATORS, COMPARED_CONCEPTS
from rotor.actuator.verdict import Against, Verdict
from rotor.support.user_input import write_whole
from rotor.validation.thesis.optimum_twist import table_4_1

DATA = Path(__file__).parents[2] / "docs/answers.json"
FLIGHTS: dict[str, dict[str, Any]] = {"hover": {"hover": True}, "fast": {"mu": 0.35}}
"""Conditions of the best linear twist, as of `make_design`."""
SPEEDS = np.arange(8) * 0.05
"""Advance ratios over which twist follows speed."""
LAWS = ("two", "three", "quadratic")
"""Laws that are compared with linear twist, as table 4.1 names them."""


def answers() -> dict[str, Any]:
    """All that README.md says in its answers."""
    return {
        "best_twist": {name: best_twist(name) for name in FLIGHTS},
        "twist_follows_speed": twist_follows_speed(),
        "other_laws": other_laws(),
        "same_blade": actuators("same-blade"),
        "best_fixed": actuators("best-fixed"),
    }


def best_twist(flight: str) -> dict[str, float]:
    """The best linear twist and the ends of its range [°/R]."""
    found = rotor.optimise(rotor.make_design(**FLIGHTS[flight]), "linear")
    assert found.best is not None
    (rate,) = found.best.parameters
    (band,) = found.doubt_band
    angles = {"rate_deg": rate, "low_deg": band.low, "high_deg": band.high}
    return {name: round(math.degrees(angle), 2) for name, angle in angles.items()}


def twist_follows_speed() -> dict[str, float]:
    """What the best twist at each speed saves over the best fixed one, in the mean over `SPEEDS`."""
    found = rotor.schedule(rotor.make_design(), mu=SPEEDS).gain_doubt("linear")
    assert found is not None
    assert found.change is not None
    assert found.change_band is not None
    return {"saving_w": round(-found.change), "band_w": round(found.change_band)}


def other_laws() -> dict[str, float]:
    """The least and the largest saving of `LAWS` over linear twist [%]."""
    savings = [100.0 * table_4_1().numbers[law] for law in LAWS]
    return {"least_percent": round(min(savings), 4), "most_percent": round(max(savings), 4)}


def actuators(against: Against) -> list[dict[str, Any]]:
    """Every combination of actuator and twist law on the blade of the page, the best net saving first."""
    rows = [
        actuator_row(actuator, concept, against)
        for actuator in COMPARED_ACTUATORS
        for concept in COMPARED_CONCEPTS
    ]
    return sorted(rows, key=lambda row: -row["net_saving_w"])


def actuator_row(actuator: str, concept: str, against: Against) -> dict[str, Any]:
    """The net saving of an actuator with its band, and the limits that it exceeds, as the page asks for them."""
    inputs = ActuatorInputs(actuator, concept=concept, against=against)
    return row_of(verdict_on(verdict_inputs_of(inputs, OPENING.design())))


def row_of(verdict: Verdict) -> dict[str, Any]:
    assert verdict.net_band is not None
    return {
        "actuator": verdict.installed.actuator.id,
        "name": verdict.installed.actuator.name,
        "concept": verdict.baseline.concept.name,
        "net_saving_w": round(verdict.net_saving),
        "band_w": round(verdict.net_band),
        "parts_w": {name: round(saving) for name, saving in verdict.savings},
        "mass_kg": round(verdict.installed.masses.aircraft, 1),
        "sourced": verdict.sourced,
        "exceeded": [limit.name for limit in verdict.broken],
    }


def stored() -> dict[str, Any]:
    """The answers as the file has them."""
    return json.loads(DATA.read_text(encoding="utf-8"))


if __name__ == "__main__":
    write_whole(DATA, json.dumps(answers(), indent=1, ensure_ascii=False) + "\n")
