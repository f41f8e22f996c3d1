"""Symmetry, scaling, grids: what no choice of numbers may change."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import make_design, solve
from rotor.columns.flight import LEAST_AZIMUTHS
from rotor.design.twist import LinearTwist, TableTwist
from rotor.engine.linearise import evaluate, jacobian
from rotor.trim.analysis import Analysis


def test_scaling_at_fixed_mach_leaves_coefficients():
    """Twice the radius at half the speed of rotation, masses to match: all coefficients and angles stay."""

    def grown(thing: Any, **powers: int) -> Any:
        """With fields times 2 to a power."""
        values = {name: (getattr(thing, name), 2.0**power) for name, power in powers.items()}
        return replace(thing, **{
            name: tuple(gain * one for one in value) if isinstance(value, tuple) else gain * value
            for name, (value, gain) in values.items()
        })  # fmt: skip

    design = make_design(mu=0.25)
    # Weight does not scale with a speed squared at fixed g.
    design = replace(design, models=replace(design.models, blade_weight=False))
    structure = grown(
        design.rotor.blade.structure, radius=1, stations=1, torsional_stiffness=4, mass_per_length=2,
        torsional_inertia=4, tension_gyration=2, clamp=1, control_stiffness=3, pitch_horn=1,
    )  # fmt: skip
    blade = replace(design.rotor.blade, structure=structure)
    blade = grown(blade, chords=1, flap_inertia=5, flap_static_moment=4, mass=3)
    scaled = replace(
        design,
        rotor=grown(
            replace(design.rotor, blade=blade), radius=1, angular_speed=-1, reference_chord=1
        ),
        condition=grown(design.condition, mass=2),
        fuselage=grown(design.fuselage, drag_area=2),
    )
    a, b = solve(design).require(), solve(scaled).require()
    assert_allclose(b.ct, a.ct, rtol=1e-9)
    assert_allclose(b.cp, a.cp, rtol=1e-8)
    for name in ("collective", "cyclic_1c", "cyclic_1s", "shaft_tilt", "coning", "lambda0"):
        assert_allclose(getattr(b.controls, name), getattr(a.controls, name), atol=1e-9)
    assert_allclose(b.elastic.tip, a.elastic.tip, atol=1e-9)
    assert_allclose(b.elastic.pitch_link_load, 4.0 * a.elastic.pitch_link_load, rtol=1e-7)


def test_twist_offset_is_absorbed_by_collective():
    """A constant added to the twist is collective: the same rotor."""
    table = TableTwist((0.0, 1.0), (0.3, 0.1))
    a, b = (
        solve(make_design(mu=0.2, twist=twist)).require() for twist in (LinearTwist(-0.2), table)
    )
    assert_allclose(b.power.total, a.power.total, rtol=1e-10)


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_low_speed_tends_to_symmetry(preset: str):
    """With no losses and uniform inflow, µ → 0 leaves no azimuthal dependence, and the induced power T v_h."""
    design = make_design(preset=preset, mu=1e-4, twist="linear:-8")
    models = replace(design.models, inflow="uniform", tip_loss=False, hub_loss=False, swirl=False)
    solution = solve(replace(design, models=models)).require()
    assert np.ptp(solution.disk.dct, axis=1).max() < 2e-3 * solution.disk.dct.max()
    assert_allclose(solution.controls.lambda0, math.sqrt(solution.ct / 2.0), rtol=1e-4)
    assert_allclose(
        solution.power.induced / design.power_unit, solution.ct**1.5 / math.sqrt(2.0), rtol=1e-4
    )


@pytest.mark.parametrize(("mu", "within"), [(0.1, 5e-5), (0.35, 6e-4)])
@pytest.mark.parametrize("inflow", ["pitt-peters", "local-momentum"])
def test_few_azimuths_stand_for_all(inflow: str, mu: float, within: float):
    """The trim on a third of the azimuths, and its derivatives as a step on all: what is left of the error.

    Yawed drag changes within a few degrees of azimuth where reverse flow ends.
    """
    design = make_design(mu=mu, inflow=inflow, azimuths=120)
    whole = solve(design).require()
    few = solve(replace(design, models=replace(design.models, azimuths=LEAST_AZIMUTHS))).require()
    assert few.disk.theta.shape[1] == LEAST_AZIMUTHS
    assert_allclose(few.power.total, whole.power.total, rtol=within)
    system, x = Analysis(whole).linear.point.system, Analysis(whole).linear.point.x
    assert system.thin.waves.azimuths == LEAST_AZIMUTHS
    matrices = [
        jacobian(evaluate(system, grid, x, slopes=True))[0] for grid in (system.grid, system.thin)
    ]
    left = np.eye(len(matrices[0])) - np.linalg.solve(matrices[1], matrices[0])
    assert np.abs(np.linalg.eigvals(left)).max() < 2e-2
