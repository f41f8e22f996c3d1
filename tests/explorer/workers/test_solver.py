"""What is compiled at set-up is all that a page computes with."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = """
import gc
from dataclasses import replace
from numba.core.registry import CPUDispatcher
from explorer.picture import picture
from rotor.command.warm import compile_all
from rotor.files.make_design import make_design
from rotor.optimisation.search import optimise
from rotor.trim.adjoint import power_gradient
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
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, timeout=600, check=True)
    assert done.stdout.strip() == "[]"


COUNT = """
from collections import Counter
from numba.core import event
found = Counter()

class Listener(event.Listener):
    def on_start(self, event):
        function = event.data["dispatcher"].py_func
        found[function.__module__, function.__qualname__] += 1

    def on_end(self, event):
        pass

event.register("numba:compile", Listener())
from explorer.picture import picture
from rotor.command.warm import compile_all
from rotor.compiled import _watch
compile_all()
picture.warm()
print([one.__name__ for one in _watch.kernels if not one.overloads])
print(sorted(name for (home, name), times in found.items() if home.startswith(("rotor", "explorer")) and times > 1))
"""
TWICE = ["_over_mach", "arctangent", "around", "look_up", "swirl_of", "weighted_sums"]
"""In double and in single precision, or of a number and of an array."""


@pytest.mark.slow
def test_the_first_start_compiles_each_kernel_and_none_twice(tmp_path: Path):
    """A constant among the arguments makes a further copy: that of the section took a third of the first start."""
    empty = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    run = [sys.executable, "-c", COUNT]
    done = subprocess.run(run, capture_output=True, text=True, timeout=600, check=True, env=empty)
    assert done.stdout.splitlines() == ["[]", str(TWICE)]
