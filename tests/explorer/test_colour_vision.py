"""Colours as people with colour blindness see them: maps keep their order, and what must be told apart can be.

Simulation: Machado, Oliveira and Fernandes (2009), severity 1, on linear sRGB. Distances: CIE 1976 L*a*b*, D65, where
about 2.3 is just noticed side by side and 10 is plainly another colour.
"""

import itertools

import numpy as np
import pytest

from explorer.charts.probe_drawing import ALPHA, DRAG, LIFT
from explorer.colours import BASELINE, IDEAL, LIMIT, NOW, PARTS, PINNED, THIS, Scheme, colour_map
from rotor.support.arrays import Array

EYES = {
    "ordinary": np.eye(3),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "tritanopia": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
}
_XYZ = np.array(
    [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ]
)
_WHITE = np.array([0.95047, 1.0, 1.08883])
PLAIN = 12.0
"""Distance that lines and patches must keep."""

eyes = pytest.mark.parametrize("eye", EYES)


def seen(rgb: object, eye: str) -> Array:
    """L*, a*, b* of colours 0…255 as an eye sees them."""
    channel = np.asarray(rgb, dtype=float) / 255.0
    linear = np.where(channel <= 0.04045, channel / 12.92, ((channel + 0.055) / 1.055) ** 2.4)
    xyz = np.clip(linear @ EYES[eye].T, 0.0, 1.0) @ _XYZ.T / _WHITE
    f = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    return np.stack(
        (116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])),
        axis=-1,
    )


def rgb_of(name: str) -> list[int]:
    return [int(name[k : k + 2], 16) for k in (1, 3, 5)]


def apart(first: str, second: str, eye: str) -> float:
    return float(np.linalg.norm(seen(rgb_of(first), eye) - seen(rgb_of(second), eye)))


@eyes
def test_the_one_sided_map_gets_lighter_all_the_way(eye: str):
    lab = seen(colour_map("sequential", 190), eye)
    tenth = lab[:: 189 // 10]
    assert (np.diff(tenth[:, 0]) > 3.0).all()
    # Eight-bit colours may tie with their neighbour, but never run back by more than their rounding.
    assert np.diff(lab[:, 0]).min() > -0.5
    assert np.ptp(lab[:, 0]) > 60.0


@eyes
@pytest.mark.parametrize("scheme", ["diverging", "margin"])
def test_the_two_sided_maps_darken_away_from_zero_and_their_sides_differ(eye: str, scheme: Scheme):
    lab = seen(colour_map(scheme, 191), eye)
    middle = 95
    for side in (lab[middle::-1], lab[middle:]):
        assert (np.diff(side[::19, 0]) < -3.0).all()
        assert np.diff(side[:, 0]).max() < 0.5
    assert eye != "ordinary" or np.abs(lab[:, 0] - lab[::-1, 0]).max() < 8.0
    for away in (24, 48, 95):  # A quarter, a half and all of the range.
        assert np.linalg.norm(lab[middle - away] - lab[middle + away]) > 2.0 * PLAIN


@eyes
def test_power_parts_are_told_apart(eye: str):
    for (one, first), (other, second) in itertools.combinations(PARTS.items(), 2):
        assert apart(first, second, eye) > PLAIN, f"{one} and {other}"


@eyes
@pytest.mark.parametrize(
    "together",
    [
        (THIS, BASELINE, IDEAL, NOW),
        (THIS, PINNED, IDEAL, NOW),
        (THIS, PINNED, LIMIT),
        (NOW, LIMIT),
        (LIFT, DRAG, ALPHA),
    ],
    ids=["power", "power A B", "alpha A B", "alpha", "probe"],
)
def test_lines_of_one_chart_are_told_apart(eye: str, together: tuple[str, ...]):
    for first, second in itertools.combinations(together, 2):
        assert apart(first, second, eye) > PLAIN, f"{first} and {second}"
