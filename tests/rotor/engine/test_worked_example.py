"""The worked example of docs/developers/freedom.md: it runs, and the flapping it finds answers its own loads."""

import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from rotor.aero.section import FZ
from rotor.engine.linearise import evaluate, jacobian
from rotor.trim.analysis import Analysis

PAGE = Path(__file__).parents[3] / "docs" / "developers" / "freedom.md"
CODE = re.search(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


def test_the_worked_example_flaps_as_its_loads_say_and_its_jacobian_is_exact():
    assert len(CODE.group(1).splitlines()) <= 40
    names: dict[str, Any] = {}
    exec(compile(CODE.group(1), PAGE.name, "exec"), names)
    linear = Analysis(names["solution"].require()).linear
    point, problem, system = linear.point, linear.problem, linear.point.system
    assert point.size <= 1.0
    assert names["beta_2c"] == point.x[system.structure.states["flap_2c"]]
    power = names["solution"].power
    assert_allclose(power.shaft, power.main_rotor, rtol=1e-9)
    disk, states = problem.disk, system.structure.states
    moment = problem.arm * disk.dr @ point.forces[FZ]
    for name, wave in (("flap_2c", np.cos), ("flap_2s", np.sin)):
        driven = 2.0 * problem.flap.load_gain * float((moment * wave(2.0 * disk.psi)).mean())
        beta = point.x[states[name]]
        assert_allclose(beta, driven / (problem.flap.frequency_squared - 4.0), rtol=1e-7)
        assert 1e-4 < abs(beta) < 0.05
    exact = jacobian(evaluate(system, system.grid, point.x, slopes=True))[0][
        :, system.structure.states_of("flap_2s")[0]
    ]
    step = np.zeros_like(point.x)
    step[states["flap_2s"]] = 1e-6  # A longer one reaches a knot of the section data.
    ahead, behind = (evaluate(system, system.grid, point.x + sign * step).residual for sign in (1.0, -1.0))
    assert_allclose(exact, (ahead - behind) / 2e-6, atol=1e-6 * np.abs(exact).max())
