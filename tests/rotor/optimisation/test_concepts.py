"""Twist concepts: laws, exact slopes, restriction, nearest law, SPEC and design file there and back."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import load_design, make_design, parse_twist, solve
from rotor.airfoil.polynomial import THESIS_READING
from rotor.design.blade import airfoils_spec
from rotor.design.twist import LinearTwist, QuadraticTwist, SplineTwist
from rotor.optimisation.concepts import CONCEPTS, Concept, find_concept, nearest, on_top, restrict

R = np.linspace(0.141, 0.989, 40)
EVERY = pytest.mark.parametrize("concept", CONCEPTS.values(), ids=CONCEPTS)


def somewhere(concept: Concept, seed: int = 3) -> np.ndarray:
    """Values well inside the bounds."""
    low, high = np.array([(parameter.low, parameter.high) for parameter in concept.parameters]).T
    return low + (high - low) * np.random.default_rng(seed).uniform(0.2, 0.8, len(low))


@EVERY
def test_the_law_round_trips_and_has_its_slopes_and_rates(concept: Concept):
    values, step = somewhere(concept), 1e-6
    measured = [
        (concept.twist(values + step * e)(R) - concept.twist(values - step * e)(R)) / (2 * step)
        for e in np.eye(len(values))
    ]
    assert_allclose(concept.slopes(values, R), measured, atol=1e-9)
    law = concept.twist(somewhere(concept))
    assert_allclose(law(0.75), 0.0, atol=1e-15)
    back = parse_twist(law.spec(), builtin=law)
    assert_allclose(back(R), law(R), atol=1e-7)
    assert back.spec() == law.spec()


@EVERY
def test_rates_agree_with_the_law(concept: Concept):
    """The steepest and the flattest rate that the rows give bound the law's own."""
    values = somewhere(concept, seed=11)
    rates = np.array(concept.rate_rows) @ values
    r = np.linspace(0.0 if concept.name == "quadratic" else 0.13, 1.0, 2001)
    measured = np.diff(concept.twist(values)(r)) / np.diff(r)
    room = 0.01 * (rates.max() - rates.min()) if concept.name == "free-form" else 1e-9
    assert rates.min() - room <= measured.min() + 1e-9
    assert measured.max() - 1e-9 <= rates.max() + room


@EVERY
def test_nearest_recovers_a_law_of_the_concept(concept: Concept):
    law = concept.twist(somewhere(concept))
    found = nearest(concept, law)
    assert_allclose(concept.twist(found)(R), law(R), atol=2e-4)


def test_the_spline_contains_linear_and_quadratic_laws():
    knots = (0.13, 0.3, 0.46, 0.61, 0.75, 0.88, 1.0)
    for law in (LinearTwist(-0.2), QuadraticTwist(0.1, -0.25)):
        assert_allclose(SplineTwist(knots, tuple(law(knots).tolist()))(R), law(R), atol=1e-14)


def test_derivative_by_a_break_is_the_jump_of_rate_outboard_of_it():
    """Hand calculation: rates −4 and −20 °/R, break 0.8: a step db outward lifts the tip by 16° db."""
    values = [math.radians(-4.0), math.radians(-20.0), 0.8]
    by_break = find_concept("two-segment-free").slopes(values, np.array([0.5, 0.79, 0.81, 1.0]))[2]
    assert_allclose(np.degrees(by_break), [0.0, 0.0, 16.0, 16.0], atol=1e-12)


def test_two_airfoils_change_the_blade_and_are_kept_in_a_design_file(tmp_path: Path):
    concept = find_concept("two-segment-two-airfoils", [0.6])
    design = concept.apply(make_design(mu=0.25), [math.radians(-8.0), math.radians(-14.0)])
    assert airfoils_spec(design.rotor) == "sc1094r8,sc1095@0.6"
    # Nothing else changes.
    assert replace(design.rotor.blade, spans=(own := make_design().rotor.blade).spans) == own
    design.save(tmp_path / "design.json")
    back = load_design(tmp_path / "design.json")
    assert back.rotor == design.rotor
    assert_allclose(solve(back).power.total, solve(design).power.total, rtol=1e-8)
    thesis = concept.apply(make_design(preset="thesis"), [0.0, 0.0])
    assert airfoils_spec(thesis.rotor) == f"sc1094r8,{THESIS_READING.name}@0.6"


def test_restricted_parameters_are_fixed():
    free = find_concept("two-segment-free")
    held = restrict(free, {"inboard_rate": -0.1})
    assert [parameter.name for parameter in held.parameters] == ["outboard_rate", "division"]
    assert held.twist([-0.3, 0.6]) == free.twist([-0.1, -0.3, 0.6])
    assert_allclose(held.slopes([-0.3, 0.6], R), free.slopes([-0.1, -0.3, 0.6], R)[1:])
    assert find_concept("two-segment", [0.7]).twist([-0.1, -0.2]) == free.twist([-0.1, -0.2, 0.7])
    assert (
        find_concept("three-segment", [0.3, 0.5])
        .twist([0.0, -0.1, -0.2])
        .spec()
        .endswith("@0.3,0.5")
    )


def test_a_change_added_to_a_fixed_law():
    design = make_design()
    concept = on_top(CONCEPTS["two-segment-two-airfoils"], design.twist)
    values = [math.radians(-2.0), math.radians(1.0)]
    changed = concept.apply(design, values)
    assert changed.twist.spec() == "uh60a+segments:-2,1@0.5"
    assert airfoils_spec(changed.rotor) == "sc1094r8,sc1095@0.5"
    assert_allclose(changed.twist(R) - design.twist(R), CONCEPTS[concept.name].twist(values)(R))
    assert_allclose(
        nearest(on_top(CONCEPTS["linear"], design.twist), design.twist), [0.0], atol=1e-9
    )
    law = parse_twist("linear:+3+uh60a", builtin=design.twist)
    assert_allclose(law(R), math.radians(3.0) * (R - 0.75) + design.twist(R))
