"""The first claims of the thesis (thesis §3.2, §3.3), printed and tested as physical statements.

The thesis' optima are on curves that are flat to a per cent, its polar is not stated, and its induced power cannot
see twist; so powers are compared, never angles alone. Run with -s to read the tables.
"""

from functools import cache

import numpy as np
import pytest

from rotor.design.design import PRESETS
from rotor.files.make_design import make_design
from rotor.trim.solve import solve

RATES = (0, -4, -8, -12, -16)


@cache
def power_kw(preset: str, rate: float, mu: float) -> float:
    """Main-rotor power of a linear twist [kW]."""
    return solve(make_design(preset=preset, twist=f"linear:{rate}", mu=mu)).require().power.main_rotor / 1e3


def best(preset: str, mu: float) -> int:
    return min(RATES, key=lambda rate: power_kw(preset, rate, mu))


@pytest.mark.parametrize("preset", PRESETS)
def test_hover_optimum_of_linear_twist(preset: str):
    """Document: −13.5° with SC1095, and −16° lies past it. Ours lies lower, on a curve as flat."""
    rates = np.arange(-24.0, 0.1, 0.5)
    powers = np.array([power_kw(preset, rate, 0.0) for rate in rates])
    k = int(powers.argmin())
    band = rates[powers < powers[k] * 1.001]
    cost = power_kw(preset, -13.5, 0.0) / powers[k] - 1.0
    print(
        f"\n{preset}: hover optimum {rates[k]:.1f}°, {powers[k]:.0f} kW, within 0.1 % from {band[0]:.1f} "
        f"to {band[-1]:.1f}°; "
        f"the thesis' −13.5° costs {100 * cost:.2f} %"
    )
    assert -19.0 < rates[k] < -12.0
    assert cost < {"thesis": 3e-3, "flight": 6e-3}[preset]
    assert power_kw(preset, 0, 0.0) > 1.05 * powers[k]
    assert (np.diff(powers[:k]) < 0.0).all()  # Past the optimum more twist costs again, as fig. 3.11 says.


@pytest.mark.parametrize("preset", PRESETS)
def test_best_of_five_twists(preset: str):
    """Document: −8° beyond µ ≈ 0.18, −4° at high speed. Printed for µ 0.1, 0.18, 0.25, 0.35."""
    print(f"\n{preset}, main-rotor power [kW] for linear twist {RATES}:")
    for mu in (0.1, 0.18, 0.25, 0.35):
        row = "  ".join(f"{power_kw(preset, rate, mu):8.1f}" for rate in RATES)
        print(f"  µ {mu:.2f}  {row}   best {best(preset, mu)}°")
    if preset == "thesis":
        assert best(preset, 0.35) == -4  # As the thesis says.
        assert best(preset, 0.1) <= best(preset, 0.18)  # At low speed at least as much twist is best.
        for mu in (0.18, 0.25):  # Where our best differs from −8°, −8° costs less than half a per cent.
            assert power_kw(preset, -8, mu) < 1.005 * power_kw(preset, best(preset, mu), mu)
    else:
        # With cyclic and µ sin α the untwisted blade pays, unlike in the thesis: `python -m rotor ladder`.
        assert power_kw(preset, 0, 0.35) > 1.05 * power_kw(preset, best(preset, 0.35), 0.35)


def test_hover_optimum_has_more_twist_than_forward_flight():
    """Thesis p. 3 and §3.3: increasing twist in hover, decreasing it at high speed."""
    assert best("thesis", 0.0) < best("thesis", 0.1) < best("thesis", 0.35) + 1


def test_fast_flight_needs_more_power_than_the_minimum():
    for preset in PRESETS:
        powers = [power_kw(preset, -16, mu) for mu in (0.0, 0.15, 0.35)]
        assert powers[1] < powers[0]
        assert powers[1] < powers[2]
