"""Bending modes of the rotating blade against published solutions and exact ones."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.design.blade import BladeStructure
from rotor.dynamics.bending import bending_beam, bending_modes, frequencies_by_kind
from rotor.support.arrays import Array

WRIGHT = {
    0.0: (3.5160, 22.0345, 61.6972),
    3.0: (4.7973, 23.3203, 62.9850),
    6.0: (7.3604, 26.8091, 66.6840),
    12.0: (13.1702, 37.6031, 79.6145),
}
"""ω √(m L⁴/EI) of a uniform cantilever that turns at Ω √(m L⁴/EI): Wright, Smith, Thresher and Wang, J. Appl. Mech. 49
(1982), flapping, hub radius 0."""


FREE, HELD = (0.0, 0.0), (math.inf, math.inf)
"""Roots: hinges without springs, and none."""


def _uniform(flap: float, lag: float, mass: float = 1.0, radius: float = 1.0) -> BladeStructure:
    two = (1.0, 1.0)
    return BladeStructure(
        radius=radius, stations=(0.0, radius), torsional_stiffness=two, mass_per_length=(mass, mass),
        torsional_inertia=two, tension_gyration=0.0, clamp=0.0, control_stiffness=1.0, pitch_horn=1.0,
        flap_stiffness=(flap, flap), lag_stiffness=(lag, lag),
    )  # fmt: skip


def _flat(r: Array) -> Array:
    return np.zeros_like(r)


@pytest.mark.parametrize("speed", WRIGHT)
def test_uniform_rotating_cantilever(speed: float) -> None:
    beam = bending_beam(_uniform(1.0, 900.0), speed, 0.0, _flat, HELD)
    assert_allclose(bending_modes(beam, 3).frequency, WRIGHT[speed], rtol=1e-4)


def test_lag_follows_from_flap_by_southwell() -> None:
    """In lag the same beam has ω² less by Ω², exactly: the centrifugal force turns with the blade."""
    beam = bending_beam(_uniform(1.0, 1.0), 6.0, 0.0, _flat, HELD)
    found = np.sort(bending_modes(beam, 4).frequency ** 2)
    flap = np.array(WRIGHT[6.0][:2]) ** 2
    assert_allclose(found, np.sort([*flap, *(flap - 36.0)]), rtol=3e-4)


def test_hinged_blade_flaps_once_per_revolution() -> None:
    """Rigid modes of a blade hinged at the shaft: flap 1/rev, lag 0, exactly; at e, ν² = 1 + 3e/2(1 − e) and less 1."""
    beam = bending_beam(_uniform(1.0, 900.0), 12.0, 0.0, _flat, FREE)
    assert_allclose((bending_modes(beam, 2).frequency / 12.0) ** 2, [0.0, 1.0], atol=1e-4)
    offset = 0.05
    stiff = bending_beam(_uniform(1e3, 1e3), 12.0, offset, _flat, FREE)
    square = 1.5 * offset / (1.0 - offset)
    assert_allclose(
        (bending_modes(stiff, 2).frequency / 12.0) ** 2, [square, 1.0 + square], rtol=1e-3
    )


@pytest.mark.parametrize("springs", [(0.4, 0.0), (0.0, 0.3), (0.7, 0.5), (math.inf, 0.3)])
def test_springs_at_offset_hinges(springs: tuple[float, float]) -> None:
    """A stiff uniform blade: ν² = 1 + eS/I + K/IΩ² in flap and 1 less in lag; a held root flaps far above.

    A stiffer one would bend less, but rounding grows with its highest frequency.
    """
    offset, speed = 0.05, 1.0
    inertia, moment = (1.0 - offset) ** 3 / 3.0, 0.5 * (1.0 - offset) ** 2
    beam = bending_beam(_uniform(700.0, 700.0), speed, offset, _flat, springs)
    expected = [
        square + offset * moment / inertia + spring / (inertia * speed**2)
        for square, spring in zip((1.0, 0.0), springs, strict=True)
    ]
    found = (bending_modes(beam, 2).frequency / speed) ** 2
    if math.isinf(springs[0]):
        assert_allclose(found[0], expected[1], atol=2e-3)
        assert found[1] > 5e3
    else:
        assert_allclose(found, np.sort(expected), atol=2e-3)


def test_a_stiff_spring_holds_the_root() -> None:
    """Between a hinge and a clamp; with K ≫ EI/L the frequencies of the cantilever."""
    beams = [
        bending_beam(_uniform(1.0, 900.0), 6.0, 0.0, _flat, springs)
        for springs in (FREE, (1.0, 0.0), (1e5, 1e6), HELD)
    ]
    free, sprung, stiff, held = (
        frequencies_by_kind(bending_modes(beam, 4))[0][0] for beam in beams
    )
    assert free < sprung < held
    assert_allclose(stiff, held, rtol=1e-4)


def test_cantilever_pretwisted_by_45_degrees() -> None:
    """A steel strip of 0.1524 × 0.0254 × 0.0017272 m: frequencies in hertz.

    They stand in the literature since Gupta & Rao (J. Sound Vib. 56, 1978); recalled, not looked up.
    """
    length, width, height, young, density = 0.1524, 0.0254, 0.0017272, 206.85e9, 7857.6
    flap, lag = young * width * height**3 / 12.0, young * height * width**3 / 12.0
    structure = _uniform(flap, lag, density * width * height, length)

    def pitch(r: Array) -> Array:
        return math.radians(45.0) * r / length

    beam = bending_beam(structure, 0.0, 0.0, pitch, HELD)
    hertz = bending_modes(beam, 4).frequency / (2.0 * math.pi)
    assert_allclose(hertz, [62.0, 305.1, 955.0, 1215.0], rtol=0.01)


def test_uh60a_frequencies() -> None:
    """Published fan plot: flap 1.035 and 2.81, lag 0.27, the third flap and second lag mode at 4.7 to 5.5 per rev."""
    design = rotor.make_design(mu=0.3)
    blade = design.rotor.blade
    assert blade.structure is not None
    radius = design.rotor.radius

    def pitch(r: Array) -> Array:
        return math.radians(10.0) + design.twist(r / radius)

    beam = bending_beam(
        blade.structure, design.rotor.angular_speed, blade.flap_hinge * radius, pitch, FREE
    )
    flap, lag = frequencies_by_kind(bending_modes(beam, 5))
    assert_allclose(flap[:2], [1.035, 2.81], rtol=0.02)
    assert_allclose(lag[0], 0.27, atol=0.005)
    assert all(4.6 < own < 5.5 for own in (*flap[2:], *lag[1:]))
