"""Among the trims of one design the answer is that of least power, from a cold start and from any other."""

import math
import os
import random
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import pytest
from numpy.testing import assert_allclose

from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.problem import build_problem
from rotor.assets import SHIPPED_ROTORS
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.forward import first_guess
from rotor.trim.newton import newton
from rotor.trim.solve import SUSPECT_STALL, solve

DEEP_STALL = make_design(
    rotor="s61",
    preset="thesis",
    inflow="local-momentum",
    twist="linear:-6.86",
    mu=0.273,
    mass_kg=11000,
    altitude_m=2021,
)
"""C_W/σ 0.13: Newton's method from momentum theory ends deep in stall."""


def at_mass(design: Design, mass: float) -> Design:
    return replace(design, condition=replace(design.condition, mass=mass))


def test_the_trim_of_least_power_is_found():
    """The same as from a lighter rotor, whose mass is raised step by step."""
    problem = build_problem(DEEP_STALL)
    first = newton(problem, first_guess(problem))
    assert first.converged
    cold = solve(DEEP_STALL)
    assert first.state.collective > cold.controls.collective + math.radians(1.0)  # The trap is still there.
    heavier = None
    for mass in (6500.0, 8000.0, 9500.0, 10000.0, 10490.0, 11000.0):
        heavier = solve(at_mass(DEEP_STALL, mass), heavier)
    assert heavier is not None
    assert_allclose(cold.power.total, heavier.power.total, rtol=1e-6)
    assert cold.stalled_area < SUSPECT_STALL


def test_a_start_deep_in_stall_comes_back():
    problem = build_problem(DEEP_STALL)
    warm = solve(DEEP_STALL, newton(problem, first_guess(problem)).guess)
    assert_allclose(warm.power.total, solve(DEEP_STALL).power.total, rtol=1e-6)


def test_attached_flow_is_solved_without_a_further_pass(monkeypatch: pytest.MonkeyPatch):
    def never(*_: object) -> None:
        raise AssertionError("continuation was not needed")

    monkeypatch.setattr("rotor.trim.solve.trim_along", never)
    for mu in (0.1, 0.2, 0.3):
        assert solve(make_design(mu=mu)).converged


def any_design(seed: int) -> Design:
    """A random design of the envelope, and a little beyond it."""
    draw = random.Random(seed)
    rotor, preset = draw.choice(SHIPPED_ROTORS[:3]), draw.choice(("flight", "thesis"))
    mass = make_design(rotor=rotor).condition.mass
    twist = draw.choice(
        (f"linear:{draw.uniform(-20, 5):.3f}", f"segments:{draw.uniform(-20, 5):.3f},{draw.uniform(-20, 5):.3f}@0.5")
    )
    return make_design(
        rotor=rotor,
        preset=preset,
        twist=twist,
        mu=draw.choice((0.0, draw.uniform(0.02, 0.4))),
        mass_kg=mass * draw.uniform(0.5, 1.4),
        altitude_m=draw.uniform(0.0, 4000.0),
        inflow=draw.choice(list(INFLOW_MODELS)),
    )


def walked_to(design: Design) -> bool:
    """Whether a refused design is trimmed by walking to it, from a lighter aircraft and from another µ.

    A trim with most of the disk stalled does not count: polynomials, held beyond their range, have such trims, at
    several times the power of any attached flow.
    """
    mass, mu = design.condition.mass, design.condition.advance_ratio
    by_mass = [at_mass(design, max(part * mass, 100.0)) for part in (0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.94, 0.97, 0.985)]
    by_mu = [design.at(mu=mu + (0.15 - mu) * part) for part in (1.0, 0.8, 0.6, 0.45, 0.3, 0.2, 0.1, 0.05)]
    for steps in (by_mass, by_mu if mu > 0.0 else []):
        last = None
        for step in (*steps, design):
            last = solve(step, last)
            if not last.converged:
                break
        if last is not None and last.converged and last.stalled_area < 0.5:
            return True
    return False


def complaints(seed: int) -> tuple[bool, list[str]]:
    """Whether one random design is trimmed, and what is wrong with the answer: nothing, as it should be."""
    try:
        design = any_design(seed)
        cold = solve(design)
        if not cold.converged:
            found = [] if cold.message.startswith("Not trimmed") else [f"{seed}: {cold.message!r} is no reason"]
            return False, [*found, f"{seed}: refused, but continuation trims it"] if walked_to(design) else found
        found = list[str]()
        if not math.isfinite(cold.power.total):
            found.append(f"{seed}: power is {cold.power.total}")
        near = solve(at_mass(design, max(0.98 * design.condition.mass, 100.0)), cold)
        warm = solve(design, near)
        if not warm.converged:
            found.append(f"{seed}: warm start does not trim what a cold one does")
        elif abs(warm.power.total / cold.power.total - 1.0) > 1e-6:
            found.append(f"{seed}: warm {warm.power.total:.1f} W, cold {cold.power.total:.1f} W")
        return True, found
    except Exception as error:
        return False, [f"{seed}: {type(error).__name__}: {error}"]


@pytest.mark.slow
def test_random_designs_trim_alike_from_anywhere_or_say_why_not():
    """Some minute's work, the same on every machine; ROTOR_DESIGNS asks for more, from ROTOR_FIRST_DESIGN."""
    wanted, first = int(os.environ.get("ROTOR_DESIGNS", "600")), int(os.environ.get("ROTOR_FIRST_DESIGN", "0"))
    begun, tried, trimmed = time.monotonic(), 0, 0
    found: list[str] = []
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        while tried < wanted:
            for converged, wrong in pool.map(complaints, range(first + tried, first + tried + 100), chunksize=10):
                trimmed += converged
                found += wrong
            tried += 100
            print(
                f"{tried} designs, {trimmed} trimmed, {len(found)} wrong, {time.monotonic() - begun:.0f} s", flush=True
            )
    assert found == []
    assert trimmed > tried / 2
