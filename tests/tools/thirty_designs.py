"""Thirty designs of all kinds, and their answers to the last bit.

`python -m tests.tools.thirty_designs ORDER [THREADS]`, where ORDER is all, or numbers of designs such as 3,0,7, prints
them as JSON, numbers as hexadecimal texts.
"""

import json
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import astuple
from functools import partial
from pathlib import Path
from typing import Any

import rotor
from rotor.blas_threads import keep_one_blas_thread
from rotor.trim.adjoint import power_gradient

FILE = """
name = "My rotor"

[main_rotor]
blades = 3
radius_m = 5.345
speed_rpm = 394.0
root_cutout_r = 0.2
chord_m = 0.35
section = "oa209"
linear_twist_deg = -12.0
flap_hinge_m = 0.2
blade_mass_kg = 34.0

[airframe]
drag_area_m2 = 1.3
mass_kg = 1950.0
"""


def own_rotor(**given: Any) -> rotor.Design:
    """A design with a rotor from a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mine.toml"
        path.write_text(FILE, encoding="utf-8")
        return rotor.make_design(rotor=rotor.load_rotor(path), **given)


def of(**given: Any) -> Callable[[], rotor.Design]:
    return partial(rotor.make_design, **given)


TILTED = {"ct_over_sigma": 0.07, "shaft_tilt_deg": -4.0}
DESIGNS: tuple[Callable[[], rotor.Design], ...] = (
    of(mu=0.3, bending=True),
    of(mu=0.3, bending=True, altitude_m=3000.0),
    of(mu=0.3, bending=True, inflow="pitt-peters"),
    of(mu=0.3, bending=True, inflow="pitt-peters", altitude_m=3000.0),
    of(mu=0.3),
    of(mu=0.3, altitude_m=3000.0),
    of(mu=0.04),
    of(mu=0.15, twist="linear:-8"),
    of(mu=0.36, mass_kg=9500.0),
    of(mu=0.34, mass_kg=9000.0, dynamic_stall=True),
    of(mu=0.3, bending=True, dynamic_stall=True, inflow="pitt-peters"),
    of(hover=True),
    of(hover=True, altitude_m=2000.0, twist="linear:-16"),
    of(hover=True, preset="thesis"),
    of(hover=True, climb_m_s=5.0),
    of(mu=0.2, climb_m_s=6.0),
    of(mu=0.2, climb_m_s=-4.0),
    of(preset="thesis", mu=0.1),
    of(preset="thesis", mu=0.3, twist="linear:-8"),
    of(mu=0.2, trim="wind-tunnel", stand=TILTED),
    of(mu=0.2, trim="wind-tunnel", stand={"ct_over_sigma": 0.07, "shaft_tilt_deg": -4.0, "flapping": "free"}),
    of(mu=0.2, trim="free-rotor", stand={"collective_deg": 3.0}),
    of(mu=0.2, trim="controls", stand={"collective_deg": 8.0, "shaft_tilt_deg": -3.0}),
    of(rotor="hart2", mu=0.15, trim="wind-tunnel", stand=TILTED, bending=True),
    of(rotor="bo105", mu=0.25, bending=True),
    of(rotor="gazelle", mu=0.25, inflow="local-momentum"),
    partial(own_rotor, mu=0.25),
    of(mu=0.25, pitch_per_rev="2:1:90,3:0.5:180"),
    of(mu=0.25, twist_per_rev="3:1:180"),
    of(mu=0.5, mass_kg=11_000.0),
)
FEW = (1, 0, 3, 9, 13, 19, 26, 27)
"""Designs of most kinds, quickly solved."""


def exactly(value: Any) -> Any:
    """A record with its numbers as they are in memory."""
    if isinstance(value, float):
        return value.hex()
    return [exactly(own) for own in value] if isinstance(value, (list, tuple)) else value


def answer(number: int) -> Any:
    """A design's answer from a cold start: trim, power, elastic twist, loads on the hub, gradient."""
    solution = rotor.solve(DESIGNS[number]())
    found: list[Any] = [solution.status.value, list(astuple(solution.controls)), list(astuple(solution.last_power))]
    if solution.elastic is not None:
        found.append(solution.elastic.coordinates.ravel().tolist())
    if solution.converged:
        objective = "induced" if solution.design.models.trim == "free-rotor" else "total"
        found.append(power_gradient(solution, objective).by_element.tolist())
        if number in (1, 3) and (loads := solution.hub_loads) is not None:
            found.append([loads.index, *loads.amplitudes.values()])
    return exactly(found)


def main() -> None:
    """In the order asked for, one after another or in threads."""
    keep_one_blas_thread()
    order = [*range(len(DESIGNS))] if sys.argv[1] == "all" else [int(own) for own in sys.argv[1].split(",")]
    threads = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    if threads > 1:
        with ThreadPoolExecutor(threads) as pool:
            answers = list(pool.map(answer, order))
    else:
        answers = [answer(number) for number in order]
    print(json.dumps(dict(zip(map(str, order), answers, strict=True))))


if __name__ == "__main__":
    main()
