"""What the dial asks for: the response to twist at n/rev against another blade, the front of power and vibration."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.parts.actuate import DialNumbers
from rotor import Design, t_matrix
from rotor.actuator import InstalledActuator, harmonic_share, tip_amplitude
from rotor.actuator.harmonic import bending
from rotor.design import Harmonic
from rotor.optimisation.vibration import front_twists, with_power_of
from rotor.support.arrays import Array
from rotor.trim.hub_loads import index_gains

HARMONICS = (2, 3, 4, 5)
"""Harmonics of the dial: those at which four blades pass vibration on to the hub, and 2/rev, which saves power."""
_FRONT_HARMONICS, _FRONT_POINTS = (2, 3), 7
_DIGITS = 6


@dataclass(frozen=True)
class FittedBlade:
    """The actuator on the blade, with the steady drive of each segment in its unit."""

    installed: InstalledActuator
    volts: tuple[float, ...]

    @property
    def whole(self) -> float:
        """Amplitude at n/rev of half the voltage range at the tip of the blade at rest [°]; zero: it cannot follow."""
        return math.degrees(tip_amplitude(self.installed))

    @property
    def room(self) -> float:
        """Amplitude that steady drive leaves for n/rev [°], a part of `whole`."""
        return self.whole * harmonic_share(self.installed, self.volts)

    @property
    def losses(self) -> list[float]:
        """Heat in the plies of all blades for 1° at each harmonic of the dial [W]."""
        if not self.whole:
            return [0.0] * len(HARMONICS)
        kind, blades = self.installed.actuator, self.installed.masses.blades
        return [blades * kind.harmonic_loss(self.installed, n, 1.0 / self.whole) for n in HARMONICS]


def peak_of(waves: Sequence[Harmonic]) -> float:
    """Largest twist of all harmonics together over a turn [°]."""
    psi = np.radians(np.arange(0.0, 360.0, 5.0))
    twist = sum(
        (wave.amplitude * np.cos(wave.per_rev * psi - wave.phase) for wave in waves),
        np.zeros(len(psi)),
    )
    return math.degrees(float(np.abs(twist).max()))


@dataclass(frozen=True)
class FrontDot:
    """One compromise of the front, foreseen: changes of power and, as the mean over inflow models, of the vibration
    index [%].

    `powers`, `over_inflows`: least and largest change of power and of the index over inflow models.
    """

    twist: tuple[Harmonic, ...]
    power: float
    powers: tuple[float, float]
    index: float
    over_inflows: tuple[float, float]

    @property
    def agreed(self) -> bool:
        """Whether the index changes with the same sign with every inflow model."""
        return self.over_inflows[0] * self.over_inflows[1] > 0.0


@dataclass(frozen=True)
class DialAnswer:
    """The response to n/rev twist with one inflow model, per degree as `dial.js` needs it.

    `front`: cosines and sines [°] from least power to least vibration.
    """

    numbers: DialNumbers
    front: tuple[tuple[float, ...], ...]


def dial_answer(design: Design, losses: Sequence[float], reach: float) -> DialAnswer:
    """The answer for a design with the actuator on board; its active twist counts for its shape alone. Power is that of
    its own blades, vibration that of blades that bend.

    losses: of the drive for 1° at each harmonic [W]. reach: largest amplitude of the front's harmonics [°]; at 0 there
    is no front. ValueError or RuntimeError with a sentence.
    """
    matrix, degree = t_matrix(bending(design), HARMONICS), math.radians(1.0)
    matrix = matrix if design == bending(design) else with_power_of(matrix, design)
    power, index = float(matrix.base[-1]), matrix.response(()).index
    second = matrix.second.copy()
    second[-1] += np.diag(2.0 * np.repeat(losses, 2) / degree**2)
    few, steps = 2 * len(_FRONT_HARMONICS), list[Array]()
    if reach:
        part = second[:, :few, :few]
        front = replace(
            matrix, harmonics=_FRONT_HARMONICS, slopes=matrix.slopes[:, :few], second=part
        )
        steps = front_twists(front, math.radians(reach), _FRONT_POINTS)
    numbers = DialNumbers(
        base=_rounded(matrix.base),
        slopes=_rounded(degree * matrix.slopes),
        second=_rounded(degree**2 * second),
        gains=_rounded(100.0 * index_gains(design)),
        power=power,
        index=index,
    )
    rest = (0.0,) * (2 * len(HARMONICS) - few)
    return DialAnswer(numbers, tuple((*np.degrees(step).tolist(), *rest) for step in steps))


def front_dots(own: DialAnswer, others: Sequence[DialNumbers]) -> tuple[FrontDot, ...]:
    """The front of the design's own inflow model, with what the others foresee there."""
    dots = list[FrontDot]()
    for step in own.front:
        (power, index), *rest = (
            _foreseen(numbers, np.array(step)) for numbers in (own.numbers, *others)
        )
        over, powers = (
            (index, *(other for _, other in rest)),
            (power, *(other for other, _ in rest)),
        )
        index = math.fsum(over) / len(over)
        pairs = zip(HARMONICS, np.reshape(step, (-1, 2)).tolist(), strict=True)
        twist = tuple(
            Harmonic(n, math.radians(math.hypot(a, b)), math.atan2(b, a))
            for n, (a, b) in pairs
            if a or b
        )
        dots.append(
            FrontDot(twist, power, (min(powers), max(powers)), index, (min(over), max(over)))
        )
    return tuple(dots)


def _foreseen(numbers: DialNumbers, x: Array) -> tuple[float, float]:
    """Changes of power and index [%] for cosines and sines [°], as `dial.js` foresees them."""
    values = (
        np.array(numbers.base) + (np.array(numbers.slopes) + 0.5 * np.array(numbers.second) @ x) @ x
    )
    sizes = np.square(numbers.gains) * np.square(values[:-1]).reshape(-1, 2).sum(axis=1)
    index = math.sqrt(sizes[:3].sum()) + math.sqrt(sizes[3:].sum())
    return 100.0 * (float(values[-1]) / numbers.power - 1.0), 100.0 * (index / numbers.index - 1.0)


def _rounded(values: Any) -> Any:
    if getattr(values, "ndim", 0):
        return [_rounded(value) for value in values]
    return float(f"{float(values):.{_DIGITS}g}")
