"""Drawings: their geometry is that of the theory, and every one of the thesis' is there."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.reproduce import Agreement, Report, schematics
from rotor.reproduce.catalogue import ENTRIES
from rotor.reproduce.report import PlotPanel

Make = Callable[[str], Report]
DRAWN = ("2.1", "2.2", "2.5", "2.9", "5.1")


def test_the_stream_tube_contracts_as_momentum_theory_says():
    """R in the disk, R/√2 far below (2.2 with w = 2v), and wider above."""
    far = schematics.contraction(np.array([0.0, 1e6]))
    assert_allclose(far, [1.0, np.sqrt(0.5)], rtol=1e-9)
    assert (np.diff(schematics.contraction(np.linspace(-3.0, 3.0, 50))) < 0.0).all()


@pytest.mark.parametrize("mu", schematics.SPEEDS)
def test_the_border_of_reverse_flow_is_a_circle_of_diameter_mu(mu: float):
    x, y = schematics.reverse_flow_circle(mu)
    assert_allclose(np.hypot(x - -0.5 * mu, y), 0.5 * mu, atol=1e-12)  # Retreating side: x < 0.


def test_the_angles_of_the_blade_element_add_up(report: Make):
    numbers = report("2.2").numbers
    assert_allclose(numbers["alpha"], numbers["theta"] - numbers["phi"], atol=1e-9)


@pytest.mark.parametrize("number", DRAWN)
def test_a_drawing_stands_alone_and_has_no_axes(number: str, report: Make):
    one = report(number)
    assert one.verdict is Agreement.ALONE
    assert all(isinstance(panel, PlotPanel) and panel.drawing for panel in one.panels)


def test_the_hinge_is_that_of_the_rotor(report: Make):
    assert_allclose(report("2.9").numbers["hinge"], 0.381 / 8.1788, rtol=2e-3)  # 15 in (NASA CR-166309).


def test_the_swept_tip_is_drawn(report: Make):
    panel = report("4.9").panels[0]
    assert isinstance(panel, PlotPanel)
    tip = max(panel.curves, key=lambda one: max(one.x))
    (front,) = {y for x, y in zip(tip.x, tip.y, strict=True) if x == 1.0 and y == max(
        b for a, b in zip(tip.x, tip.y, strict=True) if a == 1.0)}  # fmt: skip
    assert_allclose(max(tip.y) - front, (1.0 - 0.9286) * np.tan(np.radians(20.0)), rtol=1e-6)


def test_every_figure_of_the_thesis_has_an_entry():
    numbers = {entry.number for entry in ENTRIES}
    for chapter, last in ((2, 9), (3, 15), (4, 13), (5, 10)):
        assert {f"{chapter}.{k}" for k in range(1, last + 1)} <= numbers
