"""No input inside its range takes unbounded time or memory. Times are of the processor, without compiling."""

import json
import random
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from rotor import make_design, solve
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.lifting_line import MOST_AZIMUTHS, MOST_PANELS
from rotor.support.user_input import shorten

MOST_SECONDS = 10.0
"""Of processor time, for one solve."""
MOST_MEGABYTES = 2000.0
SMALLEST = (1e-300, 1e-9, 1e-5, 4e-5, 1e-3, 5e-3)
"""Advance ratios: at 4e-5 a wake without thrust once took 7 GB."""


def without_thrust() -> Iterator[dict[str, Any]]:
    """A far wake ends neither by its speed nor by its sink rate."""
    for loading, mu in product((0.0, 1e-300, 1e-6, 1e-3), SMALLEST):
        yield {"trim": "wind-tunnel", "stand": {"ct_over_sigma": loading}, "mu": mu}


def largest_grids() -> Iterator[dict[str, Any]]:
    yield {"mu": 0.2, "inflow": "uniform", "elements": 1000, "azimuths": 2000}
    for elements, azimuths in ((6, MOST_AZIMUTHS), (50, 60), (MOST_PANELS, 23)):
        yield {"mu": 0.2, "elements": elements, "azimuths": azimuths, "bending": True}


def anything(count: int) -> Iterator[dict[str, Any]]:
    chance = random.Random(71)
    for _ in range(count):
        flight = {
            "twist": f"linear:{chance.uniform(-30.0, 10.0):.6g}",
            "inflow": chance.choice(sorted(INFLOW_MODELS)),
            "mu": chance.choice(
                (0.0, 10.0 ** chance.uniform(-300.0, -1.0), chance.uniform(0.0, 0.75))
            ),
            "bending": chance.random() < 0.2,
        }
        if chance.random() < 0.5:
            flight |= {
                "mass_kg": chance.uniform(1.0, 15_000.0),
                "climb_m_s": chance.choice((0.0, -8.0, 8.0)),
            }
        else:
            loading = chance.choice(
                (0.0, 10.0 ** chance.uniform(-300.0, -1.0), chance.uniform(0.0, 0.15))
            )
            stand = {"ct_over_sigma": loading, "shaft_tilt_deg": chance.uniform(-20.0, 20.0)}
            flight |= {"trim": "wind-tunnel", "stand": stand}
        yield flight


SETS = {
    "without-thrust": without_thrust,
    "largest-grids": largest_grids,
    "anything": lambda: anything(60),
}


def work(name: str, count: int) -> None:
    """Solve all of a set; print the slowest ones [s] and the largest resident size [MB]."""
    solve(make_design(mu=0.2))
    solve(make_design(mu=0.2, bending=True))
    times = list[tuple[float, str, str]]()
    for arguments in anything(count) if count else SETS[name]():
        begun = time.process_time()
        try:
            said = solve(make_design(**arguments)).message
        except ValueError as error:
            said = str(error)
        times.append((time.process_time() - begun, str(arguments), shorten(said)))
    print(
        json.dumps(
            {
                "slowest": sorted(times, reverse=True)[:10],
                "megabytes": _largest(),
                "count": len(times),
            }
        )
    )


def _largest() -> float:
    """Of this process [MB]. On Linux `ru_maxrss` begins with that of the process that started it."""
    if sys.platform == "darwin":
        import resource

        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    (kilobytes,) = re.findall(
        r"VmHWM:\s+(\d+) kB", Path("/proc/self/status").read_text(encoding="ascii")
    )
    return float(kilobytes) / 1e3


@pytest.mark.slow
@pytest.mark.skipif(
    sys.platform == "win32", reason="the size of a process is read as Unix tells it"
)
@pytest.mark.parametrize(
    ("name", "count"),
    [*((name, 0) for name in SETS), pytest.param("anything", 10_000, marks=pytest.mark.nightly)],
)
def test_every_design_has_an_answer_soon(name: str, count: int):
    command = [sys.executable, "-m", "tests.rotor.trim.test_bounded", name, str(count)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=3600.0)
    result: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    print(*result["slowest"], sep="\n")
    assert result["count"] >= 4
    assert result["slowest"][0][0] < MOST_SECONDS, result["slowest"][0]
    assert result["megabytes"] < MOST_MEGABYTES
    assert name != "largest-grids" or {said for _, _, said in result["slowest"]} == {"Trimmed."}


def test_a_trim_found_by_continuation_is_not_sought_by_it_again(monkeypatch: pytest.MonkeyPatch):
    """It took half of the time of the slowest refusals."""

    def sought(*_: object) -> None:
        pytest.fail("sought again")

    monkeypatch.setattr("rotor.trim.solve.trim_along", sought)
    light = make_design(
        twist="linear:-23.8683", mass_kg=811.99, inflow="drees", elements=16, azimuths=36
    )
    assert "collective" in solve(light.at(mu=0.43756926966961485, climb_m_s=-8.0)).message


if __name__ == "__main__":
    work(sys.argv[1], int(sys.argv[2]))
