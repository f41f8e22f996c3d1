"""What dynamic stall takes from a section's static data."""

import numpy as np
import pytest

from rotor.airfoil.sections import load_section
from rotor.airfoil.stall_onset import POSITIVE, SLOPE, TRAVEL, ZERO, stall_onset


@pytest.mark.parametrize("name", ["naca0012", "sc1095", "sc1094r8"])
@pytest.mark.parametrize("mach", [0.3, 0.4, 0.6])
def test_kirchhoffs_flow_gives_the_static_force_back(name: str, mach: float):
    """C_n = C_nα x ¼ (1 + √f)² wherever f is within its bounds."""
    table = load_section(name)
    found, node = stall_onset(table), round(mach * 20)
    x = np.deg2rad(np.arange(2.0, 20.0, 0.5))
    alpha = x + found.numbers[ZERO, node]
    static = table(alpha, mach)
    force = static.cl * np.cos(alpha) + static.cd * np.sin(alpha)
    f = found.tables[360 + np.arange(4, 40), node, 0, 0, 0]
    free = (f > 0.021) & (f < 0.999)
    assert free.any()
    made = found.numbers[SLOPE, node] * x * 0.25 * (1.0 + np.sqrt(f)) ** 2
    np.testing.assert_allclose(made[free], force[free], rtol=1e-9)


def test_separation_reaches_leishman_and_beddoes_0_7_near_static_stall():
    """Their α1 of a NACA 0012 at Mach 0.4 is 12.5°, their C_n1 1.2."""
    found = stall_onset(load_section("naca0012"))
    f = found.tables[360:, 8, 0, 0, 0]
    assert 0.5 * float(np.argmax(f < 0.7)) == pytest.approx(12.5, abs=1.5)
    assert found.numbers[SLOPE, 8] * found.numbers[POSITIVE, 8] == pytest.approx(1.2, abs=0.2)
    assert found.numbers[TRAVEL, 8] == 9.0
