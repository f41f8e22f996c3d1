"""What the dial asks for: the response to twist at n/rev against another blade, the front of power and vibration."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.parts.actuate import DialMatrix, DialNumbers
from rotor import Design, t_matrix
from rotor.actuator import InstalledActuator, tip_amplitude, with_actuator_mass
from rotor.actuator.installation import harmonic_loss
from rotor.aero.bending import can_bend
from rotor.design import Harmonic, TwistLaw
from rotor.optimisation.vibration import TMatrix, front_twists
from rotor.trim import analyse
from rotor.trim.hub_loads import BAND, hub_index, index_gains

HARMONICS = (2, 3, 4, 5)
"""Harmonics of the dial: those at which four blades pass vibration on to the hub, and 2/rev, which saves power."""
_FRONT_HARMONICS, _FRONT_POINTS = (2, 3), 7
_DIGITS = 6


@dataclass(frozen=True)
class Fitted:
    """The actuator on the blade, with the steady voltage of each segment [V], and the blade that power and vibration
    are compared with: its twist, None while it is being worked out, and what it is called."""

    installed: InstalledActuator
    volts: tuple[float, ...]
    twist: TwistLaw | None
    against: str

    @property
    def whole(self) -> float:
        """Amplitude at n/rev of half the voltage range at the tip of the blade at rest [°]; zero: it cannot follow."""
        return math.degrees(tip_amplitude(self.installed))

    @property
    def losses(self) -> list[float]:
        """Heat in the plies of all blades for 1° at each harmonic of the dial [W]."""
        if not self.whole:
            return [0.0] * len(HARMONICS)
        omega, blades = self.installed.beam.angular_speed, self.installed.masses.blades
        return [blades * harmonic_loss(self.installed, n, 1.0 / self.whole, omega) for n in HARMONICS]


def compared(design: Design, undriven: Design, fitted: Fitted | None) -> tuple[Design, Design] | None:
    """What flies, with the actuator on board, and the blade that it is compared with; None while that is not known.

    Blades bend in both where they can, since vibration needs it, and no blade has pitch at n/rev.
    """
    pair, bends = (design, undriven), can_bend(design.rotor)
    flown, still = (replace(one, pitch_per_rev=(), models=replace(one.models, bending=bends)) for one in pair)
    if fitted is None:
        return flown, replace(flown, active_twist=None)
    if fitted.twist is None:
        return None
    return with_actuator_mass(flown, fitted.installed), replace(still, twist=fitted.twist, active_twist=None)


@dataclass(frozen=True)
class FrontDot:
    """One compromise of the front, foreseen: changes of power and of the vibration index [%].

    `over_inflows`: least and largest change of the index over inflow models.
    """

    twist: tuple[Harmonic, ...]
    power: float
    index: float
    over_inflows: tuple[float, float]

    @property
    def agreed(self) -> bool:
        """Whether the index changes with the same sign with every inflow model."""
        return self.over_inflows[0] * self.over_inflows[1] > 0.0


@dataclass(frozen=True)
class DialAnswer:
    """The response to n/rev twist against another blade, per degree as `dial.js` needs it, and the front of power and
    vibration, from least power to least vibration."""

    numbers: DialMatrix
    front: tuple[FrontDot, ...]


def dial_answer(design: Design, reference: Design, losses: Sequence[float], reach: float) -> DialAnswer:
    """The answer for a design with the actuator on board; its active twist counts for its shape alone.

    losses: of the drive for 1° at each harmonic [W]. reach: largest amplitude of the front's harmonics [°].
    ValueError or RuntimeError with a sentence.
    """
    found = list[tuple[TMatrix, float, float]]()
    for inflow in dict.fromkeys((design.models.inflow, *BAND)):
        flown, still = (replace(one, models=replace(design.models, inflow=inflow)) for one in (design, reference))
        try:
            matrix, other = t_matrix(flown, HARMONICS), analyse(still)
            power, index = other.solution.require().power.total, hub_index(other.adjoint)
        except RuntimeError:
            if inflow == design.models.inflow:
                raise
            continue
        second = matrix.second.copy()
        for k, loss in enumerate(np.repeat(losses, 2)):
            second[-1, k, k] += 2.0 * loss / math.radians(1.0) ** 2
        found.append((replace(matrix, second=second), power, index))
    own, *others = (_numbers_of(design, *each) for each in found)
    few = 2 * len(_FRONT_HARMONICS)
    matrix = found[0][0]
    steps = front_twists(
        replace(matrix, harmonics=_FRONT_HARMONICS, slopes=matrix.slopes[:, :few], second=matrix.second[:, :few, :few]),
        math.radians(reach),
        _FRONT_POINTS,
    )
    dots = list[FrontDot]()
    for step in steps:
        x = np.append(step, np.zeros(2 * len(HARMONICS) - few))
        changes = [100.0 * (one.power_and_index(x)[0] / (power, index) - 1.0) for one, power, index in found]
        over = [float(change[1]) for change in changes]
        dots.append(FrontDot(matrix.twist(x), float(changes[0][0]), over[0], (min(over), max(over))))
    return DialAnswer(DialMatrix(**vars(own), inflows=tuple(others)), tuple(dots))


def _numbers_of(design: Design, matrix: TMatrix, power: float, index: float) -> DialNumbers:
    """What `dial.js` needs with one inflow model; power [W] and index [%] of the blade compared with."""
    degree = math.radians(1.0)
    return DialNumbers(
        base=_rounded(matrix.base),
        slopes=_rounded(degree * matrix.slopes),
        second=_rounded(degree**2 * matrix.second),
        gains=_rounded(100.0 * index_gains(design)),
        power=power,
        index=index,
    )


def _rounded(values: Any) -> Any:
    if getattr(values, "ndim", 0):
        return [_rounded(value) for value in values]
    return float(f"{float(values):.{_DIGITS}g}")
