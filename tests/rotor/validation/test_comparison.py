"""Our power and public UH-60A data (`assets/comparison.toml`). Labels as there; nothing is fitted. Run with -s."""

import tomllib
from dataclasses import replace

import numpy as np

from rotor.assets import asset_path
from rotor.files.make_design import make_design
from rotor.trim.solve import solve

DATA = tomllib.loads(asset_path("comparison.toml").read_text(encoding="utf-8"))


def test_hover_points():
    """Validation with incomplete provenance: rotor C_P against C_T, ten digitised points.

    The measured points give an induced-power factor of 1.20 (fit of the data), annulus momentum theory gives 1.07: it
    has no wake contraction and no tip-vortex interference. So ours must lie below the data, by no more than that 11 %
    of an induced share of three quarters, but for the 3.2 % scatter of the points either way. The first point, 10 % off
    its own curve, is not counted.
    """
    hover = DATA["hover"]
    ratios = []
    for ct, cp in zip(hover["ct_over_sigma"], hover["cp_over_sigma"], strict=True):
        base = make_design(mu=0.0)
        base = replace(base, models=replace(base.models, download=False))  # Measured is the rotor's own thrust.
        mass = base.condition.mass * ct * hover["solidity"] / base.weight_coefficient
        solution = solve(replace(base, condition=replace(base.condition, mass=mass))).require()
        ratios.append(solution.cp / (cp * hover["solidity"]))
    print("\nhover, ours over measured:", " ".join(f"{ratio:.3f}" for ratio in ratios))
    counted = np.array(ratios[1:])
    assert (counted < 1.0 + 0.033).all()
    assert (counted > 1.0 - 0.75 * (1.20 - 1.07) / 1.20 - 0.032).all()


def test_forward_curve_is_indicative():
    """Against a *model* curve (indicative): main-rotor power over speed, with its minimum at the same speed."""
    forward = DATA["forward"]
    assert forward["kind"].startswith("indicative")
    ours = []
    print("\nmain rotor [kW], indicative (model curve, not flight test):")
    for knots, horsepower in zip(forward["speed_kt"], forward["main_rotor_hp"], strict=True):
        mu = knots * 1852 / 3600 / make_design().rotor.tip_speed
        row = []
        for preset in ("flight", "thesis"):
            design = make_design(preset=preset, mu=mu, mass_kg=forward["mass_kg"], altitude_m=forward["altitude_m"])
            row.append(solve(design).require().power.main_rotor / 1e3)
        ours.append(row)
        print(f"  {knots:4d} kt  theirs {0.7457 * horsepower:7.0f}   flight {row[0]:7.0f}   thesis {row[1]:7.0f}")
    theirs = 0.7457 * np.array(forward["main_rotor_hp"])
    flight, thesis = np.array(ours).T
    assert abs(int(flight.argmin()) - int(theirs.argmin())) <= 1
    # Their hover lies 12 % below the measured points, and their model is said to be low below 30 kt: up to 60 kt, where
    # induced power is the largest part, ours lies above it by 8 to 12 %; by 5 % only at 20 kt, where the wake of the
    # lifting line passes over to the helix of hover and no measurement is known. From 80 kt their reading, good to
    # 2 %, and model, to about 5 %, hold; their blade is rigid, and elastic twist adds up to 1.5 % to ours. At 160 kt
    # our drag rise by Mach adds.
    above = flight[:-1] / theirs[:-1] - 1.0
    assert ((above[[0, 2, 3]] > 0.08) & (above[[0, 2, 3]] < 0.12)).all()
    assert 0.03 < above[1] < 0.12
    assert (np.abs(above[4:]) < 0.08).all()
    assert flight[-1] > theirs[-1]
    assert (thesis < flight).all()  # One incompressible polar with free transition: less drag everywhere.
