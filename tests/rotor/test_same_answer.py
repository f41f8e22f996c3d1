"""An answer depends on its design alone: to the last bit in any order, in any process, in several threads at once."""

import json
import os
import random
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.arrays import Array
from rotor.trim.adjoint import power_gradient
from tests.patched import empty_caches
from tests.tools.thirty_designs import DESIGNS, FEW

ROOT = Path(__file__).parent.parent.parent


def answers(order: list[int], threads: int = 1) -> dict[str, Any]:
    """Answers to some designs, from a fresh process."""
    arguments = [",".join(map(str, order)), str(threads)]
    done = subprocess.run(
        [sys.executable, "-m", "tests.tools.thirty_designs", *arguments],
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return json.loads(done.stdout)


def check(orders: list[tuple[list[int], int]]) -> None:
    first, *others = [answers(*order) for order in orders]
    assert sum(own[0] == "converged" for own in first.values()) >= len(first) - 1
    for other in others:
        assert [number for number in first if first[number] != other[number]] == []


@pytest.mark.slow
def test_a_few_designs_in_two_orders_and_in_threads() -> None:
    check([([*FEW], 1), ([*FEW[::-1]], 4)])


@pytest.mark.slow
@pytest.mark.nightly
def test_thirty_designs_in_three_orders_and_in_four_threads() -> None:
    assert len(DESIGNS) == 30
    order = list(range(30))
    mixed = random.Random(1).sample(order, 30)
    check([(order, 1), (order[::-1], 1), (mixed, 1), (order, 4)])


@pytest.mark.slow
def test_the_run_that_compiles_has_the_bits_of_those_that_read_kept_code(tmp_path: Path) -> None:
    stalling = "rotor.make_design(mu=0.3, inflow='drees', bending=True, dynamic_stall='on')"
    line = f"import rotor; print(rotor.solve({stalling}).linear.point.x.tobytes().hex())"
    kept = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    first, second = (
        subprocess.run([sys.executable, "-c", line], cwd=ROOT, env=kept, capture_output=True, text=True, check=True)
        for _ in range(2)
    )
    assert len(first.stdout) > 1000
    assert first.stdout == second.stdout


@pytest.mark.slow
def test_each_alone_in_a_process() -> None:
    together = answers(list(FEW))
    for number in FEW:
        assert answers([number]) == {str(number): together[str(number)]}


@pytest.mark.parametrize("inflow", ["lifting-line", "pitt-peters"])
def test_a_blade_that_bends_forgets_the_altitude_before(inflow: str) -> None:
    """One of two altitudes is the first that this blade is solved at; both in a row, there and back, are as alone."""
    low, high = (rotor.make_design(mu=0.3, bending=True, inflow=inflow, altitude_m=own) for own in (0.0, 3000.0))
    for designs in ((low, high), (high, low)):
        empty_caches()
        in_a_row = [rotor.solve(design).last_power for design in designs]
        alone: list[Any] = []
        for design in designs:
            empty_caches()
            alone.append(rotor.solve(design).last_power)
        assert in_a_row == alone


def test_warm_starts_end_at_the_same_trim() -> None:
    """From a trim of another speed, altitude and twist: power to 1e-9."""
    cases: tuple[dict[str, Any], ...] = (
        {}, {"inflow": "pitt-peters"}, {"bending": True, "altitude_m": 3000.0}, {"preset": "thesis"}
    )  # fmt: skip
    for given in cases:
        design = rotor.make_design(mu=0.25, twist="linear:-10", **given)
        near: dict[str, Any] = {**given, "altitude_m": 1000.0}
        start = rotor.solve(rotor.make_design(mu=0.28, twist="linear:-14", **near))
        warm, cold = (rotor.solve(design, own).require().power.total for own in (start, None))
        assert_allclose(warm, cold, rtol=1e-9)


def test_gradients_in_threads_are_those_alone() -> None:
    """Many at the same time with one structure: of the same equations at other states."""
    designs = [rotor.make_design(mu=0.2, twist=f"linear:{rate}", inflow="pitt-peters") for rate in (-4, -8, -12, -16)]
    solutions = [rotor.solve(design).require() for design in designs]

    def gradient(solution: rotor.Solution) -> Array:
        return power_gradient(replace(solution, start=replace(solution.start, factors=None))).by_element

    alone = [gradient(solution) for solution in solutions]
    begin = threading.Barrier(4)

    def many(number: int) -> bool:
        begin.wait(60.0)
        return all(np.array_equal(gradient(solutions[number]), alone[number]) for _ in range(100))

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(4) as pool:
            assert all(pool.map(many, range(4)))
    finally:
        sys.setswitchinterval(interval)
