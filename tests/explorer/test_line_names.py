"""The line names all that decides its power: each input that moves the power changes the words before it."""

import math
import re
from collections.abc import Iterator
from dataclasses import fields, replace
from functools import cache
from typing import Any

import pytest

from explorer.model.actuator_inputs import ActuatorInputs, HandSettings
from explorer.model.inputs import (
    INFLOW_MENUS,
    LAWS,
    OPENING,
    TWISTS,
    Inputs,
)
from explorer.model.sliders import SLIDERS
from explorer.model.stand import StandInputs
from explorer.model.units import AVIATION, SI, Units
from explorer.text.line import (
    blade_pieces,
    design_pieces,
    flight_pieces,
    over_pieces,
    plain,
    sentence,
)
from explorer.views.line import line, line_text
from explorer.views.page_state import OpenPanels, PageState
from rotor import Design
from rotor.actuator import with_actuator
from rotor.design import Harmonic, TableTwist
from rotor.design.quantities import OPTIONS, SWITCHES
from rotor.files.rotor_file import shipped_aircraft
from rotor.trim.solve import solve
from tests.actuate import actuate

COARSE = replace(OPENING, elements=16, azimuths=24, inflow="drees")
"""Quick to trim."""
CHANGED = replace(COARSE, built_outer=-2.0)
HOVER = replace(COARSE, advance_ratio=0.0)
SLOW = replace(COARSE, advance_ratio=0.05)
TUNNEL = replace(COARSE, stand=StandInputs("wind-tunnel", value=0.08))
CONTROLS = replace(
    COARSE, stand=StandInputs("controls", "collective_deg", 8.0, flapping="free", tip_mach=0.6)
)
HUB = replace(COARSE, stand=StandInputs("wind-tunnel", value=0.08, flapping="hub-moments"))
THESIS = replace(COARSE, preset="thesis", inflow="coleman", hover_inflow="closed-form")
TABLE = TableTwist((0.15, 0.6, 1.0), (0.14, 0.02, -0.1))
STEEP = TableTwist((0.15, 0.6, 1.0), (0.16, 0.02, -0.12))
STARTS = {
    "flight": COARSE,
    "changed": CHANGED,
    "hover": HOVER,
    "slow": SLOW,
    "tunnel": TUNNEL,
    "controls": CONTROLS,
    "hub moments": HUB,
    "thesis": THESIS,
    **{law: replace(COARSE, law=law, given=TABLE, optimised=TABLE) for law in LAWS},
}
SHAPE = (0.13, 0.6, 1.0), (0.0, 0.2, 1.0)
LATER = {
    "stand": {
        "trim": ["controls"],
        "load": [],
        "value": [0.085],
        "shaft_tilt_deg": [5.0, -5.0],
        "cyclic_1c_deg": [2.0],
        "cyclic_1s_deg": [-2.0],
        "flapping": ["free"],
        "hub_roll_nm": [900.0],
        "hub_pitch_nm": [900.0],
        "tip_mach": [0.55],
        "density": [1.0],
    }
}
"""Other values of the fields of a test."""


def others(start: Inputs) -> Iterator[tuple[str, Inputs]]:
    """These inputs with one of their fields changed, as far as a hand, a link or a file can: its name and they."""
    brought = replace(shipped_aircraft("r22"), name="My rotor", key="")
    values: dict[str, list[Any]] = {
        "rotor": ["bo105"],
        "own_rotor": [brought],
        "law": list(LAWS),
        "given": [TABLE, STEEP],
        "optimised": [TABLE, STEEP],
        "airfoils": ["naca0012"],
        "pitch_per_rev": [(Harmonic(2, 0.01, 0.0),), (Harmonic(2, 0.01, 1.0),)],
        "twist_per_rev": [(Harmonic(2, 0.01, 0.0),), (Harmonic(2, 0.01, 1.0),)],
        "active_shape": [SHAPE],
        "elements": [20],
        "azimuths": [36],
        "preset": ["thesis", "flight"],
        "drag_area_m2": [2.0],
        **{name: list(titles) for name, titles in INFLOW_MENUS.items()},
        **{name: [not getattr(start, name)] for name in (*SWITCHES, *OPTIONS)},
    }
    for name, form in SLIDERS.items():
        now = getattr(start, name)
        values[name] = [now + 3.0 * form.step, now - 3.0 * form.step]
    for field in fields(Inputs):
        if field.name == "stand":
            continue
        for value in values.pop(field.name):
            changed = replace(start, **{field.name: value})
            if changed != start:
                yield field.name, changed
    assert not values, "no such input"
    if start.stand is None:
        yield "stand", TUNNEL
        return
    tested = dict(LATER["stand"])
    for field in fields(StandInputs):
        for value in tested.pop(field.name):
            if field.name == "trim":
                yield field.name, replace(start, stand=start.stand.with_trim(value))
            else:
                yield field.name, replace(start, stand=replace(start.stand, **{field.name: value}))
    assert not tested


@cache
def power_of(design: Design) -> float | None:
    """Power [W]; None where it has no trim."""
    solution = solve(design)
    return solution.power.total if solution.converged else None


def named(inputs: Inputs, units: Units = SI) -> str:
    """The line before its power."""
    return plain(flight_pieces(inputs, units) + blade_pieces(inputs, inputs.design()))


def moves(before: Design, after: Design) -> bool:
    """Whether the power of one is not that of the other."""
    one, other = power_of(before), power_of(after)
    return one is not None and other is not None and not math.isclose(one, other, rel_tol=1e-6)


@pytest.mark.parametrize("name", STARTS)
def test_an_input_that_moves_the_power_changes_the_words_before_it(name: str):
    start = STARTS[name]
    moved = set[str]()
    silent = set[str]()
    for field, changed in others(start):
        try:
            after = changed.design()
        except ValueError:
            continue
        if not moves(start.design(), after):
            continue
        moved.add(field)
        if named(changed) == named(start):
            silent.add(field)
    assert silent == set()
    assert len(moved) > 10


# In Actuate

DRIVEN = ActuatorInputs(drives=(60.0,) * 5)
LAYOUTS: dict[str, list[Any]] = {
    "actuator": ["AFC", "SMA_tube"],
    "plies": [3],
    "span": [(0.3, 0.9)],
    "chord": [(0.1, 0.8)],
    "blade": ["new"],
    "stiffness": [0.7],
    "concept": ["two-segment", "three-segment", "quadratic"],
    "against": ["best-fixed"],
    "hours": [(0.5, 0.25, 0.0, 2.0)],
    "drives": [(50.0,) * 5, (60.0, 50.0, 60.0, 60.0, 60.0)],
    "crossed": [True],
}
"""Other values of each field of the actuator."""


def acted(inputs: Inputs, actuator: ActuatorInputs) -> tuple[Design, str]:
    """The design that flies, and the line before its power."""
    hand = HandSettings(actuator, on_board=True)
    now = PageState(inputs, inputs.design(), None, ui=OpenPanels("actuate"), hand=hand)
    return hand.fit(inputs.design()), plain(line(now).pieces)


@pytest.mark.parametrize(
    "start",
    [
        DRIVEN,
        replace(DRIVEN, blade="new"),
        replace(DRIVEN, concept="two-segment"),
        ActuatorInputs("SMA_tube", drives=(60.0,) * 5),
    ],
    ids=["retrofit", "new blade", "two segments", "tube"],
)
def test_so_does_each_setting_of_an_actuator(start: ActuatorInputs):
    design, words = acted(COARSE, start)
    moved = set[str]()
    for field in fields(ActuatorInputs):
        for value in LAYOUTS[field.name]:
            after, other = acted(COARSE, replace(start, **{field.name: value}))
            if moves(design, after):
                moved.add(field.name)
                assert other != words, (field.name, value)
    assert moved >= {"actuator", "plies", "span", "drives", "crossed"}


@pytest.mark.parametrize("name", ["changed", "linear", "three", "given"])
def test_in_actuate_each_input_of_the_blade_is_named_too(name: str):
    start = STARTS[name]
    design, words = acted(start, DRIVEN)
    moved = set[str]()
    for field, changed in others(start):
        if field in TWISTS or field in ("law", "mass_t", "given", "twist_per_rev", "tip_loss"):
            after, other = acted(changed, DRIVEN)
            if moves(design, after):
                moved.add(field)
                assert other != words, field
    assert {"law", "mass_t"} < moved


def test_mass_as_flown_stands_in_two_parts():
    now = actuate(OPENING, actuator=DRIVEN)
    assert now.state is not None
    flown = now.state.solution.design.condition.mass
    carried = now.state.solution.design.rotor.blade.carried
    assert carried is not None
    assert line_text(now).startswith(
        "The UH-60A of 8.32 + 0.13 t at µ 0.200 (159 km/h), twist as built, with MFC P1 at 60"
    )
    assert flown == pytest.approx(8320.0 + 130.0, abs=10.0)
    for units, size in ((SI, 1e3), (AVIATION, 0.45359237)):
        words = plain(design_pieces(now.state.solution.design, units)).replace("\u2009", "")
        found = re.search(r" of ([\d.]+) \+ ([\d.]+) (?:t|lb) at ", words)
        assert found is not None
        parts = [float(one) for one in found.groups()]
        assert size * sum(parts) == pytest.approx(flown, abs=0.01 * size if units is SI else size)
    assert " + " not in line_text(replace(now, ui=OpenPanels("explore")))


# What the number is compared with has its power


def test_what_it_is_compared_with_stands_there_with_its_power():
    built, changed = solve(OPENING.design()), solve(replace(OPENING, built_outer=-2.0).design())
    powers = [f"{1e-3 * one.power.total:.0f}" for one in (built, changed)]
    words = sentence(changed, SI, built)
    assert f" needs {powers[1]} kW: " in words
    assert words.endswith(f" than as built ({powers[0]}).")
    carried = solve(with_actuator(OPENING.design(), "MFC_P1,drive=60"))
    words = sentence(carried, SI, built)
    assert words.endswith(f" than without it ({powers[0]}).")


def test_many_effects_and_many_limits_are_counted_and_named_in_the_tooltip():
    off = replace(OPENING, tip_loss=False, swirl=False)
    assert ", no tip loss, no swirl, needs" in sentence(solve(off.design()), SI)
    (piece,) = [
        one for one in blade_pieces(replace(off, stall=False), None) if one.part == "models"
    ]
    assert (piece.text, piece.title) == (
        ", 3 effects switched",
        "No tip loss, no swirl and no stall.",
    )
    (two,) = over_pieces(["voltage", "mass"])
    assert two.text == "; over its limits in voltage and mass"
    (many,) = over_pieces(["voltage", "fibre strain", "mass"])
    assert (many.text, many.title) == (
        "; over 3 limits",
        "Over its limits in voltage, fibre strain and mass.",
    )
