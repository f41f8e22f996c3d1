"""Our power and public UH-60A data (`assets/comparison.toml`). Nothing is fitted."""

import numpy as np

from rotor.validation import compare, load_set
from rotor.validation.uh60a import model_curve_comparison


def test_hover_points():
    """Validation with incomplete provenance: rotor C_P against C_T, ten digitised points.

    The measured points give an induced-power factor of 1.20 (fit of the data), annulus momentum theory gives 1.07;
    what is between may be induced power or drag that grows with lift. So the computed power must lie below the data, by
    no more than that 11 % of an induced share of three quarters, but for the 3.2 % scatter of the points either way.
    The first point, 10 % off its own curve, is not counted.
    """
    errors = [point.error_percent or 0.0 for point in compare(load_set("uh60a-hover")).points]
    counted = 1.0 + np.array(errors[1:]) / 100.0
    assert (counted < 1.0 + 0.033).all()
    assert (counted > 1.0 - 0.75 * (1.20 - 1.07) / 1.20 - 0.032).all()


def test_forward_curve_is_indicative():
    """Against a *model* curve (indicative): main-rotor power over speed, with its minimum at the same speed."""
    _, theirs, flight = map(np.array, model_curve_comparison("flight"))
    thesis = np.array(model_curve_comparison("thesis")[2])
    assert abs(int(flight.argmin()) - int(theirs.argmin())) <= 1
    # Their hover lies 12 % below the measured points, and their model is said to be low below 30 kt: up to 60 kt, where
    # induced power is the largest part, the computed power lies above it by 7 to 12 %; by 5 % only at 20 kt, where the
    # wake of the lifting line passes over to the helix of hover and no measurement is known. From 80 kt their reading,
    # good to 2 %, and model, to about 5 %, hold; their blade is rigid, and elastic twist adds up to 1.5 % to the
    # computed power. At 160 kt our drag rise by Mach adds.
    above = flight[:-1] / theirs[:-1] - 1.0
    assert ((above[[0, 2, 3]] > 0.07) & (above[[0, 2, 3]] < 0.12)).all()
    assert 0.03 < above[1] < 0.12
    assert (np.abs(above[4:]) < 0.08).all()
    assert flight[-1] > theirs[-1]
    assert (
        thesis < flight
    ).all()  # One incompressible polar with free transition: less drag everywhere.
