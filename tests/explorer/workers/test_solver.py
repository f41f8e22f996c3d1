"""What is compiled at set-up is all that a page computes with."""

import subprocess
import sys

import pytest

SCRIPT = """
import gc
from dataclasses import replace
from numba.core.registry import CPUDispatcher
from explorer.picture import picture
from rotor.command.warm import compile_all
from rotor.files.make_design import make_design
from rotor.optimisation.search import optimise
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import solve

def compiled():
    kernels = (item for item in gc.get_objects() if isinstance(item, CPUDispatcher))
    return {(item.py_func.__module__, item.py_func.__name__, str(one)) for item in kernels for one in item.signatures}

def also(design, **models):
    return replace(design, models=replace(design.models, **models))

compile_all()
picture.warm()
before = compiled()
flight, slow, hover = (make_design(mu=mu) for mu in (0.25, 0.08, 0.0))
for design in (
    flight, slow, hover, also(flight, elastic_twist=False), also(flight, inflow="drees"), also(flight, tip_loss=False),
    also(flight, inflow="local-momentum"), also(hover, elastic_twist=False),
    make_design(preset="thesis", mu=0.1),
):
    first = solve(design)
    power_gradient(first)
    solve(replace(design, twist=make_design(twist="linear:-11").twist), first)
optimise(flight, "two-segment", starts=2)
picture.warm()
print(sorted(one for one in compiled() - before if one[0].startswith(("rotor", "explorer"))))
"""


@pytest.mark.slow
def test_nothing_is_compiled_after_set_up():
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, timeout=600, check=True
    )
    assert done.stdout.strip() == "[]"
