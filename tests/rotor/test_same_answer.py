"""An answer depends on its design alone: to the last bit in any order, in any process, in several threads at once.

`python -m tests.rotor.test_same_answer 3,0,1 [THREADS]` prints answers to some of `DESIGNS` as JSON, numbers as texts.
"""

import json
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import astuple, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotor
from rotor.support.arrays import Array
from rotor.support.blas_threads import keep_one_blas_thread
from rotor.trim.analysis import power_gradient
from tests.patched import empty_caches

ROOT = Path(__file__).parent.parent.parent
TILTED = {"ct_over_sigma": 0.07, "shaft_tilt_deg": -4.0}
DESIGNS: tuple[dict[str, Any], ...] = (
    {"mu": 0.3, "bending": True, "altitude_m": 3000.0}, {"mu": 0.3, "bending": True},
    {"mu": 0.3, "bending": True, "inflow": "pitt-peters", "altitude_m": 3000.0},
    {"mu": 0.34, "mass_kg": 9000.0}, {"hover": True, "preset": "thesis"},
    {"mu": 0.2, "trim": "wind-tunnel", "stand": TILTED}, {"mu": 0.25, "rotor": "gazelle"},
    {"mu": 0.25, "pitch_per_rev": "2:1:90,3:0.5:180"}, {"mu": 0.2, "climb_m_s": -4.0},
)  # fmt: skip
"""Of most kinds, quickly solved."""
ALL = [*range(len(DESIGNS))]


def answer(number: int) -> list[str]:
    """From a cold start: trim, power, elastic twist, loads on the hub, gradient."""
    solution = rotor.solve(rotor.make_design(**DESIGNS[number])).require()
    found = [
        *astuple(solution.controls),
        *astuple(solution.last_power),
        *power_gradient(solution).by_element,
    ]
    if solution.elastic is not None:
        found += solution.elastic.coordinates.ravel().tolist()
    if solution.design.models.bending and (loads := rotor.hub_loads(solution)) is not None:
        found += [loads.index, *loads.amplitudes.values()]
    return [float(value).hex() for value in found]


def answers(order: list[int], threads: int = 1) -> dict[str, list[str]]:
    """From a fresh process."""
    words = ["-m", "tests.rotor.test_same_answer", ",".join(map(str, order)), str(threads)]
    done = subprocess.run(
        [sys.executable, *words], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)


@pytest.mark.slow
def test_in_two_orders_in_threads_and_each_alone() -> None:
    first = answers(ALL)
    for other in (answers(ALL[::-1], 4), *(answers([number]) for number in ALL)):
        assert [number for number in other if first[number] != other[number]] == []


@pytest.mark.parametrize("inflow", ["lifting-line", "pitt-peters"])
def test_a_blade_that_bends_forgets_the_altitude_before(inflow: str) -> None:
    """One of two altitudes is the first that this blade is solved at; both in a row, there and back, are as alone."""
    low, high = (
        rotor.make_design(mu=0.3, bending=True, inflow=inflow, altitude_m=own)
        for own in (0.0, 3000.0)
    )
    for designs in ((low, high), (high, low)):
        empty_caches()
        in_a_row = [rotor.solve(design).last_power for design in designs]
        alone: list[Any] = []
        for design in designs:
            empty_caches()
            alone.append(rotor.solve(design).last_power)
        assert in_a_row == alone


def test_gradients_in_threads_are_those_alone() -> None:
    """Many at the same time with one structure: of the same equations at other states."""
    designs = [
        rotor.make_design(mu=0.2, twist=f"linear:{rate}", inflow="pitt-peters")
        for rate in (-4, -8, -12, -16)
    ]
    solutions = [rotor.solve(design).require() for design in designs]

    def gradient(solution: rotor.Solution) -> Array:
        return power_gradient(replace(solution, start=replace(solution.start, box=None))).by_element

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


if __name__ == "__main__":
    keep_one_blas_thread()
    order = [int(number) for number in sys.argv[1].split(",")]
    with ThreadPoolExecutor(int(sys.argv[2])) as pool:
        print(json.dumps(dict(zip(map(str, order), pool.map(answer, order), strict=True))))
